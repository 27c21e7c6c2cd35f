//! What was found of a parameter of the wood?

use serde::Serialize;

use crate::calibrate::readings::Reading;
use crate::calibrate::unknowns::UNKNOWNS;

/// E or density further from the file's than this many standard deviations of what was known before, and than that
/// factor, is not that material.
const FOREIGN: [f64; 2] = [3.0, 1.25];

/// A parameter of the wood, in the order in which they are told.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Property {
    /// E (Pa), of the handle where there are two regions.
    YoungsModulus,
    /// G (Pa), of the handle where there are two regions; with the file's shear coefficient κ, of which only the product κG is found.
    ShearModulus,
    /// Density (kg/m³), of the handle where there are two regions.
    Density,
    /// Density of the barrel (kg/m³).
    BarrelDensity,
    /// E of the barrel over E of the handle.
    ModulusRatio,
}

impl Property {
    /// Those of the given number of regions.
    pub fn of(regions: usize) -> &'static [Self] {
        const ALL: [Property; UNKNOWNS] = [
            Property::YoungsModulus,
            Property::ShearModulus,
            Property::Density,
            Property::BarrelDensity,
            Property::ModulusRatio,
        ];
        const ONE: [Property; 3] =
            [Property::YoungsModulus, Property::ShearModulus, Property::Density];
        if regions == 1 { &ONE } else { &ALL }
    }

    /// Its name, as in a bat file.
    pub fn name(self) -> &'static str {
        match self {
            Self::YoungsModulus => "youngs_modulus",
            Self::ShearModulus => "shear_modulus",
            Self::Density => "density",
            Self::BarrelDensity => "density_barrel",
            Self::ModulusRatio => "youngs_modulus_ratio",
        }
    }

    /// Its unit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::YoungsModulus | Self::ShearModulus => "Pa",
            Self::Density | Self::BarrelDensity => "kg/m³",
            Self::ModulusRatio => "",
        }
    }

    /// The unknown that is its own: of G, G/E.
    pub(super) fn own(self) -> usize {
        match self {
            Self::YoungsModulus => 0,
            Self::ShearModulus => 1,
            Self::Density => 2,
            Self::BarrelDensity => 3,
            Self::ModulusRatio => 4,
        }
    }

    /// Its logarithm as a sum of unknowns.
    pub(super) fn parts(self, unknowns: usize) -> Vec<f64> {
        let mut parts = vec![0.0; unknowns];
        parts[self.own()] = 1.0;
        if self == Self::ShearModulus {
            parts[0] = 1.0;
        }
        parts
    }
}

/// How well the readings determine a parameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// The readings alone say it.
    Determined,
    /// The readings and what was known before.
    Partly,
    /// Only with another one: the readings know a product or a quotient of the two.
    OnlyTogether,
    /// The readings say nothing: what was known before.
    NotDetermined,
    /// It was not sought.
    Held,
}

/// What was found of a parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimated {
    /// Which.
    pub property: Property,
    /// Its value, SI.
    pub value: f64,
    /// Standard deviation of its logarithm.
    pub deviation: f64,
    /// Where it lies in 95 of 100 cases.
    pub interval: [f64; 2],
    /// Value and standard deviation of the logarithm before anything was measured.
    pub prior: Reading,
    /// What was learned, `1 − σ²/σ₀²`; of G, of G/E.
    pub learned: f64,
    /// The parameter that it goes with most, and the correlation.
    pub correlated: Option<(Property, f64)>,
    /// How well it is determined.
    pub verdict: Verdict,
}

impl Estimated {
    /// How many times the file's it is, where that is more than pieces of one material differ by.
    pub fn foreign(&self) -> Option<f64> {
        let own = matches!(self.property, Property::YoungsModulus | Property::Density);
        let (times, [deviations, factor]) = (self.value / self.prior.value, FOREIGN);
        let far = times.ln().abs() > (deviations * self.prior.deviation).max(factor.ln());
        (own && far).then_some(times)
    }

    /// Whether it is a density that no material of the file's kind has: then the profile is another one.
    pub(super) fn is_foreign_density(&self) -> bool {
        self.property == Property::Density && self.foreign().is_some()
    }
}
