//! The results of `sweetspot identify`, and its refusals.

use serde_json::Value;
use uff58::{Dataset, Function, Nodes, Values};

use crate::common::folder::Folder;

const LOSSY: &str = r#"{ "format": "sweetspot-bat/1", "name": "Lossy", "profile": { "unit": "in",
    "x": [0, 6, 20, 27, 33], "diameter": [1.0, 0.9, 1.6, 2.4, 2.5] },
    "material": { "density": 650, "youngs_modulus": 18e9, "shear_modulus": 1.1e9, "loss_factor": 0.012 } }"#;

/// A folder with the bat and responses of a test of it, 3 modes below 1500 Hz.
fn tested(name: &str, options: &[&str]) -> (Folder, Value) {
    let folder = Folder::new(name);
    folder.write("bat.json", LOSSY);
    let test = ["identify", "--simulate", "bat.json", "--to-hz", "1500", "--uff", "set.uff"];
    let told = folder.json(&[&test[..], options, &["--json", "-"]].concat());
    (folder, told)
}

fn numbers(modes: &Value, name: &str) -> Vec<f64> {
    modes.as_array().unwrap().iter().map(|mode| mode[name].as_f64().unwrap()).collect()
}

/// The largest relative difference between the frequencies of two lists.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len(), "{a:?} {b:?}");
    a.iter().zip(b).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max)
}

/// A set whose datasets of functions and nodes are changed.
fn changed(
    folder: &Folder,
    name: &str,
    function: impl Fn(usize, &mut Function),
    keep: impl Fn(&Dataset) -> bool,
) {
    let bytes = std::fs::read(folder.0.join("set.uff")).unwrap();
    let mut universal = uff58::parse("set.uff", &bytes).unwrap();
    universal.datasets.retain(keep);
    let mut count = 0;
    for dataset in &mut universal.datasets {
        if let Dataset::Function(one) = dataset {
            function(count, one);
            count += 1;
        }
    }
    folder.write(name, uff58::write(&universal.datasets).unwrap());
}

fn modes_of(folder: &Folder, args: &[&str]) -> Value {
    folder.json(&[&["identify"], args, &["--json", "-"]].concat())["modes"].take()
}

/// Frequencies within 0.005 %, damping within 1 %, modal masses within 2 % (13 points miss the largest deflection) of the
/// bat's modes, with the accelerometer's mass taken off; `compare` pairs them by shape.
#[test]
fn a_hammer_test_gives_the_modes_of_the_bat_without_the_accelerometer() {
    let (folder, _) = tested("identify_hammer", &["--accelerometer", "8g", "--points", "13"]);
    let exact = folder.json(&["modes", "bat.json", "-n", "3", "--tol", "1e-8", "--json", "-"]);
    let truth = numbers(&exact["modes"], "frequency_hz");
    let args = ["set.uff", "--accelerometer", "8g", "--out", "modes.uff", "--plots", "plots"];
    let found = modes_of(&folder, &args);
    assert!(apart(&numbers(&found, "frequency_hz"), &truth) < 5e-5, "{found:#}");
    assert!(apart(&numbers(&found, "damping_ratio"), &[0.006; 3]) < 0.01, "{found:#}");
    let masses = numbers(&exact["modes"], "modal_mass_kg");
    assert!(apart(&numbers(&found, "modal_mass_kg"), &masses) < 0.02, "{found:#}");
    let loaded = numbers(&modes_of(&folder, &["set.uff"]), "frequency_hz");
    assert!(loaded.iter().zip(&truth).all(|(loaded, alone)| *loaded < 0.999 * alone));
    let compared = folder.json(&["compare", "bat.json", "--measured", "modes.uff", "--json", "-"]);
    for pair in compared["pairs"].as_array().unwrap() {
        assert!(pair["mac"].as_f64().unwrap() > 0.999, "{pair:#}");
    }
    assert_eq!(compared["pairs"].as_array().unwrap().len(), 3);
    let drawn = folder.names().into_iter().filter(|name| name == "plots").count();
    assert!(drawn == 1 && folder.read_names("plots").len() == 4);
}

