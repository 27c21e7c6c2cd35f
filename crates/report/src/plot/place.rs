//! Positions on a bat: from the knob end and from the tip, and rows of marked places.

use crate::plot::axis::Axis;
use crate::plot::plane::{Frame, Plane};
use crate::plot::series::{digits, spread};
use crate::plot::sheet::Sheet;
use crate::plot::svg::{MARKS, Mark, Pen, Svg};
use crate::plot::theme::{PAPER, series};
use crate::plot::words::{Anchor, LABEL, SMALL, fitted, width};

/// The axes of a stretch of bats (m): from the knob end, and from the tip. For bats of different length it is the tip
/// of the first.
pub fn axes(sheet: Sheet, [from, to]: [f64; 2], bats: &[(&str, f64)]) -> [Axis; 2] {
    let length = bats.first().map_or(0.0, |(_, length)| *length);
    let same = bats.iter().all(|(_, other)| (other - length).abs() < 1e-4 * length);
    let whose = match bats.first() {
        Some((name, _)) if !same => format!("from the tip of {name}"),
        _ => "from the tip".to_owned(),
    };
    let whose = fitted(&whose, SMALL, 0.63 * sheet.width());
    let unit = sheet.length();
    let axis = |label: &str, ends: [f64; 2]| Axis::new(label, ends.map(|x| unit.per * x));
    [
        axis("from the knob end", [from, to]).counted_in(unit),
        axis(&whose, [length - from, length - to]).counted_in(unit),
    ]
}

/// The label of a place, from the knob end.
pub fn shown(sheet: Sheet, x: f64, length: f64) -> String {
    match x {
        x if x < 0.0 => format!("{} beyond the knob end", along(sheet, -x)),
        x if x > length => format!("{} beyond the tip", along(sheet, x - length)),
        _ => format!("{} from the knob end", along(sheet, x)),
    }
}

/// A length (m) with its unit.
pub fn along(sheet: Sheet, length: f64) -> String {
    let unit = sheet.length();
    format!("{} {}", tenths(unit.per * length), unit.name)
}

/// The places of several bats, once where they are the same.
pub fn listed(sheet: Sheet, places: &[(usize, f64)]) -> String {
    let unit = sheet.length();
    let all: Vec<String> = places.iter().map(|(_, x)| tenths(unit.per * x)).collect();
    match all.first() {
        Some(one) if all.iter().all(|other| other == one) => format!("{one} {}", unit.name),
        _ => format!("{} {}", all.join(", "), unit.name),
    }
}

/// A length with one decimal, or as many as a small one needs.
pub fn tenths(length: f64) -> String {
    match length.abs() {
        size if size == 0.0 || (0.95..1e3).contains(&size) => format!("{length:.1}"),
        size if size < 1e5 && size > 1.0 => format!("{length:.0}"),
        _ => digits(length, 2),
    }
    .replace('-', "−")
}

/// Marked places that belong together: one for each bat, or stretches.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaceRow {
    /// Label of the row.
    pub label: String,
    /// Which bat's, and where (m).
    pub places: Vec<(usize, f64)>,
    /// Which bat's, from where to where (m).
    pub stretches: Vec<(usize, [f64; 2])>,
}

impl PlaceRow {
    /// A row of places (m), each with the number of its bat.
    pub fn of_places(label: String, places: Vec<(usize, f64)>) -> Self {
        Self { label, places, stretches: vec![] }
    }

    /// A row with one of these places (m) for each bat of these lengths (m), and with the places in its label; None
    /// where no bat has one.
    pub fn named(
        sheet: Sheet,
        what: &str,
        lengths: &[f64],
        places: &[Option<f64>],
    ) -> Option<Self> {
        let places = places.iter().enumerate().filter_map(|(k, x)| Some((k, (*x)?)));
        let places: Vec<(usize, f64)> = places.collect();
        let told = match (lengths, &places[..]) {
            (_, []) => return None,
            ([length], [(_, x)]) => shown(sheet, *x, *length),
            _ => listed(sheet, &places),
        };
        Some(Self::of_places(format!("{what}: {told}"), places))
    }

