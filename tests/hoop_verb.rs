//! The output for hollow bats: the verb `hoop`, its files, and the parts in `analyze` and the report.

use crate::common;

use common::folder::Folder;
use serde_json::{Value, json};
use sweetspot::collision::Ball;
use sweetspot::collision::sweep::Accuracy;
use sweetspot::{Bat, Theory};
use sweetspot_proof::bundled::bundled_bat;
use sweetspot_study::trampoline::barrel::{Barrel, BarrelStruck, BarrelTest};
use sweetspot_study::trampoline::thickness::with_wall;
use uff58::{Analysis, Dataset};

const INCH: f64 = 0.0254;

fn mesh(name: &str) -> Bat {
    bundled_bat(&format!("meshes/{name}.json")).unwrap()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|one| one.as_f64().unwrap()).collect()
}

fn modes_of(document: &Value, harmonic: usize) -> Vec<f64> {
    let modes = document["modes"].as_array().unwrap().iter();
    let own = modes.filter(|mode| mode["harmonic"] == harmonic);
    own.map(|mode| mode["frequency_hz"].as_f64().unwrap()).collect()
}

/// Standard error of a run that must be refused.
fn refused(folder: &Folder, args: &[&str]) -> String {
    let output = folder.run(args);
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.code() == Some(2) && output.stdout.is_empty(), "{args:?}: {told}");
    told
}

/// A short free tube of a soft metal, Poisson's ratio 0.45, whose edge rings: frequencies (Hz) of n = 2 by Ritz's
/// method, polynomials of degree 50 along and 16 across the whole tube (search/hoops.py), bounds from above and known
/// to 5e-9. An even degree across improves nothing there, so the difference from the odd degree before says nothing
/// about the error.
#[test]
fn the_edge_of_a_tube_of_a_soft_metal_is_within_its_stated_error() {
    let folder = Folder::new("hoop-edge");
    let (inner, outer) = (0.0271478994278119, 0.030394948532656417);
    let bat = json!({ "format": "sweetspot-bat/1", "name": "tube",
        "material": { "density": 2700.0, "youngs_modulus": 7e10, "poisson_ratio": 0.45 },
        "profile": { "interpolation": "linear", "x": [0.0, 0.06681798270356377],
            "radius": [outer, outer], "inner_radius": [inner, inner] } });
    folder.write("tube.json", bat.to_string());
    for tolerance in ["1e-4", "1e-5", "1e-6", "1e-7", "1e-8"] {
        let args = ["hoop", "tube.json", "--tol", tolerance, "--json", "-", "--quiet"];
        let document = folder.json(&args);
        let modes = document["modes"].as_array().unwrap().iter().filter(|m| m["harmonic"] == 2);
        for (mode, truth) in modes.zip([2_669.329_259_08, 3_182.434_096_62, 16_378.266_936_72]) {
            let off = mode["frequency_hz"].as_f64().unwrap() / truth - 1.0;
            let stated = mode["error"].as_f64().unwrap();
            assert!(off.abs() <= 3.0 * stated + 5e-9, "{tolerance}: {off:e} {stated:e}");
        }
    }
}

