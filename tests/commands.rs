//! Every command in README.md, docs/ and the help texts does what is claimed.

use crate::common;

use std::fs;
use std::path::Path;

use common::commands::{commands, wider, words};
use common::folder::{Folder, but_shear};

/// Commands that cannot be run as they are.
const EXCEPTIONS: &[(&str, Instead, &str)] = &[
    ("trade r161", Instead::With("1 s"), "it measures for as long as it is told to"),
    ("trade dowel --u-curve", Instead::With("1 s"), "as above"),
    ("modes r161 --budget", Instead::Late, "a build with checks is slower"),
    ("modes northwestern_aluminium --budget", Instead::Late, "as above"),
    (
        "lab",
        Instead::Elsewhere,
        "the page is not in the tests' program; tests/browser/lab.py has it",
    ),
    ("new", Instead::Nothing, "it asks; tests/terminal.rs answers"),
    ("validate --summary --full", Instead::Elsewhere, "tests/documents.rs runs it and reads it"),
    ("validate --extremes", Instead::Elsewhere, "as above"),
];

enum Instead {
    /// The same with this `--budget`.
    With(&'static str),
    /// The same command, which may report that the time was too short.
    Late,
    /// Nothing, where no more words follow.
    Nothing,
    /// Nothing, as another test does.
    Elsewhere,
}

/// A folder with the files that the commands in the documents name.
fn furnished(name: &str) -> Folder {
    let folder = Folder::new(name);
    let meshes = Path::new(env!("SWEETSPOT_TOP")).join("meshes");
    fs::create_dir_all(folder.0.join("meshes")).unwrap();
    fs::create_dir_all(folder.0.join("docs")).unwrap();
    for entry in fs::read_dir(meshes).unwrap() {
        let path = entry.unwrap().path();
        fs::copy(&path, folder.0.join("meshes").join(path.file_name().unwrap())).unwrap();
    }
    // docs/studies.md describes it.
    folder.write(
        "lot.json",
        r#"{ "format": "sweetspot-study/1", "bat": "r161", "points": 16, "tol": 1e-2,
             "vary": { "bat.material.density": { "lognormal": [650, 0.04] } },
             "outputs": ["f1_hz", "mass_kg", "exit_speed_max.value"] }"#,
    );
    // docs/aim.md describes it.
    folder.write(
        "wish.json",
        r#"{ "format": "sweetspot-aim/1", "targets": [
             { "name": "inertia_pivot_kg_m2", "change": "-3 %", "within": "5 oz in2" },
             { "name": "exit_speed_max.x_m", "change": "0 mm", "within": "0.02 in" },
             { "name": "mass_kg", "at_most": "31 oz" } ],
             "rules": "mlb", "remove_only": true, "keep": [{ "from": 0, "to": "30 mm" }],
             "diameter": [{ "from": "4 in", "to": "18 in", "at_least": "24 mm" }] }"#,
    );
    // docs/tap.md describes it; a file's ending is a hint.
    let mut taps = include_bytes!("golden/taps.wav").to_vec();
    for name in ["taps.m4a", "one.m4a"] {
        folder.write(name, &taps);
    }
    // Another recording, by its last sample.
    *taps.last_mut().unwrap() ^= 1;
    folder.write("two.m4a", taps);
    // docs/wood.md describes them.
    folder.write("readings.json", include_str!("golden/readings-1.json"));
    let bats = r#"{ "format": "sweetspot-scatter/1", "density": { "lognormal": "4 %" }, "tol": 1e-2,
        "impact": { "normal": "0.5 in" }, "outputs": ["f1_hz", "exit_speed_m_s@impact"] }"#;
    folder.write("bats.json", bats);
    // docs/hit.md describes it.
    folder.write("push.csv", "t_ms,force_n\n0,0\n0.5,2000\n1,0\n");
    folder
}

/// How a command is another one here.
fn exception(command: &str) -> Option<&'static Instead> {
    let begins = |shown: &&(&str, Instead, &str)| {
        command == shown.0 || command.starts_with(&format!("{} ", shown.0))
    };
    EXCEPTIONS.iter().find(begins).map(|(_, instead, _)| instead)
}

