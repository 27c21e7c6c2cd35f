//! What is on the bat and what holds it, in the running sums.
//!
//! A point mass is met on the way outwards, where its motion is known, and gives back its force on
//! the way inwards. A joint is a strain of its own: the angle between both sides.
//!
//! A contact is anything that holds a deflection or a rotation: a support, a spring to ground, or
//! one Legendre coefficient of the deflection over an elastic bed. Its displacement follows from the
//! strains and the motion of the root, and it may give way by `√δ s`, `δ = U/k` in the unit of
//! energy `U`, with a strain `s` of its own; a support has `δ = 0`. The strains that loads make of
//! the bat clamped at its root are followed by the strains nearest to them that the contacts allow
//! ([`Holds`]). Where contacts leave rigid motions free, these are taken out as they are of a free
//! bat.

use std::ops::Range;

use crate::base::quadrature::{RunningSum, legendre};
use crate::base::real::{Over, Real};
use crate::bat::body::Bat;
use crate::bat::fixtures::Held;
use crate::beam::element::{Vector, on_strains};
use crate::beam::holds::{Border, Build, Given, Holds, Span, Under};
use crate::beam::mesh::Mesh;
use crate::beam::rule::Rule;
use crate::beam::sweep::{Cell, Inwards, Loads, Outwards, Rigid};

/// A bare bat as the running sums see it.
#[derive(Debug, Clone, Copy)]
pub struct Body<'a, S, const N: usize, const W: usize> {
    /// Elements of the bat, the knob side first, both sides from the root outwards.
    pub cells: &'a [Cell<S, W>],
    /// Number of elements on the knob side.
    pub split: usize,
    /// Gauss points at which the elements are sampled.
    pub rule: &'static Rule,
    /// Mass of the bat with everything attached (kg).
    pub mass: S,
    /// Moment of inertia about the balance point, with everything attached (kg m²).
    pub inertia: S,
    /// Distance of the balance point from the knob end (m).
    pub balance: S,
    /// Energy of `½ qᵀq = 1` (J).
    pub energy_unit: S,
}

/// What is on one bat and what holds it.
#[derive(Debug, Clone)]
pub struct Fixed<S> {
    /// Masses, on the bat itself or on springs.
    pub points: Vec<PointMass<S>>,
    /// Places that give way to bending.
    pub joints: Vec<Spring<S>>,
    /// What holds a deflection or a rotation.
    pub contacts: Vec<Contact<S>>,
    /// What is met on the way outwards on the knob side and on the tip side, in this order.
    pub stops: [Vec<Stop>; 2],
    /// Number of strains that springs add to those of the elements.
    pub springs: usize,
    /// Where the bat is clamped (m).
    pub clamps: Vec<f64>,
    /// The rigid motions that stay free: push and turn about the balance point.
    free: Vec<[S; 2]>,
    /// How the contacts hold the bat, if there are any.
    holds: Option<Holds<S>>,
    /// The root from the balance point, towards the tip (m).
    root: S,
    /// The first contact of the bed under a cell; empty without a bed.
    beds: Vec<Option<usize>>,
}

/// Something at the border of two cells.
#[derive(Debug, Clone, Copy)]
pub struct Stop {
    /// How many cells of this side lie before it.
    pub after: usize,
    /// What is met there.
    pub what: What,
}

/// The kind of a [`Stop`], and its number among its kind.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum What {
    /// A point mass.
    PointMass(usize),
    /// A joint.
    Joint(usize),
    /// A contact.
    Contact(usize),
}

/// A strain beside those of the elements.
#[derive(Debug, Clone, Copy)]
pub struct Spring<S> {
    /// Index of the spring's strain among all strains.
    pub place: usize,
    /// `√(U/k)`: displacement (m or rad) for a strain of 1.
    pub softness: S,
}

/// A point mass, directly on the bat or on a spring.
#[derive(Debug, Clone, Copy)]
pub struct PointMass<S> {
    /// Distance of the point mass from the balance point, outwards (m).
    pub arm: S,
    /// Mass of the point (kg).
    pub mass: S,
    /// How far outwards of its place the centre of the mass is (m).
    pub offset: S,
    /// Moment of inertia of the point mass about its own centre (kg m²).
    pub inertia: S,
    /// What it hangs on; none where it sits on the bat.
    pub spring: Option<Spring<S>>,
}

