//! A deflection along the bat, and its value at any place.

use std::sync::Arc;

use serde::Serialize;

use crate::base::{Over, Real};
use crate::beam::{Motion, View};

/// A deflection along the bat, a polynomial on every element.
#[derive(Debug, Clone, Serialize)]
pub struct Shape {
    /// Middle and length of every element (m); shared by the modes of one solution.
    pub(super) stretches: Arc<Vec<(f64, f64)>>,
    /// Number of Legendre polynomials on an element.
    pub(super) terms: usize,
    pub(super) coefficients: Vec<f64>,
    /// The rotation likewise; empty if it is the slope.
    pub(super) turns: Vec<f64>,
}

/// `2j − 1`, `(2j − 1)/j` and `(j − 1)/j` for `j = 2, 3, …`.
const RECURRENCE: [[f64; 3]; 14] = {
    let mut factors = [[0.0; 3]; 14];
    let mut k = 0;
    while k < 14 {
        let j = (k + 2) as f64;
        factors[k] = [2.0 * j - 1.0, (2.0 * j - 1.0) / j, (j - 1.0) / j];
        k += 1;
    }
    factors
};

impl Shape {
    /// The deflection of a motion, in metres.
    pub fn of(view: &View<f64>, motion: &Motion<f64>, stretches: &Arc<Vec<(f64, f64)>>) -> Self {
        Self::in_lane(view, motion, 0, stretches)
    }

    /// The deflection of a motion in one lane, in metres.
    pub(super) fn in_lane<S: Real, R: Over<S>>(
        view: &View<S>,
        motion: &Motion<R>,
        lane: usize,
        stretches: &Arc<Vec<(f64, f64)>>,
    ) -> Self {
        Self {
            stretches: Arc::clone(stretches),
            terms: view.terms,
            coefficients: coefficients(view, &motion.shape, lane, 1.0),
            turns: coefficients(view, &motion.turns, lane, -1.0),
        }
    }

    /// Deflection at `x` (m from the knob end), for a largest deflection of 1.
    pub fn deflection(&self, x: f64) -> f64 {
        let (k, xi) = self.locate(x);
        self.derivatives(k, xi)[0]
    }

    /// Deflection, slope (1/m) and its derivative (1/m²) at `x`.
    pub(super) fn derivatives_at(&self, x: f64) -> [f64; 3] {
        let (k, xi) = self.locate(x);
        let ([w, slope, bend], scale) = (self.derivatives(k, xi), 2.0 / self.stretches[k].1);
        [w, slope * scale, bend * scale * scale]
    }

    /// Rotation θ of the section at `x` (rad per m of largest deflection): the slope `dφ/dx`, less
    /// the shear strain of a beam that shears.
    pub fn rotation(&self, x: f64) -> f64 {
        let (k, xi) = self.locate(x);
        match self.turns.is_empty() {
            true => self.derivatives(k, xi)[1] * 2.0 / self.stretches[k].1,
            false => self.series(&self.turns, k, xi)[0],
        }
    }

    /// Element, ξ and slope of the deflection (1/m) for each of these places (m).
    pub fn slopes(&self, places: &[f64]) -> Vec<(usize, f64, f64)> {
        let slope = |x: &f64| {
            let (k, xi) = self.locate(*x);
            (k, xi, self.derivatives(k, xi)[1] * 2.0 / self.stretches[k].1)
        };
        places.iter().map(slope).collect()
    }

    /// Largest shift of nodes (m), known by their [`Self::slopes`] in another shape on the mesh, per unit of this shape
    /// added to that one.
    pub fn shift(&self, nodes: &[(usize, f64, f64)]) -> f64 {
        let of = |(k, xi, slope): &(usize, f64, f64)| (self.value(*k, *xi) / slope).abs();
        nodes.iter().map(of).fold(0.0, f64::max)
    }

    /// Deflection on element `k`.
    fn value(&self, k: usize, xi: f64) -> f64 {
        let w = &self.coefficients[k * self.terms..(k + 1) * self.terms];
        let (mut before, mut now, mut sum) = (1.0, xi, w[0] + w[1] * xi);
        for (w, [_, value, last]) in w[2..].iter().zip(RECURRENCE) {
            (before, now) = (now, value * xi * now - last * before);
            sum += w * now;
        }
        sum
    }

