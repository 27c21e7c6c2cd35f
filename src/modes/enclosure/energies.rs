//! How far may a trial's Rayleigh quotient be from an eigenvalue: its energies and its residual?
//!
//! `H` are pairs of strains, curvature χ and shear strain γ, with `(k, k) = ∫EI χ² + κGA γ² dx`. `S` integrates
//! them to the motion `(w, θ)` and takes the two rigid motions out, orthogonally in
//! `⟨·,·⟩ = ∫ρA w² + ρI θ² dx` and what the masses add. `T = S*S` has the eigenvalues `τ_n = 1/ω_n²`:
//!
//! ```text
//! V′ = ρA w,  m′ = V − ρI θ,  both 0 at both ends;       T k = (m/EI, −V/κGA)
//! ```
//!
//! Three numbers are known of a trial `k`, whatever it is:
//!
//! ```text
//! a₀ = (k, k)     a₁ = (k, Tk) = ⟨Sk, Sk⟩     σ = a₁/a₀
//! ε² = |Tk − σk|²/a₀ ≤ (1/a₀) Σ_e [∫(m − zEIχ)²/EI + ∫(V + zκGAγ)²/κGA],   z any number
//! ```
//!
//! for σ is the `z` for which the left side is least. Where κGA is within a share `β` of a polynomial `c`,
//! `‖V + zκGAγ‖ ≤ ‖V + zcγ‖ + β z ‖cγ‖`.

use crate::base::interval::tables::GAUSS_24;
use crate::base::interval::{Interval, Series, up};
use crate::modes::enclosure::beam::{Cell, Mass, Proven};

/// Strains of a motion as Legendre coefficients on every cell, taken to be exact.
#[derive(Debug, Clone, PartialEq)]
pub struct Trial {
    /// Number of coefficients on a cell.
    pub terms: usize,
    /// Curvature (1/m), cell by cell from knob to tip.
    pub bending: Vec<f64>,
    /// Shear strain likewise; empty of a theory without shear.
    pub shear: Vec<f64>,
}

/// What is proven of a trial.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Energies {
    /// σ (s²).
    pub quotient: Interval,
    /// ε² (s⁴), at most.
    pub residual: f64,
    /// `a₀` (J).
    pub strain: Interval,
}

/// A motion along the bat that is nearly that of a trial: begun anew with plain numbers on every cell.
///
/// A running sum carries its rounding along, and a small error of a rotation moves far what is far away, so
/// that the motion itself is known to `(kL)² u` only. Begun anew on every cell it has kinks and jumps at the
/// borders, each of a few `u`, instead. Their motions `d` make it that of the trial, `Sk = P(w + d)` with P the
/// rigid motions taken out, and what they add to the kinetic energy is
///
/// ```text
/// |P(w + d)|² − |Pw|² = 2 Σ (kink · m − jump · V) + |Pd|²
/// ```
///
/// with the moment and force of the inertia of `w` at the borders, where nothing is amplified.
pub struct Moved {
    /// Deflection and rotation on every cell, begun anew.
    pub cells: Vec<[Series; 2]>,
    /// Deflection and rotation at every border, where the cell beyond it begins.
    pub borders: Vec<[f64; 2]>,
    /// Jump (m) and kink (rad) at every border, at most.
    pub steps: Vec<[f64; 2]>,
    /// By how much deflection (m) and rotation (rad) of the trial's own motion may differ at most on every
    /// cell: kinks, jumps and rigid motion together.
    pub drift: Vec<[f64; 2]>,
    /// Rigid motion that is left in it: deflection where arms are counted from, and rotation.
    pub rigid: [Interval; 2],
}

impl Trial {
    fn bending_on(&self, cell: usize) -> Series {
        Series::exact(&self.bending[cell * self.terms..(cell + 1) * self.terms])
    }

    fn shear_on(&self, cell: usize) -> Option<Series> {
        self.shear.get(cell * self.terms..(cell + 1) * self.terms).map(Series::exact)
    }
}

const ZERO: Interval = Interval { low: 0.0, high: 0.0 };

