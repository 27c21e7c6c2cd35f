//! Builds the copy's tests once and runs them with one error after the other.

use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::{Duration, Instant};

use crate::Result;
use crate::sites::Site;

/// A test program with its time without a mutant.
struct Program {
    name: String,
    path: PathBuf,
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
pub fn all(copy: &Path, sites: &[(usize, Site)], tests: &[String], only: &[usize]) -> Result<()> {
    let mut programs = build(copy, tests)?;
    for program in &mut programs {
        let start = Instant::now();
        match run(copy, program, 0, Duration::from_secs(1800))? {
            End::Passed => program.takes = start.elapsed(),
            End::Failed(test) => return Err(format!("{test} fails without an error").into()),
            End::TooLong => return Err(format!("{} does not end", program.name).into()),
        }
        println!("{:8.2} s  {}", program.takes.as_secs_f64(), program.name);
    }
    programs.sort_by_key(|program| program.takes);
    let table = copy.join("mutants.txt");
    let known = fs::read_to_string(&table).unwrap_or_default();
    let is_known = |n: usize| known.lines().any(|l| l.split('\t').next() == Some(&n.to_string()));
    let mut file = fs::OpenOptions::new().create(true).append(true).open(&table)?;
    for (number, site) in sites {
        let wanted = if only.is_empty() { !is_known(*number) } else { only.contains(number) };
        if !wanted {
            continue;
        }
        let by = caught(copy, &programs, *number)?;
        let line = format!("{number}\t{by}\t{site}");
        println!("{line}");
        writeln!(file, "{line}")?;
    }
    summary(&fs::read_to_string(&table)?);
    Ok(())
}

/// The test that notices the error, or `SURVIVED`.
fn caught(copy: &Path, programs: &[Program], number: usize) -> Result<String> {
    for program in programs {
        let limit = 5 * program.takes + Duration::from_secs(20);
        match run(copy, program, number, limit)? {
            End::Passed => {}
            End::Failed(test) => return Ok(test),
            End::TooLong => return Ok(format!("{}: time", program.name)),
        }
    }
    Ok("SURVIVED".to_owned())
}

/// The last line of every error counts.
fn summary(table: &str) {
    let mut last = std::collections::BTreeMap::new();
    for line in table.lines() {
        let mut columns = line.split('\t');
        if let (Some(number), Some(by)) = (columns.next(), columns.next()) {
            last.insert(number, by != "SURVIVED");
        }
    }
    let caught = last.values().filter(|caught| **caught).count();
    println!("{caught} of {} errors caught", last.len());
}

/// Builds the tests of the library and the named ones of `tests/`.
fn build(copy: &Path, tests: &[String]) -> Result<Vec<Program>> {
    let mut cargo = Command::new("cargo");
    cargo.args(["test", "--locked", "--no-run", "--lib"]).current_dir(copy);
    for name in tests {
        cargo.args(["--test", name]);
    }
    let output = cargo.output()?;
    let told = String::from_utf8(output.stderr)?;
    if !output.status.success() {
        return Err(told.into());
    }
    let mut programs = Vec::new();
    for line in told.lines().filter(|line| line.trim_start().starts_with("Executable")) {
        let path = line.rsplit_once('(').and_then(|(_, path)| path.strip_suffix(')'));
        let path = copy.join(path.ok_or("cargo names its executables in parentheses")?);
        let name = path.file_stem().ok_or("an executable has a name")?.to_string_lossy();
        let name = name.rsplit_once('-').map_or(&*name, |(name, _)| name).to_owned();
        programs.push(Program { name, path, takes: Duration::ZERO });
    }
    Ok(programs)
}

/// Runs a test program until its first failure.
fn run(copy: &Path, program: &Program, number: usize, limit: Duration) -> Result<End> {
    let start = Instant::now();
    let mut command = Command::new(&program.path);
    command.env("MUTANT", number.to_string()).env("RUST_BACKTRACE", "0").current_dir(copy);
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::null()).spawn()?;
    let (send, lines) = channel();
    let output = BufReader::new(child.stdout.take().ok_or("the output is piped")?);
    std::thread::spawn(move || output.lines().map_while(|l| l.ok()).try_for_each(|l| send.send(l)));
    loop {
        let left = limit.saturating_sub(start.elapsed());
        match lines.recv_timeout(left) {
            Ok(line) => {
                if let Some(name) = line.strip_suffix("... FAILED") {
                    let name = name.trim().trim_start_matches("test ").to_owned();
                    return ended(&mut child, End::Failed(format!("{}: {name}", program.name)));
                }
            }
            Err(RecvTimeoutError::Timeout) => return ended(&mut child, End::TooLong),
            Err(RecvTimeoutError::Disconnected) => break,
        }
    }
    match child.wait()?.success() {
        true => Ok(End::Passed),
        false => Ok(End::Failed(format!("{}: abort", program.name))),
    }
}

fn ended(child: &mut Child, end: End) -> Result<End> {
    child.kill()?;
    child.wait()?;
    Ok(end)
}
