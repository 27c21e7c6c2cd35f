//! Columns of stations as a user wrote them, in a bat file or a CSV file, each value with its place.

use std::path::Path;

use crate::document::{Document, Node, Object};
use crate::error::{Complaint, Error, Result, nearest};
use crate::profile::{Interpolation, Stations};
use crate::units::{self, Quantity};

const OUTER: [&str; 2] = ["radius", "diameter"];
const INNER: [&str; 3] = ["inner_radius", "inner_diameter", "wall_thickness"];

/// One column: its key and its values in metres.
struct Column {
    key: &'static str,
    values: Vec<f64>,
}

/// The columns of a profile and where each value stands.
pub(crate) struct Table<'a> {
    x: Column,
    outer: Column,
    inner: Option<Column>,
    places: Places<'a>,
}

/// Where the values stand: members of a JSON object, or cells of a CSV file.
enum Places<'a> {
    Json(Object<'a>),
    Csv(CsvCells),
}

struct CsvCells {
    document: Document,
    /// Column number of each key, and the byte offset of each row.
    columns: Vec<&'static str>,
    rows: Vec<usize>,
}

impl<'a> Table<'a> {
    /// The columns of a `profile` object; bare numbers are times `unit` (m).
    pub fn from_json(object: Object<'a>, unit: f64) -> Result<Self> {
        let column = |key: &'static str, node: &Node| -> Result<Column> {
            Ok(Column { key, values: node.quantities(Quantity::Length, unit)? })
        };
        let x = column("x", object.require("x", "\"x\": the positions of the stations")?)?;
        let outer = match object.one_of(&OUTER)? {
            Some((key, node)) => column(key, node)?,
            None => {
                let missing = object.node.error("no \"radius\" and no \"diameter\"", "one of them");
                return Err(missing);
            }
        };
        let inner = match object.one_of(&INNER)? {
            Some((key, node)) => Some(column(key, node)?),
            None => None,
        };
        for column in inner.iter().chain([&outer]) {
            if column.values.len() != x.values.len() {
                let node = object.get(column.key).expect("it was read from there");
                let found = format!("{} values", column.values.len());
                return Err(node.error(found, format!("{}, one for each x", x.values.len())));
            }
        }
        Ok(Self { x, outer, inner, places: Places::Json(object) })
    }

    /// The columns of a CSV file, named and given their units by its header (`x_in,diameter_in`);
    /// a name without a unit is times `unit` (m). Lines that begin with `#` are comments.
    pub fn from_csv(path: &Path, unit: f64) -> Result<Table<'static>> {
        let document = Document::read(path)?;
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .flexible(true)
            .has_headers(false)
            .from_reader(document.text.as_bytes());
        let mut records = reader.records();
        let broken = |offset: usize, found: String, expected: &str| {
            document.error(offset, Complaint::new("", found, expected))
        };
        let header = match records.next() {
            Some(Ok(header)) => header,
            _ => return Err(broken(0, "no header".into(), "a header such as x_in,diameter_in")),
        };
        let start = header.position().map_or(0, |p| p.byte() as usize);
        let scales = header_columns(&header, unit).map_err(|(found, expected)| {
            document.error(start, Complaint::new("header", found, expected))
        })?;
        let mut values = vec![Vec::new(); scales.len()];
        let mut rows = Vec::new();
        for record in records {
            let record = record.map_err(|e| broken(start, e.to_string(), "rows of numbers"))?;
            let offset = record.position().map_or(0, |p| p.byte() as usize);
            if record.len() != scales.len() {
                let found = format!("{} cells in this row", record.len());
                return Err(broken(offset, found, &format!("{}, as in the header", scales.len())));
            }
            for ((cell, (key, scale)), column) in record.iter().zip(&scales).zip(&mut values) {
                match cell.parse::<f64>() {
                    Ok(v) if (v * scale).is_finite() => column.push(v * scale),
                    _ => {
                        let complaint = Complaint::new(*key, format!("\"{cell}\""), "a number");
                        return Err(document.error(offset, complaint));
                    }
                }
            }
            rows.push(offset);
        }
        let columns: Vec<&'static str> = scales.iter().map(|s| s.0).collect();
        let mut take = |keys: &[&str]| {
            let k = columns.iter().position(|key| keys.contains(key))?;
            Some(Column { key: columns[k], values: std::mem::take(&mut values[k]) })
        };
        let missing = |what: &str| broken(start, format!("no {what} column"), "x and radius or diameter");
        let x = take(&["x"]).ok_or_else(|| missing("x"))?;
        let outer = take(&OUTER).ok_or_else(|| missing("radius or diameter"))?;
        let inner = take(&INNER);
        let places = Places::Csv(CsvCells { document, columns, rows });
        Ok(Table { x, outer, inner, places })
    }

    /// Radii from whatever columns there are.
    pub fn stations(&self, interpolation: Interpolation) -> Result<Stations> {
        let half = |column: &Column, key: &str| -> Vec<f64> {
            let scale = if column.key == key { 0.5 } else { 1.0 };
            column.values.iter().map(|v| v * scale).collect()
        };
        let outer = half(&self.outer, "diameter");
        let inner = match &self.inner {
            None => vec![0.0; outer.len()],
            Some(wall) if wall.key == "wall_thickness" => self.bore(&outer, &wall.values)?,
            Some(column) => half(column, "inner_diameter"),
        };
        Ok(Stations { x: self.x.values.clone(), outer, inner, interpolation })
    }

    /// Outer radius less the wall; a wall as thick as the radius is solid.
    fn bore(&self, outer: &[f64], wall: &[f64]) -> Result<Vec<f64>> {
        let bore = |(k, (r, t)): (usize, (&f64, &f64))| {
            let inner = r - t;
            if inner.abs() <= 4.0 * f64::EPSILON * r {
                Ok(0.0)
            } else if inner < 0.0 || *t < 0.0 {
                let expected = format!("a wall between 0 and the outer radius there, {r} m");
                Err(self.locate(Error::value(format!("inner[{k}]"), format!("{t} m"), expected)))
            } else {
                Ok(inner)
            }
        };
        outer.iter().zip(wall).enumerate().map(bore).collect()
    }

    /// Gives an error about station `k` of `x`, `outer` or `inner` its place in the file.
    pub fn locate(&self, error: Error) -> Error {
        let Error::Value(mut complaint) = error else { return error };
        let (role, index) = complaint.field.split_once('[').unwrap_or((&complaint.field, ""));
        let index: Option<usize> = index.trim_end_matches(']').parse().ok();
        let key = match (role, &self.inner) {
            ("outer", _) => self.outer.key,
            ("inner", Some(column)) => column.key,
            _ => "x",
        };
        match &self.places {
            Places::Json(object) => {
                let column = object.get(key).unwrap_or(&object.node);
                let node = index.map_or_else(|| column.clone(), |k| column.item(k));
                if index.is_some() {
                    complaint.found = format!("{} ({})", node.shown(), complaint.found);
                }
                complaint.field.clear();
                node.complain(complaint)
            }
            Places::Csv(cells) => {
                complaint.field = key.to_owned();
                let row = index.and_then(|k| cells.rows.get(k)).copied().unwrap_or(0);
                debug_assert!(cells.columns.contains(&key));
                cells.document.error(row, complaint)
            }
        }
    }
}

