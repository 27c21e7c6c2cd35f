//! The map of a bat: the effect of a cut, band by band, the effect of a weight, and changes that cannot be linearised.
//!
//! A band's derivative is valid for fractions of a millimetre; beside it is a finite cut of the same band, computed in
//! full. Cups, holes, corks and knob weights are computed in full.

use crate::answers::Answer;
use crate::comparison::contender::Figure;
use crate::engine::{
    Bat, Bore, Change, Cork, Cup, DiameterChange, Edit, Error, Material, Peak, Request, Result,
    STANDARD_PIVOT, threads,
};
use crate::lathe::found::{
    AddedMass, Changes, Check, Curves, FiniteCut, LatheFound, Output, TurnedBand, WholeChange,
};
use crate::lathe::gauges::{Rivals, WhyNotSmooth};
use crate::lathe::samples::{by_added_mass, frequency_density};
use crate::lathe::workpiece::{Care, HitTerms, Method, Slopes, Workpiece};

/// The request for a map.
#[derive(Debug, Clone)]
pub struct LatheTerms {
    /// Bands (m from the knob end), rising.
    pub bands: Vec<[f64; 2]>,
    /// Depth of the finite cut, of the diameter (m).
    pub cut: f64,
    /// The exponent n of the batter's swing law: a changed bat is swung at `Ω (I₀/I)^n`.
    pub exponent: f64,
    /// The answers.
    pub answers: Vec<Answer>,
}

/// The effects of cuts and weights on a bat, and the bat.
pub struct LatheMap {
    /// The bat on the lathe.
    pub piece: Workpiece,
    /// The request.
    pub terms: LatheTerms,
    /// The results.
    pub found: LatheFound,
}

/// Changes of the answers, in their order, for swings by each of some laws.
type ByLaw = Vec<Vec<Option<f64>>>;

/// A band, turned down.
struct BandCut {
    ends: [f64; 2],
    /// Derivatives per metre of diameter taken off; None under a sleeve.
    slopes: Option<Slopes>,
    /// Changes per metre of diameter when the finite cut comes off, or why it cannot.
    finite: std::result::Result<ByLaw, String>,
}

/// Bands of that width (m) from the knob end to the tip; a remainder of less than half a band joins the last one.
pub fn bands(length: f64, width: f64) -> Vec<[f64; 2]> {
    let count = (length / width).round().max(1.0) as usize;
    let end = |k: usize| if k == count { length } else { k as f64 * width };
    (0..count).map(|k| [end(k), end(k + 1)]).collect()
}

/// Place of the fastest ball (m from the knob end), to some micrometres.
///
/// # Errors
///
/// As [`Workpiece::new`].
pub fn best_place(bat: &Bat, request: &Request, hit: &HitTerms) -> Result<Option<f64>> {
    let piece = Workpiece::new(bat, &[], request, Some(hit), &[Answer::ExitSpeedPlace])?;
    Ok(piece.values()[0].map(|place| place.value))
}

/// A finite cut and its derivative that differ by more than this share are examined.
const APART: f64 = 0.1;
/// Share of the difference that half of a cut leaves if the answer only curves: a half for second order, a quarter for
/// third.
const CURVED: std::ops::RangeInclusive<f64> = 0.15..=0.8;
/// Places of the curves along the bat.
const CURVE: usize = 240;
/// A millimetre (m).
const MM: f64 = 1e-3;
/// More pieces of a profile than this make a map take long.
const MANY: usize = 200;

impl LatheMap {
    /// The answers whose changes are told in a few lines.
    pub const ON_A_SCREEN: [Answer; 5] = [
        Answer::Mass,
        Answer::Inertia,
        Answer::Frequency(1),
        Answer::ExitSpeed,
        Answer::ExitSpeedPlace,
    ];

    /// A map with wide bands and few answers, to show where a cut has the largest effect; `None` for a bat with too
    /// many pieces.
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

