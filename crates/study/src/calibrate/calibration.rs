//! What is this wood, and how much do the readings say about it?
//!
//! [`Calibration::new`] from a bat and what was measured of it.

use serde::Serialize;

use crate::calibrate::estimated::estimated;
pub use crate::calibrate::estimated::{Estimated, Verdict};
use crate::calibrate::fit::{DatumKind, Fit, Residual, Search, misfit};
use crate::calibrate::labels::{
    LabelChoice, Labelled, Labels, MOST_MODES, best, contradict, strangers,
};
use crate::calibrate::next::{BEYOND, Proposal, proposals};
use crate::calibrate::readings::{BatReadings, Priors, RingDown};
pub use crate::calibrate::unknowns::Property;
use crate::calibrate::unknowns::{Logs, UNKNOWNS, form};
use crate::calibrate::wood::WoodenBat;
use crate::engine::{Bat, Error, Result, STANDARD_PIVOT};

/// 95 of 100 of a normal distribution lie within this many standard deviations.
pub const NINETY_FIVE: f64 = 1.959_963_984_540_054;
/// Labels that cost less than this more than the best ones may be the right ones: of tones of random wood a
/// labelling that is ahead by 8 is right in 97 of 100 cases with two tones and in all with more.
pub(crate) const SURE: f64 = 8.0;
/// Other labels replace the given ones if they cost this much less.
const EXPLAINS: f64 = 24.0;
/// How a calibration is made.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct CalibrationPlan {
    /// Position of the border of the barrel's region (m), if there are two regions.
    pub split: Option<f64>,
    /// Properties that stay as the file has them.
    pub held: Vec<Property>,
}

/// The mode assigned to each line, in the order of the readings; null for a line of no bending mode.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Identified {
    /// Frequencies of the lines (Hz).
    pub lines_hz: Vec<f64>,
    /// The labels that are used.
    pub taken: Labels,
    /// Their chi2.
    // That of strangers included.
    pub chi2: f64,
    /// The labels of the readings, if others are used.
    pub told: Option<Labels>,
    /// Their chi2.
    pub told_chi2: Option<f64>,
    /// The second best labels, if others were tried.
    // The best that contradict those in use.
    pub second: Option<Labels>,
    /// Their chi2.
    pub second_chi2: Option<f64>,
    /// Their additional cost in the search over all wood; below 8 they may be the right ones.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub margin: Option<f64>,
    /// Number of measured modes whose shapes match no bending mode.
    #[serde(skip)]
    pub unlike: usize,
}

impl Identified {
    /// Whether no other labels come near those in use.
    pub fn is_sure(&self) -> bool {
        self.margin.is_none_or(|margin| margin >= SURE)
    }

    /// Whether at least half of several lines are not bending modes, by their frequencies or their shapes.
    pub fn is_mostly_discarded(&self) -> bool {
        let all = self.taken.len() + self.unlike;
        all > 1 && 2 * (strangers(&self.taken) + self.unlike) >= all
    }

    /// Indices of the lines with a given label that was replaced.
    pub fn changed(&self) -> Vec<usize> {
        let told = self.told.iter().flat_map(|told| told.iter().zip(&self.taken).enumerate());
        told.filter(|(_, (told, taken))| told.is_some() && told != taken).map(|(k, _)| k).collect()
    }
}

/// The wood without the data that do not fit.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct WithoutOutliers {
    /// The parameters.
    pub parameters: Vec<Estimated>,
    /// Their chi2.
    pub chi2: f64,
    /// The number of data that remain.
    pub expected: usize,
}

/// The loss factor by a tone that died out.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct LossFound {
    /// Number of the bending mode.
    pub mode: usize,
    /// Damping ratio.
    pub damping_ratio: f64,
    /// Loss factor, twice that.
    pub loss_factor: f64,
}

