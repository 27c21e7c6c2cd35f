//! How the impulse changes with the bat: the transpose of the derivative in [`crate::collision::contact::tangent`]. One
//! pass back through the steps serves any number of other bats.
//!
//! ```text
//! δx = M⁻¹ r,  M = 1 + (G + C) S     r what the change of the motion and q make of x, S the slopes of the force
//! λ_before = Pᵀ λ_after + Rᵀ ν,      ν = M⁻ᵀ S Kᵀ λ_after
//! ∂J/∂(c_n/ω_n) = −Σ ν_i Im v_n(t_i),  ∂J/∂C = −Σ ν_i F_i
//! ```
//!
//! P is the effect of the step on a motion without force, K that of the forces at its points, and R the effect of the
//! motion before on r.
//!
//! # Source
//!
//! Adjoints of a discrete motion: E. Hairer, S. P. Nørsett, G. Wanner, Solving Ordinary Differential Equations I (1993),
//! section I.14, transposed.

use crate::collision::contact::abreast::places::{Abreast, Kept, Turned, Walked};
use crate::collision::contact::abreast::solve::eliminate;
use crate::collision::contact::collocation::{LANES, POINTS};
use crate::collision::contact::each::Each;
use crate::collision::contact::step::AHEAD;
use crate::collision::contact::table::StepTable;
use crate::collision::contact::touch::DrivingPoint;

/// Derivatives of the impulse by the state at a moment; that by the impulse so far is 1.
#[derive(Default)]
struct Dual<const W: usize> {
    pub closing: Each<W>,
    pub speed: Each<W>,
    pub force: Each<W>,
    /// By the largest compression, on the way back.
    pub top: Each<W>,
    pub memories: Vec<[Each<W>; 2]>,
}

/// Derivatives of the impulse by the properties that differ: `c/ω` of the last modes and the flexibility.
pub(super) struct Gradient<const W: usize> {
    pub weights: Vec<Each<W>>,
    pub rest: Each<W>,
    /// By the closing speed, times that speed.
    pub speed: Each<W>,
}

