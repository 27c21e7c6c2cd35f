//! What does a load do to a free bat: the compliance, by running sums.
//!
//! A free bat is statically determinate. Under a load in balance with itself the bending
//! moment follows from the tip by two running sums, the strains from the moment element by
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

use crate::beam::element::{Deflection, Element, STRAINS};
use crate::quadrature::{RunningSum, sum};

/// The compliance of a free bat.
#[derive(Debug, Clone)]
pub struct Statics {
    pub elements: Vec<Element>,
    /// Mass (kg), balance point (m) and line inertia about it (kg m²), summed from the elements.
    mass: f64,
    balance_point: f64,
    inertia: f64,
}

impl Statics {
    pub fn new(elements: Vec<Element>) -> Self {
        let over = |f: &dyn Fn(&Element) -> f64| sum(elements.iter().map(f));
        let mass = over(&|e| e.mass[0]);
        let balance_point = over(&|e| e.middle * e.mass[0] + 0.5 * e.length * e.mass[1]) / mass;
        let inertia = over(&|e| {
            let (arm, half) = (e.middle - balance_point, 0.5 * e.length);
            arm * (arm * e.mass[0] + 2.0 * half * e.mass[1]) + half * half * e.mass[2]
        });
        Self { elements, mass, balance_point, inertia }
    }

    /// Number of unknowns: the bending modes of the discrete bat.
    pub fn dimension(&self) -> usize {
        STRAINS * self.elements.len()
    }

    /// Where Lanczos starts for `count` modes: bending moments with something of each wanted mode
    /// and little of the others.
    ///
    /// `s²(1 − s)² Σ_j a_j cos jπs`, `s` along the bat, `j ≤ count + 1`: moment and shear vanish
    /// at the free ends as a mode's do. The `a_j` are golden-ratio fractions, all different.
    /// A touch of every unknown is added, so that no mode is ever left out.
    pub fn start(&self, count: usize) -> Vec<f64> {
        let last = self.elements.last().expect("a bat has elements");
        let length = last.middle + 0.5 * last.length;
        const TOUCH: f64 = 1e-9;
        let amplitude = |j: usize| 0.2 + ((j + 1) as f64 * 0.618_033_988_749_894_9).fract();
        let mut start = Vec::with_capacity(self.dimension());
        for (k, e) in self.elements.iter().enumerate() {
            let s = e.middle / length;
            let waves: f64 = cosines(std::f64::consts::PI * s, count + 2)
                .enumerate()
                .map(|(j, cosine)| amplitude(j) * cosine)
                .sum();
            let moment = 16.0 * (s * (1.0 - s)).powi(2) * waves + TOUCH * amplitude(k);
            // Strain is moment over stiffness; scaled by the energy it is h/L₀₀ times the moment.
            start.push(moment * e.length * e.inverse[0]);
            start.push(TOUCH * (amplitude(k + 7) - 0.7) * e.length * e.inverse[0]);
        }
        start
    }

    /// `y = A q`; `loads` is scratch space, one entry per element.
    pub fn apply(&self, q: &[f64], y: &mut [f64], loads: &mut Vec<Deflection>) {
        let [force, moment] = self.integrate(q, loads, |element, w| element.load(&w));
        let (push, turn) = (force / self.mass, moment / self.inertia);
        // Back from the tip: `shear` and `bending` are the resultants of the load beyond.
        let (mut shear, mut bending) = (RunningSum::default(), RunningSum::default());
        let pairs = self.elements.iter().zip(loads.iter()).zip(y.chunks_exact_mut(STRAINS));
        for ((e, load), y) in pairs.rev() {
            let m = &e.mass;
            let (a, b) = (push + turn * (e.middle - self.balance_point), turn * 0.5 * e.length);
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

    /// The bending motion with these strains, element by element, the rigid motions taken out.
    pub fn deflections(&self, q: &[f64]) -> Vec<Deflection> {
        let mut shape = Vec::new();
        let [force, moment] = self.integrate(q, &mut shape, |_, w| w);
        let (push, turn) = (force / self.mass, moment / self.inertia);
        for (e, w) in self.elements.iter().zip(&mut shape) {
            w[0] -= push + turn * (e.middle - self.balance_point);
            w[1] -= turn * 0.5 * e.length;
        }
        shape
    }

    /// Energy-scaled strains of nodal deflections and slopes `[w₀, θ₀, w₁, θ₁, …]`.
    pub fn strains_of_hermite(&self, u: &[f64]) -> Vec<f64> {
        let scaled = |(k, e): (usize, &Element)| {
            let u = std::array::from_fn(|i| u[2 * k + i]);
            e.energy_scaled(e.strains_of_hermite(u))
        };
        self.elements.iter().enumerate().flat_map(scaled).collect()
    }

    /// Integrates strains from the knob to the tip and keeps `keep` of every element's
    /// deflection; returns the force and the moment about the balance point of its inertia.
    fn integrate(
        &self,
        q: &[f64],
        kept: &mut Vec<Deflection>,
        keep: impl Fn(&Element, Deflection) -> Deflection,
    ) -> [f64; 2] {
        kept.resize(self.elements.len(), Deflection::default());
        let (mut w, mut theta) = (RunningSum::default(), RunningSum::default());
        let (mut force, mut moment) = (RunningSum::default(), RunningSum::default());
        for ((e, q), kept) in self.elements.iter().zip(q.chunks_exact(STRAINS)).zip(kept) {
            let c = e.strains([q[0], q[1]]);
            let deflection = e.deflection(c, w.value(), theta.value());
            let load = e.load(&deflection);
            *kept = keep(e, deflection);
            force.add(load[0]);
            moment.add((e.middle - self.balance_point) * load[0] + 0.5 * e.length * load[1]);
            let (turned, risen) = e.growth(c, theta.value());
            w.add(risen);
            theta.add(turned);
        }
        [force.value(), moment.value()]
    }
}

/// `cos jx` for j = 0, 1, … by `cos (j+1)x = 2 cos x cos jx − cos (j−1)x`.
fn cosines(x: f64, count: usize) -> impl Iterator<Item = f64> {
    let twice = 2.0 * x.cos();
    std::iter::successors(Some((1.0, 0.5 * twice)), move |(now, next)| {
        Some((*next, twice * next - now))
    })
    .map(|(now, _)| now)
    .take(count)
}
