//! The uncertainty due to calipers, scale and wood: closed forms, and samples of bats.

use crate::common;

use common::folder::Folder;
use sweetspot::bat::edit::{Change, Edit};
use sweetspot::bat::profile::{Interpolation, Stations};
use sweetspot::bat::weighed::Weighed;
use sweetspot::collision::figures::Figures;
use sweetspot::collision::sweep::{Accuracy, Sweep, sweep};
use sweetspot::collision::sweet_spot::HitsAlong;
use sweetspot::collision::{Hitter, Model, Scene};
use sweetspot::modes::tuned::tuned;
use sweetspot::{Bat, Material, Profile, Request, Solution, Theory, solve};
use sweetspot_study::answers::Answer;
use sweetspot_study::spread::{Analysed, COUNTED, Input, Readings, Spread};

const ASH: [f64; 2] = [649.0, 18.14e9];

fn stations(x: &[f64], diameters: &[f64]) -> Stations {
    Stations {
        x: x.to_vec(),
        outer: diameters.iter().map(|d| 0.5 * d).collect(),
        inner: vec![0.0; x.len()],
        interpolation: Interpolation::Pchip,
    }
}

fn bat(stations: Stations, [density, modulus]: [f64; 2], weighed: Weighed) -> Bat {
    let material = Material::new(density, modulus).unwrap();
    let profile = Profile::new(stations).unwrap();
    let bat = Bat::builder(profile, material).weighed(weighed).build().unwrap();
    tuned(bat, Theory::EulerBernoulli, 1e-6).unwrap()
}

fn dowel() -> Stations {
    stations(&[0.0, 0.4, 0.84], &[0.04; 3])
}

/// Diameters (m) as a ruler and calipers find them on a wooden bat.
fn wooden() -> Stations {
    let x = [0.0, 0.013, 0.032, 0.076, 0.152, 0.305, 0.457, 0.61, 0.762, 0.84];
    let d = [0.047, 0.0495, 0.0305, 0.0249, 0.0241, 0.0267, 0.0381, 0.0584, 0.065, 0.062];
    stations(&x, &d)
}

fn hits(bat: &Bat, scene: &Scene) -> Sweep {
    let accuracy = Accuracy { exit_speed: 1e-3, ..Accuracy::plain() };
    sweep(bat, Model::Contact, scene, &accuracy, &[0.6, 0.7, 0.8]).unwrap()
}

fn modes(bat: &Bat) -> Solution {
    solve(bat, &Request { modes: 3, tolerance: 1e-8, ..Request::plain() }).unwrap()
}

fn spread(bat: &Bat, readings: &Readings) -> Spread {
    let scene = Scene::default();
    let (solution, hits) = (modes(bat), hits(bat, &scene));
    let hitter = Hitter::new(Model::Contact, &scene, bat, &hits.solution, hits.effort).unwrap();
    let figures = Figures::new(bat, &hitter, None).unwrap();
    let analysed = Analysed {
        bat,
        solution: &solution,
        model: Model::Contact,
        scene: &scene,
        law: None,
        hits: &hits,
        spot: &figures.spot,
    };
    Spread::new(&analysed, readings)
}

/// `f = (βL)²/2πL² √(EI/ρA)` is proportional to `√(E/ρ) d/L²`, the mass to `ρ d² L`. A difference over steps of h =
/// 0.05 in the logarithm is `sinh(h/4)/(h/4)` times the derivative of a root, i.e. 3e-5 more.
#[test]
fn a_dowel_s_spread_is_that_of_the_closed_form() {
    let bat = bat(dowel(), ASH, Weighed::default());
    let readings = Readings::default();
    let spread = spread(&bat, &readings);
    let inputs: Vec<Input> = spread.sources.iter().map(|source| source.input).collect();
    assert_eq!(inputs, [Input::Stiffness, Input::Density, Input::Diameters, Input::Length]);
    let thicker = readings.diameter / 0.04;
    let longer = readings.length / 0.84;
    let frequency = [0.5 * 0.22, -0.5 * 0.10, thicker, -2.0 * longer];
    let mass = [0.0, 0.10, 2.0 * thicker, longer];
    for (answer, expected) in [
        (Answer::Frequency(1), frequency),
        (Answer::Frequency(2), frequency),
        (Answer::Frequency(3), frequency),
        (Answer::Mass, mass),
    ] {
        let found = spread.of(answer).unwrap();
        for (part, expected) in found.parts.iter().zip(expected) {
            let part = part / found.value;
            assert!((part - expected).abs() < 5e-4 * expected.abs() + 1e-9, "{answer:?} {part}");
        }
        let together = expected.iter().map(|part| part * part).sum::<f64>().sqrt();
        let deviation = found.deviation.unwrap() / found.value;
        assert!((deviation / together - 1.0).abs() < 5e-4, "{answer:?} {deviation} {together}");
    }
    let (most, share) = spread.mostly(Answer::Frequency(1)).unwrap();
    assert!(most.input == Input::Stiffness && share > 0.8);
}

