//! The advisor: effects compared with exact ones, their signs, and a smallest model that is indeed sufficient.

use crate::common;

use std::path::Path;

use common::folder::Folder;
use serde_json::{Value, json};
use sweetspot::bat::theory::Theory;
use sweetspot::beam::dowel::{Ends, beta_l};
use sweetspot::{Bat, Request, solve};
use sweetspot_proof::bundled::{CASES, bundled_bat};
use sweetspot_study::advise::advice::{Advice, advise};
use sweetspot_study::advise::effect::{Effect, Switch};
use sweetspot_study::advise::part::ModelPart;

fn read(document: &Value) -> Bat {
    Bat::from_text("bat.json", &document.to_string(), Path::new("")).unwrap()
}

/// The bat of a known answer, and its frequencies (Hz).
fn case(name: &str) -> (Bat, Vec<f64>) {
    let (_, text) = CASES.iter().find(|(known, _)| *known == name).unwrap();
    let case: Value = serde_json::from_str(text).unwrap();
    let checks = case["checks"].as_array().unwrap().iter();
    let known = checks.filter(|check| check["quantity"] == "frequency_hz");
    (read(&case["bat"]), known.map(|check| check["expected"].as_f64().unwrap()).collect())
}

/// The dowel of a known answer with more keys.
fn dowel(name: &str, more: Value) -> Bat {
    let (_, text) = CASES.iter().find(|(known, _)| *known == name).unwrap();
    let mut bat = serde_json::from_str::<Value>(text).unwrap()["bat"].take();
    for (key, value) in more.as_object().unwrap() {
        bat[key] = value.clone();
    }
    read(&bat)
}

fn row(advice: &Advice, switch: Switch) -> &Effect {
    advice.effects.iter().find(|effect| effect.switch == switch).expect("a row")
}

fn switches(advice: &Advice) -> Vec<Switch> {
    advice.effects.iter().map(|effect| effect.switch).collect()
}

/// Frequencies of Euler and Bernoulli's dowel in closed form (Hz).
fn plain(bat: &Bat, n: usize) -> f64 {
    let radius = bat.profile().at(0.1).outer;
    let material = bat.material();
    let stiffness = material.youngs_modulus * radius * radius / (4.0 * material.density);
    let wave = beta_l(Ends::FreeFree, n) / bat.length();
    wave * wave * stiffness.sqrt() / std::f64::consts::TAU
}

#[test]
fn rotary_inertia_and_shear_of_the_dowel_do_what_the_exact_frequencies_say() {
    let (bat, timoshenko) = case("timo_dowel");
    let (_, rayleigh) = case("rayleigh_dowel");
    let advice = advise(&bat, 5, 1e-2).unwrap();
    let rows = [Switch::RotaryInertia, Switch::Shear, Switch::Theory].map(|s| row(&advice, s));
    for k in 0..5 {
        let plain = plain(&bat, k + 1);
        let exact = [rayleigh[k] / plain, timoshenko[k] / rayleigh[k], timoshenko[k] / plain];
        for (effect, exact) in rows.iter().zip(exact) {
            let [shift, error] = effect.shift(k).unwrap();
            let off = (shift - (exact - 1.0)).abs();
            // The promise of every stated error: three times; and it is far below the effect.
            assert!(off <= 3.0 * error, "{:?} {}: {off}", effect.switch, k + 1);
            assert!(error < 1e-7 * shift.abs(), "{:?} {}", effect.switch, k + 1);
            assert!(shift < 0.0);
        }
    }
}

