//! What a person sees at a terminal, and the output in a pipe.

use crate::common;

use std::fs;
use std::io::Write;
use std::process::Stdio;

use common::commands::wider;
use common::folder::Folder;
use sweetspot::Bat;

const MESHES: &str = concat!(env!("SWEETSPOT_TOP"), "/meshes");

fn mesh(name: &str) -> String {
    format!("{MESHES}/{name}.json")
}

/// The faults in the table of that command: more than 80 columns, except for lines with the name of the bat, or colour
/// in a pipe.
fn table_faults(folder: &Folder, args: &[&str], name: &str) -> Vec<String> {
    let output = folder.run(args);
    let text = String::from_utf8_lossy(&output.stdout);
    let wide = wider(&text, 80).into_iter().filter(|line| !line.contains(name));
    let mut faults: Vec<String> = wide.map(|line| format!("{args:?}: {line}")).collect();
    if output.status.code() != Some(0) || text.contains('\u{1b}') {
        faults.push(format!("{args:?}: {output:?}"));
    }
    faults
}

#[test]
fn tables_fit_eighty_columns_on_every_bat_and_in_every_unit() {
    let folder = Folder::new("columns");
    let mut faults = Vec::new();
    for entry in fs::read_dir(MESHES).unwrap() {
        let path = entry.unwrap().path();
        let bat = path.to_str().unwrap();
        let read = Bat::from_file(&path).unwrap();
        let name = read.name();
        for args in [
            &["analyze", bat][..],
            &["analyze", bat, "--full"],
            &["modes", bat, "-n", "25"],
            &[
                "hit",
                bat,
                "--points",
                "3",
                "--reference-inertia",
                "10000 oz in2",
                "--swing-exponent",
                "0.25",
            ],
            &["ring", bat, "--hit", "60 cm", "--watch", "2 in,4 in,6 in,8 in", "--full"],
            &["frf", bat, "--at", "0.6", "--points", "3"],
            &["advise", bat, "--full"],
        ] {
            faults.extend(table_faults(&folder, args, name));
        }
        for units in ["si", "us"] {
            faults.extend(table_faults(&folder, &["modes", bat, "--units", units], name));
        }
    }
    let bat = mesh("r161");
    for units in ["si", "us", "both"] {
        for args in
            [&["analyze", &bat, "--full"][..], &["hit", &bat, "--points", "5"], &["materials"]]
        {
            let args = [args, &["--units", units]].concat();
            faults.extend(table_faults(&folder, &args, "Louisville"));
        }
    }
    assert!(faults.is_empty(), "{faults:#?}");
}

#[test]
fn trade_fits_eighty_columns() {
    let folder = Folder::new("trade-columns");
    let bat = mesh("cone");
    for more in [&["-n", "3"][..], &["-n", "12"], &["-n", "5", "--u-curve"]] {
        let args = [&["trade", &bat, "--budget", "500 ms", "--full"][..], more].concat();
        let wide = wider(&folder.text(&args), 80);
        assert!(wide.is_empty(), "{more:?} {wide:#?}");
    }
}

/// Settings by which a person selects colours.
const COLOUR: [&str; 3] = ["NO_COLOR", "CLICOLOR", "CLICOLOR_FORCE"];

#[test]
fn a_pipe_gets_colour_only_if_it_is_forced() {
    let folder = Folder::new("colour");
    let coloured = |settings: &[(&str, &str)]| {
        let mut command = folder.command(&["modes", &mesh("dowel"), "-n", "2"]);
        for name in COLOUR {
            command.env_remove(name);
        }
        let output = command.envs(settings.iter().copied()).output().unwrap();
        String::from_utf8(output.stdout).unwrap().contains('\u{1b}')
    };
    assert!(!coloured(&[]) && coloured(&[("CLICOLOR_FORCE", "1")]));
    assert!(!coloured(&[("CLICOLOR_FORCE", "1"), ("NO_COLOR", "1")]));
    let mut json = folder.command(&["modes", &mesh("dowel"), "--json", "-"]);
    let output = json.env("CLICOLOR_FORCE", "1").output().unwrap();
    assert!(serde_json::from_slice::<serde_json::Value>(&output.stdout).is_ok());
}

