//! Speed against accuracy, `sweetspot-trade/1`.

use schemars::JsonSchema;
use serde::Serialize;

use crate::schema::u_curve::{Choice, Column, Reference};
use sweetspot::files::schema::document::{BatName, Document, Format, Generator};

/// How accurate a bat's frequencies are for the time they take, measured on many meshes and solvers.
/// Errors are relative, times in s; what does not exist is null. Later versions of the same number may
/// have more members.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "Trade file of sweetspot, sweetspot-trade/1")]
pub struct TradeFile {
    /// Name of the format and its version: sweetspot-trade/1.
    pub format: Format<TradeFile>,
    /// The program that wrote the file.
    pub generator: Generator,
    /// The bat.
    pub bat: BatName,
    /// Number of modes.
    pub modes: usize,
    /// What the errors are measured against.
    pub reference: Reference,
    /// Every run, fastest first.
    pub runs: Vec<Run>,
    /// The runs that the planner chose, for the largest tolerance first.
    pub planner: Vec<Run>,
    /// Error against the number of cubic elements, as far as there was time.
    pub more_elements: Vec<Column>,
    /// What follows, in sentences.
    pub words: Vec<String>,
}

impl Document for TradeFile {
    const NAME: &'static str = "trade";
}

/// One mesh and solver, timed.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Run {
    /// The mesh and the solver.
    #[serde(flatten)]
    pub choice: Choice,
    /// Median time of the repeats (s).
    pub seconds: f64,
    /// How often it was timed.
    pub repeats: usize,
    /// Largest true error of a frequency.
    pub error: f64,
    /// True error of each frequency.
    pub error_by_mode: Vec<f64>,
    /// Largest error of a frequency by the solution's own estimate.
    pub stated_error: f64,
    /// The tolerance for which the planner chose this; null for a mesh of the ladder.
    pub planned_for: Option<f64>,
    /// Whether no other run is both faster and more accurate.
    pub on_front: bool,
}
