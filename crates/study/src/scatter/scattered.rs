//! Percentiles with errors, and the causes of the variation.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::many::indices::Indices;
use crate::many::rows::{BatAnswers, in_groups};
use crate::scatter::rows::{Output, ScatterRows, value};
use crate::scatter::spreads::SCRAMBLES;

/// The reported percentiles, as shares.
pub const SHARES: [f64; 7] = [0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99];
/// The percentiles whose bats are written, as indices of [`SHARES`].
pub const WRITTEN: [usize; 3] = [1, 3, 5];
/// Values whose standard deviation is at most this share of their mean are equal up to round-off.
const ROUND_OFF: f64 = 1e-9;
/// 95 % of Student's distribution with seven degrees of freedom lie within this many standard deviations.
const STUDENT: f64 = 2.364_624_251;

/// A percentile.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Percentile {
    /// Which, in per cent.
    pub percent: f64,
    /// Its value.
    pub value: f64,
    /// Half of its 95 % interval, from the differences between the scrambles.
    // None if one of them has no answer.
    pub error: Option<f64>,
}

/// An output.
#[derive(Debug, Clone, Serialize, schemars::JsonSchema)]
pub struct OutputSpread {
    /// Its name.
    pub name: String,
    /// Its unit.
    pub unit: &'static str,
    /// The mean of all rows.
    // `None` with fewer than two answers, as is the standard deviation.
    pub mean: Option<f64>,
    /// The standard deviation of all rows.
    pub sd: Option<f64>,
    /// The percentiles.
    // Those of [`SHARES`]; empty without an answer.
    pub percentiles: Vec<Percentile>,
    /// The causes of its variation; null if it does not vary or the rows are too few.
    #[serde(rename = "shares")]
    pub indices: Option<Indices>,
    /// The values of all rows; `None` for a row without one.
    #[serde(skip)]
    pub values: Vec<Option<f64>>,
}

/// Why rows have no answer.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct ReasonCounted {
    /// Why.
    pub reason: String,
    /// How many rows.
    pub rows: usize,
}

/// One thing that differs between the rows.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct InputSpread {
    /// Its name.
    pub name: &'static str,
    /// Its standard deviation: of a logarithm, of a factor, or of an amount (m for turning and impact).
    pub sd: f64,
    /// The earlier ones with which it is correlated: it counts with them known.
    pub given: Vec<&'static str>,
}

/// The results of all rows: the members of a scatter's document about them.
#[derive(Debug, Clone, Serialize, schemars::JsonSchema)]
pub struct Scattered {
    /// Rows that were drawn.
    pub points: u64,
    /// Which rows.
    pub seed: u64,
    /// Scrambles of Sobol's sequence that share them.
    pub scrambles: u64,
    /// Rows with all their answers.
    pub answered: usize,
    /// Number of rows as accurate as asked.
    pub met: usize,
    /// The reasons why others have no answer, with their counts.
    // The commonest first.
    pub reasons: Vec<ReasonCounted>,
    /// Mean impact point (m); null if no output depends on it.
    pub impact_m: Option<f64>,
    /// The differences.
    pub inputs: Vec<InputSpread>,
    /// The outputs, their variation, and its causes.
    pub outputs: Vec<OutputSpread>,
    /// Why a row has no answer, row by row; empty if it has one.
    #[serde(skip)]
    pub missing: Vec<String>,
}

/// Why a row lacks an answer.
fn lacking(found: &BatAnswers) -> String {
    found.off.as_ref().map_or("the bat has no such answer".to_owned(), ToString::to_string)
}

