//! The bat in output documents: as it was understood, in SI, with defaults filled in.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::bat::{Edit, Fixtures, Interpolation, Material, Weighed};
use crate::files::schema::document::{Document, Format};

/// The bat as it was understood: SI, defaults filled in, densities as weighed, edits listed. It is itself a valid bat
/// file of the same bat. Positions count from the knob end.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ResolvedBat {
    /// Name of the format and its version: sweetspot-bat/1.
    pub format: Format<ResolvedBat>,
    /// Name of the bat.
    pub name: String,
    /// Where the numbers of the bat come from.
    pub source: String,
    /// Material of the bat outside its regions.
    pub material: Material,
    /// Outer and inner radius along the bat.
    pub profile: Profile,
    /// Fixtures and supports.
    #[serde(flatten)]
    pub fixtures: Fixtures,
    /// Mass, balance point and first frequency as they were measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub weighed: Option<Weighed>,
    /// Changes of the bat that the other members describe, made after it was weighed, in order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub edits: Vec<Edit>,
}

impl Document for ResolvedBat {
    const NAME: &'static str = "bat";
}

/// Outer and inner radius along the bat.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Profile {
    /// Stations and the curve between them.
    Columns(Columns),
    /// Formulas.
    Pieces(Pieces),
}

/// Stations from the knob end.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Columns {
    /// How the radius runs between stations; "constant" of a bat file is written as linear with steps.
    pub interpolation: Interpolation,
    /// Unit of the columns: m.
    pub unit: String,
    /// Positions (m). Equal neighbours are a step: the value to its left, then to its right.
    pub x: Vec<f64>,
    /// Outer radius (m) at each position.
    pub radius: Vec<f64>,
    /// Radius of the bore (m); without it the bat is solid.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inner_radius: Option<Vec<f64>>,
}

/// Formulas, touching end to end.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Pieces {
    /// The end from which the formulas' `x` counts.
    pub measured_from: End,
    /// Formulas, one piece after the other.
    pub pieces: Vec<Piece>,
}

/// The end from which the formulas' `x` counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[schemars(inline)]
pub enum End {
    /// `x` counts from the knob end to the tip.
    Knob,
    /// `x` counts from the tip to the knob end.
    Tip,
}

/// A stretch whose radii are formulas.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Piece {
    /// Where the piece begins (m).
    pub from: f64,
    /// Where the piece ends (m).
    pub to: f64,
    /// Outer radius in m of x in m.
    pub formula: String,
    /// Inner radius in m of x in m; solid without it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inner_formula: Option<String>,
}
