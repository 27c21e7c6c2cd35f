//! Modes as VTK files, which ParaView, VTK and meshio read.
//!
//! One `.vtu` file holds the bat and all modes. In ParaView: open it, apply *Warp By Vector* with one of `mode_01`,
//! `mode_02`, … (scale 0.05), and on a line *Extract Surface* and *Tube*, with its radius varied by the absolute scalar
//! `radius_m`. A `.pvd` collection has one such file for each mode, with one array `mode` and the frequency of the mode
//! as the time: open the `.pvd`, warp by `mode`, and step through time.
//!
//! # Source
//!
//! VTK's documentation, XML file formats: `UnstructuredGrid` in ASCII, cell types 3 (line), 5
//! (triangle) and 9 (quad); `TimeValue` in the field data; the `Collection` of ParaView's data
//! files.

use std::fmt::Write;

use crate::exchange::modes_file::{ModeTable, SampledMode};
use crate::exchange::solid::Grid;
use sweetspot::base::xml::escaped;

/// The bat as line cells along its axis, or with `Some(n)` as its outer surface with n points
/// around.
pub fn grid(table: &ModeTable, around: Option<usize>) -> Grid {
    match around {
        None => Grid::line(&table.x),
        Some(around) => Grid::surface(&table.x, &table.radii()[0], around),
    }
}

/// One file with all modes, each an array of vectors `mode_01`, …
pub fn all_modes(table: &ModeTable, grid: &Grid) -> String {
    let modes: Vec<&SampledMode> = table.modes.iter().collect();
    let name = |mode: &SampledMode| format!("mode_{:02}", mode.order);
    file(table, grid, &modes, name, None)
}

/// A file with one mode, its array of vectors called `mode` and its frequency the time.
pub fn one_mode(table: &ModeTable, grid: &Grid, k: usize) -> String {
    let mode = &table.modes[k];
    file(table, grid, &[mode], |_| "mode".into(), Some(mode.frequency))
}

/// Approximate size of such a file in bytes, with that number of modes on a grid of that number of points. Its numbers
/// have up to 17 digits.
pub fn size(points: usize, modes: usize) -> usize {
    const OF_A_POINT: usize = 100;
    const OF_A_VECTOR: usize = 45;
    points * (OF_A_POINT + modes * OF_A_VECTOR)
}

/// The collection of files, each with its time.
pub fn collection(files: &[(f64, String)]) -> String {
    let mut out = String::from("<?xml version=\"1.0\"?>\n");
    out += "<!-- one mode per file, the time is its frequency in Hz -->\n";
    out += "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n";
    out += "  <Collection>\n";
    for (time, file) in files {
        let file = escaped(file);
        let _ = writeln!(
            out,
            "    <DataSet timestep=\"{time:?}\" group=\"\" part=\"0\" file=\"{file}\"/>"
        );
    }
    out + "  </Collection>\n</VTKFile>\n"
}

fn file(
    table: &ModeTable,
    grid: &Grid,
    modes: &[&SampledMode],
    name: impl Fn(&SampledMode) -> String,
    time: Option<f64>,
) -> String {
    let of = |of: fn(&SampledMode) -> f64| modes.iter().map(|mode| of(mode)).collect::<Vec<_>>();
    let scalars = ["radius_m", "inner_radius_m"].into_iter().zip(table.radii());
    let moved = |mode: &&SampledMode| (name(mode), grid.moved(&mode.deflection, &mode.rotation));
    Contents {
        about: "a bat: x along it, deflection along y",
        time,
        fields: vec![
            ("frequency_hz", of(|mode| mode.frequency)),
            ("modal_mass_kg", of(|mode| mode.modal_mass)),
            ("damping_ratio", of(|mode| mode.damping_ratio)),
        ],
        scalars: scalars.collect(),
        vectors: modes.iter().map(moved).collect(),
    }
    .file(grid)
}

