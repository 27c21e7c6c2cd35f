//! The mistakes as a document for other programs.

use std::path::Path;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::schema::{Written, document};
use sweetspot::Error;
use sweetspot::base::error::{Complaint, FilePosition};

/// Why there is no answer: every mistake found, with its place and what to do. With `--json` it is the last line on
/// standard error, after the same text for people. The exit code is 2, or 3 where an accuracy was not reached. Later
/// versions with the same number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(title = "What is wrong, by sweetspot, sweetspot-error/1")]
pub struct ErrorFile {
    /// The mistakes in the order of the file, one at least.
    pub mistakes: Vec<Mistake>,
    /// Number of further mistakes that are not listed.
    pub more: usize,
}

document!(ErrorFile, "error");

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

/// The `sweetspot-error/1` document of an error.
pub fn document(error: &Error) -> Written<ErrorFile> {
    match error {
        Error::Several { shown, more } => file(shown.iter().map(mistake).collect(), *more),
        one => file(vec![mistake(one)], 0),
    }
}

/// That of one mistake on the command line.
pub fn of_option(complaint: &Complaint) -> Written<ErrorFile> {
    file(vec![complained(complaint)], 0)
}

fn file(mistakes: Vec<Mistake>, more: usize) -> Written<ErrorFile> {
    Written::of(ErrorFile { mistakes, more })
}

fn mistake(error: &Error) -> Mistake {
    let of_file = |path: &Path| Some(path.display().to_string());
    match error {
        Error::Input { place, complaint } => {
            let FilePosition { file, line, column, .. } = &**place;
            let (file, line, column) = (Some(file.clone()), Some(*line), Some(*column));
            Mistake { file, line, column, ..complained(complaint) }
        }
        Error::Value(complaint) => complained(complaint),
        Error::Read { path, .. } | Error::Write { path, .. } => {
            Mistake { file: of_file(path), ..said(error.to_string()) }
        }
        Error::NotYet { what, advice } => {
            Mistake { hint: some(advice), ..said(format!("{what}, which is not supported yet")) }
        }
        Error::NotBuilt { what, advice } => {
            Mistake { hint: some(advice), ..said(format!("{what}, which is not in this build")) }
        }
        other => said(other.to_string()),
    }
}

fn complained(complaint: &Complaint) -> Mistake {
    let Complaint { field, found, expected, hint } = complaint;
    let [place, expected, hint] = [field, expected, hint].map(|text| some(text));
    Mistake { place, expected, hint, ..said(found.clone()) }
}

fn said(found: String) -> Mistake {
    let (file, line, column) = (None, None, None);
    Mistake { file, line, column, place: None, found, expected: None, hint: None }
}

/// None for an empty text.
fn some(text: &str) -> Option<String> {
    (!text.is_empty()).then(|| text.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_mistake_keeps_its_place() {
        let value = |field: &str| Error::Value(Complaint::new(field, 1, "2").hinted("do"));
        let several = Error::Several { shown: vec![value("a"), value("")], more: 3 };
        let told = document(&several).body;
        let places: Vec<_> = told.mistakes.iter().map(|m| m.place.as_deref()).collect();
        assert_eq!((places, told.more), (vec![Some("a"), None], 3));
        assert_eq!(told.mistakes[0].hint.as_deref(), Some("do"));
        let source = std::io::Error::other("no");
        let told = document(&Error::Read { path: "b.json".into(), source }).body;
        assert_eq!(told.mistakes[0].file.as_deref(), Some("b.json"));
        assert!(told.mistakes[0].found.contains("cannot read b.json: no"));
    }
}
