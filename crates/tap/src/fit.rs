//! Damped tones that taps share, by least squares.
//!
//! In a band of the discrete transform of every tap,
//!
//! ```text
//! X(ν) = Σ_p a_p D(ν; f_p, δ_p) + a_p* D(ν; −f_p, δ_p) + c₀ + c₁ (ν − ν₀)
//! D(ν; f, δ) = Σ_n e^{(−δ + 2πi (f − ν)) n/r} = (1 − z^N)/(1 − z),   z = e^{(−δ + 2πi (f − ν))/r}
//! ```
//!
//! exactly, for N samples at the rate r. Frequencies f and decays δ belong to the object, amplitudes a and ground c to
//! a tap. Amplitudes and ground are linear and eliminated (variable projection); the others follow by damped
//! Gauss-Newton.
//!
//! # Source
//!
//! G. H. Golub, V. Pereyra, The differentiation of pseudo-inverses and nonlinear least squares problems whose variables
//! separate, SIAM J. Numer. Anal. 10 (1973) 413.

use std::f64::consts::{PI, TAU};

use faer::c64;

use crate::least_squares::{Basis, inverse, real_dot, solve};

/// A damped tone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pole {
    /// Frequency (Hz).
    pub hz: f64,
    /// Decay (1/s).
    pub decay: f64,
}

impl Pole {
    /// The tone of that loss factor, `δ = π f η`.
    pub fn of(hz: f64, loss: f64) -> Self {
        Self { hz, decay: PI * hz * loss }
    }

    /// The loss factor.
    pub fn loss(self) -> f64 {
        self.decay / (PI * self.hz)
    }

    /// The pole after a step: of its frequency in units of δ/π, and of the logarithm of its decay.
    fn stepped(self, step: &[f64]) -> Self {
        Self { hz: self.hz + step[0] * self.decay / PI, decay: self.decay * step[1].exp() }
    }
}

/// A band of one tap's transform.
#[derive(Debug, Clone, PartialEq)]
pub struct Band {
    /// Index of its tap.
    pub tap: usize,
    rate: f64,
    samples: usize,
    /// Frequencies (Hz), and the transform there.
    lines: Vec<(f64, c64)>,
    weight: f64,
}

/// Least number of lines that distinguishes a tone from the ground.
const FEWEST_LINES: usize = 7;

impl Band {
    /// The lines of these samples within `half` of the middle (Hz); `None` if there are too few.
    pub fn new(tap: usize, samples: &[f64], rate: f64, middle: f64, half: f64) -> Option<Self> {
        let step = rate / samples.len().max(1) as f64;
        let first = ((middle - half) / step).ceil().max(1.0) as usize;
        let last = ((middle + half).min(0.49 * rate) / step).floor() as usize;
        if last + 1 < first + FEWEST_LINES {
            return None;
        }
        let turns: Vec<f64> =
            (first..=last).map(|k| TAU * k as f64 / samples.len() as f64).collect();
        let twice: Vec<f64> = turns.iter().map(|turn| 2.0 * turn.cos()).collect();
        let mut one = vec![0.0; turns.len()];
        let mut two = one.clone();
        for x in samples {
            for ((a, b), twice) in one.iter_mut().zip(&mut two).zip(&twice) {
                (*a, *b) = (x + twice * *a - *b, *a);
            }
        }
        // Goertzel's sums, shifted by N − 1 samples, which equals one sample back.
        let line = |(k, turn): (usize, &f64)| {
            let sum = c64::from(one[k]) - c64::cis(-turn) * two[k];
            ((first + k) as f64 * step, sum * c64::cis(*turn))
        };
        let lines = turns.iter().enumerate().map(line).collect();
        Some(Self { tap, rate, samples: samples.len(), lines, weight: 1.0 })
    }

    /// The lines.
    pub fn lines(&self) -> &[(f64, c64)] {
        &self.lines
    }

