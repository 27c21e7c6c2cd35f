//! What a person sees for a mistake in a file: the line, a caret, the help.

use crate::common;

use std::path::Path;

use common::diagnostic::diagnostics;
use common::folder::Folder;
use sweetspot::Bat;
use sweetspot::base::error::Error;

/// Standard error of a run that must fail on its input.
fn told(folder: &Folder, args: &[&str]) -> String {
    let output = folder.run(args);
    assert_eq!(output.status.code(), Some(2), "{args:?}");
    assert!(output.stdout.is_empty(), "{args:?}");
    String::from_utf8(output.stderr).unwrap()
}

/// The messages about a bat file.
fn of_bat(folder: &Folder, text: &str) -> String {
    folder.write("my.json", text);
    told(folder, &["modes", "my.json"])
}

const GOOD: &str = r#"{
  "format": "sweetspot-bat/1",
  "material": { "density": 700, "youngs_modulus": 14e9 },
  "profile": {
    "x": [0, 0.4, 0.8],
    "radius": [0.02, 0.03, 0.02]
  }
}
"#;

#[test]
fn a_misspelt_key_is_underlined_and_its_neighbour_named() {
    let folder = Folder::new("key shown");
    let said = of_bat(&folder, &GOOD.replace("\"radius\"", "\"raduis\""));
    assert_eq!(
        said,
        r#"error: my.json:6:5: profile.raduis: found unknown key "raduis"
  |
6 |     "raduis": [0.02, 0.03, 0.02]
  |     ^^^^^^^^ expected "radius"
  |
  = help: did you mean radius?
"#
    );
    let said = of_bat(&folder, &GOOD.replace("\"radius\": [0", "\"radius\": [0], \"colour\": [0"));
    assert!(
        said.starts_with(
            r#"error: my.json:6:15: profile.radius: found 1 values
  |
6 |     "radius": [0], "colour": [0.02, 0.03, 0.02]
  |               ^^^ expected 3, one for each x

error: my.json:6:20: profile.colour: found unknown key "colour"
  |
6 |     "radius": [0], "colour": [0.02, 0.03, 0.02]
  |                    ^^^^^^^^
  |
  = expected: one of interpolation, unit, measured_from, csv, pieces, x,
              radius, diameter, inner_radius, inner_diameter,
              wall_thickness
"#
        ),
        "{said}"
    );
}

#[test]
fn tabs_a_mark_and_the_line_ends_of_windows_do_not_move_the_caret() {
    let folder = Folder::new("windows");
    let text = GOOD.replace("    \"x\": [0, 0.4", "\t\t\"x\": [0,\t-0.4").replace('\n', "\r\n");
    let said = of_bat(&folder, &format!("\u{feff}{text}"));
    assert_eq!(
        said,
        r#"error: my.json:5:12: profile.x[1]: found -0.4 m
  |
5 |         "x": [0,    -0.4, 0.8],
  |                     ^^^^ expected a position beyond x[0] (0 m)
"#
    );
}

