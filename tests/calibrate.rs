//! Results of `sweetspot calibrate`: the numbers of an independent solver, and closed forms.

use crate::common;

use std::io::Write;
use std::process::Stdio;

use common::folder::Folder;
use sweetspot::modes::shares::Shares;
use sweetspot::{Bat, Request, Theory, solve};
use sweetspot_study::calibrate::calibration::{
    Calibration, CalibrationPlan, Estimated, Property, Verdict, WithoutOutliers,
};
use sweetspot_study::calibrate::fit::{Search, data};
use sweetspot_study::calibrate::readings::{
    BatReadings, Pendulum, Priors, Reading, ShearPrior, SpectralLine,
};
use sweetspot_study::calibrate::unknowns::UNKNOWNS;
use sweetspot_study::calibrate::wood::WoodenBat;

const R161: &str = include_str!("../meshes/r161.json");

/// The prior of the independent solver: no property is correlated with another.
const INDEPENDENT: Priors = Priors {
    youngs_modulus: 0.22,
    shear: ShearPrior::Alone(0.35),
    density: 0.10,
    correlation: 0.0,
    modulus_ratio: 0.08,
    densities_together: 0.95,
};

fn reading(value: f64, deviation: f64) -> Reading {
    Reading { value, deviation }
}

/// The R161 of a handbook's ash, from which the search begins.
fn handbook() -> Bat {
    let bat = Bat::from_text("r161.json", R161, "".as_ref()).unwrap();
    bat.with(|parts| {
        parts.material.youngs_modulus = 12e9;
        parts.material.shear_modulus = Some(1.1e9);
        parts.material.density = 672.0;
    })
    .unwrap()
}

fn lines(all: &[(f64, f64, usize)]) -> Vec<SpectralLine> {
    let line = |(hz, within, mode): &(f64, f64, usize)| SpectralLine {
        frequency: reading(*hz, *within),
        mode: Some(*mode),
    };
    all.iter().map(line).collect()
}

/// A bat of 18.14 GPa, 1.05 GPa and 649 kg/m³, read with a scale, a ruler, a watch and a microphone.
fn sound() -> BatReadings {
    BatReadings {
        mass: Some(reading(0.869, 1e-3)),
        balance_point: Some(reading(0.561, 1e-3)),
        pendulum: Some(Pendulum { pivot: 0.1524, period: reading(1.470, 1e-3) }),
        lines: lines(&[(174.5, 0.3, 1), (581.3, 0.5, 2), (1187.0, 1.0, 3), (1854.8, 1.5, 4)]),
        model: 1e-3,
        priors: INDEPENDENT,
        ..BatReadings::default()
    }
}

fn near(found: f64, known: f64, half_a_digit: f64) {
    assert!((found - known).abs() <= half_a_digit, "{found} is not {known}");
}

fn of(found: &[Estimated], property: Property) -> (f64, f64) {
    let one = found.iter().find(|one| one.property == property).unwrap();
    (one.value, 100.0 * one.relative_sd)
}

#[test]
fn c1_two_regions_are_found_with_their_intervals() {
    let plan = CalibrationPlan { split: Some(0.42), held: vec![] };
    let found = Calibration::new(&handbook(), sound(), &plan).unwrap();
    for (property, scale, value, half, sd) in [
        (Property::YoungsModulus, 1e9, 18.117, 5e-4, 0.92),
        (Property::ShearModulus, 1e9, 1.0475, 5e-5, 3.52),
        (Property::Density, 1.0, 648.38, 5e-3, 0.81),
        (Property::BarrelDensity, 1.0, 649.18, 5e-3, 0.26),
        (Property::ModulusRatio, 1.0, 1.0024, 5e-5, 2.93),
    ] {
        let (v, s) = of(&found.parameters, property);
        near(v / scale, value, half);
        near(s, sd, 5e-3);
    }
    assert!(found.fits && found.steps <= 8, "{}", found.steps);
}

#[test]
fn c1_one_region_is_found_with_its_intervals() {
    let found = Calibration::new(&handbook(), sound(), &CalibrationPlan::default()).unwrap();
    for (property, scale, value, half, sd) in [
        (Property::YoungsModulus, 1e9, 18.139, 5e-4, 0.32),
        (Property::ShearModulus, 1e9, 1.0503, 5e-5, 1.42),
        (Property::Density, 1.0, 649.00, 5e-3, 0.12),
    ] {
        let (v, s) = of(&found.parameters, property);
        near(v / scale, value, half);
        near(s, sd, 5e-3);
    }
    for one in &found.parameters {
        assert_eq!(one.verdict, Verdict::Determined);
    }
}

