//! What does a weight in the knob do?
//!
//!     cargo run --release --example knob_weight [-- BAT.json]
//!
//! One, two and three ounces ¾ in from the knob end, on a bat that is swung at 50 rad/s regardless of its weight, and
//! on one that is swung with the energy of the bare bat at 50 rad/s, with the rotation about the point 6 in from the
//! knob (`Ω = Ω₀ √(I₀/I)`).

use std::env;
use sweetspot::base::units::{inches, miles_per_hour, ounce_square_inches};
use sweetspot::bat::body::STANDARD_PIVOT;
use sweetspot::bat::fixtures::Attachment;
use sweetspot::collision::figures::SwingLaw;
use sweetspot::collision::sweep::{Accuracy, Sweep, sweep};
use sweetspot::collision::sweet_spot::{FINE, HitsAlong};
use sweetspot::collision::{Hitter, Model, Scene};
use sweetspot::modes::prepared::{Prepared, prepare};
use sweetspot::{Bat, Request, Result};

const OUNCE: f64 = 0.028_349_523_125;
const KNOB: f64 = 0.75 * 0.0254;
/// Angular speed of the swing (rad/s).
const SWING: f64 = 50.0;
/// Speed of the ball towards the bat (m/s): 90 mph.
const PITCH: f64 = 90.0 * 0.447_04;

/// The same bat with a mass (kg) in its knob.
fn weighted(bat: &Bat, mass: f64) -> Result<Bat> {
    let weight = Attachment { x: KNOB, mass, ..Attachment::default() };
    bat.with(|parts| parts.fixtures.attachments.push(weight))
}

/// The position of the highest exit speed at that swing (rad/s), the speed (m/s), and its error.
fn best(bat: &Bat, swing: f64, sweep: &Sweep) -> Result<[f64; 3]> {
    let scene = Scene { swing, ball_speed: PITCH, ..Scene::default() };
    let hitter = Hitter::new(Model::Contact, &scene, bat, &sweep.solution, sweep.effort)?;
    let looked = HitsAlong::outer(FINE, &hitter);
    let peak = looked.greatest(|glance| Some(glance.exit_speed));
    let hit = hitter.strike(peak.expect("a swung barrel meets the ball").x);
    let closing = hit.bat_speed + scene.ball_speed;
    let outcome = hit.outcome.expect("it met it there");
    Ok([hit.x, outcome.exit_speed, outcome.error * closing])
}

fn main() -> Result<()> {
    let path = env::args().nth(1).unwrap_or_else(|| "meshes/r161.json".to_owned());
    let file = Bat::from_file(path)?;
    // A tap was measured without the weights.
    let asked = Request { tolerance: 1e-5, ..Request::default() };
    let Prepared { bat: bare, request, .. } = prepare(&file, &asked)?;
    let reference = bare.inertia().about(STANDARD_PIVOT);
    let batter = SwingLaw { exponent: 0.5, reference, of_reference: SWING };
    let accuracy = Accuracy { exit_speed: 1e-5, theory: request.theory, ..Accuracy::default() };

    println!("{}, with a weight {:.2} in from the knob end", bare.name(), inches(KNOB));
    println!("                                                      sweet     fastest ball, mph,");
    println!("  knob  balance  swing weight  modes 1, 2    node 1    spot     at the same");
    println!("    oz  in, knob       oz in²          Hz   in, tip  in, tip    swing   energy");
    let (mut rows, mut error) = (vec![], 0.0_f64);
    for count in [0.0, 1.0, 2.0, 3.0] {
        let bat = if count > 0.0 { weighted(&bare, count * OUNCE)? } else { bare.as_ref().clone() };
        let scene = Scene { swing: SWING, ball_speed: PITCH, ..Scene::default() };
        let sweep = sweep(&bat, Model::Contact, &scene, &accuracy, &[0.8 * bat.length()])?;
        let [x, same, off] = best(&bat, SWING, &sweep)?;
        let [_, energy, also_off] = best(&bat, batter.swing(&bat), &sweep)?;
        error = error.max(miles_per_hour(off.max(also_off)));

        let body = bat.inertia();
        let balance = inches(body.balance_point);
        let weight = ounce_square_inches(body.about(STANDARD_PIVOT));
        let modes = &sweep.solution.modes;
        let [f1, f2] = [0, 1].map(|k: usize| modes[k].frequency());
        let node = modes[0].nodes.last().expect("a free bat has nodes");
        let [node, spot] = [*node, x].map(|x| inches(bat.length() - x));
        let [same, energy] = [same, energy].map(miles_per_hour);
        print!("{count:6.0} {balance:9.2} {weight:12.0} {f1:6.1} {f2:6.1} {node:8.2} {spot:8.2}");
        println!(" {same:8.2} {energy:8.2}");
        rows.push([balance, weight, f1, node, spot, same, energy]);
    }
    println!("  speeds within {error:.0e} mph by the program's own estimate\n");
    let by = |k: usize| rows[3][k] - rows[0][k];
    let share = |k: usize| 100.0 * (rows[3][k] / rows[0][k] - 1.0);
    println!("Three ounces: balance point {:+.2} in, swing weight {:+.1} %,", by(0), share(1));
    println!("first frequency {:+.1} %, its barrel node {:+.2} in from the tip,", share(2), by(3));
    println!("sweet spot {:+.2} in; the ball leaves {:+.2} mph faster swung as", by(4), by(5));
    println!("fast, {:+.2} mph swung with the same energy.", by(6));
    Ok(())
}
