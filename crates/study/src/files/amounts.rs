//! How a share, and a reading with its uncertainty, is written down.

use crate::calibrate::readings::Reading;
use sweetspot::base::error::{Complaint, Result};
use sweetspot::base::typed;
use sweetspot::base::units::{self, Quantity};
use sweetspot::files::json_node::Node;

/// Marks between a reading and how far it may be off.
const MARKS: [&str; 3] = ["±", "+/-", "+-"];

/// The parts of a reading that is followed by how far it may be off.
pub fn with_deviation(text: &str) -> Option<(&str, &str)> {
    let (first, second) = MARKS.iter().find_map(|mark| text.split_once(mark))?;
    Some((first.trim(), second.trim()))
}

/// How far a reading (SI) may be off that was written so: `second` a share, a bare number in the unit of the first,
/// or with its own.
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

/// A share as a number or in per cent, `0.04` or `"4 %"`, from 0 to 1, the ends excluded.
pub(crate) fn share(node: &Node) -> Result<f64> {
    let expected = "a share such as \"4 %\" or 0.04";
    let value = match node.string() {
        Ok(text) => percent(&text),
        Err(_) => node.number().ok(),
    };
    match value {
        Some(value) if value > 0.0 && value < 1.0 => Ok(value),
        _ => Err(node.error(node.shown(), format!("{expected}, above 0 and below 1"))),
    }
}

/// The value of `"4 %"`; None for a text without the sign.
pub(crate) fn percent(text: &str) -> Option<f64> {
    let number = text.trim().strip_suffix('%')?;
    typed::number(number).map(|value| 0.01 * value)
}

/// A reading with or without its standard deviation: `"0.869 kg ± 1 g"`, `"174.5 Hz ± 0.2 %"`, `"0.869 kg"` or a
/// number in SI; without it as `usual`. The reading is in that range.
///
/// # Errors
///
/// What is wrong with one of both.
pub(crate) fn reading(
    node: &Node,
    quantity: Quantity,
    usual: f64,
    [low, high]: [f64; 2],
) -> Result<Reading> {
    let of = |value: f64, deviation: f64| {
        let si = quantity.si().0;
        if !(low..=high).contains(&value) {
            let expected = format!("{} from {low} to {high} {si}", quantity.name());
            return Err(node.error(node.shown(), expected));
        }
        if !(deviation > 0.0 && deviation < value) {
            let expected = "an uncertainty above 0 and below the reading";
            return Err(node.error(node.shown(), expected));
        }
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

#[cfg(test)]
mod tests {
    use super::*;
    use sweetspot::files::document::Document;

    fn read(text: &str) -> Result<Reading> {
        let text = format!("{{ \"mass\": {text} }}");
        let document = Document::new("readings.json".into(), &text);
        let root = Node::root(&document)?.members()?;
        let node = root.get("mass").expect("a member");
        reading(node, Quantity::Mass, 1e-3, [0.1, 5.0])
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
            let found = read(text).unwrap();
            assert!((found.value - value).abs() < 1e-15, "{text} {found:?}");
            assert!((found.deviation - deviation).abs() < 1e-15, "{text} {found:?}");
        }
        for wrong in
            ["\"0.8 ± 1 g\"", "\"0.8 kg ± 0 g\"", "\"0.8 kg ± 1 mm\"", "9", "\"1 kg ± 2 kg\""]
        {
            assert!(read(wrong).is_err(), "{wrong}");
        }
    }
}
