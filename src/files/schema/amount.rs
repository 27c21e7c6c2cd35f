//! Numbers as a user writes them: in SI, or as a text with a unit.

use std::borrow::Cow;

use schemars::transform::Transform;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde_json::{Value, json};

use crate::base::Quantity;

/// A bare number, or a text such as `"33 in"`.
#[derive(Debug, Clone, PartialEq)]
pub enum Amount {
    /// In the SI unit of the quantity, or in the unit that the profile names.
    Number(f64),
    /// Such as `33 in`.
    WithUnit(String),
}

/// A number, then a possible unit. The reader checks whether the unit exists and measures the quantity.
const WITH_UNIT: &str = r#"^\s*[+−–-]?([0-9][0-9.,]*|\.[0-9]+|[¼½¾⅛⅜⅝⅞])([eE][+-]?[0-9]+|[ -]*[0-9]*[/⁄][0-9]+|\s*[¼½¾⅛⅜⅝⅞])?\s*[A-Za-zµ/*·"'″′”’“‘„]"#;

impl JsonSchema for Amount {
    fn schema_name() -> Cow<'static, str> {
        "Amount".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A number, or a text of a number and its unit. A unit is a product of \
                symbols with whole powers, such as kg/m^3, lb/in^3 or N m/rad; oz and lb are \
                masses, ozf and lbf forces.",
            "type": ["number", "string"],
            "pattern": WITH_UNIT,
        })
    }
}

/// Adds to a member's schema its quantity, the unit of its bare numbers, and an example.
#[derive(Debug, Clone, Copy)]
pub struct Measures(pub Quantity);

impl Transform for Measures {
    fn transform(&mut self, schema: &mut Schema) {
        describe(schema, &sentence(&self.0.expected()));
        if schema.get("examples").is_none() {
            schema.insert("examples".to_owned(), json!([self.0.example()]));
        }
    }
}

/// Adds to a list's schema that it is a column of the profile without values below 0.
pub fn column(schema: &mut Schema) {
    describe(schema, "Numbers in the profile's \"unit\", or texts such as \"33 in\".");
    schema.insert("minItems".to_owned(), json!(2));
    if let Some(Value::Object(items)) = schema.get_mut("items") {
        items.insert("minimum".to_owned(), json!(0));
    }
}

fn describe(schema: &mut Schema, more: &str) {
    let said = schema.get("description").and_then(Value::as_str).unwrap_or_default();
    let both = format!("{said} {more}").trim().to_owned();
    schema.insert("description".to_owned(), json!(both));
}

/// The words with a capital letter and a full stop.
fn sentence(words: &str) -> String {
    let mut letters = words.chars();
    let first = letters.next().map(|c| c.to_uppercase().to_string()).unwrap_or_default();
    format!("{first}{}.", letters.as_str())
}
