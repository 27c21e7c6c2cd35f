//! How does a bat deform with fixtures on it and held at places?
//!
//! A point mass takes its motion from the pass outwards, and returns its force on the pass inwards. A joint is an
//! additional strain, the angle between its two sides.
//!
//! The displacement of a contact follows from the strains and the motion of the root. The loads on the bat, clamped at
//! its root, give strains; the result is the set of strains nearest to them that the contacts allow ([`Holds`]). If the
//! contacts leave rigid motions free, these are removed as for a free bat.

use crate::base::quadrature::legendre;
use crate::base::{Over, Real, RunningSum};
use crate::bat::Bat;
use crate::beam::attached::{Contact, Spring};
use crate::beam::holds::{Border, Build, Given, Holds, Span, Under};
use crate::beam::mesh::Mesh;
use crate::beam::placed::Placed;
use crate::beam::sweep::{Bare, Body, Inwards, Loads, Outwards, Rigid};
use crate::beam::walk::{Run, What, runs};

/// The fixtures on one bat and its supports.
#[derive(Debug, Clone)]
pub struct Fixed<S> {
    /// The fixtures, each at its place.
    pub placed: Placed<S>,
    /// The free rigid motions: translation and rotation about the balance point.
    free: Vec<[S; 2]>,
    /// The contacts, if there are any.
    holds: Option<Holds<S>>,
    /// Distance from the balance point to the root, towards the tip (m).
    root: S,
}

impl<S: Real> Fixed<S> {
    /// All fixtures of the bats, as in [`Placed::new`].
    pub fn new(bare: &Bare<S>, bats: &[&Bat], mesh: &Mesh) -> Self {
        let placed = Placed::new(bare, bats, mesh);
        let root = bare.cells.at(bare.split).arm;
        if placed.contacts.is_empty() {
            return Self { placed, root, ..Self::nothing() };
        }
        let holds = Holds::of([0, 1].map(|side| met(&placed, bare, side)));
        let (one, zero) = (S::splat(1.0), S::default());
        let free = match holds.held.map(|stiffness| stiffness > 0.0) {
            [true, true] => vec![],
            [true, false] => vec![[-(root + S::splat(holds.center)), one]],
            [false, _] => vec![[one, zero]],
        };
        Self { placed, free, holds: Some(holds), root }
    }

    /// A bat without fixtures and supports.
    pub fn nothing() -> Self {
        let (one, zero) = (S::splat(1.0), S::default());
        let free = vec![[one, zero], [zero, one]];
        Self { placed: Placed::default(), free, holds: None, root: zero }
    }

    /// Number of conditions that the strains must satisfy.
    pub fn redundant(&self) -> usize {
        self.placed.contacts.len() + self.free.len() - 2
    }

    /// Number of free rigid motions.
    pub fn rigid_modes(&self) -> usize {
        self.free.len()
    }

    /// The free rigid motions: translation and rotation about the balance point.
    pub fn free(&self) -> &[[S; 2]] {
        &self.free
    }

    /// `y = A q` of the held bat. Leaves the loads without the rigid motion's, and the forces of the contacts. Returns
    /// the rigid motion.
    pub fn compliance<R: Over<S>, const W: usize>(
        &self,
        body: &Body<S, W>,
        q: &[R],
        y: &mut [R],
        loads: &mut Loads<R, W>,
    ) -> Rigid<R> {
        self.make_room(body, loads);
        self.outwards(body, q, loads);
        self.strains_under(body, self.rigid(Given::Strains(q)), loads, y)
    }

    /// The scaled strains (times the unit of energy) of the held bat under a unit force at the place `s` in [0, 1],
    /// outwards, on a cell with that many terms in its deflection. The inertia of the free rigid motions balances the
    /// force.
    ///
    /// By Maxwell's theorem, their product with any scaled strains is the deflection there, without rigid motions.
    pub fn under_force<const W: usize>(
        &self,
        body: &Body<S, W>,
        terms: usize,
        cell: usize,
        s: f64,
    ) -> Vec<S> {
        let mut loads = Loads::default();
        self.make_room(body, &mut loads);
        let values = legendre(terms, 2.0 * s - 1.0);
        let load = body.cells[cell].view().point_load(&values[..terms]);
        loads.cells[cell].copy_from_slice(&load);
        let mut strains = vec![S::default(); body.cells.len() * (W - 2) + self.placed.springs];
        self.strains_under(body, Rigid::default(), &mut loads, &mut strains);
        strains
    }

    fn make_room<R: Real, const W: usize>(&self, body: &Body<S, W>, loads: &mut Loads<R, W>) {
        loads.cells.resize(body.cells.len(), [R::default(); W]);
        loads.points.resize(self.placed.points.len(), [R::default(); 2]);
        loads.contacts.clear();
        loads.contacts.resize(self.placed.contacts.len(), R::default());
    }

