//! The schema of a bat file agrees with the reader: the same members, types and bounds.

use crate::common;

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use common::folder::Folder;
use jsonschema::Validator;
use serde_json::{Value, json};
use sweetspot::collision::ball::Ball;
use sweetspot::files::schema::ball::BallFile;
use sweetspot::files::schema::bat::BatFile;
use sweetspot::{Bat, Material};
use sweetspot_report::schema::of;

/// A bat with everything on it and under it.
const FULL: &str = r#"{
  "format": "sweetspot-bat/1", "name": "full", "source": "made up",
  "material": { "density": "0.7 g/cm^3", "youngs_modulus": "14 GPa", "shear_modulus": 1e9,
                "poisson_ratio": 0.3, "shear_coefficient": 0.9, "loss_factor": 0.01,
                "strength": "100 MPa", "strain_to_failure": 0.01, "hoop_modulus": "9 GPa", "radial_modulus": 8e9,
                "shear_moduli": { "along_around": "5 GPa", "along_across": 4e9, "around_across": 4e9 },
                "poisson_ratios": { "along_around": 0.3, "along_across": 0.3, "around_across": 0.4 } },
  "profile": { "interpolation": "linear", "unit": "mm", "measured_from": "knob",
               "x": [0, "40 cm", 840], "diameter": [0, 32, 66], "wall_thickness": [0, 10, "1 in"] },
  "regions": [ { "from": 0.5, "to": "84 cm", "material": "aluminium-7075", "core": {
      "density": 200, "youngs_modulus": 2e7, "shear_modulus": 1e7 } } ],
  "attachments": [ { "x": 0.8, "mass": "1 oz", "offset": 0.02, "rotary_inertia": 1e-5 },
                   { "x": 0.3, "stiffness": 1e4, "rotational_stiffness": "20 N m" } ],
  "tapes": [ { "from": 0, "to": 0.25, "mass": 0.02 } ],
  "absorbers": [ { "x": 0.02, "mass": 0.03, "frequency": "170 Hz", "damping": 2 },
                 { "x": 0.03, "mass": 0.03, "stiffness": 3e4 } ],
  "joints": [ { "x": 0.45, "rotational_stiffness": 1e4 } ],
  "supports": [ { "x": 0.35, "type": "pinned" } ],
  "grip": { "from": 0.02, "to": 0.15, "stiffness": 1e5, "damping": 100 },
  "weighed": { "balance_point": 0.5, "first_bending_hz": 100 }
}"#;

/// Formulas, and a density and a modulus that were measured instead.
const FORMULAS: &str = r#"{
  "format": "sweetspot-bat/1",
  "material": { "poisson_ratio": 0.3 },
  "profile": { "measured_from": "tip", "pieces": [
    { "from": 0, "to": "40 cm", "formula": "0.03 - 0.01*x", "inner_formula": "0.01" },
    { "from": 0.4, "to": 0.84, "formula": "0.02" } ] },
  "weighed": { "mass": "31 oz", "first_bending_hz": 170 }
}"#;

const CSV: &str = r#"{
  "format": "sweetspot-bat/1", "material": "white-ash",
  "profile": { "csv": "profile.csv", "unit": "in", "interpolation": "pchip" }
}"#;

/// A built-in material with one number replaced.
const LIGHTER: &str = r#"{
  "format": "sweetspot-bat/1",
  "material": { "name": "white-ash-dynamic", "density": 631, "shear_modulus": "1.1 GPa" },
  "profile": { "x": [0, 0.84], "radius": [0.02, 0.02] },
  "regions": [ { "from": 0.6, "to": 0.84, "material": { "name": "sugar-maple", "loss_factor": 0.02 } } ]
}"#;

/// A wall of layers.
const LAYERED: &str = r#"{
  "format": "sweetspot-bat/1", "material": "white-ash-dynamic",
  "profile": { "x": [0, 0.84], "radius": [0.03, 0.03] },
  "regions": [ { "from": 0.5, "to": 0.84, "layers": [ { "thickness": "1 mm", "material": "aluminium-7075" } ] } ]
}"#;

