//! How far does a force anywhere on the bat deflect it, whatever the degree of its elements?
//!
//! Responses and hits are built on [`Flexible::new`] on a solution's mesh.
//!
//! In scaled strains q, with the unit of energy U, the strain energy is `½ U qᵀq` and the kinetic energy `½ q̇ᵀA q̇`. A
//! force at x does the work of `row(x)·q`. Free rigid motions are separate coordinates, to which these strains are
//! orthogonal.

use std::sync::{Arc, LazyLock};

use crate::base::quadrature::legendre;
use crate::base::{Result, dot, gauss};
use crate::bat::Bat;
use crate::beam::attached::Spring;
use crate::beam::element::MOST_STRAINS;
use crate::beam::placed::in_grip;
use crate::beam::sections::losses;
use crate::beam::sweep::Bare;
use crate::beam::{Depth, Elements, MOST_POINTS, Mesh, Motion, View};
use crate::modes::mode::Shape;
use crate::modes::pairs::{Pairs, pairs_of};

/// A bat's strains on a mesh, with the effects of forces and motions on them.
pub struct Flexible {
    pairs: Box<dyn Pairs>,
    mesh: Mesh,
    stretches: Arc<Vec<(f64, f64)>>,
    /// Number of strains.
    pub dimension: usize,
    /// Strain energy of `½ qᵀq = 1` (J).
    pub energy_unit: f64,
    /// The free rigid motions.
    pub rigid: Vec<RigidMotion>,
    /// The dashpots on the bat and in the hands.
    pub dashpots: Vec<Dashpot>,
    /// Extension of each absorber's spring by strains, one after the other.
    pub hung: Vec<Drawn>,
    /// Loss factors in bending and shear at the points of every cell; empty if there are none.
    losses: Vec<[f64; 2]>,
}

/// A free rigid motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidMotion {
    /// Deflection at the balance point (m).
    pub push: f64,
    /// Rotation (rad).
    pub turn: f64,
    /// Position of the balance point (m).
    pub balance: f64,
    /// Modal mass of the rigid motion (kg, or kg m² for a rotation of 1 rad).
    pub mass: f64,
}

impl RigidMotion {
    /// The deflection at `x`.
    pub fn deflection(&self, x: f64) -> f64 {
        self.push + self.turn * (x - self.balance)
    }
}

/// A dashpot and its extension.
#[derive(Debug, Clone)]
pub struct Dashpot {
    /// Damping constant (N s/m).
    pub constant: f64,
    /// Extension of the dashpot by every free rigid motion (m).
    pub rigid: Vec<f64>,
    /// Extension of the dashpot by the strains.
    pub strains: Drawn,
}

/// Extension of a dashpot or a spring by strains.
#[derive(Debug, Clone)]
pub enum Drawn {
    /// Only the spring's own strain: its index, and metres per unit strain.
    Spring(usize, f64),
    /// All strains.
    All(Vec<f64>),
}

impl Drawn {
    /// The extension by the strains `q` (m).
    pub fn by(&self, q: &[f64]) -> f64 {
        match self {
            Self::Spring(place, softness) => q[*place] * softness,
            Self::All(row) => dot(row, q),
        }
    }

    /// Adds the strains (times U) caused by that force of the dashpot.
    pub fn add_force(&self, force: f64, strains: &mut [f64]) {
        match self {
            Self::Spring(place, softness) => strains[*place] += force * softness,
            Self::All(row) => strains.iter_mut().zip(row).for_each(|(q, r)| *q += force * r),
        }
    }
}

impl Flexible {
    /// The bat on that mesh, with elements of that degree.
    pub fn new(bat: &Bat, elements: Elements) -> Self {
        let Elements { mesh, degree, theory } = elements;
        let mut pairs = pairs_of(bat, degree, theory);
        pairs.assemble(bat, mesh);
        let view = pairs.view();
        let View { bare: Bare { energy_unit, mass, inertia, balance, .. }, fixed, .. } = view;
        let free = fixed.map_or(vec![[1.0, 0.0], [0.0, 1.0]], |fixed| fixed.free().to_vec());
        let points = fixed.iter().flat_map(|fixed| &fixed.placed.points);
        let springs = points.filter_map(|point| point.spring);
        let hung = springs.map(|s| Drawn::Spring(s.place, s.softness)).collect();
        let dimension = view.dimension();
        let rigid = |[push, turn]: [f64; 2]| {
            let mass = push * push * mass + turn * turn * inertia;
            RigidMotion { push, turn, balance, mass }
        };
        let mut flexible = Self {
            pairs,
            mesh: mesh.clone(),
            stretches: Arc::new(mesh.stretches()),
            dimension,
            energy_unit,
            rigid: free.into_iter().map(rigid).collect(),
            dashpots: vec![],
            hung,
            losses: vec![],
        };
        flexible.dashpots = flexible.dashpots(bat);
        flexible.losses = flexible.losses(bat);
        flexible
    }

