//! The sheet of a picture: the units and the available room.

use sweetspot::base::units::{FOOT, FOOT_POUND, POUND_FORCE, inches, miles_per_hour};
use sweetspot::bat::body::Bat;

/// A unit of an axis: its name, and its number per SI unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// As in a label: `cm`.
    pub name: &'static str,
    /// Number of these units per SI unit: 100 for cm.
    pub per: f64,
}

impl Unit {
    /// Numbers without a unit.
    pub const NONE: Self = Self { name: "", per: 1.0 };
    /// Milliseconds, for times that are already given in ms.
    pub const MS: Self = Self { name: "ms", per: 1.0 };
    /// Hertz.
    pub const HZ: Self = Self { name: "Hz", per: 1.0 };
}

/// The medium of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Paper {
    /// A separate file, with the title above the picture.
    File,
    /// A page that has the title beside the picture.
    Page,
    /// A page on a telephone, with the title beside the picture: as narrow as the telephone, with letters of the same
    /// size.
    Narrow,
}

/// Units and room of a picture, which has one system of units.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sheet {
    /// Whether it counts in inches and miles an hour, not in cm and m/s.
    pub us: bool,
    /// The medium.
    pub paper: Paper,
}

impl Sheet {
    /// A separate file.
    pub const fn file(us: bool) -> Self {
        Self { us, paper: Paper::File }
    }

    /// A separate file, in the unit in which the bat was measured.
    pub fn of(bat: &Bat) -> Self {
        Self::file(bat.inches())
    }

    /// The unit of that name and number per SI unit, in SI or in US units.
    fn unit(self, si: (&'static str, f64), us: (&'static str, f64)) -> Unit {
        let (name, per) = if self.us { us } else { si };
        Unit { name, per }
    }

    /// Lengths along and across a bat.
    pub fn length(self) -> Unit {
        self.unit(("cm", 100.0), ("in", inches(1.0)))
    }

    /// The unit of small lengths, such as the compression of a ball.
    pub fn small(self) -> Unit {
        self.unit(("mm", 1e3), ("in", inches(1.0)))
    }

    /// Forces.
    pub fn force(self) -> Unit {
        self.unit(("kN", 1e-3), ("lbf", 1.0 / POUND_FORCE))
    }

    /// Speeds.
    pub fn speed(self) -> Unit {
        self.unit(("m/s", 1.0), ("mph", miles_per_hour(1.0)))
    }

    /// Accelerations.
    pub fn acceleration(self) -> Unit {
        self.unit(("km/s²", 1e-3), ("kft/s²", 1e-3 / FOOT))
    }

    /// Energies.
    pub fn energy(self) -> Unit {
        self.unit(("J", 1.0), ("ft·lbf", 1.0 / FOOT_POUND))
    }

    /// Whether it is as narrow as a telephone.
    pub fn narrow(self) -> bool {
        self.paper == Paper::Narrow
    }

    /// Width of the picture (px).
    pub fn width(self) -> f64 {
        if self.narrow() { 350.0 } else { 760.0 }
    }

    /// From the left edge to the frames, so that frames above each other are aligned (px).
    pub fn left(self) -> f64 {
        if self.narrow() { 68.0 } else { 74.0 }
    }

    /// From a frame to the right edge, where nothing else is drawn there (px).
    pub fn right(self) -> f64 {
        if self.narrow() { 14.0 } else { 28.0 }
    }

    /// Height of title and second line at the top (px).
    pub fn head(self) -> f64 {
        if self.paper == Paper::File { 60.0 } else { 8.0 }
    }
}
