//! The forces of a step by Newton's method, and the motions under them.

use crate::collision::contact::abreast::places::{Abreast, Coupling, Motion};
use crate::collision::contact::collocation::{LANES, POINTS};
use crate::collision::contact::each::Each;
use crate::collision::contact::step::AHEAD;
use crate::collision::contact::table::StepTable;

/// A step's forces.
pub(super) struct SolvedStep<const W: usize> {
    pub x: [Each<W>; AHEAD],
    pub force: [Each<W>; POINTS],
    pub slope: [Each<W>; AHEAD],
    pub found: Each<W>,
}

impl<const W: usize> Abreast<'_, W> {
    #[inline(always)]
    pub(super) fn coupling(&self, table: &StepTable) -> Coupling<W> {
        let square = self.inverse_mass * (table.length * table.length);
        let mut coupling = [[Each::default(); POINTS]; AHEAD];
        for i in 0..AHEAD {
            for j in 0..POINTS {
                coupling[i][j] = square * self.collider.rule.twice[i + 1][j];
            }
        }
        for n in 0..self.weights.len() {
            let (moves, l) = (&table.moves[n / LANES], n % LANES);
            for i in 0..AHEAD {
                for j in 0..POINTS {
                    coupling[i][j] += self.weights[n] * moves.kernels[i + 1][j][1][l];
                }
            }
        }
        coupling
    }

    #[inline(always)]
    pub(super) fn free(
        &self,
        table: &StepTable,
        coupling: &Coupling<W>,
        state: &Motion<W>,
    ) -> [Each<W>; AHEAD] {
        let mut parts = [Each::default(); AHEAD];
        for n in 0..self.weights.len() {
            let (moves, l) = (&table.moves[n / LANES], n % LANES);
            let [re, im] = state.memories[n];
            let (re, im) = (self.weights[n] * re, self.weights[n] * im);
            for i in 0..AHEAD {
                let [p, q] = &moves.turns[i + 1];
                parts[i] += im * p[l] + re * q[l];
            }
        }
        let mut free = [Each::default(); AHEAD];
        for i in 0..AHEAD {
            let rigid = state.closing + state.speed * (table.length * self.collider.rule.at[i + 1]);
            free[i] = rigid - parts[i] - coupling[i][0] * state.force;
        }
        free
    }

    #[inline(always)]
    pub(super) fn through(&self, values: &[Each<W>; POINTS]) -> [Each<W>; POINTS] {
        let mut sum = [Each::default(); POINTS];
        for j in 0..POINTS {
            for k in 0..POINTS {
                sum[k] += values[j] * self.collider.rule.powers[j][k];
            }
        }
        sum
    }

    /// The forces of a step by Newton's method; idle places need not converge.
    #[inline(always)]
    pub(super) fn solve(
        &self,
        table: &StepTable,
        coupling: &Coupling<W>,
        idle: Each<W>,
    ) -> SolvedStep<W> {
        const ROUNDS: usize = 16;
        /// Largest rise of the compression in one round on the way back, as a share of it and times `fine`.
        const RISE: f64 = 0.2;
        let fine = (Each::all(10.0) / self.power()).min(Each::all(1.0));
        let knee = self.top.map(|[x, _]| x * (Each::all(1.0) - fine * 0.7));
        let enough = (fine * (1e-2 * self.accuracy.sqrt())).max(Each::all(4.0 * f64::EPSILON))
            * self.deepest;
        let free = self.free(table, coupling, &self.now);
        let most = match self.top {
            Some(_) => self.now.compression * (fine * RISE + 1.0),
            None => Each::all(f64::INFINITY),
        };
        let mut x = self.foreseen(table.length, &free, most);
        let (mut f, mut slope) = (self.forces(x), [Each::default(); AHEAD]);
        let (mut converged, mut found) = (idle, Each::default());
        for _ in 0..ROUNDS {
            for i in 0..AHEAD {
                slope[i] = self.slope(x[i], f[i]);
            }
            if converged.everywhere() {
                found = Each::all(1.0);
                break;
            }
            found = converged;
            let mut by = self.newton(coupling, &free, [&x, &f, &slope]);
            let mut near = Each::all(1.0);
            for i in 0..AHEAD {
                if let Some(knee) = knee {
                    let highest = (fine * x[i] * RISE).max(knee - x[i]);
                    by[i] = Each::default().below(x[i]).choose(by[i].min(highest), by[i]);
                }
                by[i] = converged.choose(Each::default(), by[i]);
                x[i] += by[i];
                near = near.and(by[i].abs().within(enough));
            }
            f = self.near(x, f, by);
            converged = converged.or(near);
        }
        let [a, b, c, d] = f;
        SolvedStep { x, force: [self.now.force, a, b, c, d], slope, found }
    }

    /// A guess of the compressions (m) ahead: the last step's polynomial continued, but at most the compressions
    /// without force.
    #[inline(always)]
    fn foreseen(&self, length: f64, free: &[Each<W>; AHEAD], most: Each<W>) -> [Each<W>; AHEAD] {
        let (mut x, ([last, from], powers)) = (*free, &self.last);
        for i in 0..AHEAD {
            let at = *from + Each::all(length * self.collider.rule.at[i + 1]) / *last;
            let mut sum = powers[POINTS - 1];
            for k in (0..POINTS - 1).rev() {
                sum = sum * at + powers[k];
            }
            x[i] = self.known.choose(sum.min(free[i]), free[i]).min(most);
        }
        x
    }

    /// Newton's next step (m) from those compressions, forces and slopes.
    #[inline(always)]
    fn newton(
        &self,
        coupling: &Coupling<W>,
        free: &[Each<W>; AHEAD],
        [x, f, slope]: [&[Each<W>; AHEAD]; 3],
    ) -> [Each<W>; AHEAD] {
        let (mut matrix, mut left) = ([[Each::default(); AHEAD]; AHEAD], *free);
        for i in 0..AHEAD {
            left[i] = left[i] - x[i] - self.rest * f[i];
            for j in 0..AHEAD {
                left[i] -= coupling[i][j + 1] * f[j];
                matrix[i][j] = coupling[i][j + 1] * slope[j];
            }
            matrix[i][i] += self.rest * slope[i] + 1.0;
        }
        eliminate(&mut matrix, left)
    }

    #[inline(always)]
    pub(super) fn error_of(&self, force: &[Each<W>; POINTS], length: f64) -> Each<W> {
        const EXPECTED: f64 = 0.1;
        let mut parts = [Each::default(); 3];
        for k in 0..3 {
            for j in 0..POINTS {
                parts[k] += force[j] * self.collider.rule.last[k][j];
            }
            parts[k] = parts[k].abs();
        }
        let [before, next, last] = parts;
        let tiny = Each::all(f64::MIN_POSITIVE);
        let expected = next * (next / before.max(tiny)).min(Each::all(1.0)) * EXPECTED;
        last.max(expected) * self.inverse_mass * length / self.speed
    }

    #[inline(always)]
    pub(super) fn advance(
        &mut self,
        table: &StepTable,
        SolvedStep { x, force, .. }: &SolvedStep<W>,
    ) {
        let (h, end) = (table.length, POINTS - 1);
        let (mut push, mut back) = (Each::default(), Each::default());
        for j in 0..POINTS {
            push += force[j] * self.collider.rule.weights[j];
            back += force[j] * self.collider.rule.twice[end][j];
        }
        let (now, next) = (&self.now, &mut self.next);
        next.time = now.time + h;
        next.impulse = now.impulse + push * h;
        next.speed = now.speed - self.inverse_mass * push * h;
        next.closing = now.closing + now.speed * h - self.inverse_mass * back * (h * h);
        for n in 0..self.weights.len() {
            let (moves, l) = (&table.moves[n / LANES], n % LANES);
            let ([p, q], [a, b]) = (&moves.turns[end], now.memories[n]);
            let mut re = a * p[l] - b * q[l];
            let mut im = b * p[l] + a * q[l];
            for j in 0..POINTS {
                let [p, q] = &moves.kernels[end][j];
                re += force[j] * p[l];
                im += force[j] * q[l];
            }
            next.memories[n] = [re, im];
        }
        (next.compression, next.force) = (x[AHEAD - 1], force[end]);
    }
}

#[inline(always)]
pub(super) fn eliminate<const W: usize>(
    matrix: &mut [[Each<W>; AHEAD]; AHEAD],
    mut left: [Each<W>; AHEAD],
) -> [Each<W>; AHEAD] {
    for c in 0..AHEAD {
        let inverse = Each::all(1.0) / matrix[c][c];
        for j in c..AHEAD {
            matrix[c][j] = matrix[c][j] * inverse;
        }
        left[c] = left[c] * inverse;
        for i in c + 1..AHEAD {
            let factor = matrix[i][c];
            for j in c..AHEAD {
                matrix[i][j] -= factor * matrix[c][j];
            }
            left[i] -= factor * left[c];
        }
    }
    for c in (0..AHEAD).rev() {
        for i in 0..c {
            left[i] -= matrix[i][c] * left[c];
        }
    }
    left
}
