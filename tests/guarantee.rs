//! Proven statements about frequencies are correct: compared with known answers, for deliberately wrong trials, and in
//! an arithmetic checked by one of twice the digits.

mod common;
#[path = "guarantee/twofold.rs"]
mod twofold;
#[path = "guarantee/arithmetic.rs"]
mod arithmetic;
#[path = "guarantee/parts.rs"]
mod parts;
#[path = "guarantee/lies.rs"]
mod lies;
#[path = "guarantee/again.rs"]
mod again;

use common::folder::Folder;
use sweetspot::bat::fixtures::{Attachment, Fixtures, Held, Support, Tape};
use sweetspot::{Bat, Request, Theory};
use sweetspot_proof::enclosure::guarantee::{Guarantee, guarantee};
use sweetspot_proof::enclosure::within::{Within, band};
use sweetspot_proof::promise::{BATS, KNOWN_TO};
use sweetspot_proof::validation::Truth;

fn proven(bat: &Bat, modes: usize, tolerance: f64, theory: Theory) -> Guarantee {
    let request = Request { modes, tolerance, theory, ..Request::default() };
    guarantee(bat, &request).unwrap().1
}

fn mesh_bat(name: &str) -> Bat {
    Bat::from_file(format!("{}/meshes/{name}.json", env!("SWEETSPOT_TOP"))).unwrap()
}

/// Whether a known frequency, right to half a unit in its last place, may be between the two.
fn holds([lower, upper]: [f64; 2], known: f64) -> bool {
    lower <= known * (1.0 + KNOWN_TO) && known * (1.0 - KNOWN_TO) <= upper
}

#[test]
fn every_known_frequency_is_between_its_bounds() {
    let (mut held, mut refused) = (0, vec![]);
    for (name, cases) in BATS.iter().filter(|(_, cases)| !cases.is_empty()) {
        let truth = Truth::of_cases(cases).unwrap();
        let modes = truth.frequencies.len().min(10);
        let request =
            Request { modes, tolerance: 1e-11, theory: truth.theory, ..Request::default() };
        let found = match guarantee(&truth.bat, &request) {
            Ok((_, found)) => found,
            Err(said) => {
                refused.push((name, said.to_string()));
                continue;
            }
        };
        // Two equal halves have equal frequencies: an exactly double frequency is not separated, and nothing is stated.
        // If the first frequency is some 1e-4 of the next, or 1e-3 of the ninth, the intervals are wider than the rest
        // of the norm.
        let modes = match *name {
            "clamped in middle" => 0,
            "1e6 kg at the tip" => 1,
            "hands, cone, shear" => 8,
            _ => modes,
        };
        assert_eq!(found.modes.len(), modes, "{name}");
        for (mode, known) in found.modes.iter().zip(&truth.frequencies) {
            assert!(holds(mode.hertz, *known), "{name}: {:?} {known:?}", mode.hertz);
            held += 1;
        }
        for (mode, nodes) in
            found.modes.iter().zip(&truth.nodes).filter(|(_, nodes)| !nodes.is_empty())
        {
            for [from, to] in &mode.nodes {
                let inside = nodes.iter().filter(|x| *from - 1e-15 <= **x && **x <= *to + 1e-15);
                let beside = *from < 1e-4 || *to > truth.bat.length() - 1e-4;
                assert!(inside.count() == 1 || beside, "{name}: {from} {to} {nodes:?}");
            }
        }
    }
    assert!(held > 300, "{held}");
    // Bats that cannot be proven are refused with the reason.
    let reasons = ["supports", "profile"];
    for (name, said) in &refused {
        assert!(reasons.iter().any(|reason| said.contains(reason)), "{name}: {said}");
    }
}

#[test]
fn ten_modes_of_the_r161_are_proven_to_twelve_digits() {
    let bat = mesh_bat("r161");
    for theory in [Theory::EulerBernoulli, Theory::Timoshenko] {
        let found = proven(&bat, 10, 1e-12, theory);
        assert!(found.met && found.modes.len() == 10, "{theory:?} {}", found.width());
        let nodes = found.modes.iter().map(|mode| mode.nodes.len());
        assert!(nodes.eq(2..12), "{theory:?}");
    }
}

