//! How many modes does a hit need, and how accurate must they be? The basis of `enough` and `MODES` of a sweep and of
//! `FALLS` of the stated errors: the error of the exit speed relative to the closing speed with n modes, the power of n
//! with which it falls, and the error with modes of a given tolerance.

use sweetspot::bat::theory::Theory;
use sweetspot::collision::{Effort, Hitter, Model, Scene};
use sweetspot::modes::solve::Solution;
use sweetspot::{Bat, Request, Result, solve};

const BATS: [&str; 3] = ["meshes/dowel.json", "meshes/r161.json", "meshes/torpedo.json"];
const COUNTS: [usize; 5] = [10, 14, 20, 28, 40];
const MANY: usize = 80;
const PLACES: usize = 16;

/// Exit speeds relative to the closing speed along the outer half of a bat, where ball and bat touch only once.
fn speeds(bat: &Bat, solution: &Solution) -> Result<Vec<Option<f64>>> {
    let scene = Scene { swing: 50.0, ball_speed: 90.0 * 0.447_04, ..Scene::default() };
    let effort = Effort { accuracy: 1e-10, completed: true, unsettled: false };
    let hitter = Hitter::new(Model::Contact, &scene, bat, solution, effort)?;
    let speed = |k: usize| {
        let hit = hitter.strike(bat.length() * (0.5 + 0.49 * k as f64 / (PLACES - 1) as f64));
        let closing = hit.bat_speed + scene.ball_speed;
        hit.outcome.filter(|_| hit.flags.is_empty()).map(|outcome| outcome.exit_speed / closing)
    };
    Ok((0..PLACES).map(speed).collect())
}

/// The largest difference where both have a speed.
fn apart(a: &[Option<f64>], b: &[Option<f64>]) -> f64 {
    let known = a.iter().zip(b).filter_map(|(a, b)| Some((*a)? - (*b)?));
    known.map(f64::abs).fold(0.0, f64::max)
}

fn main() -> Result<()> {
    print!("{:<20}{:<17}", "bat", "theory");
    COUNTS.iter().for_each(|count| print!("{:>9}", format!("n = {count}")));
    println!("   falls as n to the");
    for path in BATS {
        let bat = Bat::from_file(path)?;
        for theory in [Theory::Rayleigh, Theory::Timoshenko] {
            let request = Request { modes: MANY, tolerance: 1e-9, theory, ..Request::default() };
            // A material without a shear modulus has no theory with shear.
            let Ok(many) = solve(&bat, &request) else { continue };
            let exact = speeds(&bat, &many)?;
            let error = |modes: usize| -> Result<f64> {
                let solution = solve(&bat, &Request { modes, ..request })?;
                Ok(apart(&speeds(&bat, &solution)?, &exact))
            };
            let errors = COUNTS.iter().map(|count| error(*count)).collect::<Result<Vec<_>>>()?;
            print!("{:<20}{:<17}", path.trim_start_matches("meshes/"), theory.name());
            errors.iter().for_each(|error| print!("{error:>9.1e}"));
            let rate = (errors[0] / errors[4]).ln() / (COUNTS[4] as f64 / COUNTS[0] as f64).ln();
            println!("   -{rate:.1}");
        }
    }
    println!("\nmodes to a tolerance, 20 of them");
    for path in BATS {
        let bat = Bat::from_file(path)?;
        let request = Request { modes: 20, tolerance: 1e-13, ..Request::plain() };
        let exact = speeds(&bat, &solve(&bat, &request)?)?;
        print!("{:<20}", path.trim_start_matches("meshes/"));
        for tolerance in [1e-5, 1e-6, 1e-7, 1e-8] {
            let solution = solve(&bat, &Request { tolerance, ..request })?;
            let off = apart(&speeds(&bat, &solution)?, &exact);
            print!("   {tolerance:e}: off by {off:.1e}");
        }
        println!();
    }
    Ok(())
}
