//! Sections, norms and conclusions, each compared with known values.

use std::f64::consts::TAU;

use sweetspot::base::interval::Interval;
use sweetspot::bat::fixtures::{Absorber, Attachment, Fixtures, Grip, Held, Joint, Support};
use sweetspot::bat::profile::{Interpolation, Stations};
use sweetspot::{Bat, Material, Profile, Theory};
use sweetspot_proof::bundled::bundled_bat;
use sweetspot_proof::enclosure::beam::{Layout, Proven};
use sweetspot_proof::enclosure::conclude::conclude;
use sweetspot_proof::enclosure::energies::Energies;
use sweetspot_proof::enclosure::norms::Norms;
use sweetspot_proof::enclosure::radii::curved;
use sweetspot_proof::enclosure::sections::{Rings, inverse};
use sweetspot_proof::gauss::{GAUSS_24, GAUSS_40};
use sweetspot_proof::series::Values;
use sweetspot_proof::validation::Truth;

use crate::arithmetic;
use crate::common::{DENSITY, LENGTH, MODULUS, RADIUS, cone, dowel};
use crate::twofold::{self, Twofold};

fn norms(bat: &Bat, theory: Theory) -> Norms {
    Norms::of(bat, &Layout::of(bat, theory).unwrap(), theory).unwrap()
}

/// `trace = ρA L⁴/420 EI`, `|T|² = (1/420² − 2/1247400)(ρA L⁴/EI)²` of the uniform beam.
#[test]
fn norms_of_the_uniform_bat_are_those_in_closed_form() {
    let found = norms(&dowel(), Theory::EulerBernoulli);
    let unit = 4.0 * DENSITY * LENGTH.powi(4) / (MODULUS * RADIUS * RADIUS);
    let exact = [unit / 420.0, (1.0 / (420.0 * 420.0) - 2.0 / 1_247_400.0) * unit * unit];
    for (found, exact) in [found.trace, found.square].into_iter().zip(exact) {
        let above = found / exact - 1.0;
        assert!((-1e-14..1e-10).contains(&above), "{above:e}");
    }
    // With rotary inertia and shear the norms rise, in step with the frequencies' fall.
    let mut wood = sweetspot::Material::new(DENSITY, MODULUS).unwrap();
    wood.shear_modulus = Some(1e9);
    let sheared = dowel().with(|parts| parts.material = wood).unwrap();
    let all = Theory::ALL.map(|theory| norms(&sheared, theory).trace);
    assert!(all[0] < all[1] && all[1] < all[2]);
}

/// A contact at a share of the length: whether it restrains the rotation, and its softness in units of L³/EI or L/EI.
type Hold = (f64, bool, f64);

/// The dowel with these contacts, divided at their places.
fn held_dowel(holds: &[Hold]) -> Bat {
    let stiff = MODULUS * std::f64::consts::PI * RADIUS.powi(4) / 4.0;
    let mut fixtures = Fixtures::default();
    for (share, turning, soft) in holds {
        let x = LENGTH * share;
        let bare = Attachment { x, ..Attachment::default() };
        match (*turning, *soft == 0.0) {
            (false, true) => {
                let clamped = holds.iter().any(|other| other == &(*share, true, 0.0));
                let kind = if clamped { Held::Clamped } else { Held::Pinned };
                fixtures.supports.push(Support { x, kind });
            }
            (true, true) => {}
            (false, false) => {
                let stiffness = stiff / LENGTH.powi(3) / soft;
                fixtures.attachments.push(Attachment { stiffness, ..bare });
            }
            (true, false) => {
                let rotational_stiffness = stiff / LENGTH / soft;
                fixtures.attachments.push(Attachment { rotational_stiffness, ..bare });
            }
        }
    }
    dowel().with(|parts| parts.fixtures = fixtures).unwrap()
}

