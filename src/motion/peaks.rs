//! Where does a frequency response peak, how high, and how wide?
//!
//! [`Frf::peaks`] looks at every mode by itself, not at a list of frequencies, so that none is missed however
//! narrow it is; [`around`] has the frequencies that show it.

use crate::base::golden;
use crate::motion::frf::{Frf, Kind};

/// A peak of a response.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct Peak {
    /// Number of the mode, 1 for the lowest bending mode.
    pub mode: usize,
    /// Where the answer is largest (Hz).
    pub frequency: f64,
    /// Size of the answer there, in the unit of its kind; None where nothing damps the mode: it is without
    /// bound.
    pub size: Option<f64>,
    /// Damping ratio by the width at 1/√2 of the size; None where the answer does not fall so far on both
    /// sides.
    pub damping: Option<f64>,
}

/// Damping below that is none: a peak so narrow is lost in the frequencies' own digits.
const UNDAMPED: f64 = 1e-12;

impl Frf {
    /// Peaks between two frequencies (Hz), of the strains there are: after [`Frf::receptances`]. A mode that
    /// has a node at one of the two places has none, and one that is lost in its neighbours has none.
    ///
    /// The damping ratio is `(f₂ − f₁)/(f₁ + f₂)` of the frequencies at which the answer has half of its
    /// peak's power, which for a mode far from the others is its own ζ but for terms of order ζ².
    ///
    /// # Source
    ///
    /// D. J. Ewins, Modal Testing: Theory, Practice and Application, 2nd ed. (Research Studies Press, 2000),
    /// section 4.2.2, the peak-amplitude method.
    pub fn peaks(&self, kind: Kind, [low, high]: [f64; 2]) -> Vec<Peak> {
        let modes = &self.solution.modes;
        let inside = (0..modes.len()).filter(|k| (low..=high).contains(&modes[*k].frequency()));
        inside.filter_map(|k| self.peak(kind, k)).collect()
    }

    /// Size of the answer.
    fn size(&self, kind: Kind, frequency: f64) -> f64 {
        (self.receptance(frequency) * kind.of(frequency)).norm()
    }

    /// The peak of mode k, counted from 0.
    fn peak(&self, kind: Kind, k: usize) -> Option<Peak> {
        /// So many half widths from a mode's own frequency its peak is looked for, and its sides.
        const REACH: f64 = 8.0;
        /// Deflections of a shape, whose largest is 1, that are a node's but for round-off.
        const NODE: f64 = 1e-9;
        let modes = &self.solution.modes;
        let damped = self.solution.damping.modes.get(k);
        let (own, ratio) = damped.map_or((modes[k].frequency(), 0.0), |damped| {
            (damped.natural / std::f64::consts::TAU, damped.ratio)
        });
        let moved = self.points().map(|x| modes[k].shape.deflection(x).abs());
        if moved[0] * moved[1] < NODE || ratio >= 1.0 {
            return None;
        }
        let mode = modes[k].order;
        if ratio < UNDAMPED {
            return Some(Peak { mode, frequency: own, size: None, damping: None });
        }
        // Half way to the neighbours another mode's peak begins.
        let beside = [k.checked_sub(1), Some(k + 1)];
        let beside = beside.map(|k| k.and_then(|k| modes.get(k)).map(|mode| mode.frequency()));
        let room = |other: Option<f64>| other.map_or(own, |other| 0.5 * (other - own).abs());
        let reach = beside.map(|other| room(other).min(REACH * ratio * own).min(0.9 * own));
        let [from, to] = [own - reach[0], own + reach[1]];
        let frequency = golden::least(from, to, |f| -self.size(kind, f));
        let size = self.size(kind, frequency);
        if [from, to].iter().any(|end| self.size(kind, *end) >= size) {
            return None;
        }
        let half = |end: f64| {
            self.falls_to(kind, size * std::f64::consts::FRAC_1_SQRT_2, [frequency, end])
        };
        let halves = half(from).zip(half(to));
        let damping = halves.map(|(below, above)| (above - below) / (above + below));
        Some(Peak { mode, frequency, size: Some(size), damping })
    }

    /// Where the answer has fallen to that size between a peak and an end; None where it has not.
    fn falls_to(&self, kind: Kind, size: f64, [mut above, mut below]: [f64; 2]) -> Option<f64> {
        const STEPS: usize = 52;
        if self.size(kind, below) > size {
            return None;
        }
        for _ in 0..STEPS {
            let middle = 0.5 * (above + below);
            *(if self.size(kind, middle) > size { &mut above } else { &mut below }) = middle;
        }
        Some(0.5 * (above + below))
    }
}

