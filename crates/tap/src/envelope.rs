//! The level of one tone in time: its band, shifted to frequency 0 and averaged.

use std::f64::consts::{PI, TAU};

use faer::c64;

/// Levels (dB) of the tone of that frequency (Hz) at that number of moments, each with the time of the middle of its
/// window (s). The windows are cos² of that length (s) and lie inside the samples.
pub fn envelope(samples: &[f64], rate: f64, hz: f64, window: f64, moments: usize) -> Vec<[f64; 2]> {
    let length = ((window * rate) as usize).max(2);
    let Some(room) = samples.len().checked_sub(length) else { return vec![] };
    let moment = |k: usize| {
        let from = room * k / (moments.max(2) - 1);
        let one = |(n, x): (usize, &f64)| {
            let shape = (PI * (n as f64 + 0.5) / length as f64).sin().powi(2);
            c64::cis(-TAU * hz * n as f64 / rate) * (x * shape)
        };
        let part = samples[from..from + length].iter().enumerate().map(one);
        let sum: c64 = part.sum();
        // A tone of size 1 is half of its window's sum.
        let size = sum.norm() * 4.0 / length as f64;
        [(from as f64 + 0.5 * length as f64) / rate, 20.0 * (size + 1e-12).log10()]
    };
    (0..moments).map(moment).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A damped tone of size 1 has the level `−20 δ t/ln 10` dB, up to the 0.05 dB by which this window rounds it.
    #[test]
    fn a_damped_tone_falls_on_a_line() {
        let (rate, decay) = (8000.0, 30.0);
        let tone = |n: usize| {
            let t = n as f64 / rate;
            (-decay * t).exp() * (TAU * 500.0 * t).sin()
        };
        let samples: Vec<f64> = (0..2400).map(tone).collect();
        let found = envelope(&samples, rate, 500.0, 0.02, 20);
        let (first, last) = (found[0], found[19]);
        let slope = (last[1] - first[1]) / (last[0] - first[0]);
        assert!((slope + 20.0 * decay / 10.0_f64.ln()).abs() < 0.1, "{slope}");
        for [t, level] in found {
            assert!((level + 20.0 * decay * t / 10.0_f64.ln()).abs() < 0.1, "{t} {level}");
        }
    }
}
