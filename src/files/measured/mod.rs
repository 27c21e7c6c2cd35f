//! Measured modes from a file: a table that somebody typed, or a universal file.

pub mod table;
pub mod places;
pub mod direction;
pub mod universal;
pub mod response;

use std::path::Path;

use crate::base::error::{Error, Result};
use crate::files::measured::places::Places;
use crate::files::uff::Units;
use crate::study::measured::data::Measured;

/// Fewer points tell no shape from another.
const FEWEST: usize = 3;

/// Whether a file is a table, by the ending of its name: what spreadsheets and modal programs call one.
pub fn is_table(path: &Path) -> bool {
    let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    ["csv", "txt", "tsv"].contains(&ending.as_str())
}

/// Reads measured modes, by the ending of the file's name.
///
/// # Errors
///
/// [`Error::Value`] for another ending, and those of [`table::read`] and [`universal::read`].
pub fn read(path: &Path) -> Result<Measured> {
    read_with(path, &Beside::default())
}

/// What is known of a universal file beside it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Beside {
    /// The units of a file that names none.
    pub unit: Option<Units>,
    /// Where the nodes of a file without geometry are.
    pub places: Option<Places>,
}

/// As [`read`], of a file of which that is known.
///
/// # Errors
///
/// Those of [`read`]; [`Error::Value`] for a unit or places beside a CSV file, which has its own.
pub fn read_with(path: &Path, beside: &Beside) -> Result<Measured> {
    let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    match ending.as_str() {
        _ if is_table(path) && *beside != Beside::default() => {
            let expected = "a universal file: a table names its units and places itself";
            Err(Error::value("--unit or --places", path.display(), expected))
        }
        _ if is_table(path) => table::read(path),
        "uff" | "unv" => universal::read_with(path, beside),
        _ => {
            let expected = "a file whose name ends with .csv, .txt, .uff or .unv";
            Err(Error::value("measured modes", path.display(), expected))
        }
    }
}
