//! One bending motion of the bat: its shape, its energies, and how far it is from a mode.
//!
//! A mode of the exact beam is the deflection that its own inertia makes. The inertia of a
//! computed mode makes bending moments that statics gives exactly, `M″ = ω²ρA w` from the free
//! ends, and these make the curvature `w*″ = M/EI`. The computed curvature w″ differs, because it
//! is a polynomial in every element and because the eigensolve stops somewhere, and
//!
//! ```text
//! η = ∫EI (w″ − w*″)² dx / ∫EI w″² dx = Σ_j c_j² (λ − λ_j)²/(λ λ_j)
//! ```
//!
//! with `c_j` the share of the exact mode `j` in the computed one (`Σ c_j² = 1`, λ = ω²). The error
//! of Rayleigh's quotient is `Σ c_j² (λ_j − λ_k)/λ`: the same sum but for a factor `1 − λ/λ_j`,
//! which is 1 for the fast modes that a mesh cannot hold. So `η/2` is the relative error of the
//! frequency, from the answer itself and no second mesh, thin ends included.
//!
//! # Source
//!
//! W. Prager, J. L. Synge, Quart. Appl. Math. 5 (1947) 241 for the comparison of a compatible with
//! an equilibrated field; Rayleigh's, Schwarz' and Grammel's quotients in L. Collatz,
//! Eigenwertaufgaben mit technischen Anwendungen (1963).

use crate::beam::element::{Vector, deflection, over_strains};
use crate::beam::rule::MOST_POINTS;
use crate::beam::statics::{Rigid, Statics, with_ends};
use crate::eigen::lanczos::dot;
use crate::quadrature::RunningSum;
use crate::real::{Over, Real};

/// A bending motion with the memory it was computed in.
#[derive(Debug, Clone, Default)]
pub struct Motion<R, const N: usize> {
    /// Deflection of every cell, outwards, the rigid motions taken out (m).
    pub shape: Vec<Vector<R, N>>,
    /// The same at the points of every cell.
    pub deflections: Vec<R>,
    /// By how much the deflection that the motion's inertia makes is less, at the same points.
    pub changes: Vec<R>,
    /// Deflection and change at the outer ends of both sides: knob end, tip.
    pub ends: [[R; 2]; 2],
    /// `∫ρA w² dx` (kg m²).
    pub kinetic: R,
    /// ω (rad/s): its square, Rayleigh's quotient, is strain energy over kinetic energy, both from
    /// the strains.
    pub omega: R,
    /// `‖q − ω² A q‖/‖q‖`: how far the strains are from an eigenvector of the compliance.
    pub residual: R,
    /// `η` above; half of it is the relative error of the frequency.
    pub defect: R,
    /// Every cell's part of it.
    pub defects: Vec<R>,
    image: Vec<R>,
    loads: Vec<Vector<R, N>>,
}

impl<R: Real, const N: usize> Motion<R, N> {
    /// The motion with those scaled strains and its energies; its defect too if wanted.
    ///
    /// With `value`, the eigenvalue of the compliance that the strains belong to, the kinetic
    /// energy is taken from it: half the work, no residual (0), and round-off of ε times the
    /// greatest eigenvalue over this one.
    #[inline(always)]
    pub fn take<S: Real>(
        &mut self,
        statics: &Statics<S, N>,
        q: &[R],
        value: Option<R>,
        with_defect: bool,
    ) where
        R: Over<S>,
    {
        let strain = dot(q, q);
        let rigid = match value {
            Some(value) => {
                self.kinetic = value * strain;
                self.residual = R::default();
                statics.rigid(q, &mut self.loads)
            }
            None => {
                self.image.resize(q.len(), R::default());
                let rigid = statics.apply(q, &mut self.image, &mut self.loads);
                self.kinetic = dot(q, &self.image);
                let scale = strain / self.kinetic;
                self.image.iter_mut().zip(q).for_each(|(y, q)| *y = *q - scale * *y);
                self.residual = (dot(&self.image, &self.image) / strain).sqrt();
                rigid
            }
        };
        let lambda = strain * statics.energy_unit / self.kinetic;
        self.omega = lambda.sqrt();
        let count = statics.cells.len();
        self.shape.resize(count, [R::default(); N]);
        self.deflections.resize(count * statics.rule.count(), R::default());
        self.changes.resize(count * statics.rule.count(), R::default());
        self.defects.resize(count, R::default());
        for (side, (cells, rigid)) in statics.sides(rigid).into_iter().enumerate() {
            self.outwards(statics, q, cells.clone(), rigid, side);
            if with_defect {
                self.inwards(statics, q, cells, lambda);
            }
        }
        if statics.split == 0 {
            // The root is the knob end itself: odd polynomials change sign there.
            let mut end = R::default();
            for (k, w) in self.shape[0].iter().enumerate() {
                end += if k % 2 == 1 { -*w } else { *w };
            }
            self.ends[0][0] = end;
        }
        self.defect = R::default();
        if !with_defect {
            return;
        }
        let scale = R::splat(1.0) / (strain * statics.energy_unit);
        for defect in &mut self.defects {
            *defect = *defect * scale;
            self.defect += *defect;
        }
    }

