//! A profile in formulas is the same bat as one in stations, where stations can represent it.

use crate::common;

use common::{DENSITY, LENGTH, MODULUS, RADIUS, bat, cone, dowel, dowel_frequency};
use serde_json::{Value, json};
use std::path::Path;
use sweetspot::bat::material::Material;
use sweetspot::bat::profile::{Interpolation, Profile, Stations};
use sweetspot::{Bat, Request, solve};
use sweetspot_proof::bundled::bundled_bat;
use sweetspot_report::report::json::{ShapePoints, modes};

const REQUEST: Request = Request {
    modes: 8,
    tolerance: 1e-8,
    elements: Some(64),
    degree: None,
    solver: sweetspot::Solver::Statics,
    theory: sweetspot::bat::theory::Theory::EulerBernoulli,
};

/// A bat of the common material with that `profile`.
fn read(profile: Value) -> Bat {
    let file = json!({
        "format": "sweetspot-bat/1",
        "material": { "density": DENSITY, "youngs_modulus": MODULUS },
        "profile": profile,
    });
    Bat::from_text("bat.json", &file.to_string(), Path::new("")).unwrap()
}

fn piece(from: f64, to: f64, formula: &str) -> Value {
    json!({ "from": from, "to": to, "formula": formula })
}

fn one(formula: &str) -> Bat {
    read(json!({ "pieces": [piece(0.0, LENGTH, formula)] }))
}

fn frequencies(bat: &Bat) -> Vec<f64> {
    solve(bat, &REQUEST).unwrap().modes.iter().map(|mode| mode.frequency()).collect()
}

/// Same frequencies and same rigid body, to these relative errors.
fn assert_same(a: &Bat, b: &Bat, frequency: f64, rigid: f64) {
    for (n, (a, b)) in frequencies(a).iter().zip(frequencies(b)).enumerate() {
        assert!((a / b - 1.0).abs() < frequency, "mode {}: {:e}", n + 1, a / b - 1.0);
    }
    let body = |bat: &Bat| {
        let body = bat.inertia();
        [body.mass, body.balance_point, body.about_balance, body.line_about_balance]
    };
    for (a, b) in body(a).into_iter().zip(body(b)) {
        assert!((a / b - 1.0).abs() < rigid, "{a} {b}: {:e}", a / b - 1.0);
    }
}

#[test]
fn a_straight_line_is_the_cone_of_stations() {
    let formula = one(&format!("0.0125 + 0.0205*x/{LENGTH}"));
    assert_same(&formula, &cone(0.0125, 0.033), 1e-12, 1e-13);
}

#[test]
fn a_cone_may_come_to_a_point() {
    let formula = one(&format!("0.033*x/{LENGTH}"));
    assert_same(&formula, &cone(0.0, 0.033), 1e-12, 1e-13);
    // Round-off of the formula at the tip is not a radius.
    let turned = one(&format!("0.033 - 0.033/{LENGTH}*x"));
    assert_same(&turned, &cone(0.033, 0.0), 1e-12, 1e-13);
    let pointed = one("0.03*(0.1 + 0.2 - 0.3 + x)");
    assert_eq!(pointed.profile().stations.outer[0], 0.0);
}

#[test]
fn a_constant_is_the_dowel() {
    let formula = one(&RADIUS.to_string());
    assert_same(&formula, &dowel(), 1e-13, 1e-13);
    let fine = Request { elements: None, ..REQUEST };
    for mode in solve(&formula, &fine).unwrap().modes {
        let exact = dowel_frequency(mode.order);
        assert!((mode.frequency() / exact - 1.0).abs() < 1e-8, "{}", mode.frequency());
    }
}

#[test]
fn a_jump_between_pieces_is_the_step_of_stations() {
    let formula = read(json!({ "pieces": [
        piece(0.0, 0.3, "0.02"), piece(0.3, 0.5, "0.03"), piece(0.5, LENGTH, "0.025 + 0.01*(x - 0.5)"),
    ] }));
    let (x, end) = ([0.0, 0.3, 0.3, 0.5, 0.5, LENGTH], 0.025 + 0.01 * (LENGTH - 0.5));
    let outer = [0.02, 0.02, 0.03, 0.03, 0.025, end];
    assert_same(&formula, &bat(&x, &outer, &[0.0; 6], Interpolation::Linear), 1e-12, 1e-13);
    assert_eq!(formula.profile().stations.x, x);
}

#[test]
fn a_bore_is_the_bore_of_stations() {
    let formula = read(json!({ "pieces": [{
        "from": "0 in", "to": "33 in",
        "formula": "0.0125 + 0.0205*x/0.8382", "inner_formula": "0.004 + 0.02*x/0.8382",
    }] }));
    let stations = bat(&[0.0, LENGTH], &[0.0125, 0.033], &[0.004, 0.024], Interpolation::Linear);
    assert_same(&formula, &stations, 1e-12, 1e-13);
    // A radius is the square root of its square, and a bore is at least 0.
    let solid = read(json!({ "pieces": [{
        "from": 0, "to": LENGTH, "formula": "sqrt((0.0125 + 0.02*x)**2)", "inner_formula": "0*x",
    }] }));
    assert_same(&solid, &one("0.0125 + 0.02*x"), 1e-13, 1e-13);
}

