//! What a hit is: model, swing, pitch and ball; exit speed, impulse and where the energy went.

use serde::{Deserialize, Serialize};

use crate::base::error::Result;
use crate::bat::body::STANDARD_PIVOT;
use crate::collision::ball::Ball;
use crate::collision::contact::collider::{Law, LawTerms};
use crate::collision::energy_loss::EnergyLoss;
use crate::collision::hoop_wall::{HarmonicEnergy, HoopInHit};
use crate::collision::pulse::Pulse;

/// How the bat's bending is counted; each model is a limit of the last.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Model {
    /// The bat does not bend.
    Rigid,
    /// Bending takes the WPI report's empirical loss.
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

    /// What the model is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rigid => "rigid",
            Self::EnergyLoss(_) => "energy-loss",
            Self::Pulse(_) => "pulse",
            Self::Contact => "contact",
        }
    }
}

/// Steps times modes of contacts, after which the hits of a hundred places are not made better and best places not
/// looked for more closely. A usual ball takes 70,000 along an R161, and with all that is told of its hits 1.4
/// million; with this bound the stiffest balls take ten times as long as a usual one.
pub const MOST_WORK: u64 = 6_000_000;

/// How a contact is computed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Effort {
    /// Relative accuracy of the force in the steps.
    pub accuracy: f64,
    /// Whether the modes that are left out have their flexibility, the last mode as heavy as makes
    /// it right; else the modes that are taken are all there are.
    pub completed: bool,
    /// Whether the answers were not seen to settle: errors are stated three times as large.
    pub unsettled: bool,
}

impl Default for Effort {
    /// Steps good for exit speeds to 1e-4 of the closing speed and better.
    fn default() -> Self {
        Self { accuracy: 1e-3, completed: true, unsettled: false }
    }
}

/// A swing meets a pitch.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Rotation centre of the swing beyond the knob end (m), negative inside the handle.
    pub pivot: f64,
    /// Angular speed of the swing (rad/s).
    pub swing: f64,
    /// What is hit.
    pub ball: Ball,
    /// Speed of the ball towards the bat (m/s).
    pub ball_speed: f64,
    /// Coefficient of restitution, unless the ball's own depends on the speed.
    pub cor: f64,
    /// Where the hands feel the hit (m from the knob end).
    pub hands: f64,
    /// How the barrel's wall gives way under the ball by a person's own figures, if it does.
    pub wall: Option<Wall>,
    /// Whether it gives way by its own hoop modes, those of the bat that the scene was made for; of
    /// another bat they are solved anew. Not where [`Self::wall`] is given.
    pub hoop: HoopInHit,
}

impl Default for Scene {
    /// An average swing of the major leagues at a 90 mph pitch: 43 rad/s about a point 2.5 in beyond
    /// the knob end, a baseball at 83 mph, hands about the standard pivot, a wall that does not give
    /// way. A bat of 33 in moves at 72 mph 6 in from its tip, and the ball leaves an R161 at 107 mph.
    ///
    /// # Source
    ///
    /// MLB glossary, Statcast, "Bat Speed": taken six inches from the head of the bat; its average in
    /// the major leagues is 71.5 mph. A pitch of 90 mph at release has about 0.92 of that at the plate,
    /// the share with which the squared-up balls of `validation/` come out right.
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
    /// Whether the barrel's wall gives way under the ball, by a person's figures or by its own hoop modes.
    pub fn wall_gives_way(&self) -> bool {
        self.wall.is_some() || self.hoop.wall().is_some()
    }

    /// Speed (m/s) at which the ball would bring that energy (J, of the relative motion) to a rigid wall, and so be
    /// compressed as much.
    fn speed_on_wall(&self, energy: f64) -> f64 {
        (2.0 * energy / self.ball.mass_kg).sqrt()
    }

    /// e₀ of a ball that is met with that energy (J, of the relative motion): that on a rigid wall, at the speed
    /// at which it would bring as much there.
    pub fn restitution(&self, energy: f64) -> f64 {
        self.ball.restitution_at(self.speed_on_wall(energy)).unwrap_or(self.cor)
    }