/// Frequencies (Hz) of the first three modes of n = 2 and 3, by an independent program in Python: the same solid, one
/// harmonic at a time, on meshes graded to the corner of the plug.
#[test]
fn the_made_up_bats_ring_as_another_program_found() {
    let folder = Folder::new("hoop-modes");
    for (bat, second, third) in [
        (
            "bbcor_made_up_open",
            [1939.920069, 2132.837659, 2810.245663],
            [5430.375400, 5553.603500, 5873.714604],
        ),
        (
            "bbcor_made_up",
            [2036.59397, 2586.86261, 3379.64715],
            [5502.59734, 5747.83806, 6239.30872],
        ),
    ] {
        let document = folder.json(&["hoop", bat, "--tol", "1e-6", "--json", "-"]);
        assert_eq!(document["format"], "sweetspot-hoop/1");
        assert_eq!(document["tolerance_met"], true, "{bat}");
        for (harmonic, expected) in [(2, second), (3, third)] {
            for (found, truth) in modes_of(&document, harmonic).into_iter().zip(expected) {
                let off = found / truth - 1.0;
                assert!(off.abs() < 4e-6, "{bat} n = {harmonic}: {found} for {truth}");
            }
        }
    }
    // The first mode of an open barrel moves most at the tip, of a plugged one in the barrel.
    let largest = |bat: &str| {
        let document = folder.json(&["hoop", bat, "--json", "-", "--shape-points", "0"]);
        let modes = document["modes"].as_array().unwrap();
        let first = modes.iter().find(|mode| mode["harmonic"] == 2).unwrap();
        assert!(first.get("shape").is_none());
        mesh(bat).length() - first["largest_at_m"].as_f64().unwrap()
    };
    assert!(largest("bbcor_made_up_open") < 0.1 * INCH);
    assert!((largest("bbcor_made_up") / INCH - 6.8).abs() < 0.1);
}

/// Stiffness (MN/m) of the wall, and BBCOR with a rigid wall and with it, by the same independent program and its
/// contact. Its bending is n = 1 of the solid, which changes BBCOR by less than 0.001.
#[test]
fn walls_of_other_thickness_give_way_as_another_program_found() {
    let bat = mesh("bbcor_made_up");
    let accuracy = Accuracy { theory: Theory::Timoshenko, ..Accuracy::default() };
    let test = || BarrelTest::of(&bat, Ball::baseball(), accuracy);
    let barrel = Barrel::of(&bat, test(), None).unwrap();
    for (wall, frequency, stiffness, stiff, with) in [
        (2.5e-3, 1704.0, 10.6, 0.498, 0.641),
        (3.0e-3, 2037.0, 17.2, 0.499, 0.609),
        (3.5e-3, 2383.0, 25.9, 0.500, 0.579),
        (5.0e-3, 3485.0, 67.9, 0.501, 0.530),
    ] {
        let other = with_wall(&bat, &barrel, wall / 3e-3).unwrap();
        let found = BarrelStruck::of(&other, &test(), None).unwrap();
        let [pressed, rebound] = (found.wall.as_ref()).zip(found.rebound.as_ref()).map_or_else(
            || panic!("{wall}"),
            |(pressed, rebound)| [pressed.stiffness_n_m * 1e-6, rebound.stiff],
        );
        assert!((found.wall.as_ref().unwrap().thickness_m - wall).abs() < 1e-12);
        let first = found.first_hz.unwrap();
        // The digits of a table, and the frequency as accurately as a hit needs it.
        assert!((first - frequency).abs() < 0.5 + 3e-4 * frequency, "{wall}: {first} Hz");
        assert!((pressed / stiffness - 1.0).abs() < 0.01, "{wall}: {pressed} MN/m");
        assert!((rebound - stiff).abs() < 0.003, "{wall}: {rebound} stiff");
        let bounced = found.rebound.unwrap();
        assert!((bounced.wall - with).abs() < 0.003, "{wall}: {bounced:?}");
        let [low, high] = bounced.range;
        assert!(low < bounced.wall && bounced.wall < high, "{wall}: {bounced:?}");
    }
}

/// The wall multiplied by k is `h + (k − 1) h_b w`, with h_b that of the barrel and w rising linearly from 0 at the
/// handle to 1 at the end of the taper; the outer surface does not change.
#[test]
fn another_wall_grows_along_the_taper_and_leaves_the_surface() {
    for name in ["bbcor_made_up", "softball_made_up_open"] {
        let bat = mesh(name);
        let test = BarrelTest::of(&bat, Ball::baseball(), Accuracy::plain());
        let barrel = Barrel::of(&bat, test, None).unwrap();
        let from = barrel.hoop().from();
        let whole = barrel.struck.wall.as_ref().unwrap().thickness_m;
        let borders = bat.profile().borders();
        let barrel_radius = bat.profile().at(0.8 * bat.length()).outer;
        let is_full = |x: &f64| bat.profile().at(*x).outer > 0.9999 * barrel_radius;
        let full = borders.into_iter().find(is_full).unwrap();
        for factor in [0.7, 1.5] {
            let other = with_wall(&bat, &barrel, factor).unwrap();
            for k in 1..80 {
                let x = bat.length() * f64::from(k) / 80.0;
                let [was, is] = [&bat, &other].map(|bat| bat.profile().at(x));
                assert!((is.outer - was.outer).abs() < 1e-15);
                let share = ((x - from) / (full - from)).clamp(0.0, 1.0);
                let wall = was.outer - was.inner + (factor - 1.0) * whole * share;
                assert!((is.outer - is.inner - wall).abs() < 1e-12, "{name} {factor} {x}");
            }
        }
    }
}

