//! The bat that meets a wish, or comes nearest, `sweetspot-aimed/1`.

use schemars::JsonSchema;
use serde::Serialize;

use sweetspot::files::schema::document::{BatName, Document, Format, Generator};
use sweetspot::files::schema::resolved::ResolvedBat;
use sweetspot_study::aim::aimed::Outcome;
use sweetspot_study::aim::cuts::StationCut;

/// The least change of a bat that meets a wish, or comes nearest to it. Every value is of the bat as it is
/// written, with rounded stations. Places count from the knob end; what does not exist is null. Later versions
/// of the same number may have more members.
#[derive(Debug, Clone, Serialize, JsonSchema)]
#[schemars(title = "Aimed bat of sweetspot, sweetspot-aimed/1")]
pub struct AimedFile {
    /// Name of the format and its version: sweetspot-aimed/1.
    pub format: Format<AimedFile>,
    /// The program that wrote the file.
    pub generator: Generator,
    /// The bat as it was.
    pub bat: BatName,
    /// What came of the wish.
    #[serde(flatten)]
    pub outcome: Outcome,
    /// What changes, station by station: what to turn off, and where wood is added.
    pub cuts: Vec<StationCut>,
    /// What to know before the bat is turned, such as a barrel that a rule forbids; missing where there is nothing.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
    /// The new bat: a bat file in its own right.
    pub new_bat: ResolvedBat,
}

impl Document for AimedFile {
    const NAME: &'static str = "aimed";
}
