//! What each model predicts for a hit: one function per model.

use std::cell::Cell;
use std::f64::consts::PI;

use crate::collision::contact::encounter::Encounter;
use crate::collision::contact::power_law::LEAST_RESTITUTION;
use crate::collision::contact::touch::DrivingPoint;
use crate::collision::energy_loss::{EnergyLoss, wpi_alpha};
use crate::collision::hit::{Model, Separation};
use crate::collision::hitter::{Blow, Hitter};
use crate::collision::pulse::Pulse;
use crate::collision::stated::{Answered, fewer, other_steps};
use crate::modes::mode::Mode;

/// Flags of a hit in which the bat caught up with the ball late, or again.
pub const LATER: [&str; 2] = ["late_contact", "second_contact"];

/// The limits within which the ball's law was measured. The longest contact (s) is that at 1 m/s of A. M. Nathan, Am.
/// J. Phys. 68, 979 (2000); the least restitution is that of the common softball. The fastest ball there meets a rigid
/// wall at 67 m/s; the limit (m/s) is a fifth more.
const LONGEST_MEASURED: f64 = 2e-3;
const LEAST_MEASURED: f64 = 0.44;
const FASTEST_MEASURED: f64 = 1.2 * 67.0;

/// Share of the energy, over the accuracy of the steps, below which the effect of a flexibility is not computed.
const SLIGHT: f64 = 1e-3;

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
    pub(super) fn answer(&self, x: f64) -> Option<HitAnswer> {
        self.answers(&[(x, None)]).pop()?
    }

    /// The model's predictions for hits at some places (m); `None` where there is none. The errors of a contact due to
    /// truncation, steps and wall may be given.
    pub(super) fn answers(&self, places: &[(f64, Option<[f64; 3]>)]) -> Vec<Option<HitAnswer>> {
        let approach = |(x, known): &(f64, Option<[f64; 3]>)| {
            let closing = self.closing(*x).filter(|_| self.has_section(*x))?;
            let [mass, cor] = self.blow(*x, closing);
            Some(Approach { x: *x, closing, mass, cor, known: *known })
        };
        let approaches = places.iter().map(approach);
        if self.model == Model::Contact {
            return self.touched(&approaches.collect::<Vec<_>>());
        }
        let says = |approach: Option<Approach>| {
            let Approach { x, closing, mass, cor, .. } = approach?;
            let lost = 0.5 * mass * closing * closing * (1.0 - cor * cor);
            let rigid = HitAnswer::new(mass * (1.0 + cor) * closing, cor, lost);
            match self.model {
                Model::EnergyLoss(loss) => self.empirical(loss, x, closing, rigid),
                Model::Pulse(pulse) => self.pulsed(pulse, x, closing, cor),
                Model::Rigid | Model::Contact => Some(rigid),
            }
        };
        approaches.map(says).collect()
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
        // The effect of all further modes and of the mesh.
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

    /// The predictions of the contact model at some places.
    fn touched(&self, approaches: &[Option<Approach>]) -> Vec<Option<HitAnswer>> {
        let count = self.modes_used();
        let few = if self.effort.completed { fewer(count) } else { vec![] };
        let places: Vec<(&Approach, Ladder)> = approaches
            .iter()
            .flatten()
            .map(|approach| (approach, self.ladder(approach.x)))
            .collect();
        let felt: Vec<DrivingPoint> = places.iter().map(|(_, ladder)| ladder.of(count)).collect();
        // At least one, because the change of the impulse with the closing speed is needed.
        let beside = if few.is_empty() { &[count][..] } else { &few };
        let others = |k: usize| beside.iter().map(|few| places[k].1.of(*few)).collect();
        let others: Vec<_> = (0..places.len()).map(|k| move || others(k)).collect();
        let blow = |k: usize| {
            let (Approach { x, closing, known, .. }, _) = places[k];
            let (felt, others) = (&felt[k], &others[k] as &dyn Fn() -> Vec<DrivingPoint>);
            let compared = known.is_none();
            Blow { others, compared, ..Blow::alone(*x, felt, *closing) }
        };
        let blows: Vec<Blow> = (0..places.len()).map(blow).collect();
        let met = self.meet_all(&blows, self.effort.accuracy);
        let other = self.by_other_steps(&blows, &met);
        let mut told = Vec::with_capacity(places.len());
        for (k, ((approach, ladder), met)) in places.iter().zip(&met).enumerate() {
            let of = |(met, accuracy): &(Encounter, f64)| {
                let contact = Contact {
                    felt: &felt[k],
                    met,
                    accuracy: *accuracy,
                    other: other[k].as_ref().map(Option::as_ref),
                };
                self.told(approach, ladder, &few, contact)
            };
            told.push(met.as_ref().map(of));
        }
        let mut told = told.into_iter();
        approaches.iter().map(|approach| approach.as_ref().and_then(|_| told.next()?)).collect()
    }

    /// The same contacts with other steps, for comparison, if a small change may be magnified.
    fn by_other_steps(
        &self,
        blows: &[Blow],
        met: &[Option<(Encounter, f64)>],
    ) -> Vec<Option<Option<Encounter>>> {
        let accuracy = self.effort.accuracy;
        let delicate = |k: &usize| {
            met[*k].as_ref().is_some_and(|(met, own)| met.is_delicate() && *own == accuracy)
        };
        let which: Vec<usize> = (0..met.len()).filter(delicate).collect();
        let alone = |k: &usize| Blow { others: &Vec::new, compared: true, ..blows[*k] };
        let again: Vec<Blow> = which.iter().map(alone).collect();
        let mut all = vec![None; met.len()];
        for (k, other) in which.into_iter().zip(self.meet_all(&again, other_steps(accuracy))) {
            all[k] = Some(other.map(|(met, _)| met));
        }
        all
    }

    /// The bat as the ball feels it at `x` (m) by any number of its modes.
    fn ladder(&self, x: f64) -> Ladder<'_> {
        let beyond = self.effort.completed.then(|| self.struck.flexibility(x));
        Ladder { hitter: self, x, modes: self.by_modes(x), beyond }
    }

    /// The answer of a contact, with its errors.
    fn told(
        &self,
        approach: &Approach,
        ladder: &Ladder,
        few: &[usize],
        contact: Contact,
    ) -> HitAnswer {
        let Approach { x, closing, cor, known, .. } = *approach;
        let (ball, count) = (self.scene.ball.mass_kg, self.modes_used());
        let Contact { felt, met, accuracy, .. } = contact;
        let mass = 1.0 / felt.inverse_mass;
        let rebound = met.impulse / (mass * closing) - 1.0;
        let (of_ball, slow) = (mass / ball, self.slow_modes());
        let answered = Answered { met, count, accuracy, rebound, of_ball, slow };
        let beside = Beside { hitter: self, x, closing, contact, first: Cell::new(0.0) };
        let mut answer = HitAnswer::new(met.impulse, cor, met.lost_in_ball);
        [answer.truncation, answer.steps, answer.wall] = known
            .filter(|_| !met.is_delicate())
            .unwrap_or_else(|| beside.errors(&answered, ladder, few));
        answer.error += beside.held(ladder, mass);
        let [magnified, round_off] = answered.magnified(ball * closing);
        answer.steps += round_off;
        // Possible effect of further touches, and of a restitution below the least one of the law.
        answer.error +=
            met.open / (ball * closing) + (LEAST_RESTITUTION - cor).max(0.0) * mass / ball;
        answer.error += self.wall_error + answer.truncation + answer.steps + answer.wall;
        // Duration of one push of the force (s): at most that of a half sine on a stiff bat.
        let push = met.time / (met.touches + met.reloads) as f64;
        let push = push.min(PI * self.pressed);
        for (doubt, [omega, _]) in self.struck.doubt(x).iter().zip(&self.modes) {
            // A mode hardly responds to changes of the force slower than itself.
            let turns = omega * push / PI;
            let change = doubt * mass * met.impulse / (ball * closing) / (1.0 + turns * turns);
            answer.error += magnified * beside.counted([change; 2]);
        }
        let hard = (mass / ball).sqrt() * closing > FASTEST_MEASURED
            || met.compression > self.scene.ball.radius_m;
        answer.flags = flags(met, hard || cor < LEAST_MEASURED);
        answer.contact_time = Some(met.time);
        let exit_speed = met.first_impulse / ball - self.scene.ball_speed;
        // A ball that leaves only once does so at the end.
        let own = beside.first.get() + self.wall_error;
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
        answer
    }
}

