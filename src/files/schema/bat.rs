//! The form of a bat file, `sweetspot-bat/1`, for its schema.
//!
//! What stands in such a file is read by [`crate::Bat::from_file`], which tells line and column of
//! what is wrong; these types say the same to editors and to programs that check a file without
//! reading it. What one value means for another (stations that rise, places on the bat, walls that
//! are there) a schema does not say.

use schemars::JsonSchema;
use schemars::generate::Contract;
use serde_json::{Value, json};

use crate::base::units::Quantity;
use crate::bat::fixtures::{Absorber, Attachment, Grip, Joint, Region, Support, Tape};
use crate::bat::profile::Interpolation;
use crate::bat::weighed::Weighed;
use crate::files::schema::amount::{Amount, Measures, column};
use crate::files::schema::document::{Document, Format};
use crate::files::schema::part::{self, Comment, EditInFile, InFile, Material};
use crate::files::schema::resolved::End;
use crate::files::station_table::COLUMNS;

/// A baseball bat: its shape, what it is made of, what is on it and what holds it. A bare number is
/// SI, a text carries its unit. Positions count from the knob end.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(title = "Bat file of sweetspot, sweetspot-bat/1", deny_unknown_fields)]
#[schemars(extend("allOf" = [
    without("density", "mass"),
    without("youngs_modulus", "first_bending_hz"),
]))]
pub struct BatFile {
    /// Where this schema is, for editors.
    #[serde(rename = "$schema")]
    pub schema: Option<String>,
    /// Name of the format and its version: sweetspot-bat/1.
    pub format: Format<BatFile>,
    /// A remark for people, which programs pass over.
    pub comment: Option<Comment>,
    /// What the bat is called in tables and plots.
    #[schemars(example = &"Ash dowel, 33 in")]
    pub name: Option<String>,
    /// Where these numbers come from.
    pub source: Option<String>,
    /// What the bat is made of where no region says otherwise. Density and Young's modulus may be
    /// left to what was weighed and tapped.
    pub material: Material,
    /// Outer and inner radius along the bat, as columns of stations or as formulas.
    pub profile: Profile,
    /// What a scale and a tap said of the bat. The mass sets one factor on all densities, the frequency
    /// one on all moduli; the balance point is compared.
    pub weighed: Option<InFile<Weighed>>,
    /// Stretches of other materials, which do not overlap.
    pub regions: Option<Vec<InFile<Region>>>,
    /// Weights and springs to ground.
    pub attachments: Option<Vec<InFile<Attachment>>>,
    /// Bat tape: mass without stiffness.
    pub tapes: Option<Vec<InFile<Tape>>>,
    /// Masses that hang on springs.
    pub absorbers: Option<Vec<InFile<Absorber>>>,
    /// Places that give way to bending, one joint at one place.
    pub joints: Option<Vec<InFile<Joint>>>,
    /// Places that are held, one support at one place; without supports the bat is free.
    pub supports: Option<Vec<InFile<Support>>>,
    /// Hands that hold the bat as an elastic bed.
    pub grip: Option<InFile<Grip>>,
    /// What is changed about the bat after it was weighed and tapped, one edit after the other. Places
    /// are those of the bat as it is when the edit comes to it.
    pub edits: Option<Vec<EditInFile>>,
}

impl Document for BatFile {
    const NAME: &'static str = "bat";
    const CONTRACT: Contract = Contract::Deserialize;
}

/// Either the material has that number or something that was measured stands in for it, which is
/// one factor and so cannot be had beside regions.
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
    /// A remark for people, which programs pass over.
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
    /// Positions of the stations, rising from 0. Equal neighbours mark a step: the value to its
    /// left, then the value to its right.
    #[schemars(transform = column, extend("allOf" = [{ "prefixItems": [{ "maximum": 0 }] }]))]
    pub x: Option<Vec<Amount>>,
    /// Outer radius at each station; 0 at most at an end of the bat.
    #[schemars(transform = column)]
    pub radius: Option<Vec<Amount>>,
    /// Outer diameter at each station, in place of the radius.
    #[schemars(transform = column)]
    pub diameter: Option<Vec<Amount>>,
    /// Radius of the bore at each station. Without any of the three the bat is solid.
    #[schemars(transform = column)]
    pub inner_radius: Option<Vec<Amount>>,
    /// Diameter of the bore at each station.
    #[schemars(transform = column)]
    pub inner_diameter: Option<Vec<Amount>>,
    /// Thickness of the wall at each station; as much as the radius is solid.
    #[schemars(transform = column)]
    pub wall_thickness: Option<Vec<Amount>>,
    /// A CSV file with the columns instead, sought from the folder of this file. Its header names
    /// them with their units, as in x_in,diameter_in; lines that begin with # are comments.
    #[schemars(example = &"profile.csv")]
    pub csv: Option<String>,
    /// Formulas instead, touching end to end from 0; a jump between two is a step.
    #[schemars(length(min = 1))]
    pub pieces: Option<Vec<Piece>>,
}

/// None of these members may be there.
fn nothing_of(keys: &[&str]) -> Value {
    keys.iter().map(|key| ((*key).to_owned(), json!(false))).collect()
}

/// A stretch of the bat whose radii are formulas.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Piece {
    /// A remark for people, which programs pass over.
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
