//! Columns of stations as a user wrote them, in a bat file or a CSV file, each value with its place.

use crate::base::{Complaint, Error, Mistakes, Quantity, Result, mistakes, typed};
use crate::bat::{Interpolation, Stations};
use crate::files::csv_file::Csv;
use crate::files::document::Document;
use crate::files::json_node::{Node, Object};

/// The possible columns of a profile.
pub(crate) const COLUMNS: [&str; 6] =
    ["x", "radius", "diameter", "inner_radius", "inner_diameter", "wall_thickness"];
const OUTER: [&str; 2] = [COLUMNS[1], COLUMNS[2]];
const INNER: [&str; 3] = [COLUMNS[3], COLUMNS[4], COLUMNS[5]];

/// One column: its key and its values in metres.
struct StationColumn {
    key: &'static str,
    values: Vec<f64>,
}

/// The columns of a profile and the place of each value.
pub(crate) struct StationTable<'a> {
    x: StationColumn,
    outer: StationColumn,
    inner: Option<StationColumn>,
    places: ValuePlaces<'a>,
}

/// The places of the values: members of a JSON object, or cells of a CSV file.
enum ValuePlaces<'a> {
    Json(Object<'a>),
    Csv { document: Document, csv: Csv },
}

impl<'a> StationTable<'a> {
    /// The columns of a `profile` object; bare numbers are in the unit with that name and factor to m.
    pub fn from_json(object: Object<'a>, unit: (&str, f64)) -> Result<Self> {
        let column = |key: &'static str, node: &Node| -> Result<StationColumn> {
            Ok(StationColumn { key, values: node.quantities(Quantity::Length, unit)? })
        };
        let mut mistakes = Mistakes::default();
        let x = object.require("x", "\"x\": the positions of the stations");
        let x = mistakes.some(x.and_then(|node| column("x", node)));
        let outer = object.one_of(&OUTER).and_then(|found| {
            let missing = || object.node.error("no \"radius\" and no \"diameter\"", "one of them");
            let (key, node) = found.ok_or_else(missing)?;
            column(key, node)
        });
        let outer = mistakes.some(outer);
        let inner = object.one_of(&INNER).and_then(|found| {
            let column = found.map(|(key, node)| column(key, node));
            column.transpose()
        });
        let inner = mistakes.note(inner);
        let (Some(x), Some(outer)) = (x, outer) else {
            return Err(mistakes.end(()).expect_err("what is not there was noted"));
        };
        for column in inner.iter().chain([&outer]) {
            if column.values.len() != x.values.len() {
                let node = object.get(column.key).expect("it was read from there");
                let found = format!("{} values", column.values.len());
                mistakes.add(node.error(found, format!("{}, one for each x", x.values.len())));
            }
        }
        mistakes.end(())?;
        Ok(Self { x, outer, inner, places: ValuePlaces::Json(object) })
    }

    /// The columns of a CSV file. Its header gives their names and units (`x_in,diameter_in`); a column without a unit
    /// is multiplied by `unit` (m). Lines that begin with `#` are comments.
    pub fn from_csv(document: Document, unit: f64) -> Result<StationTable<'static>> {
        let csv = Csv::read(&document, &COLUMNS, Quantity::Length, unit)?;
        let header = |found: String, expected: &str| {
            Err(csv.error(&document, "", None, Complaint::new("header", found, expected)))
        };
        for role in [&OUTER[..], &INNER[..]] {
            let there: Vec<&str> =
                role.iter().filter(|key| csv.column(key).is_some()).copied().collect();
            if let [first, second, ..] = there[..] {
                return header(format!("columns \"{first}\" and \"{second}\""), "one of them");
            }
        }
        let take = |keys: &[&'static str]| {
            let key = keys.iter().find(|key| csv.column(key).is_some())?;
            Some(StationColumn { key, values: csv.column(key)?.to_vec() })
        };
        let (Some(x), Some(outer)) = (take(&["x"]), take(&OUTER)) else {
            return header(
                "a column missing".into(),
                "x and radius or diameter, as in x_in,diameter_in",
            );
        };
        let inner = take(&INNER);
        Ok(StationTable { x, outer, inner, places: ValuePlaces::Csv { document, csv } })
    }

    /// Every column by its key (m).
    pub fn columns(&self) -> impl Iterator<Item = (&'static str, &[f64])> {
        let all = [&self.x, &self.outer].into_iter().chain(&self.inner);
        all.map(|column| (column.key, &column.values[..]))
    }

    /// Radii from the columns that the table has.
    pub fn stations(&self, interpolation: Interpolation) -> Result<Stations> {
        let half = |column: &StationColumn, key: &str| -> Vec<f64> {
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

    /// Outer radius less the wall; if the wall equals the radius, the bat is solid.
    fn bore(&self, outer: &[f64], wall: &[f64]) -> Result<Vec<f64>> {
        let bore = |(k, (r, t)): (usize, (&f64, &f64))| {
            let inner = r - t;
            if inner.abs() <= 4.0 * f64::EPSILON * r {
                Ok(0.0)
            } else if inner < 0.0 || *t < 0.0 {
                let expected = format!("a wall above 0, at most outer[{k}]");
                Err(self.locate(Error::value(format!("inner[{k}]"), format!("{t} m"), expected)))
            } else {
                Ok(inner)
            }
        };
        mistakes::all(outer.iter().zip(wall).enumerate().map(bore))
    }

    /// Whether the places of the stations are written in inches or feet.
    pub fn in_inches(&self) -> bool {
        let last = self.written("x", self.x.values.len().saturating_sub(1));
        let unit = typed::plain(last.trim_matches('"'));
        let unit = unit.trim_start_matches(|c: char| !c.is_alphabetic());
        ["in", "inch", "inches", "ft", "foot", "feet"].contains(&unit)
    }

    /// Adds to an error about stations its places in the file.
    pub fn locate(&self, error: Error) -> Error {
        error.placed(|complaint| self.placed(complaint))
    }

    /// A complaint about station `k` of `x`, `outer` or `inner` with its place in the file, and with the file's own
    /// names, values and units.
    fn placed(&self, mut complaint: Complaint) -> Error {
        let (role, index) = complaint.field.split_once('[').unwrap_or((&complaint.field, ""));
        let index: Option<usize> = index.trim_end_matches(']').parse().ok();
        let column = self.column(role);
        let written = index.map(|k| self.written(column.key, k));
        if let Some(written) = written {
            // A value is quoted as written; anything else is reported about that value.
            let value =
                complaint.found.strip_suffix(" m").is_some_and(|v| v.parse::<f64>().is_ok());
            complaint.found = if value {
                written
            } else {
                format!("{written}: {}", self.told(&complaint.found, column))
            };
        }
        complaint.expected = self.told(&complaint.expected, column);
        match &self.places {
            ValuePlaces::Json(object) => {
                let list = object.get(column.key).unwrap_or(&object.node);
                let node = index.map_or_else(|| list.clone(), |k| list.item(k));
                complaint.field.clear();
                node.complain(complaint)
            }
            ValuePlaces::Csv { document, csv } => {
                complaint.field = column.key.to_owned();
                csv.error(document, column.key, index, complaint)
            }
        }
    }

    fn column(&self, role: &str) -> &StationColumn {
        match (role, &self.inner) {
            ("outer", _) => &self.outer,
            ("inner", Some(inner)) => inner,
            _ => &self.x,
        }
    }

    /// The text in the file for station `k`, with its unit.
    fn written(&self, key: &str, k: usize) -> String {
        match &self.places {
            ValuePlaces::Json(object) => {
                let Some(list) = object.get(key) else { return String::new() };
                let shown = list.item(k).shown();
                let unit = object.string("unit").ok().flatten().unwrap_or_else(|| "m".to_owned());
                if shown.starts_with('"') { shown } else { format!("{shown} {unit}") }
            }
            ValuePlaces::Csv { document, csv } => {
                let (at, unit) = csv.cell(key, k);
                format!("{} {unit}", &document.text[at]).trim_end().to_owned()
            }
        }
    }

    /// The words of `Profile::new` about `x[k]`, `outer[k]`, `inner[k]`, with the names and values of the file:
    /// `half of diameter[2] (2.5 in)` where a radius is compared with it.
    fn told(&self, said: &str, of: &StationColumn) -> String {
        let (mut told, mut rest) = (String::new(), said);
        let next = |rest: &str| {
            let roles = ["x[", "outer[", "inner["].into_iter();
            let found = roles.filter_map(|role| Some((rest.find(role)?, role))).min()?;
            let after = found.0 + found.1.len();
            let end = after + rest[after..].find(']')?;
            Some((found.0, found.1.trim_end_matches('['), rest[after..end].parse().ok()?, end + 1))
        };
        while let Some((start, role, k, end)) = next(rest) {
            let column = self.column(role);
            told += &rest[..start];
            told += match (column.key.contains("diameter"), of.key.contains("diameter")) {
                (true, false) if role != "x" => "half of ",
                (false, true) if role != "x" => "twice ",
                _ => "",
            };
            told += &format!("{}[{k}] ({})", column.key, self.written(column.key, k));
            rest = &rest[end..];
        }
        told + rest
    }
}
