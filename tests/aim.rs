//! The smallest changes of a bat that meet a wish: the numbers of three tasks, first found by an independent prototype.

use crate::common;

use std::path::Path;

use common::folder::Folder;
use sweetspot::base::units::{inches, miles_per_hour, ounce_square_inches, ounces};
use sweetspot::bat::theory::Theory;
use sweetspot::collision::hit::{Model, Scene};
use sweetspot::{Bat, Material, Request};
use sweetspot_report::report::aimed;
use sweetspot_report::template::pages::pages;
use sweetspot_report::template::sheet::{Drawn, PAPERS, Page};
use sweetspot_study::aim::aimed::Outcome;
use sweetspot_study::aim::bench::Terms;
use sweetspot_study::aim::wish::{Amount, Ask, DiameterLimit, FreeChoice, Goal, Target, Wish};
use sweetspot_study::answers::Answer;
use sweetspot_study::lathe::workpiece::HitTerms;
use sweetspot_study::many::rows::{BatTrial, Questions};

const OZ_IN2: f64 = 0.028_349_523_125 * 0.0254 * 0.0254;
const INCH: f64 = 0.0254;

fn r161() -> Bat {
    Bat::from_file(Path::new(env!("SWEETSPOT_TOP")).join("meshes/r161.json")).unwrap()
}

