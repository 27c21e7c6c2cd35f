//! Near twins: modes of almost the same frequency that a mesh represents unequally well.
//!
//! The truth is a solve to 1e-12, which needs another mesh; `search/bats.py` has a reference without common code.

use crate::common;

use common::bat;
use sweetspot::base::error::Error;
use sweetspot::bat::fixtures::{Absorber, Attachment, Fixtures, Joint};
use sweetspot::bat::material::Material;
use sweetspot::bat::profile::{Interpolation, Stations};
use sweetspot::{Bat, Profile, Request, Solution, Solver, Theory, solve};

/// Two whips on a middle of that radius, the first with additional stations, which change nothing.
fn whips(middle: f64, stations: usize, unlike: f64) -> Bat {
    let (long, short, thin) = (0.4, 0.1, 0.005);
    let first = (0..=stations + 1).map(|k| long * k as f64 / (stations + 1) as f64);
    let rest = [long, long + short, long + short, 2.0 * long + short];
    let x: Vec<f64> = first.chain(rest).collect();
    let other = thin * (1.0 + unlike);
    let outer = [vec![thin; stations + 2], vec![middle, middle, other, other]].concat();
    bat(&x, &outer, &vec![0.0; x.len()], Interpolation::Linear)
}

fn solved(bat: &Bat, modes: usize, tolerance: f64) -> Solution {
    solve(bat, &Request { modes, tolerance, ..Request::plain() }).unwrap()
}

/// Whether every frequency, modal mass and node is within three times its stated error.
fn holds(bat: &Bat, modes: usize, tolerance: f64) {
    let (found, truth) = (solved(bat, modes, tolerance), solved(bat, modes, 1e-12));
    let told = format!("{:?} for {tolerance:.0e}", bat.profile().stations.outer);
    for (mode, exact) in found.modes.iter().zip(&truth.modes) {
        let off = (mode.omega / exact.omega - 1.0).abs();
        let known = 3.0 * exact.error.total();
        assert!(off <= 3.0 * mode.error.total() + known, "{}: {off:.1e} {told}", mode.order);
        assert!(!found.met() || off <= tolerance, "{}: met, {off:.1e} {told}", mode.order);
        let off = (mode.modal_mass / exact.modal_mass - 1.0).abs();
        let known = 3.0 * exact.error.modal_mass;
        assert!(
            off <= 3.0 * mode.error.modal_mass + known,
            "{}: mass {off:.1e} {told}",
            mode.order
        );
        // Each listed node is a true one, and each true one is listed or where nodes cannot be located.
        let near = 3.0 * (mode.error.nodes + exact.error.nodes);
        let off =
            |x: f64, of: &[f64]| of.iter().map(|y| (x - y).abs()).fold(f64::INFINITY, f64::min);
        for node in &mode.nodes {
            assert!(off(*node, &exact.nodes) <= near, "{}: node {node} {told}", mode.order);
        }
        assert!(mode.nodes.len() <= exact.nodes.len(), "{}: a node too many {told}", mode.order);
        let untold = |x: f64| mode.untold.iter().any(|[a, b]| *a - near <= x && x <= *b + near);
        for x in exact.nodes.iter().filter(|x| !untold(**x)) {
            assert!(off(*x, &mode.nodes) <= near, "{}: no node {x} {told}", mode.order);
        }
    }
}

#[test]
fn near_twins_on_unequal_meshes_are_as_far_off_as_they_say() {
    for (middle, stations, unlike, tolerance) in [
        (1.3, 60, 0.0, 1.4e-3),
        (1.6, 60, 0.0, 4.3e-2),
        (2.2, 30, -7.6e-3, 5.4e-2),
        (2.5, 60, -5.7e-5, 2.8e-2),
        (3.7, 60, -1.5e-7, 3.2e-2),
        (9.0, 60, 0.0, 2.3e-3),
        (0.3, 10, 0.0, 1e-2),
    ] {
        for modes in 1..=8 {
            holds(&whips(middle, stations, unlike), modes, tolerance);
        }
    }
}

#[test]
fn a_near_twin_just_beyond_the_list_is_part_of_the_errors() {
    for stations in [1, 3, 30] {
        for modes in [1, 3, 5, 7] {
            holds(&whips(9.5, stations, 0.0), modes, 1e-3);
            holds(&whips(9.5, stations, 0.0), modes, 1e-5);
        }
    }
}

