//! Least squares of a few unknowns, and of columns of complex numbers.

use std::ops::{AddAssign, Mul};

use faer::c64;

/// The solution of a symmetric, positive system whose last column is the right side; `None` if it is singular.
pub fn solve(mut rows: Vec<Vec<f64>>) -> Option<Vec<f64>> {
    let count = rows.len();
    for i in 0..count {
        let pivot = rows[i][i];
        if !(pivot.is_finite() && pivot > 0.0) {
            return None;
        }
        let (above, below) = rows.split_at_mut(i + 1);
        for row in below {
            let factor = row[i] / pivot;
            row[i..].iter_mut().zip(&above[i][i..]).for_each(|(a, b)| *a -= factor * b);
        }
    }
    let mut solution = vec![0.0; count];
    for i in (0..count).rev() {
        let known: f64 = (i + 1..count).map(|j| rows[i][j] * solution[j]).sum();
        solution[i] = (rows[i][count] - known) / rows[i][i];
    }
    solution.iter().all(|x| x.is_finite()).then_some(solution)
}

/// The inverse of a symmetric, positive matrix; `None` if it is singular.
pub fn inverse(matrix: &[Vec<f64>]) -> Option<Vec<Vec<f64>>> {
    let column = |k: usize| {
        let with =
            |(i, row): (usize, &Vec<f64>)| row.iter().copied().chain([f64::from(i == k)]).collect();
        solve(matrix.iter().enumerate().map(with).collect())
    };
    (0..matrix.len()).map(column).collect()
}

/// The inner product `aᴴ b`, by which coefficients are complex.
pub fn dot(a: &[c64], b: &[c64]) -> c64 {
    a.iter().zip(b).map(|(a, b)| a.conj() * b).sum()
}

/// The real part of the inner product, by which coefficients are real.
pub fn real_dot(a: &[c64], b: &[c64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.re * b.re + a.im * b.im).sum()
}

/// Subtracts a multiple of a column from another one.
pub fn take<S: Copy>(from: &mut [c64], share: S, column: &[c64])
where
    c64: Mul<S, Output = c64>,
{
    from.iter_mut().zip(column).for_each(|(a, b)| *a -= *b * share);
}

/// Columns Q with `Qᴴ Q = 1` that span given ones, `Q R`, by Gram and Schmidt, twice for round-off.
pub struct Basis<S> {
    columns: Vec<Vec<c64>>,
    /// The columns of R down to the diagonal.
    pub triangle: Vec<Vec<S>>,
    dot: fn(&[c64], &[c64]) -> S,
}

impl<S: Copy + Default + AddAssign + From<f64>> Basis<S>
where
    c64: Mul<S, Output = c64>,
{
    /// The basis of these columns, by [`dot`] or [`real_dot`].
    pub fn of(columns: impl IntoIterator<Item = Vec<c64>>, dot: fn(&[c64], &[c64]) -> S) -> Self {
        /// A column with a smaller remainder depends on those before it.
        const LEAST: f64 = 1e-12;
        let mut basis = Self { columns: vec![], triangle: vec![], dot };
        for mut column in columns {
            let before = real_dot(&column, &column).sqrt();
            let mut shares = basis.take_off(&mut column);
            let again = basis.take_off(&mut column);
            shares.iter_mut().zip(again).for_each(|(sum, share)| *sum += share);
            let size = real_dot(&column, &column).sqrt();
            let scale = if size > LEAST * before { 1.0 / size } else { 0.0 };
            column.iter_mut().for_each(|a| *a *= scale);
            shares.push(size.max(LEAST * before).into());
            basis.columns.push(column);
            basis.triangle.push(shares);
        }
        basis
    }

    /// Removes from a target its projection on the columns; returns its components along Q.
    pub fn take_off(&self, target: &mut [c64]) -> Vec<S> {
        let mut share = |column: &Vec<c64>| {
            let share = (self.dot)(column, target);
            take(target, share, column);
            share
        };
        self.columns.iter().map(&mut share).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_system_an_inverse_and_what_is_left_are_as_their_definitions() {
        let matrix = vec![vec![4.0, 1.0], vec![1.0, 3.0]];
        let solution = solve(vec![vec![4.0, 1.0, 1.0], vec![1.0, 3.0, 2.0]]).unwrap();
        assert!(
            (solution[0] - 1.0 / 11.0).abs() < 1e-15 && (solution[1] - 7.0 / 11.0).abs() < 1e-15
        );
        let inverse = inverse(&matrix).unwrap();
        assert!((inverse[0][0] - 3.0 / 11.0).abs() < 1e-15);
        assert_eq!(solve(vec![vec![0.0, 1.0]]), None);
        let column = |values: [f64; 3]| values.map(|x| c64::new(x, -x)).to_vec();
        let columns = [column([1.0, 1.0, 1.0]), column([0.0, 1.0, 2.0])];
        let (mut real, mut complex) = (column([1.0, 0.0, 0.0]), column([1.0, 0.0, 0.0]));
        Basis::of(columns.clone(), real_dot).take_off(&mut real);
        Basis::of(columns, dot).take_off(&mut complex);
        for left in [real, complex] {
            for (left, exact) in left.iter().zip(column([1.0 / 6.0, -1.0 / 3.0, 1.0 / 6.0])) {
                assert!((left - exact).norm() < 1e-15);
            }
        }
    }
}
