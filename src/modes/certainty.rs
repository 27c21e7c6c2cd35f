//! Which nodes of a mode are certain, and where can none be told?
//!
//! A deflection w of which every place is known within e(x) has a certain sign where `|w| > 3 e`. Between two
//! places of different certain sign is a node, and one of the slope w′ is known within `e/|w′|`. On a stretch
//! where `|w| ≤ 3 e` the computed zeros are not nodes: between equal signs, and up to an end of the bat, there
//! may be none; between different ones there is one, anywhere in the stretch.
//!
//! Parts of e: the change that the motion's own inertia makes ([`crate::beam::changes`]), the shares that other
//! modes may have ([`crate::modes::certificate`]), and round-off, which is a share of the largest deflection
//! however small w is: between stiff springs, or in a thick part that a thin one lets stand still.

use crate::modes::shape::Shape;

/// A sign is certain where the deflection is this many times its error: beyond that many stated errors a number
/// is false.
const CERTAIN: f64 = 3.0;
/// A node is not sought within this share of the bat's length of a clamp.
pub const BESIDE_CLAMP: f64 = 1e-4;
/// A part between clamps that moves less than this share of another is at rest but for what the iteration
/// left.
pub const RESTING: f64 = 1e-3;

/// What may be off in a mode's deflection, place by place, for a largest deflection of 1.
#[derive(Debug, Clone, Default)]
pub struct Doubt {
    /// Place (m), deflection and its change: the knob end, the points of all elements, the tip.
    pub places: Vec<[f64; 3]>,
    /// Places (m) where the deflection comes nearest to zero without crossing it, and the deflection there.
    pub dips: Vec<[f64; 2]>,
    /// A deflection of at most this is 0.
    pub rest: f64,
    /// Where the bat is clamped and where it is pinned (m).
    pub held: [Vec<f64>; 2],
    /// The greatest `1/|w′|` of the nodes (m).
    pub flattest: f64,
    /// Round-off of the deflection.
    pub rounding: f64,
    /// What cancels of the kinetic energy of weights off their place, over all that is left.
    pub cancelled: f64,
}

/// Shares that other motions may have in a mode.
#[derive(Clone, Copy, Default)]
pub struct Shares<'a> {
    /// Number of the motion and its share.
    pub of: &'a [(usize, f64)],
    /// The motions that are known; one with another number moves nowhere more than all of these.
    pub motions: &'a [Doubt],
}

impl Shares<'_> {
    /// How much of the deflection at a place they may be.
    fn at(&self, place: usize) -> f64 {
        let moves = |motion: &Doubt| motion.places[place][1].abs();
        let mixed = |(number, share): &(usize, f64)| match self.motions.get(*number) {
            Some(motion) => share * moves(motion),
            None => share * self.motions.iter().map(moves).fold(0.0, f64::max),
        };
        self.of.iter().map(mixed).sum()
    }
}

/// Nodes (m) that are there, an error that holds for those in doubtful stretches, and the stretches where nodes
/// cannot be told.
#[derive(Debug, Default, PartialEq)]
pub struct CertainNodes {
    /// Certain nodes (m).
    pub nodes: Vec<f64>,
    /// Error (m) of the worst of those whose slope does not tell it; 0 if all do.
    pub error: f64,
    /// From where to where (m) nodes cannot be told.
    pub untold: Vec<[f64; 2]>,
}

/// A place of a certain sign, or the end of a part.
#[derive(Clone, Copy)]
struct Side {
    number: Option<usize>,
    x: f64,
    sign: f64,
}

/// One part of a bat between clamps or ends, on the way along it.
struct SpanWalk<'a> {
    doubt: &'a Doubt,
    shape: &'a Shape,
    shares: Shares<'a>,
    nodes: &'a [f64],
    told: CertainNodes,
}

