//! How far can the Rayleigh quotient of a trial be from an eigenvalue? Its energies and its residual give the answer.
//!
//! `H` are pairs of strains, curvature χ and shear strain γ, with `(k, k) = ∫EI χ² + κGA γ² dx`. `S` integrates
//! them to the motion `(w, θ)` and takes the two rigid motions out, orthogonally in
//! `⟨·,·⟩ = ∫ρA w² + ρI θ² dx` and what the masses add. `T = S*S` has the eigenvalues `τ_n = 1/ω_n²`:
//!
//! ```text
//! V′ = ρA w,  m′ = V − ρI θ,  both 0 at both ends;       T k = (m/EI, −V/κGA)
//! ```
//!
//! Three numbers are known for any trial `k`:
//!
//! ```text
//! a₀ = (k, k)     a₁ = (k, Tk) = ⟨Sk, Sk⟩     σ = a₁/a₀
//! ε² = |Tk − σk|²/a₀ ≤ (1/a₀) Σ_e [∫(m − zEIχ)²/EI + ∫(V + zκGAγ)²/κGA],   z any number
//! ```
//!
//! Each compliant spring adds a similar term with its `K` and the `(Tk)` of [`super::gives`], where m is the value on
//! the tip side of the masses at its place. This holds because the left side is smallest for `z = σ`. Where κGA differs
//! from a polynomial `c` by a relative difference of at most `β`, `‖V + zκGAγ‖ ≤ ‖V + zcγ‖ + β z ‖cγ‖`.

use crate::enclosure::beam::{BeamCell, Mass, Proven};
use crate::enclosure::gives::{Give, YieldingPart};
use crate::enclosure::moved::{Along, Trial, TrialMotion, Tried};
use crate::enclosure::reactions::Reactions;
use crate::gauss::GAUSS_24;
use crate::series::Series;
use sweetspot::base::interval::{Interval, up};

/// The proven numbers of a trial.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Energies {
    /// σ (s²).
    pub quotient: Interval,
    /// ε² (s⁴), at most.
    pub residual: f64,
    /// `a₀` (J).
    pub strain: Interval,
}

const ZERO: Interval = Interval { low: 0.0, high: 0.0 };

impl Proven {
    /// The proven numbers of a trial; None for one without strain.
    pub fn energies(&self, trial: &Trial) -> Option<Energies> {
        let own = trial.terms * self.cells.len();
        let sheared = if self.theory.shears() { own } else { 0 };
        let gives = self.masses.iter().filter(|mass| mass.give.is_some()).count();
        if trial.terms == 0 || trial.bending.len() != own || trial.shear.len() != sheared {
            return None;
        }
        if trial.gives.len() != gives || !trial.gives.iter().all(|strain| strain.is_finite()) {
            return None;
        }
        let moved = self.moved(trial)?;
        let (mut strain, mut kinetic) = (ZERO, ZERO);
        let mut loads = Vec::with_capacity(self.cells.len());
        let mut strains = Vec::with_capacity(self.cells.len());
        for (k, cell) in self.cells.iter().enumerate() {
            let (own, reaction) = cell.strained(&moved.bending[k], trial.shear_on(k));
            strain = strain + cell.half * own;
            strains.push(reaction);
            let (own, load) = cell.carried(&moved.cells[k], moved.drift[k]);
            kinetic = kinetic + cell.half * own;
            loads.push(load);
        }
        for mass in &self.masses {
            let [w, turn] = moved.borders[mass.border].map(Interval::point);
            let at = mass.at([w, turn], &moved.gives);
            kinetic = kinetic + mass.mass * at.square() + mass.inertia * turn.square();
            if let Some(give) = mass.give {
                strain = strain + give.stiffness * moved.gives[give.number].square();
            }
        }
        strain = self.of_holds(&moved, strain);
        let over = strain.reciprocal().filter(|over| over.low > 0.0)?;
        let z = (kinetic * over).middle();
        let mut tried = Tried { moved, loads, strains, z };
        for k in self.in_bed() {
            tried.loads[k].0 = tried.loads[k].0 - self.pressed(&tried, k);
        }
        let Reactions { contacts, line } = self.reactions(&tried)?;
        let mut beyond = 0.0;
        for k in self.in_bed() {
            let line = self.line(line, k)?;
            tried.loads[k].0 = tried.loads[k].0 - line;
            beyond = up(beyond + up(self.cells[k].half.high * line.square_at_most()));
        }
        let (left, work) = self.residual(&tried, &contacts);
        let left = up(left + self.bed.map_or(0.0, |bed| up(beyond / bed.stiffness.low)));
        let moved = &tried.moved;
        kinetic = kinetic - self.of_rigid(moved.rigid) + Interval::within(up(2.0 * work));
        let rest = self.of_steps(&moved.steps);
        kinetic = kinetic + Interval { low: 0.0, high: rest };
        let quotient = kinetic * over;
        let residual = up(left / strain.low);
        let finite = residual.is_finite() && quotient.low.is_finite() && quotient.high.is_finite();
        finite.then_some(Energies { quotient, residual, strain })
    }

