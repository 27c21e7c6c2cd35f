//! Which wood fits the measurements?
//!
//! Gauss-Newton on
//!
//! ```text
//! χ² = Σ ((y − y(θ))/σ)² + θᵀ P⁻¹ θ
//! ```
//!
//! θ are the logarithms of the unknowns over the file's values, P is their prior covariance. σ² is that of the reading
//! plus, for a frequency, `(model · y)²` for the error of the beam model. A step changes no logarithm by more than 0.3,
//! and is halved until χ² falls.
//!
//! # Source
//!
//! A. Tarantola, Inverse Problem Theory (SIAM, 2005), section 3.4.1: the least-squares criterion with a Gaussian
//! prior, its quasi-Newton step and posterior covariance.

use serde::Serialize;

use crate::calibrate::readings::{BatReadings, Reading};
use crate::calibrate::unknowns::{Logs, Property, covariance, form};
use crate::calibrate::wood::{BatObservations, Slopes, WoodenBat};
use crate::engine::{Result, dot, inverse};

/// The largest change of a logarithm in one step.
const LARGEST_STEP: f64 = 0.3;
/// A fit that has not ended by then runs away.
const MOST_STEPS: usize = 40;
/// A fit has converged when its step is below this: such a step changes no printed digit.
const SETTLED: f64 = 1e-7;
/// Change of χ² that a step promises, below which the fit has settled in any case.
const LEAST_GAIN: f64 = 1e-6;
/// A fit farther than this many prior standard deviations, and than that factor, has diverged.
const RUNAWAY: [f64; 2] = [4.0, 8.0];

/// Kind of a datum; in a document by its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(into = "String")]
pub enum DatumKind {
    /// Mass (kg).
    Mass,
    /// Balance point (m).
    BalancePoint,
    /// Period of the pendulum (s).
    Period,
    /// Frequency of that bending mode, from 1 (Hz).
    Frequency(usize),
}

impl DatumKind {
    /// Its name, that of an output of the program if there is one.
    pub fn name(self) -> String {
        match self {
            Self::Mass => "mass_kg".to_owned(),
            Self::BalancePoint => "balance_point_m".to_owned(),
            Self::Period => "pendulum_period_s".to_owned(),
            Self::Frequency(order) => format!("f{order}_hz"),
        }
    }

    /// Its value for a bat.
    pub fn of(self, shown: &BatObservations) -> Slopes {
        match self {
            Self::Mass => shown.mass,
            Self::BalancePoint => shown.balance_point,
            Self::Period => shown.period,
            Self::Frequency(order) => shown.frequencies[order - 1],
        }
    }
}

impl From<DatumKind> for String {
    fn from(kind: DatumKind) -> Self {
        kind.name()
    }
}

/// Something that was measured.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Datum {
    /// Its name.
    #[serde(rename = "name")]
    #[schemars(with = "String")]
    pub kind: DatumKind,
    /// Index of the line; `None` if it is not a line.
    #[serde(skip)]
    pub line: Option<usize>,
    /// The reading.
    pub measured: f64,
    /// Standard deviation of the reading.
    pub reading_sd: f64,
    /// Standard deviation of reading and beam model together.
    pub sd: f64,
}

impl Datum {
    /// Its distance from a bat's value, `(y − y(θ))/σ`.
    fn deviations(&self, computed: f64) -> f64 {
        (self.measured - computed) / self.sd
    }
}

/// The data of these readings, with the given modes of the lines; lines without a mode are omitted.
pub fn data(readings: &BatReadings, modes: &[Option<usize>]) -> Vec<Datum> {
    let rigid = [
        (DatumKind::Mass, readings.mass),
        (DatumKind::BalancePoint, readings.balance_point),
        (DatumKind::Period, readings.pendulum.map(|pendulum| pendulum.period)),
    ];
    let rigid = rigid.into_iter().filter_map(|(kind, reading)| Some((kind, None, reading?)));
    let lines = readings.lines.iter().zip(modes).enumerate().filter_map(|(k, (line, mode))| {
        Some((DatumKind::Frequency((*mode)?), Some(k), line.frequency))
    });
    let datum = |(kind, line, reading): (DatumKind, Option<usize>, Reading)| {
        let Reading { value: measured, deviation: reading_sd } = reading;
        let model = if line.is_some() { readings.model * measured } else { 0.0 };
        Datum { kind, line, measured, reading_sd, sd: reading_sd.hypot(model) }
    };
    rigid.chain(lines).map(datum).collect()
}

