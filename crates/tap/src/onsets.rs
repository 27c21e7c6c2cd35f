//! When does a tap begin, and when does its ringing begin?
//!
//! A tap is a rise of the level in the band from 400 Hz to 12 kHz, in frames of 2 ms. It begins with the first sample
//! above a quarter of the largest one in the next 30 ms, because codecs smear it up to 20 ms ahead. Ringing begins
//! after the last bounce. Bounces are found in the residual of linear prediction: it predicts ringing, but not a blow.
//!
//! # Source
//!
//! J. Makhoul, Linear prediction: a tutorial review, Proc. IEEE 63 (1975) 561, equations 38 to 40.

use crate::filter::{Pass, filtered, levels, most, quantile};

/// Frame (s).
const FRAME: f64 = 2e-3;
/// Least rise of a tap above the loudest of the three frames before it, least level above the quiet of the recording,
/// and largest distance below the loudest tap (dB).
const RISE: f64 = 9.0;
const ABOVE_QUIET: f64 = 15.0;
const BELOW_LOUDEST: f64 = 40.0;
/// Time in which the beginning is sought (s), and its share of the largest sample there.
const LOOK: f64 = 0.03;
const SHARE: f64 = 0.25;
/// Onsets closer than this are one tap (s).
const APART: f64 = 0.15;
/// Least fall of a tap, and the time in which it falls (dB, s).
const FALL: f64 = 12.0;
const FALLEN: f64 = 0.6;
/// Least rise of a bounce, its least level above the usual (dB), and the times after a tap to search for it (s).
const BOUNCE: f64 = 4.0;
const BOUNCE_ABOVE: f64 = 4.5;
const BOUNCES: [f64; 2] = [0.01, 0.14];
/// Largest distance of a bounce below its tap (dB).
const FAINT: f64 = 25.0;
/// Number of samples that predict the next one.
const ORDER: usize = 64;

/// A tap in a recording.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Onset {
    /// First sample.
    pub at: usize,
    /// First sample of the last bounce, or of the tap.
    pub rings: usize,
    /// Number of bounces.
    pub bounces: usize,
}

/// The taps of a recording.
pub fn onsets(samples: &[f64], rate: f64) -> Vec<Onset> {
    let low = filtered(samples, rate, Pass::Above(400.0));
    let band = match rate > 30_000.0 {
        true => filtered(&low, rate, Pass::Below(12_000.0)),
        false => low,
    };
    let frame = (FRAME * rate).round() as usize;
    let loud = levels(&band, frame);
    let quiet = quantile(&loud, 0.15);
    let loudest = most(&loud);
    let mut found: Vec<usize> = vec![];
    for k in 1..loud.len() {
        let least = (before(&loud, k) + RISE).max(quiet + ABOVE_QUIET).max(loudest - BELOW_LOUDEST);
        if loud[k] <= least {
            continue;
        }
        let at = begins(&band, (k * frame).saturating_sub(frame / 2), (LOOK * rate) as usize);
        if found.last().is_none_or(|last| at as f64 > *last as f64 + APART * rate) {
            found.push(at);
        }
    }
    let falls = |k: &usize| {
        let at = found[*k];
        let end = found.get(k + 1).copied().unwrap_or(samples.len());
        let part = |from: f64, to: f64| {
            let place = |t: f64| ((at as f64 + t * rate) as usize).min(end) / frame;
            &loud[place(from).min(loud.len() - 1)..=place(to).min(loud.len() - 1)]
        };
        quantile(part(0.1, FALLEN), 0.1) < most(part(0.0, 0.03)) - FALL
    };
    let taps: Vec<usize> = (0..found.len()).filter(falls).map(|k| found[k]).collect();
    taps.iter().map(|at| with_bounces(samples, rate, *at)).collect()
}

/// The loudest of the three frames before one.
fn before(levels: &[f64], frame: usize) -> f64 {
    most(&levels[frame.saturating_sub(3)..frame])
}

/// The first sample from `from` on that exceeds a share of the largest among the next ones.
fn begins(samples: &[f64], from: usize, look: usize) -> usize {
    let part = &samples[from..(from + look).min(samples.len())];
    let most = part.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    from + part.iter().position(|x| x.abs() >= SHARE * most).unwrap_or(0)
}

