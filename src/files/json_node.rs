//! JSON with the place of every value.
//!
//! `serde_json` checks the grammar and reads the scalars; this module keeps each value as the
//! slice of text it came from, so that an error can name file, line and column.

use std::collections::HashSet;
use std::fmt;
use std::ops::Range;

use serde::de::{Deserialize, Deserializer, MapAccess, Visitor};
use serde_json::Value;
use serde_json::value::RawValue;

use crate::base::{
    Complaint, Error, FilePosition, Mistakes, Quantity, Result, mistakes, nearest, shortened, units,
};
use crate::files::broken_json;
use crate::files::document::Document;

/// Most members of an object that are checked one by one; there are far fewer keys.
const MOST_MEMBERS: usize = 1000;

/// One JSON value and its place.
#[derive(Clone)]
pub struct Node<'a> {
    document: &'a Document,
    /// Path from the root, such as `profile.x[3]`.
    pub path: String,
    raw: &'a str,
}

impl<'a> Node<'a> {
    /// The value of a whole document.
    pub fn root(document: &'a Document) -> Result<Self> {
        if document.text.trim().is_empty() {
            let complaint = Complaint::new("", "an empty file", "a JSON object");
            return Err(document.error(0..0, complaint));
        }
        let is_object = document.text.trim_start().starts_with('{');
        match serde_json::from_str::<&RawValue>(&document.text) {
            Ok(raw) if !is_object && raw.get().starts_with('"') => {
                Err(broken_json::not_an_object(document))
            }
            Err(_) if !is_object => Err(broken_json::not_an_object(document)),
            Ok(raw) => Ok(Self { document, path: String::new(), raw: raw.get() }),
            Err(error) => Err(broken_json::told(document, &error)),
        }
    }

    /// An error about this value, with the given words.
    pub fn error(&self, found: impl fmt::Display, expected: impl Into<String>) -> Error {
        self.complain(Complaint::new("", found, expected))
    }

    /// An error about this value; the path is filled in if the complaint has none.
    pub fn complain(&self, mut complaint: Complaint) -> Error {
        if complaint.field.is_empty() {
            complaint.field.clone_from(&self.path);
        }
        let offset = self.offset();
        self.document.error(offset..offset + self.raw.len(), complaint)
    }

    /// An error about a part of this text, in bytes; about the whole value if the file writes the text with escapes.
    pub fn complain_of(&self, part: Range<usize>, mut complaint: Complaint) -> Error {
        complaint.field.clone_from(&self.path);
        if self.raw.contains('\\') {
            return self.complain(complaint);
        }
        // After the quote.
        let start = self.offset() + 1;
        self.document.error(start + part.start..start + part.end, complaint)
    }

    /// Position of the value.
    pub fn place(&self) -> Box<FilePosition> {
        let offset = self.offset();
        self.document.placed(offset..offset + self.raw.len())
    }

    /// Offset of the value in the text, in bytes.
    fn offset(&self) -> usize {
        // Both are slices of the same text, so the difference of the addresses is the offset.
        self.raw.as_ptr() as usize - self.document.text.as_ptr() as usize
    }

    /// The key of this value, a member of an object, in its quotes.
    pub fn key(&self) -> Self {
        let text = &self.document.text;
        let before = text[..self.offset()].trim_end().trim_end_matches(':').trim_end();
        // A quote inside a key has a backslash before it; the opening quote has none.
        let inside = before.strip_suffix('"').unwrap_or(before);
        let opens = |(at, _): &(usize, &str)| !inside[..*at].ends_with('\\');
        let start = inside.rmatch_indices('"').find(opens).map_or(0, |(at, _)| at);
        Self { raw: &text[start..before.len()], ..self.clone() }
    }

    /// An error about the value at the path in a complaint; the path begins at the root and must begin with that of
    /// this value. If the value has a unit in the file, it is quoted as written too.
    pub fn locate(&self, mut complaint: Complaint) -> Error {
        let inside = complaint.field.strip_prefix(&*self.path).unwrap_or(&complaint.field);
        let place = self.nearest(inside.strip_prefix('.').unwrap_or(inside));
        if place.path == complaint.field && place.raw.starts_with('"') {
            complaint.found = format!("{} ({})", place.shown(), complaint.found);
        }
        place.complain(complaint)
    }

