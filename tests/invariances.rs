//! Results that must not change when nothing physical does, and known changes when something does, as far as the
//! extremes do not cover them.

use crate::common;

use common::{LENGTH, bat, cone, dowel};
use sweetspot::bat::material::Material;
use sweetspot::bat::profile::{Interpolation, Profile};
use sweetspot::bat::theory::Theory;
use sweetspot::beam::assembly::{Pencil, write_matrix_market};
use sweetspot::beam::mesh::Mesh;
use sweetspot::{Bat, Request, solve};
use sweetspot_proof::bundled::bundled_bat;

fn frequencies(bat: &Bat) -> Vec<f64> {
    let request = Request { modes: 6, elements: Some(48), ..Request::plain() };
    solve(bat, &request).unwrap().modes.iter().map(|mode| mode.frequency()).collect()
}

#[test]
fn a_bat_turned_end_for_end_has_its_nodes_mirrored() {
    // 1 : 1000 as well, where one end is a needle and the running sums might favour a direction.
    for original in [cone(0.0125, 0.033), cone(3.3e-5, 0.033)] {
        let turned =
            original.with(|parts| parts.profile = parts.profile.clone().reversed()).unwrap();
        let request = Request { modes: 8, elements: Some(400), ..Request::plain() };
        let (a, b) = (solve(&original, &request).unwrap(), solve(&turned, &request).unwrap());
        for (a, b) in a.modes.iter().zip(&b.modes) {
            assert_eq!((a.nodes.len(), b.nodes.len()), (a.order + 1, a.order + 1));
            for (node, mirrored) in a.nodes.iter().zip(b.nodes.iter().rev()) {
                assert!((node + mirrored - original.length()).abs() < 1e-11);
            }
        }
    }
}

#[test]
fn a_tube_without_a_bore_is_the_solid_bat_and_a_thin_one_tends_to_its_limit() {
    let tube =
        |inner: f64| bat(&[0.0, LENGTH], &[common::RADIUS; 2], &[inner; 2], Interpolation::Linear);
    assert_eq!(frequencies(&tube(0.0)), frequencies(&dowel()));
    // EI/ρA = E (r² + rᵢ²)/4ρ, exactly, so the frequency grows by √(1 + rᵢ²/r²).
    for share in [1e-9, 0.5, 0.9, 0.999_999] {
        let growth = (1.0_f64 + share * share).sqrt();
        for (a, b) in frequencies(&dowel()).iter().zip(frequencies(&tube(share * common::RADIUS))) {
            assert!((b / a / growth - 1.0).abs() < 1e-10, "{share}: {}", b / a / growth);
        }
    }
}

#[test]
fn the_weighed_mass_sets_the_density_and_nothing_else() {
    let stations = dowel().profile().stations.clone();
    let profile = Profile::new(stations).unwrap();
    let light = Material::new(1.0, common::MODULUS).unwrap();
    let bat = Bat::builder(profile, light).name("weighed").mass(Some(0.9)).build().unwrap();
    assert!((bat.inertia().mass - 0.9).abs() < 1e-15);
    let ratio = (common::DENSITY / bat.material().density).sqrt();
    for (a, b) in frequencies(&dowel()).iter().zip(frequencies(&bat)) {
        assert!((b / a / ratio - 1.0).abs() < 1e-13);
    }
}

/// Closed forms of the frustum: V = πL(r₁² + r₁r₂ + r₂²)/3 and the moments of its disks.
#[test]
fn a_frustum_weighs_and_balances_as_its_closed_form() {
    let (r1, r2) = (0.0125_f64, 0.033_f64);
    let inertia = cone(r1, r2).inertia();
    let square = r1 * r1 + r1 * r2 + r2 * r2;
    let mass = common::DENSITY * std::f64::consts::PI * LENGTH * square / 3.0;
    let balance = LENGTH * (r1 * r1 + 2.0 * r1 * r2 + 3.0 * r2 * r2) / (4.0 * square);
    // ∫r² x² dx and ∫r⁴ dx over a linear radius.
    let second = LENGTH.powi(3) * (r1 * r1 + 3.0 * r1 * r2 + 6.0 * r2 * r2) / 30.0;
    let fourth = LENGTH * (r2.powi(5) - r1.powi(5)) / (5.0 * (r2 - r1));
    let rho = common::DENSITY * std::f64::consts::PI;
    let line = rho * second - mass * balance * balance;
    let same = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-13, "{a} {b}");
    same(inertia.mass, mass);
    same(inertia.balance_point, balance);
    same(inertia.line_about_balance, line);
    same(inertia.about_balance, line + rho * fourth / 4.0);
}

