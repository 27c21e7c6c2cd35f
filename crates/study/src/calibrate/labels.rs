//! Which line is which mode?
//!
//! Lines rise with the modes. They are compared with the modes of every possible wood ([`Chart`]), not only with those
//! of the file's wood. At each wood the best labelling is found, and the best few of these are fitted. At a price, a
//! line may be a stranger, which is not a bending mode (hum, torsion, a hoop of a hollow barrel, the second of two
//! planes of the grain), and a mode may be unheard.

use std::collections::BTreeMap;

use crate::calibrate::chart::Chart;
use crate::calibrate::fit::{Fit, Search, data};
use crate::calibrate::readings::{BatReadings, Priors, ShearPrior, SpectralLine};
use crate::calibrate::unknowns::Logs;
use crate::engine::{Result, threads};

/// Cost in χ² of a line that is not a bending mode.
pub const STRANGER: f64 = 12.0;
/// Cost in χ² of changing a given label.
const CHANGED: f64 = 12.0;
/// Cost in χ² of a mode below the highest heard one without a line; the first mode is often too faint to be heard.
const UNHEARD: [f64; 2] = [1.0, 2.5];
/// Relative error of a computed tone in the search, due to the beam model and the two planes of the grain.
const SEARCHED: f64 = 4e-3;
/// Standard deviations of the natural logarithms of E and G/E in the search only.
const OPEN: f64 = 0.35;
/// Labellings that are fitted: the cheapest, and the cheapest that contradict the first.
const MOST_FITTED: [usize; 2] = [6, 3];
/// The highest mode that a line may be.
pub const MOST_MODES: usize = 20;

/// The mode of each line; `None` for a line that is not one of them.
pub type Labels = Vec<Option<usize>>;

/// The labels that a search may use.
#[derive(Debug, Clone, Copy)]
pub enum LabelChoice<'a> {
    /// Fixed labels; `None` if none are given.
    Stays(&'a Labels),
    /// Labels that may be changed, at a price.
    Changes(&'a Labels),
}

/// A labelling and its cost.
#[derive(Debug, Clone, PartialEq)]
pub struct Labelled {
    /// The labels.
    pub labels: Labels,
    /// The fit.
    pub fit: Fit,
    /// χ² and the cost of lines without a mode.
    pub chi2: f64,
    /// Its price in the search: χ² with nearly free E and G/E, and the prices of strangers, of unheard modes and of
    /// changed labels.
    pub price: f64,
}

impl Labelled {
    /// The fit to these labels, begun at that wood.
    ///
    /// # Errors
    ///
    /// As [`Search::fit`].
    pub fn new(search: &Search, labels: Labels, modes: usize, from: &Logs) -> Result<Self> {
        let fit = search.fit(&data(search.readings, &labels), modes, from)?;
        let chi2 = fit.chi2 + STRANGER * strangers(&labels) as f64;
        Ok(Self { labels, fit, chi2, price: chi2 })
    }
}

/// Number of lines that are not bending modes.
pub fn strangers(labels: &Labels) -> usize {
    labels.iter().filter(|label| label.is_none()).count()
}

/// Whether labels contradict each other and do not merely omit lines: two modes for one line, or no line in common.
pub fn contradict(a: &Labels, b: &Labels) -> bool {
    let pairs = || a.iter().zip(b).filter_map(|(a, b)| Some(((*a)?, (*b)?)));
    pairs().any(|(a, b)| a != b) || pairs().count() == 0
}

/// The labellings that fit best over all wood, the cheapest first.
///
/// # Errors
///
/// Those of [`Chart::of`].
pub fn best(search: &Search, told: LabelChoice, modes: usize) -> Result<Vec<Labelled>> {
    let chart = Chart::of(search, modes)?;
    let mut cheapest: BTreeMap<Labels, (f64, Logs)> = BTreeMap::new();
    let lines = Lines::of(search.readings, told);
    chart.each(|logs, tones| {
        let bending = |(k, log): (usize, &f64)| Candidate { log: *log, gap: gap(k + 1), more: 0.0 };
        let tones: Vec<Candidate> = tones.iter().enumerate().map(bending).collect();
        let (labels, price) = lines.cheapest(&tones);
        let price = price + prior(search, &logs);
        let entry = cheapest.entry(labels).or_insert((f64::INFINITY, logs));
        if price < entry.0 {
            *entry = (price, logs);
        }
    });
    cheapest.retain(|labels, _| labels.iter().any(Option::is_some));
    let mut ordered: Vec<(Labels, (f64, Logs))> = cheapest.into_iter().collect();
    ordered.sort_by(|a, b| a.1.0.total_cmp(&b.1.0));
    let [most, others] = MOST_FITTED;
    let first = ordered.first().map(|(labels, _)| labels.clone()).unwrap_or_default();
    let mut other = 0;
    let mut place = 0;
    ordered.retain(|(labels, _)| {
        let contradicts = contradict(labels, &first);
        (place, other) = (place + 1, other + usize::from(contradicts));
        place <= most || (contradicts && other <= others)
    });
    let open = opened(search.readings);
    let wide = Search { readings: &open, ..*search };
    let fitted = threads::map(ordered.len(), |k| {
        let (labels, (_, from)) = &ordered[k];
        let open = Labelled::new(&wide, labels.clone(), modes, from)?;
        let more = lines.told_price(labels) + unheard(labels);
        let one = Labelled::new(search, labels.clone(), modes, &open.fit.logs)?;
        Ok::<_, sweetspot::Error>(Labelled { price: open.chi2 + more, ..one })
    });
    let mut fitted: Vec<Labelled> = fitted.into_iter().filter_map(|one| one.ok()).collect();
    fitted.sort_by(|a, b| a.price.total_cmp(&b.price));
    Ok(fitted)
}

/// The readings with the wide prior of a search, in which E and G/E are independent.
fn opened(readings: &BatReadings) -> BatReadings {
    let known = readings.priors;
    let own = match known.shear {
        ShearPrior::OverYoung(deviation) | ShearPrior::Alone(deviation) => deviation,
    };
    let shear = ShearPrior::OverYoung(own.max(OPEN));
    let youngs_modulus = known.youngs_modulus.max(OPEN);
    let priors = Priors { youngs_modulus, shear, correlation: 0.0, ..known };
    BatReadings { priors, ..readings.clone() }
}

/// χ² of a wood in the search due to the prior knowledge.
fn prior(search: &Search, logs: &Logs) -> f64 {
    let free = search.free();
    free.iter().filter(|k| **k < 2).map(|k| (logs[*k] / OPEN).powi(2)).sum()
}

/// Price of the modes without a line.
fn unheard(labels: &Labels) -> f64 {
    let highest = labels.iter().flatten().max().copied().unwrap_or(0);
    (1..highest).filter(|mode| !labels.contains(&Some(*mode))).map(gap).sum()
}

/// Price of a bending mode without a line.
pub fn gap(mode: usize) -> f64 {
    UNHEARD[usize::from(mode > 1)]
}

/// A tone of the bat that a line may be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Candidate {
    /// Logarithm of its frequency (Hz).
    pub log: f64,
    /// Price if it is unheard although a higher one was heard.
    pub gap: f64,
    /// Price of choosing it.
    pub more: f64,
}

