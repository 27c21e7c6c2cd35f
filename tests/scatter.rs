//! Results of `sweetspot scatter`: closed forms, known indices, and the same bytes on every computer.

use crate::common;

use common::folder::Folder;
use serde_json::Value;
use sweetspot_study::many::indices::{Indices, VariateKind};
use sweetspot_study::many::sobol::Sobol;

const R161: &str = include_str!("../meshes/r161.json");

/// G is proportional to E; density and E are lognormal and correlated.
const LOGNORMAL: &str = r#"{ "format": "sweetspot-scatter/1",
    "correlation": [["density", "youngs_modulus", 0.6]],
    "density": { "lognormal": "4 %" }, "youngs_modulus": { "lognormal": "10 %" },
    "outputs": ["f1_hz", "f2_hz", "mass_kg"], "tol": 1e-6 }"#;

/// Every quantity that can vary.
const ALL: &str = r#"{ "format": "sweetspot-scatter/1",
    "correlation": [["density", "youngs_modulus", 0.6]],
    "scene": { "swing_speed": "50 rad/s", "pitch": "90 mph" },
    "density": { "lognormal": "4 %" }, "youngs_modulus": { "lognormal": "10 %" },
    "shear_over_young": { "lognormal": "15 %" }, "turning": { "normal": "0.1 mm", "along": "12 in" },
    "swing_speed": { "normal": "4 %" }, "pitch": { "normal": "3 %" }, "cor": { "normal": 0.016 },
    "impact": { "normal": "0.5 in" },
    "outputs": ["f1_hz", "exit_speed_m_s@impact", "exit_speed_max.x_m"] }"#;

fn folder(name: &str, scatter: &str) -> Folder {
    let folder = Folder::new(name);
    folder.write("r161.json", R161);
    folder.write("scatter.json", scatter);
    folder
}

fn run(folder: &Folder, more: &[&str]) -> Value {
    folder.json(&[&["scatter", "r161.json", "scatter.json", "--json", "-"], more].concat())
}

fn output<'a>(document: &'a Value, name: &str) -> &'a Value {
    document["outputs"].as_array().unwrap().iter().find(|one| one["name"] == name).unwrap()
}

fn share(document: &Value, name: &str, order: &str, input: &str) -> (f64, f64) {
    let inputs = document["inputs"].as_array().unwrap();
    let k = inputs.iter().position(|one| one["name"] == input).unwrap();
    let share = &output(document, name)["shares"][order][k];
    (share["value"].as_f64().unwrap(), share["sd"].as_f64().unwrap())
}

/// `f ∝ √(E/ρ)` with E and ρ lognormal: ln f is normal, sd ½√(σ_E² + σ_ρ² − 2 r σ_E σ_ρ) = 0.0412311.
#[test]
fn s1_lognormal_wood_has_percentiles_and_shares_in_closed_form() {
    let folder = folder("s1", LOGNORMAL);
    let found = run(&folder, &["--points", "4096"]);
    for (name, known) in [
        ("f1_hz", [163.06594, 186.75409]),
        ("f2_hz", [543.13922, 622.03962]),
        ("mass_kg", [0.81365902, 0.92809089]),
    ] {
        for (percent, known) in [5.0, 95.0].into_iter().zip(known) {
            let all = output(&found, name)["percentiles"].as_array().unwrap();
            let one = all.iter().find(|one| one["percent"] == percent).unwrap();
            let [value, error] = ["value", "error"].map(|key| one[key].as_f64().unwrap());
            assert!((value / known - 1.0).abs() < 1e-3, "{name} {percent} %: {value} {known}");
            assert!(
                (value - known).abs() < error,
                "{name} {percent} %: {value} ± {error}, {known}"
            );
        }
    }
    for (input, known) in [("density", 0.0588235), ("youngs_modulus", 0.9411765)] {
        let (value, sd) = share(&found, "f1_hz", "first", input);
        // Shares of f, not of ln f: σ² = 0.0017 apart at most.
        assert!((value - known).abs() < 1e-3 + 3.0 * sd, "{input} {value} {known}");
    }
    assert_eq!(found["inputs"][1]["given"][0], "density");
    let said = found["words"][0].as_str().unwrap();
    assert_eq!(said, "Of the spread of f1_hz, 94 % is youngs_modulus given density, 6 % density.");
}

