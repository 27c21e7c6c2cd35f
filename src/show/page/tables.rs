//! The tables of results: modes, sweet spots, energies, figures.

use std::f64::consts::TAU;

use crate::base::number;
use crate::base::units::gravities;
use crate::collision::figures::Swung;
use crate::collision::hit::Outcome;
use crate::collision::sweet_spot::{Peak, SweetSpot};
use crate::show::analysis::Analysis;
use crate::show::page::shown::{self, NONE, centimetres, decimals, in_inches, inline, speed};
use crate::show::page::table::Table;

/// So many modes have their nodes listed, and so many their energies.
const LISTED: usize = 6;
const LARGEST: usize = 3;

/// Frequencies with their errors, modal masses, damping where there is any.
pub fn modes(analysis: &Analysis) -> Table {
    let solution = &analysis.solution;
    let damped = &solution.damping.modes;
    let mut head = vec!["Mode", "Frequency, Hz", "f/f₁", "Relative error", "Modal mass, g"];
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
            decimals(1e3 * mode.modal_mass, 1),
        ];
        if let Some(damped) = damped.get(k) {
            row.extend([decimals(damped.swinging() / TAU, 2), decimals(100.0 * damped.ratio, 3)]);
        }
        table.row(row);
    }
    table
}

/// Where the first modes are at rest.
pub fn nodes(analysis: &Analysis) -> Table {
    let head = ["Mode", "From the knob, cm", "From the tip, in"];
    let mut table = Table::new("Nodes: where a mode is at rest", &head);
    let length = analysis.bat.length();
    for mode in analysis.solution.modes.iter().take(LISTED) {
        let list = |of: &dyn Fn(f64) -> String| match mode.nodes.is_empty() {
            true => "none".to_owned(),
            false => mode.nodes.iter().map(|x| of(*x)).collect::<Vec<_>>().join(", "),
        };
        table.row([
            mode.order.to_string(),
            list(&|x| format!("{:.1}", 100.0 * x)),
            list(&|x| format!("{:.1}", crate::base::units::inches(length - x))),
        ]);
    }
    table
}

/// The sweet spot by each of its definitions.
pub fn sweet_spots(analysis: &Analysis) -> Table {
    let head = ["Sweet spot by", "Knob, cm", "Knob, in", "Tip, cm", "Tip, in", "There"];
    let mut table = Table::new("The sweet spot by each of its definitions", &head);
    let (spot, length) = (&analysis.figures.spot, analysis.bat.length());
    let mut line = |what: &str, x: Option<f64>, value: String| {
        let Some(x) = x else { return };
        let tip = length - x;
        let cells = [centimetres(x), in_inches(x), centimetres(tip), in_inches(tip)];
        let cells = cells.into_iter().chain([value]);
        table.row(std::iter::once(what.to_owned()).chain(cells));
    };
    let mut peak = |what: &str, peak: Option<Peak>, value: &dyn Fn(f64) -> String| {
        line(what, peak.map(|p| p.x), peak.map_or(String::new(), |p| value(p.value)));
    };
    peak("fastest ball", spot.exit_speed_max, &|v| inline(speed(v)));
    peak("least vibration", spot.vibration_min, &|energy| format!("{energy:.2} J"));
    peak("least hand speed (rms, undamped)", spot.hands_velocity_min, &|v| format!("{v:.2} m/s"));
    if analysis.bat.damped() {
        peak("least hand shaking (rms)", spot.hands_acceleration_min, &|a| {
            format!("{:.0} times gravity", gravities(a))
        });
    }
    line("node of mode 1", spot.node_mode_1, NONE.to_owned());
    line("node of mode 2", spot.node_mode_2, NONE.to_owned());
    line("centre of percussion of this swing", spot.center_of_percussion, NONE.to_owned());
    if let Some([from, to]) = spot.zone {
        line("within 1 % of the best speed, from", Some(from), NONE.to_owned());
        line("and to", Some(to), NONE.to_owned());
    }
    table
}

/// Where the energy of the best hit goes; empty where no ball is hit.
pub fn ledger(analysis: &Analysis) -> Table {
    let mut table = Table::new("Energy of the hit at the sweet spot", &["Energy", "J", "%"]);
    let best = analysis.figures.best.as_ref();
    let Some(energy) = best.and_then(|best| best.outcome.as_ref()).map(|outcome| &outcome.energy)
    else {
        return table;
    };
    let mut line = |what: &str, value: f64| {
        let share = 100.0 * value / energy.initial;
        let share = if share.is_finite() { decimals(share, 2) } else { NONE.to_owned() };
        table.row([what.to_owned(), decimals(value, 2), share]);
    };
    line("before: ball and bat together", energy.initial);
    line("after: the ball flies on with", energy.ball);
    line("the bat's swing keeps", energy.bat_rigid);
    line("the bat's vibration takes", energy.vibration());
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
    line("not accounted for", energy.imbalance());
    table
}

