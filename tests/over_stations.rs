//! Elements that reach over stations: their error is included in the stated one, for any bat.

use sweetspot::bat::fixtures::{Attachment, Fixtures, Tape};
use sweetspot::bat::material::Material;
use sweetspot::bat::profile::{Interpolation, Profile, Stations};
use sweetspot::modes::plan::Plan;
use sweetspot::modes::request::wanted;
use sweetspot::{Bat, Request, Solution, Theory, solve};

const LENGTH: f64 = 0.84;

fn wood() -> Material {
    let mut wood = Material::new(680.0, 14e9).unwrap();
    wood.shear_modulus = Some(1e9);
    wood
}

/// The outline of a bat (m), at a share of its length.
fn outline(s: f64) -> f64 {
    0.0125 + 0.0205 / (1.0 + (-14.0 * (s - 0.6)).exp()) + 0.008 * (-90.0 * s).exp()
}

/// That outline with that number of stations, rounded to that number of metres.
fn bat(
    count: usize,
    round: f64,
    interpolation: Interpolation,
    bore: f64,
    fixtures: Fixtures,
) -> Bat {
    let share = |k: usize| k as f64 / (count - 1) as f64;
    let x = (0..count).map(|k| LENGTH * share(k)).collect();
    let outer: Vec<f64> = (0..count).map(|k| (outline(share(k)) / round).round() * round).collect();
    let inner = outer.iter().map(|r| bore * r).collect();
    let profile = Profile::new(Stations { x, outer, inner, interpolation }).unwrap();
    Bat::builder(profile, wood()).fixtures(fixtures).build().unwrap()
}

fn bats() -> Vec<(&'static str, Bat)> {
    let plain = Fixtures::default;
    let knob = Attachment { x: 0.0, mass: 0.05, ..Attachment::default() };
    let inside = Attachment { x: 0.3, mass: 0.02, offset: 0.01, ..Attachment::default() };
    let weighted = Fixtures { attachments: vec![knob, inside], ..plain() };
    let tape = Tape { from: 0.1, to: 0.35, mass: 0.01 };
    let taped = Fixtures { tapes: vec![tape], ..plain() };
    let pchip = Interpolation::Pchip;
    vec![
        ("thirty stations", bat(30, 1e-6, pchip, 0.0, plain())),
        ("of straight sides", bat(30, 1e-6, Interpolation::Linear, 0.0, plain())),
        ("read with calipers", bat(40, 1e-4, pchip, 0.0, plain())),
        ("scanned", bat(1000, 1e-5, pchip, 0.0, plain())),
        ("hollow", bat(30, 1e-6, pchip, 0.8, plain())),
        ("with weights", bat(30, 1e-6, pchip, 0.0, weighted)),
        ("with tape", bat(30, 1e-6, pchip, 0.0, taped)),
    ]
}

#[test]
fn what_is_lost_at_stations_is_stated() {
    let mut over = 0;
    for (name, bat) in bats() {
        for theory in Theory::ALL {
            let exact =
                solve(&bat, &Request { modes: 6, tolerance: 1e-11, theory, ..Request::default() });
            let exact = exact.unwrap();
            for digits in 2..=8 {
                let tolerance = 10f64.powi(-digits);
                let request = Request { modes: 6, tolerance, theory, ..Request::default() };
                let found = solve(&bat, &request).unwrap();
                over += usize::from(found.mesh.over_stations());
                assert!(found.met(), "{name} {theory:?} 1e-{digits}");
                for (mode, exact) in found.modes.iter().zip(&exact.modes) {
                    let (off, stated) =
                        ((mode.omega / exact.omega - 1.0).abs(), mode.error.total());
                    let known = exact.error.total();
                    assert!(
                        off <= 1.5 * stated + known,
                        "{name} {theory:?} 1e-{digits}: {off:e} {stated:e}"
                    );
                    let off = (mode.modal_mass / exact.modal_mass - 1.0).abs();
                    assert!(off <= 3.0 * mode.error.modal_mass + 1e-9, "{name}: mass {off:e}");
                    for (node, exact) in mode.nodes.iter().zip(&exact.nodes) {
                        let off = (node - exact).abs();
                        assert!(off <= 3.0 * mode.error.nodes + 1e-9, "{name}: node {off:e}");
                    }
                }
            }
        }
    }
    assert!(over > 60, "elements over stations were hardly used: {over}");
}

/// Whatever the stations, elements hold the whole bat once, and end where something is fixed.
#[test]
fn elements_end_where_something_is_and_hold_the_bat_once() {
    for (name, bat) in bats() {
        let request = Request { modes: 6, tolerance: 1e-3, ..Request::plain() };
        let mesh = Plan::cheapest(&bat, &wanted(&request)).mesh;
        let nodes = mesh.nodes();
        assert!(nodes[0] == 0.0 && (nodes[nodes.len() - 1] - LENGTH).abs() < 1e-15, "{name}");
        for x in bat.fixtures().borders() {
            assert!(nodes.iter().any(|node| (node - x).abs() < 1e-12), "{name}: {x}");
        }
        for mesh in [mesh.refined(&bat, |k| 1 + k % 3), mesh] {
            for (k, e) in mesh.elements.iter().enumerate() {
                let parts: Vec<_> = e.parts(&bat).collect();
                assert!(
                    parts[0].of_element[0] == 0.0 && parts[parts.len() - 1].of_element[1] == 1.0
                );
                let whole: f64 =
                    parts.iter().map(|part| part.of_element[1] - part.of_element[0]).sum();
                assert!((whole - 1.0).abs() < 1e-13 && parts.len() == e.last - e.piece + 1);
                let next = mesh.elements.get(k + 1).map_or(LENGTH, |next| next.start);
                assert!((e.start + e.length - next).abs() < 1e-13, "{name}");
            }
        }
    }
}

/// A straight cone is the same bat with one inner station or twenty: there is no kink and no loss.
#[test]
fn stations_on_a_straight_line_are_none() {
    let cone = |count: usize| {
        let share = |k: usize| k as f64 / (count - 1) as f64;
        let stations = Stations {
            x: (0..count).map(|k| LENGTH * share(k)).collect(),
            outer: (0..count).map(|k| 0.012 + 0.02 * share(k)).collect(),
            inner: vec![0.0; count],
            interpolation: Interpolation::Linear,
        };
        Bat::builder(Profile::new(stations).unwrap(), wood()).build().unwrap()
    };
    let solved = |bat: &Bat, tolerance| -> Solution {
        solve(bat, &Request { modes: 5, tolerance, ..Request::plain() }).unwrap()
    };
    let exact = solved(&cone(2), 1e-12);
    let many = solved(&cone(21), 1e-8);
    assert!(many.mesh.over_stations() && many.mesh.len() < 8, "{}", many.mesh.len());
    for (a, b) in many.modes.iter().zip(&exact.modes) {
        assert!((a.omega / b.omega - 1.0).abs() <= 1.5 * a.error.total() + 1e-12);
    }
}
