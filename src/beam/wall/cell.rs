//! What does one element of the wall store when it moves as `cos nθ`?
//!
//! With `u_r = U cos nθ`, `u_θ = V sin nθ`, `u_x = W cos nθ` the strains are, in the order rr, θθ, xx, xr, rθ, xθ:
//!
//! ```text
//! U_r,   (U + nV)/r,   W_x,   U_x + W_r,   V_r − (V + nU)/r,   V_x − nW/r
//! K = ∫∫ Bᵀ C B r dr dx,    M = ∫∫ ρ NᵀN r dr dx          times π, for n = 0 times 2π
//! x = x_l + h (1 + ξ)/2,    r = r_a + (r_b − r_a)(1 + η)/2
//! ∂/∂r = 2/(r_b − r_a) ∂/∂η,    ∂/∂x at fixed r = 2/h ∂/∂ξ − [r_a′ (1 − η)/2 + r_b′ (1 + η)/2] ∂/∂r
//! ```
//!
//! The integrals of products of `N`, `N/r`, `N_r` and `N_x` do not depend on the harmonic and are taken once.
//!
//! # Source
//!
//! E. L. Wilson, AIAA Journal 3 (1965) 2269: solids of revolution under loads without that symmetry, one Fourier term
//! after the other.

use crate::base::vectorized;
use crate::beam::wall::columns::LayerElement;
use crate::beam::wall::elastic::Elastic;
use crate::beam::wall::shapes::Shapes;

/// Integrals over an element of products of two functions: `[i][j]`, a row for each `i`.
#[derive(Debug, Clone)]
pub struct WallCell {
    /// Number of functions, `(p + 1)(q + 1)`; function `i (q + 1) + a` is `φ_i(ξ) χ_a(η)`.
    pub count: usize,
    qq: Vec<f64>,
    qr: Vec<f64>,
    rr: Vec<f64>,
    dd: Vec<f64>,
    rd: Vec<f64>,
    qd: Vec<f64>,
    nn: Vec<f64>,
}

/// The shape functions and the points of all elements of one mesh.
#[derive(Debug, Clone)]
pub struct WallRule {
    /// Along the bat.
    pub along: Shapes,
    /// Across the wall.
    pub across: Shapes,
}

/// Additional points along and across: 1/r is not a polynomial.
const MORE_POINTS: usize = 4;

impl WallRule {
    /// For degree p along and q across.
    pub fn new(p: usize, q: usize) -> Self {
        let shapes = |degree| Shapes::new(degree, degree + MORE_POINTS);
        Self { along: shapes(p), across: shapes(q) }
    }
}

/// A point of an element: weight with `r dr dx`, radius, `∂η/∂r`, and `−∂r/∂x` of the fibre.
#[derive(Debug, Clone, Copy)]
struct Point {
    /// Weight of the point (m³).
    weight: f64,
    /// Radius (m).
    radius: f64,
    /// `2/(r_b − r_a)` (1/m).
    across: f64,
    /// Slope of the fibre through the point.
    slope: f64,
}

/// The point at Gauss points `k` along and `l` across an element of length `h` (m), between radii and slopes
/// `[r, dr/dx]` of its sides there.
#[inline(always)]
fn point_between(
    [a, da]: [f64; 2],
    [b, db]: [f64; 2],
    rule: &WallRule,
    h: f64,
    k: usize,
    l: usize,
) -> Point {
    let eta = rule.across.places[l];
    let radius = 0.5 * (a * (1.0 - eta) + b * (1.0 + eta));
    let weight = rule.along.weights[k] * rule.across.weights[l];
    Point {
        weight: weight * 0.25 * h * (b - a) * radius,
        radius,
        across: 2.0 / (b - a),
        slope: 0.5 * (da * (1.0 - eta) + db * (1.0 + eta)),
    }
}

/// Kinds of products of functions across: `Q Q`, `Q R`, `R R`, `T T`, `R T`, `Q T`, `T N`, `N T`, `R N`, `Q N` and
/// `N N`, with `Q = χ/r`, `R = χ_r`, `T = −r′ χ_r` along the fibre, `N = χ`.
const KINDS: usize = 11;
/// Matrices of an element: `qq`, `qr`, `rr`, `dd`, `rd`, `qd`, `nn`.
const MATRICES: usize = 7;

impl WallCell {
    /// The integrals over a part of a column of length `h` (m).
    pub fn new(part: &LayerElement, rule: &WallRule, h: f64) -> Self {
        vectorized!(integrals(part, rule, h))
    }

