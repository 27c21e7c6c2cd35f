//! Many bats at once are the same bats.

mod common;

use common::{cone, dowel};
use sweetspot::batch::{Way, all, each};
use sweetspot::validation::bundled_bat;
use sweetspot::{Bat, Request, solve};

/// Frequencies, stated errors, modal masses and shapes of every bat, in their order.
fn found(bats: &[Bat], request: &Request, way: Way) -> Vec<[Vec<f64>; 4]> {
    let mut all = Vec::new();
    each(bats, request, way, |place, found| {
        assert_eq!(place, all.len());
        let found = found.unwrap();
        let parts = [found.omegas, found.errors, found.modal_masses, found.shapes];
        all.push(parts.map(<[f64]>::to_vec));
    });
    all
}

fn cones(count: usize) -> Vec<Bat> {
    let cone = |k: usize| cone(0.010 + 1e-4 * (k % 50) as f64, 0.033 - 1e-5 * k as f64);
    (0..count).map(cone).collect()
}

#[test]
fn side_by_side_and_one_by_one_agree() {
    let bats = cones(21);
    for request in [
        Request { modes: 6, ..Request::default() },
        Request { modes: 8, tolerance: 1e-9, ..Request::default() },
        Request { modes: 6, elements: Some(40), ..Request::default() },
    ] {
        let alone = found(&bats, &request, Way::OneByOne);
        let together = found(&bats, &request, Way::SideBySide);
        assert_eq!((alone.len(), together.len()), (bats.len(), bats.len()));
        for (one, other) in alone.iter().zip(&together) {
            for (a, b) in one[0].iter().zip(&other[0]) {
                assert!((a / b - 1.0).abs() < 1e-12, "{a} {b}");
            }
            for (a, b) in one[3].iter().zip(&other[3]) {
                assert!((a - b).abs() < 1e-9, "{a} {b}");
            }
        }
    }
}

/// Each bat as the single solve finds it, within what both state.
#[test]
fn each_bat_is_the_bat_that_is_solved_alone() {
    let mut bats = cones(9);
    // Bats of another make among them: they are solved on their own.
    bats.insert(3, bundled_bat("meshes/r161.json").unwrap());
    bats.push(cone(0.000_05, 0.033));
    bats.push(dowel());
    let request = Request { modes: 5, tolerance: 1e-6, ..Request::default() };
    for way in [Way::OneByOne, Way::SideBySide] {
        for (bat, [omegas, errors, masses, _]) in bats.iter().zip(found(&bats, &request, way)) {
            let solution = solve(bat, &Request { tolerance: 1e-11, ..request }).unwrap();
            for (k, mode) in solution.modes.iter().enumerate() {
                let error = (omegas[k] / mode.omega - 1.0).abs();
                assert!(
                    error <= 3.0 * (errors[k] + mode.error.total()),
                    "{error:e} {:e}",
                    errors[k]
                );
                assert!(errors[k] <= request.tolerance);
                // A frequency's error is the square of its shape's.
                let mass = (masses[k] / mode.modal_mass - 1.0).abs();
                assert!(mass <= 3.0 * request.tolerance.sqrt(), "mode {}: {mass:e}", k + 1);
            }
        }
    }
}

#[test]
fn results_do_not_depend_on_neighbours_or_cores() {
    let bats = cones(600);
    let request = Request { modes: 4, ..Request::default() };
    let on_cores = all(&bats, &request, Way::SideBySide, |_, found| found.unwrap().omegas.to_vec());
    let again = all(&bats, &request, Way::SideBySide, |_, found| found.unwrap().omegas.to_vec());
    assert_eq!(on_cores, again);
    let shares: Vec<_> =
        bats.chunks(256).flat_map(|bats| found(bats, &request, Way::SideBySide)).collect();
    for (a, [b, ..]) in on_cores.iter().zip(&shares) {
        assert_eq!(a, b);
    }
}

#[test]
fn nothing_and_too_little_are_told() {
    each(&[], &Request::default(), Way::SideBySide, |_, _| panic!("there is no bat"));
    let request = Request { modes: 9, elements: Some(2), ..Request::default() };
    let mut errors = 0;
    each(&cones(3), &request, Way::SideBySide, |_, found| errors += usize::from(found.is_err()));
    assert_eq!(errors, 3);
}
