//! Measured modes from a CSV file.
//!
//! A table of shapes, as one types it into a spreadsheet: places from the knob end downwards, modes
//! side by side, the frequency (and the damping) in lines of their own.
//!
//! ```text
//! x_in,          mode_1, mode_2
//! frequency_hz,  178.2,  583.0
//! damping_ratio, 0.004,  0.005
//! 0,             1.00,   0.90
//! 3,             0.55,   0.12
//! …
//! ```
//!
//! Or frequencies alone: columns `mode`, `frequency_hz` and `damping_ratio` or `damping_percent`. Lines
//! that begin with `#` are comments.

use std::path::Path;

use faer::c64;

use crate::csv_file::row_start;
use crate::document::Document;
use crate::error::{Complaint, Error, Result};
use crate::measured::data::{Measured, MeasuredMode};
use crate::units::{self, Quantity};

/// Reads measured modes from CSV.
///
/// # Errors
///
/// [`Error::Read`], and [`Error::Input`] with the line and the column.
pub fn read(path: &Path) -> Result<Measured> {
    let document = Document::read(path)?;
    let table = Table::new(&document)?;
    let measured = match table.header.cells[0].starts_with("x_") || table.header.cells[0] == "x" {
        true => table.shapes()?,
        false => table.frequencies()?,
    };
    let measured = Measured { source: path.display().to_string(), ..measured };
    Ok(measured.sorted())
}

/// Cells and where each row begins.
struct Table<'a> {
    document: &'a Document,
    header: Row,
    rows: Vec<Row>,
}

struct Row {
    offset: usize,
    cells: Vec<String>,
}

/// Fewer points tell no shape from another.
const FEWEST: usize = 3;
/// Hz
const HIGHEST: f64 = 1e6;

