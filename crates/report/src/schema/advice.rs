//! What a bat's model needs, `sweetspot-advice/1`.

use schemars::JsonSchema;
use serde::Serialize;

use sweetspot::bat::theory::Theory;
use sweetspot::files::schema::document::{BatName, Document, Format, Generator};

/// What each part of a bat's model does to its modes, and the smallest model that will do. SI, the
/// unit in every name; shifts of frequencies are relative; what does not exist is null. Later versions
/// of the same number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "Advice file of sweetspot, sweetspot-advice/1")]
pub struct AdviceFile {
    /// Name of the format and its version: sweetspot-advice/1.
    pub format: Format<AdviceFile>,
    /// The program that wrote the file.
    pub generator: Generator,
    /// The bat.
    pub bat: BatName,
    /// Number of modes that were looked at.
    pub modes: usize,
    /// How near to the full model's frequencies is near enough, relative.
    pub tolerance: f64,
    /// The model with everything that is known of the bat.
    pub full_model: FullModel,
    /// One effect for everything that can be switched.
    pub effects: Vec<Effect>,
    /// What the bat's materials and dashpots damp.
    pub damping: Damping,
    /// The smallest model within the tolerance.
    pub smallest_model: SmallestModel,
    /// The physics that no model here has, a sentence each.
    pub out_of_scope: Vec<String>,
}

impl Document for AdviceFile {
    const NAME: &'static str = "advice";
}

/// A model and what it says of the modes.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SolvedModel {
    /// Beam theory.
    #[schemars(extend("enum" = Theory::ALL.map(Theory::name)))]
    pub theory: &'static str,
    /// What the model has beside the bare bat, in words.
    pub parts: Vec<&'static str>,
    /// How many motions are rigid, at 0 Hz.
    pub rigid_modes: usize,
    /// Frequency of each mode (Hz).
    pub frequencies_hz: Vec<f64>,
    /// Relative error of each frequency.
    pub error_by_mode: Vec<f64>,
}

/// The full model.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct FullModel {
    /// The model and what it says of the modes.
    #[serde(flatten)]
    pub model: SolvedModel,
    /// Whether its own frequencies are known to the tolerance.
    pub tolerance_met: bool,
}

/// The smallest model within the tolerance.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SmallestModel {
    /// The model and what it says of the modes.
    #[serde(flatten)]
    pub model: SolvedModel,
    /// What it leaves out of the full model, in words.
    pub left_out: Vec<&'static str>,
    /// Largest relative difference of a frequency from the full model's.
    pub deviation: f64,
    /// How far that difference may be off.
    pub deviation_error: f64,
}

/// What one part of the model does; shifts are null where the modes are others altogether.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Effect {
    /// What is switched, in words.
    pub switch: &'static str,
    /// Whether the bat file says so; false where a typical value was tried.
    pub known: bool,
    /// The model that has it.
    pub with: SolvedModel,
    /// The model that does not.
    pub without: SolvedModel,
    /// Relative change of each frequency, negative where the part lowers it.
    pub shift_by_mode: Option<Vec<f64>>,
    /// How far each change may be off.
    pub shift_error_by_mode: Option<Vec<f64>>,
    /// Shift of every node of each mode towards the tip (m); null where their number changes.
    pub node_shift_m_by_mode: Option<Vec<Option<Vec<f64>>>>,
    /// How far the shifts of each mode's nodes may be off (m).
    pub node_shift_error_m_by_mode: Option<Vec<f64>>,
    /// Change of the mass (kg).
    pub mass_kg: f64,
    /// Change of the balance point (m).
    pub balance_point_m: f64,
    /// Change of the moment of inertia about the point 6 in from the knob end (kg m²).
    pub inertia_pivot_kg_m2: f64,
}

/// What materials and dashpots damp.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Damping {
    /// Bounds of every mode's damping ratio by the materials alone.
    pub material_ratio: [f64; 2],
    /// Dashpots: what they are and how strong.
    pub dashpots: Vec<String>,
    /// Damping ratio of each mode; empty without damping.
    pub ratio_by_mode: Vec<f64>,
    /// Frequency of each damped motion (Hz); empty without damping.
    pub damped_frequency_hz_by_mode: Vec<f64>,
}
