//! The effect of weights, springs and supports on a bat, independent of its shape.

use crate::common;

use std::f64::consts::PI;

use common::{DENSITY, LENGTH, MODULUS, RADIUS, cone, dowel};
use sweetspot::bat::fixtures::{
    Absorber, Attachment, Fixtures, Grip, Held, Joint, Region, Support, Tape,
};
use sweetspot::bat::layup::Layup;
use sweetspot::bat::material::Material;
use sweetspot::bat::profile::{Interpolation, Stations};
use sweetspot::bat::theory::Theory;
use sweetspot::modes::mode::Mode;
use sweetspot::{Bat, Profile, Request, solve};

/// A cone with these attached parts.
fn with(fixtures: Fixtures) -> Bat {
    asked_with(fixtures).unwrap()
}

/// A cone with these attached parts, or the reason why it is impossible.
fn asked_with(fixtures: Fixtures) -> sweetspot::Result<Bat> {
    let cone = cone(0.0125, 0.033);
    let mut material = cone.material().clone();
    material.shear_modulus = Some(1e9);
    Bat::builder(cone.profile().clone(), material).name("test").fixtures(fixtures).build()
}

fn springs(list: &[(f64, f64, f64)]) -> Vec<Attachment> {
    let spring = |(x, stiffness, rotational_stiffness): &(f64, f64, f64)| Attachment {
        x: *x,
        stiffness: *stiffness,
        rotational_stiffness: *rotational_stiffness,
        ..Attachment::default()
    };
    list.iter().map(spring).collect()
}

fn weights(list: &[(f64, f64)]) -> Vec<Attachment> {
    list.iter()
        .map(|(x, mass)| Attachment { x: *x, mass: *mass, ..Attachment::default() })
        .collect()
}

fn pins(list: &[f64]) -> Vec<Support> {
    list.iter().map(|x| Support { x: *x, kind: Held::Pinned }).collect()
}

/// For a ton inside a bat in soft hands the program cannot reach a better accuracy; for most others it can.
const TOLERANCE: f64 = 1e-9;

/// The frequencies (Hz) of all motions, the free rigid ones as zeros.
fn spectrum(fixtures: Fixtures, theory: Theory) -> Vec<f64> {
    known_spectrum(fixtures, theory).unwrap_or_else(|why| panic!("{why}"))
}

/// The same, or the reason why they do not reach the tolerance.
fn known_spectrum(fixtures: Fixtures, theory: Theory) -> Result<Vec<f64>, String> {
    let request = Request { modes: 12, tolerance: TOLERANCE, theory, ..Request::default() };
    let bat = asked_with(fixtures).map_err(|why| why.to_string())?;
    let solution = solve(&bat, &request).unwrap();
    if !(solution.met()) {
        return Err(format!("{} {:?}", solution.ending, bat.fixtures()));
    }
    let rigid = std::iter::repeat_n(0.0, solution.rigid_modes);
    Ok(rigid.chain(solution.modes.iter().map(|mode| mode.frequency())).collect())
}

/// Rayleigh's theorem on one constraint: a spring or a support more moves a frequency up, at most
/// to the next one; a mass more moves it down, at most to the one before.
#[test]
fn one_thing_more_moves_a_frequency_at_most_to_its_neighbour() {
    let base = || Fixtures {
        attachments: weights(&[(0.1, 0.05)]),
        grip: Some(Grip { from: 0.0, to: 0.15, stiffness: 3e4, damping: 0.0 }),
        ..Fixtures::default()
    };
    const SAME: f64 = 2.0 * TOLERANCE;
    for theory in [Theory::EulerBernoulli, Theory::Timoshenko] {
        for start in [Fixtures::default(), base()] {
            let before = spectrum(start.clone(), theory);
            for x in [0.0, 0.3, LENGTH] {
                let mut stiffer = vec![];
                for k in [10.0, 1e5, 1e9, 1e15] {
                    let mut sprung = start.clone();
                    sprung.attachments.extend(springs(&[(x, k, 0.0)]));
                    stiffer.push(spectrum(sprung, theory));
                    let mut turned = start.clone();
                    turned.attachments.extend(springs(&[(x, 0.0, k)]));
                    stiffer.push(spectrum(turned, theory));
                }
                let mut held = start.clone();
                held.supports = pins(&[x]);
                stiffer.push(spectrum(held, theory));
                for after in stiffer {
                    for k in 0..11 {
                        assert!(after[k] >= before[k] * (1.0 - SAME), "{x} {k} {after:?}");
                        assert!(after[k] <= before[k + 1] * (1.0 + SAME), "{x} {k} {after:?}");
                    }
                }
                for mass in [1e-3, 0.1, 1e3] {
                    let mut heavier = start.clone();
                    heavier.attachments.extend(weights(&[(x, mass)]));
                    let after = spectrum(heavier, theory);
                    for k in 1..12 {
                        assert!(after[k] <= before[k] * (1.0 + SAME), "{x} {k} {after:?}");
                        assert!(after[k] >= before[k - 1] * (1.0 - SAME), "{x} {k} {after:?}");
                    }
                }
            }
        }
    }
}

