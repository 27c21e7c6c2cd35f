//! Many bats: every row is correct by itself on any machine, and no completed row is lost.

use crate::common;

use std::path::Path;
use std::process::Stdio;
use std::thread::sleep;
use std::time::Duration;

use common::folder::Folder;

const DOWEL: &str = r#"{
  "format": "sweetspot-bat/1",
  "name": "dowel",
  "material": { "density": 700, "youngs_modulus": "14 GPa" },
  "profile": { "unit": "in", "x": [0, 33], "diameter": [1.7, 1.7] }
}
"#;

/// A folder with that bat and a study of it.
fn study(name: &str, text: &str) -> Folder {
    let folder = Folder::new(name);
    folder.write("dowel.json", DOWEL);
    folder.write("study.json", text);
    folder
}

/// The table of a part: its head, and rows by column.
fn table(folder: &Folder, part: &str) -> (Vec<String>, Vec<Vec<String>>) {
    let text = folder.read(part);
    let mut lines = text.lines().map(|line| {
        let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(line.as_bytes());
        let record = reader.records().next().unwrap().unwrap();
        record.iter().map(str::to_owned).collect::<Vec<String>>()
    });
    (lines.next().unwrap(), lines.collect())
}

fn column(table: &(Vec<String>, Vec<Vec<String>>), name: &str) -> Vec<f64> {
    let k = table.0.iter().position(|head| head == name).unwrap_or_else(|| panic!("{name}"));
    table.1.iter().map(|row| row[k].parse().unwrap()).collect()
}

const SCATTER: &str = r#"{
  "format": "sweetspot-study/1",
  "bat": "dowel.json",
  "vary": {
    "bat.material.density": { "lognormal": [650, 0.04] },
    "bat.profile.diameter[1]": { "values": ["1.7 in", "43.18 mm"] },
    "bat.material.youngs_modulus": { "normal": ["14 GPa", "0.5 GPa"] }
  },
  "points": 50,
  "seed": 3,
  "outputs": ["mass_kg", "f1_hz", "f2_hz", "balance_point_m", "node_mode_1_m"],
  "tol": 1e-9
}
"#;

/// A free uniform beam without shear: `f ∝ √(E/ρ)`, `m = ρ π r² L`; both ways of writing one diameter are the
/// same bat.
#[test]
fn every_row_is_the_bat_that_it_says() {
    let folder = study("study-rows", SCATTER);
    let said = folder.text(&["study", "study.json", "--out", "out"]);
    assert!(said.starts_with("100 bats, 100 of them as accurate as asked\n"), "{said}");
    let table = table(&folder, "out/part-000000.csv");
    let [rho, e] =
        ["bat.material.density", "bat.material.youngs_modulus"].map(|n| column(&table, n));
    let [mass, f1, f2] = ["mass_kg", "f1_hz", "f2_hz"].map(|name| column(&table, name));
    let [balance, node] = ["balance_point_m", "node_mode_1_m"].map(|name| column(&table, name));
    let (r, length) = (0.85 * 0.0254_f64, 33.0 * 0.0254);
    let near = |a: f64, b: f64, within: f64| assert!((a - b).abs() <= within * b.abs(), "{a} {b}");
    for k in 0..100 {
        near(mass[k], rho[k] * std::f64::consts::PI * r * r * length, 1e-12);
        // Rotary inertia does not depend on E and ρ apart from their ratio.
        let root = (1e9 * e[k] / rho[k]).sqrt() / (1e9 * e[0] / rho[0]).sqrt();
        near(f1[k], f1[0] * root, 1e-8);
        near(f2[k], f2[0] * root, 1e-8);
        near(balance[k], 0.5 * length, 1e-12);
        near(node[k], node[0], 1e-6);
        assert_eq!(table.1[k][0], k.to_string());
    }
    for k in 0..50 {
        near(rho[k + 50], rho[k], 0.0);
        near(f1[k + 50], f1[k], 1e-12);
    }
    assert!(rho.iter().any(|rho| *rho < 620.0) && rho.iter().any(|rho| *rho > 680.0));
}

/// A requested place is hit as by `hit`, with the scene of the study.
#[test]
fn a_hit_is_the_one_that_hit_computes() {
    let text = r#"{ "format": "sweetspot-study/1", "bat": "r161", "tol": 1e-4,
      "scene": { "swing_speed": "50 rad/s" },
      "vary": { "scene.pitch": { "values": ["80 mph", "90 mph"] },
                "ball.cor": { "grid": [0.45, 0.5, 2] } },
      "outputs": ["exit_speed_m_s@0.65", "exit_speed_max.value", "exit_speed_max.x_m", "f1_hz"] }"#;
    let folder = study("study-hits", text);
    folder.text(&["study", "study.json", "--out", "out"]);
    let table = table(&folder, "out/part-000000.csv");
    // A list with one unit is a column of numbers in it.
    assert_eq!(column(&table, "scene.pitch"), [80.0, 80.0, 90.0, 90.0]);
    let manifest: serde_json::Value =
        serde_json::from_str(&folder.read("out/manifest.json")).unwrap();
    let columns = manifest["columns"].as_array().unwrap();
    let pitch = columns.iter().find(|column| column["name"] == "scene.pitch").unwrap();
    assert_eq!(pitch["unit"], "mph");
    let speeds = column(&table, "exit_speed_m_s@0.65");
    let errors = column(&table, "exit_speed_m_s@0.65_error");
    let best = column(&table, "exit_speed_max.value");
    for (k, (pitch, cor)) in
        [("80 mph", "0.45"), ("80 mph", "0.5"), ("90 mph", "0.45"), ("90 mph", "0.5")]
            .into_iter()
            .enumerate()
    {
        let hit = folder.json(&[
            "hit",
            "r161",
            "--at",
            "0.65",
            "--swing-speed",
            "50",
            "--pitch",
            pitch,
            "--cor",
            cor,
            "--tol",
            "1e-5",
            "--json",
            "-",
        ]);
        let known = hit["impacts"][0]["exit_speed_m_s"].as_f64().unwrap();
        assert!((speeds[k] - known).abs() <= 3.0 * errors[k] + 1e-4, "{} {known}", speeds[k]);
        assert!(best[k] >= speeds[k]);
    }
    // A ball of higher restitution leaves faster.
    assert!(best[1] > best[0] && best[3] > best[2] && best[2] > best[0]);
}

