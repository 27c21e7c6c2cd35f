//! Resonances that measured frequency responses of one body share, by least squares.
//!
//! With `x = f` and the damping of a material or of dashpots,
//!
//! ```text
//! H_j(f) = −f² Σ_p A_jp/D_p(f) + c_j0 + c_j1 f² + … + c_j4 f⁸        acceleration per force
//! D_p(f) = f_p² (1 + i η_p) − f²     or     f_p² + i η_p f f_p − f²
//! ```
//!
//! Poles are those of the body; residues A and what modes beyond the band leave, c, are those of a response. The
//! latter are linear and eliminated (variable projection, in Kaufman's simplification of the derivative); the former by
//! Gauss-Newton with damped steps, as in [`fit`](mod@crate::fit). Noise is known line by line, and weighs.
//!
//! # Source
//!
//! L. Kaufman, A variable projection method for solving separable nonlinear least squares problems, BIT 15 (1975) 49.

use crate::complex::Complex;
use crate::filter::median;
use crate::fit::{Pole, with};
use crate::least_squares::{inverse, solve};

/// How a body is damped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Damping {
    /// By its material: a loss factor, the same at any frequency.
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
    pub values: Vec<Vec<Complex>>,
    /// Noise at every line, over that of the response.
    lines: Vec<f64>,
    /// Noise of every response (1/kg).
    scales: Vec<f64>,
}

/// Lines on either side over which noise is taken as even.
const AROUND: usize = 12;
/// Median of the square of a complex normal number over its mean.
const MEDIAN: f64 = std::f64::consts::LN_2;

impl Responses {
    /// Responses with the noise that they show themselves: what is left of fourth differences over the lines.
    ///
    /// `noise`, where coherence tells it, is relative and for every line. It can only add, since it is often told too
    /// well.
    pub fn new(hz: Vec<f64>, values: Vec<Vec<Complex>>, noise: Option<Vec<f64>>) -> Self {
        let (lines, scales) = (vec![1.0; hz.len()], vec![1.0; values.len()]);
        let mut all = Self { hz, values, lines, scales };
        let rough: Vec<Vec<Complex>> = all.values.iter().map(|one| rough(one)).collect();
        all.weigh(&rough);
        if let Some(noise) = noise {
            let ratios: Vec<f64> =
                noise.iter().zip(&all.lines).map(|(told, own)| told / own).collect();
            let usual = median(&ratios).max(1e-300);
            all.lines.iter_mut().zip(noise).for_each(|(own, told)| *own = own.max(told / usual));
        }
        all
    }