/// Fritsch and Carlson's cubic through three stations at equal distances h, slopes as SciPy has them:
/// the harmonic mean of both rises inside; at the ends `(3 rise − next rise)/2`, 0 where that turns
/// back.
#[test]
fn polynomials_are_the_cubic_of_stations() {
    let (h, radii) = (0.5 * LENGTH, [0.02, 0.022, 0.03]);
    let stations = bat(&[0.0, h, LENGTH], &radii, &[0.0; 3], Interpolation::Pchip);
    let rises = [(radii[1] - radii[0]) / h, (radii[2] - radii[1]) / h];
    let inside = 2.0 * rises[0] * rises[1] / (rises[0] + rises[1]);
    let slopes = [0.0, inside, 1.5 * rises[1] - 0.5 * rises[0]];
    let cubic = |k: usize| {
        let (from, [a, b]) = (k as f64 * h, [slopes[k], slopes[k + 1]]);
        let (square, cube) = ((3.0 * rises[k] - 2.0 * a - b) / h, (a + b - 2.0 * rises[k]) / h / h);
        let x = format!("(x - {from})");
        let formula = format!("{} + ({a})*{x} + ({square})*{x}**2 + ({cube})*{x}**3", radii[k]);
        piece(from, if k == 1 { LENGTH } else { h }, &formula)
    };
    let formula = read(json!({ "pieces": [cubic(0), cubic(1)] }));
    assert_same(&formula, &stations, 1e-12, 1e-13);
}

#[test]
fn counted_from_the_tip_it_is_the_same_bat() {
    let shape = "0.0127 + 0.0102*(1 + tanh((x - 0.50)/0.11)) + max(0, 0.3 - x)/90";
    let turned = shape.replace('x', "(0.84 - x)").replace("ma(0.84 - x)", "max");
    let from_knob = read(json!({ "pieces": [
        piece(0.0, 0.2, shape), piece(0.2, 0.84, &format!("0.002 + {shape}")),
    ] }));
    let from_tip = read(json!({ "measured_from": "tip", "pieces": [
        piece(0.0, 0.84 - 0.2, &format!("0.002 + {turned}")), piece(0.84 - 0.2, 0.84, &turned),
    ] }));
    assert_same(&from_tip, &from_knob, 1e-12, 1e-12);
    for corner in [0.2, 0.3] {
        let starts = from_knob.profile().pieces.iter().map(|piece| piece.start);
        assert!(starts.into_iter().any(|start| (start - corner).abs() < 1e-15), "{corner}");
    }
    for x in [0.0, 0.1, 0.19, 0.21, 0.29, 0.31, 0.5, 0.84] {
        let (a, b) = (from_tip.profile().at(x).outer, from_knob.profile().at(x).outer);
        assert!((a / b - 1.0).abs() < 1e-14, "{x}: {a} {b}");
    }
    let twice = from_knob.profile().clone().reversed().reversed();
    assert_eq!(twice.formulas, from_knob.profile().formulas);
    assert!((twice.at(0.3).outer / from_knob.profile().at(0.3).outer - 1.0).abs() < 1e-15);
}

#[test]
fn a_corner_is_the_end_of_a_piece() {
    let roof = one("0.02 + 0.01*abs(x - 0.4)");
    let starts: Vec<f64> = roof.profile().pieces.iter().map(|piece| piece.start).collect();
    assert_eq!(starts, [0.0, 0.4]);
    let radius = |x: f64| 0.02 + 0.01 * (x - 0.4_f64).abs();
    let (x, outer) = ([0.0, 0.4, LENGTH], [0.0, 0.4, LENGTH].map(radius));
    assert_same(&roof, &bat(&x, &outer, &[0.0; 3], Interpolation::Linear), 1e-12, 1e-13);
    let clamped = one("min(0.033, max(0.0125, 0.07*x - 0.02))");
    assert_eq!(clamped.profile().pieces.len(), 3);
    assert!((clamped.profile().pieces[1].start - 0.0325 / 0.07).abs() < 1e-15);
}

/// The same smooth bat as 2000 straight stations, whose chords have the error `h² r″/8`.
#[test]
fn a_smooth_bat_is_the_limit_of_its_stations() {
    let formula = bundled_bat("meshes/tanh.json").unwrap();
    let x: Vec<f64> = (0..=2000).map(|k| 0.84 * f64::from(k) / 2000.0).collect();
    let radius = |x: &f64| 0.0127 + 0.0102 * (1.0 + ((x - 0.50) / 0.11).tanh());
    let outer: Vec<f64> = x.iter().map(radius).collect();
    for (x, r) in x.iter().zip(&outer) {
        assert!((formula.profile().at(*x).outer / r - 1.0).abs() < 1e-15);
    }
    let inner = vec![0.0; x.len()];
    let profile =
        Profile::new(Stations { x, outer, inner, interpolation: Interpolation::Linear }).unwrap();
    let stations =
        Bat::builder(profile, formula.material().clone()).name("stations").build().unwrap();
    let fine = Request { elements: Some(2000), ..REQUEST };
    let of = |bat: &Bat| solve(bat, &fine).unwrap().modes;
    for (a, b) in of(&formula).iter().zip(of(&stations)) {
        let error = a.frequency() / b.frequency() - 1.0;
        assert!(error.abs() < 3e-6, "mode {}: {error:e}", a.order);
    }
    // A Riemann sum of a function that is nearly flat at its ends, to the error of the chords.
    let mass = formula.inertia().mass;
    assert!((mass / stations.inertia().mass - 1.0).abs() < 3e-6, "{mass}");
}

