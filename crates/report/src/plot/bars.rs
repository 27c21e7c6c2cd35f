//! Rows of bars against one axis, a name before each.

use crate::plot::axis::Axis;
use crate::plot::picture::Picture;
use crate::plot::plane::{Frame, NUMBERS, Plane, head};
use crate::plot::sheet::Sheet;
use crate::plot::svg::{Mark, Pen, Svg};
use crate::plot::theme::{GRID, Ink, MUTED, TEXT};
use crate::plot::words::{Anchor, LABEL, fitted, width};

/// Height of a row and of half the thickest bar in it (px).
const ROW: f64 = 32.0;
const BAR: f64 = 8.0;
/// Largest width of a name (px).
const MOST: f64 = 300.0;

/// A bar from one value to another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bar {
    /// Values at its ends.
    pub ends: [f64; 2],
    /// Its height as a share of the thickest.
    pub high: f64,
    /// Its colour and opacity.
    pub look: (Ink, f64),
}

/// The content of a row.
#[derive(Debug, Clone, PartialEq)]
pub struct BarRow {
    /// The name before it.
    pub label: String,
    /// Its bars, the lowest first.
    pub bars: Vec<Bar>,
    /// Thin lines along it, from value to value.
    pub spans: Vec<[f64; 2]>,
    /// The value of a circle in it, if there is one.
    pub dot: Option<f64>,
    /// The place and text of the tooltip; the text is also part of the description for readers who cannot see the
    /// picture.
    pub told: (f64, String),
}

/// The picture with that name and title in a separate file: subject and facts, rows from above, vertical lines, and the
/// beginning of the description for readers who cannot see it.
pub fn picture(
    (name, title, of): (&str, &str, [&str; 2]),
    x: Axis,
    (rows, lines): (&[BarRow], &[(f64, Pen)]),
    whose: &str,
) -> Picture {
    let sheet = Sheet::file(false);
    let mut svg = Svg::on(sheet);
    head(&mut svg, title, of);
    let labels: Vec<String> = rows.iter().map(|row| fitted(&row.label, LABEL, MOST)).collect();
    let widest = labels.iter().map(|label| width(label, LABEL)).fold(0.0, f64::max);
    let top = sheet.head() + 6.0;
    let frame = Frame::across(sheet, [top, top + ROW * rows.len() as f64 + 8.0]);
    let plane = Plane::strip(Frame { left: 20.0 + widest + 12.0, ..frame }, &x);
    svg.height = frame.bottom + NUMBERS + 4.0;
    for tick in plane.x.ticks(12) {
        plane.upright(&mut svg, tick.value, Pen::new(GRID, 1.0));
    }
    for (k, (row, label)) in rows.iter().zip(&labels).enumerate() {
        let middle = top + ROW * (k as f64 + 0.5) + 4.0;
        svg.text([plane.frame.left - 10.0, middle + 4.4], LABEL.at(Anchor::End), label);
        for Bar { ends, high, look: (ink, opacity) } in &row.bars {
            let [from, to] = ends.map(|end| plane.across(end));
            let corners = [[from, middle - high * BAR], [to, middle + high * BAR]];
            svg.rect(corners, *ink, *opacity, None);
        }
        for span in &row.spans {
            svg.line(&span.map(|end| [plane.across(end), middle]), Pen::new(MUTED, 1.2));
        }
        if let Some(dot) = row.dot {
            svg.mark(Mark::Circle, [plane.across(dot), middle], 4.0, TEXT, false);
        }
        let (at, words) = &row.told;
        svg.hover(&[([plane.across(*at), middle], words.clone())], 1);
    }
    lines.iter().for_each(|(value, pen)| plane.upright(&mut svg, *value, *pen));
    plane.below(&mut svg);
    let told: Vec<&str> = rows.iter().map(|row| row.told.1.as_str()).collect();
    Picture::new(name, title, &format!("{whose}: {}.", told.join("; ")), svg)
}
