//! Error against the number of cubic elements: where do more elements start to hurt?
//!
//! The discretisation error falls like `n⁻⁴`. The round-off of a solver that factors `K` grows like `ε n⁴`, so its
//! error has the form of a U. By running sums it stays at ε.

use std::time::{Duration, Instant};

use serde::Serialize;

use crate::engine::{
    Bat, Error, MOST_DENSE, Mesh, Request, Result, Solver, Tell, own_and_recomputed, solve,
};
use crate::trade::reference;
use crate::trade::reference::{Reference, by_name, solver_name};

/// Errors that leave 8 digits, 4 digits and no digit.
const THRESHOLDS: [f64; 3] = [1e-8, 1e-4, 1.0];

/// The solvers of a U-curve, those of this build.
pub const SOLVERS: &[Solver] = &[
    Solver::Statics,
    Solver::ShiftInvert,
    #[cfg(feature = "arpack")]
    Solver::Arpack,
    Solver::Dense,
];

/// The errors of one solver for more and more elements.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Curve {
    /// Method for the eigenvalues.
    #[serde(serialize_with = "by_name")]
    #[schemars(with = "String", extend("enum" = reference::SOLVERS.map(solver_name)))]
    pub solver: Solver,
    /// Points by rising number of elements.
    pub points: Vec<MeshErrors>,
    /// The reason why the column ends early; null if it has all requested points.
    pub end: Option<End>,
    /// Where the solver's own eigenvalue of mode 1 is lost; null if it has none.
    pub own_lost_at: Option<Losses>,
    /// Where the frequency recomputed from the shape of mode 1 is lost.
    pub recomputed_lost_at: Option<Losses>,
}

/// Why a column ends.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, schemars::JsonSchema)]
pub struct End {
    /// The number of elements that was not reached.
    pub elements: usize,
    /// The solver's error, "too large" or "no time".
    #[schemars(with = "String")]
    pub reason: Reason,
}

/// The reason why a solver ended.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub enum Reason {
    /// The solver does not take that many elements.
    #[serde(rename = "too large")]
    TooLarge,
    /// This number of elements would have taken too long.
    #[serde(rename = "no time")]
    NoTime,
    /// The solver gave this error.
    #[serde(untagged)]
    Refused(String),
}

/// The errors at one number of elements.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct MeshErrors {
    /// Number of elements.
    pub elements: usize,
    /// Time from assembly to frequencies (s).
    pub seconds: f64,
    /// Error of each frequency by the solver's own eigenvalue; null if there is no separate one.
    // Statics has none.
    pub own_error_by_mode: Option<Vec<f64>>,
    /// Error of each frequency as strain energy over kinetic energy of the shape.
    pub recomputed_error_by_mode: Vec<f64>,
}

/// Numbers of elements at which a frequency is lost; null where it is not.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Losses {
    /// The number of elements with the least error.
    pub best_elements: usize,
    /// That least error.
    pub least_error: f64,
    /// The first number beyond the best at which 8 digits are left.
    #[serde(rename = "error_1e-8")]
    pub eight_digits: Option<usize>,
    /// The first number beyond the best at which 4 digits are left.
    #[serde(rename = "error_1e-4")]
    pub four_digits: Option<usize>,
    /// The first number beyond the best at which no digit is left.
    #[serde(rename = "error_1")]
    pub nothing: Option<usize>,
}

/// Which of a solver's two frequencies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SolverFrequency {
    /// The eigenvalue that the solver found.
    Own,
    /// Strain energy over kinetic energy of its shape.
    Recomputed,
}

impl MeshErrors {
    /// The error of each frequency, found in that way.
    pub fn errors(&self, way: SolverFrequency) -> &[f64] {
        match way {
            SolverFrequency::Own => self.own_error_by_mode.as_deref().unwrap_or_default(),
            SolverFrequency::Recomputed => &self.recomputed_error_by_mode,
        }
    }
}

impl Losses {
    /// The losses of a curve of errors by number of elements; `None` for a curve without points.
    fn of(series: &[(usize, f64)]) -> Option<Self> {
        let least = series.iter().min_by(|a, b| a.1.total_cmp(&b.1));
        let (best_elements, least_error) = *least?;
        let [eight_digits, four_digits, nothing] = THRESHOLDS.map(|threshold| {
            let beyond = series.iter().find(|(n, error)| *n > best_elements && *error >= threshold);
            beyond.map(|at| at.0)
        });
        Some(Self { best_elements, least_error, eight_digits, four_digits, nothing })
    }
}

