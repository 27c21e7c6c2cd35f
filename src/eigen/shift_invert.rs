//! The lowest eigenpairs of a sparse pencil, by Lanczos on a factored `K + σM`.

use nalgebra_sparse::CscMatrix;

use crate::base::{Error, Result, dot};
use crate::eigen::factor::{Factor, INDEFINITE};
use crate::eigen::lanczos::{self, Ritz};

/// Eigenpairs of `K x = λ M x` and the number of steps.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Pairs {
    /// Eigenvalues λ, rising (1/s²); the rigid ones are 0 up to round-off of either sign.
    pub values: Vec<f64>,
    /// Difference between λ and `1/θ − σ` (1/s²), the largest of this and all lower pairs: about the round-off error of
    /// λ. On the bats in `meshes/` that error was at most four times this, and usually less than this.
    pub round_off: Vec<f64>,
    /// Eigenvectors in the order of the values, `xᵀMx = 1`.
    pub vectors: Vec<Vec<f64>>,
    /// Products with the inverse of `K + σM`.
    pub steps: usize,
}

/// The `count` lowest eigenpairs of `K x = λ M x`, the rigid ones included.
///
/// `K` is symmetric and may be singular, `M` is symmetric positive definite. With
/// `K + σM = L Lᵀ` the pencil becomes the symmetric operator
///
/// ```text
/// L⁻¹ M L⁻ᵀ z = θ z,    λ = 1/θ − σ,    x = L⁻ᵀ z / √θ,
/// ```
///
/// Lanczos finds its largest eigenvalues θ in a few steps, until each residual is below `residual · θ`. `shift` is σ
/// (1/s²), of the size of the lowest elastic λ. With a much smaller σ, `K + σM` is nearly singular; with a much larger
/// one, the wanted θ crowd together. The λ returned are Rayleigh's quotients `xᵀKx/xᵀMx`, to which an error of the
/// factorisation in `x` contributes only in second order. Its error in θ is about `ε n⁴` of the lowest elastic λ for n
/// elements.
///
/// # Errors
///
/// As [`Factor::new`]; [`Error::Factorization`] too if the factorisation succeeded but cost a tenth of a wanted λ + σ;
/// [`Error::NotConverged`] if a wanted pair misses `residual`, or if there are fewer than `count` pairs.
pub fn lowest(
    k: &CscMatrix<f64>,
    m: &CscMatrix<f64>,
    shift: f64,
    count: usize,
    residual: f64,
) -> Result<Pairs> {
    let factor = Factor::new(k, m, shift)?;
    let mut noise = Noise::default();
    let mut middle = vec![0.0; k.nrows()];
    let ritz = every_copy(k.nrows(), count, |found, wanted| {
        let mut start = noise.vector(k.nrows());
        remove(found, &mut start);
        lanczos::largest(start, wanted, residual, |z, image| {
            middle.copy_from_slice(z);
            factor.backward(&mut middle);
            multiply(m, &middle, image);
            factor.forward(image);
            remove(found, image);
        })
    })?;
    let vectors = ritz.vectors.into_iter().map(|mut z| {
        factor.backward(&mut z);
        z
    });
    pairs(k, m, shift, Ritz { vectors: vectors.collect(), ..ritz })
}

/// The `count` largest eigenpairs from searches that each start from a single vector.
///
/// The Krylov space of one vector contains a single direction of a multiple eigenvalue, and the rigid motions of a free
/// beam share one. So `search(found, wanted)` is called again, in the space orthogonal to everything found, until it
/// finds a pair that is not among the `count` largest. An eigenvalue of a beam is at most double (two conditions at one
/// end leave two of four solutions), so the second copy is then found whenever the first one is.
///
/// # Errors
///
/// The errors of `search`; [`Error::NotConverged`] if the space is exhausted before.
pub fn every_copy(
    dimension: usize,
    count: usize,
    mut search: impl FnMut(&[Vec<f64>], usize) -> Result<Ritz>,
) -> Result<Ritz> {
    let mut all = Ritz { values: vec![], vectors: vec![], steps: 0 };
    let mut wanted = count.min(dimension);
    let enough =
        |all: &Ritz, least: f64| all.values.iter().filter(|value| **value > least).count() >= count;
    while wanted > 0 {
        let new = search(&all.vectors, wanted)?;
        let found = new.vectors.len();
        all.steps += new.steps;
        all.values.extend(&new.values[..found]);
        all.vectors.extend(new.vectors);
        if found == 0 || enough(&all, new.values[found - 1]) {
            break;
        }
        wanted = 2.min(dimension - all.vectors.len());
    }
    sorted(all, count)
}