/// A. M. Nathan, Am. J. Phys. 68 (2000) 979: his measurements do not fit the profile of the file.
#[test]
fn c2_the_published_r161_does_not_fit_and_f1_and_balance_point_are_found() {
    let bat = Bat::from_text("r161.json", R161, "".as_ref()).unwrap();
    let measured = [(165.0, 0.5, 1), (568.0, 0.5, 2), (1177.0, 0.5, 3), (1851.0, 0.5, 4)];
    let readings = BatReadings {
        mass: Some(reading(0.885, 1e-3)),
        balance_point: Some(reading(0.564, 1e-3)),
        lines: lines(&measured),
        priors: INDEPENDENT,
        ..BatReadings::default()
    };
    let found = Calibration::new(&bat, readings, &CalibrationPlan::default()).unwrap();
    near(found.chi2, 30.7, 0.05);
    assert_eq!(found.expected, 6);
    let names: Vec<(String, f64)> = found
        .data
        .iter()
        .filter(|residual| residual.is_outlier())
        .map(|residual| (residual.datum.kind.name(), residual.left_out_sd))
        .collect();
    assert_eq!(names.len(), 2, "{names:?}");
    assert_eq!((&*names[0].0, &*names[1].0), ("balance_point_m", "f1_hz"));
    near(names[0].1, 3.1, 0.05);
    near(names[1].1, -4.4, 0.05);
    assert!(!found.fits && found.labels.told.is_none());
    let WithoutOutliers { parameters: without, chi2, expected } = found.without_outliers.unwrap();
    near(chi2, 1.4, 0.05);
    assert_eq!(expected, 4);
    let (e, e_sd) = of(&without, Property::YoungsModulus);
    let (g, g_sd) = of(&without, Property::ShearModulus);
    near(e / 1e9, 17.343, 5e-4);
    near(e_sd, 0.93, 5e-3);
    near(g / 1e9, 1.302, 5e-4);
    near(g_sd, 5.1, 0.05);
    near(of(&without, Property::Density).0, 660.95, 5e-3);
}

#[test]
fn c3_mislabelled_lines_are_found_and_relabelled() {
    let wrong = lines(&[(174.5, 0.3, 1), (1187.0, 1.0, 2), (1854.8, 1.5, 3)]);
    let readings = BatReadings { lines: wrong, ..sound() };
    let plan = CalibrationPlan { split: Some(0.42), held: vec![] };
    let found = Calibration::new(&handbook(), readings, &plan).unwrap();
    let identified = &found.labels;
    assert_eq!(identified.told.as_ref().unwrap(), &[Some(1), Some(2), Some(3)]);
    assert!(identified.told_chi2.unwrap() > 10_000.0, "{:?}", identified.told_chi2);
    assert_eq!(identified.taken, [Some(1), Some(3), Some(4)]);
    near(identified.chi2, 3.7, 0.05);
    // With this profile no wood has f4 and f5 as far apart as 1187 and 1854.8 Hz, or f3 and f5 as close.
    let (second, chi2) = (identified.second.as_ref().unwrap(), identified.second_chi2.unwrap());
    assert!(second != &identified.taken && chi2 > 53.0, "{second:?} {chi2}");
}

#[test]
fn c4_shares_of_energy_are_the_derivatives_of_the_frequencies() {
    const BENDING: [f64; 5] = [0.4918378, 0.4567961, 0.4115629, 0.3703576, 0.3259064];
    let bat = Bat::from_text("r161.json", R161, "".as_ref()).unwrap();
    let theory = Theory::Timoshenko;
    let request = Request { modes: 5, tolerance: 1e-11, theory, ..Request::default() };
    let solution = solve(&bat, &request).unwrap();
    for (mode, known) in solution.modes.iter().zip(BENDING) {
        let shares = Shares::of(&bat, mode, theory, &[0.0, bat.length()], |_| true);
        near(0.5 * shares.bending[0], known, 5e-8);
        near(0.5 * shares.shear[0], 0.5 - known, 5e-8);
        near(0.5 * shares.kinetic[0], 0.5, 1e-9);
    }
}

