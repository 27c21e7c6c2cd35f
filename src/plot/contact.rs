//! The touch of ball and bat: force and compression in time, and the loop that they run through.

use crate::collision::history::Moment;
use crate::collision::hitter::Hitter;
use crate::plot::axis::Axis;
use crate::plot::picture::Picture;
use crate::plot::place::{CM, tenths};
use crate::plot::plane::{Frame, HEAD, LEFT, NUMBERS, Plane, RIGHT, WIDTH, head, ticks_up};
use crate::plot::route::Point;
use crate::plot::series::{Series, digits, hover};
use crate::plot::svg::{Mark, Pen, Svg};
use crate::plot::theme::{Ink, SERIES, TEXT, TINT};
use crate::plot::words::{Anchor, LABEL};

/// Instants in every piece of the recorded force.
const PARTS: usize = 6;
/// Of each of the diagrams in time, and between them (px).
const DIAGRAM: f64 = 150.0;
const BETWEEN: f64 = 18.0;

/// Force and compression against time (`contact`), and force against compression (`hysteresis`), of a
/// hit at `x` (m); none where ball and bat do not touch in the hitter's model.
pub fn pictures(name: &str, hitter: &Hitter, x: f64) -> Vec<Picture> {
    let touch = || {
        let moments = hitter.history(x, PARTS)?;
        let lost = hitter.strike(x).outcome?.energy.dissipated_ball;
        (moments.len() > 2).then_some((moments, lost))
    };
    let Some((moments, lost)) = touch() else { return vec![] };
    let hit = format!("hit {} cm from the knob end", tenths(CM * x));
    vec![in_time([name, &hit], &moments), hysteresis([name, &hit], &moments, lost)]
}

/// Force and compression, one below the other.
fn in_time(who: [&str; 2], moments: &[Moment]) -> Picture {
    let ms = |m: &Moment| 1e3 * m.time;
    let force: Vec<_> = moments.iter().map(|m| Some([ms(m), 1e-3 * m.force])).collect();
    let pressed: Vec<_> = moments.iter().map(|m| Some([ms(m), 1e3 * m.compression])).collect();
    let end = moments.last().map_or(0.0, ms);
    let frame = |k: usize| {
        let top = HEAD + 14.0 + k as f64 * (DIAGRAM + BETWEEN);
        Frame { left: LEFT, top, right: WIDTH - RIGHT, bottom: top + DIAGRAM }
    };
    let mut svg = Svg::new(WIDTH, frame(1).bottom + NUMBERS + 4.0);
    let title = "The ball on the bat";
    let facts = format!("{}, over after {} ms", who[1], digits(end, 3));
    head(&mut svg, title, [who[0], &facts]);
    let x = Axis::new("time since the first touch (ms)", [0.0, end]);
    let mut peaks = vec![];
    for (k, points) in [force, pressed].into_iter().enumerate() {
        let (name, unit) = [("force", "kN"), ("compression", "mm")][k];
        let values = points.iter().flatten().map(|[_, v]| *v).chain([0.0]);
        let y = Axis::around(&format!("{name} ({unit})"), values, ticks_up(DIAGRAM));
        let plane = Plane { frame: frame(k), x: x.clone(), y };
        plane.draw(&mut svg);
        let peak = points.iter().flatten().fold([0.0; 2], |a, b| if b[1] > a[1] { *b } else { a });
        let words =
            format!("at most {} {unit}, after {} ms", digits(peak[1], 3), digits(peak[0], 3));
        let curve = Series::curve(name, k, points).units("ms", unit).pen(Pen::new(SERIES[k], 2.0));
        curve.draw(&mut svg, &plane);
        name_peak(&mut svg, &plane, peak, &words);
        hover(&mut svg, &plane, &[&curve]);
        if k == 1 {
            plane.below(&mut svg);
        }
        peaks.push(format!("{name} {words}"));
    }
    let alt = format!("Force and compression in time, {}: {facts}; {}.", who[0], peaks.join(", "));
    Picture::new("contact", title, &alt, svg)
}

/// A dot on a peak, and its words where the curve is low.
fn name_peak(svg: &mut Svg, plane: &Plane, peak: [f64; 2], words: &str) {
    svg.mark(Mark::Circle, plane.at(peak), 3.0, TEXT, true);
    let Frame { left, top, right, .. } = plane.frame;
    let late = plane.x.share(peak[0]) > 0.6;
    let (x, anchor) = if late { (left + 12.0, Anchor::Start) } else { (right - 8.0, Anchor::End) };
    svg.text([x, top + 16.0], LABEL.at(anchor), words);
}

/// Force against compression.
fn hysteresis(who: [&str; 2], moments: &[Moment], lost: f64) -> Picture {
    const HEIGHT: f64 = 320.0;
    let mut points: Vec<Option<[f64; 2]>> =
        moments.iter().map(|m| Some([1e3 * m.compression, 1e-3 * m.force])).collect();
    if let Some(Some([deepest, force])) = points.last().copied()
        && force > 0.0
    {
        // A ball that gives nothing back lets go at once.
        points.push(Some([deepest, 0.0]));
    }
    let top = HEAD + 14.0;
    let frame = Frame { left: LEFT, top, right: WIDTH - RIGHT, bottom: top + HEIGHT };
    let values = |k: usize| points.iter().flatten().map(move |at| at[k]).chain([0.0]);
    let x = Axis::around("compression of the ball (mm)", values(0), 11);
    let y = Axis::around("force (kN)", values(1), ticks_up(HEIGHT));
    let plane = Plane { frame, x, y };
    let mut svg = Svg::new(WIDTH, frame.bottom + NUMBERS + 4.0);
    let title = "What the ball takes and gives back";
    head(&mut svg, title, who);
    plane.draw(&mut svg);
    let around: Vec<Point> = points.iter().flatten().map(|at| plane.at(*at)).collect();
    svg.area(&around, SERIES[1], TINT, None);
    let curve = Series::curve("ball", 0, points).units("mm", "kN");
    curve.draw(&mut svg, &plane);
    arrows(&mut svg, &around, SERIES[0]);
    let lost = match digits(lost, 3).as_str() {
        "0" => "nothing is lost in the ball".to_owned(),
        joules => format!("lost in the ball: {joules} J, the area inside"),
    };
    svg.text([LEFT + 24.0, top + 30.0], LABEL, &lost);
    plane.below(&mut svg);
    hover(&mut svg, &plane, &[&curve]);
    let alt = format!(
        "Force against the ball's compression, up and back down, {}, {}: {lost}.",
        who[0], who[1]
    );
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
