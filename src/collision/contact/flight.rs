//! Ball and bat while no force acts between them: the ball flies, the bat rings, and where they meet
//! next is found without missing a touch.
//!
//! ```text
//! g(t) = z + z′t − Σ (c/ω_d) Im(v e^{st})      how far the two have come together
//! |g″| ≤ B = Σ (c/ω_d) |s|² |v|                which damping only lowers
//! τ = (√(g′² + 2 B d) − g′)/B                  after τ at least, g has grown by d
//! ```
//!
//! A step of τ never passes the level that is d away, and close to it is Newton's. The ball is gone
//! for good where `z + Σ (c/ω_d) |v|` is below zero and falls, or where it is faster than the surface
//! can be.

use crate::collision::contact::collocation::LANES;
use crate::collision::contact::force_law::ForceLaw;
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

impl<L: ForceLaw> Touch<'_, L> {
    /// Flies until `z + Σ y` is at one of the two levels (m), the ball is gone, or the flight has
    /// lasted for `longest` (s), after which the ball counts as gone.
    pub fn fly(&self, state: &mut State, [low, high]: [f64; 2], longest: f64) -> Landing {
        let (mut farthest, mut fastest, mut bend) = (0.0, 0.0, 0.0);
        for n in 0..self.felt.gains.len() {
            let (of, l) = (&self.swings[n / LANES], n % LANES);
            let amplitude = of.weight[l] * state.memory(n).norm();
            farthest += amplitude;
            fastest += of.square[l].sqrt() * amplitude;
            bend += of.square[l] * amplitude;
        }
        let slack = 1e-15 * (state.closing.abs() + farthest) + 1e-13 * self.deepest;
        let (end, before) = (state.time + longest, self.in_all(state));
        let mut landing = Landing::Open;
        for _ in 0..MOST_LOOKS {
            let (reach, rate) = (self.reach(state), self.rate(state));
            let (up, down) = ((high - reach).max(0.0), (reach - low).max(0.0));
            let leaves = state.speed < 0.0 && low == f64::NEG_INFINITY;
            landing = match () {
                () if up <= slack && rate > 0.0 => Landing::Meets,
                () if down <= slack && rate < 0.0 => Landing::Parts,
                () if leaves && state.closing + farthest < high => Landing::Gone,
                () if leaves && state.speed + fastest <= 0.0 => Landing::Gone,
                () if state.time >= end => Landing::Gone,
                () => Landing::Open,
            };
            if landing != Landing::Open {
                break;
            }
            let time = not_before(up, rate, bend).min(not_before(down, -rate, bend));
            self.drift(state, time.min(longest));
        }
        if self.damped {
            state.lost += before - self.in_all(state);
        }
        landing
    }

    /// Energy in all modes (J).
    fn in_all(&self, state: &State) -> f64 {
        (0..self.felt.gains.len()).map(|n| self.in_mode(state, n)).sum()
    }

    /// Lets that time (s) pass without a force.
    fn drift(&self, state: &mut State, time: f64) {
        state.time += time;
        state.closing += time * state.speed;
        for n in 0..self.felt.gains.len() {
            let turned = exponential(self.poles[n] * time) * state.memory(n);
            state.remember(n, turned);
        }
    }
}

/// The shortest time (s) in which something grows by `way` (m) that grows at `rate` (m/s) and whose
/// rate changes by at most `bend` (m/s²).
fn not_before(way: f64, rate: f64, bend: f64) -> f64 {
    if way == f64::INFINITY {
        return way;
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
    }
}
