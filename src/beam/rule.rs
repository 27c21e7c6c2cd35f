//! Where is an element sampled? Gauss points, and the tables that depend on them alone.

use std::sync::OnceLock;

use crate::base::quadrature::legendre;
use crate::base::{Real, gauss};
use crate::bat::{Bat, Cubics, Radii, Section};

/// Lowest and highest degree of the elements' deflection.
pub const DEGREES: std::ops::RangeInclusive<usize> = 3..=12;

/// Gauss points of an element of one degree, with tables for integrals of functions given there.
#[derive(Debug)]
pub struct Rule {
    /// The points, from left to right.
    pub points: Vec<GaussPoint>,
    /// Their places as ξ, from −1 to 1.
    pub xi: Vec<f64>,
    /// `P_0 … P_{N−1}` at the points, point by point; `N` is the degree plus 1.
    legendre: Vec<f64>,
    /// `P_0 … P_{N−1}` at the points, polynomial by polynomial.
    by_term: Vec<f64>,
    /// `∫₀^{s_j} (s_j − s) ℓ_i(s) ds`, `[i][j]`: twice integrated from the left end, for a
    /// function given at the points (`ℓ_i` the polynomial that is 1 at point `i`, 0 at the others).
    pub twice_from_left: Vec<f64>,
    /// `∫_{s_j}^1 (s − s_j) ℓ_i(s) ds`, `[i][j]`: twice integrated from the right end.
    pub twice_from_right: Vec<f64>,
    /// `∫₀^{s_j} ℓ_i(s) ds`, `[i][j]`: once integrated from the left end.
    pub once_from_left: Vec<f64>,
    /// `∫_{s_j}^1 ℓ_i(s) ds`, `[i][j]`: once integrated from the right end.
    pub once_from_right: Vec<f64>,
    /// Weights that give the last two coefficients of the Legendre series through the points.
    last: [Vec<f64>; 2],
    /// `(2k + 1) P_k` at the points, polynomial by polynomial, up to twice the degree: turns moments `∫₀¹ f P_k ds`
    /// into the polynomial that has them. For rules on elements over stations.
    pub from_moments: Vec<f64>,
}

/// Number of points computed together; the tables are filled up to a multiple of it.
const BLOCK: usize = 4;
/// Room for a number at every point of any rule; entries beyond its last point are not used.
pub const MOST_POINTS: usize = 32;

/// One Gauss point.
#[derive(Debug, Clone, Copy)]
pub struct GaussPoint {
    /// Position along the element, in (0, 1).
    pub s: f64,
    /// Weight of the point; all weights of a rule add up to 1.
    pub weight: f64,
    /// Values of the four cubic Bernstein polynomials at the point.
    pub bernstein: [f64; 4],
}

impl GaussPoint {
    /// The point with that place in (0, 1) and that weight.
    pub fn new((s, weight): (f64, f64)) -> Self {
        let t = 1.0 - s;
        let bernstein = [t * t * t, 3.0 * s * t * t, 3.0 * s * s * t, s * s * s];
        Self { s, weight, bernstein }
    }

    /// The section there between the ends of these cubics.
    #[inline(always)]
    pub fn section(&self, cubics: &Cubics) -> Section {
        let v = &self.bernstein;
        let radius = |b: &[f64; 4]| (b[0] * v[0] + b[1] * v[1]) + (b[2] * v[2] + b[3] * v[3]);
        let inner = if cubics.inner == [0.0; 4] { 0.0 } else { radius(&cubics.inner) };
        Section { outer: radius(&cubics.outer), inner }
    }
}

/// Kinds of profile: constant, linear and cubic radii, formulas, and elements over stations.
const KINDS: usize = 5;
/// Points for a formula beyond the degree of the deflection.
const FOR_FORMULAS: usize = 16;

