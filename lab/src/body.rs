//! What are mass and outline of the rigid bat?

use serde_json::{Value, json};
use sweetspot::base::error::Result;
use sweetspot::bat::body::{Bat, STANDARD_PIVOT};
use sweetspot::bat::stations::Interpolation;
use sweetspot::modes::hoop::rings;
use sweetspot_report::parts::Quantity;
use sweetspot_study::answers::Answer;

use crate::asked::Question;
use crate::open::{edits, fixtures};
use crate::shown::{answer as told, drop, shown};

/// Places of the outline on every piece of the profile, and on the longest ones.
const PLACES: [usize; 2] = [2, 240];

pub fn answer(of: &Question) -> Result<Value> {
    let Question { bat, units, .. } = of;
    let inertia = bat.inertia();
    let length = |value: f64| shown(value, Quantity::Length.said(*units, value));
    Ok(json!({
        "name": bat.name(),
        "inches": bat.inches(),
        "hollow": rings(bat),
        "stations": has_stations(bat),
        "outline": outline(bat),
        "length": length(bat.length()),
        "mass": told(Answer::Mass, *units, inertia.mass),
        "balance": length(inertia.balance_point),
        "swing_weight": told(Answer::Inertia, *units, inertia.about(STANDARD_PIVOT)),
        "drop": drop(inertia.mass, bat.length()),
        "widest": length(2.0 * bat.profile().widest()),
        "fixtures": fixtures(bat, *units),
        "edits": edits(bat, *units),
        "warnings": bat.warnings(),
    }))
}

/// Whether the page can edit the profile of the bat: it needs stations, and a density that does not follow from a
/// weighed mass, because removed wood would change that density.
pub fn has_stations(bat: &Bat) -> bool {
    let profile = bat.unedited().profile();
    let smooth = profile.stations.interpolation != Interpolation::Constant;
    profile.formulas.is_none() && smooth && bat.unedited().weighed() == Default::default()
}

/// The surface and the bore, a step as two radii at one place.
fn outline(bat: &Bat) -> Value {
    let mut columns = [const { Vec::<f64>::new() }; 3];
    for piece in &bat.profile().pieces {
        let share = piece.length / bat.length() * PLACES[1] as f64;
        let parts = (share.ceil() as usize).clamp(PLACES[0], PLACES[1]);
        for k in 0..=parts {
            let s = k as f64 / parts as f64;
            let section = piece.at(s);
            let values = [piece.start + s * piece.length, section.outer, section.inner];
            columns.iter_mut().zip(values).for_each(|(column, value)| column.push(value));
        }
    }
    let [x, outer, inner] = columns;
    json!({ "x_m": x, "radius_m": outer, "inner_m": inner })
}