impl Curve {
    /// The curve of those points, with where mode 1 is lost.
    pub(crate) fn new(solver: Solver, points: Vec<MeshErrors>, end: Option<End>) -> Self {
        let mut curve = Self { solver, points, end, own_lost_at: None, recomputed_lost_at: None };
        curve.own_lost_at = Losses::of(&curve.series(SolverFrequency::Own, 0));
        curve.recomputed_lost_at = Losses::of(&curve.series(SolverFrequency::Recomputed, 0));
        curve
    }

    /// Number of elements and error of one mode (from 0).
    pub fn series(&self, way: SolverFrequency, mode: usize) -> Vec<(usize, f64)> {
        let error = |point: &MeshErrors| point.errors(way).get(mode).copied();
        self.points.iter().filter_map(|point| Some((point.elements, error(point)?))).collect()
    }

    /// Where mode 1 is lost by that frequency.
    pub fn lost_at(&self, way: SolverFrequency) -> Option<&Losses> {
        match way {
            SolverFrequency::Own => self.own_lost_at.as_ref(),
            SolverFrequency::Recomputed => self.recomputed_lost_at.as_ref(),
        }
    }

    /// The ways in which this solver gives a frequency.
    pub fn ways(&self) -> &'static [SolverFrequency] {
        match self.solver {
            Solver::Statics => &[SolverFrequency::Recomputed],
            _ => &[SolverFrequency::Own, SolverFrequency::Recomputed],
        }
    }
}

/// 8, 16, 32, … and `most`, from the first number of elements on that has one in every piece of the profile and at
/// least `modes` modes.
pub fn counts(bat: &Bat, modes: usize, most: usize) -> Vec<usize> {
    let least = bat.profile().pieces.len().max(modes.div_ceil(2) + 1);
    let doubled = std::iter::successors(Some(8), |n| Some(2 * n)).take_while(|n| *n < most);
    let mut counts: Vec<usize> = doubled.chain([most]).filter(|n| *n >= least).collect();
    if counts.is_empty() {
        counts.push(least);
    }
    counts
}

/// The curves of these solvers up to `most` elements, for all modes of the reference; points that would not be ready
/// within `time` are left out.
pub fn measure(
    bat: &Bat,
    reference: &Reference,
    solvers: &[Solver],
    most: usize,
    time: Duration,
    tell: Tell,
) -> Vec<Curve> {
    let deadline = Instant::now() + time;
    let counts = counts(bat, reference.omegas.len(), most);
    // Time is proportional to the number of elements, and every solver has the same numbers.
    let all = counts.iter().sum::<usize>() as f64;
    let share = |k: usize| k as f64 / solvers.len() as f64;
    let curves = solvers.iter().enumerate().map(|(k, solver)| {
        let tell = |before, what: &str| tell(share(k) + share(1) * before / all, what);
        curve(bat, reference, *solver, &counts, deadline, &tell)
    });
    curves.collect()
}

fn curve(
    bat: &Bat,
    reference: &Reference,
    solver: Solver,
    counts: &[usize],
    deadline: Instant,
    tell: Tell,
) -> Curve {
    let (mut points, mut end, mut before) = (vec![], None, 0.0);
    for &elements in counts {
        let left = deadline.saturating_duration_since(Instant::now()).as_secs_f64();
        // What is too large is refused at once.
        let refused = solver == Solver::Dense && 2 * elements + 2 > MOST_DENSE;
        if !refused && expected(points.last(), elements, solver) > left {
            end = Some(End { elements, reason: Reason::NoTime });
            break;
        }
        tell(before, &format!("{}, {elements} cubic elements", solver_name(solver)));
        before += elements as f64;
        match point(bat, reference, solver, elements) {
            Ok(point) => points.push(point),
            Err(error) => {
                let reason = match error {
                    Error::TooLarge { .. } => Reason::TooLarge,
                    error => Reason::Refused(error.to_string()),
                };
                end = Some(End { elements, reason });
                break;
            }
        }
    }
    Curve::new(solver, points, end)
}

/// Expected time for the given number of elements (s), from the last point.
fn expected(last: Option<&MeshErrors>, elements: usize, solver: Solver) -> f64 {
    let Some(last) = last else { return first_time(2 * elements, solver) };
    last.seconds * (elements as f64 / last.elements as f64).powi(order(solver))
}

/// How the time grows with the number of unknowns.
pub fn order(solver: Solver) -> i32 {
    if solver == Solver::Dense { 3 } else { 1 }
}

