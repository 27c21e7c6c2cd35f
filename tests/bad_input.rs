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

/// A good bat; each row below spoils one thing.
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

/// What stands in the good bat, what stands there instead, and what the message must say.
type Spoilt = (&'static str, &'static str, &'static [&'static str]);

fn refused(name: &str, rows: &[Spoilt]) {
    let folder = Folder::new(name);
    let mut faults = Vec::new();
    for (good, bad, says) in rows {
        assert_eq!(BAT.matches(good).count(), 1, "{good}");
        folder.write("bat.json", BAT.replace(good, bad));
        let fault = folder.misanswer(&["modes", "bat.json", "--json", "out.json"], says);
        faults.extend(fault.map(|fault| format!("{bad}\n  {fault}")));
    }
    assert_none(faults);
}

const FORMAT: &str = r#""format": "sweetspot-bat/1""#;
const MATERIAL: &str = r#"{ "density": 700, "youngs_modulus": 14e9 }"#;
const PROFILE: &str = r#"{
    "x": [0, 0.4, 0.8],
    "radius": [0.02, 0.03, 0.02]
  }"#;
const X: &str = "[0, 0.4, 0.8]";
const RADIUS: &str = r#""radius": [0.02, 0.03, 0.02]"#;

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
fn a_wrong_format_or_key_is_refused() {
    refused(
        "keys",
        &[
            (
                FORMAT,
                r#""name2": 1"#,
                &["bat.json:2:3", "unknown key \"name2\"", "did you mean name?", "no \"format\""],
            ),
            ("\"format\": \"sweetspot-bat/1\",\n", "", &["bat.json:1:1", "no \"format\"", "bat/1"]),
            (
                FORMAT,
                r#""format": "sweetspot-bat/2""#,
                &["bat.json:2:13", "format", "bat/2", "bat/1"],
            ),
            (
                FORMAT,
                r#""format": "sweetspot-bat/2", "new": 1"#,
                &["bat.json:2:13", "bat/2", "bat/1"],
            ),
            (FORMAT, r#""format": "sweetspot-ball/1""#, &["bat.json:2:13", "ball/1", "bat/1"]),
            (FORMAT, r#""format": 1"#, &["bat.json:2:13: format: found 1", "bat/1"]),
            (FORMAT, r#""format": null"#, &["bat.json:2:13: format: found null", "bat/1"]),
            (r#""format""#, r#""Format""#, &["unknown key \"Format\"", "did you mean format?"]),
            (r#""profile""#, r#""profle""#, &["bat.json:5:3: profle", "did you mean profile?"]),
            (
                r#""profile""#,
                r#""shape""#,
                &["5:3: shape: found unknown key", "one of format, name", "no \"profile\""],
            ),
            (r#""radius""#, r#""radii""#, &["bat.json:7:5: profile.radii", "did you mean radius?"]),
            (
                r#""density""#,
                r#""densty""#,
                &["bat.json:4:17: material.densty", "did you mean density?"],
            ),
            (
                r#""youngs_modulus""#,
                r#""E""#,
                &["material.E", "unknown key \"E\"", "youngs_modulus"],
            ),
            (
                r#""name": "dowel","#,
                r#""name": "a", "name": "b","#,
                &["3:16: name", "a second time"],
            ),
            (X, "[0, 0.4, 0.8], \"x\": [0]", &["bat.json:6:25: profile.x", "a second time"]),
            ("\"profile\"", "\"profile\": {}, \"profile\"", &["profile", "a second time"]),
            (
                "{ \"density\"",
                "{ \"density\": 1, \"density\"",
                &["material.density", "second time"],
            ),
            ("\"dowel\"", "7", &["bat.json:3:11: name: found 7", "a text in quotes"]),
            ("\"dowel\"", "\"a\", \"source\": []", &["source: found a list", "a text in quotes"]),
            ("\"dowel\"", "\"\\ud800\"", &["bat.json:3:11: name", "a text in quotes"]),
        ],
    );
}

#[test]
fn a_wrong_material_is_refused() {
    refused(
        "materials",
        &[
            (MATERIAL, r#""white ash""#, &["bat.json:4:15: material", "did you mean white-ash?"]),
            (
                MATERIAL,
                r#""whiteash""#,
                &["material: found \"whiteash\"", "did you mean white-ash?"],
            ),
            (MATERIAL, r#""unobtainium""#, &["found \"unobtainium\"", "one of white-ash, "]),
            (MATERIAL, "7", &["bat.json:4:15: material: found 7", "one of white-ash"]),
            (MATERIAL, "[]", &["material: found a list", "one of white-ash"]),
            (MATERIAL, "null", &["material: found null", "one of white-ash"]),
            (MATERIAL, "{}", &["bat.json:4:15: material", "no \"density\"", "\"weighed\""]),
            (
                "\"material\": { \"density\": 700, \"youngs_modulus\": 14e9 },\n",
                "",
                &["bat.json:1:1", "no \"material\""],
            ),
            ("\"density\": 700, ", "", &["bat.json:4:15: material", "no \"density\""]),
            (
                ", \"youngs_modulus\": 14e9",
                "",
                &["bat.json:4:15", "no \"youngs_modulus\"", "18.1 GPa"],
            ),
            ("700", "-700", &["bat.json:4:28: material.density: found -700", "above 0"]),
            ("700", "0", &["material.density: found 0 kg/m³", "above 0"]),
            ("700", "true", &["material.density: found true", "a density such as"]),
            ("700", "[700]", &["material.density: found a list", "a density such as"]),
            ("700", "NaN", &["bat.json:4:28", "found NaN,", "a JSON value"]),
            ("700", "Infinity", &["bat.json:4:28", "found Infinity,", "a JSON value"]),
            ("700", "-Infinity", &["bat.json:4:2", "JSON"]),
            (
                "700",
                "1e999",
                &["bat.json:4:28: material.density: found 1e999", "a density such as"],
            ),
            ("700", "\"1e999 kg/m^3\"", &["material.density", "beyond the range of numbers"]),
            ("700", "\"1e308 lb/in^3\"", &["material.density", "beyond the range of numbers"]),
            ("700", "\"NaN\"", &["bat.json:4:28: material.density: found \"NaN\"", "a density"]),
            ("700", "\"\"", &["material.density: found \"\"", "a density such as"]),
            ("700", "\"kg/m^3\"", &["material.density: found \"kg/m^3\"", "a density such as"]),
            ("700", "\"0.0257 lbf/in^3\"", &["material.density", "lb is the mass, lbf the force"]),
            ("700", "\"700 kg\"", &["which measures a mass", "expected a density"]),
            ("700", "\"700 kg/m3/m\"", &["unit \"kg/m3/m\"", "does not measure a density"]),
            ("700", "\"700\"", &["write \"700 lb/in^3\" or \"700 kg/m^3\"; 700 without quotes"]),
            ("700", "\"700 kgs/m3\"", &["unknown unit \"kgs\"", "did you mean kg?"]),
            ("700", "\"7 🏏/m³\"", &["unknown unit \"🏏\""]),
            (
                "14e9",
                "\"14 GPA\"",
                &["bat.json:4:51: material.youngs_modulus", "did you mean GPa?"],
            ),
            (
                "14e9",
                "\"2e6 lb/in^2\"",
                &["material.youngs_modulus", "lb is a mass here: write psi"],
            ),
            ("14e9", "-1", &["bat.json:4:51: material.youngs_modulus: found -1 Pa", "above 0"]),
            ("14e9", "\"0 psi\"", &["youngs_modulus: found \"0 psi\" (0 Pa)", "above 0"]),
            (
                "14e9",
                "14e9, \"shear_modulus\": 0",
                &["material.shear_modulus: found 0 Pa", "above 0"],
            ),
            ("14e9", "14e9, \"poisson_ratio\": 0.6", &["material.poisson_ratio: found 0.6", "0.5"]),
            (
                "14e9",
                "14e9, \"poisson_ratio\": -1",
                &["material.poisson_ratio", "found -1", "above -1"],
            ),
            (
                "14e9",
                "14e9, \"poisson_ratio\": -2",
                &["material.poisson_ratio: found -2", "above -1"],
            ),
            ("14e9", "14e9, \"poisson_ratio\": \"0.3\"", &["found \"0.3\"", "a finite number"]),
            ("14e9", "14e9, \"shear_coefficient\": 0", &["material.shear_coefficient: found 0"]),
            (
                "14e9",
                "14e9, \"loss_factor\": -0.1",
                &["material.loss_factor: found -0.1", "0 or more"],
            ),
            ("14e9", "14e9, \"loss_factor\": 2", &["material.loss_factor: found 2", "below 2"]),
        ],
    );
}

#[test]
fn a_wrong_profile_is_refused() {
    refused(
        "profiles",
        &[
            (PROFILE, "[]", &["bat.json:5:14: profile: found a list", "an object"]),
            (PROFILE, "\"bat.csv\"", &["bat.json:5:14: profile: found \"bat.csv\"", "an object"]),
            (PROFILE, "{}", &["bat.json:5:14: profile", "no \"x\""]),
            (",\n    \"radius\": [0.02, 0.03, 0.02]", "", &["no \"radius\" and no \"diameter\""]),
            (
                "\"profile\": {\n",
                "\"source\": \"\", \"profile\": null, \"weighed\": {\n",
                &["weighed.x", "weighed.radius", "one of mass", "5:28: profile: found null"],
            ),
            (X, "0.8", &["bat.json:6:10: profile.x: found 0.8", "a list"]),
            (X, "{}", &["bat.json:6:10: profile.x: found an object", "a list"]),
            (X, "[]", &["7:15: profile.radius: found 3 values", "expected 0, one for each x"]),
            (X, "[0, 0.8]", &["bat.json:7:15: profile.radius", "3 values", "2, one for each x"]),
            (X, "[0, 0.4, null]", &["bat.json:6:19: profile.x[2]: found null", "a length such as"]),
            (X, "[0, 0.4, [0.8]]", &["bat.json:6:19: profile.x[2]: found a list", "a length"]),
            (X, "[0, 0.4, \"0.8 m\"  , 1]", &["profile.radius: found 3 values", "expected 4"]),
            (X, "[0, 0.4, \"0.8\"]", &["6:19: profile.x[2]: found \"0.8\" without a unit"]),
            (
                X,
                "[0, 0.4, \"31 oz\"]",
                &["6:19: profile.x[2]: found unit \"oz\"", "measures a mass"],
            ),
            (X, "[0, 0.4, \"0.8 metres\"]", &["6:19: profile.x[2]", "unknown unit \"metres\""]),
            (X, "[0, 0.4, \"33inn\"]", &["profile.x[2]", "did you mean in?"]),
            (
                X,
                "[0, 0.4, \"33\"], \"unit\": \"in\"",
                &["a number in inches", "write \"33 in\", or 33 without quotes"],
            ),
            (
                X,
                "[0, 0.4, 0.8], \"unit\": \"kg\"",
                &["expected a unit of a length, such as \"in\""],
            ),
            (
                X,
                "[0, 0.4, \"1,234 m\"]",
                &["bat.json:6:19: profile.x[2]: found \"1,234 m\"", "1.234 or 1234"],
            ),
            (
                X,
                "[0, 0.4, 1e999]",
                &["bat.json:6:19: profile.x[2]: found 1e999", "a length such as"],
            ),
            (
                X,
                "[0, 0.4, \"1e999\"]",
                &["6:19: profile.x[2]: found \"1e999\"", "beyond the range"],
            ),
            (X, "[0, NaN, 0.8]", &["bat.json:6:14", "found NaN,", "a JSON value"]),
            (
                X,
                "[0, 0.5, 0.4]",
                &[
                    "bat.json:6:19: profile.x[2]: found 0.4 m",
                    "expected a position beyond x[1] (0.5 m)",
                ],
            ),
            (X, "[0, \"5 in\", \"4 in\"]", &["x[2]: found \"4 in\"", "beyond x[1] (\"5 in\")"]),
            (X, "[0, 5, 4], \"unit\": \"in\"", &["x[2]: found 4 in", "beyond x[1] (5 in)"]),
            (X, "[0, -0.4, 0.8]", &["6:14: profile.x[1]: found -0.4 m", "beyond x[0] (0 m)"]),
            (X, "[0.1, 0.4, 0.8]", &["6:11: profile.x[0]: found 0.1 m", "expected 0: positions"]),
            (
                X,
                "[1e-300, 0.4, 0.8]",
                &["6:11: profile.x[0]: found 1e-300 m", "expected 0: positions"],
            ),
            (
                X,
                "[0, 0, 0.8]",
                &["bat.json:6:14: profile.x[1]: found 0 m: a step at an end", "inside"],
            ),
            (X, "[0, 0.8, 0.8]", &["6:19: profile.x[2]: found 0.8 m: a step at an end", "inside"]),
            (
                X,
                "[0, 0, 0]",
                &["6:17: profile.x[2]: found 0 m: a third station", "two stations at most"],
            ),
            (PROFILE, r#"{ "x": [0], "radius": [0.02] }"#, &["profile.x: found 1 station", "two"]),
            (PROFILE, r#"{ "x": [], "radius": [] }"#, &["profile.x: found 0 station", "two"]),
            (
                PROFILE,
                r#"{ "x": [0, 0], "radius": [0.02, 0.02] }"#,
                &["5:25: profile.x[1]", "length"],
            ),
            (
                PROFILE,
                r#"{ "x": [0, 1, 1, 1, 2], "radius": [1, 1, 1, 1, 1] }"#,
                &["bat.json:5:31: profile.x[3]: found 1 m: a third station"],
            ),
            (
                PROFILE,
                r#"{ "x": [0, 1, 1, 2, 2, 3], "radius": [1, 2, 1, 2, 1, 2], "x2": 1 }"#,
                &["x2"],
            ),
            (
                RADIUS,
                r#""radius": [0.02, 0, 0.02]"#,
                &[
                    "bat.json:7:22: profile.radius[1]: found 0 m",
                    "only an end of the bat may come to a point",
                ],
            ),
            (
                RADIUS,
                r#""radius": [0.02, -0.01, 0.02]"#,
                &["7:22: profile.radius[1]: found -0.01 m"],
            ),
            (
                RADIUS,
                r#""radius": [-1, 0.01, 0.02]"#,
                &["7:16: profile.radius[0]: found -1 m", "above 0"],
            ),
            (RADIUS, r#""diameter": ["2 in", "-1 in", "2 in"]"#, &["diameter[1]: found \"-1 in\""]),
            (
                RADIUS,
                r#""radius": [0.02, 1e-200, 0.02]"#,
                &["7:22: profile.radius[1]: found 1e-200 m"],
            ),
            (
                RADIUS,
                r#""radius": [0.02, 1e200, 0.02]"#,
                &["7:22: profile.radius[1]: found 1e200 m"],
            ),
            (
                RADIUS,
                r#""radius": [0.02, 0.02, 0.02], "diameter": [1, 1, 1]"#,
                &[
                    "bat.json:7:35: profile.diameter: found both \"radius\" and \"diameter\"",
                    "one of them",
                ],
            ),
            (
                RADIUS,
                r#""diameter": [1, 1, 1], "inner_radius": [0, 0, 0], "wall_thickness": [1, 1, 1]"#,
                &["both \"inner_radius\" and \"wall_thickness\""],
            ),
            (
                RADIUS,
                r#""radius": [1, 1, 1], "inner_radius": [0, 0]"#,
                &["inner_radius: found 2 values"],
            ),
            (
                RADIUS,
                r#""radius": [1, 1, 1], "inner_radius": [0, 1, 0]"#,
                &["profile.inner_radius[1]: found 1 m, expected less than radius[1] (1 m)"],
            ),
            (
                RADIUS,
                r#""diameter": [2, 2, 2], "inner_diameter": [1, 1, 2.5], "unit": "in""#,
                &[
                    "7:53: profile.inner_diameter[2]: found 2.5 in, expected less than diameter[2] (2 in)",
                ],
            ),
            (
                RADIUS,
                r#""diameter": [2, 2, 2], "inner_radius": [0, 1.5, 0], "unit": "in""#,
                &["inner_radius[1]: found 1.5 in, expected less than half of diameter[1] (2 in)"],
            ),
            (
                RADIUS,
                r#""radius": [1, 1, 1], "inner_diameter": [1, "2.5 m", 1]"#,
                &["inner_diameter[1]: found \"2.5 m\", expected less than twice radius[1] (1 m)"],
            ),
            (
                RADIUS,
                r#""radius": [1, 1, 1], "inner_radius": [0, -0.1, 0]"#,
                &["found -0.1 m", "0 or more"],
            ),
            (
                RADIUS,
                r#""diameter": [2, 2, 2], "wall_thickness": [1, 1.5, 1], "unit": "cm""#,
                &[
                    "profile.wall_thickness[1]: found 1.5 cm",
                    "a wall above 0, at most half of diameter[1] (2 cm)",
                ],
            ),
            (
                RADIUS,
                r#""radius": [1, 1, 1], "wall_thickness": [1, -1, 1]"#,
                &["wall_thickness[1]: found -1 m"],
            ),
            (
                RADIUS,
                r#""radius": [1, 1, 1], "wall_thickness": [1, 0, 1]"#,
                &["wall_thickness[1]: found 0 m"],
            ),
            // Two monotone cubics through good stations may cross between them.
            (
                PROFILE,
                r#"{ "x": [0, 1, 2, 3], "radius": [1, 1, 2, 8], "inner_radius": [0, 0.99, 1.99, 2] }"#,
                &[
                    "profile.inner_radius[1]: found 0.99 m: a wall that vanishes between x[1] (1 m) and x[2] (2 m)",
                    "add a station",
                ],
            ),
            (
                X,
                "[0, 0.4, 0.8], \"interpolation\": \"cubic\"",
                &["profile.interpolation: found \"cubic\"", "one of pchip, linear, constant"],
            ),
            (X, "[0, 0.4, 0.8], \"interpolation\": \"pchipp\"", &["did you mean pchip?"]),
            (X, "[0, 0.4, 0.8], \"interpolation\": 3", &["found 3", "one of pchip, linear"]),
            (
                X,
                "[0, 0.4, 0.8], \"measured_from\": \"top\"",
                &["found \"top\"", "one of knob, tip"],
            ),
            (X, "[0, 0.4, 0.8], \"unit\": \"inn\"", &["6:33: profile.unit", "did you mean in?"]),
            (
                X,
                "[0, 0.4, 0.8], \"unit\": \"oz\"",
                &["profile.unit", "measures a mass", "a length"],
            ),
            (X, "[0, 0.4, 0.8], \"unit\": 0.0254", &["profile.unit: found 0.0254", "a text"]),
            (
                PROFILE,
                r#"{ "interpolation": "constant", "x": [0, 1, 1, 2], "radius": [1, 2, 3, 3] }"#,
                &["profile.radius[1]: found 2 m, expected radius[0] (1 m), which holds up to here"],
            ),
            (
                PROFILE,
                r#"{ "interpolation": "constant", "x": [0, 1], "radius": [0, 1] }"#,
                &["holds to the next"],
            ),
        ],
    );
}

#[test]
fn values_that_over_or_underflow_are_refused() {
    refused(
        "range",
        &[
            (
                RADIUS,
                r#""radius": [1e-200, 1e-200, 1e-200]"#,
                &["profile.radius[1]: found 1e-200 m"],
            ),
            (
                PROFILE,
                r#"{ "x": [0, 1], "radius": [1e-200, 1e-200] }"#,
                &["mass", "check the units"],
            ),
            (PROFILE, r#"{ "x": [0, 1], "radius": [0, 0] }"#, &["mass", "check the units"]),
            (
                PROFILE,
                r#"{ "x": [0, 1], "radius": [1e200, 1] }"#,
                &["bat.json:1:1", "check the units"],
            ),
            ("14e9", "1e300", &["material.youngs_modulus: found 1e300 Pa", "below 1e100"]),
            ("14e9", "1e-320", &["bending stiffness", "check the units"]),
            ("700", "1e-320", &["mass: found", "check the units"]),
            ("700", "1e300", &["material.density: found 1e300 kg/m³", "below 1e100"]),
            (X, "[0, 1e-300, 2e-300]", &["bat.json:1:1", "check the units"]),
            (X, "[0, 1e299, 1e300]", &["bat.json:1:1", "check the units"]),
            (X, "[0, 1e308, 1.7e308]", &["bat.json:1:1", "check the units"]),
            (X, "[0, 5e-324, 1e-323]", &["bat.json:1:1", "check the units"]),
            (
                "\"dowel\"",
                "\"\", \"weighed\": { \"mass\": 1e300 }",
                &["weighed.mass: found 1e300 kg", "below 1e100"],
            ),
            ("\"dowel\"", "\"\", \"weighed\": { \"mass\": 1e-320 }", &["mass: found", "the units"]),
        ],
    );
}

/// A profile of one piece with that formula, and of that inner formula.
macro_rules! piece {
    ($formula:literal) => {
        concat!(r#"{ "pieces": [{ "from": 0, "to": 0.8, "formula": ""#, $formula, r#"" }] }"#)
    };
    ($formula:literal, $inner:literal) => {
        concat!(
            r#"{ "pieces": [{ "from": 0, "to": 0.8, "formula": ""#,
            $formula,
            r#"", "inner_formula": ""#,
            $inner,
            r#"" }] }"#
        )
    };
}

#[test]
fn a_formula_that_cannot_be_read_is_refused() {
    refused(
        "formulas",
        &[
            (
                PROFILE,
                piece!("0.0127 + tanhh(x)"),
                &[
                    "bat.json:5:72: profile.pieces[0].formula: found \"tanhh\" at character 10 of",
                    "did you mean tanh?",
                ],
            ),
            (PROFILE, piece!(""), &["pieces[0].formula: found an empty formula", "0.02*x"]),
            (PROFILE, piece!("0.02 +"), &["found the end at character 7", "a number, x, pi"]),
            (PROFILE, piece!("0.02 + 2x"), &["\"x\" at character 9", "an operator"]),
            (PROFILE, piece!("0.02 * (1 + x"), &["the end at character 14", "closing bracket"]),
            (PROFILE, piece!("0,02"), &["\",\" at character 2", "a point: 0.5"]),
            (PROFILE, piece!("0.02 + min(x)"), &["min of 1 argument", "two or more"]),
            (PROFILE, piece!("r"), &["\"r\" at character 1", "x, pi or a function"]),
            (PROFILE, piece!("0.02\\u001b[2J"), &["at character 5", "an operator"]),
            (
                PROFILE,
                piece!("0.02", "0.01 +"),
                &["bat.json:5:94: profile.pieces[0].inner_formula"],
            ),
            (
                PROFILE,
                r#"{ "pieces": [{ "from": 0, "to": 0.8, "formula": 0.02 }] }"#,
                &["5:62: profile.pieces[0].formula: found 0.02, expected a formula in quotes"],
            ),
            (
                PROFILE,
                r#"{ "pieces": [{ "from": 0, "to": 0.8 }] }"#,
                &["5:27: profile.pieces[0]: found no \"formula\"", "the outer radius in m"],
            ),
            (
                PROFILE,
                r#"{ "pieces": [{ "from": 0, "to": 0.8, "formulae": "0.02" }] }"#,
                &["5:51: profile.pieces[0].formulae: found unknown key", "did you mean formula?"],
            ),
        ],
    );
    let folder = Folder::new("deep formula");
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
    assert_none(faults);
}

#[test]
fn pieces_that_make_no_bat_are_refused() {
    refused(
        "pieces",
        &[
            (PROFILE, r#"{ "pieces": [] }"#, &["5:26: profile.pieces: found an empty list"]),
            (PROFILE, r#"{ "pieces": {} }"#, &["profile.pieces: found an object", "a list"]),
            (PROFILE, r#"{ "pieces": ["0.02"] }"#, &["profile.pieces[0]: found \"0.02\""]),
            (
                PROFILE,
                r#"{ "pieces": [{ "from": 0.1, "to": 0.8, "formula": "0.02" }] }"#,
                &["5:37: profile.pieces[0].from: found 0.1 m, expected 0", "measured_from"],
            ),
            (
                PROFILE,
                r#"{ "pieces": [{ "from": 0, "to": 0, "formula": "0.02" }] }"#,
                &["profile.pieces[0].to: found 0 m", "a position beyond 0 m"],
            ),
            (
                PROFILE,
                r#"{ "pieces": [{ "from": 0, "to": 1e999, "formula": "0.02" }] }"#,
                &["profile.pieces[0].to: found 1e999, expected a length"],
            ),
            (
                PROFILE,
                r#"{ "pieces": [{ "from": 0, "to": "0.8 kg", "formula": "0.02" }] }"#,
                &["profile.pieces[0].to: found unit \"kg\"", "expected a length"],
            ),
            (
                PROFILE,
                r#"{ "pieces": [{ "from": 0, "to": 0.4, "formula": "0.02" },
                                { "from": "41 cm", "to": 0.8, "formula": "0.02" }] }"#,
                &["6:43: profile.pieces[1].from: found 0.41 m, which leaves a gap", "0.4 m, where"],
            ),
            (
                PROFILE,
                r#"{ "pieces": [{ "from": 0, "to": 0.4, "formula": "0.02" },
                                { "from": 0.3, "to": 0.8, "formula": "0.02" }] }"#,
                &["profile.pieces[1].from: found 0.3 m, an overlap, expected 0.4 m"],
            ),
            (
                PROFILE,
                r#"{ "unit": "in", "pieces": [{ "from": 0, "to": 0.8, "formula": "0.02" }] }"#,
                &["profile.unit: found \"unit\" beside \"pieces\"", "radius in m from x in m"],
            ),
            (
                PROFILE,
                r#"{ "pieces": [{ "from": 0, "to": 0.8, "formula": "0.02" }], "x": [0, 1] }"#,
                &["profile.x: found \"x\" beside \"pieces\""],
            ),
            (
                PROFILE,
                r#"{ "csv": "a.csv", "pieces": [{ "from": 0, "to": 0.8, "formula": "0.02" }] }"#,
                &["profile.csv: found \"csv\" beside \"pieces\""],
            ),
            (
                PROFILE,
                piece!("0.02 - 0.05*x"),
                &[
                    "5:62: profile.pieces[0].formula: found 0 m at x = 0.4 m from \"0.02 - 0.05*x\"",
                    "an end",
                ],
            ),
            (PROFILE, piece!("0.01 - 0.03*sqrt(x)"), &["formula: found -0.00", "a radius above 0"]),
            // Between two samples too.
            (PROFILE, piece!("0.02 - 0.021*exp(-((x - 0.40041)/1e-3)**2)"), &["above 0"]),
            (PROFILE, piece!("(x - 0.40041)**2"), &["formula: found 0 m at x = 0.4004", "an end"]),
            (PROFILE, piece!("0"), &["found 0 m at x = 0.0", "only an end of the bat"]),
            (PROFILE, piece!("sqrt(0.5 - x)"), &["found no number at x = 0.50", "m from \"sqrt"]),
            (PROFILE, piece!("0.001/x"), &["found an infinite value at x = 0 m"]),
            (PROFILE, piece!("0.02 + 1e-9*tan(1/(x + 0.01))**2"), &["varies too fast", "smooth"]),
            (PROFILE, piece!("0.02 + abs(sin(1e6*x))", "0.01"), &["found"]),
            (
                PROFILE,
                piece!("0.02", "0.01 + 0.02*x"),
                &[
                    "5:87: profile.pieces[0].inner_formula: found 0.02",
                    "less than the outer radius there, 0.02 m",
                ],
            ),
            (
                PROFILE,
                piece!("0.02", "0.01 - 0.05*x"),
                &["inner_formula: found -0.00004 m at x = 0.2008 m", "0 or more"],
            ),
            (
                PROFILE,
                piece!("0.02", "log(x)"),
                &["inner_formula: found an infinite value at x = 0"],
            ),
            (PROFILE, piece!("1e-90"), &["fourth power is within the range"]),
            (PROFILE, piece!("1e90"), &["found", "range"]),
        ],
    );
}

#[test]
fn what_was_not_weighed_or_measured_so_is_refused() {
    refused(
        "weighed",
        &[
            (
                "\"dowel\"",
                r#""", "weighed": {}"#,
                &[
                    r#"bat.json:3:26: weighed: found none of "mass", "balance_point", "swing_weight", "pendulum_period", "first_bending_hz""#,
                    "one of them at least",
                ],
            ),
            ("\"dowel\"", r#""", "weighed": null"#, &["weighed: found null", "an object"]),
            ("\"dowel\"", r#""", "weighed": { "mas": 1 }"#, &["weighed.mas", "did you mean mass?"]),
            (
                "\"dowel\"",
                r#""", "weighed": { "mass": "31 lbf" }"#,
                &[
                    r#"weighed.mass: found unit "lbf", which measures a force"#,
                    "expected a mass",
                    "mass is mass here",
                ],
            ),
            (
                "\"dowel\"",
                r#""", "weighed": { "mass": "9 N" }"#,
                &[r#"unit "N", which measures a force"#],
            ),
            (
                "\"dowel\"",
                r#""", "weighed": { "mass": "31 in" }"#,
                &["which measures a length", "a mass"],
            ),
            (
                "\"dowel\"",
                r#""", "weighed": { "mass": -1 }"#,
                &["bat.json:3:36: weighed.mass: found -1", "above 0"],
            ),
            (
                "\"dowel\"",
                r#""", "weighed": { "mass": "0 oz" }"#,
                &[r#"weighed.mass: found "0 oz""#, "above 0"],
            ),
            (
                "\"dowel\"",
                r#""", "weighed": { "mass": 0.2 }, "attachments": [{ "x": 0.1, "mass": 0.3 }]"#,
                &["bat.json:3:36: weighed.mass: found 0.2 kg, no more than the 0.3 kg attached"],
            ),
            (
                "\"dowel\"",
                r#""", "weighed": { "balance_point": 0.9 }"#,
                &[
                    "bat.json:3:45: weighed.balance_point: found 0.9 m",
                    "a place on the bat, 0 to 0.8 m",
                ],
            ),
            (
                "\"dowel\"",
                r#""", "weighed": { "balance_point": "90 cm" }"#,
                &[r#"weighed.balance_point: found "90 cm" (0.9 m)"#, "on the bat"],
            ),
            (
                "\"dowel\"",
                r#""", "weighed": { "first_bending_hz": 0 }"#,
                &["weighed.first_bending_hz: found 0 Hz", "a number above 0"],
            ),
            (
                "\"dowel\"",
                r#""", "weighed": { "first_bending_hz": "170 rpm" }"#,
                &[
                    r#"weighed.first_bending_hz: found unit "rpm", which measures an angular speed"#,
                    "170 Hz",
                ],
            ),
            (
                MATERIAL,
                r#"{ "youngs_modulus": 14e9 }, "weighed": { "balance_point": 0.4 }"#,
                &["bat.json:4:15: material: found no \"density\"", "\"mass\" in \"weighed\""],
            ),
        ],
    );
}

#[test]
fn a_wrong_region_is_refused() {
    refused(
        "regions",
        &[
            (
                "\"dowel\"",
                r#""", "regions": {}"#,
                &["bat.json:3:26: regions: found an object", "a list"],
            ),
            (
                "\"dowel\"",
                r#""", "regions": [7]"#,
                &["bat.json:3:27: regions[0]: found 7", "an object"],
            ),
            (
                "\"dowel\"",
                r#""", "regions": [{ "from": 0, "to": 0.4 }]"#,
                &[
                    r#"bat.json:3:27: regions[0]: found none of "material", "core""#,
                    "one of them at least",
                ],
            ),
            (
                "\"dowel\"",
                r#""", "regions": [{ "to": 0.4, "material": "white-ash" }]"#,
                &[r#"bat.json:3:27: regions[0]: found no "from""#, "from the knob end"],
            ),
            (
                "\"dowel\"",
                r#""", "regions": [{ "from": 0, "to": 0.9, "material": "white-ash" }]"#,
                &[
                    "bat.json:3:46: regions[0].to: found 0.9 m, expected a place on the bat, 0 to 0.8 m",
                ],
            ),
            (
                "\"dowel\"",
                r#""", "regions": [{ "from": 0, "to": "90 cm", "material": "white-ash" }]"#,
                &[r#"regions[0].to: found "90 cm" (0.9 m), expected"#],
            ),
            (
                "\"dowel\"",
                r#""", "regions": [{ "from": 0, "to": 1e300, "material": "white-ash" }]"#,
                &["regions[0].to: found 1e300 m, expected"],
            ),
            (
                "\"dowel\"",
                r#""", "regions": [{ "from": 0.4, "to": 0.4, "material": "white-ash" }]"#,
                &["regions[0].to: found 0.4 m, expected a place beyond 0.4 m"],
            ),
            (
                "\"dowel\"",
                r#""", "regions": [{ "from": 0, "to": 0.4, "material": "white-ash" }, { "from": 0.3, "to": 0.5, "material": "white-ash" }]"#,
                &["regions[1].from: found 0.3 to 0.5 m, an overlap", "outside 0 to 0.4 m"],
            ),
            (
                "\"dowel\"",
                r#""", "regions": [{ "from": 0, "to": 0.4, "materials": "white-ash" }]"#,
                &["regions[0].materials", "did you mean material?"],
            ),
            (
                "\"dowel\"",
                r#""", "regions": [{ "from": 0, "to": 0.4, "material": "whiteash" }]"#,
                &[r#"regions[0].material: found "whiteash""#, "did you mean white-ash?"],
            ),
            (
                "\"dowel\"",
                r#""", "regions": [{ "from": 0, "to": 0.4, "material": { "youngs_modulus": 1e9 } }]"#,
                &[r#"bat.json:3:63: regions[0].material: found no "density""#, "g/cm^3"],
            ),
            (
                "\"dowel\"",
                r#""", "regions": [{ "from": 0, "to": 0.4, "core": { "density": -1, "youngs_modulus": 1e7 } }]"#,
                &["bat.json:3:72: regions[0].core.density: found -1 kg/m³", "a number above 0"],
            ),
            (
                "\"dowel\"",
                r#""", "regions": [{ "from": 0, "to": 0.4, "core": { "density": 200, "youngs_modulus": 1e7, "poisson_ratio": 0.6 } }]"#,
                &["regions[0].core.poisson_ratio: found 0.6", "0.5 at most"],
            ),
            (
                "\"dowel\"",
                r#""", "regions": [{ "from": 0, "to": 0.4, "core": { "density": 200, "youngs_modulus": 1e300 } }]"#,
                &["bat.json:3:95: regions[0].core.youngs_modulus: found 1e300 Pa", "below 1e100"],
            ),
            (
                MATERIAL,
                r#"{ "youngs_modulus": 14e9 }, "weighed": { "mass": 1 }, "regions": [
                   { "from": 0, "to": 0.4, "material": "white-ash" }]"#,
                &["bat.json:4:15: material: found no \"density\"", "one factor for all regions"],
            ),
        ],
    );
}

#[test]
fn a_wrong_weight_or_spring_is_refused() {
    refused(
        "weights",
        &[
            (
                "\"dowel\"",
                r#""", "attachments": { "x": 0.1, "mass": 0.1 }"#,
                &["bat.json:3:30: attachments: found an object", "a list"],
            ),
            (
                "\"dowel\"",
                r#""", "attachments": [{ "x": 0.1 }]"#,
                &[
                    r#"bat.json:3:31: attachments[0]: found none of "mass", "rotary_inertia", "stiffness", "rotational_stiffness""#,
                    "one of them at least",
                ],
            ),
            (
                "\"dowel\"",
                r#""", "attachments": [{ "mass": 0.1 }]"#,
                &[r#"bat.json:3:31: attachments[0]: found no "x""#, "from the knob end"],
            ),
            (
                "\"dowel\"",
                r#""", "attachments": [{ "x": 0, "mass": 0.1 }, { "x": 0.9, "mass": 0.1 }]"#,
                &["bat.json:3:63: attachments[1].x: found 0.9 m", "a place on the bat, 0 to 0.8 m"],
            ),
            (
                "\"dowel\"",
                r#""", "attachments": [{ "x": "-1 in", "mass": 0.1 }]"#,
                &[r#"attachments[0].x: found "-1 in" (-0.0254 m)"#, "on the bat"],
            ),
            (
                "\"dowel\"",
                r#""", "attachments": [{ "x": 0.1, "mass": -0.1 }]"#,
                &["attachments[0].mass: found -0.1 kg", "0 or more"],
            ),
            (
                "\"dowel\"",
                r#""", "attachments": [{ "x": 0.1, "mass": "1 lbf" }]"#,
                &[
                    r#"attachments[0].mass: found unit "lbf", which measures a force"#,
                    "mass is mass here",
                ],
            ),
            (
                "\"dowel\"",
                r#""", "attachments": [{ "x": 0.1, "mass": 1e200 }]"#,
                &["attachments[0].mass: found 1e200 kg", "0 or more, below 1e100"],
            ),
            (
                "\"dowel\"",
                r#""", "attachments": [{ "x": 0.1, "mass": 1e10 }]"#,
                &["attachments[0].mass: found 1e10 kg", "1e8 kg at most: more is a support"],
            ),
            (
                "\"dowel\"",
                r#""", "attachments": [{ "x": 0.1, "stiffness": 1e-100 }]"#,
                &["attachments[0].stiffness: found 1e-100 N/m", "0, or 1e-12 N/m and more"],
            ),
            (
                "\"dowel\"",
                r#""", "attachments": [{ "x": 0.1, "mass": 0.1, "offset": 9 }]"#,
                &["attachments[0].offset: found 9 m", "ten lengths of the bat"],
            ),
            (
                "\"dowel\"",
                r#""", "attachments": [{ "x": 0.1, "stiffness": 100, "offset": 0.1 }]"#,
                &[r#"attachments[0]: found no "mass""#, r#"whose centre has that "offset""#],
            ),
            (
                "\"dowel\"",
                r#""", "attachments": [{ "x": 0.1, "rotary_inertia": "1 oz in" }]"#,
                &[r#"attachments[0].rotary_inertia: found unit "oz in""#, "a moment of inertia"],
            ),
            (
                "\"dowel\"",
                r#""", "attachments": [{ "x": 0.1, "stiffness": "10 lb/in" }]"#,
                &[r#"attachments[0].stiffness: found unit "lb/in""#, "write lbf"],
            ),
            (
                "\"dowel\"",
                r#""", "attachments": [{ "x": 0.1, "rotational_stiffness": "5 N/m" }]"#,
                &[
                    r#"attachments[0].rotational_stiffness: found unit "N/m", which measures a stiffness"#,
                    "500 N m/rad",
                ],
            ),
            (
                "\"dowel\"",
                r#""", "attachments": [{ "x": 0.1, "rotary_stiffness": 5 }]"#,
                &["attachments[0].rotary_stiffness: found unknown key"],
            ),
            (
                "\"dowel\"",
                r#""", "absorbers": [{ "x": 0.1, "stiffness": 100 }]"#,
                &[r#"bat.json:3:29: absorbers[0]: found no "mass""#],
            ),
            (
                "\"dowel\"",
                r#""", "absorbers": [{ "x": 0.1, "mass": 0.1 }]"#,
                &[r#"absorbers[0]: found no "stiffness" and no "frequency""#, "one of them"],
            ),
            (
                "\"dowel\"",
                r#""", "absorbers": [{ "x": 0.1, "mass": 0.1, "stiffness": 1, "frequency": 1 }]"#,
                &[
                    r#"absorbers[0].frequency: found both "stiffness" and "frequency""#,
                    "one of them",
                ],
            ),
            (
                "\"dowel\"",
                r#""", "absorbers": [{ "x": 0.1, "mass": 0.1, "frequency": -170 }]"#,
                &["bat.json:3:67: absorbers[0].frequency: found -170", "a frequency above 0"],
            ),
            (
                "\"dowel\"",
                r#""", "absorbers": [{ "x": 0.1, "mass": 0.1, "frequency": 1e200 }]"#,
                &["bat.json:3:29: absorbers[0].stiffness: found a value beyond the range"],
            ),
            (
                "\"dowel\"",
                r#""", "absorbers": [{ "x": 0.1, "mass": 0, "stiffness": 1 }]"#,
                &["absorbers[0].mass: found 0 kg", "a number above 0"],
            ),
            (
                "\"dowel\"",
                r#""", "absorbers": [{ "x": 0.1, "mass": 0.1, "stiffness": 0 }]"#,
                &["absorbers[0].stiffness: found 0 N/m", "a number above 0"],
            ),
            (
                "\"dowel\"",
                r#""", "absorbers": [{ "x": 0.1, "mass": 0.1, "stiffness": 1, "damping": -1 }]"#,
                &["absorbers[0].damping: found -1 N s/m", "0 or more"],
            ),
        ],
    );
}

#[test]
fn what_cannot_hold_a_bat_or_join_its_parts_is_refused() {
    refused(
        "held",
        &[
            (
                "\"dowel\"",
                r#""", "supports": [{ "x": 0.1 }]"#,
                &[r#"bat.json:3:28: supports[0]: found no "type""#, r#""pinned" or "clamped""#],
            ),
            (
                "\"dowel\"",
                r#""", "supports": [{ "type": "pinned" }]"#,
                &[r#"supports[0]: found no "x""#],
            ),
            (
                "\"dowel\"",
                r#""", "supports": [{ "x": 0.1, "type": "fixed" }]"#,
                &[r#"supports[0].type: found "fixed", expected one of pinned, clamped"#],
            ),
            (
                "\"dowel\"",
                r#""", "supports": [{ "x": 0.1, "type": "clampd" }]"#,
                &["supports[0].type", "did you mean clamped?"],
            ),
            (
                "\"dowel\"",
                r#""", "supports": [{ "x": "90 cm", "type": "pinned" }]"#,
                &[r#"supports[0].x: found "90 cm" (0.9 m)"#, "0 to 0.8 m"],
            ),
            (
                "\"dowel\"",
                r#""", "supports": [{ "x": 0.1, "type": "pinned" }, { "x": 0.1, "type": "clamped" }]"#,
                &["supports[1].x: found 0.1 m again", "one support at one place"],
            ),
            (
                "\"dowel\"",
                r#""", "joints": [{ "x": 0.4 }]"#,
                &[
                    r#"bat.json:3:26: joints[0]: found no "rotational_stiffness""#,
                    "moment per angle",
                ],
            ),
            (
                "\"dowel\"",
                r#""", "joints": [{ "x": 0, "rotational_stiffness": 9 }]"#,
                &["joints[0].x: found 0 m", "a place inside the bat, 0 to 0.8 m"],
            ),
            (
                "\"dowel\"",
                r#""", "joints": [{ "x": 0.4, "rotational_stiffness": 0 }]"#,
                &["joints[0].rotational_stiffness: found 0 N m/rad", "a number above 0"],
            ),
            (
                "\"dowel\"",
                r#""", "joints": [{ "x": 0.4, "rotational_stiffness": 9 }, { "x": 0.4, "rotational_stiffness": 9 }]"#,
                &["joints[1].x: found 0.4 m again", "one joint at one place"],
            ),
            ("\"dowel\"", r#""", "grip": null"#, &["bat.json:3:23: grip: found null", "an object"]),
            (
                "\"dowel\"",
                r#""", "grip": { "from": 0, "to": 0.2 }"#,
                &[
                    r#"bat.json:3:23: grip: found none of "stiffness", "damping""#,
                    "one of them at least",
                ],
            ),
            (
                "\"dowel\"",
                r#""", "grip": { "from": 0, "stiffness": 1e5 }"#,
                &[r#"grip: found no "to""#, "from the knob end"],
            ),
            (
                "\"dowel\"",
                r#""", "grip": { "from": 0.2, "to": 0.1, "stiffness": 1e5 }"#,
                &["grip.to: found 0.1 m", "a place beyond 0.2 m"],
            ),
            (
                "\"dowel\"",
                r#""", "grip": { "from": 0, "to": 0.2, "stiffness": -1 }"#,
                &["grip.stiffness: found -1 N/m²", "0 or more"],
            ),
            (
                "\"dowel\"",
                r#""", "grip": { "from": 0, "to": 0.2, "stiffness": "5 N/m" }"#,
                &[
                    r#"grip.stiffness: found unit "N/m", which measures a stiffness"#,
                    "a stiffness per length such as",
                ],
            ),
            (
                "\"dowel\"",
                r#""", "grip": { "from": 0, "to": 0.2, "damping": "5 N s/m" }"#,
                &[
                    r#"grip.damping: found unit "N s/m", which measures a damping"#,
                    "a damping per length such as",
                ],
            ),
        ],
    );
}

#[test]
fn a_wrong_csv_table_is_refused() {
    let folder = Folder::new("csv");
    let bat = |csv: &str| BAT.replace(PROFILE, csv);
    folder.write("bat.json", bat(r#"{ "csv": "table.csv", "interpolation": "linear" }"#));
    let tables: &[(&str, &[&str])] = &[
        ("", &["table.csv:1:1", "no header", "x, radius, diameter"]),
        ("# nothing but this\n\n", &["table.csv:1:1", "no header"]),
        ("x_in,diameter_in\n", &["table.csv:1:1: x", "0 station", "two stations at least"]),
        ("x_in,diameter_in\n0,1\n", &["1 station", "two stations at least"]),
        ("x_in\n0\n1\n", &["table.csv:1:1: header", "a column missing", "radius or diameter"]),
        ("diameter_in\n1\n", &["table.csv:1:1: header", "a column missing"]),
        (
            "x_inn,radius_in\n",
            &["table.csv:1:1: header", "unknown unit \"inn\"", "did you mean in?"],
        ),
        ("x_in;radius_in\n0;1\n", &["1 station", "two stations at least"]),
        ("x_in\tradius_in\n", &["0 station", "two stations at least"]),
        ("sep=x\nx_in;radius_in\n", &["table.csv:1:1: found \"sep=x\"", "a semicolon"]),
        (
            "x,radius\n0,1\n1,\"1,234\"\n",
            &["table.csv:3:4: radius: found \"1,234\"", "1.234 or 1234"],
        ),
        ("x;radius\n0;0,5\n1;1.234\n", &["table.csv:3:3: radius", "1.234 or 1234"]),
        (
            "x;radius\n0;0,5\n1;0.6\n",
            &["table.csv:3:3", "\"0.6\" beside \"0,5\"", "one decimal sign"],
        ),
        ("x,radius\n0,1\n0,5,1\n", &["table.csv:3:1: found 3 cells", "numbers have points"]),
        ("x,radius\n0,1\n1,8-Mar\n", &["table.csv:3:3: radius: found \"8-Mar\"", "like a date"]),
        ("\"x_in\n0,1\n1,1\n", &["table.csv:1:1: header", "a closing quote is missing"]),
        ("x_oz,radius_in\n", &["table.csv:1:1: header", "unit \"oz\", which measures a mass"]),
        ("x_,radius\n", &["table.csv:1:1: header", "does not measure a length"]),
        ("x_in,raduis_in\n", &["header: found column \"raduis_in\"", "did you mean radius?"]),
        ("x,radius,colour\n", &["column \"colour\"", "x, radius, diameter"]),
        ("x,x_in,radius\n", &["column \"x\" a second time"]),
        ("x,radius,diameter\n0,1,2\n", &["columns \"radius\" and \"diameter\"", "one of them"]),
        ("x,radius,inner_radius,wall_thickness\n", &["\"inner_radius\" and \"wall_thickness\""]),
        ("x,radius\n0,1\n1\n2,1\n", &["table.csv:3:1: found 1 cell in this row, expected 2"]),
        ("# c\nx,radius\n\n# d\r\n0,1\n\n# e\n1,1,1\n", &["table.csv:8:1: found 3 cells"]),
        (
            "x,radius\n0,1\n1, thick\n",
            &["table.csv:3:4: radius: found \"thick\"", "a finite number"],
        ),
        ("x,radius\n0,1\n1,\n", &["table.csv:3:3: radius: found \"\"", "a finite number"]),
        ("x,radius\n0,1\n1,1 in\n", &["table.csv:3:3: radius: found \"1 in\"", "in the header"]),
        ("x,radius\n0,1\nnan,1\n", &["table.csv:3:1: x: found \"nan\"", "a finite number"]),
        ("x,radius\n0,1\n1,inf\n", &["table.csv:3:3: radius: found \"inf\"", "a finite number"]),
        ("x,radius\n0,1\n1,1e999\n", &["table.csv:3:3: radius: found \"1e999\"", "finite number"]),
        ("x,radius\n0,\"1\n1,1\n", &["table.csv:2:", "expected"]),
        (
            "x_in,radius_in\n0,1\n8,1\n7,1\n",
            &["table.csv:4:1: x: found 7 in", "beyond x[1] (8 in)"],
        ),
        (
            "x,radius\n0,1\n1,0\n2,1\n",
            &["table.csv:3:3: radius: found 0", "only an end of the bat"],
        ),
        (
            "x_in,diameter_in,wall_thickness_mm\n0,1,2\n# thick\n9,1,20\n",
            &["table.csv:4:5: wall_thickness: found 20 mm", "at most half of diameter[1] (1 in)"],
        ),
        ("\u{feff}x,radius\n0,1\n1,-1\n", &["table.csv:3:3: radius: found -1"]),
    ];
    let run = ["modes", "bat.json", "--json", "out.json"];
    let mut faults = Vec::new();
    for (table, says) in tables {
        folder.write("table.csv", table);
        faults.extend(folder.misanswer(&run, says).map(|f| format!("{table:?}: {f}")));
    }
    folder.write("table.csv", b"x,radius\n0,1\n1,\xff\n");
    // A table that is no UTF-8 is that of a western spreadsheet.
    let said = in_lines(&folder.run(&run).stderr);
    assert!(
        said.contains("table.csv:3:3: radius: found \"ÿ\"") && said.contains("finite"),
        "{said}"
    );
    folder.write("table.csv", b"x,radius\n0,1\n1,\xff\0\n");
    faults.extend(folder.misanswer(&run, &["table.csv:3:3", "not text", "UTF-8"]));
    folder.write("table.csv", "x,radius\n0,1\n1,1\n");
    for (profile, says) in [
        (
            r#"{ "csv": "missing.csv" }"#,
            ["bat.json:5:23: profile.csv", "missing.csv", "No such file"],
        ),
        (r#"{ "csv": "." }"#, ["bat.json:5:23: profile.csv", "cannot be read", "a CSV file"]),
        (
            r#"{ "csv": "a\u0000b" }"#,
            ["bat.json:5:23: profile.csv", "cannot be read", "a CSV file"],
        ),
        (r#"{ "csv": 7 }"#, ["bat.json:5:23: profile.csv", "found 7", "a text"]),
        (
            r#"{ "csv": "table.csv", "x": [0] }"#,
            ["5:36: profile.x", "beside \"csv\"", "csv file alone"],
        ),
    ] {
        folder.write("bat.json", bat(profile));
        faults.extend(folder.misanswer(&run, &says).map(|f| format!("{profile}: {f}")));
    }
    assert_none(faults);
}

#[test]
fn a_wrong_ball_is_refused() {
    const BALL: &str = r#"{
  "format": "sweetspot-ball/1",
  "mass": "5.125 oz",
  "radius": "36.6 mm",
  "cor": 0.5
}"#;
    let rows: &[Spoilt] = &[
        ("sweetspot-ball/1", "sweetspot-bat/1", &["ball.json:2:13: format", "ball/1"]),
        (r#""format": "sweetspot-ball/1","#, "", &["ball.json:1:1", "no \"format\""]),
        (r#""mass": "5.125 oz","#, "", &["ball.json:1:1", "no \"mass\""]),
        (r#""radius": "36.6 mm","#, "", &["ball.json:1:1", "no \"radius\""]),
        ("\"36.6 mm\",\n  \"cor\": 0.5", "\"36.6 mm\"", &["ball.json:1:1", "no \"cor\""]),
        (r#""cor""#, r#""core""#, &["ball.json:5:3: core", "did you mean cor?"]),
        ("\"5.125 oz\"", "\"5 lbf\"", &["ball.json:3:11: mass", "a force", "mass is mass"]),
        ("\"5.125 oz\"", "-0.1", &["ball.json:3:11: mass: found -0.1", "above 0"]),
        ("\"5.125 oz\"", "0", &["ball.json:3:11: mass: found 0", "above 0"]),
        ("\"5.125 oz\"", "1e200", &["ball.json:3:11: mass: found 1e200", "of a ball's size"]),
        ("\"36.6 mm\"", "\"36.6\u{a0}mn\"", &["ball.json:4:13: radius", "did you mean"]),
        ("0.5", "1.5", &["ball.json:5:10: cor: found 1.5", "0 to 1"]),
        ("0.5", "-0.5", &["ball.json:5:10: cor: found -0.5", "0 to 1"]),
        ("0.5", "1e999", &["ball.json:5:10: cor: found 1e999", "a finite number"]),
        ("0.5", "\"0.5\"", &["ball.json:5:10: cor: found \"0.5\"", "a finite number"]),
        ("0.5", "0.5, \"stiffness\": -1", &["ball.json:5:28: stiffness: found -1", "above 0"]),
        ("0.5", "0.5, \"exponent\": 0", &["ball.json:5:27: exponent: found 0", "above 0"]),
        ("0.5", "0.5, \"cor\": 0.5", &["ball.json:5:15: cor", "a second time"]),
        ("0.5", "0.5, \"cor_by_speed\": []", &["ball.json:5:31: cor_by_speed", "one pair"]),
        ("0.5", "0.5, \"cor_by_speed\": [[1]]", &["ball.json:5:32", "a speed and the rest"]),
        ("0.5", "0.5, \"cor_by_speed\": [[1, 2]]", &["ball.json:5:36", "0 to 1"]),
        (
            "0.5",
            "0.5, \"cor_by_speed\": [[2, 0.5], [1, 0.6]]",
            &["ball.json:5:43", "each above the last"],
        ),
        ("0.5", "0.5, \"damping_ratio\": 0.2", &["ball.json", "damping_ratio", "cor"]),
        ("\"cor\": 0.5", "\"damping_ratio\": 1", &["ball.json:5:20", "0 to below 1"]),
        (
            "\"cor\": 0.5",
            "\"exponent\": 1.5, \"damping_ratio\": 0.2",
            &["ball.json:5:37", "an exponent of 1"],
        ),
    ];
    let folder = Folder::new("balls");
    folder.write("bat.json", BAT);
    let mut faults = Vec::new();
    let run = ["hit", "bat.json", "--ball", "ball.json", "--json", "out.json"];
    for (good, bad, says) in rows {
        assert_eq!(BALL.matches(good).count(), 1, "{good}");
        folder.write("ball.json", BALL.replace(good, bad));
        faults.extend(folder.misanswer(&run, says).map(|f| format!("{bad}: {f}")));
    }
    folder.write("ball.json", "");
    faults.extend(folder.misanswer(&run, &["ball.json:1:1", "an empty file"]));
    let unknown = ["hit", "bat.json", "--ball", "basebal"];
    faults.extend(folder.misanswer(&unknown, &["basebal", "No such file"]));
    assert_none(faults);
}

#[test]
fn a_wrong_command_line_is_refused() {
    let folder = Folder::new("options");
    folder.write("bat.json", BAT);
    folder.write("study.json", r#"{ "format": "sweetspot-study/1" }"#);
    folder.write("aim.json", r#"{ "format": "sweetspot-aim/1" }"#);
    let rows: &[(&[&str], &[&str])] = &[
        (&["mode", "bat.json"], &["unrecognized subcommand 'mode'", "modes"]),
        (&["anlyze", "bat.json"], &["unrecognized subcommand 'anlyze'", "'analyze'"]),
        (&["r162"], &["expected a verb or a bat", "did you mean `sweetspot analyze r161`?"]),
        (&["none.json"], &["none.json", "No such file"]),
        (&["study.json"], &["which is a study", "`sweetspot study study.json --out FOLDER`"]),
        (&["./aim.json", "--full"], &["which is a wish", "`sweetspot aim BAT ./aim.json`"]),
        (&["zebra"], &["unrecognized subcommand 'zebra'"]),
        (
            &["modes", "r16"],
            &["r16, which is neither", "r161, softball_made_up", "did you mean r161?"],
        ),
        (
            &["compare", "r161", "zebra"],
            &["zebra, which is neither", "built-in bat: bbcor_made_up"],
        ),
        (&["modes"], &["required arguments", "<BAT>"]),
        (&["modes", "bat.json", "bat.json"], &["unexpected argument"]),
        (&["modes", "bat.json", "--mode", "3"], &["unexpected argument '--mode'", "--modes"]),
        (&["modes", "bat.json", "--modes", "-1"], &["-1"]),
        (&["modes", "bat.json", "--modes=-1"], &["-1", "--modes <N>", "0..=400"]),
        (&["modes", "bat.json", "--modes", "x"], &["'x'", "--modes <N>"]),
        (&["modes", "bat.json", "--modes", "401"], &["401", "0..=400"]),
        (&["modes", "bat.json", "--modes", "3", "--modes", "4"], &["multiple times"]),
        (&["modes", "bat.json", "--tol", "0"], &["'0'", "--tol <T>", "between 0 and 1"]),
        // Less than the smallest number is 0.
        (&["modes", "bat.json", "--tol", "1e-324"], &["'1e-324'", "between 0 and 1"]),
        (&["modes", "bat.json", "--tol=-1e-4"], &["'-1e-4'", "between 0 and 1"]),
        (&["modes", "bat.json", "--tol", "1"], &["'1'", "between 0 and 1"]),
        (&["modes", "bat.json", "--tol", "100%"], &["'100%'", "between 0 and 1"]),
        (&["modes", "bat.json", "--tol", "nan"], &["'nan'", "between 0 and 1"]),
        (&["modes", "bat.json", "--tol", "1e-4 %%"], &["between 0 and 1"]),
        (&["modes", "bat.json", "--elements", "0"], &["'0'", "--elements <N>", "1..="]),
        (&["modes", "bat.json", "--elements", "1e3"], &["'1e3'", "--elements <N>"]),
        (
            &["modes", "bat.json", "-n", "50", "--elements", "4"],
            &["50 bending modes", "25 elements"],
        ),
        (
            &["modes", "bat.json", "--modes", "400", "--elements", "1000000"],
            &["elements: found 1000000 with 400 modes", "GB", "fewer elements or modes"],
        ),
        (&["hit", "bat.json", "-n", "400", "--elements", "1000000"], &["fewer elements or modes"]),
        (&["analyze", "bat.json", "-n", "5", "--elements", "2"], &["at least 3 elements"]),
        (&["modes", "bat.json", "--solver", "dense", "--elements", "5000"], &["dense", "statics"]),
        #[cfg(not(feature = "arpack"))]
        (&["modes", "bat.json", "--solver", "arpack"], &["not in this build", "--features arpack"]),
        (&["modes", "bat.json", "--solver", "shift"], &["possible values: auto, statics"]),
        (
            &["modes", "bat.json", "--solver", "static"],
            &["'static'", "a similar value exists: 'statics'"],
        ),
        (
            &["modes", "bat.json", "--theory", "timoshenko"],
            &["theory: found timoshenko, but material has no", "\"shear_modulus\" or \"poisson_"],
        ),
        (&["advise"], &["required arguments", "<BAT>"]),
        (&["advise", "missing.json"], &["cannot read missing.json"]),
        (&["advise", "bat.json", "-n", "0"], &["'0'", "--modes <N>", "1..=100"]),
        (&["advise", "bat.json", "--modes", "101"], &["101", "1..=100"]),
        (&["advise", "bat.json", "--tol", "0"], &["'0'", "--tol <T>", "between 0 and 1"]),
        (&["advise", "bat.json", "--tol", "1"], &["'1'", "between 0 and 1"]),
        (&["advise", "bat.json", "--tol", "nan%"], &["'nan%'", "between 0 and 1"]),
        (&["advise", "bat.json", "--theory", "rayleigh"], &["unexpected argument '--theory'"]),
        (&["advise", "bat.json", "--elements", "8"], &["unexpected argument '--elements'"]),
        (&["advise", "bat.json", "--units", "metric"], &["'metric'", "si, us, both"]),
        (&["advise", "bat.json", "--json", "missing/a.json"], &["cannot write missing/a.json"]),
        (&["modes", "bat.json", "--theory", "euler"], &["'euler'", "euler-bernoulli"]),
        (&["modes", "bat.json", "--units", "metric"], &["'metric'", "si, us, both"]),
        (&["modes", "bat.json", "--shape-points", "-3"], &["-3"]),
        (&["modes", "bat.json", "--shape-points", "node"], &["'node'", "\"nodes\" or a number"]),
        (&["modes", "bat.json", "--json"], &["a value is required", "--json <FILE>"]),
        (&["modes", "bat.json", "--up-to", "0"], &["--up-to: found 0.0 Hz", "above 0"]),
        (&["modes", "bat.json", "--up-to", "-2 kHz"], &["--up-to: found -2000.0 Hz", "above 0"]),
        (&["hit", "bat.json", "--up-to", "2 mm"], &["'2 mm'", "a frequency such as \"170 Hz\""]),
        (&["modes", "bat.json", "--up-to", "1e8"], &["--up-to", "more than 400 bending modes"]),
        (&["modes", "bat.json", "--up-to", "2000", "-n", "3"], &["cannot be used with", "--modes"]),
        (
            &["schema", "oak"],
            &[
                "'oak'",
                "possible values: bat, ball, study, aim, rules, readings, scatter, validation",
            ],
        ),
        (&["modes", "bat.json", "--degree", "2"], &["--degree", "3..=12"]),
        (&["modes", "bat.json", "--budget", "5 kg"], &["--budget"]),
        (&["hit", "bat.json", "--budget", "5 ms"], &["--budget", "with hit"]),
        (&["analyze", "bat.json", "--budget", "5 ms"], &["--budget", "with analyze"]),
        (&["modes", "bat.json", "--budget", "5 ms", "--tol", "1e-3"], &["cannot be used with"]),
        (&["analyze", "bat.json", "--at", "0.6"], &["unexpected argument '--at'"]),
        (&["analyze", "missing.json", "--out", "folder"], &["cannot read missing.json"]),
        (&["analyze"], &["required arguments", "<BAT>"]),
        (&["hit", "bat.json", "--ball", "softball"], &["ball: found softball", "\"stiffness\""]),
        (
            &["hit", "bat.json", "--model", "ridgid"],
            &["'ridgid'", "a similar value exists: 'rigid'"],
        ),
        (
            &["hit", "bat.json", "--pulse-duration", "1 ms"],
            &["--pulse-duration, --loss-share: found them with --model contact", "--model pulse"],
        ),
        (
            &["hit", "bat.json", "--model", "pulse", "--loss-share", "2"],
            &["--loss-share", "0 to 1"],
        ),
        (
            &["hit", "bat.json", "--model", "pulse", "--pulse-duration", "0 s"],
            &["--pulse-duration: found 0 s", "from 1 ns to 1 s"],
        ),
        (&["hit", "bat.json", "--model", "rigid", "--gamma", "1"], &["--gamma", "energy-loss"]),
        (&["hit", "bat.json", "--gamma", "-1"], &["'-1'", "0 to 100"]),
        (&["hit", "bat.json", "--decay", "nan"], &["'nan'", "0 to 100"]),
        (&["hit", "bat.json", "--cor", "2"], &["'2'", "--cor <E>", "0 to 1"]),
        (&["hit", "bat.json", "--cor", "-0.1"], &["'-0.1'", "0 to 1"]),
        (&["hit", "bat.json", "--at", "-0.1"], &["--at: found -0.1 m", "0 to 0.8 m (31.4961 in)"]),
        (&["hit", "bat.json", "--at", "40 in"], &["--at: found 1.016 m (40.0 in)", "0 to 0.8 m"]),
        (&["hit", "bat.json", "--at", "0.6", "--from", "0.5"], &["--at", "cannot be used with"]),
        (&["hit", "bat.json", "--at", "0.6", "--points", "3"], &["--at", "cannot be used with"]),
        (&["hit", "bat.json", "--from", "0.9 m"], &["--from: found 0.9 m", "0 to 0.8 m"]),
        (&["hit", "bat.json", "--to", "0.9"], &["--to: found 0.9 m", "0 to 0.8 m"]),
        (&["hit", "bat.json", "--to", "0.3"], &["--to: found 0.3 m", "beyond --from, 0.4 m"]),
        (
            &["hit", "bat.json", "--from", "0.6", "--to", "0.5"],
            &["--to: found 0.5 m", "beyond --from"],
        ),
        (&["hit", "bat.json", "--points", "0"], &["'0'", "--points <N>", "1..="]),
        (&["hit", "bat.json", "--pitch", "-90 mph"], &["--pitch: found -40.2336 m/s", "0 or more"]),
        (
            &["hit", "bat.json", "--pitch", "90 lb"],
            &["unit \"lb\", which measures a mass", "a speed"],
        ),
        (&["hit", "bat.json", "--pitch", "90"], &["90 mph or 90 m/s?", "201 mph is meant"]),
        (&["hit", "bat.json", "--at", "28"], &["28 in or 28 m?", "\"28 in\""]),
        (&["hit", "bat.json", "--at", "1,234 in"], &["1.234 or 1234", "without the comma"]),
        (&["hit", "bat.json", "--pitch", "fast"], &["'fast'", "a speed such as \"90 mph\""]),
        (&["hit", "bat.json", "--pitch", "1e300"], &["--pitch", "below 1e6 m/s"]),
        (
            &["hit", "bat.json", "--swing-speed", "70 mph"],
            &["70 mph, a speed", "write --bat-speed \"70 mph\""],
        ),
        (
            &["hit", "bat.json", "--swing-speed", "45 rad/s", "--bat-speed", "70 mph"],
            &["--swing-speed", "cannot be used with", "--bat-speed"],
        ),
        (
            &["hit", "bat.json", "--bat-speed", "70 mph", "--bat-speed-at", "1 m"],
            &["--bat-speed-at: found 1.0 m", "0 to 0.8 m"],
        ),
        (
            &["hit", "bat.json", "--bat-speed", "70 mph", "--pivot", "-0.647 m"],
            &["--bat-speed", "beyond the swing's rotation centre"],
        ),
        (&["hit", "bat.json", "--bat-speed-at", "4 in"], &["--bat-speed <m/s>"]),
        (&["hit", "bat.json", "--bat-speed", "70"], &["70 mph or 70 m/s?"]),
        (&["hit", "bat.json", "--swing-speed", "1e200"], &["--swing-speed", "1e6 rad/s"]),
        (&["hit", "bat.json", "--pivot", "2.5 inn"], &["unknown unit \"inn\"", "a length"]),
        (&["hit", "bat.json", "--pivot", "1e999"], &["beyond the range of numbers", "a length"]),
        (&["hit", "bat.json", "--reproducible=1"], &["--reproducible"]),
        (&["hit", "bat.json", "--hands", "-1 in"], &["--hands: found -0.0254 m", "0 to 0.8 m"]),
        (&["hit", "bat.json", "--wall-stiffness", "0"], &["--wall-stiffness", "1 to 1e15 N/m"]),
        (&["hit", "bat.json", "--wall-mass", "50 g"], &["--wall-stiffness <N/m>"]),
        (&["hit", "bat.json", "--wall", "soft"], &["--wall <WHEN>", "auto, on, off"]),
        (
            &["hit", "bat.json", "--wall", "on", "--model", "rigid"],
            &["--wall: found on with --model rigid", "--model contact"],
        ),
        (
            &["hit", "bat.json", "--wall-stiffness", "4e6", "--model", "rigid"],
            &["--wall-stiffness: found it with --model rigid", "--model contact"],
        ),
        (
            &["hit", "bat.json", "--wall-stiffness", "4e6", "--wall-mass", "-1"],
            &["--wall-mass", "0, or 1e-9 to 1e6 kg"],
        ),
        (&["hit", "bat.json", "--swing-exponent", "0.5"], &["--reference-inertia <kg m2>"]),
        (&["hit", "bat.json", "--reference-inertia", "0"], &["--reference-inertia", "above 0"]),
        (
            &["hit", "bat.json", "--reference-inertia", "0.2", "--swing-exponent", "3"],
            &["--swing-exponent: found 3", "0 to 2"],
        ),
        (&["ring", "bat.json", "--hit", "0.9"], &["--hit: found 0.9 m", "0 to 0.8 m"]),
        (&["ring", "bat.json", "--hit", "0.6", "--watch", "0.9"], &["--watch: found 0.9 m"]),
        (&["ring", "bat.json", "--hit", "0.6", "--until", "1e9"], &["--until", "below 1000 s"]),
        (&["ring", "bat.json", "--hit", "0.6", "--until", "-1 ms"], &["--until", "above 0"]),
        (&["ring", "bat.json", "--hit", "0.6", "--model", "rigid"], &["--model", "contact"]),
        (&["ring", "bat.json", "--hit", "0.6", "--at", "0.5"], &["cannot be used with"]),
        (
            &["ring", "bat.json", "--hit", "0.6", "--pitch", "0", "--swing-speed", "0"],
            &["--hit: found no contact at 0.6 m", "where ball and bat meet"],
        ),
        (
            &["ring", "bat.json", "--at", "0.6", "--impulse", "1", "--pitch", "90 mph"],
            &["--pitch sets the scene of a hit", "--hit X"],
        ),
        (
            &["ring", "bat.json"],
            &["neither a blow nor an initial shape", "--at X with --impulse J"],
        ),
        (&["ring", "bat.json", "--at", "0.6"], &["--impulse <N s>", "--force <FILE>"]),
        (&["ring", "bat.json", "--force", "f.csv"], &["--at <m>"]),
        (
            &["ring", "bat.json", "--at", "0.6", "--impulse", "1", "--force", "f.csv"],
            &["cannot be used with"],
        ),
        (&["ring", "bat.json", "--at", "0.6", "--force", "f.csv"], &["cannot read f.csv"]),
        (
            &["ring", "bat.json", "--at", "0.9", "--force", "f.csv"],
            &["--at: found 0.9 m", "0 to 0.8 m"],
        ),
        (&["frf", "bat.json"], &["--at <m>"]),
        (&["frf", "bat.json", "--at", "0.9"], &["--at: found 0.9 m", "0 to 0.8 m"]),
        (&["frf", "bat.json", "--at", "0.6", "--to", "-1 mm"], &["--to: found -0.001 m"]),
        (&["frf", "bat.json", "--at", "0.6 s"], &["measures a time", "a length"]),
        (
            &["frf", "bat.json", "--at", "0.6", "--kind", "mobilty"],
            &["possible values: receptance", "a similar value exists: 'mobility'"],
        ),
        (
            &["frf", "bat.json", "--at", "0.6", "--from-hz", "0"],
            &["--from-hz: found 0 Hz", "--linear"],
        ),
        (
            &["frf", "bat.json", "--at", "0.6", "--from-hz", "0", "--linear"],
            &["frequencies: found 0 Hz", "nothing holds the bat"],
        ),
        (
            &["frf", "bat.json", "--at", "0.6", "--from-hz", "300", "--to-hz", "200"],
            &["--to-hz: found 200.0 Hz", "more than 300.0 Hz"],
        ),
        (&["frf", "bat.json", "--at", "0.6", "--to-hz", "-5 Hz"], &["--to-hz: found -5.0 Hz"]),
        (&["frf", "bat.json", "--at", "0.6", "--to-hz", "1e300"], &["--to-hz: found", "1e6 Hz"]),
        (
            &["frf", "bat.json", "--at", "0.6", "--frequencies", "100,fast"],
            &["'fast'", "a frequency"],
        ),
        (
            &["frf", "bat.json", "--at", "0.6", "--frequencies", "100", "--to-hz", "200"],
            &["cannot be used with"],
        ),
        (&["frf", "bat.json", "--at", "0.6", "--points", "0"], &["1..="]),
        (&["frf", "bat.json", "--at", "0.6", "--csv", "-", "--json", "-"], &["--csv: found -"]),
        (&["frf", "bat.json", "--at", "0.6", "--budget", "5 ms"], &["--budget", "frf"]),
        (&["ring", "bat.json", "--impulse", "1"], &["--at <m>"]),
        (
            &["ring", "bat.json", "--at", "0.9", "--impulse", "1"],
            &["--at: found 0.9 m", "0 to 0.8 m"],
        ),
        (&["ring", "bat.json", "--at", "-1 in", "--impulse", "1"], &["--at: found -0.0254 m"]),
        (&["ring", "bat.json", "--at", "0.6", "--impulse", "1 N"], &["a force", "an impulse"]),
        (
            &["ring", "bat.json", "--at", "0.6", "--impulse", "1e300"],
            &["--impulse: found 1e300 N s"],
        ),
        (
            &["ring", "bat.json", "--at", "0.6", "--impulse", "1", "--times", "-1"],
            &["--times: found -1.0 s"],
        ),
        (&["ring", "bat.json", "--at", "0.6", "--impulse", "1", "--times", "0,,1"], &["a time"]),
        (
            &["ring", "bat.json", "--at", "0.6", "--impulse", "1", "--times", "1e300"],
            &["--times: found"],
        ),
        (&["ring", "bat.json", "--at", "0.6", "--impulse", "1", "--shape-points", "1"], &["2..="]),
        (
            &["ring", "bat.json", "--at", "0.6", "--impulse", "1", "--initial", "w.csv"],
            &["--initial"],
        ),
        (&["ring", "bat.json", "--initial", "w.csv"], &["cannot read w.csv", "No such file"]),
        (&["trade"], &["BAT"]),
        (&["trade", "bat.json", "-n", "0"], &["1..=200"]),
        (&["trade", "bat.json", "--budget", "0 s"], &["expected a time"]),
        (&["trade", "bat.json", "--units", "si"], &["unexpected argument '--units'"]),
        (
            &["trade", "bat.json", "--json", "-", "--csv", "-"],
            &["--csv: found", "beside --json -, expected one of them"],
        ),
        (&["trade", "none.json"], &["cannot read none.json"]),
        (&["validate", "bat.json"], &["unexpected argument 'bat.json'"]),
        (&["validate", "--case", "r161_natan"], &["r161_natan", "did you mean r161_nathan?"]),
        (&["validate", "--case", "zebra"], &["zebra", "a name of validation/"]),
        (&["validate", "--case", "dowel", "--page", "-"], &["--page", "cannot be used with"]),
        (&["materials", "--tol", "1"], &["unexpected argument '--tol'"]),
    ];
    let mut faults = Vec::new();
    for (args, says) in rows {
        faults.extend(folder.misanswer(args, says));
    }
    for verb in ["fit", "tune", "sweep"] {
        let says = format!("\"{verb}\" is not supported yet");
        faults.extend(folder.misanswer(&[verb, "bat.json"], &[&says]));
    }
    for (shape, says) in [
        ("", &["w.csv:1:1", "no header"][..]),
        ("x_m\n0\n0.8\n", &["w.csv:1:1: header", "a column missing", "x_m,w_mm"]),
        ("x_m,w_mm\n", &["0 row", "two at least"]),
        ("x_m,w_mm\n0,1\n0.8,1\n0.7,1\n", &["w.csv:4:1: x: found 0.7 m", "rising places"]),
        ("x_m,w_mm\n0,1\n0.5,1\n", &["0 to 0.5 m", "the whole bat, 0 to 0.8 m"]),
        ("x_m,w_mm\n0,1\n0.8,high\n", &["w.csv:3:5: w: found \"high\"", "a finite number"]),
        ("x_m,w_oz\n0,1\n0.8,1\n", &["w.csv:1:5: header", "measures a mass"]),
    ] {
        folder.write("w.csv", shape);
        let fault = folder.misanswer(&["ring", "bat.json", "--initial", "w.csv"], says);
        faults.extend(fault.map(|f| format!("{shape:?}: {f}")));
    }
    for (force, says) in [
        ("", &["p.csv:1:1", "no header", "t, force"][..]),
        ("t_ms\n0\n1\n", &["p.csv:1:1: header", "a column missing", "t_ms,force_n"]),
        ("t_ms,forse_n\n0,1\n", &["column \"forse_n\"", "did you mean force?"]),
        ("t_ms,force_n\n0,1\n", &["p.csv:2:1: t", "1 row", "two at least"]),
        ("t_ms,force_n\n0,1\n0,2\n", &["p.csv:3:1: t: found 0 s", "rising times"]),
        ("t_ms,force_n\n-1,1\n0,2\n", &["p.csv:2:1: t: found -0.001 s", "0 or later"]),
        ("t_ms,force_n\n0,1\n1,hard\n", &["p.csv:3:3: force: found \"hard\""]),
        ("t_ms,force_n\n0,1\n1,1e12\n", &["p.csv:3:3: force", "less than 1e9 N"]),
        ("t_ms,force_lb\n0,1\n1,2\n", &["measures a mass", "write ozf or lbf"]),
        ("t_m,force_n\n0,1\n1,2\n", &["p.csv:1:1: header", "measures a length", "a time"]),
    ] {
        folder.write("p.csv", force);
        let args = ["ring", "bat.json", "--at", "0.6", "--force", "p.csv"];
        faults.extend(folder.misanswer(&args, says).map(|f| format!("{force:?}: {f}")));
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
        // A scale that shows far more or less than the file's own densities make is told, and nothing else is.
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
    // A scale weighs both; the inertia of the wood goes with its mass.
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
    // Fewer ways to bend are stiffer ones.
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
    // A ball that gives nothing back stays on the bat and may be met again and again: what is not known
    // to the tolerance then is said. Of many places less would be known: the work is bounded.
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

/// A run that falls short of what was asked: exit code 3, one line that says why, and an answer.
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

/// By default, where shear would matter and is not known, and only there.
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

/// What was measured, and what differs, is told wrong with its place, and nothing is written.
#[test]
fn readings_and_scatters_that_cannot_be_are_told() {
    let folder = Folder::new("wood");
    folder.write("bat.json", BAT);
    let readings: &[(&str, &[&str])] = &[
        (
            r#""mass": "0.9 kg ± 0 g""#,
            &["readings.json:2:9: mass: found", "above 0 and below the reading"],
        ),
        (r#""mass": "0.9 m""#, &["found unit \"m\", which measures a length"]),
        (r#""mass": 31"#, &["mass: found 31, expected a mass from 0.1 to 5 kg"]),
        (r#""balance_point": "1 m""#, &["readings.json: balance_point: found 1 m", "below 0.8 m"]),
        (
            r#""pendulum": { "pivot": "16 in", "period": "1.4 s" }"#,
            &["pendulum.pivot", "knob side of the balance"],
        ),
        (r#""pendulum": {}"#, &["no \"period\"", "a swing there and back"]),
        (
            r#""lines": [ { "hz": 5 } ]"#,
            &["lines[0].hz: found 5, expected a frequency from 10 to 20000 Hz"],
        ),
        (r#""lines": [ { "hz": 170, "within": 200 } ]"#, &["lines[0].within", "below the line"]),
        (r#""lines": [ { "hz": 170, "mode": 0 } ]"#, &["lines[0].mode", "1 to 20"]),
        (
            r#""lines": [ { "hz": 170, "mode": 1 }, { "hz": 180, "mode": 1 } ]"#,
            &["lines[1]", "every mode once"],
        ),
        (
            r#""lines": [ { "hz": 19000 } ]"#,
            &["none that may be a bending mode", "from a quarter to four times"],
        ),
        (
            r#""ring_down": [ { "mode": 1, "cycles": 20, "ratio": 1.4 } ]"#,
            &["ring_down[0].ratio", "between 0 and 1"],
        ),
        (
            r#""lines": [ { "hz": 174.5, "loss_factor": 0.01 } ]"#,
            &["lines[0].loss_factor", "the \"mode\" of the tone beside it"],
        ),
        (r#""model": 0"#, &["model: found 0", "above 0 and below 1"]),
        (
            r#""priors": { "correlation": 1.5 }"#,
            &["priors.correlation: found 1.5", "between -1 and 1"],
        ),
        (
            r#""priors": { "correlation": 0.9, "densities_together": 0.1 }"#,
            &["contradict each other", "that can be"],
        ),
        (r#""priors": { "shear_modulus": 0.3, "shear_over_young": 0.3 }"#, &["shear_modulus"]),
        (r#""masss": "1 kg""#, &["unknown key \"masss\"", "mass"]),
        (r#""ring_down": []"#, &["nothing that was measured", "\"lines\""]),
    ];
    let mut faults = vec![];
    for (member, says) in readings {
        let text = format!("{{ \"format\": \"sweetspot-readings/1\",\n{member} }}");
        folder.write("readings.json", text);
        let args = ["calibrate", "bat.json", "readings.json", "--out", "o.json", "--quiet"];
        faults.extend(folder.misanswer(&args, says));
    }
    folder.write("readings.json", "{ \"format\": \"sweetspot-readings/1\", \"mass\": 1 }");
    let options: &[(&[&str], &[&str])] = &[
        (&["--regions", "2 m"], &["--regions: found 2 m", "inside the bat"]),
        (&["--hold", "H"], &["'H'", "E, G, density"]),
        (&["--hold", "E", "--hold", "density", "--hold", "G"], &["everything", "not held"]),
    ];
    for (more, says) in options {
        let args = ["calibrate", "bat.json", "readings.json", "--out", "o.json", "--quiet"];
        faults.extend(folder.misanswer(&[&args[..], more].concat(), says));
    }
    let scatters: &[(&str, &[&str])] = &[
        (r#""name": "nothing""#, &["nothing that differs", "one at least"]),
        (r#""density": { "lognormal": "0 %" }"#, &["density.lognormal: found \"0 %\"", "above 0"]),
        (r#""density": { "normal": "4 %" }"#, &["unknown key \"normal\"", "lognormal"]),
        (
            r#""density": { "lognormal": "4 %" }, "tol": 0"#,
            &["tol: found 0", "above 0 and below 1"],
        ),
        (
            r#""density": { "lognormal": "4 %" }, "outputs": ["f1_h"]"#,
            &["outputs[0]: found \"f1_h\"", "f1_hz"],
        ),
        (
            r#""density": { "lognormal": "4 %" }, "correlation": [["density", "density", 0.5]]"#,
            &["another one than the first"],
        ),
        (
            r#""density": { "lognormal": "4 %" }, "correlation": [["density", "pitch", 0.5]]"#,
            &["correlation[0][1]: found \"pitch\"", "one of density"],
        ),
        (
            r#""density": { "lognormal": "4 %" }, "pitch": { "normal": "4 %" }, "correlation": [["density", "pitch", 1.5]]"#,
            &["correlation[0][2]: found 1.5", "between -1 and 1"],
        ),
        (
            r#""density": { "lognormal": "4 %" }, "pitch": { "normal": "4 %" }, "cor": { "normal": 0.1 },
            "correlation": [["density", "pitch", 0.9], ["pitch", "cor", 0.9], ["density", "cor", -0.9]]"#,
            &["contradict each other", "positive definite"],
        ),
        (r#""turning": { "normal": "3 oz" }"#, &["turning.normal: found unit \"oz\""]),
        (r#""turning": { "normal": "5 in" }"#, &["turning.normal: found \"5 in\"", "up to 2 mm"]),
        (r#""cor": { "normal": 0.9 }"#, &["cor.normal: found 0.9", "up to 0.1"]),
        (r#""turning": { "normal": "0.1 mm", "along": "9 m" }"#, &["turning.along", "0.02 to 2 m"]),
        (
            r#""shear_over_young": { "lognormal": "9 %" }"#,
            &["no shear modulus", "whose shear modulus is known"],
        ),
        (
            r#""impact": { "normal": "1 in" }, "outputs": ["f1_hz"]"#,
            &["nothing is asked of", "exit_speed_m_s@impact"],
        ),
        (r#""impact": { "normal": "1 in", "at": "2 m" }"#, &["impact.at: found 2 m", "on the bat"]),
        (r#""covariance": "none.json""#, &["cannot read none.json"]),
        (r#""covariance": "bat.json""#, &["bat.json:2:13: format", "sweetspot-calibrate/1"]),
        (
            r#""density": { "lognormal": "4 %" }, "covariance": "bat.json""#,
            &["\"density\" beside \"covariance\""],
        ),
        (r#""density": { "lognormal": "4 %" }, "ball": "plum""#, &["plum"]),
    ];
    for (member, says) in scatters {
        let text = format!("{{ \"format\": \"sweetspot-scatter/1\",\n{member} }}");
        folder.write("scatter.json", text);
        let args = ["scatter", "bat.json", "scatter.json", "--csv", "o.csv", "--quiet"];
        faults.extend(folder.misanswer(&args, says));
    }
    let text = r#"{ "format": "sweetspot-scatter/1", "density": { "lognormal": "4 %" }, "outputs": ["f1_hz"] }"#;
    folder.write("scatter.json", text);
    let options: &[(&[&str], &[&str])] = &[
        (&["--points", "100"], &["--points: found 100", "a power of two from 64"]),
        (&["--bats", "b", "--of", "f2_hz"], &["--of: found \"f2_hz\"", "f1_hz"]),
    ];
    for (more, says) in options {
        let args = ["scatter", "bat.json", "scatter.json", "--csv", "o.csv", "--quiet"];
        faults.extend(folder.misanswer(&[&args[..], more].concat(), says));
    }
    assert_none(faults);
}

/// A text that is not JSON is told as such.
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
