//! Randomly corrupted bat files give either a meaningful error or a bat with finite numbers, and never a panic.

use std::ops::Range;
use std::path::Path;

use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use sweetspot::base::error::Error;
use sweetspot::bat::body::Bat;
use sweetspot::bat::theory::Theory;
use sweetspot::collision::energy_loss::EnergyLoss;
use sweetspot::collision::hit::{Effort, Model, Scene};
use sweetspot::collision::hitter::Hitter;
use sweetspot::collision::sweet_spot::{FEW, HitsAlong, SweetSpot};
use sweetspot::modes::solve::{self, Request, Solution};
use sweetspot_report::report::hit_json;
use sweetspot_report::report::json::{self, ShapePoints};
use sweetspot_report::schema;

/// A bat with everything on it and under it.
const HELD: &str = r#"{
  "format": "sweetspot-bat/1",
  "name": "held",
  "source": "made up",
  "material": { "density": 700, "youngs_modulus": 14e9, "shear_modulus": 1e9, "loss_factor": 0.01 },
  "profile": { "interpolation": "linear", "x": [0, 0.4, 0.84], "radius": [0.014, 0.016, 0.033],
               "inner_radius": [0, 0.004, 0.02] },
  "regions": [ { "from": 0.5, "to": 0.84, "core": {
      "density": 200, "youngs_modulus": 2e7, "shear_modulus": 1e7 } } ],
  "attachments": [ { "x": 0.8, "mass": 0.05, "offset": 0.02, "rotary_inertia": 1e-5 },
                   { "x": 0.3, "stiffness": 1e4, "rotational_stiffness": 20 } ],
  "tapes": [ { "from": 0, "to": 0.25, "mass": 0.02 } ],
  "absorbers": [ { "x": 0.02, "mass": 0.03, "frequency": 170, "damping": 2 } ],
  "joints": [ { "x": 0.45, "rotational_stiffness": 1e4 } ],
  "supports": [ { "x": 0.35, "type": "pinned" } ],
  "grip": { "from": 0.02, "to": 0.15, "stiffness": 1e5, "damping": 100 }
}"#;

const FILES: [(&str, &str); 11] = [
    ("held", HELD),
    ("corked", include_str!("../meshes/corked.json")),
    ("two_piece", include_str!("../meshes/two_piece.json")),
    ("dowel", include_str!("../meshes/dowel.json")),
    ("cone", include_str!("../meshes/cone.json")),
    ("house", include_str!("../meshes/house.json")),
    ("r161", include_str!("../meshes/r161.json")),
    ("tanh", include_str!("../meshes/tanh.json")),
    ("torpedo", include_str!("../meshes/torpedo.json")),
    ("northwestern_wood", include_str!("../meshes/northwestern_wood.json")),
    ("northwestern_aluminium", include_str!("../meshes/northwestern_aluminium.json")),
];

/// Replacements for a number.
const STRANGE: [&str; 28] = [
    "0",
    "-0",
    "-1",
    "1",
    "2",
    "1e-3",
    "1e3",
    "1e-17",
    "1e17",
    "1e-30",
    "1e30",
    "1e-77",
    "1e77",
    "1e-154",
    "1e154",
    "5e-324",
    "1e-308",
    "1e308",
    "1e-999",
    "1e999",
    "99999999999999999999",
    "NaN",
    "null",
    "true",
    "[]",
    "{}",
    "\"1 in\"",
    "\"\"",
];

/// One way to corrupt a text. Places are relative, so that any mutation fits any file.
#[derive(Debug, Clone)]
enum Mutation {
    Delete { at: f64, bytes: usize },
    Insert { at: f64, bytes: Vec<u8> },
    Replace { at: f64, byte: u8 },
    Number { which: f64, by: String },
    Drop { which: f64 },
    Duplicate { which: f64 },
    Truncate { at: f64 },
}

