//! Every malformed file and command line is answered by clear messages about nothing else, and exit
//! code 2.

use crate::common;

use std::fs;

use common::diagnostic::in_lines;
use common::diagnostic::{Diagnostic, ERROR, diagnostics};
use common::folder::{Folder, but_shear};
use serde_json::Value;

impl Folder {
    /// What is wrong with the answer to wrong input: silence, a panic, half a result, other words.
    /// Every diagnostic must have some of these words, and all words must be there.
    fn misanswer(&self, args: &[&str], says: &[&str]) -> Option<String> {
        let before = self.names();
        let output = self.run(args);
        let all = String::from_utf8_lossy(&output.stderr).into_owned();
        // For programs, with --json, the same again on the last line.
        let (told, again) = match all.trim_end().rsplit_once('\n') {
            Some((told, last)) if last.starts_with(ERROR) => (format!("{told}\n"), Some(last)),
            _ => (all.clone(), None),
        };
        let (each, summary) = diagnostics(&told);
        let again = again.map(|line| serde_json::from_str::<Value>(line).unwrap());
        let asked = args.contains(&"--json");
        let lines: Vec<String> = each.iter().map(Diagnostic::one_line).collect();
        let message = lines.join("\n");
        let missing: Vec<_> = says.iter().filter(|words| !message.contains(**words)).collect();
        let idle = |line: &&String| !says.iter().any(|words| line.contains(words));
        let count = format!("{} mistakes in ", each.len());
        let fault = match () {
            () if output.status.code() != Some(2) => format!("ended with {}", output.status),
            () if !told.starts_with("error: ") => "does not begin with \"error:\"".to_owned(),
            () if all.chars().any(|c| c.is_control() && c != '\n') => "controls in JSON".to_owned(),
            () if asked != again.is_some() => "is not told to programs, or to people".to_owned(),
            () if again.is_some_and(|file| counted(&file) != Some(each.len())) => {
                "is told otherwise to programs".to_owned()
            }
            () if (each.len() > 1) != summary.is_some() => "is not counted".to_owned(),
            () if summary.as_ref().is_some_and(|said| !said.starts_with(&count)) => {
                format!("is counted {summary:?}")
            }
            () if lines.iter().any(|line| line.contains("error:")) => "errs twice".to_owned(),
            () if message.contains("panicked") => "is a panic".to_owned(),
            () if told.chars().any(|c| c.is_control() && c != '\n') => "controls".to_owned(),
            () if message.contains("NaN ") || message.contains("inf ") => {
                "shows no number".to_owned()
            }
            () if told.len() > 2000 * each.len() => format!("is {} bytes long", told.len()),
            () if !missing.is_empty() => format!("lacks {missing:?}"),
            () if lines.iter().any(|line| idle(&line)) => {
                format!("says besides {:?}", lines.iter().find(idle))
            }
            () if !output.stdout.is_empty() => "comes with output".to_owned(),
            () if self.names() != before => format!("leaves {:?}", self.names()),
            () => each.iter().find_map(|one| one.misplaced(&self.0))?,
        };
        Some(format!("{args:?}: {fault}\n    {told}"))
    }
}

/// How many mistakes an error for programs has, each with a sentence.
fn counted(file: &Value) -> Option<usize> {
    let mistakes = file["mistakes"].as_array()?;
    mistakes.iter().all(|one| one["found"].is_string()).then_some(mistakes.len())
}

fn assert_none(faults: Vec<String>) {
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

/// A good bat.
const BAT: &str = r#"{
  "format": "sweetspot-bat/1",
  "name": "dowel",
  "material": { "density": 700, "youngs_modulus": 14e9 },
  "profile": {
    "x": [0, 0.4, 0.8],
    "radius": [0.02, 0.03, 0.02]
  }
}
"#;

const MATERIAL: &str = r#"{ "density": 700, "youngs_modulus": 14e9 }"#;
const PROFILE: &str = r#"{
    "x": [0, 0.4, 0.8],
    "radius": [0.02, 0.03, 0.02]
  }"#;
const X: &str = "[0, 0.4, 0.8]";
const RADIUS: &str = r#""radius": [0.02, 0.03, 0.02]"#;

/// The table of mistakes, one value in each line. The first value names parts of the good bat. An object begins a
/// section: a command to `run` in a folder with the good bat and the `files` of the section. Each list after it is a
/// case. In a section with a `file`, a case begins with a part of the `good` text of that file (the `at` of the section,
/// or a text or the name of a part in the case) and its replacement; in other sections it begins with the command line.
/// The words of the answer follow.
const TABLE: &str = include_str!("bad_input.jsonl");

