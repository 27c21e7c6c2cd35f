//! Hits on held bats, with balls whose restitution depends on the speed, and on compliant barrels.

use crate::common::of_factors;

use sweetspot::bat::fixtures::{Fixtures, Grip, Held, Support};
use sweetspot::bat::theory::Theory;
use sweetspot::collision::ball::Ball;
use sweetspot::collision::hit::{Effort, Model, Outcome, Scene, Wall};
use sweetspot::collision::hitter::Hitter;
use sweetspot::{Bat, Request, Solution, solve};
use sweetspot_proof::bundled::bundled_bat;

const FINE: Effort = Effort { accuracy: 1e-8, completed: true, unsettled: false };

fn solved(bat: &Bat) -> Solution {
    let request =
        Request { modes: 20, tolerance: 1e-9, theory: Theory::Timoshenko, ..Request::default() };
    solve(bat, &request).unwrap()
}

fn hit(bat: &Bat, model: Model, scene: &Scene, x: f64) -> Outcome {
    let solution = solved(bat);
    let hitter = Hitter::new(model, scene, bat, &solution, FINE).unwrap();
    hitter.strike(x).outcome.unwrap()
}

fn held(fixtures: Fixtures) -> Bat {
    let bat = bundled_bat("meshes/r161.json").unwrap();
    let weighed = sweetspot::bat::weighed::Weighed::default();
    Bat::builder(bat.profile().clone(), bat.material().clone())
        .name("held")
        .fixtures(fixtures)
        .weighed(weighed)
        .build()
        .unwrap()
}

fn pinned(x: f64) -> Bat {
    let pin = Support { x, kind: Held::Pinned };
    held(Fixtures { supports: vec![pin], ..Fixtures::default() })
}

/// A bat on a pin recoils according to its inertia about the pin, and a rigid one returns the ball with
/// `e_A = (e − r)/(1 + r)`, r = m Q²/I. BBCOR by the formula of the standard rig is then e₀.
#[test]
fn a_stiff_bat_on_a_pin_is_the_test_rig() {
    let bat = pinned(0.1524);
    let scene = Scene { swing: 0.0, ball_speed: 60.0, ..Scene::default() };
    let inertia = bat.inertia().about(0.1524);
    for x in [0.5, 0.65, 0.8] {
        let outcome = hit(&bat, Model::Rigid, &scene, x);
        let r = scene.ball.mass_kg * (x - 0.1524).powi(2) / inertia;
        let exact = (scene.cor - r) / (1.0 + r);
        assert!((outcome.collision_efficiency - exact).abs() < 1e-10, "{x}");
        assert!((outcome.bbcor_pivoted - scene.cor).abs() < 1e-10);
        assert!(outcome.energy.imbalance.abs() < 1e-9 * outcome.energy.initial);
    }
}

/// A hit at the barrel does not depend on how the handle is held until a wave has travelled there and back: on the
/// barrel the exit speeds of free, pinned and gripped bats are nearly the same (Nathan, Am. J. Phys. 68, 979, section
/// V), and energies close for all.
#[test]
fn the_ball_leaves_before_it_feels_the_hands() {
    let free = bundled_bat("meshes/r161.json").unwrap();
    let grip = Grip { from: 0.02, to: 0.18, stiffness: 1e5, damping: 30.0 };
    let gripped = held(Fixtures { grip: Some(grip), ..Fixtures::default() });
    // A grip so soft that the bat rotates in it at 1 Hz.
    let grip = Grip { from: 0.0, to: 0.1778, stiffness: 3e4, damping: 100.0 };
    let loose = held(Fixtures { grip: Some(grip), ..Fixtures::default() });
    let clamp = Support { x: 0.0, kind: Held::Clamped };
    let clamped = held(Fixtures { supports: vec![clamp], ..Fixtures::default() });
    for swing in [0.0, 50.0] {
        let scene = Scene { swing, ..Scene::default() };
        for x in [0.62, 0.7, 0.76] {
            let known = hit(&free, Model::Contact, &scene, x);
            for bat in [&pinned(0.1524), &gripped, &loose, &clamped] {
                let outcome = hit(bat, Model::Contact, &scene, x);
                let closing = swing * (scene.pivot + x) + scene.ball_speed;
                let apart = (outcome.exit_speed - known.exit_speed).abs() / closing;
                assert!(apart < 4e-3, "{swing} {x} {apart}");
                let energy = &outcome.energy;
                assert!(energy.imbalance.abs() < 1e-9 * energy.initial, "{swing} {x}");
            }
        }
    }
    // Near the hands they are not.
    let scene = Scene { swing: 0.0, ..Scene::default() };
    let near = [&free, &clamped].map(|bat| hit(bat, Model::Contact, &scene, 0.25).exit_speed);
    assert!((near[0] - near[1]).abs() > 0.5, "{near:?}");
}

