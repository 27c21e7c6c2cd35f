//! A cell of a table: its content, and how a quantity is shown.

use sweetspot::base::marks;
use sweetspot::base::number::{rounded, shortest, signed};
use sweetspot::base::units::{
    FOOT_POUND, INCH, POUND_FORCE, inches, miles_per_hour, ounce_square_inches, ounces,
};
use sweetspot_study::answers::Answer;
use sweetspot_study::trade::words::time;

use crate::parts::units::Units;

/// The content of a cell.
#[derive(Debug, Clone, PartialEq)]
pub enum Cell {
    /// A number, in SI.
    Number(f64),
    /// A word or more.
    Words(String),
    /// Text that is shown as it is: a count, a yes or no, a formatted number.
    Written(String),
    /// No known value.
    Empty,
}

impl Cell {
    /// The cell in a file: a number reads back to the same bits, and a text that a spreadsheet would evaluate has an
    /// apostrophe before it.
    pub fn in_file(self) -> String {
        match self {
            Self::Number(value) => shortest(value),
            Self::Words(text) => marks::cell(&text),
            Self::Written(text) => text,
            Self::Empty => String::new(),
        }
    }
}

impl From<f64> for Cell {
    fn from(value: f64) -> Self {
        Self::Number(value)
    }
}

impl From<usize> for Cell {
    fn from(value: usize) -> Self {
        Self::Written(value.to_string())
    }
}

impl From<bool> for Cell {
    fn from(value: bool) -> Self {
        Self::Written(value.to_string())
    }
}

impl From<&str> for Cell {
    fn from(value: &str) -> Self {
        Self::Words(value.to_owned())
    }
}

impl From<String> for Cell {
    fn from(value: String) -> Self {
        Self::Words(value)
    }
}

impl<T: Into<Self>> From<Option<T>> for Cell {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Empty, Into::into)
    }
}

/// What a number counts, which determines its units and digits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// A place or a length along the bat (m): cm or in.
    Length,
    /// A small length (m): mm or in.
    Small,
    /// A speed (m/s): m/s or mph.
    Speed,
    /// A mass (kg): g or oz.
    Mass,
    /// A moment of inertia (kg m²): kg m² or oz in².
    Inertia,
    /// A force (N): kN or lbf.
    Force,
    /// A stiffness (N/m): MN/m or lbf/in.
    Stiffness,
    /// An acceleration (m/s²): m/s² or ft/s².
    Acceleration,
    /// An impulse (N s): N s or lbf s.
    Impulse,
    /// An energy (J): J or ft·lbf.
    Energy,
    /// A frequency (Hz).
    Frequency,
    /// An angular speed (rad/s).
    Turning,
    /// A number without a unit, with the given number of decimals.
    Ratio(usize),
    /// An error bound: one digit and its power of ten.
    Error,
    /// A time (s), with three digits and the unit that suits it.
    Time,
    /// Words.
    Words,
}

/// A unit in which people read a quantity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    /// Its number per SI unit.
    pub per: f64,
    /// Usual decimals of a value.
    pub decimals: usize,
    /// Its name; empty for a number without a unit.
    pub name: &'static str,
}

impl Scale {
    /// A value in SI, in this unit; 0 is never −0.
    pub fn value(self, value: f64) -> String {
        fixed(self.per * value, self.decimals)
    }

    /// A value in SI, with this unit.
    pub fn text(self, value: f64) -> String {
        format!("{} {}", self.value(value), self.name).trim_end().to_owned()
    }

    /// A change in SI with its sign, with this unit.
    pub fn change(self, change: f64) -> String {
        format!("{} {}", signed(self.per * change, self.decimals), self.name)
    }

    /// The unit with one more decimal.
    pub fn finer(self) -> Self {
        Self { decimals: self.decimals + 1, ..self }
    }
}

impl Quantity {
    /// The quantity of an answer.
    pub fn of(answer: Answer) -> Self {
        Self::in_si(answer.unit()).unwrap_or(Self::Ratio(4))
    }

    /// The quantity with that SI unit; None for one that people count in no other unit.
    pub fn in_si(unit: &str) -> Option<Self> {
        match unit {
            "m" => Some(Self::Length),
            "m/s" => Some(Self::Speed),
            "m/s²" => Some(Self::Acceleration),
            "kg" => Some(Self::Mass),
            "kg m²" | "kg_m2" => Some(Self::Inertia),
            "Hz" => Some(Self::Frequency),
            _ => None,
        }
    }

