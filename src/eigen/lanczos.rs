//! The largest eigenvalues of a symmetric operator, by Lanczos with full reorthogonalisation.
//!
//! The eigenvalues of a beam's compliance fall like n⁻⁴, so about two steps for each find the largest: the first 5 of
//! an R161 take 10 to 12 steps, the first 10 take 17 to 19. Keeping every basis vector is then cheap, and none of
//! Lanczos' spurious copies appear.

use crate::base::linear::dots;
use crate::base::{Error, Real, Result, dot};
use crate::eigen::tridiagonal::Tridiagonal;

/// The iteration and its memory, which the next run reuses.
#[derive(Debug, Clone, Default)]
pub struct Lanczos<R> {
    /// Orthonormal vectors, one after the other.
    basis: Vec<R>,
    next: Vec<R>,
    parts: Vec<R>,
    alpha: Vec<R>,
    beta: Vec<R>,
    small: Tridiagonal<R>,
    /// Steps taken: products with the operator.
    pub steps: usize,
    /// Eigenvalues, largest first in every lane.
    pub values: Vec<R>,
    /// Relative residual `‖A v − θ v‖/θ` of every eigenpair.
    pub residuals: Vec<R>,
    /// The next eigenvalue after them, with a residual of at most 100 times the wanted one; `None` if there is none.
    pub beyond: Option<R>,
    /// Orthonormal eigenvectors, one for every value, one after the other.
    pub vectors: Vec<R>,
}

/// Factor on the residual of the eigenpair after the wanted ones: its value need not be accurate, and the error of a
/// value is proportional to the square of the residual.
const NEARLY: f64 = 100.0;

/// What the iteration must find.
#[derive(Debug, Clone, Copy)]
pub struct Wanted {
    /// Number of eigenpairs.
    pub count: usize,
    /// Largest residual `‖A v − θ v‖/θ`.
    pub residual: f64,
    /// Number of steps beyond `count` before convergence is first tested.
    pub earliest: usize,
    /// Number of eigenvalues that may lie so close together that they need additional steps.
    pub clustered: usize,
}

/// The space in which the eigenvectors are sought.
pub struct Space<'a, R> {
    /// Orthonormal vectors to which the eigenvectors must be orthogonal, one after the other.
    pub known: &'a [R],
    /// Removes from a vector any other direction outside the space of the operator.
    pub allow: &'a mut dyn FnMut(&mut [R]),
}

impl<R: Real> Lanczos<R> {
    /// The largest eigenpairs in that space of the symmetric positive operator `apply: (x, y) ↦ y = A x`, from the
    /// vector that `start` writes.
    ///
    /// Lanczos' three-term recurrence, each new vector orthogonalised against all before it, twice
    /// where cancellation calls for it (Daniel, Gragg, Kaufman and Stewart, Math. Comp. 30 (1976)
    /// 772). Stops when `|β s_j|/θ`, the residual of each wanted Ritz pair, is below the wanted
    /// one, or when the whole space is spanned.
    ///
    /// # Errors
    ///
    /// [`Error::NotConverged`] if a wanted pair misses the residual: an incomplete list would be read as complete.
    #[inline(always)]
    pub fn largest(
        &mut self,
        dimension: usize,
        wanted: Wanted,
        space: Space<R>,
        start: impl FnOnce(&mut [R]),
        mut apply: impl FnMut(&[R], &mut [R]),
    ) -> Result<()> {
        let (count, Space { known, allow }) = (wanted.count, space);
        let before = known.len() / dimension;
        let most = (dimension - before).min(3 * (count + wanted.clustered) + 60);
        self.begin(dimension, known, most.min(count + wanted.earliest));
        start(&mut self.next);
        let size = match before {
            0 => dot(&self.next, &self.next).sqrt(),
            _ => self.orthogonalise(allow),
        };
        self.take(size);
        loop {
            self.multiply(dimension, &mut apply);
            let rest = self.orthogonalise(allow);
            let steps = self.steps;
            let spanned = steps == dimension - before
                || rest.within(R::splat(f64::EPSILON * f64::EPSILON) * self.alpha[0]);
            // The small eigenproblem costs steps³, so for many modes it is solved less often.
            let beyond = steps.checked_sub(count + wanted.earliest);
            let due = beyond.is_some_and(|beyond| beyond.is_multiple_of(1 + count / 8));
            if spanned || steps == most || due {
                let (converged, shows) = self.look(wanted, rest, spanned)?;
                if converged == count && (spanned || shows) {
                    self.combine(count, dimension, before);
                    return Ok(());
                }
                // Room up to the next test only, where a vector would double its memory.
                self.basis.reserve_exact(dimension * (1 + count / 8));
                if spanned || steps == most {
                    return Err(Error::NotConverged { wanted: count, converged, steps });
                }
            }
            self.beta.push(rest);
            self.take(rest);
        }
    }