    /// ω (rad/s, rising) and unit strains of the slowest modes, as many as wanted or as there are, and the number of
    /// those at the beginning that are far slower than the others.
    ///
    /// # Errors
    ///
    /// As [`crate::eigen::lanczos::Lanczos::largest`].
    pub fn slowest(&mut self, count: usize) -> Result<(Vec<f64>, Vec<Vec<f64>>, usize)> {
        /// The smallest residual that arithmetic allows.
        const CONVERGED: f64 = 1e-13;
        let count = count.min(self.freedom());
        if count == 0 {
            return Ok((vec![], vec![], 0));
        }
        self.pairs.solve(count, CONVERGED)?;
        let apart = self.pairs.solve_apart(CONVERGED)?;
        let dimension = self.dimension;
        // The iteration's values are known to ε of the greatest; the ratio of the energies is more accurate.
        let own = std::mem::take(&mut self.pairs.lanczos().vectors);
        let mut motion = Motion::default();
        let omegas = (0..own.len() / dimension).map(|k| {
            let (slower, one) = own[..(k + 1) * dimension].split_at(k * dimension);
            let slower = if k < apart { &[] } else { slower };
            self.pairs.look_at_one(one, slower, Depth::Shape, &mut motion);
            motion.omega
        });
        let omegas = omegas.collect();
        Ok((omegas, own.chunks_exact(dimension).map(<[f64]>::to_vec).collect(), apart))
    }

    /// Number of modes of the discrete bat.
    pub fn freedom(&self) -> usize {
        self.pairs.view().freedom()
    }

    /// `M q = A q/U` (s²): strains under the inertia of the acceleration q.
    pub fn inertia(&self, q: &[f64]) -> Vec<f64> {
        let mut y = vec![0.0; q.len()];
        self.pairs.apply(q, &mut y);
        y.iter_mut().for_each(|y| *y /= self.energy_unit);
        y
    }

    /// Removes from strains what the contacts do not allow.
    pub fn project(&self, strains: &mut [f64]) {
        if let Some(fixed) = self.pairs.view().fixed {
            fixed.project(strains);
        }
    }

    /// Row of the deflection at `x` due to strains q: `w = row·q`, without free rigid motions. Divided by U, it is the
    /// strains under a unit force there.
    pub fn row(&self, x: f64) -> Vec<f64> {
        let elements = &self.mesh.elements;
        let e = elements.partition_point(|e| e.start <= x).max(1) - 1;
        let s = ((x - elements[e].start) / elements[e].length).clamp(0.0, 1.0);
        let split = self.pairs.view().split;
        match e < split {
            true => self.pairs.under_force(split - 1 - e, 1.0 - s),
            false => self.pairs.under_force(e, s),
        }
    }

    /// Deflection under a unit force at `x` that the element's polynomials do not represent (m/N): the bending moment
    /// has a kink there, and the shear force a step.
    ///
    /// With `f = (ξ − x)₊` and `P` the polynomials of the curvature, it is `∫f²/EI dξ` over the element, less that of
    /// the projection; and likewise `∫1/κGA dξ` of the step. The other parts of the moment are smooth, and the mesh
    /// represents them.
    pub fn unresolved(&self, x: f64, bat: &Bat) -> f64 {
        static RULE: LazyLock<Vec<(f64, f64)>> = LazyLock::new(|| gauss(10));
        let elements = &self.mesh.elements;
        let k = elements.partition_point(|e| e.start <= x).max(1) - 1;
        let view = self.pairs.view();
        let (e, split) = (&elements[k], view.split);
        let knob_side = k < split;
        let along = ((x - e.start) / e.length).clamp(0.0, 1.0);
        // Outwards, as the cell is stored.
        let (cell, at) = if knob_side { (split - 1 - k, 1.0 - along) } else { (k, along) };
        let (block, strains) = (view.terms - 2, view.strains);
        let mut loads = [0.0; MOST_STRAINS];
        let mut whole = 0.0;
        // Smooth from the place to the next station, and from station to station.
        let mut borders = e.parts(bat).map(|part| part.of_element[1]).collect::<Vec<_>>();
        borders.insert(0, 0.0);
        if knob_side {
            borders.reverse();
            borders.iter_mut().for_each(|s| *s = 1.0 - *s);
        }
        let part = |pair: &[f64]| [pair[0].max(at), pair[1]];
        for [from, to] in borders.windows(2).map(part).filter(|[from, to]| from < to) {
            for &(s, weight) in RULE.iter() {
                let s = from + (to - from) * s;
                let share = weight * (to - from) * e.length;
                let place = e.start + e.length * if knob_side { 1.0 - s } else { s };
                let (here, arm) = (bat.worth_at(place), (s - at) * e.length);
                whole += share * arm * arm / here.bending;
                let polynomials = legendre(block, 2.0 * s - 1.0);
                for (j, p) in polynomials[..block].iter().enumerate() {
                    loads[j] += share * arm * p;
                    if strains > block {
                        loads[block + j] += share * p;
                    }
                }
                if strains > block {
                    whole += share / here.shear;
                }
            }
        }
        let mut scaled = [0.0; MOST_STRAINS];
        view.cells.at(cell).scaled_by_loads(&loads[..strains], block, &mut scaled[..strains]);
        let missing = whole - dot(&scaled[..strains], &scaled[..strains]) / view.energy_unit;
        missing.max(0.0)
    }

