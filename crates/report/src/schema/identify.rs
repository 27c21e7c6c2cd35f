//! Modes that measured responses share, `sweetspot-identify/1`.

use schemars::JsonSchema;
use serde::Serialize;

use sweetspot::files::schema::document::{Document, Format, Generator};

/// Modes that measured frequency responses of one bat share. SI, the unit in every name; what does not exist is null.
/// Later versions of the same number may have more members.
#[derive(Debug, Clone, Serialize, JsonSchema)]
#[schemars(title = "Modes of responses of sweetspot, sweetspot-identify/1")]
pub struct IdentifyFile {
    /// Name of the format and its version: sweetspot-identify/1.
    pub format: Format<IdentifyFile>,
    /// The program that wrote the file.
    pub generator: Generator,
    /// How many responses there are.
    pub responses: usize,
    /// What was at another place for every response: hammer or accelerometer.
    pub roved: String,
    /// Where the other was.
    pub references: Vec<IdentifyPlace>,
    /// Lowest and highest frequency (Hz).
    pub band_hz: [f64; 2],
    /// How the bat is damped: material (a loss factor) or dashpots.
    pub damping: String,
    /// The modes, rising.
    pub modes: Vec<IdentifyMode>,
    /// What was found with 1, 2, … poles, in the order in which they came: frequencies (Hz).
    pub orders_hz: Vec<Vec<f64>>,
    /// What the virtual test says; null where responses were measured.
    pub simulated: Option<IdentifySimulated>,
    /// What is to be said of the responses.
    pub warnings: Vec<IdentifySaid>,
}

impl Document for IdentifyFile {
    const NAME: &'static str = "identify";
}

/// A place on the bat.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct IdentifyPlace {
    /// Label of the node.
    pub node: i64,
    /// Where it is along the axis, from the file's own origin (m).
    pub x_m: f64,
}

/// A mode that the responses share.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct IdentifyMode {
    /// Undamped natural frequency (Hz).
    pub frequency_hz: f64,
    /// Where it lies in 95 of 100 cases (Hz), by the noise of the responses.
    pub frequency_interval95_hz: [f64; 2],
    /// Damping ratio, half the loss factor.
    pub damping_ratio: f64,
    /// Where it lies in 95 of 100 cases.
    pub damping_ratio_interval95: [f64; 2],
    /// Modal phase collinearity of the shape: 1 where all points move in phase or against it.
    pub phase_collinearity: f64,
    /// Modal mass of this shape (kg); null without a response whose hammer and accelerometer were at one place.
    pub modal_mass_kg: Option<f64>,
    /// With how many poles it was found first and ever after.
    pub found_from_order: usize,
    /// By what the accelerometers' masses lower the frequency, relative, which is taken off; null where they were not
    /// told.
    pub lowered: Option<f64>,
    /// Its shape, along the axis, the largest deflection of size 1.
    pub shape: Vec<IdentifyPoint>,
}

/// A point of a shape.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct IdentifyPoint {
    /// Label of the node.
    pub node: i64,
    /// Where it is along the axis, from the file's own origin (m).
    pub x_m: f64,
    /// Deflection, real part.
    pub re: f64,
    /// Deflection, imaginary part.
    pub im: f64,
}

/// What a virtual test of a bat says.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct IdentifySimulated {
    /// The bat's name.
    pub bat: String,
    /// Mass of the hammer (kg).
    pub hammer_kg: f64,
    /// Stiffness of its tip (N/m).
    pub tip_n_per_m: f64,
    /// Mass of each accelerometer (kg); 0 for a laser.
    pub accelerometer_kg: f64,
    /// Noise over the root mean square of a response (dB).
    pub noise_db: f64,
    /// Time in which the exponential window falls to 1/e (s); null without one.
    pub window_s: Option<f64>,
    /// Which noise, and which places are missing.
    pub seed: u64,
    /// The bat's modes in the band, and what is found of each.
    pub modes: Vec<IdentifyPlanned>,
    /// Where to hang the bat: the wanted modes move least there (m from the knob end).
    pub hang_m: Vec<f64>,
    /// Where the reference shows every wanted mode best (m from the knob end).
    pub reference_m: f64,
    /// How much of its largest deflection the faintest wanted mode has there.
    pub reference_least: f64,
    /// Spectrum of the force where it is weakest in the band, over the strongest (dB).
    pub force_db: f64,
}

/// A mode of the bat in a virtual test.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct IdentifyPlanned {
    /// Its number, from 1.
    pub order: usize,
    /// Frequency of the bat alone (Hz).
    pub frequency_hz: f64,
    /// By what the accelerometers' masses change the frequency, relative.
    pub by_masses: f64,
    /// What was found (Hz); null where it is missed.
    pub found_hz: Option<f64>,
    /// How alike the shape that was found is, 0 to 1; null where it is missed.
    pub mac: Option<f64>,
}

/// Something that is said of responses.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct IdentifySaid {
    /// Its name for programs.
    pub code: String,
    /// What it means and what to do.
    pub text: String,
}
