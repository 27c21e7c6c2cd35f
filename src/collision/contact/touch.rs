//! Ball and bat at one moment of a contact: approach, speed and energies. The equations are those of
//! [`crate::collision::contact::encounter`].

use faer::c64;

use crate::collision::contact::collocation::{LANES, Lanes, Lobatto, sum};
use crate::collision::contact::force_law::{ForceLaw, Top};

/// The bat's response to a force at one place.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct DrivingPoint {
    /// `1/μ` (1/kg), of the ball's mass and the effective mass of the rigid bat.
    pub inverse_mass: f64,
    /// `c_n = φ_n(a)²/m_n` (1/kg).
    pub gains: Vec<f64>,
    /// Flexibility of the modes left out (m/N).
    pub rest: f64,
}

/// Ball and bat at one moment of the contact.
#[derive(Debug, Clone, Default)]
pub struct State {
    /// Time since the first touch (s).
    pub time: f64,
    /// `b` of the bump `b s(1 − s)` on the force of the step that led here (N).
    pub bump: f64,
    /// Energy error that is not yet corrected (J).
    pub defect: f64,
    /// Approach `z` of the ball to the rigid bat (m).
    pub closing: f64,
    /// Speed `z′` of the approach (m/s).
    pub speed: f64,
    /// Real and imaginary parts of the memory `v` of every mode (N s).
    pub memories: Vec<[Lanes; 2]>,
    /// Compression of the ball (m); NaN until it is computed.
    pub compression: f64,
    /// Force of the ball on the bat (N).
    pub force: f64,
    /// Impulse so far (N s).
    pub impulse: f64,
    /// Energy lost by the bat's damping (J).
    pub lost: f64,
    /// Energy lost in the ball in earlier touches (J).
    pub spent: f64,
}

impl State {
    /// The moment of the first touch, at that closing speed (m/s), without vibration, for that number of lanes of
    /// modes.
    pub fn at_first(chunks: usize, speed: f64) -> Self {
        Self { speed, memories: vec![Default::default(); chunks], ..Self::default() }
    }

    /// The memory of mode n.
    #[inline(always)]
    pub fn memory(&self, n: usize) -> c64 {
        let ([re, im], l) = (&self.memories[n / LANES], n % LANES);
        c64::new(re[l], im[l])
    }

    /// Sets the memory of mode n.
    #[inline(always)]
    pub fn remember(&mut self, n: usize, memory: c64) {
        let ([re, im], l) = (&mut self.memories[n / LANES], n % LANES);
        (re[l], im[l]) = (memory.re, memory.im);
    }
}

/// Limits on the errors of a contact's steps, which determine their lengths.
///
/// `cargo run --release --example tuning_steps` prints the number of steps and the errors of the impulse for hits along
/// three bats, with each value smaller and larger. Only the usual error affects both: with a tenth of it, good
/// accuracies take nearly twice as many steps. With these values, the impulse of hits that compress the ball once is
/// right to a hundredth of the accuracy; hits that compress it again are not in the table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tuning {
    /// Allowed error of a step of usual length, over the accuracy.
    pub usual_error: f64,
    /// Allowed error of a longer step while the force has almost gone, over the accuracy.
    pub long_error: f64,
    /// Share of the energy that the ball may still store when its last step begins, over the accuracy.
    pub last_energy: f64,
    /// Largest share of the impulse by which a bump may change it, over the accuracy.
    pub slight: f64,
    /// Share of the peak force below which the force has almost gone, and steps may be longer.
    pub faint: f64,
}

impl Default for Tuning {
    fn default() -> Self {
        Self { usual_error: 3.0, long_error: 0.01, last_energy: 0.03, slight: 0.05, faint: 0.02 }
    }
}

/// Some modes side by side, with their response at one place.
#[derive(Debug, Clone, Copy, Default)]
pub struct Swings {
    /// Real part of `s` (1/s).
    pub decay: Lanes,
    /// Imaginary part of `s` (1/s).
    pub swing: Lanes,
    /// Absolute square of `s` (1/s²).
    pub square: Lanes,
    /// `c/ω_d` (s/kg).
    pub weight: Lanes,
    /// `c/ω_d²` (m/N), the mode's flexibility under a slow force.
    pub flexibility: Lanes,
}

impl Swings {
    /// The modes with these `s` (1/s) and `c` (1/kg).
    #[inline(always)]
    pub fn new(modes: [(c64, f64); LANES]) -> Self {
        let mut all = Self::default();
        for (l, (s, gain)) in modes.into_iter().enumerate() {
            (all.decay[l], all.swing[l], all.square[l]) = (s.re, s.im, s.norm_sqr());
            all.weight[l] = gain / s.im;
            all.flexibility[l] = all.weight[l] / s.im;
        }
        all
    }
}

