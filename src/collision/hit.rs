//! What is a hit: model, swing, pitch and ball; exit speed, impulse and energies?

use serde::{Deserialize, Serialize};

use crate::base::Result;
use crate::bat::STANDARD_PIVOT;
use crate::collision::ball::Ball;
use crate::collision::contact::collider::{Law, LawTerms};
use crate::collision::energy_loss::EnergyLoss;
use crate::collision::hoop_wall::{HarmonicEnergy, HoopInHit};
use crate::collision::pulse::Pulse;

/// How the model treats the bending of the bat, from none to ball and modes together.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Model {
    /// The bat does not bend.
    Rigid,
    /// The WPI report's empirical loss to vibration.
    EnergyLoss(EnergyLoss),
    /// A force pulse of known form excites the modes.
    Pulse(Pulse),
    /// Ball and modes interact while they are in contact.
    Contact,
}

impl Model {
    /// The models, each with its usual constants.
    pub fn all() -> [Self; 4] {
        [
            Self::Contact,
            Self::Pulse(Pulse::default()),
            Self::EnergyLoss(EnergyLoss::default()),
            Self::Rigid,
        ]
    }

    /// The name of the model.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rigid => "rigid",
            Self::EnergyLoss(_) => "energy-loss",
            Self::Pulse(_) => "pulse",
            Self::Contact => "contact",
        }
    }
}

/// Limit on steps times modes of contacts: beyond it, hits at many places are not improved further, and best places are
/// not searched more closely. A usual ball takes 70,000 along an R161, and 1.4 million with all figures of its hits.
/// With this limit the stiffest balls take ten times as long as a usual one.
pub const MOST_WORK: u64 = 6_000_000;

/// Accuracy of a contact's computation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Effort {
    /// Relative accuracy of the force in the steps.
    pub accuracy: f64,
    /// Whether the omitted modes contribute their flexibility, by a last mode with a suitable mass; otherwise only the
    /// given modes count.
    pub completed: bool,
    /// Whether the convergence of the answers was not observed; errors are then stated three times as large.
    pub unsettled: bool,
}

impl Default for Effort {
    /// Steps for exit speeds to 1e-4 of the closing speed or better.
    fn default() -> Self {
        Self { accuracy: 1e-3, completed: true, unsettled: false }
    }
}

/// A swing and a pitch.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Rotation centre of the swing beyond the knob end (m), negative inside the handle.
    pub pivot: f64,
    /// Angular speed of the swing (rad/s).
    pub swing: f64,
    /// The ball.
    pub ball: Ball,
    /// Speed of the ball towards the bat (m/s).
    pub ball_speed: f64,
    /// Coefficient of restitution, unless the ball's depends on the speed.
    pub cor: f64,
    /// Position of the hands (m from the knob end).
    pub hands: f64,
    /// The barrel's wall under the ball, by a person's own figures, if there are any.
    pub wall: Option<Wall>,
    /// Whether the wall deflects in its hoop modes, those of the bat that the scene was made for; for another bat they
    /// are solved again. Not used if [`Self::wall`] is given.
    pub hoop: HoopInHit,
}

impl Default for Scene {
    /// An average major-league swing at a 90 mph pitch: 43 rad/s about a point 2.5 in beyond the knob end, a baseball
    /// at 83 mph, hands at the standard pivot, a rigid wall. A bat of 33 in moves at 72 mph 6 in from its tip, and the
    /// ball leaves an R161 at 107 mph.
    ///
    /// # Source
    ///
    /// MLB glossary, Statcast, "Bat Speed": measured six inches from the head of the bat; the average in the major
    /// leagues is 71.5 mph. A pitch of 90 mph at release has about 0.92 of that at the plate, the share with which the
    /// squared-up balls of `validation/` come out right.
    fn default() -> Self {
        let ball = Ball::baseball();
        Self {
            pivot: 2.5 * 0.0254,
            swing: 43.0,
            ball_speed: 83.0 * 0.447_04,
            cor: ball.cor,
            ball,
            hands: STANDARD_PIVOT,
            wall: None,
            hoop: HoopInHit::None,
        }
    }
}

impl Scene {
    /// Whether the barrel's wall deflects under the ball, by given figures or in its hoop modes.
    pub fn wall_gives_way(&self) -> bool {
        self.wall.is_some() || self.hoop.wall().is_some()
    }

    /// Speed (m/s) at which the ball would hit a rigid wall with that energy (J, of the relative motion), and so be
    /// compressed equally.
    fn speed_on_wall(&self, energy: f64) -> f64 {
        (2.0 * energy / self.ball.mass_kg).sqrt()
    }

    /// e₀ of a ball hit with that energy (J, of the relative motion): its value on a rigid wall at the speed with the
    /// same energy.
    pub fn restitution(&self, energy: f64) -> f64 {
        self.ball.restitution_at(self.speed_on_wall(energy)).unwrap_or(self.cor)
    }

    /// The ball's force law with that e₀, for a hit with that energy (J, of the relative motion).
    ///
    /// # Errors
    ///
    /// As [`Ball::spring`].
    pub fn force_law(&self, restitution: f64, energy: f64) -> Result<Box<dyn Law>> {
        let [stiffness, exponent] = self.ball.spring()?;
        let speed = self.speed_on_wall(energy);
        Ok((self.ball.law.0)(LawTerms { stiffness, exponent, restitution, speed }))
    }
}

