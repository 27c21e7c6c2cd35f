//! One bending motion of the bat: its shape, its energies, and how far it is from a mode.
//!
//! A mode of the exact beam is the deflection that its own inertia makes. The inertia of a computed
//! mode makes bending moments that statics gives exactly, `M″ = ω²ρA w` from the free ends (`M′ =
//! −Q − ω²ρI θ` with rotary inertia), and these make the curvature `w*″ = M/EI`. The computed
//! curvature w″ differs, because it is a polynomial in every element and because the eigensolve
//! stops somewhere, and
//!
//! ```text
//! η = ∫EI (w″ − w*″)² dx / ∫EI w″² dx = Σ_j c_j² (λ − λ_j)²/(λ λ_j)
//! ```
//!
//! (and, of a beam that shears, `∫κGA (γ − γ*)² dx` with `γ* = Q/κGA` in the numerator, `∫κGA γ²
//! dx` in the denominator, and likewise for every spring and joint), with `c_j` the share of the
//! exact mode `j` in the computed one (`Σ c_j² = 1`, λ = ω²). The error of Rayleigh's quotient is
//! `Σ c_j² (λ_j − λ_k)/λ`: the same sum but for a factor `1 − λ/λ_j`, which is 1 for the fast modes
//! that a mesh cannot hold. So `η/2` is the relative error of the frequency, from the answer itself
//! and no second mesh, thin ends included.
//!
//! # Source
//!
//! W. Prager, J. L. Synge, Quart. Appl. Math. 5 (1947) 241 for the comparison of a compatible with
//! an equilibrated field; Rayleigh's, Schwarz' and Grammel's quotients in L. Collatz,
//! Eigenwertaufgaben mit technischen Anwendungen (1963).

use std::ops::Range;

use crate::base::quadrature::RunningSum;
use crate::base::real::{Over, Real};
use crate::beam::element::{MOST_STRAINS, MOST_TERMS, integrated};
use crate::beam::fixed::{Stop, What};
use crate::beam::holds::Given;
use crate::beam::rule::MOST_POINTS;
use crate::beam::statics::{Statics, View};
use crate::beam::sweep::{Loads, Rigid};
use crate::eigen::lanczos::dot;

/// A bending motion with the memory it was computed in.
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
    /// Amount by which the inertial deflection falls short of [`Self::deflections`] (m), at its points.
    pub changes: Vec<R>,
    /// Deflection (m) and its change (m) at the outer ends of both sides: knob end, tip.
    pub ends: [[R; 2]; 2],
    /// Kinetic energy over ω²/2: `∫ρA w² dx`, `∫ρI θ² dx` and what is attached (kg m²).
    pub kinetic: R,
    /// Product of the motion and its [`Self::changes`] `c` in the bat's mass: `∫ρA w c dx`,
    /// `∫ρI θ c_θ dx` and what is attached (kg m²).
    pub work: R,
    /// ω (rad/s): its square, Rayleigh's quotient, is strain energy over kinetic energy, both from
    /// the strains.
    pub omega: R,
    /// `‖q − ω² A q‖/‖q‖`: how far the strains are from an eigenvector of the compliance.
    pub residual: R,
    /// `η` of this module; half of it is the relative error of the frequency.
    pub defect: R,
    /// Part of [`Self::defect`] of every cell.
    pub defects: Vec<R>,
    /// Rotation and its change at the points, where it has inertia.
    rotations: Vec<R>,
    turn_changes: Vec<R>,
    /// The shear strain less that of the inertia's shear force, at the points.
    slips: Vec<R>,
    /// Displacement and rotation of the point masses, outwards, and their changes.
    points: Vec<[R; 2]>,
    point_changes: Vec<[R; 2]>,
    /// `A q`, then `q − ω² A q`.
    image: Vec<R>,
    /// Inertia of the point masses and reactions of the contacts.
    forces: Vec<[R; 2]>,
    reactions: Vec<R>,
}

