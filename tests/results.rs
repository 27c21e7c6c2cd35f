//! The results for users of the library can be printed, written as JSON and sent to other threads.

use std::fmt::Debug;

use serde::Serialize;
use sweetspot::bat::inertia::Inertia;
use sweetspot::collision::bbcor::Scan;
use sweetspot::collision::figures::Figures;
use sweetspot::collision::sweep::{Accuracy, sweep};
use sweetspot::collision::{Hitter, Impact, Model, Outcome, Scene, Sweep, SweetSpot};
use sweetspot::modes::damping::Damping;
use sweetspot::motion::frf::{Frf, Sample};
use sweetspot::motion::ringing::Ringing;
use sweetspot::{Bat, Error, Mode, Request, Solution, solve};
use sweetspot_proof::bundled::bundled_bat;

fn is_a_result<T: Debug + Serialize + Send + Sync>() {}
fn goes_to_other_threads<T: Send + Sync>() {}

#[test]
fn results_are_printed_written_and_shared() {
    is_a_result::<sweetspot_study::spread::Spread>();
    is_a_result::<sweetspot_study::spread::Readings>();
    is_a_result::<Inertia>();
    is_a_result::<Solution>();
    is_a_result::<Mode>();
    is_a_result::<Damping>();
    is_a_result::<Sample>();
    is_a_result::<Sweep>();
    is_a_result::<Impact>();
    is_a_result::<Outcome>();
    is_a_result::<SweetSpot>();
    is_a_result::<Figures>();
    is_a_result::<Scan>();
    goes_to_other_threads::<Bat>();
    goes_to_other_threads::<Scene>();
    goes_to_other_threads::<Error>();
    goes_to_other_threads::<Frf>();
    goes_to_other_threads::<Ringing>();
    goes_to_other_threads::<Hitter>();
}

#[test]
fn a_solution_and_a_hit_as_json_say_what_their_fields_say() {
    let bat = bundled_bat("meshes/r161.json").unwrap();
    let solution = solve(&bat, &Request { modes: 2, ..Request::plain() }).unwrap();
    let json = serde_json::to_value(&solution).unwrap();
    assert_eq!(json["theory"], solution.theory.name());
    assert_eq!(json["modes"][1]["omega"], solution.modes[1].omega);
    assert_eq!(json["ending"], "Reached");
    let scene = Scene { swing: 45.0, ball_speed: 38.0, ..Scene::default() };
    let accuracy = Accuracy { exit_speed: 1e-3, ..Accuracy::plain() };
    let hits = sweep(&bat, Model::Contact, &scene, &accuracy, &[0.7]).unwrap();
    let json = serde_json::to_value(&hits).unwrap();
    let outcome = hits.impacts[0].outcome.as_ref().unwrap();
    assert_eq!(json["impacts"][0]["outcome"]["exit_speed"], outcome.exit_speed);
}