#[test]
fn every_mistake_of_the_table_is_answered() {
    let lines: Vec<Value> = TABLE.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let sections = lines[1..].chunk_by(|_, next| !next.is_object());
    let faults = std::thread::scope(|scope| {
        let parts = &lines[0]["parts"];
        let faults = |section| scope.spawn(move || faults_of(section, parts));
        let runs: Vec<_> = sections.map(faults).collect();
        runs.into_iter().flat_map(|run| run.join().unwrap()).collect()
    });
    assert_none(faults);
}

fn faults_of(section: &[Value], parts: &Value) -> Vec<String> {
    let texts = |list: &[Value]| -> Vec<String> {
        list.iter().map(|text| text.as_str().unwrap().to_owned()).collect()
    };
    let (head, cases) = section.split_first().unwrap();
    let folder = Folder::new("table");
    folder.write("bat.json", BAT);
    for (name, text) in head["files"].as_object().into_iter().flatten() {
        folder.write(name, text.as_str().unwrap());
    }
    let good = head["good"].as_str().unwrap_or(BAT);
    let mut faults = vec![];
    for case in cases {
        let row = case.as_array().unwrap();
        let (run, says) = match (head["file"].as_str(), head["at"].as_str()) {
            (None, _) => (row[0].as_array().unwrap(), &row[1..]),
            (Some(file), at) => {
                let (at, row) = at.map_or((row[0].as_str().unwrap(), &row[1..]), |at| (at, row));
                let at = parts[at].as_str().unwrap_or(at);
                assert_eq!(good.matches(at).count(), 1, "{case}");
                folder.write(file, good.replace(at, row[0].as_str().unwrap()));
                (head["run"].as_array().unwrap(), &row[1..])
            }
        };
        let (run, says) = (texts(run), texts(says));
        let both = [&run, &says].map(|list| list.iter().map(String::as_str).collect::<Vec<_>>());
        let fault = folder.misanswer(&both[0], &both[1]);
        faults.extend(fault.map(|fault| format!("{case}\n  {fault}")));
    }
    faults
}

#[test]
fn a_file_that_is_not_a_bat_file_is_refused() {
    let folder = Folder::new("files");
    let says = |args: &[&str], says: &[&str]| folder.misanswer(args, says);
    fs::create_dir(folder.0.join("folder")).unwrap();
    let texts: &[(&str, &[u8], &[&str])] = &[
        ("empty", b"", &["bat.json:1:1", "an empty file", "JSON object"]),
        ("blank", b" \r\n\t", &["bat.json:1:1", "an empty file"]),
        ("mark only", b"\xef\xbb\xbf", &["bat.json:1:1", "an empty file"]),
        ("binary", b"\x7fELF\x02\x01\x01\0\0\0", &["bat.json:1:1", "text that is not JSON"]),
        ("zeros", &[0; 64], &["bat.json:1:1", "text that is not JSON"]),
        ("invalid UTF-8", b"{\n \"a\": \"\xff\"}", &["bat.json:2:8", "not text", "UTF-8"]),
        ("overlong", b"{ \"a\": \"\xc0\xaf\"}", &["bat.json:1:9", "not text", "UTF-8"]),
        ("UTF-16", b"\xff\xfe{\0}\0", &["bat.json:1:1", "no \"format\""]),
        ("half a sign", b"\xff\xfe{\0}\0}", &["bat.json:1:1", "not UTF-16 text", "UTF-8"]),
        ("UTF-16 without a mark", b"{\0}\0", &["bat.json:1:2", "expected"]),
        ("not JSON", b"x,radius\n0,0.02\n", &["bat.json:1:1", "text that is not JSON", "`{`"]),
        ("truncated", &BAT.as_bytes()[..60], &["bat.json:", "the end of the file", "the rest"]),
        ("unclosed", b"{\n", &["bat.json:1:2", "the end of the file", "the rest of an object"]),
        ("two", b"{} {}", &["bat.json:1:4", "found {", "expected the end of the file"]),
        ("tab", b"{\"name\": \"a\tb\"}", &["bat.json:1:12", "found a tab in a text", "\\t"]),
        ("line", b"{\"name\": \"ab\n\"}", &["bat.json:1:13", "a line break in a text", "\\n"]),
        ("comma", b"{\n \"a\": 1,,\n}", &["bat.json:2:9", "JSON"]),
        ("after an accent", "{ \"é\": é }".as_bytes(), &["bat.json:1:8", "found é"]),
        ("a list", b"[1, 2]", &["bat.json:1:1", "found a list", "an object"]),
        ("null", b"null", &["bat.json:1:1", "found null", "an object"]),
        ("a number", b"  7", &["bat.json:1:3", "found 7", "an object"]),
        ("half a character", b"{ \"\\ud800\": 1 }", &["bat.json:1:1", "hex escape"]),
        (
            "control characters",
            b"{ \"\\u001b[2J\\n\\u0000\": 1 }",
            &["unknown key", "one of", "no \"format\"", "no \"material\"", "no \"profile\""],
        ),
    ];
    let mut faults = Vec::new();
    for (name, text, words) in texts {
        folder.write("bat.json", text);
        faults.extend(says(&["modes", "bat.json"], words).map(|f| format!("{name}: {f}")));
    }
    for deep in ["[".repeat(1_000_000), "{\"a\":".repeat(1_000_000)] {
        folder.write("bat.json", deep);
        faults.extend(says(&["modes", "bat.json"], &["bat.json:1:", "the end of the file"]));
    }
    let closed = format!("{{\"name\": {}{}}}", "[".repeat(500_000), "]".repeat(500_000));
    folder.write("bat.json", closed);
    faults.extend(says(&["modes", "bat.json"], &["bat.json:1:1", "no \"format\""]));
    folder.write("bat.json", format!("{{\"{}\": 1}}", "ключ".repeat(250_000)));
    faults.extend(says(&["modes", "bat.json"], &["bat.json:1:", "unknown key \"ключ"]));
    faults.extend(says(&["modes", "folder"], &["cannot read folder"]));
    faults.extend(says(&["modes", "missing.json"], &["cannot read missing.json", "No such file"]));
    faults.extend(says(&["modes", "missing/bat.json"], &["cannot read missing/bat.json"]));
    faults.extend(says(&["modes", ""], &["a value is required", "<BAT>"]));
    assert_none(faults);
}