    /// The value at a path from here, such as `attachments[1].x`; if it does not exist, the nearest value around it.
    pub fn nearest(&self, path: &str) -> Self {
        let mut node = self.clone();
        for step in path.split(['.', '[']) {
            let inner = match step.strip_suffix(']') {
                Some(k) => k.parse().ok().map(|k| node.item(k)).filter(|item| item.raw != node.raw),
                None => node.members().ok().and_then(|members| members.get(step).cloned()),
            };
            let Some(inner) = inner else { break };
            node = inner;
        }
        node
    }

    /// The value itself, shortened, for a message.
    pub fn shown(&self) -> String {
        let kind = match self.raw.as_bytes().first() {
            Some(b'{') => return "an object".into(),
            Some(b'[') => return "a list".into(),
            _ => self.raw,
        };
        shortened(kind, 40)
    }

    fn wrong(&self, expected: impl Into<String>) -> Error {
        self.error(self.shown(), expected)
    }

    /// The members of an object, checked by [`Object::only`].
    pub fn object(&self, known: &[&str], mistakes: &mut Mistakes) -> Result<Object<'a>> {
        Ok(self.members()?.only(known, mistakes))
    }

    /// The members of an object, whatever their keys.
    pub fn members(&self) -> Result<Object<'a>> {
        let entries: Entries = serde_json::from_str(self.raw).map_err(|error| {
            let said = error.to_string();
            let said = said.split(" at line ").next().unwrap_or_default();
            let found =
                if self.is_object() { format!("broken JSON, {said}") } else { self.shown() };
            self.error(found, "an object { … }")
        })?;
        if entries.0.len() > MOST_MEMBERS {
            let found = format!("an object of {} members", entries.0.len());
            return Err(self.error(found, format!("at most {MOST_MEMBERS}")));
        }
        let member = |(key, raw): (String, &'a RawValue)| {
            let shown = shortened(&key, 40);
            let path = if self.path.is_empty() { shown } else { format!("{}.{shown}", self.path) };
            (key, Node { document: self.document, path, raw: raw.get() })
        };
        let members = entries.0.into_iter().map(member).collect();
        Ok(Object { node: self.clone(), members, strayed: false })
    }

    pub fn is_object(&self) -> bool {
        self.raw.starts_with('{')
    }

    /// A text.
    pub fn string(&self) -> Result<String> {
        serde_json::from_str(self.raw).map_err(|_| self.wrong("a text in quotes"))
    }

    /// One of a closed set of words.
    pub fn word<T: Copy>(&self, choices: &[(&str, T)]) -> Result<T> {
        let names: Vec<&str> = choices.iter().map(|c| c.0).collect();
        let expected = format!("one of {}", names.join(", "));
        let word = self.string().map_err(|_| self.wrong(expected.clone()))?;
        let found = choices.iter().find(|c| c.0 == word);
        found.map(|(_, choice)| *choice).ok_or_else(|| {
            let complaint = Complaint::new("", self.shown(), expected);
            self.complain(complaint.or_nearest(&word, &names))
        })
    }

    /// The value as plain JSON.
    pub fn value(&self) -> Value {
        serde_json::from_str(self.raw).unwrap_or_default()
    }

    /// A pure number, such as a ratio.
    pub fn number(&self) -> Result<f64> {
        match serde_json::from_str::<f64>(self.raw) {
            Ok(value) if value.is_finite() => Ok(value),
            _ => Err(self.wrong("a finite number")),
        }
    }

    /// A whole number, however it is written: `1000` or `1e3`.
    pub fn whole(&self) -> Result<u64> {
        /// Whole numbers up to this are exact with a point or an exponent too.
        const MOST: f64 = 9_007_199_254_740_992.0;
        if let Ok(value) = serde_json::from_str(self.raw) {
            return Ok(value);
        }
        let wrong = || self.wrong(format!("a whole number, 0 to {}", u64::MAX));
        let value = self.number().map_err(|_| wrong())?;
        let is_whole = value.fract() == 0.0 && (0.0..=MOST).contains(&value);
        is_whole.then_some(value as u64).ok_or_else(wrong)
    }

    /// A number in SI, or a text with a unit.
    pub fn quantity(&self, quantity: Quantity) -> Result<f64> {
        self.scaled(quantity, quantity.si())
    }

    /// As [`Self::quantity`], with bare numbers in that unit.
    fn scaled(&self, quantity: Quantity, (unit, factor): (&str, f64)) -> Result<f64> {
        if let Ok(text) = serde_json::from_str::<String>(self.raw) {
            let value = units::parse_beside(&text, quantity, unit);
            return value.map_err(|complaint| self.complain(complaint));
        }
        match serde_json::from_str::<f64>(self.raw) {
            Ok(value) if (value * factor).is_finite() => Ok(value * factor),
            _ => Err(self.wrong(quantity.expected_in(unit))),
        }
    }

    /// A list of quantities, with bare numbers in the unit of that name and factor to SI.
    pub fn quantities(&self, quantity: Quantity, unit: (&str, f64)) -> Result<Vec<f64>> {
        // The fast way for a million stations; unusual lists are read item by item.
        if let Ok(values) = serde_json::from_str::<Vec<f64>>(self.raw)
            && values.iter().all(|v| (v * unit.1).is_finite())
        {
            return Ok(values.into_iter().map(|v| v * unit.1).collect());
        }
        mistakes::all(self.items()?.iter().map(|item| item.scaled(quantity, unit)))
    }

    /// The items of a list.
    pub fn items(&self) -> Result<Vec<Node<'a>>> {
        let raws: Vec<&RawValue> =
            serde_json::from_str(self.raw).map_err(|_| self.wrong("a list [ … ]"))?;
        let item = |(k, raw): (usize, &&'a RawValue)| Node {
            document: self.document,
            path: format!("{}[{k}]", self.path),
            raw: raw.get(),
        };
        Ok(raws.iter().enumerate().map(item).collect())
    }

    /// Item `k` of a list, or the list itself if it is too short.
    pub fn item(&self, k: usize) -> Self {
        let raws: Option<Vec<&'a RawValue>> = serde_json::from_str(self.raw).ok();
        raws.and_then(|raws| raws.get(k).map(|raw| raw.get())).map_or_else(
            || self.clone(),
            |raw| Self { document: self.document, path: format!("{}[{k}]", self.path), raw },
        )
    }

    /// Checks that a comment is a text, or a list of texts.
    fn check_comment(&self) -> Result<()> {
        let expected = "a text, or a list of texts";
        if self.raw.starts_with('[') {
            let text = |item: &Node| item.string().map_err(|_| item.wrong(expected)).map(|_| ());
            return mistakes::all(self.items()?.iter().map(text)).map(|_| ());
        }
        self.string().map_err(|_| self.wrong(expected)).map(|_| ())
    }
}

