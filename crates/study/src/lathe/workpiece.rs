//! The bat on the lathe: its answers, and their derivatives by its diameter.
//!
//! A [`Workpiece`] is a bat whose elements end at the possible ends of changes of its diameter. [`Workpiece::slopes`]
//! gives the derivative of every answer by each of a list of [`DiameterChange`]s: frequencies and the rigid body by
//! closed formula ([`crate::lathe::samples`]), all else by central differences of whole bats with fixed elements,
//! number of modes and steps. [`Workpiece::measure`] gives the answers of a bat that is changed by more.

use crate::answers::{ALONG, Answer, figure, on_the_bat, quotient, with_modes};
use crate::comparison::contender::Figure;
use crate::engine::{
    Bat, DiameterChange, Hitter, Model, Peak, Request, Result, STANDARD_PIVOT, Scene, Solution,
    Trial, sweep, threads,
};
use crate::lathe::gauges::{BestPlaces, Gauge, GaugeHits, OuterHalf, Rivals};
use crate::lathe::look::{By, LathePass, PlannedHit};
use crate::lathe::quotient::{ByWay, Differences, Quotient, Usual, WAYS, Ways};
use crate::lathe::same_plan::SamePlan;
use crate::lathe::samples::{BodySlope, SectionSlopes};
pub use crate::lathe::slopes::{Method, Slopes};

/// How the bat is hit for answers about a hit.
#[derive(Debug, Clone)]
pub struct HitTerms {
    /// Swing, ball and pitch.
    pub scene: Scene,
    /// How a hit is computed.
    pub model: Model,
    /// Whether only the request's modes may contribute.
    pub exactly: bool,
}

/// How much work a difference is worth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Care {
    /// Two bats for each change. The error is not known and stated as 0.
    OneStep,
    /// The error is computed: two more bats for some of the changes, with half of the step, and for those that are
    /// one-sided.
    Checked,
}

/// A bat whose diameter may be changed between borders, with its answers.
pub struct Workpiece {
    bat: Bat,
    plan: SamePlan,
    solution: Solution,
    samples: SectionSlopes,
    answers: Vec<Answer>,
    values: Vec<Option<Figure>>,
    /// The hit for all differences; a wall is solved approximately, in the same way for all bats.
    hit: Option<PlannedHit>,
    /// The results of the pass along it.
    look: LathePass,
    /// The hit with the wall solved to the requested accuracy, and its gauges; `None` if no wall is approximate.
    finer: Option<(PlannedHit, Vec<Option<Gauge>>)>,
    /// Answers without a derivative, as two places compete.
    pub rivals: Vec<Rivals>,
    /// Whether all answers are as accurate as asked.
    pub met: bool,
}

/// The largest change of the diameter in a difference (m): 20 μm of radius in both directions. Half of it changes a
/// derivative of the exit speed by less than 1e-7 m/s per mm.
const STEP: f64 = 4e-5;
/// Number of intervals between the changes whose step is halved: five of them give the error of all.
const HALF_STEPS: usize = 4;
/// Relative step of the swing for a derivative by it.
const FASTER: f64 = 1e-3;