impl Scattered {
    /// Computes all rows, on all threads; `tell` receives the number of finished rows.
    ///
    /// ```
    /// use sweetspot::Bat;
    /// use sweetspot::collision::setup::Setup;
    /// use sweetspot_study::answers::Answer;
    /// use sweetspot_study::scatter::rows::{Output, ScatterPlan, ScatterRows};
    /// use sweetspot_study::scatter::scattered::Scattered;
    /// use sweetspot_study::scatter::spreads::{Difference, Differences, Differs};
    ///
    /// # fn main() -> sweetspot::Result<()> {
    /// # let text = r#"{ "format": "sweetspot-bat/1", "material": "white-ash-dynamic",
    /// #     "profile": { "unit": "in", "x": [0, 6, 20, 27, 33], "diameter": [1.0, 0.9, 1.6, 2.4, 2.5] } }"#;
    /// # let bat = Bat::from_text("bat.json", text, "".as_ref())?;
    /// let all = vec![Difference { what: Differs::Density, deviation: 0.04 }];
    /// let plan = ScatterPlan {
    ///     differences: Differences { all, correlations: vec![] },
    ///     setup: Setup::default(),
    ///     impact: None,
    ///     outputs: vec![Output::Of(Answer::Mass)],
    ///     tolerance: 1e-4,
    ///     points: 64,
    ///     seed: 1,
    /// };
    /// let found = Scattered::new(&ScatterRows::new(&bat, plan)?, &|_| ());
    /// let mass = &found.outputs[0];
    /// let spread = (mass.percentiles[5].value / mass.percentiles[1].value).ln();
    /// assert!((spread - 2.0 * 1.645 * 0.04).abs() < 0.02);
    /// # Ok(())
    /// # }
    /// ```
    pub fn new(rows: &ScatterRows, tell: &(impl Fn(u64) + Sync)) -> Self {
        let (count, asked) = (rows.count(), rows.plan.outputs.len());
        let mut values: Vec<Vec<Option<f64>>> = vec![vec![]; asked];
        let (mut missing, mut met) = (vec![], 0);
        for found in in_groups(0..count, |some| rows.answers(some), tell) {
            let (all, why, good) = match found {
                Ok(found) => {
                    let all: Vec<_> = found.figures.iter().map(value).collect();
                    let whole = all.iter().all(Option::is_some);
                    let why = if whole { String::new() } else { lacking(&found) };
                    (all, why, found.met && whole)
                }
                Err(error) => (vec![None; asked], error.to_string(), false),
            };
            values.iter_mut().zip(all).for_each(|(column, value)| column.push(value));
            missing.push(why);
            met += usize::from(good);
        }
        let whole = |row: usize| values.iter().all(|column| column[row].is_some());
        // A row without one of its answers is dropped whole.
        let whole: Vec<usize> = (0..count as usize).filter(|row| whole(*row)).collect();
        let numbers: Vec<Vec<f64>> = whole.iter().map(|row| rows.numbers(*row as u64)).collect();
        let outputs = rows.plan.outputs.iter().zip(values).map(|(output, values)| {
            let fitted: Vec<(Vec<f64>, f64)> = whole
                .iter()
                .zip(&numbers)
                .filter_map(|(row, numbers)| Some((numbers.clone(), values[*row]?)))
                .collect();
            let (mean, sd) = moments(&values).unzip();
            let differ = mean.zip(sd).is_some_and(|(mean, sd)| sd > ROUND_OFF * f64::abs(mean));
            let indices = differ.then(|| Indices::grouped(&rows.kinds(), &rows.groups, &fitted));
            OutputSpread {
                name: output.name(),
                unit: output.unit(),
                mean,
                sd,
                percentiles: percentiles(&values),
                indices: indices.flatten(),
                values,
            }
        });
        let differences = &rows.plan.differences;
        let input = |k: usize| InputSpread {
            name: differences.all[k].what.name(),
            sd: differences.all[k].deviation,
            given: differences.given(k),
        };
        Self {
            points: count,
            seed: rows.plan.seed,
            scrambles: SCRAMBLES,
            answered: missing.iter().filter(|why| why.is_empty()).count(),
            met,
            reasons: counted(&missing),
            impact_m: rows.plan.outputs.contains(&Output::AtImpact).then_some(rows.impact),
            inputs: (0..differences.all.len()).map(input).collect(),
            outputs: outputs.collect(),
            missing,
        }
    }

    /// The row whose output k is nearest to its percentile with that index in [`SHARES`].
    pub fn nearest(&self, output: usize, percentile: usize) -> Option<usize> {
        let output = &self.outputs[output];
        let wanted = output.percentiles.get(percentile)?.value;
        let off = |row: &usize| output.values[*row].map_or(f64::INFINITY, |v| (v - wanted).abs());
        let rows = (0..output.values.len()).filter(|row| output.values[*row].is_some());
        rows.min_by(|a, b| off(a).total_cmp(&off(b)))
    }
}