#[test]
fn what_a_bat_does_not_have_has_no_row() {
    let theory = [Switch::RotaryInertia, Switch::Shear, Switch::Theory];
    let r161 = bundled_bat("meshes/r161.json").unwrap();
    assert_eq!(switches(&advise(&r161, 3, 1e-2).unwrap()), theory);
    // Springs without stiffness and weights without mass are ignored.
    let nothing = json!({ "attachments": [{ "x": 0.5, "mass": 0, "stiffness": 0 }],
        "grip": { "from": 0, "to": 0.1, "damping": 300 } });
    let advice = advise(&dowel("timo_dowel", nothing), 3, 1e-2).unwrap();
    assert_eq!(switches(&advice), theory);
    assert_eq!(advice.damping.dashpots.len(), 1);
    let weight = json!({ "attachments": [{ "x": 0.5, "mass": 0.1 }] });
    let advice = advise(&dowel("timo_dowel", weight), 3, 1e-2).unwrap();
    assert_eq!(switches(&advice)[3..], [Switch::Part(ModelPart::Weights)]);
    // Unknown shear is estimated, and no model includes it.
    let unknown = advise(&bundled_bat("meshes/dowel.json").unwrap(), 3, 1e-2).unwrap();
    assert_eq!(switches(&unknown), [Switch::RotaryInertia, Switch::TypicalShear]);
    assert_eq!(unknown.full_model.solved.model.theory, Theory::Rayleigh);
    assert!(unknown.unknown_shear().unwrap() > 1e-2);
    assert_eq!(advice.unknown_shear(), None);
}

/// Everything at once: every kind has a row, in a fixed order, and the attached parts together have one more.
#[test]
fn everything_on_a_bat_has_its_row_and_its_sign() {
    let region = json!({ "from": 0.5, "to": 0.7, "material": { "density": 800,
        "youngs_modulus": 20e9, "shear_modulus": 1e9 } });
    let everything = json!({
        "regions": [region],
        "attachments": [{ "x": 0.8, "mass": 0.1, "offset": 0.01, "rotary_inertia": 1e-5 },
            { "x": 0.3, "stiffness": 1e5 }],
        "tapes": [{ "from": 0, "to": 0.25, "mass": 0.02 }],
        "absorbers": [{ "x": 0.4, "mass": 0.01, "frequency": 5000 }],
        "joints": [{ "x": 0.35, "rotational_stiffness": 1e4 }],
        "supports": [{ "x": 0, "type": "clamped" }],
        "grip": { "from": 0.02, "to": 0.15, "stiffness": 4e5, "damping": 300 }
    });
    let advice = advise(&dowel("timo_dowel", everything), 4, 1e-6).unwrap();
    let parts = switches(&advice)[3..].to_vec();
    let part = Switch::Part;
    let expected = [
        part(ModelPart::Materials),
        part(ModelPart::Weights),
        part(ModelPart::Tapes),
        part(ModelPart::Springs),
        part(ModelPart::Absorbers),
        part(ModelPart::Joints),
        part(ModelPart::Supports),
        Switch::Attachments,
        part(ModelPart::Grip),
    ];
    assert_eq!(parts, expected);
    assert_eq!(advice.full_model.solved.model.parts, ModelPart::ALL);
    // λ rises with every stiffness and falls with every mass: Rayleigh's quotient. An absorber far
    // above the modes is a mass.
    for (part, sign) in [
        (ModelPart::Weights, -1.0),
        (ModelPart::Tapes, -1.0),
        (ModelPart::Springs, 1.0),
        (ModelPart::Absorbers, -1.0),
        (ModelPart::Joints, -1.0),
        (ModelPart::Grip, 1.0),
    ] {
        for k in 0..4 {
            let [shift, error] = row(&advice, Switch::Part(part)).shift(k).unwrap();
            assert!(sign * shift >= -error, "{part:?}: {shift:?}");
        }
        assert!(row(&advice, Switch::Part(part)).largest().unwrap() > 1e-5, "{part:?}");
    }
    for switch in [Switch::RotaryInertia, Switch::Shear, Switch::Theory] {
        let shifts = row(&advice, switch).shift_by_mode.as_ref().unwrap();
        assert!(shifts.iter().all(|shift| *shift < 0.0), "{switch:?}");
    }
    // Without its clamp the bat rotates on spring and bed. The modes are still the same ones: the number of rigid
    // motions does not change, and the clamp only stiffens.
    let clamp = row(&advice, Switch::Part(ModelPart::Supports));
    assert_eq!(clamp.without.solution.rigid_modes, 0);
    assert!(clamp.shift_by_mode.as_ref().unwrap().iter().all(|shift| *shift > 0.0));
    // The weights are 0.13 kg with the absorber and the tape.
    let body = |switch: Switch| row(&advice, switch).mass_kg;
    assert!((body(Switch::Part(ModelPart::Weights)) - 0.1).abs() < 1e-14);
    assert!((body(Switch::Attachments) - 0.13).abs() < 1e-14);
    assert_eq!(body(Switch::Part(ModelPart::Grip)), 0.0);
}

