//! Where is the sweet spot, by each of its definitions.

use crate::bat::Bat;
use crate::collision::hit::{Hitter, Scene};
use crate::solve::Solution;

/// A place and the value there (m/s or J).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    pub x: f64,
    pub value: f64,
}

/// The sweet spot of the outer half of a bat, by every definition there is a number for.
#[derive(Debug, Clone, PartialEq)]
pub struct SweetSpot {
    /// Where the ball leaves fastest (m/s).
    pub exit_speed_max: Option<Peak>,
    /// Where the least energy stays in vibration (J).
    pub vibration_min: Option<Peak>,
    /// The barrel-side node of the first and of the second bending mode (m).
    pub node_mode_1: Option<f64>,
    pub node_mode_2: Option<f64>,
    /// The centre of percussion for the swing's own pivot (m).
    pub center_of_percussion: Option<f64>,
    /// Where the exit speed is within 1 % of its maximum (m).
    pub zone: Option<[f64; 2]>,
}

/// Points of the first look along the outer half.
const GRID: usize = 400;
/// A place is located to this share of the outer half.
const WIDTH: f64 = 1e-9;

impl SweetSpot {
    /// Searched from the middle of the bat to its tip.
    pub fn find(bat: &Bat, scene: &Scene, solution: &Solution, hitter: &Hitter) -> Self {
        let outer = [0.5 * bat.length(), bat.length()];
        let speed = |x: f64| hitter.exit_speed(x);
        let exit_speed_max = greatest(outer, &speed);
        let still = |x: f64| hitter.vibration(x).map(|energy| -energy);
        let last_node = |k: usize| solution.modes.get(k).and_then(|m| m.nodes.last().copied());
        Self {
            zone: exit_speed_max.map(|peak| zone(outer, peak, &speed)),
            exit_speed_max,
            vibration_min: greatest(outer, &still)
                .map(|peak| Peak { x: peak.x, value: -peak.value }),
            node_mode_1: last_node(0),
            node_mode_2: last_node(1),
            center_of_percussion: bat.inertia().as_line().center_of_percussion(-scene.pivot),
        }
    }
}

/// The greatest value of `f` on an interval: the best of a grid, then golden-section search.
fn greatest([from, to]: [f64; 2], f: &dyn Fn(f64) -> Option<f64>) -> Option<Peak> {
    let at = |k: usize| from + (to - from) * k as f64 / GRID as f64;
    let value = |x: f64| f(x).unwrap_or(f64::NEG_INFINITY);
    let best = (0..=GRID).max_by(|&a, &b| value(at(a)).total_cmp(&value(at(b))))?;
    f(at(best))?;
    let (mut low, mut high) = (at(best.saturating_sub(1)), at((best + 1).min(GRID)));
    let shrink = 0.5 * (5.0_f64.sqrt() - 1.0);
    let inside = |low: f64, high: f64| (high - shrink * (high - low), low + shrink * (high - low));
    while high - low > WIDTH * (to - from) {
        let (left, right) = inside(low, high);
        if value(left) > value(right) { high = right } else { low = left }
    }
    // The ends of the interval may be the best, where the search only comes near.
    let candidates = [0.5 * (low + high), at(best), from, to];
    let x = candidates.into_iter().max_by(|&a, &b| value(a).total_cmp(&value(b)))?;
    Some(Peak { x, value: value(x) })
}

/// How far from the peak the value stays within 1 %, bisected on both sides.
fn zone([from, to]: [f64; 2], peak: Peak, f: &dyn Fn(f64) -> Option<f64>) -> [f64; 2] {
    let floor = peak.value - 0.01 * peak.value.abs();
    let good = |x: f64| f(x).is_some_and(|v| v >= floor);
    let edge = |end: f64| {
        // Walk outwards to the first place that is not good, then bisect back.
        let step = (end - peak.x) / GRID as f64;
        let bad = (1..=GRID).map(|k| peak.x + step * k as f64).find(|x| !good(*x));
        let Some(mut bad) = bad else { return end };
        let mut inside = bad - step;
        while (bad - inside).abs() > WIDTH * (to - from) {
            let middle = 0.5 * (bad + inside);
            if good(middle) { inside = middle } else { bad = middle }
        }
        inside
    };
    [edge(from), edge(to)]
}