    /// Stiffness plus `shift` times mass in harmonic n, without the factor π, row by row: the unknowns are all of U,
    /// then of V, then of W.
    pub fn stiffness(&self, of: &Elastic, n: usize, shift: f64) -> Vec<f64> {
        let (count, n) = (self.count, n as f64);
        let [[c_rr, c_rt, c_rx], [_, c_tt, c_tx], [.., c_xx]] = of.normal;
        let Elastic { shear_xr: xr, shear_rt: rt, shear_xt: xt, density, .. } = *of;
        let mass = shift * density;
        let width = 3 * count;
        let mut k = vec![0.0; width * width];
        for i in 0..count {
            for j in 0..count {
                let (at, across) = (i * count + j, j * count + i);
                let (qq, rr, dd, nn) = (self.qq[at], self.rr[at], self.dd[at], self.nn[at]);
                let (qr, rq, rd, dr, qd, dq) = (
                    self.qr[at],
                    self.qr[across],
                    self.rd[at],
                    self.rd[across],
                    self.qd[at],
                    self.qd[across],
                );
                let (u, v, w) = (i * width, (count + i) * width, (2 * count + i) * width);
                k[u + j] =
                    c_rr * rr + c_rt * (qr + rq) + (c_tt + n * n * rt) * qq + xr * dd + mass * nn;
                let uv = n * (c_rt * rq + (c_tt + rt) * qq - rt * qr);
                let uw = c_rx * rd + c_tx * qd + xr * dr;
                let vw = n * (c_tx * qd - xt * dq);
                k[u + count + j] = uv;
                k[u + 2 * count + j] = uw;
                k[v + count + j] =
                    (n * n * c_tt + rt) * qq + rt * (rr - qr - rq) + xt * dd + mass * nn;
                k[v + 2 * count + j] = vw;
                k[w + 2 * count + j] = c_xx * dd + xr * rr + n * n * xt * qq + mass * nn;
                // The lower half, from the transposed entry.
                k[(count + j) * width + i] = uv;
                k[(2 * count + j) * width + i] = uw;
                k[(2 * count + j) * width + count + i] = vw;
            }
        }
        k
    }

    /// `ρ∫∫N_i N_j r dr dx`, row by row, without the density.
    pub fn mass(&self) -> &[f64] {
        &self.nn
    }
}

/// The integrals over one part: sums across the wall at each point along it, times products of functions along it. The
/// sums of all pairs across are kept side by side for each pair along.
#[inline(always)]
fn integrals(part: &LayerElement, rule: &WallRule, h: f64) -> WallCell {
    let (p, q) = (rule.along.count, rule.across.count);
    let square = q * q;
    let mut kinds = vec![0.0; KINDS * square];
    let mut sums = vec![0.0; MATRICES * p * p * square];
    for k in 0..rule.along.places.len() {
        across(part, rule, h, k, &mut kinds);
        let kind: [&[f64]; KINDS] = std::array::from_fn(|m| &kinds[m * square..(m + 1) * square]);
        let [qq, qr, rr, tt, rt, qt, tn, nt, rn, qn, nn] = kind;
        let (values, slopes) = (rule.along.value(k), rule.along.slope(k));
        for i in 0..p {
            let (f, g) = (values[i], slopes[i] * 2.0 / h);
            for j in 0..p {
                let (f_j, g_j) = (values[j], slopes[j] * 2.0 / h);
                let (ff, fg, gf, gg) = (f * f_j, f * g_j, g * f_j, g * g_j);
                let at = (i * p + j) * MATRICES * square;
                let to = &mut sums[at..at + MATRICES * square];
                for m in 0..square {
                    to[m] += ff * qq[m];
                    to[square + m] += ff * qr[m];
                    to[2 * square + m] += ff * rr[m];
                    to[3 * square + m] += ff * tt[m] + fg * tn[m] + gf * nt[m] + gg * nn[m];
                    to[4 * square + m] += ff * rt[m] + fg * rn[m];
                    to[5 * square + m] += ff * qt[m] + fg * qn[m];
                    to[6 * square + m] += ff * nn[m];
                }
            }
        }
    }
    let count = p * q;
    let mut matrices: [Vec<f64>; MATRICES] = std::array::from_fn(|_| vec![0.0; count * count]);
    for (pair, sums) in sums.chunks_exact(MATRICES * square).enumerate() {
        let (i, j) = (pair / p, pair % p);
        for (matrix, sums) in matrices.iter_mut().zip(sums.chunks_exact(square)) {
            for (a, row) in sums.chunks_exact(q).enumerate() {
                let at = (i * q + a) * count + j * q;
                matrix[at..at + q].copy_from_slice(row);
            }
        }
    }
    let [qq, qr, rr, dd, rd, qd, nn] = matrices;
    WallCell { count, qq, qr, rr, dd, rd, qd, nn }
}

