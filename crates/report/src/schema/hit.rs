//! The hit document, `sweetspot-hit/1`: what is written is this type, and so is its schema.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use sweetspot::bat::edit::Edit;
use sweetspot::collision::figures;
use sweetspot::collision::hit::{Energy, Separation};
use sweetspot::collision::{Ball, SweetSpot};
use sweetspot::files::schema::document::{Document, Format, Generator};

/// Hits along a bat: exit speeds, forces, energies and the sweet spot. SI, the unit in every name;
/// positions count from the knob end; what does not exist is null. The bat moves in the direction
/// +, the ball comes in − and leaves in +. Later versions of the same number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(title = "Hit file of sweetspot, sweetspot-hit/1")]
pub struct HitFile {
    /// Name of the format and its version: sweetspot-hit/1.
    pub format: Format<HitFile>,
    /// The program that wrote the file.
    pub generator: Generator,
    /// What was changed about the bat after it was weighed; left out where nothing was.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub edits: Vec<Edit>,
    /// How the bat's bending is counted.
    #[schemars(extend("enum" = ["rigid", "energy-loss", "pulse", "contact"]))]
    pub model: String,
    /// How the bat is swung, and what ball it meets.
    pub scene: Scene,
    /// Impacts, one for each place that was asked for, in the order of the places.
    pub impacts: Vec<Impact>,
    /// The sweet spot of this scene, by each of its definitions.
    pub sweet_spot: SweetSpot,
    /// Effects that were left out of these hits, and what they do; empty where none is known.
    #[serde(default)]
    pub ignored: Vec<String>,
    /// The figures by which bats are compared; left out where they were not asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub figures: Option<Figures>,
}

impl Document for HitFile {
    const NAME: &'static str = "hit";
}

/// A swing meets a pitch.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Scene {
    /// Rotation centre of the swing beyond the knob end (m), negative inside the handle.
    pub bat_pivot_m: f64,
    /// Angular speed of the swing (rad/s).
    pub swing_rad_s: f64,
    /// The ball, with its force law and its restitution.
    pub ball: Ball,
    /// Speed of the ball towards the bat (m/s).
    pub ball_speed_m_s: f64,
    /// Coefficient of restitution, unless the ball's own depends on the speed.
    pub cor: f64,
    /// Where the hands feel the hit (m).
    pub hands_m: f64,
    /// Who sees the energies: the ground, or of a held bat its hands.
    #[schemars(extend("enum" = ["ground", "hands"]))]
    pub energies_seen_from: String,
    /// How the barrel gives way under the ball; left out where it does not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wall: Option<Wall>,
}

/// The barrel's wall as a spring-mass under the ball, where it gives way.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Wall {
    /// Stiffness (N/m).
    pub stiffness_n_m: f64,
    /// Mass (kg) of its vibration; 0 is a spring in series.
    pub mass_kg: f64,
    /// The hoop modes by which it gives way; left out where the two numbers above are all there is. These
    /// are then one spring-mass for a slow force 6 in from the tip, and hits count every mode.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hoop: Option<HoopInHit>,
}

/// The hoop modes that hits count.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct HoopInHit {
    /// Harmonics around the barrel.
    pub harmonics: Vec<usize>,
    /// Number of modes.
    pub modes: usize,
    /// Largest stated relative error of their frequencies.
    pub frequency_error: f64,
    /// From where to where the wall is modelled (m).
    pub stretch_m: [f64; 2],
    /// Compression of the ball by which it presses as a patch (m).
    pub patch_compression_m: f64,
}

/// One impact. Most is null where ball and bat do not meet, or where the model has no real answer;
/// `flags` says why.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Impact {
    /// Where the ball meets the bat (m).
    pub x_m: f64,
    /// Distance of the impact point from the tip (m).
    pub from_tip_m: f64,
    /// Speed of the bat at the impact point before the hit (m/s).
    pub bat_speed_m_s: f64,
    /// Speed of the ball off the bat once it is gone for good (m/s).
    pub exit_speed_m_s: Option<f64>,
    /// Speed of the ball off the bat if the bat did not bend (m/s).
    pub rigid_exit_speed_m_s: Option<f64>,
    /// Coefficient of restitution of this hit.
    pub cor: Option<f64>,
    /// Impulse (N s).
    pub impulse_n_s: Option<f64>,
    /// Contact time (s), all touches together, where the model has one.
    pub contact_time_s: Option<f64>,
    /// The ball's first departure, where the model has times; the ball may be caught again.
    #[serde(default)]
    pub first_separation: Option<Separation>,
    /// Largest force (N), where the model has one.
    pub peak_force_n: Option<f64>,
    /// Largest compression of the ball (m), where the model has one.
    #[serde(default)]
    pub peak_compression_m: Option<f64>,
    /// Collision efficiency e_A = (v_out − V)/(v_in + V), V the bat's speed at the impact point.
    pub collision_efficiency: Option<f64>,
    /// Bat-ball coefficient of restitution of the free bat: e_A (1 + r) + r, r the ball's mass over
    /// the bat's effective mass there.
    pub bbcor: Option<f64>,
    /// Bat-ball coefficient of restitution of the bat held 6 in from the knob.
    pub bbcor_pivoted: Option<f64>,
    /// Number of bending modes that took part.
    pub modes_used: Option<usize>,
    /// Why the impact has no outcome: no_contact, no_section, no_real_solution, unresolved (the steps
    /// came to no end, or the energies do not close). Or what makes it delicate: reload (the ball was
    /// pressed further after it had begun to spring back), late_contact (the bat caught up when the
    /// force had almost gone), second_contact (the bat caught the ball again after it left; it is
    /// followed); or that the ball's law was not measured for such a hit (ball_law_beyond). Later versions may have
    /// more.
    pub flags: Vec<String>,
    /// Where the energy went; null without an outcome.
    pub energy_j: Option<Energy>,
    /// How far the numbers above may be off.
    pub error: HitError,
}

/// Estimated errors.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct HitError {
    /// Error of the exit speed, relative to the closing speed.
    pub exit_speed: Option<f64>,
}

/// The figures by which bats are compared, computed from this model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Figures {
    /// Always false: these figures certify nothing by any standard.
    pub certified: bool,
    /// Exit speed at the sweet spot (m/s).
    pub bat_ball_speed_m_s: Option<f64>,
    /// Collision efficiency at the sweet spot.
    pub collision_efficiency: Option<f64>,
    /// BBCOR at the sweet spot, of the free bat.
    pub bbcor: Option<f64>,
    /// BBCOR at the sweet spot, of the bat held 6 in from the knob.
    pub bbcor_pivoted: Option<f64>,
    /// The other figures.
    #[serde(flatten)]
    pub others: figures::Figures,
}
