//! The folder of the answers of a study, `sweetspot-study-manifest/1`.

use schemars::JsonSchema;
use serde::Serialize;

use sweetspot::files::schema::document::{Document, Format, Generator};

/// Description of the parts in a folder: the study and its files, the program that made them, the columns, and the
/// number of rows.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "Manifest of a study of sweetspot, sweetspot-study-manifest/1")]
pub struct StudyManifest {
    /// Name of the format and its version: sweetspot-study-manifest/1.
    pub format: Format<StudyManifest>,
    /// The program that made the parts.
    pub generator: Generator,
    /// Processor and system that it ran on: others may differ in the last digits.
    pub target: String,
    /// Every file that was read, the study first.
    pub files: Vec<FileRead>,
    /// The columns of every part, in their order.
    pub columns: Vec<ColumnNamed>,
    /// Number of rows.
    pub rows: u64,
    /// Rows of every part but the last.
    pub rows_per_part: u64,
    /// Number of parts: part-000000.csv and so on.
    pub parts: u64,
}

impl Document for StudyManifest {
    const NAME: &'static str = "study-manifest";
}

/// A file that a study was made from.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct FileRead {
    /// Its name.
    pub name: String,
    /// A number that changes with its text, 16 hexadecimal digits.
    pub hash: String,
}

/// A column of the parts.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ColumnNamed {
    /// Its name.
    pub name: String,
    /// Its unit; empty for numbers without one, for bare numbers of the study and for texts.
    pub unit: String,
}
