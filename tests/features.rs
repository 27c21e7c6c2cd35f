//! Features of formulas between any samples are in the frequencies: a Runge–Kutta shooting method,
//! which shares no code with the program and knows where each feature is, has a frequency within
//! three times the stated error.

use crate::common;

use std::f64::consts::{PI, TAU};
use std::path::Path;

use common::{DENSITY, MODULUS};
use serde_json::json;
use sweetspot::bat::profile::{Interpolation, Profile, Stations};
use sweetspot::modes::plan::Plan;
use sweetspot::modes::solve::wanted;
use sweetspot::{Bat, Error, Material, Request, Theory, solve};

const LENGTH: f64 = 0.84;

fn read(outer: &str, inner: Option<&str>) -> Result<Bat, Error> {
    let mut piece = json!({ "from": 0.0, "to": LENGTH, "formula": outer });
    if let Some(inner) = inner {
        piece["inner_formula"] = json!(inner);
    }
    let file = json!({
        "format": "sweetspot-bat/1",
        "material": { "density": DENSITY, "youngs_modulus": MODULUS },
        "profile": { "pieces": [piece] },
    });
    Bat::from_text("bat.json", &file.to_string(), Path::new(""))
}

/// A bat in formulas, the same formulas in Rust, and the place and width of its feature.
struct Case {
    outer: &'static str,
    inner: Option<&'static str>,
    radii: fn(f64) -> [f64; 2],
    at: f64,
    width: f64,
}

fn bell(x: f64, at: f64, width: f64) -> f64 {
    (-((x - at) / width).powi(2)).exp()
}

const CASES: [Case; 8] = [
    Case {
        outer: "0.02-0.015*exp(-((x-0.4)/0.001)^2)",
        inner: None,
        radii: |x| [0.02 - 0.015 * bell(x, 0.4, 0.001), 0.0],
        at: 0.4,
        width: 0.001,
    },
    Case {
        outer: "0.02-0.015*exp(-((x-0.6013)/0.0003)^2)",
        inner: None,
        radii: |x| [0.02 - 0.015 * bell(x, 0.6013, 0.0003), 0.0],
        at: 0.6013,
        width: 0.0003,
    },
    Case {
        outer: "0.015 + 0.01*x + 0.003*tanh((x-0.5123)/0.00001)",
        inner: None,
        radii: |x| [0.015 + 0.01 * x + 0.003 * ((x - 0.5123) / 1e-5).tanh(), 0.0],
        at: 0.5123,
        width: 1e-5,
    },
    Case {
        outer: "0.02 + 0.0001*exp(-((x-0.30007)/0.0002)^2)",
        inner: None,
        radii: |x| [0.02 + 1e-4 * bell(x, 0.30007, 0.0002), 0.0],
        at: 0.30007,
        width: 0.0002,
    },
    Case {
        outer: "min(0.02, 0.012 + 40*abs(x - 0.43337))",
        inner: None,
        radii: |x| [f64::min(0.02, 0.012 + 40.0 * (x - 0.43337).abs()), 0.0],
        at: 0.43337,
        width: 0.0002,
    },
    Case {
        outer: "0.03",
        inner: Some("0.02 + 0.0095*exp(-((x-0.3333)/0.0005)^2)"),
        radii: |x| [0.03, 0.02 + 0.0095 * bell(x, 0.3333, 0.0005)],
        at: 0.3333,
        width: 0.0005,
    },
    Case {
        outer: "0.02 + 0.01*x + 0.0005*sin(1500*x)",
        inner: None,
        radii: |x| [0.02 + 0.01 * x + 0.0005 * (1500.0 * x).sin(), 0.0],
        at: 0.42,
        width: 0.035,
    },
    Case {
        outer: "0.02 + 0.01*x",
        inner: Some("0.01999 + 0.01*x"),
        radii: |x| [0.02 + 0.01 * x, 0.01999 + 0.01 * x],
        at: 0.42,
        width: 0.03,
    },
];

