//! NumPy archives: `numpy.load("bat.npz")` gives arrays by name.
//!
//! # Source
//!
//! NumPy's manual, `numpy.lib.format`: an archive is a zip file of `NAME.npy`; each begins with
//! `\x93NUMPY`, a version, the length of its header, and the header, a Python dictionary of type,
//! order and shape, filled up with blanks so that the numbers begin at a multiple of 64 bytes.
//! Sparse matrices are stored as the parts of SciPy's `csc_matrix((data, indices, indptr), shape)`.

use std::io::{Cursor, Error, Result, Write};

use nalgebra_sparse::CscMatrix;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use crate::exchange::modes_file::ModeTable;
use sweetspot::Solution;
use sweetspot::beam::assembly::Pencil;

/// Arrays under names, not compressed.
struct Archive {
    zip: ZipWriter<Cursor<Vec<u8>>>,
}

impl Archive {
    fn new() -> Self {
        Self { zip: ZipWriter::new(Cursor::new(Vec::new())) }
    }

    /// An array of 64-bit floats in rows.
    fn floats(&mut self, name: &str, shape: &[usize], values: &[f64]) -> Result<()> {
        debug_assert_eq!(shape.iter().product::<usize>(), values.len());
        self.begin(name, "<f8", shape)?;
        let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        self.zip.write_all(&bytes)
    }

    /// A list of 64-bit integers.
    fn integers(&mut self, name: &str, values: &[usize]) -> Result<()> {
        self.begin(name, "<i8", &[values.len()])?;
        // Indices of arrays in memory fit 63 bits.
        let bytes: Vec<u8> =
            values.iter().flat_map(|value| (*value as i64).to_le_bytes()).collect();
        self.zip.write_all(&bytes)
    }

    fn begin(&mut self, name: &str, kind: &str, shape: &[usize]) -> Result<()> {
        // Above 4 GB a zip file needs to know before.
        let large = shape.iter().product::<usize>() >= 1 << 28;
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Stored)
            .large_file(large);
        self.zip.start_file(format!("{name}.npy"), options).map_err(Error::other)?;
        self.zip.write_all(&header(kind, shape))
    }

    fn finish(self) -> Result<Vec<u8>> {
        Ok(self.zip.finish().map_err(Error::other)?.into_inner())
    }
}

/// The bytes before the numbers of an array.
fn header(kind: &str, shape: &[usize]) -> Vec<u8> {
    let lengths: String = shape.iter().map(|n| format!("{n},")).collect();
    let text = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({lengths}), }}");
    // Magic, version and length have ten bytes, a line feed ends the header.
    let whole = (10 + text.len() + 1).next_multiple_of(64);
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    let length = u16::try_from(whole - 10).expect("a shape of a few numbers");
    bytes.extend(length.to_le_bytes());
    bytes.extend(text.bytes());
    bytes.resize(whole - 1, b' ');
    bytes.push(b'\n');
    bytes
}

/// An archive of columns, with one array for each.
///
/// # Errors
///
/// If the data exceed the limits of a zip file.
pub fn columns(columns: &[(String, Vec<f64>)]) -> Result<Vec<u8>> {
    let mut archive = Archive::new();
    for (name, values) in columns {
        archive.floats(name, &[values.len()], values)?;
    }
    archive.finish()
}

/// The archive of the modes of a bat: `x_m`, `radius_m`, `inner_radius_m` at every place; `order`, `frequency_hz`,
/// `modal_mass_kg`, `damping_ratio` of every mode; `deflection` and `rotation_rad_per_m`, modes by places; `nodes_m_1`,
/// `nodes_m_2`, … with the nodes of each mode.
///
/// # Errors
///
/// If the data exceed the limits of a zip file.
pub fn modes(table: &ModeTable) -> Result<Vec<u8>> {
    let mut archive = Archive::new();
    let (count, places) = (table.modes.len(), table.x.len());
    let [outer, inner] = table.radii();
    for (name, values) in [("x_m", &table.x), ("radius_m", &outer), ("inner_radius_m", &inner)] {
        archive.floats(name, &[places], values)?;
    }
    let orders: Vec<usize> = table.modes.iter().map(|mode| mode.order as usize).collect();
    archive.integers("order", &orders)?;
    let all = |of: fn(&crate::exchange::modes_file::SampledMode) -> f64| -> Vec<f64> {
        table.modes.iter().map(of).collect()
    };
    archive.floats("frequency_hz", &[count], &all(|mode| mode.frequency))?;
    archive.floats("modal_mass_kg", &[count], &all(|mode| mode.modal_mass))?;
    archive.floats("damping_ratio", &[count], &all(|mode| mode.damping_ratio))?;
    let deflections: Vec<f64> = table.modes.iter().flat_map(|m| m.deflection.clone()).collect();
    let rotations: Vec<f64> = table.modes.iter().flat_map(|m| m.rotation.clone()).collect();
    archive.floats("deflection", &[count, places], &deflections)?;
    archive.floats("rotation_rad_per_m", &[count, places], &rotations)?;
    for mode in &table.modes {
        archive.floats(&format!("nodes_m_{}", mode.order), &[mode.nodes.len()], &mode.nodes)?;
    }
    archive.finish()
}

