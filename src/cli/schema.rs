//! `sweetspot schema [bat|modes|hit|bbcor]`: what the files look like.

use sweetspot::base::error::Result;
use sweetspot::files::schema::{self, File};

use crate::cli::done::Done;
use crate::cli::value::named;

/// JSON Schema of a bat file, and of what modes, hit and bbcor write
///
/// Draft 2020-12, for editors and for programs that check a file. Without a name: one schema of all
/// of them, which tells them apart by their "format".
#[derive(clap::Args)]
#[command(after_long_help = EXAMPLES)]
pub struct Args {
    /// Which file: bat, modes, hit or bbcor [default: all of them in one schema]
    #[arg(value_name = "FILE", value_parser = named(File::ALL, File::name),
          hide_possible_values = true)]
    file: Option<File>,
}

const EXAMPLES: &str = "\
Examples:
  sweetspot schema bat
      what may stand in a bat file; editors complete and check by it

  sweetspot schema
      that of all files in one";

pub fn run(args: &Args) -> Result<Done> {
    let schema = args.file.map_or_else(schema::all, File::schema);
    Ok(Done::new(format!("{schema:#}\n"), 0))
}