/// How closely a motion is looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Depth {
    /// Shape and energies of the motion.
    Shape,
    /// Shape, energies and defect.
    Defect,
    /// Shape, energies, defect, and how far the shape may be off.
    Changes,
}

/// The loads of a motion's inertia, with the memory for them.
#[derive(Debug, Clone)]
pub struct Applied<R, const W: usize> {
    loads: Loads<R, W>,
    /// The free rigid motion that carries them.
    pub rigid: Rigid<R>,
}

impl<R: Real, const W: usize> Default for Applied<R, W> {
    fn default() -> Self {
        Self { loads: Loads::default(), rigid: Rigid::default() }
    }
}

impl<R: Real> Motion<R> {
    /// What the inertia of the motion with those scaled strains does, for [`Self::take`]; with the
    /// eigenvalue of a bare bat known, half of it.
    #[inline(always)]
    pub fn apply<S: Real, const N: usize, const W: usize>(
        &mut self,
        statics: &Statics<S, N, W>,
        q: &[R],
        value_known: bool,
        applied: &mut Applied<R, W>,
    ) where
        R: Over<S>,
    {
        if value_known {
            applied.rigid = statics.rigid(q, &mut applied.loads);
            return;
        }
        self.image.resize(q.len(), R::default());
        applied.rigid = statics.apply(q, &mut self.image, &mut applied.loads);
        self.forces.clone_from(&applied.loads.points);
        self.reactions.clone_from(&applied.loads.contacts);
    }

    /// The motion with those scaled strains and its energies, after [`Self::apply`]; its defect too
    /// if wanted.
    ///
    /// With `value`, the eigenvalue of the compliance that the strains of a bare bat belong to, the
    /// kinetic energy is taken from it: half the work, no residual (0), and round-off of ε times
    /// the greatest eigenvalue over this one. Strains in `known`, one motion after the other, are
    /// other modes, whose round-off is taken out.
    #[inline(always)]
    pub fn take<S: Real>(
        &mut self,
        view: &View<S>,
        rigid: Rigid<R>,
        q: &[R],
        value: Option<R>,
        known: &[S],
        with_defect: bool,
    ) where
        R: Over<S>,
    {
        let strain = dot(q, q);
        match value {
            Some(value) => {
                self.kinetic = value * strain;
                self.residual = R::default();
            }
            None => {
                for known in known.chunks_exact(q.len()) {
                    let mut part = R::default();
                    self.image.iter().zip(known).for_each(|(y, v)| part += *y * *v);
                    self.image.iter_mut().zip(known).for_each(|(y, v)| *y -= part * *v);
                }
                self.kinetic = dot(q, &self.image);
                let scale = strain / self.kinetic;
                self.image.iter_mut().zip(q).for_each(|(y, q)| *y = *q - scale * *y);
                self.residual = (dot(&self.image, &self.image) / strain).sqrt();
            }
        }
        let lambda = strain * view.energy_unit / self.kinetic;
        self.omega = lambda.sqrt();
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
        for (side, (cells, rigid)) in view.sides(rigid).into_iter().enumerate() {
            self.outwards(view, q, cells.clone(), rigid, side);
            if with_defect {
                self.inwards(view, q, cells, lambda, side);
            }
        }
        if view.split == 0 {
            // The root is the knob end itself: odd polynomials change sign there.
            let mut end = R::default();
            for (k, w) in self.shape[..view.terms].iter().enumerate() {
                end += if k % 2 == 1 { -*w } else { *w };
            }
            self.ends[0][0] = end;
        }
        self.defect = R::default();
        if !with_defect {
            return;
        }
        let scale = R::splat(1.0) / (strain * view.energy_unit);
        for defect in &mut self.defects {
            *defect = *defect * scale;
            self.defect += *defect;
        }
        // Springs and joints; the strain of one that does not give way is 0.
        if let (None, Some(missed)) = (value, self.image.get(view.strains * view.count..)) {
            self.defect += dot(missed, missed) / strain;
        }
    }