/// Trace and square of the norm in units of ρA L⁴/EI, as exact fractions: for supports these are sums over the
/// roots of the textbook's frequency equations (pinned: `Σ(nπ)⁻⁴ = 1/90`, `Σ(nπ)⁻⁸ = 1/9450`), for springs the
/// integrals of Green's function in rational numbers.
#[test]
fn norms_of_the_held_uniform_bat_are_those_in_closed_form() {
    let third = (0.7_f64.powi(4) + 0.3_f64.powi(4)) / 12.0;
    let thirds = (0.7_f64.powi(8) + 0.3_f64.powi(8)) * 11.0 / 1680.0;
    let free = [1.0 / 420.0, 1.0 / (420.0 * 420.0) - 2.0 / 1_247_400.0];
    let springs = [1951.0 / 10_332.0, 152_096_129.0 / 5_871_262_320.0];
    let mixed = [23_225.0 / 2_896_896.0, 323_084_929_169.0 / 9_692_767_432_212_480.0];
    let all: [(&[Hold], [f64; 2]); 6] = [
        (&[(0.0, false, 0.0), (1.0, false, 0.0)], [1.0 / 90.0, 1.0 / 9450.0]),
        (&[(0.0, false, 0.0), (0.0, true, 0.0)], [1.0 / 12.0, 11.0 / 1680.0]),
        (&[(0.3, false, 0.0), (0.3, true, 0.0)], [third, thirds]),
        // A bat clamped at both ends has the frequencies of the free one.
        (&[(0.0, false, 0.0), (0.0, true, 0.0), (1.0, false, 0.0), (1.0, true, 0.0)], free),
        (&[(0.0, false, 0.5), (1.0, false, 0.2), (1.0, true, 1.0 / 3.0)], springs),
        (&[(0.25, false, 0.0), (0.75, false, 0.01), (0.5, true, 1.0 / 7.0)], mixed),
    ];
    let unit = 4.0 * DENSITY * LENGTH.powi(4) / (MODULUS * RADIUS * RADIUS);
    for (holds, [trace, square]) in all {
        let found = norms(&held_dowel(holds), Theory::EulerBernoulli);
        let exact = [trace * unit, square * unit * unit];
        for (found, exact) in [found.trace, found.square].into_iter().zip(exact) {
            let above = found / exact - 1.0;
            // More contacts remove more of the norm of the free bat and leave its rounding.
            let most = if holds.len() > 3 { 1e-6 } else { 1e-8 };
            assert!((-1e-13..most).contains(&above), "{holds:?} {above:e}");
        }
    }
}

