//! Sweet spots and standard figures: identities.

use sweetspot::base::units::miles_per_hour;
use sweetspot::bat::theory::Theory;
use sweetspot::collision::figures::{BarrelSpeed, Figures, SwingLaw};
use sweetspot::collision::hit::{Effort, Model, Scene};
use sweetspot::collision::hitter::Hitter;
use sweetspot::collision::sweet_spot::SweetSpot;
use sweetspot::{Bat, Request, Solution, solve};
use sweetspot_proof::bundled::bundled_bat;

const STANDARD_PIVOT: f64 = 0.1524;

fn r161() -> (Bat, Solution) {
    let bat = bundled_bat("meshes/r161.json").unwrap();
    let request =
        Request { modes: 15, tolerance: 1e-8, theory: Theory::Timoshenko, ..Request::default() };
    let solution = solve(&bat, &request).unwrap();
    (bat, solution)
}

/// A stiff bat turns about the hands where it is hit at the centre of percussion that belongs to
/// them: `(a − c)(c − x) = I/M`.
#[test]
fn stiff_hands_feel_nothing_at_their_centre_of_percussion() {
    let (bat, solution) = r161();
    let body = bat.inertia();
    for hands in [0.1, STANDARD_PIVOT, 0.2] {
        let scene = Scene { hands, ..Scene::default() };
        let effort = Effort::default();
        let hitter = Hitter::new(Model::Rigid, &scene, &bat, &solution, effort).unwrap();
        let spot = SweetSpot::find(&hitter);
        let least = spot.hands_velocity_min.unwrap();
        let exact =
            body.balance_point + body.about_balance / (body.mass * (body.balance_point - hands));
        // Located within 1e-6 of the outer half by golden section of a kink.
        assert!((least.x - exact).abs() < 1e-5, "{hands} {} {exact}", least.x);
        assert!(spot.hands_acceleration_min.is_none() && spot.vibration_min.is_none());
    }
}

/// Each definition is the best of its kind along the outer half, and the zone ends 1 % below.
#[test]
fn sweet_spots_are_the_best_of_their_kind() {
    let (bat, solution) = r161();
    let scene = Scene::default();
    let hitter = Hitter::new(Model::Contact, &scene, &bat, &solution, Effort::default()).unwrap();
    let spot = SweetSpot::find(&hitter);
    let fastest = spot.exit_speed_max.unwrap();
    for k in 0..=200 {
        let x = bat.length() * (0.5 + 0.0025 * f64::from(k));
        let Some(glance) = hitter.glance(x) else { continue };
        assert!(glance.exit_speed <= fastest.value);
        assert!(glance.vibration.unwrap() >= spot.vibration_min.unwrap().value);
        assert!(glance.hands[0] >= spot.hands_velocity_min.unwrap().value);
        assert!(glance.hands[1] >= spot.hands_acceleration_min.unwrap().value);
    }
    for end in spot.zone.unwrap() {
        let share = hitter.glance(end).unwrap().exit_speed / fastest.value;
        assert!((share - 0.99).abs() < 1e-6, "{share}");
    }
    for (off, x) in spot.inch_off.unwrap().into_iter().zip([-0.0254, 0.0254]) {
        let there = hitter.strike(fastest.x + x).outcome.unwrap().exit_speed;
        assert!((off.unwrap() - there).abs() < 1e-4 && there < fastest.value);
    }
}

/// With the exponent ½ every bat has the same energy of rotation, with 0 the same
/// angular speed; a bat with the swing weight of the reference is swung as fast as it by every law.
#[test]
fn swing_laws_keep_what_they_say() {
    let (bat, solution) = r161();
    let inertia = bat.inertia().about(STANDARD_PIVOT);
    for reference in [0.8 * inertia, inertia, 1.3 * inertia] {
        let law = SwingLaw { exponent: 0.25, reference, of_reference: 50.0 };
        let scene = Scene { swing: law.swing(&bat), ..Scene::default() };
        let effort = Effort::default();
        let hitter = Hitter::new(Model::Rigid, &scene, &bat, &solution, effort).unwrap();
        let figures = Figures::new(&bat, &hitter, Some(law)).unwrap();
        let [still, between, same] = &figures.swings[..] else { panic!("three laws") };
        assert_eq!((still.swing, between.swing), (50.0, scene.swing));
        let energy = |i: f64, swing: f64| 0.5 * i * swing * swing;
        assert!((energy(inertia, same.swing) / energy(reference, 50.0) - 1.0).abs() < 1e-12);
        assert!((between.swing / (50.0 * same.swing).sqrt() - 1.0).abs() < 1e-12);
        let best = |swung: &sweetspot::collision::figures::Swung| swung.best.unwrap().value;
        let searched = figures.spot.exit_speed_max.unwrap().value;
        assert!((best(between) / searched - 1.0).abs() < 1e-10);
        assert_eq!(best(same) > best(still), reference > inertia);
    }
}

/// The exit speed is that of a ball hit well by an average batter, and the fastest in play.
#[test]
fn the_default_swing_is_an_average_batters_and_its_ball_leaves_as_fast_as_his() {
    let ((bat, solution), scene) = (r161(), Scene::default());
    let barrel = BarrelSpeed::of(&bat, &scene, BarrelSpeed::BROADCAST);
    assert!((miles_per_hour(barrel.speed) - 71.5).abs() < 1.0, "{barrel:?}");
    assert!((barrel.swing(&bat, scene.pivot).unwrap() / scene.swing - 1.0).abs() < 1e-14);
    assert_eq!(barrel.swing(&bat, -bat.length()), None);
    let hitter = Hitter::new(Model::Contact, &scene, &bat, &solution, Effort::default()).unwrap();
    let best = SweetSpot::find(&hitter).exit_speed_max.unwrap();
    assert!((miles_per_hour(best.value) - 107.0).abs() < 1.0, "{best:?}");
}
