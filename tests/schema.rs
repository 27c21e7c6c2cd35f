//! Documents match their schemas, and the schemas are valid.

use crate::common;

use std::fs;
use std::path::Path;

use common::documents::{WRITTEN, error, folder, manifest, page, written};
use common::folder::Folder;
use jsonschema::Validator;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};
use sweetspot::bat::theory::Theory;
use sweetspot::collision::ball::Ball;
use sweetspot::collision::energy_loss::EnergyLoss;
use sweetspot::collision::figures::{Figures, SwingLaw};
use sweetspot::collision::hit::{Effort, Model, Scene, Wall};
use sweetspot::collision::hitter::Hitter;
use sweetspot::collision::pulse::Pulse;
use sweetspot::collision::sweep::{Accuracy, sweep};
use sweetspot::files::schema::bat::BatFile;
use sweetspot::modes::solve::Solver;
use sweetspot::{Bat, Request, solve};
use sweetspot_proof::bundled::CASES;
use sweetspot_report::formats::{self, FileKind};
use sweetspot_report::report::hit_json;
use sweetspot_report::report::json::{self, ShapePoints};
use sweetspot_report::schema::hit::HitFile;
use sweetspot_report::schema::modes::ModesFile;
use sweetspot_report::schema::{self, of};

/// A bat with everything on it and under it, damped by all that damps.
const FULL: &str = include_str!("golden/bat-1.json");

/// The value of a member in other kinds of bats.
const OTHERS: [(&str, &str); 4] = [
    // Without dashpots, with a single loss factor.
    (
        "lossy",
        r#"{ "format": "sweetspot-bat/1", "profile": { "x": [0, 0.8], "radius": [0.02, 0.03] },
             "material": { "density": 700, "youngs_modulus": 14e9, "loss_factor": 0.02 } }"#,
    ),
    // Dashpots so weak that each mode is treated separately, and rigid motions that only they restrain.
    (
        "dashpots",
        r#"{ "format": "sweetspot-bat/1", "profile": { "x": [0, 0.8], "radius": [0.02, 0.03] },
             "material": "white-ash", "grip": { "from": 0, "to": 0.2, "damping": 1e-3 } }"#,
    ),
    (
        "clamped",
        r#"{ "format": "sweetspot-bat/1", "profile": { "x": [0, 0.8], "radius": [0.02, 0.03] },
             "material": "white-ash", "supports": [ { "x": 0, "type": "clamped" } ] }"#,
    ),
    (
        "formulas",
        r#"{ "format": "sweetspot-bat/1", "material": { "density": 700 },
             "weighed": { "mass": "31 oz", "balance_point": 0.5, "first_bending_hz": 170 },
             "profile": { "measured_from": "tip", "pieces": [
               { "from": 0, "to": 0.4, "formula": "0.03", "inner_formula": "0.01" },
               { "from": 0.4, "to": 0.84, "formula": "0.02" } ] } }"#,
    ),
];

fn validator(schema: &Value) -> Validator {
    jsonschema::draft202012::new(schema).unwrap()
}

fn faults(validator: &Validator, document: &Value) -> Vec<String> {
    let told = |e: jsonschema::ValidationError| format!("{}: {e}", e.instance_path());
    validator.iter_errors(document).map(told).collect()
}

fn assert_valid(validator: &Validator, document: &Value, what: &str) {
    let faults = faults(validator, document);
    assert!(faults.is_empty(), "{what}: {faults:#?}");
}

/// A document read into its type and written again is unchanged.
fn assert_typed<T: Serialize + DeserializeOwned>(document: &Value, what: &str) {
    let typed: T = serde_json::from_value(document.clone()).expect(what);
    let again = serde_json::to_string(&schema::value(&typed)).unwrap();
    assert_eq!(again, document.to_string(), "{what}");
}

fn bats() -> Vec<(String, Bat)> {
    let folder = Path::new(env!("SWEETSPOT_TOP")).join("meshes");
    let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut bats: Vec<(String, Bat)> =
        files.map(|path| (path.display().to_string(), Bat::from_file(&path).unwrap())).collect();
    let texts = OTHERS.into_iter().chain([("full", FULL)]);
    let read = |text: &str| Bat::from_text("bat.json", text, Path::new("")).unwrap();
    bats.extend(texts.map(|(name, text)| (name.to_owned(), read(text))));
    bats
}