/// Trace and square of the norm in units of ρA L⁴/EI for uniform bats with compliant parts, by Green's functions in
/// rational numbers: a joint in the middle of the free and of the clamped bat; a mass on a spring, in the middle of the
/// free bat next to the same mass without a spring, and at the tip of the clamped one.
#[test]
fn norms_of_uniform_bats_that_give_way_are_those_in_closed_form() {
    let stiff = MODULUS * std::f64::consts::PI * RADIUS.powi(4) / 4.0;
    let weight = DENSITY * std::f64::consts::PI * RADIUS * RADIUS * LENGTH;
    let joint = |share: f64, soft: f64| Fixtures {
        joints: vec![Joint { x: share * LENGTH, rotational_stiffness: stiff / LENGTH / soft }],
        ..Fixtures::default()
    };
    let hung = |share: f64, mass: f64, soft: f64| Fixtures {
        absorbers: vec![Absorber {
            x: share * LENGTH,
            mass: mass * weight,
            stiffness: stiff / LENGTH.powi(3) / soft,
            damping: 0.0,
        }],
        ..Fixtures::default()
    };
    let clamped = |fixtures: Fixtures| Fixtures {
        supports: vec![Support { x: 0.0, kind: Held::Clamped }],
        ..fixtures
    };
    let of = |fixtures: Fixtures| {
        let bat = dowel().with(|parts| parts.fixtures = fixtures).unwrap();
        let found = norms(&bat, Theory::EulerBernoulli);
        let unit = 4.0 * DENSITY * LENGTH.powi(4) / (MODULUS * RADIUS * RADIUS);
        [found.trace / unit, found.square / unit / unit]
    };
    let free = [1.0 / 420.0, 1.0 / (420.0 * 420.0) - 2.0 / 1_247_400.0];
    let fixed = [1.0 / 12.0, 11.0 / 1680.0];
    let mut all = vec![];
    for soft in [1e-3, 0.2, 30.0] {
        let own = soft / 192.0;
        let square = free[1] + 2.0 * soft * 13.0 / (10_080.0 * 128.0) + own * own;
        all.push((joint(0.5, soft), [free[0] + own, square]));
        let own = soft / 24.0;
        let square = fixed[1] + 2.0 * soft * 61.0 / 20_160.0 + own * own;
        all.push((clamped(joint(0.5, soft)), [fixed[0] + own, square]));
        for mass in [0.02, 3.0] {
            let share: f64 = mass / (1.0 + mass);
            let mut bare = hung(0.5, mass, soft);
            let Absorber { x, mass: own, .. } = bare.absorbers.remove(0);
            bare.attachments.push(Attachment { x, mass: own, ..Attachment::default() });
            let [trace, square] = of(bare);
            let own = soft * share;
            let square = square + 2.0 * soft * share * share / 320.0 + own * own;
            all.push((hung(0.5, mass, soft), [trace + own, square]));
            let own = mass * (1.0 / 3.0 + soft);
            let square = fixed[1] + 2.0 * mass * 11.0 / 420.0 + own * own;
            all.push((clamped(hung(1.0, mass, soft)), [fixed[0] + own, square]));
        }
    }
    for (fixtures, exact) in all {
        for (found, exact) in of(fixtures.clone()).into_iter().zip(exact) {
            let above = found / exact - 1.0;
            assert!((-1e-13..1e-8).contains(&above), "{fixtures:?} {above:e}");
        }
    }
}

/// A uniform bat entirely on a bed keeps its shapes: `1/τ = k/ρA + ω_n²`, with ω = 0 for both rigid motions. Eight
/// Legendre coefficients of the bed are restrained, so the norms are slightly above.
#[test]
fn norms_on_a_bed_are_above_those_in_closed_form_and_near_them() {
    let stiff = MODULUS * std::f64::consts::PI * RADIUS.powi(4) / 4.0;
    let unit = 4.0 * DENSITY * LENGTH.powi(4) / (MODULUS * RADIUS * RADIUS);
    // βL of the free beam; from the sixth on (n + ½)π to 1e-15.
    let first = [4.730_040_744_862_704, 7.853_204_624_095_838, 10.995_607_838_001_671];
    let beta = |n: usize| match first.get(n - 1) {
        Some(beta) => *beta,
        None => (n as f64 + 0.5) * std::f64::consts::PI,
    };
    for (soft, most) in [(1e4, 1e-9), (1.0, 1e-7), (1e-3, 1e-2)] {
        let grip =
            Grip { from: 0.0, to: LENGTH, stiffness: stiff / LENGTH.powi(4) / soft, damping: 0.0 };
        let bat = dowel().with(|parts| parts.fixtures.grip = Some(grip)).unwrap();
        let found = norms(&bat, Theory::EulerBernoulli);
        let taus = || (1..2000).map(|n| 1.0 / (1.0 / soft + beta(n).powi(4)));
        let exact = [
            2.0 * soft + taus().sum::<f64>(),
            2.0 * soft * soft + taus().map(|t| t * t).sum::<f64>(),
        ];
        for (found, exact) in
            [found.trace / unit, found.square / unit / unit].into_iter().zip(exact)
        {
            let above = found / exact - 1.0;
            assert!((-1e-9..most).contains(&above), "{soft} {above:e}");
        }
    }
}

