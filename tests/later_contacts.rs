//! A ball that is hit again, compared with small steps of a Runge-Kutta method that has nothing in common with the
//! contact: neither the steps, nor the events, nor the search for the next touch.

use sweetspot::beam::dowel::{Ends, beta_l};
use sweetspot::collision::ball::Ball;
use sweetspot::collision::contact::collider::Collider;
use sweetspot::collision::contact::encounter::Encounter;
use sweetspot::collision::contact::force_law::ForceLaw;
use sweetspot::collision::contact::power_law::PowerLaw;
use sweetspot::collision::contact::touch::DrivingPoint;
use sweetspot::collision::energy_loss::{wpi_alpha, wpi_shape};
use sweetspot::collision::hit::{Effort, Impact, Model, Scene};
use sweetspot::collision::hitter::Hitter;
use sweetspot::collision::strike::Glance;
use sweetspot::collision::sweep::{Accuracy, sweep};
use sweetspot::collision::sweet_spot::SweetSpot;
use sweetspot::{Request, solve};
use sweetspot_proof::bundled::bundled_bat;

/// ω of a free uniform dowel with that first frequency (Hz) and how a ball (kg) feels it at a
/// fraction of its length.
fn dowel(first: f64, modes: usize, at: f64, ball: f64) -> (Vec<[f64; 2]>, DrivingPoint) {
    let mass = 0.85;
    let beta = |n: usize| beta_l(Ends::FreeFree, n);
    let omega = |n: usize| std::f64::consts::TAU * first * (beta(n) / beta(1)).powi(2);
    let gain = |n: usize| (wpi_shape(n, at) / wpi_alpha(n)).powi(2) / mass;
    let felt = DrivingPoint {
        inverse_mass: 1.0 / ball + (1.0 + 12.0 * (at - 0.5).powi(2)) / mass,
        gains: (1..=modes).map(gain).collect(),
        rest: 0.0,
    };
    ((1..=modes).map(|n| [omega(n), 0.0]).collect(), felt)
}

/// Ball and modes by the classical Runge-Kutta method of fourth order in equal small steps.
struct Reference<'a> {
    modes: &'a [[f64; 2]],
    felt: &'a DrivingPoint,
    law: PowerLaw,
}

/// Its results.
#[derive(Debug, Default)]
struct Found {
    impulse: f64,
    first: [f64; 2],
    touching: f64,
    touches: usize,
}

impl Reference<'_> {
    fn force(&self, x: f64, most: f64) -> f64 {
        let PowerLaw { stiffness, exponent, unloading } = self.law;
        match () {
            () if x <= 0.0 => 0.0,
            () if x >= most => stiffness * x.powf(exponent),
            () => stiffness * most.powf(exponent) * (x / most).powf(unloading),
        }
    }

    /// `z`, `z′` and every `y`, `y′`.
    fn rate(&self, state: &[f64], most: f64, rate: &mut [f64]) {
        let x = state[0] + state[2..].iter().step_by(2).sum::<f64>();
        let force = self.force(x, most);
        (rate[0], rate[1]) = (state[1], -force * self.felt.inverse_mass);
        for (n, [omega, _]) in self.modes.iter().enumerate() {
            let [y, v] = [state[2 + 2 * n], state[3 + 2 * n]];
            (rate[2 + 2 * n], rate[3 + 2 * n]) =
                (v, -omega * omega * y - self.felt.gains[n] * force);
        }
    }

    fn run(&self, speed: f64, h: f64, longest: f64) -> Found {
        let size = 2 + 2 * self.modes.len();
        let (mut state, mut found) = (vec![0.0; size], Found { touches: 1, ..Found::default() });
        state[1] = speed;
        let mut slopes = vec![vec![0.0; size]; 4];
        let (mut most, mut left, mut touching) = (0.0_f64, 0.0, true);
        for step in 0.. {
            let start = state.clone();
            for (k, part) in [0.0, 0.5, 0.5, 1.0].into_iter().enumerate() {
                let mut at = start.clone();
                if k > 0 {
                    at.iter_mut().zip(&slopes[k - 1]).for_each(|(s, r)| *s += h * part * r);
                }
                self.rate(&at, most, &mut slopes[k]);
            }
            for (k, s) in state.iter_mut().enumerate() {
                *s += h / 6.0 * (slopes[0][k] + 2.0 * (slopes[1][k] + slopes[2][k]) + slopes[3][k]);
            }
            let time = f64::from(step) * h;
            let x = state[0] + state[2..].iter().step_by(2).sum::<f64>();
            found.impulse = (speed - state[1]) / self.felt.inverse_mass;
            most = most.max(x);
            found.touching += if touching { h } else { 0.0 };
            if touching && x <= 0.0 {
                (touching, most, left) = (false, 0.0, time);
                if found.touches == 1 {
                    found.first = [time, found.impulse];
                }
            } else if !touching && x > 0.0 {
                touching = true;
                found.touches += 1;
            }
            let amplitude = |n: usize| state[2 + 2 * n].hypot(state[3 + 2 * n] / self.modes[n][0]);
            let farthest: f64 = (0..self.modes.len()).map(amplitude).sum();
            let gone = state[1] < 0.0 && state[0] + farthest < 0.0;
            if !touching && (gone || time - left > longest) {
                return found;
            }
        }
        found
    }
}

