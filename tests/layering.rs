//! The order of chapters, and of files in a chapter, is the architecture: each uses only those declared above it.
//! Chapters and files are read from the source tree.

mod budgets;
mod common;

use std::fs;
use std::path::{Path, PathBuf};

use common::folder::Folder;

/// Names declared by `mod x;` lines, in order.
fn declared(file: &Path) -> Vec<String> {
    let text = fs::read_to_string(file).unwrap_or_default();
    let names = text.lines().filter_map(|line| {
        let name = line.strip_prefix("pub(crate) ").or(line.strip_prefix("pub ")).unwrap_or(line);
        name.strip_prefix("mod ")?.strip_suffix(';').map(str::to_owned)
    });
    names.collect()
}

fn files(path: &Path) -> Vec<PathBuf> {
    if !path.is_dir() {
        return vec![path.to_owned()];
    }
    let entries = fs::read_dir(path).unwrap().map(|entry| entry.unwrap().path());
    entries
        .flat_map(|path| files(&path))
        .filter(|path| path.extension().is_some_and(|e| e == "rs"))
        .collect()
}

/// The paths that a use names, groups written out: `a::{b, c::d}` is `a::b` and `a::c::d`.
fn written_out(path: &str) -> Vec<String> {
    let Some(open) = path.find('{') else { return vec![path.trim().to_owned()] };
    let (before, inside) = (&path[..open], &path[open + 1..path.rfind('}').unwrap()]);
    let (mut parts, mut depth) = (vec![String::new()], 0);
    for c in inside.chars() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                parts.push(String::new());
                continue;
            }
            _ => {}
        }
        parts.last_mut().unwrap().push(c);
    }
    let parts = parts.iter().filter(|part| !part.trim().is_empty());
    parts.flat_map(|part| written_out(&format!("{}{}", before.trim(), part.trim()))).collect()
}

/// Every path in the code of a file that begins in the crate, as `chapter::file::…`. Tests and comments may refer to
/// everything.
fn used(source: &Path, file: &Path) -> Vec<String> {
    let text = fs::read_to_string(file).unwrap();
    let code = text.split("#[cfg(test)]").next().unwrap_or_default();
    let lines = code.lines().filter(|line| !line.trim_start().starts_with("//"));
    let code: String = lines.map(|line| format!("{line}\n")).collect();
    let mut room: Vec<String> = file
        .parent()
        .unwrap()
        .strip_prefix(source)
        .unwrap()
        .iter()
        .map(|part| part.to_str().unwrap().to_owned())
        .collect();
    // In a room's contents page `super` is the room above, in its files the room itself.
    if file.ends_with("mod.rs") {
        room.pop();
    }
    let mut paths = vec![];
    for (start, len) in ["crate::", "super::"]
        .iter()
        .flat_map(|word| code.match_indices(word).map(|(at, word)| (at, word.len())))
    {
        if code[..start].ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == ':') {
            continue;
        }
        let rest = &code[start + len..];
        let mut depth = 0;
        let end = rest.find(|c: char| {
            depth += i32::from(c == '{') - i32::from(c == '}');
            depth < 0 || depth == 0 && !(c.is_alphanumeric() || "_:}".contains(c))
        });
        let path = &rest[..end.unwrap_or(rest.len())];
        let mut from = if code[start..].starts_with("super") { room.clone() } else { vec![] };
        for path in written_out(path) {
            let mut path = path.as_str();
            while let Some(above) = path.strip_prefix("super::") {
                from.pop();
                path = above;
            }
            paths.push(from.iter().map(|part| format!("{part}::")).collect::<String>() + path);
        }
    }
    paths
}

/// Violations: uses of `prefix::later` in a module declared before `later`, in this module and in all modules inside.
fn reaching_back(source: &Path, room: &Path, root: &str) -> Vec<String> {
    let modules = declared(&room.join(root));
    let prefix: String = room
        .strip_prefix(source)
        .unwrap()
        .iter()
        .map(|part| format!("{}::", part.to_str().unwrap()))
        .collect();
    let mut complaints = Vec::new();
    for (k, module) in modules.iter().enumerate() {
        let (single, inner) = (room.join(format!("{module}.rs")), room.join(module));
        let sources = if single.exists() { vec![single] } else { files(&inner) };
        for file in sources {
            for path in used(source, &file) {
                let later = modules[k + 1..].iter().find(|later| {
                    path.strip_prefix(&format!("{prefix}{later}"))
                        .is_some_and(|rest| rest.is_empty() || rest.starts_with("::"))
                });
                if let Some(later) = later {
                    let file = file.strip_prefix(source).unwrap().display();
                    complaints.push(format!("{file} uses {path}, {later} is declared below it"));
                }
            }
        }
        if inner.is_dir() {
            complaints.extend(reaching_back(source, &inner, "mod.rs"));
        }
    }
    complaints
}

