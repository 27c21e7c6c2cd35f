//! Where in the file did this value stand: JSON with the place of every value.
//!
//! `serde_json` checks the grammar and reads the scalars; this module keeps each value as the
//! slice of text it came from, so that an error can name file, line and column.

use std::collections::HashSet;
use std::fmt;
use std::path::Path;

use serde::de::{Deserialize, Deserializer, MapAccess, Visitor};
use serde_json::value::RawValue;

use crate::error::{Complaint, Error, Place, Result, nearest, shortened};
use crate::units::{self, Quantity};

/// The text of one input file, a byte-order mark removed.
pub(crate) struct Document {
    pub file: String,
    pub text: String,
}

impl Document {
    /// Reads a file as UTF-8.
    pub fn read(path: &Path) -> Result<Self> {
        let read = |source| Error::Read { path: path.to_owned(), source };
        let bytes = std::fs::read(path).map_err(read)?;
        let file = path.display().to_string();
        match String::from_utf8(bytes) {
            Ok(text) => Ok(Self::new(file, &text)),
            Err(error) => {
                let before = error.utf8_error().valid_up_to();
                let text = String::from_utf8_lossy(&error.as_bytes()[..before]).into_owned();
                let document = Self { file, text };
                let place = document.place(before);
                let utf_16 = matches!(error.as_bytes(), [0xff, 0xfe, ..] | [0xfe, 0xff, ..]);
                let found = if utf_16 { "UTF-16 text" } else { "bytes that are not text" };
                let complaint = Complaint::new("", found, "UTF-8 text");
                Err(Error::Input { place, complaint })
            }
        }
    }

    pub fn new(file: String, text: &str) -> Self {
        Self { file, text: text.trim_start_matches('\u{feff}').to_owned() }
    }

    /// The value of the whole document.
    pub fn root(&self) -> Result<Node<'_>> {
        if self.text.trim().is_empty() {
            return Err(self.error(0, Complaint::new("", "an empty file", "a JSON object")));
        }
        match serde_json::from_str::<&RawValue>(&self.text) {
            Ok(raw) => Ok(Node { document: self, path: String::new(), raw: raw.get() }),
            Err(error) => Err(self.broken(&error)),
        }
    }

    /// What `serde_json` says of text that is not JSON, in found and expected, with its place.
    fn broken(&self, error: &serde_json::Error) -> Error {
        let line = self.text.split_inclusive('\n').take(error.line().saturating_sub(1));
        let offset = line.map(str::len).sum::<usize>() + error.column().saturating_sub(1);
        let mut offset = if error.is_eof() { self.text.trim_end().len() } else { offset };
        while !self.text.is_char_boundary(offset) {
            offset -= 1;
        }
        let said = error.to_string();
        let said = said.split(" at line ").next().unwrap_or_default();
        let rest = &self.text[offset..];
        // The word that stands there, or the one character that ends words.
        let ends = |c: char| c.is_whitespace() || ",:[]{}".contains(c);
        let here = rest.find(ends).map_or(rest, |end| &rest[..end]);
        let here = if here.is_empty() { rest.get(..1).unwrap_or(rest) } else { here };
        let complaint = match said.strip_prefix("expected ") {
            _ if error.is_eof() => {
                let rest = said.strip_prefix("EOF while parsing ").unwrap_or("the text");
                Complaint::new("", "the end of the file", format!("the rest of {rest}"))
            }
            Some("value") => {
                let expected = "a JSON value (and numbers as in 0.5 or -1e3)";
                Complaint::new("", shortened(here, 20), expected)
            }
            Some(expected) => Complaint::new("", shortened(here, 20), expected),
            None => Complaint::new("", format!("broken JSON, {said}"), "JSON"),
        };
        self.error(offset, complaint)
    }

    /// An error at a byte offset of the text.
    pub fn error(&self, offset: usize, complaint: Complaint) -> Error {
        Error::Input { place: self.place(offset), complaint }
    }

    fn place(&self, offset: usize) -> Place {
        let before = &self.text[..offset];
        let line = 1 + before.bytes().filter(|b| *b == b'\n').count();
        let start = before.rfind('\n').map_or(0, |at| at + 1);
        Place { file: self.file.clone(), line, column: 1 + before[start..].chars().count() }
    }
}

/// One JSON value and where it stands.
#[derive(Clone)]
pub(crate) struct Node<'a> {
    document: &'a Document,
    /// Path from the root, such as `profile.x[3]`.
    pub path: String,
    raw: &'a str,
}

