//! Outputs are complete or absent, the same every time, and as documented.

use crate::common;

use std::collections::BTreeSet;
use std::fs;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Output, Stdio};

use common::diagnostic::diagnostics;
use common::folder::Folder;
use serde_json::Value;
use sweetspot::{Bat, Request, solve};
use sweetspot_proof::validation::Truth;
use sweetspot_report::report::resolved::resolved;
use sweetspot_report::schema;

fn mesh(name: &str) -> String {
    format!("{}/meshes/{name}.json", env!("SWEETSPOT_TOP"))
}

/// Exit code of a failed run, and its standard error in the form for people.
fn failure(output: &Output) -> String {
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{told}");
    let told = told.split("{\"format\":\"sweetspot-error/1\"").next().unwrap().to_owned();
    let (each, _) = diagnostics(&told);
    assert!(told.starts_with("error: ") && each.len() == 1 && each[0].rest.is_empty(), "{told}");
    told
}

#[cfg(unix)]
#[test]
fn a_closed_pipe_is_no_error() {
    let folder = Folder::new("pipe");
    let bat = mesh("r161");
    // More than a pipe holds, so that the program cannot have finished before the pipe is closed.
    let long = ["hit", &bat, "--points", "2000", "--json", "-"];
    let case = ["validate", "--case", "r161_nathan_timoshenko"];
    for args in [&long[..], &["modes", &bat], &["materials"], &case] {
        let mut child =
            folder.command(args).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let mut first = String::new();
        let mut reader = BufReader::with_capacity(16, child.stdout.take().unwrap());
        reader.read_line(&mut first).unwrap();
        drop(reader);
        let output = child.wait_with_output().unwrap();
        assert!(!first.is_empty() && output.status.code() == Some(0), "{args:?}: {output:?}");
        assert!(output.stderr.is_empty(), "{args:?}: {output:?}");
    }
    // Closed before the first byte.
    let mut child = folder.command(&long).stdout(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    assert_eq!(child.wait().unwrap().code(), Some(0));
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_told() {
    let folder = Folder::new("full");
    let bat = mesh("dowel");
    let full = || fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    for args in [&["modes", &bat][..], &["hit", &bat, "--json", "-"], &["materials"]] {
        let output = folder.command(args).stdout(full()).output().unwrap();
        assert!(failure(&output).contains("standard output"), "{args:?}");
    }
    let told = failure(&folder.run(&["modes", &bat, "--json", "/dev/full"]));
    assert!(told.contains("cannot write /dev/full"), "{told}");
    use std::os::unix::fs::FileTypeExt;
    assert!(fs::metadata("/dev/full").unwrap().file_type().is_char_device());
    // A device is written to directly.
    assert!(folder.run(&["modes", &bat, "--json", "/dev/null"]).status.success());
    assert!(fs::metadata("/dev/null").unwrap().file_type().is_char_device());
    assert!(folder.names().is_empty());
}

#[test]
fn a_file_that_cannot_be_written_leaves_nothing() {
    let folder = Folder::new("unwritten");
    let bat = mesh("dowel");
    folder.write("file", "old");
    fs::create_dir(folder.0.join("folder")).unwrap();
    fs::create_dir(folder.0.join("locked")).unwrap();
    folder.write("locked/out.json", "old");
    let lock = |locked: bool| {
        let mut permissions = fs::metadata(folder.0.join("locked")).unwrap().permissions();
        permissions.set_readonly(locked);
        fs::set_permissions(folder.0.join("locked"), permissions).unwrap();
    };
    let before = folder.names();
    for path in ["missing/out.json", "file/out.json", "folder", ".", "/proc/sweetspot.json"] {
        for verb in ["modes", "hit", "analyze"] {
            let output = folder.run(&[verb, &bat, "--json", path]);
            assert!(failure(&output).contains(&format!("cannot write {path}")), "{verb} {path}");
            assert!(output.stdout.is_empty(), "{verb} {path}");
            assert_eq!(folder.names(), before, "{verb} {path}");
        }
    }
    let told = failure(&folder.run(&["analyze", &bat, "--out", "file"]));
    assert!(told.contains("cannot write file"), "{told}");
    let blow = ["ring", &bat, "--at", "0.6", "--impulse", "1", "--csv", "missing/ring.csv"];
    assert!(failure(&folder.run(&blow)).contains("cannot write missing/ring.csv"));
    lock(true);
    let output = folder.run(&["modes", &bat, "--json", "locked/out.json"]);
    lock(false);
    // The superuser may also write there.
    if !output.status.success() {
        assert!(failure(&output).contains("cannot write locked/out.json"));
        assert_eq!(folder.read("locked/out.json"), "old");
    }
    let names = |sub: &str| fs::read_dir(folder.0.join(sub)).unwrap().count();
    assert_eq!((names("locked"), names("folder")), (1, 0));
    assert_eq!(folder.names(), before);
    // A run for an invalid bat does not replace an existing answer.
    folder.write("bad.json", "{");
    folder.write("out.json", "old");
    failure(&folder.run(&["modes", "bad.json", "--json", "out.json"]));
    assert_eq!(folder.read("out.json"), "old");
}

#[test]
fn files_are_whole_and_standard_output_is_either_json_or_a_table() {
    let folder = Folder::new("whole");
    let bat = mesh("r161");
    for verb in ["modes", "hit"] {
        let args = [verb, &bat];
        let table = folder.text(&args);
        assert!(!table.starts_with('{') && table.lines().count() > 10, "{table}");
        let json = folder.json(&[&args[..], &["--json", "-"]].concat());
        assert_eq!(json["format"], format!("sweetspot-{verb}/1"));
        // With a file the table is still printed, and the file is the same document.
        let again = folder.text(&[&args[..], &["--json", "out.json"]].concat());
        let mut file: Value = read(&folder, "out.json");
        assert_eq!(again, table, "{verb}");
        let mut json = json;
        for document in [&mut json, &mut file] {
            document.as_object_mut().unwrap().remove("timing");
        }
        assert_eq!(file, json, "{verb}");
    }
    let both = folder.json(&["analyze", &bat, "--json", "-"]);
    assert_eq!(both["modes"]["format"], "sweetspot-modes/1");
    assert_eq!(both["hit"]["format"], "sweetspot-hit/1");
    let ring = ["ring", &bat, "--at", "0.6", "--impulse", "1"];
    let json = folder.json(&[&ring[..], &["--json", "-"]].concat());
    assert_eq!(json["x_m"].as_array().unwrap().len(), 101);
    let csv = folder.text(&ring);
    assert!(csv.starts_with("x_m,w_m_at_0_s,") && csv.lines().count() == 102);

    folder.text(&["analyze", &bat, "--out", "deep/folder"]);
    let out = Folder(folder.0.join("deep/folder"));
    assert_eq!(out.names(), ["curve.csv", "hit.json", "modes.json"]);
    assert_eq!(read(&out, "modes.json")["format"], "sweetspot-modes/1");
    let hit = read(&out, "hit.json");
    let curve = out.read("curve.csv");
    let mut lines = curve.lines();
    assert_eq!(
        lines.next(),
        Some("x_m,bat_speed_m_s,exit_speed_m_s,rigid_exit_speed_m_s,vibration_j")
    );
    for (line, impact) in lines.zip(hit["impacts"].as_array().unwrap()) {
        let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        assert_eq!(cells[0], impact["x_m"]);
        assert_eq!(cells[2], impact["exit_speed_m_s"]);
        assert_eq!(cells[4], impact["energy_j"]["vibration"]);
    }
}

#[test]
fn hands_are_said_to_be_shaken_only_where_something_damps_the_bat() {
    let folder = Folder::new("shaken");
    let bat = fs::read_to_string(mesh("dowel")).unwrap();
    let mut damped: Value = serde_json::from_str(&bat).unwrap();
    damped["grip"] = serde_json::json!({ "from": 0, "to": 0.15, "stiffness": 3e4, "damping": 300 });
    folder.write("bare.json", bat);
    folder.write("damped.json", damped.to_string());
    let hit = |bat: &str| folder.text(&["hit", bat, "--points", "3"]);
    let ring = |bat: &str| folder.text(&["ring", bat, "--hit", "0.7", "-n", "5"]);
    for (bat, shaken) in [("bare.json", false), ("damped.json", true)] {
        assert_eq!(hit(bat).contains("shaking"), shaken, "{bat}");
        assert!(hit(bat).contains("least hand speed, undamped"), "{bat}");
        folder.text(&["hit", bat, "--points", "3", "--plots", "drawn"]);
        assert_eq!(folder.read("drawn/exit_speed.svg").contains("least shaken"), shaken, "{bat}");
        assert_eq!(ring(bat).contains("t/s² ("), shaken, "{bat}");
        let spot = &folder.json(&["hit", bat, "--points", "3", "--json", "-"])["sweet_spot"];
        assert!(spot["hands_acceleration_min"]["value"].is_f64(), "{spot}");
    }
    let full = folder.text(&["modes", "bare.json", "--full"]);
    assert!(full.contains("no loss factor known, undamped"));
    assert!(folder.text(&["materials"]).contains("no loss factor known: undamped"));
}

#[test]
fn damped_bats_go_from_their_file_to_json() {
    let folder = Folder::new("damped");
    let bat = |more: &str| {
        let text = format!(
            r#"{{ "format": "sweetspot-bat/1", "material": {{
            "density": 700, "youngs_modulus": 14e9, "loss_factor": 0.02 }},
            "profile": {{ "x": [0, 0.8], "radius": [0.02, 0.03] }}{more} }}"#
        );
        folder.write("bat.json", text);
    };
    bat("");
    let lossy =
        folder.json(&["modes", "bat.json", "-n", "3", "--theory", "rayleigh", "--json", "-"]);
    for mode in lossy["modes"].as_array().unwrap() {
        assert_eq!(mode["damping_ratio"], 0.01);
        let damping = &mode["damping"];
        let own = "natural_frequency_hz damped_frequency_hz decay_1_per_s loss_factor \
                   q_half_power q_amplitude material_damping_ratio complex error";
        assert_eq!(keys(damping), set(own));
        assert_eq!((&damping["q_half_power"], &damping["complex"]), (&50.0.into(), &false.into()));
        assert_eq!(damping["natural_frequency_hz"], mode["frequency_hz"]);
    }
    assert!(lossy["model"]["damping"]["method"].as_str().unwrap().contains("materials"));
    let rayleigh = ["--theory", "rayleigh"];
    let table = folder.text(&[&["modes", "bat.json", "-n", "3"], &rayleigh[..]].concat());
    assert!(table.contains("\nDamping (Q") && table.lines().all(|l| l.chars().count() <= 80));
    bat(r#", "grip": { "from": 0, "to": 0.2, "stiffness": 1e5, "damping": 300 }"#);
    let held =
        folder.json(&["modes", "bat.json", "-n", "3", "--theory", "rayleigh", "--json", "-"]);
    for mode in held["modes"].as_array().unwrap() {
        assert_eq!(mode["damping"]["complex"], true);
        let [f, ratio] =
            ["natural_frequency_hz", "loss_factor"].map(|k| mode["damping"][k].as_f64());
        assert_eq!(mode["damping_ratio"].as_f64().unwrap(), 0.5 * ratio.unwrap());
        let decay = mode["damping"]["decay_1_per_s"].as_f64().unwrap();
        let own = std::f64::consts::TAU * f.unwrap() * 0.5 * ratio.unwrap();
        assert!((decay / own - 1.0).abs() < 1e-12);
    }
    // The same response as table, as CSV and as JSON; at 0 Hz it is the static one.
    let frf = ["frf", "bat.json", "--at", "0.7", "--to", "0.1", "-n", "3", "--theory", "rayleigh"];
    let ask = |more: &[&str]| folder.text(&[&frf[..], more].concat());
    let listed = ["--frequencies", "50,200", "--kind", "accelerance"];
    let json: Value =
        serde_json::from_str(&ask(&[&listed[..], &["--json", "-"]].concat())).unwrap();
    let own = "format generator kind at_m to_m theory modes strains static_compliance_m_per_n \
               rigid_modes frequency_hz real_1_per_kg imaginary_1_per_kg truncation_1_per_kg \
               peaks frequencies_within";
    assert_eq!(keys(&json), set(own));
    assert_eq!(json["format"], "sweetspot-frf/1");
    let csv = ask(&[&listed[..], &["--csv", "-"]].concat());
    let header = "frequency_hz,real_1_per_kg,imaginary_1_per_kg,magnitude_1_per_kg,phase_deg,\
                  truncation_1_per_kg";
    assert_eq!(csv.lines().next(), Some(header));
    for (k, line) in csv.lines().skip(1).enumerate() {
        let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        assert_eq!(cells[0], json["frequency_hz"][k]);
        assert_eq!(cells[1], json["real_1_per_kg"][k]);
        assert!((cells[3] / cells[1].hypot(cells[2]) - 1.0).abs() < 1e-15);
    }
    assert!(ask(&[]).contains("under a constant force"));
    let still = ask(&["--frequencies", "0", "--json", "-"]);
    let still: Value = serde_json::from_str(&still).unwrap();
    let static_compliance = still["static_compliance_m_per_n"].as_f64().unwrap();
    let at_rest = still["real_m_per_n"][0].as_f64().unwrap();
    // With the stiffness times 1 + iη the compliance of the bat is slightly smaller, by at most η².
    assert!((at_rest / static_compliance - 1.0).abs() < 4e-4, "{at_rest} {static_compliance}");
    // A lasting push, for which a heavier reading means a larger deflection.
    folder.write("push.csv", "t_ms,force_n\n0,0\n1,100\n2,0\n");
    folder.write("twice.csv", "t_s,force_kn\n0,0\n0.001,0.2\n0.002,0\n");
    let ring = |file: &str| -> Vec<f64> {
        let args = ["ring", "bat.json", "--at", "0.7", "--force", file, "--shape-points", "3"];
        let json = folder.json(&[&args[..], &["--theory", "rayleigh", "--json", "-"]].concat());
        json["deflection_m"].as_array().unwrap().iter().flat_map(floats).collect()
    };
    for (once, twice) in ring("push.csv").iter().zip(ring("twice.csv")) {
        assert!((2.0 * once - twice).abs() <= 1e-12 * twice.abs());
    }
}

