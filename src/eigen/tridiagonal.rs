//! Eigenpairs of a small symmetric tridiagonal matrix.

use crate::base::Real;

/// The eigenpairs and their memory, which the next problem reuses.
#[derive(Debug, Clone, Default)]
pub struct Tridiagonal<R> {
    d: Vec<R>,
    e: Vec<R>,
    /// Columns of the product of all rotations, one after the other.
    vectors: Vec<R>,
    /// The columns of the pairs, largest eigenvalue first.
    order: Vec<usize>,
    sorted: Vec<R>,
    values: Vec<R>,
}

/// Most sweeps for one eigenvalue. It takes two or three; EISPACK gives up after thirty.
const MOST_SWEEPS: usize = 60;

impl<R: Real> Tridiagonal<R> {
    /// Finds all eigenpairs of the matrix with that diagonal of n entries and the n − 1 off-diagonal entries; further
    /// entries of `off` are ignored.
    ///
    /// Implicit QL with Wilkinson's shift (Bowdler, Martin, Reinsch, Wilkinson, Numer. Math. 11 (1968) 293). It runs
    /// from the far end, because a Lanczos matrix is graded downwards and QL keeps the digits of matrices graded
    /// upwards. `None` if it does not converge, which only numbers beyond the range of f64 can cause.
    #[inline(always)]
    pub fn solve(&mut self, diagonal: &[R], off: &[R]) -> Option<()> {
        let n = diagonal.len();
        self.d.clear();
        self.d.extend(diagonal.iter().rev());
        self.e.clear();
        self.e.extend(off[..n - 1].iter().rev());
        self.e.push(R::default());
        self.vectors.clear();
        self.vectors.resize(n * n, R::default());
        (0..n).for_each(|k| self.vectors[k * n + k] = R::splat(1.0));
        for low in 0..n {
            for sweeps in 0.. {
                let ends = block_ends(&self.d, &self.e, low);
                if ends.within(R::splat(low as f64)) {
                    break;
                }
                if sweeps == MOST_SWEEPS {
                    return None;
                }
                sweep(&mut self.d, &mut self.e, &mut self.vectors, low, ends);
            }
        }
        self.sort();
        Some(())
    }

    /// Eigenvalue `k`, the largest first.
    #[inline(always)]
    pub fn value(&self, k: usize) -> R {
        self.values[k]
    }

    /// Component `row` of the unit eigenvector `k`.
    #[inline(always)]
    pub fn weight(&self, k: usize, row: usize) -> R {
        let n = self.d.len();
        self.sorted[k * n + (n - 1 - row)]
    }

    /// Values and vectors, largest first in every lane.
    #[inline(always)]
    fn sort(&mut self) {
        let n = self.d.len();
        self.values.clear();
        self.values.resize(n, R::default());
        self.sorted.clear();
        self.sorted.resize(n * n, R::default());
        for lane in 0..R::LANES {
            self.order.clear();
            self.order.extend(0..n);
            let d = &self.d;
            self.order.sort_unstable_by(|&a, &b| d[b].lane(lane).total_cmp(&d[a].lane(lane)));
            for (k, &column) in self.order.iter().enumerate() {
                self.values[k].set_lane(lane, d[column].lane(lane));
                let from = &self.vectors[column * n..(column + 1) * n];
                let to = &mut self.sorted[k * n..(k + 1) * n];
                to.iter_mut().zip(from).for_each(|(to, v)| to.set_lane(lane, v.lane(lane)));
            }
        }
    }
}

/// End of the unreduced block that begins at `low`, in every lane: `low` itself for a single eigenvalue.
#[inline(always)]
fn block_ends<R: Real>(d: &[R], e: &[R], low: usize) -> R {
    let last = d.len() - 1;
    let mut ends = R::splat(last as f64);
    for k in (low..last).rev() {
        let more = e[k].abs() - R::splat(0.5 * f64::EPSILON) * (d[k].abs() + d[k + 1].abs());
        ends = R::default().max(more).if_zero(R::splat(k as f64), ends);
    }
    ends
}

