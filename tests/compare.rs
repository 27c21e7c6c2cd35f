//! Comparison of bats: known differences, and correct stated errors.

use crate::common;

use common::folder::Folder;
use common::{bat, cone, of_factors};
use serde_json::Value;
use sweetspot::Bat;
use sweetspot::bat::profile::Interpolation;
use sweetspot::bat::theory::Theory;
use sweetspot::collision::figures::SwingLaw;
use sweetspot::collision::hit::{Model, Scene};
use sweetspot::collision::pulse::Pulse;
use sweetspot::collision::sweet_spot::FINE;
use sweetspot::modes::solve::Request;
use sweetspot_study::comparison::contender::Terms;
use sweetspot_study::comparison::rows::{ComparedFigure, Unit};
use sweetspot_study::comparison::stretches::Harder;
use sweetspot_study::comparison::table::{Comparison, Entry};

const INCH: f64 = 0.0254;

fn compare(bats: &[Bat], tolerance: f64) -> Comparison {
    compare_by(Model::Contact, bats, tolerance)
}

fn compare_by(model: Model, bats: &[Bat], tolerance: f64) -> Comparison {
    let terms = Terms { model, exactly: false, every: INCH, look: FINE, barrel: None };
    let request = Request { tolerance, theory: Theory::Rayleigh, ..Request::default() };
    let entry = |bat: &Bat| Entry { bat: bat.clone(), scene: Scene::default(), law: None, request };
    Comparison::new(bats.iter().map(entry).collect(), terms).unwrap()
}

fn row<'a>(comparison: &'a Comparison, key: &str) -> &'a ComparedFigure {
    comparison.figures.iter().find(|row| row.key == key).unwrap_or_else(|| panic!("{key}"))
}

fn all(comparison: &Comparison) -> impl Iterator<Item = &ComparedFigure> {
    comparison.figures.iter().chain(&comparison.by_tip).chain(&comparison.by_knob)
}

#[test]
fn a_bat_differs_from_itself_in_nothing() {
    let r161 = Bat::builtin("r161").unwrap();
    let twice = compare(&[r161.clone(), r161], 1e-4);
    assert!(twice.same_length());
    for row in all(&twice) {
        if let Some(difference) = row.difference(1) {
            assert!(difference.by == 0.0 && !difference.beyond_errors, "{row:?}");
        }
    }
    assert!(twice.stretches(1).iter().all(|stretch| stretch.harder.is_none()));
}

/// With the same E/ρ the frequencies are the same, and mass and inertia are proportional to ρ.
#[test]
fn a_denser_bat_is_heavier_by_as_much_and_rings_the_same() {
    let light = cone(0.0125, 0.033);
    let heavy = of_factors(&light, [1.25, 1.25]);
    let both = compare(&[light, heavy], 1e-4);
    for key in ["length", "balance_point", "frequency_1", "frequency_3", "node_2_of_mode_1"] {
        assert!(!row(&both, key).difference(1).unwrap().beyond_errors, "{key}");
    }
    for key in ["mass", "swing_weight"] {
        let values = &row(&both, key).values;
        let [light, heavy] = [0, 1].map(|k| values[k].unwrap().value);
        assert!((heavy / light - 1.25).abs() < 1e-13, "{key}");
        assert!(row(&both, key).difference(1).unwrap().beyond_errors, "{key}");
    }
    // The heavier recoils less.
    let faster = row(&both, "best_exit_speed").difference(1).unwrap();
    assert!(faster.beyond_errors && faster.by > 0.0);
    assert!(both.stretches(1).iter().all(|stretch| stretch.harder == Some(Harder::This)));
}

/// Every length times k: frequencies over k, places times k.
#[test]
fn a_longer_bat_is_compared_from_both_ends() {
    let stations =
        |k: f64| bat(&[0.0, 0.8 * k], &[0.0125 * k, 0.033 * k], &[0.0; 2], Interpolation::Linear);
    let k = 1.05;
    let both = compare(&[stations(1.0), stations(k)], 1e-6);
    assert!(!both.same_length());
    let ratio = |key: &str| {
        let values = &row(&both, key).values;
        values[1].unwrap().value / values[0].unwrap().value
    };
    assert!((ratio("frequency_2") * k - 1.0).abs() < 1e-6);
    assert!((ratio("node_1_of_mode_2") / k - 1.0).abs() < 1e-6);
    assert!((ratio("node_1_of_mode_2_from_tip") / k - 1.0).abs() < 1e-6);
    assert!((ratio("mass") / k.powi(3) - 1.0).abs() < 1e-12);
    let length = row(&both, "length").difference(1).unwrap();
    assert!((length.by - 0.04).abs() < 1e-15 && length.beyond_errors);
    // From the knob end, only places that both bats have.
    let [first, last] = [both.from_knob[0], both.from_knob[both.from_knob.len() - 1]];
    assert!(first >= k * 0.8 - 0.4 * 0.8 && last <= 0.8);
    assert!(both.by_knob.iter().all(|row| row.values.iter().all(Option::is_some)));
}

