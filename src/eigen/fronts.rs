//! How is a long matrix of small dense blocks factored, and how many eigenvalues lie below a shift?
//!
//! `K = L D Lᵀ`, block after block: a front holds the unknowns that are eliminated in it and those they touch,
//! and what is left of it (the complement of Schur) is added to a later one.
//!
//! # Source
//!
//! I. S. Duff, J. K. Reid, ACM Trans. Math. Softw. 9 (1983) 302: fronts. Sylvester's law of inertia: as many
//! entries of D are negative as eigenvalues of K.

use crate::base::linear::dot;

/// A dense block: its unknowns, and how many of them, from the first on, are eliminated.
#[derive(Debug, Clone)]
struct Front {
    unknowns: Vec<usize>,
    eliminated: usize,
    /// Rows of `Lᵀ`, as long as there are unknowns, the diagonal 1 included.
    rows: Vec<f64>,
}

/// The factors of a symmetric matrix.
#[derive(Debug, Clone, Default)]
pub struct Fronts {
    fronts: Vec<Front>,
    /// D, by unknown.
    pivots: Vec<f64>,
    /// What is left of fronts that no other has taken: unknowns and upper triangle.
    left: Vec<(Vec<usize>, Vec<f64>)>,
    /// Where an unknown stands in the front being made.
    places: Vec<usize>,
}

impl Fronts {
    /// No fronts yet, of a matrix of that size.
    pub fn new(size: usize) -> Self {
        Self { pivots: vec![0.0; size], places: vec![usize::MAX; size], ..Self::default() }
    }

    /// Adds a front whose first unknowns, so many, are eliminated. Its matrix is 0 but for what `fill` adds to
    /// the upper triangle, told where each unknown stands; if `take`, all that is left of earlier fronts is
    /// added.
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
        let pivots = eliminate(&mut matrix, size, eliminated);
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

    /// Number of negative entries of D, and with them of negative eigenvalues.
    pub fn negative(&self) -> usize {
        self.pivots.iter().filter(|pivot| **pivot < 0.0).count()
    }

    /// D.
    pub fn pivots(&self) -> &[f64] {
        &self.pivots
    }

    /// `x ← L⁻¹ x`.
    pub fn forward(&self, x: &mut [f64]) {
        let mut own = vec![];
        for front in &self.fronts {
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

    /// `x ← L⁻ᵀ x`.
    pub fn backward(&self, x: &mut [f64]) {
        let mut own = vec![];
        for front in self.fronts.iter().rev() {
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

    /// `x ← K⁻¹ x`.
    pub fn solve(&self, x: &mut [f64]) {
        self.forward(x);
        x.iter_mut().zip(&self.pivots).for_each(|(x, pivot)| *x /= pivot);
        self.backward(x);
    }
}

/// Rows that are eliminated together, so that the rest is read and written once for them.
const TOGETHER: usize = 4;

/// Eliminates the first unknowns of an upper triangle in place: rows of `Lᵀ` above, what is left below; the
/// pivots.
fn eliminate(matrix: &mut [f64], size: usize, eliminated: usize) -> Vec<f64> {
    let mut pivots = Vec::with_capacity(eliminated);
    let mut first = 0;
    while first < eliminated {
        let last = (first + TOGETHER).min(eliminated);
        let (above, below) = matrix.split_at_mut(last * size);
        let block = &mut above[first * size..];
        // Inside the block, row by row; a row stays D times its part of Lᵀ.
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
        if last - first == TOGETHER {
            let (a, rest) = block.split_at(size);
            let (b, rest) = rest.split_at(size);
            let (c, d) = rest.split_at(size);
            let inverse: [f64; TOGETHER] = std::array::from_fn(|k| 1.0 / pivots[first + k]);
            for (m, row) in below.chunks_exact_mut(size).enumerate() {
                let i = last + m;
                let f =
                    [a[i] * inverse[0], b[i] * inverse[1], c[i] * inverse[2], d[i] * inverse[3]];
                let rows = a[i..].iter().zip(&b[i..]).zip(&c[i..]).zip(&d[i..]);
                for (x, (((a, b), c), d)) in row[i..].iter_mut().zip(rows) {
                    *x = *x - f[0] * a - f[1] * b - f[2] * c - f[3] * d;
                }
            }
        } else {
            for (k, done) in block.chunks_exact(size).enumerate() {
                for (m, row) in below.chunks_exact_mut(size).enumerate() {
                    let i = last + m;
                    let factor = done[i] / pivots[first + k];
                    row[i..].iter_mut().zip(&done[i..]).for_each(|(x, r)| *x -= factor * r);
                }
            }
        }
        first = last;
    }
    for (k, row) in matrix.chunks_exact_mut(size).take(eliminated).enumerate() {
        row[k..].iter_mut().for_each(|x| *x /= pivots[k]);
    }
    pivots
}
