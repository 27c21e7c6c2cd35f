//! Labels of the tones of a recording, their probability, and the wood that follows from all of them.

use sweetspot_tap::analysis::Analysis;

use crate::calibrate::calibration::{Calibration, CalibrationPlan, Property, SURE};
use crate::calibrate::fit::DatumKind;
use crate::calibrate::labels::{MOST_MODES, STRANGER};
use crate::calibrate::readings::{BatReadings, Priors, RingDown, SpectralLine};
use crate::calibrate::wood::WoodenBat;
use crate::tap::heard::{HeardLine, Within, lines};
use crate::tap::hoops::{self, BatMode, Known, NextLabels, metal};
use sweetspot::base::{Error, Result};
use sweetspot::bat::{Bat, STANDARD_PIVOT};

/// Most lines without a given mode that are labelled.
const MOST_UNTOLD: usize = 10;
/// A tone belongs to a given frequency if it is within this of it, relative.
const NEAR: f64 = 0.01;

/// The label of a tone.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ToneLabel {
    /// The mode; `None` if it is not a mode of this bat.
    pub mode: Option<BatMode>,
    /// The computed frequency of the fitted bat there (Hz).
    pub computed: Option<f64>,
    /// The chance that the label is right.
    pub sure: f64,
    /// Factor by which the loss factor raises the computed frequency.
    pub stiffer: f64,
    /// Whether modes were tried for it; of wood, the loudest tones are labelled.
    pub tried: bool,
}

/// A given label: the tone near that frequency (Hz) is that bending mode, or not a mode.
pub type Told = (f64, Option<usize>);

/// The results of the tones of a bat.
#[derive(Debug, Clone)]
pub struct Tapped {
    /// The label of each tone.
    pub labels: Vec<ToneLabel>,
    /// The second best labels.
    pub second: Option<NextLabels>,
    /// The wood; `None` if no tone is a bending mode of the bat.
    pub wood: Option<Calibration>,
    /// An upper limit of the loss factor of the wood: that of the least damped tone.
    pub loss: Option<Within>,
    /// The reason why the modes of the wall of a hollow bat are not known.
    pub unsolved: Option<String>,
}

impl Tapped {
    /// The tones of a bat; `None` if the recordings are refused.
    ///
    /// # Errors
    ///
    /// Those of [`Tapped::of`].
    pub fn heard(bat: &Bat, analysis: &Analysis, told: &[Told]) -> Result<Option<Self>> {
        match analysis.refused {
            Some(_) => Ok(None),
            None => Self::of(bat, analysis, told).map(Some),
        }
    }

    /// The tones of a bat, some of which may have given labels.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for a given tone that is not in the recording, and those of [`WoodenBat::new`] and of a solve.
    pub fn of(bat: &Bat, analysis: &Analysis, told: &[Told]) -> Result<Self> {
        let wood = WoodenBat::new(bat, None, STANDARD_PIVOT)?;
        let (wall, unsolved) = hoops::wall(&wood);
        let heard = lines(analysis, wall.is_none());
        let known = known(analysis, &heard, told)?;
        let wall = wall.map(|wall| hoops::labels(&wood, &wall, &heard, &known)).transpose()?;
        let on_wall = |k: usize| wall.as_ref()?.best[k];
        // Bending modes as given; for a hollow bat as found; else to be sought.
        let bending = |k: usize| match (known[k], on_wall(k)) {
            (Some(told), _) => told,
            (None, Some((BatMode::Bending { order }, ..))) => Some(order),
            _ => None,
        };
        let is_line = |k: &usize| match known[*k] {
            Some(told) => told.is_some(),
            None => wall.is_none() || bending(*k).is_some(),
        };
        let lines = (0..heard.len()).filter(is_line);
        let taken = loudest(lines.collect(), |k| known[k].is_some(), |k| heard[k].level);
        let (priors, held) = match wall {
            Some(_) => metal(),
            None => (Priors::default(), vec![Property::Density]),
        };
        let line = |k: &usize| SpectralLine { frequency: heard[*k].frequency, mode: bending(*k) };
        let lines: Vec<SpectralLine> = taken.iter().map(line).collect();
        let readings = BatReadings { lines, priors, ..BatReadings::default() };
        let plan = CalibrationPlan { split: None, held };
        let found = calibrated(bat, readings, &plan)?;
        let stiffer: Vec<f64> = taken.iter().map(|k| heard[*k].stiffer).collect();
        let found = found.map(|found| or_constant(bat, found, &plan, &stiffer)).transpose()?;
        let margin = |k: usize| match &wall {
            Some(wall) => Some(wall.margins[k]),
            None => found.as_ref().and_then(|found| found.labels.margin),
        };
        let of_wall = |k: usize| match (known[k], on_wall(k)) {
            (None, Some((mode, hz, chi2))) => labelled(Some(mode), Some(hz), sure(margin(k), chi2)),
            _ => ToneLabel { tried: wall.is_some() || known[k].is_some(), ..Default::default() },
        };
        let mut labels: Vec<ToneLabel> = (0..heard.len()).map(of_wall).collect();
        if let Some(found) = &found {
            for (k, mode) in taken.iter().zip(&found.labels.taken) {
                labels[*k] = of_wood(found, *mode, margin(*k), known[*k] == Some(*mode));
            }
        }
        let second = match wall {
            Some(wall) => wall.second,
            None => found.as_ref().and_then(|found| second_of(found, &taken, heard.len())),
        };
        let loss = least_loss(analysis, &heard, &labels);
        let wood = match &loss {
            Some((loss, order)) => {
                found.map(|found| found.with_ring_down(RingDown::of_loss(*order, loss.value)))
            }
            None => found,
        };
        let labels = of_tones(&heard, &labels, analysis.tones.len());
        Ok(Self { labels, second, wood, loss: loss.map(|(loss, _)| loss), unsolved })
    }

