//! Which value lies above that share of a distribution?
//!
//! A [`Distribution`] turns a share between 0 and 1 into a value. Only arithmetic, square roots and
//! functions of the crate `libm` are used, so that the same study gives the same values on every machine.

use std::sync::LazyLock;

use serde::{Deserialize, Serialize};

use crate::engine::{Error, Result, shortest};

/// How a number varies.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub enum Distribution {
    /// Every value between the two alike.
    Uniform {
        /// The least.
        from: f64,
        /// The greatest.
        to: f64,
    },
    /// Gauss's.
    Normal {
        /// The mean.
        mean: f64,
        /// The standard deviation.
        deviation: f64,
    },
    /// The logarithm is normal.
    Lognormal {
        /// Half of the values lie below.
        median: f64,
        /// Standard deviation of the natural logarithm.
        deviation: f64,
    },
    /// Rising from the least value to the likeliest, falling from there.
    Triangular {
        /// The least.
        from: f64,
        /// The likeliest.
        peak: f64,
        /// The greatest.
        to: f64,
    },
}

impl Distribution {
    /// Refuses an impossible distribution.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] with the name of the number that is wrong.
    pub fn check(&self) -> Result<()> {
        let positive = |what: &str, value: f64| match value > 0.0 && value.is_finite() {
            true => Ok(()),
            false => Err(Error::value(what, shortest(value), "a finite number above 0")),
        };
        let rises = |low: f64, high: f64| match low < high && (high - low).is_finite() {
            true => Ok(()),
            false => {
                let expected = format!("a number above {}", shortest(low));
                Err(Error::value("to", shortest(high), expected))
            }
        };
        match *self {
            Self::Uniform { from, to } => rises(from, to),
            Self::Normal { deviation, .. } => positive("deviation", deviation),
            Self::Lognormal { median, deviation } => {
                positive("median", median).and_then(|()| positive("deviation", deviation))
            }
            Self::Triangular { from, peak, to } => match (from..=to).contains(&peak) {
                true => rises(from, to),
                false => {
                    let expected = format!("a number from {} to {}", shortest(from), shortest(to));
                    Err(Error::value("peak", shortest(peak), expected))
                }
            },
        }
    }

    /// The value below which that share of all lies, `0 < share < 1`.
    pub fn quantile(&self, share: f64) -> f64 {
        match *self {
            Self::Uniform { from, to } => from + (to - from) * share,
            Self::Normal { mean, deviation } => mean + deviation * standard_normal(share),
            Self::Lognormal { median, deviation } => {
                median * libm::exp(deviation * standard_normal(share))
            }
            Self::Triangular { from, peak, to } => {
                let rising = (peak - from) / (to - from);
                if share < rising {
                    from + ((to - from) * (peak - from) * share).sqrt()
                } else {
                    to - ((to - from) * (to - peak) * (1.0 - share)).sqrt()
                }
            }
        }
    }
}

/// The share of a standard normal distribution that lies below a value.
pub fn share_below(value: f64) -> f64 {
    0.5 * libm::erfc(-value * std::f64::consts::FRAC_1_SQRT_2)
}

/// Numerators and denominators about a half, in both tails, and far out.
static RATIOS: LazyLock<Vec<Vec<f64>>> = LazyLock::new(|| {
    let rows = include_str!("as241.txt").lines().filter(|line| !line.starts_with('#'));
    rows.map(|row| row.split(' ').map(|n| n.parse().expect("a number")).collect()).collect()
});

