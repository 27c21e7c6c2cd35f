//! A bat that is hit, at any place, by one of the models.
//!
//! A free bat moves as it was swung; a hit on it is told as the ground sees it. A held one (a test
//! rig's pin, hands) is told as its hands see it: the bat at rest, the ball at the closing speed. The
//! impulse is the same for both.

use std::sync::Arc;

use crate::base::error::{Error, Result};
use crate::bat::body::{Bat, STANDARD_PIVOT};
use crate::bat::profile::Profile;
use crate::collision::contact::encounter::{Collider, Encounter};
use crate::collision::contact::force_law::{ForceLaw, LEAST_RESTITUTION};
use crate::collision::contact::step::Piece;
use crate::collision::contact::touch::Felt;
use crate::collision::energy_loss::EnergyLoss;
use crate::collision::energy_loss::wpi_alpha;
use crate::collision::history::{Moment, history};
use crate::collision::hit::{Effort, Energy, Impact, Model, Outcome, Scene, Separation, Wall};
use crate::collision::pulse::Pulse;
use crate::collision::rigid::{RigidBat, RigidVelocity};
use crate::collision::stated::Answered;
use crate::collision::struck::{Struck, recoil_between, without_springs};
use crate::modes::compliance::RigidMotion;
use crate::modes::mode::Mode;
use crate::modes::solve::Solution;

/// A bat about to be hit: all that is the same for every impact point.
pub struct Hitter<'a> {
    model: Model,
    scene: &'a Scene,
    solution: &'a Solution,
    profile: &'a Profile,
    bat: RigidBat,
    motion: RigidVelocity,
    held: bool,
    /// How a held bat moves that does not bend: springs and hands are too slow for a hit.
    stiff: Vec<RigidMotion>,
    /// The body's inertia about the standard pivot, for the pivoted BBCOR (kg m²).
    pivot_inertia: f64,
    struck: Arc<Struck<'a>>,
    effort: Effort,
    /// ω (rad/s) and damping ratio of every mode.
    modes: Vec<[f64; 2]>,
    /// How long a ball is pressed by a stiff bat, more or less (s); not a number without a force law.
    pressed: f64,
    collider: Option<Collider>,
    /// The wall as the ball feels it, and what that leaves out, relative to the closing speed.
    wall: Option<Wall>,
    wall_error: f64,
}

/// What a model says.
struct Answer {
    /// `J` (N s).
    impulse: f64,
    cor: f64,
    in_modes: Vec<f64>,
    lost_in_ball: f64,
    lost_in_bat: f64,
    in_wall: f64,
    contact_time: Option<f64>,
    first_separation: Option<Separation>,
    peak_force: Option<f64>,
    peak_compression: Option<f64>,
    flags: Vec<&'static str>,
    error: f64,
    truncation: f64,
    steps: f64,
}

impl Answer {
    /// The answer of a model without modes and times.
    fn new(impulse: f64, cor: f64, lost_in_ball: f64) -> Self {
        // The models' own formulas are exact to a few roundings.
        let error = 8.0 * f64::EPSILON;
        Self {
            impulse,
            cor,
            in_modes: vec![],
            lost_in_ball,
            lost_in_bat: 0.0,
            in_wall: 0.0,
            contact_time: None,
            first_separation: None,
            peak_force: None,
            peak_compression: None,
            flags: vec![],
            error,
            truncation: 0.0,
            steps: 0.0,
        }
    }
}

/// A hit without its ledger and its error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Glance {
    /// Distance of the impact point from the knob end (m).
    pub x: f64,
    /// Exit speed of the ball (m/s).
    pub exit_speed: f64,
    /// Energy left in vibration (J); None for a model without.
    pub vibration: Option<f64>,
    /// What the hands feel once the ball has gone: velocity (m/s) and acceleration (m/s²) of the bat
    /// there against the swing's, in the mean square over a long undamped ringing.
    pub hands: [f64; 2],
}

