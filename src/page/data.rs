//! The numbers that the page's script draws, rounded to what a picture shows; the summary is exact.

use serde::Serialize;

use crate::analysis::Analysis;
use crate::collision::hit::{Energy, Impact};
use crate::page::moment::Moment;
use crate::page::summary::Summary;
use crate::profile::{Piece, Profile};
use crate::report::text::rounded;

/// Everything that the script needs.
#[derive(Debug, Clone, Serialize)]
pub struct Data<'a> {
    pub format: &'static str,
    pub summary: &'a Summary,
    pub outline: Outline,
    pub curve: Curve,
    pub modes: Vec<Motion>,
    pub moments: &'a [Moment],
    pub ball_radius_mm: f64,
}

/// The bat's outline at rising places, a step being two at the same; shapes are told there too.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Outline {
    pub length_mm: f64,
    pub x_mm: Vec<f64>,
    pub radius_mm: Vec<f64>,
}

/// Hits along the barrel; null where no ball is hit.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Curve {
    pub x_m: Vec<f64>,
    pub exit_speed_m_s: Vec<Option<f64>>,
    pub rigid_exit_speed_m_s: Vec<Option<f64>>,
    pub vibration_j: Vec<Option<f64>>,
    pub ball_j: Vec<Option<f64>>,
    pub lost_in_ball_j: Vec<Option<f64>>,
    pub bat_j: Vec<Option<f64>>,
}

/// One mode: what moves, and how fast.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Motion {
    pub order: usize,
    pub frequency_hz: f64,
    pub nodes_mm: Vec<f64>,
    pub deflection: Vec<f64>,
}

/// Even points along the bat.
const POINTS: usize = 121;
/// Modes that move.
pub const MOVING: usize = 6;

impl<'a> Data<'a> {
    pub fn new(analysis: &Analysis, summary: &'a Summary, moments: &'a [Moment]) -> Self {
        let outline = Outline::new(&analysis.bat.profile);
        let modes = analysis.solution.modes.iter().take(MOVING);
        let modes = modes.map(|mode| Motion {
            order: mode.order,
            frequency_hz: rounded(mode.frequency(), 2),
            nodes_mm: mode.nodes.iter().map(|x| rounded(1e3 * x, 2)).collect(),
            deflection: (outline.x_mm.iter())
                .map(|x| rounded(mode.shape.deflection(1e-3 * x), 4))
                .collect(),
        });
        Self {
            format: "sweetspot-page/1",
            summary,
            curve: Curve::new(&analysis.hits.impacts),
            modes: modes.collect(),
            outline,
            moments,
            ball_radius_mm: rounded(1e3 * analysis.task.scene.ball.radius, 2),
        }
    }
}

impl Outline {
    fn new(profile: &Profile) -> Self {
        /// More are no steps of a bat that are seen.
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
        let outcomes = || impacts.iter().map(|impact| impact.outcome.as_ref());
        let energy = |of: &dyn Fn(&Energy) -> f64| -> Vec<Option<f64>> {
            outcomes().map(|o| o.map(|o| round(of(&o.energy)))).collect()
        };
        Self {
            x_m: impacts.iter().map(|impact| rounded(impact.x, 6)).collect(),
            exit_speed_m_s: outcomes().map(|o| o.map(|o| round(o.exit_speed))).collect(),
            rigid_exit_speed_m_s: impacts.iter().map(|i| i.rigid_exit_speed.map(round)).collect(),
            vibration_j: energy(&|energy| energy.vibration()),
            ball_j: energy(&|energy| energy.ball),
            lost_in_ball_j: energy(&|energy| energy.dissipated_ball),
            bat_j: energy(&|energy| energy.bat_rigid),
        }
    }
}
