//! The modes against closed forms, and the stated errors against the true ones.

use crate::common;

use std::time::Duration;

use common::{LENGTH, beta, cone, dowel, dowel_frequency};
use sweetspot::modes::mode::Mode;
use sweetspot::modes::solve::solve_within;
use sweetspot::{Bat, Request, Solver, Theory, solve};
use sweetspot_proof::bundled::{CASES, bundled_bat};
use sweetspot_proof::validation::Truth;

fn on(elements: usize, modes: usize) -> Request {
    Request { modes, elements: Some(elements), ..Request::plain() }
}

/// Ritz values lie above the exact ones by `(βh)⁴/1440` to leading order. The next term is
/// of the order of `−(βh)²/10` of that: 2.4 % for mode 2 on 16 elements, where the discrete
/// frequency is known to 20 digits (validation case `hermite_16`), below 2 % for βh up to 0.44.
#[test]
fn the_frequency_error_of_a_dowel_is_the_one_theory_predicts() {
    let mut checked = 0;
    for elements in [16, 23, 64, 128, 512] {
        for mode in &solve(&dowel(), &on(elements, 10)).unwrap().modes {
            let step = beta(mode.order) / elements as f64;
            let predicted = step.powi(4) / 1440.0;
            // Below it, round-off of both frequencies dominates the ratio.
            if step > 0.5 || predicted < 1e-11 {
                continue;
            }
            let error = mode.frequency() / dowel_frequency(mode.order) - 1.0;
            let ratio = error / predicted;
            assert!(
                (ratio - 1.0).abs() < (0.1 * step * step).max(0.02),
                "n {elements} mode {}: {ratio}",
                mode.order
            );
            checked += 1;
        }
    }
    assert!(checked > 25, "{checked}");
}

#[test]
fn a_hundred_thousand_elements_lose_no_digits() {
    let bat = dowel();
    let (coarse, fine) = (solve(&bat, &on(10_000, 10)), solve(&bat, &on(100_000, 10)));
    let (coarse, fine) = (coarse.unwrap().modes, fine.unwrap().modes);
    for (order, most) in [(1, 1e-12), (10, 1e-11)] {
        let (few, many) = (coarse[order - 1].frequency(), fine[order - 1].frequency());
        let step = beta(order) / 1e4;
        let predicted = step.powi(4) / 1440.0;
        assert!((many / dowel_frequency(order) - 1.0).abs() < most, "mode {order}: {many}");
        assert!((few / many - 1.0 - predicted).abs() < most, "mode {order}: {few} {many}");
    }
}

#[test]
fn sixty_modes_of_a_dowel_are_found_in_order_with_their_nodes() {
    let request = Request { modes: 60, tolerance: 1e-8, ..Request::plain() };
    let solution = solve(&dowel(), &request).unwrap();
    assert!(solution.met());
    for mode in &solution.modes {
        let error = (mode.frequency() / dowel_frequency(mode.order) - 1.0).abs();
        assert!(error < 1e-8, "mode {}: {error:e}", mode.order);
        assert_eq!(mode.nodes.len(), mode.order + 1);
    }
    // Between two nodes of a mode lies one of the mode before (Sturm).
    for pair in solution.modes.windows(2) {
        for (k, node) in pair[0].nodes.iter().enumerate() {
            assert!(pair[1].nodes[k] < *node && *node < pair[1].nodes[k + 1]);
        }
    }
}

/// Bats whose frequencies are known from elsewhere (Bessel functions, transfer matrices, a
/// spectral method), for every tolerance; the known values are good to `floor`.
#[test]
fn the_promise_holds_on_cones_steps_and_real_bats() {
    let (mut close, mut all) = (0, 0);
    for (name, floor) in [
        ("cone_1_2p64", 1e-14),
        ("cone_1_10", 1e-14),
        ("step_1_3", 1e-14),
        ("r161_reference", 1e-10),
        ("torpedo_reference", 1e-10),
        ("house_reference", 1e-10),
    ] {
        let (_, text) = CASES.iter().find(|(case, _)| *case == name).unwrap();
        let case: serde_json::Value = serde_json::from_str(text).unwrap();
        let bat = match &case["bat"] {
            serde_json::Value::String(path) => bundled_bat(path).unwrap(),
            inline => Bat::from_text(name, &inline.to_string(), "".as_ref()).unwrap(),
        };
        let known = case["checks"].as_array().unwrap().iter();
        let known = known.filter(|check| check["quantity"] == "frequency_hz");
        let known: Vec<f64> = known.map(|check| check["expected"].as_f64().unwrap()).collect();
        assert_eq!(known.len(), 10, "{name}");
        for exponent in 2..=9 {
            let tolerance = 10f64.powi(-exponent);
            let solution = solve(&bat, &Request { tolerance, ..Request::plain() }).unwrap();
            for (mode, exact) in solution.modes.iter().zip(&known) {
                let truth = (mode.frequency() / exact - 1.0).abs();
                let stated = mode.error.total();
                let order = mode.order;
                assert!(truth <= 3.0 * stated + floor, "{name} {order}: {truth:e} {stated:e}");
                if truth > 10.0 * floor {
                    all += 1;
                    close += usize::from(stated <= 30.0 * truth);
                }
            }
        }
    }
    assert!(10 * close >= 9 * all, "{close} of {all}");
}

