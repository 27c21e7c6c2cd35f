//! What does a load do to a free bat: the compliance, by running sums.
//!
//! A free bat is statically determinate. Under a load in balance with itself the bending
//! moment follows from the ends by two running sums, the strains from the moment element by
//! element, slope and deflection from the strains by two more. So `K⁻¹` on the bending motions
//! needs no factorisation of `K`, nothing large is subtracted, and the error stays at ε however
//! many elements there are, where a factored `K` loses ε n⁴.
//!
//! The unknowns are the strains scaled by the Cholesky factor of their stiffness, `q = Lᵀc`, so
//! that the strain energy is `½ qᵀq`. With `S` the integration of strains to deflections and
//! `M⊥` the mass with the rigid motions taken out,
//!
//! ```text
//! A = L⁻¹ Sᵀ M⊥ S L⁻ᵀ
//! ```
//!
//! is symmetric, has the eigenvalues 1/ω² of the free bat's bending modes and no others:
//! the two rigid motions have no strain.
//!
//! The sums run outwards from a root where the bat is stiff, and the loads inwards to it. A thin
//! end, whose strains are the least certain, then moves nothing but itself; with the root in the
//! point of a cone, 4000 elements lost half the digits.

use crate::bat::Bat;
use crate::beam::element::{self, Element, Link, Matrix, Vector, over_strains};
use crate::beam::mesh::Mesh;
use crate::beam::rule::{MOST_POINTS, Rule};
use crate::quadrature::RunningSum;
use crate::real::{Over, Real};

/// Sums over more elements than this carry their rounding errors along.
const LONG: usize = 200;

/// The compliance of free bats, one in each lane of `R`, on elements of degree `N − 1`.
///
/// Vectors of strains hold `N − 2` numbers for each element, the knob side first, both sides from
/// the root outwards.
#[derive(Debug, Clone)]
pub struct Statics<R, const N: usize> {
    pub rule: &'static Rule,
    /// The elements in the order of the strains, each seen outwards.
    pub cells: Vec<Cell<R, N>>,
    /// How many of them are on the knob side.
    pub split: usize,
    /// EI (N m²) and ρA (kg/m) at the points of every cell, outwards.
    pub bending_stiffness: Vec<R>,
    pub mass_per_length: Vec<R>,
    /// Mass (kg) and line inertia about the balance point (kg m²), summed from the elements.
    pub mass: R,
    pub inertia: R,
    /// Position of the balance point from the knob end (m).
    pub balance: R,
    /// Energy of `½ qᵀq = 1`: a power of two near the greatest `EI h`, so that scaling a bat by
    /// powers of two scales every number in here by powers of two, and no digit changes.
    pub energy_unit: R,
    pub length: R,
}

/// An element on one side of the root, seen in that direction.
#[derive(Debug, Clone, Copy)]
pub struct Cell<R, const N: usize> {
    pub link: Link<R, N>,
    /// `L⁻¹` of the stiffness of its strains.
    pub inverse: Matrix<R, N>,
    /// Distance of its inner end from the balance point, counted outwards (m).
    pub arm: R,
}

impl<S: Real, const N: usize> Default for Cell<S, N> {
    fn default() -> Self {
        let (zero, zeros) = (S::default(), [S::default(); N]);
        let link = Link { mass: [zeros; N], lift: zeros, turn: zeros, length: zero };
        Self { link, inverse: [zeros; N], arm: zero }
    }
}

impl<S: Real, const N: usize> Cell<S, N> {
    /// `L⁻ᵀ q`: strains (1/m) from scaled strains.
    #[inline(always)]
    pub fn strains<R: Over<S>>(&self, q: &Vector<R, N>) -> Vector<R, N> {
        let mut strains = [R::default(); N];
        for i in 0..N - 2 {
            for j in 0..=i {
                strains[j] += q[i] * self.inverse[i][j];
            }
        }
        strains
    }
}

