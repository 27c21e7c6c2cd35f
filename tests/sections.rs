//! Hollow and layered sections, regions, joints, wood, and bats that were weighed and tapped.

use crate::common;

use std::f64::consts::{PI, TAU};
use std::path::Path;

use common::folder::Folder;
use common::{DENSITY, LENGTH, MODULUS, RADIUS, beta, dowel_frequency};
use serde_json::{Value, json};
use sweetspot::bat::theory::Theory;
use sweetspot::modes::tuned::tuned;
use sweetspot::{Bat, Request, Solution, solve};
use sweetspot_proof::bundled::CASES;

const BOTH: [Theory; 2] = [Theory::EulerBernoulli, Theory::Timoshenko];

/// So fine that only round-off is left: at least 48 elements of degree 9, whose error for the first eight modes is far
/// below 1e-16.
fn finest(bat: &Bat, theory: Theory) -> Solution {
    let request =
        Request { modes: 8, elements: Some(48), degree: Some(9), theory, ..Request::default() };
    solve(bat, &request).unwrap()
}

fn frequencies(bat: &Bat, theory: Theory) -> Vec<f64> {
    finest(bat, theory).modes.iter().map(|mode| mode.frequency()).collect()
}

/// The largest relative difference of two lists.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max)
}

fn read(document: &Value) -> Bat {
    Bat::from_text("bat.json", &document.to_string(), Path::new("")).unwrap()
}

fn wood() -> Value {
    json!({ "density": DENSITY, "youngs_modulus": MODULUS, "shear_modulus": 0.9e9 })
}

/// A bat of that profile, and more keys.
fn of(profile: Value, more: Value) -> Bat {
    let mut document =
        json!({ "format": "sweetspot-bat/1", "material": wood(), "profile": profile });
    for (key, value) in more.as_object().unwrap() {
        document[key] = value.clone();
    }
    read(&document)
}

/// The dowel with more keys.
fn dowel(more: Value) -> Bat {
    of(json!({ "interpolation": "linear", "x": [0, LENGTH], "radius": [RADIUS, RADIUS] }), more)
}

/// A bat-like profile with columns added.
fn shaped(more: Value) -> Value {
    let mut profile = json!({
        "x": [0, 0.02, 0.06, 0.3, 0.5, 0.7, 0.84],
        "radius": [0.024, 0.023, 0.0125, 0.013, 0.022, 0.033, 0.031]
    });
    for (key, value) in more.as_object().unwrap() {
        profile[key] = value.clone();
    }
    profile
}

fn none() -> Value {
    json!({})
}

/// A bore of 1 nm takes (r_i/r)² of the section, below 1e-14 at the thinnest place.
#[test]
fn a_solid_bat_one_without_a_bore_and_one_with_a_wall_as_thick_as_its_radius_are_the_same() {
    let bat = |more: Value| of(shaped(more), none());
    let radii = shaped(none())["radius"].clone();
    for theory in BOTH {
        let solid = frequencies(&bat(none()), theory);
        let without = frequencies(&bat(json!({ "inner_radius": [0, 0, 0, 0, 0, 0, 0] })), theory);
        let wall = frequencies(&bat(json!({ "wall_thickness": radii })), theory);
        let fine = 1e-9;
        let narrow = frequencies(
            &bat(json!({ "inner_radius": [fine, fine, fine, fine, fine, fine, fine] })),
            theory,
        );
        assert!(apart(&without, &solid) < 4e-14 && apart(&wall, &solid) < 4e-14, "{theory:?}");
        assert!(apart(&narrow, &solid) < 1e-12, "{theory:?}: {}", apart(&narrow, &solid));
    }
}