/// The output of a command on a terminal; None where there is no `script` to emulate one.
#[cfg(target_os = "linux")]
fn seen(folder: &Folder, args: &str, settings: &[(&str, &str)]) -> Option<String> {
    let command = format!("{} {args}", env!("CARGO_BIN_EXE_sweetspot"));
    let mut script = std::process::Command::new("script");
    script.args(["-qec", &command, "/dev/null"]).current_dir(&folder.0).stdin(Stdio::null());
    for name in COLOUR {
        script.env_remove(name);
    }
    script.env("TERM", "xterm").envs(settings.iter().copied());
    Some(String::from_utf8_lossy(&script.output().ok()?.stdout).into_owned())
}

#[cfg(target_os = "linux")]
#[test]
fn a_blow_has_a_screen_at_a_terminal_and_csv_in_a_pipe() {
    let folder = Folder::new("blow");
    let blow = format!("ring {} --at 0.6 --impulse \"1 N s\"", mesh("dowel"));
    let Some(shown) = seen(&folder, &blow, &[]) else { return };
    assert!(shown.contains("largest") && shown.contains("--csv FILE"), "{shown}");
    assert!(!shown.contains("x_m,") && shown.lines().count() < 24, "{shown}");
    let piped = folder.text(&["ring", &mesh("dowel"), "--at", "0.6", "--impulse", "1 N s"]);
    assert!(piped.starts_with("x_m,w_m_at_0_s,") && piped.lines().count() == 102, "{piped}");
    let csv = seen(&folder, &format!("{blow} --csv - --quiet"), &[]).unwrap();
    assert_eq!(csv.replace('\r', ""), piped);
}

