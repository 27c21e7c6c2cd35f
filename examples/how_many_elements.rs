//! How many elements, and of which degree, does a tolerance need on my bat?
//!
//!     cargo run --release --example how_many_elements [-- BAT.json]
//!
//! Meshes of four degrees are doubled as long as a digit can be gained. Each is compared with the most accurate
//! solution of the same bat, and its stated error with the true one.

use std::env;
use sweetspot::modes::prepared::{Prepared, prepare};
use sweetspot::{Bat, Request, Result, Solution, solve};

/// Five modes, the number that a bat maker needs.
const MODES: usize = 5;
/// A stated error may be too small by this factor, but not more.
const PROMISE: f64 = 3.0;

/// The largest relative difference of a frequency from the reference's.
fn error(solution: &Solution, reference: &Solution) -> f64 {
    let pairs = solution.modes.iter().zip(&reference.modes);
    pairs.map(|(mode, exact)| (mode.omega / exact.omega - 1.0).abs()).fold(0.0, f64::max)
}

fn main() -> Result<()> {
    let path = env::args().nth(1).unwrap_or_else(|| "meshes/r161.json".to_owned());
    let file = Bat::from_file(path)?;
    // One theory and one stiffness for all the meshes.
    let asked = Request { modes: MODES, tolerance: 1e-4, ..Request::default() };
    let Prepared { bat, request, .. } = prepare(&file, &asked)?;
    let reference = solve(&bat, &Request { tolerance: 1e-13, ..request })?;
    let certain = reference.worst();

    println!("{}, {}, {MODES} modes", bat.name(), request.theory.name());
    println!(
        "reference: {} elements of degree {}, every frequency within {certain:.0e}\n",
        reference.mesh.len(),
        reference.degree
    );
    println!("degree  elements  unknowns    error   stated");
    let mut tried: Vec<(Solution, f64)> = vec![];
    for degree in [3, 4, 6, 8] {
        for doubling in 0..5 {
            let elements = Some(bat.profile().pieces.len() << doubling);
            let solution = solve(&bat, &Request { elements, degree: Some(degree), ..request })?;
            let found = error(&solution, &reference);
            if found <= certain {
                break;
            }
            let stated = solution.worst();
            println!(
                "{degree:6} {:9} {:9} {found:8.1e} {stated:8.1e}",
                solution.mesh.len(),
                solution.degrees_of_freedom()
            );
            assert!(found <= PROMISE * stated + certain, "a stated error does not hold");
            tried.push((solution, found));
        }
    }
    println!("every stated error holds: none is exceeded by a factor of {PROMISE}\n");

    println!("within   fewest unknowns of these     what the planner takes   its error   stated");
    for tolerance in [1e-2, 1e-4, 1e-6, 1e-8, 1e-10] {
        let enough = tried.iter().filter(|(_, found)| *found <= tolerance);
        let least = enough.min_by_key(|(solution, _)| solution.degrees_of_freedom());
        let least = least.map_or("none of these".to_owned(), |(solution, _)| size(solution));
        let planned = solve(&bat, &Request { tolerance, ..request })?;
        let (found, stated) = (error(&planned, &reference), planned.worst());
        println!(
            "{tolerance:6.0e}   {least:26}   {:22} {found:11.1e} {stated:8.1e}",
            size(&planned)
        );
    }
    Ok(())
}

fn size(solution: &Solution) -> String {
    format!("{} elements of degree {}", solution.mesh.len(), solution.degree)
}
