//! Measured modes from a file: a table that somebody typed, or a universal file.

mod cells;
pub mod table;
pub mod direction;
pub mod universal;
pub mod response;

use std::path::Path;

use crate::base::error::{Error, Result};
use crate::study::measured::data::Measured;

/// Fewer points tell no shape from another.
const FEWEST: usize = 3;

/// Reads measured modes, by the ending of the file's name.
///
/// # Errors
///
/// [`Error::Value`] for another ending, and those of [`table::read`] and [`universal::read`].
pub fn read(path: &Path) -> Result<Measured> {
    let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    match ending.as_str() {
        "csv" => table::read(path),
        "uff" | "unv" => universal::read(path),
        _ => {
            let expected = "a file whose name ends with .csv, .uff or .unv";
            Err(Error::value("measured modes", path.display(), expected))
        }
    }
}