impl<'a> Node<'a> {
    /// An error about this value, in the words given.
    pub fn error(&self, found: impl fmt::Display, expected: impl Into<String>) -> Error {
        self.complain(Complaint::new("", found, expected))
    }

    /// An error about this value; the path is filled in where the complaint has none.
    pub fn complain(&self, mut complaint: Complaint) -> Error {
        if complaint.field.is_empty() {
            complaint.field.clone_from(&self.path);
        }
        // Both are slices of the same text, so the difference of addresses is the offset.
        let offset = self.raw.as_ptr() as usize - self.document.text.as_ptr() as usize;
        self.document.error(offset, complaint)
    }

    /// An error about the value at the path in a complaint, from this one, which is the root. What
    /// was found is shown as it stands in the file too, where that has a unit.
    pub fn locate(&self, mut complaint: Complaint) -> Error {
        let place = self.nearest(&complaint.field);
        if place.path == complaint.field && place.raw.starts_with('"') {
            complaint.found = format!("{} ({})", place.shown(), complaint.found);
        }
        place.complain(complaint)
    }

    /// The value at a path from here, such as `attachments[1].x`; where it is not there, the
    /// nearest one around it.
    pub fn nearest(&self, path: &str) -> Self {
        let mut node = self.clone();
        for step in path.split(['.', '[']) {
            let inner = match step.strip_suffix(']') {
                Some(k) => k.parse::<usize>().ok().and_then(|k| node.items().ok()?.get(k).cloned()),
                None => node.members().ok().and_then(|members| members.get(step).cloned()),
            };
            let Some(inner) = inner else { break };
            node = inner;
        }
        node
    }

    /// The value itself, shortened, to be shown in a message.
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

    /// The members of an object; a key that is not in `known` is an error with a hint.
    pub fn object(&self, known: &[&str]) -> Result<Object<'a>> {
        self.members()?.only(known)
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
        let mut members = Vec::with_capacity(entries.0.len());
        let mut seen = HashSet::new();
        for (key, raw) in entries.0 {
            let shown = shortened(&key, 40);
            let path = if self.path.is_empty() { shown } else { format!("{}.{shown}", self.path) };
            let node = Node { document: self.document, path, raw: raw.get() };
            if !seen.insert(key.clone()) {
                return Err(node.error(format!("key \"{key}\" a second time"), "it once"));
            }
            members.push((key, node));
        }
        Ok(Object { node: self.clone(), members })
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
        match choices.iter().find(|c| c.0 == word) {
            Some((_, choice)) => Ok(*choice),
            None => Err(self.wrong(match nearest(&word, &names) {
                Some(name) => format!("{expected} (did you mean {name}?)"),
                None => expected,
            })),
        }
    }

    /// A pure number, such as a ratio.
    pub fn number(&self) -> Result<f64> {
        match serde_json::from_str::<f64>(self.raw) {
            Ok(value) if value.is_finite() => Ok(value),
            _ => Err(self.wrong("a finite number")),
        }
    }

    /// A number in SI, or a text with a unit.
    pub fn quantity(&self, quantity: Quantity) -> Result<f64> {
        self.scaled(quantity, 1.0)
    }

    /// As [`Self::quantity`], bare numbers times `unit`.
    fn scaled(&self, quantity: Quantity, unit: f64) -> Result<f64> {
        if let Ok(text) = serde_json::from_str::<String>(self.raw) {
            return units::parse(&text, quantity).map_err(|complaint| self.complain(complaint));
        }
        match serde_json::from_str::<f64>(self.raw) {
            Ok(value) if (value * unit).is_finite() => Ok(value * unit),
            _ => Err(self.wrong(quantity.expected())),
        }
    }

    /// A list of quantities, bare numbers times `unit`.
    pub fn quantities(&self, quantity: Quantity, unit: f64) -> Result<Vec<f64>> {
        // The fast way for a million stations; anything unusual goes item by item.
        if let Ok(values) = serde_json::from_str::<Vec<f64>>(self.raw)
            && values.iter().all(|v| (v * unit).is_finite())
        {
            return Ok(values.into_iter().map(|v| v * unit).collect());
        }
        self.items()?.iter().map(|item| item.scaled(quantity, unit)).collect()
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

    /// Item `k` of a list that [`Self::items`] accepts, else the list itself.
    pub fn item(&self, k: usize) -> Node<'a> {
        self.items().ok().and_then(|items| items.get(k).cloned()).unwrap_or_else(|| self.clone())
    }
}