/// The `count` largest, largest first.
fn sorted(all: Ritz, count: usize) -> Result<Ritz> {
    let (steps, converged) = (all.steps, all.values.len());
    let mut pairs: Vec<(f64, Vec<f64>)> = all.values.into_iter().zip(all.vectors).collect();
    pairs.sort_by(|a, b| b.0.total_cmp(&a.0));
    pairs.truncate(count);
    let positive = pairs.iter().all(|(value, _)| *value > 0.0);
    if pairs.len() < count || !positive {
        return Err(Error::NotConverged { wanted: count, converged: converged.min(count), steps });
    }
    let (values, vectors) = pairs.into_iter().unzip();
    Ok(Ritz { values, vectors, steps })
}

/// Turns θ and an unscaled `x` into λ and a vector with `xᵀMx = 1`.
///
/// # Errors
///
/// [`Error::Factorization`] if λ and `1/θ − σ` differ by more than a tenth of λ + σ: the factored matrix is then too
/// far from `K + σM`.
pub fn pairs(k: &CscMatrix<f64>, m: &CscMatrix<f64>, shift: f64, ritz: Ritz) -> Result<Pairs> {
    let mut product = vec![0.0; m.nrows()];
    let mut rows = Vec::with_capacity(ritz.values.len());
    for (theta, mut vector) in ritz.values.iter().zip(ritz.vectors) {
        multiply(m, &vector, &mut product);
        let scale = 1.0 / dot(&vector, &product).sqrt();
        vector.iter_mut().for_each(|x| *x *= scale);
        multiply(k, &vector, &mut product);
        let lambda = dot(&vector, &product);
        let round_off = (1.0 / theta - shift - lambda).abs();
        let small = round_off <= 0.1 * (lambda + shift); // not so for a NaN
        if !small {
            return Err(Error::Factorization { unknowns: k.nrows(), reason: INDEFINITE });
        }
        rows.push((lambda, round_off, vector));
    }
    rows.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut pairs = Pairs { steps: ritz.steps, ..Pairs::default() };
    let mut greatest = 0.0_f64;
    for (lambda, round_off, vector) in rows {
        // The round-off of K affects all shapes alike; one difference may be small by chance.
        greatest = greatest.max(round_off);
        pairs.values.push(lambda);
        pairs.round_off.push(greatest);
        pairs.vectors.push(vector);
    }
    Ok(pairs)
}

/// `y = A x` for a symmetric `A`, whose rows are its columns.
pub fn multiply(a: &CscMatrix<f64>, x: &[f64], y: &mut [f64]) {
    let (offsets, rows, values) = a.csc_data();
    for (y, ends) in y.iter_mut().zip(offsets.windows(2)) {
        let (rows, values) = (&rows[ends[0]..ends[1]], &values[ends[0]..ends[1]]);
        *y = rows.iter().zip(values).map(|(i, a)| a * x[*i]).sum();
    }
}

/// Removes the directions of the orthonormal `found` from `vector`.
fn remove(found: &[Vec<f64>], vector: &mut [f64]) {
    for direction in found {
        let part = dot(direction, vector);
        vector.iter_mut().zip(direction).for_each(|(v, d)| *v -= part * d);
    }
}

/// Start vectors that favour no mode and no symmetry, the same in every run.
#[derive(Debug, Default)]
pub struct Noise {
    state: u64,
}

impl Noise {
    /// Numbers between −½ and ½ from a linear congruential generator, new ones at every call.
    pub fn vector(&mut self, length: usize) -> Vec<f64> {
        let mut next = || {
            self.state = self.state.wrapping_mul(0x5851_F42D_4C95_7F2D).wrapping_add(1);
            (self.state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        (0..length).map(|_| next()).collect()
    }
}
