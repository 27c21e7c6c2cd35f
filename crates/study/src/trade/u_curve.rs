//! Error against the number of cubic elements: where more of them start to hurt.
//!
//! The discretisation's part falls like `n⁻⁴`. The round-off of a solver that factors `K` grows
//! like `ε n⁴`, so its error has the form of a U; by running sums it stays at ε.

use std::time::{Duration, Instant};

use crate::trade::reference::{Reference, solver_name};
use sweetspot::base::error::{Error, Result};
use sweetspot::base::telling::Tell;
use sweetspot::bat::body::Bat;
use sweetspot::beam::mesh::Mesh;
use sweetspot::modes::solve::{MOST_DENSE, Request, Solver, own_and_recomputed, solve};

/// The solvers of a U-curve, those of this build.
pub const SOLVERS: &[Solver] = &[
    Solver::Statics,
    Solver::ShiftInvert,
    #[cfg(feature = "arpack")]
    Solver::Arpack,
    Solver::Dense,
];

/// What one solver does as elements are added.
#[derive(Debug, Clone)]
pub struct Column {
    /// The solver.
    pub solver: Solver,
    /// Points by rising number of elements.
    pub points: Vec<MeshErrors>,
    /// Why the column ends early; None if it has as many points as were asked for.
    pub end: Option<End>,
}

/// Why a column ends before the last number of elements.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum End {
    /// The solver gave an error on this many elements.
    Refused {
        /// How many elements.
        elements: usize,
        /// The error, in words.
        reason: String,
    },
    /// So many elements are more than the solver takes.
    TooLarge {
        /// How many elements.
        elements: usize,
    },
    /// So many elements would have taken longer than there was time for.
    NoTime {
        /// How many elements.
        elements: usize,
    },
}

/// The errors on one mesh, relative, mode by mode.
#[derive(Debug, Clone)]
pub struct MeshErrors {
    /// Number of elements.
    pub elements: usize,
    /// Of the frequencies as the solver's own λ says them; empty for statics, which has no other.
    pub own: Vec<f64>,
    /// Of the frequencies as strain energy over kinetic energy.
    pub recomputed: Vec<f64>,
    /// Assembly to frequencies, once (s).
    pub seconds: f64,
}

/// Which of a solver's two frequencies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SolverFrequency {
    /// The eigenvalue that the solver found.
    Own,
    /// Strain energy over kinetic energy of its shape.
    Recomputed,
}

impl Column {
    /// Number of elements and error of one mode (from 0).
    pub fn series(&self, way: SolverFrequency, mode: usize) -> Vec<(usize, f64)> {
        let error = |point: &MeshErrors| match way {
            SolverFrequency::Own => point.own.get(mode).copied(),
            SolverFrequency::Recomputed => point.recomputed.get(mode).copied(),
        };
        self.points.iter().filter_map(|point| Some((point.elements, error(point)?))).collect()
    }

    /// The ways in which this solver gives a frequency.
    pub fn ways(&self) -> &'static [SolverFrequency] {
        match self.solver {
            Solver::Statics => &[SolverFrequency::Recomputed],
            _ => &[SolverFrequency::Own, SolverFrequency::Recomputed],
        }
    }
}

/// The point of the least error.
pub fn best(series: &[(usize, f64)]) -> Option<(usize, f64)> {
    series.iter().copied().min_by(|a, b| a.1.total_cmp(&b.1))
}

/// The first number of elements beyond the best at which the error is `threshold` or more.
pub fn loss(series: &[(usize, f64)], threshold: f64) -> Option<(usize, f64)> {
    let (least, _) = best(series)?;
    series.iter().copied().find(|(n, error)| *n > least && *error >= threshold)
}

/// 8, 16, 32, … and `most`, from the first that has an element in every piece of the profile and
/// bends in so many ways on.
pub fn counts(bat: &Bat, modes: usize, most: usize) -> Vec<usize> {
    let least = bat.profile().pieces.len().max(modes.div_ceil(2) + 1);
    let doubled = std::iter::successors(Some(8), |n| Some(2 * n)).take_while(|n| *n < most);
    let mut counts: Vec<usize> = doubled.chain([most]).filter(|n| *n >= least).collect();
    if counts.is_empty() {
        counts.push(least);
    }
    counts
}