    /// A row of stretches (m), each with the number of its bat.
    pub fn of_stretches(label: String, stretches: Vec<(usize, [f64; 2])>) -> Self {
        Self { label, places: vec![], stretches }
    }
}

/// From the edge of a narrow picture to words (px).
const EDGE: f64 = 10.0;
/// Distance between the marks of several bats in a row, so that none hides another (px).
const APART: f64 = 10.0;
/// Height of a row (px). In a narrow picture the words have a separate line above the marks.
fn row_height(sheet: Sheet) -> f64 {
    if sheet.narrow() { 33.0 } else { 18.0 }
}

/// The height of the marks of the k-th row (px).
fn height_of(sheet: Sheet, top: f64, k: usize) -> f64 {
    let row = row_height(sheet);
    top + row * (k + 1) as f64 - if sheet.narrow() { 10.0 } else { 5.0 }
}

/// Height of the rows (px).
pub fn height(sheet: Sheet, rows: &[PlaceRow]) -> f64 {
    row_height(sheet) * rows.len() as f64 + if rows.is_empty() { 0.0 } else { 8.0 }
}

/// Left, upper, right and lower edge (px) of words.
pub type Edges = [f64; 4];

/// The rows in a frame, a line each, with their words where there is most room beside the marks. A place beyond the
/// frame becomes an arrow at its edge. Returns the extents of the words.
pub fn rows(svg: &mut Svg, plane: &Plane, rows: &[PlaceRow]) -> Vec<Edges> {
    let Frame { left, top, right, .. } = plane.frame;
    let mut told = vec![];
    for (k, row) in rows.iter().enumerate() {
        let y = height_of(svg.sheet, top, k);
        let across = |x: f64| plane.across(x).clamp(left, right);
        let mut taken = vec![];
        for (bat, stretch) in &row.stretches {
            let [from, to] = stretch.map(across);
            // Of several bats one below the other.
            let y = y + 4.5 * (*bat as f64 - 0.5 * (row.stretches.len() - 1) as f64);
            svg.line(&[[from, y], [to, y]], Pen { width: 4.0, ..Pen::new(series(*bat).0, 4.0) });
            taken.extend([from - 2.0, to + 2.0]);
        }
        let wanted: Vec<f64> = row.places.iter().map(|(_, x)| across(*x)).collect();
        let fanned = spread(&wanted, APART, [left, right]);
        for ((bat, x), (at, place)) in row.places.iter().zip(fanned.into_iter().zip(wanted)) {
            match plane.x.share(*x) {
                share if share < -1e-9 => arrow(svg, *bat, [left, y], -1.0),
                share if share > 1.0 + 1e-9 => arrow(svg, *bat, [right, y], 1.0),
                _ => {
                    svg.line(&[[at, y], [place, y + 8.0]], Pen::new(series(*bat).0, 0.8));
                    mark(svg, *bat, [at, y]);
                }
            }
            taken.extend([at - 7.0, at + 7.0]);
        }
        told.push(words(svg, plane.frame, y, (&row.label, &taken)));
    }
    told
}

/// An arrow for a place beyond the frame, on that side of it.
fn arrow(svg: &mut Svg, bat: usize, [x, y]: [f64; 2], side: f64) {
    let points = [[x + 5.0 * side, y], [x - 4.0 * side, y - 5.0], [x - 4.0 * side, y + 5.0]];
    svg.area(&points, series(bat).0, 1.0, None);
}

/// The mark of a bat's place.
pub fn mark(svg: &mut Svg, bat: usize, at: [f64; 2]) {
    let mark: Mark = MARKS[bat % MARKS.len()];
    // One that lies on another does not hide it.
    let half = (5.2 - 0.7 * bat as f64).max(3.0);
    svg.mark(mark, at, half, series(bat).0, true);
}

