//! How fast does the ball leave along the barrel? A [`Trial`] takes as many modes, elements and steps as the requested
//! accuracy of the exit speeds needs.

use std::borrow::Cow;

use serde::Serialize;

use crate::base::{Result, Tell, nobody};
use crate::bat::{Bat, Theory};
use crate::collision::along::strikes;
use crate::collision::hit::{Effort, Impact, MOST_WORK, Model, Outcome, Scene, greater};
use crate::collision::hitter::Hitter;
use crate::collision::strike::UNRESOLVED;
use crate::modes::prepared::{Prepared, prepare};
use crate::modes::solve::{Request, Solution, Solver, solve};

/// Why a sweep ended its rounds of more modes and finer steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[must_use]
pub enum RoundsEnd {
    /// Every hit is resolved and its exit speed within the tolerance by its own estimate.
    Met,
    /// No more modes and no finer steps are available.
    Settled,
    /// The last round did not improve the answers: the hit magnifies small changes, and its exit speed is not defined
    /// more closely than stated.
    Unsettled,
    /// The next round would exceed the limit on the work ([`MOST_WORK`]).
    Stopped,
}

/// The impacts along a bat.
#[derive(Debug, Clone, Serialize)]
#[non_exhaustive]
pub struct Sweep {
    /// The modes of the hits.
    pub solution: Solution,
    /// The modes and steps of the last round.
    pub effort: Effort,
    /// Impacts, one for each place in the order of the places.
    pub impacts: Vec<Impact>,
    /// Estimated bound on the change of an exit speed due to omitted modes, relative to the closing speed; `None` for a
    /// model without omitted modes.
    pub truncation: Option<f64>,
    /// Why the rounds ended, and thus whether the requested accuracy was reached.
    pub end: RoundsEnd,
}

impl Sweep {
    /// The sweep with the bat whose moduli were fitted to its tap, if it has one.
    pub(super) fn of_tapped(mut self, bat: Cow<'_, Bat>) -> Self {
        self.solution = self.solution.of_tapped(bat);
        self
    }

    /// Strikes the bat of this sweep in another way, with its modes as long as they are accurate enough.
    ///
    /// # Errors
    ///
    /// As [`sweep`].
    pub fn again(&self, bat: &Bat, trial: Trial, to: &Accuracy, places: &[f64]) -> Result<Self> {
        let accuracy = &Accuracy { theory: self.solution.theory, ..*to };
        let (first, solution) = (Round::first(bat, trial, accuracy), self.solution.clone());
        first.go_on((bat, trial), accuracy, places, solution, &nobody)
    }

    /// Whether every hit is resolved and its exit speed within the tolerance by its own estimate.
    pub fn met(&self) -> bool {
        self.end == RoundsEnd::Met
    }

    /// The impact whose exit speed has the largest error.
    pub fn worst(&self) -> Option<(&Impact, &Outcome)> {
        let of = |impact: &Impact| impact.outcome.as_ref().map_or(f64::NEG_INFINITY, |o| o.error);
        let worst = self.impacts.iter().max_by(|a, b| of(a).total_cmp(&of(b)))?;
        Some((worst, worst.outcome.as_ref()?))
    }
}

/// A collision model in a scene.
#[derive(Debug, Clone, Copy)]
pub struct Trial<'a> {
    /// How the bending of the bat is treated.
    pub model: Model,
    /// Swing, ball and pitch.
    pub scene: &'a Scene,
}

/// Requested accuracy of the exit speeds, and the means to reach it.
///
/// The accuracy of the modes follows from that of the exit speeds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Accuracy {
    /// Allowed error of an exit speed, relative to the closing speed; not enforced if `elements` is given.
    pub exit_speed: f64,
    /// Exact number of modes. `None` takes as many as the exit speeds need or, for a model without interaction of ball
    /// and modes, those of [`Request::default`].
    pub modes: Option<usize>,
    /// Fixed number of elements; `None` plans it.
    pub elements: Option<usize>,
    /// Fixed degree of the elements, as [`Request::degree`].
    pub degree: Option<usize>,
    /// How the modes are found.
    pub solver: Solver,
    /// The beam theory; [`Theory::Auto`] takes the one that the number of modes needs ([`Self::modes`], or that of
    /// [`Request::default`]).
    pub theory: Theory,
}

impl Default for Accuracy {
    fn default() -> Self {
        let Request { tolerance, elements, degree, solver, theory, .. } = Request::default();
        Self { exit_speed: tolerance, modes: None, elements, degree, solver, theory }
    }
}

impl Accuracy {
    /// The default accuracy with the plain beam, Euler and Bernoulli's.
    pub fn plain() -> Self {
        Self { theory: Theory::EulerBernoulli, ..Self::default() }
    }

