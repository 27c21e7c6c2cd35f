//! What are the radii along the bat, as intervals that contain those of the bat in the file?
//!
//! The doubles of a bat are decimals of its file times units, each with a relative error of some `u`. The proof applies
//! to the decimals: [`LENGTH`], [`NUMBER`] and [`BORE`] cover all rounding on reading. Curves are computed again
//! through such intervals by the formulas of `bat/pchip.rs`. Slopes are continuous functions of the stations, so that
//! where an interval leaves a branch open the hull of both branches is correct.

use sweetspot::base::interval::{UNIT, up};
use sweetspot::base::{Error, Interval, Result};
use sweetspot::bat::{Bat, Interpolation, Piece, Radii, SAME_PLACE, Stations};

/// Relative error of a length against its text in the file. A fraction of an inch takes a quotient and a sum, the unit
/// a factor and a product, feet and inches another sum: `5u`, and a half is exact.
pub const LENGTH: f64 = 6.0 * UNIT;
/// An inner radius is within this share of the outer one: outer radius less wall, each a length.
pub const BORE: f64 = 13.0 * UNIT;
/// Relative error of any other number against its text in the file. A unit such as `lb/in^3` is a quotient of powers of
/// factors that are products themselves, with fewer than twenty roundings.
pub const NUMBER: f64 = 32.0 * UNIT;
/// Largest difference between curves in plain numbers and in intervals, relative to the radius.
const ALIKE: f64 = 1e-9;

/// Bernstein coefficients of a cubic.
pub type Cubic = [Interval; 4];

/// A piece of the profile.
#[derive(Debug, Clone)]
pub struct Curved {
    /// Position of its beginning (m).
    pub start: Interval,
    /// Its length (m).
    pub length: Interval,
    /// The outer radius (m).
    pub outer: Cubic,
    /// The inner radius (m); None where the bat is solid.
    pub inner: Option<Cubic>,
    /// The radii's degree.
    pub degree: usize,
}

impl Curved {
    /// The part from `from` to `to`, as fractions of it in [0, 1].
    pub fn part(&self, from: f64, to: f64) -> Self {
        let [from, to] = [from, to].map(Interval::point);
        Self {
            start: self.start + self.length * from,
            length: self.length * (to - from),
            outer: subdivide(&self.outer, from, to),
            inner: self.inner.map(|inner| subdivide(&inner, from, to)),
            degree: self.degree,
        }
    }
}

/// The place `x` (m) from the knob end; in a reversed profile places are differences from `length`.
pub fn place(x: f64, turned: Option<f64>) -> Interval {
    match x == 0.0 {
        true => Interval::point(0.0),
        false => {
            let off = LENGTH * x.abs() + turned.map_or(0.0, |length| 2.0 * LENGTH * length);
            Interval::point(x) + Interval::within(up(off))
        }
    }
}

/// The pieces of the profile of the bat.
///
/// # Errors
///
/// [`Error::Value`] for formulas, and for curves other than those through the stations.
pub fn curved(bat: &Bat) -> Result<Vec<Curved>> {
    let profile = bat.profile();
    let stations = &profile.stations;
    let turned = profile.turned.then(|| profile.length());
    let x: Vec<Interval> = stations.x.iter().map(|x| place(*x, turned)).collect();
    let around = |r: f64, off: f64| {
        if r == 0.0 { Interval::point(0.0) } else { Interval::point(r) + Interval::within(up(off)) }
    };
    let outer: Vec<_> = stations.outer.iter().map(|r| around(*r, LENGTH * r)).collect();
    let both = stations.inner.iter().zip(&stations.outer);
    let inner: Vec<_> = both.map(|(r, outer)| around(*r, BORE * outer)).collect();
    let laid = [outer, inner].map(|radii| cubics(stations, &x, &radii));
    profile.pieces.iter().map(|piece| on_piece(piece, stations, &x, &laid)).collect()
}