#[test]
fn letters_that_are_several_bytes_or_columns_do_not_move_the_caret() {
    let folder = Folder::new("letters");
    let said = of_bat(&folder, "{ \"name\": \"é黒🏏\", \"name\": 1,");
    assert!(said.contains("my.json:1:28: found the end of the file"), "{said}");
    let text =
        GOOD.replace("{\n  \"format\"", "{ \"name\": \"é黒🏏\", \"source\": 7,\n  \"format\"");
    assert_eq!(
        of_bat(&folder, &text),
        r#"error: my.json:1:28: source: found 7
  |
1 | { "name": "é黒🏏", "source": 7,
  |                              ^ expected a text in quotes
"#
    );
}

#[test]
fn the_end_of_a_file_is_shown_after_its_last_letter() {
    let folder = Folder::new("end");
    assert_eq!(
        of_bat(&folder, "{\n  \"profile\": {\n\n"),
        r#"error: my.json:2:15: found the end of the file
  |
2 |   "profile": {
  |               ^ expected the rest of an object
  |
  = help: a closing } is missing
"#
    );
    assert_eq!(
        of_bat(&folder, ""),
        r#"error: my.json:1:1: found an empty file
  |
1 |
  | ^ expected a JSON object
"#
    );
    let said = of_bat(&folder, "{\n  // ash\n}");
    assert!(said.contains("2 |   // ash\n  |   ^^ expected JSON\n"), "{said}");
    assert!(said.contains("= help: JSON has no comments: write them as \"comment\""), "{said}");
}

#[test]
fn a_line_of_a_megabyte_is_shortened_around_the_caret() {
    let folder = Folder::new("megabyte");
    let list = |count: usize, bad: &str, value: &str| {
        format!("[{}{bad}{}]", "0.02, ".repeat(count), format!(", {value}").repeat(count))
    };
    let x: Vec<String> = (0..200_001).map(|k| (f64::from(k) * 4e-6).to_string()).collect();
    let profile =
        format!("\"x\": [{}], \"radius\": {}", x.join(", "), list(100_000, "\"1 inn\"", "0.02"));
    let text = GOOD
        .replace('\n', " ")
        .replace("\"x\": [0, 0.4, 0.8],     \"radius\": [0.02, 0.03, 0.02]", &profile);
    assert!(text.len() > 3_000_000);
    let column = text.find("\"1 inn\"").unwrap() + 1;
    assert_eq!(
        of_bat(&folder, &text),
        format!(
            r#"error: my.json:1:{column}: profile.radius[100000]: found unknown unit "inn"
  |
1 | …, 0.02, 0.02, 0.02, 0.02, 0.02, 0.02, 0.02, "1 inn", 0.02, 0.02, 0.02, 0…
  |                                              ^^^^^^^
  |
  = expected: a length such as "33 in" or a number in m
  = help: did you mean in?
"#
        )
    );
}

#[test]
fn cells_of_a_table_are_shown_in_their_rows() {
    let folder = Folder::new("cells");
    let bat = GOOD.replace("\"x\": [0, 0.4, 0.8],", "\"csv\": \"t.csv\"");
    let bat = bat.replace("\"radius\": [0.02, 0.03, 0.02]", "");
    folder.write(
        "t.csv",
        "x_in, diameter_in\r\n0,1\r\n# here it goes wrong\r\n4,  1 ½ in\r\n8,,\r\n9,-\r\n",
    );
    assert_eq!(
        of_bat(&folder, &bat),
        r#"error: t.csv:4:5: diameter: found "1 ½ in"
  |
4 | 4,  1 ½ in
  |     ^^^^^^ expected a finite number (the unit stands in the header)

error: t.csv:5:3: diameter: found ""
  |
5 | 8,,
  |   ^ expected a finite number (the unit stands in the header)

error: t.csv:6:3: diameter: found "-"
  |
6 | 9,-
  |   ^ expected a finite number (the unit stands in the header)

error: 3 mistakes in t.csv
"#
    );
    folder.write("t.csv", "x_in,diamter_inn\n0,1\n");
    let said = of_bat(&folder, &bat);
    assert!(said.starts_with("error: t.csv:1:6: header: found column \"diamter_inn\""), "{said}");
    assert!(said.ends_with("  = help: did you mean diameter?\n"), "{said}");
    let rows: String = (0..25).map(|k| format!("{k},bad\n")).collect();
    folder.write("t.csv", format!("x_in,diameter_in\n{rows}"));
    let said = of_bat(&folder, &bat);
    assert_eq!(diagnostics(&said).0.len(), 10, "{said}");
    assert!(said.ends_with("\nerror: 25 mistakes in t.csv: these and 15 more\n"), "{said}");
}

#[test]
fn the_letter_of_a_formula_that_is_wrong_is_marked() {
    let folder = Folder::new("formula shown");
    let pieces = "\"pieces\": [{ \"from\": 0, \"to\": 1, \"formula\": \"0.02 + tanhh(x)\" }]";
    let bat = GOOD.replace("\"x\": [0, 0.4, 0.8],", pieces);
    let said = of_bat(&folder, &bat.replace("\"radius\": [0.02, 0.03, 0.02]", ""));
    let lines: Vec<&str> = said.lines().collect();
    assert!(
        lines[0].starts_with("error: my.json:5:57: profile.pieces[0].formula: found \"tanhh\"")
    );
    let caret = lines[3].find('^').unwrap();
    assert_eq!(&lines[2][caret..caret + 5], "tanhh", "{said}");
    assert_eq!(lines[3].matches('^').count(), 5, "{said}");
}

#[test]
fn independent_mistakes_are_all_told_in_the_order_of_the_file() {
    let folder = Folder::new("five");
    let text = r#"{
  "format": "sweetspot-bat/1",
  "supports": [{ "x": 0.1, "type": "fixed" }, { "x": "2 s", "type": "pinned" }],
  "nmae": "five and more",
  "profile": {
    "interpolation": "linaer",
    "x": [0, 0.5, 0.4, 0.8],
    "radius": [0.02, 0.03, -0.02, 0.02]
  },
  "weighed": { "mass": "31 lbf" },
  "material": { "density": -700, "youngs_modulus": "14 GPA" }
}"#;
    let (each, summary) = diagnostics(&of_bat(&folder, text));
    let places: Vec<String> = each
        .iter()
        .map(|one| one.title.splitn(5, ": ").take(2).collect::<Vec<_>>().join(": "))
        .collect();
    let expected = [
        "my.json:3:36: supports[0].type",
        "my.json:3:54: supports[1].x",
        "my.json:4:3: nmae",
        "my.json:6:22: profile.interpolation",
        "my.json:7:19: profile.x[2]",
        "my.json:8:28: profile.radius[2]",
        "my.json:10:24: weighed.mass",
        "my.json:11:28: material.density",
        "my.json:11:52: material.youngs_modulus",
    ];
    assert_eq!(places, expected);
    assert_eq!(summary.unwrap(), "9 mistakes in my.json");
    assert!(each.iter().all(|one| one.misplaced(&folder.0).is_none()), "{each:?}");
    // To a library they are one error in one line.
    let error = Bat::from_text("my.json", text, Path::new("")).unwrap_err();
    let said = error.to_string();
    assert!(
        said.starts_with("my.json:3:36: supports[0].type: found \"fixed\", expected"),
        "{said}"
    );
    assert!(said.ends_with("(and 8 more mistakes)") && !said.contains('\n'), "{said}");
    let Error::Several { shown, more: 0 } = error else { panic!("{error:?}") };
    assert_eq!(shown.len(), 9);
}