/// Against hits of the same bat computed far more accurately.
#[test]
fn what_is_stated_of_an_error_holds() {
    let names = ["r161", "torpedo", "cone"];
    let bats = names.map(|name| Bat::builtin(name).unwrap());
    let pulse = Model::Pulse(Pulse::default());
    for (model, tolerances) in [(Model::Contact, &[1e-2, 1e-4][..]), (pulse, &[1e-3])] {
        let truth = compare_by(model, &bats, 1e-6);
        for tolerance in tolerances {
            let rough = compare_by(model, &bats, *tolerance);
            for (known, row) in all(&truth).zip(all(&rough)) {
                assert_eq!(known.key, row.key);
                for (known, figure) in known.values.iter().zip(&row.values) {
                    let (Some(known), Some(figure)) = (known, figure) else { continue };
                    let off = (figure.value - known.value).abs();
                    // The promise of every stated error here.
                    let allowed = 3.0 * (figure.error + known.error);
                    assert!(off <= allowed, "{tolerance:e} {}: {off:e} {figure:?}", row.key);
                }
            }
        }
    }
}

/// n = ½ is the same energy of rotation.
#[test]
fn one_batter_swings_the_heavier_bat_slower() {
    let light = cone(0.0125, 0.033);
    let heavy = of_factors(&light, [1.25, 1.25]);
    let reference = light.inertia().about(0.1524);
    let law = SwingLaw { exponent: 0.5, reference, of_reference: 50.0 };
    let entry = |bat: &Bat| Entry {
        bat: bat.clone(),
        scene: Scene { swing: law.swing(bat), ..Scene::default() },
        law: Some(law),
        request: Request::plain(),
    };
    let terms =
        Terms { model: Model::Contact, exactly: false, every: INCH, look: FINE, barrel: None };
    let both = Comparison::new(vec![entry(&light), entry(&heavy)], terms).unwrap();
    let energy = |k: usize| {
        let value = |key: &str| row(&both, key).values[k].unwrap().value;
        value("swing_weight") * value("swing").powi(2)
    };
    assert!((energy(1) / energy(0) - 1.0).abs() < 1e-13);
    assert_eq!(row(&both, "swing").unit, Unit::RadiansPerSecond);
}

fn meshes(test: &str) -> Folder {
    let folder = Folder::new(&format!("compare-{test}"));
    for name in ["r161", "torpedo", "house"] {
        let text = std::fs::read_to_string(format!("{}/meshes/{name}.json", env!("SWEETSPOT_TOP")))
            .unwrap();
        folder.write(&format!("{name}.json"), text);
    }
    folder
}

