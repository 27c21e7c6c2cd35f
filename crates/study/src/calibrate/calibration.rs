//! What is this wood, and how much of that do the readings say?
//!
//! [`Calibration::new`] from a bat and what was measured of it.

pub use crate::calibrate::estimated::{Estimated, Property, Verdict};
use crate::calibrate::fit::{Fit, Residual, Search};
use crate::calibrate::labels::{
    LabelChoice, Labelled, Labels, MOST_MODES, best, contradict, strangers,
};
use crate::calibrate::next::{BEYOND, Proposal, proposals};
use crate::calibrate::posterior::Posterior;
use crate::calibrate::readings::{BatReadings, Priors, Reading};
use crate::calibrate::unknowns::{Logs, UNKNOWNS, Unknown, form};
use crate::calibrate::wood::WoodenBat;
use sweetspot::base::error::{Error, Result};
use sweetspot::bat::body::Bat;

/// Left out by more standard deviations than this, a datum does not fit the others.
pub const OUTLIER: f64 = 3.0;
/// What was learned of a parameter that is determined, and of one that is not: `1 − σ²/σ₀²`.
const DETERMINED: f64 = 0.9;
const UNDETERMINED: f64 = 0.1;
/// Two parameters that go together so much are known only together, unless both are known to a twentieth.
const TOGETHER: f64 = 0.95;
const WELL_KNOWN: f64 = 0.05;
/// 95 of 100 of a normal distribution lie within this many standard deviations.
pub const NINETY_FIVE: f64 = 1.959_963_984_540_054;
/// 95 of 100 of any distribution lie between these shares of it.
const ENDS: [f64; 2] = [0.025, 0.975];
/// Labels that cost less than this more than the best ones may be the right ones: of tones of random wood a
/// labelling that is ahead by 8 is right in 97 of 100 cases with two tones and in all with more.
const SURE: f64 = 8.0;
/// Other labels explain what was measured if they cost that much less than those that were told.
const EXPLAINS: f64 = 24.0;
/// How a calibration is made.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct CalibrationPlan {
    /// Where the barrel's region begins (m), if there are two.
    pub split: Option<f64>,
    /// Unknowns that stay as the file has them.
    pub held: Vec<Unknown>,
}

/// What the labels of the lines come to.
#[derive(Debug, Clone, PartialEq)]
pub struct Identified {
    /// Labels that were told, with the χ² they come to; None where none were told or all are kept.
    pub told: Option<(Labels, f64)>,
    /// Labels that were taken.
    pub labels: Labels,
    /// Measured modes whose shapes are like no bending mode.
    pub unlike: usize,
    /// χ² of the labels that were taken, strangers included.
    pub chi2: f64,
    /// The best labels that contradict these and their χ², if others were looked at.
    pub second: Option<(Labels, f64)>,
    /// By how much the second best labels cost more in the search, over all wood: below 8 they may be the right ones.
    pub margin: Option<f64>,
}

impl Identified {
    /// Whether no other labels come near those that were taken.
    pub fn is_sure(&self) -> bool {
        self.margin.is_none_or(|margin| margin >= SURE)
    }

    /// Whether half of several lines or more are no bending mode, by their frequencies or their shapes.
    pub fn is_mostly_discarded(&self) -> bool {
        let all = self.labels.len() + self.unlike;
        all > 1 && 2 * (strangers(&self.labels) + self.unlike) >= all
    }

    /// Lines whose label was told and is another, by their places.
    pub fn changed(&self) -> Vec<usize> {
        let told = self.told.iter().flat_map(|(told, _)| told.iter().zip(&self.labels).enumerate());
        told.filter(|(_, (told, taken))| told.is_some() && told != taken).map(|(k, _)| k).collect()
    }
}

/// What is known of a bat's wood.
#[derive(Debug, Clone)]
pub struct Calibration {
    /// The parameters.
    pub parameters: Vec<Estimated>,
    /// Covariance of their logarithms, in their order.
    pub covariance: Vec<Vec<f64>>,
    /// The fit.
    pub fit: Fit,
    /// Which mode each line was taken for.
    pub identified: Identified,
    /// Data that do not fit the others, by their places in [`Fit::residuals`].
    pub outliers: Vec<usize>,
    /// The parameters without those, and χ² with the number of data that remain.
    pub without: Option<(Vec<Estimated>, f64, usize)>,
    /// Which measurements are missing, and what each would do to the parameters' standard deviations.
    pub proposals: Vec<Proposal>,
    /// Whether G is of its kind, as the file has none.
    pub typical_shear: bool,
    /// The name of the file's material, if it has one.
    pub material: Option<String>,
    /// The bat of the wood that was found.
    pub bat: Bat,
    /// What was measured.
    pub readings: BatReadings,
}

