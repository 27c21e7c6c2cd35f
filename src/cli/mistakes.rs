//! Errors for programs: with `--json`, the last line of standard error is a `sweetspot-error/1`.

use std::ffi::OsStr;

use clap::error::{ContextKind, ContextValue};

use crate::base::error::Error;
use crate::base::xml::is_bidi;
use crate::files::schema::error::{ErrorFile, Mistake};
use crate::files::schema::value;

use crate::cli::diagnostic::option;

/// Whether the command line asks for JSON, be the rest of it right or wrong.
pub fn asked() -> bool {
    let before_files = std::env::args_os().skip(1).take_while(|arg| arg != "--");
    let is_json = |arg: &OsStr| arg == "--json" || arg.to_string_lossy().starts_with("--json=");
    before_files.into_iter().any(|arg| is_json(&arg))
}

/// An error in one line of JSON.
pub fn of(error: &Error) -> String {
    line(&ErrorFile::of(error, |field| option(field).to_owned()))
}

/// A command line that is wrong, in one line of JSON.
pub fn of_usage(said: &clap::Error) -> String {
    let text = |kind| said.get(kind).map(plain);
    let rendered = said.render().to_string();
    let whole = rendered.split("\n\n").next().unwrap_or(&rendered);
    let whole = whole.trim_start_matches("error: ").split_whitespace();
    let message = whole.collect::<Vec<_>>().join(" ");
    let kinds = [
        ContextKind::SuggestedArg,
        ContextKind::SuggestedSubcommand,
        ContextKind::SuggestedValue,
        ContextKind::SuggestedCommand,
        ContextKind::Suggested,
    ];
    let hint = kinds.into_iter().find_map(text).map(|name| format!("did you mean {name}?"));
    let mistake = Mistake {
        place: text(ContextKind::InvalidArg),
        found: text(ContextKind::InvalidValue).or_else(|| text(ContextKind::InvalidSubcommand)),
        expected: text(ContextKind::ValidValue).filter(|values| !values.is_empty()),
        hint,
        ..Mistake::saying(message)
    };
    line(&ErrorFile::saying(vec![mistake]))
}

fn plain(value: &ContextValue) -> String {
    match value {
        ContextValue::String(text) => text.clone(),
        ContextValue::Strings(all) => all.join(", "),
        other => other.to_string(),
    }
}

/// One line that does nothing to a terminal. JSON escapes what is below U+0020; what else acts on a
/// terminal stands in a text too, and is escaped likewise.
fn line(document: &ErrorFile) -> String {
    let acts = |c: char| c.is_control() || is_bidi(c) || matches!(c, '\u{2028}' | '\u{2029}');
    let escaped =
        |c: char| if acts(c) { format!("\\u{:04x}", u32::from(c)) } else { c.to_string() };
    let text = value(document).to_string();
    text.chars().map(escaped).collect::<String>() + "\n"
}
