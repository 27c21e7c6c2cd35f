//! The wood of a bat before and after the measurements, and the readings that do not fit.

use crate::plot::{Axis, Bar, BarRow, MUTED, Pen, Picture, SERIES, TEXT, bars};
use crate::report::calibrate::{short, shown};
use sweetspot_study::calibrate::calibration::{Calibration, Estimated, NINETY_FIVE};
use sweetspot_study::calibrate::fit::{OUTLIER, Residual};

/// Both pictures; the second only where something was measured.
pub fn pictures(name: &str, found: &Calibration) -> Vec<Picture> {
    let mut all = vec![wood(name, &found.parameters)];
    if !found.data.is_empty() {
        all.push(residuals(name, &found.data));
    }
    all
}

/// The 95 % intervals of all properties before and after; picture `wood`.
fn wood(name: &str, parameters: &[Estimated]) -> Picture {
    let row = |one: &Estimated| {
        let (centre, by) = (one.prior / one.value, NINETY_FIVE * one.prior_relative_sd);
        let before = [-1.0, 1.0].map(|sign| centre * (sign * by).exp());
        let after = one.interval95.map(|end| end / one.value);
        let label = format!("{} {}", short(one.property), shown(one.property, one.value));
        let [low, high] = after.map(|end| format!("{:+.1} %", 100.0 * (end - 1.0)));
        let told = (1.0, format!("{label}, 95 % from {low} to {high}"));
        let bar = |ends, opacity| Bar { ends, high: 1.0, look: (SERIES[0], opacity) };
        let bars = vec![bar(before, 0.3), bar(after, 0.9)];
        BarRow { label, bars, spans: vec![], dot: None, told }
    };
    let rows: Vec<BarRow> = parameters.iter().map(row).collect();
    let values = rows.iter().flat_map(|row| row.bars.iter().flat_map(|bar| bar.ends));
    let x = Axis::around("over what was found", values, 9);
    let facts = "95 of 100 cases: light before, dark after; the line is what was found";
    let called = ("wood", "What the readings say of the wood", [name, facts]);
    bars::picture(called, x, (&rows, &[(1.0, Pen::new(TEXT, 1.2))]), name)
}

/// The deviation of each reading from the prediction of all others; picture `readings`.
fn residuals(name: &str, all: &[Residual]) -> Picture {
    let row = |one: &Residual| {
        let label = one.datum.kind.name();
        let ink = if one.is_outlier() { SERIES[1] } else { SERIES[0] };
        let ends = [one.left_out_sd.min(0.0), one.left_out_sd.max(0.0)];
        let told =
            format!("{label}: {:+.1}, from all others {:+.1}", one.residual_sd, one.left_out_sd);
        let (bars, dot) = (vec![Bar { ends, high: 1.0, look: (ink, 0.7) }], Some(one.residual_sd));
        BarRow { label, bars, spans: vec![], dot, told: (one.left_out_sd, told) }
    };
    let rows: Vec<BarRow> = all.iter().map(row).collect();
    let values = all.iter().flat_map(|one| [one.left_out_sd, one.residual_sd]);
    let x = Axis::around("standard deviations", values.chain([-4.0, 4.0]), 9);
    let limit = Pen::new(MUTED, 1.2).dashed("5 3");
    let lines = [(0.0, Pen::new(TEXT, 1.2)), (-OUTLIER, limit), (OUTLIER, limit)];
    let facts =
        "measured less computed; circle: with it, bar: from all others; beyond 3 it does not fit";
    let called = ("readings", "Which readings fit", [name, facts]);
    bars::picture(called, x, (&rows, &lines), name)
}
