//! Where results go besides the table: files, and one of them to standard output.

use std::path::PathBuf;

use crate::base::error::{Error, Result};
use crate::base::file;

/// Whether a file's name stands for standard output.
pub fn to_stdout(path: &Option<PathBuf>) -> bool {
    path.as_ref().is_some_and(|path| path.as_os_str() == "-")
}

/// Standard output is for one document: of these options, at most one names it.
///
/// # Errors
///
/// [`Error::Value`] about the second.
pub fn one_on_stdout(named: &[(&str, &Option<PathBuf>)]) -> Result<()> {
    let mut there = named.iter().filter(|(_, path)| to_stdout(path));
    match (there.next(), there.next()) {
        (Some((first, _)), Some((second, _))) => {
            let found = format!("- beside {first} -");
            Err(Error::value(*second, found, "one of them on standard output"))
        }
        _ => Ok(()),
    }
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