    /// The strains of the held bat under these loads after removal of the inertia of a rigid motion and of the residual
    /// load on the free motions. Returns the whole rigid motion.
    fn strains_under<R: Over<S>, const W: usize>(
        &self,
        body: &Body<S, W>,
        mut rigid: Rigid<R>,
        loads: &mut Loads<R, W>,
        y: &mut [R],
    ) -> Rigid<R> {
        let mut total = self.take_out(body, rigid, loads);
        // Twice: if one mass is far above all others, the first pass leaves its round-off.
        for _ in 0..2 {
            let free = self.free_part(body.mass, body.inertia, total);
            rigid = Rigid { push: rigid.push + free.push, turn: rigid.turn + free.turn };
            total = self.take_out(body, free, loads);
        }
        self.inwards(body, loads, y);
        self.balance(total, y, &mut loads.contacts);
        rigid
    }

    /// Integrates strains from the root at rest and leaves the loads of their inertia.
    fn outwards<R: Over<S>, const W: usize>(
        &self,
        body: &Body<S, W>,
        q: &[R],
        loads: &mut Loads<R, W>,
    ) {
        for side in [0, 1] {
            let mut way = Outwards::<R, true>::default();
            for Run { cells, stop } in runs(body.side(side), &self.placed.stops[side]) {
                let strains = &q[cells.start * (W - 2)..cells.end * (W - 2)];
                way.over(&body.cells[cells.clone()], strains, &mut loads.cells[cells]);
                match stop {
                    Some(What::PointMass(k)) => {
                        let point = &self.placed.points[k];
                        let moved = point.displaced(way.w.value(), way.theta.value(), q);
                        loads.points[k] = point.load(moved);
                    }
                    Some(What::Joint(k)) => {
                        let joint = &self.placed.joints[k];
                        way.theta.add(q[joint.place] * joint.softness);
                    }
                    Some(What::Contact(_)) | None => {}
                }
            }
        }
    }

    /// Removes the loads of a rigid motion. Returns the remaining force and moment about the balance point.
    fn take_out<R: Over<S>, const W: usize>(
        &self,
        body: &Body<S, W>,
        rigid: Rigid<R>,
        loads: &mut Loads<R, W>,
    ) -> [R; 2] {
        let mut total = [R::default(); 2];
        for side in [0, 1] {
            let (cells, rigid) = (body.side(side), rigid.on_side(side));
            let [mut force, mut moment] = [RunningSum::<R>::default(); 2];
            for (cell, load) in body.cells[cells.clone()].iter().zip(&mut loads.cells[cells]) {
                let [lifted, turned] = [&cell.link.mass[W - 2], &cell.link.mass[W - 1]];
                let lift = rigid.deflection(cell.arm);
                for i in 0..W {
                    load[i] -= lift * lifted[i] + rigid.turn * turned[i];
                }
                force.add(load[W - 2]);
                moment.add(load[W - 2] * cell.arm + load[W - 1]);
            }
            for stop in &self.placed.stops[side] {
                let What::PointMass(k) = stop.what else { continue };
                let point = &self.placed.points[k];
                let taken = point.load([rigid.deflection(point.arm + point.offset), rigid.turn]);
                let load = &mut loads.points[k];
                load[0] -= taken[0];
                load[1] -= taken[1];
                force.add(load[0]);
                moment.add(load[0] * point.arm + load[1]);
            }
            total[0] += force.value();
            total[1] += if side == 0 { -moment.value() } else { moment.value() };
        }
        total
    }

    /// The strains of the bat, clamped at its root, under the loads.
    fn inwards<R: Over<S>, const W: usize>(
        &self,
        body: &Body<S, W>,
        loads: &Loads<R, W>,
        y: &mut [R],
    ) {
        y[body.cells.len() * (W - 2)..].fill(R::default());
        for side in [0, 1] {
            let mut way = Inwards::<R, true>::default();
            for Run { cells, stop } in runs(body.side(side), &self.placed.stops[side]).rev() {
                match stop {
                    Some(What::PointMass(k)) => {
                        let [force, couple] = loads.points[k];
                        way.shear.add(force);
                        way.bending.add(couple);
                        let spring = self.placed.points[k].spring;
                        spring.iter().for_each(|s| y[s.place] = force * s.softness);
                    }
                    Some(What::Joint(k)) => {
                        let joint = &self.placed.joints[k];
                        y[joint.place] = way.bending.value() * joint.softness;
                    }
                    Some(What::Contact(_)) | None => {}
                }
                let strains = &mut y[cells.start * (W - 2)..cells.end * (W - 2)];
                let (loads, rigid) = (&loads.cells[cells.clone()], Rigid::default());
                way.over(&body.cells[cells], loads, rigid, strains);
            }
        }
    }

    /// Removes from the strains what the contacts do not allow.
    pub fn project<R: Over<S>>(&self, strains: &mut [R]) {
        let mut reactions = vec![R::default(); self.placed.contacts.len()];
        self.balance([R::default(); 2], strains, &mut reactions);
    }

    /// Turns the strains of the bat clamped at its root, with the remaining force and moment `total` about the balance
    /// point, into those of the held bat. Leaves the contacts' reactions.
    fn balance<R: Over<S>>(&self, total: [R; 2], strains: &mut [R], reactions: &mut [R]) {
        let Some(holds) = &self.holds else { return };
        holds.fit(strains, [total[0], total[1] - total[0] * self.root], reactions);
    }