/// The flags of a contact; `beyond` if the ball's law was not measured for such a speed or restitution.
fn flags(met: &Encounter, beyond: bool) -> Vec<&'static str> {
    let flags = [
        (met.reloads > 0, "reload"),
        (met.late, "late_contact"),
        (met.again(), "second_contact"),
        (met.time > LONGEST_MEASURED || beyond, "ball_law_beyond"),
    ];
    flags.into_iter().filter_map(|(is, name)| is.then_some(name)).collect()
}

/// A contact, beside which others are computed for its errors.
struct Beside<'a> {
    hitter: &'a Hitter<'a>,
    x: f64,
    closing: f64,
    contact: Contact<'a>,
    /// Error of the exit speed, relative to the closing speed, at the time when the ball first leaves.
    first: Cell<f64>,
}

impl Beside<'_> {
    /// Impulse (N s) that changes the ball's speed by the closing speed.
    fn unit(&self) -> f64 {
        self.hitter.scene.ball.mass_kg * self.closing
    }

    /// Difference of another contact at the end, and at the time when the ball first leaves.
    fn apart(&self, other: &Encounter) -> [f64; 2] {
        let met = self.contact.met;
        let pairs = [(other.impulse, met.impulse), (other.first_impulse, met.first_impulse)];
        pairs.map(|(other, own)| (other - own).abs() / self.unit())
    }

    /// Difference of another blow. A contact that does not end gives no information.
    fn of(&self, blow: Blow, accuracy: f64) -> [f64; 2] {
        self.hitter.meet(blow, accuracy).map_or([1.0; 2], |(other, _)| self.apart(&other))
    }

    /// Difference if the ball meets another bat.
    fn on(&self, felt: &DrivingPoint, accuracy: f64) -> [f64; 2] {
        self.of(Blow::alone(self.x, felt, self.closing), accuracy)
    }

    /// A part of the error at the end; counts that at the time when the ball first leaves.
    fn counted(&self, [all, first]: [f64; 2]) -> f64 {
        self.first.set(self.first.get() + first);
        all
    }

    /// Errors due to truncation, steps and wall.
    fn errors(&self, answered: &Answered, ladder: &Ladder, few: &[usize]) -> [f64; 3] {
        let Contact { felt, met, accuracy, other } = &self.contact;
        let shears = self.hitter.solution.theory.shears();
        let in_first = few.iter().zip(&met.first_changes);
        let in_first = in_first.map(|(few, by)| (*few, by.abs() / self.unit()));
        self.first.set(answered.left_out(shears, in_first));
        /// Change of the exit speed, relative to the closing speed, up to which the first order is valid for a
        /// ball that is met again.
        const SMALL: f64 = 0.1;
        let change = |(few, by): (&usize, &f64)| {
            let by = by.abs() / self.unit();
            let large = met.is_delicate() && (by > SMALL || by.is_nan());
            (*few, if large { self.on(&ladder.of(*few), *accuracy)[0] } else { by })
        };
        let left_out = answered.left_out(shears, few.iter().zip(&met.changes).map(change));
        let by_steps = |accuracy| match other {
            Some(other) => other.map_or([1.0; 2], |other| self.apart(other)),
            None => self.on(felt, accuracy),
        };
        let steps = answered.steps(left_out, |accuracy| self.counted(by_steps(accuracy)));
        [left_out, steps, self.softer_and_slower()]
    }

    /// Error due to the wall: the effect of a softer one, and of slower modes. Where one has no effect to first order,
    /// the other still has: both count.
    ///
    /// A softer wall has all the flexibility that may be missing, and that of the delay of modes that follow the force
    /// at once, `y = C F − D F″ + …`, where `F″` of a half sine is `(π/T)² F`. On a stiff bat T is 2.86 to 3.14 times
    /// the time in which the ball would be compressed at its first speed; a wall makes it longer.
    fn softer_and_slower(&self) -> f64 {
        let Contact { felt, accuracy, .. } = self.contact;
        let Some(under) = self.hitter.under(self.x) else { return 0.0 };
        let late = under.late * (PI / (2.86 * self.hitter.pressed)).powi(2);
        let softer = DrivingPoint { rest: felt.rest + under.unsure + late, ..felt.clone() };
        let slower = Blow { slower: true, ..Blow::alone(self.x, felt, self.closing) };
        let slower = self.counted(self.of(slower, accuracy));
        self.counted(self.on(&softer, accuracy)) + slower
    }

    /// Error on a held bat, where the errors of its slow modes may hide the effect of all further ones.
    fn held(&self, ladder: &Ladder, mass: f64) -> f64 {
        let (hitter, Contact { met, accuracy, .. }) = (self.hitter, &self.contact);
        let other =
            ladder.beyond.and_then(|all| hitter.struck.otherwise(self.x, &ladder.modes, all));
        let Some((other, flexibility)) = other else { return 0.0 };
        // The share of the energy in that flexibility.
        let share = flexibility * met.peak_force.powi(2) / (mass * self.closing * self.closing);
        let counts = share > SLIGHT * hitter.effort.accuracy;
        let on = || self.on(&hitter.with_wall(self.x, other), *accuracy);
        if counts { self.counted(on()) } else { 0.0 }
    }
}

/// A ball that approaches a place.
struct Approach {
    /// The place (m), the closing speed (m/s), μ (kg) and e₀.
    x: f64,
    closing: f64,
    mass: f64,
    cor: f64,
    /// Errors that are given.
    known: Option<[f64; 3]>,
}

/// A contact with steps of that accuracy, and the same with other steps if these were tried; `None` if they did not
/// come to an end.
struct Contact<'a> {
    felt: &'a DrivingPoint,
    met: &'a Encounter,
    accuracy: f64,
    other: Option<Option<&'a Encounter>>,
}

/// The bat as the ball feels it at a place by any number of its modes.
struct Ladder<'a> {
    hitter: &'a Hitter<'a>,
    x: f64,
    modes: DrivingPoint,
    beyond: Option<[f64; 2]>,
}

impl Ladder<'_> {
    fn of(&self, count: usize) -> DrivingPoint {
        let gains = self.modes.gains[..count].to_vec();
        let bent = self.hitter.bent(self.x, DrivingPoint { gains, ..self.modes }, self.beyond);
        self.hitter.with_wall(self.x, bent)
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