/// One mass, or one spring, moves a frequency at most to its neighbour (Cauchy, Weyl).
#[test]
fn one_mass_and_one_spring_move_a_frequency_at_most_to_its_neighbour() {
    let held = json!([{ "x": 0, "type": "clamped" }]);
    for (attachment, up) in [
        (json!({ "x": 0.7, "mass": 0.5 }), false),
        (json!({ "x": 0.7, "mass": 1e4 }), false),
        (json!({ "x": 0.6, "stiffness": 1e5 }), true),
        (json!({ "x": 0.6, "rotational_stiffness": 1e9 }), true),
    ] {
        let more = json!({ "attachments": [attachment], "supports": held });
        let advice = advise(&dowel("timo_dowel", more), 6, 1e-2).unwrap();
        let part = if up { ModelPart::Springs } else { ModelPart::Weights };
        let effect = row(&advice, Switch::Part(part));
        let [with, without] = [&effect.with, &effect.without].map(|solved| &solved.frequencies_hz);
        for k in 0..6 {
            let slack = 1e-9;
            let (low, high) = match up {
                true => (without[k], without.get(k + 1).copied().unwrap_or(f64::INFINITY)),
                false => (if k > 0 { without[k - 1] } else { 0.0 }, without[k]),
            };
            let inside = (low * (1.0 - slack)..=high * (1.0 + slack)).contains(&with[k]);
            assert!(inside, "{attachment} {}: {low} {} {high}", k + 1, with[k]);
        }
    }
}

/// With hands, a support and a slow absorber the modes are different ones: both lists are given, but no shift.
#[test]
fn modes_of_a_bat_held_otherwise_are_not_paired() {
    let (grip, exact) = case("grip_bed");
    let advice = advise(&grip, 5, 0.5).unwrap();
    let effect = row(&advice, Switch::Part(ModelPart::Grip));
    assert!(effect.shift_by_mode.is_none() && effect.largest().is_none());
    assert_eq!(effect.with.solution.rigid_modes, 0);
    assert_eq!(effect.without.solution.rigid_modes, 2);
    let (_, rayleigh) = case("rayleigh_dowel");
    for (f, exact) in effect.without.frequencies_hz.iter().zip(&rayleigh) {
        assert!((f / exact - 1.0).abs() < 3e-10, "{f} {exact}");
    }
    // Hands stay in the smallest model, however large the tolerance; rotary inertia does not.
    let smallest = &advice.smallest_model.solved;
    assert_eq!(smallest.model.parts, [ModelPart::Grip]);
    assert_eq!(smallest.model.theory, Theory::EulerBernoulli);
    for (f, exact) in smallest.frequencies_hz.iter().zip(&exact) {
        assert!((f / exact - 1.0).abs() < 3e-10, "{f} {exact}");
    }
    let (absorber, _) = case("absorber");
    let advice = advise(&absorber, 5, 0.9).unwrap();
    assert!(row(&advice, Switch::Part(ModelPart::Absorbers)).shift_by_mode.is_none());
    assert_eq!(advice.smallest_model.solved.model.parts, [ModelPart::Absorbers]);
    for name in ["clamped_free", "end_springs", "pin_inside"] {
        let advice = advise(&case(name).0, 3, 0.9).unwrap();
        let part = advice.full_model.solved.model.parts[0];
        assert!(row(&advice, Switch::Part(part)).shift_by_mode.is_none(), "{name}");
        assert_eq!(advice.smallest_model.solved.model.parts, [part], "{name}");
    }
}

