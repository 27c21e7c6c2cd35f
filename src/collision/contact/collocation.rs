//! The points of a step, and the force through them: a polynomial, so that the motion of a mode under it is exact
//! ([`crate::motion::phi`]). Several modes are computed side by side.

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
        for j in 0..POINTS {
            for k in 0..POINTS {
                sum[k] += values[j] * self.powers[j][k];
            }
        }
        sum
    }
}

/// Numbers taken side by side.
pub const LANES: usize = 4;

/// Numbers of some modes, side by side.
pub type Lanes = [f64; LANES];

/// The sum over the lanes.
#[inline(always)]
pub fn sum(lanes: Lanes) -> f64 {
    (lanes[0] + lanes[1]) + (lanes[2] + lanes[3])
}

/// The value of a polynomial with those coefficients.
#[inline(always)]
pub fn polynomial(coefficients: &[f64; POINTS], s: f64) -> f64 {
    let mut sum = 0.0;
    for k in (0..POINTS).rev() {
        sum = sum * s + coefficients[k];
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

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
}
