//! Questions to a person with a bat, a ruler, calipers and a scale.

use std::io::{BufRead, Write};

use sweetspot::error::{Error, Result, nearest};
use sweetspot::material::BUILT_IN;
use sweetspot::report::text::wrapped;
use sweetspot::units::{self, Quantity, inches};

/// Whoever answers, line by line; questions go to standard error.
pub struct Dialogue<R> {
    answers: R,
}

/// What an answer means, or why it is none.
type Read<T> = std::result::Result<T, String>;

impl<R: BufRead> Dialogue<R> {
    pub fn new(answers: R) -> Self {
        Self { answers }
    }

    /// Says something that is no question.
    pub fn say(&self, text: &str) {
        // Without standard error the questions are not seen; the answers may come all the same.
        let _ = writeln!(std::io::stderr(), "{text}");
    }

    /// Asks until the answer is one; `usual` is what an empty line means.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] at the end of the answers.
    pub fn ask<T>(
        &mut self,
        question: &str,
        usual: Option<&str>,
        read: impl Fn(&str) -> Read<T>,
    ) -> Result<T> {
        let hint = usual.filter(|usual| !usual.is_empty());
        let hint = hint.map_or(String::new(), |usual| format!(" [{usual}]"));
        loop {
            let _ = write!(std::io::stderr(), "{question}{hint}: ");
            let mut line = String::new();
            let failed = |source| Error::Read { path: "standard input".into(), source };
            if self.answers.read_line(&mut line).map_err(failed)? == 0 {
                let _ = writeln!(std::io::stderr());
                let expected = "an answer; nothing was written";
                return Err(Error::value(question.trim(), "the end of the answers", expected));
            }
            let answer = match (line.trim(), usual) {
                ("", Some(usual)) => usual,
                (answer, _) => answer,
            };
            match read(answer) {
                Ok(value) => return Ok(value),
                Err(reason) => self.say(&format!("  {reason}")),
            }
        }
    }

    /// Places and diameters from knob to tip, in `unit`, for a bat so long in it.
    ///
    /// # Errors
    ///
    /// As [`Self::ask`].
    pub fn stations(&mut self, length: f64, unit: &'static str) -> Result<Vec<[f64; 2]>> {
        let ruler = if unit == "in" { "inches" } else { unit };
        let how = format!(
            "Diameters in {ruler}, from the knob end to the tip. Measure at the place that is asked, \
             or answer with a place of your own and its diameter, such as: 2.5, 1.1. An empty line \
             goes on to the tip."
        );
        self.say(wrapped(&how, 0).trim_end());
        let mut stations: Vec<[f64; 2]> = Vec::new();
        for place in suggested(length, unit) {
            let last = stations.last().map_or(-1.0, |s| s[0]);
            if place > last {
                let usual = if stations.is_empty() { None } else { Some("") };
                let question = format!("  at {place} {unit}");
                let read = |text: &str| station(text, Some(place), [last, length], unit);
                match self.ask(&question, usual, read)? {
                    Some(measured) => stations.push(measured),
                    None => break,
                }
            }
        }
        if stations.last().is_none_or(|s| s[0] < length) {
            let last = stations.last().map_or(-1.0, |s| s[0]);
            let read = |text: &str| station(text, Some(length), [last, length], unit);
            let question = format!("  at the tip, {length} {unit}");
            let tip = self.ask(&question, None, |text| match read(text)? {
                Some([x, diameter]) if x == length => Ok([x, diameter]),
                _ => Err("the diameter at the tip closes the bat".into()),
            })?;
            stations.push(tip);
        }
        Ok(stations)
    }
}

/// Where bats change: close at the knob, then every few inches, and just before the tip.
fn suggested(length: f64, unit: &str) -> Vec<f64> {
    let (near, step): (&[f64], f64) = match unit {
        "in" => (&[0.0, 0.5, 1.0, 1.5, 3.0], 3.0),
        _ => (&[0.0, 1.0, 2.5, 4.0, 7.5], 7.5),
    };
    let rest = (2..).map(|k| f64::from(k) * step).take_while(|x| x + 0.3 * step < length);
    near.iter().copied().filter(|x| *x < length).chain(rest).chain([length]).collect()
}