#[test]
fn a_bat_that_cannot_exist_is_a_row_with_its_reason() {
    let text = r#"{ "format": "sweetspot-study/1", "bat": "dowel.json",
      "vary": { "bat.material.density": { "values": [700, -5, 650, "2 lb"] } },
      "outputs": ["mass_kg", "f1_hz"] }"#;
    let folder = study("study-impossible", text);
    let said = folder.text(&["study", "study.json", "--out", "out"]);
    assert!(said.starts_with("4 bats, 2 of them as accurate as asked\n"), "{said}");
    let (_, rows) = table(&folder, "out/part-000000.csv");
    assert_eq!(rows.len(), 4);
    for (k, why) in [(1, "density: found -5"), (3, "found unit \"lb\"")] {
        assert!(rows[k][2..6].iter().all(String::is_empty) && rows[k][6] == "false", "{rows:?}");
        assert!(rows[k][7].contains(why), "{rows:?}");
        assert!(said.contains(&rows[k][7][..20]), "{said}");
    }
    assert!(rows[0][6] == "true" && rows[2][7].is_empty());
}

/// An impossible row does not affect the others, whether it is the first value of a list or of a grid, the median of a
/// random input, or a place off the bat; and nothing is hit where no hit is requested.
#[test]
fn the_first_row_is_a_row_as_all_others() {
    for (varied, outputs, bats, good) in [
        (r#""bat.material.density": { "values": [-5, 700] }"#, r#""f1_hz""#, 2, 1),
        (r#""bat.material.density": { "grid": [0, 1000, 5] }"#, r#""f1_hz""#, 5, 4),
        // Of 64 points of Sobol's an eighth lies in the last eighth.
        (r#""bat.material.density": { "uniform": [-700, 100] }"#, r#""mass_kg""#, 64, 8),
        (r#""scene.pitch": { "values": ["-3 mph", "83 mph"] }"#, r#""exit_speed_m_s@0.7""#, 2, 1),
        (
            r#""bat.profile.x[1]": { "values": [20, 33] }"#,
            r#""exit_speed_m_s@0.70", "f1_hz""#,
            2,
            1,
        ),
        // Missing data of a hit cost only the answers of the hit.
        (
            r#""scene.hands": { "values": ["3 in", "2 m"] }"#,
            r#""exit_speed_m_s@0.7", "f1_hz""#,
            2,
            1,
        ),
        // Hands beyond the bat hold nothing, and nothing is hit.
        (r#""scene.hands": { "values": ["2 m"] }"#, r#""mass_kg""#, 1, 1),
    ] {
        let points = if varied.contains("uniform") { r#""points": 64,"# } else { "" };
        let folder = study(
            "study-first",
            &format!(
                r#"{{ "format": "sweetspot-study/1", "bat": "dowel.json", {points}
                      "vary": {{ {varied} }}, "outputs": [{outputs}] }}"#
            ),
        );
        let said = folder.text(&["study", "study.json", "--out", "out"]);
        let head = format!("{bats} bats, {good} of them as accurate as asked\n");
        assert!(said.starts_with(&head), "{varied}: {said}");
        let (names, rows) = table(&folder, "out/part-000000.csv");
        if varied.contains("3 in") {
            let [hit, first] = ["exit_speed_m_s@0.7", "f1_hz"]
                .map(|name| names.iter().position(|other| other == name).unwrap());
            let [one, other] = [0, 1].map(|row| rows[row][first].parse::<f64>().unwrap());
            assert!(rows[1][hit].is_empty() && (one / other - 1.0).abs() < 1e-9, "{rows:?}");
            assert!(rows[1].last().unwrap().contains("a place on the bat"), "{rows:?}");
        }
        // Off a bat of 20 in, which still has its frequency, under the requested name.
        if let Some(k) = names.iter().position(|name| name == "exit_speed_m_s@0.70") {
            assert!(rows[0][k].is_empty() && !rows[0][k + 2].is_empty(), "{rows:?}");
            assert!(
                rows[0].last().unwrap().contains("a place on the bat, 0 to 0.508 m"),
                "{rows:?}"
            );
        }
    }
}

/// No requested place is better than the best: on dowels the exit speed is highest within some millimetres near the
/// tip, where the bat meets the ball again.
#[test]
fn no_place_beats_the_best_one() {
    let places: Vec<String> =
        (0..60).map(|k| format!("\"exit_speed_m_s@{}\"", 0.54 + 0.005 * f64::from(k))).collect();
    let text = format!(
        r#"{{ "format": "sweetspot-study/1", "bat": ["dowel", "r161"], "points": 6,
            "vary": {{ "bat.material.density": {{ "lognormal": [650, 0.1] }},
                       "bat.material.youngs_modulus": {{ "lognormal": ["16 GPa", 0.1] }} }},
            "outputs": ["exit_speed_max.value", "exit_speed_max.x_m", {}] }}"#,
        places.join(", ")
    );
    let folder = study("study-best", &text);
    folder.text(&["study", "study.json", "--out", "out"]);
    let table = table(&folder, "out/part-000000.csv");
    let best = column(&table, "exit_speed_max.value");
    let unsure = column(&table, "exit_speed_max.value_error");
    for name in places {
        let name = name.trim_matches('"');
        let [speeds, errors] =
            [name.to_owned(), format!("{name}_error")].map(|n| column(&table, &n));
        for k in 0..best.len() {
            let off = 3.0 * (errors[k] + unsure[k]);
            assert!(speeds[k] <= best[k] + off, "{k} {name}: {} {}", speeds[k], best[k]);
        }
    }
}

/// The result of a search on a barrel does not depend on other outputs, to the last bit.
#[test]
fn an_answer_asked_alone_is_the_one_among_all() {
    const SOUGHT: [&str; 9] = [
        "exit_speed_max.value",
        "exit_speed_max.x_m",
        "zone_m[0]",
        "zone_m[1]",
        "vibration_min.value",
        "vibration_min.x_m",
        "bbcor_max",
        "hands_velocity_min.value",
        "hands_acceleration_min.value",
    ];
    let of = |asked: &[&str]| {
        let text = format!(
            r#"{{ "format": "sweetspot-study/1", "bat": ["dowel", "r161"], "points": 2, "outputs": {asked:?},
                "vary": {{ "bat.material.density": {{ "lognormal": [650, 0.1] }} }} }}"#
        );
        let folder = study("study-alone", &text);
        folder.text(&["study", "study.json", "--out", "out"]);
        table(&folder, "out/part-000000.csv")
    };
    let all = of(&SOUGHT);
    for name in SOUGHT {
        let alone = of(&[name]);
        for name in [name.to_owned(), format!("{name}_error")] {
            assert_eq!(column(&alone, &name), column(&all, &name), "{name}");
        }
    }
}

/// Where no row is as accurate as requested, the exit code says so.
#[test]
fn a_study_that_reaches_nothing_says_so() {
    let folder = study("study-nothing", &SCATTER.replace("50", "2").replace("1e-9", "1e-17"));
    let output = folder.run(&["study", "study.json", "--out", "out"]);
    assert_eq!(output.status.code(), Some(3));
    assert!(String::from_utf8_lossy(&output.stdout).starts_with("4 bats, 0 of them"));
}

