//! Which of two bats hits harder, and where?
//!
//!     cargo run --release --example which_bat [-- A.json B.json]
//!
//! One batter swings both, the one that is harder to swing more slowly: the energy of rotation about
//! the point 6 in from the knob is the same (`Ω = Ω₀ √(I₀/I)`, bat A at 50 rad/s).

use std::env;
use sweetspot::base::units::{inches, miles_per_hour, ounce_square_inches, ounces};
use sweetspot::bat::body::STANDARD_PIVOT;
use sweetspot::collision::Scene;
use sweetspot::collision::figures::SwingLaw;
use sweetspot::collision::sweep::Accuracy;
use sweetspot::{Bat, Hit, Result, Swing};

/// Allowed error of an exit speed over the closing speed.
const TOLERANCE: f64 = 1e-5;
/// Speed of the ball towards the bat (m/s): 90 mph.
const PITCH: f64 = 90.0 * 0.447_04;
/// Impact points: every half inch from 2 in to 12 in from the tip.
const POINTS: usize = 21;

fn from_tip(k: usize) -> f64 {
    (2.0 + 0.5 * k as f64) * 0.0254
}

/// Exit speeds at the impact points and the largest of their errors (mph), the bat described.
fn try_out(name: &str, bat: &Bat, batter: SwingLaw) -> Result<(Vec<f64>, f64)> {
    let scene = Scene { swing: batter.swing(bat), ball_speed: PITCH, ..Scene::default() };
    let accuracy = Accuracy { exit_speed: TOLERANCE, ..Accuracy::default() };
    let hit = Hit::of(bat, &Swing { scene, accuracy, ..Swing::default() })?;
    let (scene, best) = (&hit.swing.scene, &hit.best);
    let [from, to] = hit.spot.zone.expect("a best place has a zone");
    let body = bat.inertia();
    let swing_weight = ounce_square_inches(body.about(STANDARD_PIVOT));
    println!("{name}: {}", bat.name());
    print!("   {:.2} oz, swing weight {swing_weight:.0} oz in²,", ounces(body.mass));
    println!(" swung at {:.2} rad/s", scene.swing);
    let place = inches(bat.length() - best.x);
    print!("   best {:.2} mph at {place:.2} in from the tip,", miles_per_hour(best.exit_speed));
    println!(" within 1 % over {:.2} in", inches(to - from));

    let places: Vec<f64> = (0..POINTS).map(|k| bat.length() - from_tip(k)).collect();
    let impacts = hit.at(&places)?;
    let met = impacts.iter().filter_map(|hit| Some((hit.bat_speed, hit.outcome.as_ref()?)));
    let speed = |(bat_speed, outcome): (f64, _)| (bat_speed + scene.ball_speed, outcome);
    let (mut speeds, mut error) = (vec![], 0.0_f64);
    for (closing, outcome) in met.map(speed) {
        speeds.push(miles_per_hour(outcome.exit_speed));
        error = error.max(miles_per_hour(outcome.error * closing));
    }
    Ok((speeds, error))
}

fn main() -> Result<()> {
    let path = |k: usize, own: &str| env::args().nth(k).unwrap_or_else(|| own.to_owned());
    let bats = [path(1, "meshes/r161.json"), path(2, "meshes/torpedo.json")];
    let [one, other] = [Bat::from_file(&bats[0])?, Bat::from_file(&bats[1])?];
    let reference = one.inertia().about(STANDARD_PIVOT);
    let batter = SwingLaw { exponent: 0.5, reference, of_reference: 50.0 };
    let (a, error_a) = try_out("A", &one, batter)?;
    let (b, error_b) = try_out("B", &other, batter)?;
    let error = error_a + error_b;

    println!("\n   from tip      A        B      B - A, mph");
    let mut better = 0;
    for (k, (a, b)) in a.iter().zip(&b).enumerate() {
        let winner = if b - a > error { "B" } else { ["A", "neither"][usize::from(a - b < error)] };
        better += usize::from(winner == "B");
        println!("  {:5.1} in  {a:7.2}  {b:7.2}  {:+7.2}  {winner}", inches(from_tip(k)), b - a);
    }
    println!("\nB is the faster at {better} of {} places; every difference is", a.len());
    println!("within {error:.0e} mph by the program's own estimate.");
    Ok(())
}