    /// Takes the noise from what is left of every response.
    fn weigh(&mut self, left: &[Vec<Complex>]) {
        for turn in 0..2 {
            for (scale, left) in self.scales.iter_mut().zip(left) {
                let own = left.iter().zip(&self.lines).map(|(r, g)| r.square() / (g * g));
                *scale = (median(&own.collect::<Vec<_>>()) / MEDIAN).max(1e-300).sqrt();
            }
            if turn == 1 {
                break;
            }
            let mean = |l: usize| {
                let all = left.iter().zip(&self.scales);
                all.map(|(r, s)| r[l].square() / (s * s)).sum::<f64>() / left.len() as f64
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

    /// Takes the noise from what a fit leaves, over the noise that was taken before.
    pub fn weigh_left(&mut self, left: &[Vec<Complex>]) {
        let part = |(j, one): (usize, &Vec<Complex>)| {
            one.iter().enumerate().map(|(l, r)| *r * self.noise(j, l)).collect()
        };
        let left: Vec<Vec<Complex>> = left.iter().enumerate().map(part).collect();
        self.weigh(&left);
    }

    /// Noise of response `j` at line `l`.
    fn noise(&self, j: usize, l: usize) -> f64 {
        self.scales[j] * self.lines[l]
    }
}

/// Fourth differences, scaled to the noise of one line.
fn rough(values: &[Complex]) -> Vec<Complex> {
    let scale = 1.0 / 70.0_f64.sqrt();
    let at = |l: usize| {
        let l = l.clamp(2, values.len().saturating_sub(3).max(2));
        let [a, b, c, d, e] = [0, 1, 2, 3, 4].map(|k| values[(l + k - 2).min(values.len() - 1)]);
        (a + e - (b + d) * 4.0 + c * 6.0) * scale
    };
    (0..values.len()).map(at).collect()
}

/// What a resonance is at a frequency, −f²/D, and its derivatives by the pole's frequency and by its loss factor.
fn resonance(pole: Pole, damping: Damping, f: f64) -> [Complex; 3] {
    let (p, eta) = (pole.hz, pole.loss());
    let (below, by_hz, by_loss) = match damping {
        Damping::Material => (
            Complex::new(p * p - f * f, eta * p * p),
            Complex::new(2.0 * p, 2.0 * p * eta),
            Complex::new(0.0, p * p),
        ),
        Damping::Dashpots => (
            Complex::new(p * p - f * f, eta * p * f),
            Complex::new(2.0 * p, eta * f),
            Complex::new(0.0, p * f),
        ),
    };
    let one = Complex::new(-f * f, 0.0) / below;
    let slope = one / below * -1.0;
    [one, slope * by_hz, slope * by_loss]
}

/// The complex square (Hz²) at which a pole is.
pub fn square(pole: Pole) -> Complex {
    Complex::new(1.0, pole.loss()) * (pole.hz * pole.hz)
}

/// The pole at a complex square (Hz²).
pub fn at(square: Complex) -> Pole {
    Pole::of(square.re.max(0.0).sqrt(), square.im / square.re)
}

/// Powers of the frequency by which modes beyond the band answer.
const BEYOND: usize = 5;

/// A set of responses at given poles: orthonormal columns, and what they leave.
pub struct Projection {
    columns: Vec<Vec<Complex>>,
    /// What is left of every response, over its noise.
    pub left: Vec<Vec<Complex>>,
    /// Coefficients of every response: residues first, over its noise.
    coefficients: Vec<Vec<Complex>>,
    triangle: Vec<Vec<Complex>>,
}

fn dot(a: &[Complex], b: &[Complex]) -> Complex {
    let mut sum = Complex::default();
    for (a, b) in a.iter().zip(b) {
        sum = sum + a.conj() * *b;
    }
    sum
}

fn take(from: &mut [Complex], share: Complex, of: &[Complex]) {
    for (a, b) in from.iter_mut().zip(of) {
        *a = *a - share * *b;
    }
}

impl Projection {
    /// The responses at these poles.
    pub fn new(of: &Responses, poles: &[Pole], damping: Damping) -> Self {
        let top = of.hz[of.hz.len() - 1];
        let powers = (0..BEYOND).map(|k| {
            let power = |(f, g): (&f64, &f64)| Complex::new((f / top).powi(2 * k as i32) / g, 0.0);
            of.hz.iter().zip(&of.lines).map(power).collect()
        });
        let resonances = poles.iter().map(|pole| Self::column(of, *pole, damping, 0));
        let mut columns: Vec<Vec<Complex>> = powers.chain(resonances).collect();
        let mut triangle = vec![];
        for k in 0..columns.len() {
            let (done, rest) = columns.split_at_mut(k);
            let own = &mut rest[0];
            let before = dot(own, own).re.sqrt();
            let mut shares = vec![Complex::default(); k];
            for _ in 0..2 {
                for (sum, other) in shares.iter_mut().zip(done.iter()) {
                    let share = dot(other, own);
                    take(own, share, other);
                    *sum = *sum + share;
                }
            }
            let size = dot(own, own).re.sqrt();
            let scale = if size > 1e-10 * before { 1.0 / size } else { 0.0 };
            own.iter_mut().for_each(|a| *a = *a * scale);
            shares.push(Complex::new(size.max(1e-10 * before), 0.0));
            triangle.push(shares);
        }
        let mut left = vec![];
        let mut coefficients = vec![];
        for (j, values) in of.values.iter().enumerate() {
            let over = |(l, v): (usize, &Complex)| *v * (1.0 / of.noise(j, l));
            let mut own: Vec<Complex> = values.iter().enumerate().map(over).collect();
            let mut shares = vec![];
            for column in &columns {
                let share = dot(column, &own);
                take(&mut own, share, column);
                shares.push(share);
            }
            coefficients.push(back(&triangle, shares));
            left.push(own);
        }
        Self { columns, left, coefficients, triangle }
    }

    /// A resonance, or its derivative by frequency or loss factor, over the noise of lines.
    fn column(of: &Responses, pole: Pole, damping: Damping, which: usize) -> Vec<Complex> {
        let one = |(f, g): (&f64, &f64)| resonance(pole, damping, *f)[which] * (1.0 / g);
        of.hz.iter().zip(&of.lines).map(one).collect()
    }

    fn beside(&self, mut column: Vec<Complex>) -> Vec<Complex> {
        for other in &self.columns {
            let share = dot(other, &column);
            take(&mut column, share, other);
        }
        column
    }

    /// The weighed sum of squares, 1 per line of noise.
    pub fn square(&self) -> f64 {
        self.left.iter().flatten().map(|r| r.square()).sum()
    }

    /// Residue of response `j` at pole `p`, over its noise.
    fn residue(&self, j: usize, p: usize) -> Complex {
        self.coefficients[j][BEYOND + p]
    }

    /// Residue A (1/kg) of response `j` at pole `p`: the product of both deflections over the modal mass.
    pub fn residue_of(&self, of: &Responses, j: usize, p: usize) -> Complex {
        self.residue(j, p) * of.scales[j]
    }

    /// Standard deviation (1/kg) of that residue, both its parts together, at poles that are known.
    pub fn deviation_of(&self, of: &Responses, j: usize, p: usize) -> f64 {
        let mut weights = vec![Complex::default(); self.triangle.len()];
        weights[BEYOND + p] = Complex::ONE;
        self.deviation(&weights) * of.scales[j]
    }

    /// Standard deviation (1/kg) of response `j` at a complex square `z`, as [`Self::at`] has it, likewise.
    pub fn deviation_at(&self, of: &Responses, j: usize, poles: &[Pole], z: Complex) -> f64 {
        let top = of.hz[of.hz.len() - 1];
        let beyond =
            std::iter::successors(Some(Complex::ONE), |p| Some(*p * z * (1.0 / (top * top))));
        let within = poles.iter().map(|pole| z / (square(*pole) - z) * -1.0);
        let weights: Vec<Complex> = beyond.take(BEYOND).chain(within).collect();
        self.deviation(&weights) * of.scales[j]
    }

    /// Standard deviation of a weighed sum of the coefficients, over the noise: the size of `x` with `x R = weights`.
    fn deviation(&self, weights: &[Complex]) -> f64 {
        let mut row: Vec<Complex> = vec![];
        for (column, weight) in self.triangle.iter().zip(weights) {
            let sum = row.iter().zip(column).fold(*weight, |sum, (x, r)| sum - *x * *r);
            row.push(sum / column[row.len()]);
        }
        row.iter().map(|x| x.square()).sum::<f64>().sqrt()
    }

    /// Response `j` (1/kg) as it goes on at a complex square `z` of the frequency (Hz²), pole `without` left out.
    pub fn at(
        &self,
        of: &Responses,
        j: usize,
        (poles, without): (&[Pole], Option<usize>),
        z: Complex,
    ) -> Complex {
        let top = of.hz[of.hz.len() - 1];
        let beyond = &self.coefficients[j][..BEYOND];
        let power = |sum: Complex, c: &Complex| sum * z * (1.0 / (top * top)) + *c;
        let beyond = beyond.iter().rev().fold(Complex::default(), power);
        let within = poles.iter().enumerate().filter(|(p, _)| Some(*p) != without);
        let one = |sum: Complex, (p, pole): (usize, &Pole)| {
            sum - z * self.residue(j, p) / (square(*pole) - z)
        };
        (within.fold(beyond, one)) * of.scales[j]
    }

    /// By how much another pole would lower the sum of squares, if none of the others moved.
    pub fn gain(&self, of: &Responses, pole: Pole, damping: Damping) -> f64 {
        let column = Self::column(of, pole, damping, 0);
        let before = dot(&column, &column).re;
        let column = self.beside(column);
        let size = dot(&column, &column).re;
        if size < 1e-9 * before {
            return 0.0;
        }
        self.left.iter().map(|left| dot(&column, left).square()).sum::<f64>() / size
    }
}

/// The solution of a triangular system, given by its columns down to the diagonal.
fn back(triangle: &[Vec<Complex>], mut right: Vec<Complex>) -> Vec<Complex> {
    for i in (0..right.len()).rev() {
        for k in i + 1..right.len() {
            right[i] = right[i] - triangle[k][i] * right[k];
        }
        right[i] = right[i] / triangle[i][i];
    }
    right
}

/// Poles that fit, and what is known of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Shared {
    /// The poles.
    pub poles: Vec<Pole>,
    /// Covariance of the poles: frequencies over `η f`, and logarithms of loss factors, in turn.
    covariance: Vec<Vec<f64>>,
    /// Weighed sum of squares.
    pub square: f64,
}

impl Shared {
    /// Standard deviations of a pole's frequency (relative) and loss factor (of its logarithm).
    pub fn deviations(&self, p: usize) -> [f64; 2] {
        let of = |k: usize| self.covariance[k][k].max(0.0).sqrt();
        [of(2 * p) * self.poles[p].loss(), of(2 * p + 1)]
    }
}

const MOST_STEPS: usize = 30;
const SETTLED: f64 = 1e-5;
/// Loss factors of bodies that ring.
pub const LOSSES: [f64; 2] = [1e-4, 0.3];

fn stepped(poles: &[Pole], step: &[f64], share: f64) -> Vec<Pole> {
    let one = |(pole, step): (&Pole, &[f64])| {
        let loss = pole.loss();
        Pole::of(pole.hz * (1.0 + share * step[0] * loss), loss * (share * step[1]).exp())
    };
    poles.iter().zip(step.chunks(2)).map(one).collect()
}

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
        let slope = |k: usize| {
            let pole = poles[k / 2];
            let scale = if k.is_multiple_of(2) { pole.loss() * pole.hz } else { pole.loss() };
            let mut column = at.beside(Projection::column(of, pole, damping, 1 + k % 2));
            column.iter_mut().for_each(|v| *v = *v * scale);
            column
        };
        let slopes: Vec<Vec<Complex>> = (0..count).map(slope).collect();
        let responses = 0..of.values.len();
        for a in 0..count {
            for b in 0..=a {
                let common = responses.clone().fold(Complex::default(), |sum, j| {
                    sum + at.residue(j, a / 2).conj() * at.residue(j, b / 2)
                });
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

/// The poles that fit all responses best, begun at these; None where one runs away.
pub fn shared(all: &[Responses], start: &[Pole], damping: Damping) -> Option<Shared> {
    let mut poles = start.to_vec();
    let (mut here, mut square) = projected(all, &poles, damping);
    let (mut damped, mut matrix) = (1e-3, vec![]);
    for _ in 0..MOST_STEPS {
        let (curved, downhill) = normal(all, &here, &poles, damping);
        matrix = curved;
        let mut largest;
        let moved = loop {
            let step = solve(with(&matrix, &downhill, damped))?;
            largest = step.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            let next = stepped(&poles, &step, (1.0 / largest).min(1.0));
            let (there, lower) = projected(all, &next, damping);
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
        let sound = |pole: &Pole| (LOSSES[0]..LOSSES[1]).contains(&pole.loss()) && pole.hz > 0.0;
        if !poles.iter().all(sound) {
            return None;
        }
        if largest < SETTLED || fell < 1e-3 {
            break;
        }
    }
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
            let start = Complex::new(0.7, 0.0) + Complex::turn(TAU * uniform()) * size;
            poles.iter().zip(residues).fold(start, |sum, (pole, a)| {
                let by = if damping == Damping::Material { pole.hz } else { f };
                let below = Complex::new(pole.hz.powi(2) - f * f, pole.loss() * pole.hz * by);
                sum - Complex::new(a * f * f, 0.0) / below
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
                    let residue = at.residue_of(&all[0], j, p);
                    assert!((residue.re - residues[p]).abs() < 1e-6 && residue.im.abs() < 1e-6);
                }
            }
            // What goes on at complex frequencies is what stands on the lines at real ones; for dashpots nearly.
            let (f, within) =
                (all[0].hz[900], if damping == Damping::Material { 1e-9 } else { 0.1 });
            let on = at.at(&all[0], 1, (&found.poles, None), Complex::new(f * f, 0.0));
            let off = (on - all[0].values[1][900]).square().sqrt();
            assert!(off < within * all[0].values[1][900].square().sqrt(), "{off}");
        }
    }

    /// In white noise errors over their deviations have a mean square of 1, within four deviations of that.
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