impl Rule {
    /// The rule for elements of that degree on this bat.
    ///
    /// With radii of degree `d` and deflections of degree `p`, the load `ρA w` has degree `2d + p`. One point more than
    /// that represents it exactly, and then the mass too. The stiffness `∫EI P_{p−2}²` has degree `4d + 2p − 4`, and
    /// `n` points integrate degree `2n − 1` exactly. Formulas get 16 points beyond the degree; [`Rule::tail`] tells
    /// whether these are enough.
    ///
    /// On elements `over` stations a section is a polynomial of degree 2p with the true moments up to that degree
    /// ([`crate::beam::sections::over`]). It therefore gives the exact `∫EI P_{p−2}²` and `∫ρA P_p²`: the points
    /// integrate products of degree 4p.
    pub fn of(bat: &Bat, over: bool, degree: usize) -> &'static Self {
        static RULES: [OnceLock<Rule>; KINDS * 16] = [const { OnceLock::new() }; KINDS * 16];
        let mut pieces = bat.profile().pieces.iter();
        let radii = pieces.try_fold(0, |most: usize, piece| match &piece.radii {
            Radii::Cubic(cubics) => Some(most.max(cubics.degree)),
            Radii::Formula(_) => None,
        });
        let kind = if over { KINDS - 1 } else { radii.map_or(KINDS - 2, |radii| radii.min(2)) };
        RULES[KINDS * degree + kind].get_or_init(|| match radii {
            _ if over => Self::over_stations(degree),
            Some(radii) => Self::new(degree + 1, (2 * radii + degree + 1).max(degree + 3)),
            None => Self::new(degree + 1, degree + FOR_FORMULAS),
        })
    }

    /// A rule for elements of that degree over stations.
    fn over_stations(degree: usize) -> Self {
        let moments = 2 * degree + 1;
        let mut rule = Self::new(degree + 1, moments.max(degree + 7));
        let (stride, mut table) = (rule.stride(), vec![0.0; moments * rule.stride()]);
        for (j, point) in rule.points.iter().enumerate() {
            for (k, p) in legendre(moments, 2.0 * point.s - 1.0).iter().take(moments).enumerate() {
                table[k * stride + j] = (2 * k + 1) as f64 * p;
            }
        }
        rule.from_moments = table;
        rule
    }

    /// Number of moments that describe a section on an element over stations; 0 for another rule.
    #[inline(always)]
    pub fn moments_of_sections(&self) -> usize {
        self.from_moments.len() / self.stride()
    }

    /// `count` points for `terms` Legendre polynomials.
    fn new(terms: usize, count: usize) -> Self {
        let places = gauss(count);
        let at: Vec<Vec<f64>> =
            places.iter().map(|(s, _)| legendre(count.max(terms) + 2, 2.0 * s - 1.0)).collect();
        let legendre = at.iter().flat_map(|p| p[..terms].to_vec()).collect();
        let stride = count.next_multiple_of(BLOCK);
        let padded = |f: &dyn Fn(usize) -> f64| -> Vec<f64> {
            (0..stride).map(|j| if j < count { f(j) } else { 0.0 }).collect()
        };
        let by_term = (0..terms).flat_map(|k| padded(&|j| at[j][k])).collect();
        // ℓ_i = Σ_k (2k + 1) weight_i P_k(ξ_i) P_k, and the integrals of P_k over ξ from −1.
        let once = |p: &[f64], k: usize| match k {
            0 => p[1] + p[0],
            _ => (p[k + 1] - p[k - 1]) / (2 * k + 1) as f64,
        };
        let twice = |p: &[f64], k: usize| match k {
            0 => once(p, 1) + once(p, 0),
            _ => (once(p, k + 1) - once(p, k - 1)) / (2 * k + 1) as f64,
        };
        let integral = |j: usize, i: usize, of: &dyn Fn(&[f64], usize) -> f64| {
            let term = |k: usize| (2 * k + 1) as f64 * at[i][k] * of(&at[j], k);
            places[i].1 * (0..count).map(term).sum::<f64>()
        };
        let entry = |j: usize, i: usize| 0.25 * integral(j, i, &twice);
        let simple = |j: usize, i: usize| 0.5 * integral(j, i, &once);
        let table = |entry: &dyn Fn(usize, usize) -> f64| -> Vec<f64> {
            (0..count).flat_map(|i| padded(&|j| entry(j, i))).collect()
        };
        let twice_from_left = table(&entry);
        let twice_from_right = table(&|j, i| entry(count - 1 - j, count - 1 - i));
        let once_from_left = table(&simple);
        let once_from_right = table(&|j, i| simple(count - 1 - j, count - 1 - i));
        let last = [count - 2, count - 1].map(|k| {
            let weight = |i: usize| (2 * k + 1) as f64 * places[i].1 * at[i][k];
            (0..count).map(weight).collect()
        });
        Self {
            xi: places.iter().map(|(s, _)| 2.0 * s - 1.0).collect(),
            points: places.into_iter().map(GaussPoint::new).collect(),
            legendre,
            by_term,
            twice_from_left,
            twice_from_right,
            once_from_left,
            once_from_right,
            last,
            from_moments: vec![],
        }
    }

    /// Number of points.
    #[inline(always)]
    pub fn count(&self) -> usize {
        self.points.len()
    }

    /// Length of a row of the tables.
    #[inline(always)]
    fn stride(&self) -> usize {
        self.points.len().next_multiple_of(BLOCK)
    }

    /// The Legendre polynomials at one point, one for each coefficient of a deflection.
    #[inline(always)]
    pub fn polynomials(&self, point: usize, terms: usize) -> &[f64] {
        &self.legendre[terms * point..][..terms]
    }

    /// The `N` Legendre polynomials at one point.
    #[inline(always)]
    pub fn at<const N: usize>(&self, point: usize) -> &[f64; N] {
        self.polynomials(point, N).try_into().expect("a slice of that length")
    }

    /// The values at the points of `Σ c_k P_k`.
    #[inline(always)]
    pub fn values<R: Real>(&self, coefficients: &[R], values: &mut [R; MOST_POINTS]) {
        self.combine(&self.by_term, coefficients, values);
    }

    /// `Σ_i f_i P_k` of numbers at the points, for the polynomials that fit into `moments`: the work of loads there on
    /// `Σ c_k P_k`.
    pub fn moments(&self, values: &[f64], moments: &mut [f64]) {
        let rows = self.by_term.chunks_exact(self.stride());
        for (moment, row) in moments.iter_mut().zip(rows) {
            *moment = row.iter().zip(&values[..self.count()]).map(|(p, f)| p * f).sum();
        }
    }

    /// The Legendre coefficients of a function given at the points, as many as fit.
    pub fn coefficients<R: Real>(&self, values: &[R], coefficients: &mut [R]) {
        let rows = self.by_term.chunks_exact(self.stride());
        for (k, (coefficient, row)) in coefficients.iter_mut().zip(rows).enumerate() {
            *coefficient = R::default();
            for ((point, value), p) in self.points.iter().zip(values).zip(row) {
                *coefficient += *value * R::splat((2 * k + 1) as f64 * point.weight * p);
            }
        }
    }

    /// `Σ parts[k] rows[k]` with the rows of a table: its transform of a function given at the points.
    #[inline(always)]
    pub fn combine<R: Real>(&self, rows: &[f64], parts: &[R], sums: &mut [R; MOST_POINTS]) {
        let stride = self.stride();
        // Four points at a time stay in registers during the pass over the parts.
        for first in (0..stride).step_by(BLOCK) {
            let mut sum = [R::default(); BLOCK];
            for (row, part) in rows.chunks_exact(stride).zip(parts) {
                for (sum, value) in sum.iter_mut().zip(&row[first..first + BLOCK]) {
                    *sum += R::splat(*value) * *part;
                }
            }
            sums[first..first + BLOCK].copy_from_slice(&sum);
        }
    }

    /// The last two coefficients of the Legendre series through values at the points, relative to
    /// the largest value.
    pub fn tail(&self, values: &[f64]) -> f64 {
        let largest = values[..self.count()].iter().fold(0.0_f64, |most, v| most.max(v.abs()));
        let coefficient = |weights: &Vec<f64>| -> f64 {
            weights.iter().zip(values).map(|(weight, v)| weight * v).sum()
        };
        (coefficient(&self.last[0]).abs() + coefficient(&self.last[1]).abs()) / largest
    }

    /// `∫ f ds` and `∫ f s ds` over the element of a function given at the points.
    #[inline(always)]
    pub fn integrals<R: Real>(&self, values: &[R]) -> [R; 2] {
        let [mut whole, mut first] = [R::default(); 2];
        for (point, value) in self.points.iter().zip(values) {
            let share = R::splat(point.weight) * *value;
            whole += share;
            first += R::splat(point.s) * share;
        }
        [whole, first]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_are_integrated_once_and_twice_exactly_from_both_ends() {
        let rule = Rule::new(5, 9);
        for power in 0..9 {
            let n = f64::from(power);
            let values: Vec<f64> = rule.points.iter().map(|p| p.s.powi(power)).collect();
            let [mut left, mut right] = [[0.0; MOST_POINTS]; 2];
            rule.combine(&rule.once_from_left, &values, &mut left);
            rule.combine(&rule.once_from_right, &values, &mut right);
            for (at, (left, right)) in rule.points.iter().zip(left.iter().zip(right)) {
                let exact = at.s.powf(n + 1.0) / (n + 1.0);
                assert!((left - exact).abs() < 1e-15);
                assert!((right - (1.0 / (n + 1.0) - exact)).abs() < 1e-15);
            }
            rule.combine(&rule.twice_from_left, &values, &mut left);
            rule.combine(&rule.twice_from_right, &values, &mut right);
            for (at, (left, right)) in rule.points.iter().zip(left.iter().zip(right)) {
                let s = at.s;
                let exact = s.powf(n + 2.0) / ((n + 1.0) * (n + 2.0));
                assert!((left - exact).abs() < 1e-15);
                let exact = 1.0 / (n + 2.0) - s / (n + 1.0) + exact;
                assert!((right - exact).abs() < 1e-15);
            }
        }
    }
}