/// Something that holds.
#[derive(Debug, Clone, Copy)]
pub struct Contact<S> {
    /// Where it holds.
    pub at: At,
    /// Whether it holds the rotation, else the deflection.
    pub turning: bool,
    /// 1, or −1 where outwards is towards the knob and a rotation changes its sign.
    pub sign: S,
    /// How it gives way, if it does.
    pub spring: Option<Spring<S>>,
}

/// Where a contact is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum At {
    /// At the border of two cells.
    Border,
    /// A Legendre coefficient of the deflection of a cell on an elastic bed.
    Bed,
}

impl<S: Real> Fixed<S> {
    /// Everything that the bat's fixtures say, on that mesh.
    pub fn new<const N: usize, const W: usize>(
        body: &Body<S, N, W>,
        bat: &Bat,
        mesh: &Mesh,
    ) -> Self {
        let stops = [vec![], vec![]];
        let clamped = bat.fixtures.supports.iter().filter(|s| s.kind == Held::Clamped);
        let clamps = clamped.map(|support| support.x).collect();
        let root = body.cells[body.split].arm;
        let mut fixed = Self { stops, clamps, root, ..Self::nothing() };
        fixed.add_points(body, bat, mesh);
        fixed.add_contacts(body, bat, mesh);
        // Outwards; at one place the knob's part comes first from the knob and last from the tip.
        let order = |side: usize, what: What| match what {
            What::Joint(_) => usize::from(side == 1) * 2,
            _ => 1,
        };
        for (side, stops) in fixed.stops.iter_mut().enumerate() {
            stops.sort_by_key(|stop| (stop.after, order(side, stop.what)));
        }
        fixed.hold(body);
        fixed
    }

    /// Nothing on the bat and nothing that holds it.
    pub fn nothing() -> Self {
        let (one, zero) = (S::splat(1.0), S::default());
        Self {
            points: vec![],
            joints: vec![],
            contacts: vec![],
            stops: [vec![], vec![]],
            springs: 0,
            clamps: vec![],
            free: vec![[one, zero], [zero, one]],
            holds: None,
            root: zero,
            beds: vec![],
        }
    }

    /// How many conditions the strains must meet.
    pub fn redundant(&self) -> usize {
        self.contacts.len() + self.free.len() - 2
    }

    /// The contacts of the bed under a cell, one for each of `terms` Legendre polynomials.
    pub fn bed(&self, cell: usize, terms: usize) -> Option<Range<usize>> {
        let first = self.beds.get(cell).copied().flatten()?;
        Some(first..first + terms)
    }

    /// How many masses hang on springs.
    pub fn hung(&self) -> usize {
        self.points.iter().filter(|point| point.spring.is_some()).count()
    }

    /// How many rigid motions are free.
    pub fn rigid_modes(&self) -> usize {
        self.free.len()
    }

    /// The free rigid motions: push and turn about the balance point.
    pub fn free(&self) -> &[[S; 2]] {
        &self.free
    }

    /// The next strain of its own, of a spring of that stiffness (N/m or N m/rad).
    fn spring<const N: usize, const W: usize>(
        &mut self,
        body: &Body<S, N, W>,
        stiffness: f64,
    ) -> Spring<S> {
        let place = body.cells.len() * (W - 2) + self.springs;
        self.springs += 1;
        Spring { place, softness: (body.energy_unit / S::splat(stiffness)).sqrt() }
    }

    /// Adds a stop where node `node` is; its side, 1 for the tip's.
    fn stop(&mut self, split: usize, node: usize, what: What) -> usize {
        // A joint at the root gives way on the tip side, everything else there is the knob side's.
        let tip_side = node > split || (node == split && matches!(what, What::Joint(_)));
        let after = if tip_side { node - split } else { split - node };
        self.stops[usize::from(tip_side)].push(Stop { after, what });
        usize::from(tip_side)
    }

