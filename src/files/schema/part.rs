//! The form of a material and of a fixture in a bat file, for its schema.

use std::borrow::Cow;
use std::marker::PhantomData;

use schemars::transform::Transform;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde_json::{Map, Value, json};

use crate::base::Quantity;
use crate::bat::material::BuiltIn;
use crate::bat::part::{Bound, Field, HEAVIEST, Instead, MOST, MemberKind, Part, Range, SOFTEST};
use crate::bat::{BUILT_IN, Change, Edit, Held, Layer, edit, material as bat};
use crate::files::schema::amount::{Amount, Measures};

/// A remark for people: a text or a list of texts, which programs ignore.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(untagged)]
pub enum Comment {
    /// One text.
    Text(String),
    /// A text for each line.
    Lines(Vec<String>),
}

/// A material: the name of a built-in one, or its numbers; for wood these are along the grain.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(untagged, rename = "NamedMaterial")]
pub enum Material {
    /// The name of a built-in material.
    Named(#[schemars(schema_with = "names")] String),
    /// The numbers of a material of your own, or those that differ from a built-in one.
    Numbers(Numbers),
}

/// The numbers of a material. Density and Young's modulus may be left out if the material also has a name, or if a
/// weighed mass or a tapped frequency replaces them.
#[derive(Debug, Clone, PartialEq)]
pub struct Numbers;

impl JsonSchema for Numbers {
    fn schema_name() -> Cow<'static, str> {
        "MaterialNumbers".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let mut schema = InFile::<bat::Material>::json_schema(generator);
        let mut name = names(generator);
        name.insert("description".to_owned(), json!("The built-in material that it differs from."));
        if let Some(Value::Object(properties)) = schema.get_mut("properties") {
            properties.insert("name".to_owned(), name.to_value());
        }
        let modulus = json!({ "dependentRequired": { "shear_modulus": ["youngs_modulus"] } });
        schema.insert("anyOf".to_owned(), json!([{ "required": ["name"] }, modulus]));
        schema
    }
}

/// The built-in materials, each with the source of its numbers.
fn names(_: &mut SchemaGenerator) -> Schema {
    let name = |known: &BuiltIn| json!({ "const": known.name, "description": known.source });
    json_schema!({
        "type": "string",
        "oneOf": BUILT_IN.iter().map(name).collect::<Vec<Value>>(),
    })
}

/// A name, or these numbers.
pub fn with(numbers: &[&str]) -> Value {
    json!({ "anyOf": [
        { "type": "string" },
        { "required": ["name"] },
        { "required": numbers },
    ] })
}

/// A material whose numbers may not be replaced by measured values.
pub fn whole() -> Value {
    with(&["density", "youngs_modulus"])
}

/// A part in the notation of a bat file.
#[derive(Debug, Clone, PartialEq)]
pub struct InFile<P>(PhantomData<P>);

impl<P: Part + JsonSchema> JsonSchema for InFile<P> {
    fn schema_name() -> Cow<'static, str> {
        P::schema_name()
    }

    fn schema_id() -> Cow<'static, str> {
        format!("file {}", P::schema_id()).into()
    }

    /// The schema of the part, with each number as an amount within its bounds.
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        // The descriptions come from the part's own schema, the kinds from its list of members.
        let mut schema = P::json_schema(&mut SchemaGenerator::default());
        let comment = generator.subschema_for::<Comment>().to_value();
        let mut properties = Map::from_iter([("comment".to_owned(), comment)]);
        let (mut needed, mut beside) = (vec![], Map::new());
        for field in P::FIELDS {
            let said = schema.pointer(&format!("/properties/{}/description", field.key));
            let said = said.and_then(Value::as_str).unwrap_or_default();
            let member = member(field, said, generator);
            properties.insert(field.key.to_owned(), member.to_value());
            if field.needed.is_some() {
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

/// An edit in the notation of a bat file.
#[derive(Debug, Clone, PartialEq)]
pub struct EditInFile;

impl JsonSchema for EditInFile {
    fn schema_name() -> Cow<'static, str> {
        "Edit".into()
    }

    fn schema_id() -> Cow<'static, str> {
        "file edit".into()
    }

    /// A name and one of the changes.
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let said = |key: &str, of: &[Schema]| {
            let found = of.iter().find_map(|change| {
                let member = change.pointer(&format!("/properties/{key}"))?;
                Some(member.get("description").or(change.get("description"))?.as_str()?.to_owned())
            });
            found.unwrap_or_default()
        };
        let own = Edit::json_schema(&mut SchemaGenerator::default());
        let changes: Vec<Schema> = Change::json_schema(&mut SchemaGenerator::default())
            .get("oneOf")
            .and_then(Value::as_array)
            .into_iter()
            .flatten()
            .filter_map(|change| change.clone().try_into().ok())
            .collect();
        let weight = said("knob", &changes);
        let weight = weight.replace(" (kg)", "");
        let mut weight = amount(&weight, Some("2 oz"), Quantity::Mass, generator);
        weight.insert("exclusiveMinimum".to_owned(), json!(0));
        let mut wood = described(generator.subschema_for::<Material>(), &said("wood", &changes));
        wood.insert("allOf".to_owned(), json!([whole()]));
        let parts = [
            ("cut", generator.subschema_for::<InFile<edit::Cut>>()),
            ("knob", weight),
            ("cup", generator.subschema_for::<InFile<edit::Cup>>()),
            ("bore", generator.subschema_for::<InFile<edit::Bore>>()),
            ("cork", generator.subschema_for::<InFile<edit::Cork>>()),
            ("sleeve", generator.subschema_for::<InFile<edit::Sleeve>>()),
            ("shorten", generator.subschema_for::<InFile<edit::Shorten>>()),
            ("scale_diameter", generator.subschema_for::<InFile<edit::ScaleDiameter>>()),
            ("wood", wood),
        ];
        let comment = generator.subschema_for::<Comment>().to_value();
        let mut properties = Map::from_iter([("comment".to_owned(), comment)]);
        let name = json!({ "type": "string", "description": said("name", &[own]) });
        properties.insert("name".to_owned(), name);
        for (key, part) in parts {
            let part = described(part, &said(key, &changes));
            properties.insert(key.to_owned(), part.to_value());
        }
        let one: Value = Change::VERBS.iter().map(|key| json!({ "required": [key] })).collect();
        json_schema!({
            "description": "One change of the bat, with a name if it has one.",
            "type": "object",
            "properties": properties,
            "additionalProperties": false,
            "oneOf": one,
        })
    }
}

