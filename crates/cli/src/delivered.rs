//! Where results go besides the table: files, and one of them to standard output.

use std::path::{Path, PathBuf};

use sweetspot::base::error::{Error, Result};
use sweetspot::base::file;

/// Whether a file's name stands for standard output.
fn to_stdout(path: &Option<PathBuf>) -> bool {
    path.as_ref().is_some_and(|path| path.as_os_str() == "-")
}

/// Every document goes to a place of its own: of these options, no two name one file, or both
/// standard output. To be asked before anything is computed or written.
///
/// # Errors
///
/// [`Error::Value`] about the second.
pub fn apart(named: &[(&str, &Option<PathBuf>)]) -> Result<()> {
    let named = named.iter().filter_map(|(option, path)| Some((*option, path.as_deref()?)));
    let named: Vec<(&str, &Path)> = named.collect();
    for (k, (second, path)) in named.iter().enumerate() {
        let stdout = path.as_os_str() == "-";
        let alike = |(_, other): &&(&str, &Path)| match stdout {
            true => other == path,
            false => file::is_one(other, path),
        };
        let Some((first, other)) = named[..k].iter().find(alike) else { continue };
        let found = format!("{} beside {first} {}", path.display(), other.display());
        let expected =
            if stdout { "one of them on standard output" } else { "another name for one of them" };
        return Err(Error::value(*second, found, expected));
    }
    Ok(())
}

/// Writes a text to its file; what takes the place of `table` if that is standard output.
///
/// # Errors
///
/// [`Error::Write`].
pub fn put(
    path: &Option<PathBuf>,
    table: String,
    text: impl FnOnce() -> Result<String>,
) -> Result<String> {
    match path {
        Some(_) if to_stdout(path) => text(),
        Some(path) => file::write(path, text()?.as_bytes()).map(|()| table),
        None => Ok(table),
    }
}
