//! All modes up to a frequency and no others, for beams with known frequencies.

use crate::common;

use std::f64::consts::TAU;
use std::fs;
use std::path::Path;

use common::folder::{Folder, but_shear};
use common::{DENSITY, LENGTH, MODULUS, RADIUS, dowel, dowel_frequency};
use sweetspot::bat::fixtures::{Attachment, Fixtures, Held, Support};
use sweetspot::bat::theory::Theory;
use sweetspot::modes::up_to::modes_up_to;
use sweetspot::{Bat, Request, solve};

fn held(fixtures: Fixtures) -> Bat {
    dowel().with(|parts| parts.fixtures = fixtures).unwrap()
}

fn clamped() -> Bat {
    let support = Support { x: 0.0, kind: Held::Clamped };
    held(Fixtures { supports: vec![support], ..Fixtures::default() })
}

/// Frequency (Hz) of mode n of the dowel clamped at one end, `cos β cosh β = −1`: the root near
/// `(n − ½)π` by Newton's method on `cos β + 1/cosh β`.
fn cantilever_frequency(n: usize) -> f64 {
    let mut beta = (n as f64 - 0.5) * std::f64::consts::PI;
    for _ in 0..20 {
        let f = beta.cos() + 1.0 / beta.cosh();
        beta += f / (beta.sin() + beta.tanh() / beta.cosh());
    }
    let stiffness_over_mass = MODULUS * RADIUS * RADIUS / (4.0 * DENSITY);
    (beta / LENGTH).powi(2) * stiffness_over_mass.sqrt() / TAU
}

#[test]
fn a_free_dowel_and_a_clamped_one_have_as_many_modes_as_theory_says() {
    let request = Request::plain();
    let (free, clamped) = (dowel(), clamped());
    assert!((cantilever_frequency(1) / dowel_frequency(1) - 0.157_15).abs() < 1e-4);
    for n in 0..=40 {
        for (bat, frequency) in
            [(&free, dowel_frequency as fn(usize) -> f64), (&clamped, cantilever_frequency)]
        {
            let below = if n == 0 { 0.0 } else { frequency(n) };
            for share in [0.01, 0.5, 0.99] {
                let limit = below + share * (frequency(n + 1) - below);
                assert_eq!(modes_up_to(bat, &request, limit).unwrap(), n, "{limit} Hz");
            }
        }
    }
}

#[test]
fn what_is_counted_is_what_is_solved() {
    let folder = Path::new(env!("SWEETSPOT_TOP")).join("meshes");
    let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut bats: Vec<Bat> = files.map(|path| Bat::from_file(path).unwrap()).collect();
    let spring = Attachment { x: 0.2, stiffness: 1e3, mass: 0.1, ..Attachment::default() };
    bats.push(held(Fixtures { attachments: vec![spring], ..Fixtures::default() }));
    bats.push(clamped());
    for bat in &bats {
        for theory in Theory::ALL {
            if theory.shears() && !bat.knows_shear() {
                continue;
            }
            let request = Request { modes: 20, theory, ..Request::default() };
            let all = solve(bat, &request).unwrap().modes;
            for limit in [100.0, 700.0, 3000.0, 8000.0] {
                let below = all.iter().filter(|mode| mode.frequency() <= limit).count();
                if below < all.len() {
                    let counted = modes_up_to(bat, &request, limit).unwrap();
                    assert_eq!(counted, below, "{} {theory:?} {limit} Hz", bat.name());
                }
            }
        }
    }
}

#[test]
fn no_listed_mode_is_above_a_limit_that_is_on_a_mode() {
    let bat = dowel();
    for n in 1..=8 {
        for off in [-1e-4, -1e-9, 0.0, 1e-9, 1e-4] {
            let limit = dowel_frequency(n) * (1.0 + off);
            for (tolerance, elements) in [(1e-4, None), (1e-10, None), (1e-4, Some(7))] {
                let request = Request { tolerance, elements, ..Request::plain() };
                let modes = modes_up_to(&bat, &request, limit).unwrap();
                assert!((n - 1..=n).contains(&modes), "{n} {off:e}: {modes}");
                let solution = solve(&bat, &Request { modes, ..request }).unwrap();
                assert!(solution.modes.iter().all(|mode| mode.frequency() <= limit));
                if elements.is_none() && off.abs() > 3.0 * tolerance {
                    assert_eq!(modes, if off > 0.0 { n } else { n - 1 }, "{n} {off:e}");
                }
            }
        }
    }
}

#[test]
fn four_hundred_modes_are_the_most() {
    let (bat, request) = (dowel(), Request::plain());
    let limit = 0.5 * (dowel_frequency(400) + dowel_frequency(401));
    assert_eq!(modes_up_to(&bat, &request, limit).unwrap(), 400);
    for limit in [dowel_frequency(401) * 1.001, 1e9] {
        let told = modes_up_to(&bat, &request, limit).unwrap_err().to_string();
        assert!(told.contains("more than 400 bending modes below it"), "{told}");
    }
    for limit in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let told = modes_up_to(&bat, &request, limit).unwrap_err().to_string();
        assert!(told.contains("above 0"), "{told}");
    }
}

#[test]
fn the_program_lists_and_uses_the_modes_up_to_there() {
    let folder = Folder::new("up-to");
    let bat = format!("{}/meshes/r161.json", env!("SWEETSPOT_TOP"));
    // Its fourth mode is at 1855 Hz, its fifth at 2571 Hz.
    for (verb, more) in [
        ("modes", &["--reproducible", "--json", "-"][..]),
        ("modes", &[]),
        ("hit", &["--points", "2", "--json", "-"]),
        ("ring", &["--at", "0.6", "--impulse", "1", "--json", "-"]),
        ("ring", &["--hit", "0.6", "--json", "-"]),
        ("frf", &["--at", "0.6", "--frequencies", "50", "--json", "-"]),
    ] {
        let run = |option: &[&str]| folder.text(&[&[verb, &bat], option, more].concat());
        let counted = run(&["-n", "4"]);
        assert_eq!(run(&["--up-to", "2000"]), counted, "{verb}");
        assert_eq!(run(&["--up-to", "2 kHz"]), counted, "{verb}");
    }
    let output = folder.run(&["modes", &bat, "--up-to", "100", "--json", "-"]);
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(but_shear(&told), "note: no bending mode up to 100 Hz: the first is at 174.5 Hz\n");
    let document: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(document["modes"], serde_json::json!([]));
    let quiet = folder.run(&["modes", &bat, "--up-to", "100", "--quiet"]);
    assert!(quiet.status.success() && quiet.stderr.is_empty());
}