    /// Twice the strain energy, with that of supports, springs and bed.
    fn of_holds(&self, moved: &TrialMotion, mut strain: Interval) -> Interval {
        for (contact, value) in self.contacts.iter().zip(moved.held(&self.contacts)) {
            let stiffness = contact.stiffness.unwrap_or(ZERO);
            strain = strain + stiffness * Interval::point(value).square();
        }
        for k in self.in_bed() {
            let w = moved.cells[k][0].values(&GAUSS_24);
            let stiffness = self.bed.map_or(ZERO, |bed| bed.stiffness);
            strain = strain + stiffness * self.cells[k].half * w.product(&w).integral(&GAUSS_24);
        }
        strain
    }

    /// Twice the kinetic energy of a rigid motion.
    fn of_rigid(&self, [push, turn]: [Interval; 2]) -> Interval {
        let [mass, first, second] = self.gram;
        mass * push.square() + Interval::point(2.0) * first * push * turn + second * turn.square()
    }

    /// `|Pd|²` at most, of the motions of kinks and jumps: each lets one side of the bat turn or move and holds
    /// the other.
    fn of_steps(&self, steps: &[[f64; 2]]) -> f64 {
        let [mass, first, second] = self.gram;
        let mut sum = 0.0;
        for (border, [jump, kink]) in steps.iter().enumerate() {
            let arm = self.arm(border);
            // Less than if the whole bat turned about the border.
            let about = second - Interval::point(2.0) * first * arm + mass * arm.square();
            let turning = up(kink * about.sqrt().high);
            sum = up(sum + up(turning + up(jump * mass.sqrt().high)));
        }
        up(sum * sum)
    }

