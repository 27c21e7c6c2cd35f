//! Ball and bat at one moment of a contact: how far they have come together, how fast, with what
//! energies. The equations are those of [`crate::collision::contact::encounter`].

use faer::c64;

use crate::collision::contact::collocation::{LANES, Lobatto, lanes, sum, total};
use crate::collision::contact::force_law::{ForceLaw, Top};

/// The bat as the ball feels it at one place.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Felt {
    /// `1/μ` (1/kg): the ball's own mass and the rigid bat's.
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
    /// Energy that is wrong and not put right yet (J).
    pub defect: f64,
    /// Approach `z` of the ball to the rigid bat (m).
    pub closing: f64,
    /// Speed `z′` of the approach (m/s).
    pub speed: f64,
    /// Real part of the memory `v` of every mode (N s).
    pub real: Vec<f64>,
    /// Imaginary part of the memory `v` of every mode (N s).
    pub imaginary: Vec<f64>,
    /// Compression of the ball (m); NaN where it is still to be found.
    pub compression: f64,
    /// Force of the ball on the bat (N).
    pub force: f64,
    /// Impulse so far (N s).
    pub impulse: f64,
    /// Energy the bat's damping has taken (J).
    pub lost: f64,
    /// Energy lost in the ball by touches that are over (J).
    pub spent: f64,
}

impl State {
    /// The moment of the first touch, at that closing speed (m/s), nothing ringing.
    pub fn at_first(modes: usize, speed: f64) -> Self {
        let none = || vec![0.0; modes];
        Self { speed, real: none(), imaginary: none(), ..Self::default() }
    }

    /// The memory of mode n.
    #[inline(always)]
    pub fn memory(&self, n: usize) -> c64 {
        c64::new(self.real[n], self.imaginary[n])
    }

    /// Makes that the memory of mode n.
    #[inline(always)]
    pub fn remember(&mut self, n: usize, memory: c64) {
        (self.real[n], self.imaginary[n]) = (memory.re, memory.im);
    }
}

/// How long the steps of a contact are let be.
///
/// `cargo run --release --example tuning_steps` prints the steps that hits along three bats take and how far
/// their impulses are off, with each value smaller and larger. Only the usual error tells on both: a
/// tenth of it nearly doubles the steps of good accuracies. With all of them hits that press the ball once
/// are within a hundredth of the accuracy; those that press it anew are not in the table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tuning {
    /// Error of a step of usual length that is let pass, over the accuracy.
    pub usual_error: f64,
    /// Error of a longer step, while the force has almost gone, over the accuracy.
    pub long_error: f64,
    /// Share of the energy that the ball may still store when its last step begins, over the accuracy.
    pub last_energy: f64,
    /// Share of the impulse that a bump may change, over the accuracy.
    pub slight: f64,
    /// Share of its peak below which the force has almost gone, and steps may be longer.
    pub faint: f64,
}

impl Default for Tuning {
    fn default() -> Self {
        Self { usual_error: 3.0, long_error: 0.01, last_energy: 0.03, slight: 0.05, faint: 0.02 }
    }
}

/// One place, one ball, one speed.
pub struct Touch<'a, L> {
    /// Where in a step the force is looked at.
    pub rule: &'a Lobatto,
    /// `s` of every mode, of its lanes: those of no weight beyond the last mode fill the last lanes.
    pub poles: &'a [c64],
    /// Real part of every `s` (1/s).
    pub decay: &'a [f64],
    /// Imaginary part of every `s` (1/s).
    pub swing: &'a [f64],
    /// Absolute square of every `s` (1/s²).
    pub square: &'a [f64],
    /// The bat as the ball feels it there.
    pub felt: &'a Felt,
    /// `c/ω_d` of every mode (s/kg).
    pub weights: Vec<f64>,
    /// `c/ω_d²` of every mode (s²/kg), by which [`Self::in_mode`] makes energies of memories.
    pub masses: Vec<f64>,
    /// Whether any mode dies out.
    pub damped: bool,
    /// The ball's law.
    pub law: L,
    /// The closing speed u at the first touch (m/s).
    pub speed: f64,
    /// `μ u²/2` at the first touch (J).
    pub energy: f64,
    /// What the bat would compress the ball by if it did not ring (m).
    pub deepest: f64,
    /// How far the two would then have come together (m).
    pub way: f64,
    /// How far the steps' forces may be off, relative.
    pub accuracy: f64,
    /// How long the steps are let be.
    pub tuning: Tuning,
}

impl<L: ForceLaw> Touch<'_, L> {
    /// The modes that are not there to fill the lanes.
    #[inline(always)]
    pub fn modes(&self) -> impl Iterator<Item = (usize, &c64)> {
        self.poles.iter().enumerate().take(self.felt.gains.len())
    }

    /// Lanes of modes.
    #[inline(always)]
    pub fn chunks(&self) -> usize {
        self.weights.len() / LANES
    }

    /// `z + Σ y` (m).
    #[inline(always)]
    pub fn reach(&self, state: &State) -> f64 {
        let [w, im] = [&self.weights, &state.imaginary].map(|v| lanes(v));
        state.closing - total(self.chunks(), |k, l| w[k][l] * im[k][l])
    }

    /// Rate of [`Self::reach`] (m/s).
    #[inline(always)]
    pub fn rate(&self, state: &State) -> f64 {
        let [w, a, b] = [&self.weights, self.decay, self.swing].map(lanes);
        let [re, im] = [&state.real, &state.imaginary].map(|v| lanes(v));
        let part = |k: usize, l: usize| w[k][l] * (a[k][l] * im[k][l] + b[k][l] * re[k][l]);
        state.speed - total(self.chunks(), part)
    }

    /// Energy of mode n, `m_n (q′² + ω² q²)/2` (J).
    #[inline(always)]
    pub fn in_mode(&self, state: &State, n: usize) -> f64 {
        let (re, im) = (state.real[n], state.imaginary[n]);
        let rate = self.decay[n] * im + self.swing[n] * re;
        0.5 * self.masses[n] * (rate * rate + self.square[n] * im * im)
    }

    /// Energy of ball and bat relative to their common motion, lost energy included (J).
    #[inline(always)]
    pub fn whole_energy(&self, state: &State, top: Option<Top>) -> f64 {
        let [stored, lost] = self.law.energy_of(state.compression, state.force, top);
        let rigid = 0.5 * state.speed * state.speed / self.felt.inverse_mass;
        let [m, a, b, q] = [&self.masses, self.decay, self.swing, self.square].map(lanes);
        let [re, im] = [&state.real, &state.imaginary].map(|v| lanes(v));
        let mut modes = [0.0; LANES];
        for k in 0..self.chunks() {
            for l in 0..LANES {
                let rate = a[k][l] * im[k][l] + b[k][l] * re[k][l];
                modes[l] += m[k][l] * (rate * rate + q[k][l] * im[k][l] * im[k][l]);
            }
        }
        let rest = 0.5 * self.felt.rest * state.force * state.force;
        rigid + 0.5 * sum(modes) + stored + lost + state.lost + state.spent + rest
    }

    /// Compression and force from the motions: `x + C F(x) = z + Σ y`.
    #[inline(always)]
    pub fn settle(&self, state: &mut State, top: Option<Top>) {
        let (reach, rest) = (self.reach(state), self.felt.rest);
        let (mut x, mut force) = (state.compression, state.force);
        // From the force that is known, as long as it is not far.
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