#[test]
fn a_scale_and_a_tap_take_the_place_of_the_wood() {
    let free = bat(wooden(), ASH, Weighed::default());
    let weighed = Weighed {
        mass: Some(free.inertia().mass),
        first_bending: Some(modes(&free).modes[0].frequency()),
        ..Weighed::default()
    };
    let both = bat(wooden(), ASH, weighed);
    let readings = Readings::default();
    let [open, settled] = [&free, &both].map(|bat| spread(bat, &readings));
    let inputs: Vec<Input> = settled.sources.iter().map(|source| source.input).collect();
    assert_eq!(inputs, [Input::Diameters, Input::Length, Input::Mass, Input::Tap]);
    let deviation = |spread: &Spread, answer| spread.of(answer).unwrap().deviation.unwrap();
    // A measured value is as accurate as the reading, regardless of the diameters.
    let read = deviation(&settled, Answer::Frequency(1)) / (0.01 * weighed.first_bending.unwrap());
    assert!((read - 1.0).abs() < 1e-9, "{read}");
    assert!((deviation(&settled, Answer::Mass) / 1e-3 - 1.0).abs() < 1e-9);
    for answer in COUNTED {
        let [open, settled] = [&open, &settled].map(|spread| deviation(spread, answer));
        // Only the diameters and the length affect a balance point.
        let less = if answer == Answer::BalancePoint { 1.001 } else { 0.3 };
        assert!(settled < less * open, "{answer:?} {settled} {open}");
    }
    let (most, _) = settled.mostly(Answer::Frequency(2)).unwrap();
    assert_eq!(most.input, Input::Tap);
}

/// A weight on the knob changes the answers, but not the remaining uncertainty of the wood after scale and tap.
#[test]
fn a_bat_that_was_weighed_and_tapped_before_its_edits_is_as_well_known_after_them() {
    let free = bat(wooden(), ASH, Weighed::default());
    let weighed = Weighed {
        mass: Some(free.inertia().mass),
        first_bending: Some(modes(&free).modes[0].frequency()),
        ..Weighed::default()
    };
    let before = bat(wooden(), ASH, weighed);
    let knob = Edit { name: None, change: Change::Knob(0.05) };
    let after = before.edited(&[knob]).unwrap();
    let readings = Readings { diameter: 0.0, length: 0.0, ..Readings::default() };
    let [before, after] = [&before, &after].map(|bat| spread(bat, &readings));
    let inputs = |spread: &Spread| -> Vec<Input> {
        spread.sources.iter().map(|source| source.input).collect()
    };
    assert_eq!(inputs(&before), inputs(&after));
    assert!(after.left_out.is_empty(), "{:?}", after.left_out);
    let deviation = |spread: &Spread, answer| spread.of(answer).unwrap().deviation.unwrap();
    // The wood weighs as much as before.
    let mass = deviation(&after, Answer::Mass) / deviation(&before, Answer::Mass);
    assert!((mass - 1.0).abs() < 1e-3, "{mass}");
    for answer in [Answer::Frequency(1), Answer::Frequency(2), Answer::Frequency(3)] {
        let share = |spread: &Spread| deviation(spread, answer) / spread.of(answer).unwrap().value;
        let [before, after] = [share(&before), share(&after)];
        assert!((after / before - 1.0).abs() < 0.02, "{answer:?} {before} {after}");
    }
}

/// Numbers that are normal with deviation 1, by Box and Muller, from a generator of Knuth's.
struct Normal(u64);

