//! The cost of a hit, compared with the Runge-Kutta method on the same equations.
//!
//! `cargo bench --bench hit` prints the tables: time per impact, true error, and the ratio of the times where both are
//! equally accurate.

use std::hint::black_box;
use std::time::{Duration, Instant};

use sweetspot::base::telling::nobody;
use sweetspot::bat::theory::Theory;
use sweetspot::collision::along::strikes;
use sweetspot::collision::ball::Ball;
use sweetspot::collision::contact::abreast::meet::Place;
use sweetspot::collision::contact::collider::Collider;
use sweetspot::collision::contact::encounter::Encounter;
use sweetspot::collision::contact::force_law::{ForceLaw, Top};
use sweetspot::collision::contact::power_law::PowerLaw;
use sweetspot::collision::contact::touch::DrivingPoint;
use sweetspot::collision::hit::{Effort, Impact, Model, Scene};
use sweetspot::collision::hitter::Hitter;
use sweetspot::collision::struck::Struck;
use sweetspot::{Bat, Request, Solution, solve};
use sweetspot_proof::bundled::bundled_bat;

/// Impact points of a barrel sweep, over the length.
const FROM: f64 = 0.5;
const TO: f64 = 0.97;
const POINTS: usize = 100;

/// The speed after the hit by the classical Runge-Kutta method with a fixed step (s): `z″ = −F/μ`,
/// `y_n″ = −ω_n² y_n − c_n F`, `x = z + Σ y_n`. The branch is changed at the end of a step; the end
/// is where the compression returns to zero, between two steps by a straight line.
fn runge_kutta(
    modes: &[[f64; 2]],
    felt: &DrivingPoint,
    law: &PowerLaw,
    speed: f64,
    step: f64,
) -> f64 {
    let n = felt.gains.len();
    // z, z′, impulse, then all y and all y′.
    let size = 3 + 2 * n;
    let squares: Vec<f64> = modes[..n].iter().map(|mode| mode[0] * mode[0]).collect();
    let mut now = vec![0.0; size];
    now[1] = speed;
    let (mut trial, mut sum) = (now.clone(), now.clone());
    let mut slopes = vec![0.0; size];
    let mut top: Option<Top> = None;
    let compression = |s: &[f64]| s[0] + s[3..3 + n].iter().sum::<f64>();
    let rates = |s: &[f64], top: Option<Top>, out: &mut [f64]| {
        let [force, _] = law.force(compression(s), top);
        (out[0], out[1], out[2]) = (s[1], -felt.inverse_mass * force, force);
        for k in 0..n {
            out[3 + k] = s[3 + n + k];
            out[3 + n + k] = -squares[k] * s[3 + k] - felt.gains[k] * force;
        }
    };
    let mut before = 0.0;
    for _ in 0..100_000 {
        sum.copy_from_slice(&now);
        trial.copy_from_slice(&now);
        for (part, next) in [(6.0, 0.5), (3.0, 0.5), (3.0, 1.0), (6.0, 0.0)] {
            rates(&trial, top, &mut slopes);
            for k in 0..size {
                sum[k] += step / part * slopes[k];
                trial[k] = now[k] + next * step * slopes[k];
            }
        }
        let (x, impulse) = (compression(&sum), now[2]);
        std::mem::swap(&mut now, &mut sum);
        if x <= 0.0 {
            let share = before / (before - x);
            return impulse + share * (now[2] - impulse);
        }
        match top {
            None if x < before => {
                let [force, _] = law.force(before, None);
                top = Some(Top { compression: before, force });
            }
            Some(known) if x > known.compression => top = None,
            _ => {}
        }
        before = x;
    }
    f64::NAN
}

/// Times of jobs, each the best over batches, with the batches taken in turn so that all run under the same conditions.
fn side_by_side<T>(batches: usize, jobs: &[&dyn Fn() -> T]) -> Vec<Duration> {
    let mut best = vec![Duration::MAX; jobs.len()];
    for _ in 0..batches {
        for (best, job) in best.iter_mut().zip(jobs) {
            let started = Instant::now();
            black_box(job());
            *best = (*best).min(started.elapsed());
        }
    }
    best
}

/// A bat with its beam theory and its swing.
struct Hit {
    name: &'static str,
    bat: Bat,
    theory: Theory,
    scene: Scene,
}

