//! How far may the shape of a motion be off? By `w − w*`: its deflection less the deflection due to its own inertia.
//!
//! The differences of the strains that [`Motion::take_defect`] leaves are integrated outwards. The free rigid motions
//! are then removed, so that the change carries no momentum and moves no contact.

use crate::base::{Over, Real};
use crate::beam::holds::Given;
use crate::beam::motion::{Known, Motion};
use crate::beam::rule::MOST_POINTS;
use crate::beam::statics::Statics;
use crate::beam::sweep::{Loads, Rigid};
use crate::beam::view::{Located, View};
use crate::beam::walk::{Run, What};

/// How much is computed of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Depth {
    /// Shape and energies of the motion.
    Shape,
    /// Shape, energies and defect.
    Defect,
    /// Shape, energies, defect, and the error of the shape.
    Changes,
}

/// A change during the pass outwards: deflection and rotation so far, force and moment of their inertia over ω² about
/// the balance point; memory for one cell.
struct RunningChange<R> {
    w: R,
    theta: R,
    force: R,
    moment: R,
    once: [R; MOST_POINTS],
    twice: [R; MOST_POINTS],
}

impl<R: Real> Motion<R> {
    /// As [`Self::take`], to the given depth.
    #[inline(always)]
    pub fn look<S: Real>(
        &mut self,
        view: &View<S>,
        rigid: Rigid<R>,
        q: &[R],
        known: Known<R, S>,
        depth: Depth,
    ) where
        R: Over<S>,
    {
        self.take(view, rigid, q, known);
        self.defect = R::default();
        if depth != Depth::Shape {
            self.take_defect(view, q);
        }
        match depth {
            Depth::Changes => self.take_changes(view),
            _ => self.no_changes(view),
        }
    }

    /// Clears what [`Self::take_changes`] would compute.
    #[inline(always)]
    fn no_changes<S: Real>(&mut self, view: &View<S>) {
        self.changes.clear();
        self.changes.resize(view.count * view.rule.count(), R::default());
        self.ends[0][1] = R::default();
        self.ends[1][1] = R::default();
        self.work = R::default();
    }

    /// Turns the differences of the strains at the points into `w − w*`, with the rigid motions removed.
    #[inline(always)]
    fn take_changes<S: Real>(&mut self, view: &View<S>)
    where
        R: Over<S>,
    {
        let contacts = view.placed().map_or(0, |placed| placed.contacts.len());
        let mut held = vec![R::default(); contacts];
        self.point_changes.resize(self.points.len(), [R::default(); 2]);
        let mut total = [R::default(); 2];
        for side in [0, 1] {
            let [force, moment] = self.integrate(view, side, &mut held);
            total[0] += force;
            total[1] += if side == 0 { -moment } else { moment };
        }
        let rigid = self.rigid_change(view, total, &mut held);
        self.work = R::default();
        for side in [0, 1] {
            self.take_out(view, rigid.on_side(side), side);
        }
    }

    /// Integrates the differences of the strains outwards to differences of the deflection, with the root at rest, and
    /// to displacements of the contacts. Returns force and moment of their inertia about the balance point.
    #[inline(always)]
    fn integrate<S: Real>(&mut self, view: &View<S>, side: usize, held: &mut [R]) -> [R; 2]
    where
        R: Over<S>,
    {
        let zero = R::default();
        let [once, twice] = [[zero; MOST_POINTS]; 2];
        let mut way =
            RunningChange { w: zero, theta: zero, force: zero, moment: zero, once, twice };
        for Run { cells, stop } in view.runs(side) {
            for k in cells {
                let at = view.at(k);
                self.integrate_cell(view, &at, &mut way);
                if let Some(bed) = view.bed(k) {
                    view.rule.coefficients(&self.changes[at.samples], &mut held[bed]);
                }
                self.ends[side][1] = way.w;
            }
            let Some(placed) = view.placed() else { continue };
            match stop {
                Some(What::Joint(k)) => {
                    let joint = &placed.joints[k];
                    way.theta += self.image[joint.place] * joint.softness;
                }
                Some(What::PointMass(k)) => {
                    let point = &placed.points[k];
                    let change = point.displaced(way.w, way.theta, &self.image);
                    let [push, couple] = point.load(change);
                    self.point_changes[k] = change;
                    way.force += push;
                    way.moment += push * point.arm + couple;
                }
                Some(What::Contact(k)) => {
                    let contact = &placed.contacts[k];
                    held[k] = if contact.turning { way.theta * contact.sign } else { way.w };
                }
                None => {}
            }
        }
        [way.force, way.moment]
    }

