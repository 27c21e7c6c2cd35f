//! The order of the modules is the architecture: each uses only those declared above it.

mod common;

use std::fs;
use std::path::{Path, PathBuf};

use common::folder::Folder;

/// Names declared by `mod x;` lines, in order.
fn declared(file: &Path) -> Vec<String> {
    let text = fs::read_to_string(file).unwrap();
    let names = text.lines().filter_map(|line| {
        line.trim_start_matches("pub ").strip_prefix("mod ")?.strip_suffix(';').map(str::to_owned)
    });
    names.collect()
}

/// The source files of a module: `x.rs`, or all of `x/`.
fn sources(folder: &Path, module: &str) -> Vec<PathBuf> {
    let single = folder.join(format!("{module}.rs"));
    if single.exists() {
        return vec![single];
    }
    fs::read_dir(folder.join(module)).unwrap().map(|entry| entry.unwrap().path()).collect()
}

/// Complaints about uses of `prefix::later` in a module declared before `later`.
fn reaching_back(folder: &Path, root: &str, prefix: &str) -> Vec<String> {
    let modules = declared(&folder.join(root));
    assert!(modules.len() > 1, "no modules found in {root}");
    let mut complaints = Vec::new();
    for (k, module) in modules.iter().enumerate() {
        for file in sources(folder, module) {
            let text = fs::read_to_string(&file).unwrap();
            // Tests may look at everything, and so may the prose.
            let code = text.split("#[cfg(test)]").next().unwrap_or_default();
            let code = code.lines().filter(|line| !line.trim_start().starts_with("//"));
            let code: Vec<&str> = code.collect();
            // Grouped and relative paths would hide a use from this test.
            let hidden =
                |line: &&str| line.contains("use crate::{") || line.contains("super::super");
            if let Some(line) = code.iter().find(|line| hidden(line)) {
                complaints.push(format!("{}: write {line} out", file.display()));
            }
            for later in &modules[k + 1..] {
                let used = format!("{prefix}::{later}");
                let ends =
                    |rest: &str| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_');
                if code.iter().any(|line| line.split(&used).skip(1).any(ends)) {
                    complaints.push(format!("{} uses {used}, declared below it", file.display()));
                }
            }
        }
    }
    complaints
}

#[test]
fn no_module_reaches_back() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut complaints = reaching_back(&source, "lib.rs", "crate");
    for room in ["beam", "eigen", "trade", "collision", "report", "plot"] {
        let prefix = format!("crate::{room}");
        complaints.extend(reaching_back(&source.join(room), "mod.rs", &prefix));
    }
    assert!(complaints.is_empty(), "{complaints:#?}");
}

#[test]
fn a_planted_use_of_a_later_module_is_found() {
    let folder = Folder::new("layering");
    folder.write("lib.rs", "pub mod first;\nmod second;\n");
    folder.write("first.rs", "use crate::second::Thing;\n");
    folder.write("second.rs", "use crate::first;\n");
    let complaints = reaching_back(&folder.0, "lib.rs", "crate");
    assert_eq!(complaints.len(), 1, "{complaints:?}");
}
