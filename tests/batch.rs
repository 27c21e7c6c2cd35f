//! Many bats solved at once have the same results as each alone.

use crate::common;

use common::{cone, dowel};
use sweetspot::bat::fixtures::Attachment;
use sweetspot::modes::batch::{Found, Way, all, each};
use sweetspot::{Bat, Mode, Request, Result, Theory, solve};
use sweetspot_proof::bundled::bundled_bat;

const WAYS: [Way; 2] = [Way::OneByOne, Way::SideBySide];

/// The kept results for a bat.
#[derive(Debug, Clone, PartialEq)]
struct Answer {
    omegas: Vec<f64>,
    errors: Vec<f64>,
    masses: Vec<f64>,
    shapes: Vec<f64>,
    nodes: Vec<f64>,
    degree: usize,
}

fn answer(found: Result<Found>) -> Answer {
    let found = found.unwrap();
    Answer {
        omegas: found.omegas.to_vec(),
        errors: found.errors.to_vec(),
        masses: found.modal_masses.to_vec(),
        shapes: found.shapes.to_vec(),
        nodes: found.mesh.nodes(),
        degree: found.degree,
    }
}

impl Answer {
    /// Deflections of a mode at the left and the right end of every element: a Legendre polynomial
    /// is 1 at the right end, 1 or −1 at the left one.
    fn ends(&self, mode: usize) -> Vec<[f64; 2]> {
        let terms = self.degree + 1;
        let each = terms * (self.nodes.len() - 1);
        let signed = |(j, w): (usize, &f64)| if j % 2 == 1 { -w } else { *w };
        let both = |element: &[f64]| {
            [element.iter().enumerate().map(signed).sum(), element.iter().sum::<f64>()]
        };
        self.shapes[mode * each..(mode + 1) * each].chunks_exact(terms).map(both).collect()
    }

    fn tip(&self, mode: usize) -> f64 {
        self.ends(mode)[self.nodes.len() - 2][1]
    }
}

/// The answer for every bat, in order.
fn found(bats: &[Bat], request: &Request, way: Way) -> Vec<Answer> {
    let mut all = Vec::new();
    each(bats, request, way, |place, found| {
        assert_eq!(place, all.len());
        all.push(answer(found));
    });
    assert_eq!(all.len(), bats.len());
    all
}

fn cones(count: usize) -> Vec<Bat> {
    let cone = |k: usize| cone(0.010 + 1e-4 * (k % 50) as f64, 0.033 - 1e-5 * k as f64);
    (0..count).map(cone).collect()
}

/// Cones, and among them bats of another kind, which are solved separately.
fn unlike() -> Vec<Bat> {
    let mut bats = cones(17);
    bats.insert(3, bundled_bat("meshes/r161.json").unwrap());
    bats.push(cone(0.000_05, 0.033));
    bats.push(dowel());
    bats
}

/// The same with a bat of a formula at both ends.
fn with_formulas() -> Vec<Bat> {
    let formula = || vec![bundled_bat("meshes/tanh.json").unwrap()];
    [formula(), unlike(), formula()].concat()
}

fn assert_near(a: &[f64], b: &[f64], within: f64) {
    assert_eq!(a.len(), b.len());
    for (a, b) in a.iter().zip(b) {
        assert!((a / b - 1.0).abs() <= within, "{a} {b}");
    }
}

#[test]
fn side_by_side_and_one_by_one_have_the_same_bits() {
    let bats = cones(21);
    for request in [
        Request { modes: 1, ..Request::plain() },
        Request { modes: 6, ..Request::plain() },
        Request { modes: 8, tolerance: 1e-9, ..Request::plain() },
        Request { modes: 6, elements: Some(40), ..Request::plain() },
    ] {
        let alone = found(&bats, &request, Way::OneByOne);
        let together = found(&bats, &request, Way::SideBySide);
        assert!(alone == together, "{request:?}");
    }
}

/// Real bats, each with another wood and length, and with a weight on the knob if one is given.
fn varied(count: usize, weight: f64) -> Vec<Bat> {
    let r161 = bundled_bat("meshes/r161.json").unwrap();
    let bat = |k: usize| {
        let share = |step: usize| (k * step % 17) as f64 / 17.0;
        let bat = r161.with(|parts| {
            parts.material.density *= 0.9 + 0.2 * share(3);
            parts.material.youngs_modulus *= 0.8 + 0.4 * share(5);
            let knob = Attachment { mass: weight * (1.0 + share(7)), ..Attachment::default() };
            parts.fixtures.attachments.extend((weight > 0.0).then_some(knob));
        });
        bat.unwrap()
    };
    (0..count).map(bat).collect()
}

