//! What the program says shear and rotary inertia would do, against Timoshenko's beam.

mod common;

use sweetspot::choice;
use sweetspot::ignored::shift;
use sweetspot::material::Material;
use sweetspot::theory::Theory;
use sweetspot::{Bat, Request, solve};

/// Exact ratios of Timoshenko's to Euler–Bernoulli's frequency of the WPI report's dowel with
/// κ = 0.9, from Huang's frequency equation: 0.993 for G = E/2.6 and 0.979 for G = E/16 (mode 1).
#[test]
fn the_first_order_shift_of_a_slender_mode_is_the_exact_one() {
    for (ratio, exact) in [(2.6, 0.993), (16.0, 0.979)] {
        let dowel = sweetspot::validation::bundled_bat("meshes/dowel.json").unwrap();
        let material = Material {
            shear_modulus: Some(dowel.material().youngs_modulus / ratio),
            shear_coefficient: Some(0.9),
            ..dowel.material().clone()
        };
        let bat = Bat::new("dowel", dowel.profile, material, None).unwrap();
        let solution = solve(&bat, &Request { tolerance: 1e-6, ..Request::default() }).unwrap();
        let shift = shift(&bat, &solution.modes[0]);
        let total = 1.0 + shift.rotary_inertia + shift.shear.unwrap();
        // The exact ratios are given to three digits; the second order is below 1e-3 here.
        assert!((total - exact).abs() < 1.5e-3, "{ratio}: {total} {exact}");
        assert!(shift.rotary_inertia < 0.0 && shift.shear.unwrap() < 0.0);
    }
}

/// Whatever the tolerance, the theory that is chosen misses what Timoshenko's beam says by no more,
/// and none that is cheaper does as well.
#[test]
fn the_chosen_theory_is_as_accurate_as_asked() {
    for file in ["meshes/r161.json", "meshes/torpedo.json", "meshes/house.json"] {
        let bat = sweetspot::validation::bundled_bat(file).unwrap();
        for modes in [1, 3] {
            let solved = |theory| {
                let request = Request { modes, tolerance: 1e-9, theory, ..Request::default() };
                solve(&bat, &request).unwrap().modes
            };
            let ladder = [Theory::EulerBernoulli, Theory::Rayleigh, Theory::Timoshenko];
            let all = ladder.map(solved);
            let missed = |k: usize| {
                let pairs = all[k].iter().zip(&all[2]);
                pairs.map(|(a, b)| (a.omega / b.omega - 1.0).abs()).fold(0.0, f64::max)
            };
            for tolerance in [0.3, 0.15, 0.1, 0.05, 0.02, 0.0137, 0.013, 0.01, 0.006, 1e-3] {
                let request = Request { modes, tolerance, ..Request::default() };
                let chosen = choice::theory(&bat, &request).unwrap().theory;
                let k = ladder.iter().position(|theory| *theory == chosen).unwrap();
                let told = format!("{file} {modes} {tolerance}: {chosen:?}");
                assert!(missed(k) <= tolerance, "{told} {}", missed(k));
                // Nor would a cheaper one do; shifts are solved to a tenth of the tolerance.
                assert!(k == 0 || missed(k - 1) > 0.8 * tolerance, "{told} {}", missed(k - 1));
            }
        }
    }
}