/// With `τ = t/r`, `EI/ρA = E r² (1 − τ + τ²/2)/2ρ`: frequencies fall short of the thin tube's by
/// τ/2, and by τ²/8 less.
#[test]
fn the_frequencies_of_a_thin_tube_tend_to_the_textbook_s_with_slope_one_half() {
    let thin = (MODULUS * RADIUS * RADIUS / (2.0 * DENSITY)).sqrt() / (TAU * LENGTH * LENGTH);
    for share in [1e-1, 1e-2, 1e-3, 1e-4, 1e-5] {
        let wall = share * RADIUS;
        let tube = of(
            json!({ "interpolation": "linear", "x": [0, LENGTH], "radius": [RADIUS, RADIUS],
                "wall_thickness": [wall, wall] }),
            none(),
        );
        for (k, f) in frequencies(&tube, Theory::EulerBernoulli).iter().enumerate() {
            let slope = (f / (beta(k + 1).powi(2) * thin) - 1.0) / share;
            // The wall is a difference of radii: round-off over τ, twice.
            let room = 0.2 * share + 2e-15 / (share * share);
            assert!((slope + 0.5).abs() < room.max(1e-9), "{share} mode {}: {slope}", k + 1);
        }
    }
}

#[test]
fn a_wall_given_by_its_thickness_by_its_bore_and_by_formulas_is_the_same() {
    let line = |from: f64, to: f64| json!([from, to]);
    let outer = [0.013, 0.033];
    let inner = [0.009, 0.030];
    let column = |key: &str, values: [f64; 2]| {
        let mut profile = json!({ "interpolation": "linear", "x": line(0.0, 0.84) });
        profile["radius"] = json!(outer);
        profile[key] = json!(values);
        of(profile, none())
    };
    let slope = |r: [f64; 2]| format!("{} + {}*x", r[0], (r[1] - r[0]) / 0.84);
    let formulas = of(
        json!({ "pieces": [{ "from": 0, "to": 0.84, "formula": slope(outer),
            "inner_formula": slope(inner) }] }),
        none(),
    );
    for theory in BOTH {
        let bore = frequencies(&column("inner_radius", inner), theory);
        let wall = [outer[0] - inner[0], outer[1] - inner[1]];
        let wide = frequencies(&column("inner_diameter", inner.map(|r| 2.0 * r)), theory);
        assert!(apart(&frequencies(&column("wall_thickness", wall), theory), &bore) < 1e-13);
        assert!(apart(&wide, &bore) < 1e-13);
        // Formulas are integrated to 1e-13.
        assert!(apart(&frequencies(&formulas, theory), &bore) < 1e-12);
    }
}

#[test]
fn a_region_of_the_same_material_changes_nothing() {
    let region = json!({ "regions": [{ "from": 0.2, "to": 0.61, "material": wood() }] });
    for theory in BOTH {
        let plain = frequencies(&of(shaped(none()), none()), theory);
        let other = frequencies(&of(shaped(none()), region.clone()), theory);
        assert!(apart(&other, &plain) < 1e-13, "{theory:?}: {}", apart(&other, &plain));
    }
}

/// A hole of 1 in, 6 in deep from the tip.
fn bored(core: Option<Value>) -> Bat {
    let (end, length) = (0.84 - 0.1524, 0.84);
    let profile = json!({
        "interpolation": "linear", "x": [0, 0.3, 0.6, end, end, length],
        "radius": [0.0125, 0.013, 0.03, 0.032, 0.032, 0.032],
        "inner_radius": [0, 0, 0, 0, 0.0127, 0.0127]
    });
    let region = |core: Value| json!({ "regions": [{ "from": end, "to": length, "core": core }] });
    of(profile, core.map_or_else(none, region))
}

#[test]
fn a_bore_filled_with_its_own_wood_is_solid_and_with_nothing_to_speak_of_empty() {
    let solid = of(
        json!({ "interpolation": "linear", "x": [0, 0.3, 0.6, 0.84 - 0.1524, 0.84],
            "radius": [0.0125, 0.013, 0.03, 0.032, 0.032] }),
        none(),
    );
    let air = json!({ "density": 1e-14, "youngs_modulus": 1e-6, "shear_modulus": 1e-7 });
    let cork = json!({ "density": 200, "youngs_modulus": 2e7, "shear_modulus": 8e6 });
    for theory in BOTH {
        let solid = frequencies(&solid, theory);
        let empty = frequencies(&bored(None), theory);
        assert!(apart(&frequencies(&bored(Some(wood())), theory), &solid) < 1e-13, "{theory:?}");
        assert!(apart(&frequencies(&bored(Some(air.clone())), theory), &empty) < 1e-13);
        // Cork has mass and hardly any stiffness: it raises a frequency at most by the ratio of the moduli.
        let corked = frequencies(&bored(Some(cork.clone())), theory);
        let stiffer = 2e7 / MODULUS + 8e6 / 0.9e9;
        assert!(corked.iter().zip(&empty).all(|(c, e)| c / e < 1.0 + stiffer), "{theory:?}");
    }
}

