//! The cells of a CSV file whose rows mean different things, each with its place.

use crate::base::error::{Complaint, Error, Result};
use crate::base::units::{self, Quantity};
use crate::files::csv_file::row_start;
use crate::files::document::Document;

/// Cells and where each row begins.
pub(crate) struct CellTable<'a> {
    document: &'a Document,
    pub header: CellRow,
    /// Rows below the header, each as wide as the header.
    pub rows: Vec<CellRow>,
}

/// One row.
pub(crate) struct CellRow {
    offset: usize,
    pub cells: Vec<String>,
}

impl<'a> CellTable<'a> {
    /// Splits the text into cells; empty rows and comments are skipped.
    pub fn new(document: &'a Document) -> Result<Self> {
        let reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .flexible(true)
            .has_headers(false)
            .from_reader(document.text.as_bytes());
        let mut rows = vec![];
        for record in reader.into_records() {
            let record = record.map_err(|error| {
                document.error(0..0, Complaint::new("", error.to_string(), "rows of cells"))
            })?;
            let byte = record.position().map_or(0, |p| p.byte() as usize);
            let offset = row_start(&document.text, byte);
            let cells: Vec<String> = record.iter().map(str::to_owned).collect();
            // Spreadsheets leave lines that hold only commas.
            if cells.iter().any(|cell| !cell.is_empty()) {
                rows.push(CellRow { offset, cells });
            }
        }
        let expected = "a header such as x_in,mode_1,mode_2 or mode,frequency_hz";
        if rows.is_empty() {
            return Err(document.error(0..0, Complaint::new("", "no header", expected)));
        }
        let header = rows.remove(0);
        let table = Self { document, header, rows };
        if table.header.cells.len() == 1 && table.header.cells[0].contains([';', '\t']) {
            let found = "semicolons or tabs";
            return Err(table.wrong((&table.header, 0), "header", found, "commas"));
        }
        let width = table.header.cells.len();
        if let Some(row) = table.rows.iter().find(|row| row.cells.len() != width) {
            let found = format!("{} cells in this row", row.cells.len());
            return Err(table.wrong((row, 0), "", &found, format!("{width}, as in the header")));
        }
        Ok(table)
    }

    /// An error about a cell.
    pub fn wrong(
        &self,
        (row, cell): (&CellRow, usize),
        field: &str,
        found: &str,
        expected: impl Into<String>,
    ) -> Error {
        let at = crate::files::csv_file::cell(&self.document.text, row.offset, cell);
        self.document.error(at, Complaint::new(field, found, expected))
    }

    /// An error about a cell with its own words in quotes.
    pub fn strange(
        &self,
        (row, cell): (&CellRow, usize),
        field: &str,
        expected: impl Into<String>,
    ) -> Error {
        let found = format!("\"{}\"", row.cells[cell]);
        self.wrong((row, cell), field, &found, expected)
    }

    /// The number in a cell, if it is in that range.
    pub fn number(&self, at: (&CellRow, usize), field: &str, [low, high]: [f64; 2]) -> Result<f64> {
        let text = &at.0.cells[at.1];
        match text.parse::<f64>() {
            Ok(value) if value >= low && value <= high => Ok(value),
            Ok(value) if value.is_finite() => {
                Err(self.wrong(at, field, text, format!("{low:?} to {high:?}")))
            }
            _ => Err(self.strange(at, field, "a finite number")),
        }
    }

    /// The factor to SI of a name such as `x_in`, its beginning being `stem`.
    pub fn factor(&self, at: (&CellRow, usize), stem: &str, quantity: Quantity) -> Result<f64> {
        let name = &at.0.cells[at.1];
        let Some(unit) = name.strip_prefix(stem).and_then(|rest| rest.strip_prefix('_')) else {
            let example = if quantity == Quantity::Length { "x_in or x_m" } else { "frequency_hz" };
            return Err(self.strange(at, "", format!("its unit too, as in {example}")));
        };
        // Names of columns are often in small letters throughout.
        let unit = match unit {
            "hz" => "Hz",
            "khz" => "kHz",
            unit => unit,
        };
        units::factor(unit, quantity)
            .map_err(|complaint| self.wrong(at, name, &complaint.found, complaint.expected))
    }
}
