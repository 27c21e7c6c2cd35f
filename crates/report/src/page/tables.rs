//! The tables of results: modes, sweet spots, energies, figures.

use std::f64::consts::TAU;

use crate::analysis::Analysis;
use crate::page::shown::{self, NONE, bare, decimals, length_unit};
use crate::parts::{Table, Units};
use crate::report::hit_text::{self, SpotLine};
use sweetspot::Bat;
use sweetspot::base::number;
use sweetspot::base::units::{inches, ounces};
use sweetspot::collision::figures::Moved;
use sweetspot::collision::sweet_spot::Peak;
use sweetspot::collision::{Outcome, SweetSpot};
use sweetspot_study::trampoline::barrel::Barrel;

/// Number of modes whose nodes are listed, and of modes whose energies are listed.
const LISTED: usize = 6;
const LARGEST: usize = 3;

/// Frequencies with their errors, modal masses, and damping where there is any.
pub fn modes(analysis: &Analysis, units: Units) -> Table {
    let solution = &analysis.solution;
    let damped = &solution.damping.modes;
    let mass = if units == Units::Us { "Modal mass, oz" } else { "Modal mass, g" };
    let mut head = vec!["Mode", "Frequency, Hz", "f/f₁", "Relative error", mass];
    if !damped.is_empty() {
        head.extend(["Damped frequency, Hz", "Damping ratio, %"]);
    }
    let mut table = Table::new("Bending modes", &head);
    let first = solution.modes.first().map_or(1.0, |mode| mode.omega);
    for (k, mode) in solution.modes.iter().enumerate() {
        let mut row = vec![
            mode.order.to_string(),
            decimals(mode.frequency(), 2),
            decimals(mode.omega / first, 3),
            format!("≤ {}", shown::error(mode.error.total())),
            units.show(decimals(1e3 * mode.modal_mass, 1), decimals(ounces(mode.modal_mass), 2)),
        ];
        if let Some(damped) = damped.get(k) {
            row.extend([decimals(damped.swinging() / TAU, 2), decimals(100.0 * damped.ratio, 3)]);
        }
        table.row(row);
    }
    table
}

/// The lowest hoop modes of a barrel: waves around and number along, frequencies with their errors, and where
/// they move most.
pub fn hoop_modes(bat: &Bat, barrel: &Barrel, units: Units) -> Table {
    const MOST: usize = 10;
    let largest = format!("Largest, from the tip, {}", length_unit(units));
    let head = ["n around", "m along", "Frequency, Hz", "Relative error", &largest];
    let mut table = Table::new("Hoop modes: the wall as an elastic solid", &head);
    for mode in barrel.hoop().lowest(MOST) {
        table.row([
            mode.harmonic.to_string(),
            mode.order.to_string(),
            decimals(mode.frequency_hz, 2),
            format!("≤ {}", shown::error(mode.error)),
            bare(units, (bat.length() - mode.largest_at_m).max(0.0)),
        ]);
    }
    table
}

/// The nodes of the first modes.
pub fn nodes(analysis: &Analysis, units: Units) -> Table {
    let place = format!("From the knob, {}", length_unit(units));
    let mut table = Table::new("Nodes: where a mode is at rest", &["Mode", &place]);
    for mode in analysis.solution.modes.iter().take(LISTED) {
        let nodes: Vec<String> = mode.nodes.iter().map(|x| bare(units, *x)).collect();
        let nodes = if nodes.is_empty() { "none".to_owned() } else { nodes.join(", ") };
        table.row([mode.order.to_string(), nodes]);
    }
    table
}

/// The sweet spot by each of its definitions.
pub fn sweet_spots(analysis: &Analysis, units: Units) -> Table {
    let unit = length_unit(units);
    let [knob, tip] = ["knob", "tip"].map(|end| format!("From the {end}, {unit}"));
    let mut table =
        Table::new("The sweet spot by each of its definitions", &["Sweet spot by", &knob, &tip]);
    let bat = &analysis.bat;
    for SpotLine { what, x } in hit_text::spot_lines(bat, &analysis.figures.spot, units) {
        table.row([what, bare(units, x), bare(units, bat.length() - x)]);
    }
    table
}