/// Seconds for the given number of unknowns before anything was measured, on the safe side.
pub fn first_time(unknowns: usize, solver: Solver) -> f64 {
    let rate = match solver {
        Solver::Dense => 4e-10,
        Solver::Statics => 2e-6,
        Solver::ShiftInvert | Solver::Arpack => 6e-6,
    };
    rate * (unknowns as f64).powi(order(solver))
}

fn point(bat: &Bat, reference: &Reference, solver: Solver, elements: usize) -> Result<MeshErrors> {
    let modes = reference.omegas.len();
    let started = Instant::now();
    let (own, recomputed): (Option<Vec<f64>>, Vec<f64>) = match solver {
        Solver::Statics => {
            let (elements, degree) = (Some(elements), Some(3));
            let theory = reference.theory;
            let request = Request { modes, elements, degree, theory, ..Request::default() };
            let solution = solve(bat, &request)?;
            (None, solution.modes.iter().map(|mode| mode.omega).collect())
        }
        _ => {
            let mesh = Mesh::along(bat, elements);
            let both = own_and_recomputed(bat, &mesh, modes, solver, reference.theory)?;
            let (own, recomputed) = both.into_iter().map(<(f64, f64)>::from).unzip();
            (Some(own), recomputed)
        }
    };
    let seconds = started.elapsed().as_secs_f64();
    Ok(MeshErrors {
        elements,
        seconds,
        own_error_by_mode: own.map(|omegas| reference.errors(&omegas)),
        recomputed_error_by_mode: reference.errors(&recomputed),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use sweetspot::base::telling::nobody;
    use sweetspot::bat::theory::Theory;

    fn dowel(solvers: &[Solver], most: usize) -> Vec<Curve> {
        let bat = Bat::builtin("dowel").unwrap();
        let reference = Reference::of(&bat, 5, Theory::EulerBernoulli).unwrap();
        measure(&bat, &reference, solvers, most, Duration::from_secs(3600), &nobody)
    }

    #[test]
    fn running_sums_lose_no_digit_up_to_a_hundred_thousand_elements() {
        let columns = dowel(&[Solver::Statics], 100_000);
        for mode in [0, 4] {
            let series = columns[0].series(SolverFrequency::Recomputed, mode);
            assert_eq!(series.last().map(|(n, _)| *n), Some(100_000));
            // (βL/n)⁴/1440 is the discretisation's part.
            let beta = [4.73, 17.28][usize::from(mode > 0)];
            for (n, error) in series.into_iter().filter(|(n, _)| *n >= 64) {
                let mesh = (beta / n as f64).powi(4) / 1440.0;
                assert!((error - mesh).abs() < 0.02 * mesh + 3e-14, "{mode} {n}: {error:e}");
            }
        }
    }

    #[test]
    fn a_factored_stiffness_loses_digits_and_its_strains_win_them_back() {
        for column in dowel(&[Solver::Dense, Solver::ShiftInvert], 512) {
            let at = |way, elements| {
                let series = column.series(way, 0);
                series.into_iter().find(|(n, _)| *n == elements).unwrap().1
            };
            // The mesh's part of mode 1 falls from 2e-8 to 5e-12.
            assert!(at(SolverFrequency::Recomputed, 512) < 6e-12, "{column:?}");
            assert!(
                at(SolverFrequency::Own, 512) > 100.0 * at(SolverFrequency::Recomputed, 512),
                "{column:?}"
            );
            let least = column.own_lost_at.as_ref().unwrap().best_elements;
            assert!(least < 512 && column.end.is_none(), "{column:?}");
        }
    }

    #[test]
    fn a_loss_counts_from_the_best_on() {
        let series = [(8, 1e-3), (16, 1e-9), (32, 1e-12), (64, 1e-7), (128, 1e-9)];
        let lost = Losses::of(&series).unwrap();
        assert_eq!((lost.best_elements, lost.least_error), (32, 1e-12));
        assert_eq!((lost.eight_digits, lost.four_digits), (Some(64), None));
        assert_eq!(Losses::of(&[]), None);
    }

    #[test]
    fn a_solver_that_cannot_says_so() {
        let columns = dowel(&[Solver::ShiftInvert], 100_000);
        let Some(End { elements, reason: Reason::Refused(reason) }) = &columns[0].end else {
            panic!("{columns:?}");
        };
        assert!(*elements > 1000 && reason.contains("stiffness matrix"), "{elements}: {reason}");
    }
}
