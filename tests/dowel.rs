//! The closed forms of a uniform beam, compared with the beam equation and with each other.

use sweetspot::beam::dowel::Ends::{self, *};
use sweetspot::beam::dowel::UniformMode;

const ALL: [Ends; 6] =
    [FreeFree, ClampedFree, ClampedClamped, PinnedPinned, ClampedPinned, FreePinned];

/// Three-point Gauss on `panels` equal panels of [0, 1].
fn integral(panels: usize, f: impl Fn(f64) -> f64) -> f64 {
    let h = 1.0 / panels as f64;
    let reach = 0.5 * 0.6_f64.sqrt();
    let panel = |i: usize| {
        let at = |s: f64| f((i as f64 + 0.5 + s) * h);
        h * (5.0 * at(-reach) + 8.0 * at(0.0) + 5.0 * at(reach)) / 18.0
    };
    (0..panels).map(panel).sum()
}

#[test]
fn shapes_have_unit_mean_square_and_are_orthogonal() {
    for ends in ALL {
        for (n, m) in [(1, 1), (1, 2), (1, 3), (2, 2), (3, 5), (12, 12), (12, 14), (40, 40)] {
            let (a, b) = (UniformMode::new(ends, n), UniformMode::new(ends, m));
            let overlap = integral(4000, |x| a.deflection(x) * b.deflection(x));
            let exact = if n == m { 1.0 } else { 0.0 };
            // The rule's error is (βL/panels)⁶/2000 of the integrand, below round-off.
            assert!((overlap - exact).abs() < 2e-14, "{ends:?} {n} {m}: {overlap}");
        }
    }
}

#[test]
fn a_slope_is_the_derivative_and_curvature_obeys_the_beam_equation() {
    for ends in ALL {
        let mode = UniformMode::new(ends, 3);
        for x in [0.1, 0.3, 0.49, 0.7, 0.9] {
            let h = 1e-4;
            let difference = (mode.deflection(x + h) - mode.deflection(x - h)) / (2.0 * h);
            assert!((difference - mode.slope(x)).abs() < 1e-5 * mode.beta_l, "{ends:?} {x}");
            let w = |i: f64| mode.curvature(x + i * 1e-3);
            let fourth = (w(1.0) - 2.0 * w(0.0) + w(-1.0)) / 1e-6;
            let exact = mode.beta_l.powi(4) * mode.deflection(x);
            assert!((fourth - exact).abs() < 1e-4 * mode.beta_l.powi(4), "{ends:?} {x}");
        }
    }
}

/// Slopes are compared in units of βL, curvatures in units of (βL)².
#[test]
fn the_ends_are_held_as_they_say() {
    for n in [1, 2, 3, 12, 50, 200] {
        for ends in ALL {
            let mode = UniformMode::new(ends, n);
            let name = format!("{ends:?}");
            let (near, far) = name.split_at(name.rfind(char::is_uppercase).unwrap());
            for (end, x) in [(near, 0.0), (far, 1.0)] {
                let b = mode.beta_l;
                let (w, tilt) = (mode.deflection(x), mode.slope(x) / b);
                let bend = mode.curvature(x) / b.powi(2);
                let zero = |v: f64| v.abs() < 1e-15 * b.max(4.0);
                match end {
                    "Free" => {
                        assert!((w.abs() - 2.0).abs() < 1e-14 && zero(bend), "{name} {n}")
                    }
                    "Clamped" => assert!(zero(w) && zero(tilt), "{name} {n}: {w} {tilt}"),
                    _ => assert!(zero(w) && zero(bend), "{name} {n}: {w} {bend}"),
                }
            }
        }
    }
}

#[test]
fn free_free_modes_to_200_are_finite_symmetric_and_have_one_node_more_than_their_number() {
    for n in 1..=200 {
        let mode = UniformMode::new(FreeFree, n);
        let nodes = mode.nodes();
        let odd = if n % 2 == 1 { 1.0 } else { -1.0 };
        assert_eq!(nodes.len(), n + 1);
        for x in [0.0, 0.03, 0.2, 0.37] {
            let (near, far) = (mode.deflection(x), mode.deflection(1.0 - x));
            assert!(near.abs() <= 2.0 && (near - odd * far).abs() < 1e-13, "{n} {x}");
        }
        for (node, mirror) in nodes.iter().zip(nodes.iter().rev()) {
            assert!((node + mirror - 1.0).abs() < 1e-15, "{n}: {node}");
        }
    }
    let first = UniformMode::new(FreeFree, 1).nodes();
    assert!((first[0] - 0.224_157_522_702).abs() < 1e-12);
}

#[test]
fn the_other_ends_have_their_number_of_nodes() {
    let counts = [(ClampedFree, 0), (ClampedClamped, 0), (PinnedPinned, 0)];
    for (ends, extra) in counts.into_iter().chain([(ClampedPinned, 0), (FreePinned, 1)]) {
        for n in 1..=60 {
            let nodes = UniformMode::new(ends, n).nodes();
            assert_eq!(nodes.len(), n - 1 + extra, "{ends:?} {n}");
        }
    }
}

#[test]
fn largest_is_the_largest_of_many_samples() {
    for ends in ALL {
        for n in [1, 2, 5] {
            let mode = UniformMode::new(ends, n);
            let sampled =
                (0..=10_000).map(|i| mode.deflection(i as f64 / 1e4).abs()).fold(0.0, f64::max);
            // Half a sample away from its maximum a wave is lower by the share (b h/2)²/2.
            let miss = (mode.beta_l * 0.5e-4).powi(2);
            assert!((mode.largest() - sampled).abs() < miss, "{ends:?} {n}");
        }
    }
}
