//! What are the results of several bats?
//!
//! Bats similar to one model are computed together. The results of a bat depend only on the bat and the model.

use std::ops::Range;

use crate::answers::{ALONG, Answer, Figure, figure, on_the_bat, with_modes};
use crate::comparison::contender::{Sought, exit_speed};
use crate::engine::{
    Bat, Error, FEW, Hitter, Impact, Model, Prepared, Request, Result, Scene, Solution, Sweep, Way,
    greater, prepare, solutions, solve, threads,
};
use sweetspot::collision::batch::Blow;
use sweetspot::collision::batch::each as strike_each;
use sweetspot::collision::stated::fewer;
use sweetspot::collision::sweep as hit;

/// The outputs for every bat.
#[derive(Debug, Clone)]
pub struct Questions {
    /// The answers, in the order of the columns.
    pub answers: Vec<Answer>,
    /// Accuracy of frequencies, relative, and of exit speeds, relative to the closing speed.
    pub tolerance: f64,
}

/// How a bat is hit.
#[derive(Debug, Clone)]
pub struct BatTrial {
    /// Swing, ball and pitch.
    pub scene: Scene,
    /// How a hit is computed.
    pub model: Model,
}

/// The results of a bat.
#[derive(Debug)]
pub struct BatAnswers {
    /// Values with their errors in the order of the outputs; `None` if the bat has no such answer.
    pub figures: Vec<Option<Figure>>,
    /// Whether frequencies and exit speeds are as accurate as asked.
    pub met: bool,
    /// The reason if the hit is impossible.
    pub off: Option<Error>,
}

impl BatAnswers {
    /// Whether an answer of another bat differs from this one's by more than a relative 1e-10.
    pub fn differs(&self, other: &Self) -> bool {
        const SAME: f64 = 1e-10;
        self.figures.iter().zip(&other.figures).any(|both| match both {
            (Some(a), Some(b)) => (a.value - b.value).abs() > SAME * a.value.abs(),
            (a, b) => a.is_some() != b.is_some(),
        })
    }
}

/// Rows that are computed together: some bats in the lanes of every vector, on one plan.
pub const TOGETHER: u64 = 16;

/// The values of `of` for some rows, in order, on all cores; `tell` receives the number of further finished rows.
pub fn in_groups<T: Send>(
    rows: Range<u64>,
    of: impl Fn(Range<u64>) -> Vec<T> + Sync,
    tell: impl Fn(u64) + Sync,
) -> Vec<T> {
    let from = |group: usize| rows.end.min(rows.start + group as u64 * TOGETHER);
    let groups = (rows.end - rows.start).div_ceil(TOGETHER) as usize;
    let group = |group: usize| {
        let (first, end) = (from(group), from(group + 1));
        let found = of(first..end);
        tell(end - first);
        found
    };
    threads::map(groups, group).into_iter().flatten().collect()
}

/// A bat that is ready to be solved.
struct Ready {
    /// The bat with moduli fitted to its tap.
    bat: Bat,
    request: Request,
    /// The hit and its places (m from the knob end), if there is one.
    trial: Option<(BatTrial, Vec<f64>)>,
    /// The reason if the requested hit is impossible.
    off: Option<Error>,
}

