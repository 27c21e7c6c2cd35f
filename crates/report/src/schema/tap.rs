//! Results of recordings of taps on a bat, `sweetspot-tap/1`.

use schemars::JsonSchema;
use serde::Serialize;

use crate::schema::{Said, document};
use sweetspot::files::schema::document::BatName;
use sweetspot_study::calibrate::calibration::Calibration;
use sweetspot_study::tap::heard::Within;
use sweetspot_study::tap::hoops::{BatMode, NextLabels};

/// Results of recordings of taps on a bat: taps, tones, the mode of each tone, and the wood. SI units, named at the end
/// of each member; a value that does not exist is null. Later versions with the same number may have more members.
#[derive(Debug, Clone, Serialize, JsonSchema)]
#[schemars(title = "Taps of sweetspot, sweetspot-tap/1")]
pub struct TapFile {
    /// The bat.
    pub bat: BatName,
    /// The recordings, in the order in which they were named.
    pub recordings: Vec<TapRecording>,
    /// The taps of all recordings.
    pub taps: Vec<TapMoment>,
    /// The tones, rising.
    pub tones: Vec<TapTone>,
    /// The second best labels; null where no others come near or none were sought.
    pub second: Option<NextLabels>,
    /// The wood by these tones, with the density of the bat file and the stiffness at the lowest tone; null where no
    /// tone is a bending mode. Its intervals include that the loss factor may not stiffen it.
    pub wood: Option<Calibration>,
    /// Upper limit of the loss factor of the wood: that of the bending tone with the least damping. Null where the loss
    /// factors are not reliable.
    pub loss_factor_at_most: Option<Within>,
    /// Whether the tones fit the bat; null where no labels were sought.
    pub fits: Option<bool>,
    /// Warnings about the recordings.
    pub warnings: Vec<Said>,
    /// Why nothing was found; null where tones were found.
    pub refused: Option<Said>,
}

document!(TapFile, "tap");

/// A recording.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct TapRecording {
    /// Its name.
    pub file: String,
    /// The file's kind.
    pub container: Option<String>,
    /// How its sound is written.
    pub codec: Option<String>,
    /// Samples per second (Hz).
    pub rate_hz: f64,
    /// Number of channels, of which one was used.
    pub channels: usize,
    /// How long the part is that was listened to (s).
    pub seconds: f64,
    /// The largest sample; full scale is 1.
    pub largest: f64,
    /// The share of samples above 0.9 of the largest among those above half of it.
    pub clipped_share: f64,
    /// Frequency of the hum that was removed (Hz).
    pub hum_hz: Option<f64>,
    /// Increase of the noise above 5 kHz while a tap rings (dB).
    pub gain_rise_db: Option<f64>,
}

/// A tap.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct TapMoment {
    /// Which recording it is in, from 0.
    pub recording: usize,
    /// When it begins in its file (s).
    pub at_s: f64,
    /// Whether its ringing was used.
    pub used: bool,
    /// How often it bounced.
    pub bounces: usize,
    /// Why it was not used.
    pub why_not: Option<String>,
}

/// A tone that six taps in ten share, or more.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct TapTone {
    /// Frequency (Hz).
    pub frequency_hz: f64,
    /// Interval of 95 % confidence (Hz).
    pub frequency_interval95_hz: [f64; 2],
    /// Loss factor; null where it is not to be believed.
    pub loss_factor: Option<f64>,
    /// Interval of 95 % confidence.
    pub loss_factor_interval95: Option<[f64; 2]>,
    /// Decay of the amplitude (1/s).
    pub decay_1_s: f64,
    /// Time in which the amplitude halves (s).
    pub half_s: f64,
    /// Number of taps in which it was heard.
    pub taps: usize,
    /// Amplitude at the onset over that of the strongest tone (dB).
    pub level_db: f64,
    /// The other tone of a pair, of the other plane of the grain (Hz).
    pub twin_hz: Option<f64>,
    /// Which mode it is; null where it is no mode of this bat, or was not tried.
    pub mode: Option<BatMode>,
    /// Whether modes were tried for it: of wood, the ten loudest tones are labelled, and those that were told.
    pub tried: bool,
    /// The frequency of the bat with the wood that was found (Hz).
    pub computed_hz: Option<f64>,
    /// The chance that the mode is right, 0 to 1; null without one.
    pub sure: Option<f64>,
}
