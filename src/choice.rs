//! Which theory the question needs: the cheapest whose error is below the tolerance.

use crate::bat::Bat;
use crate::error::Result;
use crate::ignored::{shifts, with_typical_shear};
use crate::solve::{Request, solve};
use crate::theory::Theory;

/// A theory, and what a person should know about the choice.
#[derive(Debug, Clone, PartialEq)]
pub struct Choice {
    pub theory: Theory,
    /// That shear matters and is not known, if so.
    pub warning: Option<String>,
}

/// The cheapest theory whose estimated shift of every wanted frequency is within the request's
/// tolerance; without shear where a shear modulus is not known.
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
    let (mut rotary, mut shear) = (0.0_f64, 0.0_f64);
    let mut first = 0.0;
    let accuracy = (0.1 * request.tolerance).clamp(FINEST, ROUGH);
    for (k, shift) in shifts(&shearing, &solution.modes, accuracy).iter().enumerate() {
        rotary = rotary.max(shift.rotary_inertia.abs());
        shear = shear.max(shift.shear.unwrap_or(0.0).abs());
        if k == 0 {
            first = shift.shear.unwrap_or(0.0);
        }
    }
    let theory = match (shear > request.tolerance, rotary > request.tolerance) {
        (true, _) if known => Theory::Timoshenko,
        (_, true) => Theory::Rayleigh,
        _ => Theory::EulerBernoulli,
    };
    let warning = (!known && shear > request.tolerance).then(|| {
        format!(
            "shear is left out, because a material has no \"shear_modulus\"; with the G/E of its \
             kind it would lower mode 1 by {} % and one of the modes by {} %",
            two_digits(-100.0 * first),
            two_digits(100.0 * shear)
        )
    });
    Ok(Choice { theory, warning })
}

/// A percentage in two digits.
fn two_digits(value: f64) -> f64 {
    format!("{value:.1e}").parse().unwrap_or(value)
}
