//! The least changes of a bat that meet a wish: the numbers of three tasks, found first by an independent
//! prototype.
#![cfg(feature = "aim")]

use std::path::Path;

use sweetspot::base::units::{inches, ounce_square_inches, ounces};
use sweetspot::bat::theory::Theory;
use sweetspot::collision::hit::{Model, Scene};
use sweetspot::study::aim::bench::Terms;
use sweetspot::study::aim::outcome::Outcome;
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

fn task_c() -> Wish {
    let node = Ask::Value(Amount::FromTip(6.5 * INCH), within(0.01 * INCH));
    let targets = vec![
        target(Answer::Frequency(1), Ask::Value(Amount::Si(180.0), within(0.05))),
        target(Answer::Node(1), node),
        target(Answer::Mass, Ask::Between(None, Some(Amount::Si(31.0 * 0.028_349_523_125)))),
        target(Answer::Inertia, Ask::Between(None, Some(Amount::Share(1.0)))),
    ];
    let limit = DiameterLimit { at_most: Some(0.066_294), ..least(24.0) };
    Wish { targets, diameter: vec![limit], ..Wish::default() }
}

fn task_e() -> Wish {
    let lighter = Amount::Si((30.652_8 - 4.0) * 0.028_349_523_125);
    let targets = vec![
        target(Answer::Mass, Ask::Between(None, Some(lighter))),
        target(Answer::Inertia, Ask::Between(Some(Amount::Share(0.995)), None)),
        target(Answer::Frequency(1), Ask::Change(Amount::Si(0.0), within(1.0))),
    ];
    Wish { targets, remove_only: true, diameter: vec![least(24.0)], ..Wish::default() }
}

#[test]
fn scratch() {
    let bat = r161();
    for wish in [task_a(), task_c(), task_e()] {
        let begun = std::time::Instant::now();
        let o = Outcome::of(&bat, &wish, &terms()).unwrap();
        println!("{:?} met {} norm {} largest {:?} it {} bats {} stopped {:?} broken {} kept {}", begun.elapsed(), o.met, o.norm, o.largest(), o.iterations, o.bats, o.stopped, o.broken, o.kept_within);
        println!("values {:?}\nprices {:?}\nconflict {:?}", o.values, o.prices, o.conflict);
        for b in o.bands.iter().zip(&o.values) { println!("{:?} miss {}", b, b.0.miss(*b.1)); }
        println!("oz {} ozin2 {} sweet {:?}", ounces(o.bat.inertia().mass), ounce_square_inches(o.bat.inertia().about(0.1524)), o.answers[9].1.map(|x| inches(bat.length()-x.unwrap())));
        if let Some(c) = &o.conflict { for m in &c.members { println!("{} oz {} ozin2 {}", m.band, ounces(m.value), ounce_square_inches(m.value)); } }
        for s in &o.stations { print!("[{:.1} {:.4} {:.4} {:.7}] ", 1e3*s.x, 1e3*s.old, 1e3*s.exact, 1e3*s.new); }
        println!();
    }
}