/// Frequencies (Hz) that show a peak from its foot to its top: at the top, and half widths and parts of
/// them beside it; of one without bound, ever nearer to it on both sides.
pub fn around(peak: &Peak) -> Vec<f64> {
    const WIDTHS: [f64; 6] = [0.25, 0.5, 1.0, 2.0, 4.0, 8.0];
    const NEARER: [f64; 4] = [1e-2, 3e-3, 1e-3, 3e-4];
    let top = peak.size.map(|_| peak.frequency);
    let shares: Vec<f64> = match (peak.size, peak.damping) {
        (None, _) => NEARER.to_vec(),
        (_, Some(damping)) => WIDTHS.iter().map(|width| width * damping).collect(),
        _ => vec![],
    };
    let sides = shares.into_iter().filter(|share| *share < 0.5);
    let sides =
        sides.flat_map(|share| [peak.frequency * (1.0 - share), peak.frequency * (1.0 + share)]);
    top.into_iter().chain(sides).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bat::body::Bat;
    use crate::modes::solve::Request;
    use std::path::Path;

    fn dowel(loss: f64) -> Bat {
        let text = format!(
            r#"{{ "format": "sweetspot-bat/1", "profile": {{ "x": [0, 0.8], "radius": [0.02, 0.02] }},
                 "material": {{ "density": 700, "youngs_modulus": 14e9, "loss_factor": {loss} }} }}"#
        );
        Bat::from_text("dowel.json", &text, Path::new("")).unwrap()
    }

    fn response(bat: &Bat, at: f64, to: f64) -> Frf {
        let mut frf = Frf::new(bat, &Request { modes: 6, ..Request::default() }, at, to).unwrap();
        frf.receptances(&[10.0, 100.0, 1000.0, 5000.0]).unwrap();
        frf
    }

    /// A lightly damped mode far from others: mobility `φ(a) φ(x)/(2ζωm)` at its frequency, the width its
    /// own damping, and a constant loss factor is twice that.
    #[test]
    fn a_peak_is_that_of_one_oscillator() {
        let loss = 1e-4;
        let frf = response(&dowel(loss), 0.8, 0.15);
        let peaks = frf.peaks(Kind::Mobility, [1.0, 1e4]);
        assert_eq!(peaks.iter().map(|peak| peak.mode).collect::<Vec<_>>(), [1, 2, 3, 4, 5, 6]);
        for (peak, mode) in peaks.iter().zip(&frf.solution.modes) {
            let gain = mode.shape.deflection(0.8) * mode.shape.deflection(0.15) / mode.modal_mass;
            let known = gain.abs() / (loss * mode.omega);
            assert!((peak.size.unwrap() / known - 1.0).abs() < 1e-3, "{peak:?} {known}");
            assert!((peak.damping.unwrap() / (0.5 * loss) - 1.0).abs() < 2e-3, "{peak:?}");
            assert!((peak.frequency / mode.frequency() - 1.0).abs() < 1e-7, "{peak:?}");
        }
    }

    /// No frequency of a fine scan answers more than the nearest peak, nor is there a top without a peak.
    #[test]
    fn a_fine_scan_finds_the_same_peaks() {
        let frf = response(&dowel(0.01), 0.8, 0.8);
        for kind in Kind::ALL {
            let peaks = frf.peaks(kind, [20.0, 5000.0]);
            let scan: Vec<f64> =
                (0..60_000).map(|k| 20.0 * 250f64.powf(f64::from(k) / 6e4)).collect();
            let sizes: Vec<f64> = scan.iter().map(|f| frf.size(kind, *f)).collect();
            let tops: Vec<usize> = (1..scan.len() - 1)
                .filter(|k| sizes[*k] > sizes[k - 1] && sizes[*k] > sizes[k + 1])
                .collect();
            assert_eq!(tops.len(), peaks.len(), "{kind:?}");
            for (top, peak) in tops.iter().zip(&peaks) {
                assert!((scan[*top] / peak.frequency - 1.0).abs() < 2e-4, "{kind:?} {peak:?}");
                assert!((peak.size.unwrap() / sizes[*top] - 1.0).abs() < 1e-3, "{kind:?} {peak:?}");
            }
        }
    }

    /// A free bat's middle is a node of every second mode, and what nothing damps has no top.
    #[test]
    fn nodes_have_no_peak_and_undamped_modes_no_size() {
        let frf = response(&dowel(0.0), 0.4, 0.4);
        let peaks = frf.peaks(Kind::Receptance, [1.0, 1e4]);
        assert_eq!(peaks.iter().map(|peak| peak.mode).collect::<Vec<_>>(), [1, 3, 5]);
        assert!(peaks.iter().all(|peak| peak.size.is_none() && around(peak).len() == 8));
    }
}
