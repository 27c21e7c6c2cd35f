//! A bat and the method for its modes in words.

use crate::parts::Quantity::{Inertia, Length, Mass};
use crate::parts::{Quantity, Units, wrapped};
use crate::report::edits;
use sweetspot::bat::body::STANDARD_PIVOT;
use sweetspot::{Bat, Mode, Solution, Theory};
use sweetspot_study::ignored::ignored;
use sweetspot_study::trade::reference::solver_name;

/// The data of a bat: size, mass, balance, swing weight, centre of percussion.
pub fn summary(bat: &Bat, units: Units) -> String {
    let (inertia, before, length) = (bat.inertia(), bat.unedited().inertia(), bat.length());
    let (balance, swing) = (inertia.balance_point, inertia.about(STANDARD_PIVOT));
    let weighed = bat.weighed().balance_point;
    let measured = bat.measured_swing_weight();
    let centre = inertia.center_of_percussion(STANDARD_PIVOT);
    let rows = [
        ("length", Length, Some(length)),
        ("mass", Mass, Some(inertia.mass)),
        ("balance point, from knob", Length, Some(balance)),
        ("balance point, from tip", Length, Some(length - balance)),
        ("  less the weighed one", Length, weighed.map(|x| before.balance_point - x)),
        ("inertia about balance point", Inertia, Some(inertia.about_balance)),
        ("swing weight (6 in from knob)", Inertia, Some(swing)),
        ("  less the measured one", Inertia, measured.map(|i| before.about(STANDARD_PIVOT) - i)),
        ("centre of percussion, from knob", Length, centre),
        ("centre of percussion, from tip", Length, centre.map(|x| length - x)),
    ];
    let line = |(what, quantity, value): (&str, Quantity, Option<f64>)| {
        Some(format!("  {what:<34} {}\n", quantity.said(units, value?)))
    };
    let lines: String = rows.into_iter().filter_map(line).collect();
    format!("{}\n{}{lines}", bat.title(), edited(bat, units))
}

/// A line about the edits of a bat; empty for a bat without any.
pub fn edited(bat: &Bat, units: Units) -> String {
    edits::noted(bat, units).map_or(String::new(), |note| wrapped(&format!("  {note}"), 4))
}

/// A beam theory in words.
pub fn theory(theory: Theory) -> &'static str {
    match theory {
        Theory::EulerBernoulli | Theory::Auto => "Euler-Bernoulli",
        Theory::Rayleigh => "Rayleigh (rotary inertia)",
        Theory::Timoshenko => "Timoshenko (rotary inertia and shear)",
    }
}

/// Whether it is certain that no mode is missing.
pub fn counted(bat: &Bat, solution: &Solution) -> &'static str {
    let oscillates = bat.fixtures().none_moving() && !solution.theory.turns();
    let by_nodes = oscillates && solution.modes.iter().all(Mode::has_its_nodes);
    match (solution.complete, by_nodes) {
        (true, true) => "no mode is missing: mode n has its n + 1 nodes",
        (true, false) => "no mode is missing (inertia count)",
        (false, _) => "A MODE MAY BE MISSING: the inertia count differs from the modes found",
    }
}

/// The method for the modes, and the neglected effects.
pub fn model(bat: &Bat, solution: &Solution) -> String {
    let steps = match solution.steps {
        0 => String::new(),
        steps => format!(" ({steps} Lanczos steps)"),
    };
    let model = format!(
        "Model: {}, {} elements of degree {}, solver {}{steps}",
        theory(solution.theory),
        solution.mesh.len(),
        solution.degree,
        solver_name(solution.solver)
    );
    let mut out = wrapped(&model, 7);
    let plan = format!(
        "  why: {}; every frequency within {:.0e}; {}",
        solution.reason,
        solution.worst(),
        counted(bat, solution)
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
