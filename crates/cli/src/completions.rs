//! `sweetspot completions SHELL`: completion of this program's words in a shell.

use clap::Command;
use clap_complete::{Shell, generate};

use crate::done::Done;
use sweetspot::Result;

/// Print the completions for a shell
///
/// The Tab key then completes verbs, options and files. Write them to the place where your shell looks for completions,
/// and open a new shell.
#[derive(clap::Args)]
#[command(after_long_help = EXAMPLES)]
pub struct Args {
    /// Which shell
    shell: Shell,
}

const EXAMPLES: &str = "\
Examples:
  sweetspot completions bash > \\
      ~/.local/share/bash-completion/completions/sweetspot
  sweetspot completions zsh > ~/.zfunc/_sweetspot
  sweetspot completions fish > ~/.config/fish/completions/sweetspot.fish";

pub fn run(args: &Args, mut command: Command) -> Result<Done> {
    let mut script = Vec::new();
    generate(args.shell, &mut command, "sweetspot", &mut script);
    Ok(Done::new(String::from_utf8_lossy(&script).into_owned(), 0))
}
