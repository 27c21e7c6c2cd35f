//! All of an analysis, `sweetspot-analysis/1`: modes, hits, strength, and what is open of the answers.

use schemars::JsonSchema;
use serde::Serialize;

use crate::schema::hit::HitFile;
use crate::schema::hoop::HoopFile;
use crate::schema::modes::ModesFile;
use crate::schema::ring::Strength;
use sweetspot::files::schema::document::{Document, Format, Generator};

/// Everything about a bat: its modes, its hits along the barrel, what they ask of its strength, and how
/// far the answers may be from those of the bat in hand. SI, the unit in every name; positions count
/// from the knob end. Later versions of the same number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "Analysis file of sweetspot, sweetspot-analysis/1")]
pub struct AnalysisFile {
    /// Name of the format and its version: sweetspot-analysis/1.
    pub format: Format<AnalysisFile>,
    /// The program that wrote the file.
    pub generator: Generator,
    /// The bending modes, a document of their own.
    pub modes: ModesFile,
    /// The hits along the barrel, a document of their own.
    pub hit: HitFile,
    /// What hits at the sweet spot and five inches closer to the handle ask of the bat.
    pub strength: Vec<Strength>,
    /// What calipers, scale and wood leave open of the answers.
    pub open: Open,
    /// How the barrel of a hollow bat rings and what its wall does to the ball, a document of its own; left out
    /// of others.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hoop: Option<HoopFile>,
}

impl Document for AnalysisFile {
    const NAME: &'static str = "analysis";
}

/// What is not known exactly of a bat, and how far each answer may be off by it: to first order, the
/// sources taken as independent.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Open {
    /// What is open.
    pub sources: Vec<Source>,
    /// How far each answer may be off.
    pub answers: Vec<BoundedAnswer>,
    /// What could not be counted, a phrase each.
    pub left_out: Vec<String>,
    /// Why the answers are less certain than that; left out where nothing is known against them.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub doubts: Vec<Doubt>,
}

/// A reason why the answers are less certain than what is counted as open of them.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Doubt {
    /// What it is about: the density of the material, shear that is left out for want of a modulus, the dent in a
    /// hollow barrel's wall, a wall that is taken as rigid, a fastest place that lives on a later contact, a hit
    /// for which the ball's law was not measured, exit speeds that are less accurate than was asked.
    #[schemars(extend("enum" = ["density", "shear", "dent", "rigid_wall", "later_contact", "ball_law", "exit_speeds"]))]
    pub about: &'static str,
    /// The doubt in a sentence.
    pub text: String,
}

/// Something that is not known exactly.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Source {
    /// What it is: E (and G with it) or density of a material from piece to piece, readings of diameters,
    /// bores, length and mass, the note of a tap, the patch on which the ball presses on a hollow barrel's wall.
    #[schemars(extend("enum" = ["stiffness", "density", "diameters", "bores", "length", "mass", "tap", "patch"]))]
    pub input: &'static str,
    /// The material as the bat file calls it, where the bat has several; empty otherwise.
    pub material: String,
    /// Standard deviation; relative of stiffness, density, tap and patch (of the ball's compression, as a
    /// logarithm), in m of lengths, in kg of the mass.
    pub standard_deviation: f64,
}

/// An answer and how far that of the bat in hand may be from it.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct BoundedAnswer {
    /// Which answer, its unit at the end.
    #[schemars(extend("enum" = [
        "mass_kg", "balance_point_m", "inertia_pivot_kg_m2", "frequency_1_hz", "frequency_2_hz",
        "frequency_3_hz", "best_place_m", "exit_speed_m_s", "zone_from_m", "zone_to_m"
    ]))]
    pub answer: String,
    /// As it is computed.
    pub value: f64,
    /// Standard deviation of all sources together, in the unit of the value; null where a bat that differs
    /// in one of them has no such answer.
    pub standard_deviation: Option<f64>,
    /// What one standard deviation of each source alone makes of it, in the order of the sources; empty
    /// where the standard deviation is null.
    pub by_source: Vec<f64>,
}
