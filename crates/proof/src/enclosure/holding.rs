//! How far do supports, springs and a bed reduce trace and norm of the compliance of the free bat?
//!
//! Let `G` map loads to deflections of the free bat, with rigid motions removed from both, `M` be its mass, `R` the two
//! rigid motions, and `b_j` the loads of unit reactions. Under loads `f` the held bat moves by `y = G(f − Bρ) − R r`,
//! where the loads `f − Bρ` are in equilibrium and every contact satisfies `b_j(y) = s_j ρ_j`, with the softness
//! `s_j = 1/k_j` of its spring, or 0 for a support:
//!
//! ```text
//! K (ρ, r) = Φ* f,    K = [B*GB + s, B*R; R*B, 0],    Φ = [GB, R],    y = G f − Φ K⁻¹ Φ* f
//! trace T = trace(MG) − tr(K⁻¹ W),                     W  = Φ*MΦ   = diag(⟨Gb_i, Gb_j⟩, R*MR)
//! |T|² = |MG|² − 2 tr(K⁻¹ W₂) + tr(K⁻¹ W K⁻¹ W),       W₂ = Φ*MGMΦ = diag((T n_i, T n_j), 0)
//! ```
//!
//! because `GMR = 0` and `R*MG = 0`. With the strains `n_j` of the free bat under a unit reaction in equilibrium with
//! its inertia, `B*GB = (n_i, n_j)` and `⟨Gb_i, Gb_j⟩ = ⟨S n_i, S n_j⟩`. All is computed in intervals for the beam of
//! [`super::stretches`], whose integrands are polynomials; the computation includes a proof that K has an inverse.
//! Derived here, and compared with closed forms in the tests.
//!
//! For a bed of length ℓ the first few Legendre coefficients of its deflection are restrained,
//! `c_j = (2j + 1)/ℓ ∫w P_j dx` by springs `k ℓ/(2j + 1)`. By Bessel's inequality this restrains no more than the bed
//! itself, so that no `τ_n` is less than that of the bat.

use crate::enclosure::contacts::{Bed, Contact};
use crate::enclosure::energies::{from_left, from_right};
use crate::enclosure::gives::{Give, YieldingPart, kink, softness, stretch};
use crate::enclosure::moved::Along;
use crate::enclosure::stretches::{Met, Rigid, Stretch};
use crate::gauss::GAUSS_40;
use crate::series::{Series, Values};
use sweetspot::base::Interval;

/// Number of restrained Legendre coefficients of the deflection of a bed.
pub const OF_A_BED: usize = 8;

/// One restrained quantity of a motion.
#[derive(Debug, Clone, Copy)]
pub enum Hold {
    /// A contact's.
    Place(Contact),
    /// A Legendre coefficient of the deflection on the bed.
    Bed(Bed, usize),
}

/// The stretches of a bat with the attached parts.
pub struct Holding<'a> {
    /// From knob to tip.
    pub stretches: &'a [Stretch],
    /// By rising border.
    pub masses: &'a [Met],
    /// The border that sums run outwards from.
    pub split: usize,
    /// The bat as a rigid body, with positions from the knob.
    pub rigid: &'a Rigid,
}

/// Deflection and rotation along the stretches and at their borders, there on the knob side of joints.
struct HeldMotion {
    cells: Vec<[Series; 2]>,
    borders: Vec<[Interval; 2]>,
    /// The strains of the compliant parts.
    gives: Vec<Interval>,
}

/// Loads along the stretches, and steps of V and m at borders.
struct HeldLoads {
    cells: Vec<Along>,
    steps: Vec<[Interval; 2]>,
    /// The force on every mass (N).
    masses: Vec<Interval>,
}

/// V and m on every stretch.
struct Forces {
    cells: Vec<[Series; 2]>,
    /// Moment on a joint or force on a mass on a spring, by the number of the compliant part.
    gives: Vec<Interval>,
}
type IntervalMatrix = Vec<Vec<Interval>>;

const ZERO: Interval = Interval { low: 0.0, high: 0.0 };
/// Two polynomials of this degree and one of degree 12 are integrated exactly.
const DEGREE: usize = 33;

