//! What is the first word: a verb, or a bat to be analysed?

use std::ffi::OsString;
use std::path::Path;

use clap::Command;
use serde_json::Value;

use sweetspot::base::file;
use sweetspot::files::built_in;
use sweetspot::{Error, Result};

/// The command line with the verb `analyze` inserted before a bat without a verb: a word that ends in .json, contains a
/// path separator or is the name of a built-in bat, and is not a verb.
///
/// # Errors
///
/// [`Error::Value`] for a file that another verb reads.
pub fn read(mut words: Vec<OsString>, command: &Command) -> Result<Vec<OsString>> {
    let Some(first) = words.get(1) else { return Ok(words) };
    let (path, text) = (Path::new(first), first.to_string_lossy());
    let is_verb = command.find_subcommand(first).is_some() || text == "help";
    let is_json = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("json"));
    let is_path = text.contains(std::path::is_separator);
    let is_bat = is_json || is_path || built_in::bat_text(&text).is_some();
    if is_verb || text.starts_with('-') || !is_bat {
        return Ok(words);
    }
    if let Some((kind, verb)) = reader(path) {
        let file = path.display().to_string();
        let found = format!("{file}, which is {kind}, and no verb");
        // Special characters of a shell are not repeated in a command.
        let is_plain = file.chars().all(|c| c.is_alphanumeric() || "./\\_-:".contains(c));
        let command = verb.replace('@', if is_plain { &file } else { "FILE" });
        return Err(Error::value("", found, format!("`sweetspot {command}`")));
    }
    words.insert(1, "analyze".into());
    Ok(words)
}

/// The kind of a file that contains no bat, and the command that reads it.
fn reader(path: &Path) -> Option<(&'static str, &'static str)> {
    const READERS: [(&str, &str, &str); 4] = [
        ("study", "a study", "study @ --out FOLDER"),
        ("scatter", "a scatter file", "scatter BAT @"),
        ("aim", "a wish", "aim BAT @"),
        ("readings", "a file of readings", "calibrate BAT @"),
    ];
    let text = if path.is_file() { file::read_plain(path).ok()? } else { vec![] };
    let document: Value = serde_json::from_slice(&text).ok()?;
    let format = document["format"].as_str()?.strip_prefix("sweetspot-")?.split('/').next()?;
    READERS.iter().find(|(name, ..)| *name == format).map(|(_, kind, verb)| (*kind, *verb))
}
