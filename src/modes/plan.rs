//! Which elements of which degree does a tolerance need?
//!
//! [`Plan::cheapest`] answers by a formula before anything is solved. [`crate::solve()`] then checks the errors and
//! calls [`Plan::refined`] if the formula was wrong.
//!
//! On an element of length `h` a mode is nearly `cos kx` with the local wave number `k = (ω²ρA/EI)^¼`. Polynomials of
//! degree `p − 2` in the curvature miss the higher terms of its Legendre series. With spherical Bessel functions `j_l`
//! at `a = kh/2` the error is
//! ```text
//! Δf/f = ½ Σ_{l ≥ p−1} (2l + 1) j_l(a)² ≈ ½ (2p − 1) [a^{p−1}/(2p − 1)!!]²,
//! ```
//!
//! For `p = 3` this is the known `(kh)⁴/1440`.
//!
//! A taper bends the curvature too. Under a constant moment it is `∝ 1/EI ∝ r⁻⁴`. On an element over which `ln r`
//! changes by `t`, its series gives, with `m = p − 1`,
//!
//! ```text
//! Δf/f = ½/(2m + 1) [(m+3 choose 3) m! 2^m/(2m − 1)!!]² tanh(t/4)^{2m}
//! ```
//!
//! (the leading term of the series of `(1 + ξ tanh t/2)⁻⁴`, within a factor 2 of the whole up to `t = 1`). With rotary
//! inertia or shear, `k` is the greater wave number of that theory. The combinations of both that an element may have
//! lie within an ellipse. Bores are ignored: the outer radius represents the section, and the check after the solve
//! covers the rest.
//!
//! Elements end at stations or, if that is cheaper, reach over them; [`crate::modes::stations`] gives the cost of that.
//!
//! # Source
//!
//! Rayleigh's expansion of a plane wave and the leading term of `j_l`: Abramowitz and Stegun, Handbook of Mathematical
//! Functions (1964), 10.1.47 and 10.1.2. The error for a taper is derived here, from the binomial series and the
//! leading coefficient of `P_m`.

use std::fmt;
use std::ops::Range;
use std::time::Duration;

use serde::Serialize;

use crate::bat::{Bat, Piece, Radii, Theory};
use crate::beam::sections::missed;
use crate::beam::{DEGREES, Mesh, Rule};
use crate::modes::stations::Stations;
use crate::modes::survey::{MANY, Sample, Survey};

/// A mesh and the degree of its elements.
#[derive(Debug, Clone, Default)]
pub struct Plan {
    /// The elements.
    pub mesh: Mesh,
    /// Degree of their deflection.
    pub degree: usize,
    /// Reason for the choice.
    pub reason: Reason,
}

/// Reason for a plan.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
#[non_exhaustive]
pub enum Reason {
    /// The user asked for it.
    #[default]
    Asked,
    /// The cheapest of these degrees for that tolerance, by the formula.
    Cheapest {
        /// The lowest and the highest that were tried.
        degrees: [usize; 2],
        /// The wanted relative error of every frequency.
        tolerance: f64,
    },
    /// The previous plan missed the tolerance by little: one degree more.
    OneDegreeMore {
        /// The wanted relative error of every frequency.
        tolerance: f64,
    },
    /// The previous plan missed the tolerance: more elements where the error was.
    Refined {
        /// The wanted relative error of every frequency.
        tolerance: f64,
    },
    /// The most accurate plan within a time.
    Budget(Duration),
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Asked => write!(f, "as asked"),
            Self::Cheapest { degrees: [from, to], tolerance } if from == to => {
                write!(f, "fewest elements of degree {to} for {tolerance:.0e}, by formula")
            }
            Self::Cheapest { degrees: [from, to], tolerance } => {
                write!(f, "cheapest of degrees {from} to {to} for {tolerance:.0e}, by formula")
            }
            Self::OneDegreeMore { tolerance } => {
                write!(f, "the planned degree missed {tolerance:.0e}, so one more")
            }
            Self::Refined { tolerance } => {
                write!(f, "the plan missed {tolerance:.0e}, refined where the error was")
            }
            Self::Budget(time) => write!(f, "the most accurate within {time:?}"),
        }
    }
}

