//! Measured modes from a CSV file.
//!
//! A table of shapes, as one types it into a spreadsheet: places from the knob end downwards, modes side by side, and
//! separate lines for the frequency and the damping.
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
//! Or frequencies alone: columns `mode`, `frequency_hz` and `damping_ratio` or `damping_percent`. A
//! `Sheet` says in which ways a table may be written.

use std::path::Path;

use faer::c64;

use crate::engine::{Document, Quantity, Result, Sheet, SheetRow};
use crate::files::measured::FEWEST;
use crate::measured::data::{Measured, MeasuredMode};
use sweetspot::files::sheet::normal;

/// Reads measured modes from CSV.
///
/// # Errors
///
/// [`sweetspot::base::error::Error::Read`], and [`sweetspot::base::error::Error::Input`] with the line and the column.
pub fn read(path: &Path) -> Result<Measured> {
    let document = Document::table(path)?;
    let names = "a header such as x_in,mode_1,mode_2 or mode,frequency_hz";
    let of_shapes = |first: &str| first.starts_with("x_") || first == "x";
    let known = |names: &[String]| {
        let frequency = |name: &String| name.starts_with("frequency");
        names.first().is_some_and(|first| of_shapes(first)) || names.iter().any(frequency)
    };
    let table = Sheet::new(&document, names, known)?;
    let measured = match of_shapes(&normal(table.header.cells[0])) {
        true => shapes(&table)?,
        false => frequencies(&table)?,
    };
    let measured = Measured { source: path.display().to_string(), ..measured };
    Ok(measured.sorted())
}

/// Highest frequency that a table may have (Hz).
const HIGHEST: f64 = 1e6;
/// Range of a number without a physical meaning.
const ANY: [f64; 2] = [-1e100, 1e100];

/// Shapes: points downwards, modes side by side.
fn shapes(table: &Sheet) -> Result<Measured> {
    let to_metres = table.factor((&table.header, 0), "x", Quantity::Length)?;
    let mut modes = named(table)?;
    let [told, points] = apart(table)?;
    for row in told {
        tell(table, row, &mut modes)?;
    }
    let place = table.header.cells[0];
    let along: Vec<f64> = points
        .iter()
        .map(|row| Ok(to_metres * table.number((row, 0), place, [-1e6, 1e6])?))
        .collect::<Result<_>>()?;
    let mut order: Vec<usize> = (0..along.len()).collect();
    order.sort_by(|a, b| along[*a].total_cmp(&along[*b]));
    if let Some(pair) = order.windows(2).find(|pair| along[pair[0]] == along[pair[1]]) {
        let again = points[pair[0].max(pair[1])];
        let found = format!("{} a second time", again.cells[0]);
        return Err(table.wrong((again, 0), place, &found, "every place once"));
    }
    if along.len() < FEWEST {
        let row = points.last().copied().unwrap_or(&table.header);
        let expected = format!("{FEWEST} at least; with fewer every shape looks like any other");
        return Err(table.wrong((row, 0), place, &format!("{} places", along.len()), expected));
    }
    for (k, mode) in modes.iter_mut().enumerate() {
        for row in &points {
            let value = table.number((row, k + 1), &mode.name, ANY)?;
            mode.shape.push(c64::new(value, 0.0));
        }
        if mode.shape.iter().all(|value| value.re == 0.0) {
            let expected = "a shape that moves somewhere";
            return Err(table.wrong((points[0], k + 1), &mode.name, "nothing but 0", expected));
        }
    }
    Ok(Measured { modes, along, from_knob: true, ..Measured::default() })
}

/// The modes of the header, with their names only.
fn named(table: &Sheet) -> Result<Vec<MeasuredMode>> {
    let names = &table.header.cells[1..];
    if names.is_empty() {
        let expected = "a column for each mode";
        return Err(table.wrong((&table.header, 0), "header", "no mode", expected));
    }
    let bad = |k: &usize| names[*k].is_empty() || names[..*k].contains(&names[*k]);
    if let Some(k) = (0..names.len()).find(bad) {
        let expected = "a name of its own for each mode";
        return Err(table.strange((&table.header, k + 1), "header", expected));
    }
    Ok(names.iter().map(|name| unknown(name)).collect())
}

/// The rows with frequencies and dampings, each once, and those of the points.
fn apart<'a, 'b>(table: &'a Sheet<'b>) -> Result<[Vec<&'a SheetRow<'b>>; 2]> {
    let kind =
        |row: &SheetRow| normal(row.cells[0]).split('_').next().unwrap_or_default().to_owned();
    let (told, points): (Vec<&SheetRow>, Vec<&SheetRow>) =
        table.rows.iter().partition(|row| ["frequency", "damping"].contains(&kind(row).as_str()));
    let again = |k: &usize| told[..*k].iter().any(|row| kind(row) == kind(told[*k]));
    if let Some(k) = (1..told.len()).find(again) {
        let found = format!("{} a second time", kind(told[k]));
        return Err(table.wrong((told[k], 0), "", &found, "it once"));
    }
    if !told.iter().any(|row| kind(row) == "frequency") {
        let expected = "a row with frequency_hz in its first cell";
        return Err(table.wrong((&table.header, 0), "", "no frequencies", expected));
    }
    if let Some(row) = points.iter().find(|row| table.value(row.cells[0]).is_err()) {
        let expected = "a place, or frequency_hz, damping_ratio or damping_percent";
        return Err(table.strange((row, 0), table.header.cells[0], expected));
    }
    Ok([told, points])
}

