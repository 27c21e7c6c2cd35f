//! Which nodes of a mode are certain, and where can nodes not be determined?
//!
//! Let the deflection w be known to within e(x). Its sign is certain where `|w| > 3 e`. Between two places of different
//! certain sign lies a node, known to within `e/|w′|` if the slope there is w′. On a stretch with `|w| ≤ 3 e` the
//! computed zeros are not nodes: between equal signs, and up to an end of the bat, there may be none; between different
//! signs there is one somewhere in the stretch.
//!
//! The error e has three parts: the change due to the motion's own inertia ([`crate::beam::changes`]), the possible
//! shares of other modes ([`crate::modes::certificate`]), and round-off. Round-off is a share of the largest deflection
//! even where w is small, as between stiff springs, or in a thick part that a thin part leaves at rest.

use crate::modes::shape::Shape;

/// A sign is certain if the deflection is this many times its error: a number is wrong only if it is off by more than
/// this many stated errors.
const CERTAIN: f64 = 3.0;
/// A node is not sought within this share of the bat's length of a clamp.
pub const BESIDE_CLAMP: f64 = 1e-4;
/// A part between clamps that moves less than this share of another is at rest; its motion is the iteration's error.
pub const RESTING: f64 = 1e-3;

/// The possible error of a mode's deflection at each place, for a largest deflection of 1.
#[derive(Debug, Clone, Default)]
pub struct Doubt {
    /// Place (m), deflection and its change: the knob end, the points of all elements, the tip.
    pub places: Vec<[f64; 3]>,
    /// Places (m) where the deflection has a minimum of its size without crossing zero, and the deflection there.
    pub dips: Vec<[f64; 2]>,
    /// A deflection up to this counts as 0.
    pub rest: f64,
    /// Places where the bat is clamped and where it is pinned (m).
    pub held: [Vec<f64>; 2],
    /// The greatest `1/|w′|` of the nodes (m).
    pub flattest: f64,
    /// Round-off of the deflection.
    pub rounding: f64,
    /// Kinetic energy of weights off their place that cancels, over the kinetic energy that remains.
    pub cancelled: f64,
}

/// Possible shares of other modes in a mode.
#[derive(Clone, Copy, Default)]
pub struct Shares<'a> {
    /// Index of the other mode and its share.
    pub of: &'a [(usize, f64)],
    /// The known modes; a mode with another index is taken to move at each place as far as the largest of these.
    pub motions: &'a [Doubt],
}

impl Shares<'_> {
    /// Their largest contribution to the deflection at a place.
    fn at(&self, place: usize) -> f64 {
        let moves = |motion: &Doubt| motion.places[place][1].abs();
        let mixed = |(number, share): &(usize, f64)| match self.motions.get(*number) {
            Some(motion) => share * moves(motion),
            None => share * self.motions.iter().map(moves).fold(0.0, f64::max),
        };
        self.of.iter().map(mixed).sum()
    }
}

/// Nodes (m) that certainly exist, an error that covers the nodes in doubtful stretches, and the stretches where nodes
/// cannot be determined.
#[derive(Debug, Default, PartialEq)]
pub struct CertainNodes {
    /// Certain nodes (m).
    pub nodes: Vec<f64>,
    /// Error (m) of the worst node whose error does not follow from its slope; 0 if all do.
    pub error: f64,
    /// Beginning and end (m) of the stretches where nodes cannot be determined.
    pub untold: Vec<[f64; 2]>,
}

/// A place of certain sign, or the end of a part.
#[derive(Clone, Copy)]
struct SignedPlace {
    number: Option<usize>,
    x: f64,
    sign: f64,
}

/// One part of a bat between clamps or ends, as it is scanned.
struct SpanWalk<'a> {
    doubt: &'a Doubt,
    shape: &'a Shape,
    shares: Shares<'a>,
    nodes: &'a [f64],
    told: CertainNodes,
}

impl Doubt {
    /// The certain nodes of a shape in which other modes may have these shares.
    pub fn tell(&self, shape: &Shape, nodes: &[f64], shares: Shares) -> CertainNodes {
        let told =
            CertainNodes { nodes: Vec::with_capacity(nodes.len()), ..CertainNodes::default() };
        let mut way = SpanWalk { doubt: self, shape, shares, nodes, told };
        let [clamps, _] = &self.held;
        let mut borders: Vec<f64> = clamps.clone();
        borders.sort_by(f64::total_cmp);
        let mut from = 0;
        for border in borders.into_iter().chain([f64::INFINITY]) {
            let to = self.places.partition_point(|place| place[0] < border);
            way.part(from..to);
            from = to;
        }
        let mut told = way.told;
        told.nodes.sort_by(f64::total_cmp);
        told.untold.sort_by(|a, b| a[0].total_cmp(&b[0]));
        told
    }