/// 50 rad/s about a point 2.5 in beyond the knob, 90 mph.
fn terms() -> Terms {
    let scene = Scene { swing: 50.0, pivot: 0.0635, ball_speed: 40.2336, ..Scene::default() };
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

/// The bat of the written file, with its goals computed in another way: by the outputs of a study along the bat.
fn written(outcome: &Outcome, answers: &[Answer]) -> (Bat, Vec<f64>) {
    let text = aimed::bat_text(outcome);
    let bat = Bat::from_text("new.json", &text, Path::new("")).unwrap();
    let asked = Questions { answers: answers.to_vec(), tolerance: 1e-5 };
    let scene = terms().hit.scene;
    let trial = |_: usize, _: &Bat| Ok(BatTrial { scene: scene.clone(), model: Model::Contact });
    let found = Questions::of_each(&bat, vec![(&asked, Ok(bat.clone()))], trial).pop();
    let found = found.unwrap().unwrap();
    (bat, found.figures.into_iter().map(|figure| figure.unwrap().value).collect())
}

/// Smallest and largest difference between the diameters of two bats, and smallest and largest diameter (m), every 50
/// µm and at both sides of every border.
fn along(old: &Bat, new: &Bat) -> [f64; 4] {
    let mut places: Vec<f64> =
        (0..=16_800).map(|k| old.length() * f64::from(k) / 16_800.0).collect();
    let borders = [old, new].map(|bat| bat.profile().borders()).concat();
    places.extend(borders.iter().flat_map(|x| [x - 1e-13, *x, x + 1e-13]));
    let at = |bat: &Bat, x: f64| 2.0 * bat.profile().at(x.clamp(0.0, bat.length())).outer;
    let mut found = [f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY];
    for x in places {
        // Near a step the two may be read on different sides of it.
        let steps = [old, new].map(|bat| (at(bat, x - 1e-12) - at(bat, x + 1e-12)).abs() > 1e-6);
        let (more, across) = (at(new, x) - at(old, x), at(new, x));
        if !steps.contains(&true) {
            found[0] = found[0].min(more);
            found[1] = found[1].max(more);
        }
        found[2] = found[2].min(across);
        found[3] = found[3].max(across);
    }
    found
}

/// Task A: 3 % less swing weight with unchanged f1 and sweet spot, wood only removed.
#[test]
fn a_lighter_swing_is_turned_with_the_least_change_and_the_file_has_it() {
    let (bat, wish) = (r161(), task_a());
    let outcome = Outcome::of(&bat, &wish, &terms()).unwrap();
    assert!(outcome.met && outcome.conflict.is_none() && outcome.iterations <= 4, "{outcome:?}");
    assert!((outcome.norm_mm / 0.565 - 1.0).abs() < 0.1, "{}", outcome.norm_mm);
    assert!((1e3 * outcome.largest_cut_m - 1.19).abs() < 0.05);
    let answers =
        [Answer::Inertia, Answer::Frequency(1), Answer::ExitSpeedPlace, Answer::ExitSpeed];
    let (new, found) = written(&outcome, &answers);
    assert!((ounce_square_inches(found[0]) - 0.97 * 10_421.02).abs() <= 5.0, "{found:?}");
    assert!((found[1] - 174.508_54).abs() <= 0.25);
    assert!((inches(bat.length() - found[2]) - 5.279_3).abs() <= 0.02);
    assert!((ounces(new.inertia().mass) - 30.0).abs() < 0.02);
    // The best ball, at the same swing.
    let start = outcome.outputs.iter().find(|of| of.answer == Answer::ExitSpeed).unwrap();
    let lost = miles_per_hour(found[3] - start.start.unwrap());
    assert!((lost + 1.36).abs() < 0.02, "{lost}");
    let [_, added, least, _] = along(&bat, &new);
    assert!(added <= 1e-9 && least >= 0.024 - 1e-9, "{added:e} {least}");
    // The knob is unchanged along its whole curve.
    let kept = (0..600)
        .map(|k| 5e-5 * f64::from(k))
        .map(|x| new.profile().at(x).outer - bat.profile().at(x).outer);
    assert!(kept.fold(0.0, |a: f64, b| a.max(b.abs())) < 1e-9);
}

/// Task C: f1 up to 180 Hz, node 1 to 6.5 in from the tip, neither heavier than 31 oz nor slower to swing.
#[test]
fn a_stiffer_bat_grows_where_it_may() {
    let (bat, wish) = (r161(), task_c());
    let outcome = Outcome::of(&bat, &wish, &terms()).unwrap();
    assert!(outcome.met && outcome.iterations <= 4, "{outcome:?}");
    assert!((outcome.norm_mm / 0.389 - 1.0).abs() < 0.1, "{}", outcome.norm_mm);
    let answers = [Answer::Frequency(1), Answer::Node(1), Answer::Inertia, Answer::Frequency(2)];
    let (new, found) = written(&outcome, &answers);
    assert!((found[0] - 180.0).abs() <= 0.05, "{found:?}");
    assert!((inches(bat.length() - found[1]) - 6.5).abs() <= 0.01);
    assert!(ounce_square_inches(found[2]) <= 10_421.02 && ounces(new.inertia().mass) <= 31.0);
    let [.., least, most] = along(&bat, &new);
    assert!(least >= 0.024 - 1e-9 && most <= 0.066_294 + 1e-9, "{least} {most}");
    // There is no requirement on f2, which rounding to 0.1 mm changes by some tenths; with finer rounding it is that of
    // the prototype.
    let fine = Outcome::of(&bat, &Wish { round: Some(1e-5), ..wish }, &terms()).unwrap();
    let (_, found) = written(&fine, &answers);
    assert!((found[3] - 581.252 - 6.96).abs() < 0.02, "{found:?}");
}

/// Task E: 4 oz less and the same swing weight are incompatible by turning. The best mass is 0.003 oz above that of the
/// prototype, whose limits held at fewer places; the best swing weight is above its 9821.7 oz in².
#[test]
fn what_cannot_be_had_together_is_named_with_how_near_each_comes() {
    let (bat, wish) = (r161(), task_e());
    let outcome = Outcome::of(&bat, &wish, &terms()).unwrap();
    assert!(!outcome.met);
    let conflict = outcome.conflict.as_ref().unwrap();
    let members: Vec<usize> = conflict.members.iter().map(|member| member.target).collect();
    assert_eq!(members, [0, 1]);
    assert!(conflict.members.iter().all(|member| member.others_met), "{conflict:?}");
    let mass = ounces(conflict.members[0].reaches.unwrap());
    assert!((mass - 29.376).abs() < 0.005, "{mass}");
    let swing = ounce_square_inches(conflict.members[1].reaches.unwrap());
    assert!((9_821.7..10_000.0).contains(&swing), "{swing}");
    // The nearest bat is a bat, and keeps to the limits.
    let (new, _) = written(&outcome, &[Answer::Mass]);
    let [_, added, least, _] = along(&bat, &new);
    assert!(added <= 1e-9 && least >= 0.024 - 1e-9, "{added:e} {least}");
    let words = aimed::conflict_words(conflict, &outcome.targets, true);
    assert!(words.contains("cannot both be had") && words.contains("29.38 oz at best"), "{words}");
}

/// All targets are met but a rule is broken: this is no conflict, and the exit code is that of a missed target.
#[test]
fn a_broken_rule_is_not_met() {
    let folder = Folder::new("aim-rule");
    let rules = r#"{ "format": "sweetspot-rules/1", "name": "short", "game": "made up", "source": "made up",
        "date": "2026", "length_at_most": "30 in" }"#;
    folder.write("short.json", rules);
    let aimed = ["aim", "r161", "--target", "mass -2 %", "--remove-only"];
    let output = folder.run(&[&aimed[..], &["--rules", "short.json", "--json", "-"]].concat());
    assert_eq!(output.status.code(), Some(3), "{}", String::from_utf8_lossy(&output.stderr));
    let document: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!(document["conflict"].is_null() && document["met"] == false, "{document}");
    assert_eq!(folder.run(&aimed).status.code(), Some(0));
}

