//! How stiff is the wall of a barrel under a ball, and between two opposite sides?

use sweetspot::bat::body::Bat;
use sweetspot::collision::ball::Ball;
use sweetspot::modes::hoop::{Hoop, Patch, Share};

/// By how much a barrel is pressed in by the test of its compression (m): 0.04 in for baseball bats, 0.07 in
/// for softball bats.
///
/// # Source
///
/// Axe Bat, page on barrel compression, for the two deflections; ASTM F2844 is the test's own standard, whose
/// text was not available.
const DEFLECTIONS: [f64; 2] = [0.04 * 0.0254, 0.07 * 0.0254];
/// Balls of this radius and larger (m) are softballs: between 37 mm of a baseball and 45 mm of an 11 in softball.
const SOFTBALL: f64 = 0.042;

/// The wall of a barrel under the patch of a ball.
#[derive(Debug, Clone)]
pub struct PressedWall {
    /// Outer radius of the barrel there (m).
    pub radius: f64,
    /// Thickness of the wall there, sleeves included (m).
    pub thickness: f64,
    /// Where the ball presses, and how large its patch is.
    pub patch: Patch,
    /// What each harmonic has of the wall's giving way.
    pub shares: Vec<Share>,
}

impl PressedWall {
    /// The wall at `x` (m) under a ball that is compressed by as much as its patch takes
    /// ([`Ball::patch_compression`]); None where the patch is not on
    /// the stretch that is modelled.
    pub fn under(hoop: &Hoop, bat: &Bat, ball: &Ball, x: f64) -> Option<Self> {
        let section = bat.profile().at(x);
        let patch = Patch::under(x, ball.radius_m, section.outer, ball.patch_compression());
        (section.inner > 0.0 && hoop.covers(&patch)).then(|| Self {
            radius: section.outer,
            thickness: section.outer - section.inner,
            patch,
            shares: hoop.under(&patch),
        })
    }

    /// How far the wall gives way to a slow force of 1 N, `Σ C_n` (m/N).
    pub fn flexibility(&self) -> f64 {
        self.shares.iter().map(|share| share.flexibility).sum()
    }

    /// Stiffness of the wall under the ball, `1/Σ C_n` (N/m).
    pub fn stiffness(&self) -> f64 {
        1.0 / self.flexibility()
    }

    /// Stiffness of the barrel between two opposite sides (N/m), each pressed by the patch.
    ///
    /// A force F on one side moves that side in by `F Σ C_n`, the other one by `F Σ (−1)ⁿ C_n`. Of two equal
    /// ones that face each other each side feels both, so that they come nearer to each other by
    ///
    /// ```text
    /// d = 2F Σ (1 + (−1)ⁿ) C_n = 4F Σ C_n over even n
    /// ```
    pub fn between_sides(&self) -> f64 {
        let even = self.shares.iter().filter(|share| share.harmonic.is_multiple_of(2));
        1.0 / (4.0 * even.map(|share| share.flexibility).sum::<f64>())
    }

    /// What a test of the barrel's compression takes for such a ball: the deflection (m) and the force (N).
    pub fn compressed(&self, ball: &Ball) -> [f64; 2] {
        let deflection = DEFLECTIONS[usize::from(ball.radius_m >= SOFTBALL)];
        [deflection, deflection * self.between_sides()]
    }
}
