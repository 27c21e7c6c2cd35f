//! Columns of numbers from a CSV file, each row with its place.

use std::ops::Range;

use crate::base::error::{Complaint, Error, Result};
use crate::base::mistakes::{self, Mistakes};
use crate::base::units::{self, Quantity};
use crate::files::document::Document;
use crate::files::sheet::{Sheet, filled, name};

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
    sheet: Sheet,
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
        let text = &document.text;
        let sheet = Sheet::of(text);
        let mut reader = sheet.reader(text);
        let mut records = reader.records();
        let Some(Ok(names)) = records.next() else {
            let expected = format!("a header of {} and their units", keys.join(", "));
            return Err(document.error(0..0, Complaint::new("", "no header", expected)));
        };
        let header = sheet.offset(text, &names);
        if let Some(complaint) = unclosed(&names) {
            return Err(document.error(line(text, header), complaint));
        }
        let named: Vec<String> = names.iter().take(filled(&names)).map(name).collect();
        let scales = scales((document, &sheet), header, &named, columns)?;
        let mut values: Vec<_> = scales.iter().map(|(key, _)| (*key, Vec::new())).collect();
        let mut rows = Vec::new();
        mistakes::all(records.map(|record| {
            let record = record.map_err(|error| {
                let complaint = Complaint::new("", error, "rows of numbers");
                document.error(line(text, header), complaint)
            })?;
            if filled(&record) == 0 {
                return Ok(());
            }
            let at = sheet.offset(text, &record);
            rows.push(at);
            read_row((document, &sheet), at, &record, &scales, &mut values)
        }))?;
        let unit = |(name, (key, _)): (&String, &(&str, f64))| {
            name[key.len()..].trim_start_matches('_').to_owned()
        };
        let units = named.iter().zip(&scales).map(unit).collect();
        Ok(Self { columns: values, units, header, rows, sheet })
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
        (self.sheet.cell(text, row, column), &self.units[column])
    }

    pub fn column(&self, key: &str) -> Option<&[f64]> {
        self.columns.iter().find(|(name, _)| *name == key).map(|(_, values)| values.as_slice())
    }
}

/// The line that begins at `offset`, without its end.
fn line(text: &str, offset: usize) -> Range<usize> {
    let line = text[offset..].lines().next().unwrap_or_default();
    offset..offset + line.trim_end().len()
}

/// Key and factor to SI of every column.
fn scales(
    (document, sheet): (&Document, &Sheet),
    header: usize,
    names: &[String],
    columns: &[(&'static str, Quantity, f64)],
) -> Result<Vec<(&'static str, f64)>> {
    /// Columns that are checked: a header with more than this has a mistake among the first ones, since
    /// there are fewer keys.
    const LOOKED_AT: usize = 100;
    let mut seen = Vec::new();
    mistakes::all(names.iter().enumerate().take(LOOKED_AT).map(|(k, name)| {
        let wrong = |complaint| document.error(sheet.cell(&document.text, header, k), complaint);
        let (key, scale) = column(name, columns).map_err(wrong)?;
        if seen.contains(&key) {
            let found = format!("column \"{key}\" a second time");
            return Err(wrong(Complaint::new("header", found, "it once")));
        }
        seen.push(key);
        Ok((key, scale))
    }))
}

/// What is wrong with a header of which a closing quote is missing.
fn unclosed(names: &csv::StringRecord) -> Option<Complaint> {
    let complaint = || {
        let expected = "names with commas between them";
        Complaint::new("header", "a name of several lines", expected)
            .hinted("a closing quote is missing")
    };
    names.get(0).filter(|name| name.contains('\n')).map(|_| complaint())
}

/// Adds the cells of the row at `at` to the columns.
fn read_row(
    (document, sheet): (&Document, &Sheet),
    at: usize,
    record: &csv::StringRecord,
    scales: &[(&'static str, f64)],
    columns: &mut [(&'static str, Vec<f64>)],
) -> Result<()> {
    if record.len() < scales.len() || filled(record) > scales.len() {
        let cells = if record.len() == 1 { "cell" } else { "cells" };
        let found = format!("{} {cells} in this row", record.len());
        let complaint = Complaint::new("", found, format!("{}, as in the header", scales.len()));
        return Err(document.error(line(&document.text, at), complaint));
    }
    let mut mistakes = Mistakes::default();
    for (k, ((written, (key, scale)), (_, values))) in
        record.iter().zip(scales).zip(columns).enumerate()
    {
        match sheet.number(written) {
            Ok(v) if (v * scale).is_finite() => values.push(v * scale),
            other => {
                let expected = other.err().unwrap_or_else(|| "a smaller number".to_owned());
                let complaint = Complaint::new(*key, format!("{written:?}"), expected);
                mistakes.add(document.error(sheet.cell(&document.text, at, k), complaint));
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
