//! What is the error of a contact's exit speed: due to omitted modes, to its steps, and to small changes that the hit
//! magnifies?
//!
//! Each error comes from other answers to the same hit: with fewer modes or a slightly faster ball (to first order,
//! [`crate::collision::contact::tangent`]), or with finer steps. The constants are fitted to 1270 random hits with known
//! results (`search/hits`); `validate --promise` checks the different hits of `validation/hits`.

use crate::collision::contact::encounter::Encounter;
use crate::collision::hit::greater;

/// Refinement of the steps for the answer that shows their error, and the finest; there the answer is compared with one
/// by coarser steps.
const FINER: f64 = 1e-2;
const FINEST: f64 = 1e-12;
/// Share of the error of the energy by the steps that is taken as the least error: two answers may agree by chance.
const CORRECTED: f64 = 0.03;
/// For one touch, the steps cause at most this multiple of the energy error before its correction: 99 of 100 hits of
/// `validation/hits` are within it. If that is a small enough share of the effect of omitted modes, finer steps are not
/// computed.
const MOST_CORRECTED: f64 = 2.0;
const BESIDE: f64 = 0.1;

/// The error falls at least as these powers of the number of modes, without and with shear, compared with a few modes
/// less and with half as many. The mean powers are 6.5 and 3.2 (example `tuning_modes`: 5.7 to 6.2 and 2.9 to 3.2 from
/// 10 to 40 modes).
const FALLS: [[f64; 2]; 2] = [[4.0, 5.0], [2.5, 3.0]];
/// Error as a share of the change by fewer modes.
const LEFT_OUT: f64 = 0.6;

/// The smallest change considered: the share of the energy that a touch may leave uncertain.
const SMALL: f64 = 1e-12;

/// An answer to a hit, with `count` modes and steps of that accuracy.
#[derive(Debug, Clone, Copy)]
pub struct Answered<'a> {
    /// The contact.
    pub met: &'a Encounter,
    /// Number of modes.
    pub count: usize,
    /// Accuracy of the steps, relative.
    pub accuracy: f64,
    /// Separation speed of ball and rigid bat over the closing speed.
    pub rebound: f64,
    /// μ/m: the ball's share in a change of that.
    pub of_ball: f64,
    /// Number of modes that are slow compared with the contact ([`SLOW`]). While some of these are missing, the error
    /// does not fall with the number of modes as it does later.
    pub slow: usize,
}

/// A mode is quick compared with a contact if its ω times the compression time is at least this: half a wave of the
/// force then spans about three of its periods. Only then does the error fall as a power of the number of modes.
pub const QUICK: f64 = 6.0;
/// Below this share of it a mode is slow.
pub const SLOW: f64 = 2.0 / 3.0;

/// The accuracy of the other steps with which an answer by steps of that accuracy is compared.
pub fn other_steps(accuracy: f64) -> f64 {
    let finer = FINER * accuracy;
    if finer < FINEST { accuracy / FINER } else { finer }
}

impl Answered<'_> {
    /// Possible effect of omitted modes, relative to the closing speed. `apart` gives the numbers of [`fewer`] modes
    /// and the difference of their answers from this one.
    pub fn left_out(&self, shears: bool, apart: impl Iterator<Item = (usize, f64)>) -> f64 {
        let [near, far] = FALLS[usize::from(shears)];
        let stated = apart.map(|(few, apart)| {
            /// Least effect of a change by fewer modes if all of them are slow.
            const LEAST: f64 = 0.3;
            let rate = if 2 * few < self.count + 2 { far } else { near };
            let fall = (self.count as f64 / few.max(self.slow) as f64).powf(rate) - 1.0;
            LEFT_OUT * apart / fall.max(LEAST)
        });
        stated.fold(0.0, greater)
    }

    /// Possible effect of the steps, relative to the closing speed; `apart(accuracy)` is the difference of the answer
    /// by such steps from this one. Beside a large error `left_out`, the upper bound is used.
    pub fn steps(&self, left_out: f64, apart: impl Fn(f64) -> f64) -> f64 {
        let most = self.speed_of(MOST_CORRECTED * self.met.corrected);
        if !self.met.is_delicate() && most < BESIDE * left_out {
            return most;
        }
        let other = other_steps(self.accuracy);
        let least = self.speed_of(CORRECTED * self.met.corrected);
        apart(other).max(least)
    }

    /// Change of the exit speed, relative to the closing speed u, due to a share dE of the energy `μu²/2`: the
    /// remaining energy `μ(eu)²/2` changes by that, `e² + dE = (e + de)²`, and the ball's speed changes by `de μ/m`.
    fn speed_of(&self, share: f64) -> f64 {
        let rebound = self.rebound.abs();
        let after = (rebound * rebound + share).sqrt();
        // Avoids the cancellation of a difference; 0 if nothing is missing.
        if share > 0.0 { self.of_ball * share / (after + rebound) } else { 0.0 }
    }

    /// Factor by which the hit magnifies small changes, and the resulting error from round-off, for a ball of that
    /// momentum (N s) at the closing speed. A closing speed that is larger by a small share changes the impulse by the
    /// same share; what it changes beyond that is magnified.
    pub fn magnified(&self, momentum: f64) -> [f64; 2] {
        if !self.met.is_delicate() {
            return [1.0, 0.0];
        }
        /// A share of a millionth changes the exit speed by the closing speed at most, however steep the derivative is.
        const MOST: f64 = 1e6;
        let faster = self.met.faster.map(|faster| (faster - self.met.impulse).abs() / momentum);
        let known = faster.filter(|magnified| !magnified.is_nan());
        let magnified = known.unwrap_or(MOST).clamp(1.0, MOST);
        [magnified, magnified * self.speed_of(SMALL)]
    }
}

