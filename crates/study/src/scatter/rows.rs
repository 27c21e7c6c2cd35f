//! Which bat and which hit is row k, and what are its results?
//!
//! [`ScatterRows::answers`] depends only on the differences, the bat, the seed and k: row k is point `k mod n` of
//! scramble `k / n`. The outputs are those of a study ([`crate::many::rows`]).

use std::ops::Range;

use crate::answers::Answer;
use crate::comparison::contender::Figure;
use crate::engine::{
    Bat, Error, FEW, HitsAlong, Hitter, Material, Request, Result, Setup, Trial as Hit, prepare,
    shown_length, sweep,
};
use crate::many::design::Design;
use crate::many::indices::VariateKind;
use crate::many::rows::{BatAnswers, BatTrial, Questions};
use crate::scatter::spreads::{Differences, Differs, SCRAMBLES, softened};

/// The exit speed at the varying impact point, as an output.
pub const AT_IMPACT: &str = "exit_speed_m_s@impact";

/// An output of every row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Output {
    /// An answer of a study.
    Of(Answer),
    /// The exit speed where the ball is hit.
    AtImpact,
}

impl Output {
    /// Its name.
    pub fn name(self) -> String {
        match self {
            Self::Of(answer) => answer.name(),
            Self::AtImpact => AT_IMPACT.to_owned(),
        }
    }

    /// Its unit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Of(answer) => answer.unit(),
            Self::AtImpact => "m/s",
        }
    }
}

/// The outputs of the rows, and their number.
#[derive(Debug, Clone)]
pub struct ScatterPlan {
    /// The differences.
    pub differences: Differences,
    /// How the bat is hit in the middle of all rows.
    pub setup: Setup,
    /// Mean impact point of all rows (m); `None` for the place of the fastest ball.
    pub impact: Option<f64>,
    /// The outputs.
    pub outputs: Vec<Output>,
    /// Accuracy, as of [`Questions`].
    pub tolerance: f64,
    /// Rows, a power of two.
    pub points: u64,
    /// Another seed draws other rows.
    pub seed: u64,
}

/// All rows.
pub struct ScatterRows {
    /// The plan.
    pub plan: ScatterPlan,
    /// The mean bat, with its density and stiffness settled.
    pub bat: Bat,
    /// Mean impact point (m).
    pub impact: f64,
    /// The mean bat of the rows, with all places of turning errors.
    middle: Bat,
    designs: Vec<Design>,
    /// The difference that each number belongs to.
    pub groups: Vec<usize>,
}

impl ScatterRows {
    /// The rows of a bat; the mean one is hit once as a check.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] for a difference that is impossible for the bat, and for errors of the mean bat.
    pub fn new(bat: &Bat, plan: ScatterPlan) -> Result<Self> {
        check(bat, &plan)?;
        let settled = settled(bat, plan.tolerance)?;
        let designs = plan.differences.designs(bat.length(), plan.points, plan.seed)?;
        let groups = plan.differences.groups(bat.length());
        let impact = plan.impact.unwrap_or(0.0);
        let middle = settled.clone();
        let mut rows = Self { plan, bat: settled, impact, middle, designs, groups };
        if rows.plan.impact.is_none() && rows.plan.outputs.contains(&Output::AtImpact) {
            rows.impact = fastest(&rows.bat, &rows.plan)?;
        }
        let none = vec![0.0; rows.groups.len()];
        rows.middle = rows.changed(&none)?;
        rows.of(&[none]).pop().transpose()?;
        Ok(rows)
    }

    /// Number of rows.
    pub fn count(&self) -> u64 {
        self.plan.points
    }

    /// The numbers of row k: factors' logarithms, factors less one, and amounts, one for each that is drawn.
    pub fn values(&self, k: u64) -> Vec<f64> {
        let (scramble, point) = self.place(k);
        self.designs[scramble].row(point).values
    }

    /// The independent numbers behind them, the kind of each, and the difference that it belongs to.
    pub fn numbers(&self, k: u64) -> Vec<f64> {
        let (scramble, point) = self.place(k);
        self.designs[scramble].numbers(point)
    }

    /// The kind of each of those numbers.
    pub fn kinds(&self) -> Vec<VariateKind> {
        self.designs[0].kinds()
    }

    fn place(&self, k: u64) -> (usize, u64) {
        let each = self.plan.points / SCRAMBLES;
        ((k / each) as usize, k % each)
    }

    /// The results of those rows, in the order of the outputs, or the reason why there are none. A row's results do not
    /// depend on which other rows are requested.
    pub fn answers(&self, rows: Range<u64>) -> Vec<Result<BatAnswers>> {
        self.of(&rows.map(|k| self.values(k)).collect::<Vec<_>>())
    }

