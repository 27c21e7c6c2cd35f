//! How does a wall give way anywhere along a barrel, from a few places of it?
//!
//! What a patch feels goes smoothly with its place: within a quarter of the patch's half length the polynomial
//! through six places is off by 2e-5, near the tip, where the patch begins to reach over the edge, at most.
//! There the places begin anew.

use std::f64::consts::PI;
use std::sync::OnceLock;

use crate::base::threads::made;
use crate::eigen::fronts::SIDES;
use crate::modes::hoop::Share;

/// Places of one polynomial.
const THROUGH: usize = 6;

/// Places along a barrel, looked at when first needed, as many together as a solve takes.
#[derive(Debug)]
pub struct WallTable {
    /// The first, where the patch touches the tip, and the distance to the next towards the knob (m).
    edge: f64,
    step: f64,
    /// How many there are.
    count: usize,
    /// The places between the edge and the tip (m).
    at_tip: [f64; SIDES],
    /// What was found there, and towards the knob.
    tip: OnceLock<Vec<Vec<Share>>>,
    inner: Vec<OnceLock<Vec<Vec<Share>>>>,
}

impl WallTable {
    /// From the last place at the knob side over the edge to the tip (m), places that far apart (m).
    pub fn new([knob, edge, tip]: [f64; 3], step: f64) -> Self {
        let count = (((edge - knob) / step).ceil().max(0.0) as usize + 1).max(THROUGH);
        let step = (edge - knob) / (count - 1) as f64;
        // Chebyshev's, both ends included.
        let share = |k: usize| 0.5 * (1.0 - (PI * k as f64 / (SIDES - 1) as f64).cos());
        let at_tip = std::array::from_fn(|k| edge + (tip - edge) * share(k));
        let inner = (0..count.div_ceil(SIDES)).map(|_| OnceLock::new()).collect();
        Self { edge, step, count, at_tip, tip: OnceLock::new(), inner }
    }

    /// The shares of all harmonics at `x` (m); `look` finds them at some places.
    pub fn at(&self, x: f64, look: impl Fn(&[f64]) -> Vec<Vec<Share>>) -> Vec<Share> {
        if x > self.edge {
            let known = made(&self.tip, || look(&self.at_tip));
            let known: Vec<&Vec<Share>> = known.iter().collect();
            return between(&known, &weights(&self.at_tip, x));
        }
        let place = ((self.edge - x) / self.step).max(0.0);
        let first = (place as usize).saturating_sub(THROUGH / 2 - 1).min(self.count - THROUGH);
        let nodes: [f64; THROUGH] = std::array::from_fn(|k| (first + k) as f64);
        let known: Vec<&Vec<Share>> = (first..first + THROUGH)
            .map(|k| {
                let tile = k / SIDES;
                let found = made(&self.inner[tile], || look(&self.tile(tile)));
                &found[k % SIDES]
            })
            .collect();
        between(&known, &weights(&nodes, place))
    }

    /// The places of a tile (m).
    fn tile(&self, tile: usize) -> Vec<f64> {
        let places = tile * SIDES..((tile + 1) * SIDES).min(self.count);
        places.map(|k| self.edge - self.step * k as f64).collect()
    }
}

/// Lagrange's weights at `x` of values at those nodes.
fn weights(nodes: &[f64], x: f64) -> Vec<f64> {
    let weight = |k: usize| -> f64 {
        let others = nodes.iter().enumerate().filter(|(m, _)| *m != k);
        others.map(|(_, other)| (x - other) / (nodes[k] - other)).product()
    };
    (0..nodes.len()).map(weight).collect()
}

/// The shares between those of some places; none is negative.
fn between(known: &[&Vec<Share>], weights: &[f64]) -> Vec<Share> {
    let sum = |of: &dyn Fn(&Vec<Share>) -> f64| -> f64 {
        known.iter().zip(weights).map(|(known, weight)| weight * of(known)).sum::<f64>().max(0.0)
    };
    let share = |(n, share): (usize, &Share)| Share {
        harmonic: share.harmonic,
        gains: (0..share.gains.len()).map(|m| sum(&|known| known[n].gains[m])).collect(),
        flexibility: sum(&|known| known[n].flexibility),
        slowness: sum(&|known| known[n].slowness),
    };
    known[0].iter().enumerate().map(share).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Polynomials of the fifth degree are met everywhere, on both sides of the edge.
    #[test]
    fn a_polynomial_is_met_everywhere() {
        let table = WallTable::new([0.4, 0.82, 0.8382], 0.0043);
        let exact = |x: f64| 1.0 + (x - 0.4) + 3.0 * (x - 0.5).powi(5);
        let look = |places: &[f64]| {
            let share = |x: &f64| {
                vec![Share {
                    harmonic: 2,
                    gains: vec![exact(*x)],
                    flexibility: exact(*x),
                    slowness: 1.0,
                }]
            };
            places.iter().map(share).collect()
        };
        for k in 0..=1000 {
            let x = 0.4 + 0.4382 * f64::from(k) / 1000.0;
            let found = &table.at(x, look)[0];
            assert!((found.flexibility - exact(x)).abs() < 1e-10, "{x}");
            assert!(
                (found.gains[0] - exact(x)).abs() < 1e-10 && (found.slowness - 1.0).abs() < 1e-10
            );
        }
    }
}
