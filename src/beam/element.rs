//! What one element stores: strain energy and kinetic energy of a deflection of degree p.
//!
//! On an element of length `h`, with ξ from −1 to 1 and `P_j` the Legendre polynomials, the
//! unknowns are strains: the curvature is `θ′ = Σ c_j P_j`, `j = 0 … p−2`, and slope and
//! deflection follow by integration from the left end,
//!
//! ```text
//! θ = θₗ + (h/2) Σ c_j ∫P_j,   w = wₗ + (h/2) ∫θ,   ∫P_j = (P_{j+1} − P_{j−1})/(2j + 1).
//! ```
//!
//! That is the Hermite space of degree p seen from its strains; [`Element::hermite`] gives the
//! usual matrices of `[w₁, θ₁, w₂, θ₂]` and of the bubbles between, as a change of basis of the
//! same two blocks. `N = p + 1` is the number of Legendre polynomials in a deflection, `N − 2`
//! the number of strains.

use crate::bat::Bat;
use crate::beam::mesh::{self, Mesh};
use crate::beam::rule::{MOST_POINTS, Rule};
use crate::profile::{Radii, Section};
use crate::real::{Over, Real};

/// Coefficients of `P_0 … P_{N−1}`, or as many other numbers.
pub type Vector<R, const N: usize> = [R; N];
/// `N` rows of `N` numbers.
pub type Matrix<R, const N: usize> = [[R; N]; N];

/// The energies of one element.
#[derive(Debug, Clone, Copy)]
pub struct Element<R, const N: usize> {
    /// Length h (m).
    pub length: R,
    /// Position of the middle from the knob end (m).
    pub middle: R,
    /// Stiffness of the strains `D_jk = ∫EI P_j P_k dx` (N m³), `j, k < N − 2`.
    pub stiffness: Matrix<R, N>,
    /// Mass `∫ρA P_k P_l dx` (kg).
    pub mass: Matrix<R, N>,
}

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

/// The deflection with strains `c` of an element of length `h` whose left end is at `w` with
/// slope `theta`, in Legendre polynomials (m).
#[inline(always)]
pub fn deflection<S: Real, R: Over<S>, const N: usize>(
    h: S,
    c: &Vector<R, N>,
    w: R,
    theta: R,
) -> Vector<R, N> {
    let half = S::splat(0.5) * h;
    let integral = |below: R, k: usize, above: R| {
        (R::splat(ODD[k - 1]) * below - R::splat(ODD[k + 1]) * above) * half
    };
    let zero = R::default();
    let mut t = [zero; N];
    let c = |k: usize| if k < N - 2 { c[k] } else { zero };
    t[0] = theta + (c(0) - R::splat(ODD[1]) * c(1)) * half;
    for k in 1..N - 1 {
        t[k] = integral(c(k - 1), k, c(k + 1));
    }
    let mut shape = [zero; N];
    shape[0] = w + (t[0] - R::splat(ODD[1]) * t[1]) * half;
    for k in 1..N {
        shape[k] = integral(t[k - 1], k, if k + 1 < N { t[k + 1] } else { zero });
    }
    shape
}

/// The adjoint of [`deflection`]: what loads on the Legendre polynomials are on the strains and,
/// in the last two places, on `w` and `theta`.
#[inline(always)]
fn on_strains<R: Real, const N: usize>(h: R, load: &Vector<R, N>) -> Vector<R, N> {
    let half = R::splat(0.5) * h;
    let zero = R::default();
    let mut turning = [zero; N];
    turning[0] = half * (load[1] + load[0]);
    for k in 1..N - 1 {
        turning[k] = half * R::splat(ODD[k]) * (load[k + 1] - load[k - 1]);
    }
    let mut on = [zero; N];
    on[0] = half * (turning[1] + turning[0]);
    for k in 1..N - 2 {
        on[k] = half * R::splat(ODD[k]) * (turning[k + 1] - turning[k - 1]);
    }
    (on[N - 2], on[N - 1]) = (load[0], turning[0]);
    on
}

