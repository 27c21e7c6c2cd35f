//! Bending modes drawn on the bat, with their frequencies and nodes.

use crate::plot::subject::{Subject, lengths, longest, names};
use crate::plot::{
    Anchor, Chart, FRAME, Frame, LABEL, MUTED, Panel, Pen, Picture, Plane, Point, SMALL, Sheet,
    Svg, TINT, bats, digits, place, sections, series, width,
};
use sweetspot::bat::profile::Section;
use sweetspot::{Bat, Mode, Solution};

/// A bat with its modes.
pub type ShapeCurves<'a> = Subject<'a, &'a Solution>;

/// Modes of a usual picture.
pub const MODES: usize = 5;
/// Height of a mode (px), of its largest deflection and of half the thickest bat.
const ROW: f64 = 80.0;
const DEFLECTED: f64 = 20.0;
const THICK: f64 = 10.0;
/// Width of the names of modes on the right of the frame.
const RIGHT: f64 = 96.0;

/// The first modes, at most the given number, a row each; picture `shapes`. None without modes.
pub fn picture(sheet: Sheet, subjects: &[ShapeCurves], most: usize) -> Option<Picture> {
    let count = subjects.iter().map(|s| s.drawn.modes.len()).max()?.min(most);
    if count == 0 {
        return None;
    }
    let row = ROW.max(18.0 * subjects.len() as f64 + 26.0);
    let panel = Panel::plain(row * count as f64).over(|svg, plane| {
        for order in 0..count {
            let axis = plane.frame.top + row * (order as f64 + 0.5) - 2.0;
            mode_row(svg, plane, axis, (subjects, order));
        }
    });
    let (title, name, facts) = words(sheet, subjects);
    let along = ([0.0, longest(subjects)], &lengths(subjects)[..]);
    let chart = Chart::along(sheet, ("shapes", title), [name, &facts], along);
    let chart = chart.keys(&bats(&names(subjects))).right(RIGHT - sheet.right()).panel(panel);
    Some(chart.picture(sheet, &described(sheet, subjects, count)))
}

fn words<'a>(sheet: Sheet, subjects: &[ShapeCurves<'a>]) -> (&'static str, &'a str, String) {
    let title = "Bending modes and their nodes";
    let drawn = "not to scale";
    match subjects {
        [ShapeCurves { name, bat, .. }] => {
            let held = if bat.fixtures().holding() { "held" } else { "free" };
            (
                title,
                name,
                format!(
                    "{held}; numbers: nodes from the knob end ({}); {drawn}",
                    sheet.length().name
                ),
            )
        }
        _ => (title, "", drawn.to_owned()),
    }
}

fn described(sheet: Sheet, subjects: &[ShapeCurves], count: usize) -> String {
    let unit = sheet.length();
    let told = |mode: &Mode| {
        let node = |x: &f64| format!("{:.1}", unit.per * x);
        let nodes: Vec<String> = mode.nodes.iter().map(node).collect();
        let (order, hertz, nodes) = (mode.order, mode.frequency(), nodes.join(", "));
        format!("mode {order} at {hertz:.1} Hz, nodes at {nodes} {} from the knob end", unit.name)
    };
    let of = |s: &ShapeCurves| {
        let modes: Vec<String> = s.drawn.modes.iter().take(count).map(told).collect();
        format!("{}: {}.", s.name, modes.join("; "))
    };
    subjects.iter().map(of).collect::<Vec<_>>().join(" ")
}