#[test]
fn nothing_is_told_that_follows_from_another_mistake() {
    let folder = Folder::new("follows");
    let tip = "\"attachments\": [{ \"x\": 33, \"mass\": 0.1 }], \"profile\"";
    let with_tip = GOOD.replace("\"profile\"", tip);
    for (text, field) in [
        // Without a profile it is unknown what is beyond it.
        (with_tip.replace("0.4, 0.8", "0.4, \"0.8\""), "profile.x[2]"),
        (with_tip.replace("\"x\": [0, 0.4, 0.8]", "\"x\": 7"), "profile.x"),
        (with_tip.replace("\"x\": [0, 0.4", "\"unit\": \"inn\", \"x\": [0, -0.4"), "profile.unit"),
        // Weighing could have replaced the density.
        (
            GOOD.replace("\"density\": 700, ", "")
                .replace("\"profile\"", "\"weighed\": { \"mass\": \"31\" }, \"profile\""),
            "weighed.mass",
        ),
        // A misspelt key is not reported as missing too.
        (GOOD.replace("\"material\"", "\"materail\""), "materail"),
        (GOOD.replace("\"density\"", "\"densty\""), "material.densty"),
        (GOOD.replace("\"x\"", "\"X\""), "profile.X"),
        // No shear modulus follows from a modulus that could not be read.
        (GOOD.replace("14e9", "\"14\", \"poisson_ratio\": 0.3"), "material.youngs_modulus"),
    ] {
        let (each, summary) = diagnostics(&of_bat(&folder, &text));
        assert_eq!((each.len(), summary), (1, None), "{each:?}");
        assert!(each[0].title.contains(&format!(": {field}: found")), "{each:?}");
    }
}

#[test]
fn ten_mistakes_are_shown_and_the_others_counted() {
    let folder = Folder::new("many");
    let keys: String = (0..40).map(|k| format!("  \"key {k}\": {k},\n")).collect();
    let said = of_bat(&folder, &GOOD.replacen("{\n", &format!("{{\n{keys}"), 1));
    let (each, summary) = diagnostics(&said);
    let lines: Vec<usize> = each.iter().map(|one| one.line.as_ref().unwrap().0).collect();
    assert_eq!(lines, (2..12).collect::<Vec<_>>());
    assert_eq!(summary.unwrap(), "40 mistakes in my.json: these and 30 more");
    let items = vec!["{ \"x\": 0.1, \"type\": \"fixed\" }"; 400].join(", ");
    let supports = format!("\"supports\": [{items}], \"profile\"");
    let said = of_bat(&folder, &GOOD.replace("\"profile\"", &supports));
    assert!(said.ends_with("error: 400 mistakes in my.json: these and 390 more\n"), "{said}");
    let text = r#"{ "format": "sweetspot-bat/1", "name": "d", "material": { "density": 700, "youngs_modulus": 15e9 },
        "profile": { "interpolation": "linear", "x": [X], "radius": [X] } }"#;
    let said = of_bat(&folder, &text.replace('X', &vec!["\"a\""; 50_000].join(", ")));
    assert!(said.ends_with("error: 100000 mistakes in my.json: these and 99990 more\n"), "{said}");
}

