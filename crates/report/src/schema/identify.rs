//! Modes that measured responses share, `sweetspot-identify/1`.

use schemars::JsonSchema;
use serde::Serialize;

use crate::schema::{Said, document};

/// The modes common to the measured frequency responses of one bat. SI units, named at the end of each member; a value
/// that does not exist is null. Later versions with the same number may have more members.
#[derive(Debug, Clone, Serialize, JsonSchema)]
#[schemars(title = "Modes of responses of sweetspot, sweetspot-identify/1")]
pub struct IdentifyFile {
    /// Number of responses.
    pub responses: usize,
    /// What was moved from response to response: hammer or accelerometer.
    pub roved: String,
    /// Positions of the other one.
    pub references: Vec<IdentifyPlace>,
    /// Lowest and highest frequency (Hz).
    pub band_hz: [f64; 2],
    /// How the bat is damped: material (a loss factor) or dashpots.
    pub damping: String,
    /// The modes, rising.
    pub modes: Vec<IdentifyMode>,
    /// Frequencies found with 1, 2, … poles, in this order (Hz).
    pub orders_hz: Vec<Vec<f64>>,
    /// Results of the virtual test; null where responses were measured.
    pub simulated: Option<IdentifySimulated>,
    /// Warnings about the responses.
    pub warnings: Vec<Said>,
}

document!(IdentifyFile, "identify");

/// A place on the bat.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct IdentifyPlace {
    /// Label of the node.
    pub node: i64,
    /// Position along the axis, from the origin of the file (m).
    pub x_m: f64,
}

/// A mode that the responses share.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct IdentifyMode {
    /// Undamped natural frequency (Hz).
    pub frequency_hz: f64,
    /// Interval of 95 % confidence (Hz), by the noise of the responses.
    pub frequency_interval95_hz: [f64; 2],
    /// Damping ratio, half the loss factor.
    pub damping_ratio: f64,
    /// Interval of 95 % confidence.
    pub damping_ratio_interval95: [f64; 2],
    /// Modal phase collinearity of the shape: 1 where all points move in phase or against it.
    pub phase_collinearity: f64,
    /// Modal mass of this shape (kg); null without a response with hammer and accelerometer at one place.
    pub modal_mass_kg: Option<f64>,
    /// The number of poles from which on it was always found.
    pub found_from_order: usize,
    /// Relative decrease of the frequency due to the masses of the accelerometers, for which the frequency is
    /// corrected; null where the masses were not given.
    pub lowered: Option<f64>,
    /// Its shape, along the axis, the largest deflection of size 1.
    pub shape: Vec<IdentifyPoint>,
}

/// A point of a shape.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct IdentifyPoint {
    /// Label of the node.
    pub node: i64,
    /// Position along the axis, from the origin of the file (m).
    pub x_m: f64,
    /// Deflection, real part.
    pub re: f64,
    /// Deflection, imaginary part.
    pub im: f64,
}

/// Results of the virtual test of a bat.
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
    /// The modes of the bat in the band, and the result for each.
    pub modes: Vec<IdentifyPlanned>,
    /// Where to suspend the bat: the wanted modes move least there (m from the knob end).
    pub hang_m: Vec<f64>,
    /// The reference position that shows every wanted mode best (m from the knob end).
    pub reference_m: f64,
    /// The smallest deflection of a wanted mode at the reference, relative to the largest of that mode.
    pub reference_least: f64,
    /// Smallest spectrum of the force in the band, relative to its largest (dB).
    pub force_db: f64,
}

/// A mode of the bat in a virtual test.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct IdentifyPlanned {
    /// Its number, from 1.
    pub order: usize,
    /// Frequency of the bat alone (Hz).
    pub frequency_hz: f64,
    /// Relative change of the frequency due to the masses of the accelerometers.
    pub by_masses: f64,
    /// The frequency found (Hz); null where the mode is missed.
    pub found_hz: Option<f64>,
    /// Similarity of the shape found, 0 to 1; null where the mode is missed.
    pub mac: Option<f64>,
}
