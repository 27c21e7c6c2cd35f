//! How fast the modes come, side by side with the dense path in the same run.
//!
//! `cargo bench` prints the table of ratios, then Criterion's own statistics.

use std::hint::black_box;
use std::time::{Duration, Instant};

use criterion::{Criterion, criterion_group};
use sweetspot::beam::mesh::Mesh;
use sweetspot::plan::uncertified;
use sweetspot::validation::bundled_bat;
use sweetspot::{Bat, Request, Solver, solve};

fn request(modes: usize, solver: Solver) -> Request {
    Request { modes, solver, ..Request::default() }
}

/// Assembly, eigenvalues, shapes, nodes and modal masses on a mesh of n elements.
fn job(bat: &Bat, elements: usize, modes: usize, solver: Solver) {
    let mesh = Mesh::along(bat, elements);
    black_box(uncertified(black_box(bat), &mesh, &request(modes, solver)).unwrap());
}

/// Median times of two jobs run in turn, so that both meet the same machine.
fn side_by_side(runs: usize, a: impl Fn(), b: impl Fn()) -> [Duration; 2] {
    let time = |job: &dyn Fn()| {
        let started = Instant::now();
        job();
        started.elapsed()
    };
    let (mut of_a, mut of_b) = (Vec::new(), Vec::new());
    for _ in 0..runs {
        of_a.push(time(&a));
        of_b.push(time(&b));
    }
    of_a.sort();
    of_b.sort();
    [of_a[runs / 2], of_b[runs / 2]]
}

fn ratios() {
    let dowel = bundled_bat("meshes/dowel.json").unwrap();
    let r161 = bundled_bat("meshes/r161.json").unwrap();
    println!(
        "{:<34} {:>12} {:>12} {:>8}",
        "modes with shapes, assembly in", "statics", "dense", "ratio"
    );
    for (name, bat, elements, modes, runs) in [
        ("dowel, 40 elements, 6 modes", &dowel, 40, 6, 400),
        ("R161, 40 elements, 6 modes", &r161, 40, 6, 400),
        ("R161, 100 elements, 10 modes", &r161, 100, 10, 50),
        ("dowel, 400 elements, 10 modes", &dowel, 400, 10, 3),
    ] {
        let [fast, slow] = side_by_side(
            runs,
            || job(bat, elements, modes, Solver::Statics),
            || job(bat, elements, modes, Solver::Dense),
        );
        let ratio = slow.as_secs_f64() / fast.as_secs_f64();
        println!("{name:<34} {fast:>12.1?} {slow:>12.1?} {ratio:>8.1}");
    }
    let [many, whole] = side_by_side(
        3,
        || job(&dowel, 100_000, 10, Solver::Statics),
        || {
            black_box(solve(&r161, &request(10, Solver::Statics)).unwrap());
        },
    );
    println!("dowel, 100000 elements, 10 modes: {many:.1?}");
    println!("R161, 10 modes certified to 1e-4: {whole:.1?}\n");
}

fn modes(criterion: &mut Criterion) {
    let dowel = bundled_bat("meshes/dowel.json").unwrap();
    for (elements, modes) in [(64, 6), (1024, 10)] {
        let name = format!("dowel, {elements} elements, {modes} modes, statics");
        criterion.bench_function(&name, |b| {
            b.iter(|| job(&dowel, elements, modes, Solver::Statics));
        });
    }
    criterion.bench_function("dowel, 64 elements, 6 modes, dense", |b| {
        b.iter(|| job(&dowel, 64, 6, Solver::Dense));
    });
}

criterion_group!(benches, modes);

fn main() {
    ratios();
    benches();
    Criterion::default().configure_from_args().final_summary();
}
