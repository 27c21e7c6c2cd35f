//! Which theory does a question need?
//!
//! [`theory`] finds the cheapest theory whose error is below the tolerance.

use std::borrow::Cow;

use crate::base::Result;
use crate::bat::{Bat, Theory};
use crate::modes::refine::refine;
use crate::modes::request::Request;
use crate::modes::shifts::{Shift, shifts, solved_shifts, with_typical_shear};

/// A theory, and a warning about the choice if there is one.
#[derive(Debug, Clone, PartialEq)]
pub struct Choice {
    /// The chosen theory.
    pub theory: Theory,
    /// A warning that shear matters but no shear modulus is known; None otherwise.
    pub warning: Option<String>,
}

/// The cheapest theory for which every wanted frequency is within the request's tolerance of that with all effects;
/// without shear if a shear modulus is not known.
///
/// ```
/// use sweetspot::modes::theory_choice::theory;
/// use sweetspot::{Bat, Request, Theory};
///
/// # fn main() -> sweetspot::Result<()> {
/// # let bat = Bat::builtin("r161")?;
/// let choice = theory(&bat, &Request::default())?;
/// assert_eq!(choice.theory, Theory::Timoshenko); // shear counts at 1e-4
/// # Ok(())
/// # }
/// ```
///
/// # Errors
///
/// Those of [`crate::modes::solve::solve`].
pub fn theory(bat: &Bat, request: &Request) -> Result<Choice> {
    // An impossible request is refused before any work.
    request.check(1)?;
    // Without a mode, that of the first: a rigid bat recoils with the inertia of its sections too.
    let (asked, request) = (request.modes, &Request { modes: request.modes.max(1), ..*request });
    let known = bat.knows_shear();
    // Shear and rotary inertia affect the fast modes most: if a slow one needs both, all do.
    if known && request.modes > FEW {
        let few = Request { modes: FEW, ..*request };
        if costs(bat, &few, FEW - 1)?.far_above(request.tolerance) {
            return Ok(Choice { theory: Theory::Timoshenko, warning: None });
        }
    }
    let Costs { both, shear, first } = costs(bat, request, 0)?;
    let theory = match (both > request.tolerance, shear > request.tolerance) {
        (true, true) if known => Theory::Timoshenko,
        (true, _) => Theory::Rayleigh,
        (false, _) => Theory::EulerBernoulli,
    };
    let warning = (!known && asked > 0 && shear > request.tolerance).then(|| {
        format!(
            "shear is left out, because a material has no \"shear_modulus\"; with the G/E of its \
             kind mode 1 is {} % too high without it, and one of the modes {} %",
            two_digits(100.0 * first),
            two_digits(100.0 * shear)
        )
    });
    Ok(Choice { theory, warning })
}

/// The theory that a request names, or the choice of [`theory`] if it names none.
///
/// # Errors
///
/// As [`theory`].
pub fn of(bat: &Bat, request: &Request) -> Result<Theory> {
    match request.theory {
        Theory::Auto => Ok(theory(bat, request)?.theory),
        named => Ok(named),
    }
}

/// The mode that may show that every effect is needed; for a wooden bat at 1e-4 it does.
const FEW: usize = 3;
/// A first-order estimate decides only if it is more than this many times above or below the tolerance.
const FAR: f64 = 2.0;

/// Relative excess of the frequencies without an effect, the largest of the modes.
struct Costs {
    /// Without rotary inertia and, if known, shear.
    both: f64,
    /// Without shear; with a typical shear modulus if it is not known.
    shear: f64,
    /// Mode 1 without shear.
    first: f64,
}

impl Costs {
    fn of(shifts: &[Shift], known: bool) -> Self {
        let most = |rotary: bool, shear: bool| {
            shifts.iter().map(|shift| shift.cost(rotary, shear).abs()).fold(0.0, f64::max)
        };
        let first = shifts.first().map_or(0.0, |shift| shift.cost(false, true));
        Self { both: most(true, known), shear: most(false, true), first }
    }

    /// Whether one of them is too close to the tolerance for an estimate.
    fn near(&self, tolerance: f64) -> bool {
        let near = |cost: f64| FAR * cost > tolerance && cost < FAR * tolerance;
        near(self.both) || near(self.shear)
    }

    fn far_above(&self, tolerance: f64) -> bool {
        self.both > FAR * tolerance && self.shear > FAR * tolerance
    }
}

/// The excess frequencies of the theories on that bat, from the plain beam's modes if these are accurate enough: on a
/// bat without moving fixtures those of the modes from `first` on.
fn costs(bat: &Bat, request: &Request, first: usize) -> Result<Costs> {
    /// Relative accuracy of the shifts.
    const ROUGH: f64 = 1e-2;
    /// A smaller shift cannot be distinguished from round-off.
    const FINEST: f64 = 1e-11;
    let Request { modes, tolerance, .. } = *request;
    let plain = Request { modes, tolerance: tolerance.max(ROUGH), ..Request::plain() };
    let solution = refine(bat, &plain)?;
    let known = bat.knows_shear();
    let shearing = if known { Cow::Borrowed(bat) } else { Cow::Owned(with_typical_shear(bat)) };
    let accuracy = (0.1 * tolerance).clamp(FINEST, ROUGH);
    let bare = bat.fixtures().none_moving();
    let counted = solution.modes.get(first..).filter(|_| bare).unwrap_or(&solution.modes);
    let found = Costs::of(&shifts(&shearing, counted, accuracy), known);
    if !bare || !found.near(tolerance) {
        return Ok(found);
    }
    let solved = solved_shifts(&shearing, modes, accuracy);
    Ok(solved.map_or(found, |solved| Costs::of(&solved, known)))
}

/// A percentage with two digits.
fn two_digits(value: f64) -> f64 {
    format!("{value:.1e}").parse().unwrap_or(value)
}