#[cfg(target_os = "linux")]
#[test]
fn a_terminal_gets_bold_headings_unless_it_wants_none() {
    let folder = Folder::new("bold");
    let modes = format!("modes {} -n 2", mesh("dowel"));
    let Some(plain) = seen(&folder, &modes, &[]) else { return };
    assert!(plain.contains("\u{1b}[1mBending modes"), "{plain}");
    for setting in [("NO_COLOR", "1"), ("TERM", "dumb"), ("CLICOLOR", "0")] {
        // Where `CI` is set, some libraries colour even for a dumb terminal.
        let seen = seen(&folder, &modes, &[setting, ("CI", "true")]).unwrap();
        assert!(seen.contains("Bending modes") && !seen.contains('\u{1b}'), "{setting:?} {seen}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_long_wait_shows_a_bar_with_the_time_left_and_takes_it_away() {
    let folder = Folder::new("bar");
    let trade = format!("trade {} -n 3 --budget '3 s'", mesh("dowel"));
    let Some(seen) = seen(&folder, &trade, &[]) else { return };
    let (waiting, table) = seen.split_once("Speed against accuracy").unwrap();
    assert!(waiting.contains(" %, ") && waiting.contains(" left  "), "{waiting}");
    let line = waiting.rsplit("\u{1b}[2K").next().unwrap();
    assert!(!line.contains(" left ") && !table.contains(" left  "), "{line}");
    let quiet = self::seen(&folder, &format!("{trade} --quiet"), &[]).unwrap();
    assert!(!quiet.contains("\u{1b}[2K"), "{quiet}");
    // At a pipe nobody waits.
    let output = folder.run(&["trade", &mesh("r161"), "-n", "3", "--budget", "1 s"]);
    assert!(output.stderr.is_empty(), "{output:?}");
}

#[test]
fn the_sketch_is_ascii_where_the_locale_is() {
    let folder = Folder::new("locale");
    let sketch = |locale: &str| {
        let args = ["modes", &mesh("r161"), "-n", "1", "--units", "si", "--full"];
        let output = folder.command(&args).env("LC_ALL", locale).output().unwrap();
        String::from_utf8(output.stdout).unwrap()
    };
    assert!(sketch("en_GB.UTF-8").contains("██▄"));
    assert!(sketch("C").contains("##.") && !sketch("C").contains('█'));
}

#[cfg(unix)]
#[test]
fn an_interrupt_leaves_no_half_file_and_the_old_one() {
    const TRIES: usize = 40;
    let folder = Folder::new("interrupt");
    let bat = mesh("dowel");
    // Some ten megabytes, so that there is time to observe a partial file.
    let long = ["modes", &bat, "-n", "10", "--shape-points", "40000", "--json", "out.json"];
    for (signal, number) in [("-INT", 2), ("-TERM", 15), ("-HUP", 1)] {
        let in_time = (0..TRIES).any(|_| stopped(&folder, &long, signal, 128 + number));
        assert!(in_time, "always done before {signal}");
    }
}

/// Runs it and sends that signal, which ends it with that code, while it writes; whether it was in
/// time.
#[cfg(unix)]
fn stopped(folder: &Folder, long: &[&str], signal: &str, ended: i32) -> bool {
    folder.write("out.json", "\"old\"");
    let mut child = folder.attentive(long).stdout(Stdio::null()).spawn().unwrap();
    let being_written = || folder.names().iter().any(|name| name.ends_with(".part"));
    while !being_written() && child.try_wait().unwrap().is_none() {
        std::thread::yield_now();
    }
    let mut kill = std::process::Command::new("kill");
    kill.args([signal, &child.id().to_string()]).stderr(Stdio::null()).status().unwrap();
    let code = child.wait().unwrap().code();
    assert_eq!(folder.names(), ["out.json"], "{code:?}");
    let left = folder.read("out.json");
    assert!(serde_json::from_str::<serde_json::Value>(&left).is_ok(), "{code:?}");
    // Or it was done before the signal came.
    assert!(code == Some(0) || code == Some(ended), "{code:?}");
    code == Some(ended) && left == "\"old\""
}

#[test]
fn completions_name_every_verb_and_the_shell_takes_them() {
    let folder = Folder::new("completions");
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = folder.text(&["completions", shell]);
        for word in ["analyze", "swing-speed", "materials"] {
            assert!(script.contains(word), "{shell} {word}");
        }
        // These complete values, too.
        if ["bash", "zsh", "fish"].contains(&shell) {
            for value in ["shift-invert", "energy-loss", "accelerance", "torpedo", "vtu"] {
                assert!(script.contains(value), "{shell} {value}");
            }
        }
        folder.write(shell, script);
    }
    for shell in ["bash", "zsh"] {
        let mut command = std::process::Command::new(shell);
        // Without such a shell there is nothing to test.
        if let Ok(output) = command.arg("-n").arg(folder.0.join(shell)).output() {
            assert!(output.status.success() && output.stderr.is_empty(), "{shell} {output:?}");
        }
    }
}

#[test]
fn manual_pages_are_roff_with_the_words_of_the_help() {
    let folder = Folder::new("man");
    assert!(folder.text(&["man"]).contains("Start here"));
    let written = folder.text(&["man", "--out", "man1"]);
    let pages: Vec<&str> = written.lines().collect();
    assert!(
        pages.len() > 10 && pages.iter().any(|p| p.ends_with("sweetspot-modes.1")),
        "{written}"
    );
    for page in pages {
        let text = folder.read(page);
        assert!(text.lines().any(|line| line.starts_with(".TH sweetspot")), "{page}");
        assert!(text.contains(".SH NAME") && text.contains(".SH SYNOPSIS"), "{page}");
        let mut man = std::process::Command::new("man");
        // In containers, manual pages are missing and `man` either says so and succeeds, or does not exist.
        if let Ok(output) = man.args(["-l", page]).current_dir(&folder.0).output() {
            assert!(output.status.success(), "{page} {output:?}");
        }
    }
    // The first page names the others, and no more.
    let first = folder.read("man1/sweetspot.1");
    let named: Vec<&str> = first.lines().filter(|line| line.ends_with("(1)")).collect();
    assert_eq!(named.len() + 1, folder.read_names("man1").len(), "{named:?}");
    for name in named {
        let name = name.replace('\\', "").replace("(1)", ".1");
        assert!(folder.read_names("man1").contains(&name), "{name}");
    }
    assert_eq!(folder.text(&["man", "modes"]), folder.read("man1/sweetspot-modes.1"));
    let output = folder.run(&["man", "mods"]);
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.code() == Some(2) && told.contains("did you mean modes"), "{told}");
}

/// Runs `new` with these answers.
fn answered(folder: &Folder, args: &[&str], answers: &str) -> std::process::Output {
    typed(folder, args, answers.as_bytes())
}

/// As [`answered`], with answers of any bytes.
fn typed(folder: &Folder, args: &[&str], answers: &[u8]) -> std::process::Output {
    let mut command = folder.command(&[&["new", "--ask"], args].concat());
    let piped = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = piped.spawn().unwrap();
    // It may have stopped before the last answer.
    let _ = child.stdin.take().unwrap().write_all(answers);
    child.wait_with_output().unwrap()
}