    /// The first request for modes.
    pub(super) fn request(&self) -> Request {
        let Self { exit_speed, modes, elements, degree, solver, theory } = *self;
        let modes = modes.unwrap_or(Request::default().modes);
        Request { modes, tolerance: exit_speed, elements, degree, solver, theory }
    }

    /// Whether the number of modes is chosen for the exit speeds.
    fn planned(&self, trial: Trial) -> bool {
        trial.touches() && self.modes.is_none()
    }
}

/// Strikes the bat at all places (m from the knob end).
///
/// ```
/// use sweetspot::Bat;
/// use sweetspot::collision::sweep::{Accuracy, sweep};
/// use sweetspot::collision::{Model, Scene};
///
/// # fn main() -> sweetspot::Result<()> {
/// # let text = r#"{ "format": "sweetspot-bat/1", "material": "white-ash-dynamic",
/// #     "profile": { "unit": "in", "x": [0, 6, 20, 27, 33], "diameter": [1.0, 0.9, 1.6, 2.4, 2.5] } }"#;
/// # let bat = Bat::from_text("bat.json", text, "".as_ref())?;
/// let scene = Scene { swing: 45.0, ball_speed: 38.0, ..Scene::default() }; // rad/s, m/s
/// let hits = sweep(&bat, Model::Contact, &scene, &Accuracy::default(), &[0.6, 0.7])?;
/// assert!(hits.met());
/// for impact in &hits.impacts {
///     let outcome = impact.outcome.as_ref().expect("they meet");
///     println!("{:.2} m/s within {:.0e}", outcome.exit_speed, outcome.error);
/// }
/// # Ok(())
/// # }
/// ```
///
/// # Errors
///
/// As [`solve`] and [`Hitter::new`].
pub fn sweep(
    bat: &Bat,
    model: Model,
    scene: &Scene,
    accuracy: &Accuracy,
    places: &[f64],
) -> Result<Sweep> {
    sweep_telling(bat, Trial { model, scene }, accuracy, places, &nobody)
}

/// Strikes the bat at all places as [`sweep`] does, and reports the progress.
///
/// # Errors
///
/// As [`sweep`].
pub fn sweep_telling(
    bat: &Bat,
    trial: Trial,
    accuracy: &Accuracy,
    places: &[f64],
    tell: Tell,
) -> Result<Sweep> {
    let Prepared { bat, request: Request { theory, .. }, .. } = prepare(bat, &accuracy.request())?;
    let accuracy = &Accuracy { theory, ..*accuracy };
    let first = Round::first(&bat, trial, accuracy);
    tell(0.0, "modes");
    let solution = solve(&bat, &first.request)?;
    Ok(first.go_on((&bat, trial), accuracy, places, solution, tell)?.of_tapped(bat))
}

/// Most modes for an exit speed.
const MOST: usize = 120;
/// Best accuracy of the steps.
const FINEST: f64 = 1e-12;
/// If two rounds leave more than this share of the error, the answer is not defined more closely. A ball with a
/// restitution below `DEAD` seldom converges and costs most, so one round decides. The example `tuning_settling` prints
/// the share that rounds leave, by the ball's restitution.
const IDLE: f64 = 0.8;
const IDLE_DEAD: f64 = 0.3;
const DEAD: f64 = 0.05;
/// The modes' own tolerance as a share of the tolerance of the exit speed. According to the example `tuning_modes`,
/// modes to 1e-5 change it by less than 1e-8. The share is small because the bound on this effect is far above it.
const MODES: f64 = 3e-4;
/// Smallest tolerance of the modes if dashpots couple them.
const DAMPED: f64 = 1e-9;
/// Largest error of the steps, as a share of the change by fewer modes (example `tuning_settling`).
const BLURRED: f64 = 0.003;

impl Trial<'_> {
    /// Whether ball and modes act on each other, so that modes are planned for the hit.
    fn touches(&self) -> bool {
        matches!(self.model, Model::Pulse(_) | Model::Contact)
    }

    /// The largest error of a round that counts as an improvement, given those of the two rounds before.
    fn most_left(&self, before: [f64; 2]) -> f64 {
        if self.scene.cor < DEAD { IDLE_DEAD * before[1] } else { IDLE * before[0] }
    }

    /// The accuracy for a request whose tolerance is that of exit speeds. Its number of modes is exact if the user
    /// `asked` for it or if the model does not depend on it.
    pub fn accuracy(&self, request: &Request, asked: bool) -> Accuracy {
        let Request { modes, tolerance, elements, degree, solver, theory } = *request;
        let modes = (asked || !self.touches()).then_some(modes);
        Accuracy { exit_speed: tolerance, modes, elements, degree, solver, theory }
    }
}

