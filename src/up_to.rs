//! How many bending modes a bat has up to a frequency.

use std::f64::consts::TAU;

use crate::bat::Bat;
use crate::beam::count;
use crate::beam::mesh::Mesh;
use crate::beam::statics::Statics;
use crate::error::{Error, Result};
use crate::plan::{Plan, Wanted};
use crate::solve::{Request, Solver, solve};

/// More modes than that are not listed.
pub const MOST: usize = 1000;
/// Frequencies to ask for (Hz), far above all that a beam describes.
const HIGHEST: f64 = 1e9;

/// The number of bending modes whose frequency is at most `limit` (Hz), by the theory of the
/// request: the request with so many modes has a solution with none above it, and the next mode is
/// above.
///
/// On a mesh that knows so many modes as well as asked, the motions slower than the limit are
/// counted ([`count`]): none can be missing. A mode that is on the limit to within its error may be
/// on either side of it.
///
/// # Errors
///
/// [`Error::Value`] for a limit that is not above 0 or has more than [`MOST`] modes below it; those
/// of [`solve`].
pub fn modes_up_to(bat: &Bat, request: &Request, limit: f64) -> Result<usize> {
    if !(limit > 0.0 && limit <= HIGHEST) {
        let expected = format!("a frequency above 0, {HIGHEST:e} Hz at most");
        return Err(Error::value("frequency limit", format!("{limit:?} Hz"), expected));
    }
    request.check(1)?;
    let mut modes = counted(bat, request, limit)?;
    // The mesh of the answer is another one, where a mode on the limit may be above it.
    loop {
        let solution = solve(bat, &Request { modes, ..*request })?;
        let below = solution.modes.iter().filter(|mode| mode.frequency() <= limit).count();
        if below == modes {
            return Ok(modes);
        }
        modes = below;
    }
}

/// The bending modes slower than the limit on meshes for more and more modes, until one mesh is fine
/// enough for all that are slower on it.
fn counted(bat: &Bat, request: &Request, limit: f64) -> Result<usize> {
    const FIRST: usize = 16;
    /// Whoever asks for less still wants all modes.
    const ROUGHEST: f64 = 1e-6;
    let mut wanted = Wanted {
        modes: FIRST,
        tolerance: request.tolerance.min(ROUGHEST),
        degree: Some(DEGREE),
        most_unknowns: Solver::Statics.most_unknowns(),
        theory: request.theory,
    };
    loop {
        let mesh = Plan::cheapest(bat, &wanted).mesh;
        let slower = match request.theory.shears() {
            true => slower::<{ DEGREE + 1 }, { 2 * DEGREE }>(bat, &mesh, request, limit)?,
            false => slower::<{ DEGREE + 1 }, { DEGREE + 1 }>(bat, &mesh, request, limit)?,
        };
        match slower {
            slower if slower <= wanted.modes => return Ok(slower),
            _ if wanted.modes < MOST => wanted.modes = (2 * wanted.modes).max(slower).min(MOST),
            _ => {
                let found = format!("{limit} Hz, with more than {MOST} bending modes below it");
                return Err(Error::value("frequency limit", found, "a lower frequency"));
            }
        }
    }
}

/// Degree of the elements on which is counted.
const DEGREE: usize = 7;

/// How many bending modes are slower than the limit on that mesh.
fn slower<const N: usize, const W: usize>(
    bat: &Bat,
    mesh: &Mesh,
    request: &Request,
    limit: f64,
) -> Result<usize> {
    let mut statics = Statics::<f64, N, W>::empty(bat, request.theory);
    statics.assemble(&[bat], &[mesh]);
    // A frequency that is the mesh's own to the last digit cannot be counted at, the next one can.
    let nearby = (0..8).map(|k| TAU * limit * (1.0 + 1e-13 * f64::from(k * k)));
    let all = nearby.into_iter().find_map(|omega| count::slower(&statics, omega));
    let Some(all) = all else {
        let found = format!("{limit} Hz, at which motions cannot be counted");
        return Err(Error::value("frequency limit", found, "one a little higher or lower"));
    };
    Ok(all.saturating_sub(statics.rigid_modes()))
}