/// The properties of a bat's wood: the members of a calibration's document that describe the fit.
#[derive(Debug, Clone, Serialize, schemars::JsonSchema)]
pub struct Calibration {
    /// Position of the border of the barrel's region (m), if there are two regions.
    pub regions_at_m: Option<f64>,
    /// The parameters of the wood.
    pub parameters: Vec<Estimated>,
    /// Covariance of the natural logarithms of the parameters, in their order; scatter reads it.
    pub covariance: Vec<Vec<f64>>,
    /// The measured values, each with the value of the fitted bat.
    pub data: Vec<Residual>,
    /// Sum of squares of all residuals and of the deviations from prior knowledge, each over its standard deviation.
    pub chi2: f64,
    /// Its expected value: the number of data.
    pub expected: usize,
    /// How many times larger all errors would have to be for both to be equal.
    // Birge's ratio.
    pub errors_larger_by: f64,
    /// Assumed relative error of the beam model in a frequency.
    pub model: f64,
    /// Whether the readings fit this bat.
    // There is no outlier, the fit has converged, χ² of the data is not far above their number, no given label was
    // replaced, no other labels come near, most of the lines are bending modes, and each mode has one loss factor.
    pub fits: bool,
    /// Steps of the fit.
    pub steps: usize,
    /// The mode assigned to each line.
    pub labels: Identified,
    /// Names of the data that do not fit the others.
    #[schemars(with = "Vec<String>")]
    pub outliers: Vec<DatumKind>,
    /// The parameters without the outliers; null if there are none.
    pub without_outliers: Option<WithoutOutliers>,
    /// Loss factors, frequency by frequency.
    pub loss_factors: Vec<LossFound>,
    /// The effect of further measurements.
    pub next: Vec<Proposal>,
    /// Whether the readings fit the fitted wood, whatever the labels.
    #[serde(skip)]
    pub readings_agree: bool,
    /// Whether G is the typical one of its kind, because the file has none.
    #[serde(skip)]
    pub typical_shear: bool,
    /// The name of the file's material, if it has one.
    #[serde(skip)]
    pub material: Option<String>,
    /// The bat with the fitted wood.
    #[serde(skip)]
    pub bat: Bat,
    /// The measurements.
    #[serde(skip)]
    pub readings: BatReadings,
}

