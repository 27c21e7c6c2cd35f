//! Plants errors (mutants) in sweetspot's sources and counts how many its tests detect.
//!
//! A build costs minutes, so all errors of a sample are built into one copy of the sources and switched on one at a
//! time by an environment variable (mutant schemata: R. H. Untch, A. J. Offutt, M. J. Harrold, Proc. ISSTA '93, 139).
//!
//! ```text
//! mutants ROOT COPY --seed 1 --count 11
//! ```
//!
//! draws `count` errors in each chapter, writes the copy of the workspace ROOT, omits mutants that do not compile, and
//! builds the tests once. For each mutant it runs the tests that `chapters.txt` names for its place, in that order,
//! until one fails; each has run once without a mutant before, which measures its time. The result is a table in
//! `COPY/mutants.txt`. Existing rows are kept: when started again, the program continues where it stopped.

mod chapters;
mod copy;
mod run;
mod sites;

use std::path::PathBuf;

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// The packages that hold mutants and their tests.
const PACKAGES: [&str; 5] =
    ["--workspace", "--exclude", "sweetspot-python", "--exclude", "browser"];

/// The command line.
struct Asked {
    root: PathBuf,
    copy: PathBuf,
    seed: u64,
    /// In each chapter.
    count: usize,
    /// Only these mutants, by number; all of them if empty.
    only: Vec<usize>,
}

const USAGE: &str = "usage: mutants ROOT COPY [--seed N] [--count N] [--only N,N…]";

fn asked() -> Result<Asked> {
    let mut words = std::env::args().skip(1);
    let (Some(root), Some(copy)) = (words.next(), words.next()) else { return Err(USAGE.into()) };
    let (root, copy) = (PathBuf::from(root), PathBuf::from(copy));
    let mut asked = Asked { root, copy, seed: 1, count: 11, only: vec![] };
    while let Some(word) = words.next() {
        let value = words.next().ok_or(USAGE)?;
        match word.as_str() {
            "--seed" => asked.seed = value.parse()?,
            "--count" => asked.count = value.parse()?,
            "--only" => {
                asked.only =
                    value.split(',').map(str::parse).collect::<std::result::Result<_, _>>()?
            }
            _ => return Err(USAGE.into()),
        }
    }
    Ok(asked)
}

fn main() -> Result<()> {
    let mut asked = asked()?;
    // The tests run in the copy, where a relative path would refer to another place.
    std::fs::create_dir_all(&asked.copy)?;
    asked.root = asked.root.canonicalize()?;
    asked.copy = asked.copy.canonicalize()?;
    let table = asked.root.join("tests/quality/mutants/chapters.txt");
    let chapters = chapters::Chapters::read(&table)?;
    let mut drawn = Vec::new();
    for folder in chapters.folders() {
        let all = sites::of_folder(&asked.root, &folder)?;
        println!("{} places for an error in {}", all.len(), folder.display());
        drawn.extend(sites::drawn(all, asked.seed, asked.count));
    }
    let count = drawn.len();
    let built = copy::viable(&asked.root, &asked.copy, drawn)?;
    println!("{} of {count} drawn errors compile", built.len());
    let list: String = built.iter().map(|(number, site)| format!("{number}\t{site}\n")).collect();
    std::fs::write(asked.copy.join("sites.txt"), list)?;
    run::all(&asked.copy, &built, &chapters, &asked.only)
}
