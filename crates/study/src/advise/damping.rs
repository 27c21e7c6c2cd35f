//! What damps a bat: its materials and its dashpots, and the damping of its modes.

use std::f64::consts::TAU;

use serde::Serialize;

use crate::advise::part::ModelPart;
use crate::engine::{Bat, Damped, Material, Solution};

/// The damping of materials and dashpots.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Damping {
    /// Bounds of every mode's damping ratio by the materials alone.
    // A mode's damping ratio ζ is half the mean of the loss factors, weighted by the strain energy in each material:
    // η/2 for a single material. Springs, joints, absorbers and hands may store energy without loss, so the lower bound
    // is 0.
    pub material_ratio: [f64; 2],
    /// The dashpots and their strengths.
    pub dashpots: Vec<String>,
    /// Damping ratio of each mode; empty without damping.
    pub ratio_by_mode: Vec<f64>,
    /// Frequency of each damped motion (Hz); empty without damping.
    pub damped_frequency_hz_by_mode: Vec<f64>,
}

impl Damping {
    /// The damping of that bat with those modes.
    pub fn of(bat: &Bat, solution: &Solution) -> Self {
        let lossless =
            [ModelPart::Springs, ModelPart::Absorbers, ModelPart::Joints, ModelPart::Grip]
                .iter()
                .any(|p| p.is_on(bat));
        let mut losses: Vec<f64> = materials(bat).map(|material| material.loss_factor).collect();
        if lossless {
            losses.push(0.0);
        }
        let least = losses.iter().copied().fold(f64::INFINITY, f64::min);
        let most = losses.iter().copied().fold(0.0, f64::max);
        let mut dashpots = Vec::new();
        if let Some(grip) = bat.fixtures().grip.filter(|grip| grip.damping > 0.0) {
            dashpots.push(format!("the grip, {} N s/m²", grip.damping));
        }
        for (k, absorber) in bat.fixtures().absorbers.iter().enumerate() {
            if absorber.damping > 0.0 {
                dashpots.push(format!("absorbers[{k}], {} N s/m", absorber.damping));
            }
        }
        let by_mode = |of: fn(&Damped) -> f64| solution.damping.modes.iter().map(of).collect();
        Self {
            material_ratio: [0.5 * least.min(most), 0.5 * most],
            dashpots,
            ratio_by_mode: by_mode(|damped| damped.ratio),
            damped_frequency_hz_by_mode: by_mode(|damped| damped.swinging() / TAU),
        }
    }
}

/// The materials of the bat; a core only where there is a bore.
fn materials(bat: &Bat) -> impl Iterator<Item = &Material> {
    bat.profile().pieces.iter().flat_map(|piece| {
        let layup = bat.layup(piece);
        let bored = [0.0, 0.5, 1.0].iter().any(|s| piece.at(*s).inner > 0.0);
        layup.materials().take(if bored { 2 } else { 1 })
    })
}
