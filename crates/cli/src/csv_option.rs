//! `--csv`: the answer as a table for other programs, in a file or in place of the text.

use std::path::PathBuf;

use sweetspot::base::error::Result;

use crate::delivered::{apart, put};

#[derive(clap::Args)]
pub struct CsvArgs {
    /// Write CSV to this file (- = standard output, and no table then)
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    csv: Option<PathBuf>,
}

impl CsvArgs {
    /// Refuses CSV where the JSON goes already.
    pub fn beside(&self, json: &Option<PathBuf>) -> Result<()> {
        apart(&[("--json", json), ("--csv", &self.csv)])
    }

    /// Writes the table where it was asked for; what goes to standard output then.
    pub fn deliver(&self, text: String, table: impl FnOnce() -> String) -> Result<String> {
        put(&self.csv, text, || Ok(table()))
    }
}