/// A bat that is possible but strange causes a warning with its name before the work: inches read as metres are not
/// refused, but a million rows of them are not computed without a word.
#[test]
fn a_strange_bat_is_warned_of() {
    let text = r#"{ "format": "sweetspot-study/1", "bat": ["dowel", "long.json"], "outputs": ["f1_hz"], "points": 2,
        "vary": { "bat.material.density": { "uniform": [600, 700] } } }"#;
    let folder = study("study-strange", text);
    let long = r#"{ "format": "sweetspot-bat/1", "material": "white-ash-dynamic",
        "profile": { "x": [0, 33], "diameter": [1, 2.5] } }"#;
    folder.write("long.json", long);
    let output = folder.run(&["study", "study.json", "--out", "out"]);
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{told}");
    let lines: Vec<&str> = told.lines().collect();
    assert_eq!(lines.len(), 1, "{told}");
    assert!(lines[0].starts_with("warning: long: length is 33 m"), "{told}");
}

/// Inputs that vary without effect cause a warning: the density of a weighed bat, the modulus of a tapped one, inputs
/// of a hit where nothing is hit, inputs overridden by others.
#[test]
fn what_varies_without_effect_is_warned_of() {
    let weighed = DOWEL.replace(
        "\"profile\"",
        "\"weighed\": { \"mass\": \"0.9 kg\", \"first_bending_hz\": 250 }, \"profile\"",
    );
    for (bat, scene, varied, outputs, idle) in [
        (&*weighed, "", r#""bat.material.density": { "uniform": [600, 700] }"#, "f1_hz", true),
        (
            &*weighed,
            "",
            r#""bat.material.youngs_modulus": { "grid": [12e9, 14e9, 3] }"#,
            "f2_hz",
            true,
        ),
        (&*weighed, "", r#""bat.weighed.mass": { "uniform": [0.8, 0.9] }"#, "mass_kg", false),
        (DOWEL, "", r#""scene.pitch": { "uniform": [30, 40] }"#, "f1_hz", true),
        (DOWEL, "", r#""ball.cor": { "uniform": [0.4, 0.5] }"#, "exit_speed_m_s@0.7", false),
        (
            DOWEL,
            r#""cor": 0.5"#,
            r#""ball.cor": { "uniform": [0.4, 0.5] }"#,
            "exit_speed_m_s@0.7",
            true,
        ),
        (DOWEL, "", r#""bat.material.density": { "values": [700] }"#, "f1_hz", false),
        // Without the exponent the inertia has no effect; with it, it has one.
        (
            DOWEL,
            "",
            r#""scene.reference_inertia": { "uniform": [0.17, 0.2] }, "scene.swing_exponent": { "values": [0, 0.5] }"#,
            "exit_speed_m_s@0.7",
            false,
        ),
        (DOWEL, "", r#""bat.material.density": { "values": [700, -1] }"#, "f1_hz", false),
    ] {
        let text = format!(
            r#"{{ "format": "sweetspot-study/1", "bat": "dowel.json", "points": 4,
                  "scene": {{ {scene} }}, "vary": {{ {varied} }}, "outputs": ["{outputs}"] }}"#
        );
        let folder = study("study-idle", &text);
        folder.write("dowel.json", bat);
        let output = folder.run(&["study", "study.json", "--out", "out"]);
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        let path = varied.split('"').nth(1).unwrap();
        let warns = told.contains(&format!("nothing that is asked changes with {path}"));
        assert!(output.status.success() && warns == idle, "{varied} {outputs}: {told}");
        let drawn = varied.contains("uniform") || varied.contains("normal");
        assert_eq!(told.contains("points of the study: nothing is drawn"), !drawn, "{told}");
        assert!(idle || !drawn || told.is_empty(), "{told}");
    }
}

/// Values that become strange only by the variation cause a warning: inches read as metres, speeds without a unit.
#[test]
fn what_is_strange_as_it_varies_is_warned_of() {
    for (scene, varied, says) in [
        ("", r#""bat.profile.unit": { "values": ["in", "m"] }"#, "warning: dowel: length is 33 m"),
        ("", r#""scene.pitch": { "uniform": [80, 90] }"#, "warning: scene.pitch is 85 m/s; usual"),
        ("", r#""scene.swing_speed": { "values": [45, 450] }"#, "scene.swing_speed is 450 rad/s"),
        (
            r#""bat_speed": 72"#,
            r#""ball.cor": { "grid": [0.4, 0.5, 2] }"#,
            "scene.bat_speed is 72 m/s",
        ),
        ("", r#""scene.pitch": { "uniform": ["80 mph", "90 mph"] }"#, ""),
    ] {
        let text = format!(
            r#"{{ "format": "sweetspot-study/1", "bat": "dowel.json", "scene": {{ {scene} }},
                  "vary": {{ {varied} }}, "tol": 1e-2, "outputs": ["exit_speed_m_s@0.7"] }}"#
        );
        let folder = study("study-strange", &text);
        let told = folder.run(&["study", "study.json", "--out", "out"]).stderr;
        let told = String::from_utf8_lossy(&told);
        assert!(told.contains(says) && told.is_empty() == says.is_empty(), "{varied}: {told}");
    }
}

/// A table named by a value is searched in the folder of the study, is one of its files, and gives the bat that it
/// describes.
#[test]
fn a_table_that_a_value_names_is_a_file_of_the_study() {
    let text = r#"{ "format": "sweetspot-study/1", "bat": "dowel.json", "outputs": ["mass_kg", "f1_hz"],
      "vary": { "bat.profile": { "values": [
        { "csv": "p.csv", "unit": "in" },
        { "unit": "in", "x": [0, 33], "diameter": [1.7, 1.5] },
        { "unit": "in", "x": [0, 33], "diameter": [1.7, 1.7] } ] } } }"#;
    let folder = study("study-tables", "");
    std::fs::create_dir(folder.0.join("deep")).unwrap();
    folder.write("deep/dowel.json", DOWEL);
    folder.write("deep/study.json", text);
    folder.write("deep/p.csv", "x,diameter\n0,1.7\n33,1.5\n");
    folder.text(&["study", "deep/study.json", "--out", "out"]);
    let (_, rows) = table(&folder, "out/part-000000.csv");
    assert_eq!(rows[0][2..], rows[1][2..]);
    assert!(rows[0][1].contains("p.csv") && rows[0][2] != rows[2][2], "{rows:?}");
    assert!(folder.read("out/manifest.json").contains("\"p.csv\""));
    folder.write("deep/p.csv", "x,diameter\n0,1.7\n33,1.4\n");
    let told = refused(&folder, "deep/study.json");
    assert!(told.contains("differs in p.csv"), "{told}");
    folder.write("deep/p.csv", "");
    assert!(refused(&folder, "deep/study.json").contains("p.csv:1:"));
    // Stations in decreasing order are an impossible bat, which still has its row.
    folder.write("deep/p.csv", "x,diameter\n0,1.7\n-33,1.7\n");
    let said = folder.text(&["study", "deep/study.json", "--out", "back"]);
    assert!(
        said.starts_with("3 bats, 2 of them") && said.contains("1, such as row 0: profile.x"),
        "{said}"
    );
    std::fs::remove_file(folder.0.join("deep/p.csv")).unwrap();
    let told = refused(&folder, "deep/study.json");
    assert!(told.contains("study.json:2:") && told.contains("which cannot be read"), "{told}");
}

/// A bat of a table varies by the columns of its table, in the unit of its profile.
#[test]
fn a_bat_of_a_table_has_its_columns() {
    let text = r#"{ "format": "sweetspot-study/1", "bat": ["scan.json", "dowel.json"],
      "outputs": ["mass_kg", "f1_hz"], "tol": 1e-9,
      "vary": { "bat.profile.diameter[1]": { "grid": [1.7, 1.5, 2] } } }"#;
    let folder = study("study-scan", text);
    let profile = r#""profile": { "unit": "in", "x": [0, 33], "diameter": [1.7, 1.7] }"#;
    let table_of = |head: &str, rows: &str, unit: &str| {
        folder.write("scan.csv", format!("{head}\n{rows}\n"));
        let named = format!(r#""profile": {{ "csv": "scan.csv"{unit} }}"#);
        folder.write("scan.json", DOWEL.replace(profile, &named));
    };
    for (k, (head, rows, unit)) in [
        ("x,diameter", "0,1.7\n33,1.7", r#", "unit": "in""#),
        ("x_mm,diameter_mm", "0,43.18\n838.2,43.18", r#", "unit": "in""#),
    ]
    .into_iter()
    .enumerate()
    {
        table_of(head, rows, unit);
        let out = format!("out{k}");
        folder.text(&["study", "study.json", "--out", &out]);
        let table = table(&folder, &format!("{out}/part-000000.csv"));
        for name in ["mass_kg", "f1_hz"] {
            let of = column(&table, name);
            assert!((0..2).all(|k| (of[k] / of[k + 2] - 1.0).abs() < 1e-8), "{of:?}");
            assert!((of[1] / of[0] - 1.0).abs() > 0.01, "{of:?}");
        }
    }
    // Columns with explicit units keep them.
    folder.write(
        "study.json",
        text.replace(r#"["scan.json", "dowel.json"]"#, r#""scan.json""#).replace(
            r#"diameter[1]": { "grid": [1.7, 1.5, 2] }"#,
            r#"unit": { "values": ["in", "mm"] }"#,
        ),
    );
    let told = refused(&folder, "study.json");
    assert!(told.contains("bat.profile.unit"), "{told}");
}

/// Where rows are missing, the remaining ones have another distribution, so no shares are given. Reasons that differ
/// only by their numbers are one.
#[test]
fn no_shares_are_told_of_what_is_left_of_a_distribution() {
    let text = r#"{ "format": "sweetspot-study/1", "bat": "dowel.json", "outputs": ["mass_kg"],
      "vary": { "bat.material.density": { "normal": [700, 420] } }, "points": 256 }"#;
    let folder = study("study-tail", text);
    let said =
        folder.text(&["study", "study.json", "--out", "out", "--summary", "--plots", "plots"]);
    assert!(said.contains("of 256 rows have no answer") && !said.contains("±"), "{said}");
    let reasons: Vec<&str> = said.lines().filter(|line| line.contains("such as row")).collect();
    assert_eq!(reasons.len(), 1, "{said}");
    assert_eq!(folder.read_names("plots"), ["histogram_mass_kg.png", "histogram_mass_kg.svg"]);
}

/// A list of bats and a folder of bats: each bat has every row, and a file that is no bat its reason.
#[test]
fn several_bats_are_rows_with_their_names() {
    let text = r#"{ "format": "sweetspot-study/1", "bat": ["r161", "market", "dowel.json"],
      "vary": { "bat.material.density": { "values": [600, 700] } },
      "outputs": ["mass_kg", "f1_hz"] }"#;
    let folder = study("study-several", text);
    std::fs::create_dir(folder.0.join("market")).unwrap();
    folder.write("market/b.json", DOWEL.replace("1.7, 1.7", "1.5, 1.5"));
    folder.write("market/a.json", DOWEL.replace("\"x\": [0, 33]", "\"x\": [0, -33]"));
    folder.write("market/c.json", "no bat at all");
    folder.write("market/notes.txt", "not looked at");
    folder.write("market/study.json", text);
    let said = folder.text(&["study", "study.json", "--out", "out"]);
    assert!(said.starts_with("10 bats, 6 of them as accurate as asked\n"), "{said}");
    let table = table(&folder, "out/part-000000.csv");
    assert_eq!(table.0[..3], ["row", "bat", "bat.material.density"]);
    let names: Vec<&str> = table.1.iter().map(|row| row[1].as_str()).collect();
    assert_eq!(names, ["r161", "r161", "a", "a", "b", "b", "c", "c", "dowel", "dowel"]);
    let last = table.0.len() - 1;
    for (k, row) in table.1.iter().enumerate() {
        assert_eq!(row[0], k.to_string());
        assert_eq!(row[last].is_empty(), ![2, 3, 6, 7].contains(&k), "{row:?}");
    }
    assert!(
        table.1[2][last].contains("x[1]")
            && table.1[6][last].contains("something else than a bat file"),
        "{table:?}"
    );
    let mass = |k: usize| table.1[k][3].parse::<f64>().unwrap();
    assert!((mass(5) / mass(9) - (1.5_f64 / 1.7).powi(2)).abs() < 1e-12);
    // Without anything that varies each is a single row.
    folder.write(
        "study.json",
        r#"{ "format": "sweetspot-study/1", "bat": "market", "outputs": ["mass_kg"] }"#,
    );
    let said = folder.text(&["study", "study.json", "--out", "as-is"]);
    assert!(said.starts_with("3 bats, 1 of them"), "{said}");
    // Files that the study makes among its bats are not bats, and a missing bat is named.
    let again: Vec<String> =
        (0..2).map(|_| folder.text(&["study", "study.json", "--out", "market"])).collect();
    assert!(again[0] == said && again[1] == said, "{again:?}");
    std::fs::remove_file(folder.0.join("market/a.json")).unwrap();
    let output = folder.run(&["study", "study.json", "--out", "market"]);
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.code() == Some(2) && told.contains("market/a.json"), "{told}");
    folder.write("market/a.json", DOWEL.replace("\"x\": [0, 33]", "\"x\": [0, -33]"));
    for (bats, says) in [
        ("\"nowhere\"", "nowhere"),
        ("[\"r161\", \"nowhere.json\"]", "nowhere.json"),
        ("[\"r161\", \"torpdo\"]", "did you mean torpedo?"),
        ("[\"r161\", \"market\", \"r161\"]", "r161 a second time"),
        ("[\"market\", \"market/b.json\"]", "market/b.json a second time"),
        ("[\"dowel.json\", \"./market/../dowel.json\"]", "a second time"),
        ("[]", "an empty list"),
        ("[\"market/a.json\", \"market/c.json\"]", "x[1]"),
        ("\"market/c.json\"", "market/c.json:1"),
        ("\"empty\"", "without a .json file"),
    ] {
        std::fs::create_dir_all(folder.0.join("empty")).unwrap();
        folder.write("wrong.json", text.replace("[\"r161\", \"market\", \"dowel.json\"]", bats));
        let output = folder.run(&["study", "wrong.json", "--out", "wrong"]);
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.code() == Some(2) && told.contains(says), "{bats}: {told}");
        assert!(!folder.0.join("wrong").exists());
    }
}

/// For `m = ρ π r² L` with independent lognormal ρ and r² the logarithm is a sum of both, so that with small deviations
/// the shares are those of the squares: r counts twice.
#[test]
fn what_makes_answers_vary_is_said_and_drawn() {
    let text = r#"{ "format": "sweetspot-study/1", "bat": "dowel.json",
      "vary": { "bat.material.density": { "lognormal": [650, 0.02] },
                "bat.material.youngs_modulus": { "lognormal": ["14 GPa", 0.02] },
                "bat.profile.diameter[0]": { "values": ["1.7 in"] } },
      "points": 1024, "outputs": ["mass_kg", "f1_hz"], "tol": 1e-6 }"#;
    let folder = study("study-shares", text);
    let said = folder.text(&[
        "study",
        "study.json",
        "--out",
        "out",
        "--summary",
        "--plots",
        "plots",
        "--scatter",
        "mass_kg",
        "f1_hz",
        "--npz",
    ]);
    let share = |answer: &str, varied: &str| -> f64 {
        let of = said.split(&format!("What makes {answer} vary")).nth(1).unwrap();
        let line =
            of.lines().find(|line| line.starts_with(varied)).unwrap_or_else(|| panic!("{said}"));
        line[varied.len()..].split_whitespace().next().unwrap().parse().unwrap()
    };
    assert!((share("mass_kg", "bat.material.density") - 1.0).abs() < 1e-3, "{said}");
    for varied in ["bat.material.density", "bat.material.youngs_modulus"] {
        assert!((share("f1_hz", varied) - 0.5).abs() < 0.01, "{said}");
    }
    for name in ["histogram_mass_kg", "histogram_f1_hz", "tornado_f1_hz", "scatter_mass_kg_f1_hz"] {
        assert!(folder.read(&format!("plots/{name}.svg")).starts_with("<svg"), "{name}");
    }
    let archive = std::fs::read(folder.0.join("out/part-000000.npz")).unwrap();
    assert!(archive.starts_with(b"PK"));
    // Existing rows are not made again, and an unknown column is named.
    let output = folder.run(&[
        "study",
        "study.json",
        "--out",
        "out",
        "--plots",
        "p",
        "--scatter",
        "mass_kg",
        "f2_hz",
    ]);
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.code() == Some(2) && told.contains("did you mean f1_hz?"), "{told}");
    folder.write("study.json", SCATTER);
    let said = folder.text(&["study", "study.json", "--out", "lists", "--summary"]);
    assert!(said.contains("here bats or lists differ too"), "{said}");
}

/// The names of those parts and their sums in a folder.
fn with_sums(parts: &[&str]) -> Vec<String> {
    let both = |part: &&str| [part.to_string(), format!("{part}.sha256")];
    ["manifest.json".to_owned()].into_iter().chain(parts.iter().flat_map(both)).collect()
}

/// Started again, on more threads or fewer, stopped at any moment: the folder is the same.
#[test]
fn a_folder_is_the_same_however_it_was_made() {
    let text = SCATTER.replace("\"points\": 50", "\"points\": 5000").replace("1e-9", "1e-2");
    let folder = study("study-killed", &text);
    folder.text(&["study", "study.json", "--out", "whole", "--jobs", "1"]);
    let names = folder.read_names("whole");
    assert_eq!(names, with_sums(&["part-000000.csv", "part-000001.csv", "part-000002.csv"]));
    std::fs::create_dir(folder.0.join("killed")).unwrap();
    for round in 0..50 {
        let mut child = folder
            .command(&["study", "study.json", "--out", "killed", "--jobs", "2"])
            .stdout(Stdio::null())
            .spawn()
            .unwrap();
        // Random-looking moments, up to the time that the whole takes.
        sleep(Duration::from_millis(7919 * round % 241));
        let _ = child.kill();
        child.wait().unwrap();
        let there = folder.read_names("killed");
        for name in there.iter().filter(|name| !name.starts_with('.')) {
            let [whole, part] = ["whole", "killed"].map(|f| folder.read(&format!("{f}/{name}")));
            assert!(whole == part, "{name} after {round}");
        }
        if names.iter().all(|name| there.contains(name)) {
            let lost = format!("killed/{}", names[1 + round as usize % (names.len() - 1)]);
            std::fs::remove_file(folder.0.join(lost)).unwrap();
        }
    }
    // As a program leaves it that is killed in the middle of a part.
    folder.write("killed/.sweetspot-0123456789abcdef.part", "row,");
    let said = folder.text(&["study", "study.json", "--out", "killed"]);
    assert_eq!(said, folder.text(&["study", "study.json", "--out", "whole"]));
    assert_eq!(folder.read_names("killed"), names);
    for name in &names {
        let [whole, part] = ["whole", "killed"].map(|f| folder.read(&format!("{f}/{name}")));
        assert!(whole == part, "{name}");
    }
    std::fs::remove_file(folder.0.join("killed/part-000001.csv")).unwrap();
    folder.text(&["study", "study.json", "--out", "killed"]);
    let part = "part-000001.csv";
    assert!(folder.read(&format!("whole/{part}")) == folder.read(&format!("killed/{part}")));
}

#[test]
fn a_folder_of_another_study_is_refused_with_what_changed() {
    let folder = study("study-other", SCATTER);
    folder.text(&["study", "study.json", "--out", "out"]);
    let before = folder.read("out/part-000000.csv");
    folder.write("dowel.json", DOWEL.replace("\"x\": [0, 33]", "\"x\": [0, 34]"));
    let told = refused(&folder, "study.json");
    assert!(told.contains("differs in dowel.json") && told.contains("new folder"), "{told}");
    folder.write("dowel.json", DOWEL);
    // Under another name it is the same study.
    folder.write("copy.json", SCATTER);
    folder.text(&["study", "copy.json", "--out", "out"]);
    folder.write("study.json", SCATTER.replace("\"points\": 50", "\"points\": 51"));
    let told = refused(&folder, "study.json");
    assert!(told.contains("study.json, the rows"), "{told}");
    assert_eq!(folder.read("out/part-000000.csv"), before);
    std::fs::remove_file(folder.0.join("out/manifest.json")).unwrap();
    let told = refused(&folder, "study.json");
    assert!(told.contains("parts of a study that is not known"), "{told}");
}

/// The motion at the hands is within three times its error of that from a hundred times more accurate hits, on bats
/// whose wall, joint or stiff wood affects it most.
#[test]
fn what_the_hands_feel_is_known_as_well_as_it_says() {
    const FELT: [&str; 4] = [
        "hands_velocity_min.value",
        "hands_acceleration_min.value",
        "hands_velocity_m_s@0.6",
        "hands_acceleration_m_s2@0.6",
    ];
    let found = |tol: &str| {
        let text = format!(
            r#"{{ "format": "sweetspot-study/1", "bat": ["r161", "two_piece", "bbcor_made_up"],
                "tol": {tol}, "vary": {{ "scene.pitch": {{ "values": ["83 mph"] }} }},
                "outputs": {FELT:?} }}"#
        );
        let folder = study("study-hands", &text);
        folder.text(&["study", "study.json", "--out", "out"]);
        table(&folder, "out/part-000000.csv")
    };
    let [rough, fine] = ["1e-3", "1e-5"].map(found);
    for name in FELT {
        let number = |(names, rows): &(Vec<String>, Vec<Vec<String>>), row: usize, name: &str| {
            let column = names.iter().position(|other| other == name).unwrap();
            rows[row][column].parse::<f64>().unwrap()
        };
        for row in 0..3 {
            let [a, b] = [&rough, &fine].map(|found| number(found, row, name));
            let error = format!("{name}_error");
            let [stated, left] = [&rough, &fine].map(|found| number(found, row, &error));
            assert!((a - b).abs() <= 3.0 * (stated + left), "{row} {name} {a} {b} {stated}");
            assert!(stated <= 0.2 * a, "{row} {name} {a} {stated}");
        }
    }
}

