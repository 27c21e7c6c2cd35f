//! How do we integrate, and add up without losing digits?
//!
//! [`gauss`] gives Gauss–Legendre points on [0, 1], [`converged`] integrates functions that are not polynomials, and a
//! [`RunningSum`] adds up its rounding errors too.

use std::f64::consts::PI;
use std::sync::LazyLock;

use crate::base::real::Real;

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

/// `P_0 … P_{count−1}` at `xi`; `count` is at least 2.
pub fn legendre(count: usize, xi: f64) -> Vec<f64> {
    let mut p = Vec::with_capacity(count.max(2));
    p.extend([1.0, xi]);
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
/// With `KEEP` false it is a plain sum, for sums too short to lose digits.
#[derive(Debug, Clone, Copy, Default)]
pub struct RunningSum<R, const KEEP: bool = true> {
    high: R,
    low: R,
}

impl<R: Real, const KEEP: bool> RunningSum<R, KEEP> {
    /// Adds a term.
    #[inline(always)]
    pub fn add(&mut self, term: R) {
        let sum = self.high + term;
        if KEEP {
            let part = sum - self.high;
            self.low += (self.high - (sum - part)) + (term - part);
        }
        self.high = sum;
    }

    /// The sum so far.
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

/// Two rules that differ by less than this share of `∫|f| ds` agree.
const AGREED: f64 = 2e-14;
/// Largest relative round-off of a function with cancellation.
const ROUND_OFF: f64 = 1e-9;
/// Most stretches into which an interval is cut.
const MOST_PANELS: usize = 100;

/// Integrals of several functions over [0, 1], and their error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Converged<const N: usize> {
    /// One integral for each function.
    pub values: [f64; N],
    /// Largest difference of two rules as a share of `∫|f| ds`; the values are closer than that.
    pub error: f64,
}

/// `∫₀¹ f ds` of smooth functions that are not polynomials.
///
/// Gauss's rules of 16 and 32 points are compared. While they differ by more than 2e-14 of `∫|f| ds`, the stretch with
/// the largest difference is cut in two, up to 100 stretches. A small difference that cuts do not reduce is round-off
/// of `f`, and stays.
pub fn converged<const N: usize>(f: impl Fn(f64) -> [f64; N]) -> Converged<N> {
    let mut panels = vec![Panel::new(&f, 0.0, 1.0)];
    loop {
        let total = |part: fn(&Panel<N>) -> &[f64; N]| -> [f64; N] {
            std::array::from_fn(|i| sum(panels.iter().map(|panel| part(panel)[i])))
        };
        let sizes = total(|p| &p.sizes);
        let error = share(&total(|p| &p.differences), &sizes);
        let shares: Vec<f64> = panels.iter().map(|p| share(&p.differences, &sizes)).collect();
        let worst = (0..panels.len()).max_by(|&a, &b| shares[a].total_cmp(&shares[b]));
        let (Some(worst), true) = (worst, error > AGREED && panels.len() < MOST_PANELS) else {
            return Converged { values: total(|p| &p.values), error };
        };
        let Panel { from, to, .. } = panels[worst];
        let middle = 0.5 * (from + to);
        let halves = [Panel::new(&f, from, middle), Panel::new(&f, middle, to)];
        let left: f64 = halves.iter().map(|half| share(&half.differences, &sizes)).sum();
        if error < ROUND_OFF && left > 0.5 * shares[worst] {
            return Converged { values: total(|p| &p.values), error };
        }
        let [left, right] = halves;
        panels[worst] = left;
        panels.push(right);
    }
}

/// The largest difference relative to its size; infinite if a value is NaN.
fn share<const N: usize>(differences: &[f64; N], sizes: &[f64; N]) -> f64 {
    let shares =
        differences.iter().zip(sizes).map(|(d, size)| if *d == 0.0 { 0.0 } else { d / size });
    shares.map(|share| if share.is_nan() { f64::INFINITY } else { share }).fold(0.0, f64::max)
}

/// One stretch: the integrals by the finer rule, the integrals of the absolute values, and the difference of the
/// coarser rule.
struct Panel<const N: usize> {
    from: f64,
    to: f64,
    values: [f64; N],
    sizes: [f64; N],
    differences: [f64; N],
}

impl<const N: usize> Panel<N> {
    fn new(f: &impl Fn(f64) -> [f64; N], from: f64, to: f64) -> Self {
        static RULES: LazyLock<[Vec<(f64, f64)>; 2]> = LazyLock::new(|| [gauss(16), gauss(32)]);
        let [coarser, finer] = RULES.each_ref().map(|rule| {
            let (mut values, mut sizes) = ([0.0; N], [0.0; N]);
            for (s, weight) in rule {
                let at = f(from + (to - from) * s);
                for i in 0..N {
                    let term = weight * (to - from) * at[i];
                    values[i] += term;
                    sizes[i] += term.abs();
                }
            }
            (values, sizes)
        });
        let differences = std::array::from_fn(|i| (finer.0[i] - coarser.0[i]).abs());
        Self { from, to, values: finer.0, sizes: finer.1, differences }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integrals_converge_where_no_rule_is_exact() {
        let got = converged(|s| [s.exp(), s.sqrt(), (s - 0.3).abs(), 1.0 / (1e-3 + s), 0.0]);
        let e = std::f64::consts::E;
        let exact = [e - 1.0, 2.0 / 3.0, 0.29, (1.001_f64 / 0.001).ln(), 0.0];
        assert!(got.error <= AGREED, "{:e}", got.error);
        for (got, exact) in got.values.iter().zip(exact) {
            assert!((got - exact).abs() <= 2e-14 * exact, "{got} {exact}");
        }
    }

    #[test]
    fn what_does_not_converge_says_so() {
        let pole = converged(|s| [1.0 / (s - 0.3).abs()]);
        let noise = converged(|s| [1.0 + 1e-6 * (1e7 * s).sin()]);
        assert!(pole.error > 1e-10 && noise.error > 1e-10, "{:e} {:e}", pole.error, noise.error);
    }

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
