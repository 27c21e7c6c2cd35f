//! How far is a motion from being a mode? Its defect measures that.
//!
//! A mode of the exact beam equals the deflection due to its own inertia. The inertia of a computed mode causes bending
//! moments that statics gives exactly: `M″ = ω²ρA w` from the free ends (`M′ = −Q − ω²ρI θ` with rotary inertia). These
//! cause the curvature `w*″ = M/EI`. The computed curvature w″ differs, because it is a polynomial in every element and
//! because the eigensolver stops at a finite accuracy. The defect is
//!
//! ```text
//! η = ∫EI (w″ − w*″)² dx / ∫EI w″² dx = Σ_j c_j² (λ − λ_j)²/(λ λ_j)
//! ```
//!
//! For a beam that shears, add `∫κGA (γ − γ*)² dx` with `γ* = Q/κGA` to the numerator and `∫κGA γ² dx` to the
//! denominator, and likewise for every spring and joint. `c_j` is the share of the exact mode `j` in the computed one
//! (`Σ c_j² = 1`, λ = ω²). The error of Rayleigh's quotient is `Σ c_j² (λ_j − λ_k)/λ`: the same sum but for a factor
//! `1 − λ/λ_j`, which is 1 for the fast modes that a mesh cannot represent. So `η/2` is the relative error of the
//! frequency. It follows from the answer itself without a second mesh, also with thin ends.
//!
//! On an element over stations, EI, ρA and 1/EI are polynomials with the moments of the true functions, and the
//! integrand is `EI w″² − 2 w″ M + M²/EI`. The last term counts what the polynomials do not follow at the stations.
//!
//! # Source
//!
//! W. Prager, J. L. Synge, Quart. Appl. Math. 5 (1947) 241 for the comparison of a compatible with
//! an equilibrated field; Rayleigh's, Schwarz' and Grammel's quotients in L. Collatz,
//! Eigenwertaufgaben mit technischen Anwendungen (1963).

use crate::base::{Over, Real, RunningSum, dot};
use crate::beam::element::{MOST_STRAINS, MOST_TERMS};
use crate::beam::motion::Motion;
use crate::beam::rule::MOST_POINTS;
use crate::beam::view::{Located, View};
use crate::beam::walk::{Run, What};

/// Memory for the numbers of one cell.
struct OneCell<R> {
    strains: [R; MOST_STRAINS],
    /// Loads, integrated once and twice from the right.
    once: [R; MOST_POINTS],
    twice: [R; MOST_POINTS],
    values: [R; MOST_POINTS],
}

/// Shear force and moment of the loads outwards of a place.
#[derive(Clone, Copy, Default)]
struct Carried<R> {
    shear: RunningSum<R>,
    moment: RunningSum<R>,
}

impl<R: Real> Motion<R> {
    /// Computes the defect of the motion after [`Self::take`] with these scaled strains. Leaves the differences of the
    /// strains at the points.
    #[inline(always)]
    pub fn take_defect<S: Real>(&mut self, view: &View<S>, q: &[R])
    where
        R: Over<S>,
    {
        let unit = self.strain * view.energy_unit;
        let lambda = unit / self.kinetic;
        for side in [0, 1] {
            self.inwards(view, q, lambda, side);
        }
        self.defect = R::default();
        let scale = R::splat(1.0) / unit;
        for defect in &mut self.defects {
            *defect = *defect * scale;
            self.defect += *defect;
        }
        // Springs and joints; the strain of a rigid one is 0.
        if let Some(missed) = self.image.get(view.strains * view.count..) {
            self.defect += dot(missed, missed) / self.strain;
        }
    }

    /// Bending moments under the loads, inwards from the free end, and the other strains that follow from them. Leaves
    /// the differences at the points and their energy in every cell.
    #[inline(always)]
    fn inwards<S: Real>(&mut self, view: &View<S>, q: &[R], lambda: R, side: usize)
    where
        R: Over<S>,
    {
        let zero = R::default();
        let mut carried = Carried::default();
        let [once, twice, values] = [[zero; MOST_POINTS]; 3];
        let mut room = OneCell { strains: [zero; MOST_STRAINS], once, twice, values };
        for Run { cells, stop } in view.runs(side).rev() {
            if let (Some(placed), Some(stop)) = (view.placed(), stop) {
                let [force, couple] = match stop {
                    What::PointMass(k) => self.forces[k],
                    What::Contact(k) => placed.contacts[k].on_the_bat(self.reactions[k]),
                    What::Joint(_) => [R::default(); 2],
                };
                carried.shear.add(force);
                carried.moment.add(couple);
            }
            for k in cells.rev() {
                let at = view.at(k);
                let strains = &mut room.strains[..view.strains];
                at.cell.strains(&q[at.strains.clone()], view.terms - 2, strains);
                self.take_off_bed(view, &at, &mut room.values);
                self.cross(view, &at, lambda, &mut carried, &mut room);
            }
        }
    }

