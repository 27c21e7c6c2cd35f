//! Ball and bat while they touch: a lossy spring between a mass and a body that turns, moves and
//! rings.
//!
//! With `x` the ball's compression, `F(x)` its force ([`crate::collision::contact::force_law`]) and the bat's
//! motions at the impact point,
//!
//! ```text
//! x + C F = z + Σ y_n                      z the rigid closing, y_n the modes' deflections
//! z″ = −F/μ                                1/μ = 1/m + 1/M_eff
//! y_n″ + 2ζ_n ω_n y_n′ + ω_n² y_n = −c_n F    c_n = φ_n(a)²/m_n
//! C                                        flexibility of the modes left out, which follow at once
//! ```
//!
//! Each mode is the memory `v(t) = ∫ e^{s(t−τ)} F dτ` of the force, `s = −ζω + iω_d`, with `y =
//! −(c/ω_d) Im v` and `y′ = −(c/ω_d) Im sv`. In a step the force is a polynomial through Lobatto's
//! points, at which the first equation holds; its effect on `z` and `v` is then exact, however fast
//! a mode swings, and the tables for that depend on the modes and the step's length alone. A small
//! bump is added to the force of every step so that the energy is right to round-off; how much
//! energy that takes shows how good the steps are. The loading's end and the ball's departure are
//! located inside a step by Newton's method on the exact motion.
//!
//! The ball may be caught again ([`crate::collision::contact::flight`]), while its force has almost gone or after it
//! has left. One that left is round again: a later touch begins on the first branch of the law, with
//! the e₀ of the first. The meeting ends when the ball is gone for good.
//!
//! # Source
//!
//! Modal coupling: A. M. Nathan, Am. J. Phys. 68, 979 (2000), who leaves time to a Runge-Kutta
//! method. Exact motion under a polynomial load: variation of constants. Energy by projection: E. Hairer, C. Lubich,
//! G. Wanner, Geometric Numerical Integration (2006), section IV.4.
use std::sync::OnceLock;

use pulp::{Simd, WithSimd};

use crate::base::lanes::widest;
use crate::collision::contact::collocation::{LANES, Lobatto, POINTS, Pair};
use crate::collision::contact::events::{CLOSED, Event, Stop};
use crate::collision::contact::flight::Landing;
use crate::collision::contact::force_law::{ForceLaw, Top};
use crate::collision::contact::step::{Coupling, Course, Piece, Step, StepTable};
use crate::collision::contact::touch::{Felt, State, Touch};

/// What a meeting of ball and bat left behind.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Encounter {
    /// Impulse `J` of all touches (N s).
    pub impulse: f64,
    /// Contact time, all touches together (s).
    pub time: f64,
    /// When the ball leaves for good, since the first touch (s).
    pub end: f64,
    /// When the ball leaves for the first time, since the first touch (s).
    pub first_end: f64,
    /// Impulse of the first touch (N s).
    pub first_impulse: f64,
    /// How many times they touch.
    pub touches: usize,
    /// Largest force (N).
    pub peak_force: f64,
    /// Largest compression (m).
    pub compression: f64,
    /// Energy lost in the ball (J).
    pub lost_in_ball: f64,
    /// Energy lost by the bat's damping (J).
    pub lost_in_bat: f64,
    /// Energy of every mode (J).
    pub in_modes: Vec<f64>,
    /// Energy that the steps were off by before it was put right, relative to what was available.
    pub corrected: f64,
    /// How often the force rose above the largest compression again.
    pub reloads: usize,
    /// The force had almost gone when the bat caught up with the ball.
    pub late: bool,
    /// Impulse (N s) that touches beyond those that were followed might give.
    pub open: f64,
    /// The steps came to no end.
    pub endless: bool,
}

impl Encounter {
    /// Whether the bat's surface caught the ball again after it had left.
    pub fn again(&self) -> bool {
        self.touches > 1
    }