    /// Deflections outwards from the root at rest, less a rigid motion; loads `ρA w` at the points.
    #[inline(always)]
    fn outwards<S: Real>(
        &mut self,
        view: &View<S>,
        q: &[R],
        cells: Range<usize>,
        rigid: Rigid<R>,
        side: usize,
    ) where
        R: Over<S>,
    {
        let points = view.rule.count();
        let [mut w, mut theta] = [RunningSum::<R>::default(); 2];
        self.ends[side] = [R::default(); 2];
        let mut values = [R::default(); MOST_POINTS];
        let (mut strains, mut turn) = ([R::default(); MOST_STRAINS], [R::default(); MOST_TERMS]);
        let shearing = view.theory.shears();
        let stops = view.stops(side);
        for run in runs(&cells, stops) {
            for k in run.cells {
                let cell = (view.cell)(k);
                let (h, q) = (cell.length, &q[k * view.strains..(k + 1) * view.strains]);
                let half = S::splat(0.5) * h;
                let strains = &mut strains[..view.strains];
                cell.strains(q, view.terms - 2, strains);
                let shape = &mut self.shape[k * view.terms..(k + 1) * view.terms];
                let turn = &mut turn[..view.terms];
                integrated(h, strains, [w.value(), theta.value()], shape, turn);
                shape[0] -= rigid.deflection(cell.arm + half);
                shape[1] -= rigid.turn * half;
                turn[0] -= rigid.turn;
                let samples = k * points..(k + 1) * points;
                view.rule.values(shape, &mut values);
                let line = &view.mass_per_length[samples.clone()];
                let kept = self.deflections[samples.clone()].iter_mut();
                let loads = self.changes[samples.clone()].iter_mut();
                for (((kept, load), line), value) in kept.zip(loads).zip(line).zip(&values) {
                    *kept = *value;
                    *load = *value * *line;
                }
                if view.theory.turns() {
                    view.rule.values(turn, &mut values);
                    let line = &view.turning_per_length[samples.clone()];
                    let kept = self.rotations[samples.clone()].iter_mut();
                    let couples = self.turn_changes[samples].iter_mut();
                    for (((kept, couple), line), value) in kept.zip(couples).zip(line).zip(&values)
                    {
                        *kept = *value;
                        *couple = *value * *line;
                    }
                }
                w.add(theta.value() * h + inner(q, cell.lift));
                theta.add(inner(q, cell.turn));
                self.ends[side][0] = shape.iter().fold(R::default(), |sum, w| sum + *w);
                if shearing {
                    self.turns[k * view.terms..(k + 1) * view.terms].copy_from_slice(turn);
                }
            }
            let Some(fixed) = view.fixed_for::<R>() else { continue };
            match run.stop {
                Some(What::Joint(k)) => {
                    theta.add(q[fixed.joints[k].place] * fixed.joints[k].softness);
                }
                Some(What::PointMass(k)) => {
                    let point = &fixed.points[k];
                    let [moved, turned] = point.displaced(w.value(), theta.value(), q);
                    let lift = rigid.deflection(point.arm + point.offset);
                    self.points[k] = [moved - lift, turned - rigid.turn];
                }
                _ => {}
            }
        }
    }