/// Standard deviations in per cent of E, G, both densities and the ratio of E after the readings.
#[test]
fn what_is_determined_is_what_the_readings_can_say() {
    let all = sound();
    let few = BatReadings {
        balance_point: None,
        pendulum: None,
        lines: all.lines[..1].to_vec(),
        ..all.clone()
    };
    let tones = BatReadings { mass: None, balance_point: None, pendulum: None, ..all.clone() };
    let wood = WoodenBat::new(&handbook(), Some(0.42), 0.1524).unwrap();
    for (readings, known) in [
        (few, [2.1, 35.0, 2.4, 0.7, 8.0]),
        (tones, [8.8, 9.4, 8.8, 8.8, 3.1]),
        (all, [0.9, 3.5, 0.8, 0.3, 2.9]),
    ] {
        let search = Search { wood: &wood, readings: &readings, held: &[], about: [0.0; UNKNOWNS] };
        let labels: Vec<_> = readings.lines.iter().map(|line| line.mode).collect();
        let c = search.fit(&data(&readings, &labels), 5, &[0.0; UNKNOWNS]).unwrap().covariance;
        let shear = c[0][0] + 2.0 * c[0][1] + c[1][1];
        let variances = [c[0][0], shear, c[2][2], c[3][3], c[4][4]];
        for (found, known) in variances.map(|variance| 100.0 * variance.sqrt()).iter().zip(known) {
            near(*found, known, 0.06);
        }
    }
}

/// With one frequency, G/E fixed and no prior for E, E is that of the one-number form.
#[test]
fn one_tap_alone_gives_the_factor_of_the_bat_file() {
    let text = r#"{ "format": "sweetspot-bat/1", "material": "white-ash-dynamic",
        "weighed": { "mass": "31 oz", "first_bending_hz": 170 },
        "profile": { "unit": "in", "x": [0, 6, 20, 27, 33], "diameter": [1.0, 0.9, 1.6, 2.4, 2.5] } }"#;
    let file = Bat::from_text("bat.json", text, "".as_ref()).unwrap();
    let tapped = sweetspot::modes::tuned::tuned(file.clone(), Theory::Timoshenko, 1e-9).unwrap();
    let bare =
        Bat::from_text("bat.json", &text.replace(", \"first_bending_hz\": 170", ""), "".as_ref());
    let mut readings =
        BatReadings { lines: lines(&[(170.0, 1e-3, 1)]), model: 1e-7, ..BatReadings::default() };
    readings.priors.youngs_modulus = 1e3;
    readings.priors.correlation = 0.0;
    let held = vec![Property::ShearModulus, Property::Density];
    let plan = CalibrationPlan { split: None, held };
    let found = Calibration::new(&bare.unwrap(), readings, &plan).unwrap();
    let (e, _) = of(&found.parameters, Property::YoungsModulus);
    let known = tapped.material().youngs_modulus;
    assert!((e / known - 1.0).abs() < 1e-6, "{e} {known}");
}

/// The written file is the bat that was found, with its uncertainty.
#[test]
fn the_written_bat_is_the_one_that_was_found() {
    let folder = Folder::new("calibrate");
    folder.write("r161.json", R161);
    folder.write("readings.json", include_str!("golden/readings-1.json"));
    for more in [&[][..], &["--regions", "42 cm"]] {
        let args = ["calibrate", "r161.json", "readings.json", "--out", "mine.json", "--json", "-"];
        let found = folder.json(&[&args[..], more].concat());
        let solved = folder.json(&[
            "modes",
            "mine.json",
            "-n",
            "3",
            "--theory",
            "timoshenko",
            "--json",
            "-",
        ]);
        for datum in found["data"].as_array().unwrap() {
            let computed = datum["computed"].as_f64().unwrap();
            let name = datum["name"].as_str().unwrap();
            let again = match name {
                "mass_kg" | "balance_point_m" => solved["summary"][name].as_f64(),
                "pendulum_period_s" => None,
                name => {
                    let order: usize = name[1..2].parse().unwrap();
                    solved["modes"][order - 1]["frequency_hz"].as_f64()
                }
            };
            if let Some(again) = again {
                assert!((again / computed - 1.0).abs() < 1e-4, "{name} {again} {computed}");
            }
        }
        let text = folder.read("mine.json");
        assert!(text.contains("95 % from") && text.contains("\"loss_factor\": 0.0145"), "{text}");
    }
}

