//! The JSON file of a hit, in SI, the unit in every key's name.

use serde::Serialize;
use serde_json::{Value, json};

use crate::bat::Bat;
use crate::collision::figures::Figures;
use crate::collision::hit::{Impact, Model, Outcome, Scene};
use crate::collision::sweet_spot::{Peak, SweetSpot};
use crate::report::json::generator;

/// The `sweetspot-hit/1` document.
pub fn hit(bat: &Bat, model: Model, scene: &Scene, impacts: &[Impact], spot: &SweetSpot) -> Value {
    let ball = &scene.ball;
    let mut document = json!({
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
            "hands_m": scene.hands,
            "energies_seen_from": if bat.fixtures.holding() { "hands" } else { "ground" },
        },
        "impacts": impacts.iter().map(|i| impact(bat, i)).collect::<Vec<_>>(),
        "sweet_spot": sweet_spot(spot),
    });
    if !ball.cor_by_speed.is_empty() {
        document["scene"]["ball"]["cor_by_speed"] = json!(ball.cor_by_speed);
    }
    if let Some(wall) = scene.wall {
        document["scene"]["wall"] =
            json!({ "stiffness_n_m": wall.stiffness, "mass_kg": wall.mass });
    }
    document
}

fn sweet_spot(spot: &SweetSpot) -> Value {
    json!({
        "exit_speed_max": spot.exit_speed_max.map(peak),
        "vibration_min": spot.vibration_min.map(peak),
        "node_mode_1_m": spot.node_mode_1,
        "node_mode_2_m": spot.node_mode_2,
        "center_of_percussion_m": spot.center_of_percussion,
        "zone_m": spot.zone,
        "hands_velocity_min": spot.hands_velocity_min.map(peak),
        "hands_acceleration_min": spot.hands_acceleration_min.map(peak),
        "inch_off_m_s": spot.inch_off,
    })
}

/// The standard figures, beside the impacts in the same document.
pub fn figures(figures: &Figures) -> Value {
    let best = figures.best.as_ref().and_then(|best| best.outcome.as_ref());
    let swings = figures.swings.iter().map(|swung| {
        json!({
            "exponent": swung.exponent,
            "swing_rad_s": swung.swing,
            "exit_speed_max": swung.best.map(peak),
        })
    });
    let moves = figures.moves.iter().map(|(what, spot)| {
        let mut moved = sweet_spot(spot);
        moved["change"] = json!(what);
        moved
    });
    json!({
        "certified": false,
        "bat_ball_speed_m_s": best.map(|o| o.exit_speed),
        "collision_efficiency": best.map(|o| o.collision_efficiency),
        "bbcor": best.map(|o| o.bbcor),
        "bbcor_pivoted": best.map(|o| o.bbcor_pivoted),
        "bbcor_max": figures.bbcor_max.map(peak),
        "bbcor_pivoted_max": figures.bbcor_pivoted_max.map(peak),
        "rigid_exit_speed_max": figures.rigid_best.map(peak),
        "swings": swings.collect::<Vec<_>>(),
        "moves": moves.collect::<Vec<_>>(),
    })
}

/// The name that the command line and the files use.
pub fn model_name(model: Model) -> &'static str {
    match model {
        Model::Rigid => "rigid",
        Model::EnergyLoss(_) => "energy-loss",
        Model::Pulse(_) => "pulse",
        Model::Contact => "contact",
    }
}

fn peak(peak: Peak) -> Value {
    json!({ "x_m": peak.x, "value": peak.value })
}

/// One impact.
pub fn impact(bat: &Bat, impact: &Impact) -> Value {
    let outcome = impact.outcome.as_ref();
    let number = |f: &dyn Fn(&Outcome) -> f64| outcome.map(f);
    let energy = outcome.map(|o| EnergyJson {
        initial: o.energy.initial,
        ball: o.energy.ball,
        bat_rigid: o.energy.bat_rigid,
        vibration: o.energy.vibration(),
        vibration_by_mode: &o.energy.vibration_by_mode,
        dissipated_ball: o.energy.dissipated_ball,
        dissipated_damping: o.energy.dissipated_damping,
        wall: o.energy.wall,
        imbalance: o.energy.imbalance(),
    });
    json!({
        "x_m": impact.x,
        "from_tip_m": bat.length() - impact.x,
        "bat_speed_m_s": impact.bat_speed,
        "exit_speed_m_s": number(&|o| o.exit_speed),
        "rigid_exit_speed_m_s": impact.rigid_exit_speed,
        "cor": number(&|o| o.cor),
        "impulse_n_s": number(&|o| o.impulse),
        "contact_time_s": outcome.and_then(|o| o.contact_time),
        "peak_force_n": outcome.and_then(|o| o.peak_force),
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
    #[serde(skip_serializing_if = "is_zero")]
    wall: f64,
    imbalance: f64,
}

/// A wall that does not give way has no line.
fn is_zero(value: &f64) -> bool {
    *value == 0.0
}