/// Accuracy of the steps where a place is sought: exit speeds then differ smoothly.
const SMOOTH: f64 = 1e-6;

impl<'a> Hitter<'a> {
    /// A bat in that scene. A free one recoils as its theory says: without rotary inertia, as a line
    /// of mass.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for a contact with a ball whose force law is not known, a held bat by the
    /// WPI report's model, and a contact with a mode that dashpots keep from swinging.
    pub fn new(
        model: Model,
        scene: &'a Scene,
        bat: &'a Bat,
        solution: &'a Solution,
        effort: Effort,
    ) -> Result<Self> {
        let struck = Arc::new(Struck::new(bat, solution));
        Self::of((model, effort), scene, bat, solution, struck)
    }

    /// The bat in another scene.
    ///
    /// # Errors
    ///
    /// As [`Self::new`].
    pub fn in_scene(&self, scene: &'a Scene, bat: &'a Bat) -> Result<Self> {
        let struck = Arc::clone(&self.struck);
        Self::of((self.model, self.effort), scene, bat, self.solution, struck)
    }

    fn of(
        (model, effort): (Model, Effort),
        scene: &'a Scene,
        bat: &'a Bat,
        solution: &'a Solution,
        struck: Arc<Struck<'a>>,
    ) -> Result<Self> {
        let held = bat.fixtures.holding();
        if held && matches!(model, Model::EnergyLoss(_)) {
            let expected = "a free bat, which the report's fit is for, or another model";
            return Err(Error::value("--model energy-loss", "a bat that is held", expected));
        }
        let body = bat.inertia();
        let line = if solution.theory.turns() { body } else { body.as_line() };
        let rigid = RigidBat {
            mass: line.mass,
            balance_point: line.balance_point,
            inertia: line.about_balance,
        };
        let motion = rigid.swung(scene.swing, scene.pivot);
        let modes = struck.modes();
        let speed = rigid.speed_at(0.75 * bat.length(), motion).abs() + scene.ball_speed;
        let mass = 1.0 / (1.0 / scene.ball.mass + 1.0 / rigid.mass);
        let law = scene.force_law(scene.cor);
        // How long the ball is pressed, more or less; not a number without a law or a speed.
        let pressed = law
            .as_ref()
            .map_or(f64::NAN, |law| law.compression(0.5 * mass * speed * speed) / speed);
        let (wall, wall_error) = felt_wall(scene.wall, pressed, effort.accuracy);
        let collider = match model {
            Model::Contact => {
                law?;
                if let Some(k) = modes.iter().position(|[_, ratio]| *ratio >= 1.0) {
                    let found =
                        format!("mode {} with a damping ratio of {:.2}", k + 1, modes[k][1]);
                    let expected = "dashpots that let every mode swing (a ratio below 1), or none: \
                                    a hit is over before the hands have felt it";
                    return Err(Error::value("hit", found, expected));
                }
                // A quarter of the way to the deepest compression.
                let longest = if pressed.is_finite() { 0.28 * pressed } else { 1.0 };
                let all: Vec<[f64; 2]> =
                    swinging(wall).into_iter().chain(modes.iter().copied()).collect();
                Some(Collider::new(&all, longest))
            }
            _ => None,
        };
        Ok(Self {
            model,
            scene,
            solution,
            profile: &bat.profile,
            bat: rigid,
            motion,
            held,
            stiff: if held { without_springs(bat, solution) } else { vec![] },
            pivot_inertia: body.about(STANDARD_PIVOT),
            struck,
            effort,
            modes,
            pressed,
            collider,
            wall,
            wall_error,
        })
    }

    /// Number of bending modes that the model counts.
    pub fn modes_used(&self) -> usize {
        match self.model {
            Model::Rigid => 0,
            _ => self.solution.modes.len(),
        }
    }