    /// Whether the steps came to an end and the energies close, ball and bat having neared at `speed`
    /// (m/s): what is left of the rigid motions' energy is all that is not lost or in the modes.
    pub fn is_sound(&self, felt: &Felt, speed: f64) -> bool {
        /// Share of the energy that may be missing or too much.
        const BOUND: f64 = 1e-9;
        let after = speed - self.impulse * felt.inverse_mass;
        let [before, after] = [speed, after].map(|v| 0.5 * v * v / felt.inverse_mass);
        let lost = self.lost_in_ball + self.lost_in_bat + self.in_modes.iter().sum::<f64>();
        // A balance that is not a number does not close.
        !self.endless && (before - after - lost).abs() <= BOUND * before
    }
}

/// A bat's modes in time, for any impact point: the tables are shared.
#[derive(Debug, Clone)]
pub struct Collider {
    rule: Lobatto,
    /// `s = −ζω + iω_d` of every mode, the last lanes filled; its parts, its absolute square.
    poles: Vec<Pair>,
    decay: Vec<f64>,
    swing: Vec<f64>,
    square: Vec<f64>,
    /// Steps of length `longest/2^level`, made when first needed.
    tables: Vec<OnceLock<StepTable>>,
    longest: f64,
}

/// Halvings of the longest step.
const LEVELS: usize = 42;
/// Errors that are let pass, of the accuracy: of a usual step, of a longer one, and the energy that
/// the ball may still store when its last step begins.
const USUAL_ERROR: f64 = 3.0;
const LONG_ERROR: f64 = 0.01;
const LAST_ENERGY: f64 = 0.03;
/// A bump may change the impulse by this share of the accuracy, relative.
const SLIGHT: f64 = 0.05;
/// A meeting that needs more steps than this has failed.
const MOST_STEPS: usize = 20_000;
/// Touches that are followed; what more could give is part of the error.
const MOST_TOUCHES: usize = 64;
/// A ball that has flown for so many times the longest step, about a hundred times as long as it was
/// pressed, is gone: by then a swung bat has turned away, and hands that would bring it back have moved.
const LONGEST_FLIGHT: f64 = 100.0;
/// Share of the largest compression by which its return may be missed.
const MISSED: f64 = 1e-8;
/// Share of the energy that the force may still give when it is let go.
const NOTHING: f64 = 1e-14;
/// Below this share of its peak the force has almost gone, and steps may be longer.
const FAINT: f64 = 0.02;
/// Halvings of the longest step while there is a force, and the most for seeing whether the surface
/// passes by the ball between two points.
const USUAL: usize = 2;
const WATCHFUL: usize = 6;

impl Collider {
    /// Modes with those ω (rad/s) and damping ratios below 1, for hits that compress a ball for
    /// about that time (s).
    pub fn new(modes: &[[f64; 2]], time: f64) -> Self {
        let pole = |[omega, ratio]: &[f64; 2]| {
            [-ratio * omega, omega * ((1.0 - ratio) * (1.0 + ratio)).sqrt()]
        };
        // What fills the last lanes weighs nothing.
        let filled = modes.len().next_multiple_of(LANES);
        let fill = std::iter::repeat([0.0, 1.0 / time]);
        let poles: Vec<Pair> = modes.iter().map(pole).chain(fill).take(filled).collect();
        Self {
            rule: Lobatto::default(),
            decay: poles.iter().map(|s| s[0]).collect(),
            swing: poles.iter().map(|s| s[1]).collect(),
            square: poles.iter().map(|s| s[0] * s[0] + s[1] * s[1]).collect(),
            poles,
            tables: vec![OnceLock::new(); LEVELS],
            longest: time * (1 << USUAL) as f64,
        }
    }

    /// The meeting at that place, ball and bat nearing at `speed` (m/s), with as many modes as there
    /// are gains, in steps whose force is off by about `accuracy`, relative.
    pub fn meet(&self, felt: &Felt, law: &ForceLaw, speed: f64, accuracy: f64) -> Encounter {
        let history = None;
        widest(Meeting { collider: self, felt, law, speed, accuracy, history })
    }

