//! The tones of a recording as lines for the search of labels.
//!
//! A constant loss factor η makes wood stiffer with frequency: E is proportional to `f^(2η/π)`, so that
//!
//! ```text
//! f_n = F_n (f_n/f₁)^(η/π)
//! ```
//!
//! with F_n for the stiffness at the lowest tone f₁. The lines are the F_n.
//!
//! # Source
//!
//! The relation of Kramers and Kronig for a loss factor that is nearly constant: A. D. Nashif, D. I. G. Jones,
//! J. P. Henderson, Vibration Damping (Wiley, 1985), as E′ ∝ ω^(2η/π).

use std::f64::consts::PI;

use schemars::JsonSchema;
use serde::Serialize;
use sweetspot_tap::analysis::Analysis;
use sweetspot_tap::tones::Tone;

use crate::calibrate::calibration::NINETY_FIVE;
use crate::calibrate::readings::Reading;

/// A line: a tone, or two twins.
#[derive(Debug, Clone, PartialEq)]
pub struct HeardLine {
    /// Which tones it is.
    pub tones: Vec<usize>,
    /// Frequency, by the stiffness at the lowest tone (Hz).
    pub frequency: Reading,
    /// Factor by which the recorded frequency is higher.
    pub stiffer: f64,
    /// Level of the loudest of its tones (dB).
    pub level: f64,
}

/// A value with its interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct Within {
    /// The value.
    pub value: f64,
    /// Interval of 95 % confidence.
    pub interval95: [f64; 2],
}

impl Within {
    /// A frequency (Hz) of a tone.
    pub fn frequency(tone: &Tone) -> Self {
        let value = tone.pole.hz;
        let by = NINETY_FIVE * tone.deviations[0] * value;
        Self { value, interval95: [value - by, value + by] }
    }

    /// The loss factor of a tone.
    pub fn loss(tone: &Tone) -> Self {
        let (value, by) = (tone.pole.loss(), NINETY_FIVE * tone.deviations[1]);
        Self { value, interval95: [-by, by].map(|by| value * by.exp()) }
    }
}

/// The lines of all tones, rising; for wood, which has two planes of the grain, twins are merged.
pub fn lines(analysis: &Analysis, wood: bool) -> Vec<HeardLine> {
    let tones = &analysis.tones;
    let losses = tones.iter().filter(|_| analysis.has_loss).map(|tone| tone.pole.loss());
    let loss = losses.reduce(f64::min).unwrap_or(0.0);
    let mut all: Vec<HeardLine> = vec![];
    for (k, tone) in tones.iter().enumerate() {
        // Twins follow each other; of a pair the second joins the first.
        let is_twin = |t: &usize| Some(tones[*t].pole.hz) == tone.twin;
        let before = all.last_mut().filter(|line| wood && line.tones.iter().any(is_twin));
        let stiffer = (tone.pole.hz / tones[0].pole.hz).powf(loss / PI);
        let frequency =
            Reading { value: tone.pole.hz / stiffer, deviation: tone.deviations[0] * tone.pole.hz };
        match before {
            Some(line) => {
                let (a, b) = (line.frequency, frequency);
                let half = 0.5 * (b.value - a.value);
                let deviation = half.hypot(a.deviation.max(b.deviation));
                line.frequency = Reading { value: a.value + half, deviation };
                line.level = line.level.max(tone.level);
                line.tones.push(k);
            }
            None => all.push(HeardLine { tones: vec![k], frequency, stiffer, level: tone.level }),
        }
    }
    all
}
