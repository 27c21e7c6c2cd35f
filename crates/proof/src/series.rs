//! Which polynomials on [−1, 1] are known to within a bound?
//!
//! A [`Series`] `Σ c_j P_j(ξ)` with floating-point `c_j` and a radius represents every polynomial of that degree whose
//! distance from it is nowhere on [−1, 1] larger than the radius. [`Values`] are the values of such a polynomial at
//! Gauss points, each to within one radius. Operations use plain numbers, in any order, and their possible rounding is
//! added to the radius by a bound that is proven beforehand:
//!
//! - a sum of `n` products has an error of at most `γ_n Σ|a_i||b_i|`, `γ_n = nu/(1 − nu)`;
//! - `|P_j| ≤ 1`, and the numbers of a table have a relative error of at most `u`, so that a value at a point has an
//!   error of at most `(n + 2) u Σ|c_j|`;
//! - values with an error of at most `δ` at the points belong to a polynomial of degree `d` whose error is at most
//!   `(d + 1) δ` everywhere: with `‖e‖² = Σ w_g e_g² = ∫e²` and Cauchy's inequality,
//!   `|e(ξ)| ≤ ‖e‖ [Σ_{j ≤ d} (2j + 1)/2]^½ ≤ √2 δ (d + 1)/√2`;
//! - its coefficients `Σ_g q_jg v_g` have a rounding error of at most `(N + 2) u Σ_g |q_jg v_g|`, and that sum is at
//!   most `[(2j + 1)/2]^½ ‖v‖ ≤ (2j + 1)^½ max|v_g|`, by Cauchy's inequality again.
//!
//! Bounds are themselves computed in plain numbers, from sums and products of non-negative numbers. Each is enlarged by
//! `SLACK`, thousands of times their possible rounding.
//!
//! # Source
//!
//! N. J. Higham, Accuracy and Stability of Numerical Algorithms (2002), 3.1: `γ_n`. The use is that of Taylor
//! models (K. Makino, M. Berz, Int. J. Pure Appl. Math. 4 (2003) 379) with Legendre's polynomials.

use std::ops::{Add, Neg, Sub};

use sweetspot::base::interval::{Interval, UNIT};

use crate::gauss::Gauss;

/// Most coefficients of a series.
pub const MOST: usize = 40;
/// Share by which every bound is made larger than it was computed.
const SLACK: f64 = 1e-9;
/// Addition to every bound, for possible underflow.
const UNDERFLOW: f64 = 1e-290;

/// A bound that is certainly at least the exact result of these operations, from their result in plain numbers.
fn bound(computed: f64) -> f64 {
    // NaN must not pass for a bound.
    if computed >= 0.0 { computed * (1.0 + SLACK) + UNDERFLOW } else { f64::INFINITY }
}

/// All polynomials of a degree that on [−1, 1] are within `radius` of `Σ c_j P_j`.
#[derive(Debug, Clone, Copy)]
pub struct Series {
    coefficients: [f64; MOST],
    terms: usize,
    radius: f64,
}

/// Values of polynomials of a degree at Gauss points.
#[derive(Debug, Clone, Copy)]
pub struct Values<const N: usize> {
    /// The values, nearly.
    pub at: [f64; N],
    /// Largest error of each value.
    pub radius: f64,
    /// The degree of the polynomial.
    pub degree: usize,
}

impl Series {
    /// The polynomial with exactly these coefficients.
    pub fn exact(coefficients: &[f64]) -> Self {
        let mut all = [0.0; MOST];
        all[..coefficients.len()].copy_from_slice(coefficients);
        Self { coefficients: all, terms: coefficients.len(), radius: 0.0 }
    }

    /// Polynomials with coefficients in these intervals.
    pub fn of(coefficients: &[Interval]) -> Self {
        let mut series = Self::exact(&[]);
        series.terms = coefficients.len();
        for (c, of) in series.coefficients.iter_mut().zip(coefficients) {
            *c = of.middle();
            series.radius += of.distance(*c);
        }
        series.radius = bound(series.radius);
        series
    }

    /// The polynomial of degree `degree` with these values.
    ///
    /// # Panics
    ///
    /// If the number of points does not distinguish polynomials of that degree.
    pub fn through<const N: usize>(gauss: &Gauss<N>, values: &Values<N>) -> Self {
        Self::near(gauss, &values.at, values.degree, values.radius)
    }

