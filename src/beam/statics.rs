//! What does a load do to a free bat? The compliance, by running sums.
//!
//! A free bat is statically determinate. Under a self-balanced load, two running sums from the ends give the bending
//! moment. The strains follow from the moment element by element, and slope and deflection from the strains by two more
//! sums. So `K⁻¹` on the bending motions needs no factorisation of `K`, nothing large is subtracted, and the error
//! stays at ε for any number of elements, whereas a factored `K` loses ε n⁴.
//!
//! The unknowns are the strains scaled by the Cholesky factor of their stiffness, `q = Lᵀc`, so
//! that the strain energy is `½ qᵀq`. With `S` the integration of strains to deflections and
//! `M⊥` the mass with the rigid motions taken out,
//!
//! ```text
//! A = L⁻¹ Sᵀ M⊥ S L⁻ᵀ
//! ```
//!
//! is symmetric. Its eigenvalues are exactly the 1/ω² of the free bat's bending modes: the two rigid motions have no
//! strain.
//!
//! The sums run outwards from a root where the bat is stiff, and the loads inwards to it. The strains of a thin end are
//! the least certain ones, and with this root they move only that end. With the root in the point of a cone, 4000
//! elements lost half the digits.

use crate::base::{Real, RunningSum, vectorized};
use crate::bat::{Bat, Theory, Worth};
use crate::beam::element::{Element, Samples};
use crate::beam::fixed::Fixed;
use crate::beam::mesh::Mesh;
use crate::beam::rule::{MOST_POINTS, Rule};
use crate::beam::sections::{self, sampled};
use crate::beam::sweep::{Body, Cell, Inwards, Loads, Outwards, Rigid};

/// Sums over more elements than this carry their rounding errors along. Up to here the round-off is at most
/// `200 ε = 4e-14`, below every error that is stated; the example `tuning_round_off` prints its effect.
const LONG: usize = 200;

/// The compliance of bats, one in each lane of `R`, on elements of degree `N − 1` with `W − 2` strains.
///
/// Vectors of strains hold `W − 2` numbers for each element, first the knob side, both sides from the root outwards,
/// and then those of springs.
#[derive(Debug, Clone)]
pub struct Statics<R, const N: usize, const W: usize> {
    /// Where the elements are sampled.
    pub rule: &'static Rule,
    /// The beam theory.
    pub theory: Theory,
    /// The elements in the order of the strains, each seen outwards.
    pub cells: Vec<Cell<R, W>>,
    /// Number of elements on the knob side.
    pub split: usize,
    /// Prescribed number of elements on the knob side; `None` lets the bat choose.
    pub rooted: Option<usize>,
    /// EI (N m²) at the points of every cell, outwards.
    pub bending_stiffness: Vec<R>,
    /// ρA (kg/m) at the same points.
    pub mass_per_length: Vec<R>,
    /// ρI (kg m) at the same points, of a theory whose sections turn.
    pub turning_per_length: Vec<R>,
    /// κGA (N) at the same points, of a theory with shear.
    pub shear_stiffness: Vec<R>,
    /// 1/EI (1/(N m²)) and 1/κGA (1/N) at the same points, as far as the theory needs them.
    pub softness: [Vec<R>; 2],
    /// Whether elements reach over stations: there the softness is a separate polynomial.
    pub over: bool,
    /// Mass (kg), summed from the elements and the fixtures.
    pub mass: R,
    /// The theory's inertia about the balance point (kg m²), summed likewise.
    pub inertia: R,
    /// Position of the balance point from the knob end (m).
    pub balance: R,
    /// Energy of `½ qᵀq = 1`: a power of two near the greatest `EI h`. Scaling a bat by powers of two then scales every
    /// number by powers of two and changes no digit.
    pub energy_unit: R,
    /// Length of the bat (m).
    pub length: R,
    /// The fixtures, if any; several bats may have only masses.
    pub fixed: Option<Box<Fixed<R>>>,
}