/// The radii on a piece, which lies between two stations.
fn on_piece(
    piece: &Piece,
    stations: &Stations,
    x: &[Interval],
    laid: &[Vec<Cubic>; 2],
) -> Result<Curved> {
    let Radii::Cubic(own) = &piece.radii else {
        let expected = "a profile of stations: what is proven is proven of polynomials";
        return Err(Error::value("profile.pieces", "formulas", expected));
    };
    let length = *stations.x.last().expect("a profile has stations");
    let middle = piece.start + 0.5 * piece.length;
    let k = stations.x.partition_point(|at| *at <= middle).clamp(1, stations.x.len() - 1) - 1;
    let same = |at: f64, k: usize| (at - stations.x[k]).abs() <= SAME_PLACE * length;
    let border = |at: f64| match (same(at, k), same(at, k + 1)) {
        (true, _) => (x[k], Interval::point(0.0)),
        (_, true) => (x[k + 1], Interval::point(1.0)),
        _ => {
            // A region's border counts from the knob end.
            let place = place(at, None);
            let all = Interval { low: 0.0, high: 1.0 };
            let part = (x[k + 1] - x[k]).reciprocal().map(|over| (place - x[k]) * over);
            (place, part.map_or(all, |part| part.and(all)))
        }
    };
    let ((start, from), (end, to)) = (border(piece.start), border(piece.start + piece.length));
    let hollow = own.inner != [0.0; 4];
    let curve = Curved {
        start,
        length: end - start,
        outer: subdivide(&laid[0][k], from, to),
        inner: hollow.then(|| subdivide(&laid[1][k], from, to)),
        degree: own.degree,
    };
    let near = |cubic: &Cubic, own: &[f64; 4], outer: &[f64; 4]| {
        let off = ALIKE * outer.iter().fold(0.0, |most, r| f64::max(most, *r));
        cubic.iter().zip(own).all(|(cubic, own)| cubic.distance(*own) <= off)
    };
    let alike = near(&curve.outer, &own.outer, &own.outer)
        && curve.inner.is_none_or(|inner| near(&inner, &own.inner, &own.outer));
    if !alike || curve.length.low <= 0.0 {
        let found = format!("another curve than that through the stations at {middle:.4} m");
        return Err(Error::value("profile", found, "stations, and no edit that moves the curve"));
    }
    Ok(curve)
}

/// One cubic from each station to the next; the one between the two sides of a step is unused.
fn cubics(stations: &Stations, x: &[Interval], y: &[Interval]) -> Vec<Cubic> {
    let mut all = Vec::with_capacity(x.len());
    let mut first = 0;
    while first < x.len() {
        let step = (first + 1..x.len()).find(|&k| stations.x[k] == stations.x[k - 1]);
        let end = step.unwrap_or(x.len());
        let run = first..end;
        match stations.interpolation {
            Interpolation::Pchip => all.extend(smooth(&x[run.clone()], &y[run])),
            _ => all.extend(y[run].windows(2).map(|pair| line(pair[0], pair[1]))),
        }
        if end < x.len() {
            all.push([Interval::point(0.0); 4]);
        }
        first = end;
    }
    all
}

fn number(value: f64) -> Interval {
    Interval::point(value)
}

fn over(a: Interval, b: Interval) -> Interval {
    b.reciprocal().map_or(Interval::within(f64::INFINITY), |one_over| a * one_over)
}

fn line(a: Interval, b: Interval) -> Cubic {
    let third = over(b - a, number(3.0));
    [a, a + third, b - third, b]
}

/// The monotone cubics of [`sweetspot::bat::pchip`].
fn smooth(x: &[Interval], y: &[Interval]) -> Vec<Cubic> {
    let slopes = slopes(x, y);
    let cubic = |k: usize| {
        let h = over(x[k + 1] - x[k], number(3.0));
        let between = y[k].hull(y[k + 1]);
        let first = (y[k] + h * slopes[k]).and(between);
        let second = (y[k + 1] - h * slopes[k + 1]).and(between);
        [y[k], first, second, y[k + 1]]
    };
    (0..x.len() - 1).map(cubic).collect()
}