/// A bat that was changed after it was weighed, in every possible way.
const EDITED: &str = r#"{
  "format": "sweetspot-bat/1", "material": "white-ash-dynamic", "weighed": { "mass": "40 oz" },
  "profile": { "x": [0, 0.84], "radius": [0.03, 0.03] },
  "edits": [
    { "shorten": { "knob": "0.4 in", "tip": 0.01 } },
    { "name": "slim", "cut": { "from": 0.5, "to": "60 cm", "depth": "1 mm", "blend": "1 in" } },
    { "scale_diameter": { "from": 0.2, "to": 0.3, "by": 0.9, "blend": 0.02 } },
    { "bore": { "from": 0.1, "to": 0.15, "diameter": "0.5 in" } },
    { "cork": { "from": 0.7, "to": 0.75, "diameter": "1 in", "material": {
        "density": 200, "youngs_modulus": "20 MPa" } } },
    { "cup": { "depth": "1 in", "diameter": 0.04 } },
    { "sleeve": { "from": 0.4, "to": 0.6, "thickness": "1 mm", "material": "aluminium-7075" } },
    { "knob": "2 oz" },
    { "wood": { "name": "sugar-maple", "density": 700 } }
  ]
}"#;

fn validator() -> Validator {
    jsonschema::draft202012::new(&of::<BatFile>()).unwrap()
}

/// The reader of bat files, in a folder with the CSV file of [`CSV`].
struct Reader(Folder);

impl Reader {
    fn new(test: &str) -> Self {
        let folder = Folder::new(&format!("bat-schema-{test}"));
        folder.write("profile.csv", "x,diameter\n0,1\n20,1.2\n33,2.6\n");
        Self(folder)
    }

    /// The objection of the reader to a bat.
    fn refusal(&self, bat: &Value) -> Option<String> {
        let read = Bat::from_text("bat.json", &bat.to_string(), &self.0.0);
        read.err().map(|error| error.to_string())
    }
}

fn parsed(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

/// Paths of all values inside one.
fn paths(value: &Value, here: &str, all: &mut Vec<String>) {
    let mut add = |key: &str, inner: &Value| {
        let path = format!("{here}/{key}");
        paths(inner, &path, all);
        all.push(path);
    };
    match value {
        Value::Object(members) => members.iter().for_each(|(key, inner)| add(key, inner)),
        Value::Array(items) => {
            items.iter().enumerate().for_each(|(k, inner)| add(&k.to_string(), inner));
        }
        _ => {}
    }
}

fn all_paths(value: &Value) -> Vec<String> {
    let mut all = vec![String::new()];
    paths(value, "", &mut all);
    all
}

/// The bat with another value at a path.
fn with(bat: &Value, path: &str, value: Value) -> Value {
    let mut changed = bat.clone();
    *changed.pointer_mut(path).unwrap() = value;
    changed
}

#[test]
fn every_bat_of_this_project_is_valid() {
    let reader = Reader::new("project");
    let root = Path::new(env!("SWEETSPOT_TOP"));
    let files = |folder: &str| {
        let entries = fs::read_dir(root.join(folder)).unwrap().map(|entry| entry.unwrap().path());
        let json = entries.filter(|path| path.extension().is_some_and(|e| e == "json"));
        json.map(|path| parsed(&fs::read_to_string(path).unwrap())).collect::<Vec<Value>>()
    };
    let mut bats = files("meshes");
    // A case contains a bat, or names one of those.
    bats.extend(
        files("validation").iter().map(|case| case["bat"].clone()).filter(Value::is_object),
    );
    bats.extend([FULL, FORMULAS, CSV, LAYERED, LIGHTER, EDITED].map(parsed));
    assert!(bats.len() > 80, "{}", bats.len());
    let validator = validator();
    for bat in &bats {
        let faults: Vec<String> = validator.iter_errors(bat).map(|e| e.to_string()).collect();
        assert!(faults.is_empty(), "{}: {faults:#?}", bat["name"]);
        assert_eq!(reader.refusal(bat), None, "{}", bat["name"]);
    }
}

#[test]
fn what_the_reader_accepts_the_schema_accepts() {
    let reader = Reader::new("accepted");
    let validator = validator();
    let strange = r#"[ 0, -0.0, -1, 1, 2, 1e-3, 1e3, 1e-30, 1e30, 1e-154, 1e154, 1e308, 0.5, "",
        "5", "5 in", " 5in ", "5. mm", "+.5E-1 m", "-3 cm", "in", "5,5 in", "0.0257 lb/in3",
        "33-1/2\"", "33½″", "½ in", "2' 9\"", "1,234 in", "1 lb 14 1/2 oz", "−3 cm",
        "1 oz·in²", "1 lbf/in/in", "/s", "7 /s", "3 µm", "4 */ m", "5 m/", "white-ash", "linear",
        "tip", "clamped", "csv", "0.02", [], [0], [0, 1], [0, "1 in"], {}, null, true ]"#;
    let strange = parsed(strange);
    let mut accepted = 0;
    for bat in [FULL, FORMULAS, CSV, LAYERED, EDITED].map(parsed) {
        let all = all_paths(&bat);
        let put = all.iter().flat_map(|path| {
            let bat = &bat;
            strange.as_array().unwrap().iter().map(move |value| with(bat, path, value.clone()))
        });
        let left_out = all.iter().filter_map(|path| {
            let (parent, key) = path.rsplit_once('/')?;
            let mut changed = bat.clone();
            changed.pointer_mut(parent)?.as_object_mut()?.remove(key)?;
            Some(changed)
        });
        for changed in put.chain(left_out) {
            if reader.refusal(&changed).is_none() {
                accepted += 1;
                let faults: Vec<String> =
                    validator.iter_errors(&changed).map(|e| e.to_string()).collect();
                assert!(faults.is_empty(), "{changed}: {faults:#?}");
            }
        }
    }
    assert!(accepted > 200, "{accepted}");
}

