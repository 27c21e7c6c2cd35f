//! The time for the modes, compared with the dense and the shift-invert method in the same run.
//!
//! `cargo bench --bench modes` prints the tables, then Criterion's own statistics.

use std::hint::black_box;
use std::time::{Duration, Instant};

use criterion::{Criterion, criterion_group};
use sweetspot::bat::theory::Theory;
use sweetspot::{Bat, Request, Solution, Solver, solve};
use sweetspot_proof::bundled::bundled_bat;

/// Assembly, eigenpairs, shapes, nodes, modal masses and error estimates.
fn job(bat: &Bat, request: &Request) -> Solution {
    black_box(solve(black_box(bat), request).unwrap())
}

/// Times of several jobs, each the best over batches of ten, with the batches taken in turn so that all run under the
/// same conditions.
fn side_by_side<const N: usize>(batches: usize, jobs: [&dyn Fn(); N]) -> [Duration; N] {
    let mut best = [Duration::MAX; N];
    for _ in 0..batches {
        for (best, job) in best.iter_mut().zip(jobs) {
            let started = Instant::now();
            (0..10).for_each(|_| job());
            *best = (*best).min(started.elapsed() / 10);
        }
    }
    best
}

fn ratio(slow: Duration, fast: Duration) -> f64 {
    slow.as_secs_f64() / fast.as_secs_f64()
}

/// A fixed mesh: the running sums compared with the other solvers.
fn fixed_meshes() {
    let dowel = bundled_bat("meshes/dowel.json").unwrap();
    let r161 = bundled_bat("meshes/r161.json").unwrap();
    println!("Cubic elements, everything included: time, and how many times longer others take");
    println!("{:<34} {:>10} {:>8} {:>13}", "", "statics", "dense", "shift-invert");
    for (name, bat, elements, modes, runs) in [
        ("dowel, 40 elements, 6 modes", &dowel, 40, 6, 31),
        ("R161, 40 elements, 6 modes", &r161, 40, 6, 31),
        ("R161, 100 elements, 10 modes", &r161, 100, 10, 5),
        ("dowel, 400 elements, 10 modes", &dowel, 400, 10, 1),
    ] {
        let with = |solver| Request { modes, elements: Some(elements), solver, ..Request::plain() };
        let of = |solver| move || drop(job(bat, &with(solver)));
        let [fast, dense, sparse] = side_by_side(
            runs,
            [&of(Solver::Statics), &of(Solver::Dense), &of(Solver::ShiftInvert)],
        );
        println!(
            "{name:<34} {fast:>10.1?} {:>7.0}x {:>12.0}x",
            ratio(dense, fast),
            ratio(sparse, fast)
        );
    }
}

/// The cost of rotary inertia and shear at equal degree on the same mesh.
fn theories() {
    let r161 = bundled_bat("meshes/r161.json").unwrap();
    let dowel = bundled_bat("meshes/dowel.json").unwrap();
    // The wood of Nathan's R161 in shear.
    let dowel = dowel.with(|parts| parts.material.shear_modulus = Some(1.05e9)).unwrap();
    println!("\nTheories on one mesh, everything included: time, and how many times as long");
    println!("{:<34} {:>15} {:>9} {:>11}", "", "Euler-Bernoulli", "Rayleigh", "Timoshenko");
    for (name, bat, elements, degree, modes) in [
        ("dowel, 40 x p3, 6 modes", &dowel, 40, 3, 6),
        ("dowel, 8 x p9, 6 modes", &dowel, 8, 9, 6),
        ("R161, 40 x p3, 10 modes", &r161, 40, 3, 10),
        ("R161, 31 x p5, 10 modes", &r161, 31, 5, 10),
        ("R161, 31 x p8, 10 modes", &r161, 31, 8, 10),
    ] {
        let of = |theory| {
            let (elements, degree) = (Some(elements), Some(degree));
            let request = Request { modes, elements, degree, theory, ..Request::default() };
            move || drop(job(bat, &request))
        };
        let [plain, rayleigh, timoshenko] = side_by_side(
            31,
            [&of(Theory::EulerBernoulli), &of(Theory::Rayleigh), &of(Theory::Timoshenko)],
        );
        println!(
            "{name:<34} {plain:>15.1?} {:>8.2}x {:>10.2}x",
            ratio(rayleigh, plain),
            ratio(timoshenko, plain)
        );
    }
}

