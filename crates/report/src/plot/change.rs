//! How much thicker or thinner a bat has become along it.

use crate::plot::axis::Axis;
use crate::plot::picture::Picture;
use crate::plot::plane::{Frame, NUMBERS, Plane, head, ticks_up};
use crate::plot::series::{Series, hover};
use crate::plot::sheet::{Sheet, Unit};
use crate::plot::svg::{Pen, Svg};
use crate::plot::theme::FRAME;
use sweetspot::bat::body::Bat;

/// Height of the diagram (px).
const DIAGRAM: f64 = 230.0;
/// Places along the bat.
const PLACES: usize = 420;

/// The change of the diameter from one bat to the other, place by place as shares of their lengths: `change`.
pub fn picture(sheet: Sheet, old: &Bat, new: &Bat) -> Picture {
    let length = sheet.length();
    // A thousandth of an inch is what a change in inches is counted in.
    let small =
        if sheet.us { Unit { name: "mil", per: 1e3 * sheet.small().per } } else { sheet.small() };
    let at = |k: usize| {
        let share = (k as f64 + 0.5) / PLACES as f64;
        let [was, is] = [old, new].map(|bat| bat.profile().at(share * bat.length()).outer);
        [share * new.length(), 2.0 * (is - was)]
    };
    let points: Vec<[f64; 2]> = (0..PLACES).map(at).collect();
    let most = points.iter().map(|[_, by]| *by).fold(0.0, f64::max);
    let least = points.iter().map(|[_, by]| *by).fold(0.0, f64::min);
    let title = "Change of the diameter";
    let mut svg = Svg::on(sheet);
    head(&mut svg, title, [old.name(), "below the line wood is turned off"]);
    let top = sheet.head() + 10.0;
    let bottom = top + DIAGRAM;
    svg.height = bottom + NUMBERS + 4.0;
    let values = [small.per * least, small.per * most, 0.0].into_iter();
    let y = Axis::around("change of the diameter", values, ticks_up(DIAGRAM)).counted_in(small);
    let x = Axis::new("from the knob end", [0.0, length.per * new.length()]).counted_in(length);
    let plane = Plane { frame: Frame::across(sheet, [top, bottom]), x, y };
    plane.draw(&mut svg);
    plane.below(&mut svg);
    let zero = [plane.x.from, plane.x.to].map(|x| plane.at([x, 0.0]));
    svg.line(&zero, Pen::new(FRAME, 1.4));
    let curve = Series::curve("change", 0, points.into_iter().map(Some).collect());
    let curve = curve.units(length.name, small.name);
    curve.draw(&mut svg, &plane);
    hover(&mut svg, &plane, &[&curve]);
    let alt = format!(
        "Change of the diameter of {} along it: {:.2} {unit} at most off, {:.2} {unit} at most added.",
        old.name(),
        -small.per * least,
        small.per * most,
        unit = small.name
    );
    Picture::new("change", title, &alt, svg)
}
