//! Several bats side by side: JSON and CSV, in SI.

use crate::csv;
use crate::parts::table::Column;
use crate::parts::units::Units;
use crate::report::comparison::{letter, words};
use crate::report::hit_json::{scene_out, seen_from};
use crate::report::trust::in_file;
use crate::schema::compare as file;
use sweetspot::files::schema::document::{Format, Generator};
use sweetspot_study::comparison::contender::Contender;
use sweetspot_study::comparison::rows::{Compared, ComparedFigure};
use sweetspot_study::comparison::table::Comparison;
use sweetspot_study::ignored::in_hit;

/// The `sweetspot-compare/1` document; `files` are the names of the bats' files.
pub fn document(comparison: &Comparison, files: &[String]) -> file::CompareFile {
    let bats = comparison.bats.iter().zip(files).enumerate();
    file::CompareFile {
        format: Format::new(),
        generator: Generator::this(),
        model: comparison.terms.model.name(),
        scene: scene(&comparison.bats[0]),
        bats: bats.map(|(k, (bat, file))| of_bat(comparison, k, bat, file)).collect(),
        exit_speed_from_tip: speeds(&comparison.from_tip, &comparison.by_tip),
        exit_speed_from_knob: speeds(&comparison.from_knob, &comparison.by_knob),
        words: words(comparison, Units::Si),
    }
}

fn speeds(distances: &[f64], rows: &[ComparedFigure]) -> Vec<file::Speeds> {
    let of = |(distance, row): (&f64, &ComparedFigure)| file::Speeds {
        distance_m: *distance,
        exit_speed_m_s: row.values.iter().map(|v| v.map(|f| f.value)).collect(),
        error_m_s: row.values.iter().map(|v| v.map(|f| f.error)).collect(),
    };
    distances.iter().zip(rows).map(of).collect()
}

/// The common part of the scene: all but the swing and the frame of the energies.
fn scene(first: &Contender) -> file::Scene {
    let scene = scene_out(&first.bat, &first.scene);
    file::Scene {
        bat_pivot_m: scene.bat_pivot_m,
        ball: scene.ball,
        ball_speed_m_s: scene.ball_speed_m_s,
        cor: scene.cor,
        hands_m: scene.hands_m,
        wall: scene.wall,
        swing_law: first.law.map(|law| file::SwingLaw {
            exponent: law.exponent,
            reference_inertia_kg_m2: law.reference,
            reference_swing_rad_s: law.of_reference,
        }),
    }
}

fn of_bat(comparison: &Comparison, k: usize, bat: &Contender, file: &str) -> file::ComparedBat {
    let figures = comparison.figures.iter().map(|row| (row.key_with_unit(), row.values[k]));
    file::ComparedBat {
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
struct Line {
    quantity: String,
    distance: Option<f64>,
    bat: usize,
    figure: Compared,
}

const COLUMNS: [Column<Line>; 9] = [
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
    let lines = |quantity: String, distance: Option<f64>, row: &ComparedFigure| -> Vec<Line> {
        let known =
            row.values.iter().enumerate().filter_map(|(bat, figure)| Some((bat, (*figure)?)));
        known
            .map(|(bat, figure)| Line { quantity: quantity.clone(), distance, bat, figure })
            .collect()
    };
    let Comparison { figures, from_tip, by_tip, from_knob, by_knob, .. } = comparison;
    let mut all: Vec<Line> =
        figures.iter().flat_map(|row| lines(row.key_with_unit(), None, row)).collect();
    let ends = [("tip", from_tip, by_tip), ("knob", from_knob, by_knob)];
    for (end, distances, rows) in ends {
        for (distance, row) in distances.iter().zip(rows) {
            all.extend(lines(format!("exit_speed_from_{end}_m_s"), Some(*distance), row));
        }
    }
    csv::rows(&COLUMNS, &all)
}
