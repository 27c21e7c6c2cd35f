//! Which elements of which degree the wanted accuracy needs: the cheapest by a formula.
//!
//! On an element of length `h` a mode is nearly `cos kx` with the local wave number
//! `k = (ω²ρA/EI)^¼`. Polynomials of degree `p − 2` in the curvature miss of it what its Legendre
//! series has beyond them, with spherical Bessel functions `j_l` at `a = kh/2`
//!
//! ```text
//! Δf/f = ½ Σ_{l ≥ p−1} (2l + 1) j_l(a)² ≈ ½ (2p − 1) [a^{p−1}/(2p − 1)!!]²,
//! ```
//!
//! which for `p = 3` is the known `(kh)⁴/1440`. A taper bends the curvature too: `EI ∝ r⁴` over one
//! element counts as a wave of `a = 1.5 |Δ ln r|`, measured on cones.

use crate::bat::Bat;
use crate::beam::element::missed;
use crate::beam::mesh::Mesh;
use crate::beam::rule::{DEGREES, Rule};
use crate::profile::{Piece, Radii, Section};

/// A mesh and the degree of its elements.
#[derive(Debug, Clone, Default)]
pub struct Plan {
    pub mesh: Mesh,
    pub degree: usize,
    /// Why this one, for a person.
    pub reason: String,
}

/// What a plan is to reach.
#[derive(Debug, Clone, Copy)]
pub struct Wanted {
    /// Number of bending modes.
    pub modes: usize,
    /// Relative error of every frequency.
    pub tolerance: f64,
    /// The degree, if it is not free.
    pub degree: Option<usize>,
    /// More than this only if the profile has as many pieces.
    pub most_unknowns: usize,
}

/// How much of `Δ ln r` over an element counts as half a wave.
const TAPER: f64 = 3.0;
/// The plan aims at this share of the wanted error, because no element is like the formula's.
const AIM: f64 = 0.2;
/// The smallest relative error worth planning for.
const FINEST: f64 = 1e-16;
/// A piece is sampled until the radius changes by no more than this factor between samples.
const SMOOTH: f64 = 1.35;

const MOST_HALVINGS: usize = 12;

/// A profile as the planner sees it: phase and taper along every piece.
struct Survey {
    /// Of every piece, samples of `(s, ∫(ρA/EI)^¼ dx, |Δ ln r|)`, both summed up from its left end.
    pieces: Vec<Vec<[f64; 3]>>,
    /// The first over the whole bat.
    phase: f64,
}

impl Plan {
    /// The cheapest plan whose error should be within the tolerance for the `modes` lowest modes,
    /// with that degree if one is given.
    pub fn cheapest(bat: &Bat, wanted: &Wanted) -> Self {
        let all: Vec<usize> = wanted.degree.map_or(DEGREES, |degree| degree..=degree).collect();
        Self::cheapest_among(bat, wanted, &all)
    }

    /// The same with one of these degrees.
    pub fn cheapest_among(bat: &Bat, wanted: &Wanted, degrees: &[usize]) -> Self {
        let Wanted { modes, tolerance, most_unknowns, .. } = *wanted;
        // No finer than arithmetic can tell; the verdict stays on what was asked.
        let tolerance = tolerance.max(FINEST);
        let survey = Survey::of(bat);
        // Mode n of a free beam is near the phase (n + ½)π from end to end.
        let wave = (modes as f64 + 0.5) * std::f64::consts::PI / survey.phase;
        let lengths: Vec<f64> = survey.pieces.iter().map(|piece| total(piece, wave)).collect();
        let whole: f64 = lengths.iter().sum();
        let candidates = degrees.iter().map(|&degree| {
            // A plan that would be too large is made as large as it may be.
            let least = whole * (degree - 1) as f64 / most_unknowns as f64;
            let reach = reach(degree, AIM * tolerance).max(least);
            let count: usize = lengths.iter().map(|length| elements(*length, reach)).sum();
            (cost(degree) * count.max(modes.div_ceil(degree - 1)) as f64, degree, reach)
        });
        let best = candidates.min_by(|a, b| a.0.total_cmp(&b.0));
        let (_, degree, reach) = best.expect("there is a degree");
        let places = survey.pieces.iter().zip(&lengths);
        let places: Vec<_> = places.map(|(piece, l)| borders(piece, wave, *l, reach)).collect();
        let mut mesh = resolved(bat, Mesh::with_borders(bat, &places), degree);
        // Too few unknowns for so many modes: shorter elements.
        while (degree - 1) * mesh.len() < modes {
            mesh = mesh.refined(|_| 2);
        }
        let among = match degrees {
            [degree] => format!("fewest elements of degree {degree}"),
            [.., last] => format!("cheapest of degrees {} to {last}", degrees[0]),
            [] => String::new(),
        };
        let reason = format!("{among} for {tolerance:.0e}, by formula");
        Self { mesh, degree, reason }
    }

