//! Colour, for terminals that support it.

use std::env;
use std::io::{IsTerminal, stdout};

use clap::builder::styling::Style;

use crate::done::printable;

/// Longest text before a colon that counts as a heading.
const LABEL: usize = 16;

/// Whether the output to a stream is coloured: on a terminal, except with `CLICOLOR=0` or `TERM=dumb`; always with
/// `CLICOLOR_FORCE`, and never with `NO_COLOR`.
///
/// # Source
///
/// <https://no-color.org> and <https://bixense.com/clicolors>.
pub fn coloured(terminal: bool) -> bool {
    let set = |name: &str| env::var_os(name).filter(|value| !value.is_empty());
    let forced = set("CLICOLOR_FORCE").is_some_and(|value| value != "0");
    let unwanted = set("CLICOLOR").is_some_and(|value| value == "0");
    let dumb = set("TERM").is_some_and(|value| value == "dumb");
    set("NO_COLOR").is_none() && (forced || terminal && !unwanted && !dumb)
}

/// The table for standard output: with bold headings if there is colour, and without characters that act on a terminal.
pub fn table(text: &str) -> String {
    let text: String = text.split('\n').map(printable).collect::<Vec<_>>().join("\n");
    if coloured(stdout().is_terminal()) { headings(&text) } else { text }
}

/// The text in lines of at most the given number of columns; its line ends are kept.
pub fn broken(text: &str, width: usize) -> String {
    let mut out: Vec<String> = Vec::new();
    for paragraph in text.lines() {
        let mut line = String::new();
        for word in paragraph.split(' ') {
            if !line.is_empty() && columns(&line) + 1 + columns(word) > width {
                out.push(std::mem::take(&mut line));
            }
            line += if line.is_empty() { "" } else { " " };
            line += word;
        }
        out.push(line);
    }
    out.join("\n")
}

/// Columns of a text; a character that may be wide counts as wide.
pub fn columns(text: &str) -> usize {
    text.chars().map(|c| if c < '\u{1100}' { 1 } else { 2 }).sum()
}

/// A line that begins at the margin over one that does not is a heading, up to its colon if that
/// comes soon, or up to its columns.
fn headings(text: &str) -> String {
    let bold = Style::new().bold();
    let mut out = String::with_capacity(text.len());
    let mut lines = text.split_inclusive('\n').peekable();
    while let Some(line) = lines.next() {
        let indented = |line: &str| line.starts_with(' ');
        let above = lines.peek().is_some_and(|below| indented(below));
        let (content, end) = line.split_at(line.trim_end_matches('\n').len());
        let heading = match (content.find("  "), content.find(": ")) {
            (Some(columns), _) => columns,
            (None, Some(colon)) if colon <= LABEL => colon + 1,
            _ => content.len(),
        };
        if above && !indented(line) && !content.is_empty() {
            let (label, rest) = content.split_at(heading);
            out += &format!("{bold}{label}{bold:#}{rest}{end}");
        } else {
            out += line;
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headings_are_bold_and_nothing_else_changes() {
        let text = "A bat  1 kg\n  length 1 m\n\nModel: thin,\n       far\nplain: no\n";
        let bold = "\u{1b}[1mA bat\u{1b}[0m  1 kg\n  length 1 m\n\n\u{1b}[1mModel:\u{1b}[0m thin,\n       far\n\
                    plain: no\n";
        assert_eq!(headings(text), bold);
    }
}
