//! What does a struck bat sound like?
//!
//! Each mode is a decaying tone. The sound is taken as the acceleration of the surface at the impact point, which
//! drives the air there:
//! ```text
//! p(t) ~ Σ aₙ e^{−δₙ t} sin(2π fₙ t),   δₙ = ζₙ ωₙ
//! a blow of impulse J, a half sine of duration T:   aₙ = J φₙ(x)² ωₙ S(ωₙ T)/mₙ
//! S(ωT) = |cos(ωT/2) / (1 − (ωT/π)²)|
//! ```
//!
//! The wall of a hollow barrel rings too: a hoop mode with the gain c under the pressing body has
//! `aₙ = J c ωₙ S(ωₙ T)`. The radiation efficiency of a mode is not modelled.

use std::f64::consts::PI;

use serde::Serialize;

use crate::base::Result;
use crate::bat::Bat;
use crate::modes::damping::damping;
use crate::modes::mode::Mode;
use crate::modes::solve::Solution;

/// An audible mode.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Tone {
    /// Frequency (Hz).
    pub frequency_hz: f64,
    /// Decay rate (1/s): the amplitude is proportional to `e^{−decay t}`.
    pub decay_1_s: f64,
    /// Initial acceleration at the impact point (m/s²).
    pub amplitude_m_s2: f64,
}

/// The sound of a struck bat.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Sound {
    /// The audible modes, by rising frequency.
    pub tones: Vec<Tone>,
    /// Largest acceleration that such a blow causes anywhere on the outer half (m/s²), by which the sound is scaled: a
    /// blow on a node is quieter.
    #[serde(skip)]
    pub loudest_m_s2: f64,
}

/// Loss factor of a material without a known one, used only in a sound. Source: wood along the grain has 0.005 to
/// 0.015, T. Ono, M. Norimoto, Jpn. J. Appl. Phys. 22 (1983) 611, as quoted.
pub const ASSUMED_LOSS: f64 = 0.01;
/// Duration of a tap with a hard and light object (s), chosen so that the first three or four modes are heard, as when
/// a bat is tapped.
pub const TAP: f64 = 3e-4;
/// The highest audible frequency (Hz).
const HEARD: f64 = 20_000.0;
/// Shortest and longest duration of a sound (s).
const LENGTHS: [f64; 2] = [0.3, 3.0];

/// A hoop mode of a barrel's wall under a pressing body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallTone {
    /// ω (rad/s).
    pub omega: f64,
    /// Damping ratio.
    pub damping_ratio: f64,
    /// `c = (g Ū)²/M` (1/kg), [`crate::modes::hoop::patch`].
    pub gain: f64,
}

/// The hoop modes of the wall under a body that presses at a place (m).
pub type WallTones<'a> = &'a dyn Fn(f64) -> Vec<WallTone>;

/// The bat for a sound, and its solution: a material without a loss factor gets the published one of its kind, else
/// [`ASSUMED_LOSS`].
///
/// # Errors
///
/// Those of [`damping`](fn@damping).
pub fn as_heard(bat: &Bat, solution: &Solution) -> Result<(Bat, Solution)> {
    let bat = solution.of(bat).with_losses(ASSUMED_LOSS)?;
    let damping = damping(&bat, solution.elements(), &solution.modes, 1e-4)?;
    Ok((bat, Solution { damping, ..solution.clone() }))
}

impl Sound {
    /// The sound of modes with these initial accelerations (m/s²), in the order of the solution.
    fn new(solution: &Solution, amplitudes: impl Iterator<Item = f64>) -> Self {
        let damped = |k: usize| solution.damping.modes.get(k);
        let swings = |k: usize| damped(k).is_none_or(|damped| damped.ratio < 1.0);
        let modes = solution.modes.iter().zip(amplitudes).enumerate();
        let heard =
            modes.filter(|(k, (mode, a))| mode.frequency() < HEARD && swings(*k) && *a != 0.0);
        let tone = |(k, (mode, amplitude)): (usize, (&Mode, f64))| Tone {
            frequency_hz: mode.frequency(),
            decay_1_s: damped(k).map_or(0.0, |damped| damped.decay),
            amplitude_m_s2: amplitude,
        };
        Self { tones: heard.map(tone).collect(), loudest_m_s2: 0.0 }
    }

