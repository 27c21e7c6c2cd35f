//! README.md is short, its links have targets, and the answers of the program shown in it and in docs/ are those
//! printed now.

use crate::common;

use std::fs;
use std::path::{Path, PathBuf};

use common::folder::Folder;

fn root() -> &'static Path {
    Path::new(env!("SWEETSPOT_TOP"))
}

fn page(name: &str) -> String {
    fs::read_to_string(root().join(name)).unwrap().replace("\r\n", "\n")
}

/// The indented block whose first line begins with this, without its indent and without blank lines.
fn block(text: &str, first: &str) -> Vec<String> {
    let before = |line: &&str| !line.strip_prefix("    ").is_some_and(|l| l.starts_with(first));
    let lines = text.lines().skip_while(before);
    let block = lines.take_while(|line| line.is_empty() || line.starts_with("    "));
    let block = block.filter_map(|line| line.strip_prefix("    "));
    block.map(|line| line.trim_end().to_owned()).collect()
}

/// The output from the line that begins with this, without blank lines.
fn printed(text: &str, first: &str) -> Vec<String> {
    let lines = text.lines().skip_while(|line| !line.starts_with(first));
    lines.filter(|line| !line.is_empty()).map(|line| line.trim_end().to_owned()).collect()
}

/// A text in one line, whatever its line breaks.
fn joined(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Whether the words are equal; numbers may differ as ratios of errors near round-off do between machines.
fn same(shown: &str, now: &str) -> bool {
    const ROUND_OFF: f64 = 0.05;
    let (a, b): (Vec<_>, Vec<_>) =
        (shown.split_whitespace().collect(), now.split_whitespace().collect());
    let near = |(a, b): (&&str, &&str)| match (a.parse::<f64>(), b.parse::<f64>()) {
        (Ok(a), Ok(b)) => (a - b).abs() <= ROUND_OFF,
        _ => a == b,
    };
    a.len() == b.len() && a.iter().zip(&b).all(near)
}

#[test]
fn the_readme_is_short_and_begins_with_a_picture_both_commands_and_an_answer() {
    let readme = page("README.md");
    assert!(readme.lines().count() <= 150, "{}", readme.lines().count());
    let first: Vec<&str> = readme.lines().take(40).collect();
    for begin in ["![", "    cargo run --release -- ", "    ./check", "      fastest ball"] {
        assert!(first.iter().any(|line| line.starts_with(begin)), "{begin}");
    }
}

#[test]
fn the_readme_has_every_verb() {
    let help = Folder::new("verbs").text(&["--help"]);
    let verbs = help.lines().skip_while(|line| *line != "Describe a bat:");
    let verbs = verbs.take_while(|line| *line != "Options:");
    let verbs = verbs.filter_map(|line| line.strip_prefix("  ")?.split_whitespace().next());
    let verbs: Vec<&str> = verbs.collect();
    assert!(verbs.len() > 10, "{verbs:?}");
    let readme = page("README.md");
    let table: String = readme.lines().filter(|line| line.starts_with("| `")).collect();
    let missing: Vec<_> =
        verbs.iter().filter(|verb| !table.contains(&format!("`{verb}`"))).collect();
    assert!(missing.is_empty(), "{missing:?}");
}

#[test]
fn the_readme_shows_ten_lines_of_the_first_command() {
    let folder = Folder::new("sample");
    let bat = root().join("meshes/r161.json");
    let now = folder.text(&["analyze", bat.to_str().unwrap()]);
    let sample = block(&page("README.md"), "Louisville Slugger R161");
    assert_eq!(sample.len(), 10, "{sample:#?}");
    let mut lines = now.lines();
    for shown in &sample {
        assert!(lines.any(|line| line.trim_end() == shown), "stale or out of order: {shown}");
    }
}

/// The one run of `validate --summary`, which ends with the table of `validate --promise`.
#[test]
fn known_answers_and_the_promise_are_todays() {
    let now = Folder::new("promise").text(&["validate", "--summary", "--full"]);
    let accuracy = page("docs/accuracy.md");
    let (shown, found) = (block(&accuracy, "The promise: "), printed(&now, "The promise: "));
    assert!(found.len() > 60, "{found:#?}");
    for (shown, found) in shown.iter().zip(&found) {
        assert!(same(shown, found), "docs/accuracy.md is stale:\n{shown}\n{found}");
    }
    assert_eq!(shown.len(), found.len(), "docs/accuracy.md is stale");

    let sum = now.lines().find(|line| line.contains(" missed; ")).unwrap();
    let numbers: Vec<&str> = sum.split(' ').filter(|word| word.parse::<u32>().is_ok()).collect();
    let [cases, rows, "0", information] = numbers[..] else { panic!("{sum}") };
    let bats = found.iter().skip_while(|line| !line.starts_with("bat ")).skip(1);
    let bats = bats.take_while(|line| !line.starts_with("all ")).count();
    let hits = found.last().unwrap().split_whitespace().nth(1).unwrap();
    let checked = format!("{rows} numbers in {cases} cases are checked, none of them missed");
    for text in [joined(&page("README.md")), joined(&accuracy)] {
        for said in [&checked, &format!("{bats} bats"), &format!("{hits} random hits")] {
            assert!(text.contains(said), "{said}");
        }
    }
    let more = format!("{information} more are shown for information");
    assert!(joined(&accuracy).contains(&more), "{more}");
}

/// The only run of `validate --extremes`. Values found and stated near round-off, times and memory depend on the
/// machine.
#[test]
fn rows_and_verdicts_of_the_extremes_are_todays() {
    let now = Folder::new("extremes").text(&["validate", "--extremes"]);
    let lasting = |lines: Vec<String>| -> Vec<String> {
        let rows = lines.into_iter().filter(|line| !line.contains(" s, peak "));
        let row = |line: String| match line.split_whitespace().last() {
            Some(verdict @ ("right" | "refused" | "wrong")) if !line.starts_with(' ') => {
                let asked: String = line.chars().take(48).collect();
                format!("{} {verdict}", asked.trim_end())
            }
            _ => line,
        };
        rows.map(row).collect()
    };
    const FIRST: &str = "Right within three times";
    let shown = lasting(block(&page("docs/accuracy.md"), FIRST));
    let found = lasting(printed(&now, FIRST));
    assert!(found.len() > 30, "{found:#?}");
    assert_eq!(shown, found, "docs/accuracy.md is stale");
}

/// The targets of the links of a page, except those on the web.
fn links(text: &str) -> Vec<&str> {
    let targets = text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    targets.filter(|target| !target.starts_with("http")).collect()
}

/// The headings of a page as its links name them.
fn headings(text: &str) -> Vec<String> {
    let headings = text.lines().filter(|line| line.starts_with('#'));
    let named = |line: &str| -> String {
        let kept = |c: &char| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_');
        let words = line.trim_start_matches('#').trim().to_lowercase();
        words.chars().filter(kept).map(|c| if c == ' ' { '-' } else { c }).collect()
    };
    headings.map(named).collect()
}

#[test]
fn every_link_leads_somewhere() {
    let documents = fs::read_dir(root().join("docs")).unwrap().map(|entry| entry.unwrap().path());
    let mut pages: Vec<PathBuf> = documents.collect();
    pages.retain(|path| path.extension().is_some_and(|end| end == "md"));
    pages.extend(["README.md", "CHANGELOG.md", "SECURITY.md"].map(|name| root().join(name)));
    let mut broken = Vec::new();
    for from in &pages {
        let text = fs::read_to_string(from).unwrap();
        for link in links(&text) {
            let (file, heading) = link.split_once('#').unwrap_or((link, ""));
            let to = if file.is_empty() { from.clone() } else { from.with_file_name(file) };
            let there = to.exists()
                && (heading.is_empty()
                    || headings(&fs::read_to_string(&to).unwrap()).contains(&heading.to_owned()));
            if !there {
                broken.push(format!("{}: {link}", from.display()));
            }
        }
    }
    assert!(broken.is_empty(), "{broken:#?}");
    // README.md names every page of docs/.
    let readme = page("README.md");
    for name in pages.iter().filter(|path| path.parent() == Some(&root().join("docs"))) {
        let name = format!("(docs/{})", name.file_name().unwrap().to_str().unwrap());
        assert!(readme.contains(&name), "{name}");
    }
}
