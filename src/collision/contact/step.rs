//! A step of a contact: the force at its points by Newton's method, the motions under that force, and
//! the bump on it that puts the energy right.

use crate::base::linear::dot;
use crate::collision::contact::collocation::{
    LANES, Lobatto, POINTS, Pair, lanes, moments, polynomial, sum, times, total,
};
use crate::collision::contact::force_law::Top;
use crate::collision::contact::touch::{State, Touch};

/// A part of the force in time.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Piece {
    /// When it begins, since the first touch (s).
    pub start: f64,
    /// How long it lasts (s).
    pub length: f64,
    /// Coefficients (N) of the powers of `(t − start)/length`.
    pub powers: [f64; POINTS],
}

impl Piece {
    /// Whether it is less than zero somewhere by more than about a millionth of that force (N), which
    /// no ball's is.
    #[inline(always)]
    pub fn pulls(&self, most: f64) -> bool {
        const LOOKS: u32 = 16;
        /// Between two looks it may be some times less.
        const NOTHING: f64 = 3e-7;
        // Closer towards the ends, where it is flat.
        let force = |k: u32| {
            let at = f64::from(k) / f64::from(LOOKS);
            polynomial(&self.powers, at * at * (3.0 - 2.0 * at))
        };
        (1..LOOKS).any(|k| force(k) < -NOTHING * most)
    }
}

/// What a step of one length does to every mode; numbers of the modes side by side.
#[derive(Debug, Clone)]
pub struct StepTable {
    /// Length of the step (s).
    pub length: f64,
    /// Number of modes, those that fill the lanes included.
    pub modes: usize,
    /// `e^{sh s_i}`, `[i][part][mode]`.
    pub turns: Vec<f64>,
    /// `∫₀^{h s_i} e^{s(h s_i − τ)} L_j dτ`, `[i][j][part][mode]`.
    pub kernels: Vec<f64>,
    /// `∫₀^h e^{s(h − τ)} σ(1 − σ) dτ` with σ = τ/h: the bump over the whole step, `[part][mode]`.
    pub bump: Vec<f64>,
}

impl StepTable {
    /// The table of a step of that length (s) for modes of those `s` (1/s).
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

    /// What a step turns every memory by up to point i: real parts (0) or imaginary parts (1).
    #[inline(always)]
    pub fn turn(&self, i: usize, part: usize) -> &[[f64; LANES]] {
        lanes(&self.turns[(2 * i + part) * self.modes..][..self.modes])
    }

    /// What the force at point j does to every memory at point i: real (0) or imaginary parts (1).
    #[inline(always)]
    pub fn kernel(&self, i: usize, j: usize, part: usize) -> &[[f64; LANES]] {
        lanes(&self.kernels[((i * POINTS + j) * 2 + part) * self.modes..][..self.modes])
    }

    /// What the bump does to every mode, real and imaginary parts.
    #[inline(always)]
    pub fn bumps(&self) -> [&[f64]; 2] {
        self.bump.split_at(self.modes).into()
    }
}

/// A step whose force is known at the points.
#[derive(Debug, Clone, Copy, Default)]
pub struct Step {
    /// Length of the step (s).
    pub length: f64,
    /// Compression at the points (m).
    pub compression: [f64; POINTS],
    /// Force at the points (N).
    pub force: [f64; POINTS],
    /// The force as a polynomial of the time over the length.
    pub powers: [f64; POINTS],
}

