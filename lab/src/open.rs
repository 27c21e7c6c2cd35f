//! How is a bat imported: a bat file or a table, as the stations that the page edits?

use std::path::Path;

use serde_json::{Value, json};
use sweetspot::base::error::{Error, Result};
use sweetspot::base::number::significant;
use sweetspot::bat::body::{Bat, STANDARD_PIVOT};
use sweetspot::bat::material::Material;
use sweetspot::bat::profile::Profile;
use sweetspot::bat::stations::{Interpolation, Stations};
use sweetspot::files::bat_file::profile_of_table;
use sweetspot::files::schema::resolved::ResolvedBat;
use sweetspot::modes::prepared::prepare;
use sweetspot::modes::solve::{Request, solve};
use sweetspot_report::parts::Quantity;
use sweetspot_report::parts::units::Units;
use sweetspot_report::report::edits::words;
use sweetspot_report::report::resolved::{resolved, text_in_columns};

use crate::asked::{BAT, request};
use crate::body::has_stations;

/// The wood of a table that names none.
const WOOD: &str = "white-ash-dynamic";
/// Largest distance of the stations of a formula (m).
const APART: f64 = 0.015;

pub fn answer(text: &str, units: Units) -> Result<Value> {
    let table = !text.trim_start().starts_with('{');
    let bat = if table { of_table(text)? } else { Bat::from_text(BAT, text, Path::new(""))? };
    let stations = in_stations(bat.unedited().profile());
    // With the moduli of the tap and the weighed mass.
    let prepared = prepare(&bat, &request())?;
    let settled = ResolvedBat { weighed: None, ..resolved(&prepared.bat) };
    let text = text_in_columns(&settled, &stations, bat.inches());
    let read = Bat::from_text(BAT, &text, Path::new(""))?;
    let differs = match has_stations(&bat) {
        true if table => Some(format!("A table does not tell the wood: {WOOD} is assumed.")),
        true => None,
        false => Some(differs(&prepared.bat, &read)?),
    };
    let document: Value = serde_json::from_str(&text)
        .map_err(|error| Error::value("the bat as stations", error, "JSON"))?;
    Ok(json!({
        "bat": document, "bat_file": text, "differs": differs, "parts": parts(&read, units),
        "warnings": read.warnings(),
    }))
}

/// The bat of a table of stations.
fn of_table(text: &str) -> Result<Bat> {
    let (profile, inches) = profile_of_table(BAT, text)?;
    let wood = Material::named(WOOD).expect("it is built in");
    Bat::builder(profile, wood).name("a bat from a table").inches(inches).build()
}

/// The stations of a profile: its own, or stations that follow a formula closely.
pub fn in_stations(profile: &Profile) -> Stations {
    if profile.formulas.is_none() {
        return profile.stations.clone();
    }
    let (mut x, mut outer, mut inner) = (vec![], vec![], vec![]);
    for piece in &profile.pieces {
        let parts = (piece.length / APART).ceil().max(1.0) as usize;
        for k in 0..=parts {
            let s = k as f64 / parts as f64;
            let section = piece.at(s);
            // One station is enough where pieces meet without a step.
            let met = outer.last().zip(inner.last()).is_some_and(|(r, ri): (&f64, &f64)| {
                k == 0 && (r - section.outer).abs() + (ri - section.inner).abs() < 1e-9
            });
            if !met {
                x.push(piece.start + s * piece.length);
                outer.push(section.outer);
                inner.push(section.inner);
            }
        }
    }
    Stations { x, outer, inner, interpolation: Interpolation::Pchip }
}

/// How the bat of stations differs, in a sentence.
fn differs(old: &Bat, new: &Bat) -> Result<String> {
    let first = |bat: &Bat| -> Result<f64> {
        let solution = solve(bat, &Request { modes: 1, ..request() })?;
        Ok(solution.modes.first().map_or(f64::NAN, |mode| mode.frequency()))
    };
    let share = |old: f64, new: f64| format!("{:+.3} %", 100.0 * (new / old - 1.0) + 0.0);
    let [was, is] = [old, new].map(Bat::inertia);
    let count = new.unedited().profile().stations.x.len();
    let weighed = match old.unedited().weighed().mass {
        Some(_) => format!(
            " The density that its weighed mass asks for, {} kg/m³, is in the file: what comes off is lighter.",
            significant(old.unedited().material().density, 4)
        ),
        None => String::new(),
    };
    Ok(format!(
        "The bat is edited as {count} stations: mass {}, swing weight {}, f1 {}.{weighed}",
        share(was.mass, is.mass),
        share(was.about(STANDARD_PIVOT), is.about(STANDARD_PIVOT)),
        share(first(old)?, first(new)?),
    ))
}

/// The parts of the bat that editing does not change.
fn parts(bat: &Bat, units: Units) -> Vec<String> {
    [fixtures(bat, units), edits(bat, units)].concat()
}

/// The fixtures and supports of the bat before its edits.
pub fn fixtures(bat: &Bat, units: Units) -> Vec<String> {
    let fixtures = bat.unedited().fixtures();
    let place = |x: f64| Quantity::Length.said(units, x);
    let stretch =
        |what: &str, from: f64, to: f64| format!("{what}, {} to {}", place(from), place(to));
    let mut parts = vec![];
    parts.extend(fixtures.regions.iter().map(|one| stretch("another material", one.from, one.to)));
    parts.extend(fixtures.tapes.iter().map(|one| stretch("tape", one.from, one.to)));
    parts.extend(fixtures.attachments.iter().map(|one| format!("a weight at {}", place(one.x))));
    parts.extend(fixtures.absorbers.iter().map(|one| format!("an absorber at {}", place(one.x))));
    parts.extend(fixtures.joints.iter().map(|one| format!("a joint at {}", place(one.x))));
    parts.extend(fixtures.supports.iter().map(|one| format!("a support at {}", place(one.x))));
    parts.extend(fixtures.grip.iter().map(|one| stretch("hands", one.from, one.to)));
    parts
}

/// The edits of the bat, in their order.
pub fn edits(bat: &Bat, units: Units) -> Vec<String> {
    bat.edits().iter().map(|edit| words(&edit.change, units, bat.inches())).collect()
}