    /// The band where a cut changes an answer most, for that swing law's exponent, and the change per millimetre of
    /// diameter taken off it.
    pub fn strongest(&self, answer: Answer, exponent: f64) -> Option<(&TurnedBand, f64)> {
        let bands = self.found.bands.iter();
        let all = bands.filter_map(|band| Some((band, band.derivative(answer, exponent)?)));
        all.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))
    }

    /// The map of a bat.
    ///
    /// ```
    /// use sweetspot::collision::{Model, Scene};
    /// use sweetspot_study::lathe::map::{LatheMap, LatheTerms, bands};
    /// use sweetspot_study::lathe::workpiece::HitTerms;
    /// use sweetspot_study::answers::Answer;
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
    /// for band in &map.found.bands {
    ///     let place = band.derivative(Answer::ExitSpeedPlace, 0.0).expect("there is a best place");
    ///     println!("{:.2} m: {:+.2} mm per mm", band.from_m, 1e3 * place);
    /// }
    /// // A millimetre off half of the way to the barrel moves the sweet spot outward.
    /// # let moved = |k: usize| map.found.bands[k].derivative(Answer::ExitSpeedPlace, 0.0).unwrap();
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
        let mut piece = Workpiece::new(bat, &borders, request, hit, &terms.answers)?;
        let found = Mapping { piece: &piece, terms: &terms }.found(bat)?;
        piece.rivals.clone_from(&found.not_smooth_at);
        Ok(Self { piece, terms, found })
    }
}

impl LatheTerms {
    /// The swing laws of finite changes: the same swing, the same energy, and the batter's own.
    pub fn exponents(&self) -> Vec<f64> {
        let own = Some(self.exponent).filter(|n| *n != 0.0 && *n != 0.5);
        [0.0, 0.5].into_iter().chain(own).collect()
    }
}

/// A map that is being made.
struct Mapping<'a> {
    piece: &'a Workpiece,
    terms: &'a LatheTerms,
}

