//! What was known of a bat's wood before it was measured and after, and which readings do not fit.

use crate::plot::axis::Axis;
use crate::plot::picture::Picture;
use crate::plot::plane::{Frame, NUMBERS, Plane, head};
use crate::plot::sheet::Sheet;
use crate::plot::svg::{Mark, Pen, Svg};
use crate::plot::theme::{GRID, Ink, MUTED, SERIES, TEXT};
use crate::plot::words::{Anchor, LABEL, width};
use crate::report::calibrate::{short, shown};
use sweetspot_study::calibrate::calibration::{Calibration, Estimated, NINETY_FIVE};
use sweetspot_study::calibrate::fit::{OUTLIER, Residual};

/// Height of a row and of half a bar in it (px).
const ROW: f64 = 34.0;
const BAR: f64 = 8.0;

/// Both pictures, the second only where something was measured.
pub fn pictures(name: &str, found: &Calibration) -> Vec<Picture> {
    let mut all = vec![wood(name, &found.parameters)];
    if !found.data.is_empty() {
        all.push(residuals(name, &found.data));
    }
    all
}

/// The 95 % intervals of all properties before and after; picture `wood`.
fn wood(name: &str, parameters: &[Estimated]) -> Picture {
    let title = "What the readings say of the wood";
    let facts = "95 of 100 cases: light before, dark after; the line is what was found";
    let ends = |one: &Estimated| {
        let before = one.prior / one.value;
        let wide =
            |centre: f64, sd: f64| [-1.0, 1.0].map(|s| centre * (s * NINETY_FIVE * sd).exp());
        [wide(before, one.prior_relative_sd), one.interval95.map(|end| end / one.value)]
    };
    let all: Vec<[[f64; 2]; 2]> = parameters.iter().map(ends).collect();
    let labels: Vec<String> = parameters
        .iter()
        .map(|one| format!("{} {}", short(one.property), shown(one.property, one.value)))
        .collect();
    let values = all.iter().flatten().flatten().copied();
    let x = Axis::around("over what was found", values, 9);
    let (mut svg, plane) = rows((title, [name, facts]), &labels, x);
    let mut said = vec![];
    for (k, ([before, after], label)) in all.iter().zip(&labels).enumerate() {
        let middle = middle(&plane, k);
        bar(&mut svg, &plane, (*before, middle), (SERIES[0], 0.3));
        bar(&mut svg, &plane, (*after, middle), (SERIES[0], 0.9));
        let [low, high] = after.map(|end| format!("{:+.1} %", 100.0 * (end - 1.0)));
        let words = format!("{label}, 95 % from {low} to {high}");
        svg.hover(&[([plane.across(1.0), middle], words.clone())], 1);
        said.push(words);
    }
    line(&mut svg, &plane, 1.0, Pen::new(TEXT, 1.2));
    plane.below(&mut svg);
    Picture::new("wood", title, &format!("{name}: {}.", said.join("; ")), svg)
}

/// How far each reading is from what all others say; picture `readings`.
fn residuals(name: &str, all: &[Residual]) -> Picture {
    let title = "Which readings fit";
    let facts =
        "measured less computed; circle: with it, bar: from all others; beyond 3 it does not fit";
    let values = all.iter().flat_map(|one| [one.left_out_sd, one.residual_sd]);
    let x = Axis::around("standard deviations", values.chain([-4.0, 4.0]), 9);
    let labels: Vec<String> = all.iter().map(|one| one.datum.kind.name()).collect();
    let (mut svg, plane) = rows((title, [name, facts]), &labels, x);
    let mut said = vec![];
    for (k, (one, label)) in all.iter().zip(&labels).enumerate() {
        let middle = middle(&plane, k);
        let ink = if one.is_outlier() { SERIES[1] } else { SERIES[0] };
        let ends = [one.left_out_sd.min(0.0), one.left_out_sd.max(0.0)];
        bar(&mut svg, &plane, (ends, middle), (ink, 0.7));
        svg.mark(Mark::Circle, [plane.across(one.residual_sd), middle], 4.0, TEXT, false);
        let words =
            format!("{label}: {:+.1}, from all others {:+.1}", one.residual_sd, one.left_out_sd);
        svg.hover(&[([plane.across(one.left_out_sd), middle], words.clone())], 1);
        said.push(words);
    }
    line(&mut svg, &plane, 0.0, Pen::new(TEXT, 1.2));
    for limit in [-OUTLIER, OUTLIER] {
        line(&mut svg, &plane, limit, Pen::new(MUTED, 1.2).dashed("5 3"));
    }
    plane.below(&mut svg);
    Picture::new("readings", title, &format!("{name}: {}.", said.join("; ")), svg)
}

/// A diagram of rows with these labels.
fn rows((title, facts): (&str, [&str; 2]), labels: &[String], x: Axis) -> (Svg, Plane) {
    let sheet = Sheet::file(false);
    let mut svg = Svg::on(sheet);
    head(&mut svg, title, facts);
    let widest = labels.iter().map(|label| width(label, LABEL)).fold(0.0, f64::max);
    let top = sheet.head() + 6.0;
    let bottom = top + ROW * labels.len() as f64 + 8.0;
    let frame = Frame { left: 20.0 + widest + 12.0, ..Frame::across(sheet, [top, bottom]) };
    svg.height = frame.bottom + NUMBERS + 4.0;
    let plane = Plane { frame, x, y: Axis::new("", [0.0, 1.0]) };
    for tick in plane.x.ticks(12) {
        line(&mut svg, &plane, tick.value, Pen::new(GRID, 1.0));
    }
    for (k, label) in labels.iter().enumerate() {
        svg.text([frame.left - 10.0, middle(&plane, k) + 4.4], LABEL.at(Anchor::End), label);
    }
    (svg, plane)
}

fn middle(plane: &Plane, row: usize) -> f64 {
    plane.frame.top + ROW * (row as f64 + 0.5) + 4.0
}

fn line(svg: &mut Svg, plane: &Plane, value: f64, pen: Pen) {
    let x = plane.across(value);
    svg.line(&[[x, plane.frame.top], [x, plane.frame.bottom]], pen);
}

fn bar(svg: &mut Svg, plane: &Plane, (ends, middle): ([f64; 2], f64), (ink, opacity): (Ink, f64)) {
    let [from, to] = ends.map(|end| plane.across(end));
    svg.rect([[from, middle - BAR], [to, middle + BAR]], ink, opacity, None);
}
