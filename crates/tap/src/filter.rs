//! Causal filters, so that nothing appears before its onset, and levels of short frames.
//!
//! # Source
//!
//! Butterworth's filter of fourth order as two of second order, by the bilinear transform (A. V. Oppenheim,
//! R. W. Schafer, Discrete-Time Signal Processing, section 7.1).

use std::f64::consts::PI;

/// The frequencies that a filter passes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Pass {
    /// Frequencies above this one (Hz).
    Above(f64),
    /// Frequencies below this one (Hz).
    Below(f64),
}

/// The samples through a filter of fourth order.
pub fn filtered(samples: &[f64], rate: f64, pass: Pass) -> Vec<f64> {
    let mut out = samples.to_vec();
    // 2 sin of the angles of Butterworth's poles.
    for damping in [(PI / 8.0).sin(), (3.0 * PI / 8.0).sin()].map(|sine| 2.0 * sine) {
        second_order(&mut out, rate, pass, damping);
    }
    out
}

fn second_order(samples: &mut [f64], rate: f64, pass: Pass, damping: f64) {
    let (Pass::Above(hz) | Pass::Below(hz)) = pass;
    let warped = (PI * (hz / rate).min(0.49)).tan();
    let square = warped * warped;
    let scale = 1.0 / (1.0 + damping * warped + square);
    let feedback = [2.0 * (square - 1.0) * scale, (1.0 - damping * warped + square) * scale];
    let (first, middle) = match pass {
        Pass::Above(_) => (scale, -2.0 * scale),
        Pass::Below(_) => (square * scale, 2.0 * square * scale),
    };
    let [mut a, mut b] = [0.0; 2];
    for sample in samples {
        let x = *sample;
        let y = first * x + a;
        a = middle * x - feedback[0] * y + b;
        b = first * x - feedback[1] * y;
        *sample = y;
    }
}

/// Levels of frames of that many samples (dB, of the mean square).
pub fn levels(samples: &[f64], frame: usize) -> Vec<f64> {
    let level = |frame: &[f64]| {
        let mean = frame.iter().map(|x| x * x).sum::<f64>() / frame.len() as f64;
        10.0 * (mean + 1e-20).log10()
    };
    samples.chunks(frame.max(1)).map(level).collect()
}

/// The largest value; −∞ if there are none.
pub fn most(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::NEG_INFINITY, f64::max)
}

fn sorted(values: &[f64]) -> Vec<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted
}

/// The value below which that share of all lies; 0 if there are none.
pub fn quantile(values: &[f64], share: f64) -> f64 {
    let place = share * values.len().saturating_sub(1) as f64;
    sorted(values).get(place.round() as usize).copied().unwrap_or(0.0)
}

/// The middle one; the mean of the middle two of an even number; 0 if there are none.
pub fn median(values: &[f64]) -> f64 {
    match sorted(values)[..] {
        [] => 0.0,
        ref all => 0.5 * (all[(all.len() - 1) / 2] + all[all.len() / 2]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// `|H|² = 1/(1 + (f/f_c)^±8)` with frequencies warped by the bilinear transform.
    #[test]
    fn butterworth_passes_what_its_formula_says() {
        let rate = 8000.0;
        for (pass, sign) in [(Pass::Above(1000.0), -8), (Pass::Below(1000.0), 8)] {
            for hz in [500.0, 1000.0, 2000.0] {
                let tone = (0..8000).map(|n| (TAU * hz * n as f64 / rate).sin());
                let out = filtered(&tone.collect::<Vec<_>>(), rate, pass);
                let square = out[4000..].iter().map(|y| y * y).sum::<f64>() / 2000.0;
                let ratio = (PI * hz / rate).tan() / (PI * 1000.0 / rate).tan();
                let exact = 1.0 / (1.0 + ratio.powi(sign));
                assert!((square - exact).abs() < 1e-6, "{pass:?} {hz}: {square} {exact}");
            }
        }
    }

    #[test]
    fn the_median_of_an_even_number_is_between() {
        assert_eq!(median(&[4.0, 1.0, 2.0, 3.0]), 2.5);
        assert_eq!(median(&[5.0, 1.0, 2.0]), 2.0);
        assert_eq!(quantile(&[], 0.5), 0.0);
    }
}
