//! One bending motion of the bat: its shape and its energies.

use crate::base::{Over, Real, RunningSum, dot};
use crate::beam::element::{MOST_STRAINS, MOST_TERMS, integrated};
use crate::beam::rule::MOST_POINTS;
use crate::beam::sweep::Rigid;
use crate::beam::view::{Located, View};
use crate::beam::walk::{Run, What};

/// A bending motion and the memory for computing it.
#[derive(Debug, Clone, Default)]
pub struct Motion<R> {
    /// Number of Legendre polynomials of a cell.
    pub terms: usize,
    /// Deflection of every cell, outwards, the rigid motions taken out (m).
    pub shape: Vec<R>,
    /// Rotation of every cell, outwards (rad); empty where it is the slope of the deflection.
    pub turns: Vec<R>,
    /// Deflection at the Gauss points of every cell (m).
    pub deflections: Vec<R>,
    /// [`Self::deflections`] less the inertial deflection, `w − w*` (m), at the same points.
    pub changes: Vec<R>,
    /// Deflection (m) and its change (m) at the outer ends of both sides: knob end, tip.
    pub ends: [[R; 2]; 2],
    /// Kinetic energy over ω²/2: `∫ρA w² dx`, `∫ρI θ² dx` and that of the fixtures (kg m²).
    pub kinetic: R,
    /// Product of the motion and its [`Self::changes`] `c` in the bat's mass: `∫ρA w c dx`, `∫ρI θ c_θ dx` and that of
    /// the fixtures (kg m²).
    pub work: R,
    /// ω (rad/s). Its square is Rayleigh's quotient, strain energy over kinetic energy, both from the strains.
    pub omega: R,
    /// `‖q − ω² A q‖/‖q‖`: the distance of the strains from an eigenvector of the compliance.
    pub residual: R,
    /// `η` of [`super::defect`]; half of it is the relative error of the frequency.
    pub defect: R,
    /// Part of [`Self::defect`] in every cell.
    pub defects: Vec<R>,
    /// Rotation and its change at the points, where it has inertia.
    pub(super) rotations: Vec<R>,
    pub(super) turn_changes: Vec<R>,
    /// The shear strain less that of the inertia's shear force, at the points.
    pub(super) slips: Vec<R>,
    /// Displacement and rotation of the point masses, outwards, and their changes.
    pub(super) points: Vec<[R; 2]>,
    pub(super) point_changes: Vec<[R; 2]>,
    /// `qᵀq`.
    pub(super) strain: R,
    /// `A q`, then `q − ω² A q`; empty if the eigenvalue is known.
    pub image: Vec<R>,
    /// Largest difference between the deflection and the value that a spring or pin requires (m): the round-off of the
    /// shape, since the two are equal.
    pub slack: R,
    /// `Σ m d w θ` of the point masses whose centre is a distance d from their place, with the root at rest (kg m²).
    /// Most of it cancels when the rigid motions are removed.
    pub carried: R,
    /// Inertia of the point masses and reactions of the contacts.
    pub(crate) forces: Vec<[R; 2]>,
    pub(super) reactions: Vec<R>,
}

/// Data of a motion besides its strains.
#[derive(Debug, Clone, Copy)]
pub struct Known<'a, R, S> {
    /// The eigenvalue of the compliance, if the strains of a bare bat are its eigenvector. The kinetic energy then
    /// follows from it with half the work, the residual is 0, and the round-off is ε times the greatest eigenvalue over
    /// this one.
    pub value: Option<R>,
    /// Strains of other modes, one after the other, whose round-off is removed.
    pub others: &'a [S],
}

/// Memory for the numbers of one cell.
struct OneCell<R> {
    strains: [R; MOST_STRAINS],
    /// Deflection and rotation at the inner end.
    inner_end: [R; 2],
    turn: [R; MOST_TERMS],
    values: [R; MOST_POINTS],
}