    fn transform(&self, hz: f64, pole: Pole, nu: f64) -> c64 {
        let exponent = c64::new(-pole.decay, TAU * (hz - nu)) / self.rate;
        (1.0 - (exponent * self.samples as f64).exp()) / (1.0 - exponent.exp())
    }

    /// Columns of these poles in every line, for real and imaginary part of each amplitude, then those of the ground.
    fn columns(&self, poles: &[Pole]) -> Vec<Vec<c64>> {
        let own = |pole: &Pole| {
            let both = |(nu, _): &(f64, c64)| {
                let own = self.transform(pole.hz, *pole, *nu);
                let mirror = self.transform(-pole.hz, *pole, *nu);
                (own + mirror, c64::I * (own - mirror))
            };
            let (real, imaginary) = self.lines.iter().map(both).unzip();
            [real, imaginary]
        };
        let (first, last) = (self.lines[0].0, self.lines[self.lines.len() - 1].0);
        let slope = |nu: f64| (2.0 * nu - first - last) / (last - first);
        let ground = [c64::ONE, c64::I].into_iter().flat_map(|unit| {
            let slope = self.lines.iter().map(|(nu, _)| unit * slope(*nu));
            [vec![unit; self.lines.len()], slope.collect()]
        });
        poles.iter().flat_map(own).chain(ground).collect()
    }

    /// The residual of these poles and the ground.
    fn left(&self, poles: &[Pole]) -> Vec<c64> {
        let mut target: Vec<c64> = self.lines.iter().map(|(_, x)| *x).collect();
        Basis::of(self.columns(poles), real_dot).take_off(&mut target);
        target
    }

    fn square(&self, poles: &[Pole]) -> f64 {
        square(&self.left(poles))
    }

    /// The share of the band's power above the ground that these poles leave.
    pub fn misfit(&self, poles: &[Pole]) -> f64 {
        self.square(poles) / self.square(&[]).max(1e-300)
    }

    /// The logarithm of the first pole's amplitude at the beginning of the band, given the other poles.
    pub fn amplitude(&self, poles: &[Pole]) -> f64 {
        let own = self.square(&poles[1..]) - self.square(poles);
        let of_one = square(&self.columns(&poles[..1])[0]);
        0.5 * (own.max(1e-300) / of_one.max(1e-300)).ln()
    }

    /// Degrees of freedom with that number of poles.
    fn freedom(&self, poles: usize) -> f64 {
        (2 * self.lines.len()).saturating_sub(2 * poles + 4).max(1) as f64
    }

    /// Weights the band by the residual of these poles.
    pub fn weigh(&mut self, poles: &[Pole]) {
        self.weight = (self.freedom(poles.len()) / self.square(poles).max(1e-300)).sqrt();
    }
}

/// Fitted poles and their uncertainty.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// The poles.
    pub poles: Vec<Pole>,
    /// Standard deviations of every pole's frequency (relative) and decay (of its logarithm), from the residual.
    // The Cramér-Rao bound.
    pub deviations: Vec<[f64; 2]>,
    /// Weighted sum of squares.
    pub square: f64,
}

/// The sum of squares.
fn square(values: &[c64]) -> f64 {
    real_dot(values, values)
}

const MOST_STEPS: usize = 30;
const SETTLED: f64 = 1e-6;

/// The poles of least squares, the value computed at them, the sum of squares, and the normal matrix.
pub(crate) type Descended<A> = (Vec<Pole>, A, f64, Vec<Vec<f64>>);