impl Calibration {
    /// The wood of a bat that was measured so.
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
    /// println!("E = {:.3e} Pa within {:?}", modulus.value, modulus.interval);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::Value`] where nothing was measured, where readings are none of this bat, and those of
    /// [`WoodenBat::new`] and of a solve.
    pub fn new(bat: &Bat, readings: BatReadings, plan: &CalibrationPlan) -> Result<Self> {
        let pivot =
            readings.pendulum.map_or(sweetspot::bat::body::STANDARD_PIVOT, |swing| swing.pivot);
        check(bat, &readings, pivot)?;
        let wood = WoodenBat::new(bat, plan.split, pivot)?;
        let mut search =
            Search { wood: &wood, readings: &readings, held: &plan.held, about: [0.0; UNKNOWNS] };
        if search.free().is_empty() {
            return Err(Error::value("--hold", "everything", "something that is not held"));
        }
        let (taken, identified) = labelled(&search)?;
        let mut fit = taken.fit;
        if let Some(about) = another_wood(&search, &fit)? {
            search.about = about;
            let data: Vec<_> = fit.residuals.iter().map(|residual| residual.datum).collect();
            fit = search.fit(&data, fit.shown.frequencies.len(), &about)?;
        }
        let (parameters, open) = estimated(&search, &fit)?;
        let properties = Property::of(wood.regions());
        let parts: Vec<Vec<f64>> =
            properties.iter().map(|property| property.parts(fit.covariance.len())).collect();
        let outliers: Vec<usize> = (0..fit.residuals.len())
            .filter(|k| fit.residuals[*k].left_out.abs() > OUTLIER)
            .collect();
        let without = without(&search, &fit, &outliers)?;
        let covariance = |a: &Vec<f64>| parts.iter().map(|b| form(&open, a, b)).collect();
        Ok(Self {
            parameters,
            covariance: parts.iter().map(covariance).collect(),
            proposals: proposals(&search, &fit, &parts),
            identified,
            outliers,
            without,
            typical_shear: wood.typical_shear,
            material: bat.material().name.clone(),
            bat: wood.of(&fit.logs)?,
            fit,
            readings,
        })
    }

    /// How many data there are.
    pub fn data(&self) -> usize {
        self.fit.residuals.len()
    }

    /// Whether the data fit the bat: none is an outlier, the fit has settled, χ² of the data is not far above their
    /// number, no label that was told is another, no other labels come near, and most of the lines are bending modes.
    pub fn fits(&self) -> bool {
        let labels = &self.identified;
        self.outliers.is_empty()
            && is_near(&self.fit)
            && labels.changed().is_empty()
            && labels.is_sure()
            && !labels.is_mostly_discarded()
            && !self.parameters.iter().any(Estimated::is_foreign_density)
    }

    /// Whether the readings fit the wood that was found, whatever the labels.
    pub fn readings_agree(&self) -> bool {
        self.outliers.is_empty() && is_near(&self.fit)
    }

    /// How many times larger all errors would have to be for χ² to be the number of data (Birge's ratio).
    pub fn birge(&self) -> f64 {
        (self.fit.chi2 / self.data() as f64).sqrt()
    }

    /// The loss factor of the wood, the mean of all tones that were heard dying out; None without one.
    pub fn loss_factor(&self) -> Option<f64> {
        let all = &self.readings.ring_down;
        let sum: f64 = all.iter().map(|tone| tone.loss_factor()).sum();
        (!all.is_empty()).then(|| sum / all.len() as f64)
    }

    /// The parameter that the readings say least of, of those that were sought, and the measurement that would do most
    /// for it.
    pub fn advice(&self) -> Option<(&Estimated, &Proposal, f64)> {
        let sought = self.parameters.iter().enumerate();
        let sought = sought.filter(|(_, parameter)| parameter.verdict != Verdict::Held);
        let (k, least) = sought.min_by(|a, b| a.1.learned.total_cmp(&b.1.learned))?;
        let best = self.proposals.iter().min_by(|a, b| a.factors[k].total_cmp(&b.factors[k]))?;
        Some((least, best, best.factors[k]))
    }
}

impl Residual {
    /// Whether it does not fit the others.
    pub fn is_outlier(&self) -> bool {
        self.left_out.abs() > OUTLIER
    }
}

/// χ² of the given number of data that is not taken for chance: four standard deviations above their number.
fn far(data: usize) -> f64 {
    data as f64 + 4.0 * (2.0 * data as f64).sqrt()
}

