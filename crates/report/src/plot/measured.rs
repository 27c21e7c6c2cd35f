//! Measured modes compared with computed ones: the similarity of the shapes, and the shapes on top of each other.

use crate::plot::matrix::{self, Matrix};
use crate::plot::{
    Axis, Chart, Frame, LABEL, MARKS, Panel, Pen, Picture, SERIES, SMALL, Series, Sheet, Svg,
    digits, fitted, heights,
};
use sweetspot_study::measured::study::{Pair, Shapes, Study};

/// Shapes in one picture.
const MOST: usize = 8;
/// Height of a shape's diagram (px).
const ROW: f64 = 76.0;
/// Width of the names of modes on the right of the frame (px).
const RIGHT: f64 = 122.0;
/// Points of a computed curve, and the largest number of measured points drawn.
const POINTS: usize = 160;
const DRAWN: usize = 400;

/// `mac`, `mass_orthogonality` and `measured_shapes`; none without measured shapes, or where no measured mode is a
/// bending mode.
pub fn pictures(sheet: Sheet, bat: &str, study: &Study) -> Vec<Picture> {
    let Some(shapes) = &study.shapes else { return vec![] };
    if study.bending.is_empty() {
        return vec![];
    }
    let mut all = vec![mac(bat, study, shapes)];
    if let Some(own) = shapes.common.as_ref().filter(|rows| rows.len() > 1) {
        all.push(common(bat, study, own, &shapes.sampled_common));
    }
    all.extend(on_each_other(sheet, bat, study, shapes));
    all
}

fn names(study: &Study) -> Vec<String> {
    let name = |k: &usize| {
        format!("{}, {} Hz", study.name(*k), digits(study.measured.modes[*k].frequency, 4))
    };
    study.bending.iter().map(name).collect()
}

fn mac(bat: &str, study: &Study, shapes: &Shapes) -> Picture {
    let modes = &study.solution.modes;
    matrix::picture(&Matrix {
        name: "mac".into(),
        title: "Measured shapes beside computed ones".into(),
        second: format!("{bat}: modal assurance criterion at {} points", shapes.placed.x.len()),
        sides: ["measured mode".into(), "computed mode".into()],
        rows: names(study),
        columns: modes.iter().map(|mode| mode.order.to_string()).collect(),
        values: shapes.mac.iter().map(|row| row.iter().map(|v| Some(*v)).collect()).collect(),
        scale: "MAC".into(),
    })
}

/// The measured values on and below the diagonal; above it the effect of the finite number of points.
fn common(bat: &str, study: &Study, own: &[Vec<f64>], sampled: &[Vec<Option<f64>>]) -> Picture {
    let count = own.len();
    let value = |i: usize, j: usize| if j > i { sampled[i][j] } else { Some(own[i][j]) };
    let row = |i: usize| (0..count).map(|j| value(i, j)).collect();
    // Names are too long for columns: both sides have numbers.
    let numbers = || study.bending.iter().map(|k| (k + 1).to_string());
    let numbered = |(number, name)| format!("{number}: {name}");
    matrix::picture(&Matrix {
        name: "mass_orthogonality".into(),
        title: "Mass orthogonality of the measured shapes".into(),
        second: format!("{bat}: measured below the diagonal, computed at the same points above it"),
        sides: ["mode".into(), "mode".into()],
        rows: numbers().zip(names(study)).map(numbered).collect(),
        columns: numbers().collect(),
        values: (0..count).map(row).collect(),
        scale: "share".into(),
    })
}

/// Every pair's computed curve and the measured points, scaled to it.
fn on_each_other(sheet: Sheet, bat: &str, study: &Study, shapes: &Shapes) -> Option<Picture> {
    let pairs: Vec<&Pair> = study.pairs.iter().take(MOST).collect();
    if pairs.is_empty() {
        return None;
    }
    let length = study.solution.modes[pairs[0].computed].shape.length();
    let told = |pair: &&Pair| {
        let mac = pair.mac.unwrap_or(0.0);
        format!(
            "{} on computed mode {}, MAC {mac:.3}",
            study.name(pair.measured),
            pair.computed + 1
        )
    };
    let all: Vec<String> = pairs.iter().map(told).collect();
    let alt = format!("Measured deflections as points on computed curves: {}.", all.join("; "));
    let called = ("measured_shapes", "Measured shapes on computed ones");
    let of = [bat, "the measured ones scaled to the computed"];
    let mut chart = Chart::along(sheet, called, of, ([0.0, length], &[(bat, length)]));
    chart = chart.keys(&series(study, shapes, pairs[0])).right(RIGHT);
    for pair in pairs {
        let curves = series(study, shapes, pair);
        // A little more than the largest, so that numbers of two diagrams do not meet.
        let high = 1.2 * heights(&curves).map(f64::abs).fold(1.0, f64::max);
        let panel = Panel::new(ROW, Axis::new("", [-high, high]), curves).zero();
        chart = chart.panel(panel.over(move |svg, plane| beside(svg, plane.frame, study, pair)));
    }
    Some(chart.picture(sheet, &alt))
}

/// The measured points over the scale between them and a computed curve, and that curve below them.
fn series(study: &Study, shapes: &Shapes, pair: &Pair) -> Vec<Series> {
    let shape = &study.solution.modes[pair.computed].shape;
    let at = |k: usize| shape.length() * k as f64 / POINTS as f64;
    let computed = (0..=POINTS).map(|k| Some([at(k), shape.deflection(at(k))])).collect();
    let scale = pair.scale.filter(|scale| scale.norm() > 0.0);
    let values = shapes.placed.x.iter().zip(&shapes.placed.shapes[pair.measured]);
    // Where there are very many points, neighbours coincide on paper.
    let values = values.step_by(shapes.placed.x.len().div_ceil(DRAWN));
    let measured = values.map(|(x, w)| Some([*x, (w / scale?).re])).collect();
    let computed = Series::curve("computed", 0, computed).pen(Pen::new(SERIES[0], 1.7)).untold();
    vec![Series::curve("measured", 1, measured).dots(MARKS[0]), computed]
}

/// The pair of modes, their frequencies, and the MAC.
fn beside(svg: &mut Svg, frame: Frame, study: &Study, pair: &Pair) {
    let (x, y) = (frame.right + 12.0, frame.top + 16.0);
    let room = svg.width - x - 8.0;
    let measured = &study.measured.modes[pair.measured];
    let computed = &study.solution.modes[pair.computed];
    svg.text([x, y], LABEL, &fitted(&measured.name, LABEL, room));
    let hertz = |f: f64| format!("{} Hz", digits(f, 5));
    svg.text([x, y + 17.0], SMALL, &format!("measured {}", hertz(measured.frequency)));
    svg.text([x, y + 33.0], SMALL, &format!("computed {}", hertz(computed.frequency())));
    svg.text([x, y + 49.0], SMALL, &format!("MAC {:.3}", pair.mac.unwrap_or(0.0)));
}
