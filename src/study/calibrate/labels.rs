//! Which line is which mode?
//!
//! Lines rise with the modes. Every rising labelling is tried in which a line is within 30 % of the mode that it is
//! taken for; a line may be none of a bending mode (torsion, a hoop of a hollow barrel, the second of two planes of
//! the grain), which costs 12 of χ². Where there are many the labellings are first put in order by a straight line
//! through the start, and the best are fitted.

use crate::base::error::Result;
use crate::base::threads;
use crate::study::calibrate::fit::{Fit, Search, data};
use crate::study::calibrate::wood::Shown;

/// What a line that is none of ours costs.
pub const STRANGER: f64 = 12.0;
/// How far from a computed mode a line may be, relative.
const FARTHEST: f64 = 0.3;
/// Labellings that are looked at, and that are fitted.
const MOST_LOOKED_AT: usize = 20_000;
const MOST_FITTED: usize = 24;
/// The highest mode that a line may be.
pub const MOST_MODES: usize = 20;

/// Which mode each line is; None for a line of none of them.
pub type Labels = Vec<Option<usize>>;

/// A labelling, and what it comes to.
#[derive(Debug, Clone, PartialEq)]
pub struct Labelled {
    /// The labels.
    pub labels: Labels,
    /// The fit.
    pub fit: Fit,
    /// χ² and what lines of no mode cost.
    pub chi2: f64,
}

impl Labelled {
    /// The fit to these labels.
    ///
    /// # Errors
    ///
    /// As [`Search::fit`].
    pub fn new(search: &Search, labels: Labels, modes: usize) -> Result<Self> {
        let fit = search.fit(&data(search.readings, &labels), modes)?;
        let strangers = labels.iter().filter(|label| label.is_none()).count();
        let chi2 = fit.chi2 + STRANGER * strangers as f64;
        Ok(Self { labels, fit, chi2 })
    }
}

/// The labellings that fit best, the best first; `told` are labels that stay.
///
/// # Errors
///
/// As [`Search::fit`].
pub fn best(search: &Search, told: &Labels, start: &Shown) -> Result<Vec<Labelled>> {
    let modes = start.frequencies.len();
    let mut all = rising(search, told, start);
    let guess = |labels: &Labels| {
        let strangers = labels.iter().filter(|label| label.is_none()).count();
        search.guess(&data(search.readings, labels), start) + STRANGER * strangers as f64
    };
    let mut ordered: Vec<(f64, Labels)> =
        all.drain(..).map(|labels| (guess(&labels), labels)).collect();
    ordered.sort_by(|a, b| a.0.total_cmp(&b.0));
    ordered.truncate(MOST_FITTED);
    let fitted =
        threads::map(ordered.len(), |k| Labelled::new(search, ordered[k].1.clone(), modes));
    let mut fitted: Vec<Labelled> = fitted.into_iter().filter_map(|one| one.ok()).collect();
    fitted.sort_by(|a, b| a.chi2.total_cmp(&b.chi2));
    Ok(fitted)
}

/// All labellings that may be, as far as they are looked at.
fn rising(search: &Search, told: &Labels, start: &Shown) -> Vec<Labels> {
    let lines = &search.readings.lines;
    // By rising frequency, so that labels rise with it.
    let mut order: Vec<usize> = (0..lines.len()).collect();
    order.sort_by(|a, b| lines[*a].frequency.value.total_cmp(&lines[*b].frequency.value));
    let mut all: Vec<(usize, Labels)> = vec![(0, vec![None; lines.len()])];
    for line in order {
        let mut longer = vec![];
        for (last, labels) in &all {
            let mut put = |mode: Option<usize>| {
                let mut labels = labels.clone();
                labels[line] = mode;
                longer.push((mode.unwrap_or(*last), labels));
            };
            if let Some(mode) = told[line] {
                put(Some(mode));
                continue;
            }
            put(None);
            for mode in last + 1..=start.frequencies.len() {
                let ratio = lines[line].frequency.value / start.frequencies[mode - 1].value;
                if (ratio - 1.0).abs() <= FARTHEST {
                    put(Some(mode));
                }
            }
        }
        // Those with the fewest strangers first, where there are more than anybody waits for.
        longer.sort_by_key(|(_, labels)| labels.iter().filter(|label| label.is_none()).count());
        longer.truncate(MOST_LOOKED_AT);
        all = longer;
    }
    all.into_iter()
        .map(|(_, labels)| labels)
        .filter(|labels| labels.iter().any(Option::is_some))
        .collect()
}