/// The members of one JSON object, in the order of the file.
pub(crate) struct Object<'a> {
    pub node: Node<'a>,
    members: Vec<(String, Node<'a>)>,
}

impl<'a> Object<'a> {
    /// The same, if all keys are `known`; one that is not is an error with a hint.
    pub fn only(self, known: &[&str]) -> Result<Self> {
        let Some((key, node)) = self.members.iter().find(|(key, _)| !known.contains(&&**key))
        else {
            return Ok(self);
        };
        let key = shortened(key, 40);
        let hint = match nearest(&key, known) {
            Some(name) => format!("\"{name}\" (did you mean that?)"),
            None => format!("one of {}", known.join(", ")),
        };
        Err(node.error(format!("unknown key \"{key}\""), hint))
    }

    pub fn get(&self, key: &str) -> Option<&Node<'a>> {
        self.members.iter().find(|(name, _)| name == key).map(|(_, node)| node)
    }

    /// A member that must be there; `expected` says what it would be.
    pub fn require(&self, key: &str, expected: &str) -> Result<&Node<'a>> {
        self.get(key).ok_or_else(|| self.node.error(format!("no \"{key}\""), expected))
    }

    /// An error unless one of these members at least is there.
    pub fn require_some(&self, keys: &[&str]) -> Result<()> {
        if keys.iter().any(|key| self.get(key).is_some()) {
            return Ok(());
        }
        let names: Vec<String> = keys.iter().map(|key| format!("\"{key}\"")).collect();
        let names = names.join(", ");
        Err(self.node.error(format!("none of {names}"), "one of them at least"))
    }

    /// The one member of a set of alternatives that is there, if any; two are an error.
    pub fn one_of(&self, keys: &[&'static str]) -> Result<Option<(&'static str, &Node<'a>)>> {
        let mut found = None;
        for &key in keys {
            match (found, self.get(key)) {
                (None, Some(node)) => found = Some((key, node)),
                (Some((first, _)), Some(node)) => {
                    let both = format!("both \"{first}\" and \"{key}\"");
                    return Err(node.error(both, "one of them"));
                }
                (_, None) => {}
            }
        }
        Ok(found)
    }

    pub fn number(&self, key: &str) -> Result<Option<f64>> {
        self.get(key).map(Node::number).transpose()
    }

    pub fn quantity(&self, key: &str, quantity: Quantity) -> Result<Option<f64>> {
        self.get(key).map(|node| node.quantity(quantity)).transpose()
    }

    pub fn string(&self, key: &str) -> Result<Option<String>> {
        self.get(key).map(Node::string).transpose()
    }
}

/// An object as its keys and raw values, duplicates kept for us to find.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_names_file_line_column_and_field() {
        let text = "\u{feff}{\r\n  \"é\": 1,\r\n  \"a\": { \"b\": [1, \"2 lbf\"] }\r\n}";
        let document = Document::new("bat.json".into(), text);
        let root = document.root().unwrap().object(&["é", "a"]).unwrap();
        let list = root.get("a").unwrap().object(&["b"]).unwrap().get("b").unwrap().clone();
        let said = list.quantities(Quantity::Mass, 1.0).unwrap_err().to_string();
        assert!(said.starts_with("bat.json:3:19: a.b[1]: found unit \"lbf\""), "{said}");
    }

    #[test]
    fn a_complaint_finds_its_value_or_what_is_around_it() {
        let text = "{\n \"a\": [{}, { \"x\": \"5 in\" }]\n}";
        let document = Document::new("bat.json".into(), text);
        let root = document.root().unwrap();
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
    fn broken_json_is_placed_where_it_breaks() {
        let document = Document::new("bat.json".into(), "{\n \"a\": 1,,\n}");
        let said = document.root().err().unwrap().to_string();
        assert!(said.starts_with("bat.json:2:9: "), "{said}");
    }

    #[test]
    fn duplicate_and_unknown_keys_are_told() {
        let document = Document::new("f".into(), "{\"density\": 1, \"density\": 2}");
        let said = document.root().unwrap().object(&["density"]).err().unwrap().to_string();
        assert!(said.contains("a second time"), "{said}");
        let document = Document::new("f".into(), "{\"density\": 1}");
        let said = document.root().unwrap().object(&["densities"]).err().unwrap().to_string();
        assert!(said.contains("did you mean that"), "{said}");
    }
}