/// Runs `calibrate` with these answers.
fn answered(folder: &Folder, answers: &str) -> std::process::Output {
    let asked = ["calibrate", "r161", "--ask", "--readings", "kept.json", "--json", "-"];
    let mut command = folder.command(&asked);
    let piped = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = piped.spawn().unwrap();
    child.stdin.take().unwrap().write_all(answers.as_bytes()).unwrap();
    child.wait_with_output().unwrap()
}

#[test]
fn answers_are_asked_and_kept() {
    let folder = Folder::new("calibrate_asked");
    // The answers end after two of them; the same command continues with the third.
    let output = answered(&folder, "30.65 oz\n56.1 cm\n");
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{told}");
    let plain = told.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(plain.contains("kept in kept.json.draft"), "{told}");
    assert_eq!(folder.names(), ["kept.json.draft"]);
    let output = answered(&folder, "yes\n14.70\n174.5, 581.3, 1187\n\n");
    assert!(output.status.success(), "{output:?}");
    assert_eq!(folder.names(), ["kept.json"]);
    let again = folder.json(&["calibrate", "r161", "kept.json", "--json", "-"]);
    let first: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(first["parameters"], again["parameters"]);
    assert_eq!(first["labels"]["taken"], serde_json::json!([1, 2, 3]));
    assert_eq!(first["data"].as_array().unwrap().len(), 6);
}

#[test]
fn a_mismatch_is_a_failed_check() {
    let folder = Folder::new("calibrate_mismatch");
    let text = r#"{ "format": "sweetspot-readings/1", "mass": "0.885 kg", "balance_point": "0.564 m",
        "lines": [ { "hz": 165, "mode": 1 }, { "hz": 568, "mode": 2 }, { "hz": 1177, "mode": 3 },
            { "hz": 1851, "mode": 4 } ] }"#;
    folder.write("nathan.json", text);
    let output = folder.run(&["calibrate", "r161", "nathan.json"]);
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("The readings do not fit this bat"), "{said}");
    let plain = said.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(plain.contains("balance_point_m (+3.1 sd), f1_hz (-4.5 sd)"), "{said}");
}

/// Tones of an R161 of 18.14 GPa and G/E 0.0579 (its modes), and a file whose E is wrong: the labels are sought for
/// every wood, and E is found from any starting value.
#[test]
fn tones_say_what_the_wood_is_wherever_the_search_begins() {
    let tones = [174.51, 581.26, 1187.04, 1854.82, 2550.9];
    let own = Bat::from_text("r161.json", R161, "".as_ref()).unwrap();
    let request = Request { modes: 5, theory: Theory::Timoshenko, ..Request::default() };
    let solved = solve(&own, &request).unwrap();
    for (mode, tone) in solved.modes.iter().zip(tones).take(4) {
        near(mode.frequency(), tone, 0.01);
    }
    let fifth = solved.modes[4].frequency();
    let tones: Vec<f64> = tones[..4].iter().copied().chain([fifth]).collect();
    for e in [6e9, 7.5e9, 9e9, 10.5e9, 40e9] {
        let bat = own
            .with(|parts| {
                parts.material.youngs_modulus = e;
                parts.material.shear_modulus = Some(e * 1.05 / 18.14);
            })
            .unwrap();
        for (from, to) in [(1, 4), (1, 3), (2, 4), (2, 5), (1, 2)] {
            let line = |hz: &f64| SpectralLine { frequency: reading(*hz, 0.5), mode: None };
            let lines = tones[from - 1..to].iter().map(line).collect();
            let mass = Some(reading(0.8694, 1e-3));
            let readings = BatReadings { mass, lines, ..BatReadings::default() };
            let found = Calibration::new(&bat, readings, &CalibrationPlan::default()).unwrap();
            let [low, high] = found.parameters[0].interval95;
            assert!(low < 18.14e9 && 18.14e9 < high, "{e} {from} to {to}: {low:e} {high:e}");
            let labels: Vec<_> = (from..=to).map(Some).collect();
            assert_eq!(found.labels.taken, labels, "{e} {from} to {to}");
        }
    }
}