#[test]
fn answers_make_a_bat_file_of_that_mass_and_wrong_ones_are_asked_again() {
    let folder = Folder::new("asked");
    let answers = "Birch, mine\ncm\n8.4\n84\n880\n880 g\npine\n5\n\
                   5.0\n4.9\n2.6, 3\n99, 3\n1,234\n10, 2.7\n\n6.4\n\n\n\n\n\n";
    let output = answered(&folder, &[], answers);
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{told}");
    for reason in [
        "8.4 cm, expected a bat's length",
        "found 880, expected its unit",
        "found \"pine\", expected one of white-ash",
        "99 cm, expected no place beyond the tip",
        "1.234 or 1234",
    ] {
        let words: Vec<&str> = told.split_whitespace().collect();
        assert!(words.join(" ").contains(reason), "{reason}: {told}");
    }
    assert_eq!(folder.names(), ["birch-mine.json"]);
    let bat = Bat::from_file(folder.0.join("birch-mine.json")).unwrap();
    assert_eq!(bat.name(), "Birch, mine");
    assert!((bat.length() - 0.84).abs() < 1e-12 && (bat.inertia().mass - 0.88).abs() < 1e-12);
    assert_eq!(bat.material().name.as_deref(), Some("yellow-birch"));
    for (x, diameter) in [(0.0, 0.05), (0.01, 0.049), (0.026, 0.03), (0.1, 0.027), (0.84, 0.064)] {
        assert!((2.0 * bat.profile().at(x).outer - diameter).abs() < 1e-12, "{x}");
    }
    let shown = String::from_utf8(output.stdout).unwrap();
    assert!(shown.contains("measured") && shown.contains("sweetspot analyze birch-mine.json"));
    // The default name of the file is taken then, and another one is asked for; the answers are printed where the file
    // cannot be written.
    let again = answered(&folder, &[], &("birch mine!\n".to_owned() + answers));
    let told = String::from_utf8_lossy(&again.stderr).into_owned();
    assert!(again.status.code() == Some(2) && told.contains("birch-mine.json, which is there"));
    let lost = answered(&folder, &["none/mine.json"], answers);
    let told = String::from_utf8_lossy(&lost.stderr).into_owned();
    assert!(told.contains("was not written") && told.contains("\"880 g\""), "{told}");
    // The same once more would replace it.
    let again = answered(&folder, &["birch-mine.json"], answers);
    assert_eq!(again.status.code(), Some(2), "{again:?}");
}

/// Answers to every question of `new`.
const ANSWERS: &str =
    "Mine\nin\n33\n31 oz\nwhite-ash\n1.9\n1.2\n\n2.5\nno\nnone\n22\n170\n10, 0.7 oz\n";

#[test]
fn an_interrupted_dialogue_goes_on_where_it_stopped() {
    let folder = Folder::new("ended");
    assert_eq!(answered(&folder, &["whole.json"], ANSWERS).status.code(), Some(0));
    let whole = folder.read("whole.json");
    for line in ["\"balance_point\": \"22 in\"", "\"first_bending_hz\": \"170 Hz\"", "\"tapes\""] {
        assert!(whole.contains(line), "{whole}");
    }
    for (end, _) in ANSWERS.match_indices('\n').rev().skip(1) {
        let output = answered(&folder, &["mine.json"], &ANSWERS[..=end]);
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(
            output.status.code() == Some(2) && told.contains("kept in mine.json.draft"),
            "{told}"
        );
        assert_eq!(folder.names(), ["mine.json.draft", "whole.json"], "{end}");
        let rest = format!("yes\n{}", &ANSWERS[end + 1..]);
        let output = answered(&folder, &["mine.json"], &rest);
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(told.contains("Go on with the draft of 'Mine'"), "{told}");
        assert!(output.status.code() == Some(0) && told.contains("Going on after the"), "{told}");
        assert_eq!(folder.names(), ["mine.json", "whole.json"], "{end}");
        assert_eq!(folder.read("mine.json"), whole, "{end}");
        fs::remove_file(folder.0.join("mine.json")).unwrap();
    }
    // A file of that name that is no draft is kept.
    folder.write("mine.json.draft", "mine");
    assert_eq!(answered(&folder, &["mine.json"], ANSWERS).status.code(), Some(0));
    assert_eq!((folder.read("mine.json"), folder.read("mine.json.draft")), (whole, "mine".into()));
}

