//! What is the unit of an answer, and how many digits are shown?

use crate::parts::Units;
use sweetspot::base::units::{inches, miles_per_hour, ounce_square_inches, ounces};
use sweetspot_study::answers::Answer;

/// The unit of an answer.
#[derive(Clone, Copy)]
pub enum AnswerUnit {
    Length,
    Speed,
    Mass,
    Inertia,
    Frequency,
}

impl AnswerUnit {
    pub fn of(answer: Answer) -> Self {
        match answer.unit() {
            "kg" => Self::Mass,
            "kg m²" => Self::Inertia,
            "Hz" => Self::Frequency,
            "m/s" => Self::Speed,
            _ => Self::Length,
        }
    }

    /// Units with their factors and the decimals of a value, in SI and in US units.
    fn scales(self) -> [(f64, usize, &'static str); 2] {
        match self {
            Self::Length => [(100.0, 2, "cm"), (inches(1.0), 2, "in")],
            Self::Speed => [(1.0, 2, "m/s"), (miles_per_hour(1.0), 1, "mph")],
            Self::Mass => [(1e3, 1, "g"), (ounces(1.0), 2, "oz")],
            Self::Inertia => [(1.0, 4, "kg m²"), (ounce_square_inches(1.0), 0, "oz in²")],
            Self::Frequency => [(1.0, 1, "Hz"), (1.0, 1, "Hz")],
        }
    }

    /// A value in both systems of units, or in one.
    fn said(self, units: Units, say: impl Fn(f64, usize) -> String) -> String {
        let [si, us] = self.scales();
        let told = |(factor, decimals, name): (f64, usize, &str)| {
            format!("{} {name}", say(factor, decimals))
        };
        match self {
            Self::Frequency => told(si),
            _ => units.beside(told(si), told(us)),
        }
    }

    pub fn shown(self, units: Units, value: f64) -> String {
        self.said(units, |factor, decimals| format!("{:.decimals$}", factor * value + 0.0))
    }

    /// A deviation to two digits.
    pub fn about(self, units: Units, value: f64) -> String {
        self.said(units, |factor, _| two_digits(factor * value))
    }
}

/// Two significant digits, including a last digit 0.
fn two_digits(value: f64) -> String {
    let rounded: f64 = format!("{value:.1e}").parse().unwrap_or(value);
    format!("{rounded:.*}", decimals(value))
}

/// Decimals that show two significant digits of a value.
pub fn decimals(value: f64) -> usize {
    let rounded: f64 = format!("{value:.1e}").parse().unwrap_or(value);
    let power = if rounded > 0.0 { rounded.log10().floor() as i32 } else { 0 };
    (1 - power).clamp(0, 9) as usize
}
