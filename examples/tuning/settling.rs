//! Does every round of finer steps improve an exit speed? The basis of `IDLE`, `IDLE_DEAD` and `DEAD` of a sweep and of
//! `BLURRED` of its rounds.
//!
//!     cargo run --release --example tuning_settling
//!
//! First, for balls of decreasing restitution, the largest stated error along three bats with steps ten times finer,
//! relative to that of the round before. A speed that converges falls to a tenth or less in two rounds; one that
//! magnifies round-off does not fall. Then the change of the stated error due to missing modes with finer steps, by the
//! ratio of the error of the steps to it: the compared answers differ by both.

use std::time::Instant;

use sweetspot::collision::{Effort, Hitter, Model, Outcome, Scene};
use sweetspot::{Bat, Request, Result, solve};

const BATS: [&str; 3] = ["meshes/dowel.json", "meshes/r161.json", "meshes/torpedo.json"];
const RESTITUTIONS: [f64; 8] = [0.5, 0.3, 0.2, 0.1, 0.05, 0.03, 0.01, 0.005];
const ACCURACIES: [f64; 6] = [1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9];
const PLACES: usize = 16;
const SHARES: [f64; 7] = [1.0, 0.1, 0.03, 0.01, 0.003, 0.001, 0.0];

/// The largest error of one kind.
fn worst(outcomes: &[Option<Outcome>], of: fn(&Outcome) -> f64) -> f64 {
    outcomes.iter().flatten().map(of).fold(0.0, f64::max)
}

fn main() -> Result<()> {
    let mut blurred = [0.0_f64; SHARES.len()];
    print!("{:<20}{:>6}{:>10}", "bat", "COR", ACCURACIES[0]);
    ACCURACIES[1..].iter().for_each(|accuracy| print!("{accuracy:>8.0e}"));
    println!("   seconds");
    for path in BATS {
        let bat = Bat::from_file(path)?;
        let request = Request { modes: 20, tolerance: 1e-9, ..Request::plain() };
        let solution = solve(&bat, &request)?;
        for cor in RESTITUTIONS {
            let scene = Scene { swing: 50.0, ball_speed: 40.0, cor, ..Scene::default() };
            print!("{:<20}{cor:>6}", path.trim_start_matches("meshes/"));
            let started = Instant::now();
            let mut before: Option<Vec<Option<Outcome>>> = None;
            for accuracy in ACCURACIES {
                let effort = Effort { accuracy, completed: true, unsettled: false };
                let hitter = Hitter::new(Model::Contact, &scene, &bat, &solution, effort)?;
                let place = |k: usize| bat.length() * (0.5 + 0.49 * k as f64 / PLACES as f64);
                let now: Vec<_> = (0..PLACES).map(|k| hitter.strike(place(k)).outcome).collect();
                let error = worst(&now, |outcome| outcome.error - outcome.truncation);
                match &before {
                    None => print!("{error:>10.1e}"),
                    Some(rough) => {
                        print!("{:>8.2}", error / worst(rough, |o| o.error - o.truncation));
                        for (rough, fine) in rough.iter().zip(&now) {
                            let (Some(rough), Some(fine)) = (rough, fine) else { continue };
                            let share = rough.steps / rough.truncation;
                            let above = SHARES.iter().position(|least| share >= *least);
                            let change = (rough.truncation / fine.truncation).ln().abs().exp();
                            if let Some(most) = above.map(|k| &mut blurred[k]) {
                                *most = most.max(change);
                            }
                        }
                    }
                }
                before = Some(now);
            }
            println!("{:>10.2}", started.elapsed().as_secs_f64());
        }
    }
    println!("steps' share of the error of modes left out, and the largest factor of its change");
    for (share, change) in SHARES.iter().zip(blurred) {
        println!("from {share:7.0e} on{change:10.2}");
    }
    Ok(())
}