/// Numbers of modes for comparison with `count`: one, two, three, a quarter and a half less. There are several, since
/// one such answer may agree by chance.
pub fn fewer(count: usize) -> Vec<usize> {
    let mut less = vec![1, 2, 3, count / 4, count - count / 2];
    less.retain(|less| (1..count).contains(less));
    less.sort_unstable();
    less.dedup();
    less.into_iter().map(|less| count - less).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn answered(met: &Encounter) -> Answered<'_> {
        Answered { met, count: 10, accuracy: 1e-6, rebound: 0.5, of_ball: 0.8, slow: 0 }
    }

    /// An error that falls as `n^−6` (`n^−3` with shear) is stated within a factor of four, for any number of modes;
    /// one that jumps is not overlooked because two answers agree once.
    #[test]
    fn errors_that_fall_as_powers_are_stated_near_what_they_are() {
        let met = Encounter { touches: 1, ..Encounter::default() };
        for (shears, power) in [(false, 6.0), (true, 3.0)] {
            for count in [10, 20, 43, 80] {
                let answered = Answered { count, ..answered(&met) };
                let error = |n: usize| (n as f64).powf(-power);
                let stated = |apart: &dyn Fn(usize) -> f64| {
                    answered.left_out(shears, fewer(count).into_iter().map(|n| (n, apart(n))))
                };
                let ratio = stated(&|n| error(n) - error(count)) / error(count);
                assert!((0.5..4.0).contains(&ratio), "{count} {ratio}");
                let agreeing = |n: usize| if n + 2 == count { 0.0 } else { error(n) };
                assert!(stated(&agreeing) > 0.5 * error(count));
            }
        }
    }

    #[test]
    fn the_finest_steps_are_not_compared_with_themselves() {
        let met = Encounter { touches: 1, ..Encounter::default() };
        for accuracy in [1e-3, 1e-9, 1e-11, 1e-12] {
            let answered = Answered { accuracy, ..answered(&met) };
            assert_eq!(answered.steps(0.0, |other| f64::from(other != accuracy)), 1.0);
        }
    }

    /// Beside a large error due to omitted modes, the upper bound for the steps is stated; a hit that may magnify it is
    /// computed with finer steps.
    #[test]
    fn finer_steps_are_asked_where_they_could_matter() {
        let met = Encounter { touches: 1, corrected: 1e-8, ..Encounter::default() };
        let again = Encounter { touches: 2, ..met.clone() };
        let most = answered(&met).speed_of(2e-8);
        for (met, left_out, stated) in
            [(&met, 11.0 * most, most), (&met, 9.0 * most, 1.0), (&again, 11.0 * most, 1.0)]
        {
            assert_eq!(answered(met).steps(left_out, |_| 1.0), stated);
        }
    }

    /// For a ball that returns at `e u`, a small energy changes the speed by `dE/(2e)`; for one that sticks, by a
    /// square root.
    #[test]
    fn an_energy_is_stated_as_the_speed_that_it_makes() {
        let met = Encounter { touches: 1, ..Encounter::default() };
        let sticking = Answered { rebound: 0.0, ..answered(&met) };
        assert!((answered(&met).speed_of(1e-9) / (0.8e-9) - 1.0).abs() < 1e-8);
        assert!((sticking.speed_of(1e-8) / 0.8e-4 - 1.0).abs() < 1e-12);
        assert_eq!(sticking.speed_of(0.0), 0.0);
    }

    #[test]
    fn one_touch_magnifies_nothing() {
        let met = Encounter { touches: 1, ..Encounter::default() };
        let again = Encounter { touches: 2, impulse: 2.0, faster: Some(-998.0), ..met.clone() };
        let of = |met| answered(met).magnified(1.0);
        assert_eq!(of(&met), [1.0, 0.0]);
        let [magnified, round_off] = of(&again);
        assert!((magnified / 1e3 - 1.0).abs() < 1e-9 && round_off < 1e-8);
    }
}
