//! Number of bats solved in a second: random variations of a real bat by every theory, with a weight on the knob, a
//! scan of it, hits; and random tapered bats.
//!
//! `cargo bench --bench throughput` prints the tables. The two methods take turns so that both run under the same
//! conditions, and every time is the best of the turns.

use std::hint::black_box;
use std::time::Instant;

use sweetspot::base::threads::with;
use sweetspot::bat::fixtures::{Attachment, Fixtures};
use sweetspot::bat::material::Material;
use sweetspot::bat::profile::{Interpolation, Profile, Stations};
use sweetspot::collision::batch::{Blow, each as strike_each};
use sweetspot::collision::sweep::{Accuracy, Sweep, Trial, sweep};
use sweetspot::collision::{Model, Scene};
use sweetspot::modes::batch::{Way, all, each};
use sweetspot::{Bat, Request, Theory};
use sweetspot_proof::bundled::bundled_bat;

const BATS: usize = 10_000;
const TURNS: usize = 15;

/// Evenly distributed numbers between two bounds.
fn uniform() -> impl FnMut(f64, f64) -> f64 {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    move |from: f64, to: f64| {
        // Steele, Lea and Flood's SplitMix64.
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        let unit = ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64;
        from + (to - from) * unit
    }
}

/// The profile of the R161 with that number of stations; each bat has another wood and length, and a weight on the knob
/// if one is given (kg).
fn variations(count: usize, stations: usize, weight: f64) -> Vec<Bat> {
    let r161 = bundled_bat("meshes/r161.json").expect("a bundled bat");
    let mut uniform = uniform();
    let own = r161.profile().stations.clone();
    let bat = |_| {
        let stretched = uniform(0.97, 1.03);
        let mut profile = own.clone();
        if stations > 0 {
            // As a scanner writes it: to a hundredth of a millimetre.
            let places = (0..stations).map(|k| k as f64 / (stations - 1) as f64);
            profile.x = places.map(|s| s * r161.length()).collect();
            let radius = |x: &f64| (r161.profile().at(*x).outer * 1e5).round() / 1e5;
            profile.outer = profile.x.iter().map(radius).collect();
            profile.inner = vec![0.0; stations];
        }
        profile.x.iter_mut().for_each(|x| *x *= stretched);
        let mut material = Material::new(uniform(600.0, 720.0), uniform(11e9, 16e9)).unwrap();
        material.shear_modulus = Some(uniform(0.7e9, 1.2e9));
        let knob = Attachment { x: 0.0, mass: weight, ..Attachment::default() };
        let attachments = if weight > 0.0 { vec![knob] } else { vec![] };
        let fixtures = Fixtures { attachments, ..Fixtures::default() };
        Bat::builder(Profile::new(profile).unwrap(), material).fixtures(fixtures).build().unwrap()
    };
    (0..count).map(bat).collect()
}

/// Cones of ash: handle 9 to 16 mm, barrel 25 to 36 mm in radius, 0.74 to 0.90 m long.
fn random_bats() -> Vec<Bat> {
    let mut uniform = uniform();
    let bat = |_| {
        let stations = Stations {
            x: vec![0.0, uniform(0.74, 0.90)],
            outer: vec![uniform(0.009, 0.016), uniform(0.025, 0.036)],
            inner: vec![0.0; 2],
            interpolation: Interpolation::Linear,
        };
        let material = Material::new(uniform(600.0, 720.0), uniform(11e9, 16e9)).unwrap();
        Bat::builder(Profile::new(stations).unwrap(), material).name("random").build().unwrap()
    };
    (0..BATS).map(bat).collect()
}

/// Seconds for all bats.
fn time(job: impl Fn()) -> f64 {
    let started = Instant::now();
    job();
    started.elapsed().as_secs_f64()
}

fn frequencies(bats: &[Bat], request: &Request, way: Way) -> Vec<f64> {
    let mut all = Vec::with_capacity(bats.len() * request.modes);
    each(bats, request, way, |_, found| all.extend(found.unwrap().omegas));
    all
}