/// `∫ r² dx` of a shape with a square root at its end, against its closed form.
#[test]
fn mass_is_exact_for_a_round_end() {
    // An ellipsoid of half-axes a and b: volume 4/3 π a b².
    let half = 0.4;
    let round =
        read(json!({ "pieces": [piece(0.0, 0.8, "0.03*sqrt(max(0, 1 - (x/0.4 - 1)**2))")] }));
    let volume = 4.0 / 3.0 * std::f64::consts::PI * half * 0.03 * 0.03;
    let body = round.inertia();
    assert!((body.mass / (DENSITY * volume) - 1.0).abs() < 1e-13);
    assert!((body.balance_point / half - 1.0).abs() < 1e-13);
    // Transverse inertia of an ellipsoid: m (a² + b²)/5.
    let inertia = body.mass * (half * half + 9e-4) / 5.0;
    assert!((body.about_balance / inertia - 1.0).abs() < 1e-13);
    assert!(solve(&round, &Request { modes: 3, ..Request::plain() }).unwrap().met());
}

#[test]
fn the_bat_in_a_report_is_a_bat_file_of_the_same_bat() {
    for from in ["knob", "tip"] {
        let original = read(json!({ "measured_from": from, "pieces": [
            { "from": 0, "to": "10 in", "formula": "0.02 - 0.01*x", "inner_formula": "0.01" },
            { "from": 0.254, "to": 0.8, "formula": "0.03" },
        ] }));
        let solution = solve(&original, &REQUEST).unwrap();
        let report = modes(&original, &solution, ShapePoints::Even(0), false);
        let report = sweetspot_report::schema::value(&report);
        assert_eq!(report["bat"]["profile"]["measured_from"], from);
        assert_eq!(report["bat"]["profile"]["pieces"][0]["inner_formula"], "0.01");
        let again = Bat::from_text("echo", &report["bat"].to_string(), Path::new("")).unwrap();
        assert_eq!(again.profile(), original.profile());
    }
}

#[test]
fn warnings_know_the_widest_place() {
    let warned = |formula: &str| one(formula).warnings().join("\n");
    assert!(warned("0.02 + 0.05*exp(-((x - 0.4)/0.05)**2)").contains("largest radius is 0.07 m"));
    assert!(!warned("0.02 + 0.01*exp(-((x - 0.4)/0.05)**2)").contains("largest radius"));
}

#[test]
fn a_weighed_mass_sets_the_density_of_a_formula() {
    let shape = one("0.0127 + 0.0102*(1 + tanh((x - 0.50)/0.11))").profile().clone();
    let material = Material::new(DENSITY, MODULUS).unwrap();
    let weighed = Bat::builder(shape, material).name("weighed").mass(Some(0.9)).build().unwrap();
    assert!((weighed.inertia().mass / 0.9 - 1.0).abs() < 1e-13);
}

/// A wave never reaches the point of a tip whose radius falls as the square of the distance, so there is no mode.
#[test]
fn a_tip_from_which_no_wave_comes_back_is_refused() {
    let said = |profile: Value| {
        let file = json!({
            "format": "sweetspot-bat/1",
            "material": { "density": DENSITY, "youngs_modulus": MODULUS },
            "profile": profile,
        });
        let read = Bat::from_text("bat.json", &file.to_string(), Path::new(""));
        read.map_or_else(|why| why.to_string(), |_| String::new())
    };
    let formula = |text: &str| said(json!({ "pieces": [piece(0.0, 0.84, text)] }));
    for text in ["0.03*(x/0.84)^2", "0.03*(1 - x/0.84)^3", "0.01*(1 - cos(2*x))", "0.03*x^2.01"] {
        assert!(formula(text).contains("no wave ever arrives"), "{text} {}", formula(text));
    }
    for text in ["0.03*(x/0.84)^1.5", "0.03*x/0.84", "0.03*sqrt(1 - x/0.84)", "1e-5 + 0.03*x^2"] {
        assert_eq!(formula(text), "", "{text}");
    }
    let stations = |interpolation: &str| {
        let x = [0.0, 0.1, 0.2, 0.84];
        let radius = [0.0, 0.001, 0.02, 0.03];
        said(json!({ "interpolation": interpolation, "x": x, "radius": radius }))
    };
    assert!(stations("pchip").contains("no wave ever arrives"), "{}", stations("pchip"));
    assert_eq!(stations("linear"), "");
}
