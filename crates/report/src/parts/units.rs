//! In which units are numbers shown?

use sweetspot::base::units::PSI;
use sweetspot::bat::body::Bat;

/// Which units the tables are in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Units {
    /// SI alone.
    Si,
    /// US units alone.
    Us,
    /// Both, side by side, SI first.
    Both,
    /// Both, side by side, US units first.
    BothUsFirst,
}

impl Units {
    /// These units for a bat: where both systems are shown, that of the file of the bat comes first.
    pub fn of(self, bat: &Bat) -> Self {
        match self {
            Self::Both if bat.inches() => Self::BothUsFirst,
            asked => asked,
        }
    }

    /// Whether US units come first, or alone.
    pub fn us_first(self) -> bool {
        matches!(self, Self::Us | Self::BothUsFirst)
    }

    /// Whether both systems are shown.
    pub fn both(self) -> bool {
        matches!(self, Self::Both | Self::BothUsFirst)
    }

    /// US units alone, or SI.
    pub fn one(us: bool) -> Self {
        if us { Self::Us } else { Self::Si }
    }

    /// The system that comes first, alone.
    pub fn first(self) -> Self {
        Self::one(self.us_first())
    }

    /// The shown ones of two values, in SI and in US units, in order.
    pub fn pick<T>(self, si: T, us: T) -> Vec<T> {
        match self {
            Self::Si => vec![si],
            Self::Us => vec![us],
            Self::Both => vec![si, us],
            Self::BothUsFirst => vec![us, si],
        }
    }

    /// A value in SI, in US units, or in both with the second in brackets.
    pub fn beside(self, si: String, us: String) -> String {
        match &self.pick(si, us)[..] {
            [first, second] => format!("{first} ({second})"),
            one => one.concat(),
        }
    }

    /// A stress, given in Pa, shown in MPa with that number of decimals and in whole psi.
    pub fn stress(self, pascals: f64, decimals: usize) -> String {
        let psi = format!("{:.0} psi", pascals / PSI);
        self.beside(format!("{:.decimals$} MPa", 1e-6 * pascals), psi)
    }
}
