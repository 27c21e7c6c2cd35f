//! The sheet of a picture: the units and the available room.

use crate::parts::{Quantity, Scale};
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

    fn unit(self, quantity: Quantity) -> Unit {
        let Scale { name, per, .. } = quantity.scale(self.us);
        Unit { name, per }
    }

    /// Lengths along and across a bat.
    pub fn length(self) -> Unit {
        self.unit(Quantity::Length)
    }

    /// The unit of small lengths, such as the compression of a ball.
    pub fn small(self) -> Unit {
        self.unit(Quantity::Small)
    }

    /// Forces.
    pub fn force(self) -> Unit {
        self.unit(Quantity::Force)
    }

    /// Speeds.
    pub fn speed(self) -> Unit {
        self.unit(Quantity::Speed)
    }

    /// Energies.
    pub fn energy(self) -> Unit {
        self.unit(Quantity::Energy)
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