/// A cone of depth d and rim r_c has the mass ρ π r_c² d/3. A small one at a free end, where nothing bends, raises a
/// frequency by `½ ∫ρA_cup φ²/m`, to first order.
#[test]
fn a_cup_at_the_tip_takes_its_mass_from_every_mode() {
    let (depth, rim) = (0.0254, 2e-3);
    let start = LENGTH - depth;
    let cupped = of(
        json!({ "interpolation": "linear", "x": [0, start, LENGTH],
            "radius": [RADIUS, RADIUS, RADIUS], "inner_radius": [0, 0, rim] }),
        none(),
    );
    let plain = dowel(none());
    let cup = DENSITY * PI * rim * rim * depth / 3.0;
    let lost = plain.inertia().mass - cupped.inertia().mass;
    // A difference of masses a ten-thousandth as large.
    assert!((lost / cup - 1.0).abs() < 1e-10, "{lost} {cup}");
    let full = finest(&plain, Theory::EulerBernoulli);
    let less = finest(&cupped, Theory::EulerBernoulli);
    for (a, b) in full.modes.iter().zip(&less.modes).take(4) {
        let steps = 2000;
        let step = depth / f64::from(steps);
        let middle = |k: i32| (f64::from(k) + 0.5) * step;
        let taken = |s: f64| DENSITY * PI * (rim * s / depth).powi(2);
        let part = |k: i32| step * taken(middle(k)) * a.shape.deflection(start + middle(k)).powi(2);
        let expected = 0.5 * (0..steps).map(part).sum::<f64>() / a.modal_mass;
        let found = b.omega / a.omega - 1.0;
        // The second order is of the size of the shift, 1e-4; the end still bends a little.
        assert!((found / expected - 1.0).abs() < 0.01, "mode {}: {found} {expected}", a.order);
    }
}

/// Two materials in one section, `r_i` between them: `ΣE I`, `ΣρA`, `ΣρI`, `ΣκGA`.
fn layered() -> (Bat, [f64; 4]) {
    let (r, ri) = (RADIUS, 0.014);
    let metal = json!({ "density": 2800, "youngs_modulus": 70e9, "shear_modulus": 26e9, "shear_coefficient": 0.6 });
    let core = json!({ "density": 900, "youngs_modulus": 9e9, "shear_modulus": 0.7e9, "shear_coefficient": 0.9 });
    let bat = of(
        json!({ "interpolation": "linear", "x": [0, LENGTH], "radius": [r, r], "inner_radius": [ri, ri] }),
        json!({ "regions": [{ "from": 0, "to": LENGTH, "material": metal, "core": core }] }),
    );
    let area = |r: f64| PI * r * r;
    let second = |r: f64| PI / 4.0 * r.powi(4);
    let (tube, rod) = (area(r) - area(ri), area(ri));
    let (bends, bent) = (second(r) - second(ri), second(ri));
    let sums = [
        70e9 * bends + 9e9 * bent,
        2800.0 * tube + 900.0 * rod,
        2800.0 * bends + 900.0 * bent,
        0.6 * 26e9 * tube + 0.9 * 0.7e9 * rod,
    ];
    (bat, sums)
}

#[test]
fn layers_add_under_euler_and_bernoulli() {
    let (bat, [bending, mass, ..]) = layered();
    for (k, f) in frequencies(&bat, Theory::EulerBernoulli).iter().enumerate() {
        let exact = (beta(k + 1) / LENGTH).powi(2) * (bending / mass).sqrt() / TAU;
        assert!((f / exact - 1.0).abs() < 1e-13, "mode {}: {f} {exact}", k + 1);
    }
}

