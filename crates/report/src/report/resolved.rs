//! The bat in the JSON files: as understood, and as a complete bat file.

use serde_json::{Value, json};

use crate::schema;
use sweetspot::base::number::{rounded, shortest};
use sweetspot::base::units::inches;
use sweetspot::bat::profile::{FormulaPiece, Formulas, Interpolation, Stations};
use sweetspot::bat::weighed::Weighed;
use sweetspot::files::schema::document::Format;
use sweetspot::files::schema::resolved as file;
use sweetspot::files::schema::resolved::ResolvedBat;
use sweetspot::{Bat, Profile};

/// The bat as understood: SI units, defaults filled in, materials adjusted to the scale. Read as a bat file it gives
/// the same bat.
pub fn resolved(bat: &Bat) -> ResolvedBat {
    let edits = bat.edits().to_vec();
    let name = bat.name().to_owned();
    let bat = bat.unedited();
    ResolvedBat {
        format: Format::new(),
        name,
        source: bat.source().to_owned(),
        material: bat.material().clone(),
        profile: profile(bat.profile()),
        fixtures: bat.fixtures().clone(),
        weighed: Some(bat.weighed()).filter(|weighed| *weighed != Weighed::default()),
        edits,
    }
}

/// The text of a bat file with these stations as its profile: diameters in mm or in inches, to 10⁻⁹ of either.
pub fn text_in_columns(bat: &ResolvedBat, stations: &Stations, in_inches: bool) -> String {
    let mut value = schema::value(bat);
    let (unit, per) = if in_inches { ("in", inches(1.0)) } else { ("mm", 1e3) };
    let column = |values: &[f64], factor: f64| {
        let all = values.iter().map(|value| shortest(rounded(factor * per * value, 9)));
        format!("[{}]", all.collect::<Vec<_>>().join(", "))
    };
    let hollow = stations.inner.iter().any(|r| *r > 0.0);
    let interpolation = match stations.interpolation {
        Interpolation::Pchip => "pchip",
        _ => "linear",
    };
    let mut profile = json!({
        "interpolation": interpolation, "unit": unit, "x": "@x", "diameter": "@diameter",
    });
    if hollow {
        profile["inner_diameter"] = Value::from("@inner");
    }
    value["profile"] = profile;
    let columns = [
        ("\"@x\"", column(&stations.x, 1.0)),
        ("\"@diameter\"", column(&stations.outer, 2.0)),
        ("\"@inner\"", column(&stations.inner, 2.0)),
    ];
    let text = format!("{value:#}\n");
    columns.iter().fold(text, |text, (mark, column)| text.replace(mark, column))
}

/// A profile as understood, without references to other files.
pub fn profile(profile: &Profile) -> file::Profile {
    match &profile.formulas {
        Some(formulas) => file::Profile::Pieces(pieces(formulas)),
        None => file::Profile::Columns(columns(&profile.stations)),
    }
}

fn columns(stations: &Stations) -> file::Columns {
    let hollow = stations.inner.iter().any(|r| *r > 0.0);
    file::Columns {
        interpolation: match stations.interpolation {
            // It has become steps between straight lines.
            Interpolation::Constant => Interpolation::Linear,
            other => other,
        },
        unit: "m".to_owned(),
        x: stations.x.clone(),
        radius: stations.outer.clone(),
        inner_radius: hollow.then(|| stations.inner.clone()),
    }
}

fn pieces(formulas: &Formulas) -> file::Pieces {
    let piece = |piece: &FormulaPiece| file::Piece {
        from: piece.from,
        to: piece.to,
        formula: piece.outer.text().to_owned(),
        inner_formula: piece.inner.as_ref().map(|inner| inner.text().to_owned()),
    };
    file::Pieces {
        measured_from: if formulas.from_tip { file::End::Tip } else { file::End::Knob },
        pieces: formulas.pieces.iter().map(piece).collect(),
    }
}
