//! What does a hollow barrel's wall do under the ball, and how accurately is that known?
//!
//! The patch on which a ball presses is the largest error of the model: hits with half and twice its compression show
//! its effect on BBCOR.

use serde::{Deserialize, Serialize};

use crate::collision::contact::encounter::Encounter;
use crate::collision::contact::touch::DrivingPoint;
use crate::collision::hitter::{Blow, Hitter};
use crate::collision::strike::SMOOTH;

/// The wall of a hollow barrel under the ball.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct WallFigures {
    /// The place (m).
    pub x_m: f64,
    /// Half lengths of the patch on which the ball presses, along the bat and around it (m).
    pub patch_half_lengths_m: [f64; 2],
    /// Static stiffness under the patch (N/m).
    pub stiffness_n_m: f64,
    /// That stiffness over the ball's, its largest force over its largest compression on a stiff wall.
    pub stiffness_over_ball: f64,
    /// Mass (kg) of a single spring-mass system with the same response to a slow force.
    pub mass_kg: f64,
    /// BBCOR there with the wall, with a rigid wall, and the range due to the patch.
    pub bbcor: WallBbcor,
    /// BBCOR of the bat held 6 in from the knob, likewise.
    #[serde(skip)]
    pub bbcor_pivoted: WallBbcor,
    /// Depth of the dent under the largest force (m).
    pub dent_m: f64,
    /// Thickness of the wall there (m); a dent deeper than half of it is outside the theory.
    pub thickness_m: f64,
}

/// The effect of the wall on BBCOR.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct WallBbcor {
    /// With the wall.
    pub with: f64,
    /// With a rigid wall.
    pub stiff: f64,
    /// With half and with twice the compression of the patch: the modelling error.
    pub range: [f64; 2],
}

impl WallFigures {
    /// Whether the dent is deeper than half the wall, the limit of linear elasticity.
    pub fn is_deep(&self) -> bool {
        self.dent_m > 0.5 * self.thickness_m
    }

    /// With BBCOR of the bat held 6 in from the knob.
    pub fn pivoted(self) -> Self {
        Self { bbcor: self.bbcor_pivoted, ..self }
    }
}

impl Hitter<'_> {
    /// The wall under the ball at `x` (m); `None` if it does not deflect in its hoop modes, or where ball and bat do
    /// not meet.
    pub fn wall_figures(&self, x: f64) -> Option<WallFigures> {
        let hoop = self.hoop.as_ref()?;
        let (closing, beyond) = (self.closing(x)?, self.struck.flexibility(x));
        let beyond = self.effort.completed.then_some(beyond);
        let bent = || self.bent(x, self.by_modes(x), beyond);
        let hit = |felt: &DrivingPoint| Some(self.meet(Blow::alone(x, felt, closing), SMOOTH)?.0);
        let bbcor = |met: &Encounter| {
            let exit = met.impulse / self.scene.ball.mass_kg - self.scene.ball_speed;
            let [_, free, pivoted] = self.figures(x, exit);
            [free, pivoted]
        };
        let stiff_modes = vec![0.0; self.wall_modes.len()];
        let mut stiff = bent();
        stiff.gains.splice(0..0, stiff_modes);
        let stiff = hit(&stiff)?;
        let compression = self.scene.ball.patch_compression();
        let under = hoop.under(x, compression);
        if under.soft <= 0.0 {
            return None;
        }
        let met = hit(&under.full.before(bent()))?;
        let other = |times: f64| {
            let under = hoop.under(x, times * compression);
            hit(&under.full.before(bent())).map(|met| bbcor(&met))
        };
        let (half, twice) = (other(0.5)?, other(2.0)?);
        let [with, rigid] = [bbcor(&met), bbcor(&stiff)];
        let bbcor = |k: usize| WallBbcor {
            with: with[k],
            stiff: rigid[k],
            range: [half[k].min(twice[k]), half[k].max(twice[k])],
        };
        let patch = hoop.patch(x, compression);
        let section = self.profile.at(x);
        Some(WallFigures {
            x_m: x,
            patch_half_lengths_m: [patch.half_length, patch.half_width],
            stiffness_n_m: 1.0 / under.soft,
            stiffness_over_ball: stiff.compression / (stiff.peak_force * under.soft),
            mass_kg: under.slow / (under.soft * under.soft),
            bbcor: bbcor(0),
            bbcor_pivoted: bbcor(1),
            dent_m: met.peak_force * under.soft,
            thickness_m: section.outer - section.inner,
        })
    }
}
