//! Resonances that measured frequency responses of one body share, by least squares.
//!
//! With `x = f` and the damping of a material or of dashpots,
//!
//! ```text
//! H_j(f) = −f² Σ_p A_jp/D_p(f) + c_j0 + c_j1 f² + … + c_j4 f⁸        acceleration per force
//! D_p(f) = f_p² (1 + i η_p) − f²     or     f_p² + i η_p f f_p − f²
//! ```
//!
//! Poles belong to the body. Residues A, and the contributions c of modes beyond the band, belong to a response; they
//! are linear and are eliminated (variable projection, in Kaufman's simplification of the derivative). The poles follow
//! by the steps of [`fit`](mod@crate::fit). The noise of every line is known and is used as its weight.
//!
//! # Source
//!
//! L. Kaufman, A variable projection method for solving separable nonlinear least squares problems, BIT 15 (1975) 49.

use faer::c64;

use crate::filter::median;
use crate::fit::{Pole, descended};
use crate::least_squares::{Basis, dot, inverse};

/// How a body is damped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Damping {
    /// By its material: a loss factor that is equal at all frequencies.
    Material,
    /// By dashpots, in proportion to velocity; the ratio is half the loss factor.
    Dashpots,
}

/// Responses over the same frequencies.
#[derive(Debug, Clone, PartialEq)]
pub struct Responses {
    /// Rising frequencies (Hz).
    pub hz: Vec<f64>,
    /// Acceleration per force of every response (1/kg).
    pub values: Vec<Vec<c64>>,
    /// Noise at every line, over that of the response.
    lines: Vec<f64>,
    /// Noise of every response (1/kg).
    scales: Vec<f64>,
}

/// Number of lines on either side over which the noise is taken as constant.
const AROUND: usize = 12;
/// Median of the square of a complex normal number over its mean.
const MEDIAN: f64 = std::f64::consts::LN_2;

impl Responses {
    /// Responses with the noise in their own values: the residual of fourth differences over the lines.
    ///
    /// `noise` is relative, for every line, if coherence gives it. It can only increase the noise, because coherence
    /// often makes it too small.
    pub fn new(hz: Vec<f64>, values: Vec<Vec<c64>>, noise: Option<Vec<f64>>) -> Self {
        let (lines, scales) = (vec![1.0; hz.len()], vec![1.0; values.len()]);
        let mut all = Self { hz, values, lines, scales };
        let rough: Vec<Vec<c64>> = all.values.iter().map(|one| rough(one)).collect();
        all.weigh(&rough);
        if let Some(noise) = noise {
            let ratios: Vec<f64> =
                noise.iter().zip(&all.lines).map(|(told, own)| told / own).collect();
            let usual = median(&ratios).max(1e-300);
            all.lines.iter_mut().zip(noise).for_each(|(own, told)| *own = own.max(told / usual));
        }
        all
    }

    /// Sets the noise from the residual of every response.
    fn weigh(&mut self, left: &[Vec<c64>]) {
        for turn in 0..2 {
            for (scale, left) in self.scales.iter_mut().zip(left) {
                let own = left.iter().zip(&self.lines).map(|(r, g)| r.norm_sqr() / (g * g));
                *scale = (median(&own.collect::<Vec<_>>()) / MEDIAN).max(1e-300).sqrt();
            }
            if turn == 1 {
                break;
            }
            let mean = |l: usize| {
                let all = left.iter().zip(&self.scales);
                all.map(|(r, s)| r[l].norm_sqr() / (s * s)).sum::<f64>() / left.len() as f64
            };
            let means: Vec<f64> = (0..self.hz.len()).map(mean).collect();
            let middle = median(&means).max(1e-300);
            let near = |l: usize| {
                let part = &means[l.saturating_sub(AROUND)..(l + AROUND + 1).min(means.len())];
                (median(part) / middle).max(1e-6).sqrt()
            };
            self.lines = (0..means.len()).map(near).collect();
        }
    }

    /// Sets the noise from the residual of a fit, which is given over the noise set before.
    pub fn weigh_left(&mut self, left: &[Vec<c64>]) {
        let part = |(j, one): (usize, &Vec<c64>)| {
            one.iter().enumerate().map(|(l, r)| *r * self.noise(j, l)).collect()
        };
        let left: Vec<Vec<c64>> = left.iter().enumerate().map(part).collect();
        self.weigh(&left);
    }

    /// Noise of response `j` at line `l`.
    fn noise(&self, j: usize, l: usize) -> f64 {
        self.scales[j] * self.lines[l]
    }

    /// The highest frequency (Hz).
    fn top(&self) -> f64 {
        self.hz[self.hz.len() - 1]
    }