impl<R: Real, const N: usize, const W: usize> Statics<R, N, W> {
    /// An empty value, which [`Self::assemble`] fills.
    pub fn empty(bat: &Bat, theory: Theory) -> Self {
        debug_assert!(theory.shears() == (W > N));
        let zero = R::default();
        Self {
            rule: Rule::of(bat, false, N - 1),
            theory,
            cells: vec![],
            split: 0,
            rooted: None,
            bending_stiffness: vec![],
            mass_per_length: vec![],
            turning_per_length: vec![],
            shear_stiffness: vec![],
            softness: [vec![], vec![]],
            over: false,
            mass: zero,
            inertia: zero,
            balance: zero,
            energy_unit: zero,
            length: zero,
            fixed: None,
        }
    }

    /// Assembles the compliance of the bats, one per lane, all on the same pattern of elements.
    ///
    /// Memory is reused: the second bat of the same number of elements allocates nothing.
    #[inline(always)]
    pub fn assemble(&mut self, bats: &[&Bat], meshes: &[&Mesh]) {
        debug_assert!(bats.len() == R::LANES && meshes.len() == R::LANES);
        let over = meshes[0].over_stations();
        self.rule = Rule::of(bats[0], over, N - 1);
        self.over = over;
        self.make_room(meshes[0].len());
        if over {
            self.sample_over_stations(bats, meshes);
        } else if self.theory.turns() {
            self.sample_the_rest(bats, meshes);
        }
        let stiffest = self.add_up(bats, meshes, over);
        self.split = self.rooted.unwrap_or_else(|| self.root(meshes[0].len(), stiffest));
        self.fill(meshes);
        self.fixed = None;
        if !bats[0].fixtures().none_moving() {
            self.attach(bats);
            self.fixed = Some(Box::new(Fixed::new(&self.bare(), bats, meshes[0])));
        }
    }

    /// Allocates the values at the points of that number of elements, as far as the theory needs them.
    #[inline(always)]
    fn make_room(&mut self, count: usize) {
        let (samples, theory) = (count * self.rule.count(), self.theory);
        let [bending_softness, shear_softness] = &mut self.softness;
        for (values, asked) in [
            (&mut self.bending_stiffness, true),
            (&mut self.mass_per_length, true),
            (&mut self.turning_per_length, theory.turns()),
            (&mut self.shear_stiffness, theory.shears()),
            (bending_softness, true),
            (shear_softness, theory.shears()),
        ] {
            values.clear();
            values.resize(if asked { samples } else { 0 }, R::default());
        }
    }