/// Key and factor to metres of each header cell; found and expected where one is wrong.
fn header_columns(
    header: &csv::StringRecord,
    unit: f64,
) -> std::result::Result<Vec<(&'static str, f64)>, (String, String)> {
    let keys: Vec<&'static str> = ["x"].into_iter().chain(OUTER).chain(INNER).collect();
    let expected = || format!("{} and a unit, as in x_in,diameter_in", keys.join(", "));
    let mut columns: Vec<(&'static str, f64)> = Vec::new();
    for cell in header {
        let known = keys.iter().rev().find(|key| {
            cell.strip_prefix(**key).is_some_and(|rest| rest.is_empty() || rest.starts_with('_'))
        });
        let Some(&key) = known else {
            let hint = nearest(cell, &keys).map_or(String::new(), |n| format!(" (did you mean {n}?)"));
            return Err((format!("column \"{cell}\"{hint}"), expected()));
        };
        let same_role = |other: &&'static str| {
            **other == *key
                || [&OUTER[..], &INNER[..]].iter().any(|s| s.contains(other) && s.contains(&key))
        };
        if let Some((other, _)) = columns.iter().find(|(other, _)| same_role(&other)) {
            return Err((format!("columns \"{other}\" and \"{key}\""), "one of them".into()));
        }
        let scale = match cell[key.len()..].strip_prefix('_') {
            Some(name) => units::factor(name, Quantity::Length).map_err(|c| (c.found, c.expected))?,
            None => unit,
        };
        columns.push((key, scale));
    }
    Ok(columns)
}