/// The search: the data, the unknowns, and the start.
#[derive(Debug, Clone, Copy)]
pub struct Search<'a> {
    /// The bat.
    pub wood: &'a WoodenBat,
    /// The readings and the prior knowledge.
    pub readings: &'a BatReadings,
    /// Properties that stay as the file has them.
    pub held: &'a [Property],
    /// The centre of the prior knowledge: the file's wood, all 0, or one far from it.
    pub about: Logs,
}

/// A datum is an outlier if it differs by more standard deviations than this from the fit to all others.
pub const OUTLIER: f64 = 3.0;

/// A datum.
// Compared with the bat of the fitted wood.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Residual {
    /// The datum.
    #[serde(flatten)]
    pub datum: Datum,
    /// The value of the fitted bat.
    pub computed: f64,
    /// Measured less computed, in standard deviations.
    // `(y − y(θ))/σ`.
    pub residual_sd: f64,
    /// Reading less the prediction by the fit to all other data, in standard deviations.
    // `z/√(1 − h)`.
    pub left_out_sd: f64,
}

impl Residual {
    /// Whether it does not fit the others.
    pub fn is_outlier(&self) -> bool {
        self.left_out_sd.abs() > OUTLIER
    }
}

/// χ² of the data alone, without the prior knowledge.
pub fn misfit(data: &[Residual]) -> f64 {
    data.iter().map(|residual| residual.residual_sd.powi(2)).sum()
}

/// A fit.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// The unknowns.
    pub logs: Logs,
    /// Their covariance; 0 for held ones.
    pub covariance: Vec<Vec<f64>>,
    /// χ² including the prior knowledge.
    pub chi2: f64,
    /// Number of steps.
    pub steps: usize,
    /// Whether it converged, not too far from the prior knowledge.
    pub settled: bool,
    /// The data compared with the fitted bat.
    pub residuals: Vec<Residual>,
    /// All values of the fitted bat.
    pub shown: BatObservations,
}

fn times(matrix: &[Vec<f64>], vector: &[f64]) -> Vec<f64> {
    let product = |row: &Vec<f64>| row.iter().zip(vector).map(|(a, b)| a * b).sum();
    matrix.iter().map(product).collect()
}

/// The problem linearised at one point of the search.
struct Linear {
    chi2: f64,
    gradient: Vec<f64>,
    covariance: Vec<Vec<f64>>,
}