/// Solved separately from the advisor; no model with fewer switches is within the tolerance.
#[test]
fn the_smallest_model_is_within_the_tolerance_and_no_smaller_one_is() {
    let r161 = bundled_bat("meshes/r161.json").unwrap();
    let frequencies = |bat: &Bat, theory: Theory, modes: usize| -> Vec<f64> {
        let request = Request { modes, tolerance: 1e-11, theory, ..Request::default() };
        solve(bat, &request).unwrap().modes.iter().map(|mode| mode.frequency()).collect()
    };
    let off = |theory: Theory, modes: usize| {
        let full = frequencies(&r161, Theory::Timoshenko, modes);
        let pairs = frequencies(&r161, theory, modes).into_iter().zip(full);
        pairs.map(|(f, full)| (f / full - 1.0).abs()).fold(0.0, f64::max)
    };
    let mut chosen = Vec::new();
    for modes in [1, 5] {
        for tolerance in [1e-6, 0.01, 0.1, 0.5] {
            let advice = advise(&r161, modes, tolerance).unwrap();
            let theory = advice.smallest_model.solved.model.theory;
            let deviation = off(theory, modes);
            assert!(deviation <= tolerance, "{modes} {tolerance}: {deviation}");
            assert!((deviation - advice.smallest_model.deviation).abs() < 1e-9);
            for smaller in Theory::ALL.into_iter().filter(|smaller| *smaller < theory) {
                assert!(off(smaller, modes) > tolerance, "{modes} {tolerance}: {smaller:?}");
            }
            chosen.push(theory);
        }
    }
    let [plain, turning, full] = Theory::ALL;
    assert_eq!(chosen, [full, turning, plain, plain, full, full, full, plain]);
}

/// A weight without a relevant effect is omitted, another one is kept; and the model as a whole is within the
/// tolerance, not only each part.
#[test]
fn parts_that_do_not_matter_go_and_those_that_do_stay() {
    let tape = json!({ "attachments": [{ "x": 0.1, "mass": 1e-4 }] });
    let advice = advise(&dowel("timo_dowel", tape), 3, 1e-3).unwrap();
    assert_eq!(advice.smallest_model.left_out, ["weights"]);
    let doughnut = json!({ "attachments": [{ "x": 0.7, "mass": 0.45 }],
        "joints": [{ "x": 0.4, "rotational_stiffness": 1e9 }] });
    let advice = advise(&dowel("timo_dowel", doughnut), 3, 1e-3).unwrap();
    assert_eq!(advice.smallest_model.left_out, ["joints"]);
    assert_eq!(advice.smallest_model.solved.model.parts, [ModelPart::Weights]);
    // Rotary inertia lowers mode 3 by 1.5 % and the weight by about as much; both together exceed 2 %, each alone does
    // not.
    let weight = json!({ "attachments": [{ "x": 0.8, "mass": 0.012 }] });
    let bat = dowel("rayleigh_dowel", weight);
    let advice = advise(&bat, 3, 0.02).unwrap();
    let alone = [Switch::RotaryInertia, Switch::Part(ModelPart::Weights)];
    let alone = alone.map(|switch| row(&advice, switch).largest().unwrap());
    assert!(alone.iter().all(|shift| (0.01..0.019).contains(shift)), "{alone:?}");
    assert!(alone.iter().sum::<f64>() > 0.021, "{alone:?}");
    assert_eq!(advice.smallest_model.solved.model.size(), 1);
}