    /// The rigid motion that the contacts remove from a motion with the root at rest.
    pub fn rigid<R: Over<S>>(&self, given: Given<R>) -> Rigid<R> {
        let Some(holds) = &self.holds else { return Rigid::default() };
        let [w, theta] = holds.root(given);
        Rigid { push: theta * self.root - w, turn: -theta }
    }

    /// The free rigid motion that carries the force and moment `total`, for a bat of that mass and inertia.
    pub fn free_part<R: Over<S>>(&self, mass: S, inertia: S, total: [R; 2]) -> Rigid<R> {
        let mut rigid = Rigid::<R>::default();
        for free in &self.free {
            let carried = total[0] * free[0] + total[1] * free[1];
            let weight = free[0] * free[0] * mass + free[1] * free[1] * inertia;
            let part = carried / R::of(weight);
            rigid.push += part * free[0];
            rigid.turn += part * free[1];
        }
        rigid
    }
}

/// The elements and fixtures of one side, in the order of the pass inwards.
fn met<S: Real>(placed: &Placed<S>, bare: &Bare<S>, side: usize) -> Build<S> {
    let mut build = Build::default();
    for Run { cells, stop } in runs(bare.side(side), &placed.stops[side]).rev() {
        match stop {
            Some(What::Joint(k)) => {
                let Spring { place, softness } = placed.joints[k];
                let adds = vec![[S::default(), softness]];
                build.cross(Span { first: place, adds, length: 0.0 });
            }
            Some(What::Contact(k)) => {
                let Contact { turning, sign, spring, .. } = placed.contacts[k];
                let spring = spring.map(|spring| (spring.place, spring.softness));
                build.meet(Border { contact: k, turning, sign, spring });
            }
            Some(What::PointMass(_)) | None => {}
        }
        for k in cells.rev() {
            let cell = bare.cells.at(k);
            let adds = cell.lift.iter().zip(cell.turn).map(|(lift, turn)| [*lift, *turn]).collect();
            let span = Span { first: k * bare.strains, adds, length: cell.length.lane(0) };
            let Some(bed) = placed.bed(k, bare.terms) else {
                build.cross(span);
                continue;
            };
            let springs = placed.contacts[bed.clone()].iter().filter_map(|contact| contact.spring);
            let (places, softness): (Vec<usize>, _) =
                springs.map(|spring| (spring.place, spring.softness)).unzip();
            let rows =
                (0..bare.terms).flat_map(|term| cell.point_load(&unit(bare.terms, term))).collect();
            build.cross_bed(span, Under { contact: bed.start, place: places[0], softness, rows });
        }
    }
    build
}

/// The coefficients of a single Legendre polynomial, among `terms` of them.
pub fn unit(terms: usize, term: usize) -> Vec<f64> {
    (0..terms).map(|k| f64::from(u8::from(k == term))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::bat::fixtures::{Fixtures, Held, Joint, Support};
    use crate::bat::material::Material;
    use crate::bat::profile::{Interpolation, Profile, Stations};
    use crate::bat::theory::Theory;
    use crate::beam::statics::Statics;

    /// A uniform bat on two pins at its ends, with a joint in the middle: a force there bends it by
    /// `F L³/48 EI` and turns the joint by `F L/4k`.
    #[test]
    fn a_force_on_a_bat_on_two_pins_moves_it_as_far_as_the_textbooks_say() {
        let (length, radius, youngs_modulus, joint) = (0.8, 0.03, 14e9, 5000.0);
        let stations = Stations {
            x: vec![0.0, length],
            outer: vec![radius; 2],
            inner: vec![0.0; 2],
            interpolation: Interpolation::Linear,
        };
        let pin = |x| Support { x, kind: Held::Pinned };
        let fixtures = Fixtures {
            supports: vec![pin(0.0), pin(length)],
            joints: vec![Joint { x: 0.5 * length, rotational_stiffness: joint }],
            ..Fixtures::default()
        };
        let profile = Profile::new(stations).unwrap();
        let material = Material::new(700.0, youngs_modulus).unwrap();
        let bat = Bat::builder(profile, material).name("pinned").fixtures(fixtures).build();
        let bat = bat.unwrap();
        let mut statics = Statics::<f64, 6, 6>::empty(&bat, Theory::EulerBernoulli);
        statics.assemble(&[&bat], &[&Mesh::along(&bat, 6)]);
        let fixed = statics.fixed.as_ref().unwrap();
        assert!(fixed.free().is_empty());
        // The root is the middle.
        let strains = fixed.under_force(&statics.body(), 6, 0, 0.0);
        let square: f64 = strains.iter().map(|q| q * q).sum();
        let bending = youngs_modulus * std::f64::consts::PI / 4.0 * radius.powi(4);
        let exact = length.powi(3) / (48.0 * bending) + length * length / (16.0 * joint);
        let found = square / statics.energy_unit;
        assert!((found / exact - 1.0).abs() < 1e-11, "{found} {exact}");
    }
}
