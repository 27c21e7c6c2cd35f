//! The numbers that the script of the page draws, rounded to what a picture shows; those of the summary are exact.

use schemars::JsonSchema;
use serde::Serialize;

use crate::analysis::Analysis;
use crate::page::barrel::RingingBarrel;
use crate::page::moment::Moment;
use crate::page::summary::Summary;
use sweetspot::Profile;
use sweetspot::base::number::rounded;
use sweetspot::bat::profile::Piece;
use sweetspot::collision::Impact;
use sweetspot::collision::columns::{self, Column};
use sweetspot::collision::hit::Energy;
use sweetspot::files::schema::document::{Document, Format};
use sweetspot::motion::sound::{ASSUMED_LOSS, Sound};

/// What the script of a report draws: the outline of the bat, hits along the barrel, modes and hits in time. SI units,
/// named at the end of each member; positions count from the knob end; a value that does not exist is null. Numbers are
/// rounded to what a picture shows, except those of the summary.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "Data of a report of sweetspot, sweetspot-page/1")]
pub struct Data<'a> {
    /// Name of the format and its version: sweetspot-page/1.
    pub format: Format<Data<'a>>,
    /// The numbers at the top of the page, not rounded.
    pub summary: &'a Summary,
    /// The outline of the bat.
    pub outline: Outline,
    /// The hits along the barrel.
    pub curve: Curve,
    /// The first modes, six at most.
    pub modes: Vec<MovingMode>,
    /// The ringing barrel of a hollow bat; left out for others.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub barrel: Option<RingingBarrel>,
    /// Hits in time; empty where the model has no force in time.
    pub moments: &'a [Moment],
    /// The sound of a tap on the tip.
    pub tap: Heard<'a>,
    /// The sound of the hit at the sweet spot; null where the model has no force in time.
    pub crack: Option<Heard<'a>>,
    /// How large the ball is drawn (mm).
    pub ball_radius_mm: f64,
}

impl Document for Data<'_> {
    const NAME: &'static str = "page";
}

/// The outline of the bat at rising places, with a step as two equal places; shapes are given at these places too.
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
    /// Position of the impact (m from the knob end), rising.
    pub x_m: Vec<f64>,
    /// Speed of the ball off the bat (m/s).
    pub exit_speed_m_s: Vec<Option<f64>>,
    /// Speed of the ball off the bat if the bat did not bend (m/s).
    pub rigid_exit_speed_m_s: Vec<Option<f64>>,
    /// Energy left in bending vibration (J).
    pub vibration_j: Vec<Option<f64>>,
    /// Energy of the ball after the hit (J).
    pub ball_j: Vec<Option<f64>>,
    /// Energy lost in the compression of the ball (J).
    pub lost_in_ball_j: Vec<Option<f64>>,
    /// Energy of the rigid motion of the bat after the hit (J).
    pub bat_j: Vec<Option<f64>>,
}

/// One mode: its motion and its frequency.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct MovingMode {
    /// Number of the bending mode, from 1.
    pub order: usize,
    /// Natural frequency (Hz).
    pub frequency_hz: f64,
    /// Its nodes (mm from the knob end).
    pub nodes_mm: Vec<f64>,
    /// At the places of the outline, the largest of the whole shape 1.
    pub deflection: Vec<f64>,
}

/// Even points along the bat.
const POINTS: usize = 121;
/// Modes that move.
pub const MOVING: usize = 6;

/// A sound, and the assumption made for it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct Heard<'a> {
    /// The sound.
    #[serde(flatten)]
    pub sound: &'a Sound,
    /// The loss factor assumed for materials without one; null where all have one.
    pub assumed_loss_factor: Option<f64>,
}

impl<'a> Data<'a> {
    /// The numbers of an analysis, rounded except those of the summary.
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

/// The hits along the barrel, including the one at the sweet spot, so that a reader of the curve can stop on it.
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
        /// Most steps drawn; more could not be distinguished.
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