/// Regions, cores and their materials: without them the bat is the bare one.
#[test]
fn without_its_regions_a_bat_is_of_its_own_material() {
    let (cork, exact) = case("cork");
    let advice = advise(&cork, 5, 1e-8).unwrap();
    let effect = row(&advice, Switch::Part(ModelPart::Materials));
    let bare = cork.with(|parts| ModelPart::Materials.take_off(&mut parts.fixtures)).unwrap();
    let request =
        Request { modes: 5, tolerance: 1e-11, theory: Theory::Timoshenko, ..Request::default() };
    let modes = solve(&bare, &request).unwrap().modes;
    for (k, mode) in modes.iter().enumerate() {
        let [shift, _] = effect.shift(k).unwrap();
        assert!((exact[k] / mode.frequency() - 1.0 - shift).abs() < 1e-9);
    }
    // With a core of unknown shear, the whole model has no shear; the models without the core have it.
    let unknown = json!({ "regions": [{ "from": 0.4, "to": 0.5,
        "material": { "density": 700, "youngs_modulus": 14e9 } }] });
    let advice = advise(&dowel("timo_dowel", unknown), 3, 0.9).unwrap();
    assert_eq!(advice.full_model.solved.model.theory, Theory::Rayleigh);
    let effect = row(&advice, Switch::Part(ModelPart::Materials));
    assert_eq!(effect.without.model.theory, Theory::Rayleigh);
    // The reverse: the shear modulus of the bat is unknown, those of all its regions are known.
    let known = json!({ "material": { "density": 700, "youngs_modulus": 14e9 },
        "regions": [{ "from": 0, "to": 0.8382, "material": {
            "density": 700, "youngs_modulus": 14e9, "shear_modulus": 1e9 } }] });
    let advice = advise(&dowel("timo_dowel", known), 3, 0.9).unwrap();
    assert_eq!(advice.full_model.solved.model.theory, Theory::Timoshenko);
    let effect = row(&advice, Switch::Part(ModelPart::Materials));
    assert_eq!([effect.with.model.theory, effect.without.model.theory], [Theory::Rayleigh; 2]);
    let shifts = effect.shift_by_mode.as_ref().unwrap();
    assert!(shifts.iter().all(|shift| shift.abs() <= 1e-9), "{shifts:?}");
}

#[test]
fn the_damping_of_materials_is_half_their_loss_factor_or_between_bounds() {
    let material = json!({ "density": 700, "youngs_modulus": 14e9, "loss_factor": 0.02 });
    let damped = |mut more: Value| {
        more["material"] = material.clone();
        advise(&dowel("rayleigh_dowel", more), 2, 0.5).unwrap().damping
    };
    assert_eq!(damped(json!({})).material_ratio, [0.01, 0.01]);
    let other = json!({ "density": 700, "youngs_modulus": 14e9, "loss_factor": 0.06 });
    let two = damped(json!({ "regions": [{ "from": 0, "to": 0.2, "material": other }] }));
    assert_eq!(two.material_ratio, [0.01, 0.03]);
    // A core has no effect in a solid bat.
    let core = damped(json!({ "regions": [{ "from": 0, "to": 0.2, "core": other }] }));
    assert_eq!(core.material_ratio, [0.01, 0.01]);
    // A joint bends without loss.
    let joint = json!({ "joints": [{ "x": 0.3, "rotational_stiffness": 1e4 }] });
    assert_eq!(damped(joint).material_ratio, [0.0, 0.01]);
}

/// The tapped frequency is that of the bat with everything on.
#[test]
fn a_tapped_bat_keeps_its_stiffness_when_parts_are_taken_off() {
    let tapped = json!({ "attachments": [{ "x": 0.8, "mass": 0.1 }],
        "weighed": { "first_bending_hz": 170 } });
    let advice = advise(&dowel("timo_dowel", tapped), 2, 1e-4).unwrap();
    assert!((advice.full_model.solved.frequencies_hz[0] / 170.0 - 1.0).abs() < 1e-8);
    let effect = row(&advice, Switch::Part(ModelPart::Weights));
    let stiffness = |bat: &Bat| bat.material().youngs_modulus;
    assert_eq!(stiffness(&effect.with.bat), stiffness(&effect.without.bat));
    assert!(effect.without.frequencies_hz[0] > 180.0);
}

