//! How does a motion `e^{st}` respond to a force that is a polynomial in time? Exactly.
//!
//! ```text
//! v(h) = e^{sh} v(0) + ∫₀ʰ e^{s(h−τ)} F(τ) dτ,    F = Σ f_k (τ/h)^k
//!      = e^z v(0) + h Σ f_k E_k(z),               z = sh
//! E_k(z) = ∫₀¹ e^{z(1−σ)} σ^k dσ = k! φ_{k+1}(z)
//! φ₀ = e^z,    φ_{k+1}(z) = (φ_k(z) − 1/k!)/z
//! ```
//!
//! The recurrence runs upwards where z is large. Near 0 the last function is a power series, and the others follow
//! downwards. Neither way amplifies round-off anywhere in the left half plane.
//!
//! # Source
//!
//! M. Hochbruck, A. Ostermann, Exponential integrators, Acta Numerica 19 (2010) 209.

use faer::c64;

/// Terms of the power series: `NEAR^18/18!` is below ε.
const TERMS: usize = 20;
/// Absolute value of z up to which the series is used.
const NEAR: f64 = 1.5;

/// `e^z` and `E_k(z)` for k below `COUNT`.
#[inline(always)]
pub fn moments<const COUNT: usize>(z: c64) -> (c64, [c64; COUNT]) {
    let mut all = [c64::new(0.0, 0.0); COUNT];
    if z.norm_sqr() > NEAR * NEAR {
        let (whole, inverse) = (exponential(z), z.inv());
        let mut above = whole - 1.0;
        for (k, moment) in all.iter_mut().enumerate() {
            *moment = above * inverse;
            above = *moment * (k + 1) as f64 - 1.0;
        }
        (whole, all)
    } else {
        let mut term = c64::new(1.0 / COUNT as f64, 0.0);
        let mut sum = term;
        for j in 1..TERMS {
            term *= z * (1.0 / (COUNT + j) as f64);
            sum += term;
            if term.re.abs() + term.im.abs() < 1e-18 {
                break;
            }
        }
        all[COUNT - 1] = sum;
        for k in (1..COUNT).rev() {
            all[k - 1] = (z * all[k] + 1.0) * (1.0 / k as f64);
        }
        (z * all[0] + 1.0, all)
    }
}

/// `e^z`.
#[inline(always)]
pub fn exponential(z: c64) -> c64 {
    let size = if z.re == 0.0 { 1.0 } else { z.re.exp() };
    let (sin, cos) = z.im.sin_cos();
    c64::new(size * cos, size * sin)
}

/// `e^z` and `E_k(z)` for k below `COUNT` as divided differences `(f(a) − f(b))/(a − b)`, also for `a = b`; a is the
/// larger of both. They give the response of the two poles of an oscillator to a force.
pub fn differences<const COUNT: usize>(a: c64, b: c64) -> (c64, [c64; COUNT]) {
    let (end, others) = moments::<COUNT>(b);
    // (e^a − e^b)/(a − b) = e^b E₀(a − b).
    let whole = end * moments::<1>(a - b).1[0];
    let mut all = [c64::new(0.0, 0.0); COUNT];
    if a.norm_sqr() > NEAR * NEAR {
        let inverse = a.inv();
        let mut above = whole;
        for (k, (difference, other)) in all.iter_mut().zip(&others).enumerate() {
            *difference = (above - other) * inverse;
            above = *difference * (k + 1) as f64;
        }
    } else {
        // The divided difference of z^j is the sum of all products of j − 1 factors a or b.
        let (both, product) = (a + b, a * b);
        let (mut before, mut now) = (c64::new(0.0, 0.0), c64::new(1.0, 0.0));
        let (mut scale, mut sum) = (1.0 / COUNT as f64, c64::new(0.0, 0.0));
        for j in 1..TERMS {
            scale /= (COUNT + j) as f64;
            sum += now * scale;
            (before, now) = (now, both * now - product * before);
        }
        all[COUNT - 1] = sum;
        for k in (1..COUNT).rev() {
            all[k - 1] = (a * all[k] + others[k]) * (1.0 / k as f64);
        }
    }
    (whole, all)
}

/// `v(h)` after a `memory` v(0), under the force with the coefficients `f_k`.
#[inline(always)]
pub fn driven<const COUNT: usize>(s: c64, memory: c64, force: &[f64; COUNT], h: f64) -> c64 {
    joined(&moments(s * h), memory, force, h)
}

/// What [`driven`] returns, from the [`moments`] of `sh`.
#[inline(always)]
pub fn joined<const COUNT: usize>(
    (whole, all): &(c64, [c64; COUNT]),
    memory: c64,
    force: &[f64; COUNT],
    h: f64,
) -> c64 {
    let mut sum = whole * memory;
    for (f, moment) in force.iter().zip(all) {
        sum += moment * (h * f);
    }
    sum
}