#[test]
fn mistakes_that_fill_no_line_of_the_table_are_answered() {
    let folder = Folder::new("more");
    let mut faults = Vec::new();
    for deep in ["(", "-", "2**", "sin(", "1+"] {
        for (times, said) in [(1000, "formula"), (1_000_000, "characters, expected 10000 at most")]
        {
            let formula = deep.repeat(times);
            let profile =
                format!(r#"{{ "pieces": [{{ "from": 0, "to": 1, "formula": "{formula}" }}] }}"#);
            folder.write("bat.json", BAT.replace(PROFILE, &profile));
            faults.extend(folder.misanswer(&["modes", "bat.json"], &["bat.json:5:", said]));
        }
    }
    folder.write("bat.json", BAT.replace(PROFILE, r#"{ "csv": "table.csv" }"#));
    folder.write("table.csv", b"x,radius\n0,1\n1,\xff\n");
    // A table that is not UTF-8 is read in the code page of western spreadsheets.
    let said = in_lines(&folder.run(&["modes", "bat.json"]).stderr);
    let found = said.contains("table.csv:3:3: radius: found \"ÿ\"") && said.contains("finite");
    assert!(found, "{said}");
    folder.write("table.csv", b"x,radius\n0,1\n1,\xff\0\n");
    let says = ["table.csv:3:3", "not text", "UTF-8"];
    faults.extend(folder.misanswer(&["modes", "bat.json"], &says));
    folder.write("bat.json", BAT);
    if cfg!(not(feature = "arpack")) {
        let says = ["not in this build", "--features arpack"];
        faults.extend(folder.misanswer(&["modes", "bat.json", "--solver", "arpack"], &says));
    }
    assert_none(faults);
    assert_eq!(folder.run(&[]).status.code(), Some(2));
    for help in ["--help", "--version", "help"] {
        assert_eq!(folder.run(&[help]).status.code(), Some(0), "{help}");
    }
}

#[cfg(unix)]
#[test]
fn an_argument_that_is_not_text_is_no_panic() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let odd = OsStr::from_bytes(b"b\xfft.json");
    let folder = Folder::new("arguments");
    let run = |args: &[&OsStr]| folder.command(&[]).args(args).output().unwrap();
    for args in [&[odd][..], &["modes".as_ref(), odd], &["modes".as_ref(), "--tol".as_ref(), odd]] {
        let output = run(args);
        let told = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.code() == Some(2) && told.starts_with("error: "), "{told}");
    }
    fs::write(folder.0.join(odd), BAT).unwrap();
    assert_eq!(run(&["modes".as_ref(), odd]).status.code(), Some(0));
    folder.write("a\u{1b}[2J\nb.json", "{");
    let output = run(&["modes".as_ref(), "a\u{1b}[2J\nb.json".as_ref()]);
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(
        told.starts_with("error: ") && told.chars().all(|c| !c.is_control() || c == '\n'),
        "{told}"
    );
}

/// Runs that must succeed: exit code 0 and JSON without null frequencies or overflow.
fn accepted(folder: &Folder, args: &[&str]) -> (Value, String) {
    let output = folder.run(args);
    let told = but_shear(&String::from_utf8(output.stderr).unwrap());
    assert_eq!(output.status.code(), Some(0), "{args:?}: {told}");
    let text = String::from_utf8(output.stdout).unwrap();
    (serde_json::from_str(&text).unwrap_or_else(|e| panic!("{args:?}: {e}\n{text}")), told)
}

fn frequencies(document: &Value) -> Vec<f64> {
    let modes = document["modes"].as_array().unwrap();
    modes.iter().map(|mode| mode["frequency_hz"].as_f64().expect("a number")).collect()
}

#[test]
fn unusual_but_right_files_are_read() {
    let folder = Folder::new("accepted");
    folder.write("bat.json", BAT);
    let run = ["modes", "bat.json", "-n", "3", "--shape-points", "0", "--json", "-"];
    let plain = frequencies(&accepted(&folder, &run).0);
    let same = |text: &str| {
        folder.write("bat.json", text);
        let (document, told) = accepted(&folder, &run);
        assert_eq!(told, "", "{text}");
        for (a, b) in frequencies(&document).iter().zip(&plain) {
            // Other units round the radii differently.
            assert!((a / b - 1.0).abs() < 1e-13, "{text}: {a} {b}");
        }
        document
    };
    same(&format!("\u{feff}{BAT}"));
    same(&BAT.replace('\n', "\r\n"));
    same(&format!("\u{feff}{}\r\n\r\n", BAT.replace('\n', "\r")));
    let named = same(&BAT.replace("dowel", "黒バット 🏏 \\u00e9 \\ud83c\\udfcf \\\" \\n \u{202e}"));
    assert_eq!(named["bat"]["name"], "黒バット 🏏 é 🏏 \" \n \u{202e}");
    same(&BAT.replace(X, "[\"0 m\", \"40 cm\", \"800 mm\"]"));
    same(
        &BAT.replace(X, "[0, \"0.4 m\", 800], \"unit\": \"mm\"")
            .replace(RADIUS, r#""diameter": [40, "6 cm", "0.04 m"]"#),
    );
    same(&BAT.replace("700", "\"0.7 g/cm³\"").replace("14e9", "\" 14 GPa \""));
    same(&BAT.replace(X, "[0, 0.4, 0.8], \"measured_from\": \"tip\""));
    same(&BAT.replace(RADIUS, "\"radius\": [0.02, 0.03, 0.02], \"inner_radius\": [0, 0, 0]"));
    folder.write(
        "t.csv",
        "\u{feff}# from a drawing\r\nx_cm,diameter_mm\r\n0,40\r\n40,60\r\n80,40\r\n",
    );
    same(&BAT.replace(PROFILE, r#"{ "csv": "t.csv" }"#));

    folder.write("bat.json", BAT.replace(RADIUS, "\"radius\": [0.02, 0.03, 0]"));
    assert!(frequencies(&accepted(&folder, &run).0).iter().all(|f| *f > 0.0));
    folder.write("bat.json", BAT.replace(RADIUS, "\"radius\": [0, 0.03, 0]"));
    assert!(frequencies(&accepted(&folder, &run).0).iter().all(|f| *f > 0.0));

    let taper = BAT.replace(RADIUS, "\"radius\": [0.01, 0.02, 0.03]");
    let turned =
        taper.replace("[0.01, 0.02, 0.03]", "[0.03, 0.02, 0.01], \"measured_from\": \"tip\"");
    let summary = |text: &str| {
        folder.write("bat.json", text);
        accepted(&folder, &run).0["summary"]["balance_point_m"].as_f64().unwrap()
    };
    assert!((summary(&taper) - summary(&turned)).abs() < 1e-15);
}

/// A rod, so that its halves have their centres at 0.2 and 0.6 m.
#[test]
fn what_is_on_a_bat_is_in_its_mass_balance_and_inertia() {
    let folder = Folder::new("on the bat");
    let rod = BAT.replace(RADIUS, r#""radius": [0.02, 0.02, 0.02]"#);
    let body = |text: &str| {
        folder.write("bat.json", text);
        let run = ["modes", "bat.json", "--modes", "0", "--json", "-"];
        let (document, told) = accepted(&folder, &run);
        // A remark is caused only by a weighed mass that differs much from the mass by the densities in the file.
        let told_of =
            ["\"mass\": \"1 kg\", \"balance_point\"", "\"weighed\": { \"mass\": 1 }, \"regions\""];
        let far = text.contains("\"density\": 700") && told_of.iter().any(|of| text.contains(of));
        assert_eq!(told.contains("to weigh so much it must have"), far, "{text}: {told}");
        assert!(far || told.is_empty(), "{text}: {told}");
        folder.write("again.json", document["bat"].to_string());
        let run = ["modes", "again.json", "--modes", "0", "--json", "-"];
        let again = accepted(&folder, &run).0;
        let number = |document: &Value, key: &str| document["summary"][key].as_f64().unwrap();
        ["mass_kg", "balance_point_m", "inertia_balance_kg_m2"].map(|key| {
            let value = number(&document, key);
            assert!((number(&again, key) / value - 1.0).abs() < 1e-14, "{text}: {key}");
            value
        })
    };
    let with = |more: &str| body(&rod.replace("\"dowel\"", &format!("\"\", {more}")));
    let is = |found: [f64; 3], expected: [f64; 3]| {
        for (a, b) in found.iter().zip(expected) {
            assert!((a / b - 1.0).abs() < 1e-14, "{found:?} {expected:?}");
        }
    };
    let [mass, _, inertia] = body(&rod);
    is([mass, 0.4, inertia], body(&rod));
    // A weight moves the balance point by m d / (M + m).
    let (m, d) = (0.1, 0.35);
    let sum = mass + m;
    let heavier = [sum, 0.4 + m * d / sum, inertia + mass * m / sum * d * d + 1e-4];
    for weight in [
        r#"{ "x": 0.7, "mass": 0.1, "offset": 0.05, "rotary_inertia": 1e-4 }"#,
        r#"{ "x": "80 cm", "mass": "100 g", "offset": "-50 mm", "rotary_inertia": "1 kg cm^2" }"#,
        r#"{ "x": 0.75, "mass": 0.1 }, { "x": 0.1, "rotary_inertia": 1e-4 }"#,
    ] {
        is(with(&format!("\"attachments\": [{weight}]")), heavier);
    }
    for spring in [r#""frequency": "170 Hz""#, r#""stiffness": 1e4, "damping": "2 N s/m""#] {
        let hung = format!(r#""absorbers": [{{ "x": 0.75, "mass": 0.1, {spring} }}]"#);
        is(with(&hung), [heavier[0], heavier[1], heavier[2] - 1e-4]);
    }
    // A scale weighs both; the inertia of the wood is proportional to its mass.
    let weighed = r#""weighed": { "mass": "1 kg", "balance_point": 0.435, "first_bending_hz": 300 },
        "attachments": [{ "x": 0.75, "mass": 0.1 }]"#;
    is(with(weighed), [1.0, 0.4 + m * d, inertia * 0.9 / mass + 0.9 * m * d * d]);
    let unknown = rod.replace("\"density\": 700, ", "").replace("\"dowel\"", "\"\", WEIGHED");
    is(body(&unknown.replace("WEIGHED", weighed)), with(weighed));
    // Springs, supports and hands weigh nothing.
    for massless in [
        r#""attachments": [{ "x": 0.1, "stiffness": "10 lbf/in", "rotational_stiffness": "5 N m" }]"#,
        r#""joints": [{ "x": 0.3, "rotational_stiffness": "1000 ft lbf/rad" }]"#,
        r#""supports": [{ "x": 0, "type": "clamped" }, { "x": "0.8 m", "type": "pinned" }]"#,
        r#""grip": { "from": 0, "to": "8 in", "stiffness": "50 psi", "damping": "100 N s/m^2" }"#,
        r#""regions": [{ "from": 0.1, "to": 0.3, "material": {
            "density": "0.7 g/cm^3", "youngs_modulus": "10 GPa" } }]"#,
    ] {
        is(with(massless), [mass, 0.4, inertia]);
    }
    // The barrel half of three times the density.
    let region = r#"{ "from": 0.4, "to": "80 cm", "material": {
        "density": 2100, "youngs_modulus": 14e9 } }"#;
    let heavy = with(&format!("\"regions\": [{region}]"));
    is([heavy[0], heavy[1], 1.0], [2.0 * mass, 0.25 * 0.2 + 0.75 * 0.6, 1.0]);
    let weighed = with(&format!("\"weighed\": {{ \"mass\": 1 }}, \"regions\": [{region}]"));
    is(weighed, [1.0, heavy[1], heavy[2] / heavy[0]]);
    // A core of the bat's own material makes it solid again.
    let core = format!("\"\", \"regions\": [{{ \"from\": 0, \"to\": 0.8, \"core\": {MATERIAL} }}]");
    let hollow = rod.replace(X, "[0, 0.4, 0.8], \"inner_radius\": [0.01, 0.015, 0.01]");
    is(body(&hollow.replace("\"dowel\"", &core)), [mass, 0.4, inertia]);
}

#[test]
fn unusual_but_right_options_are_taken() {
    let folder = Folder::new("taken");
    folder.write("bat.json", BAT);
    let (none, _) = accepted(&folder, &["modes", "bat.json", "--modes", "0", "--json", "-"]);
    assert_eq!(none["modes"].as_array().unwrap().len(), 0);
    let (fine, _) = accepted(&folder, &["modes", "bat.json", "--tol", "1e-9", "--json", "-"]);
    let two = ["analyze", "bat.json", "-n", "2", "--elements", "2", "--json", "-"];
    let (coarse, told) = accepted(&folder, &two);
    let coarse = frequencies(&coarse["modes"]);
    assert_eq!((coarse.len(), told.as_str()), (2, ""));
    // A theory with fewer ways to deform is stiffer.
    assert!(coarse.iter().zip(frequencies(&fine)).all(|(coarse, fine)| *coarse > fine));
    let hit = |more: &[&str]| {
        let args = [&["hit", "bat.json", "--json", "-"][..], more].concat();
        let (document, told) = accepted(&folder, &args);
        assert_eq!(told, "", "{more:?}");
        document
    };
    assert_eq!(hit(&["--modes", "0"])["impacts"].as_array().unwrap().len(), 101);
    assert_eq!(hit(&["--swing-speed", "0 rad/s"])["scene"]["swing_rad_s"], 0.0);
    assert_eq!(
        hit(&["--swing-speed", "-5 rad/s", "--pitch", "90 mph"])["scene"]["swing_rad_s"],
        -5.0
    );
    let usual = sweetspot::collision::Scene::default();
    let scene = hit(&[])["scene"].clone();
    let defaults = [usual.swing, usual.ball_speed, usual.pivot, usual.hands];
    for (name, default) in
        ["swing_rad_s", "ball_speed_m_s", "bat_pivot_m", "hands_m"].into_iter().zip(defaults)
    {
        assert!((scene[name].as_f64().unwrap() / default - 1.0).abs() < 1e-14, "{name}");
    }
    for (more, radius) in [
        (&[][..], 0.8 - 6.0 * 0.0254 + 0.0635),
        (&["--bat-speed-at", "4 in"], 0.8 - 4.0 * 0.0254 + 0.0635),
        (&["--pivot", "-0.1 m"], 0.8 - 6.0 * 0.0254 - 0.1),
    ] {
        let swing = &hit(&[&["--bat-speed", "31 m/s"], more].concat())["scene"]["swing_rad_s"];
        assert!((swing.as_f64().unwrap() * radius / 31.0 - 1.0).abs() < 1e-14, "{more:?}");
    }
    assert_eq!(hit(&["--cor", "1"])["scene"]["cor"], 1.0);
    // A ball without restitution stays on the bat and may be hit again and again: values that do not reach the
    // tolerance are named. For many places even fewer would reach it, because the work is bounded.
    let dead = ["hit", "bat.json", "--json", "-", "--cor", "0", "--points", "9"];
    let dead = folder.run(&dead);
    let told = String::from_utf8(dead.stderr).unwrap();
    let document: Value = serde_json::from_slice(&dead.stdout).unwrap();
    let known = |impact: &Value| {
        let error = impact["error"]["exit_speed"].as_f64();
        impact["exit_speed_m_s"].is_f64() && error.is_some_and(|error| error < 0.1)
    };
    assert!(document["impacts"].as_array().unwrap().iter().all(known), "{document}");
    match dead.status.code() {
        Some(0) => assert_eq!(told, ""),
        code => assert!(code == Some(3) && told.contains("the worst is known to"), "{told}"),
    }
    assert_eq!(hit(&["--pivot", "-0.09 m"])["scene"]["bat_pivot_m"], -0.09);
    assert_eq!(hit(&["--pitch", "0"])["scene"]["ball_speed_m_s"], 0.0);
    let still = hit(&["--pitch", "0", "--swing-speed", "0"]);
    assert!(still["impacts"][0]["exit_speed_m_s"].is_null());
    assert_eq!(hit(&["--points", "1"])["impacts"][0]["x_m"], 0.4);
    assert_eq!(hit(&["--points", "2"])["impacts"][1]["x_m"], 0.8);
    assert_eq!(hit(&["--from", "0.6", "--to", "0.6", "--points", "3"])["impacts"][2]["x_m"], 0.6);
    assert_eq!(hit(&["--at", "0"])["impacts"][0]["x_m"], 0.0);
    assert_eq!(hit(&["--at", "0.8"])["impacts"][0]["from_tip_m"], 0.0);
    folder.write("ball.json", "\u{feff}{ \"format\": \"sweetspot-ball/1\", \"mass\": 0.145,\r\n\"radius\": 0.0366, \"cor\": 0 }");
    assert_eq!(hit(&["--ball", "ball.json", "--model", "rigid"])["scene"]["ball"]["cor"], 0.0);
}

/// A run that does not reach the requested accuracy: exit code 3, one line with the reason, and an answer.
fn falls_short(folder: &Folder, args: &[&str], says: &[&str]) -> Value {
    let output = folder.run(&[args, &["--json", "-"]].concat());
    let told = but_shear(&String::from_utf8(output.stderr).unwrap());
    assert_eq!(output.status.code(), Some(3), "{args:?}: {told}");
    assert!(told.lines().count() == 1 && says.iter().all(|words| told.contains(words)), "{told}");
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn an_answer_that_falls_short_is_given_with_the_reason() {
    let folder = Folder::new("short");
    folder.write("bat.json", BAT);
    let rising = |document: &Value, count: usize| {
        let found = frequencies(document);
        assert!(found.len() == count && found[0] > 0.0 && found.is_sorted_by(|a, b| a < b));
        assert_eq!(document["model"]["tolerance_met"], false);
        assert_eq!(document["model"]["no_mode_missing"], true);
    };
    for tolerance in ["1e-17", "1e-300", "5e-324"] {
        let says = [&format!("accuracy not reached: asked {tolerance},"), "round-off alone is"];
        let modes = falls_short(&folder, &["modes", "bat.json", "--tol", tolerance], &says);
        rising(&modes, 10);
        let says = ["accuracy of the exit speeds not reached"];
        let hit = falls_short(&folder, &["hit", "bat.json", "--tol", tolerance], &says);
        assert!(hit["impacts"][0]["exit_speed_m_s"].is_f64(), "{hit}");
    }
    let many = ["modes", "bat.json", "--modes", "400", "--shape-points", "0", "--budget", "1 us"];
    let says = ["budget not kept: asked 1µs", "the first digit took", "1µs were allowed"];
    rising(&falls_short(&folder, &many, &says), 400);
}

/// By default, if shear has an effect and is unknown, and only then.
#[test]
fn a_missing_shear_modulus_is_told() {
    let folder = Folder::new("shear");
    let told = |args: &[&str]| {
        let output = folder.run(args);
        assert!(output.status.success(), "{output:?}");
        String::from_utf8(output.stderr).unwrap()
    };
    folder.write("bat.json", BAT);
    let says = "warning: shear is left out, because a material has no \"shear_modulus\"";
    for args in [&["modes", "bat.json"][..], &["hit", "bat.json"], &["analyze", "bat.json"]] {
        let told = told(args);
        assert!(told.starts_with(says) && told.lines().count() == 1, "{args:?}: {told}");
    }
    for args in [
        &["modes", "bat.json", "--theory", "euler-bernoulli"][..],
        &["modes", "bat.json", "--quiet"],
        &["modes", "bat.json", "-n", "1", "--tol", "50%"],
    ] {
        assert_eq!(told(args), "", "{args:?}");
    }
    folder.write("bat.json", BAT.replace("14e9", "14e9, \"shear_modulus\": 1e9"));
    assert_eq!(told(&["modes", "bat.json"]), "");
}

#[test]
fn an_implausible_bat_is_warned_of_and_solved() {
    let folder = Folder::new("implausible");
    for (good, bad, warning) in [
        (X, "[0, \"500 m\", \"1 km\"]", "length is 1000 m; a bat's is 0.3 to 1.2"),
        ("14e9", "1", "youngs_modulus is 1 Pa; a bat's is 1e9 to 1e12"),
        ("\"dowel\"", "\"\", \"weighed\": { \"mass\": 12 }", "mass is 12 kg; a bat's is 0.2 to 2"),
        ("700", "0.7", "density is 0.7 kg/m³; a bat's is 50 to 20000"),
        (RADIUS, r#""radius": [0.04, 0.066, 0.05]"#, "(a diameter given as radius?)"),
        ("700", "1e-90", "density is 1e-90"),
        ("14e9", "1e90", "youngs_modulus is 1e90 Pa"),
        (X, "[0, 1e20, 2e20]", "length is 2e20 m"),
        (
            "\"dowel\"",
            r#""", "attachments": [{ "x": 0.4, "mass": 3 }]"#,
            "3 kg are attached to a bat of 1.",
        ),
        (
            "\"dowel\"",
            r#""", "attachments": [{ "x": 0.8, "mass": 1e-6, "offset": 0.1 }]"#,
            "attachments[0].offset puts the mass at 0.9 m, outside the bat, 0 to 0.8 m",
        ),
        (
            "\"dowel\"",
            r#""", "regions": [{ "from": 0, "to": 0.4, "material": {
                "density": 0.7, "youngs_modulus": 14e9 } }]"#,
            "regions[0].material.density is 0.7 kg/m³; a bat's is 50 to 20000",
        ),
        (
            "\"dowel\"",
            r#""", "regions": [{ "from": 0, "to": 0.4, "core": {
                "density": 0.2, "youngs_modulus": 2e7 } }]"#,
            "regions[0].core.density is 0.2 kg/m³",
        ),
        (
            "\"dowel\"",
            r#""", "regions": [{ "from": 0, "to": 0.4, "core": {
                "density": 200, "youngs_modulus": 2e7 } }]"#,
            "regions[0].core fills nothing: the bat is solid there",
        ),
    ] {
        folder.write("bat.json", BAT.replace(good, bad));
        let (modes, told) = accepted(&folder, &["modes", "bat.json", "--json", "-"]);
        assert!(told.starts_with("warning: bat.json: ") && told.contains(warning), "{bad}: {told}");
        assert!(frequencies(&modes).iter().all(|f| *f > 0.0 && f.is_finite()), "{bad}");
        assert!(!modes.to_string().contains("null"), "{bad}: {modes}");
        let (hit, _) = accepted(&folder, &["hit", "bat.json", "--model", "rigid", "--json", "-"]);
        assert!(hit["impacts"][0]["exit_speed_m_s"].as_f64().is_some(), "{bad}: {hit}");
        let quiet = folder.run(&["modes", "bat.json", "--quiet"]);
        assert!(quiet.status.success() && quiet.stderr.is_empty(), "{bad}");
    }
}

