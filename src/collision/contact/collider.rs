//! A bat's modes in time and the ball that hits it: touch by touch, until the ball is gone for good.

use std::sync::OnceLock;

use faer::c64;
use pulp::{Simd, WithSimd};

use crate::base::widest;
use crate::collision::contact::collocation::{LANES, Lobatto, POINTS};
use crate::collision::contact::encounter::Encounter;
use crate::collision::contact::flight::Landing;
use crate::collision::contact::force_law::ForceLaw;
use crate::collision::contact::pressing::{LEVELS, Run, StepTables, USUAL};
use crate::collision::contact::table::{ForcePiece, StepTable};
use crate::collision::contact::tangent::Tangent;
use crate::collision::contact::touch::{DrivingPoint, State, Swings, Touch, Tuning};

/// A bat's modes in time, for any impact point: the tables are shared.
#[derive(Debug, Clone)]
pub struct Collider {
    pub(super) rule: Lobatto,
    /// `s = −ζω + iω_d` of every mode, the last lanes filled.
    pub(super) poles: Vec<c64>,
    /// Steps of length `longest/2^level`, made when first needed.
    tables: Vec<OnceLock<StepTable>>,
    pub(super) longest: f64,
    pub(super) tuning: Tuning,
}

/// Most touches that are computed; the possible effect of more is part of the error.
pub(super) const MOST_TOUCHES: usize = 64;
/// A ball counts as gone after a flight of this time (s), or of this multiple of the longest step, about a hundred times
/// as long as it was pressed: by then a swung bat has turned away, and hands that would bring it back have moved.
pub(super) const LONGEST_FLIGHT: f64 = 0.02;
pub(super) const FLIGHT_IN_STEPS: f64 = 100.0;

impl Collider {
    /// Modes with those ω (rad/s) and damping ratios below 1, for hits that compress a ball for
    /// about that time (s).
    pub fn new(modes: &[[f64; 2]], time: f64) -> Self {
        let pole = |[omega, ratio]: &[f64; 2]| {
            c64::new(-ratio * omega, omega * ((1.0 - ratio) * (1.0 + ratio)).sqrt())
        };
        // The modes that fill the last lanes have no weight.
        let filled = modes.len().next_multiple_of(LANES);
        let fill = std::iter::repeat(c64::new(0.0, 1.0 / time));
        let poles: Vec<c64> = modes.iter().map(pole).chain(fill).take(filled).collect();
        Self {
            rule: Lobatto::default(),
            poles,
            tables: vec![OnceLock::new(); LEVELS],
            longest: time * (1 << USUAL) as f64,
            tuning: Tuning::default(),
        }
    }

    /// This collider with other lengths of the steps.
    pub fn tuned(self, tuning: Tuning) -> Self {
        Self { tuning, ..self }
    }

    /// The encounter at that place for a closing speed of `speed` (m/s), with as many modes as there are gains, in
    /// steps whose force has a relative error of about `accuracy`.
    pub fn meet(&self, felt: &DrivingPoint, law: &dyn Law, speed: f64, accuracy: f64) -> Encounter {
        self.meet_beside(felt, &[], law, speed, accuracy)
    }

    /// The encounter, and the first-order change of its impulse for each of the other bats, which have at most as many
    /// modes, and with the closing speed.
    pub fn meet_beside(
        &self,
        felt: &DrivingPoint,
        others: &[DrivingPoint],
        law: &dyn Law,
        speed: f64,
        accuracy: f64,
    ) -> Encounter {
        law.meet(Meeting { collider: self, felt, others, speed, accuracy, history: None })
    }

    /// The encounter, and its force in time, piece by piece, from the first touch to the last.
    pub fn meet_recorded(
        &self,
        felt: &DrivingPoint,
        law: &dyn Law,
        speed: f64,
        accuracy: f64,
    ) -> (Encounter, Vec<ForcePiece>) {
        let mut pieces = Vec::new();
        let history = Some(&mut pieces);
        let meeting = Meeting { collider: self, felt, others: &[], speed, accuracy, history };
        (law.meet(meeting), pieces)
    }
}

