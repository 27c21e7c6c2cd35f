//! What does somebody want of a bat, as it is written down: the `sweetspot-aim/1` file.

use std::path::{Path, PathBuf};

use crate::aim::wish::{Amount, Ask, DiameterLimit, FreeChoice, Goal, SLOPES, Target, Wish};
use crate::files::aim_text;
use crate::files::rules_file::{self, truth};
use sweetspot::base::error::{Complaint, Error, Result};
use sweetspot::base::mistakes::{self, Mistakes};
use sweetspot::base::number::shortest;
use sweetspot::base::units::Quantity;
use sweetspot::files::document::Document;
use sweetspot::files::folder::{Folder, Outside};
use sweetspot::files::json_node::{Node, Object};
use sweetspot::files::part_file;

const KEYS: &[&str] = &[
    "format",
    "name",
    "targets",
    "rules",
    "remove_only",
    "add",
    "keep",
    "diameter",
    "stations",
    "round",
    "slope_at_most",
    "free",
    "$schema",
];
const WAYS: [&str; 4] = ["change", "value", "at_least", "at_most"];

/// An aim file, with which later mistakes find their place.
pub struct AimFile {
    document: Document,
    /// What is wished.
    pub wish: Wish,
}

impl AimFile {
    /// Reads an aim file; a rule file that it names is sought from its folder.
    ///
    /// # Errors
    ///
    /// [`Error::Read`], or [`Error::Input`] with line and column, or several of them.
    pub fn read(path: &Path) -> Result<Self> {
        let document = Document::read(path)?;
        let wish = wish(&document, &Folder::closed(path.parent().unwrap_or(Path::new(""))))?;
        Ok(Self { document, wish })
    }

    /// Reads an aim file that a person has named, and the files outside of its folder that it names.
    ///
    /// # Errors
    ///
    /// As [`Self::read`].
    pub fn named_by_a_person(path: &Path) -> Result<(Self, Vec<PathBuf>)> {
        let (document, outside) = (Document::read(path)?, Outside::default());
        let wish = wish(&document, &Folder::of(path, &outside))?;
        Ok((Self { document, wish }, outside.paths()))
    }

    /// Reads one from text; `file` is what messages call it.
    ///
    /// # Errors
    ///
    /// As [`Self::read`].
    pub fn from_text(file: &str, text: &str) -> Result<Self> {
        let document = Document::new(file.to_owned(), text);
        let wish = wish(&document, &Folder::closed(Path::new("")))?;
        Ok(Self { document, wish })
    }

    /// An error about the wish, at its place in the file.
    pub fn placed(&self, error: Error) -> Error {
        let Ok(root) = Node::root(&self.document) else { return error };
        error.placed(|complaint| root.locate(complaint))
    }
}

fn wish(document: &Document, folder: &Folder) -> Result<Wish> {
    let root = Node::root(document)?.members()?;
    root.check_format("sweetspot-aim/1")?;
    let mut mistakes = Mistakes::default();
    let root = root.only(KEYS, &mut mistakes);
    let format = "\"format\": \"sweetspot-aim/1\"";
    mistakes.note(root.require("format", format).map(|_| ()));
    mistakes.note(root.string("$schema"));
    mistakes.note(root.string("name"));
    let mut wish = Wish::default();
    if let Some(node) = root.get("targets") {
        wish.targets = mistakes.note(list(node, target));
    }
    if let Some(node) = root.get("rules") {
        wish.rules = mistakes.some(rules(node, folder));
    }
    wish.remove_only = mistakes.note(truth(&root, "remove_only"));
    wish.add = mistakes.note(truth(&root, "add"));
    if let Some(node) = root.get("add").filter(|_| wish.add && wish.remove_only) {
        mistakes.add(node.error("\"add\" beside \"remove_only\"", "one of them"));
    }
    if let Some(node) = root.get("keep") {
        wish.keep = mistakes.note(list(node, stretch));
    }
    if let Some(node) = root.get("diameter") {
        wish.diameter = mistakes.note(list(node, limit));
    }
    wish.stations = mistakes.note(root.get("stations").map(spacing).transpose());
    wish.round = mistakes.note(root.get("round").map(spacing).transpose());
    wish.slope = mistakes.note(root.get("slope_at_most").map(slope).transpose());
    if let Some(node) = root.get("free") {
        wish.free = mistakes.note(free(node));
    }
    mistakes.end(wish)
}

fn list<T>(node: &Node, one: impl Fn(&Node) -> Result<T>) -> Result<Vec<T>> {
    /// What a search takes grows faster than their number.
    const MOST: usize = 20;
    let items = node.items()?;
    if items.len() > MOST {
        return Err(node.error(format!("{} items", items.len()), format!("{MOST} at most")));
    }
    mistakes::all(items.iter().map(one))
}

fn rules(node: &Node, folder: &Folder) -> Result<crate::aim::rules::RuleSet> {
    let name = node.string()?;
    rules_file::named_in(&name, folder).map_err(|error| match error {
        Error::Read { source, .. } => {
            node.error(format!("{name}, which cannot be read ({source})"), "a rule file")
        }
        error => {
            error.placed(|complaint| node.complain(Complaint { field: String::new(), ..complaint }))
        }
    })
}

