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

use crate::beam::element::{Deflection, Element, Link, STRAINS};
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
    links: Vec<Link>,
    /// Distance of each inner end from the balance point, counted outwards (m).
    arms: Vec<f64>,
}

/// A bending motion, the rigid motions taken out of it.
#[derive(Debug, Clone)]
pub struct Motion {
    /// Deflection of every element, from the knob.
    pub shape: Vec<Deflection>,
    /// `wᵀMw` (kg m²), as `qᵀAq`.
    pub kinetic: f64,
    /// Rayleigh's quotient: ω² (1/s²) is strain energy over kinetic energy, both from the strains.
    pub omega: f64,
    /// `A q`.
    image: Vec<f64>,
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
        let knob_side = Side::new(
            before.iter().rev().map(|e| scaled(e).mirrored()).collect(),
            before.iter().rev().map(|e| balance - e.middle - 0.5 * e.length).collect(),
        );
        let tip_side = Side::new(
            after.iter().map(scaled).collect(),
            after.iter().map(|e| e.middle - 0.5 * e.length - balance).collect(),
        );
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

    /// `y = A q`; `loads` is scratch space. Returns the translation and the rotation that were
    /// taken out of the motion with these strains when it is at rest at the root.
    pub fn apply(&self, q: &[f64], y: &mut [f64], loads: &mut Vec<[f64; 4]>) -> [f64; 2] {
        if self.len() > LONG {
            self.compliance::<true>(q, y, loads)
        } else {
            self.compliance::<false>(q, y, loads)
        }
    }

    fn compliance<const KEEP: bool>(
        &self,
        q: &[f64],
        y: &mut [f64],
        loads: &mut Vec<[f64; 4]>,
    ) -> [f64; 2] {
        loads.resize(self.len(), [0.0; 4]);
        let split = self.knob_side.links.len();
        let (knob_loads, tip_loads) = loads.split_at_mut(split);
        let (knob_q, tip_q) = q.split_at(STRAINS * split);
        let knob = self.knob_side.outwards::<KEEP>(knob_q, knob_loads);
        let tip = self.tip_side.outwards::<KEEP>(tip_q, tip_loads);
        let push = (knob[0] + tip[0]) / self.mass;
        let turn = (tip[1] - knob[1]) / self.inertia;
        let (knob_y, tip_y) = y.split_at_mut(STRAINS * split);
        self.knob_side.inwards::<KEEP>(knob_loads, [push, -turn], knob_y);
        self.tip_side.inwards::<KEEP>(tip_loads, [push, turn], tip_y);
        [push, turn]
    }

    /// The bending motion with these strains.
    pub fn motion(&self, q: &[f64], loads: &mut Vec<[f64; 4]>) -> Motion {
        let mut image = vec![0.0; q.len()];
        let [push, turn] = self.apply(q, &mut image, loads);
        let mut shape = Vec::with_capacity(self.len());
        let (knob_q, tip_q) = q.split_at(STRAINS * self.knob_side.links.len());
        self.knob_side.deflections(knob_q, [push, -turn], &mut shape);
        // Outwards is backwards there: last first, and odd polynomials change sign.
        shape.reverse();
        shape.iter_mut().for_each(|w| [w[1], w[3]] = [-w[1], -w[3]]);
        self.tip_side.deflections(tip_q, [push, turn], &mut shape);
        let (strain, kinetic) = (dot(q, q), dot(q, &image));
        Motion { shape, kinetic, omega: (strain * self.energy_unit / kinetic).sqrt(), image }
    }

    /// `‖q − ω² A q‖/‖q‖`: how far a pair is from an eigenpair of the compliance.
    pub fn residual(&self, q: &[f64], omega: f64, motion: &Motion) -> f64 {
        let scale = omega * omega / self.energy_unit;
        let square = |(x, y): (&f64, &f64)| (x - scale * y).powi(2);
        (q.iter().zip(&motion.image).map(square).sum::<f64>() / dot(q, q)).sqrt()
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
}

impl Side {
    fn new(elements: Vec<Element>, arms: Vec<f64>) -> Self {
        let links = elements.iter().map(Element::link).collect();
        Self { elements, links, arms }
    }

    /// Integrates strains outwards from the root at rest and keeps every element's loads; returns
    /// the force and the moment about the balance point of the side's inertia.
    fn outwards<const KEEP: bool>(&self, q: &[f64], loads: &mut [[f64; 4]]) -> [f64; 2] {
        let [mut w, mut theta, mut force, mut moment] = [RunningSum::<KEEP>::default(); 4];
        let links = self.links.iter().zip(&self.arms);
        for (((link, arm), q), kept) in links.zip(q.chunks_exact(STRAINS)).zip(loads) {
            let q = [q[0], q[1]];
            let load = link.load(q, w.value(), theta.value());
            *kept = load;
            force.add(load[2]);
            moment.add(arm * load[2] + load[3]);
            let [risen, turned] = link.growth(q, theta.value());
            w.add(risen);
            theta.add(turned);
        }
        [force.value(), moment.value()]
    }

