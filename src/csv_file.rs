//! Columns of numbers from a CSV file, each row with its place.

use crate::document::Document;
use crate::error::{Complaint, Result, nearest};
use crate::units::{self, Quantity};

/// A table of numbers: the columns of a CSV file in SI, and where each row stands.
///
/// The header names the columns and gives their units (`x_in,diameter_in`); lines that begin
/// with `#` are comments.
pub(crate) struct Csv {
    columns: Vec<(&'static str, Vec<f64>)>,
    /// The unit of each column in the words of the header, empty where there is none.
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
        let wrong = |offset: usize, field: &str, found: String, expected: String| {
            document.error(offset, Complaint::new(field, found, expected))
        };
        let offset = |record: &csv::StringRecord| {
            row_start(&document.text, record.position().map_or(0, |p| p.byte() as usize))
        };
        let mut records = reader.records();
        let Some(Ok(names)) = records.next() else {
            let expected = format!("a header of {} and their units", keys.join(", "));
            return Err(wrong(0, "", "no header".into(), expected));
        };
        let header = offset(&names);
        let mut scales: Vec<(&'static str, f64)> = Vec::new();
        for name in &names {
            let (key, scale) = column(name, &keys, columns)
                .map_err(|complaint| document.error(header, complaint))?;
            if scales.iter().any(|(other, _)| *other == key) {
                let found = format!("column \"{key}\" a second time");
                return Err(wrong(header, "header", found, "it once".into()));
            }
            scales.push((key, scale));
        }
        let mut filled: Vec<_> = scales.iter().map(|(key, _)| (*key, Vec::new())).collect();
        let mut rows = Vec::new();
        for record in records {
            let record =
                record.map_err(|e| wrong(header, "", e.to_string(), "rows of numbers".into()))?;
            let at = offset(&record);
            if record.len() != scales.len() {
                let found = format!("{} cells in this row", record.len());
                return Err(wrong(at, "", found, format!("{}, as in the header", scales.len())));
            }
            let cells = record.iter().zip(&scales).zip(&mut filled).enumerate();
            for (k, ((cell, (key, scale)), (_, values))) in cells {
                match cell.parse::<f64>() {
                    Ok(v) if (v * scale).is_finite() => values.push(v * scale),
                    _ => {
                        let at = cell_start(&document.text, at, k);
                        let expected = "a finite number (the unit stands in the header)";
                        return Err(wrong(at, key, format!("\"{cell}\""), expected.into()));
                    }
                }
            }
            rows.push(at);
        }
        let unit = |(name, (key, _)): (&str, &(&str, f64))| {
            name[key.len()..].trim_start_matches('_').to_owned()
        };
        let units = names.iter().zip(&scales).map(unit).collect();
        Ok(Self { columns: filled, units, header, rows })
    }

    /// Where a cell stands in the text, what is written there, and its unit.
    pub fn cell<'a>(&'a self, text: &'a str, key: &str, row: usize) -> (usize, &'a str, &'a str) {
        let column = self.columns.iter().position(|(name, _)| *name == key).unwrap_or(0);
        let start = cell_start(text, self.rows.get(row).copied().unwrap_or(self.header), column);
        let cell = text[start..].split([',', '\n']).next().unwrap_or_default();
        (start, cell.trim(), &self.units[column])
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

/// Where cell number `column` of the row at `offset` begins.
pub(crate) fn cell_start(text: &str, offset: usize, column: usize) -> usize {
    let cells = text[offset..].split(',').take(column).map(|cell| cell.len() + 1);
    let start = (offset + cells.sum::<usize>()).min(text.len());
    start + text[start..].len() - text[start..].trim_start_matches([' ', '\t']).len()
}

/// Key and factor to SI of a header cell such as `diameter_in`.
fn column(
    name: &str,
    keys: &[&'static str],
    columns: &[(&'static str, Quantity, f64)],
) -> std::result::Result<(&'static str, f64), Complaint> {
    // Longer keys first, so that none is taken for the beginning of another.
    let known = keys.iter().filter(|key| {
        name.strip_prefix(**key).is_some_and(|rest| rest.is_empty() || rest.starts_with('_'))
    });
    let Some(&key) = known.max_by_key(|key| key.len()) else {
        let stem = name.rsplit_once('_').map_or(name, |(stem, _)| stem);
        let hint = nearest(stem, keys).map_or(String::new(), |n| format!(" (did you mean {n}?)"));
        let example = if keys.contains(&"x") { "x_in" } else { "t_ms" };
        let expected = format!("{} with a unit, as in {example}{hint}", keys.join(", "));
        return Err(Complaint::new("header", format!("column \"{name}\""), expected));
    };
    let named = columns.iter().find(|(name, ..)| *name == key);
    let &(_, quantity, unit) = named.expect("it is one of the names");
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