fn read(folder: &Folder, name: &str) -> Value {
    serde_json::from_str(&folder.read(name)).unwrap()
}

#[test]
fn equal_input_gives_equal_bytes() {
    let folder = Folder::new("equal");
    let (bat, hollow) = (mesh("r161"), mesh("northwestern_aluminium"));
    for bat in [&bat, &hollow] {
        for args in [
            &["modes", bat, "--json", "-", "--reproducible", "--shape-points", "nodes"][..],
            &["modes", bat, "--json", "-", "--reproducible", "--solver", "dense", "-n", "4"],
            &["modes", bat],
            &["hit", bat, "--json", "-"],
            &["ring", bat, "--at", "0.6", "--impulse", "1"],
            &["analyze", bat],
            &["analyze", bat, "--json", "-", "--reproducible"],
        ] {
            let first = folder.run(args);
            assert!(first.status.success(), "{args:?}");
            assert_eq!(folder.run(args).stdout, first.stdout, "{args:?}");
        }
    }
}

/// Every number of the text, read and written again, gives the same text.
#[test]
fn numbers_are_written_in_the_shortest_form_that_reads_back_to_the_same_bits() {
    let folder = Folder::new("bits");
    let bat = mesh("torpedo");
    for verb in ["modes", "hit"] {
        let text = folder.text(&[verb, &bat, "--json", "-"]);
        assert!(!text.contains("NaN") && !text.contains("Infinity") && !text.contains("inf,"));
        let mut numbers = 0;
        for line in text.lines() {
            let value = line.rsplit_once(": ").map_or(line, |(_, value)| value);
            let value = value.trim().trim_end_matches(',');
            if !value.starts_with(|c: char| c.is_ascii_digit() || c == '-') {
                continue;
            }
            let parsed: f64 = value.parse().unwrap();
            let written: f64 = serde_json::to_string(&parsed).unwrap().parse().unwrap();
            assert_eq!(written.to_bits(), parsed.to_bits(), "{value}");
            let digits = |text: &str| {
                let mantissa = text.split(['e', 'E']).next().unwrap_or_default();
                let digits: String = mantissa.chars().filter(char::is_ascii_digit).collect();
                digits.trim_matches('0').len()
            };
            assert!(digits(value) <= digits(&format!("{parsed:e}")), "{value}");
            numbers += 1;
        }
        assert!(numbers > 1000, "{verb}: {numbers}");
    }
    // The bat in the JSON is a bat file, and gives the same answer to the last bit.
    let first = folder.json(&["modes", &bat, "--json", "-", "--reproducible"]);
    folder.write("again.json", first["bat"].to_string());
    let second = folder.json(&["modes", "again.json", "--json", "-", "--reproducible"]);
    for part in ["summary", "modes"] {
        assert_eq!(first[part], second[part]);
    }
}

