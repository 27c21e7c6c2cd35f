//! How is a long matrix of small dense blocks factored, and how many eigenvalues lie below a shift?
//!
//! `K = L D Lᵀ`, block after block. A front holds the unknowns that it eliminates and those that they are coupled to;
//! its remainder (the Schur complement) is added to a later front.
//!
//! # Source
//!
//! I. S. Duff, J. K. Reid, ACM Trans. Math. Softw. 9 (1983) 302: fronts. Sylvester's law of inertia: D has as many
//! negative entries as K has negative eigenvalues.

use crate::base::{dot, vectorized};

/// A dense block: its unknowns, and the number of them, from the first on, that are eliminated.
#[derive(Debug, Clone)]
struct Front {
    unknowns: Vec<usize>,
    eliminated: usize,
    /// Rows of `Lᵀ`, one for each eliminated unknown, with the diagonal of 1.
    rows: Vec<f64>,
}

/// The factors of a symmetric matrix.
#[derive(Debug, Clone, Default)]
pub struct Fronts {
    fronts: Vec<Front>,
    /// D, by unknown.
    pivots: Vec<f64>,
    /// Remainders of fronts that no later front has taken: unknowns and upper triangle.
    left: Vec<(Vec<usize>, Vec<f64>)>,
    /// Index of an unknown in the current front.
    places: Vec<usize>,
}

impl Fronts {
    /// An empty factorisation of a matrix of that size.
    pub fn new(size: usize) -> Self {
        Self { pivots: vec![0.0; size], places: vec![usize::MAX; size], ..Self::default() }
    }

    /// Adds a front that eliminates its first `eliminated` unknowns. `fill` adds the entries of the upper triangle to a
    /// zero matrix; it is told the index of each unknown. If `take`, the remainders of all earlier fronts are added
    /// too.
    pub fn add(
        &mut self,
        unknowns: Vec<usize>,
        eliminated: usize,
        take: bool,
        fill: impl FnOnce(&[usize], &mut [f64]),
    ) {
        let size = unknowns.len();
        let mut matrix = vec![0.0; size * size];
        unknowns.iter().enumerate().for_each(|(place, unknown)| self.places[*unknown] = place);
        fill(&self.places, &mut matrix);
        if take {
            for (of, left) in std::mem::take(&mut self.left) {
                for (i, a) in of.iter().enumerate() {
                    let a = self.places[*a];
                    for (j, b) in of.iter().enumerate().skip(i) {
                        let b = self.places[*b];
                        matrix[a.min(b) * size + a.max(b)] += left[i * of.len() + j];
                    }
                }
            }
        }
        let pivots = vectorized!(eliminate(&mut matrix, size, eliminated));
        for (unknown, pivot) in unknowns.iter().zip(&pivots) {
            self.pivots[*unknown] = *pivot;
        }
        let rest = size - eliminated;
        if rest > 0 {
            let rows =
                (eliminated..size).flat_map(|i| &matrix[i * size + eliminated..(i + 1) * size]);
            self.left.push((unknowns[eliminated..].to_vec(), rows.copied().collect()));
        }
        matrix.truncate(eliminated * size);
        self.fronts.push(Front { unknowns, eliminated, rows: matrix });
    }

    /// Number of negative entries of D, which equals the number of negative eigenvalues.
    pub fn negative(&self) -> usize {
        self.pivots.iter().filter(|pivot| **pivot < 0.0).count()
    }

    /// D.
    pub fn pivots(&self) -> &[f64] {
        &self.pivots
    }

    /// `x ← L⁻¹ x`.
    pub fn forward(&self, x: &mut [f64]) {
        vectorized!(forward(&self.fronts, x));
    }

    /// `x ← L⁻ᵀ x`.
    pub fn backward(&self, x: &mut [f64]) {
        vectorized!(backward(&self.fronts, x));
    }

    /// `x ← K⁻¹ x`.
    pub fn solve(&self, x: &mut [f64]) {
        self.forward(x);
        x.iter_mut().zip(&self.pivots).for_each(|(x, pivot)| *x /= pivot);
        self.backward(x);
    }
}

/// Number of right-hand sides that are solved together, so that the factors are read once for all.
pub const SIDES: usize = 8;

