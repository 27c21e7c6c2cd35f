//! What does the bat do when it rings: frequencies, shapes, nodes, modal masses?
//!
//! [`crate::solve()`] gives the [`Mode`]s; [`Mode::frequency`], [`Shape::deflection`] and
//! [`Mode::error`] are what to ask of one.

use std::f64::consts::TAU;
use std::sync::Arc;

use crate::base::real::Real;
use crate::beam::motion::Motion;
use crate::beam::view::View;

/// One bending mode of a bat.
#[derive(Debug, Clone)]
pub struct Mode {
    /// Number of the mode: 1 for the lowest bending mode.
    pub order: usize,
    /// Angular frequency ω (rad/s).
    pub omega: f64,
    /// Modal mass `∫ρA φ² dx`, with rotary inertia and what is attached, for a largest |φ| of 1 (kg).
    pub modal_mass: f64,
    /// Where the deflection is zero, from the knob end (m).
    pub nodes: Vec<f64>,
    /// Deflection φ, largest |φ| = 1, the barrel end positive.
    pub shape: Shape,
    /// How far these numbers may be off.
    pub error: ModeError,
}

/// How far a mode's numbers may be off.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ModeError {
    /// Relative error of the frequency because the mesh is finite.
    pub discretization: f64,
    /// Relative error of the frequency because numbers have 53 bits.
    pub round_off: f64,
    /// `‖u − λ K⁻¹ M u‖ / ‖u‖` of the computed pair, in the strain energy norm.
    pub residual: f64,
    /// Error of the node positions (m).
    pub nodes: f64,
    /// Relative error of the modal mass.
    pub modal_mass: f64,
    /// Error of the deflection φ anywhere on the bat, the largest |φ| being 1.
    pub shape: f64,
}

impl ModeError {
    /// Relative error of the frequency by mesh and round-off together.
    pub fn total(&self) -> f64 {
        self.discretization + self.round_off
    }
}

impl Mode {
    /// Frequency (Hz).
    pub fn frequency(&self) -> f64 {
        self.omega / TAU
    }

    /// Whether it crosses zero as often as the theory of oscillation demands of mode n of a free
    /// Euler–Bernoulli bat: n + 1 times (Gantmacher and Krein, Oscillation Matrices, 1950). A list
    /// of modes that all do has no gap.
    pub fn has_its_nodes(&self) -> bool {
        self.nodes.len() == self.order + 1
    }

    /// The mode that is that motion in one lane.
    pub fn new<R: Real>(
        order: usize,
        view: &View<f64>,
        motion: &Motion<R>,
        lane: usize,
        stretches: &Arc<Vec<(f64, f64)>>,
    ) -> Self {
        let track = Track::new(view, motion, lane);
        let mut shape = Shape::in_lane(view, motion, lane, stretches);
        let (largest, change) = shape.largest(&track);
        // The barrel end is positive; if it is held, the knob end; if both are, the side of the
        // peak.
        const AT_REST: f64 = 1e-9;
        let moving = |end: usize| track.ends[end][0].abs() > AT_REST * largest;
        let leading = match (moving(1), moving(0)) {
            (true, _) => track.ends[1][0],
            (_, true) => track.ends[0][0],
            _ => track.samples.iter().fold(0.0, |a: f64, b| if b.abs() > a.abs() { *b } else { a }),
        };
        let sign = if leading < 0.0 { -1.0 } else { 1.0 };
        let scale = sign / largest;
        let rest = if view.fixed.is_some() { STILL * largest } else { 0.0 };
        let mut nodes = shape.zeros(&track, rest);
        if let Some(fixed) = view.fixed {
            // Where a clamp holds the bat its deflection has more than a zero.
            let near = STILL.cbrt() * shape.length();
            nodes.retain(|x| fixed.placed.clamps.iter().all(|clamp| (x - clamp).abs() > near));
            shape.leave_still(&mut nodes, &fixed.placed.clamps, &track, RESTING * largest);
        }
        let node_error = shape.node_error(&nodes, &track);
        shape.coefficients.iter_mut().chain(&mut shape.turns).for_each(|w| *w *= scale);
        let kinetic = motion.kinetic.lane(lane);
        let off = |(w, change): (f64, f64), at: f64| (change - at * w).abs() / largest;
        let pairs = track.samples.iter().copied().zip(track.changes.iter().copied());
        let ends = track.ends.iter().map(|end| (end[0], end[1]));
        let worst = pairs.chain(ends).map(|pair| off(pair, change)).fold(0.0, f64::max);
        let error = ModeError {
            discretization: 0.5 * motion.defect.lane(lane),
            round_off: 0.0,
            residual: motion.residual.lane(lane),
            nodes: node_error,
            // The mass goes as the square of the shape; where the parts of its own change cancel,
            // by luck, the shape's change is the better measure.
            modal_mass: 2.0 * f64::max((motion.work.lane(lane) / kinetic - change).abs(), worst),
            shape: worst,
        };
        let modal_mass = kinetic * scale * scale;
        Self { order, omega: motion.omega.lane(lane), modal_mass, nodes, shape, error }
    }
}