    /// The polynomials of degree `degree` whose values at the points are within `radius` of these.
    pub fn near<const N: usize>(
        gauss: &Gauss<N>,
        at: &[f64; N],
        degree: usize,
        radius: f64,
    ) -> Self {
        assert!(degree < N, "{N} points do not tell polynomials of degree {degree} apart");
        let mut series = Self::exact(&[]);
        series.terms = degree + 1;
        let mut sizes = 0.0;
        for (j, row) in gauss.to_series[..=degree].iter().enumerate() {
            series.coefficients[j] = dot(row, at);
            sizes += (j as f64 + 0.5).sqrt();
        }
        let size = at.iter().fold(0.0, |most, value| f64::max(most, value.abs()));
        let rounding = (N + 2) as f64 * UNIT * sizes * 1.4143 * size;
        series.radius = bound((degree + 1) as f64 * radius + rounding);
        series
    }

    /// The degree.
    pub fn degree(&self) -> usize {
        self.terms.saturating_sub(1)
    }

    /// Coefficient `j`, without the radius.
    pub fn coefficient(&self, j: usize) -> f64 {
        self.coefficients[j]
    }

    /// Largest distance of a polynomial from the series.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    fn own(&self) -> &[f64] {
        &self.coefficients[..self.terms]
    }

    /// `Σ|c_j|`, which no value of the series exceeds.
    fn size(&self) -> f64 {
        self.own().iter().map(|c| c.abs()).sum()
    }

    /// A bound of the absolute value anywhere on [−1, 1].
    pub fn largest(&self) -> f64 {
        bound(self.size() + self.radius)
    }

    /// The values at the points.
    pub fn values<const N: usize>(&self, gauss: &Gauss<N>) -> Values<N> {
        let mut at = [0.0; N];
        for (c, row) in self.own().iter().zip(&gauss.legendre) {
            for (value, p) in at.iter_mut().zip(row) {
                *value += c * p;
            }
        }
        let rounding = (self.terms + 2) as f64 * UNIT * self.size();
        Values { at, radius: bound(self.radius + rounding), degree: self.degree() }
    }

    /// The series times a number.
    pub fn times(mut self, factor: Interval) -> Self {
        let middle = factor.middle();
        let off = factor.distance(middle);
        let size = self.size();
        self.coefficients[..self.terms].iter_mut().for_each(|c| *c *= middle);
        let of_factor = (off + UNIT * middle.abs()) * size;
        self.radius = bound((middle.abs() + off) * self.radius + of_factor);
        self
    }

    /// The series and a number more.
    pub fn plus(mut self, number: Interval) -> Self {
        self.terms = self.terms.max(1);
        let middle = number.middle();
        self.coefficients[0] += middle;
        let rounding = UNIT * self.coefficients[0].abs();
        self.radius = bound(self.radius + number.distance(middle) + rounding);
        self
    }

    /// The part up to a degree, with exactly these coefficients, and the largest distance of the series and of every
    /// polynomial that it represents.
    pub fn lowered(&self, degree: usize) -> (Self, f64) {
        let terms = self.terms.min(degree + 1);
        let rest: f64 = self.own()[terms..].iter().map(|c| c.abs()).sum();
        (Self::exact(&self.own()[..terms]), bound(self.radius + rest))
    }

    /// `∫_{−1}^ξ` of it: `∫P_j = (P_{j+1} − P_{j−1})/(2j + 1)`, which is 0 at both ends except for `j = 0`.
    ///
    /// # Panics
    ///
    /// If there is no room for the degree.
    pub fn integrated(&self) -> Self {
        let mut out = Self::exact(&[]);
        out.terms = self.terms + 1;
        assert!(out.terms <= MOST, "room for the integral's degree");
        let mut rounding = 0.0;
        for (j, c) in self.own().iter().enumerate() {
            let part = c / (2 * j + 1) as f64;
            out.coefficients[j + 1] += part;
            match j {
                0 => out.coefficients[0] += part,
                _ => out.coefficients[j - 1] -= part,
            }
            // The quotient, and one sum with another: each coefficient has two parts at most.
            rounding += 4.0 * UNIT * part.abs();
        }
        out.radius = bound(2.0 * self.radius + rounding);
        out
    }

    /// `∫_{−1}^1` of it.
    pub fn integral(&self) -> Interval {
        let twice = 2.0 * self.coefficients[0];
        Interval::point(twice) + Interval::within(bound(2.0 * self.radius))
    }

    /// `∫_{−1}^1` of its square, at most: `[(Σ 2c_j²/(2j + 1))^½ + √2 radius]²`.
    pub fn square_at_most(&self) -> f64 {
        let squares = self.own().iter().enumerate();
        let square: f64 = squares.map(|(j, c)| 2.0 * c * c / (2 * j + 1) as f64).sum();
        let root = bound(square).sqrt() + 1.5 * self.radius;
        bound(root * root)
    }

    /// `∫_{−1}^1` of the product with another: `Σ 2 c_j d_j/(2j + 1)`.
    pub fn inner(&self, other: &Self) -> Interval {
        let (mut sum, mut size) = (0.0, 0.0);
        for (j, (c, d)) in self.own().iter().zip(other.own()).enumerate() {
            let part = 2.0 * c * d / (2 * j + 1) as f64;
            sum += part;
            size += part.abs();
        }
        let rounding = (self.terms.min(other.terms) + 2) as f64 * 1.01 * UNIT * size;
        let (own, its) = (self.size() + self.radius, other.size() + other.radius);
        let off = 2.0 * (self.radius * its + own * other.radius);
        Interval::point(sum) + Interval::within(bound(rounding + off))
    }
}