/// A window adds `1/τ` to every decay, which is subtracted where τ is given.
#[test]
fn an_exponential_window_is_taken_off() {
    let (folder, _) = tested("identify_window", &["--window", "0.2 s", "--points", "7"]);
    let with = modes_of(&folder, &["set.uff", "--accelerometer", "5g"]);
    let told = ["set.uff", "--accelerometer", "5g", "--window", "0.2 s"];
    let without = modes_of(&folder, &told);
    for (with, f) in numbers(&with, "damping_ratio").iter().zip(numbers(&without, "frequency_hz")) {
        let window = 1.0 / (0.2 * std::f64::consts::TAU * f);
        assert!(((with - window) / 0.006 - 1.0).abs() < 0.02, "{with} {f}");
    }
    assert!(apart(&numbers(&without, "damping_ratio"), &[0.006; 3]) < 0.01, "{without:#}");
}

/// The modes do not depend on the kind and unit of the responses, on coherence, on the order of functions, on grids, or on
/// whether hammer or sensor was moved, beyond the noise.
#[test]
fn modes_do_not_depend_on_how_they_were_measured() {
    let (folder, _) = tested("identify_same", &["--points", "9", "--accelerometer", "1e-6"]);
    let here = numbers(&modes_of(&folder, &["set.uff"]), "frequency_hz");
    let same = |name: &str, args: &[&str]| {
        let found = numbers(&modes_of(&folder, &[&[name], args].concat()), "frequency_hz");
        assert!(apart(&found, &here) < 5e-5, "{name}: {found:?} {here:?}");
    };
    let all = |_: &Dataset| true;
    let uncertain = |dataset: &Dataset| !matches!(dataset, Dataset::Function(f) if f.kind == 6);
    changed(&folder, "bare.uff", |_, _| (), uncertain);
    same("bare.uff", &[]);
    let in_g = |_: usize, one: &mut Function| {
        let Values::Complex(values) = &mut one.values else { return };
        let per = 9.80665 / 4.448_221_615_260_5;
        values.iter_mut().flatten().for_each(|part| *part /= per);
    };
    let no_units = |dataset: &Dataset| !matches!(dataset, Dataset::Units(_));
    changed(&folder, "g.uff", in_g, no_units);
    same("g.uff", &["--unit", "g/lbf"]);
    // Every other response stops earlier: two grids.
    let shorter = |k: usize, one: &mut Function| {
        let keep = if (k / 2).is_multiple_of(2) { 1600 } else { 1500 };
        match &mut one.values {
            Values::Complex(values) => values.truncate(keep),
            Values::Real(values) => values.truncate(keep),
        }
    };
    changed(&folder, "grids.uff", shorter, all);
    same("grids.uff", &[]);
    let turned =
        |_: usize, one: &mut Function| std::mem::swap(&mut one.response, &mut one.reference);
    changed(&folder, "row.uff", turned, all);
    same("row.uff", &[]);
    assert_eq!(folder.json(&["identify", "row.uff", "--json", "-"])["roved"], "accelerometers");
}

/// One response alone has frequencies and damping; two references are one set where they share a point.
#[test]
fn one_response_and_two_references_are_read() {
    let (folder, _) = tested("identify_few", &["--points", "6", "--accelerometer", "1e-6"]);
    let here = numbers(&modes_of(&folder, &["set.uff"]), "frequency_hz");
    let first = std::cell::Cell::new(true);
    let one = |dataset: &Dataset| !matches!(dataset, Dataset::Function(_)) || first.replace(false);
    changed(&folder, "one.uff", |_, _| (), one);
    let alone = folder.json(&["identify", "one.uff", "--json", "-"]);
    assert!(apart(&numbers(&alone["modes"], "frequency_hz"), &here) < 1e-4, "{alone:#}");
    assert!(alone["warnings"].as_array().unwrap().iter().any(|one| one["code"] == "no_shape"));
    let test = ["identify", "--simulate", "bat.json", "--to-hz", "1500", "--accelerometer", "1e-6"];
    let other = ["--points", "6", "--reference", "0", "--seed", "2", "--uff", "other.uff"];
    folder.text(&[&test[..], &other].concat());
    let both = folder.json(&["identify", "set.uff", "other.uff", "--json", "-"]);
    assert_eq!(both["references"].as_array().unwrap().len(), 2);
    assert!(apart(&numbers(&both["modes"], "frequency_hz"), &here) < 5e-5, "{both:#}");
}

