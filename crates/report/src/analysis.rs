//! All results of a bat and its hits, computed once, for screens, pages and files.

use sweetspot::base::telling::{Tell, nobody};
use sweetspot::collision::figures::{Figures, SwingLaw};
use sweetspot::collision::strength::Strength;
use sweetspot::collision::sweep::{Accuracy, Trial, sweep_telling};
use sweetspot::collision::{Hitter, Model, Scene, Sweep};
use sweetspot::modes::hoop::rings;
use sweetspot::{Bat, Request, Result, Solution};
use sweetspot_proof::validation::dowel_proof;
use sweetspot_study::advise::advice::{Advice, advise};
use sweetspot_study::spread::{Analysed, Readings, Spread};
use sweetspot_study::trampoline::barrel::{Barrel, BarrelTest};
use sweetspot_study::verdict::Verdict;

/// Impact points along the outer half of the bat.
pub const POINTS: usize = 101;

/// What an analysis includes besides the modes.
#[derive(Debug, Clone)]
pub struct Task {
    /// How ball and bat meet: rigid, energy-loss, pulse or contact.
    pub model: Model,
    /// Swing, pitch and ball, and where the swing is from.
    pub scene: Scene,
    /// How the swing depends on the swing weight of the bat; None for a given swing.
    pub law: Option<SwingLaw>,
    /// Tolerance and theory of the hits.
    pub hits: Request,
    /// The request for the test on the dowel.
    pub proof: Request,
    /// How exactly the bat was measured.
    pub readings: Readings,
}

/// Accuracy of the solver on the uniform dowel, for which the exact values are known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Proof {
    /// Number of modes of the uniform dowel that were compared.
    pub modes: usize,
    /// The largest true relative error of a frequency.
    pub truth: f64,
    /// The largest relative error of a frequency that the solver states.
    pub stated: f64,
}

/// A bat, its modes, its hits, its figures and the uncertainty of all of them.
#[derive(Debug, Clone)]
pub struct Analysis {
    /// The bat that is analysed.
    pub bat: Bat,
    /// Bending modes of the bat.
    pub solution: Solution,
    /// The task.
    pub task: Task,
    /// Hits at [`POINTS`] even places from the middle of the bat to its tip.
    pub hits: Sweep,
    /// The figures by which bats are compared, and the sweet spot.
    pub figures: Figures,
    /// The load on the bat in hits at the sweet spot and five inches closer to the handle; empty where the model has no
    /// force in time.
    pub strength: Vec<Strength>,
    /// Accuracy of the solver on a dowel with known frequencies.
    pub proof: Proof,
    /// The uncertainty due to calipers, scale and wood; not computed for a bat whose many pieces would make it
    /// slow.
    pub spread: Spread,
    /// The reliability of the answers, from everything known about them.
    pub verdict: Verdict,
    /// The effect of each part of the model. `None` for a bat of more than a thousand pieces, which would take long,
    /// and if it could not be computed for the reason in [`Self::failed`].
    pub advice: Option<Advice>,
    /// The hoop modes of a hollow barrel and the effect of its wall on the ball. `None` for other bats, and if they
    /// could not be computed for the reason in [`Self::failed`].
    pub barrel: Option<Barrel>,
    /// What could not be found, with the reason, one sentence each.
    pub failed: Vec<String>,
}

impl Analysis {
    /// The whole analysis of a bat with known modes.
    ///
    /// # Errors
    ///
    /// As [`sweep_telling`] and [`Figures::new`].
    pub fn new(bat: Bat, solution: Solution, task: Task) -> Result<Self> {
        Self::telling(bat, solution, task, &nobody)
    }

    /// Analyses a solved bat and reports the progress of the work.
    ///
    /// # Errors
    ///
    /// As [`Self::new`].
    pub fn telling(bat: Bat, solution: Solution, task: Task, tell: Tell) -> Result<Self> {
        let half = 0.5 * bat.length();
        let places: Vec<f64> =
            (0..POINTS).map(|k| half + half * k as f64 / (POINTS - 1) as f64).collect();
        let Task { model, scene, law, .. } = &task;
        let half_of_it = |share: f64, what: &str| tell(0.5 * share, what);
        let trial = Trial { model: *model, scene };
        let accuracy = trial.accuracy(&task.hits, false);
        let hits = sweep_telling(&bat, trial, &accuracy, &places, &half_of_it)?;
        tell(0.5, "the sweet spot");
        let hitter = Hitter::new(*model, scene, &bat, &hits.solution, hits.effort)?;
        let figures = Figures::new(&bat, &hitter, *law)?;
        let strength = strength(&bat, &task, &hits, &figures);
        let [truth, stated] = dowel_proof(&task.proof)?;
        let proof = Proof { modes: task.proof.modes, truth, stated };
        tell(0.7, "the uncertainty due to wood, scale and calipers");
        let spot = &figures.spot;
        let analysed = Analysed {
            bat: &bat,
            solution: &solution,
            model: *model,
            scene,
            law: *law,
            hits: &hits,
            spot,
        };
        let spread = match bat.profile().pieces.len() {
            0..=MOST_PIECES => Spread::new(&analysed, &task.readings),
            _ => Spread::uncounted(&analysed),
        };
        let verdict = Verdict::of((&bat, scene), &hits, figures.best.as_ref(), figures.wall);
        tell(0.9, "what the model needs");
        let mut failed = vec![];
        let advice = found(advice(&bat, task.hits.tolerance), "what the model needs", &mut failed);
        let barrel = barrel(&bat, &task, accuracy, &hits);
        let barrel = found(barrel, "how the barrel rings", &mut failed);
        Ok(Self {
            bat,
            solution,
            task,
            hits,
            figures,
            strength,
            proof,
            spread,
            verdict,
            advice,
            barrel,
            failed,
        })
    }
}

/// Bats with more pieces are not recomputed with changes.
const MOST_PIECES: usize = 1000;

/// At the sweet spot, and five inches towards the hands, where a ball jams them.
fn strength(bat: &Bat, task: &Task, hits: &Sweep, figures: &Figures) -> Vec<Strength> {
    const INSIDE: f64 = 5.0 * 0.0254;
    let best = figures.spot.exit_speed_max.filter(|_| task.model == Model::Contact);
    let places = best.map_or(vec![], |best| vec![best.x, best.x - INSIDE]);
    let at = |x: f64| Strength::at(bat, &hits.solution, (&task.scene, hits.effort), x);
    places.into_iter().filter(|x| *x > 0.0).filter_map(at).collect()
}

/// A result if there is one; a failure is recorded with its reason.
fn found<T>(of: Option<Result<T>>, what: &str, failed: &mut Vec<String>) -> Option<T> {
    let noted = |error| failed.push(format!("Not found: {what} ({error})"));
    of?.map_err(noted).ok()
}

/// The barrel of a hollow bat under the ball of the scene, fired as in laboratories; None without a hollow barrel.
fn barrel(bat: &Bat, task: &Task, to: Accuracy, hits: &Sweep) -> Option<Result<Barrel>> {
    if !rings(bat) || bat.profile().pieces.len() > MOST_PIECES {
        return None;
    }
    let test = BarrelTest::of(bat, task.scene.ball.clone(), to);
    let known = task.scene.hoop.wall().cloned();
    Some(Barrel::of(bat, BarrelTest { cor: task.scene.cor, known, ..test }, Some(hits)))
}

fn advice(bat: &Bat, tolerance: f64) -> Option<Result<Advice>> {
    const MODES: usize = 5;
    if bat.profile().pieces.len() > MOST_PIECES {
        return None;
    }
    Some(advise(bat, MODES, tolerance))
}
