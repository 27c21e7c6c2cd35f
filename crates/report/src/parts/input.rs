//! A file that the user gave, as a report shows it.

use std::path::Path;

use serde_json::Value;

use sweetspot::base::error::Result;
use sweetspot::base::file;

/// A file as the user wrote it.
#[derive(Debug, Clone, PartialEq)]
pub struct Input {
    /// Its path as given.
    pub name: String,
    /// Its content, without a byte order mark.
    pub text: String,
}

impl Input {
    /// Longer texts are cut in a page.
    pub const MOST: usize = 60_000;

    /// Reads a file that was read before. A pipe gives an empty text, because it has been read.
    ///
    /// # Errors
    ///
    /// [`Error::Read`](sweetspot::Error::Read).
    pub fn read(path: &Path) -> Result<Self> {
        let bytes = if path.is_file() { file::read_plain(path)? } else { vec![] };
        Ok(Self::new(path, &String::from_utf8_lossy(&bytes)))
    }

    /// A file that was read.
    pub fn new(path: &Path, text: &str) -> Self {
        let text = text.trim_start_matches('\u{feff}').to_owned();
        Self { name: path.display().to_string(), text }
    }

    /// A bat file that was read, and the columns that it names.
    ///
    /// # Errors
    ///
    /// [`Error::Read`](sweetspot::Error::Read).
    pub fn of_bat(path: &Path, text: &str) -> Result<Vec<Self>> {
        let document: Value = serde_json::from_str(text).unwrap_or_default();
        let mut all = vec![Self::new(path, text)];
        if let Some(columns) = document["profile"]["csv"].as_str() {
            all.push(Self::read(&path.with_file_name(columns))?);
        }
        Ok(all)
    }

    /// The text as a page shows it, and a remark if it is shortened.
    pub fn shown(&self) -> (&str, Option<&'static str>) {
        match self.text.char_indices().nth(Self::MOST) {
            Some((end, _)) => (&self.text[..end], Some("Only its beginning is shown.")),
            None if self.text.is_empty() => {
                ("", Some("Not shown: it can be read only once, as a pipe can."))
            }
            None => (&self.text, None),
        }
    }
}