    /// The sound of modes with these initial accelerations (m/s²), after a blow of that impulse (N s) and duration (s)
    /// at `x` (m), including the wall.
    pub fn of_modes(
        solution: &Solution,
        amplitudes: impl Iterator<Item = f64>,
        x: f64,
        blow: [f64; 2],
        wall: Option<WallTones>,
    ) -> Self {
        /// Number of places of the outer half at which the loudness is evaluated.
        const PLACES: usize = 16;
        let mut sound = Self::new(solution, amplitudes);
        let length = solution.modes.first().map_or(0.0, |mode| mode.shape.length());
        let places = (0..=PLACES).map(|k| length * (0.5 + 0.5 * k as f64 / PLACES as f64));
        let there = places.map(|x| {
            let mut other = Self::new(solution, bending(solution, x, blow));
            other.tones.extend(wall.map_or(vec![], |wall| rung(wall(x), blow)));
            other.peak()
        });
        let loudest = there.fold(0.0, f64::max);
        if let Some(wall) = wall {
            sound.tones.extend(rung(wall(x), blow));
            sound.tones.sort_by(|a, b| a.frequency_hz.total_cmp(&b.frequency_hz));
        }
        sound.loudest_m_s2 = loudest.max(sound.peak());
        sound
    }

    /// A blow of that impulse (N s) and duration (s, 0 for an instantaneous one) at `x` (m), including the wall of a
    /// hollow barrel.
    pub fn of_blow(solution: &Solution, x: f64, blow: [f64; 2], wall: Option<WallTones>) -> Self {
        Self::of_modes(solution, bending(solution, x, blow), x, blow, wall)
    }

    /// A tap on the tip with a hard object, of 1 N s; the sound is scaled anyway.
    pub fn of_tap(solution: &Solution, wall: Option<WallTones>) -> Self {
        let tip = solution.modes.first().map_or(0.0, |mode| mode.shape.length());
        Self::of_blow(solution, tip, [1.0, TAP], wall)
    }

    /// The sound at time `t` (s), in m/s².
    pub fn at(&self, t: f64) -> f64 {
        let tone = |Tone { frequency_hz, decay_1_s, amplitude_m_s2 }: &Tone| {
            amplitude_m_s2 * (-decay_1_s * t).exp() * (2.0 * PI * frequency_hz * t).sin()
        };
        self.tones.iter().map(tone).sum()
    }

    /// The largest acceleration in the first instants (m/s²), when the sound is loudest.
    fn peak(&self) -> f64 {
        /// Number of samples at the usual rate (44.1 kHz) in 20 ms.
        const INSTANTS: u32 = 882;
        (0..INSTANTS).map(|k| self.at(f64::from(k) / 44_100.0).abs()).fold(0.0, f64::max)
    }

    /// Duration of the sound (s): until the slowest tone has fallen to a thousandth.
    pub fn length(&self) -> f64 {
        let slowest = self.tones.iter().map(|tone| tone.decay_1_s).fold(f64::INFINITY, f64::min);
        (1000.0_f64.ln() / slowest).clamp(LENGTHS[0], LENGTHS[1])
    }

    /// Samples at that rate (1/s), 1 for the loudest place of such a blow; silence if nothing sounds.
    pub fn samples(&self, rate: u32) -> Vec<f64> {
        let count = (self.length() * f64::from(rate)) as u32;
        let all: Vec<f64> = (0..count).map(|k| self.at(f64::from(k) / f64::from(rate))).collect();
        let largest = all.iter().fold(self.loudest_m_s2, |most, p| most.max(p.abs()));
        let scale = if largest > 0.0 { 1.0 / largest } else { 0.0 };
        all.into_iter().map(|p| scale * p).collect()
    }
}

/// The accelerations (m/s²) of all modes at the place of a blow of that impulse (N s) and duration (s).
fn bending(solution: &Solution, x: f64, blow: [f64; 2]) -> impl Iterator<Item = f64> {
    let [impulse, duration] = blow;
    solution.modes.iter().map(move |mode| {
        let shape = mode.shape.deflection(x);
        impulse * shape * shape * mode.omega * half_sine(mode.omega * duration) / mode.modal_mass
    })
}

