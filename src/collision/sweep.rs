//! Hits along a bat, with modes as good as the wanted exit speeds need.

use crate::bat::Bat;
use crate::collision::hit::{Hitter, Impact, Model, Scene};
use crate::collision::sweet_spot::{Peak, SweetSpot};
use crate::error::Result;
use crate::solve::{Request, Solution, solve};

/// The impacts along a bat, and its sweet spot.
#[derive(Debug, Clone)]
pub struct Sweep {
    pub solution: Solution,
    pub impacts: Vec<Impact>,
    pub spot: SweetSpot,
    /// Where the same bat would be best if it did not bend.
    pub rigid_best: Option<Peak>,
    /// Energy left in vibration (J) by a hit there, and by one at the sweet spot.
    pub vibration_at_bests: Option<[f64; 2]>,
    /// Whether every exit speed is within the tolerance by its own estimate.
    pub met: bool,
}

/// Strikes the bat at all places (m); the request's tolerance is the allowed error of the exit
/// speed relative to the closing speed, unless the request fixes the elements.
///
/// # Errors
///
/// As [`solve`].
pub fn sweep(
    bat: &Bat,
    model: Model,
    scene: &Scene,
    request: &Request,
    places: &[f64],
) -> Result<Sweep> {
    let mut asked = *request;
    let mut solution = solve(bat, &asked)?;
    loop {
        let hitter = Hitter::new(model, scene, bat, &solution);
        let impacts: Vec<Impact> = places.iter().map(|x| hitter.strike(*x)).collect();
        let errors = impacts.iter().filter_map(|i| i.outcome.as_ref()).map(|o| o.error);
        // An error that is not a number is none to pass over.
        let worst = errors.fold(0.0, |worst, e| if e <= worst { worst } else { e });
        let met = worst <= request.tolerance;
        if !met && request.elements.is_none() && asked.tolerance >= 1e-13 {
            // The exit speed is more sensitive than the frequencies: ask these for more.
            asked.tolerance *= (0.3 * request.tolerance / worst).clamp(1e-6, 0.1);
            // Where more cannot be had, this answer stands.
            if let Ok(finer) = solve(bat, &asked) {
                solution = finer;
                continue;
            }
        }
        let spot = SweetSpot::find(bat, scene, &solution, &hitter);
        let rigid = Hitter::new(Model::Rigid, scene, bat, &solution);
        let rigid_best = SweetSpot::find(bat, scene, &solution, &rigid).exit_speed_max;
        let at = |peak: Option<Peak>| hitter.vibration(peak?.x);
        let vibration_at_bests = at(rigid_best).zip(at(spot.exit_speed_max)).map(|(a, b)| [a, b]);
        return Ok(Sweep { impacts, spot, rigid_best, vibration_at_bests, met, solution });
    }
}
