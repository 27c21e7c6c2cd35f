//! Columns of numbers from a CSV file, each row with its place.

use std::ops::Range;

use crate::base::error::{Complaint, Error, Result};
use crate::base::mistakes::{self, Mistakes};
use crate::base::units::{self, Quantity};
use crate::files::document::Document;

/// A table of numbers: the columns of a CSV file in SI, and where each row stands.
///
/// The header names the columns and gives their units (`x_in,diameter_in`); lines that begin
/// with `#` are comments.
pub(crate) struct Csv {
    columns: Vec<(&'static str, Vec<f64>)>,
    /// The unit of each column as the header writes it; empty for a column without a unit.
    units: Vec<String>,
    /// Byte offset of the header, and of each row.
    pub header: usize,
    pub rows: Vec<usize>,
}

impl Csv {
    /// Reads columns whose names are among `keys`; one without a unit is times `unit`.
    pub fn read(
        document: &Document,
        keys: &[&'static str],
        quantity: Quantity,
        unit: f64,
    ) -> Result<Self> {
        let columns: Vec<_> = keys.iter().map(|key| (*key, quantity, unit)).collect();
        Self::read_columns(document, &columns)
    }

    /// Reads columns of several quantities: name, quantity and the unit where the header has none.
    pub fn read_columns(
        document: &Document,
        columns: &[(&'static str, Quantity, f64)],
    ) -> Result<Self> {
        let keys: Vec<&'static str> = columns.iter().map(|(key, ..)| *key).collect();
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .flexible(true)
            .has_headers(false)
            .from_reader(document.text.as_bytes());
        let text = &document.text;
        let offset = |record: &csv::StringRecord| {
            row_start(text, record.position().map_or(0, |p| p.byte() as usize))
        };
        let mut records = reader.records();
        let Some(Ok(names)) = records.next() else {
            let expected = format!("a header of {} and their units", keys.join(", "));
            return Err(document.error(0..0, Complaint::new("", "no header", expected)));
        };
        let header = offset(&names);
        let scales = scales(document, header, &names, columns)?;
        let mut filled: Vec<_> = scales.iter().map(|(key, _)| (*key, Vec::new())).collect();
        let mut rows = Vec::new();
        mistakes::all(records.map(|record| {
            let record = record.map_err(|error| {
                let complaint = Complaint::new("", error, "rows of numbers");
                document.error(line(text, header), complaint)
            })?;
            let at = offset(&record);
            rows.push(at);
            read_row(document, at, &record, &scales, &mut filled)
        }))?;
        let unit = |(name, (key, _)): (&str, &(&str, f64))| {
            name[key.len()..].trim_start_matches('_').to_owned()
        };
        let units = names.iter().zip(&scales).map(unit).collect();
        Ok(Self { columns: filled, units, header, rows })
    }

    /// An error about a value: a row of a column, or the header.
    pub fn error(
        &self,
        document: &Document,
        key: &str,
        row: Option<usize>,
        complaint: Complaint,
    ) -> Error {
        match row {
            Some(row) => document.error(self.cell(&document.text, key, row).0, complaint),
            None => document.error(line(&document.text, self.header), complaint),
        }
    }

    /// Where a cell stands in the text, and its unit.
    pub fn cell(&self, text: &str, key: &str, row: usize) -> (Range<usize>, &str) {
        let column = self.columns.iter().position(|(name, _)| *name == key).unwrap_or(0);
        let row = self.rows.get(row).copied().unwrap_or(self.header);
        (cell(text, row, column), &self.units[column])
    }

    pub fn column(&self, key: &str) -> Option<&[f64]> {
        self.columns.iter().find(|(name, _)| *name == key).map(|(_, values)| values.as_slice())
    }
}

/// The first byte at or after `offset` that belongs to no comment and no empty line.
pub(crate) fn row_start(text: &str, mut offset: usize) -> usize {
    loop {
        let rest = &text[offset..];
        offset += match rest.bytes().next() {
            Some(b'\r' | b'\n') => 1,
            Some(b'#') => rest.find('\n').unwrap_or(rest.len()),
            _ => return offset,
        };
    }
}

/// The line that begins at `offset`, without its end.
fn line(text: &str, offset: usize) -> Range<usize> {
    let line = text[offset..].lines().next().unwrap_or_default();
    offset..offset + line.trim_end().len()
}

/// Where cell number `column` of the row at `offset` stands, the spaces around it left out.
pub(crate) fn cell(text: &str, offset: usize, column: usize) -> Range<usize> {
    let (mut quoted, mut passed, mut start, mut end) = (false, 0, offset, text.len());
    for (at, byte) in (offset..).zip(text[offset..].bytes()) {
        match byte {
            b'"' => quoted = !quoted,
            b',' if !quoted && passed < column => (passed, start) = (passed + 1, at + 1),
            b',' | b'\n' if !quoted => {
                end = at;
                break;
            }
            _ => {}
        }
    }
    let start = end - text[start..end].trim_start().len();
    start..start + text[start..end].trim_end().len()
}

/// Key and factor to SI of every column.
fn scales(
    document: &Document,
    header: usize,
    names: &csv::StringRecord,
    columns: &[(&'static str, Quantity, f64)],
) -> Result<Vec<(&'static str, f64)>> {
    if let Some(complaint) = not_by_commas(names) {
        return Err(document.error(line(&document.text, header), complaint));
    }
    /// Columns that are checked: a header with more than this has a mistake among the first ones, since
    /// there are fewer keys.
    const LOOKED_AT: usize = 100;
    let mut seen = Vec::new();
    mistakes::all(names.iter().enumerate().take(LOOKED_AT).map(|(k, name)| {
        let wrong = |complaint| document.error(cell(&document.text, header, k), complaint);
        let (key, scale) = column(name, columns).map_err(wrong)?;
        if seen.contains(&key) {
            let found = format!("column \"{key}\" a second time");
            return Err(wrong(Complaint::new("header", found, "it once")));
        }
        seen.push(key);
        Ok((key, scale))
    }))
}

/// What is wrong with a header that is not one of comma-separated names.
fn not_by_commas(names: &csv::StringRecord) -> Option<Complaint> {
    let wrong = |found: &str, hint: &str| {
        Some(Complaint::new("header", found, "names with commas between them").hinted(hint))
    };
    let hint = "save it as CSV with commas between the cells and points in the numbers";
    match names.get(0)? {
        cell if cell.contains('\n') => {
            wrong("a name of several lines", "a closing quote is missing")
        }
        cell if names.len() == 1 && cell.contains(';') => {
            wrong("semicolons between the names", hint)
        }
        cell if names.len() == 1 && cell.contains('\t') => wrong("tabs between the names", hint),
        _ => None,
    }
}

/// Adds the cells of the row at `at` to the columns.
fn read_row(
    document: &Document,
    at: usize,
    record: &csv::StringRecord,
    scales: &[(&'static str, f64)],
    columns: &mut [(&'static str, Vec<f64>)],
) -> Result<()> {
    if record.len() != scales.len() {
        let cells = if record.len() == 1 { "cell" } else { "cells" };
        let found = format!("{} {cells} in this row", record.len());
        let complaint = Complaint::new("", found, format!("{}, as in the header", scales.len()));
        return Err(document.error(line(&document.text, at), complaint));
    }
    let mut mistakes = Mistakes::default();
    for (k, ((written, (key, scale)), (_, values))) in
        record.iter().zip(scales).zip(columns).enumerate()
    {
        match written.parse::<f64>() {
            Ok(v) if (v * scale).is_finite() => values.push(v * scale),
            _ => {
                let expected = "a finite number (the unit stands in the header)";
                let complaint = Complaint::new(*key, format!("{written:?}"), expected);
                mistakes.add(document.error(cell(&document.text, at, k), complaint));
            }
        }
    }
    mistakes.end(())
}

/// Key and factor to SI of a header cell such as `diameter_in`.
fn column(
    name: &str,
    columns: &[(&'static str, Quantity, f64)],
) -> std::result::Result<(&'static str, f64), Complaint> {
    // Longer keys first, so that none is taken for the beginning of another.
    let known = columns.iter().filter(|(key, ..)| {
        name.strip_prefix(*key).is_some_and(|rest| rest.is_empty() || rest.starts_with('_'))
    });
    let Some(&(key, quantity, unit)) = known.max_by_key(|(key, ..)| key.len()) else {
        let keys: Vec<&str> = columns.iter().map(|(key, ..)| *key).collect();
        let stem = name.rsplit_once('_').map_or(name, |(stem, _)| stem);
        let example = if keys.contains(&"x") { "x_in" } else { "t_ms" };
        let expected = format!("{} with a unit, as in {example}", keys.join(", "));
        let complaint = Complaint::new("header", format!("column \"{name}\""), expected);
        return Err(complaint.or_nearest(stem, &keys));
    };
    match name[key.len()..].strip_prefix('_') {
        // Names of columns are often in small letters throughout.
        Some("n") if quantity == Quantity::Force => Ok((key, 1.0)),
        Some("kn") if quantity == Quantity::Force => Ok((key, 1e3)),
        Some(unit) => units::factor(unit, quantity)
            .map(|scale| (key, scale))
            .map_err(|complaint| Complaint { field: "header".into(), ..complaint }),
        None => Ok((key, unit)),
    }
}
