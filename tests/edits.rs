//! Edits: a bat is weighed once, and its edits apply afterwards.

use crate::common;

use common::folder::Folder;
use sweetspot::bat::body::STANDARD_PIVOT;
use sweetspot::bat::edit::{Bore, Change, Cork, Cup, Cut, Edit, ScaleDiameter, Shorten, Sleeve};
use sweetspot::{Bat, Material, Request, Theory, solve};
use sweetspot_report::report::resolved::resolved;

const INCH: f64 = 0.0254;
const OUNCE: f64 = 0.028_349_523_125;

/// A maple bat of 33.5 in that weighs 31 oz, with the members in `more` added to its file.
fn maple(more: &str) -> Bat {
    read(more).unwrap_or_else(|said| panic!("{said}"))
}

fn read(more: &str) -> Result<Bat, String> {
    let text = format!(
        r#"{{ "format": "sweetspot-bat/1", "name": "maple", "material": "sugar-maple-dynamic",
  "weighed": {{ "mass": "31 oz" }},
  "profile": {{ "unit": "in", "x": [0, 0.5, 1, 2, 4, 10, 16, 22, 26, 30, 33, 33.5],
    "diameter": [1.8, 2, 1.6, 1.05, 0.98, 1.0, 1.3, 1.95, 2.4, 2.55, 2.5, 2.3] }}{more} }}"#
    );
    Bat::from_text("maple.json", &text, "".as_ref()).map_err(|error| error.to_string())
}

/// A cone in straight lines, 10 to 30 mm in radius, not weighed.
fn cone(length: f64) -> Bat {
    let end = 0.01 + 0.025 * length;
    let text = format!(
        r#"{{ "format": "sweetspot-bat/1", "material": "white-ash-dynamic", "profile":
        {{ "x": [0, {length}], "radius": [0.01, {end}], "interpolation": "linear" }} }}"#
    );
    Bat::from_text("cone.json", &text, "".as_ref()).unwrap()
}

fn edited(bat: &Bat, changes: impl IntoIterator<Item = Change>) -> Bat {
    let edits: Vec<Edit> = changes.into_iter().map(|change| Edit { name: None, change }).collect();
    bat.edited(&edits).unwrap_or_else(|error| panic!("{error}"))
}

fn said(bat: &Bat, change: Change) -> String {
    bat.edited(&[Edit { name: None, change }]).unwrap_err().to_string()
}

fn cut(from: f64, to: f64, depth: f64) -> Change {
    Change::Cut(Cut { from, to, depth, blend: None })
}

fn mass(bat: &Bat) -> f64 {
    bat.inertia().mass
}

fn swing_weight(bat: &Bat) -> f64 {
    bat.inertia().about(STANDARD_PIVOT)
}

fn frequencies(bat: &Bat) -> Vec<f64> {
    let request = Request { modes: 4, tolerance: 1e-9, ..Request::plain() };
    solve(bat, &request).unwrap().modes.iter().map(|mode| mode.frequency()).collect()
}

#[track_caller]
fn close(a: f64, b: f64, tolerance: f64) {
    assert!((a / b - 1.0).abs() < tolerance, "{a} {b}: {:e}", a / b - 1.0);
}

/// `∫ f dx` by Simpson's rule on 20 000 intervals.
fn integral(from: f64, to: f64, f: impl Fn(f64) -> f64) -> f64 {
    const N: usize = 20_000;
    let h = (to - from) / N as f64;
    let weight = |k: usize| if k == 0 || k == N { 1.0 } else { 2.0 + 2.0 * (k % 2) as f64 };
    (0..=N).map(|k| weight(k) * f(from + k as f64 * h)).sum::<f64>() * h / 3.0
}

/// The share of a cut or a factor that applies at `x`: `3v² − 2v³` at both ends.
fn share(x: f64, [from, to]: [f64; 2], blend: f64) -> f64 {
    let v = ((x - from).min(to - x) / blend).clamp(0.0, 1.0);
    v * v * (3.0 - 2.0 * v)
}

