//! A step of a contact: the force at its points by Newton's method, the motions under that force, and
//! the bump on it that puts the energy right.

use crate::collision::collocation::{Lobatto, POINTS, Pair, moments, polynomial, times};
use crate::collision::force_law::Top;
use crate::collision::touch::{State, Touch, dot};

/// A part of the force in time.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Piece {
    /// Since the first touch, and how long it lasts (s).
    pub start: f64,
    pub length: f64,
    /// Coefficients (N) of the powers of `(t − start)/length`.
    pub powers: [f64; POINTS],
}

/// What a step of one length does to every mode; numbers of the modes side by side.
#[derive(Debug, Clone)]
pub struct Table {
    pub length: f64,
    pub modes: usize,
    /// `e^{sh s_i}`, `[i][part][mode]`.
    pub turns: Vec<f64>,
    /// `∫₀^{h s_i} e^{s(h s_i − τ)} L_j dτ`, `[i][j][part][mode]`.
    pub kernels: Vec<f64>,
    /// The same of the bump `s(1 − s)` over the whole step, `[part][mode]`.
    pub bump: Vec<f64>,
}

impl Table {
    pub fn new(rule: &Lobatto, poles: &[Pair], length: f64) -> Self {
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
    pub fn turn(&self, i: usize, part: usize, count: usize) -> &[f64] {
        &self.turns[(2 * i + part) * self.modes..][..count]
    }

    #[inline(always)]
    pub fn kernel(&self, i: usize, j: usize, part: usize, count: usize) -> &[f64] {
        &self.kernels[((i * POINTS + j) * 2 + part) * self.modes..][..count]
    }
}

/// A step whose force is known at the points.
#[derive(Debug, Clone, Copy, Default)]
pub struct Step {
    pub length: f64,
    pub compression: [f64; POINTS],
    pub force: [f64; POINTS],
    /// Both as polynomials of the time over the length.
    pub powers: [f64; POINTS],
    pub course: [f64; POINTS],
}

impl Step {
    /// The force from the step's beginning to a moment in it.
    pub fn until(&self, now: &State, next: &State) -> Piece {
        let length = next.time - now.time;
        let (mut powers, mut scale) = (self.powers, 1.0);
        for power in &mut powers {
            *power *= scale;
            scale *= length / self.length;
        }
        powers[1] += next.bump;
        powers[2] -= next.bump;
        Piece { start: now.time, length, powers }
    }
}

pub type Coupling = [[f64; POINTS]; POINTS];

/// A bump may change the impulse by so many times the energy that it puts right, both relative.
const ILL: f64 = 3.0;
/// Energies, relative, that shorter steps do not make better.
const ROUND_OFF: f64 = 1e-12;

impl Touch<'_> {
    /// What the force at each point does to the compression at each.
    #[inline(always)]
    pub fn coupling(&self, table: &Table) -> Coupling {
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
    pub fn solve(
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
            // The last step's compression goes on as it did.
            x[i] = match last {
                Some(last) => {
                    polynomial(&last.course, 1.0 + length / last.length * self.rule.at[i])
                }
                None => self.law.share(free[i], rest, top, 0.0)[0],
            };
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
            if largest <= 1e-2 * self.accuracy.sqrt() * self.deepest {
                converged = true;
                break;
            }
        }
        let [powers, course] = [f, x].map(|values| self.rule.through(&values));
        (Step { length, compression: x, force: f, powers, course }, converged)
    }

    /// How far the force is from a polynomial: the impulse of its last term, relative.
    #[inline(always)]
    pub fn error_of(&self, step: &Step) -> f64 {
        let last: f64 = step.force.iter().zip(&self.rule.last).map(|(f, l)| f * l).sum();
        last.abs() * step.length * self.felt.inverse_mass / self.speed
    }

    /// The state at the end of a step, but for compression and force.
    #[inline(always)]
    pub fn advance(&self, table: &Table, now: &State, step: &Step, next: &mut State) {
        let (h, end) = (table.length, POINTS - 1);
        let push = dot(&self.rule.weights, &step.force);
        (next.time, next.bump, next.defect) = (now.time + h, 0.0, now.defect);
        next.impulse = now.impulse + h * push;
        next.speed = now.speed - h * self.felt.inverse_mass * push;
        let back = h * h * self.felt.inverse_mass * dot(&self.rule.twice[end], &step.force);
        next.closing = now.closing + h * now.speed - back;
        self.memories(table, now, step, end, next);
        (next.compression, next.force) = (step.compression[end], step.force[end]);
        next.lost = now.lost;
        if self.damped {
            next.lost += self.loss(now, step, h);
        }
    }

