//! Questions to a person with a bat, a ruler, calipers and a scale.

use std::io::{BufRead, Read as _, Write};

use crate::base::error::{Complaint, Error, Result};
use crate::base::units::{self, Quantity, inches};
use crate::bat::material::BUILT_IN;
use crate::show::report::text::wrapped;

use crate::cli::value::{BAT_LENGTH, DIAMETER};

/// A person gives up sooner, and a program that answers without end is stopped.
const MOST_TRIES: usize = 50;
/// The longest line that is read at once (bytes).
const LONGEST: u64 = 1 << 16;

/// Whoever answers, line by line; questions go to standard error.
pub struct Dialogue<R> {
    answers: R,
}

/// What an answer means, or why it is invalid.
pub type Read<T> = std::result::Result<T, Complaint>;

impl<R: BufRead> Dialogue<R> {
    pub fn new(answers: R) -> Self {
        Self { answers }
    }

    /// Prints a line that asks nothing.
    pub fn say(&self, text: &str) {
        // Without standard error the questions are not seen; the answers may come all the same.
        let _ = writeln!(std::io::stderr(), "{text}");
    }

    /// Asks until the answer is one; `usual` is what an empty line means.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] at the end of the answers, or after too many wrong ones.
    pub fn ask<T>(
        &mut self,
        question: &str,
        usual: Option<&str>,
        read: impl Fn(&str) -> Read<T>,
    ) -> Result<T> {
        let hint = usual.filter(|usual| !usual.is_empty());
        let hint = hint.map_or(String::new(), |usual| format!(" [{usual}]"));
        for _ in 0..MOST_TRIES {
            let _ = write!(std::io::stderr(), "{question}{hint}: ");
            let mut line = String::new();
            let failed = |source| Error::Read { path: "standard input".into(), source };
            if (&mut self.answers).take(LONGEST).read_line(&mut line).map_err(failed)? == 0 {
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
                Err(complaint) => self.say(wrapped(&format!("  {complaint}"), 2).trim_end()),
            }
        }
        let found = format!("{MOST_TRIES} wrong answers, one after the other");
        Err(Error::value(question.trim(), found, "an answer; nothing was written"))
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
            if stations.last().is_none_or(|s| place > s[0]) {
                let usual = if stations.is_empty() { None } else { Some("") };
                let question = format!("  at {place} {unit}");
                let read = |text: &str| station(text, Some(place), &stations, length, unit);
                match self.ask(&question, usual, read)? {
                    Some(measured) => stations.push(measured),
                    None => break,
                }
            }
        }
        if stations.last().is_none_or(|s| s[0] < length) {
            let read = |text: &str| station(text, Some(length), &stations, length, unit);
            let question = format!("  at the tip, {length} {unit}");
            let tip = self.ask(&question, None, |text| match read(text)? {
                Some([x, diameter]) if x == length => Ok([x, diameter]),
                _ => Err(Complaint::new("", text, "the diameter at the tip, which ends the bat")),
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
/// rise from those `before`, the first is 0, none is beyond the tip, and two at one place between
/// are a step.
pub fn station(
    text: &str,
    suggested: Option<f64>,
    before: &[[f64; 2]],
    length: f64,
    unit: &str,
) -> Read<Option<[f64; 2]>> {
    let wrong = |found: String, expected: &str| Err(Complaint::new("", found, expected));
    if text.is_empty() {
        let expected = "the knob end's diameter, which begins the bat";
        return if before.is_empty() { wrong("nothing".into(), expected) } else { Ok(None) };
    }
    let (x, diameter) = match (apart(text, suggested.is_some()), suggested) {
        (Some((x, diameter)), _) => (measured(x, unit)?, diameter),
        (None, Some(x)) => (x, text),
        (None, None) => {
            let expected = "a place and its diameter, such as \"3 in, 0.98 in\"";
            return wrong(format!("\"{text}\""), expected);
        }
    };
    DIAMETER.sensible(diameter, unit)?;
    let diameter = measured(diameter, unit)?;
    after(before, x, length, unit)?;
    let metres = in_metres(diameter, unit);
    if !(0.0..=0.1).contains(&metres) || (diameter == 0.0 && 0.0 < x && x < length) {
        let found = format!("a diameter of {diameter} {unit} at {x} {unit}");
        return wrong(found, "that of a bat, above 0 and up to 3.9 in (10 cm)");
    }
    Ok(Some([x, diameter]))
}

/// Two numbers with a comma or blanks between them. Where a diameter alone would do, whoever writes
/// 1,5 may mean one and a half.
fn apart(text: &str, one_would_do: bool) -> Option<(&str, &str)> {
    let comma = if one_would_do && !text.contains('.') { ", " } else { "," };
    let number = |text: &str| units::number(text).is_some();
    let blank = || text.split_once(' ').map(|(x, diameter)| (x, diameter.trim()));
    text.split_once(comma).or_else(|| blank().filter(|(x, d)| number(x) && number(d)))
}

/// Whether a place may follow those before it.
fn after(before: &[[f64; 2]], x: f64, length: f64, unit: &str) -> Read<()> {
    let here = before.iter().filter(|station| station[0] == x).count();
    let (found, expected) = match before.last() {
        None if x != 0.0 => (String::new(), "0, the knob end, as the first place".to_owned()),
        Some([last, _]) if x < *last => {
            (format!(" after {last} {unit}"), "places from knob to tip".to_owned())
        }
        _ if x > length => (String::new(), format!("no place beyond the tip at {length} {unit}")),
        _ if here == 1 && (x == 0.0 || x == length) => {
            (" a second time".to_owned(), "one diameter at an end of the bat".to_owned())
        }
        _ if here > 1 => (" a third time".to_owned(), "two diameters at a step".to_owned()),
        _ => return Ok(()),
    };
    Err(Complaint::new("", format!("{x} {unit}{found}"), expected))
}

fn in_metres(value: f64, unit: &str) -> f64 {
    value * units::factor(unit, Quantity::Length).unwrap_or(1.0)
}

/// A length in the ruler's unit: a bare number is in it, others are converted.
pub fn measured(text: &str, unit: &str) -> Read<f64> {
    let text = text.trim();
    match units::number(text) {
        Some(value) => Ok(value),
        None => {
            let bare = || units::parse(&format!("{text} {unit}"), Quantity::Length);
            let metres = units::parse_beside(text, Quantity::Length, unit);
            let metres = metres.or_else(|complaint| bare().or(Err(complaint)))?;
            Ok(if unit == "in" { inches(metres) } else { 100.0 * metres })
        }
    }
}

/// The length of a bat in the ruler's unit.
pub fn length(text: &str, unit: &str) -> Read<f64> {
    BAT_LENGTH.sensible(text, unit)?;
    let value = measured(text, unit)?;
    if (0.1..=2.0).contains(&in_metres(value, unit)) {
        return Ok(value);
    }
    let expected = "a bat's length; 24 to 36 in (60 to 92 cm) are usual";
    Err(Complaint::new("", format!("{value} {unit}"), expected))
}

/// A mass with its unit, as it was written.
pub fn mass(text: &str) -> Read<String> {
    let kilograms = match units::number(text) {
        Some(_) => {
            let expected = format!("its unit, too, such as \"{text} oz\" or \"{text} g\"");
            return Err(Complaint::new("", text, expected));
        }
        None => units::parse(text, Quantity::Mass).map_err(|complaint| Complaint {
            expected: "a mass such as \"31.5 oz\"".into(),
            ..complaint
        })?,
    };
    if (0.1..=5.0).contains(&kilograms) {
        return Ok(text.to_owned());
    }
    Err(Complaint::new("", text, "a bat's mass; 20 to 40 oz (570 to 1130 g) are usual"))
}

/// A built-in material by its name or its number in the list, from 1.
pub fn material(text: &str) -> Read<String> {
    let names: Vec<&str> = BUILT_IN.iter().map(|material| material.name).collect();
    let by_number = text.parse::<usize>().ok().and_then(|k| names.get(k.checked_sub(1)?));
    if let Some(name) = by_number.or_else(|| names.iter().find(|name| **name == text)) {
        return Ok((*name).to_owned());
    }
    let like: Vec<&str> = names.iter().copied().filter(|name| name.contains(text)).collect();
    let complaint =
        Complaint::new("", format!("\"{text}\""), format!("one of {}", names.join(", ")));
    Err(match like[..] {
        [_, ..] if !text.is_empty() => {
            complaint.hinted(format!("did you mean {}?", like.join(" or ")))
        }
        _ => complaint.or_nearest(text, &names),
    })
}

/// The list that [`material`] counts.
pub fn materials() -> String {
    let line = |(k, material): (usize, &crate::bat::material::BuiltIn)| {
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
        assert!(station("34, 2", None, &[[0.0, 1.9]], 33.0, "in").is_err());
    }

    #[test]
    fn two_stations_at_one_place_are_a_step_and_three_are_none() {
        let answers = "1.9\n0, 1.8\n0.75, 1.9\n0.75, 1.2\n0.75, 0.9\n1\n\n2.5\n";
        let stations = Dialogue::new(answers.as_bytes()).stations(33.0, "in").unwrap();
        assert_eq!(stations, [[0.0, 1.9], [0.75, 1.9], [0.75, 1.2], [1.5, 1.0], [33.0, 2.5]]);
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