    /// The hit at `x` (m) as a search for places sees it. None where ball and bat do not meet, and
    /// where the bat ends in a point: there a ball is met by ever less of it.
    pub fn glance(&self, x: f64) -> Option<Glance> {
        /// Of the largest radius.
        const POINTED: f64 = 0.25;
        let outer = &self.profile.stations.outer;
        let largest = outer.iter().fold(0.0_f64, |largest, r| largest.max(*r));
        let touches = matches!(self.model, Model::Pulse(_) | Model::Contact);
        if touches && self.profile.at(x).outer < POINTED * largest {
            return None;
        }
        let (impulse, in_modes) = match self.model {
            Model::Contact => {
                let closing = self.closing(x)?;
                let (met, _) = self.meet(x, &self.felt(x), closing, SMOOTH)?;
                (met.impulse, met.in_modes)
            }
            _ => {
                let answer = self.answer(x, None)?;
                (answer.impulse, answer.in_modes)
            }
        };
        let in_modes = &in_modes[in_modes.len() - self.modes_used()..];
        let mut velocity = (impulse * self.recoil_between(x, self.scene.hands)).powi(2);
        let mut acceleration = 0.0;
        for ((energy, [omega, _]), gain) in
            in_modes.iter().zip(&self.modes).zip(self.struck.gains(self.scene.hands))
        {
            // Half of the amplitude's square, which is 2 E φ²/m.
            velocity += energy * gain;
            acceleration += energy * gain * omega * omega;
        }
        Some(Glance {
            x,
            exit_speed: impulse / self.scene.ball.mass - self.scene.ball_speed,
            vibration: (self.modes_used() > 0).then(|| in_modes.iter().sum()),
            hands: [velocity.sqrt(), acceleration.sqrt()],
        })
    }

    /// `e_A` of a ball that leaves from `x` with that speed (m/s), and from it the BBCOR of the free
    /// bat and of the bat held at the standard pivot.
    pub fn figures(&self, x: f64, exit_speed: f64) -> [f64; 3] {
        let bat_speed = self.bat.speed_at(x, self.motion);
        let efficiency = (exit_speed - bat_speed) / (bat_speed + self.scene.ball_speed);
        let bbcor = |r: f64| efficiency * (1.0 + r) + r;
        let ball = self.scene.ball.mass;
        let pivoted = ball * (x - STANDARD_PIVOT).powi(2) / self.pivot_inertia;
        [efficiency, bbcor(ball / self.bat.recoil_mass(x)), bbcor(pivoted)]
    }

    /// The hit at `x` (m from the knob end).
    pub fn strike(&self, x: f64) -> Impact {
        self.strike_knowing(x, None)
    }