impl Collider {
    /// Ball and bat at that place as they begin to touch.
    #[inline(always)]
    pub(super) fn touch<'a, L: ForceLaw>(
        &'a self,
        felt: &'a DrivingPoint,
        law: L,
        speed: f64,
        accuracy: f64,
    ) -> Touch<'a, L> {
        let count = felt.gains.len().next_multiple_of(LANES);
        let poles = &self.poles[..count];
        let energy = 0.5 * speed * speed / felt.inverse_mass;
        let deepest = deepest(&law, felt.rest, energy);
        let gain = |n: usize| felt.gains.get(n).copied().unwrap_or(0.0);
        let mode = |n: usize| (poles[n], gain(n));
        let swings = (0..count).step_by(LANES);
        Touch {
            rule: &self.rule,
            poles,
            felt,
            swings: swings.map(|n| Swings::new(std::array::from_fn(|l| mode(n + l)))).collect(),
            damped: poles.iter().any(|s| s.re != 0.0),
            law,
            speed,
            energy,
            deepest,
            way: deepest + felt.rest * law.force(deepest, None)[0],
            accuracy,
            tuning: self.tuning,
        }
    }

    /// The table of steps of `longest/2^level`.
    #[inline(always)]
    pub(super) fn table(&self, level: usize) -> &StepTable {
        let length = self.longest * 0.5_f64.powi(level as i32);
        self.tables[level].get_or_init(|| StepTable::new(&self.rule, &self.poles, length))
    }
}

/// The data of one encounter.
pub struct Meeting<'a> {
    collider: &'a Collider,
    felt: &'a DrivingPoint,
    others: &'a [DrivingPoint],
    speed: f64,
    accuracy: f64,
    history: Option<&'a mut Vec<ForcePiece>>,
}

/// An encounter by the ball's law.
struct Touches<'a, L> {
    law: L,
    meeting: Meeting<'a>,
}

/// Data of the ball for the force law of one hit.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct LawTerms {
    /// Stiffness k of the ball (N/m^α).
    pub stiffness: f64,
    /// Exponent α of the ball.
    pub exponent: f64,
    /// Coefficient of restitution e₀ on a rigid wall in this hit.
    pub restitution: f64,
    /// Speed (m/s) at which the ball would bring as much energy to a rigid wall, for balls that are stiffer in faster
    /// hits. Later touches of the same hit keep it, as they keep e₀.
    pub speed: f64,
}

/// Any law in a hit. One call computes the whole encounter, so that each law has its own compiled steps.
pub trait Law: Send + Sync {
    /// The encounter of [`Collider::meet`]; its force in time goes to the `history`, if there is one.
    fn meet(&self, meeting: Meeting<'_>) -> Encounter;

    /// The compression (m) that stores that energy (J).
    fn pressed_by(&self, energy: f64) -> f64;

    /// Stiffness and both exponents of a law of powers ([`ForceLaw::powers`]).
    fn powers(&self) -> Option<[f64; 3]>;
}

impl<L: ForceLaw> Law for L {
    fn meet(&self, meeting: Meeting<'_>) -> Encounter {
        widest(Touches { law: *self, meeting })
    }

    fn pressed_by(&self, energy: f64) -> f64 {
        self.compression(energy)
    }

    fn powers(&self) -> Option<[f64; 3]> {
        ForceLaw::powers(self)
    }
}

impl<L: ForceLaw> WithSimd for Touches<'_, L> {
    type Output = Encounter;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Encounter {
        let Self { law, meeting } = self;
        let Meeting { collider, felt, others, speed, accuracy, history } = meeting;
        let Collider { poles: all, tables, longest, .. } = collider;
        let touch = collider.touch(felt, law, speed, accuracy);
        touch.go(StepTables { all, tables, longest: *longest, history, others })
    }
}