/// Everything that a bat file may hold, materials in numbers.
const EVERYTHING: &str = r#"{
  "format": "sweetspot-bat/1",
  "name": "everything",
  "source": "made up",
  "material": { "density": 700, "youngs_modulus": 14e9, "poisson_ratio": 0.3, "loss_factor": 0.01 },
  "profile": {
    "unit": "in",
    "x": [0, 13, 21, 29, 33], "diameter": [1, 1.2, 2.5, 2.6, 2.4], "inner_diameter": [0, 0, 1, 1, 1]
  },
  "regions": [
    { "from": 0, "to": "6 in", "material": {
      "density": 1500, "youngs_modulus": "60 GPa", "shear_modulus": "5 GPa", "shear_coefficient": 0.8 } },
    { "from": "22 in", "to": "33 in", "core": { "density": 200, "youngs_modulus": "20 MPa" } }
  ],
  "attachments": [
    { "x": "33 in", "mass": "2 oz", "offset": "-0.5 in", "rotary_inertia": "1 oz in^2" },
    { "x": 0.05, "stiffness": 2000, "rotational_stiffness": "30 ft lbf/rad" }
  ],
  "absorbers": [{ "x": 0.02, "mass": 0.03, "frequency": 170, "damping": 1.5 }],
  "joints": [{ "x": 0.4, "rotational_stiffness": 2e4 }],
  "supports": [{ "x": 0.1, "type": "pinned" }, { "x": 0.2, "type": "clamped" }],
  "grip": { "from": 0, "to": 0.15, "stiffness": 4e5, "damping": 300 },
  "weighed": { "balance_point": "21 in", "first_bending_hz": "170 Hz" }
}"#;

