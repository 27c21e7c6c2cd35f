//! BBCOR against the thickness of a barrel's wall.

use crate::plot::axis::Axis;
use crate::plot::picture::Picture;
use crate::plot::plane::{Frame, NUMBERS, Plane, head, ticks_up};
use crate::plot::series::{Series, hover, legend};
use crate::plot::sheet::Sheet;
use crate::plot::svg::{Mark, Pen, Svg};
use crate::plot::theme::SERIES;
use sweetspot::collision::bbcor::LIMIT;
use sweetspot_study::trampoline::thickness::WallTried;

/// Height of the diagram (px).
const DIAGRAM: f64 = 250.0;

/// BBCOR against wall thickness, stiff and with the wall; picture `wall_sweep`. None without two walls.
pub fn picture(sheet: Sheet, name: &str, tried: &[WallTried]) -> Option<Picture> {
    let unit = sheet.small();
    let points = |of: &dyn Fn(&WallTried) -> f64| -> Vec<Option<[f64; 2]>> {
        tried.iter().map(|tried| Some([tried.thickness_m, of(tried)])).collect()
    };
    let wall = points(&|tried| tried.wall);
    let known: Vec<[f64; 2]> = wall.iter().flatten().copied().collect();
    let (from, to) = (known.first()?[0], known.last()?[0]);
    if from >= to {
        return None;
    }
    let curve = Series::curve("with the wall", 0, wall).units(unit.name, "");
    let stiff = Series::curve("if the wall were stiff", 1, points(&|tried| tried.stiff));
    let stiff = stiff.units(unit.name, "");
    let thin = |name: &str, end: usize| {
        let pen = Pen::new(SERIES[0], 1.0).dashed("2 3");
        Series::curve(name, 0, points(&|tried| tried.range[end])).pen(pen)
    };
    let [low, high] = [thin("patch of a ball squeezed twice or half as much", 0), thin("", 1)];
    let limit = Series::curve("limit", 0, vec![Some([from, LIMIT]), Some([to, LIMIT])])
        .pen(Pen::new(SERIES[5], 1.4));
    let here = tried.iter().find(|tried| tried.factor == 1.0);
    let here = here.map(|tried| [tried.thickness_m, tried.wall]);
    let title = "BBCOR against wall thickness";
    let facts =
        "the barrel's surface where it is, the bat at rest and free; computed, not certified";
    let mut svg = Svg::on(sheet);
    head(&mut svg, title, [name, facts]);
    let top = legend(&mut svg, &[&curve, &low, &stiff, &limit]) + 14.0;
    let frame = Frame::across(sheet, [top, top + DIAGRAM]);
    svg.height = frame.bottom + NUMBERS + 4.0;
    let scaled = [from, to].map(|x| unit.per * x);
    let x = Axis::new("wall under the ball", scaled).counted_in(unit);
    let series = [&limit, &low, &high, &stiff, &curve];
    let values = series.iter().flat_map(|one| one.points.iter().flatten()).map(|at| at[1]);
    let plane = Plane { frame, x, y: Axis::around("BBCOR", values, ticks_up(DIAGRAM)) };
    plane.draw(&mut svg);
    series.iter().for_each(|series| series.draw(&mut svg, &plane));
    if let Some(at) = here {
        svg.mark(Mark::Circle, plane.at(at), 5.0, SERIES[0], true);
    }
    hover(&mut svg, &plane, &[&curve, &stiff]);
    plane.below(&mut svg);
    let told = |at: &[f64; 2]| format!("{:.3} at {:.2} {}", at[1], unit.per * at[0], unit.name);
    let all: Vec<String> = known.iter().map(told).collect();
    let alt = format!("{name}: BBCOR against wall thickness: {}.", all.join(", "));
    Some(Picture::new("wall_sweep", title, &alt, svg))
}
