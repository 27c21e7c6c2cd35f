//! How fast does a ball leave many bats, computed as fast as possible?
//!
//! [`each`] gives for every bat what [`sweep`](fn@crate::collision::sweep::sweep) gives. The modes of the first round
//! are computed in the lanes of [`crate::modes::batch`].

use std::borrow::Cow;

use crate::base::{Result, nobody};
use crate::bat::Bat;
use crate::collision::sweep::{Accuracy, Round, Sweep, Trial};
use crate::modes::batch::{Way, solutions};
use crate::modes::prepared::{Prepared, prepare};
use crate::modes::solve::Request;

/// A bat that is to be hit.
#[derive(Debug, Clone, Copy)]
pub struct Blow<'a> {
    /// The bat.
    pub bat: &'a Bat,
    /// Collision model, swing, pitch and ball.
    pub trial: Trial<'a>,
    /// Wanted accuracy of the exit speeds.
    pub accuracy: Accuracy,
    /// Impact points (m from the knob end).
    pub places: &'a [f64],
}

/// Strikes every bat and passes the result to `visit` with the bat's index. Bats whose exit speeds need the same modes
/// are solved one after the other.
///
/// The hits on a bat depend on the bat, its blow and `model` (a similar bat), not on the other bats of the batch.
///
/// ```
/// use sweetspot::collision::batch::{Blow, each};
/// use sweetspot::collision::sweep::{Accuracy, Trial};
/// use sweetspot::collision::{Model, Scene};
/// use sweetspot::modes::batch::Way;
/// use sweetspot::Bat;
///
/// # fn main() -> sweetspot::Result<()> {
/// # let text = r#"{ "format": "sweetspot-bat/1", "material": "white-ash-dynamic",
/// #     "profile": { "unit": "in", "x": [0, 6, 20, 27, 33], "diameter": [1.0, 0.9, 1.6, 2.4, 2.5] } }"#;
/// # let bat = Bat::from_text("bat.json", text, "".as_ref())?;
/// let lighter = |k: i32| bat.with(|parts| parts.material.density *= 0.99_f64.powi(k));
/// let bats: Vec<Bat> = (0..16).map(lighter).collect::<sweetspot::Result<_>>()?;
/// let scene = Scene { swing: 45.0, ball_speed: 38.0, ..Scene::default() }; // rad/s, m/s
/// let (trial, accuracy) = (Trial { model: Model::Contact, scene: &scene }, Accuracy::default());
/// let blow = |bat| Blow { bat, trial, accuracy, places: &[0.7] };
/// let blows: Vec<Blow> = bats.iter().map(blow).collect();
/// each(&bat, &blows, Way::SideBySide, |k, hits| {
///     let outcome = hits.unwrap().impacts[0].outcome.clone().expect("they meet");
///     println!("bat {k}: {:.2} m/s", outcome.exit_speed);
/// });
/// # Ok(())
/// # }
/// ```
pub fn each(model: &Bat, blows: &[Blow], way: Way, mut visit: impl FnMut(usize, Result<Sweep>)) {
    let mut ready: Vec<(usize, Cow<Bat>, Accuracy, Round)> = Vec::with_capacity(blows.len());
    for (k, Blow { bat, trial, accuracy, .. }) in blows.iter().enumerate() {
        match prepare(bat, &accuracy.request()) {
            Ok(Prepared { bat, request: Request { theory, .. }, .. }) => {
                let accuracy = Accuracy { theory, ..*accuracy };
                let round = Round::first(&bat, *trial, &accuracy);
                ready.push((k, bat, accuracy, round));
            }
            Err(error) => visit(k, Err(error)),
        }
    }
    let asked: Vec<_> = ready.iter().map(|(_, bat, _, round)| (&**bat, round.request)).collect();
    solutions(model, &asked, way, |one, solution| {
        let (k, bat, accuracy, round) = &ready[one];
        let Blow { trial, places, .. } = blows[*k];
        let strike = |solution| round.go_on((bat, trial), accuracy, places, solution, &nobody);
        visit(*k, solution.and_then(strike).map(|sweep| sweep.of_tapped(bat.clone())));
    });
}