/// Steps of the integration: even ones, and finer ones around the feature.
fn grid(case: &Case) -> Vec<f64> {
    const STEPS: usize = 12_000;
    let near = 12.0 * case.width;
    let even = (0..=STEPS).map(|k| LENGTH * k as f64 / STEPS as f64);
    let fine = (0..=STEPS).map(|k| case.at - near + 2.0 * near * k as f64 / STEPS as f64);
    let mut x: Vec<f64> = even.chain(fine).filter(|x| (0.0..=LENGTH).contains(x)).collect();
    x.sort_by(f64::total_cmp);
    x.dedup();
    x
}

/// Moment and shear force at the tip of the two motions that leave the knob end free, as a
/// determinant: 0 at a natural frequency. `w′ = θ, θ′ = M/EI, M′ = Q, Q′ = ω² ρA w`, by the
/// classical method of fourth order.
fn determinant(case: &Case, grid: &[f64], omega: f64) -> f64 {
    let slope = |x: f64, [w, turn, moment, force]: [f64; 4]| {
        let [r, ri] = (case.radii)(x);
        let area = PI * (r - ri) * (r + ri);
        let bending = MODULUS * area * (r * r + ri * ri) / 4.0;
        [turn, moment / bending, force, omega * omega * DENSITY * area * w]
    };
    let along = |state: [f64; 4], k: [f64; 4], h: f64| [0, 1, 2, 3].map(|i| state[i] + h * k[i]);
    let ends = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0]].map(|mut state| {
        for step in grid.windows(2) {
            let (x, h) = (step[0], step[1] - step[0]);
            let k1 = slope(x, state);
            let k2 = slope(x + 0.5 * h, along(state, k1, 0.5 * h));
            let k3 = slope(x + 0.5 * h, along(state, k2, 0.5 * h));
            let k4 = slope(step[1], along(state, k3, h));
            let mean = [0, 1, 2, 3].map(|i| (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]) / 6.0);
            state = along(state, mean, h);
        }
        state
    });
    ends[0][2] * ends[1][3] - ends[0][3] * ends[1][2]
}

#[test]
fn a_feature_between_the_samples_is_in_every_frequency() {
    for case in &CASES {
        let bat = read(case.outer, case.inner).unwrap();
        let grid = grid(case);
        for tolerance in [1e-2, 1e-4, 1e-8] {
            let request = Request { modes: 4, tolerance, ..Request::plain() };
            let solution = solve(&bat, &request).unwrap();
            assert!(solution.met(), "{} at {tolerance:e}", case.outer);
            for mode in &solution.modes {
                // The error of the reference itself is about 1e-10.
                let error = 3.0 * mode.error.total() + 2e-10;
                let at = |sign: f64| determinant(case, &grid, mode.omega * (1.0 + sign * error));
                let (below, above) = (at(-1.0), at(1.0));
                let hz = mode.omega / TAU;
                assert!(below * above < 0.0, "{}: {hz} Hz within {error:.1e}", case.outer);
            }
        }
    }
}

/// Mass and balance point also include a groove that no sample meets: `∫ρπr² dx` in closed form.
#[test]
fn a_feature_between_the_samples_is_in_the_mass() {
    let (r, d, w) = (0.02, 0.015, 0.0003);
    let bat = read("0.02-0.015*exp(-((x-0.6013)/0.0003)^2)", None).unwrap();
    // ∫(r − d e^{−u²})² w du = r² L − 2 r d w √π + d² w √(π/2).
    let square = r * r * LENGTH - 2.0 * r * d * w * PI.sqrt() + d * d * w * (0.5 * PI).sqrt();
    let mass = DENSITY * PI * square;
    let error = bat.inertia().mass / mass - 1.0;
    assert!(error.abs() < 1e-13, "{error:e}");
}

#[test]
fn a_radius_that_is_below_zero_between_the_samples_is_refused_with_the_place() {
    for (outer, inner, said) in [
        ("0.02-0.0201*exp(-((x-0.4003)/0.00001)^2)", None, "x = 0.400"),
        ("0.03", Some("0.02+0.0101*exp(-((x-0.3007)/0.00002)^2)"), "x = 0.300"),
    ] {
        let refused = read(outer, inner).unwrap_err().to_string();
        assert!(refused.contains(said), "{refused}");
    }
}