    /// Possible error of the deflection at a place.
    fn error(&self, place: usize, shares: Shares) -> f64 {
        self.own(place) + shares.at(place)
    }

    /// The part of it due to mesh and round-off.
    fn own(&self, place: usize) -> f64 {
        let around = &self.places[place.saturating_sub(1)..(place + 2).min(self.places.len())];
        self.due_to(around.iter().map(|place| place[2].abs()).fold(0.0, f64::max))
    }

    /// The error of the deflection where its change is the greatest of the places around.
    fn due_to(&self, change: f64) -> f64 {
        (CERTAIN * (change + self.rounding)).max(self.rest) / CERTAIN
    }
}

impl SpanWalk<'_> {
    /// Finds the nodes among these places.
    fn part(&mut self, places: std::ops::Range<usize>) {
        let [clamps, pins] = &self.doubt.held;
        let length = self.shape.length();
        let beside = |x: f64, all: &[f64], share: f64| {
            all.iter().any(|held| (x - held).abs() <= share * length)
        };
        let [mut largest, mut changed] = [0.0_f64; 2];
        for [_, w, change] in &self.doubt.places[places.clone()] {
            largest = if w.abs() > largest { w.abs() } else { largest };
            changed = if change.abs() > changed { change.abs() } else { changed };
        }
        if places.is_empty() || (!clamps.is_empty() && largest <= RESTING) {
            return;
        }
        let most: f64 = self.shares.of.iter().map(|(_, share)| share).sum();
        let end =
            |place: usize| SignedPlace { number: None, x: self.doubt.places[place][0], sign: 0.0 };
        let (mut last, mut doubtful) = (end(places.start), vec![]);
        let mut before = self.nodes.partition_point(|node| *node < last.x);
        let past = end(places.end - 1);
        // Enough anywhere on a part whose neighbours' changes are its own.
        let (free, enough) =
            (clamps.is_empty() && pins.is_empty(), self.doubt.due_to(changed) + most);
        let plain = free && self.doubt.dips.is_empty();
        for number in places {
            let [x, w, _] = self.doubt.places[number];
            if beside(x, clamps, BESIDE_CLAMP) || beside(x, pins, 1e-12) {
                continue;
            }
            let certain = free && w.abs() > CERTAIN * enough
                || w.abs() > CERTAIN * (self.doubt.own(number) + most)
                || w.abs() > CERTAIN * self.doubt.error(number, self.shares);
            if !certain {
                doubtful.push(number);
                continue;
            }
            let next = SignedPlace { number: Some(number), x, sign: w.signum() };
            let nodes = self.nodes[before..].iter().take_while(|node| **node <= x).count();
            before += nodes;
            if plain && nodes == 1 && doubtful.is_empty() {
                self.told.nodes.push(self.nodes[before - 1]);
            } else if nodes > 0 || !doubtful.is_empty() || !self.doubt.dips.is_empty() {
                self.between(last, next, &doubtful);
            }
            doubtful.clear();
            last = next;
        }
        self.between(last, past, &doubtful);
    }

    /// Finds the nodes between two places of certain sign, or between one and the end of a part, when the places
    /// between have an uncertain sign.
    fn between(&mut self, a: SignedPlace, b: SignedPlace, doubtful: &[usize]) {
        let [_, pins] = &self.doubt.held;
        let inside = |x: &&f64| **x >= a.x && **x <= b.x && !self.told.nodes.contains(x);
        let pinned =
            |x: &f64| pins.iter().any(|pin| (x - pin).abs() <= 1e-12 * self.shape.length());
        let (fixed, free): (Vec<f64>, Vec<f64>) =
            self.nodes.iter().filter(inside).copied().partition(pinned);
        let odd = a.sign * b.sign < 0.0;
        if doubtful.is_empty() {
            return self.without_doubt([a, b], fixed, free);
        }
        let ends = [self.end(a, doubtful[0]), self.end(b, doubtful[doubtful.len() - 1])];
        let middle = 0.5 * (ends[0] + ends[1]);
        let node =
            free.iter().copied().min_by(|x, y| (x - middle).abs().total_cmp(&(y - middle).abs()));
        let one = (odd == (fixed.len() % 2 == 0))
            .then_some(node)
            .flatten()
            .filter(|_| a.sign != 0.0 && b.sign != 0.0);
        self.told.nodes.extend(fixed.iter().copied().chain(one));
        // Zeros that were found but are not certain belong to the stretch.
        let ends = free.iter().fold(ends, |[a, b], x| [a.min(*x), b.max(*x)]);
        let far = one.map_or(0.0, |x| (x - ends[0]).max(ends[1] - x));
        let error = doubtful.iter().map(|k| self.doubt.error(*k, self.shares)).fold(0.0, f64::max);
        let slope = one.map_or(0.0, |x| self.shape.slopes(&[x])[0].2.abs());
        // If the slope is the same all over the stretch, the error of the node follows from it.
        let straight = one.is_some() && free.len() == 1 && far * slope <= 2.0 * CERTAIN * error;
        if !straight {
            self.told.error = self.told.error.max(far);
            self.told.untold.push(ends);
        }
    }

    /// Place where the deflection falls to its error, between a certain place and a doubtful one.
    fn end(&self, certain: SignedPlace, doubtful: usize) -> f64 {
        let Some(number) = certain.number else { return certain.x };
        let ([x, w, _], [to, at, _]) = (self.doubt.places[number], self.doubt.places[doubtful]);
        let error = CERTAIN * self.doubt.error(doubtful, self.shares);
        let (w, at) = (w.abs(), at * w.signum());
        if w > error { x + (to - x) * ((w - error) / (w - at)).clamp(0.0, 1.0) } else { x }
    }

    /// Between two adjacent certain places, all zeros that were found are nodes, except two between which the
    /// deflection stays below its error. Where it only comes that close to zero, there may be two.
    fn without_doubt(&mut self, [a, b]: [SignedPlace; 2], fixed: Vec<f64>, free: Vec<f64>) {
        let mut dips =
            self.doubt.dips.iter().filter(|dip| dip[0] >= a.x && dip[0] <= b.x).peekable();
        if free.len() < 2 && dips.peek().is_none() {
            self.told.nodes.extend(free.iter().chain(&fixed));
            return;
        }
        let error =
            |side: SignedPlace| side.number.map_or(0.0, |k| self.doubt.error(k, self.shares));
        let least = CERTAIN * error(a).max(error(b));
        let own = |x: f64| self.shape.derivatives_at(x);
        match free[..] {
            [first, second] if own(0.5 * (first + second))[0].abs() <= least => {
                self.told.untold.push(self.around(0.5 * (first + second), least));
            }
            _ => self.told.nodes.extend(&free),
        }
        self.told.nodes.extend(&fixed);
        let near: Vec<f64> = dips.filter(|dip| dip[1].abs() <= least).map(|dip| dip[0]).collect();
        for x in near {
            self.told.untold.push(self.around(x, least));
        }
    }

    /// The surroundings of a place with zero slope in which the curvature keeps the deflection below `least`.
    fn around(&self, x: f64, least: f64) -> [f64; 2] {
        let [w, _, bend] = self.shape.derivatives_at(x);
        let far = (2.0 * (least + w.abs()) / bend.abs()).sqrt();
        [(x - far).max(0.0), (x + far).min(self.shape.length())]
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;

    /// `w = slope (x − node)` on a bat of 1 m, known within `error`.
    fn line(slope: f64, node: f64, error: f64) -> (Shape, Doubt) {
        let w = |x: f64| slope * (x - node);
        let shape = Shape {
            stretches: Arc::new(vec![(0.5, 1.0)]),
            terms: 4,
            coefficients: vec![w(0.5), 0.5 * slope, 0.0, 0.0],
            turns: vec![],
        };
        let places = (0..=10).map(|k| [0.1 * f64::from(k), w(0.1 * f64::from(k)), 0.0]).collect();
        (shape, Doubt { places, rounding: error, ..Doubt::default() })
    }

    #[test]
    fn a_node_is_told_where_both_signs_beside_it_are_certain() {
        let (shape, doubt) = line(1.0, 0.42, 1e-3);
        let told = doubt.tell(&shape, &[0.42], Shares::default());
        assert_eq!(told, CertainNodes { nodes: vec![0.42], error: 0.0, untold: vec![] });
        // Also if a point lies beside the node, within its error.
        let (shape, doubt) = line(1.0, 0.401, 1e-3);
        assert_eq!(doubt.tell(&shape, &[0.401], Shares::default()).nodes, [0.401]);
        assert_eq!(doubt.tell(&shape, &[0.401], Shares::default()).untold, [[0.0; 2]; 0]);
    }

    #[test]
    fn a_sign_change_at_an_end_that_is_smaller_than_the_error_is_no_node() {
        let (shape, doubt) = line(1.0, 0.02, 0.01);
        let told = doubt.tell(&shape, &[0.02], Shares::default());
        assert!(told.nodes.is_empty(), "{told:?}");
        assert!((told.untold[0][1] - 0.05).abs() < 1e-12, "{told:?}");
    }

    #[test]
    fn what_another_mode_may_have_there_counts() {
        let ((shape, doubt), (_, other)) = (line(1.0, 0.05, 0.0), line(0.0, 0.0, 0.0));
        let moving = Doubt {
            places: other.places.iter().map(|p| [p[0], 1.0, 0.0]).collect(),
            ..other.clone()
        };
        let nodes = |motion: Doubt| {
            let shares = Shares { of: &[(0, 0.1)], motions: &[motion] };
            doubt.tell(&shape, &[0.05], shares).nodes
        };
        assert_eq!(nodes(other), [0.05]);
        assert!(nodes(moving).is_empty());
    }
}