/// A diameter at the suggested place, or a place and its diameter; None for an empty line. Places
/// rise from the last one, the first is 0, and none is beyond the tip.
pub fn station(
    text: &str,
    suggested: Option<f64>,
    [last, length]: [f64; 2],
    unit: &str,
) -> Read<Option<[f64; 2]>> {
    if text.is_empty() {
        let reason = "the knob end's diameter begins the bat";
        return if last < 0.0 { Err(reason.into()) } else { Ok(None) };
    }
    // Where a diameter alone will do, whoever writes 1,5 means one and a half.
    let comma = if suggested.is_some() { ", " } else { "," };
    let (x, diameter) = match (text.split_once(comma), suggested) {
        (Some((x, diameter)), _) => (measured(x, unit)?, diameter),
        (None, Some(x)) => (x, text),
        (None, None) => return Err(format!("{text}: expected a place and its diameter")),
    };
    let diameter = measured(diameter, unit)?;
    if last < 0.0 && x != 0.0 {
        return Err(format!("{x} {unit} is not the knob end: the first place is 0"));
    }
    if x < last {
        return Err(format!("{x} {unit} lies before {last} {unit}: places go from knob to tip"));
    }
    if x > length {
        return Err(format!("{x} {unit} is beyond the tip at {length} {unit}"));
    }
    let metres = in_metres(diameter, unit);
    if !(diameter >= 0.0 && metres <= 0.1) || (diameter == 0.0 && 0.0 < x && x < length) {
        return Err(format!("no bat has a diameter of {diameter} {unit} there"));
    }
    Ok(Some([x, diameter]))
}

fn in_metres(value: f64, unit: &str) -> f64 {
    value * units::factor(unit, Quantity::Length).unwrap_or(1.0)
}

/// A length in the ruler's unit: a bare number is in it, others are converted.
pub fn measured(text: &str, unit: &str) -> Read<f64> {
    let text = text.trim();
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        _ => {
            let metres = units::parse(text, Quantity::Length).map_err(|c| c.to_string())?;
            Ok(if unit == "in" { inches(metres) } else { 100.0 * metres })
        }
    }
}

/// The length of a bat in the ruler's unit.
pub fn length(text: &str, unit: &str) -> Read<f64> {
    let value = measured(text, unit)?;
    let metres = in_metres(value, unit);
    if (0.1..=2.0).contains(&metres) {
        return Ok(value);
    }
    Err(format!("{value} {unit} is no bat's length; 24 to 36 in (60 to 92 cm) are usual"))
}

/// A mass with its unit, as it was written.
pub fn mass(text: &str) -> Read<String> {
    if text.parse::<f64>().is_ok() {
        return Err(format!("{text} of what? Such as \"{text} oz\" or \"{text} g\""));
    }
    let with_unit = |found: &str| format!("found {found}, expected a mass such as \"31.5 oz\"");
    let kilograms = units::parse(text, Quantity::Mass).map_err(|c| with_unit(&c.found))?;
    if (0.1..=5.0).contains(&kilograms) {
        return Ok(text.to_owned());
    }
    Err(format!("{text} is no bat's mass; 20 to 40 oz (570 to 1130 g) are usual"))
}

/// A built-in material by its name or its number in the list, from 1.
pub fn material(text: &str) -> Read<String> {
    let names: Vec<&str> = BUILT_IN.iter().map(|material| material.name).collect();
    let by_number = text.parse::<usize>().ok().and_then(|k| names.get(k.checked_sub(1)?));
    match by_number.or_else(|| names.iter().find(|name| **name == text)) {
        Some(name) => Ok((*name).to_owned()),
        None => {
            let hint = nearest(text, &names).map(|near| format!("; did you mean {near}?"));
            let hint = hint.unwrap_or_default();
            Err(format!("\"{text}\" is not in the list: {}{hint}", names.join(", ")))
        }
    }
}

/// The list that [`material`] counts.
pub fn materials() -> String {
    let line = |(k, material): (usize, &sweetspot::material::BuiltIn)| {
        let modulus = 1e-9 * material.youngs_modulus;
        format!(
            "  {} {:<20} {:>6.0} kg/m³ {modulus:>6.1} GPa",
            k + 1,
            material.name,
            material.density
        )
    };
    BUILT_IN.iter().enumerate().map(line).collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wrong_answer_is_asked_again_and_the_end_of_answers_is_an_error() {
        let mut dialogue = Dialogue::new("31\nno\n31.5 oz\n".as_bytes());
        assert_eq!(dialogue.ask("Mass", None, mass).unwrap(), "31.5 oz");
        assert!(dialogue.ask("Mass", None, mass).is_err());
    }

    #[test]
    fn stations_rise_from_knob_to_tip() {
        let answers = "\n1.9\n0.2, 5\n0.75, 1.2\n0.5, 1\n1\n\n0\n";
        let stations = Dialogue::new(answers.as_bytes()).stations(33.0, "in").unwrap();
        // 5 in is too thick, 0.5 lies before 0.75, the tip may be a point.
        assert_eq!(stations, [[0.0, 1.9], [0.75, 1.2], [1.0, 1.0], [33.0, 0.0]]);
        assert_eq!(measured("2.54 cm", "in").map(|x| (x - 1.0).abs() < 1e-12), Ok(true));
        assert!(station("34, 2", None, [0.0, 33.0], "in").is_err());
    }

    #[test]
    fn suggested_places_rise_to_the_tip() {
        for (length, unit) in [(33.5, "in"), (24.0, "in"), (84.0, "cm")] {
            let places = suggested(length, unit);
            assert!(places.windows(2).all(|pair| pair[0] < pair[1]), "{places:?}");
            assert_eq!((places[0], places.last()), (0.0, Some(&length)));
        }
    }
}
