//! The formats of the files. Each is a type from which its JSON Schema derives (draft 2020-12).
//!
//! The written documents, such as [`modes::ModesFile`] and [`hit::HitFile`], are these types themselves; those of one
//! verb are beside its report, and [`Written`] gives them their beginning. They may grow, so readers must ignore
//! unknown members. The files that are read, [`BatFile`](sweetspot::files::schema::bat::BatFile)
//! and [`BallFile`](sweetspot::files::schema::ball::BallFile), admit no unknown members, in the schema as in the
//! reader. A document whose name ends in a number other than `/1` fits none of these types.
//!
//! # Source
//!
//! JSON Schema, draft 2020-12: json-schema.org/draft/2020-12/schema; several schemas in one
//! document: its core, section 9.3.1 (bundling).

pub mod materials;
pub mod modes;
pub mod hit;
pub mod measured;
pub mod ring;
pub mod frf;
pub mod tap;
pub mod identify;

use std::borrow::Cow;

use schemars::generate::SchemaSettings;
use schemars::transform::{RecursiveTransform, Transform};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Serialize;
use serde_json::{Map, Value, json};

use sweetspot::base::marks;
use sweetspot::files::schema::document::{Document, Format, Generator, format};

/// Names the documents that a type is.
macro_rules! document {
    ($type:ty, $name:literal) => {
        impl sweetspot::files::schema::document::Document for $type {
            const NAME: &'static str = $name;
        }
    };
}
pub(crate) use document;

/// A warning of a document.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Said {
    /// Its name for programs.
    pub code: String,
    /// What it means and what to do.
    pub text: String,
}

impl Said {
    /// A warning of that name.
    pub fn new(code: &str, text: impl Into<String>) -> Self {
        Self { code: code.to_owned(), text: text.into() }
    }
}

/// The beginning of a document.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
struct Head<D: Document> {
    format: Format<D>,
    /// The program that wrote the file.
    generator: Generator,
}

/// A document: the name of its format, the program that wrote it, and its content.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(bound = "D: Document + Serialize")]
pub struct Written<D: Document> {
    #[serde(flatten)]
    head: Head<D>,
    /// Its content.
    #[serde(flatten)]
    pub body: D,
}

impl<D: Document> Written<D> {
    /// The document of this program.
    pub fn of(body: D) -> Self {
        Self { head: Head { format: Format::new(), generator: Generator::this() }, body }
    }
}

impl<D: Document> Document for Written<D> {
    const NAME: &'static str = D::NAME;
}

impl<D: Document> JsonSchema for Written<D> {
    fn schema_name() -> Cow<'static, str> {
        D::schema_name()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let mut head = Head::<D>::json_schema(generator).to_value();
        let about = format!("Name of the format and its version: {}.", format(D::NAME));
        head["properties"]["format"]["description"] = about.into();
        let mut whole = D::json_schema(generator).to_value();
        let members = whole["properties"].as_object_mut().map(std::mem::take);
        whole["properties"] = head["properties"].take();
        members.into_iter().flatten().for_each(|(name, of)| whole["properties"][name] = of);
        let needed = whole["required"].as_array_mut().map(std::mem::take).unwrap_or_default();
        whole["required"] =
            head["required"].as_array().into_iter().flatten().cloned().chain(needed).collect();
        whole.try_into().expect("the schema of a type with members is an object")
    }
}

/// The schema of a kind of document.
pub fn of<D: Document>() -> Value {
    let settings = SchemaSettings::draft2020_12().with(|settings| settings.contract = D::CONTRACT);
    finished(settings.into_generator().into_root_schema_for::<D>(), &id(D::NAME))
}

/// The identifier of the schema of the documents with that name, wherever it is kept.
pub fn id(name: &str) -> String {
    format!("urn:sweetspot:{name}:1")
}

/// The text of a document, in lines.
pub fn text<T: Serialize>(document: &T) -> String {
    marks::json(&format!("{:#}\n", value(document)))
}

/// A document as JSON.
pub fn value<T: Serialize>(document: &T) -> Value {
    serde_json::to_value(document).expect("these types have text keys and no maps of other keys")
}

/// The draft of JSON Schema that all schemas follow.
pub const DRAFT: &str = "https://json-schema.org/draft/2020-12/schema";

/// The schema with its identifier first, without line breaks in descriptions, and without null where an absent member
/// is left out instead.
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

/// A member that may be absent is never null. Only a required member uses null for a missing value.
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
    // Of two alternatives, one of them null, keep the other.
    let Some(Value::Array(alternatives)) = member.get_mut("anyOf") else { return };
    alternatives.retain(|alternative| *alternative != json!({ "type": "null" }));
    if let [Value::Object(one)] = &alternatives[..] {
        let one = one.clone();
        member.remove("anyOf");
        // The description of the member precedes that of its type.
        for (key, value) in one {
            member.entry(key).or_insert(value);
        }
    }
}

/// Comments are broken into lines for the source alone, and the width of a number in this program
/// does not belong in a schema.
fn plain(schema: &mut Schema) {
    if let Some(Value::String(text)) = schema.get_mut("description") {
        *text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    }
    if schema.get("format").is_some_and(Value::is_string) {
        schema.remove("format");
    }
}