    /// The bat of row k.
    ///
    /// # Errors
    ///
    /// The reason why there is none.
    pub fn bat_of(&self, k: u64) -> Result<Bat> {
        self.changed(&self.values(k))
    }

    /// The value of a difference in row k: a factor, or an amount; for turning the root mean square (m).
    pub fn told(&self, values: &[f64], k: usize) -> f64 {
        let (what, own) = (self.plan.differences.all[k].what, self.own(values, k));
        match what {
            Differs::Turned(turning) => {
                let count = 64;
                let at =
                    |i: i32| turning.error(self.bat.length() * (f64::from(i) + 0.5) / 64.0, &own);
                ((0..count).map(|i| at(i).powi(2)).sum::<f64>() / f64::from(count)).sqrt()
            }
            Differs::Cor | Differs::Impact | Differs::Moisture => own[0],
            Differs::SwingSpeed | Differs::Pitch => 1.0 + own[0],
            _ => own[0].exp(),
        }
    }

    /// The numbers of one difference.
    fn own(&self, values: &[f64], k: usize) -> Vec<f64> {
        let pairs = values.iter().zip(&self.groups);
        pairs.filter(|(_, group)| **group == k).map(|(value, _)| *value).collect()
    }

    fn of(&self, rows: &[Vec<f64>]) -> Vec<Result<BatAnswers>> {
        let asked: Vec<Questions> = rows.iter().map(|values| self.asked(values)).collect();
        let bats = asked.iter().zip(rows).map(|(asked, values)| (asked, self.changed(values)));
        Questions::of_each(&self.middle, bats.collect(), |k, bat| self.trial(&rows[k], bat))
    }

    fn asked(&self, values: &[f64]) -> Questions {
        let moved = self.impact + self.one(values, Differs::Impact);
        let place = moved.clamp(0.0, self.bat.length());
        let answer = |output: &Output| match output {
            Output::Of(answer) => *answer,
            Output::AtImpact => Answer::ExitSpeedAt(place),
        };
        let answers = self.plan.outputs.iter().map(answer).collect();
        Questions { answers, tolerance: self.plan.tolerance }
    }

    /// The number of a difference; 0 if it does not differ.
    fn one(&self, values: &[f64], what: Differs) -> f64 {
        let place = self.plan.differences.all.iter().position(|one| one.what == what);
        place.map_or(0.0, |k| self.own(values, k)[0])
    }

    fn trial(&self, values: &[f64], bat: &Bat) -> Result<BatTrial> {
        let impact = self.impact + self.one(values, Differs::Impact);
        if !(0.0..=bat.length()).contains(&impact) {
            let expected = format!("0 to {}", shown_length(bat.length()));
            return Err(Error::value("impact", "a place beyond the bat's end", expected));
        }
        let faster = 1.0 + self.one(values, Differs::SwingSpeed);
        let livelier = self.one(values, Differs::Cor);
        let mut setup = self.plan.setup.clone();
        setup.swing_speed *= faster;
        setup.bat_speed = setup.bat_speed.map(|speed| speed * faster);
        setup.pitch = (setup.pitch * (1.0 + self.one(values, Differs::Pitch))).max(0.0);
        let moved = |cor: f64| (cor + livelier).clamp(0.01, 0.99);
        if livelier != 0.0 {
            setup.cor = setup.cor.map(moved);
            setup.ball.cor = moved(setup.ball.cor);
            setup.ball.cor_by_speed.iter_mut().for_each(|[_, cor]| *cor = moved(*cor));
        }
        let (model, tolerance) = (setup.model()?, Some(self.plan.tolerance));
        Ok(BatTrial { scene: setup.scene(bat, tolerance)?.0, model })
    }

