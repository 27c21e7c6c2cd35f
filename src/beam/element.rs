//! What does one element store? Strain energy and kinetic energy of a deflection of degree p.
//!
//! On an element of length `h`, with ξ from −1 to 1 and `P_j` the Legendre polynomials, the unknowns are strains. The
//! curvature is `θ′ = Σ c_j P_j`. In a beam that shears, the shear strain is `w′ − θ = Σ g_j P_j`, also with
//! `j = 0 … p−2`. Rotation and deflection follow by integration from the left end,
//!
//! ```text
//! θ = θₗ + (h/2) Σ c_j ∫P_j,   w = wₗ + (h/2) ∫(θ + Σ g_j P_j),   ∫P_j = (P_{j+1} − P_{j−1})/(2j + 1).
//! ```
//!
//! Without shear this is the Hermite space of degree p in terms of strains. It is the limit of the space with shear for
//! G → ∞: the shear strains become small and nothing else changes, so a slender beam neither locks nor loses digits.
//! [`Element::hermite`] gives the usual matrices of `[w₁, θ₁, w₂, θ₂]` and of the bubbles between, as a change of basis
//! of the same blocks.
//!
//! `N = p + 1` is the number of Legendre polynomials in a deflection, `N − 2` the number of
//! coefficients of a strain, `W` the number of all strains of an element plus 2: `N` without shear,
//! `2N − 2` with it.

use crate::base::{Over, Real};
use crate::beam::rule::{MOST_POINTS, Rule};

/// Coefficients of `P_0 … P_{N−1}`, or as many other numbers.
pub type Vector<R, const N: usize> = [R; N];
/// `N` rows of `N` numbers.
pub type Matrix<R, const N: usize> = [[R; N]; N];

/// The energies of one element.
#[derive(Debug, Clone, Copy)]
pub struct Element<R, const N: usize, const W: usize> {
    /// Length h (m).
    pub length: R,
    /// Position of the middle from the knob end (m).
    pub middle: R,
    /// Stiffness of the curvature `D_jk = ∫EI P_j P_k dx` (N m³), `j, k < N − 2`.
    pub stiffness: Matrix<R, N>,
    /// Mass `∫ρA P_k P_l dx` (kg).
    pub mass: Matrix<R, N>,
    /// Rotary inertia and shear; `None` for the Euler–Bernoulli beam.
    pub beyond: Option<Beyond<R, N>>,
}

/// The contribution of rotary inertia and shear to an element.
#[derive(Debug, Clone, Copy)]
pub struct Beyond<R, const N: usize> {
    /// Mass of the rotation `∫ρI P_k P_l dx` (kg m²), `k, l < N − 1`.
    pub turning: Matrix<R, N>,
    /// Stiffness of the shear strain `∫κGA P_j P_k dx` (N m), `j, k < N − 2`; 0 without shear.
    pub shear: Matrix<R, N>,
}

/// Stiffness and mass of the sections at the points of the rule, one list for each number; the last two are empty if
/// the theory does not need them.
#[derive(Debug, Clone, Copy)]
pub struct Samples<'a, R> {
    /// EI (N m²).
    pub bending: &'a [R],
    /// ρA (kg/m).
    pub mass: &'a [R],
    /// ρI (kg m).
    pub turning: &'a [R],
    /// κGA (N).
    pub shear: &'a [R],
}

/// Room for the Legendre polynomials of a deflection of any degree.
pub const MOST_TERMS: usize = 13;
/// Room for the strains of an element of any degree and theory.
pub const MOST_STRAINS: usize = 2 * MOST_TERMS - 4;
/// Room for these plus the deflection and rotation at the inner end.
pub const MOST_WIDTH: usize = MOST_STRAINS + 2;

/// `1/(2k + 1)`.
const ODD: [f64; 16] = {
    let mut odd = [0.0; 16];
    let mut k = 0;
    while k < 16 {
        odd[k] = 1.0 / (2 * k + 1) as f64;
        k += 1;
    }
    odd
};

