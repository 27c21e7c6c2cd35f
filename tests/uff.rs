//! Universal files: written files are read back to the digits of the format, files of `pyuff` are read, and no bytes
//! make the reader panic.

use std::path::Path;

use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use sweetspot::base::error::Error;
use uff58::{
    Abscissa, Analysis, Axis, Complex, Dataset, Dof, Function, Header, NodalData, Node, Nodes,
    Stamp, TraceLine, Units, Universal, Values, parse, read, six_digits, write,
};

/// A file that `tests/foreign/make_samples.py` made with pyuff.
fn sample(name: &str) -> Universal {
    let folder = Path::new(env!("SWEETSPOT_TOP")).join("tests/foreign");
    read(&folder.join(format!("{name}.uff"))).unwrap()
}

fn again(datasets: &[Dataset]) -> Vec<Dataset> {
    let text = write(datasets).unwrap();
    assert!(text.is_ascii() && text.lines().all(|line| line.len() <= 80), "{text}");
    let read = parse("again.uff", text.as_bytes()).unwrap();
    assert!(read.skipped.is_empty() && read.converted_from.is_none());
    read.datasets
}

fn said(text: &str) -> String {
    parse("f.uff", text.as_bytes()).unwrap_err().to_string()
}

/// The formulas of `make_samples.py`.
mod truth {
    pub fn shape(k: usize) -> f64 {
        (1.0 + k as f64).sin()
    }

    pub fn turn(k: usize) -> f64 {
        -10.0 * (1.0 + k as f64).cos()
    }

    pub fn signal(k: usize) -> f64 {
        (-0.3 * k as f64).exp() * (k as f64).cos()
    }

    pub fn imaginary(k: usize) -> f64 {
        -1e-3 * (k as f64).sin()
    }
}

fn close(value: f64, truth: f64, digits: i32) {
    let allowed = 0.51 * 10f64.powi(1 - digits) * truth.abs() + 1e-300;
    assert!((value - truth).abs() <= allowed, "{value} for {truth}");
}

#[test]
fn nodes_of_pyuff_are_read() {
    let read = sample("nodes");
    let [
        Dataset::Header(header),
        Dataset::Units(units),
        Dataset::Nodes(old),
        Dataset::Nodes(new),
        Dataset::TraceLine(line),
    ] = &read.datasets[..]
    else {
        panic!("{read:?}")
    };
    assert_eq!((&*header.model, &*header.description), ("samples", "made by pyuff"));
    assert_eq!((&*header.made_by, &*header.written_by), ("make_samples.py", "pyuff"));
    assert_eq!((&*header.created.date, &*header.saved.time), ("01-JAN-26", "12:00:00"));
    assert_eq!(header.version, [1, 2]);
    assert!(units.are_si() && units.temperature_offset == 273.15 && units.code == 1);
    assert_eq!(units.description, "SI units");
    assert!(old.legacy && !new.legacy);
    assert_eq!((old.nodes.len(), new.nodes.len()), (5, 5));
    for k in 0..5 {
        let x = 0.2 * k as f64 / 3.0;
        close(old.nodes[k].at[0], x, 6);
        assert_eq!(new.nodes[k], Node { color: 1, ..Node::new(k as i64 + 1, [x, 0.0, 0.0]) });
        assert_eq!(old.nodes[k].label, k as i64 + 1);
    }
    let nodes = (1..=5).collect();
    assert_eq!(*line, TraceLine { number: 1, color: 0, name: "line".into(), nodes });
}

#[test]
fn shapes_of_pyuff_are_read() {
    let read = sample("shapes");
    let [_, Dataset::NodalData(three), Dataset::NodalData(six), Dataset::NodalData(complex)] =
        &read.datasets[..]
    else {
        panic!("{read:?}")
    };
    for data in [three, six] {
        let Analysis::NormalMode { frequency, modal_mass, viscous, mode, .. } = data.analysis
        else {
            panic!("{data:?}")
        };
        assert_eq!((frequency, modal_mass, viscous, mode), (171.25, 0.103, 0.004, 1));
        assert!(data.ids.iter().all(String::is_empty) && !data.complex && data.quantity == 8);
    }
    let Analysis::ComplexMode { second_order, mode, eigenvalue, modal_a, modal_b, .. } =
        complex.analysis
    else {
        panic!("{complex:?}")
    };
    assert_eq!((second_order, mode, eigenvalue), (false, 2, [-3.5, 1076.0]));
    assert_eq!((modal_a, modal_b), ([0.5, -0.25], [2.0, 1.0]));
    assert_eq!((three.per_node, six.per_node, complex.per_node), (3, 6, 3));
    for k in 0..5 {
        let label = k as i64 + 1;
        assert_eq!([three, six, complex].map(|data| data.values[k].0), [label; 3]);
        close(three.values[k].1[1][0], truth::shape(k), 6);
        close(six.values[k].1[1][0], truth::shape(k), 6);
        close(six.values[k].1[5][0], truth::turn(k), 6);
        close(complex.values[k].1[1][0], truth::shape(k), 6);
        close(complex.values[k].1[1][1], -0.1 * truth::shape(k), 6);
    }
}

