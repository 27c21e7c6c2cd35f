//! Which values does row k of a study have?
//!
//! [`Design::row`] computes them from the study and k alone. Lists are combined in every way, the last one fastest.
//! Every combination has the same points, so two combinations differ only in the values of the lists. Random numbers
//! are correlated through their normal scores, which leaves every number its own distribution (a Gaussian copula).
//!
//! # Source
//!
//! M. D. McKay, R. J. Beckman, W. J. Conover, Technometrics 21 (1979) 239: Latin hypercubes. R. B. Nelsen, An
//! Introduction to Copulas (Springer, 2006), 2.3: the copula.

use crate::engine::{Error, Result};
use crate::many::distribution::{Distribution, share_below, standard_normal};
use crate::many::hash::{of, shuffled};
use crate::many::indices::VariateKind;
use crate::many::sobol::{MOST_COORDINATES, Sobol, between};
use crate::named::named;

named! {
    /// How points are spread.
    #[derive(Default, serde::Deserialize)]
    #[non_exhaustive]
    pub enum PointSpread {
        /// By Sobol's sequence, scrambled.
        #[default]
        Sobol = "sobol",
        /// One point in each of equal parts of every distribution.
        LatinHypercube = "latin-hypercube",
        /// Thrown.
        Random = "random",
    }
}

/// Most rows of a study.
pub const MOST_ROWS: u64 = 1_000_000_000;

/// The rows of a study.
#[derive(Debug, Clone)]
pub struct Design {
    lists: Vec<u64>,
    drawn: Vec<Distribution>,
    /// Lower triangle of Cholesky's factor of the correlations.
    factor: Vec<Vec<f64>>,
    points: u64,
    spread: PointSpread,
    seed: u64,
    sobol: Sobol,
}

/// The description of a design.
#[derive(Debug, Clone, Default)]
pub struct DesignTerms {
    /// How many values each list has.
    pub lists: Vec<u64>,
    /// The distributions that are drawn from.
    pub drawn: Vec<Distribution>,
    /// Correlations of normal scores, each of two different distributions by their places in `drawn`.
    pub correlations: Vec<(usize, usize, f64)>,
    /// Points for each combination of the lists; one if nothing is random.
    pub points: u64,
    /// How they are spread.
    pub spread: PointSpread,
    /// Seed of the random numbers.
    pub seed: u64,
}

/// One row.
#[derive(Debug, Clone, PartialEq)]
pub struct DesignRow {
    /// Which value of each list.
    pub picks: Vec<u64>,
    /// The value of each distribution.
    pub values: Vec<f64>,
}

/// Position of an input in a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axis {
    /// In the list of that number.
    List(usize),
    /// In the distribution of that number.
    Drawn(usize),
}

/// Some of the `count` numbers 0 … `count` − 1, evenly spaced, 0 first.
fn spread_evenly(count: u64, some: u64) -> impl Iterator<Item = u64> {
    let some = count.min(some);
    (0..some).map(move |k| (u128::from(k) * u128::from(count) / u128::from(some)) as u64)
}

impl Design {
    /// # Errors
    ///
    /// [`Error::Value`] for an empty list, no points, more rows than [`MOST_ROWS`], more distributions than Sobol's
    /// sequence has coordinates, and impossible correlations.
    pub fn new(wanted: DesignTerms) -> Result<Self> {
        let DesignTerms { lists, drawn, correlations, points, spread, seed } = wanted;
        drawn.iter().try_for_each(Distribution::check)?;
        // Without random numbers every combination is one row.
        let points = if drawn.is_empty() { points.min(1) } else { points };
        let rows = lists.iter().try_fold(points, |rows, list| rows.checked_mul(*list));
        match rows {
            Some(1..=MOST_ROWS) => {}
            Some(0) => return Err(Error::value("points", 0, "one row at least")),
            _ => {
                let found =
                    rows.map_or("more than 1.8e19 rows".to_owned(), |n| format!("{n} rows"));
                return Err(Error::value("points", found, format!("{MOST_ROWS} rows at most")));
            }
        }
        if spread == PointSpread::Sobol && drawn.len() > MOST_COORDINATES {
            let expected = format!("{MOST_COORDINATES} at most with the design sobol");
            return Err(Error::value("vary", format!("{} distributions", drawn.len()), expected));
        }
        let factor = cholesky(drawn.len(), &correlations)?;
        let sobol = Sobol::new(if spread == PointSpread::Sobol { drawn.len() } else { 0 }, seed);
        Ok(Self { lists, drawn, factor, points, spread, seed, sobol })
    }

    /// Number of rows.
    pub fn rows(&self) -> u64 {
        self.combinations() * self.points
    }