/// Every known eigenvalue is part of the sums, and the first few are most of them.
#[test]
fn norms_are_above_the_sums_over_known_modes_and_near_them() {
    let cases: [&[&str]; 10] = [
        &["cone_1_2p64_60"],
        &["cone_1_10_60"],
        &["step_1_3_60"],
        &["steps_many"],
        &["pchip_bat"],
        &["timo_dowel_60"],
        &["clamped_pinned"],
        &["clamped_tip_mass"],
        &["end_springs"],
        &["three_supports"],
    ];
    for cases in cases {
        let truth = Truth::of_cases(cases).unwrap();
        let taus: Vec<f64> = truth.frequencies.iter().map(|f| (TAU * f).powi(-2)).collect();
        let found = norms(&truth.bat, truth.theory);
        let [sum, squares] =
            [1, 2].map(|power| taus.iter().map(|tau| tau.powi(power)).sum::<f64>());
        let last = taus.last().unwrap();
        // Beyond mode n, τ falls as n⁻⁴ for a plain beam and as n⁻² with shear; steps make it irregular.
        let rest = if truth.theory.shears() { 1.6 } else { 0.5 } * taus.len() as f64 * last;
        let above = (found.trace - sum) / rest;
        assert!(above > 0.2 && above < 1.5, "{cases:?} {above}");
        let above = found.square / squares - 1.0;
        assert!(
            above > -1e-14 && above < 1e-9 + 2.0 * rest * last / squares,
            "{cases:?} {above:e}"
        );
    }
}

/// The sums do not depend on the division of the bat, so a missing stretch would show.
#[test]
fn norms_are_the_same_whatever_pieces_a_bat_has() {
    let whole = norms(&cone(0.012, 0.033), Theory::EulerBernoulli);
    for count in [2, 5, 11] {
        let share = |k: usize| k as f64 / count as f64;
        let x: Vec<f64> = (0..=count).map(|k| LENGTH * share(k)).collect();
        let outer: Vec<f64> = (0..=count).map(|k| 0.012 + 0.021 * share(k)).collect();
        let linear = sweetspot::bat::profile::Interpolation::Linear;
        let cut = crate::common::bat(&x, &outer, &vec![0.0; x.len()], linear);
        let found = norms(&cut, Theory::EulerBernoulli);
        assert!((found.trace / whole.trace - 1.0).abs() < 1e-10, "{count}");
        assert!((found.square / whole.square - 1.0).abs() < 1e-10, "{count}");
    }
    // Turned end for end, too.
    let turned = norms(&cone(0.033, 0.012), Theory::EulerBernoulli);
    assert!((turned.trace / whole.trace - 1.0).abs() < 1e-10);
    assert!((turned.square / whole.square - 1.0).abs() < 1e-10);
}

/// Steep stretches, on which a polynomial of degree 12 is not close to 1/EI: its bound must still be nowhere below
/// 1/EI.
#[test]
fn what_is_taken_for_the_softness_is_nowhere_below_it() {
    let mut bounded = 0;
    for ratio in [1.5, 2.0, 2.5, 3.0] {
        let bat = cone(0.01, 0.01 * ratio);
        let curve = &curved(&bat).unwrap()[0];
        let rings = Rings::of(&bat.layups()[0], curve, Interval::point(1.0));
        let stiff: Values<40> = rings.bending(&GAUSS_40);
        let Some(soft) = inverse(&stiff, 0.5) else { continue };
        let at: Values<40> = soft.series.values(&GAUSS_40);
        for g in 0..40 {
            let taken = at.at[g] / (1.0 - soft.share);
            let exact = 1.0 / stiff.at[g];
            assert!(taken >= exact * (1.0 - 1e-13), "{ratio} {g} {}", taken / exact - 1.0);
            assert!(taken <= exact * (1.0 + 3.0 * soft.share + 1e-12), "{ratio} {g}");
            // The share is needed: somewhere the polynomial alone is below.
        }
        let below = (0..40).any(|g| at.at[g] * stiff.at[g] < 1.0 - 0.01 * soft.share);
        assert!(below, "{ratio}");
        bounded += 1;
    }
    assert!(bounded > 1);
}