    /// Deflections outwards from the root at rest, less a rigid motion; loads `ρA w` at the points.
    #[inline(always)]
    fn outwards<S: Real>(
        &mut self,
        statics: &Statics<S, N>,
        q: &[R],
        cells: std::ops::Range<usize>,
        rigid: Rigid<R>,
        side: usize,
    ) where
        R: Over<S>,
    {
        let points = statics.rule.count();
        let [mut w, mut theta] = [RunningSum::<R>::default(); 2];
        self.ends[side] = [R::default(); 2];
        let mut values = [R::default(); MOST_POINTS];
        for k in cells {
            let cell = &statics.cells[k];
            let (h, q) = (cell.link.length, scaled::<R, N>(&q[k * (N - 2)..]));
            let half = S::splat(0.5) * h;
            let strains = cell.strains(&q);
            let mut shape = deflection(h, &strains, w.value(), theta.value());
            shape[0] -= rigid.deflection(cell.arm + half);
            shape[1] -= rigid.turn * half;
            let samples = k * points..(k + 1) * points;
            statics.rule.values(&shape, &mut values);
            let line = &statics.mass_per_length[samples.clone()];
            let kept = self.deflections[samples.clone()].iter_mut();
            let loads = self.changes[samples].iter_mut();
            for (((kept, load), line), value) in kept.zip(loads).zip(line).zip(&values) {
                *kept = *value;
                *load = *value * *line;
            }
            w.add(theta.value() * h + over_strains(&cell.link.lift, &q));
            theta.add(over_strains(&cell.link.turn, &q));
            self.ends[side][0] = shape.iter().fold(R::default(), |sum, w| sum + *w);
            self.shape[k] = shape;
        }
    }

    /// Bending moments inwards from the free end under these loads, and the other curvature that
    /// they make: leaves `w″ − w*″` at the points and `∫EI (w″ − w*″)² dx` of every cell.
    #[inline(always)]
    fn inwards<S: Real>(
        &mut self,
        statics: &Statics<S, N>,
        q: &[R],
        cells: std::ops::Range<usize>,
        lambda: R,
    ) where
        R: Over<S>,
    {
        let rule = statics.rule;
        let points = rule.count();
        let [mut shear, mut moment] = [RunningSum::<R>::default(); 2];
        let [mut own, mut curvature] = [[R::default(); MOST_POINTS]; 2];
        for k in cells.rev() {
            let cell = &statics.cells[k];
            let (h, q) = (cell.link.length, scaled::<R, N>(&q[k * (N - 2)..]));
            let strains = cell.strains(&q);
            let samples = k * points..(k + 1) * points;
            let stiffness = &statics.bending_stiffness[samples.clone()];
            let values = &mut self.changes[samples];
            let [force, turning] = rule.integrals(values);
            rule.twice_from_right(values, &mut own);
            rule.values(&strains[..N - 2], &mut curvature);
            let (v, m, square) = (shear.value() * h, moment.value(), h * h);
            let mut energy = R::default();
            for (j, (point, stiffness)) in rule.points.iter().zip(stiffness).enumerate() {
                let bending = m + v * R::splat(1.0 - point.s) + own[j] * square;
                let defect = curvature[j] * *stiffness - lambda * bending;
                values[j] = defect * (S::splat(1.0) / *stiffness);
                energy += defect * values[j] * (S::splat(point.weight) * h);
            }
            moment.add(v + turning * square);
            shear.add(force * h);
            self.defects[k] = energy;
        }
    }

