//! The error of elements of degree p falls as the power `2(p − 1)` of their number, also over stations.

use sweetspot::{Request, solve};
use sweetspot_proof::validation::Truth;

/// Larger errors are not asymptotic yet; those below 30 times the round-off are not due to the mesh.
const LARGEST: f64 = 1e-5;

/// A mode with errors within the range on several meshes. The errors of the lowest modes fall from 1e-5 to round-off
/// between 3 and 8 elements of high degree, which are too few for an asymptote.
fn modes(degree: usize) -> [usize; 3] {
    match degree {
        3..=5 => [1, 3, 5],
        6 => [5, 10, 20],
        7 => [10, 20, 30],
        _ => [20, 30, 40],
    }
}

/// Of every mode, the pairs (ln elements, ln error) with errors in that range.
fn errors(truth: &Truth, degree: usize, counts: &[usize], modes: &[usize]) -> Vec<Vec<[f64; 2]>> {
    let mut errors = vec![vec![]; modes.len()];
    for &count in counts {
        let wanted = modes.iter().copied().filter(|mode| 2 * mode <= count * (degree - 1)).max();
        let Some(wanted) = wanted else { continue };
        let (elements, degree) = (Some(count), Some(degree));
        let request = Request { modes: wanted, elements, degree, ..Request::plain() };
        let solution = solve(&truth.bat, &request).unwrap();
        assert_eq!(solution.mesh.len(), count);
        for (errors, &mode) in errors.iter_mut().zip(modes).filter(|(_, mode)| **mode <= wanted) {
            let found = &solution.modes[mode - 1];
            let error = found.frequency() / truth.frequencies[mode - 1] - 1.0;
            if error < LARGEST && error > 30.0 * found.error.round_off {
                errors.push([(count as f64).ln(), error.ln()]);
            }
        }
    }
    errors
}

/// The order by a straight line of least squares through the points.
fn order(points: &[[f64; 2]]) -> f64 {
    let mean = |i: usize| points.iter().map(|p| p[i]).sum::<f64>() / points.len() as f64;
    let (x, y) = (mean(0), mean(1));
    let product: f64 = points.iter().map(|p| (p[0] - x) * (p[1] - y)).sum();
    let square: f64 = points.iter().map(|p| (p[0] - x).powi(2)).sum();
    -product / square
}

fn assert_order(case: &str, degree: usize, modes: &[usize], counts: &[usize], within: f64) {
    let truth =
        if case == "dowel" { Truth::of_dowel(6) } else { Truth::of_cases(&[case]) }.unwrap();
    let expected = 2.0 * (degree - 1) as f64;
    for (points, mode) in errors(&truth, degree, counts, modes).iter().zip(modes) {
        assert!(points.len() >= 3, "{case} degree {degree} mode {mode}: {points:?}");
        let off = order(points) / expected - 1.0;
        assert!(off.abs() < within, "{case} degree {degree} mode {mode}: {off:+.3}");
    }
}

/// Every element count up to 20, then ever larger steps.
fn counts(most: usize) -> Vec<usize> {
    std::iter::successors(Some(2), |n| Some(n + 1 + n / 20)).take_while(|n| *n <= most).collect()
}

#[test]
fn the_order_on_a_cone_is_twice_the_degree_less_two() {
    for degree in 3..=8 {
        let within = if degree < 8 { 0.05 } else { 0.08 };
        assert_order("cone_1_2p64_60", degree, &modes(degree), &counts(120), within);
    }
}

/// The formula of the bat has four pieces, so with multiples of 4 elements all are equally long. Fewer of these meshes
/// have errors between 1e-5 and round-off, so faster modes are used.
#[test]
fn the_order_on_a_smooth_bat_is_twice_the_degree_less_two() {
    let multiples: Vec<usize> = counts(60).iter().map(|n| 4 * n).collect();
    for degree in 3..=8 {
        let within = if degree < 8 { 0.05 } else { 0.08 };
        let modes = if degree < 5 { modes(degree) } else { modes(degree + 1) };
        assert_order("tanh_bat", degree, &modes, &multiples, within);
    }
}

/// Without a taper the asymptote begins where an element spans a phase of 2.4 of a mode, and low modes have only a few
/// element counts between this and round-off.
#[test]
fn high_degrees_gain_as_much_on_few_elements_of_a_dowel() {
    for degree in 6..=8 {
        for mode in 3..=6 {
            // Mode n has the phase (n + ½)π from end to end.
            let least = ((mode as f64 + 0.5) * std::f64::consts::PI / 2.4).ceil() as usize;
            let counts: Vec<usize> = (least..=40).collect();
            assert_order("dowel", degree, &[mode], &counts, 0.05);
        }
    }
}

/// On a tapered bat round-off is reached before the asymptote, the earlier the higher the degree.
#[test]
fn high_degrees_gain_nearly_as_much_on_few_elements_of_a_cone() {
    for (degree, within) in [(6, 0.08), (7, 0.15), (8, 0.23)] {
        assert_order("cone_1_2p64_60", degree, &[1, 3, 5], &counts(40), within);
    }
}

/// A step of 1 : 3 in the middle and an even number of elements: the step is a node.
#[test]
fn a_step_costs_no_order() {
    let even: Vec<usize> = counts(60).iter().map(|n| 2 * n).collect();
    for degree in 3..=7 {
        assert_order("step_1_3_60", degree, &modes(degree), &even, 0.05);
    }
}

/// Seven pieces of 20 to 200 mm: multiples of 42 elements have all of nearly one length.
#[test]
fn stations_cost_no_order() {
    let multiples: Vec<usize> = (1..=8).map(|k| 42 * k).collect();
    for (degree, modes) in [(3, [1, 3, 5]), (4, [10, 20, 30]), (5, [30, 40, 60])] {
        assert_order("linear_bat", degree, &modes, &multiples, 0.08);
    }
}

#[test]
fn no_element_lies_across_a_station() {
    for case in ["linear_bat", "steps_many", "pchip_bat", "hollow_linear"] {
        let bat = Truth::of_cases(&[case]).unwrap().bat;
        for count in 1..=60 {
            let request =
                Request { modes: 1, elements: Some(count), degree: Some(5), ..Request::plain() };
            let nodes = solve(&bat, &request).unwrap().mesh.nodes();
            for x in &bat.profile().stations.x {
                let nearest = nodes.iter().map(|node| (node - x).abs()).fold(1.0, f64::min);
                assert!(nearest < 1e-15, "{case}, {count} elements: {x} is {nearest:e} away");
            }
        }
    }
}
