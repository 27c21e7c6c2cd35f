//! Several bats side by side: JSON and CSV, in SI.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Serialize, Serializer};

use crate::csv;
use crate::parts::{Column, Units};
use crate::report::comparison::{letter, words};
use crate::report::hit_json::{scene_out, seen_from};
use crate::report::trust::{DoubtFile, in_file};
use crate::schema::hit::Wall;
use crate::schema::{Written, document};
use sweetspot::Theory;
use sweetspot::bat::edit::Edit;
use sweetspot::collision::Ball;
use sweetspot_study::comparison::contender::Contender;
use sweetspot_study::comparison::rows::{Compared, ComparedFigure};
use sweetspot_study::comparison::stretches::Stretch;
use sweetspot_study::comparison::table::Comparison;
use sweetspot_study::ignored::in_hit;

/// Several bats side by side: their figures, their exit speeds at the same places, and the places at which each one
/// hits harder than the first. SI units, named at the end of each member; a value that does not exist is null. Later
/// versions with the same number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "Comparison file of sweetspot, sweetspot-compare/1")]
pub struct CompareFile {
    /// The collision model: how the bending of the bats is treated in a hit.
    #[schemars(extend("enum" = ["rigid", "energy-loss", "pulse", "contact"]))]
    pub model: &'static str,
    /// The conditions common to all bats.
    pub scene: Scene,
    /// The bats, the first the one the others are compared with.
    pub bats: Vec<ComparedBat>,
    /// Exit speeds at equal distances from the tip.
    pub exit_speed_from_tip: Vec<Speeds>,
    /// Exit speeds at equal distances from the knob end.
    pub exit_speed_from_knob: Vec<Speeds>,
    /// The conclusions in sentences.
    pub words: Vec<String>,
}

document!(CompareFile, "compare");

/// The conditions common to all bats: the swing and the ball.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(rename = "CommonScene")]
pub struct Scene {
    /// Rotation centre of the swing beyond the knob end (m), negative inside the handle.
    pub bat_pivot_m: f64,
    /// The ball, with its force law and its restitution.
    pub ball: Ball,
    /// Speed of the ball towards the bat (m/s).
    pub ball_speed_m_s: f64,
    /// Coefficient of restitution, unless the ball's own depends on the speed.
    pub cor: f64,
    /// Position at which the hands feel the hit (m).
    pub hands_m: f64,
    /// The compliance of the barrel under the ball; left out for a rigid barrel.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wall: Option<Wall>,
    /// How the swing depends on the swing weight of the bat; null where all swings are given.
    pub swing_law: Option<SwingLaw>,
}

/// One batter's swing of any bat: reference swing · (reference inertia / inertia)^exponent.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SwingLaw {
    /// Exponent of the law.
    pub exponent: f64,
    /// Swing weight of the reference bat (kg m²).
    pub reference_inertia_kg_m2: f64,
    /// Angular speed of the reference bat (rad/s).
    pub reference_swing_rad_s: f64,
}

/// One of the bats.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ComparedBat {
    /// Name of the bat.
    pub name: String,
    /// The bat's file.
    pub file: String,
    /// Changes made to the bat after it was weighed; left out where there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub edits: Vec<Edit>,
    /// Angular speed of the swing (rad/s).
    pub swing_rad_s: f64,
    /// Frame of the energies: the ground, or the hands for a held bat.
    #[schemars(extend("enum" = ["ground", "hands"]))]
    pub energies_seen_from: &'static str,
    /// Beam theory.
    #[schemars(extend("enum" = Theory::ALL.map(Theory::name)))]
    pub theory: &'static str,
    /// Number of bending modes.
    pub modes: usize,
    /// Whether every exit speed is as accurate as requested.
    pub tolerance_met: bool,
    /// Neglected effects and their consequences.
    pub ignored: Vec<String>,
    /// Reasons for which the answers of a hit are less certain than computed; left out where there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub doubts: Vec<DoubtFile>,
    /// Figures by name, with the unit at the end of the name; null where this bat has none.
    #[serde(serialize_with = "in_order")]
    #[schemars(with = "BTreeMap<String, Option<Compared>>")]
    pub figures: Vec<(String, Option<Compared>)>,
    /// Stretches of the barrel where this bat or the first hits harder; empty for the first.
    pub harder: Vec<Stretch>,
}

/// Named values as an object, in their order.
fn in_order<S: Serializer>(
    figures: &[(String, Option<Compared>)],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer.collect_map(figures.iter().map(|(name, figure)| (name, figure)))
}

/// Exit speeds at one distance, one for each bat; null where ball and bat do not meet.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Speeds {
    /// Distance from the tip, or from the knob end (m).
    pub distance_m: f64,
    /// Exit speeds (m/s).
    pub exit_speed_m_s: Vec<Option<f64>>,
    /// Errors of these speeds (m/s).
    pub error_m_s: Vec<Option<f64>>,
}