#[test]
fn comments_may_stand_in_every_object() {
    let folder = Folder::new("comments");
    let text = r#"{
  "comment": ["A bat with a word", "about everything."],
  "format": "sweetspot-bat/1",
  "material": { "comment": "", "density": 700, "youngs_modulus": 14e9 },
  "profile": { "comment": "by formula", "pieces": [
    { "comment": "all of it", "from": 0, "to": 0.8, "formula": "0.02" } ] },
  "weighed": { "comment": [], "mass": 1.2 },
  "regions": [ { "comment": "cork", "from": 0.5, "to": 0.7, "material": {
    "comment": "softer", "density": 700, "youngs_modulus": 13e9 } } ],
  "attachments": [ { "comment": "a ring", "x": 0.7, "mass": 0.1 } ],
  "tapes": [ { "comment": "tape", "from": 0, "to": 0.2, "mass": 0.01 } ],
  "absorbers": [ { "comment": "puck", "x": 0.1, "mass": 0.01, "frequency": 170 } ],
  "joints": [ { "comment": "glue", "x": 0.4, "rotational_stiffness": 1e4 } ],
  "supports": [ { "comment": "stand", "x": 0.3, "type": "pinned" } ],
  "grip": { "comment": "hands", "from": 0, "to": 0.1, "stiffness": 1e5 }
}"#;
    let commented = Bat::from_text("my.json", text, Path::new("")).unwrap();
    let plain: Vec<&str> = text.lines().filter(|line| !line.contains("A bat with")).collect();
    let mut plain = plain.join("\n");
    while let Some(start) = plain.find("\"comment\": ") {
        let end = start + plain[start..].find(", ").unwrap() + 2;
        plain.replace_range(start..end, "");
    }
    assert!(!plain.contains("comment"));
    assert_eq!(commented, Bat::from_text("my.json", &plain, Path::new("")).unwrap());
    let said = of_bat(&folder, &text.replace("\"stand\"", "{}"));
    assert!(said.contains("supports[0].comment: found an object\n"), "{said}");
    assert!(said.contains("expected a text, or a list of texts\n"), "{said}");

    let ball = "{ \"comment\": \"soft\", \"format\": \"sweetspot-ball/1\", \"mass\": 0.145,
        \"radius\": 0.0366, \"cor\": 0.5 }";
    folder.write("ball.json", ball);
    folder.write("my.json", GOOD);
    let hit = ["hit", "my.json", "--ball", "ball.json", "--model", "rigid", "--points", "1"];
    assert!(folder.run(&hit).status.success());
    folder.write("ball.json", ball.replace("\"soft\"", "7"));
    assert!(told(&folder, &hit).contains("ball.json:1:14: comment: found 7\n"));
}

#[test]
fn another_major_version_is_refused_with_what_to_do() {
    let folder = Folder::new("versions");
    let said = of_bat(&folder, &GOOD.replace("sweetspot-bat/1", "sweetspot-bat/2"));
    let (each, _) = diagnostics(&said);
    assert_eq!(each[0].title, "my.json:2:13: format: found \"sweetspot-bat/2\"");
    assert_eq!(each[0].expected, "\"sweetspot-bat/1\"");
    let reads = format!("this is version {} of sweetspot, which reads", env!("CARGO_PKG_VERSION"));
    assert!(each[0].help.starts_with(&reads), "{said}");
    assert!(each[0].help.contains("get the version that it was written for"), "{said}");
    // Its keys are not criticised, because they may belong to that version.
    let newer = GOOD.replace("sweetspot-bat/1\"", "sweetspot-bat/2\", \"new\": 1");
    assert_eq!(diagnostics(&of_bat(&folder, &newer)).0.len(), 1);
    folder.write("my.json", GOOD);
    for (format, help) in [("sweetspot-ball/2", &*reads), ("sweetspot-bat/1", "this is a bat")] {
        folder.write("ball.json", format!("{{ \"format\": \"{format}\", \"spin\": 1 }}"));
        let (each, _) = diagnostics(&told(&folder, &["hit", "my.json", "--ball", "ball.json"]));
        assert_eq!(each.len(), 1);
        assert_eq!(each[0].expected, "\"sweetspot-ball/1\"");
        assert!(each[0].help.starts_with(help), "{each:?}");
    }
    for (format, help) in [("sweetspot-ball/1", "a ball"), ("sweetspot-modes/1", "a result")] {
        let said = of_bat(&folder, &GOOD.replace("sweetspot-bat/1", format));
        assert!(diagnostics(&said).0[0].help.contains(help), "{said}");
    }
}