/// The members of one JSON object, in the order of the file.
pub struct Object<'a> {
    pub node: Node<'a>,
    members: Vec<(String, Node<'a>)>,
    /// Whether an unknown key was reported.
    strayed: bool,
}

impl<'a> Object<'a> {
    /// This object after a report of every mistake in its keys: those that occur twice, and those that are neither
    /// `known` nor "comment". If a key near an unknown one is missing, the value is taken for it, so that a slip is
    /// reported once.
    pub fn only(mut self, known: &[&str], mistakes: &mut Mistakes) -> Self {
        let names: Vec<&str> = known.iter().copied().chain(["comment"]).collect();
        let mut seen: HashSet<String> = self.members.iter().map(|(key, _)| key.clone()).collect();
        let unknown = self.members.iter_mut().map(|(key, node)| {
            if names.contains(&&**key) {
                return Ok(());
            }
            let shown = shortened(key, 40);
            let found = format!("unknown key \"{shown}\"");
            let expected = match nearest(&shown, &names) {
                Some(name) => format!("\"{name}\""),
                None => format!("one of {}", known.join(", ")),
            };
            let complaint = Complaint::new("", found, expected).or_nearest(&shown, &names);
            let error = node.key().complain(complaint);
            if let Some(meant) = nearest(&shown, known).filter(|meant| seen.insert((*meant).into()))
            {
                *key = meant.to_owned();
            }
            Err(error)
        });
        let unknown = mistakes::all(unknown);
        self.strayed = unknown.is_err();
        mistakes.note(unknown.map(|_| ()));
        mistakes.note(self.check_once());
        let comments = self.members.iter().filter(|(key, _)| key == "comment");
        mistakes.note(mistakes::all(comments.map(|(_, node)| node.check_comment())).map(|_| ()));
        self
    }

    /// An error for every key that occurs twice.
    fn check_once(&self) -> Result<()> {
        let mut seen = HashSet::new();
        let again = self.members.iter().map(|(key, node)| {
            if seen.insert(key) {
                return Ok(());
            }
            let found = format!("key \"{}\" a second time", shortened(key, 40));
            Err(node.key().error(found, "it once"))
        });
        mistakes::all(again).map(|_| ())
    }