/// The count of each reason, the commonest first.
fn counted(missing: &[String]) -> Vec<ReasonCounted> {
    let mut all: BTreeMap<&String, usize> = BTreeMap::new();
    missing.iter().filter(|why| !why.is_empty()).for_each(|why| *all.entry(why).or_default() += 1);
    let counted = |(why, rows): (&String, usize)| ReasonCounted { reason: why.clone(), rows };
    let mut all: Vec<ReasonCounted> = all.into_iter().map(counted).collect();
    all.sort_by_key(|counted| std::cmp::Reverse(counted.rows));
    all
}

/// The percentiles, each with the error from eight scrambles: their mean, and its Student interval. If a scramble has
/// too few rows for a percentile, the value is that of all rows together.
fn percentiles(values: &[Option<f64>]) -> Vec<Percentile> {
    let all = sorted(values);
    let each: Vec<Vec<f64>> =
        values.chunks(values.len() / SCRAMBLES as usize).map(sorted).collect();
    let fewest = each.iter().map(Vec::len).min().unwrap_or(0) as f64;
    let of = |share: f64| {
        let together = percentile(&all, share)?;
        let percent = (1e4 * share).round() / 100.0;
        let own: Option<Vec<f64>> = each.iter().map(|one| percentile(one, share)).collect();
        let Some(own) = own else {
            return Some(Percentile { percent, value: together, error: None });
        };
        let count = own.len() as f64;
        let mean = own.iter().sum::<f64>() / count;
        let squares = own.iter().map(|v| (v - mean).powi(2)).sum::<f64>();
        let error = Some(STUDENT * (squares / (count - 1.0) / count).sqrt());
        let enough = fewest * share.min(1.0 - share) >= 0.5;
        Some(Percentile { percent, value: if enough { mean } else { together }, error })
    };
    SHARES.iter().filter_map(|share| of(*share)).collect()
}

/// Mean and standard deviation.
fn moments(values: &[Option<f64>]) -> Option<(f64, f64)> {
    let known: Vec<f64> = values.iter().flatten().copied().collect();
    let count = known.len() as f64;
    let mean = known.iter().sum::<f64>() / count;
    let squares = known.iter().map(|value| (value - mean).powi(2)).sum::<f64>();
    (known.len() > 1).then(|| (mean, (squares / (count - 1.0)).sqrt()))
}

fn sorted(values: &[Option<f64>]) -> Vec<f64> {
    let mut known: Vec<f64> = values.iter().flatten().copied().collect();
    known.sort_by(f64::total_cmp);
    known
}

/// The value below which a share of the sorted ones lies: the k-th of n stands for the share (k − ½)/n, linear between
/// neighbours. `None` for an empty list.
pub fn percentile(sorted: &[f64], share: f64) -> Option<f64> {
    let last = sorted.len().checked_sub(1)?;
    let place = (share * sorted.len() as f64 - 0.5).clamp(0.0, last as f64);
    let below = place.floor() as usize;
    let above = (below + 1).min(last);
    Some(sorted[below] + (place - below as f64) * (sorted[above] - sorted[below]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::many::distribution::standard_normal;
    use crate::scatter::spreads::{Difference, Differences, Differs};

    /// For a normal number and a sum of two, 95 of 100 intervals contain the percentile, as far as 1500 intervals can
    /// show.
    #[test]
    fn ninety_five_of_a_hundred_intervals_hold_the_percentile() {
        let one = |what| Difference { what, deviation: 1.0 };
        let all = vec![one(Differs::Density), one(Differs::Pitch)];
        let differences = Differences { all, correlations: vec![] };
        let (mut within, mut of) = ([0, 0], 0);
        for seed in 0..250 {
            let designs = differences.designs(1.0, 1024, seed).unwrap();
            let rows: Vec<Vec<f64>> =
                designs.iter().flat_map(|design| (0..128).map(|k| design.row(k).values)).collect();
            let values = [
                rows.iter().map(|row| Some(row[0])).collect::<Vec<_>>(),
                rows.iter().map(|row| Some(0.8 * row[0] + 0.6 * row[1])).collect(),
            ];
            for (within, values) in within.iter_mut().zip(&values) {
                for one in
                    percentiles(values).iter().filter(|one| (4.0..96.0).contains(&one.percent))
                {
                    let off = one.value - standard_normal(0.01 * one.percent);
                    *within += usize::from(off.abs() <= one.error.unwrap());
                }
            }
            of += 5;
        }
        let shares = within.map(|within| f64::from(within as u32) / f64::from(of));

        assert!(shares.iter().all(|share| *share > 0.93), "{shares:?}");
    }
}
