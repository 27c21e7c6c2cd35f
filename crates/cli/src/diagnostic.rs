//! Errors for a person at a terminal: the line of the file, a caret, and advice.

use std::io::Write;

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};

use crate::done::printable;
use crate::style::{broken, columns};
use sweetspot::Error;
use sweetspot::base::error::{Complaint, Excerpt, FilePosition};
use sweetspot::base::marks;
use sweetspot_report::report::mistakes::ErrorFile;
use sweetspot_report::schema::{self, Written};

/// Columns of a narrow terminal.
const WIDTH: usize = 80;

/// The whole text of an error, with a count at the end if there are several mistakes.
pub fn render(error: &Error, coloured: bool) -> String {
    let styled = Renderer::styled().hyperlink(false);
    // Excerpts are short enough already.
    let renderer = if coloured { styled } else { Renderer::plain() }.term_width(10 * WIDTH);
    let show = |group: Group| renderer.render(&[group]).trim_end().to_owned() + "\n";
    match error {
        Error::Several { shown, more } => {
            let each = shown.iter().map(|error| show(group(error)) + "\n").collect::<String>();
            let title = Level::ERROR.primary_title(summary(shown, *more));
            each + &show(Group::with_title(title))
        }
        one => show(group(one)),
    }
}

/// Prints the mistakes for other programs, in one line on standard error, if the command line asks for JSON.
pub fn as_json(document: impl FnOnce() -> Written<ErrorFile>) {
    let mut options = std::env::args_os().skip(1).take_while(|word| word != "--");
    if options.any(|word| word == "--json" || word.as_encoded_bytes().starts_with(b"--json=")) {
        // If standard error is closed, the message is lost.
        let _ =
            writeln!(std::io::stderr(), "{}", marks::json(&schema::value(&document()).to_string()));
    }
}

/// One error: a title, the excerpt if it is about a file, and advice.
fn group(error: &Error) -> Group<'static> {
    match error {
        Error::Input { place, complaint } => input(place, complaint),
        Error::Value(complaint) => {
            let field = option(&complaint.field).to_owned();
            let plain = Complaint { field, hint: String::new(), ..complaint.clone() };
            match &complaint.hint {
                hint if hint.is_empty() => titled(&plain.to_string()),
                hint => advised(&plain.to_string(), hint),
            }
        }
        Error::NotYet { what, advice } => advised(&format!("{what} is not supported yet"), advice),
        Error::NotBuilt { what, advice } => {
            advised(&format!("{what} is not in this build"), advice)
        }
        other => titled(&other.to_string()),
    }
}

/// The option for a value that the library names otherwise.
fn option(field: &str) -> &str {
    match field {
        "every" => "--every",
        "place of the force" => "--at",
        "place that is watched" | "end of the scan" => "--to",
        "model energy-loss" => "--model energy-loss",
        "stiffness of the ball" => "--ball-stiffness",
        "measured modes" => "--measured",
        other => other,
    }
}

fn titled(text: &str) -> Group<'static> {
    Group::with_title(Level::ERROR.primary_title(printable(text)))
}

fn advised(text: &str, advice: &str) -> Group<'static> {
    titled(text).element(Level::HELP.message(footer("help", advice)))
}

fn input(place: &FilePosition, complaint: &Complaint) -> Group<'static> {
    let Excerpt { before, marked, after } = &place.excerpt;
    let [before, marked, after] = [before, marked, after].map(|part| visible(part));
    let before = outdented(before);
    let expected = format!("expected {}", printable(&complaint.expected));
    let mark = AnnotationKind::Primary.span(before.len()..before.len() + marked.len());
    // Room for the number of the line, the bar and the spaces around it.
    let used = place.line.to_string().len() + 4 + columns(&before) + columns(&marked).max(1);
    let beside = used + columns(&expected) <= WIDTH;
    let mark = if beside { mark.label(expected) } else { mark };
    let source = format!("{before}{marked}{after}");
    let snippet = Snippet::source(source).line_start(place.line).annotation(mark);
    let mut group = titled(&headline(place, complaint)).element(snippet);
    if !beside {
        let level = Level::NOTE.with_name("expected");
        group = group.element(level.message(footer("expected", &complaint.expected)));
    }
    if !complaint.hint.is_empty() {
        group = group.element(Level::HELP.message(footer("help", &complaint.hint)));
    }
    group
}

/// The place, the field and what was found.
fn headline(place: &FilePosition, complaint: &Complaint) -> String {
    let one_line = Complaint { expected: String::new(), hint: String::new(), ..complaint.clone() };
    let said = one_line.to_string();
    format!("{place}: {}", said.trim_end_matches(", expected "))
}

/// Number of mistakes, their files, and the number that are not shown.
fn summary(shown: &[Error], more: usize) -> String {
    let mut files: Vec<&str> = Vec::new();
    for error in shown {
        if let Error::Input { place, .. } = error
            && !files.contains(&&*place.file)
        {
            files.push(&place.file);
        }
    }
    let count = shown.len() + more;
    let place =
        if files.is_empty() { String::new() } else { format!(" in {}", files.join(" and ")) };
    let rest = if more > 0 { format!(": these and {more} more") } else { String::new() };
    printable(&format!("{count} mistakes{place}{rest}"))
}

/// A text below the excerpt, in lines that fit beside its name.
fn footer(name: &str, text: &str) -> String {
    broken(&printable(text), WIDTH - name.len() - 12)
}

/// A part of a line of a file, with tabs as spaces and without characters that act on a terminal.
fn visible(part: &str) -> String {
    printable(&part.replace('\t', "    "))
}

/// The beginning of a line without the spaces of a deep indent.
fn outdented(before: String) -> String {
    const DEEP: usize = 20;
    let text = before.trim_start_matches(' ');
    if before.len() - text.len() > DEEP { format!("…{text}") } else { before }
}
