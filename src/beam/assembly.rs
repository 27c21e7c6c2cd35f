//! K and M of the bat, sparse, as users export them and other solvers factor them.

use std::io::{self, Write};

use nalgebra_sparse::{CooMatrix, CscMatrix};

use crate::beam::element::{Element, Matrix4};

/// Stiffness and mass in the unknowns `[w₀, θ₀, w₁, θ₁, …]`, two per node, free–free.
///
/// Units: deflections in m, slopes in rad; `K` in N/m, N, N m, `M` in kg, kg m, kg m².
#[derive(Debug, Clone)]
pub struct Pencil {
    pub stiffness: CscMatrix<f64>,
    pub mass: CscMatrix<f64>,
}

impl Pencil {
    pub fn assemble(elements: &[Element]) -> Self {
        let size = 2 * (elements.len() + 1);
        let (mut k, mut m) = (CooMatrix::new(size, size), CooMatrix::new(size, size));
        for (e, element) in elements.iter().enumerate() {
            let (stiffness, mass) = element.hermite();
            scatter(&mut k, 2 * e, &stiffness);
            scatter(&mut m, 2 * e, &mass);
        }
        Self { stiffness: CscMatrix::from(&k), mass: CscMatrix::from(&m) }
    }
}

fn scatter(into: &mut CooMatrix<f64>, first: usize, block: &Matrix4) {
    for (i, row) in block.iter().enumerate() {
        for (j, value) in row.iter().enumerate() {
            into.push(first + i, first + j, *value);
        }
    }
}

/// Writes the lower triangle of a symmetric matrix as a Matrix Market coordinate file.
///
/// # Source
///
/// R. F. Boisvert, R. Pozo, K. A. Remington, The Matrix Market Exchange Formats, NISTIR 5935
/// (1996): a banner, a size line, one line `row column value` per entry, counted from 1.
pub fn write_matrix_market(matrix: &CscMatrix<f64>, out: &mut impl Write) -> io::Result<()> {
    let lower: Vec<_> = matrix.triplet_iter().filter(|(i, j, _)| i >= j).collect();
    writeln!(out, "%%MatrixMarket matrix coordinate real symmetric")?;
    writeln!(out, "% unknowns: deflection (m) and slope (rad) of each node, knob to tip; SI")?;
    writeln!(out, "{} {} {}", matrix.nrows(), matrix.ncols(), lower.len())?;
    lower.into_iter().try_for_each(|(i, j, v)| writeln!(out, "{} {} {v:e}", i + 1, j + 1))
}
