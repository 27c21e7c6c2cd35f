//! A measured frequency response laid over the computed one.

use faer::c64;

use crate::engine::{Error, Frf, ResponseKind, Result};
use sweetspot::motion::peaks;
use sweetspot::motion::peaks::Peak;

/// A frequency response as a laboratory measured it.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredResponse {
    /// The file it is from, for people.
    pub source: String,
    /// Deflection, velocity or acceleration.
    pub kind: ResponseKind,
    /// Position of the force (m), in the file's direction and from its origin; `None` if the file does not give it.
    pub at: Option<f64>,
    /// Position of the response (m), likewise.
    pub to: Option<f64>,
    /// The nodes of force and answer.
    pub nodes: [i64; 2],
    /// Coherence at these frequencies, where the file has it.
    pub coherence: Option<Vec<f64>>,
    /// Whether its phase ran the other way round and was turned over.
    pub turned: bool,
    /// Rising frequencies (Hz) above 0, and the answer per force there, in SI.
    pub values: Vec<(f64, c64)>,
    /// Assumptions in reading it, one sentence each.
    pub assumed: Vec<String>,
}

impl MeasuredResponse {
    /// Whether force and answer are at one node.
    pub fn is_drive_point(&self) -> bool {
        self.nodes[0] == self.nodes[1]
    }
}

/// A measured response compared with the computed one at its frequencies.
#[derive(Debug, Clone, PartialEq)]
pub struct Laid {
    /// Frequencies (Hz) and measured values, in the requested kind.
    pub measured: Vec<(f64, c64)>,
    /// The computed answers at the same frequencies.
    pub computed: Vec<c64>,
    /// Frequency response assurance criterion, 1 for responses that are alike but for a factor.
    pub frac: f64,
    /// Mean of `20 log |computed/measured|` (dB).
    pub level: f64,
    /// Mean of its absolute value (dB).
    pub apart: f64,
    /// The computed peaks, each with the measured one near it.
    pub peaks: Vec<(Peak, Option<Peak>)>,
}

/// A half-power width must span this many steps of the measurement to give a damping.
const STEPS: f64 = 3.0;
/// A measured peak belongs to a mode only if it is this close (as a share of the frequency).
const NEAR: f64 = 0.3;

impl Laid {
    /// Lays the measured response over the computed one between two frequencies (Hz), with the given peaks.
    ///
    /// The criterion is the modal assurance criterion's formula with frequencies in place of points:
    ///
    /// ```text
    /// FRAC = |Σ a(ω) x̄(ω)|² / (Σ |a|² · Σ |x|²)
    /// ```
    ///
    /// Frequencies at which either is 0 have no value in dB and are left out of the means.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for fewer than three measured frequencies in that range; those of
    /// [`Frf::receptances`].
    pub fn new(
        frf: &mut Frf,
        response: &MeasuredResponse,
        kind: ResponseKind,
        (peaks, [low, high]): (&[Peak], [f64; 2]),
    ) -> Result<Self> {
        let within = |f: f64| (low..=high).contains(&f);
        let turned = |(f, value): &(f64, c64)| match kind == response.kind {
            true => (*f, *value),
            false => (*f, value * kind.of(*f) / response.kind.of(*f)),
        };
        let values = response.values.iter().filter(|(f, _)| within(*f));
        let measured: Vec<(f64, c64)> = values.map(turned).collect();
        if measured.len() < 3 {
            let found = format!("{} frequencies from {low} to {high} Hz", measured.len());
            return Err(Error::value(&response.source, found, "three at least"));
        }
        let frequencies: Vec<f64> = measured.iter().map(|(f, _)| *f).collect();
        let samples = frf.receptances(&frequencies)?;
        let computed: Vec<c64> =
            samples.iter().map(|s| s.receptance * kind.of(s.frequency)).collect();
        let pairs = || computed.iter().zip(&measured).map(|(a, (_, x))| (*a, *x));
        let common = pairs().fold(c64::new(0.0, 0.0), |sum, (a, x)| sum + a * x.conj());
        let [own, other] = pairs()
            .fold([0.0; 2], |[own, other], (a, x)| [own + a.norm_sqr(), other + x.norm_sqr()]);
        let apart = |(a, x): (c64, c64)| 20.0 * (a.norm() / x.norm()).log10();
        let levels: Vec<f64> = pairs().map(apart).filter(|level| level.is_finite()).collect();
        let mean = |sum: f64| sum / levels.len().max(1) as f64;
        let level = mean(levels.iter().sum());
        let apart = mean(levels.iter().map(|level| level.abs()).sum());
        let scale = (own * other).max(f64::MIN_POSITIVE);
        let peaks = beside(peaks, &measured);
        Ok(Self {
            frac: (common.norm_sqr() / scale).min(1.0),
            measured,
            computed,
            level,
            apart,
            peaks,
        })
    }
}