    /// The hit at `x` (m from the knob end), with the errors of a contact by truncation and by steps
    /// given where they are `known`: they are not estimated again.
    pub fn strike_knowing(&self, x: f64, known: Option<[f64; 2]>) -> Impact {
        let bat_speed = self.bat.speed_at(x, self.motion);
        let rigid_exit_speed = self.rigid_exit(x);
        let answer = self.answer(x, known);
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

    /// The force at `x` (m) in time, by the contact model; None where that model has no answer.
    pub fn force(&self, x: f64) -> Option<Vec<Piece>> {
        let (felt, closing) = (self.felt(x), self.closing(x)?);
        let (collider, law) = (self.collider.as_ref()?, self.law_at(x, closing)?);
        let meet = |accuracy| collider.meet_recorded(&felt, &law, closing, accuracy);
        resolved(SMOOTH, meet, |(met, _)| met.is_sound(&felt, closing)).map(|(_, pieces)| pieces)
    }

    /// Force and compression of the ball at `x` (m) in time, by the contact model, at `parts` instants
    /// in every piece of the force; None where that model has no answer.
    pub fn history(&self, x: f64, parts: usize) -> Option<Vec<Moment>> {
        let (pieces, felt, speed) = (self.force(x)?, self.felt(x), self.closing(x)?);
        let modes: Vec<[f64; 2]> =
            swinging(self.wall).into_iter().chain(self.modes.clone()).collect();
        Some(history(&pieces, &felt, &modes, speed, parts))
    }

    /// `1/M_eff` (1/kg): how a bat that does not bend gives way at `x`.
    fn recoil(&self, x: f64) -> f64 {
        if self.held { recoil_between(&self.stiff, x, x) } else { 1.0 / self.bat.recoil_mass(x) }
    }

    /// The rigid motions of a held bat in this model. Where modes are counted, those in springs and
    /// hands are among them.
    fn motions(&self) -> &[RigidMotion] {
        if self.model == Model::Rigid { &self.stiff } else { self.struck.rigid() }
    }

    /// The velocity (m/s) that an impulse of 1 N s at `x` gives a stiff bat at another place.
    fn recoil_between(&self, x: f64, there: f64) -> f64 {
        if self.held {
            return recoil_between(self.motions(), x, there);
        }
        let [x, there] = [x, there].map(|x| x - self.bat.balance_point);
        1.0 / self.bat.mass + x * there / self.bat.inertia
    }

    /// The closing speed (m/s); None where the bat runs away from the ball.
    fn closing(&self, x: f64) -> Option<f64> {
        let closing = self.bat.speed_at(x, self.motion) + self.scene.ball_speed;
        (closing > 0.0).then_some(closing)
    }

    /// μ (kg) and e₀ of a hit at `x` with that closing speed (m/s).
    fn blow(&self, x: f64, closing: f64) -> [f64; 2] {
        let mass = 1.0 / (1.0 / self.scene.ball.mass + self.recoil(x));
        [mass, self.scene.restitution(0.5 * mass * closing * closing)]
    }

    /// The exit speed (m/s) of a stiff bat; None where the bat runs away from the ball.
    fn rigid_exit(&self, x: f64) -> Option<f64> {
        let closing = self.closing(x)?;
        let [mass, cor] = self.blow(x, closing);
        Some(mass * (1.0 + cor) * closing / self.scene.ball.mass - self.scene.ball_speed)
    }

    /// Whether there is something to hit at `x`: a point gives way without end.
    fn has_section(&self, x: f64) -> bool {
        matches!(self.model, Model::Rigid | Model::EnergyLoss(_)) || self.profile.at(x).outer > 0.0
    }

    /// What the model says of a hit at `x`, if it says anything.
    fn answer(&self, x: f64, known: Option<[f64; 2]>) -> Option<Answer> {
        let closing = self.closing(x).filter(|_| self.has_section(x))?;
        let [mass, cor] = self.blow(x, closing);
        let lost = 0.5 * mass * closing * closing * (1.0 - cor * cor);
        let rigid = Answer::new(mass * (1.0 + cor) * closing, cor, lost);
        match self.model {
            Model::Rigid => Some(rigid),
            Model::EnergyLoss(loss) => self.empirical(loss, x, closing, rigid),
            Model::Pulse(pulse) => self.pulsed(pulse, x, closing, cor),
            Model::Contact => self.touched(x, closing, cor, known),
        }
    }

    fn empirical(&self, loss: EnergyLoss, x: f64, closing: f64, rigid: Answer) -> Option<Answer> {
        let (incoming, ball) = (-self.scene.ball_speed, self.scene.ball.mass);
        let stiff = rigid.impulse / ball + incoming;
        let shapes = report_shapes(&self.solution.modes, self.bat.mass, x);
        let of = |vibration| EnergyLoss::exit_velocity(incoming, stiff, vibration);
        let exit = of(loss.vibration(&shapes))?;
        let impulse = ball * (exit - incoming);
        let mut answer = Answer { impulse, ..rigid };
        answer.in_modes = loss.energies(&shapes, impulse, ball);
        let largest = largest_shapes(&self.solution.modes, self.bat.mass, x);
        // If the shapes cannot be bounded, neither can the loss.
        let other = of(loss.vibration(&largest)).filter(|v| v.is_finite());
        answer.error += other.map_or(1.0, |v| (v - exit).abs() / closing);
        Some(answer)
    }

    fn pulsed(&self, pulse: Pulse, x: f64, closing: f64, restitution: f64) -> Option<Answer> {
        let ball = self.scene.ball.mass;
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
        let mut answer = Answer::new(impulse, restitution, lost);
        answer.in_modes = in_modes;
        // All modes beyond, and the mesh.
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

    fn touched(&self, x: f64, closing: f64, cor: f64, known: Option<[f64; 2]>) -> Option<Answer> {
        let (ball, count) = (self.scene.ball.mass, self.modes_used());
        let Effort { accuracy, completed } = self.effort;
        let beyond = completed.then(|| self.struck.flexibility(x));
        let felt = self.felt_with(x, count, beyond);
        let (met, accuracy) = self.meet(x, &felt, closing, accuracy)?;
        let apart = |count: usize, accuracy: f64, faster: f64| {
            let felt = self.felt_with(x, count, beyond);
            let other = self.meet(x, &felt, faster * closing, accuracy);
            // One that comes to no end says nothing.
            other.map_or(1.0, |(other, _)| {
                (other.impulse / faster - met.impulse).abs() / (ball * closing)
            })
        };
        let answered = Answered { met: &met, count, accuracy };
        let shears = self.solution.theory.shears();
        let mut answer = Answer::new(met.impulse, cor, met.lost_in_ball);
        [answer.truncation, answer.steps] =
            known.filter(|_| !answered.is_delicate()).unwrap_or_else(|| {
                answered.errors(shears, |few, accuracy| match completed || few == count {
                    true => apart(few, accuracy, 1.0),
                    false => 0.0,
                })
            });
        let [magnified, round_off] = answered.magnified(|by| apart(count, accuracy, 1.0 + by));
        answer.steps += round_off;
        let mass = 1.0 / felt.inverse_mass;
        // What touches beyond those that were followed could give, and a ball deader than any law.
        answer.error +=
            met.open / (ball * closing) + (LEAST_RESTITUTION - cor).max(0.0) * mass / ball;
        answer.error += self.wall_error + answer.truncation + answer.steps;
        // How long one push of the force lasts (s): a half sine's time on a stiff bat at most.
        let push = met.time / (met.touches + met.reloads) as f64;
        let push = push.min(std::f64::consts::PI * self.pressed);
        for (doubt, [omega, _]) in self.struck.doubt(x).iter().zip(&self.modes) {
            // A mode takes the force's changes that are slower than itself hardly at all.
            let turns = omega * push / std::f64::consts::PI;
            let change = doubt * mass * met.impulse / (ball * closing) / (1.0 + turns * turns);
            answer.error += magnified * change;
        }
        let flags = [
            (met.reloads > 0, "reload"),
            (met.late, "late_contact"),
            (met.again(), "second_contact"),
        ];
        answer.flags = flags.into_iter().filter_map(|(is, name)| is.then_some(name)).collect();
        answer.contact_time = Some(met.time);
        let exit_speed = met.first_impulse / ball - self.scene.ball_speed;
        answer.first_separation = Some(Separation { time: met.first_end, exit_speed });
        answer.peak_force = Some(met.peak_force);
        answer.peak_compression = Some(met.compression);
        let walls = met.in_modes.len() - count;
        answer.in_wall = met.in_modes[..walls].iter().sum();
        answer.in_modes = met.in_modes[walls..].to_vec();
        answer.lost_in_bat = met.lost_in_bat;
        Some(answer)
    }

    fn outcome(&self, x: f64, bat_speed: f64, answer: Answer) -> Outcome {
        let Scene { ball, ball_speed, .. } = self.scene;
        let impulse = answer.impulse;
        let (closing, exit_speed) = (bat_speed + ball_speed, impulse / ball.mass - ball_speed);
        let kinetic = |speed: f64| 0.5 * ball.mass * speed * speed;
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
        Outcome {
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
                vibration_by_mode: answer.in_modes,
                dissipated_ball: answer.lost_in_ball,
                dissipated_damping: answer.lost_in_bat,
                wall: answer.in_wall,
            },
            error: answer.error,
            truncation: answer.truncation,
            steps: answer.steps,
        }
    }

    /// The bat as the ball feels it at `x` (m), with as many modes as the effort takes.
    fn felt(&self, x: f64) -> Felt {
        let beyond = self.effort.completed.then(|| self.struck.flexibility(x));
        self.felt_with(x, self.modes_used(), beyond)
    }

    /// The bat as the ball feels it at `x` (m), with `count` modes; `beyond` is the flexibility of all
    /// modes where those beyond `count` are to be included.
    fn felt_with(&self, x: f64, count: usize, beyond: Option<[f64; 2]>) -> Felt {
        let modes = self.struck.with_modes(x, self.scene.ball.mass, count);
        let mut felt = match beyond {
            None => modes,
            Some(beyond) => self.struck.completed(x, modes, beyond),
        };
        match self.wall {
            Some(wall) if wall.mass > 0.0 => felt.gains.insert(0, 1.0 / wall.mass),
            Some(wall) => felt.rest += 1.0 / wall.stiffness,
            None => {}
        }
        felt
    }

    /// The force law with the e₀ of the hit, which later touches of the same hit keep.
    fn law_at(&self, x: f64, closing: f64) -> Option<ForceLaw> {
        let [_, cor] = self.blow(x, closing);
        self.scene.force_law(cor).ok()
    }

    /// The meeting and the accuracy of its steps, which may have to be better than asked.
    fn meet(&self, x: f64, felt: &Felt, closing: f64, accuracy: f64) -> Option<(Encounter, f64)> {
        let (collider, law) = (self.collider.as_ref()?, self.law_at(x, closing)?);
        let meet = |accuracy| (collider.meet(felt, &law, closing, accuracy), accuracy);
        resolved(accuracy, meet, |(met, _)| met.is_sound(felt, closing))
    }
}

/// The flag of a contact whose steps come to no end, or whose energies do not close.
pub const UNRESOLVED: &str = "unresolved";

/// The meeting by steps of that accuracy, or by better ones where these do not hold.
fn resolved<T>(accuracy: f64, meet: impl Fn(f64) -> T, is_sound: impl Fn(&T) -> bool) -> Option<T> {
    const TRIES: i32 = 12;
    const FINER: f64 = 0.2;
    (0..TRIES).map(|k| meet(FINER.powi(k) * accuracy)).find(is_sound)
}

/// ω (rad/s) and damping ratio of a wall that has a mass.
fn swinging(wall: Option<Wall>) -> Option<[f64; 2]> {
    let wall = wall.filter(|wall| wall.mass > 0.0)?;
    Some([(wall.stiffness / wall.mass).sqrt(), 0.0])
}

/// The wall as a ball feels it that is pressed for about that time τ (s), and the error of that,
/// relative to the closing speed: one so light that it swings many times meanwhile follows the force
/// as a spring does, but for about `1/(ωτ)²`.
fn felt_wall(wall: Option<Wall>, time: f64, accuracy: f64) -> (Option<Wall>, f64) {
    /// Of the steps' accuracy.
    const SHARE: f64 = 0.05;
    let Some([omega, _]) = swinging(wall) else { return (wall, 0.0) };
    let error = (omega * time).powi(-2);
    match error <= SHARE * accuracy {
        true => (wall.map(|wall| Wall { mass: 0.0, ..wall }), error),
        false => (wall, 0.0),
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
