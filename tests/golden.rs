//! The formats as they were written once: a member that is renamed, moved or of another type fails.
//!
//! Made in `tests/golden` by the commands of [`MODES`] and [`HIT`] with `--json FILE`, from a bat
//! and a ball that have every member there is. Numbers are compared where the answer is defined, not
//! where it says how it was found.

mod common;

use common::folder::Folder;
use serde_json::Value;

const MODES: &[&str] = &[
    "modes",
    "bat-1.json",
    "-n",
    "2",
    "--tol",
    "1e-9",
    "--theory",
    "timoshenko",
    "--shape-points",
    "3",
];
const HIT: &[&str] = &[
    "hit",
    "bat-1.json",
    "-n",
    "2",
    "--tol",
    "1e-8",
    "--theory",
    "timoshenko",
    "--from",
    "0.6",
    "--to",
    "0.7",
    "--points",
    "2",
    "--ball",
    "ball-1.json",
    "--wall-stiffness",
    "5e6",
    "--wall-mass",
    "0.05",
    "--reference-inertia",
    "0.2",
    "--swing-exponent",
    "0.3",
];

/// Where the numbers are the program's own affair, and where a flat maximum is found roughly.
const OWN: [&str; 4] = ["/error", "/model/", "/timing", "/generator"];
const ROUGH: [&str; 2] = ["/sweet_spot", "/figures"];

/// What differs from the golden document.
fn differences(path: &str, golden: &Value, now: &Value, all: &mut Vec<String>) {
    match (golden, now) {
        (Value::Object(a), Value::Object(b)) => {
            let keys = |object: &serde_json::Map<String, Value>| {
                object.keys().cloned().collect::<Vec<String>>()
            };
            if keys(a) != keys(b) {
                all.push(format!("{path}: {:?}, were {:?}", keys(b), keys(a)));
            }
            let shared = a.iter().filter_map(|(key, value)| Some((key, value, b.get(key)?)));
            shared.for_each(|(key, a, b)| differences(&format!("{path}/{key}"), a, b, all));
        }
        (Value::Array(a), Value::Array(b)) => {
            let words = a.iter().all(Value::is_string);
            if a.len() != b.len() && !(words && own(path)) {
                all.push(format!("{path}: {} items, were {}", b.len(), a.len()));
            }
            let pairs = a.iter().zip(b).enumerate();
            pairs.for_each(|(k, (a, b))| differences(&format!("{path}/{k}"), a, b, all));
        }
        (Value::Number(a), Value::Number(b)) if a.is_f64() == b.is_f64() => {
            let [a, b] = [a, b].map(|number| number.as_f64().unwrap());
            let rough = ROUGH.iter().any(|part| path.starts_with(part));
            let within = if rough { 1e-3 } else { 1e-6 };
            if !own(path) && (a - b).abs() > within * a.abs().max(1e-3) {
                all.push(format!("{path}: {b}, was {a}"));
            }
        }
        (Value::String(a), Value::String(b)) if a == b || own(path) => {}
        (Value::Bool(_), Value::Bool(_)) | (Value::Null, Value::Null) if golden == now => {}
        _ => all.push(format!("{path}: {now}, was {golden}")),
    }
}

fn own(path: &str) -> bool {
    OWN.iter().any(|part| path.contains(part))
}

#[test]
fn the_documents_are_those_of_version_one() {
    let folder = Folder::new("golden");
    folder.write("bat-1.json", include_str!("golden/bat-1.json"));
    folder.write("ball-1.json", include_str!("golden/ball-1.json"));
    for (command, golden) in
        [(MODES, include_str!("golden/modes-1.json")), (HIT, include_str!("golden/hit-1.json"))]
    {
        let now = folder.json(&[command, &["--json", "-"]].concat());
        let golden: Value = serde_json::from_str(golden).unwrap();
        let mut all = vec![];
        differences("", &golden, &now, &mut all);
        assert!(all.is_empty(), "{all:#?}");
    }
}

#[test]
fn a_renamed_member_and_another_type_are_found() {
    let golden: Value = serde_json::from_str(include_str!("golden/hit-1.json")).unwrap();
    let text = golden.to_string();
    for (from, to) in [
        ("\"bbcor\"", "\"bbs\""),
        ("\"swing_rad_s\":50.0", "\"swing_rad_s\":50"),
        ("\"modes_used\":2", "\"modes_used\":\"2\""),
        ("\"certified\":false", "\"certified\":true"),
    ] {
        assert!(text.contains(from), "{from}");
        let now: Value = serde_json::from_str(&text.replacen(from, to, 1)).unwrap();
        let mut all = vec![];
        differences("", &golden, &now, &mut all);
        assert!(!all.is_empty(), "{from} as {to}");
    }
}
