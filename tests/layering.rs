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

/// The source files of a module: `x.rs`, or all of `x/` and of the folders in it.
fn sources(folder: &Path, module: &str) -> Vec<PathBuf> {
    let single = folder.join(format!("{module}.rs"));
    if single.exists() { vec![single] } else { files(&folder.join(module)) }
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let below = |path: PathBuf| if path.is_dir() { files(&path) } else { vec![path] };
    entries.flat_map(below).collect()
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
                // In a room, `super` is the room.
                let own = root == "mod.rs" && file.parent() == Some(folder);
                let near = own.then(|| format!("super::{later}"));
                let used = [Some(format!("{prefix}::{later}")), near];
                let ends =
                    |rest: &str| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_');
                for used in used.iter().flatten() {
                    if code.iter().any(|line| line.split(used).skip(1).any(ends)) {
                        let file = file.display();
                        complaints.push(format!("{file} uses {used}, declared below it"));
                    }
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
    let rooms = ["beam", "eigen", "trade", "collision", "comparison", "measured", "report"];
    for room in rooms.into_iter().chain(["exchange", "exchange/uff", "measured_file"]) {
        let prefix = format!("crate::{}", room.replace('/', "::"));
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

#[test]
fn a_planted_use_in_a_folder_of_a_folder_is_found() {
    let folder = Folder::new("layering-deep");
    folder.write("lib.rs", "pub mod room;\nmod second;\n");
    folder.write("second.rs", "");
    fs::create_dir_all(folder.0.join("room/inner")).unwrap();
    folder.write("room/mod.rs", "mod inner;\nmod late;\n");
    folder.write("room/late.rs", "");
    folder.write("room/inner/mod.rs", "mod first;\nmod last;\n");
    folder.write("room/inner/first.rs", "use crate::second::Thing;\nuse super::last::Thing;\n");
    folder.write("room/inner/last.rs", "use crate::room::late::Thing;\nuse super::first::Thing;\n");
    let of = |part: &str, root, prefix| reaching_back(&folder.0.join(part), root, prefix).len();
    assert_eq!(of("", "lib.rs", "crate"), 1);
    assert_eq!(of("room", "mod.rs", "crate::room"), 1);
    assert_eq!(of("room/inner", "mod.rs", "crate::room::inner"), 1);
}

/// What could be lifted out needs nothing of the crate but its errors.
#[test]
fn the_universal_files_are_on_their_own() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/exchange/uff");
    for file in files(&folder) {
        let text = fs::read_to_string(&file).unwrap();
        let code = text.split("#[cfg(test)]").next().unwrap_or_default();
        let code = code.lines().filter(|line| !line.trim_start().starts_with("//"));
        let other = |line: &&str| line.contains("crate::") && !line.contains("crate::error::");
        assert_eq!(code.clone().find(other), None, "{}", file.display());
    }
}
