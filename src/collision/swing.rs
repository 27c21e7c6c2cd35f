//! A swing at a bat in one call: it chooses theory, fit to the tap, modes, wall and accuracy.

use crate::base::{Error, Result};
use crate::bat::Bat;
use crate::collision::hit::{Impact, Model, Scene};
use crate::collision::hitter::Hitter;
use crate::collision::sweep::{Accuracy, Sweep, sweep};
use crate::collision::sweet_spot::SweetSpot;
use crate::collision::wall_choice::WallChoice;
use crate::modes::mode::Mode;
use crate::modes::prepared::{Prepared, prepare};

/// Swing and ball, and the accuracy of the exit speeds.
#[derive(Debug, Clone)]
pub struct Swing {
    /// Swing, ball and pitch.
    pub scene: Scene,
    /// How the model treats the bending of the bat.
    pub model: Model,
    /// Whether a hollow barrel's wall deflects.
    pub wall: WallChoice,
    /// Accuracy of the exit speeds, and limits on the computation.
    pub accuracy: Accuracy,
}

impl Default for Swing {
    /// [`Scene::default`] with the contact model, the wall if it matters, and [`Accuracy::default`].
    fn default() -> Self {
        let (scene, accuracy) = (Scene::default(), Accuracy::default());
        Self { scene, model: Model::Contact, wall: WallChoice::Auto, accuracy }
    }
}

/// Whether the accuracy was reached.
#[derive(Debug, Clone, Copy, PartialEq)]
#[must_use]
pub enum Reached {
    /// Every exit speed that was evaluated is within the tolerance, by its own estimate.
    Asked,
    /// It was not reached; the largest stated error of those (m/s).
    Within(f64),
}

/// The fastest hit.
#[derive(Debug, Clone, PartialEq)]
pub struct Best {
    /// The place (m from the knob end).
    pub x: f64,
    /// Exit speed of the ball (m/s).
    pub exit_speed: f64,
    /// Error bound of the exit speed (m/s).
    pub error: f64,
    /// The whole hit there.
    pub impact: Impact,
}

/// A bat that was swung at a ball.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Hit {
    /// The bat, with moduli fitted to the tap.
    pub bat: Bat,
    /// The swing, with the theory and the wall that were chosen.
    pub swing: Swing,
    /// The fastest hit.
    pub best: Best,
    /// The sweet spot by every definition.
    pub spot: SweetSpot,
    /// Whether the accuracy was reached.
    pub reached: Reached,
    /// A warning that shear matters but no shear modulus is known; None otherwise.
    pub warning: Option<String>,
    sweep: Sweep,
}

/// Number of hits along the outer half from which the number of modes and the steps are found.
const LOOKS: usize = 12;

impl Hit {
    /// Swings the bat and finds the best place of its outer half.
    ///
    /// # Errors
    ///
    /// Those of [`prepare`], of [`Scene::with_wall`], of [`sweep`], and [`Error::Value`] if the bat and the ball do not
    /// meet.
    pub fn of(bat: &Bat, swing: &Swing) -> Result<Self> {
        let Swing { scene, model, wall, accuracy } = swing.clone();
        let Prepared { bat, request, warning } = prepare(bat, &accuracy.request())?;
        let bat = bat.into_owned();
        let accuracy = Accuracy { theory: request.theory, ..accuracy };
        let tolerance = accuracy.modes.is_none().then_some(accuracy.exit_speed);
        let scene = scene.with_wall(wall, &bat, model, tolerance)?;
        let look = |k: usize| bat.length() * (0.5 + 0.5 * (k as f64 + 0.5) / LOOKS as f64);
        let places: Vec<f64> = (0..LOOKS).map(look).collect();
        let sweep = sweep(&bat, model, &scene, &accuracy, &places)?;
        let hitter = Hitter::new(model, &scene, &bat, &sweep.solution, sweep.effort)?;
        let spot = SweetSpot::find(&hitter);
        let best = spot.exit_speed_max.and_then(|peak| best_at(&hitter, peak.x));
        let Some(best) = best else {
            let found = "no place where ball and bat meet";
            return Err(Error::value("swing", found, "a ball that the bat meets"));
        };
        let error = |impact: &Impact| {
            let closing = impact.bat_speed + scene.ball_speed;
            impact.outcome.as_ref().map_or(0.0, |outcome| outcome.error * closing)
        };
        let closing = best.impact.bat_speed + scene.ball_speed;
        let worst = sweep.impacts.iter().map(error).fold(best.error, f64::max);
        let reached = match sweep.met() && best.error <= accuracy.exit_speed * closing {
            true => Reached::Asked,
            false => Reached::Within(worst),
        };
        drop(hitter);
        let swing = Swing { scene, model, wall, accuracy };
        Ok(Self { bat, swing, best, spot, reached, warning, sweep })
    }

    /// The modes of the bat.
    pub fn modes(&self) -> &[Mode] {
        &self.sweep.solution.modes
    }

    /// Hits at other places (m from the knob end) of the same bat, with the same modes.
    ///
    /// # Errors
    ///
    /// As [`Hitter::new`].
    pub fn at(&self, places: &[f64]) -> Result<Vec<Impact>> {
        let Swing { scene, model, .. } = &self.swing;
        let Sweep { solution, effort, .. } = &self.sweep;
        let hitter = Hitter::new(*model, scene, &self.bat, solution, *effort)?;
        let places: Vec<_> = places.iter().map(|x| (*x, None)).collect();
        Ok(hitter.strike_all(&places))
    }
}

fn best_at(hitter: &Hitter, x: f64) -> Option<Best> {
    let impact = hitter.strike(x);
    let outcome = impact.outcome.as_ref()?;
    let closing = impact.bat_speed + hitter.scene.ball_speed;
    Some(Best {
        x,
        exit_speed: outcome.exit_speed,
        error: outcome.error * closing,
        impact: impact.clone(),
    })
}
