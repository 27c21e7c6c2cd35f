//! Modes as a laboratory measured them.

use faer::c64;

use crate::named::named;

/// Measured modes, all at the same points.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Measured {
    /// The file they are from, for people.
    pub source: String,
    /// Measured modes, by rising frequency.
    pub modes: Vec<MeasuredMode>,
    /// Positions of the points along the bat's axis (m), rising, in the file's direction and from its origin; empty if
    /// there are only frequencies.
    pub along: Vec<f64>,
    /// Whether the file says that they count from the knob end.
    pub from_knob: bool,
    /// Assumptions in reading them, one sentence each.
    pub assumed: Vec<String>,
    /// The meaning of the frequencies if the file writes them in the other of Hz and rad/s; `None` if the unit is
    /// certain.
    pub otherwise: Option<Otherwise>,
}

named! {
    /// Unit of a file's frequencies.
    pub enum FrequencyUnit {
        /// Cycles a second.
        Hertz = "Hz",
        /// Radians a second.
        RadPerS = "rad/s",
    }
}

impl FrequencyUnit {
    /// How many Hz it is.
    pub fn hertz(self) -> f64 {
        match self {
            Self::Hertz => 1.0,
            Self::RadPerS => 1.0 / std::f64::consts::TAU,
        }
    }

    /// The other unit.
    pub fn other(self) -> Self {
        match self {
            Self::Hertz => Self::RadPerS,
            Self::RadPerS => Self::Hertz,
        }
    }
}

/// Another possible unit of a file's frequencies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Otherwise {
    /// The unit in which they were read.
    pub read_in: FrequencyUnit,
    /// Whether data of the file confirm it, beyond its format.
    pub settled: bool,
}

impl Otherwise {
    /// The factor to the frequencies if read in the other unit.
    pub fn factor(&self) -> f64 {
        self.read_in.other().hertz() / self.read_in.hertz()
    }
}

/// One measured mode.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredMode {
    /// Its name in the file.
    pub name: String,
    /// The number of the bending mode, if the file gives it.
    pub order: Option<usize>,
    /// Measured frequency (Hz).
    pub frequency: f64,
    /// Damping ratio, as a share of critical damping.
    pub damping_ratio: Option<f64>,
    /// Deflection at every point, in a unit of the laboratory's; empty where it was not measured.
    pub shape: Vec<c64>,
}

impl Measured {
    /// Whether there are shapes besides frequencies.
    pub fn has_shapes(&self) -> bool {
        !self.along.is_empty()
    }

    /// These modes with the frequencies read in the other unit, which is then certain.
    pub fn read_otherwise(mut self) -> Self {
        if let Some(otherwise) = self.otherwise.take() {
            self.modes.iter_mut().for_each(|mode| mode.frequency *= otherwise.factor());
            let unit = otherwise.read_in.other().name();
            let so = "so the shapes have the frequencies of modes like them";
            self.assumed.push(format!("the file's frequencies are taken as in {unit}: {so}"));
        }
        self
    }

    /// Sorts the points along the axis, and the modes by frequency.
    pub fn sorted(mut self) -> Self {
        let mut order: Vec<usize> = (0..self.along.len()).collect();
        order.sort_by(|a, b| self.along[*a].total_cmp(&self.along[*b]));
        self.along = order.iter().map(|k| self.along[*k]).collect();
        for mode in self.modes.iter_mut().filter(|mode| !mode.shape.is_empty()) {
            mode.shape = order.iter().map(|k| mode.shape[*k]).collect();
        }
        self.modes.sort_by(|a, b| a.frequency.total_cmp(&b.frequency));
        self
    }
}