    fn add_points<const N: usize, const W: usize>(
        &mut self,
        body: &Body<S, N, W>,
        bat: &Bat,
        mesh: &Mesh,
    ) {
        let number = S::splat;
        for joint in &bat.fixtures.joints {
            let spring = self.spring(body, joint.rotational_stiffness);
            self.joints.push(spring);
            let what = What::Joint(self.joints.len() - 1);
            self.stop(body.split, node_at(bat, mesh, joint.x), what);
        }
        let masses = bat.fixtures.attachments.iter().filter(|a| a.mass + a.rotary_inertia > 0.0);
        let fixed = masses.map(|a| (a.x, [a.mass, a.offset, a.rotary_inertia], None));
        let hung = bat.fixtures.absorbers.iter();
        let hung = hung.map(|a| (a.x, [a.mass, 0.0, 0.0], Some(a.stiffness)));
        for (x, [mass, offset, inertia], stiffness) in fixed.chain(hung) {
            let what = What::PointMass(self.points.len());
            let side = self.stop(body.split, node_at(bat, mesh, x), what);
            let spring = stiffness.map(|stiffness| self.spring(body, stiffness));
            let outwards = if side == 1 { 1.0 } else { -1.0 };
            self.points.push(PointMass {
                arm: number(outwards) * (number(x) - body.balance),
                mass: number(mass),
                offset: number(outwards * offset),
                inertia: number(inertia),
                spring,
            });
        }
    }

    fn add_contacts<const N: usize, const W: usize>(
        &mut self,
        body: &Body<S, N, W>,
        bat: &Bat,
        mesh: &Mesh,
    ) {
        let add = |fixed: &mut Self, x: f64, turning: bool, stiffness: Option<f64>| {
            let what = What::Contact(fixed.contacts.len());
            let side = fixed.stop(body.split, node_at(bat, mesh, x), what);
            let spring = stiffness.map(|stiffness| fixed.spring(body, stiffness));
            let sign = S::splat(if turning && side == 0 { -1.0 } else { 1.0 });
            fixed.contacts.push(Contact { at: At::Border, turning, sign, spring });
        };
        for support in &bat.fixtures.supports {
            add(self, support.x, false, None);
            if support.kind == Held::Clamped {
                add(self, support.x, true, None);
            }
        }
        for a in &bat.fixtures.attachments {
            let springs = [(false, a.stiffness), (true, a.rotational_stiffness)];
            for (turning, stiffness) in springs.into_iter().filter(|(_, k)| *k > 0.0) {
                add(self, a.x, turning, Some(stiffness));
            }
        }
        let Some(grip) = bat.fixtures.grip.filter(|grip| grip.stiffness > 0.0) else { return };
        self.beds = vec![None; mesh.len()];
        for (cell, e) in in_grip(bat, mesh, body.split) {
            self.beds[cell] = Some(self.contacts.len());
            for term in 0..N {
                // ∫P_k² dx.
                let share = mesh.elements[e].length / (2 * term + 1) as f64;
                let spring = Some(self.spring(body, grip.stiffness * share));
                let (at, turning, sign) = (At::Bed, false, S::splat(1.0));
                self.contacts.push(Contact { at, turning, sign, spring });
            }
        }
    }

    /// Finds how the contacts hold the bat, and what they leave free.
    fn hold<const N: usize, const W: usize>(&mut self, body: &Body<S, N, W>) {
        if self.contacts.is_empty() {
            return;
        }
        let holds = Holds::of([0, 1].map(|side| self.side(body, side)));
        let (one, zero) = (S::splat(1.0), S::default());
        self.free = match holds.held.map(|stiffness| stiffness > 0.0) {
            [true, true] => vec![],
            [true, false] => vec![[-(self.root + S::splat(holds.center)), one]],
            [false, _] => vec![[one, zero]],
        };
        self.holds = Some(holds);
    }

