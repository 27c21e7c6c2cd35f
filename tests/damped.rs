//! Damped bats compared with an independent calculation that has 16 digits or more.
//!
//! The dowel is [`dowel`]; everything varies as `e^{st}`, and with `Q` the shear force the
//! equations are
//!
//! ```text
//! w′ = θ + Q/κGA,  θ′ = M/EI,  M′ = −Q + s²ρI θ,  Q′ = s²ρA w + (k + s c) w
//! ```
//!
//! (Rayleigh: no Q/κGA; Euler–Bernoulli: no ρI either) with free ends, and `k` and `c` on the grip only. An absorber is
//! `Q(x+) = Q(x−) + s² m z` with `z = w (k + s c)/(k + s c + s² m)`, a unit force `Q(x+) = Q(x−) − 1`. [`carried`]
//! solves these equations by Taylor series over the uniform stretches and has no code in common with the program. The
//! listed frequencies are shown to be roots of its determinant, and the receptances come from it.

// Values are kept with all their digits.
#![allow(clippy::excessive_precision)]

use std::f64::consts::TAU;

use faer::c64;
use sweetspot::bat::fixtures::{
    Absorber, Attachment, Fixtures, Grip, Held, Joint, Region, Support,
};
use sweetspot::bat::layup::Layup;
use sweetspot::bat::material::Material;
use sweetspot::bat::profile::{Interpolation, Profile, Stations};
use sweetspot::bat::theory::Theory;
use sweetspot::modes::damping::DampingMethod;
use sweetspot::motion::frf::Frf;
use sweetspot::{Bat, Request, solve};

const LENGTH: f64 = 0.8382;
const RADIUS: f64 = 0.02130679;
const DENSITY: f64 = 711.3735510522202;
const MODULUS: f64 = 13927409732.2000899;

fn dowel(fixtures: Fixtures, loss: f64) -> Bat {
    let stations = Stations {
        x: vec![0.0, LENGTH],
        outer: vec![RADIUS; 2],
        inner: vec![0.0; 2],
        interpolation: Interpolation::Linear,
    };
    let mut material = Material::new(DENSITY, MODULUS).unwrap();
    material.shear_modulus = Some(0.93e9);
    material.shear_coefficient = Some(0.9);
    material.loss_factor = loss;
    let profile = Profile::new(stations).unwrap();
    Bat::builder(profile, material).name("dowel").fixtures(fixtures).build().unwrap()
}

fn gripped() -> Fixtures {
    let grip = Grip { from: 0.02, to: 0.2, stiffness: 2e5, damping: 80.0 };
    Fixtures { grip: Some(grip), ..Fixtures::default() }
}

fn absorbing() -> Fixtures {
    let stiffness = 0.03 * (TAU * 230.0).powi(2);
    let absorber = Absorber { x: 0.05, mass: 0.03, stiffness, damping: 6.0 };
    Fixtures { absorbers: vec![absorber], ..Fixtures::default() }
}

fn request(modes: usize, theory: Theory) -> Request {
    Request { modes, tolerance: 1e-12, theory, ..Request::default() }
}

/// `y′ = A y` over a length, by Taylor series of steps no longer than 1.
fn carried<const N: usize>(y: [c64; N], a: &[[c64; N]; N], length: f64) -> [c64; N] {
    let steps = length.ceil().max(1.0);
    let mut y = y;
    for _ in 0..steps as usize {
        let mut term = y;
        for n in 1..40 {
            let h = length / steps / f64::from(n);
            term = std::array::from_fn(|i| (0..N).map(|j| a[i][j] * term[j]).sum::<c64>() * h);
            y = std::array::from_fn(|i| y[i] + term[i]);
        }
    }
    y
}

/// A matrix of `(w, θ, M, Q)` and the length over which it applies, in units of `1/β` (length) and `EI β` (moments), so
/// that no entry is far above 1. A jump is a matrix over a length of 1.
type Stretch = ([[c64; 4]; 4], f64);

fn bending() -> f64 {
    MODULUS * std::f64::consts::PI * RADIUS.powi(4) / 4.0
}

