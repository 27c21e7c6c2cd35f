//! How does anything ring whose modes are known: free motion as a sum of modes?
//!
//! [`struck`] and [`partial_sums`] after a blow, [`expansion`] from a shape; an [`Oscillator`] is
//! one mode.
//!
//! ```text
//! w(x, t) = Σ φ_n(x) q_n(t),    m_n (q̈_n + 2 ζ_n ω_n q̇_n + ω_n² q_n) = 0 after t = 0
//! ```
//!
//! Plain numbers in and out, so that closed-form modes and finite-element modes ring alike. A
//! shape is a list of samples `φ_n(x_i)`, with one mass `μ_i` (kg) per sample standing for `ρA dx`.
//! Put the two rigid motions (`ω = 0`) in front of the list and they take part; leave them out
//! and they do not.
//!
//! ```text
//! let amplitudes = struck(&modes, &shape_at_a, impulse, t);   // or A_n × modes[n].free(1, 0, t)
//! let w = partial_sums(&shapes, &amplitudes).pop();           // all modes; the others on the way
//! ```

use faer::c64;

use crate::motion::phi::differences;

/// One mode in time: a mass on a spring with a damper.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Oscillator {
    /// Undamped angular frequency (rad/s); 0 is a rigid motion, which nothing slows down.
    pub omega: f64,
    /// Damping ratio `ζ = c/(2 m ω)`, with `c` the modal damping (kg/s); 0 or more, 1 is critical.
    pub damping_ratio: f64,
    /// Modal mass (kg) of the shape this goes with: `∫ρA φ² dx`.
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
        // `s`, `ṡ`, and `ṡ + 2ζω s` in a form of its own, as the sum cancels when over-damped.
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

    /// Displacement and velocity a time `h > 0` after `[q, v]` under a force (N) that goes in a
    /// straight line from one value to another meanwhile: exact, however long `h` is.
    ///
    /// With the poles `s₁, s₂ = −ζω ± √(ζ² − 1) ω` the impulse response is the divided difference of
    /// `e^{st}`, and so is what it makes of a force ([`differences`]).
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

/// Sample masses `μ_i` (kg) of a bar with `density_per_length` (kg/m) sampled at rising `x` (m):
/// the trapezoid rule.
pub fn trapezoid_masses(x: &[f64], density_per_length: &[f64]) -> Vec<f64> {
    let gap = |i: usize, j: usize| x[j] - x[i];
    let last = x.len() - 1;
    (0..=last)
        .map(|i| 0.5 * gap(i.saturating_sub(1), (i + 1).min(last)) * density_per_length[i])
        .collect()
}

/// The two rigid motions as shapes: `1`, and `x − x_c` about the balance point of the samples.
///
/// Orthogonal to each other under `masses`; their modal masses are the mass and the inertia.
pub fn rigid_pair(x: &[f64], masses: &[f64]) -> [Vec<f64>; 2] {
    let ones = vec![1.0; x.len()];
    let balance_point = dot(masses, x, &ones) / masses.iter().sum::<f64>();
    [ones, x.iter().map(|x| x - balance_point).collect()]
}

/// `I_nm = Σ_i μ_i φ_n(x_i) φ_m(x_i)`: modal masses on the diagonal, and beside it what
/// orthogonality or the sampling leaves.
pub fn orthogonality(masses: &[f64], shapes: &[Vec<f64>]) -> Vec<Vec<f64>> {
    shapes.iter().map(|a| shapes.iter().map(|b| dot(masses, a, b)).collect()).collect()
}

/// `A_n = Σ_i μ_i w₀(x_i) φ_n(x_i) / I_nn`: how much of each mode is in the shape `w0`.
///
/// # Source
///
/// Chapter 2 and Fig. 9 of the WPI report (named in [`crate::collision::energy_loss::wpi_alpha`]), which leaves out
/// the rigid pair: its sum then tends to `w₀` less its rigid part.
pub fn expansion(masses: &[f64], shapes: &[Vec<f64>], w0: &[f64]) -> Vec<f64> {
    shapes.iter().map(|shape| dot(masses, shape, w0) / dot(masses, shape, shape)).collect()
}

/// `q_n(t) = J φ_n(a) h_n(t)`: each mode's displacement after an impulse `J` (N s) at `a`.
///
/// `shape_at_a` holds `φ_n(a)`. With the shapes at `x` this is the response `w(x, t)`; its velocity
/// at `t = 0` is a series that does not converge, for a force that lasts no time has no finite
/// power.
pub fn struck(modes: &[Oscillator], shape_at_a: &[f64], impulse: f64, t: f64) -> Vec<f64> {
    modes.iter().zip(shape_at_a).map(|(m, phi)| impulse * phi * m.impulse_response(t)).collect()
}

/// `w_N(x_i) = Σ_{n ≤ N} q_n φ_n(x_i)`; entry `N − 1` is the sum of the first `N` modes.
pub fn partial_sums(shapes: &[Vec<f64>], amplitudes: &[f64]) -> Vec<Vec<f64>> {
    let mut sum = vec![0.0; shapes.first().map_or(0, Vec::len)];
    let add = |(shape, amplitude): (&Vec<f64>, &f64)| {
        sum.iter_mut().zip(shape).for_each(|(w, phi)| *w += amplitude * phi);
        sum.clone()
    };
    shapes.iter().zip(amplitudes).map(add).collect()
}

