//! Product of two vectors, two equations in two unknowns, inverse of a small matrix.

use crate::base::real::Real;

/// `xᵀy` in eight partial sums per block, so that the error does not grow with the length.
#[inline(always)]
pub fn dot<R: Real>(x: &[R], y: &[R]) -> R {
    let [product] = dots(x, y);
    product
}

/// `xᵀy` of `Q` vectors x that follow one after the other, each as [`dot`]; y is read once for all.
///
/// Written as plain loops: where the length is known at the call, the compiler unrolls them and only the products
/// remain.
#[inline(always)]
pub fn dots<R: Real, const Q: usize>(x: &[R], y: &[R]) -> [R; Q] {
    const BLOCK: usize = 1024;
    debug_assert_eq!(x.len(), Q * y.len());
    let (length, mut totals, mut from) = (y.len(), [R::default(); Q], 0);
    while from < length {
        let end = length.min(from + BLOCK);
        let mut blocks = [&y[from..end]; Q];
        for q in 0..Q {
            blocks[q] = &x[q * length + from..q * length + end];
        }
        let products = short_dots(blocks, &y[from..end]);
        for q in 0..Q {
            totals[q] += products[q];
        }
        from = end;
    }
    totals
}

#[inline(always)]
fn short_dots<R: Real, const Q: usize>(x: [&[R]; Q], y: &[R]) -> [R; Q] {
    const SUMS: usize = 8;
    let whole = y.len() / SUMS * SUMS;
    let mut sums = [[R::default(); SUMS]; Q];
    // Plain numbers: the partial sums fill one vector. Where each number is a vector itself, the registers hold one of
    // the eight partial sums at a time.
    let (outer, inner) = if R::LANES == 1 { (1, SUMS) } else { (SUMS, 1) };
    for first in 0..outer {
        let mut own = [[R::default(); SUMS]; Q];
        let mut from = first;
        while from < whole {
            for q in 0..Q {
                let (x, y) = (&x[q][from..from + inner], &y[from..from + inner]);
                for k in 0..inner {
                    own[q][k] += x[k] * y[k];
                }
            }
            from += SUMS;
        }
        for q in 0..Q {
            for k in 0..inner {
                sums[q][first + k] = own[q][k];
            }
        }
    }
    let mut products = [R::default(); Q];
    for q in 0..Q {
        for k in whole..y.len() {
            products[q] += x[q][k] * y[k];
        }
        let [a, b, c, d, e, f, g, h] = sums[q];
        products[q] += ((a + b) + (c + d)) + ((e + f) + (g + h));
    }
    products
}

/// `a d − b c` of `[[a, b], [c, d]]`.
pub fn determinant([[a, b], [c, d]]: [[f64; 2]; 2]) -> f64 {
    a * d - b * c
}

/// The solution of two linear equations, by Cramer's rule.
pub fn solve_two(matrix: [[f64; 2]; 2], [e, f]: [f64; 2]) -> [f64; 2] {
    let ([[a, b], [c, d]], det) = (matrix, determinant(matrix));
    [(d * e - b * f) / det, (a * f - c * e) / det]
}

/// The inverse of a small symmetric positive definite matrix, by Cholesky's factor; None for any other.
pub fn inverse(matrix: &[Vec<f64>]) -> Option<Vec<Vec<f64>>> {
    let n = matrix.len();
    let mut factor = vec![vec![0.0; n]; n];
    for i in 0..n {
        for j in 0..=i {
            let left = matrix[i][j] - (0..j).map(|k| factor[i][k] * factor[j][k]).sum::<f64>();
            factor[i][j] = match i == j {
                true if left > 0.0 => left.sqrt(),
                true => return None,
                false => left / factor[j][j],
            };
        }
    }
    let mut inverse = vec![vec![0.0; n]; n];
    for column in 0..n {
        let mut x = vec![0.0; n];
        for i in 0..n {
            let right = if i == column { 1.0 } else { 0.0 };
            x[i] = (right - (0..i).map(|k| factor[i][k] * x[k]).sum::<f64>()) / factor[i][i];
        }
        for i in (0..n).rev() {
            x[i] = (x[i] - (i + 1..n).map(|k| factor[k][i] * x[k]).sum::<f64>()) / factor[i][i];
        }
        (0..n).for_each(|i| inverse[i][column] = x[i]);
    }
    Some(inverse)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whole numbers have no rounding.
    #[test]
    fn a_product_is_the_sum_of_all_products_however_long() {
        for length in [0, 1, 7, 8, 9, 1023, 1024, 1025, 5000] {
            let x: Vec<f64> = (0..length).map(|k| ((7 * k) % 19) as f64 - 9.0).collect();
            let y: Vec<f64> = (0..length).map(|k| ((5 * k) % 23) as f64 - 11.0).collect();
            let exact: f64 = x.iter().zip(&y).map(|(x, y)| x * y).sum();
            assert_eq!(dot(&x, &y), exact, "{length}");
            let three = [&x[..], &y[..], &x[..]].concat();
            assert_eq!(dots(&three, &y), [exact, dot(&y, &y), exact], "{length}");
        }
    }

    #[test]
    fn two_equations_hold_for_their_solution() {
        let [x, y] = solve_two([[2.0, 1.0], [-3.0, 4.0]], [1.0, 15.0]);
        assert_eq!([2.0 * x + y, -3.0 * x + 4.0 * y], [1.0, 15.0]);
    }

    #[test]
    fn an_inverse_times_its_matrix_is_one_and_what_is_not_positive_has_none() {
        let matrix = vec![vec![4.0, 2.0, -1.0], vec![2.0, 3.0, 0.5], vec![-1.0, 0.5, 2.0]];
        let inverse = inverse(&matrix).unwrap();
        for i in 0..3 {
            for j in 0..3 {
                let product: f64 = (0..3).map(|k| matrix[i][k] * inverse[k][j]).sum();
                let one = if i == j { 1.0 } else { 0.0 };
                assert!((product - one).abs() < 1e-15, "{i} {j} {product}");
            }
        }
        assert!(super::inverse(&[vec![1.0, 2.0], vec![2.0, 1.0]]).is_none());
    }
}
