//! Changes that must have no effect, some of them on any bit.

use std::thread;

use crate::bundled::bundled_bat;
use crate::extremes::Outcome;
use crate::extremes::judge::{against, apart, difference};
use crate::promise::largest;
use crate::validation::Truth;
use sweetspot::base::Result;
use sweetspot::bat::{Bat, Interpolation, Material, Profile, Stations};
use sweetspot::modes::solve::{Request, Solution, solve};

/// Twice the largest difference that another order of the same elements may cause by rounding.
const ROUNDINGS: f64 = 1e-13;

/// Both directions of one mesh, where running sums begin at either end.
pub fn turned_on_one_mesh() -> Result<Outcome> {
    let bat = Truth::of_cases(&["cone_1_1000"])?.bat;
    let turned = bat.with(|parts| parts.profile = parts.profile.clone().reversed())?;
    let request = Request { elements: Some(400), ..Request::plain() };
    let (a, b) = (solve(&bat, &request)?, solve(&turned, &request)?);
    Ok(difference(ROUNDINGS, apart(&a, &b, 1.0), a.worst()))
}

/// A bat with additional stations, solved for twelve digits, compared with the known values without them.
fn with_more_stations(case: &str, places: &[f64]) -> Result<Outcome> {
    let truth = Truth::of_cases(&[case])?;
    let request = Request { tolerance: 1e-12, ..Request::plain() };
    let solution = solve(&split(&truth.bat, places)?, &request)?;
    Ok(against(1e-12, &solution, &truth.frequencies))
}

/// The bat with a station more at these shares of every piece, on its line.
fn split(bat: &Bat, places: &[f64]) -> Result<Bat> {
    let (mut x, mut outer, mut inner) = (vec![], vec![], vec![]);
    for piece in &bat.profile().pieces {
        // Includes the ends of a piece: where the next piece has another value, that is a step.
        for share in [0.0].iter().chain(places).chain(&[1.0]) {
            let (place, section) = (piece.start + share * piece.length, piece.at(*share));
            let known = x.last() == Some(&place) && outer.last() == Some(&section.outer);
            if !known {
                x.push(place);
                outer.push(section.outer);
                inner.push(section.inner);
            }
        }
    }
    let stations = Stations { x, outer, inner, interpolation: Interpolation::Linear };
    let Material { density, youngs_modulus, .. } = *bat.material();
    Bat::builder(Profile::new(stations)?, Material::new(density, youngs_modulus)?).build()
}

pub fn split_cylinders() -> Result<Outcome> {
    with_more_stations("steps_many", &[0.5])
}

pub fn collinear_stations() -> Result<Outcome> {
    with_more_stations("linear_bat", &[0.2, 0.3, 0.7])
}

/// Every number of a solution, bit by bit.
fn bits(solution: &Solution) -> Vec<u64> {
    let numbers = solution.modes.iter().flat_map(|mode| {
        let errors = mode.error;
        let own = [mode.omega, mode.modal_mass, errors.discretization, errors.round_off];
        let rest = [errors.residual, errors.nodes, errors.modal_mass, errors.shape];
        let nodes = mode.nodes.iter().copied();
        own.into_iter().chain(rest).chain(nodes).chain(mode.shape.coefficients().to_vec())
    });
    numbers.map(f64::to_bits).collect()
}

/// The bats that are solved again and again: steps, points, formulas, stations.
fn everything() -> Result<Vec<Vec<u64>>> {
    let request = Request { tolerance: 1e-8, ..Request::plain() };
    let names = ["meshes/r161.json", "meshes/tanh.json", "meshes/dowel.json"];
    let bats = names.iter().map(|name| bundled_bat(name));
    let cases = ["steps_many", "cone_complete", "dumbbell"];
    let cases = cases.iter().map(|case| Ok(Truth::of_cases(&[case])?.bat));
    bats.chain(cases).map(|bat| Ok(bits(&solve(&bat?, &request)?))).collect()
}

/// Requests 0; the result is the share of solutions with a different bit.
fn share_of_others(first: &[Vec<u64>], others: &[Vec<Vec<u64>>]) -> Outcome {
    let different = others.iter().map(|other| {
        let unequal = first.iter().zip(other).filter(|(a, b)| a != b).count();
        unequal as f64 / first.len() as f64
    });
    difference(0.0, largest(different), 0.0)
}

pub fn repeated() -> Result<Outcome> {
    let others = (0..3).map(|_| everything()).collect::<Result<Vec<_>>>()?;
    Ok(share_of_others(&everything()?, &others))
}

pub fn threads() -> Result<Outcome> {
    let mut others = Vec::new();
    for count in [1, 2, 8] {
        let solved = thread::scope(|scope| {
            let running: Vec<_> = (0..count).map(|_| scope.spawn(everything)).collect();
            let done = running.into_iter().map(|thread| thread.join());
            done.map(|bits| bits.expect("a solve does not panic")).collect::<Result<Vec<_>>>()
        });
        others.extend(solved?);
    }
    Ok(share_of_others(&everything()?, &others))
}
