//! What one element stores: strain energy and kinetic energy of a cubic deflection.
//!
//! On an element of length `h`, with ξ from −1 to 1 and `P_j` the Legendre polynomials, the
//! unknowns are strains: the curvature is `θ′ = c₀ P₀ + c₁ P₁`, and slope and deflection follow
//! by integration from the left end,
//!
//! ```text
//! θ = θₗ + (h/2) Σ c_j ∫P_j,   w = wₗ + (h/2) ∫θ,   ∫P_j = (P_{j+1} − P_{j−1})/(2j + 1).
//! ```
//!
//! That is the cubic Hermite space seen from its strains; [`Element::hermite`] gives the usual
//! matrices of `[w₁, θ₁, w₂, θ₂]` as a change of basis of the same two blocks.

use crate::bat::Bat;
use crate::beam::mesh;
use crate::profile::{Cubics, Piece, Radii, Section};
use crate::quadrature::{converged, gauss};

/// Strain unknowns of an element: the coefficients of `P₀` and `P₁` in its curvature.
pub const STRAINS: usize = 2;

const THIRD: f64 = 1.0 / 3.0;
const FIFTH: f64 = 0.2;

/// A 4 × 4 matrix of Hermite unknowns `[w₁, θ₁, w₂, θ₂]`.
pub type Matrix4 = [[f64; 4]; 4];

/// The energies of one element.
#[derive(Debug, Clone, Copy)]
pub struct Element {
    /// Length h (m).
    pub length: f64,
    /// Position of the middle from the knob end (m).
    pub middle: f64,
    /// Stiffness of the strains `D` (N m³), as `[D₀₀, D₁₀, D₁₁]`.
    pub stiffness: [f64; 3],
    /// Inverse of the Cholesky factor `D = L Lᵀ`, as `[1/L₀₀, −L₁₀/(L₀₀ L₁₁), 1/L₁₁]`.
    pub inverse: [f64; 3],
    /// Mass `∫ρA P_k P_l dx` (kg), `k ≥ l`, row by row.
    pub mass: [f64; 10],
}

/// `w₀ … w₃`: a deflection on an element in Legendre polynomials (m).
pub type Deflection = [f64; 4];

impl Element {
    /// The deflection with strains `c` of an element whose left end is at `w` with slope `theta`.
    #[inline(always)]
    pub fn deflection(&self, c: [f64; 2], w: f64, theta: f64) -> Deflection {
        let half = 0.5 * self.length;
        let (t1, t2) = (half * c[0], half * c[1] * THIRD);
        let t0 = theta + (t1 - t2);
        [
            w + half * (t0 - t1 * THIRD),
            half * (t0 - t2 * FIFTH),
            half * t1 * THIRD,
            half * t2 * FIFTH,
        ]
    }

    /// By how much slope and deflection grow along the element: `h c₀` and `h θ̄`.
    #[inline(always)]
    pub fn growth(&self, c: [f64; 2], theta: f64) -> (f64, f64) {
        let h = self.length;
        (h * c[0], h * (theta + 0.5 * h * (c[0] - c[1] * THIRD)))
    }

    /// Loads `f_k = ∫ρA P_k w dx` that the inertia of a deflection makes (times ω²).
    #[inline(always)]
    pub fn load(&self, w: &Deflection) -> Deflection {
        let m = &self.mass;
        [
            m[0] * w[0] + m[1] * w[1] + m[3] * w[2] + m[6] * w[3],
            m[1] * w[0] + m[2] * w[1] + m[4] * w[2] + m[7] * w[3],
            m[3] * w[0] + m[4] * w[1] + m[5] * w[2] + m[8] * w[3],
            m[6] * w[0] + m[7] * w[1] + m[8] * w[2] + m[9] * w[3],
        ]
    }

    /// `L⁻ᵀ q`: strains from energy-scaled strains, `½ qᵀq = ½ cᵀD c`.
    #[inline(always)]
    pub fn strains(&self, q: [f64; 2]) -> [f64; 2] {
        let [i00, i10, i11] = self.inverse;
        [i00 * q[0] + i10 * q[1], i11 * q[1]]
    }

    /// `Lᵀ c`: energy-scaled strains from strains.
    pub fn energy_scaled(&self, c: [f64; 2]) -> [f64; 2] {
        let [i00, i10, i11] = self.inverse;
        let q1 = c[1] / i11;
        [(c[0] - i10 * q1) / i00, q1]
    }

