//! Which stations may an element reach over, and what error does that cause?
//!
//! Between stations the radii are cubics, and a polynomial's curvature follows them. At a station the m-th derivative
//! of the radius jumps (m = 2 for the monotone cubic, 1 for straight lines). That of the curvature `w″ = M/EI` then
//! jumps by `J w″` with
//!
//! ```text
//! J = 4 (r³ Δr − r_i³ Δr_i)/(r⁴ − r_i⁴),     Δr the jump of the m-th derivative.
//! ```
//!
//! Polynomials of degree p − 2 on an element from a to b cannot follow such a kink at the station x; their error is
//!
//! ```text
//! Δf/f = J²/(2π (2m + 1)) (k/Φ) ρ^{2m+1},     ρ = √((x − a)(b − x))/(p − 1)
//! ```
//!
//! with the local wave number k and the phase Φ of the mode from end to end. At a phase φ < 1 from a free end, where
//! the bending moment grows from 0 as φ², it is multiplied by φ⁴. If stations are closer to each other than ρ, their
//! kinks act as one bend of the side: of the 2m powers of ρ, those beyond the first are then replaced by powers of the
//! distance ℓ.
//!
//! # Source
//!
//! Derived here. The Legendre coefficients of `(ξ − ξ₀)₊^m/m!` are (m + 1)-fold integrals of `P_n`. Their leading term
//! for large n is that of Abramowitz and Stegun (1964), 22.15 (Darboux); its square is averaged and summed over n from
//! p − 1. The energy of a mode is distributed along the bat as k, because the flux of energy is constant, and half of
//! it is in bending. `examples/tuning/over_stations.rs` prints formula and true error side by side.

use std::f64::consts::PI;
use std::ops::Range;

use crate::bat::{Bat, Cubics, Piece, Radii, SAME_PLACE};
use crate::modes::survey::Survey;

/// A radius below this share of the widest ends a stretch: the 1/EI of both sides differ too much to be added.
const NARROW: f64 = 0.15;
/// Kinks closer than this share of a resolution are one.
const NEAR: f64 = 0.5;

/// Stretches that an element may reach over, and the stations inside.
#[derive(Debug)]
pub struct Stations {
    /// Stretches of pieces with a continuous section, without a border, a fixture or a support inside.
    pub stretches: Vec<Range<usize>>,
    /// Their inner stations.
    kinks: Vec<Kink>,
}

/// A station inside a stretch.
#[derive(Debug)]
struct Kink {
    /// The piece to its right.
    piece: usize,
    /// `J²/(2π (2m + 1))` (1/m^{2m}).
    weight: f64,
    /// 2m + 1.
    order: i32,
    /// Density of a mode's energy there (1/m).
    energy: f64,
}

impl Stations {
    /// The stretches of a bat; `None` if no element could reach over a station.
    pub fn of(bat: &Bat, survey: &Survey) -> Option<Self> {
        let pieces = &bat.profile().pieces;
        let widest = bat.profile().widest();
        let held = bat.fixtures().borders();
        let same = SAME_PLACE * bat.length();
        let (mut stretches, mut kinks, mut first) = (vec![], Vec::with_capacity(pieces.len()), 0);
        let phase = |k: usize| survey.root_omega * survey.piece(k).last().map_or(0.0, |s| s.phase);
        let whole: f64 = (0..pieces.len()).map(phase).sum();
        let free = bat.fixtures().none_moving();
        let mut before = 0.0;
        for k in 1..=pieces.len() {
            before += phase(k - 1);
            let pair = pieces.get(k).map(|right| [&pieces[k - 1], right]);
            let fixed = |right: &Piece| held.iter().any(|x| (x - right.start).abs() <= same);
            let kink = pair.filter(|[_, right]| !fixed(right)).and_then(|pair| kink(pair, widest));
            let Some((weight, order)) = kink else {
                stretches.push(first..k);
                first = k;
                continue;
            };
            let wave = (phase(k - 1) + phase(k)) / (pieces[k - 1].length + pieces[k].length);
            let from_end = if free { before.min(whole - before).min(1.0) } else { 1.0 };
            kinks.push(Kink { piece: k, weight, order, energy: wave / whole * from_end.powi(4) });
        }
        (!kinks.is_empty()).then_some(Self { stretches, kinks })
    }

    /// The smallest value of 2m + 1 among the kinks.
    pub fn order(&self) -> i32 {
        self.kinks.iter().map(|kink| kink.order).min().unwrap_or(1)
    }

    /// Relative error due to the kinks for a mode of that phase, averaged over all positions in an element. One metre
    /// at the ends of piece k is `per_length(k)` of an element.
    pub fn missed(&self, bat: &Bat, degree: usize, per_length: impl Fn(usize) -> f64) -> f64 {
        let pieces = &bat.profile().pieces;
        let of = |kink: &Kink| {
            let [left, right] = [kink.piece - 1, kink.piece];
            let length = pieces[left].length + pieces[right].length;
            let share = 0.5 * (per_length(left) + per_length(right));
            let half = 0.5 / (share * (degree - 1) as f64);
            // The mean of (1 − ξ²)^{m + ½}.
            let mean = if kink.order > 3 { 5.0 * PI / 32.0 } else { 3.0 * PI / 16.0 };
            let near = half.min(NEAR * 0.5 * length);
            let square = near * near;
            let power = if kink.order > 3 { square * square } else { square };
            kink.weight * kink.energy * mean * half * power
        };
        self.kinks.iter().map(of).sum()
    }
}

/// [`Kink::weight`] and [`Kink::order`] between two pieces; `None` if the section jumps, or is so thin that it has no
/// softness.
fn kink([left, right]: [&Piece; 2], widest: f64) -> Option<(f64, i32)> {
    let (Radii::Cubic(a), Radii::Cubic(b)) = (&left.radii, &right.radii) else { return None };
    let ends = [a.outer[0], a.outer[3], b.outer[3]];
    let thin = ends.iter().any(|r| *r < NARROW * widest);
    let continuous = a.outer[3] == b.outer[0] && a.inner[3] == b.inner[0];
    if left.layup != right.layup || thin || !continuous {
        return None;
    }
    let (r, inner) = (b.outer[0], b.inner[0]);
    let order = a.degree.max(b.degree);
    let m = if order > 1 { 2 } else { 1 };
    let jump = |of: fn(&Cubics) -> &[f64; 4]| {
        let [from, to] =
            [derivatives(of(a), left.length, true), derivatives(of(b), right.length, false)];
        to[m - 1] - from[m - 1]
    };
    let [outwards, inwards] = [jump(|cubics| &cubics.outer), jump(|cubics| &cubics.inner)];
    let relative =
        4.0 * (r.powi(3) * outwards - inner.powi(3) * inwards) / (r.powi(4) - inner.powi(4));
    let order = 2 * m as i32 + 1;
    Some((relative * relative / (2.0 * PI * f64::from(order)), order))
}

/// The first two derivatives of a cubic on a piece of that length, at its end or its beginning.
fn derivatives(b: &[f64; 4], length: f64, at_end: bool) -> [f64; 2] {
    let [first, second] = match at_end {
        true => [b[3] - b[2], b[3] - 2.0 * b[2] + b[1]],
        false => [b[1] - b[0], b[2] - 2.0 * b[1] + b[0]],
    };
    [3.0 * first / length, 6.0 * second / (length * length)]
}
