//! How fast the modes come, side by side with the dense path in the same run.
//!
//! `cargo bench` prints the table of ratios, then Criterion's own statistics.

use std::hint::black_box;
use std::time::{Duration, Instant};

use criterion::{Criterion, criterion_group};
use sweetspot::beam::assembly::Pencil;
use sweetspot::beam::element;
use sweetspot::beam::mesh::Mesh;
use sweetspot::beam::statics::Statics;
use sweetspot::eigen::{dense, lanczos};
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

/// Assembly and eigenpairs only, by the running sums.
fn statics_pairs(bat: &Bat, elements: usize, modes: usize) {
    let statics = Statics::new(&element::elements(black_box(bat), &Mesh::along(bat, elements)));
    let mut loads = Vec::new();
    let apply = |x: &[f64], y: &mut [f64]| {
        statics.apply(x, y, &mut loads);
    };
    black_box(lanczos::largest(statics.start(modes), modes, 1e-7, apply).unwrap());
}

/// Assembly and eigenpairs only, by the dense solver.
fn dense_pairs(bat: &Bat, elements: usize) {
    let elements = element::elements(black_box(bat), &Mesh::along(bat, elements));
    let pencil = Pencil::assemble(&elements);
    black_box(dense::generalized(&pencil.stiffness, &pencil.mass, 2e6).unwrap());
}

/// Times of two jobs, each the median over batches of ten, the batches taken in turn so that both
/// meet the same machine.
fn side_by_side(batches: usize, a: impl Fn(), b: impl Fn()) -> [Duration; 2] {
    const BATCH: u32 = 10;
    let time = |job: &dyn Fn()| {
        let started = Instant::now();
        (0..BATCH).for_each(|_| job());
        started.elapsed() / BATCH
    };
    let (mut of_a, mut of_b) = (Vec::new(), Vec::new());
    for _ in 0..batches {
        of_a.push(time(&a));
        of_b.push(time(&b));
    }
    of_a.sort();
    of_b.sort();
    [of_a[batches / 2], of_b[batches / 2]]
}

fn ratios() {
    let dowel = bundled_bat("meshes/dowel.json").unwrap();
    let r161 = bundled_bat("meshes/r161.json").unwrap();
    let row = |name: &str, [fast, slow]: [Duration; 2]| {
        let ratio = slow.as_secs_f64() / fast.as_secs_f64();
        println!("{name:<40} {fast:>10.1?} {slow:>10.1?} {ratio:>7.1}");
    };
    println!("{:<40} {:>10} {:>10} {:>7}", "", "statics", "dense", "ratio");
    println!("assembly and eigenpairs");
    for (name, bat) in [("dowel", &dowel), ("R161", &r161)] {
        let times = side_by_side(61, || statics_pairs(bat, 40, 6), || dense_pairs(bat, 40));
        row(&format!("  {name}, 40 elements, 6 modes"), times);
    }
    println!("the same with shapes, nodes, modal masses, residuals");
    for (name, bat, elements, modes, runs) in [
        ("dowel, 40 elements, 6 modes", &dowel, 40, 6, 61),
        ("R161, 40 elements, 6 modes", &r161, 40, 6, 61),
        ("R161, 100 elements, 10 modes", &r161, 100, 10, 11),
        ("dowel, 400 elements, 10 modes", &dowel, 400, 10, 1),
    ] {
        let times = side_by_side(
            runs,
            || job(bat, elements, modes, Solver::Statics),
            || job(bat, elements, modes, Solver::Dense),
        );
        row(&format!("  {name}"), times);
    }
    let [many, whole] = side_by_side(
        1,
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