impl Workpiece {
    /// A bat that is to be changed between these borders (m from the knob end), and its answers. The request's
    /// tolerance is that of frequencies and exit speeds, and its theory holds for all changed bats; `terms` are needed
    /// for answers about a hit.
    ///
    /// # Errors
    ///
    /// Those of [`sweetspot::solve()`] and of a hit; [`sweetspot::Error::Value`] for a place that is not on the bat.
    pub fn new(
        bat: &Bat,
        borders: &[f64],
        request: &Request,
        terms: Option<&HitTerms>,
        answers: &[Answer],
    ) -> Result<Self> {
        on_the_bat(answers, bat)?;
        let bat = bat.cut_at(borders)?;
        let mut modes = answers.iter().map(|answer| answer.modes()).max().unwrap_or(0);
        let (mut hit, mut met, mut off) = (None, true, 0.0);
        if let Some(terms) = terms.filter(|_| answers.iter().any(|answer| answer.of_a_hit())) {
            let trial = Trial { model: terms.model, scene: &terms.scene };
            let accuracy = trial.accuracy(request, terms.exactly);
            let places: Vec<f64> = ALONG.iter().map(|share| share * bat.length()).collect();
            let sweep = sweep(&bat, terms.model, &terms.scene, &accuracy, &places)?;
            (modes, met) = (modes.max(sweep.solution.modes.len()), sweep.met());
            off = sweep.worst().map_or(0.0, |(_, outcome)| outcome.error);
            let (model, effort, scene) = (terms.model, sweep.effort, terms.scene.clone());
            hit = Some(PlannedHit { scene, model, effort });
        }
        let (plan, solution) = SamePlan::new(&bat, &Request { modes, ..*request })?;
        met &= solution.worst() <= request.tolerance;
        let samples = SectionSlopes::new(&bat, &solution);
        let mut piece = Self {
            answers: answers.to_vec(),
            values: vec![],
            rivals: vec![],
            bat,
            plan,
            solution,
            samples,
            hit: None,
            look: LathePass::default(),
            finer: None,
            met,
        };
        piece.look = piece.looked(hit.as_ref(), off)?;
        (piece.values, piece.rivals) = (piece.look.values.clone(), piece.look.rivals.clone());
        if let Some(fine) = hit.as_ref().filter(|hit| hit.scene.hoop.wall().is_some()) {
            let scene = fine.scene.with_rough_wall(&piece.bat)?;
            let rough = PlannedHit { scene, ..*fine };
            let look = piece.looked(Some(&rough), off)?;
            let fine = hit.replace(rough);
            piece.finer = fine.zip(Some(std::mem::replace(&mut piece.look, look).gauges));
        }
        Ok(Self { hit, ..piece })
    }

    /// Makes a pass along the bat for the places of answers about a hit; the error of exit speeds is that share of the
    /// closing speed.
    fn looked(&self, hit: Option<&PlannedHit>, off: f64) -> Result<LathePass> {
        let (bat, solution) = (&self.bat, &self.solution);
        let mut look = LathePass {
            values: self.answers.iter().map(|answer| figure(*answer, bat, solution)).collect(),
            gauges: vec![None; self.answers.len()],
            by_swing: self.answers.iter().map(|a| (!a.of_a_hit()).then_some(0.0)).collect(),
            ..LathePass::default()
        };
        let Some(hit) = hit else { return Ok(look) };
        let hitter = hit.hitter(bat, solution, &hit.scene)?;
        let length = bat.length();
        let half_wave = length / (hitter.modes_used() + 1) as f64;
        let mut along = OuterHalf::new(&hitter, length);
        for (k, answer) in self.answers.iter().enumerate().filter(|(_, a)| a.of_a_hit()) {
            let (gauge, value) = along.gauge(*answer);
            let closing = hit.scene.swing.abs() * (length + hit.scene.pivot) + hit.scene.ball_speed;
            let error = gauge.as_ref().map_or(0.0, |gauge| gauge.error(off * closing, half_wave));
            look.values[k] = value.map(|value| Figure::new(value, error));
            look.gauges[k] = gauge;
        }
        look.rivals = std::mem::take(&mut along.rivals);
        look.best = along.found();
        let swing = hit.scene.swing;
        let readings = |faster: f64| -> Result<Vec<Option<f64>>> {
            let scene = Scene { swing: swing * (1.0 + faster), ..hit.scene.clone() };
            let hitter = hit.hitter(bat, solution, &scene)?;
            let [read] = Self::readings(&hitter, [&look.gauges]);
            Ok(read)
        };
        if swing != 0.0 {
            let (fast, slow) = (readings(FASTER)?, readings(-FASTER)?);
            let by_swing = quotient(&fast, &slow, 2.0 * FASTER * swing);
            for (k, by_swing) in by_swing.into_iter().enumerate() {
                if self.answers[k].of_a_hit() {
                    look.by_swing[k] = by_swing;
                }
            }
        }
        Ok(look)
    }

    /// The readings of gauges for a bat that is hit.
    fn readings<const N: usize>(
        hitter: &Hitter,
        gauges: [&[Option<Gauge>]; N],
    ) -> [Vec<Option<f64>>; N] {
        let seen = GaugeHits::new(hitter, gauges.iter().copied().flatten().flatten());
        let read = |gauge: &Option<Gauge>| gauge.as_ref()?.read(hitter, &seen);
        gauges.map(|gauges| gauges.iter().map(read).collect())
    }

    /// The bat, cut at its borders.
    pub fn bat(&self) -> &Bat {
        &self.bat
    }

