//! Ball and bat at one moment of a contact: how far they have come together, how fast, with what
//! energies. The equations are those of [`crate::collision::contact`].

use crate::collision::collocation::{Lobatto, Pair};
use crate::collision::force_law::{ForceLaw, Top};

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

/// One moment.
#[derive(Debug, Clone, Default)]
pub struct State {
    pub time: f64,
    /// `b` of the bump `b s(1 − s)` on the force of the step that led here (N).
    pub bump: f64,
    /// Energy that is wrong and not put right yet (J).
    pub defect: f64,
    /// `z` (m) and `z′` (m/s).
    pub closing: f64,
    pub speed: f64,
    /// `v`, real and imaginary parts (N s).
    pub real: Vec<f64>,
    pub imaginary: Vec<f64>,
    pub compression: f64,
    pub force: f64,
    pub impulse: f64,
    /// Energy the bat's damping has taken (J).
    pub lost: f64,
}

impl State {
    pub fn at_first(modes: usize, speed: f64) -> Self {
        let none = || vec![0.0; modes];
        Self { speed, real: none(), imaginary: none(), ..Self::default() }
    }
}

/// One place, one ball, one speed.
pub struct Touch<'a> {
    pub rule: &'a Lobatto,
    pub poles: &'a [Pair],
    pub felt: &'a Felt,
    /// `c/ω_d` of every mode (s/kg).
    pub weights: Vec<f64>,
    pub damped: bool,
    pub law: ForceLaw,
    /// At the first touch (m/s), and the energy that goes with it, `μ u²/2` (J).
    pub speed: f64,
    pub energy: f64,
    /// What the bat would compress the ball by if it did not ring (m), and how far the two would
    /// then have come together (m).
    pub deepest: f64,
    pub way: f64,
    pub accuracy: f64,
}

impl Touch<'_> {
    /// `z + Σ y` (m).
    #[inline(always)]
    pub fn reach(&self, state: &State) -> f64 {
        state.closing - dot(&self.weights, &state.imaginary)
    }

    /// Its rate (m/s).
    #[inline(always)]
    pub fn rate(&self, state: &State) -> f64 {
        let mut sum = state.speed;
        for (n, s) in self.poles.iter().enumerate() {
            sum -= self.weights[n] * (s[0] * state.imaginary[n] + s[1] * state.real[n]);
        }
        sum
    }

    /// `m_n (q′² + ω² q²)/2` (J).
    #[inline(always)]
    pub fn in_mode(&self, state: &State, n: usize) -> f64 {
        let s = self.poles[n];
        let rate = s[0] * state.imaginary[n] + s[1] * state.real[n];
        let square = s[0] * s[0] + s[1] * s[1];
        let q = state.imaginary[n];
        0.5 * self.weights[n] / s[1] * (rate * rate + square * q * q)
    }

    /// Of ball and bat, relative to their common motion, with what is lost (J).
    #[inline(always)]
    pub fn whole_energy(&self, state: &State, top: Option<Top>) -> f64 {
        let [stored, lost] = self.law.energy(state.compression, top);
        let rigid = 0.5 * state.speed * state.speed / self.felt.inverse_mass;
        let modes: f64 = (0..self.poles.len()).map(|n| self.in_mode(state, n)).sum();
        rigid + modes + stored + lost + state.lost + 0.5 * self.felt.rest * state.force.powi(2)
    }

    /// Compression and force from the motions: `x + C F(x) = z + Σ y`.
    #[inline(always)]
    pub fn settle(&self, state: &mut State, top: Option<Top>) {
        let reach = self.reach(state);
        let shared = self.law.share(reach, self.felt.rest, top, state.compression);
        [state.compression, state.force] = shared;
    }
}

/// `Σ a_k b_k`.
#[inline(always)]
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
