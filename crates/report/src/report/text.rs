//! Tables for the terminal, 80 columns wide, in the requested units.

use std::fmt::Write;

use crate::parts::{Units, first, lines, numbers, wrapped};
use crate::report::{damped, edits};
use sweetspot::base::units::ounces;
use sweetspot::bat::body::STANDARD_PIVOT;
use sweetspot::{Bat, Mode, Solution, Theory};
use sweetspot_study::ignored::ignored;
use sweetspot_study::trade::reference::solver_name;

/// The data of a bat: size, mass, balance, swing weight, centre of percussion.
pub fn summary(bat: &Bat, units: Units) -> String {
    let inertia = bat.inertia();
    let length = bat.length();
    let mut out = format!("{}\n{}", bat.title(), edited(bat, units));
    let mut line = |what: &str, value: String| {
        let _ = writeln!(out, "  {what:<34} {value}");
    };
    line("length", units.length(length));
    line("mass", units.mass(inertia.mass));
    line("balance point, from knob", units.length(inertia.balance_point));
    line("balance point, from tip", units.length(length - inertia.balance_point));
    if let Some(weighed) = bat.weighed().balance_point {
        line(
            "  less the weighed one",
            units.length(bat.unedited().inertia().balance_point - weighed),
        );
    }
    line("inertia about balance point", units.inertia(inertia.about_balance));
    line("swing weight (6 in from knob)", units.inertia(inertia.about(STANDARD_PIVOT)));
    if let Some(measured) = bat.measured_swing_weight() {
        let computed = bat.unedited().inertia().about(STANDARD_PIVOT);
        line("  less the measured one", units.inertia(computed - measured));
    }
    if let Some(center) = inertia.center_of_percussion(STANDARD_PIVOT) {
        line("centre of percussion, from knob", units.length(center));
        line("centre of percussion, from tip", units.length(length - center));
    }
    out
}

/// A line about the edits of a bat; empty for a bat without any.
pub fn edited(bat: &Bat, units: Units) -> String {
    edits::noted(bat, units).map_or(String::new(), |note| wrapped(&format!("  {note}"), 4))
}

/// A number with that many decimals, or with a power of ten where that would be all zeros or very long.
fn fixed(value: f64, decimals: usize) -> String {
    match value.abs() {
        0.0 | 1e-2..1e6 => format!("{value:.decimals$}"),
        _ => format!("{value:.2e}"),
    }
}

/// A frequency (Hz) with the digits that are known by its relative error, two decimals at least and nine
/// characters at most.
fn as_known(frequency: f64, error: f64) -> String {
    const LONGEST: usize = 9;
    let known = (-(error * frequency).log10()).floor();
    let whole = fixed(frequency, 0).len();
    let room = LONGEST.saturating_sub(whole + 1).max(2);
    let decimals = if known > 2.0 { (known.min(room as f64)) as usize } else { 2 };
    fixed(frequency, decimals)
}

/// The nodes of this many modes fit a screen or two.
const MOST_NODES: usize = 20;

/// The modes: frequencies with their errors, how they die out, and the nodes of the first `with_nodes` modes.
pub fn modes(bat: &Bat, solution: &Solution, with_nodes: usize, units: Units) -> [String; 3] {
    let mut out = wrapped(&format!("Bending modes ({})", bat.fixtures().freedom()), 2);
    if solution.modes.is_empty() {
        return [out, String::new(), String::new()];
    }
    let lowest = solution.modes.first().map_or(1.0, |mode| mode.omega);
    out += &lines(
        &solution.modes,
        &[
            (numbers(6, "mode"), &|mode| mode.order.to_string()),
            (numbers(13, "frequency"), &|mode| {
                format!("{} Hz", as_known(mode.frequency(), mode.error.total()))
            }),
            (numbers(8, "f/f1"), &|mode| fixed(mode.omega / lowest, 3)),
            (numbers(3, ""), &|_| String::new()),
            (first(17, "relative error"), &|mode| format!("within {:.0e}", mode.error.total())),
            (numbers(9, "modal mass (largest |w| = 1)"), &|mode| match units.us_first() {
                true => format!("{} oz", fixed(ounces(mode.modal_mass), 3)),
                false => format!("{} g", fixed(1e3 * mode.modal_mass, 1)),
            }),
        ],
    );
    [out, damped::table(solution), nodes(bat, solution, with_nodes, units)]
}

