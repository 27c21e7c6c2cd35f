//! Which tones may there be? Peaks of the spectrum after the taps that exceed the ground and their surroundings.
//!
//! Low tones ring for long and lie close to each other; high ones end soon. There are therefore three spectra, with
//! windows that rise in a twentieth of their length and fall over the rest. The ground is that of the quietest quarter
//! of windows before and between taps, smoothed over frequency, so that a tone still ringing is not taken for ground.

use std::f64::consts::PI;

use crate::filter::{median, most, quantile};
use crate::transform::power;

/// Lengths of windows (s), and which frequencies each is for (Hz).
const SCALES: [(f64, [f64; 2]); 3] =
    [(0.5, [60.0, 700.0]), (0.16, [450.0, 2200.0]), (0.06, [1500.0, 20_000.0])];
/// Least level of a peak above the ground, and above its surroundings (dB).
const ABOVE_GROUND: f64 = 8.0;
const ABOVE_AROUND: f64 = 5.0;
/// Relative widths of a peak's surroundings, and of the range in which it is the largest.
const AROUND: f64 = 0.08;
const LARGEST: f64 = 0.012;
/// Relative width over which the ground is smoothed.
const SMOOTH: f64 = 0.15;
/// Largest distance of a peak below the highest (dB).
const RANGE: f64 = 55.0;

/// A peak.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// Frequency (Hz).
    pub hz: f64,
    /// Level (dB).
    pub level: f64,
}

/// Levels of the ringing and of the ground over frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct Spectrum {
    /// Distance of two lines (Hz).
    pub step: f64,
    /// Levels of the taps (dB).
    pub levels: Vec<f64>,
    /// Levels of the ground (dB).
    pub ground: Vec<f64>,
}

/// The peaks of a recording whose taps ring in these stretches of samples, rising, up to `highest` (Hz).
pub fn peaks(samples: &[f64], rate: f64, rings: &[[usize; 2]], highest: f64) -> Vec<Peak> {
    let mut all: Vec<Peak> = vec![];
    for (seconds, [low, high]) in SCALES {
        let spectrum = Spectrum::of(samples, rate, rings, seconds);
        let found = spectrum.peaks([low, high.min(highest)]);
        for peak in found {
            let close = |other: &Peak| (other.hz / peak.hz - 1.0).abs() < LARGEST;
            if !all.iter().any(close) {
                all.push(peak);
            }
        }
    }
    let highest = most(&all.iter().map(|peak| peak.level).collect::<Vec<_>>());
    all.retain(|peak| peak.level > highest - RANGE);
    all.sort_by(|a, b| a.hz.total_cmp(&b.hz));
    all
}

impl Spectrum {
    /// The spectrum of the ringing in these stretches, in windows of that length (s).
    pub fn of(samples: &[f64], rate: f64, rings: &[[usize; 2]], seconds: f64) -> Self {
        let length = (seconds * rate) as usize;
        let line = rate / length.next_power_of_two() as f64;
        let of = |from: usize, to: usize| {
            let part = &samples[from.min(samples.len())..to.min(from + length).min(samples.len())];
            let mut shaped = windowed(part);
            shaped.resize(length, 0.0);
            power(&shaped)
        };
        let heard: Vec<Vec<f64>> = rings.iter().map(|[from, to]| of(*from, *to)).collect();
        let frames = quiet_frames(samples.len(), rings, length);
        let mut quiet: Vec<Vec<f64>> = frames.iter().map(|[from, to]| of(*from, *to)).collect();
        quiet.sort_by(|a, b| a.iter().sum::<f64>().total_cmp(&b.iter().sum::<f64>()));
        quiet.truncate(quiet.len().div_ceil(4).max(2));
        let lines = length.next_power_of_two() / 2 + 1;
        let mean = |all: &[Vec<f64>], k: usize| {
            all.iter().map(|one| one[k]).sum::<f64>() / all.len().max(1) as f64
        };
        let db = |x: f64| 10.0 * (x + 1e-24).log10();
        let levels = (0..lines).map(|k| db(mean(&heard, k))).collect();
        let rough: Vec<f64> = (0..lines).map(|k| db(mean(&quiet, k))).collect();
        Self { step: line, levels, ground: smoothed(&rough) }
    }

