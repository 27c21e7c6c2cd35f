//! `sweetspot schema [FILE]`: the form of the files.

use sweetspot::Result;
use sweetspot_report::formats::{self, FileKind};

use crate::done::Done;
use crate::help::commands;
use crate::value::named;

/// JSON Schema of a bat file, of a ball file, and of what the program writes
///
/// Draft 2020-12, for editors and for programs that check a file. Without a name it prints one schema for all of them,
/// chosen by their "format".
#[derive(clap::Args)]
#[command(after_long_help = commands("schema"))]
pub struct Args {
    /// Kind of file, the word in its "format", such as bat, ball, modes or hit [default: all of them in one schema]
    #[arg(value_name = "FILE", value_parser = named(FileKind::ALL, FileKind::name),
          hide_possible_values = true)]
    file: Option<FileKind>,
}

pub fn run(args: &Args) -> Result<Done> {
    let schema = args.file.map_or_else(formats::all, FileKind::schema);
    Ok(Done::new(format!("{schema:#}\n"), 0))
}
