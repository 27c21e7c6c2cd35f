//! How do we integrate: Gauss–Legendre points on [0, 1], and sums that keep their digits.

use std::f64::consts::PI;

use crate::real::Real;

/// Points in (0, 1) and weights of sum 1; exact for polynomials of degree `2 n − 1`.
///
/// Roots of the Legendre polynomial `P_n` by Newton's method from Chebyshev-like guesses,
/// weights `w = 2 / ((1 − ξ²) P_n′(ξ)²)` on [−1, 1] (Abramowitz and Stegun, 25.4.29).
pub fn gauss(n: usize) -> Vec<(f64, f64)> {
    let point = |i: usize| {
        let mut xi = (PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..8 {
            let (value, before) = legendre_pair(n, xi);
            slope = n as f64 * (before - xi * value) / (1.0 - xi * xi);
            xi -= value / slope;
        }
        (xi, 1.0 / ((1.0 - xi * xi) * slope * slope))
    };
    (0..n)
        .map(|i| {
            // Only the positive half is computed, so that the rule is symmetric to the last bit.
            let (xi, weight) = point(i.min(n - 1 - i));
            let xi = if 2 * i + 1 == n { 0.0 } else { xi };
            let s = if 2 * i < n { (1.0 - xi) / 2.0 } else { (1.0 + xi) / 2.0 };
            (s, weight)
        })
        .collect()
}

/// `P_n` and `P_{n−1}` at `xi`, by `(k + 1) P_{k+1} = (2k + 1) ξ P_k − k P_{k−1}`.
fn legendre_pair(n: usize, xi: f64) -> (f64, f64) {
    let (mut value, mut before) = (1.0, 0.0);
    for k in 0..n {
        let k = k as f64;
        (value, before) = (((2.0 * k + 1.0) * xi * value - k * before) / (k + 1.0), value);
    }
    (value, before)
}

/// `P_0 … P_{count−1}` at `xi`, two at least.
pub fn legendre(count: usize, xi: f64) -> Vec<f64> {
    let mut p = vec![1.0, xi];
    for k in 1..count.saturating_sub(1) {
        let n = k as f64;
        p.push(((2.0 * n + 1.0) * xi * p[k] - n * p[k - 1]) / (n + 1.0));
    }
    p
}

/// A running sum that carries the rounding error of every addition along.
///
/// The error of the sum of n terms is then about ε instead of ε·n
/// (Knuth's two-sum; Ogita, Rump, Oishi, SIAM J. Sci. Comput. 26 (2005) 1955, algorithm 4.1).
/// With `KEEP` false it is a plain sum, for sums so short that nothing is worth keeping.
#[derive(Debug, Clone, Copy, Default)]
pub struct RunningSum<R, const KEEP: bool = true> {
    high: R,
    low: R,
}

impl<R: Real, const KEEP: bool> RunningSum<R, KEEP> {
    #[inline(always)]
    pub fn add(&mut self, term: R) {
        let sum = self.high + term;
        if KEEP {
            let part = sum - self.high;
            self.low += (self.high - (sum - part)) + (term - part);
        }
        self.high = sum;
    }

    #[inline(always)]
    pub fn value(self) -> R {
        if KEEP { self.high + self.low } else { self.high }
    }
}

/// The sum of all terms, rounding errors carried along.
pub fn sum<R: Real>(terms: impl IntoIterator<Item = R>) -> R {
    let mut total = RunningSum::<R>::default();
    terms.into_iter().for_each(|term| total.add(term));
    total.value()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn n_points_integrate_degree_2n_minus_1() {
        for n in 1..=20 {
            let rule = gauss(n);
            for degree in 0..2 * n {
                let integral: f64 = rule.iter().map(|(s, w)| w * s.powi(degree as i32)).sum();
                let exact = 1.0 / (degree as f64 + 1.0);
                assert!((integral / exact - 1.0).abs() < 1e-13, "n {n} degree {degree}");
            }
        }
    }

    #[test]
    fn the_rule_is_symmetric() {
        let rule = gauss(8);
        for (left, right) in rule.iter().zip(rule.iter().rev()) {
            assert_eq!(left.1, right.1);
            assert!((left.0 + right.0 - 1.0).abs() < 1e-16);
        }
    }

    #[test]
    fn a_running_sum_keeps_what_plain_addition_loses() {
        assert_eq!(sum([1.0, 1e100, 1.0, -1e100]), 2.0);
    }
}
