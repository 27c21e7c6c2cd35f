//! `sweetspot completions SHELL`: what the shell needs to complete this program's words.

use clap::Command;
use clap_complete::{Shell, generate};

use crate::done::Done;
use sweetspot::Result;

/// Print the completions for a shell
///
/// Afterwards the Tab key completes verbs, options and files. Write them where your shell looks for
/// them, and open a new one.
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