/// The modes and steps of one round of hits.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Round {
    /// The modes of the bat.
    pub request: Request,
    effort: Effort,
}

impl Round {
    /// The first round.
    pub fn first(bat: &Bat, trial: Trial, accuracy: &Accuracy) -> Self {
        let (request, planned) = (&accuracy.request(), accuracy.planned(trial));
        let accuracy = (10.0 * request.tolerance).clamp(1e-11, 1e-3);
        let mut first = *request;
        if planned {
            first.modes = enough(trial, request, bat);
        }
        if trial.touches() {
            // The bound on the effect of the modes' own errors is far above it; this keeps it negligible.
            first.tolerance = (MODES * request.tolerance).clamp(1e-13, 1e-6);
        }
        Self { request: first, effort: Effort { accuracy, completed: planned, unsettled: false } }
    }

    /// Strikes the bat at all places (m) with these modes, and with better ones as long as the answers improve.
    ///
    /// # Errors
    ///
    /// As [`Hitter::new`].
    pub(super) fn go_on(
        self,
        (bat, trial): (&Bat, Trial),
        accuracy: &Accuracy,
        places: &[f64],
        mut solution: Solution,
        tell: Tell,
    ) -> Result<Sweep> {
        let (request, planned) = (&accuracy.request(), accuracy.planned(trial));
        let mut now = self;
        let (mut impacts, mut before): (Vec<Impact>, _) = (vec![], [f64::INFINITY; 2]);
        let (mut work, most) = (0, MOST_WORK.max(MOST_WORK / 100 * places.len() as u64));
        loop {
            let hitter = Hitter::new(trial.model, trial.scene, bat, &solution, now.effort)?;
            if let Some((request, found)) = now.slow_modes(&hitter, bat) {
                (solution, now.request) = (found, request);
                continue;
            }
            let open = open(&impacts, request.tolerance, places.len());
            let places: Vec<f64> = open.iter().map(|k| places[*k]).collect();
            let struck = strikes(&hitter, bat.length(), &places, tell);
            work += hitter.work();
            keep_better(&mut impacts, &open, struck);
            let worst = Worst::of(open.iter().filter_map(|k| impacts[*k].outcome.as_ref()));
            let met = impacts.iter().all(|impact| doubt(impact) <= request.tolerance);
            let improves = worst.error <= trial.most_left(before);
            before = [before[1], worst.error];
            let next = now.finer(bat, &worst, request.tolerance, planned, work);
            let more = !met && improves && request.elements.is_none() && next != now;
            let stopped = more && work > most;
            if more && !stopped {
                if next.request == now.request {
                    now = next;
                    continue;
                }
                // If better modes are not available, this answer is kept.
                if now.request.tolerance >= 1e-13
                    && let Ok(finer) = solve(bat, &next.request)
                {
                    (solution, now) = (finer, next);
                    continue;
                }
                now.effort = next.effort;
            }
            now.effort.unsettled = stopped;
            let open = impacts.iter_mut().filter(|impact| doubt(impact) > request.tolerance);
            if stopped {
                open.filter_map(|impact| impact.outcome.as_mut()).for_each(Outcome::unsettled);
            }
            let end = match (met, stopped, improves) {
                (true, ..) => RoundsEnd::Met,
                (_, true, _) => RoundsEnd::Stopped,
                (_, _, true) => RoundsEnd::Settled,
                (_, _, false) => RoundsEnd::Unsettled,
            };
            let all = impacts.iter().filter_map(|impact| impact.outcome.as_ref());
            let truncation = planned.then(|| all.map(|o| o.truncation).fold(0.0, greater));
            return Ok(Sweep { solution, effort: now.effort, impacts, truncation, end });
        }
    }

    /// A larger request for modes and its solution, if an omitted mode is slow compared with the contact; `None` if
    /// more modes are not available or their number is given.
    fn slow_modes(&self, hitter: &Hitter, bat: &Bat) -> Option<(Request, Solution)> {
        if !self.effort.completed || self.request.elements.is_some() {
            return None;
        }
        let modes = hitter.modes_for_contact()?.min(MOST);
        let more = Request { modes, ..self.request };
        (modes > self.request.modes).then(|| Some((more, solve(bat, &more).ok()?))).flatten()
    }