    /// Its modes, as many as the answers need, with shapes as accurate as the tolerance.
    pub fn solution(&self) -> &Solution {
        &self.solution
    }

    /// Its sections at the points of a quadrature.
    pub fn samples(&self) -> &SectionSlopes {
        &self.samples
    }

    /// The answers.
    pub fn answers(&self) -> &[Answer] {
        &self.answers
    }

    /// The answers of the unchanged bat, by the hits that changed bats have; `None` for an answer without a value.
    pub fn compared(&self) -> &[Option<Figure>] {
        &self.look.values
    }

    /// The answers of the unchanged bat; `None` for an answer without a value.
    pub fn values(&self) -> &[Option<Figure>] {
        &self.values
    }

    /// The derivatives of the answers by each of these changes of the diameter, whose knots are among the borders.
    ///
    /// # Errors
    ///
    /// Those of [`Bat::turned`] and of [`sweetspot::solve()`].
    pub fn slopes(&self, changes: &[DiameterChange], care: Care) -> Result<Vec<Slopes>> {
        let differs = |answer: &Answer| Method::of(*answer) == Method::Difference;
        if !self.answers.iter().any(differs) {
            let one = |change| self.one(change, None, &Usual::default());
            return Ok(changes.iter().map(one).collect());
        }
        let ways = if care == Care::Checked { self.ways()? } else { None };
        let way = ways.as_ref().map_or(By::Gauges, By::EveryWay);
        let now = self.raw(&self.bat, way)?;
        let whole = threads::map(changes.len(), |k| self.difference(&changes[k], 1.0, &now, way));
        let whole: Vec<Quotient> = whole.into_iter().collect::<Result<_>>()?;
        // A one-sided difference needs two steps.
        let last = (changes.len() - 1).max(1);
        let looked = |k: &usize| !whole[*k].central || (*k * HALF_STEPS) % last < HALF_STEPS;
        let halved: Vec<usize> =
            (0..changes.len()).filter(|k| care == Care::Checked && looked(k)).collect();
        // One step is enough for the difference of the ways.
        let half = threads::map(halved.len(), |k| {
            self.difference(&changes[halved[k]], 0.5, &now, By::Gauges)
        });
        let half: Vec<Quotient> = half.into_iter().collect::<Result<_>>()?;
        let mut found: Vec<Differences> = whole.into_iter().map(Differences::new).collect();
        halved.iter().zip(half).for_each(|(k, half)| found[*k].half = Some(half));
        if let Some(finer) = self.finer.as_ref().filter(|_| care == Care::Checked) {
            let by = By::FinerWall(finer);
            let now = self.raw(&self.bat, by)?;
            for k in halved {
                found[k].finer = Some(self.difference(&changes[k], 1.0, &now, by)?);
            }
        }
        let usual = Usual::of(&found, self.answers.len());
        let one = |(change, found)| self.one(change, Some(found), &usual);
        Ok(changes.iter().zip(&found).map(one).collect())
    }

    fn one(&self, change: &DiameterChange, found: Option<&Differences>, usual: &Usual) -> Slopes {
        let radius = |x: f64| [0.5 * change.at(x), 0.0];
        let body = self.samples.body(STANDARD_PIVOT, radius);
        let of = |(k, answer): (usize, &Answer)| match (Method::of(*answer), answer) {
            (Method::Exact, _) => exact(*answer, &body),
            (Method::Formula, Answer::Frequency(order)) => {
                let mode = self.solution.modes.get(order - 1)?;
                let [value, error] = self.samples.frequency(mode, radius);
                Some(Figure::new(value, error))
            }
            _ => found?.joined(k, usual),
        };
        let swing = self.hit.as_ref().map_or(0.0, |hit| hit.scene.swing);
        // Two steps as one of the fourth order.
        let check = |(k, answer): (usize, &Answer)| {
            let Answer::Frequency(_) = answer else { return None };
            found?.fourth_order(k)
        };
        Slopes {
            checked: self.answers.iter().enumerate().map(check).collect(),
            same_swing: self.answers.iter().enumerate().map(of).collect(),
            inertia: body.inertia,
            by_swing: self.look.by_swing.clone(),
            gain: -swing / self.bat.inertia().about(STANDARD_PIVOT) * body.inertia,
        }
    }