    /// Weights of a residue A (1/kg), the product of both deflections over the modal mass, at pole `p` of `poles`.
    pub fn residue(p: usize, poles: usize) -> Vec<c64> {
        (0..POWERS + poles).map(|k| c64::from(f64::from(k == POWERS + p))).collect()
    }

    /// Weights of a response as it goes on at a complex square `z` of the frequency (Hz²).
    pub fn at(&self, poles: &[Pole], z: c64) -> Vec<c64> {
        let beyond = std::iter::successors(Some(c64::ONE), |p| Some(p * z / self.top().powi(2)));
        let within = poles.iter().map(|pole| -z / (square(*pole) - z));
        beyond.take(POWERS).chain(within).collect()
    }
}

/// Fourth differences, scaled to the noise of one line.
fn rough(values: &[c64]) -> Vec<c64> {
    let scale = 1.0 / 70.0_f64.sqrt();
    let at = |l: usize| {
        let l = l.clamp(2, values.len().saturating_sub(3).max(2));
        let [a, b, c, d, e] = [0, 1, 2, 3, 4].map(|k| values[(l + k - 2).min(values.len() - 1)]);
        (a + e - (b + d) * 4.0 + c * 6.0) * scale
    };
    (0..values.len()).map(at).collect()
}

/// The value of a resonance at a frequency, −f²/D, and its derivatives by the steps of its pole.
fn resonance(pole: Pole, damping: Damping, f: f64) -> [c64; 3] {
    let (p, loss) = (pole.hz, pole.loss());
    // For a given decay, η f_p does not depend on the frequency of the pole.
    let (by, slope) = match damping {
        Damping::Material => (p, loss * p),
        Damping::Dashpots => (f, 0.0),
    };
    let below = c64::new(p * p - f * f, loss * p * by);
    let one = -f * f / below;
    let slope =
        [c64::new(2.0 * p, slope) * p, c64::new(0.0, p * by)].map(|d| -one / below * d * loss);
    [one, slope[0], slope[1]]
}

/// The complex square (Hz²) at which a pole is.
pub fn square(pole: Pole) -> c64 {
    c64::new(1.0, pole.loss()) * (pole.hz * pole.hz)
}

/// The pole at a complex square (Hz²).
pub fn at(square: c64) -> Pole {
    Pole::of(square.re.max(0.0).sqrt(), square.im / square.re)
}

/// Powers of the frequency by which rigid motions, then modes beyond the band answer.
pub const POWERS: usize = 5;

/// A set of responses at given poles: the residuals, and the coefficients of all columns.
pub struct Projection {
    basis: Basis<c64>,
    /// Residual of every response, over its noise.
    pub left: Vec<Vec<c64>>,
    /// Coefficients of every response, over its noise: of the powers, then residues.
    coefficients: Vec<Vec<c64>>,
}

impl Projection {
    /// The responses at these poles.
    pub fn new(of: &Responses, poles: &[Pole], damping: Damping) -> Self {
        let top = of.top();
        let powers = (0..POWERS).map(|k| {
            let power = |(f, g): (&f64, &f64)| c64::from((f / top).powi(2 * k as i32) / g);
            of.hz.iter().zip(&of.lines).map(power).collect()
        });
        let resonances = poles.iter().map(|pole| Self::column(of, *pole, damping, 0));
        let basis = Basis::of(powers.chain(resonances), dot);
        let mut left = vec![];
        let mut coefficients = vec![];
        for (j, values) in of.values.iter().enumerate() {
            let over = |(l, v): (usize, &c64)| v / of.noise(j, l);
            let mut own: Vec<c64> = values.iter().enumerate().map(over).collect();
            let shares = basis.take_off(&mut own);
            coefficients.push(back(&basis.triangle, shares));
            left.push(own);
        }
        Self { basis, left, coefficients }
    }

    /// A resonance, or its derivative by a step of its pole, over the noise of lines.
    fn column(of: &Responses, pole: Pole, damping: Damping, which: usize) -> Vec<c64> {
        let one = |(f, g): (&f64, &f64)| resonance(pole, damping, *f)[which] / g;
        of.hz.iter().zip(&of.lines).map(one).collect()
    }

    /// The remainder of a column after projection on all others.
    fn beside(&self, mut column: Vec<c64>) -> Vec<c64> {
        self.basis.take_off(&mut column);
        column
    }

    /// The weighted sum of squares, 1 per line of noise.
    pub fn square(&self) -> f64 {
        self.left.iter().flatten().map(|r| r.norm_sqr()).sum()
    }

