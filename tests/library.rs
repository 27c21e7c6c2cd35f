//! The library gives the answers of the program: by default the same theory, the same tap, the same bits.

use std::fs;
use std::path::Path;

use serde_json::Value;
use sweetspot::collision::batch::{Blow, each as strike_each};
use sweetspot::collision::sweep::{Accuracy, Trial, sweep};
use sweetspot::collision::{Hitter, Model, Scene};
use sweetspot::modes::batch::{self, Way};
use sweetspot::modes::prepared::prepare;
use sweetspot::modes::up_to::modes_up_to;
use sweetspot::{Bat, Hit, Reached, Request, Swing, Theory, solve};

use crate::common::folder::Folder;

const MESHES: &str = concat!(env!("SWEETSPOT_TOP"), "/meshes");
/// The frequency (Hz) at which an R161 is said to have been tapped; by its file it has 174.5 Hz.
const TAPPED: f64 = 140.0;

fn r161_with(more: &str) -> String {
    let text = fs::read_to_string(format!("{MESHES}/r161.json")).unwrap();
    text.replacen("\"profile\"", &format!("{more}, \"profile\""), 1)
}

/// R161s that were tapped, weighed, and then changed, each with a name.
fn told() -> Vec<(&'static str, String)> {
    let tap = format!("\"weighed\": {{ \"first_bending_hz\": {TAPPED} }}");
    let cut = "\"edits\": [{ \"name\": \"lighter\", \"cut\": { \"from\": \"24 in\", \"to\": \"30 in\", \"depth\": \"1 mm\" } }]";
    let grip = "\"attachments\": [{ \"x\": 0.1, \"mass\": 0.02 }]";
    vec![
        ("tapped", r161_with(&tap)),
        ("weighed", r161_with("\"weighed\": { \"mass\": \"31 oz\" }")),
        ("both", r161_with("\"weighed\": { \"mass\": \"31 oz\", \"first_bending_hz\": 170.0 }")),
        ("tapped-and-cut", r161_with(&format!("{tap}, {cut}"))),
        ("tapped-with-a-weight", r161_with(&format!("{tap}, {grip}"))),
    ]
}

/// A folder with all bats, and their files.
fn bats() -> (Folder, Vec<String>) {
    let folder = Folder::new("library");
    let mut names = vec![];
    for entry in fs::read_dir(MESHES).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        fs::copy(&path, folder.0.join(&name)).unwrap();
        if name.ends_with(".json") {
            names.push(name);
        }
    }
    names.sort();
    for (name, text) in told() {
        folder.write(&format!("{name}.json"), text);
        names.push(format!("{name}.json"));
    }
    (folder, names)
}

fn printed(folder: &Folder, args: &[&str]) -> Value {
    let output = folder.command(args).output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{args:?}: {said}"))
}

fn numbers(array: &Value, field: &str) -> Vec<f64> {
    array.as_array().unwrap().iter().map(|one| one[field].as_f64().unwrap()).collect()
}

#[test]
fn solve_answers_as_the_program_to_the_bit() {
    let (folder, names) = bats();
    for name in names {
        let bat = Bat::from_file(folder.0.join(&name)).unwrap();
        let asked = Request { modes: 5, tolerance: 1e-8, ..Request::default() };
        let solution = solve(&bat, &asked).unwrap();
        let said = printed(
            &folder,
            &["modes", &name, "-n", "5", "--tol", "1e-8", "--quiet", "--json", "-"],
        );
        let ours: Vec<f64> = solution.modes.iter().map(|mode| mode.frequency()).collect();
        assert_eq!(ours, numbers(&said["modes"], "frequency_hz"), "{name}");
        assert_ne!(solution.theory, Theory::Auto, "{name}");
        let first = if name.starts_with("tapped.") { TAPPED } else { ours[0] };
        assert!((ours[0] / first - 1.0).abs() < 1e-8, "{name}: {}", ours[0]);
    }
}

