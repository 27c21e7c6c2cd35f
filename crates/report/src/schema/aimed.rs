//! The bat that meets a wish, or comes nearest, `sweetspot-aimed/1`.

use schemars::JsonSchema;
use serde::Serialize;

use sweetspot::files::schema::document::{BatName, Document, Format, Generator};
use sweetspot::files::schema::resolved::ResolvedBat;
use sweetspot_study::aim::aimed::Outcome;
use sweetspot_study::aim::cuts::StationCut;

/// The smallest change of a bat that meets a wish, or comes nearest to it. Every value belongs to the new bat as it is
/// written, with rounded stations. Positions count from the knob end; a value that does not exist is null. Later
/// versions with the same number may have more members.
#[derive(Debug, Clone, Serialize, JsonSchema)]
#[schemars(title = "Aimed bat of sweetspot, sweetspot-aimed/1")]
pub struct AimedFile {
    /// Name of the format and its version: sweetspot-aimed/1.
    pub format: Format<AimedFile>,
    /// The program that wrote the file.
    pub generator: Generator,
    /// The bat before the change.
    pub bat: BatName,
    /// Whether and how well the wish is met.
    #[serde(flatten)]
    pub outcome: Outcome,
    /// The change at each station: how much to turn off, and where wood is added.
    pub cuts: Vec<StationCut>,
    /// Warnings before the bat is turned, for example of a barrel that a rule forbids; left out where there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
    /// The new bat as a complete bat file.
    pub new_bat: ResolvedBat,
}

impl Document for AimedFile {
    const NAME: &'static str = "aimed";
}
