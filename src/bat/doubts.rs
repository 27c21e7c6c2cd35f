//! What is unknown or unusual about a bat, and which measured value does not fit it?

use crate::base::units::ounce_square_inches;
use crate::base::{shown_length, significant};
use crate::bat::body::{Bat, STANDARD_PIVOT};
use crate::bat::inertia::Inertia;
use crate::bat::layup::Layup;
use crate::bat::material::{Material, UNTOLD_DENSITY, UNTOLD_MODULUS};
use crate::bat::profile::Piece;

impl Bat {
    /// Whether every stretch of the bat has a shear modulus.
    pub fn knows_shear(&self) -> bool {
        let known = |piece: &Piece| {
            self.layup(piece).materials().all(|material| material.shear_modulus.is_some())
        };
        self.profile().pieces.iter().all(known)
    }

    /// The materials of the regions, each with its path in the bat file.
    pub fn regional(&self) -> impl Iterator<Item = (String, &Material)> {
        // An edit makes regions that are not in the file.
        let of_file = self.edits().is_empty();
        self.fixtures().regions.iter().enumerate().flat_map(move |(k, region)| {
            let name = move |part: &str| match of_file {
                true => format!("regions[{k}].{part}"),
                false => format!("a {part} of regions or edits"),
            };
            let Layup { outer, core, sleeves, .. } = &region.layup;
            let core = core.iter().map(move |core| (name("core"), core));
            let layer = move |m: usize| {
                if of_file { name(&format!("layers[{m}].material")) } else { name("sleeve") }
            };
            let sleeves = sleeves.iter().enumerate().map(move |(m, own)| (layer(m), &own.material));
            std::iter::once((name("material"), outer)).chain(core).chain(sleeves)
        })
    }

    /// The path in the bat file of the first material whose shear modulus is not known.
    pub fn without_shear(&self) -> String {
        let unknown = |material: &Material| material.shear_modulus.is_none();
        let region = self.regional().find(|(_, material)| unknown(material));
        match region {
            Some((name, _)) if !unknown(self.material()) => name,
            _ => "material".to_owned(),
        }
    }

    /// Values that are possible but unusual for a bat, one sentence each, as warnings.
    pub fn warnings(&self) -> Vec<String> {
        let Inertia { mass, balance_point, .. } = self.inertia();
        let length = self.length();
        let checks = [
            ("length", length, "m", 0.3, 1.2, " (bare numbers are in m: \"unit\": \"in\"?)"),
            (
                "largest radius",
                self.profile().widest(),
                "m",
                0.01,
                0.05,
                " (a diameter given as radius?)",
            ),
            ("mass", mass, "kg", 0.2, 2.0, " (bare numbers are in kg: \"31 oz\"?)"),
            ("balance point", balance_point, "m", 0.0, length, ""),
        ];
        let checks = checks.into_iter();
        let strange = checks.filter_map(|(what, value, unit, low, high, hint)| {
            strange(what, value, unit, [low, high], hint)
        });
        let mut warnings: Vec<String> = strange.collect();
        warnings.extend(strange_material("", self.material(), WALL));
        warnings.extend(self.density_off());
        self.warn_of_regions(&mut warnings);
        let attached = self.fixtures().attached_mass();
        if attached > mass - attached {
            let [attached, own] = [attached, mass - attached].map(plain);
            warnings.push(format!("{attached} kg are attached to a bat of {own} kg"));
        }
        for (k, a) in self.fixtures().attachments.iter().enumerate() {
            let center = a.x + a.offset;
            if a.mass > 0.0 && !(0.0..=length).contains(&center) {
                let [center, length] = [center, length].map(plain);
                let offset = format!("attachments[{k}].offset puts the mass at {center} m");
                warnings.push(format!("{offset}, outside the bat, 0 to {length} m"));
            }
        }
        warnings
    }

