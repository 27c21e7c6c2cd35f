//! How is a person's wish for a bat written? The `sweetspot-aim/1` file.

use std::ops::Bound::{Excluded, Included, Unbounded};
use std::path::{Path, PathBuf};

use schemars::{JsonSchema, json_schema};

use crate::aim::rules::RuleSet;
use crate::aim::wish::{self, Ask, DiameterLimit, FreeChoice, Goal, SLOPES, Target, Wish};
use crate::engine::{
    Amount, Complaint, Document, Error, Folder, Mistakes, Node, Object, Outside, Quantity, Result,
    part_file, shortest,
};
use crate::files::aim_text;
use crate::files::form::{Form, amount, at, few, later, number, text, truth};
use crate::files::rules_file;
use crate::files::written::{Written, WrittenFile, object, written};
use sweetspot::files::schema::part::Material;

/// An aim file, with which later mistakes find their place.
pub struct AimFile {
    document: Document,
    /// The wish.
    pub wish: Wish,
}

impl AimFile {
    /// Reads an aim file that a person has named, and the files outside its folder that it names.
    ///
    /// # Errors
    ///
    /// [`Error::Read`], or [`Error::Input`] with line and column, or several of them.
    pub fn named_by_a_person(path: &Path) -> Result<(Self, Vec<PathBuf>)> {
        let (document, outside) = (Document::read(path)?, Outside::default());
        let wish = AimForm::from_document(&document, &Folder::of(path, &outside))?;
        Ok((Self { document, wish }, outside.paths()))
    }

    /// An error about the wish, at its place in the file.
    pub fn placed(&self, error: Error) -> Error {
        let Ok(root) = Node::root(&self.document) else { return error };
        error.placed(|complaint| root.locate(complaint))
    }
}

written! {
    /// A wish for a bat: targets, rules of a game, limits of the diameter, allowed changes, and stretches that stay.
    /// Places count from the knob end.
    AimForm("aim", "Aim file") {
        /// Name of the wish.
        name = text();
        /// Targets. The command line may add more.
        targets = few(MOST, in_words::<AimParts>(TARGET, aim_text::target));
        /// Rules of a game: a built-in name, or a rule file from this file's folder.
        rules = text().like("mlb");
        /// Whether wood may only be taken off. By default false.
        remove_only = truth();
        /// Whether wood may be added to a bat that was weighed, which otherwise is only cut. By default false.
        add = truth();
        /// Stretches that stay as they are. By default the knob, 0 to 30 mm.
        keep = few(MOST, in_words::<AimEnds>(STRETCH, aim_text::stretch));
        /// Limits of the diameter, which hold along the whole curve.
        diameter = few(MOST, object::<AimLimit>());
        /// Distance between the written stations. By default 10 mm, or 0.5 in for a bat in inches.
        stations = spacing();
        /// Step to which diameters are rounded. By default 0.1 mm, or 0.005 in for a bat in inches.
        round = spacing();
        /// Greatest slope of the changed surface: change of the radius over length, 0.01 to 10. Where the bat is
        /// steeper already it does not become steeper.
        slope_at_most = number().within(SLOPES, "a slope from 0.01 to 10");
        /// Allowed changes besides the shape.
        free = object::<AimFree>();
    }
    |of| -> Wish {
        let usual = Wish::default();
        let set = of.at("rules").zip(rules).map(|(node, name)| rule_set(node, &name, of.folder));
        let rules = of.mistakes.note(set.transpose());
        let (remove_only, add) = (remove_only.unwrap_or_default(), add.unwrap_or_default());
        if let Some(node) = of.at("add").filter(|_| add && remove_only) {
            let error = node.error("\"add\" beside \"remove_only\"", "one of them");
            of.mistakes.add(error);
        }
        Ok(Wish {
            targets: targets.unwrap_or(usual.targets),
            rules,
            remove_only,
            add,
            keep: keep.unwrap_or(usual.keep),
            diameter: diameter.unwrap_or(usual.diameter),
            stations,
            round,
            slope: slope_at_most,
            free: free.unwrap_or(usual.free),
        })
    }
}