/// Parts that the study does not make are reported by name, and nothing is computed from them.
#[test]
fn a_part_that_is_not_the_study_s_is_refused() {
    let text = SCATTER.replace("\"points\": 50", "\"points\": 5000").replace("1e-9", "1e-2");
    let folder = study("study-damaged", &text);
    let whole = folder.text(&["study", "study.json", "--out", "out"]);
    let [first, second] = [0, 1].map(|k| folder.read(&format!("out/part-{k:06}.csv")));
    let half = &first[..first.len() / 2];
    for damage in ["a,b\n1,2\n", "", "x", &second, &half[..=half.rfind('\n').unwrap()]] {
        folder.write("out/part-000000.csv", damage);
        for more in [&[][..], &["--npz"]] {
            let output = folder.run(&[&["study", "study.json", "--out", "out"], more].concat());
            let told = String::from_utf8_lossy(&output.stderr).into_owned();
            assert!(told.contains("part-000000.csv") && told.contains("makes it anew"), "{told}");
            assert_eq!(output.status.code(), Some(2), "{told}");
            assert!(!folder.read_names("out").contains(&"part-000000.npz".to_owned()));
        }
        assert_eq!(folder.read("out/part-000000.csv"), damage);
    }
    std::fs::remove_file(folder.0.join("out/part-000000.csv")).unwrap();
    assert_eq!(folder.text(&["study", "study.json", "--out", "out"]), whole);
    // An archive goes with its part.
    folder.text(&["study", "study.json", "--out", "out", "--npz"]);
    let archive = || std::fs::read(folder.0.join("out/part-000000.npz")).unwrap();
    let before = archive();
    folder.write("out/part-000000.npz", "old");
    std::fs::remove_file(folder.0.join("out/part-000000.csv")).unwrap();
    assert_eq!(folder.text(&["study", "study.json", "--out", "out"]), whole);
    assert!(archive() == before);
    for name in ["manifest.json", "part-000000.csv"] {
        std::fs::remove_file(folder.0.join("out").join(name)).unwrap();
    }
    let told = refused(&folder, "study.json");
    assert!(told.contains("parts of a study that is not known"), "{told}");
}