/// Legendre coefficients of deflection (m) and rotation (rad) of an element of length `h` with those strains, curvature
/// before shear, whose left end has deflection `w` and rotation `theta`.
#[inline(always)]
pub fn integrated<S: Real, R: Over<S>>(
    h: S,
    strains: &[R],
    [w, theta]: [R; 2],
    shape: &mut [R],
    turn: &mut [R],
) {
    let half = S::splat(0.5) * h;
    let (zero, n) = (R::default(), shape.len());
    let integral = |below: R, k: usize, above: R| {
        (R::splat(ODD[k - 1]) * below - R::splat(ODD[k + 1]) * above) * half
    };
    let (bent, sheared) = strains.split_at(n - 2);
    turn[0] = theta + (bent[0] - R::splat(ODD[1]) * bent[1]) * half;
    for k in 1..n - 1 {
        turn[k] = integral(bent[k - 1], k, if k + 1 < n - 2 { bent[k + 1] } else { zero });
    }
    turn[n - 1] = zero;
    let mut slope = [zero; MOST_TERMS];
    slope[..n].copy_from_slice(turn);
    for (slope, g) in slope.iter_mut().zip(sheared) {
        *slope += *g;
    }
    shape[0] = w + (slope[0] - R::splat(ODD[1]) * slope[1]) * half;
    for k in 1..n {
        shape[k] = integral(slope[k - 1], k, if k + 1 < n { slope[k + 1] } else { zero });
    }
}

/// The adjoint of [`integrated`] for its deflection: turns loads on the Legendre polynomials into loads on the strains
/// and, in the last two places, on `w` and `theta`.
#[inline(always)]
pub fn on_strains<R: Real>(h: R, load: &[R], on: &mut [R]) {
    let half = R::splat(0.5) * h;
    let (n, w) = (load.len(), on.len());
    let mut slope = [R::default(); MOST_TERMS];
    slope[0] = half * (load[1] + load[0]);
    for k in 1..n - 1 {
        slope[k] = half * R::splat(ODD[k]) * (load[k + 1] - load[k - 1]);
    }
    turning_on_strains(h, &slope[..n], on);
    if w > n {
        on[n - 2..w - 2].copy_from_slice(&slope[..n - 2]);
    }
    on[w - 2] = load[0];
}

/// The adjoint of [`integrated`] for its rotation: turns couples on the Legendre polynomials into loads on the strains
/// and, in the last place, on `theta`.
#[inline(always)]
pub fn turning_on_strains<R: Real>(h: R, load: &[R], on: &mut [R]) {
    let half = R::splat(0.5) * h;
    let (n, w) = (load.len(), on.len());
    on.fill(R::default());
    on[0] = half * (load[1] + load[0]);
    for k in 1..n - 2 {
        on[k] = half * R::splat(ODD[k]) * (load[k + 1] - load[k - 1]);
    }
    on[w - 1] = load[0];
}

/// `∫ value P_k P_l dx` of numbers at the points, for `k, l` below a count; row by row, so that a row's sums stay in
/// registers.
#[inline(always)]
fn squares<R: Real, const N: usize>(
    length: R,
    rule: &Rule,
    values: &[R],
    count: usize,
) -> Matrix<R, N> {
    let (mut matrix, mut shares) = ([[R::default(); N]; N], [R::default(); MOST_POINTS]);
    for ((share, value), point) in shares.iter_mut().zip(values).zip(&rule.points) {
        *share = R::splat(point.weight) * length * *value;
    }
    for k in 0..count {
        let mut row = [R::default(); N];
        for (i, share) in shares[..values.len()].iter().enumerate() {
            let p = rule.at::<N>(i);
            let part = *share * R::splat(p[k]);
            for l in 0..count {
                row[l] += part * R::splat(p[l]);
            }
        }
        matrix[k] = row;
    }
    matrix
}