impl Proven {
    /// What is proven of a trial; None of one without strain.
    pub fn energies(&self, trial: &Trial) -> Option<Energies> {
        let own = trial.terms * self.cells.len();
        let sheared = if self.theory.shears() { own } else { 0 };
        if trial.terms == 0 || trial.bending.len() != own || trial.shear.len() != sheared {
            return None;
        }
        let moved = self.moved(trial)?;
        let (mut strain, mut kinetic) = (ZERO, ZERO);
        let gauss = &GAUSS_24;
        let mut loads = Vec::with_capacity(self.cells.len());
        let mut strains = Vec::with_capacity(self.cells.len());
        for (k, cell) in self.cells.iter().enumerate() {
            let bend = trial.bending_on(k).values(gauss);
            let moment = cell.bending.product(&bend);
            let mut own = moment.product(&bend).integral(gauss);
            let mut force = None;
            if let (Some(shear), Some(slip)) = (&cell.shear, trial.shear_on(k)) {
                let slip = slip.values(gauss);
                let product = shear.values.product(&slip);
                let within = Interval::point(1.0) + Interval::within(shear.share);
                own = own + product.product(&slip).integral(gauss) * within;
                force = Some(Series::through(gauss, &product));
            }
            strain = strain + cell.half * own;
            strains.push((Series::through(gauss, &moment), force));
            let [w, turn] = &moved.cells[k];
            let [off, turned_off] = moved.drift[k];
            let w = w.values(gauss);
            let load = cell.mass.product(&w);
            let mut own = load.product(&w).integral(gauss);
            let load = load.wider(cell.mass.largest() * off);
            let mut couple = None;
            if let Some((turning, _)) = &cell.turning {
                let turn = turn.values(gauss);
                let product = turning.product(&turn);
                own = own + product.product(&turn).integral(gauss);
                let product = product.wider(turning.largest() * turned_off);
                couple = Some(Series::through(gauss, &product));
            }
            kinetic = kinetic + cell.half * own;
            loads.push((Series::through(gauss, &load), couple));
        }
        for mass in &self.masses {
            let [w, turn] = moved.borders[mass.border].map(Interval::point);
            let at = w + mass.offset * turn;
            kinetic = kinetic + mass.mass * at.square() + mass.inertia * turn.square();
        }
        let over = strain.reciprocal().filter(|over| over.low > 0.0)?;
        let z = (kinetic * over).middle();
        let (left, work) = self.residual(&moved, &loads, &strains, z);
        kinetic = kinetic - self.of_rigid(moved.rigid) + Interval::within(up(2.0 * work));
        let rest = self.of_steps(&moved.steps);
        kinetic = kinetic + Interval { low: 0.0, high: rest };
        let quotient = kinetic * over;
        let residual = up(left / strain.low);
        let finite = residual.is_finite() && quotient.low.is_finite() && quotient.high.is_finite();
        finite.then_some(Energies { quotient, residual, strain })
    }

    /// The motion of a trial, begun anew on every cell so that hardly any rigid motion is in it; any other
    /// beginning is as right, and wider.
    pub fn moved(&self, trial: &Trial) -> Option<Moved> {
        let first = self.integrated(trial, [0.0; 2]);
        let [push, turn] = self.rigid(&first)?.map(Interval::middle);
        let arm = (self.cells[self.root].middle - self.cells[self.root].half).middle();
        let mut moved = self.integrated(trial, [-(push + turn * arm), -turn]);
        moved.rigid = self.rigid(&moved)?;
        self.add_drift(&mut moved);
        Some(moved)
    }

    /// The arm of a border (m).
    fn arm(&self, border: usize) -> Interval {
        match self.cells.get(border) {
            Some(cell) => cell.middle - cell.half,
            None => self.cells[border - 1].middle + self.cells[border - 1].half,
        }
    }

    /// The cells outwards from the root, and whether that is towards the tip.
    fn outwards(&self) -> impl Iterator<Item = (usize, bool)> + use<> {
        let tip = (self.root..self.cells.len()).map(|k| (k, true));
        tip.chain((0..self.root).rev().map(|k| (k, false)))
    }

