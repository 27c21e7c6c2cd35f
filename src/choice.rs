//! Which theory does the question need?
//!
//! [`theory`] finds the cheapest whose error is below the tolerance.

use crate::bat::Bat;
use crate::error::Result;
use crate::ignored::{Shift, shifts, solved_shifts, with_typical_shear};
use crate::solve::{Request, solve};
use crate::theory::Theory;

/// A theory, and what a person should know about the choice.
#[derive(Debug, Clone, PartialEq)]
pub struct Choice {
    /// The theory.
    pub theory: Theory,
    /// That shear matters and is not known, if so.
    pub warning: Option<String>,
}

/// The cheapest theory with which every wanted frequency is within the request's tolerance of what
/// all effects together make it; without shear where a shear modulus is not known.
///
/// # Errors
///
/// Those of [`solve`].
pub fn theory(bat: &Bat, request: &Request) -> Result<Choice> {
    /// The shifts are to be known to a part of themselves.
    const ROUGH: f64 = 1e-2;
    /// No shift below that can be told from round-off.
    const FINEST: f64 = 1e-11;
    // What cannot be asked is refused before any work.
    request.check(1)?;
    let tolerance = request.tolerance.max(ROUGH);
    let plain = Request { modes: request.modes, tolerance, ..Request::default() };
    let solution = solve(bat, &plain)?;
    let known = bat.knows_shear();
    let shearing = with_typical_shear(bat);
    let accuracy = (0.1 * request.tolerance).clamp(FINEST, ROUGH);
    let mut found = shifts(&shearing, &solution.modes, accuracy);
    let most = |found: &[Shift], rotary: bool, shear: bool| {
        found.iter().map(|shift| shift.cost(rotary, shear).abs()).fold(0.0, f64::max)
    };
    // An estimate of the first order decides only where it is far from the tolerance.
    let near = |cost: f64| cost > 0.5 * request.tolerance && cost < 2.0 * request.tolerance;
    let costs = |found: &[Shift]| [most(found, true, known), most(found, false, true)];
    if bat.fixtures.none_moving()
        && costs(&found).into_iter().any(near)
        && let Some(solved) = solved_shifts(&shearing, request.modes, accuracy)
    {
        found = solved;
    }
    let [both, shear] = costs(&found);
    let theory = match (both > request.tolerance, shear > request.tolerance) {
        (true, true) if known => Theory::Timoshenko,
        (true, _) => Theory::Rayleigh,
        (false, _) => Theory::EulerBernoulli,
    };
    let first = found.first().map_or(0.0, |shift| shift.cost(false, true));
    let warning = (!known && shear > request.tolerance).then(|| {
        format!(
            "shear is left out, because a material has no \"shear_modulus\"; with the G/E of its \
             kind mode 1 is {} % too high without it, and one of the modes {} %",
            two_digits(100.0 * first),
            two_digits(100.0 * shear)
        )
    });
    Ok(Choice { theory, warning })
}

/// A percentage in two digits.
fn two_digits(value: f64) -> f64 {
    format!("{value:.1e}").parse().unwrap_or(value)
}
