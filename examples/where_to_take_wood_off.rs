//! Where on the bat should I take wood off?
//!
//!     cargo run --release --example where_to_take_wood_off [-- BAT.json]
//!
//! Half a millimetre is taken off the radius over one inch at each place in turn, and the bat is solved and hit again:
//! its weight, swing, frequencies and highest exit speed, swung as fast as before and with the same energy
//! (`Ω = Ω₀ √(I₀/I)`, `I` about the point 6 in from the knob). Such small differences need solutions with more digits
//! than the subtraction loses, which the stated errors show.

use std::env;
use sweetspot::base::units::{miles_per_hour, ounce_square_inches};
use sweetspot::bat::body::STANDARD_PIVOT;
use sweetspot::bat::profile::Radii;
use sweetspot::collision::figures::SwingLaw;
use sweetspot::collision::sweep::{Accuracy, sweep};
use sweetspot::collision::sweet_spot::{FINE, HitsAlong};
use sweetspot::collision::{Effort, Hitter, Model, Scene};
use sweetspot::modes::prepared::{Prepared, prepare};
use sweetspot::{Bat, Error, Request, Result, Solution, solve};

const INCH: f64 = 0.0254;
/// Cut of the radius (m).
const DEPTH: f64 = 0.5e-3;
const SWING: f64 = 50.0;
/// Speed of the ball towards the bat (m/s): 90 mph.
const PITCH: f64 = 90.0 * 0.447_04;
/// Allowed error of an exit speed over the closing speed.
const TOLERANCE: f64 = 1e-6;

/// The bat with less wood between two places (m).
fn turned_down(bat: &Bat, from: f64, to: f64) -> Result<Bat> {
    let mut profile = bat.profile().clone();
    profile.cut([from, to]);
    for piece in profile.pieces.iter_mut().filter(|piece| piece.is_within(from, to)) {
        let Radii::Cubic(cubics) = &mut piece.radii else {
            return Err(Error::value("profile", "formulas", "stations: a bat to be turned"));
        };
        if cubics.outer.iter().zip(&cubics.inner).any(|(r, inner)| r - inner <= DEPTH) {
            let found = format!("a thinner one at {from:.3} m");
            return Err(Error::value("wall", found, "one that half a millimetre leaves"));
        }
        // Moving all coefficients lowers a cubic in Bernstein form as a whole.
        cubics.outer.iter_mut().for_each(|r| *r -= DEPTH);
    }
    bat.with(|parts| parts.profile = profile)
}

/// The highest exit speed of a bat (m/s), and its error.
fn best(bat: &Bat, swing: f64, solution: &Solution, effort: Effort) -> Result<[f64; 2]> {
    let scene = Scene { swing, ball_speed: PITCH, ..Scene::default() };
    let hitter = Hitter::new(Model::Contact, &scene, bat, solution, effort)?;
    let looked = HitsAlong::by([0.6 * bat.length(), bat.length()], FINE, &hitter);
    let peak = looked.greatest(|glance| Some(glance.exit_speed));
    let hit = hitter.strike(peak.expect("a swung barrel meets the ball").x);
    let closing = hit.bat_speed + scene.ball_speed;
    let outcome = hit.outcome.expect("it met it there");
    Ok([outcome.exit_speed, outcome.error * closing])
}

fn main() -> Result<()> {
    let path = env::args().nth(1).unwrap_or_else(|| "meshes/r161.json".to_owned());
    let file = Bat::from_file(path)?;
    // A tap was measured before the cut.
    let asked = Request { tolerance: TOLERANCE, ..Request::default() };
    let Prepared { bat, request, .. } = prepare(&file, &asked)?;
    let scene = Scene { swing: SWING, ball_speed: PITCH, ..Scene::default() };
    let accuracy =
        Accuracy { exit_speed: TOLERANCE, theory: request.theory, ..Accuracy::default() };
    let sweep = sweep(&bat, Model::Contact, &scene, &accuracy, &[0.8 * bat.length()])?;
    let request = Request { modes: sweep.solution.modes.len(), tolerance: 1e-9, ..request };
    let solution = solve(&bat, &request)?;
    let body = bat.inertia();
    let reference = body.about(STANDARD_PIVOT);
    let batter = SwingLaw { exponent: 0.5, reference, of_reference: SWING };
    let now = best(&bat, SWING, &solution, sweep.effort)?;

    println!("{}: {:.1} mm off the radius over an inch", bat.name(), 1e3 * DEPTH);
    print!("now {:.1} g, {:.0} oz in²,", 1e3 * body.mass, ounce_square_inches(reference));
    print!(" {:.2} Hz,", solution.modes[0].frequency());
    println!(" best ball {:.2} mph at {SWING} rad/s\n", miles_per_hour(now[0]));
    println!("     inches      mass  swing weight  mode 1   best ball, mph, at the same");
    println!("  from knob         g        oz in²      Hz         swing        energy");
    let (mut gains, mut worst) = (vec![], 0.0_f64);
    for k in 0..(bat.length() / INCH) as usize {
        let (from, to) = (k as f64 * INCH, (k + 1) as f64 * INCH);
        let less = turned_down(&bat, from, to)?;
        let solved = solve(&less, &request)?;
        let inertia = less.inertia();
        let swing_weight = inertia.about(STANDARD_PIVOT) - reference;
        let as_fast = best(&less, SWING, &solved, sweep.effort)?;
        let as_strong = best(&less, batter.swing(&less), &solved, sweep.effort)?;
        let [same, energy] = [as_fast, as_strong]
            .map(|[v, _]| (1e3 * miles_per_hour(v - now[0])).round() / 1e3 + 0.0);
        worst = worst.max(now[1] + f64::max(as_fast[1], as_strong[1]));
        let mass = 1e3 * (inertia.mass - body.mass);
        let pitch = solved.modes[0].frequency() - solution.modes[0].frequency();
        let swing_weight = ounce_square_inches(swing_weight);
        print!("  {k:3} to {:2} {mass:+10.3} {swing_weight:+13.2} {pitch:+7.3}", k + 1);
        println!(" {same:+13.3} {energy:+13.3}");
        gains.push(([same, energy], k));
    }
    println!("\nDifferences of speed within {:.0e} mph by estimate.", miles_per_hour(worst));
    for (case, what) in ["as fast", "with the same energy"].iter().enumerate() {
        gains.sort_by(|(a, _), (b, _)| b[case].total_cmp(&a[case]));
        let [(most, there), .., (least, worst)] = gains[..] else { return Ok(()) };
        let [most, least] = [most[case], least[case]];
        print!("Swung {what}: best from {there} to {} in ({most:+.3} mph), ", there + 1);
        println!("worst from {worst} to {} in ({least:+.3} mph).", worst + 1);
    }
    Ok(())
}