    /// One cell of the pass outwards.
    #[inline(always)]
    fn integrate_cell<S: Real>(
        &mut self,
        view: &View<S>,
        at: &Located<S>,
        way: &mut RunningChange<R>,
    ) where
        R: Over<S>,
    {
        let (rule, cell, h) = (view.rule, &at.cell, at.cell.length);
        let shears = view.theory.shears();
        let change = &mut self.changes[at.samples.clone()];
        let [turned, first] = rule.integrals(change);
        rule.combine(&rule.twice_from_left, change, &mut way.twice);
        if view.theory.turns() {
            rule.combine(&rule.once_from_left, change, &mut way.once);
            let line = &view.turning_per_length[at.samples.clone()];
            let turn = &mut self.turn_changes[at.samples.clone()];
            for (j, point) in rule.points.iter().enumerate() {
                turn[j] = way.theta + way.once[j] * h;
                way.moment += turn[j] * (S::splat(point.weight) * h * line[j]);
            }
        }
        let mut slipped = R::default();
        if shears {
            let slips = &self.slips[at.samples.clone()];
            rule.combine(&rule.once_from_left, slips, &mut way.once);
            slipped = rule.integrals(slips)[0] * h;
        }
        let line = &view.mass_per_length[at.samples.clone()];
        for (j, point) in rule.points.iter().enumerate() {
            let y = S::splat(point.s) * h;
            change[j] = way.w + way.theta * y + way.twice[j] * (h * h);
            if shears {
                change[j] += way.once[j] * h;
            }
            let share = change[j] * (S::splat(point.weight) * h * line[j]);
            way.force += share;
            way.moment += share * (cell.arm + y);
        }
        way.w += way.theta * h + (turned - first) * (h * h) + slipped;
        way.theta += turned * h;
    }

    /// The rigid motion in a change that carries that force and moment and moves the contacts by `held`.
    #[inline(always)]
    fn rigid_change<S: Real>(&self, view: &View<S>, total: [R; 2], held: &mut [R]) -> Rigid<R>
    where
        R: Over<S>,
    {
        let (mass, inertia) = (R::of(view.mass), R::of(view.inertia));
        let Some(fixed) = view.fixed else {
            return Rigid { push: total[0] / mass, turn: total[1] / inertia };
        };
        for (held, contact) in held.iter_mut().zip(&fixed.placed.contacts) {
            let given = contact.spring.map(|s| self.image[s.place] * s.softness);
            *held -= given.unwrap_or_default();
        }
        let first = fixed.rigid(Given::Displacements(held));
        let left = [total[0] - first.push * mass, total[1] - first.turn * inertia];
        let free = fixed.free_part(view.mass, view.inertia, left);
        Rigid { push: first.push + free.push, turn: first.turn + free.turn }
    }

    /// Removes a rigid motion from the change of one side, and adds the side's part of [`Self::work`].
    #[inline(always)]
    fn take_out<S: Real>(&mut self, view: &View<S>, rigid: Rigid<R>, side: usize)
    where
        R: Over<S>,
    {
        for k in view.side(side) {
            let Located { cell, samples, .. } = view.at(k);
            let change = &mut self.changes[samples.clone()];
            let mut sum = R::default();
            for (j, point) in view.rule.points.iter().enumerate() {
                let place = samples.start + j;
                change[j] -= rigid.deflection(cell.arm + S::splat(point.s) * cell.length);
                let line = view.mass_per_length[place];
                sum += self.deflections[place] * change[j] * (S::splat(point.weight) * line);
                if view.theory.turns() {
                    let turn = &mut self.turn_changes[place];
                    *turn -= rigid.turn;
                    let line = view.turning_per_length[place];
                    sum += self.rotations[place] * *turn * (S::splat(point.weight) * line);
                }
            }
            self.work += sum * cell.length;
            if k + 1 == view.count || k + 1 == view.split {
                self.ends[side][1] -= rigid.deflection(cell.arm + cell.length);
            }
        }
        let Some(placed) = view.placed() else { return };
        for stop in &placed.stops[side] {
            let What::PointMass(k) = stop.what else { continue };
            let point = &placed.points[k];
            let [moved, turned] = self.point_changes[k];
            let lift = rigid.deflection(point.arm + point.offset);
            let [push, couple] = point.load([moved - lift, turned - rigid.turn]);
            let [at, turn] = self.points[k];
            // The force acts at the centre of the mass, `offset` beyond the fixing point.
            self.work += push * at + (couple - push * point.offset) * turn;
        }
    }
}

impl Motion<f64> {
    /// Computes one motion by itself, for large meshes, few calls and bats with any fixtures. `known` holds the scaled
    /// strains of slower modes, one after the other; their round-off is removed.
    pub fn take_alone<const N: usize, const W: usize>(
        &mut self,
        statics: &Statics<f64, N, W>,
        q: &[f64],
        known: &[f64],
        depth: Depth,
    ) {
        let mut loads = Loads::default();
        self.image.resize(q.len(), 0.0);
        let rigid = statics.apply(q, &mut self.image, &mut loads);
        (self.forces, self.reactions) = (loads.points, loads.contacts);
        self.look_alone(&statics.view(), rigid, q, known, depth);
    }

    /// The body of [`Self::look`], compiled once.
    fn look_alone(
        &mut self,
        view: &View<f64>,
        rigid: Rigid<f64>,
        q: &[f64],
        known: &[f64],
        depth: Depth,
    ) {
        self.look(view, rigid, q, Known { value: None, others: known }, depth);
    }
}