impl<const N: usize> Cell<f64, N> {
    /// `Lᵀ c`: scaled strains from strains.
    pub fn scaled_strains(&self, c: &Vector<f64, N>) -> Vector<f64, N> {
        let mut q = [0.0; N];
        for i in (0..N - 2).rev() {
            let known: f64 = (i + 1..N - 2).map(|k| self.inverse[k][i] * q[k]).sum();
            q[i] = (c[i] - known) / self.inverse[i][i];
        }
        q
    }
}

/// A rigid motion seen outwards: translation of the balance point and rotation.
#[derive(Debug, Clone, Copy, Default)]
pub struct Rigid<R> {
    pub push: R,
    pub turn: R,
}

impl<R: Real> Rigid<R> {
    /// The deflection at that distance from the balance point.
    #[inline(always)]
    pub fn deflection<S>(&self, arm: S) -> R
    where
        R: Over<S>,
    {
        self.push + self.turn * arm
    }

    /// The same seen from the other side: what turns outwards there turns inwards here.
    fn mirrored(self) -> Self {
        Self { turn: -self.turn, ..self }
    }
}

impl<R: Real, const N: usize> Statics<R, N> {
    /// Nothing yet; [`Self::assemble`] fills it.
    pub fn empty(bat: &Bat) -> Self {
        let zero = R::default();
        Self {
            rule: Rule::of(bat, N - 1),
            cells: vec![],
            split: 0,
            bending_stiffness: vec![],
            mass_per_length: vec![],
            mass: zero,
            inertia: zero,
            balance: zero,
            energy_unit: zero,
            length: zero,
        }
    }

    /// The compliance of the bats, one per lane, all on the one mesh's pattern of elements.
    ///
    /// Memory is reused: the second bat of the same number of elements allocates nothing.
    #[inline(always)]
    pub fn assemble(&mut self, bats: &[&Bat], meshes: &[&Mesh]) {
        debug_assert!(bats.len() == R::LANES && meshes.len() == R::LANES);
        self.rule = Rule::of(bats[0], N - 1);
        let (points, count) = (self.rule.count(), meshes[0].len());
        let zero = R::default();
        self.bending_stiffness.clear();
        self.bending_stiffness.resize(count * points, zero);
        self.mass_per_length.clear();
        self.mass_per_length.resize(count * points, zero);
        let (mut mass, mut first) = (RunningSum::<R>::default(), RunningSum::<R>::default());
        let (mut greatest, mut stiffest) = (zero, 0.0);
        let mut at = zero;
        for k in 0..count {
            let range = k * points..(k + 1) * points;
            let bending = &mut self.bending_stiffness[range.clone()];
            let line = &mut self.mass_per_length[range];
            let (mut length, mut start) = (zero, zero);
            for (lane, (bat, mesh)) in bats.iter().zip(meshes).enumerate() {
                let e = &mesh.elements[k];
                length.set_lane(lane, e.length);
                start.set_lane(lane, e.start);
                element::sections(bat, e, self.rule, |i, stiffness, mass| {
                    bending[i].set_lane(lane, stiffness);
                    line[i].set_lane(lane, mass);
                });
            }
            let [here, moment] = self.rule.integrals(line);
            let stiffness = length * self.rule.integrals(bending)[0];
            let here = length * here;
            mass.add(here);
            first.add(start * here + length * length * moment);
            greatest = greatest.max(stiffness);
            stiffest = f64::max(stiffest, stiffness.lane(0) / length.lane(0));
            at = start + length;
        }
        self.length = at;
        self.mass = mass.value();
        self.balance = first.value() / self.mass;
        self.energy_unit = greatest;
        (0..R::LANES).for_each(|lane| {
            self.energy_unit.set_lane(lane, power_of_two_below(greatest.lane(lane)));
        });
        self.split = self.root(count, stiffest);
        self.fill(meshes);
    }

