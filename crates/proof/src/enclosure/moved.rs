//! Which motion has the strains of a trial?
//!
//! The motion of a free bat is that of its strains, with the two rigid motions removed ([`TrialMotion`]).
//!
//! The motion of a held bat passes through plain numbers `(w_k, θ_k)` at the borders of cells: 0 at supports, the
//! values of the trial at springs, the sums of its strains elsewhere. The first two Legendre coefficients of the
//! curvature on a cell of half length `h` are then
//!
//! ```text
//! c_0 = (θ_{k+1} − θ_k)/2h,    c_1 = (3/h) [(θ_k + θ_{k+1})/2 + d_0 − (w_{k+1} − w_k)/2h]
//! ```
//!
//! with the mean shear strain `d_0`, because `∫∫P_0 = 2`, `∫∫P_1 = −2/3`, and the double integral of all others is 0.
//! The motion is therefore continuous, satisfies every support exactly, and its strains are known to a few units in the
//! last place.

use crate::enclosure::beam::{Mass, Proven};
use crate::enclosure::contacts::Contact;
use crate::enclosure::gives::kink;
use crate::series::Series;
use sweetspot::base::interval::{Interval, up};
use sweetspot::base::linear::solve_two;

/// Strains of a motion as Legendre coefficients on every cell, taken to be exact.
#[derive(Debug, Clone, PartialEq)]
pub struct Trial {
    /// Number of coefficients on a cell.
    pub terms: usize,
    /// Curvature (1/m), cell by cell from knob to tip.
    pub bending: Vec<f64>,
    /// Shear strain likewise; empty of a theory without shear.
    pub shear: Vec<f64>,
    /// Deflection (m) or rotation (rad) at each contact. At a support it is 0, regardless of the value here.
    pub held: Vec<f64>,
    /// Deflections (m) at both ends of the bed, if there is one.
    pub bed: [f64; 2],
    /// Kinks of joints (rad), then stretches of the springs that masses hang on (m), in the order of the bat's file.
    pub gives: Vec<f64>,
}

/// A motion along the bat close to that of a trial, restarted with plain numbers on every cell.
///
/// A running sum accumulates rounding, and a small error of a rotation causes large deflections far away, so that the
/// motion itself is known only to `(kL)² u`. Restarted on every cell, it instead has kinks and jumps of a few `u` at
/// the borders. Adding their motions `d` gives the motion of the trial, `Sk = P(w + d)`, where P removes the rigid
/// motions. Their contribution to the kinetic energy is
///
/// ```text
/// |P(w + d)|² − |Pw|² = 2 Σ (kink · m − jump · V) + |Pd|²
/// ```
///
/// with the moment and force of the inertia of `w` at the borders, which amplifies nothing.
///
/// For a held bat the motion is that of the trial itself, without steps, drift or removed rigid motion.
pub struct TrialMotion {
    /// Curvature on every cell.
    pub bending: Vec<Series>,
    /// Deflection and rotation on every cell, begun anew.
    pub cells: Vec<[Series; 2]>,
    /// Deflection and rotation at every border, on the knob side of a joint.
    pub borders: Vec<[f64; 2]>,
    /// Kinks of joints (rad) and stretches of springs (m), of the trial.
    pub gives: Vec<Interval>,
    /// Jump (m) and kink (rad) at every border, at most.
    pub steps: Vec<[f64; 2]>,
    /// Largest difference of deflection (m) and rotation (rad) of the motion of the trial on every cell, due to kinks,
    /// jumps and rigid motion.
    pub drift: Vec<[f64; 2]>,
    /// Remaining rigid motion: deflection at the origin of the arms, and rotation.
    pub rigid: [Interval; 2],
}

/// A quantity of the deflection along a cell, and its counterpart of rotation or shear.
pub type Along = (Series, Option<Series>);

/// The motion of a trial, with the quantities derived from it along the bat.
pub struct Tried {
    /// The motion.
    pub moved: TrialMotion,
    /// ρA w, and ρI θ where sections turn, on every cell.
    pub loads: Vec<Along>,
    /// EI χ, and κGA γ in a theory with shear, on every cell.
    pub strains: Vec<Along>,
    /// A number near its Rayleigh quotient (s²).
    pub z: f64,
}

impl Trial {
    /// The curvature on a cell.
    pub fn bending_on(&self, cell: usize) -> Series {
        Series::exact(&self.bending[cell * self.terms..(cell + 1) * self.terms])
    }

    /// The shear strain on a cell.
    pub fn shear_on(&self, cell: usize) -> Option<Series> {
        self.shear.get(cell * self.terms..(cell + 1) * self.terms).map(Series::exact)
    }
}