#[test]
fn values_of_another_type_are_refused_by_both() {
    let reader = Reader::new("types");
    let validator = validator();
    for bat in [FULL, FORMULAS, CSV, LAYERED, EDITED].map(parsed) {
        for path in all_paths(&bat) {
            for junk in [json!(null), json!(true), json!({}), json!([]), json!([[]])] {
                let changed = with(&bat, &path, junk.clone());
                let (read, valid) =
                    (reader.refusal(&changed).is_none(), validator.is_valid(&changed));
                assert_eq!(read, valid, "{path} {junk}: {:?}", reader.refusal(&changed));
            }
        }
    }
}

#[test]
fn broken_bats_are_refused_by_both() {
    let reader = Reader::new("broken");
    let validator = validator();
    let (full, formulas, csv) = (parsed(FULL), parsed(FORMULAS), parsed(CSV));
    let layered = parsed(LAYERED);
    let broken = |bat: &Value, path: &str, key: &str, value: Value| {
        let mut changed = bat.clone();
        let object = changed.pointer_mut(path).unwrap().as_object_mut().unwrap();
        match value {
            Value::Null => assert!(object.remove(key).is_some(), "{path} {key}"),
            value => {
                object.insert(key.to_owned(), value);
            }
        }
        let refused = reader.refusal(&changed);
        assert!(refused.is_some(), "the reader accepts {path} {key}");
        assert!(!validator.is_valid(&changed), "the schema accepts {path} {key}: {refused:?}");
    };
    // Missing.
    for (path, key) in [
        ("", "format"),
        ("", "material"),
        ("", "profile"),
        ("/material", "density"),
        ("/material", "youngs_modulus"),
        ("/profile", "x"),
        ("/profile", "diameter"),
        ("/regions/0", "from"),
        ("/regions/0/core", "density"),
        ("/regions/0/core", "youngs_modulus"),
        ("/attachments/0", "x"),
        ("/attachments/0", "mass"),
        ("/tapes/0", "mass"),
        ("/absorbers/0", "frequency"),
        ("/absorbers/1", "mass"),
        ("/joints/0", "rotational_stiffness"),
        ("/supports/0", "type"),
        ("/grip", "to"),
    ] {
        broken(&full, path, key, Value::Null);
    }
    broken(&layered, "/regions/0/layers/0", "thickness", Value::Null);
    broken(&layered, "/regions/0/layers/0", "material", Value::Null);
    broken(&layered, "/regions/0", "layers", json!([]));
    broken(&layered, "/regions/0", "layers", json!("aluminium-7075"));
    broken(&formulas, "/weighed", "mass", Value::Null);
    broken(&formulas, "/weighed", "first_bending_hz", Value::Null);
    broken(&formulas, "/profile/pieces/0", "formula", Value::Null);
    // An additional member.
    let column = json!([1, 2, 3]);
    for (path, key) in
        [("/profile", "radius"), ("/profile", "inner_radius"), ("/profile", "inner_diameter")]
    {
        broken(&full, path, key, column.clone());
    }
    broken(&full, "/profile", "csv", json!("profile.csv"));
    broken(&full, "/profile", "pieces", json!([{ "from": 0, "to": 1, "formula": "0.02" }]));
    broken(&full, "/absorbers/0", "stiffness", json!(1000));
    broken(&csv, "/profile", "wall_thickness", column.clone());
    broken(&csv, "/profile", "x", column);
    broken(&formulas, "/profile", "unit", json!("in"));
    broken(&formulas, "/profile", "interpolation", json!("linear"));
    broken(&formulas, "", "regions", json!([]));
    broken(&formulas, "/material", "shear_modulus", json!(1e9));
    // Another version, another word, a number without a unit.
    broken(&full, "", "format", json!("sweetspot-bat/2"));
    broken(&full, "", "format", json!("sweetspot-modes/1"));
    broken(&full, "", "material", json!("oak"));
    broken(&full, "/profile", "interpolation", json!("spline"));
    broken(&full, "/supports/0", "type", json!("fixed"));
    broken(&full, "/grip", "stiffness", json!("100000"));
    broken(&full, "/profile", "x", json!([1, 400, 840]));
    for path in all_paths(&full).iter().filter(|path| full.pointer(path).unwrap().is_object()) {
        broken(&full, path, "colour", json!("red"));
    }
}