#[test]
fn a_hum_is_a_stranger_and_readings_of_another_bat_do_not_fit() {
    let folder = Folder::new("calibrate_strangers");
    let calibrated = |lines: &str| {
        let text = format!(
            r#"{{ "format": "sweetspot-readings/1", "mass": "0.8694 kg ± 1 g", "lines": [{lines}] }}"#
        );
        folder.write("readings.json", text);
        let output = folder.run(&["calibrate", "r161", "readings.json", "--json", "-"]);
        let document: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        (document, output.status.code())
    };
    let three = r#"{ "hz": 174.51 }, { "hz": 581.26 }, { "hz": 1187.04 }"#;
    let (found, code) = calibrated(&format!("{three}, {{ \"hz\": 120 }}"));
    assert_eq!(code, Some(0), "{found}");
    near(found["parameters"][0]["value"].as_f64().unwrap() / 1e9, 18.14, 0.1);
    assert_eq!(found["labels"]["taken"], serde_json::json!([1, 2, 3, null]));
    assert!(found["labels"]["second"].is_array(), "{found}");
    // No wood has these frequencies: most of them are left out, and the run is not a success.
    let (found, code) =
        calibrated(r#"{ "hz": 174.51 }, { "hz": 260 }, { "hz": 330 }, { "hz": 395 }"#);
    assert_eq!(code, Some(1), "{found}");
    let said = found["words"].to_string();
    assert!(said.contains("no bending mode") || said.contains("do not fit"), "{said}");
}

/// The label of 1187 Hz belongs to the third mode: a wrong label as the second is not changed silently.
#[test]
fn a_wrong_label_is_named_with_the_one_that_fits() {
    let folder = Folder::new("calibrate_label");
    let lines = r#"{ "format": "sweetspot-readings/1", "mass": "0.869 kg ± 1 g", "lines": [
        { "hz": 174.5, "mode": 1 }, { "hz": 1187.0, "mode": 2 }, { "hz": 1854.8 } ] }"#;
    folder.write("wrong.json", lines);
    let output = folder.run(&["calibrate", "r161", "wrong.json"]);
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert_eq!(output.status.code(), Some(1), "{said}");
    let plain = said.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(plain.contains("1187 Hz was told as mode 2 and fits as mode 3"), "{said}");
    assert!(plain.contains("sweetspot calibrate r161 wrong.json --mode \"1187 = 3\""), "{said}");
    let args = ["calibrate", "r161", "wrong.json", "--mode", "1187 = 3", "--json", "-"];
    let found = folder.json(&args);
    near(found["parameters"][0]["value"].as_f64().unwrap() / 1e9, 18.14, 0.1);
    let output = folder.run(&["calibrate", "r161", "wrong.json", "--mode", "500 = 3"]);
    assert_eq!(output.status.code(), Some(2));
}

/// One tone of a short thick bar of rosewood (957 Hz): G is unknown and E depends on it, with a larger uncertainty
/// upwards than downwards.
#[test]
fn what_no_tone_tells_widens_what_is_told() {
    let text = r#"{ "format": "sweetspot-bat/1", "material": { "density": 1082, "youngs_modulus": "20 GPa" },
        "profile": { "unit": "in", "interpolation": "linear", "x": [0, 13.234375],
            "diameter": [1.0161363737, 1.0161363737] } }"#;
    let bat = Bat::from_text("bar.json", text, "".as_ref()).unwrap();
    let mass = Some(reading(0.1903, 0.6e-3));
    let readings = BatReadings { mass, lines: lines(&[(957.0, 1.0, 1)]), ..BatReadings::default() };
    let found = Calibration::new(&bat, readings, &CalibrationPlan::default()).unwrap();
    let one = &found.parameters[0];
    let [low, high] = one.interval95.map(|end| end / 25.91e9 - 1.0);
    // By a fit of E at every G/E of a lognormal prior of 35 %, alone: -2.9 and +5.8 %.
    assert!((low + 0.029).abs() < 0.006 && (high - 0.058).abs() < 0.01, "{low} {high}");
    let held = CalibrationPlan { split: None, held: vec![Property::ShearModulus] };
    let found = Calibration::new(&bat, found.readings, &held).unwrap();
    let [low, high] = found.parameters[0].interval95.map(|end| end / found.parameters[0].value);
    assert!(high / low < 1.03, "{low} {high}");
}