    /// Its unit, in SI or in US units.
    pub fn scale(self, us: bool) -> Scale {
        let of = |per, decimals, name| Scale { per, decimals, name };
        match (self, us) {
            (Self::Length, false) => of(100.0, 2, "cm"),
            (Self::Length, true) => of(inches(1.0), 2, "in"),
            (Self::Small, false) => of(1e3, 1, "mm"),
            (Self::Small, true) => of(inches(1.0), 2, "in"),
            (Self::Speed, false) => of(1.0, 2, "m/s"),
            (Self::Speed, true) => of(miles_per_hour(1.0), 1, "mph"),
            (Self::Mass, false) => of(1e3, 1, "g"),
            (Self::Mass, true) => of(ounces(1.0), 2, "oz"),
            (Self::Inertia, false) => of(1.0, 4, "kg m²"),
            (Self::Inertia, true) => of(ounce_square_inches(1.0), 0, "oz in²"),
            (Self::Force, false) => of(1e-3, 2, "kN"),
            (Self::Force, true) => of(1.0 / POUND_FORCE, 0, "lbf"),
            (Self::Stiffness, false) => of(1e-6, 1, "MN/m"),
            (Self::Stiffness, true) => of(INCH / POUND_FORCE, 0, "lbf/in"),
            (Self::Acceleration, false) => of(1.0, 0, "m/s²"),
            (Self::Acceleration, true) => of(1.0 / (12.0 * INCH), 0, "ft/s²"),
            (Self::Impulse, false) => of(1.0, 3, "N s"),
            (Self::Impulse, true) => of(1.0 / POUND_FORCE, 3, "lbf s"),
            (Self::Energy, false) => of(1.0, 2, "J"),
            (Self::Energy, true) => of(1.0 / FOOT_POUND, 2, "ft·lbf"),
            (Self::Frequency, _) => of(1.0, 1, "Hz"),
            (Self::Turning, _) => of(1.0, 2, "rad/s"),
            (Self::Ratio(decimals), _) => of(1.0, decimals, ""),
            (Self::Error | Self::Time | Self::Words, _) => of(1.0, 0, ""),
        }
    }

    /// A cell as text for people, without its unit.
    pub fn shown(self, cell: &Cell, us: bool) -> String {
        match (self, cell) {
            (_, Cell::Words(text) | Cell::Written(text)) => text.clone(),
            (_, Cell::Empty) => String::new(),
            (Self::Error, Cell::Number(value)) => format!("{value:.0e}"),
            (Self::Time, Cell::Number(value)) => time(*value),
            (Self::Words, Cell::Number(value)) => value.to_string(),
            (_, Cell::Number(value)) => self.scale(us).value(*value),
        }
    }

    /// A value in SI with its unit, in one system of units or in both, the second in brackets.
    pub fn said(self, units: Units, value: f64) -> String {
        self.in_both(units, |scale| scale.text(value))
    }

    /// A deviation to two digits, with its unit, likewise.
    pub fn about(self, units: Units, value: f64) -> String {
        self.in_both(units, |Scale { per, name, .. }| {
            let rounded: f64 = format!("{:.1e}", per * value).parse().unwrap_or(value);
            format!("{rounded:.*} {name}", two_digits(per * value))
        })
    }

    /// Values in SI as running text, the unit after the last, likewise.
    pub fn listed(self, units: Units, values: &[f64]) -> String {
        self.in_both(units, |scale| {
            let shown: Vec<String> = values.iter().map(|value| scale.value(*value)).collect();
            format!("{} {}", shown.join(", "), scale.name)
        })
    }

    /// What is said of each unit, likewise.
    pub fn in_both(self, units: Units, say: impl Fn(Scale) -> String) -> String {
        let [si, us] = [false, true].map(|us| say(self.scale(us)));
        if si == us { si } else { units.beside(si, us) }
    }
}

/// The unit in which people read an SI unit, and its number per SI unit.
pub fn in_trade(unit: &str, us: bool) -> (&str, f64) {
    let scale = Quantity::in_si(unit).map(|quantity| quantity.scale(us));
    scale.map_or((unit, 1.0), |Scale { per, name, .. }| (name, per))
}

/// Decimals that show two significant digits of a value.
pub fn two_digits(value: f64) -> usize {
    let rounded: f64 = format!("{value:.1e}").parse().unwrap_or(value);
    let power = if rounded > 0.0 { rounded.log10().floor() as i32 } else { 0 };
    (1 - power).clamp(0, 9) as usize
}

/// A number with that many decimals, or with a power of ten where that would be all zeros or very long; 0 is never −0.
pub fn fixed(value: f64, decimals: usize) -> String {
    let size = value.abs();
    match size == 0.0 || (10.0_f64.powi(-(decimals as i32))..1e6).contains(&size) {
        true => format!("{:.decimals$}", rounded(value, decimals as i32)),
        false => format!("{value:.2e}"),
    }
}
