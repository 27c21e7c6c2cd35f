//! The wood of a bat by its measurements, `sweetspot-calibrate/1`.

use schemars::JsonSchema;
use serde::Serialize;

use sweetspot::files::schema::document::{BatName, Document, Format, Generator};
use sweetspot_study::calibrate::calibration::Calibration;

/// The wood of a bat by the measurements, and how well they determine it. SI units, named at the end of each member;
/// positions count from the knob end; a value that does not exist is null. Later versions with the same number may have
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
    /// The results.
    #[serde(flatten)]
    pub found: Calibration,
    /// The measurement to make next, in words.
    pub advice: String,
    /// All results in sentences.
    pub words: Vec<String>,
}

impl Document for CalibrateFile {
    const NAME: &'static str = "calibrate";
}
