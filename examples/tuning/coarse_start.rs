//! From how many unknowns on does a coarse solution pay as a start? Behind `modes::request::LARGE`.
//!
//!     cargo run --release --example tuning_coarse_start
//!
//! Steps and seconds for ten modes on cubic elements from the usual start, and from the bending moments of
//! a coarse solution, whose own time counts.

use std::time::Instant;

use sweetspot::modes::plan::Plan;
use sweetspot::modes::request::{Request, stop_at};
use sweetspot::modes::solution::Timing;
use sweetspot::modes::task::{Moments, Task};
use sweetspot::{Bat, Result, solve};

fn main() -> Result<()> {
    let bat = Bat::from_file("meshes/r161.json")?;
    println!("unknowns  steps  seconds  steps  seconds, from a coarse solution");
    for elements in [1000, 3000, 5000, 10_000, 20_000, 50_000, 100_000] {
        let request = Request { elements: Some(elements), ..Request::default() };
        let plan = Plan::fixed(&bat, elements, 3);
        let run = |coarse: Option<&Moments>| -> Result<usize> {
            let residual = stop_at(&request);
            let task = Task { bat: &bat, plan: &plan, request: &request, residual, coarse };
            let answer = task.run(&mut Timing::default())?;
            Ok(answer.solution(plan.clone(), &request, Timing::default()).0.steps)
        };
        let started = Instant::now();
        let usual = run(None)?;
        let of_usual = started.elapsed().as_secs_f64();
        let started = Instant::now();
        let small = solve(&bat, &Request { tolerance: 1e-12, elements: None, ..request })?;
        let coarse = run(Some(&Moments::of(&bat, &small)))?;
        let of_coarse = started.elapsed().as_secs_f64();
        println!("{:8} {usual:6} {of_usual:8.4} {coarse:6} {of_coarse:8.4}", plan.unknowns());
    }
    Ok(())
}