/// Each part and archive has a file with its sum, as `sha256sum` writes it; any changed bit is detected.
#[test]
fn a_part_of_which_a_bit_was_turned_is_refused() {
    let folder = study("study-bits", SCATTER);
    let run =
        |more: &[&str]| folder.run(&[&["study", "study.json", "--out", "out"], more].concat());
    assert!(run(&["--npz"]).status.success());
    let names = with_sums(&["part-000000.csv", "part-000000.npz"]);
    assert_eq!(folder.read_names("out"), names);
    let sum = folder.read("out/part-000000.csv.sha256");
    assert!(sum.len() == 64 + 18 && sum.ends_with("  part-000000.csv\n"), "{sum}");
    for name in &names[1..] {
        let name = &format!("out/{name}");
        let bytes = std::fs::read(folder.0.join(name)).unwrap();
        let turned = |k: usize, bit: u8| {
            let mut turned = bytes.clone();
            turned[k] ^= 1 << bit;
            turned
        };
        // The case of a letter in a sum has no meaning.
        let places = (0..14).map(|k| turned(k * (bytes.len() - 1) / 13, k as u8 % 5));
        for damage in places.chain([vec![], bytes[..bytes.len() / 2].to_vec()]) {
            folder.write(name, damage);
            let output = run(&[]);
            let said = String::from_utf8_lossy(&output.stderr);
            assert_eq!(output.status.code(), Some(2), "{name} {said}");
            assert!(said.contains(&name[..19]) && said.contains("without this file"), "{said}");
        }
        folder.write(name, bytes);
        assert!(run(&[]).status.success());
    }
}

