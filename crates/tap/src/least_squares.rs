//! Least squares of a few unknowns.

/// The solution of a symmetric, positive system whose last column is the right side; None where it is singular.
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

/// The inverse of a symmetric, positive matrix; None where it is singular.
pub fn inverse(matrix: &[Vec<f64>]) -> Option<Vec<Vec<f64>>> {
    let column = |k: usize| {
        let with =
            |(i, row): (usize, &Vec<f64>)| row.iter().copied().chain([f64::from(i == k)]).collect();
        solve(matrix.iter().enumerate().map(with).collect())
    };
    (0..matrix.len()).map(column).collect()
}

/// What is left of `target` beside everything that the columns span (Gram and Schmidt, twice for round-off).
pub fn beside(mut columns: Vec<Vec<f64>>, mut target: Vec<f64>) -> Vec<f64> {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    for k in 0..columns.len() {
        let (done, rest) = columns.split_at_mut(k);
        let own = &mut rest[0];
        let before = dot(own, own).sqrt();
        for _ in 0..2 {
            for other in done.iter() {
                let share = dot(own, other);
                own.iter_mut().zip(other).for_each(|(a, b)| *a -= share * b);
            }
        }
        let size = dot(own, own).sqrt();
        let scale = if size > 1e-12 * before { 1.0 / size } else { 0.0 };
        own.iter_mut().for_each(|a| *a *= scale);
        for _ in 0..2 {
            let share = dot(&target, own);
            target.iter_mut().zip(own.iter()).for_each(|(a, b)| *a -= share * b);
        }
    }
    target
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
        let left = beside(vec![vec![1.0, 1.0, 1.0], vec![0.0, 1.0, 2.0]], vec![1.0, 0.0, 0.0]);
        for (left, exact) in left.iter().zip([1.0 / 6.0, -1.0 / 3.0, 1.0 / 6.0]) {
            assert!((left - exact).abs() < 1e-15);
        }
        assert_eq!(solve(vec![vec![0.0, 1.0]]), None);
    }
}