#[test]
fn a_bat_written_again_is_the_same_bat() {
    let read = |text: &str| Bat::from_text("bat.json", text, Path::new("")).unwrap();
    let bat = read(EVERYTHING);
    let fixtures = &bat.fixtures();
    let counts = [fixtures.regions.len(), fixtures.attachments.len(), fixtures.supports.len()];
    assert_eq!((counts, fixtures.absorbers.len(), fixtures.joints.len()), ([2; 3], 1, 1));
    assert!(fixtures.grip.is_some());
    let tuned = 0.03 * (std::f64::consts::TAU * 170.0).powi(2);
    assert!((fixtures.absorbers[0].stiffness / tuned - 1.0).abs() < 1e-15);
    // Outputs are in SI, which is the only difference.
    assert!(bat.inches());
    let again = read(&schema::text(&resolved(&bat)));
    assert_eq!(again.with(|parts| parts.inches = true).unwrap(), bat);
    // Weighed, turned, with a named material, held otherwise: the same to round-off.
    let weighed = EVERYTHING.replace("\"weighed\": {", "\"weighed\": { \"mass\": 1.1,");
    let named = EVERYTHING.replace("\"core\": {", "\"material\": \"white-ash\", \"core\": {");
    let held = EVERYTHING.replace("\"pinned\"", "\"clamped\"");
    let turned = EVERYTHING.replace("\"in\",", "\"in\", \"measured_from\": \"tip\",");
    for text in [weighed, named, held, turned] {
        let bat = read(&text);
        let again = read(&schema::text(&resolved(&bat)));
        assert_eq!(again.weighed(), bat.weighed());
        let (a, b) = (again.inertia(), bat.inertia());
        assert!((a.mass / b.mass - 1.0).abs() < 1e-14);
        assert!((a.balance_point / b.balance_point - 1.0).abs() < 1e-14);
        assert!((a.about_balance / b.about_balance - 1.0).abs() < 1e-14);
        // Without the tap, whose frequency is not that of the bat because of the absorber.
        let bat = read(&text.replace(", \"first_bending_hz\": \"170 Hz\"", ""));
        let again = read(&schema::text(&resolved(&bat)));
        let few = Request { modes: 3, elements: Some(24), degree: Some(6), ..Request::plain() };
        let modes = |bat: &Bat| solve(bat, &few).unwrap().modes;
        for (a, b) in modes(&again).iter().zip(modes(&bat)) {
            assert!((a.frequency() / b.frequency() - 1.0).abs() < 1e-12);
        }
    }
}