/// Refuses what cannot have been measured of this bat.
fn check(bat: &Bat, readings: &BatReadings, pivot: f64) -> Result<()> {
    let rigid = [readings.mass.is_some(), readings.balance_point.is_some()];
    if rigid == [false; 2] && readings.pendulum.is_none() && readings.lines.is_empty() {
        let expected = "\"mass\", \"balance_point\", \"pendulum\" or \"lines\"";
        return Err(Error::value("readings", "nothing that was measured", expected));
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
    fit.settled && fit.misfit() <= far(fit.residuals.len())
}

/// The wood that what was known before is taken to be about, where the file's is another one: of E and density whatever
/// the readings say, of all else the file's. None where the wood that was found may be one of the file's kind.
fn another_wood(search: &Search, fit: &Fit) -> Result<Option<Logs>> {
    /// χ² of what was known before that one wood in a hundred of the file's kind has.
    const RARE: f64 = 10.0;
    /// A wood of which nothing was known.
    const ANY: f64 = 1e3;
    if fit.chi2 - fit.misfit() < RARE || !fit.settled {
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

/// The labels that are taken, and what others come to: those that were told where they fit; else, and where lines
/// have none, those that fit best over all wood.
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
        // Other labels are taken only where they explain what was measured, and nearly all of it.
        (None, Some(_)) => taken(search, other, None),
        (Some(as_told), Some(found)) if fits(found) && found.chi2 + EXPLAINS < as_told.chi2 => {
            let as_told = (told, as_told.chi2);
            taken(search, other, Some(as_told))
        }
        _ => taken(search, kept, None),
    }
}

/// The first of these labellings, and the next that contradicts it.
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
    let identified = Identified {
        told,
        labels: best.labels.clone(),
        unlike: search.readings.unlike,
        chi2: best.chi2,
        margin: second.as_ref().map(|second| second.price - best.price),
        second: second.map(|second| (second.labels, second.chi2)),
    };
    Ok((best, identified))
}

/// The parameters and what is known of them; the covariance of all unknowns, in which those that were held have what
/// was known before.
fn estimated(search: &Search, fit: &Fit) -> Result<(Vec<Estimated>, Vec<Vec<f64>>)> {
    let properties = Property::of(search.wood.regions());
    let unknowns = fit.covariance.len();
    let data: Vec<_> = fit.residuals.iter().map(|residual| residual.datum).collect();
    let posterior = Posterior::of(search, &data, fit)?;
    let (before, left) = (search.prior(), posterior.covariance());
    let free = search.free();
    // What a held property has of its own: nothing was learned of it.
    let own_of = |property: Property| match free.contains(&property.own()) {
        true => 0.0,
        false => {
            let (own, parts) = (property.own(), property.parts(unknowns));
            before[own][own].min(form(&before, &parts, &parts))
        }
    };
    let mut open = left.clone();
    properties.iter().for_each(|one| open[one.own()][one.own()] += own_of(*one));
    let start = search.wood.materials(&[0.0; UNKNOWNS]);
    let value = |property: Property| {
        let centre = match property {
            Property::YoungsModulus => start[0].youngs_modulus,
            Property::ShearModulus => start[0].shear_modulus.unwrap_or(0.0),
            Property::Density | Property::BarrelDensity => start[0].density,
            Property::ModulusRatio => 1.0,
        };
        let parts = property.parts(unknowns);
        let log: f64 = parts.iter().zip(&fit.logs).map(|(part, log)| part * log).sum();
        (centre, centre * log.exp())
    };
    let of = |property: Property| {
        let parts = property.parts(unknowns);
        let (centre, value) = value(property);
        let own = property.own();
        let is_free = free.contains(&own);
        let variance = form(&open, &parts, &parts).min(form(&before, &parts, &parts));
        let prior = Reading { value: centre, deviation: form(&before, &parts, &parts).sqrt() };
        let learned = |parts: &[f64]| 1.0 - form(&left, parts, parts) / form(&before, parts, parts);
        let interval =
            ENDS.map(|share| centre * posterior.quantile(&parts, own_of(property), share).exp());
        let mut single = vec![0.0; unknowns];
        single[own] = 1.0;
        let learned = if is_free { learned(&single).min(learned(&parts)) } else { 0.0 };
        let others = properties.iter().filter(|other| **other != property);
        let correlation = |other: &Property| {
            let theirs = other.parts(unknowns);
            let sizes = form(&open, &theirs, &theirs) * form(&open, &parts, &parts);
            let r = form(&open, &parts, &theirs) / sizes.sqrt();
            (sizes > 0.0).then_some((*other, r))
        };
        let correlated =
            others.filter_map(correlation).max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
        let together = correlated.is_some_and(|(_, r)| r.abs() > TOGETHER);
        let verdict = match learned {
            _ if !is_free => Verdict::Held,
            learned if learned <= UNDETERMINED => Verdict::NotDetermined,
            _ if together && variance.sqrt() > WELL_KNOWN => Verdict::OnlyTogether,
            learned if learned > DETERMINED => Verdict::Determined,
            _ => Verdict::Partly,
        };
        Estimated {
            property,
            value,
            deviation: variance.sqrt(),
            interval,
            prior,
            learned,
            correlated,
            verdict,
        }
    };
    let all = properties.iter().map(|property| of(*property)).collect();
    Ok((all, open))
}

/// The fit without what does not fit, if anything does not and two data are left.
fn without(
    search: &Search,
    fit: &Fit,
    outliers: &[usize],
) -> Result<Option<(Vec<Estimated>, f64, usize)>> {
    let kept = fit.residuals.iter().enumerate().filter(|(k, _)| !outliers.contains(k));
    let kept: Vec<_> = kept.map(|(_, residual)| residual.datum).collect();
    if outliers.is_empty() || kept.len() < 2 {
        return Ok(None);
    }
    let again = search.fit(&kept, fit.shown.frequencies.len(), &[0.0; UNKNOWNS])?;
    Ok(Some((estimated(search, &again)?.0, again.chi2, kept.len())))
}
