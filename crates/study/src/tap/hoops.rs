//! Which tones of a hollow bat belong to its wall?
//!
//! The bending modes and the hoop modes of a metal barrel are interspersed. Bending frequencies go with √E, which is
//! nearly known for a metal. The wall's tones depend also on its thickness: all of them have one further factor. Over
//! both factors the cheapest labels are found as for bending modes ([`Lines::cheapest`]), with the wall's tones among
//! the others.

use std::collections::BTreeMap;

use crate::calibrate::calibration::Property;
use crate::calibrate::labels::{Candidate, LabelChoice, Labels, Lines, contradict, gap};
use crate::calibrate::readings::{BatReadings, Priors, SpectralLine};
use crate::calibrate::unknowns::UNKNOWNS;
use crate::calibrate::wood::WoodenBat;
use crate::tap::heard::HeardLine;
use sweetspot::base::error::Result;
use sweetspot::beam::wall::extent::rings;
use sweetspot::modes::hoop::{Hoop, HoopMode};

/// Standard deviations of the logarithms of E of a metal, and of the factor on the wall's tones.
pub const METAL: f64 = 0.08;
const WALL: f64 = 0.06;
/// Range of the search on both sides in standard deviations, and its step in the logarithm of a frequency.
const REACH: f64 = 3.0;
const STEP: f64 = 2e-3;
/// Price of being a tone of the wall.
const HOOP: f64 = 1.0;
/// Number of computed tones of the wall, and their accuracy.
const MODES: usize = 8;
const TOLERANCE: f64 = 1e-3;
/// Number of computed bending modes.
const BENDING: usize = 12;

/// A mode of a bat.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BatMode {
    /// A bending mode, from 1.
    Bending(usize),
    /// A mode of the wall: waves around the barrel, and its index among those.
    Hoop(usize, usize),
}

/// The given label of a line: none, that it is no mode, or its bending mode.
pub type Known = Option<Option<usize>>;

/// Labels of lines, the best and the next that contradict them.
#[derive(Debug, Clone, PartialEq)]
pub struct WallLabels {
    /// The best.
    pub best: Vec<Option<BatMode>>,
    /// Frequencies of the best (Hz).
    pub computed: Vec<Option<f64>>,
    /// χ² of every line of the best.
    pub chi2: Vec<f64>,
    /// The second best.
    pub second: Option<Vec<Option<BatMode>>>,
    /// Their additional cost.
    pub margin: Option<f64>,
    /// Additional cost of every line as the next free mode nearby.
    pub apart: Vec<f64>,
}

impl WallLabels {
    /// Additional cost of another label for that line.
    pub fn margin_of(&self, line: usize) -> Option<f64> {
        Some(self.margin.unwrap_or(f64::INFINITY).min(self.apart[line]))
    }
}

/// The modes of the wall of a hollow bat; `None` for a bat without such a wall, as of wood. A wall that cannot be
/// solved gives no modes, and the reason.
pub fn wall(wood: &WoodenBat) -> (Option<Vec<HoopMode>>, Option<String>) {
    if !rings(&wood.bat) {
        return (None, None);
    }
    match Hoop::first(&wood.bat, MODES, TOLERANCE) {
        Ok(hoop) => (Some(hoop.lowest(MODES).into_iter().cloned().collect()), None),
        Err(error) => (Some(vec![]), Some(error.to_string())),
    }
}

