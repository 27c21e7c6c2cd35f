//! How stiff and how heavy is the bat's material?
//!
//! [`Material::named`] takes one from [`BUILT_IN`], [`Material::new`] one from given numbers. Set `shear_modulus` to
//! let it shear.

use std::sync::LazyLock;

use serde::{Deserialize, Serialize};

use crate::base::interval::Rectangle;
use crate::base::{Result, significant};

/// A material; for wood the values are along the grain, which is the bat's axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Material {
    /// The built-in name, if it has one.
    #[serde(skip)]
    pub name: Option<String>,
    /// Density ρ (kg/m³).
    pub density: f64,
    /// Young's modulus E (Pa).
    pub youngs_modulus: f64,
    /// Loss factor η in bending; a mode's damping ratio is ζ = η/2.
    pub loss_factor: f64,
    /// Loss factor η in shear, if it differs: that of wood is larger. A barrel's wall has a loss factor in bending
    /// only.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shear_loss_factor: Option<f64>,
    /// Shear modulus G (Pa), if known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shear_modulus: Option<f64>,
    /// Poisson's ratio ν, if it was given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub poisson_ratio: Option<f64>,
    /// Timoshenko's shear coefficient κ, if it was given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shear_coefficient: Option<f64>,
    /// Stress at which it breaks in bending (Pa), if known; for wood the modulus of rupture.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub strength: Option<f64>,
    /// Strain at which it breaks, if known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub strain_to_failure: Option<f64>,
    /// Young's modulus around the bat (Pa), for a composite whose stiffness depends on the direction.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hoop_modulus: Option<f64>,
    /// Young's modulus across the wall (Pa), for such a composite.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radial_modulus: Option<f64>,
    /// Shear moduli in the planes of such a composite.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shear_moduli: Option<ShearModuli>,
    /// Poisson's ratios in the planes of such a composite.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub poisson_ratios: Option<PoissonRatios>,
}

/// Shear moduli of a composite in the planes of the bat's directions.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ShearModuli {
    /// Shear modulus between the directions along and around the bat (Pa).
    pub along_around: f64,
    /// Shear modulus between the directions along the bat and across the wall (Pa).
    pub along_across: f64,
    /// Shear modulus between the directions around the bat and across the wall (Pa).
    pub around_across: f64,
}

/// Poisson's ratios of a composite: contraction in the second direction over extension in the first, when pulled in the
/// first.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PoissonRatios {
    /// Contraction around the bat when pulled along it.
    pub along_around: f64,
    /// Contraction across the wall when pulled along the bat.
    pub along_across: f64,
    /// Contraction across the wall when pulled around the bat.
    pub around_across: f64,
}

/// Stand-in density (kg/m³) of a material whose file leaves the density to the weighed mass; far below that of any
/// solid.
pub(crate) const UNTOLD_DENSITY: f64 = 1.0;

/// Young's modulus (Pa), one of wood, of a material whose file leaves it to the tap.
pub(crate) const UNTOLD_MODULUS: f64 = 1e10;

impl Material {
    /// A material known by density (kg/m³) and Young's modulus (Pa) alone.
    ///
    /// # Errors
    ///
    /// [`crate::Error::Value`] if one of them is not a positive number.
    pub fn new(density: f64, youngs_modulus: f64) -> Result<Self> {
        let material = Self::unchecked(density, youngs_modulus);
        material.check()?;
        Ok(material)
    }

    fn unchecked(density: f64, youngs_modulus: f64) -> Self {
        Self {
            name: None,
            density,
            youngs_modulus,
            shear_modulus: None,
            poisson_ratio: None,
            shear_coefficient: None,
            loss_factor: 0.0,
            shear_loss_factor: None,
            strength: None,
            strain_to_failure: None,
            hoop_modulus: None,
            radial_modulus: None,
            shear_moduli: None,
            poisson_ratios: None,
        }
    }