#[test]
fn advice_is_printed_80_columns_wide_and_written_as_json_without_holes() {
    let folder = Folder::new("advice");
    let everything = json!({ "grip": { "from": 0, "to": 0.15, "stiffness": 4e5, "damping": 300 },
        "absorbers": [{ "x": 0.1, "mass": 0.03, "frequency": 170, "damping": 2 }] });
    let resolved = sweetspot_report::report::resolved::resolved(&dowel("timo_dowel", everything));
    folder.write("held.json", sweetspot_report::schema::text(&resolved));
    let mesh = |name: &str| format!("{}/meshes/{name}.json", env!("SWEETSPOT_TOP"));
    let bats = ["dowel", "r161", "corked", "two_piece"]
        .map(mesh)
        .into_iter()
        .chain(["held.json".to_owned()]);
    for bat in bats {
        for units in ["si", "us", "both"] {
            let args = ["advise", &bat, "-n", "6", "--tol", "1%", "--units", units, "--full"];
            let table = folder.text(&args);
            let wide: Vec<_> = table.lines().filter(|line| line.chars().count() > 80).collect();
            assert!(wide.is_empty(), "{wide:?}");
            assert!(!table.contains("NaN") && !table.contains("inf"), "{table}");
            for word in ["rotary inertia", "Smallest model within 1 %", "hoop modes", "hands"] {
                assert!(table.contains(word), "{bat}: {word}\n{table}");
            }
        }
        let document = folder.json(&["advise", &bat, "--tol", "1%", "--json", "-"]);
        assert_eq!(document["format"], "sweetspot-advice/1");
        assert_eq!(document["modes"], 5);
        assert_eq!(document["full_model"]["tolerance_met"], true);
        assert_eq!(document["full_model"]["frequencies_hz"].as_array().unwrap().len(), 5);
        assert!(document["smallest_model"]["deviation"].as_f64().unwrap() <= 0.01);
        for effect in document["effects"].as_array().unwrap() {
            let paired = effect["shift_by_mode"].as_array();
            assert!(paired.is_none_or(|shifts| shifts.iter().all(Value::is_f64)), "{effect}");
        }
    }
    for bat in ["dowel", "r161", "two_piece"] {
        let table = folder.text(&["analyze", &mesh(bat), "--quiet", "--full"]);
        let lines = table.lines().skip_while(|line| !line.starts_with("Advice: "));
        let short: Vec<_> = lines.take_while(|line| !line.is_empty()).collect();
        assert!((3..=9).contains(&short.len()), "{short:#?}");
        assert!(short.iter().all(|line| line.chars().count() <= 80), "{short:#?}");
    }
}

#[test]
fn a_tolerance_beyond_round_off_is_answered_with_the_full_model_and_exit_code_3() {
    let folder = Folder::new("beyond");
    let bat = format!("{}/meshes/r161.json", env!("SWEETSPOT_TOP"));
    let output = folder.run(&["advise", &bat, "--tol", "1e-16", "--json", "-"]);
    assert_eq!(output.status.code(), Some(3));
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(told.contains("accuracy not reached") && told.lines().count() == 1, "{told}");
    let document: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(document["full_model"]["tolerance_met"], false);
    assert_eq!(document["smallest_model"]["theory"], "timoshenko");
    assert_eq!(document["smallest_model"]["deviation"], 0.0);
}

#[test]
fn what_cannot_be_asked_is_an_error() {
    let bat = bundled_bat("meshes/dowel.json").unwrap();
    for (modes, tolerance) in [(0, 0.1), (101, 0.1), (5, 0.0), (5, 1.0), (5, f64::NAN), (5, -1.0)] {
        assert!(advise(&bat, modes, tolerance).is_err(), "{modes} {tolerance}");
    }
}

#[test]
fn a_bat_that_cannot_stand_without_a_part_says_without_which() {
    let springs = json!([{ "x": 0.2, "stiffness": 1e6 }, { "x": 0.6, "stiffness": 1e-12 }]);
    let held = json!({ "attachments": springs, "supports": [{ "x": 0, "type": "pinned" }] });
    let bat = dowel("timo_dowel", held);
    assert!(solve(&bat, &Request::plain()).is_ok());
    let said = advise(&bat, 3, 1e-3).unwrap_err().to_string();
    assert!(said.contains("hold the bat against turning"), "{said}");
    assert!(said.ends_with("that is the bat without supports"), "{said}");
}
