//! Eigenpairs of a small pencil, by faer's dense algorithms, as an independent check.

use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::{Mat, Par, Side};
use nalgebra_sparse::CscMatrix;

use crate::base::{Error, Result};
use crate::eigen::factor::INDEFINITE;

/// The `count` lowest eigenpairs of `K x = λ M x`, rising, with `xᵀMx = 1`.
///
/// Let `K + σM = L Lᵀ` with σ of the size of the lowest wanted λ. The symmetric problem is `L⁻¹ M L⁻ᵀ z = z/(λ + σ)`,
/// with `x = L⁻ᵀ z √(λ + σ)`. The wanted pairs are then the largest. That matters: faer's divide and conquer, used
/// beyond 128 unknowns, is accurate only relative to the largest eigenvalue, and `L⁻¹ K L⁻ᵀ` of a beam of 264 elements
/// gave twice the first frequency. The remaining error is that of factoring `K`, about `ε n⁴`.
///
/// # Errors
///
/// [`Error::Factorization`] if round-off makes `K + σM` indefinite, as with an element of a micrometre;
/// [`Error::NotConverged`] if the symmetric problem has no solution.
pub fn lowest(
    k: &CscMatrix<f64>,
    m: &CscMatrix<f64>,
    shift: f64,
    count: usize,
) -> Result<(Vec<f64>, Vec<Vec<f64>>)> {
    let n = k.nrows();
    let (mut shifted, mut reduced) = (Mat::<f64>::zeros(n, n), Mat::<f64>::zeros(n, n));
    k.triplet_iter().for_each(|(i, j, v)| shifted[(i, j)] += *v);
    m.triplet_iter().for_each(|(i, j, v)| {
        shifted[(i, j)] += shift * v;
        reduced[(i, j)] = *v;
    });
    let indefinite = Error::Factorization { unknowns: n, reason: INDEFINITE };
    let factor = shifted.llt(Side::Lower).map_err(|_| indefinite)?;
    let lower = factor.L();
    solve_lower_triangular_in_place(lower, reduced.as_mut(), Par::Seq);
    let mut reduced = reduced.transpose().to_owned();
    solve_lower_triangular_in_place(lower, reduced.as_mut(), Par::Seq);
    let failed = Error::NotConverged { wanted: count, converged: 0, steps: 0 };
    let eigen = reduced.self_adjoint_eigen(Side::Lower).map_err(|_| failed)?;
    let count = count.min(n);
    // faer's values rise, so the lowest frequencies come last.
    let mut vectors = eigen.U().subcols(n - count, count).to_owned();
    solve_upper_triangular_in_place(lower.transpose(), vectors.as_mut(), Par::Seq);
    let inverses: Vec<f64> = eigen.S().column_vector().iter().copied().collect();
    let column = |j: usize| {
        let scale = 1.0 / inverses[j].sqrt();
        (0..n).map(|i| vectors[(i, j + count - n)] * scale).collect()
    };
    let lambda = |j: usize| 1.0 / inverses[j] - shift;
    let wanted = || (n - count..n).rev();
    Ok((wanted().map(lambda).collect(), wanted().map(column).collect()))
}