fn mutation() -> impl Strategy<Value = Mutation> {
    let at = || 0.0..1.0;
    let strange = proptest::sample::select(&STRANGE[..]).prop_map(str::to_owned);
    let any_number = any::<f64>().prop_map(|v| format!("{v:e}"));
    let number =
        prop_oneof![strange, any_number, (-30.0..30.0).prop_map(|e: f64| format!("1e{e:.0}"))];
    prop_oneof![
        1 => (at(), 1usize..20).prop_map(|(at, bytes)| Mutation::Delete { at, bytes }),
        1 => (at(), any::<[u8; 3]>()).prop_map(|(at, b)| Mutation::Insert { at, bytes: b.into() }),
        1 => (at(), "[\\[\\]{},:\"\\\\0-9eE.+-]{1,4}")
            .prop_map(|(at, s)| Mutation::Insert { at, bytes: s.into() }),
        1 => (at(), any::<u8>()).prop_map(|(at, byte)| Mutation::Replace { at, byte }),
        8 => (at(), number).prop_map(|(which, by)| Mutation::Number { which, by }),
        2 => at().prop_map(|which| Mutation::Drop { which }),
        1 => at().prop_map(|which| Mutation::Duplicate { which }),
        1 => at().prop_map(|at| Mutation::Truncate { at }),
    ]
}

