//! The WPI report's empirical loss to vibration, exactly as its script computes it.
//!
//! ```text
//! E_v(a) = γ Σ_n W_n(a)²/(2n + 1)^p                               n = 1 … N bending modes
//! v′ = v + [−v + √(v² + 2(½ + E_v)(v_r² − v²))]/(1 + 2 E_v)       v_r the rigid model's v′
//! ```
//!
//! The second line solves `½ v_r² − ½ v² = ½ v′² − ½ v² + E_v (J/m)²` with `J/m = v′ − v`: the ball's energy change in
//! the rigid collision, less that of the vibration.
//!
//! **Empirical, and kept for comparison only.** Its faults:
//! - `γ = 0.2` and `p = 2` are fitted to no stated measurement. Theory has `m S_n²/(2 m_n)` in their place, with the
//!   spectrum `S_n` of the contact pulse. That falls as `n⁻⁴` and is no power of `n`: the fit underestimates the first
//!   two modes and overestimates all others.
//! - It charges the vibration to the ball alone. The bat keeps its rigid energy change, although a smaller impulse
//!   takes less energy from it, so energy is not conserved.
//! - It therefore depends on the observer: a moving one finds another impulse.
//! - Near the handle the root is complex. The report plots zero there; here the result is `None`.
//!
//! # Source
//!
//! Boucher, Mannke, McClune, *Vibrational Analysis of a Bat-Ball Collision*, Major Qualifying
//! Project, Worcester Polytechnic Institute, Eqs 4-6 to 4-15. Eq. 4-15 prints `W_n(a)` where the
//! script squares it; with the printed form the ball would gain from many vibrations.

use crate::beam::{Ends, UniformMode, beta_l};

/// The two constants of the fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergyLoss {
    /// `γ`, overall size.
    pub gamma: f64,
    /// `p`, how fast the share falls with the mode number.
    pub decay: f64,
}

impl Default for EnergyLoss {
    fn default() -> Self {
        Self { gamma: 0.2, decay: 2.0 }
    }
}

impl EnergyLoss {
    /// `E_v(a)` (dimensionless), for the deflections `W_1(a), W_2(a), …` of the bending modes.
    ///
    /// The report's shapes are not normalised: on its dowel they are [`crate::collision::energy_loss::wpi_shape`], so
    /// `(1/M) ∫ρA W_n² dx = α_n²`. For a fair comparison, scale the modes of another bat in the same way.
    pub fn vibration(&self, shape_at_a: &[f64]) -> f64 {
        let share = |(i, w): (usize, &f64)| w * w / ((2 * i + 3) as f64).powf(self.decay);
        self.gamma * shape_at_a.iter().enumerate().map(share).sum::<f64>()
    }

    /// The energy (J) that the model assigns to each mode: `m E_n (J/m)²`, with `E_n` the mode's share of `E_v`.
    pub fn energies(&self, shape_at_a: &[f64], impulse: f64, ball_mass: f64) -> Vec<f64> {
        let scale = impulse * impulse / ball_mass;
        let energy = |(i, w): (usize, &f64)| {
            scale * self.gamma * w * w / ((2 * i + 3) as f64).powf(self.decay)
        };
        shape_at_a.iter().enumerate().map(energy).collect()
    }

    /// The ball's velocity after the hit (m/s); `None` if the equation has no real root.
    ///
    /// `incoming < 0` is the ball's velocity, `rigid` its exit velocity from a bat that does not bend, and `vibration`
    /// is `E_v`.
    pub fn exit_velocity(incoming: f64, rigid: f64, vibration: f64) -> Option<f64> {
        let gain = rigid * rigid - incoming * incoming;
        let square = incoming * incoming + 2.0 * (0.5 + vibration) * gain;
        (square >= 0.0).then(|| incoming + (square.sqrt() - incoming) / (1.0 + 2.0 * vibration))
    }
}

/// `α_n` of the WPI report, whose free–free shapes are `sinh bX + sin bX + α_n (cosh bX + cos bX)`.
///
/// `α_n = (sinh b − sin b)/(cos b − cosh b)`, here in the equal form `−(1 + sq)/(1 − sq)`,
/// `q = e^(−b)`, `s = ±1` for odd and even `n`. It goes to −1, and `∫₀¹ W_n² dX = α_n²` exactly.
///
/// # Source
///
/// Boucher, Mannke, McClune, *Vibrational Analysis of a Bat-Ball Collision*, Major Qualifying
/// Project, Worcester Polytechnic Institute, chapter 2 (whose Eq. 2-28 has a sign misprinted).
pub fn wpi_alpha(n: usize) -> f64 {
    let sign = if n.is_multiple_of(2) { -1.0 } else { 1.0 };
    let tail = sign * (-beta_l(Ends::FreeFree, n)).exp();
    -(1.0 + tail) / (1.0 - tail)
}

