//! The stated effect of shear and rotary inertia, compared with Timoshenko's beam.

use crate::common;

use sweetspot::bat::material::Material;
use sweetspot::bat::theory::Theory;
use sweetspot::modes::theory_choice;
use sweetspot::{Bat, Request, solve};
use sweetspot_study::ignored::shift;

/// The integrals in both shifts of a free uniform dowel in closed form, with the shape
/// `φ = cosh βξ + cos βξ − σ (sinh βξ + sin βξ)`, ξ = x/L:
///
/// ```text
/// ∫φ′² dξ/∫φ² dξ = σβ (σβ + 6),   ∫φ‴² dξ/∫φ″² dξ = σβ (σβ − 2),   σ = (cosh β − cos β)/(sinh β − sin β)
/// ```
#[test]
fn the_first_order_shifts_of_a_dowel_are_their_closed_forms() {
    let dowel = sweetspot_proof::bundled::bundled_bat("meshes/dowel.json").unwrap();
    let (length, radius) = (dowel.length(), dowel.profile().at(0.0).outer);
    // I/A over L².
    let slenderness = (radius / (2.0 * length)).powi(2);
    for ratio in [2.6, 16.0] {
        let material = Material {
            shear_modulus: Some(dowel.material().youngs_modulus / ratio),
            shear_coefficient: Some(0.9),
            ..dowel.material().clone()
        };
        let bat = Bat::builder(dowel.profile().clone(), material).name("dowel").build().unwrap();
        let solution = solve(&bat, &Request { tolerance: 1e-9, ..Request::plain() }).unwrap();
        for mode in &solution.modes[..5] {
            let beta = common::beta(mode.order);
            let sigma = (beta.cosh() - beta.cos()) / (beta.sinh() - beta.sin());
            let of = |share: f64| (1.0 + share).powf(-0.5) - 1.0;
            let rotary = of(slenderness * sigma * beta * (sigma * beta + 6.0));
            let shear = of(slenderness * ratio / 0.9 * sigma * beta * (sigma * beta - 2.0));
            let found = shift(&bat, mode);
            // The error of the shear force, summed over 400 stretches, is a third of this.
            let within = (beta / 400.0).powi(2);
            assert!((found.rotary_inertia / rotary - 1.0).abs() < within, "{ratio} {found:?}");
            assert!((found.shear.unwrap() / shear - 1.0).abs() < within, "{ratio} {found:?}");
        }
    }
}

/// For any tolerance, the error of the chosen theory against Timoshenko's beam is within it, and no cheaper theory
/// would do.
#[test]
fn the_chosen_theory_is_as_accurate_as_asked() {
    for file in ["meshes/r161.json", "meshes/torpedo.json", "meshes/house.json"] {
        let bat = sweetspot_proof::bundled::bundled_bat(file).unwrap();
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
                let request = Request { modes, tolerance, ..Request::plain() };
                let chosen = theory_choice::theory(&bat, &request).unwrap().theory;
                let k = ladder.iter().position(|theory| *theory == chosen).unwrap();
                let told = format!("{file} {modes} {tolerance}: {chosen:?}");
                assert!(missed(k) <= tolerance, "{told} {}", missed(k));
                // A cheaper theory would not do either; shifts are solved to a tenth of the tolerance.
                assert!(k == 0 || missed(k - 1) > 0.8 * tolerance, "{told} {}", missed(k - 1));
            }
        }
    }
}
