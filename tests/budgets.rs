//! The number of lines of each part, verb, file and function is at most that in `budgets.toml`.

use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;

use super::{CRATES, files, source, top};

/// The present limit of a budget, and its goal.
struct Budget {
    name: String,
    most: usize,
    goal: usize,
}

/// The budgets under a heading of `budgets.toml`: lines `name = { most = 1, goal = 1 }`.
fn budgets(heading: &str) -> Vec<Budget> {
    let text = fs::read_to_string(top().join("budgets.toml")).unwrap();
    let after = text.split(&format!("[{heading}]\n")).nth(1).unwrap();
    let lines = after.lines().take_while(|line| !line.starts_with('['));
    let lines = lines.filter(|line| !line.is_empty() && !line.starts_with('#'));
    let budget = |line: &str| {
        let (name, rest) = line.split_once(" = ").unwrap();
        let numbers: Vec<usize> =
            rest.split(|c: char| !c.is_ascii_digit()).filter_map(|n| n.parse().ok()).collect();
        let &[most, goal] = &numbers[..] else { panic!("{line}") };
        Budget { name: name.trim_matches('"').to_owned(), most, goal }
    };
    lines.map(budget).collect()
}

/// A source file by its path in the project, with its code without the tests in it.
fn sources() -> Vec<(String, String)> {
    let code = |path: PathBuf| {
        let name = path.strip_prefix(top()).unwrap().to_str().unwrap().replace('\\', "/");
        let text = fs::read_to_string(&path).unwrap();
        let code = text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default();
        (name, code.to_owned())
    };
    let crates = CRATES.map(|name| top().join("crates").join(name).join("src"));
    let lab = ["lab/src", "lab/clock/src"].map(|name| top().join(name));
    [source()]
        .iter()
        .chain(&crates)
        .chain(&lab)
        .flat_map(|source| files(source))
        .map(code)
        .collect()
}

/// Whether a file beyond the engine belongs to a verb, by the words of its path.
fn is_of(path: &str, words: &str) -> bool {
    let beyond = ["study", "report", "cli"].map(|name| format!("crates/{name}/src/"));
    let Some(within) = beyond.iter().find_map(|start| path.strip_prefix(start)) else {
        return false;
    };
    let names = within.trim_end_matches(".rs").split(['/', '_']).collect::<BTreeSet<_>>();
    words.split(' ').any(|word| names.contains(word))
}

/// Functions of more than 60 lines: from the line with `fn` to the bracket under its beginning, where they have a body.
fn long_functions(code: &str) -> Vec<&str> {
    let lines: Vec<&str> = code.lines().collect();
    let begins = |line: &str| {
        let line = line.trim_start();
        !line.ends_with(';')
            && ["fn ", "pub fn ", "pub(crate) fn ", "pub(super) fn ", "const fn ", "pub const fn "]
                .iter()
                .any(|start| line.starts_with(start))
    };
    let long = |k: usize| {
        let indent = lines[k].len() - lines[k].trim_start().len();
        let end = format!("{}}}", " ".repeat(indent));
        lines[k..].iter().position(|line| *line == end).is_some_and(|length| length >= 60)
    };
    (0..lines.len()).filter(|k| begins(lines[*k]) && long(*k)).map(|k| lines[k]).collect()
}

/// Compares counts with the budgets of a heading. A budget far above its count must be lowered, so that improvements
/// last.
fn hold(heading: &str, slack: usize, count: impl Fn(&str) -> usize) {
    let wrong = |Budget { name, most, goal }: Budget| {
        let count = count(&name);
        let told = format!("{name}: {count} lines, {most} at most, {goal} in the end");
        let stale = most > goal && count + slack < most;
        (count > most || stale).then_some(told)
    };
    let wrong: Vec<String> = budgets(heading).into_iter().filter_map(wrong).collect();
    assert!(wrong.is_empty(), "{heading}:\n{}", wrong.join("\n"));
}

fn lines(of: impl Fn(&str) -> bool) -> usize {
    let sources = sources();
    sources.iter().filter(|(path, _)| of(path)).map(|(_, code)| code.lines().count()).sum()
}

#[test]
fn parts_and_verbs_keep_their_budgets() {
    hold("parts", 300, |name| lines(|path| path.starts_with(name)));
    hold("verbs", 100, |name| lines(|path| is_of(path, name)));
}

#[test]
fn files_and_functions_keep_their_budgets() {
    let known = budgets("long files");
    for (path, code) in sources() {
        let length = code.lines().count();
        let most = known.iter().find(|budget| budget.name == path).map_or(500, |known| known.most);
        assert!(length <= most, "{path}: {length} lines, {most} at most");
    }
    hold("long files", 50, |name| lines(|path| path == name));
    hold("functions of more than 60 lines", 0, |_| {
        sources().iter().map(|(_, code)| long_functions(code).len()).sum()
    });
}