    /// The modes' memories at point i of a step.
    #[inline(always)]
    pub fn memories(&self, table: &Table, now: &State, step: &Step, i: usize, next: &mut State) {
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
    pub fn within(&self, now: &State, step: &Step, time: f64, next: &mut State) {
        let mut part = [0.0; POINTS];
        let mut scale = 1.0;
        for (part, power) in part.iter_mut().zip(&step.powers) {
            *part = power * scale;
            scale *= time / step.length;
        }
        (next.time, next.bump, next.defect) = (now.time + time, 0.0, now.defect);
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
    pub fn nudge(&self, state: &mut State, step: &Step, time: f64, by: f64) {
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

    /// Adds a bump to the force of a step of that length, so that the energy is right again;
    /// returns by how much it was not, relative. Where the compression is about to turn hardly a force
    /// does work: None if the bump would then change the impulse by more than the `slight` share and
    /// by more than the energy was off by, and a shorter step is wanted.
    #[inline(always)]
    pub fn correct(
        &self,
        next: &mut State,
        length: f64,
        bump: impl Fn(usize) -> Pair,
        [most, slight]: [f64; 2],
        top: Option<Top>,
    ) -> Option<f64> {
        let mut off = 0.0;
        for round in 0..4 {
            self.settle(next, top);
            let defect = self.whole_energy(next, top) - self.energy;
            if round == 0 {
                off = (defect - next.defect).abs() / self.energy;
            }
            next.defect = defect;
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
            let kick = (size * speed / self.speed).abs();
            if kick > slight.max(ILL * defect.abs() / self.energy) {
                if off > ROUND_OFF {
                    return None;
                }
                break;
            }
            next.speed += size * speed;
            next.closing += size * closing;
            next.impulse += size * length / 6.0;
            next.bump += size;
            for n in 0..self.poles.len() {
                let b = bump(n);
                next.real[n] += size * b[0];
                next.imaginary[n] += size * b[1];
            }
        }
        Some(off)
    }

    /// What damping takes from the beginning of a step to a time in it, `∫ Σ 2ζω m_n q′² dt` (J).
    pub fn loss(&self, now: &State, step: &Step, time: f64) -> f64 {
        let (mut force, mut scale) = (step.powers, time);
        for power in &mut force {
            *power *= scale;
            scale *= time / step.length;
        }
        let of_mode = |(n, s): (usize, &Pair)| {
            let memory = [now.real[n], now.imaginary[n]];
            -2.0 * s[0] * self.weights[n] / s[1] * time * self.square(*s, time, memory, &force)
        };
        let damped = self.poles.iter().enumerate().filter(|(_, s)| s[0] != 0.0);
        damped.map(of_mode).sum()
    }

    /// `∫₀¹ (Im sv)²` of a mode with that memory under `Σ f_k τ^k`, the force times the time.
    ///
    /// A slow mode by Lobatto's rule; of the others `v = A e^{zτ} + P(τ)`, all products of which have
    /// closed integrals.
    pub fn square(&self, s: Pair, time: f64, memory: Pair, force: &[f64; POINTS]) -> f64 {
        const SLOW: f64 = 0.25;
        let z = [s[0] * time, s[1] * time];
        let size = z[0] * z[0] + z[1] * z[1];
        if size < SLOW {
            let rate = |at: f64| {
                let (whole, all) = moments::<POINTS>([z[0] * at, z[1] * at]);
                let mut v = times(whole, memory);
                let mut power = at;
                for (f, moment) in force.iter().zip(&all) {
                    v = [v[0] + f * power * moment[0], v[1] + f * power * moment[1]];
                    power *= at;
                }
                times(s, v)[1]
            };
            let points = self.rule.at.iter().zip(&self.rule.weights);
            return points.map(|(at, weight)| weight * rate(*at).powi(2)).sum();
        }
        let inverse = [z[0] / size, -z[1] / size];
        // P′ = zP + f from the highest power down; Q = Im sP.
        let (mut above, mut part, mut q) = ([0.0; 2], [0.0; 2], [0.0; POINTS]);
        for k in (0..POINTS).rev() {
            part = times(inverse, [above[0] - force[k], above[1]]);
            q[k] = times(s, part)[1];
            above = [k as f64 * part[0], k as f64 * part[1]];
        }
        let b = times(s, [memory[0] - part[0], memory[1] - part[1]]);
        // (Im B e^{zτ})² = (|B|² e^{2aτ} − Re B² e^{2zτ})/2, a the real part of z.
        let (growth, turned) = ((2.0 * z[0]).exp_m1(), moments::<1>([2.0 * z[0], 2.0 * z[1]]).1[0]);
        let all = (b[0] * b[0] + b[1] * b[1]) * growth / (2.0 * z[0]);
        let mut sum = 0.5 * (all - times(times(b, b), turned)[0]);
        // ∫ τ^k e^{zτ} from k = 0 up.
        let (whole, first) = moments::<1>(z);
        let mut moment = first[0];
        for k in 0..POINTS {
            sum += 2.0 * q[k] * times(b, moment)[1];
            sum += (0..POINTS).map(|j| q[k] * q[j] / (j + k + 1) as f64).sum::<f64>();
            let next = (k + 1) as f64;
            moment = times(inverse, [whole[0] - next * moment[0], whole[1] - next * moment[1]]);
        }
        sum
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