/// The wall of a hollow barrel as a spring under the ball: a shell mode without momentum, so that it affects neither
/// the rigid motion nor the bending modes.
///
/// A mode of mass m and `ω² = k/m` deflects by `F/k` under a slow force. Without a mass it is a spring in series with the
/// ball.
///
/// # Source
///
/// A. M. Nathan, D. A. Russell, L. V. Smith, "The physics of the trampoline effect in baseball and
/// softball bats", Engineering of Sport 5 (2004), for ball and wall as springs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wall {
    /// Stiffness k (N/m).
    pub stiffness: f64,
    /// Mass m (kg); 0 is a spring in series with the ball.
    pub mass: f64,
}

/// One impact. A value that does not exist (no real solution, no contact) is `None`.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Impact {
    /// Distance of the impact point from the knob end (m).
    pub x: f64,
    /// Speed of the bat at `x` before the hit (m/s).
    pub bat_speed: f64,
    /// Exit speed of the ball off a bat that does not bend (m/s).
    pub rigid_exit_speed: Option<f64>,
    /// The outcome; `None` if ball and bat do not meet or there is no real solution.
    pub outcome: Option<Outcome>,
    /// Flags of anything unusual in this impact, or of the reason why it has no outcome.
    pub flags: Vec<&'static str>,
}

/// The result of the hit.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Outcome {
    /// Speed of the ball off the bat once it has left for good (m/s).
    pub exit_speed: f64,
    /// Coefficient of restitution e₀ of this hit.
    pub cor: f64,
    /// Impulse `J` (N s).
    pub impulse: f64,
    /// Collision efficiency `e_A = (v_out − V)/(v_in + V)`, V the bat's speed at the impact point.
    pub collision_efficiency: f64,
    /// Contact time (s), all touches together, if the model has one.
    pub contact_time: Option<f64>,
    /// The ball's first departure, if the model has times.
    pub first_separation: Option<Separation>,
    /// Largest force (N), if the model has one.
    pub peak_force: Option<f64>,
    /// Largest compression of the ball (m), if the model has one.
    pub peak_compression: Option<f64>,
    /// BBCOR of the free bat: `e_A (1 + r) + r` with `r = m/M_eff`. A bat that is held has its own M_eff, here and
    /// below.
    pub bbcor: f64,
    /// BBCOR of the bat held 6 in from the knob: `e_A (1 + r) + r` with `r = m Q²/I`.
    pub bbcor_pivoted: f64,
    /// Where the energy went.
    pub energy: Energy,
    /// Estimated error of the exit speed, relative to the closing speed: due to omitted modes, to steps, and to the
    /// mesh.
    pub error: f64,
    /// The part of [`Self::error`] that more modes would remove.
    pub truncation: f64,
    /// The part of [`Self::error`] that shorter steps would remove.
    pub steps: f64,
    /// The part of [`Self::error`] that more and better hoop modes of the wall would remove.
    pub wall: f64,
}

impl Outcome {
    /// Enlarges the errors of an answer whose convergence was not observed. Of 101 places of an R161 and the stiffest
    /// ball (1e10 N/m^1.84), five differed from the answers of the next rounds by more than the error stated before, at
    /// most by 3.8 times.
    pub(super) fn unsettled(&mut self) {
        const MORE: f64 = 3.0;
        self.error += (MORE - 1.0) * (self.error - self.wall);
        self.truncation *= MORE;
        self.steps *= MORE;
        self.first_separation.iter_mut().for_each(|first| first.error *= MORE);
    }
}

/// The moment at which the ball first leaves the bat.
// The bat may catch up with it again.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct Separation {
    /// Time since the first touch (s).
    #[serde(rename = "time_s")]
    pub time: f64,
    /// Speed of the ball at that moment (m/s).
    #[serde(rename = "exit_speed_m_s")]
    pub exit_speed: f64,
    /// Possible error of that speed, relative to the closing speed.
    #[serde(rename = "exit_speed_error")]
    pub error: f64,
}

/// Energies (J): the initial one is the sum of all others; each is computed separately.
// For a held bat, as seen by its hands.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub struct Energy {
    /// Energy of ball and bat before the hit (J).
    pub initial: f64,
    /// Energy of the ball after the hit (J).
    pub ball: f64,
    /// Energy of the bat's rigid motion after the hit (J).
    pub bat_rigid: f64,
    /// Energy of all bending modes after the hit (J).
    pub vibration: f64,
    /// Energy of each bending mode after the hit (J).
    pub vibration_by_mode: Vec<f64>,
    /// Energy lost in the ball (J).
    pub dissipated_ball: f64,
    /// Energy lost in the bat's own damping (J).
    pub dissipated_damping: f64,
    /// Energy left in the barrel's wall (J), if the wall deflects.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub wall: f64,
    /// That energy by the harmonics around the barrel; left out if the wall has none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub wall_by_harmonic: Vec<HarmonicEnergy>,
    /// Energy that the model created (−) or failed to account for (+) (J).
    pub imbalance: f64,
}

/// A rigid wall has no entry.
fn is_zero(value: &f64) -> bool {
    *value == 0.0
}

impl Energy {
    /// Sets the imbalance to the difference between the initial energy and the others.
    pub(super) fn balanced(self) -> Self {
        let dissipated = self.dissipated_ball + self.dissipated_damping;
        let imbalance =
            self.initial - self.ball - self.bat_rigid - self.vibration - self.wall - dissipated;
        Self { imbalance, ..self }
    }
}

/// The greater of two errors; NaN counts as the greatest, where `f64::max` would drop it.
pub fn greater(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}