impl<R: Real> Motion<R> {
    /// Computes the motion with those scaled strains, and its energies, once its [`Self::image`] or its eigenvalue is
    /// known. Leaves the loads `ρA w` of its inertia in [`Self::changes`].
    #[inline(always)]
    pub fn take<S: Real>(&mut self, view: &View<S>, rigid: Rigid<R>, q: &[R], known: Known<R, S>)
    where
        R: Over<S>,
    {
        self.strain = dot(q, q);
        match known.value {
            Some(value) => {
                self.kinetic = value * self.strain;
                self.residual = R::default();
            }
            None => self.take_image(q, known.others),
        }
        self.omega = (self.strain * view.energy_unit / self.kinetic).sqrt();
        self.make_room(view);
        (self.slack, self.carried) = (R::default(), R::default());
        for side in [0, 1] {
            self.outwards(view, q, rigid.on_side(side), side);
        }
        if view.split == 0 {
            // If the root is the knob end itself, odd polynomials change sign there.
            let mut end = R::default();
            for (k, w) in self.shape[..view.terms].iter().enumerate() {
                end += if k % 2 == 1 { -*w } else { *w };
            }
            self.ends[0][0] = end;
        }
    }

    /// Kinetic energy and residual from `A q`, from which other modes are removed.
    #[inline(always)]
    fn take_image<S: Real>(&mut self, q: &[R], others: &[S])
    where
        R: Over<S>,
    {
        for other in others.chunks_exact(q.len()) {
            let part = inner(&self.image, other);
            self.image.iter_mut().zip(other).for_each(|(y, v)| *y -= part * *v);
        }
        self.kinetic = dot(q, &self.image);
        let scale = self.strain / self.kinetic;
        self.image.iter_mut().zip(q).for_each(|(y, q)| *y = *q - scale * *y);
        self.residual = (dot(&self.image, &self.image) / self.strain).sqrt();
    }

    #[inline(always)]
    fn make_room<S: Real>(&mut self, view: &View<S>) {
        let (zero, samples) = (R::default(), view.count * view.rule.count());
        let (turning, shearing) = (view.theory.turns(), view.theory.shears());
        self.terms = view.terms;
        self.shape.resize(view.count * view.terms, zero);
        self.turns.resize(if shearing { view.count * view.terms } else { 0 }, zero);
        self.deflections.resize(samples, zero);
        self.changes.resize(samples, zero);
        self.defects.resize(view.count, zero);
        self.rotations.resize(if turning { samples } else { 0 }, zero);
        self.turn_changes.resize(if turning { samples } else { 0 }, zero);
        self.slips.resize(if shearing { samples } else { 0 }, zero);
        self.points.resize(self.forces.len(), [zero; 2]);
    }

    /// Deflections outwards from the root at rest, less a rigid motion; leaves the loads `ρA w` at the points.
    #[inline(always)]
    fn outwards<S: Real>(&mut self, view: &View<S>, q: &[R], rigid: Rigid<R>, side: usize)
    where
        R: Over<S>,
    {
        let zero = R::default();
        let [mut w, mut theta] = [RunningSum::<R>::default(); 2];
        self.ends[side] = [zero; 2];
        let mut room = OneCell {
            strains: [zero; MOST_STRAINS],
            inner_end: [zero; 2],
            turn: [zero; MOST_TERMS],
            values: [zero; MOST_POINTS],
        };
        let mut arm = None;
        for Run { cells, stop } in view.runs(side) {
            for k in cells {
                let at = view.at(k);
                arm = Some(at.cell.arm + at.cell.length);
                let (cell, q) = (&at.cell, &q[at.strains.clone()]);
                cell.strains(q, view.terms - 2, &mut room.strains[..view.strains]);
                room.inner_end = [w.value(), theta.value()];
                self.ends[side][0] = self.take_cell(view, &at, rigid, &mut room);
                w.add(theta.value() * cell.length + inner(q, cell.lift));
                theta.add(inner(q, cell.turn));
            }
            let Some(placed) = view.placed() else { continue };
            match stop {
                Some(What::Joint(k)) => {
                    theta.add(q[placed.joints[k].place] * placed.joints[k].softness);
                }
                Some(What::PointMass(k)) => {
                    let point = &placed.points[k];
                    let [moved, turned] = point.displaced(w.value(), theta.value(), q);
                    self.carried += (moved * turned * point.mass * point.offset).abs();
                    let lift = rigid.deflection(point.arm + point.offset);
                    self.points[k] = [moved - lift, turned - rigid.turn];
                }
                Some(What::Contact(k)) => {
                    let contact = &placed.contacts[k];
                    let (false, Some(arm)) = (contact.turning, arm) else { continue };
                    let given = contact.spring.map(|s| q[s.place] * s.softness).unwrap_or_default();
                    let off = w.value() - rigid.deflection(arm) - given;
                    self.slack = self.slack.max(off.abs());
                }
                None => {}
            }
        }
    }