/// From one place to another; absorbers at the first place are passed.
fn stretches(
    fixtures: &Fixtures,
    theory: Theory,
    s: c64,
    beta: f64,
    range: [f64; 2],
) -> Vec<Stretch> {
    let [one, zero] = [1.0, 0.0].map(|value| c64::new(value, 0.0));
    let area = std::f64::consts::PI * RADIUS.powi(2);
    let slender = RADIUS.powi(2) / 4.0 * beta * beta;
    let [mut shear, mut turning] = [zero; 2];
    if theory.shears() {
        shear = one * (MODULUS / (0.9 * 0.93e9) * slender);
    }
    if theory.turns() {
        turning = s * s * (DENSITY / (MODULUS * beta * beta));
    }
    let mut cuts = range.to_vec();
    cuts.extend(fixtures.grip.iter().flat_map(|grip| [grip.from, grip.to]));
    cuts.extend(fixtures.absorbers.iter().map(|absorber| absorber.x));
    cuts.retain(|x| *x >= range[0] && *x <= range[1]);
    cuts.sort_by(f64::total_cmp);
    cuts.dedup();
    let mut all = vec![];
    for cut in cuts.windows(2) {
        for a in fixtures.absorbers.iter().filter(|a| a.x == cut[0]) {
            let spring = s * a.damping + a.stiffness;
            let force = s * s * a.mass * spring / (spring + s * s * a.mass);
            let mut jump = [[zero; 4]; 4];
            jump[3][0] = force / (bending() * beta.powi(3));
            all.push((jump, 1.0));
        }
        let middle = 0.5 * (cut[0] + cut[1]);
        let held = fixtures.grip.iter().filter(|grip| grip.from < middle && middle < grip.to);
        let bed: c64 = held.map(|grip| s * grip.damping + grip.stiffness).sum();
        let line = (s * s * (DENSITY * area) + bed) / (bending() * beta.powi(4));
        let rows = [[zero, one, zero, shear], [zero, zero, one, zero]];
        let rest = [[zero, turning, zero, -one], [line, zero, zero, zero]];
        all.push(([rows[0], rows[1], rest[0], rest[1]], beta * (cut[1] - cut[0])));
    }
    all
}

/// A typical wave number (1/m) at that s.
fn wave_number(fixtures: &Fixtures, s: c64) -> f64 {
    let bed = fixtures.grip.as_ref().map_or(0.0, |g| (s * g.damping + g.stiffness).norm());
    let line = DENSITY * std::f64::consts::PI * RADIUS.powi(2);
    ((line * s.norm_sqr() + bed) / bending()).powf(0.25)
}

