//! The document of the verb `hoop`, `sweetspot-hoop/1`: what is written is this type, and so is its schema.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use sweetspot::bat::edit::Edit;
use sweetspot::collision::ball::Ball;
use sweetspot::files::schema::document::{Document, Format, Generator};

/// How the barrel of a hollow bat rings, how its wall gives way under a ball, and what that does to the ball.
/// SI, the unit in every name; positions count from the knob end; what does not exist is null. Later
/// versions of the same number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(title = "Hoop file of sweetspot, sweetspot-hoop/1")]
pub struct HoopFile {
    /// Name of the format and its version: sweetspot-hoop/1.
    pub format: Format<HoopFile>,
    /// The program that wrote the file.
    pub generator: Generator,
    /// What the bat is called.
    pub bat_name: String,
    /// What was changed about the bat after it was weighed; left out where nothing was.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub edits: Vec<Edit>,
    /// What the modes were found with.
    pub model: HoopModel,
    /// Every mode that was found, by rising harmonic, of a harmonic by rising frequency.
    pub modes: Vec<HoopMode>,
    /// The wall under the ball; null where the ball does not meet the stretch that is modelled.
    pub wall: Option<PressedWall>,
    /// How fast the ball comes back; null without a wall under it and for a ball without a force law.
    pub bbcor: Option<BbcorOfWall>,
    /// What a test of the barrel's compression would show; null where there is no wall under the ball.
    pub compression: Option<BarrelCompression>,
    /// The bat with thinner and thicker walls, its surface where it is; left out where that was not asked.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub wall_sweep: Vec<WallThickness>,
    /// What was assumed, and where the model ends, a sentence each.
    pub notes: Vec<String>,
    /// Whether every frequency is as accurate as was asked.
    pub tolerance_met: bool,
}

impl Document for HoopFile {
    const NAME: &'static str = "hoop";
}

/// What the modes were found with.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct HoopModel {
    /// Where the stretch that is modelled begins (m).
    pub from_m: f64,
    /// Where the stretch that is modelled ends (m).
    pub to_m: f64,
    /// Wanted relative accuracy of every frequency.
    pub tolerance: f64,
    /// By how much the first mode of harmonic 2 rises if the stretch is clamped where it begins, relative:
    /// how far it is from dead there.
    pub clamped_change: Option<f64>,
}

/// A mode of the wall.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct HoopMode {
    /// Waves around the barrel, n: the motion goes as cos nθ.
    pub harmonic: usize,
    /// Number of the mode among those of its harmonic, from 1.
    pub order: usize,
    /// Natural frequency (Hz).
    pub frequency_hz: f64,
    /// Share of critical damping.
    pub damping_ratio: f64,
    /// How far the frequency may be off, relative.
    pub error: f64,
    /// Where the outer surface moves most across the bat (m).
    pub largest_at_m: f64,
    /// How the outer surface moves; left out where no samples were asked.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shape: Option<HoopShape>,
}

/// Motion of the outer surface along the barrel, the largest motion across being 1.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct HoopShape {
    /// Places (m), rising.
    pub x_m: Vec<f64>,
    /// Outwards, times cos nθ.
    pub radial: Vec<f64>,
    /// Around the barrel, times sin nθ.
    pub around: Vec<f64>,
    /// Towards the tip, times cos nθ.
    pub along: Vec<f64>,
}

/// The wall under a ball at one place.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PressedWall {
    /// Where the ball meets the bat (m).
    pub x_m: f64,
    /// Distance of that from the tip (m).
    pub from_tip_m: f64,
    /// Outer radius there (m).
    pub radius_m: f64,
    /// Thickness of the wall there, sleeves included (m).
    pub thickness_m: f64,
    /// Force on the ball's patch over how far the wall gives way (N/m).
    pub stiffness_n_m: f64,
    /// The stiffness over that of the ball, force over compression at the largest force on a stiff wall; null for
    /// a ball without a force law.
    pub over_ball: Option<f64>,
    /// Compression of the ball for which the patch is as large as it is (m).
    pub compression_m: f64,
    /// Half the length of the patch along the bat (m).
    pub patch_half_length_m: f64,
    /// Half the width of the patch around the bat (m).
    pub patch_half_width_m: f64,
    /// What each harmonic has of it.
    pub by_harmonic: Vec<HarmonicShare>,
}

/// What a harmonic has of the wall's giving way.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct HarmonicShare {
    /// Waves around the barrel.
    pub harmonic: usize,
    /// How far the wall gives way by it to a slow force (m/N).
    pub flexibility_m_n: f64,
    /// Number of its modes that take part in a hit; what is left of the flexibility follows the force.
    pub modes: usize,
}

/// The rebound of a ball from the bat at rest and free, without and with its wall.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BbcorOfWall {
    /// The ball.
    pub ball: Ball,
    /// Speed of the ball (m/s).
    pub ball_speed_m_s: f64,
    /// Coefficient of restitution of the ball on a rigid wall, unless its own depends on the speed.
    pub cor: f64,
    /// BBCOR of the bat if its wall did not give way.
    pub stiff: f64,
    /// BBCOR of the bat with its wall.
    pub wall: f64,
    /// BBCOR with the patch of a ball that is squeezed twice as much and half as much, the lesser first: how
    /// much the size of the patch leaves open.
    pub range: [f64; 2],
    /// How far `wall` may be off by the program's own errors.
    pub error: f64,
    /// Largest force between ball and bat (N).
    pub peak_force_n: f64,
    /// How deep that force, acting slowly, dents the wall (m).
    pub dent_m: f64,
    /// Energy that is left in the wall when the ball is gone (J).
    pub left_in_wall_j: f64,
    /// Energy of the ball before (J).
    pub initial_j: f64,
}

/// The barrel pressed between two opposite sides, each with the ball's patch.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BarrelCompression {
    /// By how much both sides together are pressed in (m).
    pub deflection_m: f64,
    /// Force that it takes (N).
    pub force_n: f64,
}

/// The bat with another wall.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WallThickness {
    /// Thickness of the barrel's wall over what it is.
    pub factor: f64,
    /// Thickness of the wall under the ball (m).
    pub thickness_m: f64,
    /// Mass of the bat (kg).
    pub mass_kg: f64,
    /// First frequency of harmonic 2 (Hz).
    pub frequency_hz: f64,
    /// Stiffness of the wall under the ball (N/m).
    pub stiffness_n_m: f64,
    /// BBCOR if the wall did not give way.
    pub stiff: f64,
    /// BBCOR with the wall.
    pub wall: f64,
    /// BBCOR with the patch of a ball that is squeezed twice as much and half as much, the lesser first.
    pub range: [f64; 2],
    /// How deep the wall is dented (m).
    pub dent_m: f64,
}
