//! The sparse Cholesky factor of a shifted pencil, by faer.

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::sparse::linalg::LltError;
use faer::sparse::linalg::cholesky::simplicial::{
    SymbolicSimplicialCholesky, factorize_simplicial_numeric_llt,
    factorize_simplicial_numeric_llt_scratch, factorize_simplicial_symbolic_cholesky,
    factorize_simplicial_symbolic_cholesky_scratch, prefactorize_symbolic_cholesky,
    prefactorize_symbolic_cholesky_scratch,
};
use faer::sparse::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_lower_triangular_transpose_in_place,
};
use faer::sparse::{
    FaerError, SparseColMat, SparseColMatRef, SymbolicSparseColMat, SymbolicSparseColMatRef,
};
use faer::{Conj, MatMut, Par};
use nalgebra_sparse::CscMatrix;

use crate::base::{Error, Result};

/// `L` of `K + σM = L Lᵀ`.
///
/// The unknowns keep their order. A beam's unknowns, numbered from knob to tip, form a narrow band, and a band has no
/// fill-in.
#[derive(Debug)]
pub struct Factor {
    symbolic: SymbolicSimplicialCholesky<usize>,
    values: Vec<f64>,
}

impl Factor {
    /// Factors `K + σM`, both matrices whole (both triangles) and of one size.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for a shift that is not positive; [`Error::Factorization`] if the sum is not positive definite
    /// in double precision. The round-off of `K` is ε times its largest entry. In a beam that is `ε λ_max ~ ε n⁴ λ₁`,
    /// which drowns any `σ` near `λ₁` from `n ≈ 10⁴` on.
    pub fn new(k: &CscMatrix<f64>, m: &CscMatrix<f64>, shift: f64) -> Result<Self> {
        if !(shift > 0.0 && shift.is_finite()) {
            return Err(Error::value("shift", shift, "a positive number of 1/s²"));
        }
        let unknowns = k.nrows();
        let sum = upper_triangle(k + m * shift);
        let failed = |reason| Error::Factorization { unknowns, reason };
        let symbolic = pattern(sum.symbolic()).map_err(|error| failed(generic(error)))?;
        let values = numbers(sum.as_ref(), &symbolic).map_err(|error| {
            failed(match error {
                LltError::Numeric(_) => INDEFINITE,
                LltError::Generic(error) => generic(error),
            })
        })?;
        Ok(Self { symbolic, values })
    }

    /// `x ← L⁻¹ x`.
    pub fn forward(&self, x: &mut [f64]) {
        solve_lower_triangular_in_place(self.lower(), Conj::No, column(x), Par::Seq);
    }

    /// `x ← L⁻ᵀ x`.
    pub fn backward(&self, x: &mut [f64]) {
        solve_lower_triangular_transpose_in_place(self.lower(), Conj::No, column(x), Par::Seq);
    }

    fn lower(&self) -> SparseColMatRef<'_, usize, f64> {
        SparseColMatRef::new(self.symbolic.factor(), &self.values)
    }
}

/// The reason if round-off has drowned `σM`.
pub const INDEFINITE: &str = "round-off makes it indefinite; \
     take fewer elements, or the solver that needs no factorisation";

fn generic(error: FaerError) -> &'static str {
    match error {
        FaerError::OutOfMemory => "out of memory",
        _ => "too many entries for their indices",
    }
}

fn column(x: &mut [f64]) -> MatMut<'_, f64> {
    let rows = x.len();
    MatMut::from_column_major_slice_mut(x, rows, 1)
}

fn upper_triangle(matrix: CscMatrix<f64>) -> SparseColMat<usize, f64> {
    let (rows, columns) = (matrix.nrows(), matrix.ncols());
    let (offsets, indices, values) = matrix.upper_triangle().disassemble();
    SparseColMat::new(
        SymbolicSparseColMat::new_checked(rows, columns, offsets, None, indices),
        values,
    )
}

/// Where `L` has entries.
fn pattern(
    a: SymbolicSparseColMatRef<'_, usize>,
) -> std::result::Result<SymbolicSimplicialCholesky<usize>, FaerError> {
    let n = a.nrows();
    let scratch = StackReq::or(
        prefactorize_symbolic_cholesky_scratch::<usize>(n, a.compute_nnz()),
        factorize_simplicial_symbolic_cholesky_scratch::<usize>(n),
    );
    let mut memory = MemBuffer::try_new(scratch).map_err(|_| FaerError::OutOfMemory)?;
    let stack = MemStack::new(&mut memory);
    let (mut tree, mut counts) = (vec![0; n], vec![0; n]);
    let tree = prefactorize_symbolic_cholesky(&mut tree, &mut counts, a, stack);
    factorize_simplicial_symbolic_cholesky(a, tree, &counts, stack)
}

/// The entries of `L`.
fn numbers(
    a: SparseColMatRef<'_, usize, f64>,
    symbolic: &SymbolicSimplicialCholesky<usize>,
) -> std::result::Result<Vec<f64>, LltError> {
    let scratch = factorize_simplicial_numeric_llt_scratch::<usize, f64>(a.nrows());
    let mut memory =
        MemBuffer::try_new(scratch).map_err(|_| LltError::Generic(FaerError::OutOfMemory))?;
    let mut values = vec![0.0; symbolic.len_val()];
    let stack = MemStack::new(&mut memory);
    factorize_simplicial_numeric_llt(&mut values, a, Default::default(), symbolic, stack)?;
    Ok(values)
}