impl<R: Real, const N: usize, const W: usize> Element<R, N, W> {
    /// The energies, from the sections at the points of the rule.
    #[inline(always)]
    pub fn new(length: R, middle: R, rule: &Rule, samples: Samples<R>) -> Self {
        let stiffness = squares(length, rule, samples.bending, N - 2);
        let mass = squares(length, rule, samples.mass, N);
        let beyond = match samples.turning {
            [] => None,
            turning => {
                let turning = squares(length, rule, turning, N - 1);
                Some(Beyond { turning, shear: squares(length, rule, samples.shear, N - 2) })
            }
        };
        Self { length, middle, stiffness, mass, beyond }
    }

    /// Writes `L⁻¹` of the stiffness `D = L Lᵀ` in that unit of energy: lower triangular, in blocks of curvature and
    /// shear.
    #[inline(always)]
    pub fn invert_factor(&self, unit: R, inverse: &mut Matrix<R, W>) {
        invert_factor::<R, N, W>(&self.stiffness, unit, inverse, 0);
        if let Some(beyond) = self.beyond.as_ref().filter(|_| W > N) {
            invert_factor::<R, N, W>(&beyond.shear, unit, inverse, N - 2);
        }
    }

    /// Writes the element in the form of the running sums, in strains scaled by that `L⁻¹`.
    #[inline(always)]
    pub fn connect(&self, inverse: &Matrix<R, W>, link: &mut Link<R, W>) {
        let (n, h) = (N - 2, self.length);
        // ∂T/∂(strains, w, θ) of every deflection polynomial, then of every strain.
        let zero = R::default();
        let mut rows = [[zero; W]; N];
        let mut columns = [[zero; W]; W];
        for k in 0..N {
            on_strains(h, &self.mass[k], &mut rows[k]);
        }
        for j in 0..W {
            let mut column = [zero; N];
            for k in 0..N {
                column[k] = rows[k][j];
            }
            on_strains(h, &column, &mut columns[j]);
        }
        if let Some(beyond) = &self.beyond {
            beyond.add(h, &mut columns);
        }
        // Scales from the left, row by row, then from the right.
        let mut left = columns;
        for i in 0..W - 2 {
            left[i] = [zero; W];
            for k in i / n * n..=i {
                for j in 0..W {
                    left[i][j] += inverse[i][k] * columns[k][j];
                }
            }
        }
        for row in 0..W {
            for i in 0..W - 2 {
                let mut entry = zero;
                for k in i / n * n..=i {
                    entry += left[row][k] * inverse[i][k];
                }
                link.mass[row][i] = entry;
            }
            link.mass[row][W - 2..].copy_from_slice(&left[row][W - 2..]);
        }
        for i in 0..n {
            let second = if i > 0 { R::splat(ODD[1]) * inverse[i][1] } else { zero };
            link.turn[i] = h * inverse[i][0];
            link.lift[i] = R::splat(0.5) * h * h * (inverse[i][0] - second);
        }
        for i in n..W - 2 {
            link.turn[i] = zero;
            link.lift[i] = h * inverse[i][n];
        }
        link.length = h;
    }
}

/// Writes `L⁻¹` of one block into its place from row and column `first` on.
#[inline(always)]
fn invert_factor<R: Real, const N: usize, const W: usize>(
    stiffness: &Matrix<R, N>,
    unit: R,
    inverse: &mut Matrix<R, W>,
    first: usize,
) {
    let n = N - 2;
    let zero = R::default();
    let scale = R::splat(1.0) / unit;
    let mut factor = [[zero; N]; N];
    for j in 0..n {
        let mut pivot = stiffness[j][j] * scale;
        for k in 0..j {
            pivot -= factor[j][k] * factor[j][k];
        }
        inverse[first + j][first + j] = R::splat(1.0) / pivot.sqrt();
        for i in j + 1..n {
            let mut entry = stiffness[i][j] * scale;
            for k in 0..j {
                entry -= factor[i][k] * factor[j][k];
            }
            factor[i][j] = entry * inverse[first + j][first + j];
        }
    }
    for i in 1..n {
        for j in 0..i {
            let mut entry = zero;
            for k in j..i {
                entry += factor[i][k] * inverse[first + k][first + j];
            }
            inverse[first + i][first + j] = -(entry * inverse[first + i][first + i]);
        }
    }
}

