//! The document of a lathe map, `sweetspot-lathe/1`: what is written is this type, and so is its schema.

use schemars::JsonSchema;
use serde::Serialize;

use crate::schema::hit::Scene;
use sweetspot::bat::edit::Edit;
use sweetspot::files::schema::document::{Document, Format, Generator};
use sweetspot_study::lathe::found::LatheFound;

/// What cuts and weights do to a bat. SI, the unit in every output's name; positions count from the knob end;
/// what does not exist is null. Changes of bands are per millimetre of diameter taken off. Later versions of the
/// same number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "Lathe file of sweetspot, sweetspot-lathe/1")]
pub struct LatheFile {
    /// Name of the format and its version: sweetspot-lathe/1.
    pub format: Format<LatheFile>,
    /// The program that wrote the file.
    pub generator: Generator,
    /// What the bat is called.
    pub bat_name: String,
    /// What was changed about the bat before; left out where nothing was.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub edits: Vec<Edit>,
    /// How the bat's bending is counted in hits.
    #[schemars(extend("enum" = ["rigid", "energy-loss", "pulse", "contact"]))]
    pub model: String,
    /// How the bat is swung, and what ball it meets.
    pub scene: Scene,
    /// The beam theory of the modes.
    #[schemars(extend("enum" = ["euler-bernoulli", "rayleigh", "timoshenko"]))]
    pub theory: String,
    /// What was found.
    #[serde(flatten)]
    pub found: LatheFound,
}

impl Document for LatheFile {
    const NAME: &'static str = "lathe";
}