    /// Residue of response `j` at pole `p`, over its noise.
    fn residue(&self, j: usize, p: usize) -> c64 {
        self.coefficients[j][POWERS + p]
    }

    /// A weighted sum of the coefficients of response `j` (1/kg), by [`Responses::residue`] or [`Responses::at`].
    pub fn value(&self, of: &Responses, j: usize, weights: &[c64]) -> c64 {
        let sum: c64 = weights.iter().zip(&self.coefficients[j]).map(|(w, c)| w * c).sum();
        sum * of.scales[j]
    }

    /// Standard deviation (1/kg) of that sum, real and imaginary part together, at known poles: the size of `x` with `x
    /// R = weights`.
    pub fn deviation(&self, of: &Responses, j: usize, weights: &[c64]) -> f64 {
        let mut row: Vec<c64> = vec![];
        for (column, weight) in self.basis.triangle.iter().zip(weights) {
            let sum = row.iter().zip(column).fold(*weight, |sum, (x, r)| sum - x * r);
            row.push(sum / column[row.len()]);
        }
        row.iter().map(|x| x.norm_sqr()).sum::<f64>().sqrt() * of.scales[j]
    }

    /// Decrease of the sum of squares due to one more pole, if the others do not move.
    pub fn gain(&self, of: &Responses, pole: Pole, damping: Damping) -> f64 {
        let column = Self::column(of, pole, damping, 0);
        let before = dot(&column, &column).re;
        let column = self.beside(column);
        let size = dot(&column, &column).re;
        if size < 1e-9 * before {
            return 0.0;
        }
        self.left.iter().map(|left| dot(&column, left).norm_sqr()).sum::<f64>() / size
    }
}

/// The solution of a triangular system, given by its columns down to the diagonal.
fn back(triangle: &[Vec<c64>], mut right: Vec<c64>) -> Vec<c64> {
    for i in (0..right.len()).rev() {
        for k in i + 1..right.len() {
            right[i] = right[i] - triangle[k][i] * right[k];
        }
        right[i] /= triangle[i][i];
    }
    right
}

/// Fitted poles and their covariance.
#[derive(Debug, Clone, PartialEq)]
pub struct Shared {
    /// The poles.
    pub poles: Vec<Pole>,
    /// Covariance of the poles: frequencies over `η f`, and logarithms of loss factors, in turn.
    covariance: Vec<Vec<f64>>,
    /// Weighted sum of squares.
    pub square: f64,
}

impl Shared {
    /// Standard deviations of a pole's frequency (relative) and loss factor (of its logarithm).
    pub fn deviations(&self, p: usize) -> [f64; 2] {
        let of = |k: usize| self.covariance[k][k].max(0.0).sqrt();
        [of(2 * p) * self.poles[p].loss(), of(2 * p + 1)]
    }
}

/// Loss factors of bodies that ring.
pub const LOSSES: [f64; 2] = [3e-6, 0.3];

/// Projections of every group of responses, and their sum of squares.
fn projected(all: &[Responses], poles: &[Pole], damping: Damping) -> (Vec<Projection>, f64) {
    let each: Vec<_> = all.iter().map(|one| Projection::new(one, poles, damping)).collect();
    let square = each.iter().map(Projection::square).sum();
    (each, square)
}

/// Normal matrix and downhill direction of all poles.
fn normal(
    all: &[Responses],
    here: &[Projection],
    poles: &[Pole],
    damping: Damping,
) -> (Vec<Vec<f64>>, Vec<f64>) {
    let count = 2 * poles.len();
    let (mut matrix, mut downhill) = (vec![vec![0.0; count]; count], vec![0.0; count]);
    for (of, at) in all.iter().zip(here) {
        let slope = |k: usize| at.beside(Projection::column(of, poles[k / 2], damping, 1 + k % 2));
        let slopes: Vec<Vec<c64>> = (0..count).map(slope).collect();
        let responses = 0..of.values.len();
        for a in 0..count {
            for b in 0..=a {
                let common = |j: usize| at.residue(j, a / 2).conj() * at.residue(j, b / 2);
                let common: c64 = responses.clone().map(common).sum();
                let value = (dot(&slopes[a], &slopes[b]) * common).re;
                matrix[a][b] += value;
                if a != b {
                    matrix[b][a] += value;
                }
            }
            let along = |j: usize| (at.residue(j, a / 2).conj() * dot(&slopes[a], &at.left[j])).re;
            downhill[a] += responses.clone().map(along).sum::<f64>();
        }
    }
    (matrix, downhill)
}

