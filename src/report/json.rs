//! The JSON files: modes and hits, in SI, the unit in every key's name.
//!
//! Numbers are written in the shortest form that reads back to the same bits; there is never a
//! NaN or an infinity. What does not exist is null.

use serde_json::{Value, json};

use crate::bat::{Bat, STANDARD_PIVOT, Weighed};
use crate::ignored::ignored;
use crate::report::damped;
use crate::report::resolved::resolved;
use crate::solve::Solution;
use crate::trade::reference::solver_name;

/// Which samples of the shapes to write.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ShapePoints {
    /// At every node of the mesh.
    Nodes,
    /// At that many even points from end to end.
    Even(usize),
}

/// The `sweetspot-modes/1` document; `timing` only if wanted.
pub fn modes(bat: &Bat, solution: &Solution, points: ShapePoints, timing: bool) -> Value {
    let places = places(bat, solution, points);
    let modes: Vec<Value> = (0..solution.modes.len()).map(|k| mode(solution, k, &places)).collect();
    let mut document = json!({
        "format": "sweetspot-modes/1",
        "generator": generator(),
        "bat": resolved(bat),
        "summary": summary(bat),
        "model": {
            "theory": solution.theory.name(),
            "elements": solution.mesh.len(),
            "degree": solution.degree,
            "solver": solver_name(solution.solver),
            "degrees_of_freedom": solution.degrees_of_freedom(),
            "lanczos_steps": solution.steps,
            "plan": solution.reason.to_string(),
            "tolerance_met": solution.met,
            "no_mode_missing": solution.complete(),
            "ignored": ignored(bat, solution),
        },
        "rigid_modes": solution.rigid_modes,
        "modes": modes,
    });
    let damping = damped::of_model(solution);
    if !damping.is_null() {
        document["model"]["damping"] = damping;
    }
    if timing {
        document["timing"] = json!({
            "plan_s": solution.timing.plan.as_secs_f64(),
            "assemble_s": solution.timing.assemble.as_secs_f64(),
            "solve_s": solution.timing.solve.as_secs_f64(),
        });
    }
    document
}

/// Which program wrote this.
pub fn generator() -> Value {
    json!({ "program": "sweetspot", "version": env!("CARGO_PKG_VERSION") })
}

fn mode(solution: &Solution, k: usize, places: &[f64]) -> Value {
    let mode = &solution.modes[k];
    let damping_ratio = solution.damping.modes.get(k).map_or(0.0, |damped| damped.ratio);
    let along = |f: &dyn Fn(f64) -> f64| places.iter().map(|x| f(*x)).collect::<Vec<f64>>();
    let mut document = json!({
        "order": mode.order,
        "frequency_hz": mode.frequency(),
        "omega_rad_s": mode.omega,
        "damping_ratio": damping_ratio,
        "modal_mass_kg": mode.modal_mass,
        "nodes_m": mode.nodes,
        "error": {
            "discretization": mode.error.discretization,
            "round_off": mode.error.round_off,
            "residual": mode.error.residual,
            "nodes_m": mode.error.nodes,
            "modal_mass": mode.error.modal_mass,
            "shape": mode.error.shape,
        },
        "shape": {
            "x_m": places,
            "deflection": along(&|x| mode.shape.deflection(x)),
            "rotation": along(&|x| mode.shape.rotation(x)),
        },
    });
    let damping = damped::of_mode(solution, k);
    if !damping.is_null() {
        document["damping"] = damping;
    }
    document
}

fn places(bat: &Bat, solution: &Solution, points: ShapePoints) -> Vec<f64> {
    match points {
        ShapePoints::Nodes => solution.mesh.nodes(),
        ShapePoints::Even(1) => vec![0.0],
        ShapePoints::Even(n) => (0..n).map(|k| bat.length() * k as f64 / (n - 1) as f64).collect(),
    }
}

fn summary(bat: &Bat) -> Value {
    let inertia = bat.inertia();
    let mut summary = json!({
        "length_m": bat.length(),
        "mass_kg": inertia.mass,
        "balance_point_m": inertia.balance_point,
        "inertia_balance_kg_m2": inertia.about_balance,
        "pivot_m": STANDARD_PIVOT,
        "inertia_pivot_kg_m2": inertia.about(STANDARD_PIVOT),
        "center_of_percussion_m": inertia.center_of_percussion(STANDARD_PIVOT),
    });
    let weighed = &bat.weighed;
    if weighed != &Weighed::default() {
        summary["weighed"] = json!({
            "density_factor": bat.factors[0],
            "modulus_factor": bat.factors[1],
        });
    }
    if let Some(weighed) = weighed.balance_point {
        summary["weighed"]["balance_point_m"] = json!(weighed);
        summary["weighed"]["balance_point_difference_m"] = json!(inertia.balance_point - weighed);
    }
    summary
}