#[cfg(unix)]
#[test]
fn an_interrupt_keeps_the_answers() {
    let folder = Folder::new("kept");
    let mut command = folder.attentive(&["new", "mine.json", "--ask"]);
    let mut child = command.stdin(Stdio::piped()).stderr(Stdio::null()).spawn().unwrap();
    let mut answers = child.stdin.take().unwrap();
    answers.write_all(b"Mine\nin\n33\n31 oz\n").unwrap();
    let kept = || fs::read_to_string(folder.0.join("mine.json.draft")).unwrap_or_default();
    while !kept().contains("mass: 31 oz") {
        std::thread::yield_now();
    }
    let mut kill = std::process::Command::new("kill");
    kill.args(["-INT", &child.id().to_string()]).status().unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(130));
    let rest = format!("y\n{}", ANSWERS.split_once("31 oz\n").unwrap().1);
    assert_eq!(answered(&folder, &["mine.json"], &rest).status.code(), Some(0));
    assert_eq!(folder.names(), ["mine.json"]);
}

#[test]
fn who_quits_keeps_the_answers_and_a_draft_is_of_one_bat() {
    let folder = Folder::new("quit");
    for word in ["quit", "exit", "q"] {
        let output = answered(&folder, &["mine.json"], &format!("Mine\nin\n33\n{word}\n31 oz\n"));
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        let plain = told.split_whitespace().collect::<Vec<_>>().join(" ");
        assert_eq!(output.status.code(), Some(0), "{told}");
        assert!(plain.contains("The answers are kept in mine.json.draft"), "{told}");
        assert!(output.stdout.is_empty() && folder.names() == ["mine.json.draft"], "{word}");
        fs::remove_file(folder.0.join("mine.json.draft")).unwrap();
    }
    // A dialogue without a file has a draft that any bat may be in.
    answered(&folder, &[], "Mine\nin\n33\nquit\n");
    assert_eq!(folder.names(), ["sweetspot-new.draft"]);
    // Another name of a bat on the command line keeps it.
    let kept = folder.read("sweetspot-new.draft");
    let all = ANSWERS.split_once('\n').unwrap().1;
    let output = answered(&folder, &["--name", "Other"], all);
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    let plain = told.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(output.status.code() == Some(0) && plain.contains("of another bat, 'Mine'"), "{told}");
    assert!(plain.contains("kept in sweetspot-new-2.draft until"), "{told}");
    assert_eq!(folder.read("sweetspot-new.draft"), kept);
    assert_eq!(Bat::from_file(folder.0.join("other.json")).unwrap().name(), "Other");
    // The answer no begins anew, and nothing of the draft is in the other bat.
    let third = format!("no\n{}", ANSWERS.replace("Mine", "Third").replace("\n33\n", "\n34\n"));
    assert_eq!(answered(&folder, &[], &third).status.code(), Some(0));
    let third = Bat::from_file(folder.0.join("third.json")).unwrap();
    assert!(third.name() == "Third" && (third.length() - 34.0 * 0.0254).abs() < 1e-12);
    assert_eq!(folder.names(), ["other.json", "third.json"]);
}

#[cfg(unix)]
#[test]
fn what_is_no_draft_stays_as_it_is_and_the_answers_are_kept_beside_it() {
    use std::os::unix::fs::symlink;
    let folder = Folder::new("no_draft");
    let path = |name: &str| folder.0.join(name);
    let first = "# Answers to sweetspot new, which goes on after them\n";
    folder
        .write("latin", b"# Answers to sweetspot new, which goes on after them\nname: M\xfcller\n");
    folder.write("notes", format!("{first}a line of somebody's own\n"));
    folder.write("verb", first.replace("new", "calibrate") + "name: Mine\n");
    folder.write("long", format!("{first}name: {}\n", "n".repeat(5 << 20)));
    folder.write("ours", format!("{first}name: Mine\n"));
    let made = std::process::Command::new("mkfifo").arg(path("pipe")).status().unwrap();
    assert!(made.success());
    fs::create_dir(path("folder")).unwrap();
    let whole = ["latin", "notes", "verb", "long", "pipe", "folder"];
    let links = ["/dev/zero", "/dev/stdin", "nowhere", "ours", "pipe", "loop.json.draft"];
    for (k, what) in whole.into_iter().chain(links).enumerate() {
        let name = if what.starts_with("loop") { "loop" } else { &format!("b{k}") };
        let draft = path(&format!("{name}.json.draft"));
        match k < whole.len() {
            true => fs::rename(path(what), &draft).unwrap(),
            false => symlink(what, &draft).unwrap(),
        }
        let before = fs::symlink_metadata(&draft).unwrap();
        let text = before.is_file().then(|| fs::read(&draft).unwrap());
        let file = format!("{name}.json");
        for answers in ["Mine\nin\n33\nquit\n", "yes\nquit\n"] {
            let output = answered(&folder, &[&file], answers);
            let told = String::from_utf8_lossy(&output.stderr).into_owned();
            let plain = told.split_whitespace().collect::<Vec<_>>().join(" ");
            assert_eq!(output.status.code(), Some(0), "{what}: {told}");
            assert!(plain.contains(&format!("{file}-2.draft")), "{what}: {told}");
        }
        let output = answered(&folder, &[&file], &format!("no\n{ANSWERS}"));
        assert_eq!(output.status.code(), Some(0), "{what}");
        let after = fs::symlink_metadata(&draft).unwrap();
        assert_eq!(after.file_type(), before.file_type(), "{what}");
        assert_eq!(before.is_file().then(|| fs::read(&draft).unwrap()), text, "{what}");
        assert!(path(&file).exists() && !path(&format!("{file}-2.draft")).exists(), "{what}");
        if what == "folder" {
            folder.write("pipe", "");
        }
    }
    assert!(!path("nowhere").exists());
    assert_eq!(folder.read("ours"), format!("{first}name: Mine\n"));
}

