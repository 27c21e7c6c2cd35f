//! The modes as a table for spreadsheets, under the names of the JSON.

use crate::modes::solve::Solution;
use crate::show::csv::{Cell, Csv};

/// A row for each mode: number, frequency, damping ratio, modal mass, how far the frequency may be off
/// for the mesh, for round-off and by its residual (relative), and the nodes from the knob end, as many
/// columns as the mode with most of them needs. Empty where there is no such value.
pub fn table(solution: &Solution) -> String {
    const NAMES: [&str; 8] = [
        "order",
        "frequency_hz",
        "omega_rad_s",
        "damping_ratio",
        "modal_mass_kg",
        "error.discretization",
        "error.round_off",
        "error.residual",
    ];
    let most = solution.modes.iter().map(|mode| mode.nodes.len()).max().unwrap_or(0);
    let nodes = (1..=most).map(|k| format!("node_{k}_m"));
    let mut table = Csv::new(NAMES.into_iter().map(str::to_owned).chain(nodes));
    // NaN and infinity stand for an unknown error.
    let known = |error: f64| Cell::from(Some(error).filter(|error| error.is_finite()));
    for (k, mode) in solution.modes.iter().enumerate() {
        let ratio = solution.damping.modes.get(k).map_or(0.0, |damped| damped.ratio);
        let figures = [
            mode.order.into(),
            mode.frequency().into(),
            mode.omega.into(),
            ratio.into(),
            mode.modal_mass.into(),
            known(mode.error.discretization),
            known(mode.error.round_off),
            known(mode.error.residual),
        ];
        let nodes = (0..most).map(|node| mode.nodes.get(node).copied().into());
        table.row(figures.into_iter().chain(nodes));
    }
    table.text()
}
