//! The document of the verb `hoop`, `sweetspot-hoop/1`. This type is written, and the schema derives from it.

use schemars::JsonSchema;
use serde::Serialize;

use sweetspot::bat::edit::Edit;
use sweetspot::files::schema::document::{Document, Format, Generator};
use sweetspot::modes::hoop::{HoopMode, Outline};
use sweetspot_study::trampoline::barrel::{HoopModel, Rebound};
use sweetspot_study::trampoline::pressed::{BarrelCompression, PressedWall};
use sweetspot_study::trampoline::thickness::WallTried;

/// How the barrel of a hollow bat rings, how its wall deforms under a ball, and how that affects the ball. SI units,
/// named at the end of each member; positions count from the knob end; a value that does not exist is null. Later
/// versions with the same number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "Hoop file of sweetspot, sweetspot-hoop/1")]
pub struct HoopFile {
    /// Name of the format and its version: sweetspot-hoop/1.
    pub format: Format<HoopFile>,
    /// The program that wrote the file.
    pub generator: Generator,
    /// Name of the bat.
    pub bat_name: String,
    /// Changes made to the bat after it was weighed; left out where there are none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub edits: Vec<Edit>,
    /// The model of the modes.
    pub model: HoopModel,
    /// Every mode found, ordered by harmonic and then by frequency.
    pub modes: Vec<ShapedMode>,
    /// The wall under the ball; null where the ball does not meet the stretch that is modelled.
    pub wall: Option<PressedWall>,
    /// How fast the ball comes back; null without a wall under it and for a ball without a force law.
    pub bbcor: Option<Rebound>,
    /// The predicted result of a barrel compression test; null where there is no wall under the ball.
    pub compression: Option<BarrelCompression>,
    /// The bat with thinner and thicker walls and the same outer surface; left out where this was not requested.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub wall_sweep: Vec<WallTried>,
    /// Assumptions and limits of the model, one sentence each.
    pub notes: Vec<String>,
    /// Whether every frequency is as accurate as requested.
    pub tolerance_met: bool,
}

impl Document for HoopFile {
    const NAME: &'static str = "hoop";
}

/// A mode of the wall, and the motion of the outer surface in it.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(rename = "HoopMode")]
pub struct ShapedMode {
    /// The mode.
    #[serde(flatten)]
    pub mode: HoopMode,
    /// Motion of the outer surface; left out where no samples were requested.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shape: Option<Outline>,
}