/// A part without a sum is from an older folder: it is checked by its rows, and gets a sum.
#[test]
fn a_part_without_a_sum_is_checked_by_its_rows() {
    let folder = study("study-sumless", &SCATTER.replace("\"points\": 50", "\"points\": 3"));
    let run = || folder.run(&["study", "study.json", "--out", "out", "--npz"]);
    let whole = String::from_utf8(run().stdout).unwrap();
    let [part, sum] = ["", ".sha256"].map(|end| folder.read(&format!("out/part-000000.csv{end}")));
    let archive = std::fs::read(folder.0.join("out/part-000000.npz")).unwrap();
    let without = |name: &str| std::fs::remove_file(folder.0.join("out").join(name)).unwrap();
    for name in ["part-000000.csv.sha256", "part-000000.npz.sha256"] {
        let before = folder.read(&format!("out/{name}"));
        without(name);
        assert_eq!(String::from_utf8(run().stdout).unwrap(), whole);
        assert_eq!(folder.read(&format!("out/{name}")), before);
    }
    without("part-000000.csv.sha256");
    let line = part.lines().nth(1).unwrap();
    let cells: Vec<&str> = line.split(',').collect();
    for k in 0..cells.len() - 1 {
        for other in ["maybe", "NaN", "inf", "1e999", "+1", "", "text"] {
            let mut changed = cells.clone();
            changed[k] = other;
            // An error can be unknown.
            let is_error =
                part.lines().next().unwrap().split(',').nth(k).unwrap().ends_with("_error");
            if cells[k] == other || (other.is_empty() && is_error) {
                continue;
            }
            folder.write("out/part-000000.csv", part.replacen(line, &changed.join(","), 1));
            let told = refused(&folder, "study.json");
            assert!(told.contains("part-000000.csv") && told.contains("row"), "{k} {other} {told}");
        }
    }
    let quoted = part.replacen("\n0,", "\n\"0\",", 1);
    let broken =
        [format!("{part}\n"), part.replace('\n', "\r\n"), quoted, format!("\u{feff}{part}")];
    for other in broken {
        folder.write("out/part-000000.csv", &other);
        let told = refused(&folder, "study.json");
        assert!(told.contains("part-000000.csv") && told.contains("makes it anew"), "{told}");
    }
    folder.write("out/part-000000.csv", &part);
    without("part-000000.npz.sha256");
    for damage in [&[][..], &archive[..100], b"old"] {
        folder.write("out/part-000000.npz", damage);
        let told = refused(&folder, "study.json");
        assert!(told.contains("part-000000.npz") && told.contains("makes it anew"), "{told}");
    }
    without("part-000000.npz");
    assert_eq!(String::from_utf8(run().stdout).unwrap(), whole);
    assert!(std::fs::read(folder.0.join("out/part-000000.npz")).unwrap() == archive);
    assert_eq!(folder.read("out/part-000000.csv.sha256"), sum);
}

