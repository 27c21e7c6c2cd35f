//! Which of the random numbers make an answer vary?
//!
//! The answer is a sum of polynomials in the independent numbers behind a row, each orthonormal in its number
//! (Hermite's in a normal score, Legendre's in a share), fitted to the rows:
//!
//! ```text
//! y ≈ Σ c_a Π ψ_{a_i}(ξ_i)          V = Σ_{a≠0} c_a²
//! first order  S_i = Σ c_a²/V over those in ξ_i alone
//! total        T_i = Σ c_a²/V over all those with ξ_i in them
//! ```
//!
//! of the highest degree with four rows for each coefficient. The mean square that the polynomials do not follow is
//! added to V and reported as a separate share. Errors are those of a jackknife that leaves out one of sixteen groups
//! of rows; the groups are random, because evenly spaced rows would be as even as the whole. Of correlated numbers, the
//! later one counts with the earlier ones known.
//!
//! # Source
//!
//! B. Sudret, "Global sensitivity analysis using polynomial chaos expansions", Reliability Engineering and
//! System Safety 93 (2008) 964, Eqs 36 to 39. B. Efron, "The Jackknife, the Bootstrap and Other Resampling
//! Plans" (SIAM, 1982), Eq. 3.1.

use serde::Serialize;

use crate::engine::dot;
use crate::many::hash::mixed;

/// Coefficients per row that a fit may have, and coefficients at most.
const ROWS_A_TERM: usize = 4;
const MOST_TERMS: usize = 300;
/// Highest degree, and the number of groups of rows.
const MOST_DEGREE: usize = 10;
const GROUPS: usize = 16;

/// The kind of a random input, as an independent number ξ with its polynomials.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VariateKind {
    /// A normal score; Hermite's polynomials.
    Score,
    /// A share between 0 and 1; Legendre's polynomials.
    Share,
}

/// A share of a variance.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Share {
    /// The share.
    pub value: f64,
    /// Standard deviation due to sampling.
    pub sd: f64,
}

/// Shares of a variance, by a polynomial surface in the inputs.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Indices {
    /// Degree of the surface.
    pub degree: usize,
    /// Rows that it was laid through.
    pub rows: usize,
    /// By each input alone (first order), in the order of the inputs.
    pub first: Vec<Share>,
    /// By each input, alone and with others (total).
    pub total: Vec<Share>,
    /// The share that the surface does not follow.
    pub unexplained: Share,
}

impl Indices {
    /// For rows of independent numbers with their answer; `None` if there are too few for a plane, or if the answer
    /// does not vary.
    pub fn new(kinds: &[VariateKind], rows: &[(Vec<f64>, f64)]) -> Option<Self> {
        Self::grouped(kinds, &(0..kinds.len()).collect::<Vec<_>>(), rows)
    }

    /// As [`Self::new`], for groups of numbers, given by 0, 1, … for each number: the effect within one group is of
    /// first order.
    pub fn grouped(
        kinds: &[VariateKind],
        groups: &[usize],
        rows: &[(Vec<f64>, f64)],
    ) -> Option<Self> {
        let of_each = groups;
        let degree = (1..=MOST_DEGREE).rev().find(|degree| {
            let terms = terms(kinds.len(), *degree);
            terms.is_some_and(|terms| terms <= MOST_TERMS && ROWS_A_TERM * terms <= rows.len())
        })?;
        let exponents = exponents(kinds.len(), degree);
        let mut groups = vec![RegressionSums::new(exponents.len()); GROUPS];
        let shift = rows.iter().map(|(_, y)| y).sum::<f64>() / rows.len() as f64;
        for (k, (numbers, y)) in rows.iter().enumerate() {
            groups[mixed(k as u64) as usize % GROUPS]
                .add(&values(kinds, numbers, &exponents, degree), y - shift);
        }
        let mut all = RegressionSums::new(exponents.len());
        groups.iter().for_each(|group| all.put(group, 1.0));
        let count = of_each.iter().map(|group| group + 1).max().unwrap_or(0);
        let of = |sums: &RegressionSums| shares(sums, &exponents, (of_each, count));
        let whole = of(&all)?;
        let mut parts = vec![];
        for group in &groups {
            let mut without = all.clone();
            without.put(group, -1.0);
            parts.push(of(&without)?);
        }
        let told = |k: usize| {
            let mean = parts.iter().map(|part| part[k]).sum::<f64>() / GROUPS as f64;
            let squares = parts.iter().map(|part| (part[k] - mean).powi(2)).sum::<f64>();
            let sd = (squares * (GROUPS - 1) as f64 / GROUPS as f64).sqrt();
            Share { value: whole[k], sd }
        };
        Some(Self {
            first: (0..count).map(told).collect(),
            total: (count..2 * count).map(told).collect(),
            unexplained: told(2 * count),
            degree,
            rows: rows.len(),
        })
    }
}

