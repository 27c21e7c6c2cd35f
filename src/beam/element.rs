//! What one element stores: strain energy and kinetic energy of a deflection of degree p.
//!
//! On an element of length `h`, with ξ from −1 to 1 and `P_j` the Legendre polynomials, the
//! unknowns are strains: the curvature is `θ′ = Σ c_j P_j` and, of a beam that shears, the shear
//! strain `w′ − θ = Σ g_j P_j`, `j = 0 … p−2` for both. Rotation and deflection follow by
//! integration from the left end,
//!
//! ```text
//! θ = θₗ + (h/2) Σ c_j ∫P_j,   w = wₗ + (h/2) ∫(θ + Σ g_j P_j),   ∫P_j = (P_{j+1} − P_{j−1})/(2j + 1).
//! ```
//!
//! Without shear that is the Hermite space of degree p seen from its strains, and it is the limit
//! of the other for G → ∞: a strain that costs much is small, and nothing else changes, so that a
//! slender beam neither locks nor loses digits. [`Element::hermite`] gives the usual matrices of
//! `[w₁, θ₁, w₂, θ₂]` and of the bubbles between, as a change of basis of the same blocks.
//!
//! `N = p + 1` is the number of Legendre polynomials in a deflection, `N − 2` the number of
//! coefficients of a strain, `W` the number of all strains of an element plus 2: `N` without shear,
//! `2N − 2` with it.

use crate::base::real::{Over, Real};
use crate::bat::body::Bat;
use crate::bat::layup::Worth;
use crate::bat::profile::{Radii, Section};
use crate::bat::theory::Theory;
use crate::beam::mesh::{self, Mesh};
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
    /// What the Euler–Bernoulli beam does not have.
    pub beyond: Option<Beyond<R, N>>,
}

/// What the sections' rotary inertia and shear add to an element.
#[derive(Debug, Clone, Copy)]
pub struct Beyond<R, const N: usize> {
    /// Mass of the rotation `∫ρI P_k P_l dx` (kg m²), `k, l < N − 1`.
    pub turning: Matrix<R, N>,
    /// Stiffness of the shear strain `∫κGA P_j P_k dx` (N m), `j, k < N − 2`; 0 without shear.
    pub shear: Matrix<R, N>,
}

/// What sections are worth at the points of the rule, one list for each number; the last two are
/// empty where the theory does not ask for them.
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

/// Deflection (m) and rotation (rad) in Legendre polynomials of an element of length `h` with those
/// strains, curvature before shear, whose left end is at `w` with rotation `theta`.
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
    slope.iter_mut().zip(sheared).for_each(|(slope, g)| *slope += *g);
    shape[0] = w + (slope[0] - R::splat(ODD[1]) * slope[1]) * half;
    for k in 1..n {
        shape[k] = integral(slope[k - 1], k, if k + 1 < n { slope[k + 1] } else { zero });
    }
}

/// The adjoint of [`integrated`] for its deflection: what loads on the Legendre polynomials are on
/// the strains and, in the last two places, on `w` and `theta`.
#[inline(always)]
pub fn on_strains<R: Real, const N: usize, const W: usize>(
    h: R,
    load: &Vector<R, N>,
) -> Vector<R, W> {
    let half = R::splat(0.5) * h;
    let mut slope = [R::default(); N];
    slope[0] = half * (load[1] + load[0]);
    for k in 1..N - 1 {
        slope[k] = half * R::splat(ODD[k]) * (load[k + 1] - load[k - 1]);
    }
    let mut on = turning_on_strains(h, &slope);
    if W > N {
        on[N - 2..W - 2].copy_from_slice(&slope[..N - 2]);
    }
    on[W - 2] = load[0];
    on
}

/// The adjoint of [`integrated`] for its rotation: what couples on the Legendre polynomials are on the
/// strains and, in the last place, on `theta`.
#[inline(always)]
pub fn turning_on_strains<R: Real, const N: usize, const W: usize>(
    h: R,
    load: &Vector<R, N>,
) -> Vector<R, W> {
    let half = R::splat(0.5) * h;
    let mut on = [R::default(); W];
    on[0] = half * (load[1] + load[0]);
    for k in 1..N - 2 {
        on[k] = half * R::splat(ODD[k]) * (load[k + 1] - load[k - 1]);
    }
    on[W - 1] = load[0];
    on
}

/// Adds `Σ value P_k P_l` at one point, for `k, l` below a count.
#[inline(always)]
fn add_square<R: Real, const N: usize>(
    matrix: &mut Matrix<R, N>,
    value: R,
    p: &[f64; N],
    count: usize,
) {
    for k in 0..count {
        let part = value * R::splat(p[k]);
        for l in 0..count {
            matrix[k][l] += part * R::splat(p[l]);
        }
    }
}

