//! What are the sections at the points of an element, and how much do the points miss?

use std::sync::LazyLock;

use crate::base::{Lanes, Real, WIDTH, gauss};
use crate::bat::formula_profile::LAST;
use crate::bat::{Bat, Cubics, Layup, Radii, Section, Theory, Worth};
use crate::beam::mesh::{Element, ElementPart, Mesh};
use crate::beam::rule::{GaussPoint, MOST_POINTS, Rule};

/// The sections at the points of the rule on one element.
#[inline(always)]
fn sections(bat: &Bat, e: &Element, rule: &Rule, mut at: impl FnMut(usize, Section)) {
    let piece = &bat.profile().pieces[e.piece];
    let Radii::Cubic(cubics) = &piece.radii else {
        for (i, point) in rule.points.iter().enumerate() {
            at(i, piece.at(e.from + (e.to - e.from) * point.s));
        }
        return;
    };
    let cubics = cubics.part(e.from, e.to);
    for (i, point) in rule.points.iter().enumerate() {
        at(i, point.section(&cubics));
    }
}

/// Values of the sections at the points of the rule, on an element over stations: those of the polynomials of degree 2p
/// with the true moments.
///
/// The moments are integrals from station to station, where the radii are cubics.
#[inline(always)]
pub fn over<const Q: usize>(
    bat: &Bat,
    e: &Element,
    rule: &Rule,
    of: impl Fn(&Layup, Section) -> [f64; Q],
) -> [[f64; MOST_POINTS]; Q] {
    let mut moments = Moments::<Q>::new(rule.moments_of_sections());
    for ElementPart { piece, of_piece: [from, to], of_element: [begin, end] } in e.parts(bat) {
        let piece = &bat.profile().pieces[piece];
        let (layup, share) = (bat.layup(piece), end - begin);
        let Radii::Cubic(cubics) = &piece.radii else { continue };
        let cubics = if [from, to] == [0.0, 1.0] { *cubics } else { cubics.part(from, to) };
        for point in &POINTS[points(&cubics, moments.count, [begin, end])] {
            let share_of = point.weight * share;
            let values = of(layup, point.section(&cubics));
            moments.add(2.0 * (begin + share * point.s) - 1.0, share_of, values);
        }
    }
    moments.flush();
    let mut values = [[0.0; MOST_POINTS]; Q];
    for (values, sums) in values.iter_mut().zip(&moments.sums) {
        rule.combine(&rule.from_moments, &sums[..moments.count], values);
    }
    values
}

/// Gauss's rules on [0, 1], by their number of points.
static POINTS: LazyLock<Vec<Vec<GaussPoint>>> = LazyLock::new(|| {
    let rule = |n: usize| gauss(n.max(1)).into_iter().map(GaussPoint::new).collect();
    (0..=MOST_POINTS).map(rule).collect()
});

/// Number of points for a part of an element whose sections are multiplied by that number of Legendre polynomials.
///
/// n points integrate `e^{zt}` on [0, 1] with the error `z^{2n} (n!)⁴/((2n)!)³`. `P_k` is nearly `cos kθ` with
/// `ξ = cos θ`, and a section whose radius goes from r₀ to r₁ is nearly `e^{4t ln r₁/r₀}`. n points are exact up to
/// degree 2n − 1.
fn points(cubics: &Cubics, count: usize, [begin, end]: [f64; 2]) -> usize {
    /// The largest z that 2, 3, … points integrate to 1e-12.
    const REACH: [f64; 19] = [
        0.005, 0.081, 0.344, 0.863, 1.651, 2.688, 3.947, 5.398, 7.014, 8.772, 10.65, 12.634,
        14.707, 16.859, 19.079, 21.36, 23.693, 26.073, 28.494,
    ];
    let (share, middle) = (end - begin, begin + end - 1.0);
    let turned = 2.0 * share / (1.0 - middle * middle).max(share).sqrt();
    let change = |from: f64, to: f64| (to - from).abs() / from.min(to);
    let [outer, inner] = [&cubics.outer, &cubics.inner];
    let wall = if inner[0] > 0.0 { change(outer[0] - inner[0], outer[3] - inner[3]) } else { 0.0 };
    let z = count as f64 * turned + 4.0 * change(outer[0], outer[3]).max(wall);
    let enough = 2 + REACH.iter().position(|reach| z <= *reach).unwrap_or(REACH.len());
    enough.min(count / 2 + 7)
}

