//! What is wrong with the input, `sweetspot-error/1`.

use schemars::JsonSchema;
use serde::Serialize;

use crate::base::error::{Complaint, Error, Place, shortened};
use crate::files::schema::document::{Document, Format, Generator};

/// Why a command with --json failed: the mistakes in its input or on its command line, in the order of
/// the file. It is the last line of standard error, on that line alone. What does not exist is null.
/// Later versions of the same number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "Error of sweetspot, sweetspot-error/1")]
pub struct ErrorFile {
    /// Name of the format and its version: sweetspot-error/1.
    pub format: Format<ErrorFile>,
    /// The program that wrote it.
    pub generator: Generator,
    /// Mistakes, the first ten of a file.
    pub mistakes: Vec<Mistake>,
    /// Number of mistakes beyond these.
    pub more: usize,
}

impl Document for ErrorFile {
    const NAME: &'static str = "error";
}

/// One mistake.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Mistake {
    /// File that it is in, as it was given; null of the command line.
    pub file: Option<String>,
    /// Line in the file, from 1.
    pub line: Option<usize>,
    /// Column in the line, in characters from 1.
    pub column: Option<usize>,
    /// Field of the file, such as profile.x[3], or option of the command line; null where it is the
    /// whole.
    pub place: Option<String>,
    /// What was found.
    pub found: Option<String>,
    /// What was expected.
    pub expected: Option<String>,
    /// What to do about it.
    pub hint: Option<String>,
    /// The whole mistake as a sentence.
    pub message: String,
}

impl ErrorFile {
    /// An error of the library. `field` turns the name of a value of no file into that of an option.
    pub fn of(error: &Error, field: impl Fn(&str) -> String) -> Self {
        let (mistakes, more) = match error {
            Error::Several { shown, more } => {
                (shown.iter().map(|one| Mistake::of(one, &field)).collect(), *more)
            }
            one => (vec![Mistake::of(one, &field)], 0),
        };
        Self { more, ..Self::saying(mistakes) }
    }

    /// These mistakes.
    pub fn saying(mistakes: Vec<Mistake>) -> Self {
        Self { format: Format::new(), generator: Generator::this(), mistakes, more: 0 }
    }
}

impl Mistake {
    /// A mistake of which only the sentence is known.
    pub fn saying(message: String) -> Self {
        Self {
            file: None,
            line: None,
            column: None,
            place: None,
            found: None,
            expected: None,
            hint: None,
            message,
        }
    }

    fn of(error: &Error, field: &impl Fn(&str) -> String) -> Self {
        let plain = Self::saying(error.to_string());
        match error {
            Error::Input { place, complaint } => {
                let Place { file, line, column, .. } = &**place;
                let (line, column) = (Some(*line), Some(*column));
                Self { file: Some(file.clone()), line, column, ..plain }.complaining(complaint)
            }
            Error::Value(complaint) => {
                let complaint = Complaint { field: field(&complaint.field), ..complaint.clone() };
                Self::saying(complaint.to_string()).complaining(&complaint)
            }
            Error::Read { path, source } | Error::Write { path, source } => {
                let (file, found) = (path.display().to_string(), source.to_string());
                Self { file: Some(file), found: Some(found), ..plain }
            }
            Error::NotYet { what, advice } => {
                Self { found: Some(what.clone()), hint: Some((*advice).to_owned()), ..plain }
            }
            Error::NotBuilt { what, advice } => {
                let found = Some((*what).to_owned());
                Self { found, hint: Some((*advice).to_owned()), ..plain }
            }
            _ => plain,
        }
    }

    fn complaining(self, complaint: &Complaint) -> Self {
        // A field may hold a megabyte of somebody's file.
        let told = |text: &str| (!text.is_empty()).then(|| shortened(text, 400));
        Self {
            place: told(&complaint.field),
            found: told(&complaint.found),
            expected: told(&complaint.expected),
            hint: told(&complaint.hint),
            ..self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::error::Excerpt;

    #[test]
    fn a_mistake_keeps_every_part_of_an_error() {
        let excerpt = Excerpt::default();
        let place = Box::new(Place { file: "a.json".into(), line: 3, column: 4, excerpt });
        let complaint = Complaint::new("profile.x[1]", "-1", "0 or more").hinted("turn it round");
        let input = Error::Input { place, complaint };
        let several = Error::Several { shown: vec![input, Error::value("a", 1, "2")], more: 7 };
        let file = ErrorFile::of(&several, |name| format!("--{name}"));
        let [input, value] = &file.mistakes[..] else { panic!() };
        assert_eq!((file.more, input.line, input.column), (7, Some(3), Some(4)));
        let text = |part: &Option<String>| part.clone().unwrap_or_default();
        let parts = [&input.file, &input.place, &input.found, &input.expected, &input.hint];
        let said = ["a.json", "profile.x[1]", "-1", "0 or more", "turn it round"];
        assert_eq!(parts.map(text), said);
        assert_eq!(value.message, "--a: found 1, expected 2");
        assert_eq!((text(&value.place), &value.file, &value.hint), ("--a".into(), &None, &None));
    }
}