impl<R: Real, const N: usize, const W: usize> Element<R, N, W> {
    /// The energies from what the sections are worth at the points of the rule.
    #[inline(always)]
    pub fn new(length: R, middle: R, rule: &Rule, samples: Samples<R>) -> Self {
        let zero = [[R::default(); N]; N];
        let (mut stiffness, mut mass) = (zero, zero);
        let sections = samples.bending.iter().zip(samples.mass);
        for (i, ((bending, line), point)) in sections.zip(&rule.points).enumerate() {
            let p = rule.at::<N>(i);
            let share = R::splat(point.weight) * length;
            add_square(&mut mass, share * *line, p, N);
            add_square(&mut stiffness, share * *bending, p, N - 2);
        }
        let beyond = (!samples.turning.is_empty()).then(|| Beyond::new(length, rule, samples));
        Self { length, middle, stiffness, mass, beyond }
    }

    /// Writes `L⁻¹`, lower triangular in blocks of curvature and shear, of the stiffness `D = L Lᵀ`
    /// in that unit of energy.
    #[inline(always)]
    pub fn invert_factor(&self, unit: R, inverse: &mut Matrix<R, W>) {
        invert_factor::<R, N, W>(&self.stiffness, unit, inverse, 0);
        if let Some(beyond) = self.beyond.as_ref().filter(|_| W > N) {
            invert_factor::<R, N, W>(&beyond.shear, unit, inverse, N - 2);
        }
    }