#[test]
fn a_bat_without_edits_is_the_same_to_the_last_bit() {
    let bat = maple("");
    assert_eq!(bat.edited(&[]).unwrap(), bat);
    assert_eq!(maple(r#", "edits": []"#), bat);
    assert!(bat.edits().is_empty() && std::ptr::eq(bat.unedited(), &bat));
}

/// The scale gave 31 oz for the bat before, so that the density and all that depends on it are unchanged.
#[test]
fn a_knob_weight_adds_its_mass_and_its_arm_squared_to_a_weighed_bat() {
    let (bat, weighted) = (maple(""), maple(r#", "edits": [ { "knob": "2 oz" } ]"#));
    close(mass(&bat), 31.0 * OUNCE, 1e-14);
    close(mass(&weighted), 33.0 * OUNCE, 1e-14);
    let more = swing_weight(&weighted) - swing_weight(&bat);
    close(more, 2.0 * OUNCE * STANDARD_PIVOT.powi(2), 1e-12);
    assert_eq!(weighted.material(), bat.material());
    assert_eq!(weighted.unedited(), &bat);
}

#[test]
fn a_cut_takes_off_the_mass_that_an_independent_integral_says() {
    let bat = maple("");
    let ends = [24.0 * INCH, 30.0 * INCH];
    for (blend, depth) in [(None, 1e-3), (Some(2.5 * INCH), 1e-3), (Some(3.0 * INCH), 6e-3)] {
        let [from, to] = ends;
        let thinner = edited(&bat, [Change::Cut(Cut { from, to, depth, blend })]);
        let radius = |x: f64| bat.profile().at(x).outer;
        let blend = blend.unwrap_or(INCH);
        let area = |x: f64| {
            let off = 0.5 * depth * share(x, ends, blend);
            off * (2.0 * radius(x) - off)
        };
        let lost = std::f64::consts::PI * bat.material().density * integral(from, to, area);
        close(mass(&bat) - mass(&thinner), lost, 1e-9);
    }
}

#[test]
fn what_a_cut_does_not_touch_keeps_its_radius_and_the_surface_has_no_corner() {
    let bat = maple("");
    let [from, to] = [24.0 * INCH, 30.0 * INCH];
    let thinner = edited(&bat, [cut(from, to, 1e-3)]);
    let radius = |bat: &Bat, x: f64| bat.profile().at(x).outer;
    for x in bat.profile().stations.x.iter().filter(|x| **x <= 22.1 * INCH || **x >= 30.1 * INCH) {
        assert_eq!(radius(&thinner, *x), radius(&bat, *x), "{x}");
    }
    for k in 0..=1000 {
        let x = bat.length() * f64::from(k) / 1000.0;
        let off = 0.5e-3 * share(x, [from, to], INCH);
        assert!((radius(&thinner, x) - radius(&bat, x) + off).abs() < 2e-17, "{x}");
    }
    for x in [from, from + INCH, to - INCH, to] {
        let off = |x: f64| radius(&bat, x) - radius(&thinner, x);
        let h = 1e-6;
        let slopes = [off(x) - off(x - h), off(x + h) - off(x)].map(|rise| rise / h);
        assert!(slopes.iter().all(|slope| slope.abs() < 1e-5), "{x}: {slopes:?}");
    }
}

#[test]
fn a_cut_over_the_tip_goes_on_at_its_full_depth() {
    let bat = maple("");
    let length = bat.length();
    let thinner = edited(&bat, [cut(30.0 * INCH, length, 1e-3)]);
    close(thinner.profile().at(length).outer, bat.profile().at(length).outer - 0.5e-3, 1e-15);
    assert_eq!(thinner.length(), length);
}

#[test]
fn cuts_of_a_formula_are_those_of_its_stations() {
    let text = r#"{ "format": "sweetspot-bat/1", "material": "white-ash-dynamic", "profile":
        { "pieces": [ { "from": 0, "to": 0.8, "formula": "0.01 + 0.025*x" } ] } }"#;
    let written = Bat::from_text("cone.json", text, "".as_ref()).unwrap();
    let from_tip = text.replace(r#""pieces""#, r#""measured_from": "tip", "pieces""#);
    let from_tip = from_tip.replace("0.01 + 0.025*x", "0.03 - 0.025*x");
    let from_tip = Bat::from_text("cone.json", &from_tip, "".as_ref()).unwrap();
    let changes = [
        cut(0.3, 0.5, 2e-3),
        Change::ScaleDiameter(ScaleDiameter { from: 0.1, to: 0.4, by: 1.1, blend: Some(0.02) }),
        Change::Cup(Cup { depth: 0.02, diameter: 0.03 }),
        Change::Shorten(Shorten { knob: Some(0.01), tip: None }),
        Change::Bore(Bore { from: 0.05, to: 0.2, diameter: 0.01 }),
    ];
    let stations = edited(&cone(0.8), changes.clone());
    for bat in [&written, &from_tip] {
        let bat = edited(bat, changes.clone());
        close(mass(&bat), mass(&stations), 1e-12);
        close(swing_weight(&bat), swing_weight(&stations), 1e-12);
        for (a, b) in frequencies(&bat).into_iter().zip(frequencies(&stations)) {
            close(a, b, 1e-8);
        }
    }
}

#[test]
fn a_shortened_bat_is_the_one_that_never_was_longer() {
    let [whole, short] = [cone(0.9), cone(0.85)];
    let tip = edited(&whole, [Change::Shorten(Shorten { knob: None, tip: Some(0.05) })]);
    close(tip.length(), 0.85, 1e-15);
    close(mass(&tip), mass(&short), 1e-13);
    close(swing_weight(&tip), swing_weight(&short), 1e-13);
    for (a, b) in frequencies(&tip).into_iter().zip(frequencies(&short)) {
        close(a, b, 1e-8);
    }
    // At the knob end: the remaining parts change their positions.
    let knob = edited(&whole, [Change::Shorten(Shorten { knob: Some(0.05), tip: None })]);
    close(knob.profile().at(0.1).outer, 0.01 + 0.025 * 0.15, 1e-14);
    close(mass(&knob) + mass(&cone(0.05)), mass(&whole), 1e-13);
}

#[test]
fn places_are_those_of_the_bat_as_it_then_is() {
    let bat = maple("");
    let off = Change::Shorten(Shorten { knob: Some(INCH), tip: None });
    let first = edited(&bat, [off.clone(), cut(23.0 * INCH, 29.0 * INCH, 1e-3)]);
    let last = edited(&bat, [cut(24.0 * INCH, 30.0 * INCH, 1e-3), off.clone()]);
    close(mass(&first), mass(&last), 1e-13);
    let elsewhere = edited(&bat, [off.clone(), cut(24.0 * INCH, 30.0 * INCH, 1e-3)]);
    assert!((mass(&elsewhere) - mass(&last)).abs() > 1e-5);
    let weighted = edited(&bat, [Change::Knob(0.05)]);
    let lost = said(&weighted, off);
    assert!(lost.contains("edits[1].shorten") && lost.contains("saw first, then fix it"), "{lost}");
}

#[test]
fn another_wood_is_itself_and_the_same_wood_changes_nothing() {
    let bat = cone(0.85);
    let wood = |name: &str| Change::Wood(Material::named(name).unwrap());
    let same = edited(&bat, [wood("white-ash-dynamic")]);
    assert_eq!(same.layups(), bat.layups());
    assert_eq!(frequencies(&same), frequencies(&bat));
    // Weighed or not, the new wood has the density of its name, and its moduli.
    let maple = edited(&maple(""), [wood("white-ash-dynamic")]);
    assert_eq!(maple.material(), &Material::named("white-ash-dynamic").unwrap());
}

#[test]
fn a_factor_of_one_changes_nothing_and_one_on_all_diameters_squares_the_mass() {
    let bat = maple("");
    let scaled = |from: f64, to: f64, by: f64| {
        edited(&bat, [Change::ScaleDiameter(ScaleDiameter { from, to, by, blend: None })])
    };
    let same = scaled(5.0 * INCH, 20.0 * INCH, 1.0);
    assert_eq!(same.profile(), bat.profile());
    let wider = scaled(0.0, bat.length(), 1.25);
    close(mass(&wider), 1.5625 * mass(&bat), 1e-14);
    let ends = [5.0 * INCH, 20.0 * INCH];
    let handle = scaled(ends[0], ends[1], 1.1);
    let area = |x: f64| {
        let by = 1.0 + 0.1 * share(x, ends, INCH);
        (by * by - 1.0) * bat.profile().at(x).outer.powi(2)
    };
    let more = std::f64::consts::PI * bat.material().density * integral(ends[0], ends[1], area);
    close(mass(&handle) - mass(&bat), more, 1e-9);
}

/// `a² ∫₀¹ (1 − (1 − v)³)² dv = 9/14 a²`.
#[test]
fn a_cup_takes_out_nine_fourteenths_of_its_cylinder() {
    let bat = maple("");
    let cupped = edited(&bat, [Change::Cup(Cup { depth: INCH, diameter: 1.5 * INCH })]);
    let cylinder = 0.25 * std::f64::consts::PI * (1.5 * INCH).powi(2) * INCH;
    close(mass(&bat) - mass(&cupped), bat.material().density * 9.0 / 14.0 * cylinder, 1e-11);
    close(cupped.profile().at(bat.length()).inner, 0.75 * INCH, 1e-14);
}

#[test]
fn a_corked_bat_is_the_one_whose_file_says_so() {
    let profile = |more: &str| {
        let text = format!(
            r#"{{ "format": "sweetspot-bat/1", "material": "sugar-maple-dynamic", "profile": {{
            "interpolation": "linear", "x": [0, 0.6, 0.6, 0.85], "radius": [0.012, 0.03, 0.03, 0.033]
            {more} }}"#
        );
        Bat::from_text("bat.json", &text, "".as_ref()).unwrap()
    };
    let cork = r#"{ "density": 200, "youngs_modulus": 2e7, "shear_modulus": 8e6 }"#;
    let filed = profile(&format!(
        r#", "inner_radius": [0, 0, 0.0127, 0.0127] }},
        "regions": [ {{ "from": 0.6, "to": 0.85, "core": {cork} }} ]"#
    ));
    let solid = profile("}");
    let mut material = Material::new(200.0, 2e7).unwrap();
    material.shear_modulus = Some(8e6);
    let (from, to, diameter) = (0.6, 0.85, 0.0254);
    let corked = edited(&solid, [Change::Cork(Cork { from, to, diameter, material })]);
    close(mass(&corked), mass(&filed), 1e-14);
    for (a, b) in frequencies(&corked).into_iter().zip(frequencies(&filed)) {
        close(a, b, 1e-9);
    }
    let drilled = edited(&solid, [Change::Bore(Bore { from, to, diameter })]);
    let hole = std::f64::consts::PI * 0.0127_f64.powi(2) * 0.25;
    close(mass(&solid) - mass(&drilled), solid.material().density * hole, 1e-12);
    close(mass(&corked) - mass(&drilled), 200.0 * hole, 1e-12);
}

#[test]
fn a_sleeve_of_the_same_wood_is_a_thicker_bat() {
    let bat = cone(0.85);
    let material = bat.material().clone();
    let (from, to, thickness) = (0.0, 0.85, 0.002);
    let sleeved = edited(&bat, [Change::Sleeve(Sleeve { from, to, thickness, material })]);
    let text = r#"{ "format": "sweetspot-bat/1", "material": "white-ash-dynamic", "profile":
        { "x": [0, 0.85], "radius": [0.012, 0.03325], "interpolation": "linear" } }"#;
    let thick = Bat::from_text("cone.json", text, "".as_ref()).unwrap();
    close(mass(&sleeved), mass(&thick), 1e-13);
    close(swing_weight(&sleeved), swing_weight(&thick), 1e-13);
    for (a, b) in frequencies(&sleeved).into_iter().zip(frequencies(&thick)) {
        close(a, b, 1e-8);
    }
    let refused = said(&sleeved, cut(0.5, 0.6, 1e-3));
    assert!(refused.contains("let this edit come before the sleeve"), "{refused}");
}

/// A sleeve over half of a region splits it; each stretch keeps its properties.
#[test]
fn sleeves_and_regions_lie_over_each_other() {
    let regions = r#", "regions": [ { "from": "10 in", "to": "20 in", "material": "white-ash" } ]"#;
    let regions = regions.replace("\"white-ash\"", "\"white-ash-dynamic\"");
    let bat = read(&regions).unwrap();
    let material = Material::named("aluminium-7075").unwrap();
    let (from, to, thickness) = (15.0 * INCH, 25.0 * INCH, 1e-3);
    let sleeved = edited(&bat, [Change::Sleeve(Sleeve { from, to, thickness, material })]);
    let ring = |x: f64| thickness * (2.0 * bat.profile().at(x).outer + thickness);
    let more = std::f64::consts::PI * 2810.0 * integral(from, to, ring);
    close(mass(&sleeved) - mass(&bat), more, 1e-9);
    assert_eq!(sleeved.fixtures().regions.len(), 3);
}

/// Layers of the wall, drawn within the surface, become sleeves around the remaining inner wall; a resolved bat has
/// them too.
#[test]
fn layers_of_a_wall_are_sleeves_around_what_is_inside() {
    let tube = |diameter: &str, thick: &str, more: &str| {
        let text = format!(
            r#"{{ "format": "sweetspot-bat/1", "material": "white-ash-dynamic", "profile": {{ "x": [0, 0.85],
               "diameter": [{diameter}, {diameter}], "wall_thickness": [{thick}, {thick}] }}{more} }}"#
        );
        Bat::from_text("tube.json", &text, "".as_ref()).map_err(|error| error.to_string())
    };
    let metal =
        r#""material": { "density": 2810, "youngs_modulus": "71 GPa", "poisson_ratio": 0.33 }"#;
    let layers = |inner: &str| {
        format!(
            r#", "regions": [ {{ "from": 0, "to": 0.85, "layers": [
               {{ "thickness": "{inner} mm", {metal} }}, {{ "thickness": "1 mm", "material": "shagbark-hickory" }} ] }} ]"#
        )
    };
    let layered = tube("0.066", "0.005", &layers("1.5")).unwrap();
    let sleeve = |thickness: f64, material: Material| {
        Change::Sleeve(Sleeve { from: 0.0, to: 0.85, thickness, material })
    };
    let around = layered.fixtures().regions[0].layup.sleeves[0].material.clone();
    let hickory = Material::named("shagbark-hickory").unwrap();
    let inside = tube("0.061", "0.0025", "").unwrap();
    let sleeved = edited(&inside, [sleeve(1.5e-3, around), sleeve(1e-3, hickory)]);
    close(mass(&layered), mass(&sleeved), 1e-13);
    for (a, b) in frequencies(&layered).into_iter().zip(frequencies(&sleeved)) {
        close(a, b, 1e-9);
    }
    let written = serde_json::to_string(&resolved(&layered)).unwrap();
    let again = Bat::from_text("again.json", &written, "".as_ref()).unwrap();
    let unnamed = |bat: &Bat| {
        let mut layups = bat.layups().to_vec();
        layups.iter_mut().flat_map(|layup| layup.materials_mut()).for_each(|m| m.name = None);
        layups
    };
    assert_eq!(unnamed(&again), unnamed(&layered));
    let thick = tube("0.066", "0.005", &layers("4")).unwrap_err();
    assert!(thick.contains("layers") && thick.contains("less than the wall's 5 mm"), "{thick}");
    for wrong in ["[]", "[{}]", r#"[{ "thickness": 0, "material": "shagbark-hickory" }]"#, "3"] {
        let said = tube(
            "0.066",
            "0.005",
            &format!(r#", "regions": [ {{ "from": 0, "to": 0.5, "layers": {wrong} }} ]"#),
        );
        assert!(said.as_ref().is_err_and(|said| said.contains("layers")), "{wrong}: {said:?}");
    }
}

