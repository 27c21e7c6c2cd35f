//! `--csv`: the answer as a table for other programs, in a file or in place of the text.

use std::path::{Path, PathBuf};

use crate::base::error::{Error, Result};
use crate::base::file;

#[derive(clap::Args)]
pub struct CsvArgs {
    /// Write CSV to this file (- = standard output, and no table then)
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    csv: Option<PathBuf>,
}

impl CsvArgs {
    /// Refuses CSV where JSON goes to standard output already.
    pub fn refuse_two(&self, json: Option<&Path>) -> Result<()> {
        if [self.csv.as_deref(), json] == [Some(Path::new("-")); 2] {
            let expected = "one of --json and --csv on standard output";
            return Err(Error::value("--csv", "- and --json -", expected));
        }
        Ok(())
    }

    /// Writes the table where it was asked for; what goes to standard output then.
    pub fn deliver(&self, text: String, table: impl FnOnce() -> String) -> Result<String> {
        match &self.csv {
            Some(path) if path.as_os_str() == "-" => Ok(table()),
            Some(path) => file::write(path, table().as_bytes()).map(|()| text),
            None => Ok(text),
        }
    }
}