#[test]
fn the_nodes_and_mass_of_a_mode_beside_a_tuned_absorber_are_as_far_off_as_they_say() {
    let bare = bat(&[0.0, 0.5, 0.84], &[0.01, 0.015, 0.03], &[0.0; 3], Interpolation::Linear);
    let tuned = solved(&bare, 1, 1e-12).modes[0].omega;
    for mass in [1e-9, 1e-7, 1e-5, 1e-3] {
        let absorber = Absorber { x: 0.6, mass, stiffness: mass * tuned * tuned, damping: 0.0 };
        let fixtures = Fixtures { absorbers: vec![absorber], ..Fixtures::default() };
        let (profile, material) = (bare.profile().clone(), bare.material().clone());
        let bat = Bat::builder(profile, material).name("tuned").fixtures(fixtures).build();
        let bat = bat.unwrap();
        for tolerance in [1e-2, 1e-4, 1e-6] {
            holds(&bat, 3, tolerance);
        }
    }
}

/// The theorem of oscillation does not cover rotary inertia, with which a mode may have other nodes.
#[test]
fn a_rayleigh_bat_is_not_refused_for_the_number_of_its_nodes() {
    let bat = whips(0.3, 3, 0.0);
    let asked = Request { modes: 7, theory: Theory::Rayleigh, ..Request::default() };
    let found = solve(&bat, &asked).unwrap();
    assert!(found.met(), "{:?}", found.ending);
    assert!(found.modes.iter().any(|mode| !mode.has_its_nodes()));
}

#[test]
fn a_dense_solve_that_round_off_defeats_is_refused_with_the_reason() {
    let x = [0.0, 0.4, 0.400_001, 0.84];
    let bat = bat(&x, &[0.02, 0.02, 0.021, 0.02], &[0.0; 4], Interpolation::Linear);
    for solver in [Solver::Dense, Solver::ShiftInvert] {
        let asked = Request { modes: 1, tolerance: 1e-10, solver, ..Request::plain() };
        assert!(matches!(solve(&bat, &asked), Err(Error::Factorization { .. })), "{solver:?}");
    }
}

/// A heavy absorber whose mode hardly bends the bat, where a share of 1e-6 of the next mode moves a node by 80 µm,
/// although the next mode is not close.
#[test]
fn nodes_of_a_bat_that_hardly_moves_are_as_far_off_as_they_say() {
    let x = [0.0, 0.2, 0.5, 0.84];
    let outer = [0.011_167_395, 0.010_416_992, 0.026_027_376, 0.028_187_727];
    let profile = Profile::new(Stations {
        x: x.to_vec(),
        outer: outer.to_vec(),
        inner: vec![0.0; 4],
        interpolation: Interpolation::Pchip,
    });
    let fixtures = Fixtures {
        joints: vec![Joint { x: 0.839, rotational_stiffness: 0.010_046_478_8 }],
        absorbers: vec![Absorber {
            x: 0.208_019_8,
            mass: 0.905_867_9,
            stiffness: 12_403.414,
            damping: 0.0,
        }],
        attachments: vec![Attachment { mass: 0.275_679_8, ..Attachment::default() }],
        ..Fixtures::default()
    };
    let material = Material::new(650.0, 15e9).unwrap();
    let bat = Bat::builder(profile.unwrap(), material).name("soft").fixtures(fixtures).build();
    let (bat, modes, theory) = (bat.unwrap(), 4, Theory::Rayleigh);
    let exact = solve(&bat, &Request { modes, theory, tolerance: 1e-12, ..Request::default() });
    let exact = exact.unwrap();
    for (elements, degree) in [(12, 4), (12, 3), (7, 5), (20, 3)] {
        let (elements, degree) = (Some(elements), Some(degree));
        let asked = Request { modes, theory, elements, degree, ..Request::default() };
        let found = solve(&bat, &asked).unwrap();
        for (mode, exact) in found.modes.iter().zip(&exact.modes) {
            let off = mode.nodes.iter().zip(&exact.nodes).map(|(a, b)| (a - b).abs());
            let off = off.fold(0.0, f64::max);
            assert_eq!(mode.nodes.len(), exact.nodes.len());
            assert!(off <= 3.0 * mode.error.nodes, "{degree:?} {}: {off:e}", mode.order);
        }
    }
}
