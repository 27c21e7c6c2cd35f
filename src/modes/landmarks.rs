//! Where is a deflection zero, where is it largest, and how far may its zeros be off?

use crate::base::{Over, Real};
use crate::beam::{MOST_POINTS, Motion, View};
use crate::modes::shape::Shape;

/// A motion from knob to tip in one lane, at the points of its elements.
pub struct Track<'a> {
    /// Deflections (m).
    pub samples: Vec<f64>,
    /// Their changes (m), as [`Motion::changes`].
    pub changes: Vec<f64>,
    /// Deflection and change at the knob end and at the tip.
    pub ends: [[f64; 2]; 2],
    /// Points of an element as ξ.
    xi: &'a [f64],
}

/// Room for the places of one element: ξ and deflection at both ends and at the points.
type Room = [(f64, f64); MOST_POINTS + 2];
const NO_PLACES: Room = [(0.0, 0.0); MOST_POINTS + 2];

impl Track<'_> {
    /// The motion in that lane.
    pub fn new<S: Real, R: Over<S>>(view: &View<S>, motion: &Motion<R>, lane: usize) -> Self {
        let points = view.rule.count();
        let split = points * view.split;
        let along = |values: &[R]| -> Vec<f64> {
            let (knob, tip) = values.split_at(split);
            knob.iter().rev().chain(tip).map(|v| v.lane(lane)).collect()
        };
        let samples = along(&motion.deflections);
        let changes = along(&motion.changes);
        let mut ends = motion.ends.map(|end| end.map(|v| v.lane(lane)));
        if view.split == 0 {
            // The root is the knob end itself.
            ends[0][1] = changes[0];
        }
        Self { samples, changes, ends, xi: &view.rule.xi }
    }

    /// Place (m), deflection and change at the knob end, at the points of elements with those middles and lengths, and
    /// at the tip; deflections and changes are multiplied by `scale`.
    pub(super) fn places(&self, stretches: &[(f64, f64)], scale: f64) -> Vec<[f64; 3]> {
        let end = |x: f64, [w, change]: [f64; 2]| [x, scale * w, scale * change];
        let (middle, length) = stretches.last().copied().unwrap_or_default();
        let mut places = Vec::with_capacity(self.samples.len() + 2);
        places.push(end(0.0, self.ends[0]));
        let mut both = self.samples.iter().zip(&self.changes);
        for (middle, length) in stretches {
            for (xi, (w, change)) in self.xi.iter().zip(both.by_ref()) {
                places.push(end(middle + 0.5 * length * xi, [*w, *change]));
            }
        }
        places.push(end(middle + 0.5 * length, self.ends[1]));
        places
    }

    /// The greatest distance in ξ between two adjacent places, ends included.
    fn widest(&self) -> f64 {
        let (first, last) = (self.xi.first().unwrap_or(&1.0), self.xi.last().unwrap_or(&-1.0));
        let inner = self.xi.windows(2).map(|pair| pair[1] - pair[0]);
        inner.fold((first + 1.0).max(1.0 - last), f64::max)
    }
}