    /// Loss factors in bending and in shear.
    pub fn losses(&self) -> [f64; 2] {
        [self.loss_factor, self.shear_loss_factor.unwrap_or(self.loss_factor)]
    }

    /// The published loss factor of its kind. A metal (denser than glass fibre and isotropic) has that of aluminium.
    /// Wood and composites have `None`: no published source was found.
    pub fn published_loss(&self) -> Option<f64> {
        let metal = self.density > GLASS && self.hoop_modulus.is_none();
        BUILT_IN.iter().filter(|_| metal).find_map(|built_in| built_in.loss_factor)
    }

    /// Poisson's ratio for κ: the material's own; for a composite that of the plane of its wall; else 0.3.
    pub fn poisson(&self) -> f64 {
        let of_wall = self.poisson_ratios.map(|ratios| ratios.along_around);
        self.poisson_ratio.or(of_wall).unwrap_or(0.3)
    }

    /// Timoshenko's shear coefficient of a ring whose `(r_i/r)²` is `hole`: the material's own, else Cowper's
    /// `κ = 6(1+ν)(1+m²)² / [(7+6ν)(1+m²)² + (20+12ν)m²]` with `m = r_i/r`. An unknown ν is taken as 0.3, and never
    /// computed from E/G, which means nothing for wood.
    ///
    /// # Source
    ///
    /// G. R. Cowper, J. Appl. Mech. 33 (1966) 335.
    pub fn kappa(&self, hole: f64) -> f64 {
        self.shear_coefficient.unwrap_or_else(|| {
            let nu = self.poisson();
            let square = (1.0 + hole).powi(2);
            6.0 * (1.0 + nu) * square / ((7.0 + 6.0 * nu) * square + (20.0 + 12.0 * nu) * hole)
        })
    }

    /// Derivative of [`Self::kappa`] by `hole`: 0 if the material has its own κ, else that of Cowper's. With
    /// `a = 7 + 6ν`, `b = 20 + 12ν` and `h` the hole, `dκ/dh = −6 (1 + ν) b (1 − h²) / [a (1 + h)² + b h]²`.
    pub fn kappa_slope(&self, hole: f64) -> f64 {
        if self.shear_coefficient.is_some() {
            return 0.0;
        }
        let nu = self.poisson();
        let (a, b) = (7.0 + 6.0 * nu, 20.0 + 12.0 * nu);
        let below = a * (1.0 + hole).powi(2) + b * hole;
        -6.0 * (1.0 + nu) * b * (1.0 - hole * hole) / (below * below)
    }

    /// The largest |κ| for `r²` and `r_i²` in these boxes; `None` if it has a pole there.
    pub(crate) fn kappa_around(&self, outer: Rectangle, inner: Rectangle) -> Option<f64> {
        if let Some(kappa) = self.shear_coefficient {
            return Some(kappa);
        }
        let nu = self.poisson();
        let square = (outer + inner).square();
        let number = Rectangle::point;
        let below = number(7.0 + 6.0 * nu) * square + number(20.0 + 12.0 * nu) * outer * inner;
        let least = below.modulus().low;
        (least > 0.0).then(|| 6.0 * (1.0 + nu) * square.modulus().high / least)
    }

    /// The built-in material of that name.
    ///
    /// ```
    /// use sweetspot::Material;
    ///
    /// let ash = Material::named("white-ash-dynamic").expect("it is built in");
    /// assert!(ash.shear_modulus.is_some() && Material::named("willow").is_none());
    /// ```
    pub fn named(name: &str) -> Option<Self> {
        BUILT_IN.iter().find(|m| m.name == name).map(|m| Self {
            name: Some(m.name.to_owned()),
            shear_modulus: m.shear_modulus,
            strength: m.strength,
            strain_to_failure: m.strain_to_failure,
            ..Self::unchecked(m.density, m.youngs_modulus)
        })
    }
}

