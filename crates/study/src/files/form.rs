//! How is a value of a file written? Its reader and its schema.
//!
//! A [`Form`] is both, so that the two cannot disagree.

use std::ops::{Bound, RangeBounds};

use schemars::transform::Transform;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde_json::{Map, Value, json};

use crate::engine::{Amount, Complaint, Error, Node, Quantity, Result, mistakes};
use sweetspot::files::schema::amount::Measures;

/// Reads a value of a file, with its place in every mistake.
type Reader<T> = Box<dyn Fn(&Node) -> Result<T>>;

/// How a value is written.
pub struct Form<T> {
    read: Reader<T>,
    schema: Box<dyn Fn(&mut SchemaGenerator) -> Schema>,
    /// Keywords of the schema besides.
    more: Map<String, Value>,
    measures: Option<Quantity>,
}

impl<T: 'static> Form<T> {
    /// A value with that reader and the schema of `S`.
    pub fn of<S: JsonSchema>(read: impl Fn(&Node) -> Result<T> + 'static) -> Self {
        Self::looking(|generator| generator.subschema_for::<S>(), read)
    }

    /// A value with that reader and that schema.
    pub fn looking(
        schema: impl Fn(&mut SchemaGenerator) -> Schema + 'static,
        read: impl Fn(&Node) -> Result<T> + 'static,
    ) -> Self {
        let (read, schema) = (Box::new(read), Box::new(schema));
        Self { read, schema, more: Map::new(), measures: None }
    }

    /// Adds the quantity of the value.
    pub fn measuring(self, quantity: Quantity) -> Self {
        Self { measures: Some(quantity), ..self }
    }

    /// Adds an example.
    pub fn like(mut self, example: impl Into<Value>) -> Self {
        if let Value::Array(all) = self.more.entry("examples").or_insert(json!([])) {
            all.push(example.into());
        }
        self
    }

    /// Adds a keyword to the schema.
    pub fn saying(mut self, keyword: &str, value: impl Into<Value>) -> Self {
        self.more.insert(keyword.to_owned(), value.into());
        self
    }

    /// Converts the value after reading.
    pub fn map<U: 'static>(self, made: impl Fn(T) -> U + 'static) -> Form<U> {
        let Self { read, schema, more, measures } = self;
        Form { read: Box::new(move |node| read(node).map(&made)), schema, more, measures }
    }

    /// Reads the value.
    ///
    /// # Errors
    ///
    /// The mistakes in it.
    pub fn read(&self, node: &Node) -> Result<T> {
        (self.read)(node)
    }

    /// Its schema with that description, if any.
    pub(super) fn schema(&self, said: &str, generator: &mut SchemaGenerator) -> Schema {
        let mut schema = (self.schema)(generator);
        self.more.iter().for_each(|(keyword, value)| {
            schema.insert(keyword.clone(), value.clone());
        });
        if !said.is_empty() {
            schema.insert("description".to_owned(), json!(said));
        }
        self.measures.into_iter().for_each(|quantity| Measures(quantity).transform(&mut schema));
        schema
    }
}

impl Form<f64> {
    /// Allows only numbers in that range, which `expected` describes.
    pub fn within(self, range: impl RangeBounds<f64> + 'static, expected: &'static str) -> Self {
        let ends = [
            ("minimum", "exclusiveMinimum", range.start_bound().cloned()),
            ("maximum", "exclusiveMaximum", range.end_bound().cloned()),
        ];
        let Self { read, schema, mut more, measures } = self;
        more.extend(ends.into_iter().filter_map(|(at, beyond, end)| match end {
            Bound::Included(end) => Some((at.to_owned(), json!(end))),
            Bound::Excluded(end) => Some((beyond.to_owned(), json!(end))),
            Bound::Unbounded => None,
        }));
        let read = move |node: &Node| {
            let value = read(node)?;
            sound(node, range.contains(&value), expected).map(|()| value)
        };
        Self { read: Box::new(read), schema, more, measures }
    }
}

/// A text.
pub fn text() -> Form<String> {
    Form::of::<String>(|node| node.string())
}

/// True or false.
pub fn truth() -> Form<bool> {
    Form::of::<bool>(|node| {
        node.value().as_bool().ok_or_else(|| node.error(node.shown(), "true or false"))
    })
}

/// A pure number.
pub fn number() -> Form<f64> {
    Form::of::<f64>(|node| node.number())
}

/// A whole number.
pub fn whole() -> Form<u64> {
    Form::of::<u64>(|node| node.whole())
}

/// A number in SI, or a text with a unit.
pub fn amount(quantity: Quantity) -> Form<f64> {
    Form::of::<Amount>(move |node| node.quantity(quantity)).measuring(quantity)
}

/// A list.
pub fn list<T: 'static>(item: Form<T>) -> Form<Vec<T>> {
    few(usize::MAX, item)
}

/// A list of at most that number of values.
pub fn few<T: 'static>(most: usize, item: Form<T>) -> Form<Vec<T>> {
    let Form { read, schema, more, measures } = item;
    let look = Form { read: Box::new(|_| Ok(())), schema, more, measures };
    Form::looking(
        move |generator| json_schema!({ "type": "array", "items": look.schema("", generator) }),
        move |node| match node.items()? {
            items if items.len() > most => {
                Err(node.error(format!("{} items", items.len()), format!("{most} at most")))
            }
            items => mistakes::all(items.iter().map(&read)),
        },
    )
}

/// A value with the schema of `S`, read when others are known.
pub fn later<S: JsonSchema>() -> Form<()> {
    Form::of::<S>(|_| Ok(()))
}

/// An error about a value unless it is valid.
///
/// # Errors
///
/// The expected text.
pub fn sound(node: &Node, is_sound: bool, expected: &str) -> Result<()> {
    if is_sound { Ok(()) } else { Err(node.error(node.shown(), expected)) }
}

/// An error in something that a value names, reported at the value.
pub fn at(node: &Node, error: Error) -> Error {
    error.placed(|complaint| node.complain(Complaint { field: String::new(), ..complaint }))
}
