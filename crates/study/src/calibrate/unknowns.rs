//! Which properties of the wood are sought, and what is their prior covariance?
//!
//! They are natural logarithms of the values over those of the bat file, so that no step makes a property negative and
//! all are of similar size.

use crate::calibrate::readings::{Priors, ShearPrior};
use crate::named::named;

named! {
    /// A property of the wood. The logarithm of each is sought; of G, that of G/E, the same all along the bat.
    pub enum Property {
        /// E (Pa); with two regions, of the handle.
        YoungsModulus = "youngs_modulus",
        /// G (Pa); with two regions, of the handle. With the file's shear coefficient κ: only the product κG can be found.
        ShearModulus = "shear_modulus",
        /// Density (kg/m³); with two regions, of the handle.
        Density = "density",
        /// Density of the barrel (kg/m³).
        BarrelDensity = "density_barrel",
        /// E of the barrel over E of the handle.
        ModulusRatio = "youngs_modulus_ratio",
    }
}

/// Largest number of unknowns.
pub const UNKNOWNS: usize = Property::ALL.len();

impl Property {
    /// Those of one region or two.
    pub fn of(regions: usize) -> &'static [Self] {
        if regions == 1 { &Self::ALL[..3] } else { &Self::ALL }
    }

    /// Its unit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::YoungsModulus | Self::ShearModulus => "Pa",
            Self::Density | Self::BarrelDensity => "kg/m³",
            Self::ModulusRatio => "",
        }
    }

    /// Its logarithm as a sum of the unknowns.
    pub(super) fn parts(self, unknowns: usize) -> Vec<f64> {
        let mut parts = vec![0.0; unknowns];
        parts[self as usize] = 1.0;
        if self == Self::ShearModulus {
            parts[0] = 1.0;
        }
        parts
    }
}

/// Logarithms of all properties over those of the bat file; with one region, the first three.
pub type Logs = [f64; UNKNOWNS];

/// The prior covariance of the unknowns for that number of regions.
pub fn covariance(priors: &Priors, regions: usize) -> Vec<Vec<f64>> {
    let unknowns = Property::of(regions);
    unknowns.iter().map(|a| unknowns.iter().map(|b| entry(priors, *a, *b)).collect()).collect()
}

fn entry(priors: &Priors, a: Property, b: Property) -> f64 {
    use Property::{BarrelDensity, Density, ModulusRatio, ShearModulus, YoungsModulus};
    match (a, b) {
        (YoungsModulus, YoungsModulus) => priors.youngs_modulus.powi(2),
        (ShearModulus, ShearModulus) => match priors.shear {
            ShearPrior::OverYoung(deviation) => deviation.powi(2),
            ShearPrior::Alone(deviation) => deviation.powi(2) + priors.youngs_modulus.powi(2),
        },
        // If G is independent of E, G/E is anticorrelated with E.
        (ShearModulus, other) | (other, ShearModulus) => match priors.shear {
            ShearPrior::OverYoung(_) => 0.0,
            ShearPrior::Alone(_) => -entry(priors, YoungsModulus, other),
        },
        (Density, Density) | (BarrelDensity, BarrelDensity) => priors.density.powi(2),
        (ModulusRatio, ModulusRatio) => priors.modulus_ratio.powi(2),
        (Density, BarrelDensity) | (BarrelDensity, Density) => {
            priors.densities_together * priors.density.powi(2)
        }
        (YoungsModulus, Density | BarrelDensity) | (Density | BarrelDensity, YoungsModulus) => {
            priors.correlation * priors.youngs_modulus * priors.density
        }
        _ => 0.0,
    }
}

/// The sum `Σ a_i b_j C_ij`.
pub fn form(covariance: &[Vec<f64>], a: &[f64], b: &[f64]) -> f64 {
    let row = |(row, a): (&Vec<f64>, &f64)| {
        a * row.iter().zip(b).map(|(entry, b)| entry * b).sum::<f64>()
    };
    covariance.iter().zip(a).map(row).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use sweetspot::base::linear::inverse;

    #[test]
    fn what_was_known_before_is_a_covariance_that_can_be() {
        for regions in [1, 2] {
            for shear in [ShearPrior::OverYoung(0.35), ShearPrior::Alone(0.35)] {
                let all = covariance(&Priors { shear, ..Priors::default() }, regions);
                assert!(inverse(&all).is_some());
                assert_eq!(all.len(), Property::of(regions).len());
                let sum = form(&all, &vec![1.0; all.len()], &vec![1.0; all.len()]);
                assert!((sum - all.iter().flatten().sum::<f64>()).abs() < 1e-15);
                if let ShearPrior::Alone(own) = shear {
                    // ln G is the sum of the first two.
                    let sum = all[0][0] + 2.0 * all[0][1] + all[1][1];
                    assert!((sum - own * own).abs() < 1e-15);
                }
            }
        }
    }
}