    /// What is met on one side on the way inwards.
    fn side<const N: usize, const W: usize>(&self, body: &Body<S, N, W>, side: usize) -> Build<S> {
        let (mut build, cells) = (Build::default(), body.sides()[side].clone());
        let mut stops = self.stops[side].iter().rev().peekable();
        for k in cells.clone().rev() {
            while let Some(stop) = stops.next_if(|stop| cells.start + stop.after == k + 1) {
                self.meet(stop.what, &mut build);
            }
            let link = &body.cells[k].link;
            let adds = (0..W - 2).map(|i| [link.lift[i], link.turn[i]]).collect();
            let span = Span { first: k * (W - 2), adds, length: link.length.lane(0) };
            let Some(bed) = self.bed(k, N) else {
                build.cross(span);
                continue;
            };
            let springs = self.contacts[bed.clone()].iter().filter_map(|contact| contact.spring);
            let (places, softness): (Vec<usize>, _) =
                springs.map(|spring| (spring.place, spring.softness)).unzip();
            let rows = (0..N).flat_map(|term| body.point_load(k, &unit(term))).collect();
            build.cross_bed(span, Under { contact: bed.start, place: places[0], softness, rows });
        }
        stops.for_each(|stop| self.meet(stop.what, &mut build));
        build
    }

    fn meet(&self, what: What, build: &mut Build<S>) {
        match what {
            What::PointMass(_) => {}
            What::Joint(k) => {
                let Spring { place, softness } = self.joints[k];
                let adds = vec![[S::default(), softness]];
                build.cross(Span { first: place, adds, length: 0.0 });
            }
            What::Contact(k) => {
                let Contact { turning, sign, spring, .. } = self.contacts[k];
                let spring = spring.map(|spring| (spring.place, spring.softness));
                build.meet(Border { contact: k, turning, sign, spring });
            }
        }
    }

    fn no_loads<R: Real, const N: usize, const W: usize>(
        &self,
        body: &Body<S, N, W>,
    ) -> Loads<R, W> {
        Loads {
            cells: vec![[R::default(); W]; body.cells.len()],
            points: vec![[R::default(); 2]; self.points.len()],
            contacts: vec![R::default(); self.contacts.len()],
        }
    }

    /// `y = A q` of the held bat. Leaves the loads, the rigid motion taken out, and the forces of
    /// the contacts; returns the rigid motion.
    pub fn compliance<R: Over<S>, const N: usize, const W: usize>(
        &self,
        body: &Body<S, N, W>,
        q: &[R],
        y: &mut [R],
        loads: &mut Loads<R, W>,
    ) -> Rigid<R> {
        loads.cells.resize(body.cells.len(), [R::default(); W]);
        loads.points.resize(self.points.len(), [R::default(); 2]);
        loads.contacts.clear();
        loads.contacts.resize(self.contacts.len(), R::default());
        self.outwards(body, q, loads);
        let mut rigid = self.rigid(Given::Strains(q));
        let mut total = self.take_out(body, rigid, loads);
        // Twice: where one mass is far above all others, the first time leaves its round-off.
        for _ in 0..2 {
            let free = self.free_part(body.mass, body.inertia, total);
            rigid = Rigid { push: rigid.push + free.push, turn: rigid.turn + free.turn };
            total = self.take_out(body, free, loads);
        }
        self.inwards(body, loads, y);
        self.balance(total, y, &mut loads.contacts);
        rigid
    }

    /// The scaled strains (times the unit of energy) of the held bat under a unit force at the
    /// place `s` in [0, 1] outwards on a cell, in balance with the inertia of the rigid motions
    /// that are free.
    ///
    /// By Maxwell's theorem their product with any scaled strains is the deflection there, rigid
    /// motions taken out.
    pub fn under_force<const N: usize, const W: usize>(
        &self,
        body: &Body<S, N, W>,
        cell: usize,
        s: f64,
    ) -> Vec<S> {
        let mut loads = self.no_loads::<S, N, W>(body);
        let values: Vec<f64> = legendre(N, 2.0 * s - 1.0);
        let values: &[f64; N] = values[..N].try_into().expect("as many as asked for");
        loads.cells[cell] = body.point_load(cell, values);
        let mut total = self.take_out(body, Rigid::default(), &mut loads);
        for _ in 0..2 {
            let free = self.free_part(body.mass, body.inertia, total);
            total = self.take_out(body, free, &mut loads);
        }
        let mut strains = vec![S::default(); body.cells.len() * (W - 2) + self.springs];
        self.inwards(body, &loads, &mut strains);
        self.balance(total, &mut strains, &mut loads.contacts);
        strains
    }