    /// Curvature `dθ/dx` at `x` (1/m² of largest deflection).
    pub fn curvature(&self, x: f64) -> f64 {
        let (k, xi) = self.locate(x);
        let scale = 2.0 / self.stretches[k].1;
        match self.turns.is_empty() {
            true => self.derivatives(k, xi)[2] * scale * scale,
            false => self.series(&self.turns, k, xi)[1] * scale,
        }
    }

    /// Deformation of a section at ξ in [−1, 1] of element `k`, for a largest deflection of 1: deflection w, rotation θ
    /// (1/m), curvature θ′ (1/m²) and shear strain w′ − θ (1/m).
    pub fn strains(&self, k: usize, xi: f64) -> [f64; 4] {
        let scale = 2.0 / self.stretches[k].1;
        let [w, slope, bend] = self.derivatives(k, xi);
        if self.turns.is_empty() {
            return [w, slope * scale, bend * scale * scale, 0.0];
        }
        let [turn, bend, _] = self.series(&self.turns, k, xi);
        [w, turn, bend * scale, slope * scale - turn]
    }

    /// Length of the bat (m).
    pub fn length(&self) -> f64 {
        self.stretches.last().map_or(0.0, |(middle, length)| middle + 0.5 * length)
    }

    /// Multiplies every deflection by a factor.
    pub fn scale(&mut self, scale: f64) {
        self.coefficients.iter_mut().chain(&mut self.turns).for_each(|w| *w *= scale);
    }

    /// The ends of its elements (m), rising from 0.
    pub fn borders(&self) -> impl Iterator<Item = f64> + '_ {
        let ends = self.stretches.iter().map(|(middle, length)| middle + 0.5 * length);
        std::iter::once(0.0).chain(ends)
    }

    /// Legendre coefficients of the deflection, element by element, `degree + 1` each.
    pub fn coefficients(&self) -> &[f64] {
        &self.coefficients
    }

    /// Element and its coordinate ξ in [−1, 1] at `x`.
    pub fn locate(&self, x: f64) -> (usize, f64) {
        let k = self.stretches.partition_point(|(middle, length)| middle + 0.5 * length <= x);
        let k = k.min(self.stretches.len() - 1);
        let (middle, length) = self.stretches[k];
        (k, (2.0 * (x - middle) / length).clamp(-1.0, 1.0))
    }

    /// Deflection and its first two derivatives by ξ on element `k`.
    ///
    /// `P_{j+1} = ((2j + 1) ξ P_j − j P_{j−1})/(j + 1)`, `P′_{j+1} = P′_{j−1} + (2j + 1) P_j`, and likewise for the
    /// second derivative.
    pub(super) fn derivatives(&self, k: usize, xi: f64) -> [f64; 3] {
        self.series(&self.coefficients, k, xi)
    }

    fn series(&self, coefficients: &[f64], k: usize, xi: f64) -> [f64; 3] {
        let w = &coefficients[k * self.terms..(k + 1) * self.terms];
        let (mut before, mut now) = ([1.0, 0.0, 0.0], [xi, 1.0, 0.0]);
        let mut sum = [w[0] + w[1] * xi, w[1], 0.0];
        for (w, [odd, value, last]) in w[2..].iter().zip(RECURRENCE) {
            let next = [
                value * xi * now[0] - last * before[0],
                before[1] + odd * now[0],
                before[2] + odd * now[1],
            ];
            (before, now) = (now, next);
            (0..3).for_each(|i| sum[i] += w * now[i]);
        }
        sum
    }
}

/// Legendre coefficients of every element from knob to tip. On the knob side, outwards runs backwards: odd polynomials
/// change sign there and, with `sign` −1, a rotation does.
fn coefficients<S: Real, R: Over<S>>(
    view: &View<S>,
    cells: &[R],
    lane: usize,
    sign: f64,
) -> Vec<f64> {
    let (knob, tip) = cells.split_at((view.terms * view.split).min(cells.len()));
    let mut all = Vec::with_capacity(cells.len());
    for shape in knob.chunks_exact(view.terms).rev() {
        let turned = shape.iter().enumerate();
        all.extend(
            turned.map(|(k, w)| sign * if k % 2 == 1 { -w.lane(lane) } else { w.lane(lane) }),
        );
    }
    all.extend(tip.iter().map(|w| w.lane(lane)));
    all
}