/// Stiffness is the inverse of the sum over the harmonics; two equal forces that face each other press both sides
/// in by the even ones twice each.
#[test]
fn the_document_says_how_its_numbers_hang_together() {
    let folder = Folder::new("hoop-json");
    let sweep = ["hoop", "bbcor_made_up", "--wall-sweep", "--json", "h.json", "--csv", "h.csv"];
    let text = folder.text(&sweep);
    let document: Value = serde_json::from_str(&folder.read("h.json")).unwrap();
    let shares = document["wall"]["by_harmonic"].as_array().unwrap();
    let soft = |even: bool| -> f64 {
        let kept = shares.iter().filter(|s| !even || s["harmonic"].as_u64().unwrap() % 2 == 0);
        kept.map(|share| share["flexibility_m_n"].as_f64().unwrap()).sum()
    };
    let number = |path: &str| document.pointer(path).unwrap().as_f64().unwrap();
    assert!((number("/wall/stiffness_n_m") * soft(false) - 1.0).abs() < 1e-12);
    let force = number("/compression/deflection_m") / (4.0 * soft(true));
    assert!((number("/compression/force_n") / force - 1.0).abs() < 1e-12);
    assert_eq!(number("/compression/deflection_m"), 0.04 * INCH);
    // The patch of Hertz on a drawing, for a ball compressed by 8 mm on a barrel of 33.3 mm.
    assert!((number("/wall/patch_half_length_m") - (0.0366_f64 * 8e-3).sqrt()).abs() < 1e-12);
    let around = (8e-3_f64 * 0.0366 * 0.0333 / (0.0366 + 0.0333)).sqrt();
    assert!((number("/wall/patch_half_width_m") - around).abs() < 1e-12);
    assert!((number("/wall/from_tip_m") - 6.0 * INCH).abs() < 1e-12);
    // Every mode is in the table of numbers.
    let modes = document["modes"].as_array().unwrap();
    let lines: Vec<String> = folder.read("h.csv").lines().map(str::to_owned).collect();
    assert_eq!(lines.len(), modes.len() + 1);
    for (mode, line) in modes.iter().zip(&lines[1..]) {
        let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        let keys = ["harmonic", "order", "frequency_hz", "damping_ratio", "error", "largest_at_m"];
        for (key, cell) in keys.into_iter().zip(cells) {
            assert_eq!(mode[key].as_f64().unwrap(), cell, "{line}");
        }
        let largest = numbers(&mode["shape"]["radial"])
            .into_iter()
            .fold(0.0, |most: f64, u| most.max(u.abs()));
        assert!(largest <= 1.0 + 1e-9, "{mode}");
    }
    // A thinner wall has lower frequencies, is more compliant, and returns the ball faster.
    let tried = document["wall_sweep"].as_array().unwrap();
    assert!(tried.len() >= 7, "{}", tried.len());
    for pair in tried.windows(2) {
        let rises = |key: &str| pair[0][key].as_f64() < pair[1][key].as_f64();
        assert!(
            ["factor", "thickness_m", "mass_kg", "frequency_hz", "stiffness_n_m"]
                .into_iter()
                .all(rises)
        );
        assert!(!rises("wall"), "{pair:?}");
    }
    let own = tried.iter().find(|tried| tried["factor"] == 1.0).unwrap();
    assert_eq!(own["wall"], document["bbcor"]["wall"]);
    assert!(text.contains("BBCOR against wall thickness"), "{text}");
    let first = format!(" {:.2} ", modes_of(&document, 2)[0]);
    assert!(text.contains(&first), "{first}\n{text}");
}

