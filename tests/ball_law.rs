//! A user's own law of a ball: a type with [`ForceLaw`], and one line in the ball that uses it.

use std::f64::consts::PI;

use sweetspot::collision::ball::{Ball, LawOf};
use sweetspot::collision::contact::collider::Collider;
use sweetspot::collision::contact::force_law::{ForceLaw, Top};
use sweetspot::collision::contact::touch::DrivingPoint;
use sweetspot::collision::hit::{Effort, Model, Scene};
use sweetspot::collision::hitter::Hitter;
use sweetspot::{Request, solve};
use sweetspot_proof::bundled::bundled_bat;

/// A linear spring without loss, of that stiffness (N/m).
#[derive(Clone, Copy)]
struct Linear(f64);

impl ForceLaw for Linear {
    fn force(&self, x: f64, _: Option<Top>) -> [f64; 2] {
        if x > 0.0 { [self.0 * x, self.0] } else { [0.0; 2] }
    }

    fn energy_of(&self, x: f64, force: f64, _: Option<Top>) -> [f64; 2] {
        [0.5 * force * x.max(0.0), 0.0]
    }

    fn compression(&self, energy: f64) -> f64 {
        (2.0 * energy / self.0).sqrt()
    }

    fn exponent(&self, _: Option<Top>) -> f64 {
        1.0
    }
}

/// Half a period of `μ x″ + k x = 0`: contact time `π √(μ/k)`, impulse `2 μ u`, largest force
/// `u √(μ k)`, no loss.
#[test]
fn a_linear_spring_on_a_rigid_free_bat_takes_half_a_period_and_loses_nothing() {
    let (ball, bat, stiffness) = (0.145, 0.9, 3e6);
    let reduced = 1.0 / (1.0 / ball + 1.0 / bat);
    let felt = DrivingPoint { inverse_mass: 1.0 / reduced, ..DrivingPoint::default() };
    let half_a_period = PI * (reduced / stiffness).sqrt();
    for speed in [1e-2, 1.0, 60.0] {
        let collider = Collider::new(&[], 0.1 * half_a_period);
        let met = collider.meet(&felt, &Linear(stiffness), speed, 1e-9);
        let near = |found: f64, exact: f64| (found / exact - 1.0).abs() < 1e-10;
        assert!(near(met.time, half_a_period), "{} {half_a_period}", met.time);
        assert!(near(met.impulse, 2.0 * reduced * speed), "{}", met.impulse);
        assert!(near(met.peak_force, speed * (reduced * stiffness).sqrt()), "{}", met.peak_force);
        assert!(met.lost_in_ball == 0.0 && met.is_sound(&felt, speed) && !met.again());
    }
}

/// The static curve of the ball determines the law in every hit: this spring and the power law with the same numbers
/// are equal, also on a vibrating bat.
#[test]
fn a_ball_with_a_law_of_its_own_is_hit_like_any_other() {
    let bat = bundled_bat("meshes/r161.json").unwrap();
    let solution = solve(&bat, &Request { modes: 12, ..Request::plain() }).unwrap();
    let effort = Effort { accuracy: 1e-9, ..Effort::default() };
    let power = Ball { cor: 1.0, ..Ball::baseball().linear(3e6).unwrap() };
    let own = Ball { law: LawOf(|of| Box::new(Linear(of.stiffness))), ..power.clone() };
    let [power, own] = [power, own].map(|ball| Scene { cor: 1.0, ball, ..Scene::default() });
    let hitter = |scene| Hitter::new(Model::Contact, scene, &bat, &solution, effort).unwrap();
    let (power, own) = (hitter(&power), hitter(&own));
    for x in [0.55, 0.65, 0.72, 0.8] {
        let [a, b] = [&power, &own].map(|hitter| hitter.strike(x).outcome.unwrap());
        assert!(
            (a.exit_speed - b.exit_speed).abs() < 1e-5,
            "{x} {} {}",
            a.exit_speed,
            b.exit_speed
        );
        assert!(b.energy.imbalance.abs() < 1e-9 * b.energy.initial && b.error < 0.01);
    }
}

/// A ball whose stiffness increases with the speed: at each place the hit equals that of a ball with the fixed
/// stiffness that belongs to the speed there, `v² = μ u²/m` on a rigid wall.
#[test]
fn a_law_may_depend_on_the_speed_of_the_hit() {
    const BY_SPEED: fn(f64) -> f64 = |speed| 1e6 + 5e4 * speed;
    let bat = bundled_bat("meshes/r161.json").unwrap();
    let solution = solve(&bat, &Request { modes: 12, ..Request::plain() }).unwrap();
    let effort = Effort { accuracy: 1e-9, ..Effort::default() };
    let known = Ball { cor: 1.0, ..Ball::baseball().linear(3e6).unwrap() };
    let ball = Ball { law: LawOf(|of| Box::new(Linear(BY_SPEED(of.speed)))), ..known.clone() };
    let scene = Scene { cor: 1.0, ball, ..Scene::default() };
    let hitter = Hitter::new(Model::Contact, &scene, &bat, &solution, effort).unwrap();
    let line = bat.inertia().as_line();
    for x in [0.55, 0.72, 0.8] {
        let hit = hitter.strike(x);
        let closing = hit.bat_speed + scene.ball_speed;
        let recoil = 1.0 / line.mass + (x - line.balance_point).powi(2) / line.about_balance;
        let reduced = 1.0 / (1.0 / known.mass_kg + recoil);
        let stiffness = BY_SPEED((reduced / known.mass_kg).sqrt() * closing);
        let ball = known.clone().linear(stiffness).unwrap();
        let same = Scene { ball, ..scene.clone() };
        let same = Hitter::new(Model::Contact, &same, &bat, &solution, effort).unwrap().strike(x);
        let [a, b] = [&hit, &same].map(|hit| hit.outcome.as_ref().unwrap());
        assert!((a.exit_speed - b.exit_speed).abs() < 1e-6 * closing, "{x} {a:?} {b:?}");
        assert!((a.peak_force.unwrap() / b.peak_force.unwrap() - 1.0).abs() < 1e-6);
    }
}