    /// Bending moments inwards from the free end under these loads, and the other strains that they
    /// make: leaves the differences at the points and their energy in every cell.
    #[inline(always)]
    fn inwards<S: Real>(
        &mut self,
        view: &View<S>,
        q: &[R],
        cells: Range<usize>,
        lambda: R,
        side: usize,
    ) where
        R: Over<S>,
    {
        let rule = view.rule;
        let points = rule.count();
        let (turns, shears) = (view.theory.turns(), view.theory.shears());
        let mut strains = [R::default(); MOST_STRAINS];
        let [mut shear, mut moment] = [RunningSum::<R>::default(); 2];
        let [mut own, mut once, mut values_of] = [[R::default(); MOST_POINTS]; 3];
        for run in runs(&cells, view.stops(side)).rev() {
            if let (Some(fixed), Some(stop)) = (view.fixed_for::<R>(), run.stop) {
                let [force, couple] = match stop {
                    What::PointMass(k) => self.forces[k],
                    What::Contact(k) => fixed.contacts[k].on_the_bat(self.reactions[k]),
                    What::Joint(_) => [R::default(); 2],
                };
                shear.add(force);
                moment.add(couple);
            }
            for k in run.cells.rev() {
                let cell = (view.cell)(k);
                let (h, q) = (cell.length, &q[k * view.strains..(k + 1) * view.strains]);
                let strains = &mut strains[..view.strains];
                cell.strains(q, view.terms - 2, strains);
                let samples = k * points..(k + 1) * points;
                let stiffness = &view.bending_stiffness[samples.clone()];
                let values = &mut self.changes[samples.clone()];
                if let Some(bed) = view.bed::<R>(k) {
                    // Its reactions t are those of the line load `Σ (2k + 1) t_k P_k / h`.
                    let mut load = [R::default(); MOST_TERMS];
                    for (term, (load, t)) in load.iter_mut().zip(&self.reactions[bed]).enumerate() {
                        *load = *t * (S::splat((2 * term + 1) as f64) / h);
                    }
                    rule.values(&load[..view.terms], &mut values_of);
                    values.iter_mut().zip(&values_of).for_each(|(v, load)| *v -= *load);
                }
                let [force, turning] = rule.integrals(values);
                rule.twice_from_right(values, &mut own);
                let (v, m, square) = (shear.value() * h, moment.value(), h * h);
                let mut energy = R::default();
                let mut gained = v + turning * square;
                if shears {
                    rule.once_from_right(values, &mut once);
                    rule.values(&strains[view.terms - 2..], &mut values_of);
                    let stiffness = &view.shear_stiffness[samples.clone()];
                    let slips = &mut self.slips[samples.clone()];
                    for (j, (point, stiffness)) in rule.points.iter().zip(stiffness).enumerate() {
                        let across = shear.value() + once[j] * h;
                        let defect = values_of[j] * *stiffness - lambda * across;
                        slips[j] = defect * (S::splat(1.0) / *stiffness);
                        energy += defect * slips[j] * (S::splat(point.weight) * h);
                    }
                }
                if turns {
                    let couples = &self.turn_changes[samples.clone()];
                    rule.once_from_right(couples, &mut once);
                    gained += rule.integrals(couples)[0] * h;
                }
                rule.values(&strains[..view.terms - 2], &mut values_of);
                for (j, (point, stiffness)) in rule.points.iter().zip(stiffness).enumerate() {
                    let mut bending = m + v * R::splat(1.0 - point.s) + own[j] * square;
                    if turns {
                        bending += once[j] * h;
                    }
                    let defect = values_of[j] * *stiffness - lambda * bending;
                    values[j] = defect * (S::splat(1.0) / *stiffness);
                    energy += defect * values[j] * (S::splat(point.weight) * h);
                }
                moment.add(gained);
                shear.add(force * h);
                self.defects[k] = energy;
            }
        }
    }

    /// How often the deflection at the points and at the ends changes its sign from knob to tip: at
    /// most as often as it is zero. `split` elements are on the knob side.
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

    /// Raises every element's number, knob to tip, to its part of the defect, in any lane; `split`
    /// of them are on the knob side.
    pub fn add_defects(&self, split: usize, most: &mut [f64]) {
        let (knob, tip) = self.defects.split_at(split);
        for (most, defect) in most.iter_mut().zip(knob.iter().rev().chain(tip)) {
            (0..R::LANES).for_each(|lane| *most = most.max(defect.lane(lane)));
        }
    }

    /// After [`Self::take`], leaves out what [`Self::take_changes`] would find.
    #[inline(always)]
    pub fn no_changes<S: Real>(&mut self, view: &View<S>) {
        self.changes.clear();
        self.changes.resize(view.count * view.rule.count(), R::default());
        self.ends[0][1] = R::default();
        self.ends[1][1] = R::default();
        self.work = R::default();
    }