/// A tube cut into any bonded layers is the same tube, including its shear and what is on it or in it.
#[test]
fn layers_of_one_metal_are_the_tube_that_they_make() {
    let metal = r#"{ "density": 2810, "youngs_modulus": "71 GPa", "poisson_ratio": 0.33 }"#;
    let tube = |layers: &[&str], core: &str| {
        let layer = |thick: &&str| format!(r#"{{ "thickness": "{thick}", "material": {metal} }}"#);
        let layers: Vec<String> = layers.iter().map(layer).collect();
        let layers = match layers.is_empty() {
            true => String::new(),
            false => format!(r#", "layers": [ {} ]"#, layers.join(", ")),
        };
        let text = format!(
            r#"{{ "format": "sweetspot-bat/1", "material": {metal}, "profile": {{ "unit": "mm", "x": [0, 250, 550, 840],
               "radius": [11, 11, 33, 33], "wall_thickness": [2.5, 2.5, 2.8, 2.8] }},
               "regions": [ {{ "from": 0, "to": 0.84, "material": {metal} {core} {layers} }} ] }}"#
        );
        Bat::from_text("tube.json", &text, "".as_ref()).unwrap()
    };
    let of = |bat: &Bat| {
        let request = Request {
            modes: 5,
            tolerance: 1e-10,
            theory: Theory::Timoshenko,
            ..Request::default()
        };
        let modes = solve(bat, &request).unwrap().modes;
        modes.iter().map(|mode| mode.frequency()).collect::<Vec<_>>()
    };
    let foam = format!(r#", "core": {}"#, metal.replace("71 GPa", "5 GPa"));
    for core in ["", &foam] {
        let whole = of(&tube(&[], core));
        for layers in [&["1 mm"][..], &["0.5 mm", "0.5 mm", "0.5 mm"]] {
            for (a, b) in of(&tube(layers, core)).into_iter().zip(&whole) {
                close(a, *b, 1e-9);
            }
        }
    }
}

