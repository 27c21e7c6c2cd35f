//! What the hands feel: displacement and velocity of the handle after a hit.

use crate::collision::aftermath::{Aftermath, Instant};
use crate::plot::axis::Axis;
use crate::plot::picture::Picture;
use crate::plot::place::{CM, tenths};
use crate::plot::plane::{Frame, HEAD, LEFT, NUMBERS, Plane, RIGHT, WIDTH, head, ticks_up};
use crate::plot::series::{Series, hover, short};
use crate::plot::svg::{Pen, Svg};
use crate::plot::theme::{FRAME, SERIES};
use crate::plot::words::SMALL;

/// Instants of the curves.
const INSTANTS: usize = 700;
/// Of each of the diagrams, and between them (px).
const DIAGRAM: f64 = 150.0;
const BETWEEN: f64 = 18.0;
/// What is drawn, and its unit.
const KINDS: [(&str, &str); 2] = [("displacement", "mm"), ("velocity", "m/s")];

/// Displacement and velocity at `x` (m) against time; picture `hands`. None where there is no force.
pub fn picture(name: &str, after: &Aftermath, x: f64) -> Option<Picture> {
    let until = span(after, x);
    if until <= 0.0 {
        return None;
    }
    let times: Vec<f64> = (0..=INSTANTS).map(|k| until * k as f64 / INSTANTS as f64).collect();
    let motions = motions(after, x, &times);
    let frame = |k: usize| {
        let top = HEAD + 20.0 + k as f64 * (DIAGRAM + BETWEEN);
        Frame { left: LEFT, top, right: WIDTH - RIGHT, bottom: top + DIAGRAM }
    };
    let mut svg = Svg::new(WIDTH, frame(1).bottom + NUMBERS + 4.0);
    let title = "What the hands feel";
    let facts =
        format!("{} cm from the knob end, hit at {} cm", tenths(CM * x), tenths(CM * after.place));
    head(&mut svg, title, [name, &facts]);
    let along = Axis::new("time since the first touch (ms)", [0.0, 1e3 * until]);
    let mut peaks = vec![];
    for k in 0..2 {
        let (name, unit) = KINDS[k];
        let values = || motions.iter().map(|m| m[k + 1]);
        let label = format!("{name} ({unit})");
        let y = Axis::around(&label, values().chain([0.0]), ticks_up(DIAGRAM));
        let plane = Plane { frame: frame(k), x: along.clone(), y };
        plane.band(&mut svg, [0.0, 1e3 * after.end()], SERIES[5]);
        diagram(&mut svg, &plane, (k, &motions));
        let most = values().map(f64::abs).fold(0.0, f64::max);
        peaks.push(format!("{name} up to {} {unit}", short(most)));
    }
    let told = "tinted: the ball is on the bat; upwards is the way of the swing";
    svg.text([LEFT, frame(0).top - 6.0], SMALL, told);
    let alt = format!("Motion of the handle in time, {name}: {facts}. {}.", peaks.join(", "));
    Some(Picture::new("hands", title, &alt, svg))
}

/// One of the two curves; below the second is the axis of time.
fn diagram(svg: &mut Svg, plane: &Plane, (k, motions): (usize, &[[f64; 3]])) {
    plane.draw(svg);
    let zero = [plane.x.from, plane.x.to].map(|t| plane.at([t, 0.0]));
    svg.line(&zero, Pen::new(FRAME, 1.2));
    let points: Vec<_> = motions.iter().map(|m| Some([m[0], m[k + 1]])).collect();
    let curve = Series::curve(KINDS[k].0, k, points).units("ms", KINDS[k].1);
    let curve = curve.pen(Pen::new(SERIES[k], 1.7));
    curve.draw(svg, plane);
    hover(svg, plane, &[&curve]);
    if k == 1 {
        plane.below(svg);
    }
}

/// Time (ms), displacement (mm) and velocity (m/s) at a place; where hardly anything moves beside the
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
        [1e3 * now.time, 1e3 * moved, speed]
    };
    instants.iter().map(motion).collect()
}

/// How long is shown (s): the touch a few times, and three swings of the first mode.
fn span(after: &Aftermath, x: f64) -> f64 {
    let touch = 5.0 * after.end();
    let slowest = after.lines(x).first().map_or(0.0, |line| 3.0 / line.frequency);
    touch.max(slowest.min(40.0 * after.end()))
}