/// One mode of every bat around an axis at that height (px).
fn mode_row(svg: &mut Svg, plane: &Plane, axis: f64, (subjects, order): (&[ShapeCurves], usize)) {
    let Frame { left, right, .. } = plane.frame;
    svg.line(&[[left, axis], [right, axis]], Pen::new(FRAME, 1.0).dashed("2 3"));
    let alone = subjects.len() == 1;
    let lines = 18.0 * if alone { 1.0 } else { subjects.len() as f64 };
    let mut y = axis - 0.5 * lines;
    svg.text([right + 14.0, y], SMALL, &format!("mode {}", order + 1));
    for (k, subject) in subjects.iter().enumerate() {
        let Some(mode) = subject.drawn.modes.get(order) else { continue };
        bent(svg, plane, axis, (k, subject.bat, mode));
        y += 18.0;
        let hertz = frequency(mode.frequency());
        if !alone {
            place::mark(svg, k, [right + 18.0, y - 4.4]);
        }
        let from = right + if alone { 14.0 } else { 28.0 };
        svg.text([from, y], LABEL.ink(series(k).0), &hertz);
    }
    for (k, subject) in subjects.iter().enumerate() {
        let Some(mode) = subject.drawn.modes.get(order) else { continue };
        nodes(svg, plane, axis, (k, mode, subjects.len()));
    }
}

/// Four digits and the unit.
fn frequency(hertz: f64) -> String {
    match hertz {
        f if f < 99.95 => format!("{} Hz", digits(f, 3)),
        f if f < 9_999.5 => format!("{f:.1} Hz"),
        f if f < 9_999_500.0 => format!("{:.2} kHz", 1e-3 * f),
        f => format!("{f:.3e} Hz"),
    }
}

/// A bat bent by a mode: sections stay across its axis.
fn bent(svg: &mut Svg, plane: &Plane, axis: f64, (k, bat, mode): (usize, &Bat, &Mode)) {
    const MOST: usize = 160;
    let all = sections(bat.profile(), MOST);
    let widest = all.iter().fold(0.0_f64, |most, (_, at)| most.max(at.outer));
    let middle: Vec<Point> = all
        .iter()
        .map(|(x, _)| [plane.across(*x), axis - DEFLECTED * mode.shape.deflection(*x)])
        .collect();
    let side = |sign: f64| -> Vec<Point> {
        let ends = |i: usize| [middle[i.saturating_sub(1)], middle[(i + 1).min(middle.len() - 1)]];
        let off = |(i, (_, Section { outer, .. })): (usize, &(f64, Section))| {
            let [[a, b], [c, d]] = ends(i);
            let length = (c - a).hypot(d - b).max(1e-9);
            let by = sign * THICK * outer / widest / length;
            [middle[i][0] + by * (d - b), middle[i][1] - by * (c - a)]
        };
        all.iter().enumerate().map(off).collect()
    };
    let (ink, dash) = series(k);
    let around: Vec<Point> = side(1.0).into_iter().chain(side(-1.0).into_iter().rev()).collect();
    let pen = Pen::new(ink, 1.3).dashed(dash);
    svg.area(&around, ink, if k == 0 { TINT } else { 0.0 }, Some(pen));
}

/// The nodes of a mode on the axis; of a single bat with their places.
fn nodes(svg: &mut Svg, plane: &Plane, axis: f64, (k, mode, count): (usize, &Mode, usize)) {
    let (unit, alone) = (svg.sheet.length(), count == 1);
    let mut free = plane.frame.left;
    for x in &mode.nodes {
        let across = plane.across(*x);
        // The marks of several bats are displaced vertically, so that none hides another.
        let fan = if alone { 0.0 } else { 8.0 * (k as f64 - 0.5 * (count - 1) as f64) };
        place::mark(svg, k, [across, axis + fan]);
        let words = place::tenths(unit.per * x);
        let half = 0.5 * width(&words, SMALL);
        if alone && across - half >= free {
            svg.text([across, axis + 0.5 * ROW - 5.0], SMALL.at(Anchor::Middle), &words);
            svg.line(
                &[[across, axis + 6.0], [across, axis + 0.5 * ROW - 16.0]],
                Pen::new(MUTED, 0.6),
            );
            free = across + half + 4.0;
        }
    }
    let told =
        |x: &f64| ([plane.across(*x), axis], format!("node at {:.2} {}", unit.per * x, unit.name));
    svg.hover(&mode.nodes.iter().map(told).collect::<Vec<_>>(), 60);
}