    fn peaks(&self, [low, high]: [f64; 2]) -> Vec<Peak> {
        let at = |hz: f64| ((hz / self.step) as usize).min(self.levels.len() - 1);
        let mut found = vec![];
        for k in at(low).max(2)..at(high) {
            let (hz, level) = (k as f64 * self.step, self.levels[k]);
            let near = &self.levels
                [at(hz * (1.0 - LARGEST)).min(k - 1)..=at(hz * (1.0 + LARGEST)).max(k + 1)];
            if most(near) > level {
                continue;
            }
            let wide = (AROUND * hz).max(8.0 * self.step);
            let around = &self.levels[at((hz - wide).max(0.0))..=at(hz + wide)];
            let least = (self.ground[k] + ABOVE_GROUND).max(quantile(around, 0.3) + ABOVE_AROUND);
            if level > least {
                let (a, b) = (self.levels[k - 1], self.levels[k + 1]);
                let bent = a + b - 2.0 * level;
                let part = if bent < 0.0 { (0.5 * (a - b) / bent).clamp(-0.5, 0.5) } else { 0.0 };
                found.push(Peak { hz: (k as f64 + part) * self.step, level });
            }
        }
        found
    }
}

/// Rises in a twentieth, falls over the rest.
fn windowed(samples: &[f64]) -> Vec<f64> {
    let count = samples.len() as f64;
    let shape = |n: usize| {
        let t = (n as f64 + 0.5) / count;
        let turn =
            if t < 0.05 { 0.5 * PI * (1.0 - t / 0.05) } else { 0.5 * PI * (t - 0.05) / 0.95 };
        turn.cos().powi(2)
    };
    samples.iter().enumerate().map(|(n, x)| x * shape(n)).collect()
}

/// Possibly quiet frames: everything before the first tap, and the second halves between taps.
fn quiet_frames(count: usize, rings: &[[usize; 2]], length: usize) -> Vec<[usize; 2]> {
    let first = rings.first().map_or(count, |[from, _]| from.saturating_sub(length / 8));
    let between = rings.iter().map(|[from, to]| [from + (to - from) / 2, *to]);
    let mut all = vec![];
    for [from, to] in [[0, first]].into_iter().chain(between) {
        let mut at = from;
        while at + length <= to {
            all.push([at, at + length]);
            at += length / 2;
        }
    }
    if all.is_empty() {
        // Only the ends of taps: these windows are shorter and have less power than the ground.
        all.extend(rings.iter().map(|[from, to]| [to.saturating_sub(length).max(*from), *to]));
    }
    all
}

/// The median of every line's surroundings.
fn smoothed(levels: &[f64]) -> Vec<f64> {
    // Where it changes little, all lines of a group have the value of one.
    let mut smooth = Vec::with_capacity(levels.len());
    while smooth.len() < levels.len() {
        let k = smooth.len();
        let half = ((SMOOTH * k as f64) as usize).max(6);
        let value = median(&levels[k.saturating_sub(half)..(k + half + 1).min(levels.len())]);
        let group = (half / 8).max(1).min(levels.len() - k);
        smooth.extend(std::iter::repeat_n(value, group));
    }
    smooth
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn damped_tones_are_peaks_and_nothing_else_is() {
        let rate = 16_000.0;
        let tones = [170.0, 590.0, 1200.0, 1900.0];
        let sample = |n: usize| {
            let t = n as f64 / rate - 0.6;
            let noise = 1e-4 * ((n * n % 7919) as f64 / 7919.0 - 0.5);
            let tone = |hz: &f64| (-PI * 0.01 * hz * t).exp() * (TAU * hz * t).sin();
            noise + if t > 0.0 { tones.iter().map(tone).sum::<f64>() } else { 0.0 }
        };
        let samples: Vec<f64> = (0..32_000).map(sample).collect();
        let found = peaks(&samples, rate, &[[9600, 32_000]], 6000.0);
        assert_eq!(found.len(), tones.len(), "{found:?}");
        for (peak, hz) in found.iter().zip(tones) {
            assert!((peak.hz / hz - 1.0).abs() < 5e-3, "{found:?}");
        }
    }
}
