//! The map of a bat: what a cut does, band by band, what a weight does, and what cannot be linearised.
//!
//! A band's derivative is for fractions of a millimetre; a finite cut of the same band, solved whole, stands beside
//! it. Cups, holes, corks and knob weights are solved.

use crate::comparison::contender::Figure;
use crate::lathe::gauges::{Rivals, WhyNotSmooth};
use crate::lathe::samples::{by_added_mass, frequency_density};
use crate::lathe::workpiece::{Care, HitTerms, Slopes, Workpiece};
use crate::many::answers::Answer;
use sweetspot::base::error::{Error, Result};
use sweetspot::base::threads;
use sweetspot::bat::body::{Bat, STANDARD_PIVOT};
use sweetspot::bat::edit::{Bore, Change, Cork, Cup, Edit};
use sweetspot::bat::material::Material;
use sweetspot::bat::turned::DiameterChange;
use sweetspot::modes::solve::Request;

/// What is asked of a map.
#[derive(Debug, Clone)]
pub struct LatheTerms {
    /// Bands (m from the knob end), rising.
    pub bands: Vec<[f64; 2]>,
    /// Depth of the finite cut, of the diameter (m).
    pub cut: f64,
    /// The exponent n of the batter's swing law: another bat is swung at `Ω (I₀/I)^n`.
    pub exponent: f64,
    /// What is looked at.
    pub answers: Vec<Answer>,
}

/// A stretch of the bat and what happens if it is turned down.
#[derive(Debug, Clone)]
pub struct TurnedBand {
    /// From where to where (m from the knob end).
    pub ends: [f64; 2],
    /// Diameter in the middle (m).
    pub diameter: f64,
    /// Derivatives per metre of diameter taken off; None under a sleeve.
    pub slopes: Option<Slopes>,
    /// Changes per metre of diameter when the finite cut comes off, for swings by each of [`LatheMap::exponents`];
    /// None where it cannot come off.
    pub finite: Option<Vec<Vec<Option<f64>>>>,
    /// Why something of it is missing.
    pub reason: Option<String>,
}

/// What a mass at a place does, per kg.
#[derive(Debug, Clone)]
pub struct AddedWeight {
    /// Where the mass is (m from the knob end).
    pub x: f64,
    /// Change of each answer per kg; None for those that are not of frequencies or the rigid body.
    pub per_kilogram: Vec<Option<f64>>,
}

/// A change that is done to the end.
#[derive(Debug, Clone)]
pub struct WholeChange {
    /// What is done.
    pub what: &'static str,
    /// Changes of the answers for swings by each of [`LatheMap::exponents`], or why it cannot be done.
    pub change: std::result::Result<Vec<Vec<Option<f64>>>, String>,
}

/// What cuts and weights do to a bat.
pub struct LatheMap {
    /// The bat on the lathe.
    pub piece: Workpiece,
    /// What was asked.
    pub terms: LatheTerms,
    /// The bands.
    pub bands: Vec<TurnedBand>,
    /// Weights along the bat.
    pub weights: Vec<AddedWeight>,
    /// Knob weight, cup, hole and cork.
    pub wholes: Vec<WholeChange>,
    /// The largest difference between formula and differences of whole bats, relative to the largest change
    /// of that frequency; None where no frequency was looked at by both.
    pub check: Option<f64>,
}

/// Bands of that width (m) from the knob end to the tip; less than half a band that is left over is with the last.
pub fn bands(length: f64, width: f64) -> Vec<[f64; 2]> {
    let count = (length / width).round().max(1.0) as usize;
    let end = |k: usize| if k == count { length } else { k as f64 * width };
    (0..count).map(|k| [end(k), end(k + 1)]).collect()
}

/// Where the ball leaves the bat fastest (m from the knob end), found to some micrometres.
///
/// # Errors
///
/// As [`Workpiece::new`].
pub fn best_place(bat: &Bat, request: &Request, hit: &HitTerms) -> Result<Option<f64>> {
    let piece = Workpiece::new(bat, &[], request, Some(hit), &[Answer::ExitSpeedPlace])?;
    Ok(piece.values()[0].map(|place| place.value))
}

/// A finite cut and its derivative that are apart by more than this share are looked at.
const APART: f64 = 0.1;
/// What half of a cut leaves of that distance where the answer only curves: a half by the second order, a quarter by
/// the third.
const CURVED: std::ops::RangeInclusive<f64> = 0.15..=0.8;
/// More pieces of a profile than this make a map take long.
const MANY: usize = 200;