    /// Upper bounds of `Σ_e [∫(m − zEIχ)²/EI + ∫(V + zκGAγ)²/κGA] + Σ_springs (R_j − z k_j b_j)²/k_j`, with similar
    /// terms of compliant parts, and of `Σ (kink |m| + jump |V|)`.
    fn residual(&self, tried: &Tried, reactions: &[Interval]) -> (f64, f64) {
        let Tried { moved, loads, strains, z } = tried;
        let (mut sum, mut work) = (0.0, 0.0);
        for ((contact, reaction), value) in
            self.contacts.iter().zip(reactions).zip(moved.held(&self.contacts))
        {
            let Some(stiffness) = contact.stiffness else { continue };
            let off = *reaction - Interval::point(*z) * stiffness * Interval::point(value);
            sum = up(sum + up(off.square().high / stiffness.low));
        }
        let count = self.cells.len();
        // The term of the compliant part at a border, for the moment on a joint there.
        let given = |border: usize, moment: Interval, drift: [f64; 2]| {
            let here = self.masses.iter().filter(|mass| mass.border == border);
            here.fold(0.0, |sum, mass| up(sum + mass.residual(moved, moment, drift, *z)))
        };
        // Inwards from both ends, where V and m are 0.
        let mut at = [ZERO; 2];
        for k in 0..self.root {
            work = up(work + self.cross(moved, reactions, k, 1.0, &mut at));
            sum = up(sum + given(k, at[1], moved.drift_at(k, 1.0)));
            let (series, after) = from_left(self.cells[k].half, &loads[k], at);
            at = after;
            sum = up(sum + of_cell(&self.cells[k], &series, &strains[k], *z));
        }
        let _ = self.cross(moved, reactions, self.root, 1.0, &mut at);
        sum = up(sum + given(self.root, at[1], moved.drift_at(self.root, 1.0)));
        let left = at;
        at = [ZERO; 2];
        for k in (self.root..count).rev() {
            sum = up(sum + given(k + 1, at[1], moved.drift_at(k + 1, -1.0)));
            work = up(work + self.cross(moved, reactions, k + 1, -1.0, &mut at));
            let (series, before) = from_right(self.cells[k].half, &loads[k], at);
            at = before;
            sum = up(sum + of_cell(&self.cells[k], &series, &strains[k], *z));
        }
        // In equilibrium, V and m at the root are the same from both sides.
        let one = |k: usize| left[k].low <= at[k].high && at[k].low <= left[k].high;
        debug_assert!(!self.is_held() || one(0) && one(1) || !sum.is_finite());
        (sum, work)
    }

    /// Adds the steps of V and m at a border, due to masses (`V` by `μ w_a`, `m` by `−(d μ w_a + J θ)`) and contacts
    /// (`V` by `−R` for a deflection, `m` by `R` for a rotation). Returns upper bounds of the terms of kink and jump
    /// there, on either side of the steps.
    fn cross(
        &self,
        moved: &TrialMotion,
        reactions: &[Interval],
        border: usize,
        sign: f64,
        at: &mut [Interval; 2],
    ) -> f64 {
        let [jump, kink] = moved.steps[border];
        let worth = |[force, moment]: &[Interval; 2]| {
            up(up(kink * moment.largest()) + up(jump * force.largest()))
        };
        let outer = worth(at);
        let drift = moved.drift_at(border, sign);
        let sign = Interval::point(sign);
        for mass in self.masses.iter().filter(|mass| mass.border == border) {
            let [w, turn] = mass.drifting(moved, drift);
            let push = mass.mass * mass.at([w, turn], &moved.gives);
            at[0] = at[0] + sign * push;
            at[1] = at[1] - sign * (mass.offset * push + mass.inertia * turn);
        }
        for (contact, reaction) in self.contacts.iter().zip(reactions) {
            if contact.border == border {
                if contact.turning {
                    at[1] = at[1] + sign * *reaction;
                } else {
                    at[0] = at[0] - sign * *reaction;
                }
            }
        }
        outer.max(worth(at))
    }
}

impl BeamCell {
    /// Twice the strain energy of curvature and shear strain over half the length, `EIχ` and `κGAγ`.
    fn strained(&self, bend: &Series, slip: Option<Series>) -> (Interval, Along) {
        let gauss = &GAUSS_24;
        let bend = bend.values(gauss);
        let moment = self.bending.product(&bend);
        let mut own = moment.product(&bend).integral(gauss);
        let mut force = None;
        if let (Some(shear), Some(slip)) = (&self.shear, slip) {
            let slip = slip.values(gauss);
            let product = shear.values.product(&slip);
            let within = Interval::point(1.0) + Interval::within(shear.share);
            own = own + product.product(&slip).integral(gauss) * within;
            force = Some(Series::through(gauss, &product));
        }
        (own, (Series::through(gauss, &moment), force))
    }