fn slopes(x: &[Interval], y: &[Interval]) -> Vec<Interval> {
    let n = x.len();
    let h: Vec<Interval> = x.windows(2).map(|w| w[1] - w[0]).collect();
    let m: Vec<Interval> = (0..n - 1).map(|k| over(y[k + 1] - y[k], h[k])).collect();
    if n == 2 {
        return vec![m[0]; 2];
    }
    let mut slopes = vec![end(h[0], h[1], m[0], m[1])];
    slopes.extend((1..n - 1).map(|k| inside([h[k - 1], h[k]], [m[k - 1], m[k]])));
    slopes.push(end(h[n - 2], h[n - 3], m[n - 2], m[n - 3]));
    slopes
}

/// Whether numbers of both may have the same sign, where 0 counts as a third sign.
fn may_agree(a: Interval, b: Interval) -> bool {
    let zero = |of: Interval| of.low <= 0.0 && of.high >= 0.0;
    a.high > 0.0 && b.high > 0.0 || a.low < 0.0 && b.low < 0.0 || zero(a) && zero(b)
}

/// Whether numbers of both surely have the same sign and are not 0.
fn agree(a: Interval, b: Interval) -> bool {
    a.low > 0.0 && b.low > 0.0 || a.high < 0.0 && b.high < 0.0
}

/// The weighted harmonic mean of two secants, 0 where they differ in sign; it is at most
/// `(w₁ + w₂)/w` times either.
fn inside([before_h, after_h]: [Interval; 2], [before, after]: [Interval; 2]) -> Interval {
    let (w1, w2) = (after_h + after_h + before_h, after_h + before_h + before_h);
    if agree(before, after) {
        return over(w1 + w2, over(w1, before) + over(w2, after));
    }
    if before.low >= 0.0 && after.high <= 0.0 || before.high <= 0.0 && after.low >= 0.0 {
        return number(0.0);
    }
    let most = |w: Interval, secant: Interval| (over(w1 + w2, w) * secant).largest();
    Interval::within(most(w1, before).min(most(w2, after)))
}

/// The slope at an end, as the formula of [`sweetspot::bat::pchip`] chooses it.
fn end(h0: Interval, h1: Interval, m0: Interval, m1: Interval) -> Interval {
    let slope = over((h0 + h0 + h1) * m0 - h0 * m1, h0 + h1);
    let thrice = number(3.0) * m0;
    let far = slope.smallest() > thrice.largest();
    let own = may_agree(slope, m0) && (may_agree(m0, m1) && may_agree(slope, m1) || !far);
    let limited = !agree(m0, m1) && slope.largest() > thrice.smallest();
    let branches = [
        (!agree(slope, m0)).then_some(number(0.0)),
        limited.then_some(thrice),
        own.then_some(slope),
    ];
    branches.into_iter().flatten().reduce(Interval::hull).unwrap_or(slope)
}

/// The polar form of a cubic.
fn blossom(b: &Cubic, s: Interval, t: Interval, u: Interval) -> Interval {
    let cut = |a: Interval, b: Interval, s: Interval| (number(1.0) - s) * a + s * b;
    let (c0, c1, c2) = (cut(b[0], b[1], s), cut(b[1], b[2], s), cut(b[2], b[3], s));
    cut(cut(c0, c1, t), cut(c1, c2, t), u)
}

/// Bernstein coefficients of the same cubic between `s0` and `s1`.
fn subdivide(b: &Cubic, s0: Interval, s1: Interval) -> Cubic {
    if s0 == number(0.0) && s1 == number(1.0) {
        return *b;
    }
    [blossom(b, s0, s0, s0), blossom(b, s0, s0, s1), blossom(b, s0, s1, s1), blossom(b, s1, s1, s1)]
}