impl Calibration {
    /// The wood of a bat with these measurements.
    ///
    /// ```
    /// use sweetspot::Bat;
    /// use sweetspot_study::calibrate::calibration::{Calibration, CalibrationPlan};
    /// use sweetspot_study::calibrate::readings::{BatReadings, Reading, SpectralLine};
    ///
    /// # fn main() -> sweetspot::Result<()> {
    /// # let text = r#"{ "format": "sweetspot-bat/1", "material": "white-ash-dynamic",
    /// #     "profile": { "unit": "in", "x": [0, 6, 20, 27, 33], "diameter": [1.0, 0.9, 1.6, 2.4, 2.5] } }"#;
    /// # let bat = Bat::from_text("bat.json", text, "".as_ref())?;
    /// let line = |value, mode| {
    ///     let frequency = Reading { value, deviation: 0.5 };
    ///     SpectralLine { frequency, mode: Some(mode) }
    /// };
    /// let readings = BatReadings {
    ///     mass: Some(Reading { value: 0.80, deviation: 1e-3 }),
    ///     lines: vec![line(165.0, 1), line(551.0, 2), line(1160.0, 3)],
    ///     ..BatReadings::default()
    /// };
    /// let found = Calibration::new(&bat, readings, &CalibrationPlan::default())?;
    /// let modulus = &found.parameters[0];
    /// println!("E = {:.3e} Pa within {:?}", modulus.value, modulus.interval95);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::Value`] if nothing was measured, or if readings do not belong to this bat; those of [`WoodenBat::new`]
    /// and of a solve.
    pub fn new(bat: &Bat, readings: BatReadings, plan: &CalibrationPlan) -> Result<Self> {
        let pivot = readings.pendulum.map_or(STANDARD_PIVOT, |swing| swing.pivot);
        check(bat, &readings, pivot)?;
        let wood = WoodenBat::new(bat, plan.split, pivot)?;
        let mut search =
            Search { wood: &wood, readings: &readings, held: &plan.held, about: [0.0; UNKNOWNS] };
        let properties = Property::of(wood.regions());
        if let Some(held) = plan.held.iter().find(|held| !properties.contains(held)) {
            return Err(Error::value("--hold", held.name(), "E, G or density without --regions"));
        }
        if search.free().is_empty() {
            return Err(Error::value("--hold", "everything", "something that is not held"));
        }
        let (taken, labels) = labelled(&search)?;
        let mut fit = taken.fit;
        if let Some(about) = another_wood(&search, &fit)? {
            search.about = about;
            let data: Vec<_> = fit.residuals.iter().map(|residual| residual.datum).collect();
            fit = search.fit(&data, fit.shown.frequencies.len(), &about)?;
        }
        let (parameters, open) = estimated(&search, &fit)?;
        let parts: Vec<Vec<f64>> =
            properties.iter().map(|property| property.parts(fit.covariance.len())).collect();
        let outliers = fit.residuals.iter().filter(|residual| residual.is_outlier());
        let outliers: Vec<DatumKind> = outliers.map(|residual| residual.datum.kind).collect();
        let readings_agree = outliers.is_empty() && is_near(&fit);
        let covariance = |a: &Vec<f64>| parts.iter().map(|b| form(&open, a, b)).collect();
        let expected = fit.residuals.len();
        Ok(Self {
            regions_at_m: plan.split,
            covariance: parts.iter().map(covariance).collect(),
            chi2: fit.chi2,
            expected,
            errors_larger_by: (fit.chi2 / expected as f64).sqrt(),
            model: readings.model,
            fits: readings_agree
                && labels.changed().is_empty()
                && labels.is_sure()
                && !labels.is_mostly_discarded()
                && contrary(&readings.ring_down).is_none()
                && !parameters.iter().any(Estimated::is_foreign_density),
            parameters,
            steps: fit.steps,
            labels,
            outliers,
            without_outliers: without(&search, &fit)?,
            loss_factors: readings.ring_down.iter().map(LossFound::of).collect(),
            next: proposals(&search, &fit, &parts),
            readings_agree,
            typical_shear: wood.typical_shear,
            material: bat.material().name.clone(),
            bat: wood.of(&fit.logs)?,
            data: fit.residuals,
            readings,
        })
    }

    /// The loss factor of the wood, the mean over all tones with a measured decay; `None` without one.
    pub fn loss_factor(&self) -> Option<f64> {
        let all = &self.loss_factors;
        let sum: f64 = all.iter().map(|tone| tone.loss_factor).sum();
        (!all.is_empty()).then(|| sum / all.len() as f64)
    }

    /// The same wood with one more measured decay.
    #[must_use]
    pub fn with_ring_down(mut self, tone: RingDown) -> Self {
        self.loss_factors.push(LossFound::of(&tone));
        self.readings.ring_down.push(tone);
        self
    }

    /// The same wood, its intervals wider on both sides by its difference from that of another fit.
    #[must_use]
    pub fn as_wide_as(mut self, other: &Self) -> Self {
        for (k, other) in other.parameters.iter().enumerate() {
            let one = &mut self.parameters[k];
            let apart = (other.value / one.value).ln().abs();
            let [low, high] = one.interval95;
            one.interval95 = [low * (-apart).exp(), high * apart.exp()];
            let factor = 1.0 + apart / (NINETY_FIVE * one.relative_sd.max(f64::EPSILON));
            one.relative_sd *= factor;
            self.covariance[k].iter_mut().for_each(|own| *own *= factor);
            self.covariance.iter_mut().for_each(|row| row[k] *= factor);
        }
        self
    }

    /// The parameter that the readings determine least, among those sought, and the measurement that would improve it
    /// most.
    pub fn advice(&self) -> Option<(&Estimated, &Proposal, f64)> {
        let sought = self.parameters.iter().enumerate();
        let sought = sought.filter(|(_, parameter)| parameter.verdict != Verdict::Held);
        let (k, least) = sought.min_by(|a, b| a.1.learned.total_cmp(&b.1.learned))?;
        let best = self.next.iter().min_by(|a, b| a.factors[k].total_cmp(&b.factors[k]))?;
        Some((least, best, best.factors[k]))
    }
}