#[cfg(unix)]
#[test]
fn two_dialogues_at_the_same_time_keep_a_draft_each() {
    let folder = Folder::new("two");
    let path = |name: &str| folder.0.join(name);
    let begin = |answers: &[u8]| {
        let mut command = folder.attentive(&["new", "mine.json", "--ask"]);
        let mut child = command.stdin(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let mut typed = child.stdin.take().unwrap();
        typed.write_all(answers).unwrap();
        (child, typed)
    };
    let until = |name: &str, part: &str| {
        while !fs::read_to_string(path(name)).unwrap_or_default().contains(part) {
            std::thread::yield_now();
        }
    };
    let (first, mut typed) = begin(b"First\nin\n");
    until("mine.json.draft", "unit: in");
    let (second, also) = begin(b"Second\ncm\n");
    until("mine.json-2.draft", "unit: cm");
    typed.write_all(b"33\n").unwrap();
    until("mine.json.draft", "length: 33");
    drop((typed, also));
    for child in [first, second] {
        assert_eq!(child.wait_with_output().unwrap().status.code(), Some(2));
    }
    assert_eq!(folder.names(), ["mine.json-2.draft", "mine.json.draft"]);
    assert!(folder.read("mine.json.draft").contains("name: First"));
    assert!(folder.read("mine.json-2.draft").contains("name: Second"));
}

#[test]
fn an_answer_in_another_encoding_is_asked_again() {
    let folder = Folder::new("latin");
    let answers = [b"M\xfcller\n\xff\xfe\n", ANSWERS.as_bytes()].concat();
    let output = typed(&folder, &["mine.json"], &answers);
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.code() == Some(0) && told.contains("another encoding"), "{told}");
    assert_eq!(Bat::from_file(folder.0.join("mine.json")).unwrap().name(), "Mine");
    let endless = typed(&folder, &["other.json"], &b"\xff\n".repeat(100));
    let told = String::from_utf8_lossy(&endless.stderr).into_owned();
    assert!(endless.status.code() == Some(2) && told.contains("50 wrong answers"), "{told}");
}

#[test]
fn a_dialogue_that_writes_no_file_keeps_its_answers_in_the_users_own_folder() {
    let folder = Folder::new("state");
    fs::create_dir(folder.0.join("work")).unwrap();
    let run = |home: &str, value: &std::path::Path| {
        let mut command = folder.command(&["calibrate", "r161", "--ask"]);
        command.current_dir(folder.0.join("work")).env_remove("XDG_STATE_HOME").env(home, value);
        let piped = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = piped.spawn().unwrap();
        let _ = child.stdin.take().unwrap().write_all(b"30.65 oz\nquit\n");
        String::from_utf8(child.wait_with_output().unwrap().stderr).unwrap()
    };
    let [state, home] = ["state", "home"].map(|name| folder.0.join(name));
    let told = run("XDG_STATE_HOME", &state);
    assert!(told.contains("sweetspot/r161-calibrate.draft"), "{told}");
    assert!(state.join("sweetspot/r161-calibrate.draft").is_file());
    run("HOME", &home);
    assert!(home.join(".local/state/sweetspot/r161-calibrate.draft").is_file());
    assert!(folder.read_names("work").is_empty());
}

