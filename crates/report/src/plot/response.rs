//! A frequency response: size and phase over frequency, with its peaks.

use faer::c64;

use crate::plot::{
    Axis, Chart, MARKS, Panel, Pen, Picture, SERIES, Series, Sheet, Unit, along, short,
};
use crate::report::frf::{phase, unit};
use sweetspot::motion::frf::ResponseKind;
use sweetspot::motion::peaks::Peak;

/// Heights of size and phase (px).
const DIAGRAMS: [f64; 2] = [230.0, 150.0];
/// Values below that share of the largest are not drawn, because an antiresonance may be 0.
const LEAST: f64 = 1e-8;
/// Points of a curve in a picture.
const DRAWN: usize = 4000;

/// A response and its subject.
#[derive(Debug, Clone, Copy)]
pub struct ResponseCurves<'a> {
    /// Name of the bat.
    pub bat: &'a str,
    /// Deflection, velocity or acceleration.
    pub kind: ResponseKind,
    /// Position of the force (m from the knob end).
    pub at: f64,
    /// Position of the response (m from the knob end).
    pub to: f64,
    /// Rising frequencies (Hz) and the answer per force there, in SI.
    pub values: &'a [(f64, c64)],
    /// Its peaks.
    pub peaks: &'a [Peak],
    /// Measured answers to lay over it, likewise; empty without.
    pub measured: &'a [(f64, c64)],
}

/// Size and phase against frequency; a picture of that name. None without two frequencies.
pub fn picture(sheet: Sheet, subject: &ResponseCurves, name: &str) -> Option<Picture> {
    let ResponseCurves { bat, kind, at, to, values, peaks, measured } = *subject;
    let (low, high) = (values.first()?.0, values.last()?.0);
    if low >= high {
        return None;
    }
    let sizes = || values.iter().chain(measured).map(|(_, value)| value.norm());
    let most = sizes().filter(|size| size.is_finite()).fold(0.0, f64::max);
    if most <= 0.0 {
        return None;
    }
    let tops = peaks.iter().filter_map(|peak| Some(Some([peak.frequency, peak.height?])));
    let tops = Series::curve("peaks", 2, tops.collect()).dots(MARKS[0]);
    let seen = |curves: [Series; 2]| curves.into_iter().filter(|curve| !curve.points.is_empty());
    let sizes_of = [curve("measured", 1, sized(measured)), curve("computed", 0, sized(values))];
    let turns = [
        curve("phase, computed", 0, turned(values)),
        curve("phase, measured", 1, turned(measured)),
    ];
    let tops = Some(tops).filter(|tops| !tops.points.is_empty());
    let keys: Vec<Series> = seen(sizes_of).chain(tops).collect();
    let title = format!("{} over frequency", capital(kind.name()));
    let [forced, watched] = [at, to].map(|x| along(sheet, x));
    let facts = format!("force at {forced}, answer at {watched} from the knob end");
    // A number at the very end would leave a narrow picture.
    let x = Axis::new("frequency", [low, low + 1.02 * (high - low)]).counted_in(Unit::HZ);
    let drawn = sizes().filter(|size| *size >= LEAST * most).chain([most]);
    let (unit, per) = unit(kind, sheet.us);
    let size = Axis::logarithmic(kind.name(), drawn.map(|size| per * size));
    let size = size.counted_in(Unit { name: unit, per });
    let turn = Axis::of_a_turn("phase");
    let told = peaks.iter().map(|peak| {
        let height = peak.height.map_or("without bound".into(), |height| short(per * height));
        format!("mode {} at {} Hz, {height}", peak.mode, short(peak.frequency))
    });
    let told: Vec<String> = told.collect();
    let peaks = if told.is_empty() { "none".to_owned() } else { told.join("; ") };
    let alt = format!("{title} of {bat}: {facts}. Peaks ({unit}): {peaks}.");
    let chart = Chart::new(name, &title, [bat, &facts], x).keys(&keys);
    let sizes = keys.into_iter().rev().collect();
    let chart = chart.panel(Panel::new(DIAGRAMS[0], size, sizes));
    let chart = chart.panel(Panel::new(DIAGRAMS[1], turn, seen(turns).collect()));
    Some(chart.picture(sheet, &alt))
}

fn curve(name: &str, k: usize, points: Vec<Option<[f64; 2]>>) -> Series {
    Series::curve(name, k, points).pen(Pen::new(SERIES[k], 1.7 - 0.4 * k as f64))
}

/// The values, thinned to the number that a picture shows.
fn kept(values: &[(f64, c64)]) -> impl Iterator<Item = &(f64, c64)> {
    values.iter().step_by(values.len().div_ceil(DRAWN).max(1))
}

fn sized(values: &[(f64, c64)]) -> Vec<Option<[f64; 2]>> {
    kept(values).map(|(f, value)| Some([*f, value.norm()])).collect()
}

fn turned(values: &[(f64, c64)]) -> Vec<Option<[f64; 2]>> {
    unbroken(kept(values).map(|(f, value)| [*f, phase(value.re, value.im)]))
}

/// Points with a gap where the phase turns from one end to the other.
fn unbroken(points: impl Iterator<Item = [f64; 2]>) -> Vec<Option<[f64; 2]>> {
    let mut all: Vec<Option<[f64; 2]>> = vec![];
    for point in points {
        if all.last().copied().flatten().is_some_and(|last| (last[1] - point[1]).abs() > 180.0) {
            all.push(None);
        }
        all.push(Some(point));
    }
    all
}

fn capital(word: &str) -> String {
    let mut letters = word.chars();
    let first = letters.next().map(|c| c.to_uppercase().to_string()).unwrap_or_default();
    first + letters.as_str()
}