    /// The meeting, and its force in time, piece by piece, from the first touch to the last.
    pub fn meet_recorded(
        &self,
        felt: &Felt,
        law: &ForceLaw,
        speed: f64,
        accuracy: f64,
    ) -> (Encounter, Vec<Piece>) {
        let mut pieces = Vec::new();
        let history = Some(&mut pieces);
        let meeting = Meeting { collider: self, felt, law, speed, accuracy, history };
        (widest(meeting), pieces)
    }
}

struct Meeting<'a> {
    collider: &'a Collider,
    felt: &'a Felt,
    law: &'a ForceLaw,
    speed: f64,
    accuracy: f64,
    history: Option<&'a mut Vec<Piece>>,
}

impl Meeting<'_> {
    /// The compression (m) at which ball and flexibility together have that energy (J).
    fn deepest(&self, energy: f64) -> f64 {
        let mut x = self.law.compression(energy);
        // From above, and convex: Newton's method comes down to it.
        for _ in 0..60 {
            let [force, slope] = self.law.force(x, None);
            let more = self.law.energy(x, None)[0] + 0.5 * self.felt.rest * force * force - energy;
            let by = more / (force + self.felt.rest * force * slope);
            if by <= 1e-3 * x || by.is_nan() {
                break;
            }
            x -= by;
        }
        x
    }
}

impl WithSimd for Meeting<'_> {
    type Output = Encounter;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Encounter {
        let Collider { rule, poles: all, decay, swing, square, tables, longest } = self.collider;
        let count = self.felt.gains.len().next_multiple_of(LANES);
        let poles = &all[..count];
        let energy = 0.5 * self.speed * self.speed / self.felt.inverse_mass;
        let deepest = self.deepest(energy);
        let gains = self.felt.gains.iter().copied().chain(std::iter::repeat(0.0));
        let weights: Vec<f64> = poles.iter().zip(gains).map(|(s, gain)| gain / s[1]).collect();
        let touch = Touch {
            rule,
            poles,
            felt: self.felt,
            decay: &decay[..count],
            swing: &swing[..count],
            square: &square[..count],
            masses: weights.iter().zip(poles).map(|(w, s)| w / s[1]).collect(),
            weights,
            damped: poles.iter().any(|s| s[0] != 0.0),
            law: *self.law,
            speed: self.speed,
            energy,
            deepest,
            way: deepest + self.felt.rest * self.law.force(deepest, None)[0],
            accuracy: self.accuracy,
        };
        touch.go(Means { all, tables, longest: *longest, history: self.history })
    }
}

/// Where a meeting has come to.
struct Run {
    now: State,
    next: State,
    /// The largest compression of this touch, once the ball is on its way back.
    top: Option<Top>,
    /// The last step's compression.
    last: Option<Course>,
    /// Level of the next step, whose length is `longest/2^level`.
    level: usize,
    /// Whether the force has almost gone.
    faint: bool,
    steps: usize,
    couplings: [Option<Coupling>; LEVELS],
}

/// What became of a step.
enum Taken {
    /// The step failed and is repeated, shorter.
    Finer,
    /// The step is done and the next one follows.
    On,
    /// The step was the last: the ball has left, or its force has gone.
    Parted,
}

/// Tables of steps, made when first needed, and who wants to know the force.
struct Means<'a> {
    all: &'a [Pair],
    tables: &'a [OnceLock<StepTable>],
    longest: f64,
    history: Option<&'a mut Vec<Piece>>,
}

impl Means<'_> {
    fn record(&mut self, piece: Piece) {
        self.history.iter_mut().for_each(|history| history.push(piece));
    }
}

