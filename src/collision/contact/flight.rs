//! Ball and bat while no force acts between them: the ball flies, the bat rings, and where they meet
//! next is found without missing a touch.
//!
//! ```text
//! g(t) = z + z′t + Σ y_n                 how far the two have come together, y_n = −(c/ω_d) Im(v e^{st})
//! y_n ≤ y_n(0) + y_n′(0) t + b_n t²/2    b_n = (c/ω_d) |s|² |v|, which damping only lowers
//! y_n ≤ (c/ω_d) |v|
//! τ = (√(g′² + 2 B d) − g′)/B            after τ at least, g has grown by d
//! ```
//!
//! With the second line for the first modes, their sums g′ and B, and the third one for those beyond, τ is
//! the longest that any number of modes tells. A step of τ never passes the level that is d away, and close
//! to it is Newton's. The ball is gone for good where τ has no end, or where it is faster than the surface can
//! be.

use crate::collision::contact::collocation::{LANES, sum};
use crate::collision::contact::force_law::ForceLaw;
use crate::collision::contact::pressing::Run;
use crate::collision::contact::tangent::Tangent;
use crate::collision::contact::touch::{State, Touch};
use crate::motion::phi::exponential;

/// Where a flight ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Landing {
    /// At the upper level: ball and bat meet.
    Meets,
    /// At the lower level: they part.
    Parts,
    /// The ball is gone for good.
    Gone,
    /// The flight has no end within the number of looks that are taken.
    Open,
}

/// More looks are not taken in one flight.
const MOST_LOOKS: usize = 20_000;

/// What a flight knows of its modes from some lanes on, and before them.
#[derive(Debug, Clone, Copy, Default)]
struct Bound {
    /// Those from there on stay within this (m).
    within: f64,
    /// How much those before bend at most (m/s²).
    bend: f64,
}

impl<L: ForceLaw> Touch<'_, L> {
    /// Flies until `z + Σ y` is at one of the two levels (m), the ball is gone, or the flight has
    /// lasted for `longest` (s), after which the ball counts as gone.
    #[inline(always)]
    pub(super) fn fly(&self, run: &mut Run, levels: [f64; 2], longest: f64) -> Landing {
        let (state, [low, high]) = (&mut run.now, levels);
        let (mut fastest, mut bounds) = (0.0, vec![Bound::default(); self.swings.len() + 1]);
        for (k, (of, [re, im])) in self.swings.iter().zip(&state.memories).enumerate() {
            let [mut within, mut bend] = [[0.0; LANES]; 2];
            for l in 0..LANES {
                within[l] = of.weight[l] * re[l].hypot(im[l]);
                fastest += of.square[l].sqrt() * within[l];
                bend[l] = of.square[l] * within[l];
            }
            bounds[k].within = sum(within);
            bounds[k + 1].bend = bounds[k].bend + sum(bend);
        }
        for k in (0..self.swings.len()).rev() {
            bounds[k].within += bounds[k + 1].within;
        }
        let slack = 1e-15 * (state.closing.abs() + bounds[0].within) + 1e-13 * self.deepest;
        let (start, before) = (state.time, self.in_all(state));
        let mut landing = Landing::Open;
        for _ in 0..MOST_LOOKS {
            let (reach, rate) = (self.reach(state), self.rate(state));
            let time = self.free_for(state, &bounds, levels);
            landing = match () {
                () if high - reach <= slack && rate > 0.0 => Landing::Meets,
                () if reach - low <= slack && rate < 0.0 => Landing::Parts,
                () if low.is_infinite() && state.speed + fastest <= 0.0 => Landing::Gone,
                () if time.is_infinite() || state.time >= start + longest => Landing::Gone,
                () => Landing::Open,
            };
            if landing != Landing::Open {
                break;
            }
            self.drift(&mut [&mut *state], time.min(longest));
        }
        if self.damped {
            state.lost += before - self.in_all(state);
        }
        let time = state.time - start;
        if time > 0.0 && !run.tangents.is_empty() {
            self.drift(&mut run.tangents.iter_mut().map(Tangent::free).collect::<Vec<_>>(), time);
        }
        landing
    }

    /// The time (s) before which `z + Σ y` comes to neither of the two levels (m).
    #[inline(always)]
    fn free_for(&self, state: &State, bounds: &[Bound], [low, high]: [f64; 2]) -> f64 {
        let (mut reach, mut rate) = (state.closing, state.speed);
        let [mut up, mut down] = [0.0_f64; 2];
        for (k, Bound { within, bend }) in bounds.iter().enumerate() {
            if let Some(k) = k.checked_sub(1) {
                let (of, [re, im]) = (&self.swings[k], &state.memories[k]);
                for l in 0..LANES {
                    reach -= of.weight[l] * im[l];
                    rate -= of.weight[l] * (of.decay[l] * im[l] + of.swing[l] * re[l]);
                }
            }
            // With all modes a level is reached but for round-off.
            let least = if k == self.swings.len() { 0.0 } else { f64::NEG_INFINITY };
            let ways = [high - reach - within, reach - low - within].map(|way| way.max(least));
            up = up.max(not_before(ways[0], rate, *bend));
            down = down.max(not_before(ways[1], -rate, *bend));
        }
        up.min(down)
    }

    /// Energy in all modes (J).
    fn in_all(&self, state: &State) -> f64 {
        (0..self.felt.gains.len()).map(|n| self.in_mode(state, n)).sum()
    }

    /// Lets that time (s) pass without a force.
    #[inline(always)]
    fn drift(&self, states: &mut [&mut State], time: f64) {
        for state in &mut *states {
            state.time += time;
            state.closing += time * state.speed;
        }
        for (n, s) in self.modes() {
            let turn = exponential(s * time);
            for state in &mut *states {
                state.remember(n, turn * state.memory(n));
            }
        }
    }
}

/// The shortest time (s) in which something grows by `way` (m) that grows at `rate` (m/s) and whose
/// rate changes by at most `bend` (m/s²); 0 where it may be there already.
fn not_before(way: f64, rate: f64, bend: f64) -> f64 {
    if way < 0.0 {
        return 0.0;
    }
    if way == f64::INFINITY || bend == 0.0 && rate <= 0.0 {
        return f64::INFINITY;
    }
    let root = (rate * rate + 2.0 * bend * way).sqrt();
    // Without the loss of digits of the other form.
    if rate > 0.0 { 2.0 * way / (root + rate) } else { (root - rate) / bend }
}

#[cfg(test)]
mod tests {
    use super::not_before;

    #[test]
    fn a_growth_takes_at_least_that_long() {
        for (way, rate, bend) in [(0.01, 3.0, 1e4), (0.01, -3.0, 1e4), (0.0, -3.0, 1e4)] {
            let time = not_before(way, rate, bend);
            assert!((rate * time + 0.5 * bend * time * time - way).abs() < 1e-15);
        }
        assert_eq!(not_before(0.01, 2.0, 0.0), 0.005);
        assert_eq!(not_before(f64::INFINITY, -2.0, 0.0), f64::INFINITY);
        assert_eq!([-2.0, 0.0].map(|rate| not_before(0.01, rate, 0.0)), [f64::INFINITY; 2]);
        assert_eq!(not_before(-0.01, -2.0, 1e4), 0.0);
    }
}
