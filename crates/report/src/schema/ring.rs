//! A bat's motion in time, `sweetspot-ring/1`, and what a hit asks of its strength.

use schemars::JsonSchema;
use serde::Serialize;

use crate::schema::hit::Impact;
use sweetspot::bat::edit::Edit;
use sweetspot::bat::theory::Theory;
use sweetspot::files::schema::document::{Document, Format, Generator};

/// How a bat moves in time after a hit, or after a blow, under a force or from an initial shape. SI,
/// the unit in every name; positions count from the knob end, times from the first touch; what does
/// not exist is null. Later versions of the same number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "Ring file of sweetspot, sweetspot-ring/1")]
#[serde(untagged)]
pub enum RingFile {
    /// After a hit.
    Hit(Box<AfterHit>),
    /// After a blow, under a force or from an initial shape.
    Motion(Motion),
}

impl Document for RingFile {
    const NAME: &'static str = "ring";
}

/// What comes of a hit; motions are against the swing.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct AfterHit {
    /// Name of the format and its version: sweetspot-ring/1.
    pub format: Format<RingFile>,
    /// The program that wrote the file.
    pub generator: Generator,
    /// What was changed about the bat after it was weighed; left out where nothing was.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub edits: Vec<Edit>,
    /// Number of bending modes.
    pub modes: usize,
    /// Where the ball meets the bat (m).
    pub at_m: f64,
    /// When the ball is gone for good (s).
    pub contact_s: f64,
    /// Instants (s).
    pub times_s: Vec<f64>,
    /// Force between ball and bat at every instant (N).
    pub force_n: Vec<f64>,
    /// What the watched places feel.
    pub watched: Vec<Watched>,
    /// The largest strain while the ball is there.
    pub strain_max_in_contact: Option<Strained>,
    /// The largest strain of the whole time.
    pub strain_max: Option<Strained>,
    /// How far the largest strain changes where a quarter of the modes is left out, relative.
    pub strain_error: f64,
    /// The largest strain of every place in the whole time.
    pub along: Along,
    /// How near the bat comes to what its materials bear; empty where that is not known.
    pub strength: Vec<Load>,
    /// The hit itself, as in a hit file.
    pub impact: Impact,
    /// Effects that were left out, and what they do.
    pub ignored: Vec<String>,
}

/// A watched place.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Watched {
    /// The place (m).
    pub x_m: f64,
    /// When it begins to move (s).
    pub begins_s: f64,
    /// The largest motion in the whole time.
    pub peak: Peak,
    /// The modes as they ring there when the ball has left.
    pub spectrum: Vec<Line>,
    /// Displacement at every instant (m).
    pub displacement_m: Vec<f64>,
    /// Velocity at every instant (m/s).
    pub velocity_m_s: Vec<f64>,
    /// Acceleration at every instant (m/s²).
    pub acceleration_m_s2: Vec<f64>,
    /// Strain of the surface at every instant.
    pub strain: Vec<f64>,
}

/// The largest motion of a place.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(rename = "PeakMotion")]
pub struct Peak {
    /// Displacement (m).
    pub displacement_m: f64,
    /// Velocity (m/s).
    pub velocity_m_s: f64,
    /// Acceleration (m/s²).
    pub acceleration_m_s2: f64,
}

/// Amplitude of one mode at a place.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Line {
    /// Frequency (Hz).
    pub frequency_hz: f64,
    /// Displacement (m).
    pub displacement_m: f64,
    /// Velocity (m/s).
    pub velocity_m_s: f64,
    /// Acceleration (m/s²).
    pub acceleration_m_s2: f64,
}

/// A strain, where and when.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Strained {
    /// The place (m).
    pub x_m: f64,
    /// The instant (s).
    pub time_s: f64,
    /// Strain of the surface.
    pub strain: f64,
    /// Stress of the surface (Pa).
    pub stress_pa: f64,
}

/// The largest strain along the bat.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Along {
    /// Places (m).
    pub x_m: Vec<f64>,
    /// Largest strain of the surface at each place.
    pub strain_max: Vec<f64>,
    /// Largest stress of the surface at each place (Pa).
    pub stress_max_pa: Vec<f64>,
}

/// Where a hit comes nearest to a limit of the material.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Load {
    /// Which limit.
    #[schemars(extend("enum" = ["stress", "strain"]))]
    pub limit: &'static str,
    /// The stress that the material bears there (Pa); of a limit of stress alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub strength_pa: Option<f64>,
    /// The strain at which the material breaks there; of a limit of strain alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub strain_to_failure: Option<f64>,
    /// The largest strain at the place nearest to the limit.
    #[serde(flatten)]
    pub at: Strained,
    /// Largest stress or strain as a share of the limit.
    pub share: f64,
    /// The swing that reaches the limit (rad/s); null if none up to 200 rad/s does.
    pub reached_at_swing_rad_s: Option<f64>,
}

/// What a hit at one place asks of the bat.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Strength {
    /// Where the ball meets the bat (m).
    pub x_m: f64,
    /// How near the bat comes to each limit that is known.
    pub limits: Vec<Load>,
}

/// The deflection along the bat in time.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Motion {
    /// Name of the format and its version: sweetspot-ring/1.
    pub format: Format<RingFile>,
    /// The program that wrote the file.
    pub generator: Generator,
    /// What was changed about the bat after it was weighed; left out where nothing was.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub edits: Vec<Edit>,
    /// Number of bending modes.
    pub modes: usize,
    /// Beam theory.
    #[schemars(extend("enum" = Theory::ALL.map(Theory::name)))]
    pub theory: &'static str,
    /// Whether the rigid motion is in it.
    pub rigid_motion: bool,
    /// Where the bat is struck or pushed (m); null where it is released from a shape.
    pub at_m: Option<f64>,
    /// Impulse of the blow (N s); null where it is pushed or released.
    pub impulse_n_s: Option<f64>,
    /// Places (m).
    pub x_m: Vec<f64>,
    /// Instants (s).
    pub times_s: Vec<f64>,
    /// Deflection at every instant, at every place (m).
    pub deflection_m: Vec<Vec<f64>>,
}
