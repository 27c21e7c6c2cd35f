//! The modes document, `sweetspot-modes/1`. This type is written, and the schema derives from it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::schema::document;
use sweetspot::Theory;
use sweetspot::files::schema::document::{Format, Generator};
use sweetspot::files::schema::resolved::ResolvedBat;

/// The bending modes of a bat: frequencies, shapes, nodes and their errors. SI units, named at the end of each member;
/// positions count from the knob end; a value that does not exist is null. Later versions with the same number may have
/// more members.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(title = "Modes file of sweetspot, sweetspot-modes/1")]
pub struct ModesFile {
    /// Name of the format and its version: sweetspot-modes/1.
    pub format: Format<ModesFile>,
    /// The program that wrote the file.
    pub generator: Generator,
    /// The bat as the program understood it, as a complete bat file.
    pub bat: ResolvedBat,
    /// The bat as a rigid body: length, mass, balance point, moments of inertia.
    pub summary: Summary,
    /// Model and settings of the computation.
    pub model: Model,
    /// Number of rigid-body modes, at 0 Hz: 2 for a free bat. They are not among `modes`.
    #[schemars(range(max = 2))]
    pub rigid_modes: usize,
    /// The elastic modes, rising in frequency.
    pub modes: Vec<Mode>,
    /// The basis of the proven frequencies; only where they were requested.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub proof: Option<Proof>,
    /// Left out if equal input must give equal bytes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub timing: Option<Timing>,
}

document!(ModesFile, "modes");

/// The bat as a rigid body. Moments of inertia are transverse, with the sections' own and
/// everything attached, as a pendulum measures them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Summary {
    /// Length from the knob end to the tip (m).
    pub length_m: f64,
    /// Mass (kg) with everything attached.
    pub mass_kg: f64,
    /// Distance of the centre of mass from the knob end (m).
    pub balance_point_m: f64,
    /// Moment of inertia about the balance point (kg m²).
    pub inertia_balance_kg_m2: f64,
    /// Position at which standards hold a bat: 6 in from the knob end (m).
    pub pivot_m: f64,
    /// Moment of inertia about that pivot (kg m²): the swing weight.
    pub inertia_pivot_kg_m2: f64,
    /// Centre of percussion for that pivot (m); null if the pivot is the balance point.
    pub center_of_percussion_m: Option<f64>,
    /// The adjustment to the weighed and tapped values; absent for a bat without such values.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub weighed: Option<WeighedFactors>,
}

/// The adjustment to the weighed and tapped values; only for a bat with such values.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WeighedFactors {
    /// Factor on all densities that the weighed mass led to.
    pub density_factor: f64,
    /// Factor on all moduli that the tapped frequency led to.
    pub modulus_factor: f64,
    /// The balance point that was measured (m).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub balance_point_m: Option<f64>,
    /// Computed balance point less the measured one (m).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub balance_point_difference_m: Option<f64>,
    /// The measured swing weight about 6 in from the knob end, given as such or by a pendulum (kg m²).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inertia_pivot_kg_m2: Option<f64>,
    /// Computed swing weight less the measured one (kg m²).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inertia_pivot_difference_kg_m2: Option<f64>,
}

/// Model and settings of the computation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Model {
    /// Beam theory.
    #[schemars(extend("enum" = Theory::ALL.map(Theory::name)))]
    pub theory: String,
    /// Number of finite elements.
    pub elements: usize,
    /// Degree of the deflection in each element.
    pub degree: usize,
    /// The eigenvalue solver.
    #[schemars(extend("enum" = ["statics", "dense", "shift-invert", "arpack"]))]
    pub solver: String,
    /// Unknowns of the assembled matrices.
    pub degrees_of_freedom: usize,
    /// Products with the compliance or the inverse; 0 for the dense solver.
    pub lanczos_steps: usize,
    /// Why this mesh and this degree, in words.
    pub plan: String,
    /// Whether the estimated error of every frequency is within the wanted tolerance.
    pub tolerance_met: bool,
    /// Whether it is certain that no mode is missing from the list.
    pub no_mode_missing: bool,
    /// Neglected effects and the errors they cause, one sentence each.
    pub ignored: Vec<String>,
    /// The method of the damping; only for a damped bat.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damping: Option<Damping>,
}

/// The method of the damping; only for a damped bat.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Damping {
    /// The method in words.
    pub method: String,
    /// Decay rates (1/s) of rigid motions that only dashpots hold.
    pub rigid_decay_1_per_s: Vec<f64>,
}