/// How much a kind of material differs from piece to piece, as relative standard deviations.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Scatter {
    /// Of Young's modulus, and equally of G.
    pub youngs_modulus: f64,
    /// Of the density.
    pub density: f64,
}

/// Densities (kg/m³) and Young's moduli (Pa) along the grain by which a material is taken for wood. No other material of
/// bats is as light. The range of moduli is wide, because a mistaken stiffness does not make the density better known.
const WOOD: [[f64; 2]; 2] = [[300.0, 1100.0], [1e9, 60e9]];

impl Material {
    /// The published scatter from piece to piece of small clear pieces of one species of wood: 22 % of Young's modulus
    /// and 10 % of the density. A material as heavy and as stiff as wood along the grain counts as wood. Any other has
    /// `None`: no published scatter of aluminium alloys and composites is known here.
    ///
    /// # Source
    ///
    /// Wood Handbook FPL-GTR-282, chapter 5, coefficients of variation of clear wood; ASTM D2555-06,
    /// tables of standard deviations, in transcription (baldcypress: E 1184 ± 260 ksi, specific gravity
    /// 0.43 ± 0.043).
    pub fn scatter(&self) -> Option<Scatter> {
        let [densities, moduli] = WOOD.map(|[low, high]| low..=high);
        let wood = densities.contains(&self.density) && moduli.contains(&self.youngs_modulus);
        wood.then_some(Scatter { youngs_modulus: 0.22, density: 0.10 })
    }
}

/// Density of glass fibre in resin (kg/m³).
const GLASS: f64 = 2200.0;
/// Metals are denser than this (kg/m³), and their stiffness over density (m²/s²) is within these limits.
const METAL: f64 = 1700.0;
const OF_METALS: [f64; 2] = [20e6, 30e6];

impl Material {
    /// How much a material differs: wood from piece to piece, as [`Self::scatter`] says; a metal from alloy to alloy,
    /// by 2 % of Young's modulus and 1 % of the density. `None` if neither is known, as for a composite.
    ///
    /// Magnesium, aluminium, titanium and steel all have a stiffness over density of about 25e6 m²/s², which identifies
    /// a metal.
    ///
    /// # Source
    ///
    /// The entry of the built-in aluminium (`BUILT_IN`): other alloys of its kind differ by 1 to 2 %.
    pub fn differs(&self) -> Option<Scatter> {
        let metal = Scatter { youngs_modulus: 0.02, density: 0.01 };
        self.scatter().or(self.is_metal().then_some(metal))
    }

    /// A warning about a density that fits no material of this stiffness. Either it is as light as wood and as stiff as
    /// a metal, as when a hollow bat is taken for a solid one, or it is heavier than glass fibre and softer for its
    /// weight than any metal of bats.
    pub(crate) fn no_material(&self) -> Option<String> {
        /// Density of the heaviest woods (kg/m³).
        const WOODS: f64 = 1200.0;
        let (density, modulus) = (self.density, self.youngs_modulus);
        let told = |hint: &str| {
            let [density, modulus] = [density, 1e-9 * modulus].map(|v| significant(v, 4));
            Some(format!("{density} kg/m³ with {modulus} GPa is no material of bats ({hint}"))
        };
        match density {
            d if d < WOODS && modulus > 30e9 => told(
                "aluminium: 2810, 71.7): is the bat hollow? its wall goes into the file: \"wall_thickness\" in \
                 \"profile\"",
            ),
            d if d > WOODS && d < GLASS && modulus < 8e6 * d => {
                told("wood: 400 to 900, 8 to 20): is the mass, a diameter or a unit off?")
            }
            d if d > GLASS && !(OF_METALS[0]..=OF_METALS[1]).contains(&(modulus / d)) => {
                told("aluminium: 2810, 71.7): is the wall thicker, or are parts not in the file?")
            }
            _ => None,
        }
    }

