//! What are the modes of a bat, as accurately as asked?
//!
//! [`solve`](fn@solve) plans, solves, looks at the errors and refines; [`solve_within`] takes a
//! time instead of an accuracy. A [`Request`] says what is wanted, a [`Solution`] what was found
//! and how far to trust it.

use std::time::Duration;

use crate::base::clock::Clock;
use crate::base::error::{Error, Result};
use crate::bat::body::Bat;
use crate::modes::damping::damping;
use crate::modes::plan::{Plan, Reason};
use crate::modes::request::CONVERGED;
use crate::modes::task::Task;

pub use crate::modes::referee::{MOST_DENSE, Solver, own_and_recomputed};
pub use crate::modes::request::{Request, stop_at, wanted};
pub use crate::modes::solution::{Solution, Timing};

/// A refinement that leaves more than this of the error gains nothing.
const STALLED: f64 = 0.7;
/// Refinements before the answer is given as it is.
const MOST_ROUNDS: usize = 12;

/// Finds the lowest bending modes of a free bat, as accurately as asked.
///
/// ```
/// use sweetspot::{Bat, Request, Theory, solve};
///
/// # fn main() -> sweetspot::Result<()> {
/// # let text = r#"{ "format": "sweetspot-bat/1", "material": "white-ash-dynamic",
/// #     "profile": { "unit": "in", "x": [0, 6, 20, 27, 33], "diameter": [1.0, 0.9, 1.6, 2.4, 2.5] } }"#;
/// # let bat = Bat::from_text("bat.json", text, "".as_ref())?;
/// let asked = Request { modes: 3, tolerance: 1e-9, theory: Theory::Timoshenko, ..Request::default() };
/// let solution = solve(&bat, &asked)?;
/// assert!(solution.met && solution.complete()); // no mode is missing
/// for mode in &solution.modes {
///     println!("{:.6} Hz within {:.0e}", mode.frequency(), mode.error.total());
/// }
/// # Ok(())
/// # }
/// ```
///
/// # Errors
///
/// Those of [`Request::check`]; [`Error::TooFewElements`] where the asked elements cannot bend in
/// so many ways, [`Error::TooLarge`] for the dense solver, [`Error::Factorization`] for those that
/// factor `K`, [`Error::NotBuilt`] without ARPACK, [`Error::NotConverged`]. An accuracy that cannot
/// be reached is no error: the best answer comes back with `met` false.
pub fn solve(bat: &Bat, request: &Request) -> Result<Solution> {
    request.check(1)?;
    if request.theory.shears() && !bat.knows_shear() {
        let found = format!("timoshenko, but {} has no shear modulus", bat.without_shear());
        let expected = "\"shear_modulus\" or \"poisson_ratio\" there, or a theory without shear";
        return Err(Error::value("theory", found, expected));
    }
    let started = Clock::start();
    let plan = match request.elements {
        Some(elements) => Plan::fixed(bat, elements, request.degree.unwrap_or(3)),
        None => Plan::cheapest(bat, &wanted(request)),
    };
    let timing = Timing { plan: started.elapsed(), ..Timing::default() };
    if plan.unknowns() < request.modes {
        let least = request.modes.div_ceil(plan.degree - 1);
        let found = plan.mesh.len();
        return Err(Error::TooFewElements { wanted: request.modes, least, found });
    }
    request.check_memory(request.memory(bat, &plan), plan.mesh.len())?;
    damped(bat, request, refined(bat, request, plan, timing)?)
}

/// The solution with how its motions die out.
pub(super) fn damped(bat: &Bat, request: &Request, mut best: Solution) -> Result<Solution> {
    best.damping = damping(bat, best.elements(), &best.modes, request.tolerance)?;
    let damped = best.damping.modes.iter().map(|damped| damped.error).fold(0.0, f64::max);
    if best.met && damped > request.tolerance {
        best.met = false;
        best.stopped = Some(format!("the damped motions are known to {damped:.1e} only"));
    }
    Ok(best)
}

/// The best solution on this plan and those that follow from its errors.
fn refined(bat: &Bat, request: &Request, mut plan: Plan, mut timing: Timing) -> Result<Solution> {
    let mut best: Option<Solution> = None;
    let mut residual = stop_at(request);
    if !bat.fixtures().none_moving() {
        // Two frequencies may be the same, and then are no nearer to the truth than the residual.
        residual = residual.min(request.tolerance).max(CONVERGED);
    }
    for round in 0..MOST_ROUNDS {
        let task = Task { bat, plan: &plan, request, residual };
        let answer = match (task.run(&mut timing), &mut best) {
            (Ok(answer), _) => answer,
            (Err(error), Some(best)) => {
                // The answer before this refinement stands.
                best.stopped = Some(error.to_string());
                break;
            }
            (Err(error), None) => return Err(error),
        };
        let again = request.solver == Solver::Statics && residual > CONVERGED;
        if again && answer.none_missing != Some(true) {
            // Two modes of nearly one frequency mix, or one is missing: iterate to the end.
            residual = CONVERGED;
            continue;
        }
        let (solution, defects) = answer.solution(plan, request, timing);
        let gain = best.as_ref().map_or(0.0, |best| solution.worst() / best.worst());
        let done = solution.met
            || request.elements.is_some()
            || solution.round_off() > request.tolerance
            || (round > 2 && gain > STALLED);
        let next = (!done).then(|| {
            let plan =
                Plan { mesh: solution.mesh.clone(), degree: solution.degree, ..Plan::default() };
            plan.refined(bat, &defects, request.tolerance, request.degree.is_none())
        });
        if solution.met || best.is_none() || gain < 1.0 {
            best = Some(solution);
        }
        let Some(next) = next else { break };
        let last = (round + 1 == MOST_ROUNDS)
            .then(|| format!("{MOST_ROUNDS} refinements were not enough"));
        if let Some(stopped) = request.too_large(bat, &next).or(last) {
            best.iter_mut().for_each(|best| best.stopped = Some(stopped.clone()));
            break;
        }
        plan = next;
    }
    Ok(best.expect("there was a round"))
}

/// The most accurate answer that a time allows: one digit after the other, until the next would
/// take too long by the time that the last took. The first digit is given in any case, `met` false
/// if it took longer.
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
    let (mut best, mut first) = (None::<Solution>, Duration::ZERO);
    for digits in 1..=14 {
        let begun = Clock::start();
        let digit = Request { tolerance: 10f64.powi(-digits), elements: None, ..*request };
        let solution = match solve(bat, &digit) {
            Ok(solution) => solution,
            // A digit that cannot be had ends the search, not the answer.
            Err(_) if best.is_some() => break,
            Err(error) => return Err(error),
        };
        let (last, spent) = (begun.elapsed(), started.elapsed());
        if best.is_none() {
            first = spent;
        }
        let better = best.as_ref().is_none_or(|best| solution.worst() < best.worst());
        let over = spent + last + last / 2 > budget || !solution.met;
        if better && (spent <= budget || best.is_none()) {
            best = Some(Solution { met: spent <= budget && solution.complete(), ..solution });
        }
        if over {
            break;
        }
    }
    let mut best = best.expect("there was a first digit");
    best.reason = Reason::Budget(budget);
    if first > budget {
        best.stopped = Some(format!("the first digit took {first:?}, {budget:?} were allowed"));
    }
    Ok(best)
}
