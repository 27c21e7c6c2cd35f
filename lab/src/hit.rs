//! How does the bat ring, and how fast does the ball leave, place by place?

use serde_json::{Value, json};
use sweetspot::base::error::Result;
use sweetspot::bat::body::Bat;
use sweetspot::collision::columns::{self, Column};
use sweetspot::collision::figures::SwingLaw;
use sweetspot::collision::hit::{Effort, Model, Scene, Wall};
use sweetspot::collision::hitter::Hitter;
use sweetspot::collision::hoop_wall::rough_stiffness;
use sweetspot::collision::setup::Setup;
use sweetspot::collision::strike::Glance;
use sweetspot::collision::sweep::{Sweep, Trial, sweep};
use sweetspot::collision::sweet_spot::{HitsAlong, Peak, SweetSpot};
use sweetspot::collision::wall_choice::WallChoice;
use sweetspot::modes::hoop::rings;
use sweetspot::modes::prepared::prepare;
use sweetspot::modes::solve::{Request, Solution, solve};
use sweetspot_report::analysis::POINTS;
use sweetspot_report::parts::Quantity;
use sweetspot_report::report::{hit_text, trust};
use sweetspot_study::answers::Answer;
use sweetspot_study::verdict::Verdict;

use crate::asked::{Question, request};
use crate::shown;

/// A prepared and solved bat, with its scene.
pub struct Solved {
    pub bat: Bat,
    pub request: Request,
    pub solution: Solution,
    pub scene: Scene,
    pub law: Option<SwingLaw>,
    pub model: Model,
}

impl Solved {
    /// The bat of the question with its modes; with the wall of a hollow barrel, or with a rigid wall.
    pub fn new(of: &Question, asked: Request, with_wall: bool) -> Result<Self> {
        let prepared = prepare(&of.bat, &asked)?;
        let (bat, request) = (prepared.bat.into_owned(), prepared.request);
        let stiff = !with_wall && of.setup.wall_stiffness.is_none();
        let wall = if stiff { WallChoice::Off } else { of.setup.wall };
        let setup = Setup { wall, ..of.setup.clone() };
        let (scene, law) = setup.scene(&bat, Some(request.tolerance))?;
        let solution = solve(&bat, &request)?;
        Ok(Self { bat, request, solution, scene, law, model: of.model()? })
    }

    /// The hits along the outer half, at the number of places of `sweetspot hit`.
    fn sweep(&self) -> Result<Sweep> {
        let half = 0.5 * self.bat.length();
        let places = (0..POINTS).map(|k| half + half * k as f64 / (POINTS - 1) as f64);
        let accuracy =
            Trial { model: self.model, scene: &self.scene }.accuracy(&self.request, false);
        sweep(&self.bat, self.model, &self.scene, &accuracy, &places.collect::<Vec<_>>())
    }
}

/// Number of modes in the answer.
const TOLD: usize = 3;

/// The modes in both answers.
fn modes(of: &Question, solved: &Solved) -> Value {
    let Solved { bat, solution, .. } = solved;
    let first = solution.modes.iter().take(TOLD);
    let told: Vec<Value> = first.map(|mode| shown::mode(bat, of.units, mode)).collect();
    json!({ "modes": told })
}

/// The best place with its zone, and the energy left in vibration there.
fn best(
    of: &Question,
    solved: &Solved,
    peak: Peak,
    zone: [f64; 2],
    vibration: Option<f64>,
) -> Value {
    let Solved { bat, .. } = solved;
    let place = |x: f64| shown::place(bat, of.units, x);
    let vibration =
        vibration.map(|energy| shown::shown(energy, Quantity::Energy.said(of.units, energy)));
    json!({
        "best": {
            "place": place(peak.x),
            "speed": shown::answer(Answer::ExitSpeed, of.units, peak.value),
        },
        "zone": zone.map(place),
        "vibration": vibration,
    })
}

/// Adds the members of the second to the first.
fn with(mut answer: Value, more: Value) -> Value {
    if let (Some(answer), Value::Object(more)) = (answer.as_object_mut(), more) {
        answer.extend(more);
    }
    answer
}

