//! What a bat's wood is, `sweetspot-calibrate/1`.

use schemars::JsonSchema;
use serde::Serialize;

use sweetspot::files::schema::document::{BatName, Document, Format, Generator};

/// What a bat's wood is by what was measured of it, and how much of that the readings say. SI, the unit in every
/// name; positions count from the knob end; what does not exist is null. Later versions of the same number may have
/// more members.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "Calibration of sweetspot, sweetspot-calibrate/1")]
pub struct CalibrateFile {
    /// Name of the format and its version: sweetspot-calibrate/1.
    pub format: Format<CalibrateFile>,
    /// The program that wrote the file.
    pub generator: Generator,
    /// The bat.
    pub bat: BatName,
    /// Where the barrel's region begins (m), if there are two.
    pub regions_at_m: Option<f64>,
    /// The parameters of the wood.
    pub parameters: Vec<ParameterFound>,
    /// Covariance of the natural logarithms of the parameters, in their order; scatter reads it.
    pub covariance: Vec<Vec<f64>>,
    /// What was measured, beside what the bat of that wood shows.
    pub data: Vec<DatumFound>,
    /// Sum of squares of all residuals and of what was known before, each over its standard deviation.
    pub chi2: f64,
    /// What it would be by chance: the number of data.
    pub expected: usize,
    /// How many times larger all errors would have to be for both to be equal.
    pub errors_larger_by: f64,
    /// How far the beam was taken to be off in a frequency, relative.
    pub model: f64,
    /// Whether the readings fit this bat.
    pub fits: bool,
    /// Steps of the fit.
    pub steps: usize,
    /// Which mode each line was taken for.
    pub labels: LabelsFound,
    /// Names of the data that do not fit the others.
    pub outliers: Vec<String>,
    /// The parameters without those; null where there are none.
    pub without_outliers: Option<WithoutOutliers>,
    /// Loss factors, frequency by frequency.
    pub loss_factors: Vec<LossFound>,
    /// What a further measurement would do.
    pub next: Vec<NextMeasurement>,
    /// What to measure next, in words.
    pub advice: String,
    /// All of it in sentences.
    pub words: Vec<String>,
}

impl Document for CalibrateFile {
    const NAME: &'static str = "calibrate";
}

/// A parameter of the wood.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ParameterFound {
    /// Its name, as in a bat file.
    pub name: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Its value.
    pub value: f64,
    /// Where it lies in 95 of 100 cases.
    pub interval95: [f64; 2],
    /// Standard deviation of its natural logarithm.
    pub relative_sd: f64,
    /// Value before anything was measured.
    pub prior: f64,
    /// Standard deviation of its natural logarithm before anything was measured.
    pub prior_relative_sd: f64,
    /// How much the readings say of it, from 0 to 1: one less its variance over that before.
    pub learned: f64,
    /// The parameter that it goes with most.
    pub correlated_with: Option<&'static str>,
    /// Correlation of their logarithms.
    pub correlation: Option<f64>,
    /// How well it is determined.
    #[schemars(extend("enum" = ["determined", "partly", "only_together", "not_determined", "held"]))]
    pub verdict: &'static str,
}

/// Something that was measured.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct DatumFound {
    /// Its name.
    pub name: String,
    /// What was read.
    pub measured: f64,
    /// How far the reading may be off.
    pub reading_sd: f64,
    /// How far reading and beam together may be off.
    pub sd: f64,
    /// What the bat of that wood shows.
    pub computed: f64,
    /// Measured less computed, in standard deviations.
    pub residual_sd: f64,
    /// Measured less what the fit to all other data predicts, in standard deviations.
    pub left_out_sd: f64,
}

/// Which mode each line was taken for, in the order of the readings; null for a line of no bending mode.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct LabelsFound {
    /// Frequencies of the lines (Hz).
    pub lines_hz: Vec<f64>,
    /// The labels that were taken.
    pub taken: Vec<Option<usize>>,
    /// Their chi2.
    pub chi2: f64,
    /// The labels of the readings, where others were taken.
    pub told: Option<Vec<Option<usize>>>,
    /// Their chi2.
    pub told_chi2: Option<f64>,
    /// The second best labels, where others were looked at.
    pub second: Option<Vec<Option<usize>>>,
    /// Their chi2.
    pub second_chi2: Option<f64>,
    /// By how much they cost more in the search over all wood; below 8 they may be the right ones.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub margin: Option<f64>,
}

/// The wood without the data that do not fit.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct WithoutOutliers {
    /// The parameters.
    pub parameters: Vec<ParameterFound>,
    /// Their chi2.
    pub chi2: f64,
    /// The number of data that remain.
    pub expected: usize,
}

/// The loss factor by a tone that died out.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct LossFound {
    /// Number of the bending mode.
    pub mode: usize,
    /// Damping ratio.
    pub damping_ratio: f64,
    /// Loss factor, twice that.
    pub loss_factor: f64,
}

/// A measurement that was not made.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct NextMeasurement {
    /// Its name.
    pub name: String,
    /// Standard deviation that it is thought to have, of reading and beam.
    pub sd: f64,
    /// Factor on the interval of every parameter, in their order.
    pub factors: Vec<f64>,
}
