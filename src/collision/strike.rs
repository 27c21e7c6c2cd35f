//! A hit at one place: in full, at a glance, and in time.

use crate::collision::answer::HitAnswer;
use crate::collision::contact::table::ForcePiece;
use crate::collision::contact::touch::DrivingPoint;
use crate::collision::history::{Moment, history};
use crate::collision::hit::{Energy, Impact, Model, Outcome, Scene};
use crate::collision::hitter::{Blow, Hitter, resolved};
use crate::collision::struck::recoil_between;

/// A hit without its energies and its error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Glance {
    /// Distance of the impact point from the knob end (m).
    pub x: f64,
    /// Exit speed of the ball (m/s).
    pub exit_speed: f64,
    /// Speed of the ball when it leaves for the first time (m/s).
    pub first_exit: f64,
    /// Whether the bat caught up with the ball as it was leaving.
    pub late: bool,
    /// Whether the bat caught up with the ball then or after it had left.
    pub later: bool,
    /// Energy left in vibration (J); `None` for a model without vibration.
    pub vibration: Option<f64>,
    /// Motion of the hands after the ball has gone: velocity (m/s) and acceleration (m/s²) of the bat there relative to
    /// the swing, as root mean squares over a long undamped vibration.
    pub hands: [f64; 2],
}

/// Accuracy of the steps in a search for places, for which exit speeds vary smoothly.
pub(super) const SMOOTH: f64 = 1e-6;

/// The flag of a contact whose steps do not come to an end, or whose energies do not balance.
pub const UNRESOLVED: &str = "unresolved";

