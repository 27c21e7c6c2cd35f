//! Several bats in the same pictures, and how much faster one hits than another.

use crate::plot::axis::Axis;
use crate::plot::picture::Picture;
use crate::plot::place;
use crate::plot::plane::{Frame, NUMBERS, Plane, head, ticks_up};
use crate::plot::series::{Series, hover, legend};
use crate::plot::sheet::Sheet;
use crate::plot::svg::{Pen, Svg};
use crate::plot::theme::FRAME;
use crate::plot::{contact, exit_speed, hands, ledger, profile, shapes, spot};
use crate::report::comparison::letter;
use sweetspot::base::error::Result;
use sweetspot::collision::aftermath::Aftermath;
use sweetspot::collision::hitter::Hitter;
use sweetspot::collision::sweet_spot::Peak;
use sweetspot_study::comparison::contender::Contender;
use sweetspot_study::comparison::table::Comparison;

/// Modes that are drawn of every bat.
const MODES: usize = 3;
/// Height of the diagram (px).
const DIAGRAM: f64 = 230.0;

/// Pictures of several bats: all bats in each of `sweet_spot`, `profile`, `shapes`, `exit_speed`, `contact`,
/// `hysteresis` and `hands`; a `ledger_A` of each bat, all to the same scale; and the `difference` of
/// exit speeds to those of the first bat.
///
/// # Errors
///
/// As [`Hitter::new`].
pub fn pictures(sheet: Sheet, comparison: &Comparison) -> Result<Vec<Picture>> {
    let bats = &comparison.bats;
    let names: Vec<String> = (0..bats.len()).map(|k| name(comparison, k)).collect();
    let both = || bats.iter().zip(&names);
    let side: Vec<_> = both()
        .map(|(c, name)| profile::MarkedBat { name, bat: &c.bat, swing_pivot: Some(c.scene.pivot) })
        .collect();
    let bent: Vec<_> = both()
        .map(|(c, name)| shapes::ShapeCurves { name, bat: &c.bat, solution: &c.sweep.solution })
        .collect();
    let along: Vec<_> = both()
        .map(|(c, name)| exit_speed::SpeedCurves {
            name,
            bat: &c.bat,
            impacts: &c.sweep.impacts,
            spot: &c.spot,
        })
        .collect();
    let spotted: Vec<_> =
        both().map(|(c, name)| spot::SpotMarks { name, bat: &c.bat, spot: &c.spot }).collect();
    let mut all: Vec<Picture> = spot::picture(sheet, &spotted).into_iter().collect();
    all.push(profile::picture(sheet, &side));
    all.extend(shapes::picture(sheet, &bent, MODES));
    all.extend(exit_speed::picture(sheet, &along));
    all.extend(ledgers(sheet, comparison, &names));
    all.extend(touches(sheet, comparison, &names)?);
    all.extend(difference(sheet, comparison, &names));
    Ok(all)
}

/// Where the energy goes, bat by bat.
fn ledgers(sheet: Sheet, comparison: &Comparison, names: &[String]) -> Vec<Picture> {
    let most = comparison.bats.iter().map(|c| ledger::greatest(&c.sweep.impacts));
    let most = most.fold(0.0, f64::max);
    let of = |(k, c): (usize, &Contender)| {
        let picture = ledger::picture(sheet, &names[k], &c.bat, &c.sweep.impacts, most)?;
        Some(Picture { name: format!("ledger_{}", letter(k)), ..picture })
    };
    comparison.bats.iter().enumerate().filter_map(of).collect()
}

/// The hits at the sweet spots, and what the hands feel of them.
fn touches(sheet: Sheet, comparison: &Comparison, names: &[String]) -> Result<Vec<Picture>> {
    let (mut touched, mut felt) = (vec![], vec![]);
    let model = comparison.terms.model;
    for (Contender { bat, scene, sweep, spot, .. }, name) in comparison.bats.iter().zip(names) {
        let Some(Peak { x, .. }) = spot.exit_speed_max else { continue };
        let hitter = Hitter::new(model, scene, bat, &sweep.solution, sweep.effort)?;
        touched.extend(contact::ContactCurves::new(name, &hitter, x));
        felt.extend(hitter.force(x).map(|force| {
            let after = Aftermath::new(bat, &sweep.solution, x, force);
            hands::HandCurves { name, after, x: scene.hands }
        }));
    }
    let mut all = contact::pictures(sheet, &touched);
    all.extend(hands::picture(sheet, &felt));
    Ok(all)
}

/// A letter as in the tables, and the name.
fn name(comparison: &Comparison, k: usize) -> String {
    format!("{}: {}", letter(k), comparison.bats[k].bat.name())
}

/// Exit speeds less those of the first bat at the same distance from the tip.
fn difference(sheet: Sheet, comparison: &Comparison, names: &[String]) -> Option<Picture> {
    let at = |bat: usize| {
        let rows = comparison.from_tip.iter().zip(&comparison.by_tip);
        rows.map(|(x, row)| Some([*x, row.difference(bat)?.by])).collect()
    };
    let (length, speed) = (sheet.length(), sheet.speed());
    let curve =
        |bat: usize| Series::curve(&names[bat], bat, at(bat)).units(length.name, speed.name);
    let curves: Vec<Series> = (1..names.len()).map(curve).collect();
    let values = || curves.iter().flat_map(|c| c.points.iter().flatten().map(|[_, v]| *v));
    let last = *comparison.from_tip.last()?;
    values().next()?;
    let mut svg = Svg::on(sheet);
    let title = "Exit speed less that of the first bat";
    head(&mut svg, title, ["", &format!("at the same distance from the tip; 0 is {}", names[0])]);
    let top = legend(&mut svg, &curves.iter().collect::<Vec<_>>()) + 18.0;
    let bottom = top + DIAGRAM;
    svg.height = bottom + NUMBERS + 4.0;
    let values = values().map(|v| speed.per * v).chain([0.0]);
    let y = Axis::around("difference", values, ticks_up(DIAGRAM)).counted_in(speed);
    let x = Axis::new("from the tip", [0.0, length.per * last]).counted_in(length);
    let plane = Plane { frame: Frame::across(sheet, [top, bottom]), x, y };
    plane.draw(&mut svg);
    plane.below(&mut svg);
    let zero = [plane.x.from, plane.x.to].map(|x| plane.at([x, 0.0]));
    svg.line(&zero, Pen::new(FRAME, 1.4));
    curves.iter().rev().for_each(|curve| curve.draw(&mut svg, &plane));
    hover(&mut svg, &plane, &curves.iter().collect::<Vec<_>>());
    Some(Picture::new("difference", title, &described(sheet, &curves, names), svg))
}

fn described(sheet: Sheet, curves: &[Series], names: &[String]) -> String {
    let told = |curve: &Series| {
        let points = || curve.points.iter().flatten();
        let most = points().max_by(|a, b| a[1].abs().total_cmp(&b[1].abs()));
        most.map(|[x, v]| {
            let (name, unit, place) = (&curve.name, sheet.speed(), place::along(sheet, *x));
            format!("{name}: {:+.2} {} at most, {place} from the tip", unit.per * v, unit.name)
        })
    };
    let all: Vec<String> = curves.iter().filter_map(told).collect();
    format!(
        "Exit speed less that of {} against the distance from the tip. {}.",
        names[0],
        all.join("; ")
    )
}
