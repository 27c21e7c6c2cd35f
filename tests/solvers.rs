//! The solvers that factor K + σM, compared with closed forms, with the dense solver and with each other.

use crate::common;

use common::{DENSITY, LENGTH, MODULUS, RADIUS, beta, dowel};
use nalgebra_sparse::{CooMatrix, CscMatrix};
use sweetspot::base::linear::dot;
use sweetspot::bat::theory::Theory;
use sweetspot::beam::{assembly::Pencil, mesh::Mesh};
use sweetspot::eigen::shift_invert::{Pairs, multiply};
use sweetspot::eigen::{dense, shift_invert};
use sweetspot::modes::solve::own_and_recomputed;
use sweetspot::{Bat, Error, Request, Result, Solver, solve};
use sweetspot_proof::bundled::bundled_bat;

type Solve = fn(&CscMatrix<f64>, &CscMatrix<f64>, f64, usize, f64) -> Result<Pairs>;

const SOLVERS: &[(&str, Solve)] = &[
    ("shift-invert", shift_invert::lowest),
    #[cfg(feature = "arpack")]
    ("arpack", sweetspot::eigen::arpack::lowest),
];

const RESIDUAL: f64 = 1e-12;

/// `EI/(ρA L⁴)` of the dowel (1/s²): its eigenvalues are Ω² times that.
fn unit() -> f64 {
    MODULUS * RADIUS * RADIUS / (4.0 * DENSITY) / LENGTH.powi(4)
}

/// A shift of the size of the lowest elastic eigenvalue, for any bat here.
fn shift() -> f64 {
    500.0 * unit()
}

fn pencil(bat: &Bat, elements: usize) -> Pencil {
    Pencil::of(bat, &Mesh::along(bat, elements), 3, Theory::EulerBernoulli)
}

fn solved(solve: Solve, pencil: &Pencil, count: usize) -> Pairs {
    solve(&pencil.stiffness, &pencil.mass, shift(), count, RESIDUAL).unwrap()
}

fn form(matrix: &CscMatrix<f64>, x: &[f64], y: &[f64]) -> f64 {
    let mut product = vec![0.0; x.len()];
    multiply(matrix, y, &mut product);
    dot(x, &product)
}

#[test]
fn one_element_has_720_and_8400_and_two_rigid_motions() {
    for (name, solve) in SOLVERS {
        let pairs = solved(*solve, &pencil(&dowel(), 1), 4);
        let exact = [0.0, 0.0, 720.0, 8400.0];
        for (value, exact) in pairs.values.iter().zip(exact) {
            assert!(
                (value / unit() - exact).abs() < 1e-12 * exact.max(720.0),
                "{name}: {value} {exact}"
            );
        }
    }
}

/// The error of K grows like ε n⁴; the tolerance leaves it a factor of about ten.
#[test]
fn discrete_frequencies_are_those_of_multiprecision() {
    for elements in [1_usize, 2, 4, 8, 16, 32, 64] {
        let path = format!("{}/validation/hermite_{elements:02}.json", env!("SWEETSPOT_TOP"));
        let text = std::fs::read_to_string(path).unwrap();
        let case: serde_json::Value = serde_json::from_str(&text).unwrap();
        let checks = case["checks"].as_array().unwrap();
        let bat = bundled_bat(case["bat"].as_str().unwrap()).unwrap();
        for (name, solve) in SOLVERS {
            let pairs = solved(*solve, &pencil(&bat, elements), checks.len() + 2);
            for (value, check) in pairs.values[2..].iter().zip(checks) {
                let expected = check["expected"].as_f64().unwrap();
                let error = value.sqrt() / std::f64::consts::TAU / expected - 1.0;
                let tolerance = 1e-13 * (elements as f64 / 10.0).powi(4).max(1.0);
                assert!(error.abs() < tolerance, "{name} {elements}: {error:e}");
            }
        }
    }
}

/// Ritz values of cubic elements lie above the continuum's by `(βh)⁴/720`.
#[test]
fn round_off_is_no_larger_than_stated() {
    for elements in [200, 500, 1000, 3000, 9000] {
        let pencil = pencil(&dowel(), elements);
        for (name, solve) in SOLVERS {
            let pairs = solved(*solve, &pencil, 5);
            for mode in 1..4 {
                let (value, stated) = (pairs.values[mode + 1], pairs.round_off[mode + 1]);
                let raised = 1.0 + (beta(mode) / elements as f64).powi(4) / 720.0;
                let error = (value - beta(mode).powi(4) * raised * unit()).abs();
                assert!(error < stated + 1e-9 * value, "{name} {elements}: {error:e} {stated:e}");
            }
        }
    }
}

#[test]
fn rigid_motions_have_no_frequency() {
    for (name, solve) in SOLVERS {
        let pairs = solved(*solve, &pencil(&dowel(), 40), 6);
        for rigid in 0..2 {
            assert!(pairs.values[rigid].abs() < 1e-10 * pairs.values[2], "{name}");
            let shape = &pairs.vectors[rigid];
            // A straight line: every slope is the first one.
            let slopes = shape.iter().skip(1).step_by(2);
            let bend = slopes.map(|slope| (slope - shape[1]).abs()).fold(0.0, f64::max);
            assert!(bend * LENGTH < 1e-8, "{name}: {bend:e}");
        }
    }
}