    /// The same element with energies counted in that unit.
    pub fn with_energy_unit(&self, unit: f64) -> Self {
        let stiffness = self.stiffness.map(|d| d / unit);
        Self { stiffness, inverse: inverse(stiffness), ..*self }
    }

    /// The same element seen from its other end: odd polynomials change sign.
    pub fn mirrored(&self) -> Self {
        let mut other = *self;
        other.stiffness[1] *= -1.0;
        other.inverse[1] *= -1.0;
        for odd in [1, 4, 6, 8] {
            other.mass[odd] *= -1.0;
        }
        other
    }

    /// Strains of the Hermite unknowns: mean curvature `(θ₂ − θ₁)/h` and its slope
    /// `3[(θ₁ − ψ) + (θ₂ − ψ)]/h` with the chord `ψ = (w₂ − w₁)/h`.
    pub fn strains_of_hermite(&self, u: [f64; 4]) -> [f64; 2] {
        let h = self.length;
        let chord = (u[2] - u[0]) / h;
        [(u[3] - u[1]) / h, 3.0 * ((u[1] - chord) + (u[3] - chord)) / h]
    }

    /// Stiffness and mass for the Hermite unknowns `[w₁, θ₁, w₂, θ₂]`.
    pub fn hermite(&self) -> (Matrix4, Matrix4) {
        let unit = |i: usize| std::array::from_fn(|j| f64::from(u8::from(i == j)));
        let strain: [[f64; 2]; 4] =
            std::array::from_fn(|i| self.energy_scaled(self.strains_of_hermite(unit(i))));
        let shape: [Deflection; 4] = std::array::from_fn(|i| {
            let u = unit(i);
            self.deflection(self.strains_of_hermite(u), u[0], u[1])
        });
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum();
        let stiffness =
            std::array::from_fn(|i| std::array::from_fn(|j| dot(&strain[i], &strain[j])));
        let mass = std::array::from_fn(|i| {
            let load = self.load(&shape[i]);
            std::array::from_fn(|j| dot(&load, &shape[j]))
        });
        (stiffness, mass)
    }
}

/// One element as the running sums use it: its kinetic energy in its scaled strains `q` and the
/// deflection and slope `(w, θ)` at its inner end, and how far these carry its outer end.
#[derive(Debug, Clone, Copy)]
pub struct Link {
    /// Columns of the mass matrix of `(q₀, q₁, w, θ)`.
    pub mass: [[f64; 4]; 4],
    /// `w_out = w + h θ + lift·q`, `θ_out = θ + turn·q`.
    pub lift: [f64; 2],
    pub turn: [f64; 2],
    pub length: f64,
}

impl Element {
    /// The element's motion by `q`, `w` and `θ`, each once, and the energy of their sums.
    pub fn link(&self) -> Link {
        let motion = |q: [f64; 2], w: f64, theta: f64| self.deflection(self.strains(q), w, theta);
        let motions = [
            motion([1.0, 0.0], 0.0, 0.0),
            motion([0.0, 1.0], 0.0, 0.0),
            motion([0.0; 2], 1.0, 0.0),
            motion([0.0; 2], 0.0, 1.0),
        ];
        let loads = motions.map(|w| self.load(&w));
        let dot =
            |a: &Deflection, b: &Deflection| a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
        let carried = [[1.0, 0.0], [0.0, 1.0]].map(|q| self.growth(self.strains(q), 0.0));
        Link {
            mass: loads.map(|load| motions.map(|w| dot(&w, &load))),
            lift: carried.map(|(_, risen)| risen),
            turn: carried.map(|(turned, _)| turned),
            length: self.length,
        }
    }
}

impl Link {
    /// The element's generalised loads `∂T/∂(q, w, θ)` in that motion (times ω²).
    #[inline(always)]
    pub fn load(&self, q: [f64; 2], w: f64, theta: f64) -> [f64; 4] {
        let [a, b, c, d] = &self.mass;
        std::array::from_fn(|i| (a[i] * q[0] + b[i] * q[1]) + (c[i] * w + d[i] * theta))
    }

    /// By how much deflection and slope differ between the two ends.
    #[inline(always)]
    pub fn growth(&self, q: [f64; 2], theta: f64) -> [f64; 2] {
        let risen = self.lift[0] * q[0] + self.lift[1] * q[1];
        [self.length * theta + risen, self.turn[0] * q[0] + self.turn[1] * q[1]]
    }
}

/// One quadrature point: values of the Bernstein polynomials for the radii, and the weight
/// times the products `P_k P_l`, `k ≥ l`, for the integrals.
struct Point {
    bernstein: [f64; 4],
    products: [f64; 10],
}