#[test]
fn a_million_stations_are_read() {
    let folder = Folder::new("million");
    let count = 1_000_000;
    let list = |f: &dyn Fn(f64) -> f64| {
        let at = |k: u32| f(f64::from(k) / f64::from(count - 1)).to_string();
        (0..count).map(at).collect::<Vec<_>>().join(",")
    };
    let x = list(&|s| 0.8 * s);
    let radius = list(&|s| 0.02 + 0.01 * s);
    let profile = format!("{{ \"x\": [{x}], \"radius\": [{radius}] }}");
    folder.write("bat.json", BAT.replace(PROFILE, &profile));
    let run = |more: &[&str]| {
        let few = ["modes", "bat.json", "-n", "2", "--shape-points", "0", "--json", "out.json"];
        let output = folder.run(&[&few[..], more].concat());
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let text = folder.read("out.json");
        frequencies(&serde_json::from_str(&text).unwrap())
    };
    let many = run(&["--tol", "1e-9"]);
    folder
        .write("bat.json", BAT.replace(X, "[0, 0.4, 0.8]").replace("0.03, 0.02]", "0.025, 0.03]"));
    let few = run(&["--tol", "1e-9"]);
    for (a, b) in many.iter().zip(&few) {
        assert!((a / b - 1.0).abs() < 1e-8, "{a} {b}");
    }
    // The last of them is wrong.
    folder.write("bat.json", BAT.replace(PROFILE, &profile.replace(",0.8]", ",0.7]")));
    fs::remove_file(folder.0.join("out.json")).unwrap();
    let says = ["profile.x[999999]: found 0.7 m", "beyond x[999998]"];
    assert_none(folder.misanswer(&["modes", "bat.json"], &says).into_iter().collect());
}

/// A text that is not JSON is reported as such.
#[test]
fn what_is_not_json_is_told_as_such() {
    let folder = Folder::new("not_json");
    let texts = [
        "format: sweetspot-bat/1\nname: secret\n",
        "---\nformat: secret\n",
        "name = \"secret\"\n",
        "# a bat\nsecret: 1\n",
        "- secret\n",
        "[secret]\na=1\n",
        "null secret",
        "secret",
        "x,secret\n1,2\n",
    ];
    for text in texts {
        folder.write("bat.yaml", text);
        for args in [&["modes", "bat.yaml"][..], &["hit", "r161", "--ball", "bat.yaml"]] {
            let output = folder.run(args);
            let told = String::from_utf8_lossy(&output.stderr).into_owned();
            assert_eq!(output.status.code(), Some(2), "{text}: {told}");
            let said = told.contains("text that is not JSON") && told.contains("expected `{`");
            assert!(said && !told.contains("ident"), "{text}: {told}");
        }
    }
}