#[test]
fn sections_are_what_the_bat_says_they_are_worth_and_never_less_than_their_least() {
    let mut looked = 0;
    for file in ["r161", "northwestern_aluminium", "corked", "two_piece", "cone"] {
        let bat = bundled_bat(&format!("meshes/{file}.json")).unwrap();
        let curves = curved(&bat).unwrap();
        for (curve, piece) in curves.iter().zip(&bat.profile().pieces) {
            let rings = Rings::of(bat.layup(piece), curve, Interval::point(1.0));
            let [bending, mass, turning]: [Values<24>; 3] =
                [rings.bending(&GAUSS_24), rings.mass(&GAUSS_24), rings.turning(&GAUSS_24)];
            let (least, mut softest) = (rings.bending_at_least(), f64::INFINITY);
            let shear = rings.shear();
            let sheared: Option<Values<24>> =
                shear.as_ref().map(|shear| shear.series.values(&GAUSS_24));
            for (g, xi) in GAUSS_24.points.iter().enumerate() {
                let worth = bat.layup(piece).worth(piece.at(0.5 * (1.0 + xi)));
                let near = |found: f64, radius: f64, exact: f64| {
                    let off = (found - exact).abs();
                    assert!(off <= radius + 1e-13 * exact, "{file} {g} {found} {exact}");
                    // Thin walls are known to fewer digits.
                    assert!(radius < 1e-11 * exact, "{file} {g} {radius:e} {exact:e}");
                };
                near(bending.at[g], bending.radius, worth.bending);
                near(mass.at[g], mass.radius, worth.mass);
                near(turning.at[g], turning.radius, worth.turning);
                assert!(least <= worth.bending * (1.0 + 1e-14));
                softest = softest.min(worth.bending);
                if let (Some(values), Some(shear)) = (&sheared, &shear) {
                    let off = values.radius + shear.share * values.largest();
                    let exact = worth.shear;
                    assert!((values.at[g] - exact).abs() <= off + 1e-12 * exact, "{file} {g}");
                    assert!(rings.shear_at_least().unwrap() <= exact * (1.0 + 1e-14));
                }
                looked += 1;
            }
            assert!(least > 0.2 * softest, "{file} {least} {softest}");
        }
    }
    assert!(looked > 1000, "{looked}");
}

/// κGA of a tube by Cowper's formula in twice the digits, for every tube that rounds to the radii and moduli in the
/// file: its relative difference from the polynomial is within the stated one, which is small on thin walls too.
#[test]
fn the_shear_stiffness_of_a_tube_is_within_its_share() {
    let one = twofold::number(1.0);
    for wall in [0.4, 0.1, 0.02, 0.003] {
        let wood = Material { shear_modulus: Some(1.0), ..Material::new(DENSITY, 2.6).unwrap() };
        let radii = [0.031, 0.028];
        let profile = Profile::new(Stations {
            x: vec![0.0, 0.11],
            outer: radii.to_vec(),
            inner: radii.map(|r| r * (1.0 - wall)).to_vec(),
            interpolation: Interpolation::Linear,
        })
        .unwrap();
        let bat = Bat::builder(profile, wood).build().unwrap();
        let (curve, piece) = (&curved(&bat).unwrap()[0], &bat.profile().pieces[0]);
        let shear = Rings::of(bat.layup(piece), curve, Interval::point(1.0)).shear().unwrap();
        assert!(shear.share < 1e-14 / wall + 5e-13, "{wall} {:e}", shear.share);
        let coefficients: Vec<Twofold> = (0..=shear.series.degree())
            .map(|j| twofold::number(shear.series.coefficient(j)))
            .collect();
        let nu = twofold::number(0.3);
        let times = |by: f64, of: Twofold| twofold::number(by) * of;
        // Radii differ from those of the file by at most 3u of the outer one, inner ones by 6u.
        for (outer, inner) in [(0.0, 0.0), (3.0, 6.0), (-3.0, -6.0), (3.0, -6.0), (-3.0, 6.0)] {
            let near = |by: f64| twofold::number(1.0 + by * 0.5 * f64::EPSILON);
            for k in 0..=20 {
                let xi = f64::from(k) / 10.0 - 1.0;
                let along = |of: [f64; 2]| {
                    let half = |x: f64| twofold::number(0.5) * (one + twofold::number(x));
                    half(-xi) * twofold::number(of[0]) + half(xi) * twofold::number(of[1])
                };
                let b = along(radii) * near(outer);
                let a = along(radii.map(|r| r * (1.0 - wall))) + b * near(inner) - b;
                let (b2, a2) = (b * b, a * a);
                let square = (b2 + a2) * (b2 + a2);
                let below = (times(7.0, one) + times(6.0, nu)) * square
                    + (times(20.0, one) + times(12.0, nu)) * a2 * b2;
                let kappa = times(6.0, one + nu) * square / below;
                let pi = Twofold { high: std::f64::consts::PI, low: 1.224_646_799_147_353_2e-16 };
                let exact = kappa * pi * (b2 - a2);
                let found = arithmetic::exact(&coefficients, twofold::number(xi));
                let off = ((exact - found) / found).high.abs();
                assert!(off <= shear.share, "{wall} {xi} {off:e} {:e}", shear.share);
            }
        }
    }
}