#[test]
fn what_is_missing_is_said() {
    let (folder, _) = tested("identify_missing", &["--points", "5"]);
    let all = |_: &Dataset| true;
    let in_time = |_: usize, one: &mut Function| one.kind = 1;
    changed(&folder, "time.uff", in_time, all);
    let no_nodes = |dataset: &Dataset| !matches!(dataset, Dataset::Nodes(Nodes { .. }));
    changed(&folder, "nowhere.uff", |_, _| (), no_nodes);
    let no_drive = |dataset: &Dataset| !matches!(dataset, Dataset::Function(f) if f.response.node == f.reference.node);
    changed(&folder, "apart.uff", |_, _| (), no_drive);
    for (args, words) in [
        (&["time.uff"][..], "records in time"),
        (&["nowhere.uff"], "without a place"),
        (&["set.uff", "--to-hz", "10"], "24 at least"),
        (&["set.uff", "--from-hz", "20", "--to-hz", "10"], "a frequency above 20 Hz"),
        (&["apart.uff", "--accelerometer", "5g"], "how much the bat gives way"),
        (&["set.uff", "--accelerometer", "0 g"], "more than 0"),
        (&["set.uff", "--accelerometer", "500 g"], "0.1 kg at most"),
        (&["set.uff", "--window", "0.01 s"], "damps more than the mode"),
        (&["set.uff", "set.uff"], "it twice"),
        (&["--simulate", "bat.json", "--missing", "18446744073709551615"], "at most"),
        (&["--simulate", "bat.json", "--double-hits", "16"], "15 at most"),
        (&["--simulate", "bat.json", "--hammer", "5 kg"], "0.01 to 2 kg"),
        (&["--simulate", "bat.json", "--to-hz", "30000"], "10 to 20000 Hz"),
        (&["set.uff", "--simulate", "bat.json"], "it beside --simulate"),
        (&["--simulate", "bat.json", "--points", "2"], "3 to 100"),
        (&["--simulate", "torpedo", "--reference", "85 cm"], "--reference"),
        (&["--simulate", "bat.json", "--points", "6", "--missing", "4"], "3 at most"),
        (&["--simulate", "bat.json", "--noise", "3"], "-200 to 0 dB"),
        // What the program drew is not blamed on the masses told.
        (
            &["--simulate", "r161", "--accelerometer", "90 g", "--rove", "accelerometers"],
            "such a test does not find the modes",
        ),
    ] {
        let output = folder.run(&[&["identify"], args].concat());
        let told = String::from_utf8_lossy(&output.stderr).replace('\n', " ");
        assert!(output.status.code() == Some(2) && told.contains(words), "{args:?}: {told}");
    }
    let modes = folder.json(&["identify", "apart.uff", "--json", "-"]);
    assert!(modes["modes"][0]["modal_mass_kg"].is_null());
    let noise = |_: usize, one: &mut Function| {
        let Values::Complex(values) = &mut one.values else { return };
        let mut state = 1_u64;
        values.iter_mut().flatten().for_each(|part| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            *part = (state >> 33) as f64 / (1_u64 << 30) as f64 - 1.0;
        });
    };
    changed(&folder, "noise.uff", noise, all);
    let output = folder.run(&["identify", "noise.uff"]);
    assert_eq!(output.status.code(), Some(1), "{output:?}");
}