/// By every theory, bare and weighted, with elements over stations and between them: both ways give the same bits, the
/// other bats of a batch have no effect, and all results equal those of the bat alone.
#[test]
fn real_bats_are_the_same_by_every_theory_whoever_is_beside_them() {
    for theory in Theory::ALL {
        for (weight, tolerance) in [(0.0, 1e-4), (0.02, 1e-4), (0.02, 1e-7), (0.0, 1e-9)] {
            let bats = varied(17, weight);
            let request = Request { modes: 6, tolerance, theory, ..Request::default() };
            let alone = found(&bats, &request, Way::OneByOne);
            let together = found(&bats, &request, Way::SideBySide);
            assert!(alone == together, "{theory:?} {weight} {tolerance}");
            // The first bat plans for all; the others change their neighbours.
            let mut turned = bats.clone();
            turned[1..].reverse();
            let mut again = found(&turned, &request, Way::SideBySide);
            again[1..].reverse();
            assert!(again == together, "{theory:?} {weight} {tolerance}");
            for (bat, found) in bats.iter().zip(&together).step_by(5) {
                let exact = solve(bat, &Request { tolerance: 1e-11, ..request }).unwrap();
                for (k, mode) in exact.modes.iter().enumerate() {
                    let (off, stated) =
                        ((found.omegas[k] / mode.omega - 1.0).abs(), found.errors[k]);
                    assert!(off <= 3.0 * (stated + mode.error.total()), "{off:e} {stated:e}");
                    assert!(stated <= tolerance);
                }
            }
        }
    }
}

/// Each bat agrees with the single solve within both stated errors.
#[test]
fn each_bat_is_the_bat_that_is_solved_alone() {
    let request = |modes| Request { modes, tolerance: 1e-6, ..Request::plain() };
    for (bats, request) in [
        (unlike(), request(5)),
        (unlike(), request(0)),
        (unlike(), request(1)),
        (unlike(), request(2)),
        (unlike(), request(60)),
        // A batch is not compiled for this degree.
        (unlike(), Request { degree: Some(5), ..request(5) }),
        (with_formulas(), request(5)),
    ] {
        let fine = Request { tolerance: 1e-11, degree: None, ..request };
        let alone: Vec<_> = bats.iter().map(|bat| solve(bat, &fine).unwrap()).collect();
        for way in WAYS {
            for (solution, found) in alone.iter().zip(found(&bats, &request, way)) {
                assert!(request.degree.is_none_or(|degree| degree == found.degree));
                assert_eq!(found.omegas.len(), request.modes);
                for (k, mode) in solution.modes.iter().enumerate() {
                    let error = (found.omegas[k] / mode.omega - 1.0).abs();
                    let stated = found.errors[k];
                    assert!(error <= 3.0 * (stated + mode.error.total()), "{error:e} {stated:e}");
                    assert!(stated <= request.tolerance);
                }
            }
        }
    }
}

/// Points and weights of Gauss's rule of n points on [−1, 1], by Newton's method on `P_n`.
fn gauss(n: usize) -> Vec<[f64; 2]> {
    let root = |k: usize| {
        let mut x = (std::f64::consts::PI * (k as f64 + 0.75) / (n as f64 + 0.5)).cos();
        for _ in 0..100 {
            let [p, slope, _] = legendre(n + 1, x)[n];
            x -= p / slope;
        }
        [x, 2.0 / ((1.0 - x * x) * legendre(n + 1, x)[n][1].powi(2))]
    };
    (0..n).map(root).collect()
}

/// `P_0 … P_{n−1}` at ξ, each with its first and second derivative.
fn legendre(n: usize, x: f64) -> Vec<[f64; 3]> {
    let mut p = vec![[1.0, 0.0, 0.0], [x, 1.0, 0.0]];
    for k in 1..n.max(2) - 1 {
        let ([a, slope_before, bend_before], [b, slope, _]) = (p[k - 1], p[k]);
        let odd = (2 * k + 1) as f64;
        let value = (odd * x * b - k as f64 * a) / (k + 1) as f64;
        p.push([value, slope_before + odd * b, bend_before + odd * slope]);
    }
    p
}