    /// The middle one of the elements whose bending stiffness is at least half the greatest.
    #[inline(always)]
    fn root(&self, elements: usize, stiffest: f64) -> usize {
        let points = self.rule.count();
        let stiff = |k: &usize| {
            let sections = &self.bending_stiffness[k * points..(k + 1) * points];
            let weighted =
                self.rule.points.iter().zip(sections).map(|(p, ei)| p.weight * ei.lane(0));
            weighted.sum::<f64>() >= 0.5 * stiffest
        };
        let count = (0..elements).filter(stiff).count();
        (0..elements).filter(stiff).nth(count / 2).unwrap_or(0)
    }

    /// The cells of both sides from the sections, and the inertia.
    #[inline(always)]
    fn fill(&mut self, meshes: &[&Mesh]) {
        let (points, half, balance) = (self.rule.count(), R::splat(0.5), self.balance);
        let mut inertia = RunningSum::<R>::default();
        let count = meshes[0].len();
        self.cells.resize(count, Cell::default());
        // The knob side's sections come outwards too: last element first, points reversed.
        self.bending_stiffness[..self.split * points].reverse();
        self.mass_per_length[..self.split * points].reverse();
        for place in 0..count {
            let knob_side = place < self.split;
            let k = if knob_side { self.split - 1 - place } else { place };
            let (mut length, mut start) = (R::default(), R::default());
            for (lane, mesh) in meshes.iter().enumerate() {
                length.set_lane(lane, mesh.elements[k].length);
                start.set_lane(lane, mesh.elements[k].start);
            }
            let range = place * points..(place + 1) * points;
            let middle = start + half * length;
            let element = Element::<R, N>::new(
                length,
                middle,
                self.rule,
                &self.bending_stiffness[range.clone()],
                &self.mass_per_length[range],
            );
            let arm = if knob_side { balance - (start + length) } else { start - balance };
            let (middle, m) = (arm + half * length, &element.mass);
            // ∫ρA y² dx about the balance point, outwards.
            inertia.add(
                middle * (middle * m[0][0] + length * m[0][1])
                    + half * half * length * length * m[1][1],
            );
            let cell = &mut self.cells[place];
            cell.arm = arm;
            element.invert_factor(self.energy_unit, &mut cell.inverse);
            element.connect(&cell.inverse, &mut cell.link);
        }
        self.inertia = inertia.value();
    }

    /// Scaled strains under bending moments (N m): `L⁻¹ ∫ M P_j dx`, the Galerkin solution of
    /// `EI w″ = M`. `moments` gets the places of a cell's points, 0 to 1 along the bat, and leaves
    /// the moments there.
    #[inline(always)]
    pub fn strains_of_moments(&self, out: &mut [R], mut moments: impl FnMut(&mut [R])) {
        let (points, scale) = (self.rule.count(), R::splat(1.0) / self.length);
        let balance = self.balance * scale;
        for (place, (cell, q)) in self.cells.iter().zip(out.chunks_exact_mut(N - 2)).enumerate() {
            let (first, step) = (cell.arm * scale, cell.link.length * scale);
            let mut values = [R::default(); MOST_POINTS];
            for (s, point) in values.iter_mut().zip(&self.rule.points) {
                let arm = first + R::splat(point.s) * step;
                *s = if place < self.split { balance - arm } else { balance + arm };
            }
            moments(&mut values[..points]);
            let mut work = [R::default(); N];
            for (i, (value, point)) in values.iter().zip(&self.rule.points).enumerate() {
                let share = R::splat(point.weight) * cell.link.length * *value;
                for (work, p) in work.iter_mut().zip(self.rule.at::<N>(i)) {
                    *work += share * R::splat(*p);
                }
            }
            for i in 0..N - 2 {
                q[i] = R::default();
                for j in 0..=i {
                    q[i] += cell.inverse[i][j] * work[j];
                }
            }
        }
    }

