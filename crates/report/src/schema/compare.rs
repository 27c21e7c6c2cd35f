//! Several bats side by side, `sweetspot-compare/1`.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Serialize, Serializer};

use crate::schema::analysis::Doubt;
use crate::schema::hit::Wall;
use sweetspot::bat::edit::Edit;
use sweetspot::bat::theory::Theory;
use sweetspot::collision::ball::Ball;
use sweetspot::files::schema::document::{Document, Format, Generator};
use sweetspot_study::comparison::rows::Compared;
use sweetspot_study::comparison::stretches::Stretch;

/// Several bats side by side: their figures, exit speeds at the same places, and where one hits harder
/// than the first. SI, the unit in every name; what does not exist is null. Later versions of the same
/// number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "Comparison file of sweetspot, sweetspot-compare/1")]
pub struct CompareFile {
    /// Name of the format and its version: sweetspot-compare/1.
    pub format: Format<CompareFile>,
    /// The program that wrote the file.
    pub generator: Generator,
    /// How the bats' bending is counted.
    #[schemars(extend("enum" = ["rigid", "energy-loss", "pulse", "contact"]))]
    pub model: &'static str,
    /// What the bats have in common.
    pub scene: Scene,
    /// The bats, the first the one the others are compared with.
    pub bats: Vec<ComparedBat>,
    /// Exit speeds at equal distances from the tip.
    pub exit_speed_from_tip: Vec<Speeds>,
    /// Exit speeds at equal distances from the knob end.
    pub exit_speed_from_knob: Vec<Speeds>,
    /// What follows, in sentences.
    pub words: Vec<String>,
}

impl Document for CompareFile {
    const NAME: &'static str = "compare";
}

/// What the bats have in common: how they are swung, and what ball they meet.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(rename = "CommonScene")]
pub struct Scene {
    /// Rotation centre of the swing beyond the knob end (m), negative inside the handle.
    pub bat_pivot_m: f64,
    /// The ball, with its force law and its restitution.
    pub ball: Ball,
    /// Speed of the ball towards the bat (m/s).
    pub ball_speed_m_s: f64,
    /// Coefficient of restitution, unless the ball's own depends on the speed.
    pub cor: f64,
    /// Where the hands feel the hit (m).
    pub hands_m: f64,
    /// How the barrel gives way under the ball; left out where it does not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wall: Option<Wall>,
    /// How the swing goes with the bat's swing weight; null where all swings are given.
    pub swing_law: Option<SwingLaw>,
}

/// One batter's swing of any bat: reference swing · (reference inertia / inertia)^exponent.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SwingLaw {
    /// Exponent of the law.
    pub exponent: f64,
    /// Swing weight of the reference bat (kg m²).
    pub reference_inertia_kg_m2: f64,
    /// Angular speed of the reference bat (rad/s).
    pub reference_swing_rad_s: f64,
}

/// One of the bats.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ComparedBat {
    /// What the bat is called.
    pub name: String,
    /// The bat's file.
    pub file: String,
    /// What was changed about the bat after it was weighed; left out where nothing was.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub edits: Vec<Edit>,
    /// Angular speed of the swing (rad/s).
    pub swing_rad_s: f64,
    /// Who sees the energies: the ground, or of a held bat its hands.
    #[schemars(extend("enum" = ["ground", "hands"]))]
    pub energies_seen_from: &'static str,
    /// Beam theory.
    #[schemars(extend("enum" = Theory::ALL.map(Theory::name)))]
    pub theory: &'static str,
    /// Number of bending modes.
    pub modes: usize,
    /// Whether every exit speed is as accurate as was asked.
    pub tolerance_met: bool,
    /// Effects that were left out, and what they do.
    pub ignored: Vec<String>,
    /// Why the answers of a hit are less certain than they are computed; left out where nothing is known against
    /// them.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub doubts: Vec<Doubt>,
    /// Figures by their names, the unit at the end of each; null where this bat has none.
    #[serde(serialize_with = "in_order")]
    #[schemars(with = "BTreeMap<String, Option<Compared>>")]
    pub figures: Vec<(String, Option<Compared>)>,
    /// Stretches of the barrel where this bat or the first hits harder; empty for the first.
    pub harder: Vec<Stretch>,
}

/// Named values as an object, in their order.
fn in_order<S: Serializer>(
    figures: &[(String, Option<Compared>)],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer.collect_map(figures.iter().map(|(name, figure)| (name, figure)))
}

/// Exit speeds at one distance, one for each bat; null where ball and bat do not meet.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Speeds {
    /// Distance from the tip, or from the knob end (m).
    pub distance_m: f64,
    /// Exit speeds (m/s).
    pub exit_speed_m_s: Vec<Option<f64>>,
    /// How far they may be off (m/s).
    pub error_m_s: Vec<Option<f64>>,
}
