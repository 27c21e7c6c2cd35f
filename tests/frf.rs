//! A frequency response with its peaks, alone and compared with a measured one.

use crate::common;

use std::f64::consts::TAU;
use std::fmt::Write;

use common::diagnostic::in_lines;
use common::folder::Folder;
use faer::c64;
use serde_json::Value;
use sweetspot::motion::frf::{Frf, ResponseKind, Sample};
use sweetspot::{Bat, Request};
use sweetspot_study::files::measured::{response, universal};
use uff58::{Dataset, parse, parse_in};

/// A dowel with a loss factor of 2 %, so that every mode has a damping ratio of 1 %.
const LOSSY: &str = r#"{ "format": "sweetspot-bat/1", "profile": { "x": [0, 0.8], "radius": [0.02, 0.02] },
    "material": { "density": 700, "youngs_modulus": 14e9, "shear_modulus": 1e9, "loss_factor": 0.02 } }"#;

fn list(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

#[test]
fn the_grid_has_every_natural_frequency_and_the_peaks_their_damping() {
    let folder = Folder::new("frf-peaks");
    folder.write("bat.json", LOSSY);
    let ask = ["frf", "bat.json", "--at", "0.8", "--points", "3", "-n", "4", "--json", "-"];
    let json = folder.json(&ask);
    let modes = folder.json(&["modes", "bat.json", "-n", "4", "--tol", "1e-8", "--json", "-"]);
    let grid = list(&json["frequency_hz"]);
    assert!(grid.windows(2).all(|pair| pair[0] < pair[1]));
    let [real, imaginary] = ["real_m_per_n", "imaginary_m_per_n"].map(|part| list(&json[part]));
    let peaks = json["peaks"].as_array().unwrap();
    assert_eq!(peaks.len(), 4);
    for (peak, mode) in peaks.iter().zip(modes["modes"].as_array().unwrap()) {
        let natural = mode["frequency_hz"].as_f64().unwrap();
        assert!(grid.iter().any(|f| (f / natural - 1.0).abs() < 1e-6), "{natural}");
        // Half of the loss factor, except for contributions of the other modes.
        let ratio = peak["damping_ratio"].as_f64().unwrap();
        assert!((ratio / 0.01 - 1.0).abs() < 0.02, "{peak}");
        // No sample near it is higher, and the highest is within 1 %.
        let height = peak["magnitude_m_per_n"].as_f64().unwrap();
        let near = (0..grid.len()).filter(|k| (grid[*k] / natural - 1.0).abs() < 0.05);
        let largest = near.map(|k| real[k].hypot(imaginary[k])).fold(0.0, f64::max);
        assert!(largest <= height * (1.0 + 1e-9) && largest > 0.99 * height, "{peak}");
        // A single mode at its resonance: φ²/(m ω² η).
        let mass = mode["modal_mass_kg"].as_f64().unwrap();
        let shape = list(&mode["shape"]["deflection"]);
        let tip = shape[shape.len() - 1];
        let alone = tip * tip / (mass * (TAU * natural).powi(2) * 0.02);
        assert!((height / alone - 1.0).abs() < 0.05, "{peak}: {alone}");
    }
    // Without damping the peaks are unbounded, and no infinity is written.
    let json = folder.json(&["frf", "dowel", "--at", "0.6", "-n", "2", "--json", "-"]);
    for peak in json["peaks"].as_array().unwrap() {
        assert!(peak["magnitude_m_per_n"].is_null() && peak["damping_ratio"].is_null());
    }
    assert!(list(&json["real_m_per_n"]).iter().all(|v| v.is_finite()));
    let text = folder.text(&["frf", "dowel", "--at", "0.6", "-n", "2"]);
    assert!(text.contains("no bound"), "{text}");
}

#[test]
fn a_response_written_here_and_read_back_lies_on_itself() {
    let folder = Folder::new("frf-back");
    folder.write("bat.json", LOSSY);
    for kind in ["receptance", "mobility", "accelerance"] {
        let write = ["frf", "bat.json", "--at", "0.7", "--to", "0.1", "--to-hz", "1500", "--kind"];
        let tap = format!("{kind}.uff");
        folder.text(&[&write[..], &[kind, "--uff", &tap]].concat());
        let plots = format!("{kind}-plots");
        let ask = ["frf", "bat.json", "--measured", &tap, "--json", "-", "--plots", &plots];
        let json = folder.json(&ask);
        assert_eq!((json["at_m"].as_f64(), json["to_m"].as_f64()), (Some(0.7), Some(0.1)));
        assert_eq!(json["kind"], kind);
        let measured = &json["measured"];
        assert!((measured["frac"].as_f64().unwrap() - 1.0).abs() < 1e-9, "{measured}");
        for mean in ["mean_level_difference_db", "mean_absolute_level_difference_db"] {
            assert!(measured[mean].as_f64().unwrap().abs() < 1e-6, "{measured}");
        }
        let peaks = measured["peaks"].as_array().unwrap();
        assert!(peaks.len() >= 2);
        for pair in peaks {
            // The points of the file are an eighth of the half-width or closer.
            let apart = pair["frequency_difference"].as_f64().unwrap();
            assert!(apart.abs() < 0.01 / 8.0, "{pair}");
            assert!(pair["level_difference_db"].as_f64().unwrap().abs() < 0.1, "{pair}");
            let [a, b] = ["computed", "measured"].map(|one| pair[one]["damping_ratio"].as_f64());
            assert!((a.unwrap() / b.unwrap() - 1.0).abs() < 0.05, "{pair}");
        }
        assert!(folder.read_names(&plots).contains(&"response.svg".to_owned()));
    }
    // The same response in another kind.
    let other = ["frf", "bat.json", "--measured", "mobility.uff", "--kind", "receptance"];
    let text = folder.text(&other);
    assert!(text.contains("FRAC 1.000") && text.contains("and 0.0 dB from it"), "{text}");
}

/// Dataset 58 by its description: records 1 to 5 of text, 6 FORMAT(2(I5,I10),2(1X,10A1,I10,I4)), 7
/// FORMAT(3I10,3E13.5), 8 to 11 FORMAT(I10,3I5,2(1X,20A1)), 12 complex, even, FORMAT(6E13.5).
fn dataset_58(answer: (i64, &str), per: i64, [to, at]: [(i64, i64); 2], values: &[c64]) -> String {
    let mut text = "    -1\n    58\n".to_owned() + &"NONE\n".repeat(5);
    let dof = |(node, direction): (i64, i64)| format!(" NONE      {node:>10}{direction:>4}");
    let _ = writeln!(text, "    4         1    1         0{}{}", dof(to), dof(at));
    let count = values.len();
    let _ = writeln!(text, "{:>10}{count:>10}{:>10}  1.00000E+02  1.00000E+01  0.00000E+00", 5, 1);
    for (kind, label, unit) in [
        (18, "Frequency", "Hz"),
        (answer.0, "Answer", answer.1),
        (per, "Force", "N"),
        (0, "NONE", "NONE"),
    ] {
        let _ = writeln!(text, "{kind:>10}    0    0    0 {label:<20} {unit:<20}");
    }
    for row in values.chunks(3) {
        let cells: Vec<String> =
            row.iter().map(|v| format!("{:>13}{:>13}", fortran(v.re), fortran(v.im))).collect();
        text += &(cells.concat() + "\n");
    }
    text + "    -1\n"
}

fn fortran(value: f64) -> String {
    uff58::number::scientific(value, 5, 'E')
}

/// Dataset 2411: label, systems and colour, FORMAT(4I10), then 1P3D25.16.
fn dataset_2411(nodes: &[(i64, [f64; 3])]) -> String {
    let mut text = "    -1\n  2411\n".to_owned();
    for (label, at) in nodes {
        let _ = writeln!(text, "{label:>10}{:>10}{:>10}{:>10}", 0, 0, 0);
        let cells = at.map(|x| format!("{:>25}", uff58::number::scientific(x, 16, 'D')));
        text += &(cells.concat() + "\n");
    }
    text + "    -1\n"
}

fn five() -> Vec<c64> {
    (1..=5).map(|k| c64::new(1000.0 * f64::from(k), -20.0)).collect()
}

#[test]
fn a_file_made_by_the_specification_is_read_with_its_units_places_and_directions() {
    let folder = Folder::new("frf-spec");
    let path = folder.0.join("tap.uff");
    let nodes = dataset_2411(&[(11, [0.0, 0.0, 100.0]), (12, [0.0, 0.0, 700.0])]);
    let read = |text: &str, unit: Option<&str>| {
        std::fs::write(&path, text).unwrap();
        let units = unit.map(|unit| {
            let metre = if unit == "mm" { 1e-3 } else { 0.0254 };
            uff58::Units::of_length(metre, unit)
        });
        let known = response::Known { unit: units, ..Default::default() };
        response::read(&path, &known).unwrap().remove(0).1
    };
    // Accelerations in mm/s² per N, the answer against y.
    let text = nodes.clone() + &dataset_58((12, "mm/s^2"), 13, [(12, -2), (11, 2)], &five());
    let found = read(&text, Some("mm"));
    assert_eq!((found.kind, found.at, found.to), (ResponseKind::Accelerance, Some(0.1), Some(0.7)));
    assert_eq!(found.values.len(), 5);
    let (f, first) = found.values[0];
    assert!(f == 100.0 && (first - c64::new(-1.0, 0.02)).norm() < 1e-12, "{first}");
    assert_eq!(found.values[4].0, 140.0);
    // Inches go with the pound-force: 1 in/s per lbf is 0.0254/4.448… m/s per N.
    let text = dataset_58((11, "in/s"), 13, [(12, 2), (11, 2)], &five());
    let found = read(
        &text.replace(&format!("{:<20} N", "Force"), &format!("{:<20} lbf", "Force")),
        Some("in"),
    );
    assert_eq!((found.kind, found.at), (ResponseKind::Mobility, None));
    let factor = 0.0254 / 4.448_221_615_260_5;
    assert!((found.values[0].1.re / (1000.0 * factor) - 1.0).abs() < 1e-12);
    // An axis labelled g is in g where the file has no units.
    let found = read(&dataset_58((12, "g"), 13, [(12, 3), (11, 3)], &five()), None);
    assert!((found.values[0].1.re / 9806.65 - 1.0).abs() < 1e-12);
    assert!(found.assumed.iter().any(|said| said.contains("taken in g")), "{:?}", found.assumed);
    // A file with units does not accept others.
    let own = "    -1\n   164\n         5mm                            2\n  1.00000000000000000D+03  \
               1.00000000000000000D+00  1.00000000000000000D+00\n  2.73149999999999980D+02\n    -1\n";
    let text = own.to_owned() + &dataset_58((8, "mm"), 13, [(1, 2), (1, 2)], &five());
    assert_eq!(read(&text, None).values[1].1, c64::new(2.0, -0.02));
    let metre = uff58::Units::of_length(1e-3, "mm");
    let error = parse_in("tap.uff", text.as_bytes(), Some(&metre)).unwrap_err().to_string();
    assert!(error.starts_with("tap.uff:2:") && error.contains("dataset 164"), "{error}");
}

#[test]
fn what_is_no_response_of_a_bat_is_refused_with_its_line() {
    let folder = Folder::new("frf-wrong");
    folder.write("bat.json", LOSSY);
    let along = [(2, 2), (1, 2)];
    let cases: [(String, &[&str], &[&str]); 11] = [
        (
            dataset_58((12, "m/s2"), 13, [(2, 2), (1, 3)], &five()),
            &["--at", "0.7"],
            &["tap.uff:8:", "node 1 z", "along one direction"],
        ),
        (dataset_58((5, "K"), 13, along, &five()), &["--at", "0.7"], &["tap.uff:11:", "kind 5"]),
        (
            dataset_58((12, "m/s2"), 8, along, &five()),
            &["--at", "0.7"],
            &["tap.uff:12:", "13 (exc"],
        ),
        (dataset_58((12, "m/s2"), 13, along, &five()), &[], &["no place of the force", "2411"]),
        (
            dataset_58((12, "mV"), 13, along, &five()),
            &["--at", "0.7"],
            &["tap.uff:11:", "the unit \"mV\"", "g/lbf", "--unit"],
        ),
        (
            dataset_58((12, "mV"), 13, along, &five()),
            &["--at", "0.7", "--unit", "volts"],
            &["--unit: found volts", "g/lbf"],
        ),
        (
            dataset_58((12, "m/s2"), 13, along, &five()).repeat(2),
            &["--at", "0.7"],
            &["--at: found it beside 2 responses", "one of them: --function N"],
        ),
        (
            dataset_58((12, "m/s2"), 13, along, &five()),
            &["--at", "0.7", "--function", "3"],
            &["--function: found 3", "1 to 1"],
        ),
        (
            dataset_58((12, "m/s2"), 13, along, &[c64::new(0.0, 0.0); 5]),
            &["--at", "0.7"],
            &["tap.uff:9:", "nothing but 0"],
        ),
        (
            dataset_58((12, "m/s2"), 13, along, &five()).replace(" Hz ", " orders "),
            &["--at", "0.7"],
            &["tap.uff:10:", "frequencies in \"orders\"", "rad/s"],
        ),
        ("    -1\n   164\n".to_owned(), &["--at", "0.7"], &["tap.uff:3:"]),
    ];
    for (text, more, told) in cases {
        folder.write("tap.uff", &text);
        let args = [&["frf", "bat.json", "--measured", "tap.uff"], more].concat();
        let output = folder.run(&args);
        let error = in_lines(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{error}");
        told.iter().for_each(|words| assert!(error.contains(words), "{words}: {error}"));
    }
    // One of two is selected by its number.
    let two = dataset_58((12, "m/s2"), 13, along, &five()).repeat(2);
    folder.write("tap.uff", two);
    folder.text(&[
        "frf",
        "bat.json",
        "--measured",
        "tap.uff",
        "--function",
        "2",
        "--at",
        "0.7",
        "--to",
        "0.1",
    ]);
}

/// The answers of a lossy bat at two places to a force at a third, as accelerations in g per pound-force in
/// files that name their units on their axes, by option, or not at all.
#[test]
fn a_set_of_responses_is_read_at_once_in_the_units_of_the_trade() {
    const FREQUENCIES: usize = 1500;
    let folder = Folder::new("frf-set");
    folder.write("bat.json", LOSSY);
    folder.write("undamped.json", LOSSY.replace("0.02 } }", "0 } }"));
    assert_ne!(folder.read("undamped.json"), LOSSY);
    let bat = Bat::from_file(folder.0.join("bat.json")).unwrap();
    let request = Request { modes: 8, ..Request::default() };
    let hertz: Vec<f64> = (0..FREQUENCIES).map(|k| 100.0 + k as f64).collect();
    let places = [0.7, 0.1, 0.3];
    let set = |unit: &str| -> String {
        let one = |(to, at): (usize, usize)| {
            let mut frf = Frf::new(&bat, &request, places[at], places[to]).unwrap();
            let of = |s: &Sample| {
                s.receptance * ResponseKind::Accelerance.of(s.frequency) * 4.448_221_615_260_5
                    / 9.806_65
            };
            let values: Vec<c64> = frf.receptances(&hertz).unwrap().iter().map(of).collect();
            let [to, at] = [to, at].map(|k| (k as i64 + 1, 2));
            let text = dataset_58((12, unit), 13, [to, at], &values);
            let text = text.replace("  1.00000E+02  1.00000E+01", "  1.00000E+02  1.00000E+00");
            text.replace(&format!("{:<20} N ", "Force"), &format!("{:<20} lb", "Force"))
        };
        [(1, 0), (0, 0), (2, 1)].map(one).concat()
    };
    let nodes = dataset_2411(&[(1, [0.7, 0.0, 0.0]), (2, [0.1, 0.0, 0.0]), (3, [0.3, 0.0, 0.0])]);
    folder.write("named.uff", nodes.clone() + &set("G's"));
    folder.write("bare.uff", set("G's"));
    folder.write("unknown.uff", nodes + &set("mV"));
    let ask = |bat: &str, file: &str, more: &[&str]| {
        let args = [&["frf", bat, "--measured", file, "--csv", "-"], more].concat();
        let text = folder.text(&args);
        let rows: Vec<Vec<f64>> = text
            .lines()
            .skip(1)
            .map(|row| row.split(',').map(|cell| cell.parse().unwrap()).collect())
            .collect();
        assert_eq!(rows.len(), 3, "{text}");
        rows
    };
    for (file, more) in [
        ("named.uff", &[][..]),
        ("bare.uff", &["--places", "1=0.7,2=0.1,3=0.3"]),
        ("unknown.uff", &["--unit", "g/lbf"]),
    ] {
        for (row, (number, at, to)) in ask("bat.json", file, more).iter().zip([
            (1.0, 0.7, 0.1),
            (2.0, 0.7, 0.7),
            (3.0, 0.1, 0.3),
        ]) {
            assert_eq!(row[..3], [number, at, to], "{file}");
            assert!((row[3] - 1.0).abs() < 1e-8 && row[5] < 1e-3, "{file}: {row:?}");
        }
    }
    // Without damping the criterion is meaningless; with the damping of the measured peaks it is not.
    for (bare, damped) in ask("undamped.json", "named.uff", &[]).iter().zip(ask(
        "undamped.json",
        "named.uff",
        &["--damping", "measured"],
    )) {
        assert!(bare[3] < 0.5 && damped[3] > 0.99, "{bare:?} {damped:?}");
    }
    let said = folder.text(&["frf", "undamped.json", "--measured", "named.uff"]);
    assert!(said.contains("no damping") && said.contains("--damping measured"), "{said}");
    let set =
        folder.json(&["frf", "bat.json", "--measured", "named.uff", "--json", "-", "--plots", "p"]);
    assert_eq!(set["functions"], serde_json::json!([1, 2, 3]));
    assert_eq!(set["responses"][2]["to_m"], 0.3);
    assert!(folder.read_names("p").contains(&"response_3.svg".to_owned()));
}

/// The bending has a kink at a force: two places inside one element respond almost equally with any number of modes,
/// with damped hands and without. The last value is by an independent program.
#[test]
fn places_close_to_each_other_answer_alike_with_any_number_of_modes() {
    let tube = r#"{ "format": "sweetspot-bat/1", "material": { "density": 700, "youngs_modulus": 15e9,
        "shear_modulus": 1e9 }, "profile": { "interpolation": "constant", "x": [0, 0.84],
        "radius": [0.02799977022069449, 0.02799977022069449] },
        "absorbers": [{ "x": 0, "mass": 0.001, "frequency": 170, "damping": 0.5 }] }"#;
    let tube = Bat::from_text("tube", tube, "".as_ref()).unwrap();
    let held = LOSSY.replace(
        "\"profile\"",
        r#""grip": { "from": 0, "to": 0.2, "stiffness": 1e5, "damping": 900 }, "profile""#,
    );
    let held = Bat::from_text("held", &held, "".as_ref()).unwrap();
    let lossy = Bat::from_text("lossy", LOSSY, "".as_ref()).unwrap();
    let theory = sweetspot::Theory::Timoshenko;
    for (bat, at, to, hertz, known) in [
        (&lossy, 0.31, 0.3101, 1300.0, None),
        (&held, 0.31, 0.3101, 1300.0, None),
        (&held, 0.05, 0.057, 90.0, None),
        (&tube, 0.578, 0.585, 544.511_623_568_944_1, Some(1.242_546_182_013_181_8e-8)),
    ] {
        let answer = |modes: usize| {
            let request = Request { modes, theory, ..Request::default() };
            let mut frf = Frf::new(bat, &request, at, to).unwrap();
            frf.receptances(&[hertz]).unwrap()[0].receptance
        };
        let many = answer(20);
        for modes in [4, 5, 8] {
            let off = (answer(modes) - many).norm() / many.norm();
            assert!(off < 1e-7, "{at} {modes}: {off:e}");
        }
        assert!(known.is_none_or(|known| (many.norm() / known - 1.0).abs() < 1e-9), "{many}");
    }
}

