//! Several bats in the same pictures, and how much faster one hits than another.

use crate::base::error::Result;
use crate::base::units::{inches, miles_per_hour};
use crate::collision::aftermath::Aftermath;
use crate::collision::hitter::Hitter;
use crate::collision::sweet_spot::Peak;
use crate::show::plot::axis::Axis;
use crate::show::plot::picture::Picture;
use crate::show::plot::place::CM;
use crate::show::plot::plane::{Frame, HEAD, LEFT, NUMBERS, Plane, SECOND, WIDTH, head, ticks_up};
use crate::show::plot::series::{Series, hover, legend};
use crate::show::plot::svg::{Pen, Svg};
use crate::show::plot::theme::FRAME;
use crate::show::plot::{contact, exit_speed, hands, ledger, profile, shapes};
use crate::show::report::comparison::letter;
use crate::study::comparison::contender::Contender;
use crate::study::comparison::table::Comparison;

/// Modes that are drawn of every bat.
const MODES: usize = 3;
/// Height of the diagram (px).
const DIAGRAM: f64 = 230.0;

/// Pictures of several bats: all bats in each of `profile`, `shapes`, `exit_speed`, `contact`,
/// `hysteresis` and `hands`; a `ledger_A` of each bat, all to the same scale; and the `difference` of
/// exit speeds to those of the first bat.
///
/// # Errors
///
/// As [`Hitter::new`].
pub fn pictures(comparison: &Comparison) -> Result<Vec<Picture>> {
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
    all.extend(ledgers(comparison, &names));
    all.extend(touches(comparison, &names)?);
    all.extend(difference(comparison, &names));
    Ok(all)
}

/// Where the energy goes, bat by bat.
fn ledgers(comparison: &Comparison, names: &[String]) -> Vec<Picture> {
    let most = comparison.bats.iter().map(|c| ledger::greatest(&c.sweep.impacts));
    let most = most.fold(0.0, f64::max);
    let of = |(k, c): (usize, &Contender)| {
        let picture = ledger::picture(&names[k], &c.bat, &c.sweep.impacts, most)?;
        Some(Picture { name: format!("ledger_{}", letter(k)), ..picture })
    };
    comparison.bats.iter().enumerate().filter_map(of).collect()
}

/// The hits at the sweet spots, and what the hands feel of them.
fn touches(comparison: &Comparison, names: &[String]) -> Result<Vec<Picture>> {
    let (mut touched, mut felt) = (vec![], vec![]);
    let model = comparison.terms.model;
    for (Contender { bat, scene, sweep, spot, .. }, name) in comparison.bats.iter().zip(names) {
        let Some(Peak { x, .. }) = spot.exit_speed_max else { continue };
        let hitter = Hitter::new(model, scene, bat, &sweep.solution, sweep.effort)?;
        touched.extend(contact::Subject::new(name, &hitter, x));
        felt.extend(hitter.force(x).map(|force| {
            let after = Aftermath::new(bat, &sweep.solution, x, force);
            hands::Subject { name, after, x: scene.hands }
        }));
    }
    let mut all = contact::pictures(&touched);
    all.extend(hands::picture(&felt));
    Ok(all)
}

/// A letter as in the tables, and the name.
fn name(comparison: &Comparison, k: usize) -> String {
    format!("{}: {}", letter(k), comparison.bats[k].bat.name())
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
        legend(&mut svg, &curves.iter().collect::<Vec<_>>(), [LEFT, HEAD + 10.0, WIDTH - SECOND]);
    let top = keys + 12.0 + NUMBERS;
    let bottom = top + DIAGRAM;
    svg.height = bottom + NUMBERS + 4.0;
    let frame = Frame { left: LEFT, top, right: WIDTH - SECOND, bottom };
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
