//! BBCOR along a bat, with the limit.

use crate::plot::axis::Axis;
use crate::plot::picture::Picture;
use crate::plot::place;
use crate::plot::plane::{Frame, NUMBERS, Plane, head, ticks_up};
use crate::plot::series::{Series, hover, legend};
use crate::plot::sheet::Sheet;
use crate::plot::svg::{Pen, Svg};
use crate::plot::theme::SERIES;
use sweetspot::collision::bbcor::{LIMIT, Tested};

/// Height of the diagram (px).
const DIAGRAM: f64 = 230.0;

/// BBCOR against place; picture `bbcor`. None without two places.
pub fn picture(sheet: Sheet, tested: &Tested) -> Option<Picture> {
    let points: Vec<_> = tested.scan.places.iter().map(|at| Some([at.x_m, at.bbcor?])).collect();
    let known: Vec<[f64; 2]> = points.iter().flatten().copied().collect();
    let (from, to) = (known.first()?[0], known.last()?[0]);
    if from >= to {
        return None;
    }
    let curve = Series::curve("computed", 0, points).units(sheet.length().name, "");
    let line = vec![Some([from, LIMIT]), Some([to, LIMIT])];
    let limit = Series::curve("limit", 0, line).pen(Pen::new(SERIES[5], 1.4));
    let title = "BBCOR along the bat";
    let facts = "bat at rest on a pivot 6 in from the knob; computed, not certified";
    let mut svg = Svg::on(sheet);
    head(&mut svg, title, [tested.bat.name(), facts]);
    let top = legend(&mut svg, &[&curve, &limit]);
    let top = top + 12.0 + NUMBERS;
    let frame = Frame::across(sheet, [top, top + DIAGRAM]);
    svg.height = frame.bottom + NUMBERS + 4.0;
    let [x, tip] = place::axes(sheet, [from, to], &[(tested.bat.name(), tested.bat.length())]);
    let values = known.iter().map(|[_, bbcor]| *bbcor).chain([LIMIT]);
    let y = Axis::around("BBCOR", values, ticks_up(DIAGRAM));
    let plane = Plane { frame, x, y };
    plane.above(&mut svg, &tip);
    plane.draw(&mut svg);
    [&limit, &curve].into_iter().for_each(|series| series.draw(&mut svg, &plane));
    hover(&mut svg, &plane, &[&curve]);
    plane.below(&mut svg);
    let most = tested.scan.largest.as_ref().map_or(String::new(), |most| {
        format!(
            " Largest {:.3}, {}.",
            most.bbcor,
            place::shown(sheet, most.x_m, tested.bat.length())
        )
    });
    let alt = format!("{}: BBCOR against place, {facts}.{most}", tested.bat.name());
    Some(Picture::new("bbcor", title, &alt, svg))
}
