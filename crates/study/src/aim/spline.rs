//! Which smooth curves may the change of the diameter have?
//!
//! On every stretch that is not kept, it is a cubic B-spline with a knot about every 5 cm. Beside a kept stretch its
//! value and slope are 0, and at a pointed end of the bat its value is 0. [`Splines::roughness`] is the quadratic form
//! that a least change minimises:
//!
//! ```text
//! pᵀHp = mean(d²) + ℓ⁴ mean(d″²),   d(x) = Σ p_j B_j(x),   ℓ = 5 cm, means over the length of the bat
//! ```

use crate::engine::gauss;

/// Distance of the knots, as nearly as a whole number of them allows (m).
const KNOT_EVERY: f64 = 0.05;
/// A stretch shorter than this between two kept ones is kept too (m).
const SHORTEST: f64 = 0.02;
/// Length below which a bend is rough (m).
const SMOOTH: f64 = 0.05;

/// Cubic B-splines on the stretches that may change.
#[derive(Debug, Clone, PartialEq)]
pub struct Splines {
    length: f64,
    /// The curves.
    pub basis: Vec<BSpline>,
    /// The stretches that may change (m).
    pub stretches: Vec<[f64; 2]>,
}

/// A cubic B-spline by its five knots (m); at an end of its stretch some are equal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BSpline {
    knots: [f64; 5],
}

impl Splines {
    /// The splines of a bat of that length (m) outside the kept stretches (from, to, m). A `pointed` end of the bat,
    /// the knob's first, has no diameter to change.
    pub fn beside(keep: &[[f64; 2]], length: f64, pointed: [bool; 2]) -> Self {
        let mut stretches = vec![];
        let mut basis = vec![];
        let mut kept: Vec<[f64; 2]> = keep.to_vec();
        kept.sort_by(|a, b| a[0].total_cmp(&b[0]));
        kept.push([length, length]);
        let mut from = 0.0;
        for [start, end] in kept {
            let to = f64::min(start, length);
            if to - from >= SHORTEST {
                // Beside a kept stretch value and slope are held, at a point the value.
                let held = |kept, pointed| if kept { 2 } else { usize::from(pointed) };
                let ends = [held(from > 0.0, pointed[0]), held(to < length, pointed[1])];
                let on = on_stretch([from, to], ends);
                if !on.is_empty() {
                    stretches.push([from, to]);
                    basis.extend(on);
                }
            }
            from = from.max(end);
        }
        Self { length, basis, stretches }
    }

    /// Number of curves.
    pub fn len(&self) -> usize {
        self.basis.len()
    }

    /// Whether nothing may change.
    pub fn is_empty(&self) -> bool {
        self.basis.is_empty()
    }

    /// `Σ p_j B_j(x)`.
    pub fn at(&self, p: &[f64], x: f64) -> f64 {
        self.basis.iter().zip(p).map(|(curve, p)| p * curve.at(x)).sum()
    }

    /// Places where cubics meet (m), rising.
    pub fn knots(&self) -> Vec<f64> {
        let mut knots: Vec<f64> = self.basis.iter().flat_map(|curve| curve.knots).collect();
        knots.sort_by(f64::total_cmp);
        knots.dedup();
        knots
    }

    /// H of `pᵀHp = mean(d²) + ℓ⁴ mean(d″²)`, in the square of the unit of p.
    pub fn roughness(&self) -> Vec<Vec<f64>> {
        self.form(|curve, x| [curve.at(x), SMOOTH.powi(2) * curve.curvature(x)])
    }

    /// `∫ B_i B_j dx` (m).
    pub fn overlaps(&self) -> Vec<Vec<f64>> {
        let means = self.form(|curve, x| [curve.at(x), 0.0]);
        means.into_iter().map(|row| row.into_iter().map(|v| v * self.length).collect()).collect()
    }

    /// The mean over the bat of the products of a property of each two curves.
    fn form(&self, told: impl Fn(&BSpline, f64) -> [f64; 2]) -> Vec<Vec<f64>> {
        let count = self.len();
        let mut form = vec![vec![0.0; count]; count];
        // Products of two cubics are of degree 6.
        let rule = gauss(4);
        for ends in self.knots().windows(2) {
            let h = ends[1] - ends[0];
            for &(s, weight) in rule.iter() {
                let x = ends[0] + s * h;
                let here: Vec<(usize, [f64; 2])> = (0..count)
                    .filter(|j| self.basis[*j].reaches(x))
                    .map(|j| (j, told(&self.basis[j], x)))
                    .collect();
                for (i, a) in &here {
                    for (j, b) in &here {
                        form[*i][*j] += weight * h / self.length * (a[0] * b[0] + a[1] * b[1]);
                    }
                }
            }
        }
        form
    }
}

impl BSpline {
    /// The value at `x`; at its most it is between 0 and 1.
    pub fn at(&self, x: f64) -> f64 {
        self.value(0, 3, x)
    }

    /// `dB/dx` (1/m).
    pub fn slope(&self, x: f64) -> f64 {
        self.derivative(0, 3, 1, x)
    }

    /// `d²B/dx²` (1/m²).
    pub fn curvature(&self, x: f64) -> f64 {
        self.derivative(0, 3, 2, x)
    }

    /// The knots between which it is not 0 (m), each once.
    pub fn knots(&self) -> Vec<f64> {
        let mut knots = self.knots.to_vec();
        knots.dedup();
        knots
    }

    /// Whether it may differ from 0 there.
    pub fn reaches(&self, x: f64) -> bool {
        x >= self.knots[0] && x <= self.knots[4]
    }