impl TrialMotion {
    /// Deflection or rotation at each of these contacts.
    pub fn held(&self, contacts: &[Contact]) -> impl Iterator<Item = f64> {
        contacts.iter().map(|contact| self.borders[contact.border][usize::from(contact.turning)])
    }
}

const ZERO: Interval = Interval { low: 0.0, high: 0.0 };

impl Proven {
    /// The motion of a trial, restarted on every cell so that it contains hardly any rigid motion. Other starting
    /// values would also be correct but give wider intervals.
    pub fn moved(&self, trial: &Trial) -> Option<TrialMotion> {
        if self.is_held() {
            return self.held(trial);
        }
        let first = self.integrated(trial, [0.0; 2]);
        let [push, turn] = self.rigid(&first)?.map(Interval::middle);
        let arm = self.cells[self.root].begin().middle();
        let mut moved = self.integrated(trial, [-(push + turn * arm), -turn]);
        moved.rigid = self.rigid(&moved)?;
        self.add_drift(&mut moved);
        Some(moved)
    }

    /// The motion of a held bat.
    fn held(&self, trial: &Trial) -> Option<TrialMotion> {
        if trial.terms < 2 || trial.held.len() != self.contacts.len() {
            return None;
        }
        let value = |k: usize| self.contacts[k].stiffness.map_or(0.0, |_| trial.held[k]);
        let rest = self.integrated(trial, [0.0; 2]);
        // The rigid motion is determined by rotation or deflection at two borders.
        let known = match (self.base, self.bed) {
            (Some(pair), _) => pair.map(|k| {
                let Contact { border, turning, .. } = self.contacts[k];
                (border, turning, value(k))
            }),
            (None, Some(bed)) => [0, 1].map(|end| (bed.borders[end], false, trial.bed[end])),
            (None, None) => return None,
        };
        let rows = known.map(|(border, turning, _)| match turning {
            true => [0.0, 1.0],
            false => [1.0, self.arm(border).middle()],
        });
        let off = known
            .map(|(border, turning, value)| value - rest.borders[border][usize::from(turning)]);
        let [push, turn] = solve_two(rows, off);
        let root = self.arm(self.root).middle();
        let mut moved = self.integrated(trial, [push + turn * root, turn]);
        // Supports last: where a spring is at the same place, it is not moved either.
        let (supports, springs): (Vec<usize>, Vec<usize>) =
            (0..self.contacts.len()).partition(|k| self.contacts[*k].stiffness.is_none());
        for k in springs.into_iter().chain(supports) {
            let contact = &self.contacts[k];
            moved.borders[contact.border][usize::from(contact.turning)] = value(k);
        }
        if !moved.borders.iter().flatten().all(|value| value.is_finite()) {
            return None;
        }
        moved.steps.fill([0.0; 2]);
        moved.drift = vec![[0.0; 2]; self.cells.len()];
        for k in 0..self.cells.len() {
            (moved.bending[k], moved.cells[k]) = self.between_borders(trial, k, &moved);
        }
        Some(moved)
    }

    /// The curvature on a cell that connects the values at its left border with those at its right border, and the
    /// motion.
    fn between_borders(
        &self,
        trial: &Trial,
        k: usize,
        moved: &TrialMotion,
    ) -> (Series, [Series; 2]) {
        let half = self.cells[k].half;
        let over = half.reciprocal().expect("cells have a length");
        let [[w, theta], [w_end, theta_end]] =
            [moved.borders[k], moved.borders[k + 1]].map(|border| border.map(Interval::point));
        let theta = theta + self.kink(k, &moved.gives);
        let by_half = Interval::point(0.5);
        let slip = trial.shear_on(k);
        let own = slip.map_or(ZERO, |slip| Interval::point(slip.coefficient(0)));
        let turns = by_half * (theta_end - theta) * over;
        let slopes = by_half * (theta + theta_end) + own - by_half * (w_end - w) * over;
        let strains = &trial.bending[k * trial.terms..(k + 1) * trial.terms];
        let mut all: Vec<Interval> = strains.iter().copied().map(Interval::point).collect();
        (all[0], all[1]) = (turns, Interval::point(3.0) * slopes * over);
        let bending = Series::of(&all);
        let turn = bending.integrated().times(half).plus(theta);
        let slope = slip.map_or(turn, |slip| turn + slip);
        (bending, [slope.integrated().times(half).plus(w), turn])
    }

    /// The arm of a border (m).
    pub fn arm(&self, border: usize) -> Interval {
        match self.cells.get(border) {
            Some(cell) => cell.begin(),
            None => self.cells[border - 1].middle + self.cells[border - 1].half,
        }
    }

    /// The kink of the bat at a border (rad), for these strains of the compliant parts.
    fn kink(&self, border: usize, gives: &[Interval]) -> Interval {
        let there = self.masses.iter().filter(|mass| mass.border == border);
        there.fold(ZERO, |sum, mass| sum + kink(mass.give, gives))
    }