#[test]
fn a_wrong_word_on_the_command_line_has_its_neighbour_named() {
    let folder = Folder::new("words");
    folder.write("my.json", GOOD);
    let (each, _) = diagnostics(&told(&folder, &["hit", "my.json", "--ball", "sofball"]));
    assert!(each[0].title.starts_with("--ball: found sofball, which cannot be read"), "{each:?}");
    assert_eq!(each[0].help, "did you mean softball?");
}

#[test]
fn colour_is_for_terminals_or_where_it_is_asked_for() {
    let folder = Folder::new("colour");
    folder.write("my.json", GOOD.replace("700", "-700"));
    let said = |set: &[(&str, &str)]| {
        let mut command = folder.command(&["modes", "my.json"]);
        for name in ["NO_COLOR", "CLICOLOR", "CLICOLOR_FORCE", "TERM"] {
            command.env_remove(name);
        }
        let output = command.envs(set.iter().copied()).output().unwrap();
        String::from_utf8(output.stderr).unwrap()
    };
    let plain = said(&[]);
    assert!(!plain.contains('\u{1b}'), "{plain:?}");
    let coloured = said(&[("CLICOLOR_FORCE", "1"), ("NO_COLOR", "")]);
    assert!(coloured.contains("\u{1b}["), "{coloured:?}");
    // The messages are the same.
    let mut stripped = coloured.clone();
    while let Some(start) = stripped.find("\u{1b}[") {
        let end = start + stripped[start..].find('m').unwrap() + 1;
        stripped.replace_range(start..end, "");
    }
    assert_eq!(stripped, plain);
    for off in [
        &[("CLICOLOR_FORCE", "1"), ("NO_COLOR", "1")][..],
        &[("CLICOLOR_FORCE", "0")],
        &[("TERM", "xterm-256color")],
        &[("TERM", "dumb")],
    ] {
        assert_eq!(said(off), plain, "{off:?}");
    }
}

#[test]
fn nothing_in_a_file_reaches_the_terminal_raw() {
    let folder = Folder::new("raw");
    for strange in ["\u{1b}[2J", "\u{7}", "\u{9b}31m", "\u{202e}", "\u{2066}", "\u{7f}", "\u{85}"] {
        let text = GOOD.replace("\"material\"", &format!("\"a{strange}b\": 1, \"material\""));
        folder.write("my.json", &text);
        let output = folder.run(&["modes", "my.json"]);
        let said = String::from_utf8(output.stderr).unwrap();
        let raw = said
            .chars()
            .any(|c| c.is_control() && c != '\n' || strange.contains(c) && !c.is_ascii());
        assert!(!raw, "{said:?}");
    }
    // Nor on standard output, by a name; and a name is no line of its own.
    folder.write(
        "my.json",
        GOOD.replace("\"material\"", "\"name\": \"a\\u001b[31m\\u202e\\nb\", \"material\""),
    );
    for verb in [
        "modes",
        "analyze",
        "analyze --full",
        "advise",
        "compare my.json",
        "hit",
        "ring --hit 0.5",
        "bbcor",
        "frf --at 0.5",
        "lathe",
        "trade",
    ] {
        let [verb, rest @ ..] = &verb.split(' ').collect::<Vec<_>>()[..] else { unreachable!() };
        let output = folder.run(&[&[verb, "my.json"], rest].concat());
        let said = String::from_utf8(output.stdout).unwrap();
        assert!(said.contains(r"a\u{1b}[31m\u{202e}\nb"), "{verb} {said:?}");
        assert!(!said.contains(['\u{1b}', '\u{202e}']), "{verb} {said:?}");
    }
    folder.write("t.csv", "x_m,radius_m\n0,\u{1b}[31m7\n");
    let csv = GOOD.replace("\"x\": [0, 0.4, 0.8],", "\"csv\": \"t.csv\"");
    let said = of_bat(&folder, &csv.replace("\"radius\": [0.02, 0.03, 0.02]", ""));
    assert_eq!(
        said,
        r#"error: t.csv:2:3: radius: found "\u{1b}[31m7"
  |
2 | 0,\u{1b}[31m7
  |   ^^^^^^^^^^^ expected a finite number (the unit stands in the header)
"#
    );
}
