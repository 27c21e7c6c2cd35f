//! The hit on whole bats: the rigid limit, the energy ledger, and the dowel of the WPI report.

use sweetspot::bat::fixtures::{Held, Support};
use sweetspot::collision::ball::Ball;
use sweetspot::collision::energy_loss::EnergyLoss;
use sweetspot::collision::hit::{Effort, Model, Scene};
use sweetspot::collision::hitter::Hitter;
use sweetspot::collision::sweet_spot::SweetSpot;
use sweetspot::{Bat, Request, Solution, solve};
use sweetspot_proof::bundled::bundled_bat;

fn solved(path: &str) -> (Bat, Solution) {
    let bat = bundled_bat(path).unwrap();
    let solution = solve(&bat, &Request { tolerance: 1e-8, ..Request::plain() }).unwrap();
    (bat, solution)
}

/// The report's swing and pitch: a 5 oz ball at 90 mph, 2.5 in beyond the knob.
fn scene(swing: f64) -> Scene {
    let ball = Ball { mass_kg: 5.0 * 0.028_349_523_125, ..Ball::baseball() };
    Scene { pivot: 0.0635, swing, ball, ball_speed: 40.2336, cor: 0.5, ..Scene::default() }
}

fn empirical<'a>(scene: &'a Scene, bat: &'a Bat, solution: &'a Solution) -> Hitter<'a> {
    let model = Model::EnergyLoss(EnergyLoss::default());
    Hitter::new(model, scene, bat, solution, Effort::default()).unwrap()
}

/// Peaks of the report's rigid and empirical curves, recomputed from its script
/// (`validation/wpi/fig18_summary.csv`): X, v/v_in at 40, 50, 60 rad/s. The script sets the bat to
/// exactly six balls where the dowel weighs 5.9995, hence the tolerance.
#[test]
fn the_elements_reproduce_the_peaks_of_the_wpi_report() {
    let (bat, solution) = solved("meshes/dowel.json");
    for (swing, rigid, lossy) in [
        (40.0, (0.657_284, 0.986_856), (0.739_982, 0.869_115)),
        (50.0, (0.679_435, 1.176_975), (0.752_695, 1.068_140)),
        (60.0, (0.697_787, 1.369_975), (0.760_123, 1.266_819)),
    ] {
        let scene = scene(swing);
        let cases = [(Model::Rigid, rigid), (Model::EnergyLoss(EnergyLoss::default()), lossy)];
        for (model, (place, speed)) in cases {
            let hitter = Hitter::new(model, &scene, &bat, &solution, Effort::default()).unwrap();
            let peak = SweetSpot::find(&hitter).exit_speed_max.unwrap();
            assert!((peak.x / bat.length() - place).abs() < 1e-4, "{swing} {}", peak.x);
            let ratio = peak.value / scene.ball_speed;
            assert!((ratio / speed - 1.0).abs() < 2e-4, "{swing} {ratio} {speed}");
        }
    }
}

#[test]
fn a_rigid_hit_balances_its_energy_and_returns_the_coefficient_of_restitution() {
    let (bat, solution) = solved("meshes/r161.json");
    for cor in [0.0, 0.5, 1.0] {
        let scene = Scene { cor, ..scene(50.0) };
        let hitter = Hitter::new(Model::Rigid, &scene, &bat, &solution, Effort::default()).unwrap();
        for x in [0.0, 0.2, 0.5, 0.7, 0.84] {
            let outcome = hitter.strike(x).outcome.unwrap();
            let energy = &outcome.energy;
            assert!(energy.imbalance.abs() < 1e-12 * energy.initial, "{x}");
            assert!((outcome.bbcor - cor).abs() < 1e-12, "{x} {}", outcome.bbcor);
            if cor == 1.0 {
                assert_eq!(energy.dissipated_ball, 0.0);
            }
        }
    }
}

/// BBCOR of a bat that does not bend is the ball's restitution, also on a pin: by the effective mass of the bat as held.
#[test]
fn a_rigid_bat_on_a_pin_returns_the_coefficient_of_restitution() {
    let (bat, _) = solved("meshes/r161.json");
    for pin in [0.0, 0.1524, 0.3] {
        let support = Support { x: pin, kind: Held::Pinned };
        let held = bat.with(|parts| parts.fixtures.supports = vec![support]).unwrap();
        let solution = solve(&held, &Request::default()).unwrap();
        let (scene, effort) = (scene(50.0), Effort::default());
        let hitter = Hitter::new(Model::Rigid, &scene, &held, &solution, effort).unwrap();
        for x in [0.5, 0.7, 0.84] {
            let outcome = hitter.strike(x).outcome.unwrap();
            assert!((outcome.bbcor - outcome.cor).abs() < 1e-12, "{pin} {x} {}", outcome.bbcor);
        }
    }
}

