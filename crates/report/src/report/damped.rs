//! How the modes die out, for the table and for the JSON.

use std::f64::consts::TAU;

use crate::parts::Part;
use crate::report::tables;
use crate::schema::modes as file;
use sweetspot::Solution;
use sweetspot::base::number::significant;
use sweetspot::modes::damping::DampingMethod;

/// The table of the damping, and the decay of rigid motions; nothing for a bat without damping.
pub fn parts(solution: &Solution) -> Vec<Part<'static>> {
    let damping = &solution.damping;
    if damping.modes.is_empty() {
        return vec![];
    }
    let rates: Vec<String> = damping.rigid.iter().map(|rate| significant(*rate, 3)).collect();
    let rigid = format!("rigid motions decay at {}/s", rates.join("/s and "));
    let rigid = (!rates.is_empty()).then(|| Part::List(vec![rigid]));
    [Part::Table(tables::damping(solution))].into_iter().chain(rigid).collect()
}

/// The damping of a mode; None without damping.
pub fn of_mode(solution: &Solution, k: usize) -> Option<file::Damped> {
    let damped = solution.damping.modes.get(k)?;
    Some(file::Damped {
        natural_frequency_hz: damped.natural / TAU,
        damped_frequency_hz: damped.swinging() / TAU,
        decay_1_per_s: damped.decay,
        loss_factor: 2.0 * damped.ratio,
        q_half_power: damped.q_half_power(),
        q_amplitude: damped.q_amplitude(),
        material_damping_ratio: damped.of_materials,
        complex: matches!(solution.damping.kind, DampingMethod::Complex(_)),
        error: damped.error,
    })
}

/// The method of the damping; None for a bat without damping.
pub fn of_model(solution: &Solution) -> Option<file::Damping> {
    let damping = &solution.damping;
    (!damping.modes.is_empty()).then(|| file::Damping {
        method: damping.kind.to_string(),
        rigid_decay_1_per_s: damping.rigid.clone(),
    })
}
