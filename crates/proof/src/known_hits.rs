//! Which values are known for a ball on a rigid wall and a ball on a bat?
//!
//! The function to call is [`crate::validation::run`].
//!
//! This file has the known values of a case of `validation/`, and the results of the contact.

use schemars::JsonSchema;
use serde::Deserialize;

use sweetspot::base::{Error, Result};
use sweetspot::bat::Bat;
use sweetspot::collision::contact::collider::Collider;
use sweetspot::collision::contact::collocation::{POINTS, polynomial};
use sweetspot::collision::contact::power_law::PowerLaw;
use sweetspot::collision::contact::table::ForcePiece;
use sweetspot::collision::contact::touch::DrivingPoint;
use sweetspot::collision::energy_loss::EnergyLoss;
use sweetspot::collision::{Ball, Effort, ForceLaw, Hitter, Model, Outcome, Scene, SweetSpot};
use sweetspot::modes::solve::Solution;

/// A ball thrown at a free bat, or at a wall.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Throw {
    /// Mass of the ball (kg).
    mass_kg: f64,
    /// Stiffness `k` of its force (N/m^α).
    stiffness: f64,
    /// Exponent `α` of its force.
    exponent: f64,
    /// Coefficient of restitution on a rigid wall.
    cor: f64,
    /// Speed towards the bat (m/s); a wall has one for every check.
    #[serde(default)]
    ball_speed_m_per_s: f64,
    /// Speed of the bat's balance point (m/s).
    #[serde(default)]
    balance_speed_m_per_s: f64,
    /// Rotation of the bat (rad/s).
    #[serde(default)]
    rotation_rad_per_s: f64,
    /// Whether the modes of the case are complete, as in a published model; otherwise the flexibility of all others is
    /// included too.
    #[serde(default)]
    modes_alone: bool,
}

/// A known figure of a hit, with its unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum KnownFigure {
    /// Speed of the ball off the bat (m/s).
    ExitSpeedMPerS,
    /// Speed of the ball off the bat if the bat did not bend (m/s).
    RigidExitSpeedMPerS,
    /// Loss of exit speed to bending, as a share of the rigid exit speed.
    ShareBelowRigid,
    /// `e_eff` in `v′ = [(e_eff − r) v + (1 + e_eff) V]/(1 + r)`: BBCOR of the free bat.
    EffectiveRestitution,
    /// Share of the ball afterwards in all energy before the hit (ball and bat, seen from the ground).
    BallShare,
    /// Share of the energy lost inside the ball in all energy before the hit (seen from the ground).
    LostInBallShare,
    /// Share of the bat's rigid motion afterwards in all energy before the hit (seen from the ground).
    RecoilShare,
    /// Share of the bending modes afterwards in all energy before the hit (seen from the ground).
    VibrationShare,
    /// Place of the largest exit speed, from the knob end (m).
    BestPlaceM,
    /// Largest exit speed along the bat (m/s).
    BestExitSpeedMPerS,
    /// Time until 99 % of the impulse on a wall is complete (ms).
    WallTimeMs,
    /// Contact time on a wall, until the force ends (ms).
    WallContactMs,
    /// Largest compression on a wall (mm).
    WallCompressionMm,
    /// Largest force on a wall (kN).
    WallForceKn,
    /// Speed off a wall over speed onto it.
    WallRestitution,
}

impl KnownFigure {
    /// Its name in a table, of a hit at a place (m) or of a ball at a speed (m/s).
    pub fn label(self, at: f64, speed: f64) -> String {
        let place = format!("{} cm", (1e5 * at).round() / 1e3);
        match self {
            Self::ExitSpeedMPerS => format!("{place} exit m/s"),
            Self::RigidExitSpeedMPerS => format!("{place} rigid m/s"),
            Self::ShareBelowRigid => format!("{place} below rigid"),
            Self::EffectiveRestitution => format!("{place} e_eff"),
            Self::BallShare => format!("{place} ball"),
            Self::LostInBallShare => format!("{place} lost in ball"),
            Self::RecoilShare => format!("{place} recoil"),
            Self::VibrationShare => format!("{place} vibration"),
            Self::BestPlaceM => "best place (m)".into(),
            Self::BestExitSpeedMPerS => "best exit m/s".into(),
            Self::WallTimeMs => format!("{speed} m/s 99 % ms"),
            Self::WallContactMs => format!("{speed} m/s contact ms"),
            Self::WallCompressionMm => format!("{speed} m/s depth mm"),
            Self::WallForceKn => format!("{speed} m/s force kN"),
            Self::WallRestitution => format!("{speed} m/s e"),
        }
    }
}

/// Steps so short that they are not part of any difference.
const STEPS: f64 = 1e-7;

impl Throw {
    fn ball(&self) -> Ball {
        Ball {
            name: "ball".into(),
            source: String::new(),
            mass_kg: self.mass_kg,
            stiffness: Some(self.stiffness),
            exponent: Some(self.exponent),
            cor: self.cor,
            ..Ball::baseball()
        }
    }

    /// Ball and bat before the hit.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for a bat that moves without turning, which no pivot gives.
    pub fn scene(&self, bat: &Bat) -> Result<Scene> {
        let (speed, rotation) = (self.balance_speed_m_per_s, self.rotation_rad_per_s);
        let radius = if speed == 0.0 { 0.0 } else { speed / rotation };
        if !radius.is_finite() {
            return Err(Error::value("rotation_rad_per_s", rotation, "a rotation"));
        }
        Ok(Scene {
            pivot: radius - bat.inertia().balance_point,
            swing: rotation,
            ball: self.ball(),
            ball_speed: self.ball_speed_m_per_s,
            cor: self.cor,
            ..Scene::default()
        })
    }

