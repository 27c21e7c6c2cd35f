//! The form of what a bat file says is on a bat and what holds it, for its schema.

use std::borrow::Cow;
use std::marker::PhantomData;

use schemars::transform::Transform;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde_json::{Map, Value, json};

use crate::base::units::Quantity;
use crate::bat::fixtures::Held;
use crate::bat::part::{Field, HEAVIEST, Instead, MOST, Part, Range, SOFTEST};
use crate::files::schema::amount::{Amount, Measures};
use crate::files::schema::material::{Comment, Material};

/// A stretch of another material, of another core, or of both.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(deny_unknown_fields)]
#[schemars(extend("anyOf" = [{ "required": ["material"] }, { "required": ["core"] }]))]
pub struct Region {
    /// A remark for people, which programs pass over.
    pub comment: Option<Comment>,
    /// Where the region begins.
    #[schemars(transform = Measures(Quantity::Length), extend("minimum" = 0))]
    pub from: Amount,
    /// Where the region ends.
    #[schemars(transform = Measures(Quantity::Length), extend("exclusiveMinimum" = 0))]
    pub to: Amount,
    /// What the wall is made of; the bat's own material without it.
    #[schemars(extend("allOf" = [whole()]))]
    pub material: Option<Material>,
    /// What fills the bore, as cork does.
    #[schemars(extend("allOf" = [whole()]))]
    pub core: Option<Material>,
}

/// A name, or both numbers: nothing that was measured stands in for those of a region's material.
fn whole() -> Value {
    json!({ "anyOf": [{ "type": "string" }, { "required": ["density", "youngs_modulus"] }] })
}

/// A place that is held.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(deny_unknown_fields)]
pub struct Support {
    /// A remark for people, which programs pass over.
    pub comment: Option<Comment>,
    /// Where the support is.
    #[schemars(transform = Measures(Quantity::Length), extend("minimum" = 0))]
    pub x: Amount,
    /// pinned: the bat does not move there but may turn; clamped: neither.
    #[schemars(rename = "type")]
    pub kind: Held,
}

/// A part that is a list of numbers, as a bat file may write it.
#[derive(Debug, Clone, PartialEq)]
pub struct InFile<P>(PhantomData<P>);

impl<P: Part + JsonSchema> JsonSchema for InFile<P> {
    fn schema_name() -> Cow<'static, str> {
        P::schema_name()
    }

    fn schema_id() -> Cow<'static, str> {
        format!("file {}", P::schema_id()).into()
    }

    /// That of the part, each number an amount within its bounds.
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let mut schema = P::json_schema(generator);
        let comment = generator.subschema_for::<Comment>().to_value();
        let mut properties = Map::from_iter([("comment".to_owned(), comment)]);
        let (mut needed, mut beside) = (vec![], Map::new());
        for field in P::FIELDS {
            let said = schema.pointer(&format!("/properties/{}/description", field.key));
            let said = said.and_then(Value::as_str).unwrap_or_default();
            let member = number(field, said, generator);
            properties.insert(field.key.to_owned(), member.to_value());
            if field.is_place() || field.needed.is_some() {
                needed.push(field.key);
            }
            if let Some((other, _)) = field.with {
                beside.insert(field.key.to_owned(), json!([other]));
            }
        }
        let required = |keys: &[&str]| -> Value {
            keys.iter().map(|key| json!({ "required": [key] })).collect()
        };
        if let Some(Instead { key, of, quantity, said, .. }) = P::INSTEAD {
            let mut member = amount(said, None, quantity, generator);
            member.insert("exclusiveMinimum".to_owned(), json!(0));
            properties.insert(key.to_owned(), member.to_value());
            schema.insert("oneOf".to_owned(), required(&[of, key]));
        }
        schema.insert("required".to_owned(), json!(needed));
        schema.insert("properties".to_owned(), properties.into());
        schema.insert("additionalProperties".to_owned(), json!(false));
        if !P::SOME.is_empty() {
            schema.insert("anyOf".to_owned(), required(P::SOME));
        }
        if !beside.is_empty() {
            schema.insert("dependentRequired".to_owned(), beside.into());
        }
        schema
    }
}

/// The schema of a number of which the part says so much.
fn number<P>(field: &Field<P>, said: &str, generator: &mut SchemaGenerator) -> Schema {
    // The unit stands in the sentence that follows.
    let said = said.rsplit_once(" (").map_or(said, |(said, _)| said).trim_end_matches('.');
    let said = match field.range {
        Range::Spring if !field.positive => {
            format!("{said}: 0, or {SOFTEST:e} {} and more.", field.quantity.unit())
        }
        _ => format!("{said}."),
    };
    let mut member = amount(&said, field.example, field.quantity, generator);
    let least = match (field.range, field.positive) {
        (Range::Distance, _) => return member,
        (Range::Spring, true) => ("minimum", json!(SOFTEST)),
        (Range::OnBat, _) if field.key == "to" => ("exclusiveMinimum", json!(0)),
        (Range::Inside, _) | (_, true) => ("exclusiveMinimum", json!(0)),
        _ => ("minimum", json!(0)),
    };
    let most = match field.range {
        Range::Mass => Some(("maximum", json!(HEAVIEST))),
        Range::Spring | Range::Dashpot => Some(("exclusiveMaximum", json!(MOST))),
        _ => None,
    };
    for (key, bound) in [Some(least), most].into_iter().flatten() {
        member.insert(key.to_owned(), bound);
    }
    member
}

fn amount(
    said: &str,
    example: Option<&str>,
    quantity: Quantity,
    generator: &mut SchemaGenerator,
) -> Schema {
    let mut member = generator.subschema_for::<Amount>();
    member.insert("description".to_owned(), json!(said));
    if let Some(example) = example {
        member.insert("examples".to_owned(), json!([example]));
    }
    Measures(quantity).transform(&mut member);
    member
}