/// Number of polynomials of at most that degree in that number of variables: `(n + d)!/(n! d!)`.
fn terms(count: usize, degree: usize) -> Option<usize> {
    (1..=degree).try_fold(1_usize, |terms, k| Some(terms.checked_mul(count + k)? / k))
}

/// The degrees in each number, of every polynomial of at most that degree; the constant first.
fn exponents(count: usize, degree: usize) -> Vec<Vec<usize>> {
    let mut all = vec![vec![]];
    for _ in 0..count {
        let longer = |short: &Vec<usize>| {
            let left = degree - short.iter().sum::<usize>();
            let short = short.clone();
            (0..=left).map(move |k| [short.clone(), vec![k]].concat()).collect::<Vec<_>>()
        };
        all = all.iter().flat_map(longer).collect();
    }
    all.sort_by_key(|one| one.iter().sum::<usize>());
    all
}

/// Every polynomial at a row.
fn values(
    kinds: &[VariateKind],
    numbers: &[f64],
    exponents: &[Vec<usize>],
    degree: usize,
) -> Vec<f64> {
    let each = kinds.iter().zip(numbers).map(|(kind, x)| orthonormal(*kind, *x, degree));
    let each: Vec<Vec<f64>> = each.collect();
    let product = |one: &Vec<usize>| one.iter().zip(&each).map(|(k, of)| of[*k]).product();
    exponents.iter().map(product).collect()
}

/// ψ₀ to ψ_d: `He_k/√(k!)` of a score, `√(2k + 1) P_k(2u − 1)` of a share.
fn orthonormal(kind: VariateKind, x: f64, degree: usize) -> Vec<f64> {
    let x = if kind == VariateKind::Share { 2.0 * x - 1.0 } else { x };
    let (mut all, mut scale) = (vec![1.0, x], 1.0);
    for k in 1..degree {
        let n = k as f64;
        let (a, b) = (all[k], all[k - 1]);
        all.push(match kind {
            VariateKind::Score => x * a - n * b,
            VariateKind::Share => ((2.0 * n + 1.0) * x * a - n * b) / (n + 1.0),
        });
    }
    for (k, value) in all.iter_mut().enumerate() {
        let n = k as f64;
        match kind {
            VariateKind::Score => scale *= n.max(1.0),
            VariateKind::Share => scale = 1.0 / (2.0 * n + 1.0),
        }
        *value /= f64::sqrt(scale);
    }
    all
}

/// Sums over rows: of products of polynomials, of those with the answer, of the answer and its square.
#[derive(Clone)]
struct RegressionSums {
    products: Vec<Vec<f64>>,
    with_answer: Vec<f64>,
    answer: [f64; 3],
}

impl RegressionSums {
    fn new(terms: usize) -> Self {
        let products = (1..=terms).map(|k| vec![0.0; k]).collect();
        Self { products, with_answer: vec![0.0; terms], answer: [0.0; 3] }
    }

    fn add(&mut self, values: &[f64], y: f64) {
        for (row, a) in self.products.iter_mut().zip(values) {
            row.iter_mut().zip(values).for_each(|(sum, b)| *sum += a * b);
        }
        self.with_answer.iter_mut().zip(values).for_each(|(sum, a)| *sum += a * y);
        [1.0, y, y * y].iter().zip(&mut self.answer).for_each(|(more, sum)| *sum += more);
    }

    fn put(&mut self, other: &Self, sign: f64) {
        let rows = self.products.iter_mut().zip(&other.products);
        let put = |(to, from): (&mut f64, &f64)| *to += sign * from;
        rows.for_each(|(to, from)| to.iter_mut().zip(from).for_each(put));
        self.with_answer.iter_mut().zip(&other.with_answer).for_each(put);
        self.answer.iter_mut().zip(&other.answer).for_each(put);
    }

    /// The coefficients with the least squares, by Cholesky's factor of the normal equations.
    fn coefficients(&self) -> Option<Vec<f64>> {
        let mut factor = self.products.clone();
        for i in 0..factor.len() {
            let (above, here) = factor.split_at_mut(i);
            let row = &mut here[0];
            for (j, other) in above.iter().enumerate() {
                row[j] = (row[j] - dot(&row[..j], &other[..j])) / other[j];
            }
            let left = row[i] - dot(&row[..i], &row[..i]);
            // Rows without information about a polynomial.
            if left <= 1e-10 * row[i] {
                return None;
            }
            row[i] = left.sqrt();
        }
        let mut c = self.with_answer.clone();
        for i in 0..c.len() {
            c[i] = (c[i] - dot(&factor[i][..i], &c[..i])) / factor[i][i];
        }
        for i in (0..c.len()).rev() {
            let later: f64 = (i + 1..c.len()).map(|k| factor[k][i] * c[k]).sum();
            c[i] = (c[i] - later) / factor[i][i];
        }
        Some(c)
    }
}