/// Every computed peak with the highest measured one between its neighbours.
fn beside(computed: &[Peak], measured: &[(f64, c64)]) -> Vec<(Peak, Option<Peak>)> {
    let between = |k: usize| match (computed.get(k), computed.get(k + 1)) {
        (Some(a), Some(b)) => (a.frequency * b.frequency).sqrt(),
        _ => f64::INFINITY,
    };
    let near = |(k, peak): (usize, &Peak)| {
        let low = if k == 0 { 0.0 } else { between(k - 1) };
        let low = low.max((1.0 - NEAR) * peak.frequency);
        let high = between(k).min((1.0 + NEAR) * peak.frequency);
        (*peak, highest(measured, [low, high], peak))
    };
    computed.iter().enumerate().map(near).collect()
}

/// The highest measured value between two frequencies that is a maximum, as a peak of that mode.
fn highest(measured: &[(f64, c64)], [low, high]: [f64; 2], of: &Peak) -> Option<Peak> {
    let size = |k: usize| measured[k].1.norm();
    let is_top = |k: &usize| size(*k) > size(*k - 1) && size(*k) >= size(*k + 1);
    let inside = |k: &usize| (low..=high).contains(&measured[*k].0);
    let tops = (1..measured.len().saturating_sub(1)).filter(inside).filter(is_top);
    let top = tops.max_by(|a, b| size(*a).total_cmp(&size(*b)))?;
    let frequency = measured[top].0;
    let step = 0.5 * (measured[top + 1].0 - measured[top - 1].0);
    let between = |f: f64| straight(measured, f);
    let half_power = peaks::half_power(&between, frequency, step);
    let half_power = half_power.filter(|[a, b]| b - a >= STEPS * step);
    Some(Peak { frequency, height: Some(size(top)), half_power, ..*of })
}

/// The size between measured values, by straight lines; infinite beyond the last.
fn straight(measured: &[(f64, c64)], f: f64) -> f64 {
    let next = measured.partition_point(|(at, _)| *at < f);
    let Some((high, above)) = measured.get(next) else { return f64::INFINITY };
    let Some((low, below)) = next.checked_sub(1).map(|k| &measured[k]) else {
        return if *high == f { above.norm() } else { f64::INFINITY };
    };
    let share = (f - low) / (high - low);
    (1.0 - share) * below.norm() + share * above.norm()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Samples of 1/(1 − r² + iη), 0.5 Hz apart: the peak within half a step and the damping within
    /// 2 % of η/2; samples as far apart as the width give no damping.
    #[test]
    fn a_sampled_mode_has_its_peak_and_its_damping() {
        let (natural, loss) = (170.3, 0.04);
        let value = |f: f64| 1.0 / c64::new(1.0 - (f / natural).powi(2), loss);
        let sampled = |step: f64| -> Vec<(f64, c64)> {
            let places = (0..).map(|k| 100.0 + step * f64::from(k)).take_while(|f| *f < 260.0);
            places.map(|f| (f, value(f))).collect()
        };
        let (frequency, height, half_power) = (natural, None, None);
        let computed = Peak { mode: 1, natural, frequency, height, half_power };
        let [(_, Some(found))] = beside(&[computed], &sampled(0.5))[..] else { panic!() };
        assert!((found.frequency - natural).abs() <= 0.25, "{found:?}");
        assert!((found.damping_ratio().unwrap() / (0.5 * loss) - 1.0).abs() < 0.02, "{found:?}");
        let [(_, Some(coarse))] = beside(&[computed], &sampled(6.0))[..] else { panic!() };
        assert_eq!(coarse.half_power, None);
        assert!(beside(&[Peak { frequency: 20.0, ..computed }], &sampled(0.5))[0].1.is_none());
    }
}
