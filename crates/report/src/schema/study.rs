//! A study and the folder of its answers, `sweetspot-study/1` and `sweetspot-study-manifest/1`.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use schemars::generate::Contract;
use serde::Serialize;
use serde_json::Value;

use sweetspot::files::schema::amount::Amount;
use sweetspot::files::schema::document::{Document, Format, Generator};
use sweetspot::files::schema::part::Comment;

/// Outputs, as an example.
const OUTPUTS: [&str; 3] = ["f1_hz", "exit_speed_max.value", "exit_speed_m_s@0.70"];

/// Many bats: some that are or one that varies, how they are hit, and what is asked of each. Places count from
/// the knob end.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(title = "Study file of sweetspot, sweetspot-study/1", deny_unknown_fields)]
pub struct StudyForm {
    /// Where this schema is, for editors.
    #[schemars(rename = "$schema")]
    pub schema: Option<String>,
    /// Name of the format and its version: sweetspot-study/1.
    pub format: Format<StudyForm>,
    /// A remark for people, which programs pass over.
    pub comment: Option<Comment>,
    /// What the study is called.
    pub name: Option<String>,
    /// The bats: a bat file or a folder of them, from the study's folder, or the name of a built-in bat; one or a
    /// list.
    pub bat: Bats,
    /// The ball: a ball file, from the study's folder, or the name of a built-in ball. Without it a
    /// baseball.
    pub ball: Option<String>,
    /// How the bat is hit: the options of sweetspot hit, such as swing_speed, by their names.
    pub scene: Option<BTreeMap<String, Said>>,
    /// What varies, by its path: bat., ball. or scene. and the path in that document, such as
    /// bat.material.density. Lists are gone through in every combination; what is drawn shares one set of
    /// points. Without it each bat as it is.
    #[schemars(extend("minProperties" = 1))]
    pub vary: Option<BTreeMap<String, VariationForm>>,
    /// Triples of two paths that are drawn and the correlation of their normal scores.
    pub correlations: Option<Vec<(String, String, f64)>>,
    /// How points are spread. Without it sobol.
    #[schemars(extend("enum" = ["sobol", "latin-hypercube", "random"]))]
    pub design: Option<String>,
    /// Points drawn for each combination of the lists. Without it 1000.
    #[schemars(range(min = 1))]
    pub points: Option<u64>,
    /// Another seed draws other points. Without it 0.
    #[schemars(range(min = 0))]
    pub seed: Option<u64>,
    /// What is asked of every bat, by name.
    #[schemars(length(min = 1), example = OUTPUTS)]
    pub outputs: Vec<String>,
    /// Wanted accuracy of frequencies, relative, and of exit speeds, relative to the closing speed. Without it
    /// 1e-4.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 1))]
    pub tol: Option<f64>,
}

/// A member of the scene.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(untagged)]
pub enum Said {
    /// A number in SI, or a text with its unit.
    Amount(Amount),
    /// A word, such as the model.
    Word(#[schemars(regex(pattern = "^[a-z-]+$"))] String),
}

/// One bat or several.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(untagged)]
pub enum Bats {
    /// A file, a folder or a name.
    One(String),
    /// Some of them.
    Several(#[schemars(length(min = 1))] Vec<String>),
}

impl Document for StudyForm {
    const NAME: &'static str = "study";
    const CONTRACT: Contract = Contract::Deserialize;
}

/// How a member varies: one of these. Numbers of one way are all bare or all in the same unit.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(deny_unknown_fields, extend("minProperties" = 1, "maxProperties" = 1))]
pub struct VariationForm {
    /// These values, one after the other.
    #[schemars(length(min = 1))]
    pub values: Option<Vec<Value>>,
    /// From, to, and how many values at even distances.
    pub grid: Option<(Amount, Amount, u64)>,
    /// Every value between the two alike.
    pub uniform: Option<(Amount, Amount)>,
    /// Mean and standard deviation.
    pub normal: Option<(Amount, Amount)>,
    /// Median, and the standard deviation of the natural logarithm.
    pub lognormal: Option<(Amount, f64)>,
    /// The least value, the likeliest, the greatest.
    pub triangular: Option<(Amount, Amount, Amount)>,
}

/// What the parts in a folder are: of which study and which files, made by which program, with which columns,
/// and how many.
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
