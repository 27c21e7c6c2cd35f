//! Shared by several tests: bats, and a folder for running the program.
#![allow(dead_code)] // Each test file uses some of them.

pub mod diagnostic;
pub mod commands;
pub mod documents;
pub mod folder;

use std::f64::consts::{PI, TAU};

use sweetspot::Bat;
use sweetspot::bat::material::Material;
use sweetspot::bat::profile::{Interpolation, Profile, Stations};
use sweetspot::bat::weighed::Weighed;

pub const LENGTH: f64 = 0.8382;
pub const RADIUS: f64 = 0.0213;
pub const DENSITY: f64 = 711.0;
pub const MODULUS: f64 = 13.9e9;

/// A bat of that material through stations.
pub fn bat(x: &[f64], outer: &[f64], inner: &[f64], interpolation: Interpolation) -> Bat {
    let (x, outer, inner) = (x.to_vec(), outer.to_vec(), inner.to_vec());
    let profile = Profile::new(Stations { x, outer, inner, interpolation }).unwrap();
    Bat::builder(profile, Material::new(DENSITY, MODULUS).unwrap()).name("test").build().unwrap()
}

pub fn dowel() -> Bat {
    bat(&[0.0, LENGTH], &[RADIUS; 2], &[0.0; 2], Interpolation::Linear)
}

pub fn cone(from: f64, to: f64) -> Bat {
    bat(&[0.0, LENGTH], &[from, to], &[0.0; 2], Interpolation::Linear)
}

/// That bat with factors on the density and on the moduli of its material.
pub fn of_factors(bat: &Bat, [density, moduli]: [f64; 2]) -> Bat {
    let mut material = bat.material().clone();
    material.density *= density;
    material.youngs_modulus *= moduli;
    material.shear_modulus.iter_mut().for_each(|shear| *shear *= moduli);
    let built = Bat::builder(bat.profile().clone(), material).fixtures(bat.fixtures().clone());
    built.weighed(Weighed::default()).build().unwrap()
}

/// The n-th root of `cos β cosh β = 1`, digits of Abramowitz-and-Stegun-like tables for the
/// first five, the asymptote `(n + ½)π` (to 1e-14) beyond.
pub fn beta(n: usize) -> f64 {
    let first = [
        4.730_040_744_862_704,
        7.853_204_624_095_838,
        10.995_607_838_001_671,
        14.137_165_491_257_464,
        17.278_759_657_399_48,
    ];
    // cos β = 2 e^(−β) shifts the sixth root by 3e-9, which the next term of the series removes.
    let asymptote = (n as f64 + 0.5) * PI;
    let correction = 2.0 * (-asymptote).exp() * if n.is_multiple_of(2) { -1.0 } else { 1.0 };
    first.get(n - 1).copied().unwrap_or(asymptote + correction)
}

/// Exact frequency (Hz) of mode n of the free dowel.
pub fn dowel_frequency(n: usize) -> f64 {
    let stiffness_over_mass = MODULUS * RADIUS * RADIUS / (4.0 * DENSITY);
    (beta(n) / LENGTH).powi(2) * stiffness_over_mass.sqrt() / TAU
}
