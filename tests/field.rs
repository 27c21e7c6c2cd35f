//! Facts of the field: statements of laboratories, broadcasts and makers about bats and balls.

use crate::common;

use std::f64::consts::TAU;

use common::folder::Folder;
use serde_json::{Value, json};
use sweetspot::base::telling::nobody;
use sweetspot::base::units::miles_per_hour;
use sweetspot::bat::body::STANDARD_PIVOT;
use sweetspot::bat::theory::Theory;
use sweetspot::collision::aftermath::Aftermath;
use sweetspot::collision::bbcor::{Protocol, Tested};
use sweetspot::collision::hit::{Effort, Model, Scene};
use sweetspot::collision::hitter::Hitter;
use sweetspot::collision::strength::{Limit, breaking_swing, nearest};
use sweetspot::collision::sweep::{Accuracy, Sweep, sweep};
use sweetspot::collision::{Ball, SweetSpot};
use sweetspot::{Bat, Request, solve};
use sweetspot_proof::bundled::bundled_bat;

fn accuracy() -> Accuracy {
    Accuracy { exit_speed: 1e-4, theory: Theory::Timoshenko, ..Accuracy::default() }
}

fn request(modes: usize) -> Request {
    Request { modes, tolerance: 1e-4, theory: Theory::Timoshenko, ..Request::default() }
}

fn tested(bat: &Bat) -> Tested {
    let protocol = Protocol::of(bat, Ball::baseball());
    protocol.test(bat, &accuracy(), &nobody).unwrap()
}

/// The corked bat of the project and the bat that it was before it was bored.
fn corked_and_solid() -> [Bat; 2] {
    let text = include_str!("../meshes/corked.json");
    let mut file: Value = serde_json::from_str(text).unwrap();
    let read = |file: &Value| Bat::from_text("c", &file.to_string(), "".as_ref()).unwrap();
    let corked = read(&file);
    file.as_object_mut().unwrap().remove("regions");
    file["profile"].as_object_mut().unwrap().remove("inner_diameter");
    [corked, read(&file)]
}

fn fastest(bat: &Bat, scene: &Scene) -> f64 {
    let hits: Sweep = sweep(bat, Model::Contact, scene, &accuracy(), &[0.7]).unwrap();
    let hitter = Hitter::new(Model::Contact, scene, bat, &hits.solution, hits.effort).unwrap();
    SweetSpot::find(&hitter).exit_speed_max.unwrap().value
}

/// The pivot acts only after the ball has left; 30.7 mph is an explicit integration with 84 slices.
#[test]
fn a_bat_on_the_laboratories_pivot_sends_the_ball_back_like_a_free_one() {
    let bat = bundled_bat("meshes/r161.json").unwrap();
    let pivoted = tested(&bat);
    let scene = Scene { swing: 0.0, ball_speed: pivoted.scene.ball_speed, ..Scene::default() };
    let places: Vec<f64> = pivoted.scan.places.iter().map(|place| place.x_m).collect();
    let free = sweep(&bat, Model::Contact, &scene, &accuracy(), &places).unwrap();
    let mut most = f64::NEG_INFINITY;
    for (held, free) in pivoted.scan.places.iter().zip(&free.impacts) {
        let held = held.exit_speed_m_s.unwrap();
        let free = free.outcome.as_ref().unwrap().exit_speed;
        assert!((held - free).abs() < 5e-4 * scene.ball_speed, "{held} {free}");
        most = most.max(held);
    }
    assert!((miles_per_hour(most) - 30.7).abs() < 0.1, "{most}");
}

