//! Many bats hit at once have the same results as each alone.

use sweetspot::bat::fixtures::Attachment;
use sweetspot::collision::batch::{Blow, each};
use sweetspot::collision::sweep::{Accuracy, Sweep, Trial, sweep};
use sweetspot::collision::{Model, Scene};
use sweetspot::modes::batch::{Way, solutions};
use sweetspot::{Bat, Request, Theory, solve};
use sweetspot_proof::bundled::bundled_bat;

const WAYS: [Way; 2] = [Way::OneByOne, Way::SideBySide];

/// Solid wood, bare and with a weight on the knob (kg), and a bore.
const BATS: [(&str, f64); 3] = [
    ("meshes/r161.json", 0.0),
    ("meshes/r161.json", 0.03),
    ("meshes/northwestern_aluminium.json", 0.0),
];

/// Variations of a bat with different woods, on request with a weight on the knob (kg).
fn varied(name: &str, count: usize, weight: f64) -> Vec<Bat> {
    let own = bundled_bat(name).unwrap();
    let bat = |k: usize| {
        let share = |step: usize| (k * step % 17) as f64 / 17.0;
        let bat = own.with(|parts| {
            parts.material.density *= 0.95 + 0.1 * share(3);
            parts.material.youngs_modulus *= 0.9 + 0.2 * share(5);
            let knob = Attachment { mass: weight * (1.0 + share(7)), ..Attachment::default() };
            parts.fixtures.attachments.extend((weight > 0.0).then_some(knob));
        });
        bat.unwrap()
    };
    (0..count).map(bat).collect()
}

/// A sweep as text, to its last bit, without the time it took.
fn text(sweep: &Sweep) -> String {
    let mut sweep = sweep.clone();
    sweep.solution.timing = Default::default();
    format!("{sweep:?}")
}

/// The results of all bats, in order.
fn hits(model: &Bat, bats: &[Bat], theory: Theory, way: Way) -> Vec<Sweep> {
    let scene = Scene::default();
    let trial = Trial { model: Model::Contact, scene: &scene };
    let accuracy = Accuracy { theory, ..Accuracy::default() };
    let places: Vec<[f64; 3]> =
        bats.iter().map(|b| [0.7, 0.8, 0.9].map(|s| s * b.length())).collect();
    let blow = |(bat, places)| Blow { bat, trial, accuracy, places };
    let blows: Vec<Blow> = bats.iter().zip(places.iter().map(|p| &p[..])).map(blow).collect();
    let mut all: Vec<Option<Sweep>> = vec![None; bats.len()];
    each(model, &blows, way, |k, sweep| all[k] = Some(sweep.unwrap()));
    all.into_iter().map(|sweep| sweep.unwrap()).collect()
}

/// Solid wood, a weighted knob, a bore: the results are the same to the last bit one by one or side by side in any
/// company, and agree with those of each bat alone within both stated errors.
#[test]
fn a_bat_is_hit_as_it_is_hit_alone_whoever_is_beside_it() {
    for (name, weight) in BATS {
        for theory in Theory::ALL {
            let bats = varied(name, 10, weight);
            let alone = hits(&bats[0], &bats, theory, Way::OneByOne);
            let mut turned = bats.clone();
            turned[1..].reverse();
            let mut again = hits(&bats[0], &turned, theory, Way::SideBySide);
            again[1..].reverse();
            let together = hits(&bats[0], &bats, theory, Way::SideBySide);
            for (k, bat) in bats.iter().enumerate() {
                let what = format!("{name} {weight} {theory:?} {k}");
                assert_eq!(text(&alone[k]), text(&together[k]), "{what}");
                assert_eq!(text(&again[k]), text(&together[k]), "{what}");
                assert!(together[k].met(), "{what}");
                if k % 4 > 0 {
                    continue;
                }
                let accuracy = Accuracy { theory, exit_speed: 1e-6, ..Accuracy::default() };
                let places = [0.7, 0.8, 0.9].map(|s| s * bat.length());
                let scene = Scene::default();
                let fine = sweep(bat, Model::Contact, &scene, &accuracy, &places).unwrap();
                for (one, fine) in together[k].impacts.iter().zip(&fine.impacts) {
                    let closing = one.bat_speed + scene.ball_speed;
                    let (one, fine) =
                        (one.outcome.as_ref().unwrap(), fine.outcome.as_ref().unwrap());
                    let off = (one.exit_speed - fine.exit_speed).abs() / closing;
                    assert!(off <= one.error + fine.error, "{what}: {off:e} {:e}", one.error);
                }
            }
        }
    }
}

