//! The numbers that the page's script draws, rounded to what a picture shows; the summary is exact.

use serde::Serialize;

use crate::analysis::Analysis;
use crate::collision::hit::Impact;
use crate::page::moment::Moment;
use crate::page::summary::Summary;
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

/// The bat's outline, and the places at which shapes are told: even ones from knob to tip.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Outline {
    pub length_mm: f64,
    pub radius_mm: Vec<f64>,
}

/// Hits along the barrel; null where no ball is hit.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Curve {
    pub x_m: Vec<f64>,
    pub exit_speed_m_s: Vec<Option<f64>>,
    pub rigid_exit_speed_m_s: Vec<Option<f64>>,
    pub vibration_j: Vec<Option<f64>>,
}

/// One mode: what moves, and how fast.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Motion {
    pub order: usize,
    pub frequency_hz: f64,
    pub deflection: Vec<f64>,
}

/// Points along the bat.
const POINTS: usize = 121;
/// Modes that move.
pub const MOVING: usize = 6;

impl<'a> Data<'a> {
    pub fn new(analysis: &Analysis, summary: &'a Summary, moments: &'a [Moment]) -> Self {
        let length = analysis.bat.length();
        let places: Vec<f64> =
            (0..POINTS).map(|k| length * k as f64 / (POINTS - 1) as f64).collect();
        let radius = |x: &f64| rounded(1e3 * analysis.bat.profile.at(*x).outer, 2);
        let modes = analysis.solution.modes.iter().take(MOVING);
        let modes = modes.map(|mode| Motion {
            order: mode.order,
            frequency_hz: rounded(mode.frequency(), 2),
            deflection: places.iter().map(|x| rounded(mode.shape.deflection(*x), 4)).collect(),
        });
        Self {
            format: "sweetspot-page/1",
            summary,
            outline: Outline {
                length_mm: rounded(1e3 * length, 3),
                radius_mm: places.iter().map(radius).collect(),
            },
            curve: Curve::new(&analysis.hits.impacts),
            modes: modes.collect(),
            moments,
            ball_radius_mm: rounded(1e3 * analysis.task.scene.ball.radius, 2),
        }
    }
}

impl Curve {
    fn new(impacts: &[Impact]) -> Self {
        let round = |value: f64| rounded(value, 3);
        let outcomes = || impacts.iter().map(|impact| impact.outcome.as_ref());
        Self {
            x_m: impacts.iter().map(|impact| rounded(impact.x, 6)).collect(),
            exit_speed_m_s: outcomes().map(|o| o.map(|o| round(o.exit_speed))).collect(),
            rigid_exit_speed_m_s: impacts.iter().map(|i| i.rigid_exit_speed.map(round)).collect(),
            vibration_j: outcomes().map(|o| o.map(|o| round(o.energy.vibration()))).collect(),
        }
    }
}
