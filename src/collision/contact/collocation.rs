//! How a force in time moves a mode, exactly: the force of a step is a polynomial through Lobatto's
//! points, and what it does to `e^{st}` are moments that have closed forms.

/// Points of a step, both ends included.
pub const POINTS: usize = 5;

/// Lobatto's points in [0, 1] and the polynomials that are 1 at one of them and 0 at the others.
#[derive(Debug, Clone)]
pub struct Lobatto {
    /// Lobatto's points, from 0 to 1.
    pub at: [f64; POINTS],
    /// `[j][k]`: the coefficient of `s^k` in the polynomial of point j.
    pub powers: [[f64; POINTS]; POINTS],
    /// Parts of the values in the coefficients of the last three shifted Legendre polynomials, of
    /// degree 2, 3 and 4.
    pub last: [[f64; POINTS]; 3],
    /// `∫₀¹` of the polynomials.
    pub weights: [f64; POINTS],
    /// `[i][j]`: `∫₀^{s_i} (s_i − s) L_j ds`.
    pub twice: [[f64; POINTS]; POINTS],
}

impl Default for Lobatto {
    /// The ends, and the zeros of the derivative of Legendre's `P_4`: `½` and `½ ± ½√(3/7)`.
    fn default() -> Self {
        let beside = 0.5 * (3.0_f64 / 7.0).sqrt();
        let at = [0.0, 0.5 - beside, 0.5, 0.5 + beside, 1.0];
        let mut powers = [[0.0; POINTS]; POINTS];
        for j in 0..POINTS {
            powers[j][0] = 1.0;
            for (degree, other) in (0..POINTS).filter(|k| *k != j).enumerate() {
                // Times (s − s_k)/(s_j − s_k).
                let scale = 1.0 / (at[j] - at[other]);
                for k in (0..=degree + 1).rev() {
                    let below = if k > 0 { powers[j][k - 1] } else { 0.0 };
                    powers[j][k] = scale * (below - at[other] * powers[j][k]);
                }
            }
        }
        // 6 s² − 6 s + 1, 20 s³ − 30 s² + 12 s − 1 and 70 s⁴ − 140 s³ + 90 s² − 20 s + 1, the last first.
        let fourth = powers.map(|p| p[4] / 70.0);
        let third: [f64; POINTS] =
            std::array::from_fn(|j| (powers[j][3] + 140.0 * fourth[j]) / 20.0);
        let second =
            std::array::from_fn(|j| (powers[j][2] - 90.0 * fourth[j] + 30.0 * third[j]) / 6.0);
        let last = [second, third, fourth];
        let over = |p: [f64; POINTS], f: &dyn Fn(f64) -> f64| -> f64 {
            p.iter().enumerate().map(|(k, c)| c * f(k as f64)).sum()
        };
        let weights = powers.map(|p| over(p, &|k| 1.0 / (k + 1.0)));
        let twice =
            at.map(|s| powers.map(|p| over(p, &|k| s.powf(k + 2.0) / ((k + 1.0) * (k + 2.0)))));
        Self { at, powers, last, weights, twice }
    }
}

impl Lobatto {
    /// Coefficients of the powers of `s` of the polynomial through those values.
    #[inline(always)]
    pub fn through(&self, values: &[f64; POINTS]) -> [f64; POINTS] {
        let mut sum = [0.0; POINTS];
        for (value, powers) in values.iter().zip(&self.powers) {
            for (sum, p) in sum.iter_mut().zip(powers) {
                *sum += value * p;
            }
        }
        sum
    }
}

/// Numbers taken side by side.
pub const LANES: usize = 4;

/// Numbers by lanes.
#[inline(always)]
pub fn lanes(all: &[f64]) -> &[[f64; LANES]] {
    all.as_chunks().0
}

/// The sum over all lanes of so many chunks.
#[inline(always)]
pub fn total(chunks: usize, part: impl Fn(usize, usize) -> f64) -> f64 {
    let mut sums = [0.0; LANES];
    for k in 0..chunks {
        for (l, sum) in sums.iter_mut().enumerate() {
            *sum += part(k, l);
        }
    }
    sum(sums)
}

/// The sum of a chunk.
#[inline(always)]
pub fn sum(lanes: [f64; LANES]) -> f64 {
    (lanes[0] + lanes[1]) + (lanes[2] + lanes[3])
}

/// The value of a polynomial with those coefficients.
#[inline(always)]
pub fn polynomial(coefficients: &[f64; POINTS], s: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * s + c)
}

/// A complex number as its real and imaginary part.
pub type Pair = [f64; 2];

