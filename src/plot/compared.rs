//! Several bats in the same pictures, and how much faster one hits than another.

use crate::comparison::table::Comparison;
use crate::plot::axis::Axis;
use crate::plot::picture::Picture;
use crate::plot::place::CM;
use crate::plot::plane::{Frame, HEAD, LEFT, NUMBERS, Plane, WIDTH, head, ticks_up};
use crate::plot::series::{Series, hover, legend};
use crate::plot::svg::{Pen, Svg};
use crate::plot::theme::FRAME;
use crate::plot::{exit_speed, profile, shapes};
use crate::units::{inches, miles_per_hour};

/// Modes that are drawn of every bat.
const MODES: usize = 3;
/// Right of the frame there is a second axis.
const RIGHT: f64 = 74.0;
/// Of the diagram (px).
const DIAGRAM: f64 = 230.0;

/// `profile`, `shapes` and `exit_speed` of all bats, and the `difference` to the first.
pub fn pictures(comparison: &Comparison) -> Vec<Picture> {
    let bats = &comparison.bats;
    let names: Vec<String> = (0..bats.len()).map(|k| name(comparison, k)).collect();
    let both = || bats.iter().zip(&names);
    let side: Vec<_> = both()
        .map(|(c, name)| profile::Subject { name, bat: &c.bat, swing_pivot: Some(c.scene.pivot) })
        .collect();
    let bent: Vec<_> = both()
        .map(|(c, name)| shapes::Subject { name, bat: &c.bat, solution: &c.sweep.solution })
        .collect();
    let along: Vec<_> = both()
        .map(|(c, name)| exit_speed::Subject {
            name,
            length: c.bat.length(),
            impacts: &c.sweep.impacts,
            spot: &c.spot,
        })
        .collect();
    let mut all = vec![profile::picture(&side)];
    all.extend(shapes::picture(&bent, MODES));
    all.extend(exit_speed::picture(&along));
    all.extend(difference(comparison, &names));
    all
}

/// A letter as in the tables, and the name.
fn name(comparison: &Comparison, k: usize) -> String {
    format!("{}: {}", char::from(b'A' + k as u8), comparison.bats[k].bat.name)
}

/// Exit speeds less those of the first bat at the same distance from the tip.
fn difference(comparison: &Comparison, names: &[String]) -> Option<Picture> {
    let at = |bat: usize| {
        let rows = comparison.from_tip.iter().zip(&comparison.by_tip);
        rows.map(|(x, row)| Some([CM * x, row.difference(bat)?.by])).collect()
    };
    let curve = |bat: usize| Series::curve(&names[bat], bat, at(bat)).units("cm", "m/s");
    let curves: Vec<Series> = (1..names.len()).map(curve).collect();
    let values = || curves.iter().flat_map(|c| c.points.iter().flatten().map(|[_, v]| *v));
    let last = *comparison.from_tip.last()?;
    values().next()?;
    let mut svg = Svg::new(WIDTH, 0.0);
    let title = "Exit speed less that of the first bat";
    head(&mut svg, title, ["", &format!("at the same distance from the tip; 0 is {}", names[0])]);
    let keys =
        legend(&mut svg, &curves.iter().collect::<Vec<_>>(), [LEFT, HEAD + 10.0, WIDTH - RIGHT]);
    let top = keys + 12.0 + NUMBERS;
    let bottom = top + DIAGRAM;
    svg.height = bottom + NUMBERS + 4.0;
    let frame = Frame { left: LEFT, top, right: WIDTH - RIGHT, bottom };
    let y = Axis::around("difference (m/s)", values().chain([0.0]), ticks_up(DIAGRAM));
    let plane = Plane { frame, x: Axis::new("from the tip (cm)", [0.0, CM * last]), y };
    plane.draw(&mut svg);
    plane.above(&mut svg, &Axis::new("from the tip (in)", [0.0, inches(last)]));
    plane.below(&mut svg);
    let us = [plane.y.from, plane.y.to].map(miles_per_hour);
    plane.right(&mut svg, &Axis::new("difference (mph)", us));
    let zero = [plane.x.from, plane.x.to].map(|x| plane.at([x, 0.0]));
    svg.line(&zero, Pen::new(FRAME, 1.4));
    curves.iter().rev().for_each(|curve| curve.draw(&mut svg, &plane));
    hover(&mut svg, &plane, &curves.iter().collect::<Vec<_>>());
    Some(Picture::new("difference", title, &described(&curves, names), svg))
}

fn described(curves: &[Series], names: &[String]) -> String {
    let told = |curve: &Series| {
        let points = || curve.points.iter().flatten();
        let most = points().max_by(|a, b| a[1].abs().total_cmp(&b[1].abs()));
        most.map(|[x, v]| format!("{}: {v:+.2} m/s at most, {x:.1} cm from the tip", curve.name))
    };
    let all: Vec<String> = curves.iter().filter_map(told).collect();
    format!(
        "Exit speed less that of {} against the distance from the tip. {}.",
        names[0],
        all.join("; ")
    )
}
