//! `sweetspot completions SHELL`: completion of this program's words in a shell.

use clap::Command;
use clap_complete::{Shell, generate};

use crate::done::Done;
use crate::help::commands;
use sweetspot::Result;

/// Print the completions for a shell
///
/// The Tab key then completes verbs, options and files. Write them to the place where your shell looks for completions,
/// and open a new shell.
#[derive(clap::Args)]
#[command(after_long_help = commands("completions"))]
pub struct Args {
    /// Which shell
    shell: Shell,
}

pub fn run(args: &Args, mut command: Command) -> Result<Done> {
    let mut script = Vec::new();
    generate(args.shell, &mut command, "sweetspot", &mut script);
    Ok(Done::new(String::from_utf8_lossy(&script).into_owned(), 0))
}
