//! What the program leaves behind when its environment fails: open descriptors, links, locked folders, limits, signals.
#![cfg(unix)]

mod common;

use std::fs::{self, File, Permissions};
use std::io::Read;
use std::os::unix::fs::{MetadataExt, PermissionsExt, symlink};
use std::path::Path;
use std::process::{Command, Output, Stdio};

use common::folder::Folder;
use serde_json::Value;
use sweetspot_study::files::aim_file::AimForm;
use sweetspot_study::files::scatter_file::ScatterForm;
use sweetspot_study::files::written::WrittenFile;

const BAT: &str = r#"{ "format": "sweetspot-bat/1", "material": "white-ash-dynamic",
  "profile": { "unit": "in", "x": [0, 33], "diameter": [1.7, 1.7] } }"#;

/// A folder with a bat, open to every user.
fn folder(name: &str) -> Folder {
    let folder = Folder::new(name);
    fs::set_permissions(&folder.0, Permissions::from_mode(0o777)).unwrap();
    folder.write("bat.json", BAT);
    folder
}

/// Runs a line of bash in the folder; `$S` is the program.
fn bash(folder: &Folder, line: &str) -> Output {
    let mut command = Command::new("bash");
    command.args(["-c", line]).current_dir(&folder.0).env("S", env!("CARGO_BIN_EXE_sweetspot"));
    command.output().unwrap()
}

/// As [`bash`], for an unprivileged user, because root is exempt from permissions and limits.
fn bash_of_a_user(folder: &Folder, line: &str) -> Output {
    let root = fs::metadata("/proc/self").map_or(1, |process| process.uid()) == 0;
    if !root {
        return bash(folder, line);
    }
    // The program itself may be in a folder closed to other users.
    let copy = folder.0.join("sweetspot");
    fs::copy(env!("CARGO_BIN_EXE_sweetspot"), &copy).unwrap();
    let mut command = Command::new("setpriv");
    command.args(["--reuid=65534", "--regid=65534", "--clear-groups", "bash", "-c", line]);
    let output = command.current_dir(&folder.0).env("S", &copy).output().unwrap();
    fs::remove_file(copy).unwrap();
    output
}