/// Frequencies are in the unit by which their axis is named.
#[test]
fn frequencies_are_in_the_unit_of_their_axis() {
    let folder = Folder::new("frf-axis");
    let path = folder.0.join("tap.uff");
    let plain = dataset_58((12, "m/s^2"), 13, [(1, 2), (1, 2)], &five());
    for (unit, hertz) in [("Hz", 1.0), ("rad/s", 1.0 / TAU), ("kHz", 1e3), ("RPM", 1.0 / 60.0)] {
        std::fs::write(&path, plain.replace("Hz   ", &format!("{unit:<5}"))).unwrap();
        let found = response::read(&path, &Default::default()).unwrap().remove(0).1;
        assert!((found.values[0].0 / (100.0 * hertz) - 1.0).abs() < 1e-12, "{unit}");
        let said = found.assumed.iter().any(|words| words.contains("frequencies are taken in"));
        assert_eq!(said, unit != "Hz", "{unit}: {:?}", found.assumed);
    }
}

/// Axes in g with a dataset 164 in metres contradict each other, and the message says which is used.
#[test]
fn axes_that_contradict_the_files_units_are_told() {
    let folder = Folder::new("frf-164");
    let path = folder.0.join("tap.uff");
    let units = "    -1\n   164\n         1SI                             2\n  1.00000000000000000D+00  \
                 1.00000000000000000D+00  1.00000000000000000D+00\n  0.00000000000000000D+00\n    -1\n";
    let along = [(1, 2), (1, 2)];
    for (unit, told) in [("m/s^2", false), ("g", true), ("in/s^2", true)] {
        let text = units.to_owned() + &dataset_58((12, unit), 13, along, &five());
        std::fs::write(&path, text).unwrap();
        let found = response::read(&path, &Default::default()).unwrap().remove(0).1;
        assert_eq!(found.values[0].1, c64::new(1000.0, -20.0), "{unit}");
        let said = found.assumed.iter().any(|words| words.contains("contradicts"));
        assert_eq!(said, told, "{unit}: {:?}", found.assumed);
    }
}

