//! Which runs are worth their time: the Pareto front of time and error.

use serde::Serialize;

use crate::trade::reference::Choice;

/// One mesh and solver, timed.
#[derive(Debug, Clone, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Run {
    /// The mesh and the solver.
    #[serde(flatten)]
    pub choice: Choice,
    /// Median time of the repeats (s).
    // Plan, assembly, eigenpairs, shapes and estimates.
    pub seconds: f64,
    /// How often it was timed.
    pub repeats: usize,
    /// Largest true error of a frequency.
    pub error: f64,
    /// True error of each frequency.
    pub error_by_mode: Vec<f64>,
    /// Largest error of a frequency by the solution's own estimate.
    pub stated_error: f64,
    /// The tolerance for which the planner chose this; null for a mesh of the ladder.
    pub planned_for: Option<f64>,
    /// Whether no other run is both faster and more accurate.
    pub on_front: bool,
}

/// Sorts the runs by time and marks those that are more accurate than every faster one. Errors below `floor` count as
/// equal, so that the front does not continue into the noise.
pub fn mark(runs: &mut [Run], floor: f64) {
    let error = |run: &Run| run.error.max(floor);
    runs.sort_by(|a, b| a.seconds.total_cmp(&b.seconds).then(error(a).total_cmp(&error(b))));
    let mut least = f64::INFINITY;
    for run in runs {
        run.on_front = error(run) < least;
        least = least.min(error(run));
    }
}

/// The runs of the front, fastest first.
pub fn front(runs: &[Run]) -> impl Iterator<Item = &Run> {
    runs.iter().filter(|run| run.on_front)
}

/// The fastest run whose error is within a tolerance.
pub fn fastest(runs: &[Run], tolerance: f64) -> Option<&Run> {
    let within = runs.iter().filter(|run| run.error <= tolerance);
    within.min_by(|a, b| a.seconds.total_cmp(&b.seconds))
}

#[cfg(test)]
mod tests {
    use super::*;
    use sweetspot::base::golden;
    use sweetspot::modes::solve::Solver;

    fn run(seconds: f64, error: f64) -> Run {
        let choice =
            Choice { degree: 5, elements: 7, solver: Solver::Statics, degrees_of_freedom: 30 };
        Run {
            choice,
            seconds,
            repeats: 3,
            error,
            error_by_mode: vec![0.5 * error, error],
            stated_error: error,
            planned_for: None,
            on_front: false,
        }
    }

    #[test]
    fn nothing_beats_the_front_and_something_of_it_beats_all_else() {
        let floor = 1e-12;
        let numbers = (0..199).map(golden::fraction);
        let mut runs: Vec<Run> = numbers
            .clone()
            .zip(numbers.skip(7))
            .map(|(time, error)| run((time * 50.0).round(), 10f64.powf(-15.0 * error)))
            .collect();
        mark(&mut runs, floor);
        assert!(front(&runs).count() > 2);
        let beats = |a: &Run, b: &Run| {
            let (ours, theirs) = (a.error.max(floor), b.error.max(floor));
            a.seconds <= b.seconds && ours <= theirs
        };
        for (k, run) in runs.iter().enumerate() {
            let others = || runs.iter().enumerate().filter(|(j, _)| *j != k).map(|(_, run)| run);
            if run.on_front {
                let better = others().find(|o| beats(o, run) && !beats(run, o));
                assert!(better.is_none(), "{run:?} {better:?}");
            } else {
                assert!(others().any(|other| other.on_front && beats(other, run)), "{run:?}");
            }
        }
    }

    #[test]
    fn the_fastest_within_a_tolerance_is_on_the_front() {
        let mut runs = vec![run(5.0, 1e-9), run(1.0, 1e-2), run(2.0, 1e-5), run(3.0, 1e-4)];
        mark(&mut runs, 1e-14);
        let on: Vec<f64> = front(&runs).map(|run| run.seconds).collect();
        assert_eq!(on, [1.0, 2.0, 5.0]);
        assert_eq!(fastest(&runs, 1e-4).map(|run| run.seconds), Some(2.0));
        assert!(fastest(&runs, 1e-10).is_none());
    }
}