    /// So many elements in all, spread by length, of that degree.
    pub fn fixed(bat: &Bat, elements: usize, degree: usize) -> Self {
        let reason = "as asked".to_owned();
        Self { mesh: Mesh::along(bat, elements), degree, reason }
    }

    /// The same mesh with elements of that degree.
    pub fn of_degree(self, degree: usize) -> Self {
        Self { degree, ..self }
    }

    /// The plan after a solve that missed, from every element's `defects` (twice the relative error
    /// of a frequency): one degree more where little is missing and `free` to choose, else every
    /// element cut into as many parts as its own part of the error asks for.
    pub fn refined(&self, defects: &[f64], tolerance: f64, free: bool) -> Self {
        // A degree more takes about two digits off the error, and costs a fifth of the time.
        const LITTLE: f64 = 100.0;
        let (count, error) = (self.mesh.len() as f64, 0.5 * defects.iter().sum::<f64>());
        if free && error < LITTLE * tolerance && self.degree < *DEGREES.end() {
            let reason = format!("the planned degree missed {tolerance:.0e}, so one more");
            return Self { mesh: self.mesh.clone(), degree: self.degree + 1, reason };
        }
        let share = 0.5 * tolerance / count;
        let order = 2.0 * (self.degree - 1) as f64;
        let parts = |k: usize| {
            let excess = 0.5 * defects[k] / share;
            if excess <= 1.0 { 1 } else { (excess.powf(1.0 / order).ceil() as usize).clamp(2, 4) }
        };
        let worst = (0..self.mesh.len()).max_by(|&a, &b| defects[a].total_cmp(&defects[b]));
        let mesh = self.mesh.refined(|k| if Some(k) == worst { parts(k).max(2) } else { parts(k) });
        let reason = format!("the plan missed {tolerance:.0e}, refined where the error was");
        Self { mesh, reason, ..*self }
    }
}

/// The mesh with every element halved where the points of its rule do not hold a formula.
fn resolved(bat: &Bat, mut mesh: Mesh, degree: usize) -> Mesh {
    let rule = Rule::of(bat, degree);
    for _ in 0..MOST_HALVINGS {
        let unresolved: Vec<bool> =
            mesh.elements.iter().map(|e| missed(bat, e, rule) > 0.0).collect();
        if !unresolved.contains(&true) {
            break;
        }
        mesh = mesh.refined(|k| 1 + usize::from(unresolved[k]));
    }
    mesh
}

/// The largest `a` whose error is within the tolerance.
fn reach(degree: usize, tolerance: f64) -> f64 {
    let m = degree - 1;
    let odd: f64 = (1..=m).map(|k| (2 * k + 1) as f64).product();
    ((2.0 * tolerance / (2 * m + 1) as f64).sqrt() * odd).powf(1.0 / m as f64)
}

/// What an element of that degree costs beside others: measured, assembly to error estimate.
fn cost(degree: usize) -> f64 {
    let p = degree as f64;
    1.0 + 0.12 * p * p
}

/// Half the phase between two samples, taper and all: the `a` of an element from one to the other.
fn measure(a: &[f64; 3], b: &[f64; 3], wave: f64) -> f64 {
    let (phase, taper) = (wave * (b[1] - a[1]), TAPER * (b[2] - a[2]));
    0.5 * (phase * phase + taper * taper).sqrt()
}

