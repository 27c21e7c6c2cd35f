//! The first-order change of the impulse if the bat's gains and flexibility were slightly different, computed together
//! with the encounter, on its own steps.
//!
//! For a bat with `c_n + δc_n` and `C + δC` the force changes by δF and the compression by δx:
//!
//! ```text
//! δx + C δF = δz + Σ δy_n + q,    q = Σ y_n δc_n/c_n − F δC
//! δz″ = −δF/μ                     and δy_n follows δF as y_n follows F
//! δF = ∂F/∂x δx                   on the way to the largest compression x_m
//! δF = ∂F/∂x δx + ∂F/∂x_m δx_m    on the way back, with the δx_m = δx of the moment it turned
//! ```
//!
//! The moments of turning, leaving, touching again and being compressed again shift too. This is a second-order effect:
//! the rate of x is 0 at the first of these, and the force is equal on both sides of all others.
//!
//! # Source
//!
//! Derivatives of a motion by its parameters: E. Hairer, S. P. Nørsett, G. Wanner, Solving Ordinary
//! Differential Equations I (1993), section I.14.

use crate::base::dot;
use crate::collision::contact::collocation::{LANES, Lanes, POINTS, sum};
use crate::collision::contact::events::Event;
use crate::collision::contact::force_law::{ForceLaw, Top};
use crate::collision::contact::step::{AHEAD, Coupling, Step, eliminate};
use crate::collision::contact::table::StepTable;
use crate::collision::contact::touch::{DrivingPoint, State, Swings, Touch};

/// A varied bat, and how the motion of ball and bat differs for it.
pub(super) struct Tangent {
    /// `δc/ω_d` of every mode (s/kg).
    weights: Vec<Lanes>,
    /// δC (m/N).
    rest: f64,
    /// δx_m (m), where the ball is on its way back.
    top: f64,
    /// `q` (m) at the points ahead of a step.
    given: [f64; AHEAD],
    now: State,
    next: State,
}

impl Tangent {
    /// Change of the impulse (N s) by the moment when the ball leaves.
    pub(super) fn part(&mut self) -> f64 {
        (self.now.force, self.top) = (0.0, 0.0);
        self.now.impulse
    }

    /// The difference now, while no force acts.
    pub(super) fn free(&mut self) -> &mut State {
        self.now.force = 0.0;
        &mut self.now
    }
}

/// A step that was taken, to its end or to the event in it.
pub(super) struct Walked<'a> {
    pub now: &'a State,
    pub next: &'a State,
    /// The largest compression, if the ball was on its way back from it.
    pub top: Option<Top>,
    pub table: &'a StepTable,
    pub coupling: &'a Coupling,
    pub step: &'a Step,
    pub event: Option<Event>,
}

