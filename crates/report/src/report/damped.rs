//! How the modes die out, for the table and for the JSON.

use std::f64::consts::TAU;
use std::fmt::Write;

use crate::parts::{lines, numbers};
use crate::schema::modes as file;
use sweetspot::Solution;
use sweetspot::base::number::significant;
use sweetspot::modes::damping::DampingMethod;

/// A row for each mode; empty for a bat without damping.
pub fn table(solution: &Solution) -> String {
    let damping = &solution.damping;
    if damping.modes.is_empty() {
        return String::new();
    }
    let mut out = String::from(
        "Damping (Q, width: 1/(2 ratio); Q, amplit., as papers on bats have it: 1/ratio)\n",
    );
    let q = |value: Option<f64>| value.map_or("none".to_owned(), |q| significant(q, 4));
    let modes: Vec<_> = solution.modes.iter().zip(&damping.modes).collect();
    out += &lines(
        &modes,
        &[
            (numbers(6, "mode"), &|(mode, _)| mode.order.to_string()),
            (numbers(18, "damped frequency"), &|(_, one)| {
                format!("{:.2} Hz", one.swinging() / TAU)
            }),
            (numbers(11, "ratio"), &|(_, one)| significant(one.ratio, 3)),
            (numbers(12, "decay"), &|(_, one)| format!("{}/s", significant(one.decay, 3))),
            (numbers(12, "Q, width"), &|(_, one)| q(one.q_half_power())),
            (numbers(12, "Q, amplit."), &|(_, one)| q(one.q_amplitude())),
        ],
    );
    if !damping.rigid.is_empty() {
        let rates: Vec<String> = damping.rigid.iter().map(|rate| significant(*rate, 3)).collect();
        let _ = writeln!(out, "  rigid motions decay at {}/s", rates.join("/s and "));
    }
    out
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