/// The answer if ball and bat meet nowhere.
fn no_hit() -> Value {
    json!({ "best": null, "zone": null, "vibration": null })
}

/// A preview, while a finger moves.
pub fn live(of: &Question) -> Result<Value> {
    /// Relative accuracy of the frequencies.
    const ROUGH: f64 = 1e-3;
    /// Number of steps along the outer half, and the share of it to which the best place is located.
    const STEPS: (usize, f64) = (20, 1e-4);
    let mut solved = Solved::new(of, Request { tolerance: ROUGH, ..request() }, false)?;
    // A wall without given figures deflects like a spring.
    let told =
        rings(&solved.bat) && solved.scene.wall.is_none() && of.setup.wall != WallChoice::Off;
    if let Some(stiffness) = rough_stiffness(&solved.bat).filter(|_| told) {
        solved.scene.wall = Some(Wall { stiffness, mass: 0.0 });
    }
    let Solved { bat, solution, scene, model, .. } = &solved;
    let hitter = Hitter::new(*model, scene, bat, solution, Effort::default())?;
    let looked = HitsAlong::outer(STEPS, &hitter);
    let along = |value: fn(&Glance) -> Option<f64>| -> Vec<Option<f64>> {
        looked.values(value).into_iter().map(|v| v.is_finite().then_some(v)).collect()
    };
    let hit = looked.fastest().map_or_else(no_hit, |peak| {
        let vibration = hitter.glance(peak.x).and_then(|glance| glance.vibration);
        best(of, &solved, peak, looked.zone(peak), vibration)
    });
    let answer = json!({
        "certified": false, "unmet": null, "rough_wall": rings(bat),
        "curve": {
            "x_m": looked.places(),
            "exit_m_s": along(|glance| Some(glance.exit_speed)),
            "vibration_j": along(|glance| glance.vibration),
        },
        "spots": [], "doubts": [],
    });
    Ok(with(with(answer, modes(of, &solved)), hit))
}

/// The answer of `sweetspot hit`, with the wall of a hollow barrel.
pub fn sure(of: &Question) -> Result<Value> {
    let solved = Solved::new(of, request(), true)?;
    let Solved { bat, solution, scene, model, .. } = &solved;
    let hits = solved.sweep()?;
    let hitter = Hitter::new(*model, scene, bat, &hits.solution, hits.effort)?;
    let spot = SweetSpot::find(&hitter);
    let there = spot.exit_speed_max.map(|peak| hitter.strike(peak.x));
    let along = |column: Column| -> Vec<Option<f64>> {
        hits.impacts.iter().map(|impact| column.at(impact)).collect()
    };
    let energy = there.as_ref().and_then(|there| Some(&there.outcome.as_ref()?.energy));
    let vibration = energy.map(|energy| energy.vibration);
    let hit = spot.exit_speed_max.zip(spot.zone);
    let hit = hit.map_or_else(no_hit, |(peak, zone)| best(of, &solved, peak, zone, vibration));
    let unmet = match (solution.met(), hits.met()) {
        (true, true) => None,
        (false, _) => Some(format!("frequencies: {}", solution.ending)),
        (_, false) => Some("exit speeds are less accurate than was asked".to_owned()),
    };
    let verdict = Verdict::of((bat, scene), &hits, there.as_ref(), None);
    let spots: Vec<Value> = hit_text::spot_lines(bat, &spot, of.units)
        .into_iter()
        .map(|line| json!({ "what": line.what.trim(), "place": shown::place(bat, of.units, line.x) }))
        .collect();
    let answer = json!({
        "certified": unmet.is_none(), "unmet": unmet, "rough_wall": false,
        "curve": {
            "x_m": along(columns::X),
            "exit_m_s": along(columns::EXIT_SPEED),
            "stiff_m_s": along(columns::RIGID_EXIT_SPEED),
            "vibration_j": along(columns::VIBRATION),
        },
        "spots": spots, "doubts": trust::doubts(&verdict, of.units),
    });
    Ok(with(with(answer, modes(of, &solved)), hit))
}
