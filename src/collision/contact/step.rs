//! A step of a contact: the force at its points by Newton's method, and the motions under that force.

use faer::c64;

use crate::base::dot;
use crate::collision::contact::collocation::{LANES, POINTS, polynomial, sum};
use crate::collision::contact::force_law::{ForceLaw, Top};
use crate::collision::contact::table::{ForcePiece, StepTable};
use crate::collision::contact::touch::{State, Touch};
use crate::motion::phi::{driven, joined, moments, pushed, shortened};

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

/// The compression in a step as a polynomial of the time over the length, and the beginning of the next step.
#[derive(Debug, Clone, Copy)]
pub struct CompressionPath {
    /// How long the step is (s).
    pub length: f64,
    /// Beginning of the next step, in lengths of this one.
    pub from: f64,
    /// Coefficients (m) of the powers of the time over the length.
    pub powers: [f64; POINTS],
}

impl Step {
    /// The force from the beginning of the step to the next state.
    pub fn until(&self, now: &State, next: &State) -> ForcePiece {
        let length = next.time - now.time;
        let mut powers = shortened(self.powers, length / self.length);
        powers[1] += next.bump;
        powers[2] -= next.bump;
        ForcePiece { start: now.time, length, powers }
    }
}

/// Points of a step that lie ahead.
pub(super) const AHEAD: usize = POINTS - 1;

/// Largest rise of the compression in one round of Newton's method, as a share of it and times the branch's `fine`: the
/// force then grows by `e²`.
const RISE: f64 = 0.2;

/// Factors that move a mode on by a time ([`moments`]).
type ModeAdvance = (c64, [c64; POINTS]);

/// Effect of the force at each point on the compression at each point ahead (m/N).
pub type Coupling = [[f64; POINTS]; AHEAD];

