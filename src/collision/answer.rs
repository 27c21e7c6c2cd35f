//! What each model predicts for a hit: one function per model.

use std::cell::Cell;

use crate::collision::contact::encounter::Encounter;
use crate::collision::contact::power_law::LEAST_RESTITUTION;
use crate::collision::contact::touch::DrivingPoint;
use crate::collision::energy_loss::{EnergyLoss, wpi_alpha};
use crate::collision::hit::{Effort, Model, Separation};
use crate::collision::hitter::Hitter;
use crate::collision::pulse::Pulse;
use crate::collision::stated::{Answered, fewer};
use crate::modes::mode::Mode;

/// Flags of a hit in which the bat caught up with the ball late, or again.
pub const LATER: [&str; 2] = ["late_contact", "second_contact"];

/// Beyond these limits the ball's law was not measured. The longest contact (s) is that at 1 m/s of A. M. Nathan, Am.
/// J. Phys. 68, 979 (2000); the least restitution is that of the common softball.
const LONGEST_MEASURED: f64 = 2e-3;
const LEAST_MEASURED: f64 = 0.44;

/// The prediction of a model.
pub(super) struct HitAnswer {
    /// `J` (N s).
    pub impulse: f64,
    pub cor: f64,
    pub in_modes: Vec<f64>,
    pub lost_in_ball: f64,
    pub lost_in_bat: f64,
    /// Energy (J) of every mode of the wall.
    pub in_wall: Vec<f64>,
    pub contact_time: Option<f64>,
    pub first_separation: Option<Separation>,
    pub peak_force: Option<f64>,
    pub peak_compression: Option<f64>,
    pub flags: Vec<&'static str>,
    pub error: f64,
    pub truncation: f64,
    pub steps: f64,
    pub wall: f64,
}

impl HitAnswer {
    /// The answer of a model without modes and times.
    fn new(impulse: f64, cor: f64, lost_in_ball: f64) -> Self {
        // The models' formulas are exact to a few roundings.
        let error = 8.0 * f64::EPSILON;
        Self {
            impulse,
            cor,
            in_modes: vec![],
            lost_in_ball,
            lost_in_bat: 0.0,
            in_wall: vec![],
            contact_time: None,
            first_separation: None,
            peak_force: None,
            peak_compression: None,
            flags: vec![],
            error,
            truncation: 0.0,
            steps: 0.0,
            wall: 0.0,
        }
    }
}