/// Objects of the schema (its definitions, and itself as "") and where they are in [`FULL`],
/// [`FORMULAS`], [`LAYERED`] and [`EDITED`].
const PLACES: [(&str, &str); 24] = [
    ("", ""),
    ("MaterialNumbers", "/material"),
    ("MaterialNumbers", "/regions/0/core"),
    ("ShearModuli", "/material/shear_moduli"),
    ("PoissonRatios", "/material/poisson_ratios"),
    ("Profile", "/profile"),
    ("Weighed", "/weighed"),
    ("Region", "/regions/0"),
    ("Layer", "/regions/0/layers/0"),
    ("Attachment", "/attachments/0"),
    ("Tape", "/tapes/0"),
    ("Absorber", "/absorbers/0"),
    ("Joint", "/joints/0"),
    ("Support", "/supports/0"),
    ("Grip", "/grip"),
    ("Piece", "/profile/pieces/0"),
    ("Edit", "/edits/7"),
    ("Shorten", "/edits/0/shorten"),
    ("Cut", "/edits/1/cut"),
    ("ScaleDiameter", "/edits/2/scale_diameter"),
    ("Bore", "/edits/3/bore"),
    ("Cork", "/edits/4/cork"),
    ("Cup", "/edits/5/cup"),
    ("Sleeve", "/edits/6/sleeve"),
];

/// The bat that contains such an object.
fn holder((name, place): (&str, &str)) -> Value {
    parsed(match (name, place) {
        ("Piece", _) => FORMULAS,
        ("Layer", _) => LAYERED,
        _ if place.starts_with("/edits") => EDITED,
        _ => FULL,
    })
}

fn definition<'a>(schema: &'a Value, name: &str) -> &'a Value {
    if name.is_empty() { schema } else { &schema["$defs"][name] }
}