/// The nodes of the first modes.
fn nodes(bat: &Bat, solution: &Solution, with_nodes: usize, units: Units) -> String {
    let mut out = if with_nodes > 0 { "Nodes\n".to_owned() } else { String::new() };
    for mode in solution.modes.iter().take(with_nodes.min(MOST_NODES)) {
        let from_tip: Vec<f64> = mode.nodes.iter().rev().map(|x| bat.length() - x).collect();
        let mut label = format!("mode {}", mode.order);
        if mode.nodes.is_empty() && mode.untold.is_empty() {
            let _ = writeln!(out, "  {label:<8} none");
            continue;
        }
        let sides = [("from knob", &mode.nodes), ("from tip", &from_tip)];
        for (end, places) in sides.into_iter().filter(|(_, places)| !places.is_empty()) {
            for line in units.positions(places) {
                let line = format!("  {label:<8} {end:<9}  {line}");
                out += &wrapped(&line, 22);
                label.clear();
            }
        }
        for stretch in &mode.untold {
            for line in units.positions(stretch) {
                let line =
                    format!("  {label:<8} from knob  {line}: between these no other can be told");
                out += &wrapped(&line, 22);
                label.clear();
            }
        }
    }
    if with_nodes.min(solution.modes.len()) > MOST_NODES {
        let _ = writeln!(out, "  those of modes above {MOST_NODES} are in the JSON");
    }
    out
}

/// The method for the modes, and the neglected effects.
pub fn model(bat: &Bat, solution: &Solution) -> String {
    let mut model = format!(
        "Model: {}, {} elements of degree {}, solver {}",
        match solution.theory {
            Theory::EulerBernoulli | Theory::Auto => "Euler-Bernoulli",
            Theory::Rayleigh => "Rayleigh (rotary inertia)",
            Theory::Timoshenko => "Timoshenko (rotary inertia and shear)",
        },
        solution.mesh.len(),
        solution.degree,
        solver_name(solution.solver)
    );
    if solution.steps > 0 {
        let _ = write!(model, " ({} Lanczos steps)", solution.steps);
    }
    let mut out = wrapped(&model, 7);
    let oscillates = bat.fixtures().none_moving() && !solution.theory.turns();
    let by_nodes = oscillates && solution.modes.iter().all(Mode::has_its_nodes);
    let count = match (solution.complete, by_nodes) {
        (true, true) => "no mode is missing: mode n has its n + 1 nodes",
        (true, false) => "no mode is missing (inertia count)",
        (false, _) => "A MODE MAY BE MISSING: the inertia count differs from the modes found",
    };
    let plan = format!(
        "  why: {}; every frequency within {:.0e}; {count}",
        solution.reason,
        solution.worst()
    );
    out += &wrapped(&plan, 7);
    if !solution.damping.modes.is_empty() {
        out += &wrapped(&format!("  damping: {}", solution.damping.kind), 11);
    }
    for effect in ignored(bat, solution) {
        out += &wrapped(&format!("  left out: {effect}"), 12);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As many digits as are known and fit: at least two decimals, and no wrong digit.
    #[test]
    fn a_frequency_has_the_digits_that_are_known() {
        for (frequency, error, shown) in [
            (174.508_543_21, 1e-5, "174.51"),
            (174.508_543_21, 1e-10, "174.50854"),
            (0.320_123_456_7, 7e-14, "0.3201235"),
            (0.320_123_456_7, 1e-2, "0.32"),
            (1_854.825_6, 1e-12, "1854.8256"),
        ] {
            assert_eq!(as_known(frequency, error), shown, "{frequency} {error}");
        }
    }
}