#[test]
fn every_schema_is_one_by_its_drafts_own() {
    for (name, schema) in FileKind::ALL.map(|file| (file.name(), file.schema())) {
        let checked = jsonschema::draft202012::meta::validate(&schema);
        assert!(checked.is_ok(), "{name}: {:?}", checked.err());
        assert_eq!(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
        assert_eq!(schema["$id"], format!("urn:sweetspot:{name}:1"));
        assert!(schema["title"].as_str().unwrap().contains(&format!("sweetspot-{name}/1")));
        assert!(schema["description"].as_str().unwrap().len() > 100);
    }
    assert!(jsonschema::draft202012::meta::is_valid(&formats::all()));
}

#[test]
fn no_member_is_left_without_a_word_but_those_whose_name_says_it() {
    const PLAIN: [&str; 6] = ["name", "program", "exponent", "x", "from", "mass"];
    let told = |schema: &Value, member: &Value| {
        let reference = member["$ref"].as_str().and_then(|r| r.strip_prefix("#/$defs/"));
        let of_type = reference.map(|name| &schema["$defs"][name]["description"]);
        member["description"].is_string() || of_type.is_some_and(Value::is_string)
    };
    for file in FileKind::ALL {
        let schema = file.schema();
        let definitions = schema["$defs"].as_object().unwrap().values();
        for object in definitions.chain([&schema]) {
            let Some(members) = object["properties"].as_object() else { continue };
            for (name, member) in members {
                let either = member["anyOf"].as_array().into_iter().flatten();
                let said = told(&schema, member) || either.into_iter().any(|m| told(&schema, m));
                assert!(said || PLAIN.contains(&name.as_str()), "{}: {name}", file.name());
            }
        }
    }
}

#[test]
fn modes_of_all_kinds_of_bats_are_valid() {
    let [bat_file, modes_file] = [of::<BatFile>(), of::<ModesFile>()].map(|s| validator(&s));
    let all = validator(&formats::all());
    let request = |modes: usize, theory: Theory, solver: Solver| Request {
        modes,
        theory,
        solver,
        tolerance: 1e-5,
        ..Request::default()
    };
    let [plain, turning] = [Theory::EulerBernoulli, Theory::Rayleigh];
    let mut kinds = std::collections::BTreeSet::new();
    for (name, bat) in bats() {
        for (modes, theory, points, timing) in [
            (3, plain, ShapePoints::Even(5), true),
            (2, turning, ShapePoints::Nodes, false),
            (0, plain, ShapePoints::Even(0), false),
        ] {
            let solution = solve(&bat, &request(modes, theory, Solver::Statics)).unwrap();
            let document = schema::value(&json::modes(&bat, &solution, points, timing));
            assert_valid(&modes_file, &document, &name);
            assert_valid(&all, &document, &name);
            assert_valid(&bat_file, &document["bat"], &name);
            assert_typed::<ModesFile>(&document, &name);
            let kind = format!("{:?}", solution.damping.kind);
            kinds.insert(kind.split('(').next().unwrap_or_default().to_owned());
        }
    }
    // Undamped, materials alone, mode by mode, complex.
    assert_eq!(kinds.len(), 4, "{kinds:?}");
    let dowel = Bat::builtin("dowel").unwrap();
    for solver in [Solver::Dense, Solver::ShiftInvert] {
        let solution = solve(&dowel, &request(3, plain, solver)).unwrap();
        let document = json::modes(&dowel, &solution, ShapePoints::Even(1), false);
        let document = schema::value(&document);
        assert_valid(&modes_file, &document, "another solver");
    }
    let r161 = Bat::builtin("r161").unwrap();
    let solution = solve(&r161, &request(2, Theory::Timoshenko, Solver::Statics)).unwrap();
    let document = schema::value(&json::modes(&r161, &solution, ShapePoints::Even(2), false));
    assert_valid(&modes_file, &document, "timoshenko");
}

#[test]
fn hits_of_all_models_are_valid_and_so_are_those_that_come_to_nothing() {
    let schemas = [of::<HitFile>(), formats::all()].map(|schema| validator(&schema));
    let still = Scene { swing: 0.0, ball_speed: 0.0, ..Scene::default() };
    let mut known = Scene { wall: Some(Wall { stiffness: 5e6, mass: 0.05 }), ..Scene::default() };
    known.ball.cor_by_speed = vec![[20.0, 0.55], [40.0, 0.5]];
    let soft = Scene { ball: Ball::softball(), cor: 0.44, ..Scene::default() };
    let wild = Model::EnergyLoss(EnergyLoss { gamma: 90.0, decay: 0.0 });
    let pulse = Model::Pulse(Pulse::default());
    let (mut nothing, mut figured) = (0, 0);
    let some = ["r161.json", "dashpots", "formulas", "full"];
    let chosen = |name: &str| some.iter().any(|end| name.ends_with(end));
    for (name, bat) in bats().into_iter().filter(|(name, _)| chosen(name)) {
        let held = bat.fixtures().holding();
        for (model, scene) in [
            (Model::Contact, &Scene::default()),
            (Model::Contact, &still),
            (Model::Contact, &known),
            (Model::Rigid, &soft),
            (Model::EnergyLoss(EnergyLoss::default()), &Scene::default()),
            (wild, &Scene::default()),
            (pulse, &Scene::default()),
            (pulse, &still),
        ] {
            if held && matches!(model, Model::EnergyLoss(_)) {
                continue;
            }
            let accuracy = Accuracy { exit_speed: 1e-2, modes: Some(3), ..Accuracy::plain() };
            let places = [0.6 * bat.length(), bat.length()];
            let hits = sweep(&bat, model, scene, &accuracy, &places).unwrap();
            let law = SwingLaw { exponent: 0.3, reference: 0.2, of_reference: 50.0 };
            let law = (model == Model::Rigid).then_some(law);
            let effort = Effort { completed: false, ..hits.effort };
            let hitter = Hitter::new(model, scene, &bat, &hits.solution, effort).unwrap();
            let figures = Figures::new(&bat, &hitter, law).unwrap();
            let mut hit = hit_json::hit(&bat, model, scene, &hits.impacts, &figures.spot);
            let document = schema::value(&hit);
            schemas.iter().for_each(|schema| assert_valid(schema, &document, &name));
            hit.figures = Some(hit_json::figures(&figures));
            let document = schema::value(&hit);
            schemas.iter().for_each(|schema| assert_valid(schema, &document, &name));
            assert_typed::<HitFile>(&document, &name);
            nothing += usize::from(document["impacts"][0]["energy_j"].is_null());
            figured += document["figures"]["swings"].as_array().unwrap().len();
        }
    }
    assert!(nothing >= 8 && figured >= 8, "{nothing} {figured}");
}

#[test]
fn the_program_prints_the_schemas_and_writes_what_they_say() {
    let folder = folder("schema");
    for file in FileKind::ALL {
        assert_eq!(folder.json(&["schema", file.name()]), file.schema());
    }
    assert_eq!(folder.json(&["schema"]), formats::all());
    let all = validator(&formats::all());
    let documents = WRITTEN.map(|document| (document.1, written(&folder, document)));
    let others =
        [("page", page(&folder)), ("error", error(&folder)), ("study-manifest", manifest(&folder))];
    for (format, document) in documents.into_iter().chain(others) {
        assert_eq!(document["format"], format!("sweetspot-{format}/1"));
        assert_valid(&validator(&kind(format).schema()), &document, format);
        assert_valid(&all, &document, format);
    }
}

#[test]
fn every_format_is_written_and_pinned_or_read() {
    let others = [
        "page",
        "error",
        "study-manifest",
        "bat",
        "ball",
        "study",
        "aim",
        "rules",
        "readings",
        "scatter",
        "validation",
    ];
    for file in FileKind::ALL {
        let written = WRITTEN.iter().any(|document| document.1 == file.name());
        let known = written || others.contains(&file.name());
        assert!(known, "{}", file.name());
    }
}

#[test]
fn every_case_of_known_answers_ball_and_study_of_this_project_is_valid() {
    let case = validator(&kind("validation").schema());
    for (name, text) in CASES {
        assert_valid(&case, &serde_json::from_str(text).unwrap(), name);
    }
    let ball = serde_json::from_str(include_str!("golden/ball-1.json")).unwrap();
    assert_valid(&validator(&kind("ball").schema()), &ball, "ball");
    let study = serde_json::from_str(include_str!("golden/study-1.json")).unwrap();
    assert_valid(&validator(&kind("study").schema()), &study, "study");
    let aim = serde_json::from_str(include_str!("golden/aim-1.json")).unwrap();
    assert_valid(&validator(&kind("aim").schema()), &aim, "aim");
    for (name, text) in sweetspot_study::files::rules_file::BUILT_IN {
        let rules = serde_json::from_str(text).unwrap();
        assert_valid(&validator(&kind("rules").schema()), &rules, name);
    }
    let readings = serde_json::from_str(include_str!("golden/readings-1.json")).unwrap();
    assert_valid(&validator(&kind("readings").schema()), &readings, "readings");
    let scatter = serde_json::from_str(include_str!("golden/scatter-1.json")).unwrap();
    assert_valid(&validator(&kind("scatter").schema()), &scatter, "scatter");
}

fn kind(name: &str) -> FileKind {
    FileKind::ALL.into_iter().find(|file| file.name() == name).unwrap()
}

#[test]
fn outputs_may_grow_but_not_lose_a_member_change_a_type_or_be_of_another_version() {
    let all = validator(&formats::all());
    let written = WRITTEN.map(|document| (document.0, document.1));
    let others = ["error", "study-manifest"].map(|name| (name, name));
    for (name, format) in written.into_iter().chain(others) {
        let path = format!("{}/tests/golden/{name}-1.json", env!("SWEETSPOT_TOP"));
        let document: Value = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
        let validator = validator(&kind(format).schema());
        assert_valid(&validator, &document, name);
        let mut refused = 0;
        each_object(&document, "", &mut |path, members| {
            let mut grown = document.clone();
            grown.pointer_mut(path).unwrap()["later"] = json!({ "is": "new" });
            // Bats admit no additional members, because these would make it another bat; the figures of a comparison
            // may be any number of figures, as the changes of a lathe map may be numbers.
            let numbers = |path: &str| {
                let last = path.rsplit('/').next().unwrap_or_default();
                let changes = ["error", "finite", "same_energy", "by_law", "curves", "per_g"];
                last.starts_with("change") || changes.contains(&last)
            };
            let figures = path.starts_with("/bats/") && path.ends_with("/figures");
            if !(figures || name == "lathe" && numbers(path)) {
                assert_valid(&validator, &grown, path);
            }
            for (key, value) in members {
                let mut other = document.clone();
                let object = other.pointer_mut(path).unwrap();
                object[key] = match value {
                    Value::Object(_) => json!([]),
                    Value::Array(_) => json!({}),
                    _ => json!({ "another": "type" }),
                };
                let [one, both] = [&validator, &all].map(|schema| faults(schema, &other).len());
                assert!(one > 0 && both > 0, "{path}/{key}");
                refused += 1;
            }
        });
        assert!(refused > 8, "{name}: {refused}");
        for version in ["/2", "/10", "", "/1.1"] {
            let mut other = document.clone();
            other["format"] = json!(format!("sweetspot-{format}{version}"));
            assert!(!validator.is_valid(&other) && !all.is_valid(&other), "{version}");
        }
    }
}

fn each_object(
    value: &Value,
    path: &str,
    see: &mut dyn FnMut(&str, &serde_json::Map<String, Value>),
) {
    if let Some(members) = value.as_object() {
        see(path, members);
        for (key, inner) in members {
            each_object(inner, &format!("{path}/{key}"), see);
        }
    }
    for (k, inner) in value.as_array().into_iter().flatten().enumerate() {
        each_object(inner, &format!("{path}/{k}"), see);
    }
}

/// A nearly dead ball, whose best place depends on a later contact; a dented wall; a bat of implausible density: the
/// format has a member for each of these doubts.
#[test]
fn doubts_are_those_of_the_format() {
    let folder = Folder::new("schema-doubts");
    let schema = validator(&kind("analysis").schema());
    let mut seen = std::collections::BTreeSet::new();
    for bat in
        [&["r161", "--cor", "0.3"][..], &["bbcor_made_up"], &["northwestern_aluminium"], &["dowel"]]
    {
        let args = [&["analyze"], bat, &["--json", "-", "--quiet"]].concat();
        let document = folder.json(&args);
        assert_valid(&schema, &document, bat[0]);
        let doubts = document["open"]["doubts"].as_array().unwrap();
        seen.extend(doubts.iter().map(|doubt| doubt["about"].as_str().unwrap().to_owned()));
    }
    for about in ["later_contact", "ball_law", "dent", "density", "shear"] {
        assert!(seen.contains(about), "{about}: {seen:?}");
    }
}