    /// `θ′ = χ`, `w′ = θ + γ` from these values at the root, outwards, on every cell from plain numbers.
    fn integrated(&self, trial: &Trial, start: [f64; 2]) -> Moved {
        let count = self.cells.len();
        let mut borders = vec![[0.0; 2]; count + 1];
        let mut steps = vec![[0.0; 2]; count + 1];
        borders[self.root] = start;
        let mut cells = vec![[Series::exact(&[]); 2]; count];
        for (k, tipwards) in self.outwards() {
            let half = self.cells[k].half;
            let bend = trial.bending_on(k);
            let turned = bend.integrated().times(half);
            let turns = half * bend.integral();
            // The slope less θ at the left end.
            let slope = match trial.shear_on(k) {
                Some(slip) => turned + slip,
                None => turned,
            };
            let lifted = slope.integrated().times(half);
            let lifts = half * slope.integral();
            let length = half + half;
            let (inner, outer) = if tipwards { (k, k + 1) } else { (k + 1, k) };
            let [w, theta] = borders[inner].map(Interval::point);
            let (line, end) = match tipwards {
                true => ([w, theta], [w + length * theta + lifts, theta + turns]),
                false => {
                    let theta = theta - turns;
                    let w = w - length * theta - lifts;
                    ([w, theta], [w, theta])
                }
            };
            borders[outer] = end.map(Interval::middle);
            steps[outer] = std::array::from_fn(|i| end[i].distance(borders[outer][i]));
            let [w, theta] = line;
            let line = Series::of(&[w + half * theta, half * theta]);
            cells[k] = [lifted + line, turned.plus(theta)];
        }
        Moved { cells, borders, steps, drift: vec![], rigid: [ZERO; 2] }
    }

    /// Bounds of [`Moved::drift`] from kinks, jumps and the rigid motion.
    fn add_drift(&self, moved: &mut Moved) {
        let [push, turn] = moved.rigid;
        let mut sums = [[0.0_f64; 2]; 2];
        moved.drift = vec![[0.0; 2]; self.cells.len()];
        for (k, tipwards) in self.outwards() {
            let side = &mut sums[usize::from(tipwards)];
            let inner = if tipwards { k } else { k + 1 };
            let [jump, kink] = if inner == self.root { [0.0; 2] } else { moved.steps[inner] };
            side[1] = up(side[1] + kink);
            side[0] = up(up(side[0] + jump) + up(2.0 * self.cells[k].half.high * side[1]));
            moved.drift[k] = *side;
        }
        let [own, turned] = self.rigid_of(moved.drift.iter());
        for (cell, drift) in self.cells.iter().zip(&mut moved.drift) {
            let arm = cell.middle + cell.half * Interval::within(1.0);
            let rigid = up((push + turn * arm).largest() + up(own + up(turned * arm.largest())));
            *drift = [up(drift[0] + rigid), up(drift[1] + up(turn.largest() + turned))];
        }
    }