#[test]
fn vectors_are_orthonormal_in_mass_and_orthogonal_in_stiffness() {
    let pencil = pencil(&bundled_bat("meshes/r161.json").unwrap(), 60);
    for (name, solve) in SOLVERS {
        let pairs = solved(*solve, &pencil, 12);
        for (i, a) in pairs.vectors.iter().enumerate() {
            for (j, b) in pairs.vectors.iter().enumerate().take(i + 1) {
                let same = f64::from(u8::from(i == j));
                let mass = form(&pencil.mass, a, b) - same;
                assert!(mass.abs() < 1e-12, "{name} {i} {j}: {mass:e}");
                let energy = form(&pencil.stiffness, a, b) - same * pairs.values[i];
                assert!(energy.abs() < 1e-8 * pairs.values[i.max(2)], "{name} {i} {j}: {energy:e}");
            }
        }
    }
}

#[test]
fn every_bat_rings_as_the_dense_solver_says() {
    for bat in ["r161", "torpedo", "cone", "house", "northwestern_wood", "northwestern_aluminium"] {
        let pencil = pencil(&bundled_bat(&format!("meshes/{bat}.json")).unwrap(), 30);
        let (expected, _) = dense::lowest(&pencil.stiffness, &pencil.mass, shift(), 12).unwrap();
        for (name, solve) in SOLVERS {
            let pairs = solved(*solve, &pencil, 12);
            for (value, expected) in pairs.values.iter().zip(&expected).skip(2) {
                assert!((value / expected - 1.0).abs() < 1e-8, "{name} {bat}: {value} {expected}");
            }
        }
    }
}

#[test]
fn the_shift_does_not_matter() {
    let pencil = pencil(&dowel(), 16);
    for (name, solve) in SOLVERS {
        let usual = solved(*solve, &pencil, 8);
        for factor in [0.03, 0.3, 7.0, 100.0] {
            let (k, m) = (&pencil.stiffness, &pencil.mass);
            let other = solve(k, m, factor * shift(), 8, RESIDUAL).unwrap();
            for (a, b) in usual.values.iter().zip(&other.values) {
                assert!((a - b).abs() < 1e-11 * (a + shift()), "{name} {factor}: {a} {b}");
            }
        }
    }
}

#[test]
fn the_same_question_gets_the_same_bits() {
    for (name, solve) in SOLVERS {
        for elements in [1, 2, 40] {
            let pencil = pencil(&dowel(), elements);
            let count = (2 * elements + 2).min(8);
            let first = solved(*solve, &pencil, count);
            for _ in 0..3 {
                assert_eq!(solved(*solve, &pencil, count), first, "{name} {elements}");
            }
        }
    }
}

#[test]
fn any_number_of_pairs_of_a_small_pencil_begins_the_whole_list() {
    for elements in 1..5 {
        let pencil = pencil(&dowel(), elements);
        let size = 2 * elements + 2;
        let (all, _) = dense::lowest(&pencil.stiffness, &pencil.mass, shift(), size).unwrap();
        for (name, solve) in SOLVERS {
            for count in 0..=size {
                let pairs = solved(*solve, &pencil, count);
                assert_eq!(pairs.values.len(), count);
                for (value, expected) in pairs.values.iter().zip(&all) {
                    let error = (value - expected).abs() / (expected + shift());
                    assert!(error < 1e-9, "{name} {elements} {count}: {value} {expected}");
                }
            }
            let (k, m) = (&pencil.stiffness, &pencil.mass);
            let more = solve(k, m, shift(), size + 1, RESIDUAL);
            assert!(matches!(more, Err(Error::NotConverged { .. })), "{name}: {more:?}");
        }
    }
}

#[test]
fn both_copies_of_a_double_eigenvalue_are_found() {
    let (mut k, mut m) = (CooMatrix::new(60, 60), CooMatrix::new(60, 60));
    for i in 0..60 {
        let pair = (i / 2) as f64;
        k.push(i, i, 3.0 * pair.powi(4));
        m.push(i, i, 3.0);
    }
    let (k, m) = (CscMatrix::from(&k), CscMatrix::from(&m));
    for (name, solve) in SOLVERS {
        for count in 1..12 {
            let pairs = solve(&k, &m, 1.0, count, RESIDUAL).unwrap();
            for (i, value) in pairs.values.iter().enumerate() {
                let exact = ((i / 2) as f64).powi(4);
                assert!((value - exact).abs() < 1e-11 * (exact + 1.0), "{name} {count}: {value}");
            }
        }
    }
}

