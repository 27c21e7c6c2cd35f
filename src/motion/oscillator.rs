//! How does a system with known modes ring? Free motion as a sum of modes.
//!
//! An [`Oscillator`] is one mode.
//!
//! ```text
//! w(x, t) = Σ φ_n(x) q_n(t),    m_n (q̈_n + 2 ζ_n ω_n q̇_n + ω_n² q_n) = 0 after t = 0
//! ```
//!
//! A rigid motion is also one, with `ω = 0`.

use faer::c64;

use crate::motion::phi::differences;

/// One mode in time: a mass on a spring with a damper.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Oscillator {
    /// Undamped angular frequency (rad/s); 0 for a rigid motion, which is never slowed down.
    pub omega: f64,
    /// Damping ratio `ζ = c/(2 m ω)`, with `c` the modal damping (kg/s); 0 or more, 1 is critical.
    pub damping_ratio: f64,
    /// Modal mass (kg) for the mode's shape: `∫ρA φ² dx`.
    pub mass: f64,
}

impl Oscillator {
    /// Displacement (m) per unit impulse (N s), a time `t ≥ 0` after it.
    ///
    /// `h(t) = e^(−ζωt) sin(ω_d t)/(m ω_d)` with `ω_d = ω √(1 − ζ²)`; `t e^(−ωt)/m` if critical,
    /// the hyperbolic sine if over-damped, `t/m` if rigid.
    pub fn impulse_response(&self, t: f64) -> f64 {
        self.free(0.0, 1.0 / self.mass, t)[0]
    }

    /// Displacement and velocity a time `t ≥ 0` after starting from `q0` and `v0`.
    ///
    /// With `s(t)` the motion that starts from 0 with velocity 1,
    /// `q = q₀ (ṡ + 2ζω s) + v₀ s` and `q̇ = −q₀ ω² s + v₀ ṡ`.
    pub fn free(&self, q0: f64, v0: f64, t: f64) -> [f64; 2] {
        let (omega, zeta) = (self.omega, self.damping_ratio);
        let root = omega * ((1.0 - zeta) * (1.0 + zeta)).abs().sqrt();
        // `s`, `ṡ`, and `ṡ + 2ζω s`, the last by its own formula, because the sum cancels when over-damped.
        let (s, s_dot, c) = if zeta < 1.0 || omega == 0.0 {
            let decay = (-zeta * omega * t).exp();
            let s = decay * if root > 0.0 { (root * t).sin() / root } else { t };
            let cos = decay * (root * t).cos();
            (s, cos - zeta * omega * s, cos + zeta * omega * s)
        } else {
            let fast = zeta * omega + root;
            let slow = omega * omega / fast;
            let spread = if root > 0.0 { -(-2.0 * root * t).exp_m1() / (2.0 * root) } else { t };
            let s = (-slow * t).exp() * spread;
            let end = (-fast * t).exp();
            (s, end - slow * s, end + fast * s)
        };
        [q0 * c + v0 * s, v0 * s_dot - q0 * omega * omega * s]
    }

    /// Displacement and velocity a time `h > 0` after `[q, v]`, under a force (N) that changes linearly from one value
    /// to the other: exact for any `h`.
    ///
    /// With the poles `s₁, s₂ = −ζω ± √(ζ² − 1) ω` the impulse response is the divided difference of `e^{st}`, and so
    /// is the response to a force ([`differences`]).
    pub fn forced(&self, [q, v]: [f64; 2], [from, to]: [f64; 2], h: f64) -> [f64; 2] {
        let [a, b] = self.poles();
        let (whole, [first, second]) = differences(a * h, b * h);
        let (kick, rise) = (h / self.mass, to - from);
        let [moved, moving] = self.free(q, v, h);
        let by = kick * h * (first.re * from + second.re * rise);
        [moved + by, moving + kick * (whole.re * from + first.re * rise)]
    }