/// The mass of a weighed bat is that of the scale.
#[test]
fn a_weighed_bat_weighs_what_the_scale_said() {
    let bat = cone(0.012, 0.033);
    let material = bat.material().clone();
    let weighed = Bat::builder(bat.profile().clone(), material).mass(Some(0.9)).build().unwrap();
    let theory = Theory::EulerBernoulli;
    let layout = Layout::of(&weighed, theory).unwrap();
    let mesh = sweetspot::beam::mesh::Mesh::along(&weighed, 4);
    let mass = Proven::of(&weighed, &layout, &mesh, theory).unwrap().gram[0];
    assert!(mass.low < 0.9 && mass.high > 0.9 && mass.high - mass.low < 1e-12, "{mass:?}");
}

/// Trials constructed for a matrix with known eigenvalues: every interval contains its eigenvalue.
#[test]
fn conclusions_hold_the_eigenvalues_of_matrices_whose_trials_are_known() {
    let taus: Vec<f64> = (1..=40).map(|n| f64::from(n).powi(-4)).collect();
    let norms = Norms {
        trace: taus.iter().sum::<f64>() * (1.0 + 1e-12),
        square: taus.iter().map(|tau| tau * tau).sum::<f64>() * (1.0 + 1e-12),
        reach: 1.0,
        above: 0.0,
        stretches: 1,
    };
    let mut random = crate::arithmetic::Random::new(3);
    let mut held = [0; 2];
    for round in 0..4000 {
        let noise = 10f64.powf(-1.0 - 7.0 * random.share());
        let mut trials = vec![];
        for n in 0..16 {
            // Sometimes one is missing, sometimes one occurs twice.
            if round % 5 == 1 && n == round % 16 {
                continue;
            }
            let mut vector: Vec<f64> = (0..40).map(|_| noise * random.signed()).collect();
            vector[if round % 7 == 2 && n == 3 { 2 } else { n }] += 1.0;
            let sum = |power: i32| -> f64 {
                vector.iter().zip(&taus).map(|(v, tau)| v * v * tau.powi(power)).sum()
            };
            let (norm, first, second) = (sum(0), sum(1), sum(2));
            let quotient = first / norm;
            let residual = (second / norm - quotient * quotient).max(0.0);
            trials.push(Some(Energies {
                quotient: Interval::around(quotient, 1e-13),
                residual: residual * (1.0 + 1e-9) + 1e-15 * quotient * quotient,
                strain: Interval::point(1.0),
            }));
        }
        let found = conclude(&trials, &norms);
        for (eigenvalue, tau) in found.proven.iter().zip(&taus) {
            let [lower, upper] = eigenvalue.tau;
            assert!(lower <= *tau && *tau <= upper, "{round} {eigenvalue:?} {tau}");
            held[0] += 1;
        }
        held[1] += found.proven.len();
        // Without mode n at most n − 1 are proven.
        if round % 5 == 1 && round % 7 != 2 {
            assert!(found.proven.len() <= round % 16, "{round}");
        }
    }
    assert!(held[0] == held[1] && held[0] > 20_000, "{held:?}");
}
