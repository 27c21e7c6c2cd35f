//! The common beginning of every document: the name of its format, and the program that wrote it.

use std::borrow::Cow;
use std::marker::PhantomData;

use schemars::generate::Contract;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Error, Unexpected};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::bat::{Bat, Edit};

/// A kind of document, identified by its member `format`.
pub trait Document: JsonSchema {
    /// Name of the kind, such as `modes`.
    const NAME: &'static str;
    /// Whether the type describes input or output.
    const CONTRACT: Contract = Contract::Serialize;
}

/// The member `format` of documents of that name, such as `sweetspot-modes/1`.
pub fn format(name: &str) -> String {
    format!("sweetspot-{name}/1")
}

/// The member `format` of a document; only the value for its type is valid.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Format<D>(PhantomData<D>);

impl<D> Format<D> {
    /// The only value.
    pub fn new() -> Self {
        Self(PhantomData)
    }
}

impl<D> Default for Format<D> {
    fn default() -> Self {
        Self::new()
    }
}

impl<D: Document> Serialize for Format<D> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&format(D::NAME))
    }
}

impl<'de, D: Document> Deserialize<'de> for Format<D> {
    fn deserialize<R: Deserializer<'de>>(deserializer: R) -> Result<Self, R::Error> {
        let (found, expected) = (String::deserialize(deserializer)?, format(D::NAME));
        match found == expected {
            true => Ok(Self::new()),
            false => Err(R::Error::invalid_value(Unexpected::Str(&found), &&*expected)),
        }
    }
}

impl<D: Document> JsonSchema for Format<D> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        format!("Format_{}", D::NAME).into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "string", "const": format(D::NAME) })
    }
}

/// The program that wrote this.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Generator {
    /// Its name.
    pub program: String,
    /// Version of the program, not of the format.
    pub version: String,
}

impl Generator {
    /// This program.
    pub fn this() -> Self {
        Self { program: "sweetspot".to_owned(), version: env!("CARGO_PKG_VERSION").to_owned() }
    }
}

/// The bat that a document is about.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct BatName {
    /// Name of the bat.
    pub name: String,
    /// Changes of the bat after it was weighed; left out if there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub edits: Vec<Edit>,
}

impl BatName {
    /// The name of that bat, and its edits.
    pub fn of(bat: &Bat) -> Self {
        Self { name: bat.name().to_owned(), edits: bat.edits().to_vec() }
    }
}