impl Hitter<'_> {
    /// The model's prediction for a hit at `x`; `None` if there is none.
    pub(super) fn answer(&self, x: f64, known: Option<[f64; 3]>) -> Option<HitAnswer> {
        let closing = self.closing(x).filter(|_| self.has_section(x))?;
        let [mass, cor] = self.blow(x, closing);
        let lost = 0.5 * mass * closing * closing * (1.0 - cor * cor);
        let rigid = HitAnswer::new(mass * (1.0 + cor) * closing, cor, lost);
        match self.model {
            Model::Rigid => Some(rigid),
            Model::EnergyLoss(loss) => self.empirical(loss, x, closing, rigid),
            Model::Pulse(pulse) => self.pulsed(pulse, x, closing, cor),
            Model::Contact => self.touched(x, closing, cor, known),
        }
    }

    fn empirical(
        &self,
        loss: EnergyLoss,
        x: f64,
        closing: f64,
        rigid: HitAnswer,
    ) -> Option<HitAnswer> {
        let (incoming, ball) = (-self.scene.ball_speed, self.scene.ball.mass_kg);
        let stiff = rigid.impulse / ball + incoming;
        let shapes = report_shapes(&self.solution.modes, self.bat.mass, x);
        let of = |vibration| EnergyLoss::exit_velocity(incoming, stiff, vibration);
        let exit = of(loss.vibration(&shapes))?;
        let impulse = ball * (exit - incoming);
        let mut answer = HitAnswer { impulse, ..rigid };
        answer.in_modes = loss.energies(&shapes, impulse, ball);
        let largest = largest_shapes(&self.solution.modes, self.bat.mass, x);
        // If the shapes cannot be bounded, neither can the loss.
        let other = of(loss.vibration(&largest)).filter(|v| v.is_finite());
        answer.error += other.map_or(1.0, |v| (v - exit).abs() / closing);
        Some(answer)
    }

    fn pulsed(&self, pulse: Pulse, x: f64, closing: f64, restitution: f64) -> Option<HitAnswer> {
        let ball = self.scene.ball.mass_kg;
        let felt = self.struck.with_modes(x, ball, self.modes_used());
        let mu = 1.0 / felt.inverse_mass;
        let shares = pulse.shares(&self.modes, &felt.gains);
        let share: f64 = shares.iter().sum();
        let e = pulse.restitution(restitution, mu * share)?;
        let impulse = mu * (1.0 + e) * closing;
        let in_modes: Vec<f64> = shares.iter().map(|s| 0.5 * impulse * impulse * s).collect();
        let left =
            0.5 * mu * closing * closing - pulse.loss_share * 0.5 * impulse * impulse * share;
        let lost = (1.0 - restitution * restitution) * left;
        let mut answer = HitAnswer::new(impulse, restitution, lost);
        answer.in_modes = in_modes;
        // All further modes, and the mesh.
        let slow = self.struck.flexibility(x)[1] - self.struck.taken(&felt.gains)[1];
        let last = self.modes.last().map_or(0.0, |mode| mode[0]);
        let error = |more: f64| {
            let other = pulse.restitution(restitution, mu * (share + more));
            other.map_or(1.0, |other| mu / ball * (other - e).abs())
        };
        if self.effort.completed {
            answer.truncation = error(pulse.beyond(last, slow));
        }
        answer.error += answer.truncation + error(self.struck.doubt(x).iter().sum());
        Some(answer)
    }

    fn touched(
        &self,
        x: f64,
        closing: f64,
        cor: f64,
        known: Option<[f64; 3]>,
    ) -> Option<HitAnswer> {
        let (ball, count) = (self.scene.ball.mass_kg, self.modes_used());
        let Effort { accuracy, completed, .. } = self.effort;
        let beyond = completed.then(|| self.struck.flexibility(x));
        let modes = self.by_modes(x);
        let few = if completed { fewer(count) } else { vec![] };
        let of = |count: usize| {
            let gains = modes.gains[..count].to_vec();
            self.with_wall(x, self.bent(x, DrivingPoint { gains, ..modes }, beyond))
        };
        let felt = of(count);
        let beside = |few: &[usize], accuracy: f64| {
            let others: Vec<DrivingPoint> = few.iter().map(|few| of(*few)).collect();
            self.meet_beside(x, &felt, &others, closing, accuracy)
        };
        let (met, accuracy) = beside(if known.is_none() { &few } else { &[] }, accuracy)?;
        // Difference of another answer from this one at the end, and at the time when the ball first leaves.
        let both = |felt: &DrivingPoint, accuracy: f64, faster: f64| {
            let other = self.meet(x, felt, faster * closing, accuracy);
            // An answer that does not end gives no information.
            other.map_or([1.0; 2], |(other, _)| {
                let apart = |other: f64, own: f64| (other / faster - own).abs() / (ball * closing);
                let first = apart(other.first_impulse, met.first_impulse);
                [apart(other.impulse, met.impulse), first]
            })
        };
        let from_other =
            |felt: &DrivingPoint, accuracy: f64, faster: f64| both(felt, accuracy, faster)[0];
        let first_error = Cell::new(0.0);
        let counted = |felt: &DrivingPoint, accuracy: f64, share: f64| {
            let [all, first] = both(felt, accuracy, 1.0);
            first_error.set(first_error.get() + share * first);
            share * all
        };
        let mass = 1.0 / felt.inverse_mass;
        let rebound = met.impulse / (mass * closing) - 1.0;
        let (of_ball, slow) = (mass / ball, self.slow_modes());
        let answered = Answered { met: &met, count, accuracy, rebound, of_ball, slow };
        let shears = self.solution.theory.shears();
        let mut answer = HitAnswer::new(met.impulse, cor, met.lost_in_ball);
        [answer.truncation, answer.steps, answer.wall] =
            known.filter(|_| !answered.is_delicate()).unwrap_or_else(|| {
                let again = known.and_then(|_| beside(&few, accuracy));
                let Encounter { changes, first_changes, .. } =
                    again.as_ref().map_or(&met, |(again, _)| again);
                let in_first = |(few, by): (&usize, &f64)| (*few, by.abs() / (ball * closing));
                let in_first = few.iter().zip(first_changes).map(in_first);
                first_error.set(answered.left_out(shears, in_first));
                /// Change of the exit speed, relative to the closing speed, up to which the first order is valid for a
                /// ball that is met again.
                const SMALL: f64 = 0.1;
                let change = |(few, by): (&usize, &f64)| {
                    let by = by.abs() / (ball * closing);
                    let large = answered.is_delicate() && (by > SMALL || by.is_nan());
                    (*few, if large { from_other(&of(*few), accuracy, 1.0) } else { by })
                };
                let left_out = answered.left_out(shears, few.iter().zip(changes).map(change));
                let steps = answered.steps(left_out, |accuracy| counted(&felt, accuracy, 1.0));
                // A softer wall: by all that may be missing, and by the delay of modes that follow the force at once,
                // `y = C F − D F″ + …`, where `F″` of a half sine is `(π/T)² F`. On a stiff bat T is 2.86 to 3.14 times
                // the time in which the ball would be compressed at its first speed; a wall makes it longer.
                let wall = self.under(x).map_or(0.0, |under| {
                    let late = under.late * (std::f64::consts::PI / (2.86 * self.pressed)).powi(2);
                    let rest = felt.rest + under.unsure + late;
                    counted(&DrivingPoint { rest, ..felt.clone() }, accuracy, 1.0)
                });
                [left_out, steps, wall]
            });
        let [magnified, round_off] = answered.magnified(|by| from_other(&felt, accuracy, 1.0 + by));
        answer.steps += round_off;
        // Possible effect of touches after those that were followed, with a ball deader than any law.
        answer.error +=
            met.open / (ball * closing) + (LEAST_RESTITUTION - cor).max(0.0) * mass / ball;
        answer.error += self.wall_error + answer.truncation + answer.steps + answer.wall;
        // Duration of one push of the force (s): at most a half sine's on a stiff bat.
        let push = met.time / (met.touches + met.reloads) as f64;
        let push = push.min(std::f64::consts::PI * self.pressed);
        for (doubt, [omega, _]) in self.struck.doubt(x).iter().zip(&self.modes) {
            // A mode hardly responds to changes of the force slower than itself.
            let turns = omega * push / std::f64::consts::PI;
            let change = doubt * mass * met.impulse / (ball * closing) / (1.0 + turns * turns);
            answer.error += magnified * change;
            first_error.set(first_error.get() + change);
        }
        let beyond = met.time > LONGEST_MEASURED || cor < LEAST_MEASURED;
        let flags = [
            (met.reloads > 0, "reload"),
            (met.late, "late_contact"),
            (met.again(), "second_contact"),
            (beyond, "ball_law_beyond"),
        ];
        answer.flags = flags.into_iter().filter_map(|(is, name)| is.then_some(name)).collect();
        answer.contact_time = Some(met.time);
        let exit_speed = met.first_impulse / ball - self.scene.ball_speed;
        // A ball that leaves only once has then left.
        let own = first_error.get() + self.wall_error;
        let error = match met.again() {
            false => answer.error,
            // The effect may be magnified even in the first touch.
            true if met.late || met.reloads > 0 => own.max(answer.error),
            true => own,
        };
        answer.first_separation = Some(Separation { time: met.first_end, exit_speed, error });
        answer.peak_force = Some(met.peak_force);
        answer.peak_compression = Some(met.compression);
        let walls = met.in_modes.len() - count;
        answer.in_wall = met.in_modes[..walls].to_vec();
        answer.in_modes = met.in_modes[walls..].to_vec();
        answer.lost_in_bat = met.lost_in_bat;
        Some(answer)
    }
}

/// Deflections at `x` in the WPI report's scaling, `(1/M) ∫ρA W_n² dx = α_n²`, which on its dowel
/// is exactly the report's raw shape.
fn report_shapes(modes: &[Mode], mass: f64, x: f64) -> Vec<f64> {
    let scaled = |mode: &Mode| {
        mode.shape.deflection(x) * wpi_alpha(mode.order) * (mass / mode.modal_mass).sqrt()
    };
    modes.iter().map(scaled).collect()
}

/// Upper bounds of the deflections of [`report_shapes`], by the stated errors of each mode.
fn largest_shapes(modes: &[Mode], mass: f64, x: f64) -> Vec<f64> {
    let with_error = |mode: &Mode| {
        let deflection = mode.shape.deflection(x).abs() + mode.error.shape;
        let lightest = mode.modal_mass * (1.0 - mode.error.modal_mass).max(0.0);
        deflection * wpi_alpha(mode.order) * (mass / lightest).sqrt()
    };
    modes.iter().map(with_error).collect()
}
