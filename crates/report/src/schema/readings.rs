//! What was measured of a bat, `sweetspot-readings/1`.

use schemars::JsonSchema;
use schemars::generate::Contract;

use sweetspot::base::units::Quantity;
use sweetspot::files::schema::amount::Measures;
use sweetspot::files::schema::document::{Document, Format};
use sweetspot::files::schema::part::Comment;

/// What was measured of a bat, for sweetspot calibrate: by scale, ruler, pendulum and microphone. At least one
/// reading; places count from the knob end.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(title = "Readings file of sweetspot, sweetspot-readings/1", deny_unknown_fields)]
pub struct ReadingsForm {
    /// Where this schema is, for editors.
    #[schemars(rename = "$schema")]
    pub schema: Option<String>,
    /// Name of the format and its version: sweetspot-readings/1.
    pub format: Format<ReadingsForm>,
    /// A remark for people, which programs pass over.
    pub comment: Option<Comment>,
    /// What the readings are called.
    pub name: Option<String>,
    /// Mass with everything attached. Without an uncertainty it is 1 g.
    #[schemars(transform = Measures(Quantity::Mass), example = "0.869 kg ± 1 g")]
    pub mass: Option<UncertainAmount>,
    /// Balance point from the knob end. Without an uncertainty it is 1 mm.
    #[schemars(transform = Measures(Quantity::Length), example = "56.1 cm ± 1 mm")]
    pub balance_point: Option<UncertainAmount>,
    /// A swing of the hanging bat.
    pub pendulum: Option<PendulumForm>,
    /// Lines in the spectrum of a tap.
    pub lines: Option<Vec<LineForm>>,
    /// Tones that died out.
    pub ring_down: Option<Vec<ToneForm>>,
    /// How far the beam may be off in a frequency, relative, one standard deviation. Without it 0.3 %.
    #[schemars(example = "0.3 %")]
    pub model: Option<ShareForm>,
    /// How far the wood was open before. Without it wood of one species about the bat file's.
    pub priors: Option<PriorsForm>,
}

impl Document for ReadingsForm {
    const NAME: &'static str = "readings";
    const CONTRACT: Contract = Contract::Deserialize;
}

/// A reading: a bare number in SI, or a text with its unit, on request with its standard deviation after ±, +/- or +-,
/// in a unit of its own, in that of the reading, or in per cent.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(untagged)]
pub enum UncertainAmount {
    /// In SI.
    Number(f64),
    /// With its unit.
    Text(String),
}

/// A share, as a number or as a text in per cent.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(untagged)]
pub enum ShareForm {
    /// Such as 0.04.
    Number(f64),
    /// Such as 4 %.
    Text(#[schemars(regex(pattern = "%\\s*$"))] String),
}

/// A swing of the hanging bat.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct PendulumForm {
    /// Where it hangs, on the knob side of the balance point. Without it 6 in from the knob end.
    #[schemars(transform = Measures(Quantity::Length), example = "6 in")]
    pub pivot: Option<UncertainAmount>,
    /// Time of a swing there and back. Without an uncertainty it is 1 ms.
    #[schemars(transform = Measures(Quantity::Time), example = "1.470 s ± 1 ms")]
    pub period: UncertainAmount,
}

/// A line in the spectrum of a tap.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct LineForm {
    /// Frequency of the line.
    #[schemars(transform = Measures(Quantity::Frequency), example = 174.5)]
    pub hz: UncertainAmount,
    /// Standard deviation of the reading. Without it that of the text, else 0.5 Hz.
    #[schemars(transform = Measures(Quantity::Frequency), example = 0.3)]
    pub within: Option<UncertainAmount>,
    /// Which bending mode it is, from 1. Without it that is found out.
    #[schemars(range(min = 1, max = 20))]
    pub mode: Option<u32>,
}

/// A tone that died out.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct ToneForm {
    /// Which bending mode it is, from 1.
    #[schemars(range(min = 1, max = 20))]
    pub mode: u32,
    /// Cycles that were counted.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub cycles: f64,
    /// Amplitude after them over that before.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 1))]
    pub ratio: f64,
}

/// How far the wood was open before anything was measured: standard deviations of natural logarithms, and
/// correlations.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct PriorsForm {
    /// Of Young's modulus. Without it 22 %.
    pub youngs_modulus: Option<ShareForm>,
    /// Of G/E. Without it 35 %, unless shear_modulus is there.
    pub shear_over_young: Option<ShareForm>,
    /// Of G by itself, whatever E is, in place of shear_over_young.
    pub shear_modulus: Option<ShareForm>,
    /// Of the density. Without it 10 %.
    pub density: Option<ShareForm>,
    /// Correlation of Young's modulus and density. Without it 0.6.
    pub correlation: Option<f64>,
    /// Of Young's modulus in the barrel over that in the handle. Without it 8 %.
    pub youngs_modulus_ratio: Option<ShareForm>,
    /// Correlation of the densities of handle and barrel. Without it 0.95.
    pub densities_together: Option<f64>,
}
