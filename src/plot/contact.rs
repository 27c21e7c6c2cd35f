//! The touch of ball and bat: force and compression in time, and the loop that they run through.

use crate::collision::history::{Moment, history};
use crate::collision::hitter::Hitter;
use crate::plot::axis::Axis;
use crate::plot::picture::Picture;
use crate::plot::place::CM;
use crate::plot::plane::{Frame, HEAD, LEFT, NUMBERS, Plane, RIGHT, WIDTH, head};
use crate::plot::series::{Series, short};
use crate::plot::svg::{Pen, Point, Svg};
use crate::plot::theme::{Ink, SERIES, TINT};

/// Instants in every piece of the recorded force.
const PARTS: usize = 6;
/// Of each of the diagrams in time, and between them (px).
const DIAGRAM: f64 = 150.0;
const BETWEEN: f64 = 18.0;

/// Force and compression against time (`contact`), and force against compression (`hysteresis`), of a
/// hit at `x` (m); none where ball and bat do not touch in the hitter's model.
pub fn pictures(name: &str, hitter: &Hitter, x: f64) -> Vec<Picture> {
    let touch = || {
        let moments = history(&hitter.force(x)?, &hitter.law(x)?, PARTS);
        let lost = hitter.strike(x).outcome?.energy.dissipated_ball;
        (moments.len() > 2).then_some((moments, lost))
    };
    let Some((moments, lost)) = touch() else { return vec![] };
    let who = format!("{name}, hit {:.1} cm from the knob end", CM * x);
    vec![in_time(&who, &moments), hysteresis(&who, &moments, lost)]
}

/// Force and compression, one below the other.
fn in_time(who: &str, moments: &[Moment]) -> Picture {
    let ms = |m: &Moment| 1e3 * m.time;
    let force: Vec<_> = moments.iter().map(|m| Some([ms(m), 1e-3 * m.force])).collect();
    let pressed: Vec<_> = moments.iter().map(|m| Some([ms(m), 1e3 * m.compression])).collect();
    let end = moments.last().map_or(0.0, ms);
    let top = HEAD + 8.0;
    let frame = |k: usize| {
        let top = top + k as f64 * (DIAGRAM + BETWEEN);
        Frame { left: LEFT, top, right: WIDTH - RIGHT, bottom: top + DIAGRAM }
    };
    let mut svg = Svg::new(WIDTH, frame(1).bottom + NUMBERS + 4.0);
    let title = "The ball on the bat";
    let [most, deepest] =
        [largest(moments, |m| 1e-3 * m.force), largest(moments, |m| 1e3 * m.compression)];
    let second = format!(
        "{who}: {} kN at most, {} mm deep, over after {} ms",
        short(most[1]),
        short(deepest[1]),
        short(end)
    );
    head(&mut svg, title, &second);
    let x = Axis::new("time since the first touch (ms)", [0.0, end]);
    for (k, (label, points)) in
        [("force (kN)", force), ("compression (mm)", pressed)].into_iter().enumerate()
    {
        let values = points.iter().flatten().map(|[_, v]| *v).chain([0.0]);
        let y = Axis::around(label, values, 6);
        let plane = Plane { frame: frame(k), x: x.clone(), y };
        plane.draw(&mut svg);
        let (name, unit) = [("force", "kN"), ("compression", "mm")][k];
        let curve = Series::curve(name, k, points).units("ms", unit);
        let curve = curve.pen(Pen::new(SERIES[k], 2.0));
        curve.draw(&mut svg, &plane);
        curve.hover(&mut svg, &plane);
        if k == 1 {
            plane.below(&mut svg);
        }
    }
    Picture::new("contact", title, &format!("Force and compression in time. {second}."), svg)
}

/// The instant (its time in ms) and the value where that is largest.
fn largest(moments: &[Moment], of: impl Fn(&Moment) -> f64) -> [f64; 2] {
    let all = moments.iter().map(|m| [1e3 * m.time, of(m)]);
    all.fold([0.0; 2], |most, at| if at[1] > most[1] { at } else { most })
}

/// Force against compression.
fn hysteresis(who: &str, moments: &[Moment], lost: f64) -> Picture {
    const HEIGHT: f64 = 320.0;
    let mut points: Vec<Option<[f64; 2]>> =
        moments.iter().map(|m| Some([1e3 * m.compression, 1e-3 * m.force])).collect();
    if let Some(Some([deepest, force])) = points.last().copied()
        && force > 0.0
    {
        // A ball that gives nothing back lets go at once.
        points.push(Some([deepest, 0.0]));
    }
    let top = HEAD + 8.0;
    let frame = Frame { left: LEFT, top, right: WIDTH - RIGHT, bottom: top + HEIGHT };
    let values = |k: usize| points.iter().flatten().map(move |at| at[k]).chain([0.0]);
    let x = Axis::around("compression of the ball (mm)", values(0), 10);
    let y = Axis::around("force (kN)", values(1), 8);
    let plane = Plane { frame, x, y };
    let mut svg = Svg::new(WIDTH, frame.bottom + NUMBERS + 4.0);
    let title = "What the ball takes and gives back";
    let second = format!("{who}: the area inside is lost in the ball, {} J", short(lost));
    head(&mut svg, title, &second);
    plane.draw(&mut svg);
    let around: Vec<Point> = points.iter().flatten().map(|at| plane.at(*at)).collect();
    svg.area(&around, SERIES[1], TINT, None);
    let curve = Series::curve("ball", 0, points).units("mm", "kN");
    curve.draw(&mut svg, &plane);
    arrows(&mut svg, &around, SERIES[0]);
    plane.below(&mut svg);
    curve.hover(&mut svg, &plane);
    let alt = format!("Force against the ball's compression, up and back down. {second}.");
    Picture::new("hysteresis", title, &alt, svg)
}

/// Heads of arrows half the way up and half the way down.
fn arrows(svg: &mut Svg, points: &[Point], ink: Ink) {
    let height = |k: usize| points[k][1];
    let Some(peak) = (0..points.len()).min_by(|a, b| height(*a).total_cmp(&height(*b))) else {
        return;
    };
    let half = 0.5 * (height(0) + height(peak));
    let up = (0..peak).find(|k| height(*k) <= half);
    let down = (peak..points.len()).find(|k| height(*k) >= half);
    for at in [up, down].into_iter().flatten().filter(|k| *k > 0 && *k < points.len()) {
        let ([a, b], [c, d]) = (points[at - 1], points[at]);
        let length = (c - a).hypot(d - b);
        if length > 0.0 {
            let [x, y] = [(c - a) / length, (d - b) / length];
            let side = |by: f64| [c - 10.0 * x - by * y, d - 10.0 * y + by * x];
            svg.area(&[[c + 4.0 * x, d + 4.0 * y], side(5.5), side(-5.5)], ink, 1.0, None);
        }
    }
}
