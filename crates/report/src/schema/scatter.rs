//! What differs between bats of one model, `sweetspot-scatter/1`, and what comes of it,
//! `sweetspot-scatter-result/1`.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use schemars::generate::Contract;
use serde::Serialize;

use crate::schema::readings::ShareForm;
use crate::schema::study::Said;
use sweetspot::base::units::Quantity;
use sweetspot::files::schema::amount::{Amount, Measures};
use sweetspot::files::schema::document::{BatName, Document, Format, Generator};
use sweetspot::files::schema::part::Comment;
use sweetspot_study::scatter::scattered::Scattered;

/// Outputs, as an example.
const OUTPUTS: [&str; 2] = ["f1_hz", "exit_speed_m_s@impact"];

/// What differs between bats of one model and swings of one batter, for sweetspot scatter: standard deviations, in the
/// order in which correlated ones are told. At least one of them.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(title = "Scatter file of sweetspot, sweetspot-scatter/1", deny_unknown_fields)]
pub struct ScatterForm {
    /// Where this schema is, for editors.
    #[schemars(rename = "$schema")]
    pub schema: Option<String>,
    /// Name of the format and its version: sweetspot-scatter/1.
    pub format: Format<ScatterForm>,
    /// A remark for people, which programs pass over.
    pub comment: Option<Comment>,
    /// What the scatter is called.
    pub name: Option<String>,
    /// The ball: a ball file, from the folder of this one, or the name of a built-in ball. Without it a baseball.
    pub ball: Option<String>,
    /// How the bat is hit in the middle: the options of sweetspot hit, such as swing_speed, by their names.
    pub scene: Option<BTreeMap<String, Said>>,
    /// Density of the wood.
    pub density: Option<LognormalForm>,
    /// Young's modulus of the wood; G goes with it.
    pub youngs_modulus: Option<LognormalForm>,
    /// G/E of the wood.
    pub shear_over_young: Option<LognormalForm>,
    /// Density and moduli as a calibration left them, in place of these three: its result, from the folder of this file.
    pub covariance: Option<String>,
    /// What the lathe misses of the diameter: a smooth curve.
    pub turning: Option<TurningForm>,
    /// Moisture, as a share of the mass; E and G fall by 1.3 % for each per cent.
    pub moisture: Option<NormalForm>,
    /// Speed of the swing, relative.
    pub swing_speed: Option<NormalForm>,
    /// Speed of the pitch, relative.
    pub pitch: Option<NormalForm>,
    /// Coefficient of restitution of the ball, as an amount.
    pub cor: Option<NormalForm>,
    /// Where the ball is hit.
    pub impact: Option<ImpactForm>,
    /// Triples of two that differ and the correlation of their normal numbers; of the later one its part that the
    /// earlier one leaves open is told.
    pub correlation: Option<Vec<(String, String, f64)>>,
    /// What is asked of every bat, by name; exit_speed_m_s@impact is the speed where the ball is hit.
    #[schemars(length(min = 1), example = OUTPUTS)]
    pub outputs: Option<Vec<String>>,
    /// Wanted accuracy of frequencies, relative, and of exit speeds, relative to the closing speed. Without it 1e-4.
    pub tol: Option<ShareForm>,
}

impl Document for ScatterForm {
    const NAME: &'static str = "scatter";
    const CONTRACT: Contract = Contract::Deserialize;
}

/// A factor whose logarithm is normal.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct LognormalForm {
    /// Standard deviation of the natural logarithm.
    pub lognormal: ShareForm,
}

/// A normal number.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct NormalForm {
    /// Standard deviation.
    pub normal: ShareForm,
}

/// What the lathe misses.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct TurningForm {
    /// Standard deviation of the diameter.
    #[schemars(transform = Measures(Quantity::Length), example = "0.1 mm")]
    pub normal: Amount,
    /// How far along the bat an error reaches. Without it 12 in.
    #[schemars(transform = Measures(Quantity::Length), example = "12 in")]
    pub along: Option<Amount>,
}

/// Where the ball is hit.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct ImpactForm {
    /// Standard deviation of the place.
    #[schemars(transform = Measures(Quantity::Length), example = "0.5 in")]
    pub normal: Amount,
    /// The place in the middle, from the knob end. Without it where the ball leaves fastest.
    #[schemars(transform = Measures(Quantity::Length), example = "27.7 in")]
    pub at: Option<Amount>,
}

/// How much bats of one model and swings of one batter differ. SI, the unit in every name; positions count from the knob
/// end; what does not exist is null. Later versions of the same number may have more members.
#[derive(Debug, Clone, Serialize, JsonSchema)]
#[schemars(title = "Result of a scatter of sweetspot, sweetspot-scatter-result/1")]
pub struct ScatterResult {
    /// Name of the format and its version: sweetspot-scatter-result/1.
    pub format: Format<ScatterResult>,
    /// The program that wrote the file.
    pub generator: Generator,
    /// The bat in the middle.
    pub bat: BatName,
    /// What was found.
    #[serde(flatten)]
    pub found: Scattered,
    /// All of it in sentences.
    pub words: Vec<String>,
}

impl Document for ScatterResult {
    const NAME: &'static str = "scatter-result";
}