/// The same on the dowel, whose frequencies are known to the last digit.
#[test]
fn the_true_error_is_within_three_times_the_stated_one() {
    let (mut close, mut all) = (0, 0);
    for exponent in 2..=12 {
        let tolerance = 10f64.powi(-exponent);
        let solution = solve(&dowel(), &Request { tolerance, ..Request::plain() }).unwrap();
        for mode in &solution.modes {
            let truth = (mode.frequency() / dowel_frequency(mode.order) - 1.0).abs();
            let stated = mode.error.total();
            // Our own "exact" frequency is accurate to about 1e-15.
            assert!(truth <= 3.0 * stated + 1e-15, "{tolerance:e}: {truth:e} {stated:e}");
            assert!(stated <= tolerance, "{tolerance:e}: {stated:e}");
            if truth > 1e-13 {
                all += 1;
                close += usize::from(stated <= 30.0 * truth);
            }
        }
    }
    assert!(10 * close >= 9 * all, "{close} of {all}");
}

#[test]
fn a_fixed_mesh_states_its_error_too() {
    for elements in [5, 7, 12, 16, 40, 128, 200] {
        for mode in &solve(&dowel(), &on(elements, 5)).unwrap().modes {
            let truth = (mode.frequency() / dowel_frequency(mode.order) - 1.0).abs();
            let stated = mode.error.total();
            assert!(truth <= 3.0 * stated, "n {elements} {}: {truth:e} {stated:e}", mode.order);
        }
    }
}

#[test]
fn an_unreachable_tolerance_gives_the_best_answer_and_says_so() {
    let request = Request { modes: 2, tolerance: 1e-16, ..Request::plain() };
    let solution = solve(&cone(0.0125, 0.033), &request).unwrap();
    assert!(!solution.met());
    assert!(solution.worst() < 1e-12 && solution.worst() > 1e-16, "{:e}", solution.worst());
}

/// Every refined mesh contains the coarser one's space, so every Ritz value falls.
#[test]
fn refinement_lowers_every_frequency() {
    let bat = cone(0.0125, 0.033);
    let solutions: Vec<_> = [6, 12, 24, 48].map(|n| solve(&bat, &on(n, 10)).unwrap()).into();
    for pair in solutions.windows(2) {
        for (coarse, fine) in pair[0].modes.iter().zip(&pair[1].modes) {
            assert!(fine.omega < coarse.omega, "mode {}", coarse.order);
        }
    }
}

/// The dense path shares the elements but neither the operator nor the eigensolver.
#[test]
fn the_dense_solver_finds_the_same_modes() {
    let r161 = bundled_bat("meshes/r161.json").unwrap();
    for bat in [dowel(), cone(0.0125, 0.033), r161] {
        let statics = solve(&bat, &on(40, 10)).unwrap();
        let dense = solve(&bat, &Request { solver: Solver::Dense, ..on(40, 10) }).unwrap();
        for (ours, theirs) in statics.modes.iter().zip(&dense.modes) {
            let difference = (ours.omega / theirs.omega - 1.0).abs();
            assert!(difference < 3.0 * theirs.error.round_off + 1e-12, "{difference:e}");
            for (a, b) in ours.nodes.iter().zip(&theirs.nodes) {
                assert!((a - b).abs() < 1e-5 * LENGTH, "{a} {b}");
            }
        }
    }
}