    /// Both poles (1/s), the faster one first.
    fn poles(&self) -> [c64; 2] {
        let (omega, zeta) = (self.omega, self.damping_ratio);
        let root = omega * ((1.0 - zeta) * (1.0 + zeta)).abs().sqrt();
        if zeta < 1.0 || omega == 0.0 {
            return [root, -root].map(|swing| c64::new(-zeta * omega, swing));
        }
        let fast = zeta * omega + root;
        [fast, omega * omega / fast].map(|decay| c64::new(-decay, 0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::phi::driven;

    fn oscillator(damping_ratio: f64) -> Oscillator {
        Oscillator { omega: 50.0, damping_ratio, mass: 2.0 }
    }

    /// `q̈ + 2ζω q̇ + ω² q = 0`, with derivatives by central differences (error h²/6 × ω³ and ω⁴
    /// q).
    #[test]
    fn free_motion_obeys_its_equation_under_over_and_at_critical_damping() {
        let h = 1e-5;
        for zeta in [0.0, 0.1, 0.999_999, 1.0, 1.000_001, 1.5, 20.0] {
            let mode = oscillator(zeta);
            assert_eq!(mode.free(0.3, -4.0, 0.0), [0.3, -4.0]);
            for t in [0.001, 0.02, 0.3] {
                let [q, v] = mode.free(0.3, -4.0, t);
                let (next, last) = (mode.free(0.3, -4.0, t + h), mode.free(0.3, -4.0, t - h));
                let rate = |i: usize| (next[i] - last[i]) / (2.0 * h);
                let forces = 2.0 * zeta * 50.0 * v + 2500.0 * q;
                let scale = 1.0 + 2.0 * zeta;
                assert!((rate(0) - v).abs() < 1e-5 * scale.powi(2), "{zeta} {t}");
                assert!((rate(1) + forces).abs() < 1e-3 * scale.powi(3), "{zeta} {t}");
            }
        }
    }

    #[test]
    fn the_closed_forms_hold_and_damping_passes_through_critical_without_a_step() {
        let t = 0.03_f64;
        let impulse = |zeta: f64| oscillator(zeta).impulse_response(t);
        let close = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-14, "{a} {b}");
        close(impulse(0.0), (50.0 * t).sin() / 100.0);
        close(impulse(1.0), t * (-50.0 * t).exp() / 2.0);
        close(impulse(1.25), (-62.5 * t).exp() * (37.5 * t).sinh() / (2.0 * 37.5));
        assert!((impulse(1.0 - 1e-12) / impulse(1.0 + 1e-12) - 1.0).abs() < 1e-11);
        // Very heavy damping creeps at ω/(2ζ) without overflow or lost digits.
        close(oscillator(1e6).free(1.0, 0.0, 4e4)[0], (-1.0_f64).exp() * (1.0 + 0.0));
    }

    /// A single step over a stretch and many steps over its parts agree, whichever formula each uses.
    #[test]
    fn a_ramp_in_one_step_or_in_many_is_the_same() {
        let (h, parts) = (0.3, 1000);
        for zeta in [0.0, 0.01, 0.7, 1.0, 1.000_001, 4.0] {
            for omega in [0.0, 1e-3, 50.0] {
                let mode = Oscillator { omega, damping_ratio: zeta, mass: 2.0 };
                let whole = mode.forced([0.01, -0.3], [5.0, -20.0], h);
                let mut state = [0.01, -0.3];
                let force = |k: usize| 5.0 - 25.0 * k as f64 / parts as f64;
                for k in 0..parts {
                    state = mode.forced(state, [force(k), force(k + 1)], h / parts as f64);
                }
                for (a, b) in whole.iter().zip(state) {
                    // A thousand roundings of a speed of some metres a second.
                    assert!((a - b).abs() < 1e-12, "{zeta} {omega} {a} {b}");
                }
            }
        }
    }

    /// A step and a ramp on an undamped mass: `(1 − cos ωt)/k` and `(t − sin(ωt)/ω)/k`.
    #[test]
    fn the_closed_forms_of_step_and_ramp_hold() {
        let (mode, k) = (oscillator(0.0), 2.0 * 2500.0);
        for t in [1e-4_f64, 0.01, 0.019, 0.021, 0.3, 40.0] {
            let turn = 50.0 * t;
            let [step, speed] = mode.forced([0.0; 2], [1.0; 2], t);
            let exact = 2.0 * (0.5 * turn).sin().powi(2) / k;
            assert!((step - exact).abs() < 1e-14 * exact.max(1e-2 / k), "{t}");
            assert!((speed - 50.0 * turn.sin() / k).abs() < 1e-14 * 50.0 / k, "{t}");
            let ramp = mode.forced([0.0; 2], [0.0, t], t)[0];
            let exact = (t - turn.sin() / 50.0) / k;
            assert!((ramp - exact).abs() < 1e-13 * exact.max(1e-4 / k), "{t} {ramp} {exact}");
        }
    }

    /// A pole of a single oscillator responds as the oscillator does: `Im/(m ω_d)`.
    #[test]
    fn a_driven_pole_is_the_oscillator_s() {
        let mode = oscillator(0.2);
        let swinging = 50.0 * 0.96_f64.sqrt();
        let s = c64::new(-10.0, swinging);
        for h in [1e-5, 0.01, 0.019, 0.021, 0.5] {
            let exact = mode.forced([0.0; 2], [3.0, -1.0], h)[0];
            let found = driven(s, c64::new(0.0, 0.0), &[3.0, -4.0], h).im / (2.0 * swinging);
            assert!((found - exact).abs() < 1e-14 * h.min(0.02), "{h} {found} {exact}");
        }
        let rigid = driven(c64::new(0.0, 0.0), c64::new(0.0, 0.0), &[3.0, -4.0], 0.5);
        assert!((rigid.re - 0.5).abs() < 1e-15);
    }

    #[test]
    fn a_rigid_motion_never_stops() {
        for damping_ratio in [0.0, 0.5, 1.0, 3.0] {
            let rigid = Oscillator { omega: 0.0, damping_ratio, mass: 4.0 };
            assert_eq!(rigid.impulse_response(6.0), 1.5);
            assert_eq!(rigid.free(1.0, 2.0, 3.0), [7.0, 2.0]);
        }
    }
}
