//! Eigenpairs of a small symmetric tridiagonal matrix.

/// Eigenvalues, largest first, and the components of their unit eigenvectors, `[pair][row]`.
///
/// `diagonal` has n entries, `off` the n − 1 (or more; the rest is not read) beside it.
/// Implicit QL with Wilkinson's shift (Bowdler, Martin, Reinsch, Wilkinson, Numer. Math. 11
/// (1968) 293). Run from the far end, because a Lanczos matrix is graded downwards and QL keeps
/// the digits of matrices graded upwards. None if it does not settle, which only numbers beyond
/// the range of f64 can cause.
pub fn eigen(diagonal: &[f64], off: &[f64]) -> Option<(Vec<f64>, Vec<Vec<f64>>)> {
    let n = diagonal.len();
    let mut d: Vec<f64> = diagonal.iter().rev().copied().collect();
    let mut e: Vec<f64> = off[..n - 1].iter().rev().copied().chain([0.0]).collect();
    // Columns of the product of all rotations, one after the other.
    let mut vectors = vec![0.0; n * n];
    (0..n).for_each(|k| vectors[k * n + k] = 1.0);
    for low in 0..n {
        for sweeps in 0.. {
            let Some(high) = block_end(&d, &e, low) else { break };
            if sweeps == MOST_SWEEPS {
                return None;
            }
            sweep(&mut d, &mut e, &mut vectors, low, high);
        }
    }
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|&a, &b| d[b].total_cmp(&d[a]));
    let pair = |k: usize| vectors[k * n..(k + 1) * n].iter().rev().copied().collect();
    Some((order.iter().map(|&k| d[k]).collect(), order.iter().map(|&k| pair(k)).collect()))
}

/// An eigenvalue takes two sweeps or three; EISPACK gives up after thirty.
const MOST_SWEEPS: usize = 60;

/// The end of the unreduced block that begins at `low`, or None if it is a single eigenvalue.
fn block_end(d: &[f64], e: &[f64], low: usize) -> Option<usize> {
    let split = |k: &usize| e[*k].abs() <= f64::EPSILON * (d[*k].abs() + d[*k + 1].abs()) * 0.5;
    let high = (low..d.len() - 1).find(split).unwrap_or(d.len() - 1);
    (high > low).then_some(high)
}

/// One implicit QL sweep on the block from `low` to `high`.
fn sweep(d: &mut [f64], e: &mut [f64], vectors: &mut [f64], low: usize, high: usize) {
    let g = (d[low + 1] - d[low]) / (2.0 * e[low]);
    let mut g = d[high] - d[low] + e[low] / (g + (g * g + 1.0).sqrt().copysign(g));
    let (mut sine, mut cosine, mut shift) = (1.0, 1.0, 0.0);
    for i in (low..high).rev() {
        let (f, b) = (sine * e[i], cosine * e[i]);
        let r = (f * f + g * g).sqrt();
        e[i + 1] = r;
        if r == 0.0 {
            d[i + 1] -= shift;
            e[high] = 0.0;
            return;
        }
        let inverse = 1.0 / r;
        (sine, cosine) = (f * inverse, g * inverse);
        g = d[i + 1] - shift;
        let r = (d[i] - g) * sine + 2.0 * cosine * b;
        shift = sine * r;
        d[i + 1] = g + shift;
        g = cosine * r - b;
        let n = d.len();
        let (left, right) = vectors[i * n..(i + 2) * n].split_at_mut(n);
        for (a, b) in left.iter_mut().zip(right) {
            (*a, *b) = (cosine * *a - sine * *b, sine * *a + cosine * *b);
        }
    }
    d[low] -= shift;
    e[low] = g;
    e[high] = 0.0;
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn the_second_difference_has_its_known_eigenvalues() {
        // 2 − 2 cos(kπ/(n + 1)), the eigenvalues of tridiag(−1, 2, −1).
        let n = 25;
        let (values, vectors) = eigen(&vec![2.0; n], &vec![-1.0; n - 1]).unwrap();
        for (k, value) in values.iter().rev().enumerate() {
            let exact = 2.0 - 2.0 * ((k + 1) as f64 * PI / (n + 1) as f64).cos();
            assert!((value - exact).abs() < 1e-14, "{value} {exact}");
        }
        for (i, a) in vectors.iter().enumerate() {
            for (j, b) in vectors.iter().enumerate() {
                let product: f64 = a.iter().zip(b).map(|(a, b)| a * b).sum();
                assert!((product - f64::from(u8::from(i == j))).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn one_number_is_its_own_eigenvalue() {
        assert_eq!(eigen(&[3.0], &[]), Some((vec![3.0], vec![vec![1.0]])));
        assert_eq!(eigen(&[f64::NAN, 1.0], &[1.0]), None);
    }

    #[test]
    fn small_eigenvalues_of_a_graded_matrix_keep_their_digits() {
        // The small eigenvalue of [[1, a], [a, b]] is the determinant over the large one.
        let (a, b) = (1e-6, 1e-6);
        let (values, _) = eigen(&[1.0, b], &[a]).unwrap();
        let exact = (b - a * a) / (1.0 + a * a / (1.0 - b));
        assert!((values[1] / exact - 1.0).abs() < 1e-15, "{:e} {:e}", values[1], exact);
    }
}
