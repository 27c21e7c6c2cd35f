//! The least changes of a bat that meet a wish: the numbers of three tasks, found first by an independent
//! prototype.
#![cfg(feature = "aim")]

use std::path::Path;

use sweetspot::base::units::{inches, ounce_square_inches, ounces};
use sweetspot::bat::theory::Theory;
use sweetspot::collision::hit::{Model, Scene};
use sweetspot::study::aim::bench::{Bench, Terms};
use sweetspot::study::aim::limits::Limits;
use sweetspot::study::aim::search::{Search, Weights};
use sweetspot::study::aim::wish::{Amount, Ask, DiameterLimit, Goal, Target, Wish};
use sweetspot::study::lathe::workpiece::HitTerms;
use sweetspot::study::many::answers::Answer;
use sweetspot::{Bat, Request};

const OZ_IN2: f64 = 0.028_349_523_125 * 0.0254 * 0.0254;
const INCH: f64 = 0.0254;

fn r161() -> Bat {
    Bat::from_file(Path::new(env!("CARGO_MANIFEST_DIR")).join("meshes/r161.json")).unwrap()
}

/// 50 rad/s about a point 2.5 in beyond the knob, 90 mph.
fn terms() -> Terms {
    let scene =
        Scene { swing: 50.0, pivot: 0.0635, ball_speed: 40.2336, ..Scene::default() };
    let request = Request { theory: Theory::Timoshenko, tolerance: 1e-4, ..Request::default() };
    Terms { request, hit: HitTerms { scene, model: Model::Contact, exactly: false }, law: None }
}

fn target(answer: Answer, ask: Ask) -> Target {
    Target { goal: Goal::Answer(answer), ask }
}

fn within(amount: f64) -> Option<Amount> {
    Some(Amount::Si(amount))
}

fn least(mm: f64) -> DiameterLimit {
    DiameterLimit { from: 0.0, to: f64::INFINITY, at_least: Some(1e-3 * mm), at_most: None }
}

fn task_a() -> Wish {
    let targets = vec![
        target(Answer::Inertia, Ask::Change(Amount::Share(-0.03), within(5.0 * OZ_IN2))),
        target(Answer::Frequency(1), Ask::Change(Amount::Si(0.0), within(0.25))),
        target(Answer::ExitSpeedPlace, Ask::Change(Amount::Si(0.0), within(0.02 * INCH))),
    ];
    Wish { targets, remove_only: true, diameter: vec![least(24.0)], ..Wish::default() }
}

#[test]
fn scratch() {
    let bat = r161();
    let wish = task_a();
    let begun = std::time::Instant::now();
    let bench = Bench::new(&bat, &wish, terms()).unwrap();
    let start = bench.look(&vec![0.0; bench.unknowns()]).unwrap().values;
    println!("{start:?} {:?}", begun.elapsed());
    let bands = wish.bands(&start, &bat).unwrap();
    let limits = Limits::new(&wish, &bat);
    let search = Search::new(&bench, &limits);
    let found = search.from(&vec![0.0; bench.unknowns()], &bands, &Weights::met(bands.len())).unwrap();
    println!("{:?}", begun.elapsed());
    println!("{:?} {} {} {:?}", found.values, found.iterations, found.bats, found.stopped);
    println!("I {} f {} tip {} norm {}", ounce_square_inches(found.values[0]), found.values[1],
        inches(bat.length() - found.values[2]), search.norm(&found.p));
    println!("mass {}", ounces(bench.changed(&found.p).unwrap().inertia().mass));
    println!("{:?} {:?}", found.p, found.prices);
}
