//! How far is the first plan from the wanted accuracy, and how much does a higher degree improve it? The basis of
//! `AIM`, `LITTLE` and the residual of `modes::plan`, `modes::request`.
//!
//!     cargo run --release --example tuning_plans
//!
//! The stated error of the first plan of each bat, as a share of the wanted one: with the residual at which the
//! iteration stops, with the smallest possible residual, and with one degree more on the same elements (degree 12 is
//! the highest and is kept).

use std::time::Instant;

use sweetspot::modes::plan::Plan;
use sweetspot::modes::request::{CONVERGED, stop_at, wanted};
use sweetspot::modes::solution::{Solution, Timing};
use sweetspot::modes::task::Task;
use sweetspot::{Bat, Request, Result, Theory};

/// The solution on that plan, and the shortest of several times (s).
fn on(bat: &Bat, plan: &Plan, request: &Request, residual: f64) -> Result<(Solution, f64)> {
    let task = Task { bat, plan, request, residual };
    let mut shortest = f64::INFINITY;
    for _ in 0..10 {
        let started = Instant::now();
        task.run(&mut Timing::default())?;
        shortest = shortest.min(started.elapsed().as_secs_f64());
    }
    let answer = task.run(&mut Timing::default())?;
    Ok((answer.solution(plan.clone(), request, Timing::default()).0, shortest))
}

fn main() -> Result<()> {
    println!("{:24} {:16} wanted  stated  converged  degree more (times)", "bat", "theory");
    for name in ["dowel", "cone", "r161", "torpedo", "northwestern_aluminium", "tanh"] {
        let bat = Bat::from_file(format!("meshes/{name}.json"))?;
        for theory in [Theory::EulerBernoulli, Theory::Timoshenko] {
            if theory.shears() && !bat.knows_shear() {
                continue;
            }
            for digits in [3, 5, 7, 9, 11] {
                let tolerance = 10f64.powi(-digits);
                let request = Request { tolerance, theory, ..Request::default() };
                let plan = Plan::cheapest(&bat, &wanted(&request));
                let more = Plan { degree: (plan.degree + 1).min(12), ..plan.clone() };
                let (stopped, time) = on(&bat, &plan, &request, stop_at(&request))?;
                let (converged, _) = on(&bat, &plan, &request, CONVERGED)?;
                let (finer, longer) = on(&bat, &more, &request, stop_at(&request))?;
                let share = |solution: &Solution| solution.worst() / tolerance;
                println!(
                    "{name:24} {:16}  1e-{digits:02}  {:6.3}  {:9.3}  {:10.5} ({:.2})",
                    theory.name(),
                    share(&stopped),
                    share(&converged),
                    share(&finer),
                    longer / time
                );
            }
        }
    }
    Ok(())
}