/// Two wishes that pull one way and a limit: both are met, though a first search misses one by a little.
#[test]
fn what_can_be_had_is_no_conflict() {
    let share = |by: f64| Ask::Change(Amount::Share(by), None);
    let targets = vec![
        target(Answer::Frequency(1), Ask::Change(Amount::Si(10.0), None)),
        target(Answer::Mass, share(-0.1)),
    ];
    let wish = Wish { targets, remove_only: true, diameter: vec![least(24.0)], ..Wish::default() };
    let outcome = Outcome::of(&r161(), &wish, &terms()).unwrap();
    assert!(outcome.met && outcome.conflict.is_none(), "{:?}", outcome.targets);
    // A tip turned to a cone has lost nearly all of its strength there.
    let (x, left) = outcome.weakest().unwrap();
    assert!(x > 0.8 && left < 0.15, "{x} {left}");
}

/// The price of a target is the derivative of the norm: tightening it slightly costs the stated amount.
#[test]
fn a_price_is_what_a_little_more_costs() {
    let bat = r161();
    let norm = |by: f64| {
        let ask = Ask::Between(None, Some(Amount::Si(by)));
        let wish = Wish { targets: vec![target(Answer::Inertia, ask)], ..Wish::default() };
        Outcome::of(&bat, &wish, &terms()).unwrap()
    };
    let (less, here, more) = (norm(0.1852), norm(0.185), norm(0.1848));
    let slope = (more.norm_mm - less.norm_mm) / 4e-4;
    let price = here.targets[0].price_mm.unwrap();
    assert!((price / slope - 1.0).abs() < 0.01, "{price} {slope}");
}