#[test]
fn one_element_bends_in_two_ways_and_no_more() {
    // The exact discrete values Ω² = 720 and 8400, Ω² = ω² ρA L⁴/EI.
    let solution = solve(&dowel(), &on(1, 2)).unwrap();
    for (mode, exact) in solution.modes.iter().zip([720.0_f64, 8400.0]) {
        let ratio = mode.frequency() / dowel_frequency(1) * beta(1).powi(2);
        assert!((ratio / exact.sqrt() - 1.0).abs() < 1e-13);
    }
    assert!(solve(&dowel(), &on(1, 3)).is_err());
}

#[test]
fn a_bat_that_ends_in_a_point_rings_within_its_stated_error() {
    // Known to more than 20 digits from Kirchhoff's equation and two other ways.
    let truth = Truth::of_cases(&["cone_complete"]).unwrap();
    for tolerance in [1e-2, 1e-4, 1e-6, 1e-9] {
        let request = Request { tolerance, modes: 5, ..Request::plain() };
        let solution = solve(&truth.bat, &request).unwrap();
        for (mode, exact) in solution.modes.iter().zip(&truth.frequencies) {
            let off = (mode.frequency() / exact - 1.0).abs();
            let stated = mode.error.total();
            assert!(off <= 3.0 * stated + 1e-14 && stated <= tolerance, "{off:e} {stated:e}");
        }
    }
}

/// Whatever the time, an answer comes with its error; more time never makes it worse.
#[test]
fn a_budget_gives_the_best_answer_that_fits() {
    let truth = Truth::of_cases(&["cone_1_2p64_60"]).unwrap();
    let request = Request { modes: 5, ..Request::plain() };
    let plenty = solve_within(&truth.bat, &request, Duration::from_secs(5)).unwrap();
    assert!(plenty.met() && plenty.worst() < 1e-12, "{:e}", plenty.worst());
    let nothing = solve_within(&truth.bat, &request, Duration::from_nanos(1)).unwrap();
    assert!(!nothing.met() && nothing.worst() <= 0.1 && nothing.modes.len() == 5);
    for solution in [&nothing, &plenty] {
        for (mode, exact) in solution.modes.iter().zip(&truth.frequencies) {
            let (off, stated) = ((mode.frequency() / exact - 1.0).abs(), mode.error.total());
            assert!(off <= 3.0 * stated + 1e-14, "{off:e} {stated:e}");
        }
    }
}

/// All degrees that the planner can choose reach a tolerance, each on its own mesh.
#[test]
fn every_degree_keeps_the_promise() {
    let truth = Truth::of_cases(&["cone_1_2p64_60"]).unwrap();
    let mut elements = usize::MAX;
    for degree in 3..=12 {
        let request = Request { degree: Some(degree), tolerance: 1e-7, ..Request::plain() };
        let solution = solve(&truth.bat, &request).unwrap();
        assert!(solution.met() && solution.degree == degree);
        assert!(solution.mesh.len() <= elements, "a higher degree needs fewer elements");
        elements = solution.mesh.len();
        for (mode, exact) in solution.modes.iter().zip(&truth.frequencies) {
            let (off, stated) = ((mode.frequency() / exact - 1.0).abs(), mode.error.total());
            assert!(off <= 3.0 * stated + 1e-14, "p{degree} {off:e} {stated:e}");
        }
    }
}

/// The highest requested mode may be one of a pair whose other mode is not requested: pairs of the dumbbell are down to
/// 5e-5 apart. The reference is 20 modes to ten or eleven digits.
#[test]
fn a_mode_is_the_same_within_its_errors_however_many_are_asked_for() {
    for name in ["dumbbell", "r161", "torpedo", "house", "northwestern_aluminium", "cone"] {
        let dumbbell = name == "dumbbell";
        let bat = match dumbbell {
            true => Truth::of_cases(&["dumbbell"]).unwrap().bat,
            false => bundled_bat(&format!("meshes/{name}.json")).unwrap(),
        };
        let asked = |modes, tolerance| {
            solve(&bat, &Request { modes, tolerance, ..Request::plain() }).unwrap().modes
        };
        let exact = asked(20, if dumbbell { 1e-10 } else { 1e-11 });
        for (tolerance, modes) in
            [1e-2, 1e-3, 1e-4, 1e-6, 1e-8].into_iter().flat_map(|t| (1..20).map(move |n| (t, n)))
        {
            for (mode, exact) in asked(modes, tolerance).iter().zip(&exact) {
                let within = |what: &str, found: f64, stated: f64| {
                    let what =
                        format!("{name}: {what} {} of {modes} for {tolerance:e}", mode.order);
                    assert!(found <= 3.0 * stated, "{what} is off by {found:e}, stated {stated:e}");
                };
                let (own, other) = (&mode.error, &exact.error);
                let mass = (mode.modal_mass / exact.modal_mass - 1.0).abs();
                within(
                    "frequency",
                    (mode.omega / exact.omega - 1.0).abs(),
                    own.total() + other.total(),
                );
                within("mass", mass, own.modal_mass + other.modal_mass);
                // Every node is listed, or is in a stretch in which, by the answer, nodes cannot be located.
                let known = own.nodes + other.nodes;
                let untold = |x: f64, of: &Mode| {
                    of.untold.iter().any(|[a, b]| *a - known <= x && x <= *b + known)
                };
                let off = |x: f64, of: &[f64]| {
                    of.iter().map(|y| (x - y).abs()).fold(f64::INFINITY, f64::min)
                };
                let own = mode.nodes.iter().filter(|x| !untold(**x, exact));
                assert!(
                    own.clone().count() <= exact.nodes.len(),
                    "{name} {tolerance:e} {modes}: {:?} {:?} {:?} {:?}",
                    mode.nodes,
                    mode.untold,
                    exact.nodes,
                    exact.untold
                );
                own.for_each(|x| within("node", off(*x, &exact.nodes), known));
                let listed = exact.nodes.iter().filter(|x| !untold(**x, mode));
                listed.for_each(|x| within("node", off(*x, &mode.nodes), known));
            }
        }
    }
}