impl Search<'_> {
    /// The covariance of the unknowns before anything was measured.
    pub fn prior(&self) -> Vec<Vec<f64>> {
        covariance(&self.readings.priors, self.wood.regions())
    }

    /// Which unknowns are free, by their places.
    pub fn free(&self) -> Vec<usize> {
        let unknowns = Property::of(self.wood.regions()).iter().enumerate();
        unknowns.filter(|(_, unknown)| !self.held.contains(unknown)).map(|(k, _)| k).collect()
    }

    /// The wood that fits these data, starting from that one; held properties stay. Frequencies up to `modes` are
    /// computed.
    ///
    /// # Errors
    ///
    /// Those of [`WoodenBat::shown`] at the start; a bat that cannot be solved on the way ends the search.
    pub fn fit(&self, data: &[Datum], modes: usize, from: &Logs) -> Result<Fit> {
        let free = self.free();
        let prior = self.prior();
        let mut logs = *from;
        let mut shown = self.wood.shown(&logs, modes)?;
        let mut here = self.linear(data, &shown, &logs);
        let (mut steps, mut settled) = (0, false);
        while steps < MOST_STEPS && !settled {
            let step = times(&here.covariance, &here.gradient);
            let largest = step.iter().fold(0.0_f64, |most, step| most.max(step.abs()));
            let mut share = (LARGEST_STEP / largest).min(1.0);
            let downhill = loop {
                let mut next = logs;
                free.iter().zip(&step).for_each(|(k, step)| next[*k] += share * step);
                if let Ok(there) = self.wood.shown(&next, modes) {
                    let linear = self.linear(data, &there, &next);
                    if linear.chi2 <= here.chi2 || largest < SETTLED {
                        break Some((next, there, linear));
                    }
                }
                share *= 0.5;
                if share * largest < SETTLED {
                    break None;
                }
            };
            let Some((next, there, linear)) = downhill else {
                // In the round-off of χ² no step is downhill.
                settled = dot(&step, &here.gradient).abs() < LEAST_GAIN;
                break;
            };
            (logs, shown, here, steps) = (next, there, linear, steps + 1);
            settled = largest < SETTLED;
        }
        let [deviations, factor] = RUNAWAY;
        let near = |k: &usize| logs[*k].abs() <= factor.ln().max(deviations * prior[*k][*k].sqrt());
        settled &= free.iter().all(near);
        Ok(self.ended(data, shown, (logs, here), (steps, settled)))
    }

    /// The fit that ended there.
    fn ended(
        &self,
        data: &[Datum],
        shown: BatObservations,
        (logs, linear): (Logs, Linear),
        (steps, settled): (usize, bool),
    ) -> Fit {
        let Linear { chi2, covariance: of_free, .. } = linear;
        let (free, unknowns) = (self.free(), Property::of(self.wood.regions()).len());
        let mut covariance = vec![vec![0.0; unknowns]; unknowns];
        for (i, row) in free.iter().zip(&of_free) {
            free.iter().zip(row).for_each(|(j, entry)| covariance[*i][*j] = *entry);
        }
        let residual = |datum: &Datum| {
            let Slopes { value, by } = datum.kind.of(&shown);
            let z = datum.deviations(value);
            let by = &by[..unknowns];
            let leverage = form(&covariance, by, by) / datum.sd.powi(2);
            let left_out = z / (1.0 - leverage).max(1e-9).sqrt();
            Residual { datum: *datum, computed: value, residual_sd: z, left_out_sd: left_out }
        };
        let residuals = data.iter().map(residual).collect();
        Fit { logs, covariance, chi2, steps, settled, residuals, shown }
    }

    /// χ², half its downward gradient and the covariance, for the free unknowns.
    fn linear(&self, data: &[Datum], shown: &BatObservations, logs: &Logs) -> Linear {
        // Held properties count in the prior term if they differ from the file's.
        let known = inverse(&self.prior()).unwrap_or_default();
        let away: Vec<f64> = logs.iter().zip(&self.about).map(|(log, mean)| log - mean).collect();
        let (free, at) = (self.free(), &away[..known.len()]);
        let mut chi2 = form(&known, at, at);
        let mut gradient: Vec<f64> = free.iter().map(|k| -dot(&known[*k], at)).collect();
        let mut weights: Vec<Vec<f64>> =
            free.iter().map(|i| free.iter().map(|j| known[*i][*j]).collect()).collect();
        for datum in data {
            let Slopes { value, by } = datum.kind.of(shown);
            let z = datum.deviations(value);
            chi2 += z * z;
            let slopes: Vec<f64> = free.iter().map(|k| by[*k] / datum.sd).collect();
            for (i, slope) in slopes.iter().enumerate() {
                gradient[i] += slope * z;
                weights[i].iter_mut().zip(&slopes).for_each(|(w, other)| *w += slope * other);
            }
        }
        let covariance = inverse(&weights).unwrap_or_default();
        Linear { chi2, gradient, covariance }
    }
}
