//! K and M of the bat as sparse matrices, for export and for solvers that factor them.

use std::io::{self, Write};

use nalgebra_sparse::{CooMatrix, CscMatrix};

use crate::bat::{Bat, Theory};
use crate::beam::degree::{OfDegree, of_degree};
use crate::beam::element::Element;
use crate::beam::hermite::elements;
use crate::beam::mesh::Mesh;

/// Stiffness and mass of a free bat in the unknowns `[w₀, θ₀, b…, w₁, θ₁, b…, …]`: deflection and slope of every node.
/// The unknowns of an element follow those of its left node: the bubbles (degree above 3) and, with shear, the shear
/// strains.
///
/// Units: deflections in m, rotations in rad, bubbles (curvatures) in 1/m, shear strains in 1; `K`
/// in N/m to N m³, `M` in kg to kg m⁴.
#[derive(Debug, Clone)]
pub struct Pencil {
    /// K.
    pub stiffness: CscMatrix<f64>,
    /// M, consistent.
    pub mass: CscMatrix<f64>,
}

impl Pencil {
    /// The matrices of a bat on that mesh with elements of that degree.
    pub fn of(bat: &Bat, mesh: &Mesh, degree: usize, theory: Theory) -> Self {
        of_degree(degree, theory, Assembly { bat, mesh, theory })
    }

    /// The matrices of elements from knob to tip.
    pub fn assemble<const N: usize, const W: usize>(elements: &[Element<f64, N, W>]) -> Self {
        let size = (W - 2) * elements.len() + 2;
        let (mut k, mut m) = (CooMatrix::new(size, size), CooMatrix::new(size, size));
        for (e, element) in elements.iter().enumerate() {
            let (stiffness, mass) = element.hermite();
            let places = places(W, e);
            scatter(&mut k, &places, stiffness.as_flattened());
            scatter(&mut m, &places, mass.as_flattened());
        }
        Self { stiffness: CscMatrix::from(&k), mass: CscMatrix::from(&m) }
    }
}

/// Indices of the `width` unknowns `[w₁, θ₁, w₂, θ₂, b₂ …, g₀ …]` of element `e` among all unknowns.
pub fn places(width: usize, e: usize) -> Vec<usize> {
    let first = (width - 2) * e;
    let place = |i| match i {
        0 | 1 => first + i,
        2 | 3 => first + (width - 2) + (i - 2),
        _ => first + 2 + (i - 4),
    };
    (0..width).map(place).collect()
}

/// Adds a block, stored by rows, at those indices.
fn scatter(into: &mut CooMatrix<f64>, places: &[usize], block: &[f64]) {
    for (i, row) in places.iter().zip(block.chunks_exact(places.len())) {
        for (j, value) in places.iter().zip(row) {
            into.push(*i, *j, *value);
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
    writeln!(
        out,
        "% unknowns knob to tip: deflection (m), slope (rad) of a node, then bubbles (1/m); SI"
    )?;
    writeln!(out, "{} {} {}", matrix.nrows(), matrix.ncols(), lower.len())?;
    lower.into_iter().try_for_each(|(i, j, v)| writeln!(out, "{} {} {v:e}", i + 1, j + 1))
}

/// The assembly of a bat's elements.
struct Assembly<'a> {
    bat: &'a Bat,
    mesh: &'a Mesh,
    theory: Theory,
}

impl OfDegree for Assembly<'_> {
    type Output = Pencil;

    fn with<const N: usize, const W: usize>(self) -> Pencil {
        Pencil::assemble(&elements::<N, W>(self.bat, self.mesh, self.theory))
    }
}