/// Most targets, stretches and limits: the time of a search grows faster than their number.
const MOST: usize = 20;
/// The parts and the words of a list of targets.
const TARGET: [&str; 2] = [
    "A target: in words, as on the command line, or in parts.",
    "In words, such as \"swing weight -3 % within 5 oz in2\".",
];
/// Descriptions of a stretch and of its words.
const STRETCH: [&str; 2] =
    ["A stretch of the bat: in words, or its ends.", "In words, such as \"0 to 30 mm\"."];

/// A value in words or in parts, with its description and that of the words.
fn in_words<W: Written<Made: 'static> + 'static>(
    [said, of_words]: [&'static str; 2],
    read: fn(&str) -> std::result::Result<W::Made, Complaint>,
) -> Form<W::Made> {
    let parts = object::<W>();
    Form::looking(
        move |generator| {
            let words = json_schema!({ "description": of_words, "type": "string" });
            let either = [words, generator.subschema_for::<W>()];
            json_schema!({ "description": said, "anyOf": either })
        },
        move |node| match node.is_object() {
            true => parts.read(node),
            false => read(&node.string()?).map_err(|complaint| node.complain(complaint)),
        },
    )
}

fn rule_set(node: &Node, name: &str, folder: &Folder) -> Result<RuleSet> {
    rules_file::named_in(name, folder).map_err(|error| match error {
        Error::Read { source, .. } => {
            node.error(format!("{name}, which cannot be read ({source})"), "a rule file")
        }
        error => at(node, error),
    })
}

/// A distance above 0.
fn spacing() -> Form<f64> {
    let range = (Excluded(0.0), Included(0.1));
    amount(Quantity::Length).within(range, "a length above 0, 100 mm at most")
}

/// A number in SI, or a text with a unit, a % or words.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(untagged)]
pub enum AimNumber {
    /// In SI.
    Number(f64),
    /// In words.
    Words(String),
}

written! {
    /// A target in parts: one of change and value, or at_least and at_most.
    AimParts {
        /// The change: a number in SI, or a text with a unit, in % of the present value, or with a direction.
        change = later::<AimNumber>().like("-3 %").like("1 cm outward");
        /// The new value.
        value = later::<AimNumber>().like("180 Hz").like("6.5 in from the tip");
        /// The least value.
        at_least = later::<AimNumber>().like("99.5 %");
        /// The greatest value.
        at_most = later::<AimNumber>().like("31 oz");
        /// The goal: the name of an output, drop, or a common name.
        name = Form::of::<String>(goal).like("inertia_pivot_kg_m2").like("sweet spot"),
            needed "\"name\": what is aimed at, such as \"f1_hz\"";
        /// The tolerance of the change or value.
        within = later::<AimNumber>().like("5 oz in2");
    }
    |of| -> Target {
        // All other members belong to the goal.
        let ask = name.map(|goal| ask(&of.object, goal)).transpose()?;
        let (goal, ask) = name.zip(ask).unwrap_or((Goal::Drop, Ask::Between(None, None)));
        Ok(Target { goal, ask })
    }
}

/// The goal.
fn goal(node: &Node) -> Result<Option<Goal>> {
    aim_text::goal(&node.string()?).map(Some).map_err(|complaint| node.complain(complaint))
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

const WAYS: [&str; 4] = ["change", "value", "at_least", "at_most"];

/// The wish for a goal.
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
            if let (Some(wish::Amount::Si(least)), Some(wish::Amount::Si(most))) = (least, most)
                && least > most
            {
                return Err(nothing_between(object));
            }
            Ok(Ask::Between(least, most))
        }
        (Some(change), None) if there.len() == 1 => Ok(Ask::Change(change, within)),
        (None, Some(value)) if there.len() == 1 => Ok(Ask::Value(value, within)),
        _ => together("one of \"change\" and \"value\", or \"at_least\" and \"at_most\""),
    }
}

