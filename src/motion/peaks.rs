//! Where does a response peak, how high and how wide?
//!
//! A mode with the damping ratio ζ and the natural frequency f has half its power at a distance `ζf` from f. [`around`]
//! gives frequencies close enough that a grid with them cannot miss a peak. [`of`] finds the peaks of a grid, with the
//! response between its points.

use std::f64::consts::FRAC_1_SQRT_2;

use crate::base::golden;

/// A peak of a response.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// Number of the mode with the nearest natural frequency, from 1.
    pub mode: usize,
    /// Its undamped natural frequency (Hz).
    pub natural: f64,
    /// Where the response is largest (Hz).
    pub frequency: f64,
    /// Size of the response there; `None` if the mode is undamped and the response unbounded.
    pub height: Option<f64>,
    /// Frequencies at half the power, below and above (Hz); `None` if the response rises again before.
    pub half_power: Option<[f64; 2]>,
}

impl Peak {
    /// Damping ratio by the half-power points f₁ and f₂: `ζ = (f₂² − f₁²)/(4f²)`.
    ///
    /// For one mode `H ∝ 1/(1 − r² + iη)`, with r the frequency over the natural one. Half of the power at resonance is
    /// where `(1 − r²)² = η²`, so exactly `r₂² − r₁² = 2η`, and η = 2ζ. Viscous damping has `iηr` instead, and the
    /// result is equal to second order in ζ.
    pub fn damping_ratio(&self) -> Option<f64> {
        let [below, above] = self.half_power?;
        Some((above - below) * (above + below) / (4.0 * self.frequency * self.frequency))
    }
}

/// Distances from a natural frequency in half-widths `ζf`. A resonance between two of the near ones is at most an
/// eighth of a half-width from one of them and `√(1 + 1/64)`, 0.8 %, higher.
const DISTANCES: [f64; 11] = [0.0, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, FARTHEST];
/// The farthest of them; also the greatest distance of a peak from its natural frequency.
const FARTHEST: f64 = 8.0;
/// An undamped mode has no width; its frequencies are this close to it, and none is on it.
const SHARP: f64 = 1e-3;

/// Frequencies (Hz) at and around a natural frequency with that damping ratio, unsorted, without repetitions.
pub fn around(natural: f64, ratio: f64) -> Vec<f64> {
    let sharp = ratio <= 0.0;
    let width = if sharp { SHARP } else { ratio.min(1.0) };
    let far = DISTANCES.into_iter().filter(|far| !sharp || *far >= 1.0);
    let both = far.flat_map(|far| [1.0 - width * far, 1.0 + width * far]);
    let mut all: Vec<f64> =
        both.filter(|share| *share > 0.0).map(|share| natural * share).collect();
    // The natural frequency belongs to both sides.
    all.dedup();
    all
}

/// The peaks of a response between the ends of a rising grid (Hz) without repetitions, by rising frequency. `modes` are
/// natural frequencies and damping ratios, `size` is the response's size at a frequency.
///
/// A mode whose response at this place is hidden by others has no peak. A hump between modes, farther than eight
/// half-widths from each, does not count.
pub fn of(grid: &[f64], modes: &[[f64; 2]], size: &impl Fn(f64) -> f64) -> Vec<Peak> {
    let sizes: Vec<f64> = grid.iter().map(|f| size(*f)).collect();
    let nearest = |f: f64| {
        let far = |mode: &[f64; 2]| (mode[0] - f).abs();
        let order = |k: &usize, j: &usize| far(&modes[*k]).total_cmp(&far(&modes[*j]));
        (0..modes.len()).min_by(order)
    };
    let top = |k: &usize| sizes[*k] > sizes[*k - 1] && sizes[*k] >= sizes[*k + 1];
    let tops = (1..grid.len().saturating_sub(1)).filter(top);
    let bounded = tops.filter_map(|k| {
        let frequency = golden::least(grid[k - 1], grid[k + 1], |f| -size(f));
        let mode = nearest(frequency)?;
        let height = size(frequency);
        let half_power = half_power(size, frequency, grid[k + 1] - grid[k - 1]);
        let [natural, ratio] = modes[mode];
        // A hump far from every natural frequency comes from the flanks of several modes and is no resonance.
        let resonant = (frequency - natural).abs() <= FARTHEST * ratio.max(SHARP) * natural;
        // Beside an undamped mode one point of the grid is largest, but there is no largest value.
        let sharp = ratio <= 0.0 && (frequency / natural - 1.0).abs() < 2.0 * SHARP;
        let (mode, height) = (mode + 1, Some(height));
        (resonant && !sharp).then_some(Peak { mode, natural, frequency, height, half_power })
    });
    let mut peaks: Vec<Peak> = bounded.collect();
    let within = |f: f64| grid.first().is_some_and(|low| f > *low) && grid.last() > Some(&f);
    for (k, [natural, ratio]) in modes.iter().copied().enumerate() {
        // Near a pole the response is proportional to the inverse of the distance.
        let beside = |far: f64| size(natural * (1.0 + far));
        if ratio <= 0.0 && within(natural) && beside(1e-8) > 5.0 * beside(1e-7) {
            let (mode, frequency) = (k + 1, natural);
            peaks.push(Peak { mode, natural, frequency, height: None, half_power: None });
        }
    }
    peaks.sort_by(|a, b| a.frequency.total_cmp(&b.frequency));
    peaks
}

