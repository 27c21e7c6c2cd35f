//! What is the effect of a cut, band by band along the bat?

use serde_json::{Value, json};
use sweetspot::base::error::{Error, Result};
use sweetspot_report::report::lathe;
use sweetspot_report::report::lathe_table::TableUnits;
use sweetspot_study::answers::Answer;
use sweetspot_study::lathe::found::TurnedBand;
use sweetspot_study::lathe::map::LatheMap;
use sweetspot_study::lathe::workpiece::HitTerms;

use crate::asked::{Question, request};
use crate::hit::Solved;
use crate::shown::shown;

/// The effects in the answer for each band.
const EFFECTS: [(&str, Answer); 4] = [
    ("sweet spot", Answer::ExitSpeedPlace),
    ("fastest ball", Answer::ExitSpeed),
    ("swing weight", Answer::Inertia),
    ("f1", Answer::Frequency(1)),
];

pub fn answer(of: &Question) -> Result<Value> {
    let Solved { bat, request: asked, scene, model, .. } = Solved::new(of, request(), false)?;
    let hit = HitTerms { scene, model, exactly: false };
    let map = LatheMap::in_short(&bat, &asked, &hit)?.ok_or_else(|| {
        let found = format!("a profile of {} pieces", bat.profile().pieces.len());
        Error::value("the lathe map", found, "a profile of fewer, such as stations an inch apart")
    })?;
    let table = TableUnits::of(of.units, &bat);
    let change = |band: &TurnedBand, answer: Answer| {
        // Derivatives are per millimetre.
        let change = 1e3 * table.per() * band.derivative(answer, 0.0)?;
        Some(shown(change, table.sentence(answer, change)?))
    };
    let bands = &map.found.bands;
    let effects = EFFECTS.iter().map(|(what, answer)| {
        let changes: Vec<_> = bands.iter().map(|band| change(band, *answer)).collect();
        json!({ "what": what, "changes": changes })
    });
    let ends = bands.iter().map(|band| json!({ "from_m": band.from_m, "to_m": band.to_m }));
    Ok(json!({
        "depth": table.per_name(),
        "bands": ends.collect::<Vec<_>>(),
        "effects": effects.collect::<Vec<_>>(),
        "strongest": lathe::strongest(&map, of.units),
    }))
}