/// The content of a file besides the points and cells of its grid.
pub(super) struct Contents {
    /// A comment that describes the content.
    pub about: &'static str,
    /// The time of the file, if it has one.
    pub time: Option<f64>,
    /// Numbers that belong to the whole file.
    pub fields: Vec<(&'static str, Vec<f64>)>,
    /// A number for each place of the grid.
    pub scalars: Vec<(&'static str, Vec<f64>)>,
    /// A vector for each point of the grid.
    pub vectors: Vec<(String, Vec<[f64; 3]>)>,
}

impl Contents {
    /// The file of that grid.
    pub fn file(&self, grid: &Grid) -> String {
        let mut out = String::from("<?xml version=\"1.0\"?>\n");
        let _ = writeln!(out, "<!-- {} -->", self.about);
        out += "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n";
        out += "<UnstructuredGrid>\n<FieldData>\n";
        field(&mut out, "TimeValue", &self.time.into_iter().collect::<Vec<_>>());
        for (name, values) in &self.fields {
            field(&mut out, name, values);
        }
        // The only unit that names of arrays do not give, that of the points.
        field(&mut out, "meters_per_unit_length", &[1.0]);
        out += "</FieldData>\n";
        let (points, cells) = (grid.points.len(), grid.cells.len());
        let _ = writeln!(out, "<Piece NumberOfPoints=\"{points}\" NumberOfCells=\"{cells}\">");
        self.point_data(&mut out, grid);
        out += "<Points>\n";
        vectors(&mut out, "Points", &grid.points);
        out += "</Points>\n";
        put_cells(&mut out, grid);
        out + "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n"
    }

    fn point_data(&self, out: &mut String, grid: &Grid) {
        let first = |name: Option<&str>| name.unwrap_or_default().to_owned();
        let scalar = first(self.scalars.first().map(|(name, _)| *name));
        let vector = first(self.vectors.first().map(|(name, _)| name.as_str()));
        let _ = writeln!(out, "<PointData Scalars=\"{scalar}\" Vectors=\"{vector}\">");
        for (name, values) in &self.scalars {
            begin(out, "Float64", name, 1);
            rows(out, grid.places.iter().map(|k| format!("{:?}", values[*k])), 8);
        }
        for (name, motion) in &self.vectors {
            vectors(out, name, motion);
        }
        *out += "</PointData>\n";
    }
}

fn put_cells(out: &mut String, grid: &Grid) {
    *out += "<Cells>\n";
    begin(out, "Int64", "connectivity", 1);
    rows(out, grid.cells.iter().flatten().map(usize::to_string), 16);
    begin(out, "Int64", "offsets", 1);
    let ends = grid.cells.iter().scan(0, |end, cell| {
        *end += cell.len();
        Some(end.to_string())
    });
    rows(out, ends, 16);
    begin(out, "UInt8", "types", 1);
    let kind = |cell: &Vec<usize>| match cell.len() {
        2 => "3",
        3 => "5",
        _ => "9",
    };
    rows(out, grid.cells.iter().map(|cell| kind(cell).to_owned()), 32);
    *out += "</Cells>\n";
}

/// Numbers of the whole file; empty if there are none.
fn field(out: &mut String, name: &str, values: &[f64]) {
    if values.is_empty() {
        return;
    }
    let _ = writeln!(
        out,
        "<DataArray type=\"Float64\" Name=\"{name}\" NumberOfTuples=\"{}\" format=\"ascii\">",
        values.len()
    );
    rows(out, values.iter().map(|value| format!("{value:?}")), 8);
}

fn vectors(out: &mut String, name: &str, vectors: &[[f64; 3]]) {
    begin(out, "Float64", name, 3);
    rows(out, vectors.iter().map(|[x, y, z]| format!("{x:?} {y:?} {z:?}")), 2);
}

/// The head of an array. The number of components is omitted for one component, the default.
fn begin(out: &mut String, kind: &str, name: &str, components: usize) {
    let components = match components {
        1 => String::new(),
        n => format!(" NumberOfComponents=\"{n}\""),
    };
    let _ =
        writeln!(out, "<DataArray type=\"{kind}\" Name=\"{name}\"{components} format=\"ascii\">");
}

/// The numbers of an array, the given number on a line, and its end.
fn rows(out: &mut String, words: impl Iterator<Item = String>, per_line: usize) {
    for (k, word) in words.enumerate() {
        if k > 0 {
            out.push(if k % per_line == 0 { '\n' } else { ' ' });
        }
        *out += &word;
    }
    *out += "\n</DataArray>\n";
}
