//! At which points is a polynomial evaluated, and how do its Legendre coefficients follow?
//!
//! `n` Gauss points integrate polynomials of degree `2n − 1` exactly, so the values of a polynomial of degree
//! `d ≤ n − 1` at these points give its coefficients `c_j = (2j + 1)/2 Σ_g w_g P_j(ξ_g) v_g`.
//!
//! # Source
//!
//! `search/legendre_tables.py` writes the numbers from 60 digits; each is the double nearest to the true one. Tests
//! compare them with identities in twice the digits.

use std::array::from_fn;
use std::sync::LazyLock;

/// 24 points.
pub static GAUSS_24: LazyLock<Gauss<24>> =
    LazyLock::new(|| Gauss::of(include_str!("gauss_24.txt")));

/// 40 points.
pub static GAUSS_40: LazyLock<Gauss<40>> =
    LazyLock::new(|| Gauss::of(include_str!("gauss_40.txt")));

/// Gauss points on [−1, 1] with all that depends on them alone; every number is the double nearest to
/// the true one.
#[derive(Debug)]
pub struct Gauss<const N: usize> {
    /// The points `ξ_g`, rising.
    pub points: [f64; N],
    /// Their weights `w_g`, which add up to 2.
    pub weights: [f64; N],
    /// `P_j(ξ_g)`, polynomial by polynomial.
    pub legendre: [[f64; N]; N],
    /// `(2j + 1)/2 w_g P_j(ξ_g)`, polynomial by polynomial.
    pub to_series: [[f64; N]; N],
}

impl<const N: usize> Gauss<N> {
    /// Of rows in the order of the fields, at the points above 0: `P_j(−ξ) = (−1)^j P_j(ξ)`.
    fn of(text: &str) -> Self {
        let mut rows = text.lines().filter(|line| !line.starts_with('#'));
        let mut row = |odd: bool| {
            let row = rows.next().expect("a row for each of them");
            let above: Vec<f64> = row.split(' ').map(|x| x.parse().expect("a number")).collect();
            assert_eq!(2 * above.len(), N, "half as many points");
            let at = |k: usize| if k < N / 2 { N / 2 - 1 - k } else { k - N / 2 };
            from_fn(|k| if odd && k < N / 2 { -above[at(k)] } else { above[at(k)] })
        };
        Self {
            points: row(true),
            weights: row(false),
            legendre: from_fn(|j| row(j % 2 == 1)),
            to_series: from_fn(|j| row(j % 2 == 1)),
        }
    }
}