    /// Where Lanczos starts for `count` modes: bending moments with something of each wanted mode
    /// and little of the others.
    ///
    /// `s²(1 − s)² Σ_j a_j T_j(1 − 2(3s² − 2s³))`, `j ≤ count + 1`, `s` along the bat, `T_j`
    /// Chebyshev's polynomials, so that the terms are nearly `cos jπs`: moment and shear vanish at
    /// the free ends as a mode's do. The `a_j` are golden-ratio fractions, all different. A touch
    /// of every unknown is added, so that no mode is ever left out.
    #[inline(always)]
    pub fn start(&self, count: usize, out: &mut [R]) {
        const TOUCH: f64 = 1e-9;
        let number = R::splat;
        self.strains_of_moments(
            out,
            #[inline(always)]
            |places| {
                let [mut wave, mut before, mut now] = [[R::default(); MOST_POINTS]; 3];
                for (wave, s) in wave.iter_mut().zip(places.iter()) {
                    *wave = number(1.0) - number(2.0) * *s * *s * (number(3.0) - number(2.0) * *s);
                }
                // Clenshaw's recurrence, all points at once.
                for j in (0..count + 2).rev() {
                    let amplitude = number(0.2 + golden(j));
                    for ((wave, before), now) in
                        wave[..places.len()].iter().zip(&mut before).zip(&mut now)
                    {
                        (*now, *before) = (amplitude + (*wave + *wave) * *now - *before, *now);
                    }
                }
                for (i, s) in places.iter_mut().enumerate() {
                    let bump = *s * (number(1.0) - *s);
                    *s = bump * bump * (now[i] - wave[i] * before[i]);
                }
            },
        );
        let mut largest = R::default();
        out.iter().for_each(|q| largest = largest.max(q.abs()));
        for (k, q) in out.iter_mut().enumerate() {
            *q += number(TOUCH * (golden(k) - 0.5)) * largest;
        }
    }

    /// Number of unknowns: the bending modes of the discrete bat.
    pub fn dimension(&self) -> usize {
        (N - 2) * self.cells.len()
    }
}

impl<S: Real, const N: usize> Statics<S, N> {
    /// `y = A q`; `loads` is scratch space. Returns the rigid motion that was taken out of the
    /// motion with these strains when it is at rest at the root.
    #[inline(always)]
    pub fn apply<R: Over<S>>(
        &self,
        q: &[R],
        y: &mut [R],
        loads: &mut Vec<Vector<R, N>>,
    ) -> Rigid<R> {
        if self.cells.len() > LONG {
            self.compliance::<R, true>(q, y, loads)
        } else {
            self.compliance::<R, false>(q, y, loads)
        }
    }

    #[inline(always)]
    fn compliance<R: Over<S>, const KEEP: bool>(
        &self,
        q: &[R],
        y: &mut [R],
        loads: &mut Vec<Vector<R, N>>,
    ) -> Rigid<R> {
        let rigid = self.balanced::<R, KEEP>(q, loads);
        let (knob, tip) = self.cells.split_at(self.split);
        let (knob_loads, tip_loads) = loads.split_at(self.split);
        let strains = (N - 2) * self.split;
        let (knob_y, tip_y) = y.split_at_mut(strains);
        inwards::<S, R, N, KEEP>(knob, knob_loads, rigid.mirrored(), knob_y);
        inwards::<S, R, N, KEEP>(tip, tip_loads, rigid, tip_y);
        rigid
    }

    /// The rigid motion alone that [`Self::apply`] takes out: half the work.
    #[inline(always)]
    pub fn rigid<R: Over<S>>(&self, q: &[R], loads: &mut Vec<Vector<R, N>>) -> Rigid<R> {
        if self.cells.len() > LONG {
            self.balanced::<R, true>(q, loads)
        } else {
            self.balanced::<R, false>(q, loads)
        }
    }