    /// Component of eigenvector `pair` along the basis vector of a step.
    #[inline(always)]
    pub fn weight(&self, pair: usize, step: usize) -> R {
        self.small.weight(pair, step)
    }

    /// Resets the basis to the known vectors, with room for the given number of steps.
    #[inline(always)]
    fn begin(&mut self, dimension: usize, known: &[R], room: usize) {
        self.next.clear();
        self.next.resize(dimension, R::default());
        self.basis.clear();
        self.basis.extend_from_slice(known);
        self.basis.reserve_exact(dimension * room);
        for values in [&mut self.alpha, &mut self.beta, &mut self.parts] {
            values.clear();
            values.reserve(room);
        }
        self.steps = 0;
    }

    /// One step: the product with the last basis vector, less its known components.
    #[inline(always)]
    fn multiply(&mut self, dimension: usize, apply: &mut impl FnMut(&[R], &mut [R])) {
        self.steps += 1;
        let (older, last) = self.basis.split_at(self.basis.len() - dimension);
        apply(last, &mut self.next);
        let alpha = dot(last, &self.next);
        self.alpha.push(alpha);
        subtract(alpha, last, &mut self.next);
        if let Some(beta) = self.beta.last() {
            subtract(*beta, &older[older.len() - dimension..], &mut self.next);
        }
    }

    /// Tests the Ritz pairs: how many of the wanted ones have converged, and whether the next one has been found.
    #[inline(always)]
    fn look(&mut self, wanted: Wanted, rest: R, spanned: bool) -> Result<(usize, bool)> {
        let (count, steps) = (wanted.count, self.steps);
        let failed = Error::NotConverged { wanted: count, converged: 0, steps };
        self.small.solve(&self.alpha, &self.beta).ok_or(failed)?;
        let found = count.min(steps);
        self.residuals.clear();
        for k in 0..found {
            let residual = rest * self.small.weight(k, steps - 1).abs();
            self.residuals.push(residual / self.small.value(k));
        }
        let misses = |residual: &&R| !residual.within(R::splat(wanted.residual));
        let missed = if spanned { 0 } else { self.residuals.iter().filter(misses).count() };
        // A wanted vector can be told from the next one only if that one has been found.
        self.beyond = (steps > count).then(|| self.small.value(count));
        let shows = self.beyond.is_some_and(|value| {
            let residual = rest * self.small.weight(count, steps - 1).abs();
            residual.within(R::splat(NEARLY * wanted.residual) * value)
        });
        Ok((found - missed, shows))
    }

    /// Makes `next`, of that length, the next basis vector.
    #[inline(always)]
    fn take(&mut self, size: R) {
        let scale = R::splat(1.0) / size;
        for v in &self.next {
            self.basis.push(*v * scale);
        }
    }

    /// Removes all basis vectors from `next`, in every lane as often as its cancellation requires; returns the
    /// remaining length.
    #[inline(always)]
    fn orthogonalise(&mut self, allow: &mut dyn FnMut(&mut [R])) -> R {
        allow(&mut self.next);
        let (basis, next, parts) = (&self.basis, &mut self.next, &mut self.parts);
        let mut size = dot(next, next).sqrt();
        // Amount by which the new length falls short of 0.7 times the old one (1 at first); 0 in the lanes that are
        // done.
        let mut lost = R::splat(1.0);
        for _ in 0..3 {
            parts.clear();
            let fours = basis.chunks_exact(4 * next.len());
            let ones = fours.remainder().chunks_exact(next.len());
            for four in fours {
                let products: [R; 4] = dots(four, next);
                parts.extend_from_slice(&products);
            }
            for one in ones {
                parts.push(dot(one, next));
            }
            for part in parts.iter_mut() {
                *part = lost.if_zero(R::default(), *part);
            }
            subtract_all(parts, basis, next);
            let rest = dot(next, next).sqrt();
            let now = R::default().max(R::splat(0.7) * size - rest);
            lost = lost.if_zero(R::default(), now);
            size = rest;
            if lost.within(R::default()) {
                break;
            }
        }
        size
    }

    /// `Σ weights[k][j] basis[j]` for the first `count` pairs.
    #[inline(always)]
    fn combine(&mut self, count: usize, dimension: usize, before: usize) {
        self.vectors.clear();
        self.vectors.resize(count * dimension, R::default());
        self.values.clear();
        self.values.extend((0..count).map(|k| self.small.value(k)));
        let basis = &self.basis[before * dimension..];
        let steps = basis.len() / dimension;
        // A stretch of all basis vectors stays in the cache while every pair uses it.
        for from in (0..dimension).step_by(STRETCH) {
            let length = STRETCH.min(dimension - from);
            self.next.clear();
            for b in basis.chunks_exact(dimension) {
                self.next.extend_from_slice(&b[from..from + length]);
            }
            for (k, vector) in self.vectors.chunks_exact_mut(dimension).enumerate() {
                self.parts.clear();
                self.parts.extend((0..steps).map(|j| -self.small.weight(k, j)));
                subtract_all(&self.parts, &self.next, &mut vector[from..from + length]);
            }
        }
    }
}

