//! Columns of numbers from a CSV file, each row with its place.

use std::ops::Range;

use crate::base::{Complaint, Error, Mistakes, Quantity, Result, mistakes};
use crate::files::document::Document;
use crate::files::sheet::{self, Sheet, SheetRow};

/// A table of numbers: the columns of a CSV file in SI, with the place of each row.
///
/// The header names the columns and gives their units (`x_in,diameter_in`); [`Sheet`] describes the notations of a
/// table.
pub(crate) struct Csv {
    columns: Vec<(&'static str, Vec<f64>)>,
    /// The unit of each column as the header writes it; empty for a column without a unit.
    units: Vec<String>,
    /// Place of the header, and of each cell, row by row.
    header: Range<usize>,
    cells: Vec<Range<usize>>,
}

impl Csv {
    /// Reads columns whose names are among `keys`; a column without a unit is multiplied by `unit`.
    pub fn read(
        document: &Document,
        keys: &[&'static str],
        quantity: Quantity,
        unit: f64,
    ) -> Result<Self> {
        let columns: Vec<_> = keys.iter().map(|key| (*key, quantity, unit)).collect();
        Self::read_columns(document, &columns)
    }

    /// Reads columns of several quantities, each with its name, its quantity, and the unit that applies if the header
    /// gives none.
    pub fn read_columns(
        document: &Document,
        columns: &[(&'static str, Quantity, f64)],
    ) -> Result<Self> {
        let keys: Vec<&'static str> = columns.iter().map(|(key, ..)| *key).collect();
        let names = format!("a header of {} and their units", keys.join(", "));
        let known = |names: &[String]| {
            let one = |name: &String| keys.iter().any(|key| names_it(name, key));
            names.iter().filter(|name| one(name)).count() > names.len() / 2
        };
        let sheet = Sheet::new(document, &names, known)?;
        let scales = scales(&sheet, columns)?;
        let mut filled: Vec<_> = scales.iter().map(|(key, ..)| (*key, Vec::new())).collect();
        let mut cells = Vec::with_capacity(sheet.rows.len() * scales.len());
        mistakes::all(sheet.rows.iter().map(|row| {
            cells.extend(row.cells.iter().map(|cell| sheet.place(cell)));
            read_row(&sheet, row, &scales, &mut filled)
        }))?;
        let units = scales.into_iter().map(|(.., unit)| unit).collect();
        Ok(Self { columns: filled, units, header: sheet.header_line(), cells })
    }

    /// An error about a value in a row of a column, or about the header.
    pub fn error(
        &self,
        document: &Document,
        key: &str,
        row: Option<usize>,
        complaint: Complaint,
    ) -> Error {
        match row {
            Some(row) => document.error(self.cell(key, row).0, complaint),
            None => document.error(self.header.clone(), complaint),
        }
    }

    /// Place of a cell in the text, and its unit.
    pub fn cell(&self, key: &str, row: usize) -> (Range<usize>, &str) {
        let column = self.columns.iter().position(|(name, _)| *name == key).unwrap_or(0);
        let cell = self.cells.get(row * self.columns.len() + column);
        (cell.unwrap_or(&self.header).clone(), &self.units[column])
    }

    pub fn column(&self, key: &str) -> Option<&[f64]> {
        self.columns.iter().find(|(name, _)| *name == key).map(|(_, values)| values.as_slice())
    }
}

/// Key, factor to SI and unit of a column.
type ColumnScale = (&'static str, f64, String);

/// Key, factor to SI and unit of every column.
fn scales(sheet: &Sheet, columns: &[(&'static str, Quantity, f64)]) -> Result<Vec<ColumnScale>> {
    /// Number of columns that are checked. There are fewer keys, so a longer header has a mistake among the first ones.
    const LOOKED_AT: usize = 100;
    let mut seen = Vec::new();
    mistakes::all(sheet.header.cells.iter().enumerate().take(LOOKED_AT).map(|(k, name)| {
        let wrong = |complaint| sheet.error((&sheet.header, k), complaint);
        let found = column(name, columns).map_err(wrong)?;
        if seen.contains(&found.0) {
            let found = format!("column \"{}\" a second time", found.0);
            return Err(wrong(Complaint::new("header", found, "it once")));
        }
        seen.push(found.0);
        Ok(found)
    }))
}

/// Adds the cells of a row to the columns.
fn read_row(
    sheet: &Sheet,
    row: &SheetRow,
    scales: &[ColumnScale],
    columns: &mut [(&'static str, Vec<f64>)],
) -> Result<()> {
    let mut mistakes = Mistakes::default();
    for (k, ((written, (key, scale, _)), (_, values))) in
        row.cells.iter().zip(scales).zip(columns).enumerate()
    {
        let value = sheet.value(written).and_then(|value| match value * scale {
            value if value.is_finite() => Ok(value),
            _ => Err(Complaint::new("", format!("\"{written}\""), "a finite number")),
        });
        match value {
            Ok(value) => values.push(value),
            Err(complaint) => {
                let complaint = Complaint { field: (*key).into(), ..complaint };
                mistakes.add(sheet.error((row, k), complaint));
            }
        }
    }
    mistakes.end(())
}

/// Whether a name is that of a column, with or without its unit.
fn names_it(name: &str, key: &str) -> bool {
    name.strip_prefix(key).is_some_and(|rest| rest.is_empty() || rest.starts_with('_'))
}

/// Key, factor to SI and unit of a header cell such as `diameter_in` or `Diameter [in]`.
fn column(
    written: &str,
    columns: &[(&'static str, Quantity, f64)],
) -> std::result::Result<ColumnScale, Complaint> {
    let name = sheet::normal(written);
    // Longer keys first, so that a shorter one is not found in them.
    let known = columns.iter().filter(|(key, ..)| names_it(&name, key));
    let Some(&(key, quantity, bare)) = known.max_by_key(|(key, ..)| key.len()) else {
        let keys: Vec<&str> = columns.iter().map(|(key, ..)| *key).collect();
        let stem = name.rsplit_once('_').map_or(&*name, |(stem, _)| stem);
        let example = if keys.contains(&"x") { "x_in" } else { "t_ms" };
        let expected = format!("{} with a unit, as in {example}", keys.join(", "));
        let complaint = Complaint::new("header", format!("column \"{written}\""), expected);
        return Err(complaint.or_nearest(stem, &keys));
    };
    match name[key.len()..].strip_prefix('_') {
        Some(unit) => sheet::factor(unit, quantity)
            .map(|scale| (key, scale, unit.to_owned()))
            .map_err(|complaint| Complaint { field: "header".into(), ..complaint }),
        None => Ok((key, bare, String::new())),
    }
}