    /// Deflection and rotation of one cell. Returns the deflection at its outer end.
    #[inline(always)]
    fn take_cell<S: Real>(
        &mut self,
        view: &View<S>,
        at: &Located<S>,
        rigid: Rigid<R>,
        room: &mut OneCell<R>,
    ) -> R
    where
        R: Over<S>,
    {
        let (cell, half) = (&at.cell, S::splat(0.5) * at.cell.length);
        let shape = &mut self.shape[at.terms.clone()];
        let turn = &mut room.turn[..view.terms];
        integrated(cell.length, &room.strains[..view.strains], room.inner_end, shape, turn);
        shape[0] -= rigid.deflection(cell.arm + half);
        shape[1] -= rigid.turn * half;
        turn[0] -= rigid.turn;
        let samples = at.samples.clone();
        view.rule.values(shape, &mut room.values);
        let line = &view.mass_per_length[samples.clone()];
        let kept = &mut self.deflections[samples.clone()];
        keep(&room.values, line, kept, &mut self.changes[samples.clone()]);
        if view.theory.turns() {
            view.rule.values(turn, &mut room.values);
            let line = &view.turning_per_length[samples.clone()];
            let kept = &mut self.rotations[samples.clone()];
            keep(&room.values, line, kept, &mut self.turn_changes[samples]);
        }
        if view.theory.shears() {
            self.turns[at.terms.clone()].copy_from_slice(turn);
        }
        let mut end = R::default();
        for w in shape.iter() {
            end += *w;
        }
        end
    }

    /// Number of sign changes of the deflection at the points and the ends, from knob to tip; the number of its zeros
    /// is at least that. `split` elements are on the knob side.
    #[inline(always)]
    pub fn crossings(&self, split: usize) -> R {
        let points = self.deflections.len() / self.defects.len();
        let (knob, tip) = self.deflections.split_at(split * points);
        let sign = |w: &R| R::splat(1.0).copysign(*w);
        let (mut count, mut before) = (R::default(), sign(&self.ends[0][0]));
        for w in knob.iter().rev().chain(tip).chain([&self.ends[1][0]]) {
            let now = sign(w);
            count += R::splat(0.5) * (R::splat(1.0) - before * now);
            before = now;
        }
        count
    }

    /// Raises the value of every element, knob to tip, to its largest part of the defect in any lane; `split` elements
    /// are on the knob side.
    pub fn add_defects(&self, split: usize, most: &mut [f64]) {
        let (knob, tip) = self.defects.split_at(split);
        for (most, defect) in most.iter_mut().zip(knob.iter().rev().chain(tip)) {
            (0..R::LANES).for_each(|lane| *most = most.max(defect.lane(lane)));
        }
    }
}

/// Stores a motion's values at the points, and the loads `values · line` there.
#[inline(always)]
fn keep<S: Real, R: Over<S>>(values: &[R], line: &[S], kept: &mut [R], loads: &mut [R]) {
    for (((kept, load), line), value) in kept.iter_mut().zip(loads).zip(line).zip(values) {
        *kept = *value;
        *load = *value * *line;
    }
}

/// `Σ q_k a_k`.
#[inline(always)]
fn inner<S: Real, R: Over<S>>(q: &[R], a: &[S]) -> R {
    let mut sum = R::default();
    for (q, a) in q.iter().zip(a) {
        sum += *q * *a;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Elements of two points each, the knob's side first and from its end inwards.
    #[test]
    fn a_deflection_crosses_zero_as_often_as_its_sign_changes() {
        let motion = |knob: &[f64], tip: &[f64], ends: [f64; 2]| Motion {
            deflections: [knob, tip].concat(),
            defects: vec![0.0; (knob.len() + tip.len()) / 2],
            ends: ends.map(|end| [end, 0.0]),
            ..Motion::default()
        };
        let crossings =
            |knob: &[f64], tip: &[f64], ends| motion(knob, tip, ends).crossings(knob.len() / 2);
        assert_eq!(crossings(&[1.0, 2.0], &[1.0, 1.0], [1.0, 1.0]), 0.0);
        assert_eq!(crossings(&[-1.0, 2.0], &[-1.0, -2.0], [1.0, 1.0]), 2.0);
        assert_eq!(crossings(&[1.0, -1.0, -1.0, 1.0], &[-2.0, 3.0], [-1.0, -1.0]), 6.0);
    }
}