/// The tap too was measured on the bat before its edits.
#[test]
fn a_tapped_bat_is_tuned_before_it_is_edited() {
    let weighed = r#", "weighed": { "mass": "31 oz", "first_bending_hz": 160 }"#;
    let text = |edits: &str| {
        format!(
            r#"{{ "format": "sweetspot-bat/1", "material": "sugar-maple-dynamic" {weighed},
            "profile": {{ "x": [0, 0.85], "radius": [0.01, 0.033] }}{edits} }}"#
        )
    };
    let first = |edits: &str| {
        let bat = Bat::from_text("bat.json", &text(edits), "".as_ref()).unwrap();
        let theory = sweetspot::bat::theory::Theory::EulerBernoulli;
        let bat = sweetspot::modes::tuned::tuned(bat, theory, 1e-8).unwrap();
        (frequencies(&bat)[0], bat)
    };
    let (plain, bat) = first("");
    close(plain, 160.0, 1e-6);
    let (weighted, changed) = first(r#", "edits": [ { "name": "knob", "knob": "2 oz" } ]"#);
    assert!(weighted < 150.0, "{weighted}");
    assert_eq!(changed.material(), bat.material());
    assert_eq!(changed.edits()[0].name.as_deref(), Some("knob"));
}

#[test]
fn an_edit_that_does_not_fit_is_told_with_its_place_and_its_name() {
    let mut wrong = vec![];
    for (edits, expected) in [
        (
            r#"{ "cut": { "from": "24 in", "to": "40 in", "depth": "1 mm" } }"#,
            "maple.json:4:128: edits[0].cut.to: found \"40 in\"",
        ),
        (
            r#"{ "name": "slim", "cut": { "from": 0.6, "to": 0.7, "depth": 0.2 } }"#,
            "edits[0].cut: found no wood left near",
        ),
        (
            r#"{ "name": "slim", "cut": { "from": 0.6, "to": 0.7, "depth": 0.2 } }"#,
            "this is of the edit \"slim\"",
        ),
        (
            r#"{ "knob": "1 oz" }, { "cut": { "from": 0.6, "to": 0.7, "depth": 1e-3, "blend": 0.06 } }"#,
            "edits[1].cut.blend: found 0.06 m, expected 0.0500 m (1.97 in) at most, half of the stretch",
        ),
        (
            r#"{ "cut": { "from": 0.6, "to": 0.7, "depth": 0 } }"#,
            "edits[0].cut.depth: found 0 m, expected a number above 0",
        ),
        (r#"{ "cut": { "from": 0.6, "to": 0.7 } }"#, "how much thinner the bat becomes"),
        (
            r#"{ "knob": "2 oz", "cup": { "depth": 0.02, "diameter": 0.03 } }"#,
            "found both \"knob\" and \"cup\", expected one of them",
        ),
        (r#"{ "name": "nothing" }"#, "found no change, expected one of \"cut\", \"knob\""),
        (r#"{ "knob": 0 }"#, "edits[0].knob: found 0 kg, expected a mass above 0"),
        (r#"{ "knob": "2 in" }"#, "edits[0].knob"),
        (
            r#"{ "cup": { "depth": "1 in", "diameter": "2.4 in" } }"#,
            "edits[0].cup: found no wood left near",
        ),
        (
            r#"{ "bore": { "from": 0.1, "to": 0.5, "diameter": "1 in" } }"#,
            "a hole of 25.40 mm (1.000 in) in a bat",
        ),
        (
            r#"{ "bore": { "from": 0.6, "to": 0.8, "diameter": "1 in" } },
            { "bore": { "from": 0.7, "to": 0.8, "diameter": "0.5 in" } }"#,
            "edits[1].bore.diameter: found \"0.5 in\" (a hole of 12.70 mm (0.500 in)), expected a wider one",
        ),
        (
            r#"{ "bore": { "from": 0.6, "to": 0.85, "diameter": "1 in" } },
            { "cup": { "depth": "1 in", "diameter": "1.5 in" } }"#,
            "edits[1].cup: found a bat that is hollow there",
        ),
        (r#"{ "shorten": { "knob": 0.5, "tip": 0.5 } }"#, "edits[0].shorten: found 1 m sawn off"),
        (r#"{ "shorten": {} }"#, "edits[0].shorten: found none of \"knob\", \"tip\""),
        (r#"{ "wood": "balsa" }"#, "edits[0].wood: found \"balsa\""),
        (r#"{ "trim": 1 }"#, "found no change, expected one of \"cut\""),
        (
            r#"{ "scale_diameter": { "from": 0.1, "to": 0.2, "by": -1 } }"#,
            "edits[0].scale_diameter.by: found -1",
        ),
    ] {
        let said = read(&format!(", \"edits\": [ {edits} ]")).unwrap_err();
        if !said.contains(expected) {
            wrong.push(format!("{edits}\n{said}\n{expected}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

/// A folder with a maple that weighs 31 oz and is not edited.
fn shop(test: &str) -> Folder {
    let folder = Folder::new(test);
    folder.write(
        "maple.json",
        r#"{ "format": "sweetspot-bat/1", "name": "maple", "material": "sugar-maple-dynamic",
  "weighed": { "mass": "31 oz" },
  "profile": { "unit": "in", "x": [0, 0.5, 1, 2, 4, 10, 16, 22, 26, 30, 33, 33.5],
    "diameter": [1.8, 2, 1.6, 1.05, 0.98, 1.0, 1.3, 1.95, 2.4, 2.55, 2.5, 2.3] } }"#,
    );
    folder
}

#[test]
fn options_are_the_edits_of_a_file_in_the_order_typed() {
    let folder = shop("edit_options");
    let typed = [
        ("--shorten", "knob 0.5 in", r#"{ "shorten": { "knob": "0.5 in" } }"#),
        ("--knob", "2 oz", r#"{ "knob": "2 oz" }"#),
        (
            "--cut",
            "24 in to 30 in, 1 mm",
            r#"{ "cut": { "from": "24 in", "to": "30 in", "depth": "1 mm" } }"#,
        ),
        (
            "--cut",
            "4 in to 10 in, 0.5 mm, 2 in blend",
            r#"{ "cut": { "from": "4 in", "to": "10 in", "depth": "0.5 mm", "blend": "2 in" } }"#,
        ),
        (
            "--cup",
            "1 in deep, 1.5 in wide",
            r#"{ "cup": { "depth": "1 in", "diameter": "1.5 in" } }"#,
        ),
        (
            "--bore",
            "20 in to 25 in, 0.5 in",
            r#"{ "bore": { "from": "20 in", "to": "25 in", "diameter": "0.5 in" } }"#,
        ),
        (
            "--cork",
            "20 in to 25 in, 0.5 in, 200 kg/m^3, 20 MPa, 8 MPa",
            r#"{ "cork": { "from": "20 in", "to": "25 in", "diameter": "0.5 in",
            "material": { "density": 200, "youngs_modulus": 2e7, "shear_modulus": 8e6 } } }"#,
        ),
        (
            "--scale-diameter",
            "11 in to 14 in, by 1.05",
            r#"{ "scale_diameter": { "from": "11 in", "to": "14 in", "by": 1.05 } }"#,
        ),
        (
            "--sleeve",
            "26 in to 30 in, 1 mm thick, aluminium-7075",
            r#"{ "sleeve": { "from": "26 in", "to": "30 in", "thickness": "1 mm", "material": "aluminium-7075" } }"#,
        ),
        ("--wood", "white-ash-dynamic", r#"{ "wood": "white-ash-dynamic" }"#),
    ];
    let plain = folder.read("maple.json");
    let edits: Vec<&str> = typed.iter().map(|(_, _, edit)| *edit).collect();
    let edits = format!(", \"edits\": [ {} ] }}", edits.join(", "));
    folder.write("edited.json", plain.trim_end().strip_suffix('}').unwrap().to_owned() + &edits);
    let mut args = vec!["modes", "maple.json", "-n", "2", "--json", "-"];
    args.extend(typed.iter().flat_map(|(option, value, _)| [*option, *value]));
    let by_options = folder.json(&args);
    let by_file = folder.json(&["modes", "edited.json", "-n", "2", "--json", "-"]);
    for key in ["bat", "summary", "modes"] {
        assert_eq!(by_options[key], by_file[key], "{key}");
    }
    let listed = by_file["bat"]["edits"].as_array().unwrap();
    assert_eq!(listed.len(), typed.len());
    assert_eq!(listed[1]["knob"], 2.0 * OUNCE);
    // The resolved bat is a bat file for the same bat.
    folder.write("understood.json", by_file["bat"].to_string());
    let again = folder.json(&["modes", "understood.json", "-n", "2", "--json", "-"]);
    for key in ["mass_kg", "inertia_pivot_kg_m2", "balance_point_m"] {
        let [a, b] = [&again, &by_file].map(|file| file["summary"][key].as_f64().unwrap());
        close(a, b, 1e-14);
    }
    // In the other order a cut is elsewhere.
    let turned = ["modes", "maple.json", "-n", "2", "--json", "-", "--cut", "24 in to 30 in, 1 mm"];
    let turned = folder.json(&[&turned[..], &["--shorten", "knob 1 in"]].concat());
    assert_eq!(turned["bat"]["edits"][1]["shorten"]["knob"], INCH);
}

#[test]
fn every_table_says_what_was_edited() {
    let folder = shop("edit_tables");
    let knob = ["--knob", "2 oz", "--units", "us"];
    for args in [
        &["modes", "maple.json", "-n", "2"][..],
        &["hit", "maple.json", "--at", "28 in", "-n", "3"],
        &["advise", "maple.json", "-n", "1", "--tol", "5%"],
        &["bbcor", "maple.json", "--tol", "1e-2"],
        &["frf", "maple.json", "--at", "28 in", "-n", "2"],
        &["analyze", "maple.json"],
        &["analyze", "maple.json", "--full"],
    ] {
        let text = folder.text(&[args, &knob[..]].concat());
        assert!(text.contains("edited: knob 2 oz"), "{args:?}\n{text}");
    }
}

/// Inches stay inches and millimetres stay millimetres, regardless of the units of the table.
#[test]
fn an_edit_is_told_in_the_units_it_was_typed_in() {
    let folder = shop("edit_words");
    for (option, typed) in [
        ("--cut", "24 in to 30 in, 1 mm"),
        ("--cut", "600 mm to 700 mm, 0.0625 in, 1 in blend"),
        ("--cut", "61.5 mm to 702.3 mm, 0.8 mm"),
        ("--knob", "2 oz"),
        ("--knob", "50 g"),
        ("--knob", "0.75 oz"),
        ("--cup", "1 in deep, 1.5 in"),
        ("--cup", "25 mm deep, 40 mm"),
        ("--bore", "26.25 in to 32 in, 0.875 in"),
        ("--sleeve", "24 in to 30 in, 1 mm, aluminium-7075"),
        ("--shorten", "tip 0.5 in"),
        ("--scale-diameter", "100 mm to 300 mm, 1.05"),
    ] {
        let said = format!("edited: {} {typed}", &option[2..]);
        let modes = folder.text(&["modes", "maple.json", "-n", "1", option, typed]);
        assert!(modes.contains(&said), "{said}\n{modes}");
        let si = folder.text(&["modes", "maple.json", "-n", "1", "--units", "si", option, typed]);
        assert!(!si.lines().any(|line| line.contains("edited") && line.contains(" in")), "{si}");
    }
}

#[test]
fn every_document_says_what_was_edited() {
    let folder = shop("edit_documents");
    for args in [
        &["modes", "maple.json", "-n", "1"][..],
        &["hit", "maple.json", "--at", "28 in", "-n", "3"],
        &["advise", "maple.json", "-n", "1", "--tol", "5%"],
        &["bbcor", "maple.json", "--tol", "1e-2"],
        &["ring", "maple.json", "--hit", "28 in", "-n", "3"],
        &["ring", "maple.json", "--at", "28 in", "--impulse", "1", "-n", "2"],
        &["frf", "maple.json", "--at", "28 in", "-n", "2"],
        &["trade", "maple.json", "-n", "1", "--budget", "100ms"],
    ] {
        let with = |more: &[&str]| folder.json(&[args, more, &["--json", "-", "--quiet"]].concat());
        let told = |file: &serde_json::Value| {
            file["bat"].get("edits").or(file.get("edits")).map(|edits| edits[0]["knob"].clone())
        };
        assert_eq!(told(&with(&["--knob", "2 oz"])).unwrap(), 2.0 * OUNCE, "{args:?}");
        assert_eq!(told(&with(&[])), None, "{args:?}");
    }
}

#[test]
fn a_bat_stands_beside_itself_changed_and_a_hidden_change_is_told() {
    let folder = shop("edit_compare");
    let args = ["compare", "maple.json", "-n", "3", "--json", "-"];
    let edits =
        ["--edit", "knob 2 oz", "--edit", "slim: cut 24 in to 30 in, 1 mm; cup 1 in deep, 1.5 in"];
    let file = folder.json(&[&args[..], &edits[..]].concat());
    let bats = file["bats"].as_array().unwrap();
    let names: Vec<&str> = bats.iter().map(|bat| bat["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["maple", "maple: knob 2 oz", "maple: slim"]);
    assert!(bats[0].get("edits").is_none());
    assert_eq!(bats[2]["edits"][1]["name"], "slim");
    let figure = |k: usize, key: &str| bats[k]["figures"][key]["difference"].as_f64().unwrap();
    close(figure(1, "mass_kg"), 2.0 * OUNCE, 1e-9);
    close(figure(1, "swing_weight_kg_m2"), 2.0 * OUNCE * STANDARD_PIVOT.powi(2), 1e-8);
    assert!(figure(2, "mass_kg") < 0.0 && figure(2, "swing_weight_kg_m2") < 0.0);

    // As it was done before there were edits: the weighed mass hides the change.
    let thinner = folder.read("maple.json").replace("2.4, 2.55", "2.36, 2.51");
    folder.write("thinner.json", thinner);
    let warned = folder.run(&["compare", "maple.json", "thinner.json", "-n", "3"]);
    let said = String::from_utf8_lossy(&warned.stderr).into_owned();
    assert!(said.contains("thinner.json and maple.json are both weighed at 0.8788 kg"), "{said}");
    assert!(said.contains("write the change as an edit"), "{said}");
    let quiet = folder.run(&["compare", "maple.json", "maple.json", "-n", "3"]);
    assert!(quiet.stderr.is_empty());
}

#[test]
fn words_that_are_no_edit_are_told_with_how_one_is_written() {
    let folder = shop("edit_words");
    for (args, expected) in [
        (&["--cut", "24 in, 1 mm"][..], "expected a stretch, such as \"24 in to 30 in\""),
        (
            &["--cut", "24 in to 40 in, 1 mm"],
            "--cut, to: found 1.016 m, expected a place on the bat",
        ),
        (&["--cut", "24 to 30, 1 mm"], "24 in or 24 m?"),
        (
            &["--knob", "1 oz", "--cut", "24 in to 30 in, 9 in"],
            "edit 2 of 2, --cut: found no wood left near",
        ),
        (&["--cup", "1 in"], "expected \"diameter\": how wide the cup is at the tip"),
        (&["--shorten", "1 in"], "found \"1 in\", expected knob or tip"),
        (&["--sleeve", "24 in to 30 in, 1 mm, aluminum-7075"], "did you mean aluminium-7075?"),
        (&["--scale-diameter", "4 in to 8 in, 5 %"], "expected a factor, such as 1.05"),
        (&["--knob", "2"], "2 oz or 2 kg?"),
    ] {
        let run = folder.run(&[&["modes", "maple.json"], args].concat());
        let said = String::from_utf8_lossy(&run.stderr).into_owned();
        assert!(run.status.code() == Some(2) && said.contains(expected), "{args:?}\n{said}");
    }
    for (edit, expected) in [
        ("slim cut 2", "found \"slim\", expected one of cut, knob"),
        ("shortn tip 1 in", "did you mean shorten?"),
        (": knob 2 oz", "found no name before the colon"),
        ("slim:", "found no edit"),
        (
            "slim: knob 2 oz; cut 24 in to 40 in, 1 mm",
            "edit 2 of 2, --edit slim, cut, to: found 1.016 m",
        ),
    ] {
        let run = folder.run(&["compare", "maple.json", "--edit", edit]);
        let said = String::from_utf8_lossy(&run.stderr).into_owned();
        assert!(run.status.code() == Some(2) && said.contains(expected), "{edit:?}\n{said}");
    }
}
