//! Which measurement would add most?
//!
//! A further datum y with σ reduces the covariance C to
//!
//! ```text
//! C − C g gᵀ C/(σ² + gᵀ C g),   g = ∂y/∂θ
//! ```
//!
//! so no bat has to be solved to find its value.

use serde::Serialize;

use crate::calibrate::fit::{DatumKind, Fit, Search};
use crate::calibrate::unknowns::form;
use crate::calibrate::wood::Slopes;

/// Number of modes solved beyond the highest one measured; the first of them is proposed.
pub const BEYOND: usize = 2;

/// A measurement that was not made.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Proposal {
    /// Its name.
    #[serde(rename = "name")]
    #[schemars(with = "String")]
    pub kind: DatumKind,
    /// Standard deviation that it is thought to have, of reading and beam.
    pub sd: f64,
    /// Factor on the interval of every parameter, in their order.
    pub factors: Vec<f64>,
}

/// Every missing measurement, with its effect on these parameters (each a sum of unknowns).
pub fn proposals(search: &Search, fit: &Fit, parameters: &[Vec<f64>]) -> Vec<Proposal> {
    let made = |kind: DatumKind| fit.residuals.iter().any(|residual| residual.datum.kind == kind);
    let rigid =
        [(DatumKind::Mass, 1e-3), (DatumKind::BalancePoint, 1e-3), (DatumKind::Period, 1e-3)];
    let tone = |k: usize| {
        let frequency = fit.shown.frequencies[k].value;
        (DatumKind::Frequency(k + 1), f64::hypot(0.5, search.readings.model * frequency))
    };
    let order = |kind: DatumKind| match kind {
        DatumKind::Frequency(order) => order,
        _ => 0,
    };
    let highest = fit.residuals.iter().map(|residual| order(residual.datum.kind)).max();
    let tones = (0..fit.shown.frequencies.len().min(highest.unwrap_or(0) + 1)).map(tone);
    let all = rigid.into_iter().chain(tones).filter(|(kind, _)| !made(*kind));
    let proposal = |(kind, sigma): (DatumKind, f64)| {
        let Slopes { by, .. } = kind.of(&fit.shown);
        let by = &by[..fit.covariance.len()];
        let whole = sigma * sigma + form(&fit.covariance, by, by);
        let factor = |parameter: &Vec<f64>| {
            let before = form(&fit.covariance, parameter, parameter);
            let taken = form(&fit.covariance, parameter, by).powi(2) / whole;
            if before > 0.0 { (1.0 - taken / before).max(0.0).sqrt() } else { 1.0 }
        };
        Proposal { kind, sd: sigma, factors: parameters.iter().map(factor).collect() }
    };
    all.map(proposal).collect()
}
