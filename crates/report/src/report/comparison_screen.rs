//! Several bats side by side on a screen: the important differences, then where along the barrel.

use crate::parts::{Screen, Units, wrapped};
use crate::report::comparison::{
    ComparisonRow, FIRST, along, bats, beside, hit, letter, rows, swung, table,
};
use crate::report::trust::doubts;
use sweetspot_study::comparison::table::Comparison;

/// Important rows for which a screen has no room.
const LEFT: [&str; 4] = ["zone_from", "zone_to", "length", "balance_point"];

/// The differences, and where along the barrel they occur, as far as a screen has room. Several bats share one system
/// of units, that of the file of the first unless another is requested.
pub fn screen(comparison: &Comparison, units: Units) -> Screen {
    let one = units.first();
    let head = bats(comparison, one, false) + &hit(comparison, units);
    let (differing, same) = ordered(comparison, one);
    let mut out = match (comparison.bats.len(), differing.is_empty()) {
        (_, true) => String::new(),
        (2, _) => {
            let (differing, _) = ordered(comparison, units);
            beside("B beside A", &differing, 1, units).trim_start().to_owned()
        }
        _ => table(comparison, &differing),
    };
    if !same.is_empty() {
        let name =
            |row: &ComparisonRow| row.label.split(", ").next().unwrap_or_default().to_owned();
        let same: Vec<String> = same.iter().map(name).collect();
        out += &wrapped(&format!("No difference beyond the errors: {}", same.join(", ")), 2);
    }
    let mut words = String::from("In words, by distance from the tip\n");
    for bat in 1..comparison.bats.len() {
        let parts = along(comparison, bat, one);
        let hit = if parts.is_empty() { "one of the two hits no ball".to_owned() } else { parts };
        let swung = swung(comparison, bat).map_or(String::new(), |swung| format!(" {swung}"));
        words += &wrapped(&format!("  {}: {hit}.{swung}", letter(bat)), 4);
    }
    // Doubts precede anything that can be read off a table.
    let trust = doubted(comparison, one) + &beside_pieces(comparison, one);
    // The differences of two bats have room; for several bats, the heads name the doubts in a word.
    let last = u8::from(comparison.bats.len() > 2);
    let differences = (last, "what differs", out);
    let along = (last + 2, "where along the barrel", words);
    [(0, "", head), differences, along, (last + 1, "trust", trust)].into()
}

/// Figures whose scatter is shown.
const OF_WOOD: [&str; 4] = ["best_exit_speed", "swing_weight", "mass", "frequency_1"];

/// The doubts about the hits, each once with all bats to which it applies.
fn doubted(comparison: &Comparison, units: Units) -> String {
    let mut all: Vec<(String, Vec<String>)> = vec![];
    for (k, bat) in comparison.bats.iter().enumerate() {
        for text in doubts(&bat.verdict, units) {
            match all.iter_mut().find(|(told, _)| *told == text) {
                Some((_, of)) => of.push(letter(k).to_string()),
                None => all.push((text, vec![letter(k).to_string()])),
            }
        }
    }
    let line = |(text, of): (String, Vec<String>)| format!("Trust, {}: {text}", of.join(", "));
    all.into_iter().map(|one| wrapped(&line(one), 7)).collect()
}

/// The differences compared with those between two pieces of one material; for one and the same piece these cancel.
fn beside_pieces(comparison: &Comparison, units: Units) -> String {
    let others = 1..comparison.bats.len();
    let same = others.clone().filter(|bat| comparison.one_piece(*bat));
    let same: Vec<String> = same.map(|bat| letter(bat).to_string()).collect();
    let mut out = String::new();
    if !same.is_empty() {
        let text = format!(
            "Trust: {} and A are one and the same piece, so that what pieces of one material differ by cancels.",
            same.join(", ")
        );
        out += &wrapped(&text, 7);
    }
    let known = rows(comparison, units).into_iter();
    let told = known.filter(|row| OF_WOOD.contains(&row.key.as_str()) && !row.pieces.is_empty());
    let told: Vec<String> = told
        .map(|row| match row.label.rsplit_once(", ") {
            Some((name, unit)) => format!("{name} {} {unit}", row.pieces),
            None => format!("{} {}", row.label, row.pieces),
        })
        .collect();
    if !told.is_empty() {
        let text = format!(
            "Trust: pieces of one material differ too (one standard deviation): {}; \"within\" is the computation alone.",
            told.join("; ")
        );
        out += &wrapped(&text, 7);
    }
    if same.len() < others.len() && told.is_empty() {
        let text = "Trust: how much two pieces of these materials differ is not counted here (a material of unknown \
                    scatter, or a bat that was weighed and tapped); \"within\" is the computation alone.";
        out += &wrapped(text, 7);
    }
    out
}

/// The important rows, in order: first those that differ between bats, then the others.
fn ordered(comparison: &Comparison, units: Units) -> (Vec<ComparisonRow>, Vec<ComparisonRow>) {
    let mut all = rows(comparison, units);
    all.retain(|row| FIRST.contains(&row.key.as_str()) && !LEFT.contains(&row.key.as_str()));
    all.sort_by_key(|row| FIRST.iter().position(|key| row.key == *key));
    all.into_iter().partition(|row| row.differs)
}