impl Touch<'_> {
    /// Touch by touch until the ball is gone for good.
    #[inline(always)]
    fn go(&self, mut means: Means) -> Encounter {
        let mut met = Encounter { touches: 1, ..Encounter::default() };
        let [now, next] = [0, 1].map(|_| State::at_first(self.poles.len(), self.speed));
        let (top, last, couplings) = (None, None, [None; LEVELS]);
        let mut run = Run { now, next, top, last, level: 0, faint: false, steps: 0, couplings };
        run.level = self.first_level(&run.now, means.longest);
        let longest = LONGEST_FLIGHT * means.longest;
        let mut began = 0.0;
        loop {
            if !self.press(&mut run, &mut means, &mut met) {
                met.endless = true;
                break;
            }
            // A force that has gone may come back before the ball is round again.
            let left = self.reach(&run.now);
            if run.now.compression > 0.0 && self.glide(&mut run, &mut means, [0.0, left]) {
                (met.late, run.level, run.last) = (true, USUAL, None);
                self.settle(&mut run.now, run.top);
                continue;
            }
            met.time += run.now.time - began;
            self.part(&mut run, &mut met);
            let flight = self.fly(&mut run.now, [f64::NEG_INFINITY, 0.0], longest);
            if flight == Landing::Open || met.touches == MOST_TOUCHES && flight == Landing::Meets {
                met.open = self.most_that_follows(&run.now);
                break;
            }
            if flight == Landing::Gone {
                break;
            }
            let length = run.now.time - met.end;
            means.record(Piece { start: met.end, length, powers: [0.0; POINTS] });
            began = run.now.time;
            met.touches += 1;
            (run.last, run.faint) = (None, false);
            run.level = self.first_level(&run.now, means.longest);
        }
        met
    }

    /// Lets ball and bat move while there is next to no force; whether it comes back.
    fn glide(&self, run: &mut Run, means: &mut Means, between: [f64; 2]) -> bool {
        let start = run.now.time;
        let landing = self.fly(&mut run.now, between, f64::INFINITY);
        let length = run.now.time - start;
        means.record(Piece { start, length, powers: [0.0; POINTS] });
        landing == Landing::Meets
    }

    /// The ball leaves and is round again.
    fn part(&self, run: &mut Run, met: &mut Encounter) {
        let Run { now, top, .. } = run;
        now.spent += self.law.energy(0.0, *top)[1];
        met.compression = top.map_or(0.0, |top| top.compression).max(met.compression);
        (now.compression, now.force, *top) = (0.0, 0.0, None);
        (met.impulse, met.end) = (now.impulse, now.time);
        if met.touches == 1 {
            (met.first_impulse, met.first_end) = (met.impulse, met.end);
        }
        (met.lost_in_ball, met.lost_in_bat) = (now.spent, now.lost);
        met.in_modes = (0..self.felt.gains.len()).map(|n| self.in_mode(now, n)).collect();
    }

    /// The most impulse (N s) that later touches can give: all energy there is in the ball's flight.
    fn most_that_follows(&self, now: &State) -> f64 {
        let energy = self.energy - now.lost - now.spent;
        let fastest = (2.0 * energy * self.felt.inverse_mass).sqrt();
        (fastest + now.speed) / self.felt.inverse_mass
    }

    /// The level of a touch's first step: the force begins as a power of the time.
    #[inline(always)]
    fn first_level(&self, now: &State, longest: f64) -> usize {
        let first = (3.0 * self.accuracy).powf(1.0 / (1.0 + self.law.exponent)) * self.way;
        let level = (longest * self.rate(now) / first).log2().ceil().max(0.0) as usize;
        level.clamp(USUAL, LEVELS - 1)
    }

    /// Steps until the ball has left or its force has gone; whether they come to an end.
    #[inline(always)]
    fn press(&self, run: &mut Run, means: &mut Means, met: &mut Encounter) -> bool {
        while run.steps < MOST_STEPS && met.corrected <= 1.0 {
            run.steps += 1;
            match self.step(run, means, met) {
                Taken::Finer if run.level + 1 == LEVELS => return false,
                Taken::Finer => run.level += 1,
                Taken::On => {}
                Taken::Parted => return true,
            }
        }
        false
    }

    #[inline(always)]
    fn step(&self, run: &mut Run, means: &mut Means, met: &mut Encounter) -> Taken {
        let Run { now, next, top, last, level, .. } = run;
        let length = means.longest * 0.5_f64.powi(*level as i32);
        let table =
            means.tables[*level].get_or_init(|| StepTable::new(self.rule, means.all, length));
        let coupling = match run.couplings[*level] {
            Some(known) => known,
            None => *run.couplings[*level].insert(self.coupling(table)),
        };
        let (mut step, converged) = self.solve(table, &coupling, now, *top, last.as_ref());
        let error = self.error_of(&step);
        let allowed = if *level < USUAL { LONG_ERROR } else { USUAL_ERROR };
        // An error that is not a number is too large.
        let small = error <= allowed * self.accuracy;
        if !(converged && small) {
            return Taken::Finer;
        }
        self.advance(table, now, &step, next);
        let event = self.event(&step, next, *top);
        if self.is_coarse(event, run, &step) {
            return Taken::Finer;
        }
        let Run { now, next, top, last, level, .. } = run;
        let most = step.force.iter().fold(0.0, |most: f64, f| most.max(*f));
        let slight = SLIGHT * self.accuracy;
        // On its way back the force is small, and steep.
        let pulls = |step: &Step, next: &State| {
            top.is_some_and(|top| step.until(now, next).pulls(top.force))
        };
        let Some(event) = event else {
            let off = self.correct(next, length, table.bumps(), [most, slight], *top);
            let Some(off) = off.filter(|_| !pulls(&step, next)) else { return Taken::Finer };
            met.corrected += off;
            means.record(step.until(now, next));
            *last = Some(self.course(&step));
            let low = top.is_some_and(|t| next.force < FAINT * t.force);
            let grown = error * 2.0_f64.powi(POINTS as i32);
            let least = if low { 0 } else { USUAL };
            if grown <= 4.0 * self.accuracy && *level > least {
                *level -= 1;
            }
            *level = (*level).max(least);
            met.late |= run.faint && next.force > now.force;
            run.faint |= low;
            std::mem::swap(now, next);
            return if self.is_over(now, *top) { Taken::Parted } else { Taken::On };
        };
        let stop = Stop { event, top: *top, most, slight };
        let Some(off) = self.stop(stop, now, &mut step, next) else { return Taken::Finer };
        // The last bit of the force does too little work to put much right.
        let open = || self.open(next, *top) > CLOSED || pulls(&step, next);
        if event == Event::Gone && open() {
            return Taken::Finer;
        }
        let known = top.unwrap_or(Top { compression: next.compression, force: next.force });
        let missed = (next.compression - known.compression).abs() > MISSED * known.compression;
        if event == Event::Again && missed {
            return Taken::Finer;
        }
        met.corrected += off;
        means.record(step.until(now, next));
        let from = (next.time - now.time) / step.length;
        *last = Some(Course { from, ..self.course(&step) });
        std::mem::swap(now, next);
        match event {
            Event::Turned => {
                let compression = now.compression;
                let [force, _] = self.law.force(compression, None);
                *top = Some(Top { compression, force });
                now.force = force;
                met.peak_force = met.peak_force.max(force);
            }
            Event::Again => {
                (now.compression, now.force) = (known.compression, known.force);
                *top = None;
                *level = (*level).max(USUAL);
                met.reloads += 1;
            }
            Event::Gone => {
                now.compression = 0.0;
                return Taken::Parted;
            }
        }
        Taken::On
    }

    /// Whether a step that ends so is too long to be trusted.
    #[inline(always)]
    fn is_coarse(&self, event: Option<Event>, run: &Run, step: &Step) -> bool {
        let Run { now, next, top, level, .. } = run;
        match event {
            // The last of the force is a broken power of the time, and may be overlooked.
            Some(Event::Gone) => {
                self.law.energy(now.compression, *top)[0]
                    > LAST_ENERGY * self.accuracy * self.energy
            }
            Some(_) => top.is_some_and(|t| step.force[POINTS - 1] < FAINT * t.force),
            None if *level >= WATCHFUL => false,
            None if top.is_some() => self.may_pass(now, step, next),
            // It turned between two points and back.
            None => step.compression.windows(2).any(|pair| pair[1] < pair[0]),
        }
    }

    /// Whether the ball springs back with a force that does nothing more.
    #[inline(always)]
    fn is_over(&self, now: &State, top: Option<Top>) -> bool {
        if top.is_none() || self.rate(now) >= 0.0 {
            return false;
        }
        let bent = 0.5 * self.felt.rest * now.force * now.force;
        self.law.energy_of(now.compression, now.force, top)[0] + bent <= NOTHING * self.energy
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::beam::dowel;
    use crate::beam::dowel::Ends;
    use crate::collision::contact::collocation::polynomial;
    use crate::collision::energy_loss;

    /// ω, ζ = 0 and `c_n` of a free uniform dowel, 238.9 Hz, 0.85 kg, 0.838 m, struck at the
    /// fraction `at` of its length; all modes and the ball's and the rigid dowel's 1/μ.
    fn dowel(modes: usize, at: f64, ball: f64) -> (Vec<[f64; 2]>, Felt) {
        let mass = 0.850_416;
        let first = dowel::beta_l(Ends::FreeFree, 1);
        let omega = |n: usize| {
            std::f64::consts::TAU * 238.907 * (dowel::beta_l(Ends::FreeFree, n) / first).powi(2)
        };
        let gain =
            |n: usize| (energy_loss::wpi_shape(n, at) / energy_loss::wpi_alpha(n)).powi(2) / mass;
        let felt = Felt {
            inverse_mass: 1.0 / ball + (1.0 + 12.0 * (at - 0.5).powi(2)) / mass,
            gains: (1..=modes).map(gain).collect(),
            rest: 0.0,
        };
        ((1..=modes).map(|n| [omega(n), 0.0]).collect(), felt)
    }

    fn meet(
        modes: &[[f64; 2]],
        felt: &Felt,
        law: &ForceLaw,
        speed: f64,
        accuracy: f64,
    ) -> Encounter {
        Collider::new(modes, 8e-5).meet(felt, law, speed, accuracy)
    }

    const BALL: f64 = 0.145;

    #[test]
    fn a_rigid_wall_returns_the_ball_with_its_restitution() {
        for restitution in [0.1, 0.5, 0.9, 1.0] {
            for speed in [1e-3, 1.0, 60.0] {
                let law = ForceLaw::new(6.53e7, 1.84, restitution);
                let felt = Felt { inverse_mass: 1.0 / BALL, ..Felt::default() };
                let met = meet(&[], &felt, &law, speed, 1e-4);
                let back = met.impulse / BALL - speed;
                assert!((back / speed - restitution).abs() < 1e-12, "{restitution} {speed} {back}");
                let lost = 0.5 * BALL * speed * speed * (1.0 - restitution * restitution);
                assert!((met.lost_in_ball - lost).abs() < 1e-12 * speed * speed);
                assert!(met.reloads == 0 && !(met.late || met.again() || met.endless));
            }
        }
    }

    /// A linear spring without loss makes ball, dowel and spring one linear system: its motions are
    /// eigenvectors, and the ball leaves at the first zero of a sum of cosines.
    #[test]
    fn a_linear_ball_is_a_linear_system() {
        use faer::{Mat, Side};
        let (stiffness, speed) = (3e6, 60.0);
        let law = ForceLaw::new(stiffness, 1.0, 1.0);
        for at in [0.5, 0.62, 0.775_842, 0.83, 0.97] {
            let (modes, felt) = dowel(12, at, BALL);
            let met = meet(&modes, &felt, &law, speed, 1e-10);
            // Unknowns z√μ and y/√c: unit mass, stiffness ω² and k g gᵀ.
            let n = modes.len() + 1;
            let reach = |i: usize| match i {
                0 => felt.inverse_mass.sqrt(),
                _ => felt.gains[i - 1].sqrt(),
            };
            let matrix = Mat::<f64>::from_fn(n, n, |i, j| {
                let own = if i == j && i > 0 { modes[i - 1][0].powi(2) } else { 0.0 };
                own + stiffness * reach(i) * reach(j)
            });
            let pairs = matrix.self_adjoint_eigen(Side::Lower).unwrap();
            let parts: Vec<[f64; 2]> = (0..n)
                .map(|k| {
                    let vector = pairs.U().col(k);
                    let seen: f64 = (0..n).map(|i| reach(i) * vector[i]).sum();
                    let start = speed / reach(0) * vector[0];
                    let omega = pairs.S()[k].max(0.0).sqrt();
                    [omega, seen * start / omega]
                })
                .collect();
            let x = |t: f64| -> f64 { parts.iter().map(|[w, a]| a * (w * t).sin()).sum() };
            let mut high = 1e-5;
            while x(high) > 0.0 {
                high += 1e-6;
            }
            let mut low = high - 1e-6;
            for _ in 0..80 {
                let middle = 0.5 * (low + high);
                if x(middle) > 0.0 { low = middle } else { high = middle }
            }
            let impulse: f64 =
                parts.iter().map(|[w, a]| stiffness * a * (1.0 - (w * low).cos()) / w).sum();
            assert!((met.time / low - 1.0).abs() < 1e-11, "{at} {} {low}", met.time);
            assert!((met.impulse / impulse - 1.0).abs() < 1e-11, "{at} {} {impulse}", met.impulse);
        }
    }

    /// What was recorded has the meeting's impulse, ends with it and leaves its energy in a mode.
    #[test]
    fn the_recorded_force_is_the_force() {
        for (at, restitution, accuracy) in
            [(0.5, 0.5, 1e-3), (0.7, 0.5, 1e-6), (0.775_842, 0.9, 1e-3), (0.99, 0.3, 1e-3)]
        {
            let (modes, felt) = dowel(6, at, BALL);
            let law = ForceLaw::new(6.53e7, 1.84, restitution);
            let collider = Collider::new(&modes, 8e-5);
            let (met, pieces) = collider.meet_recorded(&felt, &law, 60.0, accuracy);
            assert_eq!(met, collider.meet(&felt, &law, 60.0, accuracy));
            let end = pieces.last().map(|piece| piece.start + piece.length).unwrap();
            assert!((end / met.end - 1.0).abs() < 1e-14);
            let (mut impulse, mut memory, omega) = (0.0, [0.0; 2], modes[2][0]);
            let mut start = 0.0;
            for piece in &pieces {
                assert!((piece.start - start).abs() < 1e-14);
                start = piece.start + piece.length;
                for (s, w) in crate::base::quadrature::gauss(12) {
                    let force = polynomial(&piece.powers, s);
                    assert!(force > -1e-6 * met.peak_force);
                    let part = w * piece.length * force;
                    impulse += part;
                    let (sin, cos) = (omega * (end - piece.start - s * piece.length)).sin_cos();
                    memory = [memory[0] + cos * part, memory[1] + sin * part];
                }
            }
            assert!((impulse / met.impulse - 1.0).abs() < 1e-12, "{at}");
            let energy = 0.5 * felt.gains[2] * (memory[0].powi(2) + memory[1].powi(2));
            let whole = 0.5 * 60.0 * 60.0 / felt.inverse_mass;
            assert!((energy - met.in_modes[2]).abs() < 1e-12 * whole, "{at}");
        }
    }

    /// The dowel of the WPI report at 0.7 of its length, 50 rad/s about a point 63.5 mm beyond the
    /// knob, a ball of 5 oz at 90 mph, k = 1e7 N/m^1.5, e₀ = ½: exit speeds with 0 to 30 modes by
    /// an eighth-order Runge-Kutta method, the branches' ends located.
    #[test]
    fn other_methods_find_the_same_exit_speeds() {
        let (ball, incoming): (f64, f64) = (0.141_747_6, 40.2336);
        let law = ForceLaw::new(1e7, 1.5, 0.5);
        let speed = 50.0 * (0.0635 + 0.7 * 0.8382) + incoming;
        let known = [
            (0, 47.293),
            (1, 44.128),
            (2, 33.272),
            (3, 33.052),
            (5, 33.513),
            (10, 33.749),
            (20, 33.788),
            (30, 33.792),
        ];
        for (count, exit) in known {
            let (modes, felt) = dowel(count, 0.7, ball);
            let met = meet(&modes, &felt, &law, speed, 1e-8);
            let found = met.impulse / ball - incoming;
            assert!((found - exit).abs() < 6e-4, "{count} {found}");
        }
    }
}