/// Bats without a common plan are hit as if there were no others.
#[test]
fn a_bat_of_another_kind_is_hit_on_its_own() {
    let kinds =
        ["r161", "tanh", "two_piece", "corked", "northwestern_aluminium", "composite_made_up"];
    let bats: Vec<Bat> =
        kinds.iter().map(|kind| bundled_bat(&format!("meshes/{kind}.json")).unwrap()).collect();
    let model = bundled_bat("meshes/torpedo.json").unwrap();
    for way in WAYS {
        for (k, found) in hits(&model, &bats, Theory::EulerBernoulli, way).iter().enumerate() {
            let places = [0.7, 0.8, 0.9].map(|s| s * bats[k].length());
            let (scene, accuracy) = (Scene::default(), Accuracy::plain());
            let alone = sweep(&bats[k], Model::Contact, &scene, &accuracy, &places).unwrap();
            assert_eq!(text(found), text(&alone), "{way:?} {}", kinds[k]);
        }
    }
}

/// Every number of a solution agrees with a far more accurate one within its stated error.
#[test]
fn solutions_of_many_are_as_good_as_they_say() {
    for (name, weight) in BATS {
        for theory in Theory::ALL {
            for tolerance in [1e-4, 1e-8] {
                let bats = varied(name, 9, weight);
                let request = Request { modes: 10, tolerance, theory, ..Request::default() };
                let asked: Vec<(&Bat, Request)> = bats.iter().map(|bat| (bat, request)).collect();
                solutions(&bats[0], &asked, Way::SideBySide, |k, found| {
                    let found = found.unwrap();
                    assert!(found.met());
                    // The time of a bat that shares a plan is not measured.
                    assert!(found.timing.solve.is_zero(), "{name} {k} was solved on its own");
                    if k % 4 > 0 {
                        return;
                    }
                    let fine = Request { tolerance: 1e-11, ..request };
                    let fine = solve(&bats[k], &fine).unwrap();
                    for (one, fine) in found.modes.iter().zip(&fine.modes) {
                        let what = format!("{name} {weight} {theory:?} {tolerance} {}", one.order);
                        let (own, its) = (one.error, fine.error);
                        let within = |off: f64, stated: f64| {
                            // The factor by which every estimate may be exceeded.
                            assert!(off.abs() <= 3.0 * stated, "{what}: {off:e} beside {stated:e}");
                        };
                        within(one.omega / fine.omega - 1.0, own.total() + its.total());
                        within(
                            one.modal_mass / fine.modal_mass - 1.0,
                            own.modal_mass + its.modal_mass,
                        );
                        assert_eq!(one.nodes.len(), fine.nodes.len(), "{what}");
                        for (a, b) in one.nodes.iter().zip(&fine.nodes) {
                            within(a - b, own.nodes + its.nodes);
                        }
                        for k in 0..=50 {
                            let x = bats[0].length() * f64::from(k) / 50.0;
                            let off = one.shape.deflection(x) - fine.shape.deflection(x);
                            within(off, own.shape + its.shape);
                        }
                    }
                });
            }
        }
    }
}

/// An impossible accuracy is an error for its bat only, and the others are hit.
#[test]
fn what_cannot_be_asked_is_told_of_each_bat_that_it_was_asked_of() {
    let bat = bundled_bat("meshes/r161.json").unwrap();
    let scene = Scene::default();
    let trial = Trial { model: Model::Contact, scene: &scene };
    let blow = |exit_speed: f64| {
        let accuracy = Accuracy { exit_speed, ..Accuracy::plain() };
        Blow { bat: &bat, trial, accuracy, places: &[0.7] }
    };
    let mut told = vec![];
    each(&bat, &[blow(f64::NAN), blow(1e-4), blow(f64::NAN)], Way::SideBySide, |k, hits| {
        told.push((k, hits.map(|_| ()).map_err(|error| error.to_string())));
    });
    told.sort_by_key(|(k, _)| *k);
    assert_eq!(told.len(), 3);
    assert!(told[1].1.is_ok());
    for k in [0, 2] {
        let said = told[k].1.as_ref().unwrap_err();
        assert!(said.contains("tolerance: found NaN"), "{said}");
    }
}
