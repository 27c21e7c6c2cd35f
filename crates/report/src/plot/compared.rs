//! Several bats in the same pictures, and the differences of their exit speeds.

use crate::plot::sets::{Hits, of_touches};
use crate::plot::subject::Subject;
use crate::plot::{
    Axis, Chart, Panel, Picture, Series, Sheet, exit_speed, heights, ledger, place, profile,
    shapes, spot,
};
use crate::report::comparison::letter;
use sweetspot::Result;
use sweetspot_study::comparison::contender::Contender;
use sweetspot_study::comparison::table::Comparison;

/// Modes that are drawn of every bat.
const MODES: usize = 3;
/// Height of the diagram (px).
const DIAGRAM: f64 = 230.0;

/// Pictures of several bats: all bats in each of `sweet_spot`, `profile`, `shapes`, `exit_speed`, `contact`,
/// `hysteresis` and `hands`; a `ledger_A` of each bat, all to the same scale; and the `difference` between the exit
/// speeds and those of the first bat.
///
/// # Errors
///
/// As [`Hits::pictures`].
pub fn pictures(sheet: Sheet, comparison: &Comparison) -> Result<Vec<Picture>> {
    let bats = &comparison.bats;
    let names: Vec<String> = (0..bats.len()).map(|k| name(comparison, k)).collect();
    let mut all: Vec<Picture> =
        spot::picture(sheet, &drawn(bats, &names, |c| &c.spot)).into_iter().collect();
    all.push(profile::picture(sheet, &drawn(bats, &names, |c| Some(c.scene.pivot))));
    all.extend(shapes::picture(sheet, &drawn(bats, &names, |c| &c.sweep.solution), MODES));
    let along = drawn(bats, &names, |c| (&c.sweep.impacts[..], &c.spot));
    all.extend(exit_speed::picture(sheet, &along));
    all.extend(ledgers(sheet, comparison, &names));
    let hits =
        bats.iter().zip(&names).filter_map(|(Contender { bat, scene, sweep, spot, .. }, name)| {
            let model = comparison.terms.model;
            Some((name.as_str(), Hits { bat, model, scene, sweep, spot }, spot.exit_speed_max?.x))
        });
    all.extend(of_touches(sheet, &hits.collect::<Vec<_>>())?);
    all.extend(difference(sheet, comparison, &names));
    Ok(all)
}

/// The bats with these names, and what is drawn of each.
fn drawn<'a, T>(
    bats: &'a [Contender],
    names: &'a [String],
    of: fn(&'a Contender) -> T,
) -> Vec<Subject<'a, T>> {
    let named = bats.iter().zip(names);
    named.map(|(c, name)| Subject { name, bat: &c.bat, drawn: of(c) }).collect()
}

/// The distribution of the energy for each bat.
fn ledgers(sheet: Sheet, comparison: &Comparison, names: &[String]) -> Vec<Picture> {
    let most = comparison.bats.iter().map(|c| ledger::greatest(&c.sweep.impacts));
    let most = most.fold(0.0, f64::max);
    let of = |(k, c): (usize, &Contender)| {
        let picture = ledger::picture(sheet, &names[k], &c.bat, &c.sweep.impacts, most)?;
        Some(Picture { name: format!("ledger_{}", letter(k)), ..picture })
    };
    comparison.bats.iter().enumerate().filter_map(of).collect()
}

/// A letter as in the tables, and the name.
fn name(comparison: &Comparison, k: usize) -> String {
    format!("{}: {}", letter(k), comparison.bats[k].bat.name())
}

/// Exit speeds minus those of the first bat at the same distance from the tip.
fn difference(sheet: Sheet, comparison: &Comparison, names: &[String]) -> Option<Picture> {
    let at = |bat: usize| {
        let rows = comparison.from_tip.iter().zip(&comparison.by_tip);
        rows.map(|(x, row)| Some([*x, row.difference(bat)?.by])).collect()
    };
    let curve = |bat: usize| Series::curve(&names[bat], bat, at(bat));
    let curves: Vec<Series> = (1..names.len()).map(curve).collect();
    let (length, last) = (sheet.length(), *comparison.from_tip.last()?);
    heights(&curves).next()?;
    let facts = format!("at the same distance from the tip; 0 is {}", names[0]);
    let x = Axis::new("from the tip", [0.0, length.per * last]).counted_in(length);
    let title = "Exit speed less that of the first bat";
    let alt = described(sheet, &curves, names);
    let chart = Chart::new("difference", title, ["", &facts], x).keys(&curves);
    let panel = Panel::around(DIAGRAM, ("difference", sheet.speed()), curves, &[0.0]).zero();
    Some(chart.panel(panel).picture(sheet, &alt))
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
