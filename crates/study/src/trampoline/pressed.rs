//! How stiff is the wall of a barrel under a ball, and between two opposite sides?

use serde::Serialize;

use crate::engine::{Ball, Bat, HoopWall};
use sweetspot::modes::hoop::Share;

/// Deflections in the test of a barrel's compression (m): 0.04 in for baseball bats, 0.07 in for softball bats.
///
/// # Source
///
/// Axe Bat, page on barrel compression, for the two deflections; ASTM F2844 is the test's own standard, whose
/// text was not available.
const DEFLECTIONS: [f64; 2] = [0.04 * 0.0254, 0.07 * 0.0254];
/// Balls of this radius and larger (m) are softballs: between 37 mm of a baseball and 45 mm of an 11 in softball.
const SOFTBALL: f64 = 0.042;

/// The wall under a ball at one place.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct PressedWall {
    /// Impact point (m).
    pub x_m: f64,
    /// Distance of that from the tip (m).
    pub from_tip_m: f64,
    /// Outer radius there (m).
    pub radius_m: f64,
    /// Thickness of the wall there, sleeves included (m).
    pub thickness_m: f64,
    /// Force on the ball's patch over the deflection of the wall (N/m).
    // 1/Σ C_n.
    pub stiffness_n_m: f64,
    /// The stiffness over that of the ball, force over compression at the largest force on a stiff wall; null for
    /// a ball without a force law.
    pub over_ball: Option<f64>,
    /// Compression of the ball for which the patch has this size (m).
    pub compression_m: f64,
    /// Half the length of the patch along the bat (m).
    pub patch_half_length_m: f64,
    /// Half the width of the patch around the bat (m).
    pub patch_half_width_m: f64,
    /// The share of each harmonic.
    pub by_harmonic: Vec<HarmonicShare>,
}

/// The share of a harmonic in the deflection of the wall.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct HarmonicShare {
    /// Waves around the barrel.
    pub harmonic: usize,
    /// Its static flexibility (m/N).
    pub flexibility_m_n: f64,
    /// Number of its modes in a hit; the remaining flexibility follows the force.
    pub modes: usize,
}

/// The barrel pressed between two opposite sides, each with the ball's patch.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct BarrelCompression {
    /// Deflection of both sides together (m).
    pub deflection_m: f64,
    /// Force that it takes (N).
    pub force_n: f64,
}

impl PressedWall {
    /// The wall at `x` (m) under a ball that is compressed by as much as its patch takes
    /// ([`Ball::patch_compression`]); `None` if the patch is not on the modelled stretch.
    pub fn under(wall: &HoopWall, bat: &Bat, ball: &Ball, x: f64) -> Option<Self> {
        let section = bat.profile().at(x);
        let compression_m = ball.patch_compression();
        let patch = wall.patch(x, compression_m);
        let shares = wall.shares(x, compression_m).filter(|_| section.inner > 0.0)?;
        let share = |share: Share| HarmonicShare {
            harmonic: share.harmonic,
            flexibility_m_n: share.flexibility,
            modes: share.gains.len(),
        };
        let by_harmonic: Vec<HarmonicShare> = shares.into_iter().map(share).collect();
        Some(Self {
            x_m: x,
            from_tip_m: bat.length() - x,
            radius_m: section.outer,
            thickness_m: section.outer - section.inner,
            stiffness_n_m: 1.0 / by_harmonic.iter().map(|share| share.flexibility_m_n).sum::<f64>(),
            over_ball: None,
            compression_m,
            patch_half_length_m: patch.half_length,
            patch_half_width_m: patch.half_width,
            by_harmonic,
        })
    }

    /// Stiffness of the barrel between two opposite sides (N/m), each pressed by the patch.
    ///
    /// A force F on one side moves that side in by `F Σ C_n`, and the other one by `F Σ (−1)ⁿ C_n`. With two equal and
    /// opposite forces each side moves by both, so that they approach each other by
    ///
    /// ```text
    /// d = 2F Σ (1 + (−1)ⁿ) C_n = 4F Σ C_n over even n
    /// ```
    pub fn between_sides(&self) -> f64 {
        let even = self.by_harmonic.iter().filter(|share| share.harmonic.is_multiple_of(2));
        1.0 / (4.0 * even.map(|share| share.flexibility_m_n).sum::<f64>())
    }

    /// The force in a test of the barrel's compression with such a ball.
    pub fn compressed(&self, ball: &Ball) -> BarrelCompression {
        let deflection_m = DEFLECTIONS[usize::from(ball.radius_m >= SOFTBALL)];
        BarrelCompression { deflection_m, force_n: deflection_m * self.between_sides() }
    }
}