/// A spring of stiffness k is a pin with an additional displacement of force over k.
#[test]
fn a_stiff_spring_tends_to_a_support() {
    let pinned = Fixtures { supports: pins(&[0.2, 0.7]), ..Fixtures::default() };
    let pinned = spectrum(pinned, Theory::Timoshenko);
    let off = |k: f64| -> Vec<f64> {
        let springs = springs(&[(0.2, k, 0.0), (0.7, k, 0.0)]);
        let sprung = Fixtures { attachments: springs, ..Fixtures::default() };
        let sprung = spectrum(sprung, Theory::Timoshenko);
        sprung.iter().zip(&pinned).take(5).map(|(a, b)| 1.0 - a / b).collect()
    };
    for (soft, stiff) in off(1e11).into_iter().zip(off(1e12)) {
        assert!((soft / stiff / 10.0 - 1.0).abs() < 0.03, "{soft:e} {stiff:e}");
    }
    for off in off(1e19) {
        assert!(off.abs() < 1e-10, "{off:e}");
    }
}

/// A mass m on each side at a distance d weighs as 2 m with the rotary inertia 2 m d², and half a
/// mass twice as the mass.
#[test]
fn masses_add_up() {
    let at = |mass: f64, offset: f64, rotary_inertia: f64| Attachment {
        x: 0.6,
        mass,
        offset,
        rotary_inertia,
        ..Attachment::default()
    };
    let of = |attachments: &[Attachment]| {
        let attachments = attachments.to_vec();
        spectrum(Fixtures { attachments, ..Fixtures::default() }, Theory::Timoshenko)
    };
    let two = of(&[at(0.05, 0.04, 0.0), at(0.05, -0.04, 0.0)]);
    let one = of(&[at(0.1, 0.0, 2.0 * 0.05 * 0.04 * 0.04)]);
    let twice = of(&[at(0.05, 0.0, 4e-5), at(0.05, 0.0, 1.2e-4)]);
    for ((a, b), c) in two.iter().zip(&one).zip(&twice).skip(2) {
        assert!((a / b - 1.0).abs() < 1e-11 && (c / b - 1.0).abs() < 1e-11, "{a} {b} {c}");
    }
}