/// Even and uneven, real and complex, in double and in single precision, as text and as bytes.
#[test]
fn functions_of_pyuff_are_read() {
    for (name, digits, places) in [("functions", 12, 6), ("singles", 6, 6), ("binary", 16, 16)] {
        let read = sample(name);
        assert_eq!(read.datasets.len(), 4, "{name}");
        for (number, dataset) in read.datasets.iter().enumerate() {
            let Dataset::Function(function) = dataset else { panic!("{dataset:?}") };
            let complex = number >= 2;
            let even = number % 2 == 0;
            assert_eq!(function.kind, if complex { 4 } else { 1 });
            assert_eq!(function.double, name != "singles", "{name}");
            let dof = |node, direction| Dof { entity: String::new(), node, direction };
            assert_eq!((&function.response, &function.reference), (&dof(3, 2), &dof(1, -2)));
            let quantities = function.axes.each_ref().map(|axis| axis.quantity);
            assert_eq!(quantities, if complex { [18, 12, 13, 0] } else { [17, 12, 0, 0] });
            assert_eq!(function.values.len(), 7);
            assert_eq!(even, matches!(function.abscissa, Abscissa::Even { .. }));
            for k in 0..7 {
                let n = k as f64;
                let x = if even { 10.0 + 2.5 * n } else { 0.001 * n * n };
                close(function.abscissa.at(k), x, places);
                let [re, im] = match &function.values {
                    Values::Real(values) => [values[k], 0.0],
                    Values::Complex(values) => values[k],
                };
                close(re, truth::signal(k), digits);
                close(im, if complex { truth::imaginary(k) } else { 0.0 }, digits);
            }
        }
    }
}

/// Dataset 58b by its description: an abscissa has four bytes, a double eight, in either order.
#[test]
fn bytes_of_either_order_are_read() {
    let places = vec![0.5, 1.5, 2.25];
    let values = Values::Complex(vec![[1.0, -2.0], [0.1, 1e-300], [3.5, 0.0]]);
    let written = function(Abscissa::Uneven(places.clone()), values.clone(), true);
    let text = write(&[Dataset::Function(Box::new(written.clone()))]).unwrap();
    let head: String = text.split_inclusive('\n').take(13).collect();
    let Values::Complex(pairs) = &values else { panic!() };
    for (order, little) in [(1, true), (2, false)] {
        let line = format!("    58b     {order}     2          11          60     0     0\n");
        let mut bytes = head.replacen("    58\n", &line, 1).into_bytes();
        for (x, pair) in places.iter().zip(pairs) {
            let x = *x as f32;
            bytes.extend(if little { x.to_le_bytes() } else { x.to_be_bytes() });
            let part = |v: &f64| if little { v.to_le_bytes() } else { v.to_be_bytes() };
            bytes.extend(pair.iter().flat_map(part));
        }
        // Some programs end the bytes with a line end, most do not.
        for end in ["    -1\n", "\n    -1\n", "\r\n    -1"] {
            let read = parse("f.uff", &[&bytes[..], end.as_bytes()].concat()).unwrap();
            assert_eq!(read.datasets, [Dataset::Function(Box::new(written.clone()))]);
        }
        let short = parse("f.uff", &bytes[..bytes.len() - 1]).unwrap_err().to_string();
        assert!(short.contains("expected 60 bytes of 3 values, then -1"), "{short}");
    }
    let vax = head.replacen("    58\n", "    58b     1     1          11\n", 1);
    assert!(said(&vax).contains("found number format 1, expected 2"), "{}", said(&vax));
}