/// Sums `Σ f P_k` over points, a vector of points at a time.
struct Moments<const Q: usize> {
    count: usize,
    sums: [[f64; MOST_POINTS]; Q],
    /// Points that are not in the sums yet, and their number.
    xi: Lanes,
    values: [Lanes; Q],
    waiting: usize,
}

impl<const Q: usize> Moments<Q> {
    #[inline(always)]
    fn new(count: usize) -> Self {
        let zero = Lanes::default();
        Self { count, sums: [[0.0; MOST_POINTS]; Q], xi: zero, values: [zero; Q], waiting: 0 }
    }

    #[inline(always)]
    fn add(&mut self, xi: f64, share: f64, values: [f64; Q]) {
        self.xi.set_lane(self.waiting, xi);
        for q in 0..Q {
            self.values[q].set_lane(self.waiting, values[q] * share);
        }
        self.waiting += 1;
        if self.waiting == WIDTH {
            self.flush();
        }
    }

    /// Adds the waiting points.
    #[inline(always)]
    fn flush(&mut self) {
        let (mut before, mut now) = (Lanes::default(), Lanes::splat(1.0));
        for (k, [next, last]) in RECURRENCE.iter().enumerate().take(self.count) {
            for (sums, value) in self.sums.iter_mut().zip(&self.values) {
                sums[k] += (*value * now).sum();
            }
            let after = Lanes::splat(*next) * self.xi * now - Lanes::splat(*last) * before;
            (before, now) = (now, after);
        }
        self.values = [Lanes::default(); Q];
        self.waiting = 0;
    }
}

/// `(2k + 1)/(k + 1)` and `k/(k + 1)`: `P_{k+1} = (2k + 1)/(k + 1) ξ P_k − k/(k + 1) P_{k−1}`.
const RECURRENCE: [[f64; 2]; MOST_POINTS] = {
    let mut factors = [[0.0; 2]; MOST_POINTS];
    let mut k = 0;
    while k < MOST_POINTS {
        factors[k] = [(2 * k + 1) as f64 / (k + 1) as f64, k as f64 / (k + 1) as f64];
        k += 1;
    }
    factors
};

/// EI (N m²) and ρA (kg/m) at the points of the rule on one element.
#[inline(always)]
pub fn bending_and_mass(
    bat: &Bat,
    e: &Element,
    rule: &Rule,
    mut take: impl FnMut(usize, [f64; 2]),
) {
    let layup = bat.layup(&bat.profile().pieces[e.piece]);
    sections(bat, e, rule, |i, section| take(i, layup.bending_and_mass(section)));
}

/// Values of the sections at the points of a rule for elements over stations; this element may be one.
#[inline(always)]
pub fn sampled<const Q: usize>(
    bat: &Bat,
    e: &Element,
    rule: &Rule,
    of: impl Fn(&Layup, Section) -> [f64; Q],
) -> [[f64; MOST_POINTS]; Q] {
    if e.over_stations() {
        return over(bat, e, rule, of);
    }
    let layup = bat.layup(&bat.profile().pieces[e.piece]);
    let mut values = [[0.0; MOST_POINTS]; Q];
    sections(bat, e, rule, |i, section| {
        for (values, value) in values.iter_mut().zip(of(layup, section)) {
            values[i] = value;
        }
    });
    values
}

/// All values of the sections there.
pub fn worths(bat: &Bat, e: &Element, rule: &Rule, mut take: impl FnMut(usize, Worth)) {
    if e.over_stations() {
        let [bending, mass, turning, shear] = over(bat, e, rule, |layup, section| {
            let Worth { bending, mass, turning, shear } = layup.worth(section);
            [bending, mass, turning, shear]
        });
        return (0..rule.count()).for_each(|i| {
            let [bending, mass, turning, shear] = [bending[i], mass[i], turning[i], shear[i]];
            take(i, Worth { bending, mass, turning, shear });
        });
    }
    let layup = bat.layup(&bat.profile().pieces[e.piece]);
    sections(bat, e, rule, |i, section| take(i, layup.worth(section)));
}

/// The sections' loss factors in bending and in shear there.
pub fn losses(bat: &Bat, e: &Element, rule: &Rule, mut take: impl FnMut(usize, [f64; 2])) {
    let layup = bat.layup(&bat.profile().pieces[e.piece]);
    if e.over_stations() {
        let at = |s: f64| bat.profile().at(e.start + s * e.length);
        return (0..rule.count()).for_each(|i| take(i, layup.loss(at(rule.points[i].s))));
    }
    sections(bat, e, rule, |i, section| take(i, layup.loss(section)));
}

