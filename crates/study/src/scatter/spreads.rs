//! How do bats of one model and swings of one batter differ?
//!
//! Each difference is a normal number: the logarithm of a factor (density, moduli), a factor less one (swing, pitch,
//! moisture), or an amount (e₀, the impact point). Moisture m multiplies the mass of the wood by (1 + m), and lowers E
//! and G by 1.3 % for every per cent.
//!
//! # Source
//!
//! The effect of moisture on the moduli is from memory of wood handbooks (about 1.3 % a per cent below fibre
//! saturation); give a calibrated figure where it matters.

use crate::engine::{Error, Result};
use crate::many::design::{Design, DesignTerms, PointSpread};
use crate::many::distribution::Distribution;
use crate::scatter::turning::Turning;

/// Loss of E and G for a unit of moisture, relative.
pub const SOFTENED: f64 = 1.3;
/// Number of scrambles; their differences give each percentile's error.
pub const SCRAMBLES: u64 = 8;

/// What differs between two bats or two swings.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Differs {
    /// Density of the wood, a factor.
    Density,
    /// E of the wood, a factor; G follows unless it has its own factor.
    YoungsModulus,
    /// G/E of the wood, a factor.
    ShearOverYoung,
    /// G of the wood, its own factor (as from a calibration).
    ShearModulus,
    /// Density of the barrel's region, a factor (as from a calibration).
    BarrelDensity,
    /// E of the barrel's region over that of the handle, a factor (as from a calibration).
    ModulusRatio,
    /// The lathe's error.
    Turned(Turning),
    /// Moisture, a share of the mass.
    Moisture,
    /// Speed of the swing, a factor less one.
    SwingSpeed,
    /// Speed of the pitch, a factor less one.
    Pitch,
    /// Coefficient of restitution of the ball.
    Cor,
    /// The impact point (m).
    Impact,
}

impl Differs {
    /// Its name in a file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Density => "density",
            Self::YoungsModulus => "youngs_modulus",
            Self::ShearOverYoung => "shear_over_young",
            Self::ShearModulus => "shear_modulus",
            Self::BarrelDensity => "density_barrel",
            Self::ModulusRatio => "youngs_modulus_ratio",
            Self::Turned(_) => "turning",
            Self::Moisture => "moisture",
            Self::SwingSpeed => "swing_speed",
            Self::Pitch => "pitch",
            Self::Cor => "cor",
            Self::Impact => "impact",
        }
    }

    /// Its unit in a table; factors have none.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Impact | Self::Turned(_) => "m",
            _ => "",
        }
    }

    /// Number of random numbers that it takes on a bat of that length (m).
    pub fn numbers(self, length: f64) -> usize {
        match self {
            Self::Turned(turning) => turning.splines(length),
            _ => 1,
        }
    }
}

/// A difference and its standard deviation; that of turning is part of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Difference {
    /// The kind.
    pub what: Differs,
    /// Standard deviation of its number.
    pub deviation: f64,
}

/// Everything that differs.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Differences {
    /// In the order of the file, which is that of Cholesky's factor: of two correlated ones the later counts with the
    /// earlier known.
    pub all: Vec<Difference>,
    /// Correlations of two of them, by their indices.
    pub correlations: Vec<(usize, usize, f64)>,
}

impl Differences {
    /// For each number that is drawn on a bat of that length (m) the difference that it belongs to.
    pub fn groups(&self, length: f64) -> Vec<usize> {
        let each = self.all.iter().enumerate();
        each.flat_map(|(k, one)| std::iter::repeat_n(k, one.what.numbers(length))).collect()
    }

    /// The names of the earlier ones with which one is correlated.
    pub fn given(&self, k: usize) -> Vec<&'static str> {
        let before = |(a, b, r): &(usize, usize, f64)| {
            let (early, late) = (*a.min(b), *a.max(b));
            (late == k && *r != 0.0).then(|| self.all[early].what.name())
        };
        self.correlations.iter().filter_map(before).collect()
    }

    /// The eight designs, with the given number of points together, for a bat of that length (m).
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for a number of points that is not a power of two from 64 to 2^20, and as [`Design::new`].
    pub fn designs(&self, length: f64, points: u64, seed: u64) -> Result<Vec<Design>> {
        if !points.is_power_of_two() || !(64..=1 << 20).contains(&points) {
            let expected = "a power of two from 64 to 1048576, such as 1024";
            return Err(Error::value("points", points, expected));
        }
        let groups = self.groups(length);
        let first = |k: usize| groups.iter().position(|group| *group == k).unwrap_or(0);
        let correlations: Vec<(usize, usize, f64)> =
            self.correlations.iter().map(|(a, b, r)| (first(*a), first(*b), *r)).collect();
        let normal = |k: &usize| {
            let turned = matches!(self.all[*k].what, Differs::Turned(_));
            let deviation = if turned { 1.0 } else { self.all[*k].deviation };
            Distribution::Normal { mean: 0.0, deviation }
        };
        let drawn: Vec<Distribution> = groups.iter().map(normal).collect();
        let design = |scramble: u64| {
            Design::new(DesignTerms {
                lists: vec![],
                drawn: drawn.clone(),
                correlations: correlations.clone(),
                points: points / SCRAMBLES,
                spread: PointSpread::Sobol,
                seed: crate::many::hash::of(seed, scramble, 0),
            })
        };
        (0..SCRAMBLES).map(design).collect()
    }
}

/// The factor on E and G for a share of moisture.
pub fn softened(moisture: f64) -> f64 {
    (1.0 - SOFTENED * moisture).max(0.01)
}