    /// An error if "format" names another format than `reads`; a file without it may have any.
    pub fn check_format(&self, reads: &str) -> Result<()> {
        let Some(node) = self.get("format") else { return Ok(()) };
        let Ok(found) = node.string() else { return Err(node.wrong(format!("\"{reads}\""))) };
        if found == reads {
            return Ok(());
        }
        let kind = |format: &str| format.split('/').next().unwrap_or_default().to_owned();
        let hint = match kind(&found) {
            same if same == kind(reads) => format!(
                "this is version {} of sweetspot, which reads {reads} only: write the file so, or \
                 get the version that it was written for",
                env!("CARGO_PKG_VERSION")
            ),
            other => match (written_by_people(&other), written_by_people(&kind(reads))) {
                (Some(other), Some(wanted)) => format!("this is {other}, not {wanted}"),
                (Some(other), None) => format!("this is {other}"),
                (None, _) if other.starts_with("sweetspot-") => {
                    "this is a result of sweetspot, not what it was made from".to_owned()
                }
                (None, _) => String::new(),
            },
        };
        let complaint = Complaint::new("", node.shown(), format!("\"{reads}\""));
        Err(node.complain(complaint.hinted(hint)))
    }

    /// All members, in the order of the file.
    pub fn keys(&self) -> &[(String, Node<'a>)] {
        &self.members
    }

    pub fn get(&self, key: &str) -> Option<&Node<'a>> {
        self.members.iter().find(|(name, _)| name == key).map(|(_, node)| node)
    }

    /// A required member; `expected` describes it.
    pub fn require(&self, key: &str, expected: &str) -> Result<&Node<'a>> {
        self.get(key).ok_or_else(|| self.node.error(format!("no \"{key}\""), expected))
    }

    /// An error unless at least one of these members exists, or an unknown key was reported that may stand for one.
    pub fn require_some(&self, keys: &[&str]) -> Result<()> {
        if self.strayed || keys.iter().any(|key| self.get(key).is_some()) {
            return Ok(());
        }
        let names: Vec<String> = keys.iter().map(|key| format!("\"{key}\"")).collect();
        let names = names.join(", ");
        Err(self.node.error(format!("none of {names}"), "one of them at least"))
    }

    /// The one member of a set of alternatives that exists, if any; two are an error.
    pub fn one_of(&self, keys: &[&'static str]) -> Result<Option<(&'static str, &Node<'a>)>> {
        let mut found = None;
        for &key in keys {
            match (found, self.get(key)) {
                (None, Some(node)) => found = Some((key, node)),
                (Some((first, _)), Some(node)) => {
                    let both = format!("both \"{first}\" and \"{key}\"");
                    return Err(node.key().error(both, "one of them"));
                }
                (_, None) => {}
            }
        }
        Ok(found)
    }

    pub fn string(&self, key: &str) -> Result<Option<String>> {
        self.get(key).map(Node::string).transpose()
    }
}

/// An object as its keys and raw values, with duplicates kept so that they can be reported.
struct Entries<'a>(Vec<(String, &'a RawValue)>);

impl<'de: 'a, 'a> Deserialize<'de> for Entries<'a> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> std::result::Result<Self, D::Error> {
        struct Members;
        impl<'de> Visitor<'de> for Members {
            type Value = Entries<'de>;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("an object")
            }
            fn visit_map<A: MapAccess<'de>>(
                self,
                mut map: A,
            ) -> std::result::Result<Self::Value, A::Error> {
                let mut entries = Vec::new();
                while let Some(entry) = map.next_entry::<String, &RawValue>()? {
                    entries.push(entry);
                }
                Ok(Entries(entries))
            }
        }
        deserializer.deserialize_map(Members)
    }
}