    /// Row k, counted from 0.
    pub fn row(&self, k: u64) -> DesignRow {
        let (mut combination, point) = (k / self.points, k % self.points);
        let mut picks = vec![0; self.lists.len()];
        for (pick, list) in picks.iter_mut().zip(&self.lists).rev() {
            (combination, *pick) = (combination / list, combination % list);
        }
        let shares = (0..self.drawn.len()).map(|c| self.share(point, c));
        let scores: Vec<f64> = shares.map(standard_normal).collect();
        let value = |(c, distribution): (usize, &Distribution)| {
            let row = &self.factor[c];
            // An independent number keeps its share to the last bit.
            if row[..c].iter().all(|part| *part == 0.0) {
                return distribution.quantile(self.share(point, c));
            }
            let score = row.iter().zip(&scores).map(|(part, score)| part * score).sum();
            distribution.quantile(share_below(score).clamp(f64::MIN_POSITIVE, 1.0 - f64::EPSILON))
        };
        DesignRow { picks, values: self.drawn.iter().enumerate().map(value).collect() }
    }

    /// Representative rows: combinations of the lists with the median of every distribution, the first of every list
    /// before all others, and rows of the design; at most `some` of both, evenly spaced.
    pub fn examples(&self, some: u64) -> impl Iterator<Item = DesignRow> {
        let DesignRow { values, .. } = self.middle();
        let combined = spread_evenly(self.combinations(), some);
        let picks = |k: u64| self.row(k * self.points).picks;
        let combined = combined.map(move |k| DesignRow { picks: picks(k), values: values.clone() });
        combined.chain(spread_evenly(self.rows(), some).map(|k| self.row(k)))
    }

    /// The first value of every list with the median of every distribution.
    pub fn middle(&self) -> DesignRow {
        let values = self.drawn.iter().map(|drawn| drawn.quantile(0.5)).collect();
        DesignRow { picks: vec![0; self.lists.len()], values }
    }

    /// Rows that differ from this one along one axis only: by `some` other values of a list, or by both quartiles of a
    /// distribution.
    pub fn beside(&self, row: &DesignRow, axis: Axis, some: u64) -> Vec<DesignRow> {
        let other = |change: &dyn Fn(&mut DesignRow)| {
            let mut other = row.clone();
            change(&mut other);
            other
        };
        match axis {
            Axis::List(k) => {
                let others =
                    spread_evenly(self.lists[k], some).filter(|pick| *pick != row.picks[k]);
                others.map(|pick| other(&|row| row.picks[k] = pick)).collect()
            }
            Axis::Drawn(k) => {
                let quartiles = [0.25, 0.75].map(|share| self.drawn[k].quantile(share));
                quartiles.map(|value| other(&|row| row.values[k] = value)).to_vec()
            }
        }
    }

    /// The kinds of the independent numbers behind the random values.
    pub fn kinds(&self) -> Vec<VariateKind> {
        let kind = |distribution: &Distribution| match distribution {
            Distribution::Normal { .. } | Distribution::Lognormal { .. } => VariateKind::Score,
            Distribution::Uniform { .. } | Distribution::Triangular { .. } => VariateKind::Share,
        };
        self.drawn.iter().map(kind).collect()
    }

    /// The independent numbers of row k; of correlated values each has the part that the earlier ones leave open.
    pub fn numbers(&self, k: u64) -> Vec<f64> {
        let number = |(c, kind): (usize, VariateKind)| match kind {
            VariateKind::Share => self.share(k % self.points, c),
            VariateKind::Score => standard_normal(self.share(k % self.points, c)),
        };
        self.kinds().into_iter().enumerate().map(number).collect()
    }

    /// Number of combinations of the lists.
    pub fn combinations(&self) -> u64 {
        self.lists.iter().product()
    }

    /// A coordinate of a point in the unit cube.
    fn share(&self, point: u64, coordinate: usize) -> f64 {
        let thrown = || between(of(self.seed, coordinate as u64, point));
        match self.spread {
            PointSpread::Sobol => self.sobol.at(point, coordinate),
            PointSpread::Random => thrown(),
            PointSpread::LatinHypercube => {
                let own = of(self.seed, coordinate as u64, u64::MAX);
                let part = shuffled(own, self.points, point) as f64;
                // Rounding may not carry it out of the cube.
                ((part + thrown()) / self.points as f64).min(1.0 - f64::EPSILON)
            }
        }
    }
}

/// Cholesky's factor of a matrix of correlations, 0 by default.
fn cholesky(count: usize, correlations: &[(usize, usize, f64)]) -> Result<Vec<Vec<f64>>> {
    let mut matrix = vec![vec![0.0; count]; count];
    for &(a, b, r) in correlations {
        if r.is_nan() || r.abs() >= 1.0 {
            return Err(Error::value("correlation", r, "a number between -1 and 1"));
        }
        (matrix[a][b], matrix[b][a]) = (r, r);
    }
    let mut factor = vec![vec![0.0; count]; count];
    for i in 0..count {
        for j in 0..i {
            let taken: f64 = (0..j).map(|k| factor[i][k] * factor[j][k]).sum();
            factor[i][j] = (matrix[i][j] - taken) / factor[j][j];
        }
        let left = 1.0 - factor[i][..i].iter().map(|part| part * part).sum::<f64>();
        if left <= 1e-12 {
            let found = "correlations that contradict each other";
            let expected =
                "a positive definite matrix: if a goes with b and b with c, a goes with c";
            return Err(Error::value("correlation", found, expected));
        }
        factor[i][i] = left.sqrt();
    }
    Ok(factor)
}