/// Studies that solve walls have small parts on every machine; a folder that was begun with parts of the usual size
/// keeps it.
#[test]
fn a_study_of_walls_has_small_parts() {
    let text = |outputs: &str| {
        format!(
            r#"{{ "format": "sweetspot-study/1", "bat": "bbcor_made_up", "points": 70, "tol": 0.5,
                "vary": {{ "scene.pitch": {{ "uniform": ["70 mph", "90 mph"] }} }},
                "outputs": [{outputs}] }}"#
        )
    };
    let hit = "\"exit_speed_m_s@0.7\"";
    let folder = study("study-walls", &text(hit));
    let run = |more: &[&str]| {
        let output = folder.run(&[&["study", "study.json", "--out", "out"], more].concat());
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).unwrap()
    };
    let whole = run(&["--jobs", "1"]);
    assert_eq!(folder.read_names("out"), with_sums(&["part-000000.csv", "part-000001.csv"]));
    let manifest = folder.read("out/manifest.json");
    assert!(manifest.contains("\"rows_per_part\": 64") && manifest.contains("\"parts\": 2"));
    let rows: Vec<String> =
        ["0", "1"].map(|k| folder.read(&format!("out/part-00000{k}.csv"))).into();
    let tail = rows[1].split_once('\n').unwrap().1;
    // As an older version has begun it, with its manifest and without.
    let older = manifest.replace("\"rows_per_part\": 64", "\"rows_per_part\": 4096");
    let older = older.replace("\"parts\": 2", "\"parts\": 1");
    std::fs::remove_dir_all(folder.0.join("out")).unwrap();
    std::fs::create_dir(folder.0.join("out")).unwrap();
    for manifest in [older.replace("  \"rows_per_part\": 4096,\n", ""), older.clone()] {
        folder.write("out/manifest.json", &manifest);
        assert_eq!(run(&["--jobs", "2"]), whole);
        assert_eq!(folder.read_names("out"), with_sums(&["part-000000.csv"]));
        assert_eq!(folder.read("out/part-000000.csv"), rows[0].clone() + tail);
        assert_eq!(folder.read("out/manifest.json"), manifest);
    }
    for each in ["0", "1", "63", "-1", "1e30", "\"64\""] {
        let other =
            manifest.replace("\"rows_per_part\": 64", &format!("\"rows_per_part\": {each}"));
        folder.write("out/manifest.json", other);
        assert!(refused(&folder, "study.json").contains("the rows per part"));
    }
    // Begun anew: without a terminal only on request, and other files are kept.
    folder.write("out/manifest.json", &older);
    folder.write("out/part-notes.csv", "mine");
    let output = folder.run(&["study", "study.json", "--out", "out", "--fresh"]);
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.code() == Some(2) && told.contains("--yes"), "{told}");
    assert!(folder.read_names("out").contains(&"part-000000.csv".to_owned()));
    assert_eq!(run(&["--fresh", "--yes"]), whole);
    assert_eq!(folder.read("out/part-notes.csv"), "mine");
    std::fs::remove_file(folder.0.join("out/part-notes.csv")).unwrap();
    assert_eq!(folder.read_names("out"), with_sums(&["part-000000.csv", "part-000001.csv"]));
    assert_eq!(folder.read("out/manifest.json"), manifest);
    folder.write("out/manifest.json", "{\"format\": \"mine\"}");
    let output = folder.run(&["study", "study.json", "--out", "out", "--fresh", "--yes"]);
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(folder.read_names("out").len(), 5);
    // A study without walls has parts of the usual size.
    for (outputs, more) in [("\"mass_kg\"", ""), (hit, "\"scene\": { \"wall\": \"off\" },")] {
        folder.write(
            "study.json",
            text(outputs).replacen("\"points\"", &format!("{more} \"points\""), 1),
        );
        let out = if more.is_empty() { "solid" } else { "off" };
        folder.run(&["study", "study.json", "--out", out]);
        assert!(folder.read(&format!("{out}/manifest.json")).contains("\"rows_per_part\": 4096"));
    }
}

/// The message about a study that is refused.
fn refused(folder: &Folder, name: &str) -> String {
    let output = folder.run(&["study", name, "--out", "out"]);
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{told}");
    assert!(output.stdout.is_empty(), "{told}");
    told
}