/// T. Ishigami, T. Homma (1990), a = 7, b = 0.1.
#[test]
fn s2_ishigamis_function_has_its_known_indices() {
    let sobol = Sobol::new(3, 1);
    let row = |k: u64| {
        let shares: Vec<f64> = (0..3).map(|c| sobol.at(k, c)).collect();
        let x = [0, 1, 2].map(|c| std::f64::consts::PI * (2.0 * shares[c] - 1.0));
        let y = x[0].sin() + 7.0 * x[1].sin().powi(2) + 0.1 * x[2].powi(4) * x[0].sin();
        (shares, y)
    };
    let rows: Vec<(Vec<f64>, f64)> = (0..4096).map(row).collect();
    let found = Indices::new(&[VariateKind::Share; 3], &rows).unwrap();
    let known = [[0.3139, 0.4424, 0.0], [0.5576, 0.4424, 0.2437]];
    for (found, known) in [&found.first, &found.total].into_iter().zip(known) {
        for (found, known) in found.iter().zip(known) {
            assert!((found.value - known).abs() < 2e-3, "{found:?} {known}");
        }
    }
    // By groups: the interaction of the first and the last belongs to their group.
    let groups = Indices::grouped(&[VariateKind::Share; 3], &[0, 1, 0], &rows).unwrap();
    assert_eq!(groups.first.len(), 2);
    assert!((groups.first[0].value - 0.5576).abs() < 2e-3, "{:?}", groups.first);
}

#[test]
fn s3_the_same_seed_gives_the_same_bytes_on_any_number_of_threads() {
    let folder = folder("s3", ALL);
    let bytes = |jobs: &str, seed: &str, out: &str| {
        let args = ["scatter", "r161.json", "scatter.json", "--points", "64", "--jobs", jobs];
        folder.text(&[&args[..], &["--seed", seed, "--csv", "rows.csv", "--bats", out]].concat());
        let bats = ["p05", "p50", "p95"].map(|bat| folder.read(&format!("{out}/{bat}.json")));
        (
            folder.read("rows.csv"),
            bats,
            run(&folder, &["--points", "64", "--jobs", jobs, "--seed", seed]),
        )
    };
    let one = bytes("1", "7", "one");
    assert_eq!(one, bytes("3", "7", "three"));
    assert_ne!(one.0, bytes("2", "8", "two").0);
    assert_eq!(one.0.lines().count(), 65);
    // A written bat is that of its row.
    let table: Vec<Vec<&str>> = one.0.lines().map(|line| line.split(',').collect()).collect();
    let f1 = table[0].iter().position(|head| *head == "f1_hz").unwrap();
    let wanted = output(&one.2, "f1_hz")["percentiles"][3]["value"].as_f64().unwrap();
    let values = table[1..].iter().map(|row| row[f1].parse::<f64>().unwrap());
    let nearest = values.min_by(|a, b| (a - wanted).abs().total_cmp(&(b - wanted).abs())).unwrap();
    let solved = folder.json(&["modes", "one/p50.json", "-n", "1", "--tol", "1e-6", "--json", "-"]);
    let frequency = solved["modes"][0]["frequency_hz"].as_f64().unwrap();
    assert!((frequency / nearest - 1.0).abs() < 1e-4, "{frequency} {nearest}");
}

/// Compared with an independent solver and estimator, from 1024 bats each.
#[test]
fn bats_and_swings_differ_as_an_independent_program_found() {
    let folder = folder("all", ALL);
    let found = run(&folder, &["--points", "1024"]);
    let mph = 0.44704;
    for (name, unit, known, within) in [
        ("f1_hz", 1.0, [163.0, 174.6, 187.0], 0.5),
        ("exit_speed_m_s@impact", mph, [115.0, 123.2, 132.1], 0.8),
    ] {
        let all = output(&found, name)["percentiles"].as_array().unwrap();
        for (percent, known) in [5.0, 50.0, 95.0].into_iter().zip(known) {
            let one = all.iter().find(|one| one["percent"] == percent).unwrap();
            let value = one["value"].as_f64().unwrap() / unit;
            assert!((value - known).abs() < within, "{name} {percent} %: {value} {known}");
        }
    }
    for (name, input, known) in [
        ("f1_hz", "youngs_modulus", 0.93),
        ("f1_hz", "density", 0.06),
        ("f1_hz", "turning", 0.01),
        ("exit_speed_m_s@impact", "swing_speed", 0.67),
        ("exit_speed_m_s@impact", "cor", 0.18),
        ("exit_speed_m_s@impact", "density", 0.11),
        ("exit_speed_m_s@impact", "impact", 0.03),
        ("exit_speed_m_s@impact", "pitch", 0.01),
        ("exit_speed_max.x_m", "youngs_modulus", 0.74),
        ("exit_speed_max.x_m", "shear_over_young", 0.14),
        ("exit_speed_max.x_m", "swing_speed", 0.10),
    ] {
        let (value, _) = share(&found, name, "first", input);
        assert!((value - known).abs() < 0.015, "{name} {input}: {value} {known}");
    }
}

