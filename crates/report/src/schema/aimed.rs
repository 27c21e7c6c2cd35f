//! The bat that meets a wish, or comes nearest, `sweetspot-aimed/1`.

use schemars::JsonSchema;
use serde::Serialize;

use sweetspot::files::schema::document::{BatName, Document, Format, Generator};
use sweetspot::files::schema::resolved::ResolvedBat;

/// The least change of a bat that meets a wish, or comes nearest to it. Every value is of the bat as it is
/// written, with rounded stations. Places count from the knob end; what does not exist is null. Later versions
/// of the same number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "Aimed bat of sweetspot, sweetspot-aimed/1")]
pub struct AimedFile {
    /// Name of the format and its version: sweetspot-aimed/1.
    pub format: Format<AimedFile>,
    /// The program that wrote the file.
    pub generator: Generator,
    /// The bat as it was.
    pub bat: BatName,
    /// Whether every target is met and every limit kept.
    pub met: bool,
    /// The targets, and the rules that are goals.
    pub targets: Vec<AimedTarget>,
    /// The targets that cannot be had together; null where all can.
    pub conflict: Option<AimedConflict>,
    /// The rules that were asked for; null without.
    pub rules: Option<AimedRules>,
    /// Root of mean(d²) + (5 cm)⁴ mean(d″²) of the change d of the diameter (mm).
    pub norm_mm: f64,
    /// Largest amount taken off a diameter (m).
    pub largest_cut_m: f64,
    /// Largest amount put on a diameter (m).
    pub largest_added_m: f64,
    /// How far a limit of the diameter is broken anywhere (m); 0 where all are kept to 1e-9 m.
    pub limits_broken_m: f64,
    /// How far the diameter moved on the stretches that are kept (m).
    pub kept_within_m: f64,
    /// How much steeper the surface is anywhere than `slope_at_most` (radius over length); 0 where that is kept,
    /// null without it.
    pub steeper_by: Option<f64>,
    /// Quadratic programs of the search.
    pub iterations: usize,
    /// Bats that were computed.
    pub bats_solved: usize,
    /// Why the search ended before it stood still; null where it did not.
    pub stopped: Option<String>,
    /// What else was chosen.
    pub free: Vec<AimedChoice>,
    /// The material that was chosen; null without a choice.
    pub wood: Option<String>,
    /// Main outputs before and after.
    pub outputs: Vec<AimedOutput>,
    /// Every station of the new bat.
    pub change: Vec<AimedStation>,
    /// What changes, station by station: what to turn off, and where wood is added.
    pub cuts: Vec<AimedCut>,
    /// What to know before the bat is turned, such as a barrel that a rule forbids; missing where there is nothing.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
    /// The new bat: a bat file in its own right.
    pub new_bat: ResolvedBat,
}

impl Document for AimedFile {
    const NAME: &'static str = "aimed";
}

/// A target and what came of it; SI, in the unit of its name.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct AimedTarget {
    /// Name of the output.
    pub name: String,
    /// The rule it is of; null for a target.
    pub rule: Option<String>,
    /// Least value that was asked for; null without.
    pub at_least: Option<f64>,
    /// Greatest value that was asked for; null without.
    pub at_most: Option<f64>,
    /// The value of the bat as it was.
    pub start: f64,
    /// The value of the new bat; null where it has none.
    pub found: Option<f64>,
    /// Whether it is met.
    pub met: bool,
    /// How much less the norm would be (mm) if the bound that binds gave way by one unit; 0 where none binds,
    /// null where the target is missed.
    pub price_mm: Option<f64>,
}

/// Targets that cannot be had together: without any one of them the others can.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct AimedConflict {
    /// The targets, with how near each comes.
    pub members: Vec<AimedReach>,
    /// The conflict in a sentence: the targets that cannot all be had, and how near each comes.
    pub words: String,
}

/// How near a target comes with the other members of the conflict met.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct AimedReach {
    /// Name of the output.
    pub name: String,
    /// Which of the targets, counted from 0.
    pub target: usize,
    /// The nearest value (SI); null where the bat has none.
    pub reaches: Option<f64>,
    /// Whether the others are met there.
    pub others_met: bool,
}

/// Rules, and whether the new bat keeps them.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct AimedRules {
    /// Short name.
    pub name: String,
    /// Which game they are of.
    pub game: String,
    /// Where the numbers are from.
    pub source: String,
    /// Year or date of the source.
    pub date: String,
    /// Always false: what is computed certifies nothing.
    pub certified: bool,
    /// The rules.
    pub limits: Vec<AimedRule>,
    /// What the rules ask besides, which nothing here computes.
    pub ask: Vec<String>,
}

/// A rule.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct AimedRule {
    /// Which, as a rule file calls it.
    pub rule: String,
    /// Its limit (SI); null where it has no number.
    pub limit: Option<f64>,
    /// What the new bat has (SI); null where it has no such thing.
    pub value: Option<f64>,
    /// Whether it is kept; null where that is not known.
    pub kept: Option<bool>,
}

/// A choice besides the shape.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct AimedChoice {
    /// What: length_m, density_kg_m3 or knob_weight_kg.
    pub name: String,
    /// The value before.
    pub start: f64,
    /// The value chosen.
    pub found: f64,
}

/// An output before and after.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct AimedOutput {
    /// Its name.
    pub name: String,
    /// Of the bat as it was.
    pub start: Option<f64>,
    /// Of the new bat.
    pub found: Option<f64>,
}

/// A station of the new bat.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct AimedStation {
    /// Where it is (m).
    pub x_m: f64,
    /// Diameter that the bat had there (m).
    pub old_m: f64,
    /// Diameter of the new bat (m).
    pub new_m: f64,
}

/// A change at a station.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct AimedCut {
    /// Where (m).
    pub x_m: f64,
    /// Diameter before (m).
    pub from_m: f64,
    /// Diameter after (m).
    pub to_m: f64,
    /// How much is off the diameter after each pass (m); empty where wood is added.
    pub passes_m: Vec<f64>,
}
