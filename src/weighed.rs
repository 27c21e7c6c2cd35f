//! A bat as stiff as a tap says: one factor on all its moduli.

use crate::bat::Bat;
use crate::error::{Error, Result};
use crate::solve::{Request, solve};
use crate::theory::Theory;

/// The bat, as described, with one factor on every E and G, so that its first mode has the
/// frequency that was tapped; as it is if none was.
///
/// A free bat's frequencies go as the root of the factor, and one step finds it; springs to ground
/// do not grow with it, and then the step is repeated.
///
/// # Errors
///
/// [`Error::Value`] where no factor gives that frequency; those of [`solve`].
pub fn tuned(mut bat: Bat, theory: Theory, tolerance: f64) -> Result<Bat> {
    const MOST_STEPS: usize = 40;
    let Some(tapped) = bat.weighed.first_bending else { return Ok(bat) };
    let tolerance = (0.01 * tolerance).clamp(1e-12, 1e-6);
    let request = Request { modes: 1, tolerance, theory, ..Request::default() };
    let mut last = 0.0;
    for _ in 0..MOST_STEPS {
        let solution = solve(&bat, &request)?;
        let found = solution.modes[0].frequency();
        last = found;
        let ratio = tapped / found;
        if (ratio - 1.0).abs() <= 2.0 * tolerance {
            return Ok(bat);
        }
        bat.scale(1.0, ratio * ratio);
        if !(1e-6..1e6).contains(&bat.factors[1]) {
            break;
        }
    }
    let found =
        format!("{tapped} Hz; the stiffness has little hold on it, {last:.3} Hz was reached");
    let expected = "a first bending frequency that a stiffer or softer bat can have";
    Err(Error::value("weighed.first_bending_hz", found, expected))
}
