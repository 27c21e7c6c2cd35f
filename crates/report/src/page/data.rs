//! The numbers that the page's script draws, rounded to what a picture shows; the summary is exact.

use schemars::JsonSchema;
use serde::Serialize;

use crate::analysis::Analysis;
use crate::page::barrel::RingingBarrel;
use crate::page::moment::Moment;
use crate::page::summary::Summary;
use sweetspot::base::number::rounded;
use sweetspot::bat::profile::{Piece, Profile};
use sweetspot::collision::columns::{self, Column};
use sweetspot::collision::hit::{Energy, Impact};
use sweetspot::files::schema::document::{Document, Format};
use sweetspot::motion::sound::{ASSUMED_LOSS, Sound};

/// What the script of a report draws: the bat's outline, hits along the barrel, modes and hits in time.
/// The unit stands in every name; positions count from the knob end; what does not exist is null.
/// Numbers are rounded to what a picture shows, those of the summary are not.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "Data of a report of sweetspot, sweetspot-page/1")]
pub struct Data<'a> {
    /// Name of the format and its version: sweetspot-page/1.
    pub format: Format<Data<'a>>,
    /// The numbers at the top of the page, not rounded.
    pub summary: &'a Summary,
    /// What the bat looks like.
    pub outline: Outline,
    /// What hits along the barrel do.
    pub curve: Curve,
    /// The first modes, six at most.
    pub modes: Vec<MovingMode>,
    /// How the barrel of a hollow bat rings; left out of others.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub barrel: Option<RingingBarrel>,
    /// Hits in time; empty where the model knows no force in time.
    pub moments: &'a [Moment],
    /// What a tap on the tip sounds like.
    pub tap: Heard<'a>,
    /// What the hit at the sweet spot sounds like; null where the model knows no force in time.
    pub crack: Option<Heard<'a>>,
    /// How large the ball is drawn (mm).
    pub ball_radius_mm: f64,
}

impl Document for Data<'_> {
    const NAME: &'static str = "page";
}

/// The bat's outline at rising places, a step being two at the same; shapes are told there too.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Outline {
    /// From the knob end to the tip (mm).
    pub length_mm: f64,
    /// Places from the knob end (mm), not falling.
    pub x_mm: Vec<f64>,
    /// Outer radius there (mm).
    pub radius_mm: Vec<f64>,
}

/// Hits along the barrel; null where no ball is hit.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Curve {
    /// Where the ball meets the bat (m from the knob end), rising.
    pub x_m: Vec<f64>,
    /// Speed of the ball off the bat (m/s).
    pub exit_speed_m_s: Vec<Option<f64>>,
    /// Speed of the ball off the bat if the bat did not bend (m/s).
    pub rigid_exit_speed_m_s: Vec<Option<f64>>,
    /// What stays in the bat's bending (J).
    pub vibration_j: Vec<Option<f64>>,
    /// What the ball takes with it (J).
    pub ball_j: Vec<Option<f64>>,
    /// What is lost in the ball's own squeezing (J).
    pub lost_in_ball_j: Vec<Option<f64>>,
    /// What the bat's rigid motion keeps (J).
    pub bat_j: Vec<Option<f64>>,
}

/// One mode: what moves, and how fast.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct MovingMode {
    /// Number of the bending mode, from 1.
    pub order: usize,
    /// Natural frequency (Hz).
    pub frequency_hz: f64,
    /// Where it does not move (mm from the knob end).
    pub nodes_mm: Vec<f64>,
    /// At the places of the outline, the largest of the whole shape 1.
    pub deflection: Vec<f64>,
}

/// Even points along the bat.
const POINTS: usize = 121;
/// Modes that move.
pub const MOVING: usize = 6;

/// A sound, and what is assumed for it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct Heard<'a> {
    /// What is heard.
    #[serde(flatten)]
    pub sound: &'a Sound,
    /// The loss factor of what has none, and none that is published; null where all have one.
    pub assumed_loss_factor: Option<f64>,
}

