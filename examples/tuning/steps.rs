//! How long may the steps of a contact be? The basis of `Tuning` and of the longest usual step, `LONGEST` of a hitter:
//! the number of steps of hits along three bats, and the errors of their impulses relative to the wanted accuracy.

use sweetspot::collision::contact::collider::Collider;
use sweetspot::collision::contact::force_law::ForceLaw;
use sweetspot::collision::contact::power_law::PowerLaw;
use sweetspot::collision::contact::touch::{DrivingPoint, Tuning};
use sweetspot::collision::struck::Struck;
use sweetspot::{Bat, Request, Result, solve};

const BATS: [&str; 3] = ["meshes/r161.json", "meshes/dowel.json", "meshes/torpedo.json"];
const ACCURACIES: [f64; 3] = [1e-3, 1e-5, 1e-7];
/// Longest usual step, as a share of the duration of the contact.
const LONGEST: f64 = 0.28;
const BALL: f64 = 0.145;

/// A bat and a ball: the modes, and the modal data of every place.
struct Hits {
    modes: Vec<[f64; 2]>,
    places: Vec<DrivingPoint>,
    law: PowerLaw,
    speed: f64,
    pressed: f64,
    /// Impulses by fine steps; `None` if the ball is compressed twice or hit again.
    exact: Vec<Option<f64>>,
}

impl Hits {
    fn new(bat: &Bat, restitution: f64) -> Result<Self> {
        let solution = solve(bat, &Request { modes: 18, ..Request::plain() })?;
        let struck = Struck::new(bat, &solution);
        let place = |k: usize| bat.length() * (0.5 + 0.5 * k as f64 / 40.0);
        let places: Vec<DrivingPoint> = (0..40).map(|k| struck.felt(place(k), BALL, 18)).collect();
        let (law, speed) = (PowerLaw::new(6.53e7, 1.84, restitution), 60.0);
        let pressed = law.compression(0.5 * 0.12 * speed * speed) / speed;
        let modes = struck.modes();
        let fine = Collider::new(&modes, LONGEST * pressed);
        let exact = |felt: &DrivingPoint| {
            let met = fine.meet(felt, &law, speed, 1e-11);
            (met.reloads == 0 && !met.late && !met.again()).then_some(met.impulse)
        };
        let exact = places.iter().map(exact).collect();
        Ok(Self { modes, places, law, speed, pressed, exact })
    }

    /// Mean number of steps, and the largest error relative to the wanted accuracy.
    fn tried(&self, tuning: Tuning, longest: f64, accuracy: f64) -> [f64; 2] {
        let collider = Collider::new(&self.modes, longest * self.pressed).tuned(tuning);
        let (mut steps, mut worst) = (0, 0.0_f64);
        for (felt, exact) in self.places.iter().zip(&self.exact) {
            let met = collider.meet(felt, &self.law, self.speed, accuracy);
            steps += met.steps;
            if let Some(exact) = exact {
                worst = worst.max((met.impulse / exact - 1.0).abs() / accuracy);
            }
        }
        [steps as f64 / self.places.len() as f64, worst]
    }
}

fn main() -> Result<()> {
    let mut all = vec![];
    for path in BATS {
        let bat = Bat::from_file(path)?;
        for restitution in [0.3, 0.5, 0.9] {
            all.push(Hits::new(&bat, restitution)?);
        }
    }
    print!("{:<28}", "accuracy");
    ACCURACIES.iter().for_each(|accuracy| print!("{accuracy:>20e}"));
    println!("\n{:<28}{}", "", "       steps   error".repeat(ACCURACIES.len()));
    let row = |name: &str, tuning: Tuning, longest: f64| {
        print!("{name:<28}");
        for accuracy in ACCURACIES {
            let tried = all.iter().map(|hits| hits.tried(tuning, longest, accuracy));
            let [steps, worst] =
                tried.fold([0.0_f64; 2], |[sum, most], [s, e]| [sum + s, most.max(e)]);
            print!("{:>12.1}{worst:>8.3}", steps / all.len() as f64);
        }
        println!();
    };
    let chosen = Tuning::default();
    row("as chosen", chosen, LONGEST);
    for by in [0.1, 0.3, 3.0, 10.0] {
        row(
            &format!("usual error x {by}"),
            Tuning { usual_error: by * chosen.usual_error, ..chosen },
            LONGEST,
        );
    }
    for by in [0.1, 10.0, 100.0] {
        row(
            &format!("long error x {by}"),
            Tuning { long_error: by * chosen.long_error, ..chosen },
            LONGEST,
        );
    }
    for by in [0.1, 10.0, 100.0] {
        row(
            &format!("last energy x {by}"),
            Tuning { last_energy: by * chosen.last_energy, ..chosen },
            LONGEST,
        );
    }
    for by in [0.1, 10.0, 100.0] {
        row(&format!("slight x {by}"), Tuning { slight: by * chosen.slight, ..chosen }, LONGEST);
    }
    for by in [0.1, 5.0, 20.0] {
        row(&format!("faint x {by}"), Tuning { faint: by * chosen.faint, ..chosen }, LONGEST);
    }
    for longest in [0.07, 0.14, 0.4, 0.56] {
        row(&format!("longest {longest}"), chosen, longest);
    }
    Ok(())
}
