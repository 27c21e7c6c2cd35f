//! The document of the verb `hoop`, `sweetspot-hoop/1`: what is written is this type, and so is its schema.

use schemars::JsonSchema;
use serde::Serialize;

use sweetspot::bat::edit::Edit;
use sweetspot::files::schema::document::{Document, Format, Generator};
use sweetspot::modes::hoop::{HoopMode, Outline};
use sweetspot_study::trampoline::barrel::{HoopModel, Rebound};
use sweetspot_study::trampoline::pressed::{BarrelCompression, PressedWall};
use sweetspot_study::trampoline::thickness::WallTried;

/// How the barrel of a hollow bat rings, how its wall gives way under a ball, and what that does to the ball.
/// SI, the unit in every name; positions count from the knob end; what does not exist is null. Later
/// versions of the same number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
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
    pub modes: Vec<ShapedMode>,
    /// The wall under the ball; null where the ball does not meet the stretch that is modelled.
    pub wall: Option<PressedWall>,
    /// How fast the ball comes back; null without a wall under it and for a ball without a force law.
    pub bbcor: Option<Rebound>,
    /// What a test of the barrel's compression would show; null where there is no wall under the ball.
    pub compression: Option<BarrelCompression>,
    /// The bat with thinner and thicker walls, its surface where it is; left out where that was not asked.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub wall_sweep: Vec<WallTried>,
    /// What was assumed, and where the model ends, a sentence each.
    pub notes: Vec<String>,
    /// Whether every frequency is as accurate as was asked.
    pub tolerance_met: bool,
}

impl Document for HoopFile {
    const NAME: &'static str = "hoop";
}

/// A mode of the wall, and how the outer surface moves in it.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(rename = "HoopMode")]
pub struct ShapedMode {
    /// The mode.
    #[serde(flatten)]
    pub mode: HoopMode,
    /// How the outer surface moves; left out where no samples were asked.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shape: Option<Outline>,
}
