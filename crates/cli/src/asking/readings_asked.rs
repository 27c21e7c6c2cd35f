//! Which questions does `sweetspot calibrate` ask? It makes a readings file of the answers.

use std::io::BufRead;

use serde_json::{Value, json};

use sweetspot::Bat;
use sweetspot::base::error::Complaint;
use sweetspot::base::number::rounded;
use sweetspot::base::typed;
use sweetspot::base::units::{self, Quantity, inches};
use sweetspot_report::schema;
use sweetspot_study::files::amounts::{deviation, with_deviation};

use crate::asking::ask;
use crate::asking::dialogue::{Asked, Dialogue, Question, Read};

const WELCOME: &str = "What was measured of the bat. An empty line takes what stands in [ ]; ? explains a \
                       question, back goes to the one before, quit leaves.";

/// The answers as the text of a readings file.
pub fn asked<R: BufRead>(person: &mut Dialogue<R>, bat: &Bat) -> Asked<String> {
    let question = |name| Question::named("calibrate", name);
    person.say(WELCOME);
    let unit = if bat.inches() { "in" } else { "cm" };
    let length = if bat.inches() { inches(bat.length()) } else { 100.0 * bat.length() };
    let mass =
        person.ask(&question("mass"), |text| within(text, "oz", Quantity::Mass, ask::mass))?;
    let place = |text: &str| ask::balance(text, length, unit);
    let balance = |text: &str| within(text, unit, Quantity::Length, place);
    let balance = person.ask(&question("balance").of(unit), balance)?;
    let swings = person.ask(&question("swings"), |text| number(text, "s", [3.0, 50.0]))?;
    let tones = person.ask(&question("tones"), tones)?;
    let cycles = person.ask(&question("ring"), |text| number(text, "", [1.0, 10_000.0]))?;
    let mut file = json!({ "format": "sweetspot-readings/1" });
    let mut put = |key: &str, value: Option<Value>| {
        if let Some(value) = value {
            file[key] = value;
        }
    };
    put("mass", mass.map(Value::from));
    put("balance_point", balance.map(Value::from));
    put("pendulum", swings.map(|ten| json!({ "pivot": "6 in", "period": rounded(0.1 * ten, 9) })));
    let lines: Vec<Value> = tones.into_iter().map(|hz| json!({ "hz": hz })).collect();
    put("lines", (!lines.is_empty()).then(|| Value::from(lines)));
    put("ring_down", cycles.map(|n| json!([{ "mode": 1, "cycles": n, "ratio": 0.5 }])));
    Ok(schema::text(&file))
}

/// A reading, with an optional error: `22.8 in ± 1/32 in`. Bare numbers are in `unit`.
fn within(
    text: &str,
    unit: &str,
    quantity: Quantity,
    read: impl Fn(&str) -> Read<Option<String>>,
) -> Read<Option<String>> {
    let Some((first, second)) = with_deviation(text) else { return read(text) };
    let Some(said) = read(first)? else { return Ok(None) };
    let second = match typed::number(second) {
        Some(_) if typed::split(&typed::plain(first)).1.is_empty() => format!("{second} {unit}"),
        _ => second.to_owned(),
    };
    let value = units::parse(&said, quantity)?;
    let by = deviation(value, (&said, &second), quantity)?;
    if by > 0.0 && by < value {
        Ok(Some(format!("{said} ± {second}")))
    } else {
        let expected = "an uncertainty above 0 and below the reading";
        Err(Complaint::new("", format!("\"{text}\""), expected))
    }
}

/// A number in that range with or without its unit; `None` if it is not known.
fn number(text: &str, unit: &str, [low, high]: [f64; 2]) -> Read<Option<f64>> {
    if ask::unknown(text) {
        return Ok(None);
    }
    let bare = text.strip_suffix(unit).unwrap_or(text);
    match typed::number(bare).filter(|value| (low..=high).contains(value)) {
        Some(value) => Ok(Some(value)),
        None => {
            let expected = format!("a number from {low} to {high} {unit}");
            Err(Complaint::new("", format!("\"{text}\""), expected.trim_end()))
        }
    }
}

/// Rising frequencies (Hz); empty if they are not known.
fn tones(text: &str) -> Read<Vec<f64>> {
    if ask::unknown(text) {
        return Ok(vec![]);
    }
    let parts = text.trim_end_matches("Hz").split([' ', ';', ',']).filter(|part| !part.is_empty());
    let values: Option<Vec<f64>> = parts.map(|part| part.parse().ok()).collect();
    let possible = |values: &Vec<f64>| {
        values.iter().all(|hz| (10.0..20e3).contains(hz)) && values.is_sorted_by(|a, b| a < b)
    };
    values.filter(|values| !values.is_empty() && possible(values)).ok_or_else(|| {
        let expected = "rising frequencies from 10 to 20000 Hz, such as: 174.5, 581.3, 1187";
        Complaint::new("", format!("\"{text}\""), expected)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use sweetspot_study::files::readings_file::ReadingsForm;
    use sweetspot_study::files::written::WrittenFile;

    #[test]
    fn answers_are_a_readings_file() {
        let bat = r#"{ "format": "sweetspot-bat/1", "material": "white-ash",
            "profile": { "unit": "in", "x": [0, 33], "diameter": [1.7, 1.7] } }"#;
        let bat = Bat::from_text("bat.json", bat, "".as_ref()).unwrap();
        let answers =
            "31 oz ± 0.1\n?\n16.5 in ± 1/32 in\nlong\n14.7 s\n581, 174\n174.5, 581.3\n40\n";
        let text =
            Dialogue::new(answers.as_bytes()).hold(|person| asked(person, &bat)).unwrap().unwrap();
        let read = ReadingsForm::from_text("answers", &text, "".as_ref()).unwrap();
        assert!((read.pendulum.unwrap().period.value - 1.47).abs() < 1e-12);
        assert_eq!(read.lines.len(), 2);
        assert_eq!(read.ring_down[0].cycles, 40.0);
        let balance = read.balance_point.unwrap();
        assert!((balance.value - 16.5 * 0.0254).abs() < 1e-12);
        assert!((balance.deviation - 0.0254 / 32.0).abs() < 1e-12);
        assert!((read.mass.unwrap().deviation - 0.1 * 0.028_349_523_125).abs() < 1e-12);
        let nothing = "\n\n\n\n\n";
        let text =
            Dialogue::new(nothing.as_bytes()).hold(|person| asked(person, &bat)).unwrap().unwrap();
        assert_eq!(
            ReadingsForm::from_text("answers", &text, "".as_ref()).unwrap(),
            Default::default()
        );
    }
}
