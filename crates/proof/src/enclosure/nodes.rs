//! Between which places does a mode provably have a node?
//!
//! The sine of the angle between a trial `k` and its mode `k_n` is at most `ε/gap`, with the gap from σ to the other
//! eigenvalues. A strain of unit energy moves no place by more than `√Γ`,
//!
//! ```text
//! Γ = ∫ Σ_b max_x φ_t(x)²/C_b dt ≤ ∫ Σ_b [φ_t(0)² + φ_t(t−)² + φ_t(t+)² + φ_t(L)²]/C_b dt
//! ```
//!
//! with the two lines `φ_t` of a unit strain at `t` ([`super::norms`]). The deflection of the trial therefore differs
//! from a multiple of that of the mode by at most `√(a₀ Γ) ε/gap`. Where it exceeds this at two places with opposite
//! signs, the mode has a node between them.
//!
//! Mode n of a free bat without rotary inertia and shear has exactly n + 1 nodes, so n + 1 such intervals contain all
//! of them.
//!
//! # Source
//!
//! C. Davis, W. M. Kahan, SIAM J. Numer. Anal. 7 (1970) 1: the angle. F. R. Gantmacher, M. G. Krein, Oscillation
//! Matrices and Kernels and Small Vibrations of Mechanical Systems (AMS Chelsea, 2002): the number of nodes.

use crate::enclosure::beam::{BeamCell, Proven};
use crate::enclosure::conclude::Conclusion;
use crate::enclosure::moved::{Trial, TrialMotion};
use crate::enclosure::norms::Norms;
use crate::series::Series;
use sweetspot::base::interval::{Interval, down, up};

/// The data from which nodes follow.
pub struct Nodes<'a> {
    /// The bat.
    pub proven: &'a Proven,
    /// Its norms, with Γ.
    pub norms: &'a Norms,
    /// Its eigenvalues.
    pub conclusion: &'a Conclusion,
}

/// Number of places on a cell at which the sign of a deflection is determined first.
const LOOKS: usize = 6;
/// Halvings of the way to a node.
const MOST_HALVINGS: usize = 40;

impl Nodes<'_> {
    /// Intervals (m) that each contain a node of mode `k`, counted from 0, with this trial.
    pub fn of(&self, k: usize, trial: &Trial) -> Vec<[f64; 2]> {
        let Conclusion { proven, next, .. } = self.conclusion;
        let own = &proven[k];
        let above = k.checked_sub(1).map(|last| proven[last].tau[0]);
        let below = proven.get(k + 1).map_or(*next, |other| other.tau[1]);
        let gap = down(own.quotient.low - below);
        let gap = above.map_or(gap, |above| gap.min(down(above - own.quotient.high)));
        let Some(moved) = self.proven.moved(trial).filter(|_| gap > 0.0) else { return vec![] };
        let Some(energies) = self.proven.energies(trial) else { return vec![] };
        // `√(a₀ Γ) ε/gap`.
        let reach = up(up(energies.strain.high * self.norms.reach).sqrt());
        let angle = up(up(own.residual.sqrt()) / gap);
        if angle >= 1.0 {
            return vec![];
        }
        let looked =
            BoundedDeflection { proven: self.proven, moved: &moved, off: up(reach * angle) };
        looked.nodes()
    }
}

/// A deflection that is known to within a bound.
struct BoundedDeflection<'a> {
    proven: &'a Proven,
    moved: &'a TrialMotion,
    off: f64,
}

/// A place: a cell and where on it, from −1 to 1.
type CellPlace = (usize, f64);

impl BoundedDeflection<'_> {
    /// The sign of the deflection of the mode there, up to a common factor; None where it is uncertain.
    fn sign(&self, (k, xi): CellPlace) -> Option<bool> {
        let value = at(&self.moved.cells[k][0], xi);
        let off = up(self.moved.drift[k][0] + self.off);
        if value.low > off {
            Some(true)
        } else if value.high < -off {
            Some(false)
        } else {
            None
        }
    }

    /// The places examined first, from the knob.
    fn places(&self) -> impl Iterator<Item = CellPlace> + use<> {
        let step = 2.0 / LOOKS as f64;
        let on = move |k: usize| (0..LOOKS).map(move |j| (k, -1.0 + step * (j as f64 + 0.5)));
        let count = self.proven.cells.len();
        std::iter::once((0, -1.0)).chain((0..count).flat_map(on)).chain([(count - 1, 1.0)])
    }

    fn nodes(&self) -> Vec<[f64; 2]> {
        let mut nodes = vec![];
        let mut last: Option<(CellPlace, bool)> = None;
        for place in self.places() {
            let Some(sign) = self.sign(place) else { continue };
            if let Some((before, _)) = last.filter(|(_, other)| *other != sign) {
                nodes.push(self.between(before, place, sign));
            }
            last = Some((place, sign));
        }
        nodes
    }

    /// The narrowest interval with a change of sign between two places, the second of that sign.
    fn between(&self, mut low: CellPlace, mut high: CellPlace, sign: bool) -> [f64; 2] {
        // From each side up to the last place with a certain sign.
        let ends = [low, high];
        for side in [false, true] {
            let (mut sure, mut unsure) = if side { (ends[1], low) } else { (ends[0], high) };
            for _ in 0..MOST_HALVINGS {
                let Some(middle) = halfway(sure, unsure) else { break };
                match self.sign(middle) == Some(sign == side) {
                    true => sure = middle,
                    false => unsure = middle,
                }
            }
            if side { high = sure } else { low = sure }
        }
        let x = |(k, xi): CellPlace| {
            let BeamCell { half, middle, .. } = &self.proven.cells[k];
            *middle + *half * Interval::point(xi) + Interval::point(self.proven.origin)
        };
        [x(low).low.max(0.0), x(high).high]
    }
}

/// A place about half way between two; None where there is none.
fn halfway((a, xi): CellPlace, (b, eta): CellPlace) -> Option<CellPlace> {
    if a == b {
        let middle = 0.5 * (xi + eta);
        (middle != xi && middle != eta).then_some((a, middle))
    } else if a < b && xi < 1.0 {
        // The border between two cells is the end of the certain one.
        Some((a, if xi > 1.0 - 1e-9 { 1.0 } else { 0.5 * (xi + 1.0) }))
    } else if a > b && xi > -1.0 {
        Some((a, if xi < -1.0 + 1e-9 { -1.0 } else { 0.5 * (xi - 1.0) }))
    } else {
        let next = if a < b { a + 1 } else { a - 1 };
        let begin = if a < b { -1.0 } else { 1.0 };
        if next == b && begin == eta { None } else { Some((next, begin)) }
    }
}

/// The value at ξ, by Legendre's recurrence.
fn at(series: &Series, xi: f64) -> Interval {
    let point = Interval::point;
    let x = point(xi);
    let (mut before, mut now) = (point(0.0), point(1.0));
    let mut sum = point(0.0);
    for j in 0..=series.degree() {
        sum = sum + point(series.coefficient(j)) * now;
        let over = point((j + 1) as f64).reciprocal().expect("above 0");
        let next = (point((2 * j + 1) as f64) * x * now - point(j as f64) * before) * over;
        (before, now) = (now, next);
    }
    sum + Interval::within(series.radius())
}