    /// A warning about an unusual density: the weighed mass asks for one far from the file's, or the file's does not
    /// fit the stiffness.
    ///
    /// Wood is within 0.8 to 1.25 of its kind's density, a metal within a tenth of its alloy's.
    pub fn density_off(&self) -> Option<String> {
        let before = self.unedited();
        let (material, factor) = (before.material(), before.factors()[0]);
        let own = Material { density: material.density / factor, ..material.clone() };
        // A material without a density in the file gets the weighed one.
        if (own.density / UNTOLD_DENSITY - 1.0).abs() < 1e-9 {
            return None;
        }
        // A tap sets the stiffness; compare with the file's.
        let own = Material { youngs_modulus: own.youngs_modulus / before.factors()[1], ..own };
        let usual = if own.is_metal() { 0.9..1.1 } else { 0.8..1.25 };
        if usual.contains(&factor) {
            return own.no_material();
        }
        let hollow = before.profile().pieces.iter().any(|piece| piece.at(0.5).inner > 0.0);
        let [needed, has] = [material.density, own.density].map(plain);
        let of = own.name.map_or(String::new(), |name| format!(" of {name}"));
        let hint = match (factor < 1.0, hollow) {
            (true, false) => {
                "is the bat hollow? its wall goes into the file: \"wall_thickness\" in \"profile\""
            }
            (true, true) => "is the wall thinner, or the mass or a diameter off?",
            (false, true) => {
                "is the wall thicker, or a plug, a cap, a knob or a tape not in the file?"
            }
            (false, false) => "is it another material, or the mass or a diameter off?",
        };
        Some(format!(
            "to weigh so much it must have {needed} kg/m³, far from the {has} kg/m³{of}: {hint}"
        ))
    }

    /// A warning about a tap that asks for a stiffness far from the file's: wood is within half and twice its kind's, a
    /// metal within a fifth of its alloy's.
    pub fn stiffness_off(&self) -> Option<String> {
        let before = self.unedited();
        let (material, factor) = (before.material(), before.factors()[1]);
        let own = material.youngs_modulus / factor;
        let usual = if material.is_metal() { 0.8..1.25 } else { 0.5..2.0 };
        // A material without a modulus in the file gets the tapped one.
        if usual.contains(&factor) || (own / UNTOLD_MODULUS - 1.0).abs() < 1e-9 {
            return None;
        }
        let [needed, has] = [material.youngs_modulus, own].map(|e| significant(1e-9 * e, 3));
        Some(format!(
            "to sound so its Young's modulus must be {needed} GPa, far from the file's {has} GPa: is the note that of \
             another mode or octave, or a diameter, the wall or the mass off?"
        ))
    }

    /// A warning about a measured balance point that is far from the computed one.
    pub fn balance_off(&self) -> Option<String> {
        /// More than a rule and the edge of a table can be wrong (m).
        const FAR: f64 = 0.01;
        let measured = self.weighed().balance_point?;
        let computed = self.unedited().inertia().balance_point;
        ((computed - measured).abs() > FAR).then(|| {
            let [computed, measured] = [computed, measured].map(shown_length);
            format!(
                "the balance point was measured at {measured}, and is at {computed} by the profile: the \
                 diameters, the mass or the measured place is off, or the wood is not alike everywhere"
            )
        })
    }

    /// The measured swing weight (kg m², about 6 in from the knob end), given directly or by a pendulum:
    /// `I = m g d T²/4π²` about its pivot, with d the distance to the balance point. Mass and balance point are the
    /// measured ones, else the computed ones.
    pub fn measured_swing_weight(&self) -> Option<f64> {
        const GRAVITY: f64 = 9.806_65;
        let weighed = self.weighed();
        let of_pendulum = || {
            let computed = self.unedited().inertia();
            let mass = weighed.mass.unwrap_or(computed.mass);
            let balance_point = weighed.balance_point.unwrap_or(computed.balance_point);
            let arm = balance_point - weighed.pendulum_pivot.unwrap_or(STANDARD_PIVOT);
            let turns = weighed.pendulum_period? / std::f64::consts::TAU;
            let about_pivot = mass * GRAVITY * arm.abs() * turns.powi(2);
            let other = balance_point - STANDARD_PIVOT;
            Some(about_pivot + mass * (other.powi(2) - arm.powi(2)))
        };
        weighed.swing_weight.or_else(of_pendulum)
    }