/// The value below which that share of a standard normal distribution lies, to a relative 1e-15.
///
/// # Source
///
/// M. J. Wichura, Algorithm AS 241: the percentage points of the normal distribution, Applied Statistics
/// 37 (1988) 477: rational functions of degree seven, PPND16.
pub fn standard_normal(share: f64) -> f64 {
    let ratio = |which: usize, t: f64| {
        let sum = |terms: &[f64]| terms.iter().rev().fold(0.0, |sum, term| sum * t + term);
        sum(&RATIOS[2 * which]) / sum(&RATIOS[2 * which + 1])
    };
    let beside = share - 0.5;
    if beside.abs() <= 0.425 {
        return beside * ratio(0, 0.180_625 - beside * beside);
    }
    let tail = share.min(1.0 - share);
    let t = (-libm::log(tail)).sqrt();
    let size = if t <= 5.0 { ratio(1, t - 1.6) } else { ratio(2, t - 5.0) };
    size.copysign(beside)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Distribution; 5] = [
        Distribution::Uniform { from: -1.0, to: 3.0 },
        Distribution::Normal { mean: 2.0, deviation: 0.5 },
        Distribution::Lognormal { median: 2.0, deviation: 0.1 },
        Distribution::Triangular { from: 1.0, peak: 1.5, to: 4.0 },
        Distribution::Triangular { from: 1.0, peak: 4.0, to: 4.0 },
    ];

    /// Tabulated percentage points, and the distribution function back.
    #[test]
    fn the_normal_distribution_is_the_tabulated_one() {
        for (share, value) in [
            (1e-300, -37.047_096_299_361_2),
            (1e-20, -9.262_340_089_798_409),
            (0.001, -3.090_232_306_167_813),
            (0.02, -2.053_748_910_631_823),
            (0.1, -1.281_551_565_544_600_4),
            (0.3, -0.524_400_512_708_040_9),
            (0.5, 0.0),
            (0.9, 1.281_551_565_544_600_4),
            (0.999, 3.090_232_306_167_813),
        ] {
            let found = standard_normal(share);
            assert!((found - value).abs() <= 4e-15 * value.abs().max(1.0), "{share} {found}");
            assert!((share_below(found) / share - 1.0).abs() < 1e-12, "{share}");
        }
    }

    /// Means and variances in closed form, by the midpoint rule over shares.
    #[test]
    fn means_and_deviations_are_those_of_the_closed_forms() {
        let count = 200_000;
        for distribution in ALL {
            distribution.check().unwrap();
            let values =
                || (0..count).map(|k| distribution.quantile((k as f64 + 0.5) / count as f64));
            let mean = values().sum::<f64>() / f64::from(count);
            let variance = values().map(|v| (v - mean).powi(2)).sum::<f64>() / f64::from(count);
            let [known, its] = match distribution {
                Distribution::Uniform { from, to } => {
                    [0.5 * (from + to), (to - from).powi(2) / 12.0]
                }
                Distribution::Normal { mean, deviation } => [mean, deviation * deviation],
                Distribution::Lognormal { median, deviation: s } => {
                    let square = (s * s).exp();
                    [median * square.sqrt(), median * median * square * (square - 1.0)]
                }
                Distribution::Triangular { from: a, peak: b, to: c } => {
                    let squares = a * a + b * b + c * c - a * b - a * c - b * c;
                    [(a + b + c) / 3.0, squares / 18.0]
                }
            };
            assert!((mean / known - 1.0).abs() < 1e-4, "{distribution:?} {mean} {known}");
            assert!((variance / its - 1.0).abs() < 1e-3, "{distribution:?} {variance} {its}");
            assert!(values().is_sorted(), "{distribution:?}");
        }
    }

    #[test]
    fn what_is_no_distribution_is_refused() {
        for wrong in [
            Distribution::Uniform { from: 1.0, to: 1.0 },
            Distribution::Uniform { from: 0.0, to: f64::INFINITY },
            Distribution::Normal { mean: 0.0, deviation: -1.0 },
            Distribution::Lognormal { median: 0.0, deviation: 0.1 },
            Distribution::Triangular { from: 0.0, peak: 2.0, to: 1.0 },
            Distribution::Triangular { from: 0.0, peak: f64::NAN, to: 1.0 },
        ] {
            assert!(wrong.check().is_err(), "{wrong:?}");
        }
    }
}
