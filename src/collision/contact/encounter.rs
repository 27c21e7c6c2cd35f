//! Ball and bat in contact: a lossy spring between a mass and a body that translates, rotates and vibrates.
//!
//! With `x` the ball's compression, `F(x)` its force ([`crate::collision::contact::force_law`]) and the bat's
//! motions at the impact point,
//!
//! ```text
//! x + C F = z + Σ y_n                      z the rigid closing, y_n the modes' deflections
//! z″ = −F/μ                                1/μ = 1/m + 1/M_eff
//! y_n″ + 2ζ_n ω_n y_n′ + ω_n² y_n = −c_n F    c_n = φ_n(a)²/m_n
//! C                                        flexibility of the modes left out, which follow at once
//! ```
//!
//! Each mode is the memory `v(t) = ∫ e^{s(t−τ)} F dτ` of the force, `s = −ζω + iω_d`, with `y =
//! −(c/ω_d) Im v` and `y′ = −(c/ω_d) Im sv`. In a step the force is a polynomial through Lobatto's
//! points, at which the first equation holds. Its effect on `z` and `v` is then exact, however fast a mode vibrates,
//! and the tables for it depend only on the modes and the step's length. A small bump is added to the force of every
//! step so that the energy balance closes to round-off; the energy of this correction measures the error of the steps.
//! The end of loading and the departure of the ball are located inside a step by Newton's method on the exact motion.
//! The derivative of the impulse by the bat's properties is computed along with it
//! ([`crate::collision::contact::tangent`]).
//!
//! The bat may catch up with the ball ([`crate::collision::contact::flight`]) while the force has almost gone, or after
//! the ball has left. A ball that has left is round again: a later touch begins on the first branch of the law, with
//! the e₀ of the first. The encounter ends when the ball is gone for good.
//!
//! # Source
//!
//! Modal coupling: A. M. Nathan, Am. J. Phys. 68, 979 (2000), who integrates in time by a Runge-Kutta method. Exact
//! motion under a polynomial load: variation of constants. Energy by projection: E. Hairer, C. Lubich, G. Wanner,
//! Geometric Numerical Integration (2006), section IV.4.

use crate::collision::contact::touch::DrivingPoint;

/// An encounter that needs more steps than this has failed.
pub const MOST_STEPS: usize = 20_000;

/// The result of an encounter of ball and bat.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Encounter {
    /// Impulse `J` of all touches (N s).
    pub impulse: f64,
    /// Contact time, all touches together (s).
    pub time: f64,
    /// When the ball leaves for good, since the first touch (s).
    pub end: f64,
    /// When the ball leaves for the first time, since the first touch (s).
    pub first_end: f64,
    /// Impulse of the first touch (N s).
    pub first_impulse: f64,
    /// Number of touches.
    pub touches: usize,
    /// Largest force (N).
    pub peak_force: f64,
    /// Largest compression (m).
    pub compression: f64,
    /// Energy lost in the ball (J).
    pub lost_in_ball: f64,
    /// Energy lost by the bat's damping (J).
    pub lost_in_bat: f64,
    /// Energy of every mode (J).
    pub in_modes: Vec<f64>,
    /// Sum of the energy errors of the steps before their correction, relative to the available energy.
    pub corrected: f64,
    /// Number of times that the ball was compressed again beyond its largest compression.
    pub reloads: usize,
    /// The force had almost gone when the bat caught up with the ball.
    pub late: bool,
    /// Possible impulse (N s) of touches beyond those that were computed.
    pub open: f64,
    /// Number of steps tried.
    pub steps: usize,
    /// Change of the impulse (N s) for each varied bat, to first order.
    pub changes: Vec<f64>,
    /// Change of the first touch's impulse (N s) for each varied bat, to first order.
    pub first_changes: Vec<f64>,
    /// Change of the impulse (N s) with the closing speed, times that speed, to first order; `None` without varied
    /// bats.
    pub faster: Option<f64>,
    /// The steps did not come to an end.
    pub endless: bool,
}

impl Encounter {
    /// Whether the steps did not come to an end because there were too many of them; finer steps would be even more.
    pub fn is_exhausted(&self) -> bool {
        self.endless && self.steps >= MOST_STEPS
    }

    /// Steps times modes.
    pub fn work(&self) -> u64 {
        self.steps as u64 * self.in_modes.len().max(1) as u64
    }

    /// Whether the bat's surface caught the ball again after it had left.
    pub fn again(&self) -> bool {
        self.touches > 1
    }

    /// Whether a small change may be magnified: the ball was compressed again or touched again.
    pub fn is_delicate(&self) -> bool {
        self.reloads > 0 || self.late || self.again()
    }

    /// Whether the steps came to an end and the energies balance for that closing speed (m/s): the loss of rigid energy
    /// must equal the energy lost and in the modes.
    pub fn is_sound(&self, felt: &DrivingPoint, speed: f64) -> bool {
        /// Allowed error of the balance, as a share of the energy.
        const BOUND: f64 = 1e-9;
        let after = speed - self.impulse * felt.inverse_mass;
        let [before, after] = [speed, after].map(|v| 0.5 * v * v / felt.inverse_mass);
        let lost = self.lost_in_ball + self.lost_in_bat + self.in_modes.iter().sum::<f64>();
        // A balance that is NaN does not close.
        !self.endless && (before - after - lost).abs() <= BOUND * before
    }
}