/// A ball of 145 g with the law of a baseball.
fn baseball(cor: f64) -> PowerLaw {
    PowerLaw::new(6.53e7, 1.84, cor)
}

fn meet(
    modes: &[[f64; 2]],
    felt: &DrivingPoint,
    law: &PowerLaw,
    speed: f64,
    accuracy: f64,
) -> Encounter {
    let touching = law.compression(0.5 * speed * speed / felt.inverse_mass) / speed;
    Collider::new(modes, 0.28 * touching).meet(felt, law, speed, accuracy)
}

#[test]
fn a_ball_that_is_caught_again_is_followed_to_the_end() {
    let (ball, mut again, mut wrong) = (0.145, 0, vec![]);
    for first in [70.0, 150.0, 240.0] {
        for k in 0..14 {
            let at = 0.03 + 0.072 * f64::from(k);
            for (cor, speed) in [(0.3, 60.0), (0.5, 20.0), (0.5, 75.0), (0.9, 60.0)] {
                let (modes, felt) = dowel(first, 6, at, ball);
                let law = baseball(cor);
                let met = meet(&modes, &felt, &law, speed, 1e-8);
                let touching = law.compression(0.5 * speed * speed / felt.inverse_mass) / speed;
                let reference = Reference { modes: &modes, felt: &felt, law };
                let found = reference.run(speed, 1e-7, 112.0 * touching);
                let off = (met.impulse - found.impulse).abs() / (ball * speed);
                let first_off = (met.first_impulse - found.first[1]).abs() / (ball * speed);
                let ends = (met.first_end - found.first[0]).abs() / found.first[0];
                let touched = (met.time - found.touching).abs() / found.touching;
                again += usize::from(met.again());
                assert!(met.is_sound(&felt, speed), "{first} {at} {cor} {speed}");
                let same = met.touches == found.touches && touched < 2e-3;
                if !(off < 2e-5 && first_off < 2e-5 && ends < 1e-3 && same) {
                    wrong.push(format!(
                        "{first} {at:.3} {cor} {speed}: {off:.1e} {first_off:.1e} {ends:.1e} \
                         {touched:.1e} {} {}",
                        met.touches, found.touches
                    ));
                }
            }
        }
    }
    assert!(wrong.is_empty() && again > 20);
}

