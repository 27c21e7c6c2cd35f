//! Which of two bats hits harder, and where?
//!
//!     cargo run --release --example which_bat [-- ONE.json OTHER.json]
//!
//! One batter swings both: the heavier to swing goes slower, such that the energy of rotation about
//! the point 6 in from the knob is the same (`Ω = Ω₀ √(I₀/I)`, the first bat at 50 rad/s).

use std::env;
use sweetspot::bat::STANDARD_PIVOT;
use sweetspot::choice;
use sweetspot::collision::figures::{Figures, SwingLaw};
use sweetspot::collision::hit::{Model, Scene};
use sweetspot::collision::sweep::sweep;
use sweetspot::units::{inches, miles_per_hour, ounce_square_inches, ounces};
use sweetspot::{Bat, Request, Result};

const INCH: f64 = 0.0254;
/// Allowed error of an exit speed over the closing speed.
const TOLERANCE: f64 = 1e-5;
/// Impact points: every half inch from 2 in to 12 in from the tip.
const POINTS: usize = 21;

/// One bat in one batter's hands.
struct Tried {
    bat: Bat,
    swing: f64,
    figures: Figures,
    /// Exit speeds at the impact points and the largest of their errors (m/s).
    speeds: Vec<f64>,
    error: f64,
}

fn from_tip(k: usize) -> f64 {
    (2.0 + 0.5 * k as f64) * INCH
}

fn tried(bat: Bat, batter: SwingLaw) -> Result<Tried> {
    let scene = Scene { swing: batter.swing(&bat), ..Scene::default() };
    let mut request = Request { tolerance: TOLERANCE, ..Request::default() };
    request.theory = choice::theory(&bat, &request)?.theory;
    let places: Vec<f64> = (0..POINTS).map(|k| bat.length() - from_tip(k)).collect();
    let sweep = sweep(&bat, Model::Contact, &scene, &request, false, &places)?;
    let how = (Model::Contact, sweep.effort);
    let figures = Figures::new(&bat, how, (&scene, None), &sweep.solution)?;
    let (mut speeds, mut error) = (vec![], 0.0_f64);
    for impact in &sweep.impacts {
        let outcome = impact.outcome.as_ref().expect("a swung barrel meets the ball");
        speeds.push(outcome.exit_speed);
        error = error.max(outcome.error * (impact.bat_speed + scene.ball_speed));
    }
    Ok(Tried { bat, swing: scene.swing, figures, speeds, error })
}

fn main() -> Result<()> {
    let path = |k: usize, own: &str| env::args().nth(k).unwrap_or_else(|| own.to_owned());
    let one = Bat::from_file(path(1, "meshes/r161.json"))?;
    let other = Bat::from_file(path(2, "meshes/torpedo.json"))?;
    let reference = one.inertia().about(STANDARD_PIVOT);
    let batter = SwingLaw { exponent: 0.5, reference, of_reference: 50.0 };
    let bats = [tried(one, batter)?, tried(other, batter)?];

    for (name, tried) in ["A", "B"].iter().zip(&bats) {
        let (body, spot) = (tried.bat.inertia(), &tried.figures.spot);
        let best = spot.exit_speed_max.expect("a swung barrel meets the ball");
        let [from, to] = spot.zone.expect("a best place has a zone");
        println!("{name}: {}", tried.bat.name);
        let weight = ounce_square_inches(body.about(STANDARD_PIVOT));
        print!("   {:.2} oz, swing weight {weight:.0} oz in²,", ounces(body.mass));
        println!(" swung at {:.2} rad/s", tried.swing);
        let place = inches(tried.bat.length() - best.x);
        print!("   best {:.2} mph at {place:.2} in from the tip,", miles_per_hour(best.value));
        println!(" within 1 % over {:.2} in", inches(to - from));
    }

    println!("\n   from tip      A        B      B - A");
    for k in 0..POINTS {
        let [a, b] = [0, 1].map(|i: usize| miles_per_hour(bats[i].speeds[k]));
        println!("  {:5.1} in  {a:7.2}  {b:7.2}  {:+7.2} mph", inches(from_tip(k)), b - a);
    }
    let error = miles_per_hour(bats[0].error + bats[1].error);
    println!("  every difference within {error:.0e} mph by the program's own estimate\n");
    println!("{}", verdict(&bats, error));
    Ok(())
}

/// Where each bat is the faster, told from the signs along the barrel.
fn verdict([a, b]: &[Tried; 2], error: f64) -> String {
    let gain = |k: usize| miles_per_hour(b.speeds[k] - a.speeds[k]);
    let winner = |k: usize| match gain(k) {
        gain if gain > error => "B",
        gain if gain < -error => "A",
        _ => "neither",
    };
    let mut runs: Vec<(usize, usize)> = vec![];
    for k in 0..POINTS {
        match runs.last_mut() {
            Some((from, to)) if winner(*from) == winner(k) => *to = k,
            _ => runs.push((k, k)),
        }
    }
    let place = |k: usize| inches(from_tip(k));
    let told = runs.iter().map(|&(from, to)| {
        let most = (from..=to).map(gain).max_by(|x, y| x.abs().total_cmp(&y.abs()));
        let most = most.unwrap_or(0.0).abs();
        let stretch = format!("from {:.1} to {:.1} in from the tip", place(from), place(to));
        format!("{} is the faster {stretch}, by up to {most:.2} mph", winner(from))
    });
    told.collect::<Vec<_>>().join("\n")
}