/// `∫ρA φ_i φ_j dx` and `∫EI φ_i″ φ_j″ dx` of the returned shapes, element by element.
fn forms(bat: &Bat, found: &Answer, modes: [usize; 2]) -> [f64; 2] {
    // Exact to the degree 39: on a bat of cubic radii a deflection of degree 10 needs 28.
    let points = gauss(20);
    let terms = found.degree + 1;
    let elements = found.nodes.len() - 1;
    let (mut mass, mut stiffness) = (0.0, 0.0);
    // Between stations, which may be inside elements.
    let mut places = [found.nodes.clone(), bat.profile().borders()].concat();
    places.sort_by(f64::total_cmp);
    for part in places.windows(2).filter(|part| part[1] - part[0] > 1e-12) {
        let middle = 0.5 * (part[0] + part[1]);
        let e = (found.nodes.partition_point(|x| *x <= middle) - 1).min(elements - 1);
        let (start, h) = (found.nodes[e], found.nodes[e + 1] - found.nodes[e]);
        for [xi, weight] in &points {
            let x = part[0] + 0.5 * (part[1] - part[0]) * (1.0 + xi);
            let xi = 2.0 * (x - start) / h - 1.0;
            let p = legendre(terms, xi);
            let of = |mode: usize, derivative: usize| -> f64 {
                let own = &found.shapes[(mode * elements + e) * terms..][..terms];
                own.iter().zip(&p).map(|(c, p)| c * p[derivative]).sum()
            };
            let worth = bat.worth_at(x);
            let share = 0.5 * (part[1] - part[0]) * weight;
            mass += share * worth.mass * of(modes[0], 0) * of(modes[1], 0);
            let bend = |mode| of(mode, 2) * (2.0 / h).powi(2);
            stiffness += share * worth.bending * bend(modes[0]) * bend(modes[1]);
        }
    }
    [mass, stiffness]
}

/// The masses are those of the returned shapes, strain energy over kinetic energy of these shapes is ω², and no two of
/// them have mass or stiffness in common: together this excludes every error.
#[test]
fn masses_and_frequencies_are_those_of_the_shapes() {
    for (bats, degree, tolerance) in [
        (unlike(), None, 1e-6),
        (unlike(), None, 1e-10),
        (unlike(), Some(4), 1e-6),
        (with_formulas(), None, 1e-6),
    ] {
        let request = Request { modes: 4, tolerance, degree, ..Request::plain() };
        for way in WAYS {
            for (bat, found) in bats.iter().zip(found(&bats, &request, way)) {
                for k in 0..request.modes {
                    let [mass, stiffness] = forms(bat, &found, [k, k]);
                    let off = found.masses[k] / mass - 1.0;
                    assert!(off.abs() < 1e-9, "{} mode {}: mass {off:e}", bat.name(), k + 1);
                    let off = (stiffness / mass).sqrt() / found.omegas[k] - 1.0;
                    assert!(off.abs() < 1e-8, "{} mode {}: ω {off:e}", bat.name(), k + 1);
                    assert!(found.tip(k) > 0.0);
                    let ends = found.ends(k);
                    assert!(ends.iter().flatten().all(|w| w.abs() <= 1.0 + 1e-12));
                    let jump = |pair: &[[f64; 2]]| (pair[0][1] - pair[1][0]).abs();
                    assert!(ends.windows(2).map(jump).fold(0.0, f64::max) < 1e-11);
                    for other in 0..k {
                        let [mass, stiffness] = forms(bat, &found, [k, other]);
                        let kinetic = (found.masses[k] * found.masses[other]).sqrt();
                        let strain = found.omegas[k] * found.omegas[other] * kinetic;
                        assert!(mass.abs() < 1e-7 * kinetic, "{} {k} {other}", bat.name());
                        assert!(stiffness.abs() < 1e-7 * strain, "{} {k} {other}", bat.name());
                    }
                }
            }
        }
    }
}