/// Files with complex modes in Hz, or normal ones in rad/s: recognised from the shapes, or set by the option.
#[test]
fn frequencies_in_another_unit_than_the_formats_are_known_by_the_shapes() {
    let folder = Folder::new("frf-hertz");
    let known = folder.json(&["modes", "r161", "-n", "4", "--shape-points", "12", "--json", "-"]);
    let hertz: Vec<f64> = known["modes"]
        .as_array()
        .unwrap()
        .iter()
        .map(|mode| mode["frequency_hz"].as_f64().unwrap())
        .collect();
    let shapes: Vec<Vec<f64>> = known["modes"]
        .as_array()
        .unwrap()
        .iter()
        .map(|mode| list(&mode["shape"]["deflection"]))
        .collect();
    let places = list(&known["modes"][0]["shape"]["x_m"]);
    let nodes: Vec<(i64, [f64; 3])> =
        (1..).zip(&places).map(|(k, x)| (k, [*x, 0.0, 0.0])).collect();
    let figures = |values: &[f64]| {
        values.iter().map(|v| format!("{:>13}", fortran(*v))).collect::<String>() + "\n"
    };
    let ints =
        |values: &[i64]| values.iter().map(|v| format!("{v:>10}")).collect::<String>() + "\n";
    let file = |name: &str, complex: bool, factor: f64, mass: f64| {
        let mut text = dataset_2411(&nodes);
        for (k, (hz, shape)) in hertz.iter().zip(&shapes).enumerate() {
            let (mode, w) = (k as i64 + 1, factor * hz);
            text += "    -1\n    55\n";
            text += &"NONE\n".repeat(5);
            if complex {
                text += &ints(&[1, 3, 2, 8, 5, 3]);
                text += &ints(&[2, 6, 1, mode]);
                // A pole, Modal A and B = -λA.
                let pole = [-0.006 * w, w];
                text += &figures(&[pole[0], pole[1], mass, 0.0, -mass * pole[0], -mass * pole[1]]);
            } else {
                text += &ints(&[1, 2, 2, 8, 2, 3]);
                text += &ints(&[2, 4, 1, mode]);
                text += &figures(&[w, 1.0, 0.006, 0.0]);
            }
            for (label, value) in (1..).zip(shape) {
                let row = [0.0, 0.0, *value, 0.0, 0.0, 0.0];
                let row3 = [0.0, *value, 0.0];
                text += &ints(&[label]);
                text += &figures(if complex { &row[..] } else { &row3[..] });
            }
            text += "    -1\n";
        }
        folder.write(name, text);
    };
    let tau = std::f64::consts::TAU;
    file("by_format.uff", true, tau, 0.0);
    file("in_hertz.uff", true, 1.0, 0.0);
    file("normal.uff", false, 1.0, 0.0);
    file("normal_rad.uff", false, tau, 0.0);
    for (name, other, unit) in [
        ("by_format.uff", None, "rad/s"),
        ("in_hertz.uff", Some("taken as in Hz"), "Hz"),
        ("normal.uff", None, "Hz"),
        ("normal_rad.uff", Some("taken as in rad/s"), "rad/s"),
    ] {
        for told in [&[][..], &["--frequency-unit", unit]] {
            let ask = ["compare", "r161", "--measured", name, "--json", "-"];
            let found = folder.json(&[&ask[..], told].concat());
            let pairs = found["pairs"].as_array().unwrap();
            assert_eq!(pairs.len(), 4, "{name} {told:?}: {found}");
            for pair in pairs {
                let apart = pair["frequency_difference"].as_f64().unwrap();
                assert!(apart.abs() < 1e-4, "{name}: {pair}");
            }
            let said = found["assumed"].to_string();
            let here = other.filter(|_| told.is_empty());
            assert_eq!(said.contains("so the shapes have"), here.is_some(), "{name}: {said}");
            assert!(here.is_none_or(|words| said.contains(words)), "{name}: {said}");
        }
        let found = folder.json(&["calibrate", "r161", name, "--quiet", "--json", "-"]);
        assert_eq!(found["labels"]["taken"], serde_json::json!([1, 2, 3, 4]), "{name}");
    }
    // Modal masses that indicate rad/s together with shapes that indicate Hz.
    file("torn.uff", true, 1.0, 1.0);
    let output = folder.run(&["compare", "r161", "--measured", "torn.uff"]);
    let error = in_lines(&output.stderr);
    assert!(output.status.code() == Some(2) && error.contains("--frequency-unit"), "{error}");
    folder.text(&["compare", "r161", "--measured", "torn.uff", "--frequency-unit", "Hz"]);
}

