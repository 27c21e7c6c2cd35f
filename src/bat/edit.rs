//! What may a bat maker or a player change about a bat?
//!
//! An [`Edit`] is one such change: wood turned off, drilled out or sawn off, a part added, another wood.
//! [`crate::bat::body::Bat::edited`] applies a list of edits to a bat that was weighed before. Places count from the
//! knob end of the bat as it is before the edit.

use serde::{Deserialize, Serialize};

use crate::bat::material::Material;

/// One change of a bat, with an optional name.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Edit {
    /// Name of the edit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// The change.
    #[serde(flatten)]
    pub change: Change,
}

/// What an edit changes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Change {
    /// Wood is turned off a stretch.
    Cut(Cut),
    /// A weight on the end of the knob (kg): a point mass at the knob end itself.
    Knob(f64),
    /// The tip is hollowed out.
    Cup(Cup),
    /// A stretch is drilled out.
    Bore(Bore),
    /// A stretch is drilled out and filled.
    Cork(Cork),
    /// A layer is put around a stretch.
    Sleeve(Sleeve),
    /// The bat is sawn off at an end.
    Shorten(Shorten),
    /// All diameters of a stretch grow or shrink by a factor.
    ScaleDiameter(ScaleDiameter),
    /// The bat is made of another wood: density and moduli are those of the new one. Regions of other
    /// materials stay.
    Wood(Material),
}

/// Wood turned off a stretch of the outside.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Cut {
    /// Where the cut begins (m).
    pub from: f64,
    /// Where the cut ends (m).
    pub to: f64,
    /// Reduction of the diameter (m).
    pub depth: f64,
    /// Length over which the cut runs in and out smoothly, inside the stretch (m). By default 1 in, or half of a
    /// shorter stretch. At an end of the bat the cut has its full depth.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub blend: Option<f64>,
}

/// A curved hollow in the tip.
///
/// Let `a` be half the diameter at the rim and `v` run from 0 at the bottom to 1 at the rim. The radius is
/// `a (1 − (1 − v)³)`: round at the bottom, with walls along the axis at the rim. The cup holds 9/14 of the cylinder
/// around it; half an ellipsoid would hold 2/3.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Cup {
    /// How deep the cup goes into the bat (m).
    pub depth: f64,
    /// Diameter of the cup at the tip (m).
    pub diameter: f64,
}

/// A hole along the axis.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Bore {
    /// Where the hole begins (m).
    pub from: f64,
    /// Where the hole ends (m).
    pub to: f64,
    /// Diameter of the hole (m).
    pub diameter: f64,
}

/// A hole along the axis and what fills it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Cork {
    /// Where the hole begins (m).
    pub from: f64,
    /// Where the hole ends (m).
    pub to: f64,
    /// Diameter of the hole (m).
    pub diameter: f64,
    /// Material that fills the hole.
    pub material: Material,
}

/// A layer around a stretch, which bends with it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Sleeve {
    /// Where the sleeve begins (m).
    pub from: f64,
    /// Where the sleeve ends (m).
    pub to: f64,
    /// Thickness of the sleeve: the bat grows by twice as much in diameter (m).
    pub thickness: f64,
    /// Material of the sleeve.
    pub material: Material,
}

/// Lengths that are sawn off the ends.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Shorten {
    /// Length that is sawn off at the knob (m).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub knob: Option<f64>,
    /// Length that is sawn off at the tip (m).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tip: Option<f64>,
}

/// A factor on all outer diameters of a stretch.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ScaleDiameter {
    /// Where the stretch begins (m).
    pub from: f64,
    /// Where the stretch ends (m).
    pub to: f64,
    /// Factor on the diameter, such as 1.02.
    pub by: f64,
    /// Length over which the factor begins and ends smoothly, inside the stretch (m). By default 1 in, or half of a
    /// shorter stretch. At an end of the bat the factor applies in full.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub blend: Option<f64>,
}

impl Change {
    /// Name of each kind of change, in a bat file and on the command line.
    pub const VERBS: [&'static str; 9] =
        ["cut", "knob", "cup", "bore", "cork", "sleeve", "shorten", "scale_diameter", "wood"];

    /// The name of this kind of change.
    pub fn verb(&self) -> &'static str {
        let k = match self {
            Self::Cut(_) => 0,
            Self::Knob(_) => 1,
            Self::Cup(_) => 2,
            Self::Bore(_) => 3,
            Self::Cork(_) => 4,
            Self::Sleeve(_) => 5,
            Self::Shorten(_) => 6,
            Self::ScaleDiameter(_) => 7,
            Self::Wood(_) => 8,
        };
        Self::VERBS[k]
    }
}
