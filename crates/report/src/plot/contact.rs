//! The touch of ball and bat: force and compression in time, and the loop that they run through.

use std::borrow::Cow;

use crate::plot::axis::Axis;
use crate::plot::picture::Picture;
use crate::plot::place::{along, mark};
use crate::plot::plane::{Frame, NUMBERS, Plane, head, ticks_up};
use crate::plot::route::Point;
use crate::plot::series::{Series, bats, digits, hover};
use crate::plot::sheet::{Sheet, Unit};
use crate::plot::svg::{Mark, Pen, Svg};
use crate::plot::theme::{Ink, SERIES, TEXT, TINT};
use crate::plot::words::SMALL;
use sweetspot::collision::history::Moment;
use sweetspot::collision::hitter::Hitter;

/// Instants in every piece of the recorded force.
const PARTS: usize = 6;
/// Of each of the diagrams in time, and between them (px).
const DIAGRAM: f64 = 150.0;
const BETWEEN: f64 = 32.0;

/// A hit in time, and what the bat is called.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactCurves<'a> {
    /// What the bat is called.
    pub name: &'a str,
    /// Where it is hit (m from the knob end).
    pub x: f64,
    /// The ball from the first touch to the last.
    pub moments: Vec<Moment>,
    /// What is lost in the ball (J).
    pub lost: f64,
}

impl<'a> ContactCurves<'a> {
    /// The hit at `x` (m); None where ball and bat do not touch in the hitter's model.
    pub fn new(name: &'a str, hitter: &Hitter, x: f64) -> Option<Self> {
        let moments = hitter.history(x, PARTS)?;
        let lost = hitter.strike(x).outcome?.energy.dissipated_ball;
        (moments.len() > 2).then_some(Self { name, x, moments, lost })
    }

    /// When the ball leaves (ms).
    fn end(&self) -> f64 {
        self.moments.last().map_or(0.0, |moment| 1e3 * moment.time)
    }
}

/// Force and compression against time (`contact`), and force against compression (`hysteresis`); none
/// without a hit.
pub fn pictures(sheet: Sheet, subjects: &[ContactCurves]) -> Vec<Picture> {
    match subjects {
        [] => vec![],
        _ => vec![in_time(sheet, subjects), hysteresis(sheet, subjects)],
    }
}

/// What a picture's second line says: of one bat where it is hit, of several that each is hit at its
/// own place.
fn second<'a>(sheet: Sheet, subjects: &[ContactCurves<'a>]) -> [Cow<'a, str>; 2] {
    match subjects {
        [one] => [one.name.into(), format!("hit {} from the knob end", along(sheet, one.x)).into()],
        _ => ["".into(), "each hit at its own sweet spot".into()],
    }
}

/// The names of several bats and where each is hit; where they end (px).
fn names(svg: &mut Svg, subjects: &[ContactCurves]) -> f64 {
    let sheet = svg.sheet;
    let name = |s: &ContactCurves| format!("{}, {}", s.name, along(sheet, s.x));
    let names: Vec<String> = subjects.iter().map(name).collect();
    bats(svg, &names.iter().map(String::as_str).collect::<Vec<_>>())
}

/// Force and compression, one below the other.
fn in_time(sheet: Sheet, subjects: &[ContactCurves]) -> Picture {
    let mut svg = Svg::on(sheet);
    let title = "The ball on the bat";
    let end = subjects.iter().map(ContactCurves::end).fold(0.0, f64::max);
    let [name, mut facts] = second(sheet, subjects);
    if subjects.len() == 1 {
        facts = format!("{facts}, over after {} ms", digits(end, 3)).into();
    }
    head(&mut svg, title, [&name, &facts]);
    let top = names(&mut svg, subjects) + 20.0;
    let frame = |k: usize| {
        let top = top + k as f64 * (DIAGRAM + BETWEEN);
        Frame::across(sheet, [top, top + DIAGRAM])
    };
    svg.height = frame(1).bottom + NUMBERS + 4.0;
    let x = Axis::new("time since the first touch (ms)", [0.0, end]);
    let force = diagram(&mut svg, (frame(0), &x), subjects, ("force", sheet.force(), |m| m.force));
    let of = ("compression", sheet.small(), (|m| m.compression) as fn(&Moment) -> f64);
    let pressed = diagram(&mut svg, (frame(1), &x), subjects, of);
    Plane { frame: frame(1), x, y: Axis::new("", [0.0, 1.0]) }.below(&mut svg);
    let alt = format!("Force and compression in time, {name}: {facts}; {force}, {pressed}.");
    Picture::new("contact", title, &alt, svg)
}