/// A step's compression as a polynomial of the time over the length, and where the next step begins.
#[derive(Debug, Clone, Copy)]
pub struct Course {
    /// How long the step is (s).
    pub length: f64,
    /// Where the next step begins, in lengths of this one.
    pub from: f64,
    /// Coefficients (m) of the powers of the time over the length.
    pub powers: [f64; POINTS],
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

/// Points of a step that lie ahead.
const AHEAD: usize = POINTS - 1;

/// What the force at each point does to the compression at each one ahead (m/N).
pub type Coupling = [[f64; POINTS]; AHEAD];

/// A bump may change the impulse by so many times the energy that it puts right, both relative.
const ILL: f64 = 3.0;
/// An energy, relative, that one bump puts right.
const SMALL: f64 = 1e-8;
/// Energies, relative, that shorter steps do not make better.
const ROUND_OFF: f64 = 1e-12;

impl Touch<'_> {
    /// The coupling by a step of that table.
    #[inline(always)]
    pub fn coupling(&self, table: &StepTable) -> Coupling {
        let square = table.length * table.length * self.felt.inverse_mass;
        let mut coupling = [[0.0; POINTS]; AHEAD];
        for i in 0..AHEAD {
            for j in 0..POINTS {
                let (kernel, w) = (table.kernel(i + 1, j, 1), lanes(&self.weights));
                let modes = total(self.chunks(), |k, l| kernel[k][l] * w[k][l]);
                coupling[i][j] = square * self.rule.twice[i + 1][j] + modes;
            }
        }
        coupling
    }

    /// The forces of a step by Newton's method, and whether they are found.
    #[inline(always)]
    pub fn solve(
        &self,
        table: &StepTable,
        coupling: &Coupling,
        now: &State,
        top: Option<Top>,
        last: Option<&Course>,
    ) -> (Step, bool) {
        const ROUNDS: usize = 16;
        /// Share of the compression, times the branch's `fine`, by which a round raises it at most:
        /// the force grows by `e²` then.
        const RISE: f64 = 0.2;
        let (length, rest) = (table.length, self.felt.rest);
        let [w, a, b] = [&self.weights, &now.real, &now.imaginary].map(|v| lanes(v));
        let [mut free, mut x, mut f, mut slope] = [[0.0; AHEAD]; 4];
        let fine = self.law.fine(top);
        // Where on its way back the force is a thousandth, below which it is next to none.
        let knee = top.map_or(0.0, |top| top.compression * (1.0 - 0.7 * fine));
        for i in 0..AHEAD {
            let (re, im) = (table.turn(i + 1, 0), table.turn(i + 1, 1));
            let part = |k: usize, l: usize| w[k][l] * (re[k][l] * b[k][l] + im[k][l] * a[k][l]);
            let modes = total(self.chunks(), part);
            let rigid = now.closing + now.speed * length * self.rule.at[i + 1];
            free[i] = rigid - modes - coupling[i][0] * now.force;
            // The last step's compression goes on as it did, if that is less than without force.
            x[i] = match last {
                Some(last) => {
                    let at = last.from + length / last.length * self.rule.at[i + 1];
                    let most = match top {
                        Some(_) => now.compression * (1.0 + RISE * fine),
                        None => f64::INFINITY,
                    };
                    polynomial(&last.powers, at).min(free[i]).min(most)
                }
                None => self.law.share(free[i], rest, top, 0.0)[0],
            };
        }
        let mut by = [f64::NAN; AHEAD];
        let (mut converged, mut found) = (false, false);
        for _ in 0..ROUNDS {
            // A little way from the last ones by their series.
            let mut before = x;
            for i in 0..AHEAD {
                before[i] -= by[i];
            }
            match self.law.near(before, f, by, top) {
                Some(near) => f = near,
                None => {
                    for i in 0..AHEAD {
                        f[i] = self.law.force(x[i], top)[0];
                    }
                }
            }
            if converged {
                found = true;
                break;
            }
            let (mut matrix, mut left) = ([[0.0; AHEAD]; AHEAD], [0.0; AHEAD]);
            for i in 0..AHEAD {
                slope[i] = self.law.slope(x[i], f[i], top);
            }
            for i in 0..AHEAD {
                left[i] = free[i] - x[i] - rest * f[i];
                for j in 0..AHEAD {
                    left[i] -= coupling[i][j + 1] * f[j];
                    matrix[i][j] = coupling[i][j + 1] * slope[j];
                }
                matrix[i][i] += 1.0 + rest * slope[i];
            }
            by = eliminate(&mut matrix, left);
            // What is left is the square of this.
            let enough =
                (1e-2 * self.accuracy.sqrt() * fine).max(4.0 * f64::EPSILON) * self.deepest;
            converged = true;
            for i in 0..AHEAD {
                if top.is_some() && x[i] > 0.0 {
                    by[i] = by[i].min((RISE * fine * x[i]).max(knee - x[i]));
                }
                x[i] += by[i];
                converged &= by[i].abs() <= enough;
            }
        }
        let [a, b, c, d] = f;
        let force = [now.force, a, b, c, d];
        let [a, b, c, d] = x;
        let compression = [now.compression, a, b, c, d];
        (Step { length, compression, force, powers: self.rule.through(&force) }, found)
    }