written! {
    /// The ends of a stretch.
    AimEnds {
        /// Beginning.
        from = amount(Quantity::Length), needed ENDS;
        /// End.
        to = amount(Quantity::Length), needed ENDS;
    }
    |of| -> [f64; 2] {
        of.sound()?;
        if from >= 0.0 && from < to { Ok([from, to]) } else { Err(of.node().error(format!("{from} m to {to} m"), RISING)) }
    }
}

const ENDS: &str = "\"from\" and \"to\": a stretch of the bat";
const RISING: &str = "a stretch that ends after it begins";

written! {
    /// Limits of the diameter on a stretch.
    AimLimit with { "anyOf": [{ "required": ["at_least"] }, { "required": ["at_most"] }] } {
        /// Beginning of the stretch. By default the knob end.
        from = amount(Quantity::Length);
        /// End of the stretch. By default the tip.
        to = amount(Quantity::Length);
        /// Least diameter.
        at_least = above_0();
        /// Greatest diameter.
        at_most = above_0();
    }
    |of| -> DiameterLimit {
        let some = of.object.require_some(&["at_least", "at_most"]);
        of.mistakes.note(some);
        let (from, to) = (from.unwrap_or(0.0), to.unwrap_or(f64::INFINITY));
        if from < 0.0 || from >= to {
            let end = if to.is_finite() { format!("{to} m") } else { "the tip".to_owned() };
            of.mistakes.add(of.object.node.error(format!("{from} m to {end}"), RISING));
        }
        if at_least.zip(at_most).is_some_and(|(least, most)| least > most) {
            of.mistakes.add(nothing_between(&of.object));
        }
        Ok(DiameterLimit { from, to, at_least, at_most })
    }
}

/// A diameter.
fn above_0() -> Form<f64> {
    amount(Quantity::Length).within((Excluded(0.0), Unbounded), "a diameter above 0")
}

/// An error about limits of which the lower one is above the other.
fn nothing_between(object: &Object) -> Error {
    let expected = "limits that leave something between them";
    object.node.error("\"at_least\" above \"at_most\"", expected)
}

written! {
    /// Allowed changes besides the shape.
    AimFree {
        /// Least and greatest length; everything on the bat moves with it.
        length = range(Quantity::Length);
        /// Least and greatest density of the bat's own material, with unchanged moduli.
        density = range(Quantity::Density);
        /// Materials, of which the one that needs the least change is chosen.
        wood = few(MOST, Form::of::<Material>(part_file::whole_material));
        /// Greatest weight on the knob end.
        knob_weight = amount(Quantity::Mass)
            .within((Excluded(0.0), Excluded(1.0)), "a mass above 0, such as \"2 oz\"");
    }
    |_| -> FreeChoice {
        Ok(FreeChoice { length, density, woods: wood.unwrap_or_default(), knob_weight })
    }
}

/// The least and the greatest value.
fn range(quantity: Quantity) -> Form<[f64; 2]> {
    Form::of::<(Amount, Amount)>(move |node| {
        let items = node.items()?;
        let [from, to] = items.as_slice() else {
            return Err(node.error(format!("{} values", items.len()), "[least, greatest]"));
        };
        let range = [from.quantity(quantity)?, to.quantity(quantity)?];
        match range[0] > 0.0 && range[0] < range[1] {
            true => Ok(range),
            false => Err(node.error("a range that does not rise", "[least, greatest], above 0")),
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(text: &str) -> Vec<String> {
        match AimForm::from_text("aim.json", text, Path::new("")) {
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
        let wish = AimForm::from_text("aim.json", text, Path::new("")).unwrap();
        assert_eq!(wish.targets.len(), 4);
        let Ask::Change(wish::Amount::Si(by), Some(wish::Amount::Si(within))) = wish.targets[1].ask
        else {
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