/// One elastic mode. Its shape is scaled to a largest deflection of 1 along the bat, positive at the
/// barrel end, or at the knob end if the barrel end is at rest.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Mode {
    /// Number of the mode, from 1.
    #[schemars(range(min = 1))]
    pub order: usize,
    /// Undamped natural frequency (Hz).
    pub frequency_hz: f64,
    /// Undamped natural angular frequency (rad/s).
    pub omega_rad_s: f64,
    /// Damping ratio, half the loss factor; 0 without damping.
    pub damping_ratio: f64,
    /// Modal mass (kg) under the shape's scaling.
    pub modal_mass_kg: f64,
    /// Isolated interior zeros of the deflection (m), from the knob end, as far as they are certain.
    pub nodes_m: Vec<f64>,
    /// Stretches (m), from the knob end, where the deflection is smaller than its error, so that no further node can be
    /// located there; only for a mode with such a stretch.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub nodes_untold_m: Option<Vec<[f64; 2]>>,
    /// Interval that contains the frequency of the exact beam; only for a mode for which it was requested and proven.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub proven: Option<ProvenFrequency>,
    /// Intervals (m), from the knob end, that each contain a node of the mode; only where they were requested.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub proven_nodes_m: Option<Vec<[f64; 2]>>,
    /// Interval that contains this frequency for every bat within the requested tolerances of this one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub proven_within: Option<ProvenFrequency>,
    /// Errors of the numbers above.
    pub error: ModeError,
    /// The deflection along the bat.
    pub shape: Shape,
    /// How the mode dies out; only of a damped bat.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damping: Option<Damped>,
}

/// Two numbers between which a frequency is proven to lie, rounded outwards.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ProvenFrequency {
    /// The frequency is not below this (Hz).
    pub lower_hz: f64,
    /// The frequency is not above this (Hz).
    pub upper_hz: f64,
}

/// The basis of proven frequencies: numbers that give the bounds of `τ = 1/ω²` by Temple's theorem and show that no
/// mode is missing.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Proof {
    /// Whether every requested mode is proven and its interval is as narrow as requested.
    pub met: bool,
    /// Number of proven modes, counted from the first, with none missing.
    pub proven: usize,
    /// How many motions were tried.
    pub trials: usize,
    /// Number of stretches on which the trials are polynomials.
    pub cells: usize,
    /// Degree of the trials' deflection.
    pub degree: usize,
    /// The sum of all τ is at most this (s²).
    pub trace_s2: f64,
    /// The sum of all τ² is at most this (s⁴).
    pub norm_squared_s4: f64,
    /// Upper bound of every τ outside the intervals of the trials (s²).
    pub others_s2: f64,
    /// Data of the trial of each proven mode, in order.
    pub trial: Vec<ProofOfTrial>,
    /// Tolerances of the bats that `proven_within` covers.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub within: Option<ProofWithin>,
}

/// Data of a trial.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ProofOfTrial {
    /// Rayleigh's quotient σ of the compliance lies between these (s²).
    pub quotient_s2: [f64; 2],
    /// Its residual ε², the square of `|Tk − σk|/|k|`, is at most this (s⁴).
    pub residual_s4: f64,
}

/// Tolerances between a bat and its file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ProofWithin {
    /// Every radius, everywhere along the bat (m).
    pub radius_m: f64,
    /// Tolerance of Young's modulus and the shear modulus, relative.
    pub modulus: f64,
    /// Whether every requested mode has an interval, with each end as sharp as requested.
    pub met: bool,
}

/// Estimated errors; null where no estimate was possible. Those of the frequency are relative.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ModeError {
    /// Relative error of the frequency, by the finite elements.
    pub discretization: Option<f64>,
    /// Relative error of the frequency, by arithmetic.
    pub round_off: Option<f64>,
    /// Relative residual of the eigenpair.
    pub residual: Option<f64>,
    /// Error of a node's position (m).
    pub nodes_m: Option<f64>,
    /// Relative error of the modal mass.
    pub modal_mass: Option<f64>,
    /// Error of the shape, relative to its largest deflection.
    pub shape: Option<f64>,
}

/// Samples of a shape; positions, deflections and rotations are equally many.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Shape {
    /// Places at which the shape is sampled (m).
    pub x_m: Vec<f64>,
    /// Deflection at each place, 1 at the largest.
    pub deflection: Vec<f64>,
    /// Rotation of the section at each place (rad per m of deflection).
    pub rotation: Vec<f64>,
}

/// How a mode dies out; only of a damped bat.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Damped {
    /// Modulus of the damped motion's pole (Hz).
    pub natural_frequency_hz: f64,
    /// Frequency of the damped motion (Hz).
    pub damped_frequency_hz: f64,
    /// Rate at which the amplitude falls (1/s).
    pub decay_1_per_s: f64,
    /// Twice the damping ratio.
    pub loss_factor: f64,
    /// Sharpness of the resonance, 1/(2 ratio); null without damping.
    pub q_half_power: Option<f64>,
    /// Quality factor as papers on bats count it, 1/ratio; null without damping.
    pub q_amplitude: Option<f64>,
    /// Part of the damping ratio that comes from the materials.
    pub material_damping_ratio: f64,
    /// Whether it is a complex mode, not one mode by itself.
    pub complex: bool,
    /// Estimated error, relative to the frequency.
    pub error: f64,
}

/// The time taken by each part.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Timing {
    /// Time for planning (s).
    pub plan_s: f64,
    /// Time for assembling (s).
    pub assemble_s: f64,
    /// Time for solving (s).
    pub solve_s: f64,
}
