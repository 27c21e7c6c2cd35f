//! Ball and bat while they touch: a lossy spring between a mass and a body that turns, moves and
//! rings.
//!
//! With `x` the ball's compression, `F(x)` its force ([`crate::collision::force_law`]) and the bat's
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
//! # Source
//!
//! Modal coupling: A. M. Nathan, Am. J. Phys. 68, 979 (2000), who leaves time to a Runge-Kutta
//! method. Exact motion under a polynomial load: variation of constants. Energy by projection: E. Hairer, C. Lubich,
//! G. Wanner, Geometric Numerical Integration (2006), section IV.4.

use std::sync::OnceLock;

use pulp::{Arch, Simd, WithSimd};

use crate::collision::collocation::{Lobatto, POINTS, Pair, moments, polynomial, times};
use crate::collision::force_law::{ForceLaw, Top};

/// The bat as the ball feels it at one place.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Felt {
    /// `1/μ` (1/kg): the ball's own mass and the rigid bat's.
    pub inverse_mass: f64,
    /// `c_n = φ_n(a)²/m_n` (1/kg).
    pub gains: Vec<f64>,
    /// Flexibility of the modes left out (m/N).
    pub rest: f64,
}

/// What a meeting of ball and bat left behind.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Encounter {
    /// `J` (N s).
    pub impulse: f64,
    /// From the first touch to the last (s).
    pub time: f64,
    /// Largest force (N) and compression (m).
    pub peak_force: f64,
    pub compression: f64,
    /// Energy lost in the ball and by the bat's damping (J).
    pub lost_in_ball: f64,
    pub lost_in_bat: f64,
    /// Energy of every mode (J).
    pub in_modes: Vec<f64>,
    /// Energy that the steps were off by before it was put right, relative to what was available.
    pub corrected: f64,
    /// The force rose above the largest compression again.
    pub reloaded: bool,
    /// The force had almost gone when the bat caught up with the ball.
    pub late: bool,
    /// After the ball left, the bat's surface would have caught it again.
    pub second: bool,
    /// The steps came to no end.
    pub endless: bool,
}

/// One moment.
#[derive(Debug, Clone, Default)]
struct State {
    time: f64,
    /// `z` (m) and `z′` (m/s).
    closing: f64,
    speed: f64,
    /// `v`, real and imaginary parts (N s).
    real: Vec<f64>,
    imaginary: Vec<f64>,
    compression: f64,
    force: f64,
    impulse: f64,
    /// Energy the bat's damping has taken (J).
    lost: f64,
}

/// What a step of one length does to every mode; numbers of the modes side by side.
#[derive(Debug, Clone)]
struct Table {
    length: f64,
    modes: usize,
    /// `e^{sh s_i}`, `[i][part][mode]`.
    turns: Vec<f64>,
    /// `∫₀^{h s_i} e^{s(h s_i − τ)} L_j dτ`, `[i][j][part][mode]`.
    kernels: Vec<f64>,
    /// The same of the bump `s(1 − s)` over the whole step, `[part][mode]`.
    bump: Vec<f64>,
}

impl Table {
    fn new(rule: &Lobatto, poles: &[Pair], length: f64) -> Self {
        let modes = poles.len();
        let mut table = Self {
            length,
            modes,
            turns: vec![0.0; POINTS * 2 * modes],
            kernels: vec![0.0; POINTS * POINTS * 2 * modes],
            bump: vec![0.0; 2 * modes],
        };
        for (n, s) in poles.iter().enumerate() {
            for i in 1..POINTS {
                let at = length * rule.at[i];
                let (whole, all) = moments::<POINTS>([s[0] * at, s[1] * at]);
                for part in 0..2 {
                    table.turns[(2 * i + part) * modes + n] = whole[part];
                    for j in 0..POINTS {
                        let (mut sum, mut power) = (0.0, at);
                        for k in 0..POINTS {
                            sum += rule.powers[j][k] * power * all[k][part];
                            power *= rule.at[i];
                        }
                        table.kernels[((i * POINTS + j) * 2 + part) * modes + n] = sum;
                    }
                    if i == POINTS - 1 {
                        table.bump[part * modes + n] = length * (all[1][part] - all[2][part]);
                    }
                }
            }
        }
        table
    }