    /// A warning about a measured swing weight that is far from the computed one.
    pub fn swing_weight_off(&self) -> Option<String> {
        /// More than a pendulum and a table of diameters can be wrong (share).
        const FAR: f64 = 0.02;
        let measured = self.measured_swing_weight()?;
        let computed = self.unedited().inertia().about(STANDARD_PIVOT);
        ((computed / measured - 1.0).abs() > FAR || measured <= 0.0).then(|| {
            let told = |value: f64| format!("{:.0} oz in²", ounce_square_inches(value));
            let [computed, measured] = [computed, measured].map(told);
            format!(
                "the swing weight (6 in from the knob) was measured as {measured}, and is {computed} by the \
                 profile: the diameters, the mass or what was measured is off, or the wood is not alike \
                 everywhere"
            )
        })
    }

    fn warn_of_regions(&self, warnings: &mut Vec<String>) {
        for (k, region) in self.fixtures().regions.iter().enumerate() {
            let name = |key: &str| format!("regions[{k}].{key}.");
            let Layup { outer, core, .. } = &region.layup;
            if outer != self.material() {
                warnings.extend(strange_material(&name("material"), outer, WALL));
            }
            let Some(core) = core else { continue };
            warnings.extend(strange_material(&name("core"), core, CORE));
            let solid = |piece: &Piece| [0.0, 0.5, 1.0].iter().all(|s| piece.at(*s).inner == 0.0);
            let here = |piece: &&Piece| piece.is_within(region.from, region.to);
            if self.profile().pieces.iter().filter(here).all(solid) {
                warnings.push(format!("regions[{k}].core fills nothing: the bat is solid there"));
            }
        }
    }
}

/// Usual densities (kg/m³) and Young's moduli (Pa) of a bat's wall and of its core.
const WALL: [[f64; 2]; 2] = [[50.0, 20e3], [1e9, 1e12]];
const CORE: [[f64; 2]; 2] = [[5.0, 20e3], [1e4, 1e12]];

/// Warnings about a material; `of` is its path in the file.
fn strange_material(
    of: &str,
    material: &Material,
    usual: [[f64; 2]; 2],
) -> impl Iterator<Item = String> {
    let Material { density, youngs_modulus, .. } = *material;
    let hint = " (wood is 400 to 900: g/cm³ or lb/in³?)";
    let heavy = strange(&format!("{of}density"), density, "kg/m³", usual[0], hint);
    let hint = " (wood is 8e9 to 20e9: GPa?)";
    let stiff = strange(&format!("{of}youngs_modulus"), youngs_modulus, "Pa", usual[1], hint);
    // Along the grain of wood 0.05 to 0.11, of metals 0.38.
    let shear = material.shear_modulus.map(|shear| shear / youngs_modulus);
    let shear = shear.and_then(|share| {
        strange(&format!("{of}shear_modulus"), share, "times youngs_modulus", [0.01, 0.6], "")
    });
    let kappa = material
        .shear_coefficient
        .and_then(|kappa| strange(&format!("{of}shear_coefficient"), kappa, "", [0.3, 1.2], ""));
    heavy.into_iter().chain(stiff).chain(shear).chain(kappa)
}

/// A sentence about a value that is outside the usual range.
fn strange(what: &str, value: f64, unit: &str, usual: [f64; 2], hint: &str) -> Option<String> {
    if value >= usual[0] && value <= usual[1] {
        return None;
    }
    let [value, low, high] = [value, usual[0], usual[1]].map(plain);
    let value = format!("{value} {unit}");
    Some(format!("{what} is {}; a bat's is {low} to {high}{hint}", value.trim_end()))
}

/// A number with four digits, with a power of ten where the plain number would be a row of zeros.
fn plain(value: f64) -> String {
    let rounded: f64 = format!("{value:.3e}").parse().expect("it was written as a number");
    if rounded == 0.0 || (1e-3..1e5).contains(&rounded.abs()) {
        rounded.to_string()
    } else {
        format!("{rounded:e}")
    }
}