impl Hitter<'_> {
    /// The hit at `x` (m) for a search for places. `None` if ball and bat do not meet, and near a pointed end, where
    /// ever less of the bat meets the ball.
    pub fn glance(&self, x: f64) -> Option<Glance> {
        self.glances(&[x]).pop()?
    }

    /// The hits of [`Self::glance`] at some places (m), computed side by side.
    pub fn glances(&self, places: &[f64]) -> Vec<Option<Glance>> {
        /// Share of the largest radius.
        const POINTED: f64 = 0.25;
        let outer = &self.profile.stations.outer;
        let largest = outer.iter().fold(0.0_f64, |largest, r| largest.max(*r));
        let touches = matches!(self.model, Model::Pulse(_) | Model::Contact);
        let blunt = |x: &f64| !touches || self.profile.at(*x).outer >= POINTED * largest;
        if self.model != Model::Contact {
            let seen = |x: &f64| {
                let answer = self.answer(*x).filter(|_| blunt(x))?;
                let in_modes = &answer.in_modes;
                Some(self.seen(*x, [answer.impulse; 2], [false; 2], in_modes))
            };
            return places.iter().map(seen).collect();
        }
        let approach = |x: &f64| {
            let closing = self.closing(*x).filter(|_| blunt(x))?;
            Some((*x, closing, self.felt(*x)))
        };
        let approaches: Vec<_> = places.iter().map(approach).collect();
        let mut blows = vec![];
        for (x, closing, felt) in approaches.iter().flatten() {
            blows.push(Blow::alone(*x, felt, *closing));
        }
        let mut met = self.meet_all(&blows, SMOOTH).into_iter();
        let seen = |approach: &Option<(f64, f64, DrivingPoint)>| {
            let (x, ..) = approach.as_ref()?;
            let (met, _) = met.next()??;
            let impulses = [met.impulse, met.first_impulse];
            Some(self.seen(*x, impulses, [met.late, met.again()], &met.in_modes))
        };
        approaches.iter().map(seen).collect()
    }

    /// What is seen of a hit at `x` (m): from its impulses (N s) in all and at the first separation, whether the bat
    /// catches up with the ball as it leaves and after, and the energies of the modes (J).
    fn seen(
        &self,
        x: f64,
        impulses: [f64; 2],
        [late, again]: [bool; 2],
        in_modes: &[f64],
    ) -> Glance {
        let in_modes = &in_modes[in_modes.len() - self.modes_used()..];
        let mut velocity = (impulses[0] * self.recoil_between(x, self.scene.hands)).powi(2);
        let mut acceleration = 0.0;
        for ((energy, [omega, _]), gain) in
            in_modes.iter().zip(&self.modes).zip(self.struck.gains(self.scene.hands))
        {
            // The mean square is half the squared amplitude, which is 2 E φ²/m.
            velocity += energy * gain;
            acceleration += energy * gain * omega * omega;
        }
        let moves = f64::from(!self.struck.bat.fixtures().keeps_still([x, self.scene.hands]));
        let exit = |impulse: f64| impulse / self.scene.ball.mass_kg - self.scene.ball_speed;
        Glance {
            x,
            exit_speed: exit(impulses[0]),
            first_exit: exit(impulses[1]),
            late,
            later: late || again,
            vibration: (self.modes_used() > 0).then(|| in_modes.iter().sum()),
            hands: [moves * velocity.sqrt(), moves * acceleration.sqrt()],
        }
    }

    /// The hit at `x` (m from the knob end).
    pub fn strike(&self, x: f64) -> Impact {
        self.impact(x, self.answer(x))
    }

    /// The hits at some places (m from the knob end). The errors of a contact due to truncation, steps and wall may be
    /// given and are then not estimated again. Each hit equals that of [`Self::strike`].
    pub fn strike_all(&self, places: &[(f64, Option<[f64; 3]>)]) -> Vec<Impact> {
        let answers = self.answers(places).into_iter();
        answers.zip(places).map(|(answer, (x, _))| self.impact(*x, answer)).collect()
    }

    fn impact(&self, x: f64, answer: Option<HitAnswer>) -> Impact {
        let bat_speed = self.bat.speed_at(x, self.motion);
        let rigid_exit_speed = self.rigid_exit(x);
        let flags = match (rigid_exit_speed, &answer) {
            (None, _) => vec!["no_contact"],
            _ if !self.has_section(x) => vec!["no_section"],
            (_, None) if self.model == Model::Contact => vec![UNRESOLVED],
            (_, None) => vec!["no_real_solution"],
            (_, Some(answer)) => answer.flags.clone(),
        };
        let outcome = answer.map(|answer| self.outcome(x, bat_speed, answer));
        Impact { x, bat_speed, rigid_exit_speed, outcome, flags }
    }

    /// The force at `x` (m) in time, by the contact model; `None` if that model has no answer.
    pub fn force(&self, x: f64) -> Option<Vec<ForcePiece>> {
        let (felt, closing) = (self.felt(x), self.closing(x)?);
        let (collider, law) = (self.collider.as_ref()?, self.law_at(x, closing)?);
        let meet = |accuracy| collider.meet_recorded(&felt, &*law, closing, accuracy);
        resolved(SMOOTH, meet, &felt, closing).map(|(_, pieces)| pieces)
    }

    /// Force and compression of the ball at `x` (m) in time, by the contact model, at `parts` instants
    /// in every piece of the force; `None` if that model has no answer.
    pub fn history(&self, x: f64, parts: usize) -> Option<Vec<Moment>> {
        let (pieces, felt, speed) = (self.force(x)?, self.felt(x), self.closing(x)?);
        let modes = [&self.wall_modes[..], &self.modes].concat();
        Some(history(&pieces, &felt, &modes, speed, parts))
    }

    fn outcome(&self, x: f64, bat_speed: f64, answer: HitAnswer) -> Outcome {
        let Scene { ball, ball_speed, .. } = self.scene;
        let impulse = answer.impulse;
        let (closing, exit_speed) = (bat_speed + ball_speed, impulse / ball.mass_kg - ball_speed);
        let kinetic = |speed: f64| 0.5 * ball.mass_kg * speed * speed;
        let [collision_efficiency, bbcor, bbcor_pivoted] = self.figures(x, exit_speed);
        let after = self.bat.kinetic_energy(self.bat.after(self.motion, impulse, x));
        let [initial, gone, bat_rigid] = match self.held {
            true => [
                kinetic(closing),
                kinetic(exit_speed - bat_speed),
                0.5 * impulse * impulse * recoil_between(self.motions(), x, x),
            ],
            false => [
                kinetic(*ball_speed) + self.bat.kinetic_energy(self.motion),
                kinetic(exit_speed),
                after,
            ],
        };
        let mut outcome = Outcome {
            exit_speed,
            cor: answer.cor,
            impulse,
            collision_efficiency,
            contact_time: answer.contact_time,
            first_separation: answer.first_separation,
            peak_force: answer.peak_force,
            peak_compression: answer.peak_compression,
            bbcor,
            bbcor_pivoted,
            energy: Energy {
                initial,
                ball: gone,
                bat_rigid,
                // An empty sum of floats is −0, which must not be printed as an energy.
                vibration: answer.in_modes.iter().fold(0.0, |sum, energy| sum + energy),
                vibration_by_mode: answer.in_modes,
                dissipated_ball: answer.lost_in_ball,
                dissipated_damping: answer.lost_in_bat,
                wall: answer.in_wall.iter().fold(0.0, |sum, energy| sum + energy),
                wall_by_harmonic: self
                    .hoop
                    .as_ref()
                    .map_or(vec![], |hoop| hoop.by_harmonic(&answer.in_wall)),
                imbalance: 0.0,
            }
            .balanced(),
            error: answer.error,
            truncation: answer.truncation,
            steps: answer.steps,
            wall: answer.wall,
        };
        if self.effort.unsettled {
            outcome.unsettled();
        }
        outcome
    }
}