/// Huang's frequency equation of a free uniform Timoshenko beam; 0 at its frequencies (Hz).
///
/// With `b² = ρA L⁴ ω²/EI`, `r² = ρI/(ρA L²)`, `s² = EI/(κGA L²)` and
/// `(α, β)² = ½ (∓(r² + s²) + √((r² − s²)² + 4/b²))`:
/// `2 − 2 cosh bα cos bβ + b (b² r² (r² − s²)² + 3r² − s²)/√(1 − b² r² s²) sinh bα sin bβ = 0`.
///
/// # Source
///
/// T. C. Huang, J. Appl. Mech. 28 (1961) 579.
fn huang([bending, mass, turning, shear]: [f64; 4], frequency: f64) -> f64 {
    let b = (mass * LENGTH.powi(4) * (TAU * frequency).powi(2) / bending).sqrt();
    let r2 = turning / (mass * LENGTH * LENGTH);
    let s2 = bending / (shear * LENGTH * LENGTH);
    let root = ((r2 - s2).powi(2) + 4.0 / (b * b)).sqrt();
    let [alpha, beta] = [root - (r2 + s2), root + (r2 + s2)].map(|v| b * (0.5 * v).sqrt());
    let factor = b * (b * b * r2 * (r2 - s2).powi(2) + 3.0 * r2 - s2);
    2.0 - 2.0 * alpha.cosh() * beta.cos()
        + factor / (1.0 - b * b * r2 * s2).sqrt() * alpha.sinh() * beta.sin()
}

/// The equation itself, on the exact frequencies of the dowel of the case `timo_dowel`.
#[test]
fn huang_s_equation_has_its_zeros_where_the_exact_case_has_its_frequencies() {
    let (_, text) = CASES.iter().find(|(name, _)| *name == "timo_dowel").unwrap();
    let case: Value = serde_json::from_str(text).unwrap();
    let material = &case["bat"]["material"];
    let number = |key: &str| material[key].as_f64().unwrap();
    let r = case["bat"]["profile"]["radius"][0].as_f64().unwrap();
    let (area, second) = (PI * r * r, PI / 4.0 * r.powi(4));
    let beam = [
        number("youngs_modulus") * second,
        number("density") * area,
        number("density") * second,
        number("shear_coefficient") * number("shear_modulus") * area,
    ];
    let exact = case["checks"].as_array().unwrap().iter();
    let exact = exact.filter(|check| check["quantity"] == "frequency_hz");
    for check in exact.take(5) {
        let f = check["expected"].as_f64().unwrap();
        let [below, above] = [1.0 - 1e-11, 1.0 + 1e-11].map(|scale| huang(beam, scale * f));
        assert!(below * above < 0.0, "{f}: {below} {above}");
    }
}

#[test]
fn layers_add_under_timoshenko() {
    let (bat, sums) = layered();
    for f in &frequencies(&bat, Theory::Timoshenko)[..6] {
        let [below, above] = [1.0 - 1e-11, 1.0 + 1e-11].map(|scale| huang(sums, scale * f));
        assert!(below * above < 0.0, "{f}: {below} {above}");
    }
}

/// A joint of stiffness k has the energy `M²/k`, where the bat stores `∫M²/EI = ω² m`: it lowers a frequency by
/// `M²/(2 k ω² m)`, up to terms of second order.
#[test]
fn a_stiff_joint_lowers_a_frequency_by_what_gives_way_in_it() {
    let x = 0.31;
    let joint = |k: f64| dowel(json!({ "joints": [{ "x": x, "rotational_stiffness": k }] }));
    let bending = MODULUS * PI / 4.0 * RADIUS.powi(4);
    for theory in BOTH {
        let whole = finest(&dowel(none()), theory);
        let plain: Vec<f64> = whole.modes.iter().map(|mode| mode.frequency()).collect();
        assert!(apart(&frequencies(&joint(1e20), theory), &plain) < 1e-13, "{theory:?}");
        for k in [1e6, 1e7, 1e8] {
            for (mode, f) in whole.modes.iter().zip(frequencies(&joint(k), theory)) {
                let moment = bending * mode.shape.curvature(x);
                let energy = mode.omega.powi(2) * mode.modal_mass;
                let expected = 0.5 * moment * moment / (k * energy);
                let found = 1.0 - f / mode.frequency();
                // The second order: EI/L is 2.7e3 N m, and mode n bends over L/n.
                let room = 2e5 / k * expected + 1e-13;
                assert!((found - expected).abs() < room, "{k} {}: {found} {expected}", mode.order);
            }
        }
    }
}

