//! At which points is a polynomial known, and how are its Legendre coefficients had from there?
//!
//! `n` Gauss points integrate polynomials of degree `2n − 1` exactly, so that the values at them of a
//! polynomial of degree `d ≤ n − 1` give its coefficients `c_j = (2j + 1)/2 Σ_g w_g P_j(ξ_g) v_g`.

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

/// [`Gauss`] at the points above 0; `H` is half of `N`.
pub(super) struct Half<const H: usize, const N: usize> {
    pub points: [f64; H],
    pub weights: [f64; H],
    pub legendre: [[f64; H]; N],
    pub to_series: [[f64; H]; N],
}

impl<const H: usize, const N: usize> Half<H, N> {
    /// All points: `P_j(−ξ) = (−1)^j P_j(ξ)`.
    pub const fn whole(&self) -> Gauss<N> {
        let zeros = [[0.0; N]; N];
        let (mut legendre, mut to_series, mut j) = (zeros, zeros, 0);
        while j < N {
            legendre[j] = mirrored(&self.legendre[j], j % 2 == 1);
            to_series[j] = mirrored(&self.to_series[j], j % 2 == 1);
            j += 1;
        }
        Gauss {
            points: mirrored(&self.points, true),
            weights: mirrored(&self.weights, false),
            legendre,
            to_series,
        }
    }
}

/// Values at the points above 0 continued to those below it, with the opposite sign where they are odd.
const fn mirrored<const H: usize, const N: usize>(above: &[f64; H], odd: bool) -> [f64; N] {
    assert!(2 * H == N, "half as many points");
    let (mut all, mut k) = ([0.0; N], 0);
    while k < H {
        all[H + k] = above[k];
        all[H - 1 - k] = if odd { -above[k] } else { above[k] };
        k += 1;
    }
    all
}