#[test]
fn a_hollow_bat_and_a_cup_are_asked_for_and_the_sweet_spot_is_told() {
    let folder = Folder::new("hollow");
    // For aluminium it must be known whether it is hollow, so an empty line is no answer.
    let metal =
        "Metal\nin\n33\n30 oz\naluminium-7075\n0.95\n12, 0.9\n23, 2.6\n\n2.6\n\n3 mm\n\n\n\n";
    let output = answered(&folder, &["metal.json"], metal);
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{told}");
    let shown = String::from_utf8(output.stdout).unwrap();
    let last = shown.trim_end().rsplit("\n\n").next().unwrap();
    let last = last.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(last.starts_with("Sweet spot: ") && last.contains("this theory ends"), "{shown}");
    let section = Bat::from_file(folder.0.join("metal.json")).unwrap().profile().at(0.7);
    assert!((section.outer - section.inner - 3e-3).abs() < 1e-12);
    let wood =
        "Cupped\nin\n33\n31 oz\nsugar-maple-dynamic\n1.9\n1.2\n\n2.5\n\n1 in, 1.6 in\n\n\n\n";
    let output = answered(&folder, &["wood.json"], wood);
    let shown = String::from_utf8(output.stdout).unwrap();
    assert!(shown.contains("Sweet spot: ") && !shown.contains("theory ends"), "{shown}");
    let cupped = Bat::from_file(folder.0.join("wood.json")).unwrap();
    let rim = cupped.profile().at(cupped.length() * (1.0 - 1e-9));
    assert!((rim.inner - 0.8 * 0.0254).abs() < 1e-5, "{}", rim.inner);
    assert!((cupped.inertia().mass - 31.0 * 0.028_349_523_125).abs() < 1e-9);
    // The same by options.
    let bat = ["--name", "Cupped", "--length", "33 in", "--mass", "31 oz", "--unit", "in"];
    let more = ["--material", "sugar-maple-dynamic", "--cup", "1, 1.6"];
    let along = ["--station", "0, 1.9", "--station", "0.5, 1.2", "--station", "33, 2.5"];
    let written = folder.text(&[&["new", "-"], &bat[..], &more, &along].concat());
    assert_eq!(written, folder.read("wood.json"));
}

#[test]
fn a_question_is_explained_taken_back_and_left_open() {
    let folder = Folder::new("back");
    let answers = "Mine\nin\n?\n34\nback\n33\ndon't know\nwhite-ash\n1.9\n1.2\n2\n0.5, 1.1\n\n2.5\n\n\n\n\n\n";
    let output = answered(&folder, &["mine.json"], answers);
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{told}");
    assert!(told.contains("From the end of the knob to the tip"), "{told}");
    let bat = Bat::from_file(folder.0.join("mine.json")).unwrap();
    assert!((bat.length() - 33.0 * 0.0254).abs() < 1e-12 && bat.factors() == [1.0, 1.0]);
    assert!((bat.profile().at(0.5 * 0.0254).outer - 0.55 * 0.0254).abs() < 1e-12);
    let shown = String::from_utf8(output.stdout).unwrap();
    assert!(shown.contains("Not weighed: the mass is that of white-ash"), "{shown}");
}

#[test]
fn options_make_the_same_file_as_answers_and_what_is_missing_is_said() {
    let folder = Folder::new("options");
    let bat = ["--length", "33 in", "--mass", "31 oz", "--material", "white-ash", "--name", "Mine"];
    let stations = ["--station", "0 in, 1.9 in", "--station", "1 in, 1", "--station", "33, 2.5"];
    let written = folder.text(&[&["new", "-"], &bat[..], &stations].concat());
    answered(
        &folder,
        &["asked.json"],
        "Mine\nin\n33\n31 oz\nwhite-ash\n1.9\n1, 1\n\n2.5\n\n\n\n\n\n",
    );
    assert_eq!(folder.read("asked.json"), written);
    for missing in ["--mass", "--material", "--station"] {
        let kept = [&["new", "new.json"], &bat[..], &stations].concat();
        let mut words = kept.iter();
        let mut args = Vec::new();
        while let Some(word) = words.next() {
            if *word == missing {
                words.next();
            } else {
                args.push(*word);
            }
        }
        let output = folder.command(&args).stdin(Stdio::null()).output().unwrap();
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.code() == Some(2) && told.contains(missing), "{missing}: {told}");
    }
    for wrong in ["1 in, 0.5", "0 in, 1 kg", "0 in", "40 in, 2"] {
        let args = [&["new", "new.json"], &bat[..], &["--station", wrong]].concat();
        let output = folder.command(&args).stdin(Stdio::null()).output().unwrap();
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.code() == Some(2) && told.contains("--station"), "{wrong}: {told}");
    }
    assert_eq!(folder.names(), ["asked.json"]);
}