#[test]
fn reader_and_schema_know_the_same_members() {
    let reader = Reader::new("members");
    let schema = of::<BatFile>();
    for (name, place) in PLACES {
        let mut bat = holder((name, place));
        bat.pointer_mut(place).unwrap()["qqqqqqqqqqqq"] = json!(1);
        let said = reader.refusal(&bat).unwrap();
        let (_, known) = said.split_once("expected one of ").expect(&said);
        // A remark is allowed everywhere.
        let mut known: BTreeSet<&str> = known.trim().split(", ").collect();
        known.insert("comment");
        let members = definition(&schema, name)["properties"].as_object().unwrap();
        let described: BTreeSet<&str> = members.keys().map(String::as_str).collect();
        assert_eq!(described, known, "{name}");
        assert_eq!(definition(&schema, name)["additionalProperties"], false, "{name}");
    }
    let with_members = |value: &&Value| value.get("properties").is_some();
    let objects = schema["$defs"].as_object().unwrap().values().filter(with_members).count() + 1;
    let tried: BTreeSet<&str> = PLACES.iter().map(|(name, _)| *name).collect();
    assert_eq!(tried.len(), objects);
}

#[test]
fn a_named_material_keeps_what_is_not_said_of_it() {
    let read = |text: &str| Bat::from_text("bat.json", text, Path::new("")).unwrap();
    let [bat, named] = [LIGHTER, &LIGHTER.replace(", \"density\": 631", "")].map(read);
    let ash = Material::named("white-ash-dynamic").unwrap();
    assert_eq!((bat.material().density, named.material().density), (631.0, ash.density));
    assert_eq!(bat.material().youngs_modulus, ash.youngs_modulus);
    assert_eq!(bat.material().shear_modulus, Some(1.1e9));
    let maple = Material::named("sugar-maple").unwrap();
    let region = &bat.layups()[1].outer;
    assert_eq!((region.density, region.loss_factor), (maple.density, 0.02));
    let wrong = LIGHTER.replace("white-ash-dynamic", "white-oak");
    let said = Bat::from_text("bat.json", &wrong, Path::new("")).unwrap_err().to_string();
    assert!(said.contains("material.name: found \"white-oak\""), "{said}");
}

#[test]
fn a_remark_is_a_text_or_a_list_of_texts() {
    let validator = validator();
    for (name, place) in PLACES {
        let bat = holder((name, place));
        for (remark, right) in [
            (json!("turned by hand"), true),
            (json!(["measured twice", "and once more"]), true),
            (json!([]), true),
            (json!(3), false),
            (json!(null), false),
            (json!([1]), false),
            (json!({ "en": "no" }), false),
        ] {
            let mut bat = bat.clone();
            bat.pointer_mut(place).unwrap()["comment"] = remark.clone();
            assert_eq!(validator.is_valid(&bat), right, "{place} {remark}");
        }
    }
}

#[test]
fn every_bound_of_the_schema_is_the_readers() {
    let reader = Reader::new("bounds");
    let (schema, validator) = (of::<BatFile>(), validator());
    let mut tried = 0;
    let mut agree = |bat: &Value, path: &str, value: f64, right: bool| {
        // A member that the bat does not have, in place of the other one.
        let mut changed = bat.clone();
        // A pointed end bears none of these.
        if ["/attachments", "/absorbers", "/supports"].iter().any(|list| path.starts_with(list)) {
            changed["profile"]["diameter"][0] = json!(2);
            changed["profile"]["wall_thickness"][0] = json!(1);
        }
        let (parent, key) = path.rsplit_once('/').unwrap();
        let parent = changed.pointer_mut(parent).unwrap();
        if path == "/absorbers/0/stiffness" {
            parent.as_object_mut().unwrap().remove("frequency");
        }
        if path == "/weighed/pendulum_pivot" {
            parent["pendulum_period"] = json!(1.47);
        }
        match parent {
            Value::Array(items) => items[key.parse::<usize>().unwrap()] = json!(value),
            object => object[key] = json!(value),
        }
        let refused = reader.refusal(&changed);
        assert_eq!(refused.is_none(), right, "reader, {path} = {value:e}: {refused:?}");
        assert_eq!(validator.is_valid(&changed), right, "schema, {path} = {value:e}");
        tried += 1;
    };
    for (name, place) in PLACES {
        let mut bat = holder((name, place));
        if let Some(weighed) = bat["weighed"].as_object_mut() {
            // An added mass moves the balance point, which is not tested here.
            weighed.shift_remove("balance_point");
        }
        for (key, member) in definition(&schema, name)["properties"].as_object().unwrap() {
            let column = member["items"].get("minimum").is_some();
            if column && bat.pointer(&format!("{place}/{key}")).is_none() {
                continue;
            }
            let bounds = if column { &member["items"] } else { member };
            let path = if column { format!("{place}/{key}/0") } else { format!("{place}/{key}") };
            let bound = |key: &str| bounds[key].as_f64();
            let off = |bound: f64| if bound == 0.0 { 1e-9 } else { 0.5 * bound.abs() };
            for (lower, step) in [("inimum", -1.0), ("aximum", 1.0)] {
                if let Some(at) = bound(&format!("m{lower}")) {
                    agree(&bat, &path, at, true);
                    agree(&bat, &path, at + step * off(at), false);
                }
                if let Some(at) = bound(&format!("exclusiveM{lower}")) {
                    agree(&bat, &path, at, false);
                    agree(&bat, &path, at + step * off(at), false);
                }
            }
        }
    }
    assert!(tried > 60, "{tried}");
}