/// The archive of a mesh: `K_data`, `K_indices`, `K_indptr`, `K_shape` and the same for `M` (all entries, both
/// triangles); `x_m` of its nodes and `deflection_unknown`, the index of the deflection of each node among the unknowns
/// (its rotation is the next one); `frequency_hz` and `modal_mass_kg` of the modes and their shapes at the nodes,
/// `deflection` and `rotation_rad_per_m`, modes by nodes.
///
/// # Errors
///
/// If the data exceed the limits of a zip file.
pub fn matrices(pencil: &Pencil, solution: &Solution) -> Result<Vec<u8>> {
    let mut archive = Archive::new();
    for (name, matrix) in [("K", &pencil.stiffness), ("M", &pencil.mass)] {
        sparse(&mut archive, name, matrix)?;
    }
    let x = solution.mesh.nodes();
    // The unknowns of a node are followed by those inside the element to its right.
    let stride = (pencil.stiffness.nrows() - 2) / solution.mesh.len();
    let unknowns: Vec<usize> = (0..x.len()).map(|k| k * stride).collect();
    archive.floats("x_m", &[x.len()], &x)?;
    archive.integers("deflection_unknown", &unknowns)?;
    let modes = &solution.modes;
    let frequencies: Vec<f64> = modes.iter().map(|mode| mode.frequency()).collect();
    let masses: Vec<f64> = modes.iter().map(|mode| mode.modal_mass).collect();
    archive.floats("frequency_hz", &[modes.len()], &frequencies)?;
    archive.floats("modal_mass_kg", &[modes.len()], &masses)?;
    let shapes = |of: &dyn Fn(usize, f64) -> f64| -> Vec<f64> {
        (0..modes.len()).flat_map(|k| x.iter().map(move |x| of(k, *x))).collect()
    };
    let shape = [modes.len(), x.len()];
    let deflections = shapes(&|k, x| modes[k].shape.deflection(x));
    let rotations = shapes(&|k, x| modes[k].shape.rotation(x));
    archive.floats("deflection", &shape, &deflections)?;
    archive.floats("rotation_rad_per_m", &shape, &rotations)?;
    archive.finish()
}

fn sparse(archive: &mut Archive, name: &str, matrix: &CscMatrix<f64>) -> Result<()> {
    let (offsets, rows, values) = matrix.csc_data();
    archive.floats(&format!("{name}_data"), &[values.len()], values)?;
    archive.integers(&format!("{name}_indices"), rows)?;
    archive.integers(&format!("{name}_indptr"), offsets)?;
    archive.integers(&format!("{name}_shape"), &[matrix.nrows(), matrix.ncols()])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_begin_at_a_multiple_of_64_bytes() {
        for shape in [&[3][..], &[], &[10, 101], &[123_456_789_012, 123_456_789_012]] {
            let header = header("<f8", shape);
            assert_eq!(header.len() % 64, 0);
            let length = u16::from_le_bytes([header[8], header[9]]);
            assert_eq!(usize::from(length) + 10, header.len());
            let text = String::from_utf8(header[10..].to_vec()).unwrap();
            assert!(text.starts_with("{'descr': '<f8', ") && text.ends_with('\n'), "{text}");
        }
        assert!(String::from_utf8_lossy(&header("<i8", &[7])).contains("'shape': (7,), }"));
    }
}