/// Dataset 2414 by its description, records 1 to 15, and dataset 55 of the same mode.
#[test]
fn the_newer_form_of_shapes_is_read_as_the_older_one() {
    let figures = |values: &[f64]| {
        values.iter().map(|v| format!("{:>13}", fortran(*v))).collect::<String>() + "\n"
    };
    let ids = "NONE\n".repeat(5);
    let shape = |k: i64| figures(&[0.0, f64::from(k as i32) - 2.5, 0.0]);
    let nodes: String = (1..=4).map(|k| format!("{k:>10}\n{}", shape(k))).collect();
    let newer = format!(
        "    -1\n  2414\n         1\nMode 3\n         1\n{ids}{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}\n\
         {:>10}{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}\n{:>10}{:>10}\n{}{}{nodes}    -1\n",
        1,
        2,
        2,
        8,
        2,
        3,
        0,
        0,
        1,
        0,
        1,
        3,
        0,
        0,
        0,
        0,
        figures(&[0.0, 581.2, 0.0, 0.25, 0.004, 0.0]),
        figures(&[0.0; 6]),
    );
    let older = format!(
        "    -1\n    55\n{ids}{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}\n{:>10}{:>10}{:>10}{:>10}\n{}{nodes}    -1\n",
        1,
        2,
        2,
        8,
        2,
        3,
        2,
        4,
        1,
        3,
        figures(&[581.2, 0.25, 0.004, 0.0]),
    );
    let [newer, older] = [newer, older].map(|text| {
        let places: Vec<(i64, [f64; 3])> =
            (1..=4).map(|k| (k, [0.2 * f64::from(k as i32), 0.0, 0.0])).collect();
        parse("m.uff", (dataset_2411(&places) + &text).as_bytes()).unwrap()
    });
    assert!(matches!(&newer.datasets[1], Dataset::NodalData(_)), "{newer:?}");
    assert_eq!(newer.datasets, older.datasets);
    assert_eq!(newer.lines, [2, 13]);
    let modes = universal::of(&newer, "m.uff").unwrap().modes;
    assert_eq!((modes.len(), modes[0].frequency), (1, 581.2));
    assert_eq!(modes[0].damping_ratio, Some(0.004));
    // Data on elements are not shapes, and are ignored.
    let text = "    -1\n  2414\n         1\nNONE\n         2\nNONE\n    -1\n";
    let skipped = parse("m.uff", text.as_bytes()).unwrap().skipped;
    assert_eq!(skipped.iter().map(|s| (s.number, s.line)).collect::<Vec<_>>(), [(2414, 2)]);
    // A missing record is reported with its line.
    let text = "    -1\n  2414\n         1\nNONE\n         1\n    -1\n";
    let error = parse("m.uff", text.as_bytes()).unwrap_err().to_string();
    assert!(error.starts_with("m.uff:6:"), "{error}");
}

