//! The touch of ball and bat: force and compression in time, and the loop that they run through.

use std::borrow::Cow;

use crate::plot::place::mark;
use crate::plot::{
    Axis, Chart, Ink, Mark, Panel, Pen, Picture, Point, SERIES, Series, Sheet, Svg, TEXT, TINT,
    Unit, along, bats, digits,
};
use sweetspot::collision::Hitter;
use sweetspot::collision::history::Moment;

/// Instants in every piece of the recorded force.
const PARTS: usize = 6;
/// Height of each of the diagrams in time (px).
const DIAGRAM: f64 = 150.0;

/// A hit in time, with the name of the bat.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactCurves<'a> {
    /// Name of the bat.
    pub name: &'a str,
    /// Position of the impact (m from the knob end).
    pub x: f64,
    /// The ball from the first touch to the last.
    pub moments: Vec<Moment>,
    /// Energy lost in the ball (J).
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

/// Force and compression against time (`contact`), and force against compression (`hysteresis`); none without a hit.
pub fn pictures(sheet: Sheet, subjects: &[ContactCurves]) -> Vec<Picture> {
    match subjects {
        [] => vec![],
        _ => vec![in_time(sheet, subjects), hysteresis(sheet, subjects)],
    }
}

/// The second line of a picture: the position of the impact for one bat, and for several that each has its own
/// position.
fn second<'a>(sheet: Sheet, subjects: &[ContactCurves<'a>]) -> [Cow<'a, str>; 2] {
    match subjects {
        [one] => [one.name.into(), format!("hit {} from the knob end", along(sheet, one.x)).into()],
        _ => ["".into(), "each hit at its own sweet spot".into()],
    }
}

/// The names of several bats and where each is hit.
fn keys(sheet: Sheet, subjects: &[ContactCurves]) -> Vec<Series> {
    let name = |s: &ContactCurves| format!("{}, {}", s.name, along(sheet, s.x));
    bats(&subjects.iter().map(name).collect::<Vec<_>>())
}

/// Force and compression, one below the other.
fn in_time(sheet: Sheet, subjects: &[ContactCurves]) -> Picture {
    let end = subjects.iter().map(ContactCurves::end).fold(0.0, f64::max);
    let [name, mut facts] = second(sheet, subjects);
    if subjects.len() == 1 {
        facts = format!("{facts}, over after {} ms", digits(end, 3)).into();
    }
    let x = Axis::new("time since the first touch", [0.0, end]).counted_in(Unit::MS);
    let (force, pushed) = diagram(subjects, 0, ("force", sheet.force(), |m| m.force));
    let (squeeze, pressed) =
        diagram(subjects, 1, ("compression", sheet.small(), |m| m.compression));
    let alt = format!("Force and compression in time, {name}: {facts}; {pushed}, {pressed}.");
    let chart = Chart::new("contact", "The ball on the bat", [&name, &facts], x);
    let chart = chart.keys(&keys(sheet, subjects)).panel(force).panel(squeeze);
    chart.picture(sheet, &alt)
}

/// One quantity of all bats in time; its peaks in words.
fn diagram<'a>(
    subjects: &[ContactCurves],
    row: usize,
    (what, unit, of): (&str, Unit, fn(&Moment) -> f64),
) -> (Panel<'a>, String) {
    let alone = subjects.len() == 1;
    let curve = |(k, s): (usize, &ContactCurves)| {
        let points = s.moments.iter().map(|m| Some([1e3 * m.time, of(m)])).collect();
        // A single bat's two diagrams have two colours.
        match alone {
            true => Series::curve(what, row, points).pen(Pen::new(SERIES[row], 2.0)),
            false => Series::curve(s.name, k, points),
        }
    };
    let curves: Vec<Series> = subjects.iter().enumerate().map(curve).collect();
    let peak = |curve: &Series| {
        let points = curve.points.iter().flatten();
        points.fold([0.0; 2], |a, b| if b[1] > a[1] { *b } else { a })
    };
    let peaks: Vec<[f64; 2]> = curves.iter().map(peak).collect();
    let words = |[time, value]: [f64; 2]| {
        let [value, time] = [digits(unit.per * value, 3), digits(time, 3)];
        format!("at most {value} {}, after {time} ms", unit.name)
    };
    let told = curves.iter().zip(&peaks).map(|(c, peak)| format!("{} {}", c.name, words(*peak)));
    let told = told.collect::<Vec<_>>().join(", ");
    // Dashes on a whole line are seen.
    let curves = curves.into_iter().rev().collect();
    let panel = Panel::around(DIAGRAM, (what, unit), curves, &[0.0]);
    match peaks[..] {
        [peak] => {
            let panel = panel.note(&words(peak)).over(move |svg, plane| {
                svg.mark(Mark::Circle, plane.at(peak), 3.0, TEXT, true);
            });
            (panel, told)
        }
        _ => {
            let panel = panel.over(move |svg, plane| {
                peaks.iter().enumerate().for_each(|(k, peak)| mark(svg, k, plane.at(*peak)));
            });
            (panel, format!("{what}: {told}"))
        }
    }
}

/// Force against compression.
fn hysteresis(sheet: Sheet, subjects: &[ContactCurves]) -> Picture {
    const HEIGHT: f64 = 320.0;
    let ([name, facts], lost) = (second(sheet, subjects), lost(sheet.energy(), subjects));
    let alone = subjects.len() == 1;
    let curve = |(k, s)| {
        let curve = Series::curve("ball", k, around(s));
        if alone { curve.filled(SERIES[1], TINT) } else { curve }
    };
    let curves: Vec<Series> = subjects.iter().enumerate().map(curve).collect();
    let squeezed = curves.iter().flat_map(|c| c.points.iter().flatten()).map(|at| at[0]);
    let x = Axis::measured("compression of the ball", sheet.small(), squeezed.chain([0.0]), 11);
    let alt =
        format!("Force against the ball's compression, up and back down, {name}, {facts}: {lost}.");
    let told = if alone { facts } else { format!("{facts}; {lost}").into() };
    let loops = curves.clone();
    let curves = curves.into_iter().rev().collect();
    let panel = Panel::around(HEIGHT, ("force", sheet.force()), curves, &[0.0]);
    let panel = panel.note(if alone { &lost } else { "" }).over(|svg, plane| {
        for curve in &loops {
            let points = curve.points.iter().flatten();
            arrows(svg, &points.map(|at| plane.at(*at)).collect::<Vec<_>>(), curve.pen.ink);
        }
    });
    let title = "What the ball takes and gives back";
    let chart = Chart::new("hysteresis", title, [&name, &told], x).keys(&keys(sheet, subjects));
    chart.panel(panel).picture(sheet, &alt)
}

/// The loop of a hit: compression (m) and force (N).
fn around(subject: &ContactCurves) -> Vec<Option<[f64; 2]>> {
    let at = |m: &Moment| [m.compression, m.force];
    let last = subject.moments.last().map(at).filter(|[_, force]| *force > 0.0);
    // A ball without restitution separates at once.
    let end = last.map(|[deepest, _]| [deepest, 0.0]);
    subject.moments.iter().map(at).chain(end).map(Some).collect()
}

/// The energy lost in the ball, for each bat.
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