/// The file divided by its factors is SI: 1 ft is 1/3.2808… m.
#[test]
fn a_file_in_feet_is_read_in_metres() {
    let read = sample("feet");
    let (foot, pound) = (1.0 / 3.280_839_895_013_123, 1.0 / 0.224_808_943_099_710_48);
    assert_eq!(read.converted_from.as_ref().unwrap().length, 3.280_839_895_013_123_5);
    let [
        _,
        Dataset::Units(units),
        Dataset::Nodes(nodes),
        Dataset::NodalData(mode),
        Dataset::Function(function),
    ] = &read.datasets[..]
    else {
        panic!("{read:?}")
    };
    assert_eq!(*units, Units::si());
    for k in 0..5 {
        close(nodes.nodes[k].at[0], 0.2 * k as f64 / 3.0 * foot, 15);
        close(mode.values[k].1[1][0], truth::shape(k) * foot, 6);
        // An angle is an angle.
        close(mode.values[k].1[5][0], truth::turn(k), 6);
    }
    let Analysis::NormalMode { modal_mass, frequency, .. } = mode.analysis else { panic!() };
    close(modal_mass, 0.103 * foot * pound, 6);
    assert_eq!(frequency, 171.25);
    let Values::Complex(values) = &function.values else { panic!() };
    for (k, value) in values.iter().enumerate() {
        // ft/s² per lbf.
        close(value[0], truth::signal(k) * foot / pound, 12);
        assert_eq!(function.abscissa.at(k), 10.0 + 2.5 * k as f64);
    }
}

/// A mode swings with the same energy in any units: m φ̇² in the file's, and in SI.
#[test]
fn units_keep_what_a_mode_answers_to_a_force() {
    for (length, force) in [(1000.0, 1000.0), (1000.0, 1.0), (1.0, 1000.0), (3.25, 0.25)] {
        // Displacements and accelerations contain a length, shapes without a unit do not.
        for (quantity, factor) in [(8, length), (12, length), (1, 1.0), (0, 1.0)] {
            let units = Units { length, force, description: "own".into(), code: 9, ..Units::si() };
            let mode = real_mode(&[[0.0, 250.0, 0.0, 0.0, 0.0, 2.0]]);
            let mode = Dataset::NodalData(NodalData { quantity, ..mode });
            let text = write(&[Dataset::Units(units), mode]).unwrap();
            let read = parse("own.uff", text.as_bytes()).unwrap();
            let Dataset::NodalData(mode) = &read.datasets[1] else { panic!() };
            let Analysis::NormalMode { modal_mass, .. } = mode.analysis else { panic!() };
            let [deflection, turn] = [1, 5].map(|k| mode.values[0].1[k][0]);
            close(deflection, 250.0 / factor, 15);
            assert_eq!(turn, 2.0);
            // φ²/m is one over a mass for any unit of φ, and the unit of mass in the file, its force times s² over its
            // length, is length/force kg.
            let answer = 250.0 * 250.0 / 0.125;
            close(deflection * deflection / modal_mass, answer * force / length, 14);
        }
    }
}

fn real_mode(rows: &[[f64; 6]]) -> NodalData {
    let pairs = |row: &[f64; 6]| -> Vec<Complex> { row.iter().map(|v| [*v, 0.0]).collect() };
    let values = rows.iter().enumerate().map(|(k, row)| (k as i64 + 1, pairs(row))).collect();
    NodalData {
        ids: Default::default(),
        model: 1,
        analysis: Analysis::NormalMode {
            load_case: 1,
            mode: 2,
            frequency: 170.5,
            modal_mass: 0.125,
            viscous: 0.01,
            hysteretic: 0.0,
        },
        characteristic: NodalData::MOTIONS,
        quantity: 8,
        complex: false,
        per_node: 6,
        values,
    }
}

fn function(abscissa: Abscissa, values: Values, double: bool) -> Function {
    Function {
        ids: ["a response", "", "", "", "last"].map(String::from),
        kind: 4,
        number: 3,
        version: 1,
        load_case: 0,
        response: Dof { entity: "BAT".into(), node: 12, direction: -2 },
        reference: Dof { entity: String::new(), node: 4_000_000_000, direction: 6 },
        abscissa,
        values,
        double,
        z: 0.5,
        axes: [(18, "frequency", "Hz"), (12, "two words", ""), (13, "", "N"), (0, "", "")].map(
            |(quantity, label, unit)| Axis {
                quantity,
                exponents: [1, -2, 0],
                label: label.into(),
                unit: unit.into(),
            },
        ),
    }
}

