//! Measured modes from a file: a table that somebody typed, or a universal file.

pub mod table;
pub mod places;
pub mod direction;
pub mod universal;
pub mod coherence;
pub mod response;

use std::path::Path;

use crate::engine::{Error, Result};
use crate::files::measured::places::Places;
use crate::measured::data::{FrequencyUnit, Measured};
use uff58::Units;

/// With fewer points, shapes cannot be distinguished.
const FEWEST: usize = 3;

/// Whether a file is a table, by the ending that spreadsheets and modal programs use.
pub fn is_table(path: &Path) -> bool {
    ["csv", "txt", "tsv"].contains(&ending(path).as_str())
}

/// Whether a file has measured modes, by the ending of its name.
pub fn has_modes(path: &Path) -> bool {
    is_table(path) || ["uff", "unv"].contains(&ending(path).as_str())
}

fn ending(path: &Path) -> String {
    path.extension().unwrap_or_default().to_string_lossy().to_lowercase()
}

/// Facts that a universal file does not contain.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Beside {
    /// The units of a file that names none.
    pub unit: Option<Units>,
    /// Positions of the nodes of a file without geometry.
    pub places: Option<Places>,
    /// Unit of its frequencies, if it departs from its format.
    pub frequency_unit: Option<FrequencyUnit>,
}

/// Reads measured modes, by the ending of the file's name.
///
/// # Errors
///
/// [`Error::Value`] for another ending, and for additional facts about a table, which contains them itself; those of
/// [`table::read`] and [`universal::read`].
pub fn read(path: &Path, beside: &Beside) -> Result<Measured> {
    match ending(path).as_str() {
        _ if is_table(path) && *beside != Beside::default() => {
            let found = path.display();
            let expected = "a universal file: a table names its units and places itself";
            Err(Error::value("--unit, --places or --frequency-unit", found, expected))
        }
        _ if is_table(path) => table::read(path),
        "uff" | "unv" => universal::read(path, beside),
        _ => {
            let expected = "a file whose name ends with .csv, .txt, .uff or .unv";
            Err(Error::value("measured modes", path.display(), expected))
        }
    }
}
