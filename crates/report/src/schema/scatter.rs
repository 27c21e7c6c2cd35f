//! How much bats of one model differ, `sweetspot-scatter-result/1`.

use schemars::JsonSchema;
use serde::Serialize;

use sweetspot::files::schema::document::{BatName, Document, Format, Generator};
use sweetspot_study::scatter::scattered::Scattered;

/// How much bats of one model and swings of one batter differ. SI units, named at the end of each member; positions
/// count from the knob end; a value that does not exist is null. Later versions with the same number may have more
/// members.
#[derive(Debug, Clone, Serialize, JsonSchema)]
#[schemars(title = "Result of a scatter of sweetspot, sweetspot-scatter-result/1")]
pub struct ScatterResult {
    /// Name of the format and its version: sweetspot-scatter-result/1.
    pub format: Format<ScatterResult>,
    /// The program that wrote the file.
    pub generator: Generator,
    /// The bat in the middle.
    pub bat: BatName,
    /// The results.
    #[serde(flatten)]
    pub found: Scattered,
    /// All results in sentences.
    pub words: Vec<String>,
}

impl Document for ScatterResult {
    const NAME: &'static str = "scatter-result";
}