/// The composite loses a hundredth of its energy, the plug nothing: each mode has half of that as damping ratio, except
/// for the share of the plug. Its moduli are given, and nothing is assumed.
#[test]
fn a_composite_wall_rings_by_its_own_moduli_and_is_damped() {
    let folder = Folder::new("hoop-composite");
    let document =
        folder.json(&["hoop", "composite_made_up", "--shape-points", "0", "--json", "-"]);
    assert!(!document["notes"].to_string().contains("Poisson"), "{}", document["notes"]);
    for mode in document["modes"].as_array().unwrap() {
        let ratio = mode["damping_ratio"].as_f64().unwrap();
        assert!((0.0035..=0.005 + 1e-12).contains(&ratio), "{mode}");
    }
    // The same fibres in a bat with exactly twice the moduli have √2 times the frequencies.
    let text = include_str!("../meshes/composite_made_up.json");
    let mut twice: Value = serde_json::from_str(text).unwrap();
    let doubled = |value: &mut Value| {
        let (number, unit) = value.as_str().unwrap().split_once(' ').unwrap();
        *value = json!(format!("{} {unit}", 2.0 * number.parse::<f64>().unwrap()));
    };
    let material = twice["material"].as_object_mut().unwrap();
    for key in ["youngs_modulus", "shear_modulus", "hoop_modulus", "radial_modulus"] {
        doubled(&mut material[key]);
    }
    material["shear_moduli"].as_object_mut().unwrap().values_mut().for_each(doubled);
    doubled(&mut twice["regions"][0]["core"]["youngs_modulus"]);
    folder.write("twice.json", twice.to_string());
    let stiffer = folder.json(&["hoop", "twice.json", "--shape-points", "0", "--json", "-"]);
    for (one, two) in modes_of(&document, 2).iter().zip(modes_of(&stiffer, 2)) {
        assert!((two / one / 2f64.sqrt() - 1.0).abs() < 1e-6, "{one} {two}");
    }
}

/// A softball is a linear spring with a measured stiffness. Without one there is no rebound, and the reason is given
/// instead. The barrel is compressed by 0.07 in.
#[test]
fn a_ball_without_a_force_law_leaves_out_the_rebound_alone() {
    let folder = Folder::new("hoop-softball");
    let bat = "softball_made_up";
    let args = ["hoop", bat, "--ball", "softball", "--json", "-"];
    let without = folder.json(&args);
    assert_eq!(without["bbcor"], Value::Null);
    assert_eq!(without["compression"]["deflection_m"], json!(0.07 * INCH));
    let text = folder.text(&args[..4]);
    let flat = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(flat.contains("--ball-stiffness gives it one"), "{text}");
    let more = ["--ball-stiffness", "7000 lbf/in", "--speed", "100 mph", "--at", "27 in"];
    let with = folder.json(&[&args[..], &more].concat());
    // By the other program 0.447 with a stiff wall and 0.553 with this one, for a ball of 190 g with the same
    // stiffness.
    for (key, expected) in [("stiff", 0.447), ("wall", 0.553)] {
        let found = with["bbcor"][key].as_f64().unwrap();
        assert!((found - expected).abs() < 0.006, "{key}: {found}");
    }
}