/// A single mode of a rod at the edge of arithmetic, in closed form; then twenty cylinders, thick ones on thin ones,
/// whose first frequency the transfer matrices give with 256 bits (`search/reference.py`).
#[test]
fn the_round_off_of_a_rod_and_of_a_chain_of_cylinders_is_within_what_is_stated() {
    let rod = r#"{ "format": "sweetspot-bat/1", "name": "rod", "material": { "density": 872.3926239428256,
        "youngs_modulus": 10709753329.35646 }, "profile": { "interpolation": "constant",
        "x": [0.0, 0.7555227933761856], "radius": [0.02129207709237852, 0.02129207709237852] } }"#;
    let chain = r#"{ "format": "sweetspot-bat/1", "name": "chain", "material": { "density": 825.9087813728294,
        "youngs_modulus": 15443708160.44743, "shear_modulus": 1798257277.981977,
        "shear_coefficient": 0.5163665701781662 }, "profile": { "interpolation": "constant",
        "x": [0.0, 0.024233097862596677, 0.03386398304231097, 0.12012674432673583, 0.13127989609156948,
        0.19301907217093922, 0.21072480918763964, 0.2822416634981044, 0.3035016501224824, 0.32059294008621364,
        0.3589662871406377, 0.4272387948508746, 0.45031594478473125, 0.5100107669369066, 0.514608371813188,
        0.5704475803133818, 0.671774142872647, 0.7439211415821062, 0.7515043064943124, 0.822224572684607,
        0.8504199949883617], "radius": [0.07790696942320188, 0.02465772581659259, 0.01084868517134951,
        0.01513054939434322, 0.04599351244385202, 0.06596011258520529, 0.0412095090829045, 0.03417121254490006,
        0.007401161228885981, 0.00809466137581869, 0.03673035720512565, 0.07633352445485785, 0.07822738093974549,
        0.032391617059750626, 0.012255937810181326, 0.017296104148518614, 0.005872124350282712,
        0.006500342585832123, 0.007134341179962125, 0.11040242985807089, 0.11040242985807089] } }"#;
    let (beta, length) = (4.730040744862704, 0.7555227933761856_f64);
    let speed = (10709753329.35646_f64 / 872.3926239428256).sqrt() * 0.02129207709237852 / 2.0;
    let closed = (beta / length).powi(2) * speed / std::f64::consts::TAU;
    for (text, theory, tolerance, exact) in [
        (rod, Theory::EulerBernoulli, 3.006816322114997e-13, closed),
        (chain, Theory::Timoshenko, 2.1457221786818713e-12, 21.419_032_724_765_545),
    ] {
        let bat = Bat::from_text("bat.json", text, "".as_ref()).unwrap();
        let request = Request { modes: 1, tolerance, theory, ..Request::plain() };
        let solution = solve(&bat, &request).unwrap();
        let mode = &solution.modes[0];
        let (off, stated) = ((mode.frequency() / exact - 1.0).abs(), mode.error.total());
        assert!(solution.met() && off <= 3.0 * stated + 4e-16, "{off:.1e} {stated:.1e}");
    }
}
