//! Comparison of the three theories: each is the limit of the next, and none is too stiff.

use crate::common;

use std::f64::consts::{PI, TAU};

use common::{LENGTH, MODULUS, bat};
use sweetspot::bat::material::Material;
use sweetspot::bat::profile::{Interpolation, Profile, Stations};
use sweetspot::bat::theory::Theory;
use sweetspot::{Bat, Request, Solution, solve};
use sweetspot_proof::bundled::bundled_bat;
use sweetspot_proof::validation::Truth;

/// A bat with the shear modulus of wood.
fn sheared(bat: Bat) -> Bat {
    bat.with(|parts| parts.material.shear_modulus = Some(MODULUS / 14.0)).unwrap()
}

fn uniform(radius: f64) -> Bat {
    sheared(bat(&[0.0, LENGTH], &[radius; 2], &[0.0; 2], Interpolation::Linear))
}

fn solved(bat: &Bat, theory: Theory, modes: usize, tolerance: f64) -> Solution {
    let request = Request { modes, tolerance, theory, ..Request::default() };
    let solution = solve(bat, &request).unwrap();
    assert!(solution.met(), "{}", solution.ending);
    solution
}

/// Rayleigh's beam is Euler–Bernoulli's with more inertia, Timoshenko's is Rayleigh's with freedom
/// to shear: by the minimum principle no mode is faster.
#[test]
fn every_mode_is_slower_from_theory_to_theory() {
    let cone = sheared(bat(&[0.0, LENGTH], &[0.0125, 0.033], &[0.0; 2], Interpolation::Linear));
    let tube = bat(&[0.0, LENGTH], &[0.016, 0.033], &[0.012, 0.03], Interpolation::Linear);
    for bat in [bundled_bat("meshes/r161.json").unwrap(), cone, sheared(tube)] {
        let of = |theory| solved(&bat, theory, 40, 1e-6).modes;
        let [plain, rayleigh, timoshenko] = Theory::ALL.map(of);
        for ((plain, rayleigh), timoshenko) in plain.iter().zip(&rayleigh).zip(&timoshenko) {
            assert!(rayleigh.omega < plain.omega && timoshenko.omega < rayleigh.omega);
        }
    }
}

/// To first order shear and rotary inertia take `½ (I/A)(E/κG + 1) ∫w″²…/∫w²…` off a frequency:
/// with the square of the slenderness, 100 times less for a bat 10 times as slender.
#[test]
fn what_shear_takes_off_falls_with_the_square_of_the_slenderness() {
    let taken = |radius: f64| -> Vec<f64> {
        let bat = uniform(radius);
        let of = |theory| solved(&bat, theory, 4, 1e-13).modes;
        let pairs = of(Theory::Timoshenko).into_iter().zip(of(Theory::EulerBernoulli));
        pairs.map(|(a, b)| 1.0 - a.omega / b.omega).collect()
    };
    for (thick, thin) in taken(2e-4).into_iter().zip(taken(2e-5)) {
        // The next order is 100 times smaller again; differences of 1e-8 are accurate to 1e-13.
        assert!((thick / thin / 100.0 - 1.0).abs() < 1e-3, "{thick} {thin}");
    }
}

/// Elements that lock are too stiff by a factor of the slenderness; the error of these is as small as without shear.
#[test]
fn slender_bats_do_not_lock() {
    for radius in [4e-3, 4e-5, 4e-7] {
        let bat = uniform(radius);
        let error = |theory| -> Vec<f64> {
            let on = |elements, degree| {
                let (elements, degree) = (Some(elements), Some(degree));
                let request = Request { modes: 3, elements, degree, theory, ..Request::default() };
                solve(&bat, &request).unwrap().modes
            };
            let pairs = on(8, 3).into_iter().zip(on(6, 11));
            pairs.map(|(coarse, fine)| coarse.omega / fine.omega - 1.0).collect()
        };
        let errors = error(Theory::EulerBernoulli).into_iter().zip(error(Theory::Timoshenko));
        for (plain, sheared) in errors {
            assert!((sheared / plain - 1.0).abs() < 0.02, "{radius}: {sheared:e} {plain:e}");
        }
    }
}

/// `2(p − 1)` powers of the number of elements, with shear as without: slopes between meshes with errors far above
/// round-off.
#[test]
fn the_order_with_shear_is_twice_the_degree_less_two() {
    let truth = Truth::of_cases(&["timo_cone"]).unwrap();
    for (degree, mode) in [(3, 3), (4, 3), (5, 5), (6, 8), (7, 10), (8, 12)] {
        let points: Vec<[f64; 2]> = (2..=60)
            .filter_map(|elements| {
                let request = Request {
                    modes: mode,
                    elements: Some(elements),
                    degree: Some(degree),
                    theory: Theory::Timoshenko,
                    ..Request::default()
                };
                let found = solve(&truth.bat, &request).ok()?.modes.pop()?;
                let error = found.frequency() / truth.frequencies[mode - 1] - 1.0;
                let counts = error < 1e-5 && error > 30.0 * found.error.round_off;
                counts.then_some([(elements as f64).ln(), error.ln()])
            })
            .collect();
        let count = points.len() as f64;
        assert!(count >= 3.0, "degree {degree}: {points:?}");
        let mean = |i: usize| points.iter().map(|p| p[i]).sum::<f64>() / count;
        let (x, y) = (mean(0), mean(1));
        let product: f64 = points.iter().map(|p| (p[0] - x) * (p[1] - y)).sum();
        let square: f64 = points.iter().map(|p| (p[0] - x).powi(2)).sum();
        let expected = 2.0 * (degree - 1) as f64;
        let off = -product / square / expected - 1.0;
        assert!(off.abs() < 0.08, "degree {degree}: {off:+.3}");
    }
}

