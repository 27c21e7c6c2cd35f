//! Machines have vectors of different widths; an answer has the same bits on all of them.

mod common;

use sweetspot::base::lanes;
use sweetspot::bat::profile::Interpolation;
use sweetspot::bat::theory::Theory;
use sweetspot::collision::hit::{Effort, Model, Scene};
use sweetspot::collision::hitter::Hitter;
use sweetspot::modes::batch::{self, Way};
use sweetspot::{Bat, Request, solve};

/// Every bit of modes and hits of several bats, one by one and side by side.
fn bits() -> Vec<u64> {
    let held = include_str!("../meshes/r161.json").replacen(
        "\"format\"",
        "\"grip\": { \"from\": 0, \"to\": 0.2, \"stiffness\": 1e5, \"damping\": 100 }, \"format\"",
        1,
    );
    let read = |text: &str| Bat::from_text("bat", text, std::path::Path::new("")).unwrap();
    let r161 = read(include_str!("../meshes/r161.json"));
    let bats = [r161.clone(), read(&held), read(include_str!("../meshes/tanh.json"))];
    let mut bits = vec![];
    let scene = Scene { pivot: 0.0635, swing: 50.0, ball_speed: 40.0, ..Scene::default() };
    for (bat, theory) in
        bats.iter().zip([Theory::EulerBernoulli, Theory::Rayleigh, Theory::Rayleigh])
    {
        let request = Request { modes: 8, tolerance: 1e-8, theory, ..Request::default() };
        let solution = solve(bat, &request).unwrap();
        for mode in &solution.modes {
            bits.extend([mode.frequency(), mode.modal_mass, mode.error.residual].map(f64::to_bits));
            bits.extend(mode.nodes.iter().map(|x| x.to_bits()));
        }
        let hitter =
            Hitter::new(Model::Contact, &scene, bat, &solution, Effort::default()).unwrap();
        for share in [0.55, 0.8, 0.97] {
            let outcome = hitter.strike(share * bat.length()).outcome.unwrap();
            bits.extend([outcome.exit_speed, outcome.impulse, outcome.error].map(f64::to_bits));
        }
    }
    let cones: Vec<Bat> = (0..40)
        .map(|k| {
            let tip = 0.03 + 1e-4 * f64::from(k);
            common::bat(&[0.0, 0.4, 0.84], &[0.012, 0.015, tip], &[0.0; 3], Interpolation::Pchip)
        })
        .collect();
    let request = Request { modes: 5, ..Request::plain() };
    for found in batch::all(&cones, &request, Way::SideBySide, |_, found| {
        found.unwrap().omegas.iter().map(|omega| omega.to_bits()).collect::<Vec<_>>()
    }) {
        bits.extend(found);
    }
    bits
}

#[test]
fn narrow_vectors_give_the_bits_of_wide_ones() {
    let wide = bits();
    lanes::leave_wide_vectors_unused();
    let plain = bits();
    assert!(wide.len() > 300, "{}", wide.len());
    assert_eq!(wide, plain);
}