/// What a file of that format is called, if people write such files.
fn written_by_people(format: &str) -> Option<&'static str> {
    Some(match format.strip_prefix("sweetspot-")? {
        "bat" => "a bat",
        "ball" => "a ball",
        "study" => "a study",
        "aim" => "a wish",
        "rules" => "the rules of a game",
        "readings" => "readings of a bat",
        "scatter" => "what differs between bats",
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The object of a document, whatever is wrong with its keys.
    fn object<'a>(document: &'a Document, known: &[&str]) -> Object<'a> {
        Node::root(document).unwrap().object(known, &mut Mistakes::default()).unwrap()
    }

    /// The mistakes in the keys of a text, one line each.
    fn told(text: &str, known: &[&str]) -> Vec<String> {
        let document = Document::new("f".into(), text);
        let mut mistakes = Mistakes::default();
        Node::root(&document).unwrap().object(known, &mut mistakes).unwrap();
        match mistakes.end(()) {
            Ok(()) => vec![],
            Err(Error::Several { shown, .. }) => shown.iter().map(Error::to_string).collect(),
            Err(one) => vec![one.to_string()],
        }
    }

    #[test]
    fn an_error_names_file_line_column_and_field() {
        let text = "\u{feff}{\r\n  \"é\": 1,\r\n  \"a\": { \"b\": [1, \"2 lbf\"] }\r\n}";
        let document = Document::new("bat.json".into(), text);
        let root = object(&document, &["é", "a"]);
        let inner = root.get("a").unwrap().object(&["b"], &mut Mistakes::default()).unwrap();
        let list = inner.get("b").unwrap().clone();
        let said = list.quantities(Quantity::Mass, Quantity::Mass.si()).unwrap_err().to_string();
        assert!(said.starts_with("bat.json:3:19: a.b[1]: found unit \"lbf\""), "{said}");
    }

    #[test]
    fn a_complaint_finds_its_value_or_what_is_around_it() {
        let text = "{\n \"a\": [{}, { \"x\": \"5 in\" }]\n}";
        let document = Document::new("bat.json".into(), text);
        let root = Node::root(&document).unwrap();
        for (path, place, found) in [
            ("a[1].x", "2:19", "\"5 in\" (0.127 m)"),
            ("a[1].y", "2:12", "0.127 m"),
            ("a[2].x", "2:7", "0.127 m"),
            ("a.x", "2:7", "0.127 m"),
            ("mass", "1:1", "0.127 m"),
        ] {
            let said = root.locate(Complaint::new(path, "0.127 m", "less")).to_string();
            assert_eq!(said, format!("bat.json:{place}: {path}: found {found}, expected less"));
        }
    }

    #[test]
    fn a_complaint_from_inside_finds_its_value_too() {
        let document = Document::new("f".into(), "{ \"a\": [{}, { \"x\": 5 }] }");
        let item = Node::root(&document).unwrap().nearest("a[1]");
        let said = item.locate(Complaint::new("a[1].x", "5 m", "less")).to_string();
        assert_eq!(said, "f:1:20: a[1].x: found 5 m, expected less");
    }

    #[test]
    fn every_wrong_key_is_told_at_its_own_place() {
        let found = told("{\"mass\": 1, \"mass\": 2, \"\\\"x:\\\\\" : 3}", &["mass"]);
        assert_eq!(found.len(), 2, "{found:?}");
        assert!(found[0].starts_with("f:1:13: mass: found key \"mass\" a second"), "{found:?}");
        assert!(found[1].starts_with("f:1:24: \"x:\\: found unknown key"), "{found:?}");
        assert!(found[1].ends_with("expected one of mass"), "{found:?}");
        let many = (0..30).map(|k| format!("\"k{k}\": 0")).collect::<Vec<_>>().join(", ");
        assert_eq!(told(&format!("{{{many}}}"), &["mass"]).len(), 10);
    }

    #[test]
    fn a_misspelt_key_is_told_once_and_taken_for_what_it_means() {
        let document = Document::new("f".into(), "{\"densty\": 1, \"Mass\": 2, \"mass\": 3}");
        let object = object(&document, &["density", "mass"]);
        assert_eq!(object.get("density").unwrap().number().unwrap(), 1.0);
        assert_eq!(object.get("mass").unwrap().number().unwrap(), 3.0);
        let found = told(&document.text, &["density", "mass"]);
        assert!(found.len() == 2 && found[0].ends_with("; did you mean density?"), "{found:?}");
    }

    #[test]
    fn a_comment_is_a_text_or_a_list_of_texts() {
        for good in ["\"\"", "[]", "[\"a\", \"b\"]"] {
            assert!(told(&format!("{{\"comment\": {good}}}"), &[]).is_empty(), "{good}");
        }
        for (bad, place) in [("1", "1:13"), ("{}", "1:13"), ("[\"a\", null]", "1:19")] {
            let found = told(&format!("{{\"comment\": {bad}}}"), &[]);
            assert_eq!(found.len(), 1, "{bad}");
            assert!(found[0].starts_with(&format!("f:{place}: comment")), "{found:?}");
            assert!(found[0].contains("a text, or a list of texts"), "{found:?}");
        }
        assert!(told("{\"coment\": \"\"}", &["mass"])[0].contains("did you mean comment?"));
    }
}