#[test]
fn hits_answer_as_the_program_to_the_bit_one_by_one_and_side_by_side() {
    let (folder, _) = bats();
    let names = ["r161.json", "tapped.json", "both.json", "tapped-and-cut.json"];
    let bats = names.map(|name| Bat::from_file(folder.0.join(name)).unwrap());
    let scene = Scene { swing: 50.0, ball_speed: 40.0, ..Scene::default() };
    let accuracy = Accuracy { exit_speed: 1e-5, ..Accuracy::default() };
    let trial = Trial { model: Model::Contact, scene: &scene };
    let places = [0.6, 0.7];
    let blow = |bat| Blow { bat, trial, accuracy, places: &places };
    let blows: Vec<Blow> = bats.iter().map(blow).collect();
    let mut many = vec![vec![]; bats.len()];
    let speeds = |hits: &sweetspot::collision::sweep::Sweep| -> Vec<f64> {
        hits.impacts.iter().map(|hit| hit.outcome.as_ref().unwrap().exit_speed).collect()
    };
    strike_each(&bats[0], &blows, Way::SideBySide, |k, hits| many[k] = speeds(&hits.unwrap()));
    for ((name, bat), many) in names.iter().zip(&bats).zip(many) {
        let hits = sweep(bat, Model::Contact, &scene, &accuracy, &places).unwrap();
        let ours = speeds(&hits);
        let args = "--tol 1e-5 --swing-speed 50 --pitch 40 --from 0.6 --to 0.7 --points 2 --quiet --json -";
        let args: Vec<&str> = ["hit", name].into_iter().chain(args.split(' ')).collect();
        let said = printed(&folder, &args);
        assert_eq!(ours, numbers(&said["impacts"], "exit_speed_m_s"), "{name}");
        // The solution has the stiffness of its bat.
        let hitter = Hitter::new(Model::Contact, &scene, bat, &hits.solution, hits.effort).unwrap();
        assert_eq!(hitter.strike(0.7).outcome.unwrap().exit_speed, ours[1], "{name}");
        // Plans are shared between bats, and the answers agree to the requested accuracy.
        let off = ours.iter().zip(&many).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 1e-5 * 90.0, "{name}: {off}");
    }
}

#[test]
fn many_bats_are_solved_by_the_theory_and_the_tap_of_each() {
    let (folder, _) = bats();
    let names = ["tapped.json", "r161.json", "cone.json", "tapped-and-cut.json", "both.json"];
    let bats = names.map(|name| Bat::from_file(folder.0.join(name)).unwrap());
    let asked = Request { modes: 4, tolerance: 1e-8, ..Request::default() };
    let mut firsts = vec![];
    batch::each(&bats, &asked, Way::SideBySide, |k, found| {
        assert_eq!(k, firsts.len());
        firsts.push(found.unwrap().omegas.to_vec());
    });
    let pairs: Vec<(&Bat, Request)> = bats.iter().map(|bat| (bat, asked)).collect();
    batch::solutions(&bats[1], &pairs, Way::SideBySide, |k, solution| {
        let (solution, alone) = (solution.unwrap(), solve(&bats[k], &asked).unwrap());
        assert_eq!(solution.theory, alone.theory, "{}", names[k]);
        for (n, mode) in alone.modes.iter().enumerate() {
            assert!((solution.modes[n].omega / mode.omega - 1.0).abs() < 3e-8, "{}", names[k]);
            assert!((firsts[k][n] / mode.omega - 1.0).abs() < 3e-8, "{}", names[k]);
        }
    });
}

#[test]
fn a_bat_that_is_prepared_is_not_prepared_again() {
    for (name, text) in told() {
        let file = Bat::from_text("bat.json", &text, Path::new("")).unwrap();
        let asked = Request { modes: 3, tolerance: 1e-8, ..Request::default() };
        let once = prepare(&file, &asked).unwrap();
        let twice = prepare(&once.bat, &once.request).unwrap();
        assert_eq!(once.bat.factors(), twice.bat.factors(), "{name}");
        assert_eq!(once.bat.tap(), None, "{name}");
        // A change after the tap changes the frequency: the tap is not applied again.
        let softer = once.bat.with(|parts| parts.material.youngs_modulus *= 0.81).unwrap();
        let of = |bat: &Bat| solve(bat, &once.request).unwrap().modes[0].frequency();
        assert_eq!(of(&file), of(&once.bat), "{name}");
        assert!(of(&softer) < 0.95 * of(&once.bat), "{name}");
    }
}

