//! What are the modes of a prepared bat, as accurately as asked?
//!
//! [`refine`](fn@refine) plans, solves, checks the errors and refines, with the theory that the request names.

use std::sync::OnceLock;

use crate::base::{Clock, Error, Result};
use crate::bat::Bat;
use crate::modes::damping::damping;
use crate::modes::plan::Plan;
use crate::modes::referee::Solver;
use crate::modes::request::{CONVERGED, Request, stop_at, wanted};
use crate::modes::solution::{Ending, Solution, Timing};
use crate::modes::task::Task;

/// A refinement that leaves more than this share of the error has stalled.
const STALLED: f64 = 0.7;
/// Most refinements before the result is returned as it is.
const MOST_ROUNDS: usize = 12;

/// A function called with every bat that is solved alone (not those of a batch) and its request. A test sets it, to
/// check that no bat is solved twice in the same way.
#[doc(hidden)]
pub static SOLVED: OnceLock<fn(&Bat, &Request)> = OnceLock::new();

/// Finds the lowest bending modes of a bat with the theory that the request names, without fitting the moduli to a tap.
///
/// # Errors
///
/// As [`crate::modes::solve::solve`].
pub(crate) fn refine(bat: &Bat, request: &Request) -> Result<Solution> {
    request.check(1)?;
    if request.theory.shears() && !bat.knows_shear() {
        let found = format!("timoshenko, but {} has no shear modulus", bat.without_shear());
        let expected = "\"shear_modulus\" or \"poisson_ratio\" there, or a theory without shear";
        return Err(Error::value("theory", found, expected));
    }
    if let Some(told) = SOLVED.get() {
        told(bat, request);
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
    let found = refined(bat, request, plan, timing)?;
    damped(bat, request, by_other_elements(bat, request, found))
}

/// A solution that refinement did not bring within its tolerance, as may happen on a coarse mesh beside a sharp step,
/// is replaced by that on the elements for a smaller tolerance if this one is within it.
fn by_other_elements(bat: &Bat, request: &Request, found: Solution) -> Solution {
    /// Divisors of the tolerance, tried in this order.
    const FINER: [f64; 3] = [30.0, 300.0, 3000.0];
    /// Elements are not planned for a smaller tolerance.
    const LEAST: f64 = 1e-10;
    if found.met() || request.elements.is_some() || found.round_off() > request.tolerance {
        return found;
    }
    let other = |finer: f64| {
        let finer = Request { tolerance: request.tolerance / finer, ..*request };
        if finer.tolerance < LEAST {
            return None;
        }
        let plan = Plan::cheapest(bat, &wanted(&finer));
        if plan.unknowns() < request.modes || request.too_large(bat, &plan).is_some() {
            return None;
        }
        refined(bat, request, plan, found.timing).ok().filter(Solution::met)
    };
    FINER.into_iter().find_map(other).unwrap_or(found)
}

/// The error for a bat of which not even one mode can be found, because its thinnest part is so much softer than the
/// rest that the numbers cannot represent both, as for the point of `x^1.75`; otherwise the given error.
fn beyond_numbers(bat: &Bat, error: Error) -> Error {
    let Error::NotConverged { converged: 0, .. } = error else { return error };
    let stations = &bat.profile().stations;
    let radii = stations.outer.iter().copied();
    let (thin, thick) = radii.fold((f64::INFINITY, 0.0_f64), |(a, b), r| (a.min(r), b.max(r)));
    /// The fourth powers of radii this far apart differ by 16 digits.
    const APART: f64 = 1e-4;
    if thin > APART * thick {
        return error;
    }
    let thin = if thin > 0.0 { format!("{thin:.1e} m thin") } else { "a point".to_owned() };
    let found = format!(
        "a bat that is {thin} at its thinnest and {thick:.1e} m elsewhere: the compliances of both do not \
         fit in one number"
    );
    let expected = "a point that is cut off, or one of a shape nearer to a cone";
    Error::value("profile", found, expected)
}

/// The solution with its damping.
pub(super) fn damped(bat: &Bat, request: &Request, mut best: Solution) -> Result<Solution> {
    best.damping = damping(bat, best.elements(), &best.modes, request.tolerance)?;
    let damped = best.damping.modes.iter().map(|damped| damped.error).fold(0.0, f64::max);
    if best.met() && damped > request.tolerance {
        best.ending = Ending::Stopped(format!("the damped motions are known to {damped:.1e} only"));
    }
    Ok(best)
}

/// The best solution with this plan and the plans that follow from its errors.
fn refined(bat: &Bat, request: &Request, mut plan: Plan, mut timing: Timing) -> Result<Solution> {
    let mut best: Option<Solution> = None;
    let mut residual = stop_at(request);
    if !bat.fixtures().none_moving() {
        // Two frequencies may coincide; their error is then as large as the residual, not its square.
        residual = residual.min(request.tolerance).max(CONVERGED);
    }
    for round in 0..MOST_ROUNDS {
        let task = Task { bat, plan: &plan, request, residual };
        let answer = match (task.run(&mut timing), &mut best) {
            (Ok(answer), _) => answer,
            (Err(error), Some(best)) => {
                // The result before this refinement is kept.
                best.stop(error.to_string());
                break;
            }
            (Err(error), None) => return Err(beyond_numbers(bat, error)),
        };
        let again = request.solver == Solver::Statics && residual > CONVERGED;
        if again && !answer.complete {
            // Two modes of nearly one frequency are mixed, or one is missing: iterate to the end.
            residual = CONVERGED;
            continue;
        }
        let (solution, defects) = answer.solution(plan, request, timing);
        let gain = best.as_ref().map_or(0.0, |best| solution.worst() / best.worst());
        let done = solution.met()
            || request.elements.is_some()
            || solution.round_off() > request.tolerance
            || (round > 2 && gain > STALLED);
        let next = (!done).then(|| {
            let plan =
                Plan { mesh: solution.mesh.clone(), degree: solution.degree, ..Plan::default() };
            plan.refined(bat, &defects, request.tolerance, request.degree.is_none())
        });
        if solution.met() || best.is_none() || gain < 1.0 {
            best = Some(solution);
        }
        let Some(next) = next else { break };
        let last = (round + 1 == MOST_ROUNDS)
            .then(|| format!("{MOST_ROUNDS} refinements were not enough"));
        if let Some(stopped) = request.too_large(bat, &next).or(last) {
            best.iter_mut().for_each(|best| best.stop(stopped.clone()));
            break;
        }
        plan = next;
    }
    Ok(best.expect("there was a round"))
}