/// A bat with everything, turned end for end, is the same bat.
#[test]
fn a_bat_with_everything_turned_end_for_end_is_the_same() {
    let turned = |x: f64| LENGTH - x;
    let aluminium =
        Material { shear_modulus: Some(27e9), ..Material::new(2810.0, 71.7e9).unwrap() };
    let all = |place: &dyn Fn(f64) -> f64, sign: f64| {
        let stretch = |from: f64, to: f64| {
            let ends = [place(from), place(to)];
            [ends[0].min(ends[1]), ends[0].max(ends[1])]
        };
        let ([r0, r1], [t0, t1], [g0, g1]) =
            (stretch(0.5, 0.7), stretch(0.1, 0.3), stretch(0.0, 0.15));
        Fixtures {
            regions: vec![Region { from: r0, to: r1, layup: Layup::of(aluminium.clone()) }],
            attachments: vec![Attachment {
                x: place(0.8),
                mass: 0.1,
                offset: sign * 0.02,
                rotary_inertia: 1e-4,
                stiffness: 1e4,
                rotational_stiffness: 30.0,
            }],
            tapes: vec![Tape { from: t0, to: t1, mass: 0.02 }],
            absorbers: vec![Absorber { x: place(0.05), mass: 0.03, stiffness: 4e4, damping: 0.0 }],
            joints: vec![Joint { x: place(0.45), rotational_stiffness: 1e4 }],
            supports: vec![Support { x: place(0.35), kind: Held::Pinned }],
            grip: Some(Grip { from: g0, to: g1, stiffness: 1e5, damping: 0.0 }),
        }
    };
    let original = with(all(&|x| x, 1.0));
    let mirror = all(&turned, -1.0);
    let bare = cone(0.033, 0.0125);
    let material = original.material().clone();
    let mirrored = Bat::builder(bare.profile().clone(), material)
        .name("turned")
        .fixtures(mirror)
        .build()
        .unwrap();
    for theory in Theory::ALL {
        let request = Request { modes: 10, tolerance: 1e-11, theory, ..Request::default() };
        let [a, b] = [&original, &mirrored].map(|bat| solve(bat, &request).unwrap());
        assert!(a.met() && b.met() && a.rigid_modes == 0);
        for (a, b) in a.modes.iter().zip(&b.modes) {
            assert!((a.omega / b.omega - 1.0).abs() < 2e-11, "{theory:?} {}", a.order);
        }
    }
    let (a, b) = (original.inertia(), mirrored.inertia());
    assert!((a.mass / b.mass - 1.0).abs() < 1e-14);
    assert!((a.balance_point + b.balance_point - LENGTH).abs() < 1e-14);
    assert!((a.about_balance / b.about_balance - 1.0).abs() < 1e-13);
}

/// Tape along a stretch is the limit of many small weights, except for its rotary inertia about its diameter (which the
/// plain beam neglects): second order in their distance.
#[test]
fn tape_is_the_limit_of_many_small_weights() {
    let tape = vec![Tape { from: 0.1, to: 0.4, mass: 0.06 }];
    let taped = Fixtures { tapes: tape, ..Fixtures::default() };
    let taped = spectrum(taped, Theory::EulerBernoulli);
    let off = |count: usize| -> Vec<f64> {
        let place = |k: usize| 0.1 + 0.3 * (k as f64 + 0.5) / count as f64;
        let list: Vec<_> = (0..count).map(|k| (place(k), 0.06 / count as f64)).collect();
        let dotted = Fixtures { attachments: weights(&list), ..Fixtures::default() };
        let dotted = spectrum(dotted, Theory::EulerBernoulli);
        dotted.iter().zip(&taped).skip(2).take(4).map(|(a, b)| a / b - 1.0).collect()
    };
    for (coarse, fine) in off(16).into_iter().zip(off(32)) {
        assert!((coarse / fine / 4.0 - 1.0).abs() < 0.05, "{coarse:e} {fine:e}");
    }
}

/// The remaining rigid motions, and their names.
#[test]
fn rigid_motions_are_found_and_named() {
    let none = Fixtures::default();
    let pinned = Fixtures { supports: pins(&[0.0]), ..Fixtures::default() };
    let twice = Fixtures { supports: pins(&[0.0, 0.5]), ..Fixtures::default() };
    let turning = Fixtures { attachments: springs(&[(0.3, 0.0, 1e-9)]), ..Fixtures::default() };
    let soft = Fixtures { attachments: springs(&[(0.3, 1e-9, 0.0)]), ..Fixtures::default() };
    let hands = Grip { from: 0.0, to: 0.1, stiffness: 1e-9, damping: 0.0 };
    let hands = Fixtures { grip: Some(hands), ..Fixtures::default() };
    for (fixtures, rigid, words) in [
        (none, 2, "two rigid"),
        (pinned, 1, "turns about"),
        (twice, 0, "no rigid"),
        (turning, 1, "sideways"),
        (soft, 1, "turns about"),
        (hands, 0, "no rigid"),
    ] {
        let bat = with(fixtures);
        let solution = solve(&bat, &Request { modes: 3, ..Request::plain() }).unwrap();
        assert!(solution.met());
        assert_eq!((solution.rigid_modes, bat.fixtures().rigid_modes()), (rigid, rigid));
        assert!(bat.fixtures().freedom().contains(words), "{}", bat.fixtures().freedom());
        // A spring of 1e-9 N/m holds the bat: a slow motion is not a rigid one.
        assert!(solution.modes.iter().all(|mode| mode.omega > 0.0));
    }
}