#[test]
fn a_bat_like_another_has_its_diameters_at_its_own_length() {
    let folder = Folder::new("like");
    let like = ["--like", "r161", "--mass", "33 oz", "--material", "white-ash-dynamic"];
    folder.text(&[&["new", "longer.json", "--length", "36 in"], &like[..]].concat());
    let bat = Bat::from_file(folder.0.join("longer.json")).unwrap();
    let r161 = Bat::from_file(mesh("r161")).unwrap();
    let stretch = bat.length() / r161.length();
    assert!((bat.length() - 36.0 * 0.0254).abs() < 1e-5);
    for x in [0.01, 0.15, 0.4, 0.7, 0.83] {
        let off = bat.profile().at(x * stretch).outer - r161.profile().at(x).outer;
        // Four decimals of an inch are written.
        assert!(off.abs() < 1e-5, "{x} {off}");
    }
    let output = folder.run(&[&["new", "longer.json"], &like[..]].concat());
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.code() == Some(2) && told.contains("--force"), "{told}");
    folder.text(&[&["new", "longer.json", "--force"], &like[..]].concat());
}

#[test]
fn materials_are_the_same_in_every_unit_and_as_json() {
    let folder = Folder::new("materials");
    let [si, us] = ["si", "us"].map(|units| folder.text(&["materials", "--units", units]));
    let cells = |text: &str, name: &str| -> Vec<f64> {
        let line = text.lines().find(|l| l.split_whitespace().next() == Some(name)).unwrap();
        line.split_whitespace().skip(1).map(|cell| cell.parse().unwrap_or(0.0)).collect()
    };
    let json = folder.json(&["materials", "--json", "-"]);
    assert_eq!(json["format"], "sweetspot-materials/1");
    for material in json["materials"].as_array().unwrap() {
        let name = material["name"].as_str().unwrap();
        let (si, us) = (cells(&si, name), cells(&us, name));
        let number = |key: &str| material[key].as_f64().unwrap_or(0.0);
        // 1 lb/in³ = 27 679.905 kg/m³ and 1 psi = 6 894.757 Pa.
        for (value, [scale, si_of], [us_of, known]) in [
            (number("density_kg_m3"), [1.0, si[0]], [27_679.905, us[0]]),
            (number("youngs_modulus_pa"), [1e9, si[1]], [6.894_757e9, us[1]]),
            (number("shear_modulus_pa"), [1e9, si[2]], [6.894_757e9, us[2]]),
        ] {
            assert!((value / scale - si_of).abs() <= 0.051 * si_of.max(0.01), "{name} {value}");
            assert!((value / us_of - known).abs() <= 0.000_6, "{name} {value} {known}");
        }
    }
}

/// Words of SI units after a number, or at the end of a heading.
#[test]
fn us_units_alone_leave_no_stiffness_force_or_acceleration_in_si() {
    const SI: [&str; 9] = ["MN/m", "N/m", "m/s", "m/s²", "kN", "m/N", "mm", "cm", "kg"];
    let folder = Folder::new("us-alone");
    for args in [
        &["hoop", "bbcor_made_up", "--full"][..],
        &["hit", "bbcor_made_up", "--at", "26 in", "--full"],
        &["hit", "r161", "--at", "26 in", "--wall-stiffness", "7e6", "--wall-mass", "0.1"],
        &["ring", "r161", "--hit", "26 in", "--full"],
        &["ring", "bbcor_made_up", "--hit", "26 in", "--damping", "assumed"],
        &["frf", "r161", "--at", "20 in"],
    ] {
        let text = folder.text(&[args, &["--units", "us", "--quiet"]].concat());
        let words = text.split(|c: char| c.is_whitespace() || "();:,".contains(c));
        let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
        let left: Vec<&&str> = words.iter().filter(|word| SI.contains(*word)).collect();
        assert!(left.is_empty(), "{args:?}: {left:?} in {text}");
    }
}
