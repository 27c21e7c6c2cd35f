//! The copy of the workspace with all mutants of a sample in it, each with a switch.

use std::collections::BTreeSet;
use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::Result;
use crate::sites::{Change, Site};

/// The module in every crate of the copy that selects the active mutant.
const SWITCH: &str = "//! Which planted error is on.

use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

static NUMBER: AtomicUsize = AtomicUsize::new(usize::MAX);

/// Whether the mutant with that number is active: `MUTANT` in the environment.
#[inline(always)]
pub fn on(number: usize) -> bool {
    let mut wanted = NUMBER.load(Relaxed);
    if wanted == usize::MAX {
        wanted = asked();
    }
    wanted == number
}

#[cold]
#[inline(never)]
fn asked() -> usize {
    let wanted = std::env::var(\"MUTANT\").ok().and_then(|n| n.parse().ok()).unwrap_or(0);
    NUMBER.store(wanted, Relaxed);
    wanted
}
";

/// Writes the copy with those of the sites that compile, and returns these. The number of a site is its position in the
/// list, counted from 1.
pub fn viable(root: &Path, copy: &Path, drawn: Vec<Site>) -> Result<Vec<(usize, Site)>> {
    let mut sites: Vec<(usize, Site)> =
        drawn.into_iter().enumerate().map(|(k, s)| (k + 1, s)).collect();
    fs::create_dir_all(copy)?;
    let known = copy.join("unviable.txt");
    let mut out: BTreeSet<usize> = match fs::read_to_string(&known) {
        Ok(text) => text.split_whitespace().filter_map(|n| n.parse().ok()).collect(),
        Err(_) => BTreeSet::new(),
    };
    let mut compiled = known.exists();
    loop {
        sites.retain(|(number, _)| !out.contains(number));
        let (planted, changed) = write(root, copy, &sites)?;
        if compiled && !changed {
            return Ok(sites);
        }
        let failed = failing(copy, &planted)?;
        if failed.is_empty() {
            fs::write(&known, numbers(&out))?;
            return Ok(sites);
        }
        compiled = false;
        println!("{} errors do not compile: {failed:?}", failed.len());
        out.extend(failed);
    }
}

fn numbers(of: &BTreeSet<usize>) -> String {
    of.iter().map(|number| format!("{number}\n")).collect()
}

/// The position of a mutant in a file of the copy.
struct Planted {
    number: usize,
    file: PathBuf,
    range: Range<usize>,
}

/// The positions of all mutants in the copy, and whether a source file of it changed.
fn write(root: &Path, copy: &Path, sites: &[(usize, Site)]) -> Result<(Vec<Planted>, bool)> {
    let listed = Command::new("git").args(["ls-files"]).current_dir(root).output()?.stdout;
    let (mut all, mut changed) = (Vec::new(), false);
    for name in String::from_utf8(listed)?.lines().map(Path::new) {
        let target = copy.join(name);
        fs::create_dir_all(target.parent().ok_or("a file lies in a folder")?)?;
        let here: Vec<_> = sites.iter().filter(|(_, site)| site.file == *name).collect();
        let mut bytes = fs::read(root.join(name))?;
        if !here.is_empty() {
            let mut planting = Planting { text: String::from_utf8(bytes)?, out: String::new() };
            let whole = 0..planting.text.len();
            let placed = planting.render(whole, &here);
            all.extend(placed.into_iter().map(|(number, range)| Planted {
                number,
                file: name.to_owned(),
                range,
            }));
            bytes = planting.out.into_bytes();
        }
        if is_root(name) {
            bytes.extend(b"mod mutant;\n");
            let switch = target.with_file_name("mutant.rs");
            if !switch.exists() {
                fs::write(switch, SWITCH)?;
            }
        }
        // An unchanged file keeps its time, and is not built again.
        if fs::read(&target).ok().as_ref() != Some(&bytes) {
            fs::write(&target, bytes)?;
            changed |= is_built(name);
        }
    }
    Ok((all, changed))
}

/// Whether a file is of the library, of a crate or of the page's core.
fn is_built(name: &Path) -> bool {
    ["src", "crates", "lab/src"].iter().any(|folder| name.starts_with(folder))
}

/// Whether it is the root of one of them: each has a switch of its own.
fn is_root(name: &Path) -> bool {
    is_built(name) && (name.ends_with("src/lib.rs") || name.ends_with("src/main.rs"))
}

struct Planting {
    text: String,
    out: String,
}

impl Planting {
    /// Writes that part of the source with these sites in it, the outermost first; returns their positions.
    fn render(
        &mut self,
        range: Range<usize>,
        sites: &[&(usize, Site)],
    ) -> Vec<(usize, Range<usize>)> {
        let (mut at, mut placed) = (range.start, Vec::new());
        let mut left: Vec<&(usize, Site)> = sites.to_vec();
        left.sort_by_key(|(_, s)| (s.range.start, usize::MAX - s.range.end));
        while !left.is_empty() {
            let outer = left.remove(0);
            let (number, site) = outer;
            let within =
                |s: &Site| s.range.start >= site.range.start && s.range.end <= site.range.end;
            let inner = left.iter().take_while(|(_, s)| s.range.start < site.range.end);
            let inner: Vec<_> = inner.filter(|(_, s)| within(s)).copied().collect();
            left.drain(..inner.len());
            self.out.push_str(&self.text[at..site.range.start]);
            at = site.range.end;
            let start = self.out.len();
            let on = format!("crate::mutant::on({number})");
            let end = match &site.change {
                Change::Expression(other) => {
                    self.out.push_str(&format!("(if {on} {{ {other} }} else {{ "));
                    " })"
                }
                Change::Removal => {
                    self.out.push_str(&format!("if !{on} {{ "));
                    " }"
                }
                Change::Insertion(text) => {
                    self.out.push_str(&format!(" if {on} {{ {text} }} "));
                    ""
                }
            };
            placed.extend(self.render(site.range.clone(), &inner));
            self.out.push_str(end);
            placed.push((*number, start..self.out.len()));
        }
        self.out.push_str(&self.text[at..range.end]);
        placed
    }
}

/// The errors at which the compiler stops.
fn failing(copy: &Path, planted: &[Planted]) -> Result<BTreeSet<usize>> {
    let mut check = Command::new("cargo");
    check.args(["check", "--locked", "--lib", "--bins", "--keep-going"]).args(crate::PACKAGES);
    check.args(["--message-format", "short"]).current_dir(copy);
    let output = check.output()?;
    let mut failed = BTreeSet::new();
    if output.status.success() {
        return Ok(failed);
    }
    let told = String::from_utf8(output.stderr)?;
    for line in told.lines().filter(|line| line.contains(": error")) {
        let mut parts = line.splitn(4, ':');
        let (Some(file), Some(row), Some(column)) = (parts.next(), parts.next(), parts.next())
        else {
            continue;
        };
        let (Ok(row), Ok(column)) = (row.parse::<usize>(), column.parse::<usize>()) else {
            continue;
        };
        let text = fs::read_to_string(copy.join(file))?;
        let Some(before) = text.split_inclusive('\n').nth(row - 1) else { continue };
        let start: usize = text.split_inclusive('\n').take(row - 1).map(str::len).sum();
        let offset: usize = before.chars().take(column - 1).map(char::len_utf8).sum();
        let here = planted
            .iter()
            .filter(|p| p.file == Path::new(file) && p.range.contains(&(start + offset)));
        // The innermost one; an error elsewhere follows from one on the line or near it.
        let near = || {
            let away = |p: &&Planted| p.range.start.abs_diff(start + offset);
            planted.iter().filter(|p| p.file == Path::new(file)).min_by_key(away)
        };
        if let Some(p) = here.min_by_key(|p| p.range.len()).or_else(near) {
            failed.insert(p.number);
        }
    }
    if failed.is_empty() {
        return Err(format!("the copy does not compile:\n{told}").into());
    }
    Ok(failed)
}