/// The labels of lines that may be bending modes or modes of the wall.
///
/// # Errors
///
/// As [`WoodenBat::shown`].
pub fn labels(
    wood: &WoodenBat,
    wall: &[HoopMode],
    heard: &[HeardLine],
    known: &[Known],
) -> Result<WallLabels> {
    let bending = wood.shown(&[0.0; UNKNOWNS], BENDING)?.frequencies;
    let bending = bending.iter().enumerate();
    let bending = bending.map(|(k, f)| (BatMode::Bending(k + 1), f.value.ln()));
    let hoops =
        wall.iter().map(|mode| (BatMode::Hoop(mode.harmonic, mode.order), mode.frequency_hz.ln()));
    let all: Vec<(BatMode, f64)> = bending.chain(hoops).collect();
    // A line given as no mode stays without one.
    let asked: Vec<usize> = (0..heard.len()).filter(|k| known[*k] != Some(None)).collect();
    let line = |k: &usize| SpectralLine { frequency: heard[*k].frequency, mode: None };
    let lines = asked.iter().map(line).collect();
    let readings = BatReadings { lines, ..BatReadings::default() };
    let mut found: BTreeMap<Labels, (f64, Vec<f64>)> = BTreeMap::new();
    let steps = |deviation: f64| {
        let most = (REACH * deviation / STEP).ceil() as i32;
        (-most..=most).map(move |k| STEP * f64::from(k))
    };
    for stiff in steps(0.5 * METAL) {
        for thick in steps(WALL) {
            let log = |(mode, log): &(BatMode, f64)| match mode {
                BatMode::Bending(_) => log + stiff,
                BatMode::Hoop(..) => log + stiff + thick,
            };
            let logs: Vec<f64> = all.iter().map(log).collect();
            let mut order: Vec<usize> = (0..all.len()).collect();
            order.sort_by(|a, b| logs[*a].total_cmp(&logs[*b]));
            let candidate = |k: &usize| match all[*k].0 {
                BatMode::Bending(mode) => Candidate { log: logs[*k], gap: gap(mode), more: 0.0 },
                BatMode::Hoop(..) => Candidate { log: logs[*k], gap: 0.0, more: HOOP },
            };
            let place = |mode| order.iter().position(|k| all[*k].0 == BatMode::Bending(mode));
            let told = |k: &usize| Some(place(known[*k]??)? + 1);
            let told: Labels = asked.iter().map(told).collect();
            let search = Lines::of(&readings, LabelChoice::Stays(&told));
            let (own, price) = search.cheapest(&order.iter().map(candidate).collect::<Vec<_>>());
            let mut labels: Labels = vec![None; heard.len()];
            for (k, one) in asked.iter().zip(own) {
                labels[*k] = one.map(|one| order[one - 1] + 1);
            }
            let price = price + (2.0 * stiff / METAL).powi(2) + (thick / WALL).powi(2);
            let entry = found.entry(labels).or_insert((f64::INFINITY, vec![]));
            if price < entry.0 {
                *entry = (price, logs);
            }
        }
    }
    Ok(chosen(&all, heard, found))
}

fn chosen(
    all: &[(BatMode, f64)],
    heard: &[HeardLine],
    found: BTreeMap<Labels, (f64, Vec<f64>)>,
) -> WallLabels {
    let mut found: Vec<(Labels, (f64, Vec<f64>))> = found.into_iter().collect();
    found.sort_by(|a, b| a.1.0.total_cmp(&b.1.0));
    let (best, (price, logs)) = found[0].clone();
    let named = |labels: &Labels| labels.iter().map(|one| one.map(|k| all[k - 1].0)).collect();
    let second = found.iter().find(|(labels, _)| contradict(labels, &best));
    let log = |label: &Option<usize>| label.map(|k| logs[k - 1]);
    let away = |log: f64, line: &HeardLine| {
        let by = (line.frequency.deviation / line.frequency.value).hypot(BatReadings::MODEL);
        ((line.frequency.value.ln() - log) / by).powi(2)
    };
    let chi2 =
        |(label, line): (&Option<usize>, &HeardLine)| log(label).map_or(0.0, |log| away(log, line));
    // A bending mode and one of the wall may be so close that one tone may be either.
    let cost = |k: usize, line: &HeardLine| {
        away(logs[k], line) + if matches!(all[k].0, BatMode::Hoop(..)) { HOOP } else { 0.0 }
    };
    let apart = |(label, line): (&Option<usize>, &HeardLine)| {
        let free = (0..all.len()).filter(|k| !best.contains(&Some(k + 1)));
        let next = free.map(|k| cost(k, line)).fold(f64::INFINITY, f64::min);
        label.map_or(f64::INFINITY, |own| next - cost(own - 1, line))
    };
    WallLabels {
        apart: best.iter().zip(heard).map(apart).collect(),
        chi2: best.iter().zip(heard).map(chi2).collect(),
        computed: best.iter().map(|label| log(label).map(f64::exp)).collect(),
        best: named(&best),
        second: second.map(|(labels, _)| named(labels)),
        margin: second.map(|(_, (other, _))| other - price),
    }
}

/// The prior knowledge about a metal: E within 8 %, G/E as in the file.
pub fn metal() -> (Priors, Vec<Property>) {
    let priors = Priors { youngs_modulus: METAL, ..Priors::default() };
    (priors, vec![Property::ShearModulus, Property::Density])
}
