//! The error of frequencies against the number of elements, `sweetspot-u-curve/1`.

use schemars::JsonSchema;
use serde::Serialize;

use sweetspot::bat::theory::Theory;
use sweetspot::files::schema::document::{BatName, Document, Format, Generator};

/// The error of a bat's frequencies against the number of cubic elements, solver by solver: more
/// elements first help and then hurt. Errors are relative, times in s; what does not exist is null.
/// Later versions of the same number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "U-curve file of sweetspot, sweetspot-u-curve/1")]
pub struct UCurveFile {
    /// Name of the format and its version: sweetspot-u-curve/1.
    pub format: Format<UCurveFile>,
    /// The program that wrote the file.
    pub generator: Generator,
    /// The bat.
    pub bat: BatName,
    /// Number of modes.
    pub modes: usize,
    /// Degree of the elements' deflection.
    pub degree: usize,
    /// What the errors are measured against.
    pub reference: Reference,
    /// A column for each solver.
    pub columns: Vec<Column>,
}

impl Document for UCurveFile {
    const NAME: &'static str = "u-curve";
}

/// A mesh and the solver for it.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Choice {
    /// Degree of the elements' deflection.
    pub degree: usize,
    /// Number of elements.
    pub elements: usize,
    /// How the eigenvalues are found.
    #[schemars(extend("enum" = ["statics", "dense", "shift-invert", "arpack"]))]
    pub solver: &'static str,
    /// Unknowns of the assembled matrices.
    pub degrees_of_freedom: usize,
}

/// The frequencies everything is measured against, and how far they may be trusted.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Reference {
    /// How they were found.
    #[serde(flatten)]
    pub choice: Choice,
    /// Beam theory.
    #[schemars(extend("enum" = Theory::ALL.map(Theory::name)))]
    pub theory: &'static str,
    /// Frequency of each mode (Hz).
    pub frequencies_hz: Vec<f64>,
    /// Largest error of a frequency by the solution's own estimate.
    pub stated_error: f64,
    /// Smaller errors cannot be told from none.
    pub floor: f64,
    /// Another discretisation, solved for confirmation.
    pub confirmed_by: Confirmation,
}

/// Another discretisation.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Confirmation {
    /// Its mesh and its solver.
    #[serde(flatten)]
    pub choice: Choice,
    /// Largest difference of a frequency from the reference.
    pub agreement: f64,
}

/// The errors of one solver.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Column {
    /// How the eigenvalues are found.
    #[schemars(extend("enum" = ["statics", "dense", "shift-invert", "arpack"]))]
    pub solver: &'static str,
    /// Points by rising number of elements.
    pub points: Vec<Point>,
    /// Why the column ends early; null if it has as many points as were asked for.
    pub end: Option<End>,
    /// Where the solver's own eigenvalue of mode 1 is lost; null if it has none.
    pub own_lost_at: Option<Losses>,
    /// Where the frequency recomputed from the shape of mode 1 is lost.
    pub recomputed_lost_at: Option<Losses>,
}

/// The errors at one number of elements.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Point {
    /// Number of elements.
    pub elements: usize,
    /// Time from assembly to frequencies (s).
    pub seconds: f64,
    /// Error of each frequency as the solver's own eigenvalue says it; null where it has no other.
    pub own_error_by_mode: Option<Vec<f64>>,
    /// Error of each frequency as strain energy over kinetic energy of the shape.
    pub recomputed_error_by_mode: Vec<f64>,
}

/// Why a column ends.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct End {
    /// The number of elements that was not reached.
    pub elements: usize,
    /// The solver's error, "too large" or "no time".
    pub reason: String,
}

/// Numbers of elements at which a frequency is lost; null where it is not.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Losses {
    /// The number of elements with the least error.
    pub best_elements: usize,
    /// That least error.
    pub least_error: f64,
    /// The first number beyond the best at which 8 digits are left.
    #[serde(rename = "error_1e-8")]
    pub eight_digits: Option<usize>,
    /// The first number beyond the best at which 4 digits are left.
    #[serde(rename = "error_1e-4")]
    pub four_digits: Option<usize>,
    /// The first number beyond the best at which nothing is left.
    #[serde(rename = "error_1")]
    pub nothing: Option<usize>,
}
