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

use std::f64::consts::PI;

use crate::beam::element::{Deflection, Element, STRAINS};
use crate::eigen::lanczos::dot;
use crate::quadrature::{RunningSum, sum};

/// Sums over more elements than this carry their rounding errors along.
const LONG: usize = 200;

/// The compliance of a free bat.
///
/// Vectors of strains hold the knob side first, both sides from the root outwards.
#[derive(Debug, Clone)]
pub struct Statics {
    knob_side: Side,
    tip_side: Side,
    /// Mass (kg) and line inertia about the balance point (kg m²), summed from the elements.
    mass: f64,
    inertia: f64,
    /// Energy of `½ qᵀq = 1`: a power of two near the greatest `EI h`, so that scaling a bat by
    /// powers of two scales every number in here by powers of two, and no digit changes.
    energy_unit: f64,
    length: f64,
}

/// The elements on one side of the root, outwards, each seen in that direction.
#[derive(Debug, Clone)]
struct Side {
    elements: Vec<Element>,
    /// Distance of each middle from the balance point, counted outwards (m).
    arms: Vec<f64>,
}

impl Statics {
    /// The compliance of a bat made of these elements, knob to tip.
    pub fn new(elements: &[Element]) -> Self {
        let over = |f: &dyn Fn(&Element) -> f64| sum(elements.iter().map(f));
        let mass = over(&|e| e.mass[0]);
        let balance = over(&|e| e.middle * e.mass[0] + 0.5 * e.length * e.mass[1]) / mass;
        let inertia = over(&|e| {
            let (arm, half) = (e.middle - balance, 0.5 * e.length);
            arm * (arm * e.mass[0] + 2.0 * half * e.mass[1]) + half * half * e.mass[2]
        });
        let greatest = elements.iter().map(|e| e.stiffness[0]).fold(0.0, f64::max);
        let energy_unit = power_of_two_below(greatest);
        let (before, after) = elements.split_at(root(elements));
        let scaled = |e: &Element| e.with_energy_unit(energy_unit);
        let knob_side = Side {
            elements: before.iter().rev().map(|e| scaled(e).mirrored()).collect(),
            arms: before.iter().rev().map(|e| balance - e.middle).collect(),
        };
        let tip_side = Side {
            elements: after.iter().map(scaled).collect(),
            arms: after.iter().map(|e| e.middle - balance).collect(),
        };
        let length = elements.last().map_or(0.0, |e| e.middle + 0.5 * e.length);
        Self { knob_side, tip_side, mass, inertia, energy_unit, length }
    }

    /// Number of unknowns: the bending modes of the discrete bat.
    pub fn dimension(&self) -> usize {
        STRAINS * self.len()
    }

    fn len(&self) -> usize {
        self.knob_side.elements.len() + self.tip_side.elements.len()
    }

    /// Where Lanczos starts for `count` modes: bending moments with something of each wanted mode
    /// and little of the others.
    ///
    /// `s²(1 − s)² Σ_j a_j cos jπs`, `s` along the bat, `j ≤ count + 1`: moment and shear vanish
    /// at the free ends as a mode's do. The `a_j` are golden-ratio fractions, all different.
    /// A touch of every unknown is added, so that no mode is ever left out.
    pub fn start(&self, count: usize) -> Vec<f64> {
        const TOUCH: f64 = 1e-9;
        let fraction = |j: usize| ((j + 1) as f64 * 0.618_033_988_749_894_9).fract();
        let amplitudes: Vec<f64> = (0..count + 2).map(|j| 0.2 + fraction(j)).collect();
        let mut start = Vec::with_capacity(self.dimension());
        let sides = self.knob_side.elements.iter().chain(&self.tip_side.elements);
        for (k, e) in sides.enumerate() {
            let s = e.middle / self.length;
            let moment = 16.0 * (s * (1.0 - s)).powi(2) * cosine_series(&amplitudes, PI * s);
            // Strain is moment over stiffness; scaled by the energy it is h/L₀₀ times the moment.
            let scale = e.length * e.inverse[0];
            start.push((moment + TOUCH * fraction(k)) * scale);
            start.push(TOUCH * (fraction(k + 7) - 0.5) * scale);
        }
        start
    }

