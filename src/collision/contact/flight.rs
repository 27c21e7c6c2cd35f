//! Ball and bat while no force acts between them: the ball flies, the bat vibrates, and their next touch is found
//! without missing one.
//!
//! ```text
//! g(t) = z + z′t + Σ y_n                 how far the two have come together, y_n = −(c/ω_d) Im(v e^{st})
//! y_n ≤ y_n(0) + y_n′(0) t + b_n t²/2    b_n = (c/ω_d) |s|² |v|, which damping only lowers
//! y_n ≤ (c/ω_d) |v|
//! τ = (√(g′² + 2 B d) − g′)/B            after τ at least, g has grown by d
//! ```
//!
//! The second line applies to the first modes, with their sums g′ and B, and the third to the others; τ is the longest
//! time that results for any number of first modes. A step of τ never passes the level at the distance d, and close to
//! the level it equals Newton's step. The ball is gone for good if τ is infinite, or if the ball is faster than the
//! surface can be.

use crate::collision::contact::collocation::{LANES, sum};
use crate::collision::contact::each::Each;
use crate::collision::contact::force_law::ForceLaw;
use crate::collision::contact::pressing::Run;
use crate::collision::contact::tangent::Tangent;
use crate::collision::contact::touch::{State, Swings, Touch};

/// Where a flight ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Landing {
    /// At the upper level: ball and bat meet.
    Meets,
    /// At the lower level: they part.
    Parts,
    /// The ball is gone for good.
    Gone,
    /// The flight has not ended within the largest number of steps.
    Open,
}

/// Most steps of one flight.
const MOST_LOOKS: usize = 20_000;

/// Bounds on the motion of the modes from some lanes on, and of those before them.
#[derive(Debug, Clone, Copy, Default)]
struct Bound {
    /// Largest displacement by the modes from there on (m).
    within: f64,
    /// Largest acceleration by the modes before (m/s²).
    bend: f64,
}

impl<L: ForceLaw> Touch<'_, L> {
    /// Moves ball and bat on until `z + Σ y` is at one of the two levels (m), the ball is gone, or the flight has
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

    /// The time (s) up to which `z + Σ y` certainly reaches neither of the two levels (m).
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
            // With all modes in the bound, a level is passed only by round-off.
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

    /// Moves the states on by that time (s) without a force.
    #[inline(always)]
    pub(super) fn drift(&self, states: &mut [&mut State], time: f64) {
        for state in &mut *states {
            state.time += time;
            state.closing += time * state.speed;
        }
        for k in 0..self.swings.len() {
            let Swings { decay, swing, .. } = self.swings[k];
            let [mut sin, mut cos] = (Each(swing) * time).sin_cos().map(|part| part.0);
            if self.damped {
                for l in 0..LANES {
                    let size = (decay[l] * time).exp();
                    (sin[l], cos[l]) = (size * sin[l], size * cos[l]);
                }
            }
            for state in &mut *states {
                let [re, im] = &mut state.memories[k];
                for l in 0..LANES {
                    let (a, b) = (re[l], im[l]);
                    (re[l], im[l]) = (cos[l] * a - sin[l] * b, sin[l] * a + cos[l] * b);
                }
            }
        }
    }
}

/// The shortest time (s) in which a quantity grows by `way` (m), given its `rate` (m/s) and the largest change `bend`
/// of its rate (m/s²); 0 if it may be there already.
fn not_before(way: f64, rate: f64, bend: f64) -> f64 {
    if way < 0.0 {
        return 0.0;
    }
    if way == f64::INFINITY || bend == 0.0 && rate <= 0.0 {
        return f64::INFINITY;
    }
    let root = (rate * rate + 2.0 * bend * way).sqrt();
    // The other form would lose digits.
    if rate > 0.0 { 2.0 * way / (root + rate) } else { (root - rate) / bend }
}

#[cfg(test)]
mod tests {
    use faer::c64;