#[test]
fn too_many_elements_are_an_error_not_a_wrong_number() {
    for elements in [12_000, 16_000, 20_000, 50_000] {
        let pencil = pencil(&dowel(), elements);
        for (name, solve) in SOLVERS {
            match solve(&pencil.stiffness, &pencil.mass, shift(), 4, RESIDUAL) {
                Err(Error::Factorization { unknowns, .. }) => {
                    assert_eq!(unknowns, pencil.mass.nrows())
                }
                Err(other) => panic!("{name} {elements}: {other}"),
                Ok(pairs) => {
                    let error = (pairs.values[2] - beta(1).powi(4) * unit()).abs();
                    assert!(error < pairs.round_off[2], "{name} {elements}: {error:e}");
                }
            }
        }
    }
}

#[test]
fn a_shift_that_is_not_positive_is_refused() {
    let pencil = pencil(&dowel(), 4);
    for (name, solve) in SOLVERS {
        for shift in [0.0, -shift(), f64::NAN, f64::INFINITY] {
            let answer = solve(&pencil.stiffness, &pencil.mass, shift, 4, RESIDUAL);
            let message = answer.unwrap_err().to_string();
            assert!(message.starts_with("shift: found"), "{name}: {message}");
        }
    }
}

#[cfg(feature = "arpack")]
#[test]
fn four_threads_that_ask_arpack_at_once_get_the_same_bits() {
    let pencils: Vec<Pencil> = [1, 2, 20, 41].map(|n| pencil(&dowel(), n)).into();
    let solve = sweetspot::eigen::arpack::lowest;
    let all = || -> Vec<Pairs> { pencils.iter().map(|pencil| solved(solve, pencil, 4)).collect() };
    let alone = all();
    std::thread::scope(|scope| {
        let workers = [(); 4].map(|()| scope.spawn(|| (0..20).map(|_| all()).collect::<Vec<_>>()));
        for worker in workers {
            worker.join().unwrap().iter().for_each(|answer| assert_eq!(*answer, alone));
        }
    });
}

/// The frequencies of every solver are strain energy over kinetic energy of its shapes, so that all agree within their
/// stated errors on elements of any degree, and no stated error is too small.
#[test]
fn four_solvers_give_one_answer() {
    let solvers = [
        Solver::Dense,
        Solver::ShiftInvert,
        #[cfg(feature = "arpack")]
        Solver::Arpack,
    ];
    for name in ["meshes/r161.json", "meshes/cone.json", "meshes/northwestern_aluminium.json"] {
        let bat = bundled_bat(name).unwrap();
        for (elements, degree) in [(40, 3), (300, 3), (33, 5), (32, 8)] {
            let request = Request {
                modes: 8,
                elements: Some(elements),
                degree: Some(degree),
                ..Request::plain()
            };
            let ours = solve(&bat, &request).unwrap();
            for solver in solvers {
                let theirs = solve(&bat, &Request { solver, ..request }).unwrap();
                for (a, b) in ours.modes.iter().zip(&theirs.modes) {
                    let apart = (a.omega / b.omega - 1.0).abs();
                    // Both are on one mesh, whose discretisation error they share.
                    let stated = a.error.round_off + b.error.round_off;
                    let order = a.order;
                    assert!(
                        apart <= 3.0 * stated + 1e-12,
                        "{name} {elements} x p{degree} {solver:?} mode {order}: {apart:e} {stated:e}"
                    );
                    for (x, y) in a.nodes.iter().zip(&b.nodes) {
                        assert!((x - y).abs() < 1e-5 * bat.length(), "{name} {solver:?}: {x} {y}");
                    }
                }
            }
        }
    }
}

/// The U-curve: the eigenvalue of the dense solver loses digits as elements are added, the running sums lose none, and
/// strain energy over kinetic energy restores most of them.
#[test]
fn more_elements_hurt_a_factored_matrix_and_not_the_sums() {
    let bat = dowel();
    let exact = beta(1).powi(2) * unit().sqrt();
    let error = |omega: f64| (omega / exact - 1.0).abs();
    let own = |n: usize| {
        let mesh = Mesh::along(&bat, n);
        own_and_recomputed(&bat, &mesh, 1, Solver::Dense, Theory::EulerBernoulli).unwrap()[0]
            .map(error)
    };
    let sums = |n: usize| {
        let request = Request { modes: 1, elements: Some(n), ..Request::plain() };
        error(solve(&bat, &request).unwrap().modes[0].omega)
    };
    let ([few, _], [many, recomputed]) = (own(64), own(1000));
    assert!(many > 10.0 * few && recomputed < 1e-3 * many, "{few:e} {many:e} {recomputed:e}");
    assert!(sums(1000) < 1e-12 && sums(20_000) < 1e-13, "{:e} {:e}", sums(1000), sums(20_000));
}

#[cfg(not(feature = "arpack"))]
#[test]
fn a_solver_that_is_not_built_in_says_how_to_get_it() {
    let request = Request { solver: Solver::Arpack, ..Request::plain() };
    let said = solve(&dowel(), &request).unwrap_err().to_string();
    assert!(said.contains("libarpack2-dev") && said.contains("--features arpack"), "{said}");
}
