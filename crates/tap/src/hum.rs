//! Hum of the mains: one frequency near 50 or 60 Hz and its harmonics, found and removed.
//!
//! The hum is `Σ_h a_h cos(2π h f₀ t) + b_h sin(2π h f₀ t)`. f₀ maximises the logarithm of the periodogram over its
//! surroundings, summed over 15 harmonics. The amplitudes of 20 harmonics are fitted to the quieter half of the
//! recording.

use std::f64::consts::TAU;

use crate::filter::{Pass, filtered, levels, median, most};
use crate::least_squares::solve;
use crate::transform::power;

/// Mains frequencies (Hz), and their largest relative deviation; that of a recorder's clock is a thousandth of it.
const MAINS: [f64; 2] = [50.0, 60.0];
const OFF: f64 = 0.006;
/// Number of harmonics that are summed, and that are removed.
const SUMMED: usize = 15;
const REMOVED: usize = 20;
/// Least number of harmonics that exceed the periodogram around them, and the least factor.
const FEWEST: usize = 4;
const STANDS_OUT: f64 = 20.0;
/// A line counts as hum if no line within these distances (Hz) reaches it divided by this factor.
const APART: [f64; 2] = [0.6, 12.0];
const ALONE: f64 = 2.0;
/// Shortest recording in which hum and tones can be distinguished (s).
const SHORTEST: f64 = 0.7;

/// The frequency of the hum (Hz); `None` if there is none.
pub fn hum(samples: &[f64], rate: f64) -> Option<f64> {
    let seconds = samples.len() as f64 / rate;
    if seconds < SHORTEST {
        return None;
    }
    let count = samples.len() as f64;
    let hann = |n: usize| 0.5 - 0.5 * (TAU * (n as f64 + 0.5) / count).cos();
    let mut windowed: Vec<f64> = samples.iter().enumerate().map(|(n, x)| x * hann(n)).collect();
    // Twice as many lines as samples, so that a peak between two lines is found.
    windowed.resize(2 * samples.len(), 0.0);
    let spectrum = power(&windowed);
    let step = rate / windowed.len().next_power_of_two() as f64;
    let at = |hz: f64| {
        let place = hz / step;
        let (k, part) = (place as usize, place.fract());
        let next = spectrum.get(k + 1).copied().unwrap_or(0.0);
        spectrum.get(k).map_or(0.0, |here| (1.0 - part) * here + part * next)
    };
    // Each harmonic relative to its surroundings, so that neither the tone of a tap nor one loud harmonic decides.
    let ratios = |f0: f64| {
        (1..=SUMMED).map(move |h| h as f64 * f0).map(|hz| {
            let away = [4.8, 6.0, 7.2, 8.4, 9.6, 10.8, 12.0];
            let around: Vec<f64> = away.iter().flat_map(|d| [at(hz - d), at(hz + d)]).collect();
            at(hz) / median(&around).max(1e-300)
        })
    };
    // Evenly spaced taps have lines too, but at all multiples of their rate.
    let is_alone = |hz: f64| {
        let line = |hz: f64| ((hz / step) as usize).min(spectrum.len());
        let [below, above] = [[hz - APART[1], hz - APART[0]], [hz + APART[0], hz + APART[1]]];
        let around = [below, above].map(|[from, to]| most(&spectrum[line(from)..line(to)]));
        at(hz) > ALONE * most(&around)
    };
    let (mut best, mut most) = (0.0, f64::NEG_INFINITY);
    for mains in MAINS {
        let steps = (2.0 * OFF * mains * SUMMED as f64 * seconds * 2.0).ceil() as usize;
        for k in 0..=steps {
            let f0 = mains * (1.0 - OFF + 2.0 * OFF * k as f64 / steps as f64);
            let value = ratios(f0).map(|ratio| (ratio + 1.0).ln()).sum::<f64>();
            if value > most {
                (best, most) = (f0, value);
            }
        }
    }
    let heard: Vec<usize> = ratios(best)
        .enumerate()
        .filter(|(_, ratio)| *ratio > STANDS_OUT)
        .map(|(k, _)| k + 1)
        .collect();
    let alone = heard.iter().filter(|h| is_alone(**h as f64 * best)).count();
    // The h-th harmonic gives f₀ h times as accurately.
    let weight: f64 = heard.iter().map(|h| (h * h) as f64).sum();
    let sum: f64 =
        heard.iter().map(|h| *h as f64 * top(&spectrum, *h as f64 * best / step) * step).sum();
    (alone >= FEWEST).then(|| sum / weight)
}

