//! Numbers as a person reads them: in SI or in US units, errors as powers of ten.

use crate::parts::Units;
use sweetspot::base::number::rounded;
use sweetspot::base::units::{POUND_FORCE, inches, ounce_square_inches, ounces};

/// The sign for a missing number.
pub const NONE: &str = "–";

/// A length along the bat (m), without its unit.
pub fn bare(units: Units, x: f64) -> String {
    let shown = |value: f64, places: i32| format!("{:.*}", places as usize, rounded(value, places));
    units.show(shown(100.0 * x, 1), shown(inches(x), 2))
}

/// A length along the bat (m).
pub fn length(units: Units, x: f64) -> String {
    format!("{} {}", bare(units, x), length_unit(units))
}

/// The unit of lengths along the bat.
pub fn length_unit(units: Units) -> &'static str {
    if units == Units::Us { "in" } else { "cm" }
}

/// A mass (kg).
pub fn mass(units: Units, value: f64) -> String {
    units.show(format!("{:.1} g", 1e3 * value), format!("{:.2} oz", ounces(value)))
}

/// A moment of inertia (kg m²).
pub fn inertia(units: Units, value: f64) -> String {
    units.show(format!("{value:.4} kg m²"), format!("{:.0} oz in²", ounce_square_inches(value)))
}

/// An impulse (N s).
pub fn impulse(units: Units, value: f64) -> String {
    units.show(format!("{value:.3} N s"), format!("{:.3} lbf s", value / POUND_FORCE))
}

/// A number with that many decimals, or with a power of ten where that would be all zeros or very long; 0 is not −0.
pub fn decimals(value: f64, decimals: i32) -> String {
    match value.abs() {
        0.0 | 1e-2..1e6 => {
            let shown = format!("{:.*}", decimals.max(0) as usize, rounded(value, decimals));
            shown.replace('-', "−")
        }
        _ => scientific(value, 2),
    }
}

/// A value as it was read, with as few digits as needed to read back the same bits.
pub fn plain(value: f64) -> String {
    match value.abs() {
        0.0 | 1e-3..1e6 => value.to_string(),
        _ => {
            let text = format!("{value:e}");
            let (mantissa, power) = text.split_once('e').unwrap_or((&text, "0"));
            ten_to(mantissa, power)
        }
    }
}

/// A value with seven digits, without zeros at its end.
pub fn digits(value: f64) -> String {
    plain(format!("{value:.6e}").parse().unwrap_or(value))
}

/// An error: one digit and its power of ten.
pub fn error(value: f64) -> String {
    if value == 0.0 { "0".to_owned() } else { scientific(value, 0) }
}

/// `1.2 × 10⁻⁶`
pub fn scientific(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$e}");
    let (mantissa, power) = text.split_once('e').unwrap_or((&text, "0"));
    ten_to(mantissa, power)
}

/// A text of this program as a page sets it: `1e-4` as 10⁻⁴.
pub fn typeset(text: &str) -> String {
    let parts = text.split_inclusive([' ', '(', ')', ',', ';']);
    let part = |part: &str| {
        let end = part.trim_end_matches([' ', '(', ')', ',', ';', '.', ':']).len();
        let (word, rest) = part.split_at(end);
        let number = |word: &str| {
            let (mantissa, power) = word.split_once('e')?;
            let digits = |text: &str| !text.is_empty() && text.chars().all(|c| c.is_ascii_digit());
            let sound = mantissa.split('.').all(digits) && digits(power.trim_start_matches('-'));
            sound.then(|| ten_to(mantissa.strip_suffix(".0").unwrap_or(mantissa), power))
        };
        number(word).unwrap_or(word.to_owned()) + rest
    };
    parts.map(part).collect()
}

/// A text of this program typeset as a sentence: a capital first, a full stop last.
pub fn sentence(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|c| c.to_uppercase().to_string()).unwrap_or_default();
    let end = if text.ends_with(['.', '!', '?']) { "" } else { "." };
    typeset(&format!("{first}{}{end}", letters.as_str()))
}

fn ten_to(mantissa: &str, power: &str) -> String {
    let raised = |c: char| match c.to_digit(10) {
        Some(digit) => ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][digit as usize],
        None => '⁻',
    };
    let power: String = power.chars().map(raised).collect();
    let mantissa = mantissa.replace('-', "−");
    match (mantissa.as_str(), power.as_str()) {
        (_, "⁰") => mantissa,
        ("1", _) => format!("10{power}"),
        _ => format!("{mantissa} × 10{power}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_as_a_person_writes_them() {
        assert_eq!(error(2.4e-6), "2 × 10⁻⁶");
        assert_eq!(error(1e-4), "10⁻⁴");
        assert_eq!(error(0.0), "0");
        assert_eq!(plain(1.814e10), "1.814 × 10¹⁰");
        assert_eq!(plain(649.0), "649");
        assert_eq!(plain(0.5), "0.5");
        assert_eq!(decimals(-0.001, 1), "−1.00 × 10⁻³");
        assert_eq!(decimals(-0.0, 1), "0.0");
        assert_eq!(
            typeset("within 1.5e-4, x (3.0e-3 m/s) e2 2e"),
            "within 1.5 × 10⁻⁴, x (3 × 10⁻³ m/s) e2 2e"
        );
        assert_eq!(sentence("hands: none, 1e-4"), "Hands: none, 10⁻⁴.");
        assert_eq!(length(Units::Si, 0.3048), "30.5 cm");
        assert_eq!(length(Units::Us, 0.3048), "12.00 in");
    }
}
