//! How are results written, and where?

use std::io::{IsTerminal, Write};
use std::ops::Deref;
use std::path::{Path, PathBuf};

use clap::Arg;
use serde::Serialize;
use sweetspot::base::file;
use sweetspot::{Bat, Error, Result};
use sweetspot_report::parts::Units;
pub use sweetspot_report::parts::terminal::{LINES, MANY, Screen};
use sweetspot_report::plot::{Picture, Sheet, picture};
use sweetspot_report::report::sketch::{self, Glyphs, SketchRow};
use sweetspot_report::schema;

use crate::done::{NOT_REACHED, printable};
use crate::progress::{self, Progress};
use crate::style::{self, broken};
use crate::value::unit_system;

/// Format and destination of the output.
#[derive(clap::Args)]
#[command(next_help_heading = "Output")]
pub struct OutputArgs {
    /// Write JSON to this file (- = standard output, and no table then)
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,

    /// Units of the tables, and of pictures and reports: si, us or both (both units, the bat file's first; pictures and
    /// reports use only that one)
    #[arg(long, value_name = "SYSTEM", default_value = "both", value_parser = unit_system(),
          hide_possible_values = true)]
    units: Units,

    #[command(flatten)]
    amount: FullArgs,
}

impl OutputArgs {
    /// The units for a bat: those asked for; for both, the file's first.
    pub fn units(&self, bat: &Bat) -> Units {
        self.units.of(bat)
    }

    /// Writes the JSON if it was asked for; returns the text for standard output.
    pub fn deliver<D: Serialize>(
        &self,
        table: String,
        document: impl FnOnce() -> D,
    ) -> Result<String> {
        put(&self.json, style::table(&table), || Ok(schema::text(&document())))
    }

    /// The sheet for the pictures of a bat, in the units asked for, else those of its file.
    pub fn sheet(&self, bat: &Bat) -> Sheet {
        Sheet::file(self.units(bat).us_first())
    }

    /// The bat and its places, drawn with the characters of this terminal.
    pub fn sketch(&self, bat: &Bat, rows: &[SketchRow]) -> String {
        sketch::draw(bat, rows, self.units(bat), glyphs())
    }

    /// Draws into the folder, if one was given, in the units of that bat.
    pub fn draw<P: IntoIterator<Item = Picture>>(
        &self,
        folder: &Option<PathBuf>,
        bat: &Bat,
        pictures: impl FnOnce(Sheet) -> Result<P>,
    ) -> Result<()> {
        draw(folder, self.quiet, || pictures(self.sheet(bat)))
    }
}

impl Deref for OutputArgs {
    type Target = FullArgs;

    fn deref(&self) -> &FullArgs {
        &self.amount
    }
}

/// Block elements if the locale's character set is UTF-8.
pub fn glyphs() -> Glyphs {
    let set = |name| std::env::var(name).ok().filter(|value| !value.is_empty());
    // The first variable that is set decides.
    let locale = ["LC_ALL", "LC_CTYPE", "LANG"].into_iter().find_map(set).unwrap_or_default();
    let locale = locale.to_ascii_lowercase();
    if locale.contains("utf-8") || locale.contains("utf8") { Glyphs::Blocks } else { Glyphs::Ascii }
}

/// `--csv`: the answer as a table for other programs, in a file or in place of the text.
#[derive(clap::Args)]
pub struct CsvArgs {
    /// Write CSV to this file (- = standard output, and no table then)
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub csv: Option<PathBuf>,
}

impl CsvArgs {
    /// Writes the table if it was asked for; returns the text for standard output.
    pub fn deliver(&self, text: String, table: impl FnOnce() -> String) -> Result<String> {
        put(&self.csv, text, || Ok(table()))
    }
}

/// The output of a verb with a table and pictures.
#[derive(clap::Args)]
#[command(next_help_heading = "Output")]
pub struct AnswerArgs {
    #[command(flatten)]
    pub csv: CsvArgs,

    /// Draw into this folder, as SVG and PNG
    #[arg(long, value_name = "DIR")]
    pub plots: Option<PathBuf>,

    #[command(flatten)]
    output: OutputArgs,
}

impl AnswerArgs {
    /// Refuses two documents in one place: JSON, CSV, and these options of the verb.
    ///
    /// # Errors
    ///
    /// As [`apart`].
    pub fn apart(&self, others: &[(&str, &Option<PathBuf>)]) -> Result<()> {
        apart(&[&[("--json", &self.json), ("--csv", &self.csv.csv)], others].concat())
    }

    /// Whether more than one screen is asked for.
    pub fn in_full(&self) -> bool {
        self.full || [&self.json, &self.csv.csv, &self.plots].iter().any(|asked| asked.is_some())
    }

    /// Draws, and writes JSON and CSV, as far as that was asked for; returns the text for standard output.
    pub fn answer<D: Serialize, P: IntoIterator<Item = Picture>>(
        &self,
        (bat, text): (&Bat, String),
        pictures: impl FnOnce(Sheet) -> Result<P>,
        document: impl FnOnce() -> D,
        table: impl FnOnce() -> String,
    ) -> Result<String> {
        self.draw(&self.plots, bat, pictures)?;
        self.csv.deliver(self.deliver(text, document)?, table)
    }
}

impl Deref for AnswerArgs {
    type Target = OutputArgs;

    fn deref(&self) -> &OutputArgs {
        &self.output
    }
}

/// The option `--plots` of a verb that draws this.
pub fn drawing(what: &'static str) -> impl Fn(Arg) -> Arg {
    move |arg| arg.help(format!("Draw {what} into this folder, as SVG and PNG"))
}