fn succeeded(output: &Output) -> String {
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{told}");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

fn refused(output: &Output) -> String {
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{told}");
    assert!(told.starts_with("error: "), "{told}");
    told
}

fn is_json(text: &str) -> bool {
    serde_json::from_str::<Value>(text).is_ok()
}

#[test]
fn a_log_that_is_appended_to_keeps_what_it_has() {
    let folder = folder("log");
    for out in ["/dev/stdout", "/dev/fd/1", "/proc/self/fd/1", "link"] {
        if !Path::new(out).exists() && out != "link" {
            continue;
        }
        let _ = symlink("/dev/stdout", folder.0.join("link"));
        folder.write("log", "before\n");
        let line = format!("$S modes bat.json --json {out} --quiet >> log; echo after >> log");
        succeeded(&bash(&folder, &line));
        let log = folder.read("log");
        let rest = log.strip_prefix("before\n").expect(out);
        // The document first, then the table.
        let end = rest.find("\n}\n").unwrap() + 3;
        assert!(is_json(&rest[..end]) && rest.ends_with("after\n"), "{out}: {log}");
        assert_eq!(folder.names(), ["bat.json", "link", "log"]);
    }
    assert!(fs::symlink_metadata("/dev/stdout").unwrap().is_symlink());
}

#[test]
fn an_open_descriptor_is_written_where_it_stands() {
    let folder = folder("descriptor");
    let write = "$S modes bat.json --json /dev/fd/3 --quiet > table";
    for (open, line) in
        [("3>>", "exec 3>> out; W"), ("3>", "exec 3> out; echo before >&3; W; echo after >&3")]
    {
        folder.write("out", "before\n");
        succeeded(&bash(&folder, &line.replace('W', write)));
        let out = folder.read("out");
        let rest = out.strip_prefix("before\n").unwrap_or_else(|| panic!("{open}: {out}"));
        let json = rest.strip_suffix("after\n").unwrap_or(rest);
        assert!(is_json(json) && (open == "3>>" || json != rest), "{open}: {out}");
    }
    // A file that has no name any more, and one of another process.
    succeeded(&bash(&folder, &format!("exec 3<> gone; rm gone; {write}; cat /dev/fd/3 > copy")));
    let line = "exec 3> theirs; $S modes bat.json --json /proc/$$/fd/3 --quiet > table";
    succeeded(&bash(&folder, line));
    assert!(is_json(&folder.read("theirs")));
    let told = refused(&bash(&folder, "exec 3>&-; $S modes bat.json --json /dev/fd/3"));
    assert!(told.contains("cannot write /dev/fd/3"), "{told}");
    assert_eq!(folder.names(), ["bat.json", "copy", "out", "table", "theirs"]);
}

#[test]
fn a_process_takes_a_document_or_as_much_of_it_as_it_wants() {
    let folder = folder("process");
    let line = "$S modes bat.json --quiet --json >(cat > out; echo > done) > table;
                until [ -e done ]; do sleep 0.01; done";
    succeeded(&bash(&folder, line));
    assert!(is_json(&folder.read("out")));
    let long = "$S modes bat.json --quiet --shape-points 20000 --json >(head -1 > first) > table";
    succeeded(&bash(&folder, long));
}

#[test]
fn the_file_that_standard_output_goes_to_is_not_replaced() {
    let folder = folder("both");
    let told = refused(&bash(&folder, "$S modes bat.json --json out > out"));
    assert!(told.contains("another name"), "{told}");
    assert_eq!(folder.read("out"), "");
}

#[test]
fn a_link_to_a_file_that_is_not_there_yet_stays_a_link() {
    let folder = folder("dangling");
    fs::create_dir(folder.0.join("there")).unwrap();
    symlink("there/new.json", folder.0.join("a")).unwrap();
    symlink("a", folder.0.join("b")).unwrap();
    symlink("loop", folder.0.join("loop")).unwrap();
    folder.text(&["modes", "bat.json", "--json", "b"]);
    assert!(is_json(&folder.read("there/new.json")));
    assert!(fs::symlink_metadata(folder.0.join("b")).unwrap().is_symlink());
    refused(&folder.run(&["modes", "bat.json", "--json", "loop"]));
    assert_eq!(folder.names(), ["a", "b", "bat.json", "loop", "there"]);
}

#[test]
fn permissions_and_other_names_of_a_file_stay() {
    let folder = folder("names");
    let path = |name: &str| folder.0.join(name);
    for mode in [0o600, 0o640, 0o755, 0o666] {
        folder.write("out", "old");
        fs::set_permissions(path("out"), Permissions::from_mode(mode)).unwrap();
        folder.text(&["modes", "bat.json", "--json", "out"]);
        assert_eq!(fs::metadata(path("out")).unwrap().mode() & 0o7777, mode);
    }
    fs::hard_link(path("out"), path("other")).unwrap();
    folder.text(&["modes", "bat.json", "-n", "2", "--json", "out"]);
    assert_eq!(fs::metadata(path("out")).unwrap().nlink(), 2);
    assert!(is_json(&folder.read("out")) && folder.read("out") == folder.read("other"));
    // A second name of the file is the same file.
    fs::hard_link(path("bat.json"), path("alias")).unwrap();
    refused(&folder.run(&["modes", "bat.json", "--json", "alias"]));
    assert_eq!(folder.read("alias"), BAT);
    fs::remove_file(path("other")).unwrap();
    folder.write("out", "old");
    fs::set_permissions(path("out"), Permissions::from_mode(0o444)).unwrap();
    let told = refused(&folder.run(&["modes", "bat.json", "--json", "out"]));
    assert!(told.contains("read-only"), "{told}");
    assert_eq!(folder.read("out"), "old");
}

#[test]
fn the_owner_of_a_file_stays() {
    let folder = folder("owner");
    folder.write("out", "old");
    let path = folder.0.join("out");
    let own = fs::metadata(&path).unwrap();
    if own.uid() == 0 {
        std::os::unix::fs::chown(&path, Some(65534), Some(65534)).unwrap();
        folder.text(&["modes", "bat.json", "--json", "out"]);
        let after = fs::metadata(&path).unwrap();
        assert_eq!((after.uid(), after.gid()), (65534, 65534));
        // A file of another user that everybody may write to.
        std::os::unix::fs::chown(&path, Some(0), Some(0)).unwrap();
        fs::set_permissions(&path, Permissions::from_mode(0o666)).unwrap();
        succeeded(&bash_of_a_user(&folder, "$S modes bat.json --json out"));
        assert_eq!(fs::metadata(&path).unwrap().uid(), 0);
        assert!(is_json(&folder.read("out")));
    } else {
        folder.text(&["modes", "bat.json", "--json", "out"]);
        assert_eq!(fs::metadata(&path).unwrap().uid(), own.uid());
    }
}

#[test]
fn a_file_in_a_locked_folder_is_overwritten_and_a_new_one_refused() {
    let folder = folder("locked");
    let locked = folder.0.join("locked");
    fs::create_dir(&locked).unwrap();
    folder.write("locked/out", "old ".repeat(100_000));
    fs::set_permissions(locked.join("out"), Permissions::from_mode(0o666)).unwrap();
    fs::set_permissions(&locked, Permissions::from_mode(0o555)).unwrap();
    let line = |out: &str| format!("$S modes bat.json --json locked/{out} > /dev/null");
    let [done, new] = ["out", "new"].map(|out| bash_of_a_user(&folder, &line(out)));
    let limit = |size: u32| format!("ulimit -f {size}; {}", line("out"));
    succeeded(&done);
    let whole = folder.read("locked/out");
    // A file that cannot be written completely is restored.
    let long = limit(64).replace("modes bat.json", "modes bat.json --shape-points 5000");
    let told = refused(&bash_of_a_user(&folder, &long));
    fs::set_permissions(&locked, Permissions::from_mode(0o755)).unwrap();
    assert!(told.contains("cannot write locked/out"), "{told}");
    assert!(is_json(&whole) && folder.read("locked/out") == whole);
    assert!(refused(&new).contains("cannot write locked/new"));
    assert_eq!(folder.read_names("locked"), ["out"]);
}

#[test]
fn a_planted_part_is_not_written_to() {
    // The temporary name of a part must be unpredictable: two runs with one process number would have had the same
    // name.
    let folder = folder("planted");
    folder.write("victim", "theirs");
    let plant = "ln -s victim .out.$$.part; exec $S modes bat.json --json out > /dev/null";
    succeeded(&bash(&folder, plant));
    assert_eq!(folder.read("victim"), "theirs");
    assert!(is_json(&folder.read("out")));
}

#[test]
fn names_of_255_bytes_are_names() {
    let folder = folder("long");
    let long = "n".repeat(250) + ".json";
    folder.text(&["modes", "bat.json", "--json", &long]);
    assert!(is_json(&folder.read(&long)));
    let longer = "n".repeat(256);
    assert!(refused(&folder.run(&["modes", "bat.json", "--json", &longer])).contains("too long"));
}

#[test]
fn a_limit_on_the_size_of_files_is_an_error_that_leaves_nothing() {
    let folder = folder("size");
    folder.write("out", "old");
    for out in ["out", "new"] {
        let line = format!("ulimit -f 8; $S modes bat.json --shape-points 5000 --json {out}");
        let told = refused(&bash(&folder, &line));
        assert!(told.contains(&format!("cannot write {out}")), "{told}");
    }
    let line = "ulimit -f 8; $S modes bat.json --shape-points 5000 --json - > table";
    assert!(refused(&bash(&folder, line)).contains("standard output"));
    assert_eq!((folder.read("out"), folder.names().len()), ("old".to_owned(), 3));
}

#[test]
fn every_signal_that_ends_a_program_leaves_no_part_and_its_number() {
    let folder = folder("signals");
    // Nobody reads the pipe, so the run waits forever.
    let made = Command::new("mkfifo").arg(folder.0.join("pipe")).status().unwrap();
    assert!(made.success());
    let before = folder.names();
    for (name, number) in
        [("HUP", 1), ("INT", 2), ("QUIT", 3), ("TERM", 15), ("XCPU", 24), ("USR1", 10)]
    {
        let number = if cfg!(target_os = "macos") && name == "USR1" { 30 } else { number };
        let mut child = folder
            .attentive(&["modes", "bat.json", "--shape-points", "40000", "--json", "pipe"])
            .stdout(Stdio::null())
            .spawn()
            .unwrap();
        // Reads a part of the output, so that the program is in the middle of writing.
        let mut pipe = File::open(folder.0.join("pipe")).unwrap();
        pipe.read_exact(&mut [0]).unwrap();
        let kill = Command::new("kill").args(["-s", name, &child.id().to_string()]).status();
        assert!(kill.unwrap().success());
        assert_eq!(child.wait().unwrap().code(), Some(128 + number), "{name}");
        assert_eq!(folder.names(), before, "{name}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_signal_that_is_ignored_stays_so() {
    let folder = folder("nohup");
    let line = "mkfifo pipe; trap '' HUP
        $S modes bat.json --shape-points 40000 --json pipe > /dev/null & 
        exec 3< pipe; head -c 1 <&3 > /dev/null; kill -s HUP $!; cat <&3 > rest; wait $!";
    succeeded(&bash(&folder, line));
    assert!(folder.read("rest").ends_with("}\n"));
}

#[cfg(target_os = "linux")]
#[test]
fn help_to_a_full_device_is_an_error_as_any_other_result() {
    let folder = folder("help");
    for args in ["--help", "--version", "help modes", "hit -h", "man", "completions bash"] {
        let output = bash(&folder, &format!("$S {args} > /dev/full"));
        assert!(refused(&output).contains("standard output"), "{args}");
        assert!(!succeeded(&bash(&folder, &format!("$S {args}"))).is_empty());
    }
    // A reader that closed the pipe has read enough.
    succeeded(&bash(&folder, "set -o pipefail; $S hit --help | true"));
}

#[cfg(target_os = "linux")]
#[test]
fn one_thread_does_the_work_where_no_other_may_be_started() {
    let folder = folder("threads");
    for verb in ["hit bat.json --json -", "modes bat.json -n 3 --json - --reproducible"] {
        let alone = bash_of_a_user(&folder, &format!("ulimit -u 1; exec $S {verb}"));
        let usual = bash(&folder, &format!("$S {verb}"));
        assert_eq!(succeeded(&alone), succeeded(&usual), "{verb}");
    }
}

#[test]
fn what_has_no_end_is_refused() {
    let folder = folder("endless");
    folder.write(
        "csv.json",
        BAT.replace(r#""x": [0, 33], "diameter": [1.7, 1.7]"#, r#""csv": "/dev/zero""#),
    );
    let zero = |line: &str| refused(&bash(&folder, line));
    assert!(zero("$S modes /dev/zero").contains("more than 256 MiB"));
    assert!(zero("$S modes csv.json").contains("a pipe or a device"));
    assert!(zero("$S hit bat.json --ball /dev/zero").contains("more than 256 MiB"));
    assert!(zero("$S convert /dev/zero --to csv").contains("more than 256 MiB"));
    let huge = File::create(folder.0.join("huge.json")).unwrap();
    huge.set_len(1 << 40).unwrap();
    assert!(zero("$S modes huge.json").contains("more than 256 MiB"));
    for answers in ["yes | $S new --ask x.json", "$S new --ask x.json < /dev/zero"] {
        let output = bash(&folder, answers);
        let told = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.code() == Some(2) && told.contains("wrong answers"), "{answers}");
    }
}

/// Far larger quantities than usual: an answer or a refusal, within a time suitable for a test.
#[test]
fn very_much_of_one_thing_is_read_or_refused() {
    let folder = folder("much");
    let n = 100_000;
    let bat = |profile: &str, more: &str| {
        format!(
            r#"{{ "format": "sweetspot-bat/1", "material": "white-ash-dynamic", "profile": {profile}{more} }}"#
        )
    };
    let dowel = r#"{ "x": [0, 0.8], "radius": [0.02, 0.02] }"#;
    let csv = bat(r#"{ "csv": "t.csv" }"#, "");
    let list = |of: &str| vec![of; n].join(",");
    let unknown: String = (0..n).map(|k| format!(r#", "k{k}": 0"#)).collect();
    let formula = |text: &str| {
        bat(&format!(r#"{{ "pieces": [{{ "from": 0, "to": 0.8, "formula": "{text}" }}] }}"#), "")
    };
    let nested = format!("{}0.02+0*x{}", "abs(".repeat(450), ")".repeat(450));
    for (name, text, table, code) in [
        ("name", bat(dowel, &format!(r#", "name": "{}""#, "a".repeat(n))), String::new(), 0),
        ("keys", bat(dowel, &unknown), String::new(), 2),
        ("twice", bat(dowel, &r#", "name": "x""#.repeat(n)), String::new(), 2),
        (
            "masses",
            bat(dowel, &format!(r#", "attachments": [{}]"#, list(r#"{ "x": 9, "mass": 1 }"#))),
            String::new(),
            2,
        ),
        ("nested", formula(&nested), String::new(), 2),
        ("branches", formula(&format!("0.02{}", "+0*abs(x)".repeat(101))), String::new(), 2),
        ("columns", csv.clone(), (0..n).map(|k| format!("c{k},")).collect(), 2),
        ("repeated", csv.clone(), list("x"), 2),
        ("cells", csv.clone(), format!("x_m,radius_m\n{}", list("1")), 2),
        ("rows", csv.clone(), format!("x_m,radius_m\n{}", "a,b\n".repeat(n)), 2),
        ("comments", csv, format!("x_m,radius_m\n0,0.02\n{}0.8,0.02\n", "#\n".repeat(n)), 0),
    ] {
        folder.write("much.json", text);
        folder.write("t.csv", table);
        let output = folder.run(&["modes", "much.json", "-n", "2", "--json", "-"]);
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(code), "{name}: {told}");
        assert!(told.len() < 10_000, "{name}");
    }
}

#[test]
fn columns_outside_of_the_folder_are_read_of_a_named_bat_alone_and_said() {
    let folder = folder("outside");
    fs::create_dir(folder.0.join("bats")).unwrap();
    folder.write("columns.csv", "x_in,diameter_in\n0,1\n33,2.5\n");
    folder.write("bats/columns.csv", "x_in,diameter_in\n0,1\n33,2.5\n");
    symlink("../columns.csv", folder.0.join("bats/link.csv")).unwrap();
    let bat = |csv: &str| {
        BAT.replace(
            r#""unit": "in", "x": [0, 33], "diameter": [1.7, 1.7]"#,
            &format!(r#""csv": "{csv}""#),
        )
    };
    let absolute = folder.0.join("columns.csv").display().to_string();
    for (csv, outside) in [
        ("columns.csv", false),
        ("../bats/columns.csv", false),
        ("../columns.csv", true),
        ("link.csv", true),
        (&absolute, true),
    ] {
        folder.write("bats/bat.json", bat(csv));
        let output = folder.run(&["modes", "bats/bat.json"]);
        let told = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{csv}: {told}");
        assert_eq!(told.contains("outside of its folder"), outside, "{csv}: {told}");
        let quiet = folder.run(&["modes", "bats/bat.json", "--quiet"]);
        assert!(quiet.status.success() && quiet.stderr.is_empty());
        let path = folder.0.join("bats/bat.json");
        for read in [
            sweetspot::Bat::from_file(&path),
            sweetspot::Bat::from_text("b", &bat(csv), &folder.0.join("bats")),
        ] {
            assert_eq!(read.is_err(), outside, "{csv}");
            let said = read.err().map_or(String::new(), |error| error.to_string());
            assert!(!outside || said.contains("in the folder of this one"), "{said}");
        }
    }
}

/// A line that no message and no cell may contain.
const SECRET: &str = "root:hunter2,17:the secret";

/// A folder with a private file, a pipe, and files that name them in every way.
fn of_a_stranger(name: &str) -> Folder {
    let folder = folder(name);
    fs::create_dir(folder.0.join("in")).unwrap();
    for secret in ["secret", "secret.json", "in/secret.json", "in/secret.csv"] {
        folder.write(secret, format!("{SECRET}\n{SECRET}\n"));
    }
    symlink("../secret", folder.0.join("in/link.json")).unwrap();
    symlink("/dev/zero", folder.0.join("in/zero.json")).unwrap();
    for pipe in ["in/pipe.json", "in/pipe.csv"] {
        assert!(Command::new("mkfifo").arg(folder.0.join(pipe)).status().unwrap().success());
    }
    folder
}

#[test]
fn what_a_file_names_is_read_only_if_it_begins_as_it_should_and_no_word_of_it_is_told() {
    let folder = of_a_stranger("secrets");
    let absolute = folder.0.join("secret").display().to_string();
    let names = [
        "secret.json",
        "link.json",
        "zero.json",
        "pipe.json",
        "../secret.json",
        &absolute,
        "/dev/zero",
        "/proc/self/environ",
        "/dev/stdin",
    ];
    let kinds = [
        ("study", r#"{ "format": "sweetspot-study/1", "bat": "NAME", "outputs": ["f1_hz"] }"#),
        (
            "study",
            r#"{ "format": "sweetspot-study/1", "bat": "r161", "ball": "NAME", "outputs": ["f1_hz"] }"#,
        ),
        (
            "study",
            r#"{ "format": "sweetspot-study/1", "bat": "r161", "outputs": ["f1_hz"],
                 "vary": { "bat.profile": { "values": [{ "csv": "NAME" }] } } }"#,
        ),
        (
            "scatter",
            r#"{ "format": "sweetspot-scatter/1", "density": { "lognormal": "4 %" }, "ball": "NAME" }"#,
        ),
        ("scatter", r#"{ "format": "sweetspot-scatter/1", "covariance": "NAME" }"#),
        ("aim", r#"{ "format": "sweetspot-aim/1", "targets": ["mass -1 oz"], "rules": "NAME" }"#),
        (
            "modes",
            r#"{ "format": "sweetspot-bat/1", "material": "white-ash", "profile": { "csv": "NAME" } }"#,
        ),
    ];
    for (verb, text) in kinds {
        for name in names {
            folder.write("in/file.json", text.replace("NAME", name));
            let line = match verb {
                "study" => "study in/file.json --out out",
                "modes" => "modes in/file.json",
                verb => &format!("{verb} r161 in/file.json"),
            };
            // Opening a pipe would wait forever.
            let output = bash(&folder, &format!("timeout 20 $S {line} < in/secret.csv"));
            let told = refused(&output);
            let said = told.clone() + &String::from_utf8_lossy(&output.stdout);
            assert!(!said.contains("hunter2") && !said.contains("17:"), "{text} {name}: {said}");
        }
    }
    // An invalid bat among valid ones becomes a row with the reason.
    let study = r#"{ "format": "sweetspot-study/1", "bat": ["r161", "../secret", "secret.json"],
        "outputs": ["f1_hz"] }"#;
    folder.write("in/file.json", study);
    let output = bash(&folder, "timeout 20 $S study in/file.json --out out");
    succeeded(&output);
    assert!(String::from_utf8_lossy(&output.stderr).contains("outside of its folder"));
    let part = folder.read("out/part-000000.csv");
    assert!(part.contains("something else than a bat file") && !part.contains("hunter2"), "{part}");
}

#[test]
fn files_outside_of_the_folder_are_read_of_a_named_file_alone_and_said() {
    let folder = folder("elsewhere");
    fs::create_dir_all(folder.0.join("in/below")).unwrap();
    fs::create_dir(folder.0.join("bats")).unwrap();
    let ball =
        r#"{ "format": "sweetspot-ball/1", "mass": "5 oz", "radius": "1.45 in", "cor": 0.5 }"#;
    let rules = r#"{ "format": "sweetspot-rules/1", "name": "mine", "source": "me", "date": "2026", "mass_at_most": "40 oz" }"#;
    for place in ["", "in/", "in/below/", "bats/"] {
        folder.write(&format!("{place}bat.json"), BAT);
        folder.write(&format!("{place}ball.json"), ball);
        folder.write(&format!("{place}rules.json"), rules);
        folder.write(&format!("{place}t.csv"), "x_in,diameter_in\n0,1\n33,2.5\n");
    }
    let kinds = [
        (
            "bat.json",
            "study",
            r#"{ "format": "sweetspot-study/1", "bat": "NAME", "outputs": ["f1_hz"] }"#,
        ),
        (
            "",
            "study",
            r#"{ "format": "sweetspot-study/1", "bat": "NAMEbats", "outputs": ["f1_hz"] }"#,
        ),
        (
            "ball.json",
            "study",
            r#"{ "format": "sweetspot-study/1", "bat": "r161", "ball": "NAME", "outputs": ["f1_hz"] }"#,
        ),
        (
            "t.csv",
            "study",
            r#"{ "format": "sweetspot-study/1", "bat": "r161", "outputs": ["f1_hz"],
                 "vary": { "bat.profile": { "values": [{ "csv": "NAME" }] } } }"#,
        ),
        (
            "ball.json",
            "scatter",
            r#"{ "format": "sweetspot-scatter/1", "density": { "lognormal": "4 %" },
                 "outputs": ["f1_hz"], "ball": "NAME" }"#,
        ),
        (
            "rules.json",
            "aim",
            r#"{ "format": "sweetspot-aim/1", "targets": ["mass same"], "rules": "NAME" }"#,
        ),
    ];
    for (own, verb, text) in kinds {
        for (place, outside) in [("", false), ("below/", false), ("../", true), ("../bats/", true)]
        {
            if own.is_empty() && place != "../" {
                continue;
            }
            let text = text.replace("NAME", &format!("{place}{own}"));
            folder.write("in/file.json", &text);
            let _ = fs::remove_dir_all(folder.0.join("out"));
            let line = match verb {
                "study" => "study in/file.json --out out",
                "scatter" => "scatter r161 in/file.json --points 64",
                verb => &format!("{verb} r161 in/file.json"),
            };
            let output = bash(&folder, &format!("$S {line}"));
            let told = String::from_utf8_lossy(&output.stderr);
            assert!(output.status.success(), "{text}: {told}");
            assert_eq!(told.contains("outside of its folder"), outside, "{text}: {told}");
            let quiet = bash(&folder, &format!("$S {line} --quiet"));
            assert!(!String::from_utf8_lossy(&quiet.stderr).contains("outside"), "{text}");
            let path = folder.0.join("in/file.json");
            let wrong = match verb {
                "study" => sweetspot_report::many::source::Study::read(&path).err(),
                "scatter" => ScatterForm::from_file(&path).err(),
                _ => AimForm::from_file(&path).err(),
            };
            assert_eq!(wrong.is_some(), outside, "{text}");
            let said = wrong.map_or(String::new(), |error| error.to_string());
            assert!(!outside || said.contains("in the folder of this one"), "{said}");
        }
    }
}

#[test]
fn a_study_that_was_sent_reads_no_file() {
    use sweetspot_report::many::source::Study;
    let folder = folder("sent");
    let study = r#"{ "format": "sweetspot-study/1", "bat": "bat.json", "outputs": ["f1_hz"] }"#;
    let sent = Study::of("study", study, &folder.0).unwrap().alone();
    assert!(Study::arrived(&sent).is_ok());
    let ball = r#"\"outputs\""#;
    let with_ball = sent.replace(ball, &format!(r#"\"ball\": \"/etc/passwd\", {ball}"#));
    assert!(with_ball != sent && Study::arrived(&with_ball).is_err());
}

#[cfg(target_os = "linux")]
#[test]
fn where_memory_ends_words_are_said_and_no_part_stays() {
    let folder = folder("memory");
    let lines = [
        "hoop bbcor_made_up --json out",
        "hit bbcor_made_up --json out",
        "bbcor composite_made_up",
        "study study.json --out parts",
    ];
    let study = r#"{ "format": "sweetspot-study/1", "bat": "bbcor_made_up", "points": 8,
        "vary": { "bat.material.density": { "lognormal": 0.04 } }, "outputs": ["exit_speed_max.value"] }"#;
    folder.write("study.json", study);
    // The memory for the system loader before the program begins, which depends on its libraries.
    let starts = |limit: &u32| {
        bash(&folder, &format!("ulimit -v {limit}; exec $S --version")).status.success()
    };
    let least = (10..40).map(|k| 2000 * k).find(starts).unwrap();
    for line in lines {
        for limit in [least + 4000, least + 30_000, least + 60_000] {
            let output = bash(&folder, &format!("ulimit -v {limit}; exec timeout 60 $S {line}"));
            let told = String::from_utf8_lossy(&output.stderr);
            // Where the need was overestimated there is an answer.
            let code = output.status.code();
            assert!(code == Some(2) || code == Some(0), "{line} {limit}: {output:?}");
            let said = told.contains("error: ") && !told.contains("memory allocation of");
            assert!(code == Some(0) || said, "{line} {limit}: {told}");
        }
    }
    let told = refused(&bash(&folder, "ulimit -v 65536; exec $S hoop bbcor_made_up"));
    assert!(told.contains("memory: found none left"), "{told}");
    assert!(folder.names().iter().all(|name| !name.ends_with(".part")), "{:?}", folder.names());
}

#[test]
fn no_spreadsheet_computes_a_name_and_no_terminal_obeys_one() {
    let folder = folder("formulas");
    fs::create_dir(folder.0.join("bats")).unwrap();
    let names = [
        "=1+1",
        "+1",
        "-1",
        "@SUM(A1)",
        "\t=1",
        "'=1",
        "plain",
        "it's",
        "e\u{1b}[31m",
        "r\u{202e}",
    ];
    for name in names {
        folder.write(&format!("bats/{name}.json"), BAT);
    }
    let study = r#"{ "format": "sweetspot-study/1", "bat": "bats", "outputs": ["f1_hz"],
        "vary": { "bat.source": { "values": ["-3", "=x"] }, "bat.edits": { "values": [[]] },
                  "bat.profile.diameter": { "values": [[1.7, 1.6]] } } }"#;
    folder.write("study.json", study);
    let output = bash(&folder, "$S study study.json --out out");
    let shown = succeeded(&output) + &String::from_utf8_lossy(&output.stderr);
    let marks = |text: &str| text.chars().any(|c| (c.is_control() && c != '\n') || c == '\u{202e}');
    assert!(!marks(&shown), "{shown}");
    let part = folder.read("out/part-000000.csv");
    let mut reader = csv::Reader::from_reader(part.as_bytes());
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    let mut found: Vec<String> = rows.iter().map(|row| row[1].to_owned()).collect();
    found.dedup();
    let mut written = [
        "'=1+1",
        "'+1",
        "'-1",
        "'@SUM(A1)",
        "'\t=1",
        "''=1",
        "plain",
        "it's",
        "e\\u{1b}[31m",
        "r\\u{202e}",
    ];
    written.sort();
    found.sort();
    assert_eq!(found, written);
    for row in &rows {
        assert!(["'-3", "'=x"].contains(&&row[2]) && row[5].parse::<f64>().is_ok(), "{row:?}");
    }
    // Negative numbers are numbers too, and a table with such cells is read.
    folder.write("t.csv", "x_in,diameter_in\n'+0,1.7\n33,'+1.7\n");
    folder.write(
        "t.json",
        BAT.replace(r#""x": [0, 33], "diameter": [1.7, 1.7]"#, r#""csv": "t.csv""#),
    );
    let mass =
        |bat: &str| folder.json(&["modes", bat, "--json", "-"])["summary"]["mass_kg"].clone();
    assert_eq!(mass("t.json"), mass("bat.json"));
    let shape = folder.text(&["modes", "bat.json", "--csv", "-"]);
    assert!(!shape.contains('\''), "{shape}");
    let ringing = folder.text(&["ring", "bat.json", "--at", "0.6", "--impulse", "1", "--csv", "-"]);
    assert!(ringing.contains(",-") && !ringing.contains('\''));
}

#[test]
fn json_holds_no_mark_that_acts_on_a_terminal() {
    let folder = folder("marks");
    let name = "a\u{202e}b\u{9b}c\u{200f}d\u{7f}e\u{61c}";
    let bat = BAT.replace("{ \"format\"", &format!("{{ \"name\": \"{name}\", \"format\""));
    folder.write("marks.json", bat);
    folder.write("r.json", r#"{ "format": "sweetspot-readings/1", "mass": "30 oz", "lines": [ { "hz": 170, "mode": 1 } ] }"#);
    let lines = [
        "modes marks.json --json -",
        "hit marks.json --json -",
        "analyze marks.json --json -",
        "lathe marks.json --json -",
        "scatter marks.json --points 64 --json -",
        "calibrate marks.json r.json --out -",
        "calibrate marks.json r.json --json -",
        "convert marks.json --to json",
    ];
    for line in lines {
        let output = bash(&folder, &format!("$S {line}"));
        let text = String::from_utf8(output.stdout).unwrap();
        let marks = ['\u{202e}', '\u{9b}', '\u{200f}', '\u{7f}', '\u{61c}'];
        assert!(!text.contains(marks), "{line}");
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(!told.contains(marks), "{line}: {told}");
        if output.status.code() == Some(0) && is_json(&text) {
            let read: Value = serde_json::from_str(&text).unwrap();
            let named = read.to_string().contains("a\u{202e}b");
            assert!(named || !text.contains("\\u202e"), "{line}: {text}");
            assert!(named || !line.starts_with("modes"), "{text}");
        }
    }
}

#[test]
fn a_report_may_lie_in_a_folder_that_the_same_run_makes() {
    let folder = folder("report");
    for line in [
        "analyze bat.json --out D --report D/r.md",
        "analyze bat.json --out ./D/E --report D/r.html",
        "analyze bat.json --plots D --report ./D/r.html",
        "compare bat.json r161 --plots D --report D/r.html",
    ] {
        succeeded(&bash(&folder, &format!("$S {line} --quiet")));
        assert!(folder.read_names("D").iter().any(|name| name.starts_with("r.")), "{line}");
        fs::remove_dir_all(folder.0.join("D")).unwrap();
    }
    let told = refused(&bash(&folder, "$S analyze bat.json --out D --report D/none/r.html"));
    assert!(told.contains("cannot write D/none/r.html") && !folder.0.join("D").exists(), "{told}");
}

#[test]
fn the_licences_of_everything_in_the_program_come_with_it() {
    let folder = folder("licences");
    let text = folder.text(&["licences"]);
    for part in ["UBUNTU FONT LICENCE", "Apache License", "| faer ", "| rustix ", "| windows-sys "]
    {
        assert!(text.contains(part), "{part}");
    }
    assert_eq!(text, folder.text(&["licenses"]));
}

/// Limits on the contents of a file are checked before any computation, and the cost of names is proportional to their
/// length.
#[test]
fn more_than_the_stated_limits_is_refused_at_once() {
    let folder = folder("limits");
    let bat = |more: &str| {
        format!(
            r#"{{ "format": "sweetspot-bat/1", "name": "d", "material": {{ "density": 700, "youngs_modulus": 15e9 }},
            "profile": {{ "interpolation": "linear", "x": [0, 0.84], "radius": [0.012, 0.03] }}{more} }}"#
        )
    };
    let many = |one: &str, count: usize| vec![one; count].join(", ");
    let tapes =
        format!(", \"tapes\": [{}]", many(r#"{ "from": 0, "to": 0.1, "mass": 1e-5 }"#, 401));
    folder.write("tapes.json", bat(&tapes));
    let targets = many(r#"{ "name": "mass_kg", "change": "-1 %" }"#, 21);
    folder
        .write("aim.json", format!(r#"{{ "format": "sweetspot-aim/1", "targets": [{targets}] }}"#));
    folder.write("bat.json", bat(""));
    let paths: Vec<String> =
        (0..101).map(|k| format!(r#""bat.p{k}": {{ "values": [1, 2] }}"#)).collect();
    let study = format!(
        r#"{{ "format": "sweetspot-study/1", "bat": "bat.json", "vary": {{ {} }} }}"#,
        paths.join(", ")
    );
    folder.write("study.json", &study);
    // Of a radius of 1 to 1.1 mm.
    folder.write("wire.json", bat("").replace("0.012, 0.03", "1e-3, 1.1e-3"));
    for (arguments, told) in [
        (&["modes", "tapes.json"][..], ["tapes", "401 items", "400 at most"]),
        (&["aim", "bat.json", "aim.json"], ["targets", "21 items", "20 at most"]),
        (&["study", "study.json", "--out", "D"], ["vary", "101 paths", "100 at most"]),
        (&["modes", "bat.json", "-n", "401"], ["401", "--modes", "400"]),
        (&["hit", "wire.json"], ["2.04e-3 kg", "carries this one along", "1.45e-2 kg at least"]),
        (&["analyze", "wire.json"], ["2.04e-3 kg", "carries this one along", "sweetspot modes"]),
    ] {
        let output = folder.run(arguments);
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{arguments:?} {error}");
        assert!(told.iter().all(|part| error.contains(part)), "{arguments:?} {error}");
    }
}