    /// Whether the tones fit the bat: they agree with its wood, no other labels come near, and at least half of the
    /// tones that were tried are modes of it.
    pub fn fits(&self) -> bool {
        let known = self.labels.iter().filter(|label| label.mode.is_some()).count();
        let tried = self.labels.iter().filter(|label| label.tried).count();
        let near = self.second.as_ref().is_some_and(|second| second.margin < SURE);
        self.wood.as_ref().is_some_and(|wood| wood.fits) && !near && 2 * known >= tried
    }

    /// Whether a label may well be another one.
    pub fn is_unsure(&self) -> bool {
        let unsure = |label: &ToneLabel| label.mode.is_some() && label.sure < 0.9;
        self.labels.iter().any(unsure) || self.wood.is_none()
    }
}

/// The loudest of the lines without a given mode, as many as the search labels.
fn loudest(
    mut lines: Vec<usize>,
    told: impl Fn(usize) -> bool,
    level: impl Fn(usize) -> f64,
) -> Vec<usize> {
    lines.sort_by(|a, b| told(*b).cmp(&told(*a)).then(level(*b).total_cmp(&level(*a))));
    let told = lines.iter().filter(|k| told(**k)).count();
    lines.truncate(told + MOST_UNTOLD);
    lines.sort_unstable();
    lines
}

/// The given label of every line, if there is one.
fn known(analysis: &Analysis, heard: &[HeardLine], told: &[Told]) -> Result<Vec<Known>> {
    let mut known = vec![None; heard.len()];
    for (hz, mode) in told {
        let line = &mut known[near(analysis, heard, *hz)?];
        if line.is_some() {
            return Err(Error::value("`mode`", format!("{hz} Hz twice"), "each tone once"));
        }
        *line = Some(*mode);
    }
    let modes: Vec<usize> = known.iter().flatten().flatten().copied().collect();
    if let Some(mode) = modes.iter().find(|mode| !(1..=MOST_MODES).contains(*mode)) {
        return Err(Error::value("`mode`", mode, format!("1 to {MOST_MODES}")));
    }
    if modes.is_sorted_by(|a, b| a < b) {
        return Ok(known);
    }
    let expected = "modes that rise with the frequencies of their tones";
    Err(Error::value("`mode`", format!("the modes {modes:?} of rising tones"), expected))
}

/// The line nearest to a given frequency.
fn near(analysis: &Analysis, heard: &[HeardLine], hz: f64) -> Result<usize> {
    let far = |line: &HeardLine| {
        let all = line.tones.iter().map(|k| (analysis.tones[*k].pole.hz / hz).ln().abs());
        all.fold(f64::INFINITY, f64::min)
    };
    let nearest = (0..heard.len()).min_by(|a, b| far(&heard[*a]).total_cmp(&far(&heard[*b])));
    nearest.filter(|k| far(&heard[*k]) < NEAR).ok_or_else(|| {
        let all: Vec<String> =
            analysis.tones.iter().map(|tone| format!("{:.1}", tone.pole.hz)).collect();
        Error::value(
            "`mode`",
            format!("{hz} Hz"),
            format!("one of the tones: {} Hz", all.join(", ")),
        )
    })
}