/// A wall of equal thickness on a taper: a thin one needs no more elements than a thick one, and answers that differ
/// only in round-off agree within their stated errors.
#[test]
fn a_thin_tapered_wall_takes_as_many_elements_as_a_thick_one() {
    let bat = |wall: f64, interpolation| {
        let outer = vec![0.015, 0.02, 0.033];
        let inner = outer.iter().map(|r| r - wall).collect();
        let x = vec![0.0, 0.3, LENGTH];
        let profile = Profile::new(Stations { x, outer, inner, interpolation }).unwrap();
        let mut material = Material::new(DENSITY, MODULUS).unwrap();
        material.shear_modulus = Some(1e9);
        Bat::builder(profile, material).name("tube").build().unwrap()
    };
    for interpolation in [Interpolation::Linear, Interpolation::Pchip] {
        for wall in [1e-3, 1e-5, 1e-8, 1e-11] {
            let bat = bat(wall, interpolation);
            for tolerance in [1e-2, 1e-8] {
                for theory in [Theory::EulerBernoulli, Theory::Timoshenko] {
                    let request = Request { modes: 4, tolerance, theory, ..Request::default() };
                    let plan = Plan::cheapest(&bat, &wanted(&request));
                    assert!(plan.mesh.len() < 20, "{wall:e} {theory:?}: {}", plan.mesh.len());
                }
            }
            let solved = |tolerance: f64| {
                solve(&bat, &Request { modes: 4, tolerance, ..Request::plain() }).unwrap()
            };
            let [coarse, fine] = [solved(1e-8), solved(1e-12)];
            for (a, b) in coarse.modes.iter().zip(&fine.modes) {
                let (off, stated) = (a.omega / b.omega - 1.0, a.error.total() + b.error.total());
                assert!(off.abs() <= 3.0 * stated, "{wall:e}: {off:e} stated {stated:e}");
            }
        }
    }
}

/// A bat with a pointed end is planned and solved with few elements, whatever the form of the point.
#[test]
fn a_point_at_an_end_takes_few_elements() {
    for outer in ["0.033*x/0.84", "0.03*sqrt(x)", "0.03*sqrt(1-(x/0.84)^2)", "0.03*(x/0.84)^0.3"] {
        let bat = read(outer, None).unwrap();
        let request = Request { modes: 4, tolerance: 1e-6, ..Request::plain() };
        let solution = solve(&bat, &request).unwrap();
        assert!(solution.met() && solution.mesh.len() < 60, "{outer}: {}", solution.mesh.len());
    }
}

/// A step of half a millimetre in straight lines: refinement from coarse elements stalls there, whereas elements
/// planned for a better accuracy do not.
#[test]
fn a_short_step_is_solved_to_every_tolerance() {
    let stations = Stations {
        x: vec![0.0, 0.2, 0.2005, 0.84],
        outer: vec![0.015, 0.013, 0.017, 0.032],
        inner: vec![0.0; 4],
        interpolation: Interpolation::Linear,
    };
    let material = Material::new(DENSITY, MODULUS).unwrap();
    let bat = Bat::builder(Profile::new(stations).unwrap(), material).build().unwrap();
    let solved = |tolerance: f64| {
        let theory = Theory::EulerBernoulli;
        solve(&bat, &Request { modes: 2, tolerance, theory, ..Request::default() }).unwrap()
    };
    let right = solved(1e-11);
    for tolerance in [1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5] {
        let found = solved(tolerance);
        assert!(found.met(), "{tolerance:e}: {:e}", found.worst());
        for (mode, right) in found.modes.iter().zip(&right.modes) {
            let off = (mode.frequency() / right.frequency() - 1.0).abs();
            assert!(
                off <= 3.0 * mode.error.total(),
                "{tolerance:e} {off:e} {:e}",
                mode.error.total()
            );
        }
    }
}
