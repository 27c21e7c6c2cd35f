//! The rules of a game as they are written down: the `sweetspot-rules/1` file. Some travel with the program;
//! a file of one's own may say the same or more.

use std::path::Path;

use crate::aim::rules::{Rule, RuleSet};
use sweetspot::base::error::{Complaint, Error, Result};
use sweetspot::base::mistakes::{self, Mistakes};
use sweetspot::base::units::Quantity;
use sweetspot::files::document::Document;
use sweetspot::files::folder::Folder;
use sweetspot::files::json_node::{Node, Object};

/// The rules that travel with the program: name and file.
pub const BUILT_IN: [(&str, &str); 7] = [
    ("mlb", include_str!("../../../../rules/mlb.json")),
    ("ncaa", include_str!("../../../../rules/ncaa.json")),
    ("ncaa-wood", include_str!("../../../../rules/ncaa-wood.json")),
    ("nfhs", include_str!("../../../../rules/nfhs.json")),
    ("nfhs-wood", include_str!("../../../../rules/nfhs-wood.json")),
    ("usa-baseball", include_str!("../../../../rules/usa-baseball.json")),
    ("softball", include_str!("../../../../rules/softball.json")),
];

/// A rule of its limit in SI.
type Made = fn(f64) -> Rule;

/// The rules with a length, a mass, or something else that has a unit.
const MEASURED: [(&str, Quantity, Made); 7] = [
    ("diameter_at_most", Quantity::Length, Rule::DiameterAtMost),
    ("length_at_most", Quantity::Length, Rule::LengthAtMost),
    ("mass_at_most", Quantity::Mass, Rule::MassAtMost),
    ("inertia_at_least", Quantity::Inertia, Rule::InertiaAtLeast),
    ("cup_depth_at_most", Quantity::Length, Rule::CupDepthAtMost),
    ("cup_diameter_at_least", Quantity::Length, Rule::CupDiameterAtLeast),
    ("cup_diameter_at_most", Quantity::Length, Rule::CupDiameterAtMost),
];
/// Those that are numbers.
const COUNTED: [(&str, Made); 2] =
    [("drop_at_most", Rule::DropAtMost), ("bbcor_at_most", Rule::BbcorAtMost)];
const WORDS: [&str; 7] = ["format", "$schema", "name", "game", "source", "date", "ask"];

/// The rules of that name, or of a file, whose name ends in `.json`.
///
/// # Errors
///
/// [`Error::Value`] with the nearest name; what is wrong with the file.
pub fn named(name: &str) -> Result<RuleSet> {
    named_by(name, |name| Document::read(Path::new(name)))
}

/// As [`named`], as a file in that folder names them.
///
/// # Errors
///
/// As [`named`], and those of `Folder::json`.
pub fn named_in(name: &str, folder: &Folder) -> Result<RuleSet> {
    named_by(name, |name| folder.json(name, "rules"))
}

fn named_by(name: &str, read: impl Fn(&str) -> Result<Document>) -> Result<RuleSet> {
    if let Some((name, text)) = BUILT_IN.iter().find(|(known, _)| *known == name) {
        return from_document(&Document::new((*name).to_owned(), text));
    }
    if name.ends_with(".json") {
        return from_document(&read(name)?);
    }
    let names = BUILT_IN.map(|(name, _)| name);
    let expected = format!("{}, or a rule file (.json)", names.join(", "));
    Err(Error::Value(
        Complaint::new("rules", format!("\"{name}\""), expected).or_nearest(name, &names),
    ))
}

fn from_document(document: &Document) -> Result<RuleSet> {
    let root = Node::root(document)?.members()?;
    root.check_format("sweetspot-rules/1")?;
    let mut mistakes = Mistakes::default();
    let measured = MEASURED.map(|(key, ..)| key);
    let counted = COUNTED.map(|(key, _)| key);
    let known = [&WORDS[..], &measured, &counted, &["one_piece"]].concat();
    let root = root.only(&known, &mut mistakes);
    let format = "\"format\": \"sweetspot-rules/1\"";
    mistakes.note(root.require("format", format).map(|_| ()));
    mistakes.note(root.string("$schema"));
    let mut text = |key: &str, expected: &str| {
        mistakes.note(root.require(key, expected).and_then(Node::string))
    };
    let name = text("name", "\"name\": a short name");
    let source = text("source", "\"source\": where the numbers are from");
    let date = text("date", "\"date\": of the source");
    let game = mistakes.note(root.string("game")).unwrap_or_default();
    let ask = root
        .get("ask")
        .map_or(Ok(vec![]), |node| mistakes::all(node.items()?.iter().map(Node::string)));
    let ask = mistakes.note(ask);
    let mut rules = vec![];
    for (key, quantity, rule) in MEASURED {
        let value = mistakes
            .note(root.get(key).map(|node| positive(node, node.quantity(quantity))).transpose());
        rules.extend(value.map(rule));
    }
    for (key, rule) in COUNTED {
        let value = mistakes.note(root.get(key).map(Node::number).transpose());
        rules.extend(value.map(rule));
    }
    if mistakes.note(truth(&root, "one_piece")) {
        rules.push(Rule::OnePiece);
    }
    mistakes.end(RuleSet { name, game, source, date, rules, ask })
}

fn positive(node: &Node, value: Result<f64>) -> Result<f64> {
    match value? {
        value if value > 0.0 => Ok(value),
        _ => Err(node.error(node.shown(), "a value above 0")),
    }
}

/// A member that is true or false; false without it.
pub(crate) fn truth(root: &Object, key: &str) -> Result<bool> {
    let Some(node) = root.get(key) else { return Ok(false) };
    match node.value().as_bool() {
        Some(truth) => Ok(truth),
        None => Err(node.error(node.shown(), "true or false")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_set_that_travels_with_the_program_reads_and_tells_its_source() {
        for (name, _) in BUILT_IN {
            let set = named(name).unwrap();
            assert!(set.name == name && !set.source.is_empty() && !set.date.is_empty());
            assert!(set.diameter() < 0.08 && set.diameter() > 0.05, "{name}");
        }
        let mlb = named("mlb").unwrap();
        assert!((mlb.diameter() - 2.61 * 0.0254).abs() < 1e-15);
        let wrong = named("mbl").unwrap_err().to_string();
        assert!(wrong.contains("did you mean mlb?"), "{wrong}");
    }
}