    /// The cells outwards from the root, and whether that is towards the tip.
    fn outwards(&self) -> impl Iterator<Item = (usize, bool)> + use<> {
        let tip = (self.root..self.cells.len()).map(|k| (k, true));
        tip.chain((0..self.root).rev().map(|k| (k, false)))
    }

    /// `θ′ = χ`, `w′ = θ + γ` from these values at the root, outwards, on every cell from plain numbers.
    fn integrated(&self, trial: &Trial, start: [f64; 2]) -> TrialMotion {
        let count = self.cells.len();
        let gives: Vec<Interval> = trial.gives.iter().copied().map(Interval::point).collect();
        let mut borders = vec![[0.0; 2]; count + 1];
        let mut steps = vec![[0.0; 2]; count + 1];
        borders[self.root] = start;
        let mut cells = vec![[Series::exact(&[]); 2]; count];
        for (k, tipwards) in self.outwards() {
            let half = self.cells[k].half;
            let bend = trial.bending_on(k);
            let turned = bend.integrated().times(half);
            let turns = half * bend.integral();
            // Slope minus θ at the left end.
            let slope = match trial.shear_on(k) {
                Some(slip) => turned + slip,
                None => turned,
            };
            let lifted = slope.integrated().times(half);
            let lifts = half * slope.integral();
            let length = half + half;
            let (inner, outer) = if tipwards { (k, k + 1) } else { (k + 1, k) };
            let [w, theta] = borders[inner].map(Interval::point);
            let kink = self.kink(k, &gives);
            let (line, end) = if tipwards {
                let theta = theta + kink;
                ([w, theta], [w + length * theta + lifts, theta + turns])
            } else {
                let theta = theta - turns;
                let w = w - length * theta - lifts;
                ([w, theta], [w, theta - kink])
            };
            borders[outer] = end.map(Interval::middle);
            steps[outer] = std::array::from_fn(|i| end[i].distance(borders[outer][i]));
            let [w, theta] = line;
            let line = Series::of(&[w + half * theta, half * theta]);
            cells[k] = [lifted + line, turned.plus(theta)];
        }
        let bending = (0..count).map(|k| trial.bending_on(k)).collect();
        TrialMotion { bending, cells, borders, gives, steps, drift: vec![], rigid: [ZERO; 2] }
    }

    /// Bounds of [`TrialMotion::drift`] from kinks, jumps and the rigid motion.
    fn add_drift(&self, moved: &mut TrialMotion) {
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
        // A mass on an end of the bat also moves by the step there.
        let ends = [moved.drift_at(0, 1.0), moved.drift_at(self.cells.len(), -1.0)];
        let [own, turned] = self.rigid_of(moved.drift.iter().chain(&ends));
        for (cell, drift) in self.cells.iter().zip(&mut moved.drift) {
            let arm = cell.middle + cell.half * Interval::within(1.0);
            let rigid = up((push + turn * arm).largest() + up(own + up(turned * arm.largest())));
            *drift = [up(drift[0] + rigid), up(drift[1] + up(turn.largest() + turned))];
        }
    }

    /// Upper bound of the rigid motion (m at the origin of the arms, and rad) in a motion that deflects and rotates no
    /// cell by more than these: by Cauchy's inequality `∫ρA |y| ≤ (M ∫ρA y²)^½`.
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

    /// The rigid part of a motion: deflection at the origin of the arms, and rotation.
    fn rigid(&self, moved: &TrialMotion) -> Option<[Interval; 2]> {
        let [force, moment] = self.inertia(moved);
        let [mass, first, second] = self.gram;
        let over = (mass * second - first.square()).reciprocal().filter(|over| over.low > 0.0)?;
        Some([(second * force - first * moment) * over, (mass * moment - first * force) * over])
    }

    /// The resultants of the inertia of a motion: force, and moment about the origin of the arms.
    pub fn inertia(&self, moved: &TrialMotion) -> [Interval; 2] {
        let (mut force, mut moment) = (ZERO, ZERO);
        for (cell, [w, turn]) in self.cells.iter().zip(&moved.cells) {
            let [mass, first] = &cell.mass_series;
            force = force + cell.half * mass.inner(w);
            moment = moment + cell.half * first.inner(w);
            if let Some((_, turning)) = &cell.turning {
                moment = moment + cell.half * turning.inner(turn);
            }
        }
        for mass in &self.masses {
            let Mass { inertia, offset, arm, .. } = *mass;
            let [w, turn] = moved.borders[mass.border].map(Interval::point);
            let push = mass.mass * mass.at([w, turn], &moved.gives);
            force = force + push;
            moment = moment + push * (arm + offset) + inertia * turn;
        }
        [force, moment]
    }
}