/// The sums across at point `k` along, for all pairs of functions across.
#[inline(always)]
fn across(part: &LayerElement, rule: &WallRule, h: f64, k: usize, kinds: &mut [f64]) {
    let q = rule.across.count;
    let square = q * q;
    let xi = rule.along.places[k];
    let ([a, da], [b, db]) = (part.inner.at(xi), part.outer.at(xi));
    let (a, b) = ([a, da * 2.0 / h], [b, db * 2.0 / h]);
    kinds.fill(0.0);
    for l in 0..rule.across.places.len() {
        let at = point_between(a, b, rule, h, k, l);
        let (values, slopes) = (rule.across.value(l), rule.across.slope(l));
        for i in 0..q {
            let n_i = at.weight * values[i];
            let (q_i, r_i) = (n_i / at.radius, at.weight * at.across * slopes[i]);
            let t_i = -at.slope * r_i;
            for j in 0..q {
                let (n, r) = (values[j], at.across * slopes[j]);
                let (o, t) = (n / at.radius, -at.slope * r);
                let to = &mut kinds[i * q + j..];
                to[0] += q_i * o;
                to[square] += q_i * r;
                to[2 * square] += r_i * r;
                to[3 * square] += t_i * t;
                to[4 * square] += r_i * t;
                to[5 * square] += q_i * t;
                to[6 * square] += t_i * n;
                to[7 * square] += n_i * t;
                to[8 * square] += r_i * n;
                to[9 * square] += q_i * n;
                to[10 * square] += n_i * n;
            }
        }
    }
}

/// Energy and mass of an element's motion, from its strains at the points: twice the strain energy, and the integral of
/// `ρ|u|²`, both without the factor π. `motion` holds the coefficients of U, V, W for all functions.
pub fn energies(
    part: &LayerElement,
    rule: &WallRule,
    h: f64,
    of: &Elastic,
    n: usize,
    motion: [&[f64]; 3],
) -> [f64; 2] {
    let (p, q) = (rule.along.count, rule.across.count);
    let n = n as f64;
    let (mut strain, mut mass) = (0.0, 0.0);
    for k in 0..rule.along.places.len() {
        let xi = rule.along.places[k];
        let ([a, da], [b, db]) = (part.inner.at(xi), part.outer.at(xi));
        let (a, b) = ([a, da * 2.0 / h], [b, db * 2.0 / h]);
        let (values, slopes) = (rule.along.value(k), rule.along.slope(k));
        // The motion and its derivative along, as functions across.
        let mut lines: [[Vec<f64>; 2]; 3] = Default::default();
        for (line, motion) in lines.iter_mut().zip(motion) {
            *line = [vec![0.0; q], vec![0.0; q]];
            for i in 0..p {
                let (f, g) = (values[i], slopes[i] * 2.0 / h);
                for a in 0..q {
                    line[0][a] += f * motion[i * q + a];
                    line[1][a] += g * motion[i * q + a];
                }
            }
        }
        for l in 0..rule.across.places.len() {
            let at = point_between(a, b, rule, h, k, l);
            let (values, slopes) = (rule.across.value(l), rule.across.slope(l));
            let [[u, u_r, u_x], [v, v_r, v_x], [w, w_r, w_x]] = lines.each_ref().map(|line| {
                let (mut value, mut by_r, mut by_x) = (0.0, 0.0, 0.0);
                for a in 0..q {
                    value += values[a] * line[0][a];
                    by_r += at.across * slopes[a] * line[0][a];
                    by_x += values[a] * line[1][a];
                }
                [value, by_r, by_x - at.slope * by_r]
            });
            let r = at.radius;
            let normal = [u_r, (u + n * v) / r, w_x];
            let shears = [u_x + w_r, v_r - (v + n * u) / r, v_x - n * w / r];
            let mut density = of.shear_xr * shears[0] * shears[0]
                + of.shear_rt * shears[1] * shears[1]
                + of.shear_xt * shears[2] * shears[2];
            for i in 0..3 {
                for j in 0..3 {
                    density += of.normal[i][j] * normal[i] * normal[j];
                }
            }
            strain += at.weight * density;
            mass += at.weight * of.density * (u * u + v * v + w * w);
        }
    }
    [strain, mass]
}
