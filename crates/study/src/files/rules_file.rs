//! How are the rules of a game written? The `sweetspot-rules/1` file. Some rules are built in; your own file may add
//! others.

use std::ops::Bound::{Excluded, Unbounded};
use std::path::Path;

use crate::aim::rules::{Rule, RuleSet};
use crate::engine::{Complaint, Document, Error, Folder, Quantity, Result};
use crate::files::form::{Form, amount, list, number, text, truth};
use crate::files::written::{WrittenFile, written};

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

/// The built-in rules of that name, or those of a file whose name ends in `.json`.
///
/// # Errors
///
/// [`Error::Value`] with the nearest name; what is wrong with the file.
pub fn named(name: &str) -> Result<RuleSet> {
    named_by(name, |name| Document::read(Path::new(name)))
}

/// As [`named`], for a name in a file of that folder.
///
/// # Errors
///
/// As [`named`], and those of `Folder::json`.
pub fn named_in(name: &str, folder: &Folder) -> Result<RuleSet> {
    named_by(name, |name| folder.json(name, "rules"))
}

fn named_by(name: &str, read: impl Fn(&str) -> Result<Document>) -> Result<RuleSet> {
    if let Some((name, text)) = BUILT_IN.iter().find(|(known, _)| *known == name) {
        return RulesForm::from_text(name, text, Path::new(""));
    }
    if name.ends_with(".json") {
        return RulesForm::from_document(&read(name)?, &Folder::closed(Path::new("")));
    }
    let names = BUILT_IN.map(|(name, _)| name);
    let expected = format!("{}, or a rule file (.json)", names.join(", "));
    Err(Error::Value(
        Complaint::new("rules", format!("\"{name}\""), expected).or_nearest(name, &names),
    ))
}

written! {
    /// The numerical rules of a game, with their source and date. A result computed from them certifies nothing: only
    /// the newest edition of the rules and the game's laboratories do.
    RulesForm("rules", "Rule file") {
        /// Short name.
        name = text(), needed "\"name\": a short name";
        /// Which game they are of.
        game = text();
        /// Source of the numbers.
        source = text(), needed "\"source\": where the numbers are from";
        /// Year or date of the source.
        date = text(), needed "\"date\": of the source";
        /// Further demands of the rules, which are not computed here.
        ask = list(text());
        /// Greatest diameter anywhere.
        diameter_at_most = above_0(Quantity::Length);
        /// Greatest length.
        length_at_most = above_0(Quantity::Length);
        /// Greatest mass.
        mass_at_most = above_0(Quantity::Mass);
        /// Least moment of inertia about the point 6 in from the knob end.
        inertia_at_least = above_0(Quantity::Inertia);
        /// Greatest depth of a cup in the tip.
        cup_depth_at_most = above_0(Quantity::Length);
        /// Least diameter of a cup.
        cup_diameter_at_least = above_0(Quantity::Length);
        /// Greatest diameter of a cup.
        cup_diameter_at_most = above_0(Quantity::Length);
        /// Greatest drop: length in inches less mass in ounces.
        drop_at_most = number();
        /// Greatest BBCOR.
        bbcor_at_most = number();
        /// Whether the bat must be one piece.
        one_piece = truth();
    }
    |_| -> RuleSet {
        let measured = [diameter_at_most, length_at_most, mass_at_most, inertia_at_least];
        let of_cup = [cup_depth_at_most, cup_diameter_at_least, cup_diameter_at_most];
        let limits = measured.into_iter().chain(of_cup).chain([drop_at_most, bbcor_at_most]);
        let numbers = Rule::ALL.into_iter().zip(limits).filter(|(_, limit)| limit.is_some());
        let whole = one_piece.filter(|one| *one).map(|_| (Rule::OnePiece, None));
        let rules = numbers.chain(whole).collect();
        let (game, ask) = (game.unwrap_or_default(), ask.unwrap_or_default());
        Ok(RuleSet { name, game, source, date, rules, ask })
    }
}

/// An amount above 0.
fn above_0(quantity: Quantity) -> Form<f64> {
    amount(quantity).within((Excluded(0.0), Unbounded), "a value above 0")
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
