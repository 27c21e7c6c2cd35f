//! The motion after a hit: identities and closed forms.

use sweetspot::bat::theory::Theory;
use sweetspot::collision::aftermath::Aftermath;
use sweetspot::collision::hit::{Effort, Model, Scene};
use sweetspot::collision::hitter::Hitter;
use sweetspot::{Bat, Request, Solution, solve};
use sweetspot_proof::bundled::bundled_bat;

const EXACTLY: Effort = Effort { accuracy: 1e-3, completed: false, unsettled: false };

fn r161() -> (Bat, Solution) {
    let bat = bundled_bat("meshes/r161.json").unwrap();
    let request =
        Request { modes: 20, tolerance: 1e-9, theory: Theory::Timoshenko, ..Request::default() };
    let solution = solve(&bat, &request).unwrap();
    (bat, solution)
}

/// The recorded force has the impulse of the hit, and gives every mode the energy that the hit states: after the
/// contact a point moves according to these energies.
#[test]
fn the_bat_goes_on_as_the_hit_left_it() {
    let (bat, solution) = r161();
    let scene = Scene::default();
    let hitter = Hitter::new(Model::Contact, &scene, &bat, &solution, EXACTLY).unwrap();
    for x in [0.45, 0.6, 0.7, 0.8] {
        let impact = hitter.strike(x);
        let again = impact.flags.contains(&"second_contact");
        let outcome = impact.outcome.unwrap();
        let after = Aftermath::new(&bat, &solution, x, hitter.force(x).unwrap());
        // Between two touches the ball flies.
        let flown = after.end() / outcome.contact_time.unwrap() - 1.0;
        assert!(if again { flown > 0.0 } else { flown.abs() < 1e-5 }, "{x} {flown}");
        for (line, (mode, energy)) in after
            .lines(0.13)
            .iter()
            .zip(solution.modes.iter().zip(&outcome.energy.vibration_by_mode))
        {
            // E = m ω² A²/2 of the amplitude A of the shape, φ(x) A of that at x.
            let shape = mode.shape.deflection(0.13).abs();
            let found = 0.5 * mode.modal_mass * (line.velocity_m_s / shape).powi(2);
            let whole = outcome.energy.vibration;
            assert!((found - energy).abs() < 1e-5 * whole, "{x} {} {found} {energy}", mode.order);
        }
        // The mean motion over a long time is that of a stiff bat with the same impulse.
        let (body, hands) = (bat.inertia(), 0.13);
        let [arm, lever] = [x, hands].map(|x| x - body.balance_point);
        let drift = -outcome.impulse * (1.0 / body.mass + arm * lever / body.about_balance);
        let (from, to) = (1.0, 21.0);
        let ends = after.at(&[from, to]);
        let [start, end] = [&ends[0], &ends[1]].map(|now| after.motion(hands, now)[0]);
        // The vibration adds some millimetres to some tens of metres.
        assert!(((end - start) / (to - from) - drift).abs() < 2e-3, "{x} {drift}");
    }
}

/// Velocity and acceleration are the derivatives of the displacement, at all times.
#[test]
fn velocities_are_derivatives() {
    let (bat, solution) = r161();
    let scene = Scene::default();
    let hitter = Hitter::new(Model::Contact, &scene, &bat, &solution, EXACTLY).unwrap();
    let after = Aftermath::new(&bat, &solution, 0.65, hitter.force(0.65).unwrap());
    let h = 1e-8;
    for t in [1e-5, 2e-4, 7e-4, 1.3e-3, 6e-3] {
        let three = after.at(&[t - h, t, t + h]);
        for x in [0.0, 0.13, 0.65, 0.84] {
            let [before, now, later] = [0, 1, 2].map(|k| after.motion(x, &three[k]));
            for k in 0..2 {
                let rate = (later[k] - before[k]) / (2.0 * h);
                let size = now[k + 1].abs().max([1.0, 1e4][k]);
                assert!((rate - now[k + 1]).abs() < 1e-4 * size, "{t} {x} {k} {rate}");
            }
        }
    }
}