/// Bats per second, ten modes within 1e-4, one core; and the ratio of the time to that of the plain bat.
fn of_modes() {
    println!(
        "{:<40} {:>12} {:>12} {:>8}",
        "10 modes within 1e-4, bats a second", "one by one", "side by side", "times"
    );
    let kinds = [
        ("R161", variations(1000, 0, 0.0)),
        ("  30 g on the knob", variations(1000, 0, 0.03)),
        ("  scanned at 1000 places", variations(200, 1000, 0.0)),
    ];
    let cases = kinds.iter().flat_map(|kind| Theory::ALL.map(|theory| (kind, theory)));
    let mut cases: Vec<_> = cases.map(|case| (case, [f64::INFINITY; 2])).collect();
    // Kinds and theories also take turns, so that they can be compared.
    for _ in 0..TURNS {
        for (((_, bats), theory), best) in &mut cases {
            let request =
                Request { modes: 10, tolerance: 1e-4, theory: *theory, ..Request::default() };
            for (best, way) in best.iter_mut().zip([Way::OneByOne, Way::SideBySide]) {
                let seen = |_: usize, f: sweetspot::Result<sweetspot::modes::batch::Found>| {
                    black_box(f.unwrap().shapes[0]);
                };
                *best = best.min(time(|| each(bats, &request, way, seen)) / bats.len() as f64);
            }
        }
    }
    for (k, (((name, _), theory), [one, side])) in cases.iter().enumerate() {
        let plain = cases[k % Theory::ALL.len()].1[1];
        let name = format!("{name}, {}", theory.name());
        let [one_rate, side_rate] = [one, side].map(|seconds| (1.0 / seconds).round());
        println!("{name:<40} {one_rate:>12} {side_rate:>12} {:>8.2}", side / plain);
    }
}

/// Bats a second hit at eleven places within 1e-4, with errors and ledger, one core.
fn of_hits() {
    println!(
        "{:<40} {:>12} {:>12} {:>12}",
        "hits at 11 places, bats a second", "each alone", "one by one", "side by side"
    );
    let bats = variations(96, 0, 0.0);
    let places: Vec<Vec<f64>> = bats.iter().map(along).collect();
    let scene = Scene::default();
    let trial = Trial { model: Model::Contact, scene: &scene };
    for theory in Theory::ALL {
        let accuracy = Accuracy { theory, ..Accuracy::default() };
        let seen = |hits: Sweep| {
            assert!(hits.met());
            black_box(hits);
        };
        let blow = |(bat, places)| Blow { bat, trial, accuracy, places };
        let blows: Vec<Blow> =
            bats.iter().zip(places.iter().map(Vec::as_slice)).map(blow).collect();
        let mut best = [f64::INFINITY; 3];
        for _ in 0..TURNS {
            best[0] = best[0].min(time(|| {
                for (bat, places) in bats.iter().zip(&places) {
                    seen(sweep(bat, Model::Contact, &scene, &accuracy, places).unwrap());
                }
            }));
            for (best, way) in best[1..].iter_mut().zip([Way::OneByOne, Way::SideBySide]) {
                let job = || strike_each(&bats[0], &blows, way, |_, hits| seen(hits.unwrap()));
                *best = best.min(time(job));
            }
        }
        let [alone, one, side] = best.map(|seconds| (bats.len() as f64 / seconds).round());
        println!("{:<40} {alone:>12} {one:>12} {side:>12}", theory.name());
    }
}

/// Eleven places (m) from the middle of the barrel to near its tip.
fn along(bat: &Bat) -> Vec<f64> {
    (0..11).map(|k| bat.length() * (0.6 + 0.035 * f64::from(k))).collect()
}

fn main() {
    of_modes();
    with(Some(1), of_hits);
    let bats = random_bats();
    let planned = Request { modes: 6, tolerance: 1e-4, ..Request::plain() };
    let fixed = Request { elements: Some(40), degree: Some(3), ..planned };
    println!("{BATS} random tapered bats, 6 modes with shapes\n");
    println!("{:<34} {:>12} {:>12} {:>8}", "bats a second", "one by one", "side by side", "ratio");
    for (name, request) in
        [("errors within 1e-4, certified", planned), ("40 cubic elements", fixed)]
    {
        let [mut one, mut side, mut cores] = [f64::INFINITY; 3];
        for _ in 0..TURNS {
            let job = |way| {
                time(|| {
                    each(&bats, &request, way, |_, f| {
                        black_box(f.unwrap().shapes[0]);
                    })
                })
            };
            one = one.min(job(Way::OneByOne));
            side = side.min(job(Way::SideBySide));
            cores = cores.min(time(|| {
                black_box(all(&bats, &request, Way::SideBySide, |_, f| f.unwrap().omegas[0]));
            }));
        }
        let rate = |seconds: f64| (BATS as f64 / seconds).round();
        println!(
            "{:<34} {:>12} {:>12} {:>8.2}",
            format!("{name}, one core"),
            rate(one),
            rate(side),
            one / side
        );
        println!("{:<34} {:>12} {:>12} {:>8.2}", "  all cores", "", rate(cores), side / cores);
        let (a, b) = (
            frequencies(&bats, &request, Way::OneByOne),
            frequencies(&bats, &request, Way::SideBySide),
        );
        assert!(a == b, "one by one and side by side have the same bits");
    }
}