#[test]
fn a_density_that_is_no_aluminium_is_told() {
    let folder = Folder::new("calibrate_foreign");
    let text = include_str!("../meshes/northwestern_aluminium.json");
    let mut bat: serde_json::Value = serde_json::from_str(text).unwrap();
    bat["material"] = serde_json::json!("aluminium-7075");
    bat.as_object_mut().unwrap().remove("weighed");
    folder.write("bat.json", bat.to_string());
    folder.write(
        "readings.json",
        r#"{ "format": "sweetspot-readings/1", "mass": "0.913 kg",
            "lines": [ { "hz": 149.2 }, { "hz": 511.3 }, { "hz": 1000.8 }, { "hz": 1603.4 } ] }"#,
    );
    let output = folder.run(&["calibrate", "bat.json", "readings.json", "--json", "-"]);
    let found: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    near(found["parameters"][0]["value"].as_f64().unwrap() / 1e9, 50.0, 0.2);
    let words = found["words"].to_string();
    assert!(words.contains("1.71 times that of aluminium-7075"), "{words}");
}

/// Readings that fit to the round-off of χ², where no step is downhill any more, agree with the bat.
#[test]
fn readings_that_fit_perfectly_agree() {
    let folder = Folder::new("calibrate_exact");
    folder.write(
        "readings.json",
        r#"{ "format": "sweetspot-readings/1", "mass": "0.8816 kg",
            "lines": [ { "hz": 151.86, "mode": 1 }, { "hz": 524.61, "mode": 2 } ] }"#,
    );
    let found = folder.json(&["calibrate", "corked", "readings.json", "--json", "-"]);
    assert_eq!(found["fits"], true, "{found}");
}

/// The sum of squares in the words is the one in the document; loss factors of one mode that no counting of cycles
/// explains are a mismatch.
#[test]
fn loss_factors_that_contradict_each_other_are_a_mismatch() {
    let folder = Folder::new("calibrate-loss");
    for (other, fits) in [(0.015, true), (0.1, false)] {
        let readings = format!(
            r#"{{ "format": "sweetspot-readings/1", "mass": "0.869 kg",
                "lines": [{{ "hz": 174.5, "mode": 1, "loss_factor": 0.01 }}, {{ "hz": 581, "mode": 2 }}],
                "ring_down": [{{ "mode": 1, "loss_factor": {other} }}] }}"#
        );
        folder.write("readings.json", readings);
        let output = folder.run(&["calibrate", "r161", "readings.json", "--json", "o.json"]);
        let (told, code) = (String::from_utf8(output.stdout).unwrap(), output.status.code());
        assert_eq!(code, Some(i32::from(!fits)), "{told}");
        assert_eq!(
            told.contains("loss factors of mode 1, 0.01 to 0.1, contradict"),
            !fits,
            "{told}"
        );
        let document: serde_json::Value = serde_json::from_str(&folder.read("o.json")).unwrap();
        let chi2 = document["chi2"].as_f64().unwrap();
        let shown = sweetspot::base::number::significant(chi2, 3);
        assert!(told.contains(&format!("chi2 {shown} of 3 data")), "{shown}: {told}");
    }
}

/// A property that is held is exact: its interval is its value, and nothing varies with it.
#[test]
fn a_held_property_has_no_interval() {
    let folder = Folder::new("held");
    folder.write(
        "readings.json",
        r#"{ "format": "sweetspot-readings/1", "lines": [{ "hz": 174.5 }] }"#,
    );
    let found = folder.json(&["calibrate", "r161", "readings.json", "--hold", "E", "--json", "-"]);
    let modulus = &found["parameters"][0];
    assert_eq!(modulus["verdict"], "held");
    let value = modulus["value"].as_f64().unwrap();
    for end in modulus["interval95"].as_array().unwrap() {
        assert!((end.as_f64().unwrap() / value - 1.0).abs() < 1e-12, "{modulus}");
    }
    let rows = found["covariance"].as_array().unwrap();
    assert!(rows.iter().all(|row| row[0] == 0.0) && rows[1][1].as_f64().unwrap() > 0.0, "{rows:?}");
}