fn keys(value: &Value) -> BTreeSet<&str> {
    value.as_object().expect("an object").keys().map(String::as_str).collect()
}

fn set(names: &str) -> BTreeSet<&str> {
    names.split_whitespace().collect()
}

#[test]
fn the_modes_document_has_the_keys_of_the_contract() {
    let folder = Folder::new("modes-keys");
    let modes = folder.json(&["modes", &mesh("r161"), "-n", "4", "--json", "-"]);
    let top = "format generator bat summary model rigid_modes modes timing";
    assert_eq!(keys(&modes), set(top));
    assert_eq!(modes["rigid_modes"], 2);
    assert_eq!(keys(&modes["generator"]), set("program version"));
    assert_eq!(modes["generator"]["program"], "sweetspot");
    assert_eq!(modes["bat"]["format"], "sweetspot-bat/1");
    let summary = "length_m mass_kg balance_point_m inertia_balance_kg_m2 pivot_m \
                   inertia_pivot_kg_m2 center_of_percussion_m";
    assert_eq!(keys(&modes["summary"]), set(summary));
    assert_eq!(modes["summary"]["pivot_m"], 0.1524);
    let model = "theory elements degree solver degrees_of_freedom ignored \
                 lanczos_steps plan tolerance_met no_mode_missing";
    assert_eq!(keys(&modes["model"]), set(model));
    assert_eq!(keys(&modes["timing"]), set("plan_s assemble_s solve_s"));
    let list = modes["modes"].as_array().unwrap();
    assert_eq!(list.len(), 4);
    let mut before = 0.0;
    for (k, mode) in list.iter().enumerate() {
        let own = "order frequency_hz omega_rad_s damping_ratio modal_mass_kg nodes_m error shape";
        assert_eq!(keys(mode), set(own));
        assert_eq!(mode["order"], k + 1);
        let number = |key: &str| mode[key].as_f64().unwrap();
        assert!(number("frequency_hz") > before);
        before = number("frequency_hz");
        let turns = number("omega_rad_s") / std::f64::consts::TAU;
        assert!((turns / before - 1.0).abs() < 1e-15);
        assert_eq!(mode["nodes_m"].as_array().unwrap().len(), k + 2);
        assert_eq!(
            keys(&mode["error"]),
            set("discretization round_off residual nodes_m modal_mass shape")
        );
        assert_eq!(keys(&mode["shape"]), set("x_m deflection rotation"));
        for column in ["x_m", "deflection", "rotation"] {
            assert_eq!(mode["shape"][column].as_array().unwrap().len(), 101, "{column}");
        }
        let deflection: Vec<f64> = floats(&mode["shape"]["deflection"]);
        assert!(deflection[100] > 0.0 && deflection.iter().all(|w| w.abs() <= 1.0 + 1e-15));
        let x = floats(&mode["shape"]["x_m"]);
        assert_eq!((x[0], Some(x[100])), (0.0, modes["summary"]["length_m"].as_f64()));
    }
    let shapes = |points: &str| {
        let args = ["modes", &mesh("r161"), "-n", "1", "--shape-points", points, "--json", "-"];
        let modes = folder.json(&args);
        let count = floats(&modes["modes"][0]["shape"]["deflection"]).len();
        (count, modes["model"]["elements"].as_u64().unwrap() as usize)
    };
    assert_eq!((shapes("0").0, shapes("1").0, shapes("7").0), (0, 1, 7));
    let (nodes, elements) = shapes("nodes");
    assert_eq!(nodes, elements + 1);
    let bare = folder.json(&["modes", &mesh("r161"), "--reproducible", "--json", "-"]);
    assert!(bare.get("timing").is_none());
}

