//! Which tones of a hollow bat belong to its wall?
//!
//! The bending modes and the hoop modes of a metal barrel are interspersed. Bending frequencies are proportional to √E,
//! which is nearly known for a metal. The wall's tones also depend on its thickness, so all of them have one further
//! factor. The cheapest labels over both factors are found as for bending modes ([`Lines::cheapest`]), with the wall's
//! tones among the others.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::Serialize;

use crate::calibrate::calibration::Property;
use crate::calibrate::labels::{Candidate, LabelChoice, Labels, Lines, contradict, gap};
use crate::calibrate::readings::{BatReadings, Priors, SpectralLine};
use crate::calibrate::unknowns::UNKNOWNS;
use crate::calibrate::wood::WoodenBat;
use crate::tap::heard::HeardLine;
use sweetspot::base::Result;
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

/// A mode of the bat.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum BatMode {
    /// A bending mode.
    Bending {
        /// Its number, from 1.
        order: usize,
    },
    /// A mode of a hollow barrel's wall.
    Hoop {
        /// Waves around the barrel.
        harmonic: usize,
        /// Its number within its harmonic, from 1.
        order: usize,
    },
}

/// The next best labels.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct NextLabels {
    /// The mode of each line, in the order of the tones, twins as one.
    pub labels: Vec<Option<BatMode>>,
    /// The increase of chi2 with these labels.
    pub margin: f64,
}

/// The given label of a line: none, that it is no mode, or its bending mode.
pub type Known = Option<Option<usize>>;

/// Labels of lines, the best and the next that contradict them.
#[derive(Debug, Clone, PartialEq)]
pub struct WallLabels {
    /// The mode of every line, its frequency (Hz) and its χ².
    pub best: Vec<Option<(BatMode, f64, f64)>>,
    /// Additional cost of every line as the next free mode nearby, at most that of the next labels.
    pub margins: Vec<f64>,
    /// The second best.
    pub second: Option<NextLabels>,
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
    let bending = bending.map(|(k, f)| (BatMode::Bending { order: k + 1 }, f.value.ln()));
    let hoops = wall.iter().map(|mode| {
        let (harmonic, order) = (mode.harmonic, mode.order);
        (BatMode::Hoop { harmonic, order }, mode.frequency_hz.ln())
    });
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
                BatMode::Bending { .. } => log + stiff,
                BatMode::Hoop { .. } => log + stiff + thick,
            };
            let logs: Vec<f64> = all.iter().map(log).collect();
            let mut order: Vec<usize> = (0..all.len()).collect();
            order.sort_by(|a, b| logs[*a].total_cmp(&logs[*b]));
            let candidate = |k: &usize| match all[*k].0 {
                BatMode::Bending { order } => {
                    Candidate { log: logs[*k], gap: gap(order), more: 0.0 }
                }
                BatMode::Hoop { .. } => Candidate { log: logs[*k], gap: 0.0, more: HOOP },
            };
            let place =
                |mode| order.iter().position(|k| all[*k].0 == BatMode::Bending { order: mode });
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
    let second = found.iter().find(|(labels, _)| contradict(labels, &best));
    let second = second.map(|(labels, (other, _))| NextLabels {
        labels: labels.iter().map(|one| one.map(|k| all[k - 1].0)).collect(),
        margin: other - price,
    });
    let chi2 = |k: usize, line: &HeardLine| {
        let by = (line.frequency.deviation / line.frequency.value).hypot(BatReadings::MODEL);
        ((line.frequency.value.ln() - logs[k]) / by).powi(2)
    };
    // A bending mode and one of the wall may be so close that one tone may be either.
    let cost = |k: usize, line: &HeardLine| {
        chi2(k, line) + if matches!(all[k].0, BatMode::Hoop { .. }) { HOOP } else { 0.0 }
    };
    let ahead = second.as_ref().map_or(f64::INFINITY, |second| second.margin);
    let margin = |(label, line): (&Option<usize>, &HeardLine)| {
        let free = (0..all.len()).filter(|k| !best.contains(&Some(k + 1)));
        let next = free.map(|k| cost(k, line)).fold(f64::INFINITY, f64::min);
        label.map_or(f64::INFINITY, |own| next - cost(own - 1, line)).min(ahead)
    };
    let named = |(label, line): (&Option<usize>, &HeardLine)| {
        label.map(|k| (all[k - 1].0, logs[k - 1].exp(), chi2(k - 1, line)))
    };
    WallLabels {
        best: best.iter().zip(heard).map(named).collect(),
        margins: best.iter().zip(heard).map(margin).collect(),
        second,
    }
}

/// The prior knowledge about a metal: E within 8 %, G/E as in the file.
pub fn metal() -> (Priors, Vec<Property>) {
    let priors = Priors { youngs_modulus: METAL, ..Priors::default() };
    (priors, vec![Property::ShearModulus, Property::Density])
}