impl LossFound {
    fn of(tone: &RingDown) -> Self {
        let (damping_ratio, loss_factor) = (tone.damping_ratio(), tone.loss_factor());
        Self { mode: tone.mode, damping_ratio, loss_factor }
    }
}

/// The first mode whose loss factors differ by more than a factor of two, with the least and the largest: amplitudes
/// read to a tenth explain a sixth.
pub fn contrary(tones: &[RingDown]) -> Option<(usize, [f64; 2])> {
    tones.iter().find_map(|RingDown { mode, .. }| {
        let own = tones.iter().filter(|other| other.mode == *mode).map(RingDown::loss_factor);
        let ends = [own.clone().fold(f64::INFINITY, f64::min), own.fold(0.0, f64::max)];
        (ends[1] > 2.0 * ends[0]).then_some((*mode, ends))
    })
}

/// The largest χ² of the given number of data that chance explains: four standard deviations above their number.
fn far(data: usize) -> f64 {
    data as f64 + 4.0 * (2.0 * data as f64).sqrt()
}

/// Refuses readings that cannot belong to this bat.
fn check(bat: &Bat, readings: &BatReadings, pivot: f64) -> Result<()> {
    let rigid = [readings.mass.is_some(), readings.balance_point.is_some()];
    if rigid == [false; 2] && readings.pendulum.is_none() && readings.lines.is_empty() {
        let alone = readings.ring_down.first().map_or(String::new(), |tone| {
            format!("; \"ring_down\" alone tells the loss factor, {:.3e}", tone.loss_factor())
        });
        let expected = format!("\"mass\", \"balance_point\", \"pendulum\" or \"lines\"{alone}");
        let found = "nothing that was measured of E, G and density";
        return Err(Error::value("readings", found, expected));
    }
    let length = bat.length();
    if let Some(balance) = readings.balance_point.filter(|balance| balance.value >= length) {
        let expected = format!("a place on the bat, below {length} m");
        return Err(Error::value("balance_point", format!("{} m", balance.value), expected));
    }
    let center = bat.inertia().balance_point;
    if readings.pendulum.is_some() && !(0.0..0.9 * center).contains(&pivot) {
        let expected =
            format!("a place on the knob side of the balance point, which is at {center:.3} m");
        return Err(Error::value("pendulum.pivot", format!("{pivot} m"), expected));
    }
    let attached = bat.fixtures().attached_mass();
    if let Some(mass) = readings.mass.filter(|mass| mass.value <= attached) {
        let found = format!("{} kg, no more than the {attached} kg attached", mass.value);
        return Err(Error::value("mass", found, "the mass of bat and attachments"));
    }
    let unlabelled = readings.lines.iter().filter(|line| line.mode.is_none()).count();
    if readings.lines.len() > MOST_MODES || unlabelled > 10 {
        let found = format!("{} lines, {unlabelled} of them without a mode", readings.lines.len());
        let expected = format!("{MOST_MODES} at most, and 10 whose mode is not known");
        return Err(Error::value("lines", found, expected));
    }
    Ok(())
}

/// Whether a fit has settled near its data.
fn is_near(fit: &Fit) -> bool {
    fit.settled && misfit(&fit.residuals) <= far(fit.residuals.len())
}

