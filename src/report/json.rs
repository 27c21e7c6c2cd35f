//! The JSON files: modes and hits, in SI, the unit in every key's name.
//!
//! Numbers are written in the shortest form that reads back to the same bits; there is never a
//! NaN or an infinity. What does not exist is null.

use serde::Serialize;
use serde_json::{Value, json};

use crate::bat::{Bat, STANDARD_PIVOT, Weighed};
use crate::collision::hit::{Impact, Model, Outcome, Scene};
use crate::collision::sweet_spot::{Peak, SweetSpot};
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

/// The `sweetspot-hit/1` document.
pub fn hit(bat: &Bat, model: Model, scene: &Scene, impacts: &[Impact], spot: &SweetSpot) -> Value {
    let ball = &scene.ball;
    json!({
        "format": "sweetspot-hit/1",
        "generator": generator(),
        "model": model_name(model),
        "scene": {
            "bat_pivot_m": scene.pivot,
            "swing_rad_s": scene.swing,
            "ball": {
                "name": ball.name,
                "source": ball.source,
                "mass_kg": ball.mass,
                "radius_m": ball.radius,
                "stiffness": ball.stiffness,
                "exponent": ball.exponent,
                "cor": ball.cor,
            },
            "ball_speed_m_s": scene.ball_speed,
            "cor": scene.cor,
        },
        "impacts": impacts.iter().map(|i| impact(bat, i)).collect::<Vec<_>>(),
        "sweet_spot": {
            "exit_speed_max": spot.exit_speed_max.map(peak),
            "vibration_min": spot.vibration_min.map(peak),
            "node_mode_1_m": spot.node_mode_1,
            "node_mode_2_m": spot.node_mode_2,
            "center_of_percussion_m": spot.center_of_percussion,
            "zone_m": spot.zone,
        },
    })
}

/// The name that the command line and the files use.
pub fn model_name(model: Model) -> &'static str {
    match model {
        Model::Rigid => "rigid",
        Model::EnergyLoss(_) => "energy-loss",
    }
}

fn peak(peak: Peak) -> Value {
    json!({ "x_m": peak.x, "value": peak.value })
}

fn impact(bat: &Bat, impact: &Impact) -> Value {
    let outcome = impact.outcome.as_ref();
    let number = |f: &dyn Fn(&Outcome) -> f64| outcome.map(f);
    let energy = outcome.map(|o| EnergyJson {
        initial: o.energy.initial,
        ball: o.energy.ball,
        bat_rigid: o.energy.bat_rigid,
        vibration: o.energy.vibration(),
        vibration_by_mode: &o.energy.vibration_by_mode,
        dissipated_ball: o.energy.dissipated_ball,
        dissipated_damping: 0.0,
        imbalance: o.energy.imbalance(),
    });
    json!({
        "x_m": impact.x,
        "from_tip_m": bat.length() - impact.x,
        "bat_speed_m_s": impact.bat_speed,
        "exit_speed_m_s": number(&|o| o.exit_speed),
        "rigid_exit_speed_m_s": impact.rigid_exit_speed,
        "impulse_n_s": number(&|o| o.impulse),
        "contact_time_s": null,
        "peak_force_n": null,
        "collision_efficiency": number(&|o| o.collision_efficiency),
        "bbcor": number(&|o| o.bbcor),
        "bbcor_pivoted": number(&|o| o.bbcor_pivoted),
        "modes_used": outcome.map(|o| o.energy.vibration_by_mode.len()),
        "flags": impact.flags,
        "energy_j": energy,
        "error": { "exit_speed": number(&|o| o.error) },
    })
}

#[derive(Serialize)]
struct EnergyJson<'a> {
    initial: f64,
    ball: f64,
    bat_rigid: f64,
    vibration: f64,
    vibration_by_mode: &'a [f64],
    dissipated_ball: f64,
    dissipated_damping: f64,
    imbalance: f64,
}
