//! Which properties of a bat are uncertain, and how accurate were the measurements?

use serde::Serialize;

use crate::engine::Bat;
use crate::named::named;
use crate::read_to::diameters_read_to;

/// How exactly a bat was measured, as standard deviations.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Readings {
    /// Common error of all diameters, of bores too (m), as of calipers.
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

named! {
    /// An uncertain property of a bat.
    #[derive(schemars::JsonSchema)]
    #[non_exhaustive]
    pub enum Input {
        /// E of a material, from piece to piece, and G with it. Relative.
        Stiffness = "stiffness",
        /// Density of a material, from piece to piece. Relative.
        Density = "density",
        /// All outer diameters by the same amount (m).
        Diameters = "diameters",
        /// All diameters of bores by the same amount (m).
        Bores = "bores",
        /// Length, everything on the bat moving with it (m).
        Length = "length",
        /// Mass on the scale, which settles the densities (kg).
        Mass = "mass",
        /// The tapped first bending frequency, which sets the stiffness. Relative.
        Tap = "tap",
        /// Compression of the ball by which it presses on a hollow barrel's wall as a patch: the largest error of the
        /// wall's model. Relative, as a logarithm.
        Patch = "patch",
    }
}