/// The WPI report's free–free shape `W_n(X)`, un-normalised as in the report, computed without cancellation.
///
/// `W_n(0) = 2 α_n`, `W_n′(0) = 2 βL`.
pub fn wpi_shape(n: usize, x: f64) -> f64 {
    wpi_alpha(n) * UniformMode::new(Ends::FreeFree, n).deflection(x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::beam::dowel::Ends::FreeFree;

    /// `E_v` of the report's dowel, struck at the fraction `x` of its length, with ten modes.
    fn dowel_vibration(x: f64) -> f64 {
        let shape: Vec<f64> = (1..=10).map(|n| wpi_shape(n, x)).collect();
        EnergyLoss::default().vibration(&shape)
    }

    #[test]
    fn without_vibration_the_ball_leaves_as_from_a_stiff_bat() {
        for rigid in [1.0, 20.0, 47.0, 60.0] {
            let exit = EnergyLoss::exit_velocity(-40.0, rigid, 0.0).unwrap();
            assert!((exit - rigid).abs() < 1e-13, "{exit}");
        }
    }

    #[test]
    fn the_ball_s_energy_change_is_the_rigid_one_less_the_vibration() {
        let (v, rigid, vibration) = (-40.0, 47.0, 0.04);
        let exit = EnergyLoss::exit_velocity(v, rigid, vibration).unwrap();
        let left = (rigid * rigid - exit * exit) / 2.0 - vibration * (exit - v).powi(2);
        assert!(exit < rigid && left.abs() < 1e-12, "{left}");
    }

    #[test]
    fn the_modes_share_the_whole_loss_among_them() {
        let (loss, shape) = (EnergyLoss::default(), [1.3, -0.4, 2.0]);
        let (impulse, mass) = (12.0, 0.145);
        let total: f64 = loss.energies(&shape, impulse, mass).iter().sum();
        let whole = loss.vibration(&shape) * impulse * impulse / mass;
        assert!((total / whole - 1.0).abs() < 1e-15);
    }

    #[test]
    fn a_weak_hit_has_no_value() {
        assert_eq!(EnergyLoss::exit_velocity(-40.0, 5.0, 0.5), None);
        assert_eq!(EnergyLoss::exit_velocity(-40.0, 5.0, f64::NAN), None);
    }

    /// The mean of `W_n²` is `α_n²`.
    #[test]
    fn the_mean_of_the_loss_is_its_series() {
        let cells = 2000;
        let at = |i: usize| dowel_vibration((i as f64 + 0.5) / cells as f64);
        let mean = (0..cells).map(at).sum::<f64>() / cells as f64;
        let term = |n: usize| (wpi_alpha(n) / (2 * n + 1) as f64).powi(2);
        let series = 0.2 * (1..=10).map(term).sum::<f64>();
        // The midpoint rule's end error, h²/24 [d(W²)/dX]₀¹ = −2 h² βL/3 |α| per mode, times γ/(2n + 1)².
        assert!((mean - series).abs() < 1e-6, "{mean} {series}");
        assert!((series - 0.042_98).abs() < 1e-5);
    }

    /// At 0.75 L and 50 rad/s, in inches per second: the rigid gain is 3421.7 for every observer; the empirical one is
    /// 3275.9 at rest, and 3326.6 or 3080.5 for an observer moving at ∓1000.
    #[test]
    fn it_depends_on_the_observer() {
        let vibration = dowel_vibration(0.75);
        let closing: f64 = 50.0 * (2.5 + 33.0 * 0.75) + 1584.0;
        let gain = 6.0 * 1.5 * closing / (1.0 + 6.0 + 12.0 * 0.0625);
        assert!((gain - 3421.7).abs() < 0.05);
        for (shift, known) in [(0.0, 3275.9), (1000.0, 3326.6), (-1000.0, 3080.5)] {
            let v = -1584.0 + shift;
            let exit = EnergyLoss::exit_velocity(v, v + gain, vibration).unwrap();
            assert!((exit - v - known).abs() < 0.05, "{shift}: {}", exit - v);
        }
    }

    #[test]
    fn the_report_s_shape_is_the_hyperbolic_one_where_that_still_has_digits() {
        for n in 1..=3 {
            let (b, alpha) = (beta_l(FreeFree, n), wpi_alpha(n));
            let raw = (b.sinh() - b.sin()) / (b.cos() - b.cosh());
            assert!((alpha - raw).abs() < 1e-15 * b.exp(), "{n}");
            for x in [0.0, 0.2, 0.5, 0.7, 1.0] {
                let y: f64 = b * x;
                let hyperbolic = y.sinh() + y.sin() + alpha * (y.cosh() + y.cos());
                assert!((wpi_shape(n, x) - hyperbolic).abs() < 1e-15 * b.exp(), "{n} {x}");
            }
        }
        // α₁² = 1.0359360, α₂² = 0.9984472
        assert!((wpi_alpha(1).powi(2) - 1.035_935_996_45).abs() < 1e-11);
        assert!((wpi_alpha(2).powi(2) - 0.998_447_186_95).abs() < 1e-11);
    }
}