    /// A difference over that share of the usual step.
    fn difference(
        &self,
        change: &DiameterChange,
        share: f64,
        now: &ByWay,
        by: By,
    ) -> Result<Quotient> {
        let all = change.stretches().iter().flat_map(|stretch| stretch.diameter);
        let largest = all.fold(0.0, |largest: f64, by| largest.max(by.abs()));
        if largest == 0.0 {
            let by_way = [0; WAYS].map(|_| vec![Some(0.0); self.answers.len()]);
            return Ok(Quotient { central: true, by_way });
        }
        let step = share * STEP / largest;
        // A bat that ends in a point cannot lose wood there.
        let [more, less] = [step, -step].map(|step| self.bat.turned(&change.scaled(step)));
        let central = more.is_ok() && less.is_ok();
        let (thick, thin) = match (more, less) {
            (Ok(more), Ok(less)) => (self.raw(&more, by)?, self.raw(&less, by)?),
            (Ok(more), Err(_)) => (self.raw(&more, by)?, now.clone()),
            (Err(_), Ok(less)) => (now.clone(), self.raw(&less, by)?),
            (Err(error), Err(_)) => return Err(error),
        };
        let run = if central { 2.0 * step } else { step };
        let slopes = |k: usize| quotient(&thick[k], &thin[k], run);
        let by_way = std::array::from_fn(slopes);
        Ok(Quotient { central, by_way })
    }

    /// The values for differences on this plan: nodes, modal masses, and the readings of the gauges.
    fn raw(&self, bat: &Bat, by: By) -> Result<ByWay> {
        let solution = self.plan.solve(bat)?;
        let read = match &self.hit {
            Some(hit) => self.every_way(hit, bat, &solution, by)?,
            None => [0; WAYS].map(|_| vec![None; self.answers.len()]),
        };
        let of = |(answer, read): (&Answer, Option<f64>)| match *answer {
            Answer::Node(order) => {
                let [was, is] = [&self.solution, &solution].map(|s| s.modes.get(order - 1));
                // A node that appears or disappears is a different one.
                let is =
                    is.filter(|is| was.is_some_and(|was| was.nodes.len() == is.nodes.len()))?;
                is.nodes.last().copied()
            }
            Answer::ModalMass(order) => Some(solution.modes.get(order - 1)?.modal_mass),
            Answer::Frequency(order) => Some(solution.modes.get(order - 1)?.frequency()),
            _ => read,
        };
        let all = |read: Vec<Option<f64>>| self.answers.iter().zip(read).map(of).collect();
        Ok(read.map(all))
    }

    /// The ways besides the gauges' own, each with its places found again; `None` if nothing is hit.
    fn ways(&self) -> Result<Option<Ways>> {
        let Some(hit) = &self.hit else { return Ok(None) };
        let sought = |solution: &Solution, share: f64| -> Result<Vec<Option<Gauge>>> {
            let hitter = hit.hitter(&self.bat, solution, &hit.scene)?;
            let of = |gauge: &Option<Gauge>| Some(gauge.as_ref()?.again(&hitter, share));
            Ok(threads::map(self.look.gauges.len(), |k| of(&self.look.gauges[k])))
        };
        let closer = sought(&self.solution, 0.5)?;
        if !hit.effort.completed {
            return Ok(Some(Ways { closer, fewer: vec![] }));
        }
        let count = self.solution.modes.len();
        let fewer = [count.saturating_sub(2), count * 3 / 4]
            .map(|count| Ok((count, sought(&with_modes(&self.solution, count), 1.0)?)));
        let fewer = fewer.into_iter().collect::<Result<_>>()?;
        Ok(Some(Ways { closer, fewer }))
    }

    /// The readings of the gauges for a bat that is hit, and those of the other ways.
    fn every_way(&self, hit: &PlannedHit, bat: &Bat, solution: &Solution, by: By) -> Result<ByWay> {
        let (hit, gauges) = match by {
            By::FinerWall((finer, gauges)) => (finer, gauges),
            _ => (hit, &self.look.gauges),
        };
        let hitter = hit.hitter(bat, solution, &hit.scene)?;
        let By::EveryWay(Ways { closer, fewer }) = by else {
            let [all] = Self::readings(&hitter, [gauges]);
            return Ok([0; WAYS].map(|_| all.clone()));
        };
        let [all, by_closer] = Self::readings(&hitter, [gauges, closer]);
        let few = |k: usize| {
            let Some((count, gauges)) = fewer.get(k) else { return Ok(all.clone()) };
            let solution = with_modes(solution, *count);
            let [read] = Self::readings(&hit.hitter(bat, &solution, &hit.scene)?, [gauges]);
            Ok(read)
        };
        let [two, quarter] = [few(0)?, few(1)?];
        Ok([all, by_closer, two, quarter])
    }