/// Requirements on a plan.
#[derive(Debug, Clone, Copy)]
pub struct Wanted {
    /// Number of bending modes.
    pub modes: usize,
    /// Relative error of every frequency.
    pub tolerance: f64,
    /// The degree, if it is prescribed.
    pub degree: Option<usize>,
    /// Upper limit on the unknowns, unless the profile has more pieces.
    pub most_unknowns: usize,
    /// The beam theory.
    pub theory: Theory,
}

/// The plan aims at this share of the wanted error, because no element is exactly like the formula's.
/// `examples/tuning/plans.rs` prints the share that first plans reach: 0.02 to 0.2 on dowel, cone and R161.
const AIM: f64 = 0.4;
/// The smallest relative error worth planning for, below round-off.
const FINEST: f64 = 1e-16;
/// Share of the wanted error that the sampling of sections may cause.
const MISSED: f64 = 1e-3;
/// Elements reach over stations for errors down to this. For smaller ones, a kink at a station costs more than a border
/// there.
const OVER: f64 = 1e-9;
/// The error due to kinks may be this many times that of the formula.
const SURE: f64 = 3.0;
/// Elements that reach over stations must be fewer than this share of the pieces: shorter ones would miss what a cubic
/// does between stations.
const FEWER: f64 = 0.8;
/// Cost of sampling a piece under an element over stations, in the unit of [`cost`].
const SAMPLING: f64 = 0.5;
/// Most halvings of an element for a formula.
const MOST_HALVINGS: usize = 12;

impl Plan {
    /// The cheapest plan whose error should be within the tolerance for the `modes` lowest modes, with the prescribed
    /// degree if there is one.
    pub fn cheapest(bat: &Bat, wanted: &Wanted) -> Self {
        let (least, most) = DEGREES.into_inner();
        let range = wanted.degree.map_or(least..=most, |degree| degree..=degree);
        Self::cheapest_among(bat, wanted, range)
    }

    /// The cheapest plan within the tolerance with one of these degrees, which must rise.
    pub fn cheapest_among(
        bat: &Bat,
        wanted: &Wanted,
        degrees: impl IntoIterator<Item = usize>,
    ) -> Self {
        let Wanted { modes, tolerance, most_unknowns, .. } = *wanted;
        // Mode n of a free beam has nearly the phase (n + ½)π from end to end. Each constraint beyond the two rigid
        // motions raises the order of a mode by at most one.
        let held = bat.fixtures().held().saturating_sub(2);
        let phase = ((modes + held) as f64 + 0.5) * std::f64::consts::PI;
        let survey = Survey::of(bat, wanted.theory, phase);
        let wave = survey.root_omega;
        let stations = (tolerance >= OVER).then(|| Stations::of(bat, &survey)).flatten();
        let mut best: Option<(f64, ElementLayout)> = None;
        let mut range: Option<[usize; 2]> = None;
        for degree in degrees {
            range = Some([range.map_or(degree, |[from, _]| from), degree]);
            let mut layout = ElementLayout::of(degree, AIM * tolerance.max(FINEST), wave, &survey);
            // A plan that would be too large is made as large as allowed: rounding up adds to it.
            while (degree - 1) * layout.count > most_unknowns
                && layout.count > bat.profile().pieces.len()
            {
                layout.scale(1.01 * ((degree - 1) * layout.count) as f64 / most_unknowns as f64);
                layout.count = layout.elements(&survey);
            }
            let (pieces, least) = (bat.profile().pieces.len(), modes.div_ceil(degree - 1));
            let dearer = |best: &Option<(f64, ElementLayout)>, layout: &ElementLayout| {
                best.as_ref().is_some_and(|(cost, _)| layout.cost(pieces, least) >= *cost)
            };
            let over = stations.as_ref().map(|stations| (layout.over(&survey, stations), stations));
            if !dearer(&best, &layout) {
                best = Some((layout.cost(pieces, least), layout));
            }
            // The effect of kinks is estimated separately.
            if let Some((mut over, stations)) = over.filter(|(over, _)| !dearer(&best, over)) {
                over.shorten(bat, &survey, stations);
                let fewer = (over.count as f64) < FEWER * pieces as f64;
                if fewer && !dearer(&best, &over) {
                    best = Some((over.cost(pieces, least), over));
                }
            }
        }
        let ((_, layout), degrees) = best.zip(range).expect("there is a degree");
        let degree = layout.degree;
        let borders = layout.borders(&survey, stations.as_ref());
        let mut mesh = resolved(bat, Mesh::between(bat, &borders), degree, wanted);
        // There are too few unknowns for that number of modes: shorter elements.
        while (degree - 1) * mesh.len() < modes {
            mesh = mesh.refined(bat, |_| 2);
        }
        Self { mesh, degree, reason: Reason::Cheapest { degrees, tolerance } }
    }

