//! How much bats of one model differ, `sweetspot-scatter-result/1`.

use schemars::JsonSchema;
use serde::Serialize;

use sweetspot::files::schema::document::{BatName, Document, Format, Generator};

/// How much bats of one model and swings of one batter differ. SI, the unit in every name; positions count from the knob
/// end; what does not exist is null. Later versions of the same number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "Result of a scatter of sweetspot, sweetspot-scatter-result/1")]
pub struct ScatterResult {
    /// Name of the format and its version: sweetspot-scatter-result/1.
    pub format: Format<ScatterResult>,
    /// The program that wrote the file.
    pub generator: Generator,
    /// The bat in the middle.
    pub bat: BatName,
    /// Rows that were drawn.
    pub points: u64,
    /// Which rows.
    pub seed: u64,
    /// Scrambles of Sobol's sequence that share them.
    pub scrambles: u64,
    /// Rows with all their answers.
    pub answered: usize,
    /// Rows as accurate as asked.
    pub met: usize,
    /// Why others have no answer, and how many.
    pub reasons: Vec<ReasonCounted>,
    /// Where the ball is hit in the middle (m); null where nothing is asked of it.
    pub impact_m: Option<f64>,
    /// What differs.
    pub inputs: Vec<InputSpread>,
    /// What was asked, how it is spread, and what spreads it.
    pub outputs: Vec<OutputResult>,
    /// All of it in sentences.
    pub words: Vec<String>,
}

impl Document for ScatterResult {
    const NAME: &'static str = "scatter-result";
}

/// Why rows have no answer.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ReasonCounted {
    /// Why.
    pub reason: String,
    /// How many rows.
    pub rows: usize,
}

/// Something that differs.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct InputSpread {
    /// Its name.
    pub name: String,
    /// Its standard deviation: of a logarithm, of a factor, or of an amount (m for turning and impact).
    pub sd: f64,
    /// Those before it that it goes with: it is meant with them known.
    pub given: Vec<String>,
}

/// An output.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct OutputResult {
    /// Its name.
    pub name: String,
    /// Its unit.
    pub unit: &'static str,
    /// The mean of all rows.
    pub mean: Option<f64>,
    /// The standard deviation of all rows.
    pub sd: Option<f64>,
    /// The percentiles.
    pub percentiles: Vec<PercentileResult>,
    /// What makes it vary; null where it does not or rows are too few.
    pub shares: Option<SharesResult>,
}

/// A percentile.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct PercentileResult {
    /// Which, in per cent.
    pub percent: f64,
    /// Its value.
    pub value: f64,
    /// Half of its 95 % interval, by what the scrambles differ.
    pub error: Option<f64>,
}

/// Shares of a variance, by a polynomial surface in what differs.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SharesResult {
    /// Degree of the surface.
    pub degree: usize,
    /// Rows that it was laid through.
    pub rows: usize,
    /// By each input alone (first order), in the order of the inputs.
    pub first: Vec<ShareResult>,
    /// By each input, alone and with others (total).
    pub total: Vec<ShareResult>,
    /// What the surface does not follow.
    pub unexplained: ShareResult,
}

/// A share of a variance.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct ShareResult {
    /// The share.
    pub value: f64,
    /// Standard deviation of what sampling leaves open.
    pub sd: f64,
}