/// The place of the line near there, by the parabola through the logarithms of three values.
fn top(spectrum: &[f64], near: f64) -> f64 {
    let (from, to) = (near as usize - 1, (near as usize + 3).min(spectrum.len() - 1));
    let k = (from..to).max_by(|a, b| spectrum[*a].total_cmp(&spectrum[*b])).unwrap_or(from);
    let [a, b, c] = [k - 1, k, k + 1].map(|k| (spectrum[k] + 1e-300).ln());
    let bent = a + c - 2.0 * b;
    k as f64 + if bent < 0.0 { (0.5 * (a - c) / bent).clamp(-0.5, 0.5) } else { 0.0 }
}

/// The samples without hum of that frequency (Hz).
pub fn without(samples: &[f64], rate: f64, f0: f64) -> Vec<f64> {
    let frame = (0.02 * rate) as usize;
    let loud = levels(&filtered(samples, rate, Pass::Above(400.0_f64.min(0.2 * rate))), frame);
    let half = median(&loud);
    let harmonics = (1..=REMOVED).take_while(|h| *h as f64 * f0 < 0.45 * rate).count();
    let columns = 2 * harmonics;
    let mut normal = vec![vec![0.0; columns + 1]; columns];
    let mut row = vec![0.0; columns + 1];
    let fill = |row: &mut [f64], n: usize| {
        let (sine, cosine) = (TAU * f0 * n as f64 / rate).sin_cos();
        let (mut s, mut c) = (sine, cosine);
        for pair in row.chunks_exact_mut(2) {
            (pair[0], pair[1]) = (c, s);
            (c, s) = (c * cosine - s * sine, s * cosine + c * sine);
        }
    };
    for (k, part) in samples.chunks(frame).enumerate().filter(|(k, _)| loud[*k] <= half) {
        for (j, x) in part.iter().enumerate() {
            fill(&mut row[..columns], k * frame + j);
            row[columns] = *x;
            for (i, line) in normal.iter_mut().enumerate() {
                let own = row[i];
                line[i..].iter_mut().zip(&row[i..]).for_each(|(sum, other)| *sum += own * other);
            }
        }
    }
    for i in 1..columns {
        let (above, below) = normal.split_at_mut(i);
        below[0].iter_mut().zip(above.iter()).for_each(|(entry, row)| *entry = row[i]);
    }
    let Some(amplitudes) = solve(normal) else { return samples.to_vec() };
    let clean = |(n, x): (usize, &f64)| {
        let mut row = vec![0.0; columns];
        fill(&mut row, n);
        x - row.iter().zip(&amplitudes).map(|(a, b)| a * b).sum::<f64>()
    };
    samples.iter().enumerate().map(clean).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn noise(count: usize) -> Vec<f64> {
        let mut state = 1_u64;
        let mut next = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as f64 / (1_u64 << 31) as f64 - 0.5
        };
        (0..count).map(|_| next()).collect()
    }

    /// Taps at exactly even times have lines at all multiples of their rate, some of them at harmonics of the mains.
    #[test]
    fn evenly_spaced_taps_are_no_hum_and_hide_none() {
        let (rate, noise) = (8000.0, noise(48_000));
        for apart in [0.5, 0.7, 0.9, 1.0, 1.1, 1.2] {
            let spacing = (apart * rate) as usize;
            let sound = |hum: f64| {
                let sample = |(n, noise): (usize, &f64)| {
                    let (t, wave) = ((n % spacing) as f64 / rate, TAU * 50.01 * n as f64 / rate);
                    let tone = |hz: f64| (-12e-3 * hz * t).exp() * (TAU * hz * t).sin();
                    let hums: f64 = (1..12).map(|h| (f64::from(h) * wave).cos()).sum();
                    tone(174.5) + tone(581.0) + tone(1187.0) + 3e-4 * noise + hum * hums
                };
                noise.iter().enumerate().map(sample).collect::<Vec<f64>>()
            };
            assert_eq!(hum(&sound(0.0), rate), None, "{apart} s");
            let f0 = hum(&sound(0.05), rate).unwrap();
            assert!((f0 - 50.01).abs() < 0.02, "{apart} s: {f0}");
        }
    }

    #[test]
    fn hum_is_found_and_taken_off_and_noise_is_none() {
        let rate = 8000.0;
        let still = noise(24_000);
        assert_eq!(hum(&still, rate), None);
        let own = |n: usize| {
            let t = n as f64 / rate;
            (1..12).map(|h| (TAU * 60.02 * h as f64 * t + h as f64).cos() / h as f64).sum::<f64>()
        };
        let loud: Vec<f64> = still.iter().enumerate().map(|(n, x)| 1e-3 * x + own(n)).collect();
        let f0 = hum(&loud, rate).unwrap();
        assert!((f0 - 60.02).abs() < 0.02, "{f0}");
        let left = without(&loud, rate, f0);
        let power = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>();
        assert!(power(&left) < 1e-2 * power(&loud), "{}", power(&left) / power(&loud));
    }
}