#[test]
fn everything_that_is_written_is_read_back() {
    let stamp = Stamp::at(1_700_000_000);
    let header = Header {
        model: "Ash, 33 in".into(),
        description: "".into(),
        made_by: "someone".into(),
        created: stamp.clone(),
        saved: Stamp::fixed(),
        written: stamp,
        version: [7, -1],
        written_by: "a test".into(),
    };
    let nodes = |legacy| {
        let node = |k: i64| Node {
            systems: [k, 0],
            color: 3,
            ..Node::new(k, [0.125 * k as f64, -1.0, 1e-3])
        };
        Dataset::Nodes(Nodes { nodes: (1..=9).map(node).collect(), legacy })
    };
    let line = TraceLine {
        number: 2,
        color: 5,
        name: "line".into(),
        nodes: [(1..=20).collect(), vec![0], (30..=258).collect()].concat(),
    };
    assert_eq!(line.nodes.len(), TraceLine::MOST);
    let complex = NodalData {
        analysis: Analysis::ComplexMode {
            second_order: false,
            load_case: 0,
            mode: 4,
            eigenvalue: [-1.5, 1000.0],
            modal_a: [0.0, 2.0],
            modal_b: [1.0, -3.0],
        },
        complex: true,
        values: vec![(7, (0..6).map(|k| [0.5, f64::from(k)]).collect())],
        ..real_mode(&[])
    };
    let answer = Analysis::FrequencyResponse { load_case: 1, step: 2, frequency: 50.0 };
    let buckling = Analysis::Other { kind: 6, integers: vec![1; 9], reals: vec![2.5; 12] };
    let other = |analysis| NodalData { analysis, values: Vec::new(), ..real_mode(&[]) };
    let datasets = [
        Dataset::Header(header),
        Dataset::Units(Units::si()),
        nodes(false),
        nodes(true),
        Dataset::TraceLine(line),
        Dataset::NodalData(real_mode(&[[1.0, -0.5, 0.25, 0.0, 0.0, 12.5], [0.0; 6]])),
        Dataset::NodalData(complex),
        Dataset::NodalData(other(answer)),
        Dataset::NodalData(other(buckling)),
    ];
    assert_eq!(again(&datasets), datasets);
}

#[test]
fn every_kind_of_function_is_read_back() {
    for count in [0usize, 1, 2, 3, 4, 5, 6, 7, 12, 13] {
        let real: Vec<f64> = (0..count).map(|k| 0.5 - k as f64).collect();
        let complex = real.iter().map(|v| [*v, 0.25 * v]).collect();
        for values in [Values::Real(real.clone()), Values::Complex(complex)] {
            let places = (0..count).map(|k| (k * k) as f64).collect();
            for abscissa in [Abscissa::Even { start: 1.0, step: 0.5 }, Abscissa::Uneven(places)] {
                for double in [false, true] {
                    let function = function(abscissa.clone(), values.clone(), double);
                    let datasets = [Dataset::Function(Box::new(function))];
                    assert_eq!(again(&datasets), datasets);
                }
            }
        }
    }
}

#[test]
fn what_does_not_fit_the_format_is_not_written() {
    let complaint = |dataset: Dataset| write(&[dataset]).unwrap_err().to_string();
    let mode = |row| Dataset::NodalData(real_mode(&[row]));
    for bad in [f64::NAN, f64::INFINITY] {
        assert!(complaint(mode([0.0, bad, 0.0, 0.0, 0.0, 0.0])).contains("a finite number"));
    }
    let line =
        |nodes| Dataset::TraceLine(TraceLine { number: 1, color: 0, name: String::new(), nodes });
    assert!(complaint(line((1..=251).collect())).contains("found 251 nodes, expected 250"));
    let long = complaint(line(vec![12_345_678_901]));
    assert!(long.contains("expected a number of 10 columns"), "{long}");
    let short = NodalData { per_node: 5, ..real_mode(&[[0.0; 6]]) };
    assert!(complaint(Dataset::NodalData(short)).contains("found 6 values, expected 5"));
    let uneven = function(Abscissa::Uneven(vec![1.0]), Values::Real(vec![1.0, 2.0]), true);
    assert!(complaint(Dataset::Function(Box::new(uneven))).contains("1 places for 2 values"));
}

