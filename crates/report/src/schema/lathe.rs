//! The document of a lathe map, `sweetspot-lathe/1`. This type is written, and the schema derives from it.

use schemars::JsonSchema;
use serde::Serialize;

use crate::schema::hit::Scene;
use sweetspot::bat::edit::Edit;
use sweetspot::files::schema::document::{Document, Format, Generator};
use sweetspot_study::lathe::found::LatheFound;

/// How cuts and weights change a bat. SI units, named at the end of each member; positions count from the knob end; a
/// value that does not exist is null. Changes of bands are per millimetre of diameter removed. Later versions with the
/// same number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "Lathe file of sweetspot, sweetspot-lathe/1")]
pub struct LatheFile {
    /// Name of the format and its version: sweetspot-lathe/1.
    pub format: Format<LatheFile>,
    /// The program that wrote the file.
    pub generator: Generator,
    /// Name of the bat.
    pub bat_name: String,
    /// Changes made to the bat before; left out where there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub edits: Vec<Edit>,
    /// The collision model: how the bending of the bat is treated in hits.
    #[schemars(extend("enum" = ["rigid", "energy-loss", "pulse", "contact"]))]
    pub model: String,
    /// The swing and the ball.
    pub scene: Scene,
    /// The beam theory of the modes.
    #[schemars(extend("enum" = ["euler-bernoulli", "rayleigh", "timoshenko"]))]
    pub theory: String,
    /// The results.
    #[serde(flatten)]
    pub found: LatheFound,
}

impl Document for LatheFile {
    const NAME: &'static str = "lathe";
}
