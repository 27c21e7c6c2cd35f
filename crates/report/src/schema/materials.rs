//! The list of built-in materials, `sweetspot-materials/1`.

use schemars::JsonSchema;
use serde::Serialize;

use crate::schema::{Written, document};
use sweetspot::bat::material::BUILT_IN;

/// The materials that a bat file may name, with the sources of their numbers. SI units, named at the end of each
/// member; an unknown value is null. Later versions with the same number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "Materials file of sweetspot, sweetspot-materials/1")]
pub struct MaterialsFile {
    /// The built-in materials.
    pub materials: Vec<Listed>,
}

document!(MaterialsFile, "materials");

/// A built-in material, along the axis where it is wood.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Listed {
    /// The name in bat files.
    pub name: &'static str,
    /// Density (kg/m³).
    pub density_kg_m3: f64,
    /// Young's modulus (Pa).
    pub youngs_modulus_pa: f64,
    /// Shear modulus (Pa), if known.
    pub shear_modulus_pa: Option<f64>,
    /// Stress at which it breaks in bending (Pa), if known.
    pub strength_pa: Option<f64>,
    /// Loss factor in bending, if known; it is used where damping is assumed, and in sounds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub loss_factor: Option<f64>,
    /// Strain at which it breaks in a blow, if known.
    pub strain_to_failure: Option<f64>,
    /// Source of strength and strain to failure; empty where neither is known.
    pub strength_source: &'static str,
    /// Source of the other numbers.
    pub source: &'static str,
}

impl MaterialsFile {
    /// All materials.
    pub fn built_in() -> Written<Self> {
        let materials = BUILT_IN.iter().map(|m| Listed {
            name: m.name,
            density_kg_m3: m.density,
            youngs_modulus_pa: m.youngs_modulus,
            shear_modulus_pa: m.shear_modulus,
            strength_pa: m.strength,
            loss_factor: m.loss_factor,
            strain_to_failure: m.strain_to_failure,
            strength_source: m.strength_source,
            source: m.source,
        });
        Written::of(Self { materials: materials.collect() })
    }
}
