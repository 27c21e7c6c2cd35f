//! A name given twice never destroys a file of the user.

use crate::common;

use common::folder::Folder;

const BAT: &str = r#"{
  "format": "sweetspot-bat/1",
  "material": "white-ash-dynamic",
  "profile": { "csv": "columns.csv" }
}
"#;

#[test]
fn no_output_takes_the_place_of_an_input_or_of_another_output() {
    let folder = Folder::new("kept");
    for bat in ["bat.json", "modes.json"] {
        folder.write(bat, BAT);
    }
    folder.write("columns.csv", "x_in,diameter_in\n0,1\n20,1\n33,2.5\n");
    folder.write("push.csv", "t_ms,force_n\n0,0\n0.5,2000\n1,0\n");
    folder.text(&["modes", "bat.json", "--json", "m.json"]);
    folder.text(&["convert", "m.json", "--to", "uff", "--out", "lab.uff"]);
    let rows: [(&[&str], &str); 13] = [
        (&["modes", "bat.json", "--json", "bat.json"], "bat.json"),
        (&["modes", "bat.json", "--json", "./columns.csv"], "columns.csv"),
        (&["hit", "bat.json", "--json", "bat.json"], "bat.json"),
        (&["analyze", "bat.json", "--report", "columns.csv.md", "--json", "bat.json"], "bat.json"),
        (&["analyze", "modes.json", "--out", "."], "modes.json"),
        (&["advise", "bat.json", "--json", "bat.json"], "bat.json"),
        (&["trade", "bat.json", "--budget", "1 s", "-n", "2", "--csv", "bat.json"], "bat.json"),
        (&["frf", "bat.json", "--at", "0.6", "--uff", "bat.json"], "bat.json"),
        (&["ring", "bat.json", "--hit", "0.6", "--history", "bat.json"], "bat.json"),
        (
            &["ring", "bat.json", "--at", "0.6", "--force", "push.csv", "--csv", "push.csv"],
            "push.csv",
        ),
        (&["compare", "bat.json", "bat.json", "--csv", "bat.json"], "bat.json"),
        (&["compare", "bat.json", "--measured", "lab.uff", "--json", "lab.uff"], "lab.uff"),
        (&["convert", "m.json", "--to", "csv", "--out", "m.json"], "m.json"),
    ];
    for (args, kept) in rows {
        let before = folder.read(kept);
        let output = folder.run(args);
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{args:?} {told}");
        assert!(told.contains(kept) && told.contains("another name"), "{args:?} {told}");
        assert_eq!(folder.read(kept), before, "{args:?}");
    }
}

/// Which of two documents should have the name cannot be guessed, so neither is written.
#[test]
fn two_outputs_of_one_name_are_refused_before_either_is_written() {
    let folder = Folder::new("two");
    folder.write("bat.json", BAT);
    folder.write("columns.csv", "x_in,diameter_in\n0,1\n20,1\n33,2.5\n");
    let rows: [&[&str]; 11] = [
        &["modes", "bat.json", "--csv", "x", "--json", "x"],
        &["hit", "bat.json", "--csv", "x", "--json", "./x"],
        &["bbcor", "bat.json", "--csv", "x", "--json", "x"],
        &["frf", "bat.json", "--at", "0.6", "--csv", "x", "--json", "x"],
        &["frf", "bat.json", "--at", "0.6", "--csv", "x", "--uff", "x"],
        &["ring", "bat.json", "--hit", "0.6", "--csv", "x", "--history", "x"],
        &["ring", "bat.json", "--hit", "0.6", "--wav", "x", "--json", "x"],
        &["trade", "bat.json", "--csv", "x", "--json", "x"],
        &["compare", "bat.json", "bat.json", "--csv", "x", "--json", "x"],
        &["compare", "bat.json", "bat.json", "--csv", "x.html", "--report", "x.html"],
        &["analyze", "bat.json", "--report", "x.html", "--json", "x.html"],
    ];
    for args in rows {
        let output = folder.run(args);
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{args:?} {told}");
        assert!(told.contains("beside --") && told.contains("another name"), "{args:?} {told}");
        assert!(!folder.0.join("x").exists() && !folder.0.join("x.html").exists(), "{args:?}");
    }
    for args in [
        ["frf", "bat.json", "--at", "0.6", "--csv", "-", "--uff", "-"],
        ["ring", "bat.json", "--hit", "0.6", "--csv", "-", "--history", "-"],
    ] {
        let output = folder.run(&args);
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{args:?} {told}");
        assert!(told.contains("one of them on standard output"), "{args:?} {told}");
    }
}

/// Pipes and devices are not protected files.
#[cfg(unix)]
#[test]
fn a_device_may_be_named_twice() {
    let folder = Folder::new("device");
    folder.write("bat.json", BAT);
    folder.write("columns.csv", "x_in,diameter_in\n0,1\n20,1\n33,2.5\n");
    let null = "/dev/null";
    folder.text(&["frf", "bat.json", "--at", "0.6", "--csv", null, "--json", null]);
}
