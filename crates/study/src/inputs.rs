//! Which properties of a bat are uncertain, and how accurate were the measurements?

use serde::Serialize;

use crate::read_to::diameters_read_to;
use sweetspot::bat::body::Bat;

/// How exactly a bat was measured, as standard deviations.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Readings {
    /// All diameters, of bores too, by the same amount (m): how calipers are off.
    pub diameter: f64,
    /// Length (m).
    pub length: f64,
    /// Mass on the scale (kg).
    pub mass: f64,
    /// Frequency of a tapped note, relative.
    pub tap: f64,
}

impl Readings {
    /// The errors for a bat. Diameters read to a step of 1/16 in, 1 mm or the like are off by at most half a step, with
    /// the standard deviation `step/√12`; the error is at least that of calipers.
    ///
    /// # Source
    ///
    /// JCGM 100:2008 (GUM), 4.3.7: a rectangular distribution.
    pub fn of(bat: &Bat) -> Self {
        let usual = Self::default();
        let rounded = diameters_read_to(bat).map_or(0.0, |read| read.deviation());
        Self { diameter: usual.diameter.max(rounded), ..usual }
    }
}

impl Default for Readings {
    /// Calipers within 0.1 mm, a rule within 1 mm, a kitchen scale within 1 g, a note within 1 %.
    fn default() -> Self {
        Self { diameter: 1e-4, length: 1e-3, mass: 1e-3, tap: 0.01 }
    }
}

/// An uncertain property of a bat.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Input {
    /// E of a material, from piece to piece, and G with it. Relative.
    Stiffness,
    /// Density of a material, from piece to piece. Relative.
    Density,
    /// All outer diameters by the same amount (m).
    Diameters,
    /// All diameters of bores by the same amount (m).
    Bores,
    /// Length, everything on the bat moving with it (m).
    Length,
    /// Mass on the scale, which settles the densities (kg).
    Mass,
    /// The tapped first bending frequency, which sets the stiffness. Relative.
    Tap,
    /// Compression of the ball by which it presses on a hollow barrel's wall as a patch: the largest error of the
    /// wall's model. Relative, as a logarithm.
    Patch,
}

impl Input {
    /// Its name, as in JSON.
    pub fn name(self) -> &'static str {
        match self {
            Self::Stiffness => "stiffness",
            Self::Density => "density",
            Self::Diameters => "diameters",
            Self::Bores => "bores",
            Self::Length => "length",
            Self::Mass => "mass",
            Self::Tap => "tap",
            Self::Patch => "patch",
        }
    }
}