/// `max_i |w_{N+1}(x_i) − w_N(x_i)|` for successive partial sums: what one more mode still changes.
pub fn largest_steps(sums: &[Vec<f64>]) -> Vec<f64> {
    let step = |(a, b): (&f64, &f64)| (b - a).abs();
    sums.windows(2).map(|w| w[0].iter().zip(&w[1]).map(step).fold(0.0, f64::max)).collect()
}

/// `Σ μ a b`.
fn dot(masses: &[f64], a: &[f64], b: &[f64]) -> f64 {
    masses.iter().zip(a).zip(b).map(|((mass, a), b)| mass * a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::beam::dowel::{Ends, UniformMode, beta_l};
    use crate::motion::phi::driven;

    fn oscillator(damping_ratio: f64) -> Oscillator {
        Oscillator { omega: 50.0, damping_ratio, mass: 2.0 }
    }

    fn grid(cells: usize) -> Vec<f64> {
        (0..=cells).map(|i| i as f64 / cells as f64).collect()
    }

    fn free_free(x: &[f64], count: usize) -> Vec<Vec<f64>> {
        let sample = |mode: UniformMode| x.iter().map(|&x| mode.deflection(x)).collect();
        (1..=count).map(|n| sample(UniformMode::new(Ends::FreeFree, n))).collect()
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

    /// Steps add up: one over a stretch or many over its parts, whichever formula each takes.
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

    /// A pole of a single oscillator answers as the oscillator does: `Im/(m ω_d)`.
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

    #[test]
    fn rigid_motions_are_orthogonal_and_weigh_the_mass_and_the_inertia() {
        let x = grid(1000);
        // A bar of 3 kg/m growing to 5: mass 4 kg, balance point 13/24 m, inertia 13/4 − 4
        // (13/24)².
        let density: Vec<f64> = x.iter().map(|x| 3.0 + 2.0 * x).collect();
        let masses = trapezoid_masses(&x, &density);
        let [[m, cross], [_, inertia]] = {
            let i = orthogonality(&masses, &rigid_pair(&x, &masses));
            [[i[0][0], i[0][1]], [i[1][0], i[1][1]]]
        };
        assert!((m - 4.0).abs() < 1e-13 && cross.abs() < 1e-14);
        let exact = 1.5 - 4.0 * (13.0_f64 / 24.0).powi(2);
        // The trapezoid rule's end error h²/12 [f′]₀¹ with f = (3 + 2x)(x − 13/24)², less 1e-6.
        assert!((inertia - exact).abs() < 1e-6, "{inertia} {exact}");
    }

    #[test]
    fn with_the_rigid_pair_the_expansion_returns_the_shape_and_without_it_not() {
        let x = grid(4000);
        let masses = trapezoid_masses(&x, &vec![1.0; x.len()]);
        let w0: Vec<f64> = x.iter().map(|x| 0.1 * (std::f64::consts::PI * x).sin()).collect();
        let bending = free_free(&x, 40);
        let all: Vec<_> = rigid_pair(&x, &masses).into_iter().chain(bending.clone()).collect();
        let miss = |shapes: &[Vec<f64>]| {
            let sums = partial_sums(shapes, &expansion(&masses, shapes, &w0));
            largest_steps(&[sums.last().unwrap().clone(), w0.clone()])[0]
        };
        // The bending terms fall as n⁻³ at an end; the mean of a sine is 2/π of its height.
        assert!(miss(&all) < 1e-5, "{}", miss(&all));
        let mean = 0.2 / std::f64::consts::PI;
        assert!((miss(&bending) - mean).abs() < 2e-5, "{}", miss(&bending));
    }

    /// An impulse gives the whole bar the momentum J at once; only the translation carries it.
    #[test]
    fn momentum_of_a_struck_bar_is_the_impulse_at_all_times() {
        let x = grid(2000);
        let masses = trapezoid_masses(&x, &vec![2.0; x.len()]);
        let bending = free_free(&x, 20);
        let shapes: Vec<_> = rigid_pair(&x, &masses).into_iter().chain(bending).collect();
        let inertias = orthogonality(&masses, &shapes);
        let omega = |n: usize| {
            if n < 2 { 0.0 } else { beta_l(Ends::FreeFree, n - 1).powi(2) }
        };
        let modes: Vec<_> = (0..shapes.len())
            .map(|n| Oscillator { omega: omega(n), damping_ratio: 0.0, mass: inertias[n][n] })
            .collect();
        let struck_at: Vec<f64> = shapes.iter().map(|shape| shape[1400]).collect();
        for t in [0.01, 0.4, 3.0] {
            let w = partial_sums(&shapes, &struck(&modes, &struck_at, 5.0, t)).pop().unwrap();
            let moment: f64 = masses.iter().zip(&w).map(|(mass, w)| mass * w).sum();
            assert!((moment / (5.0 * t) - 1.0).abs() < 1e-4, "{t}: {moment}");
        }
    }
}