    /// After [`Self::take`], the strains' differences at the points become `w − w*`, the rigid
    /// motions taken out.
    #[inline(always)]
    pub fn take_changes<S: Real>(&mut self, view: &View<S>)
    where
        R: Over<S>,
    {
        let (points, turns) = (view.rule.count(), view.theory.turns());
        let shears = view.theory.shears();
        let [mut own, mut once] = [[R::default(); MOST_POINTS]; 2];
        let mut total = [R::default(); 2];
        let contacts = view.fixed_for::<R>().map_or(0, |fixed| fixed.contacts.len());
        let mut held = vec![R::default(); contacts];
        self.point_changes.resize(self.points.len(), [R::default(); 2]);
        for (side, (cells, _)) in view.sides(Rigid::<R>::default()).into_iter().enumerate() {
            let [mut w, mut theta, mut force, mut moment] = [R::default(); 4];
            for run in runs(&cells, view.stops(side)) {
                for k in run.cells {
                    let cell = (view.cell)(k);
                    let h = cell.length;
                    let samples = k * points..(k + 1) * points;
                    let line = &view.mass_per_length[samples.clone()];
                    let change = &mut self.changes[samples.clone()];
                    let [turned, first] = view.rule.integrals(change);
                    view.rule.twice_from_left(change, &mut own);
                    if turns {
                        view.rule.once_from_left(change, &mut once);
                        let line = &view.turning_per_length[samples.clone()];
                        let turn = &mut self.turn_changes[samples.clone()];
                        for (j, point) in view.rule.points.iter().enumerate() {
                            turn[j] = theta + once[j] * h;
                            moment += turn[j] * (S::splat(point.weight) * h * line[j]);
                        }
                    }
                    let mut slipped = R::default();
                    if shears {
                        let slips = &self.slips[samples.clone()];
                        view.rule.once_from_left(slips, &mut once);
                        slipped = view.rule.integrals(slips)[0] * h;
                    }
                    for (j, point) in view.rule.points.iter().enumerate() {
                        let y = S::splat(point.s) * h;
                        change[j] = w + theta * y + own[j] * (h * h);
                        if shears {
                            change[j] += once[j] * h;
                        }
                        let share = change[j] * (S::splat(point.weight) * h * line[j]);
                        force += share;
                        moment += share * (cell.arm + y);
                    }
                    if let Some(bed) = view.bed::<R>(k) {
                        view.rule.coefficients(change, &mut held[bed]);
                    }
                    w += theta * h + (turned - first) * (h * h) + slipped;
                    theta += turned * h;
                    self.ends[side][1] = w;
                }
                let Some(fixed) = view.fixed_for::<R>() else { continue };
                match run.stop {
                    Some(What::Joint(k)) => {
                        let joint = &fixed.joints[k];
                        theta += self.image[joint.place] * joint.softness;
                    }
                    Some(What::PointMass(k)) => {
                        let point = &fixed.points[k];
                        let change = point.displaced(w, theta, &self.image);
                        let [push, couple] = point.load(change);
                        self.point_changes[k] = change;
                        force += push;
                        moment += push * point.arm + couple;
                    }
                    Some(What::Contact(k)) => {
                        let contact = &fixed.contacts[k];
                        held[k] = if contact.turning { theta * contact.sign } else { w };
                    }
                    None => {}
                }
            }
            total[0] += force;
            total[1] += if side == 0 { -moment } else { moment };
        }
        let rigid = match view.fixed_for::<R>() {
            None => {
                Rigid { push: total[0] / R::of(view.mass), turn: total[1] / R::of(view.inertia) }
            }
            Some(fixed) => {
                for (held, contact) in held.iter_mut().zip(&fixed.contacts) {
                    let given = contact.spring.map(|s| self.image[s.place] * s.softness);
                    *held -= given.unwrap_or_default();
                }
                let first = fixed.rigid(Given::Displacements(&held));
                let (mass, inertia) = (R::of(view.mass), R::of(view.inertia));
                let left = [total[0] - first.push * mass, total[1] - first.turn * inertia];
                let free = fixed.free_part(view.mass, view.inertia, left);
                Rigid { push: first.push + free.push, turn: first.turn + free.turn }
            }
        };
        self.work = R::default();
        for (side, (cells, rigid)) in view.sides(rigid).into_iter().enumerate() {
            for k in cells {
                let cell = (view.cell)(k);
                let h = cell.length;
                let samples = k * points..(k + 1) * points;
                let change = &mut self.changes[samples.clone()];
                let mut sum = R::default();
                for (j, point) in view.rule.points.iter().enumerate() {
                    change[j] -= rigid.deflection(cell.arm + S::splat(point.s) * h);
                    let line = view.mass_per_length[samples.start + j];
                    let w = self.deflections[samples.start + j];
                    sum += w * change[j] * (S::splat(point.weight) * line);
                    if turns {
                        let turn = &mut self.turn_changes[samples.start + j];
                        *turn -= rigid.turn;
                        let line = view.turning_per_length[samples.start + j];
                        let theta = self.rotations[samples.start + j];
                        sum += theta * *turn * (S::splat(point.weight) * line);
                    }
                }
                self.work += sum * h;
                if k + 1 == view.count || k + 1 == view.split {
                    self.ends[side][1] -= rigid.deflection(cell.arm + h);
                }
            }
            let Some(fixed) = view.fixed_for::<R>() else { continue };
            for stop in &fixed.stops[side] {
                let What::PointMass(k) = stop.what else { continue };
                let point = &fixed.points[k];
                let [moved, turned] = self.point_changes[k];
                let lift = rigid.deflection(point.arm + point.offset);
                let [push, couple] = point.load([moved - lift, turned - rigid.turn]);
                let [at, turn] = self.points[k];
                // The force acts at the centre of the mass, `offset` beyond its own place.
                self.work += push * at + (couple - push * point.offset) * turn;
            }
        }
    }
}