/// Only the struck point moves before a wave arrives: shear waves of the R161, its fastest bending waves, travel at
/// √(κG/ρ) = 1270 m/s, and in Nathan's Fig. 9 (Am. J. Phys. 68, 979) the handle begins to move 0.5 to 0.6 ms after the
/// first contact.
#[test]
fn the_handle_hears_of_the_hit_after_half_a_millisecond() {
    let (bat, solution) = r161();
    let scene = Scene::default();
    let hitter = Hitter::new(Model::Contact, &scene, &bat, &solution, EXACTLY).unwrap();
    let after = Aftermath::new(&bat, &solution, 0.66, hitter.force(0.66).unwrap());
    let times: Vec<f64> = (0..=1000).map(|k| 1e-5 * f64::from(k)).collect();
    let begins = after.watched(0.13, &after.at(&times)).begins_s;
    assert!(begins > 0.4e-3 && begins < 0.65e-3, "{begins}");
}

/// A slow push bends the bat statically. With the inertia forces in equilibrium with the push, the bending moment under
/// a force F at a of a uniform free bar is known in closed form, and `ε = r M/EI`.
#[test]
fn a_slow_push_strains_as_statics_says() {
    use sweetspot::collision::contact::table::ForcePiece;
    let bat = bundled_bat("meshes/dowel.json").unwrap();
    let request = Request { modes: 60, tolerance: 1e-6, ..Request::plain() };
    let solution = solve(&bat, &request).unwrap();
    // Half a second up to 100 N: modes of 240 Hz and more follow.
    let force = 100.0;
    let piece =
        ForcePiece { start: 0.0, length: 0.5, powers: [0.0, 0.0, 3.0 * force, -2.0 * force, 0.0] };
    let a = 0.6;
    let after = Aftermath::new(&bat, &solution, a, vec![piece]);
    let now = &after.at(&[0.499_999_999])[0];
    let (length, body) = (bat.length(), bat.inertia());
    for x in [0.1, 0.3, 0.42, 0.55, 0.7] {
        // Loads per length μ(A + B (s − c)) with A = F/M, B = F (a − c)/I; M = ∫(x − s) load ds.
        let [per, c] = [body.mass / length, body.balance_point];
        let [push, turn] = [force / body.mass, force * (a - c) / body.line_about_balance];
        let inside = x * x / 2.0 * (push - turn * c) + turn * x * x * x / 6.0;
        let moment = per * inside - if x > a { force * (x - a) } else { 0.0 };
        let exact = bat.profile().at(x).outer * moment / bat.worth_at(x).bending;
        let found = after.strains(&[x], now, after.count())[0];
        let largest = 0.02 * force * bat.profile().at(x).outer / bat.worth_at(x).bending;
        assert!(
            (found.abs() - exact.abs()).abs() < 0.02 * largest.max(exact.abs()),
            "{x} {found} {exact}"
        );
    }
}

/// A maximum found in a short time is also found in a longer one.
#[test]
fn a_longer_look_finds_no_less() {
    use sweetspot_report::schema::ring::AfterHit;
    let (bat, solution) = r161();
    let scene = Scene::default();
    let hitter = Hitter::new(Model::Contact, &scene, &bat, &solution, Effort::default()).unwrap();
    let after = Aftermath::new(&bat, &solution, 0.65, hitter.force(0.65).unwrap());
    let mut before = [0.0; 4];
    for until in [1e-4, 2e-3, 0.02, 0.1, 3.0] {
        let report = AfterHit::new(&bat, &after, &[0.13], until);
        let peak = report.watched[0].peak;
        let motion = [peak.displacement_m, peak.velocity_m_s, peak.acceleration_m_s2];
        let now = [motion[0], motion[1], motion[2], report.strain_max.unwrap().strain];
        assert!(now.iter().zip(before).all(|(now, before)| *now >= before), "{until} {now:?}");
        before = now;
    }
}