/// Exit speeds half a thousandth of the length apart, on the WPI report's dowel and on a bat: where
/// ball and bat separate for good, the curve has no jump.
#[test]
fn the_curve_has_no_jump_where_ball_and_bat_part_once() {
    for file in ["meshes/dowel.json", "meshes/r161.json"] {
        let bat = bundled_bat(file).unwrap();
        let solution = solve(&bat, &Request { modes: 12, ..Request::plain() }).unwrap();
        let effort = Effort { accuracy: 1e-6, completed: true, unsettled: false };
        for (swing, pitch, cor) in [(50.0, 40.2336, 0.5), (30.0, 40.2336, 0.5), (0.0, 60.0, 0.4)] {
            let ball = Ball { mass_kg: 0.1417, ..Ball::baseball() };
            let scene = Scene { swing, ball_speed: pitch, cor, ball, ..Scene::default() };
            let hitter = Hitter::new(Model::Contact, &scene, &bat, &solution, effort).unwrap();
            let mut last: Option<f64> = None;
            for k in 0..1200 {
                let x = bat.length() * (0.35 + 0.0005 * f64::from(k));
                let impact = hitter.strike(x);
                let closing = impact.bat_speed + pitch;
                let exit_speed = impact.outcome.map(|outcome| outcome.exit_speed);
                let once = impact.flags.iter().all(|flag| *flag == "ball_law_beyond");
                let plain = exit_speed.filter(|_| once);
                if let (Some(before), Some(now)) = (last, plain) {
                    let jump = (now - before).abs() / closing;
                    assert!(jump < 0.01, "{file} {swing} {pitch} {cor} {x:.4}: {jump:.3}");
                }
                last = plain;
            }
        }
    }
}

/// The exit speed includes every touch; the speed at the first separation is given in addition, and a hit with one
/// touch has only one speed.
#[test]
fn the_first_separation_stands_beside_the_last() {
    let bat = bundled_bat("meshes/dowel.json").unwrap();
    let solution = solve(&bat, &Request { modes: 12, ..Request::plain() }).unwrap();
    let (scene, effort) = (Scene::default(), Effort::default());
    let hitter = Hitter::new(Model::Contact, &scene, &bat, &solution, effort).unwrap();
    let mut again = 0;
    for k in 0..200 {
        let impact = hitter.strike(bat.length() * 0.005 * f64::from(k));
        let flags = impact.flags;
        let Some(outcome) = impact.outcome else { continue };
        let first = outcome.first_separation.unwrap();
        if flags.contains(&"second_contact") {
            again += 1;
            assert!(outcome.exit_speed > first.exit_speed, "{k}");
            assert!(outcome.contact_time.unwrap() > first.time);
        } else {
            assert!((outcome.exit_speed - first.exit_speed).abs() < 1e-12);
            assert!((outcome.contact_time.unwrap() - first.time).abs() < 1e-15);
        }
    }
    assert!(again > 5, "{again}");
}

/// A ball with almost no restitution, compared with Runge-Kutta steps short enough for its steep force.
#[test]
fn a_dead_ball_is_a_ball_like_any_other() {
    let ball = 0.145;
    for cor in [0.2, 0.05, 0.02, 0.01] {
        for at in [0.2, 0.5, 0.7, 0.776, 0.95] {
            let (modes, felt) = dowel(160.0, 4, at, ball);
            let (law, speed) = (baseball(cor), 60.0);
            let met = meet(&modes, &felt, &law, speed, 1e-6);
            let touching = law.compression(0.5 * speed * speed / felt.inverse_mass) / speed;
            let reference = Reference { modes: &modes, felt: &felt, law };
            let found = reference.run(speed, 1e-6 * cor.min(0.1), 112.0 * touching);
            let off = (met.impulse - found.impulse).abs() / (ball * speed);
            assert!(met.is_sound(&felt, speed), "{cor} {at}: {met:?}");
            assert!(off < 1e-4, "{cor} {at}: {off:e}");
        }
    }
}