impl<'a> Table<'a> {
    fn new(document: &'a Document) -> Result<Self> {
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
            // Spreadsheets leave lines of nothing but commas.
            if cells.iter().any(|cell| !cell.is_empty()) {
                rows.push(Row { offset, cells });
            }
        }
        let expected = "a header such as x_in,mode_1,mode_2 or mode,frequency_hz";
        if rows.is_empty() {
            return Err(document.error(0..0, Complaint::new("", "no header", expected)));
        }
        let header = rows.remove(0);
        let table = Self { document, header, rows };
        if table.header.cells.len() == 1 && table.header.cells[0].contains([';', '\t']) {
            return Err(table.wrong(&table.header, 0, "header", "semicolons or tabs", "commas"));
        }
        let width = table.header.cells.len();
        if let Some(row) = table.rows.iter().find(|row| row.cells.len() != width) {
            let found = format!("{} cells in this row", row.cells.len());
            return Err(table.wrong(row, 0, "", &found, format!("{width}, as in the header")));
        }
        Ok(table)
    }

    /// An error about a cell.
    fn wrong(
        &self,
        row: &Row,
        cell: usize,
        field: &str,
        found: &str,
        expected: impl Into<String>,
    ) -> Error {
        let at = crate::csv_file::cell(&self.document.text, row.offset, cell);
        self.document.error(at, Complaint::new(field, found, expected))
    }

    /// The number in a cell, if it is in that range.
    fn number(&self, row: &Row, cell: usize, field: &str, range: [f64; 2]) -> Result<f64> {
        let text = &row.cells[cell];
        match text.parse::<f64>() {
            Ok(value) if value >= range[0] && value <= range[1] => Ok(value),
            Ok(value) if value.is_finite() => {
                let expected = format!("{:?} to {:?}", range[0], range[1]);
                Err(self.wrong(row, cell, field, text, expected))
            }
            _ => Err(self.wrong(row, cell, field, &format!("\"{text}\""), "a finite number")),
        }
    }

    /// The factor to SI of a name such as `x_in`, its beginning being `stem`.
    fn factor(&self, row: &Row, cell: usize, stem: &str, quantity: Quantity) -> Result<f64> {
        let name = &row.cells[cell];
        let Some(unit) = name.strip_prefix(stem).and_then(|rest| rest.strip_prefix('_')) else {
            let example = if quantity == Quantity::Length { "x_in or x_m" } else { "frequency_hz" };
            return Err(self.wrong(
                row,
                cell,
                "",
                &format!("\"{name}\""),
                format!("its unit too, as in {example}"),
            ));
        };
        // Names of columns are often in small letters throughout.
        let unit = match unit {
            "hz" => "Hz",
            "khz" => "kHz",
            unit => unit,
        };
        units::factor(unit, quantity)
            .map_err(|complaint| self.wrong(row, cell, name, &complaint.found, complaint.expected))
    }

    /// Shapes: points downwards, modes side by side.
    fn shapes(&self) -> Result<Measured> {
        let to_metres = self.factor(&self.header, 0, "x", Quantity::Length)?;
        let names = &self.header.cells[1..];
        if names.is_empty() {
            return Err(self.wrong(&self.header, 0, "header", "no mode", "a column for each mode"));
        }
        let mut modes: Vec<MeasuredMode> = names.iter().map(|name| unknown(name)).collect();
        if let Some(k) =
            (0..names.len()).find(|k| names[*k].is_empty() || names[..*k].contains(&names[*k]))
        {
            let found = format!("\"{}\"", names[k]);
            return Err(self.wrong(
                &self.header,
                k + 1,
                "header",
                &found,
                "a name of its own for each mode",
            ));
        }
        let (mut along, mut points): (Vec<f64>, Vec<&Row>) = (vec![], vec![]);
        let mut told: Vec<&str> = vec![];
        for row in &self.rows {
            let what = row.cells[0].split('_').next().unwrap_or_default();
            if let Some(known) = ["frequency", "damping"].into_iter().find(|known| *known == what) {
                if told.contains(&known) {
                    return Err(self.wrong(
                        row,
                        0,
                        "",
                        &format!("{known} a second time"),
                        "it once",
                    ));
                }
                told.push(known);
                self.tell(row, &mut modes)?;
                continue;
            }
            if row.cells[0].parse::<f64>().is_err() {
                let found = format!("\"{}\"", row.cells[0]);
                let expected = "a place, or frequency_hz, damping_ratio or damping_percent";
                return Err(self.wrong(row, 0, &self.header.cells[0], &found, expected));
            }
            let x = to_metres * self.number(row, 0, &self.header.cells[0], [-1e6, 1e6])?;
            if along.contains(&x) {
                let found = format!("{} a second time", row.cells[0]);
                return Err(self.wrong(row, 0, &self.header.cells[0], &found, "every place once"));
            }
            for (k, mode) in modes.iter_mut().enumerate() {
                let value = self.number(row, k + 1, &mode.name, [-1e100, 1e100])?;
                mode.shape.push(c64::new(value, 0.0));
            }
            along.push(x);
            points.push(row);
        }
        if !told.contains(&"frequency") {
            let expected = "a row with frequency_hz in its first cell";
            return Err(self.wrong(&self.header, 0, "", "no frequencies", expected));
        }
        if along.len() < FEWEST {
            let found = format!("{} places", along.len());
            let row = points.last().copied().unwrap_or(&self.header);
            let expected =
                format!("{FEWEST} at least; with fewer every shape looks like any other");
            return Err(self.wrong(row, 0, &self.header.cells[0], &found, expected));
        }
        if let Some(k) = modes.iter().position(|mode| mode.shape.iter().all(|v| v.re == 0.0)) {
            let expected = "a shape that moves somewhere";
            return Err(self.wrong(points[0], k + 1, &modes[k].name, "nothing but 0", expected));
        }
        Ok(Measured { modes, along, from_knob: true, ..Measured::default() })
    }

    /// A row of frequencies or of dampings.
    fn tell(&self, row: &Row, modes: &mut [MeasuredMode]) -> Result<()> {
        let name = &row.cells[0];
        let percent = name == "damping_percent";
        if !name.starts_with("frequency") && !percent && name != "damping_ratio" {
            let found = format!("\"{name}\"");
            return Err(self.wrong(row, 0, "", &found, "damping_ratio or damping_percent"));
        }
        for (k, mode) in modes.iter_mut().enumerate() {
            match name.starts_with("frequency") {
                true => mode.frequency = self.frequency(row, k + 1, row, 0)?,
                false => mode.damping_ratio = self.damping(row, k + 1, &mode.name, percent)?,
            }
        }
        Ok(())
    }

    /// The frequency in a cell (Hz), its unit in another.
    fn frequency(&self, row: &Row, cell: usize, named: &Row, name: usize) -> Result<f64> {
        let factor = self.factor(named, name, "frequency", Quantity::Frequency)?;
        let field = &named.cells[name];
        Ok(factor * self.number(row, cell, field, [0.0, HIGHEST / factor])?)
    }

    /// A damping ratio; a cell may be left empty.
    fn damping(&self, row: &Row, cell: usize, name: &str, percent: bool) -> Result<Option<f64>> {
        let most = if percent { 100.0 } else { 1.0 };
        if row.cells[cell].is_empty() {
            return Ok(None);
        }
        Ok(Some(self.number(row, cell, name, [0.0, most])? / most))
    }

    /// Frequencies alone: modes downwards.
    fn frequencies(&self) -> Result<Measured> {
        let names = &self.header.cells;
        let known = |name: &String| {
            name == "mode"
                || name.starts_with("frequency_")
                || name == "damping_ratio"
                || name == "damping_percent"
        };
        if let Some(k) = names.iter().position(|name| !known(name)) {
            let found = format!("column \"{}\"", names[k]);
            let expected = "x_in and modes for shapes, or mode, frequency_hz, damping_ratio";
            return Err(self.wrong(&self.header, k, "header", &found, expected));
        }
        if let Some(k) = (1..names.len()).find(|k| names[..*k].contains(&names[*k])) {
            let found = format!("column \"{}\" a second time", names[k]);
            return Err(self.wrong(&self.header, k, "header", &found, "it once"));
        }
        let column = |stem: &str| names.iter().position(|name| name.starts_with(stem));
        let Some(at) = column("frequency_") else {
            return Err(self.wrong(&self.header, 0, "header", "no frequency_hz", "it as a column"));
        };
        let mut modes: Vec<MeasuredMode> = vec![];
        for (k, row) in self.rows.iter().enumerate() {
            let order = match column("mode") {
                Some(cell) => self.order(row, cell, &modes)?,
                None => k + 1,
            };
            let damping_ratio = match column("damping_") {
                Some(cell) => {
                    self.damping(row, cell, &names[cell], names[cell] == "damping_percent")?
                }
                None => None,
            };
            modes.push(MeasuredMode {
                order: Some(order),
                frequency: self.frequency(row, at, &self.header, at)?,
                damping_ratio,
                ..unknown(&order.to_string())
            });
        }
        if modes.is_empty() {
            return Err(self.wrong(&self.header, 0, "", "no mode", "a row for each mode"));
        }
        let mut assumed = vec![];
        if column("mode").is_none() {
            assumed.push("the frequencies are those of modes 1, 2, … as they stand".to_owned());
        }
        Ok(Measured { modes, assumed, ..Measured::default() })
    }

    /// The number of a mode, each once.
    fn order(&self, row: &Row, cell: usize, before: &[MeasuredMode]) -> Result<usize> {
        let text = &row.cells[cell];
        match text.parse::<usize>() {
            Ok(order) if (1..=1000).contains(&order) => {
                match before.iter().any(|mode| mode.order == Some(order)) {
                    true => Err(self.wrong(
                        row,
                        cell,
                        "mode",
                        &format!("{order} a second time"),
                        "it once",
                    )),
                    false => Ok(order),
                }
            }
            _ => Err(self.wrong(
                row,
                cell,
                "mode",
                &format!("\"{text}\""),
                "the number of a bending mode, 1 for the lowest",
            )),
        }
    }
}

/// A mode of which nothing is known but the name.
fn unknown(name: &str) -> MeasuredMode {
    MeasuredMode {
        name: name.to_owned(),
        order: None,
        frequency: 0.0,
        damping_ratio: None,
        shape: vec![],
    }
}