/// A pointed end gives way to any force without end: what acts on it is refused, by its list.
#[test]
fn nothing_is_fastened_to_a_point() {
    let point = cone(0.0, 0.03);
    let on = |x: f64| {
        let weight = Fixtures { attachments: weights(&[(x, 0.02)]), ..Fixtures::default() };
        let spring = Fixtures { attachments: springs(&[(x, 1e4, 0.0)]), ..Fixtures::default() };
        let pin = Fixtures { supports: pins(&[x]), ..Fixtures::default() };
        [("attachments", weight), ("attachments", spring), ("supports", pin)]
    };
    for x in [0.0, 0.01] {
        for (list, fixtures) in on(x) {
            let bat = Bat::builder(point.profile().clone(), point.material().clone());
            let built = bat.fixtures(fixtures).build().map_err(|why| why.to_string());
            match x == 0.0 {
                true => {
                    assert!(built.is_err_and(|why| why.contains(list) && why.contains("point")))
                }
                false => assert!(built.is_ok(), "{built:?}"),
            }
        }
    }
}

/// The two inches-and-centimetres forms of one place differ in their last digit.
const SIX_INCHES: f64 = 6.0 * 0.0254;
const FIFTEEN_CENTIMETRES: f64 = 0.1524;

#[test]
fn a_pin_and_a_spring_at_one_place_in_two_units_are_the_pin_and_its_turning_spring() {
    const { assert!(SIX_INCHES != FIFTEEN_CENTIMETRES) };
    for theory in Theory::ALL {
        let of = |x: f64, stiffness: f64, turning: f64| Fixtures {
            supports: pins(&[FIFTEEN_CENTIMETRES]),
            attachments: springs(&[(x, stiffness, turning)]),
            ..Fixtures::default()
        };
        for turning in [0.0, 1e-3, 100.0] {
            let both = spectrum(of(SIX_INCHES, 1e5, turning), theory);
            let pin = spectrum(of(FIFTEEN_CENTIMETRES, 0.0, turning), theory);
            for (a, b) in both.iter().zip(&pin) {
                assert!((a - b).abs() <= 4.0 * TOLERANCE * b, "{theory:?} {turning} {a} {b}");
            }
        }
    }
}

#[test]
fn two_pins_apart_by_round_off_are_one_pin() {
    for theory in Theory::ALL {
        let one = spectrum(Fixtures { supports: pins(&[0.3]), ..Fixtures::default() }, theory);
        for apart in [1e-16, 1e-15, 1e-14, 1e-13] {
            let supports = pins(&[0.3, 0.3 + apart]);
            if supports[0] == supports[1] {
                continue;
            }
            let two = spectrum(Fixtures { supports, ..Fixtures::default() }, theory);
            assert_eq!(two, one, "{theory:?} {apart}");
        }
    }
}

/// The moments over the inner pins of a dowel on pins at equal distances ℓ are `sin(kπi/N)` with
/// `cos(kπ/N) = (coth λ − cot λ)/(csc λ − csch λ)`, `λ⁴ = ω² ρA ℓ⁴/EI`, and 0 at the slowest, `λ = π` (three-moment
/// equation of a vibrating beam). So many modes lie close together.
#[test]
fn a_dowel_on_many_pins_has_a_mode_for_every_stretch() {
    for stretches in [3, 33, 39, 99, 149] {
        let x = |k: usize| (LENGTH * k as f64 / stretches as f64).min(LENGTH);
        let supports = pins(&(0..=stretches).map(x).collect::<Vec<_>>());
        let bare = dowel();
        let bat = Bat::builder(bare.profile().clone(), bare.material().clone());
        let bat = bat.fixtures(Fixtures { supports, ..Fixtures::default() }).build().unwrap();
        let modes = 20.min(stretches);
        let request = Request { modes, tolerance: 1e-8, ..Request::plain() };
        let solution = solve(&bat, &request).unwrap();
        assert!(solution.met(), "{stretches} {}", solution.ending);
        let scale = RADIUS / 2.0 * (MODULUS / DENSITY).sqrt() * (stretches as f64 / LENGTH).powi(2);
        for (k, mode) in solution.modes.iter().enumerate() {
            let wanted = (k as f64 * PI / stretches as f64).cos();
            let ratio =
                |l: f64| (1.0 / l.tanh() - 1.0 / l.tan()) / (1.0 / l.sin() - 1.0 / l.sinh());
            let (mut low, mut high) = (PI, 4.73);
            while k > 0 && high - low > 1e-12 {
                let middle = 0.5 * (low + high);
                if ratio(middle) > wanted { low = middle } else { high = middle }
            }
            let exact = scale * low * low / (2.0 * PI);
            let off = mode.frequency() / exact - 1.0;
            assert!(off.abs() < 1e-7, "{stretches} {k} {off:e}");
        }
    }
}

