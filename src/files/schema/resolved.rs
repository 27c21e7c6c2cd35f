//! The bat in the documents that are written: as it was understood, in SI, defaults filled in.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::files::schema::document::{Document, Format};

/// The bat as it was understood: SI, defaults filled in, materials as they were weighed. A bat file
/// in its own right, of the same bat. Positions count from the knob end.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ResolvedBat {
    /// Name of the format and its version: sweetspot-bat/1.
    pub format: Format<ResolvedBat>,
    /// What the bat is called.
    pub name: String,
    /// Where the numbers of the bat come from.
    pub source: String,
    /// What the bat is made of where no region says otherwise.
    pub material: Material,
    /// Outer and inner radius along the bat.
    pub profile: Profile,
    /// Stretches of other materials.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub regions: Vec<Region>,
    /// Weights and springs to ground.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub attachments: Vec<Attachment>,
    /// Bat tape: mass without stiffness.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tapes: Vec<Tape>,
    /// Masses that hang on springs.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub absorbers: Vec<Absorber>,
    /// Places that give way to bending.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub joints: Vec<Joint>,
    /// Places that are held.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub supports: Vec<Support>,
    /// Hands that hold the bat as an elastic bed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub grip: Option<Grip>,
    /// Mass, balance point and first frequency as they were measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub weighed: Option<Weighed>,
}

impl Document for ResolvedBat {
    const NAME: &'static str = "bat";
}

/// A material, along the bat's axis where it is wood.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Material {
    /// Density (kg/m³).
    pub density: f64,
    /// Young's modulus (Pa).
    pub youngs_modulus: f64,
    /// Loss factor; a mode's damping ratio is half of it.
    pub loss_factor: f64,
    /// Shear modulus (Pa), if known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shear_modulus: Option<f64>,
    /// Poisson's ratio, if it was given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub poisson_ratio: Option<f64>,
    /// Timoshenko's shear coefficient, if it was given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shear_coefficient: Option<f64>,
    /// Stress at which it breaks in bending (Pa), if known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub strength: Option<f64>,
    /// Strain at which it breaks, if known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub strain_to_failure: Option<f64>,
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
    /// How the radius runs between stations.
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

/// How the radius runs between stations: a smooth curve without overshoot, or straight lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[schemars(inline)]
pub enum Interpolation {
    /// A smooth curve that does not overshoot.
    Pchip,
    /// A straight line from station to station.
    Linear,
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

/// A stretch of other materials.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Region {
    /// Where the region begins (m).
    pub from: f64,
    /// Where the region ends (m).
    pub to: f64,
    /// What the wall is made of.
    pub material: Material,
    /// What fills the bore.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub core: Option<Material>,
}

/// A point mass and springs to ground.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Attachment {
    /// Where the attachment is fixed (m).
    pub x: f64,
    /// Mass of the attachment (kg).
    pub mass: f64,
    /// Moment of inertia of the mass about its own centre (kg m²).
    pub rotary_inertia: f64,
    /// How far beyond `x`, towards the barrel, the centre of the mass is (m).
    pub offset: f64,
    /// Spring to ground against deflection (N/m).
    pub stiffness: f64,
    /// Spring to ground against rotation (N m/rad).
    pub rotational_stiffness: f64,
}

/// A mass spread evenly on a stretch.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Tape {
    /// Where the tape begins (m).
    pub from: f64,
    /// Where the tape ends (m).
    pub to: f64,
    /// Mass of the whole tape (kg).
    pub mass: f64,
}

/// A mass on a spring and a dashpot.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Absorber {
    /// Where the absorber hangs (m).
    pub x: f64,
    /// Mass that swings on the spring (kg).
    pub mass: f64,
    /// Stiffness of the spring (N/m).
    pub stiffness: f64,
    /// Damping of the dashpot (N s/m).
    pub damping: f64,
}

/// A place that gives way to bending.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Joint {
    /// Where the joint is (m).
    pub x: f64,
    /// Bending moment per angle between both sides (N m/rad).
    pub rotational_stiffness: f64,
}

/// A place that is held.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Support {
    /// Where the support is (m).
    pub x: f64,
    /// What the support holds.
    #[serde(rename = "type")]
    pub kind: Held,
}

/// What a support holds: the deflection, or the rotation too.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[schemars(inline)]
pub enum Held {
    /// The bat does not move at the support but may turn.
    Pinned,
    /// The bat neither moves nor turns at the support.
    Clamped,
}

/// Hands as an elastic bed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Grip {
    /// Where the hands begin (m).
    pub from: f64,
    /// Where the hands end (m).
    pub to: f64,
    /// Force per deflection and per length (N/m²).
    pub stiffness: f64,
    /// Force per velocity and per length (N s/m²).
    pub damping: f64,
}

/// What a scale and a tap said.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Weighed {
    /// Mass with everything attached (kg).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass: Option<f64>,
    /// Balance point from the knob end (m).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub balance_point: Option<f64>,
    /// First bending frequency (Hz).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub first_bending_hz: Option<f64>,
}