impl Add for Series {
    type Output = Self;

    fn add(mut self, other: Self) -> Self {
        self.terms = self.terms.max(other.terms);
        let mut size = 0.0;
        for (c, of_other) in self.coefficients.iter_mut().zip(other.own()) {
            *c += of_other;
            size += c.abs();
        }
        self.radius = bound(self.radius + other.radius + UNIT * size);
        self
    }
}

impl Neg for Series {
    type Output = Self;

    fn neg(mut self) -> Self {
        self.coefficients.iter_mut().for_each(|c| *c = -*c);
        self
    }
}

impl Sub for Series {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<const N: usize> Values<N> {
    /// Values of a constant.
    pub fn constant(number: Interval) -> Self {
        let middle = number.middle();
        Self { at: [middle; N], radius: bound(number.distance(middle)), degree: 0 }
    }

    /// The values with a radius larger by that much.
    pub fn wider(mut self, off: f64) -> Self {
        self.radius = bound(self.radius + off);
        self
    }

    /// The largest absolute value.
    pub fn largest(&self) -> f64 {
        bound(self.size() + self.radius)
    }

    fn size(&self) -> f64 {
        self.at.iter().fold(0.0, |most, value| f64::max(most, value.abs()))
    }

    /// The values times those of another polynomial.
    pub fn product(&self, other: &Self) -> Self {
        let at = std::array::from_fn(|g| self.at[g] * other.at[g]);
        let (own, its) = (self.size(), other.size());
        let off = own * other.radius + (its + other.radius) * self.radius + UNIT * own * its;
        Self { at, radius: bound(off), degree: self.degree + other.degree }
    }

    /// The sum of the values and those of another.
    pub fn sum(&self, other: &Self) -> Self {
        let at = std::array::from_fn(|g| self.at[g] + other.at[g]);
        let size = self.size() + other.size();
        let radius = bound(self.radius + other.radius + 1.01 * UNIT * size);
        Self { at, radius, degree: self.degree.max(other.degree) }
    }

    /// The values less those of another.
    pub fn difference(&self, other: &Self) -> Self {
        self.sum(&Self { at: other.at.map(|value| -value), ..*other })
    }

    /// The values times a number.
    pub fn times(&self, factor: Interval) -> Self {
        let middle = factor.middle();
        let off = factor.distance(middle);
        let size = self.size();
        let radius = (middle.abs() + off) * self.radius + (off + UNIT * middle.abs()) * size;
        Self { at: self.at.map(|value| value * middle), radius: bound(radius), ..*self }
    }

    /// `∫_{−1}^1` of the polynomial.
    ///
    /// # Panics
    ///
    /// If the number of points does not integrate polynomials of that degree.
    pub fn integral(&self, gauss: &Gauss<N>) -> Interval {
        assert!(self.degree < 2 * N, "{N} points do not integrate degree {}", self.degree);
        let (sum, size) = (dot(&gauss.weights, &self.at), 2.0 * self.size());
        // The weights add up to 2; their own rounding is one more.
        let rounding = (N + 2) as f64 * UNIT * size;
        Interval::point(sum) + Interval::within(bound(2.0 * self.radius + rounding))
    }
}

/// `Σ a_g b_g`, in several sums side by side.
fn dot<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    const SIDE: usize = 8;
    let mut sums = [0.0; SIDE];
    for (a, b) in a.chunks_exact(SIDE).zip(b.chunks_exact(SIDE)) {
        for k in 0..SIDE {
            sums[k] += a[k] * b[k];
        }
    }
    debug_assert!(N.is_multiple_of(SIDE));
    sums.iter().sum()
}
