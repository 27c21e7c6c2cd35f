//! What a bat's wood is, `sweetspot-calibrate/1`.

use schemars::JsonSchema;
use serde::Serialize;

use sweetspot::files::schema::document::{BatName, Document, Format, Generator};
use sweetspot_study::calibrate::calibration::Calibration;

/// What a bat's wood is by what was measured of it, and how much of that the readings say. SI, the unit in every
/// name; positions count from the knob end; what does not exist is null. Later versions of the same number may have
/// more members.
#[derive(Debug, Clone, Serialize, JsonSchema)]
#[schemars(title = "Calibration of sweetspot, sweetspot-calibrate/1")]
pub struct CalibrateFile {
    /// Name of the format and its version: sweetspot-calibrate/1.
    pub format: Format<CalibrateFile>,
    /// The program that wrote the file.
    pub generator: Generator,
    /// The bat.
    pub bat: BatName,
    /// What was found.
    #[serde(flatten)]
    pub found: Calibration,
    /// What to measure next, in words.
    pub advice: String,
    /// All of it in sentences.
    pub words: Vec<String>,
}

impl Document for CalibrateFile {
    const NAME: &'static str = "calibrate";
}
