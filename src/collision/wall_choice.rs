//! Does a hollow barrel's wall deflect in a hit?
//!
//! It does if the user asks for it, and by default if its estimated effect exceeds a share of the tolerance. The
//! estimate needs no solution.

use crate::base::{Error, Result};
use crate::bat::Bat;
use crate::collision::figures::BarrelSpeed;
use crate::collision::hit::{Model, Scene};
use crate::collision::hoop_wall::{
    HoopInHit, HoopWall, WhyRigid, restitution_with_wall, rough_stiffness,
};
use crate::modes::hoop::rings;

/// Whether a hollow barrel's wall deflects in its own hoop modes.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum WallChoice {
    /// If it matters.
    #[default]
    Auto,
    /// Always.
    On,
    /// Never.
    Off,
}

impl WallChoice {
    /// The choices and their words.
    pub const ALL: [(&'static str, Self); 3] =
        [("auto", Self::Auto), ("on", Self::On), ("off", Self::Off)];

    /// The choice for that word; [`Self::Auto`] for any other.
    pub fn named(word: &str) -> Self {
        Self::ALL
            .into_iter()
            .find(|(name, _)| *name == word)
            .map_or(Self::Auto, |(_, choice)| choice)
    }
}

impl Scene {
    /// This scene with the chosen treatment of that bat's wall. `tolerance` is that of exit speeds over the closing
    /// speed; `None` if the number of modes is prescribed and nothing else may contribute.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] if the wall was asked for but has no hoop modes, or the model cannot use them.
    pub fn with_wall(
        self,
        choice: WallChoice,
        bat: &Bat,
        model: Model,
        tolerance: Option<f64>,
    ) -> Result<Self> {
        let hoop = match (choice, model) {
            // A person's figures for the wall override those from its shape.
            _ if self.wall.is_some() => HoopInHit::None,
            (WallChoice::On, Model::Contact) => {
                let tolerance = tolerance.unwrap_or(USUAL);
                HoopInHit::Counted(HoopWall::of(bat, self.ball.radius_m, tolerance)?)
            }
            (WallChoice::On, _) => {
                let found = format!("on with `model` {}", model.name());
                let expected = "`model` contact: only there a wall is compliant";
                return Err(Error::value("`wall`", found, expected));
            }
            (_, Model::Contact) if rings(bat) => match (choice, tolerance) {
                (WallChoice::Off, _) => HoopInHit::LeftOut(WhyRigid::Asked),
                (_, None) => HoopInHit::LeftOut(WhyRigid::ModesTold),
                (_, Some(tolerance)) => self.where_it_matters(bat, tolerance),
            },
            _ => HoopInHit::None,
        };
        Ok(Self { hoop, ..self })
    }

    /// This scene with the wall of that bat solved to 1e-3 of the closing speed, if it deflects: enough for differences
    /// between bats whose walls are all solved so.
    ///
    /// # Errors
    ///
    /// As [`HoopWall::of`].
    pub fn with_rough_wall(&self, bat: &Bat) -> Result<Self> {
        let hoop = match &self.hoop {
            HoopInHit::Counted(_) => {
                HoopInHit::Counted(HoopWall::of(bat, self.ball.radius_m, 1e-3)?)
            }
            other => other.clone(),
        };
        Ok(Self { hoop, ..self.clone() })
    }

    /// The wall, if it may change an exit speed by more than a share of the tolerance. If its modes cannot be found it
    /// stays rigid, and the reason is kept.
    fn where_it_matters(&self, bat: &Bat, tolerance: f64) -> HoopInHit {
        /// Share of the tolerance, so that modes and steps have the rest.
        const SHARE: f64 = 0.3;
        let gain = self.gain_by_wall(bat).unwrap_or(0.0);
        let rigid = HoopInHit::LeftOut(WhyRigid::Small { gain, tolerance });
        if rigid.error() <= SHARE * tolerance {
            return rigid;
        }
        match HoopWall::of(bat, self.ball.radius_m, tolerance) {
            Ok(wall) => HoopInHit::Counted(wall),
            Err(error) => HoopInHit::LeftOut(WhyRigid::Unsolved(error.to_string())),
        }
    }

    /// Estimated increase of the restitution by the wall, for a hit 6 in from the tip; `None` for a barrel without a
    /// wall, for a ball without a force law, and for one that does not reach the bat.
    pub fn gain_by_wall(&self, bat: &Bat) -> Option<f64> {
        let wall = rough_stiffness(bat)?;
        let (stiffness, exponent) = (self.ball.stiffness?, self.ball.exponent?);
        let barrel = BarrelSpeed::of(bat, self, BarrelSpeed::BROADCAST.min(0.5 * bat.length()));
        let closing = barrel.speed + self.ball_speed;
        let body = bat.inertia();
        let arm = bat.length() - barrel.from_tip - body.balance_point;
        let recoil = 1.0 / body.mass + arm * arm / body.about_balance;
        let energy = 0.5 * closing * closing / (1.0 / self.ball.mass_kg + recoil);
        let stiff = self.restitution(energy);
        let pressed = self.force_law(stiff, energy).ok()?.pressed_by(energy);
        let ball = stiffness * pressed.powf(exponent - 1.0);
        let gain = restitution_with_wall(stiff, exponent, ball / wall) - stiff;
        (closing > 0.0 && gain.is_finite()).then_some(gain)
    }
}

/// The default tolerance of exit speeds.
const USUAL: f64 = 1e-4;