/// Thin vertical lines from a height down to the marked places of the rows, interrupted by those words.
pub fn guides(svg: &mut Svg, plane: &Plane, (all, told): (&[PlaceRow], &[Edges]), from: f64) {
    for (k, row) in all.iter().enumerate() {
        let end = height_of(svg.sheet, plane.frame.top, k) - 8.0;
        for (bat, x) in row.places.iter().filter(|(_, x)| plane.x.holds(*x)) {
            let x = plane.across(*x);
            let pen = Pen::new(series(*bat).0, 0.8).dashed("1 3");
            let mut y = from;
            // The rows come from above.
            let above = |e: &&Edges| e[0] < x && x < e[2] && e[3] <= end + 8.0;
            for [_, top, _, bottom] in told[..=k].iter().filter(above) {
                svg.line(&[[x, y], [x, *top]], pen);
                y = *bottom;
            }
            if y < end {
                svg.line(&[[x, y], [x, end]], pen);
            }
        }
    }
}

/// Name and place; for lack of room without the end it is counted from, or only the name.
fn shortened(words: &str, room: f64) -> &str {
    let place = words.trim_end_matches(" from the knob end");
    let what = words.split(':').next().unwrap_or(words);
    [words, place].into_iter().find(|words| width(words, LABEL) <= room).unwrap_or(what)
}

/// The words of a row, in the room left by its marks.
fn words(svg: &mut Svg, frame: Frame, y: f64, (words, taken): (&str, &[f64])) -> Edges {
    let first = taken.iter().fold(frame.right, |least, x| least.min(*x));
    let last = taken.iter().fold(frame.left, |most, x| most.max(*x));
    if svg.sheet.narrow() {
        let words = fitted(shortened(words, svg.width - 2.0 * EDGE), LABEL, svg.width - 2.0 * EDGE);
        let at = [EDGE, y - 11.0];
        svg.text(at, LABEL, &words);
        let wide = width(&words, LABEL);
        return [at[0] - 2.0, at[1] - 11.0, at[0] + wide + 2.0, at[1] + 4.0];
    }
    let [before, after] = [first - frame.left - 8.0, frame.right - last - 8.0];
    let words = shortened(words, before.max(after));
    let wide = width(words, LABEL);
    let edges = |from: f64, wide: f64| [from - 2.0, y - 8.0, from + wide + 2.0, y + 8.0];
    if wide > before.max(after) && after.max(before) < 120.0 {
        // Over the marks if there is no room beside them.
        let middle = 0.5 * (frame.left + frame.right);
        let [left, top, right, bottom] = edges(middle - 0.5 * wide, wide);
        svg.rect([[left, top], [right, bottom]], PAPER, 1.0, None);
        svg.text([middle, y + 4.4], LABEL.at(Anchor::Middle), words);
        return [left, top, right, bottom];
    }
    let (x, anchor, most) = match after >= wide || after >= before {
        true => (last + 5.0, Anchor::Start, after),
        false => (first - 5.0, Anchor::End, before),
    };
    let words = fitted(words, LABEL, most);
    let wide = width(&words, LABEL);
    svg.text([x, y + 4.4], LABEL.at(anchor), &words);
    edges(if anchor == Anchor::Start { x } else { x - wide }, wide)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_tell_as_much_as_there_is_room_for() {
        let all = format!("centre: {}", shown(Sheet::file(false), 0.647, 0.838));
        assert_eq!(all, "centre: 64.7 cm from the knob end");
        assert_eq!(shown(Sheet::file(true), 0.9, 0.838), "2.4 in beyond the tip");
        let room = |words: &str| width(words, LABEL) + 1.0;
        for told in [&all, "centre: 64.7 cm", "centre"] {
            assert_eq!(shortened(&all, room(told)), told);
        }
    }
}