/// The output of a verb with a table and pictures, but without a choice of units.
#[derive(clap::Args)]
#[command(next_help_heading = "Output")]
pub struct DataArgs {
    /// Write JSON to this file (- = standard output, and no table then)
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,

    #[command(flatten)]
    pub csv: CsvArgs,

    /// Draw into this folder, as SVG and PNG
    #[arg(long, value_name = "DIR")]
    pub plots: Option<PathBuf>,

    #[command(flatten)]
    amount: FullArgs,
}

impl DataArgs {
    /// As [`AnswerArgs::apart`].
    pub fn apart(&self, others: &[(&str, &Option<PathBuf>)]) -> Result<()> {
        apart(&[&[("--json", &self.json), ("--csv", &self.csv.csv)], others].concat())
    }

    /// Draws, and writes JSON and CSV, as far as that was asked for; returns the text for standard output.
    pub fn answer<D: Serialize, P: IntoIterator<Item = Picture>>(
        &self,
        text: &str,
        pictures: impl FnOnce() -> Result<P>,
        document: impl FnOnce() -> D,
        table: impl FnOnce() -> String,
    ) -> Result<String> {
        draw(&self.plots, self.quiet, pictures)?;
        let text = self.csv.deliver(style::table(text), table)?;
        put(&self.json, text, || Ok(schema::text(&document())))
    }
}

impl Deref for DataArgs {
    type Target = FullArgs;

    fn deref(&self) -> &FullArgs {
        &self.amount
    }
}

/// Amount of output.
#[derive(clap::Args)]
pub struct FullArgs {
    /// Everything, not one screen alone
    #[arg(long, help_heading = "Output")]
    pub full: bool,

    /// No warnings and no progress on standard error
    #[arg(long, help_heading = "Output")]
    pub quiet: bool,
}

impl FullArgs {
    /// The printed text: everything, or a screen of at most `most` lines and a hint where the rest is.
    pub fn screen<S: Into<Screen>>(&self, most: usize, said: impl Fn(bool) -> S) -> String {
        let all = said(true).into().text();
        match self.full {
            true => all,
            false => said(false).into().fitted(most, &all, "Everything else: --full"),
        }
    }

    /// The exit code, after a warning if something was not reached.
    pub fn reached(&self, short: Option<String>) -> u8 {
        match short {
            Some(short) => {
                self.warn(&short);
                NOT_REACHED
            }
            None => 0,
        }
    }

    /// Says something on standard error.
    pub fn warn(&self, text: &str) {
        warn(text, self.quiet);
    }

    /// The progress of `what`, for a person at a terminal.
    pub fn progress(&self, what: &str) -> Progress {
        Progress::new(self.quiet, what)
    }
}

/// The name of a file as text.
pub fn printed(path: &Path) -> String {
    printable(&path.display().to_string())
}

/// Prints a message on standard error, unless `quiet`.
pub fn warn(text: &str, quiet: bool) {
    if !quiet {
        // A closed standard error is not a reason to stop.
        progress::beside(|| {
            let mut err = std::io::stderr();
            let text = printable(text);
            let text = if err.is_terminal() { broken(&text, 80) } else { text };
            let _ = writeln!(err, "{text}");
        });
    }
}

/// Draws into the folder, if one was given; reports pictures of an earlier run that are still there, or that there are
/// none.
pub fn draw<P: IntoIterator<Item = Picture>>(
    folder: &Option<PathBuf>,
    quiet: bool,
    pictures: impl FnOnce() -> Result<P>,
) -> Result<()> {
    let Some(folder) = folder else { return Ok(()) };
    let pictures: Vec<Picture> = pictures()?.into_iter().collect();
    if pictures.is_empty() {
        warn("note: there is nothing to draw, and no pictures were written", quiet);
        return Ok(());
    }
    let others = picture::write(folder, &pictures)?;
    if !others.is_empty() {
        let (folder, names) = (printed(folder), others.join(", "));
        warn(&format!("note: {folder} still holds pictures of an earlier run: {names}"), quiet);
    }
    Ok(())
}

/// Makes a folder if it does not exist.
///
/// # Errors
///
/// [`Error::Write`].
pub fn make(folder: &Path) -> Result<()> {
    let failed = |source| Error::Write { path: folder.to_owned(), source };
    std::fs::create_dir_all(folder).map_err(failed)
}

/// Checks that every document has its own destination: no two of these options name one file, or both standard output.
/// To be called before anything is computed or written.
///
/// # Errors
///
/// [`Error::Value`] about the second option.
pub fn apart(named: &[(&str, &Option<PathBuf>)]) -> Result<()> {
    let named = named.iter().filter_map(|(option, path)| Some((*option, path.as_deref()?)));
    let named: Vec<(&str, &Path)> = named.collect();
    for (k, (second, path)) in named.iter().enumerate() {
        let stdout = path.as_os_str() == "-";
        let alike = |(_, other): &&(&str, &Path)| match stdout {
            true => other == path,
            false => file::is_one(other, path),
        };
        let Some((first, other)) = named[..k].iter().find(alike) else { continue };
        let found = format!("{} beside {first} {}", path.display(), other.display());
        let expected =
            if stdout { "one of them on standard output" } else { "another name for one of them" };
        return Err(Error::value(*second, found, expected));
    }
    Ok(())
}

/// Writes a text to its file; returns the text that replaces `table` if that is standard output.
///
/// # Errors
///
/// [`Error::Write`].
pub fn put(
    path: &Option<PathBuf>,
    table: String,
    text: impl FnOnce() -> Result<String>,
) -> Result<String> {
    match path {
        Some(path) if path.as_os_str() == "-" => text(),
        Some(path) => file::write(path, text()?.as_bytes()).map(|()| table),
        None => Ok(table),
    }
}