fn with_bounces(samples: &[f64], rate: f64, at: usize) -> Onset {
    let frame = (FRAME * rate).round() as usize;
    let end = (at + (BOUNCES[1] * rate) as usize).min(samples.len());
    // Blows stand out of the residual of a linear prediction, which removes ringing.
    let struck = unpredicted(&samples[at.saturating_sub(ORDER)..end]);
    let struck = &struck[at.min(ORDER)..];
    let loud = levels(struck, frame);
    let first = (BOUNCES[0] / FRAME).round() as usize;
    let usual = quantile(loud.get(first..).unwrap_or(&[]), 0.5);
    let struck_at = most(&loud[..loud.len().min(3)]);
    let mut onset = Onset { at, rings: at, bounces: 0 };
    let mut k = first;
    while k < loud.len() {
        let least = (before(&loud, k) + BOUNCE).max(usual + BOUNCE_ABOVE).max(struck_at - FAINT);
        if loud[k] > least {
            onset.rings = at + begins(struck, k * frame - frame / 2, 2 * frame);
            onset.bounces += 1;
            k += 4;
        }
        k += 1;
    }
    onset
}

/// The residual of a linear prediction of the samples, by Levinson's recursion on their correlation.
fn unpredicted(samples: &[f64]) -> Vec<f64> {
    let product = |lag: usize| samples.iter().zip(&samples[lag..]).map(|(a, b)| a * b).sum::<f64>();
    let mut correlation: Vec<f64> =
        (0..=ORDER.min(samples.len().saturating_sub(1))).map(product).collect();
    correlation.iter_mut().take(1).for_each(|own| *own = *own * (1.0 + 1e-7) + 1e-30);
    let (mut filter, mut power) = (vec![1.0], correlation.first().copied().unwrap_or(1.0));
    for order in 1..correlation.len() {
        let sum: f64 =
            filter.iter().zip(correlation[1..=order].iter().rev()).map(|(a, r)| a * r).sum();
        let turn = -sum / power;
        filter.push(0.0);
        let back: Vec<f64> = filter.iter().rev().copied().collect();
        filter.iter_mut().zip(back).for_each(|(a, b)| *a += turn * b);
        power *= 1.0 - turn * turn;
    }
    let left = |n: usize| -> f64 {
        filter.iter().zip(samples[..=n].iter().rev()).map(|(a, x)| a * x).sum()
    };
    (0..samples.len()).map(left).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn taps(rate: f64, times: &[(f64, f64)]) -> Vec<f64> {
        let ring = |t: f64| {
            let tone =
                |hz: f64| (-0.01 * std::f64::consts::PI * hz * t).exp() * (TAU * hz * t).cos();
            0.2 * tone(600.0) + 0.2 * tone(1900.0) + 0.2 * tone(5100.0) + 0.2 * tone(6300.0)
        };
        let sum = |t: f64| {
            let all = times.iter().filter(|(at, _)| t >= *at);
            all.map(|(at, size)| size * ring(t - at)).sum::<f64>()
        };
        (0..(3.0 * rate) as usize).map(|n| sum(n as f64 / rate)).collect()
    }

    #[test]
    fn a_tap_is_found_to_the_sample_and_its_last_bounce_too() {
        let rate = 48_000.0;
        let found = onsets(&taps(rate, &[(0.5, 1.0), (1.5, 0.4), (1.56, 0.2)]), rate);
        assert_eq!(found.len(), 2, "{found:?}");
        let near = |sample: usize, time: f64| (sample as f64 - time * rate).abs() < 12.0;
        assert!(near(found[0].at, 0.5) && near(found[1].at, 1.5), "{found:?}");
        assert_eq!((found[0].bounces, found[1].bounces), (0, 1));
        assert!(near(found[0].rings, 0.5) && near(found[1].rings, 1.56), "{found:?}");
    }

    #[test]
    fn silence_and_a_steady_tone_have_no_tap() {
        let tone: Vec<f64> = (0..48_000).map(|n| (0.1 * n as f64).sin()).collect();
        assert!(onsets(&tone[..], 48_000.0).is_empty());
        assert!(onsets(&[0.0; 9000], 48_000.0).is_empty());
        assert!(onsets(&[], 48_000.0).is_empty());
    }
}
