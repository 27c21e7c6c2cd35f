//! What are the sections at the points of an element, and how much of them do the points miss?

use crate::bat::body::Bat;
use crate::bat::layup::Worth;
use crate::bat::profile::{Radii, Section};
use crate::bat::theory::Theory;
use crate::beam::mesh::{Element, Mesh};
use crate::beam::rule::{MOST_POINTS, Rule};

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
    let solid = cubics.inner == [0.0; 4];
    for (i, point) in rule.points.iter().enumerate() {
        let v = &point.bernstein;
        let radius = |b: &[f64; 4]| (b[0] * v[0] + b[1] * v[1]) + (b[2] * v[2] + b[3] * v[3]);
        let inner = if solid { 0.0 } else { radius(&cubics.inner) };
        at(i, Section { outer: radius(&cubics.outer), inner });
    }
}

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

/// All that the sections are worth there.
pub fn worths(bat: &Bat, e: &Element, rule: &Rule, mut take: impl FnMut(usize, Worth)) {
    let layup = bat.layup(&bat.profile().pieces[e.piece]);
    sections(bat, e, rule, |i, section| take(i, layup.worth(section)));
}

/// The sections' loss factors in bending and in shear there.
pub fn losses(bat: &Bat, e: &Element, rule: &Rule, mut take: impl FnMut(usize, [f64; 2])) {
    let layup = bat.layup(&bat.profile().pieces[e.piece]);
    sections(bat, e, rule, |i, section| take(i, layup.loss(section)));
}

/// What the points of a rule miss of a section is mere round-off up to this.
const RESOLVED: f64 = 1e-13;
/// Elements shorter than this, as a share of the bat, may hold what no polynomial holds.
const SHORT: f64 = 1e-8;

/// How much of the sections on an element the points of its rule may miss, relative; 0 where that
/// is mere round-off.
///
/// Stations are polynomials that the rule holds exactly, but for the κGA of a bore or a sleeve that tapers: the
/// last terms of its Legendre series through the points count. Of formulas it is what bounds from
/// the parse tree leave of EI, ρA and κGA, and on an element so short that nothing on it matters its variation times
/// its share of the bat.
pub fn missed(bat: &Bat, e: &Element, rule: &Rule, theory: Theory) -> f64 {
    let piece = &bat.profile().pieces[e.piece];
    let layup = bat.layup(piece);
    let missed = match &piece.radii {
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

/// Round-off of the sections, relative: `r/(r − r_i)` spacings of a wall that is the difference of
/// two radii, and what evaluating a formula costs.
pub fn round_off(bat: &Bat, mesh: &Mesh) -> f64 {
    let of = |e: &Element| match &bat.profile().pieces[e.piece].radii {
        Radii::Cubic(cubics) if cubics.inner == [0.0; 4] => 0.0,
        Radii::Cubic(cubics) => {
            let walls = cubics.outer.iter().zip(&cubics.inner);
            let thinness =
                walls.map(|(outer, inner)| Section { outer: *outer, inner: *inner }.thinness());
            f64::EPSILON * thinness.fold(0.0, f64::max)
        }
        Radii::Formula(curves) => {
            curves.bounds(e.from, e.to).map_or(0.0, |bounds| bounds.round_off().min(1.0))
        }
    };
    mesh.elements.iter().map(of).fold(0.0, f64::max)
}