    /// The answers of the bat changed by much, for a batter who swings it at `Ω (I₀/I)^n`.
    ///
    /// # Errors
    ///
    /// As [`Self::slopes`].
    pub fn cut(&self, change: &DiameterChange, exponents: &[f64]) -> Result<Vec<Vec<Option<f64>>>> {
        let bat = self.bat.turned(change)?;
        let solution = self.plan.solve(&bat)?;
        self.measured(&bat, &solution, exponents, true)
    }

    /// The best place of each searched answer, on the unchanged bat and after a cut.
    ///
    /// # Errors
    ///
    /// As [`Self::slopes`].
    pub fn peaks(&self, change: &DiameterChange) -> Result<Vec<Option<[Peak; 2]>>> {
        let Some(hit) = &self.hit else { return Ok(vec![None; self.answers.len()]) };
        let bat = self.bat.turned(change)?;
        let solution = self.plan.solve(&bat)?;
        let hitter = hit.hitter(&bat, &solution, &hit.scene)?;
        let mut along = OuterHalf::beside(&hitter, bat.length(), &self.look.best, false);
        self.answers.iter().for_each(|answer| drop(along.gauge(*answer)));
        let (was, is) = (&self.look.best, along.found());
        Ok(self.answers.iter().map(|a| Some([was.peak(*a)?, is.peak(*a)?])).collect())
    }

    /// The answers of any other bat, on its own elements with the same number of modes, for batters who swing it at
    /// `Ω (I₀/I)^n`: a list for each n.
    ///
    /// # Errors
    ///
    /// Those of [`sweetspot::solve()`] and of a hit.
    pub fn measure(&self, bat: &Bat, exponents: &[f64]) -> Result<Vec<Vec<Option<f64>>>> {
        self.measured(bat, &self.plan.solve_anew(bat)?, exponents, false)
    }

    /// The answers of another bat, whose best places are near those of this one (`beside`) or anywhere.
    fn measured(
        &self,
        bat: &Bat,
        solution: &Solution,
        exponents: &[f64],
        beside: bool,
    ) -> Result<Vec<Vec<Option<f64>>>> {
        let still = |answer: &Answer| figure(*answer, bat, solution).map(|figure| figure.value);
        let still: Vec<Option<f64>> = self.answers.iter().map(still).collect();
        let Some(hit) = &self.hit else { return Ok(vec![still; exponents.len()]) };
        let inertia = |bat: &Bat| bat.inertia().about(STANDARD_PIVOT);
        let ratio = inertia(&self.bat) / inertia(bat);
        let one = |exponent: &f64, known: Option<&BestPlaces>, same_bat: bool| {
            let swing = hit.scene.swing * ratio.powf(*exponent);
            let scene = Scene { swing, ..hit.scene.clone() };
            let hitter = hit.hitter(bat, solution, &scene)?;
            let mut along = match known {
                Some(known) => OuterHalf::beside(&hitter, bat.length(), known, same_bat),
                None => OuterHalf::new(&hitter, bat.length()),
            };
            let of = |(answer, known): (&Answer, &Option<f64>)| {
                if answer.of_a_hit() { along.gauge(*answer).1 } else { *known }
            };
            let all: Vec<Option<f64>> = self.answers.iter().zip(&still).map(of).collect();
            Ok((all, along.found()))
        };
        let (mut known, mut all) = (beside.then(|| self.look.best.clone()), vec![]);
        for exponent in exponents {
            let (values, best) = one(exponent, known.as_ref(), !all.is_empty())?;
            known = Some(best);
            all.push(values);
        }
        Ok(all)
    }
}

fn exact(answer: Answer, body: &BodySlope) -> Option<Figure> {
    let value = match answer {
        Answer::Mass => body.mass,
        Answer::BalancePoint => body.balance_point,
        Answer::Inertia => body.inertia,
        _ => body.center_of_percussion?,
    };
    Some(Figure::exact(value))
}
