//! The motion that the hands feel: displacement and velocity of the handle after a hit.

use crate::plot::{
    Axis, Chart, Panel, Paper, Pen, Picture, SERIES, Series, Sheet, Unit, along, bats, heights,
    short,
};
use sweetspot::collision::aftermath::{Aftermath, Instant};

/// Instants of a curve, and at most of all.
const INSTANTS: usize = 700;
const IN_ALL: usize = 1800;
/// Height of each of the diagrams (px).
const DIAGRAM: f64 = 150.0;
/// The quantities drawn.
const KINDS: [&str; 2] = ["displacement", "velocity"];

/// A bat after a hit, and where it is held.
pub struct HandCurves<'a> {
    /// Name of the bat.
    pub name: &'a str,
    /// The bat under the ball's force.
    pub after: Aftermath<'a>,
    /// Position at which the hands feel it (m from the knob end).
    pub x: f64,
}

/// Displacement and velocity at the hands against time; picture `hands`. None without a force.
pub fn picture(sheet: Sheet, subjects: &[HandCurves]) -> Option<Picture> {
    let until = subjects.iter().map(|s| span(&s.after, s.x)).fold(0.0, f64::max);
    if until <= 0.0 {
        return None;
    }
    let instants = INSTANTS.min(IN_ALL / subjects.len());
    let times: Vec<f64> = (0..=instants).map(|k| until * k as f64 / instants as f64).collect();
    let motions: Vec<_> = subjects.iter().map(|s| motions(&s.after, s.x, &times)).collect();
    let (name, mut facts) = words(sheet, subjects);
    let (note, band) = told(subjects);
    let alt = format!("Motion of the handle in time, {name}: {facts}.");
    let note = if sheet.paper == Paper::File { note } else { "" };
    if note.is_empty() {
        facts = format!("{facts}; {}", told(subjects).0);
    }
    let x = Axis::new("time since the first touch", [0.0, 1e3 * until]).counted_in(Unit::MS);
    let names: Vec<&str> = subjects.iter().map(|s| s.name).collect();
    let mut chart =
        Chart::new("hands", "What the hands feel", [name, &facts], x).keys(&bats(&names));
    let mut peaks = vec![];
    for (kind, what) in KINDS.into_iter().enumerate() {
        let unit = if kind == 0 { sheet.small() } else { sheet.speed() };
        let curves = curves(kind, subjects, &motions);
        let most = heights(&curves).map(|value| (unit.per * value).abs()).fold(0.0, f64::max);
        peaks.push(format!("{what} up to {} {}", short(most), unit.name));
        let panel = Panel::around(DIAGRAM, (what, unit), curves, &[0.0]).zero();
        let panel = panel.band(band, SERIES[5]).note(if kind == 0 { note } else { "" });
        chart = chart.panel(panel);
    }
    Some(chart.picture(sheet, &format!("{alt} {}.", peaks.join(", "))))
}

/// The second line of the picture.
fn words<'a>(sheet: Sheet, subjects: &[HandCurves<'a>]) -> (&'a str, String) {
    match subjects {
        [one] => {
            let [held, hit] = [one.x, one.after.place].map(|x| along(sheet, x));
            (one.name, format!("at {held}, hit at {hit} from the knob end"))
        }
        _ => ("", "each hit at its own sweet spot".to_owned()),
    }
}

/// The description of the curves, and the time of contact for a single bat (ms).
fn told(subjects: &[HandCurves]) -> (&'static str, Option<[f64; 2]>) {
    match subjects {
        [one] => (
            "against the undisturbed swing, whose way is upwards; tinted: the ball is on the bat",
            Some([0.0, 1e3 * one.after.end()]),
        ),
        _ => ("against the undisturbed swing, whose way is upwards", None),
    }
}

/// Displacements or velocities of all bats.
fn curves(kind: usize, subjects: &[HandCurves], motions: &[Vec<[f64; 3]>]) -> Vec<Series> {
    let curve = |(k, (s, motions)): (usize, (&HandCurves, &Vec<[f64; 3]>))| {
        let points = motions.iter().map(|m| Some([m[0], m[kind + 1]])).collect();
        match subjects.len() {
            1 => Series::curve(KINDS[kind], kind, points).pen(Pen::new(SERIES[kind], 1.7)),
            _ => Series::curve(s.name, k, points),
        }
    };
    subjects.iter().zip(motions).enumerate().map(curve).collect()
}

/// Time (ms), displacement (m) and velocity (m/s) at a place. A motion that is negligible relative to that at the
/// impact, as on a clamp, is set to 0.
fn motions(after: &Aftermath, x: f64, times: &[f64]) -> Vec<[f64; 3]> {
    const NOTHING: f64 = 1e-9;
    let instants = after.at(times);
    let speed = |x: f64| {
        let speeds = instants.iter().map(|now| after.motion(x, now)[1].abs());
        speeds.fold(0.0, f64::max)
    };
    let still = speed(x) <= NOTHING * speed(after.place);
    let motion = |now: &Instant| {
        let [moved, speed, _] = if still { [0.0; 3] } else { after.motion(x, now) };
        [1e3 * now.time, moved, speed]
    };
    instants.iter().map(motion).collect()
}

/// The time shown (s): a few times the contact and three periods of the first mode.
fn span(after: &Aftermath, x: f64) -> f64 {
    let touch = 5.0 * after.end();
    let slowest = after.lines(x).first().map_or(0.0, |line| 3.0 / line.frequency_hz);
    touch.max(slowest.min(40.0 * after.end()))
}
