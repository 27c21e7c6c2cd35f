//! The conclusions of the measurement, in sentences.

use crate::engine::Solver;
use crate::trade::front::{Run, fastest};
use crate::trade::reference::solver_name;
use crate::trade::u_curve::{Curve, End, Losses, Reason, SolverFrequency};

/// Numbers of digits that are compared, from the second on.
const DIGITS: std::ops::RangeInclusive<i32> = 2..=15;
/// An error that has grown to this many times its least hurts.
const HURTS: f64 = 10.0;

/// A time (s) with three digits and the unit that suits it.
pub fn time(seconds: f64) -> String {
    let (value, unit) = match seconds {
        s if s < 999.5e-6 => (1e6 * s, "µs"),
        s if s < 0.9995 => (1e3 * s, "ms"),
        s => (s, "s"),
    };
    let decimals = if value < 9.995 { 2 } else { usize::from(value < 99.95) };
    format!("{value:.decimals$} {unit}")
}

/// The cost of each digit: from one power of ten to the next, the fastest runs within them.
pub fn digits(runs: &[Run], floor: f64) -> Vec<String> {
    let within = |d: i32| 10f64.powi(-d);
    let reached: Vec<(i32, f64)> = DIGITS
        .take_while(|d| within(*d) >= floor)
        .map_while(|d| Some((d, fastest(runs, within(d))?.seconds)))
        .collect();
    let mut words = Vec::new();
    let Some(&(first, least)) = reached.first() else { return words };
    words.push(format!("1e-{first} takes {}", time(least)));
    let mut from = (first, least);
    for (k, &(digit, seconds)) in reached.iter().enumerate().skip(1) {
        let next = reached.get(k + 1);
        if seconds > from.1 {
            let (last, cost) = (digit - 1, cost(from.1, seconds));
            words.push(format!("from 1e-{last} to 1e-{digit} costs {cost}"));
            from = (digit, seconds);
        } else if next.is_none_or(|next| next.1 > seconds) {
            words.push(format!("from 1e-{} to 1e-{digit} costs nothing", from.0));
        }
    }
    words
}

fn cost(from: f64, to: f64) -> String {
    let (ratio, times) = (to / from, format!("({} to {})", time(from), time(to)));
    match ratio {
        r if r < 1.005 => format!("less than 1 % more time {times}"),
        r if r < 2.0 => format!("{:.0} % more time {times}", 100.0 * (r - 1.0)),
        r => format!("{r:.1} times the time {times}"),
    }
}

/// The planner's choices compared with the fastest runs of the same accuracy, and whether they kept their promise.
pub fn planner(runs: &[Run]) -> Vec<String> {
    let plans = runs.iter().filter_map(|run| Some((run, run.planned_for?)));
    let (mut shares, mut broken) = (Vec::new(), Vec::new());
    for (run, tolerance) in plans {
        if run.error <= tolerance {
            shares.extend(fastest(runs, tolerance).map(|best| run.seconds / best.seconds));
        } else {
            let error = run.error;
            broken.push(format!("the planner's choice for {tolerance:.0e} has {error:.1e}"));
        }
    }
    let least = shares.iter().copied().fold(f64::INFINITY, f64::min);
    let most = shares.iter().copied().fold(0.0, f64::max);
    let mut words = Vec::new();
    let alone = runs.iter().all(|run| run.planned_for.is_some());
    if !shares.is_empty() && !alone {
        words.push(format!(
            "the planner's choices take {least:.1} to {most:.1} times as long as the fastest run \
             within the same tolerance"
        ));
    }
    words.extend(broken);
    if alone && !runs.is_empty() {
        words.push("there was time for the planner's choices only: give it a larger budget".into());
    }
    words
}

/// From where more cubic elements hurt, solver by solver, for mode 1.
pub fn hurts(curves: &[Curve]) -> Vec<String> {
    let lines = curves.iter().flat_map(|curve| {
        curve.ways().iter().filter_map(|way| hurt(curve, *way)).chain(refusal(curve))
    });
    lines.collect()
}