/// Two pins at a distance d restrain the slope of the bat, except for the bending between them: for d → 0 the plain
/// beam tends to the clamp. A beam with shear can rotate between them by shear alone, with `κGA d` (N m/rad), and tends
/// to the pin.
#[test]
fn two_pins_close_together_tend_to_a_clamp_without_shear_and_to_a_pin_with_it() {
    let held = |supports: Vec<Support>, theory| {
        spectrum(Fixtures { supports, ..Fixtures::default() }, theory)
    };
    let clamp = vec![Support { x: 0.3, kind: Held::Clamped }];
    let plain = Theory::EulerBernoulli;
    let clamped = held(clamp, plain);
    let off = |apart: f64| -> Vec<f64> {
        let two = held(pins(&[0.3, 0.3 + apart]), plain);
        two.iter().zip(&clamped).map(|(a, b)| a / b - 1.0).collect()
    };
    let (far, near) = (off(1e-4), off(1e-5));
    for (far, near) in far.iter().zip(&near).take(4) {
        assert!((far / near / 10.0 - 1.0).abs() < 0.05, "{far:e} {near:e}");
    }
    assert!(off(1e-8).iter().all(|off| off.abs() < 1e-6), "{:?}", off(1e-8));
    let pinned = held(pins(&[0.3]), Theory::Timoshenko);
    let two = held(pins(&[0.3, 0.3 + 1e-8]), Theory::Timoshenko);
    assert!(two[0] < 0.02 * two[1]);
    for (a, b) in two.iter().zip(&pinned).skip(1) {
        assert!((a / b - 1.0).abs() < 1e-3, "{a} {b}");
    }
}

/// Rayleigh's theorem on one constraint holds for any distance to the next contact. Two springs some picometres apart
/// hardly restrain the rotation; its frequency is then unknown, and the answer says so.
#[test]
fn one_hold_more_at_almost_one_place_moves_a_frequency_at_most_to_its_neighbour() {
    const SAME: f64 = 2.0 * TOLERANCE;
    let distances = [1e-16, 1e-14, 3e-13, 3e-12, 1e-11, 1e-9, 1e-7, 1e-5, 1e-3];
    let weight = Attachment {
        mass: 0.05,
        offset: 0.03,
        rotary_inertia: 1e-5,
        ..springs(&[(0.0, 0.0, 0.0)])[0]
    };
    let mut known = 0;
    for (k, apart) in distances.into_iter().enumerate() {
        let theory = Theory::ALL[k % 3];
        for (place, x) in [0.0, SIX_INCHES, 0.4, LENGTH].into_iter().enumerate() {
            let y = if x == LENGTH { x - apart } else { x + apart };
            let joints = match x {
                0.4 => vec![Joint { x: y, rotational_stiffness: 2e3 }],
                _ => vec![],
            };
            let attachments = vec![Attachment { x, ..weight }];
            let supports = if (k + place) % 2 == 0 { pins(&[x]) } else { vec![] };
            let mut start = Fixtures { supports, attachments, joints, ..Fixtures::default() };
            start.attachments.extend(springs(&[(x, 3e4, 0.0)]));
            let before = known_spectrum(start.clone(), theory);
            let hold = [(y, 1e6, 0.0), (y, 0.0, 50.0), (y, 1e12, 0.0)][(k + place) % 3];
            start.attachments.extend(springs(&[hold]));
            let (Ok(before), Ok(after)) = (before, known_spectrum(start, theory)) else {
                continue;
            };
            known += 1;
            for n in 0..11 {
                assert!(after[n] >= before[n] * (1.0 - SAME), "{apart} {x} {n} {after:?}");
                assert!(after[n] <= before[n + 1] * (1.0 + SAME), "{apart} {x} {n} {after:?}");
            }
        }
    }
    assert!(known >= 24, "{known} of 36");
}