/// A distance above 0.
fn spacing(node: &Node) -> Result<f64> {
    let value = node.quantity(Quantity::Length)?;
    match value > 0.0 && value <= 0.1 {
        true => Ok(value),
        false => Err(node.error(node.shown(), "a length above 0, 100 mm at most")),
    }
}

/// A slope above 0.
fn slope(node: &Node) -> Result<f64> {
    let value = node.number()?;
    match SLOPES.contains(&value) {
        true => Ok(value),
        false => Err(node.error(node.shown(), "a slope from 0.01 to 10")),
    }
}

/// The words of a value: a text as it is, a number as it is written.
fn words(node: &Node) -> Result<String> {
    match node.string() {
        Ok(text) => Ok(text),
        Err(_) => node.number().map(shortest),
    }
}

/// A value in words, read by `read`.
fn said<T>(
    node: &Node,
    goal: Goal,
    read: fn(&str, Goal) -> std::result::Result<T, Complaint>,
) -> Result<T> {
    let text =
        words(node).map_err(|_| node.error(node.shown(), "a number, or a text with a unit"))?;
    read(&text, goal).map_err(|complaint| node.complain(complaint))
}

fn target(node: &Node) -> Result<Target> {
    if !node.is_object() {
        // A target in words, as on the command line.
        let text = node.string()?;
        return aim_text::target(&text).map_err(|complaint| node.complain(complaint));
    }
    let mut mistakes = Mistakes::default();
    let keys: Vec<&str> = WAYS.into_iter().chain(["name", "within"]).collect();
    let object = node.object(&keys, &mut mistakes)?;
    let name = object.require("name", "\"name\": what is aimed at, such as \"f1_hz\"");
    let goal = name.and_then(|node| {
        aim_text::goal(&node.string()?).map_err(|complaint| node.complain(complaint))
    });
    let goal = match goal {
        Ok(goal) => goal,
        Err(error) => return mistakes.and(Err(error)),
    };
    let ask = ask(&object, goal);
    mistakes.and(ask.map(|ask| Target { goal, ask }))
}

fn ask(object: &Object, goal: Goal) -> Result<Ask> {
    let mut mistakes = Mistakes::default();
    let of = |key: &str| object.get(key).map(|node| said(node, goal, aim_text::value)).transpose();
    let within = object.get("within").map(|node| said(node, goal, aim_text::tolerance)).transpose();
    let within = mistakes.note(within);
    let change = object.get("change").map(|node| said(node, goal, aim_text::change)).transpose();
    let (change, value) = (mistakes.note(change), mistakes.note(of("value")));
    let (least, most) = (mistakes.note(of("at_least")), mistakes.note(of("at_most")));
    mistakes.end(())?;
    let there: Vec<&str> = WAYS.into_iter().filter(|key| object.get(key).is_some()).collect();
    let bounds = !there.is_empty() && there.iter().all(|key| key.starts_with("at_"));
    let together = |expected: &str| {
        let found = there.iter().map(|key| format!("\"{key}\"")).collect::<Vec<_>>().join(", ");
        let found = if found.is_empty() { "nothing that is wished".to_owned() } else { found };
        Err(object.node.error(found, expected))
    };
    match (change, value) {
        _ if bounds => {
            if let Some(node) = object.get("within") {
                let found = "\"within\" beside \"at_least\" or \"at_most\"";
                return Err(node.key().error(found, "it beside \"change\" or \"value\" alone"));
            }
            if let (Some(Amount::Si(least)), Some(Amount::Si(most))) = (least, most)
                && least > most
            {
                let found = "\"at_least\" above \"at_most\"";
                return Err(object.node.error(found, "limits that leave something between them"));
            }
            Ok(Ask::Between(least, most))
        }
        (Some(change), None) if there.len() == 1 => Ok(Ask::Change(change, within)),
        (None, Some(value)) if there.len() == 1 => Ok(Ask::Value(value, within)),
        _ => together("one of \"change\" and \"value\", or \"at_least\" and \"at_most\""),
    }
}

fn ends(object: &Object, mistakes: &mut Mistakes) -> [Option<f64>; 2] {
    ["from", "to"].map(|key| {
        let node = object.get(key).map(|node| node.quantity(Quantity::Length));
        mistakes.note(node.transpose())
    })
}

fn stretch(node: &Node) -> Result<[f64; 2]> {
    if !node.is_object() {
        return aim_text::stretch(&node.string()?).map_err(|complaint| node.complain(complaint));
    }
    let mut mistakes = Mistakes::default();
    let object = node.object(&["from", "to"], &mut mistakes)?;
    for key in ["from", "to"] {
        mistakes.note(object.require(key, "\"from\" and \"to\": a stretch of the bat").map(|_| ()));
    }
    let [from, to] = ends(&object, &mut mistakes).map(Option::unwrap_or_default);
    mistakes.end(())?;
    if from >= 0.0 && from < to {
        Ok([from, to])
    } else {
        Err(node.error(format!("{from} m to {to} m"), "a stretch that ends after it begins"))
    }
}

