//! Which rows are in a part, and what is its format?
//!
//! Part k is a function of the study, the number of rows in a part, and k.

use std::ops::Range;
use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::sync::atomic::Ordering::Relaxed;

use crate::csv::Csv;
use crate::many::source::Study;
use crate::many::sums::{self, damaged};
use crate::parts::Cell;
use sweetspot::Result;
use sweetspot_study::files::study_rows::Rows;
use sweetspot_study::many::rows::in_groups;

/// Rows of a part.
pub const ROWS: u64 = 4096;
/// Rows in a part of a study that solves walls, where a row takes a thousand times as long.
pub const ROWS_WITH_WALLS: u64 = 64;

/// How the rows of a study are divided into parts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Division {
    /// All rows.
    pub rows: u64,
    /// Rows of every part but the last.
    pub rows_per_part: u64,
}

impl Division {
    /// The division of a study, according to its outputs.
    pub fn of(rows: &Rows) -> Self {
        let rows_per_part = if rows.solves_walls() { ROWS_WITH_WALLS } else { ROWS };
        Self { rows: rows.count(), rows_per_part }
    }

    /// Number of parts.
    pub fn parts(self) -> u64 {
        self.rows.div_ceil(self.rows_per_part)
    }

    /// The rows of part k.
    pub fn part(self, k: u64) -> Range<u64> {
        let [from, to] =
            [k, k.saturating_add(1)].map(|k| k.saturating_mul(self.rows_per_part).min(self.rows));
        from..to
    }
}

/// Some rows of a study as a CSV file. `tell` receives the number of rows completed since the last call. Once `stop` is
/// set, no more rows are begun and the result is useless.
pub fn made(
    study: &Study,
    rows: Range<u64>,
    stop: &AtomicBool,
    tell: &(impl Fn(u64) + Sync),
) -> String {
    let mut table = Csv::new(study.rows.columns().into_iter().map(|[name, _]| name));
    let of = |some| if stop.load(Relaxed) { vec![] } else { study.rows.cells(some) };
    for cells in in_groups(rows, of, tell) {
        table.row(cells.into_iter().map(Cell::Written));
    }
    table.text()
}

/// Reads a part with those rows, located at `path`, and passes its rows to `each`.
///
/// # Errors
///
/// [`Error::Value`](sweetspot::Error) for a part that differs from what the study makes.
pub fn read(
    rows: &Rows,
    wanted: Range<u64>,
    (path, part): (&Path, &[u8]),
    mut each: impl FnMut(&csv::StringRecord),
) -> Result<()> {
    let damaged = |found: String, expected: String| damaged(path, &found, &expected);
    let table = |error: csv::Error| damaged(error.to_string(), "a table".to_owned());
    let mut reader = csv::Reader::from_reader(part);
    let columns = rows.columns();
    let names: Vec<&str> = columns.iter().map(|[name, _]| &name[..]).collect();
    if reader.headers().map_err(table)? != names {
        return Err(damaged("other columns".to_owned(), names.join(", ")));
    }
    let Range { start: mut row, end } = wanted;
    for cells in reader.records() {
        let cells = cells.map_err(table)?;
        if row == end || cells[0] != *row.to_string() {
            let expected = if row == end { "its end".to_owned() } else { format!("row {row}") };
            return Err(damaged(format!("row \"{}\"", &cells[0]), expected));
        }
        if let Some((column, expected)) = rows.wrong_cell(row, &cells) {
            let found = format!("\"{}\" as {} of row {row}", &cells[column], names[column]);
            return Err(damaged(found, expected));
        }
        each(&cells);
        row += 1;
    }
    match row == end {
        true => Ok(()),
        false => Err(damaged(format!("no row {row}"), format!("rows to {}", end - 1))),
    }
}

/// Checks a part without a sum: writing its rows again must give the same file, to the last line break.
///
/// # Errors
///
/// As [`read`].
pub fn check(rows: &Rows, wanted: Range<u64>, (path, part): (&Path, &[u8])) -> Result<()> {
    let mut anew = Csv::new(rows.columns().into_iter().map(|[name, _]| name));
    let written = |cell: &str| Cell::Written(cell.to_owned());
    read(rows, wanted, (path, part), |row| anew.row(row.iter().map(written)))?;
    if anew.text().as_bytes() == part {
        return Ok(());
    }
    let found = "its rows, and other line breaks, quotes or empty lines than it was written with";
    Err(damaged(path, found, "the file as it was written"))
}

/// The columns of a part that are numbers in every row.
///
/// # Errors
///
/// As [`read`].
pub fn columns(
    rows: &Rows,
    wanted: Range<u64>,
    part: (&Path, &[u8]),
) -> Result<Vec<(String, Vec<f64>)>> {
    let names = rows.columns();
    let named = |k: &usize| (names[*k][0].clone(), vec![]);
    let numbers = rows.numbers();
    let mut columns: Vec<(String, Vec<f64>)> = numbers.iter().map(named).collect();
    read(rows, wanted, part, |row| {
        for ((_, values), k) in columns.iter_mut().zip(&numbers) {
            values.push(number(&row[*k]));
        }
    })?;
    Ok(columns)
}

/// The value of a cell: 1 or 0 for yes or no, NaN where it is missing.
pub fn number(cell: &str) -> f64 {
    match cell {
        "true" => 1.0,
        "false" => 0.0,
        cell => cell.parse().unwrap_or(f64::NAN),
    }
}

/// Whether that is the name of a part, of the archive of a part, or of the sum of one of these.
pub fn is_of_one(name: &str) -> bool {
    let name = name.strip_suffix(sums::END).unwrap_or(name);
    let part = name.strip_prefix("part-").and_then(|part| part.split_once('.'));
    part.is_some_and(|(number, kind)| {
        number.len() >= 6
            && number.bytes().all(|digit| digit.is_ascii_digit())
            && ["csv", "npz", "parquet"].contains(&kind)
    })
}
