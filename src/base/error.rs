//! What can a caller get wrong, and how is it reported?
//!
//! [`Error`] is the error type of every function here; [`Error::value`] makes the commonest one.
//!
//! Every message is written for the person at the terminal: where, what was found, what was expected, what to do.

use std::fmt;
use std::path::PathBuf;

use crate::base::marks::written_out as one_line;

/// The result of every function here that can fail.
pub type Result<T> = std::result::Result<T, Error>;

/// Everything a caller can cause; a bug in this crate panics instead.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A file could not be read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The error of the operating system.
        source: std::io::Error,
    },

    /// A file or stream could not be written; no partly written file is left behind.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The error of the operating system.
        source: std::io::Error,
    },

    /// Something in an input file is wrong.
    #[error("{place}: {complaint}")]
    Input {
        /// Position of the mistake.
        place: Box<FilePosition>,
        /// What is wrong with it.
        complaint: Complaint,
    },

    /// Several things are wrong with a file.
    #[error("{}", said_together(shown, *more))]
    Several {
        /// The first mistakes in the order of the file, two or more.
        shown: Vec<Error>,
        /// Number of further mistakes.
        more: usize,
    },

    /// A value given directly, on the command line or by a program, is wrong.
    #[error("{0}")]
    Value(Complaint),

    /// This version does not yet handle this part of the bat format or of the command line.
    #[error("{what} is not supported yet: {advice}")]
    NotYet {
        /// What was asked for.
        what: String,
        /// What to do instead.
        advice: &'static str,
    },

    /// The program was built without this part.
    #[error("{what} is not in this build: {advice}")]
    NotBuilt {
        /// What was asked for.
        what: &'static str,
        /// How to build it in.
        advice: &'static str,
    },

    /// The iteration stopped before every wanted mode had converged.
    #[error(
        "only {converged} of {wanted} modes converged in {steps} Lanczos steps, and a list with \
         holes would be misread; ask for fewer modes or report this bat"
    )]
    NotConverged {
        /// How many modes were asked for.
        wanted: usize,
        /// How many of them were found.
        converged: usize,
        /// Number of products with the compliance or the inverse.
        steps: usize,
    },

    /// `K + σM` could not be factored; with too many elements, round-off makes it indefinite.
    #[error("cannot factor the stiffness matrix of {unknowns} unknowns: {reason}")]
    Factorization {
        /// Size of the matrix.
        unknowns: usize,
        /// The reason, in words.
        reason: &'static str,
    },

    /// The mesh has too few elements for the modes asked for.
    #[error("{wanted} bending modes need at least {least} elements, {found} were asked for")]
    TooFewElements {
        /// How many modes were asked for.
        wanted: usize,
        /// The least number of elements that can hold them.
        least: usize,
        /// How many elements were asked for.
        found: usize,
    },

    /// The problem is too large for the solver that was asked for.
    #[error(
        "the dense solver takes at most {most} unknowns, this mesh has {found}: use the solver statics"
    )]
    TooLarge {
        /// The most unknowns that the solver takes.
        most: usize,
        /// Number of unknowns of this mesh.
        found: usize,
    },
}

impl Error {
    /// A wrong value of a named quantity that does not come from a file.
    pub fn value(
        field: impl Into<String>,
        found: impl fmt::Display,
        expected: impl Into<String>,
    ) -> Self {
        Self::Value(Complaint::new(field, found, expected))
    }

    /// This error with `place` applied to each of its complaints about a value, to add the position.
    pub fn placed(self, place: impl Fn(Complaint) -> Self) -> Self {
        let one = |error| match error {
            Self::Value(complaint) => place(complaint),
            other => other,
        };
        match self {
            Self::Several { shown, more } => {
                Self::Several { shown: shown.into_iter().map(one).collect(), more }
            }
            error => one(error),
        }
    }
}

/// The text of the first of several errors, and the number of the others.
fn said_together(shown: &[Error], more: usize) -> String {
    let first = shown.first().map_or(String::new(), Error::to_string);
    match (shown.len() + more).saturating_sub(1) {
        0 => first,
        1 => format!("{first} (and 1 more mistake)"),
        others => format!("{first} (and {others} more mistakes)"),
    }
}

/// A place in an input file; line and column count from 1, the column in characters.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FilePosition {
    /// Name of the file, as it was given.
    pub file: String,
    /// Line, counted from 1.
    pub line: usize,
    /// Column, counted in characters from 1.
    pub column: usize,
    /// The line itself.
    pub excerpt: Excerpt,
}

/// The line of a mistake in three parts: the text before it, the mistake itself (empty at the end of a file) and the
/// text after it. A long line is shortened to the surroundings of the mistake, with `…` where text is left out.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Excerpt {
    /// Text before the mistake.
    pub before: String,
    /// The mistake itself; empty at the end of a file.
    pub marked: String,
    /// Text after the mistake.
    pub after: String,
}

impl fmt::Display for FilePosition {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}:{}:{}", one_line(&self.file), self.line, self.column)
    }
}

/// What is wrong with one value: the field, what was found, what was expected, what to do.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Complaint {
    /// Path of the field, such as `profile.x[3]`; empty for the whole document.
    pub field: String,
    /// The value found in the field.
    pub found: String,
    /// The value expected in the field.
    pub expected: String,
    /// What to do about it, such as "did you mean radius?"; empty if there is no advice.
    pub hint: String,
}