/// One implicit QL sweep on the block from `low` to its end, in every lane. The steps of a lane do not depend on the
/// other lanes, and end with its block.
#[inline(always)]
fn sweep<R: Real>(d: &mut [R], e: &mut [R], vectors: &mut [R], low: usize, ends: R) {
    let (zero, one) = (R::default(), R::splat(1.0));
    let (mut far, mut high) = (zero, low);
    for lane in 0..R::LANES {
        let end = ends.lane(lane) as usize;
        far.set_lane(lane, d[end].lane(lane));
        high = high.max(end);
    }
    let g = (d[low + 1] - d[low]) / (e[low] + e[low]);
    let begin = far - d[low] + e[low] / (g + (g * g + one).sqrt().copysign(g));
    let (mut g, mut sine, mut cosine, mut shift) = (begin, one, one, zero);
    let n = d.len();
    for i in (low..high).rev() {
        let place = R::splat((i + 1) as f64);
        // Zero in the lanes whose block extends beyond this place or ends here.
        let before = zero.max(place - ends);
        let whole = place.within(ends);
        let (f, b) = (sine * e[i], cosine * e[i]);
        let r = (f * f + g * g).sqrt();
        let inverse = one / r.if_zero(one, r);
        let next = [f * inverse, r.if_zero(one, g * inverse)];
        let inner = d[i + 1] - shift;
        let half = (d[i] - inner) * next[0] + (next[1] + next[1]) * b;
        let turned = next[0] * half;
        let (left, right) = vectors[i * n..(i + 2) * n].split_at_mut(n);
        if whole {
            [sine, cosine] = next;
            (e[i + 1], d[i + 1]) = (r, inner + turned);
            (shift, g) = (turned, next[1] * half - b);
            for (a, b) in left.iter_mut().zip(right) {
                (*a, *b) = (cosine * *a - sine * *b, sine * *a + cosine * *b);
            }
            continue;
        }
        let own = |new: R, old: R| before.if_zero(new, old);
        // If the block begins later, everything is as at its beginning.
        (sine, cosine) = (own(next[0], one), own(next[1], one));
        (e[i + 1], d[i + 1]) = (own(r, e[i + 1]), own(inner + turned, d[i + 1]));
        (shift, g) = (own(turned, zero), own(next[1] * half - b, begin));
        for (a, b) in left.iter_mut().zip(right) {
            let both = [cosine * *a - sine * *b, sine * *a + cosine * *b];
            (*a, *b) = (own(both[0], *a), own(both[1], *b));
        }
    }
    // A lane whose block is a single eigenvalue was not changed.
    let done = ends - R::splat(low as f64);
    d[low] = done.if_zero(d[low], d[low] - shift);
    e[low] = done.if_zero(e[low], g);
    for lane in 0..R::LANES {
        let end = ends.lane(lane) as usize;
        if end > low {
            e[end].set_lane(lane, 0.0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::lanes::{Lanes, WIDTH};
    use std::f64::consts::PI;

    /// Eigenvalues, largest first, and the components of their unit eigenvectors, `[pair][row]`.
    fn eigen(diagonal: &[f64], off: &[f64]) -> Option<(Vec<f64>, Vec<Vec<f64>>)> {
        let mut small = Tridiagonal::default();
        small.solve(diagonal, off)?;
        let rows = 0..diagonal.len();
        let vector = |k| rows.clone().map(|row| small.weight(k, row)).collect();
        Some((small.values.clone(), rows.clone().map(vector).collect()))
    }

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

    /// One matrix separates in the middle, one at its end, and one is diagonal already.
    #[test]
    fn a_lane_has_the_bits_that_it_has_alone() {
        const N: usize = 9;
        let entry = |lane: usize, k: usize| 0.1 + ((7 * k + 3 * lane) % 11) as f64;
        let beside = |lane: usize, k: usize| match lane {
            1 if k == 4 => 0.0,
            2 => 0.0,
            3 if k == N - 2 => 1e-18,
            _ => 0.3 + ((5 * k + lane) % 7) as f64,
        };
        let lanes = |of: &dyn Fn(usize, usize) -> f64, k: usize| {
            let mut value = Lanes::default();
            (0..WIDTH).for_each(|lane| value.set_lane(lane, of(lane, k)));
            value
        };
        let diagonal: Vec<Lanes> = (0..N).map(|k| lanes(&entry, k)).collect();
        let off: Vec<Lanes> = (0..N - 1).map(|k| lanes(&beside, k)).collect();
        let mut together = Tridiagonal::default();
        together.solve(&diagonal, &off).unwrap();
        for lane in 0..WIDTH {
            let diagonal: Vec<f64> = (0..N).map(|k| entry(lane, k)).collect();
            let off: Vec<f64> = (0..N - 1).map(|k| beside(lane, k)).collect();
            let (values, vectors) = eigen(&diagonal, &off).unwrap();
            for (k, value) in values.iter().enumerate() {
                assert_eq!(together.value(k).lane(lane), *value, "{lane} {k}");
                for (row, weight) in vectors[k].iter().enumerate() {
                    assert_eq!(together.weight(k, row).lane(lane), *weight, "{lane} {k}");
                }
            }
        }
    }

    #[test]
    fn small_eigenvalues_of_a_graded_matrix_keep_their_digits() {
        // The small eigenvalue of [[1, a], [a, b]] is the determinant divided by the large one.
        let (a, b) = (1e-6, 1e-6);
        let (values, _) = eigen(&[1.0, b], &[a]).unwrap();
        let exact = (b - a * a) / (1.0 + a * a / (1.0 - b));
        assert!((values[1] / exact - 1.0).abs() < 1e-15, "{:e} {:e}", values[1], exact);
    }
}
