//! Percentiles with errors, and the causes of the variation.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::engine::Result;
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
    /// Half of its 95 % interval, from the differences between the scrambles or from ranks; null if there are too few
    /// rows.
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
fn lacking(found: &BatAnswers, output: &Output) -> String {
    found.off.as_ref().map_or(format!("the bat has no {}", output.name()), ToString::to_string)
}

/// Why each row has no answer; empty if it has one. An output that no bat has, as the node of a mode without nodes, does
/// not count.
fn missing(
    rows: &ScatterRows,
    found: &[Result<BatAnswers>],
    values: &[Vec<Option<f64>>],
) -> Vec<String> {
    let held: Vec<bool> = values.iter().map(|column| column.iter().any(Option::is_some)).collect();
    let lacks = |row: usize| {
        let lacked = (0..values.len()).find(|k| held[*k] && values[*k][row].is_none());
        lacked.or_else(|| (!held.contains(&true)).then_some(0))
    };
    let why = |(row, found): (usize, &Result<BatAnswers>)| match (found, lacks(row)) {
        (Err(error), _) => error.to_string(),
        (Ok(found), Some(k)) => lacking(found, &rows.plan.outputs[k]),
        (Ok(_), None) => String::new(),
    };
    found.iter().enumerate().map(why).collect()
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
        let count = rows.count();
        let found = in_groups(0..count, |some| rows.answers(some), tell);
        let column = |k: usize| -> Vec<Option<f64>> {
            found.iter().map(|row| value(&row.as_ref().ok()?.figures[k])).collect()
        };
        let values: Vec<Vec<Option<f64>>> = (0..rows.plan.outputs.len()).map(column).collect();
        let missing = missing(rows, &found, &values);
        let good = |(found, why): (&Result<BatAnswers>, &String)| {
            why.is_empty() && found.as_ref().is_ok_and(|found| found.met)
        };
        let met = found.iter().zip(&missing).filter(|row| good(*row)).count();
        // A row without one of its answers is dropped whole.
        let whole: Vec<usize> = (0..missing.len()).filter(|row| missing[*row].is_empty()).collect();
        let numbers: Vec<Vec<f64>> = whole.iter().map(|row| rows.numbers(*row as u64)).collect();
        let outputs = rows.plan.outputs.iter().zip(values).map(|(output, values)| {
            let fitted: Vec<(Vec<f64>, f64)> = whole
                .iter()
                .zip(&numbers)
                .filter_map(|(row, numbers)| Some((numbers.clone(), values[*row]?)))
                .collect();
            let (mean, sd) = moments(values.iter().flatten().copied()).unzip();
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

/// The percentiles: the mean of those of eight scrambles, with its Student interval. If a scramble has too few rows for
/// a percentile, the value is that of all rows together; if it has too few for an interval, the interval is that of
/// ranks for independent rows, `p n ± 1.96 √(p (1 − p) n)`, and there is none beyond the rows.
fn percentiles(values: &[Option<f64>]) -> Vec<Percentile> {
    /// Rows of a scramble beyond a percentile that make its value as good as the mean, and its error normal.
    const ENOUGH: [f64; 2] = [0.5, 4.0];
    let all = sorted(values);
    let each: Vec<Vec<f64>> =
        values.chunks(values.len() / SCRAMBLES as usize).map(sorted).collect();
    let fewest = each.iter().map(Vec::len).min().unwrap_or(0) as f64;
    let of = |share: f64| {
        let together = percentile(&all, share)?;
        let percent = (1e4 * share).round() / 100.0;
        let tail = fewest * share.min(1.0 - share);
        let own: Option<Vec<f64>> = each.iter().map(|one| percentile(one, share)).collect();
        let own = own.filter(|_| tail >= ENOUGH[0]).unwrap_or_default();
        let (mean, sd) = moments(own.iter().copied()).unwrap_or((together, 0.0));
        let error = match tail >= ENOUGH[1] {
            true => Some(STUDENT * sd / (own.len() as f64).sqrt()),
            false => by_ranks(&all, share).map(|ends| {
                ends.into_iter().fold(0.0, |most: f64, end| most.max((end - mean).abs()))
            }),
        };
        Some(Percentile { percent, value: mean, error })
    };
    SHARES.iter().filter_map(|share| of(*share)).collect()
}

/// The 95 % interval of a percentile of independent values by their ranks; `None` if it ends beyond them.
fn by_ranks(sorted: &[f64], share: f64) -> Option<[f64; 2]> {
    let count = sorted.len() as f64;
    let off = 1.96 * (share * (1.0 - share) / count).sqrt();
    let ends = [share - off, share + off];
    let within = ends[0] * count >= 0.5 && ends[1] * count <= count - 0.5;
    within.then_some([percentile(sorted, ends[0])?, percentile(sorted, ends[1])?])
}

/// Mean and standard deviation.
fn moments(values: impl IntoIterator<Item = f64>) -> Option<(f64, f64)> {
    let known: Vec<f64> = values.into_iter().collect();
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
    /// show: many rows and few, the middle and the ends.
    #[test]
    fn ninety_five_of_a_hundred_intervals_hold_the_percentile() {
        let one = |what| Difference { what, deviation: 1.0 };
        let all = vec![one(Differs::Density), one(Differs::Pitch)];
        let differences = Differences { all, correlations: vec![] };
        for (count, seeds) in [(1024, 250), (256, 250), (64, 500)] {
            // For each percentile: intervals that hold it, and all.
            let mut held = SHARES.map(|_| [0; 2]);
            for seed in 0..seeds {
                let designs = differences.designs(1.0, count, seed).unwrap();
                let each = count / SCRAMBLES;
                let rows: Vec<Vec<f64>> = designs
                    .iter()
                    .flat_map(|design| (0..each).map(|k| design.row(k).values))
                    .collect();
                let values = [
                    rows.iter().map(|row| Some(row[0])).collect::<Vec<_>>(),
                    rows.iter().map(|row| Some(0.8 * row[0] + 0.6 * row[1])).collect(),
                ];
                for (k, one) in
                    values.iter().flat_map(|values| percentiles(values).into_iter().enumerate())
                {
                    let Some(error) = one.error else { continue };
                    let off = one.value - standard_normal(0.01 * one.percent);
                    held[k][0] += usize::from(off.abs() <= error);
                    held[k][1] += 1;
                }
            }
            for (share, [held, all]) in SHARES.iter().zip(held) {
                assert!(held as f64 >= 0.92 * all as f64, "{count} {share}: {held} of {all}");
            }
            assert!(held[3][1] > 0, "the middle has an interval");
        }
    }
}
