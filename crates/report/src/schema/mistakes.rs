//! The document of mistakes, `sweetspot-error/1`. This type is written, and the schema derives from it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use sweetspot::files::schema::document::{Document, Format, Generator};

/// Why there is no answer: every mistake found, with its place and what to do. With `--json` it is the last line on
/// standard error, after the same text for people. The exit code is 2, or 3 where an accuracy was not reached. Later
/// versions with the same number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(title = "What is wrong, by sweetspot, sweetspot-error/1")]
pub struct ErrorFile {
    /// Name of the format and its version: sweetspot-error/1.
    pub format: Format<ErrorFile>,
    /// The program that wrote the document.
    pub generator: Generator,
    /// The mistakes in the order of the file, one at least.
    pub mistakes: Vec<Mistake>,
    /// Number of further mistakes that are not listed.
    pub more: usize,
}

impl Document for ErrorFile {
    const NAME: &'static str = "error";
}

/// One mistake. A value that does not exist is null: a mistake on the command line has no file and no line.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Mistake {
    /// The file, as given.
    pub file: Option<String>,
    /// The line in the file, counted from 1.
    pub line: Option<usize>,
    /// The column in that line, in characters, counted from 1.
    pub column: Option<usize>,
    /// The place of the wrong value: its path in the file such as profile.x\[3\], or its option.
    pub place: Option<String>,
    /// The value found there, or what is wrong where it is not a value.
    pub found: String,
    /// What was expected.
    pub expected: Option<String>,
    /// What to do about it.
    pub hint: Option<String>,
}
