//! Between which numbers do the frequencies of every similar bat lie?
//!
//! By the minimum-maximum principle a frequency rises with EI and κGA and falls with ρA and ρI, other things being
//! equal. So no bat whose radii are within `d` of these and whose moduli are within a relative tolerance `m` has a
//! lower frequency than a beam as stiff as the thinnest of them with moduli `(1 − m)`, and as heavy as the thickest;
//! and none has a higher frequency than the opposite. Both are bats with one sleeve of thickness `2d`, around a wall
//! that is thinner by `d`: a sleeve with mass and no stiffness, or one with stiffness and no mass.
//!
//! # Source
//!
//! R. Courant, D. Hilbert, Methods of Mathematical Physics I (1953), VI.1.

use crate::enclosure::beam::carried;
use crate::enclosure::guarantee::{Guarantee, guarantee};
use sweetspot::base::{Error, Result};
use sweetspot::bat::{Bat, Layer, Layup, Material, Profile, Region, Stations};
use sweetspot::modes::request::Request;
use sweetspot::modes::theory_choice;

/// Tolerances between a bat and its file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Within {
    /// Every radius, everywhere along the bat (m).
    pub radius: f64,
    /// Relative tolerance of Young's modulus and the shear modulus.
    pub modulus: f64,
}

/// The proven statements about every bat within the tolerances.
#[derive(Debug, Clone)]
pub struct Band {
    /// Lower and upper bounds of the frequencies (Hz), for the proven modes.
    pub hertz: Vec<[f64; 2]>,
    /// Whether all requested modes are proven, each bound as sharp as requested.
    pub met: bool,
}

/// The share by which a sleeve's missing stiffness or mass is not 0.
const NOTHING: f64 = 1e-18;
/// Relative allowance for it, and for the rounding of the radii computed here.
const ROOM: f64 = 1e-12;

/// The intervals of the frequencies of every bat within those tolerances.
///
/// # Errors
///
/// [`Error::Value`] for a hollow bat or one of several materials, for one that was weighed, for tape where sections
/// rotate, for radii not larger than the tolerance, and those of [`guarantee`].
pub fn band(bat: &Bat, request: &Request, within: Within) -> Result<Band> {
    let request = &Request { theory: theory_choice::of(bat, request)?, ..*request };
    carried(bat, request.theory)?;
    if request.theory.turns() && !bat.fixtures().tapes.is_empty() {
        // The fastest bat has the thickness of the thickest, so that tape on it would have too much rotary inertia.
        let found = format!("tape, and sections that turn ({})", request.theory.name());
        let expected =
            "a bat without tape, or the theory euler-bernoulli, whose tape is a mass alone";
        return Err(Error::value("within", found, expected));
    }
    let slow = guarantee(&hybrid(bat, within, false)?, request)?.1;
    let fast = guarantee(&hybrid(bat, within, true)?, request)?.1;
    let of = |found: &Guarantee, end: usize| -> Vec<f64> {
        found.modes.iter().map(|mode| mode.hertz[end]).collect()
    };
    let both = of(&slow, 0).into_iter().zip(of(&fast, 1));
    Ok(Band { hertz: both.map(|(low, high)| [low, high]).collect(), met: slow.met && fast.met })
}

/// The bat that rings slowest, or fastest.
fn hybrid(bat: &Bat, within: Within, fast: bool) -> Result<Bat> {
    let Stations { x, outer, inner, interpolation } = &bat.profile().stations;
    let refused = |found: &str, expected: &str| {
        Err(Error::value("within", found.to_owned(), expected.to_owned()))
    };
    if inner.iter().any(|inner| *inner > 0.0) || !bat.fixtures().regions.is_empty() {
        return refused("a hollow bat or one of several materials", "a solid bat of one material");
    }
    if bat.weighed().mass.is_some() {
        return refused("a bat that was weighed", "a density: thicker wood is heavier then");
    }
    let [least, most] = [f64::min, f64::max].map(|of| outer.iter().copied().reduce(of));
    let (least, most) = (least.unwrap_or(0.0), most.unwrap_or(0.0));
    let off = within.radius + ROOM * most;
    if off >= least {
        let found = format!("{} m, no less than a radius of the bat", within.radius);
        return refused(&found, "less than the smallest radius");
    }
    let share = if fast { 1.0 + within.modulus } else { 1.0 - within.modulus };
    if share <= 0.0 {
        return refused("all of the modulus", "less than 100 %");
    }
    let (stiff, heavy) =
        if fast { (share * (1.0 + ROOM), 1.0 - ROOM) } else { (share * (1.0 - ROOM), 1.0 + ROOM) };
    let wall = scaled(bat.material(), stiff, heavy);
    let sleeve = match fast {
        true => scaled(bat.material(), stiff, NOTHING),
        false => scaled(bat.material(), NOTHING, heavy),
    };
    let outer = outer.iter().map(|r| r + off).collect();
    let stations =
        Stations { x: x.clone(), outer, inner: inner.clone(), interpolation: *interpolation };
    let mut fixtures = bat.fixtures().clone();
    let sleeves = vec![Layer { thickness: 2.0 * off, material: sleeve }];
    let layup = Layup { sleeves, ..Layup::of(wall.clone()) };
    fixtures.regions.push(Region { from: 0.0, to: bat.length(), layup });
    Bat::builder(Profile::new(stations)?, wall).name(bat.name()).fixtures(fixtures).build()
}

/// A material with moduli and density times these.
fn scaled(material: &Material, modulus: f64, density: f64) -> Material {
    Material {
        youngs_modulus: modulus * material.youngs_modulus,
        shear_modulus: material.shear_modulus.map(|shear| modulus * shear),
        density: density * material.density,
        ..material.clone()
    }
}