impl Mapping<'_> {
    fn found(&self, bat: &Bat) -> Result<LatheFound> {
        let cuts = self.turned()?;
        let mut not_smooth_at = self.piece.rivals.clone();
        not_smooth_at.extend(self.cuts_that_jump(&cuts)?);
        let output = |(answer, value): (&Answer, &Option<Figure>)| Output {
            name: *answer,
            value: value.map(|value| value.value),
            error: value.map(|value| value.error).filter(|error| *error > 0.0),
            method: Method::of(*answer),
        };
        Ok(LatheFound {
            per: "mm of diameter taken off",
            swing_exponent: self.terms.exponent,
            outputs: self.terms.answers.iter().zip(self.piece.values()).map(output).collect(),
            bands: cuts.iter().map(|cut| self.band(cut)).collect(),
            curves: self.curves(),
            added_mass: self.added_mass(),
            done_to_the_end: self.done_to_the_end(bat),
            not_smooth_at,
            check: Check { formula_against_difference: self.checked(&cuts) },
            tolerance_met: self.piece.met,
        })
    }

    /// Values by the names of the answers; only those of hits if `of_hits`.
    fn named(&self, of_hits: bool, value: impl Fn(usize) -> Option<f64>) -> Changes {
        let all = self.terms.answers.iter().enumerate();
        let all = all.filter(|(_, answer)| !of_hits || answer.of_a_hit());
        all.map(|(k, answer)| (answer.name(), value(k))).collect()
    }

    /// A band with its changes per millimetre.
    fn band(&self, BandCut { ends, slopes, finite }: &BandCut) -> TurnedBand {
        let own = self.terms.exponents().get(2).copied();
        let by = |of_hits: bool, exponent: f64| {
            let found = slopes.as_ref()?.by_law(exponent);
            Some(self.named(of_hits, |k| found[k].map(|figure| figure.value * MM)))
        };
        let error = |slopes: &Slopes| {
            self.named(false, |k| slopes.same_swing[k].map(|figure| figure.error * MM))
        };
        let cut = |found: &ByLaw| {
            let by = |law: usize| self.named(law > 0, |k| found[law][k].map(|value| value * MM));
            let (cut_mm, by_law) = (self.terms.cut / MM, own.map(|_| by(2)));
            FiniteCut { cut_mm, change: by(0), same_energy: by(1), by_law }
        };
        let middle = 0.5 * (ends[0] + ends[1]);
        TurnedBand {
            from_m: ends[0],
            to_m: ends[1],
            diameter_m: 2.0 * self.piece.bat().profile().at(middle).outer,
            change: by(false, 0.0),
            change_same_energy: by(true, 0.5),
            change_by_law: own.and_then(|own| by(true, own)),
            error: slopes.as_ref().map(error),
            finite: finite.as_ref().ok().map(cut),
            reason: finite.as_ref().err().cloned(),
            inertia: slopes.as_ref().map(|slopes| slopes.inertia),
        }
    }

    /// Changes from the bat as it is.
    fn less(&self, found: &[Vec<Option<f64>>], per: f64) -> ByLaw {
        let change =
            |(now, was): (&Option<f64>, &Option<Figure>)| Some(((*now)? - (*was)?.value) / per);
        found
            .iter()
            .map(|now| now.iter().zip(self.piece.compared()).map(change).collect())
            .collect()
    }

    fn turned(&self) -> Result<Vec<BandCut>> {
        let bat = self.piece.bat();
        let sleeved: Vec<bool> =
            self.terms.bands.iter().map(|ends| bat.is_sleeved(*ends)).collect();
        let off = |ends: &[f64; 2]| DiameterChange::band(*ends, -1.0);
        let bare = self.terms.bands.iter().zip(&sleeved).filter(|(_, sleeved)| !**sleeved);
        let changes: Vec<DiameterChange> = bare.map(|(ends, _)| off(ends)).collect();
        let mut slopes = self.piece.slopes(&changes, Care::Checked)?.into_iter();
        let exponents = self.terms.exponents();
        let finite = threads::map(self.terms.bands.len(), |k| {
            if sleeved[k] {
                return Err("a sleeve is around it".to_owned());
            }
            let change = off(&self.terms.bands[k]).scaled(self.terms.cut);
            let found = self.piece.cut(&change, &exponents);
            found.map(|found| self.less(&found, self.terms.cut)).map_err(|error| reason(&error))
        });
        let cut = |(k, finite)| {
            let slopes = if sleeved[k] { None } else { slopes.next() };
            BandCut { ends: self.terms.bands[k], slopes, finite }
        };
        Ok(finite.into_iter().enumerate().map(cut).collect())
    }

    /// Searched answers and modal masses whose finite cut of a band contradicts the derivative. If both differ by more than [`APART`],
    /// half of the cut distinguishes a curve, for which half of the difference remains, from a jump.
    fn cuts_that_jump(&self, cuts: &[BandCut]) -> Result<Vec<Rivals>> {
        let answers = &self.terms.answers;
        let is_mass = |k: &usize| matches!(answers[*k], Answer::ModalMass(_));
        let of_band = |band: &BandCut| -> Result<Vec<Rivals>> {
            let (Some(slopes), Ok(finite)) = (&band.slopes, &band.finite) else {
                return Ok(vec![]);
            };
            let pair = |k: usize, change: Option<f64>| {
                let slope =
                    slopes.same_swing[k].filter(|_| answers[k].is_searched() || is_mass(&k))?;
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
            let peaks = self.piece.peaks(&change(self.terms.cut))?;
            let one = |k: usize| {
                // The largest deflection of a mode may be at either end.
                let value = self.piece.compared()[k]?.value;
                let ends = [0.0, self.piece.bat().length()].map(|x| Peak { x, value });
                let peaks = peaks[k].or(Some(ends).filter(|_| is_mass(&k)))?;
                Some(Rivals::of(answers[k], WhyNotSmooth::Cut, peaks))
            };
            Ok(far.into_iter().filter_map(one).collect())
        };
        let all = threads::map(cuts.len(), |k| of_band(&cuts[k]));
        let jumps = all.into_iter().collect::<Result<Vec<_>>>()?.concat();
        // Once is enough.
        let first = |k: &usize| jumps[..*k].iter().all(|known| known.answer != jumps[*k].answer);
        Ok((0..jumps.len()).filter(first).map(|k| jumps[k].clone()).collect())
    }

    /// How far formula and differences are apart.
    fn checked(&self, cuts: &[BandCut]) -> Option<f64> {
        let all = |k: usize| {
            let of = |band: &BandCut| {
                let slopes = band.slopes.as_ref()?;
                Some([slopes.same_swing[k]?.value, slopes.checked[k]?])
            };
            let pairs: Vec<[f64; 2]> = cuts.iter().filter_map(of).collect();
            let largest = pairs.iter().fold(0.0_f64, |most, [formula, _]| most.max(formula.abs()));
            let off = pairs.iter().fold(0.0_f64, |most, [a, b]| most.max((a - b).abs()));
            (largest > 0.0).then(|| off / largest)
        };
        (0..self.terms.answers.len()).filter_map(all).reduce(f64::max)
    }

    /// The effect of a mass in the middle of each band.
    fn added_mass(&self) -> AddedMass {
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
        let middle = |band: &[f64; 2]| 0.5 * (band[0] + band[1]);
        let x_m: Vec<f64> = self.terms.bands.iter().map(middle).collect();
        let per_g = |answer: &Answer| {
            let all = x_m.iter().map(|x| at(*x, answer).map(|per_kilogram| 1e-3 * per_kilogram));
            let all: Vec<Option<f64>> = all.collect();
            all.iter().any(Option::is_some).then(|| (answer.name(), all))
        };
        AddedMass { per_g: self.terms.answers.iter().filter_map(per_g).collect(), x_m }
    }

    /// Changes that a derivative cannot describe, computed in full.
    fn done_to_the_end(&self, bat: &Bat) -> Vec<WholeChange> {
        let exponents = self.terms.exponents();
        let all = usual_changes(bat.length());
        threads::map(all.len(), |k| {
            let (what, change) = &all[k];
            let edit = Edit { name: None, change: change.clone() };
            let found = bat.edited(&[edit]).and_then(|bat| self.piece.measure(&bat, &exponents));
            let found = found.map(|found| self.less(&found, 1.0));
            let by = |law: usize| {
                let found = found.as_ref().ok()?.get(law)?;
                Some(self.named(law > 0, |k| found[k]))
            };
            WholeChange {
                what,
                change: by(0),
                change_same_energy: by(1),
                change_by_law: by(2),
                reason: found.as_ref().err().map(reason),
            }
        })
    }

    /// Every frequency's change per millimetre of diameter taken off and millimetre of length, along the bat.
    fn curves(&self) -> Curves {
        let (bat, solution) = (self.piece.bat(), self.piece.solution());
        let at = |k: usize| bat.length() * k as f64 / CURVE as f64;
        let x_m: Vec<f64> = (0..=CURVE).map(at).collect();
        let frequency = |answer: &Answer| match answer {
            Answer::Frequency(order) => {
                let mode = solution.modes.get(order - 1)?;
                let density = |x: &f64| -0.5 * frequency_density(bat, solution, mode, *x) * MM * MM;
                Some((format!("{}_per_mm_mm", answer.name()), x_m.iter().map(density).collect()))
            }
            _ => None,
        };
        Curves { density: self.terms.answers.iter().filter_map(frequency).collect(), x_m }
    }
}

/// Why something cannot be done to the bat, without the name of the edit, which the program made.
fn reason(error: &Error) -> String {
    match error {
        Error::Value(complaint) => complaint.found.clone(),
        other => other.to_string(),
    }
}

/// The usual changes of a bat, as edits of one with that length (m).
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