    /// How often the deflection at the points and at the ends changes its sign from knob to tip: at
    /// most as often as it is zero.
    #[inline(always)]
    pub fn crossings<S: Real>(&self, statics: &Statics<S, N>) -> R {
        let (knob, tip) = self.deflections.split_at(statics.split * statics.rule.count());
        let sign = |w: &R| R::splat(1.0).copysign(*w);
        let (mut count, mut before) = (R::default(), sign(&self.ends[0][0]));
        for w in knob.iter().rev().chain(tip).chain([&self.ends[1][0]]) {
            let now = sign(w);
            count += R::splat(0.5) * (R::splat(1.0) - before * now);
            before = now;
        }
        count
    }

    /// Raises every element's number, knob to tip, to its part of the defect, in any lane.
    pub fn add_defects<S>(&self, statics: &Statics<S, N>, most: &mut [f64]) {
        let (knob, tip) = self.defects.split_at(statics.split);
        for (most, defect) in most.iter_mut().zip(knob.iter().rev().chain(tip)) {
            (0..R::LANES).for_each(|lane| *most = most.max(defect.lane(lane)));
        }
    }

    /// After [`Self::take`], leaves out what [`Self::take_changes`] would find.
    #[inline(always)]
    pub fn no_changes<S>(&mut self, statics: &Statics<S, N>) {
        self.changes.clear();
        self.changes.resize(statics.cells.len() * statics.rule.count(), R::default());
        self.ends[0][1] = R::default();
        self.ends[1][1] = R::default();
    }

    /// After [`Self::take`], `w″ − w*″` at the points becomes `w − w*`, the rigid motions taken
    /// out.
    #[inline(always)]
    pub fn take_changes<S: Real>(&mut self, statics: &Statics<S, N>)
    where
        R: Over<S>,
    {
        let points = statics.rule.count();
        let (mut total, mut own) = ([R::default(); 2], [R::default(); MOST_POINTS]);
        for (side, (cells, _)) in statics.sides(Rigid::<R>::default()).into_iter().enumerate() {
            let [mut w, mut theta, mut force, mut moment] = [R::default(); 4];
            for k in cells {
                let cell = &statics.cells[k];
                let h = cell.link.length;
                let samples = k * points..(k + 1) * points;
                let line = &statics.mass_per_length[samples.clone()];
                let change = &mut self.changes[samples];
                let [turned, first] = statics.rule.integrals(change);
                statics.rule.twice_from_left(change, &mut own);
                for (j, point) in statics.rule.points.iter().enumerate() {
                    let y = S::splat(point.s) * h;
                    change[j] = w + theta * y + own[j] * (h * h);
                    let share = change[j] * (S::splat(point.weight) * h * line[j]);
                    force += share;
                    moment += share * (cell.arm + y);
                }
                w += theta * h + (turned - first) * (h * h);
                theta += turned * h;
                self.ends[side][1] = w;
            }
            total[0] += force;
            total[1] += if side == 0 { -moment } else { moment };
        }
        let (mass, inertia) = (R::of(statics.mass), R::of(statics.inertia));
        let rigid = Rigid { push: total[0] / mass, turn: total[1] / inertia };
        for (side, (cells, rigid)) in statics.sides(rigid).into_iter().enumerate() {
            for k in cells {
                let cell = &statics.cells[k];
                let change = &mut self.changes[k * points..(k + 1) * points];
                for (change, point) in change.iter_mut().zip(&statics.rule.points) {
                    *change -= rigid.deflection(cell.arm + S::splat(point.s) * cell.link.length);
                }
                if k + 1 == statics.cells.len() || k + 1 == statics.split {
                    self.ends[side][1] -= rigid.deflection(cell.arm + cell.link.length);
                }
            }
        }
    }
}

/// The scaled strains of one cell; the last two places stay empty.
#[inline(always)]
fn scaled<R: Real, const N: usize>(q: &[R]) -> Vector<R, N> {
    with_ends(q, R::default(), R::default())
}