/// The words to run, with a `--budget` where the command would use all of its time.
fn taken(command: &str) -> Option<Vec<String>> {
    let mut words = words(command);
    match exception(command) {
        Some(Instead::Nothing) if words.len() == 1 => return None,
        Some(Instead::Elsewhere) => return None,
        Some(Instead::With(time)) if !words.contains(&"--budget".to_owned()) => {
            words.extend(["--budget".to_owned(), (*time).to_owned()]);
        }
        _ => {}
    }
    Some(words)
}

/// Runs them in order. Each must succeed silently and print no line beyond column 80, except in JSON, CSV, Markdown and
/// formats of other programs.
fn all_succeed(folder: &Folder, commands: &[String]) {
    let mut faults = Vec::new();
    for command in commands {
        let Some(words) = taken(command) else { continue };
        let args: Vec<&str> = words.iter().map(String::as_str).collect();
        let output = folder.run(&args);
        let told = but_shear(&String::from_utf8_lossy(&output.stderr));
        let late = matches!(exception(command), Some(Instead::Late))
            && output.status.code() == Some(3)
            && told.starts_with("budget not kept");
        if !late && (output.status.code() != Some(0) || !told.is_empty()) {
            faults.push(format!("{command}: {:?} {told}", output.status.code()));
        }
        let for_people = !args.contains(&"-")
            && !["man", "completions", "schema", "licences"].contains(&args[0]);
        if for_people && !args.contains(&"--help") {
            let wide = wider(&String::from_utf8_lossy(&output.stdout), 80);
            faults.extend(wide.iter().map(|line| format!("{command}: {line}")));
        }
    }
    assert!(faults.is_empty(), "{faults:#?}");
}

/// The commands of the README and the documents, each once.
fn of_documents() -> Vec<String> {
    let root = Path::new(env!("SWEETSPOT_TOP"));
    let documents = fs::read_dir(root.join("docs")).unwrap().map(|entry| entry.unwrap().path());
    let pages = documents.filter(|path| path.extension().is_some_and(|end| end == "md"));
    let mut pages: Vec<_> = pages.collect();
    pages.sort();
    // A page uses files that the README or its own commands above made.
    pages.insert(0, root.join("README.md"));
    let mut shown = Vec::new();
    for page in &pages {
        shown.extend(commands(&fs::read_to_string(page).unwrap(), 4));
    }
    let mut seen = std::collections::BTreeSet::new();
    shown.retain(|command| seen.insert(command.clone()));
    shown
}

#[test]
fn every_command_of_the_readme_and_the_documents_runs() {
    let folder = furnished("readme");
    let shown = of_documents();
    assert!(shown.len() > 30, "{shown:#?}");
    for verb in
        ["analyze", "bbcor", "compare", "convert", "frf", "hit", "lathe", "modes", "ring", "trade"]
    {
        assert!(shown.iter().any(|command| words(command)[0] == verb), "{verb}");
    }
    all_succeed(&folder, &shown);
}

#[test]
fn every_example_of_the_help_runs_and_no_help_is_wider_than_a_terminal() {
    let folder = furnished("help");
    let top = folder.text(&["--help"]);
    let verbs = top.lines().skip_while(|line| *line != "Describe a bat:");
    let verbs = verbs.take_while(|line| *line != "Options:");
    let verbs = verbs.filter_map(|line| line.strip_prefix("  ")?.split_whitespace().next());
    let mut shown = commands(&top, 2);
    let mut faults = Vec::new();
    let mut count = 0;
    for verb in verbs {
        count += 1;
        for help in ["-h", "--help"] {
            let text = folder.text(&[verb, help]);
            faults.extend(wider(&text, 80));
            // All commands, from the first.
            faults.extend(commands(&text, 0));
            if help == "--help" {
                let examples = commands(&text, 2);
                if !text.contains("Examples:") || examples.is_empty() {
                    faults.push(format!("{verb} has no examples"));
                }
                shown.extend(examples);
            }
        }
    }
    assert!(faults.is_empty() && shown.len() > 25 && count == 27, "{faults:#?}\n{shown:#?}");
    // What stands in the documents too is run from there, unless it makes a file for the next one.
    let known = of_documents();
    let makes = |command: &String| ["--out", "--uff"].iter().any(|word| command.contains(word));
    shown.retain(|command| makes(command) || !known.contains(command));
    all_succeed(&folder, &shown);
}