impl<'a> Data<'a> {
    /// The numbers of an analysis, rounded but for the summary.
    pub fn new(
        analysis: &Analysis,
        summary: &'a Summary,
        moments: &'a [Moment],
        (tap, crack): &'a (Sound, Option<Sound>),
    ) -> Self {
        let outline = Outline::new(analysis.bat.profile());
        let mut materials = analysis.bat.layups().iter().flat_map(|layup| layup.materials());
        let unknown = materials.any(|m| m.loss_factor == 0.0 && m.published_loss().is_none());
        let assumed_loss_factor = unknown.then_some(ASSUMED_LOSS);
        let modes = analysis.solution.modes.iter().take(MOVING);
        let modes = modes.map(|mode| MovingMode {
            order: mode.order,
            frequency_hz: rounded(mode.frequency(), 2),
            nodes_mm: mode.nodes.iter().map(|x| rounded(1e3 * x, 2)).collect(),
            deflection: (outline.x_mm.iter())
                .map(|x| rounded(mode.shape.deflection(1e-3 * x), 4))
                .collect(),
        });
        Self {
            format: Format::new(),
            summary,
            curve: Curve::new(&read_off(analysis)),
            modes: modes.collect(),
            barrel: (analysis.barrel.as_ref())
                .and_then(|barrel| RingingBarrel::new(&analysis.bat, barrel)),
            outline,
            moments,
            tap: Heard { sound: tap, assumed_loss_factor },
            crack: crack.as_ref().map(|sound| Heard { sound, assumed_loss_factor }),
            ball_radius_mm: rounded(1e3 * analysis.task.scene.ball.radius_m, 2),
        }
    }
}

/// The hits along the barrel, and the one at the sweet spot in its place among them: whoever reads the
/// curve off can stand on it.
fn read_off(analysis: &Analysis) -> Vec<Impact> {
    let mut all = analysis.hits.impacts.clone();
    let best = analysis.figures.best.iter().filter(|best| best.outcome.is_some());
    for best in best {
        let place = all.partition_point(|impact| impact.x < best.x);
        if all.get(place).is_none_or(|impact| impact.x != best.x) {
            all.insert(place, best.clone());
        }
    }
    all
}

impl Outline {
    fn new(profile: &Profile) -> Self {
        /// Steps that are drawn: more than this could not be told apart.
        const MOST: usize = 100;
        let length = profile.length();
        let even = (0..POINTS).map(|k| length * k as f64 / (POINTS - 1) as f64);
        let mut points: Vec<[f64; 2]> = even.map(|x| [x, profile.at(x).outer]).collect();
        let step = |pair: &[Piece]| {
            let [before, after] = [pair[0].at(1.0).outer, pair[1].at(0.0).outer];
            let x = pair[1].start;
            (before != after).then_some([[x, before], [x, after]])
        };
        for both in profile.pieces.windows(2).filter_map(step).take(MOST) {
            // An even point there has the radius after the step.
            points.retain(|[x, _]| *x != both[0][0]);
            let after = points.partition_point(|[x, _]| *x < both[0][0]);
            points.splice(after..after, both);
        }
        Self {
            length_mm: rounded(1e3 * length, 3),
            x_mm: points.iter().map(|[x, _]| rounded(1e3 * x, 2)).collect(),
            radius_mm: points.iter().map(|[_, radius]| rounded(1e3 * radius, 2)).collect(),
        }
    }
}

impl Curve {
    fn new(impacts: &[Impact]) -> Self {
        let round = |value: f64| rounded(value, 3);
        let along = |column: Column| impacts.iter().map(|i| column.at(i).map(round)).collect();
        let outcomes = || impacts.iter().map(|impact| impact.outcome.as_ref());
        let energy = |of: &dyn Fn(&Energy) -> f64| -> Vec<Option<f64>> {
            outcomes().map(|o| o.map(|o| round(of(&o.energy)))).collect()
        };
        Self {
            x_m: impacts.iter().map(|impact| rounded(impact.x, 7)).collect(),
            exit_speed_m_s: along(columns::EXIT_SPEED),
            rigid_exit_speed_m_s: along(columns::RIGID_EXIT_SPEED),
            vibration_j: along(columns::VIBRATION),
            ball_j: energy(&|energy| energy.ball),
            lost_in_ball_j: energy(&|energy| energy.dissipated_ball),
            bat_j: energy(&|energy| energy.bat_rigid),
        }
    }
}