impl Doubt {
    /// Which of a shape's nodes are certain where other motions may have these shares in it.
    pub fn tell(&self, shape: &Shape, nodes: &[f64], shares: Shares) -> CertainNodes {
        let mut way = SpanWalk { doubt: self, shape, shares, nodes, told: CertainNodes::default() };
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

    /// How far the deflection at a place may be off.
    fn error(&self, place: usize, shares: Shares) -> f64 {
        self.own(place) + shares.at(place)
    }

    /// What the mesh and round-off may have done there.
    fn own(&self, place: usize) -> f64 {
        let around = &self.places[place.saturating_sub(1)..(place + 2).min(self.places.len())];
        let change = around.iter().map(|place| place[2].abs()).fold(0.0, f64::max);
        (CERTAIN * (change + self.rounding)).max(self.rest) / CERTAIN
    }
}

impl SpanWalk<'_> {
    /// Tells the nodes among these places.
    fn part(&mut self, places: std::ops::Range<usize>) {
        let [clamps, pins] = &self.doubt.held;
        let length = self.shape.length();
        let beside = |x: f64, all: &[f64], share: f64| {
            all.iter().any(|held| (x - held).abs() <= share * length)
        };
        let largest =
            self.doubt.places[places.clone()].iter().map(|p| p[1].abs()).fold(0.0, f64::max);
        if places.is_empty() || (!clamps.is_empty() && largest <= RESTING) {
            return;
        }
        let most: f64 = self.shares.of.iter().map(|(_, share)| share).sum();
        let end = |place: usize| Side { number: None, x: self.doubt.places[place][0], sign: 0.0 };
        let (mut last, mut doubtful) = (end(places.start), vec![]);
        let mut before = self.nodes.partition_point(|node| *node < last.x);
        let past = end(places.end - 1);
        for number in places {
            let [x, w, _] = self.doubt.places[number];
            if beside(x, clamps, BESIDE_CLAMP) || beside(x, pins, 1e-12) {
                continue;
            }
            let certain = w.abs() > CERTAIN * (self.doubt.own(number) + most)
                || w.abs() > CERTAIN * self.doubt.error(number, self.shares);
            if !certain {
                doubtful.push(number);
                continue;
            }
            let next = Side { number: Some(number), x, sign: w.signum() };
            let nodes = self.nodes[before..].iter().take_while(|node| **node <= x).count();
            before += nodes;
            if nodes > 0 || !doubtful.is_empty() || !self.doubt.dips.is_empty() {
                self.between(last, next, &doubtful);
            }
            doubtful.clear();
            last = next;
        }
        self.between(last, past, &doubtful);
    }

    /// Tells the nodes between two places of certain sign, or such a one and the end of a part, where the
    /// sign of those places is not certain.
    fn between(&mut self, a: Side, b: Side, doubtful: &[usize]) {
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
        // What was found and is not certain lies in the stretch.
        let ends = free.iter().fold(ends, |[a, b], x| [a.min(*x), b.max(*x)]);
        let far = one.map_or(0.0, |x| (x - ends[0]).max(ends[1] - x));
        let error = doubtful.iter().map(|k| self.doubt.error(*k, self.shares)).fold(0.0, f64::max);
        let slope = one.map_or(0.0, |x| self.shape.slopes(&[x])[0].2.abs());
        // As steep as at the node all over the stretch: the slope tells.
        let straight = one.is_some() && free.len() == 1 && far * slope <= 2.0 * CERTAIN * error;
        if !straight {
            self.told.error = self.told.error.max(far);
            self.told.untold.push(ends);
        }
    }

    /// Where the deflection is as small as its error on the way from a certain place to a doubtful one.
    fn end(&self, certain: Side, doubtful: usize) -> f64 {
        let Some(number) = certain.number else { return certain.x };
        let ([x, w, _], [to, at, _]) = (self.doubt.places[number], self.doubt.places[doubtful]);
        let error = CERTAIN * self.doubt.error(doubtful, self.shares);
        let (w, at) = (w.abs(), at * w.signum());
        if w > error { x + (to - x) * ((w - error) / (w - at)).clamp(0.0, 1.0) } else { x }
    }

    /// Between two certain places beside each other are all zeros that were found, but for two between which
    /// the deflection is smaller than its error; and where it comes as near to zero, two may be.
    fn without_doubt(&mut self, [a, b]: [Side; 2], fixed: Vec<f64>, free: Vec<f64>) {
        let mut dips =
            self.doubt.dips.iter().filter(|dip| dip[0] >= a.x && dip[0] <= b.x).peekable();
        if free.len() < 2 && dips.peek().is_none() {
            self.told.nodes.extend(free.iter().chain(&fixed));
            return;
        }
        let error = |side: Side| side.number.map_or(0.0, |k| self.doubt.error(k, self.shares));
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

    /// As far around a place without slope as the bend leaves the deflection smaller than that.
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
        // Even where a point lies beside the node, in its error.
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