/// A row of frequencies or of dampings.
fn tell(table: &Sheet, row: &SheetRow, modes: &mut [MeasuredMode]) -> Result<()> {
    let name = &normal(row.cells[0]);
    let frequencies = name.starts_with("frequency");
    if !frequencies && name != "damping_ratio" && name != "damping_percent" {
        return Err(table.strange((row, 0), "", "damping_ratio or damping_percent"));
    }
    for (k, mode) in modes.iter_mut().enumerate() {
        match frequencies {
            true => mode.frequency = frequency(table, (row, k + 1), (row, 0))?,
            false => mode.damping_ratio = damping(table, (row, k + 1), &mode.name, name)?,
        }
    }
    Ok(())
}

/// The frequency in a cell (Hz), its unit in the name in another.
fn frequency(table: &Sheet, cell: (&SheetRow, usize), name: (&SheetRow, usize)) -> Result<f64> {
    let factor = table.factor(name, "frequency", Quantity::Frequency)?;
    let field = name.0.cells[name.1];
    Ok(factor * table.number(cell, field, [0.0, HIGHEST / factor])?)
}

/// A damping ratio, or a percentage, whose cell may contain the sign; it may be left empty.
fn damping(table: &Sheet, at: (&SheetRow, usize), field: &str, name: &str) -> Result<Option<f64>> {
    let cell = at.0.cells[at.1];
    let number = cell.strip_suffix('%').map(str::trim_end);
    let most = if name == "damping_percent" || number.is_some() { 100.0 } else { 1.0 };
    match cell.is_empty() {
        true => Ok(None),
        false => Ok(Some(table.number_of(number.unwrap_or(cell), field, [0.0, most])? / most)),
    }
}

/// Frequencies alone: modes downwards.
fn frequencies(table: &Sheet) -> Result<Measured> {
    let written = &table.header.cells;
    let names: Vec<String> = written.iter().map(|name| normal(name)).collect();
    let known = |name: &str| {
        ["mode", "damping_ratio", "damping_percent"].contains(&name)
            || name.starts_with("frequency_")
    };
    if let Some(k) = names.iter().position(|name| !known(name)) {
        let found = format!("column \"{}\"", written[k]);
        let expected = match names[k].as_str() {
            "frequency" => "its unit too, as in frequency_hz or Frequency (Hz)",
            "damping" => "its unit too: damping_ratio, damping_percent or Damping (%)",
            _ => "x_in and modes for shapes, or mode, frequency_hz, damping_ratio",
        };
        return Err(table.wrong((&table.header, k), "header", &found, expected));
    }
    let stem = |name: &str| name.split('_').next().unwrap_or_default().to_owned();
    let again = |k: &usize| names[..*k].iter().any(|name| stem(name) == stem(&names[*k]));
    if let Some(k) = (1..names.len()).find(again) {
        let found = format!("column \"{}\" beside another", written[k]);
        return Err(table.wrong((&table.header, k), "header", &found, "one of a kind"));
    }
    let column = |kind: &str| names.iter().position(|name| stem(name) == kind);
    let Some(at) = column("frequency") else {
        let expected = "it as a column";
        return Err(table.wrong((&table.header, 0), "header", "no frequency_hz", expected));
    };
    let mut modes: Vec<MeasuredMode> = vec![];
    for (k, row) in table.rows.iter().enumerate() {
        let order = match column("mode") {
            Some(cell) => order(table, (row, cell), &modes)?,
            None => k + 1,
        };
        let damping_ratio = match column("damping") {
            Some(cell) => damping(table, (row, cell), written[cell], &names[cell])?,
            None => None,
        };
        let frequency = frequency(table, (row, at), (&table.header, at))?;
        let mode = unknown(&order.to_string());
        modes.push(MeasuredMode { order: Some(order), frequency, damping_ratio, ..mode });
    }
    if modes.is_empty() {
        return Err(table.wrong((&table.header, 0), "", "no mode", "a row for each mode"));
    }
    let as_they_stand = "the frequencies are those of modes 1, 2, … as they stand".to_owned();
    let assumed = if column("mode").is_none() { vec![as_they_stand] } else { vec![] };
    Ok(Measured { modes, assumed, ..Measured::default() })
}

/// The number of a mode, each once.
fn order(table: &Sheet, at: (&SheetRow, usize), before: &[MeasuredMode]) -> Result<usize> {
    let whole = |value: f64| if value.fract() == 0.0 { value as usize } else { 0 };
    match table.value(at.0.cells[at.1]).map(whole) {
        Ok(order) if before.iter().any(|mode| mode.order == Some(order)) => {
            Err(table.wrong(at, "mode", &format!("{order} a second time"), "it once"))
        }
        Ok(order) if (1..=MOST).contains(&order) => Ok(order),
        _ => Err(table.strange(at, "mode", format!("the number of a bending mode, 1 to {MOST}"))),
    }
}

/// The highest number of a mode.
const MOST: usize = 100;

/// A mode with only a name.
fn unknown(name: &str) -> MeasuredMode {
    MeasuredMode {
        name: name.to_owned(),
        order: None,
        frequency: 0.0,
        damping_ratio: None,
        shape: vec![],
    }
}