    /// The next round: more modes, finer steps or more accurate modes, as the errors require.
    fn finer(&self, bat: &Bat, worst: &Worst, tolerance: f64, planned: bool, work: u64) -> Self {
        /// If a round takes this share of the allowed work, the next one takes as many modes as it needs at once.
        const DEAR: u64 = MOST_WORK / 16;
        let Self { mut request, mut effort } = *self;
        if planned && worst.truncation > 0.3 * tolerance {
            // As the error falls in the mean (`enough`).
            let rate = if request.theory.shears() { 3.2 } else { 6.5 };
            let needed = (worst.truncation / (0.3 * tolerance)).powf(1.0 / rate);
            let more = if work > DEAR { needed.clamp(1.5, 3.0) } else { 1.5 };
            request.modes = ((more * request.modes as f64) as usize).min(MOST);
        }
        // The compared answers also differ by their steps.
        let blurred =
            worst.truncation > 0.3 * tolerance && worst.steps > BLURRED * worst.truncation;
        if (blurred || worst.steps > 0.3 * tolerance) && effort.accuracy > FINEST {
            effort.accuracy = (0.1 * effort.accuracy).max(FINEST);
        }
        // The exit speed is more sensitive than the frequencies, which must then be more accurate.
        let left = worst.error - worst.truncation - worst.steps - worst.wall;
        if left > 0.5 * tolerance {
            request.tolerance *= (0.3 * tolerance / left).clamp(1e-6, 0.1);
            request.tolerance = request.tolerance.max(1e-14);
        }
        if bat.damped() {
            // Accurate motions with dashpots take long to compute, and a hit does not need them.
            request.tolerance = request.tolerance.max(DAMPED.min(self.request.tolerance));
        }
        Self { request, effort }
    }
}

/// The largest errors of several outcomes.
struct Worst {
    error: f64,
    truncation: f64,
    steps: f64,
    wall: f64,
}

impl Worst {
    fn of<'a>(outcomes: impl Iterator<Item = &'a Outcome> + Clone) -> Self {
        let most = |of: fn(&Outcome) -> f64| outcomes.clone().map(of).fold(0.0, greater);
        Self {
            error: most(|o| o.error),
            truncation: most(|o| o.truncation),
            steps: most(|o| o.steps),
            wall: most(|o| o.wall),
        }
    }
}

/// The places whose hits are not yet accurate enough; the others keep their hits.
fn open(impacts: &[Impact], tolerance: f64, places: usize) -> Vec<usize> {
    let unknown = |k: &usize| impacts.get(*k).is_none_or(|impact| doubt(impact) > tolerance);
    (0..places).filter(unknown).collect()
}

/// Replaces the hits at those places, except where the old error is smaller.
fn keep_better(impacts: &mut Vec<Impact>, places: &[usize], struck: Vec<Impact>) {
    if impacts.is_empty() {
        *impacts = struck;
        return;
    }
    for (k, impact) in places.iter().zip(struck) {
        if doubt(&impact) < doubt(&impacts[*k]) {
            impacts[*k] = impact;
        }
    }
}

/// The stated error of an exit speed, infinite if the hit is unresolved.
fn doubt(impact: &Impact) -> f64 {
    match &impact.outcome {
        _ if impact.flags.contains(&UNRESOLVED) => f64::INFINITY,
        Some(outcome) => outcome.error,
        None => 0.0,
    }
}

/// The number of modes that a contact needs for that tolerance, measured on a dowel, a cone and an R161: the error
/// falls as `n^−6.5` where frequencies rise as `n²`, and as `n^−3.2` where shear lets them rise as `n`. The example
/// `tuning_modes` prints such a table: `n^−5.7` to `n^−6.2`, and `n^−2.9` to `n^−3.2`, from 1e-5 and 1e-4 with 10 modes
/// on. The stated error is a few times larger: with shear 6e-4 for 10 modes and 9e-5 for 20. A second round would cost
/// more than the modes that are saved. The number is at most that of a mesh with one element per piece.
fn enough(Trial { model, scene }: Trial, request: &Request, bat: &Bat) -> usize {
    let digits = -request.tolerance.log10();
    let rate = match (model, request.theory.shears()) {
        (Model::Pulse(_), false) => 8.0,
        (Model::Pulse(_), true) => 5.0,
        (_, false) => 6.5,
        (_, true) => 3.2,
    };
    let few = match model {
        Model::Contact if request.theory.shears() => 20.0,
        _ => 10.0,
    };
    // A ball that returns little releases its force at once, which excites twice as many modes.
    let stirred = if scene.cor < 0.2 { 2.0 } else { 1.0 };
    let count = stirred * few * 10.0_f64.powf((digits - 4.0) / rate);
    let most = match request.elements {
        Some(elements) => {
            (request.degree.unwrap_or(3) - 1) * elements.max(bat.profile().pieces.len())
        }
        None => usize::MAX,
    };
    (count.ceil() as usize).clamp(10, 80).min(most)
}
