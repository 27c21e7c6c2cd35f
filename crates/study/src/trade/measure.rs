//! The measurement: a ladder of degrees, elements and solvers, and the planner's own choices.

use std::time::{Duration, Instant};

use serde::Serialize;

use crate::engine::{Bat, DEGREES, Request, Result, Solution, Solver, Tell, Theory, solve};
use crate::trade::front::{Run, mark};
use crate::trade::reference::{Choice, Reference, solver_name, worst};
use crate::trade::u_curve::{self, Curve, first_time, order};
use crate::trade::words::{digits, hurts, planner};

/// Speed against accuracy on one bat, as measured.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Trade {
    /// Number of modes.
    pub modes: usize,
    /// The reference for the errors.
    pub reference: Reference,
    /// Every run, fastest first.
    pub runs: Vec<Run>,
    /// The runs that the planner chose, for the largest tolerance first.
    pub planner: Vec<Run>,
    /// Error against the number of cubic elements, as far as there was time.
    pub more_elements: Vec<Curve>,
    /// The conclusions, in sentences.
    pub words: Vec<String>,
}

/// The tolerances given to the planner.
pub const TOLERANCES: [f64; 6] = [1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12];
/// The solvers of the ladder.
const SOLVERS: [Solver; 3] = [Solver::Statics, Solver::ShiftInvert, Solver::Dense];
/// A rung has this many times the elements of the one before.
const RATIO: f64 = 1.5;
/// No rung has more unknowns.
const MOST_UNKNOWNS: f64 = 2e6;
/// Rungs without a gain after which a ladder ends.
const PATIENCE: usize = 3;
/// Largest number of elements in the columns.
const FINEST_COLUMN: usize = 8192;
/// Shares of the time: until the columns are measured, until the ladder ends, until the end.
const COLUMNS: f64 = 0.25;
const LADDER: f64 = 0.75;
const WHOLE: f64 = 0.97;
/// Longest single run of the ladder, as a part of the time.
const LONGEST: f64 = 0.025;
/// Longest time for all the repeats of one rung, likewise.
const SLICE: f64 = 0.0005;
/// A run that was measured while the machine was busy may take this part of its time.
const CHANCE: f64 = 0.5;
/// Repeats of a run, at most.
const MOST_REPEATS: usize = 61;

/// Measures the trade for the `modes` lowest modes, in about that time. The reference and one choice of the planner are
/// always computed, however long they take. `progress` receives the next step.
///
/// Every time belongs to a warm run, which was solved before, unless a single run takes long.
///
/// # Errors
///
/// As [`solve`], for the reference and the planner's choices; a rung that fails is left out.
pub fn measure(
    bat: &Bat,
    modes: usize,
    theory: Theory,
    budget: Duration,
    tell: Tell,
) -> Result<Trade> {
    let started = Instant::now();
    tell(0.0, "the reference");
    let reference = Reference::of(bat, modes, theory)?;
    let mut bench =
        TimingBench { bat, reference, started, budget: budget.as_secs_f64(), runs: vec![] };
    bench.ask_planner(tell)?;
    let time = budget.mul_f64(COLUMNS).saturating_sub(started.elapsed());
    let finer = |_, what: &str| tell(bench.share(), what);
    let curves = u_curve::measure(bat, &bench.reference, &SOLVERS, FINEST_COLUMN, time, &finer);
    bench.climb(tell);
    tell(bench.share(), "the front again");
    for _ in 0..2 {
        bench.repeat_front();
    }
    Ok(bench.trade(curves))
}

/// A run with its request and all its times.
struct TimedRun {
    run: Run,
    request: Request,
    samples: Vec<f64>,
}

/// The runs so far and the clock.
struct TimingBench<'a> {
    bat: &'a Bat,
    reference: Reference,
    started: Instant,
    /// Time that may be spent (s).
    budget: f64,
    runs: Vec<TimedRun>,
}

/// The rungs of one degree and solver.
struct Ladder {
    degree: usize,
    solver: Solver,
    /// Elements of the next rung.
    next: f64,
    least: f64,
    without_gain: usize,
    /// Unknowns and seconds of the last rung.
    last: Option<(f64, f64)>,
    done: bool,
}