impl Normal {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        ((self.0 >> 11) as f64 + 0.5) / (1u64 << 53) as f64
    }

    fn next(&mut self) -> f64 {
        let (a, b) = (self.uniform(), self.uniform());
        (-2.0 * a.ln()).sqrt() * (std::f64::consts::TAU * b).cos()
    }
}

/// Mass, first two frequencies, best place and exit speed of a bat that was built anew.
fn found(bat: &Bat, scene: &Scene) -> [f64; 5] {
    let request = Request { modes: 12, tolerance: 1e-6, ..Request::plain() };
    let solution = solve(bat, &request).unwrap();
    let hitter = Hitter::new(Model::Contact, scene, bat, &solution, Default::default()).unwrap();
    let looked = HitsAlong::outer((24, 1e-4), &hitter);
    let best = looked.greatest(|seen| Some(seen.exit_speed)).unwrap();
    let [f1, f2] = [0, 1].map(|k| solution.modes[k].frequency());
    [bat.inertia().mass, f1, f2, best.x, best.value]
}

const SAMPLED: [Answer; 5] = [
    Answer::Mass,
    Answer::Frequency(1),
    Answer::Frequency(2),
    Answer::ExitSpeedPlace,
    Answer::ExitSpeed,
];

/// Standard deviations of a sample.
fn deviations(sample: &[[f64; 5]]) -> [f64; 5] {
    let count = sample.len() as f64;
    std::array::from_fn(|k| {
        let mean = sample.iter().map(|row| row[k]).sum::<f64>() / count;
        (sample.iter().map(|row| (row[k] - mean).powi(2)).sum::<f64>() / (count - 1.0)).sqrt()
    })
}

/// A sample of 160 determines a deviation to 1/√320, 6 % of it. The first order neglects the curvature of the answers
/// over 22 % of stiffness, some per cent more.
const SAMPLE: usize = 160;
const WITHIN: f64 = 0.2;

#[test]
fn a_sample_of_bats_scatters_as_the_first_order_says() {
    let scene = Scene::default();
    let spread = spread(&bat(wooden(), ASH, Weighed::default()), &Readings::default());
    let mut normal = Normal(7);
    let mut one = || {
        let mut made = wooden();
        let wider = 1e-4 * normal.next();
        made.outer.iter_mut().for_each(|r| *r += 0.5 * wider);
        let longer = 1.0 + 1e-3 / 0.84 * normal.next();
        made.x.iter_mut().for_each(|x| *x *= longer);
        let wood = [ASH[0] * (0.10 * normal.next()).exp(), ASH[1] * (0.22 * normal.next()).exp()];
        found(&bat(made, wood, Weighed::default()), &scene)
    };
    let sample: Vec<[f64; 5]> = (0..SAMPLE).map(|_| one()).collect();
    for (answer, sampled) in SAMPLED.into_iter().zip(deviations(&sample)) {
        let stated = spread.of(answer).unwrap().deviation.unwrap();
        assert!((sampled / stated - 1.0).abs() < WITHIN, "{answer:?} {sampled} {stated}");
    }
}

/// Every bat of the sample is weighed and tapped again, with random errors of the readings.
#[test]
fn a_sample_of_bats_that_were_weighed_and_tapped_scatters_as_the_first_order_says() {
    let scene = Scene::default();
    let free = bat(wooden(), ASH, Weighed::default());
    let (mass, note) = (free.inertia().mass, modes(&free).modes[0].frequency());
    let weighed =
        |mass, note| Weighed { mass: Some(mass), first_bending: Some(note), ..Weighed::default() };
    // Calipers so inaccurate that they matter in addition to the note.
    let readings = Readings { diameter: 5e-4, ..Readings::default() };
    let spread = spread(&bat(wooden(), ASH, weighed(mass, note)), &readings);
    let mut normal = Normal(11);
    let mut one = || {
        let mut made = wooden();
        let wider = readings.diameter * normal.next();
        made.outer.iter_mut().for_each(|r| *r += 0.5 * wider);
        let longer = 1.0 + 1e-3 / 0.84 * normal.next();
        made.x.iter_mut().for_each(|x| *x *= longer);
        let read = weighed(mass + 1e-3 * normal.next(), note * (1.0 + 0.01 * normal.next()));
        found(&bat(made, ASH, read), &scene)
    };
    let sample: Vec<[f64; 5]> = (0..SAMPLE).map(|_| one()).collect();
    for (answer, sampled) in SAMPLED.into_iter().zip(deviations(&sample)) {
        let stated = spread.of(answer).unwrap().deviation.unwrap();
        assert!((sampled / stated - 1.0).abs() < WITHIN, "{answer:?} {sampled} {stated}");
    }
}