/// A variable density or a weight on the knob is used before the shape.
#[test]
fn free_choices_are_taken_before_the_shape() {
    let bat = r161();
    let lighter = target(Answer::Mass, Ask::Change(Amount::Share(-0.05), None));
    let of = |targets: Vec<Target>, free: FreeChoice| {
        Outcome::of(&bat, &Wish { targets, free, ..Wish::default() }, &terms()).unwrap()
    };
    let shape = of(vec![lighter], FreeChoice::default());
    let density = Some([600.0, 700.0]);
    let free = of(vec![lighter], FreeChoice { density, ..FreeChoice::default() });
    assert!(
        shape.met && free.met && free.norm_mm < 0.2 * shape.norm_mm,
        "{} {}",
        free.norm_mm,
        shape.norm_mm
    );
    assert!((free.free[0].found / 649.0 - 0.95).abs() < 0.01, "{:?}", free.free);
    let weight = FreeChoice { knob_weight: Some(0.06), ..FreeChoice::default() };
    let heavier = target(Answer::BalancePoint, Ask::Change(Amount::Si(-0.01), None));
    let knob = of(vec![heavier], weight);
    assert!(
        knob.met && knob.free[0].found > 0.005 && knob.norm_mm < 0.5,
        "{} {:?}",
        knob.norm_mm,
        knob.free
    );
    let length = FreeChoice { length: Some([0.8, 0.86]), ..FreeChoice::default() };
    let shorter = of(vec![target(Answer::Mass, Ask::Change(Amount::Share(-0.02), None))], length);
    assert!(shorter.met && shorter.bat.length() < 0.84, "{}", shorter.bat.length());
    let maple = Material::named("sugar-maple-dynamic").unwrap();
    let woods = FreeChoice { woods: vec![maple], ..FreeChoice::default() };
    let rings = target(Answer::Frequency(1), Ask::Change(Amount::Si(0.0), None));
    // The original bat already meets that, so no other wood is used.
    assert_eq!(of(vec![rings], woods).wood, None);
}

/// Pages of the template: together they hold the whole bat in full size.
#[test]
fn the_template_is_in_its_own_size() {
    let bat = r161();
    for paper in PAPERS {
        let pages = pages(&bat, &bat, paper);
        let widest = |page: &Page| {
            let lines = page.drawn.iter().filter_map(|drawn| match drawn {
                Drawn::Line { points, width, .. } if *width == 0.25 => Some(points),
                _ => None,
            });
            let all: Vec<[f64; 2]> = lines.flatten().copied().collect();
            let of = |k: usize| {
                let [low, high] = all
                    .iter()
                    .fold([f64::INFINITY, 0.0_f64], |[a, b], p| [a.min(p[k]), b.max(p[k])]);
                high - low
            };
            [of(0), of(1)]
        };
        let lengths: Vec<[f64; 2]> = pages.iter().map(widest).collect();
        let length: f64 = lengths.iter().map(|size| size[0]).sum();
        assert!((length - 840.0).abs() < 1e-9, "{length}");
        assert!((lengths.last().unwrap()[1] - 64.3).abs() < 1e-6, "{lengths:?}");
        let inside = |points: &[[f64; 2]]| {
            points
                .iter()
                .all(|[x, y]| (0.0..=paper.width).contains(x) && (0.0..=paper.height).contains(y))
        };
        for drawn in pages.iter().flat_map(|page| &page.drawn) {
            if let Drawn::Line { points, .. } = drawn {
                assert!(inside(points));
            }
        }
    }
}