    /// A plan with that number of elements in all, distributed by length, of that degree.
    pub fn fixed(bat: &Bat, elements: usize, degree: usize) -> Self {
        Self { mesh: Mesh::along(bat, elements), degree, reason: Reason::Asked }
    }

    /// Number of strains without shear, which equals the unknowns for bending.
    pub fn unknowns(&self) -> usize {
        (self.degree - 1) * self.mesh.len()
    }

    /// The plan after a solve that missed the tolerance, from every element's `defects` (twice the relative error of a
    /// frequency): one degree more if little is missing and the degree is `free`, otherwise every element is cut into
    /// as many parts as its share of the error requires.
    pub fn refined(&self, bat: &Bat, defects: &[f64], tolerance: f64, free: bool) -> Self {
        // One degree more reduces the error by about two digits and costs a fifth of the time:
        // `examples/tuning/plans.rs` prints both, with errors 20 to 130 times smaller.
        const LITTLE: f64 = 100.0;
        let (count, error) = (self.mesh.len() as f64, 0.5 * defects.iter().sum::<f64>());
        if free && error < LITTLE * tolerance && self.degree < *DEGREES.end() {
            let reason = Reason::OneDegreeMore { tolerance };
            return Self { mesh: self.mesh.clone(), degree: self.degree + 1, reason };
        }
        let share = 0.5 * tolerance / count;
        // The error due to a kink inside an element is at best proportional to the fifth power of its length.
        let over = self.mesh.over_stations();
        let order = if over { 4.0 } else { 2.0 * (self.degree - 1) as f64 };
        let parts = |k: usize| {
            let excess = 0.5 * defects[k] / share;
            if excess <= 1.0 { 1 } else { (excess.powf(1.0 / order).ceil() as usize).clamp(2, 4) }
        };
        let worst = (0..self.mesh.len()).max_by(|&a, &b| defects[a].total_cmp(&defects[b]));
        let mesh =
            self.mesh.refined(bat, |k| if Some(k) == worst { parts(k).max(2) } else { parts(k) });
        Self { mesh, degree: self.degree, reason: Reason::Refined { tolerance } }
    }
}

/// The mesh with elements halved until the points of the rule follow the formula, or the κ of a tapering bore, closely
/// enough for the wanted error.
fn resolved(bat: &Bat, mut mesh: Mesh, degree: usize, wanted: &Wanted) -> Mesh {
    let Wanted { theory, tolerance, .. } = *wanted;
    let profile = bat.profile();
    let layered = profile.stations.inner.iter().any(|r| *r > 0.0)
        || bat.layups().iter().any(|layup| !layup.sleeves.is_empty());
    let formula = |piece: &Piece| matches!(piece.radii, Radii::Formula(_));
    let curved = profile.pieces.iter().any(formula) || layered && theory.shears();
    if !curved {
        return mesh;
    }
    let rule = Rule::of(bat, mesh.over_stations(), degree);
    for _ in 0..MOST_HALVINGS {
        let unresolved: Vec<bool> = mesh
            .elements
            .iter()
            .map(|e| missed(bat, e, rule, theory) > MISSED * tolerance)
            .collect();
        if !unresolved.contains(&true) {
            break;
        }
        mesh = mesh.refined(bat, |k| 1 + usize::from(unresolved[k]));
    }
    mesh
}

