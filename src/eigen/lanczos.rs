//! The largest eigenvalues of a symmetric operator, by Lanczos with full reorthogonalisation.
//!
//! The compliance of a beam has eigenvalues that fall like n⁻⁴, so about `count + 8` steps find
//! the `count` largest to full precision; keeping every basis vector costs nothing then, and
//! none of Lanczos' ghosts appear.

use crate::eigen::tridiagonal;
use crate::error::{Error, Result};

/// Ritz pairs of a symmetric operator and how the iteration went.
#[derive(Debug, Clone)]
pub struct Ritz {
    /// Eigenvalues, largest first.
    pub values: Vec<f64>,
    /// Orthonormal eigenvectors, in the order of the values.
    pub vectors: Vec<Vec<f64>>,
    /// Lanczos steps taken: products with the operator.
    pub steps: usize,
}

/// Convergence is looked for from this many steps beyond the wanted number on, and so often.
const EARLIEST: usize = 8;
const EVERY: usize = 1;

/// The `count` largest eigenpairs of the symmetric positive operator `apply: (x, y) ↦ y = A x`.
///
/// Lanczos' three-term recurrence from the vector `start`, each new vector orthogonalised
/// against all before it, twice where cancellation calls for it (Daniel, Gragg, Kaufman and
/// Stewart, Math. Comp. 30 (1976) 772). Stops when `|β s_j|/θ`, the residual
/// `‖A v − θ v‖/θ` of each wanted Ritz pair, is below `residual`, or when the whole space is spanned.
///
/// # Errors
///
/// [`Error::NotConverged`] if any wanted pair misses that: a list with a hole would be read as
/// complete.
pub fn largest(
    start: Vec<f64>,
    count: usize,
    residual: f64,
    mut apply: impl FnMut(&[f64], &mut [f64]),
) -> Result<Ritz> {
    let dimension = start.len();
    let most = dimension.min(3 * count + 60);
    let size = dot(&start, &start).sqrt();
    let mut basis: Vec<Vec<f64>> = vec![start.into_iter().map(|v| v / size).collect()];
    let (mut alpha, mut beta): (Vec<f64>, Vec<f64>) = (vec![], vec![]);
    let mut next = vec![0.0; dimension];
    loop {
        let steps = basis.len();
        apply(&basis[steps - 1], &mut next);
        alpha.push(dot(&basis[steps - 1], &next));
        subtract(alpha[steps - 1], &basis[steps - 1], &mut next);
        if let (Some(beta), [.., before, _]) = (beta.last(), &basis[..]) {
            subtract(*beta, before, &mut next);
        }
        let rest = orthogonalise(&basis, &mut next);
        let spanned = steps == dimension || rest <= f64::EPSILON * f64::EPSILON * alpha[0];
        // The small eigenproblem costs steps³, so many modes are looked at less often.
        let every = EVERY.max(count / 8);
        let due = steps >= count + EARLIEST && (steps - count - EARLIEST).is_multiple_of(every);
        if spanned || steps == most || due {
            let failed = Error::NotConverged { wanted: count, converged: 0, steps };
            let (values, weights) = tridiagonal::eigen(&alpha, &beta).ok_or(failed)?;
            let wanted = count.min(steps);
            let misses = |k: &usize| rest * weights[*k][steps - 1].abs() > residual * values[*k];
            let missed = if spanned { 0 } else { (0..wanted).filter(misses).count() };
            if missed == 0 && wanted == count {
                return Ok(Ritz { vectors: combine(&basis, &weights[..count]), values, steps });
            }
            if spanned || steps == most {
                let converged = wanted - missed;
                return Err(Error::NotConverged { wanted: count, converged, steps });
            }
        }
        beta.push(rest);
        let scale = 1.0 / rest;
        basis.push(next.iter().map(|v| v * scale).collect());
    }
}

fn subtract(part: f64, from: &[f64], vector: &mut [f64]) {
    vector.iter_mut().zip(from).for_each(|(v, b)| *v -= part * b);
}

/// Takes everything of `basis` out of `vector`; the length that is left.
fn orthogonalise(basis: &[Vec<f64>], vector: &mut [f64]) -> f64 {
    let mut size = dot(vector, vector).sqrt();
    for _ in 0..3 {
        for b in basis.iter().rev() {
            subtract(dot(b, vector), b, vector);
        }
        let rest = dot(vector, vector).sqrt();
        if rest > 0.7 * size {
            return rest;
        }
        size = rest;
    }
    size
}

/// `Σ weights[k][j] basis[j]` for every `k`, scaled to length 1.
fn combine(basis: &[Vec<f64>], weights: &[Vec<f64>]) -> Vec<Vec<f64>> {
    weights
        .iter()
        .map(|weights| {
            let mut vector = vec![0.0; basis[0].len()];
            for (weight, b) in weights.iter().zip(basis) {
                vector.iter_mut().zip(b).for_each(|(v, b)| *v += weight * b);
            }
            vector
        })
        .collect()
}

/// `xᵀy` in eight partial sums per block, so that the error does not grow with the length.
pub fn dot(x: &[f64], y: &[f64]) -> f64 {
    const BLOCK: usize = 1024;
    let block = |x: &[f64], y: &[f64]| {
        let mut lanes = [0.0; 8];
        let (x8, y8) = (x.chunks_exact(8), y.chunks_exact(8));
        let tail: f64 = x8.remainder().iter().zip(y8.remainder()).map(|(x, y)| x * y).sum();
        for (x, y) in x8.zip(y8) {
            for k in 0..8 {
                lanes[k] += x[k] * y[k];
            }
        }
        tail + lanes.iter().sum::<f64>()
    };
    x.chunks(BLOCK).zip(y.chunks(BLOCK)).map(|(x, y)| block(x, y)).sum()
}