impl LatheMap {
    /// A map of wide bands and few answers, for who only wants to know where a cut does most; None for a bat
    /// of so many pieces that it would take long.
    ///
    /// # Errors
    ///
    /// As [`Self::new`].
    pub fn in_short(bat: &Bat, request: &Request, hit: &HitTerms) -> Result<Option<Self>> {
        /// 2 in (m).
        const WIDE: f64 = 0.0508;
        if bat.profile().pieces.len() > MANY {
            return Ok(None);
        }
        let answers =
            vec![Answer::Inertia, Answer::Frequency(1), Answer::ExitSpeed, Answer::ExitSpeedPlace];
        let bands = bands(bat.length(), WIDE.min(bat.length()));
        let terms = LatheTerms { bands, cut: 5e-4, exponent: 0.0, answers };
        Self::new(bat, request, Some(hit), terms).map(Some)
    }

    /// The band where a cut changes an answer most, by that swing law's exponent, and the change per metre of
    /// diameter that is taken off it.
    pub fn strongest(&self, answer: Answer, exponent: f64) -> Option<(&TurnedBand, f64)> {
        let k = self.terms.answers.iter().position(|known| *known == answer)?;
        let all = self.bands.iter().filter_map(|band| {
            let slopes = band.slopes.as_ref()?;
            Some((band, slopes.by_law(exponent)[k]?.value))
        });
        all.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))
    }

    /// The map of a bat.
    ///
    /// ```
    /// use sweetspot::collision::{Model, Scene};
    /// use sweetspot_study::lathe::map::{LatheMap, LatheTerms, bands};
    /// use sweetspot_study::lathe::workpiece::HitTerms;
    /// use sweetspot_study::many::answers::Answer;
    /// use sweetspot::{Bat, Request, Theory};
    ///
    /// # fn main() -> sweetspot::Result<()> {
    /// let bat = Bat::builtin("r161")?;
    /// let request = Request { theory: Theory::Timoshenko, tolerance: 1e-3, ..Request::default() };
    /// let hit = HitTerms { scene: Scene::default(), model: Model::Contact, exactly: false };
    /// let answers = vec![Answer::Mass, Answer::Frequency(1), Answer::ExitSpeedPlace];
    /// let bands = bands(bat.length(), 0.14);
    /// let terms = LatheTerms { bands, cut: 5e-4, exponent: 0.0, answers };
    /// let map = LatheMap::new(&bat, &request, Some(&hit), terms)?;
    /// for band in &map.bands {
    ///     let slopes = band.slopes.as_ref().expect("there is no sleeve");
    ///     let place = slopes.same_swing[2].expect("there is a best place");
    ///     println!("{:.2} m: {:+.2} mm per mm", band.ends[0], place.value);
    /// }
    /// // A millimetre off half of the way to the barrel moves the sweet spot outward.
    /// # let moved = |k: usize| map.bands[k].slopes.as_ref().unwrap().same_swing[2].unwrap().value;
    /// assert!(moved(4) > 0.0 && moved(5) < 0.0);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    ///
    /// As [`Workpiece::new`].
    pub fn new(
        bat: &Bat,
        request: &Request,
        hit: Option<&HitTerms>,
        terms: LatheTerms,
    ) -> Result<Self> {
        let borders: Vec<f64> = terms.bands.iter().flatten().copied().collect();
        let piece = Workpiece::new(bat, &borders, request, hit, &terms.answers)?;
        let mut map =
            Self { piece, terms, bands: vec![], weights: vec![], wholes: vec![], check: None };
        map.bands = map.turned()?;
        let cuts = map.cuts_that_jump()?;
        map.piece.rivals.extend(cuts);
        map.check = map.checked();
        map.weights = map.weighted();
        map.wholes = map.done_to_the_end(bat);
        Ok(map)
    }

    /// The swing laws of finite changes: the same swing, the same energy, and the batter's own.
    pub fn exponents(&self) -> Vec<f64> {
        let own = Some(self.terms.exponent).filter(|n| *n != 0.0 && *n != 0.5);
        [0.0, 0.5].into_iter().chain(own).collect()
    }

    /// Changes from the bat as it is.
    fn less(&self, found: &[Vec<Option<f64>>], per: f64) -> Vec<Vec<Option<f64>>> {
        let change =
            |(now, was): (&Option<f64>, &Option<Figure>)| Some(((*now)? - (*was)?.value) / per);
        found.iter().map(|now| now.iter().zip(self.piece.values()).map(change).collect()).collect()
    }

    fn turned(&self) -> Result<Vec<TurnedBand>> {
        let bat = self.piece.bat();
        let sleeved: Vec<bool> =
            self.terms.bands.iter().map(|ends| bat.is_sleeved(*ends)).collect();
        let off = |ends: &[f64; 2]| DiameterChange::band(*ends, -1.0);
        let bare = self.terms.bands.iter().zip(&sleeved).filter(|(_, sleeved)| !**sleeved);
        let changes: Vec<DiameterChange> = bare.map(|(ends, _)| off(ends)).collect();
        let mut slopes = self.piece.slopes(&changes, Care::TwoSteps)?.into_iter();
        let exponents = self.exponents();
        let finite = threads::map(self.terms.bands.len(), |k| {
            if sleeved[k] {
                return Err("a sleeve is around it".to_owned());
            }
            let change = off(&self.terms.bands[k]).scaled(self.terms.cut);
            let found = self.piece.cut(&change, &exponents);
            found.map(|found| self.less(&found, self.terms.cut)).map_err(|error| reason(&error))
        });
        let band = |(k, finite): (usize, std::result::Result<_, String>)| {
            let ends = self.terms.bands[k];
            TurnedBand {
                ends,
                diameter: 2.0 * bat.profile().at(0.5 * (ends[0] + ends[1])).outer,
                slopes: if sleeved[k] { None } else { slopes.next() },
                reason: finite.as_ref().err().cloned(),
                finite: finite.ok(),
            }
        };
        Ok(finite.into_iter().enumerate().map(band).collect())
    }

    /// Searched answers whose finite cut of a band does not go where the derivative points: where both are apart by
    /// more than [`APART`], half of the cut tells a curve, by which half of the distance is left, from a jump.
    fn cuts_that_jump(&self) -> Result<Vec<Rivals>> {
        let answers = &self.terms.answers;
        let of_band = |band: &TurnedBand| -> Result<Vec<Rivals>> {
            let (Some(slopes), Some(finite)) = (&band.slopes, &band.finite) else {
                return Ok(vec![]);
            };
            let pair = |k: usize, change: Option<f64>| {
                let slope = slopes.same_swing[k].filter(|_| answers[k].is_searched())?;
                let apart = (change? - slope.value).abs() - slope.error;
                Some((apart, slope.value.abs().max(change?.abs())))
            };
            let far = |k: &usize| {
                pair(*k, finite[0][*k]).is_some_and(|(apart, most)| apart > APART * most)
            };
            let far: Vec<usize> = (0..answers.len()).filter(far).collect();
            if far.is_empty() {
                return Ok(vec![]);
            }
            let change = |depth: f64| DiameterChange::band(band.ends, -1.0).scaled(depth);
            let half = 0.5 * self.terms.cut;
            let found = self.less(&self.piece.cut(&change(half), &[0.0])?, half).remove(0);
            let jumps = |k: &usize| {
                let [whole, half] = [finite[0][*k], found[*k]].map(|change| pair(*k, change));
                let share = whole.zip(half).map(|((whole, _), (half, _))| half / whole);
                share.is_some_and(|share| !CURVED.contains(&share))
            };
            let far: Vec<usize> = far.into_iter().filter(jumps).collect();
            if far.is_empty() {
                return Ok(vec![]);
            }
            let (was, is) =
                (self.piece.peaks(None)?, self.piece.peaks(Some(&change(self.terms.cut)))?);
            let one = |k: usize| {
                let peaks = [was[k]?, is[k]?];
                Some(Rivals { answer: answers[k], peaks, why: WhyNotSmooth::Cut })
            };
            Ok(far.into_iter().filter_map(one).collect())
        };
        let all = threads::map(self.bands.len(), |k| of_band(&self.bands[k]));
        let mut told: Vec<Rivals> = vec![];
        for jump in all.into_iter().collect::<Result<Vec<_>>>()?.into_iter().flatten() {
            // Once is enough.
            if told.iter().all(|known| known.answer != jump.answer) {
                told.push(jump);
            }
        }
        Ok(told)
    }

    /// How far formula and differences are apart.
    fn checked(&self) -> Option<f64> {
        let all = |k: usize| {
            let of = |band: &TurnedBand| {
                let slopes = band.slopes.as_ref()?;
                Some([slopes.same_swing[k]?.value, slopes.checked[k]?])
            };
            let pairs: Vec<[f64; 2]> = self.bands.iter().filter_map(of).collect();
            let largest = pairs.iter().fold(0.0_f64, |most, [formula, _]| most.max(formula.abs()));
            let off = pairs.iter().fold(0.0_f64, |most, [a, b]| most.max((a - b).abs()));
            (largest > 0.0).then(|| off / largest)
        };
        (0..self.terms.answers.len()).filter_map(all).reduce(f64::max)
    }

    /// What a mass does in the middle of each band.
    fn weighted(&self) -> Vec<AddedWeight> {
        let body = self.piece.bat().inertia();
        let arm = body.balance_point - STANDARD_PIVOT;
        let at = |x: f64, answer: &Answer| match answer {
            Answer::Mass => Some(1.0),
            Answer::BalancePoint => Some((x - body.balance_point) / body.mass),
            Answer::Inertia => Some((x - STANDARD_PIVOT).powi(2)),
            Answer::CenterOfPercussion => {
                let (inertia, moment) = (body.about(STANDARD_PIVOT), body.mass * arm);
                let by = x - STANDARD_PIVOT;
                let slope = by * by / moment - inertia * by / (moment * moment);
                slope.is_finite().then_some(slope)
            }
            Answer::Frequency(order) => {
                let mode = self.piece.solution().modes.get(order - 1)?;
                Some(by_added_mass(mode, x, 0.0)[0])
            }
            _ => None,
        };
        let weight = |band: &[f64; 2]| {
            let x = 0.5 * (band[0] + band[1]);
            let per_kilogram = self.terms.answers.iter().map(|answer| at(x, answer)).collect();
            AddedWeight { x, per_kilogram }
        };
        self.terms.bands.iter().map(weight).collect()
    }

    /// What cannot be told from a derivative, solved.
    fn done_to_the_end(&self, bat: &Bat) -> Vec<WholeChange> {
        let exponents = self.exponents();
        let all = usual_changes(bat.length());
        threads::map(all.len(), |k| {
            let (what, change) = &all[k];
            let edit = Edit { name: None, change: change.clone() };
            let found = bat.edited(&[edit]).and_then(|bat| self.piece.measure(&bat, &exponents));
            let change = found.map(|found| self.less(&found, 1.0)).map_err(|error| reason(&error));
            WholeChange { what, change }
        })
    }

    /// A frequency's change per metre of diameter taken off and metre of length, at these places (m).
    pub fn curve(&self, order: usize, places: &[f64]) -> Option<Vec<f64>> {
        let solution = self.piece.solution();
        let mode = solution.modes.get(order - 1)?;
        let bat = self.piece.bat();
        Some(places.iter().map(|x| -0.5 * frequency_density(bat, solution, mode, *x)).collect())
    }
}

/// Why something cannot be done to the bat, without the name of an edit that nobody typed.
fn reason(error: &Error) -> String {
    match error {
        Error::Value(complaint) => complaint.found.clone(),
        other => other.to_string(),
    }
}

/// What is usually done to a bat, as edits of one of that length (m).
fn usual_changes(length: f64) -> [(&'static str, Change); 4] {
    const INCH: f64 = 0.0254;
    const OUNCE: f64 = 0.028_349_523_125;
    let mut cork = Material::new(200.0, 2e7).expect("these are a material's numbers");
    cork.shear_modulus = Some(8e6);
    let hole = |deep: f64| (length - deep * INCH, length, INCH);
    let (from, to, diameter) = hole(6.0);
    [
        ("knob weight 1 oz", Change::Knob(OUNCE)),
        ("cup 1 in deep, 1.5 in wide", Change::Cup(Cup { depth: INCH, diameter: 1.5 * INCH })),
        ("hole 1 in wide, 6 in deep from the tip", Change::Bore(Bore { from, to, diameter })),
        (
            "the same hole filled with cork (200 kg/m³)",
            Change::Cork(Cork { from, to, diameter, material: cork }),
        ),
    ]
}
