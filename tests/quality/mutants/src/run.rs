//! Builds the copy's tests once and runs them with one error after the other.

use std::collections::BTreeMap;
use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::os::unix::process::CommandExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::{Duration, Instant};

use crate::Result;
use crate::chapters::Chapters;
use crate::sites::Site;

/// Tests that run together: a test program, or one of its modules.
struct Step<'a> {
    copy: &'a Path,
    name: &'a str,
    program: PathBuf,
    arguments: Vec<String>,
    /// Their time without a mutant.
    takes: Duration,
}

/// How a run ended.
#[derive(PartialEq)]
enum End {
    Passed,
    Failed(String),
    TooLong,
}

/// Runs all mutants that are not yet in `COPY/mutants.txt`, or those requested again, and writes the table.
pub fn all(
    copy: &Path,
    sites: &[(usize, Site)],
    chapters: &Chapters,
    only: &[usize],
) -> Result<()> {
    let programs = build(copy, chapters)?;
    let mut steps: BTreeMap<&str, Step> = BTreeMap::new();
    let wanted = |number: &usize| only.is_empty() || only.contains(number);
    let table = copy.join("mutants.txt");
    let known = fs::read_to_string(&table).unwrap_or_default();
    let is_known = |n: usize| known.lines().any(|l| l.split('\t').next() == Some(&n.to_string()));
    let mut file = fs::OpenOptions::new().create(true).append(true).open(&table)?;
    for (number, site) in sites.iter().filter(|(number, _)| wanted(number)) {
        if only.is_empty() && is_known(*number) {
            continue;
        }
        let mut by = "SURVIVED".to_owned();
        for name in chapters.tests(&site.file) {
            if !steps.contains_key(name) {
                steps.insert(name, timed(copy, name, &programs, &chapters.without)?);
            }
            let step = &steps[name];
            match run(step, *number, 5 * step.takes + Duration::from_secs(20))? {
                End::Passed => continue,
                End::Failed(test) => by = test,
                End::TooLong => by = format!("{name}: time"),
            }
            break;
        }
        let line = format!("{number}\t{by}\t{site}");
        println!("{line}");
        writeln!(file, "{line}")?;
    }
    summary(&fs::read_to_string(&table)?, chapters);
    Ok(())
}

/// How many errors were caught in each chapter; the last line of every error counts.
fn summary(table: &str, chapters: &Chapters) {
    let mut last = BTreeMap::new();
    for line in table.lines() {
        let mut columns = line.split('\t');
        if let (Some(number), Some(by), Some(place)) =
            (columns.next(), columns.next(), columns.next())
        {
            last.insert(number, (chapters.of(place), by != "SURVIVED"));
        }
    }
    let mut counts: BTreeMap<&str, [usize; 2]> = BTreeMap::new();
    for (chapter, caught) in last.into_values() {
        for row in [chapter, "together"] {
            let [errors, found] = counts.entry(row).or_default();
            *errors += 1;
            *found += usize::from(caught);
        }
    }
    for (chapter, [errors, caught]) in counts {
        println!("{chapter:<18} {errors:>4} errors {caught:>4} caught");
    }
}

/// Builds the tests beside the code and the programs of `tests/` that the chapters name: names and files.
fn build(copy: &Path, chapters: &Chapters) -> Result<BTreeMap<String, PathBuf>> {
    let mut cargo = Command::new("cargo");
    cargo.args(["test", "--locked", "--no-run", "--lib", "--bins"]).args(crate::PACKAGES);
    for name in chapters.programs() {
        cargo.args(["--test", name]);
    }
    let output = cargo.current_dir(copy).output()?;
    let told = String::from_utf8(output.stderr)?;
    if !output.status.success() {
        return Err(told.into());
    }
    let mut programs = BTreeMap::new();
    for line in told.lines().filter(|line| line.trim_start().starts_with("Executable")) {
        let path = line.rsplit_once('(').and_then(|(_, path)| path.strip_suffix(')'));
        let path = copy.join(path.ok_or("cargo names its executables in parentheses")?);
        let name = path.file_stem().ok_or("an executable has a name")?.to_string_lossy();
        let name = name.rsplit_once('-').map_or(&*name, |(name, _)| name);
        // The program's crate has the library's name.
        let name = if line.contains("src/main.rs") { "main" } else { name };
        programs.insert(name.to_owned(), path);
    }
    Ok(programs)
}

/// The tests of that name (`PROGRAM`, `PROGRAM:MODULE` or `PROGRAM:MODULE::TEST`), after a run without an error.
fn timed<'a>(
    copy: &'a Path,
    name: &'a str,
    programs: &BTreeMap<String, PathBuf>,
    without: &[String],
) -> Result<Step<'a>> {
    let (program, part) = name.split_once(':').unwrap_or((name, ""));
    let program = programs.get(program).ok_or_else(|| format!("there are no tests {name}"))?;
    let mut arguments: Vec<String> = match part {
        "" => vec![],
        part if part.contains("::") => vec![part.to_owned()],
        module => vec![format!("{module}::")],
    };
    arguments.extend(without.iter().flat_map(|test| ["--skip".to_owned(), test.clone()]));
    let mut step = Step { copy, name, program: program.clone(), arguments, takes: Duration::ZERO };
    let start = Instant::now();
    match run(&step, 0, Duration::from_secs(1800))? {
        End::Passed => step.takes = start.elapsed(),
        End::Failed(test) => return Err(format!("{test} fails without an error").into()),
        End::TooLong => return Err(format!("{name} does not end").into()),
    }
    println!("{:8.2} s  {name}", step.takes.as_secs_f64());
    Ok(step)
}

/// Runs tests until the first one fails.
fn run(step: &Step, number: usize, limit: Duration) -> Result<End> {
    let start = Instant::now();
    let mut command = Command::new(&step.program);
    command.args(&step.arguments).current_dir(step.copy);
    command.env("MUTANT", number.to_string()).env("RUST_BACKTRACE", "0");
    // A group of its own, which ends with the programs that the tests started.
    command.process_group(0).stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::null());
    let mut child = command.spawn()?;
    let (send, lines) = channel();
    let output = BufReader::new(child.stdout.take().ok_or("the output is piped")?);
    std::thread::spawn(move || output.lines().map_while(|l| l.ok()).try_for_each(|l| send.send(l)));
    loop {
        let left = limit.saturating_sub(start.elapsed());
        match lines.recv_timeout(left) {
            Ok(line) => {
                if let Some(name) = line.strip_suffix("... FAILED") {
                    let name = name.trim().trim_start_matches("test ").to_owned();
                    return ended(&mut child, End::Failed(format!("{}: {name}", step.name)));
                }
            }
            Err(RecvTimeoutError::Timeout) => return ended(&mut child, End::TooLong),
            Err(RecvTimeoutError::Disconnected) => break,
        }
    }
    match child.wait()?.success() {
        true => Ok(End::Passed),
        false => Ok(End::Failed(format!("{}: abort", step.name))),
    }
}

fn ended(child: &mut Child, end: End) -> Result<End> {
    Command::new("kill").args(["-KILL", "--", &format!("-{}", child.id())]).status()?;
    child.wait()?;
    Ok(end)
}