    /// `B_{i,p}(x)` of the knots from number `i` on, by the recursion of Cox and de Boor.
    fn value(&self, i: usize, degree: usize, x: f64) -> f64 {
        let t = &self.knots;
        if degree == 0 {
            // The curve holds its value at its last knot, where the stretch ends.
            let last = x == t[4] && t[i + 1] == t[4] && t[i] < t[4];
            return if (t[i] <= x && x < t[i + 1]) || last { 1.0 } else { 0.0 };
        }
        let part =
            |from: f64, to: f64, over: f64| if over > 0.0 { (to - from) / over } else { 0.0 };
        let rising = part(t[i], x, t[i + degree] - t[i]);
        let falling = part(x, t[i + degree + 1], t[i + degree + 1] - t[i + 1]);
        rising * self.value(i, degree - 1, x) + falling * self.value(i + 1, degree - 1, x)
    }

    /// The derivative of that order of the same spline.
    fn derivative(&self, i: usize, degree: usize, order: usize, x: f64) -> f64 {
        if order == 0 {
            return self.value(i, degree, x);
        }
        let t = &self.knots;
        let part = |k: usize| {
            let over = t[k + degree] - t[k];
            match over > 0.0 {
                true => degree as f64 / over * self.derivative(k, degree - 1, order - 1, x),
                false => 0.0,
            }
        };
        part(i) - part(i + 1)
    }
}

/// The B-splines of a stretch, without those that would move its held ends: the value at an end depends on the first
/// curve there, value and slope on the first two.
fn on_stretch([from, to]: [f64; 2], [first, last]: [usize; 2]) -> Vec<BSpline> {
    let pieces = (((to - from) / KNOT_EVERY).round() as usize).max(1);
    let place =
        |k: usize| if k == pieces { to } else { from + (to - from) * k as f64 / pieces as f64 };
    let ends = |x: f64| std::iter::repeat_n(x, 3);
    let knots: Vec<f64> = ends(from).chain((0..=pieces).map(place)).chain(ends(to)).collect();
    let count = pieces + 3;
    (first..count.saturating_sub(last))
        .map(|k| BSpline { knots: std::array::from_fn(|i| knots[k + i]) })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn r161() -> Splines {
        Splines::beside(&[[0.0, 0.03]], 0.84, [false; 2])
    }

    #[test]
    fn a_knot_every_five_centimetres_and_nothing_where_it_is_kept() {
        let splines = r161();
        assert_eq!(splines.len(), 17);
        let p: Vec<f64> = (0..17).map(|k| (k as f64).sin()).collect();
        assert_eq!([splines.at(&p, 0.01), splines.at(&p, 0.03)], [0.0; 2]);
        let slope = |x: f64| splines.basis.iter().zip(&p).map(|(b, p)| p * b.slope(x)).sum::<f64>();
        assert_eq!(slope(0.03), 0.0);
        assert_eq!(splines.at(&p, 0.84), p[16]);
        let both = Splines::beside(&[[0.0, 0.03], [0.4, 0.5]], 0.84, [false; 2]);
        assert_eq!(both.stretches, [[0.03, 0.4], [0.5, 0.84]]);
        assert!(Splines::beside(&[[0.0, 0.84]], 0.84, [false; 2]).is_empty());
        let pointed = Splines::beside(&[[0.0, 0.03]], 0.84, [false, true]);
        assert_eq!((pointed.len(), pointed.at(&p[..16], 0.84)), (16, 0.0));
        // Between 0.39 and 0.4 there is no room for a smooth change.
        assert_eq!(Splines::beside(&[[0.0, 0.39], [0.4, 0.84]], 0.84, [false; 2]).len(), 0);
    }

    /// The splines of a bat that may change everywhere add up to 1, and to x with their Greville abscissae: constants
    /// and lines can be represented.
    #[test]
    fn constants_and_lines_are_among_the_curves() {
        let splines = Splines::beside(&[], 0.8, [false; 2]);
        let greville: Vec<f64> =
            splines.basis.iter().map(|b| b.knots[1..4].iter().sum::<f64>() / 3.0).collect();
        for k in 0..=80 {
            let x = 0.01 * f64::from(k);
            let ones = vec![1.0; splines.len()];
            assert!((splines.at(&ones, x) - 1.0).abs() < 1e-14, "{x}");
            assert!((splines.at(&greville, x) - x).abs() < 1e-14, "{x}");
        }
        // mean(1²) and mean(x²) without any bend.
        let form = |p: &[f64]| {
            let h = splines.roughness();
            (0..p.len())
                .map(|i| (0..p.len()).map(|j| p[i] * h[i][j] * p[j]).sum::<f64>())
                .sum::<f64>()
        };
        assert!((form(&vec![1.0; splines.len()]) - 1.0).abs() < 1e-12);
        assert!((form(&greville) - 0.64 / 3.0).abs() < 1e-12);
    }

    /// Derivatives against differences.
    #[test]
    fn slope_and_curvature_are_those_of_the_curve() {
        for curve in &r161().basis {
            for k in 0..40 {
                let (x, h) = (0.035 + 0.02 * f64::from(k), 1e-6);
                let slope = (curve.at(x + h) - curve.at(x - h)) / (2.0 * h);
                assert!((slope - curve.slope(x)).abs() < 1e-6, "{x}");
                let bend = (curve.slope(x + h) - curve.slope(x - h)) / (2.0 * h);
                assert!(
                    (bend - curve.curvature(x)).abs() < 2e-2,
                    "{x} {bend} {}",
                    curve.curvature(x)
                );
            }
        }
    }
}