    #[inline(always)]
    fn turn(&self, i: usize, part: usize, count: usize) -> &[f64] {
        &self.turns[(2 * i + part) * self.modes..][..count]
    }

    #[inline(always)]
    fn kernel(&self, i: usize, j: usize, part: usize, count: usize) -> &[f64] {
        &self.kernels[((i * POINTS + j) * 2 + part) * self.modes..][..count]
    }
}

/// A bat's modes in time, for any impact point: the tables are shared.
#[derive(Debug, Clone)]
pub struct Collider {
    rule: Lobatto,
    /// `s = −ζω + iω_d` of every mode.
    poles: Vec<Pair>,
    /// Steps of length `longest/2^level`, made when first needed.
    tables: Vec<OnceLock<Table>>,
    longest: f64,
}

/// Halvings of the longest step.
const LEVELS: usize = 40;
/// More steps are no contact.
const MOST_STEPS: usize = 100_000;
/// Below this share of its peak the force has almost gone: steps stay short enough there to see the
/// surface pass by the ball.
const FAINT: f64 = 0.02;
/// Longest step there, of the longest of all: half.
const FAINT_LEVEL: usize = 1;

impl Collider {
    /// Modes with those ω (rad/s) and damping ratios below 1, for hits that compress a ball for
    /// about that time (s).
    pub fn new(modes: &[[f64; 2]], time: f64) -> Self {
        let pole = |[omega, ratio]: &[f64; 2]| {
            [-ratio * omega, omega * ((1.0 - ratio) * (1.0 + ratio)).sqrt()]
        };
        Self {
            rule: Lobatto::default(),
            poles: modes.iter().map(pole).collect(),
            tables: vec![OnceLock::new(); LEVELS],
            longest: time,
        }
    }

    /// The meeting at that place, ball and bat nearing at `speed` (m/s), with as many modes as there
    /// are gains, in steps whose force is off by about `accuracy`, relative.
    pub fn meet(&self, felt: &Felt, law: &ForceLaw, speed: f64, accuracy: f64) -> Encounter {
        Arch::new().dispatch(Meeting { collider: self, felt, law, speed, accuracy })
    }
}

struct Meeting<'a> {
    collider: &'a Collider,
    felt: &'a Felt,
    law: &'a ForceLaw,
    speed: f64,
    accuracy: f64,
}

impl WithSimd for Meeting<'_> {
    type Output = Encounter;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Encounter {
        let Collider { rule, poles, tables, longest } = self.collider;
        let (all, count) = (poles.as_slice(), self.felt.gains.len());
        let poles = &all[..count];
        let energy = 0.5 * self.speed * self.speed / self.felt.inverse_mass;
        let weights = poles.iter().zip(&self.felt.gains).map(|(s, gain)| gain / s[1]);
        let touch = Touch {
            rule,
            poles,
            felt: self.felt,
            weights: weights.collect(),
            damped: poles.iter().any(|s| s[0] != 0.0),
            law: *self.law,
            speed: self.speed,
            energy,
            deepest: self.law.compression(energy),
            accuracy: self.accuracy,
        };
        touch.go(all, tables, *longest)
    }
}

impl State {
    fn at_first(modes: usize, speed: f64) -> Self {
        let none = || vec![0.0; modes];
        Self { speed, real: none(), imaginary: none(), ..Self::default() }
    }
}

/// One place, one ball, one speed.
struct Touch<'a> {
    rule: &'a Lobatto,
    poles: &'a [Pair],
    felt: &'a Felt,
    /// `c/ω_d` of every mode (s/kg).
    weights: Vec<f64>,
    damped: bool,
    law: ForceLaw,
    /// At the first touch (m/s), and the energy that goes with it, `μ u²/2` (J).
    speed: f64,
    energy: f64,
    /// What a rigid bat would compress the ball by (m).
    deepest: f64,
    accuracy: f64,
}

/// Why a step ends early.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Event {
    /// The compression is at its largest.
    Turned,
    /// It is as large as its largest again.
    Again,
    /// It is gone.
    Gone,
}

/// What a step stops at: the event, the branch it is met on, and the step's largest force (N).
#[derive(Debug, Clone, Copy)]
struct Stop {
    event: Event,
    top: Option<Top>,
    most: f64,
}