/// Ritz pairs of a symmetric operator and the number of steps.
#[derive(Debug, Clone)]
pub struct Ritz {
    /// Eigenvalues, largest first.
    pub values: Vec<f64>,
    /// Orthonormal eigenvectors, in the order of the values.
    pub vectors: Vec<Vec<f64>>,
    /// Lanczos steps taken: products with the operator.
    pub steps: usize,
}

/// The `count` largest eigenpairs of one operator from one start vector, as [`Lanczos::largest`].
///
/// # Errors
///
/// As [`Lanczos::largest`].
pub fn largest(
    start: Vec<f64>,
    count: usize,
    residual: f64,
    apply: impl FnMut(&[f64], &mut [f64]),
) -> Result<Ritz> {
    let mut lanczos = Lanczos::default();
    let wanted = Wanted { count, residual, earliest: 8, clustered: 0 };
    let dimension = start.len();
    let space = Space { known: &[], allow: &mut |_| {} };
    lanczos.largest(dimension, wanted, space, |next| next.copy_from_slice(&start), apply)?;
    let vectors = lanczos.vectors.chunks_exact(dimension).map(<[f64]>::to_vec).collect();
    Ok(Ritz { values: lanczos.values, vectors, steps: lanczos.steps })
}

#[inline(always)]
fn subtract<R: Real>(part: R, from: &[R], vector: &mut [R]) {
    for (v, b) in vector.iter_mut().zip(from) {
        *v -= part * *b;
    }
}

/// Length of the stretch of every basis vector that is processed together: with a thousand vectors half a megabyte, the
/// size of a second-level cache.
const STRETCH: usize = 64;

/// Subtracts `parts[k]` of every basis vector from a vector, in order; four at a time, so that the vector is read and
/// written once for these.
#[inline(always)]
fn subtract_all<R: Real>(parts: &[R], basis: &[R], vector: &mut [R]) {
    let length = vector.len();
    let at = |j: usize| &basis[j * length..][..length];
    let fours = parts.len() / 4 * 4;
    for j in (0..fours).step_by(4) {
        let [p, q, r, s] = [parts[j], parts[j + 1], parts[j + 2], parts[j + 3]];
        let [a, b, c, d] = [at(j), at(j + 1), at(j + 2), at(j + 3)];
        for ((((v, a), b), c), d) in vector.iter_mut().zip(a).zip(b).zip(c).zip(d) {
            *v = *v - p * *a - q * *b - r * *c - s * *d;
        }
    }
    for j in fours..parts.len() {
        subtract(parts[j], at(j), vector);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whole numbers have no rounding.
    #[test]
    fn what_is_taken_out_at_once_is_the_sum_of_all_parts() {
        for (length, count) in [(3, 9), (64, 4), (1030, 6), (2051, 3)] {
            let number = |k: usize| ((7 * k) % 19) as f64 - 9.0;
            let basis: Vec<f64> = (0..length * count).map(number).collect();
            let parts: Vec<f64> = (0..count).map(|j| number(5 * j + 2)).collect();
            let mut left: Vec<f64> = (0..length).map(|k| number(3 * k + 1)).collect();
            subtract_all(&parts, &basis, &mut left);
            for (k, left) in left.iter().enumerate() {
                let taken: f64 = (0..count).map(|j| parts[j] * basis[j * length + k]).sum();
                assert_eq!(*left, number(3 * k + 1) - taken);
            }
        }
    }

    /// A diagonal operator longer than a stretch: its eigenvectors are the unit vectors.
    #[test]
    fn vectors_longer_than_a_stretch_are_combined_whole() {
        let size = 2 * STRETCH + 7;
        let value = |k: usize| 1.0 / (1.0 + ((k * 37) % size) as f64).powi(2);
        let start = vec![1.0; size];
        let found = largest(start, 5, 1e-12, |x, y| {
            (0..size).for_each(|k| y[k] = value(k) * x[k]);
        });
        let found = found.unwrap();
        for (n, vector) in found.vectors.iter().enumerate() {
            let place = (0..size).find(|k| (k * 37) % size == n).unwrap();
            assert!((found.values[n] / value(place) - 1.0).abs() < 1e-13);
            assert!((vector[place].abs() - 1.0).abs() < 1e-11, "{n} {}", vector[place]);
        }
    }
}