/// Names cannot end a dataset, break a line or leave their columns.
#[test]
fn names_of_any_kind_stay_in_their_columns() {
    let long = "x".repeat(200);
    for name in ["-1", "    -1", "a\n    -1\n", "Übung ½", "\u{7}\t", &*long] {
        let line = TraceLine { number: 1, color: 0, name: name.into(), nodes: vec![1, 2] };
        let function =
            function(Abscissa::Even { start: 0.0, step: 1.0 }, Values::Real(vec![1.0]), true);
        let function = Function {
            ids: [name; 5].map(String::from),
            response: Dof { entity: name.into(), node: 1, direction: 1 },
            ..function
        };
        let datasets = [Dataset::TraceLine(line), Dataset::Function(Box::new(function))];
        let [Dataset::TraceLine(line), Dataset::Function(function)] = &again(&datasets)[..] else {
            panic!("{name:?}")
        };
        assert_eq!(line.nodes, [1, 2]);
        assert_eq!((function.response.node, function.values.len()), (1, 1));
        assert!(line.name.len() <= 80);
    }
}

const SHAPE: &str = "    -1
    55
one
two
three
four
five
         1         2         3         8         2         6
         2         4         1         1
  1.70000E+02  1.00000E-01  1.00000E-02  0.00000E+00
         1
  0.00000E+00  1.00000E+00  0.00000E+00  0.00000E+00  0.00000E+00 -6.00000E+00
    -1
";

#[test]
fn line_ends_exponents_and_glued_numbers_are_taken_as_they_come() {
    let plain = parse("f.uff", SHAPE.as_bytes()).unwrap();
    let glued = ["  0.00000E+00", "  1.00000E+00", "-0.00000E+000", "-0.00000E+000"].concat()
        + "-0.00000E+000-6.00000E+000";
    let old = SHAPE.lines().nth(11).unwrap();
    for text in [
        SHAPE.replace('\n', "\r\n"),
        SHAPE.replace("E+0", "e+0"),
        SHAPE.replace("E+0", "D+0"),
        SHAPE.replace("E+0", "d+0"),
        SHAPE.replace("1.00000E+00", " 1.0000+000"),
        SHAPE.replace(old, &glued),
        SHAPE.replace(old, "0 1.0 0 0 0 -6"),
        SHAPE.replace(old, "0 1.0\n0 0\n0 -6"),
        SHAPE.replace("    -1", "-1"),
        SHAPE.replace("\n    -1\n", "\n\n    -1\n\n"),
        SHAPE.replace("\n    -1\n", "\n    -1"),
        format!("\u{feff}{SHAPE}"),
        format!("\n \n{SHAPE}"),
    ] {
        let read = parse("f.uff", text.as_bytes()).unwrap();
        // Here the datasets begin on other lines.
        let lines = plain.lines.clone();
        assert_eq!(Universal { lines, ..read }, plain, "{text}");
    }
    // Lines of text may be blank, NONE, or in an older alphabet.
    let names = |bytes: &[u8]| {
        let Dataset::NodalData(data) = parse("f", bytes).unwrap().datasets.remove(0) else {
            panic!()
        };
        data.ids[0].clone()
    };
    assert_eq!(names(SHAPE.replace("one", "").as_bytes()), "");
    assert_eq!(names(SHAPE.replace("one", "none").as_bytes()), "");
    let latin = [&SHAPE.as_bytes()[..16], b"B\xfchne", &SHAPE.as_bytes()[17..]].concat();
    assert!(names(&latin).contains("B\u{fc}hne"), "{}", names(&latin));
}