/// Damping takes a little energy, and all of it is in the ledger.
#[test]
fn what_damping_takes_is_told() {
    let mut material = bundled_bat("meshes/r161.json").unwrap().material().clone();
    let r161 = bundled_bat("meshes/r161.json").unwrap();
    let profile = r161.profile();
    let mut before = 0.0;
    for loss_factor in [0.0, 0.01, 0.1] {
        material.loss_factor = loss_factor;
        let bat = Bat::builder(profile.clone(), material.clone()).name("lossy").build().unwrap();
        let energy = hit(&bat, Model::Contact, &Scene::default(), 0.6).energy;
        assert!(energy.imbalance.abs() < 1e-9 * energy.initial);
        assert!(energy.dissipated_damping > before || loss_factor == 0.0);
        before = energy.dissipated_damping;
    }
    assert!(before > 1.0, "{before}");
}

fn ball(text: &str) -> Ball {
    let folder = std::env::temp_dir().join(format!("sweetspot-balls-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join(format!("{}.json", text.len()));
    std::fs::write(&path, text).unwrap();
    let ball = Ball::from_file(&path).unwrap();
    std::fs::remove_dir_all(&folder).ok();
    ball
}

/// Official rules: a baseball weighs 5 to 5.25 oz and is 9 to 9.25 in around (MLB, 3.01), a 12 in
/// softball 6.25 to 7 oz and 11.875 to 12.125 in.
#[test]
fn balls_are_within_the_rules() {
    for (ball, ounces, inches) in [
        (Ball::baseball(), 5.0..=5.25, 9.0..=9.25),
        (Ball::softball(), 6.25..=7.0, 11.875..=12.125),
    ] {
        assert!(ounces.contains(&(ball.mass_kg / 0.028_349_523_125)), "{}", ball.name);
        let around = std::f64::consts::TAU * ball.radius_m / 0.0254;
        assert!(inches.contains(&around), "{}: {around}", ball.name);
    }
}

/// A bat as heavy as a wall returns the ball with the restitution of its file at that speed.
#[test]
fn a_ball_bounces_as_its_file_says_for_that_speed() {
    let ball = ball(
        r#"{ "format": "sweetspot-ball/1", "mass": "145 g", "radius": "36.6 mm",
            "stiffness": 6.53e7, "exponent": 1.84,
            "cor_by_speed": [["1 m/s", 0.66], ["58 m/s", 0.53], ["67 m/s", 0.5]] }"#,
    );
    assert_eq!(ball.cor, 0.5);
    for (speed, cor) in [(0.5, 0.66), (1.0, 0.66), (29.5, 0.595), (62.5, 0.515), (80.0, 0.5)] {
        assert!((ball.restitution_at(speed).unwrap() - cor).abs() < 1e-12, "{speed}");
    }
    // The same energy on a wall: u √(μ/m).
    let bat = bundled_bat("meshes/r161.json").unwrap();
    let scene = Scene { swing: 0.0, ball_speed: 40.0, ball, ..Scene::default() };
    let outcome = hit(&bat, Model::Rigid, &scene, 0.7);
    let body = bat.inertia();
    let arm = 0.7 - body.balance_point;
    let recoil = 1.0 / body.mass + arm * arm / body.about_balance;
    let wall = 40.0 / (1.0 + scene.ball.mass_kg * recoil).sqrt();
    let exact = 0.66 - 0.13 * (wall - 1.0) / 57.0;
    assert!((outcome.cor - exact).abs() < 1e-9, "{} {exact}", outcome.cor);
    assert!((outcome.bbcor - exact).abs() < 1e-9);
}

/// `m x″ + c x′ + k x = 0` until the force is zero, in small steps.
#[test]
fn a_linear_ball_returns_what_its_dashpot_leaves() {
    for ratio in [0.0, 0.1, 0.25, 0.6] {
        let text = format!(
            r#"{{ "format": "sweetspot-ball/1", "mass": "145.8 g", "radius": "36.6 mm",
                "stiffness": 3.3066e5, "damping_ratio": {ratio} }}"#
        );
        let ball = ball(&text);
        let (k, m) = (3.3066e5_f64, 0.1458);
        let c = 2.0 * ratio * (k * m).sqrt();
        let (mut x, mut v, h) = (0.0, 1.0, 1e-8);
        while x == 0.0 || k * x + c * v > 0.0 {
            let middle = [x + 0.5 * h * v, v - 0.5 * h * (k * x + c * v) / m];
            (x, v) = (x + h * middle[1], v - h * (k * middle[0] + c * middle[1]) / m);
        }
        assert!((ball.cor + v).abs() < 1e-4, "{ratio} {} {v}", ball.cor);
        assert_eq!(ball.exponent, Some(1.0));
    }
}

