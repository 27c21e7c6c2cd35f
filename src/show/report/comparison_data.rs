//! Several bats side by side: JSON and CSV, in SI.

use serde_json::{Map, Value, json};

use crate::show::csv::Csv;
use crate::show::report::comparison::{letter, words};
use crate::show::report::hit_json::{hit, model_name, seen_from};
use crate::show::report::json::generator;
use crate::show::report::text::Units;
use crate::study::comparison::contender::Contender;
use crate::study::comparison::rows::ComparedFigure;
use crate::study::comparison::table::Comparison;
use crate::study::ignored::in_hit;

/// The `sweetspot-compare/1` document; `files` are the names of the bats' files.
pub fn json(comparison: &Comparison, files: &[String]) -> Value {
    let bats = comparison.bats.iter().zip(files).enumerate();
    let bats: Vec<Value> = bats.map(|(k, (bat, file))| of_bat(comparison, k, bat, file)).collect();
    let speeds = |distances: &[f64], rows: &[ComparedFigure]| {
        let of = |distance: &f64, row: &ComparedFigure| {
            let mut document = json!({ "distance_m": distance });
            document["exit_speed_m_s"] = row.values.iter().map(|v| v.map(|f| f.value)).collect();
            document["error_m_s"] = row.values.iter().map(|v| v.map(|f| f.error)).collect();
            document
        };
        distances.iter().zip(rows).map(|(d, row)| of(d, row)).collect::<Vec<_>>()
    };
    json!({
        "format": "sweetspot-compare/1",
        "generator": generator(),
        "model": model_name(comparison.terms.model),
        "scene": scene(comparison),
        "bats": bats,
        "exit_speed_from_tip": speeds(&comparison.from_tip, &comparison.by_tip),
        "exit_speed_from_knob": speeds(&comparison.from_knob, &comparison.by_knob),
        "words": words(comparison, Units::Si),
    })
}

/// What the bats have in common: all of a hit's scene but the swing and what sees the energies.
fn scene(comparison: &Comparison) -> Value {
    let first = &comparison.bats[0];
    let model = comparison.terms.model;
    let mut scene = hit(&first.bat, model, &first.scene, &[], &first.spot)["scene"].take();
    if let Some(members) = scene.as_object_mut() {
        members.shift_remove("swing_rad_s");
        members.shift_remove("energies_seen_from");
    }
    scene["swing_law"] = json!(first.law.map(|law| json!({
        "exponent": law.exponent,
        "reference_inertia_kg_m2": law.reference,
        "reference_swing_rad_s": law.of_reference,
    })));
    scene
}

fn of_bat(comparison: &Comparison, k: usize, bat: &Contender, file: &str) -> Value {
    let mut figures = Map::new();
    for row in &comparison.figures {
        let value = row.values[k].map(|figure| {
            let mut value = json!({ "value": figure.value, "error": figure.error });
            if let Some(difference) = row.difference(k).filter(|_| k > 0) {
                value["difference"] = json!(difference.by);
                value["difference_error"] = json!(difference.within);
                value["beyond_errors"] = json!(difference.is_real());
            }
            value
        });
        figures.insert(format!("{}{}", row.key, row.unit.suffix()), json!(value));
    }
    let stretches = comparison.stretches(k).into_iter().filter(|_| k > 0).map(|s| {
        json!({
            "from_tip_m": [s.from, s.to],
            "harder": match s.harder { 0 => None, 1 => Some("this"), _ => Some("the first") },
            "largest_difference_m_s": s.most.by,
            "largest_difference_error_m_s": s.most.within,
            "largest_at_from_tip_m": s.most_at,
        })
    });
    json!({
        "name": bat.bat.name,
        "file": file,
        "swing_rad_s": bat.scene.swing,
        "energies_seen_from": seen_from(&bat.bat),
        "theory": bat.sweep.solution.theory.name(),
        "modes": bat.sweep.solution.modes.len(),
        "tolerance_met": bat.sweep.met,
        "ignored": in_hit(&bat.bat, bat.scene.wall.is_some()),
        "figures": figures,
        "harder": stretches.collect::<Vec<_>>(),
    })
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