/// The remaining uncertainty of a calibration is what scatters: the spread of the measured f1 is that of its reading.
#[test]
fn a_calibration_is_scattered_by_its_covariance() {
    let folder = Folder::new("covariance");
    folder.write("r161.json", R161);
    folder.write("readings.json", include_str!("golden/readings-1.json"));
    let made =
        ["calibrate", "r161.json", "readings.json", "--out", "mine.json", "--json", "wood.json"];
    folder.text(&made);
    let text = r#"{ "format": "sweetspot-scatter/1", "covariance": "wood.json", "outputs": ["f1_hz", "mass_kg"],
        "tol": 1e-6 }"#;
    folder.write("scatter.json", text);
    let found =
        folder.json(&["scatter", "mine.json", "scatter.json", "--points", "256", "--json", "-"]);
    let wood: Value = serde_json::from_str(&folder.read("wood.json")).unwrap();
    let data = wood["data"].as_array().unwrap();
    for name in ["f1_hz", "mass_kg"] {
        let sd = output(&found, name)["sd"].as_f64().unwrap();
        let datum = data.iter().find(|one| one["name"] == name).unwrap();
        let reading = datum["sd"].as_f64().unwrap();
        // The other readings also contribute to it.
        assert!(sd < 1.02 * reading && sd > 0.3 * reading, "{name}: {sd} {reading}");
    }
}

/// Without a file the wood varies as in `analyze`, which propagates it to first order; here bats are drawn and solved.
#[test]
fn without_a_file_bats_differ_as_analyze_says_beside_the_sweet_spot() {
    let folder = Folder::new("wood-alone");
    folder.write("r161.json", R161);
    let drawn = folder.json(&["scatter", "r161.json", "--points", "256", "--json", "-"]);
    let said = folder.json(&["analyze", "r161.json", "--json", "-", "--quiet"]);
    let open = &said["open"];
    let sources = open["sources"].as_array().unwrap();
    let of_wood = |input: &str| sources.iter().position(|source| source["input"] == input).unwrap();
    let wood = ["stiffness", "density"].map(of_wood);
    for (name, answer) in [
        ("exit_speed_max.x_m", "best_place_m"),
        ("exit_speed_max.value", "exit_speed_m_s"),
        ("f1_hz", "frequency_1_hz"),
        ("mass_kg", "mass_kg"),
    ] {
        let answers = open["answers"].as_array().unwrap();
        let estimate = answers.iter().find(|one| one["answer"] == answer).unwrap();
        let part = |k: usize| estimate["by_source"][k].as_f64().unwrap();
        let first_order = wood.map(part).into_iter().fold(0.0, f64::hypot);
        let sd = output(&drawn, name)["sd"].as_f64().unwrap();
        assert!((sd / first_order - 1.0).abs() < 0.03, "{name} {sd} {first_order}");
    }
    // A node does not depend on the wood, because G is proportional to E; round-off has no shares.
    assert!(output(&drawn, "node_mode_1_m")["shares"].is_null());
    let words = drawn["words"].as_array().unwrap();
    assert!(words.iter().any(|one| one == "node_mode_1_m is the same of all bats."), "{words:?}");
    // Nothing is known about the scatter of other materials.
    folder.write("tube.json", include_str!("../meshes/northwestern_aluminium.json"));
    let output = folder.run(&["scatter", "tube.json"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("a scatter file"));
}

/// Balls that are drawn beyond the end of the bat are no hits at the tip: with the mean at the tip, half of them.
#[test]
fn a_ball_beyond_the_end_misses() {
    let folder = folder(
        "beyond",
        r#"{ "format": "sweetspot-scatter/1", "impact": { "normal": "1 in", "at": "84 cm" },
            "outputs": ["exit_speed_m_s@impact"] }"#,
    );
    let found = run(&folder, &["--points", "64"]);
    let reason = &found["reasons"][0];
    let rows = reason["rows"].as_u64().unwrap();
    assert!((31..=33).contains(&rows), "{reason}");
    assert!(reason["reason"].as_str().unwrap().contains("beyond the bat's end"), "{reason}");
}

/// A bat clamped at the knob has no node of mode 1; its other outputs scatter all the same.
#[test]
fn an_output_that_no_bat_has_leaves_the_others() {
    let folder = Folder::new("clamped");
    let bat = r#"{ "format": "sweetspot-bat/1", "material": "white-ash-dynamic",
        "profile": { "unit": "in", "x": [0, 33], "diameter": [1, 2.5], "interpolation": "linear" },
        "supports": [{ "x": 0, "type": "clamped" }] }"#;
    folder.write("clamped.json", bat);
    let found = folder.json(&["scatter", "clamped.json", "--points", "64", "--json", "-"]);
    assert_eq!(found["answered"], 64, "{found}");
    assert!(output(&found, "f1_hz")["sd"].as_f64().unwrap() > 0.0);
    let node = output(&found, "node_mode_1_m");
    assert!(node["mean"].is_null() && node["percentiles"].as_array().unwrap().is_empty(), "{node}");
}