    /// The rigid motion at most (m where arms are counted from, and rad) in a motion that deflects and turns no cell
    /// by more than these: by Cauchy's inequality `∫ρA |y| ≤ (M ∫ρA y²)^½`.
    fn rigid_of<'a>(&self, drift: impl Iterator<Item = &'a [f64; 2]>) -> [f64; 2] {
        let most =
            drift.fold([0.0_f64; 2], |most, drift| [most[0].max(drift[0]), most[1].max(drift[1])]);
        let offset = self.masses.iter().map(|mass| mass.offset.largest()).fold(0.0, f64::max);
        let moved = Interval::point(up(most[0] + up(offset * most[1])));
        let turned = Interval::point(most[1]);
        let [mass, first, second] = self.gram;
        let force = mass * moved;
        let moment = (mass * second).sqrt() * moved + second * turned;
        let over = (mass * second - first.square()).reciprocal();
        let over = over.filter(|over| over.low > 0.0).unwrap_or(Interval::within(f64::INFINITY));
        let first = Interval::point(first.largest());
        [
            ((second * force + first * moment) * over).largest(),
            ((mass * moment + first * force) * over).largest(),
        ]
    }

    /// The rigid motion in a motion: deflection where arms are counted from, and rotation.
    fn rigid(&self, moved: &Moved) -> Option<[Interval; 2]> {
        let (mut force, mut moment) = (ZERO, ZERO);
        for (cell, [w, turn]) in self.cells.iter().zip(&moved.cells) {
            let [mass, first] = &cell.mass_series;
            force = force + cell.half * mass.inner(w);
            moment = moment + cell.half * first.inner(w);
            if let Some((_, turning)) = &cell.turning {
                moment = moment + cell.half * turning.inner(turn);
            }
        }
        for Mass { border, mass, inertia, offset, arm } in &self.masses {
            let [w, turn] = moved.borders[*border].map(Interval::point);
            let push = *mass * (w + *offset * turn);
            force = force + push;
            moment = moment + push * (*arm + *offset) + *inertia * turn;
        }
        let [mass, first, second] = self.gram;
        let over = (mass * second - first.square()).reciprocal().filter(|over| over.low > 0.0)?;
        Some([(second * force - first * moment) * over, (mass * moment - first * force) * over])
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

    /// `Σ_e [∫(m − zEIχ)²/EI + ∫(V + zκGAγ)²/κGA]` and `Σ (kink |m| + jump |V|)` at most; of every cell ρA w, ρI
    /// θ, EI χ and κGA γ are given.
    fn residual(
        &self,
        moved: &Moved,
        loads: &[(Series, Option<Series>)],
        strains: &[(Series, Option<Series>)],
        z: f64,
    ) -> (f64, f64) {
        let (mut sum, mut work) = (0.0, 0.0);
        let count = self.cells.len();
        // Inwards from both ends, where V and m are 0.
        let mut at = [ZERO; 2];
        for k in 0..self.root {
            work = up(work + self.cross(moved, k, 1.0, &mut at));
            let (series, after) = from_left(&self.cells[k], &loads[k], at);
            at = after;
            sum = up(sum + of_cell(&self.cells[k], &series, &strains[k], z));
        }
        at = [ZERO; 2];
        for k in (self.root..count).rev() {
            work = up(work + self.cross(moved, k + 1, -1.0, &mut at));
            let (series, before) = from_right(&self.cells[k], &loads[k], at);
            at = before;
            sum = up(sum + of_cell(&self.cells[k], &series, &strains[k], z));
        }
        (sum, work)
    }

    /// Steps of V and m over the masses at a border, `V` by `μ w_a`, `m` by `−(d μ w_a + J θ)`; returns what kink
    /// and jump there are worth at most, on either side of the masses.
    fn cross(&self, moved: &Moved, border: usize, sign: f64, at: &mut [Interval; 2]) -> f64 {
        let [jump, kink] = moved.steps[border];
        let worth = |[force, moment]: &[Interval; 2]| {
            up(up(kink * moment.largest()) + up(jump * force.largest()))
        };
        let outer = worth(at);
        let sign = Interval::point(sign);
        // What the cell inside of the border drifts, and the step at the border.
        let drift = moved.drift[if sign.low > 0.0 { border } else { border - 1 }];
        let drift: [f64; 2] = std::array::from_fn(|i| up(drift[i] + moved.steps[border][i]));
        for mass in self.masses.iter().filter(|mass| mass.border == border) {
            let off = |i: usize| Interval::within(drift[i]);
            let [w, turn] = moved.borders[border].map(Interval::point);
            let [w, turn] = [w + off(0), turn + off(1)];
            let push = mass.mass * (w + mass.offset * turn);
            at[0] = at[0] + sign * push;
            at[1] = at[1] - sign * (mass.offset * push + mass.inertia * turn);
        }
        outer.max(worth(at))
    }
}

/// V and m on a cell from their values at its left end, and their values at its right end.
fn from_left(
    cell: &Cell,
    (load, couple): &(Series, Option<Series>),
    [force, moment]: [Interval; 2],
) -> ([Series; 2], [Interval; 2]) {
    let shear = load.integrated().times(cell.half).plus(force);
    let slope = couple.as_ref().map_or(shear, |couple| shear - *couple);
    let bend = slope.integrated().times(cell.half).plus(moment);
    let after = [force + cell.half * load.integral(), moment + cell.half * slope.integral()];
    ([shear, bend], after)
}

/// V and m on a cell from their values at its right end, and their values at its left end.
fn from_right(
    cell: &Cell,
    (load, couple): &(Series, Option<Series>),
    [force, moment]: [Interval; 2],
) -> ([Series; 2], [Interval; 2]) {
    let before = force - cell.half * load.integral();
    let shear = load.integrated().times(cell.half).plus(before);
    let slope = couple.as_ref().map_or(shear, |couple| shear - *couple);
    let moment = moment - cell.half * slope.integral();
    let bend = slope.integrated().times(cell.half).plus(moment);
    ([shear, bend], [before, moment])
}

/// The part of a cell in the residual.
fn of_cell(
    cell: &Cell,
    [force, moment]: &[Series; 2],
    (bent, sheared): &(Series, Option<Series>),
    z: f64,
) -> f64 {
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