#[test]
fn a_change_between_edits_and_tap_is_refused_in_words() {
    let (_, text) = told().into_iter().find(|(name, _)| *name == "tapped-and-cut").unwrap();
    let file = Bat::from_text("bat.json", &text, Path::new("")).unwrap();
    let changed = file.with(|parts| parts.material.density *= 1.1).unwrap();
    let said = solve(&changed, &Request::default()).unwrap_err().to_string();
    assert!(said.contains("weighed.first_bending_hz") && said.contains("prepare"), "{said}");
}

#[test]
fn modes_up_to_a_frequency_are_counted_by_the_theory_that_solves_them() {
    let bat = Bat::from_file(format!("{MESHES}/r161.json")).unwrap();
    for limit in [100.0, 600.0, 2000.0, 5000.0] {
        let modes = modes_up_to(&bat, &Request::default(), limit).unwrap();
        let more = Request { modes: modes + 1, ..Request::default() };
        let solution = solve(&bat, &more).unwrap();
        let below = solution.modes.iter().filter(|mode| mode.frequency() <= limit).count();
        assert_eq!(below, modes, "{limit} Hz");
    }
}

#[test]
fn the_numbers_of_the_library_page_are_those_of_the_program() {
    let page = concat!(env!("SWEETSPOT_TOP"), "/docs/library.md");
    let page = fs::read_to_string(page).unwrap();
    let (folder, _) = bats();
    let said = printed(&folder, &["modes", "r161.json", "-n", "5", "--tol", "1e-8", "--json", "-"]);
    for mode in said["modes"].as_array().unwrap() {
        let line = format!("    {:.3} Hz within ", mode["frequency_hz"].as_f64().unwrap());
        assert!(page.contains(&line), "docs/library.md has no line {line:?}");
    }
    let tapped =
        printed(&folder, &["modes", "tapped.json", "-n", "1", "--tol", "1e-8", "--json", "-"]);
    let line = format!("{:.2} Hz", tapped["modes"][0]["frequency_hz"].as_f64().unwrap());
    assert!(page.contains(&line), "docs/library.md does not say {line}");
}

/// A hit in one call equals that of the program: the same theory, the wall of a hollow barrel, the same best place.
#[test]
fn a_hit_in_one_call_is_that_of_the_program() {
    let folder = Folder::new("library-hit");
    for name in ["r161", "bbcor_made_up"] {
        let hit = Hit::of(&Bat::builtin(name).unwrap(), &Swing::default()).unwrap();
        let told: Value =
            serde_json::from_str(&folder.text(&["hit", name, "--json", "-", "--quiet"])).unwrap();
        let best = &told["sweet_spot"]["exit_speed_max"];
        let off = (best["value"].as_f64().unwrap() - hit.best.exit_speed).abs();
        assert!(off <= 2.0 * hit.best.error, "{name} {off} {}", hit.best.error);
        assert!((best["x_m"].as_f64().unwrap() - hit.best.x).abs() < 1e-3, "{name}");
        assert_eq!(hit.swing.scene.wall_gives_way(), name != "r161");
        assert_eq!((hit.reached, hit.warning.is_none()), (Reached::Asked, true));
        let again = &hit.at(&[hit.best.x]).unwrap()[0];
        assert_eq!(again, &hit.best.impact);
        assert!(hit.modes().iter().all(|mode| mode.frequency() > 0.0));
    }
    // With exactly two modes there is no claim that they suffice.
    let few = Accuracy { modes: Some(2), ..Accuracy::default() };
    let swing = Swing { accuracy: few, ..Swing::default() };
    let hit = Hit::of(&Bat::builtin("r161").unwrap(), &swing).unwrap();
    assert_eq!(hit.modes().len(), 2);
    let error = Bat::builtin("r116").unwrap_err().to_string();
    assert!(error.contains("r161") && error.contains("torpedo"), "{error}");
}