#[test]
fn a_width_is_met_or_it_is_said_that_it_is_not() {
    for name in ["dowel", "r161", "cone"] {
        let bat = mesh_bat(name);
        for digits in [4, 8, 11] {
            let tolerance = 10f64.powi(-digits);
            let found = proven(&bat, 5, tolerance, Theory::EulerBernoulli);
            assert!(found.met && found.width() <= tolerance, "{name} {digits}");
            assert!(found.shortfall(tolerance).is_empty());
        }
        let found = proven(&bat, 5, 1e-15, Theory::EulerBernoulli);
        assert!(!found.met && !found.shortfall(1e-15).is_empty());
    }
}

/// Stations of 33 in are 0.8382 m, whatever the nearest double is.
#[test]
fn what_is_proven_is_the_decimals_of_the_file() {
    let of = |x: &str, r: &str, unit: &str| {
        let text = format!(
            r#"{{ "format": "sweetspot-bat/1",
                 "material": {{ "density": 700, "youngs_modulus": 14e9 }},
                 "profile": {{ "interpolation": "linear", "unit": "{unit}", "x": [0, {x}],
                              "diameter": [{r}, {r}] }} }}"#
        );
        let bat = Bat::from_text("bat.json", &text, "".as_ref()).unwrap();
        proven(&bat, 3, 1e-12, Theory::EulerBernoulli)
    };
    // The same bat in three units: equal rationals, doubles that differ in the last place.
    let all = [of("33", "1.5", "in"), of("838.2", "38.1", "mm"), of("0.8382", "0.0381", "m")];
    // Frequency of the free dowel, β² in 30 digits: (β/L)² √(E r²/4ρ)/2π.
    let betas = [4.730_040_744_862_704, 7.853_204_624_095_838, 10.995_607_838_001_671];
    for (k, beta) in betas.iter().enumerate() {
        let known = (beta / 0.8382_f64).powi(2) * (14e9_f64 / 700.0).sqrt() * 0.019_05
            / (4.0 * std::f64::consts::PI);
        for found in &all {
            let [lower, upper] = found.modes[k].hertz;
            // The formula in plain numbers is accurate to some units in the last place.
            assert!(lower <= known * (1.0 + 2e-15) && known * (1.0 - 2e-15) <= upper);
        }
    }
}

#[test]
fn a_band_holds_the_frequencies_of_bats_within_it() {
    let bat = mesh_bat("r161");
    let request = Request { modes: 4, tolerance: 1e-9, ..Request::plain() };
    let within = Within { radius: 1e-4, modulus: 0.02 };
    let found = band(&bat, &request, within).unwrap();
    assert!(found.met && found.hertz.len() == 4);
    for k in 0..12 {
        let sign = |j: i32| if (k >> j) & 1 == 0 { 1.0 } else { -1.0 };
        // Thicker or thinner, in stretches, and stiffer or softer.
        let stations = bat.profile().stations.outer.len() as f64;
        let other = bat
            .with(|parts| {
                let mut radii = parts.profile.stations.clone();
                for (j, r) in radii.outer.iter_mut().enumerate() {
                    let share = (j as f64 / stations - 0.5 * sign(3)) * sign(1);
                    *r += 1e-4 * sign(0) * (4.0 * share).clamp(-1.0, 1.0);
                }
                parts.profile = sweetspot::Profile::new(radii).unwrap();
                parts.material.youngs_modulus *= 1.0 + 0.02 * sign(2);
            })
            .unwrap();
        let own = proven(&other, 4, 1e-9, Theory::EulerBernoulli);
        for (mode, [lower, upper]) in own.modes.iter().zip(&found.hertz) {
            // The curve between stations may leave the band by at most its change of slope. None of these bats reaches
            // the ends of the band.
            assert!(*lower <= mode.hertz[1] && mode.hertz[0] <= *upper);
        }
    }
    // Exactly `d` thicker everywhere: the monotone curve is moved as a whole, and every mode stays inside.
    for d in [1e-4, -1e-4] {
        let moved = bat.with(|parts| {
            let mut radii = parts.profile.stations.clone();
            radii.outer.iter_mut().for_each(|r| *r += d);
            parts.profile = sweetspot::Profile::new(radii).unwrap();
            parts.material.youngs_modulus *= 1.0 + 200.0 * d;
        });
        let own = proven(&moved.unwrap(), 4, 1e-9, Theory::EulerBernoulli);
        for (mode, [lower, upper]) in own.modes.iter().zip(&found.hertz) {
            assert!(*lower <= mode.hertz[0] && mode.hertz[1] <= *upper);
        }
    }
}