#[cfg(test)]
mod tests {
    use super::*;

    const NORMAL: Distribution = Distribution::Normal { mean: 0.0, deviation: 1.0 };

    fn design(spread: PointSpread, correlations: &[(usize, usize, f64)], points: u64) -> Design {
        let drawn = vec![NORMAL, Distribution::Uniform { from: 0.0, to: 1.0 }, NORMAL];
        let correlations = correlations.to_vec();
        let wanted =
            DesignTerms { lists: vec![2, 3], drawn, correlations, points, spread, seed: 5 };
        Design::new(wanted).unwrap()
    }

    #[test]
    fn lists_are_combined_and_each_combination_has_the_same_points() {
        for spread in [PointSpread::Sobol, PointSpread::LatinHypercube, PointSpread::Random] {
            let design = design(spread, &[], 7);
            assert_eq!(design.rows(), 42);
            let picks: Vec<_> = (0..42).step_by(7).map(|k| design.row(k).picks).collect();
            assert_eq!(picks, [[0, 0], [0, 1], [0, 2], [1, 0], [1, 1], [1, 2]]);
            for k in 7..42 {
                assert_eq!(design.row(k).values, design.row(k % 7).values);
            }
        }
    }

    #[test]
    fn a_latin_hypercube_takes_every_part_of_every_distribution_once() {
        let design = design(PointSpread::LatinHypercube, &[], 100);
        let mut parts: Vec<_> =
            (0..100).map(|k| (100.0 * design.row(k).values[1]) as usize).collect();
        parts.sort_unstable();
        assert_eq!(parts, (0..100).collect::<Vec<_>>());
    }

    /// Correlated scores have the correlation asked for, and a number keeps its distribution: the values of a uniform
    /// and a normal number have the correlation `√(3/π) r`.
    #[test]
    fn numbers_go_with_each_other_as_asked_and_stay_what_they_are() {
        let count = 1 << 14;
        let design = design(PointSpread::Sobol, &[(0, 2, 0.6), (0, 1, -0.5)], count);
        let rows: Vec<Vec<f64>> = (0..count).map(|k| design.row(k).values).collect();
        let mean =
            |of: &dyn Fn(&[f64]) -> f64| rows.iter().map(|row| of(row)).sum::<f64>() / count as f64;
        let correlation = |a: usize, b: usize| {
            let [of_a, of_b] = [mean(&|row| row[a]), mean(&|row| row[b])];
            let both = mean(&|row| (row[a] - of_a) * (row[b] - of_b));
            let own = |c: usize, its: f64| mean(&|row| (row[c] - its).powi(2)).sqrt();
            both / own(a, of_a) / own(b, of_b)
        };
        assert!((correlation(0, 2) - 0.6).abs() < 2e-3, "{}", correlation(0, 2));
        let known = -0.5 * (3.0 / std::f64::consts::PI).sqrt();
        assert!((correlation(0, 1) - known).abs() < 2e-3, "{}", correlation(0, 1));
        let mut uniform: Vec<f64> = rows.iter().map(|row| row[1]).collect();
        uniform.sort_by(f64::total_cmp);
        let off = |(k, v): (usize, &f64)| (v - (k as f64 + 0.5) / count as f64).abs();
        // For the same number of random points the largest deviation is about 7e-3 (Kolmogorov).
        let worst = uniform.iter().enumerate().map(off).fold(0.0, f64::max);
        assert!(worst < 3e-3, "{worst}");
    }

    #[test]
    fn what_cannot_be_is_refused() {
        let wanted = |correlations: &[(usize, usize, f64)], lists: &[u64], points| {
            let (correlations, lists) = (correlations.to_vec(), lists.to_vec());
            DesignTerms {
                lists,
                drawn: vec![NORMAL; 3],
                correlations,
                points,
                ..DesignTerms::default()
            }
        };
        for (wrong, says) in [
            (wanted(&[(0, 1, 1.0)], &[], 8), "between -1 and 1"),
            (wanted(&[(0, 1, f64::NAN)], &[], 8), "between -1 and 1"),
            (wanted(&[(0, 1, 0.9), (1, 2, 0.9), (0, 2, -0.9)], &[], 8), "contradict each other"),
            (wanted(&[], &[0], 8), "one row at least"),
            (wanted(&[], &[1_000_000, 1_000_000], 8), "rows at most"),
            (wanted(&[], &[u64::MAX, 2], 8), "rows at most"),
            (DesignTerms { drawn: vec![NORMAL; 65], ..wanted(&[], &[], 8) }, "64 at most"),
        ] {
            let said = Design::new(wrong).unwrap_err().to_string();
            assert!(said.contains(says), "{said}");
        }
        assert_eq!(
            Design::new(DesignTerms { points: 3, ..DesignTerms::default() }).unwrap().rows(),
            1
        );
    }
}