/// The schema of a member, with the description from the part.
fn member<P>(field: &Field<P>, said: &str, generator: &mut SchemaGenerator) -> Schema {
    match field.kind {
        MemberKind::Number(quantity, range) => number(field, (quantity, range), said, generator),
        MemberKind::Held => described(generator.subschema_for::<Held>(), said),
        MemberKind::Material => {
            let mut member = described(generator.subschema_for::<Material>(), said);
            member.insert("allOf".to_owned(), json!([whole()]));
            member
        }
        MemberKind::ShearModuli => {
            described(generator.subschema_for::<InFile<bat::ShearModuli>>(), said)
        }
        MemberKind::Layers => {
            let layer = generator.subschema_for::<InFile<Layer>>();
            json_schema!({
                "description": said,
                "type": "array",
                "minItems": 1,
                "items": layer,
            })
        }
        MemberKind::PoissonRatios => {
            described(generator.subschema_for::<InFile<bat::PoissonRatios>>(), said)
        }
    }
}

fn described(mut member: Schema, said: &str) -> Schema {
    member.insert("description".to_owned(), json!(said));
    member
}

fn number<P>(
    field: &Field<P>,
    (quantity, range): (Option<Quantity>, Range),
    said: &str,
    generator: &mut SchemaGenerator,
) -> Schema {
    // The unit is in the sentence that follows.
    let said = said.rsplit_once(" (").map_or(said, |(said, _)| said).trim_end_matches('.');
    let said = match (range, quantity) {
        (Range::Spring, Some(quantity)) => {
            format!("{said}: 0, or {SOFTEST:e} {} and more.", quantity.unit())
        }
        _ => format!("{said}."),
    };
    let mut member = match quantity {
        Some(quantity) => amount(&said, field.example, quantity, generator),
        None => ratio(&said, field.example, generator),
    };
    for (key, bound) in bounds(range, field.key == "to").into_iter().flatten() {
        member.insert(key.to_owned(), json!(bound));
    }
    member
}

/// The smallest and the largest number of a range, with their names in a schema; the end of a stretch is above 0.
fn bounds(range: Range, end: bool) -> [Option<(&'static str, f64)>; 2] {
    let zero = Some(("minimum", 0.0));
    let some = Some(("exclusiveMinimum", 0.0));
    let most = Some(("exclusiveMaximum", MOST));
    match range {
        Range::Distance => [None, None],
        Range::OnBat if !end => [zero, None],
        Range::OnBat | Range::Inside => [some, None],
        Range::Mass => [zero, Some(("maximum", HEAVIEST))],
        Range::SomeMass => [some, Some(("maximum", HEAVIEST))],
        Range::SomeSpring => [Some(("minimum", SOFTEST)), most],
        Range::Spring | Range::NotNegative => [zero, most],
        Range::Positive => [some, most],
        Range::Between(low, high, _) => [
            Some(match low {
                Bound::At(end) => ("minimum", end),
                Bound::Beyond(end) => ("exclusiveMinimum", end),
            }),
            Some(match high {
                Bound::At(end) => ("maximum", end),
                Bound::Beyond(end) => ("exclusiveMaximum", end),
            }),
        ],
    }
}

/// A pure number.
fn ratio(said: &str, example: Option<&str>, generator: &mut SchemaGenerator) -> Schema {
    let mut member = described(generator.subschema_for::<f64>(), said);
    if let Some(example) = example.and_then(|example| example.parse::<f64>().ok()) {
        member.insert("examples".to_owned(), json!([example]));
    }
    member
}

fn amount(
    said: &str,
    example: Option<&str>,
    quantity: Quantity,
    generator: &mut SchemaGenerator,
) -> Schema {
    let mut member = described(generator.subschema_for::<Amount>(), said);
    if let Some(example) = example {
        member.insert("examples".to_owned(), json!([example]));
    }
    Measures(quantity).transform(&mut member);
    member
}