#[test]
fn what_is_not_carried_is_refused_with_its_reason() {
    let refused = |name: &str| {
        let request = Request { modes: 2, ..Request::plain() };
        guarantee(&mesh_bat(name), &request).unwrap_err().to_string()
    };
    let reasons = [("tanh", "formulas"), ("house", "point"), ("torpedo", "point")];
    for (name, reason) in reasons {
        assert!(refused(name).contains(reason), "{name}: {}", refused(name));
    }
    // In a layer on a hollow wall the hole ratio is not a polynomial; without shear it is not needed.
    let layered = r#"{ "format": "sweetspot-bat/1", "material": "aluminium-7075",
        "profile": { "x": [0, 0.84], "diameter": [0.05, 0.06], "wall_thickness": [0.004, 0.004] },
        "regions": [ { "from": 0, "to": 0.84, "layers": [
            { "thickness": "1 mm", "material": "aluminium-7075" } ] } ] }"#;
    let layered = sweetspot::Bat::from_text("layered.json", layered, "".as_ref()).unwrap();
    let by = |theory| guarantee(&layered, &Request { modes: 2, theory, ..Request::default() });
    let said = by(Theory::Timoshenko).unwrap_err().to_string();
    assert!(said.contains("layers around a hollow wall"), "{said}");
    assert!(by(Theory::Rayleigh).unwrap().1.met);
    // A bat on one pin can rotate about it, and so can one on one spring.
    let pin = Support { x: 0.1, kind: Held::Pinned };
    let spring = Attachment { x: 0.1, stiffness: 1e4, ..Attachment::default() };
    let held = [
        (Fixtures { supports: vec![pin], ..Fixtures::default() }, "rigid motion"),
        (Fixtures { attachments: vec![spring], ..Fixtures::default() }, "rigid motion"),
    ];
    for (fixtures, reason) in held {
        let bat = mesh_bat("r161").with(|parts| parts.fixtures = fixtures.clone()).unwrap();
        let said = guarantee(&bat, &Request { modes: 2, ..Request::plain() }).unwrap_err();
        assert!(said.to_string().contains(reason), "{said}");
    }
}

/// Every support and every spring has its effect: additional ones lower no frequency, and stiff springs act nearly as
/// supports.
#[test]
fn a_held_bat_is_proven_between_freer_and_stiffer_ones() {
    let of = |fixtures: Fixtures, theory: Theory| -> Vec<[f64; 2]> {
        let bat = mesh_bat("r161").with(|parts| parts.fixtures = fixtures).unwrap();
        let found = proven(&bat, 6, 1e-9, theory);
        assert!(found.met, "{}", found.width());
        assert!(found.modes.iter().all(|mode| mode.nodes.is_empty()));
        found.modes.iter().map(|mode| mode.hertz).collect()
    };
    let spring = |stiffness: f64| Attachment {
        x: 0.15,
        stiffness,
        rotational_stiffness: 0.01 * stiffness,
        ..Attachment::default()
    };
    let clamp = Support { x: 0.15, kind: Held::Clamped };
    for theory in Theory::ALL {
        let on = |stiffness: f64| Fixtures {
            attachments: vec![spring(stiffness)],
            ..Fixtures::default()
        };
        let clamped = Fixtures { supports: vec![clamp], ..Fixtures::default() };
        let all = [of(on(1e4), theory), of(on(1e6), theory), of(on(1e13), theory)];
        let clamped = of(clamped, theory);
        for k in 0..6 {
            let rising = [all[0][k], all[1][k], all[2][k], clamped[k]];
            assert!(rising.windows(2).all(|pair| pair[0][0] <= pair[1][1]), "{rising:?}");
            assert!((all[2][k][0] / clamped[k][0] - 1.0).abs() < 1e-5, "{rising:?}");
        }
    }
}

