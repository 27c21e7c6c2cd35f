//! A cell of a table: its content, and how a quantity is shown.

use sweetspot::base::marks;
use sweetspot::base::number::{rounded, shortest};
use sweetspot::base::units::{inches, miles_per_hour};
use sweetspot_study::trade::words::time;

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

/// The kind of numbers in a column, which determines their units and digits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// A place or a length along the bat (m): cm or in.
    Length,
    /// A speed (m/s): m/s or mph.
    Speed,
    /// A number without a unit, with the given number of decimals.
    Ratio(usize),
    /// An error bound: one digit and its power of ten.
    Error,
    /// A time (s), with three digits and the unit that suits it.
    Time,
    /// Words.
    Words,
}

impl Quantity {
    /// Its unit, in SI or in US units; empty without one.
    pub fn unit(self, us: bool) -> &'static str {
        match (self, us) {
            (Self::Length, false) => "cm",
            (Self::Length, true) => "in",
            (Self::Speed, false) => "m/s",
            (Self::Speed, true) => "mph",
            (Self::Ratio(_) | Self::Error | Self::Time | Self::Words, _) => "",
        }
    }

    /// A cell as text for people, without its unit.
    pub fn shown(self, cell: &Cell, us: bool) -> String {
        let value = match cell {
            Cell::Number(value) => *value,
            Cell::Words(text) | Cell::Written(text) => return text.clone(),
            Cell::Empty => return String::new(),
        };
        let decimals = |value: f64, n: usize| format!("{:.n$}", rounded(value, n as i32));
        match (self, us) {
            (Self::Length, false) => decimals(100.0 * value, 2),
            (Self::Length, true) => decimals(inches(value), 2),
            (Self::Speed, false) => decimals(value, 2),
            (Self::Speed, true) => decimals(miles_per_hour(value), 1),
            (Self::Ratio(n), _) => decimals(value, n),
            (Self::Error, _) => format!("{value:.0e}"),
            (Self::Time, _) => time(value),
            (Self::Words, _) => value.to_string(),
        }
    }
}
