//! The form of a material in a bat file, and of a remark, for its schema.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde_json::{Value, json};

use crate::base::units::Quantity;
use crate::bat::material::{BUILT_IN, BuiltIn};
use crate::files::schema::amount::{Amount, Measures};

/// A remark for people: a text or a list of texts, which programs pass over.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(untagged)]
pub enum Comment {
    /// One text.
    Text(String),
    /// A text for each line.
    Lines(Vec<String>),
}

/// A material: the name of a built-in one, or its numbers, along the axis where it is wood.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(untagged)]
pub enum Material {
    /// The name of a built-in material.
    Named(#[schemars(schema_with = "names")] String),
    /// The numbers of a material of your own.
    Numbers(MaterialNumbers),
}

/// The built-in materials, each with where its numbers come from.
fn names(_: &mut SchemaGenerator) -> Schema {
    let name = |known: &BuiltIn| json!({ "const": known.name, "description": known.source });
    json_schema!({
        "type": "string",
        "oneOf": BUILT_IN.iter().map(name).collect::<Vec<Value>>(),
    })
}

/// The numbers of a material, along the axis where it is wood. Density and Young's modulus may be
/// left out where something that was weighed or tapped stands in for them.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(deny_unknown_fields)]
#[schemars(extend("dependentRequired" = { "shear_modulus": ["youngs_modulus"] }))]
pub struct MaterialNumbers {
    /// A remark for people, which programs pass over.
    pub comment: Option<Comment>,
    /// Mass per volume.
    #[schemars(transform = Measures(Quantity::Density), extend("exclusiveMinimum" = 0))]
    pub density: Option<Amount>,
    /// Stiffness against bending and stretching along the axis.
    #[schemars(transform = Measures(Quantity::Pressure), extend("exclusiveMinimum" = 0))]
    pub youngs_modulus: Option<Amount>,
    /// Needed, or Poisson's ratio instead, for shear to count.
    #[schemars(transform = Measures(Quantity::Pressure), extend("exclusiveMinimum" = 0))]
    pub shear_modulus: Option<Amount>,
    /// Poisson's ratio.
    #[schemars(extend("exclusiveMinimum" = -1, "maximum" = 0.5), example = 0.33)]
    pub poisson_ratio: Option<f64>,
    /// Timoshenko's shear coefficient; Cowper's of the section without it.
    #[schemars(extend("exclusiveMinimum" = 0), example = 0.9)]
    pub shear_coefficient: Option<f64>,
    /// Loss factor: a mode's damping ratio is half of it.
    #[schemars(extend("minimum" = 0, "exclusiveMaximum" = 2, "default" = 0), example = 0.01)]
    pub loss_factor: Option<f64>,
    /// Stress at which it breaks in bending: of wood the modulus of rupture.
    #[schemars(transform = Measures(Quantity::Pressure), extend("exclusiveMinimum" = 0))]
    pub strength: Option<Amount>,
    /// Strain at which it breaks.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 1), example = 0.02)]
    pub strain_to_failure: Option<f64>,
}