#[test]
fn without_loss_or_at_its_nodes_the_empirical_model_is_the_rigid_one() {
    let (bat, solution) = solved("meshes/r161.json");
    let scene = scene(50.0);
    let none = Model::EnergyLoss(EnergyLoss { gamma: 0.0, decay: 2.0 });
    let hitter = Hitter::new(none, &scene, &bat, &solution, Effort::default()).unwrap();
    for x in [0.3, 0.6, 0.84] {
        let impact = hitter.strike(x);
        let (flexible, rigid) = (impact.outcome.unwrap().exit_speed, impact.rigid_exit_speed);
        assert!((flexible - rigid.unwrap()).abs() < 1e-12);
    }
    // With one mode, there is no loss at its node and some next to it.
    let request = Request { modes: 1, tolerance: 1e-8, ..Request::plain() };
    let one = solve(&bat, &request).unwrap();
    let node = one.modes[0].nodes[1];
    let hitter = empirical(&scene, &bat, &one);
    assert!(hitter.glance(node).unwrap().vibration.unwrap() < 1e-12);
    assert!(hitter.glance(node + 0.05).unwrap().vibration.unwrap() > 1.0);
}

/// The mode in the scaling of the report has `(1/M) ∫ρA W² dx = α²`. On the uniform dowel this is the raw shape, so the
/// modal energies are those of its closed form.
#[test]
fn modal_energies_on_the_dowel_are_those_of_the_raw_shapes() {
    let (bat, solution) = solved("meshes/dowel.json");
    let scene = scene(50.0);
    let hitter = empirical(&scene, &bat, &solution);
    for fraction in [0.55, 0.7, 0.95] {
        let outcome = hitter.strike(fraction * bat.length()).outcome.unwrap();
        for (n, energy) in (1..).zip(&outcome.energy.vibration_by_mode) {
            let shape = sweetspot::collision::energy_loss::wpi_shape(n, fraction);
            let share = 0.2 * shape * shape / ((2 * n + 1) as f64).powi(2);
            let expected = share * outcome.impulse.powi(2) / scene.ball.mass_kg;
            assert!((energy - expected).abs() < 1e-6 * outcome.energy.initial, "{fraction} {n}");
        }
    }
}

#[test]
fn a_ball_that_is_not_met_has_no_outcome() {
    let (bat, solution) = solved("meshes/dowel.json");
    let still = Scene { ball_speed: 0.0, ..scene(0.0) };
    let hitter = Hitter::new(Model::Rigid, &still, &bat, &solution, Effort::default()).unwrap();
    let impact = hitter.strike(0.6);
    assert!(impact.outcome.is_none() && impact.rigid_exit_speed.is_none());
    assert_eq!(impact.flags, ["no_contact"]);
    let spot = SweetSpot::find(&hitter);
    assert!(spot.exit_speed_max.is_none() && spot.zone.is_none() && spot.node_mode_1.is_some());
}

#[test]
fn the_sweet_spot_is_a_maximum_and_its_zone_ends_one_per_cent_below() {
    let (bat, solution) = solved("meshes/torpedo.json");
    let scene = scene(45.0);
    let hitter = empirical(&scene, &bat, &solution);
    let spot = SweetSpot::find(&hitter);
    let peak = spot.exit_speed_max.unwrap();
    let speed = |x: f64| hitter.glance(x).unwrap().exit_speed;
    assert!(speed(peak.x - 1e-4) < peak.value && speed(peak.x + 1e-4) < peak.value);
    for end in spot.zone.unwrap() {
        assert!((speed(end) / peak.value - 0.99).abs() < 1e-6, "{end}");
    }
    let still = spot.vibration_min.unwrap();
    let energy = |x: f64| hitter.glance(x).unwrap().vibration.unwrap();
    assert!(energy(still.x - 1e-4) >= still.value && energy(still.x + 1e-4) >= still.value);
}