    use super::*;
    use crate::base::golden;
    use crate::collision::contact::collocation::Lobatto;
    use crate::collision::contact::power_law::PowerLaw;
    use crate::collision::contact::touch::{DrivingPoint, Tuning};

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

    /// Compared with short steps: at the end of a flight ball and bat are at the stated place with the stated speed,
    /// and they were never beyond a level before, whichever modes vibrate, from both kinds of starts.
    #[test]
    fn a_flight_passes_no_level_and_ends_at_one() {
        const MODES: usize = 6;
        let (rule, longest) = (Lobatto::default(), 0.1);
        let mut seen = [0; 4];
        for k in 0..400 {
            let number = |i: usize| golden::fraction((20 * k + i).pow(2));
            let ratio = if k % 3 == 0 { 0.02 * number(0) } else { 0.0 };
            let pole = |n: usize| {
                let omega = 900.0 * (1 + n * n) as f64 * (1.0 + number(n + 1));
                c64::new(-ratio * omega, omega)
            };
            let poles: Vec<c64> = (0..MODES.next_multiple_of(LANES)).map(pole).collect();
            let gain = |n: usize| if n < MODES { 1.0 } else { 0.0 };
            let lanes = (0..poles.len()).step_by(LANES);
            let felt = DrivingPoint { inverse_mass: 8.0, gains: vec![1.0; MODES], rest: 0.0 };
            let touch = Touch {
                rule: &rule,
                poles: &poles,
                swings: lanes
                    .map(|n| Swings::new(std::array::from_fn(|l| (poles[n + l], gain(n + l)))))
                    .collect(),
                felt: &felt,
                damped: ratio > 0.0,
                law: PowerLaw::new(6.53e7, 1.84, 0.5),
                speed: 60.0,
                energy: 200.0,
                deepest: 0.01,
                way: 0.01,
                accuracy: 1e-6,
                tuning: Tuning::default(),
            };
            let mut start = State::at_first(touch.swings.len(), -20.0 * number(19).powi(2));
            for n in 0..MODES {
                let size = 8.0 * poles[n].im.powf(0.3 * number(18)) * number(n + 7);
                let angle = std::f64::consts::TAU * number(n + 13).sqrt();
                start.remember(n, size * c64::new(angle.cos(), angle.sin()));
            }
            // At the upper level, and on its way from it.
            start.closing -= touch.reach(&start);
            let away = touch.rate(&start);
            start.speed -= if away > 0.0 { 1.5 * away } else { 0.0 };
            let low = if k % 2 == 0 { f64::NEG_INFINITY } else { -1e-3 * number(6) };
            let mut run = Run::new(start.clone());
            let landing = touch.fly(&mut run, [low, 0.0], longest);
            let (flown, scale) = (run.now.time, 1e-9 * start.closing.abs() + 1e-12);
            let (reach, rate) = (touch.reach(&run.now), touch.rate(&run.now));
            match landing {
                Landing::Meets => assert!(reach.abs() < scale && rate > 0.0, "{k} {reach}"),
                Landing::Parts => assert!((reach - low).abs() < scale && rate < 0.0, "{k} {reach}"),
                Landing::Gone => {}
                Landing::Open => panic!("{k}: no end"),
            }
            seen[landing as usize] += 1;
            // A ball that is gone stays away.
            let looked = if landing == Landing::Gone { longest } else { flown };
            let fastest = poles[MODES - 1].im;
            let step = looked / (20.0 * looked * fastest).ceil().max(20.0);
            let mut slow = start;
            while slow.time + 1.5 * step < looked {
                touch.drift(&mut [&mut slow], step);
                let reach = touch.reach(&slow);
                assert!((low - scale..scale).contains(&reach), "{k} {reach} at {}", slow.time);
            }
        }
        let [meets, parts, gone, _] = seen;
        assert!(meets > 50 && parts > 50 && gone > 50, "{seen:?}");
    }
}
