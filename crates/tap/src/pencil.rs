//! Starting values for several tones in one band, by the matrix pencil of all taps together.
//!
//! The inverse transform of a tap's band is a row of K values `y_m = Σ_p a_p z_p^m` plus noise. The Hankel matrices of
//! all taps, one below the other, have a row space that the powers of the poles span. Let V be its strongest vectors,
//! V₁ without their last row and V₂ without their first. Then `V₁ Z = V₂`, and the eigenvalues of Z are the z_p.
//!
//! # Source
//!
//! Y. Hua, T. K. Sarkar, Matrix pencil method for estimating parameters of exponentially damped/undamped sinusoids in
//! noise, IEEE Trans. Acoust. Speech Signal Process. 38 (1990) 814, equations 9 to 15.

use std::f64::consts::{PI, TAU};

use faer::c64;

use crate::fit::{Band, Pole};
use crate::least_squares::{dot, take};

/// Most values in a row, to limit the work.
const LONGEST: usize = 48;
/// Turns of the iteration for the strongest two vectors.
const TURNS: usize = 60;

/// Two poles as starting values for a fit of these bands; `None` if the band does not have two decaying ones.
pub fn two_poles(bands: &[Band]) -> Option<[Pole; 2]> {
    let shortest = bands.iter().map(|band| band.lines().len()).min()?;
    let row = (shortest / 2).min(LONGEST);
    if row < 4 {
        return None;
    }
    // The distance of a tap's lines depends on its length, so only taps of equal length share the powers of the poles.
    let step = |band: &Band| band.lines()[1].0 - band.lines()[0].0;
    let same = |band: &&Band| {
        let ratio = step(band) * band.lines().len() as f64
            / (step(&bands[0]) * bands[0].lines().len() as f64);
        (ratio - 1.0).abs() < 0.03
    };
    let mut gram = vec![vec![c64::ZERO; row]; row];
    for band in bands.iter().filter(same) {
        let values = back(band);
        let size = values.iter().map(|y| y.norm_sqr()).sum::<f64>().max(1e-300);
        for window in values.windows(row) {
            for (i, a) in window.iter().enumerate() {
                for (j, b) in window.iter().enumerate() {
                    gram[i][j] += a * b.conj() / size;
                }
            }
        }
    }
    let vectors = strongest(&gram);
    let turns = shifted(&vectors)?;
    let (lines, width) = (bands[0].lines(), step(&bands[0]));
    let rate = width * lines.len() as f64;
    let middle = lines[lines.len() / 2].0;
    let mut poles = turns.map(|z| {
        let log = z.ln();
        Pole { hz: middle + log.im / TAU * rate, decay: -log.re * rate }
    });
    poles.sort_by(|a, b| a.hz.total_cmp(&b.hz));
    let dies = |pole: &Pole| pole.decay > 0.0 && pole.decay < PI * rate;
    poles.iter().all(dies).then_some(poles)
}

/// The inverse transform of the band's lines about its middle, tapered so that its ends do not ring.
fn back(band: &Band) -> Vec<c64> {
    let lines = band.lines();
    let (count, middle) = (lines.len(), (lines.len() / 2) as f64);
    let taper = |k: usize| {
        let edge = (k.min(count - 1 - k) as f64 + 0.5) / (0.2 * count as f64);
        (0.5 * PI * edge.min(1.0)).sin()
    };
    let value = |m: usize| {
        let turn = |k: usize| c64::cis(TAU * (k as f64 - middle) * m as f64 / count as f64);
        lines.iter().enumerate().map(|(k, (_, x))| x * turn(k) * taper(k)).sum()
    };
    // The first and the last values are affected by the cut.
    let edge = 1 + count / 16;
    (edge..count - edge).map(value).collect()
}

/// The two strongest vectors of a Hermitian matrix, by repeated multiplication.
fn strongest(matrix: &[Vec<c64>]) -> [Vec<c64>; 2] {
    let unit = |vector: &mut Vec<c64>| {
        let scale = 1.0 / dot(vector, vector).re.sqrt().max(1e-300);
        vector.iter_mut().for_each(|x| *x *= scale);
    };
    let mut pair = [0, 1].map(|k| {
        (0..matrix.len()).map(|i| c64::cis((k * i * i) as f64 + 0.3 * i as f64)).collect::<Vec<_>>()
    });
    for _ in 0..TURNS {
        let times = |vector: &Vec<c64>| {
            let row = |row: &Vec<c64>| row.iter().zip(vector).map(|(a, b)| a * b).sum();
            matrix.iter().map(row).collect::<Vec<c64>>()
        };
        let [first, second] = &mut pair;
        (*first, *second) = (times(first), times(second));
        unit(first);
        let share = dot(first, second);
        take(second, share, first);
        unit(second);
    }
    pair
}

/// The eigenvalues of Z in `V₁ Z = V₂`, by least squares.
fn shifted(vectors: &[Vec<c64>; 2]) -> Option<[c64; 2]> {
    let last = vectors[0].len() - 1;
    let products = |shift: usize| {
        [(0, 0), (0, 1), (1, 0), (1, 1)]
            .map(|(i, j)| dot(&vectors[i][..last], &vectors[j][shift..last + shift]))
    };
    let ([a, b, c, d], [e, f, g, h]) = (products(0), products(1));
    let whole = a * d - b * c;
    if whole.norm_sqr() < 1e-20 {
        return None;
    }
    let z = [d * e - b * g, d * f - b * h, a * g - c * e, a * h - c * f].map(|x| x / whole);
    let (half, determinant) = ((z[0] + z[3]) * 0.5, z[0] * z[3] - z[1] * z[2]);
    let root = (half * half - determinant).sqrt();
    Some([half + root, half - root])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two damped tones without noise; the ends of the band cause an error of 3 % of the smaller gap.
    #[test]
    fn two_damped_tones_are_told_apart() {
        let rate = 16_000.0;
        let truth = [Pole { hz: 611.3, decay: 20.0 }, Pole { hz: 622.0, decay: 22.0 }];
        let bands = [0.3, 1.9].map(|phase| {
            let sample = |n: usize| {
                let t = n as f64 / rate;
                let tone = |pole: &Pole, phase: f64| {
                    (-pole.decay * t).exp() * (TAU * pole.hz * t + phase).cos()
                };
                tone(&truth[0], phase) + 0.5 * tone(&truth[1], 2.0 * phase)
            };
            let sound: Vec<f64> = (0..2400).map(sample).collect();
            Band::new(0, &sound, rate, 615.0, 100.0).unwrap()
        });
        let found = two_poles(&bands).unwrap();
        for (pole, truth) in found.iter().zip(truth) {
            assert!((pole.hz - truth.hz).abs() < 0.5, "{found:?}");
            assert!((pole.decay / truth.decay - 1.0).abs() < 0.3, "{found:?}");
        }
    }
}
