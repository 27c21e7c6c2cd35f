//! What can a caller get wrong, and what is said then?
//!
//! [`Error`] is everything that any function here returns; [`Error::value`] makes the commonest.
//!
//! Every message is written for the person at the terminal: where, what was found,
//! what was expected, what to do.

use std::fmt;
use std::path::PathBuf;

/// The result of everything here that can fail.
pub type Result<T> = std::result::Result<T, Error>;

/// Everything a caller can cause; a bug in this crate panics instead.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A file that could not be read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },

    /// A file or stream that could not be written; nothing half-written is left behind.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },

    /// Something in an input file is wrong.
    #[error("{place}: {complaint}")]
    Input {
        /// Where it stands.
        place: Place,
        /// What is wrong with it.
        complaint: Complaint,
    },

    /// A value given directly, on the command line or by a program, is wrong.
    #[error("{0}")]
    Value(Complaint),

    /// Part of the bat format or of the command line that this version does not handle yet.
    #[error("{what} is not supported yet: {advice}")]
    NotYet {
        /// What was asked for.
        what: String,
        /// What to do instead.
        advice: &'static str,
    },

    /// Something that was left out when the program was built.
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
         holes is no answer; ask for fewer modes or report this bat"
    )]
    NotConverged {
        /// How many modes were asked for.
        wanted: usize,
        /// How many of them were found.
        converged: usize,
        /// Products with the compliance or the inverse.
        steps: usize,
    },

    /// `K + σM` could not be factored; with too many elements round-off makes it indefinite.
    #[error("cannot factor the stiffness matrix of {unknowns} unknowns: {reason}")]
    Factorization {
        /// Size of the matrix.
        unknowns: usize,
        /// What went wrong, in words.
        reason: &'static str,
    },

    /// A mesh that cannot hold what was asked of it.
    #[error("{wanted} bending modes need at least {least} elements, {found} were asked for")]
    TooFewElements {
        /// How many modes were asked for.
        wanted: usize,
        /// How many elements they need.
        least: usize,
        /// How many elements were asked for.
        found: usize,
    },

    /// A problem too large for the solver that was asked for.
    #[error(
        "the dense solver takes at most {most} unknowns, this mesh has {found}: use --solver statics"
    )]
    TooLarge {
        /// The most unknowns it takes.
        most: usize,
        /// How many there are.
        found: usize,
    },
}

impl Error {
    /// A wrong value of a named quantity, for values that come from no file.
    pub fn value(
        field: impl Into<String>,
        found: impl fmt::Display,
        expected: impl Into<String>,
    ) -> Self {
        Self::Value(Complaint::new(field, found, expected))
    }
}

/// A place in an input file; line and column count from 1.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// Its name, as it was given.
    pub file: String,
    /// From 1.
    pub line: usize,
    /// From 1, in characters.
    pub column: usize,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}:{}:{}", self.file, self.line, self.column)
    }
}

/// What is wrong with one value: the field, what was found, what was expected.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Complaint {
    /// Path of the field, such as `profile.x[3]`; empty for the whole document.
    pub field: String,
    /// What stands there.
    pub found: String,
    /// What should stand there.
    pub expected: String,
}

impl Complaint {
    /// Of a field, what was found in it and what was expected.
    pub fn new(
        field: impl Into<String>,
        found: impl fmt::Display,
        expected: impl Into<String>,
    ) -> Self {
        Self { field: field.into(), found: found.to_string(), expected: expected.into() }
    }
}

impl fmt::Display for Complaint {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        if !self.field.is_empty() {
            write!(f, "{}: ", shortened(&self.field, 200))?;
        }
        write!(f, "found {}, expected {}", shortened(&self.found, 400), self.expected)
    }
}

/// The beginning of a text that may be a megabyte of somebody's file.
pub(crate) fn shortened(text: &str, most: usize) -> String {
    match text.char_indices().nth(most) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

/// The nearest of `names` to a misspelt `word`, if one is near enough to be meant.
///
/// Nearness is the number of single-character edits (Levenshtein's distance), at most
/// a third of the longer word, or two words that differ by case and separators only.
pub fn nearest<'a>(word: &str, names: &[&'a str]) -> Option<&'a str> {
    let plain = |s: &str| s.to_lowercase().replace(['_', '-', ' '], "");
    let word = plain(word);
    names
        .iter()
        .map(|name| (edits(&word, &plain(name)), *name))
        .filter(|(d, name)| 3 * d <= word.chars().count().max(name.chars().count()))
        .min_by_key(|(d, _)| *d)
        .map(|(_, name)| name)
}

fn edits(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, ca) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, cb) in b.iter().enumerate() {
            let substituted = diagonal + usize::from(ca != *cb);
            diagonal = row[j + 1];
            row[j + 1] = substituted.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_misspelt_word_finds_its_neighbour_and_a_strange_one_none() {
        let keys = ["youngs_modulus", "density", "shear_modulus"];
        assert_eq!(nearest("young_modulus", &keys), Some("youngs_modulus"));
        assert_eq!(nearest("Density", &keys), Some("density"));
        assert_eq!(nearest("youngsModulus", &keys), Some("youngs_modulus"));
        assert_eq!(nearest("colour", &keys), None);
        assert_eq!(nearest("", &keys), None);
    }
}