    /// The result of the contact on a bat, NaN if it has none.
    ///
    /// # Errors
    ///
    /// As [`Self::scene`] and [`Hitter::new`].
    pub fn on_bat(
        &self,
        bat: &Bat,
        solution: &Solution,
        wanted: &[(KnownFigure, f64)],
    ) -> Result<Vec<f64>> {
        let scene = self.scene(bat)?;
        let effort = Effort { accuracy: STEPS, completed: !self.modes_alone, unsettled: false };
        let hitter = Hitter::new(Model::Contact, &scene, bat, solution, effort)?;
        let seen = |&(seen, at): &(KnownFigure, f64)| {
            if matches!(seen, KnownFigure::BestPlaceM | KnownFigure::BestExitSpeedMPerS) {
                let best = SweetSpot::find(&hitter).exit_speed_max?;
                return Some(if seen == KnownFigure::BestPlaceM { best.x } else { best.value });
            }
            let impact = hitter.strike(at);
            let rigid = impact.rigid_exit_speed?;
            of_hit(seen, &impact.outcome?, rigid)
        };
        Ok(wanted.iter().map(|wanted| seen(wanted).unwrap_or(f64::NAN)).collect())
    }

    /// The result of the contact on a rigid wall at a speed (m/s); NaN for a figure that needs a bat.
    pub fn on_wall(&self, seen: KnownFigure, speed: f64) -> f64 {
        let law = PowerLaw::new(self.stiffness, self.exponent, self.cor);
        let felt = DrivingPoint { inverse_mass: 1.0 / self.mass_kg, ..DrivingPoint::default() };
        let deepest = law.compression(0.5 * self.mass_kg * speed * speed);
        let collider = Collider::new(&[], 0.25 * deepest / speed);
        let (met, pieces) = collider.meet_recorded(&felt, &law, speed, STEPS);
        match seen {
            KnownFigure::WallTimeMs => 1e3 * time_of(&pieces, 0.99 * met.impulse),
            KnownFigure::WallContactMs => 1e3 * met.time,
            KnownFigure::WallCompressionMm => 1e3 * met.compression,
            KnownFigure::WallForceKn => 1e-3 * met.peak_force,
            KnownFigure::WallRestitution => met.impulse / (self.mass_kg * speed) - 1.0,
            _ => f64::NAN,
        }
    }

    /// Exit speeds (m/s) at the places (m) where they exist: of the contact with all modes, of the rigid bat, and of
    /// the loss in the WPI report with the modes of that solution.
    ///
    /// # Errors
    ///
    /// As [`Self::on_bat`].
    pub fn curves(
        &self,
        bat: &Bat,
        [contact, loss]: [&Solution; 2],
        places: &[f64],
    ) -> Result<[Vec<[f64; 2]>; 3]> {
        let scene = self.scene(bat)?;
        let effort = Effort { accuracy: STEPS, completed: true, unsettled: false };
        let curve = |model, solution| -> Result<Vec<[f64; 2]>> {
            let hitter = Hitter::new(model, &scene, bat, solution, effort)?;
            Ok(places
                .iter()
                .filter_map(|x| Some([*x, hitter.strike(*x).outcome?.exit_speed]))
                .collect())
        };
        Ok([
            curve(Model::Contact, contact)?,
            curve(Model::Rigid, contact)?,
            curve(Model::EnergyLoss(EnergyLoss::default()), loss)?,
        ])
    }
}

fn of_hit(seen: KnownFigure, outcome: &Outcome, rigid: f64) -> Option<f64> {
    let energy = &outcome.energy;
    let share = |part: f64| Some(part / energy.initial);
    match seen {
        KnownFigure::ExitSpeedMPerS => Some(outcome.exit_speed),
        KnownFigure::RigidExitSpeedMPerS => Some(rigid),
        KnownFigure::ShareBelowRigid => Some(1.0 - outcome.exit_speed / rigid),
        KnownFigure::EffectiveRestitution => Some(outcome.bbcor),
        KnownFigure::BallShare => share(energy.ball),
        KnownFigure::LostInBallShare => share(energy.dissipated_ball),
        KnownFigure::RecoilShare => share(energy.bat_rigid),
        KnownFigure::VibrationShare => share(energy.vibration),
        _ => None,
    }
}

/// The time (s) at which the force has given that impulse (N s); NaN if it never does.
fn time_of(pieces: &[ForcePiece], impulse: f64) -> f64 {
    let mut left = impulse;
    for piece in pieces {
        // The integral of the force from the beginning of the piece.
        let given = |s: f64| {
            let integral: [f64; POINTS] =
                std::array::from_fn(|k| piece.powers[k] / (k as f64 + 1.0));
            piece.length * s * polynomial(&integral, s)
        };
        if given(1.0) < left {
            left -= given(1.0);
            continue;
        }
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if given(middle) < left { low = middle } else { high = middle }
        }
        return piece.start + high * piece.length;
    }
    f64::NAN
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_steady_force_gives_its_impulse_evenly() {
        let piece = |start| ForcePiece { start, length: 0.5, powers: [4.0, 0.0, 0.0, 0.0, 0.0] };
        let pieces = [piece(0.0), piece(0.5)];
        for (impulse, time) in [(1.0, 0.25), (2.0, 0.5), (3.0, 0.75)] {
            assert!((time_of(&pieces, impulse) - time).abs() < 1e-12);
        }
        assert!(time_of(&pieces, 4.5).is_nan());
    }
}