#[test]
fn what_is_no_hollow_bat_of_metal_is_refused_with_the_reason() {
    let folder = Folder::new("hoop-refused");
    let told = refused(&folder, &["hoop", "r161"]);
    assert!(told.contains("solid"), "{told}");
    let tube = |material: &str| {
        format!(
            r#"{{ "format": "sweetspot-bat/1", "material": {material}, "profile": {{ "unit": "in",
                "x": [0, 12, 24, 33], "diameter": [1, 1, 2.6, 2.6],
                "wall_thickness": [0.12, 0.12, 0.12, 0.12] }} }}"#
        )
    };
    folder.write("ash.json", tube("\"white-ash-dynamic\""));
    let told = refused(&folder, &["hoop", "ash.json"]);
    assert!(told.contains("wood") && told.contains("grain"), "{told}");
    for (args, words) in [
        (&["--at", "40 in"][..], "--at: found"),
        (&["--ball", "basebal"], "did you mean baseball?"),
        (&["--speed", "0 m/s"], "--speed: found"),
        (&["--json", "x", "--csv", "x"], "--csv: found"),
        (&["--reproducible"], "--uff"),
        (&["--around", "2"], "2 is not in 3..=360"),
    ] {
        let told = refused(&folder, &[&["hoop", "bbcor_made_up"], args].concat());
        assert!(told.contains(words), "{args:?}: {told}");
    }
    let told = refused(&folder, &["hoop", "bbcor_made_up", "--at", "40 in", "--speed", "0 m/s"]);
    assert!(told.contains("--at: found") && told.contains("--speed: found"), "{told}");
    // Poisson's ratio is assumed, with a remark and the effect of another value.
    folder.write("tube.json", tube(r#"{ "density": 2810, "youngs_modulus": "71 GPa" }"#));
    let document = folder.json(&["hoop", "tube.json", "--quiet", "--json", "-"]);
    let notes = document["notes"].to_string();
    assert!(notes.contains("0.33") && notes.contains("0.05 smaller or larger"), "{notes}");
    assert!(notes.contains("the tip is open"), "{notes}");
    // The mass of tape on the barrel is not part of the wall.
    let tape = r#", "tapes": [ { "from": 0.6, "to": 0.8, "mass": "100 g" } ] }"#;
    let metal = r#"{ "density": 2810, "youngs_modulus": "71 GPa", "poisson_ratio": 0.33 }"#;
    let bare = tube(metal);
    folder.write("tube.json", &bare);
    folder
        .write("taped.json", format!("{}{tape}", bare.trim_end().trim_end_matches('}').trim_end()));
    let notes =
        |bat: &str| folder.json(&["hoop", bat, "--quiet", "--json", "-"])["notes"].to_string();
    assert!(
        notes("taped.json").contains("tape and weights") && !notes("tube.json").contains("tape")
    );
    // Near the knob the patch is not on the modelled wall.
    let handle = folder.json(&["hoop", "bbcor_made_up", "--at", "0.5 in", "--json", "-"]);
    assert_eq!([&handle["wall"], &handle["bbcor"], &handle["compression"]], [&Value::Null; 3]);
    assert!(
        handle["notes"].to_string().contains("does not meet the stretch"),
        "{}",
        handle["notes"]
    );
    // A ring shorter than the patch: the ball hits it, and the message is about the patch, which does not fit.
    folder.write(
        "ring.json",
        format!(
            r#"{{ "format": "sweetspot-bat/1", "material": {metal}, "profile": {{
                "x": [0, 0.02], "diameter": [0.0666, 0.0666], "wall_thickness": [0.003, 0.003] }} }}"#
        ),
    );
    let ring = folder.json(&["hoop", "ring.json", "--at", "0.01", "--quiet", "--json", "-"]);
    assert!(ring["wall"].is_null(), "{}", ring["wall"]);
    let said = ring["notes"].to_string();
    assert!(
        said.contains("presses on 0.0171 m to either side") && !said.contains("does not meet"),
        "{said}"
    );
    // A wall of 1.8 mm is dented by more than half of its thickness.
    let thin = folder.json(&["hoop", "bbcor_made_up", "--wall-sweep", "--json", "-"]);
    let thinnest = &thin["wall_sweep"][0];
    let [dent, wall] = ["dent_m", "thickness_m"].map(|key| thinnest[key].as_f64().unwrap());
    assert!(dent > 0.5 * wall, "{thinnest}");
    let notes = thin["notes"].to_string();
    assert!(notes.contains("dented by"), "{notes}");
}