/// A wall that is almost rigid acts as a rigid one; without mass it is a spring in series; and as a trampoline, a soft
/// wall without loss returns more to the ball than a stiff one.
#[test]
fn a_wall_under_the_ball_is_a_trampoline() {
    let bat = bundled_bat("meshes/r161.json").unwrap();
    let with =
        |wall: Option<Wall>| hit(&bat, Model::Contact, &Scene { wall, ..Scene::default() }, 0.7);
    let none = with(None);
    let stiff = with(Some(Wall { stiffness: 1e13, mass: 0.0 }));
    assert!((stiff.exit_speed / none.exit_speed - 1.0).abs() < 1e-6);
    let light = with(Some(Wall { stiffness: 4e6, mass: 1e-5 }));
    let spring = with(Some(Wall { stiffness: 4e6, mass: 0.0 }));
    assert!((light.exit_speed / spring.exit_speed - 1.0).abs() < 1e-4);
    assert!(spring.exit_speed > none.exit_speed + 0.5);
    assert!(spring.energy.dissipated_ball < none.energy.dissipated_ball);
    let heavy = with(Some(Wall { stiffness: 4e6, mass: 0.05 }));
    for outcome in [&light, &spring, &heavy] {
        assert!(outcome.energy.imbalance.abs() < 1e-9 * outcome.energy.initial);
    }
    assert!(heavy.energy.wall > 0.1, "{}", heavy.energy.wall);
}

/// Hands and springs hardly act within a hit: a rigid bat held by them is like a free one, by the rigid model and, with
/// all moduli raised a millionfold, by ball and modes.
#[test]
fn a_stiff_bat_in_soft_hands_is_free() {
    let free = bundled_bat("meshes/r161.json").unwrap();
    let grip = Grip { from: 0.0, to: 0.1524, stiffness: 3e4, damping: 0.0 };
    let gripped = held(Fixtures { grip: Some(grip), ..Fixtures::default() });
    let stiff = of_factors(&gripped, [1.0, 1e6]);
    let scene = Scene::default();
    for x in [0.5, 0.65, 0.8] {
        let exit = |bat: &Bat, model| hit(bat, model, &scene, x).exit_speed;
        let known = exit(&free, Model::Rigid);
        assert!((exit(&gripped, Model::Rigid) / known - 1.0).abs() < 1e-12, "{x}");
        // The hands push for a millisecond of their second.
        assert!((exit(&stiff, Model::Contact) / known - 1.0).abs() < 1e-3, "{x}");
        let outcome = hit(&gripped, Model::Rigid, &scene, x);
        assert!(outcome.energy.imbalance.abs() < 1e-9 * outcome.energy.initial);
    }
}

/// A wall so light that its oscillation is far faster than the hit acts as a spring, and creates no energy.
#[test]
fn a_light_wall_makes_no_energy() {
    let bat = bundled_bat("meshes/r161.json").unwrap();
    let solution = solved(&bat);
    for mass in [1e-3, 1e-5, 1e-7, 1e-9, 1e-12] {
        for (cor, speed) in [(0.1, 1.0), (0.5, 1.0), (0.1, 60.0), (0.5, 60.0), (1.0, 60.0)] {
            let wall = Some(Wall { stiffness: 4e6, mass });
            let scene = Scene { wall, cor, swing: 0.0, ball_speed: speed, ..Scene::default() };
            let effort = Effort::default();
            let hitter = Hitter::new(Model::Contact, &scene, &bat, &solution, effort).unwrap();
            for x in [0.45, 0.6, 0.7, 0.8] {
                let impact = hitter.strike(x);
                // A hit whose energies do not balance is refused.
                let Some(outcome) = impact.outcome else {
                    assert_eq!(impact.flags, ["unresolved"]);
                    continue;
                };
                let energy = &outcome.energy;
                assert!(energy.imbalance.abs() < 1e-9 * energy.initial, "{mass:e} {cor} {x}");
                assert!(energy.vibration <= energy.initial && outcome.error.is_finite());
            }
        }
    }
}