    /// The bat with these numbers.
    fn changed(&self, values: &[f64]) -> Result<Bat> {
        let mut profile = None;
        for (k, one) in self.plan.differences.all.iter().enumerate() {
            if let Differs::Turned(turning) = one.what {
                profile = Some(turning.turned(&self.bat, &self.own(values, k))?);
            }
        }
        let of = |what: Differs| self.one(values, what);
        let (moist, e) = (of(Differs::Moisture), of(Differs::YoungsModulus));
        let soft = softened(moist);
        let wet = (1.0 + moist).max(0.01);
        let ratio = of(Differs::ModulusRatio);
        // G follows E, or has its own factor.
        let by_itself =
            self.plan.differences.all.iter().any(|one| one.what == Differs::ShearModulus);
        let shear =
            if by_itself { of(Differs::ShearModulus) } else { e + of(Differs::ShearOverYoung) };
        let change = |material: &mut Material, stiffer: f64, heavier: f64| {
            material.name = None;
            material.density *= heavier.exp() * wet;
            material.youngs_modulus *= (e + stiffer).exp() * soft;
            material.shear_modulus =
                material.shear_modulus.map(|modulus| modulus * (shear + stiffer).exp() * soft);
        };
        let own = self.bat.material().clone();
        let barrel = [Differs::BarrelDensity, Differs::ModulusRatio];
        let parted = self.plan.differences.all.iter().any(|one| barrel.contains(&one.what));
        self.bat.with(|parts| {
            change(&mut parts.material, 0.0, of(Differs::Density));
            for region in &mut parts.fixtures.regions {
                let own = region.layup.outer == own;
                if parted {
                    change(&mut region.layup.outer, ratio, of(Differs::BarrelDensity));
                } else if own {
                    change(&mut region.layup.outer, 0.0, of(Differs::Density));
                }
            }
            if let Some(profile) = profile {
                parts.profile = profile;
            }
        })
    }
}

/// The bat with density and moduli from weighing and tapping, which are not applied again.
fn settled(bat: &Bat, tolerance: f64) -> Result<Bat> {
    let request = Request { tolerance, ..Request::default() };
    let bat = prepare(bat, &request)?.bat;
    let builder = Bat::builder(bat.profile().clone(), bat.material().clone());
    let builder = builder.name(bat.name()).source(bat.source()).inches(bat.inches());
    builder.fixtures(bat.fixtures().clone()).build()
}

/// Refuses differences that are impossible for the bat.
fn check(bat: &Bat, plan: &ScatterPlan) -> Result<()> {
    let all = &plan.differences.all;
    let has = |what: &dyn Fn(Differs) -> bool| all.iter().any(|one| what(one.what));
    if has(&|what| matches!(what, Differs::ShearOverYoung | Differs::ShearModulus))
        && !bat.knows_shear()
    {
        let found = format!("it, but {} has no shear modulus", bat.without_shear());
        return Err(Error::value("shear_over_young", found, "a bat whose shear modulus is known"));
    }
    if has(&|what| what == Differs::Moisture) && bat.material().scatter().is_none() {
        return Err(Error::value("moisture", "a material that is no wood", "a bat of wood"));
    }
    let parted = has(&|what| matches!(what, Differs::BarrelDensity | Differs::ModulusRatio));
    if parted && bat.fixtures().regions.len() != 1 {
        let found = "a covariance of two regions, for a bat that has not two";
        return Err(Error::value("covariance", found, "the bat that was calibrated with it"));
    }
    if has(&|what| what == Differs::Impact) && !plan.outputs.contains(&Output::AtImpact) {
        let expected = format!("\"{AT_IMPACT}\" among the outputs, which alone depends on it");
        return Err(Error::value("impact", "a place that nothing is asked of", expected));
    }
    if has(&|what| matches!(what, Differs::Turned(_))) && bat.profile().formulas.is_some() {
        let expected = "a bat whose profile has stations";
        return Err(Error::value("turning", "a profile of formulas", expected));
    }
    let beyond = plan.impact.filter(|x| !(0.0..=bat.length()).contains(x));
    let Some(x) = beyond else { return Ok(()) };
    let expected = format!("a place on the bat, 0 to {} m", bat.length());
    Err(Error::value("impact.at", format!("{x} m"), expected))
}

/// Place of the fastest ball (m).
fn fastest(bat: &Bat, plan: &ScatterPlan) -> Result<f64> {
    let (scene, _) = plan.setup.scene(bat, Some(plan.tolerance))?;
    let model = plan.setup.model()?;
    let request = Request { tolerance: plan.tolerance, ..Request::default() };
    let accuracy = Hit { model, scene: &scene }.accuracy(&request, false);
    let sweep = sweep(bat, model, &scene, &accuracy, &[0.8 * bat.length()])?;
    let hitter = Hitter::new(model, &scene, bat, &sweep.solution, sweep.effort)?;
    let looked = HitsAlong::outer(FEW, &hitter);
    looked.fastest().map(|peak| peak.x).ok_or_else(|| {
        Error::value(
            "impact.at",
            "no place at which a ball leaves fastest",
            "a place, such as \"27.7 in\"",
        )
    })
}

/// The value of an answer, if it is a finite number.
pub fn value(figure: &Option<Figure>) -> Option<f64> {
    figure.map(|figure| figure.value).filter(|value| value.is_finite())
}