fn point(value: f64) -> Interval {
    Interval::point(value)
}

impl Holding<'_> {
    /// Decrease of `Σ τ_n` and `Σ τ_n²` due to the contacts; None where it is not certain that they hold the bat.
    pub fn less(&self, holds: &[Hold]) -> Option<[Interval; 2]> {
        let forces: Vec<Forces> = holds.iter().map(|hold| self.unit(hold)).collect();
        let motions: Vec<HeldMotion> = forces.iter().map(|forces| self.motion(forces)).collect();
        let again: Vec<Forces> =
            motions.iter().map(|motion| self.forces(&self.inertia(motion))).collect();
        let (count, size) = (holds.len(), holds.len() + 2);
        let zero = || vec![vec![ZERO; size]; size];
        let [mut k, mut w, mut w2] = [zero(), zero(), zero()];
        for i in 0..count {
            for j in 0..count {
                k[i][j] = self.strain_energy(&forces[i], &forces[j]);
                w[i][j] = self.kinetic_energy(&motions[i], &motions[j]);
                w2[i][j] = self.strain_energy(&again[i], &again[j]);
            }
            if let Some(stiffness) = self.stiffness(&holds[i]) {
                k[i][i] = k[i][i] + stiffness.reciprocal()?;
            }
            for (r, entry) in self.of_rigid(&holds[i]).into_iter().enumerate() {
                (k[i][count + r], k[count + r][i]) = (entry, entry);
            }
        }
        w[count][count] = self.rigid.over_mass.reciprocal()?;
        w[count + 1][count + 1] = self.rigid.over_inertia.reciprocal()?;
        let columns = w.into_iter().zip(w2).map(|(a, b)| [a, b].concat()).collect();
        let solved = solved(k, columns)?;
        let (mut trace, mut first, mut second) = (ZERO, ZERO, ZERO);
        for i in 0..size {
            trace = trace + solved[i][i];
            first = first + solved[i][size + i];
            second = second + (0..size).map(|j| solved[i][j] * solved[j][i]).sum::<Interval>();
        }
        Some([trace, first + first - second])
    }

    /// Position of a border (m).
    fn place(&self, border: usize) -> Interval {
        self.stretches.get(border).map_or(self.rigid.length, Stretch::begin)
    }

    /// The compliant parts, with their masses.
    fn gives(&self) -> impl Iterator<Item = (usize, &Met, Give)> {
        let all = self.masses.iter().enumerate();
        all.filter_map(|(k, mass)| mass.give.map(|give| (k, mass, give)))
    }

    /// How far a mass's centre is moved (m).
    fn moved(&self, mass: &Met, motion: &HeldMotion) -> Interval {
        let [w, turn] = motion.borders[mass.before];
        w + self.offset(mass) * turn + stretch(mass.give, &motion.gives)
    }

    /// The mass's centre beyond its border (m).
    fn offset(&self, mass: &Met) -> Interval {
        mass.centre - self.place(mass.before)
    }

    /// Stiffness of the spring that holds (N/m or N m/rad); None of a support.
    fn stiffness(&self, hold: &Hold) -> Option<Interval> {
        match hold {
            Hold::Place(contact) => contact.stiffness,
            Hold::Bed(bed, term) => {
                let share = point((2 * term + 1) as f64).reciprocal()?;
                Some(bed.stiffness * self.length(bed) * share)
            }
        }
    }

    /// The restrained quantity for the two rigid motions, `(1, 0)` and `(x − x_b, 1)`: force and moment of a unit
    /// reaction.
    fn of_rigid(&self, hold: &Hold) -> [Interval; 2] {
        match hold {
            Hold::Place(Contact { turning: true, .. }) => [ZERO, point(1.0)],
            Hold::Place(contact) => [point(1.0), self.place(contact.border) - self.rigid.balance],
            Hold::Bed(bed, 0) => [point(1.0), self.middle(bed) - self.rigid.balance],
            Hold::Bed(bed, 1) => [ZERO, point(0.5) * self.length(bed)],
            Hold::Bed(..) => [ZERO; 2],
        }
    }

    /// V and m of the free bat under a unit reaction, in balance with the inertia of the rigid motion that it
    /// makes.
    fn unit(&self, hold: &Hold) -> Forces {
        let Rigid { over_mass, over_inertia, .. } = *self.rigid;
        let [push, turn] = self.of_rigid(hold);
        let mut loads = self.inertia(&self.line(-push * over_mass, -turn * over_inertia));
        match hold {
            Hold::Place(contact) => {
                let [force, moment] = &mut loads.steps[contact.border];
                match contact.turning {
                    false => *force = *force + point(1.0),
                    true => *moment = *moment - point(1.0),
                }
            }
            Hold::Bed(bed, term) => {
                for k in bed.borders[0]..bed.borders[1] {
                    loads.cells[k].0 = loads.cells[k].0 + self.on_bed(bed, *term, k);
                }
            }
        }
        self.forces(&loads)
    }

    /// Length of the bed (m).
    fn length(&self, bed: &Bed) -> Interval {
        self.place(bed.borders[1]) - self.place(bed.borders[0])
    }

    /// The middle of the bed (m).
    fn middle(&self, bed: &Bed) -> Interval {
        point(0.5) * (self.place(bed.borders[0]) + self.place(bed.borders[1]))
    }

    /// `(2j + 1)/ℓ P_j` of the bed, on one of its stretches.
    fn on_bed(&self, bed: &Bed, term: usize, stretch: usize) -> Series {
        let gauss = &GAUSS_40;
        let over = self.length(bed).reciprocal().unwrap_or(Interval::within(f64::INFINITY));
        let Stretch { middle, half, .. } = &self.stretches[stretch];
        let along = [(*middle - self.middle(bed)) * (over + over), *half * (over + over)];
        let xi = Series::of(&along).values(gauss);
        let (mut before, mut own) = (Values::constant(ZERO), Values::constant(point(1.0)));
        // `(j + 1) P_{j+1} = (2j + 1) ξ P_j − j P_{j−1}`.
        for j in 0..term {
            let next = xi.product(&own).times(point((2 * j + 1) as f64));
            let next = next.difference(&before.times(point(j as f64)));
            let share = point((j + 1) as f64).reciprocal().expect("not 0");
            (before, own) = (own, next.times(share));
        }
        Series::through(gauss, &own.times(point((2 * term + 1) as f64) * over))
    }

    /// A rigid motion: deflection of the balance point, and rotation.
    fn line(&self, push: Interval, turn: Interval) -> HeldMotion {
        let balance = self.rigid.balance;
        let at = |x: Interval| push + turn * (x - balance);
        let cell = |stretch: &Stretch| {
            [Series::of(&[at(stretch.middle), turn * stretch.half]), Series::of(&[turn])]
        };
        let borders = (0..=self.stretches.len()).map(|border| [at(self.place(border)), turn]);
        HeldMotion {
            cells: self.stretches.iter().map(cell).collect(),
            borders: borders.collect(),
            gives: vec![ZERO; self.gives().count()],
        }
    }

    /// `ρA w`, `ρI θ`, and the steps that masses make: V by `μ w_c`, m by `−(d μ w_c + J θ)`.
    fn inertia(&self, motion: &HeldMotion) -> HeldLoads {
        let gauss = &GAUSS_40;
        let load = |(stretch, [w, turn]): (&Stretch, &[Series; 2])| {
            let load = Series::through(gauss, &stretch.mass.product(&w.values(gauss)));
            let couple = stretch
                .turning
                .as_ref()
                .map(|turning| Series::through(gauss, &turning.product(&turn.values(gauss))));
            (load, couple)
        };
        let cells = self.stretches.iter().zip(&motion.cells).map(load).collect();
        let mut steps = vec![[ZERO; 2]; self.stretches.len() + 1];
        let mut masses = Vec::with_capacity(self.masses.len());
        for mass in self.masses {
            let push = mass.mass * self.moved(mass, motion);
            let turn = motion.borders[mass.before][1];
            let [force, moment] = &mut steps[mass.before];
            *force = *force + push;
            *moment = *moment - (self.offset(mass) * push + mass.inertia * turn);
            masses.push(push);
        }
        HeldLoads { cells, steps, masses }
    }

    /// V and m under loads in balance, from 0 at both ends.
    fn forces(&self, loads: &HeldLoads) -> Forces {
        let (mut left, mut right) = (vec![], vec![]);
        // On the tip side of every border, where joints are.
        let mut moments = vec![ZERO; self.stretches.len() + 1];
        let mut at = [ZERO; 2];
        for k in 0..self.split {
            let steps = loads.steps[k];
            at = [at[0] + steps[0], at[1] + steps[1]];
            moments[k] = at[1];
            let (forces, after) = from_left(self.stretches[k].half, &loads.cells[k], at);
            left.push(forces);
            at = after;
        }
        at = [ZERO; 2];
        for k in (self.split..self.stretches.len()).rev() {
            let steps = loads.steps[k + 1];
            moments[k + 1] = at[1];
            at = [at[0] - steps[0], at[1] - steps[1]];
            let (forces, before) = from_right(self.stretches[k].half, &loads.cells[k], at);
            right.push(forces);
            at = before;
        }
        moments[self.split] = at[1];
        left.extend(right.into_iter().rev());
        let mut gives = vec![ZERO; self.gives().count()];
        for (k, mass, Give { number, way, .. }) in self.gives() {
            gives[number] = match way {
                YieldingPart::Joint => moments[mass.before],
                YieldingPart::Hung => loads.masses[k],
            };
        }
        Forces { cells: left, gives }
    }

    /// The motion with the strains of these forces, `(m/EI, −V/κGA)`, with rigid motions removed.
    fn motion(&self, forces: &Forces) -> HeldMotion {
        let gauss = &GAUSS_40;
        let count = self.stretches.len();
        let mut gives = vec![ZERO; forces.gives.len()];
        let mut kinks = vec![ZERO; count + 1];
        for (_, mass, give) in self.gives() {
            gives[give.number] = forces.gives[give.number] * softness(&give);
            kinks[mass.before] = kinks[mass.before] + kink(Some(give), &gives);
        }
        let mut borders = vec![[ZERO; 2]; count + 1];
        let mut cells = vec![[Series::exact(&[]); 2]; count];
        let outwards = (self.split..count).map(|k| (k, true));
        for (k, tipwards) in outwards.chain((0..self.split).rev().map(|k| (k, false))) {
            let (stretch, [force, moment]) = (&self.stretches[k], &forces.cells[k]);
            let half = stretch.half;
            let bend = stretch.soft.product(&moment.values(gauss));
            let turned = Series::through(gauss, &bend).integrated().times(half);
            let slope = match &stretch.slip {
                Some(slip) => turned - Series::through(gauss, &slip.product(&force.values(gauss))),
                None => turned,
            };
            let turns = half * Series::through(gauss, &bend).integral();
            let (lifted, lifts) = (slope.integrated().times(half), half * slope.integral());
            let length = half + half;
            let [w, theta] = borders[if tipwards { k } else { k + 1 }];
            let start = match tipwards {
                true => [w, theta + kinks[k]],
                false => [w - length * (theta - turns) - lifts, theta - turns],
            };
            let [w, theta] = start;
            match tipwards {
                true => borders[k + 1] = [w + length * theta + lifts, theta + turns],
                false => borders[k] = [w, theta - kinks[k]],
            }
            let line = Series::of(&[w + half * theta, half * theta]);
            cells[k] = [lifted + line, turned.plus(theta)];
        }
        let motion = HeldMotion { cells, borders, gives };
        // `⟨y, (1, 0)⟩/M` and `⟨y, (x − x_b, 1)⟩/I`.
        let Rigid { over_mass, over_inertia, .. } = *self.rigid;
        let push = self.kinetic_energy(&motion, &self.line(point(1.0), ZERO)) * over_mass;
        let turn = self.kinetic_energy(&motion, &self.line(ZERO, point(1.0))) * over_inertia;
        let line = self.line(-push, -turn);
        let plus = |(a, b): (&[Series; 2], &[Series; 2])| [a[0] + b[0], a[1] + b[1]];
        let borders = motion.borders.iter().zip(&line.borders);
        HeldMotion {
            cells: motion.cells.iter().zip(&line.cells).map(plus).collect(),
            borders: borders.map(|(a, b)| [a[0] + b[0], a[1] + b[1]]).collect(),
            gives: motion.gives,
        }
    }

    /// `⟨a, b⟩ = ∫ρA w_a w_b + ρI θ_a θ_b dx` with the terms of the masses.
    fn kinetic_energy(&self, a: &HeldMotion, b: &HeldMotion) -> Interval {
        let gauss = &GAUSS_40;
        let mut sum = ZERO;
        for (stretch, (a, b)) in self.stretches.iter().zip(a.cells.iter().zip(&b.cells)) {
            let product = |k: usize, by: &Values<40>| {
                by.product(&a[k].values(gauss)).product(&b[k].values(gauss)).integral(gauss)
            };
            let turning = stretch.turning.as_ref().map_or(ZERO, |turning| product(1, turning));
            sum = sum + stretch.half * (product(0, &stretch.mass) + turning);
        }
        for mass in self.masses {
            let [turn_a, turn_b] = [a, b].map(|motion| motion.borders[mass.before][1]);
            let both = self.moved(mass, a) * self.moved(mass, b);
            sum = sum + mass.mass * both + mass.inertia * turn_a * turn_b;
        }
        sum
    }

    /// `∫m_a m_b/EI + V_a V_b/κGA dx`, with similar terms of compliant parts.
    fn strain_energy(&self, a: &Forces, b: &Forces) -> Interval {
        let mut sum = ZERO;
        for (stretch, ([v_a, m_a], [v_b, m_b])) in
            self.stretches.iter().zip(a.cells.iter().zip(&b.cells))
        {
            let slip = stretch.slip.as_ref().map_or(ZERO, |slip| weighted(v_a, v_b, slip));
            sum = sum + stretch.half * (weighted(m_a, m_b, &stretch.soft) + slip);
        }
        for (.., give) in self.gives() {
            sum = sum + a.gives[give.number] * b.gives[give.number] * softness(&give);
        }
        sum
    }
}

