//! The bat file with the wood that was found: the original file with another material.

use serde_json::{Map, Value, json};

use crate::report::calibrate::shown;
use crate::report::resolved;
use crate::schema;
use sweetspot::base::number::percent;
use sweetspot::files::document::Document;
use sweetspot::files::json_node::Node;
use sweetspot::{Bat, Material, Result};
use sweetspot_study::calibrate::calibration::{Calibration, Estimated, NINETY_FIVE, Verdict};
use sweetspot_study::calibrate::fit::{DatumKind, Residual};

/// Members that a calibrated file replaces or omits, because densities and moduli are known now.
const ANEW: [&str; 4] = ["source", "comment", "material", "weighed"];

/// The text of the file. `before` is the bat and the text of its file, `measured` the name of the readings.
///
/// # Errors
///
/// [`sweetspot::Error::Input`] where the text is no JSON object.
pub fn text((bat, before): (&Bat, &str), found: &Calibration, measured: &str) -> Result<String> {
    let split = found.regions_at_m;
    Node::root(&Document::new("bat".to_owned(), before))?.members()?;
    let before = before.trim_start_matches('\u{feff}');
    let old: Map<String, Value> = serde_json::from_str(before).unwrap_or_default();
    let mut new = Map::new();
    new.insert("format".to_owned(), json!("sweetspot-bat/1"));
    new.insert("name".to_owned(), json!(bat.name()));
    new.insert("comment".to_owned(), json!(intervals(found)));
    let from = bat.source();
    let source =
        format!("Calibrated by {measured} (sweetspot {}). {from}", env!("CARGO_PKG_VERSION"));
    new.insert("source".to_owned(), json!(source.trim_end()));
    new.insert("material".to_owned(), json!(material(found, found.bat.material())));
    if let Some(from) = split {
        let barrel = found.bat.fixtures().regions.first().map(|region| &region.layup.outer);
        let barrel = material(found, barrel.unwrap_or(found.bat.material()));
        new.insert(
            "regions".to_owned(),
            json!([{ "from": from, "to": bat.length(), "material": barrel }]),
        );
    }
    // Values from a scale describe the bat before its edits.
    if !old.contains_key("edits") {
        new.extend(weighed(found).map(|weighed| ("weighed".to_owned(), weighed)));
    }
    for (key, value) in old {
        if !ANEW.contains(&key.as_str()) && !new.contains_key(&key) {
            new.insert(key, value);
        }
    }
    regions(&mut new, found);
    // The new file may lie in another folder than the table that the old one names.
    if new.get("profile").is_some_and(|profile| profile.get("csv").is_some()) {
        new["profile"] = json!(resolved::profile(bat.unedited().profile()));
    }
    Ok(schema::text(&Value::Object(new)))
}

/// The mass and first frequency of the calibrated wood, which give the uncertainty of its density and stiffness. `None`
/// if neither was measured, or the fit is beyond the 95 % interval of the reading.
fn weighed(found: &Calibration) -> Option<Value> {
    let mut weighed = Map::new();
    let known = [(DatumKind::Mass, "mass"), (DatumKind::Frequency(1), "first_bending_hz")];
    for (kind, key) in known {
        let agrees = |one: &&Residual| {
            let off = (one.datum.measured - one.computed).abs();
            one.datum.kind == kind && off <= NINETY_FIVE * one.datum.reading_sd
        };
        if let Some(one) = found.data.iter().find(agrees) {
            weighed.insert(key.to_owned(), json!(one.computed));
        }
    }
    (!weighed.is_empty()).then_some(Value::Object(weighed))
}

/// Regions with an explicit material equal to that of the bat also get the new one.
fn regions(file: &mut Map<String, Value>, found: &Calibration) {
    let wood = found.bat.material();
    let known = found.bat.unedited().fixtures().regions.iter();
    let listed = file.get_mut("regions").and_then(Value::as_array_mut);
    let listed = listed.filter(|_| found.regions_at_m.is_none());
    for (region, listed) in known.zip(listed.into_iter().flatten()) {
        if region.layup.outer == *wood && listed.get("material").is_some() {
            listed["material"] = json!(material(found, wood));
        }
    }
}

/// The material with the measured loss factor.
fn material(found: &Calibration, own: &Material) -> Material {
    let loss_factor = found.loss_factor().unwrap_or(own.loss_factor);
    Material { loss_factor, ..own.clone() }
}

/// Values with their intervals, a line each.
fn intervals(found: &Calibration) -> Vec<String> {
    let line = |one: &Estimated| {
        let [low, high] = one.interval95.map(|value| shown(one.property, value));
        let unsaid = match one.verdict {
            Verdict::NotDetermined | Verdict::Held => "; the readings do not say it",
            _ => "",
        };
        format!(
            "{}: {}, 95 % from {low} to {high} (standard deviation {}){unsaid}",
            one.property.name(),
            shown(one.property, one.value),
            percent(one.relative_sd, 2)
        )
    };
    let mut all: Vec<String> = found.parameters.iter().map(line).collect();
    if !found.fits {
        all.push("The readings do not fit this bat: the intervals are too narrow.".to_owned());
    }
    all
}