/// Finds the least sum of squares from these poles, by Gauss-Newton with damped steps. `at` computes it. `normal`
/// computes the normal matrix and the downhill direction by frequencies in units of δ/π and logarithms of decays.
/// `ends` says whether a step that lowered the sum by that much was the last; it returns `None` if the poles diverge.
pub(crate) fn descended<A>(
    start: &[Pole],
    at: impl Fn(&[Pole]) -> (A, f64),
    normal: impl Fn(&[Pole], &A) -> (Vec<Vec<f64>>, Vec<f64>),
    ends: impl Fn(&[Pole], f64) -> Option<bool>,
) -> Option<Descended<A>> {
    let mut poles = start.to_vec();
    let (mut here, mut square) = at(&poles);
    let (mut damped, mut matrix) = (1e-3, vec![]);
    for _ in 0..MOST_STEPS {
        let (curved, downhill) = normal(&poles, &here);
        matrix = curved;
        let mut largest;
        let moved = loop {
            let step = solve(with(&matrix, &downhill, damped))?;
            largest = step.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            let step: Vec<f64> = step.iter().map(|x| (1.0 / largest).min(1.0) * x).collect();
            let next = poles.iter().zip(step.chunks(2)).map(|(pole, step)| pole.stepped(step));
            let next: Vec<Pole> = next.collect();
            let (there, lower) = at(&next);
            if lower <= square {
                damped = (damped * 0.1).max(1e-9);
                break Some((next, there, lower));
            }
            damped *= 10.0;
            if damped > 1e6 || largest < SETTLED {
                break None;
            }
        };
        let Some((next, there, lower)) = moved else { break };
        let fell = square - lower;
        (poles, here, square) = (next, there, lower);
        if ends(&poles, fell)? || largest < SETTLED {
            break;
        }
    }
    Some((poles, here, square, matrix))
}

fn with(normal: &[Vec<f64>], right: &[f64], damped: f64) -> Vec<Vec<f64>> {
    let row = |(i, row): (usize, &Vec<f64>)| {
        let mut row = row.clone();
        row[i] += damped * row[i] + 1e-300;
        row.push(right[i]);
        row
    };
    normal.iter().enumerate().map(row).collect()
}

/// The poles that fit all bands best, from these starting values; `beside` are poles of other tones, which are kept.
/// `None` if the poles diverge: a decay below a tenth or above ten times its start, or a frequency outside its band.
pub fn fit(bands: &[Band], start: &[Pole], beside: &[Pole]) -> Option<Fit> {
    let residual = |poles: &[Pole]| {
        let all = [poles, beside].concat();
        let part = |band: &Band| {
            let weight = band.weight;
            band.left(&all).into_iter().map(move |x| x * weight)
        };
        bands.iter().flat_map(part).collect::<Vec<c64>>()
    };
    let at = |poles: &[Pole]| {
        let here = residual(poles);
        let square = square(&here);
        (here, square)
    };
    let normal = |poles: &[Pole], here: &Vec<c64>| {
        let slopes = slopes(poles, here, &residual);
        let row = |a: &Vec<c64>| slopes.iter().map(|b| real_dot(a, b)).collect();
        let downhill = slopes.iter().map(|a| -real_dot(a, here)).collect();
        (slopes.iter().map(row).collect(), downhill)
    };
    let (poles, _, square, normal) = descended(start, at, normal, |_, _| Some(false))?;
    let runs = |(pole, begun): (&Pole, &Pole)| {
        let ratio = pole.decay / begun.decay;
        let away = (pole.hz - begun.hz).abs() > 3.0 * begun.decay.max(pole.decay) + 0.02 * begun.hz;
        !(0.1..10.0).contains(&ratio) || away || !pole.hz.is_finite()
    };
    if poles.iter().zip(start).any(runs) {
        return None;
    }
    let count = poles.len() + beside.len();
    let freedom: f64 = bands.iter().map(|band| band.freedom(count)).sum();
    let spread = square / (freedom - 2.0 * poles.len() as f64).max(1.0);
    let covariance = inverse(&normal)?;
    let deviation = |k: usize| (covariance[k][k].max(0.0) * spread).sqrt();
    let deviations = poles.iter().enumerate();
    let deviations = deviations
        .map(|(p, pole)| [deviation(2 * p) * pole.decay / (PI * pole.hz), deviation(2 * p + 1)]);
    Some(Fit { deviations: deviations.collect(), poles, square })
}