/// `∫_{−1}^1 a b c`, including a bound for coefficients beyond degree 33 of `a` and `b` and for their radii.
fn weighted(a: &Series, b: &Series, c: &Values<40>) -> Interval {
    let gauss = &GAUSS_40;
    let ((a, off_a), (b, off_b)) = (a.lowered(DEGREE), b.lowered(DEGREE));
    let own = c.product(&a.values(gauss)).product(&b.values(gauss)).integral(gauss);
    let [size_a, size_b, size_c] = [a.largest(), b.largest(), Series::through(gauss, c).largest()];
    let off = point(size_a) * point(off_b) + point(off_a) * (point(size_b) + point(off_b));
    own + Interval::within((point(2.0 * size_c) * off).high)
}

/// The solution of equations with several right sides by elimination, pivots surely not 0.
fn solved(mut matrix: IntervalMatrix, mut right: IntervalMatrix) -> Option<IntervalMatrix> {
    let size = matrix.len();
    for k in 0..size {
        let best = |i: &usize| matrix[*i][k].smallest();
        let pivot = (k..size).max_by(|i, j| best(i).total_cmp(&best(j)))?;
        matrix.swap(k, pivot);
        right.swap(k, pivot);
        let over = matrix[k][k].reciprocal()?;
        for i in (0..size).filter(|i| *i != k) {
            let part = matrix[i][k] * over;
            for j in k + 1..size {
                matrix[i][j] = matrix[i][j] - part * matrix[k][j];
            }
            for j in 0..right[k].len() {
                right[i][j] = right[i][j] - part * right[k][j];
            }
        }
        matrix[k].iter_mut().skip(k + 1).for_each(|entry| *entry = *entry * over);
        right[k].iter_mut().for_each(|entry| *entry = *entry * over);
    }
    Some(right)
}
