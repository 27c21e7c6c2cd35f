//! How many bats a second: 10,000 random tapered bats, 6 modes with shapes.
//!
//! `cargo bench --bench throughput` prints the table; the two ways take turns, so that both meet
//! the same machine, and every time is the best of the turns.

use std::hint::black_box;
use std::time::Instant;

use sweetspot::bat::material::Material;
use sweetspot::bat::profile::{Interpolation, Profile, Stations};
use sweetspot::modes::batch::{Way, all, each};
use sweetspot::{Bat, Request};

const BATS: usize = 10_000;
const TURNS: usize = 7;

/// Cones of ash: handle 9 to 16 mm, barrel 25 to 36 mm in radius, 0.74 to 0.90 m long.
fn random_bats() -> Vec<Bat> {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut uniform = move |from: f64, to: f64| {
        // Steele, Lea and Flood's SplitMix64.
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        let unit = ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64;
        from + (to - from) * unit
    };
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

fn main() {
    let bats = random_bats();
    let planned = Request { modes: 6, tolerance: 1e-4, ..Request::default() };
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
        let apart = a.iter().zip(&b).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max);
        println!("{:<34} {apart:.1e}", "  frequencies differ by at most");
    }
}