#[test]
fn a_wrong_study_is_refused_with_its_place() {
    let folder = study("study-wrong", SCATTER);
    let density = "\"bat.material.density\": { \"lognormal\": [650, 0.04] }";
    let outputs = "\"mass_kg\", \"f1_hz\", \"f2_hz\", \"balance_point_m\", \"node_mode_1_m\"";
    for (from, to, says) in [
        (
            density,
            "\"bat.material.densty\": { \"uniform\": [600, 700] }",
            "wrong.json:5:5: vary.bat.material.densty: found unknown key",
        ),
        (density, "\"bat.profil.x[1]\": { \"uniform\": [600, 700] }", "no list at \"profil.x\""),
        (density, "\"bat.profil.x\": { \"uniform\": [600, 700] }", "did you mean profile?"),
        (
            density,
            "\"ball.cors\": { \"uniform\": [0.4, 0.5] }",
            "vary.ball.cors: found unknown key",
        ),
        (
            density,
            "\"scene.pitch\": { \"uniform\": [\"4 foo\", \"5 foo\"] }",
            "vary.scene.pitch: found",
        ),
        (outputs, "\"f+2_hz\"", "found \"f+2_hz\""),
        (outputs, "\"f02_hz\"", "found \"f02_hz\""),
        (outputs, "\"exit_speed_m_s@+0.6\"", "found \"exit_speed_m_s@+0.6\""),
        (density, "\"bat.profile.x[9]\": { \"uniform\": [600, 700] }", "2 items, none of number 9"),
        (density, "\"bta.material.density\": { \"uniform\": [1, 2] }", "begins with bat., ball."),
        (density, "\"scene.pich\": { \"uniform\": [1, 2] }", "did you mean pitch?"),
        (density, "\"bat.material.density\": { \"uniform\": [700, 600] }", "a number above 700"),
        (density, "\"bat.material.density\": { \"normal\": [700, 0] }", "a finite number above 0"),
        (density, "\"bat.material.density\": { \"normal\": [700] }", "[mean, standard deviation]"),
        (density, "\"bat.material.density\": { \"normal\": [\"1 kg/m^3\", 2] }", "as the first"),
        (density, "\"bat.material.density\": { \"norml\": [700, 5] }", "did you mean normal?"),
        (density, "\"bat.material.density\": { \"values\": [] }", "one value at least"),
        (
            density,
            "\"bat.material.density\": { \"values\": [-1] }",
            "wrong.json:5:5: vary.bat.material.density: found -1 kg/m³",
        ),
        (
            density,
            "\"bat.material.density\": { \"normal\": [\"650 lb\", \"2 lb\"] }",
            "wrong.json:5:5: vary.bat.material.density: found unit \"lb\"",
        ),
        (density, "\"bat.profile.x[01]\": { \"uniform\": [1, 2] }", "a path that begins"),
        (density, "\"bat.profile.x[1]y\": { \"uniform\": [1, 2] }", "a path that begins"),
        (density, "\"bat.material\": { \"values\": [\"ash\"] }", "one inside the other"),
        (
            density,
            "\"bat.profile.csv\": { \"values\": [\"a.csv\"] }",
            "expected: \"bat.profile\", with",
        ),
        (density, "\"bat.material.density\": { \"uniform\": [1e308, 0] }", "a number above 1e+308"),
        (outputs, "\"f1_herz\"", "did you mean f1_hz?"),
        (outputs, "\"f1_hz\", \"f1_hz\"", "every output once"),
        (outputs, "", "an empty list"),
        ("\"points\": 50", "\"points\": 1e12", "rows at most"),
        ("\"points\": 50", "\"points\": 0", "one row at least"),
        ("\"points\": 50", "\"points\": 1.5", "a whole number"),
        ("\"points\": 50", "\"design\": \"sobl\"", "did you mean sobol?"),
        (
            "\"points\": 50",
            "\"correlations\": [[\"bat.material.density\", \"bat.material.youngs_modulus\", 2]]",
            "between -1 and 1",
        ),
        (
            "\"points\": 50",
            "\"correlations\": [
                [\"bat.material.density\", \"bat.material.youngs_modulus\", 0.5],
                [\"bat.material.youngs_modulus\", \"bat.material.density\", 0.9]]",
            "one correlation of each two paths",
        ),
        ("\"points\": 50", "\"scene\": { \"pitch\": \"9 lb\" }", "pitch"),
        ("dowel.json", "dowl.json", "wrong.json:3:10: bat: found dowl.json: No such file"),
        ("\"points\": 50", "\"ball\": \"tennis.json\"", "wrong.json:9:11: ball: found tennis.json"),
    ] {
        assert!(SCATTER.contains(from), "{from}");
        folder.write("wrong.json", SCATTER.replace(from, to));
        let told = refused(&folder, "wrong.json");
        assert!(told.contains(says), "{to}: {told}");
        assert!(!Path::new(&folder.0).join("out").exists(), "{to}");
    }
}

/// A disk that fills up in the middle of a part: one message, no partial file, and with room again the folder is the
/// undisturbed one.
#[cfg(unix)]
#[test]
fn a_full_disk_leaves_no_half_part() {
    let folder = study("study-full", SCATTER);
    let program = env!("CARGO_BIN_EXE_sweetspot");
    let script = format!("trap '' XFSZ; ulimit -f 4; exec {program} study study.json --out out");
    let mut shell = std::process::Command::new("sh");
    let full = shell.args(["-c", &script]).current_dir(&folder.0).output().unwrap();
    let said = String::from_utf8_lossy(&full.stderr);
    assert!(matches!(full.status.code(), Some(2 | 3)) && said.contains("cannot write"), "{said}");
    assert_eq!(folder.read_names("out"), ["manifest.json"]);
    for out in ["out", "whole"] {
        assert!(folder.run(&["study", "study.json", "--out", out]).status.success());
    }
    assert_eq!(folder.read_names("out"), folder.read_names("whole"));
    assert_eq!(folder.read("out/part-000000.csv"), folder.read("whole/part-000000.csv"));
}

/// Where the ball is met again, the best value of a row may be missed between two places; its error says by how much. A
/// single hit on a clamped bat beats the row's largest BBCOR, but not by more than that.
#[test]
fn the_error_of_a_best_value_counts_what_is_missed_where_the_ball_is_met_again() {
    let folder = Folder::new("missed-peak");
    let bat = r#"{ "format": "sweetspot-bat/1", "material": "white-ash-dynamic",
        "profile": { "unit": "in", "x": [0, 33], "diameter": [1, 2.5], "interpolation": "linear" },
        "supports": [{ "x": 0, "type": "clamped" }] }"#;
    folder.write("clamped.json", bat);
    let study = r#"{ "format": "sweetspot-study/1", "bat": "clamped.json", "outputs": ["bbcor_max"],
        "vary": { "scene.pitch": { "values": [37.1] } } }"#;
    folder.write("study.json", study);
    folder.run(&["study", "study.json", "--out", "rows", "--quiet"]);
    let rows = folder.read("rows/part-000000.csv");
    let mut lines = rows.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let (heads, row) = (lines.next().unwrap(), lines.next().unwrap());
    let cell = |name: &str| -> f64 {
        row[heads.iter().position(|head| *head == name).unwrap()].parse().unwrap()
    };
    let args = ["hit", "clamped.json", "--at", "0.82", "--pitch", "37.1", "--json", "-", "--quiet"];
    let output = folder.run(&args);
    let hit: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let single = hit["impacts"][0]["bbcor"].as_f64().unwrap();
    let (largest, error) = (cell("bbcor_max"), cell("bbcor_max_error"));
    assert!(single <= largest + error, "{single} beside {largest} within {error}");
}