fn total(piece: &[[f64; 3]], wave: f64) -> f64 {
    piece.windows(2).map(|w| measure(&w[0], &w[1], wave)).sum()
}

fn elements(length: f64, reach: f64) -> usize {
    ((length / reach).ceil() as usize).max(1)
}

/// Borders of the elements of a piece of that length in phase: equal phase between them.
fn borders(piece: &[[f64; 3]], wave: f64, length: f64, reach: f64) -> Vec<f64> {
    let count = elements(length, reach);
    let step = length / count as f64;
    let mut borders = Vec::with_capacity(count + 1);
    borders.push(0.0);
    let mut sum = 0.0;
    for w in piece.windows(2) {
        let here = measure(&w[0], &w[1], wave);
        while borders.len() < count && sum + here >= step * borders.len() as f64 {
            let share = (step * borders.len() as f64 - sum) / here;
            borders.push(w[0][0] + share * (w[1][0] - w[0][0]));
        }
        sum += here;
    }
    borders.push(1.0);
    borders
}

impl Survey {
    fn of(bat: &Bat) -> Self {
        let widest = bat.profile.stations.outer.iter().fold(0.0_f64, |a, b| a.max(*b));
        let pieces: Vec<_> =
            bat.profile.pieces.iter().map(|piece| samples(bat, piece, 1e-3 * widest)).collect();
        let phase = pieces.iter().map(|piece| piece[piece.len() - 1][1]).sum();
        Self { pieces, phase }
    }
}

/// Samples along a piece, denser where the radius changes; a radius below `thin` counts as that.
fn samples(bat: &Bat, piece: &Piece, thin: f64) -> Vec<[f64; 3]> {
    let at = |s: f64| -> (f64, f64) {
        let section = piece.at(s);
        let outer = section.outer.max(thin);
        let section = Section { outer, ..section };
        let ratio = bat.mass_per_length(section) / bat.bending_stiffness(section);
        (outer, ratio.sqrt().sqrt())
    };
    let mut samples = vec![[0.0; 3]];
    let pieces = match &piece.radii {
        Radii::Cubic(cubics) if cubics.degree == 0 => {
            samples.push([1.0, piece.length * at(0.0).1, 0.0]);
            return samples;
        }
        Radii::Cubic(cubics) if cubics.degree == 1 => 1,
        Radii::Cubic(_) => 4,
        Radii::Formula(_) => 32,
    };
    for k in 0..pieces {
        let (from, to) = (k as f64 / f64::from(pieces), (k + 1) as f64 / f64::from(pieces));
        let (left, right) = (at(from), at(to));
        between(&at, piece.length, [(from, left), (to, right)], &mut samples, 40);
    }
    samples
}

fn between(
    at: &dyn Fn(f64) -> (f64, f64),
    length: f64,
    [(from, left), (to, right)]: [(f64, (f64, f64)); 2],
    samples: &mut Vec<[f64; 3]>,
    depth: usize,
) {
    let ratio = left.0 / right.0;
    if depth > 0 && !(1.0 / SMOOTH..=SMOOTH).contains(&ratio) {
        let middle = 0.5 * (from + to);
        let half = (middle, at(middle));
        between(at, length, [(from, left), half], samples, depth - 1);
        between(at, length, [half, (to, right)], samples, depth - 1);
        return;
    }
    let last = samples[samples.len() - 1];
    let phase = 0.5 * (left.1 + right.1) * length * (to - from);
    let taper = 2.0 * (right.0 - left.0).abs() / (right.0 + left.0);
    samples.push([to, last[1] + phase, last[2] + taper]);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_error_formula_is_the_known_one_for_cubics() {
        // (kh)⁴/1440 with a = kh/2.
        for tolerance in [1e-3, 1e-6, 1e-9] {
            let a = reach(3, tolerance);
            assert!(((2.0 * a).powi(4) / 1440.0 / tolerance - 1.0).abs() < 1e-12);
        }
    }
}