/// In the middle of the dowel: the two halves rotate against each other at `ω² = 192 k/(M L²)`. Bending modes of even
/// number have no moment there and are unchanged. In the next symmetric one the halves move as free bars of half the
/// length, at four times f₁.
#[test]
fn a_joint_that_gives_way_leaves_two_hinged_halves() {
    let mass = DENSITY * PI * RADIUS * RADIUS * LENGTH;
    let bending_over_length = MODULUS * PI / 4.0 * RADIUS.powi(4) / LENGTH;
    for share in [1e-3, 1e-5, 1e-7] {
        let k = share * bending_over_length;
        let hinged = dowel(json!({ "joints": [{ "x": 0.5 * LENGTH, "rotational_stiffness": k }] }));
        let request = Request { modes: 3, elements: Some(24), degree: Some(9), ..Request::plain() };
        let solution = solve(&hinged, &request).unwrap();
        assert_eq!(solution.rigid_modes, 2);
        let f: Vec<f64> = solution.modes.iter().map(|mode| mode.frequency()).collect();
        let turning = (192.0 * k / (mass * LENGTH * LENGTH)).sqrt() / TAU;
        assert!((f[0] / turning - 1.0).abs() < share, "{share}: {} {turning}", f[0]);
        assert!((f[1] / dowel_frequency(2) - 1.0).abs() < 1e-11, "{share}: {}", f[1]);
        assert!((f[2] / (4.0 * dowel_frequency(1)) - 1.0).abs() < share, "{share}: {}", f[2]);
    }
}

#[test]
fn twice_the_shear_modulus_is_nothing_to_euler_and_bernoulli_and_stiffer_to_timoshenko() {
    let with = |g: f64| {
        let mut material = wood();
        material["shear_modulus"] = json!(g);
        of(shaped(none()), json!({ "material": material }))
    };
    let of = |theory: Theory| (frequencies(&with(1e9), theory), frequencies(&with(2e9), theory));
    for theory in [Theory::EulerBernoulli, Theory::Rayleigh] {
        let (once, twice) = of(theory);
        assert_eq!(once, twice, "{theory:?}");
    }
    let (once, twice) = of(Theory::Timoshenko);
    let (_, stiff) = of(Theory::Rayleigh);
    for ((once, twice), stiff) in once.iter().zip(&twice).zip(&stiff) {
        assert!(once < twice && twice < stiff);
    }
}

#[test]
fn what_a_scale_says_sets_the_density_and_what_a_tap_says_the_stiffness() {
    let regions = json!([{ "from": 0.5, "to": 0.84, "material": "aluminium-7075" }]);
    let weights = json!([{ "x": 0.84, "mass": 0.04 }]);
    let weighed = json!({ "mass": 1.7, "first_bending_hz": 171 });
    let bat = of(
        shaped(none()),
        json!({ "regions": regions, "attachments": weights, "weighed": weighed }),
    );
    assert!((bat.inertia().mass / 1.7 - 1.0).abs() < 1e-14);
    let before = bat.factors();
    for theory in Theory::ALL {
        for tolerance in [1e-4, 1e-8] {
            let tuned = tuned(bat.clone(), theory, tolerance).unwrap();
            let request = Request { modes: 1, tolerance: 1e-10, theory, ..Request::default() };
            let f = solve(&tuned, &request).unwrap().modes[0].frequency();
            assert!((f / 171.0 - 1.0).abs() < tolerance, "{theory:?}: {f}");
            assert_eq!(tuned.factors()[0], before[0]);
            // One factor for every E and G, whatever the material.
            let stiffer = tuned.factors()[1];
            for (a, b) in tuned.layups().iter().zip(bat.layups()) {
                let (a, b) = (&a.outer, &b.outer);
                assert!((a.youngs_modulus / b.youngs_modulus / stiffer - 1.0).abs() < 1e-14);
                let ratio = a.shear_modulus.unwrap() / b.shear_modulus.unwrap();
                assert!((ratio / stiffer - 1.0).abs() < 1e-14);
                assert_eq!(a.density, b.density);
            }
        }
    }
}