impl Fronts {
    /// `x ← D^{−½} L⁻¹ x` of several right-hand sides side by side, for positive D. The product of two results is that
    /// of the right-hand sides with `K⁻¹` between.
    pub fn halfway_together(&self, x: &mut [[f64; SIDES]]) {
        vectorized!(forward_together(&self.fronts, x));
        for (x, pivot) in x.iter_mut().zip(&self.pivots) {
            let scale = 1.0 / pivot.sqrt();
            x.iter_mut().for_each(|x| *x *= scale);
        }
    }
}

/// `x ← L⁻¹ x` of several right-hand sides, front after front.
#[inline(always)]
fn forward_together(fronts: &[Front], x: &mut [[f64; SIDES]]) {
    let mut own: Vec<[f64; SIDES]> = vec![];
    for front in fronts {
        own.clear();
        own.extend(front.unknowns.iter().map(|unknown| x[*unknown]));
        for (k, row) in front.rows.chunks_exact(front.unknowns.len()).enumerate() {
            let value = own[k];
            // A load at one place: all rows before it are 0.
            if value == [0.0; SIDES] {
                continue;
            }
            for (x, l) in own[k + 1..].iter_mut().zip(&row[k + 1..]) {
                (0..SIDES).for_each(|s| x[s] -= value[s] * l);
            }
        }
        front.unknowns.iter().zip(&own).for_each(|(unknown, own)| x[*unknown] = *own);
    }
}

/// `x ← L⁻¹ x`, front after front.
#[inline(always)]
fn forward(fronts: &[Front], x: &mut [f64]) {
    let mut own = vec![];
    for front in fronts {
        let size = front.unknowns.len();
        own.clear();
        own.extend(front.unknowns.iter().map(|unknown| x[*unknown]));
        for (k, row) in front.rows.chunks_exact(size).enumerate() {
            let value = own[k];
            own[k + 1..].iter_mut().zip(&row[k + 1..]).for_each(|(x, l)| *x -= value * l);
        }
        front.unknowns.iter().zip(&own).for_each(|(unknown, own)| x[*unknown] = *own);
    }
}

/// `x ← L⁻ᵀ x`, front after front from the last.
#[inline(always)]
fn backward(fronts: &[Front], x: &mut [f64]) {
    let mut own = vec![];
    for front in fronts.iter().rev() {
        let size = front.unknowns.len();
        own.clear();
        own.extend(front.unknowns.iter().map(|unknown| x[*unknown]));
        for (k, row) in front.rows.chunks_exact(size).enumerate().rev() {
            own[k] -= dot(&row[k + 1..], &own[k + 1..]);
        }
        let eliminated = front.unknowns.iter().zip(&own).take(front.eliminated);
        eliminated.for_each(|(unknown, own)| x[*unknown] = *own);
    }
}

/// Number of rows eliminated together, so that the rest is read and written once for all.
const TOGETHER: usize = 8;

/// Eliminates the first unknowns of an upper triangle in place: rows of `Lᵀ` above, the remainder below. Returns the
/// pivots.
#[inline(always)]
fn eliminate(matrix: &mut [f64], size: usize, eliminated: usize) -> Vec<f64> {
    let mut pivots = Vec::with_capacity(eliminated);
    let mut first = 0;
    while first < eliminated {
        let last = (first + TOGETHER).min(eliminated);
        let (above, below) = matrix.split_at_mut(last * size);
        let block = &mut above[first * size..];
        // Inside the block, row by row; a row stays multiplied by D.
        for k in first..last {
            let pivot = block[(k - first) * size + k];
            pivots.push(pivot);
            let (done, rest) = block.split_at_mut((k + 1 - first) * size);
            let row = &done[(k - first) * size..];
            for (m, other) in rest.chunks_exact_mut(size).enumerate() {
                let i = k + 1 + m;
                let factor = row[i] / pivot;
                other[i..].iter_mut().zip(&row[i..]).for_each(|(x, r)| *x -= factor * r);
            }
        }
        let own = &pivots[first..];
        let mut rows = block.chunks_exact(size);
        let mut k = 0;
        if own.len() == TOGETHER {
            let rows: [&[f64]; TOGETHER] = std::array::from_fn(|_| rows.next().unwrap_or(&[]));
            subtract(rows, own, below, size, last);
            k = TOGETHER;
        } else if own.len() >= TOGETHER / 2 {
            let rows: [&[f64]; TOGETHER / 2] = std::array::from_fn(|_| rows.next().unwrap_or(&[]));
            subtract(rows, own, below, size, last);
            k = TOGETHER / 2;
        }
        for (row, pivot) in rows.zip(&own[k..]) {
            subtract([row], &[*pivot], below, size, last);
        }
        first = last;
    }
    for (k, row) in matrix.chunks_exact_mut(size).take(eliminated).enumerate() {
        let inverse = 1.0 / pivots[k];
        row[k..].iter_mut().for_each(|x| *x *= inverse);
    }
    pivots
}

