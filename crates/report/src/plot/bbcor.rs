//! BBCOR along a bat, with the limit.

use crate::plot::{Chart, Panel, Picture, Series, Sheet, Unit, place};
use sweetspot::collision::bbcor::{LIMIT, Tested};

/// Height of the diagram (px).
const DIAGRAM: f64 = 230.0;

/// BBCOR against place; picture `bbcor`. None without two places.
pub fn picture(sheet: Sheet, tested: &Tested) -> Option<Picture> {
    let points: Vec<_> = tested.scan.places.iter().map(|at| Some([at.x_m, at.bbcor?])).collect();
    let places: Vec<f64> = points.iter().flatten().map(|at| at[0]).collect();
    let ends = [*places.first()?, *places.last()?];
    if ends[0] >= ends[1] {
        return None;
    }
    let (name, length) = (tested.bat.name(), tested.bat.length());
    let facts = "bat at rest on a pivot 6 in from the knob; computed, not certified";
    let curves = vec![Series::curve("computed", 0, points), Series::level("limit", LIMIT, ends)];
    let most = tested.scan.largest.as_ref().map_or(String::new(), |most| {
        format!(" Largest {:.3}, {}.", most.bbcor, place::shown(sheet, most.x_m, length))
    });
    let alt = format!("{name}: BBCOR against place, {facts}.{most}");
    let called = ("bbcor", "BBCOR along the bat");
    let chart = Chart::along(sheet, called, [name, facts], (ends, &[(name, length)]));
    let chart = chart.keys(&curves);
    let panel = Panel::around(DIAGRAM, ("BBCOR", Unit::NONE), curves, &[]);
    Some(chart.panel(panel).picture(sheet, &alt))
}