    /// The deflection along the bat due to these strains, without free rigid motions.
    pub fn shape(&self, q: &[f64]) -> Shape {
        let mut motion = Motion::default();
        self.pairs.look_at_one(q, &[], Depth::Shape, &mut motion);
        Shape::of(&self.pairs.view(), &motion, &self.stretches)
    }

    /// Whether a material has a loss factor.
    pub fn loses(&self) -> bool {
        !self.losses.is_empty()
    }

    /// `K″ q`: the strains' stiffness times its loss factors, where all layers of a section bend alike; springs, joints
    /// and beds have no loss.
    pub fn loss(&self, q: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; q.len()];
        if self.losses.is_empty() {
            return out;
        }
        let mut strains = [0.0; MOST_STRAINS];
        let [mut values, mut work] = [[0.0; MOST_POINTS]; 2];
        let view = self.pairs.view();
        let (points, block) = (view.rule.count(), view.terms - 2);
        for k in 0..view.count {
            let cell = view.cells.at(k);
            let range = k * view.strains..(k + 1) * view.strains;
            let strains = &mut strains[..view.strains];
            cell.strains(&q[range.clone()], block, strains);
            work.fill(0.0);
            for part in 0..view.strains / block {
                let stiffness =
                    if part == 0 { view.bending_stiffness } else { view.shear_stiffness };
                view.rule.values(&strains[part * block..(part + 1) * block], &mut values);
                for (i, point) in view.rule.points.iter().enumerate() {
                    let at = k * points + i;
                    let share = point.weight * cell.length / view.energy_unit;
                    values[i] *= share * stiffness[at] * self.losses[at][part];
                }
                view.rule.moments(&values, &mut work[part * block..(part + 1) * block]);
            }
            cell.scaled_by_loads(&work[..view.strains], block, &mut out[range]);
        }
        out
    }

    /// The loss factors at the points of the cells, outwards.
    fn losses(&self, bat: &Bat) -> Vec<[f64; 2]> {
        if bat.layups().iter().all(|layup| layup.materials().all(|m| m.losses() == [0.0; 2])) {
            return vec![];
        }
        let View { bare: Bare { split, .. }, rule, .. } = self.pairs.view();
        let points = rule.count();
        let mut all = vec![[0.0; 2]; self.mesh.len() * points];
        for (k, e) in self.mesh.elements.iter().enumerate() {
            losses(bat, e, rule, |i, loss| all[k * points + i] = loss);
        }
        // The knob side is stored outwards too.
        all[..split * points].reverse();
        all
    }

    /// All dashpots: everything that damps the bat besides its materials.
    fn dashpots(&self, bat: &Bat) -> Vec<Dashpot> {
        let View { bare: Bare { energy_unit, split, .. }, rule, fixed, .. } = self.pairs.view();
        let contacts = fixed.iter().flat_map(|fixed| &fixed.placed.contacts);
        let beds = contacts.filter(|contact| contact.in_a_bed());
        let bed: Vec<Spring<f64>> = beds.filter_map(|contact| contact.spring).collect();
        let none = vec![0.0; self.rigid.len()];
        let beside =
            |constant: f64, strains: Drawn| Dashpot { constant, rigid: none.clone(), strains };
        let hung = bat.fixtures().absorbers.iter().zip(&self.hung);
        let mut all: Vec<Dashpot> =
            hung.map(|(absorber, drawn)| beside(absorber.damping, drawn.clone())).collect();
        if let Some(grip) = bat.fixtures().grip.filter(|grip| grip.damping > 0.0) {
            // One dashpot for each point of the bed, in proportion to its spring.
            let per_stiffness = grip.damping / grip.stiffness;
            let of = |softness: f64| per_stiffness * energy_unit / (softness * softness);
            let spring = |s: &Spring<f64>| Drawn::Spring(s.place, s.softness);
            all.extend(bed.iter().map(|s| beside(of(s.softness), spring(s))));
            if grip.stiffness == 0.0 {
                for (_, e) in in_grip(bat, &self.mesh, split) {
                    let e = &self.mesh.elements[e];
                    for point in &rule.points {
                        let x = e.start + point.s * e.length;
                        all.push(Dashpot {
                            constant: grip.damping * e.length * point.weight,
                            rigid: self.rigid.iter().map(|rigid| rigid.deflection(x)).collect(),
                            strains: Drawn::All(self.row(x)),
                        });
                    }
                }
            }
        }
        all.retain(|dashpot| dashpot.constant > 0.0);
        all
    }
}
/// `Σ c/ω²` (m/N) and `Σ c/ω⁴` (m s²/N) of modes with those gains, `square(k)` the ω² of mode k.
pub fn taken(gains: &[f64], square: impl Fn(usize) -> f64) -> [f64; 2] {
    gains.iter().enumerate().fold([0.0; 2], |[soft, slow], (k, gain)| {
        let square = square(k);
        [soft + gain / square, slow + gain / (square * square)]
    })
}