    /// One cell of the pass inwards: the differences at its points and their energy.
    #[inline(always)]
    fn cross<S: Real>(
        &mut self,
        view: &View<S>,
        at: &Located<S>,
        lambda: R,
        carried: &mut Carried<R>,
        room: &mut OneCell<R>,
    ) where
        R: Over<S>,
    {
        let (rule, h, samples) = (view.rule, at.cell.length, at.samples.clone());
        let loads = &mut self.changes[samples.clone()];
        let [force, turning] = rule.integrals(loads);
        rule.combine(&rule.twice_from_right, loads, &mut room.twice);
        let (v, m, square) = (carried.shear.value() * h, carried.moment.value(), h * h);
        let mut gained = v + turning * square;
        let mut energy = R::default();
        if view.theory.shears() {
            rule.combine(&rule.once_from_right, loads, &mut room.once);
            energy = self.slip(view, at, lambda, carried.shear.value(), room);
        }
        let turns = view.theory.turns();
        if turns {
            let couples = &self.turn_changes[samples.clone()];
            rule.combine(&rule.once_from_right, couples, &mut room.once);
            gained += rule.integrals(couples)[0] * h;
        }
        rule.values(&room.strains[..view.terms - 2], &mut room.values);
        let stiffness = &view.bending_stiffness[samples.clone()];
        let softness = &view.softness[0][samples.clone()];
        let changes = &mut self.changes[samples];
        for (j, (point, stiffness)) in rule.points.iter().zip(stiffness).enumerate() {
            let mut bending = m + v * R::splat(1.0 - point.s) + room.twice[j] * square;
            if turns {
                bending += room.once[j] * h;
            }
            let section = [*stiffness, softness[j]];
            let [change, square] = difference(room.values[j], lambda * bending, section, view.over);
            changes[j] = change;
            energy += square * (S::splat(point.weight) * h);
        }
        carried.moment.add(gained);
        carried.shear.add(force * h);
        self.defects[at.number] = energy;
    }

    /// Subtracts from a cell's loads the part that an elastic bed under the cell carries.
    #[inline(always)]
    fn take_off_bed<S: Real>(
        &mut self,
        view: &View<S>,
        at: &Located<S>,
        values: &mut [R; MOST_POINTS],
    ) where
        R: Over<S>,
    {
        let Some(bed) = view.bed(at.number) else { return };
        // Its reactions t are equivalent to the line load `Σ (2k + 1) t_k P_k / h`.
        let mut load = [R::default(); MOST_TERMS];
        for (term, (load, t)) in load.iter_mut().zip(&self.reactions[bed]).enumerate() {
            *load = *t * (S::splat((2 * term + 1) as f64) / at.cell.length);
        }
        view.rule.values(&load[..view.terms], values);
        let loads = self.changes[at.samples.clone()].iter_mut();
        loads.zip(values).for_each(|(v, load)| *v -= *load);
    }

    /// The differences of the shear strains of one cell at its points, from its loads integrated once. Returns their
    /// energy.
    #[inline(always)]
    fn slip<S: Real>(
        &mut self,
        view: &View<S>,
        at: &Located<S>,
        lambda: R,
        shear: R,
        room: &mut OneCell<R>,
    ) -> R
    where
        R: Over<S>,
    {
        let (rule, h, samples) = (view.rule, at.cell.length, at.samples.clone());
        rule.values(&room.strains[view.terms - 2..view.strains], &mut room.values);
        let stiffness = &view.shear_stiffness[samples.clone()];
        let softness = &view.softness[1][samples.clone()];
        let slips = &mut self.slips[samples];
        let mut energy = R::default();
        for (j, (point, stiffness)) in rule.points.iter().zip(stiffness).enumerate() {
            let across = lambda * (shear + room.once[j] * h);
            let section = [*stiffness, softness[j]];
            let [slip, square] = difference(room.values[j], across, section, view.over);
            slips[j] = slip;
            energy += square * (S::splat(point.weight) * h);
        }
        energy
    }
}

/// A strain less that of a stress, and the energy of this difference. The softness is 1/stiffness, except where the
/// points represent polynomials `over` stations.
#[inline(always)]
fn difference<S: Real, R: Over<S>>(
    strain: R,
    stress: R,
    [stiffness, softness]: [S; 2],
    over: bool,
) -> [R; 2] {
    let defect = strain * stiffness - stress;
    if over {
        let change = strain - stress * softness;
        let beyond = strain * stress * (stiffness * softness - S::splat(1.0));
        return [change, defect * change + beyond];
    }
    let change = defect * softness;
    [change, defect * change]
}