/// The compression (m) at which a ball of that law and a flexibility (m/N) together store that energy (J).
fn deepest(law: &impl ForceLaw, rest: f64, energy: f64) -> f64 {
    let mut x = law.compression(energy);
    // The function is convex and the start is above the root, so Newton's method descends to it.
    for _ in 0..60 {
        let [force, slope] = law.force(x, None);
        let more = law.energy(x, None)[0] + 0.5 * rest * force * force - energy;
        let by = more / (force + rest * force * slope);
        if by <= 1e-3 * x || by.is_nan() {
            break;
        }
        x -= by;
    }
    x
}

impl<L: ForceLaw> Touch<'_, L> {
    /// Touch by touch until the ball is gone for good.
    #[inline(always)]
    fn go(&self, mut means: StepTables) -> Encounter {
        let mut met = Encounter { touches: 1, ..Encounter::default() };
        let mut run = Run::new(State::at_first(self.swings.len(), self.speed));
        if !means.others.is_empty() {
            let others = means.others.iter().map(|other| self.tangent(other));
            run.tangents = others.chain([self.faster()]).collect();
        }
        run.level = self.first_level(&run.now, means.longest);
        let longest = LONGEST_FLIGHT.max(FLIGHT_IN_STEPS * means.longest);
        let mut began = 0.0;
        loop {
            if !self.press(&mut run, &mut means, &mut met) {
                met.endless = true;
                break;
            }
            // A force that has gone may return before the ball is round again.
            let left = self.reach(&run.now);
            if run.now.compression > 0.0 && self.glide(&mut run, &mut means, [0.0, left]) {
                (met.late, run.level, run.last) = (true, USUAL, None);
                self.settle(&mut run.now, run.top);
                continue;
            }
            met.time += run.now.time - began;
            self.part(&mut run, &mut met);
            let flight = self.fly(&mut run, [f64::NEG_INFINITY, 0.0], longest);
            if flight == Landing::Open || met.touches == MOST_TOUCHES && flight == Landing::Meets {
                met.open = self.most_that_follows(&run.now);
                break;
            }
            if flight == Landing::Gone {
                break;
            }
            let length = run.now.time - met.end;
            means.record(ForcePiece { start: met.end, length, powers: [0.0; POINTS] });
            began = run.now.time;
            met.touches += 1;
            (run.last, run.faint) = (None, false);
            run.level = self.first_level(&run.now, means.longest);
        }
        met
    }

    /// Moves ball and bat on while there is next to no force. Returns whether the force comes back.
    fn glide(&self, run: &mut Run, means: &mut StepTables, between: [f64; 2]) -> bool {
        let start = run.now.time;
        let landing = self.fly(run, between, f64::INFINITY);
        let length = run.now.time - start;
        means.record(ForcePiece { start, length, powers: [0.0; POINTS] });
        landing == Landing::Meets
    }

    /// The ball leaves and is round again.
    fn part(&self, run: &mut Run, met: &mut Encounter) {
        let Run { now, top, tangents, .. } = run;
        now.spent += self.law.energy(0.0, *top)[1];
        met.compression = top.map_or(0.0, |top| top.compression).max(met.compression);
        (now.compression, now.force, *top) = (0.0, 0.0, None);
        (met.impulse, met.end) = (now.impulse, now.time);
        met.changes.clear();
        met.changes.extend(tangents.iter_mut().map(Tangent::part));
        met.faster = met.changes.pop();
        if met.touches == 1 {
            (met.first_impulse, met.first_end) = (met.impulse, met.end);
            met.first_changes.clone_from(&met.changes);
        }
        (met.lost_in_ball, met.lost_in_bat) = (now.spent, now.lost);
        met.in_modes = (0..self.felt.gains.len()).map(|n| self.in_mode(now, n)).collect();
    }

    /// Upper bound of the impulse (N s) of later touches: as if all remaining energy went into the motion of the ball.
    pub(super) fn most_that_follows(&self, now: &State) -> f64 {
        let energy = self.energy - now.lost - now.spent;
        let fastest = (2.0 * energy * self.felt.inverse_mass).sqrt();
        (fastest + now.speed) / self.felt.inverse_mass
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::beam::dowel;
    use crate::beam::dowel::Ends;
    use crate::collision::contact::collocation::polynomial;
    use crate::collision::contact::power_law::PowerLaw;
    use crate::collision::energy_loss;

    /// ω, ζ = 0 and `c_n` of a free uniform dowel, 238.9 Hz, 0.85 kg, 0.838 m, struck at the
    /// fraction `at` of its length; all modes and the ball's and the rigid dowel's 1/μ.
    fn dowel(modes: usize, at: f64, ball: f64) -> (Vec<[f64; 2]>, DrivingPoint) {
        let mass = 0.850_416;
        let first = dowel::beta_l(Ends::FreeFree, 1);
        let omega = |n: usize| {
            std::f64::consts::TAU * 238.907 * (dowel::beta_l(Ends::FreeFree, n) / first).powi(2)
        };
        let gain =
            |n: usize| (energy_loss::wpi_shape(n, at) / energy_loss::wpi_alpha(n)).powi(2) / mass;
        let felt = DrivingPoint {
            inverse_mass: 1.0 / ball + (1.0 + 12.0 * (at - 0.5).powi(2)) / mass,
            gains: (1..=modes).map(gain).collect(),
            rest: 0.0,
        };
        ((1..=modes).map(|n| [omega(n), 0.0]).collect(), felt)
    }

    fn meet(
        modes: &[[f64; 2]],
        felt: &DrivingPoint,
        law: &PowerLaw,
        speed: f64,
        accuracy: f64,
    ) -> Encounter {
        Collider::new(modes, 8e-5).meet(felt, law, speed, accuracy)
    }

    const BALL: f64 = 0.145;

    #[test]
    fn a_rigid_wall_returns_the_ball_with_its_restitution() {
        for restitution in [0.1, 0.5, 0.9, 1.0] {
            for speed in [1e-3, 1.0, 60.0] {
                let law = PowerLaw::new(6.53e7, 1.84, restitution);
                let felt = DrivingPoint { inverse_mass: 1.0 / BALL, ..DrivingPoint::default() };
                let met = meet(&[], &felt, &law, speed, 1e-4);
                let back = met.impulse / BALL - speed;
                assert!((back / speed - restitution).abs() < 1e-12, "{restitution} {speed} {back}");
                let lost = 0.5 * BALL * speed * speed * (1.0 - restitution * restitution);
                assert!((met.lost_in_ball - lost).abs() < 1e-12 * speed * speed);
                assert!(met.reloads == 0 && !(met.late || met.again() || met.endless));
            }
        }
    }

    /// A linear spring without loss makes ball, dowel and spring one linear system: its motions are
    /// eigenvectors, and the ball leaves at the first zero of a sum of cosines.
    #[test]
    fn a_linear_ball_is_a_linear_system() {
        use faer::{Mat, Side};
        let (stiffness, speed) = (3e6, 60.0);
        let law = PowerLaw::new(stiffness, 1.0, 1.0);
        for at in [0.5, 0.62, 0.775_842, 0.83, 0.97] {
            let (modes, felt) = dowel(12, at, BALL);
            let met = meet(&modes, &felt, &law, speed, 1e-10);
            // Unknowns z√μ and y/√c: unit mass, stiffness ω² and k g gᵀ.
            let n = modes.len() + 1;
            let reach = |i: usize| match i {
                0 => felt.inverse_mass.sqrt(),
                _ => felt.gains[i - 1].sqrt(),
            };
            let matrix = Mat::<f64>::from_fn(n, n, |i, j| {
                let own = if i == j && i > 0 { modes[i - 1][0].powi(2) } else { 0.0 };
                own + stiffness * reach(i) * reach(j)
            });
            let pairs = matrix.self_adjoint_eigen(Side::Lower).unwrap();
            let parts: Vec<[f64; 2]> = (0..n)
                .map(|k| {
                    let vector = pairs.U().col(k);
                    let seen: f64 = (0..n).map(|i| reach(i) * vector[i]).sum();
                    let start = speed / reach(0) * vector[0];
                    let omega = pairs.S()[k].max(0.0).sqrt();
                    [omega, seen * start / omega]
                })
                .collect();
            let x = |t: f64| -> f64 { parts.iter().map(|[w, a]| a * (w * t).sin()).sum() };
            let mut high = 1e-5;
            while x(high) > 0.0 {
                high += 1e-6;
            }
            let mut low = high - 1e-6;
            for _ in 0..80 {
                let middle = 0.5 * (low + high);
                if x(middle) > 0.0 { low = middle } else { high = middle }
            }
            let impulse: f64 =
                parts.iter().map(|[w, a]| stiffness * a * (1.0 - (w * low).cos()) / w).sum();
            assert!((met.time / low - 1.0).abs() < 1e-11, "{at} {} {low}", met.time);
            assert!((met.impulse / impulse - 1.0).abs() < 1e-11, "{at} {} {impulse}", met.impulse);
        }
    }

    /// The recorded force has the encounter's impulse, ends with it and leaves its energy in a mode.
    #[test]
    fn the_recorded_force_is_the_force() {
        for (at, restitution, accuracy) in
            [(0.5, 0.5, 1e-3), (0.7, 0.5, 1e-6), (0.775_842, 0.9, 1e-3), (0.99, 0.3, 1e-3)]
        {
            let (modes, felt) = dowel(6, at, BALL);
            let law = PowerLaw::new(6.53e7, 1.84, restitution);
            let collider = Collider::new(&modes, 8e-5);
            let (met, pieces) = collider.meet_recorded(&felt, &law, 60.0, accuracy);
            assert_eq!(met, collider.meet(&felt, &law, 60.0, accuracy));
            let end = pieces.last().map(|piece| piece.start + piece.length).unwrap();
            assert!((end / met.end - 1.0).abs() < 1e-14);
            let (mut impulse, mut memory, omega) = (0.0, [0.0; 2], modes[2][0]);
            let mut start = 0.0;
            for piece in &pieces {
                assert!((piece.start - start).abs() < 1e-14);
                start = piece.start + piece.length;
                for (s, w) in crate::base::quadrature::gauss(12) {
                    let force = polynomial(&piece.powers, s);
                    assert!(force > -1e-6 * met.peak_force);
                    let part = w * piece.length * force;
                    impulse += part;
                    let (sin, cos) = (omega * (end - piece.start - s * piece.length)).sin_cos();
                    memory = [memory[0] + cos * part, memory[1] + sin * part];
                }
            }
            assert!((impulse / met.impulse - 1.0).abs() < 1e-12, "{at}");
            let energy = 0.5 * felt.gains[2] * (memory[0].powi(2) + memory[1].powi(2));
            let whole = 0.5 * 60.0 * 60.0 / felt.inverse_mass;
            assert!((energy - met.in_modes[2]).abs() < 1e-12 * whole, "{at}");
        }
    }

    /// The dowel of the WPI report at 0.7 of its length, 50 rad/s about a point 63.5 mm beyond the
    /// knob, a ball of 5 oz at 90 mph, k = 1e7 N/m^1.5, e₀ = ½: exit speeds with 0 to 30 modes by
    /// an eighth-order Runge-Kutta method that locates the ends of the branches.
    #[test]
    fn other_methods_find_the_same_exit_speeds() {
        let (ball, incoming): (f64, f64) = (0.141_747_6, 40.2336);
        let law = PowerLaw::new(1e7, 1.5, 0.5);
        let speed = 50.0 * (0.0635 + 0.7 * 0.8382) + incoming;
        let known = [
            (0, 47.293),
            (1, 44.128),
            (2, 33.272),
            (3, 33.052),
            (5, 33.513),
            (10, 33.749),
            (20, 33.788),
            (30, 33.792),
        ];
        for (count, exit) in known {
            let (modes, felt) = dowel(count, 0.7, ball);
            let met = meet(&modes, &felt, &law, speed, 1e-8);
            let found = met.impulse / ball - incoming;
            assert!((found - exit).abs() < 6e-4, "{count} {found}");
        }
    }
}