/// On a cylinder of points, `u_r = U cos nθ`, `u_θ = V sin nθ`, `u_x = W cos nθ`.
#[test]
fn the_files_of_other_programs_hold_the_modes_on_a_cylinder() {
    const AROUND: usize = 12;
    let folder = Folder::new("hoop-files");
    let count = AROUND.to_string();
    folder.text(
        &[
            &[
                "hoop",
                "bbcor_made_up",
                "--uff",
                "b.uff",
                "--reproducible",
                "--vtu",
                "b.vtu",
                "--around",
            ][..],
            &[&count, "--shape-points", "61", "--json", "b.json"],
        ]
        .concat(),
    );
    let document: Value = serde_json::from_str(&folder.read("b.json")).unwrap();
    let modes = document["modes"].as_array().unwrap();
    let read = uff58::read(&folder.0.join("b.uff")).unwrap();
    let mut shapes = 0;
    let mut points: Vec<[f64; 3]> = vec![];
    for dataset in &read.datasets {
        match dataset {
            Dataset::Nodes(nodes) => points = nodes.nodes.iter().map(|node| node.at).collect(),
            Dataset::NodalData(data) => {
                let mode = &modes[shapes];
                shapes += 1;
                let Analysis::NormalMode { frequency, .. } = data.analysis else { panic!() };
                let told = mode["frequency_hz"].as_f64().unwrap();
                assert!((frequency / told - 1.0).abs() < 1e-5, "{frequency} {told}");
                let harmonic = mode["harmonic"].as_f64().unwrap();
                let [u, v, w] =
                    ["radial", "around", "along"].map(|key| numbers(&mode["shape"][key]));
                for (k, (_, values)) in data.values.iter().enumerate() {
                    let (ring, at) = (k / AROUND, points[k]);
                    let theta = at[2].atan2(at[1]);
                    let out = values[1][0] * theta.cos() + values[2][0] * theta.sin();
                    let turn = values[2][0] * theta.cos() - values[1][0] * theta.sin();
                    let (sine, cosine) = (harmonic * theta).sin_cos();
                    for (found, truth) in [
                        (out, u[ring] * cosine),
                        (turn, v[ring] * sine),
                        (values[0][0], w[ring] * cosine),
                    ] {
                        assert!((found - truth).abs() < 3e-6, "{mode}: {found} {truth}");
                    }
                }
            }
            _ => {}
        }
    }
    assert_eq!(shapes, modes.len());
    assert_eq!(points.len(), 61 * AROUND);
    let bat = mesh("bbcor_made_up");
    for at in &points {
        assert!((at[1].hypot(at[2]) - bat.profile().at(at[0]).outer).abs() < 1e-9, "{at:?}");
    }
    let vtu = folder.read("b.vtu");
    for mode in modes {
        let name = format!("Name=\"hoop_{}_{}\"", mode["harmonic"], mode["order"]);
        assert_eq!(vtu.matches(&name).count(), 1, "{name}");
    }
    assert!(vtu.contains(&format!("NumberOfPoints=\"{}\" NumberOfCells=\"{}\"", 61 * 12, 60 * 12)));
}

