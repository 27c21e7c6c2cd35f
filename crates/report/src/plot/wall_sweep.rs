//! BBCOR against the thickness of a barrel's wall.

use crate::plot::{Axis, Chart, Mark, Panel, Pen, Picture, SERIES, Series, Sheet, Unit};
use sweetspot::collision::bbcor::LIMIT;
use sweetspot_study::trampoline::thickness::WallTried;

/// Height of the diagram (px).
const DIAGRAM: f64 = 250.0;

/// BBCOR against wall thickness, stiff and with the wall; picture `wall_sweep`. None without two walls.
pub fn picture(sheet: Sheet, name: &str, tried: &[WallTried]) -> Option<Picture> {
    let unit = sheet.small();
    let curve = |name: &str, k: usize, of: &dyn Fn(&WallTried) -> f64| {
        let point = |tried: &WallTried| Some([tried.thickness_m, of(tried)]);
        Series::curve(name, k, tried.iter().map(point).collect())
    };
    let thin = |name: &str, end: usize| {
        let pen = Pen::new(SERIES[0], 1.0).dashed("2 3");
        curve(name, 0, &|tried| tried.range[end]).pen(pen).untold()
    };
    let wall = curve("with the wall", 0, &|tried| tried.wall);
    let known: Vec<[f64; 2]> = wall.points.iter().flatten().copied().collect();
    let ends = [known.first()?[0], known.last()?[0]];
    if ends[0] >= ends[1] {
        return None;
    }
    let curves = vec![
        wall,
        thin("patch of a ball squeezed twice or half as much", 0),
        thin("", 1),
        curve("if the wall were stiff", 1, &|tried| tried.stiff),
        Series::level("limit", LIMIT, ends),
    ];
    let here = tried.iter().find(|tried| tried.factor == 1.0);
    let here = here.map(|tried| [tried.thickness_m, tried.wall]);
    let told = |at: &[f64; 2]| format!("{:.3} at {:.2} {}", at[1], unit.per * at[0], unit.name);
    let all: Vec<String> = known.iter().map(told).collect();
    let alt = format!("{name}: BBCOR against wall thickness: {}.", all.join(", "));
    let facts =
        "the barrel's surface where it is, the bat at rest and free; computed, not certified";
    let x = Axis::new("wall under the ball", ends.map(|x| unit.per * x)).counted_in(unit);
    let chart = Chart::new("wall_sweep", "BBCOR against wall thickness", [name, facts], x);
    let chart = chart.keys(&curves);
    let panel = Panel::around(DIAGRAM, ("BBCOR", Unit::NONE), curves, &[]);
    let panel = panel.over(|svg, plane| {
        here.into_iter().for_each(|at| svg.mark(Mark::Circle, plane.at(at), 5.0, SERIES[0], true));
    });
    Some(chart.panel(panel).picture(sheet, &alt))
}