    /// Shear and bending moment inwards from the free end, and with them the scaled strains: the
    /// adjoint of [`Self::outwards`], the loads of the rigid motion taken out.
    fn inwards<const KEEP: bool>(&self, loads: &[[f64; 4]], [push, turn]: [f64; 2], y: &mut [f64]) {
        let [mut shear, mut bending] = [RunningSum::<KEEP>::default(); 2];
        let links = self.links.iter().zip(&self.arms);
        for (((link, arm), load), y) in links.zip(loads).zip(y.chunks_exact_mut(STRAINS)).rev() {
            let [_, _, lifted, turned] = &link.mass;
            let lift = push + turn * arm;
            let f: [f64; 4] =
                std::array::from_fn(|i| load[i] - (lift * lifted[i] + turn * turned[i]));
            let (v, m) = (shear.value(), bending.value());
            for k in 0..STRAINS {
                y[k] = f[k] + (link.lift[k] * v + link.turn[k] * m);
            }
            bending.add(link.length * v + f[3]);
            shear.add(f[2]);
        }
    }

    /// Deflections outwards from the root at rest, less a rigid motion.
    fn deflections(&self, q: &[f64], [push, turn]: [f64; 2], shape: &mut Vec<Deflection>) {
        let [mut w, mut theta] = [RunningSum::<true>::default(); 2];
        for ((e, arm), q) in self.elements.iter().zip(&self.arms).zip(q.chunks_exact(STRAINS)) {
            let c = e.strains([q[0], q[1]]);
            let mut deflection = e.deflection(c, w.value(), theta.value());
            let half = 0.5 * e.length;
            deflection[0] -= push + turn * (arm + half);
            deflection[1] -= turn * half;
            shape.push(deflection);
            let (turned, risen) = e.growth(c, theta.value());
            w.add(risen);
            theta.add(turned);
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

    fn bat(outer: [f64; 2], count: usize) -> (Vec<Element>, Statics) {
        let stations = Stations {
            x: vec![0.0, 0.8],
            outer: outer.to_vec(),
            inner: vec![0.0; 2],
            interpolation: Interpolation::Linear,
        };
        let material = Material::new(700.0, 14e9).unwrap();
        let bat = Bat::new("test", Profile::new(stations).unwrap(), material, None).unwrap();
        let elements = elements(&bat, &Mesh::along(&bat, count));
        let statics = Statics::new(&elements);
        (elements, statics)
    }

    /// Strains of no particular kind.
    fn some(dimension: usize, offset: usize) -> Vec<f64> {
        (0..dimension).map(|k| ((k + offset) as f64 * 0.754_877).fract() - 0.5).collect()
    }

    #[test]
    fn the_compliance_is_symmetric() {
        let (_, statics) = bat([0.012, 0.033], 9);
        let (x, y) = (some(18, 1), some(18, 5));
        let (mut ax, mut ay) = (vec![0.0; 18], vec![0.0; 18]);
        statics.apply(&x, &mut ax, &mut Vec::new());
        statics.apply(&y, &mut ay, &mut Vec::new());
        let (left, right) = (dot(&y, &ax), dot(&x, &ay));
        assert!((left - right).abs() < 1e-14 * dot(&ax, &ax).sqrt());
    }

    /// `qᵀAq` is the kinetic energy of the motion with these strains, element by element in
    /// Legendre polynomials, and that motion carries neither momentum nor angular momentum.
    #[test]
    fn the_quadratic_form_of_the_compliance_is_the_kinetic_energy() {
        let (elements, statics) = bat([0.033, 0.012], 7);
        let motion = statics.motion(&some(14, 3), &mut Vec::new());
        let [mut kinetic, mut momentum, mut spin] = [0.0; 3];
        for (e, w) in elements.iter().zip(&motion.shape) {
            let load = e.load(w);
            kinetic += load.iter().zip(w).map(|(f, w)| f * w).sum::<f64>();
            momentum += load[0];
            spin += e.middle * load[0] + 0.5 * e.length * load[1];
        }
        assert!((motion.kinetic / kinetic - 1.0).abs() < 1e-13);
        assert!(momentum.abs() < 1e-13 * kinetic.sqrt() && spin.abs() < 1e-13 * kinetic.sqrt());
    }

    #[test]
    fn strains_of_the_nodal_values_of_a_motion_are_its_strains() {
        let (_, statics) = bat([0.02, 0.03], 6);
        let q = some(12, 2);
        let h = 0.8 / 6.0;
        // End values of Legendre polynomials are 1; slopes are k(k + 1)/2 times 2/h.
        let shape = statics.motion(&q, &mut Vec::new()).shape;
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
