//! The mistakes as a document for other programs.

use std::path::Path;

use crate::schema::mistakes::{ErrorFile, Mistake};
use sweetspot::base::error::{Complaint, Error, FilePosition};
use sweetspot::files::schema::document::{Format, Generator};

/// The `sweetspot-error/1` document of an error.
pub fn document(error: &Error) -> ErrorFile {
    match error {
        Error::Several { shown, more } => file(shown.iter().map(mistake).collect(), *more),
        one => file(vec![mistake(one)], 0),
    }
}

/// That of one mistake on the command line.
pub fn of_option(complaint: &Complaint) -> ErrorFile {
    file(vec![complained(complaint)], 0)
}

fn file(mistakes: Vec<Mistake>, more: usize) -> ErrorFile {
    ErrorFile { format: Format::new(), generator: Generator::this(), mistakes, more }
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
        let told = document(&several);
        let places: Vec<_> = told.mistakes.iter().map(|m| m.place.as_deref()).collect();
        assert_eq!((places, told.more), (vec![Some("a"), None], 3));
        assert_eq!(told.mistakes[0].hint.as_deref(), Some("do"));
        let source = std::io::Error::other("no");
        let told = document(&Error::Read { path: "b.json".into(), source });
        assert_eq!(told.mistakes[0].file.as_deref(), Some("b.json"));
        assert!(told.mistakes[0].found.contains("cannot read b.json: no"));
    }
}
