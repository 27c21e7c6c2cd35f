//! What the files look like: each a type whose JSON Schema follows from it (draft 2020-12).
//!
//! The documents that are written, [`modes::ModesFile`], [`hit::HitFile`] and
//! [`bbcor::BbcorFile`], are these types themselves. They may grow: who reads them passes over members he does not know. The file that
//! is read, [`bat::BatFile`], has no members but its own, as its reader. A document whose name ends
//! in another number than `/1` fits none of these types.
//!
//! # Source
//!
//! JSON Schema, draft 2020-12: json-schema.org/draft/2020-12/schema; several schemas in one
//! document: its core, section 9.3.1 (bundling).

pub mod amount;
pub mod resolved;
pub mod material;
pub mod fixtures;
pub mod bat;
pub mod modes;
pub mod hit;
pub mod bbcor;

use schemars::generate::SchemaSettings;
use schemars::transform::{RecursiveTransform, Transform};
use schemars::{JsonSchema, Schema};
use serde::Serialize;
use serde_json::{Map, Value, json};

/// A kind of file that has a schema.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum File {
    /// What is read: a bat.
    Bat,
    /// What `sweetspot modes --json` writes.
    Modes,
    /// What `sweetspot hit --json` writes.
    Hit,
    /// What `sweetspot bbcor --json` writes.
    Bbcor,
}

impl File {
    /// Every kind, in this order.
    pub const ALL: [Self; 4] = [Self::Bat, Self::Modes, Self::Hit, Self::Bbcor];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Bat => "bat",
            Self::Modes => "modes",
            Self::Hit => "hit",
            Self::Bbcor => "bbcor",
        }
    }

    /// The `format` by which such a file is known.
    pub fn format(self) -> String {
        format!("sweetspot-{}/1", self.name())
    }

    /// The name of its schema, wherever that is kept.
    pub fn id(self) -> String {
        format!("urn:sweetspot:{}:1", self.name())
    }

    /// Its schema.
    pub fn schema(self) -> Value {
        let settings = SchemaSettings::draft2020_12();
        let generated = match self {
            // What may be read.
            Self::Bat => {
                settings.for_deserialize().into_generator().into_root_schema_for::<bat::BatFile>()
            }
            // What is written.
            Self::Modes => written::<modes::ModesFile>(settings),
            Self::Hit => written::<hit::HitFile>(settings),
            Self::Bbcor => written::<bbcor::BbcorFile>(settings),
        };
        finished(generated, &self.id())
    }
}

fn written<T: JsonSchema>(settings: SchemaSettings) -> Schema {
    settings.for_serialize().into_generator().into_root_schema_for::<T>()
}

/// One schema of all of them, each by its `format`, with the schema of each inside.
pub fn all() -> Value {
    let formats: Vec<String> = File::ALL.iter().map(|file| file.format()).collect();
    let by_format = |file: File| {
        json!({
            "if": { "properties": { "format": { "const": file.format() } } },
            "then": { "$ref": file.id() },
        })
    };
    let definition = |file: File| (file.name().to_owned(), file.schema());
    json!({
        "$schema": DRAFT,
        "$id": "urn:sweetspot:1",
        "title": "A file of sweetspot",
        "description": "A bat, its modes, its hits or its BBCOR, told apart by the member \"format\".",
        "type": "object",
        "properties": { "format": { "enum": formats } },
        "required": ["format"],
        "allOf": File::ALL.map(by_format),
        "$defs": File::ALL.map(definition).into_iter().collect::<Map<_, _>>(),
    })
}

/// A document as JSON.
pub fn value<T: Serialize>(document: &T) -> Value {
    serde_json::to_value(document).expect("these types have text keys and no maps of other keys")
}

const DRAFT: &str = "https://json-schema.org/draft/2020-12/schema";

/// The schema with its name first, descriptions in whole lines, and no null where a member is left
/// out instead.
fn finished(mut schema: Schema, id: &str) -> Value {
    RecursiveTransform(absent_not_null).transform(&mut schema);
    RecursiveTransform(plain).transform(&mut schema);
    let mut named = json!({ "$schema": DRAFT, "$id": id });
    for key in ["title", "description"] {
        if let Some(text) = schema.remove(key) {
            named[key] = text;
        }
    }
    let others = schema.as_object_mut().map(std::mem::take).unwrap_or_default();
    others.into_iter().for_each(|(key, value)| named[key] = value);
    named
}

/// A member that may be absent is never null: only what must be there can say that it has no value.
fn absent_not_null(schema: &mut Schema) {
    let required = schema.get("required").cloned().unwrap_or(json!([]));
    let must = |key: &str| required.as_array().is_some_and(|all| all.contains(&json!(key)));
    let Some(Value::Object(properties)) = schema.get_mut("properties") else { return };
    for (_, property) in properties.iter_mut().filter(|(key, _)| !must(key)) {
        if let Some(member) = property.as_object_mut() {
            without_null(member);
        }
    }
}

fn without_null(member: &mut Map<String, Value>) {
    if let Some(Value::Array(values)) = member.get_mut("enum") {
        values.retain(|value| !value.is_null());
    }
    if let Some(Value::Array(types)) = member.get_mut("type") {
        types.retain(|name| name != "null");
        if let [one] = &types[..] {
            let one = one.clone();
            member.insert("type".to_owned(), one);
        }
    }
    // Of two alternatives, one of them null, the other one is the schema.
    let Some(Value::Array(alternatives)) = member.get_mut("anyOf") else { return };
    alternatives.retain(|alternative| *alternative != json!({ "type": "null" }));
    if let [Value::Object(one)] = &alternatives[..] {
        let one = one.clone();
        member.remove("anyOf");
        // What is said of the member itself stands before what is said of its type.
        for (key, value) in one {
            member.entry(key).or_insert(value);
        }
    }
}

/// Comments are broken into lines for the source alone, and how wide a number is in this program is
/// nobody's concern.
fn plain(schema: &mut Schema) {
    if let Some(Value::String(text)) = schema.get_mut("description") {
        *text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    }
    if schema.get("format").is_some_and(Value::is_string) {
        schema.remove("format");
    }
}