/// Subtracts eliminated rows, which are D times their parts of `Lᵀ`, from the rows below them; the first of these is
/// row `first` of the matrix.
#[inline(always)]
fn subtract<const N: usize>(
    rows: [&[f64]; N],
    pivots: &[f64],
    below: &mut [f64],
    size: usize,
    first: usize,
) {
    let inverse: [f64; N] = std::array::from_fn(|k| 1.0 / pivots[k]);
    for (m, row) in below.chunks_exact_mut(size).enumerate() {
        let i = first + m;
        let factors: [f64; N] = std::array::from_fn(|k| rows[k][i] * inverse[k]);
        let row = &mut row[i..];
        let rows: [&[f64]; N] = std::array::from_fn(|k| &rows[k][i..size]);
        for j in 0..row.len() {
            let mut value = row[j];
            for k in 0..N {
                value -= factors[k] * rows[k][j];
            }
            row[j] = value;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two overlapping blocks of whole numbers, compared with the same matrix in one front.
    #[test]
    fn fronts_solve_and_count_as_one_block_does() {
        let entry = |i: usize, j: usize| {
            if i == j { 20.0 + i as f64 } else { ((3 * i + 5 * j) % 4) as f64 }
        };
        let block = |i: usize, j: usize| (i < 13 && j < 13) || (i >= 9 && j >= 9);
        for shift in [0.0, 25.0] {
            let value = |i: usize, j: usize| {
                let (i, j) = (i.min(j), i.max(j));
                let own = if block(i, j) { entry(i, j) } else { 0.0 };
                if i == j { own - shift } else { own }
            };
            let mut fronts = Fronts::new(21);
            let first = |unknowns: &[usize], eliminated, take, fronts: &mut Fronts, skip: usize| {
                let own = unknowns.to_vec();
                fronts.add(own.clone(), eliminated, take, |places, matrix| {
                    for i in &own {
                        for j in own.iter().filter(|j| *j >= i && **j >= skip) {
                            matrix[places[*i] * own.len() + places[*j]] += value(*i, *j);
                        }
                    }
                });
            };
            // The overlap, 9 to 12, belongs to the first block.
            first(&(0..13).collect::<Vec<_>>(), 9, true, &mut fronts, 0);
            first(&(9..21).collect::<Vec<_>>(), 12, true, &mut fronts, 13);
            let exact: Vec<f64> = (0..21).map(|k| ((7 * k) % 5) as f64 - 2.0).collect();
            let product_of = |i: usize| (0..21).map(|j| value(i, j) * exact[j]).sum::<f64>();
            let mut x: Vec<f64> = (0..21).map(product_of).collect();
            fronts.solve(&mut x);
            for (x, exact) in x.iter().zip(&exact) {
                assert!((x - exact).abs() < 1e-12, "{x} {exact}");
            }
            let mut several: Vec<[f64; SIDES]> = (0..21)
                .map(|i| {
                    std::array::from_fn(|s| if s == 1 { 0.0 } else { product_of(i) * s as f64 })
                })
                .collect();
            if shift == 0.0 {
                // Products of half solutions equal those with the inverse between.
                fronts.halfway_together(&mut several);
                let product = |s: usize, t: usize| several.iter().map(|x| x[s] * x[t]).sum::<f64>();
                let energy: f64 = (0..21).map(|i| product_of(i) * exact[i]).sum();
                assert!((product(2, 3) / (6.0 * energy) - 1.0).abs() < 1e-12);
                assert_eq!(product(1, 3), 0.0);
            }
            let mut whole = Fronts::new(21);
            first(&(0..21).collect::<Vec<_>>(), 21, true, &mut whole, 0);
            assert_eq!(fronts.negative(), whole.negative());
            assert_eq!(fronts.negative() > 0, shift > 0.0);
        }
    }
}