/// `e_A (1 + r) + r` from the rebound and the inertia, and a wooden bat is below the limit.
#[test]
fn bbcor_follows_from_the_rebound_and_the_swing_weight() {
    let bat = bundled_bat("meshes/r161.json").unwrap();
    let tested = tested(&bat);
    let scan = &tested.scan;
    assert_eq!(scan.places.len(), 23);
    let inertia = bat.inertia().about(STANDARD_PIVOT);
    for place in &scan.places {
        let efficiency = place.exit_speed_m_s.unwrap() / scan.protocol.ball_speed_m_s;
        let arm = place.x_m - STANDARD_PIVOT;
        let r = scan.protocol.ball.mass_kg * arm * arm / inertia;
        let bbcor = efficiency * (1.0 + r) + r;
        assert!((place.bbcor.unwrap() - bbcor).abs() < 1e-12, "{}", place.x_m);
        // BESR is the ratio of the speeds after and before the hit with the bat moving at half the speed; BPF is BBCOR
        // divided by the restitution on a rigid wall.
        assert!((place.besr.unwrap() - (efficiency + 0.5)).abs() < 1e-12);
        let bpf = place.bpf.unwrap();
        assert!((bpf * scan.protocol.cor / bbcor - 1.0).abs() < 1e-12, "{bpf}");
        let speed = place.error.exit_speed_m_s.unwrap() / scan.protocol.ball_speed_m_s;
        assert!(place.error.bbcor.unwrap() >= speed);
    }
    let most = scan.largest.as_ref().unwrap().bbcor;
    assert!(most < 0.5 && most > 0.48, "{most}");
    assert_eq!(scan.within_limit, Some(true));
}

/// A measured swing weight is compared with that of the profile, whether given as such or by the period of a pendulum
/// about any pivot, `T = 2 pi sqrt(I/(m g d))`; a mismatch is reported.
#[test]
fn a_measured_swing_weight_is_held_to_the_profile() {
    let file: Value = serde_json::from_str(include_str!("../meshes/r161.json")).unwrap();
    let bat = bundled_bat("meshes/r161.json").unwrap();
    let own = bat.inertia();
    let swing = own.about(STANDARD_PIVOT);
    let weighed = |members: Value| {
        let mut file = file.clone();
        file["weighed"] = members;
        Bat::from_text("w", &file.to_string(), "".as_ref()).unwrap()
    };
    let period = |pivot: f64| {
        let arm = own.balance_point - pivot;
        TAU * (own.about(pivot) / (own.mass * 9.806_65 * arm.abs())).sqrt()
    };
    let mass = own.mass;
    for (members, off) in [
        (json!({ "mass": mass, "swing_weight": swing }), 1.0),
        (json!({ "mass": mass, "swing_weight": 1.1 * swing }), 1.1),
        (json!({ "mass": mass, "pendulum_period": period(STANDARD_PIVOT) }), 1.0),
        (json!({ "mass": mass, "pendulum_pivot": 0.02, "pendulum_period": period(0.02) }), 1.0),
        (json!({ "mass": mass, "pendulum_pivot": 0.8, "pendulum_period": period(0.8) }), 1.0),
    ] {
        let bat = weighed(members.clone());
        let found = bat.measured_swing_weight().unwrap();
        assert!((found / swing / off - 1.0).abs() < 1e-9, "{members}: {found} {swing}");
        assert_eq!(bat.swing_weight_off().is_some(), off != 1.0, "{members}");
    }
}

/// From a rigid wall a ball returns with its restitution. A stiff bat without recoil returns as much, and the supports
/// in its file have no effect.
#[test]
fn what_holds_the_bat_in_its_file_is_no_part_of_the_test() {
    let bat = bundled_bat("meshes/r161.json").unwrap();
    let text = include_str!("../meshes/r161.json");
    let mut file: Value = serde_json::from_str(text).unwrap();
    file["grip"] = serde_json::json!({ "from": 0.0, "to": 0.2, "stiffness": 1e5 });
    file["supports"] = serde_json::json!([{ "x": 0.3, "type": "clamped" }]);
    let held = Bat::from_text("h", &file.to_string(), "".as_ref()).unwrap();
    let [bare, held] = [&bat, &held].map(|bat| tested(bat).scan.largest.unwrap().bbcor);
    assert!((bare - held).abs() < 1e-4, "{bare} {held}");
}