impl TimingBench<'_> {
    /// Whether that share of the time is not over.
    fn before(&self, part: f64) -> bool {
        self.started.elapsed().as_secs_f64() < part * self.budget
    }

    /// The share of the time that is over, 0 to 1.
    fn share(&self) -> f64 {
        (self.started.elapsed().as_secs_f64() / self.budget).min(1.0)
    }

    /// The reference's modes by its theory.
    fn request(&self) -> Request {
        let Reference { omegas, theory, .. } = &self.reference;
        Request { modes: omegas.len(), theory: *theory, ..Request::default() }
    }

    fn ask_planner(&mut self, tell: Tell) -> Result<()> {
        for tolerance in TOLERANCES {
            if !self.runs.is_empty() && !self.before(COLUMNS) {
                break;
            }
            tell(self.share(), &format!("the planner at {tolerance:.0e}"));
            let request = Request { tolerance, ..self.request() };
            let mut measured = self.timed(request)?;
            measured.run.planned_for = Some(tolerance);
            self.runs.push(measured);
        }
        Ok(())
    }

    /// One rung of every ladder, then the next of every ladder, until all end.
    fn climb(&mut self, tell: Tell) {
        let ladder = |degree, solver| Ladder {
            degree,
            solver,
            next: self.bat.profile().pieces.len() as f64,
            least: f64::INFINITY,
            without_gain: 0,
            last: None,
            done: false,
        };
        let mut ladders: Vec<Ladder> =
            SOLVERS.iter().flat_map(|s| DEGREES.map(move |p| ladder(p, *s))).collect();
        while ladders.iter().any(|ladder| !ladder.done) && self.before(LADDER) {
            for ladder in ladders.iter_mut().filter(|ladder| !ladder.done) {
                if !self.before(LADDER) {
                    break;
                }
                let (name, n) = (solver_name(ladder.solver), ladder.next.round());
                let what = format!("{name}, degree {}, {n} elements", ladder.degree);
                tell(self.share(), &what);
                self.step(ladder);
            }
        }
    }

    fn step(&mut self, ladder: &mut Ladder) {
        let elements = ladder.next.round();
        let unknowns = (ladder.degree - 1) as f64 * elements;
        ladder.next = (ladder.next * RATIO).max(elements + 1.0);
        let modes = self.reference.omegas.len();
        if unknowns < modes as f64 {
            return;
        }
        let expected = match ladder.last {
            Some((before, seconds)) => seconds * (unknowns / before).powi(order(ladder.solver)),
            None => first_time(unknowns as usize, ladder.solver),
        };
        if unknowns > MOST_UNKNOWNS || expected > LONGEST * self.budget {
            ladder.done = true;
            return;
        }
        let request = Request {
            elements: Some(elements as usize),
            degree: Some(ladder.degree),
            solver: ladder.solver,
            ..self.request()
        };
        let Ok(measured) = self.timed(request) else {
            ladder.done = true;
            return;
        };
        let error = measured.run.error;
        ladder.last = Some((unknowns, measured.run.seconds));
        ladder.without_gain = if error < 0.9 * ladder.least { 0 } else { ladder.without_gain + 1 };
        ladder.least = ladder.least.min(error);
        ladder.done = error <= self.reference.floor || ladder.without_gain == PATIENCE;
        self.runs.push(measured);
    }

    /// Solves once to warm up, then again as often as the slice allows.
    fn timed(&self, request: Request) -> Result<TimedRun> {
        let (solution, first) = self.once(&request)?;
        let slice = SLICE * self.budget;
        let mut samples = Vec::new();
        if first > 10.0 * slice {
            samples.push(first);
        }
        let until = Instant::now();
        while samples.len() < 3 || until.elapsed().as_secs_f64() < slice {
            if first > 10.0 * slice || samples.len() == MOST_REPEATS {
                break;
            }
            samples.push(self.once(&request)?.1);
        }
        let omegas: Vec<f64> = solution.modes.iter().map(|mode| mode.omega).collect();
        let error_by_mode = self.reference.errors(&omegas);
        let run = Run {
            choice: Choice::of(&solution),
            seconds: median(&samples),
            repeats: samples.len(),
            error: worst(&error_by_mode),
            error_by_mode,
            stated_error: solution.worst(),
            planned_for: None,
            on_front: false,
        };
        Ok(TimedRun { run, request, samples })
    }

    /// A solution and the seconds it took.
    fn once(&self, request: &Request) -> Result<(Solution, f64)> {
        let started = Instant::now();
        let solution = solve(self.bat, request)?;
        Ok((solution, started.elapsed().as_secs_f64()))
    }

    /// Repeats the decisive runs in turn, so that all of them meet the same machine: the planner's choices, and runs
    /// that would be on the front if their first times were slow by chance.
    fn repeat_front(&mut self) {
        let floor = self.reference.floor;
        let beats = |other: &Run, run: &Run| {
            other.seconds < CHANCE * run.seconds && other.error.max(floor) <= run.error.max(floor)
        };
        let decides = |run: &Run| {
            run.planned_for.is_some() || !self.runs.iter().any(|other| beats(&other.run, run))
        };
        let chosen: Vec<usize> =
            (0..self.runs.len()).filter(|k| decides(&self.runs[*k].run)).collect();
        for _ in 0..MOST_REPEATS / 2 {
            for &k in &chosen {
                let run = &self.runs[k].run;
                let left = WHOLE * self.budget - self.started.elapsed().as_secs_f64();
                if run.seconds < left
                    && let Ok((_, seconds)) = self.once(&self.runs[k].request)
                {
                    self.runs[k].samples.push(seconds);
                }
            }
        }
        for TimedRun { run, samples, .. } in &mut self.runs {
            (run.seconds, run.repeats) = (median(samples), samples.len());
        }
    }

    fn trade(self, more_elements: Vec<Curve>) -> Trade {
        let floor = self.reference.floor;
        let mut runs: Vec<Run> = self.runs.into_iter().map(|measured| measured.run).collect();
        mark(&mut runs, floor);
        let mut words = digits(&runs, floor);
        words.extend(planner(&runs));
        words.extend(hurts(&more_elements));
        let planned = runs.iter().filter(|run| run.planned_for.is_some());
        let mut planner: Vec<Run> = planned.cloned().collect();
        planner
            .sort_by(|a, b| b.planned_for.unwrap_or(0.0).total_cmp(&a.planned_for.unwrap_or(0.0)));
        let modes = self.reference.omegas.len();
        Trade { modes, reference: self.reference, runs, planner, more_elements, words }
    }
}