/// A step whose force is known at the points.
#[derive(Debug, Clone, Copy, Default)]
struct Step {
    length: f64,
    compression: [f64; POINTS],
    force: [f64; POINTS],
    /// The same as a polynomial of the time over the length.
    powers: [f64; POINTS],
}

type Coupling = [[f64; POINTS]; POINTS];

impl Touch<'_> {
    #[inline(always)]
    fn go(&self, all: &[Pair], tables: &[OnceLock<Table>], longest: f64) -> Encounter {
        let mut met = Encounter::default();
        let [mut now, mut next] = [0, 1].map(|_| State::at_first(self.poles.len(), self.speed));
        let mut top: Option<Top> = None;
        let mut couplings = [None; LEVELS];
        let mut last: Option<Step> = None;
        let mut faint = false;
        // The force begins as a power of the time.
        let first = (3.0 * self.accuracy).powf(1.0 / (1.0 + self.law.exponent)) * self.deepest;
        let mut level = (longest * self.speed / first).log2().ceil().max(0.0) as usize;
        level = level.min(LEVELS - 1);
        for taken in 0.. {
            if taken == MOST_STEPS {
                met.endless = true;
                break;
            }
            let length = longest * 0.5_f64.powi(level as i32);
            let table = tables[level].get_or_init(|| Table::new(self.rule, all, length));
            let coupling = couplings[level].get_or_insert_with(|| self.coupling(table));
            let (step, converged) = self.solve(table, coupling, &now, top, last.as_ref());
            let finest = level + 1 == LEVELS;
            let error = self.error_of(&step);
            if !finest && (!converged || error > 10.0 * self.accuracy) {
                level += 1;
                continue;
            }
            self.advance(table, &now, &step, &mut next);
            let event = self.event(&step, &next, top);
            // The last of the force is a broken power of the time, and may be overlooked.
            let stored = || self.law.energy(now.compression, top)[0] / self.energy;
            let coarse = match event {
                Some(Event::Gone) => stored() > 3.0 * self.accuracy,
                _ => top.is_some_and(|t| step.force[POINTS - 1] < FAINT * t.force),
            };
            if coarse && !finest && (event.is_some() || level < FAINT_LEVEL) {
                (level, last) = (level + 1, None);
                continue;
            }
            let most = step.force.iter().fold(0.0, |most: f64, f| most.max(*f));
            match event {
                None => {
                    let bump = |n: usize| [table.bump[n], table.bump[table.modes + n]];
                    met.corrected += self.correct(&mut next, length, bump, most, top);
                    last = Some(step);
                    let low = top.is_some_and(|t| next.force < FAINT * t.force);
                    let grown = error * 2.0_f64.powi(POINTS as i32);
                    if grown <= 4.0 * self.accuracy && level > usize::from(low) * FAINT_LEVEL {
                        level -= 1;
                    }
                    met.late |= faint && next.force > now.force;
                    faint |= low;
                }
                Some(event) => {
                    let stop = Stop { event, top, most };
                    met.corrected += self.stop(stop, &now, &step, &mut next);
                    last = None;
                    match event {
                        Event::Turned => {
                            let compression = next.compression;
                            let [force, _] = self.law.force(compression, None);
                            top = Some(Top { compression, force });
                            next.force = force;
                            met.peak_force = met.peak_force.max(force);
                        }
                        Event::Again => {
                            top = None;
                            met.reloaded = true;
                        }
                        Event::Gone => {}
                    }
                    // A ball that gives nothing back leaves at once.
                    if event == Event::Gone || self.law.unloading.is_infinite() {
                        std::mem::swap(&mut now, &mut next);
                        break;
                    }
                }
            }
            std::mem::swap(&mut now, &mut next);
        }
        met.impulse = now.impulse;
        met.time = now.time;
        met.compression = top.map_or(now.compression, |top| top.compression);
        met.lost_in_ball = self.law.energy(now.compression, top)[1];
        met.lost_in_bat = now.lost;
        met.in_modes = (0..self.poles.len()).map(|n| self.in_mode(&now, n)).collect();
        met.second = !met.endless && self.caught_again(&now);
        met
    }

    /// What the force at each point does to the compression at each.
    #[inline(always)]
    fn coupling(&self, table: &Table) -> Coupling {
        let square = table.length * table.length * self.felt.inverse_mass;
        let mut coupling = [[0.0; POINTS]; POINTS];
        for i in 1..POINTS {
            for j in 0..POINTS {
                let kernel = table.kernel(i, j, 1, self.poles.len());
                let modes: f64 = kernel.iter().zip(&self.weights).map(|(k, w)| k * w).sum();
                coupling[i][j] = square * self.rule.twice[i][j] + modes;
            }
        }
        coupling
    }

    /// The forces of a step by Newton's method, and whether they are found.
    #[inline(always)]
    fn solve(
        &self,
        table: &Table,
        coupling: &Coupling,
        now: &State,
        top: Option<Top>,
        last: Option<&Step>,
    ) -> (Step, bool) {
        const ROUNDS: usize = 8;
        let (length, count, rest) = (table.length, self.poles.len(), self.felt.rest);
        let [mut free, mut x, mut f, mut slope] = [[0.0; POINTS]; 4];
        (x[0], f[0]) = (now.compression, now.force);
        for i in 1..POINTS {
            let (re, im) = (table.turn(i, 0, count), table.turn(i, 1, count));
            let mut modes = 0.0;
            for n in 0..count {
                modes += self.weights[n] * (re[n] * now.imaginary[n] + im[n] * now.real[n]);
            }
            let rigid = now.closing + now.speed * length * self.rule.at[i];
            free[i] = rigid - modes - coupling[i][0] * f[0];
            // The last step's force goes on as it was.
            f[i] = last.map_or(0.0, |last| {
                polynomial(&last.powers, 1.0 + length / last.length * self.rule.at[i]).max(0.0)
            });
        }
        for i in 1..POINTS {
            x[i] = free[i] - rest * f[i] - (1..POINTS).map(|j| coupling[i][j] * f[j]).sum::<f64>();
        }
        let mut converged = false;
        for _ in 0..ROUNDS {
            for i in 1..POINTS {
                [f[i], slope[i]] = self.law.force(x[i], top);
            }
            let (mut matrix, mut left) = ([[0.0; POINTS]; POINTS], [0.0; POINTS]);
            for i in 1..POINTS {
                left[i] = free[i] - x[i] - rest * f[i];
                for j in 1..POINTS {
                    left[i] -= coupling[i][j] * f[j];
                    matrix[i][j] = coupling[i][j] * slope[j];
                }
                matrix[i][i] += 1.0 + rest * slope[i];
            }
            let moved = eliminate(&mut matrix, left);
            let mut largest = 0.0_f64;
            for i in 1..POINTS {
                x[i] += moved[i];
                f[i] = (f[i] + slope[i] * moved[i]).max(0.0);
                largest = largest.max(moved[i].abs());
            }
            // What is left is the square of this.
            if largest <= 1e-3 * self.accuracy.sqrt() * self.deepest {
                converged = true;
                break;
            }
        }
        for i in 1..POINTS {
            [f[i], _] = self.law.force(x[i], top);
        }
        let powers = self.rule.through(&f);
        (Step { length, compression: x, force: f, powers }, converged)
    }

    /// How far the force is from a polynomial: the impulse of its last term, relative.
    #[inline(always)]
    fn error_of(&self, step: &Step) -> f64 {
        let last: f64 = step.force.iter().zip(&self.rule.last).map(|(f, l)| f * l).sum();
        last.abs() * step.length * self.felt.inverse_mass / self.speed
    }

    /// The state at the end of a step, but for compression and force.
    #[inline(always)]
    fn advance(&self, table: &Table, now: &State, step: &Step, next: &mut State) {
        let (h, count, end) = (table.length, self.poles.len(), POINTS - 1);
        let push = dot(&self.rule.weights, &step.force);
        next.time = now.time + h;
        next.impulse = now.impulse + h * push;
        next.speed = now.speed - h * self.felt.inverse_mass * push;
        let back = h * h * self.felt.inverse_mass * dot(&self.rule.twice[end], &step.force);
        next.closing = now.closing + h * now.speed - back;
        self.memories(table, now, step, end, next);
        (next.compression, next.force) = (step.compression[end], step.force[end]);
        next.lost = now.lost;
        if self.damped {
            let mut rate = self.rule.weights[0] * self.loss(now);
            rate += self.rule.weights[end] * self.loss(next);
            let mut between = State::at_first(count, 0.0);
            for i in 1..end {
                self.memories(table, now, step, i, &mut between);
                rate += self.rule.weights[i] * self.loss(&between);
            }
            next.lost += h * rate;
        }
    }

    /// The modes' memories at point i of a step.
    #[inline(always)]
    fn memories(&self, table: &Table, now: &State, step: &Step, i: usize, next: &mut State) {
        let count = self.poles.len();
        let (re, im) = (table.turn(i, 0, count), table.turn(i, 1, count));
        for n in 0..count {
            next.real[n] = re[n] * now.real[n] - im[n] * now.imaginary[n];
            next.imaginary[n] = re[n] * now.imaginary[n] + im[n] * now.real[n];
        }
        for j in 0..POINTS {
            let (re, im) = (table.kernel(i, j, 0, count), table.kernel(i, j, 1, count));
            for n in 0..count {
                next.real[n] += re[n] * step.force[j];
                next.imaginary[n] += im[n] * step.force[j];
            }
        }
    }

    /// The state at a time within a step, without compression.
    #[inline(always)]
    fn within(&self, now: &State, step: &Step, time: f64, next: &mut State) {
        let mut part = [0.0; POINTS];
        let mut scale = 1.0;
        for (part, power) in part.iter_mut().zip(&step.powers) {
            *part = power * scale;
            scale *= time / step.length;
        }
        next.time = now.time + time;
        (next.impulse, next.speed) = (now.impulse, now.speed);
        (next.closing, next.force) = (now.closing + time * now.speed, 0.0);
        next.lost = now.lost;
        for (k, part) in part.iter().enumerate() {
            let k = k as f64;
            let (once, twice) =
                (time * part / (k + 1.0), time * time * part / ((k + 1.0) * (k + 2.0)));
            next.force += part;
            next.impulse += once;
            next.speed -= self.felt.inverse_mass * once;
            next.closing -= self.felt.inverse_mass * twice;
        }
        for (n, s) in self.poles.iter().enumerate() {
            let (whole, all) = moments::<POINTS>([s[0] * time, s[1] * time]);
            let mut memory = times(whole, [now.real[n], now.imaginary[n]]);
            for (part, moment) in part.iter().zip(&all) {
                memory[0] += time * part * moment[0];
                memory[1] += time * part * moment[1];
            }
            [next.real[n], next.imaginary[n]] = memory;
        }
    }

    /// Moves a state within a step by a very short time to `time`.
    #[inline(always)]
    fn nudge(&self, state: &mut State, step: &Step, time: f64, by: f64) {
        let force = polynomial(&step.powers, (time - 0.5 * by) / step.length);
        state.closing += by * (state.speed - 0.5 * by * self.felt.inverse_mass * force);
        state.speed -= by * self.felt.inverse_mass * force;
        state.impulse += by * force;
        state.time += by;
        state.force = polynomial(&step.powers, time / step.length);
        for (n, s) in self.poles.iter().enumerate() {
            let z = [s[0] * by, s[1] * by];
            // (e^z − 1)/z to the fifth order.
            let mut over = [1.0, 0.0];
            for k in [5.0, 4.0, 3.0, 2.0] {
                let part = times(z, over);
                over = [1.0 + part[0] / k, part[1] / k];
            }
            let memory = [state.real[n], state.imaginary[n]];
            let gained = times(times(z, over), memory);
            state.real[n] += gained[0] + by * force * over[0];
            state.imaginary[n] += gained[1] + by * force * over[1];
        }
    }

    /// What happens in a step.
    #[inline(always)]
    fn event(&self, step: &Step, next: &State, top: Option<Top>) -> Option<Event> {
        match top {
            None => (self.rate(next) < 0.0).then_some(Event::Turned),
            Some(_) if step.compression[1..].iter().any(|x| *x <= 0.0) => Some(Event::Gone),
            Some(top) => {
                let beyond = step.compression[1..].iter().any(|x| *x > top.compression);
                beyond.then_some(Event::Again)
            }
        }
    }

    /// What is zero at the event, and its rate.
    #[inline(always)]
    fn distance(&self, event: Event, state: &State, top: Option<Top>) -> [f64; 2] {
        if event == Event::Turned {
            let mut rate = -state.force * self.felt.inverse_mass;
            for n in 0..self.poles.len() {
                let [a, b] = self.poles[n];
                let (w, v) = (self.weights[n], [state.real[n], state.imaginary[n]]);
                // Im s(sv + F).
                let turned =
                    times([a, b], [a * v[0] - b * v[1] + state.force, a * v[1] + b * v[0]]);
                rate -= w * turned[1];
            }
            return [self.rate(state), rate];
        }
        let x = self.reach(state) - self.felt.rest * state.force;
        let goal = top.filter(|_| event == Event::Again).map_or(0.0, |top| top.compression);
        [x - goal, self.rate(state)]
    }

    /// The state at the event; the energy it was off by, relative.
    #[inline(always)]
    fn stop(&self, stop: Stop, now: &State, step: &Step, next: &mut State) -> f64 {
        let Stop { event, top, .. } = stop;
        // The end of the step, or the first point beyond the event.
        let goal = |x: f64| match (event, top) {
            (Event::Gone, _) => x <= 0.0,
            (Event::Again, Some(top)) => x > top.compression,
            _ => false,
        };
        let beyond = (1..POINTS).find(|i| goal(step.compression[*i])).unwrap_or(POINTS - 1);
        let end = step.length * self.rule.at[beyond];
        if beyond < POINTS - 1 {
            self.within(now, step, end, next);
        }
        let (from, to) = (self.distance(event, now, top), self.distance(event, next, top));
        let mut time = end * crossing(from[0], from[1] * end, to[0], to[1] * end);
        self.within(now, step, time, next);
        self.approach(event, step, top, &mut time, next);
        let mut corrected = self.round_off(stop, now, step, &mut time, next);
        let off = |next: &State| (self.whole_energy(next, top) - self.energy).abs() / self.energy;
        if event == Event::Gone && off(next) > 1e-13 {
            // The force's last bit ends within the step: a step of that length has it whole.
            let (mut last, mut end) = (*step, time);
            for _ in 0..4 {
                let table = Table::new(self.rule, self.poles, end);
                (last, _) = self.solve(&table, &self.coupling(&table), now, top, Some(step));
                self.advance(&table, now, &last, next);
                let [x, rate] = self.distance(event, next, top);
                let by = -x / rate;
                if !(by.abs() > 1e-6 * end && by.abs() < 0.5 * end) {
                    break;
                }
                end += by;
            }
            corrected += self.round_off(stop, now, &last, &mut end, next);
        }
        self.settle(next, top);
        corrected
    }

    /// Puts the energy of a state at an event right, and the event again.
    #[inline(always)]
    fn round_off(
        &self,
        Stop { event, top, most }: Stop,
        now: &State,
        step: &Step,
        time: &mut f64,
        next: &mut State,
    ) -> f64 {
        let mut corrected = 0.0;
        if self.damped {
            next.lost = now.lost + self.loss_within(now, step, *time);
        }
        for _ in 0..4 {
            let length = *time;
            let bump = |n: usize| {
                let s = self.poles[n];
                let (_, all) = moments::<3>([s[0] * length, s[1] * length]);
                [length * (all[1][0] - all[2][0]), length * (all[1][1] - all[2][1])]
            };
            corrected += self.correct(next, length, bump, most, top);
            let [x, rate] = self.distance(event, next, top);
            let by = -x / rate;
            let there = x.abs() < 1e-14 * self.deepest || by.abs() > 0.1 * step.length;
            if event != Event::Gone || there || !by.is_finite() {
                break;
            }
            *time += by;
            self.nudge(next, step, *time, by);
        }
        corrected
    }

    /// Newton's method from a state near the event.
    #[inline(always)]
    fn approach(
        &self,
        event: Event,
        step: &Step,
        top: Option<Top>,
        time: &mut f64,
        next: &mut State,
    ) {
        for _ in 0..4 {
            let [left, rate] = self.distance(event, next, top);
            let by = -left / rate;
            if by.is_nan() || by.abs() > 0.1 * step.length {
                break;
            }
            *time += by;
            self.nudge(next, step, *time, by);
            if by.abs() <= 1e-8 * step.length {
                break;
            }
        }
    }

    /// Compression and force from the motions: `x + C F(x) = z + Σ y`.
    #[inline(always)]
    fn settle(&self, state: &mut State, top: Option<Top>) {
        let (whole, rest) = (self.reach(state), self.felt.rest);
        let mut x = whole - rest * state.force;
        for _ in 0..6 {
            if rest == 0.0 {
                break;
            }
            let [force, slope] = self.law.force(x, top);
            let by = (whole - x - rest * force) / (1.0 + rest * slope);
            x += by;
            if by.abs() <= 1e-15 * self.deepest {
                break;
            }
        }
        state.compression = x;
        state.force = self.law.force(x, top)[0];
    }

    /// Adds a bump to the force of a step of that length, so that the energy is right again;
    /// returns by how much it was not, relative.
    #[inline(always)]
    fn correct(
        &self,
        next: &mut State,
        length: f64,
        bump: impl Fn(usize) -> Pair,
        most: f64,
        top: Option<Top>,
    ) -> f64 {
        let mut off = 0.0;
        for round in 0..4 {
            self.settle(next, top);
            let defect = self.whole_energy(next, top) - self.energy;
            if round == 0 {
                off = defect.abs() / self.energy;
            }
            if defect.abs() <= 1e-14 * self.energy {
                break;
            }
            // `s(1 − s)` has the area 1/6, half of it to each side of the middle.
            let speed = -length * self.felt.inverse_mass / 6.0;
            let closing = 0.5 * length * speed;
            let mut slope = next.speed * speed / self.felt.inverse_mass;
            let mut moved = closing;
            for (n, s) in self.poles.iter().enumerate() {
                let (b, w, square) = (bump(n), self.weights[n], s[0] * s[0] + s[1] * s[1]);
                moved -= w * b[1];
                let rates =
                    (s[0] * next.imaginary[n] + s[1] * next.real[n], s[0] * b[1] + s[1] * b[0]);
                slope += w / s[1] * (rates.0 * rates.1 + square * next.imaginary[n] * b[1]);
            }
            let size = -defect / (slope + next.force * moved);
            // Where the compression does not change no force does work.
            if size.is_nan() || size.abs() > 2.0 * most {
                break;
            }
            next.speed += size * speed;
            next.closing += size * closing;
            next.impulse += size * length / 6.0;
            for n in 0..self.poles.len() {
                let b = bump(n);
                next.real[n] += size * b[0];
                next.imaginary[n] += size * b[1];
            }
        }
        off
    }

    /// `z + Σ y` (m).
    #[inline(always)]
    fn reach(&self, state: &State) -> f64 {
        state.closing - dot(&self.weights, &state.imaginary)
    }

    /// Its rate (m/s).
    #[inline(always)]
    fn rate(&self, state: &State) -> f64 {
        let mut sum = state.speed;
        for (n, s) in self.poles.iter().enumerate() {
            sum -= self.weights[n] * (s[0] * state.imaginary[n] + s[1] * state.real[n]);
        }
        sum
    }

    /// `m_n (q′² + ω² q²)/2` (J).
    #[inline(always)]
    fn in_mode(&self, state: &State, n: usize) -> f64 {
        let s = self.poles[n];
        let rate = s[0] * state.imaginary[n] + s[1] * state.real[n];
        let square = s[0] * s[0] + s[1] * s[1];
        let q = state.imaginary[n];
        0.5 * self.weights[n] / s[1] * (rate * rate + square * q * q)
    }

    /// `Σ 2ζω m_n q′²` (W).
    #[inline(always)]
    fn loss(&self, state: &State) -> f64 {
        let mut sum = 0.0;
        for (n, s) in self.poles.iter().enumerate() {
            let rate = s[0] * state.imaginary[n] + s[1] * state.real[n];
            sum -= 2.0 * s[0] * self.weights[n] / s[1] * rate * rate;
        }
        sum
    }

    /// What damping takes from the beginning of a step to a time in it (J).
    fn loss_within(&self, now: &State, step: &Step, time: f64) -> f64 {
        let mut state = State::at_first(self.poles.len(), 0.0);
        let mut sum = 0.0;
        for (at, weight) in self.rule.at.iter().zip(&self.rule.weights) {
            self.within(now, step, at * time, &mut state);
            sum += weight * self.loss(&state);
        }
        time * sum
    }

    /// Of ball and bat, relative to their common motion, with what is lost (J).
    #[inline(always)]
    fn whole_energy(&self, state: &State, top: Option<Top>) -> f64 {
        let [stored, lost] = self.law.energy(state.compression, top);
        let rigid = 0.5 * state.speed * state.speed / self.felt.inverse_mass;
        let modes: f64 = (0..self.poles.len()).map(|n| self.in_mode(state, n)).sum();
        rigid + modes + stored + lost + state.lost + 0.5 * self.felt.rest * state.force.powi(2)
    }

    /// Whether the ringing surface reaches the ball after it left.
    fn caught_again(&self, end: &State) -> bool {
        let count = self.poles.len();
        let amplitude = |n: usize| self.weights[n] * end.real[n].hypot(end.imaginary[n]);
        let farthest: f64 = (0..count).map(amplitude).sum();
        // Beyond that the ball is out of reach.
        let last = (farthest - end.closing) / -end.speed;
        let fastest = self.poles.iter().map(|s| s[1]).fold(0.0, f64::max);
        if !(last > 0.0 && end.speed < 0.0) || count == 0 {
            return end.speed >= 0.0;
        }
        // The fast modes' own motion is small: eight looks in a turn of the middle ones.
        let looks = (0.5 * last * fastest).clamp(16.0, 4000.0).ceil();
        let at = |k: f64| {
            let t = last * k / looks;
            let mut reach = end.closing + end.speed * t;
            for (n, s) in self.poles.iter().enumerate() {
                let (sin, cos) = (s[1] * t).sin_cos();
                let size = if s[0] == 0.0 { 1.0 } else { (s[0] * t).exp() };
                reach -= self.weights[n] * size * (cos * end.imaginary[n] + sin * end.real[n]);
            }
            reach
        };
        // It begins at zero, going down.
        let slack = 1e-9 * self.deepest;
        (1..=looks as usize).any(|k| at(k as f64) > slack)
    }
}

