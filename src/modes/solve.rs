//! What are the modes of a bat, as accurately as asked?
//!
//! [`solve`](fn@solve) prepares the bat, plans, solves, checks the errors and refines; [`solve_within`] takes a time
//! instead of an accuracy. A [`Request`] says what is wanted, a [`Solution`] what was found and how accurate it is.

use std::time::Duration;

use crate::base::{Clock, Result};
use crate::bat::Bat;
use crate::modes::plan::Reason;
use crate::modes::prepared::{Prepared, prepare};
use crate::modes::refine::refine;

pub use crate::modes::referee::{MOST_DENSE, Solver, own_and_recomputed};
#[doc(hidden)]
pub use crate::modes::refine::SOLVED;
pub use crate::modes::request::{Request, stop_at, wanted};
pub use crate::modes::solution::{Ending, Solution, Timing};

/// Finds the lowest bending modes of a bat, as accurately as asked. The program `sweetspot` prints these numbers.
///
/// If the request names no theory, the simplest one that is accurate enough is used. If the first frequency of the bat
/// was tapped, the moduli are fitted to it ([`prepare`]).
///
/// ```
/// use sweetspot::{Bat, Request, solve};
///
/// # fn main() -> sweetspot::Result<()> {
/// # let text = r#"{ "format": "sweetspot-bat/1", "material": "white-ash-dynamic",
/// #     "profile": { "unit": "in", "x": [0, 6, 20, 27, 33], "diameter": [1.0, 0.9, 1.6, 2.4, 2.5] } }"#;
/// # let bat = Bat::from_text("bat.json", text, "".as_ref())?;
/// let asked = Request { modes: 3, tolerance: 1e-9, ..Request::default() };
/// let solution = solve(&bat, &asked)?;
/// assert!(solution.met()); // no mode is missing
/// for mode in &solution.modes {
///     println!("{:.6} Hz within {:.0e}", mode.frequency(), mode.error.total());
/// }
/// # Ok(())
/// # }
/// ```
///
/// # Errors
///
/// Those of [`Request::check`] and [`prepare`]; [`crate::Error::TooFewElements`] if the given elements have fewer modes
/// than requested, [`crate::Error::TooLarge`] for the dense solver, [`crate::Error::Factorization`] for solvers that
/// factor `K`, [`crate::Error::NotBuilt`] without ARPACK, [`crate::Error::NotConverged`]. An accuracy that cannot be
/// reached is not an error: the best result is returned, and its [`Ending`] gives the reason.
pub fn solve(bat: &Bat, request: &Request) -> Result<Solution> {
    let Prepared { bat, request, .. } = prepare(bat, request)?;
    Ok(refine(&bat, &request)?.of_tapped(bat))
}

/// The most accurate result within a time limit. It adds one digit after the other until the next would take too long,
/// judged by the time for the last one. The first digit is always computed; if it took longer, the [`Ending`] says so.
///
/// ```
/// use std::time::Duration;
/// use sweetspot::modes::solve::solve_within;
/// use sweetspot::{Bat, Request};
///
/// # fn main() -> sweetspot::Result<()> {
/// # let text = r#"{ "format": "sweetspot-bat/1", "material": "white-ash-dynamic",
/// #     "profile": { "unit": "in", "x": [0, 6, 20, 27, 33], "diameter": [1.0, 0.9, 1.6, 2.4, 2.5] } }"#;
/// # let bat = Bat::from_text("bat.json", text, "".as_ref())?;
/// let solution = solve_within(&bat, &Request::default(), Duration::from_millis(50))?;
/// println!("within {:.0e} after 50 ms", solution.worst());
/// # Ok(())
/// # }
/// ```
///
/// # Errors
///
/// As [`solve`].
pub fn solve_within(bat: &Bat, request: &Request, budget: Duration) -> Result<Solution> {
    let started = Clock::start();
    let Prepared { bat, request, .. } = prepare(bat, request)?;
    let (mut best, mut first) = (None::<Solution>, Duration::ZERO);
    for digits in 1..=14 {
        let begun = Clock::start();
        let digit = Request { tolerance: 10f64.powi(-digits), elements: None, ..request };
        let solution = match refine(&bat, &digit) {
            Ok(solution) => solution,
            // If a digit cannot be reached, the search ends and the last result is returned.
            Err(_) if best.is_some() => break,
            Err(error) => return Err(error),
        };
        let (last, spent) = (begun.elapsed(), started.elapsed());
        if best.is_none() {
            first = spent;
        }
        let better = best.as_ref().is_none_or(|best| solution.worst() < best.worst());
        let over = spent + last + last / 2 > budget || !solution.met();
        if better && (spent <= budget || best.is_none()) {
            let in_time = spent <= budget && solution.complete;
            let ending = if in_time { Ending::Reached } else { solution.ending };
            best = Some(Solution { ending, ..solution });
        }
        if over {
            break;
        }
    }
    let mut best = best.expect("there was a first digit");
    best.reason = Reason::Budget(budget);
    if first > budget {
        let late = format!("the first digit took {first:?}, {budget:?} were allowed");
        best.ending = if best.complete { Ending::Stopped(late) } else { Ending::Uncounted };
    }
    Ok(best.of_tapped(bat))
}