impl Motion<f64> {
    /// One motion alone, for large meshes, few calls and bats with anything on them.
    pub fn take_alone<const N: usize, const W: usize>(
        &mut self,
        statics: &Statics<f64, N, W>,
        q: &[f64],
        known: &[f64],
        depth: Depth,
    ) {
        let mut applied = Applied::default();
        self.apply(statics, q, false, &mut applied);
        let cell = |k: usize| statics.cell(k);
        self.see(&statics.view(&cell), applied.rigid, q, known, depth);
    }

    /// [`Self::take`], compiled once.
    fn see(&mut self, view: &View<f64>, rigid: Rigid<f64>, q: &[f64], known: &[f64], depth: Depth) {
        self.take(view, rigid, q, None, known, depth != Depth::Shape);
        match depth {
            Depth::Changes => self.take_changes(view),
            _ => self.no_changes(view),
        }
    }
}

/// Cells in a row, and what stands at their outer end.
struct Run {
    cells: Range<usize>,
    stop: Option<What>,
}

/// The cells of a side from stop to stop.
#[inline(always)]
fn runs(cells: &Range<usize>, stops: &[Stop]) -> impl DoubleEndedIterator<Item = Run> {
    let (first, last) = (cells.start, cells.end);
    (0..=stops.len()).map(move |k| Run {
        cells: if k == 0 { first } else { first + stops[k - 1].after }
            ..stops.get(k).map_or(last, |stop| first + stop.after),
        stop: stops.get(k).map(|stop| stop.what),
    })
}

/// `Σ q_k a_k`.
#[inline(always)]
fn inner<S: Real, R: Over<S>>(q: &[R], a: &[S]) -> R {
    let mut sum = R::default();
    q.iter().zip(a).for_each(|(q, a)| sum += *q * *a);
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