/// The folder of the whole project.
fn top() -> &'static Path {
    Path::new(env!("SWEETSPOT_TOP"))
}

fn source() -> PathBuf {
    top().join("src")
}

/// The crates, each after those that it uses.
const CRATES: [&str; 6] = ["uff58", "tap", "study", "proof", "report", "cli"];

#[test]
fn no_module_reaches_back() {
    let crates = CRATES.map(|name| top().join("crates").join(name).join("src"));
    for source in [source()].iter().chain(&crates) {
        let root = if source.join("lib.rs").exists() { "lib.rs" } else { "main.rs" };
        let complaints = reaching_back(source, source, root);
        assert!(complaints.is_empty(), "{complaints:#?}");
    }
}

/// `src/` holds the chapters and the root, and a chapter's first page is its contents.
#[test]
fn every_chapter_opens_with_its_contents() {
    let chapters = declared(&source().join("lib.rs"));
    let mut found: Vec<String> = fs::read_dir(source())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    found.sort();
    let mut expected: Vec<String> = chapters.iter().cloned().chain(["lib.rs".to_owned()]).collect();
    expected.sort();
    assert_eq!(found, expected);
    let chapters =
        chapters.iter().map(|chapter| (chapter.as_str(), source().join(chapter), "mod.rs"));
    let crates = CRATES.map(|name| {
        let page = if name == "cli" { "main.rs" } else { "lib.rs" };
        (name, top().join("crates").join(name).join("src"), page)
    });
    for (chapter, folder, page) in chapters.chain(crates) {
        let contents = fs::read_to_string(folder.join(page)).unwrap();
        assert!(contents.starts_with("//! "), "{chapter}");
        let said = |line: &str| {
            let line = line.trim();
            line.is_empty()
                || line.starts_with("//")
                || line.starts_with("#")
                || line.ends_with(';') && !line.contains(" fn ")
        };
        // The types of universal files are in the root of their crate, and the program begins in its root.
        if !["uff58", "cli"].contains(&chapter) {
            assert!(contents.lines().count() <= 60, "{chapter}");
            assert!(contents.lines().all(said), "{chapter}: more than a contents page");
        }
        let mut listed = declared(&folder.join(page));
        let mut there: Vec<String> = fs::read_dir(&folder)
            .unwrap()
            .map(|entry| entry.unwrap().path())
            .filter(|path| path.is_dir() || path.extension().is_some_and(|e| e == "rs"))
            .map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned())
            .filter(|name| !["mod", "lib", "main"].contains(&name.as_str()))
            .collect();
        listed.sort();
        there.sort();
        assert_eq!(listed, there, "{chapter}");
    }
}

#[test]
fn planted_uses_of_later_modules_are_found() {
    let folder = Folder::new("layering");
    folder.write("lib.rs", "pub mod room;\npub(crate) mod second;\n");
    folder.write("second.rs", "use crate::room::late::Thing;\n");
    fs::create_dir_all(folder.0.join("room/inner")).unwrap();
    folder.write("room/mod.rs", "mod inner;\nmod late;\n");
    folder.write("room/late.rs", "use super::inner::first::Thing;\n");
    folder.write("room/inner/mod.rs", "mod first;\nmod last;\n");
    let first = "use crate::{other, second::Thing};\nuse super::{last::Thing, last};\n";
    folder.write("room/inner/first.rs", first);
    let last = "fn f() { crate::room::late::g() }\nuse super::super::late::Thing;\n";
    folder.write("room/inner/last.rs", format!("{last}use super::first;\n// crate::second\n"));
    let complaints = reaching_back(&folder.0, &folder.0, "lib.rs");
    let expected = [
        "first.rs uses second::Thing",
        "last.rs uses room::late::g",
        "last.rs uses room::late::Thing",
        "first.rs uses room::inner::last::Thing",
        "first.rs uses room::inner::last,",
    ];
    for expected in expected {
        let found = complaints.iter().filter(|found| found.contains(expected)).count();
        assert_eq!(found, 1, "{expected} in {complaints:#?}");
    }
    assert_eq!(complaints.len(), expected.len(), "{complaints:#?}");
}