impl Questions {
    /// The outputs for each of several bats similar to `model`, in order; `trial` receives the index of a bat and the
    /// bat with moduli fitted to its tap.
    ///
    /// A bat's results depend only on the bat and the model, not on the other bats.
    ///
    /// # Errors
    ///
    /// Each bat has its own: the reason why there is no answer, those of [`sweetspot::solve()`], of a hit, and of the
    /// trial.
    pub fn of_each<'a>(
        model: &Bat,
        bats: Vec<(&'a Self, Result<Bat>)>,
        trial: impl Fn(usize, &Bat) -> Result<BatTrial>,
    ) -> Vec<Result<BatAnswers>> {
        let ready = |(k, (asked, bat)): (usize, (&'a Self, Result<Bat>))| {
            (asked, bat.and_then(|bat| asked.ready(bat, |bat| trial(k, bat))))
        };
        let ready: Vec<(&Self, Result<Ready>)> = bats.into_iter().enumerate().map(ready).collect();
        let mut found: Vec<Option<Result<BatAnswers>>> = ready.iter().map(|_| None).collect();
        let there = ready.iter().enumerate();
        let there =
            || there.clone().filter_map(|(k, (asked, of))| Some((k, *asked, of.as_ref().ok()?)));
        let blows = there().filter_map(|one| Some((one, one.2.blow()?)));
        let (hit, blows): (Vec<(usize, &Self, &Ready)>, Vec<Blow>) = blows.unzip();
        strike_each(model, &blows, Way::SideBySide, |n, sweep| {
            let (k, asked, ready) = hit[n];
            found[k] = Some(sweep.and_then(|sweep| asked.with_hits(ready, &sweep)));
        });
        let others = there().filter(|(.., ready)| ready.trial.is_none());
        let others: Vec<(usize, &Self, &Ready)> = others.collect();
        let requests = others.iter().map(|(.., ready)| (&ready.bat, ready.request));
        solutions(model, &requests.collect::<Vec<_>>(), Way::SideBySide, |n, solution| {
            let (k, asked, ready) = others[n];
            found[k] = Some(solution.and_then(|solution| asked.of_modes(&ready.bat, &solution)));
        });
        let whole = |((_, ready), found): ((&Self, Result<Ready>), Option<Result<BatAnswers>>)| {
            let (ready, found) = (ready?, found.expect("every bat that is ready is solved")?);
            Ok(BatAnswers { off: ready.off.or(found.off), ..found })
        };
        ready.into_iter().zip(found).map(whole).collect()
    }

    /// The bat with moduli fitted to its tap, and the data for its answers.
    fn ready(&self, bat: Bat, trial: impl FnOnce(&Bat) -> Result<BatTrial>) -> Result<Ready> {
        let modes = self.answers.iter().map(|answer| answer.modes()).max().unwrap_or(0);
        let hit = self.answers.iter().any(|answer| answer.of_a_hit());
        let modes = if hit { modes.max(Request::default().modes) } else { modes };
        let request = Request { modes, tolerance: self.tolerance, ..Request::default() };
        let Prepared { bat, request, .. } = prepare(&bat, &request)?;
        let bat = bat.into_owned();
        let trial = hit.then(|| trial(&bat)).transpose();
        let (trial, off) = trial.map_or_else(|error| (None, Some(error)), |trial| (trial, None));
        let trial = trial.map(|trial| (trial, self.places(&bat)));
        Ok(Ready { bat, request, trial, off })
    }

    /// The answers of a bat that is not hit.
    fn of_modes(&self, bat: &Bat, solution: &Solution) -> Result<BatAnswers> {
        let figures = self.answers.iter().map(|answer| figure(*answer, bat, solution)).collect();
        Ok(BatAnswers { figures, met: solution.worst() <= self.tolerance, off: None })
    }

    /// The answers of a bat that was hit: those about modes from the modes of the hit, if these are accurate enough.
    fn with_hits(&self, ready: &Ready, sweep: &Sweep) -> Result<BatAnswers> {
        let Ready { bat, request, trial, .. } = ready;
        let (BatTrial { scene, model }, _) =
            trial.as_ref().expect("a bat that was hit has its trial");
        let asked = self.answers.iter().map(|answer| answer.modes()).max().unwrap_or(0);
        let found = match sweep.solution.modes.len() >= asked {
            true => self.of_modes(bat, &sweep.solution)?,
            false => self.of_modes(bat, &solve(bat, &Request { modes: asked, ..*request })?)?,
        };
        let searched = match self.answers.iter().any(|answer| answer.is_searched()) {
            true => searched(&self.answers, bat, (scene, *model), sweep)?,
            false => vec![],
        };
        let at = |x: f64| sweep.impacts.iter().find(|impact| impact.x == x);
        let of = |(answer, known): (&Answer, Option<Figure>)| match *answer {
            Answer::ExitSpeedAt(x) => exit_speed(at(x)?, scene),
            Answer::VibrationAt(x) => vibration(at(x)?, scene),
            answer if answer.is_searched() => {
                searched.iter().find(|(known, _)| *known == answer).map(|(_, figure)| *figure)
            }
            _ => known,
        };
        let figures = self.answers.iter().zip(found.figures).map(of).collect();
        let off = on_the_bat(&self.answers, bat).err();
        Ok(BatAnswers { figures, met: found.met && sweep.met(), off })
    }

    /// Impact points (m from the knob end): the requested ones, and those for the search of best places.
    fn places(&self, bat: &Bat) -> Vec<f64> {
        let asked = self.answers.iter().filter_map(|answer| answer.place());
        let mut places: Vec<f64> = asked.filter(|x| *x <= bat.length()).collect();
        if self.answers.iter().any(|answer| answer.is_searched()) {
            places.extend(ALONG.map(|share| share * bat.length()));
        }
        places.sort_by(f64::total_cmp);
        places.dedup();
        places
    }
}

impl Ready {
    fn blow(&self) -> Option<Blow<'_>> {
        let (BatTrial { scene, model, .. }, places) = self.trial.as_ref()?;
        let trial = hit::Trial { model: *model, scene };
        let accuracy = trial.accuracy(&self.request, false);
        Some(Blow { bat: &self.bat, trial, accuracy, places })
    }
}

/// Energy left in vibration by an impact (J); its error is the energy that the error of the impulse shifts.
fn vibration(impact: &Impact, scene: &Scene) -> Option<Figure> {
    let outcome = impact.outcome.as_ref()?;
    let closing = impact.bat_speed + scene.ball_speed;
    let moved = scene.ball.mass_kg * outcome.error * closing * closing;
    (!outcome.energy.vibration_by_mode.is_empty())
        .then(|| Figure::new(outcome.energy.vibration, moved))
}