/// The centre of the prior knowledge if the wood is not the file's: E and density as the readings say, all else as in
/// the file. `None` if the fitted wood may be of the file's kind.
fn another_wood(search: &Search, fit: &Fit) -> Result<Option<Logs>> {
    /// χ² of the prior knowledge that one wood in a hundred of the file's kind exceeds.
    const RARE: f64 = 10.0;
    /// Standard deviation for a wood about which nothing is known.
    const ANY: f64 = 1e3;
    if fit.chi2 - misfit(&fit.residuals) < RARE || !fit.settled {
        return Ok(None);
    }
    let priors = Priors { youngs_modulus: ANY, correlation: 0.0, ..search.readings.priors };
    let readings = BatReadings { priors, ..search.readings.clone() };
    let open = Search { readings: &readings, ..*search };
    let data: Vec<_> = fit.residuals.iter().map(|residual| residual.datum).collect();
    let found = open.fit(&data, fit.shown.frequencies.len(), &fit.logs)?;
    let [e, _, density, barrel, _] = found.logs;
    Ok(found.settled.then_some([e, 0.0, density, barrel, 0.0]))
}

/// The labels in use, and the alternatives. The given labels are used if they fit; otherwise, and for lines without
/// labels, those that fit best over all wood.
fn labelled(search: &Search) -> Result<(Labelled, Identified)> {
    let told: Labels = search.readings.lines.iter().map(|line| line.mode).collect();
    let highest = told.iter().flatten().max().copied().unwrap_or(0);
    let modes = (highest.max(told.len()) + BEYOND).clamp(3, MOST_MODES + BEYOND);
    let searched = modes.max(told.len() + 4).max(8);
    let kept = match told.iter().all(Option::is_some) {
        true => vec![Labelled::new(search, told.clone(), modes, &[0.0; UNKNOWNS])?],
        false => best(search, LabelChoice::Stays(&told), searched)?,
    };
    let fits = |one: &Labelled| is_near(&one.fit) && 2 * strangers(&one.labels) < told.len().max(2);
    let nothing_told = told.iter().all(Option::is_none);
    if kept.first().is_some_and(fits) || told.is_empty() || nothing_told {
        return taken(search, kept, None);
    }
    let other = best(search, LabelChoice::Changes(&told), searched)?;
    match (kept.first(), other.first()) {
        // Other labels are used only if they explain the readings, and nearly all of them.
        (None, Some(_)) => taken(search, other, None),
        (Some(as_told), Some(found)) if fits(found) && found.chi2 + EXPLAINS < as_told.chi2 => {
            let as_told = (told, as_told.chi2);
            taken(search, other, Some(as_told))
        }
        _ => taken(search, kept, None),
    }
}

/// The first of these labellings, and the next one that contradicts it.
fn taken(
    search: &Search,
    found: Vec<Labelled>,
    told: Option<(Labels, f64)>,
) -> Result<(Labelled, Identified)> {
    let mut found = found.into_iter();
    let Some(best) = found.next() else {
        let expected = "lines of which one at least is a bending mode of this bat, of wood from a quarter to four times as stiff";
        return Err(Error::value("lines", "none that may be a bending mode of this bat", expected));
    };
    let second = found.find(|second| contradict(&second.labels, &best.labels));
    let (told, told_chi2) = told.unzip();
    let margin = second.as_ref().map(|second| second.price - best.price);
    let (second, second_chi2) = second.map(|second| (second.labels, second.chi2)).unzip();
    let lines = search.readings.lines.iter();
    let identified = Identified {
        lines_hz: lines.map(|line| line.frequency.value).collect(),
        taken: best.labels.clone(),
        chi2: best.chi2,
        told,
        told_chi2,
        second,
        second_chi2,
        margin,
        unlike: search.readings.unlike,
    };
    Ok((best, identified))
}

/// The fit without outliers, if there are any and two data remain.
fn without(search: &Search, fit: &Fit) -> Result<Option<WithoutOutliers>> {
    let kept = fit.residuals.iter().filter(|residual| !residual.is_outlier());
    let kept: Vec<_> = kept.map(|residual| residual.datum).collect();
    if kept.len() == fit.residuals.len() || kept.len() < 2 {
        return Ok(None);
    }
    let again = search.fit(&kept, fit.shown.frequencies.len(), &[0.0; UNKNOWNS])?;
    let (parameters, _) = estimated(search, &again)?;
    Ok(Some(WithoutOutliers { parameters, chi2: again.chi2, expected: kept.len() }))
}