fn mutate(text: &str, mutation: &Mutation) -> String {
    let place = |share: f64, count: usize| ((share * count as f64) as usize).min(count);
    let mut bytes = text.as_bytes().to_vec();
    let pick = |spans: Vec<Range<usize>>, share: f64| {
        spans.get(place(share, spans.len().saturating_sub(1))).cloned().unwrap_or(0..0)
    };
    match mutation {
        Mutation::Delete { at, bytes: count } => {
            let at = place(*at, bytes.len());
            bytes.drain(at..(at + count).min(bytes.len()));
        }
        Mutation::Insert { at, bytes: more } => {
            let at = place(*at, bytes.len());
            bytes.splice(at..at, more.iter().copied());
        }
        Mutation::Replace { at, byte } => {
            let at = place(*at, bytes.len());
            if let Some(there) = bytes.get_mut(at) {
                *there = *byte;
            }
        }
        Mutation::Number { which, by } => {
            bytes.splice(pick(numbers(text), *which), by.bytes());
        }
        Mutation::Drop { which } => {
            bytes.drain(pick(members(text), *which));
        }
        Mutation::Duplicate { which } => {
            let span = pick(members(text), *which);
            let copy = [&text.as_bytes()[span.clone()], b", "].concat();
            bytes.splice(span.start..span.start, copy);
        }
        Mutation::Truncate { at } => bytes.truncate(place(*at, bytes.len())),
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// The positions of numbers, after the "source" with its many numbers.
fn numbers(text: &str) -> Vec<Range<usize>> {
    let begin = text.find("\"material\"").unwrap_or(0);
    let part = |c: char| c.is_ascii_digit() || ".eE+-".contains(c);
    let mut spans = Vec::new();
    let mut at = begin;
    while let Some(start) = text[at..].find(|c: char| c.is_ascii_digit()).map(|found| at + found) {
        at = text[start..].find(|c| !part(c)).map_or(text.len(), |length| start + length);
        spans.push(start..at);
    }
    spans
}

/// The positions of members of objects, with the comma after them.
fn members(text: &str) -> Vec<Range<usize>> {
    let member = |(colon, _)| {
        let start = text[..colon].rfind('"').and_then(|end| text[..end].rfind('"'))?;
        let (mut depth, mut quoted) = (0, false);
        for (k, c) in text[colon..].char_indices() {
            match c {
                '"' => quoted = !quoted,
                _ if quoted => {}
                '[' | '{' => depth += 1,
                ']' | '}' if depth == 0 => return Some(start..colon + k),
                ']' | '}' => depth -= 1,
                ',' if depth == 0 => return Some(start..colon + k + 1),
                _ => {}
            }
        }
        None
    };
    text.match_indices("\": ").map(|(quote, colon)| (quote + 1, colon)).filter_map(member).collect()
}

fn in_range(value: f64) -> bool {
    value > 0.0 && value.is_finite()
}

/// Everything that `modes` and `hit` compute, held to be numbers.
fn solve_and_hit(bat: &Bat) -> Result<(), String> {
    let told = |error: Error| match error.to_string() {
        text if text.is_empty() || text.contains("NaN ") => Err(format!("error \"{text}\"")),
        _ => Ok(()),
    };
    let holds = |what: &str, good: bool| if good { Ok(()) } else { Err(what.to_owned()) };
    let inertia = bat.inertia();
    holds("mass", in_range(inertia.mass))?;
    // Weights may be attached off the axis of the bat.
    let beside = bat.fixtures().attachments.iter().any(|a| a.offset != 0.0);
    let inside = inertia.balance_point > 0.0 && inertia.balance_point < bat.length();
    holds("balance", inside || (beside && inertia.balance_point.is_finite()))?;
    holds("inertia", in_range(inertia.about_balance) && in_range(inertia.line_about_balance))?;
    let theory = if bat.knows_shear() { Theory::Timoshenko } else { Theory::Rayleigh };
    let request = Request { modes: 3, tolerance: 1e-3, theory, ..Request::default() };
    let solution = match solve::solve(bat, &request) {
        Ok(solution) => solution,
        Err(error) => return told(error),
    };
    let frequencies: Vec<f64> = solution.modes.iter().map(|mode| mode.frequency()).collect();
    let rising = frequencies.windows(2).all(|pair| pair[0] <= pair[1]);
    holds(
        &format!("frequencies {frequencies:?}"),
        rising && frequencies.iter().all(|f| in_range(*f)),
    )?;
    for mode in &solution.modes {
        let error = mode.error;
        holds("modal mass", in_range(mode.modal_mass))?;
        holds("nodes", mode.nodes.iter().all(|x| *x >= 0.0 && *x <= bat.length()))?;
        let errors =
            [error.discretization, error.round_off, error.residual, error.nodes, error.modal_mass];
        holds(&format!("{error:?}"), errors.iter().all(|e| *e >= 0.0 && e.is_finite()))?;
    }
    let document = json::modes(bat, &solution, ShapePoints::Even(5), false);
    let document = schema::text(&document);
    holds(&document, !document.contains("null") || document.contains("_percussion_m\": null"))?;
    for damped in &solution.damping.modes {
        let numbers = [damped.natural, damped.ratio, damped.decay, damped.error];
        holds(&format!("{damped:?}"), numbers.iter().all(|v| *v >= 0.0 && v.is_finite()))?;
    }
    if bat.fixtures().holding() {
        return Ok(());
    }
    hit(bat, &solution, Model::Rigid)?;
    hit(bat, &solution, Model::EnergyLoss(EnergyLoss::default()))?;
    hit(bat, &solution, Model::Contact)
}

fn hit(bat: &Bat, solution: &Solution, model: Model) -> Result<(), String> {
    let scene = Scene { pivot: 0.0635, swing: 50.0, ball_speed: 40.0, ..Scene::default() };
    let hitter =
        Hitter::new(model, &scene, bat, solution, Effort::default()).map_err(|e| e.to_string())?;
    let looked = HitsAlong::outer(FEW, &hitter);
    let spot = SweetSpot::within(&looked);
    let mut impacts = Vec::new();
    for share in [0.0, 0.5, 0.75, 1.0] {
        let impact = hitter.strike(share * bat.length());
        if let Some(outcome) = &impact.outcome {
            let values =
                [outcome.exit_speed, outcome.impulse, outcome.bbcor, outcome.energy.initial];
            if !values.iter().chain([&outcome.error]).all(|v| v.is_finite()) {
                return Err(format!("{impact:?}"));
            }
        }
        impacts.push(impact);
    }
    let peak = spot.exit_speed_max.map_or(0.0, |peak| peak.value);
    let text = schema::text(&hit_json::hit(bat, model, &scene, &impacts, &spot));
    if peak.is_finite() && !text.is_empty() { Ok(()) } else { Err(format!("{spot:?}")) }
}

/// The fault in an error message about a text: it must name the file, and a place that contains the excerpt shown.
fn misplaced(error: &Error, name: &str, text: &str) -> Option<String> {
    if let Error::Several { shown, more } = error {
        let order = |error: &Error| match error {
            Error::Input { place, .. } => (place.line, place.column),
            _ => (0, 0),
        };
        let count = shown.len();
        let sorted = shown.is_sorted_by_key(order);
        if !sorted || !(2..=10).contains(&count) || (*more > 0 && count < 10) {
            return Some(format!("{count} mistakes and {more}, sorted: {sorted}"));
        }
        return shown.iter().find_map(|error| misplaced(error, name, text));
    }
    let said = error.to_string();
    let Error::Input { place, .. } = error else { return Some(said) };
    let text = text.trim_start_matches('\u{feff}');
    let line = text.split('\n').nth(place.line - 1).unwrap_or("no such line");
    let (before, at) = match line.char_indices().nth(place.column - 1) {
        Some((at, _)) => line.split_at(at),
        None => (line, ""),
    };
    let excerpt = &place.excerpt;
    let parts = [&excerpt.before, &excerpt.after].map(|part| part.trim_matches('…'));
    let stands = before.ends_with(parts[0]) && at.starts_with(&*excerpt.marked);
    let width = excerpt.before.chars().chain(excerpt.after.chars()).count();
    let good = said.contains("found ") && said.contains(name) && !said.contains("found NaN ");
    let good = good && stands && at.contains(parts[1]) && width < 80 && !said.contains('\n');
    (!good).then(|| format!("{said}\n{excerpt:?}\nin {line:?}"))
}

#[test]
fn the_files_are_good_and_the_places_to_spoil_are_found() {
    for (name, text) in FILES {
        let bat = Bat::from_text(name, text, Path::new("")).unwrap();
        solve_and_hit(&bat).unwrap();
        assert!(members(text).len() >= 8 && numbers(text).len() >= 5, "{name}");
        // Only the name and the source may go.
        let spare = members(text).into_iter().filter(|span| {
            let without = [&text[..span.start], &text[span.end..]].concat();
            Bat::from_text(name, &without, Path::new("")).is_ok()
        });
        assert!(spare.count() >= 2, "{name}");
    }
}

/// A file, spoilt in a few places, is refused where it is spoilt, or is a bat that is solved and hit.
fn an_error_or_a_bat(file: usize, mutations: &[Mutation]) -> Result<(), TestCaseError> {
    let (name, good) = FILES[file];
    let text = mutations.iter().fold(good.to_owned(), |text, mutation| mutate(&text, mutation));
    match Bat::from_text(name, &text, Path::new("")) {
        Ok(bat) => {
            let verdict = solve_and_hit(&bat);
            prop_assert!(verdict.is_ok(), "{}\n{}", verdict.unwrap_err(), text);
        }
        Err(error) => prop_assert_eq!(misplaced(&error, name, &text), None),
    }
    Ok(())
}

// The same files in every run, so that a failure is reproducible. Two halves, so that two processors share them.
proptest! {
    #![proptest_config(ProptestConfig {
        cases: 300,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(33),
        ..ProptestConfig::default()
    })]

    #[test]
    fn a_spoilt_file_is_an_error_or_a_bat(
        file in 0..FILES.len(),
        mutations in prop::collection::vec(mutation(), 1..4),
    ) {
        an_error_or_a_bat(file, &mutations)?;
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 300,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(35),
        ..ProptestConfig::default()
    })]

    #[test]
    fn another_spoilt_file_is_an_error_or_a_bat(
        file in 0..FILES.len(),
        mutations in prop::collection::vec(mutation(), 1..4),
    ) {
        an_error_or_a_bat(file, &mutations)?;
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 4000,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(34),
        ..ProptestConfig::default()
    })]

    /// Files that are spoilt in many places, read only.
    #[test]
    fn every_mistake_stands_where_it_is_said_to_stand(
        file in 0..FILES.len(),
        mutations in prop::collection::vec(mutation(), 1..12),
    ) {
        let (name, good) = FILES[file];
        let text = mutations.iter().fold(good.to_owned(), |text, mutation| mutate(&text, mutation));
        if let Err(error) = Bat::from_text(name, &text, Path::new("")) {
            prop_assert_eq!(misplaced(&error, name, &text), None);
        }
    }

    /// A corrupted table: JSON has specific messages for malformed text, CSV has cells.
    #[test]
    fn a_spoilt_table_is_an_error_or_a_bat(
        mutations in prop::collection::vec(mutation(), 1..6),
    ) {
        let good = "# radii, \"material\"\r\nx_in,diameter_in,wall_thickness_mm\r\n0,1,2\n\n\
                    # a comment\n 5 ,0.9,\"2\"\n20,1.6,3\n33.5,2.61,3.5\n";
        let text = mutations.iter().fold(good.to_owned(), |text, mutation| mutate(&text, mutation));
        let folder = std::env::temp_dir().join(format!("sweetspot-tables-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        std::fs::write(folder.join("t.csv"), &text).unwrap();
        let bat = r#"{ "format": "sweetspot-bat/1", "material": "white-ash",
            "profile": { "csv": "t.csv" } }"#;
        let read = Bat::from_text("bat.json", bat, &folder);
        std::fs::remove_dir_all(&folder).unwrap();
        if let Err(error) = read {
            let of_bat = error.to_string().starts_with("bat.json:");
            let (name, text) = if of_bat { ("bat.json", bat) } else { ("t.csv", &*text) };
            prop_assert_eq!(misplaced(&error, name, text), None);
        }
    }
}