    /// The compression of a step, to go on from its end.
    #[inline(always)]
    pub fn course(&self, step: &Step) -> Course {
        Course { length: step.length, from: 1.0, powers: self.rule.through(&step.compression) }
    }

    /// How far the force is from a polynomial: the impulse of its last term, relative, or of what the
    /// two before it lead one to expect, since one term alone may be small by chance.
    #[inline(always)]
    pub fn error_of(&self, step: &Step) -> f64 {
        /// Of what a geometric series would go on with.
        const EXPECTED: f64 = 0.1;
        let [before, next, last] = self.rule.last.map(|part| dot(&part, &step.force).abs());
        let expected = EXPECTED * next * (next / before).min(1.0);
        // A ratio that is not a number is one of two zeros.
        last.max(expected) * step.length * self.felt.inverse_mass / self.speed
    }

    /// The state at the end of a step, but for compression and force.
    #[inline(always)]
    pub fn advance(&self, table: &StepTable, now: &State, step: &Step, next: &mut State) {
        let (h, end) = (table.length, POINTS - 1);
        let push = dot(&self.rule.weights, &step.force);
        (next.time, next.bump, next.defect) = (now.time + h, 0.0, now.defect);
        next.impulse = now.impulse + h * push;
        next.speed = now.speed - h * self.felt.inverse_mass * push;
        let back = h * h * self.felt.inverse_mass * dot(&self.rule.twice[end], &step.force);
        next.closing = now.closing + h * now.speed - back;
        self.memories(table, now, step, end, next);
        (next.compression, next.force) = (step.compression[end], step.force[end]);
        (next.lost, next.spent) = (now.lost, now.spent);
        if self.damped {
            next.lost += self.loss(now, step, h);
        }
    }

