//! The document of a BBCOR test, `sweetspot-bbcor/1`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use sweetspot::bat::edit::Edit;
use sweetspot::collision::bbcor::{Scan, Tested};
use sweetspot::files::schema::document::{Document, Format, Generator};
use sweetspot_study::ignored;

/// BBCOR along a bat as laboratories measure it, the bat at rest on a pivot: computed, and no
/// certificate. SI, the unit in every name; positions count from the knob end; what does not exist is
/// null. Later versions of the same number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(title = "BBCOR file of sweetspot, sweetspot-bbcor/1")]
pub struct BbcorFile {
    /// Name of the format and its version: sweetspot-bbcor/1.
    pub format: Format<BbcorFile>,
    /// The program that wrote the file.
    pub generator: Generator,
    /// What the bat is called.
    pub bat_name: String,
    /// What was changed about the bat after it was weighed; left out where nothing was.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub edits: Vec<Edit>,
    /// What was done and found.
    #[serde(flatten)]
    pub scan: Scan,
    /// Effects that were left out, and what they do.
    pub ignored: Vec<String>,
}

impl Document for BbcorFile {
    const NAME: &'static str = "bbcor";
}

impl BbcorFile {
    /// The document of that test.
    pub fn of(tested: &Tested) -> Self {
        Self {
            format: Format::new(),
            generator: Generator::this(),
            bat_name: tested.bat.name().to_owned(),
            edits: tested.bat.edits().to_vec(),
            scan: tested.scan.clone(),
            ignored: ignored::in_hit(&tested.bat, &tested.scene),
        }
    }
}
