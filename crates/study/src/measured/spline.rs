//! A smooth curve through measured points: the natural cubic spline.
//!
//! The spline is straight beyond the first and the last point, and its curvature is zero there, because the ends of a
//! free bat have no bending moment.

/// A curve through points.
#[derive(Debug, Clone, PartialEq)]
pub struct Spline {
    x: Vec<f64>,
    values: Vec<f64>,
    /// Second derivatives at the points.
    bends: Vec<f64>,
}

impl Spline {
    /// Through values at rising places, two at least.
    ///
    /// The second derivatives `m` obey `h₀ m₀ + 2 (h₀ + h₁) m₁ + h₁ m₂ = 6 (slope₁ − slope₀)` at every
    /// inner point and are 0 at the ends.
    pub fn new(x: &[f64], values: &[f64]) -> Self {
        let n = x.len();
        let step = |k: usize| x[k + 1] - x[k];
        let slope = |k: usize| (values[k + 1] - values[k]) / step(k);
        // Elimination downwards, then upwards; the system is diagonally dominant.
        let (mut factors, mut bends) = (vec![0.0; n], vec![0.0; n]);
        for k in 1..n.saturating_sub(1) {
            let pivot = 2.0 * (step(k - 1) + step(k)) - step(k - 1) * factors[k - 1];
            factors[k] = step(k) / pivot;
            bends[k] = (6.0 * (slope(k) - slope(k - 1)) - step(k - 1) * bends[k - 1]) / pivot;
        }
        for k in (1..n.saturating_sub(1)).rev() {
            bends[k] -= factors[k] * bends[k + 1];
        }
        Self { x: x.to_vec(), values: values.to_vec(), bends }
    }

    /// Value and slope at a place.
    pub fn at(&self, x: f64) -> [f64; 2] {
        let last = self.x.len() - 1;
        let k = self.x.partition_point(|at| *at <= x).clamp(1, last) - 1;
        let inside = x.clamp(self.x[0], self.x[last]);
        let h = self.x[k + 1] - self.x[k];
        let (b, a) = ((inside - self.x[k]) / h, (self.x[k + 1] - inside) / h);
        let [left, right] = [self.bends[k], self.bends[k + 1]];
        let bent = ((a * a - 1.0) * a * left + (b * b - 1.0) * b * right) * h * h / 6.0;
        let value = a * self.values[k] + b * self.values[k + 1] + bent;
        let turned = ((3.0 * b * b - 1.0) * right - (3.0 * a * a - 1.0) * left) * h / 6.0;
        let slope = (self.values[k + 1] - self.values[k]) / h + turned;
        [value + slope * (x - inside), slope]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_kept_beyond_the_points_and_points_are_met() {
        let x = [0.1, 0.13, 0.4, 0.7, 0.8];
        let line = Spline::new(&x, &x.map(|x| 2.0 - 3.0 * x));
        for at in [0.0, 0.1, 0.2, 0.55, 0.8, 1.0] {
            let [value, slope] = line.at(at);
            assert!((value - (2.0 - 3.0 * at)).abs() < 1e-14 && (slope + 3.0).abs() < 1e-12);
        }
        let values = [1.0, -1.0, 0.5, 0.3, 2.0];
        let curve = Spline::new(&x, &values);
        assert!(x.iter().zip(values).all(|(x, v)| (curve.at(*x)[0] - v).abs() < 1e-15));
        // Two points are a line, and the slope is the derivative of the value.
        assert_eq!(Spline::new(&[0.0, 1.0], &[1.0, 3.0]).at(0.25), [1.5, 2.0]);
        for at in [0.05, 0.12, 0.3, 0.75, 0.9] {
            let h = 1e-6;
            let slope = (curve.at(at + h)[0] - curve.at(at - h)[0]) / (2.0 * h);
            assert!((slope - curve.at(at)[1]).abs() < 1e-6 * slope.abs().max(1.0));
        }
    }

    /// The error of a cubic spline is proportional to h⁴ if the ends have no curvature: here for a half wave of sin.
    #[test]
    fn a_finer_curve_is_nearer_by_the_fourth_power() {
        use std::f64::consts::PI;
        let error = |n: usize| {
            let x: Vec<f64> = (0..=n).map(|k| PI * k as f64 / n as f64).collect();
            let values: Vec<f64> = x.iter().map(|x| x.sin()).collect();
            let curve = Spline::new(&x, &values);
            let places = (0..1000).map(|k| PI * f64::from(k) / 999.0);
            places.map(|x| (curve.at(x)[0] - x.sin()).abs()).fold(0.0, f64::max)
        };
        let ratio = error(10) / error(20);
        assert!((ratio - 16.0).abs() < 1.0, "{ratio}");
    }
}