    /// The modes' memories at point i of a step.
    #[inline(always)]
    pub fn memories(
        &self,
        table: &StepTable,
        now: &State,
        step: &Step,
        i: usize,
        next: &mut State,
    ) {
        let turn = [table.turn(i, 0), table.turn(i, 1)];
        let mut kernels = [turn; POINTS];
        for (j, kernel) in kernels.iter_mut().enumerate() {
            *kernel = [table.kernel(i, j, 0), table.kernel(i, j, 1)];
        }
        let [a, b] = [&now.real, &now.imaginary].map(|v| lanes(v));
        let (real, imaginary) = (&mut next.real, &mut next.imaginary);
        let (real, imaginary) = (real.as_chunks_mut().0, imaginary.as_chunks_mut::<LANES>().0);
        for k in 0..self.chunks() {
            let [mut re, mut im] = [[0.0; LANES]; 2];
            let (p, q) = (turn[0][k], turn[1][k]);
            for l in 0..LANES {
                re[l] = p[l] * a[k][l] - q[l] * b[k][l];
                im[l] = p[l] * b[k][l] + q[l] * a[k][l];
            }
            for (kernel, force) in kernels.iter().zip(&step.force) {
                let (p, q) = (kernel[0][k], kernel[1][k]);
                for l in 0..LANES {
                    re[l] += p[l] * force;
                    im[l] += q[l] * force;
                }
            }
            (real[k], imaginary[k]) = (re, im);
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
        next.compression = f64::NAN;
        (next.lost, next.spent) = (now.lost, now.spent);
        for (k, part) in part.iter().enumerate() {
            let k = k as f64;
            let (once, twice) =
                (time * part / (k + 1.0), time * time * part / ((k + 1.0) * (k + 2.0)));
            next.force += part;
            next.impulse += once;
            next.speed -= self.felt.inverse_mass * once;
            next.closing -= self.felt.inverse_mass * twice;
        }
        for (n, s) in self.modes() {
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
        (state.compression, state.force) = (f64::NAN, polynomial(&step.powers, time / step.length));
        for (n, s) in self.modes() {
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
    /// returns by how much it was not, relative. Where the compression is about to turn or hardly a
    /// force is left none does work: None, for a shorter step, if the bump would be more than twice
    /// the `most` force or change the impulse by more than the `slight` share and by more than the
    /// energy was off by.
    #[inline(always)]
    pub fn correct(
        &self,
        next: &mut State,
        length: f64,
        bump: [&[f64]; 2],
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
            let [m, a, b, square] = [&self.masses, self.decay, self.swing, self.square].map(lanes);
            let [re, im] = [&next.real, &next.imaginary].map(|v| lanes(v));
            let ([p, q], w) = (bump.map(lanes), lanes(&self.weights));
            let [mut moved, mut slope] = [[0.0; LANES]; 2];
            for k in 0..self.chunks() {
                for l in 0..LANES {
                    let rate = a[k][l] * im[k][l] + b[k][l] * re[k][l];
                    let other = a[k][l] * q[k][l] + b[k][l] * p[k][l];
                    let both = rate * other + square[k][l] * im[k][l] * q[k][l];
                    moved[l] -= w[k][l] * q[k][l];
                    slope[l] += m[k][l] * both;
                }
            }
            let moved = closing + sum(moved);
            let slope = next.speed * speed / self.felt.inverse_mass + sum(slope);
            let size = -defect / (slope + next.force * moved);
            // Where the compression does not change no force does work.
            let kick = (size * speed / self.speed).abs();
            let ill = kick > slight.max(ILL * defect.abs() / self.energy);
            if size.is_nan() || size.abs() > 2.0 * most || ill {
                if off > ROUND_OFF {
                    return None;
                }
                break;
            }
            next.speed += size * speed;
            next.closing += size * closing;
            next.impulse += size * length / 6.0;
            next.bump += size;
            for (memory, bump) in [&mut next.real, &mut next.imaginary].into_iter().zip(bump) {
                for (part, bump) in memory.iter_mut().zip(bump) {
                    *part += size * bump;
                }
            }
            // What is left is the square of this, and seen with the next step's.
            if defect.abs() <= SMALL * self.energy {
                self.settle(next, top);
                next.defect = 0.0;
                break;
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
        let damped = self.modes().filter(|(_, s)| s[0] != 0.0);
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

/// Solves for the points ahead, by Gauss's and Jordan's method: so few unknowns fit the registers.
#[inline(always)]
fn eliminate(matrix: &mut [[f64; AHEAD]; AHEAD], mut left: [f64; AHEAD]) -> [f64; AHEAD] {
    for c in 0..AHEAD {
        let inverse = 1.0 / matrix[c][c];
        let row = matrix[c].map(|part| part * inverse);
        let value = left[c] * inverse;
        for i in 0..AHEAD {
            let factor = if i == c { 0.0 } else { matrix[i][c] };
            for j in 0..AHEAD {
                matrix[i][j] -= factor * row[j];
            }
            left[i] -= factor * value;
        }
        (matrix[c], left[c]) = (row, value);
    }
    left
}