/// Hands hold a cone in the same way, regardless of its number of stations.
#[test]
fn a_grip_does_not_see_the_stations_of_a_profile() {
    let cone = cone(0.0125, 0.033);
    let grip = Some(Grip { from: 0.0, to: 0.21, stiffness: 2e5, damping: 0.0 });
    let fixtures = Fixtures { grip, ..Fixtures::default() };
    for theory in [Theory::EulerBernoulli, Theory::Timoshenko] {
        let few = spectrum(fixtures.clone(), theory);
        let count = 300;
        let at = |k: usize, ends: [f64; 2]| ends[0] + (ends[1] - ends[0]) * k as f64 / count as f64;
        let stations = Stations {
            x: (0..=count).map(|k| at(k, [0.0, LENGTH])).collect(),
            outer: (0..=count).map(|k| at(k, [0.0125, 0.033])).collect(),
            inner: vec![0.0; count + 1],
            interpolation: Interpolation::Linear,
        };
        let mut material = cone.material().clone();
        material.shear_modulus = Some(1e9);
        let profile = Profile::new(stations).unwrap();
        let many = Bat::builder(profile, material).name("many").fixtures(fixtures.clone()).build();
        let request = Request { modes: 12, tolerance: TOLERANCE, theory, ..Request::default() };
        let solution = solve(&many.unwrap(), &request).unwrap();
        assert!(solution.met() && solution.rigid_modes == 0);
        for (mode, few) in solution.modes.iter().zip(&few) {
            assert!((mode.frequency() / few - 1.0).abs() < 2.0 * TOLERANCE, "{}", mode.order);
        }
    }
}

fn absorbers(count: usize, place: impl Fn(usize) -> f64, step: f64) -> Vec<Absorber> {
    let of = |k: usize| {
        let stiffness = 1e4 * (1.0 + step * k as f64);
        Absorber { x: place(k), mass: 1e-3, stiffness, damping: 0.0 }
    };
    (0..count).map(of).collect()
}

/// The reaction of absorbers at one place goes from −∞ to ∞ between two of their frequencies, so that there is a mode
/// between each two.
#[test]
fn a_hundred_absorbers_at_one_place_have_a_motion_between_each_two() {
    for step in [1e-2, 1e-4, 1e-6] {
        let hung = absorbers(100, |_| 0.5, step);
        let own = |a: &Absorber| (a.stiffness / a.mass).sqrt();
        let tuned: Vec<f64> = hung.iter().map(own).collect();
        let bat = with(Fixtures { absorbers: hung, ..Fixtures::default() });
        for (theory, modes) in [(Theory::EulerBernoulli, 101), (Theory::Timoshenko, 10)] {
            let asked = Request { modes, theory, ..Request::default() };
            let found = solve(&bat, &asked).unwrap();
            assert!(found.met(), "{step:e} {:?}", found.ending);
            let last = found.modes[modes - 1].omega;
            for pair in tuned.windows(2).filter(|pair| pair[1] < last) {
                let between = |mode: &&Mode| mode.omega > pair[0] && mode.omega < pair[1];
                assert!(found.modes.iter().any(|mode| between(&mode)), "{step:e} {pair:?}");
            }
        }
    }
}

