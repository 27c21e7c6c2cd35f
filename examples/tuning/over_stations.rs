//! What is the cost of elements that extend over stations? The basis of the formula of `modes::stations` and of `SURE`,
//! `OVER`, `SAMPLING` of `modes::plan`.
//!
//!     cargo run --release --example tuning_over_stations [BAT.json ...]
//!
//! First equal elements over the stations of each bat: the relative error of its fifth frequency, true, stated, and by
//! the formula for kinks alone. Then plans of every degree and the cheapest: elements, degree, unknowns, the true and
//! the stated error as a share of the wanted one, and the times in total, for the plan, and on the mesh (µs).

use std::time::Instant;

use sweetspot::beam::mesh::Mesh;
use sweetspot::modes::plan::Plan;
use sweetspot::modes::request::{CONVERGED, stop_at, wanted};
use sweetspot::modes::solution::{Solution, Timing};
use sweetspot::modes::stations::Stations;
use sweetspot::modes::survey::Survey;
use sweetspot::modes::task::Task;
use sweetspot::{Bat, Request, Result, Theory, solve};

const BATS: [&str; 6] =
    ["r161", "torpedo", "cone", "northwestern_wood", "northwestern_aluminium", "two_piece"];

fn on(bat: &Bat, plan: &Plan, request: &Request, residual: f64) -> Result<Solution> {
    let task = Task { bat, plan, request, residual };
    Ok(task.run(&mut Timing::default())?.solution(plan.clone(), request, Timing::default()).0)
}

fn shortest(mut work: impl FnMut()) -> f64 {
    let time = |_| {
        let started = Instant::now();
        work();
        1e6 * started.elapsed().as_secs_f64()
    };
    (0..200).map(time).fold(f64::INFINITY, f64::min)
}

/// The largest relative difference of frequencies.
fn off(found: &Solution, exact: &Solution) -> f64 {
    let pairs = found.modes.iter().zip(&exact.modes);
    pairs.map(|(a, b)| (a.omega / b.omega - 1.0).abs()).fold(0.0, f64::max)
}

fn kinks(bat: &Bat, theory: Theory) -> Result<()> {
    let request = Request { modes: 5, theory, ..Request::default() };
    let exact = solve(bat, &Request { tolerance: 1e-13, ..request })?;
    let phase = 5.5 * std::f64::consts::PI;
    let Some(stations) = Stations::of(bat, &Survey::of(bat, theory, phase)) else { return Ok(()) };
    for degree in [4, 6, 8, 10, 12] {
        for elements in [2, 4, 8] {
            let place = |j: usize| {
                let x = bat.length() * j as f64 / elements as f64;
                let pieces = &bat.profile().pieces;
                let k = pieces.partition_point(|piece| piece.start < x).max(1) - 1;
                (k, (x - pieces[k].start) / pieces[k].length)
            };
            let mut places: Vec<(usize, f64)> = (0..elements).map(place).collect();
            places.push((bat.profile().pieces.len() - 1, 1.0));
            let mesh = Mesh::between(bat, &places);
            let plan = Plan { mesh, degree, ..Plan::default() };
            if plan.unknowns() < 7 {
                continue;
            }
            let found = on(bat, &plan, &request, CONVERGED)?;
            let own = |s: &Solution| s.modes[4].omega;
            let per_length = |_| elements as f64 / bat.length();
            println!(
                "{degree:3} {elements:3}  true {:8.1e}  stated {:8.1e}  kinks {:8.1e}",
                (own(&found) / own(&exact) - 1.0).abs(),
                found.modes[4].error.total(),
                stations.missed(bat, degree, per_length),
            );
        }
    }
    Ok(())
}

/// The cheapest plan of every degree, within an error of the fifth mode.
fn degrees(bat: &Bat, theory: Theory, tolerance: f64) -> Result<()> {
    let request = Request { modes: 5, tolerance, theory, ..Request::default() };
    let exact = solve(bat, &Request { tolerance: 1e-13, ..request })?;
    for degree in 3..=12 {
        let asked = Request { degree: Some(degree), ..request };
        let plan = Plan::cheapest(bat, &wanted(&asked));
        let found = on(bat, &plan, &request, stop_at(&request))?;
        println!(
            "{tolerance:6.0e} {:3} of {degree:2}{} {:4} unknowns, true {:6.3} {:7.0}",
            plan.mesh.len(),
            if plan.mesh.over_stations() { " over" } else { "     " },
            plan.unknowns(),
            off(&found, &exact) / tolerance,
            shortest(|| drop(on(bat, &plan, &request, stop_at(&request)))),
        );
    }
    Ok(())
}

fn plans(bat: &Bat, theory: Theory, modes: usize) -> Result<()> {
    for digits in [2, 3, 4, 5, 6, 7, 8, 9] {
        let tolerance = 10f64.powi(-digits);
        let request = Request { modes, tolerance, theory, ..Request::default() };
        let exact = solve(bat, &Request { tolerance: 1e-13, ..request })?;
        let plan = Plan::cheapest(bat, &wanted(&request));
        let found = on(bat, &plan, &request, stop_at(&request))?;
        let solved = solve(bat, &request)?;
        println!(
            "1e-{digits:02} {:3} of {:2}{} {:4} unknowns, true {:6.3} stated {:6.3}{} {:7.0} {:6.0} {:7.0}",
            plan.mesh.len(),
            plan.degree,
            if plan.mesh.over_stations() { " over" } else { "     " },
            plan.unknowns(),
            off(&found, &exact) / tolerance,
            found.worst() / tolerance,
            if solved.reason == plan.reason { "     " } else { " MORE" },
            shortest(|| drop(solve(bat, &request))),
            shortest(|| drop(Plan::cheapest(bat, &wanted(&request)))),
            shortest(|| drop(on(bat, &plan, &request, stop_at(&request)))),
        );
    }
    Ok(())
}

fn main() -> Result<()> {
    let given: Vec<String> = std::env::args().skip(1).collect();
    let own = || BATS.map(|name| format!("meshes/{name}.json")).to_vec();
    for file in if given.is_empty() { own() } else { given } {
        let bat = Bat::from_file(&file)?;
        for theory in Theory::ALL {
            if theory.shears() && !bat.knows_shear() {
                continue;
            }
            println!("{file}, {}", theory.name());
            kinks(&bat, theory)?;
            degrees(&bat, theory, 1e-4)?;
            for modes in [5, 10] {
                println!("{modes} modes");
                plans(&bat, theory, modes)?;
            }
        }
    }
    Ok(())
}
