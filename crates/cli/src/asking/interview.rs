//! What `sweetspot new` asks, in its order.

use std::io::BufRead;

use sweetspot::base::error::Complaint;
use sweetspot::bat::material::Material;

use crate::asking::ask;
use crate::asking::dialogue::{Asked, Dialogue, Question, Read};
use crate::asking::draft::NAME;
use crate::asking::new_options::{
    Args, called, length, like, of_option, refuse_existing, source, stations, unit,
};
use crate::bat_text::Measured;
use crate::common::printed;

const WELCOME: &str = "A bat file. An empty line takes what stands in [ ]; ? explains a question, \
                       back goes to the one before, quit leaves and keeps the answers.";
const ON_NAME: &str = "What the bat is called in tables and pictures. Where the command names no file, \
                       the file is called after it.";
const ON_UNIT: &str = "Bare numbers are in it from here on; others are taken with their unit.";
const ON_LENGTH: &str = "From the end of the knob to the tip, along the bat.";
const ON_MASS: &str = "As the scale shows it, with all that is on the bat. It sets the density of the \
                       material. Without a scale answer: don't know; then the density is that of the \
                       material's list, which for wood may be off by a tenth.";
const ON_MATERIAL: &str = "What the bat is made of, by name or number. For a wooden bat take one that \
                           says: as bats ring.";
const ON_STATION: &str = "The diameter here, or a place and the diameter there (2.5, 1.1). A place that \
                          was measured before is corrected so. A place and two diameters (2.5, 1.9, \
                          1.1) are a step.";
const ON_WALL: &str = "Bats of metal or of a composite are tubes: how thick is the wall of the tube, such as 3 mm or \
                       0.12 in? Where it differs, take the barrel's, and edit \"wall_thickness\" in the file, which has \
                       one for every place. A solid bat: no.";
const ON_CUP: &str = "How deep the tip is hollowed out and how wide at its rim, such as: 1 in, 1.6 in. The scale has \
                      weighed the bat with it. A tip without a cup: none.";
const ON_BALANCE: &str = "Where the bat balances on an edge, from the knob end. It is compared with what \
                          the diameters say, which shows a slip of the calipers.";
const ON_TAP: &str = "Hold the bat loosely some 6 in from the knob, tap the barrel and read the lowest \
                      strong tone off a tuner or a telephone, such as 170 Hz. It sets the stiffness, \
                      which differs more from billet to billet than anything else.";
const ON_TAPE: &str = "How far it reaches from the knob, and its mass, such as: 10 in, 0.7 oz.";