fn limit(node: &Node) -> Result<DiameterLimit> {
    let mut mistakes = Mistakes::default();
    let object = node.object(&["from", "to", "at_least", "at_most"], &mut mistakes)?;
    mistakes.note(object.require_some(&["at_least", "at_most"]));
    let [from, to] = ends(&object, &mut mistakes);
    let (from, to) = (from.unwrap_or(0.0), to.unwrap_or(f64::INFINITY));
    let mut of = |key: &str| {
        let node = object.get(key).map(|node| match node.quantity(Quantity::Length)? {
            value if value > 0.0 => Ok(value),
            _ => Err(node.error(node.shown(), "a diameter above 0")),
        });
        mistakes.note(node.transpose())
    };
    let (at_least, at_most) = (of("at_least"), of("at_most"));
    if from < 0.0 || from >= to {
        let end = if to.is_finite() { format!("{to} m") } else { "the tip".to_owned() };
        mistakes
            .add(node.error(format!("{from} m to {end}"), "a stretch that ends after it begins"));
    }
    if let (Some(least), Some(most)) = (at_least, at_most)
        && least > most
    {
        let found = "\"at_least\" above \"at_most\"";
        mistakes.add(node.error(found, "limits that leave something between them"));
    }
    mistakes.end(DiameterLimit { from, to, at_least, at_most })
}

fn free(node: &Node) -> Result<FreeChoice> {
    let mut mistakes = Mistakes::default();
    let object = node.object(&["length", "density", "wood", "knob_weight"], &mut mistakes)?;
    let mut range = |key: &str, quantity: Quantity| {
        let read = object.get(key).map(|node| {
            let items = node.items()?;
            let [from, to] = items.as_slice() else {
                return Err(node.error(format!("{} values", items.len()), "[least, greatest]"));
            };
            let range = [from.quantity(quantity)?, to.quantity(quantity)?];
            if range[0] > 0.0 && range[0] < range[1] {
                Ok(range)
            } else {
                Err(node.error("a range that does not rise", "[least, greatest], above 0"))
            }
        });
        mistakes.note(read.transpose())
    };
    let (length, density) =
        (range("length", Quantity::Length), range("density", Quantity::Density));
    let woods = object.get("wood").map_or(Ok(vec![]), |node| list(node, part_file::whole_material));
    let woods = mistakes.note(woods);
    let weight = object.get("knob_weight").map(|node| match node.quantity(Quantity::Mass)? {
        value if value > 0.0 && value < 1.0 => Ok(value),
        _ => Err(node.error(node.shown(), "a mass above 0, such as \"2 oz\"")),
    });
    let knob_weight = mistakes.note(weight.transpose());
    mistakes.end(FreeChoice { length, density, woods, knob_weight })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(text: &str) -> Vec<String> {
        match AimFile::from_text("aim.json", text) {
            Ok(_) => vec![],
            Err(Error::Several { shown, .. }) => shown.iter().map(Error::to_string).collect(),
            Err(one) => vec![one.to_string()],
        }
    }

    #[test]
    fn the_contract_s_example_is_read() {
        let text = r#"{ "format": "sweetspot-aim/1",
            "targets": [ { "name": "inertia_pivot_kg_m2", "change": "-3 %", "within": "5 oz in2" },
                         { "name": "exit_speed_max.x_m", "change": "1 cm outward", "within": "0.01 in" },
                         { "name": "mass_kg", "at_most": "31 oz" }, "f1 same" ],
            "rules": "mlb", "remove_only": true, "keep": [ { "from": 0, "to": "30 mm" } ],
            "diameter": [ { "from": "4 in", "to": "18 in", "at_least": "24 mm" } ], "stations": "10 mm" }"#;
        let wish = AimFile::from_text("aim.json", text).map(|file| file.wish).unwrap();
        assert_eq!(wish.targets.len(), 4);
        let Ask::Change(Amount::Si(by), Some(Amount::Si(within))) = wish.targets[1].ask else {
            panic!("{:?}", wish.targets)
        };
        assert!(by == 0.01 && (within - 0.000_254).abs() < 1e-18);
        assert!(wish.remove_only && wish.rules.is_some() && wish.keep == [[0.0, 0.03]]);
    }

    #[test]
    fn all_mistakes_are_told_at_once() {
        let text = r#"{ "format": "sweetspot-aim/1", "rules": "mbl", "remove_only": "yes",
            "targets": [ { "name": "f1_hx", "change": "1 Hz" }, { "name": "f1_hz" },
                         { "name": "mass_kg", "at_least": "31 oz", "at_most": "30 oz" },
                         { "name": "mass_kg", "value": "31 oz", "within": 0 } ],
            "keep": [ { "from": "3 in", "to": "2 in" } ], "diameter": [ { "from": 0 } ],
            "round": 0, "free": { "knob_weight": "2 Hz" } }"#;
        let said = told(text);
        assert!(said.len() >= 9, "{said:#?}");
        for part in ["did you mean mlb?", "f1_hz", "a tolerance above 0", "leave something between"]
        {
            assert!(said.iter().any(|line| line.contains(part)), "{part}: {said:#?}");
        }
    }
}
