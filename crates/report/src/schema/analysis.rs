//! The whole analysis, `sweetspot-analysis/1`: modes, hits, strength and uncertainty.

use schemars::JsonSchema;
use serde::Serialize;

use crate::schema::hit::HitFile;
use crate::schema::hoop::HoopFile;
use crate::schema::modes::ModesFile;
use sweetspot::collision::strength::Strength;
use sweetspot::files::schema::document::{Document, Format, Generator};
use sweetspot_study::spread::Spread;

/// The whole analysis of a bat: its modes, its hits along the barrel, the stress that they cause, and the uncertainty
/// of the answers. SI units, named at the end of each member; positions count from the knob end. Later versions with
/// the same number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "Analysis file of sweetspot, sweetspot-analysis/1")]
pub struct AnalysisFile {
    /// Name of the format and its version: sweetspot-analysis/1.
    pub format: Format<AnalysisFile>,
    /// The program that wrote the file.
    pub generator: Generator,
    /// The bending modes, as a complete document.
    pub modes: ModesFile,
    /// The hits along the barrel, as a complete document.
    pub hit: HitFile,
    /// The load on the bat in hits at the sweet spot and five inches closer to the handle.
    pub strength: Vec<Strength>,
    /// The uncertainty of the answers due to calipers, scale and wood.
    pub open: Open,
    /// How the barrel of a hollow bat rings and how its wall affects the ball, as a complete document; left out for
    /// other bats.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hoop: Option<HoopFile>,
}

impl Document for AnalysisFile {
    const NAME: &'static str = "analysis";
}

/// What is not known exactly about a bat, and the resulting uncertainty of each answer, to first order, with
/// independent sources.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Open {
    /// The sources of uncertainty and the uncertainty of each answer.
    #[serde(flatten)]
    pub spread: Spread,
    /// Reasons for which the answers are less certain than that; left out where there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub doubts: Vec<Doubt>,
}

/// A reason for which the answers are less certain than the computed uncertainty says.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Doubt {
    /// The subject: the density of the material, shear that is neglected because no modulus is known, the dent in the
    /// wall of a hollow barrel, a wall that is taken as rigid, a fastest place that depends on a later contact, a hit
    /// for which the law of the ball was not measured, exit speeds that are less accurate than requested.
    #[schemars(extend("enum" = ["density", "shear", "dent", "rigid_wall", "later_contact", "ball_law", "exit_speeds"]))]
    pub about: &'static str,
    /// The doubt in a sentence.
    pub text: String,
}
