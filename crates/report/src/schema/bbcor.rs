//! The document of a BBCOR test, `sweetspot-bbcor/1`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use sweetspot::bat::edit::Edit;
use sweetspot::collision::bbcor::{Scan, Tested};
use sweetspot::files::schema::document::{Document, Format, Generator};
use sweetspot_study::ignored;

/// BBCOR along a bat as laboratories measure it, with the bat at rest on a pivot. It is computed and is no certificate.
/// SI units, named at the end of each member; positions count from the knob end; a value that does not exist is null.
/// Later versions with the same number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(title = "BBCOR file of sweetspot, sweetspot-bbcor/1")]
pub struct BbcorFile {
    /// Name of the format and its version: sweetspot-bbcor/1.
    pub format: Format<BbcorFile>,
    /// The program that wrote the file.
    pub generator: Generator,
    /// Name of the bat.
    pub bat_name: String,
    /// Changes made to the bat after it was weighed; left out where there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub edits: Vec<Edit>,
    /// Settings and results of the scan.
    #[serde(flatten)]
    pub scan: Scan,
    /// Neglected effects and their consequences.
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