impl<R: Real, const N: usize> Element<R, N> {
    /// The energies from EI (N m²) and ρA (kg/m) at the points of the rule.
    #[inline(always)]
    pub fn new(
        length: R,
        middle: R,
        rule: &Rule,
        bending_stiffness: &[R],
        mass_per_length: &[R],
    ) -> Self {
        let zero = [[R::default(); N]; N];
        let (mut stiffness, mut mass) = (zero, zero);
        let sections = bending_stiffness.iter().zip(mass_per_length);
        for (i, ((bending, line), point)) in sections.zip(&rule.points).enumerate() {
            let p = rule.at::<N>(i);
            let share = R::splat(point.weight) * length;
            let (bending, line) = (share * *bending, share * *line);
            for k in 0..N {
                let (bending, line) = (bending * R::splat(p[k]), line * R::splat(p[k]));
                for l in 0..N {
                    mass[k][l] += line * R::splat(p[l]);
                }
                for l in 0..N - 2 {
                    stiffness[k][l] += bending * R::splat(p[l]);
                }
            }
        }
        Self { length, middle, stiffness, mass }
    }

    /// Writes `L⁻¹`, lower triangular, of the stiffness `D = L Lᵀ` in that unit of energy.
    #[inline(always)]
    pub fn invert_factor(&self, unit: R, inverse: &mut Matrix<R, N>) {
        let n = N - 2;
        let zero = R::default();
        let scale = R::splat(1.0) / unit;
        let mut factor = [[zero; N]; N];
        for j in 0..n {
            let mut pivot = self.stiffness[j][j] * scale;
            for k in 0..j {
                pivot -= factor[j][k] * factor[j][k];
            }
            inverse[j][j] = R::splat(1.0) / pivot.sqrt();
            for i in j + 1..n {
                let mut entry = self.stiffness[i][j] * scale;
                for k in 0..j {
                    entry -= factor[i][k] * factor[j][k];
                }
                factor[i][j] = entry * inverse[j][j];
            }
        }
        for i in 1..n {
            for j in 0..i {
                let mut entry = zero;
                for k in j..i {
                    entry += factor[i][k] * inverse[k][j];
                }
                inverse[i][j] = -(entry * inverse[i][i]);
            }
        }
    }

    /// Writes the element as the running sums use it, in strains scaled by that `L⁻¹`.
    #[inline(always)]
    pub fn connect(&self, inverse: &Matrix<R, N>, link: &mut Link<R, N>) {
        let (n, h) = (N - 2, self.length);
        // ∂T/∂(c, w, θ) of every deflection polynomial, then of every strain.
        let zero = R::default();
        let (mut rows, mut columns) = ([[zero; N]; N], [[zero; N]; N]);
        for k in 0..N {
            rows[k] = on_strains(h, &self.mass[k]);
        }
        for j in 0..N {
            let mut column = [zero; N];
            for k in 0..N {
                column[k] = rows[k][j];
            }
            columns[j] = on_strains(h, &column);
        }
        // Scaled from the left, row by row, then from the right.
        let mut left = columns;
        for i in 0..n {
            left[i] = [zero; N];
            for k in 0..=i {
                for j in 0..N {
                    left[i][j] += inverse[i][k] * columns[k][j];
                }
            }
        }
        for row in 0..N {
            for i in 0..n {
                let mut entry = zero;
                for k in 0..=i {
                    entry += left[row][k] * inverse[i][k];
                }
                link.mass[row][i] = entry;
            }
            link.mass[row][n..].copy_from_slice(&left[row][n..]);
        }
        for i in 0..n {
            let second = if i > 0 { R::splat(ODD[1]) * inverse[i][1] } else { zero };
            link.turn[i] = h * inverse[i][0];
            link.lift[i] = R::splat(0.5) * h * h * (inverse[i][0] - second);
        }
        link.length = h;
    }
}

/// One element as the running sums use it: its kinetic energy in its scaled strains `q` and the
/// deflection and slope `(w, θ)` at its inner end, and how far these carry its outer end.
#[derive(Debug, Clone, Copy)]
pub struct Link<R, const N: usize> {
    /// Mass matrix of `(q₀ … q_{N−3}, w, θ)`.
    pub mass: Matrix<R, N>,
    /// `w_out = w + h θ + lift·q`, `θ_out = θ + turn·q`; the last two places are not used.
    pub lift: Vector<R, N>,
    pub turn: Vector<R, N>,
    pub length: R,
}