/// A motion from knob to tip in one lane, at the points of its elements.
struct Track {
    samples: Vec<f64>,
    changes: Vec<f64>,
    /// Deflection and change at the knob end and at the tip.
    ends: [[f64; 2]; 2],
    /// Points of an element as ξ.
    xi: Vec<f64>,
}

impl Track {
    fn new<R: Real>(view: &View<f64>, motion: &Motion<R>, lane: usize) -> Self {
        let points = view.rule.count();
        let split = points * view.split;
        let along = |values: &[R]| -> Vec<f64> {
            let (knob, tip) = values.split_at(split);
            knob.iter().rev().chain(tip).map(|v| v.lane(lane)).collect()
        };
        let xi = view.rule.points.iter().map(|p| 2.0 * p.s - 1.0).collect();
        let samples = along(&motion.deflections);
        let changes = along(&motion.changes);
        let mut ends = motion.ends.map(|end| end.map(|v| v.lane(lane)));
        if view.split == 0 {
            // The root is the knob end itself.
            ends[0][1] = changes[0];
        }
        Self { samples, changes, ends, xi }
    }
}

/// Where something holds the bat, a deflection below this share of the largest counts as 0.
const STILL: f64 = 1e-12;
/// Clamps part a bat into stretches that know nothing of each other: one that moves less than this
/// share of another is at rest but for what the iteration left.
const RESTING: f64 = 1e-3;