/// Pairs of `(w, θ, M, Q)`, for which two solutions form minors.
const PAIRS: [[usize; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];

/// The matrix that propagates the minors `y_ij`: `y_ij′ = Σ_k a_ik y_kj + a_jk y_ik`. The determinant of the free ends
/// is one of them, and no digits are lost in a difference of large products.
fn of_minors(a: &[[c64; 4]; 4]) -> [[c64; 6]; 6] {
    let mut minors = [[c64::new(0.0, 0.0); 6]; 6];
    for (row, [i, j]) in minors.iter_mut().zip(PAIRS) {
        let mut add = |m: usize, n: usize, value: c64| {
            let sign = if m < n { 1.0 } else { -1.0 };
            let place = PAIRS.iter().position(|pair| *pair == [m.min(n), m.max(n)]);
            place.into_iter().for_each(|place| row[place] += value * sign);
        };
        for (k, (of_i, of_j)) in a[i].iter().zip(&a[j]).enumerate() {
            add(k, j, *of_i);
            add(i, k, *of_j);
        }
    }
    minors
}

/// The Newton step of `s` towards a root of the determinant of the free ends.
fn missed(fixtures: &Fixtures, theory: Theory, s: c64) -> f64 {
    let beta = wave_number(fixtures, s);
    let determinant = |s: c64| {
        let mut minors = [c64::new(0.0, 0.0); 6];
        minors[0] = c64::new(1.0, 0.0);
        for (a, length) in stretches(fixtures, theory, s, beta, [0.0, LENGTH]) {
            minors = carried(minors, &of_minors(&a), length);
        }
        minors[5]
    };
    let h = s * 1e-5;
    let slope = (determinant(s + h) - determinant(s - h)) / (h * 2.0);
    (determinant(s) / slope).norm() / s.norm()
}

/// `w` at `to` (m) under a unit force `e^{iωt}` at `from`, before it; both ends free.
fn receptance(fixtures: &Fixtures, theory: Theory, frequency: f64, [from, to]: [f64; 2]) -> c64 {
    let s = c64::new(0.0, TAU * frequency);
    let beta = wave_number(fixtures, s);
    let [one, zero] = [1.0, 0.0].map(|value| c64::new(value, 0.0));
    let along = |y: [c64; 4], range: [f64; 2]| {
        let all = stretches(fixtures, theory, s, beta, range);
        all.iter().fold(y, |y, (a, length)| carried(y, a, *length))
    };
    // Two motions of the free knob end, and that of the force alone, at `to` and at the tip.
    let free = [[one, zero, zero, zero], [zero, one, zero, zero]].map(|y| along(y, [0.0, from]));
    let forced = [zero, zero, zero, -one / (bending() * beta * beta)];
    let all = [free[0], free[1], forced].map(|y| {
        let there = along(y, [from, to]);
        (there[0], along(there, [to, LENGTH]))
    });
    let [(a, u), (b, v), (c, f)] = all;
    let det = u[2] * v[3] - u[3] * v[2];
    let [p, q] = [v[2] * f[3] - v[3] * f[2], u[3] * f[2] - u[2] * f[3]].map(|part| part / det);
    (a * p + b * q + c) / beta
}

fn assert_poles(bat: &Bat, theory: Theory, exact: &[[f64; 2]]) {
    let solution = solve(bat, &request(exact.len(), theory)).unwrap();
    assert!(
        matches!(solution.damping.kind, DampingMethod::Complex(_)),
        "{}",
        solution.damping.kind
    );
    for (damped, [re, im]) in solution.damping.modes.iter().zip(exact) {
        let exact = c64::new(*re, *im);
        let root = missed(bat.fixtures(), theory, exact);
        assert!(root < 1e-11, "{exact} is no root: {root:e}");
        let s = c64::new(-damped.decay, damped.swinging());
        let off = (s - exact).norm() / exact.norm();
        assert!(off < 1e-10, "{exact} {off:e}");
    }
}

#[test]
fn a_grip_of_springs_and_dashpots_has_the_exact_complex_frequencies() {
    let exact = [
        [-0.144930298176688742, 27.0028554258844563],
        [-21.8692561224251603, 332.491527418997405],
        [-8.67880244529556365, 1514.72870822804727],
        [-5.67209606255459842, 4141.24316029216599],
        [-7.70918939792507465, 8114.17049320513348],
        [-7.97887838657578303, 13410.6931593190127],
        [-6.48725235364161354, 20031.8662824119406],
        [-6.23310020900442876, 27977.8329490872032],
        [-7.5588429399246881, 37248.3634727449853],
    ];
    assert_poles(&dowel(gripped(), 0.0), Theory::EulerBernoulli, &exact);
}

#[test]
fn a_tuned_absorber_has_the_exact_complex_frequencies() {
    let exact = [
        [-33.1249761862658236, 1332.10217097146416],
        [-84.2861703363346762, 1706.46313909413174],
        [-5.35601482461447426, 4113.19546244954074],
        [-1.7803172596398727, 7994.20138271070713],
        [-0.379219437937404493, 13111.3045795969636],
        [-0.000750600962465468099, 19410.1608068402826],
    ];
    assert_poles(&dowel(absorbing(), 0.0), Theory::Rayleigh, &exact);
}

#[test]
fn receptances_are_the_exact_ones() {
    let free = Fixtures::default;
    let [plain, shearing] = [Theory::EulerBernoulli, Theory::Timoshenko];
    let rows = [
        (gripped(), plain, 50.0),
        (gripped(), plain, 237.0),
        (gripped(), plain, 500.0),
        (free(), plain, 100.0),
        (free(), plain, 400.0),
        (free(), shearing, 100.0),
        (free(), shearing, 400.0),
        (absorbing(), shearing, 237.0),
    ];
    for (fixtures, theory, frequency) in rows {
        let exact = receptance(&fixtures, theory, frequency, [0.05, 0.6]);
        // Two modes are sufficient for the range; the static strains account for the others.
        for modes in [2, 8] {
            let bat = dowel(fixtures.clone(), 0.0);
            let mut frf = Frf::new(&bat, &request(modes, theory), 0.05, 0.6).unwrap();
            let sample = frf.receptances(&[frequency]).unwrap()[0];
            let off = (sample.receptance - exact).norm();
            assert!(off < 1e-9 * exact.norm(), "{frequency} {modes} {off:e}");
        }
    }
}

/// Everything at once: pin, weight, spring, absorber, joint, hands, lossy regions.
fn crowded() -> Fixtures {
    let weight = Attachment {
        x: 0.8,
        mass: 0.1,
        offset: 0.02,
        rotary_inertia: 1e-4,
        stiffness: 3e3,
        rotational_stiffness: 0.0,
    };
    let mut lossy = dowel(Fixtures::default(), 0.2).material().clone();
    lossy.youngs_modulus *= 0.7;
    Fixtures {
        regions: vec![Region { from: 0.5, to: 0.7, layup: Layup::of(lossy) }],
        attachments: vec![weight],
        joints: vec![Joint { x: 0.4, rotational_stiffness: 5e3 }],
        supports: vec![Support { x: 0.25, kind: Held::Pinned }],
        ..Fixtures { grip: gripped().grip, ..absorbing() }
    }
}

/// Maxwell and Betti: forced point and watched point may change places.
#[test]
fn responses_are_reciprocal() {
    let [a, b] = [0.61, 0.13];
    let only_dashpots = Grip { stiffness: 0.0, ..gripped().grip.unwrap() };
    let hands = Fixtures { grip: Some(only_dashpots), ..absorbing() };
    for (fixtures, theory) in [
        (Fixtures::default(), Theory::EulerBernoulli),
        (crowded(), Theory::Rayleigh),
        (crowded(), Theory::Timoshenko),
        (hands, Theory::Timoshenko),
    ] {
        let bat = dowel(fixtures, 0.01);
        let request = Request { tolerance: 1e-9, ..request(4, theory) };
        let frequencies = [3.0, 120.0, 231.0, 900.0];
        let there = Frf::new(&bat, &request, a, b).unwrap().receptances(&frequencies).unwrap();
        let back = Frf::new(&bat, &request, b, a).unwrap().receptances(&frequencies).unwrap();
        for (there, back) in there.iter().zip(back) {
            let off = (there.receptance - back.receptance).norm();
            // Each is as accurate as its neglected terms allow, on the scale of the points.
            assert!(off < 1e-11 * there.receptance.norm().max(1e-6), "{theory:?} {off:e}");
        }
    }
}

/// The textbook deflections: `L³/48EI + L/4κGA` in the middle between two pins; `L³/3EI + L/κGA` at the tip of a
/// cantilever; and for a free dowel forced at its tip, whose moment is `Lξ²(1 − ξ)` in equilibrium with its inertia,
/// `L³/105EI` there and `L³/140EI` at the other end.
#[test]
fn the_elastic_response_at_0_hz_is_the_static_deflection() {
    let held = |supports: &[(f64, Held)]| {
        let supports = supports.iter().map(|(x, kind)| Support { x: *x, kind: *kind }).collect();
        dowel(Fixtures { supports, ..Fixtures::default() }, 0.0)
    };
    let second = std::f64::consts::PI * RADIUS.powi(4) / 4.0;
    let bending = LENGTH.powi(3) / (MODULUS * second);
    let shear = LENGTH / (0.9 * 0.93e9 * std::f64::consts::PI * RADIUS.powi(2));
    let pins = held(&[(0.0, Held::Pinned), (LENGTH, Held::Pinned)]);
    let clamped = held(&[(0.0, Held::Clamped)]);
    let free = held(&[]);
    let [plain, shearing] = [Theory::EulerBernoulli, Theory::Timoshenko];
    let (middle, tip) = (0.5 * LENGTH, LENGTH);
    for (bat, theory, [at, to], exact) in [
        (&pins, plain, [middle, middle], bending / 48.0),
        (&pins, Theory::Rayleigh, [middle, middle], bending / 48.0),
        (&pins, shearing, [middle, middle], bending / 48.0 + shear / 4.0),
        (&clamped, plain, [tip, tip], bending / 3.0),
        (&clamped, shearing, [tip, tip], bending / 3.0 + shear),
        (&clamped, plain, [tip, middle], bending * 5.0 / 48.0),
        (&free, plain, [tip, tip], bending / 105.0),
        (&free, plain, [tip, 0.0], bending / 140.0),
    ] {
        let frf = Frf::new(bat, &request(3, theory), at, to).unwrap();
        let close = |value: f64| assert!((value / exact - 1.0).abs() < 1e-10, "{theory:?} {value}");
        close(frf.static_compliance());
        close(frf.strained(0.0).re);
        assert_eq!(frf.strained(0.0).im, 0.0);
        // The sum of the modes approaches it, from below if the response is at the forced point.
        let share: f64 = solve(bat, &request(60, theory))
            .unwrap()
            .modes
            .iter()
            .map(|m| {
                let w = |x: f64| m.shape.deflection(x);
                w(at) * w(to) / (m.modal_mass * m.omega * m.omega)
            })
            .sum();
        // The terms fall as n⁻⁴, with shear as n⁻², which leaves 1/(3 · 60³) and 1/60 beyond 60.
        let left = if theory.shears() { 2e-2 } else { 2e-5 };
        assert!((share / exact - 1.0).abs() < left, "{theory:?} {share} {exact}");
    }
}

/// The tip's own receptance of a free uniform beam, `−F₅/(EI λ³ F₃)` with `F₃ = cos λL cosh λL − 1`,
/// `F₅ = cos λL sinh λL − sin λL cosh λL` (R. E. D. Bishop, D. C. Johnson, The Mechanics of Vibration, 1960); with
/// losses λ and EI are complex.
fn at_the_tip(frequency: f64, loss: f64, bed: [f64; 2]) -> c64 {
    let omega = TAU * frequency;
    let area = std::f64::consts::PI * RADIUS.powi(2);
    let stiffness = c64::new(1.0, loss) * (MODULUS * area * RADIUS.powi(2) / 4.0);
    let line = c64::new(DENSITY * area * omega * omega - bed[0], -omega * bed[1]);
    let lambda = (line / stiffness).powf(0.25);
    let x = lambda * LENGTH;
    let f3 = x.cos() * x.cosh() - 1.0;
    let f5 = x.cos() * x.sinh() - x.sin() * x.cosh();
    -f5 / (stiffness * lambda.powu(3) * f3)
}

#[test]
fn uniform_losses_answer_as_the_closed_form_does() {
    let grip = |[stiffness, damping]: [f64; 2]| {
        let grip = Grip { from: 0.0, to: LENGTH, stiffness, damping };
        Fixtures {
            grip: Some(grip).filter(|g| g.stiffness + g.damping > 0.0),
            ..Fixtures::default()
        }
    };
    let rows = [(0.0, [0.0; 2]), (0.02, [0.0; 2]), (0.5, [0.0; 2]), (0.0, [0.0, 200.0])];
    for (loss, bed) in rows.into_iter().chain([(0.0, [4e5, 200.0]), (0.1, [4e5, 2e4])]) {
        let bat = dowel(grip(bed), loss);
        let request = request(4, Theory::EulerBernoulli);
        let mut frf = Frf::new(&bat, &request, LENGTH, LENGTH).unwrap();
        for sample in frf.receptances(&[20.0, 237.0, 240.0, 700.0, 1500.0]).unwrap() {
            let exact = at_the_tip(sample.frequency, loss, bed);
            let off = (sample.receptance - exact).norm() / exact.norm();
            assert!(off < 1e-9, "{loss} {bed:?} {} {off:e}", sample.frequency);
        }
    }
}

/// Hands over the whole dowel damp all motions equally: `2 Re s = −c/ρA`, `|s|² = ω² + k/ρA`. With dashpots alone the
/// rigid motion decays at `c/ρA`, and strong ones make slow modes overdamped.
#[test]
fn hands_all_over_have_the_closed_form() {
    let area = std::f64::consts::PI * RADIUS.powi(2);
    let line = DENSITY * area;
    let free =
        solve(&dowel(Fixtures::default(), 0.0), &request(4, Theory::EulerBernoulli)).unwrap();
    let bending: Vec<f64> = free.modes.iter().map(|mode| mode.omega).collect();
    for (stiffness, rate) in [(0.0, 30.0), (0.0, 4000.0), (3e5, 30.0), (3e5, 4000.0)] {
        let grip = Grip { from: 0.0, to: LENGTH, stiffness, damping: rate * line };
        let bat = dowel(Fixtures { grip: Some(grip), ..Fixtures::default() }, 0.0);
        let rigid = if stiffness > 0.0 { 2 } else { 0 };
        let solution = solve(&bat, &request(4 + rigid, Theory::EulerBernoulli)).unwrap();
        let all = vec![0.0; rigid].into_iter().chain(bending.iter().copied());
        let mut modes: Vec<_> = solution.damping.modes.iter().collect();
        assert_eq!(modes.len(), 4 + rigid);
        for (mode, omega) in modes.drain(..).zip(all) {
            let natural = (omega * omega + stiffness / line).sqrt();
            assert!((mode.natural / natural - 1.0).abs() < 1e-10, "{} {natural}", mode.natural);
            let ratio = 0.5 * rate / natural;
            assert!((mode.ratio / ratio - 1.0).abs() < 1e-9, "{} {ratio}", mode.ratio);
            let swing = natural * (1.0 - ratio * ratio).max(0.0).sqrt();
            assert!((mode.swinging() - swing).abs() < 1e-8 * natural);
            let slow = match ratio > 1.0 {
                true => natural * (ratio - (ratio * ratio - 1.0).sqrt()),
                false => 0.5 * rate,
            };
            assert!((mode.decay / slow - 1.0).abs() < 1e-8, "{} {slow}", mode.decay);
        }
        assert_eq!(solution.damping.rigid.len(), 2 - rigid);
        for decay in &solution.damping.rigid {
            assert!((decay / rate - 1.0).abs() < 1e-9, "{decay}");
        }
    }
}

#[test]
fn loss_factors_are_weighted_with_strain_energies() {
    let ratios = |bat: &Bat, theory: Theory| -> Vec<f64> {
        let solution = solve(bat, &request(5, theory)).unwrap();
        assert_eq!(solution.damping.kind, DampingMethod::Materials);
        for (mode, damped) in solution.modes.iter().zip(&solution.damping.modes) {
            assert!((damped.natural / mode.omega - 1.0).abs() < 1e-12);
        }
        solution.damping.modes.iter().map(|mode| mode.ratio).collect()
    };
    let all = |ratios: Vec<f64>, exact: f64| {
        assert_eq!(ratios.len(), 5);
        ratios.iter().for_each(|ratio| assert!((ratio / exact - 1.0).abs() < 1e-9, "{ratio}"));
    };
    // With one material the ratio is exactly half its loss factor, and springs take a share of it.
    assert_eq!(ratios(&dowel(Fixtures::default(), 0.03), Theory::Timoshenko), vec![0.015; 5]);
    let joint = Joint { x: 0.3, rotational_stiffness: 2e3 };
    let joined = dowel(Fixtures { joints: vec![joint], ..Fixtures::default() }, 0.03);
    let held = ratios(&joined, Theory::Timoshenko);
    assert!(held.iter().all(|ratio| *ratio < 0.015) && held.iter().any(|ratio| *ratio < 0.012));
    // Half of the dowel has losses, and half of the energy of every mode.
    let lossy =
        Material { loss_factor: 0.08, ..dowel(Fixtures::default(), 0.0).material().clone() };
    let half = Region { from: 0.0, to: 0.5 * LENGTH, layup: Layup::of(lossy.clone()) };
    let half = Fixtures { regions: vec![half], ..Fixtures::default() };
    for theory in Theory::ALL {
        all(ratios(&dowel(half.clone(), 0.0), theory), 0.02);
    }
    // A core with losses: its share of EI, the same for every mode of a beam without shear.
    let stations = Stations {
        x: vec![0.0, LENGTH],
        outer: vec![RADIUS; 2],
        inner: vec![0.5 * RADIUS; 2],
        interpolation: Interpolation::Linear,
    };
    let outer = dowel(Fixtures::default(), 0.0).material().clone();
    let core = Region {
        from: 0.0,
        to: LENGTH,
        layup: Layup { core: Some(lossy.clone()), ..Layup::of(outer.clone()) },
    };
    let fixtures = Fixtures { regions: vec![core], ..Fixtures::default() };
    let profile = Profile::new(stations).unwrap();
    let filled = Bat::builder(profile, outer).name("filled").fixtures(fixtures).build().unwrap();
    all(ratios(&filled, Theory::EulerBernoulli), 0.04 / 16.0);
}

/// The loss in shear is proportional to the shear part of the strain energy, which follows from the frequency by
/// Rayleigh's quotient: `U_shear/U = 2 d ln ω/d ln G`. On a dowel, and under a sleeve of another material without loss.
#[test]
fn a_loss_in_shear_meets_the_strain_energy_of_shear_alone() {
    let sleeve = Region {
        from: 0.0,
        to: 0.3,
        layup: Layup {
            core: Some(Material { shear_modulus: Some(2e9), ..Material::new(300.0, 5e9).unwrap() }),
            ..Layup::of(dowel(Fixtures::default(), 0.0).material().clone())
        },
    };
    for regions in [vec![], vec![sleeve]] {
        let bat = dowel(Fixtures { regions, ..Fixtures::default() }, 0.0);
        let modes = |change: &dyn Fn(&mut Material)| {
            let changed = bat.with(|parts| {
                change(&mut parts.material);
                parts
                    .fixtures
                    .regions
                    .iter_mut()
                    .for_each(|region| change(&mut region.layup.outer));
            });
            let request = Request { tolerance: 1e-11, ..request(4, Theory::Timoshenko) };
            solve(&changed.unwrap(), &request).unwrap()
        };
        let stiffer = |by: f64| {
            modes(&|m: &mut Material| m.shear_modulus = m.shear_modulus.map(|g| g * by)).modes
        };
        let [softer, stiffer] = [stiffer(0.999), stiffer(1.001)];
        let [bent, sheared, both] =
            [(0.01, 0.0), (0.0, 0.04), (0.01, 0.04)].map(|(bent, sheared)| {
                let lossy = modes(&|m: &mut Material| {
                    (m.loss_factor, m.shear_loss_factor) = (bent, Some(sheared));
                });
                lossy.damping.modes
            });
        for k in 0..4 {
            let slope = (stiffer[k].omega / softer[k].omega).ln() / (1.001_f64 / 0.999).ln();
            let found = sheared[k].ratio;
            assert!((found / (0.04 * slope) - 1.0).abs() < 1e-4, "{k}: {found} {}", 0.04 * slope);
            assert!((both[k].ratio / (bent[k].ratio + found) - 1.0).abs() < 1e-9, "{k}");
        }
    }
}

/// Negligible dashpots leave the modes unchanged, and the answer says so.
#[test]
fn complex_modes_are_used_where_they_matter() {
    let kind = |damping: f64, tolerance: f64| {
        let grip = Grip { damping, ..gripped().grip.unwrap() };
        let bat = dowel(Fixtures { grip: Some(grip), ..Fixtures::default() }, 0.0);
        let request = Request { tolerance, ..request(4, Theory::EulerBernoulli) };
        solve(&bat, &request).unwrap().damping
    };
    let (weak, strong) = (kind(1.0, 1e-3), kind(300.0, 1e-3));
    assert!(matches!(weak.kind, DampingMethod::Modal(change) if change < 1e-3));
    assert!(matches!(strong.kind, DampingMethod::Complex(change) if change > 1e-3));
    // Weak dashpots by both ways: the damping ratios differ by the squares only.
    let fine = kind(1.0, 1e-9);
    assert!(matches!(fine.kind, DampingMethod::Complex(_)));
    for (a, b) in weak.modes.iter().zip(&fine.modes) {
        assert!(
            (a.ratio / b.ratio - 1.0).abs() < 1e-2 && (a.natural / b.natural - 1.0).abs() < 1e-5
        );
    }
    // The amplitude falls as e^{−ωt/Q} with the one, and in ωt/2Q with the other.
    for mode in &strong.modes {
        let [amplitude, half] = [mode.q_amplitude().unwrap(), mode.q_half_power().unwrap()];
        assert!((mode.natural / amplitude / mode.decay - 1.0).abs() < 1e-12);
        assert!((amplitude / half - 2.0).abs() < 1e-15);
    }
}

/// Hands from weak to immovable: the stated errors of a coarse answer are correct compared with a fine one, and it is
/// as accurate as requested.
#[test]
fn damped_motions_are_as_accurate_as_they_say() {
    for damping in [30.0, 300.0, 3e3, 3e4, 1e6, 1e7] {
        let grip = Grip { from: 0.0, to: 0.15, stiffness: 3e4, damping };
        let bat = dowel(Fixtures { grip: Some(grip), ..Fixtures::default() }, 0.0);
        for theory in [Theory::EulerBernoulli, Theory::Timoshenko] {
            let solved = |tolerance: f64| {
                let request = Request { modes: 5, tolerance, theory, ..Request::default() };
                solve(&bat, &request).unwrap()
            };
            let fine = solved(1e-9);
            for tolerance in [1e-2, 1e-4, 1e-6] {
                let coarse = solved(tolerance);
                // Hands as stiff as a vice are solved as well as possible, and the answer says so.
                let met = coarse.damping.modes.iter().all(|damped| damped.error <= tolerance);
                assert_eq!(coarse.met(), met, "{damping} {theory:?} {tolerance}");
                assert!(met || damping > 1e5, "{damping} {theory:?} {:?}", coarse.ending);
                for (a, b) in coarse.damping.modes.iter().zip(&fine.damping.modes) {
                    let s =
                        |d: &sweetspot::modes::damping::Damped| c64::new(-d.decay, d.swinging());
                    let missed = (s(a) - s(b)).norm() / b.natural;
                    // For two real ones the slower is compared, whose part in |s| is small.
                    let stated = 3.0 * (a.error + b.error);
                    assert!(missed <= stated, "{damping} {theory:?} {tolerance}: {a:?} {b:?}");
                }
            }
        }
    }
}

/// Two coalescing motions: an absorber at the knob end of a rod whose two slowest damped motions differ by 3e-8
/// relative, so that they depend on the square root of every error. Then soft hands with much damping, compared with
/// which every other mode is a million times as stiff. The poles are those of the transfer matrices, to 60 digits.
#[test]
fn damped_motions_that_coalesce_and_those_on_soft_hands_are_as_accurate_as_they_say() {
    let solved = |text: &str, modes: usize, tolerance: f64| {
        let bat = Bat::from_text("bat.json", text, std::path::Path::new("")).unwrap();
        let request = Request { modes, tolerance, theory: Theory::Timoshenko, ..Request::plain() };
        solve(&bat, &request).unwrap().damping.modes
    };
    let near = |damped: &sweetspot::modes::damping::Damped, poles: &[[f64; 2]]| {
        let s = c64::new(-damped.decay, damped.swinging());
        let off = |[re, hertz]: &[f64; 2]| (s - c64::new(*re, TAU * hertz)).norm() / s.norm();
        let off = poles.iter().map(off).fold(f64::INFINITY, f64::min);
        assert!(off <= 3.0 * damped.error, "{off:.1e} {:.1e} {damped:?}", damped.error);
    };
    let rod = r#"{ "format": "sweetspot-bat/1", "name": "ep", "material": { "density": 700, "youngs_modulus": 15e9,
        "shear_modulus": 1e9 }, "profile": { "interpolation": "constant", "x": [0.0, 0.84], "radius": [0.02, 0.02] },
        "absorbers": [ { "x": 0.0, "mass": 0.02, "frequency": 200.01991447146875, "damping": 14.527916735491484 } ] }"#;
    let twins =
        [[-213.890702170333219, 216.601384338077636], [-213.890696249789296, 216.601385100450731]];
    let soft = r#"{ "format": "sweetspot-bat/1", "name": "d", "material": { "density": 700, "youngs_modulus": 15e9,
        "shear_modulus": 1e9 }, "profile": { "interpolation": "constant", "x": [0.0, 0.134, 0.508, 0.84],
        "radius": [0.025680785139291375, 0.017669074919590726, 0.02910520255933864, 0.02910520255933864] },
        "absorbers": [ { "x": 0.84, "mass": 0.001203269908401631, "frequency": 34.608537902720705,
        "damping": 0.0041354236090741636 } ],
        "grip": { "from": 0, "to": 0.15, "stiffness": 129.53218794042908, "damping": 42.44480512322181 } }"#;
    let poles = [
        [-1.72888942205527001, 34.6625143249529714],
        [-3.84573814402683412, 175.160016841758311],
        [-2.83928678453244107, 576.258396688811974],
        [-3.05387225952746868, 1209.94859469678055],
    ];
    for tolerance in [1e-6, 1e-9, 1e-10, 1e-12] {
        solved(rod, 2, tolerance).iter().for_each(|damped| near(damped, &twins));
        solved(soft, 6, tolerance)[2..].iter().for_each(|damped| near(damped, &poles));
    }
}
