//! Which polynomials describe a motion along and across an element?
//!
//! The two straight lines that are 1 at one end and 0 at the other, and integrated Legendre polynomials, which are 0 at
//! both ends: `N_k = (P_k − P_{k−2})/√(2(2k − 1))`, `N_k′ = √((2k − 1)/2) P_{k−1}`.
//!
//! # Source
//!
//! B. Szabó, I. Babuška, Finite Element Analysis (Wiley 1991), chapter 3: hierarchic shape functions.

use crate::base::quadrature::{gauss, legendre};

/// The shape functions of one degree at the points of a rule on [−1, 1].
#[derive(Debug, Clone)]
pub struct Shapes {
    /// Number of functions, the degree plus 1.
    pub count: usize,
    /// Places ξ of the points.
    pub places: Vec<f64>,
    /// Weights of the points, of sum 2.
    pub weights: Vec<f64>,
    /// Values at the points, point by point.
    pub values: Vec<f64>,
    /// Derivatives by ξ, point by point.
    pub slopes: Vec<f64>,
}

impl Shapes {
    /// Functions up to that degree at that number of Gauss points.
    pub fn new(degree: usize, points: usize) -> Self {
        let mut shapes = Self {
            count: degree + 1,
            places: vec![],
            weights: vec![],
            values: vec![],
            slopes: vec![],
        };
        for (s, weight) in gauss(points) {
            let [values, slopes] = at(degree, 2.0 * s - 1.0);
            shapes.places.push(2.0 * s - 1.0);
            shapes.weights.push(2.0 * weight);
            shapes.values.extend(values);
            shapes.slopes.extend(slopes);
        }
        shapes
    }

    /// The values at point `k`.
    pub fn value(&self, k: usize) -> &[f64] {
        &self.values[k * self.count..(k + 1) * self.count]
    }

    /// The derivatives at point `k`.
    pub fn slope(&self, k: usize) -> &[f64] {
        &self.slopes[k * self.count..(k + 1) * self.count]
    }
}

/// Values and derivatives by ξ of all functions up to that degree at one place.
pub fn at(degree: usize, xi: f64) -> [Vec<f64>; 2] {
    let p = legendre(degree + 1, xi);
    let mut values = vec![0.5 * (1.0 - xi), 0.5 * (1.0 + xi)];
    let mut slopes = vec![-0.5, 0.5];
    for k in 2..=degree {
        let size = (2 * k - 1) as f64;
        values.push((p[k] - p[k - 2]) / (2.0 * size).sqrt());
        slopes.push((0.5 * size).sqrt() * p[k - 1]);
    }
    [values, slopes]
}

/// The matrix from the coefficients of a polynomial on an element to those on a part of it, `[low, high]` in [−1, 1];
/// its rows belong to the part.
///
/// The coefficient of a bubble is `(2k − 1)/2 ∫ f′ P_{k−1} dξ / √((2k − 1)/2)` on the part, because Legendre
/// polynomials are orthogonal.
pub fn restricted(degree: usize, [low, high]: [f64; 2]) -> Vec<Vec<f64>> {
    let count = degree + 1;
    let mut rows = vec![at(degree, low)[0].clone(), at(degree, high)[0].clone()];
    rows.resize(count, vec![0.0; count]);
    for (s, weight) in gauss(count) {
        let part = 2.0 * s - 1.0;
        let whole = low + (high - low) * s;
        let slopes = &at(degree, whole)[1];
        let p = legendre(count, part);
        for k in 2..count {
            let size = (2 * k - 1) as f64;
            // dξ of the whole is (high − low)/2 times that of the part.
            let scale = (0.5 * size).sqrt() * p[k - 1] * 2.0 * weight * 0.5 * (high - low);
            rows[k].iter_mut().zip(slopes).for_each(|(row, slope)| *row += scale * slope);
        }
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_polynomial_is_the_same_on_a_part_of_its_element() {
        let (degree, part) = (6, [-0.3, 0.8]);
        let whole: Vec<f64> = (0..=degree).map(|k| ((5 * k + 3) % 7) as f64 - 3.0).collect();
        let rows = restricted(degree, part);
        let own: Vec<f64> =
            rows.iter().map(|row| row.iter().zip(&whole).map(|(a, b)| a * b).sum()).collect();
        let value = |coefficients: &[f64], xi: f64| -> f64 {
            at(degree, xi)[0].iter().zip(coefficients).map(|(a, b)| a * b).sum()
        };
        for k in 0..=10 {
            let s = f64::from(k) / 10.0;
            let there = value(&whole, part[0] + (part[1] - part[0]) * s);
            assert!((value(&own, 2.0 * s - 1.0) - there).abs() < 1e-14);
        }
    }

    #[test]
    fn slopes_are_those_of_the_values() {
        let (xi, step) = (0.37, 1e-6);
        let [before, after] = [at(8, xi - step), at(8, xi + step)].map(|[values, _]| values);
        for (k, slope) in at(8, xi)[1].iter().enumerate() {
            let difference = (after[k] - before[k]) / (2.0 * step);
            assert!((difference - slope).abs() < 1e-9, "{k} {difference} {slope}");
        }
    }
}
