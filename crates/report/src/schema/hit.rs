//! The hit document, `sweetspot-hit/1`. This type is written, and the schema derives from it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::schema::document;
use sweetspot::bat::edit::Edit;
use sweetspot::collision::hit::{Energy, Separation};
use sweetspot::collision::{Ball, SweetSpot, figures};
use sweetspot::files::schema::document::{Format, Generator};

/// Hits along a bat: exit speeds, forces, energies and the sweet spot. SI units, named at the end of each member;
/// positions count from the knob end; a value that does not exist is null. The bat moves in the + direction; the ball
/// arrives with − and leaves with +. Later versions with the same number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(title = "Hit file of sweetspot, sweetspot-hit/1")]
pub struct HitFile {
    /// Name of the format and its version: sweetspot-hit/1.
    pub format: Format<HitFile>,
    /// The program that wrote the file.
    pub generator: Generator,
    /// Changes made to the bat after it was weighed; left out where there are none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub edits: Vec<Edit>,
    /// The collision model: how the bending of the bat is treated in a hit.
    #[schemars(extend("enum" = ["rigid", "energy-loss", "pulse", "contact"]))]
    pub model: String,
    /// The swing and the ball.
    pub scene: Scene,
    /// Impacts, one for each requested place, in the order of the places.
    pub impacts: Vec<Impact>,
    /// The sweet spot of this scene, by each of its definitions.
    pub sweet_spot: SweetSpot,
    /// Neglected effects and their consequences; empty where none is known.
    #[serde(default)]
    pub ignored: Vec<String>,
    /// The figures by which bats are compared; left out where they were not requested.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub figures: Option<Figures>,
}

document!(HitFile, "hit");

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
    /// Position at which the hands feel the hit (m).
    pub hands_m: f64,
    /// Frame of the energies: the ground, or the hands for a held bat.
    #[schemars(extend("enum" = ["ground", "hands"]))]
    pub energies_seen_from: String,
    /// The compliance of the barrel under the ball; left out for a rigid barrel.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wall: Option<Wall>,
}

/// The wall of a compliant barrel as a spring with a mass under the ball.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Wall {
    /// Stiffness (N/m).
    pub stiffness_n_m: f64,
    /// Mass (kg) of its vibration; 0 is a spring in series.
    pub mass_kg: f64,
    /// The hoop modes of the compliant wall; left out where the two numbers above describe it completely. With hoop
    /// modes, the two numbers describe one spring with a mass that is equivalent for a slow force 6 in from the tip,
    /// while the hits use every mode.
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

/// One impact. Most members are null where ball and bat do not meet, or where the model has no real solution; `flags`
/// gives the reason.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Impact {
    /// Position of the impact (m).
    pub x_m: f64,
    /// Distance of the impact point from the tip (m).
    pub from_tip_m: f64,
    /// Speed of the bat at the impact point before the hit (m/s).
    pub bat_speed_m_s: f64,
    /// Speed of the ball after its last contact with the bat (m/s).
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
    /// Largest compression of the ball (m), if the model has one.
    #[serde(default)]
    pub peak_compression_m: Option<f64>,
    /// Collision efficiency e_A = (v_out − V)/(v_in + V), V the bat's speed at the impact point.
    pub collision_efficiency: Option<f64>,
    /// Bat-ball coefficient of restitution of the free bat, of a held one as it is held: e_A (1 + r) + r, r the ball's
    /// mass over the bat's effective mass there.
    pub bbcor: Option<f64>,
    /// Bat-ball coefficient of restitution of the bat held 6 in from the knob; of a held bat as `bbcor`.
    pub bbcor_pivoted: Option<f64>,
    /// Number of bending modes that took part.
    pub modes_used: Option<usize>,
    /// Why the impact has no outcome: no_contact, no_section, no_real_solution, unresolved (the time steps reached no
    /// end, or the energies do not balance). Or what makes it delicate: reload (the ball was compressed further after
    /// it had begun to expand), late_contact (the bat caught up when the force had almost vanished), second_contact
    /// (the bat caught the ball again after it had left; the second contact is included), ball_law_beyond (the law of
    /// the ball was not measured for such a hit). Later versions may have more flags.
    pub flags: Vec<String>,
    /// The distribution of the energy; null without an outcome.
    pub energy_j: Option<Energy>,
    /// Errors of the numbers above.
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
    /// Always false: these figures are not a certificate under any standard.
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
