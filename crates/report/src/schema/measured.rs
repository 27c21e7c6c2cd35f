//! Measured modes compared with computed ones, `sweetspot-measured/1`.

use schemars::JsonSchema;
use serde::Serialize;

use crate::schema::document;
use sweetspot::Theory;
use sweetspot::bat::edit::Edit;
use sweetspot_study::measured::study::Shapes;

/// The measured modes of a bat compared with the computed ones: which belong together, how far they differ, and how
/// similar their shapes are. SI units, named at the end of each member; positions count from the knob end; a value that
/// does not exist is null. Later versions with the same number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "Measured modes file of sweetspot, sweetspot-measured/1")]
pub struct MeasuredFile {
    /// The bat of the computed modes.
    pub bat: ComputedBat,
    /// The file of the measured modes.
    pub source: String,
    /// The assumptions made in reading it, one sentence each.
    pub assumed: Vec<String>,
    /// Measured modes, by rising frequency.
    pub measured: Vec<MeasuredMode>,
    /// Computed modes, by rising frequency.
    pub computed: Vec<ComputedMode>,
    /// A measured and a computed mode that are the same.
    pub pairs: Vec<Pair>,
    /// The least MAC of a pair.
    pub least_mac: f64,
    /// Names of the measured bending modes without a computed partner.
    pub unpaired_measured: Vec<String>,
    /// Numbers of the computed modes without a measured partner, up to the highest measured frequency.
    pub unpaired_computed: Vec<usize>,
    /// The conclusions in sentences.
    pub words: Vec<String>,
    /// Results from the shapes; left out where none were measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shapes: Option<Shapes>,
}

document!(MeasuredFile, "measured");

/// The bat of the computed modes.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ComputedBat {
    /// Name of the bat.
    pub name: String,
    /// The bat's file.
    pub file: String,
    /// Changes made to the bat after it was weighed; left out where there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub edits: Vec<Edit>,
    /// Beam theory.
    #[schemars(extend("enum" = Theory::ALL.map(Theory::name)))]
    pub theory: &'static str,
}

/// A measured mode. Members that need a shape are null where it was not measured.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct MeasuredMode {
    /// The name in the file.
    pub name: String,
    /// Measured frequency (Hz).
    pub frequency_hz: f64,
    /// Damping ratio, if measured.
    pub damping_ratio: Option<f64>,
    /// Whether the bat bends, or moves as a rigid body on its supports.
    #[schemars(extend("enum" = ["bending", "rigid"]))]
    pub kind: &'static str,
    /// Deviation of a rigid mode's shape from a straight line, as a share of its size.
    pub off_a_straight_line: Option<f64>,
    /// How nearly all points move in phase or against it, 1 if all do.
    pub phase_collinearity: Option<f64>,
    /// Out-of-phase share of the shape.
    pub out_of_phase: Option<f64>,
    /// Rigid motion in the shape, as a share of its size.
    pub rigid_share: Option<f64>,
    /// Rigid motion in its computed partner at the same points.
    pub rigid_share_of_computed: Option<f64>,
}

/// A computed mode.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ComputedMode {
    /// Number of the mode, from 1.
    pub order: usize,
    /// Undamped natural frequency (Hz).
    pub frequency_hz: f64,
    /// Damping ratio; 0 without damping.
    pub damping_ratio: f64,
    /// Relative error of the frequency.
    pub error: Option<f64>,
}

/// A measured and a computed mode that are the same.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Pair {
    /// Name of the measured mode.
    pub measured: String,
    /// Number of the computed mode, from 1.
    pub computed: usize,
    /// Modal assurance criterion of both shapes; null without measured shapes.
    pub mac: Option<f64>,
    /// Computed over measured frequency, less 1; null for a measured 0 Hz.
    pub frequency_difference: Option<f64>,
    /// Relative error of the computed frequency.
    pub computed_within: f64,
    /// Whether the difference is no larger than that error.
    pub within_errors: Option<bool>,
    /// The factor from the computed shape (largest deflection 1) to the measured one.
    pub scale: Option<Complex>,
}

/// A complex number.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Complex {
    /// Real part.
    pub real: f64,
    /// Imaginary part.
    pub imaginary: f64,
}