impl<S: Real, const N: usize> Link<S, N> {
    /// The element's generalised loads `∂T/∂(q, w, θ)` in that motion (times ω²).
    #[inline(always)]
    pub fn load<R: Over<S>>(&self, motion: &Vector<R, N>) -> Vector<R, N> {
        let mut load = [R::default(); N];
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
pub fn over_strains<S, R: Over<S>, const N: usize>(a: &Vector<S, N>, b: &Vector<R, N>) -> R
where
    S: Real,
{
    let mut sum = R::default();
    for k in 0..N - 2 {
        sum += b[k] * a[k];
    }
    sum
}

/// EI (N m²) and ρA (kg/m) at the points of the rule on one element.
#[inline(always)]
pub fn sections(bat: &Bat, e: &mesh::Element, rule: &Rule, mut take: impl FnMut(usize, f64, f64)) {
    let mut at = |i, section| take(i, bat.bending_stiffness(section), bat.mass_per_length(section));
    let piece = &bat.profile.pieces[e.piece];
    let Radii::Cubic(cubics) = &piece.radii else {
        for (i, point) in rule.points.iter().enumerate() {
            at(i, piece.at(e.from + (e.to - e.from) * point.s));
        }
        return;
    };
    let cubics = cubics.part(e.from, e.to);
    let solid = cubics.inner == [0.0; 4];
    for (i, point) in rule.points.iter().enumerate() {
        let v = &point.bernstein;
        let radius = |b: &[f64; 4]| (b[0] * v[0] + b[1] * v[1]) + (b[2] * v[2] + b[3] * v[3]);
        let inner = if solid { 0.0 } else { radius(&cubics.inner) };
        at(i, Section { outer: radius(&cubics.outer), inner });
    }
}

/// The Legendre series of a formula ends in its round-off below this.
const RESOLVED: f64 = 1e-13;

/// How much of EI and ρA on an element the points of its rule may miss, relative: the last terms
/// of their Legendre series through the points, 0 where these are mere round-off. 0 for stations,
/// whose polynomials the rule holds exactly.
pub fn missed(bat: &Bat, e: &mesh::Element, rule: &Rule) -> f64 {
    if matches!(bat.profile.pieces[e.piece].radii, Radii::Cubic(_)) {
        return 0.0;
    }
    let (mut bending, mut line) = ([0.0; MOST_POINTS], [0.0; MOST_POINTS]);
    sections(bat, e, rule, |i, stiffness, mass| (bending[i], line[i]) = (stiffness, mass));
    let tail = f64::max(rule.tail(&bending), rule.tail(&line));
    if tail > RESOLVED { tail } else { 0.0 }
}

/// All elements of a mesh, as degree `N − 1` sees them.
pub fn elements<const N: usize>(bat: &Bat, mesh: &Mesh) -> Vec<Element<f64, N>> {
    let rule = Rule::of(bat, N - 1);
    let (mut bending, mut line) = (vec![0.0; rule.count()], vec![0.0; rule.count()]);
    let element = |e: &mesh::Element| {
        sections(bat, e, rule, |i, stiffness, mass| (bending[i], line[i]) = (stiffness, mass));
        Element::new(e.length, e.start + 0.5 * e.length, rule, &bending, &line)
    };
    mesh.elements.iter().map(element).collect()
}

impl<const N: usize> Element<f64, N> {
    /// Strains of the unknowns `[w₁, θ₁, w₂, θ₂, b₂, b₃ …]`: mean curvature `(θ₂ − θ₁)/h`, its
    /// slope `3[(θ₁ − ψ) + (θ₂ − ψ)]/h` with the chord `ψ = (w₂ − w₁)/h`, and the bubbles, whose
    /// amplitude `b_j` is the coefficient of `P_j` in the curvature.
    pub fn strains_of_hermite(&self, u: &[f64]) -> Vector<f64, N> {
        let h = self.length;
        let chord = (u[2] - u[0]) / h;
        let mut strains = [0.0; N];
        strains[0] = (u[3] - u[1]) / h;
        strains[1] = 3.0 * ((u[1] - chord) + (u[3] - chord)) / h;
        strains[2..N - 2].copy_from_slice(&u[4..]);
        strains
    }

    /// Stiffness and mass for the unknowns `[w₁, θ₁, w₂, θ₂, b₂, b₃ …]`.
    ///
    /// A bubble's deflection and slope vanish at both ends, because `P_j` with `j ≥ 2` has
    /// neither area nor moment.
    pub fn hermite(&self) -> (Matrix<f64, N>, Matrix<f64, N>) {
        let unit =
            |i: usize| -> Vector<f64, N> { std::array::from_fn(|j| f64::from(u8::from(i == j))) };
        let strains: Matrix<f64, N> = std::array::from_fn(|i| self.strains_of_hermite(&unit(i)));
        let shapes: Matrix<f64, N> = std::array::from_fn(|i| {
            let u = unit(i);
            deflection(self.length, &strains[i], u[0], u[1])
        });
        let product = |matrix: &Matrix<f64, N>, rows: &Matrix<f64, N>| {
            let times = |x: &Vector<f64, N>| -> Vector<f64, N> {
                std::array::from_fn(|k| dot(&matrix[k], x))
            };
            let images = rows.map(|row| times(&row));
            std::array::from_fn(|i| std::array::from_fn(|j| dot(&images[i], &rows[j])))
        };
        (product(&self.stiffness, &strains), product(&self.mass, &shapes))
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A uniform element of length h with EI and ρA.
    fn uniform<const N: usize>(h: f64, bending: f64, line: f64) -> Element<f64, N> {
        let mut element =
            Element { length: h, middle: 0.5 * h, stiffness: [[0.0; N]; N], mass: [[0.0; N]; N] };
        for k in 0..N {
            element.mass[k][k] = line * h * ODD[k];
            if k < N - 2 {
                element.stiffness[k][k] = bending * h * ODD[k];
            }
        }
        element
    }

    /// The textbook matrices of the uniform Euler–Bernoulli element.
    #[test]
    fn a_uniform_cubic_has_the_matrices_of_the_textbooks() {
        let (h, bending, line) = (0.3, 250.0, 0.9);
        let (k, m) = uniform::<4>(h, bending, line).hermite();
        let stiffness = [
            [12.0, 6.0 * h, -12.0, 6.0 * h],
            [6.0 * h, 4.0 * h * h, -6.0 * h, 2.0 * h * h],
            [-12.0, -6.0 * h, 12.0, -6.0 * h],
            [6.0 * h, 2.0 * h * h, -6.0 * h, 4.0 * h * h],
        ];
        let mass = [
            [156.0, 22.0 * h, 54.0, -13.0 * h],
            [22.0 * h, 4.0 * h * h, 13.0 * h, -3.0 * h * h],
            [54.0, 13.0 * h, 156.0, -22.0 * h],
            [-13.0 * h, -3.0 * h * h, -22.0 * h, 4.0 * h * h],
        ];
        for i in 0..4 {
            for j in 0..4 {
                let (exact, scale) = (bending / h.powi(3) * stiffness[i][j], bending / h.powi(3));
                assert!((k[i][j] - exact).abs() < 1e-13 * scale, "K {i} {j}");
                let (exact, scale) = (line * h / 420.0 * mass[i][j], line * h);
                assert!((m[i][j] - exact).abs() < 1e-14 * scale, "M {i} {j}");
            }
        }
    }

    /// The hierarchical family contains the cubics: the first four rows and columns do not change.
    #[test]
    fn bubbles_leave_the_cubics_as_they_are() {
        let (h, bending, line) = (0.2, 100.0, 1.5);
        let (k4, m4) = uniform::<4>(h, bending, line).hermite();
        let (k, m) = uniform::<9>(h, bending, line).hermite();
        for i in 0..4 {
            for j in 0..4 {
                assert!((k[i][j] - k4[i][j]).abs() < 1e-12 * k4[0][0].abs());
                assert!((m[i][j] - m4[i][j]).abs() < 1e-13 * m4[0][0].abs());
            }
            // Nor does a bubble of a uniform element do work on the bending of a cubic.
            for j in 4..9 {
                assert!(k[i][j].abs() < 1e-12 * k4[0][0]);
            }
        }
    }

    #[test]
    fn the_inverse_factor_is_that_of_the_stiffness() {
        let mut element = uniform::<7>(0.4, 3.0, 1.0);
        // Any symmetric positive matrix.
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
