//! What is the remaining uncertainty of the wood, after readings and prior knowledge?
//!
//! G/E is often hardly determined, and E then follows it along a curve. The distribution of the unknowns θ is therefore
//! a sum of Gaussians, one at each value γ of ln G/E, weighted by how well that value explains the readings:
//!
//! ```text
//! p(θ) = Σ w_k N(θ; θ_k, C_k),   w_k ∝ exp(−½ χ²(θ_k)),   θ_k the best fit with γ_k,  γ_k evenly spaced
//! ```
//!
//! The determinant of C_k, a factor of w_k, is the same for all: tones are proportional to powers of E and density, so
//! their derivatives by logarithms are constant. If G/E is well known, one Gaussian is enough.
//!
//! # Source
//!
//! A. Gelman and others, Bayesian Data Analysis (3rd edition, CRC 2013), sections 3.1 and 10.3: averaging over
//! nuisance parameters on a grid, the conditional posterior of the others in closed form.

use std::f64::consts::SQRT_2;

use crate::calibrate::fit::{Datum, Fit, Search};
use crate::calibrate::unknowns::{Property, form};
use crate::engine::{Result, threads};

/// If the relative error of G/E is below this, one Gaussian is enough.
const KNOWN: f64 = 0.10;
/// Values of G/E extend to this many standard deviations on both sides.
const VALUES: usize = 13;
const REACH: f64 = 3.3;
/// Number of points at which the distribution is evaluated between two of them.
const BETWEEN: usize = 6;
/// Place of G/E among the unknowns.
const SHEAR: usize = 1;

/// A Gaussian, and its weight.
#[derive(Debug, Clone)]
struct Component {
    weight: f64,
    mean: Vec<f64>,
    covariance: Vec<Vec<f64>>,
}

/// The distribution of the logarithms of the unknowns: a sum of Gaussians.
#[derive(Debug, Clone)]
pub struct Posterior(Vec<Component>);

impl Posterior {
    /// The distribution after these data, which that fit matches best, and the prior knowledge.
    ///
    /// # Errors
    ///
    /// As [`Search::fit`].
    pub fn of(search: &Search, data: &[Datum], fit: &Fit) -> Result<Self> {
        let own = fit.covariance[SHEAR][SHEAR].sqrt();
        let unknowns = fit.covariance.len();
        let part = |weight: f64, fit: &Fit| Component {
            weight,
            mean: fit.logs[..unknowns].to_vec(),
            covariance: fit.covariance.clone(),
        };
        // For a fit that has not converged a better distribution is not worth while.
        if own < KNOWN || !fit.settled {
            return Ok(Self(vec![part(1.0, fit)]));
        }
        let before = search.prior()[SHEAR][SHEAR].sqrt();
        // The curve bends: its tails may lie farther out than the Gaussian at the best fit predicts.
        let step = REACH * before.min(1.5 * own) / (VALUES / 2) as f64;
        let held: Vec<Property> =
            search.held.iter().copied().chain([Property::ShearModulus]).collect();
        let along = Search { held: &held, ..*search };
        let modes = fit.shown.frequencies.len();
        let fits = threads::map(VALUES, |k| {
            let mut from = fit.logs;
            from[SHEAR] += step * (k as f64 - (VALUES / 2) as f64);
            along.fit(data, modes, &from)
        });
        // The bat cannot be of a wood with which it cannot be solved.
        let fits: Vec<Fit> = fits.into_iter().filter_map(|fit| fit.ok()).collect();
        let best = fits.iter().map(|fit| fit.chi2).fold(f64::INFINITY, f64::min);
        let mut parts: Vec<Component> =
            fits.windows(2).flat_map(|pair| between(pair, best, unknowns)).collect();
        let all: f64 = parts.iter().map(|part| part.weight).sum();
        parts.iter_mut().for_each(|part| part.weight /= all);
        Ok(Self(parts))
    }

    /// Covariance of the unknowns.
    pub fn covariance(&self) -> Vec<Vec<f64>> {
        let unknowns = self.0.first().map_or(0, |part| part.mean.len());
        let mean = |i: usize| self.0.iter().map(|part| part.weight * part.mean[i]).sum::<f64>();
        let means: Vec<f64> = (0..unknowns).map(mean).collect();
        let entry = |i: usize, j: usize| {
            let of = |part: &Component| {
                let apart = (part.mean[i] - means[i]) * (part.mean[j] - means[j]);
                part.weight * (part.covariance[i][j] + apart)
            };
            self.0.iter().map(of).sum()
        };
        (0..unknowns).map(|i| (0..unknowns).map(|j| entry(i, j)).collect()).collect()
    }

    /// The value below which a sum of unknowns lies with that probability.
    pub fn quantile(&self, parts: &[f64], probability: f64) -> f64 {
        let mean = |part: &Component| part.mean.iter().zip(parts).map(|(m, p)| m * p).sum::<f64>();
        let normal = |part: &Component| {
            let variance = form(&part.covariance, parts, parts);
            (part.weight, mean(part), variance.max(0.0).sqrt())
        };
        let all: Vec<(f64, f64, f64)> = self.0.iter().map(normal).collect();
        let below = |x: f64| -> f64 {
            let of = |(weight, mean, sigma): &(f64, f64, f64)| match *sigma > 0.0 {
                true => weight * 0.5 * libm::erfc((mean - x) / (sigma * SQRT_2)),
                false => weight * f64::from(u8::from(x >= *mean)),
            };
            all.iter().map(of).sum()
        };
        let reach = |(_, mean, sigma): &(f64, f64, f64)| [mean - 10.0 * sigma, mean + 10.0 * sigma];
        let ends = all.iter().map(reach).reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]);
        let [mut low, mut high] = ends.unwrap_or_default();
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if below(middle) < probability { low = middle } else { high = middle }
        }
        0.5 * (low + high)
    }
}

/// Gaussians from one value of G/E to the next, between which means, covariances and χ² are interpolated linearly.
fn between(pair: &[Fit], best: f64, unknowns: usize) -> Vec<Component> {
    let [from, to] = [&pair[0], &pair[1]];
    let at = |k: usize| {
        let share = (k as f64 + 0.5) / BETWEEN as f64;
        let mix = |a: f64, b: f64| (1.0 - share) * a + share * b;
        let row =
            |(a, b): (&Vec<f64>, &Vec<f64>)| a.iter().zip(b).map(|(a, b)| mix(*a, *b)).collect();
        Component {
            weight: (-0.5 * (mix(from.chi2, to.chi2) - best)).exp(),
            mean: (0..unknowns).map(|i| mix(from.logs[i], to.logs[i])).collect(),
            covariance: from.covariance.iter().zip(&to.covariance).map(row).collect(),
        }
    };
    (0..BETWEEN).map(at).collect()
}
