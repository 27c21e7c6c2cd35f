//! Speed of the hoop modes of a barrel, and of the compliance of its wall under a ball, on one processor.
//!
//! `RAYON_NUM_THREADS=1 cargo bench --bench hoop`.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use sweetspot::bat::formula::Formula;
use sweetspot::bat::profile::FormulaPiece;
use sweetspot::modes::hoop::response::{Fineness, Response};
use sweetspot::modes::hoop::{Hoop, HoopRequest, Patch};
use sweetspot::{Bat, Material, Profile};

/// A made-up baseball bat, its barrel 3 mm thick and open at the tip.
fn barrel() -> Bat {
    let taper = "0.0115 + 0.0218*(3*((x - 0.28)/0.3)^2 - 2*((x - 0.28)/0.3)^3)";
    let bore = format!("{taper} - (0.0026 + 0.0004*(x - 0.28)/0.3)");
    let piece = |from, to, outer: &str, inner: &str| {
        let [outer, inner] = [outer, inner].map(|text| Formula::parse(text).unwrap());
        FormulaPiece { from, to, outer, inner: Some(inner) }
    };
    let pieces = vec![
        piece(0.0, 0.28, "0.0115", "0.0089"),
        piece(0.28, 0.58, taper, &bore),
        piece(0.58, 0.8382, "0.0333", "0.0303"),
    ];
    let mut metal = Material::new(2810.0, 71e9).unwrap();
    metal.poisson_ratio = Some(0.33);
    Bat::builder(Profile::from_formulas(pieces).unwrap(), metal).build().unwrap()
}

fn hoops(criterion: &mut Criterion) {
    let bat = barrel();
    // n = 4 begins at 10 kHz, beyond the tenth mode.
    let ten =
        HoopRequest { harmonics: vec![2, 3], up_to_hz: 6500.0, least: 1, ..HoopRequest::default() };
    criterion.bench_function("first ten hoop modes within 1e-4", |bencher| {
        bencher.iter(|| Hoop::of(black_box(&bat), &ten).unwrap());
    });
    criterion.bench_function("all harmonics to 12 kHz within 1e-4", |bencher| {
        bencher.iter(|| Hoop::of(black_box(&bat), &HoopRequest::default()).unwrap());
    });
    let finest = HoopRequest { tol: 1e-8, ..ten.clone() };
    criterion.bench_function("first ten hoop modes within 1e-8", |bencher| {
        bencher.iter(|| Hoop::of(black_box(&bat), &finest).unwrap());
    });
    let mut few = bat.clone();
    criterion.bench_function("the wall of a hit within 1e-4", |bencher| {
        bencher.iter(|| {
            // Another wall each time, because a known wall is not solved again.
            few = few
                .with(|parts| {
                    parts.material.poisson_ratio = parts.material.poisson_ratio.map(|nu| nu - 1e-9)
                })
                .unwrap();
            Response::of(black_box(&few), Fineness::for_exit_speed(1e-4)).unwrap()
        });
    });
    let response = Response::of(&bat, Fineness::for_exit_speed(1e-4)).unwrap();
    let patch = Patch::under(0.6858, 0.0366, 0.0333, 0.008);
    criterion.bench_function("the wall under a ball", |bencher| {
        bencher.iter(|| response.under(black_box(&patch)));
    });
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20);
    targets = hoops
}
criterion_main!(benches);
