//! How is an object of a file written? Its members, and the value made of them.
//!
//! The macro `written` has one list for each: the reader, its errors and the schema follow from the list.

use std::path::{Path, PathBuf};

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde_json::{Map, Value, json};

use crate::engine::{Document as Text, Folder, Mistakes, Node, Object, Outside, Result};
use crate::files::form::{Form, later, text};
use sweetspot::files::schema::document;
use sweetspot::files::schema::document::Document;
use sweetspot::files::schema::part::Comment;

/// An object in a file: reading it and its schema follow from one list of its members.
pub trait Written: JsonSchema {
    /// The resulting value.
    type Made;
    /// Its keys, in the order in which messages name them.
    const KEYS: &'static [&'static str];
    /// Its description.
    const SAID: &'static str;
    /// For a file, the name of its format, and its common name.
    const FILE: Option<(&'static str, &'static str)> = None;

    /// Further keywords of its schema.
    fn more() -> Value {
        json!({})
    }

    /// Adds every member to a schema.
    fn tell(schema: &mut Told);

    /// Makes the value from the members, and records all mistakes.
    ///
    /// # Errors
    ///
    /// The reason why no value can be made.
    fn made(of: &mut Members) -> Result<Self::Made>;
}

/// Lists the members of an object, each with its description, its key and its form. The code after it makes the result
/// from the values, which are named like their keys.
macro_rules! written {
    (
        $(#[doc = $said:literal])+
        $name:ident $(($format:literal, $called:literal))? $(with $more:tt)? {
            $($(#[doc = $about:literal])+ $key:ident = $form:expr $(, needed $expected:expr)?;)+
        }
        |$of:pat_param| -> $made:ty $body:block
    ) => {
        $(#[doc = $said])+
        #[derive(Debug, Clone, Copy)]
        pub struct $name;

        impl $crate::files::written::Written for $name {
            type Made = $made;
            const KEYS: &'static [&'static str] = &[$(stringify!($key)),+];
            const SAID: &'static str = concat!($($said),+);
            $(const FILE: Option<(&'static str, &'static str)> = Some(($format, $called));)?

            $(fn more() -> ::serde_json::Value {
                ::serde_json::json!($more)
            })?

            fn tell(schema: &mut $crate::files::written::Told) {
                $(schema.member(stringify!($key), concat!($($about),+), &$form, &[$($expected)?]);)+
            }

            fn made(
                of: &mut $crate::files::written::Members,
            ) -> ::sweetspot::base::error::Result<$made> {
                $(let $key = $crate::files::written::value!(of, $key, $form $(, $expected)?);)+
                $(let _ = &$key;)+
                let $of = of;
                $body
            }
        }

        $(impl ::sweetspot::files::schema::document::Document for $name {
            const NAME: &'static str = $format;
            const CONTRACT: ::schemars::generate::Contract =
                ::schemars::generate::Contract::Deserialize;
        })?

        impl ::schemars::JsonSchema for $name {
            fn schema_name() -> ::std::borrow::Cow<'static, str> {
                stringify!($name).into()
            }

            fn json_schema(generator: &mut ::schemars::SchemaGenerator) -> ::schemars::Schema {
                $crate::files::written::schema::<Self>(generator)
            }
        }
    };
}
pub(crate) use written;

/// The value of a member that may or must be there.
macro_rules! value {
    ($of:ident, $key:ident, $form:expr) => {
        $of.value(stringify!($key), &$form)
    };
    ($of:ident, $key:ident, $form:expr, $expected:expr) => {
        $of.needed(stringify!($key), &$form, $expected)
    };
}
pub(crate) use value;

/// The values of an object while they are read.
pub struct Members<'a, 'f> {
    /// Its members in the file.
    pub object: Object<'a>,
    /// The folder of the files that it names.
    pub folder: &'f Folder<'f>,
    /// The mistakes in its values.
    pub mistakes: Mistakes,
}

impl<'a> Members<'a, '_> {
    /// The value of that key, if there is one; mistakes are recorded.
    pub fn value<T: 'static>(&mut self, key: &str, form: &Form<T>) -> Option<T> {
        self.mistakes.some(form.read(self.object.get(key)?))
    }

    /// The value of that key, which `expected` describes; if it is missing or wrong, a stand-in, and the mistake is
    /// recorded.
    pub fn needed<T: Default + 'static>(&mut self, key: &str, form: &Form<T>, expected: &str) -> T {
        let node = self.object.require(key, expected);
        self.mistakes.note(node.and_then(|node| form.read(node)))
    }

    /// The node of that key's value, if there is one.
    pub fn at(&self, key: &str) -> Option<&Node<'a>> {
        self.object.get(key)
    }

    /// The node of the object.
    pub fn node(&self) -> &Node<'a> {
        &self.object.node
    }

    /// Stops if there is a mistake already.
    ///
    /// # Errors
    ///
    /// All mistakes so far.
    pub fn sound(&mut self) -> Result<()> {
        std::mem::take(&mut self.mistakes).end(())
    }
}