    /// Integrates strains from the root at rest and leaves the loads of their inertia.
    fn outwards<R: Over<S>, const N: usize, const W: usize>(
        &self,
        body: &Body<S, N, W>,
        q: &[R],
        loads: &mut Loads<R, W>,
    ) {
        for (side, cells) in body.sides().into_iter().enumerate() {
            let mut way = Outwards::<R, true>::default();
            let (stops, mut done) = (&self.stops[side], cells.start);
            for k in 0..=stops.len() {
                let run = done..stops.get(k).map_or(cells.end, |stop| cells.start + stop.after);
                done = run.end;
                let strains = &q[run.start * (W - 2)..run.end * (W - 2)];
                way.over(&body.cells[run.clone()], strains, &mut loads.cells[run]);
                let Some(stop) = stops.get(k) else { break };
                match stop.what {
                    What::PointMass(k) => {
                        let point = &self.points[k];
                        loads.points[k] =
                            point.load(point.displaced(way.w.value(), way.theta.value(), q));
                    }
                    What::Joint(k) => {
                        way.theta.add(q[self.joints[k].place] * self.joints[k].softness);
                    }
                    What::Contact(_) => {}
                }
            }
        }
    }

    /// Takes the loads of a rigid motion out of these; force and moment about the balance point
    /// that are left.
    fn take_out<R: Over<S>, const N: usize, const W: usize>(
        &self,
        body: &Body<S, N, W>,
        rigid: Rigid<R>,
        loads: &mut Loads<R, W>,
    ) -> [R; 2] {
        let mut total = [R::default(); 2];
        for (side, cells) in body.sides().into_iter().enumerate() {
            let rigid = if side == 0 { rigid.mirrored() } else { rigid };
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
            for stop in &self.stops[side] {
                let What::PointMass(k) = stop.what else { continue };
                let point = &self.points[k];
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

    /// The strains under loads of the bat clamped at its root.
    fn inwards<R: Over<S>, const N: usize, const W: usize>(
        &self,
        body: &Body<S, N, W>,
        loads: &Loads<R, W>,
        y: &mut [R],
    ) {
        y[body.cells.len() * (W - 2)..].fill(R::default());
        for (side, cells) in body.sides().into_iter().enumerate() {
            let mut way = Inwards::<R, true>::default();
            let (stops, mut done) = (&self.stops[side], cells.end);
            for k in (0..=stops.len()).rev() {
                let before = k.checked_sub(1).map(|k| &stops[k]);
                let run = before.map_or(cells.start, |stop| cells.start + stop.after)..done;
                done = run.start;
                let strains = &mut y[run.start * (W - 2)..run.end * (W - 2)];
                let rigid = Rigid::default();
                way.over(&body.cells[run.clone()], &loads.cells[run], rigid, strains);
                let Some(stop) = before else { break };
                match stop.what {
                    What::PointMass(k) => {
                        let [force, couple] = loads.points[k];
                        way.shear.add(force);
                        way.bending.add(couple);
                        let spring = self.points[k].spring;
                        spring.iter().for_each(|s| y[s.place] = force * s.softness);
                    }
                    What::Joint(k) => {
                        let spring = &self.joints[k];
                        y[spring.place] = way.bending.value() * spring.softness;
                    }
                    What::Contact(_) => {}
                }
            }
        }
    }

    /// Takes out of the strains what the contacts do not allow.
    pub fn project<R: Over<S>>(&self, strains: &mut [R]) {
        let mut reactions = vec![R::default(); self.contacts.len()];
        self.balance([R::default(); 2], strains, &mut reactions);
    }

    /// Strains under loads of the bat clamped at its root, where force and moment about the balance
    /// point `total` are left, become those of the held bat; leaves the contacts' reactions.
    fn balance<R: Over<S>>(&self, total: [R; 2], strains: &mut [R], reactions: &mut [R]) {
        let Some(holds) = &self.holds else { return };
        holds.fit(strains, [total[0], total[1] - total[0] * self.root], reactions);
    }

    /// The rigid motion that the contacts take out of a motion with the root at rest.
    pub fn rigid<R: Over<S>>(&self, given: Given<R>) -> Rigid<R> {
        let Some(holds) = &self.holds else { return Rigid::default() };
        let [w, theta] = holds.root(given);
        Rigid { push: theta * self.root - w, turn: -theta }
    }

    /// The free rigid motion of a bat of that mass and inertia that carries force and moment
    /// `total`.
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

impl<S: Real> PointMass<S> {
    /// How far its mass and how far the bat turns, of a bat that is at `w` and `theta` here.
    pub fn displaced<R: Over<S>>(&self, w: R, theta: R, strains: &[R]) -> [R; 2] {
        let own = self.spring.map_or(R::default(), |s| strains[s.place] * s.softness);
        [w + theta * self.offset + own, theta]
    }

    /// Force and couple of its inertia on the bat.
    pub fn load<R: Over<S>>(&self, [moved, turned]: [R; 2]) -> [R; 2] {
        let force = moved * self.mass;
        [force, turned * self.inertia + force * self.offset]
    }
}

impl<S: Real> Contact<S> {
    /// Whether it is a point of an elastic bed.
    pub fn in_a_bed(&self) -> bool {
        self.at == At::Bed
    }

    /// Force and couple, outwards, that its reaction is for the bat.
    pub fn on_the_bat<R: Over<S>>(&self, reaction: R) -> [R; 2] {
        match (self.at, self.turning) {
            (At::Bed, _) => [R::default(); 2],
            (At::Border, false) => [-reaction, R::default()],
            (At::Border, true) => [R::default(), -(reaction * self.sign)],
        }
    }
}

impl<S: Real, const N: usize, const W: usize> Body<'_, S, N, W> {
    /// The cells of the knob side and of the tip side.
    pub fn sides(&self) -> [Range<usize>; 2] {
        [0..self.split, self.split..self.cells.len()]
    }

    /// The loads on a cell of a unit force where Legendre's polynomials have those values.
    pub fn point_load(&self, cell: usize, values: &[f64; N]) -> Vector<S, W> {
        let cell = &self.cells[cell];
        let values = values.map(S::splat);
        let on: Vector<S, W> = on_strains::<S, N, W>(cell.link.length, &values);
        let mut load = on;
        for i in 0..W - 2 {
            load[i] = S::default();
            for j in 0..=i {
                load[i] += cell.inverse[i][j] * on[j];
            }
        }
        load
    }
}

/// The coefficients of one Legendre polynomial.
pub fn unit<const N: usize>(term: usize) -> [f64; N] {
    std::array::from_fn(|k| f64::from(u8::from(k == term)))
}

/// The number of the mesh's node at `x`, or nearest to it: the bat's pieces end there.
pub fn node_at(bat: &Bat, mesh: &Mesh, x: f64) -> usize {
    let pieces = &bat.profile.pieces;
    let start = |k: usize| pieces.get(k).map_or(bat.length(), |piece| piece.start);
    let above = pieces.partition_point(|piece| piece.start <= x).max(1);
    let piece = if x - start(above - 1) <= start(above) - x { above - 1 } else { above };
    mesh.elements.partition_point(|e| e.piece < piece)
}

/// The elements in the grip: the place of the cell and the number of the element.
pub fn in_grip(bat: &Bat, mesh: &Mesh, split: usize) -> Vec<(usize, usize)> {
    let Some(grip) = &bat.fixtures.grip else { return vec![] };
    let held = |e: &usize| {
        let e = &mesh.elements[*e];
        let middle = e.start + 0.5 * e.length;
        middle > grip.from && middle < grip.to
    };
    let cell = |e: usize| if e < split { split - 1 - e } else { e };
    (0..mesh.len()).filter(held).map(|e| (cell(e), e)).collect()
}