/// The tones of a wall after such a blow.
fn rung(wall: Vec<WallTone>, [impulse, duration]: [f64; 2]) -> Vec<Tone> {
    let tone = |WallTone { omega, damping_ratio, gain }: WallTone| Tone {
        frequency_hz: omega / (2.0 * PI),
        decay_1_s: damping_ratio * omega,
        amplitude_m_s2: impulse * gain * omega * half_sine(omega * duration),
    };
    wall.into_iter().map(tone).filter(|tone| tone.frequency_hz < HEARD).collect()
}

/// `S(ωT)`: the response to a half sine over that to an instantaneous blow of the same impulse.
fn half_sine(omega_t: f64) -> f64 {
    let share = omega_t / PI;
    // At ωT = π the quotient is π/4.
    if (share - 1.0).abs() < 1e-6 {
        return 0.25 * PI;
    }
    ((0.5 * omega_t).cos() / ((1.0 - share) * (1.0 + share))).abs()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modes::solve::{Request, solve};

    /// The spectrum by its integral, `∫ sin(πt/T) e^{−iωt} dt · π/(2T)`.
    #[test]
    fn a_half_sine_drives_what_its_spectrum_says() {
        const STEPS: usize = 20_000;
        for omega_t in [0.0, 0.5, 2.0, PI, 5.0, 9.0, 11.0] {
            let mut sum = [0.0; 2];
            for k in 0..STEPS {
                let t = (k as f64 + 0.5) / STEPS as f64;
                let force = 0.5 * PI * (PI * t).sin() / STEPS as f64;
                sum[0] += force * (omega_t * t).cos();
                sum[1] += force * (omega_t * t).sin();
            }
            let exact = sum[0].hypot(sum[1]);
            assert!((half_sine(omega_t) - exact).abs() < 1e-6, "{omega_t}: {exact}");
        }
    }

    /// A half sine of one and a half periods of a mode gives it nothing, and a short one `J φ² ω/m`.
    #[test]
    fn a_blow_of_one_and_a_half_periods_leaves_its_mode_at_rest() {
        let solution = solve(&Bat::builtin("r161").unwrap(), &Request::plain()).unwrap();
        for (k, mode) in solution.modes.iter().enumerate() {
            let of = |duration: f64| bending(&solution, 0.8, [0.2, duration]).nth(k).unwrap();
            let most = 0.2 * mode.shape.deflection(0.8).powi(2) * mode.omega / mode.modal_mass;
            assert!((of(1e-9) / most - 1.0).abs() < 1e-6);
            assert!(of(3.0 * PI / mode.omega) < 1e-9 * most);
        }
    }

    #[test]
    fn a_tone_has_its_mode_and_dies_out_with_its_damping() {
        let bat = Bat::builtin("r161").unwrap();
        let (_, solution) = as_heard(&bat, &solve(&bat, &Request::plain()).unwrap()).unwrap();
        let sound = Sound::of_tap(&solution, None);
        for (tone, mode) in sound.tones.iter().zip(&solution.modes) {
            assert_eq!(tone.frequency_hz, mode.frequency());
            assert!((tone.decay_1_s / (0.5 * ASSUMED_LOSS * mode.omega) - 1.0).abs() < 1e-12);
        }
        let lossy = bat.with(|parts| parts.material.loss_factor = 0.03).unwrap();
        let sound = Sound::of_tap(&solve(&lossy, &Request::plain()).unwrap(), None);
        let Tone { frequency_hz, decay_1_s, .. } = sound.tones[0];
        assert!((decay_1_s / (0.015 * 2.0 * PI * frequency_hz) - 1.0).abs() < 1e-3);
    }

    #[test]
    fn a_mode_is_silent_where_it_is_struck_at_its_node() {
        let bat = Bat::builtin("r161").unwrap();
        let solution = solve(&bat, &Request::plain()).unwrap();
        let sound = Sound::of_blow(&solution, solution.modes[0].nodes[1], [1.0, 0.0], None);
        let [first, second] = [0, 1].map(|k| sound.tones[k].amplitude_m_s2);
        assert!(first < 1e-9 * second, "{first} {second}");
    }
}