    /// Sums length, mass and balance point of the elements and the fixtures, and finds the unit of energy. EI and ρA of
    /// elements that reach over no stations are sampled on the way. Returns the greatest `∫EI dx/h` of an element of
    /// the first bat (N m²).
    #[inline(always)]
    fn add_up(&mut self, bats: &[&Bat], meshes: &[&Mesh], over: bool) -> f64 {
        let (points, zero) = (self.rule.count(), R::default());
        let (mut mass, mut first) = (RunningSum::<R>::default(), RunningSum::<R>::default());
        let (mut greatest, mut stiffest) = (zero, 0.0);
        let mut at = zero;
        for k in 0..meshes[0].len() {
            let range = k * points..(k + 1) * points;
            let bending = &mut self.bending_stiffness[range.clone()];
            let line = &mut self.mass_per_length[range.clone()];
            let soft = &mut self.softness[0][range.clone()];
            let (mut length, mut start) = (zero, zero);
            for (lane, (bat, mesh)) in bats.iter().zip(meshes).enumerate() {
                let e = &mesh.elements[k];
                length.set_lane(lane, e.length);
                start.set_lane(lane, e.start);
                if over {
                    continue;
                }
                sections::bending_and_mass(bat, e, self.rule, |i, [stiffness, mass]| {
                    bending[i].set_lane(lane, stiffness);
                    line[i].set_lane(lane, mass);
                    soft[i].set_lane(lane, 1.0 / stiffness);
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
        let [on, moment] = each(bats, |bat| {
            let masses = bat.fixtures().masses();
            masses.fold([0.0; 2], |[on, moment], [mass, x, _]| [on + mass, moment + mass * x])
        });
        mass.add(on);
        first.add(moment);
        self.length = at;
        self.mass = mass.value();
        self.balance = first.value() / self.mass;
        self.energy_unit = greatest;
        (0..R::LANES).for_each(|lane| {
            self.energy_unit.set_lane(lane, power_of_two_below(greatest.lane(lane)));
        });
        stiffest
    }

    /// Samples all values on meshes with elements over stations.
    #[inline(always)]
    fn sample_over_stations(&mut self, bats: &[&Bat], meshes: &[&Mesh]) {
        let (points, theory) = (self.rule.count(), self.theory);
        for (lane, (bat, mesh)) in bats.iter().zip(meshes).enumerate() {
            for (k, e) in mesh.elements.iter().enumerate() {
                let [soft, slip] = &mut self.softness;
                let all = [
                    &mut self.bending_stiffness,
                    &mut self.mass_per_length,
                    soft,
                    &mut self.turning_per_length,
                    &mut self.shear_stiffness,
                    slip,
                ];
                let keep = |sampled: &[[f64; MOST_POINTS]]| {
                    for (values, own) in all.into_iter().zip(sampled) {
                        for (value, own) in values[k * points..(k + 1) * points].iter_mut().zip(own)
                        {
                            value.set_lane(lane, *own);
                        }
                    }
                };
                match theory {
                    Theory::EulerBernoulli | Theory::Auto => {
                        keep(&sampled(bat, e, self.rule, |layup, section| {
                            let [bending, mass] = layup.bending_and_mass(section);
                            [bending, mass, 1.0 / bending]
                        }))
                    }
                    Theory::Rayleigh => keep(&sampled(bat, e, self.rule, |layup, section| {
                        let [bending, mass] = layup.bending_and_mass(section);
                        [bending, mass, 1.0 / bending, layup.turning(section)]
                    })),
                    Theory::Timoshenko => keep(&sampled(bat, e, self.rule, |layup, section| {
                        let Worth { bending, mass, turning, shear } = layup.worth(section);
                        [bending, mass, 1.0 / bending, turning, shear, 1.0 / shear]
                    })),
                }
            }
        }
    }

    /// Samples ρI and κGA at the points, as far as the theory needs them.
    fn sample_the_rest(&mut self, bats: &[&Bat], meshes: &[&Mesh]) {
        let (points, shears) = (self.rule.count(), self.theory.shears());
        for (lane, (bat, mesh)) in bats.iter().zip(meshes).enumerate() {
            for (k, e) in mesh.elements.iter().enumerate() {
                sections::worths(bat, e, self.rule, |i, worth| {
                    let place = k * points + i;
                    self.turning_per_length[place].set_lane(lane, worth.turning);
                    if shears {
                        self.shear_stiffness[place].set_lane(lane, worth.shear);
                        self.softness[1][place].set_lane(lane, 1.0 / worth.shear);
                    }
                });
            }
        }
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
        // The knob side's sections are stored outwards too: last element first, points reversed.
        let [bending_softness, shear_softness] = &mut self.softness;
        for samples in [
            &mut self.bending_stiffness,
            &mut self.mass_per_length,
            &mut self.turning_per_length,
            &mut self.shear_stiffness,
            bending_softness,
            shear_softness,
        ] {
            let knob_side = (self.split * points).min(samples.len());
            samples[..knob_side].reverse();
        }
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
            let samples = Samples {
                bending: &self.bending_stiffness[range.clone()],
                mass: &self.mass_per_length[range.clone()],
                turning: self.turning_per_length.get(range.clone()).unwrap_or(&[]),
                shear: self.shear_stiffness.get(range).unwrap_or(&[]),
            };
            let element = Element::<R, N, W>::new(length, middle, self.rule, samples);
            let arm = if knob_side { balance - (start + length) } else { start - balance };
            let (middle, m) = (arm + half * length, &element.mass);
            // ∫ρA y² dx about the balance point, outwards.
            inertia.add(
                middle * (middle * m[0][0] + length * m[0][1])
                    + half * half * length * length * m[1][1],
            );
            if let Some(beyond) = &element.beyond {
                inertia.add(beyond.turning[0][0]);
            }
            let cell = &mut self.cells[place];
            cell.arm = arm;
            element.invert_factor(self.energy_unit, &mut cell.inverse);
            element.connect(&cell.inverse, &mut cell.link);
        }
        self.inertia = inertia.value();
    }

    /// Adds the fixtures to the inertia.
    fn attach(&mut self, bats: &[&Bat]) {
        let balance = self.balance;
        let mut lanes = 0..R::LANES;
        let [attached] = each(bats, |bat| {
            let at = lanes.next().map_or(0.0, |lane| balance.lane(lane));
            let about = |[mass, x, own]: [f64; 3]| mass * (x - at) * (x - at) + own;
            [bat.fixtures().masses().map(about).sum()]
        });
        self.inertia += attached;
    }

    /// Number of strains.
    pub fn dimension(&self) -> usize {
        self.view().dimension()
    }
}

impl<R: Real, const N: usize, const W: usize> Statics<R, N, W> {
    /// The bare bat.
    pub fn body(&self) -> Body<'_, R, W> {
        Body { cells: &self.cells, split: self.split, mass: self.mass, inertia: self.inertia }
    }

    /// `y = A q`; `loads` is scratch space. Returns the rigid motion that was removed from the motion with these
    /// strains and the root at rest.
    pub fn apply(&self, q: &[R], y: &mut [R], loads: &mut Loads<R, W>) -> Rigid<R> {
        let (body, fixed) = (self.body(), self.fixed.as_deref());
        apply(&body, fixed, q, y, loads)
    }
}

/// The compliance of a bat times the strains `q`, written to `y`.
fn apply<R: Real, const W: usize>(
    body: &Body<'_, R, W>,
    fixed: Option<&Fixed<R>>,
    q: &[R],
    y: &mut [R],
    loads: &mut Loads<R, W>,
) -> Rigid<R> {
    vectorized!(match fixed {
        Some(fixed) => fixed.compliance(body, q, y, loads),
        None if body.cells.len() > LONG => body.compliance::<true>(q, y, loads),
        None => body.compliance::<false>(q, y, loads),
    })
}

impl<R: Real, const W: usize> Body<'_, R, W> {
    #[inline(always)]
    fn compliance<const KEEP: bool>(
        &self,
        q: &[R],
        y: &mut [R],
        loads: &mut Loads<R, W>,
    ) -> Rigid<R> {
        let rigid = self.balanced::<KEEP>(q, loads);
        let (knob, tip) = self.cells.split_at(self.split);
        let (knob_loads, tip_loads) = loads.cells.split_at(self.split);
        let (knob_y, tip_y) = y.split_at_mut((W - 2) * self.split);
        Inwards::<R, KEEP>::default().over(knob, knob_loads, rigid.mirrored(), knob_y);
        Inwards::<R, KEEP>::default().over(tip, tip_loads, rigid, tip_y);
        rigid
    }

    /// Both sides outwards: leaves the loads, returns the rigid motion that balances them.
    #[inline(always)]
    fn balanced<const KEEP: bool>(&self, q: &[R], loads: &mut Loads<R, W>) -> Rigid<R> {
        loads.cells.resize(self.cells.len(), [R::default(); W]);
        let (knob, tip) = self.cells.split_at(self.split);
        let (knob_loads, tip_loads) = loads.cells.split_at_mut(self.split);
        let (knob_q, tip_q) = q.split_at((W - 2) * self.split);
        let [mut knob_side, mut tip_side] = [Outwards::<R, KEEP>::default(); 2];
        knob_side.over(knob, knob_q, knob_loads);
        tip_side.over(tip, tip_q, tip_loads);
        let [knob_force, knob_moment] = [knob_side.force.value(), knob_side.moment.value()];
        let [tip_force, tip_moment] = [tip_side.force.value(), tip_side.moment.value()];
        Rigid {
            push: (knob_force + tip_force) / self.mass,
            turn: (tip_moment - knob_moment) / self.inertia,
        }
    }
}

/// Numbers of several bats, each bat in its lane.
fn each<R: Real, const Q: usize>(bats: &[&Bat], mut of: impl FnMut(&Bat) -> [f64; Q]) -> [R; Q] {
    let mut numbers = [R::default(); Q];
    for (lane, bat) in bats.iter().enumerate() {
        let own = of(bat);
        numbers.iter_mut().zip(own).for_each(|(number, own)| number.set_lane(lane, own));
    }
    numbers
}

/// The greatest power of two not above a positive number.
fn power_of_two_below(value: f64) -> f64 {
    // The bits of a normal number with the fraction cleared.
    f64::from_bits(value.to_bits() & !((1 << 52) - 1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::linear::dot;
    use crate::bat::fixtures::{Absorber, Attachment, Fixtures, Grip, Held, Joint, Support};
    use crate::bat::material::Material;
    use crate::bat::profile::{Interpolation, Profile, Stations};
    use crate::bat::weighed::Weighed;
    use crate::beam::changes::Depth;
    use crate::beam::hermite::elements;
    use crate::beam::motion::Motion;

    fn bat(outer: [f64; 2]) -> Bat {
        let stations = Stations {
            x: vec![0.0, 0.8],
            outer: outer.to_vec(),
            inner: vec![0.0; 2],
            interpolation: Interpolation::Linear,
        };
        let mut material = Material::new(700.0, 14e9).unwrap();
        material.shear_modulus = Some(1e9);
        Bat::builder(Profile::new(stations).unwrap(), material).name("test").build().unwrap()
    }

    const THEORIES: [Theory; 3] = Theory::ALL;

    fn statics<const N: usize, const W: usize>(
        bat: &Bat,
        count: usize,
        theory: Theory,
    ) -> Statics<f64, N, W> {
        let mut statics = Statics::empty(bat, theory);
        statics.assemble(&[bat], &[&Mesh::along(bat, count)]);
        statics
    }

    /// Arbitrary strains.
    fn some(dimension: usize, offset: usize) -> Vec<f64> {
        (0..dimension).map(|k| ((k + offset) as f64 * 0.754_877).fract() - 0.5).collect()
    }

    fn symmetric<const N: usize, const W: usize>(bat: &Bat, theory: Theory) {
        let statics = statics::<N, W>(bat, 9, theory);
        let size = statics.dimension();
        let (mut x, mut y) = (some(size, 1), some(size, 5));
        for strains in [&mut x, &mut y] {
            statics.fixed.iter().for_each(|fixed| fixed.project(strains));
        }
        let (mut ax, mut ay) = (vec![0.0; size], vec![0.0; size]);
        statics.apply(&x, &mut ax, &mut Loads::default());
        statics.apply(&y, &mut ay, &mut Loads::default());
        let (left, right) = (dot(&y, &ax), dot(&x, &ay));
        assert!((left - right).abs() < 1e-13 * dot(&ax, &ax).sqrt(), "{N} {W} {left} {right}");
    }

    #[test]
    fn the_compliance_is_symmetric() {
        let bat = bat([0.012, 0.033]);
        let [plain, rayleigh, timoshenko] = THEORIES;
        symmetric::<4, 4>(&bat, plain);
        symmetric::<7, 7>(&bat, rayleigh);
        symmetric::<13, 13>(&bat, plain);
        symmetric::<4, 6>(&bat, timoshenko);
        symmetric::<9, 16>(&bat, timoshenko);
    }

    #[test]
    fn the_compliance_of_a_bat_with_everything_on_it_is_symmetric() {
        let weight = Attachment {
            x: 0.31,
            mass: 0.2,
            offset: 0.02,
            rotary_inertia: 1e-4,
            stiffness: 1e4,
            rotational_stiffness: 50.0,
        };
        let mut fixtures = Fixtures {
            attachments: vec![weight, Attachment { x: 0.7, ..weight }],
            absorbers: vec![Absorber { x: 0.05, mass: 0.03, stiffness: 6e4, damping: 0.0 }],
            joints: vec![Joint { x: 0.4, rotational_stiffness: 900.0 }],
            grip: Some(Grip { from: 0.02, to: 0.2, stiffness: 4e5, damping: 0.0 }),
            ..Fixtures::default()
        };
        let supports = [(0.1, Held::Pinned), (0.8, Held::Clamped), (0.55, Held::Pinned)];
        for held in 0..=supports.len() {
            let support = |(x, kind): &(f64, Held)| Support { x: *x, kind: *kind };
            fixtures.supports = supports[..held].iter().map(support).collect();
            let bare = bat([0.012, 0.033]);
            let material = bare.material().clone();
            let profile = bare.profile().clone();
            let weighed = Weighed::default();
            let bat = Bat::builder(profile, material)
                .name("held")
                .fixtures(fixtures.clone())
                .weighed(weighed)
                .build();
            let bat = bat.unwrap();
            symmetric::<6, 6>(&bat, THEORIES[1]);
            symmetric::<6, 10>(&bat, THEORIES[2]);
        }
    }

    /// `qᵀAq` is the kinetic energy of the motion with these strains, summed over the elements in Legendre polynomials.
    /// That motion carries neither momentum nor angular momentum.
    fn kinetic<const N: usize, const W: usize>(theory: Theory) {
        let bat = bat([0.033, 0.012]);
        let statics = statics::<N, W>(&bat, 7, theory);
        let mut motion = Motion::default();
        motion.take_alone(&statics, &some(statics.dimension(), 3), &[], Depth::Shape);
        let elements = elements::<N, W>(&bat, &Mesh::along(&bat, 7), theory);
        let [mut kinetic, mut momentum, mut spin] = [0.0; 3];
        for (place, outwards) in motion.shape.chunks_exact(N).enumerate() {
            let knob_side = place < statics.split;
            let e = &elements[if knob_side { statics.split - 1 - place } else { place }];
            // Seen outwards, odd polynomials change sign on the knob side.
            let turned = |k: usize| if knob_side && k % 2 == 1 { -1.0 } else { 1.0 };
            let w: [f64; N] = std::array::from_fn(|k| turned(k) * outwards[k]);
            let load: [f64; N] = std::array::from_fn(|k| dot(&e.mass[k], &w));
            kinetic += dot(&load, &w);
            momentum += load[0];
            spin += e.middle * load[0] + 0.5 * e.length * load[1];
            if let Some(beyond) = &e.beyond {
                let turn: [f64; N] = match motion.turns.chunks_exact(N).nth(place) {
                    Some(turn) => std::array::from_fn(|k| turned(k + 1) * turn[k]),
                    None => slope(&w, e.length),
                };
                let load: [f64; N] = std::array::from_fn(|k| dot(&beyond.turning[k], &turn));
                kinetic += dot(&load, &turn);
                spin += load[0];
            }
        }
        assert!((motion.kinetic / kinetic - 1.0).abs() < 1e-12, "{theory:?} {kinetic}");
        assert!(momentum.abs() < 1e-13 * kinetic.sqrt(), "{theory:?} {momentum}");
        assert!(spin.abs() < 1e-13 * kinetic.sqrt(), "{theory:?} {spin}");
    }

    /// `dw/dx` in Legendre polynomials: `P′_k = Σ (2j + 1) P_j`, `j = k − 1, k − 3, …`.
    fn slope<const N: usize>(w: &[f64; N], h: f64) -> [f64; N] {
        std::array::from_fn(|j| {
            let above = (j + 1..N).step_by(2).map(|k| w[k]).sum::<f64>();
            2.0 / h * (2 * j + 1) as f64 * above
        })
    }

    #[test]
    fn the_quadratic_form_of_the_compliance_is_the_kinetic_energy() {
        kinetic::<6, 6>(THEORIES[0]);
        kinetic::<6, 6>(THEORIES[1]);
        kinetic::<6, 10>(THEORIES[2]);
    }

    #[test]
    fn scaled_strains_of_strains_are_what_they_were() {
        let statics = statics::<9, 9>(&bat([0.02, 0.03]), 3, THEORIES[0]);
        for cell in &statics.cells {
            let mut q = [0.0; 9];
            q[..7].copy_from_slice(&some(7, 2));
            let mut strains = [0.0; 9];
            cell.view().strains(&q[..7], 7, &mut strains[..7]);
            let back = cell.scaled_strains(&strains);
            for (a, b) in back.iter().zip(&q) {
                assert!((a - b).abs() < 1e-13, "{a} {b}");
            }
        }
    }
}