    /// The ball's force law with that e₀, when it is met with that energy (J, of the relative motion).
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

/// The wall of a hollow barrel as a spring under the ball: a shell mode without momentum of its own,
/// so that it disturbs neither the rigid motion nor the bending modes.
///
/// A mode of mass m and `ω² = k/m` gives way by `F/k` to a slow force. Without a mass it is a
/// spring in series with the ball.
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

/// One impact. What does not exist (no real solution, no contact) is None.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Impact {
    /// Distance of the impact point from the knob end (m).
    pub x: f64,
    /// Speed of the bat at `x` before the hit (m/s).
    pub bat_speed: f64,
    /// Exit speed of the ball if the bat did not bend (m/s).
    pub rigid_exit_speed: Option<f64>,
    /// The outcome; None where ball and bat do not meet or there is no real solution.
    pub outcome: Option<Outcome>,
    /// What is unusual in this impact, or why it has no outcome.
    pub flags: Vec<&'static str>,
}

/// What the hit left behind.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Outcome {
    /// Speed of the ball off the bat once it is gone for good (m/s).
    pub exit_speed: f64,
    /// Coefficient of restitution e₀ of this hit.
    pub cor: f64,
    /// Impulse `J` (N s).
    pub impulse: f64,
    /// Collision efficiency `e_A = (v_out − V)/(v_in + V)`, V the bat's speed at the impact point.
    pub collision_efficiency: f64,
    /// Contact time (s), all touches together, where the model has one.
    pub contact_time: Option<f64>,
    /// The ball's first departure, where the model has times.
    pub first_separation: Option<Separation>,
    /// Largest force (N), where the model has one.
    pub peak_force: Option<f64>,
    /// Largest compression of the ball (m), where the model has one.
    pub peak_compression: Option<f64>,
    /// BBCOR of the free bat: `e_A (1 + r) + r` with `r = m/M_eff`.
    pub bbcor: f64,
    /// BBCOR of the bat held 6 in from the knob: `e_A (1 + r) + r` with `r = m Q²/I`.
    pub bbcor_pivoted: f64,
    /// Where the energy went.
    pub energy: Energy,
    /// Estimated error of the exit speed, relative to the closing speed: for modes left out and
    /// steps, and for the mesh.
    pub error: f64,
    /// Part of [`Self::error`] that more modes would remove.
    pub truncation: f64,
    /// Part of [`Self::error`] that shorter steps would remove.
    pub steps: f64,
    /// Part of [`Self::error`] that more and better hoop modes of the wall would remove.
    pub wall: f64,
}

impl Outcome {
    /// States errors as they are where better answers were not waited for, which would have shown how these settle: of
    /// 101 places of an R161 and the stiffest ball (1e10 N/m^1.84) five moved by more than stated before, the most by
    /// 3.8 times, against the next rounds' answers.
    pub(super) fn unsettled(&mut self) {
        const MORE: f64 = 3.0;
        self.error += (MORE - 1.0) * (self.error - self.wall);
        self.truncation *= MORE;
        self.steps *= MORE;
        self.first_separation.iter_mut().for_each(|first| first.error *= MORE);
    }
}

/// The moment at which the ball leaves the bat for the first time.
// It may be caught again.
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
    /// How far that may be off, relative to the closing speed.
    #[serde(rename = "exit_speed_error")]
    pub error: f64,
}

/// Energies (J): the initial one is the sum of all others, each computed on its own.
// Of a held bat as its hands see them.
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
    /// Energy left in the barrel's wall (J), where it gives way.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub wall: f64,
    /// That energy by the harmonics around the barrel; left out where the wall has none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub wall_by_harmonic: Vec<HarmonicEnergy>,
    /// Energy that the model created (−) or failed to account for (+) (J).
    pub imbalance: f64,
}

/// A wall that does not give way has no line.
fn is_zero(value: &f64) -> bool {
    *value == 0.0
}

impl Energy {
    /// With what the others leave of the initial one.
    pub(super) fn balanced(self) -> Self {
        let dissipated = self.dissipated_ball + self.dissipated_damping;
        let imbalance =
            self.initial - self.ball - self.bat_rigid - self.vibration - self.wall - dissipated;
        Self { imbalance, ..self }
    }
}

/// The greater of two errors; one that is not a number is greater than all, where `f64::max` drops it.
pub fn greater(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}