/// Derivatives of the residual by the steps of every pole.
fn slopes(poles: &[Pole], here: &[c64], residual: &impl Fn(&[Pole]) -> Vec<c64>) -> Vec<Vec<c64>> {
    /// Step of a difference quotient: far above round-off, far below the curvature.
    const STEP: f64 = 1e-5;
    let along = |k: usize| {
        let mut step = [0.0; 2];
        step[k % 2] = STEP;
        let mut moved = poles.to_vec();
        moved[k / 2] = moved[k / 2].stepped(&step);
        residual(&moved).iter().zip(here).map(|(a, b)| (a - b) / STEP).collect()
    };
    (0..2 * poles.len()).map(along).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const RATE: f64 = 16_000.0;

    fn sound(poles: &[(Pole, f64, f64)], noise: f64, seed: u64) -> Vec<f64> {
        let mut state = seed;
        let mut uniform = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as f64 / (1_u64 << 31) as f64
        };
        let sample = |n: usize| {
            let t = n as f64 / RATE;
            let tone = |(pole, size, phase): &(Pole, f64, f64)| {
                size * (-pole.decay * t).exp() * (TAU * pole.hz * t + phase).cos()
            };
            // Irwin and Hall's sum of twelve is normal enough.
            let normal =
                if noise > 0.0 { (0..12).map(|_| uniform()).sum::<f64>() - 6.0 } else { 0.0 };
            poles.iter().map(tone).sum::<f64>() + noise * normal
        };
        (0..4000).map(sample).collect()
    }

    #[test]
    fn damped_tones_are_found_to_round_off() {
        let truth = [Pole { hz: 611.3, decay: 20.0 }, Pole { hz: 618.0, decay: 25.0 }];
        let bands = [0.4, 2.0].map(|phase| {
            let sound = sound(&[(truth[0], 1.0, phase), (truth[1], 0.5, 1.0)], 0.0, 0);
            Band::new(0, &sound, RATE, 612.0, 90.0).unwrap()
        });
        let start = [Pole { hz: 610.0, decay: 15.0 }, Pole { hz: 620.0, decay: 30.0 }];
        let found = fit(&bands, &start, &[]).unwrap();
        for (pole, truth) in found.poles.iter().zip(truth) {
            assert!((pole.hz / truth.hz - 1.0).abs() < 1e-9, "{pole:?}");
            assert!((pole.decay / truth.decay - 1.0).abs() < 1e-6, "{pole:?}");
        }
        let one = fit(&bands, &start[..1], &truth[1..]).unwrap();
        assert!((one.poles[0].hz / truth[0].hz - 1.0).abs() < 1e-9);
    }

    /// In white noise, errors over their standard deviations have a mean square of 1, within four standard deviations.
    #[test]
    fn deviations_are_those_of_white_noise() {
        let pole = Pole { hz: 611.3, decay: 20.0 };
        let draws = 200;
        let mut sums = [0.0; 2];
        for seed in 0..draws {
            let sound = sound(&[(pole, 1.0, 0.1 * seed as f64)], 0.05, 99 + seed);
            let band = Band::new(0, &sound, RATE, 611.3, 80.0).unwrap();
            let found = fit(&[band], &[Pole { hz: 612.0, decay: 30.0 }], &[]).unwrap();
            let [f, d] = found.deviations[0];
            sums[0] += ((found.poles[0].hz / pole.hz).ln() / f).powi(2);
            sums[1] += ((found.poles[0].decay / pole.decay).ln() / d).powi(2);
        }
        let four = 4.0 * (2.0 / draws as f64).sqrt();
        for sum in sums {
            assert!((sum / draws as f64 - 1.0).abs() < four, "{sums:?}");
        }
    }
}