fn hurt(curve: &Curve, way: SolverFrequency) -> Option<String> {
    let series = curve.series(way, 0);
    let Losses { best_elements: least, least_error: error, .. } = *curve.lost_at(way)?;
    let (last, _) = *series.last()?;
    let name = solver_name(curve.solver);
    let whose = match (curve.solver, way) {
        (Solver::Statics, _) => name.to_owned(),
        (_, SolverFrequency::Own) => format!("{name}, its own λ"),
        (_, SolverFrequency::Recomputed) => format!("{name}, recomputed"),
    };
    // Below this the error fluctuates.
    let limit = HURTS * error.max(1e-14);
    let beyond = series.iter().find(|(n, error)| *n > least && *error > limit);
    Some(match beyond {
        Some((n, worse)) => format!(
            "{whose}: more than {least} cubic elements hurt: {error:.0e} there, {worse:.0e} at {n}"
        ),
        None => format!("{whose}: more elements do no harm up to {last} cubic ones"),
    })
}

fn refusal(curve: &Curve) -> Option<String> {
    let name = solver_name(curve.solver);
    match curve.end.as_ref()? {
        End { elements, reason: Reason::Refused(_) } => {
            Some(format!("{name}: no answer on {elements} elements"))
        }
        End { .. } => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trade::reference::Choice;
    use crate::trade::u_curve::MeshErrors;

    fn run(seconds: f64, error: f64) -> Run {
        let (degree, elements, degrees_of_freedom) = (5, 7, 30);
        let choice = Choice { degree, elements, solver: Solver::Statics, degrees_of_freedom };
        let (error_by_mode, planned_for) = (vec![0.5 * error, error], None);
        let (repeats, stated_error, on_front) = (3, error, false);
        Run { choice, seconds, repeats, error, error_by_mode, stated_error, planned_for, on_front }
    }

    #[test]
    fn the_next_digit_has_a_price() {
        let runs = [run(1e-5, 3e-4), run(1.12e-5, 2e-6), run(5e-5, 2e-7), run(2e-3, 1e-12)];
        let words = digits(&runs, 1e-8);
        let says = [
            "1e-2 takes 10.0 µs",
            "from 1e-2 to 1e-3 costs nothing",
            "from 1e-3 to 1e-4 costs 12 % more time (10.0 µs to 11.2 µs)",
            "from 1e-4 to 1e-5 costs nothing",
            "from 1e-5 to 1e-6 costs 4.5 times the time (11.2 µs to 50.0 µs)",
            "from 1e-6 to 1e-7 costs 40.0 times the time (50.0 µs to 2.00 ms)",
            "from 1e-7 to 1e-8 costs nothing",
        ];
        assert_eq!(words, says);
        assert!(digits(&[], 1e-8).is_empty());
    }

    #[test]
    fn a_planner_that_breaks_its_promise_is_named() {
        let mut runs = vec![run(1e-5, 3e-5), run(2e-5, 2e-6), run(4e-5, 1e-5), run(3e-5, 1e-6)];
        (runs[2].planned_for, runs[3].planned_for) = (Some(1e-4), Some(1e-8));
        let words = planner(&runs);
        assert!(words[0].contains("4.0 to 4.0 times as long"), "{words:?}");
        assert_eq!(words[1], "the planner's choice for 1e-8 has 1.0e-6");
        assert!(planner(&runs[..2]).is_empty());
        assert!(planner(&runs[2..]).last().unwrap().contains("budget"));
    }

    #[test]
    fn a_u_hurts_beyond_its_bottom_and_a_floor_does_not() {
        let point = |elements, own, recomputed| MeshErrors {
            elements,
            own_error_by_mode: Some(vec![own]),
            recomputed_error_by_mode: vec![recomputed],
            seconds: 1.0,
        };
        let points = vec![point(8, 1e-4, 1e-4), point(16, 1e-9, 1e-15), point(32, 1e-6, 5e-15)];
        let end = Some(End { elements: 64, reason: Reason::Refused("it is too large".into()) });
        let words = hurts(&[Curve::new(Solver::Dense, points, end)]);
        let says = [
            "dense, its own λ: more than 16 cubic elements hurt: 1e-9 there, 1e-6 at 32",
            "dense, recomputed: more elements do no harm up to 32 cubic ones",
            "dense: no answer on 64 elements",
        ];
        assert_eq!(words, says);
    }

    #[test]
    fn times_have_three_digits() {
        let shown = [1.234e-6, 12.34e-6, 999.4e-6, 999.6e-6, 0.0123, 1.5, 123.4].map(time);
        assert_eq!(
            shown,
            ["1.23 µs", "12.3 µs", "999 µs", "1.00 ms", "12.3 ms", "1.50 s", "123 s"]
        );
    }
}