    /// `y = A q`; `loads` is scratch space, one entry per element.
    pub fn apply(&self, q: &[f64], y: &mut [f64], loads: &mut Vec<Deflection>) {
        if self.len() > LONG {
            self.compliance::<true>(q, y, loads);
        } else {
            self.compliance::<false>(q, y, loads);
        }
    }

    fn compliance<const KEEP: bool>(&self, q: &[f64], y: &mut [f64], loads: &mut Vec<Deflection>) {
        loads.resize(self.len(), Deflection::default());
        let split = self.knob_side.elements.len();
        let (knob_loads, tip_loads) = loads.split_at_mut(split);
        let (knob_q, tip_q) = q.split_at(STRAINS * split);
        let load = |element: &Element, w: Deflection| element.load(&w);
        let knob = self.knob_side.integrate::<KEEP>(knob_q, knob_loads, load);
        let tip = self.tip_side.integrate::<KEEP>(tip_q, tip_loads, load);
        let [push, turn] = self.rigid_part(knob, tip);
        let (knob_y, tip_y) = y.split_at_mut(STRAINS * split);
        self.knob_side.resultants::<KEEP>(knob_loads, [push, -turn], knob_y);
        self.tip_side.resultants::<KEEP>(tip_loads, [push, turn], tip_y);
    }

    /// The bending motion with these strains, element by element from the knob, the rigid
    /// motions taken out.
    pub fn deflections(&self, q: &[f64]) -> Vec<Deflection> {
        let mut shape = vec![Deflection::default(); self.len()];
        let split = self.knob_side.elements.len();
        let (knob_shape, tip_shape) = shape.split_at_mut(split);
        let (knob_q, tip_q) = q.split_at(STRAINS * split);
        let knob = self.knob_side.integrate::<true>(knob_q, knob_shape, |_, w| w);
        let tip = self.tip_side.integrate::<true>(tip_q, tip_shape, |_, w| w);
        let [push, turn] = self.rigid_part(knob, tip);
        self.knob_side.take_out(knob_shape, [push, -turn]);
        self.tip_side.take_out(tip_shape, [push, turn]);
        knob_shape.reverse();
        knob_shape.iter_mut().for_each(|w| [w[1], w[3]] = [-w[1], -w[3]]);
        shape
    }

    /// Rayleigh's quotient ω² of strains with a bending motion of that kinetic energy `wᵀMw`.
    pub fn quotient(&self, q: &[f64], kinetic: f64) -> f64 {
        dot(q, q) * self.energy_unit / kinetic
    }

    /// `‖q − ω² A q‖/‖q‖`: how far a pair is from an eigenpair of the compliance.
    pub fn residual(&self, q: &[f64], omega: f64, loads: &mut Vec<Deflection>) -> f64 {
        let mut image = vec![0.0; q.len()];
        self.apply(q, &mut image, loads);
        let scale = omega * omega / self.energy_unit;
        image.iter_mut().zip(q).for_each(|(y, x)| *y = x - scale * *y);
        (dot(&image, &image) / dot(q, q)).sqrt()
    }

    /// `wᵀMw` (kg m²) of a deflection given element by element from the knob.
    pub fn kinetic(&self, shape: &[Deflection]) -> f64 {
        let knob = self.knob_side.elements.iter().rev();
        let mut total = RunningSum::<true>::default();
        for (k, (element, w)) in knob.chain(&self.tip_side.elements).zip(shape).enumerate() {
            let w = if k < self.knob_side.elements.len() { [w[0], -w[1], w[2], -w[3]] } else { *w };
            let load = element.load(&w);
            total.add(load.iter().zip(&w).map(|(f, w)| f * w).sum());
        }
        total.value()
    }

