//! What a picture is drawn on: the units it counts in, and how much room it has.

use sweetspot::base::units::{FOOT_POUND, POUND_FORCE, inches, miles_per_hour};
use sweetspot::bat::body::Bat;

/// A unit of an axis: its name, and how many of it are one SI unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// As it stands in a label: `cm`.
    pub name: &'static str,
    /// How many are one SI unit: 100 for cm.
    pub per: f64,
}

impl Unit {
    /// Numbers without a unit.
    pub const NONE: Self = Self { name: "", per: 1.0 };
    /// Milliseconds, of times that are counted in them already.
    pub const MS: Self = Self { name: "ms", per: 1.0 };
    /// Hertz.
    pub const HZ: Self = Self { name: "Hz", per: 1.0 };
}

/// Where a picture will stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Paper {
    /// A file of its own, with its title above it.
    File,
    /// A page that has the title beside it.
    Page,
    /// A page on a telephone, title beside it: as wide as one, the letters as large.
    Narrow,
}

/// Units and room of a picture. One picture counts in one system of units.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sheet {
    /// Whether it counts in inches and miles an hour, not in cm and m/s.
    pub us: bool,
    /// Where it will stand.
    pub paper: Paper,
}

impl Sheet {
    /// A file of its own.
    pub const fn file(us: bool) -> Self {
        Self { us, paper: Paper::File }
    }

    /// A file of its own, in the unit that the bat was measured in.
    pub fn of(bat: &Bat) -> Self {
        Self::file(bat.inches())
    }

    /// Lengths along and across a bat.
    pub fn length(self) -> Unit {
        if self.us {
            Unit { name: "in", per: inches(1.0) }
        } else {
            Unit { name: "cm", per: 100.0 }
        }
    }

    /// Small lengths, such as the squeeze of a ball.
    pub fn small(self) -> Unit {
        if self.us { self.length() } else { Unit { name: "mm", per: 1e3 } }
    }

    /// Forces.
    pub fn force(self) -> Unit {
        if self.us {
            Unit { name: "lbf", per: 1.0 / POUND_FORCE }
        } else {
            Unit { name: "kN", per: 1e-3 }
        }
    }

    /// Speeds.
    pub fn speed(self) -> Unit {
        if self.us {
            Unit { name: "mph", per: miles_per_hour(1.0) }
        } else {
            Unit { name: "m/s", per: 1.0 }
        }
    }

    /// Energies.
    pub fn energy(self) -> Unit {
        let (name, per) = if self.us { ("ft·lbf", 1.0 / FOOT_POUND) } else { ("J", 1.0) };
        Unit { name, per }
    }

    /// Whether it is as narrow as a telephone.
    pub fn narrow(self) -> bool {
        self.paper == Paper::Narrow
    }

    /// Width of the picture (px).
    pub fn width(self) -> f64 {
        if self.narrow() { 350.0 } else { 760.0 }
    }

    /// From the left edge to the frames, so that those above each other are in line (px).
    pub fn left(self) -> f64 {
        if self.narrow() { 68.0 } else { 74.0 }
    }

    /// From a frame to the right edge, where nothing else stands there (px).
    pub fn right(self) -> f64 {
        if self.narrow() { 14.0 } else { 28.0 }
    }

    /// What title and second line take at the top (px).
    pub fn head(self) -> f64 {
        if self.paper == Paper::File { 60.0 } else { 8.0 }
    }
}