    /// Whether its density and stiffness are those of a metal that bats are made of.
    pub fn is_metal(&self) -> bool {
        let [low, high] = OF_METALS;
        let specific = self.youngs_modulus / self.density;
        self.hoop_modulus.is_none() && self.density > METAL && (low..=high).contains(&specific)
    }
}

/// One entry of the built-in list: SI values and where they come from.
#[derive(Debug, Clone, Copy, Deserialize)]
pub struct BuiltIn {
    /// Name in a bat file.
    pub name: &'static str,
    /// ρ (kg/m³).
    pub density: f64,
    /// E (Pa).
    pub youngs_modulus: f64,
    /// G (Pa), if known.
    pub shear_modulus: Option<f64>,
    /// Stress at which it breaks in bending (Pa), if known.
    pub strength: Option<f64>,
    /// Loss factor η in bending, if known.
    pub loss_factor: Option<f64>,
    /// Strain at which it breaks in a blow, if known.
    pub strain_to_failure: Option<f64>,
    /// Where strength and strain to failure come from; empty where neither is known.
    #[serde(default)]
    pub strength_source: &'static str,
    /// Where the values come from.
    pub source: &'static str,
}

/// The built-in materials.
///
/// Handbook values come from slow bending tests of small clear pieces at 12 % moisture. E is at a span of 14 depths, so
/// it contains some shear; G is the mean of the two longitudinal planes; the density is 1.12 times the specific
/// gravity. The `-dynamic` materials are 20 to 50 % stiffer: models of real bats need them to ring or break as
/// measured. Two separate names keep the two kinds from being mixed unawares.
///
/// A strength is the modulus of rupture of small clear pieces at 12 % moisture, bent slowly until they break: the mean
/// of a species. A strain to failure belongs to blows as fast as a hit.
///
/// # Source
///
/// Each entry of `materials.json` names its source. Its numbers are in SI: strengths in psi were multiplied by
/// 6894.757293168361 Pa, and the shear modulus of aluminium is E/(2 (1 + ν)).
pub static BUILT_IN: LazyLock<Vec<BuiltIn>> = LazyLock::new(|| {
    serde_json::from_str(include_str!("materials.json")).expect("the list of built-in materials")
});

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_built_in_material_is_possible_and_found_by_its_name() {
        for built_in in BUILT_IN.iter() {
            let material = Material::named(built_in.name).expect(built_in.name);
            material.check().expect(built_in.name);
            assert!(!built_in.source.is_empty());
            let known = built_in.strength.is_some() || built_in.strain_to_failure.is_some();
            assert_eq!(known, !built_in.strength_source.is_empty(), "{}", built_in.name);
        }
        assert_eq!(Material::named("cork"), None);
    }

    #[test]
    fn every_wood_that_is_built_in_is_taken_for_wood_and_nothing_else_is() {
        for built_in in BUILT_IN.iter() {
            let material = Material::named(built_in.name).expect(built_in.name);
            let wood = !built_in.name.starts_with("aluminium");
            assert_eq!(material.scatter().is_some(), wood, "{}", built_in.name);
            assert_eq!(material.is_metal(), !wood, "{}", built_in.name);
            assert!(material.differs().is_some(), "{}", built_in.name);
        }
        for (density, modulus) in [(200.0, 20e6), (1550.0, 50e9), (2810.0, 71.7e9)] {
            assert_eq!(Material::new(density, modulus).unwrap().scatter(), None, "{density}");
        }
        for (density, modulus) in [(200.0, 20e6), (1550.0, 50e9), (4793.91, 49.98e9)] {
            assert_eq!(Material::new(density, modulus).unwrap().differs(), None, "{density}");
        }
    }

    #[test]
    fn impossible_values_are_named() {
        for (density, modulus) in
            [(0.0, 1e10), (-1.0, 1e10), (f64::NAN, 1e10), (600.0, f64::INFINITY)]
        {
            assert!(Material::new(density, modulus).is_err(), "{density} {modulus}");
        }
    }
}
