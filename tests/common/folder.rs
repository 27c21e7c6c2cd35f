//! A temporary folder in which the program runs.

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};
use std::sync::atomic::{AtomicUsize, Ordering};

use serde_json::Value;

/// A separate folder for one test, removed afterwards.
pub struct Folder(pub PathBuf);

/// The program, as cargo built it for tests of its crate.
pub fn program() -> &'static str {
    const PROGRAM: Option<&str> = option_env!("CARGO_BIN_EXE_sweetspot");
    PROGRAM.expect("a test of the program's crate")
}

impl Folder {
    pub fn new(name: &str) -> Self {
        static COUNT: AtomicUsize = AtomicUsize::new(0);
        let count = COUNT.fetch_add(1, Ordering::Relaxed);
        let unique = format!("sweetspot-{name}-{}-{count}", std::process::id());
        let path = std::env::temp_dir().join(unique);
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    pub fn write(&self, name: &str, contents: impl AsRef<[u8]>) {
        fs::write(self.0.join(name), contents).unwrap();
    }

    pub fn read(&self, name: &str) -> String {
        fs::read_to_string(self.0.join(name)).unwrap()
    }

    pub fn names(&self) -> Vec<String> {
        self.read_names(".")
    }

    /// The names in a folder inside it.
    pub fn read_names(&self, folder: &str) -> Vec<String> {
        let name = |e: std::io::Result<fs::DirEntry>| e.unwrap().file_name().into_string().unwrap();
        let entries = fs::read_dir(self.0.join(folder)).unwrap();
        let mut names: Vec<String> = entries.map(name).collect();
        names.sort();
        names
    }

    pub fn command(&self, args: &[&str]) -> Command {
        let mut command = Command::new(program());
        command.args(args).current_dir(&self.0);
        command
    }

    /// The program with no signal ignored, wherever the test itself was started.
    pub fn attentive(&self, args: &[&str]) -> Command {
        if cfg!(not(target_os = "linux")) {
            return self.command(args);
        }
        let mut command = Command::new("env");
        command.args(["--default-signal", program()]);
        command.args(args).current_dir(&self.0);
        command
    }

    pub fn run(&self, args: &[&str]) -> Output {
        self.command(args).output().unwrap()
    }

    /// Standard output of a run that must succeed with an empty standard error, except for a remark about an unknown
    /// shear modulus.
    pub fn text(&self, args: &[&str]) -> String {
        let output = self.run(args);
        let told = but_shear(&String::from_utf8_lossy(&output.stderr));
        assert!(output.status.code() == Some(0) && told.is_empty(), "{args:?}: {told}");
        String::from_utf8(output.stdout).unwrap()
    }

    pub fn json(&self, args: &[&str]) -> Value {
        serde_json::from_str(&self.text(args)).unwrap()
    }
}

/// The text of standard error without expected remarks: a missing shear modulus in the last line, the densities of two
/// bats of the tests, the progress of a study, and a wall for a solid bat.
pub fn but_shear(told: &str) -> String {
    let effective = "warning: northwestern_aluminium: 4794 kg/m³ with";
    let by_path = "northwestern_aluminium.json: 4794 kg/m³ with";
    // The bat with every possible member.
    let full = "bat-1.json: to weigh so much it must have";
    // How far a study is, every half minute.
    let far = " a second";
    // The solid one of two bats that are compared with one wall.
    let wall = "--wall-stiffness gives a wall to a solid bat";
    let known = [effective, by_path, full, far, wall];
    let lines = told.lines().filter(|line| !known.iter().any(|known| line.contains(known)));
    let mut lines: Vec<&str> = lines.collect();
    if lines.last().is_some_and(|line| line.starts_with("warning: shear is left out")) {
        lines.pop();
    }
    lines.iter().flat_map(|line| [line, "\n"]).collect()
}

impl Drop for Folder {
    fn drop(&mut self) {
        // Nothing depends on it.
        let _ = fs::remove_dir_all(&self.0);
    }
}