/// The cost of a digit: five modes of the cone r 12.5 to 33 mm, each solver at the same accuracy.
fn prices() {
    let cone = bundled_bat("meshes/cone.json").unwrap();
    let exact = solve(&cone, &Request { modes: 5, tolerance: 1e-13, ..Request::plain() }).unwrap();
    println!("\nFive modes of a cone within a tolerance, everything included, and how many times");
    println!("longer the other solvers take on the cubic mesh that is as accurate");
    println!(
        "{:<8} {:>9} {:>10} {:>10} {:>8} {:>8} {:>13}",
        "asked", "elements", "true error", "statics", "cubics", "dense", "shift-invert"
    );
    for digits in [2, 4, 6, 8, 10, 12] {
        let request = Request { modes: 5, tolerance: 10f64.powi(-digits), ..Request::plain() };
        let found = job(&cone, &request);
        let errors =
            found.modes.iter().zip(&exact.modes).map(|(a, b)| (a.omega / b.omega - 1.0).abs());
        let error = errors.fold(0.0, f64::max);
        let cubic = job(&cone, &Request { degree: Some(3), ..request }).mesh.len();
        let with = |solver| Request { elements: Some(cubic), solver, ..request };
        let planned = || drop(job(&cone, &request));
        let dense = || drop(job(&cone, &with(Solver::Dense)));
        let sparse = || drop(job(&cone, &with(Solver::ShiftInvert)));
        // Beyond a few hundred elements a factored K is less accurate than requested.
        let times = match cubic {
            ..=200 => side_by_side(21, [&planned, &dense, &sparse]),
            _ => {
                let [fast] = side_by_side(41, [&planned]);
                let started = Instant::now();
                if digits <= 8 {
                    dense();
                }
                let slow = started.elapsed();
                let [sparse] = side_by_side(1, [&sparse]);
                [fast, if digits <= 8 { slow } else { Duration::ZERO }, sparse]
            }
        };
        let [fast, dense, sparse] = times;
        let shown = |slow: Duration| {
            if slow.is_zero() { "-".to_owned() } else { format!("{:.0}x", ratio(slow, fast)) }
        };
        println!(
            "{:<8} {:>9} {error:>10.1e} {fast:>10.1?} {cubic:>8} {:>8} {:>13}",
            format!("1e-{digits}"),
            format!("{} x p{}", found.mesh.len(), found.degree),
            shown(dense),
            shown(sparse)
        );
    }
    let r161 = bundled_bat("meshes/r161.json").unwrap();
    let [whole] = side_by_side(31, [&|| drop(job(&r161, &Request::plain()))]);
    println!("R161, 10 modes certified to 1e-4: {whole:.1?}\n");
}

fn modes(criterion: &mut Criterion) {
    let dowel = bundled_bat("meshes/dowel.json").unwrap();
    for (elements, modes) in [(64, 6), (1024, 10)] {
        let request = Request { modes, elements: Some(elements), ..Request::plain() };
        let name = format!("dowel, {elements} elements, {modes} modes, statics");
        criterion.bench_function(&name, |b| b.iter(|| job(&dowel, &request)));
    }
    let request =
        Request { modes: 6, elements: Some(64), solver: Solver::Dense, ..Request::plain() };
    criterion.bench_function("dowel, 64 elements, 6 modes, dense", |b| {
        b.iter(|| job(&dowel, &request));
    });
}

criterion_group!(benches, modes);

fn main() {
    fixed_meshes();
    theories();
    prices();
    benches();
    Criterion::default().configure_from_args().final_summary();
}