/// The frequencies on both sides of a peak where the response has fallen to half the power (Hz), searched from steps of
/// a tenth of `width` on.
pub fn half_power(size: &impl Fn(f64) -> f64, peak: f64, width: f64) -> Option<[f64; 2]> {
    let half = FRAC_1_SQRT_2 * size(peak);
    let side = |direction: f64| {
        let (mut step, mut near, mut before) = (0.1 * width, peak, size(peak));
        loop {
            let far = near + direction * step;
            let now = if far > 0.0 { size(far) } else { f64::INFINITY };
            if now.partial_cmp(&(before * (1.0 + 1e-9))).is_none_or(|order| order.is_gt()) {
                return None;
            }
            if now <= half {
                return Some(crossing(size, half, [near, far]));
            }
            (near, before, step) = (far, now, 1.2 * step);
        }
    };
    Some([side(-1.0)?, side(1.0)?])
}

/// Where a function falls to a value, between an end above it and one that is not above.
fn crossing(size: &impl Fn(f64) -> f64, value: f64, [mut above, mut below]: [f64; 2]) -> f64 {
    for _ in 0..60 {
        let middle = 0.5 * (above + below);
        *(if size(middle) > value { &mut above } else { &mut below }) = middle;
    }
    0.5 * (above + below)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Hysteretic modes of unit stiffness: natural frequency and loss factor.
    fn sum(modes: &[[f64; 2]], f: f64) -> f64 {
        let [mut real, mut imaginary] = [0.0, 0.0];
        for [natural, loss] in modes {
            let (a, b) = (1.0 - (f / natural).powi(2), *loss);
            real += a / (a * a + b * b);
            imaginary -= b / (a * a + b * b);
        }
        real.hypot(imaginary)
    }

    /// Of one mode 1/(1 − r² + iη) the peak is at r = 1, 1/η high, and r² = 1 ± η at half power.
    #[test]
    fn a_single_mode_has_its_peak_and_its_damping_to_all_digits() {
        for loss in [1e-4, 4e-3, 0.1] {
            let (natural, ratio) = (170.0, 0.5 * loss);
            let size = |f: f64| sum(&[[natural, loss]], f);
            let mut grid = around(natural, ratio);
            grid.extend([20.0, 300.0]);
            grid.sort_by(f64::total_cmp);
            let [peak] = of(&grid, &[[natural, ratio]], &size)[..] else { panic!("{loss}") };
            assert_eq!(peak.mode, 1);
            assert!((peak.frequency / natural - 1.0).abs() < 1e-6 * loss.max(1e-2), "{peak:?}");
            assert!((peak.height.unwrap() * loss - 1.0).abs() < 1e-8, "{peak:?}");
            let [low, high] = peak.half_power.unwrap();
            assert!((low / (natural * (1.0 - loss).sqrt()) - 1.0).abs() < 1e-7, "{peak:?}");
            assert!((high / (natural * (1.0 + loss).sqrt()) - 1.0).abs() < 1e-7, "{peak:?}");
            let found = peak.damping_ratio().unwrap();
            assert!((found / ratio - 1.0).abs() < 1e-4, "{found} of {ratio}");
        }
    }

    /// Of viscous damping the half-power points are at r² = 1 − 2ζ² ± 2ζ√(1 − ζ²).
    #[test]
    fn a_viscous_mode_has_its_damping_to_second_order() {
        let ratio = 0.02;
        let size = |f: f64| {
            let r = f / 100.0;
            1.0 / (1.0 - r * r).hypot(2.0 * ratio * r)
        };
        let mut grid = around(100.0, ratio);
        grid.sort_by(f64::total_cmp);
        let [peak] = of(&grid, &[[100.0, ratio]], &size)[..] else { panic!() };
        let found = peak.damping_ratio().unwrap();
        assert!((found / ratio - 1.0).abs() < 3.0 * ratio * ratio, "{found}");
        assert!((peak.frequency / 100.0 - (1.0 - 2.0 * ratio * ratio).sqrt()).abs() < 1e-7);
    }

    /// Even if the requested grid is coarse, the points around the natural frequencies come within 1 % of every peak of
    /// a sum of modes.
    #[test]
    fn a_grid_with_the_points_around_its_modes_misses_no_peak() {
        let modes: Vec<[f64; 2]> = [170.0, 571.0, 1161.0].map(|f| [f, 3e-3]).to_vec();
        let size = |f: f64| sum(&modes, f);
        let ratios: Vec<[f64; 2]> = modes.iter().map(|[f, loss]| [*f, 0.5 * loss]).collect();
        let mut grid: Vec<f64> = ratios.iter().flat_map(|[f, ratio]| around(*f, *ratio)).collect();
        grid.extend([10.0, 1500.0]);
        grid.sort_by(f64::total_cmp);
        let peaks = of(&grid, &ratios, &size);
        assert_eq!(peaks.iter().map(|peak| peak.mode).collect::<Vec<_>>(), [1, 2, 3]);
        for peak in peaks {
            let near = grid.iter().filter(|f| (*f / peak.natural - 1.0).abs() < 0.01);
            let largest = near.map(|f| size(*f)).fold(0.0, f64::max);
            let height = peak.height.unwrap();
            // The top is looked for within 1e-9 of its frequency, of a half-width of 1.5e-3: 1e-12.
            assert!(largest <= height * (1.0 + 1e-11) && largest > 0.99 * height, "{peak:?}");
            assert!((peak.damping_ratio().unwrap() / 1.5e-3 - 1.0).abs() < 0.02, "{peak:?}");
        }
    }

    #[test]
    fn an_undamped_mode_has_a_peak_without_bound() {
        let size = |f: f64| 1.0 / (1.0 - (f / 170.0).powi(2)).abs();
        let mut grid = around(170.0, 0.0);
        assert!(!grid.contains(&170.0));
        grid.extend([20.0, 300.0]);
        grid.sort_by(f64::total_cmp);
        let [peak] = of(&grid, &[[170.0, 0.0]], &size)[..] else { panic!() };
        assert_eq!((peak.frequency, peak.height, peak.damping_ratio()), (170.0, None, None));
    }
}