/// The members of an object for a schema.
pub struct Told<'g> {
    generator: &'g mut SchemaGenerator,
    properties: Map<String, Value>,
    required: Vec<String>,
}

impl Told<'_> {
    /// Adds a member with its description, and with the expected text if it is required.
    pub fn member<T: 'static>(&mut self, key: &str, said: &str, form: &Form<T>, expected: &[&str]) {
        let schema = form.schema(said, self.generator);
        self.properties.insert(key.to_owned(), schema.to_value());
        self.required.extend(expected.first().map(|_| key.to_owned()));
    }
}

/// The schema of an object; for a file, with the members that every file has.
pub fn schema<W: Written>(generator: &mut SchemaGenerator) -> Schema {
    let mut told = Told { generator, properties: Map::new(), required: vec![] };
    let mut title = None;
    if let Some((name, called)) = W::FILE {
        let format = document::format(name);
        title = Some(format!("{called} of sweetspot, {format}"));
        told.member("$schema", "Where this schema is, for editors.", &text(), &[]);
        let said = format!("Name of the format and its version: {format}.");
        told.member("format", &said, &text().saying("const", &*format), &[&format]);
    }
    let comment = "A remark for people, which programs pass over.";
    told.member("comment", comment, &later::<Comment>(), &[]);
    W::tell(&mut told);
    let mut schema = json_schema!({
        "description": W::SAID,
        "type": "object",
        "additionalProperties": false,
        "properties": told.properties,
        "required": told.required,
    });
    let title = title.map(|title| ("title".to_owned(), title.into()));
    let more = W::more().as_object_mut().map(std::mem::take).unwrap_or_default();
    more.into_iter().chain(title).for_each(|(keyword, value)| {
        schema.insert(keyword, value);
    });
    schema
}

/// An object in a file.
pub fn object<W: Written<Made: 'static> + 'static>() -> Form<W::Made> {
    Form::of::<W>(|node| {
        let mut mistakes = Mistakes::default();
        let object = node.object(W::KEYS, &mut mistakes)?;
        made::<W>(object, mistakes, &Folder::closed(Path::new("")))
    })
}

fn made<W: Written>(object: Object, mistakes: Mistakes, folder: &Folder) -> Result<W::Made> {
    let mut members = Members { object, folder, mistakes };
    let made = W::made(&mut members);
    members.mistakes.and(made)
}

/// A file: every object that has a format.
pub trait WrittenFile: Written + Document + Sized {
    /// Reads a file.
    ///
    /// # Errors
    ///
    /// [`sweetspot::Error::Read`], or [`sweetspot::Error::Input`] with line and column, or several of them.
    fn from_file(path: impl AsRef<Path>) -> Result<Self::Made> {
        let path = path.as_ref();
        let folder = path.parent().unwrap_or(Path::new(""));
        Self::from_document(&Text::read(path)?, &Folder::closed(folder))
    }

    /// Reads a file that a person has named, and the files outside of its folder that it names.
    ///
    /// # Errors
    ///
    /// As [`Self::from_file`].
    fn named_by_a_person(path: &Path) -> Result<(Self::Made, Vec<PathBuf>)> {
        let outside = Outside::default();
        let made = Self::from_document(&Text::read(path)?, &Folder::of(path, &outside))?;
        Ok((made, outside.paths()))
    }

    /// Reads it from text; `file` is its name in messages, and files that it names are looked up in `folder`.
    ///
    /// ```
    /// use sweetspot_study::files::readings_file::ReadingsForm;
    /// use sweetspot_study::files::written::WrittenFile;
    ///
    /// # fn main() -> sweetspot::Result<()> {
    /// let text = r#"{ "format": "sweetspot-readings/1", "mass": "31.2 oz ± 1 g",
    ///     "lines": [ { "hz": 174.5, "within": 0.3, "mode": 1 } ] }"#;
    /// let readings = ReadingsForm::from_text("mine.json", text, "".as_ref())?;
    /// assert_eq!(readings.lines[0].mode, Some(1));
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    ///
    /// As [`Self::from_file`].
    fn from_text(file: &str, text: &str, folder: &Path) -> Result<Self::Made> {
        Self::from_document(&Text::new(file.to_owned(), text), &Folder::closed(folder))
    }

    /// Reads it from a document; files that it names are looked up in `folder`.
    ///
    /// # Errors
    ///
    /// As [`Self::from_file`].
    fn from_document(document: &Text, folder: &Folder) -> Result<Self::Made> {
        let format = document::format(Self::NAME);
        let root = Node::root(document)?.members()?;
        root.check_format(&format)?;
        let mut mistakes = Mistakes::default();
        let known = [&["format", "$schema"], Self::KEYS].concat();
        let root = root.only(&known, &mut mistakes);
        let expected = format!("\"format\": \"{format}\"");
        mistakes.note(root.require("format", &expected).map(|_| ()));
        mistakes.note(root.string("$schema"));
        made::<Self>(root, mistakes, folder)
    }
}

impl<W: Written + Document> WrittenFile for W {}
