//! `sweetspot convert` and its files; `frf --uff`; the archive with the matrices.
//!
//! `tests/foreign/read_back.py` reads the same files with the programs for which they are made.

use crate::common;

use std::io::Read;
use std::path::Path;

use common::diagnostic::in_lines;
use common::folder::Folder;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use serde_json::{Value, json};
use sweetspot::Bat;
use sweetspot::base::error::Error;
use sweetspot_report::exchange::modes_file;
use sweetspot_report::exchange::vtu;
use uff58::{Abscissa, Analysis, Dataset, Values, six_digits};

fn mesh(name: &str) -> String {
    format!("{}/meshes/{name}.json", env!("SWEETSPOT_TOP"))
}

/// A folder with `bat.json`, three modes of the R161.
fn modes(name: &str, points: &str) -> (Folder, Value) {
    let folder = Folder::new(name);
    let r161 = mesh("r161");
    folder.text(&["modes", &r161, "-n", "3", "--shape-points", points, "--json", "bat.json"]);
    let document = serde_json::from_str(&folder.read("bat.json")).unwrap();
    (folder, document)
}

fn list(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

/// Standard error of a run that must fail with 2 and leave no file behind.
fn refused(folder: &Folder, args: &[&str]) -> String {
    let before = folder.names();
    let output = folder.run(args);
    let told = in_lines(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{args:?}: {told}");
    assert!(told.starts_with("error: ") && output.stdout.is_empty(), "{args:?}: {told}");
    assert_eq!(folder.names(), before, "{args:?}");
    told
}

#[test]
fn a_universal_file_holds_the_modes() {
    let (folder, document) = modes("convert-uff", "7");
    let said = folder.text(&["convert", "bat.json", "--to", "uff"]);
    assert!(said.starts_with("bat.uff: 3 modes at 7 places, "), "{said}");
    folder.text(&["convert", "bat.json", "--to", "uff", "--legacy", "--out", "old.uff"]);
    for (name, legacy) in [("bat.uff", false), ("old.uff", true)] {
        let read = uff58::read(&folder.0.join(name)).unwrap();
        assert!(read.converted_from.is_none() && read.datasets.len() == 7);
        let [
            Dataset::Header(header),
            Dataset::Units(units),
            Dataset::Nodes(nodes),
            Dataset::TraceLine(line),
            shapes @ ..,
        ] = &read.datasets[..]
        else {
            panic!("{read:?}")
        };
        assert_eq!(header.model, document["bat"]["name"].as_str().unwrap());
        assert!(units.are_si() && nodes.legacy == legacy && line.nodes.len() == 7);
        for (k, shape) in shapes.iter().enumerate() {
            let mode = &document["modes"][k];
            let Dataset::NodalData(shape) = shape else { panic!("{shape:?}") };
            let Analysis::NormalMode { frequency, modal_mass, .. } = shape.analysis else {
                panic!("{shape:?}")
            };
            assert_eq!(frequency, six_digits(mode["frequency_hz"].as_f64().unwrap()));
            assert_eq!(modal_mass, six_digits(mode["modal_mass_kg"].as_f64().unwrap()));
            let [x, w, turn] =
                ["x_m", "deflection", "rotation"].map(|key| list(&mode["shape"][key]));
            for i in 0..7 {
                let at = if legacy { six_digits(x[i]) } else { x[i] };
                assert_eq!(nodes.nodes[i].at, [at, 0.0, 0.0]);
                let parts: Vec<f64> = shape.values[i].1.iter().map(|part| part[0]).collect();
                assert_eq!(parts, [0.0, six_digits(w[i]), 0.0, 0.0, 0.0, six_digits(turn[i])]);
            }
        }
    }
}

/// A bat is solved before conversion, with a message; a universal file is recognised with a message.
#[test]
fn a_bat_is_solved_for_its_modes_and_a_universal_file_is_told() {
    let folder = Folder::new("convert-bat");
    let said = folder.text(&["convert", "r161", "--to", "uff", "--out", "r161.uff"]);
    assert!(said.contains("solved"), "{said}");
    let back = folder.json(&["compare", "r161", "--measured", "r161.uff", "--json", "-"]);
    for pair in back["pairs"].as_array().unwrap() {
        let [apart, mac] = ["frequency_difference", "mac"].map(|key| pair[key].as_f64().unwrap());
        assert!(apart.abs() < 1e-4 && mac > 0.99, "{pair}");
    }
    let error = refused(&folder, &["convert", "r161.uff", "--to", "csv"]);
    for words in ["a universal file", "compare BAT --measured", "calibrate BAT"] {
        assert!(error.contains(words), "{words}: {error}");
    }
}

#[test]
fn the_same_modes_make_the_same_bytes() {
    let (folder, _) = modes("convert-same", "5");
    let to = |out: &str, args: &[&str]| {
        folder.text(&[&["convert", "bat.json", "--out", out, "--to"], args].concat());
        std::fs::read(folder.0.join(out)).unwrap()
    };
    for args in [&["uff", "--reproducible"][..], &["vtu", "--surface", "5"], &["npz"], &["csv"]] {
        assert_eq!(to("one", args), to("two", args), "{args:?}");
    }
    let text = String::from_utf8(to("one", &["uff", "--reproducible"])).unwrap();
    assert!(text.contains("01-JAN-70") && text.lines().all(|line| line.len() <= 80));
    // Standard output contains exactly the file.
    for format in ["vtu", "csv"] {
        let printed = folder.text(&["convert", "bat.json", "--to", format, "--out", "-"]);
        assert_eq!(printed.into_bytes(), to("one", &[format]));
    }
}

#[test]
fn a_table_reads_back_to_the_same_bits() {
    let (folder, document) = modes("convert-csv", "6");
    folder.text(&["convert", "bat.json", "--to", "csv"]);
    let text = folder.read("bat.csv");
    let mut lines = text.lines();
    assert_eq!(
        lines.next().unwrap(),
        "x_m,radius_m,inner_radius_m,mode_1_deflection,mode_1_rotation_rad_per_m,\
         mode_2_deflection,mode_2_rotation_rad_per_m,mode_3_deflection,mode_3_rotation_rad_per_m"
    );
    let rows: Vec<Vec<f64>> =
        lines.map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect()).collect();
    assert_eq!(rows.len(), 6);
    let bat = Bat::from_file(mesh("r161")).unwrap();
    for (i, row) in rows.iter().enumerate() {
        let section = bat.profile().at(row[0]);
        assert_eq!((row[1], row[2]), (section.outer, section.inner));
        for k in 0..3 {
            let shape = &document["modes"][k]["shape"];
            assert_eq!(row[0], list(&shape["x_m"])[i]);
            assert_eq!(row[3 + 2 * k], list(&shape["deflection"])[i]);
            assert_eq!(row[4 + 2 * k], list(&shape["rotation"])[i]);
        }
    }
}

/// The numbers of one array of an archive, with its NumPy description.
fn array(folder: &Folder, file: &str, name: &str) -> (String, Vec<f64>) {
    let bytes = std::fs::File::open(folder.0.join(file)).unwrap();
    let mut archive = zip::ZipArchive::new(bytes).unwrap();
    let mut entry = archive.by_name(&format!("{name}.npy")).unwrap();
    let mut bytes = Vec::new();
    entry.read_to_end(&mut bytes).unwrap();
    assert!(bytes.starts_with(b"\x93NUMPY\x01\x00"));
    let end = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    let header = String::from_utf8(bytes[10..end].to_vec()).unwrap();
    let integers = header.contains("'<i8'");
    let number = |part: &[u8]| {
        let part = part.try_into().unwrap();
        if integers { i64::from_le_bytes(part) as f64 } else { f64::from_le_bytes(part) }
    };
    (header.trim().to_owned(), bytes[end..].chunks(8).map(number).collect())
}

#[test]
fn an_archive_holds_the_modes() {
    let (folder, document) = modes("convert-npz", "4");
    folder.text(&["convert", "bat.json", "--to", "npz"]);
    let modes = document["modes"].as_array().unwrap();
    let (header, deflections) = array(&folder, "bat.npz", "deflection");
    assert_eq!(header, "{'descr': '<f8', 'fortran_order': False, 'shape': (3,4,), }");
    let expected: Vec<f64> = modes.iter().flat_map(|m| list(&m["shape"]["deflection"])).collect();
    assert_eq!(deflections, expected);
    let frequencies: Vec<f64> = modes.iter().map(|m| m["frequency_hz"].as_f64().unwrap()).collect();
    assert_eq!(array(&folder, "bat.npz", "frequency_hz").1, frequencies);
    assert_eq!(array(&folder, "bat.npz", "order").1, [1.0, 2.0, 3.0]);
    for (k, mode) in modes.iter().enumerate() {
        let nodes = array(&folder, "bat.npz", &format!("nodes_m_{}", k + 1)).1;
        assert_eq!(nodes, list(&mode["nodes_m"]));
    }
}

/// Every entry of the Matrix Market file is in the columns of the archive.
#[test]
fn the_archive_beside_the_matrices_holds_the_same() {
    let folder = Folder::new("matrices-npz");
    folder.text(&["modes", &mesh("r161"), "-n", "2", "--matrices", "m"]);
    for (name, file) in [("K", "m/stiffness.mtx"), ("M", "m/mass.mtx")] {
        let part = |part: &str| array(&folder, "m/bat.npz", &format!("{name}_{part}")).1;
        let [data, indices, indptr, shape] = ["data", "indices", "indptr", "shape"].map(part);
        let text = folder.read(file);
        let mut lines = text.lines().filter(|line| !line.starts_with('%'));
        let size: Vec<f64> =
            lines.next().unwrap().split(' ').map(|word| word.parse().unwrap()).collect();
        assert_eq!(shape, size[..2]);
        let mut lower = 0;
        for line in lines {
            let words: Vec<f64> = line.split(' ').map(|word| word.parse().unwrap()).collect();
            let column = words[1] as usize - 1;
            let range = indptr[column] as usize..indptr[column + 1] as usize;
            let at = range.clone().find(|k| indices[*k] == words[0] - 1.0).unwrap();
            assert_eq!(data[at], words[2], "{name} {line}");
            lower += 1;
        }
        assert_eq!(lower as f64, size[2]);
    }
    let x = array(&folder, "m/bat.npz", "x_m").1;
    let unknown = array(&folder, "m/bat.npz", "deflection_unknown").1;
    assert_eq!((x.len(), x[0], unknown[0]), (unknown.len(), 0.0, 0.0));
    let size = array(&folder, "m/bat.npz", "K_shape").1[0];
    assert_eq!(unknown[unknown.len() - 1], size - 2.0);
}

fn numbers(text: &str, name: &str) -> Vec<f64> {
    let start = text.find(&format!("Name=\"{name}\"")).unwrap();
    let body = text[start..].split('>').nth(1).unwrap().split('<').next().unwrap();
    body.split_whitespace().map(|word| word.parse().unwrap()).collect()
}

#[test]
fn a_grid_holds_the_modes_as_vectors() {
    let (folder, document) = modes("convert-vtu", "5");
    folder.text(&["convert", "bat.json", "--to", "vtu"]);
    let text = folder.read("bat.vtu");
    assert!(text.contains("NumberOfPoints=\"5\" NumberOfCells=\"4\""));
    assert_eq!(numbers(&text, "connectivity"), [0, 1, 1, 2, 2, 3, 3, 4].map(f64::from));
    assert_eq!(numbers(&text, "types"), [3.0; 4]);
    for k in 0..3 {
        let vectors = numbers(&text, &format!("mode_{:02}", k + 1));
        let deflections = list(&document["modes"][k]["shape"]["deflection"]);
        let expected: Vec<f64> = deflections.iter().flat_map(|w| [0.0, *w, 0.0]).collect();
        assert_eq!(vectors, expected);
        assert_eq!(numbers(&text, "frequency_hz")[k], document["modes"][k]["frequency_hz"]);
    }
    let out = "turned.PVD";
    let said = folder.text(&["convert", "bat.json", "--to", "vtu", "--surface", "6", "--out", out]);
    assert!(said.starts_with("turned.PVD and 3 files beside it: "), "{said}");
    let collection = folder.read(out);
    for k in 1..=3 {
        let name = format!("turned_mode_{k:02}.vtu");
        let time = document["modes"][k - 1]["frequency_hz"].as_f64().unwrap();
        let entry = format!("timestep=\"{time:?}\" group=\"\" part=\"0\" file=\"{name}\"");
        assert!(collection.contains(&entry), "{collection}");
        let text = folder.read(&name);
        assert_eq!(numbers(&text, "TimeValue"), [time]);
        // Five circles of six, and the middles of two discs.
        assert!(text.contains("NumberOfPoints=\"32\" NumberOfCells=\"36\""));
    }
}

/// Names of bats are text in every format, regardless of their characters.
#[test]
fn a_strange_name_breaks_no_file() {
    let (folder, mut document) = modes("convert-name", "3");
    for (name, model) in [
        ("--> <&\"'\u{0}\n    -1\n Übung", "--> <&\"'??    -1? ?bung"),
        ("-1", "-1"),
        ("---", "---"),
        ("--->", "--->"),
        ("a---b", "a---b"),
    ] {
        document["bat"]["name"] = json!(name);
        folder.write("bat.json", document.to_string());
        folder.text(&["convert", "bat.json", "--to", "uff"]);
        let read = uff58::read(&folder.0.join("bat.uff")).unwrap();
        let Dataset::Header(header) = &read.datasets[0] else { panic!("{read:?}") };
        assert_eq!((read.datasets.len(), &*header.model), (7, model));
        folder.text(&["convert", "bat.json", "--to", "vtu"]);
        let text = folder.read("bat.vtu");
        // XML: neither two hyphens nor a hyphen at the end of a comment.
        let comment = text.split("<!--").nth(1).unwrap().split("-->").next().unwrap();
        assert!(!comment.contains("--") && !comment.ends_with('-'), "{comment}");
        assert!(!comment.contains('<') && !comment.contains('\u{0}'), "{comment}");
        assert!(text.split("-->").nth(1).unwrap().trim_start().starts_with("<VTKFile "), "{text}");
    }
}

/// A line of a universal file has 250 nodes at most, while a bat may have more places.
#[test]
fn a_universal_file_keeps_every_place_and_a_line_from_each_to_the_next() {
    for count in [250_usize, 251, 1001] {
        let (folder, document) = modes("convert-many", &count.to_string());
        let said = folder.text(&["convert", "bat.json", "--to", "uff"]);
        assert!(said.contains(&format!("3 modes at {count} places")), "{said}");
        let read = uff58::read(&folder.0.join("bat.uff")).unwrap();
        let Dataset::Nodes(nodes) = &read.datasets[2] else { panic!("{read:?}") };
        let x: Vec<f64> = nodes.nodes.iter().map(|node| node.at[0]).collect();
        assert_eq!(x, list(&document["modes"][0]["shape"]["x_m"]));
        let mut steps: Vec<[i64; 2]> = vec![];
        for dataset in &read.datasets {
            match dataset {
                Dataset::TraceLine(line) => {
                    assert!((2..=250).contains(&line.nodes.len()));
                    steps.extend(line.nodes.windows(2).map(|pair| [pair[0], pair[1]]));
                }
                Dataset::NodalData(shape) => assert_eq!(shape.values.len(), count),
                _ => {}
            }
        }
        let all: Vec<[i64; 2]> = (1..count as i64).map(|k| [k, k + 1]).collect();
        assert_eq!(steps, all);
    }
}

/// An output that would fill the memory is refused in advance, with its approximate size.
#[test]
fn a_surface_too_large_to_write_is_refused() {
    let (folder, _) = modes("convert-giant", "101");
    let surface = ["convert", "bat.json", "--to", "vtu", "--surface", "40", "--out"];
    for (out, file, modes) in [("a.vtu", "a.vtu", 3), ("b.pvd", "b_mode_02.vtu", 1)] {
        folder.text(&[&surface[..], &[out]].concat());
        let size = folder.read(file).len() as f64;
        let about = vtu::size(40 * 101, modes) as f64;
        assert!((0.8..1.25).contains(&(about / size)), "{about} for {size}");
    }
    let mut document: Value = serde_json::from_str(SMALL).unwrap();
    let places: Vec<f64> = (0..20_000).map(|k| f64::from(k) / 20_000.0).collect();
    document["modes"][0]["shape"] =
        json!({ "x_m": places, "deflection": places, "rotation": places });
    let first = document["modes"][0].clone();
    for order in 2..=7 {
        let mut mode = first.clone();
        mode["order"] = json!(order);
        document["modes"].as_array_mut().unwrap().push(mode);
    }
    folder.write("giant.json", document.to_string());
    for out in ["a.vtu", "a.pvd"] {
        let args = ["convert", "giant.json", "--to", "vtu", "--surface", "360", "--out", out];
        let told = refused(&folder, &args);
        assert!(told.contains("--surface: found 360, with 7 modes at 20000 places"), "{told}");
        assert!(told.contains("expected 1 GB at most: fewer points around"), "{told}");
    }
    folder.text(&["convert", "giant.json", "--to", "vtu", "--out", "a.vtu"]);
}

#[test]
fn a_response_is_written_at_the_frequencies_that_the_file_can_hold() {
    let folder = Folder::new("frf-uff");
    let bat = mesh("r161");
    let cases: [(&str, &str, i64, &[&str]); 3] = [
        ("receptance", "m_per_n", 8, &["--to", "2 in"]),
        ("mobility", "m_per_s_n", 11, &["--frequencies", "50,123.456789,170"]),
        (
            "accelerance",
            "1_per_kg",
            12,
            &["--linear", "--from-hz", "10", "--to-hz", "900", "--points", "8"],
        ),
    ];
    for (kind, unit, numerator, options) in cases {
        let args =
            ["frf", &bat, "--at", "28 in", "--kind", kind, "--uff", "out.uff", "--json", "-"];
        let document = folder.json(&[&args[..], options].concat());
        let read = uff58::read(&folder.0.join("out.uff")).unwrap();
        let Some(Dataset::Function(function)) = read.datasets.last() else { panic!("{read:?}") };
        assert_eq!(function.axes.each_ref().map(|axis| axis.quantity), [18, numerator, 13, 0]);
        assert_eq!(matches!(function.abscissa, Abscissa::Even { .. }), kind == "accelerance");
        let Values::Complex(values) = &function.values else { panic!() };
        let frequencies = list(&document["frequency_hz"]);
        let real = list(&document[format!("real_{unit}")]);
        let imaginary = list(&document[format!("imaginary_{unit}")]);
        assert!(values.len() == frequencies.len() || kind == "accelerance");
        for (k, value) in values.iter().enumerate() {
            // Evenly spaced frequencies leave no room for the additional ones that show the peaks.
            let at = function.abscissa.at(k);
            let j = frequencies.iter().position(|f| *f == at).unwrap();
            for (found, truth) in [(value[0], real[j]), (value[1], imaginary[j])] {
                assert!((found - truth).abs() <= 0.5001e-12 * truth.abs());
            }
        }
    }
    // A resonance is at its six-digit frequency, in the table too.
    let args = ["frf", &bat, "--at", "28 in", "--frequencies", "174.5085428", "--csv", "-"];
    let rounded = folder.text(&[&args[..], &["--uff", "out.uff"]].concat());
    assert!(rounded.lines().nth(1).unwrap().starts_with("174.509,"), "{rounded}");
    assert!(folder.text(&args).lines().nth(1).unwrap().starts_with("174.5085428,"));
    // Frequencies rise in the file, regardless of the order of the request.
    let listed = ["--frequencies", "500,100,300", "--json", "-", "--uff", "out.uff"];
    let document = folder.json(&[&["frf", &bat, "--at", "28 in"], &listed[..]].concat());
    assert_eq!(list(&document["frequency_hz"]), [100.0, 300.0, 500.0]);
    let read = uff58::read(&folder.0.join("out.uff")).unwrap();
    let Some(Dataset::Function(function)) = read.datasets.last() else { panic!("{read:?}") };
    assert_eq!(function.abscissa, Abscissa::Uneven(vec![100.0, 300.0, 500.0]));
    let narrow = ["--from-hz", "170", "--to-hz", "170.001", "--points", "20"];
    for (asked, words) in [
        (&narrow[..], "--points: found 170.0 Hz more than once in the six digits"),
        (&["--frequencies", "300,170,170.0001"], "--frequencies: found 170.0 Hz more than once"),
    ] {
        let told = refused(&folder, &[&args[..4], asked, &["--uff", "out.uff"]].concat());
        assert!(told.contains(words), "{told}");
    }
    let even = [&args[..4], &narrow, &["--linear", "--uff", "out.uff"]].concat();
    folder.text(&even);
    let read = uff58::read(&folder.0.join("out.uff")).unwrap();
    let Some(Dataset::Function(function)) = read.datasets.last() else { panic!("{read:?}") };
    let places: Vec<f64> = (0..20).map(|k| function.abscissa.at(k)).collect();
    assert!(places.windows(2).all(|pair| pair[0] < pair[1]), "{places:?}");
    let same = |out: &str| {
        folder.text(&[&args[..6], &["--reproducible", "--quiet", "--uff", out]].concat());
        folder.read(out)
    };
    assert_eq!(same("one.uff"), same("two.uff"));
    let told = refused(&folder, &[&args[..6], &["--uff", "-", "--json", "-"]].concat());
    assert!(told.contains("--uff: found - beside --json -"), "{told}");
    refused(&folder, &[&args[..6], &["--reproducible"]].concat());
    let told = refused(&folder, &[&args[..6], &["--uff", "missing/out.uff"]].concat());
    assert!(told.contains("cannot write missing/out.uff"), "{told}");
}

#[test]
fn options_that_do_not_fit_are_refused() {
    let (folder, _) = modes("convert-options", "3");
    folder.write("taken", "");
    for (args, words) in [
        (&["--to", "csv", "--legacy"][..], "--legacy: found it with --to csv, expected --to uff"),
        (
            &["--to", "uff", "--surface", "8"],
            "--surface: found it with --to uff, expected --to vtu",
        ),
        (&["--to", "vtu", "--reproducible"], "--reproducible: found it with --to vtu"),
        (&["--to", "vtu", "--surface", "2"], "2 is not in 3..=360"),
        (&["--to", "npz", "--out", "-"], "a file: an archive is not text"),
        (&["--to", "csv", "--out", "a.pvd"], "found a .pvd file with --to csv"),
        (&["--to", "csv", "--out", "a.PVD"], "found a .pvd file with --to csv"),
        (&["--to", "xls"], "possible values: uff, vtu, csv, npz"),
        (&[], "--to <FORMAT>"),
        (&["--to", "csv", "--out", "bat.json"], "bat.json: found a file that this run has read"),
        (&["--to", "uff", "--out", "./bat.json"], "found a file that this run has read"),
        (&["--to", "csv", "--out", "missing/a.csv"], "cannot write missing/a.csv"),
        (&["--to", "vtu", "--out", "taken/a.pvd"], "cannot write taken/a_mode_01.vtu"),
    ] {
        let told = refused(&folder, &[&["convert", "bat.json"], args].concat());
        assert!(told.contains(words), "{told}");
    }
    assert!(
        refused(&folder, &["convert", "none.json", "--to", "csv"]).contains("cannot read none")
    );
    // The output is in this folder, wherever the modes are.
    std::fs::create_dir(folder.0.join("sub")).unwrap();
    std::fs::rename(folder.0.join("bat.json"), folder.0.join("sub/my.bat.json")).unwrap();
    folder.text(&["convert", "sub/my.bat.json", "--to", "csv"]);
    assert_eq!(folder.names(), ["my.bat.csv", "sub", "taken"]);
}

#[test]
fn a_wrong_modes_file_is_told_with_its_place() {
    let (folder, document) = modes("convert-wrong", "3");
    let pretty = |document: &Value| format!("{document:#}");
    let text = pretty(&document);
    let line = |needle: &str| 1 + text.lines().position(|line| line.contains(needle)).unwrap();
    let with = |pointer: &str, value: Value| {
        let mut document = document.clone();
        *document.pointer_mut(pointer).unwrap() = value;
        pretty(&document)
    };
    let without = |parent: &str, key: &str| {
        let mut document = document.clone();
        document.pointer_mut(parent).unwrap().as_object_mut().unwrap().remove(key);
        pretty(&document)
    };
    let first = "/modes/0/shape";
    for (text, place, words) in [
        (
            with("/format", json!("sweetspot-modes/2")),
            format!("{}:", line("format")),
            "found \"sweetspot-modes/2\", another version of the format, expected \"sweetspot-modes/1\"",
        ),
        (
            with("/format", json!("sweetspot-bat/1")),
            "2:".into(),
            "as sweetspot modes BAT --json FILE",
        ),
        (without("", "format"), "1:1".into(), "no \"format\""),
        (without("", "bat"), "1:1".into(), "no \"bat\""),
        (without("", "modes"), "1:1".into(), "no \"modes\""),
        (with("/modes", json!([])), format!("{}:", line("\"modes\"")), "found no modes"),
        (
            with("/bat/material/density", json!(-5)),
            format!("{}:", line("\"density\"")),
            "material.density",
        ),
        (
            with("/bat/profile/interpolation", json!("cubic")),
            format!("{}:", line("interpolation")),
            "\"cubic\"",
        ),
        (
            with("/modes/0/frequency_hz", json!(null)),
            format!("{}:", line("frequency_hz")),
            "modes[0].frequency_hz: found null",
        ),
        (
            with("/modes/0/modal_mass_kg", json!(-1)),
            format!("{}:", line("modal_mass_kg")),
            "found -1, expected 0 or more",
        ),
        (
            with("/modes/0/order", json!(1.5)),
            format!("{}:", line("\"order\"")),
            "a whole number from 1",
        ),
        (
            with("/modes/1/order", json!(1)),
            String::new(),
            "modes in rising order, after 1 a higher one",
        ),
        (without("/modes/1", "nodes_m"), String::new(), "no \"nodes_m\""),
        (
            with("/modes/0/nodes_m", json!([0.1, 2])),
            String::new(),
            "modes[0].nodes_m[1]: found 2.0, expected a place on the bat",
        ),
        (without("/modes/2", "shape"), String::new(), "no \"shape\""),
        (with("/modes/0/shape/x_m", json!([])), format!("{}:", line("x_m")), "--shape-points 101"),
        (
            with("/modes/0/shape/x_m", json!([0, 0.5, 0.5])),
            String::new(),
            "x_m[2]: found 0.5, expected rising places",
        ),
        (
            with("/modes/0/shape/x_m", json!([0, 0.5, 1.5])),
            String::new(),
            "expected a place on the bat",
        ),
        (
            with("/modes/1/shape/x_m", json!([0, 0.1, 0.2])),
            String::new(),
            "the same places in every mode",
        ),
        (
            with("/modes/0/shape/deflection", json!([1, 2])),
            String::new(),
            "found 2 numbers, expected 3, one for each x_m",
        ),
        (
            with("/modes/0/shape/rotation", json!([1, 2, "x"])),
            String::new(),
            "rotation[2]: found \"x\"",
        ),
        (with(first, json!(7)), String::new(), "modes[0].shape: found 7"),
        (text[..text.len() / 2].to_owned(), String::new(), "the end of the file"),
        (String::new(), "1:1".into(), "an empty file"),
    ] {
        folder.write("wrong.json", text);
        let told = refused(&folder, &["convert", "wrong.json", "--to", "csv"]);
        let start = format!("error: wrong.json:{place}");
        assert!(told.starts_with(&start) && told.contains(words), "{start}…{words}: {told}");
    }
}

/// A later minor version may have more members.
#[test]
fn unknown_members_are_passed_over() {
    let (folder, mut document) = modes("convert-later", "3");
    folder.text(&["convert", "bat.json", "--to", "csv"]);
    document["later"] = json!({ "deep": [1, null] });
    document["modes"][0]["later"] = json!(null);
    document["modes"][0]["shape"]["later"] = json!([]);
    document["generator"] = json!(3);
    folder
        .write("later.json", format!("\u{feff}{}", format!("{document:#}").replace('\n', "\r\n")));
    folder.text(&["convert", "later.json", "--to", "csv"]);
    assert_eq!(folder.read("later.csv"), folder.read("bat.csv"));
}

/// The modes of every kind of bat are read back as written.
#[test]
fn modes_of_every_bat_are_read_back() {
    let folder = Folder::new("convert-bats");
    for entry in std::fs::read_dir(Path::new(env!("SWEETSPOT_TOP")).join("meshes")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|ending| ending != "json") {
            continue;
        }
        let path = path.to_str().unwrap();
        let args = ["modes", path, "-n", "2", "--shape-points", "nodes", "--quiet"];
        folder.text(&[&args[..], &["--json", "m.json"]].concat());
        let document: Value = serde_json::from_str(&folder.read("m.json")).unwrap();
        let table = modes_file::read(&folder.0.join("m.json")).unwrap();
        assert_eq!(table.modes.len(), 2, "{path}");
        assert_eq!(table.version, env!("CARGO_PKG_VERSION"));
        for (k, mode) in table.modes.iter().enumerate() {
            let written = &document["modes"][k];
            assert_eq!(table.x, list(&written["shape"]["x_m"]), "{path}");
            assert_eq!(mode.deflection, list(&written["shape"]["deflection"]));
            assert_eq!(mode.frequency, written["frequency_hz"]);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(6), cases: 200, ..ProptestConfig::default() })]

    #[test]
    fn a_spoilt_modes_file_is_an_error_or_modes(
        at in any::<prop::sample::Index>(),
        cut in 0usize..40,
        put in "[-0-9.eE,:\\[\\]{}\" a-z]{0,8}",
    ) {
        let mut text = SMALL.to_owned();
        let start = at.index(text.len());
        let end = (start + cut).min(text.len());
        text.replace_range(start..end, &put);
        match modes_file::from_text("m.json", &text) {
            Ok(table) => prop_assert!(table.x.len() >= 2 && !table.modes.is_empty()),
            Err(Error::Input { place, .. }) => prop_assert!(place.line >= 1),
            Err(Error::Several { shown, .. }) => {
                let placed = shown.iter().all(|one| matches!(one, Error::Input { .. }));
                prop_assert!(placed);
            }
            Err(other) => prop_assert!(false, "{other}"),
        }
    }
}

const SMALL: &str = r#"{
  "format": "sweetspot-modes/1",
  "generator": { "program": "sweetspot", "version": "0.1.0" },
  "bat": { "format": "sweetspot-bat/1", "name": "rod", "source": "made up",
    "material": { "density": 700, "youngs_modulus": 14e9 },
    "profile": { "interpolation": "linear", "x": [0, 1], "radius": [0.02, 0.03] } },
  "modes": [ { "order": 1, "frequency_hz": 100.5, "damping_ratio": 0, "modal_mass_kg": 0.2,
    "nodes_m": [0.2, 0.8],
    "shape": { "x_m": [0, 0.5, 1], "deflection": [0.9, -0.5, 1], "rotation": [-4, 0, 4] } } ]
}
"#;
