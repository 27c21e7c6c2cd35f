//! Which files may a file name, and how are they read?
//!
//! A file may come from a stranger. The files that it names must be in its own [`Folder`] or below. They may be
//! elsewhere only if a person has named the file itself; that person is then told. A file that does not begin as it
//! should is not quoted, since messages are logged and sent.

use std::cell::RefCell;
use std::fs;
use std::path::{Component, Path, PathBuf};

use crate::base::file::read_plain;
use crate::base::{Complaint, Error, Excerpt, FilePosition, Result};
use crate::files::document::Document;
use crate::files::sheet;

/// Files that were read from outside the folder of the file that names them.
#[derive(Debug, Default)]
pub struct Outside(RefCell<Vec<PathBuf>>);

impl Outside {
    /// Their paths, each once.
    pub fn paths(self) -> Vec<PathBuf> {
        self.0.into_inner()
    }

    fn note(&self, path: &Path) {
        let mut all = self.0.borrow_mut();
        if !all.iter().any(|known| known == path) {
            all.push(path.to_owned());
        }
    }
}

/// The folder of a file, in which the files that it names are looked up.
#[derive(Debug, Clone, Copy)]
pub struct Folder<'a> {
    path: &'a Path,
    /// Record of files outside the folder; without it such files are refused.
    outside: Option<&'a Outside>,
}

impl<'a> Folder<'a> {
    /// A folder whose files must stay inside it.
    pub fn closed(path: &'a Path) -> Self {
        Self { path, outside: None }
    }

    /// The folder of a file that a person has named; files read from elsewhere are recorded.
    pub fn of(file: &'a Path, outside: &'a Outside) -> Self {
        Self { path: file.parent().unwrap_or(Path::new("")), outside: Some(outside) }
    }

    /// Path of the folder.
    pub fn path(&self) -> &Path {
        self.path
    }

    /// A folder inside this one, with the same rule for files outside.
    pub fn below(self, path: &'a Path) -> Self {
        Self { path, ..self }
    }

    /// The path of a file by its name, if it may be read.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for a file outside of the folder.
    pub fn find(&self, name: &str) -> Result<PathBuf> {
        let path = self.path.join(name);
        let folder = if self.path == Path::new("") { Path::new(".") } else { self.path };
        // Links are followed; a file that cannot be found is judged by its name.
        let inside = match (fs::canonicalize(folder), fs::canonicalize(&path)) {
            (Ok(folder), Ok(file)) => file.starts_with(folder),
            _ => Path::new(name).components().all(|part| matches!(part, Component::Normal(_))),
        };
        match self.outside {
            _ if inside => {}
            Some(outside) => outside.note(&path),
            None => {
                let expected = "a file in the folder of this one, or below";
                let hint = "the command line also reads others, of a file named there";
                let complaint = Complaint::new("", format!("\"{name}\""), expected);
                return Err(Error::Value(complaint.hinted(hint)));
            }
        }
        Ok(path)
    }

    /// A document of that kind, such as `bat`.
    ///
    /// # Errors
    ///
    /// As [`Self::find`]; [`Error::Read`]; [`Error::Input`], without quoting a file that does not begin like such a
    /// document.
    pub fn json(&self, name: &str, kind: &str) -> Result<Document> {
        json(&self.find(name)?, kind)
    }

    /// A table of numbers with columns of those names.
    ///
    /// # Errors
    ///
    /// As [`Self::json`].
    pub(crate) fn table(&self, name: &str, columns: &[&str]) -> Result<Document> {
        let path = self.find(name)?;
        let begins = |text: &str| sheet::begins_with_numbers(text, columns);
        match Document::named(&path, true)? {
            Ok(document) if begins(&document.text) => Ok(document),
            // Text that cannot be read occurs only further down.
            Err(error) if begins(&String::from_utf8_lossy(&read_plain(&path)?)) => Err(error),
            _ => {
                let expected = "names of columns, such as x_in,diameter_in, and numbers below them";
                Err(something_else(&path, "a table of numbers", expected))
            }
        }
    }
}

/// The document of that kind at a path that may be read.
///
/// # Errors
///
/// Those of [`Folder::json`].
pub fn json(path: &Path, kind: &str) -> Result<Document> {
    // A document of another kind is reported by its format.
    let begins = |text: &str| text.trim_start().starts_with('{') && text.contains("\"sweetspot-");
    match Document::named(path, false)? {
        Ok(document) if begins(&document.text) => Ok(document),
        Err(error) if begins(&String::from_utf8_lossy(&read_plain(path)?)) => Err(error),
        _ => {
            let expected = format!("a JSON object with \"format\": \"sweetspot-{kind}/1\"");
            Err(something_else(path, &format!("a {kind} file"), &expected))
        }
    }
}

/// An error about the beginning of a file, without quoting it.
fn something_else(path: &Path, than: &str, expected: &str) -> Error {
    let (file, excerpt) = (path.display().to_string(), Excerpt::default());
    let place = Box::new(FilePosition { file, line: 1, column: 1, excerpt });
    let complaint = Complaint::new("", format!("something else than {than}"), expected);
    Error::Input { place, complaint }
}