    /// Energy-scaled strains of nodal deflections and slopes `[w₀, θ₀, w₁, θ₁, …]`.
    pub fn strains_of_hermite(&self, u: &[f64]) -> Vec<f64> {
        let split = self.knob_side.elements.len();
        let knob = self.knob_side.elements.iter().enumerate().flat_map(|(k, e)| {
            let u = &u[2 * (split - 1 - k)..];
            e.energy_scaled(e.strains_of_hermite([u[2], -u[3], u[0], -u[1]]))
        });
        let tip = self.tip_side.elements.iter().enumerate().flat_map(|(k, e)| {
            let u = &u[2 * (split + k)..];
            e.energy_scaled(e.strains_of_hermite([u[0], u[1], u[2], u[3]]))
        });
        knob.chain(tip).collect()
    }

    /// Translation and rotation that take the force and the moment of both sides' inertia.
    fn rigid_part(&self, knob: [f64; 2], tip: [f64; 2]) -> [f64; 2] {
        [(knob[0] + tip[0]) / self.mass, (tip[1] - knob[1]) / self.inertia]
    }
}

impl Side {
    /// Integrates strains outwards from the root at rest and keeps `keep` of every element's
    /// deflection; returns the force and the moment about the balance point of its inertia.
    #[inline(always)]
    fn integrate<const KEEP: bool>(
        &self,
        q: &[f64],
        kept: &mut [Deflection],
        keep: impl Fn(&Element, Deflection) -> Deflection,
    ) -> [f64; 2] {
        let [mut w, mut theta, mut force, mut moment] = [RunningSum::<KEEP>::default(); 4];
        let elements = self.elements.iter().zip(&self.arms);
        for (((e, arm), q), kept) in elements.zip(q.chunks_exact(STRAINS)).zip(kept) {
            let c = e.strains([q[0], q[1]]);
            let deflection = e.deflection(c, w.value(), theta.value());
            let load = e.load(&deflection);
            *kept = keep(e, deflection);
            force.add(load[0]);
            moment.add(arm * load[0] + 0.5 * e.length * load[1]);
            let (turned, risen) = e.growth(c, theta.value());
            w.add(risen);
            theta.add(turned);
        }
        [force.value(), moment.value()]
    }

    /// Shear and bending moment inwards from the free end, and with them the scaled strains.
    fn resultants<const KEEP: bool>(
        &self,
        loads: &[Deflection],
        [push, turn]: [f64; 2],
        y: &mut [f64],
    ) {
        let [mut shear, mut bending] = [RunningSum::<KEEP>::default(); 2];
        let elements = self.elements.iter().zip(&self.arms);
        for (((e, arm), load), y) in elements.zip(loads).zip(y.chunks_exact_mut(STRAINS)).rev() {
            let m = &e.mass;
            let (a, b) = (push + turn * arm, turn * 0.5 * e.length);
            let f = [
                load[0] - (a * m[0] + b * m[1]),
                load[1] - (a * m[1] + b * m[2]),
                load[2] - (a * m[3] + b * m[4]),
                load[3] - (a * m[6] + b * m[7]),
            ];
            let (force, couple, s) = e.resultants(&f, shear.value(), bending.value());
            y.copy_from_slice(&e.scaled(s));
            shear.add(force);
            bending.add(couple);
        }
    }

    /// Takes a rigid motion out of deflections.
    fn take_out(&self, shape: &mut [Deflection], [push, turn]: [f64; 2]) {
        for ((e, arm), w) in self.elements.iter().zip(&self.arms).zip(shape) {
            w[0] -= push + turn * arm;
            w[1] -= turn * 0.5 * e.length;
        }
    }
}

/// The middle one of the elements whose bending stiffness is at least half the greatest.
fn root(elements: &[Element]) -> usize {
    let bending = |e: &Element| e.stiffness[0] / e.length;
    let greatest = elements.iter().map(bending).fold(0.0, f64::max);
    let stiff = |k: &usize| bending(&elements[*k]) >= 0.5 * greatest;
    let count = (0..elements.len()).filter(stiff).count();
    (0..elements.len()).filter(stiff).nth(count / 2).unwrap_or(0)
}

