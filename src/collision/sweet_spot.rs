//! Where is the sweet spot, by each of its definitions.

use crate::bat::Bat;
use crate::collision::hit::Scene;
use crate::collision::hitter::{Glance, Hitter};
use crate::solve::Solution;
use crate::threads;

/// A place and the value there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// From the knob end (m).
    pub x: f64,
    /// What is largest or least there, in its own unit.
    pub value: f64,
}

/// The sweet spot of the outer half of a bat, by every definition there is a number for.
#[derive(Debug, Clone, PartialEq)]
pub struct SweetSpot {
    /// Where the ball leaves fastest (m/s).
    pub exit_speed_max: Option<Peak>,
    /// Where the least energy stays in vibration (J).
    pub vibration_min: Option<Peak>,
    /// The barrel-side node of the first bending mode (m).
    pub node_mode_1: Option<f64>,
    /// The same node of the second mode (m).
    pub node_mode_2: Option<f64>,
    /// The centre of percussion for the swing's own pivot (m).
    pub center_of_percussion: Option<f64>,
    /// Where the hands feel the least velocity (m/s), as [`Glance::hands`] counts it.
    pub hands_velocity_min: Option<Peak>,
    /// The same of the acceleration (m/s²).
    pub hands_acceleration_min: Option<Peak>,
    /// Where the exit speed is within 1 % of its maximum (m).
    pub zone: Option<[f64; 2]>,
    /// Exit speeds (m/s) an inch from the best place, towards the knob and towards the tip.
    pub inch_off: Option<[Option<f64>; 2]>,
}

/// Points of the first look along the outer half.
const GRID: usize = 128;
/// A place is located to this share of the outer half.
const WIDTH: f64 = 1e-6;
const INCH: f64 = 0.0254;

impl SweetSpot {
    /// Searched from the middle of the bat to its tip.
    pub fn find(bat: &Bat, scene: &Scene, solution: &Solution, hitter: &Hitter) -> Self {
        let outer = [0.5 * bat.length(), bat.length()];
        let looked = Looked::new(outer, hitter);
        let exit_speed_max = looked.greatest(|glance| Some(glance.exit_speed));
        let least = |of: fn(&Glance) -> Option<f64>| {
            let greatest = looked.greatest(|glance| of(glance).map(|value| -value))?;
            Some(Peak { x: greatest.x, value: -greatest.value })
        };
        let last_node = |k: usize| solution.modes.get(k).and_then(|m| m.nodes.last().copied());
        let off = |peak: Peak, by: f64| {
            let x = peak.x + by;
            (x <= bat.length()).then(|| hitter.glance(x).map(|glance| glance.exit_speed)).flatten()
        };
        // Hands on a pin feel nothing, and without modes nothing shakes them.
        let feels = |k: usize| {
            let felt = looked.seen.iter().flatten().map(|glance| glance.hands[k]);
            felt.fold(0.0, f64::max) > [1e-9, 1e-5][k]
        };
        // As the hit has it: without rotary inertia, of a line of mass.
        let body = bat.inertia();
        let body = if solution.theory.turns() { body } else { body.as_line() };
        Self {
            zone: exit_speed_max.map(|peak| looked.zone(peak)),
            inch_off: exit_speed_max.map(|peak| [off(peak, -INCH), off(peak, INCH)]),
            exit_speed_max,
            vibration_min: least(|glance| glance.vibration),
            hands_velocity_min: least(|g| Some(g.hands[0])).filter(|_| feels(0)),
            hands_acceleration_min: least(|g| Some(g.hands[1])).filter(|_| feels(1)),
            node_mode_1: last_node(0),
            node_mode_2: last_node(1),
            center_of_percussion: body.center_of_percussion(-scene.pivot),
        }
    }
}

/// A stretch of a bat after a first look along it.
pub struct Looked<'a> {
    ends: [f64; 2],
    hitter: &'a Hitter<'a>,
    seen: Vec<Option<Glance>>,
}

impl<'a> Looked<'a> {
    /// Looks along that stretch (m).
    pub fn new(ends: [f64; 2], hitter: &'a Hitter<'a>) -> Self {
        let seen = threads::map(GRID + 1, |k| hitter.glance(place(ends, k)));
        Self { ends, hitter, seen }
    }

    /// The place of the greatest value: the best of the first look, then golden-section search.
    pub fn greatest(&self, value: impl Fn(&Glance) -> Option<f64>) -> Option<Peak> {
        let of =
            |glance: &Option<Glance>| glance.as_ref().and_then(&value).unwrap_or(f64::NEG_INFINITY);
        let best = (0..=GRID).max_by(|&a, &b| of(&self.seen[a]).total_cmp(&of(&self.seen[b])))?;
        let seen = of(&self.seen[best]);
        if seen == f64::NEG_INFINITY {
            return None;
        }
        let at = |x: f64| of(&self.hitter.glance(x));
        let low = place(self.ends, best.saturating_sub(1));
        let high = place(self.ends, (best + 1).min(GRID));
        let width = WIDTH * (self.ends[1] - self.ends[0]);
        let found = golden([low, high], width, at);
        // The ends of the interval may be the best, where the search only comes near.
        let here = Peak { x: place(self.ends, best), value: seen };
        Some(if found.value > here.value { found } else { here })
    }

    /// How far from the peak the exit speed stays within 1 %, bisected on both sides.
    fn zone(&self, peak: Peak) -> [f64; 2] {
        let floor = peak.value - 0.01 * peak.value.abs();
        let enough = |glance: &Option<Glance>| glance.is_some_and(|g| g.exit_speed >= floor);
        let [from, to] = self.ends;
        let edge = |end: f64, bad: Option<usize>| {
            let Some(bad) = bad else { return end };
            let mut bad = place(self.ends, bad);
            let mut inside = peak.x;
            while (bad - inside).abs() > WIDTH * (to - from) {
                let middle = 0.5 * (bad + inside);
                if enough(&self.hitter.glance(middle)) { inside = middle } else { bad = middle }
            }
            inside
        };
        let poor = |k: &usize| !enough(&self.seen[*k]);
        let below = (0..=GRID).rev().filter(|k| place(self.ends, *k) < peak.x).find(poor);
        let above = (0..=GRID).filter(|k| place(self.ends, *k) > peak.x).find(poor);
        [edge(from, below), edge(to, above)]
    }
}

/// The k-th place of a first look.
fn place([from, to]: [f64; 2], k: usize) -> f64 {
    from + (to - from) * k as f64 / GRID as f64
}

/// The greatest value on an interval that has one maximum, located to that width.
fn golden([mut low, mut high]: [f64; 2], width: f64, value: impl Fn(f64) -> f64) -> Peak {
    let shrink = 0.5 * (5.0_f64.sqrt() - 1.0);
    let mut left = high - shrink * (high - low);
    let mut right = low + shrink * (high - low);
    let (mut at_left, mut at_right) = (value(left), value(right));
    while high - low > width {
        if at_left > at_right {
            (high, right, at_right) = (right, left, at_left);
            left = high - shrink * (high - low);
            at_left = value(left);
        } else {
            (low, left, at_left) = (left, right, at_right);
            right = low + shrink * (high - low);
            at_right = value(right);
        }
    }
    if at_left > at_right {
        Peak { x: left, value: at_left }
    } else {
        Peak { x: right, value: at_right }
    }
}