/// The length of elements of one degree within a tolerance: the share of an element that a unit of `∫(ρA/EI)^¼ dx`, or
/// of taper, takes.
struct ElementLayout {
    degree: usize,
    phase: f64,
    taper: f64,
    /// Number of elements.
    count: usize,
    /// How many times as short as waves and tapers require elements are that reach over stations; `None` if they end
    /// there.
    over: Option<f64>,
    /// The wanted error.
    tolerance: f64,
    /// Whether there are many pieces.
    many: bool,
}

impl ElementLayout {
    /// Elements that end at stations.
    fn of(degree: usize, tolerance: f64, wave: f64, survey: &Survey) -> Self {
        let phase = 0.5 * wave / of_waves(degree, tolerance);
        let taper = 1.0 / of_tapers(degree, tolerance);
        let many = survey.pieces().count() > MANY;
        let mut layout = Self { degree, phase, taper, count: 0, over: None, tolerance, many };
        layout.count = layout.elements(survey);
        layout
    }

    /// Elements that reach over stations and are at most this long.
    fn over(&self, survey: &Survey, stations: &Stations) -> Self {
        let mut over = Self { over: Some(1.0), ..*self };
        over.divide_stretches(survey, stations, 1.0);
        over
    }

    /// Makes elements over stations `shorter` times as short as waves and tapers require.
    fn divide_stretches(&mut self, survey: &Survey, stations: &Stations, shorter: f64) {
        self.over = Some(shorter);
        self.count = self.on_stretches(survey, stations, shorter).sum();
    }

    /// The number of elements on each stretch.
    fn on_stretches(
        &self,
        survey: &Survey,
        stations: &Stations,
        shorter: f64,
    ) -> impl Iterator<Item = usize> {
        stations.stretches.iter().map(move |stretch| {
            let length: f64 = stretch.clone().map(|k| self.length(survey.piece(k))).sum();
            // If there are too many for this to be worth it, more make no difference.
            whole((shorter * length).min(1e6))
        })
    }

    /// Shortens elements over stations until the error due to kinks is within the tolerance too.
    fn shorten(&mut self, bat: &Bat, survey: &Survey, stations: &Stations) {
        let pieces = &bat.profile().pieces;
        let of = |k: usize| self.length(survey.piece(k)) / pieces[k].length;
        let per_length: Vec<f64> = (0..pieces.len()).map(of).collect();
        let mut shorter = 1.0;
        for _ in 0..3 {
            let missed = stations.missed(bat, self.degree, |k| shorter * per_length[k]);
            if SURE * missed <= self.tolerance {
                break;
            }
            let order = f64::from(stations.order());
            shorter *= (SURE * missed / self.tolerance).powf(1.0 / order);
        }
        self.divide_stretches(survey, stations, shorter);
    }

    /// Relative cost of a solve.
    fn cost(&self, pieces: usize, least: usize) -> f64 {
        let sampling = if self.over.is_some() { SAMPLING * pieces as f64 } else { 0.0 };
        cost(self.degree) * self.count.max(least) as f64 + sampling
    }

    fn scale(&mut self, by: f64) {
        self.phase /= by;
        self.taper /= by;
    }

    /// The share of an element between two samples.
    fn share(&self, a: &Sample, b: &Sample) -> f64 {
        let taper = if self.over.is_some() { b.smooth - a.smooth } else { b.taper - a.taper };
        let (phase, taper) = (self.phase * (b.phase - a.phase), self.taper * taper);
        (phase * phase + taper * taper).sqrt()
    }

    /// Number of elements on a piece; approximate if there are many pieces.
    fn length(&self, piece: &[Sample]) -> f64 {
        match (self.many, piece) {
            (true, [first, .., last]) => self.share(first, last),
            _ => self.exactly(piece),
        }
    }

    /// Number of elements on a piece, exactly.
    fn exactly(&self, piece: &[Sample]) -> f64 {
        piece.windows(2).map(|w| self.share(&w[0], &w[1])).sum()
    }

    /// Number of elements of a bat whose elements end at stations.
    fn elements(&self, survey: &Survey) -> usize {
        survey.pieces().map(|piece| whole(self.length(piece))).sum()
    }

