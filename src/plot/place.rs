//! Positions on a bat: from the knob end and from the tip, and rows of marked places.

use crate::plot::axis::Axis;
use crate::plot::plane::{Frame, Plane};
use crate::plot::series::spread;
use crate::plot::svg::{Anchor, LABEL, MARKS, Mark, Pen, SMALL, Svg, fitted, width};
use crate::plot::theme::{FRAME, GRID, series};
use crate::units::inches;

/// cm in a metre: positions stand in cm from the knob end.
pub const CM: f64 = 100.0;

/// The axes of a stretch of bats (m): from the knob end in cm, and from the tip in inches. Where the
/// bats are not equally long it is the first one's tip.
pub fn axes([from, to]: [f64; 2], bats: &[(&str, f64)]) -> [Axis; 2] {
    let length = bats.first().map_or(0.0, |(_, length)| *length);
    let same = bats.iter().all(|(_, other)| (other - length).abs() < 1e-4 * length);
    let whose = match bats.first() {
        Some((name, _)) if !same => format!("from the tip of {name} (in)"),
        _ => "from the tip (in)".to_owned(),
    };
    let whose = fitted(&whose, SMALL, 480.0);
    [
        Axis::new("from the knob end (cm)", [CM * from, CM * to]),
        Axis::new(&whose, [from, to].map(|x| inches(length - x))),
    ]
}

/// A place as it stands beside its mark.
pub fn shown(x: f64, length: f64) -> String {
    format!("{:.1} cm, {:.1} in from the tip", CM * x, inches(length - x))
}

/// Marked places that belong together: one for each bat, or stretches.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    pub label: String,
    /// Which bat's, and where (m).
    pub places: Vec<(usize, f64)>,
    /// Which bat's, from where to where (m).
    pub stretches: Vec<(usize, [f64; 2])>,
}

impl Row {
    pub fn of_places(label: String, places: Vec<(usize, f64)>) -> Self {
        Self { label, places, stretches: vec![] }
    }

    pub fn of_stretches(label: String, stretches: Vec<(usize, [f64; 2])>) -> Self {
        Self { label, places: vec![], stretches }
    }
}

/// Height of a row (px).
pub const ROW: f64 = 18.0;

/// What rows take (px).
pub fn height(rows: &[Row]) -> f64 {
    ROW * rows.len() as f64 + if rows.is_empty() { 0.0 } else { 8.0 }
}

/// The rows in a frame, a line each, their words where there is most room beside the marks. A place
/// beyond the frame is at its edge.
pub fn rows(svg: &mut Svg, plane: &Plane, rows: &[Row]) {
    let Frame { left, top, right, .. } = plane.frame;
    for (k, row) in rows.iter().enumerate() {
        let y = top + ROW * (k as f64 + 0.5) + 4.0;
        svg.line(&[[left, y], [right, y]], Pen::new(GRID, 1.0));
        let across = |x: f64| plane.across(CM * x).clamp(left, right);
        let mut taken = vec![];
        for (bat, stretch) in &row.stretches {
            let [from, to] = stretch.map(across);
            // Of several bats one below the other.
            let y = y + 4.0 * *bat as f64;
            svg.line(&[[from, y], [to, y]], Pen { width: 4.0, ..Pen::new(series(*bat).0, 4.0) });
            taken.extend([from - 2.0, to + 2.0]);
        }
        for (bat, x) in &row.places {
            mark(svg, *bat, [across(*x), y]);
            taken.extend([across(*x) - 7.0, across(*x) + 7.0]);
        }
        words(svg, plane.frame, y, (&row.label, &taken));
    }
}

/// The mark of a bat's place.
pub fn mark(svg: &mut Svg, bat: usize, at: [f64; 2]) {
    let mark: Mark = MARKS[bat % MARKS.len()];
    svg.mark(mark, at, 4.5, series(bat).0, true);
}

/// A row's words, beside what is taken in it.
fn words(svg: &mut Svg, frame: Frame, y: f64, (words, taken): (&str, &[f64])) {
    let first = taken.iter().fold(frame.right, |least, x| least.min(*x));
    let last = taken.iter().fold(frame.left, |most, x| most.max(*x));
    let [before, after] = [first - frame.left - 8.0, frame.right - last - 8.0];
    let wide = width(words, LABEL);
    let (x, anchor, most) = match after >= wide || after >= before {
        true => (last + 5.0, Anchor::Start, after),
        false => (first - 5.0, Anchor::End, before),
    };
    svg.text([x, y + 4.4], LABEL.at(anchor), &fitted(words, LABEL, most));
}

/// Heights (px) at which places that are labelled above each other stand, at least a line apart.
pub fn lines(wanted: &[f64], frame: Frame) -> Vec<f64> {
    spread(wanted, 15.0, [frame.top, frame.bottom])
}

/// A thin line through a frame at a place (m).
pub fn guide(svg: &mut Svg, plane: &Plane, x: f64) {
    if plane.x.holds(CM * x) {
        let across = plane.across(CM * x);
        let Frame { top, bottom, .. } = plane.frame;
        svg.line(&[[across, top], [across, bottom]], Pen::new(FRAME, 1.0).dashed("2 2"));
    }
}
