//! How many bending modes a bat has up to a frequency.

use std::f64::consts::TAU;

use crate::base::{Error, Result};
use crate::bat::{Bat, Theory};
use crate::beam::{Mesh, count};
use crate::modes::pairs::pairs_of;
use crate::modes::plan::{Plan, Wanted};
use crate::modes::prepared::{Prepared, prepare};
use crate::modes::refine::refine;
use crate::modes::request::MOST_MODES;
use crate::modes::solve::{Request, Solver};

/// Most modes that are listed.
pub const MOST: usize = MOST_MODES;
/// The highest limit (Hz), far above the range of beam theory.
const HIGHEST: f64 = 1e9;
/// Relative accuracy of the frequencies for the count.
const ACCURACY: f64 = 1e-6;
/// The name in an error.
const FIELD: &str = "frequency limit";

/// The number of bending modes with a frequency of at most `limit` (Hz). A solution of the request with that number of
/// modes has none above the limit, and the next mode is above it.
///
/// The modes below the limit are counted on a mesh that is accurate for that many modes ([`count`]), so that none is
/// missed. Only if a mode is closer to the limit than the request's tolerance, or the request prescribes the elements,
/// the bat is solved to find on which side the result lies.
///
/// ```
/// use sweetspot::modes::up_to::modes_up_to;
/// use sweetspot::{Bat, Request, solve};
///
/// # fn main() -> sweetspot::Result<()> {
/// # let bat = Bat::builtin("r161")?;
/// let modes = modes_up_to(&bat, &Request::default(), 2000.0)?;
/// let solution = solve(&bat, &Request { modes, ..Request::default() })?;
/// assert!(solution.modes.iter().all(|mode| mode.frequency() <= 2000.0));
/// # Ok(())
/// # }
/// ```
///
/// # Errors
///
/// [`Error::Value`] for a limit that is not above 0 or has more than [`MOST`] modes below it; those
/// of [`crate::modes::solve::solve`].
pub fn modes_up_to(bat: &Bat, request: &Request, limit: f64) -> Result<usize> {
    if !(limit > 0.0 && limit <= HIGHEST) {
        let expected = format!("a frequency above 0, {HIGHEST:e} Hz at most");
        return Err(Error::value(FIELD, format!("{limit:?} Hz"), expected));
    }
    request.check(1)?;
    let mut ready = prepare(bat, request)?;
    let mut modes = slower_modes(&ready, limit)?;
    // This number of modes may need another theory than the requested number; at most one change to each next theory.
    for _ in Theory::ALL.iter().filter(|_| request.theory == Theory::Auto) {
        let again = prepare(bat, &Request { modes, ..*request })?;
        if again.request.theory <= ready.request.theory {
            break;
        }
        ready = again;
        modes = slower_modes(&ready, limit)?;
    }
    Ok(modes)
}

/// The number of bending modes up to the limit, with the theory that the request names.
fn slower_modes(Prepared { bat, request, .. }: &Prepared, limit: f64) -> Result<usize> {
    let margin = (3.0 * request.tolerance).clamp(10.0 * ACCURACY, 0.5);
    let counts =
        [1.0 - margin, 1.0 + margin].map(|near| counted(bat, request.theory, limit * near));
    let [Some(surely), Some(mut modes)] = counts else {
        let found = format!("{limit} Hz, with more than {MOST} bending modes below it");
        return Err(Error::value(FIELD, found, "a lower frequency"));
    };
    if surely == modes && request.elements.is_none() {
        return Ok(modes);
    }
    loop {
        let solution = refine(bat, &Request { modes, ..*request })?;
        let below = solution.modes.iter().filter(|mode| mode.frequency() <= limit).count();
        if below == modes {
            return Ok(modes);
        }
        modes = below;
    }
}

/// The number of bending modes below the limit (Hz), on meshes for more and more modes until one is fine enough for all
/// of them. `None` for more than [`MOST`], and for a limit so far above the bat's frequencies that they cannot be
/// counted there.
fn counted(bat: &Bat, theory: Theory, limit: f64) -> Option<usize> {
    const FIRST: usize = 16;
    let most_unknowns = Solver::Statics.most_unknowns();
    let mut modes = FIRST;
    while modes <= MOST {
        let degree = Some(DEGREE);
        let wanted = Wanted { modes, tolerance: ACCURACY, degree, most_unknowns, theory };
        let mesh = Plan::cheapest(bat, &wanted).mesh;
        let slower = slower(bat, &mesh, theory, limit)?;
        if slower <= modes {
            return Some(slower);
        }
        modes = (2 * modes).min(MOST).max(slower);
    }
    None
}

/// Degree of the elements for the count.
const DEGREE: usize = 7;

/// Number of bending modes below the limit on that mesh.
fn slower(bat: &Bat, mesh: &Mesh, theory: Theory, limit: f64) -> Option<usize> {
    let mut pairs = pairs_of(bat, DEGREE, theory);
    pairs.assemble(bat, mesh);
    let view = pairs.view();
    // The count fails at a frequency that equals the mesh's own to the last digit; a nearby one works.
    let nearby = (0..8).map(|k| TAU * limit * (1.0 + 1e-13 * f64::from(k * k)));
    let all = nearby.into_iter().find_map(|omega| count::slower(&view, omega))?;
    Some(all.saturating_sub(view.rigid_modes()))
}