/// With the same swing, and with a swing that grows as the fourth root of the decrease of the swing weight; at equal
/// BBCOR a lighter barrel returns less of the speed of the ball.
#[test]
fn a_corked_bat_loses_speed_at_equal_bbcor() {
    let [corked, solid] = corked_and_solid();
    let most = |bat| tested(bat).scan.largest.unwrap().bbcor;
    assert!((most(&corked) - most(&solid)).abs() < 2e-3);
    let inertia = |bat: &Bat| bat.inertia().about(STANDARD_PIVOT);
    let faster = (inertia(&solid) / inertia(&corked)).powf(0.25);
    assert!(faster > 1.01);
    let scene = Scene::default();
    let whole = fastest(&solid, &scene);
    for swing in [scene.swing, faster * scene.swing] {
        let bored = fastest(&corked, &Scene { swing, ..scene.clone() });
        assert!(bored < whole - 0.3, "{swing}: {bored} {whole}");
    }
}

/// From 30 to 50 % relative humidity: 2.8 ± 0.5 mph less, A. M. Nathan as quoted on
/// arizona.sbnation.com, 26 Feb 2011.
#[test]
fn a_humid_ball_leaves_slower_by_as_much_as_was_published() {
    let bat = bundled_bat("meshes/r161.json").unwrap();
    let speed = |ball: Ball| fastest(&bat, &Scene { cor: ball.cor, ball, ..Scene::default() });
    let less = miles_per_hour(speed(Ball::baseball()) - speed(Ball::humid_baseball()));
    assert!((less - 2.8).abs() < 0.5, "{less} mph");
}

/// Without modes the largest compression of the ball occurs where it holds all energy of the relative motion: for a
/// linear ball it is `u √(μ/k)`.
#[test]
fn the_largest_compression_of_a_linear_ball_on_a_stiff_bat_is_the_springs() {
    let bat = bundled_bat("meshes/r161.json").unwrap();
    let ball = Ball { cor: 1.0, ..Ball::softball() }.linear(1.2e6).unwrap();
    let scene = Scene { cor: 1.0, ball, ..Scene::default() };
    let request = request(0);
    let solution = solve(&bat, &request).unwrap();
    let effort = Effort { accuracy: 1e-8, completed: false, unsettled: false };
    let hitter = Hitter::new(Model::Contact, &scene, &bat, &solution, effort).unwrap();
    let impact = hitter.strike(0.65);
    let outcome = impact.outcome.unwrap();
    let closing = impact.bat_speed + scene.ball_speed;
    let mass = outcome.impulse / (2.0 * closing);
    let deepest = closing * (mass / 1.2e6).sqrt();
    let found = outcome.peak_compression.unwrap();
    assert!((found / deepest - 1.0).abs() < 1e-6, "{found} {deepest}");
    assert!((outcome.peak_force.unwrap() / (1.2e6 * found) - 1.0).abs() < 1e-6);
}