#[test]
fn table_json_and_csv_say_the_same_and_a_hit_says_it_too() {
    let folder = meshes("outputs");
    let two = ["compare", "r161.json", "torpedo.json"];
    let ask = |more: &[&str]| folder.text(&[&two[..], more].concat());
    for more in [
        &["--units", "si"][..],
        &["--units", "us"],
        &["--units", "both"],
        &["--full", "--units", "both"],
    ] {
        let table = ask(more);
        assert!(table.lines().all(|line| line.chars().count() <= 80), "{more:?}");
        assert!(table.contains("All are swung at 43.0 rad/s") && table.contains("In words"));
    }
    let json = folder.json(&[&two[..], &["--json", "-"]].concat());
    assert_eq!(json["format"], "sweetspot-compare/1");
    let barrels = ask(&["--bat-speed", "70 mph"]);
    assert!(barrels.contains("All barrels move at 31.29 m/s (70.0 mph)"), "{barrels}");
    let csv = ask(&["--csv", "-"]);
    for line in csv.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let bat = if cells[2] == "A" { 0 } else { 1 };
        let [value, error] = [3, 4].map(|k| cells[k].parse::<f64>().unwrap());
        match cells[1] {
            "" => {
                let figure = &json["bats"][bat]["figures"][cells[0]];
                assert_eq!((&figure["value"], &figure["error"]), (&value.into(), &error.into()));
                if bat == 1 {
                    let by = cells[5].parse::<f64>().unwrap();
                    assert_eq!(figure["difference"], by);
                    assert_eq!(figure["beyond_errors"], cells[7] == "true");
                }
            }
            distance => {
                let list = json[cells[0].trim_end_matches("_m_s")].as_array().unwrap();
                let distance: f64 = distance.parse().unwrap();
                let here = list.iter().find(|row| row["distance_m"] == distance).unwrap();
                assert_eq!(here["exit_speed_m_s"][bat], value);
            }
        }
    }
    for (k, name) in ["r161.json", "torpedo.json"].iter().enumerate() {
        let hit = folder.json(&["hit", name, "--at", "27 in", "--json", "-"]);
        let impact = &hit["impacts"][0];
        let near = |row: &&Value| (row["distance_m"].as_f64().unwrap() - 27.0 * INCH).abs() < 1e-9;
        let here = json["exit_speed_from_knob"].as_array().unwrap().iter().find(near).unwrap();
        let [a, b] = [&here["exit_speed_m_s"][k], &impact["exit_speed_m_s"]].map(Value::as_f64);
        // Each is within 1e-4 of the closing speed.
        assert!((a.unwrap() - b.unwrap()).abs() < 2e-4 * 80.0);
        let best = json["bats"][k]["figures"]["best_exit_speed_m_s"]["value"].as_f64().unwrap();
        let spot = hit["sweet_spot"]["exit_speed_max"]["value"].as_f64().unwrap();
        assert!((best - spot).abs() < 2e-4 * 80.0);
    }
}

/// A grip changes the frame of the energies by the whole swing, and the bat hardly at all.
#[test]
fn energies_are_compared_only_where_all_are_seen_from_the_same_place() {
    let folder = meshes("held");
    let held = folder.read("r161.json").replacen(
        '{',
        "{ \"grip\": { \"from\": 0.02, \"to\": 0.2, \"stiffness\": 1e5, \"damping\": 10 },",
        1,
    );
    folder.write("held.json", held);
    let energies = ["vibration_at_best_j", "least_vibration_j"];
    for (bats, seen) in [
        (["r161.json", "torpedo.json"], ["ground", "ground"]),
        (["held.json", "held.json"], ["hands", "hands"]),
        (["r161.json", "held.json"], ["ground", "hands"]),
    ] {
        let args = ["compare", bats[0], bats[1]];
        let json = folder.json(&[&args[..], &["--json", "-"]].concat());
        assert_eq!(json["scene"]["energies_seen_from"], Value::Null);
        let alike = seen[0] == seen[1];
        for (bat, seen) in json["bats"].as_array().unwrap().iter().zip(seen) {
            assert_eq!(bat["energies_seen_from"], seen);
            for key in energies {
                assert_eq!(bat["figures"][key].is_object(), alike, "{bats:?} {key}");
            }
            assert!(bat["figures"]["best_exit_speed_m_s"].is_object());
        }
        let table = folder.text(&[&args[..], &["--full"]].concat());
        assert_eq!(table.contains("Vibration is not compared"), !alike, "{bats:?}");
        assert_eq!(table.contains("vibration at the best place"), alike, "{bats:?}");
    }
}

#[test]
fn more_bats_have_a_table_of_all_and_a_rigid_one_no_vibration() {
    let folder = meshes("three");
    let three =
        ["compare", "r161.json", "torpedo.json", "house.json", "--model", "rigid", "--full"];
    let table = folder.text(&three);
    assert!(table.contains("\nWhat differs") && table.contains("\nC beside A"));
    assert!(!table.contains("vibration") && !table.contains("BBCOR"));
    assert!(table.lines().all(|line| line.chars().count() <= 80));
    let law = ["--reference-inertia", "0.19 kg*m^2", "--swing-exponent", "0.5"];
    let table = folder.text(&[&three[..], &law].concat());
    assert!(table.contains("One batter swings each") && table.contains("C is swung at"));
}

/// One screen of 24 lines and 80 columns; equal figures are named and not shown.
#[test]
fn two_bats_fit_on_one_screen_and_five_on_two() {
    let folder = Folder::new("screens");
    let five = ["compare", "r161", "torpedo", "house", "tanh", "corked", "--quiet"];
    let two = ["compare", "r161", "torpedo", "--quiet"];
    let same = ["compare", "r161", "r161", "--quiet"];
    for (args, most) in [(&five[..], 40), (&two, 24), (&same, 24)] {
        for units in ["both", "si", "us"] {
            let table = folder.text(&[args, &["--units", units]].concat());
            assert!(table.lines().count() <= most, "{}\n{table}", table.lines().count());
            assert!(table.lines().all(|line| line.chars().count() <= 80), "{table}");
        }
    }
    let shown = folder.text(&five);
    let first = shown.lines().position(|line| line.starts_with("What differs")).unwrap();
    assert!(shown.lines().nth(first + 1).unwrap().starts_with("  best exit speed"));
    let shown = folder.text(&same);
    assert!(shown.contains("No difference beyond the errors: best exit speed"), "{shown}");
    assert!(!shown.contains("+"), "{shown}");
}

