//! The estimate of a property of the wood.

use serde::Serialize;

use crate::calibrate::fit::{Fit, Search};
use crate::calibrate::posterior::Posterior;
use crate::calibrate::unknowns::{Property, UNKNOWNS, form};
use crate::engine::Result;

/// An E or density farther from the file's than this many standard deviations of the prior knowledge, and than that
/// factor, belongs to another material.
const FOREIGN: [f64; 2] = [3.0, 1.25];
/// Information about a parameter that counts as determined, and as not determined: `1 − σ²/σ₀²`.
const DETERMINED: f64 = 0.9;
const UNDETERMINED: f64 = 0.1;
/// Two parameters with a correlation above this are known only together, unless both are known to a twentieth.
const TOGETHER: f64 = 0.95;
const WELL_KNOWN: f64 = 0.05;
/// The shares of a distribution that enclose 95 of 100.
const ENDS: [f64; 2] = [0.025, 0.975];

/// How well the readings determine a parameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// The readings alone determine it.
    Determined,
    /// The readings and the prior knowledge.
    Partly,
    /// Only together with another one: the readings determine a product or a quotient of the two.
    OnlyTogether,
    /// The readings do not determine it: only the prior knowledge.
    NotDetermined,
    /// It was not sought.
    Held,
}

/// A parameter of the wood.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Estimated {
    /// Its name, as in a bat file.
    #[serde(rename = "name")]
    #[schemars(with = "String")]
    pub property: Property,
    /// Its unit.
    pub unit: &'static str,
    /// Its value.
    pub value: f64,
    /// Interval that contains it in 95 of 100 cases.
    pub interval95: [f64; 2],
    /// Standard deviation of its natural logarithm.
    pub relative_sd: f64,
    /// Value before anything was measured.
    pub prior: f64,
    /// Standard deviation of its natural logarithm before anything was measured.
    pub prior_relative_sd: f64,
    /// Information from the readings, from 0 to 1: one less its variance over the prior variance.
    // Of G, of G/E.
    pub learned: f64,
    /// The parameter with the largest correlation.
    #[schemars(with = "Option<String>")]
    pub correlated_with: Option<Property>,
    /// Correlation of their logarithms.
    pub correlation: Option<f64>,
    /// How well it is determined.
    pub verdict: Verdict,
}

impl Estimated {
    /// Ratio to the file's value, if it is beyond the difference between pieces of one material.
    pub fn foreign(&self) -> Option<f64> {
        let own = matches!(self.property, Property::YoungsModulus | Property::Density);
        let (times, [deviations, factor]) = (self.value / self.prior, FOREIGN);
        let far = times.ln().abs() > (deviations * self.prior_relative_sd).max(factor.ln());
        (own && far).then_some(times)
    }

    /// Whether it is a density that no material of the file's kind has: then the profile is wrong.
    pub(super) fn is_foreign_density(&self) -> bool {
        self.property == Property::Density && self.foreign().is_some()
    }
}

/// The parameters and their uncertainties; the covariance of all unknowns, 0 for those that were held.
pub(super) fn estimated(search: &Search, fit: &Fit) -> Result<(Vec<Estimated>, Vec<Vec<f64>>)> {
    let known = Uncertainties::of(search, fit)?;
    let all = known.properties.iter().map(|property| known.estimated(*property)).collect();
    Ok((all, known.left))
}

/// The uncertainties of the unknowns, before and after.
struct Uncertainties<'a> {
    search: &'a Search<'a>,
    fit: &'a Fit,
    properties: &'static [Property],
    free: Vec<usize>,
    posterior: Posterior,
    /// Prior covariance, and that after the readings: 0 for the held unknowns, which are taken as exact.
    before: Vec<Vec<f64>>,
    left: Vec<Vec<f64>>,
}

impl<'a> Uncertainties<'a> {
    fn of(search: &'a Search<'a>, fit: &'a Fit) -> Result<Self> {
        let data: Vec<_> = fit.residuals.iter().map(|residual| residual.datum).collect();
        let posterior = Posterior::of(search, &data, fit)?;
        let (before, left) = (search.prior(), posterior.covariance());
        let (properties, free) = (Property::of(search.wood.regions()), search.free());
        Ok(Self { search, fit, properties, free, posterior, before, left })
    }

    fn is_free(&self, property: Property) -> bool {
        self.free.contains(&(property as usize))
    }

    /// Its logarithm as a sum of the unknowns.
    fn parts(&self, property: Property) -> Vec<f64> {
        property.parts(self.before.len())
    }

    /// The file's value and the fitted one.
    fn values(&self, property: Property) -> [f64; 2] {
        let start = &self.search.wood.materials(&[0.0; UNKNOWNS])[0];
        let centre = match property {
            Property::YoungsModulus => start.youngs_modulus,
            Property::ShearModulus => start.shear_modulus.unwrap_or(0.0),
            Property::Density | Property::BarrelDensity => start.density,
            Property::ModulusRatio => 1.0,
        };
        let parts = self.parts(property);
        let log: f64 = parts.iter().zip(&self.fit.logs).map(|(part, log)| part * log).sum();
        [centre, centre * log.exp()]
    }

    /// Information about the estimate or about its own unknown, whichever is less.
    fn learned(&self, property: Property) -> f64 {
        if !self.is_free(property) {
            return 0.0;
        }
        let of =
            |parts: &[f64]| 1.0 - form(&self.left, parts, parts) / form(&self.before, parts, parts);
        let mut own = vec![0.0; self.before.len()];
        own[property as usize] = 1.0;
        of(&own).min(of(&self.parts(property)))
    }

    /// The parameter with the largest correlation, and the correlation.
    fn correlated(&self, property: Property) -> Option<(Property, f64)> {
        let parts = self.parts(property);
        let correlation = |other: &Property| {
            let theirs = self.parts(*other);
            let sizes = form(&self.left, &theirs, &theirs) * form(&self.left, &parts, &parts);
            let r = form(&self.left, &parts, &theirs) / sizes.sqrt();
            (sizes > 0.0).then_some((*other, r))
        };
        let others = self.properties.iter().filter(|other| **other != property);
        others.filter_map(correlation).max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))
    }

    fn estimated(&self, property: Property) -> Estimated {
        let parts = self.parts(property);
        let [centre, value] = self.values(property);
        let known = form(&self.before, &parts, &parts);
        let deviation = form(&self.left, &parts, &parts).min(known).sqrt();
        let end = |share| centre * self.posterior.quantile(&parts, share).exp();
        let (learned, correlated) = (self.learned(property), self.correlated(property));
        let together = correlated.is_some_and(|(_, r)| r.abs() > TOGETHER);
        Estimated {
            property,
            unit: property.unit(),
            value,
            interval95: ENDS.map(end),
            relative_sd: deviation,
            prior: centre,
            prior_relative_sd: known.sqrt(),
            learned,
            correlated_with: correlated.map(|(other, _)| other),
            correlation: correlated.map(|(_, r)| r),
            verdict: match learned {
                _ if !self.is_free(property) => Verdict::Held,
                learned if learned <= UNDETERMINED => Verdict::NotDetermined,
                _ if together && deviation > WELL_KNOWN => Verdict::OnlyTogether,
                learned if learned > DETERMINED => Verdict::Determined,
                _ => Verdict::Partly,
            },
        }
    }
}