/// With the flexibility of the modes left out, as hits have it, any restitution is resolved, and the
/// exit speed depends on it smoothly down to 0.
#[test]
fn every_restitution_from_0_to_1_is_resolved() {
    let bat = bundled_bat("meshes/r161.json").unwrap();
    let solution = solve(&bat, &Request { modes: 10, ..Request::plain() }).unwrap();
    for x in [0.45, 0.6, 0.7, 0.8] {
        let mut last: Option<f64> = None;
        for cor in [0.0, 1e-6, 1e-4, 1e-3, 7e-3, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 0.8, 1.0] {
            let scene = Scene { cor, ..Scene::default() };
            let effort = Effort { accuracy: 1e-3, completed: true, unsettled: false };
            let hitter = Hitter::new(Model::Contact, &scene, &bat, &solution, effort).unwrap();
            let impact = hitter.strike(x);
            let closing = impact.bat_speed + scene.ball_speed;
            let flags = impact.flags;
            let outcome = impact.outcome.unwrap_or_else(|| panic!("{x} {cor}: {flags:?}"));
            assert!(outcome.energy.imbalance.abs() < 1e-9 * outcome.energy.initial);
            if let Some(before) = last.filter(|_| cor <= 1e-3) {
                assert!((outcome.exit_speed - before).abs() < 2e-3 * closing, "{x} {cor}");
            }
            last = Some(outcome.exit_speed);
        }
    }
}

/// Errors inferred from neighbouring places hold for a ball that is compressed once; the neighbours of one that is
/// compressed twice or hit again may be entirely different hits.
#[test]
fn a_hit_that_magnifies_what_is_small_is_estimated_by_itself() {
    let bat = bundled_bat("meshes/r161.json").unwrap();
    let solution = solve(&bat, &Request { modes: 10, tolerance: 1e-8, ..Request::plain() });
    let (solution, scene) = (solution.unwrap(), Scene { cor: 0.2, ..Scene::default() });
    let effort = Effort { accuracy: 1e-3, completed: true, unsettled: false };
    let hitter = Hitter::new(Model::Contact, &scene, &bat, &solution, effort).unwrap();
    let mut seen = [0; 2];
    for k in 0..40 {
        let x = bat.length() * (0.5 + 0.012 * f64::from(k));
        let [own, told] =
            [None, Some([0.0; 3])].map(|known| hitter.strike_all(&[(x, known)]).remove(0));
        let late = own.flags.iter().any(|flag| *flag != "ball_law_beyond");
        let of = |impact: Impact| impact.outcome.map_or(0.0, |outcome| outcome.truncation);
        let [own, told] = [own, told].map(of);
        seen[usize::from(late)] += 1;
        assert!(own > 0.0 && told == if late { own } else { 0.0 }, "{x} {late} {own} {told}");
    }
    assert!(seen[0] > 5 && seen[1] > 5, "{seen:?}");
}

/// A ball (145 g) with that stiffness and that restitution.
fn ball(stiffness: f64, exponent: f64, cor: f64) -> Ball {
    let (stiffness, exponent) = (Some(stiffness), Some(exponent));
    Ball { mass_kg: 0.145, stiffness, exponent, cor, ..Ball::baseball() }
}

