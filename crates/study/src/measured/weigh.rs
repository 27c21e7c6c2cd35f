//! Mass orthogonality of curves along a bat: their product `φᴴMψ` in its mass.
//!
//! `M` is `∫ρA φ*ψ dx`, plus `∫ρI φ*′ψ′ dx` if the theory has rotary inertia, plus the fixtures. A curve is given by
//! its values at points, with a spline between. Absorbers are left out: near its frequency an absorber moves many times
//! as far as the bat beneath it. This factor was not measured, and a small error of the frequency changes it.
//!
//! A measurement has no rotations, so sections are assumed to turn with the slope. With shear they turn less. On an
//! R161 that leaves 0.01 between modes 4 and 5 and 0.05 between 9 and 10, for any number of points; without rotary
//! inertia it would be 0.02 between the low ones too. Computed shapes sampled at the same points show it.

use faer::c64;

use crate::engine::{Bat, Theory, gauss};
use crate::measured::spline::Spline;

/// Places and the masses there: a sum over them is an integral over the bat.
#[derive(Debug, Clone)]
pub struct Scale {
    shares: Vec<MassAt>,
}

#[derive(Debug, Clone, Copy)]
struct MassAt {
    /// Where it is fixed (m), and how far beyond its mass is (m).
    x: f64,
    offset: f64,
    /// kg, kg m²
    mass: f64,
    turning: f64,
}

/// A curve at every place of a scale: deflection there, and slope.
#[derive(Debug, Clone)]
pub struct Curve(Vec<[c64; 2]>);

impl Scale {
    /// For curves whose third derivative has corners at those points (m).
    pub fn new(bat: &Bat, theory: Theory, points: &[f64]) -> Self {
        let turns = if theory.turns() { 1.0 } else { 0.0 };
        // Two cubics and a mass of degree 6 are of degree 12; formulas are smooth.
        let rule = gauss(12);
        let mut shares = vec![];
        for piece in &bat.profile().pieces {
            let layup = bat.layup(piece);
            let end = piece.start + piece.length;
            let inner = points.iter().copied().filter(|x| *x > piece.start && *x < end);
            let mut borders: Vec<f64> = [piece.start].into_iter().chain(inner).collect();
            borders.push(end);
            for stretch in borders.windows(2) {
                for (s, weight) in &rule {
                    let x = stretch[0] + s * (stretch[1] - stretch[0]);
                    let worth = layup.worth(piece.at((x - piece.start) / piece.length));
                    let dx = weight * (stretch[1] - stretch[0]);
                    let (mass, turning) = (dx * worth.mass, dx * worth.turning * turns);
                    shares.push(MassAt { x, offset: 0.0, mass, turning });
                }
            }
        }
        shares.extend(bat.fixtures().attachments.iter().map(|a| {
            let (mass, turning) = (a.mass, a.rotary_inertia);
            MassAt { x: a.x, offset: a.offset, mass, turning }
        }));
        Self { shares }
    }

    /// The curve through values at points (m, rising).
    pub fn curve(&self, points: &[f64], values: &[c64]) -> Curve {
        let part =
            |of: fn(&c64) -> f64| Spline::new(points, &values.iter().map(of).collect::<Vec<f64>>());
        let (re, im) = (part(|v| v.re), part(|v| v.im));
        let at = |share: &MassAt| {
            let [re, im] = [re.at(share.x), im.at(share.x)];
            let slope = c64::new(re[1], im[1]);
            [c64::new(re[0], im[0]) + slope * share.offset, slope]
        };
        Curve(self.shares.iter().map(at).collect())
    }

    /// The line `a + b x`.
    pub fn line(&self, a: f64, b: f64) -> Curve {
        let at = |s: &MassAt| [c64::new(a + b * (s.x + s.offset), 0.0), c64::new(b, 0.0)];
        Curve(self.shares.iter().map(at).collect())
    }

    /// `φᴴMψ`.
    pub fn product(&self, a: &Curve, b: &Curve) -> c64 {
        let terms = self.shares.iter().zip(&a.0).zip(&b.0);
        terms.fold(c64::new(0.0, 0.0), |sum, ((share, a), b)| {
            sum + a[0].conj() * b[0] * share.mass + a[1].conj() * b[1] * share.turning
        })
    }

    /// The size of every product over the square root of the products of both curves with themselves: 1 on the
    /// diagonal.
    pub fn common(&self, curves: &[Curve]) -> Vec<Vec<f64>> {
        let own: Vec<f64> = curves.iter().map(|c| self.product(c, c).re.sqrt()).collect();
        let entry = |i: usize, j: usize| {
            let size = own[i] * own[j];
            let both = self.product(&curves[i], &curves[j]).norm();
            if size > 0.0 { (both / size).min(1.0) } else { 0.0 }
        };
        (0..curves.len()).map(|i| (0..curves.len()).map(|j| entry(i, j)).collect()).collect()
    }

    /// Share of rigid motion in a curve, relative to its size `√(φᴴMφ)`: the size of its projection on translation and
    /// rotation.
    pub fn rigid_share(&self, curve: &Curve) -> f64 {
        let shift = self.line(1.0, 0.0);
        let mass = self.product(&shift, &shift).re;
        let center = self.product(&shift, &self.line(0.0, 1.0)).re / mass;
        let turn = self.line(-center, 1.0);
        let parts = [&shift, &turn]
            .map(|rigid| self.product(rigid, curve).norm_sqr() / self.product(rigid, rigid).re);
        let own = self.product(curve, curve).re;
        if own > 0.0 { ((parts[0] + parts[1]) / own).min(1.0).sqrt() } else { 0.0 }
    }
}