/// The minimum-maximum principle holds for held bats too.
#[test]
fn a_band_of_a_held_bat_holds_its_frequencies() {
    let clamp = Support { x: 0.0, kind: Held::Clamped };
    let bat = mesh_bat("r161").with(|parts| parts.fixtures.supports.push(clamp)).unwrap();
    let request = Request { modes: 3, tolerance: 1e-9, ..Request::plain() };
    let found = band(&bat, &request, Within { radius: 1e-4, modulus: 0.02 }).unwrap();
    let own = proven(&bat, 3, 1e-9, Theory::EulerBernoulli);
    assert!(found.met && found.hertz.len() == 3);
    for (mode, [lower, upper]) in own.modes.iter().zip(&found.hertz) {
        assert!(*lower < mode.hertz[0] && mode.hertz[1] < *upper);
        assert!(upper / lower < 1.1);
    }
}

/// Tape rotates with its surface, and the fastest bat of a band has the largest radii. A band of a taped bat with
/// rotating sections would therefore claim too much.
#[test]
fn a_band_of_a_taped_bat_is_refused_where_sections_turn() {
    let tape = Tape { from: 0.02, to: 0.3, mass: 0.05 };
    let taped = mesh_bat("r161").with(|parts| parts.fixtures.tapes.push(tape)).unwrap();
    let within = Within { radius: 1e-4, modulus: 0.0 };
    let of = |theory: Theory| {
        band(&taped, &Request { modes: 2, tolerance: 1e-9, theory, ..Request::default() }, within)
    };
    for theory in [Theory::Rayleigh, Theory::Timoshenko] {
        let said = of(theory).unwrap_err().to_string();
        assert!(said.contains("tape"), "{said}");
    }
    // A mass alone determines no radius.
    let found = of(Theory::EulerBernoulli).unwrap();
    let own = proven(&taped, 2, 1e-9, Theory::EulerBernoulli);
    for (mode, [lower, upper]) in own.modes.iter().zip(&found.hertz) {
        assert!(*lower < mode.hertz[0] && mode.hertz[1] < *upper);
    }
}

/// The same bounds, below the answer of `analyze` and in its documents; refused where `modes` refuses them.
#[test]
fn analyze_says_what_modes_proves() {
    let folder = Folder::new("guarantee-analyze");
    let asked = ["r161", "-n", "3", "--guarantee"];
    let modes = folder.json(&[&["modes"], &asked[..], &["--json", "-"]].concat());
    let more = ["--out", "all", "--json", "all.json"];
    let text = folder.text(&[&["analyze"], &asked[..], &more].concat());
    assert!(text.contains("Proven of the exact beam, no mode missing between them"), "{text}");
    let read =
        |name: &str| -> serde_json::Value { serde_json::from_str(&folder.read(name)).unwrap() };
    for document in [&read("all.json")["modes"], &read("all/modes.json")] {
        assert_eq!(document["proof"], modes["proof"]);
        for k in 0..3 {
            let [here, there] = [document, &modes].map(|document| &document["modes"][k]["proven"]);
            assert!(here == there && here["lower_hz"].is_number(), "{here} {there}");
        }
    }
    let refused = folder.run(&["analyze", "r161", "--guarantee", "--joint", "10 in"]);
    assert_eq!(refused.status.code(), Some(2));
}
