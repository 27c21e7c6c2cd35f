//! The document of a BBCOR test, `sweetspot-bbcor/1`: what is written is this type, and so is its
//! schema.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::bat::edit::Edit;
use crate::files::schema::document::{Document, Format, Generator};
use crate::files::schema::hit::{Ball, WallUnderBall};

/// BBCOR along a bat as laboratories measure it, the bat at rest on a pivot: computed, and no
/// certificate. SI, the unit in every name; positions count from the knob end; what does not exist is
/// null. Later versions of the same number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(title = "BBCOR file of sweetspot, sweetspot-bbcor/1")]
pub struct BbcorFile {
    /// Name of the format and its version: sweetspot-bbcor/1.
    pub format: Format<BbcorFile>,
    /// The program that wrote the file.
    pub generator: Generator,
    /// What the bat is called.
    pub bat_name: String,
    /// What was changed about the bat after it was weighed; left out where nothing was.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub edits: Vec<Edit>,
    /// Always false: a computed value is no certificate.
    pub certified: bool,
    /// The test: what was shot at the bat, and how it was held.
    pub protocol: Protocol,
    /// The scan, from the knob towards the tip.
    pub places: Vec<Place>,
    /// The largest BBCOR of the scan; null where no place has one.
    pub largest: Option<Largest>,
    /// What a hollow barrel's wall does at that place; left out where it does not give way by its hoop
    /// modes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wall: Option<WallUnderBall>,
    /// The largest BBCOR that the rules allow.
    pub limit: f64,
    /// Whether the largest is below the limit; null where its error does not tell.
    pub within_limit: Option<bool>,
    /// Whether every place is as accurate as was asked.
    pub tolerance_met: bool,
    /// Effects that were left out, and what they do.
    pub ignored: Vec<String>,
}

impl Document for BbcorFile {
    const NAME: &'static str = "bbcor";
}

/// What was shot at the bat, and how it was held.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Protocol {
    /// The pivot about which the bat turns (m).
    pub pivot_m: f64,
    /// Moment of inertia of the bat about the pivot (kg m²).
    pub inertia_pivot_kg_m2: f64,
    /// Speed of the ball (m/s).
    pub ball_speed_m_s: f64,
    /// Distance from one place to the next (m).
    pub step_m: f64,
    /// The ball, with its force law and its restitution.
    pub ball: Ball,
    /// Coefficient of restitution of the ball at the test speed, unless its own depends on the speed.
    pub cor: f64,
    /// Where the coefficient of restitution is from.
    pub cor_source: String,
    /// Where the limit is from.
    pub limit_source: String,
    /// Where the definitions of BESR and BPF are from.
    #[serde(default)]
    pub measures_source: String,
}

/// One place of the scan. Most is null where ball and bat do not meet; `flags` says why.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Place {
    /// Where the ball meets the bat (m).
    pub x_m: f64,
    /// Distance of the impact point from the tip (m).
    pub from_tip_m: f64,
    /// Speed of the ball off the bat (m/s), negative where it follows through.
    pub exit_speed_m_s: Option<f64>,
    /// Collision efficiency e_A, the speed off the bat over the speed onto it.
    pub collision_efficiency: Option<f64>,
    /// BBCOR, e_A (1 + r) + r with r = m Q²/I about the pivot.
    pub bbcor: Option<f64>,
    /// Ball exit speed ratio, e_A + 1/2.
    #[serde(default)]
    pub besr: Option<f64>,
    /// Bat performance factor, BBCOR over the coefficient of restitution of the ball at the test speed.
    #[serde(default)]
    pub bpf: Option<f64>,
    /// What is unusual in the hit, as in a hit file.
    pub flags: Vec<String>,
    /// How far the numbers above may be off.
    pub error: PlaceError,
}

/// Estimated errors of a place.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PlaceError {
    /// Error of the exit speed (m/s).
    pub exit_speed_m_s: Option<f64>,
    /// Error of BBCOR.
    pub bbcor: Option<f64>,
}

/// The largest BBCOR and its place.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Largest {
    /// The place (m).
    pub x_m: f64,
    /// Distance of that from the tip (m).
    pub from_tip_m: f64,
    /// BBCOR there.
    pub bbcor: f64,
    /// Ball exit speed ratio there, e_A + 1/2.
    #[serde(default)]
    pub besr: Option<f64>,
    /// Bat performance factor there, BBCOR over the coefficient of restitution of the ball.
    #[serde(default)]
    pub bpf: Option<f64>,
    /// How far it may be off.
    pub error: f64,
}
