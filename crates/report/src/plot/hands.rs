//! What the hands feel: displacement and velocity of the handle after a hit.

use crate::plot::axis::Axis;
use crate::plot::picture::Picture;
use crate::plot::place::along;
use crate::plot::plane::{Frame, NUMBERS, Plane, head, ticks_up};
use crate::plot::series::{Series, bats, hover, short};
use crate::plot::sheet::{Paper, Sheet, Unit};
use crate::plot::svg::{Pen, Svg};
use crate::plot::theme::{FRAME, SERIES};
use crate::plot::words::SMALL;
use sweetspot::collision::aftermath::{Aftermath, Instant};

/// Instants of a curve, and at most of all.
const INSTANTS: usize = 700;
const IN_ALL: usize = 1800;
/// Of each of the diagrams, and between them (px).
const DIAGRAM: f64 = 150.0;
const BETWEEN: f64 = 18.0;
/// What is drawn.
const KINDS: [&str; 2] = ["displacement", "velocity"];

/// What that is counted in.
fn unit_of(sheet: Sheet, kind: usize) -> Unit {
    if kind == 0 { sheet.small() } else { sheet.speed() }
}

/// A bat after a hit, and where it is held.
pub struct HandCurves<'a> {
    /// What the bat is called.
    pub name: &'a str,
    /// The bat under the ball's force.
    pub after: Aftermath<'a>,
    /// Where the hands feel it (m from the knob end).
    pub x: f64,
}

/// Displacement and velocity at the hands against time; picture `hands`. None where there is no force.
pub fn picture(sheet: Sheet, subjects: &[HandCurves]) -> Option<Picture> {
    let until = subjects.iter().map(|s| span(&s.after, s.x)).fold(0.0, f64::max);
    if until <= 0.0 {
        return None;
    }
    let instants = INSTANTS.min(IN_ALL / subjects.len());
    let times: Vec<f64> = (0..=instants).map(|k| until * k as f64 / instants as f64).collect();
    let motions: Vec<_> = subjects.iter().map(|s| motions(&s.after, s.x, &times)).collect();
    let mut svg = Svg::on(sheet);
    let title = "What the hands feel";
    let (name, facts) = words(sheet, subjects);
    head(&mut svg, title, [name, &facts]);
    let top = bats(&mut svg, &subjects.iter().map(|s| s.name).collect::<Vec<_>>()) + 14.0;
    let frame = |k: usize| {
        let top = top + 6.0 + k as f64 * (DIAGRAM + BETWEEN);
        Frame::across(sheet, [top, top + DIAGRAM])
    };
    svg.height = frame(1).bottom + NUMBERS + 4.0;
    let along = Axis::new("time since the first touch (ms)", [0.0, 1e3 * until]);
    let mut peaks = vec![];
    for (k, what) in KINDS.into_iter().enumerate() {
        let unit = unit_of(sheet, k);
        let values = || motions.iter().flatten().map(|m| unit.per * m[k + 1]);
        let y = Axis::around(what, values().chain([0.0]), ticks_up(DIAGRAM)).counted_in(unit);
        let plane = Plane { frame: frame(k), x: along.clone(), y };
        diagram(&mut svg, &plane, k, (subjects, &motions));
        let most = values().map(f64::abs).fold(0.0, f64::max);
        peaks.push(format!("{what} up to {} {}", short(most), unit.name));
    }
    match sheet.paper {
        Paper::File => svg.text([sheet.left(), frame(0).top - 6.0], SMALL, told(subjects)),
        _ => svg.facts = format!("{facts}; {}", told(subjects)),
    }
    let alt = format!("Motion of the handle in time, {name}: {facts}. {}.", peaks.join(", "));
    Some(Picture::new("hands", title, &alt, svg))
}

/// What the second line says.
fn words<'a>(sheet: Sheet, subjects: &[HandCurves<'a>]) -> (&'a str, String) {
    match subjects {
        [one] => {
            let [held, hit] = [one.x, one.after.place].map(|x| along(sheet, x));
            (one.name, format!("at {held}, hit at {hit} from the knob end"))
        }
        _ => ("", "each hit at its own sweet spot".to_owned()),
    }
}

/// What the curves are.
fn told(subjects: &[HandCurves]) -> &'static str {
    match subjects {
        [_] => {
            "against the undisturbed swing, whose way is upwards; tinted: the ball is on the bat"
        }
        _ => "against the undisturbed swing, whose way is upwards",
    }
}

/// Displacements or velocities of all bats; below the second is the axis of time.
fn diagram(
    svg: &mut Svg,
    plane: &Plane,
    kind: usize,
    (subjects, motions): (&[HandCurves], &[Vec<[f64; 3]>]),
) {
    let (what, unit) = (KINDS[kind], unit_of(svg.sheet, kind));
    if let [one] = subjects {
        plane.band(svg, [0.0, 1e3 * one.after.end()], SERIES[5]);
    }
    plane.draw(svg);
    let zero = [plane.x.from, plane.x.to].map(|t| plane.at([t, 0.0]));
    svg.line(&zero, Pen::new(FRAME, 1.2));
    let curve = |(k, (s, motions)): (usize, (&HandCurves, &Vec<[f64; 3]>))| {
        let points = motions.iter().map(|m| Some([m[0], m[kind + 1]])).collect();
        match subjects.len() {
            1 => Series::curve(what, kind, points).pen(Pen::new(SERIES[kind], 1.7)),
            _ => Series::curve(s.name, k, points),
        }
        .units("ms", unit.name)
    };
    let curves: Vec<Series> = subjects.iter().zip(motions).enumerate().map(curve).collect();
    curves.iter().rev().for_each(|curve| curve.draw(svg, plane));
    hover(svg, plane, &curves.iter().collect::<Vec<_>>());
    if kind == 1 {
        plane.below(svg);
    }
}

/// Time (ms), displacement (m) and velocity (m/s) at a place; where hardly anything moves beside the
/// place of the hit, as on a clamp, nothing does.
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

/// How long is shown (s): the touch a few times, and three swings of the first mode.
fn span(after: &Aftermath, x: f64) -> f64 {
    let touch = 5.0 * after.end();
    let slowest = after.lines(x).first().map_or(0.0, |line| 3.0 / line.frequency_hz);
    touch.max(slowest.min(40.0 * after.end()))
}