    /// Twice the kinetic energy of a motion over half the length, `ρA w` and `ρI θ`; the motion itself is within that
    /// drift.
    fn carried(&self, [w, turn]: &[Series; 2], [off, turned_off]: [f64; 2]) -> (Interval, Along) {
        let gauss = &GAUSS_24;
        let w = w.values(gauss);
        let load = self.mass.product(&w);
        let mut own = load.product(&w).integral(gauss);
        let load = load.wider(self.mass.largest() * off);
        let mut couple = None;
        if let Some((turning, _)) = &self.turning {
            let turn = turn.values(gauss);
            let product = turning.product(&turn);
            own = own + product.product(&turn).integral(gauss);
            let product = product.wider(turning.largest() * turned_off);
            couple = Some(Series::through(gauss, &product));
        }
        (own, (Series::through(gauss, &load), couple))
    }
}

impl TrialMotion {
    /// Largest difference of the motion of the trial at a border, seen from the adjacent cell on the inside (towards
    /// the tip for `sign` 1): the drift of that cell and the step at the border.
    pub fn drift_at(&self, border: usize, sign: f64) -> [f64; 2] {
        let drift = self.drift[if sign > 0.0 { border } else { border - 1 }];
        std::array::from_fn(|i| up(drift[i] + self.steps[border][i]))
    }
}

impl Mass {
    /// Deflection and rotation of the trial's own motion at its border.
    fn drifting(&self, moved: &TrialMotion, drift: [f64; 2]) -> [Interval; 2] {
        let at = moved.borders[self.border];
        std::array::from_fn(|i| Interval::point(at[i]) + Interval::within(drift[i]))
    }

    /// Upper bound of the term of this compliant part in the residual, `(K (Tk) − z K s)²/K`.
    fn residual(&self, moved: &TrialMotion, moment: Interval, drift: [f64; 2], z: f64) -> f64 {
        let Some(Give { number, way, stiffness }) = self.give else { return 0.0 };
        let load = match way {
            YieldingPart::Joint => moment,
            YieldingPart::Hung => self.mass * self.at(self.drifting(moved, drift), &moved.gives),
        };
        let off = load - Interval::point(z) * stiffness * moved.gives[number];
        up(off.square().high / stiffness.low)
    }
}

/// V and m on a cell from their values at its left end, and their values at its right end.
pub fn from_left(
    half: Interval,
    (load, couple): &Along,
    [force, moment]: [Interval; 2],
) -> ([Series; 2], [Interval; 2]) {
    let shear = load.integrated().times(half).plus(force);
    let slope = couple.as_ref().map_or(shear, |couple| shear - *couple);
    let bend = slope.integrated().times(half).plus(moment);
    let after = [force + half * load.integral(), moment + half * slope.integral()];
    ([shear, bend], after)
}

/// V and m on a cell from their values at its right end, and their values at its left end.
pub fn from_right(
    half: Interval,
    (load, couple): &Along,
    [force, moment]: [Interval; 2],
) -> ([Series; 2], [Interval; 2]) {
    let before = force - half * load.integral();
    let shear = load.integrated().times(half).plus(before);
    let slope = couple.as_ref().map_or(shear, |couple| shear - *couple);
    let moment = moment - half * slope.integral();
    let bend = slope.integrated().times(half).plus(moment);
    ([shear, bend], [before, moment])
}

/// The part of a cell in the residual.
fn of_cell(cell: &BeamCell, [force, moment]: &[Series; 2], (bent, sheared): &Along, z: f64) -> f64 {
    let z = Interval::point(z);
    let left = (*moment - bent.times(z)).square_at_most();
    let mut sum = up(left / cell.bending_least);
    if let (Some(shear), Some(sheared)) = (&cell.shear, sheared) {
        let own = sheared.times(z);
        let root = up((*force + own).square_at_most().sqrt());
        let off = up(shear.share * up(own.square_at_most().sqrt()));
        let left = up(up(root + off) * up(root + off));
        sum = up(sum + up(left / shear.least));
    }
    up(cell.half.high * sum)
}