    /// The borders of the elements: equal shares of every stretch, or of every piece.
    fn borders(&self, survey: &Survey, stations: Option<&Stations>) -> Vec<(usize, f64)> {
        let mut borders = Vec::with_capacity(self.count + 1);
        borders.push((0, 0.0));
        match (self.over, stations) {
            (Some(shorter), Some(stations)) => {
                let counts = self.on_stretches(survey, stations, shorter);
                for (stretch, count) in stations.stretches.iter().zip(counts) {
                    self.divide(survey, stretch.clone(), Some(count), &mut borders);
                }
            }
            _ => (0..survey.pieces().count())
                .for_each(|k| self.divide(survey, k..k + 1, None, &mut borders)),
        }
        borders
    }

    /// Adds the borders on these pieces, except the first.
    fn divide(
        &self,
        survey: &Survey,
        pieces: Range<usize>,
        count: Option<usize>,
        borders: &mut Vec<(usize, f64)>,
    ) {
        let length: f64 = pieces.clone().map(|k| self.exactly(survey.piece(k))).sum();
        let count = count.unwrap_or(whole(length));
        let step = length / count as f64;
        let (mut sum, mut next) = (0.0, 1);
        for k in pieces.clone() {
            for w in survey.piece(k).windows(2) {
                let here = self.share(&w[0], &w[1]);
                while next < count && sum + here >= step * next as f64 {
                    let part = (step * next as f64 - sum) / here;
                    borders.push((k, w[0].s + part * (w[1].s - w[0].s)));
                    next += 1;
                }
                sum += here;
            }
        }
        borders.push((pieces.end - 1, 1.0));
    }
}

/// A whole number of elements, at least one.
fn whole(length: f64) -> usize {
    (length.ceil() as usize).max(1)
}

/// The largest `a` of a wave whose error is within the tolerance.
fn of_waves(degree: usize, tolerance: f64) -> f64 {
    let m = degree - 1;
    let odd: f64 = (1..=m).map(|k| (2 * k + 1) as f64).product();
    ((2.0 * tolerance / (2 * m + 1) as f64).sqrt() * odd).powf(1.0 / m as f64)
}

/// The largest `t` of a taper whose error is within the tolerance.
fn of_tapers(degree: usize, tolerance: f64) -> f64 {
    let m = (degree - 1) as f64;
    let ratio: f64 = (1..degree).map(|k| 2.0 * k as f64 / (2 * k - 1) as f64).product();
    let first = (m + 1.0) * (m + 2.0) * (m + 3.0) / 6.0 * ratio;
    let root = ((2.0 * tolerance * (2.0 * m + 1.0)).sqrt() / first).powf(1.0 / m);
    // `t` stays finite: an element with an infinite `t` would reach into a point of the bat.
    4.0 * root.min(0.9).atanh()
}

/// Relative cost of an element of that degree, measured from assembly to error estimate.
fn cost(degree: usize) -> f64 {
    let p = degree as f64;
    1.0 + 0.12 * p * p
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::quadrature::{gauss, legendre};

    #[test]
    fn the_error_formula_is_the_known_one_for_cubics() {
        // (kh)⁴/1440 with a = kh/2.
        for tolerance in [1e-3, 1e-6, 1e-9] {
            let a = of_waves(3, tolerance);
            assert!(((2.0 * a).powi(4) / 1440.0 / tolerance - 1.0).abs() < 1e-12);
        }
    }

    /// `½ c_m²/(2m + 1) / Σ c_k²/(2k + 1)` with the Legendre coefficients `c_k` of `r⁻⁴` on a cone,
    /// by quadrature.
    #[test]
    fn the_formula_for_tapers_is_the_first_term_left_out() {
        for (degree, tolerance) in [(3, 1e-2), (3, 1e-5), (5, 1e-4), (6, 1e-7), (8, 1e-10)] {
            let t = of_tapers(degree, tolerance);
            let (mut left, mut whole) = (0.0, 0.0);
            for (s, weight) in gauss(40) {
                let bend = (1.0 + (2.0 * s - 1.0) * (0.5 * t).tanh()).powi(-4);
                left += weight * bend * legendre(degree, 2.0 * s - 1.0)[degree - 1];
                whole += weight * bend * bend;
            }
            let error = 0.5 * left * left * (2 * degree - 1) as f64 / whole;
            assert!(error < 1.1 * tolerance && error > 0.4 * tolerance, "{degree} {t} {error:e}");
        }
    }
}
