//! What `sweetspot new` asks, in its order.

use std::io::BufRead;
#[cfg(feature = "audio")]
use std::path::Path;

use sweetspot::Material;
use sweetspot::base::error::Complaint;
#[cfg(feature = "audio")]
use sweetspot_tap::decode::is_recording;

use crate::asking::ask;
use crate::asking::dialogue::{Asked, Dialogue, Question, Read, missing};

use crate::asking::new_options::{Args, called, like, refuse_existing, source, stations};
use crate::bat_text::{self, Measured};
use crate::output::printed;
#[cfg(feature = "audio")]
use crate::recording::first_tone;

const WELCOME: &str = "A bat file. An empty line takes what stands in [ ]; ? explains a question, \
                       back goes to the one before, quit leaves and keeps the answers.";

/// The values of the options, and answers to the remaining questions.
pub fn asked<R: BufRead>(args: &Args, person: &mut Dialogue<R>) -> Asked<Measured> {
    let question = |name| Question::named("new", name);
    person.say(WELCOME);
    let there = person.is_there();
    if !there && args.like.is_none() && args.stations.is_empty() {
        return Err(missing("--station or --like").into());
    }
    let name = person.told(&args.name, &question("name"), |name| free(args, name, there))?;
    // A length given by an option is in inches unless an option gives the unit.
    let unit = args.unit.clone().or(args.length.as_ref().map(|_| "in".to_owned()));
    let unit = person.told(&unit, &question("unit"), ask::unit)?;
    let length = match there || args.length.is_some() {
        true => Some(
            person
                .told(&args.length, &question("length").of(unit), |text| ask::length(text, unit))?,
        ),
        false => None,
    };
    let mass = person.told(&args.mass, &question("mass"), ask::mass)?;
    if args.material.is_none() {
        ask::materials(unit).iter().for_each(|line| person.say(line));
    }
    let material = person.told(&args.material, &question("material"), ask::material)?;
    let stations = match (&args.like, args.stations.is_empty()) {
        (Some(name), _) => like(name, length, unit)?,
        (None, false) => stations(&args.stations, length, unit)?,
        (None, true) => measured_along(person, length.unwrap_or_default(), unit)?,
    };
    // Wood is solid by default; for a metal a person, if there is one, must say.
    let wood = Material::named(&material).is_some_and(|material| material.scatter().is_some());
    let usual = (wood || !there).then(|| "no".to_owned());
    let hollow = Question { usual, ..question("wall").of(unit) };
    let wall = person.told(&args.wall, &hollow, |text| ask::wall(text, &stations, unit))?;
    let cup = match (&args.cup, &wall) {
        (None, Some(_)) => None,
        (cup, _) => person.told(cup, &question("cup"), |text| ask::cup(text, &stations, unit))?,
    };
    let length = length.or(stations.last().map(|station| station[0])).unwrap_or_default();
    let balance =
        person.ask(&question("balance").of(unit), |text| ask::balance(text, length, unit))?;
    let (source, tap, tape) = (source(args), None, None);
    let so_far =
        Measured { name, source, material, mass, unit, stations, wall, cup, balance, tap, tape };
    let tap = person.ask(&question("tap"), |text| tapped(text, &so_far))?;
    let tape = person.ask(&question("tape"), |text| ask::tape(text, length, unit))?;
    Ok(Measured { tap, tape, ..so_far })
}

/// The first tone of the bat that was measured so far: as it is said, or as it is in a recording.
fn tapped(text: &str, _so_far: &Measured) -> Read<Option<String>> {
    #[cfg(feature = "audio")]
    if is_recording(Path::new(text)) {
        return first_tone(Path::new(text), &bat_text::text(_so_far)).map(Some);
    }
    ask::tap(text)
}

/// Places and diameters from knob to tip, in `unit`, for a bat of that length.
fn measured_along<R: BufRead>(
    person: &mut Dialogue<R>,
    length: f64,
    unit: &'static str,
) -> Asked<Vec<[f64; 2]>> {
    let ruler = if unit == "in" { "inches" } else { unit };
    person.say(&format!(
        "Diameters in {ruler}, from the knob end to the tip. Measure at the place that is asked, or \
         answer with a place of your own and its diameter, such as: 2.5, 1.1. A place that was \
         measured is corrected so. An empty line goes on to the tip."
    ));
    let suggested = ask::suggested(length, unit);
    let (mut stations, mut to_the_tip): (Vec<[f64; 2]>, bool) = (vec![], false);
    while stations.last().is_none_or(|last| last[0] < length) {
        let last = stations.last().map_or(-1.0, |last| last[0]);
        let next = suggested.iter().copied().find(|place| *place > last).unwrap_or(length);
        let place = if to_the_tip { length } else { next };
        let tip = if place == length { "the tip, " } else { "" };
        let usual = if stations.is_empty() || to_the_tip { None } else { Some(String::new()) };
        let question = Question {
            usual,
            ..Question::named("new", "station").of(&format!("{tip}{place} {unit}"))
        };
        match person.ask(&question, |text| ask::put(text, place, &stations, length, unit))? {
            Some(more) => stations = more,
            None => to_the_tip = true,
        }
    }
    Ok(stations)
}

/// A name whose file does not exist yet, unless the command names a file. If `there` is false, no person can choose
/// another name, and the file is checked when it is written.
fn free(args: &Args, name: &str, there: bool) -> Read<String> {
    let path = called(name);
    if !there || args.file.is_some() || refuse_existing(&path, args.force).is_ok() {
        return Ok(name.to_owned());
    }
    Err(Complaint::new("", format!("{}, which is there", printed(&path)), "another name"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn along(answers: &str) -> Vec<[f64; 2]> {
        let mut dialogue = Dialogue::new(answers.as_bytes());
        dialogue.hold(|person| measured_along(person, 33.0, "in")).unwrap().unwrap()
    }

    #[test]
    fn stations_rise_from_knob_to_tip_in_whatever_order_they_come() {
        // Nothing begins the bat, 5 in is too thick, 0.5 lies before 0.75, the tip may be a point.
        let stations = along("\n1.9\n0.2, 5\n0.75, 1.2\n0.5, 1\n1\n\n0\n");
        assert_eq!(stations, [[0.0, 1.9], [0.5, 1.0], [0.75, 1.2], [1.0, 1.0], [33.0, 0.0]]);
    }

    #[test]
    fn a_place_that_is_typed_again_is_corrected_and_two_diameters_are_a_step() {
        let stations =
            along("1.9\n0.75, 1.9\n1\n0.75, 1.8\n0.75, 1.8, 1.2\n0, 1.7\n\n0.75, 1.9, 1.2\n2.5\n");
        assert_eq!(stations, [[0.0, 1.7], [0.75, 1.9], [0.75, 1.2], [1.0, 1.0], [33.0, 2.5]]);
    }

    #[test]
    fn who_goes_back_along_the_bat_measures_there_again() {
        assert_eq!(along("1.9\n1.2\nback\n1.3\n\n2.5\n"), [[0.0, 1.9], [0.5, 1.3], [33.0, 2.5]]);
    }
}
