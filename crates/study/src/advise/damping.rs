//! What damps a bat, as far as its materials say without solving anything.

use crate::advise::part::ModelPart;
use sweetspot::bat::body::Bat;
use sweetspot::bat::material::Material;

/// The damping that the materials make, and what else takes energy.
#[derive(Debug, Clone, PartialEq)]
pub struct Damping {
    /// Bounds of every mode's damping ratio ζ by the materials alone.
    ///
    /// A mode's ζ is half the mean of the loss factors, weighed by the strain energy in each
    /// material: η/2 where there is one material. Springs, joints, absorbers and hands may store
    /// energy without loss, which makes 0 the lower bound.
    pub material: [f64; 2],
    /// Dashpots: what they are and how strong.
    pub dashpots: Vec<String>,
}

impl Damping {
    /// What damps that bat.
    pub fn of(bat: &Bat) -> Self {
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
        Self { material: [0.5 * least.min(most), 0.5 * most], dashpots }
    }
}

/// The materials that the bat really has: a core only where there is a bore.
fn materials(bat: &Bat) -> impl Iterator<Item = &Material> {
    bat.profile().pieces.iter().flat_map(|piece| {
        let layup = bat.layup(piece);
        let bored = [0.0, 0.5, 1.0].iter().any(|s| piece.at(*s).inner > 0.0);
        layup.materials().take(if bored { 2 } else { 1 })
    })
}