fn hits() -> [Hit; 2] {
    let scene = |ball: Ball| Scene {
        pivot: 0.0635,
        swing: 50.0,
        ball_speed: 40.0,
        cor: 0.5,
        ball,
        ..Scene::default()
    };
    let baseball = Ball::baseball;
    [
        Hit {
            name: "dowel, Euler-Bernoulli",
            bat: bundled_bat("meshes/dowel.json").unwrap(),
            theory: Theory::EulerBernoulli,
            scene: scene(baseball()),
        },
        Hit {
            name: "R161, Timoshenko",
            bat: bundled_bat("meshes/r161.json").unwrap(),
            theory: Theory::Timoshenko,
            scene: scene(baseball()),
        },
    ]
}

impl Hit {
    fn solved(&self, modes: usize) -> Solution {
        let request = Request { modes, tolerance: 1e-9, theory: self.theory, ..Request::default() };
        solve(&self.bat, &request).unwrap()
    }

    fn places(&self) -> Vec<f64> {
        let at = |k: usize| FROM + (TO - FROM) * k as f64 / (POINTS - 1) as f64;
        (0..POINTS).map(|k| self.bat.length() * at(k)).collect()
    }

    fn closing(&self, x: f64) -> f64 {
        self.scene.ball_speed + self.scene.swing * (self.scene.pivot + x)
    }
}

/// One method for the impulses along a barrel.
type Way<'a> = (String, Box<dyn Fn() -> Vec<f64> + 'a>);

/// Whether the ball was compressed twice, or hit again.
fn again(met: &Encounter) -> bool {
    met.late || met.reloads > 0 || met.again()
}