/// Later touches make peaks of a millimetre: the best place is no worse than any of a grid of a fifth of that.
#[test]
fn the_best_place_is_the_best_where_later_touches_make_narrow_peaks() {
    let bat = bundled_bat("meshes/dowel.json").unwrap();
    let ball = ball(6.0845e6, 1.0, 0.5);
    let scene = Scene {
        swing: 74.7222,
        pivot: 0.420_927,
        ball_speed: 37.0,
        cor: 0.5,
        ball,
        ..Scene::default()
    };
    let solution = solve(&bat, &Request { modes: 15, ..Request::plain() }).unwrap();
    let effort = Effort { accuracy: 1e-6, completed: true, unsettled: false };
    let hitter = Hitter::new(Model::Contact, &scene, &bat, &solution, effort).unwrap();
    let spot = SweetSpot::find(&hitter);
    let steps = 2000;
    let place = |k: usize| bat.length() * (0.5 + 0.5 * k as f64 / steps as f64);
    let seen: Vec<Glance> = (0..=steps).filter_map(|k| hitter.glance(place(k))).collect();
    let fastest = seen.iter().map(|glance| glance.exit_speed).fold(0.0, f64::max);
    let least = seen.iter().filter_map(|glance| glance.vibration).fold(f64::INFINITY, f64::min);
    let first = seen.iter().filter(|glance| !glance.late).map(|glance| glance.first_exit);
    let first = first.fold(0.0, f64::max);
    let [best, calm] = [spot.exit_speed_max, spot.vibration_min].map(|peak| peak.unwrap().value);
    assert!(best >= fastest - 1e-6, "{best} {fastest}");
    assert!(calm <= least + 1e-6, "{calm} {least}");
    // One contact is smooth along the bat.
    assert!((spot.first_separation_max.unwrap().value - first).abs() < 1e-2, "{spot:?} {first}");
    assert!(first < fastest - 1.0);
}

/// The speed at the first separation is within its own error of that of fine steps and many modes.
#[test]
fn the_first_separation_states_its_error() {
    let bat = bundled_bat("meshes/r161.json").unwrap();
    let ball = ball(3e9, 1.84, 0.5);
    let scene =
        Scene { swing: 43.0, pivot: 0.0635, ball_speed: 37.0, cor: 0.5, ball, ..Scene::default() };
    let places: Vec<f64> = (0..12).map(|k| 0.45 + 0.03 * k as f64).collect();
    let of = |tolerance: f64| {
        let accuracy = Accuracy { exit_speed: tolerance, ..Accuracy::default() };
        sweep(&bat, Model::Contact, &scene, &accuracy, &places).unwrap()
    };
    let (rough, fine) = (of(1e-2), of(1e-6));
    let mut again = 0;
    for (rough, fine) in rough.impacts.iter().zip(&fine.impacts) {
        let of = |impact: &Impact| impact.outcome.as_ref().unwrap().first_separation.unwrap();
        let (one, other) = (of(rough), of(fine));
        let apart = (one.exit_speed - other.exit_speed).abs() / (rough.bat_speed + 37.0);
        assert!(apart <= one.error + other.error, "{} {apart} {}", rough.x, one.error);
        assert!(other.error < 1e-4, "{} {}", rough.x, other.error);
        again += usize::from(rough.flags.contains(&"second_contact"));
    }
    assert!(again > 2, "{again}");
}

/// A nearly dead ball stays on the bat and is hit by its vibration, with a law that was never measured; a usual ball is
/// not, and its law was measured. A ball that is pressed harder than any measured one is beyond the law too, and so is
/// one that is pressed by more than its radius.
#[test]
fn hits_beyond_the_ball_s_law_are_flagged() {
    let bat = bundled_bat("meshes/r161.json").unwrap();
    let at_speed = |cor: f64, ball_speed: f64, places: &[f64]| -> Vec<bool> {
        let scene = Scene { cor, ball_speed, ..Scene::default() };
        let hits = sweep(&bat, Model::Contact, &scene, &Accuracy::default(), places).unwrap();
        let has = |impact: &Impact| impact.flags.contains(&"ball_law_beyond");
        hits.impacts.iter().map(has).collect()
    };
    let flags = |cor: f64, places: &[f64]| at_speed(cor, Scene::default().ball_speed, places);
    let barrel = [0.6, 0.65, 0.7, 0.75];
    // The fastest pitch at the plate, and one twice as fast.
    assert_eq!(at_speed(0.5, 42.5, &barrel), [false; 4]);
    assert_eq!(at_speed(0.5, 85.0, &barrel), [true; 4]);
    assert_eq!(flags(0.5, &barrel), [false; 4]);
    assert_eq!(flags(0.3, &barrel), [true; 4]);
    assert_eq!(flags(0.44, &barrel), [false; 4]);
}