/// Solves for the points beyond the first.
#[inline(always)]
fn eliminate(matrix: &mut Coupling, mut left: [f64; POINTS]) -> [f64; POINTS] {
    for c in 1..POINTS {
        let inverse = 1.0 / matrix[c][c];
        for i in c + 1..POINTS {
            let factor = matrix[i][c] * inverse;
            for j in c..POINTS {
                matrix[i][j] -= factor * matrix[c][j];
            }
            left[i] -= factor * left[c];
        }
    }
    for c in (1..POINTS).rev() {
        for j in c + 1..POINTS {
            left[c] -= matrix[c][j] * left[j];
        }
        left[c] /= matrix[c][c];
    }
    left
}

/// Where in [0, 1] the cubic with those values and slopes at both ends is zero.
#[inline(always)]
fn crossing(from: f64, from_slope: f64, to: f64, to_slope: f64) -> f64 {
    let rise = to - from;
    let (square, cube) =
        (3.0 * rise - 2.0 * from_slope - to_slope, from_slope + to_slope - 2.0 * rise);
    let (mut low, mut high) = (0.0, 1.0);
    let mut s = (from / (from - to)).clamp(0.0, 1.0);
    for _ in 0..20 {
        let value = ((cube * s + square) * s + from_slope) * s + from;
        let slope = (3.0 * cube * s + 2.0 * square) * s + from_slope;
        if (value > 0.0) == (from > 0.0) {
            low = s
        } else {
            high = s
        }
        let newton = s - value / slope;
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        let done = (next - s).abs() < 1e-10;
        s = next;
        if done {
            break;
        }
    }
    s
}

/// `Σ a_k b_k`.
#[inline(always)]
fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dowel;
    use crate::dowel::Ends;

    /// ω, ζ = 0 and `c_n` of a free uniform dowel, 238.9 Hz, 0.85 kg, 0.838 m, struck at the
    /// fraction `at` of its length; all modes and the ball's and the rigid dowel's 1/μ.
    fn dowel(modes: usize, at: f64, ball: f64) -> (Vec<[f64; 2]>, Felt) {
        let mass = 0.850_416;
        let first = dowel::beta_l(Ends::FreeFree, 1);
        let omega = |n: usize| {
            std::f64::consts::TAU * 238.907 * (dowel::beta_l(Ends::FreeFree, n) / first).powi(2)
        };
        let gain = |n: usize| (dowel::wpi_shape(n, at) / dowel::wpi_alpha(n)).powi(2) / mass;
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
                assert!(!(met.reloaded || met.late || met.second || met.endless));
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