/// A file with shapes alone, with places typed or in a table, equals the file with those nodes; one without units, with
/// given units, equals the one in metres.
#[test]
fn shapes_without_geometry_or_units_are_placed_by_what_is_told() {
    let folder = Folder::new("frf-places");
    folder.text(&["modes", "dowel", "-n", "3", "--shape-points", "7", "--json", "m.json"]);
    folder.text(&["convert", "m.json", "--to", "uff", "--out", "m.uff"]);
    let whole = folder.read("m.uff");
    let parts: Vec<&str> = whole.split("    -1\n").filter(|part| !part.is_empty()).collect();
    let only = |numbers: &[&str]| -> String {
        let kept =
            parts.iter().filter(|part| numbers.contains(&part.lines().next().unwrap().trim()));
        kept.map(|part| format!("    -1\n{part}    -1\n")).collect()
    };
    folder.write("bare.uff", only(&["55"]));
    let nodes: Vec<f64> =
        match parse("m.uff", whole.as_bytes()).unwrap().datasets.iter().find_map(|dataset| {
            match dataset {
                Dataset::Nodes(nodes) => Some(nodes.nodes.iter().map(|node| node.at[0]).collect()),
                _ => None,
            }
        }) {
            Some(nodes) => nodes,
            None => panic!("no nodes"),
        };
    let typed: Vec<String> = (1..).zip(&nodes).map(|(k, x)| format!("{k}={x} m")).collect();
    let rows: String = (1..).zip(&nodes).map(|(k, x)| format!("{k},{}\n", x * 1e3)).collect();
    folder.write("places.csv", format!("node,x_mm\n{rows}"));
    let beside = |file: &str, more: &[&str]| {
        let ask = ["compare", "dowel", "--measured", file, "--json", "-"];
        let mut json = folder.json(&[&ask[..], more].concat());
        (json["pairs"].take(), json["shapes"]["mac"].take())
    };
    let plain = beside("m.uff", &[]);
    let near = |(pairs, mac): (Value, Value)| {
        assert_eq!(pairs.as_array().unwrap().len(), plain.0.as_array().unwrap().len());
        for (a, b) in mac.as_array().unwrap().iter().zip(plain.1.as_array().unwrap()) {
            for (a, b) in list(a).iter().zip(list(b)) {
                assert!((a - b).abs() < 1e-5, "{a} {b}");
            }
        }
    };
    near(beside("bare.uff", &["--places", &typed.join(", ")]));
    near(beside("bare.uff", &["--places", "places.csv"]));
    // The same nodes in millimetres, which only the option says.
    let mut text = String::from("    -1\n    15\n");
    for (k, x) in (1..).zip(&nodes) {
        let at = [fortran(x * 1e3), fortran(0.0), fortran(0.0)];
        let _ = writeln!(
            text,
            "{k:>10}{:>10}{:>10}{:>10}{:>13}{:>13}{:>13}",
            0, 0, 0, at[0], at[1], at[2]
        );
    }
    folder.write("mm.uff", text + "    -1\n" + &only(&["55"]));
    near(beside("mm.uff", &["--unit", "mm"]));
    for (more, told) in [
        (&["--places", "1=0 in"][..], "not among the places"),
        (&["--places", "1=0 kg"], "node 1"),
        (&["--unit", "kg"], "kg"),
    ] {
        let ask = ["compare", "dowel", "--measured", "bare.uff"];
        let output = folder.run(&[&ask[..], more].concat());
        let error = in_lines(&output.stderr);
        assert!(output.status.code() == Some(2) && error.contains(told), "{error}");
    }
}

/// Where a pin or a clamp keeps the bat at rest, the response is 0 and not its round-off.
#[test]
fn the_response_at_a_support_is_zero() {
    for (support, at, to) in [("pinned", 0.2, 0.2), ("pinned", 0.2, 0.6), ("clamped", 0.1, 0.6)] {
        let supports = format!(r#"{{ "supports": [{{ "x": 0.2, "type": "{support}" }}], "#);
        let text = LOSSY.replacen('{', &supports, 1);
        let bat = Bat::from_text("bat.json", &text, "".as_ref()).unwrap();
        let mut frf = Frf::new(&bat, &Request::default(), at, to).unwrap();
        for Sample { receptance, truncation, .. } in frf.receptances(&[50.0, 500.0]).unwrap() {
            assert!(receptance.norm() == 0.0 && truncation == 0.0, "{support} {at} {to}");
        }
        assert!(frf.static_compliance() == 0.0);
        let mut beside = Frf::new(&bat, &Request::default(), 0.3, 0.6).unwrap();
        assert!(beside.receptances(&[50.0]).unwrap()[0].receptance.norm() > 1e-8);
    }
}