/// The columns of these solvers up to `most` elements, for all modes of the reference; what would
/// not be ready within `time` is left out.
pub fn measure(
    bat: &Bat,
    reference: &Reference,
    solvers: &[Solver],
    most: usize,
    time: Duration,
    tell: Tell,
) -> Vec<Column> {
    let deadline = Instant::now() + time;
    let counts = counts(bat, reference.omegas.len(), most);
    // Time goes with the number of elements, and there are as many for every solver.
    let all = counts.iter().sum::<usize>() as f64;
    let share = |k: usize| k as f64 / solvers.len() as f64;
    let columns = solvers.iter().enumerate().map(|(k, solver)| {
        let tell = |before, what: &str| tell(share(k) + share(1) * before / all, what);
        column(bat, reference, *solver, &counts, deadline, &tell)
    });
    columns.collect()
}

fn column(
    bat: &Bat,
    reference: &Reference,
    solver: Solver,
    counts: &[usize],
    deadline: Instant,
    tell: Tell,
) -> Column {
    let mut column = Column { solver, points: vec![], end: None };
    let mut before = 0.0;
    for &elements in counts {
        let left = deadline.saturating_duration_since(Instant::now()).as_secs_f64();
        // What is too large is refused at once.
        let refused = solver == Solver::Dense && 2 * elements + 2 > MOST_DENSE;
        if !refused && expected(column.points.last(), elements, solver) > left {
            column.end = Some(End::NoTime { elements });
            break;
        }
        tell(before, &format!("{}, {elements} cubic elements", solver_name(solver)));
        before += elements as f64;
        match point(bat, reference, solver, elements) {
            Ok(point) => column.points.push(point),
            Err(error) => {
                column.end = Some(match error {
                    Error::TooLarge { .. } => End::TooLarge { elements },
                    error => End::Refused { elements, reason: error.to_string() },
                });
                break;
            }
        }
    }
    column
}

/// How long the given number of elements should take (s), from the last point.
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
    let (own, recomputed): (Vec<f64>, Vec<f64>) = match solver {
        Solver::Statics => {
            let (elements, degree) = (Some(elements), Some(3));
            let theory = reference.theory;
            let request = Request { modes, elements, degree, theory, ..Request::default() };
            let solution = solve(bat, &request)?;
            (vec![], solution.modes.iter().map(|mode| mode.omega).collect())
        }
        _ => own_and_recomputed(bat, &Mesh::along(bat, elements), modes, solver, reference.theory)?
            .into_iter()
            .map(|[own, recomputed]| (own, recomputed))
            .unzip(),
    };
    let seconds = started.elapsed().as_secs_f64();
    let [own, recomputed] = [own, recomputed].map(|omegas| reference.errors(&omegas));
    Ok(MeshErrors { elements, own, recomputed, seconds })
}

#[cfg(test)]
mod tests {
    use super::*;
    use sweetspot::base::telling::nobody;
    use sweetspot::bat::theory::Theory;

    fn dowel(solvers: &[Solver], most: usize) -> Vec<Column> {
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
            let (least, _) = best(&column.series(SolverFrequency::Own, 0)).unwrap();
            assert!(least < 512 && column.end.is_none(), "{column:?}");
        }
    }

    #[test]
    fn a_loss_counts_from_the_best_on() {
        let series = [(8, 1e-3), (16, 1e-9), (32, 1e-12), (64, 1e-7), (128, 1e-9)];
        assert_eq!(best(&series), Some((32, 1e-12)));
        assert_eq!(loss(&series, 1e-8), Some((64, 1e-7)));
        assert_eq!((loss(&series, 1e-4), loss(&[], 1.0)), (None, None));
    }

    #[test]
    fn a_solver_that_cannot_says_so() {
        let columns = dowel(&[Solver::ShiftInvert], 100_000);
        let Some(End::Refused { elements, reason }) = &columns[0].end else {
            panic!("{columns:?}");
        };
        assert!(*elements > 1000 && reason.contains("stiffness matrix"), "{elements}: {reason}");
    }
}
