//! The formats as first written: the test fails if a member is renamed, moved or of another type.
//!
//! Made in `tests/golden` by the commands of [`WRITTEN`], the first two from a bat and a ball that have
//! every member there is; of the others, lists are kept as far as their second item. Numbers are
//! compared where the answer is defined, not where it says how it was found.

use crate::common;

use common::documents::{Numbers, WRITTEN, error, folder, manifest, page, written};
use serde_json::Value;

/// Members whose numbers are internal to the program, and those of flat maxima, which are found only roughly.
const OWN: [&str; 5] = ["/error", "/model/", "/timing", "/generator", "/target"];
const ROUGH: [&str; 2] = ["/sweet_spot", "/figures"];

/// The differences from the golden document.
fn differences(path: &str, (golden, now): (&Value, &Value), like: Numbers, all: &mut Vec<String>) {
    let own = like == Numbers::Times || OWN.iter().any(|part| path.contains(part));
    match (golden, now) {
        (Value::Object(a), Value::Object(b)) => {
            let keys = |object: &serde_json::Map<String, Value>| {
                object.keys().cloned().collect::<Vec<String>>()
            };
            if keys(a) != keys(b) {
                all.push(format!("{path}: {:?}, were {:?}", keys(b), keys(a)));
            }
            let shared = a.iter().filter_map(|(key, value)| Some((key, value, b.get(key)?)));
            shared.for_each(|(key, a, b)| differences(&format!("{path}/{key}"), (a, b), like, all));
        }
        (Value::Array(a), Value::Array(b)) => {
            let words = a.iter().all(Value::is_string);
            let as_time_allowed = like == Numbers::Times;
            if a.len() != b.len() && !(words && own || as_time_allowed) {
                all.push(format!("{path}: {} items, were {}", b.len(), a.len()));
            }
            let pairs = a.iter().zip(b).enumerate();
            pairs.for_each(|(k, both)| differences(&format!("{path}/{k}"), both, like, all));
        }
        (Value::Number(a), Value::Number(b)) if a.is_f64() == b.is_f64() => {
            let [a, b] = [a, b].map(|number| number.as_f64().unwrap());
            let rough = like == Numbers::Rough || ROUGH.iter().any(|part| path.starts_with(part));
            let within = if rough { 1e-3 } else { 1e-6 };
            if !own && (a - b).abs() > within * a.abs().max(1e-3) {
                all.push(format!("{path}: {b}, was {a}"));
            }
        }
        (Value::String(a), Value::String(b)) if a == b || own => {}
        (Value::Bool(_), Value::Bool(_)) if golden == now || own => {}
        (Value::Null, Value::Null) => {}
        // Members that the schema allows to be null may be missing, depending on the time.
        (Value::Null, _) | (_, Value::Null) if like == Numbers::Times => {}
        _ => all.push(format!("{path}: {now}, was {golden}")),
    }
}

/// Lists, up to their second item.
fn cut(value: &mut Value) {
    match value {
        Value::Object(members) => members.values_mut().for_each(cut),
        Value::Array(items) => {
            items.truncate(2);
            items.iter_mut().for_each(cut);
        }
        _ => {}
    }
}

fn golden(name: &str) -> Value {
    let path = format!("{}/tests/golden/{name}-1.json", env!("SWEETSPOT_TOP"));
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

#[test]
fn the_documents_are_those_of_version_one() {
    let folder = folder("golden");
    let documents = WRITTEN.map(|document| (document.0, written(&folder, document), document.3));
    let others = [
        ("page", page(&folder), Numbers::Rough),
        ("error", error(&folder), Numbers::Sharp),
        ("study-manifest", manifest(&folder), Numbers::Sharp),
    ];
    for (name, mut now, like) in documents.into_iter().chain(others) {
        if !["modes", "hit"].contains(&name) {
            cut(&mut now);
        }
        let mut all = vec![];
        differences("", (&golden(name), &now), like, &mut all);
        assert!(all.is_empty(), "{name}: {all:#?}");
    }
}

#[test]
fn a_renamed_member_and_another_type_are_found() {
    let golden = golden("hit");
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
        differences("", (&golden, &now), Numbers::Sharp, &mut all);
        assert!(!all.is_empty(), "{from} as {to}");
    }
}