/// The statements of the virtual test are correct: masses lower every frequency, and the suggested reference is no
/// node.
#[test]
fn a_virtual_test_says_what_masses_do_and_where_to_hit() {
    let more = ["--missing", "2", "--double-hits", "3", "--noise", "-40", "--hammer", "0.3 kg"];
    let (_, told) = tested("identify_plan", &more);
    let planned = told["simulated"]["modes"].as_array().unwrap();
    assert_eq!(planned.len(), 3);
    for mode in planned {
        let exact = mode["frequency_hz"].as_f64().unwrap();
        assert!(mode["by_masses"].as_f64().unwrap() < 0.0, "{mode:#}");
        assert!((mode["found_hz"].as_f64().unwrap() / exact - 1.0).abs() < 2e-4, "{mode:#}");
    }
    assert_eq!(told["responses"], 13);
    let hang = told["simulated"]["hang_m"].as_array().unwrap();
    let [low, high] = [0, 1].map(|k| hang[k].as_f64().unwrap());
    assert!(low < 0.42 && high > 0.42);
    assert!(told["simulated"]["reference_least"].as_f64().unwrap() > 0.3);
}

/// A bat that ends in a point is tested up to near the point; its modes are found within 0.01 %.
#[test]
fn a_pointed_bat_carries_hammer_and_accelerometers() {
    let folder = Folder::new("identify_point");
    for rove in ["hammer", "accelerometers"] {
        let test =
            ["identify", "--simulate", "torpedo", "--accelerometer", "0.1 g", "--rove", rove];
        let told = folder.json(&[&test[..], &["--json", "-"]].concat());
        let planned = &told["simulated"]["modes"];
        let [exact, found] = ["frequency_hz", "found_hz"].map(|name| numbers(planned, name));
        assert!(exact.len() == 4 && apart(&found, &exact) < 1e-4, "{told:#}");
    }
}

/// Where a hammer's force vanishes noise looks like modes; the virtual test names each that is none of the bat's.
#[test]
fn modes_of_noise_are_named() {
    let folder = Folder::new("identify_force");
    let test = ["identify", "--simulate", "bbcor_made_up", "--to-hz", "8000", "--json", "-"];
    let told = folder.json(&test);
    assert!(told["simulated"]["force_db"].as_f64().unwrap() < -60.0);
    let exact = numbers(&told["simulated"]["modes"], "frequency_hz");
    let found = numbers(&told["modes"], "frequency_hz");
    let all = told["warnings"].as_array().unwrap().iter();
    let named = all.filter(|one| one["code"] == "false_modes").map(|one| one["text"].to_string());
    let named = named.collect::<String>().matches(" Hz").count();
    assert_eq!(named, found.len() - exact.len(), "{told:#}");
    assert!(!tested("identify_true", &[]).1["warnings"].to_string().contains("false_modes"));
}

/// A virtual test says that the fit does not describe dashpots, and hangs no bat that is held.
#[test]
fn hands_are_said_and_not_hung() {
    let folder = Folder::new("identify_hands");
    let hands =
        r#""grip": { "from": 0, "to": "6 in", "stiffness": 3e4, "damping": 300 }, "material""#;
    folder.write("hands.json", LOSSY.replace(r#""material""#, hands));
    let test = ["identify", "--simulate", "hands.json", "--to-hz", "1500", "--json", "-"];
    let told = folder.json(&test);
    let warnings = told["warnings"].as_array().unwrap();
    let said = |code: &str| warnings.iter().any(|one| one["code"] == code);
    assert!(said("dashpots") && !said("hang"), "{told:#}");
    assert_eq!(told["simulated"]["hang_m"].as_array().unwrap().len(), 0);
    let (_, free) = tested("identify_hung", &[]);
    let codes = free["warnings"].to_string();
    assert!(codes.contains("\"hang\"") && !codes.contains("dashpots"), "{codes}");
}