fn floats(list: &Value) -> Vec<f64> {
    list.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

/// Against exact frequencies. The time is far more than enough, so that the test is no race.
#[test]
fn the_most_accurate_answer_within_a_time_is_as_accurate_as_it_says() {
    let folder = Folder::new("budget");
    let case: Value = serde_json::from_str(include_str!("../validation/pchip_bat.json")).unwrap();
    folder.write("pchip.json", case["bat"].to_string());
    for (bat, truth) in [
        (mesh("dowel"), Truth::of_dowel(10)),
        ("pchip.json".to_owned(), Truth::of_cases(&["pchip_bat"])),
    ] {
        let args = ["modes", &bat, "--budget", "5 s", "--shape-points", "0", "--json", "-"];
        let document = folder.json(&[&args[..], &["--theory", "euler-bernoulli"]].concat());
        assert_eq!(document["model"]["plan"], "the most accurate within 5s");
        assert_eq!(document["model"]["tolerance_met"], true);
        let modes = document["modes"].as_array().unwrap();
        assert_eq!(modes.len(), 10);
        for (mode, exact) in modes.iter().zip(truth.unwrap().frequencies) {
            let part = |kind: &str| mode["error"][kind].as_f64().unwrap();
            let stated = part("discretization") + part("round_off");
            let off = (mode["frequency_hz"].as_f64().unwrap() / exact - 1.0).abs();
            assert!(off <= 3.0 * stated && stated < 1e-12, "{bat}: {off:e} {stated:e}");
        }
    }
}

#[test]
fn the_hit_document_has_the_keys_of_the_contract_and_its_energies_sum() {
    let folder = Folder::new("hit-keys");
    let three = &["--modes", "3"][..];
    for (model, more) in
        [("rigid", &[][..]), ("energy-loss", three), ("pulse", three), ("contact", three)]
    {
        let bat = mesh("r161");
        let args = ["hit", &bat, "--model", model, "--points", "11", "--json", "-"];
        let hit = folder.json(&[&args[..], more].concat());
        let top = set("format generator model scene impacts sweet_spot figures ignored");
        assert!(keys(&hit).is_subset(&top) && keys(&hit).len() >= top.len() - 1);
        assert_eq!((&hit["format"], &hit["model"]), (&"sweetspot-hit/1".into(), &model.into()));
        let scene = "bat_pivot_m swing_rad_s ball ball_speed_m_s cor hands_m energies_seen_from";
        assert_eq!(keys(&hit["scene"]), set(scene));
        assert_eq!(hit["scene"]["bat_pivot_m"], 0.0635);
        let spot = "exit_speed_max first_separation_max vibration_min node_mode_1_m node_mode_2_m \
                    center_of_percussion_m zone_m hands_velocity_min \
                    hands_acceleration_min inch_off_m_s";
        assert_eq!(keys(&hit["sweet_spot"]), set(spot));
        assert_eq!(keys(&hit["sweet_spot"]["exit_speed_max"]), set("x_m value"));
        assert_eq!(floats(&hit["sweet_spot"]["zone_m"]).len(), 2);
        let impacts = hit["impacts"].as_array().unwrap();
        assert_eq!(impacts.len(), 11);
        for impact in impacts {
            let own = "x_m from_tip_m cor bat_speed_m_s exit_speed_m_s rigid_exit_speed_m_s \
                       impulse_n_s contact_time_s first_separation peak_force_n \
                       peak_compression_m collision_efficiency bbcor bbcor_pivoted modes_used flags energy_j error";
            assert_eq!(keys(impact), set(own));
            assert_eq!(keys(&impact["error"]), set("exit_speed"));
            for key in ["contact_time_s", "first_separation", "peak_force_n", "peak_compression_m"]
            {
                assert_eq!(impact[key].is_null(), model != "contact");
            }
            let energy = &impact["energy_j"];
            let parts = "initial ball bat_rigid vibration vibration_by_mode dissipated_ball \
                         dissipated_damping imbalance";
            assert_eq!(keys(energy), set(parts));
            let joules = |key: &str| energy[key].as_f64().unwrap();
            let after = ["ball", "bat_rigid", "vibration", "dissipated_ball", "dissipated_damping"];
            let sum: f64 = after.into_iter().chain(["imbalance"]).map(joules).sum();
            assert!((sum / joules("initial") - 1.0).abs() < 1e-14, "{energy}");
            let by_mode = floats(&energy["vibration_by_mode"]);
            assert_eq!(impact["modes_used"], by_mode.len());
            assert_eq!(by_mode.len(), if model == "rigid" { 0 } else { 3 });
            assert!((by_mode.iter().sum::<f64>() - joules("vibration")).abs() < 1e-12);
            if model != "energy-loss" {
                assert!(joules("imbalance").abs() < 1e-12 * joules("initial"), "{energy}");
            }
        }
    }
    // No real solution: null and its consequences, but still a row, and exit code 0.
    let none = folder.json(&[
        "hit",
        &mesh("r161"),
        "--model",
        "energy-loss",
        "--gamma",
        "100",
        "--json",
        "-",
    ]);
    let impacts = none["impacts"].as_array().unwrap();
    let nulls: Vec<&Value> = impacts.iter().filter(|i| i["exit_speed_m_s"].is_null()).collect();
    assert!(impacts.len() == 101 && !nulls.is_empty());
    for impact in nulls {
        assert_eq!(impact["flags"][0], "no_real_solution");
        for key in ["impulse_n_s", "collision_efficiency", "bbcor", "bbcor_pivoted", "energy_j"] {
            assert!(impact[key].is_null(), "{key}");
        }
    }
}

#[test]
fn the_trade_documents_have_their_keys_and_tell_the_truth() {
    let folder = Folder::new("trade-keys");
    let bat = mesh("r161");
    let args = ["trade", &bat, "-n", "3", "--budget", "400 ms", "--csv", "t.csv", "--json", "-"];
    let trade = folder.json(&args);
    let top = "format generator bat modes reference runs planner more_elements words";
    assert_eq!(keys(&trade), set(top));
    assert_eq!((&trade["format"], &trade["modes"]), (&"sweetspot-trade/1".into(), &3.into()));
    let choice = "degree elements solver degrees_of_freedom";
    let reference = &trade["reference"];
    let own = format!("{choice} theory frequencies_hz stated_error floor confirmed_by");
    assert_eq!(keys(reference), set(&own));
    assert_eq!(keys(&reference["confirmed_by"]), set(&format!("{choice} agreement")));
    assert_eq!(floats(&reference["frequencies_hz"]).len(), 3);
    let floor = reference["floor"].as_f64().unwrap();
    assert!(reference["confirmed_by"]["agreement"].as_f64().unwrap() <= floor && floor < 1e-13);
    let runs = trade["runs"].as_array().unwrap();
    let own =
        format!("{choice} seconds repeats error error_by_mode stated_error planned_for on_front");
    for run in runs {
        assert_eq!(keys(run), set(&own));
        let by_mode = floats(&run["error_by_mode"]);
        assert_eq!(run["error"].as_f64(), by_mode.iter().copied().reduce(f64::max));
    }
    for plan in trade["planner"].as_array().unwrap() {
        assert!(runs.contains(plan), "{plan}");
        assert!(plan["error"].as_f64() <= plan["planned_for"].as_f64(), "{plan}");
    }
    let csv = folder.read("t.csv");
    assert!(csv.starts_with("degree,elements,solver,") && csv.lines().count() == runs.len() + 1);
    let table = folder.text(&["trade", &bat, "--budget", "100 ms", "--full"]);
    assert!(table.lines().all(|line| line.chars().count() <= 80), "{table}");
}

#[test]
fn the_u_curve_is_shown() {
    let folder = Folder::new("u-curve");
    let bat = mesh("dowel");
    let args = ["trade", &bat, "--u-curve", "-n", "2", "--budget", "200 ms"];
    let curve = folder.json(&[&args[..], &["--csv", "u.csv", "--json", "-"]].concat());
    assert_eq!(keys(&curve), set("format generator bat modes degree reference columns"));
    assert_eq!(curve["format"], "sweetspot-u-curve/1");
    let mut rows = 1;
    for column in curve["columns"].as_array().unwrap() {
        assert_eq!(keys(column), set("solver points end own_lost_at recomputed_lost_at"));
        for point in column["points"].as_array().unwrap() {
            let own = "elements seconds own_error_by_mode recomputed_error_by_mode";
            assert_eq!(keys(point), set(own));
            assert_eq!(floats(&point["recomputed_error_by_mode"]).len(), 2);
            let statics = column["solver"] == "statics";
            assert_eq!(point["own_error_by_mode"].is_null(), statics);
            rows += if statics { 2 } else { 4 };
        }
    }
    let csv = folder.read("u.csv");
    assert!(csv.starts_with("solver,frequency,elements,mode,error\n"), "{csv}");
    assert_eq!(csv.lines().count(), rows);
    let table = folder.text(&[&args[..], &["--full"]].concat());
    assert!(table.lines().all(|line| line.chars().count() <= 80), "{table}");
}

/// Every cell of `modes --csv` and `hit --csv` is the number of the JSON, to the last bit.
#[test]
fn tables_for_other_programs_hold_the_numbers_of_the_json() {
    let folder = Folder::new("tables");
    let bat = mesh("r161");
    let lists = [
        ("modes", "modes", ["-n", "4", "--tol", "1e-6"]),
        ("hit", "impacts", ["--points", "5", "--from", "0.4"]),
    ];
    for (verb, list, more) in lists {
        let args = [&[verb, &bat, "--csv", "t.csv", "--json", "-"][..], &more].concat();
        let document = folder.json(&args);
        let mut reader = csv::Reader::from_path(folder.0.join("t.csv")).unwrap();
        let names = reader.headers().unwrap().clone();
        let rows: Vec<_> = reader.records().map(Result::unwrap).collect();
        assert_eq!(rows.len(), document[list].as_array().unwrap().len());
        for (row, item) in rows.iter().zip(document[list].as_array().unwrap()) {
            for (name, cell) in names.iter().zip(row) {
                let path = format!("/{}", name.replace('.', "/"));
                let known =
                    match name.strip_prefix("node_").and_then(|rest| rest.strip_suffix("_m")) {
                        Some(k) => item["nodes_m"].get(k.parse::<usize>().unwrap() - 1),
                        None if name == "vibration_j" => item.pointer("/energy_j/vibration"),
                        None => item.pointer(&path),
                    };
                match known {
                    Some(Value::Number(number)) => {
                        assert_eq!(cell.parse::<f64>().ok(), number.as_f64(), "{name}");
                    }
                    Some(Value::Array(words)) => {
                        let words: Vec<&str> = words.iter().map(|w| w.as_str().unwrap()).collect();
                        assert_eq!(cell, words.join(" "), "{name}");
                    }
                    _ => assert_eq!(cell, "", "{name} {known:?}"),
                }
            }
        }
        assert_eq!(
            folder.text(&[verb, &bat, "--csv", "-", more[0], more[1], more[2], more[3]]),
            folder.read("t.csv")
        );
        let output = folder.run(&[verb, &bat, "--csv", "-", "--json", "-"]);
        assert!(output.status.code() == Some(2) && output.stdout.is_empty());
    }
}

/// With `--json` the last line on standard error is the mistakes as JSON, without it is not.
#[test]
fn what_is_wrong_is_json_too_where_json_is_asked_for() {
    let folder = Folder::new("errors");
    folder.write("bat.json", "{ \"format\": \"sweetspot-bat/1\", }");
    for (args, place, line) in [
        (&["modes", "bat.json"][..], None, Some(1)),
        (&["modes", "none.json"], None, None),
        (&["modes", "bat.json", "--tol", "x"], Some("--tol"), None),
        (&["hit", "bat.json", "--pich", "3"], Some("--pich"), None),
        (&["hit"], None, None),
    ] {
        let plain = folder.run(args);
        for json in ["--json=-", "--json=out.json"] {
            let output = folder.run(&[args, &[json]].concat());
            assert_eq!(output.status.code(), Some(2), "{args:?}");
            assert!(output.stdout.is_empty() && !folder.0.join("out.json").exists());
            let told = String::from_utf8(output.stderr).unwrap();
            let (people, last) = told.trim_end().rsplit_once('\n').unwrap();
            let plain = String::from_utf8_lossy(&plain.stderr);
            assert_eq!(people.lines().next(), plain.lines().next(), "{args:?}");
            let document: Value = serde_json::from_str(last).unwrap();
            let mistake = &document["mistakes"][0];
            assert_eq!(mistake["place"].as_str(), place, "{document}");
            assert_eq!(mistake["line"].as_u64(), line, "{document}");
            assert!(!mistake["found"].as_str().unwrap().is_empty());
        }
    }
}

#[test]
fn matrices_are_written_whole() {
    let folder = Folder::new("matrices");
    let bat = mesh("dowel");
    folder.text(&["modes", &bat, "--elements", "8", "-n", "2", "--matrices", "m"]);
    let out = Folder(folder.0.join("m"));
    assert_eq!(out.names(), ["bat.npz", "mass.mtx", "stiffness.mtx"]);
    for name in ["mass.mtx", "stiffness.mtx"] {
        let text = out.read(name);
        let mut lines = text.lines();
        assert!(lines.next().unwrap().starts_with("%%MatrixMarket matrix coordinate real"));
        let size = lines.by_ref().find(|line| !line.starts_with('%')).unwrap();
        let size: Vec<usize> = size.split_whitespace().map(|n| n.parse().unwrap()).collect();
        assert_eq!((size[0], size[1], size[2]), (18, 18, lines.count()), "{name}");
    }
}

/// A bat without modes recoils as a body, with the inertia of its sections.
#[test]
fn a_hit_without_modes_is_the_rigid_one() {
    let folder = Folder::new("no-modes");
    let speed = |more: &[&str]| {
        let args = [&["hit", "r161", "--at", "0.7", "--json", "-"], more].concat();
        folder.json(&args)["impacts"][0]["exit_speed_m_s"].as_f64().unwrap()
    };
    let (none, rigid) = (speed(&["-n", "0"]), speed(&["--model", "rigid"]));
    assert!((none / rigid - 1.0).abs() < 1e-12, "{none} {rigid}");
}

/// Whether a bat has a bore is one answer, and a doubt is told once.
#[test]
fn words_of_different_verbs_agree() {
    let folder = Folder::new("words-agree");
    let said = |args: &[&str]| {
        let output = folder.run(args);
        let both = [output.stdout, output.stderr].map(|text| String::from_utf8(text).unwrap());
        both.concat().split_whitespace().collect::<Vec<_>>().join(" ")
    };
    // A bore filled with cork.
    assert!(!said(&["advise", "corked", "--full"]).contains("no empty bore"));
    assert!(said(&["modes", "corked", "--full"]).contains("in wood not modelled"));
    assert!(said(&["hoop", "corked"]).contains("a hollow bat of wood"));
    // A tube with a plug.
    assert!(!said(&["lathe", "bbcor_made_up"]).contains("drilled"));
    for verb in ["analyze", "hit"] {
        let told = said(&[verb, "northwestern_aluminium"]);
        assert_eq!(told.matches("is no material of bats").count(), 1, "{verb}: {told}");
    }
    let grip = r#", "grip": { "from": "0 in", "to": "6 in", "stiffness": 4e8, "damping": 200 }"#;
    for (held, said_free) in [("", true), (grip, false)] {
        let tube = format!(
            r#"{{ "format": "sweetspot-bat/1", "material": "aluminium-7075", "profile": {{ "unit": "in",
                "x": [0, 6, 20, 27, 33], "diameter": [1.0, 0.9, 1.6, 2.4, 2.5],
                "wall_thickness": [0.1, 0.1, 0.1, 0.1, 0.1] }}{held} }}"#
        );
        folder.write("tube.json", tube);
        let told = said(&["analyze", "tube.json"]);
        assert!(told.contains("figures are rough, ") && told.contains("free BBCOR") == said_free);
    }
    let still = said(&["hit", "r161", "--swing-speed", "0", "--pitch", "0"]);
    assert!(still.contains("do not approach each other") && !still.contains("0.0e0"), "{still}");
    let aimed = said(&["aim", "r161", "--target", "swing weight -1 %", "--rules", "ncaa"]);
    assert!(aimed.contains("BBCOR at most") && !aimed.contains("bbcor"), "{aimed}");
}