/// The `sweetspot-compare/1` document; `files` are the names of the bats' files.
pub fn document(comparison: &Comparison, files: &[String]) -> Written<CompareFile> {
    let bats = comparison.bats.iter().zip(files).enumerate();
    Written::of(CompareFile {
        model: comparison.terms.model.name(),
        scene: scene(&comparison.bats[0]),
        bats: bats.map(|(k, (bat, file))| of_bat(comparison, k, bat, file)).collect(),
        exit_speed_from_tip: speeds(&comparison.from_tip, &comparison.by_tip),
        exit_speed_from_knob: speeds(&comparison.from_knob, &comparison.by_knob),
        words: words(comparison, Units::Si),
    })
}

fn speeds(distances: &[f64], rows: &[ComparedFigure]) -> Vec<Speeds> {
    let of = |(distance, row): (&f64, &ComparedFigure)| Speeds {
        distance_m: *distance,
        exit_speed_m_s: row.values.iter().map(|v| v.map(|f| f.value)).collect(),
        error_m_s: row.values.iter().map(|v| v.map(|f| f.error)).collect(),
    };
    distances.iter().zip(rows).map(of).collect()
}

/// The common part of the scene: all but the swing and the frame of the energies.
fn scene(first: &Contender) -> Scene {
    let scene = scene_out(&first.bat, &first.scene);
    Scene {
        bat_pivot_m: scene.bat_pivot_m,
        ball: scene.ball,
        ball_speed_m_s: scene.ball_speed_m_s,
        cor: scene.cor,
        hands_m: scene.hands_m,
        wall: scene.wall,
        swing_law: first.law.map(|law| SwingLaw {
            exponent: law.exponent,
            reference_inertia_kg_m2: law.reference,
            reference_swing_rad_s: law.of_reference,
        }),
    }
}

fn of_bat(comparison: &Comparison, k: usize, bat: &Contender, file: &str) -> ComparedBat {
    let figures = comparison.figures.iter().map(|row| (row.key_with_unit(), row.values[k]));
    ComparedBat {
        name: bat.bat.name().to_owned(),
        file: file.to_owned(),
        edits: bat.bat.edits().to_vec(),
        swing_rad_s: bat.scene.swing,
        energies_seen_from: seen_from(&bat.bat),
        theory: bat.sweep.solution.theory.name(),
        modes: bat.sweep.solution.modes.len(),
        tolerance_met: bat.sweep.met(),
        ignored: in_hit(&bat.bat, &bat.scene),
        doubts: in_file(&bat.verdict),
        figures: figures.collect(),
        harder: comparison.stretches(k),
    }
}

/// A figure or a speed of one bat.
struct FigureRow {
    quantity: String,
    distance: Option<f64>,
    bat: usize,
    figure: Compared,
}

const COLUMNS: [Column<FigureRow>; 9] = [
    Column::in_files("quantity", |line| line.quantity.as_str().into()),
    Column::in_files("distance_m", |line| line.distance.into()),
    Column::in_files("bat", |line| letter(line.bat).to_string().into()),
    Column::in_files("value", |line| line.figure.value.into()),
    Column::in_files("error", |line| line.figure.error.into()),
    Column::in_files("difference", |line| line.figure.difference.map(|d| d.by).into()),
    Column::in_files("difference_error", |line| line.figure.difference.map(|d| d.within).into()),
    Column::in_files("beyond_errors", |line| {
        line.figure.difference.map(|d| d.beyond_errors).into()
    }),
    Column::in_files("between_pieces", |line| line.figure.between_pieces.into()),
];

/// All figures and speeds, a line for each bat's: SI, the unit at the end of the quantity.
pub fn csv(comparison: &Comparison) -> String {
    let lines = |quantity: String, distance: Option<f64>, row: &ComparedFigure| -> Vec<FigureRow> {
        let known =
            row.values.iter().enumerate().filter_map(|(bat, figure)| Some((bat, (*figure)?)));
        known
            .map(|(bat, figure)| FigureRow { quantity: quantity.clone(), distance, bat, figure })
            .collect()
    };
    let Comparison { figures, from_tip, by_tip, from_knob, by_knob, .. } = comparison;
    let mut all: Vec<FigureRow> =
        figures.iter().flat_map(|row| lines(row.key_with_unit(), None, row)).collect();
    let ends = [("tip", from_tip, by_tip), ("knob", from_knob, by_knob)];
    for (end, distances, rows) in ends {
        for (distance, row) in distances.iter().zip(rows) {
            all.extend(lines(format!("exit_speed_from_{end}_m_s"), Some(*distance), row));
        }
    }
    csv::rows(&COLUMNS, &all)
}
