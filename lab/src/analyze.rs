//! What is the uncertainty of the bat in hand, and what is the effect of its barrel's wall?

use serde_json::{Value, json};
use sweetspot::base::error::Result;
use sweetspot_report::analysis::{Analysis, Task};
use sweetspot_report::parts::note::note;
use sweetspot_report::report::{hit_text, hoop, trust};
use sweetspot_study::answers::Answer;
use sweetspot_study::spread::Readings;
use sweetspot_study::trampoline::barrel::Barrel;
use sweetspot_study::verdict::Doubt;

use crate::asked::{Question, request};
use crate::hit::Solved;
use crate::shown;

/// The lines of the program's table: the sweet spot first, then weight and frequencies.
const LINES: [(&str, Answer); 9] = [
    ("sweet spot", Answer::ExitSpeedPlace),
    ("fastest ball", Answer::ExitSpeed),
    ("1 % less at", Answer::Zone(false)),
    ("and at", Answer::Zone(true)),
    ("swing weight", Answer::Inertia),
    ("mass", Answer::Mass),
    ("f1", Answer::Frequency(1)),
    ("f2", Answer::Frequency(2)),
    ("f3", Answer::Frequency(3)),
];

pub fn answer(of: &Question) -> Result<Value> {
    let Solved { bat, request: hits, solution, scene, law, model } =
        Solved::new(of, request(), true)?;
    let read = Readings::of(&bat);
    let readings = Readings { diameter: of.traced().unwrap_or(read.diameter), ..read };
    let task = Task { model, scene, law, hits, proof: request(), readings };
    let analysis = Analysis::new(bat, solution, task)?;
    let line = |(what, answer): &(&str, Answer)| {
        let estimate = analysis.spread.of(*answer)?;
        let open = trust::about(&analysis, *answer, of.units).unwrap_or_default();
        let by = analysis.spread.mostly(*answer).map_or("", |(source, _)| trust::word(source));
        let value = shown::answer(*answer, of.units, estimate.value);
        Some(json!({ "what": what, "value": value, "open": open, "by": by }))
    };
    // Near a later contact the exit speed changes within a millimetre, so no zone is given.
    let later = analysis.verdict.doubts.contains(&Doubt::LaterContact);
    let told = LINES.iter().filter(|(_, answer)| !(later && matches!(answer, Answer::Zone(_))));
    let answers: Vec<Value> = told.filter_map(line).collect();
    let stated = hit_text::stated(&analysis.figures, of.units).into_iter();
    let stated: Vec<Value> =
        stated.map(|(what, text)| json!({ "what": what, "text": text })).collect();
    Ok(json!({
        "answers": answers,
        "figures": stated,
        "why": hit_text::reason(&analysis.figures, of.units),
        "trust": trust::trust(&analysis, of.units),
        "barrel": analysis.barrel.as_ref().map(|one| barrel(of, one)),
    }))
}

/// The lowest hoop modes, and the effect of the wall in sentences.
fn barrel(of: &Question, barrel: &Barrel) -> Value {
    /// Number of modes in the answer.
    const FEW: usize = 5;
    let modes = barrel.hoop().lowest(FEW).into_iter().map(|mode| {
        let frequency = mode.frequency_hz;
        let told = shown::answer(Answer::Frequency(1), of.units, frequency);
        json!({ "frequency": told, "note": note(frequency) })
    });
    json!({ "hoop": modes.collect::<Vec<_>>(), "words": hoop::answers(barrel, of.units) })
}