impl<const W: usize> Abreast<'_, W> {
    /// The derivatives of the impulse by the bat's properties, from the last step of every place back to the first.
    /// `lasts` limits the steps that count.
    #[inline(always)]
    pub(super) fn gradient(&self, lasts: Each<W>) -> Gradient<W> {
        let weights = vec![Each::default(); self.differ];
        let mut gradient = Gradient { weights, rest: Each::default(), speed: Each::default() };
        let mut dual =
            Dual { memories: vec![Default::default(); self.weights.len()], ..Dual::default() };
        for (step, kept) in self.kept.iter().enumerate().rev() {
            let before = Each::all(step as f64).below(lasts);
            match kept {
                Kept::Step(walked) => {
                    self.turn_back(walked, before, &mut dual, &mut gradient);
                    self.step_back(walked, walked.taken.and(before), &mut dual, &mut gradient);
                }
                Kept::Flight { which, time, parted } => {
                    let none = Each::default();
                    dual.force = which.choose(none, dual.force);
                    dual.top = parted.choose(none, dual.top);
                    self.fly_back(before.choose(*time, none), &mut dual);
                }
            }
        }
        gradient.speed = dual.speed * self.speed;
        gradient
    }

    /// The dual before a flight.
    #[inline(always)]
    fn fly_back(&self, time: Each<W>, dual: &mut Dual<W>) {
        dual.speed += time * dual.closing;
        for n in 0..self.weights.len() {
            let ([sin, cos], [re, im]) = ((time * self.omegas[n]).sin_cos(), dual.memories[n]);
            dual.memories[n] = [cos * re + sin * im, cos * im - sin * re];
        }
    }

    /// The dual before a turn, in which `δx_m = (δz + Σ δy + q)/(1 + C S)` and `δF = S δx_m`.
    #[inline(always)]
    fn turn_back(
        &self,
        walked: &Walked<W>,
        before: Each<W>,
        dual: &mut Dual<W>,
        gradient: &mut Gradient<W>,
    ) {
        let Some(Turned { which, slope, force, memories, .. }) = &walked.turned else { return };
        let which = which.and(before);
        let both = (dual.top + *slope * dual.force) / (self.rest * *slope + 1.0);
        let both = which.choose(both, Each::default());
        dual.closing += both;
        for n in 0..self.weights.len() {
            dual.memories[n][1] -= self.weights[n] * both;
        }
        for k in 0..self.differ {
            gradient.weights[k] -= both * memories[k];
        }
        gradient.rest -= both * *force;
        dual.top = which.choose(Each::default(), dual.top);
        dual.force = which.choose(Each::default(), dual.force);
    }

    /// The dual before a step; adds the step's part of the gradient.
    #[inline(always)]
    fn step_back(
        &self,
        walked: &Walked<W>,
        taken: Each<W>,
        dual: &mut Dual<W>,
        gradient: &mut Gradient<W>,
    ) {
        let Walked { level, top, slope, force, points, turned, .. } = walked;
        let rule = &self.collider.rule;
        let (table, coupling) = (self.collider.table(*level), self.coupled(*level));
        let by = self.by_forces(table, turned.as_ref(), dual);
        // By the compressions, and by where these would be without the forces.
        let mut by_top = [Each::default(); POINTS];
        if let Some([top, _]) = *top {
            for j in 1..POINTS {
                by_top[j] = (self.exponent - self.unloading) * force[j] / top;
            }
        }
        let (mut matrix, mut left) = ([[Each::default(); AHEAD]; AHEAD], [Each::default(); AHEAD]);
        for i in 0..AHEAD {
            left[i] = slope[i] * by[i + 1];
            for j in 0..AHEAD {
                matrix[i][j] = coupling[j][i + 1] * slope[i];
            }
            matrix[i][i] += self.rest * slope[i] + 1.0;
        }
        let mut free = eliminate(&mut matrix, left);
        let (mut all, mut later) = (Each::default(), Each::default());
        let (mut start, mut top) = (by[0], dual.top);
        for i in 0..AHEAD {
            free[i] = taken.choose(free[i], Each::default());
            all += free[i];
            later += free[i] * (table.length * rule.at[i + 1]);
            start -= free[i] * coupling[i][0];
            let mut pressed = self.rest * by_top[i + 1];
            for j in 1..POINTS {
                pressed += coupling[i][j] * by_top[j];
            }
            top += by_top[i + 1] * by[i + 1] - free[i] * pressed;
            for k in 0..self.differ {
                gradient.weights[k] -= free[i] * points[k][i];
            }
            gradient.rest -= free[i] * force[i + 1];
        }
        self.memories_back(
            table,
            turned.as_ref(),
            [taken, free[0], free[1], free[2], free[3]],
            dual,
        );
        let whole = Each::all(table.length);
        let length =
            turned.as_ref().map_or(whole, |turned| turned.which.choose(turned.time, whole));
        dual.speed += taken.choose(length * dual.closing + later, Each::default());
        dual.closing += all;
        dual.force = taken.choose(start, dual.force);
        dual.top = taken.choose(top, dual.top);
    }

    /// The dual of the memories before a step at the places that took it, given the dual of the motion without the
    /// forces at the points ahead.
    #[inline(always)]
    fn memories_back(
        &self,
        table: &StepTable,
        turned: Option<&Turned<W>>,
        [taken, free @ ..]: [Each<W>; POINTS],
        dual: &mut Dual<W>,
    ) {
        for n in 0..self.weights.len() {
            let (moves, l, [re, im]) = (&table.moves[n / LANES], n % LANES, dual.memories[n]);
            let [p, q] = &moves.turns[POINTS - 1];
            let [mut cos, mut sin] = [p[l], q[l]].map(Each::all);
            if let Some(turned) = turned {
                let [short_cos, short_sin] = turned.moves[n].0;
                cos = turned.which.choose(short_cos, cos);
                sin = turned.which.choose(short_sin, sin);
            }
            let [mut to_re, mut to_im] = [Each::default(); 2];
            for i in 0..AHEAD {
                let [p, q] = &moves.turns[i + 1];
                to_re += free[i] * q[l];
                to_im += free[i] * p[l];
            }
            let before = [
                cos * re + sin * im - self.weights[n] * to_re,
                cos * im - sin * re - self.weights[n] * to_im,
            ];
            for part in 0..2 {
                dual.memories[n][part] = taken.choose(before[part], dual.memories[n][part]);
            }
        }
    }

    /// The dual of the forces at the points of a step, up to its end or to the largest compression.
    #[inline(always)]
    fn by_forces(
        &self,
        table: &StepTable,
        turned: Option<&Turned<W>>,
        dual: &Dual<W>,
    ) -> [Each<W>; POINTS] {
        let (rule, h, end) = (&self.collider.rule, table.length, POINTS - 1);
        let faster = Each::all(1.0) - dual.speed * self.inverse_mass;
        let nearer = dual.closing * self.inverse_mass;
        let mut by = [Each::default(); POINTS];
        for n in 0..self.weights.len() {
            let (moves, l, [re, im]) = (&table.moves[n / LANES], n % LANES, dual.memories[n]);
            for j in 0..POINTS {
                let [p, q] = &moves.kernels[end][j];
                by[j] += re * p[l] + im * q[l];
            }
        }
        for j in 0..POINTS {
            by[j] += faster * (h * rule.weights[j]) - nearer * (h * h * rule.twice[end][j]);
        }
        if let Some(turned) = turned {
            let short = self.by_forces_to(turned, h, [faster, nearer], &dual.memories);
            for j in 0..POINTS {
                by[j] = turned.which.choose(short[j], by[j]);
            }
        }
        by[end] += dual.force;
        by
    }

    /// The dual of the forces at the points of a step that ends at the largest compression.
    #[inline(always)]
    fn by_forces_to(
        &self,
        turned: &Turned<W>,
        whole: f64,
        [faster, nearer]: [Each<W>; 2],
        memories: &[[Each<W>; 2]],
    ) -> [Each<W>; POINTS] {
        let Turned { time, moves, .. } = turned;
        let (mut powers, mut by, mut scale) =
            ([Each::default(); POINTS], [Each::default(); POINTS], Each::all(1.0));
        for n in 0..self.weights.len() {
            for k in 0..POINTS {
                let [p, q] = moves[n].1[k];
                powers[k] += memories[n][0] * p + memories[n][1] * q;
            }
        }
        for k in 0..POINTS {
            let next = (k + 1) as f64;
            powers[k] += faster * (1.0 / next) - nearer * *time * (1.0 / (next * (next + 1.0)));
            let power = powers[k] * *time * scale;
            for j in 0..POINTS {
                by[j] += power * self.collider.rule.powers[j][k];
            }
            scale = scale * (*time / whole);
        }
        by
    }

    /// The change of the impulse (N s) at a place for another bat, to first order.
    pub(super) fn change(&self, gradient: &Gradient<W>, other: &DrivingPoint, l: usize) -> f64 {
        let first = self.weights.len() - self.differ;
        let mut change = (other.rest - self.rest.0[l]) * gradient.rest.0[l];
        for (k, by) in gradient.weights.iter().enumerate() {
            let gain = other.gains.get(first + k).copied().unwrap_or(0.0);
            change += (gain / self.omegas[first + k] - self.weights[first + k].0[l]) * by.0[l];
        }
        change
    }
}