/// By Rayleigh's theorem `n` additional absorbers increase the number of modes below a frequency by at most `n`, and
/// those far below all other modes each add one.
#[test]
fn hundreds_of_absorbers_along_the_bat_are_all_found() {
    for count in [100, 300] {
        let place = |k: usize| 0.01 + 0.8 * k as f64 / count as f64;
        let soft = |a: Absorber| Absorber { mass: 1e-4, stiffness: 0.1, ..a };
        let hung = absorbers(count, place, 0.0).into_iter().map(soft).collect();
        let bat = with(Fixtures { absorbers: hung, ..Fixtures::default() });
        for modes in [10, 50, count + 3] {
            let asked = Request { modes, ..Request::plain() };
            let found = solve(&bat, &asked).unwrap();
            assert!(found.met(), "{count} {modes} {:?}", found.ending);
            // √(k/m) is 31.6 rad/s, while the modes of the bat begin above 500.
            let slow = found.modes.iter().filter(|mode| mode.omega < 100.0).count();
            assert_eq!(slow, modes.min(count), "{count} {modes}");
        }
    }
}

fn refusal(fixtures: Fixtures) -> String {
    asked_with(fixtures).map_or_else(|why| why.to_string(), |_| String::new())
}

/// Equal absorbers vibrate against each other with the bat at rest: no node, no modal mass.
#[test]
fn absorbers_alike_at_one_place_are_refused_and_elsewhere_or_otherwise_tuned_are_not() {
    for step in [0.0, 1e-12, 1e-10] {
        let said =
            refusal(Fixtures { absorbers: absorbers(2, |_| 0.5, step), ..Fixtures::default() });
        assert!(said.contains("absorbers[1]") && said.contains("the bat at rest"), "{step} {said}");
    }
    for (apart, step) in [(0.0, 1e-8), (1e-6, 0.0)] {
        let hung = absorbers(2, |k| 0.5 + apart * k as f64, step);
        assert_eq!(refusal(Fixtures { absorbers: hung, ..Fixtures::default() }), "");
    }
}

/// Two springs `k` at a distance `d` resist rotation with `k d²/2`, and a pin next to one spring with `k d²`.
#[test]
fn springs_too_near_each_other_to_hold_the_bat_against_turning_are_refused() {
    let two = |apart: f64| Fixtures {
        attachments: springs(&[(0.3, 1e4, 0.0), (0.3 + apart, 1e4, 0.0)]),
        ..Fixtures::default()
    };
    for apart in [3e-12, 3e-10, 1e-8] {
        let said = refusal(two(apart));
        assert!(said.contains("against turning by") && said.contains("1e-12 N m/rad"), "{said}");
        let beside = Fixtures {
            supports: pins(&[0.3]),
            attachments: springs(&[(0.3 + apart / 2.0, 1e4, 0.0)]),
            ..Fixtures::default()
        };
        assert!(refusal(beside).contains("against turning by"));
        let turned = Fixtures {
            attachments: springs(&[(0.3, 1e4, 1.0), (0.3 + apart, 1e4, 0.0)]),
            ..Fixtures::default()
        };
        assert_eq!(refusal(turned), "");
    }
    for apart in [0.0, 1e-14, 1e-7] {
        assert_eq!(refusal(two(apart)), "");
    }
}

/// A pinned end does not move but is not listed as a node, at any tolerance and at either end.
#[test]
fn a_pinned_end_is_no_node() {
    for (k, end) in [(0, 0.0), (1, 0.6727), (2, 0.0), (3, 0.6727)] {
        let tip = [0.032, 0.0275, 0.024, 0.03][k];
        let text = format!(
            r#"{{ "format": "sweetspot-bat/1", "material": "white-ash-dynamic", "profile": {{ "interpolation": "linear",
                "x": [0, 0.2691, 0.6727], "radius": [0.015, 0.014, {tip}] }},
                "supports": [{{ "x": {end}, "type": "pinned" }}] }}"#
        );
        let bat = sweetspot::Bat::from_text("pinned.json", &text, "".as_ref()).unwrap();
        for tolerance in [1e-3, 1e-4, 1e-5] {
            let request =
                sweetspot::Request { modes: 6, tolerance, ..sweetspot::Request::default() };
            for mode in sweetspot::solve(&bat, &request).unwrap().modes {
                assert!(
                    mode.nodes.iter().all(|x| (x - end).abs() > 1e-3),
                    "{end} {:?}",
                    mode.nodes
                );
                assert_eq!(mode.nodes.len(), mode.order, "{end} {tolerance:e}");
            }
        }
    }
}
