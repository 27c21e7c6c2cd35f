//! Where are points that fill a cube evenly, however many are taken?
//!
//! [`Sobol`] gives point k of Sobol's sequence, scrambled by Owen's nested permutations: a function of
//! seed, coordinate and k alone, so that any point can be had without the others. The first 2^m points
//! leave no elementary interval of their size empty, and each is uniform on the cube, so that means over
//! them have no bias.
//!
//! # Source
//!
//! I. M. Sobol, USSR Computational Mathematics and Mathematical Physics 7 (1967) 86: the sequence.
//! S. Joe, F. Y. Kuo, Constructing Sobol sequences with better two-dimensional projections, SIAM Journal
//! on Scientific Computing 30 (2008) 2635: the direction numbers, in `joe_kuo.txt`.
//! A. B. Owen, Randomly permuted (t,m,s)-nets and (t,s)-sequences (1995): the scramble.

use std::sync::LazyLock;

use crate::many::hash::{mixed, of};

/// Polynomial (its coefficients as bits) and first direction numbers of the second coordinate and those
/// after it.
static JOE_KUO: LazyLock<Vec<Vec<u64>>> = LazyLock::new(|| {
    let rows = include_str!("joe_kuo.txt").lines().filter(|line| !line.starts_with('#'));
    rows.map(|row| row.split(' ').map(|n| n.parse().expect("a number")).collect()).collect()
});

/// Most coordinates of a point.
pub const MOST_COORDINATES: usize = 64;

/// Sobol's sequence in a cube.
#[derive(Debug, Clone)]
pub struct Sobol {
    /// The 64 directions of each coordinate.
    directions: Vec<[u64; 64]>,
    seed: u64,
}

impl Sobol {
    /// A sequence with the given number of coordinates, at most [`MOST_COORDINATES`], scrambled with that seed.
    pub fn new(coordinates: usize, seed: u64) -> Self {
        Self { directions: (0..coordinates).map(directions).collect(), seed }
    }

    /// A coordinate of point k, strictly between 0 and 1.
    pub fn at(&self, k: u64, coordinate: usize) -> f64 {
        let own = of(self.seed, coordinate as u64, 0);
        between(scrambled(plain(&self.directions[coordinate], k), own))
    }
}

/// The middle of one of 2^53 equal parts of (0, 1).
pub fn between(bits: u64) -> f64 {
    ((bits >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
}

/// The directions of a coordinate, by the recurrence of its polynomial over the field of two numbers.
fn directions(coordinate: usize) -> [u64; 64] {
    let mut v = [0; 64];
    let own = coordinate.checked_sub(1).and_then(|k| JOE_KUO[k].split_first());
    let Some((polynomial, first)) = own else {
        v.iter_mut().enumerate().for_each(|(k, v)| *v = 1 << (63 - k));
        return v;
    };
    let degree = first.len();
    for k in 0..64 {
        if k < degree {
            v[k] = first[k] << (63 - k);
            continue;
        }
        v[k] = v[k - degree] ^ (v[k - degree] >> degree);
        for j in 1..degree {
            if polynomial >> (degree - j) & 1 == 1 {
                v[k] ^= v[k - j];
            }
        }
    }
    v
}

/// Point k before it is scrambled, as 64 bits after the point.
fn plain(directions: &[u64; 64], k: u64) -> u64 {
    let bits = (0..64).filter(|bit| k >> bit & 1 == 1);
    bits.fold(0, |sum, bit| sum ^ directions[bit])
}

/// Keeps or flips every bit, by a coin chosen by the bits before it.
fn scrambled(point: u64, seed: u64) -> u64 {
    // Which bits a number begins with: they make one node of a tree, whose root is 1.
    let coin = |bit: u32| mixed(seed ^ mixed(1 << bit | point.checked_shr(64 - bit).unwrap_or(0)));
    // Bits after the 53rd do not affect a number.
    (0..53).fold(point, |sum, bit| sum ^ (coin(bit) & 1) << (63 - bit))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The 2^m first points are one in each of 2^m equal parts of every coordinate, and in each box of
    /// the first two.
    #[test]
    fn every_part_of_a_coordinate_and_every_box_of_two_has_its_point() {
        for seed in [0, 7] {
            let sobol = Sobol::new(MOST_COORDINATES, seed);
            for m in [4_u32, 10] {
                let count = 1_usize << m;
                for coordinate in 0..MOST_COORDINATES {
                    let mut seen = vec![false; count];
                    for k in 0..count {
                        seen[(sobol.at(k as u64, coordinate) * count as f64) as usize] = true;
                    }
                    assert!(seen.iter().all(|seen| *seen), "{coordinate}");
                }
                for wide in 0..=m {
                    let [a, b] = [1_usize << wide, 1 << (m - wide)];
                    let mut seen = vec![false; count];
                    for k in 0..count as u64 {
                        let [i, j] = [(0, a), (1, b)].map(|(coordinate, parts)| {
                            (sobol.at(k, coordinate) * parts as f64) as usize
                        });
                        seen[i * b + j] = true;
                    }
                    assert!(seen.iter().all(|seen| *seen), "{wide} of {m}");
                }
            }
        }
    }

    /// The first points of five coordinates, unscrambled, by the published tables in their order.
    #[test]
    fn the_first_points_are_the_published_ones() {
        let known = [
            [0.0; 5],
            [0.5; 5],
            [0.25, 0.75, 0.75, 0.75, 0.25],
            [0.75, 0.25, 0.25, 0.25, 0.75],
            [0.125, 0.625, 0.375, 0.125, 0.125],
            [0.625, 0.125, 0.875, 0.625, 0.625],
            [0.375, 0.375, 0.625, 0.875, 0.375],
            [0.875, 0.875, 0.125, 0.375, 0.875],
        ];
        for (k, point) in known.iter().enumerate() {
            for (coordinate, value) in point.iter().enumerate() {
                let bits = plain(&directions(coordinate), k as u64);
                assert_eq!(bits as f64 / 2f64.powi(64), *value, "{k} {coordinate}");
            }
        }
    }

    /// The mean of a smooth function over n scrambled points has a far smaller error than over n random ones, and no
    /// bias over seeds.
    #[test]
    fn means_over_points_converge_fast_and_without_bias() {
        let mean = |seed: u64, count: u64| {
            let sobol = Sobol::new(4, seed);
            let value =
                |k: u64| (0..4).map(|c| 1.0 + 0.5 * (sobol.at(k, c) - 0.5)).product::<f64>();
            (0..count).map(value).sum::<f64>() / count as f64
        };
        let errors: Vec<f64> = (0..32).map(|seed| mean(seed, 1024) - 1.0).collect();
        let worst = errors.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
        let bias = errors.iter().sum::<f64>() / 32.0;
        // The error of 1024 random points is usually 9e-3.
        assert!(worst < 1e-4 && bias.abs() < 0.5 * worst, "{worst:e} {bias:e}");
    }
}