/// The quadrature of an element whose radii are of that degree, exact.
///
/// `∫ρA P₃²` has degree `2d + 6` and `∫EI P₁²` degree `4d + 2`; `n` points do `2n − 1`.
fn points(degree: usize) -> Vec<Point> {
    let count = (degree + 4).max(2 * degree + 2);
    let point = |(s, weight): (f64, f64)| {
        let t = 1.0 - s;
        let products = products(s, weight);
        Point { bernstein: [t * t * t, 3.0 * s * t * t, 3.0 * s * s * t, s * s * s], products }
    };
    gauss(count).into_iter().map(point).collect()
}

/// `P_k P_l` times the weight, `k ≥ l`, row by row, at `s` in [0, 1].
fn products(s: f64, weight: f64) -> [f64; 10] {
    let xi = 2.0 * s - 1.0;
    let legendre = [1.0, xi, 0.5 * (3.0 * xi * xi - 1.0), 0.5 * xi * (5.0 * xi * xi - 3.0)];
    let pairs = (0..4).flat_map(|k| (0..=k).map(move |l| (k, l)));
    let mut products = [0.0; 10];
    for (product, (k, l)) in products.iter_mut().zip(pairs) {
        *product = weight * legendre[k] * legendre[l];
    }
    products
}

/// All elements of a mesh.
pub fn elements(bat: &Bat, mesh: &mesh::Mesh) -> Vec<Element> {
    static RULES: std::sync::LazyLock<[Vec<Point>; 3]> =
        std::sync::LazyLock::new(|| [points(0), points(1), points(3)]);
    let rules = &*RULES;
    let element = |e: &mesh::Element| {
        let piece = &bat.profile.pieces[e.piece];
        match &piece.radii {
            Radii::Cubic(cubics) => {
                energies(bat, &cubics.part(e.from, e.to), e, &rules[cubics.degree.min(2)])
            }
            Radii::Formula(_) => converged_energies(bat, piece, e),
        }
    };
    mesh.elements.iter().map(element).collect()
}

/// `D_jk = ∫EI P_j P_k dx`, factored, and `∫ρA P_k P_l dx`.
#[inline]
fn energies(bat: &Bat, cubics: &Cubics, e: &mesh::Element, rule: &[Point]) -> Element {
    let (mut d, mut mass) = ([0.0; 3], [0.0; 10]);
    let solid = cubics.inner == [0.0; 4];
    for Point { bernstein: v, products } in rule {
        let radius = |b: &[f64; 4]| (b[0] * v[0] + b[1] * v[1]) + (b[2] * v[2] + b[3] * v[3]);
        let inner = if solid { 0.0 } else { radius(&cubics.inner) };
        let section = Section { outer: radius(&cubics.outer), inner };
        let stiffness = e.length * bat.bending_stiffness(section);
        let per_length = e.length * bat.mass_per_length(section);
        d.iter_mut().zip(products).for_each(|(d, p)| *d += stiffness * p);
        mass.iter_mut().zip(products).for_each(|(m, p)| *m += per_length * p);
    }
    with_energies(e, d, mass)
}

/// The same where the radii are formulas, by as many points as it takes.
#[inline(never)] // It would crowd the loop over the cubics.
fn converged_energies(bat: &Bat, piece: &Piece, e: &mesh::Element) -> Element {
    let both = converged(|s| -> [f64; 13] {
        let section = piece.at(e.from + (e.to - e.from) * s);
        let stiffness = e.length * bat.bending_stiffness(section);
        let per_length = e.length * bat.mass_per_length(section);
        let products = products(s, 1.0);
        std::array::from_fn(|i| match i {
            0..3 => stiffness * products[i],
            _ => per_length * products[i - 3],
        })
    });
    let (d, mass) = both.values.split_at(3);
    with_energies(e, std::array::from_fn(|i| d[i]), std::array::from_fn(|i| mass[i]))
}

#[inline(always)]
fn with_energies(e: &mesh::Element, d: [f64; 3], mass: [f64; 10]) -> Element {
    Element {
        length: e.length,
        middle: e.start + 0.5 * e.length,
        stiffness: d,
        inverse: inverse(d),
        mass,
    }
}

/// The inverse of the Cholesky factor of a 2 × 2 matrix.
#[inline]
fn inverse(d: [f64; 3]) -> [f64; 3] {
    let i00 = 1.0 / d[0].sqrt();
    let l10 = d[1] * i00;
    let i11 = 1.0 / (d[2] - l10 * l10).sqrt();
    [i00, -l10 * i00 * i11, i11]
}
