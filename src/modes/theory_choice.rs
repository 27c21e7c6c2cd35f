//! Which theory does the question need?
//!
//! [`theory`] finds the cheapest whose error is below the tolerance.

use crate::base::error::Result;
use crate::bat::body::Bat;
use crate::bat::theory::Theory;
use crate::modes::refine::refine;
use crate::modes::request::Request;
use crate::modes::shifts::{Shift, shifts, solved_shifts, with_typical_shear};

/// A theory, and what a person should know about the choice.
#[derive(Debug, Clone, PartialEq)]
pub struct Choice {
    /// The chosen theory.
    pub theory: Theory,
    /// A warning that shear matters but no shear modulus is known; None otherwise.
    pub warning: Option<String>,
}

/// The cheapest theory with which every wanted frequency is within the request's tolerance of what
/// all effects together make it; without shear where a shear modulus is not known.
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
    // What cannot be asked is refused before any work.
    request.check(1)?;
    let known = bat.knows_shear();
    // Shear and rotary inertia cost the fast modes most: where a few slow ones need both, all do.
    if known && request.modes > FEW {
        let few = Request { modes: FEW, ..*request };
        if costs(bat, &few)?.far_above(request.tolerance) {
            return Ok(Choice { theory: Theory::Timoshenko, warning: None });
        }
    }
    let Costs { both, shear, first } = costs(bat, request)?;
    let theory = match (both > request.tolerance, shear > request.tolerance) {
        (true, true) if known => Theory::Timoshenko,
        (true, _) => Theory::Rayleigh,
        (false, _) => Theory::EulerBernoulli,
    };
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

/// The theory that a request names, or [`theory`]'s choice where it leaves it open.
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

/// So many modes may show that every effect is needed: of a wooden bat at 1e-4 they do.
const FEW: usize = 3;
/// An estimate of the first order decides only where it is that many times the tolerance, or as
/// many times below it.
const FAR: f64 = 2.0;

/// How much too high frequencies are without an effect, relative, the largest of the modes.
struct Costs {
    /// Without rotary inertia and, where it is known, shear.
    both: f64,
    /// Without shear; with a typical shear modulus where none is known.
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

    /// Whether one of them is so near to the tolerance that an estimate does not tell.
    fn near(&self, tolerance: f64) -> bool {
        let near = |cost: f64| FAR * cost > tolerance && cost < FAR * tolerance;
        near(self.both) || near(self.shear)
    }

    fn far_above(&self, tolerance: f64) -> bool {
        self.both > FAR * tolerance && self.shear > FAR * tolerance
    }
}

/// The costs of the theories on that bat, by the plain beam's modes where these tell enough.
fn costs(bat: &Bat, request: &Request) -> Result<Costs> {
    /// The shifts are to be known to a part of themselves.
    const ROUGH: f64 = 1e-2;
    /// No shift below that can be told from round-off.
    const FINEST: f64 = 1e-11;
    let Request { modes, tolerance, .. } = *request;
    let plain = Request { modes, tolerance: tolerance.max(ROUGH), ..Request::plain() };
    let solution = refine(bat, &plain)?;
    let known = bat.knows_shear();
    let shearing = with_typical_shear(bat);
    let accuracy = (0.1 * tolerance).clamp(FINEST, ROUGH);
    let found = Costs::of(&shifts(&shearing, &solution.modes, accuracy), known);
    if !bat.fixtures().none_moving() || !found.near(tolerance) {
        return Ok(found);
    }
    let solved = solved_shifts(&shearing, modes, accuracy);
    Ok(solved.map_or(found, |solved| Costs::of(&solved, known)))
}

/// A percentage in two digits.
fn two_digits(value: f64) -> f64 {
    format!("{value:.1e}").parse().unwrap_or(value)
}