impl Shape {
    /// Deflection at the left end, the points and the right end of element `k`, from its values at
    /// the points.
    fn places<'r>(&self, k: usize, track: &Track, room: &'r mut Room) -> &'r mut [(f64, f64)] {
        let points = track.xi.len();
        let [left, right] = self.ends(k);
        let inner = track.samples[k * points..(k + 1) * points].iter();
        let places = &mut room[..points + 2];
        places[0] = (-1.0, left);
        for (place, inner) in
            places[1..].iter_mut().zip(track.xi.iter().copied().zip(inner.copied()))
        {
            *place = inner;
        }
        places[points + 1] = (1.0, right);
        places
    }

    /// Deflection at the left and the right end of element `k`.
    fn ends(&self, k: usize) -> [f64; 2] {
        let own = &self.coefficients[k * self.terms..(k + 1) * self.terms];
        let [mut even, mut odd] = [0.0; 2];
        for pair in own.chunks(2) {
            even += pair[0];
            odd += pair.get(1).unwrap_or(&0.0);
        }
        [even - odd, even + odd]
    }

    /// Least and greatest deflection at the places of element `k`.
    fn between(&self, k: usize, track: &Track) -> [f64; 2] {
        let points = track.xi.len();
        let [left, right] = self.ends(k);
        let (mut least, mut most) = (left.min(right), left.max(right));
        for w in &track.samples[k * points..(k + 1) * points] {
            (least, most) =
                (if *w < least { *w } else { least }, if *w > most { *w } else { most });
        }
        [least, most]
    }

    /// The largest |deflection| of the continuous shape, and the relative change there. It may lie at the end of an
    /// element, where joints make cusps, or at a peak between places.
    pub(super) fn largest(&self, track: &Track) -> (f64, f64) {
        let points = track.xi.len();
        let [knob, tip] = track.ends;
        let end = if knob[0].abs() > tip[0].abs() { knob } else { tip };
        let (mut most, mut change) = (end[0].abs(), end[1] / end[0]);
        for (w, changed) in track.samples.iter().zip(&track.changes) {
            if w.abs() > most {
                (most, change) = (w.abs(), changed / w);
            }
        }
        let (widest, mut room) = (track.widest(), NO_PLACES);
        for k in 0..self.stretches.len() {
            let [lowest, greatest] = self.between(k, track);
            // The slope is zero at a peak, so it exceeds the places beside it by at most this.
            let higher = 0.5 * self.most_bend(k) * widest * widest;
            if greatest.max(-lowest) + higher <= most {
                continue;
            }
            let places = self.places(k, track, &mut room);
            let size = |j: usize| places.get(j).map_or(0.0, |(_, w)| w.abs());
            for j in 0..places.len() {
                let highest_here = size(j) >= size(j.wrapping_sub(1)) && size(j) >= size(j + 1);
                if size(j) + higher <= most || !highest_here {
                    continue;
                }
                let peak = self.extreme(k, places, j).1.abs().max(size(j));
                if peak > most {
                    let near = k * points + j.saturating_sub(1).min(points - 1);
                    (most, change) = (peak, track.changes[near] / track.samples[near]);
                }
            }
        }
        (most, change)
    }

    /// The place ξ beside place `j` of element `k` where the slope is zero, and the deflection there. It is place `j`
    /// itself if the slope has one sign up to the next places.
    fn extreme(&self, k: usize, places: &[(f64, f64)], j: usize) -> (f64, f64) {
        let slope = |xi: f64| self.derivatives(k, xi)[1];
        let (at, value) = places[j];
        let here = slope(at);
        let beside = [j.wrapping_sub(1), j + 1].map(|j| places.get(j).map(|place| place.0));
        let across = |xi: &f64| here * slope(*xi) < 0.0;
        let Some(mut other) = beside.into_iter().flatten().find(across) else { return (at, value) };
        let (mut own, mut xi) = (at, at);
        // Newton's steps if they stay inside the shrinking bracket, otherwise halving.
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
    /// A deflection of at most `rest` counts as 0: a stretch at rest has no nodes. Beside a place of zero deflection,
    /// such as a pin, the slope gives the sign. Between two places of one sign there are two zeros if the deflection
    /// crosses zero at its extremum.
    ///
    /// Also returns the places (m) where the deflection has an extremum near zero without crossing, and the deflection
    /// there.
    pub(super) fn zeros(&self, track: &Track, rest: f64) -> (Vec<f64>, Vec<[f64; 2]>) {
        let (mut zeros, mut dips) = (Vec::with_capacity(16), Vec::new());
        let mut room = NO_PLACES;
        // The last sign of the deflection, and its value at the end of the last element.
        let (mut before, mut border) = (0.0, None);
        let widest = track.widest();
        for (k, (middle, length)) in self.stretches.iter().enumerate() {
            let [lowest, greatest] = self.between(k, track);
            let (nearest, sign) = (lowest.max(-greatest), if lowest > 0.0 { 1.0 } else { -1.0 });
            if nearest > rest
                && sign * before >= 0.0
                && sign * border.unwrap_or(sign) > rest
                && 8.0 * nearest > self.most_bend(k) * widest * widest
            {
                // There is no zero, and no room for two zeros between two places.
                (before, border) = (sign, Some(self.ends(k)[1]));
                continue;
            }
            let places = self.places(k, track, &mut room);
            places[0].1 = border.unwrap_or(places[0].1);
            border = places.last().map(|place| place.1);
            places.iter_mut().filter(|place| place.1.abs() <= rest).for_each(|at| at.1 = 0.0);
            let bend = self.most_bend(k);
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
                    // A zero at a place itself is not the zero that is sought.
                    let (left, a) = match a {
                        0.0 if signs[0] != 0.0 => self.off(k, [left, right], first),
                        _ => (left, first * a.abs()),
                    };
                    let (right, b) = match b {
                        0.0 => self.off(k, [right, left], signs[1]),
                        _ => (right, b),
                    };
                    add(self.zero(k, left, right, a, b));
                } else if 8.0 * a.abs().min(b.abs()) <= bend * (right - left).powi(2)
                    && let Some((xi, w)) = self.dip(k, places, j)
                {
                    if w * first < 0.0 {
                        add(self.zero(k, left, xi, a, w));
                        add(self.zero(k, xi, right, w, b));
                    } else {
                        dips.push([middle + 0.5 * length * xi, w]);
                    }
                }
                before = if signs[1] == 0.0 { first } else { signs[1] };
            }
        }
        (zeros, dips)
    }

    /// The first place from one end to the other of element `k`, by halving, where the deflection has that sign, and
    /// the deflection there.
    fn off(&self, k: usize, [from, to]: [f64; 2], sign: f64) -> (f64, f64) {
        let value = |xi: f64| (xi, self.derivatives(k, xi)[0]);
        let mut halves = (1..52).map(|halvings| value(from + (to - from) * 0.5f64.powi(halvings)));
        let found = halves.find(|(_, w)| w * sign > 0.0);
        found.unwrap_or((from, sign * f64::MIN_POSITIVE))
    }

    /// The sign of the deflection at a place of element `k`, or just beside it on the way `to` another place, where the
    /// deflection is `other`.
    fn sign(&self, k: usize, (xi, w): (f64, f64), to: f64, other: f64) -> f64 {
        // A slope that adds less than this share of the other deflection belongs to a clamp.
        const FLAT: f64 = 1e-6;
        if w != 0.0 {
            return w.signum();
        }
        let rise = self.derivatives(k, xi)[1] * to;
        if other != 0.0 && rise.abs() > FLAT * other.abs() { rise.signum() } else { 0.0 }
    }

    /// An upper bound of the second derivative by ξ on element `k`: `|P_j″| ≤ P_j″(1) = (j − 1) j (j + 1) (j + 2)/8`.
    /// Between two places the deflection departs from its chord by at most an eighth of it times the squared distance.
    fn most_bend(&self, k: usize) -> f64 {
        let own = &self.coefficients[k * self.terms..(k + 1) * self.terms];
        let of = |(j, w): (usize, &f64)| {
            let j = j as f64;
            (j - 1.0) * j * (j + 1.0) * (j + 2.0) / 8.0 * w.abs()
        };
        own.iter().enumerate().map(of).sum()
    }

    /// The place between places `j − 1` and `j` of element `k` where the deflection is nearest to zero, and the
    /// deflection there; `None` if it cannot lie between them.
    fn dip(&self, k: usize, places: &[(f64, f64)], j: usize) -> Option<(f64, f64)> {
        let size = |j: usize| places.get(j).map_or(f64::INFINITY, |(_, w)| w.abs());
        let lowest = |j: usize| size(j) <= size(j.wrapping_sub(1)) && size(j) <= size(j + 1);
        let nearest = [j - 1, j].into_iter().find(|j| size(*j) > 0.0 && lowest(*j))?;
        let (xi, w) = self.extreme(k, places, nearest);
        (xi > places[j - 1].0 && xi < places[j].0).then_some((xi, w))
    }

    /// Removes the nodes on stretches between clamps where the deflection never exceeds `rest`.
    pub(super) fn leave_still(
        &self,
        nodes: &mut Vec<f64>,
        clamps: &[f64],
        track: &Track,
        rest: f64,
    ) {
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

    /// The zero between `left` and `right` on element `k`, where the deflection has different signs: Halley's steps
    /// `ξ − w w′/(w′² − ½ w w″)` if they stay inside the shrinking bracket, otherwise halving.
    fn zero(&self, k: usize, mut left: f64, mut right: f64, before: f64, after: f64) -> f64 {
        let halley = |xi: f64| {
            let [value, slope, bend] = self.derivatives(k, xi);
            let step = value * slope / (slope * slope - 0.5 * value * bend);
            let near = value.abs() <= 2.0 * SMALL * slope.abs();
            (value, xi - step, near && (value * bend).abs() <= 4.0 * SMALL * slope * slope)
        };
        // The error is about the cube of the step over the squared distance to the place of zero slope. After a step of
        // 1e-5 of both it is below round-off.
        const SMALL: f64 = 1e-5;
        let start = left + (right - left) * (before / (before - after));
        // Two steps are nearly always enough, and need no further test.
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

    /// Largest possible error of the nodes (m), the change of the deflection at each over its slope; and the largest
    /// 1/slope (m per unit of deflection).
    pub(super) fn node_error(&self, nodes: &[f64], track: &Track) -> [f64; 2] {
        let points = track.xi.len();
        let error = |x: &f64| {
            let (k, xi) = self.locate(*x);
            let [_, slope, _] = self.derivatives(k, xi);
            let near = track.xi.partition_point(|at| *at < xi);
            let around = [near.saturating_sub(1), near.min(points - 1)];
            let change = around.map(|i| track.changes[k * points + i].abs());
            let flat = 0.5 * self.stretches[k].1 / slope.abs();
            [flat * f64::max(change[0], change[1]), flat]
        };
        let worst = |[a, b]: [f64; 2], [c, d]: [f64; 2]| [a.max(c), b.max(d)];
        nodes.iter().map(error).fold([0.0; 2], worst)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;

    const PLACES: [f64; 6] = [-0.93, -0.66, -0.24, 0.24, 0.66, 0.93];

    /// A shape's values at the points of its elements, taken as exact.
    fn track(shape: &Shape) -> Track<'static> {
        let samples = |k: usize| PLACES.map(|xi| shape.derivatives(k, xi)[0]);
        let samples: Vec<f64> = (0..shape.stretches.len()).flat_map(samples).collect();
        let last = shape.stretches.len() - 1;
        let ends = [(0, -1.0), (last, 1.0)].map(|(k, xi)| [shape.derivatives(k, xi)[0], 0.0]);
        Track { changes: vec![0.0; samples.len()], samples, ends, xi: &PLACES }
    }

    fn zeros(shape: &Shape) -> Vec<f64> {
        shape.zeros(&track(shape), 1e-15).0
    }

    /// A shape with those Legendre coefficients on two elements, from 0 to 1 and from 1 to 2.
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
            // Beyond the pin (ξ + 1)(ξ − node), before it a line with the same slope.
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