/// One quantity of all bats in time; its peaks in words.
fn diagram(
    svg: &mut Svg,
    (frame, x): (Frame, &Axis),
    subjects: &[ContactCurves],
    (what, unit, of): (&str, Unit, fn(&Moment) -> f64),
) -> String {
    let alone = subjects.len() == 1;
    let curve = |(k, s): (usize, &ContactCurves)| {
        let points = s.moments.iter().map(|m| Some([1e3 * m.time, of(m)])).collect();
        let series =
            Series::curve(if alone { what } else { s.name }, k, points).units("ms", unit.name);
        // A single bat's two diagrams have two colours.
        if alone && what != "force" { series.pen(Pen::new(SERIES[1], 2.0)) } else { series }
    };
    let curves: Vec<Series> = subjects.iter().enumerate().map(curve).collect();
    let values = curves.iter().flat_map(|c| c.points.iter().flatten().map(|[_, v]| *v));
    let values = values.map(|v| unit.per * v).chain([0.0]);
    let y = Axis::around(what, values, ticks_up(DIAGRAM)).counted_in(unit);
    let plane = Plane { frame, x: x.clone(), y };
    plane.draw(svg);
    let mut told = vec![];
    for (k, curve) in curves.iter().enumerate() {
        curve.draw(svg, &plane);
        let peak =
            curve.points.iter().flatten().fold([0.0; 2], |a, b| if b[1] > a[1] { *b } else { a });
        let words = format!(
            "at most {} {}, after {} ms",
            digits(unit.per * peak[1], 3),
            unit.name,
            digits(peak[0], 3)
        );
        if alone {
            svg.mark(Mark::Circle, plane.at(peak), 3.0, TEXT, true);
            svg.text([frame.left, frame.top - 8.0], SMALL, &words);
        } else {
            mark(svg, k, plane.at(peak));
        }
        told.push(format!("{} {words}", curve.name));
    }
    hover(svg, &plane, &curves.iter().collect::<Vec<_>>());
    if alone { told.concat() } else { format!("{what}: {}", told.join(", ")) }
}

/// Force against compression.
fn hysteresis(sheet: Sheet, subjects: &[ContactCurves]) -> Picture {
    const HEIGHT: f64 = 320.0;
    let mut svg = Svg::on(sheet);
    let title = "What the ball takes and gives back";
    let ([name, facts], lost) = (second(sheet, subjects), lost(sheet.energy(), subjects));
    let alone = subjects.len() == 1;
    let told = format!("{facts}; {lost}");
    head(&mut svg, title, [&name, if alone { &facts } else { &told }]);
    let top = names(&mut svg, subjects) + 20.0;
    let frame = Frame::across(sheet, [top, top + HEIGHT]);
    svg.height = frame.bottom + NUMBERS + 4.0;
    let (squeeze, force) = (sheet.small(), sheet.force());
    let curve = |(k, s)| Series::curve("ball", k, around(s)).units(squeeze.name, force.name);
    let curves: Vec<Series> = subjects.iter().enumerate().map(curve).collect();
    let points = || curves.iter().flat_map(|c| c.points.iter().flatten());
    let values = |k: usize, unit: Unit| points().map(move |at| unit.per * at[k]).chain([0.0]);
    let x = Axis::around("compression of the ball", values(0, squeeze), 11).counted_in(squeeze);
    let y = Axis::around("force", values(1, force), ticks_up(HEIGHT)).counted_in(force);
    let plane = Plane { frame, x, y };
    plane.draw(&mut svg);
    for curve in &curves {
        let around: Vec<Point> = curve.points.iter().flatten().map(|at| plane.at(*at)).collect();
        if alone {
            svg.area(&around, SERIES[1], TINT, None);
        }
        curve.draw(&mut svg, &plane);
        arrows(&mut svg, &around, curve.pen.ink);
    }
    if alone {
        svg.text([frame.left, top - 8.0], SMALL, &lost);
    }
    plane.below(&mut svg);
    hover(&mut svg, &plane, &curves.iter().collect::<Vec<_>>());
    let alt =
        format!("Force against the ball's compression, up and back down, {name}, {facts}: {lost}.");
    Picture::new("hysteresis", title, &alt, svg)
}

/// The loop of a hit: compression (m) and force (N).
fn around(subject: &ContactCurves) -> Vec<Option<[f64; 2]>> {
    let at = |m: &Moment| [m.compression, m.force];
    let last = subject.moments.last().map(at).filter(|[_, force]| *force > 0.0);
    // A ball that gives nothing back lets go at once.
    let end = last.map(|[deepest, _]| [deepest, 0.0]);
    subject.moments.iter().map(at).chain(end).map(Some).collect()
}

/// What is lost in the ball, bat by bat.
fn lost(unit: Unit, subjects: &[ContactCurves]) -> String {
    let energies: Vec<String> = subjects.iter().map(|s| digits(unit.per * s.lost, 3)).collect();
    if energies.iter().all(|energy| energy == "0") {
        "nothing is lost in the ball".to_owned()
    } else {
        format!("lost in the ball: {} {}, the area inside", energies.join(", "), unit.name)
    }
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