fn compare(hit: &Hit) {
    let [k, alpha] = [hit.scene.ball.stiffness, hit.scene.ball.exponent].map(Option::unwrap);
    let (places, law) = (hit.places(), PowerLaw::new(k, alpha, hit.scene.cor));
    let mass = hit.scene.ball.mass_kg;
    let (ten, many, all) = (hit.solved(10), hit.solved(18), hit.solved(80));
    let (few, eighteen, finest) =
        (Struck::new(&hit.bat, &ten), Struck::new(&hit.bat, &many), Struck::new(&hit.bat, &all));
    let collider = |struck: &Struck| {
        let speed = hit.closing(0.75 * hit.bat.length());
        let reduced = 1.0 / (1.0 / mass + 1.0 / hit.bat.inertia().mass);
        let touching = law.compression(0.5 * reduced * speed * speed) / speed;
        Collider::new(&struck.modes(), 0.28 * touching)
    };
    let exact = collider(&finest);
    let truth = |x: &f64| {
        let met = exact.meet(&finest.felt(*x, mass, 80), &law, hit.closing(*x), 1e-11);
        (met.impulse, again(&met))
    };
    let truths: Vec<(f64, bool)> = places.iter().map(truth).collect();
    let worst = |impulses: &[f64], late: bool| {
        let errors = places.iter().zip(&truths).zip(impulses);
        let errors = errors.filter(|((_, truth), _)| late || !truth.1);
        let errors = errors.map(|((x, t), j)| (j - t.0).abs() / (mass * hit.closing(*x)));
        errors.fold(0.0, f64::max)
    };
    let places = &places;
    let felt_by = |struck: &Struck, count: usize, whole: bool| -> Vec<DrivingPoint> {
        let felt = |x: &f64| match whole {
            true => struck.felt(*x, mass, count),
            false => struck.with_modes(*x, mass, count),
        };
        places.iter().map(felt).collect()
    };
    let modes = &eighteen.modes();
    let (with_few, with_many) = (collider(&few), collider(&eighteen));
    let few = felt_by(&few, 10, true);
    let (plain, whole) = (felt_by(&eighteen, 18, false), felt_by(&eighteen, 18, true));
    let cases = [
        ("contact, 10 modes and the rest", &with_few, &few),
        ("contact, 18 modes and the rest", &with_many, &whole),
        ("contact, 18 modes", &with_many, &plain),
    ];
    let law = &law;
    // The same 18 modes with tight steps: the remaining error is that of the steps. With only these modes ball and bat
    // do not meet again.
    let tight = |(felt, x): (&DrivingPoint, &f64)| {
        let met = with_many.meet(felt, law, hit.closing(*x), 1e-11);
        (met.impulse, again(&met))
    };
    let tight: Vec<(f64, bool)> = plain.iter().zip(places).map(tight).collect();
    let by_steps = |impulses: &[f64]| {
        let errors = places.iter().zip(&tight).zip(impulses).zip(&truths);
        let errors = errors.filter(|(((_, tight), _), truth)| !tight.1 && !truth.1);
        let errors = errors.map(|(((x, t), j), _)| (j - t.0).abs() / (mass * hit.closing(*x)));
        errors.fold(0.0, f64::max)
    };
    // As many modes as reduce the error of the omitted ones below 1e-4 on the dowel; on the R161 no number does.
    let (more, crowd) = (felt_by(&finest, 40, false), &finest.modes());
    let mut ways: Vec<Way> = Vec::new();
    for (count, step) in [(18, 5e-6), (18, 2e-6), (18, 1e-6), (40, 2e-6), (40, 1e-6)] {
        let (modes, felts) = if count == 18 { (modes, &plain) } else { (crowd, &more) };
        let impulse = move |(felt, x): (&DrivingPoint, &f64)| {
            runge_kutta(modes, felt, law, hit.closing(*x), step)
        };
        let name = format!("Runge-Kutta, {count} modes, {:.0} us", 1e6 * step);
        let all = move || felts.iter().zip(places).map(impulse).collect();
        ways.push((name, Box::new(all)));
    }
    for (name, collider, felts) in cases {
        for tolerance in [1e-4, 1e-6, 1e-9] {
            let accuracy = 10.0 * tolerance;
            let alone = move |felt: &DrivingPoint, x: &f64| {
                collider.meet(felt, law, hit.closing(*x), accuracy).impulse
            };
            let all = move || felts.iter().zip(places).map(|(felt, x)| alone(felt, x)).collect();
            ways.push((format!("{name}, {tolerance:e}"), Box::new(all)));
            let abreast = move || {
                let place = |(felt, x): (_, &f64)| Place {
                    felt,
                    others: &[],
                    law: *law,
                    speed: hit.closing(*x),
                };
                let all: Vec<Place> = felts.iter().zip(places).map(place).collect();
                let met =
                    collider.meet_abreast(&all, accuracy).into_iter().zip(felts.iter().zip(places));
                met.map(|(met, (felt, x))| met.map_or_else(|| alone(felt, x), |met| met.impulse))
                    .collect()
            };
            ways.push((format!("  side by side, {tolerance:e}"), Box::new(abreast)));
        }
    }
    println!("\n{}: {POINTS} impacts from {FROM} to {TO} of the length, on one core", hit.name);
    println!(
        "{:<40} {:>11} {:>9} {:>9} {:>13} {:>7}",
        "", "per impact", "error", "late too", "steps' alone", "speed"
    );
    let jobs: Vec<&dyn Fn() -> Vec<f64>> = ways.iter().map(|(_, way)| way.as_ref()).collect();
    let times = side_by_side(15, &jobs);
    for ((name, way), time) in ways.iter().zip(&times) {
        let impulses = way();
        // Only those with exactly these modes.
        let alone = match name.contains("18 modes,") {
            true => format!("{:.1e}", by_steps(&impulses)),
            false => "-".to_owned(),
        };
        println!(
            "{name:<40} {:>8.1} us {:>9.1e} {:>9.1e} {alone:>13} {:>6.1}x",
            1e6 * time.as_secs_f64() / POINTS as f64,
            worst(&impulses, false),
            worst(&impulses, true),
            times[0].as_secs_f64() / time.as_secs_f64()
        );
    }
    sweeps(hit, places);
}

/// The whole: strikes with their errors and ledgers, the modes known.
fn sweeps(hit: &Hit, places: &[f64]) {
    println!(
        "{:<40} {:>11} {:>11} {:>11}",
        "sweep, errors and ledger included", "", "stated", "modes"
    );
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    for (tolerance, modes) in [(1e-4, 10), (1e-6, 25), (1e-9, 40)] {
        let solution = hit.solved(modes);
        let effort = Effort { accuracy: 10.0 * tolerance, completed: true, unsettled: false };
        let whole = || {
            let hitter =
                Hitter::new(Model::Contact, &hit.scene, &hit.bat, &solution, effort).unwrap();
            one.install(|| strikes(&hitter, hit.bat.length(), places, &nobody))
        };
        let errors: Vec<f64> =
            whole().iter().filter_map(|i| Some(i.outcome.as_ref()?.error)).collect();
        let stated = errors.iter().fold(0.0_f64, |worst, e| worst.max(*e));
        let time = side_by_side(15, &[&whole as &dyn Fn() -> Vec<Impact>])[0];
        let name = format!("{POINTS} points to {tolerance:e}");
        let shown = 1e3 * time.as_secs_f64();
        println!("{name:<40} {shown:>8.2} ms {stated:>11.1e} {modes:>11}");
    }
}

fn main() {
    for hit in hits() {
        compare(&hit);
    }
}