/// The answers that need a search on a bat that was hit, as far as they are requested.
fn searched(
    answers: &[Answer],
    bat: &Bat,
    (scene, model): (&Scene, Model),
    sweep: &Sweep,
) -> Result<Vec<(Answer, Figure)>> {
    let hitter = Hitter::new(model, scene, bat, &sweep.solution, sweep.effort)?;
    let asked = |which: fn(&Answer) -> bool| answers.iter().any(which);
    // An answer about a given place needs no search.
    let sought = asked(|answer| answer.is_searched() && answer.place().is_none())
        .then(|| Sought::new(&hitter, FEW));
    let sought = |which| sought.as_ref().filter(|_| asked(which));
    let mut found = vec![];
    let fastest = sought(|answer| {
        matches!(answer, Answer::ExitSpeed | Answer::ExitSpeedPlace | Answer::Zone(_))
    });
    if let Some((sought, peak)) = fastest.and_then(|by| Some((by, by.looked.fastest()?))) {
        let [speed, place, _] = sought.best(peak, &sought.hit(peak));
        found.extend([(Answer::ExitSpeed, speed), (Answer::ExitSpeedPlace, place)]);
        if asked(|answer| matches!(answer, Answer::Zone(_))) {
            let [from, to] = sought.looked.zone(peak).map(|edge| sought.edge(peak, edge));
            found.extend([(Answer::Zone(false), from), (Answer::Zone(true), to)]);
        }
    }
    let least = sought(|answer| matches!(answer, Answer::Vibration | Answer::VibrationPlace));
    if let Some((sought, peak)) = least.and_then(|by| Some((by, by.looked.least_vibration()?))) {
        let [place, value] = sought.least(peak);
        found.extend([(Answer::VibrationPlace, place), (Answer::Vibration, value)]);
    }
    let bbcor = sought(|answer| *answer == Answer::Bbcor).and_then(|sought| sought.bbcor(1));
    found.extend(bbcor.map(|bbcor| (Answer::Bbcor, bbcor)));
    let felt = [
        sought(|answer| *answer == Answer::HandsVelocity),
        sought(|answer| *answer == Answer::HandsAcceleration),
    ];
    let felt = [0, 1].map(|k| {
        let looked = &felt[k]?.looked;
        let least = looked.least_felt(k)?;
        Some((least.x, looked.missed(-least.value, |seen| Some(-seen.hands[k]))))
    });
    if asked(|answer| answer.of_the_hands()) {
        found.extend(hands(bat, (scene, model), (sweep, &hitter), felt)?);
    }
    Ok(found)
}

/// The motion at the hands due to hits on a bat, at the places of the sweep and at those of the least velocity and
/// acceleration (m), with what a search for these may have missed. Its error also has the change with fewer modes and the
/// error of the impulse, to which the motion is proportional.
fn hands(
    bat: &Bat,
    (scene, model): (&Scene, Model),
    (sweep, all): (&Sweep, &Hitter),
    least: [Option<(f64, f64)>; 2],
) -> Result<Vec<(Answer, Figure)>> {
    let Sweep { solution, impacts, effort, .. } = sweep;
    let count = solution.modes.len();
    // With half of them it is a different bat.
    let most = fewer(count).into_iter().filter(|few| 3 * few >= 2 * count);
    let most: Vec<Solution> = most.map(|few| with_modes(solution, few)).collect();
    let hitter = |solution| Hitter::new(model, scene, bat, solution, *effort);
    let few: Vec<Hitter> = most.iter().map(hitter).collect::<Result<_>>()?;
    let share = |impact: &Impact| {
        let outcome = impact.outcome.as_ref()?;
        let closing = impact.bat_speed + scene.ball_speed;
        Some(outcome.error * closing * scene.ball.mass_kg / outcome.impulse)
    };
    let unsure = impacts.iter().filter_map(share).fold(0.0, greater);
    let felt = |(x, missed): (f64, f64), k: usize| {
        let seen = |hitter: &Hitter| hitter.glance(x).map(|seen| seen.hands[k]);
        let (all, few) = (seen(all)?, few.iter().map(seen).collect::<Option<Vec<_>>>()?);
        let apart = few.iter().map(|few| (all - few).abs()).fold(0.0, greater);
        Some(Figure::new(all, apart + unsure * all + missed))
    };
    let [velocity, acceleration] = least;
    let at = impacts.iter().flat_map(|impact| {
        let x = Some((impact.x, 0.0));
        [(Answer::HandsVelocityAt(impact.x), x, 0), (Answer::HandsAccelerationAt(impact.x), x, 1)]
    });
    let best = [(Answer::HandsVelocity, velocity, 0), (Answer::HandsAcceleration, acceleration, 1)];
    Ok(at.chain(best).filter_map(|(answer, x, k)| Some((answer, felt(x?, k)?))).collect())
}