/// The median of the samples, 0 for an empty list.
fn median(samples: &[f64]) -> f64 {
    let mut sorted = samples.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trade::front::front;
    use sweetspot::base::telling::nobody;

    #[test]
    fn errors_on_the_ladder_are_what_the_solutions_say_and_the_front_goes_down() {
        let bat = Bat::builtin("cone").unwrap();
        let trade =
            measure(&bat, 3, Theory::EulerBernoulli, Duration::from_millis(600), &nobody).unwrap();
        let floor = trade.reference.floor;
        assert!(trade.runs.len() > 20, "{}", trade.runs.len());
        for run in &trade.runs {
            assert!(
                run.seconds > 0.0 && run.repeats > 0 && run.error_by_mode.len() == 3,
                "{run:?}"
            );
            assert!(run.error <= 3.0 * run.stated_error + 3.0 * floor, "{run:?}");
        }
        let errors: Vec<f64> = front(&trade.runs).map(|run| run.error.max(floor)).collect();
        assert!(!errors.is_empty() && errors.windows(2).all(|pair| pair[1] < pair[0]));
        assert!(trade.words.iter().any(|words| words.starts_with("1e-2 takes")));
        let planned = trade.runs.iter().filter_map(|run| Some((run, run.planned_for?)));
        assert!(planned.clone().count() >= 1);
        for (run, tolerance) in planned {
            assert!(run.error <= tolerance, "{run:?}");
        }
    }

    #[test]
    fn the_median_is_the_middle() {
        assert_eq!((median(&[3.0, 1.0, 2.0]), median(&[])), (2.0, 0.0));
    }
}