/// At the swing that is reported to reach the strength, the stress equals the strength.
#[test]
fn a_hit_at_the_breaking_swing_reaches_the_strength() {
    let bat = bundled_bat("meshes/r161.json").unwrap();
    let bat = bat.with(|parts| parts.material.strength = Some(300e6)).unwrap();
    let request = request(20);
    let solution = solve(&bat, &request).unwrap();
    let effort = Effort { completed: false, ..Effort::default() };
    let (scene, x, until) = (Scene::default(), 0.6, 0.02);
    let about = (x, until);
    let swing = breaking_swing(&bat, &solution, (&scene, effort), about, Limit::Stress).unwrap();
    assert!(swing > 5.0 && swing < 50.0, "{swing}");
    let scene = Scene { swing, ..scene };
    let hitter = Hitter::new(Model::Contact, &scene, &bat, &solution, effort).unwrap();
    let after = Aftermath::new(&bat, &solution, x, hitter.force(x).unwrap());
    let places: Vec<f64> = (0..=400).map(|k| bat.length() * f64::from(k) / 400.0).collect();
    let times: Vec<f64> = (0..=4000).map(|k| until * f64::from(k) / 4000.0).collect();
    let envelope = after.envelope(&places, &after.at(&times), after.count());
    let load = nearest(&bat, &envelope, Limit::Stress).unwrap();
    assert!((load.share - 1.0).abs() < 0.01, "{swing} rad/s: {}", load.share);
    assert!((load.at.stress_pa / (load.share * 300e6) - 1.0).abs() < 1e-12);
    assert_eq!(nearest(&bat, &envelope, Limit::Strain), None);
}

const TUBE: &str = r#"{ "format": "sweetspot-bat/1", "name": "tube", "material": "aluminium-7075",
    "profile": { "x": [0, 0.3, 0.55, 0.84], "diameter": [0.024, 0.024, 0.066, 0.066],
                 "wall_thickness": [0.004, 0.004, 0.003, 0.003] } }"#;

/// Every result for a hollow barrel with a wall taken as rigid says so, and no other result does.
#[test]
fn a_hollow_barrel_says_at_every_result_what_its_wall_is_not() {
    let folder = Folder::new("hollow");
    folder.write("tube.json", TUBE);
    let told = "the wall of this hollow barrel (3.0 mm";
    let flat = |text: String| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let commands: [&[&str]; 5] = [
        &["hit", "tube.json", "--points", "3"],
        &["analyze", "tube.json", "--full", "--report", "tube.html"],
        &["bbcor", "tube.json"],
        &["compare", "tube.json", "tube.json", "--full"],
        &["ring", "tube.json", "--hit", "0.7"],
    ];
    for command in commands {
        assert!(!flat(folder.text(command)).contains(told), "{command:?}");
        let rigid = [command, &["--wall", "off"]].concat();
        let text = flat(folder.text(&rigid));
        assert!(text.contains(told), "{command:?}: {text}");
        let json = folder.text(&[&rigid[..], &["--json", "-"]].concat());
        assert!(json.contains(told), "{command:?}: no member says it");
    }
    let modes = folder.text(&["modes", "tube.json", "--json", "-"]);
    assert!(modes.contains("hoop modes of this hollow barrel"));
    assert!(flat(folder.read("tube.html")).contains("wall of this hollow barrel (3.0 mm"));
    let given = ["hit", "tube.json", "--points", "3", "--wall-stiffness", "5e6"];
    assert!(!flat(folder.text(&given)).contains(told));
}

#[test]
fn the_bbcor_verb_writes_what_it_prints() {
    let folder = Folder::new("bbcor");
    folder.write("r161.json", include_str!("../meshes/r161.json"));
    let text = folder.text(&["bbcor", "r161.json", "--csv", "b.csv", "--plots", "p"]);
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(text.contains("computed, not certified") && text.contains("limit of 0.50"), "{text}");
    let json = folder.text(&["bbcor", "r161.json", "--json", "-"]);
    let document: Value = serde_json::from_str(&json).unwrap();
    assert_eq!(document["format"], "sweetspot-bbcor/1");
    assert_eq!(document["certified"], false);
    let places = document["places"].as_array().unwrap();
    let most = places.iter().map(|p| p["bbcor"].as_f64().unwrap()).fold(0.0, f64::max);
    assert_eq!(document["largest"]["bbcor"], most);
    assert!(places.iter().all(|p| p["error"]["bbcor"].as_f64().unwrap() > 0.0));
    assert_eq!(folder.read("b.csv").lines().count(), places.len() + 1);
    assert!(folder.read("p/bbcor.svg").contains("BBCOR"));
}