/// Fortran leaves a field blank for 0 and reads it so, at the end of a line too.
#[test]
fn a_blank_field_is_zero() {
    let rows = [[0.0, 1.0, 0.0], [2.0, 0.0, 0.0], [0.5, 0.0, -3.0], [0.0, 0.0, 4.0]];
    let pairs = |row: &[f64; 3]| row.iter().map(|v| [*v, 0.0]).collect();
    let mode = NodalData {
        per_node: 3,
        characteristic: NodalData::TRANSLATIONS,
        values: rows.iter().zip(1..).map(|(row, label)| (label, pairs(row))).collect(),
        ..real_mode(&[])
    };
    let node = |(row, label): (&[f64; 3], i64)| Node::new(label, *row);
    let nodes: Vec<Node> = rows.iter().zip(1..).map(node).collect();
    let complex = NodalData {
        complex: true,
        values: vec![(1, vec![[1.0, 0.0], [0.0; 2], [0.0; 2], [0.0; 2], [0.0, 2.0], [0.0; 2]])],
        ..real_mode(&[])
    };
    let datasets = [
        Dataset::Nodes(Nodes { nodes, legacy: false }),
        Dataset::NodalData(mode),
        Dataset::NodalData(complex),
    ];
    let full = write(&datasets).unwrap();
    let without = |zero: &str| -> String {
        let blank = " ".repeat(zero.len());
        let line = |line: &str| format!("{}\n", line.replace(zero, &blank).trim_end());
        full.lines().map(line).collect()
    };
    for zero in ["  0.00000E+00", "   0.0000000000000000D+00"] {
        let text = without(zero);
        assert_ne!(text, full);
        assert_eq!(parse("f.uff", text.as_bytes()).unwrap().datasets, datasets, "{text}");
    }
}

#[test]
fn a_mistake_is_told_with_its_line_and_column() {
    let without = |line: usize| -> String {
        let kept = SHAPE.lines().enumerate().filter(|(k, _)| *k != line - 1);
        kept.map(|(_, line)| format!("{line}\n")).collect()
    };
    for (text, place, words) in [
        (String::new(), "f.uff:1:1", "the end of the file, expected a universal file"),
        ("hello\n".into(), "f.uff:1:1", "found \"hello\", expected -1"),
        ("    -1\n".into(), "f.uff:2:1", "the end of the file, expected the number of a dataset"),
        ("    -1\n  abc\n".into(), "f.uff:2:3", "found \"abc\", expected the number"),
        (SHAPE.replace("1.00000E-01", "1.0000OE-01"), "f.uff:10:16", "found \"1.0000OE-01\""),
        (SHAPE.replace("-6.0", "nan"), "f.uff:12:67", "the values at a node"),
        (SHAPE.replace("         1\n  0.0", "         x\n  0.0"), "f.uff:11:10", "found \"x\""),
        (SHAPE.replace("8         2 ", "8         3 "), "f.uff:8:10", "found data type 3"),
        (without(12), "f.uff:12:5", "found the end of the dataset, expected the values at a node"),
        (without(13), "f.uff:13:1", "the end of the file, expected -1 in columns 5 and 6"),
        (SHAPE[..200].into(), "f.uff:", "expected"),
        (format!("{SHAPE}rest\n"), "f.uff:14:1", "found \"rest\""),
        (
            SHAPE.replace("-6.00000E+00", "-6.00000E+00 1"),
            "f.uff:12:3",
            "7 numbers in this line, expected 6",
        ),
    ] {
        let said = said(&text);
        assert!(said.starts_with(place) && said.contains(words), "{said}");
    }
    let said = read(Path::new("no-such.uff")).unwrap_err().to_string();
    assert!(said.starts_with("cannot read no-such.uff"), "{said}");
}

#[test]
fn unknown_datasets_are_skipped_and_noted() {
    let text =
        format!("    -1\n  2420\n  anything\n        -1\n    -1\n{SHAPE}    -1\n   666\n    -1\n");
    let read = parse("f.uff", text.as_bytes()).unwrap();
    assert_eq!(read.datasets.len(), 1);
    let skipped: Vec<_> = read.skipped.iter().map(|s| (s.number, s.line)).collect();
    assert_eq!(skipped, [(2420, 2), (666, 20)]);
}

#[test]
fn factors_of_units_are_above_zero() {
    let text = write(&[Dataset::Units(Units::si())]).unwrap();
    for bad in ["0.00000000000000000D+00", "-1.0000000000000000D+00"] {
        let said = said(&text.replacen("1.00000000000000000D+00", bad, 1));
        assert!(said.starts_with("f.uff:4:3: found") && said.contains("above 0"), "{said}");
    }
    let nodes = Nodes { nodes: vec![Node::new(1, [1e300, 0.0, 0.0])], legacy: false };
    let units = Units { length: 1e-90, ..Units::si() };
    let text = write(&[Dataset::Units(units), Dataset::Nodes(nodes)]).unwrap();
    assert!(said(&text).contains("beyond the largest"), "{}", said(&text));
}