/// Beyond `ω² = κGA/ρI` there are two waves, and modes of both: their number below ω follows from both phases, to one
/// or two.
#[test]
fn the_second_waves_begin_beyond_the_cut_off() {
    let truth = Truth::of_cases(&["timo_dowel_60"]).unwrap();
    let (bat, modes) = (&truth.bat, solved(&truth.bat, Theory::Timoshenko, 60, 1e-6).modes);
    let worth = bat.worth_at(0.4);
    let cut_off = (worth.shear / worth.turning).sqrt();
    let below = modes.iter().filter(|mode| mode.omega < cut_off).count();
    assert!(below > 10 && below < 50, "{below}");
    let omega = modes[59].omega;
    let [m, j] =
        [worth.mass / worth.shear, worth.turning / worth.bending].map(|r| r * omega.powi(2));
    let root = (0.25 * (m - j).powi(2) + omega.powi(2) * worth.mass / worth.bending).sqrt();
    let waves = [0.5 * (m + j) + root, 0.5 * (m + j) - root].map(f64::sqrt);
    let phases = waves.iter().sum::<f64>() * bat.length() / PI;
    assert!((phases - 60.0).abs() < 2.0, "{phases}");
}

/// A uniform shaft on two pins has the sine for its shape with any theory: `ω⁴ ρI/κGA − ω² (ρA/k² + ρI + ρA EI/κGA…)`
/// in closed form, the slower root of which is the bending mode.
#[test]
fn a_bar_with_a_typical_shear_modulus_agrees_with_the_sine_solution() {
    let stations = Stations {
        x: vec![0.0, LENGTH],
        outer: vec![0.02; 2],
        inner: vec![0.01; 2],
        interpolation: Interpolation::Linear,
    };
    let mut material = Material::new(700.0, 14e9).unwrap();
    material.shear_modulus = Some(1e9);
    material.shear_coefficient = Some(0.7);
    let profile = Profile::new(stations).unwrap();
    let bat = Bat::builder(profile, material).name("shaft");
    let pin =
        |x| sweetspot::bat::fixtures::Support { x, kind: sweetspot::bat::fixtures::Held::Pinned };
    let supports = vec![pin(0.0), pin(LENGTH)];
    let fixtures = sweetspot::bat::fixtures::Fixtures { supports, ..Default::default() };
    let bat = bat.fixtures(fixtures).build().unwrap();
    let worth = bat.worth_at(0.1);
    for (k, mode) in solved(&bat, Theory::Timoshenko, 6, 1e-12).modes.iter().enumerate() {
        let wave = ((k + 1) as f64 * PI / LENGTH).powi(2);
        // a ω⁴ − b ω² + c = 0.
        let a = worth.mass * worth.turning / worth.shear;
        let b = worth.mass + wave * (worth.turning + worth.mass * worth.bending / worth.shear);
        let c = worth.bending * wave * wave;
        let square = 2.0 * c / (b + (b * b - 4.0 * a * c).sqrt());
        let exact = square.sqrt() / TAU;
        assert!((mode.frequency() / exact - 1.0).abs() < 3e-12, "{k}");
    }
}

/// κGA of a tapered tube is no polynomial (Cowper's κ depends on the ratio of the radii), so that points miss a part of
/// it, less with shorter elements; EI and ρA are polynomials, and so is everything for a straight tube.
#[test]
fn points_miss_the_shear_of_a_tapered_tube_and_nothing_else() {
    let missed = |inner: [f64; 2], elements, theory| {
        let text = format!(
            r#"{{ "format": "sweetspot-bat/1", "material": "white-ash", "profile": {{
                "interpolation": "linear", "x": [0, 0.8], "radius": [0.02, 0.03],
                "inner_radius": [{}, {}] }} }}"#,
            inner[0], inner[1]
        );
        let bat = Bat::from_text("tube.json", &text, "".as_ref()).unwrap();
        let mesh = sweetspot::beam::mesh::Mesh::along(&bat, elements);
        let rule = sweetspot::beam::rule::Rule::of(&bat, false, 3);
        let of = |e| sweetspot::beam::sections::missed(&bat, e, rule, theory);
        mesh.elements.iter().map(of).fold(0.0, f64::max)
    };
    let tapered = [0.019, 0.01];
    let coarse = missed(tapered, 1, Theory::Timoshenko);
    let fine = missed(tapered, 8, Theory::Timoshenko);
    assert!(coarse > 1e-9 && coarse < 1.0 && fine < 0.01 * coarse, "{coarse:e} {fine:e}");
    assert_eq!(missed(tapered, 1, Theory::EulerBernoulli), 0.0);
    assert_eq!(missed([0.01, 0.015], 1, Theory::Timoshenko), 0.0);
}