/// What the options say, and answers to the rest.
pub fn asked<R: BufRead>(args: &Args, person: &mut Dialogue<R>) -> Asked<Measured> {
    person.say(WELCOME);
    let name = match &args.name {
        Some(name) => free(args, name).map_err(of_option("--name"))?,
        None => {
            let question =
                Question { name: NAME, text: "Name", usual: Some("My bat"), help: ON_NAME };
            person.ask(&question, |answer| free(args, answer))?
        }
    };
    let unit = match (&args.unit, &args.length) {
        (None, None) => {
            let text = "Unit of your ruler and calipers, in or cm";
            let question = Question { name: "unit", text, usual: Some("in"), help: ON_UNIT };
            person.ask(&question, ask::unit)?
        }
        (asked, _) => unit(asked.as_deref()),
    };
    let length = match length(args, unit)? {
        Some(length) => length,
        None => {
            let text = format!("Length, {unit}");
            let question = Question { name: "length", text: &text, usual: None, help: ON_LENGTH };
            person.ask(&question, |text| ask::length(text, unit))?
        }
    };
    let mass = match &args.mass {
        Some(mass) => Some(mass.clone()),
        None => {
            let text = "Mass on the scale, with its unit (or: don't know)";
            let question = Question { name: "mass", text, usual: None, help: ON_MASS };
            person.ask(&question, ask::mass)?
        }
    };
    let material = match &args.material {
        Some(material) => material.clone(),
        None => {
            ask::materials(unit).iter().for_each(|line| person.say(line));
            let text = "Material, name or number";
            let question = Question { name: "material", text, usual: None, help: ON_MATERIAL };
            person.ask(&question, ask::material)?
        }
    };
    let stations = match (&args.like, args.stations.is_empty()) {
        (Some(name), _) => like(name, Some(length), unit)?,
        (None, false) => stations(args, unit)?,
        (None, true) => measured_along(person, length, unit)?,
    };
    let wall = match &args.wall {
        Some(wall) => ask::wall(wall, &stations, unit).map_err(of_option("--wall"))?,
        None => hollow(person, &material, &stations, unit)?,
    };
    let cup = match (&args.cup, &wall) {
        (Some(cup), _) => ask::cup(cup, &stations, unit).map_err(of_option("--cup"))?,
        (None, Some(_)) => None,
        (None, None) => {
            let text = "Cup in the tip: its depth and its diameter";
            let question = Question { name: "cup", text, usual: Some("none"), help: ON_CUP };
            person.ask(&question, |text| ask::cup(text, &stations, unit))?
        }
    };
    let [balance, tap, tape] = extras(person, length, unit)?;
    let source = source(args);
    Ok(Measured { name, source, material, mass, unit, stations, wall, cup, balance, tap, tape })
}

/// The thickness of the wall of a hollow bat, as the file has it; None of a solid one. Wood is solid unless somebody
/// says otherwise, of a metal somebody has to say it.
fn hollow<R: BufRead>(
    person: &mut Dialogue<R>,
    material: &str,
    stations: &[[f64; 2]],
    unit: &'static str,
) -> Asked<Option<String>> {
    let wood = Material::named(material).is_some_and(|material| material.scatter().is_some());
    let usual = wood.then_some("no");
    let text = format!("Hollow: thickness of its wall, {unit} (or: no)");
    let question = Question { name: "wall", text: &text, usual, help: ON_WALL };
    person.ask(&question, |text| ask::wall(text, stations, unit))
}

/// What may be known besides: balance point, tap tone and tape, as the file has them.
fn extras<R: BufRead>(
    person: &mut Dialogue<R>,
    length: f64,
    unit: &'static str,
) -> Asked<[Option<String>; 3]> {
    let text = format!("Balance point from the knob end, {unit}");
    let question =
        Question { name: "balance", text: &text, usual: Some("don't know"), help: ON_BALANCE };
    let balance = person.ask(&question, |text| ask::balance(text, length, unit))?;
    let text = "Tone when tapped (first bending frequency), Hz";
    let question = Question { name: "tap", text, usual: Some("don't know"), help: ON_TAP };
    let tap = person.ask(&question, ask::tap)?;
    let text = "Tape on the handle";
    let question = Question { name: "tape", text, usual: Some("none"), help: ON_TAPE };
    let tape = person.ask(&question, |text| ask::tape(text, length, unit))?;
    Ok([balance, tap, tape])
}

/// Places and diameters from knob to tip, in `unit`, for a bat so long in it.
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
        let text = format!("  at {tip}{place} {unit}");
        let usual = if stations.is_empty() || to_the_tip { None } else { Some("") };
        let question = Question { name: "station", text: &text, usual, help: ON_STATION };
        match person.ask(&question, |text| ask::put(text, place, &stations, length, unit))? {
            Some(more) => stations = more,
            None => to_the_tip = true,
        }
    }
    Ok(stations)
}

/// A name whose file is not there yet, unless the command names a file.
fn free(args: &Args, name: &str) -> Read<String> {
    let path = called(name);
    if args.file.is_some() || refuse_existing(&path, args.force).is_ok() {
        Ok(name.to_owned())
    } else {
        let found = format!("{}, which is there", printed(&path));
        Err(Complaint::new("", found, "another name"))
    }
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