/// Up to this, the relative error of a rule's points is round-off.
const RESOLVED: f64 = 1e-13;
/// Elements shorter than this share of the bat may hold features that no polynomial follows.
const SHORT: f64 = 1e-8;

/// Relative error of the sections at the points of the rule on an element; 0 if it is mere round-off.
///
/// Stations are polynomials that the rule represents exactly, except the κGA of a tapering bore or sleeve: there the
/// last terms of its Legendre series through the points are the error. Over stations all numbers are integrals, and the
/// error is 0. For formulas it is a bound from the parse tree on EI, ρA and κGA. On an element too short to matter, it
/// is the variation times the element's share of the bat.
pub fn missed(bat: &Bat, e: &Element, rule: &Rule, theory: Theory) -> f64 {
    let piece = &bat.profile().pieces[e.piece];
    let layup = bat.layup(piece);
    let missed = match &piece.radii {
        Radii::Cubic(_) if e.over_stations() => 0.0,
        Radii::Cubic(cubics) if cubics.degree == 0 => 0.0,
        Radii::Cubic(cubics) if cubics.inner == [0.0; 4] && layup.sleeves.is_empty() => 0.0,
        Radii::Cubic(_) if theory.shears() => shear_tail(bat, e, rule),
        Radii::Cubic(_) => 0.0,
        Radii::Formula(curves) => {
            let core = layup.core.as_ref().map_or(0.0, |core| {
                let of = [
                    core.youngs_modulus / layup.outer.youngs_modulus,
                    core.density / layup.outer.density,
                ];
                of[0].max(of[1])
            });
            let bounds = curves.bounds(e.from, e.to);
            let share = e.length / bat.length();
            let missed = bounds.as_ref().map_or(f64::INFINITY, |bounds| bounds.missed(core));
            let of_shear = bounds.as_ref().filter(|_| theory.shears() && curves.inner.is_some());
            let missed = of_shear.map_or(missed, |bounds| {
                let (empty, core) = (layup.emptiness(), layup.core_in_shear());
                missed.max(bounds.missed_shear(&layup.outer, empty, core))
            });
            let rough = || share * bounds.map_or(1.0, |bounds| bounds.variation(core));
            if share < SHORT { missed.min(rough()) } else { missed.min(1.0) }
        }
    };
    if missed > RESOLVED { missed } else { 0.0 }
}

/// The last terms of the Legendre series of κGA through the points, relative; 0 where that is the
/// round-off of a thin wall.
fn shear_tail(bat: &Bat, e: &Element, rule: &Rule) -> f64 {
    let (mut shear, mut thinness) = ([0.0; MOST_POINTS], 1.0_f64);
    let layup = bat.layup(&bat.profile().pieces[e.piece]);
    sections(bat, e, rule, |i, section| {
        shear[i] = layup.worth(section).shear;
        thinness = thinness.max(section.thinness());
    });
    let tail = rule.tail(&shear);
    if tail > 64.0 * f64::EPSILON * thinness { tail } else { 0.0 }
}

/// The largest [`missed`] of all elements.
pub fn missed_on(bat: &Bat, mesh: &Mesh, rule: &Rule, theory: Theory) -> f64 {
    mesh.elements.iter().map(|e| missed(bat, e, rule, theory)).fold(0.0, f64::max)
}

/// Relative round-off of the sections: `r/(r − r_i)` spacings for a wall that is the difference of two radii, and the
/// evaluation of formulas. The last part of either end is exempt from that of formulas, for it neither weighs nor
/// bends: a formula in the distance from a pointed tip has few digits there.
pub fn round_off(bat: &Bat, mesh: &Mesh) -> f64 {
    let of = |e: &Element, piece: usize| match &bat.profile().pieces[piece].radii {
        Radii::Cubic(cubics) if cubics.inner == [0.0; 4] => 0.0,
        Radii::Cubic(cubics) => {
            let walls = cubics.outer.iter().zip(&cubics.inner);
            let thinness =
                walls.map(|(outer, inner)| Section { outer: *outer, inner: *inner }.thinness());
            f64::EPSILON * thinness.fold(0.0, f64::max)
        }
        Radii::Formula(_) if e.ends_within(LAST, bat.length()) => 0.0,
        Radii::Formula(curves) => {
            curves.bounds(e.from, e.to).map_or(0.0, |bounds| bounds.round_off().min(1.0))
        }
    };
    let all = mesh.elements.iter().flat_map(|e| (e.piece..=e.last).map(move |piece| of(e, piece)));
    all.fold(0.0, f64::max)
}
