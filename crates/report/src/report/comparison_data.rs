//! Several bats side by side: JSON and CSV, in SI.

use crate::csv::Csv;
use crate::parts::units::Units;
use crate::report::comparison::{letter, words};
use crate::report::hit_json::{scene_out, seen_from};
use crate::report::trust::in_file;
use crate::schema::compare as file;
use sweetspot::files::schema::document::{Format, Generator};
use sweetspot_study::comparison::contender::Contender;
use sweetspot_study::comparison::rows::ComparedFigure;
use sweetspot_study::comparison::stretches::Stretch;
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

/// What the bats have in common: all of a hit's scene but the swing and what sees the energies.
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
    let figure = |row: &ComparedFigure| {
        let figure = row.values[k]?;
        let difference = row.difference(k).filter(|_| k > 0);
        Some(file::Figure {
            value: figure.value,
            error: figure.error,
            difference: difference.map(|difference| difference.by),
            difference_error: difference.map(|difference| difference.within),
            beyond_errors: difference.map(|difference| difference.is_real()),
            between_pieces: comparison.between_pieces(&row.key, k).filter(|_| k > 0),
        })
    };
    let figures = comparison.figures.iter();
    let stretches = comparison.stretches(k).into_iter().filter(|_| k > 0);
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
        figures: figures
            .map(|row| (format!("{}{}", row.key, row.unit.suffix()), figure(row)))
            .collect(),
        harder: stretches.map(stretch).collect(),
    }
}

fn stretch(stretch: Stretch) -> file::Stretch {
    file::Stretch {
        from_tip_m: [stretch.from, stretch.to],
        harder: match stretch.harder {
            0 => None,
            1 => Some("this"),
            _ => Some("the first"),
        },
        largest_difference_m_s: stretch.most.by,
        largest_difference_error_m_s: stretch.most.within,
        largest_at_from_tip_m: stretch.most_at,
    }
}

/// All figures and speeds, a line for each bat's: SI, the unit at the end of the quantity.
pub fn csv(comparison: &Comparison) -> String {
    let mut table = Csv::new([
        "quantity",
        "distance_m",
        "bat",
        "value",
        "error",
        "difference",
        "difference_error",
        "beyond_errors",
        "between_pieces",
    ]);
    let mut add = |name: &str, distance: Option<f64>, row: &ComparedFigure| {
        for (k, figure) in row.values.iter().enumerate() {
            let Some(figure) = figure else { continue };
            let difference = row.difference(k).filter(|_| k > 0);
            table.row([
                format!("{name}{}", row.unit.suffix()).into(),
                distance.into(),
                letter(k).to_string().into(),
                figure.value.into(),
                figure.error.into(),
                difference.map(|d| d.by).into(),
                difference.map(|d| d.within).into(),
                difference.map(|d| d.is_real()).into(),
                comparison
                    .between_pieces(&row.key, k)
                    .filter(|_| k > 0 && distance.is_none())
                    .into(),
            ]);
        }
    };
    for row in &comparison.figures {
        add(&row.key, None, row);
    }
    for (d, row) in comparison.from_tip.iter().zip(&comparison.by_tip) {
        add("exit_speed_from_tip", Some(*d), row);
    }
    for (d, row) in comparison.from_knob.iter().zip(&comparison.by_knob) {
        add("exit_speed_from_knob", Some(*d), row);
    }
    table.text()
}