/// `K r = 0` and `rᵀ M r` for the two rigid motions; K and M symmetric; modes M-orthonormal.
#[test]
fn the_assembled_matrices_know_the_rigid_motions_and_the_modes() {
    let bat = bundled_bat("meshes/r161.json").unwrap();
    let mesh = Mesh::along(&bat, 60);
    let pencil = Pencil::of(&bat, &mesh, 3, Theory::EulerBernoulli);
    let nodes = mesh.nodes();
    let lift: Vec<f64> = nodes.iter().flat_map(|_| [1.0, 0.0]).collect();
    let turn: Vec<f64> = nodes.iter().flat_map(|x| [*x, 1.0]).collect();
    let product = |a: &nalgebra_sparse::CscMatrix<f64>, x: &[f64], y: &[f64]| -> f64 {
        a.triplet_iter().map(|(i, j, v)| x[i] * v * y[j]).sum()
    };
    let stiff = pencil.stiffness.triplet_iter().fold(0.0_f64, |m, (_, _, v)| m.max(v.abs()));
    for rigid in [&lift, &turn] {
        for row in 0..lift.len() {
            let unit: Vec<f64> = (0..lift.len()).map(|i| f64::from(u8::from(i == row))).collect();
            let force = product(&pencil.stiffness, &unit, rigid);
            assert!(force.abs() < 1e-13 * stiff, "{force:e} of {stiff:e}");
        }
    }
    let body = bat.inertia();
    let about_knob = body.line_about_balance + body.mass * body.balance_point.powi(2);
    let mass = |x: &[f64], y: &[f64]| product(&pencil.mass, x, y);
    assert!((mass(&lift, &lift) / body.mass - 1.0).abs() < 1e-13);
    assert!((mass(&lift, &turn) / (body.mass * body.balance_point) - 1.0).abs() < 1e-13);
    assert!((mass(&turn, &turn) / about_knob - 1.0).abs() < 1e-13);

    let request = Request { modes: 8, elements: Some(60), ..Request::plain() };
    let modes = solve(&bat, &request).unwrap().modes;
    let vectors: Vec<Vec<f64>> = modes
        .iter()
        .map(|mode| {
            let scale = mode.modal_mass.sqrt();
            let at = |x: &f64| [mode.shape.deflection(*x) / scale, mode.shape.rotation(*x) / scale];
            nodes.iter().flat_map(at).collect()
        })
        .collect();
    for (i, a) in vectors.iter().enumerate() {
        for (j, b) in vectors.iter().enumerate() {
            let expected = if i == j { 1.0 } else { 0.0 };
            assert!((mass(a, b) - expected).abs() < 1e-9, "{i} {j}: {:e}", mass(a, b));
        }
        assert!(mass(a, &lift).abs() < 1e-9 && mass(a, &turn).abs() < 1e-9);
        let energy = product(&pencil.stiffness, a, a);
        assert!((energy / modes[i].omega.powi(2) - 1.0).abs() < 1e-8, "{i}");
    }
}

/// The matrices of a planned solution belong to its mesh: the shapes sampled at its nodes have their frequencies there.
#[test]
fn the_matrices_of_a_solution_have_its_modes() {
    let bat = bundled_bat("meshes/r161.json").unwrap();
    let request = Request { degree: Some(3), tolerance: 1e-6, ..Request::plain() };
    let solution = solve(&bat, &request).unwrap();
    let mesh = &solution.mesh;
    let pencil = Pencil::of(&bat, mesh, solution.degree, Theory::EulerBernoulli);
    for mode in &solution.modes {
        let at = |x: &f64| [mode.shape.deflection(*x), mode.shape.rotation(*x)];
        let u: Vec<f64> = mesh.nodes().iter().flat_map(at).collect();
        let form = |a: &nalgebra_sparse::CscMatrix<f64>| -> f64 {
            a.triplet_iter().map(|(i, j, v)| u[i] * v * u[j]).sum()
        };
        let quotient = form(&pencil.stiffness) / form(&pencil.mass);
        assert!((quotient.sqrt() / mode.omega - 1.0).abs() < 1e-7, "mode {}", mode.order);
        assert!((form(&pencil.mass) / mode.modal_mass - 1.0).abs() < 1e-9);
    }
}

#[test]
fn a_matrix_market_file_holds_the_lower_triangle() {
    let bat = dowel();
    let pencil = Pencil::of(&bat, &Mesh::along(&bat, 2), 3, Theory::EulerBernoulli);
    let mut text = Vec::new();
    write_matrix_market(&pencil.mass, &mut text).unwrap();
    let text = String::from_utf8(text).unwrap();
    let mut lines = text.lines().filter(|line| !line.starts_with('%'));
    assert!(text.starts_with("%%MatrixMarket matrix coordinate real symmetric\n"));
    // Two elements: 6 unknowns, bandwidth 4; 10 + 10 − 3 shared entries.
    assert_eq!(lines.next(), Some("6 6 17"));
    let total: f64 = lines
        .map(|line| {
            let cells: Vec<&str> = line.split(' ').collect();
            let (row, column) =
                (cells[0].parse::<usize>().unwrap(), cells[1].parse::<usize>().unwrap());
            assert!(row >= column);
            let value: f64 = cells[2].parse().unwrap();
            // Deflections of all nodes 1, slopes 0: the sum is the mass.
            let counts = row % 2 == 1 && column % 2 == 1;
            if counts { if row == column { value } else { 2.0 * value } } else { 0.0 }
        })
        .sum();
    assert!((total / bat.inertia().mass - 1.0).abs() < 1e-14);
}

#[test]
fn shapes_are_scaled_and_signed_as_agreed() {
    // Also bats whose highest sample is not next to the highest peak of every mode.
    for (bat, modes, tolerance) in [
        ("torpedo", 10, 1e-4),
        ("northwestern_wood", 10, 1e-9),
        ("northwestern_aluminium", 10, 1e-4),
        ("r161", 60, 1e-6),
    ] {
        let bat = bundled_bat(&format!("meshes/{bat}.json")).unwrap();
        let request = Request { modes, tolerance, ..Request::plain() };
        for mode in solve(&bat, &request).unwrap().modes {
            let samples = (0..=20_000).map(|k| bat.length() * f64::from(k) / 20_000.0);
            let largest = samples.map(|x| mode.shape.deflection(x).abs()).fold(0.0, f64::max);
            assert!(largest <= 1.0 + 1e-12 && largest > 0.999_9, "{} {largest}", bat.name());
            assert!(mode.shape.deflection(bat.length()) > 0.0);
            for node in &mode.nodes {
                assert!(mode.shape.deflection(*node).abs() < 1e-12);
            }
        }
    }
}