/// The figures by which bats are compared; empty where no ball is hit.
pub fn figures(analysis: &Analysis) -> Table {
    let figures = &analysis.figures;
    let head = ["Figure", "SI", "US"];
    let mut table = Table::new("Figures at the sweet spot (computed, not certified)", &head);
    let Some(best) = &figures.best else { return table };
    let Some(outcome) = &best.outcome else { return table };
    let mut pair = |(what, [si, us]): (String, [String; 2])| table.row([what, si, us]);
    pair(("bat speed there".into(), speed(best.bat_speed)));
    of_the_hit(outcome).into_iter().for_each(&mut pair);
    for (what, peak) in [
        ("largest BBCOR, of a free bat", figures.bbcor_max),
        ("largest BBCOR, of a bat held 6 in from the knob", figures.bbcor_pivoted_max),
    ] {
        let Some(peak) = peak else { continue };
        let [si, us] = shown::length(peak.x);
        pair((what.into(), [format!("{:.3} at {si}", peak.value), format!("at {us}")]));
    }
    if let Some([knob, tip]) = figures.spot.inch_off {
        let lost = |v: Option<f64>| {
            v.map_or(["no hit".to_owned(), NONE.to_owned()], |v| signed(v - outcome.exit_speed))
        };
        pair(("1 in off towards the knob".into(), lost(knob)));
        pair(("1 in off towards the tip".into(), lost(tip)));
    }
    figures.swings.iter().map(swung).for_each(pair);
    table
}

/// A name and a value in both systems of units.
type Pair = (String, [String; 2]);

fn of_the_hit(outcome: &Outcome) -> Vec<Pair> {
    let plain = |value: String| [value, NONE.to_owned()];
    let three = |value: f64| plain(format!("{value:.3}"));
    let mut pairs: Vec<Pair> = vec![
        ("exit speed of the ball".into(), speed(outcome.exit_speed)),
        ("collision efficiency e_A".into(), three(outcome.collision_efficiency)),
        ("BBCOR, of a free bat".into(), three(outcome.bbcor)),
        ("BBCOR, of a bat held 6 in from the knob".into(), three(outcome.bbcor_pivoted)),
        ("impulse on the ball".into(), plain(format!("{:.3} N s", outcome.impulse))),
    ];
    if let Some(time) = outcome.contact_time {
        pairs.push(("time of contact".into(), plain(format!("{:.3} ms", 1e3 * time))));
    }
    if let Some(force) = outcome.peak_force {
        pairs.push(("largest force".into(), plain(format!("{:.2} kN", 1e-3 * force))));
    }
    pairs
}

/// The fastest ball of a batter who swings bats by that law.
fn swung(swung: &Swung) -> Pair {
    let what = match swung.exponent {
        0.0 => "swung at the same angular speed".to_owned(),
        0.5 => "swung with the same energy of rotation".to_owned(),
        n => format!("swung at a speed as (swing weight)^{}", -n),
    };
    let best = swung.best.map_or(["no hit".into(), NONE.into()], |best| speed(best.value));
    (format!("{what}, {:.2} rad/s", swung.swing), best)
}

/// A change of speed.
fn signed(change: f64) -> [String; 2] {
    let us = with_sign(crate::base::units::miles_per_hour(change), 1);
    [format!("{} m/s", with_sign(change, 2)), format!("{us} mph")]
}

/// A change, to so many decimals.
fn with_sign(value: f64, decimals: usize) -> String {
    number::signed(value, decimals).replace('-', "−")
}

/// How the sweet spots and the best speed move with the scene; empty where no ball is hit.
pub fn moves(analysis: &Analysis) -> Table {
    let damped = analysis.bat.damped();
    let mut head = vec!["If …", "fastest ball, mm", "least vibration, mm", "least hand speed, mm"];
    head.extend(damped.then_some("least hand shaking, mm"));
    head.push("best speed");
    let mut table = Table::new("How the sweet spots move, in mm towards the tip", &head);
    let spot = &analysis.figures.spot;
    if spot.exit_speed_max.is_none() {
        return table;
    }
    for (what, moved) in &analysis.figures.moves {
        let by = |of: fn(&SweetSpot) -> Option<Peak>| match (of(spot), of(moved)) {
            (Some(before), Some(after)) => with_sign(1e3 * (after.x - before.x), 1),
            _ => NONE.to_owned(),
        };
        let faster = match (spot.exit_speed_max, moved.exit_speed_max) {
            (Some(before), Some(after)) => inline(signed(after.value - before.value)),
            _ => NONE.to_owned(),
        };
        let mut cells = vec![
            what.clone(),
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