/// `a b`.
#[inline(always)]
pub fn times(a: Pair, b: Pair) -> Pair {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

/// `e^z` and `E_k = ∫₀¹ e^{z(1−s)} s^k ds` for k below `COUNT`.
///
/// By parts `z E_k = k E_{k−1} − 1`, upwards where z is large; else the last one is a power series,
/// and the others follow downwards. Both ways round-off is not raised.
#[inline(always)]
pub fn moments<const COUNT: usize>(z: Pair) -> (Pair, [Pair; COUNT]) {
    /// Terms of the series: 1.5^18/(18!) is below ε.
    const TERMS: usize = 20;
    let size = if z[0] == 0.0 { 1.0 } else { z[0].exp() };
    let (sin, cos) = z[1].sin_cos();
    let whole = [size * cos, size * sin];
    let mut all = [[0.0; 2]; COUNT];
    let square = z[0] * z[0] + z[1] * z[1];
    if square > 2.25 {
        let inverse = [z[0] / square, -z[1] / square];
        let mut above = [whole[0] - 1.0, whole[1]];
        for (k, moment) in all.iter_mut().enumerate() {
            *moment = times(above, inverse);
            let next = (k + 1) as f64;
            above = [next * moment[0] - 1.0, next * moment[1]];
        }
    } else {
        let mut term = [1.0 / COUNT as f64, 0.0];
        let mut sum = term;
        for j in 1..TERMS {
            let scale = 1.0 / (COUNT + j) as f64;
            term = times(term, [z[0] * scale, z[1] * scale]);
            sum = [sum[0] + term[0], sum[1] + term[1]];
            if term[0].abs() + term[1].abs() < 1e-18 {
                break;
            }
        }
        all[COUNT - 1] = sum;
        for k in (1..COUNT).rev() {
            let part = times(z, all[k]);
            let scale = 1.0 / k as f64;
            all[k - 1] = [(1.0 + part[0]) * scale, part[1] * scale];
        }
    }
    (whole, all)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::quadrature::gauss;

    #[test]
    fn the_points_integrate_what_lobatto_s_do() {
        // Degree 2 n − 3 = 7 and no further.
        let rule = Lobatto::default();
        for degree in 0..=8_i32 {
            let sum: f64 = rule.at.iter().zip(&rule.weights).map(|(s, w)| w * s.powi(degree)).sum();
            let exact = 1.0 / f64::from(degree + 1);
            assert_eq!((sum - exact).abs() < 1e-14, degree < 8, "{degree} {sum}");
        }
    }

    #[test]
    fn a_polynomial_goes_through_its_values() {
        let rule = Lobatto::default();
        let f = |s: f64| 1.0 - 2.0 * s + 3.0 * s.powi(3) - s.powi(4);
        let through = rule.through(&rule.at.map(f));
        for s in [0.0, 0.3, 0.77, 1.0] {
            assert!((polynomial(&through, s) - f(s)).abs() < 1e-14);
        }
        // s³ = P₃/20 + P₂/4 + …, s⁴ = P₄/70 + P₃/10 + 2 P₂/7 + …
        let part = |last: &[f64; POINTS]| -> f64 {
            rule.at.map(f).iter().zip(last).map(|(f, l)| f * l).sum()
        };
        let exact = [3.0 / 4.0 - 2.0 / 7.0, 3.0 / 20.0 - 1.0 / 10.0, -1.0 / 70.0];
        for (last, exact) in rule.last.iter().zip(exact) {
            assert!((part(last) - exact).abs() < 1e-14);
        }
        // ∫ (s − t) t³ dt = s⁵/20.
        for (i, s) in rule.at.into_iter().enumerate() {
            let sum: f64 = (0..POINTS).map(|j| rule.twice[i][j] * rule.at[j].powi(3)).sum();
            assert!((sum - s.powi(5) / 20.0).abs() < 1e-15);
        }
    }

    #[test]
    fn moments_are_integrals() {
        let points = gauss(40);
        for z in [[0.0, 1e-9], [-0.1, 0.3], [0.0, 1.49], [0.0, 1.51], [-0.4, 6.0], [-2.0, 30.0]] {
            let (whole, all) = moments::<5>(z);
            let exponential = |s: f64| {
                let size = (z[0] * s).exp();
                [size * (z[1] * s).cos(), size * (z[1] * s).sin()]
            };
            for part in 0..2 {
                assert!((whole[part] - exponential(1.0)[part]).abs() < 1e-15);
                for (k, moment) in all.iter().enumerate() {
                    let value =
                        |(s, w): &(f64, f64)| w * exponential(1.0 - s)[part] * s.powi(k as i32);
                    let sum: f64 = points.iter().map(value).sum();
                    assert!((moment[part] - sum).abs() < 2e-15, "{z:?} {k} {part}");
                }
            }
        }
    }
}