/// A mistake in a wish is reported with its place, and nothing is written.
#[test]
fn a_wish_that_cannot_be_is_told_and_nothing_is_written() {
    let folder = Folder::new("aim-bad");
    folder.write("r161.json", include_str!("../meshes/r161.json"));
    let aim = |members: &str| format!("{{ \"format\": \"sweetspot-aim/1\", {members} }}");
    for (members, said) in [
        (r#""targets": [{ "name": "f1_hx", "change": "1 Hz" }]"#, "targets[0].name"),
        (
            r#""targets": [{ "name": "f1_hz", "change": "1 Hz", "within": 0 }]"#,
            "a tolerance above 0",
        ),
        (r#""targets": ["mass at most 30 oz", "mass at least 31 oz"]"#, "what targets[0] leaves"),
        (
            r#""targets": ["mass same"], "remove_only": true, "diameter": [{ "at_least": "30 mm" }]"#,
            "diameter[0].at_least",
        ),
        (r#""targets": ["mass same"], "rules": "cricket""#, "mlb"),
        (r#""targets": ["mass same"], "rules": "none.json""#, "none.json"),
        (r#""targets": []"#, "one target at least"),
        (r#""targets": ["mass 3 % more"], "remove_only": true"#, "at most the 0.8689934 kg"),
        (
            r#""targets": ["mass same"], "keep": [{ "from": 0, "to": "2 m" }]"#,
            "a stretch of the bat",
        ),
        (r#""targets": ["f1 -200 %"]"#, "more than nothing"),
        (r#""targets": ["mass 0 oz"]"#, "more than nothing"),
        (
            r#""targets": ["mass same"], "rules": "softball", "keep": ["0 to 840 mm"]"#,
            "all of the bat",
        ),
        (r#""targets": ["mass same"], "rules": "softball", "keep": ["600 to 800 mm"]"#, "rules"),
    ] {
        folder.write("aim.json", aim(members));
        let output = folder.run(&["aim", "r161.json", "aim.json", "--out", "new.json"]);
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{members}: {told}");
        assert!(told.contains(said), "{members}: {told}");
        assert!(output.stdout.is_empty() && !folder.names().contains(&"new.json".to_owned()));
    }
    for (option, said) in [
        (["--target", "beauty +3 %"], "--target"),
        (["--target", "swing wieght -3 %"], "did you mean swing weight?"),
        (["--keep", "3 in"], "--keep"),
        (["--rules", "mbl"], "did you mean mlb?"),
        (["--free", "colour red"], "--free"),
        (["--round", "0"], "--round"),
        (["--round", "-1 mm"], "a length above 0"),
        (["--slope", "0"], "a slope from 0.01 to 10"),
    ] {
        let args = ["aim", "r161.json", "--out", "new.json"];
        let output = folder.run(&[&args[..], &option[..]].concat());
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{option:?}: {told}");
        assert!(told.contains(said), "{option:?}: {told}");
        assert!(!folder.names().contains(&"new.json".to_owned()));
    }
}

/// A conflict leaves the nearest bat and exit code 3.
#[test]
fn the_nearest_bat_is_written_with_exit_code_3() {
    let folder = Folder::new("aim-conflict");
    let output = folder.run(&[
        "aim",
        "r161",
        "--target",
        "mass -4 oz",
        "--target",
        "swing weight at least 99.5 %",
        "--remove-only",
        "--diameter",
        "at least 24 mm",
        "--out",
        "near.json",
    ]);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert_eq!(output.status.code(), Some(3), "{text}");
    assert!(text.contains("Conflict:") && text.contains("cannot"), "{text}");
    folder.json(&["modes", "near.json", "-n", "1", "--json", "-"]);
}

/// A search that its steps ended has not shown that a target cannot be had.
#[test]
fn what_was_not_reached_is_not_called_impossible() {
    let folder = Folder::new("aim-far");
    let output = folder.run(&["aim", "r161", "--target", "f1 900 Hz"]);
    let text = String::from_utf8_lossy(&output.stdout).replace('\n', " ");
    assert_eq!(output.status.code(), Some(3), "{text}");
    let stopped = text.contains("as far as was searched");
    assert!(stopped && text.contains("not reached") && !text.contains("cannot"), "{text}");
}

/// Wood is removed from a bat whose radius is a formula in several pieces as from any other: the kept part keeps its
/// curve, and nothing is added.
#[test]
fn a_bat_of_a_formula_keeps_its_handle() {
    let bat = "x * 0.01 + 0.0125 + 0.009 * (1 + tanh((x - 0.5)/0.11))";
    let text = format!(
        r#"{{ "format": "sweetspot-bat/1", "material": "white-ash-dynamic", "profile": {{ "pieces": [
           {{ "from": 0, "to": 0.84, "formula": "{bat}" }} ] }} }}"#
    );
    let bat = Bat::from_text("formula.json", &text, Path::new("")).unwrap();
    let targets = vec![target(Answer::Inertia, Ask::Change(Amount::Share(-0.02), within(1e-4)))];
    let wish = Wish { targets, remove_only: true, ..Wish::default() };
    let outcome = Outcome::of(&bat, &wish, &terms()).unwrap();
    assert!(outcome.met && outcome.limits_broken_m <= 1e-9, "{:e}", outcome.limits_broken_m);
    let (new, found) = written(&outcome, &[Answer::Inertia]);
    let before = bat.inertia().about(sweetspot::bat::body::STANDARD_PIVOT);
    assert!((found[0] / before - 0.98).abs() < 1e-3, "{found:?}");
    let [_, added, ..] = along(&bat, &new);
    assert!(added <= 1e-8, "{added:e}");
    assert!(outcome.kept_within_m < 1e-5, "{:e}", outcome.kept_within_m);
}

/// Two per cent less swing weight of every built-in bat, including domed and pointed tips, hollow and cored bats and
/// bats of formulas: this is reached by removing wood, and in the file nothing is added anywhere and the handle is
/// unchanged.
#[test]
fn every_bat_is_aimed_with_its_limits_kept_by_its_file() {
    let folder = Path::new(env!("SWEETSPOT_TOP")).join("meshes");
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let bat = Bat::from_file(&path).unwrap();
        let mut terms = terms();
        let material = bat.material();
        if material.shear_modulus.is_none() && material.poisson_ratio.is_none() {
            terms.request.theory = Theory::EulerBernoulli;
        }
        let lighter = Ask::Change(Amount::Share(-0.02), None);
        let targets = vec![target(Answer::Inertia, lighter)];
        let wish = Wish { targets, remove_only: true, ..Wish::default() };
        let outcome = Outcome::of(&bat, &wish, &terms).unwrap();
        let name = path.display();
        assert!(
            outcome.met && outcome.limits_broken_m <= 1e-9,
            "{name} {:e}",
            outcome.limits_broken_m
        );
        assert!(outcome.kept_within_m <= 1e-8, "{name} {:e}", outcome.kept_within_m);
        let new = Bat::from_text("new.json", &aimed::bat_text(&outcome), Path::new("")).unwrap();
        let inertia = |bat: &Bat| bat.inertia().about(sweetspot::bat::body::STANDARD_PIVOT);
        assert!((inertia(&new) / inertia(&bat) - 0.98).abs() <= 1.001e-3, "{name}");
        let [_, added, ..] = along(&bat, &new);
        assert!(added <= 1e-9, "{name} {added:e}");
    }
}

/// The greatest |r′| of a bat between two places (m), by differences over 10 µm.
fn steepest(bat: &Bat, [from, to]: [f64; 2]) -> f64 {
    let radius = |x: f64| bat.profile().at(x).outer;
    let count = ((to - from) / 1e-5) as usize;
    let places = (0..count).map(|k| from + 1e-5 * k as f64);
    places.map(|x| (radius(x + 1e-5) - radius(x)).abs() / 1e-5).fold(0.0, f64::max)
}

/// Where the barrel is kept and wood is removed before it, the surface becomes steep: a limit on the slope is kept in
/// the file, and costs a larger change.
#[test]
fn a_limit_of_the_slope_is_kept_by_the_file() {
    let text = r#"{ "format": "sweetspot-bat/1", "material": "white-ash-dynamic",
        "profile": { "unit": "mm", "x": [0, 400, 838.2], "diameter": [25, 44.5, 66] } }"#;
    let bat = Bat::from_text("cone.json", text, Path::new("")).unwrap();
    let lighter = target(Answer::Inertia, Ask::Change(Amount::Share(-0.02), None));
    let of = |slope: Option<f64>| {
        let keep = vec![[0.0, 0.03], [0.6, 0.8382]];
        let wish =
            Wish { targets: vec![lighter], slope, keep, remove_only: true, ..Wish::default() };
        let outcome = Outcome::of(&bat, &wish, &terms()).unwrap();
        (steepest(&written(&outcome, &[Answer::Inertia]).0, [0.0, 0.838]), outcome)
    };
    let (free, least) = of(None);
    let (kept, outcome) = of(Some(0.05));
    assert!(outcome.met && free > 0.055 && kept <= 0.05, "{kept} of {free}");
    assert!(outcome.norm_mm > 1.1 * least.norm_mm, "{} of {}", outcome.norm_mm, least.norm_mm);
    // A wish that needs more is impossible.
    let (kept, outcome) = of(Some(0.045));
    assert!(!outcome.met && outcome.conflict.is_some() && kept <= 0.045, "{kept}");
}

/// Where stations are a foot apart, a kept stretch keeps its curve, and the frequency of a bat that changes elsewhere
/// is that of the smooth change, because additional stations preserve the curve.
#[test]
fn a_bat_of_few_stations_keeps_the_curve_of_what_is_kept() {
    let text = r#"{ "format": "sweetspot-bat/1", "material": "white-ash-dynamic",
        "profile": { "unit": "in", "x": [0, 1.5, 3, 17, 31, 33], "diameter": [1.8, 1, 0.95, 1.2, 2.5, 2.5] } }"#;
    let bat = Bat::from_text("few.json", text, Path::new("")).unwrap();
    let targets = vec![target(Answer::Inertia, Ask::Change(Amount::Share(-0.02), None))];
    for remove_only in [true, false] {
        let (keep, targets) = (vec![[0.0, 0.5]], targets.clone());
        let wish = Wish { targets, remove_only, keep, ..Wish::default() };
        let outcome = Outcome::of(&bat, &wish, &terms()).unwrap();
        assert!(outcome.met, "{outcome:?}");
        let text = aimed::bat_text(&outcome);
        let new = Bat::from_text("new.json", &text, Path::new("")).unwrap();
        let moved = (0..5000).map(|k| 1e-4 * f64::from(k)).map(|x| {
            let [was, is] = [&bat, &new].map(|bat| 2.0 * bat.profile().at(x).outer);
            (is - was).abs()
        });
        let moved = moved.fold(0.0, f64::max);
        assert!(moved <= 1e-5 && moved <= 1.01 * outcome.kept_within_m, "{moved:e}");
    }
}

/// Two targets that bind at once may leave less room than rounding to a tenth of a millimetre needs: finer rounding
/// meets them, with the norm of the smallest change, 0.178 mm.
#[test]
fn a_wish_that_can_be_had_is_not_refused_by_rounding() {
    let balance = Ask::Change(Amount::Si(1e-3), None);
    let targets = vec![
        target(Answer::Mass, Ask::Change(Amount::Si(0.0), None)),
        target(Answer::BalancePoint, balance),
    ];
    let wish = Wish { targets, remove_only: true, ..Wish::default() };
    let outcome = Outcome::of(&r161(), &wish, &terms()).unwrap();
    assert!(outcome.met && outcome.conflict.is_none(), "{:?}", outcome.targets);
    assert!((outcome.norm_mm / 0.178 - 1.0).abs() < 0.1, "{}", outcome.norm_mm);
    let (new, _) = written(&outcome, &[Answer::Mass]);
    let [_, added, ..] = along(&r161(), &new);
    assert!(added <= 1e-9, "{added:e}");
    // The stated change of the knob is the largest at any place on a finer grid.
    let moved = |x: f64| 2.0 * (new.profile().at(x).outer - r161().profile().at(x).outer).abs();
    let most = (0..60_000).map(|k| moved(5e-7 * f64::from(k))).fold(0.0, f64::max);
    assert!(
        outcome.kept_within_m >= most && outcome.kept_within_m < 1.01 * most + 1e-12,
        "{most:e}"
    );
}

/// A weighed bat exists: it is cut, and wood is added only where that is allowed. The changes are in the list.
#[test]
fn a_weighed_bat_is_only_cut_unless_wood_may_be_added() {
    let folder = Folder::new("aim-weighed");
    let bat = include_str!("../meshes/r161.json");
    let mut value: serde_json::Value = serde_json::from_str(bat).unwrap();
    value["weighed"] = serde_json::json!({ "mass": "31 oz" });
    folder.write("mine.json", value.to_string());
    let wish = ["aim", "mine.json", "--target", "f1 +2 Hz", "--json", "-"];
    let cut: serde_json::Value = serde_json::from_slice(&folder.run(&wish).stdout).unwrap();
    assert!(cut["largest_added_m"].as_f64().unwrap() <= 1e-9, "{}", cut["largest_added_m"]);
    let added = folder.json(&[&wish[..], &["--add"]].concat());
    assert!(added["largest_added_m"].as_f64().unwrap() > 1e-5);
    let changed = added["change"].as_array().unwrap().iter();
    let changed = changed
        // Less than 5 μm of the diameter is negligible on a lathe.
        .filter(|at| (at["old_m"].as_f64().unwrap() - at["new_m"].as_f64().unwrap()).abs() >= 5e-6);
    assert_eq!(changed.count(), added["cuts"].as_array().unwrap().len());
    let table = folder.text(&["aim", "mine.json", "--target", "lose an ounce"]);
    assert!(table.contains("--add") && table.contains("nothing added"), "{table}");
    let told = folder.run(&["aim", "mine.json", "--target", "1 oz heavier"]);
    let said = String::from_utf8_lossy(&told.stderr).into_owned();
    assert!(told.status.code() == Some(2) && said.contains("--add"), "{said}");
}

/// A barrel above 2.61 in is warned of with the rule.
#[test]
fn a_barrel_that_rules_forbid_is_warned_of() {
    let folder = Folder::new("aim-wide");
    let wish =
        ["aim", "r161", "--target", "sweet spot 1 in outward", "--target", "-1 oz", "--full"];
    let output = folder.run(&wish);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(text.contains("Warning") && text.contains("rule 3.02 of Major League"), "{text}");
    assert!(text.contains("wood added"), "{text}");
}

/// A drop is written as in the trade: three ounces fewer than inches is −3, a lighter bat, and tables have this sign.
#[test]
fn a_drop_of_three_is_lighter() {
    let folder = Folder::new("aim-drop");
    for drop in ["drop -3", "drop 3", "-3"] {
        let table = folder.text(&["aim", "r161", "--target", drop]);
        assert!(table.contains("-3.00 ± 0.05") && table.contains("-2.42"), "{drop}: {table}");
        let document = folder.json(&["aim", "r161", "--target", drop, "--json", "-"]);
        let target = &document["targets"][0];
        let [start, found] = ["start", "found"].map(|key| target[key].as_f64().unwrap());
        assert!((start - 2.418).abs() < 1e-3 && (found - 3.0).abs() <= 0.05 + 1e-9, "{target}");
    }
}

/// Limits that no smooth curve can satisfy are reported with their place.
#[test]
fn limits_that_leave_no_room_are_told_with_their_place() {
    let folder = Folder::new("aim-room");
    let wish = [
        "aim",
        "r161",
        "--target",
        "mass same",
        "--diameter",
        "400 mm to 405 mm, at most 20 mm",
        "--diameter",
        "410 mm to 415 mm, at least 60 mm",
    ];
    let output = folder.run(&wish);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("leave no room at") && said.contains("--diameter"), "{said}");
}

/// Where a sleeve is around the bat its own diameter cannot change; the rest of the bat takes the change.
#[test]
fn a_sleeve_keeps_what_it_covers() {
    let folder = Folder::new("aim-sleeve");
    let sleeve = "24 in to 30 in, 1 mm, aluminium-7075";
    let wish = ["aim", "r161", "--sleeve", sleeve, "--target", "mass -2 %", "--json", "-"];
    let found = folder.json(&wish);
    let [start, end] = ["start", "found"].map(|key| found["targets"][0][key].as_f64().unwrap());
    // Of the mass (kg) a gram is left open.
    assert!((end - 0.98 * start).abs() < 1.001e-3, "{start} {end}");
}
