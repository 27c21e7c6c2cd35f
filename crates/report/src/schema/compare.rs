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

/// Several bats side by side: their figures, their exit speeds at the same places, and the places at which each one
/// hits harder than the first. SI units, named at the end of each member; a value that does not exist is null. Later
/// versions with the same number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "Comparison file of sweetspot, sweetspot-compare/1")]
pub struct CompareFile {
    /// Name of the format and its version: sweetspot-compare/1.
    pub format: Format<CompareFile>,
    /// The program that wrote the file.
    pub generator: Generator,
    /// The collision model: how the bending of the bats is treated in a hit.
    #[schemars(extend("enum" = ["rigid", "energy-loss", "pulse", "contact"]))]
    pub model: &'static str,
    /// The conditions common to all bats.
    pub scene: Scene,
    /// The bats, the first the one the others are compared with.
    pub bats: Vec<ComparedBat>,
    /// Exit speeds at equal distances from the tip.
    pub exit_speed_from_tip: Vec<Speeds>,
    /// Exit speeds at equal distances from the knob end.
    pub exit_speed_from_knob: Vec<Speeds>,
    /// The conclusions in sentences.
    pub words: Vec<String>,
}

impl Document for CompareFile {
    const NAME: &'static str = "compare";
}

/// The conditions common to all bats: the swing and the ball.
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
    /// Position at which the hands feel the hit (m).
    pub hands_m: f64,
    /// The compliance of the barrel under the ball; left out for a rigid barrel.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wall: Option<Wall>,
    /// How the swing depends on the swing weight of the bat; null where all swings are given.
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
    /// Name of the bat.
    pub name: String,
    /// The bat's file.
    pub file: String,
    /// Changes made to the bat after it was weighed; left out where there are none.
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
    /// Whether every exit speed is as accurate as requested.
    pub tolerance_met: bool,
    /// Neglected effects and their consequences.
    pub ignored: Vec<String>,
    /// Reasons for which the answers of a hit are less certain than computed; left out where there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub doubts: Vec<Doubt>,
    /// Figures by name, with the unit at the end of the name; null where this bat has none.
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
