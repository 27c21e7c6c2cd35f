//! What does a hollow barrel's wall do under the ball, and how far is that known?
//!
//! The patch on which a ball presses is the largest error of the model: a hit with half and twice its
//! compression says what it does to BBCOR.

use crate::collision::contact::encounter::Encounter;
use crate::collision::contact::touch::Felt;
use crate::collision::hitter::Hitter;
use crate::collision::strike::SMOOTH;

/// The wall under a ball at one place, and BBCOR of the free bat there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallFigures {
    /// Distance of the place from the knob end (m).
    pub x: f64,
    /// Half lengths of the patch, along the bat and around it (m).
    pub patch: [f64; 2],
    /// Static stiffness under the patch, `1/C` (N/m).
    pub stiffness: f64,
    /// Stiffness over that of the ball, its largest force over its largest compression on a stiff wall.
    pub over_ball: f64,
    /// Mass of one spring-mass with the same C and D, `D/C²` (kg).
    pub mass: f64,
    /// BBCOR of the free bat.
    pub bbcor: WallBbcor,
    /// BBCOR of the bat held 6 in from the knob.
    pub bbcor_pivoted: WallBbcor,
    /// How far the largest force dents the wall, as a slow one would (m).
    pub dent: f64,
    /// Thickness of the wall there (m).
    pub thickness: f64,
}

/// What a wall makes of BBCOR.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallBbcor {
    /// BBCOR with the wall.
    pub with: f64,
    /// BBCOR with a stiff wall.
    pub stiff: f64,
    /// BBCOR with a patch of half and of twice the compression, the smaller first: between them the
    /// modelling error of the patch.
    pub range: [f64; 2],
}

impl WallFigures {
    /// Whether the dent is deeper than half the wall, where linear elasticity ends.
    pub fn is_deep(&self) -> bool {
        self.dent > 0.5 * self.thickness
    }
}

impl Hitter<'_> {
    /// The wall under the ball at `x` (m); None where it does not give way by its hoop modes, and where
    /// ball and bat do not meet.
    pub fn wall_figures(&self, x: f64) -> Option<WallFigures> {
        let hoop = self.hoop.as_ref()?;
        let (closing, beyond) = (self.closing(x)?, self.struck.flexibility(x));
        let beyond = self.effort.completed.then_some(beyond);
        let bent = || self.bent(x, self.by_modes(x), beyond);
        let hit = |felt: &Felt| Some(self.meet(x, felt, closing, SMOOTH)?.0);
        let bbcor = |met: &Encounter| {
            let exit = met.impulse / self.scene.ball.mass - self.scene.ball_speed;
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
            x,
            patch: [patch.half_length, patch.half_width],
            stiffness: 1.0 / under.soft,
            over_ball: stiff.compression / (stiff.peak_force * under.soft),
            mass: under.slow / (under.soft * under.soft),
            bbcor: bbcor(0),
            bbcor_pivoted: bbcor(1),
            dent: met.peak_force * under.soft,
            thickness: section.outer - section.inner,
        })
    }
}
