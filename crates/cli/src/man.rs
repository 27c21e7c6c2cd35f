//! `sweetspot man [VERB]`: the help as manual pages.

use std::path::{Path, PathBuf};

use clap::Command;
use clap_mangen::Man;
use sweetspot::base::error::nearest;
use sweetspot::base::file;
use sweetspot::{Error, Result};

use crate::done::Done;
use crate::help::commands;
use crate::output::make;

/// Print a manual page, or write all of them
///
/// The text of --help as a manual page, for the pager of your system.
#[derive(clap::Args)]
#[command(after_long_help = commands("man"))]
pub struct Args {
    /// The page of this verb [default: of the program]
    verb: Option<String>,

    /// Write the pages of the program and of every verb into this folder
    #[arg(long, value_name = "DIR", conflicts_with = "verb")]
    out: Option<PathBuf>,
}

pub fn run(args: &Args, command: Command) -> Result<Done> {
    // The verb that prints help has no page.
    let mut command = command.disable_help_subcommand(true);
    command.build();
    if let Some(folder) = &args.out {
        return all(folder, &command);
    }
    let verbs: Vec<&str> = command.get_subcommands().map(Command::get_name).collect();
    let page = match &args.verb {
        None => page(&command),
        Some(verb) => match command.find_subcommand(verb) {
            Some(found) => page(found),
            None => {
                let hint = nearest(verb, &verbs).map(|near| format!("; did you mean {near}?"));
                let expected = format!("one of {}{}", verbs.join(", "), hint.unwrap_or_default());
                return Err(Error::value("man", verb, expected));
            }
        },
    };
    Ok(Done::new(page, 0))
}

/// Writes every page; returns a message about it.
fn all(folder: &Path, command: &Command) -> Result<Done> {
    make(folder)?;
    let mut out = String::new();
    for verb in [command].into_iter().chain(command.get_subcommands()) {
        let name = verb.get_display_name().unwrap_or(verb.get_name());
        let path = folder.join(format!("{name}.1"));
        file::write(&path, page(verb).as_bytes())?;
        out += &format!("{}\n", path.display());
    }
    Ok(Done::new(out, 0))
}

/// One page in roff.
fn page(command: &Command) -> String {
    let mut page = Vec::new();
    let man = Man::new(command.clone()).source(concat!("sweetspot ", env!("CARGO_PKG_VERSION")));
    let written = man.render(&mut page);
    written.expect("memory takes what is written to it");
    String::from_utf8_lossy(&page).into_owned()
}