    /// Writes the element as the running sums use it, in strains scaled by that `L⁻¹`.
    #[inline(always)]
    pub fn connect(&self, inverse: &Matrix<R, W>, link: &mut Link<R, W>) {
        let (n, h) = (N - 2, self.length);
        // ∂T/∂(strains, w, θ) of every deflection polynomial, then of every strain.
        let zero = R::default();
        let mut rows = [[zero; W]; N];
        let mut columns = [[zero; W]; W];
        for k in 0..N {
            rows[k] = on_strains::<R, N, W>(h, &self.mass[k]);
        }
        for j in 0..W {
            let mut column = [zero; N];
            for k in 0..N {
                column[k] = rows[k][j];
            }
            columns[j] = on_strains(h, &column);
        }
        if let Some(beyond) = &self.beyond {
            beyond.add(h, &mut columns);
        }
        // Scaled from the left, row by row, then from the right.
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
    #[inline(always)]
    fn new(length: R, rule: &Rule, samples: Samples<R>) -> Self {
        let mut beyond = Self { turning: [[R::default(); N]; N], shear: [[R::default(); N]; N] };
        for (i, (value, point)) in samples.turning.iter().zip(&rule.points).enumerate() {
            let share = R::splat(point.weight) * length;
            add_square(&mut beyond.turning, share * *value, rule.at::<N>(i), N - 1);
        }
        for (i, (value, point)) in samples.shear.iter().zip(&rule.points).enumerate() {
            let share = R::splat(point.weight) * length;
            add_square(&mut beyond.shear, share * *value, rule.at::<N>(i), N - 2);
        }
        beyond
    }

    /// Adds the rotary inertia to the mass matrix of `(strains, w, θ)`.
    #[inline(always)]
    fn add<const W: usize>(&self, h: R, columns: &mut Matrix<R, W>) {
        let mut rows = [[R::default(); W]; N];
        for k in 0..N - 1 {
            rows[k] = turning_on_strains::<R, N, W>(h, &self.turning[k]);
        }
        for j in 0..W {
            let mut column = [R::default(); N];
            for k in 0..N - 1 {
                column[k] = rows[k][j];
            }
            let on: Vector<R, W> = turning_on_strains(h, &column);
            for k in 0..W {
                columns[j][k] += on[k];
            }
        }
    }
}

/// One element as the running sums use it: its kinetic energy in its scaled strains `q` and the
/// deflection and rotation `(w, θ)` at its inner end, and how far these carry its outer end.
#[derive(Debug, Clone, Copy)]
pub struct Link<R, const W: usize> {
    /// Mass matrix of `(q₀ … q_{W−3}, w, θ)`.
    pub mass: Matrix<R, W>,
    /// What its strains add to the deflection at the outer end, `w_out = w + h θ + lift·q` (m); the
    /// last two places are not used.
    pub lift: Vector<R, W>,
    /// What they add to the rotation there, `θ_out = θ + turn·q` (rad).
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

/// The sections at the points of the rule on one element.
#[inline(always)]
fn sections(bat: &Bat, e: &mesh::Element, rule: &Rule, mut at: impl FnMut(usize, Section)) {
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

/// EI (N m²) and ρA (kg/m) at the points of the rule on one element.
#[inline(always)]
pub fn bending_and_mass(
    bat: &Bat,
    e: &mesh::Element,
    rule: &Rule,
    mut take: impl FnMut(usize, [f64; 2]),
) {
    let layup = bat.layup(&bat.profile.pieces[e.piece]);
    sections(bat, e, rule, |i, section| take(i, layup.bending_and_mass(section)));
}

/// All that the sections are worth there.
pub fn worths(bat: &Bat, e: &mesh::Element, rule: &Rule, mut take: impl FnMut(usize, Worth)) {
    let layup = bat.layup(&bat.profile.pieces[e.piece]);
    sections(bat, e, rule, |i, section| take(i, layup.worth(section)));
}

/// The sections' loss factors in bending and in shear there.
pub fn losses(bat: &Bat, e: &mesh::Element, rule: &Rule, mut take: impl FnMut(usize, [f64; 2])) {
    let layup = bat.layup(&bat.profile.pieces[e.piece]);
    sections(bat, e, rule, |i, section| take(i, layup.loss(section)));
}

/// What the points of a rule miss of a section is mere round-off up to this.
const RESOLVED: f64 = 1e-13;
/// Elements shorter than this, as a share of the bat, may hold what no polynomial holds.
const SHORT: f64 = 1e-8;

/// How much of the sections on an element the points of its rule may miss, relative; 0 where that
/// is mere round-off.
///
/// Stations are polynomials that the rule holds exactly, but for the κGA of a bore that tapers: the
/// last terms of its Legendre series through the points count. Of formulas it is what bounds from
/// the parse tree leave of EI, ρA and κGA, and on an element so short that nothing on it matters its variation times
/// its share of the bat.
pub fn missed(bat: &Bat, e: &mesh::Element, rule: &Rule, theory: Theory) -> f64 {
    let piece = &bat.profile.pieces[e.piece];
    let layup = bat.layup(piece);
    let missed = match &piece.radii {
        Radii::Cubic(cubics) if cubics.inner == [0.0; 4] || cubics.degree == 0 => 0.0,
        Radii::Cubic(_) if theory.shears() => shear_tail(bat, e, rule),
        Radii::Cubic(_) => 0.0,
        Radii::Formula(curves) => {
            let core = layup.core.as_ref().map_or(0.0, |core| {
                let of = [
                    core.youngs_modulus / layup.outer.youngs_modulus,
                    core.density / layup.outer.density,
                ];
                of[0].max(of[1])
            });
            let bounds = curves.bounds(e.from, e.to);
            let share = e.length / bat.length();
            let missed = bounds.as_ref().map_or(f64::INFINITY, |bounds| bounds.missed(core));
            let of_shear = bounds.as_ref().filter(|_| theory.shears() && curves.inner.is_some());
            let missed = of_shear.map_or(missed, |bounds| {
                let (empty, core) = (layup.emptiness(), layup.core_in_shear());
                missed.max(bounds.missed_shear(&layup.outer, empty, core))
            });
            let rough = || share * bounds.map_or(1.0, |bounds| bounds.variation(core));
            if share < SHORT { missed.min(rough()) } else { missed.min(1.0) }
        }
    };
    if missed > RESOLVED { missed } else { 0.0 }
}

/// The last terms of the Legendre series of κGA through the points, relative; 0 where that is the
/// round-off of a thin wall.
fn shear_tail(bat: &Bat, e: &mesh::Element, rule: &Rule) -> f64 {
    let (mut shear, mut thinness) = ([0.0; MOST_POINTS], 1.0_f64);
    let layup = bat.layup(&bat.profile.pieces[e.piece]);
    sections(bat, e, rule, |i, section| {
        shear[i] = layup.worth(section).shear;
        thinness = thinness.max(section.thinness());
    });
    let tail = rule.tail(&shear);
    if tail > 64.0 * f64::EPSILON * thinness { tail } else { 0.0 }
}

/// Round-off of the sections, relative: `r/(r − r_i)` spacings of a wall that is the difference of
/// two radii, and what evaluating a formula costs.
pub fn round_off(bat: &Bat, mesh: &Mesh) -> f64 {
    let of = |e: &mesh::Element| match &bat.profile.pieces[e.piece].radii {
        Radii::Cubic(cubics) if cubics.inner == [0.0; 4] => 0.0,
        Radii::Cubic(cubics) => {
            let walls = cubics.outer.iter().zip(&cubics.inner);
            let thinness =
                walls.map(|(outer, inner)| Section { outer: *outer, inner: *inner }.thinness());
            f64::EPSILON * thinness.fold(0.0, f64::max)
        }
        Radii::Formula(curves) => {
            curves.bounds(e.from, e.to).map_or(0.0, |bounds| bounds.round_off().min(1.0))
        }
    };
    mesh.elements.iter().map(of).fold(0.0, f64::max)
}

/// All elements of a mesh, as degree `N − 1` and the theory see them.
pub fn elements<const N: usize, const W: usize>(
    bat: &Bat,
    mesh: &Mesh,
    theory: Theory,
) -> Vec<Element<f64, N, W>> {
    let rule = Rule::of(bat, N - 1);
    let mut lists = [const { Vec::new() }; 4];
    let element = |e: &mesh::Element| {
        lists.iter_mut().for_each(Vec::clear);
        worths(bat, e, rule, |_, worth| {
            lists[0].push(worth.bending);
            lists[1].push(worth.mass);
            if theory.turns() {
                lists[2].push(worth.turning);
            }
            if theory.shears() {
                lists[3].push(worth.shear);
            }
        });
        let [bending, mass, turning, shear] = &lists;
        let samples = Samples { bending, mass, turning, shear };
        Element::new(e.length, e.start + 0.5 * e.length, rule, samples)
    };
    mesh.elements.iter().map(element).collect()
}

impl<const N: usize, const W: usize> Element<f64, N, W> {
    /// Strains of the unknowns `[w₁, θ₁, w₂, θ₂, b₂, b₃ …, g₀, g₁ …]`: mean curvature `(θ₂ −
    /// θ₁)/h`, its slope `3[(θ₁ − ψ) + (θ₂ − ψ)]/h` with the chord `ψ = (w₂ − w₁)/h − g₀`, the
    /// bubbles, whose amplitude `b_j` is the coefficient of `P_j` in the curvature, and the shear
    /// strains.
    pub fn strains_of_hermite(&self, u: &[f64]) -> Vector<f64, W> {
        let h = self.length;
        let sheared = if W > N { u[N] } else { 0.0 };
        let chord = (u[2] - u[0]) / h - sheared;
        let mut strains = [0.0; W];
        strains[0] = (u[3] - u[1]) / h;
        strains[1] = 3.0 * ((u[1] - chord) + (u[3] - chord)) / h;
        strains[2..W - 2].copy_from_slice(&u[4..W]);
        strains
    }

    /// Stiffness and mass for the unknowns `[w₁, θ₁, w₂, θ₂, b₂, b₃ …, g₀, g₁ …]`.
    ///
    /// A bubble's deflection and rotation vanish at both ends, because `P_j` with `j ≥ 2` has
    /// neither area nor moment.
    pub fn hermite(&self) -> (Matrix<f64, W>, Matrix<f64, W>) {
        let unit =
            |i: usize| -> Vector<f64, W> { std::array::from_fn(|j| f64::from(u8::from(i == j))) };
        let strains: Matrix<f64, W> = std::array::from_fn(|i| self.strains_of_hermite(&unit(i)));
        let shapes: [[Vector<f64, N>; 2]; W] = std::array::from_fn(|i| {
            let (u, [mut shape, mut turn]) = (unit(i), [[0.0; N]; 2]);
            let strains = &strains[i][..W - 2];
            integrated(self.length, strains, [u[0], u[1]], &mut shape, &mut turn);
            [shape, turn]
        });
        let times = |matrix: &Matrix<f64, N>, x: &[f64]| -> Vector<f64, N> {
            std::array::from_fn(|k| dot(&matrix[k], x))
        };
        let (mut stiffness, mut mass) = ([[0.0; W]; W], [[0.0; W]; W]);
        for i in 0..W {
            let bent = times(&self.stiffness, &strains[i][..N - 2]);
            let moved = times(&self.mass, &shapes[i][0]);
            let [turned, sheared] = match &self.beyond {
                Some(beyond) => {
                    let own = if W > N { &strains[i][N - 2..W - 2] } else { &[] };
                    [times(&beyond.turning, &shapes[i][1]), times(&beyond.shear, own)]
                }
                None => [[0.0; N]; 2],
            };
            for j in 0..W {
                stiffness[i][j] = dot(&bent, &strains[j][..N - 2]);
                if W > N {
                    stiffness[i][j] += dot(&sheared, &strains[j][N - 2..W - 2]);
                }
                mass[i][j] = dot(&moved, &shapes[j][0]) + dot(&turned, &shapes[j][1]);
            }
        }
        (stiffness, mass)
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A uniform element of length h with EI and ρA.
    fn uniform<const N: usize>(h: f64, bending: f64, line: f64) -> Element<f64, N, N> {
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