#[test]
fn the_schema_of_a_ball_says_what_the_reader_of_balls_does() {
    let folder = Folder::new("ball-schema");
    let validator = jsonschema::draft202012::new(&of::<BallFile>()).unwrap();
    let ball = json!({ "format": "sweetspot-ball/1", "comment": "made up", "name": "ball",
        "source": "nowhere", "mass": "5.1 oz", "radius": 0.0366, "stiffness": 6.5e7,
        "exponent": 1.8, "cor": 0.5, "cor_by_speed": [["58 mph", 0.5], [40, 0.45]] });
    let agree = |ball: &Value, right: bool| {
        folder.write("ball.json", ball.to_string());
        let read = Ball::from_file(folder.0.join("ball.json"));
        assert_eq!(read.is_ok(), right, "reader, {ball}: {read:?}");
        assert_eq!(validator.is_valid(ball), right, "schema, {ball}");
    };
    agree(&ball, true);
    let linear = json!({ "format": "sweetspot-ball/1", "mass": 0.1, "radius": 0.03,
        "stiffness": 1e6, "exponent": 1, "damping_ratio": 0.1 });
    agree(&linear, true);
    for (of, key, value, right) in [
        (&ball, "format", Value::Null, false),
        (&ball, "format", json!("sweetspot-bat/1"), false),
        (&ball, "mass", Value::Null, false),
        (&ball, "mass", json!(0), false),
        (&ball, "mass", json!("5"), false),
        (&ball, "radius", Value::Null, false),
        (&ball, "radius", json!(-0.03), false),
        (&ball, "stiffness", Value::Null, true),
        (&ball, "stiffness", json!(0), false),
        (&ball, "exponent", json!("1.8"), false),
        (&ball, "cor", Value::Null, true),
        (&ball, "cor", json!(0), true),
        (&ball, "cor", json!(1.01), false),
        (&ball, "cor_by_speed", Value::Null, true),
        (&ball, "cor_by_speed", json!([]), false),
        (&ball, "cor_by_speed", json!([[-1, 0.5]]), false),
        (&ball, "cor_by_speed", json!([[1, 1.5]]), false),
        (&ball, "cor_by_speed", json!([[1]]), false),
        (&ball, "cor_by_speed", json!([[1, 0.5, 2]]), false),
        (&ball, "damping_ratio", json!(0.1), false),
        (&ball, "colour", json!("red"), false),
        (&linear, "exponent", json!(1.8), false),
        (&linear, "exponent", Value::Null, true),
        (&linear, "damping_ratio", json!(1), false),
        (&linear, "damping_ratio", json!(0), true),
        (&linear, "damping_ratio", Value::Null, false),
    ] {
        let mut changed = of.clone();
        let members = changed.as_object_mut().unwrap();
        match value {
            Value::Null => _ = members.shift_remove(key),
            value => _ = members.insert(key.to_owned(), value),
        }
        agree(&changed, right);
    }
}