/// The calibration; `None` if no line is a mode of the bat in any wood.
fn calibrated(
    bat: &Bat,
    readings: BatReadings,
    plan: &CalibrationPlan,
) -> Result<Option<Calibration>> {
    if readings.lines.is_empty() {
        return Ok(None);
    }
    match Calibration::new(bat, readings, plan) {
        Ok(found) => Ok(Some(found)),
        Err(Error::Value(complaint)) if complaint.field == "lines" => Ok(None),
        Err(error) => Err(error),
    }
}

/// The wood with intervals that include moduli which are constant: stiffening is a law of many woods, not a measurement
/// of this one. `stiffer` is the factor of every line.
fn or_constant(
    bat: &Bat,
    found: Calibration,
    plan: &CalibrationPlan,
    stiffer: &[f64],
) -> Result<Calibration> {
    let mut readings = found.readings.clone();
    for ((line, mode), by) in readings.lines.iter_mut().zip(&found.labels.taken).zip(stiffer) {
        (line.mode, line.frequency.value) = (*mode, by * line.frequency.value);
    }
    readings.lines.retain(|line| line.mode.is_some());
    let constant = calibrated(bat, readings, plan)?;
    Ok(match constant {
        Some(constant) => found.as_wide_as(&constant),
        None => found,
    })
}

/// The probability that a label is right, from the additional cost of the next labels, and from the distance of the
/// tone's cost below the price of a tone that is not a mode.
fn sure(margin: Option<f64>, chi2: f64) -> f64 {
    let margin = margin.unwrap_or(f64::INFINITY).min(STRANGER - chi2).max(0.0);
    1.0 / (1.0 + (-0.5 * margin).exp())
}

fn of_wood(found: &Calibration, mode: Option<usize>, margin: Option<f64>, told: bool) -> ToneLabel {
    let Some(order) = mode else { return labelled(None, None, 0.0) };
    let datum = found.data.iter().find(|one| one.datum.kind == DatumKind::Frequency(order));
    let chi2 = datum.map_or(0.0, |one| one.residual_sd.powi(2));
    let sure = if told { 1.0 } else { sure(margin, chi2) };
    let computed = datum.map(|one| one.computed);
    labelled(Some(BatMode::Bending { order }), computed, sure)
}

fn labelled(mode: Option<BatMode>, computed: Option<f64>, sure: f64) -> ToneLabel {
    ToneLabel { mode, computed, sure, tried: true, stiffer: 1.0 }
}

fn second_of(found: &Calibration, taken: &[usize], lines: usize) -> Option<NextLabels> {
    let (second, margin) = found.labels.second.as_ref().zip(found.labels.margin)?;
    let mut labels = vec![None; lines];
    for (k, mode) in taken.iter().zip(second) {
        labels[*k] = mode.map(|order| BatMode::Bending { order });
    }
    Some(NextLabels { labels, margin })
}

/// Converts labels of lines to labels of their tones, with the frequencies as recorded.
fn of_tones(heard: &[HeardLine], labels: &[ToneLabel], tones: usize) -> Vec<ToneLabel> {
    let mut all = vec![ToneLabel::default(); tones];
    for (line, label) in heard.iter().zip(labels) {
        for k in &line.tones {
            let (stiffer, computed) = (line.stiffer, label.computed.map(|hz| hz * line.stiffer));
            all[*k] = ToneLabel { computed, stiffer, ..*label };
        }
    }
    all
}

/// The loss factor of the least damped labelled bending tone, and its mode; hands and strings only add damping.
fn least_loss(
    analysis: &Analysis,
    heard: &[HeardLine],
    labels: &[ToneLabel],
) -> Option<(Within, usize)> {
    let of = |(line, label): (&HeardLine, &ToneLabel)| {
        let Some(BatMode::Bending { order }) = label.mode else { return vec![] };
        let tones = line.tones.iter().map(|k| (Within::loss(&analysis.tones[*k]), order));
        tones.collect()
    };
    let all = heard.iter().zip(labels).flat_map(of).filter(|_| analysis.has_loss);
    all.min_by(|a, b| a.0.value.total_cmp(&b.0.value))
}
