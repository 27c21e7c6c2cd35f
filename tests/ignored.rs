//! What the program says shear and rotary inertia would do, against Timoshenko's beam.

mod common;

use sweetspot::ignored::shift;
use sweetspot::material::Material;
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