/// `∫∫F dt²` and `∫F dt` over the time h: the displacement and the speed of a unit mass under the force with the
/// coefficients `f_k`.
#[inline(always)]
pub fn pushed<const COUNT: usize>(force: &[f64; COUNT], h: f64) -> [f64; 2] {
    let mut sum = [0.0; 2];
    for (k, f) in force.iter().enumerate() {
        let next = (k + 1) as f64;
        sum[0] += h * h * f / (next * (next + 1.0));
        sum[1] += h * f / next;
    }
    sum
}

/// Coefficients of the same polynomial if the unit of time is that share of its present one.
#[inline(always)]
pub fn shortened<const COUNT: usize>(mut force: [f64; COUNT], share: f64) -> [f64; COUNT] {
    let mut scale = 1.0;
    for f in &mut force {
        *f *= scale;
        scale *= share;
    }
    force
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A number of 32 digits as a sum of two (Knuth's two-sum, and a product by `fma`).
    #[derive(Clone, Copy)]
    struct Twice(f64, f64);

    impl Twice {
        fn sum(a: f64, b: f64) -> Self {
            let sum = a + b;
            let part = sum - a;
            Self(sum, (a - (sum - part)) + (b - part))
        }

        fn plus(self, other: Self) -> Self {
            let (high, low) = (Self::sum(self.0, other.0), Self::sum(self.1, other.1));
            let high = Self::sum(high.0, high.1 + low.0);
            Self::sum(high.0, high.1 + low.1)
        }

        fn times(self, other: Self) -> Self {
            let product = self.0 * other.0;
            let rest = self.0.mul_add(other.0, -product);
            Self::sum(product, rest + self.0 * other.1 + self.1 * other.0)
        }

        fn over(self, divisor: f64) -> Self {
            let quotient = self.0 / divisor;
            let rest = (-quotient).mul_add(divisor, self.0) + self.1;
            Self::sum(quotient, rest / divisor)
        }
    }

    /// A complex number of 32 digits.
    #[derive(Clone, Copy)]
    struct Exact(Twice, Twice);

    impl Exact {
        fn of(z: c64) -> Self {
            Self(Twice(z.re, 0.0), Twice(z.im, 0.0))
        }

        fn plus(self, other: Self) -> Self {
            Self(self.0.plus(other.0), self.1.plus(other.1))
        }

        fn times(self, other: Self) -> Self {
            let minus = |a: Twice| Twice(-a.0, -a.1);
            let re = self.0.times(other.0).plus(minus(self.1.times(other.1)));
            Self(re, self.0.times(other.1).plus(self.1.times(other.0)))
        }

        fn over(self, divisor: f64) -> Self {
            Self(self.0.over(divisor), self.1.over(divisor))
        }

        fn near(self) -> c64 {
            c64::new(self.0.0 + self.0.1, self.1.0 + self.1.1)
        }
    }

    const COUNT: usize = 5;

    /// `e^z` and `E_k` by extended sums: power series at `z/2^m`, then m times both halves of the
    /// integral, `E_k(2z) = 2^{−k−1} (e^z E_k(z) + Σ_j (k over j) E_j(z))`.
    fn extended(z: c64) -> (Exact, [Exact; COUNT]) {
        let mut doublings = 0;
        while z.norm() * 0.5_f64.powi(doublings) > 0.5 {
            doublings += 1;
        }
        let small = Exact::of(z * 0.5_f64.powi(doublings));
        // Σ z^j k!/(k + 1 + j)!, and Σ z^j/j!.
        let series = |from: usize, first: Exact| {
            let (mut term, mut sum) = (first, first);
            for j in 1..30 {
                term = term.times(small).over((from + j) as f64);
                sum = sum.plus(term);
            }
            sum
        };
        let one = Exact::of(c64::new(1.0, 0.0));
        let mut whole = series(0, one);
        let mut all: [Exact; COUNT] =
            std::array::from_fn(|k| series(k + 1, one.over((k + 1) as f64)));
        for _ in 0..doublings {
            all = std::array::from_fn(|k| {
                let (mut sum, mut choose) = (whole.times(all[k]), 1.0);
                for (j, moment) in all[..=k].iter().enumerate() {
                    sum = sum.plus(moment.times(Exact::of(c64::new(choose, 0.0))));
                    choose *= (k - j) as f64 / (j + 1) as f64;
                }
                sum.over(2.0_f64.powi(k as i32 + 1))
            });
            whole = whole.times(whole);
        }
        (whole, all)
    }

    /// Magnitudes from zero to a million, at all angles of the left half plane.
    fn left_half_plane() -> impl Iterator<Item = c64> {
        let sizes = (-40..=48).map(|k| 10.0_f64.powf(f64::from(k) / 8.0));
        let sizes = sizes.chain([0.0, 0.999 * NEAR, 1.001 * NEAR]);
        sizes.flat_map(|size| {
            (0..=16).map(move |k| {
                let angle = std::f64::consts::FRAC_PI_2 * (1.0 + f64::from(k) / 16.0);
                // The axes themselves, where cosine and sine would leave some round-off.
                let cos = if k == 0 { 0.0 } else { angle.cos() };
                c64::new(size * cos, if k == 16 { 0.0 } else { size * angle.sin() })
            })
        })
    }

    /// Relative to the size of the integral: at most `1/(k + 1)`, and `1/|z|`.
    #[test]
    fn moments_have_all_digits_in_the_whole_left_half_plane() {
        for z in left_half_plane() {
            let ((whole, all), (exact_whole, exact)) = (moments::<COUNT>(z), extended(z));
            let off = (whole - exact_whole.near()).norm();
            assert!(off <= 8e-16 * exact_whole.near().norm().max(f64::MIN_POSITIVE), "{z} {off}");
            for (k, (moment, exact)) in all.iter().zip(exact).enumerate() {
                let size = 1.0 / z.norm().max((k + 1) as f64);
                let off = (moment - exact.near()).norm() / size;
                assert!(off < 4e-15, "{z} {k} {off:e}");
            }
        }
    }

    /// Compared with the exact functions where a and b are far apart, and with their derivative `E_k − E_{k+1}` where
    /// they coincide.
    #[test]
    fn divided_differences_have_all_digits_for_every_pair_of_poles() {
        for a in left_half_plane().filter(|a| a.norm() > 1e-3) {
            let (_, exact) = extended(a);
            let (whole, all) = differences::<3>(a, a);
            // Relative to its size: 1/|a|², and |e^b|/|a|.
            let far = |found: c64, exact: c64, b: c64, k: usize| {
                let size = a.norm().max((k + 1) as f64);
                (found - exact).norm() * size * size / (1.0 + b.re.exp() * size)
            };
            assert!((whole - extended(a).0.near()).norm() < 1e-15, "{a}");
            for k in 0..3 {
                let minus = Exact::of(c64::new(-1.0, 0.0)).times(exact[k + 1]);
                let derivative = exact[k].plus(minus).near();
                assert!(far(all[k], derivative, a, k) < 2e-14, "{a} {k} {} {derivative}", all[k]);
            }
            // An oscillator's poles: a pair that oscillates, or two that creep.
            let b = if a.im == 0.0 { a * 0.25 } else { a.conj() };
            if (a - b).norm() > 0.1 * a.norm() {
                let (other_whole, other) = extended(b);
                let minus = |a: Exact, b: Exact| a.plus(Exact::of(c64::new(-1.0, 0.0)).times(b));
                let apart = a - b;
                let (whole, all) = differences::<3>(a, b);
                let exact_whole = minus(extended(a).0, other_whole).near() / apart;
                assert!((whole - exact_whole).norm() * a.norm().max(1.0) < 2e-14, "{a} {b}");
                for k in 0..3 {
                    let exact = minus(exact[k], other[k]).near() / apart;
                    assert!(far(all[k], exact, b, k) < 1e-13, "{a} {b} {k} {} {exact}", all[k]);
                }
            }
        }
    }

    #[test]
    fn a_force_does_the_same_in_one_step_or_in_parts() {
        let (force, h) = ([3.0, -1.0, 2.0, 0.5, -4.0], 0.7);
        let (s, memory) = (c64::new(-0.4, 9.0), c64::new(0.2, -0.1));
        let part = shortened(force, 0.5);
        let end: f64 = force.iter().sum();
        // The second half, by Taylor at its beginning.
        let derivative = |n: usize| -> f64 {
            let falling = |k: usize| (k + 1 - n..=k).map(|i| i as f64).product::<f64>();
            let factorial = (1..=n).map(|i| i as f64).product::<f64>();
            (n..COUNT).map(|k| force[k] * falling(k) * 0.5_f64.powi((k - n) as i32)).sum::<f64>()
                / factorial
        };
        let second: [f64; COUNT] = shortened(std::array::from_fn(derivative), 0.5);
        assert!((second.iter().sum::<f64>() - end).abs() < 1e-14);
        let whole = driven(s, memory, &force, h);
        let parts = driven(s, driven(s, memory, &part, 0.5 * h), &second, 0.5 * h);
        assert!((whole - parts).norm() < 1e-15);
        let ([by, faster], [first, speed], [then, more]) =
            (pushed(&force, h), pushed(&part, 0.5 * h), pushed(&second, 0.5 * h));
        assert!((by - first - 0.5 * h * speed - then).abs() < 1e-15);
        assert!((faster - speed - more).abs() < 1e-15);
    }
}