impl<R: Real, const N: usize> Beyond<R, N> {
    /// Adds the rotary inertia to the mass matrix of `(strains, w, θ)`.
    #[inline(always)]
    fn add<const W: usize>(&self, h: R, columns: &mut Matrix<R, W>) {
        let mut rows = [[R::default(); W]; N];
        for k in 0..N - 1 {
            turning_on_strains(h, &self.turning[k], &mut rows[k]);
        }
        for j in 0..W {
            let mut column = [R::default(); N];
            for k in 0..N - 1 {
                column[k] = rows[k][j];
            }
            let mut on = [R::default(); W];
            turning_on_strains(h, &column, &mut on);
            for k in 0..W {
                columns[j][k] += on[k];
            }
        }
    }
}

/// One element in the form of the running sums: its kinetic energy in its scaled strains `q` and the deflection and
/// rotation `(w, θ)` at its inner end, and the motion of its outer end.
#[derive(Debug, Clone, Copy)]
pub struct Link<R, const W: usize> {
    /// Mass matrix of `(q₀ … q_{W−3}, w, θ)`.
    pub mass: Matrix<R, W>,
    /// Contribution of its strains to the deflection at the outer end, `w_out = w + h θ + lift·q` (m); the last two
    /// places are not used.
    pub lift: Vector<R, W>,
    /// Their contribution to the rotation there, `θ_out = θ + turn·q` (rad).
    pub turn: Vector<R, W>,
    /// h (m).
    pub length: R,
}

impl<S: Real, const W: usize> Link<S, W> {
    /// The element's generalised loads `∂T/∂(q, w, θ)` in that motion (times ω²).
    #[inline(always)]
    pub fn load<R: Over<S>>(&self, motion: &Vector<R, W>) -> Vector<R, W> {
        let mut load = [R::default(); W];
        for (column, part) in self.mass.iter().zip(motion) {
            for (load, entry) in load.iter_mut().zip(column) {
                *load += *part * *entry;
            }
        }
        load
    }
}

/// `Σ_k a_k b_k` over the strains.
#[inline(always)]
pub fn over_strains<S, R: Over<S>, const W: usize>(a: &Vector<S, W>, b: &Vector<R, W>) -> R
where
    S: Real,
{
    let mut sum = R::default();
    for k in 0..W - 2 {
        sum += b[k] * a[k];
    }
    sum
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// A uniform element of length h with EI and ρA.
    pub(crate) fn uniform<const N: usize>(h: f64, bending: f64, line: f64) -> Element<f64, N, N> {
        let mut element = Element {
            length: h,
            middle: 0.5 * h,
            stiffness: [[0.0; N]; N],
            mass: [[0.0; N]; N],
            beyond: None,
        };
        for k in 0..N {
            element.mass[k][k] = line * h * ODD[k];
            if k < N - 2 {
                element.stiffness[k][k] = bending * h * ODD[k];
            }
        }
        element
    }

    #[test]
    fn the_inverse_factor_is_that_of_the_stiffness() {
        let mut element = uniform::<7>(0.4, 3.0, 1.0);
        // An arbitrary symmetric positive matrix.
        for i in 0..5 {
            for j in 0..5 {
                element.stiffness[i][j] += 0.1 / (i + j + 1) as f64;
            }
        }
        let mut inverse = [[0.0; 7]; 7];
        element.invert_factor(2.0, &mut inverse);
        // L⁻¹ D L⁻ᵀ = 1 in that unit.
        for i in 0..5 {
            for j in 0..5 {
                let sum = |k: usize| -> f64 {
                    (0..5).map(|l| element.stiffness[k][l] * inverse[j][l]).sum()
                };
                let entry: f64 = (0..5).map(|k| inverse[i][k] * sum(k)).sum::<f64>() / 2.0;
                assert!((entry - f64::from(u8::from(i == j))).abs() < 1e-13, "{i} {j} {entry}");
            }
        }
    }
}