#[test]
fn six_bats_fit_into_the_pictures_too() {
    let folder = meshes("pictures");
    let bats = ["r161.json", "torpedo.json", "house.json"];
    let six: Vec<&str> = bats.into_iter().cycle().take(6).collect();
    let args = [&["compare", "--full"], &six[..], &["--plots", "p", "--every", "2 in"]].concat();
    let table = folder.text(&args);
    assert!(table.contains("\nF beside A") && table.lines().all(|l| l.chars().count() <= 80));
    for name in ["profile", "shapes", "exit_speed", "difference"] {
        let svg = folder.read(&format!("p/{name}.svg"));
        assert!(svg.starts_with("<svg") && svg.contains("F: House"), "{name}");
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{name}");
    }
}

#[test]
fn what_cannot_be_compared_is_refused() {
    let folder = meshes("refused");
    let seven = ["r161.json"; 7];
    let cases: [(&[&str], &str); 5] = [
        (&["r161.json"], "expected 2 to 6 that can be compared"),
        (&seven, "expected 2 to 6 that can be compared"),
        (&["r161.json", "house.json", "--every", "0"], "--every: found 0.0 m"),
        (&["r161.json", "house.json", "--csv", "-", "--json", "-"], "one of them"),
        (&["r161.json", "missing.json"], "missing.json"),
    ];
    for (args, told) in cases {
        let output = folder.run(&[&["compare"], args].concat());
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.code() == Some(2) && error.contains(told), "{args:?}: {error}");
        assert!(output.stdout.is_empty());
    }
}

#[test]
fn differences_stand_beside_what_two_pieces_of_one_wood_differ_by() {
    let folder = Folder::new("pieces");
    let text = folder.text(&["compare", "r161", "torpedo", "--units", "us"]);
    let one = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(one.contains("pieces of one material differ too"), "{text}");
    assert!(one.contains(" mph; \"within\" is the computation alone. Everything"), "{text}");
    let edit = folder.text(&["compare", "r161", "--edit", "knob 2 oz"]);
    let one = edit.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(one.contains("one and the same piece") && !one.contains("differ too"), "{edit}");
    folder.text(&["compare", "r161", "torpedo", "--report", "two.html"]);
    let page = folder.read("two.html");
    assert!(page.contains("two pieces of one wood") && !page.contains("more than the errors"));
}

/// A relative change of the density by 10 % is the same change of the mass, and the difference of two pieces is √2
/// times as large.
#[test]
fn two_pieces_of_one_model_differ_in_mass_by_the_root_of_two_times_the_scatter() {
    let ash = sweetspot::Bat::from_text(
        "ash.json",
        r#"{ "format": "sweetspot-bat/1", "name": "a", "material": "white-ash",
             "profile": { "x": [0, 0.8], "diameter": [0.04, 0.06] } }"#,
        std::path::Path::new(""),
    )
    .unwrap();
    let two = compare(&[ash.clone(), ash.clone()], 1e-4);
    let mass = two.figure("mass", 1).unwrap().between_pieces.unwrap();
    let expected = 2.0_f64.sqrt() * 0.1 * ash.inertia().mass;
    // Central differences over a step of 5 % of the logarithm: accurate to its square over 6.
    assert!((mass / expected - 1.0).abs() < 5e-4, "{mass} {expected}");
    assert!(two.figure("best_exit_speed", 1).unwrap().between_pieces.unwrap() > 0.5);
    assert_eq!(two.figure("length", 1).unwrap().between_pieces, None);
}

#[test]
fn a_reference_inertia_without_its_exponent_is_refused_with_a_source() {
    let folder = Folder::new("alone");
    let alone = ["compare", "r161", "torpedo", "--reference-inertia", "10000 oz in2"];
    let output = folder.run(&alone);
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{told}");
    assert!(told.contains("--swing-exponent") && told.contains("ssl.wsu.edu"), "{told}");
    folder.text(&[&alone[..], &["--swing-exponent", "0.25"]].concat());
}