/// Legendre coefficients of every element from knob to tip: outwards is backwards on the knob side,
/// where odd polynomials change sign and, with `sign` −1, a rotation does.
fn coefficients<R: Real>(view: &View<f64>, cells: &[R], lane: usize, sign: f64) -> Vec<f64> {
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

/// A deflection along the bat, a polynomial on every element.
#[derive(Debug, Clone)]
pub struct Shape {
    /// Middle and length of every element (m); shared by the modes of one solution.
    stretches: Arc<Vec<(f64, f64)>>,
    /// Number of Legendre polynomials on an element.
    terms: usize,
    coefficients: Vec<f64>,
    /// The rotation likewise; empty where it is the slope.
    turns: Vec<f64>,
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

    fn in_lane<R: Real>(
        view: &View<f64>,
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

    /// Rotation θ of the section at `x` (rad per m of largest deflection): the slope `dφ/dx`, less
    /// the shear strain of a beam that shears.
    pub fn rotation(&self, x: f64) -> f64 {
        let (k, xi) = self.locate(x);
        match self.turns.is_empty() {
            true => self.derivatives(k, xi)[1] * 2.0 / self.stretches[k].1,
            false => self.series(&self.turns, k, xi)[0],
        }
    }

    /// Where these places (m) are: element, ξ, and the slope of the deflection there (1/m).
    pub fn slopes(&self, places: &[f64]) -> Vec<(usize, f64, f64)> {
        let slope = |x: &f64| {
            let (k, xi) = self.locate(*x);
            (k, xi, self.derivatives(k, xi)[1] * 2.0 / self.stretches[k].1)
        };
        places.iter().map(slope).collect()
    }

    /// How far nodes that are known by their [`Self::slopes`] in another shape on the mesh move (m),
    /// the farthest of them, for each part of this shape that is added there.
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

    /// `Σ part · shape` of shapes on one mesh.
    pub fn sum(parts: &[(f64, &Self)]) -> Self {
        let mut sum = parts[0].1.clone();
        sum.coefficients.iter_mut().chain(&mut sum.turns).for_each(|w| *w = 0.0);
        for (part, shape) in parts {
            let all = sum.coefficients.iter_mut().zip(&shape.coefficients);
            let turns = sum.turns.iter_mut().zip(&shape.turns);
            all.chain(turns).for_each(|(sum, w)| *sum += part * w);
        }
        sum
    }

    /// Length of the bat (m).
    pub fn length(&self) -> f64 {
        self.stretches.last().map_or(0.0, |(middle, length)| middle + 0.5 * length)
    }

    /// Legendre coefficients of the deflection, element by element, `degree + 1` each.
    pub fn coefficients(&self) -> &[f64] {
        &self.coefficients
    }

    /// Element and its coordinate ξ in [−1, 1] at `x`.
    fn locate(&self, x: f64) -> (usize, f64) {
        let k = self.stretches.partition_point(|(middle, length)| middle + 0.5 * length <= x);
        let k = k.min(self.stretches.len() - 1);
        let (middle, length) = self.stretches[k];
        (k, (2.0 * (x - middle) / length).clamp(-1.0, 1.0))
    }

    /// Deflection and its first two derivatives by ξ on element `k`.
    ///
    /// `P_{j+1} = ((2j + 1) ξ P_j − j P_{j−1})/(j + 1)`, `P′_{j+1} = P′_{j−1} + (2j + 1) P_j` and
    /// the same for the second.
    fn derivatives(&self, k: usize, xi: f64) -> [f64; 3] {
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

    /// Deflection at the left end, the points and the right end of element `k`, from its values at
    /// the points.
    fn places(&self, k: usize, track: &Track, places: &mut Vec<(f64, f64)>) {
        let points = track.xi.len();
        let own = &self.coefficients[k * self.terms..(k + 1) * self.terms];
        let left = own.iter().enumerate().map(|(j, w)| if j % 2 == 1 { -w } else { *w }).sum();
        let inner = track.samples[k * points..(k + 1) * points].iter();
        places.clear();
        places.push((-1.0, left));
        places.extend(track.xi.iter().copied().zip(inner.copied()));
        places.push((1.0, own.iter().sum()));
    }

    /// Largest |deflection| over the continuous shape, and the relative change there: of the ends
    /// of every element, where joints make cusps, and of the peaks between its places.
    fn largest(&self, track: &Track) -> (f64, f64) {
        // A peak is higher than the places beside it, hardly ever by more than that.
        const LOWEST: f64 = 0.5;
        let points = track.xi.len();
        let [knob, tip] = track.ends;
        let end = if knob[0].abs() > tip[0].abs() { knob } else { tip };
        let (mut most, mut change) = (end[0].abs(), end[1] / end[0]);
        let highest = track.samples.iter().fold(most, |most, w| most.max(w.abs()));
        let mut places = Vec::with_capacity(points + 2);
        for k in 0..self.stretches.len() {
            self.places(k, track, &mut places);
            let size = |j: usize| places.get(j).map_or(0.0, |(_, w)| w.abs());
            for j in 0..places.len() {
                let highest_here = size(j) >= size(j.wrapping_sub(1)) && size(j) >= size(j + 1);
                if size(j) <= LOWEST * highest.max(most) || !highest_here {
                    continue;
                }
                let peak = self.extreme(k, &places, j).1.abs().max(size(j));
                if peak > most {
                    let near = k * points + j.saturating_sub(1).min(points - 1);
                    (most, change) = (peak, track.changes[near] / track.samples[near]);
                }
            }
        }
        (most, change)
    }

    /// The place ξ beside place `j` of element `k` where the slope is zero, and the deflection
    /// there; place `j` itself if the slope has one sign up to the next places.
    fn extreme(&self, k: usize, places: &[(f64, f64)], j: usize) -> (f64, f64) {
        let slope = |xi: f64| self.derivatives(k, xi)[1];
        let (at, value) = places[j];
        let here = slope(at);
        let beside = [j.wrapping_sub(1), j + 1].map(|j| places.get(j).map(|place| place.0));
        let across = |xi: &f64| here * slope(*xi) < 0.0;
        let Some(mut other) = beside.into_iter().flatten().find(across) else { return (at, value) };
        let (mut own, mut xi) = (at, at);
        // Newton's steps where they stay inside the shrinking bracket, halving where not.
        for _ in 0..60 {
            let [w, slope, bend] = self.derivatives(k, xi);
            if slope * here > 0.0 {
                own = xi
            } else {
                other = xi
            }
            let next = xi - slope / bend;
            let inside = next > own.min(other) && next < own.max(other);
            let next = if inside { next } else { 0.5 * (own + other) };
            if (next - xi).abs() < 1e-9 {
                return (xi, w);
            }
            xi = next;
        }
        (xi, self.derivatives(k, xi)[0])
    }

    /// The isolated zeros of the deflection inside the bat (m), rising.
    ///
    /// A deflection of at most `rest` counts as 0: a stretch at rest has no nodes. Beside a place of
    /// zero, such as a pin, the slope tells the sign; between two places of one sign are two zeros
    /// where the deflection comes nearest to zero beyond it.
    fn zeros(&self, track: &Track, rest: f64) -> Vec<f64> {
        let mut zeros = Vec::new();
        let mut places = Vec::with_capacity(track.xi.len() + 2);
        // The sign that the deflection had last, and its value at the end of the last element.
        let (mut before, mut border) = (0.0, None);
        for (k, (middle, length)) in self.stretches.iter().enumerate() {
            self.places(k, track, &mut places);
            places[0].1 = border.unwrap_or(places[0].1);
            border = places.last().map(|place| place.1);
            places.iter_mut().filter(|place| place.1.abs() <= rest).for_each(|at| at.1 = 0.0);
            for j in 1..places.len() {
                let [(left, a), (right, b)] = [places[j - 1], places[j]];
                let signs = [
                    self.sign(k, places[j - 1], right - left, b),
                    self.sign(k, places[j], left - right, a),
                ];
                let first = if signs[0] == 0.0 { before } else { signs[0] };
                let mut add = |xi: f64| zeros.push(middle + 0.5 * length * xi);
                if first * before < 0.0 {
                    add(left);
                }
                if first * signs[1] < 0.0 {
                    // A zero at a place itself is not the one that is sought.
                    let (left, a) = match a {
                        0.0 if signs[0] != 0.0 => self.off(k, [left, right], first),
                        _ => (left, first * a.abs()),
                    };
                    let (right, b) = match b {
                        0.0 => self.off(k, [right, left], signs[1]),
                        _ => (right, b),
                    };
                    add(self.zero(k, left, right, a, b));
                } else if let Some((xi, w)) =
                    self.dip(k, &places, j).filter(|dip| dip.1 * first < 0.0)
                {
                    add(self.zero(k, left, xi, a, w));
                    add(self.zero(k, xi, right, w, b));
                }
                before = if signs[1] == 0.0 { first } else { signs[1] };
            }
        }
        zeros
    }

    /// The first place on the way from one to another of element `k`, halving it, where the
    /// deflection has that sign, and the deflection there.
    fn off(&self, k: usize, [from, to]: [f64; 2], sign: f64) -> (f64, f64) {
        let value = |xi: f64| (xi, self.derivatives(k, xi)[0]);
        let mut halves = (1..52).map(|halvings| value(from + (to - from) * 0.5f64.powi(halvings)));
        let found = halves.find(|(_, w)| w * sign > 0.0);
        found.unwrap_or((from, sign * f64::MIN_POSITIVE))
    }

    /// The sign of the deflection at a place of element `k`, or just beside it on the way `to`
    /// another where the deflection is `other`.
    fn sign(&self, k: usize, (xi, w): (f64, f64), to: f64, other: f64) -> f64 {
        // A slope that carries less than this of the other deflection is that of a clamp.
        const FLAT: f64 = 1e-6;
        if w != 0.0 {
            return w.signum();
        }
        let rise = self.derivatives(k, xi)[1] * to;
        if other != 0.0 && rise.abs() > FLAT * other.abs() { rise.signum() } else { 0.0 }
    }

    /// Where between places `j − 1` and `j` of element `k` the deflection is nearest to zero, if
    /// it may be between them, and the deflection there.
    fn dip(&self, k: usize, places: &[(f64, f64)], j: usize) -> Option<(f64, f64)> {
        let size = |j: usize| places.get(j).map_or(f64::INFINITY, |(_, w)| w.abs());
        let lowest = |j: usize| size(j) <= size(j.wrapping_sub(1)) && size(j) <= size(j + 1);
        let nearest = [j - 1, j].into_iter().find(|j| size(*j) > 0.0 && lowest(*j))?;
        let (xi, w) = self.extreme(k, places, nearest);
        (xi > places[j - 1].0 && xi < places[j].0).then_some((xi, w))
    }

    /// Leaves no nodes on stretches between clamps where the deflection is nowhere above `rest`.
    fn leave_still(&self, nodes: &mut Vec<f64>, clamps: &[f64], track: &Track, rest: f64) {
        let same = |a: f64, b: f64| clamps.iter().all(|clamp| (a < *clamp) == (b < *clamp));
        let places = self
            .stretches
            .iter()
            .flat_map(|(middle, length)| track.xi.iter().map(move |xi| middle + 0.5 * length * xi));
        let ends = [(0.0, track.ends[0][0]), (self.length(), track.ends[1][0])];
        let samples: Vec<(f64, f64)> =
            places.zip(track.samples.iter().copied()).chain(ends).collect();
        nodes.retain(|node| samples.iter().any(|(x, w)| w.abs() > rest && same(*x, *node)));
    }

    /// The zero between `left` and `right` on element `k`, where the deflection is of different
    /// sign: Halley's steps `ξ − w w′/(w′² − ½ w w″)` where they stay inside the shrinking bracket,
    /// halving where not.
    fn zero(&self, k: usize, mut left: f64, mut right: f64, before: f64, after: f64) -> f64 {
        let halley = |xi: f64| {
            let [value, slope, bend] = self.derivatives(k, xi);
            let step = value * slope / (slope * slope - 0.5 * value * bend);
            let near = value.abs() <= 2.0 * SMALL * slope.abs();
            (value, xi - step, near && (value * bend).abs() <= 4.0 * SMALL * slope * slope)
        };
        // The error is about the cube of the step, over the square of the distance to where the
        // slope is zero: after a step of 1e-5 of both it is below round-off.
        const SMALL: f64 = 1e-5;
        let start = left + (right - left) * (before / (before - after));
        // Nearly always two steps do, with nothing to decide on the way.
        let once = halley(start).1;
        let (_, twice, small) = halley(once);
        if small && (twice - once).abs() < SMALL && twice > left && twice < right {
            return twice;
        }
        let rising = after > 0.0;
        let mut xi = start;
        for _ in 0..100 {
            let (value, next, small) = halley(xi);
            if (value > 0.0) == rising {
                right = xi
            } else {
                left = xi
            }
            let inside = next > left && next < right;
            let next = if inside { next } else { 0.5 * (left + right) };
            let step = (next - xi).abs();
            if step <= f64::EPSILON || (inside && small && step < SMALL) {
                return next;
            }
            xi = next;
        }
        xi
    }

    /// How far nodes may be off (m): the change of the deflection around each over its slope.
    fn node_error(&self, nodes: &[f64], track: &Track) -> f64 {
        let points = track.xi.len();
        let error = |x: &f64| {
            let (k, xi) = self.locate(*x);
            let [_, slope, _] = self.derivatives(k, xi);
            let near = track.xi.partition_point(|at| *at < xi);
            let around = [near.saturating_sub(1), near.min(points - 1)];
            let change = around.map(|i| track.changes[k * points + i].abs());
            0.5 * self.stretches[k].1 * f64::max(change[0], change[1]) / slope.abs()
        };
        nodes.iter().map(error).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLACES: [f64; 6] = [-0.93, -0.66, -0.24, 0.24, 0.66, 0.93];

    /// What is known of a shape at the points of its elements, as if it were exact.
    fn track(shape: &Shape) -> Track {
        let samples = |k: usize| PLACES.map(|xi| shape.derivatives(k, xi)[0]);
        let samples: Vec<f64> = (0..shape.stretches.len()).flat_map(samples).collect();
        let last = shape.stretches.len() - 1;
        let ends = [(0, -1.0), (last, 1.0)].map(|(k, xi)| [shape.derivatives(k, xi)[0], 0.0]);
        Track { changes: vec![0.0; samples.len()], samples, ends, xi: PLACES.to_vec() }
    }

    fn zeros(shape: &Shape) -> Vec<f64> {
        shape.zeros(&track(shape), 1e-15)
    }

    /// A shape of those Legendre coefficients on two elements, from 0 to 1 and on to 2.
    fn on_two(coefficients: [[f64; 4]; 2]) -> Shape {
        let stretches = Arc::new(vec![(0.5, 1.0), (1.5, 1.0)]);
        Shape { stretches, terms: 4, coefficients: coefficients.concat(), turns: vec![] }
    }

    /// `(ξ − a)(ξ − b)` in Legendre polynomials.
    fn parabola(a: f64, b: f64) -> [f64; 4] {
        [1.0 / 3.0 + a * b, -(a + b), 2.0 / 3.0, 0.0]
    }

    #[test]
    fn two_nodes_between_two_places_are_both_found() {
        for (a, b) in [(0.01, 0.02), (-0.99, -0.95), (0.3, 0.3001), (0.94, 0.999)] {
            let shape = on_two([parabola(a, b), [(1.0 - a) * (1.0 - b), 0.0, 0.0, 0.0]]);
            let found = zeros(&shape);
            assert_eq!(found.len(), 2, "{a} {b} {found:?}");
            for (found, exact) in found.iter().zip([a, b]) {
                assert!((found - 0.5 - 0.5 * exact).abs() < 1e-9, "{a} {b} {found:?}");
            }
        }
    }

    /// A pin at the border of two elements, and another node before the next place.
    #[test]
    fn a_pin_with_a_node_near_it_is_two_nodes() {
        for node in [-0.999, -0.98, -0.94] {
            let slope = -1.0 - node;
            // Beyond the pin (ξ + 1)(ξ − node), before it the line of that slope.
            let before = [-slope, slope, 0.0, 0.0].map(|w: f64| w);
            let shape = on_two([before, parabola(-1.0, node)]);
            let found = zeros(&shape);
            let exact = [1.0, 1.5 + 0.5 * node];
            assert_eq!(found.len(), 2, "{node} {found:?}");
            assert!(found.iter().zip(exact).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?}");
        }
    }

    /// A cusp at a joint, higher than every sample; a peak between the end and the first sample.
    #[test]
    fn the_largest_deflection_is_found_at_cusps_and_beside_ends() {
        let cusp = on_two([[0.0, 1.0, 0.0, 0.0], [0.0, -1.0, 0.0, 0.0]]);
        assert_eq!(cusp.largest(&track(&cusp)).0, 1.0);
        // 5 − (ξ − a)², whose largest value is 5 at a.
        for a in [-0.97, 0.96, 0.0] {
            let parabola = parabola(a, a).map(|w| -w);
            let beside = on_two([[parabola[0] + 5.0, parabola[1], parabola[2], 0.0], [0.0; 4]]);
            let largest = beside.largest(&track(&beside)).0;
            assert!((largest - 5.0).abs() < 1e-14, "{a} {largest}");
        }
    }

    #[test]
    fn zeros_and_extremes_of_a_cubic_are_found_wherever_they_lie() {
        // ξ³ − ξ/4 on one element from 0 to 2: zeros at 1, 1 ± ½; extremes inside and 3/4 at the
        // ends.
        let stretches = Arc::new(vec![(1.0, 2.0)]);
        let shape = Shape {
            stretches,
            terms: 4,
            coefficients: vec![0.0, 0.6 - 0.25, 0.0, 0.4],
            turns: vec![],
        };
        let zeros = zeros(&shape);
        for (zero, exact) in zeros.iter().zip([0.5, 1.0, 1.5]) {
            assert!((zero - exact).abs() < 1e-15, "{zeros:?}");
        }
        assert_eq!(zeros.len(), 3);
        assert!((shape.deflection(2.0) - 0.75).abs() < 1e-15);
        assert!((shape.rotation(1.0) + 0.25).abs() < 1e-15);
    }

    #[test]
    fn a_zero_on_the_border_of_two_elements_is_one_node() {
        let stretches = Arc::new(vec![(0.5, 1.0), (1.5, 1.0)]);
        for tiny in [0.0, 1e-18, -1e-18] {
            let coefficients = vec![-0.5, 0.5 + tiny, 0.0, 0.0, 0.5 + tiny, 0.5, 0.0, 0.0];
            let shape =
                Shape { stretches: Arc::clone(&stretches), terms: 4, coefficients, turns: vec![] };
            let zeros = zeros(&shape);
            assert_eq!(zeros.len(), 1, "{zeros:?}");
            assert!((zeros[0] - 1.0).abs() < 1e-15);
        }
    }
}