/// The tap determines the stiffness of a bat with any fixtures, without a starting value; hands and soft springs leave
/// slow motions that are not bending.
#[test]
fn a_tap_finds_the_stiffness_of_a_held_bat() {
    let grip = json!({ "grip": { "from": 0, "to": 0.15, "stiffness": 3e4 } });
    let spring = json!({ "attachments": [{ "x": 0, "stiffness": 100 }] });
    let clamp = json!({ "supports": [{ "x": 0, "type": "clamped" }] });
    let joint = json!({ "joints": [{ "x": 0.4, "rotational_stiffness": 5000 }] });
    let absorber = json!({ "absorbers": [{ "x": 0.02, "mass": 0.03, "frequency": 60 }] });
    for (what, bending) in [(grip, 3), (spring, 3), (clamp, 1), (joint, 1), (absorber, 2)] {
        // A spring leaves one motion rigid, and it has no frequency.
        let rigid = usize::from(what.get("attachments").is_some());
        let place = bending - rigid;
        for tolerance in [1e-4, 1e-11] {
            let theory = Theory::EulerBernoulli;
            let request = Request { modes: place, tolerance: 1e-12, theory, ..Request::default() };
            let mut more = what.clone();
            more["material"] = json!({ "density": 700, "youngs_modulus": 1.6e10 });
            let known = solve(&of(shaped(none()), more.clone()), &request).unwrap();
            let tapped = known.modes[place - 1].frequency();
            more["material"] = json!({ "density": 700 });
            more["weighed"] = json!({ "first_bending_hz": tapped });
            let bat = tuned(of(shaped(none()), more), theory, tolerance).unwrap();
            let found = bat.material().youngs_modulus;
            // If half of the bending is in a joint, the stiffness is at least twice as sensitive.
            assert!((found / 1.6e10 - 1.0).abs() < 8.0 * tolerance, "{what} {found:e}");
        }
    }
}

#[test]
fn the_disagreement_of_a_weighed_balance_point_is_a_number_in_table_and_json() {
    let folder = Folder::new("balance");
    let balance = 0.41;
    let bat = of(
        json!({ "interpolation": "linear", "x": [0, LENGTH], "radius": [RADIUS, RADIUS] }),
        json!({ "weighed": { "mass": 0.9, "balance_point": balance } }),
    );
    folder.write(
        "bat.json",
        sweetspot_report::schema::text(&sweetspot_report::report::resolved::resolved(&bat)),
    );
    let document = folder.json(&["modes", "bat.json", "--json", "-"]);
    let weighed = &document["summary"]["weighed"];
    let difference = weighed["balance_point_difference_m"].as_f64().unwrap();
    assert!((difference - (0.5 * LENGTH - balance)).abs() < 1e-15, "{difference}");
    let factor = weighed["density_factor"].as_f64().unwrap();
    // The resolved bat has the weighed density already.
    assert!((factor - 1.0).abs() < 1e-14, "{factor}");
    let table = folder.text(&["modes", "bat.json", "--units", "si"]);
    let line = table.lines().find(|line| line.contains("less the weighed one")).unwrap();
    let shown = line.split_whitespace().rev().nth(1).unwrap().parse::<f64>().unwrap();
    assert!(line.ends_with(" cm") && (0.01 * shown - difference).abs() < 1e-4, "{line}");
}
