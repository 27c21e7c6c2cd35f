//! The cost of a proof compared with the plain solve of the same modes, in the same run.
//!
//! `cargo bench --bench guarantee` prints a table.

use std::hint::black_box;
use std::time::{Duration, Instant};

use sweetspot::modes::plan::Plan;
use sweetspot::{Request, Theory, solve};
use sweetspot_proof::bundled::bundled_bat;
use sweetspot_proof::enclosure::beam::{Layout, Proven};
use sweetspot_proof::enclosure::conclude::conclude;
use sweetspot_proof::enclosure::guarantee::guarantee;
use sweetspot_proof::enclosure::norms::Norms;
use sweetspot_proof::enclosure::trials::trials;

/// The best time over batches, with the jobs taken in turn so that all run under the same conditions.
fn side_by_side<const N: usize>(jobs: [&dyn Fn(); N]) -> [Duration; N] {
    let mut best = [Duration::MAX; N];
    for _ in 0..30 {
        for (best, job) in best.iter_mut().zip(jobs) {
            let started = Instant::now();
            job();
            *best = (*best).min(started.elapsed());
        }
    }
    best
}

fn main() {
    println!(
        "Ten modes to 1e-12: plain solve, proof alone (sections, energies, norms, conclusion), all of it"
    );
    println!(
        "{:<28} {:>10} {:>10} {:>7} {:>10} {:>7}  {:>8}",
        "", "solve", "proof", "", "all", "", "width"
    );
    for (name, file, theory) in [
        ("dowel", "meshes/dowel.json", Theory::EulerBernoulli),
        ("R161", "meshes/r161.json", Theory::EulerBernoulli),
        ("R161, Rayleigh", "meshes/r161.json", Theory::Rayleigh),
        ("R161, Timoshenko", "meshes/r161.json", Theory::Timoshenko),
        ("aluminium, Timoshenko", "meshes/northwestern_aluminium.json", Theory::Timoshenko),
    ] {
        let bat = bundled_bat(file).unwrap();
        let request = Request { tolerance: 1e-12, theory, ..Request::default() };
        let (solution, found) = guarantee(&bat, &request).unwrap();
        let plan = Plan { mesh: solution.mesh.clone(), degree: solution.degree, ..Plan::default() };
        let tried = trials(&bat, &plan, 16, theory).unwrap();
        let [plain, proof, all] = side_by_side([
            &|| drop(black_box(solve(&bat, &request).unwrap())),
            &|| {
                let layout = Layout::of(&bat, theory).unwrap();
                let norms = Norms::of(&bat, &layout, theory).unwrap();
                let proven = Proven::of(&bat, &layout, &plan.mesh, theory).unwrap();
                let energies: Vec<_> = tried.iter().map(|trial| proven.energies(trial)).collect();
                drop(black_box(conclude(&energies, &norms)));
            },
            &|| drop(black_box(guarantee(&bat, &request).unwrap())),
        ]);
        let over = |time: Duration| time.as_secs_f64() / plain.as_secs_f64();
        println!(
            "{name:<28} {plain:>10.1?} {proof:>10.1?} {:>6.1}x {all:>10.1?} {:>6.1}x  {:>8.1e}",
            over(proof),
            over(all),
            found.width()
        );
    }
}