impl<L: ForceLaw> Touch<'_, L> {
    /// The difference for another bat, with at most as many modes, at the moment of the first touch.
    pub(super) fn tangent(&self, other: &DrivingPoint) -> Tangent {
        let mut gains = other.gains.iter().copied().chain(std::iter::repeat(0.0));
        let mut change = |weight: f64, swing: f64| gains.next().map_or(0.0, |c| c / swing - weight);
        let of = |of: &Swings| std::array::from_fn(|l| change(of.weight[l], of.swing[l]));
        let [now, next] = [0, 1].map(|_| State::at_first(self.swings.len(), 0.0));
        Tangent {
            weights: self.swings.iter().map(of).collect(),
            rest: other.rest - self.felt.rest,
            top: 0.0,
            given: [0.0; AHEAD],
            now,
            next,
        }
    }

    /// The difference for the same bat and a faster ball; the change is the closing speed itself.
    pub(super) fn faster(&self) -> Tangent {
        let same = self.tangent(self.felt);
        Tangent { now: State::at_first(self.swings.len(), self.speed), ..same }
    }

    /// Moves tangents along a step; `between` is scratch space for a state with as many modes.
    #[inline(always)]
    pub(super) fn follow(&self, tangents: &mut [Tangent], between: &mut State, walked: Walked) {
        let Walked { now, next, top, table, coupling, step, event } = walked;
        let (rest, law) = (self.felt.rest, &self.law);
        let [mut slope, mut by_top] = [[0.0; AHEAD]; 2];
        for i in 0..AHEAD {
            let [x, force] = [step.compression[i + 1], step.force[i + 1]];
            slope[i] = law.slope(x, force, top);
            by_top[i] = top.map_or(0.0, |top| law.by_top(x, force, top));
            self.memories(table, now, step, i + 1, between);
            for tangent in &mut *tangents {
                tangent.given[i] = self.given(tangent, between, force);
            }
        }
        // The matrix is the last one of Newton's method, and equal for all tangents.
        let [mut matrix, mut inverse] = [[[0.0; AHEAD]; AHEAD]; 2];
        for i in 0..AHEAD {
            for j in 0..AHEAD {
                matrix[i][j] = coupling[i][j + 1] * slope[j];
            }
            matrix[i][i] += 1.0 + rest * slope[i];
            inverse[i][i] = 1.0;
        }
        let inverse = eliminate(&mut matrix, inverse);
        let time = next.time - now.time;
        let moves = event.map(|_| self.moves(time));
        for tangent in tangents {
            let mut reach = self.free(table, coupling, &tangent.now);
            let force = by_top.map(|by| by * tangent.top);
            for i in 0..AHEAD {
                reach[i] += tangent.given[i] - rest * force[i] - dot(&coupling[i][1..], &force);
            }
            let mut all = [tangent.now.force; POINTS];
            for i in 0..AHEAD {
                all[i + 1] = force[i] + slope[i] * dot(&inverse[i], &reach);
            }
            let powers = self.rule.through(&all);
            let change = Step { length: step.length, force: all, powers, ..Step::default() };
            match &moves {
                None => self.advance(table, &tangent.now, &change, &mut tangent.next),
                Some(moves) => {
                    self.moved(moves, &tangent.now, &change, time, &mut tangent.next);
                }
            }
            if matches!(event, Some(Event::Turned | Event::Again)) {
                let slope = law.slope(next.compression, next.force, None);
                let given = self.given(tangent, next, next.force);
                tangent.top = (self.reach(&tangent.next) + given) / (1.0 + rest * slope);
                tangent.next.force = slope * tangent.top;
            }
            std::mem::swap(&mut tangent.now, &mut tangent.next);
        }
    }

    /// `q` (m) of a tangent at a moment of that force (N).
    #[inline(always)]
    fn given(&self, tangent: &Tangent, state: &State, force: f64) -> f64 {
        let mut sums = [0.0; LANES];
        for (w, [_, im]) in tangent.weights.iter().zip(&state.memories) {
            for l in 0..LANES {
                sums[l] += w[l] * im[l];
            }
        }
        -sum(sums) - tangent.rest * force
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collision::contact::collider::Collider;
    use crate::collision::contact::power_law::PowerLaw;

    const MODES: [[f64; 2]; 3] = [[1100.0, 0.0], [3700.0, 0.02], [8000.0, 0.0]];

    fn bat() -> DrivingPoint {
        DrivingPoint {
            inverse_mass: 1.0 / 0.145 + 1.0 / 0.8,
            gains: vec![0.5, 0.8, 1.0],
            rest: 2e-8,
        }
    }

    /// A bat with one property larger by that share: the gain of a mode, or the flexibility if there is no such mode.
    fn other(which: usize, share: f64) -> DrivingPoint {
        let mut other = bat();
        match other.gains.get_mut(which) {
            Some(gain) => *gain *= 1.0 + share,
            None => other.rest *= 1.0 + share,
        }
        other
    }

    /// Compared with central differences of encounters, whose own error is of second order.
    #[test]
    fn the_change_is_the_derivative_of_the_impulse() {
        const SHARE: f64 = 1e-3;
        for restitution in [0.4, 0.55, 0.8, 1.0] {
            let law = PowerLaw::new(6.53e7, 1.84, restitution);
            let collider = Collider::new(&MODES, 8e-5);
            let others: Vec<DrivingPoint> = (0..4).map(|which| other(which, SHARE)).collect();
            let met = collider.meet_beside(&bat(), &others, &law, 60.0, 1e-6);
            assert_eq!(met.impulse, collider.meet(&bat(), &law, 60.0, 1e-6).impulse);
            assert_eq!([met.reloads, met.touches], [0, 1], "{restitution}");
            for (which, change) in met.changes.iter().enumerate() {
                let at = |share| collider.meet(&other(which, share), &law, 60.0, 1e-9).impulse;
                let difference = 0.5 * (at(SHARE) - at(-SHARE));
                let off = (change - difference).abs();
                assert!(
                    off < 2e-4 * difference.abs(),
                    "{restitution} {which} {change} {difference}"
                );
            }
        }
    }

    /// A bat with fewer modes is one whose last gains are 0.
    #[test]
    fn a_mode_fewer_is_a_gain_of_zero() {
        let law = PowerLaw::new(6.53e7, 1.84, 0.5);
        let none = other(2, -1.0);
        let fewer = DrivingPoint { gains: none.gains[..2].to_vec(), ..none.clone() };
        let met = Collider::new(&MODES, 8e-5).meet_beside(&bat(), &[none, fewer], &law, 60.0, 1e-3);
        assert_eq!(met.changes[0], met.changes[1]);
        assert!(met.changes[0].abs() > 1e-5 * met.impulse);
    }

    /// The vibrating bat compresses a dead ball again; a livelier ball leaves and is touched again, which magnifies
    /// changes. The derivative is still known.
    #[test]
    fn where_the_ball_is_met_again_the_change_is_the_derivative_too() {
        const SHARE: f64 = 1e-6;
        let (mut anew, mut again) = (0, 0);
        for (restitution, by) in [0.1, 0.3, 0.5, 0.8].into_iter().flat_map(|e| {
            [[12.0, 11.0, 12.0], [20.0, 2.0, 1.0], [40.0, 40.0, 10.0]].map(|by| (e, by))
        }) {
            let law = PowerLaw::new(6.53e7, 1.84, restitution);
            let struck = |which, share| {
                let felt = other(which, share);
                let gains = felt.gains.iter().zip(by).map(|(c, by)| c * by).collect();
                DrivingPoint { gains, ..felt }
            };
            let collider = Collider::new(&MODES, 8e-5);
            let others: Vec<DrivingPoint> = (0..4).map(|which| struck(which, SHARE)).collect();
            let met = collider.meet_beside(&struck(4, 0.0), &others, &law, 60.0, 1e-9);
            anew += usize::from(met.reloads > 0);
            again += usize::from(met.again());
            for (which, change) in met.changes.iter().enumerate() {
                let at = |share| collider.meet(&struck(which, share), &law, 60.0, 1e-9).impulse;
                let difference = 0.5 * (at(SHARE) - at(-SHARE));
                let off = (change - difference).abs();
                assert!(
                    off < 1e-3 * difference.abs() + 1e-12 * met.impulse,
                    "{restitution} {by:?} {which} {change} {difference}"
                );
            }
        }
        assert!(anew > 0 && again > 1, "{anew} {again}");
    }
}
