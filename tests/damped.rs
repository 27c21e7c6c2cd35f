//! Damped bats against values that an independent calculation gives to 16 digits and more.
//!
//! The dowel is [`dowel`]; everything varies as `e^{st}`, and with `Q` the shear force the
//! equations are
//!
//! ```text
//! w′ = θ + Q/κGA,  θ′ = M/EI,  M′ = −Q + s²ρI θ,  Q′ = s²ρA w + (k + s c) w
//! ```
//!
//! (Rayleigh: no Q/κGA; Euler–Bernoulli: no ρI either), free ends, `k` and `c` on the grip only. An
//! absorber is `Q(x+) = Q(x−) + s² m z`, `z = w (k + s c)/(k + s c + s² m)`, a unit force
//! `Q(x+) = Q(x−) − 1`. The values were computed with 60-digit arithmetic by matrix exponentials of
//! the uniform stretches, and again by Taylor series with 80 digits.

use std::f64::consts::TAU;

use faer::c64;
use sweetspot::bat::Weighed;
use sweetspot::damping::Kind;
use sweetspot::fixtures::{Absorber, Attachment, Fixtures, Grip, Held, Support};
use sweetspot::frf::Frf;
use sweetspot::material::Material;
use sweetspot::profile::{Interpolation, Profile, Stations};
use sweetspot::theory::Theory;
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
    Bat::with_fixtures("dowel", profile, material, fixtures, Weighed::default()).unwrap()
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

fn assert_poles(bat: &Bat, theory: Theory, exact: &[[f64; 2]]) {
    let solution = solve(bat, &request(exact.len(), theory)).unwrap();
    assert!(matches!(solution.damping.kind, Kind::Complex(_)), "{}", solution.damping.kind);
    for (damped, [re, im]) in solution.damping.modes.iter().zip(exact) {
        let exact = c64::new(*re, *im);
        let s = c64::new(-damped.decay, damped.swinging());
        let off = (s - exact).norm() / exact.norm();
        println!("{exact} {off:.1e} decay {:.1e} stated {:.1e}", s.re / re - 1.0, damped.error);
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
        (gripped(), plain, 50.0, 4.06903295067804408e-6, -2.31443089070965768e-6),
        (gripped(), plain, 237.0, -8.990452463200138e-6, 2.83536387688559257e-6),
        (gripped(), plain, 500.0, 3.26966820708991183e-7, 1.95038909138548163e-9),
        (free(), plain, 100.0, 1.0027034505556098e-7, 0.0),
        (free(), plain, 400.0, 3.47917354612826755e-7, 0.0),
        (free(), shearing, 100.0, 8.93351765382645911e-8, 0.0),
        (free(), shearing, 400.0, 3.70974187439501949e-7, 0.0),
    ];
    for (fixtures, theory, frequency, re, im) in rows {
        // Two modes for the range do; the rest is left to the static strains.
        for modes in [2, 8] {
            let bat = dowel(fixtures.clone(), 0.0);
            let mut frf = Frf::new(&bat, &request(modes, theory), 0.05, 0.6).unwrap();
            let sample = frf.receptances(&[frequency]).unwrap()[0];
            let exact = c64::new(re, im);
            let off = (sample.receptance - exact).norm();
            println!(
                "{frequency} {modes} {} {:.1e} stated {:.1e}",
                frf.strains(),
                off / exact.norm(),
                sample.truncation / exact.norm()
            );
            assert!(off < 1e-9 * exact.norm(), "{frequency} {modes} {off:e}");
        }
    }
}