/// Every free mode of a uniform dowel, 1 at its tip, has a quarter of its mass.
#[test]
fn modal_masses_of_dowels_are_a_quarter_of_their_mass() {
    let dowels: Vec<Bat> = (0..19)
        .map(|k| {
            let radius = 0.015 + 1e-3 * f64::from(k);
            cone(radius, radius)
        })
        .collect();
    let request = Request { modes: 5, tolerance: 1e-12, ..Request::plain() };
    for way in WAYS {
        for (dowel, found) in dowels.iter().zip(found(&dowels, &request, way)) {
            for k in 0..request.modes {
                let mass = found.masses[k] / found.tip(k).powi(2);
                let off = 4.0 * mass / dowel.inertia().mass - 1.0;
                // The shape's error is the root of the frequency's.
                assert!(off.abs() < 3e-6, "mode {}: {off:e}", k + 1);
            }
        }
    }
}

/// On the requested mesh, with or without bats of another kind, the frequencies and the shapes at the ends of every
/// element agree with the single solve.
#[test]
fn an_asked_mesh_has_the_frequencies_and_shapes_of_the_bat_that_is_solved_alone() {
    for degree in [None, Some(4), Some(5), Some(10)] {
        let elements = Some(40);
        let request = Request { modes: 6, tolerance: 1e-9, elements, degree, ..Request::plain() };
        for bats in [unlike(), with_formulas()] {
            let alone: Vec<_> = bats.iter().map(|bat| solve(bat, &request).unwrap()).collect();
            for way in WAYS {
                for (solution, found) in alone.iter().zip(found(&bats, &request, way)) {
                    let omegas: Vec<f64> = solution.modes.iter().map(|mode| mode.omega).collect();
                    assert_near(&found.omegas, &omegas, 1e-9);
                    assert_eq!(found.degree, degree.unwrap_or(3));
                    for mode in &solution.modes {
                        assert_same_shape(&found, mode);
                    }
                }
            }
        }
    }
}

/// Equal deflections at both ends of every element, scaled to the same tip.
fn assert_same_shape(found: &Answer, mode: &Mode) {
    let (k, at) = (mode.order - 1, |x| mode.shape.deflection(x));
    for (ends, places) in found.ends(k).iter().zip(found.nodes.windows(2)) {
        for (w, x) in ends.iter().zip(places) {
            let off = w / found.tip(k) - at(*x) / at(mode.shape.length());
            assert!(off.abs() < 1e-7, "mode {} at {x}: {off:e}", mode.order);
        }
    }
}

/// A bat's numbers in any order of the bats after the first, which makes the plan, in any share,
/// and on any number of cores.
#[test]
fn results_do_not_depend_on_neighbours_or_cores() {
    // Another make in the middle: the eight around it go one by one.
    let mut bats = cones(600);
    bats[300] = bundled_bat("meshes/r161.json").unwrap();
    let request = Request { modes: 4, ..Request::plain() };
    for way in WAYS {
        let shares: Vec<_> = bats.chunks(256).flat_map(|bats| found(bats, &request, way)).collect();
        for threads in [1, 2, 8] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let on_cores = pool.install(|| all(&bats, &request, way, |_, found| answer(found)));
            assert!(on_cores == shares, "{way:?} on {threads}");
        }
        for (bats, shares) in bats.chunks(256).zip(shares.chunks(256)) {
            let mut turned = bats.to_vec();
            turned[1..].reverse();
            let mut again = found(&turned, &request, way);
            again[1..].reverse();
            assert!(again == shares, "{way:?}");
        }
    }
}

#[test]
fn nothing_and_too_little_are_told() {
    each(&[], &Request::plain(), Way::SideBySide, |_, _| panic!("there is no bat"));
    let few = Request { modes: 9, elements: Some(2), ..Request::plain() };
    let plain = Request::plain();
    for (request, says) in [
        (few, "at least 5 elements"),
        (Request { tolerance: 0.0, ..plain }, "tolerance: found 0"),
        (Request { tolerance: f64::NAN, ..plain }, "tolerance: found NaN"),
        (Request { degree: Some(13), ..plain }, "degree: found 13"),
        (Request { degree: Some(13), elements: Some(40), ..plain }, "degree: found 13"),
        (Request { elements: Some(0), ..plain }, "elements: found 0"),
        (Request { elements: Some(usize::MAX), ..plain }, "fewer elements"),
    ] {
        for way in WAYS {
            let mut places = Vec::new();
            each(&cones(19), &request, way, |place, found| {
                let told = found.unwrap_err().to_string();
                assert!(told.contains(says), "{told}");
                places.push(place);
            });
            assert!(places.into_iter().eq(0..19), "{says}");
        }
    }
}