    /// Outwards on both sides: leaves the loads, returns the rigid motion they add up to.
    #[inline(always)]
    fn balanced<R: Over<S>, const KEEP: bool>(
        &self,
        q: &[R],
        loads: &mut Vec<Vector<R, N>>,
    ) -> Rigid<R> {
        loads.resize(self.cells.len(), [R::default(); N]);
        let (knob, tip) = self.cells.split_at(self.split);
        let (knob_loads, tip_loads) = loads.split_at_mut(self.split);
        let (knob_q, tip_q) = q.split_at((N - 2) * self.split);
        let [knob_force, knob_moment] = outwards::<S, R, N, KEEP>(knob, knob_q, knob_loads);
        let [tip_force, tip_moment] = outwards::<S, R, N, KEEP>(tip, tip_q, tip_loads);
        Rigid {
            push: (knob_force + tip_force) / R::of(self.mass),
            turn: (tip_moment - knob_moment) / R::of(self.inertia),
        }
    }

    /// The cells of one side, the places they take among all, and a rigid motion seen from there.
    pub fn sides<R: Real>(&self, rigid: Rigid<R>) -> [(std::ops::Range<usize>, Rigid<R>); 2] {
        [(0..self.split, rigid.mirrored()), (self.split..self.cells.len(), rigid)]
    }
}

/// The fractional part of `(k + 1)` golden sections: numbers of no pattern in [0, 1).
fn golden(k: usize) -> f64 {
    ((k + 1) as f64 * 0.618_033_988_749_894_9).fract()
}

/// The scaled strains of one cell with its deflection and slope in the last two places.
#[inline(always)]
pub fn with_ends<R: Real, const N: usize>(q: &[R], w: R, theta: R) -> Vector<R, N> {
    let mut motion = [R::default(); N];
    motion[..N - 2].copy_from_slice(&q[..N - 2]);
    (motion[N - 2], motion[N - 1]) = (w, theta);
    motion
}

/// Integrates strains outwards from the root at rest and keeps every element's loads; returns
/// the force and the moment about the balance point of the side's inertia.
#[inline(always)]
fn outwards<S: Real, R: Over<S>, const N: usize, const KEEP: bool>(
    cells: &[Cell<S, N>],
    q: &[R],
    loads: &mut [Vector<R, N>],
) -> [R; 2] {
    let [mut w, mut theta, mut force, mut moment] = [RunningSum::<R, KEEP>::default(); 4];
    for ((cell, q), kept) in cells.iter().zip(q.chunks_exact(N - 2)).zip(loads) {
        let link = &cell.link;
        let motion = with_ends::<R, N>(q, w.value(), theta.value());
        let load = link.load(&motion);
        *kept = load;
        force.add(load[N - 2]);
        moment.add(load[N - 2] * cell.arm + load[N - 1]);
        w.add(theta.value() * link.length + over_strains(&link.lift, &motion));
        theta.add(over_strains(&link.turn, &motion));
    }
    [force.value(), moment.value()]
}

/// Shear and bending moment inwards from the free end, and with them the scaled strains: the
/// adjoint of [`outwards`], the loads of the rigid motion taken out.
#[inline(always)]
fn inwards<S: Real, R: Over<S>, const N: usize, const KEEP: bool>(
    cells: &[Cell<S, N>],
    loads: &[Vector<R, N>],
    rigid: Rigid<R>,
    y: &mut [R],
) {
    let [mut shear, mut bending] = [RunningSum::<R, KEEP>::default(); 2];
    for ((cell, load), y) in cells.iter().zip(loads).zip(y.chunks_exact_mut(N - 2)).rev() {
        let link = &cell.link;
        let [lifted, turned] = [&link.mass[N - 2], &link.mass[N - 1]];
        let lift = rigid.deflection(cell.arm);
        let mut f = *load;
        for i in 0..N {
            f[i] -= lift * lifted[i] + rigid.turn * turned[i];
        }
        let (v, m) = (shear.value(), bending.value());
        for k in 0..N - 2 {
            y[k] = f[k] + (v * link.lift[k] + m * link.turn[k]);
        }
        bending.add(v * link.length + f[N - 1]);
        shear.add(f[N - 2]);
    }
}