impl<L: ForceLaw> Touch<'_, L> {
    /// The coupling for a step of that table.
    #[inline(always)]
    pub fn coupling(&self, table: &StepTable) -> Coupling {
        let square = table.length * table.length * self.felt.inverse_mass;
        let moves = &table.moves[..self.swings.len()];
        let mut coupling = [[0.0; POINTS]; AHEAD];
        for i in 0..AHEAD {
            let mut parts = [[0.0; LANES]; POINTS];
            for (of, moves) in self.swings.iter().zip(moves) {
                for j in 0..POINTS {
                    for l in 0..LANES {
                        parts[j][l] += moves.kernels[i + 1][j][1][l] * of.weight[l];
                    }
                }
            }
            for j in 0..POINTS {
                coupling[i][j] = square * self.rule.twice[i + 1][j] + sum(parts[j]);
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
        last: Option<&CompressionPath>,
    ) -> (Step, bool) {
        const ROUNDS: usize = 16;
        let length = table.length;
        let fine = self.law.fine(top);
        // On the way back the force is a thousandth of its largest value here, and hardly matters below.
        let knee = top.map_or(0.0, |top| top.compression * (1.0 - 0.7 * fine));
        // The remaining error is the square of this.
        let enough = (1e-2 * self.accuracy.sqrt() * fine).max(4.0 * f64::EPSILON) * self.deepest;
        let free = self.free(table, coupling, now);
        let (mut x, mut f) = (self.foreseen(length, &free, now, top, last), [0.0; AHEAD]);
        let mut by = [f64::NAN; AHEAD];
        let (mut converged, mut found) = (false, false);
        for _ in 0..ROUNDS {
            // Near the last compressions, by the series of the forces.
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
            by = self.newton(coupling, &free, &x, &f, top);
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

    /// Approach of ball and bat (m) at the points ahead without the force there.
    #[inline(always)]
    pub(super) fn free(&self, table: &StepTable, coupling: &Coupling, now: &State) -> [f64; AHEAD] {
        let count = self.swings.len();
        let (moves, memories) = (&table.moves[..count], &now.memories[..count]);
        let mut parts = [[0.0; LANES]; AHEAD];
        for k in 0..count {
            let (w, [a, b]) = (&self.swings[k].weight, &memories[k]);
            for i in 0..AHEAD {
                let [re, im] = &moves[k].turns[i + 1];
                for l in 0..LANES {
                    parts[i][l] += w[l] * (re[l] * b[l] + im[l] * a[l]);
                }
            }
        }
        let mut free = [0.0; AHEAD];
        for i in 0..AHEAD {
            let rigid = now.closing + now.speed * table.length * self.rule.at[i + 1];
            free[i] = rigid - sum(parts[i]) - coupling[i][0] * now.force;
        }
        free
    }

    /// A guess of the compressions (m) ahead: the last step's polynomial continued, but at most the compressions
    /// without force.
    #[inline(always)]
    fn foreseen(
        &self,
        length: f64,
        free: &[f64; AHEAD],
        now: &State,
        top: Option<Top>,
        last: Option<&CompressionPath>,
    ) -> [f64; AHEAD] {
        let most = match top {
            Some(_) => now.compression * (1.0 + RISE * self.law.fine(top)),
            None => f64::INFINITY,
        };
        let mut x = [0.0; AHEAD];
        for i in 0..AHEAD {
            x[i] = match last {
                Some(last) => {
                    let at = last.from + length / last.length * self.rule.at[i + 1];
                    polynomial(&last.powers, at).min(free[i]).min(most)
                }
                None => self.law.share(free[i], self.felt.rest, top, 0.0)[0],
            };
        }
        x
    }

    /// Newton's next step (m) from those compressions with those forces.
    #[inline(always)]
    fn newton(
        &self,
        coupling: &Coupling,
        free: &[f64; AHEAD],
        x: &[f64; AHEAD],
        f: &[f64; AHEAD],
        top: Option<Top>,
    ) -> [f64; AHEAD] {
        let rest = self.felt.rest;
        let (mut matrix, mut left) = ([[0.0; AHEAD]; AHEAD], [0.0; AHEAD]);
        let mut slope = [0.0; AHEAD];
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
        eliminate(&mut matrix, left.map(|left| [left])).map(|[by]| by)
    }

    /// The compression of a step, to continue from its end.
    #[inline(always)]
    pub fn course(&self, step: &Step) -> CompressionPath {
        CompressionPath {
            length: step.length,
            from: 1.0,
            powers: self.rule.through(&step.compression),
        }
    }

    /// Error of the force as a polynomial: the relative impulse of its last term, or the value expected from the two
    /// terms before it, because one term alone may be small by chance.
    #[inline(always)]
    pub fn error_of(&self, step: &Step) -> f64 {
        /// Share of the next term of a geometric series.
        const EXPECTED: f64 = 0.1;
        let [before, next, last] = self.rule.last.map(|part| dot(&part, &step.force).abs());
        let expected = EXPECTED * next * (next / before).min(1.0);
        // The ratio is NaN if both terms are zero; `min` then gives 1.
        last.max(expected) * step.length * self.felt.inverse_mass / self.speed
    }

    /// The state at the end of a step, except compression, force and the loss by damping.
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
        let count = self.swings.len();
        let (moves, before) = (&table.moves[..count], &now.memories[..count]);
        let after = &mut next.memories[..count];
        for k in 0..count {
            let ([p, q], [a, b]) = (&moves[k].turns[i], &before[k]);
            let [mut re, mut im] = [[0.0; LANES]; 2];
            for l in 0..LANES {
                re[l] = p[l] * a[l] - q[l] * b[l];
                im[l] = p[l] * b[l] + q[l] * a[l];
            }
            for j in 0..POINTS {
                let ([p, q], force) = (&moves[k].kernels[i][j], step.force[j]);
                for l in 0..LANES {
                    re[l] += p[l] * force;
                    im[l] += q[l] * force;
                }
            }
            after[k] = [re, im];
        }
    }

    /// The state at a time within a step, without compression.
    #[inline(always)]
    pub fn within(&self, now: &State, step: &Step, time: f64, next: &mut State) {
        self.moved(&self.moves(time), now, step, time, next);
    }

    /// The factors of every mode that [`Self::within`] needs for that time.
    #[inline(always)]
    pub(super) fn moves(&self, time: f64) -> Vec<ModeAdvance> {
        // Not by an iterator: functions that it calls are compiled without the wider vectors.
        let mut moves = vec![ModeAdvance::default(); self.felt.gains.len()];
        for (n, s) in self.modes() {
            moves[n] = moments(s * time);
        }
        moves
    }

    /// The state at a time within a step, from the [`Self::moves`] of that time.
    #[inline(always)]
    pub(super) fn moved(
        &self,
        moves: &[ModeAdvance],
        now: &State,
        step: &Step,
        time: f64,
        next: &mut State,
    ) {
        let powers = shortened(step.powers, time / step.length);
        let [by, faster] = pushed(&powers, time);
        (next.time, next.bump, next.defect) = (now.time + time, 0.0, now.defect);
        (next.impulse, next.force) = (now.impulse + faster, powers.iter().sum());
        next.speed = now.speed - self.felt.inverse_mass * faster;
        next.closing = now.closing + time * now.speed - self.felt.inverse_mass * by;
        next.compression = f64::NAN;
        (next.lost, next.spent) = (now.lost, now.spent);
        for (n, by) in moves.iter().enumerate() {
            next.remember(n, joined(by, now.memory(n), &powers, time));
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
            state.remember(n, driven(*s, state.memory(n), &[force], by));
        }
    }
}

/// Solves for the points ahead, for several right-hand sides at once, by Gauss–Jordan elimination: the few unknowns fit
/// into registers.
#[inline(always)]
pub(super) fn eliminate<const SIDES: usize>(
    matrix: &mut [[f64; AHEAD]; AHEAD],
    mut left: [[f64; SIDES]; AHEAD],
) -> [[f64; SIDES]; AHEAD] {
    for c in 0..AHEAD {
        let inverse = 1.0 / matrix[c][c];
        let (mut row, mut value) = (matrix[c], left[c]);
        for j in 0..AHEAD {
            row[j] *= inverse;
        }
        for j in 0..SIDES {
            value[j] *= inverse;
        }
        for i in 0..AHEAD {
            let factor = if i == c { 0.0 } else { matrix[i][c] };
            for j in 0..AHEAD {
                matrix[i][j] -= factor * row[j];
            }
            for j in 0..SIDES {
                left[i][j] -= factor * value[j];
            }
        }
        (matrix[c], left[c]) = (row, value);
    }
    left
}