#[test]
fn words_are_taken_apart_as_by_a_shell() {
    let text =
        "    sweetspot hit b.json --pitch \"85 mph\" \\\n      --at 1 > out\n  sweetspot no\n";
    let found = commands(text, 4);
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(words(&found[0]), ["hit", "b.json", "--pitch", "85 mph", "--at", "1"]);
}

/// A bat of ash with the stations in that unit, with that many units per inch.
fn counted_in(unit: &str, per_inch: f64) -> String {
    let of = |all: [f64; 7]| all.map(|value| (value * per_inch).to_string()).join(", ");
    let x = of([0.0, 0.5, 1.0, 12.0, 22.0, 30.0, 33.0]);
    let diameter = of([1.9, 1.9, 1.0, 1.0, 1.9, 2.5, 2.4]);
    format!(
        r#"{{ "format": "sweetspot-bat/1", "name": "Ash 33", "material": "white-ash",
             "profile": {{ "unit": "{unit}", "x": [{x}], "diameter": [{diameter}] }} }}"#
    )
}

#[test]
fn a_bat_is_answered_in_the_units_of_its_file_first_by_every_verb() {
    let folder = Folder::new("units_first");
    folder.write("inch.json", counted_in("in", 1.0));
    folder.write("metric.json", counted_in("mm", 25.4));
    for (args, us, si) in [
        (&["modes", "BAT", "-n", "2"][..], "33.00 in", "83.82 cm"),
        (&["analyze", "BAT"], " mph", " m/s"),
        (&["analyze", "BAT", "--full"], "33.00 in", "83.82 cm"),
        (&["hit", "BAT", "--points", "3"], "2.50 in", "6.35 cm"),
        (&["bbcor", "BAT"], "6.00 in", "15.24 cm"),
        (&["compare", "BAT", "r161"], "2.50 in", "6.35 cm"),
        (&["compare", "BAT", "r161", "--full"], "2.50 in", "6.35 cm"),
        (&["ring", "BAT", "--hit", "0.7"], "27.56 in", "70.00 cm"),
        (&["advise", "BAT", "--full"], " oz in²", " kg m²"),
        (&["lathe", "BAT"], "2.50 in", "6.35 cm"),
        (&["frf", "BAT", "--at", "0.1", "--points", "3"], "3.94 in", "10.00 cm"),
    ] {
        for (file, us_first) in [("inch.json", true), ("metric.json", false)] {
            let args: Vec<&str> =
                args.iter().map(|word| if *word == "BAT" { file } else { *word }).collect();
            let text = folder.text(&args);
            let [us, si] = [us, si].map(|unit| text.find(unit).unwrap_or(usize::MAX));
            assert_eq!(us < si, us_first, "{args:?}\n{text}");
        }
    }
}

#[test]
fn a_tip_is_within_two_letters_or_there_is_none() {
    let folder = Folder::new("tips");
    let said = |args: &[&str]| {
        let output = folder.run(args);
        assert_eq!(output.status.code(), Some(2), "{args:?}");
        String::from_utf8_lossy(&output.stderr).into_owned()
    };
    for args in
        [&["maple"][..], &["conversation"], &["modes", "r161", "--modelling"], &["hut-of-wood"]]
    {
        let told = said(args);
        assert!(!told.contains("similar") && !told.contains("did you mean"), "{told}");
    }
    for (args, near) in [
        (&["compar", "r161"][..], "'compare'"),
        (&["mdoes", "r161"], "'modes'"),
        (&["hit", "r161", "--ptich", "90 mph"], "'--pitch'"),
        (&["hit", "r161", "--model", "contcat"], "'contact'"),
        (&["hit", "r116"], "r161"),
        (&["hit", "r161", "--wood", "maple"], "sugar-maple"),
    ] {
        let told = said(args);
        assert!(told.contains(near), "{told}");
    }
}
