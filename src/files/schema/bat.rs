//! The form of a bat file, `sweetspot-bat/1`, for its schema.
//!
//! [`crate::Bat::from_file`] reads such a file and reports its mistakes with line and column. These types describe the
//! same format to editors and to programs that check a file without reading it. A schema does not express how one value
//! limits another (rising stations, places on the bat, a positive wall).

use schemars::JsonSchema;
use schemars::generate::Contract;
use serde_json::{Value, json};

use crate::base::Quantity;
use crate::bat::{
    Absorber, Attachment, Grip, Interpolation, Joint, Region, Support, Tape, Weighed,
};
use crate::files::schema::amount::{Amount, Measures, column};
use crate::files::schema::document::{Document, Format};
use crate::files::schema::part::{self, Comment, EditInFile, InFile, Material};
use crate::files::schema::resolved::End;
use crate::files::station_table::COLUMNS;

/// A baseball bat: its shape, its materials, its fixtures and supports. A bare number is SI, a text carries its unit.
/// Positions count from the knob end.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(title = "Bat file of sweetspot, sweetspot-bat/1", deny_unknown_fields)]
#[schemars(extend("allOf" = [
    without("density", "mass"),
    without("youngs_modulus", "first_bending_hz"),
]))]
pub struct BatFile {
    /// Address of this schema, for editors.
    #[serde(rename = "$schema")]
    pub schema: Option<String>,
    /// Name of the format and its version: sweetspot-bat/1.
    pub format: Format<BatFile>,
    /// A remark for people, which programs ignore.
    pub comment: Option<Comment>,
    /// Name of the bat in tables and plots.
    #[schemars(example = &"Ash dowel, 33 in")]
    pub name: Option<String>,
    /// Where these numbers come from.
    pub source: Option<String>,
    /// Material of the bat outside its regions. Density and Young's modulus may be left to the weighed mass and the
    /// tapped frequency.
    pub material: Material,
    /// Outer and inner radius along the bat, as columns of stations or as formulas.
    pub profile: Profile,
    /// Results of weighing and tapping the bat. The mass sets one factor on all densities, the frequency one on all
    /// moduli; the balance point is compared.
    pub weighed: Option<InFile<Weighed>>,
    /// Stretches of other materials, which do not overlap.
    pub regions: Option<Vec<InFile<Region>>>,
    /// Weights and springs to ground.
    pub attachments: Option<Vec<InFile<Attachment>>>,
    /// Bat tape: mass without stiffness.
    pub tapes: Option<Vec<InFile<Tape>>>,
    /// Masses that hang on springs.
    pub absorbers: Option<Vec<InFile<Absorber>>>,
    /// Joints that are flexible in bending, one joint at one place.
    pub joints: Option<Vec<InFile<Joint>>>,
    /// Places that are held, one support at one place; without supports the bat is free.
    pub supports: Option<Vec<InFile<Support>>>,
    /// Hands that hold the bat as an elastic bed.
    pub grip: Option<InFile<Grip>>,
    /// Changes of the bat after it was weighed and tapped, one edit after the other. Places are those of the bat as it
    /// is before the edit.
    pub edits: Option<Vec<EditInFile>>,
}

impl Document for BatFile {
    const NAME: &'static str = "bat";
    const CONTRACT: Contract = Contract::Deserialize;
}

/// Either the material has that number, or a measured value replaces it. The measured value is a single factor and
/// therefore excludes regions.
fn without(number: &str, measured: &str) -> Value {
    json!({ "anyOf": [
        { "properties": { "material": part::with(&[number]) } },
        {
            "properties": { "weighed": { "required": [measured] }, "regions": false },
            "required": ["weighed"],
        },
    ] })
}

/// Outer and inner radius along the bat: columns of stations here or in a CSV file, or formulas.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(deny_unknown_fields)]
#[schemars(extend("oneOf" = [
    { "required": ["x", "radius"] },
    { "required": ["x", "diameter"] },
    { "required": ["csv"] },
    { "required": ["pieces"] },
]))]
#[schemars(extend("dependentSchemas" = {
    "csv": { "properties": nothing_of(&COLUMNS) },
    "pieces": { "properties": nothing_of(&[&COLUMNS[..], &["interpolation", "unit", "csv"]].concat()) },
    "inner_radius": { "properties": nothing_of(&["inner_diameter", "wall_thickness"]) },
    "inner_diameter": { "properties": nothing_of(&["wall_thickness"]) },
}))]
pub struct Profile {
    /// A remark for people, which programs ignore.
    pub comment: Option<Comment>,
    /// How the radius runs between stations: pchip (a smooth curve without overshoot), linear
    /// (straight lines) or constant (a station's value holds to the next; the last one closes).
    #[schemars(extend("default" = "pchip"))]
    pub interpolation: Option<Interpolation>,
    /// Unit of bare numbers in the columns.
    #[schemars(example = &"in", example = &"mm", extend("default" = "m"))]
    pub unit: Option<String>,
    /// The end from which `x` counts.
    #[schemars(extend("default" = "knob"))]
    pub measured_from: Option<End>,
    /// Positions of the stations, rising from 0. Equal neighbours mark a step: the value to its left, then the value to
    /// its right.
    #[schemars(transform = column, extend("allOf" = [{ "prefixItems": [{ "maximum": 0 }] }]))]
    pub x: Option<Vec<Amount>>,
    /// Outer radius at each station; 0 only at an end of the bat.
    #[schemars(transform = column)]
    pub radius: Option<Vec<Amount>>,
    /// Outer diameter at each station, in place of the radius.
    #[schemars(transform = column)]
    pub diameter: Option<Vec<Amount>>,
    /// Radius of the bore at each station. Without any of the three columns for the bore the bat is solid.
    #[schemars(transform = column)]
    pub inner_radius: Option<Vec<Amount>>,
    /// Diameter of the bore at each station.
    #[schemars(transform = column)]
    pub inner_diameter: Option<Vec<Amount>>,
    /// Thickness of the wall at each station; where it equals the radius, the bat is solid.
    #[schemars(transform = column)]
    pub wall_thickness: Option<Vec<Amount>>,
    /// A CSV file with the columns, looked up in the folder of this file. Its header names the columns with their
    /// units, as in x_in,diameter_in; lines that begin with # are comments.
    #[schemars(example = &"profile.csv")]
    pub csv: Option<String>,
    /// Formulas in place of columns; pieces follow each other from 0, and a jump between two is a step.
    #[schemars(length(min = 1))]
    pub pieces: Option<Vec<Piece>>,
}

/// Excludes all of these members.
fn nothing_of(keys: &[&str]) -> Value {
    keys.iter().map(|key| ((*key).to_owned(), json!(false))).collect()
}

/// A stretch of the bat whose radii are formulas.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Piece {
    /// A remark for people, which programs ignore.
    pub comment: Option<Comment>,
    /// Where the piece begins.
    #[schemars(transform = Measures(Quantity::Length), extend("minimum" = 0))]
    pub from: Amount,
    /// Where the piece ends.
    #[schemars(transform = Measures(Quantity::Length), extend("exclusiveMinimum" = 0))]
    pub to: Amount,
    /// Outer radius in m as a formula of x in m: + - * / ^ **, pi, sin cos tan exp log sqrt tanh abs
    /// min max.
    #[schemars(example = &"0.0125 + 0.02*x")]
    pub formula: String,
    /// Inner radius in m as a formula of x in m; solid without it.
    pub inner_formula: Option<String>,
}