#[test]
fn an_analysis_of_a_hollow_bat_has_its_barrel_and_that_of_a_solid_one_has_none() {
    let folder = Folder::new("hoop-analyze");
    let (bat, solid) = ("bbcor_made_up", "r161");
    let short = folder.text(&["analyze", bat, "--quiet"]);
    assert!(short.contains("Hoop modes from 2037 Hz"), "{short}");
    let full = folder.text(&["analyze", bat, "--full", "--quiet", "--out", "out", "--plots", "p"]);
    assert!(full.contains("How the barrel rings") && full.contains("BBCOR there:"), "{full}");
    assert!(folder.read_names("out").contains(&"hoop.json".to_owned()));
    assert!(folder.read_names("p").contains(&"hoop.svg".to_owned()));
    let document = folder.json(&["analyze", bat, "--quiet", "--json", "-"]);
    assert_eq!(document["hoop"]["format"], "sweetspot-hoop/1");
    let without = folder.json(&["analyze", solid, "--quiet", "--json", "-"]);
    assert!(without.get("hoop").is_none());
    // The size of the ball's patch is an open question for hollow bats only.
    let open = |document: &Value| document["open"]["sources"].to_string();
    assert!(open(&document).contains("patch"), "{}", open(&document));
    // The doubt about the dent is in the document too.
    assert_eq!(document["open"]["doubts"][0]["about"], "dent");
    assert!(without["open"].get("doubts").is_none());
    assert!(!open(&without).contains("patch"), "{}", open(&without));
    assert!(!folder.text(&["analyze", solid, "--full", "--quiet"]).contains("hoop mode "));
    // The report has a section with a moving picture, a still one and numbers.
    folder.text(&["analyze", bat, "--quiet", "--report", "page.html"]);
    let page = folder.read("page.html");
    let (_, data) = page.split_once("id=\"data\">").unwrap();
    let data: Value = serde_json::from_str(data.split_once("</script>").unwrap().0).unwrap();
    let moving = data["barrel"]["modes"].as_array().unwrap();
    assert_eq!(moving.len(), 6);
    let places = numbers(&data["barrel"]["x_mm"]).len();
    assert!(moving.iter().all(|mode| numbers(&mode["radial"]).len() == places));
    for part in [
        "<section id=\"hoop\"",
        "id=\"hoop-player\"",
        "id=\"plot-hoop\"",
        "Hoop modes of the barrel",
    ] {
        assert!(page.contains(part), "{part}");
    }
    folder.text(&["analyze", solid, "--quiet", "--report", "solid.html"]);
    let page = folder.read("solid.html");
    assert!(!page.contains("<section id=\"hoop\"") && !page.contains("id=\"hoop-player\""));
    folder.text(&["analyze", bat, "--quiet", "--report", "bat.md"]);
    assert!(folder.read("bat.md").contains("## How the barrel rings"));
    assert!(folder.read_names("bat_pictures").contains(&"hoop.svg".to_owned()));
}

/// A tube that is widest at the knob has no handle, so all of it is the barrel. A rough tolerance still leaves BBCOR
/// the three digits shown.
#[test]
fn a_tube_that_tapers_to_its_tip_rings_whole() {
    let folder = Folder::new("hoop-narrowing");
    folder.write(
        "tube.json",
        r#"{ "format": "sweetspot-bat/1", "material": { "density": 2700, "youngs_modulus": 70e9,
            "poisson_ratio": 0.33 }, "profile": { "interpolation": "linear", "x": [0, 0.3829],
            "radius": [0.03, 0.02], "inner_radius": [0.028, 0.018] } }"#,
    );
    let found = folder.json(&["hoop", "tube.json", "--tol", "1e-3", "--json", "-"]);
    assert_eq!(found["tolerance_met"], true);
    assert_eq!(found["model"]["from_m"].as_f64(), Some(0.0));
}

/// Aluminium, whose Poisson's ratio follows from E and G.
#[test]
fn a_wall_of_known_poisson_ratio_has_no_note_on_it() {
    let text = Folder::new("hoop-poisson").text(&["hoop", "two_piece", "--full"]);
    assert!(text.contains("Hoop modes of Two-piece bat") && !text.contains("Poisson"), "{text}");
}

/// The ball touches the bat again; the time of the whole contact is in the words.
#[test]
fn the_ball_leaves_after_its_last_touch() {
    let folder = Folder::new("ring-last-touch");
    let ring = ["ring", "r161", "--hit", "0.45"];
    let document = folder.json(&[&ring[..], &["--json", "-"]].concat());
    let [last, touching] = [&document["contact_s"], &document["impact"]["contact_time_s"]]
        .map(|s| s.as_f64().unwrap());
    assert!((last - 4.57e-3).abs() < 5e-5 && last > 1.5 * touching, "{last} {touching}");
    let text = folder.text(&ring);
    assert!(text.contains(&format!("after {:.2} ms", 1e3 * last)), "{text}");
}