/// The greatest power of two that is not above a positive number.
fn power_of_two_below(value: f64) -> f64 {
    // The bits of a normal number without those of its fraction.
    f64::from_bits(value.to_bits() & !((1 << 52) - 1))
}

/// `Σ a_j cos jx` by Clenshaw's recurrence.
fn cosine_series(amplitudes: &[f64], x: f64) -> f64 {
    let twice = 2.0 * x.cos();
    let step = |(b1, b2): (f64, f64), a: &f64| (a + twice * b1 - b2, b1);
    let (b0, b1) = amplitudes.iter().rev().fold((0.0, 0.0), step);
    b0 - 0.5 * twice * b1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::Material;
    use crate::profile::{Interpolation, Profile, Stations};
    use crate::{bat::Bat, beam::element::elements, beam::mesh::Mesh};

    fn statics(outer: [f64; 2], count: usize) -> Statics {
        let stations = Stations {
            x: vec![0.0, 0.8],
            outer: outer.to_vec(),
            inner: vec![0.0; 2],
            interpolation: Interpolation::Linear,
        };
        let material = Material::new(700.0, 14e9).unwrap();
        let bat = Bat::new("test", Profile::new(stations).unwrap(), material, None).unwrap();
        Statics::new(&elements(&bat, &Mesh::along(&bat, count)))
    }

    /// Strains of no particular kind.
    fn some(dimension: usize, seed: usize) -> Vec<f64> {
        (0..dimension).map(|k| ((k + seed) as f64 * 0.754_877).fract() - 0.5).collect()
    }

    #[test]
    fn the_compliance_is_symmetric() {
        let statics = statics([0.012, 0.033], 9);
        let (x, y) = (some(18, 1), some(18, 5));
        let (mut ax, mut ay) = (vec![0.0; 18], vec![0.0; 18]);
        statics.apply(&x, &mut ax, &mut Vec::new());
        statics.apply(&y, &mut ay, &mut Vec::new());
        let (left, right) = (dot(&y, &ax), dot(&x, &ay));
        assert!((left - right).abs() < 1e-14 * dot(&ax, &ax).sqrt());
    }

    /// `qᵀAq` is the kinetic energy of the motion with these strains, and that motion carries
    /// neither momentum nor angular momentum.
    #[test]
    fn the_quadratic_form_of_the_compliance_is_the_kinetic_energy() {
        let statics = statics([0.033, 0.012], 7);
        let q = some(14, 3);
        let mut image = vec![0.0; 14];
        statics.apply(&q, &mut image, &mut Vec::new());
        let kinetic = statics.kinetic(&statics.deflections(&q));
        assert!((dot(&q, &image) / kinetic - 1.0).abs() < 1e-13);
    }

    #[test]
    fn strains_of_the_nodal_values_of_a_motion_are_its_strains() {
        let statics = statics([0.02, 0.03], 6);
        let q = some(12, 2);
        let h = 0.8 / 6.0;
        // End values of Legendre polynomials are 1; slopes are k(k + 1)/2 times 2/h.
        let shape = statics.deflections(&q);
        let left = |w: &Deflection| {
            [w[0] - w[1] + w[2] - w[3], (w[1] - 3.0 * w[2] + 6.0 * w[3]) * 2.0 / h]
        };
        let right =
            |w: &Deflection| [w.iter().sum::<f64>(), (w[1] + 3.0 * w[2] + 6.0 * w[3]) * 2.0 / h];
        let mut nodal: Vec<f64> = shape.iter().flat_map(left).collect();
        nodal.extend(right(shape.last().unwrap()));
        for (a, b) in statics.strains_of_hermite(&nodal).iter().zip(&q) {
            assert!((a - b).abs() < 1e-12, "{a} {b}");
        }
    }
}
