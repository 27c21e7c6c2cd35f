//! How a share, and a reading with its uncertainty, is written down.

use schemars::JsonSchema;

use crate::calibrate::readings::Reading;
use crate::engine::{Amount, Complaint, Node, Quantity, Result, typed, units};
use crate::files::form::{Form, sound};

/// Marks between a reading and its standard deviation.
const MARKS: [&str; 3] = ["±", "+/-", "+-"];

/// The two parts of a reading with a standard deviation.
pub fn with_deviation(text: &str) -> Option<(&str, &str)> {
    let (first, second) = MARKS.iter().find_map(|mark| text.split_once(mark))?;
    Some((first.trim(), second.trim()))
}

/// The standard deviation (SI) of a reading: `second` is a share, a bare number in the unit of the first, or has its
/// own unit.
///
/// # Errors
///
/// What is wrong with it.
pub fn deviation(
    value: f64,
    (first, second): (&str, &str),
    quantity: Quantity,
) -> std::result::Result<f64, Complaint> {
    match (percent(second), typed::number(second)) {
        (Some(share), _) => Ok(share * value),
        (None, Some(number)) => {
            let unit = typed::split(&typed::plain(first)).1.to_owned();
            Ok(number * units::factor(&unit, quantity)?)
        }
        (None, None) => units::parse(second, quantity),
    }
}

/// A share, as a number or as a text in per cent.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(untagged)]
pub enum ShareForm {
    /// Such as 0.04.
    Number(f64),
    /// Such as 4 %.
    Text(#[schemars(regex(pattern = "%\\s*$"))] String),
}

/// A share as a number or in per cent, `0.04` or `"4 %"`, from 0 to 1, the ends excluded.
pub(crate) fn share() -> Form<f64> {
    Form::of::<ShareForm>(|node| {
        let value = match node.string() {
            Ok(text) => percent(&text),
            Err(_) => node.number().ok(),
        };
        let value = value.filter(|value| *value > 0.0 && *value < 1.0);
        let expected = "a share such as \"4 %\" or 0.04, above 0 and below 1";
        value.ok_or_else(|| node.error(node.shown(), expected))
    })
}

/// The value of `"4 %"`; None for a text without the sign.
pub(crate) fn percent(text: &str) -> Option<f64> {
    let number = text.trim().strip_suffix('%')?;
    typed::number(number).map(|value| 0.01 * value)
}

/// A reading: a bare number in SI, or a text with its unit, optionally with its standard deviation after ±, +/- or +-,
/// in its own unit, in that of the reading, or in per cent.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(untagged)]
pub enum UncertainAmount {
    /// In SI.
    Number(f64),
    /// With its unit.
    Text(String),
}

/// A reading with or without its standard deviation: `"0.869 kg ± 1 g"`, `"174.5 Hz ± 0.2 %"`, `"0.869 kg"` or a
/// number in SI; without it as `usual`. The reading is in that range.
pub(crate) fn reading(quantity: Quantity, usual: f64, range: [f64; 2]) -> Form<Reading> {
    let read = move |node: &Node| read(node, quantity, usual, range);
    Form::of::<UncertainAmount>(read).measuring(quantity)
}

fn read(node: &Node, quantity: Quantity, usual: f64, [low, high]: [f64; 2]) -> Result<Reading> {
    let of = |value: f64, deviation: f64| {
        let expected = format!("{} from {low} to {high} {}", quantity.name(), quantity.si().0);
        sound(node, (low..=high).contains(&value), &expected)?;
        let expected = "an uncertainty above 0 and below the reading";
        sound(node, deviation > 0.0 && deviation < value, expected)?;
        Ok(Reading { value, deviation })
    };
    let text = match node.string() {
        Ok(text) => text,
        Err(_) => return of(node.quantity(quantity)?, usual),
    };
    let complain = |complaint: Complaint| node.complain(complaint);
    let Some(parts) = with_deviation(&text) else {
        return of(units::parse(&text, quantity).map_err(complain)?, usual);
    };
    let value = units::parse(parts.0, quantity).map_err(complain)?;
    let deviation = deviation(value, parts, quantity).map_err(complain)?;
    of(value, deviation)
}

/// A member of the scene.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(untagged)]
pub enum Said {
    /// A number in SI, or a text with its unit.
    Amount(Amount),
    /// A word, such as the model.
    Word(#[schemars(regex(pattern = "^[a-z-]+$"))] String),
}

#[cfg(test)]
mod tests {
    use super::*;
    use sweetspot::files::document::Document;

    fn reading_of(text: &str) -> Result<Reading> {
        let text = format!("{{ \"mass\": {text} }}");
        let document = Document::new("readings.json".into(), &text);
        let root = Node::root(&document)?.members()?;
        let node = root.get("mass").expect("a member");
        reading(Quantity::Mass, 1e-3, [0.1, 5.0]).read(node)
    }

    #[test]
    fn readings_are_read_as_they_are_typed() {
        for (text, value, deviation) in [
            ("\"0.869 kg ± 1 g\"", 0.869, 1e-3),
            ("\"869 g +/- 2\"", 0.869, 2e-3),
            ("\"0.8 kg +- 1 %\"", 0.8, 8e-3),
            ("\"0.8 kg\"", 0.8, 1e-3),
            ("0.8", 0.8, 1e-3),
        ] {
            let found = reading_of(text).unwrap();
            assert!((found.value - value).abs() < 1e-15, "{text} {found:?}");
            assert!((found.deviation - deviation).abs() < 1e-15, "{text} {found:?}");
        }
        for wrong in
            ["\"0.8 ± 1 g\"", "\"0.8 kg ± 0 g\"", "\"0.8 kg ± 1 mm\"", "9", "\"1 kg ± 2 kg\""]
        {
            assert!(reading_of(wrong).is_err(), "{wrong}");
        }
    }
}