/// Valid files to be damaged.
fn samples() -> Vec<Vec<u8>> {
    let folder = Path::new(env!("SWEETSPOT_TOP")).join("tests/foreign");
    let names = ["nodes", "shapes", "functions", "singles", "binary", "feet"];
    names.map(|name| std::fs::read(folder.join(format!("{name}.uff"))).unwrap()).to_vec()
}

fn answers(bytes: &[u8]) {
    match parse("f.uff", bytes) {
        Ok(read) => assert!(!read.datasets.is_empty() || !read.skipped.is_empty()),
        Err(Error::Input { place, .. }) => assert!(place.line >= 1 && place.column >= 1),
        Err(other) => panic!("{other}"),
    }
}

#[test]
fn a_file_cut_anywhere_is_an_error_or_a_file() {
    for bytes in samples() {
        (0..bytes.len()).for_each(|end| answers(&bytes[..end]));
    }
}

proptest! {
    #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(6), ..ProptestConfig::default() })]

    #[test]
    fn any_bytes_are_an_error_or_a_file(bytes in proptest::collection::vec(any::<u8>(), 0..400)) {
        answers(&bytes);
        let fenced = [b"    -1\n    58\n", &bytes[..], b"\n    -1\n"].concat();
        answers(&fenced);
    }

    #[test]
    fn any_words_are_an_error_or_a_file(
        lines in proptest::collection::vec("(    -1|   (15|55|58|82)|( {0,9}[-0-9.eED]{1,9}){0,7})", 0..40),
    ) {
        answers(lines.join("\n").as_bytes());
    }

    #[test]
    fn a_spoilt_file_is_an_error_or_a_file(
        which in 0usize..6,
        at in any::<prop::sample::Index>(),
        cut in 0usize..90,
        put in proptest::collection::vec(prop_oneof![any::<u8>(), Just(b'\n'), Just(b' '), b'0'..=b'9'], 0..12),
    ) {
        let mut bytes = samples().swap_remove(which);
        let start = at.index(bytes.len());
        let end = (start + cut).min(bytes.len());
        bytes.splice(start..end, put);
        answers(&bytes);
    }

    /// Six digits in datasets 55 and 15, all in 2411, thirteen in the values of 58.
    #[test]
    fn values_come_back_to_the_digits_of_their_dataset(
        values in proptest::collection::vec(-1e9f64..1e9, 1..20),
        power in -80i32..80,
    ) {
        let values: Vec<f64> = values.iter().map(|v| v * 10f64.powi(power)).collect();
        let rows: Vec<[f64; 6]> = values.iter().map(|v| [*v; 6]).collect();
        let node = |(k, v): (usize, &f64)| Node::new(k as i64 + 1, [*v, -v, 0.5 * v]);
        let nodes: Vec<Node> = values.iter().enumerate().map(node).collect();
        let pairs = values.iter().map(|v| [*v, -v]).collect();
        let datasets = [
            Dataset::NodalData(real_mode(&rows)),
            Dataset::Nodes(Nodes { nodes: nodes.clone(), legacy: true }),
            Dataset::Nodes(Nodes { nodes: nodes.clone(), legacy: false }),
            Dataset::Function(Box::new(function(Abscissa::Uneven(values.clone()), Values::Complex(pairs), true))),
        ];
        let read = again(&datasets);
        let [Dataset::NodalData(mode), Dataset::Nodes(old), Dataset::Nodes(new), Dataset::Function(function)] = &read[..]
        else { panic!() };
        prop_assert_eq!(&new.nodes, &nodes);
        let Values::Complex(pairs) = &function.values else { panic!() };
        for (k, v) in values.iter().enumerate() {
            let six = six_digits(*v);
            prop_assert!((six / v - 1.0).abs() <= 0.5001e-5);
            prop_assert!(mode.values[k].1.iter().all(|value| *value == [six, 0.0]));
            prop_assert_eq!(old.nodes[k].at[0], six);
            prop_assert_eq!(function.abscissa.at(k), six);
            prop_assert!((pairs[k][0] / v - 1.0).abs() <= 0.5001e-12);
            prop_assert_eq!(pairs[k][1], -pairs[k][0]);
        }
    }
}
