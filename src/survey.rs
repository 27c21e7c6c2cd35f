//! A profile as the planner sees it: how many waves a piece holds and how much it tapers.

use crate::bat::Bat;
use crate::profile::{Cubics, Piece, Radii, Section};

/// A piece is sampled until the radius changes by no more than this factor between samples.
const SMOOTH: f64 = 1.35;
/// A radius below this share of the widest counts as that: a point is no infinite taper.
const THIN: f64 = 1e-3;

/// One place of a piece.
#[derive(Debug, Clone, Copy, Default)]
pub struct Sample {
    /// From 0 to 1 along the piece.
    pub s: f64,
    /// `∫(ρA/EI)^¼ dx` from the piece's left end: for a mode of angular frequency ω its phase is
    /// `√ω` times that (rad).
    pub phase: f64,
    /// The taper from there, for a straight side `∫|d ln r|`.
    pub taper: f64,
}

/// The pieces of a profile, sampled from end to end.
#[derive(Debug)]
pub struct Survey {
    samples: Vec<Sample>,
    /// Where in them each piece ends.
    ends: Vec<usize>,
}

impl Survey {
    pub fn of(bat: &Bat) -> Self {
        let widest = bat.profile.stations.outer.iter().fold(0.0_f64, |a, b| a.max(*b));
        let pieces = &bat.profile.pieces;
        let mut samples = Vec::with_capacity(5 * pieces.len());
        let mut ends = Vec::with_capacity(pieces.len());
        for piece in pieces {
            take(bat, piece, THIN * widest, &mut samples);
            ends.push(samples.len());
        }
        Self { samples, ends }
    }

    /// The samples of every piece.
    pub fn pieces(&self) -> impl Iterator<Item = &[Sample]> {
        (0..self.ends.len()).map(|k| self.piece(k))
    }

    /// The samples of one piece.
    pub fn piece(&self, k: usize) -> &[Sample] {
        &self.samples[if k == 0 { 0 } else { self.ends[k - 1] }..self.ends[k]]
    }

    /// The phase of the whole bat.
    pub fn phase(&self) -> f64 {
        self.ends.iter().map(|end| self.samples[end - 1].phase).sum()
    }
}

/// What a sample is made from.
#[derive(Clone, Copy)]
struct Place {
    s: f64,
    /// Outer radius (m).
    radius: f64,
    /// `(ρA/EI)^¼` (√(s/rad)/m).
    wave: f64,
    /// The taper for a unit of `s`, where stations tell: `max_j |c_j r_j/r|^{1/j}` with the radius
    /// `Σ r_j (Δs)^j` around the place and c = 1, 0.5, 0.3. For a straight side it is
    /// `|d ln r/ds|`, and a cubic counts as the cone whose series falls as slowly.
    taper: Option<f64>,
}

/// Samples along a piece, denser where the radius changes; a radius below `thin` counts as that.
fn take(bat: &Bat, piece: &Piece, thin: f64, samples: &mut Vec<Sample>) {
    let at = |s: f64| {
        let section = piece.at(s);
        let radius = section.outer.max(thin);
        let section = Section { outer: radius, ..section };
        let [bending, mass] = bat.layup(piece).bending_and_mass(section);
        let ratio = mass / bending;
        let taper = match &piece.radii {
            Radii::Cubic(cubics) => Some(taper(cubics, s, radius)),
            Radii::Formula(_) => None,
        };
        Place { s, radius, wave: ratio.sqrt().sqrt(), taper }
    };
    samples.push(Sample::default());
    let pieces = match &piece.radii {
        Radii::Cubic(cubics) if cubics.degree == 0 => {
            samples.push(Sample { s: 1.0, phase: piece.length * at(0.0).wave, taper: 0.0 });
            return;
        }
        Radii::Cubic(cubics) if cubics.degree == 1 => 1,
        Radii::Cubic(_) => 4,
        Radii::Formula(_) => 32,
    };
    let mut left = at(0.0);
    for k in 1..=pieces {
        let right = at(f64::from(k) / f64::from(pieces));
        between(&at, piece.length, [left, right], samples, 40);
        left = right;
    }
}

/// [`Place::taper`] of stations.
///
/// The series of `(1 + c s^j)⁻⁴` has every j-th term of the cone's, with smaller coefficients: the
/// first is `4/(j+3 choose 3)` of it, 0.4 and 0.2 for j = 2 and 3, the next 0.29² and 0.12². The
/// factors lie between these.
fn taper(cubics: &Cubics, s: f64, radius: f64) -> f64 {
    let b = &cubics.outer;
    let first = [b[1] - b[0], b[2] - b[1], b[3] - b[2]];
    let second = [first[1] - first[0], first[2] - first[1]];
    let third = second[1] - second[0];
    let t = 1.0 - s;
    let r1 = 3.0 * (first[0] * t * t + 2.0 * first[1] * t * s + first[2] * s * s);
    let r2 = 3.0 * (second[0] * t + second[1] * s);
    let [r1, r2, r3] = [r1, r2, third].map(|r| (r / radius).abs());
    // A straight side's higher parts are round-off.
    if cubics.degree == 1 { r1 } else { r1.max((0.5 * r2).sqrt()).max((0.3 * r3).cbrt()) }
}

fn between(
    at: &dyn Fn(f64) -> Place,
    length: f64,
    [left, right]: [Place; 2],
    samples: &mut Vec<Sample>,
    depth: usize,
) {
    let ratio = left.radius / right.radius;
    if depth > 0 && !(1.0 / SMOOTH..=SMOOTH).contains(&ratio) {
        let middle = at(0.5 * (left.s + right.s));
        between(at, length, [left, middle], samples, depth - 1);
        between(at, length, [middle, right], samples, depth - 1);
        return;
    }
    let last = samples[samples.len() - 1];
    let step = right.s - left.s;
    let phase = 0.5 * (left.wave + right.wave) * length * step;
    let taper = match (left.taper, right.taper) {
        (Some(from), Some(to)) => 0.5 * (from + to) * step,
        _ => 2.0 * (right.radius - left.radius).abs() / (right.radius + left.radius),
    };
    samples.push(Sample { s: right.s, phase: last.phase + phase, taper: last.taper + taper });
}