/// First-order shares, total shares, and what is left.
fn shares(
    sums: &RegressionSums,
    exponents: &[Vec<usize>],
    (groups, count): (&[usize], usize),
) -> Option<Vec<f64>> {
    let c = sums.coefficients()?;
    let [rows, sum, squares] = sums.answer;
    // Round-off of an answer that is the same for all.
    if squares / rows - (sum / rows).powi(2) <= 1e-26 * (squares / rows) {
        return None;
    }
    let left = (squares - dot(&c, &sums.with_answer)).max(0.0) / (rows - c.len() as f64);
    let variance = left + dot(&c[1..], &c[1..]);
    let mut all = vec![0.0; 2 * count + 1];
    all[2 * count] = left / variance;
    for (one, c) in exponents.iter().zip(&c).skip(1) {
        let share = c * c / variance;
        let mut used: Vec<usize> =
            groups.iter().zip(one).filter(|(_, k)| **k > 0).map(|(group, _)| *group).collect();
        used.sort_unstable();
        used.dedup();
        used.iter().for_each(|k| all[count + k] += share);
        if let [only] = used[..] {
            all[only] += share;
        }
    }
    Some(all)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::many::sobol::Sobol;

    fn rows(
        count: usize,
        of: impl Fn(&[f64]) -> f64,
        kinds: &[VariateKind],
    ) -> Vec<(Vec<f64>, f64)> {
        let sobol = Sobol::new(kinds.len(), 3);
        let row = |k: usize| {
            let shares = (0..kinds.len()).map(|c| sobol.at(k as u64, c));
            let numbers: Vec<f64> = shares.collect();
            let y = of(&numbers);
            (numbers, y)
        };
        (0..count).map(row).collect()
    }

    /// Ishigami's function with a = 7 and b = 0.1: T. Ishigami, T. Homma, Proc. ISUMA (1990) 398.
    #[test]
    fn ishigamis_function_has_its_known_indices() {
        let ishigami = |u: &[f64]| {
            let x = [0, 1, 2].map(|k| PI * (2.0 * u[k] - 1.0));
            x[0].sin() + 7.0 * x[1].sin().powi(2) + 0.1 * x[2].powi(4) * x[0].sin()
        };
        let kinds = [VariateKind::Share; 3];
        let (a, b, pi4) = (7.0_f64, 0.1, PI.powi(4));
        let v1 = 0.5 * (1.0 + b * pi4 / 5.0).powi(2);
        let (v2, v13) = (a * a / 8.0, b * b * pi4 * pi4 * (1.0 / 18.0 - 1.0 / 50.0));
        let v = v1 + v2 + v13;
        let found = Indices::new(&kinds, &rows(4096, ishigami, &kinds)).unwrap();
        let first = [v1 / v, v2 / v, 0.0];
        let total = [(v1 + v13) / v, v2 / v, v13 / v];
        for (found, known) in found.first.iter().zip(first).chain(found.total.iter().zip(total)) {
            let off = (found.value - known).abs();
            assert!(off < 2e-3 && off < 4.0 * found.sd + 2e-3, "{found:?} {known}");
        }
        assert!(found.unexplained.value.abs() < 2e-3, "{:?}", found.unexplained);
        assert_eq!(found.degree, 10);
    }

    /// `y = 3 z₁ + 4 z₂ + z₁ z₂` of normal scores has the variances 9, 16 and 1.
    #[test]
    fn a_product_of_scores_is_shared_by_both() {
        let kinds = [VariateKind::Score; 2];
        let score = crate::many::distribution::standard_normal;
        let mut rows = rows(512, |_| 0.0, &kinds);
        for (numbers, y) in &mut rows {
            numbers.iter_mut().for_each(|u| *u = score(*u));
            *y = 3.0 * numbers[0] + 4.0 * numbers[1] + numbers[0] * numbers[1];
        }
        let found = Indices::new(&kinds, &rows).unwrap();
        for (share, known) in [
            (found.first[0], 9.0),
            (found.first[1], 16.0),
            (found.total[0], 10.0),
            (found.total[1], 17.0),
        ] {
            assert!((share.value - known / 26.0).abs() < 0.02, "{share:?} {known}");
        }
    }

    #[test]
    fn too_few_rows_and_what_does_not_vary_have_no_indices() {
        let kinds = [VariateKind::Share; 3];
        assert!(Indices::new(&kinds, &rows(15, |u| u[0], &kinds)).is_none());
        assert!(Indices::new(&kinds, &rows(64, |_| 0.3, &kinds)).is_none());
        assert!(Indices::new(&[], &[]).is_none());
    }
}