/// The poles that fit all responses best, from these starting values; `None` if one diverges.
pub fn shared(all: &[Responses], start: &[Pole], damping: Damping) -> Option<Shared> {
    let is_sound = |pole: &Pole| (LOSSES[0]..LOSSES[1]).contains(&pole.loss()) && pole.hz > 0.0;
    let (poles, _, square, matrix) = descended(
        start,
        |poles| projected(all, poles, damping),
        |poles, here| normal(all, here, poles, damping),
        |poles, fell| poles.iter().all(is_sound).then_some(fell < 1e-3),
    )?;
    // Real and imaginary parts have half of the noise each.
    let covariance = inverse(&matrix)?;
    let halved = covariance.iter().map(|row| row.iter().map(|x| 0.5 * x).collect()).collect();
    Some(Shared { poles, covariance: halved, square })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// Accelerances per force of these poles with residues by their own formula, on lines 0.5 Hz apart from 50 to 1200 Hz,
    /// with a rigid part and complex normal noise of that size.
    fn responses(
        poles: &[Pole],
        residues: &[Vec<f64>],
        damping: Damping,
        noise: f64,
        mut state: u64,
    ) -> Responses {
        let hz: Vec<f64> = (100..2400).map(|l| 0.5 * f64::from(l)).collect();
        let mut uniform = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            ((state >> 33) as f64 + 0.5) / (1_u64 << 31) as f64
        };
        let mut at = |residues: &Vec<f64>, f: f64| {
            let size = noise * (-uniform().ln()).sqrt();
            let start = c64::from(0.7) + c64::cis(TAU * uniform()) * size;
            poles.iter().zip(residues).fold(start, |sum, (pole, a)| {
                let by = if damping == Damping::Material { pole.hz } else { f };
                let below = c64::new(pole.hz.powi(2) - f * f, pole.loss() * pole.hz * by);
                sum - c64::new(a * f * f, 0.0) / below
            })
        };
        let values = residues.iter().map(|a| hz.iter().map(|f| at(a, *f)).collect()).collect();
        Responses::new(hz.clone(), values, None)
    }

    #[test]
    fn poles_and_residues_are_found_to_round_off() {
        let truth = [Pole::of(171.3, 0.008), Pole::of(583.2, 0.011), Pole::of(589.0, 0.012)];
        let residues = [vec![2.0, -1.5, 0.7], vec![-0.4, 1.0, 1.1], vec![0.9, 0.3, -2.0]];
        for damping in [Damping::Material, Damping::Dashpots] {
            let all = [responses(&truth, &residues, damping, 0.0, 1)];
            let start = [Pole::of(171.0, 0.01), Pole::of(582.5, 0.01), Pole::of(590.0, 0.01)];
            let found = shared(&all, &start, damping).unwrap();
            let at = Projection::new(&all[0], &found.poles, damping);
            for (p, (pole, truth)) in found.poles.iter().zip(truth).enumerate() {
                assert!((pole.hz / truth.hz - 1.0).abs() < 1e-9, "{pole:?}");
                assert!((pole.loss() / truth.loss() - 1.0).abs() < 1e-6, "{pole:?}");
                for (j, residues) in residues.iter().enumerate() {
                    let residue = at.value(&all[0], j, &Responses::residue(p, 3));
                    assert!((residue.re - residues[p]).abs() < 1e-6 && residue.im.abs() < 1e-6);
                }
            }
            // Continued to complex frequencies it agrees with the values at real ones; for dashpots approximately.
            let (f, within) =
                (all[0].hz[900], if damping == Damping::Material { 1e-9 } else { 0.1 });
            let on = at.value(&all[0], 1, &all[0].at(&found.poles, (f * f).into()));
            let off = (on - all[0].values[1][900]).norm();
            assert!(off < within * all[0].values[1][900].norm(), "{off}");
        }
    }

    /// In white noise, errors over their standard deviations have a mean square of 1, within four standard deviations.
    #[test]
    fn deviations_are_those_of_white_noise() {
        let (pole, draws) = (Pole::of(411.3, 0.01), 100);
        let mut sums = [0.0; 2];
        for seed in 0..draws {
            let residues = [vec![1.0], vec![-0.6]];
            let all = [responses(&[pole], &residues, Damping::Material, 0.5, 77 + seed)];
            let found = shared(&all, &[Pole::of(411.0, 0.012)], Damping::Material).unwrap();
            let [f, d] = found.deviations(0);
            sums[0] += ((found.poles[0].hz / pole.hz).ln() / f).powi(2);
            sums[1] += ((found.poles[0].loss() / pole.loss()).ln() / d).powi(2);
        }
        let four = 4.0 * (2.0 / draws as f64).sqrt();
        for sum in sums {
            assert!((sum / draws as f64 - 1.0).abs() < four, "{sums:?}");
        }
    }
}