/// A hit at one place, with one ball and one speed.
pub struct Touch<'a, L> {
    /// The points of a step at which the force is computed.
    pub rule: &'a Lobatto,
    /// `s` of every mode; modes without weight fill the last lanes.
    pub poles: &'a [c64],
    /// The modes by lanes.
    pub swings: Vec<Swings>,
    /// The bat's response there.
    pub felt: &'a DrivingPoint,
    /// Whether any mode is damped.
    pub damped: bool,
    /// The ball's law.
    pub law: L,
    /// The closing speed u at the first touch (m/s).
    pub speed: f64,
    /// `μ u²/2` at the first touch (J).
    pub energy: f64,
    /// Largest compression of the ball if the bat did not vibrate (m).
    pub deepest: f64,
    /// Approach of ball and bat at that compression (m).
    pub way: f64,
    /// Allowed relative error of the steps' forces.
    pub accuracy: f64,
    /// Limits on the errors of the steps.
    pub tuning: Tuning,
}

impl<L: ForceLaw> Touch<'_, L> {
    /// The modes, without those that fill the lanes.
    #[inline(always)]
    pub fn modes(&self) -> impl Iterator<Item = (usize, &c64)> {
        self.poles.iter().enumerate().take(self.felt.gains.len())
    }

    /// The sum of `part` over all modes; its arguments are the modes, their memories and a lane.
    #[inline(always)]
    pub fn total(&self, state: &State, part: impl Fn(&Swings, &[Lanes; 2], usize) -> f64) -> f64 {
        let swings = &self.swings[..];
        let memories = &state.memories[..swings.len()];
        let mut sums = [0.0; LANES];
        for k in 0..swings.len() {
            for l in 0..LANES {
                sums[l] += part(&swings[k], &memories[k], l);
            }
        }
        sum(sums)
    }

    /// `z + Σ y` (m).
    #[inline(always)]
    pub fn reach(&self, state: &State) -> f64 {
        state.closing - self.total(state, |of, [_, im], l| of.weight[l] * im[l])
    }

    /// Rate of [`Self::reach`] (m/s).
    #[inline(always)]
    pub fn rate(&self, state: &State) -> f64 {
        state.speed
            - self.total(state, |of, [re, im], l| {
                of.weight[l] * (of.decay[l] * im[l] + of.swing[l] * re[l])
            })
    }

    /// Twice the energy of a mode of that memory, `m_n (q′² + ω² q²)` (J).
    #[inline(always)]
    fn swinging(of: &Swings, [re, im]: &[Lanes; 2], l: usize) -> f64 {
        let rate = of.decay[l] * im[l] + of.swing[l] * re[l];
        of.flexibility[l] * (rate * rate + of.square[l] * im[l] * im[l])
    }

    /// Energy of mode n, `m_n (q′² + ω² q²)/2` (J).
    #[inline(always)]
    pub fn in_mode(&self, state: &State, n: usize) -> f64 {
        0.5 * Self::swinging(&self.swings[n / LANES], &state.memories[n / LANES], n % LANES)
    }

    /// Energy of ball and bat relative to their common motion, lost energy included (J).
    #[inline(always)]
    pub fn whole_energy(&self, state: &State, top: Option<Top>) -> f64 {
        let [stored, lost] = self.law.energy_of(state.compression, state.force, top);
        let rigid = 0.5 * state.speed * state.speed / self.felt.inverse_mass;
        let modes = 0.5 * self.total(state, Self::swinging);
        let rest = 0.5 * self.felt.rest * state.force * state.force;
        rigid + modes + stored + lost + state.lost + state.spent + rest
    }

    /// Compression and force from the motions: `x + C F(x) = z + Σ y`.
    #[inline(always)]
    pub fn settle(&self, state: &mut State, top: Option<Top>) {
        let (reach, rest) = (self.reach(state), self.felt.rest);
        let (mut x, mut force) = (state.compression, state.force);
        // From the known force, if the compression is close enough.
        for _ in 0..3 {
            let slope = self.law.slope(x, force, top);
            let by = (reach - x - rest * force) / (1.0 + rest * slope);
            let Some([near]) = self.law.near([x], [force], [by], top) else {
                break;
            };
            (x, force) = (x + by, near);
            if by.abs() <= 1e-8 * self.law.fine(top) * x || rest == 0.0 {
                [state.compression, state.force] = [x, force];
                return;
            }
        }
        let shared = self.law.share(reach, rest, top, state.compression);
        [state.compression, state.force] = shared;
    }
}