impl Complaint {
    /// A complaint about a field: what was found in it and what was expected.
    pub fn new(
        field: impl Into<String>,
        found: impl fmt::Display,
        expected: impl Into<String>,
    ) -> Self {
        let (found, hint) = (found.to_string(), String::new());
        Self { field: field.into(), found, expected: expected.into(), hint }
    }

    /// This complaint with a hint about what to do.
    pub fn hinted(self, hint: impl Into<String>) -> Self {
        Self { hint: hint.into(), ..self }
    }

    /// This complaint with each name in `` `backquotes` `` rewritten by `written`, in the way the caller writes names.
    pub fn naming(self, written: impl Fn(&str) -> String) -> Self {
        let told = |text: String| {
            let parts = text.split('`').enumerate();
            parts
                .map(|(k, part)| if k % 2 == 1 { written(part) } else { part.to_owned() })
                .collect()
        };
        let Self { field, found, expected, hint } = self;
        Self { field: told(field), found: told(found), expected: told(expected), hint: told(hint) }
    }

    /// This complaint with a hint at the nearest of `names` to a misspelt `word`, if one is near enough.
    pub fn or_nearest(self, word: &str, names: &[&str]) -> Self {
        match nearest(word, names) {
            Some(name) => self.hinted(format!("did you mean {name}?")),
            None => self,
        }
    }
}

impl fmt::Display for Complaint {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        if !self.field.is_empty() {
            write!(f, "{}: ", one_line(&shortened(&self.field, 200)))?;
        }
        let found = one_line(&shortened(&self.found, 400));
        write!(f, "found {found}, expected {}", one_line(&self.expected))?;
        if self.hint.is_empty() { Ok(()) } else { write!(f, "; {}", one_line(&self.hint)) }
    }
}

/// The beginning of a text, at most `most` characters: the text may be a megabyte long.
pub fn shortened(text: &str, most: usize) -> String {
    match text.char_indices().nth(most) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

/// The nearest of `names` to a misspelt `word`, if one is near enough to be meant.
///
/// A name is near if at most two edits of a letter (Damerau–Levenshtein distance), and no more than a third of the
/// longer word, separate the two, or if they differ only in case and separators. Otherwise a word of three letters or
/// more matches the last name of which it is a whole part, as `maple` is of `sugar-maple`.
pub fn nearest<'a>(word: &str, names: &[&'a str]) -> Option<&'a str> {
    let plain = |s: &str| s.to_lowercase().replace(['_', '-', ' '], "");
    let word = plain(word);
    names
        .iter()
        .map(|name| (edits(&word, &plain(name)), *name))
        .filter(|(d, name)| *d <= 2 && 3 * d <= word.chars().count().max(name.chars().count()))
        .min_by_key(|(d, _)| *d)
        .map(|(_, name)| name)
        .or_else(|| {
            let part = |name: &str| name.split(['_', '-', ' ']).any(|part| plain(part) == word);
            let holds = |name: &&&str| word.chars().count() >= 3 && part(name);
            names.iter().rev().find(holds).copied()
        })
}

/// The least number of letters to insert, delete, change or swap with the next to turn one word into the other.
fn edits(a: &str, b: &str) -> usize {
    let [a, b] = [a, b].map(|word| word.chars().collect::<Vec<char>>());
    let mut rows: Vec<Vec<usize>> = vec![(0..=b.len()).collect()];
    for i in 0..a.len() {
        let mut row = vec![i + 1];
        for j in 0..b.len() {
            let changed = rows[i][j] + usize::from(a[i] != b[j]);
            let mut least = changed.min(row[j] + 1).min(rows[i][j + 1] + 1);
            if i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j] {
                least = least.min(rows[i - 1][j - 1] + 1);
            }
            row.push(least);
        }
        rows.push(row);
    }
    rows[a.len()][b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_misspelt_word_finds_its_neighbour_and_a_strange_one_none() {
        let keys = ["youngs_modulus", "density", "shear_modulus"];
        assert_eq!(nearest("young_modulus", &keys), Some("youngs_modulus"));
        assert_eq!(nearest("Density", &keys), Some("density"));
        assert_eq!(nearest("picth", &["hands", "pitch"]), Some("pitch"));
        assert_eq!(nearest("youngsModulus", &keys), Some("youngs_modulus"));
        assert_eq!(nearest("colour", &keys), None);
        assert_eq!(nearest("maple", &["calibrate", "completions", "compare"]), None);
        assert_eq!(nearest("maple", &["hickory", "sugar-maple"]), Some("sugar-maple"));
        assert_eq!(nearest("completely", &["completions"]), None);
        assert_eq!(nearest("", &keys), None);
    }

    #[test]
    fn an_error_is_one_line_whatever_is_in_the_file() {
        let complaint = Complaint::new("a\nb", "\"\u{1b}[2J\"", "é").hinted("did you mean 7?");
        let excerpt = Excerpt::default();
        let place =
            Box::new(FilePosition { file: "my\tbat.json".into(), line: 3, column: 4, excerpt });
        let one = || Error::Input { place: place.clone(), complaint: complaint.clone() };
        let said = "my\\tbat.json:3:4: a\\nb: found \"\\u{1b}[2J\", expected é; did you mean 7?";
        assert_eq!(one().to_string(), said);
        let two = Error::Several { shown: vec![one(), one()], more: 0 };
        assert_eq!(two.to_string(), format!("{said} (and 1 more mistake)"));
        let many = Error::Several { shown: vec![one(), one()], more: 7 };
        assert_eq!(many.to_string(), format!("{said} (and 8 more mistakes)"));
    }
}