/// The greatest power of two that is not above a positive number.
fn power_of_two_below(value: f64) -> f64 {
    // The bits of a normal number without those of its fraction.
    f64::from_bits(value.to_bits() & !((1 << 52) - 1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::beam::element::elements;
    use crate::beam::motion::Motion;
    use crate::eigen::lanczos::dot;
    use crate::material::Material;
    use crate::profile::{Interpolation, Profile, Stations};

    fn bat(outer: [f64; 2]) -> Bat {
        let stations = Stations {
            x: vec![0.0, 0.8],
            outer: outer.to_vec(),
            inner: vec![0.0; 2],
            interpolation: Interpolation::Linear,
        };
        let material = Material::new(700.0, 14e9).unwrap();
        Bat::new("test", Profile::new(stations).unwrap(), material, None).unwrap()
    }

    fn statics<const N: usize>(bat: &Bat, count: usize) -> Statics<f64, N> {
        let mut statics = Statics::empty(bat);
        statics.assemble(&[bat], &[&Mesh::along(bat, count)]);
        statics
    }

    /// Strains of no particular kind.
    fn some(dimension: usize, offset: usize) -> Vec<f64> {
        (0..dimension).map(|k| ((k + offset) as f64 * 0.754_877).fract() - 0.5).collect()
    }

    fn symmetric<const N: usize>() {
        let statics = statics::<N>(&bat([0.012, 0.033]), 9);
        let size = statics.dimension();
        let (x, y) = (some(size, 1), some(size, 5));
        let (mut ax, mut ay) = (vec![0.0; size], vec![0.0; size]);
        statics.apply(&x, &mut ax, &mut Vec::new());
        statics.apply(&y, &mut ay, &mut Vec::new());
        let (left, right) = (dot(&y, &ax), dot(&x, &ay));
        assert!((left - right).abs() < 1e-14 * dot(&ax, &ax).sqrt(), "{N}");
    }

    #[test]
    fn the_compliance_is_symmetric() {
        symmetric::<4>();
        symmetric::<7>();
        symmetric::<13>();
    }

    /// `qᵀAq` is the kinetic energy of the motion with these strains, element by element in
    /// Legendre polynomials, and that motion carries neither momentum nor angular momentum.
    #[test]
    fn the_quadratic_form_of_the_compliance_is_the_kinetic_energy() {
        let bat = bat([0.033, 0.012]);
        let statics = statics::<6>(&bat, 7);
        let mut motion = Motion::default();
        motion.take(&statics, &some(statics.dimension(), 3), None, false);
        let elements = elements::<6>(&bat, &Mesh::along(&bat, 7));
        let [mut kinetic, mut momentum, mut spin] = [0.0; 3];
        for (place, outwards) in motion.shape.iter().enumerate() {
            let knob_side = place < statics.split;
            let e = &elements[if knob_side { statics.split - 1 - place } else { place }];
            // Seen outwards, odd polynomials change sign on the knob side.
            let turned = |k: usize| if knob_side && k % 2 == 1 { -1.0 } else { 1.0 };
            let w: [f64; 6] = std::array::from_fn(|k| turned(k) * outwards[k]);
            let load: [f64; 6] = std::array::from_fn(|k| dot(&e.mass[k], &w));
            kinetic += dot(&load, &w);
            momentum += load[0];
            spin += e.middle * load[0] + 0.5 * e.length * load[1];
        }
        assert!((motion.kinetic / kinetic - 1.0).abs() < 1e-13);
        assert!(momentum.abs() < 1e-13 * kinetic.sqrt() && spin.abs() < 1e-13 * kinetic.sqrt());
    }

    #[test]
    fn scaled_strains_of_strains_are_what_they_were() {
        let statics = statics::<9>(&bat([0.02, 0.03]), 3);
        for cell in &statics.cells {
            let mut q = [0.0; 9];
            q[..7].copy_from_slice(&some(7, 2));
            let back = cell.scaled_strains(&cell.strains(&q));
            for (a, b) in back.iter().zip(&q) {
                assert!((a - b).abs() < 1e-13, "{a} {b}");
            }
        }
    }
}
