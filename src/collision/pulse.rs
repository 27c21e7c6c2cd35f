//! The bat under a force pulse of known form: the energy that a half sine of duration τ leaves in every mode, and the
//! impulse that the energy balance then allows.
//!
//! ```text
//! F = (πJ/2τ) sin(πt/τ),  0 < t < τ
//! S_n = cos(ω_n τ/2)/(1 − (ω_n τ/π)²)         its spectrum over J, π/4 where ω_n τ = π
//! E_n = J² c_n S_n²/2                          c_n = φ_n(a)²/m_n
//! s = μ Σ c_n S_n²,   g = 1 − κ (1 − e₀²)
//! e = [−g s + √(e₀² (1 + g s) − g s)]/(1 + g s),   J = μ (1 + e) u
//! ```
//!
//! The last line is the balance `μu²(1 − e²)/2 = D + ΣE_n` with the ball's loss `D = (1 − e₀²)(μu²/2 − κ ΣE_n)`. With κ
//! = 0 the ball loses as much as on a rigid bat; with κ = 1 it loses a fixed share of the energy that the vibration
//! leaves. If too little is left, there is no real root. As τ → 0 every mode takes `J² c_n/2`, and their sum diverges:
//! a delta impulse has no answer in the model itself, not only in the series.
//!
//! τ and κ are not constants of nature. With 0.75 ms and 0.6 this model follows
//! [`crate::collision::contact::encounter`] within 1 m/s on the WPI report's dowel and on a cone, at one speed.
//!
//! # Source
//!
//! Energy of a free oscillator after a force: `|∫F e^{−iωt} dt|²/(2m)`. The energy balance is that
//! of Newton's impact law with one more loss.

use std::f64::consts::{FRAC_PI_4, PI};

/// A pulse and its ball.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pulse {
    /// τ (s).
    pub duration: f64,
    /// κ, the share of the vibration's energy that reduces the ball's loss.
    pub loss_share: f64,
}

impl Default for Pulse {
    fn default() -> Self {
        Self { duration: 0.75e-3, loss_share: 0.6 }
    }
}

impl Pulse {
    /// `S` at that ω (rad/s).
    pub fn spectrum(&self, omega: f64) -> f64 {
        let z = omega * self.duration / PI;
        // cos(πz/2) is zero where 1 − z² is.
        let near = z - 1.0;
        if near.abs() < 1e-6 {
            return FRAC_PI_4 * (1.0 - 0.5 * near);
        }
        (0.5 * PI * z).cos() / ((1.0 - z) * (1.0 + z))
    }

    /// `c S²` (1/kg) of every mode of those ω (rad/s) and gains `c` (1/kg).
    pub fn shares(&self, modes: &[[f64; 2]], gains: &[f64]) -> Vec<f64> {
        let share = |([omega, _], gain): (&[f64; 2], &f64)| gain * self.spectrum(*omega).powi(2);
        modes.iter().zip(gains).map(share).collect()
    }

    /// An upper bound for all modes above ω (rad/s) together, where `slow` is their `Σ c/ω⁴` (m s²/N):
    /// `|S| ≤ 1/((ωτ/π)² − 1)`.
    pub fn beyond(&self, omega: f64, slow: f64) -> f64 {
        let z = (omega * self.duration / PI).powi(2);
        if z <= 1.0 {
            return f64::INFINITY;
        }
        slow.max(0.0) * (PI / self.duration).powi(4) / (1.0 - 1.0 / z).powi(2)
    }

    /// `e` if the ball alone has `e₀` and all modes together the share `s`; `None` if the energy is not enough.
    pub fn restitution(&self, ball: f64, s: f64) -> Option<f64> {
        let g = 1.0 - self.loss_share * (1.0 - ball * ball);
        let square = ball * ball * (1.0 + g * s) - g * s;
        (square >= 0.0).then(|| (square.sqrt() - g * s) / (1.0 + g * s))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::quadrature::gauss;

    #[test]
    fn the_spectrum_is_the_pulse_s() {
        let pulse = Pulse { duration: 0.6e-3, loss_share: 0.0 };
        for z in [0.0, 0.3, 0.999, 1.0, 1.000_000_1, 1.4, 3.0, 6.5] {
            let omega = z * PI / pulse.duration;
            // ∫ (π/2) sin(πs) cos(ωτ(s − ½)) ds.
            let part = |(s, w): (f64, f64)| {
                w * 0.5 * PI * (PI * s).sin() * (omega * pulse.duration * (s - 0.5)).cos()
            };
            let exact: f64 = gauss(30).into_iter().map(part).sum();
            assert!((pulse.spectrum(omega) - exact).abs() < 1e-9, "{z}");
        }
    }

    #[test]
    fn the_energies_balance() {
        for loss_share in [0.0, 0.6, 1.0] {
            let pulse = Pulse { duration: 0.6e-3, loss_share };
            let (ball, mu, speed): (f64, f64, f64) = (0.5, 0.12, 70.0);
            for s in [0.0, 0.05, 0.2] {
                let e = pulse.restitution(ball, s).unwrap();
                let impulse = mu * (1.0 + e) * speed;
                let vibration = impulse * impulse * s / (2.0 * mu);
                let all = 0.5 * mu * speed * speed;
                let lost = (1.0 - ball * ball) * (all - loss_share * vibration);
                assert!((all * (1.0 - e * e) - lost - vibration).abs() < 1e-12 * all);
                assert!(e <= ball);
            }
        }
        assert_eq!(Pulse { loss_share: 0.0, ..Pulse::default() }.restitution(0.5, 0.34), None);
    }

    #[test]
    fn what_is_beyond_is_bounded() {
        let pulse = Pulse::default();
        let omega = |n: u32| 1500.0 * f64::from(2 * n + 1).powi(2) / 9.0;
        let modes: Vec<[f64; 2]> = (1..200).map(|n| [omega(n), 0.0]).collect();
        let shares = pulse.shares(&modes, &[1.0; 199]);
        for first in 3..20 {
            let slow = modes[first..].iter().map(|[w, _]| w.powi(-4)).sum();
            let bound = pulse.beyond(modes[first][0], slow);
            let beyond: f64 = shares[first..].iter().sum();
            assert!(beyond <= bound && bound < 1e3 * beyond, "{first} {beyond} {bound}");
        }
    }
}
