//! The readings of a bat, their errors, and the prior knowledge.

use std::f64::consts::TAU;

use serde::Serialize;

/// A reading and its standard deviation, in the same unit.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Reading {
    /// The reading.
    pub value: f64,
    /// Its error, one standard deviation.
    pub deviation: f64,
}

/// A bat that swings as a pendulum.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Pendulum {
    /// Position of the pivot (m from the knob end).
    pub pivot: f64,
    /// Time of a swing there and back (s).
    pub period: Reading,
}

/// A line in the spectrum of a tap.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct SpectralLine {
    /// Frequency (Hz).
    pub frequency: Reading,
    /// Number of its bending mode, from 1; `None` if not given.
    pub mode: Option<usize>,
}

/// A tone that died out.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct RingDown {
    /// Which bending mode it is, from 1.
    pub mode: usize,
    /// Number of cycles N.
    pub cycles: f64,
    /// Amplitude `a_N/a₀` after them.
    pub ratio: f64,
}

impl RingDown {
    /// A tone of that loss factor: `ratio = e^{−π η N}` of one cycle.
    pub fn of_loss(mode: usize, loss: f64) -> Self {
        Self { mode, cycles: 1.0, ratio: (-0.5 * TAU * loss).exp() }
    }

    /// Damping ratio `ζ = ln(a₀/a_N)/(2π N)`.
    pub fn damping_ratio(&self) -> f64 {
        -self.ratio.ln() / (TAU * self.cycles)
    }

    /// Loss factor of the material that damps so, `η = 2ζ`.
    pub fn loss_factor(&self) -> f64 {
        2.0 * self.damping_ratio()
    }
}

/// Prior uncertainty of G, as the standard deviation of a natural logarithm.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ShearPrior {
    /// Of G/E: stiff wood is stiff in shear too.
    OverYoung(f64),
    /// Of G alone, independent of E.
    Alone(f64),
}

/// Prior uncertainty of a bat's wood, as standard deviations of natural logarithms.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Priors {
    /// Of E.
    pub youngs_modulus: f64,
    /// Of G.
    pub shear: ShearPrior,
    /// Of the density.
    pub density: f64,
    /// Correlation of E and density.
    pub correlation: f64,
    /// Of E in the barrel over E in the handle.
    pub modulus_ratio: f64,
    /// Correlation of the densities of handle and barrel.
    pub densities_together: f64,
}

impl Default for Priors {
    /// Wood of one species: E 22 %, density 10 % (the scatter of [`sweetspot::Material::scatter`]), correlated by 0.6;
    /// G/E 35 %, which covers 0.058 to 0.111 of species; handle and barrel of one billet 0.95 and 8 %, our choice.
    fn default() -> Self {
        Self {
            youngs_modulus: 0.22,
            shear: ShearPrior::OverYoung(0.35),
            density: 0.10,
            correlation: 0.6,
            modulus_ratio: 0.08,
            densities_together: 0.95,
        }
    }
}

/// Everything that was measured of a bat.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BatReadings {
    /// Mass with everything attached (kg).
    pub mass: Option<Reading>,
    /// Balance point from the knob end (m).
    pub balance_point: Option<Reading>,
    /// A swing as a pendulum.
    pub pendulum: Option<Pendulum>,
    /// Lines in the spectrum of a tap.
    pub lines: Vec<SpectralLine>,
    /// Number of measured modes whose shapes match no bending mode of the bat.
    #[serde(skip)]
    pub unlike: usize,
    /// Tones that died out.
    pub ring_down: Vec<RingDown>,
    /// Relative error of the model in a frequency, one standard deviation.
    pub model: f64,
    /// The prior knowledge.
    pub priors: Priors,
}

impl BatReadings {
    /// Relative error of the beam model in a frequency: 0.3 %.
    pub const MODEL: f64 = 3e-3;
}

impl Default for BatReadings {
    fn default() -> Self {
        Self {
            mass: None,
            balance_point: None,
            pendulum: None,
            lines: vec![],
            unlike: 0,
            ring_down: vec![],
            model: Self::MODEL,
            priors: Priors::default(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tone_that_falls_to_a_share_has_that_loss_factor() {
        let tone = RingDown { mode: 1, cycles: 20.0, ratio: 0.4 };
        let zeta = tone.damping_ratio();
        assert!(((-zeta * TAU * 20.0).exp() - 0.4).abs() < 1e-15);
        assert_eq!(tone.loss_factor(), 2.0 * zeta);
    }
}
