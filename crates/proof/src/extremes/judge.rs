//! Right, refused or wrong.

use crate::extremes::{Outcome, Verdict};
use crate::promise::{ALWAYS, KNOWN_TO, largest};
use sweetspot::base::{Error, Result};
use sweetspot::modes::solve::Solution;

/// Compares a solution for a tolerance with the exact frequencies (Hz). If every error is within three times the stated
/// one, it is right, or refused with the reason that the solution gives.
pub fn against(asked: f64, solution: &Solution, exact: &[f64]) -> Outcome {
    let errors = solution.modes.iter().zip(exact).map(|(mode, f)| mode.frequency() / f - 1.0);
    let found = largest(errors.clone().map(f64::abs));
    let beyond = |(error, stated): (f64, f64)| error.abs() > ALWAYS * stated + KNOWN_TO;
    let stated = solution.modes.iter().map(|mode| mode.error.total());
    let verdict = if solution.modes.len() > exact.len() || errors.zip(stated).any(beyond) {
        Verdict::Wrong("an error beyond three times the stated one".into())
    } else if !solution.met() {
        Verdict::Refused(solution.ending.to_string())
    } else if found > ALWAYS * asked {
        Verdict::Wrong("the claim is false".into())
    } else {
        Verdict::Right
    };
    Outcome { asked, found, stated: solution.worst(), verdict, note: String::new() }
}

/// A difference that must not exceed the requested one.
pub fn difference(asked: f64, found: f64, stated: f64) -> Outcome {
    // NaN fails the comparison: an unknown difference counts as too large.
    let verdict =
        if found <= asked { Verdict::Right } else { Verdict::Wrong("more than asked".into()) };
    Outcome { asked, found, stated, verdict, note: String::new() }
}

/// Largest relative difference of two solutions' frequencies, the second's times `factor`.
pub fn apart(a: &Solution, b: &Solution, factor: f64) -> f64 {
    if a.modes.len() != b.modes.len() {
        return f64::INFINITY;
    }
    let pairs = a.modes.iter().zip(&b.modes);
    largest(pairs.map(|(a, b)| (b.omega * factor / a.omega - 1.0).abs()))
}

/// A case that must be refused: any answer to it is wrong.
pub fn refusal<T>(asked: f64, answer: Result<T>) -> Outcome {
    let verdict = match answer {
        Err(error @ Error::NotConverged { .. }) => Verdict::Wrong(error.to_string()),
        Err(error) => Verdict::Refused(error.to_string()),
        Ok(_) => Verdict::Wrong("an answer where none is possible".into()),
    };
    Outcome { asked, found: f64::NAN, stated: f64::NAN, verdict, note: String::new() }
}
