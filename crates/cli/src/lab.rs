//! `sweetspot lab [BAT]`: the live page with a bat in it.

use std::path::{Path, PathBuf};

use sweetspot::base::file;
use sweetspot::{Bat, Error, Result};
use sweetspot_report::report::resolved::{resolved, text_in_columns};

use crate::common::{examples, read_with_text};
use crate::done::Done;
use crate::edits::EditArgs;
use crate::output::printed;

/// A page in which you reshape the bat and get answers at once
///
/// Writes one file that any browser opens, without a server or a network. Drag the barrel, and exit speeds, notes,
/// nodes, sweet spot and swing weight follow; tap the bat and hear it; see what changed. This program's engine computes
/// every number in the page.
#[derive(clap::Args)]
#[command(after_long_help = examples("lab"))]
pub struct Args {
    /// Bat file (JSON), or the name of a built-in bat; without it the page begins with r161
    #[arg(help_heading = "The bat")]
    bat: Option<PathBuf>,

    /// Write the page into this file [default: BAT-lab.html in this folder]
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    out: Option<PathBuf>,

    /// Open it in the browser
    #[arg(long, help_heading = "Output")]
    open: bool,

    /// No warnings on standard error
    #[arg(long, help_heading = "Output")]
    quiet: bool,
}

/// The page, which `lab/build` has made; None in a program that was built without it.
#[cfg(feature = "lab")]
const PAGE: Option<&str> =
    Some(include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../target/lab/sweetspot-lab.html")));
#[cfg(not(feature = "lab"))]
const PAGE: Option<&str> = None;

/// The placeholder for a bat in the page.
const NO_BAT: &str = "<script type=\"application/json\" id=\"bat\">null</script>";

/// The page.
///
/// # Errors
///
/// [`Error::NotBuilt`] in a program that was built without it.
pub fn page() -> Result<&'static str> {
    PAGE.ok_or(Error::NotBuilt {
        what: "the page",
        advice: "build it in, in the source: `lab/build && cargo install --path crates/cli --features lab`",
    })
}

/// Writes the page with that bat beside a report, and returns its address there: `r161.html` has `r161-lab.html`.
pub fn beside(report: &Path, bat: &Bat, text: &str) -> Result<String> {
    let name = format!("{}-lab.html", report.file_stem().unwrap_or_default().to_string_lossy());
    // Edits of the command line are in no file.
    let same =
        Bat::from_text("", text, Path::new("")).is_ok_and(|read| read.edits() == bat.edits());
    let text = if same { text.to_owned() } else { alone(bat) };
    file::write(&report.with_file_name(&name), with_bat(page()?, &text).as_bytes())?;
    Ok(name.replace('%', "%25").replace('#', "%23").replace('?', "%3F"))
}

pub fn run(args: &Args) -> Result<Done> {
    let page = page()?;
    let (page, name) = match &args.bat {
        Some(path) => {
            let text = text(path, args.quiet)?;
            let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            (with_bat(page, &text), stem)
        }
        None => (page.to_owned(), "sweetspot".to_owned()),
    };
    let out = args.out.clone().unwrap_or_else(|| PathBuf::from(format!("{name}-lab.html")));
    file::write(&out, page.as_bytes())?;
    if args.open {
        open(&out)?;
    }
    Ok(Done::new(format!("{}\n", printed(&out)), 0))
}

/// The text of a self-contained bat file: as it is, or with the columns of the table that it names.
fn text(path: &Path, quiet: bool) -> Result<String> {
    let (bat, text) = read_with_text(path, &EditArgs::default(), [quiet, false])?;
    let names_a_table = serde_json::from_str::<serde_json::Value>(&text)
        .is_ok_and(|document| document["profile"]["csv"].is_string());
    Ok(if names_a_table { alone(&bat) } else { text })
}

fn alone(bat: &Bat) -> String {
    text_in_columns(&resolved(bat), &bat.unedited().profile().stations, bat.inches())
}

/// The page with that bat file in it, escaped so that nothing in it is read as part of the page.
fn with_bat(page: &str, text: &str) -> String {
    let text = serde_json::Value::from(text).to_string().replace('<', "\\u003c");
    page.replacen(NO_BAT, &NO_BAT.replace("null", &text), 1)
}

/// Opens a file with the system's program for pages.
fn open(path: &Path) -> Result<()> {
    let opener = match std::env::consts::OS {
        "macos" => "open",
        "windows" => "explorer",
        _ => "xdg-open",
    };
    let opened = std::process::Command::new(opener).arg(path).status();
    let said = match opened {
        Ok(status) if status.success() || cfg!(windows) => return Ok(()),
        Ok(status) => status.to_string(),
        Err(error) => error.to_string(),
    };
    let found = format!("{opener} {}: {said}", printed(path));
    Err(Error::value("--open", found, "a browser: the page is written, open it yourself"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bat_in_the_page_is_data_whatever_it_is_called() {
        let page = format!("<body>{NO_BAT}<script>run()</script>");
        let text = r#"{ "name": "</script><script>alert(1)</script> null \" $1" }"#;
        let written = with_bat(&page, text);
        assert_eq!(written.matches("<script").count(), 2);
        let data = written.split("id=\"bat\">").nth(1).unwrap().split("</script>").next().unwrap();
        assert_eq!(serde_json::from_str::<String>(data).unwrap(), text);
    }
}