/// A line to be labelled.
struct OpenLine {
    /// Its place in the readings.
    place: usize,
    /// Logarithm of its frequency, and its error.
    log: f64,
    sigma: f64,
    /// The given label, and the price of another one.
    told: Option<usize>,
    other: f64,
}

/// The lines by rising frequency, so that labels rise with them.
pub struct Lines(Vec<OpenLine>);

impl Lines {
    /// The lines of readings, with their given labels.
    pub fn of(readings: &BatReadings, told: LabelChoice) -> Self {
        let (labels, other) = match told {
            LabelChoice::Stays(labels) => (labels, f64::INFINITY),
            LabelChoice::Changes(labels) => (labels, CHANGED),
        };
        let line = |(place, line): (usize, &SpectralLine)| {
            let value = line.frequency.value;
            let sigma = (line.frequency.deviation / value).hypot(readings.model.max(SEARCHED));
            OpenLine { place, log: value.ln(), sigma, told: labels[place], other }
        };
        let mut all: Vec<OpenLine> = readings.lines.iter().enumerate().map(line).collect();
        all.sort_by(|a, b| a.log.total_cmp(&b.log));
        Self(all)
    }

    /// Price of the labels that differ from the given ones.
    fn told_price(&self, labels: &Labels) -> f64 {
        let changed = |line: &&OpenLine| line.told.is_some() && line.told != labels[line.place];
        self.0.iter().filter(changed).map(|line| line.other).sum()
    }

    /// Whether a mode is the label of a line that keeps it.
    fn is_kept(&self, mode: usize) -> bool {
        self.0.iter().any(|line| line.told == Some(mode) && line.other.is_infinite())
    }

    /// The cheapest rising labels for these rising tones, which count from 1, and their price: χ² of lines within
    /// reach, of strangers, of unheard modes and of changed labels. From line to line the cheapest way to every last
    /// mode is kept.
    pub fn cheapest(&self, tones: &[Candidate]) -> (Labels, f64) {
        let count = tones.len();
        // Price and labels by the last mode so far, 0 for none.
        let mut ways: Vec<Option<(f64, Labels)>> = vec![None; count + 1];
        ways[0] = Some((0.0, vec![None; self.0.len()]));
        for line in &self.0 {
            let mut next: Vec<Option<(f64, Labels)>> = vec![None; count + 1];
            for (last, way) in ways.iter().enumerate() {
                let Some((price, labels)) = way else { continue };
                let mut offer = |mode: Option<usize>, more: f64| {
                    let told =
                        if line.told.is_some() && line.told != mode { line.other } else { 0.0 };
                    let (to, whole) = (mode.unwrap_or(last), price + more + told);
                    if whole.is_finite() && next[to].as_ref().is_none_or(|(best, _)| whole < *best)
                    {
                        let mut labels = labels.clone();
                        labels[line.place] = mode;
                        next[to] = Some((whole, labels));
                    }
                };
                offer(None, STRANGER);
                let mut skipped = 0.0;
                // A fixed label is kept even if it does not rise.
                let first = match line.told {
                    Some(mode) if line.other.is_infinite() => mode.min(last + 1),
                    _ => last + 1,
                };
                for mode in first..=count {
                    let tone = tones[mode - 1];
                    let chi2 = ((line.log - tone.log) / line.sigma).powi(2);
                    let stays = line.told == Some(mode);
                    if stays || (chi2 < STRANGER && !self.is_kept(mode)) {
                        offer(Some(mode), chi2.min(10.0 * STRANGER) + tone.more + skipped);
                    }
                    skipped += tone.gap;
                }
            }
            ways = next;
        }
        let best = ways.into_iter().flatten().min_by(|a, b| a.0.total_cmp(&b.0));
        best.map_or((vec![None; self.0.len()], f64::INFINITY), |(price, labels)| (labels, price))
    }
}