/// The energies of the best hit; empty where no ball is hit.
pub fn ledger(analysis: &Analysis, units: Units) -> Table {
    let (unit, per) = units.of_energy();
    let mut table = Table::new("Energy of the hit at the sweet spot", &["Energy", unit, "%"]);
    let best = analysis.figures.best.as_ref();
    let Some(energy) = best.and_then(|best| best.outcome.as_ref()).map(|outcome| &outcome.energy)
    else {
        return table;
    };
    let mut line = |what: &str, value: f64| {
        let share = 100.0 * value / energy.initial;
        let hundredths = |value: f64| format!("{:.2}", value + 0.0).replace('-', "−");
        let share = if share.is_finite() { hundredths(share) } else { NONE.to_owned() };
        table.row([what.to_owned(), hundredths(per * value), share]);
    };
    line("before: ball and bat together", energy.initial);
    line("after: the ball flies on with", energy.ball);
    line("the bat's swing keeps", energy.bat_rigid);
    line("the bat's vibration takes", energy.vibration);
    let (first, others) =
        energy.vibration_by_mode.split_at(energy.vibration_by_mode.len().min(LARGEST));
    for (k, mode) in first.iter().enumerate() {
        line(&format!("  of it mode {}", k + 1), *mode);
    }
    if !others.is_empty() {
        line("  of it all others", others.iter().sum());
    }
    line("lost in the ball", energy.dissipated_ball);
    line("lost by the bat's damping", energy.dissipated_damping);
    if energy.wall != 0.0 {
        line("in the barrel's wall", energy.wall);
    }
    // An empirical model loses some energy; in all others this is round-off and of no interest to readers.
    if energy.imbalance.abs() > 1e-6 * energy.initial {
        line("not accounted for by this model", energy.imbalance);
    }
    table
}

/// The figures by which bats are compared; empty where no ball is hit.
pub fn figures(analysis: &Analysis, units: Units) -> Table {
    let figures = &analysis.figures;
    let mut table = Table::new(hit_text::STATED, &["Figure", "Value"]);
    let Some(best) = &figures.best else { return table };
    let Some(outcome) = &best.outcome else { return table };
    table.row(["bat speed there".to_owned(), units.speed(best.bat_speed)]);
    of_the_hit(outcome, units).into_iter().for_each(|(what, value)| table.row([what, &value]));
    // The wall has a part of the page to itself.
    let mut solid = figures.clone();
    solid.wall = None;
    for (what, value) in hit_text::stated(&solid, units) {
        table.row([what, value.replace('-', "−")]);
    }
    table
}

/// Force and duration of the hit, where the model has them.
fn of_the_hit(outcome: &Outcome, units: Units) -> Vec<(&'static str, String)> {
    let mut lines = vec![("impulse on the ball", shown::impulse(units, outcome.impulse))];
    if let Some(time) = outcome.contact_time {
        lines.push(("time of contact", format!("{:.3} ms", 1e3 * time)));
    }
    if let Some(force) = outcome.peak_force {
        lines.push(("largest force", units.force(force, 2)));
    }
    lines
}

/// A change of speed.
fn signed(units: Units, change: f64) -> String {
    let us = with_sign(sweetspot::base::units::miles_per_hour(change), 1);
    units.show(format!("{} m/s", with_sign(change, 2)), format!("{us} mph"))
}

/// A signed change with the given number of decimals.
fn with_sign(value: f64, decimals: usize) -> String {
    number::signed(value, decimals).replace('-', "−")
}

/// How the sweet spots and the best speed move with the scene; empty where no ball is hit.
pub fn moves(analysis: &Analysis, units: Units) -> Table {
    let (unit, per, digits) =
        if units == Units::Us { ("in", inches(1.0), 2) } else { ("mm", 1e3, 1) };
    let caption = format!("How the sweet spots move towards the tip, {unit}");
    let damped = analysis.bat.damped();
    let mut head = vec!["If …", "fastest ball", "least vibration", "least hand speed"];
    head.extend(damped.then_some("least hand shaking"));
    head.push("best speed");
    let mut table = Table::new(caption, &head);
    let spot = &analysis.figures.spot;
    if spot.exit_speed_max.is_none() {
        return table;
    }
    for Moved { change, sweet_spot: moved } in &analysis.figures.moves {
        let by = |of: fn(&SweetSpot) -> Option<Peak>| match (of(spot), of(moved)) {
            (Some(before), Some(after)) => with_sign(per * (after.x - before.x), digits),
            _ => NONE.to_owned(),
        };
        let faster = match (spot.exit_speed_max, moved.exit_speed_max) {
            (Some(before), Some(after)) => signed(units, after.value - before.value),
            _ => NONE.to_owned(),
        };
        let mut cells = vec![
            change.clone(),
            by(|s| s.exit_speed_max),
            by(|s| s.vibration_min),
            by(|s| s.hands_velocity_min),
        ];
        cells.extend(damped.then(|| by(|s| s.hands_acceleration_min)));
        cells.push(faster);
        table.row(cells);
    }
    table
}