/// The bats of `meshes/`, in every system of units: one screen of a terminal.
#[test]
fn an_analysis_is_one_screen_of_24_lines_and_80_columns() {
    let folder = Folder::new("screen");
    let meshes = concat!(env!("SWEETSPOT_TOP"), "/meshes");
    for entry in std::fs::read_dir(meshes).unwrap() {
        let path = entry.unwrap().path();
        for units in ["both", "si", "us"] {
            let text =
                folder.text(&["analyze", path.to_str().unwrap(), "--units", units, "--quiet"]);
            let wide = text.lines().filter(|line| line.chars().count() > 80).count();
            assert!(text.lines().count() <= 24 && wide == 0, "{units}\n{text}");
            for word in ["sweet spot", "fastest ball", "swing weight", "f3", "How far to trust it"]
            {
                assert!(text.contains(word), "{word}\n{text}");
            }
        }
    }
}

#[test]
fn a_tapped_bat_s_screen_has_no_wood_in_it_and_a_reading_that_cannot_be_is_refused() {
    let folder = Folder::new("tapped");
    let text = r#"{ "format": "sweetspot-bat/1", "material": "white-ash-dynamic",
        "weighed": { "mass": "31 oz", "first_bending_hz": 172 },
        "profile": { "unit": "in", "x": [0, 6, 20, 27, 33], "diameter": [1.0, 0.9, 1.6, 2.4, 2.5] } }"#;
    folder.write("bat.json", text);
    let shown = folder.text(&["analyze", "bat.json"]);
    assert!(!shown.contains("stiffness") && !shown.contains("Tap it"), "{shown}");
    let json = folder.json(&["analyze", "bat.json", "--json", "-", "--calipers", "0.2 mm"]);
    let sources = json["open"]["sources"].as_array().unwrap();
    let inputs: Vec<&str> = sources.iter().map(|s| s["input"].as_str().unwrap()).collect();
    assert_eq!(inputs, ["diameters", "length", "mass", "tap"]);
    assert_eq!(sources[0]["standard_deviation"], 2e-4);
    for (option, value) in [("--calipers", "-0.1 mm"), ("--scale", "5 kg"), ("--rule", "0.1 lb")] {
        let output = folder.run(&["analyze", "bat.json", &format!("{option}={value}")]);
        assert_eq!(output.status.code(), Some(2), "{option}");
        let said = String::from_utf8(output.stderr).unwrap();
        assert!(said.contains(option) && said.contains("expected"), "{said}");
    }
}

/// Showing fewer modes does not change the hits or the remarks on the wood; a measured balance point far from that of
/// the profile is reported.
#[test]
fn an_analysis_that_shows_one_mode_hits_as_one_that_shows_ten() {
    let folder = Folder::new("spread-shown");
    let of = |count: &str| folder.json(&["analyze", "r161", "-n", count, "--quiet", "--json", "-"]);
    let (one, ten) = (of("1"), of("10"));
    assert_eq!(one["modes"]["model"]["theory"], "timoshenko");
    assert_eq!(one["modes"]["modes"].as_array().unwrap().len(), 1);
    assert_eq!(one["hit"]["impacts"], ten["hit"]["impacts"]);
    let said = |args: &[&str]| {
        let output = folder.run(&[&["analyze"], args].concat());
        String::from_utf8_lossy(&output.stderr).into_owned()
    };
    for count in ["1", "10"] {
        assert!(said(&["northwestern_wood", "-n", count]).contains("shear is left out"), "{count}");
    }
    let bat = |balance: f64| {
        format!(
            r#"{{ "format": "sweetspot-bat/1", "material": "white-ash-dynamic",
               "profile": {{ "x": [0, 0.8], "diameter": [0.04, 0.04] }}, "weighed": {{ "balance_point": {balance} }} }}"#
        )
    };
    folder.write("near.json", bat(0.405));
    folder.write("far.json", bat(0.42));
    assert!(said(&["far.json"]).contains("balance point was measured at 0.42 m"));
    assert_eq!(said(&["near.json"]), "");
}
