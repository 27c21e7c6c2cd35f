//! The messages of the program about wrong input, read back from standard error.

use std::path::Path;

/// The beginning of the line for other programs, with `--json`.
pub const ERROR: &str = "{\"format\":\"sweetspot-error/1\"";

/// One mistake as it is shown.
#[derive(Debug, Default, Clone, PartialEq)]
pub struct Diagnostic {
    /// The first line, after `error: `.
    pub title: String,
    /// The number of the line in the file, and the excerpt shown.
    pub line: Option<(usize, String)>,
    /// Columns before the carets, and the number of carets.
    pub mark: Option<(usize, usize)>,
    pub expected: String,
    pub help: String,
    /// Lines outside the parts of a diagnostic, as in messages of the command line parser.
    pub rest: Vec<String>,
}

impl Diagnostic {
    /// The same in one line: place, field, found, expected, help.
    pub fn one_line(&self) -> String {
        let after = |lead: &str, part: &str| match part {
            "" => String::new(),
            part => format!("{lead}{part}"),
        };
        let (expected, help) = (after(", expected ", &self.expected), after("; ", &self.help));
        format!("{}{expected}{help}{}", self.title, after("\n", &self.rest.join("\n")))
    }

    /// The mistake in the excerpt, if any. It must be the line of the file that the title names, with the mark in the
    /// column that the title names.
    pub fn misplaced(&self, folder: &Path) -> Option<String> {
        let (shown_number, shown) = self.line.as_ref()?;
        let mut parts = self.title.splitn(4, ':');
        let mut part = || parts.next().unwrap_or_default().to_owned();
        let (file, line, column) = (part(), part(), part());
        if line != shown_number.to_string() {
            return Some(format!("line {shown_number} is shown for {line}"));
        }
        let bytes = std::fs::read(folder.join(&file)).ok()?;
        let text = String::from_utf8_lossy(&bytes);
        let text = text.trim_start_matches('\u{feff}');
        let written = text.split('\n').nth(shown_number - 1)?.trim_end_matches('\r');
        if written.contains(|c: char| c.is_control() && c != '\t') {
            return None;
        }
        let whole = written.replace('\t', "    ");
        let part = shown.trim_matches('…');
        let is_line = if part == shown { *shown == whole } else { whole.contains(part) };
        let column: usize = column.parse().ok()?;
        let before: String = written.chars().take(column - 1).collect();
        let (indent, marks) = self.mark.unwrap_or_default();
        // Only then a column is a character.
        let plain = whole.is_ascii() && part == shown;
        match () {
            () if !is_line => Some(format!("shown {shown:?} for {whole:?}")),
            () if marks == 0 => Some("no caret".to_owned()),
            () if plain && indent != before.replace('\t', "    ").len() => {
                Some(format!("a caret at {indent} for column {column}"))
            }
            () => None,
        }
    }
}

/// The messages on standard error, each mistake in one line.
pub fn in_lines(told: &[u8]) -> String {
    let (found, _) = diagnostics(&String::from_utf8_lossy(told));
    found.iter().map(|one| format!("error: {}\n", one.one_line())).collect()
}

/// The diagnostics on standard error, and the line with their number, if any.
pub fn diagnostics(told: &str) -> (Vec<Diagnostic>, Option<String>) {
    let mut found: Vec<Diagnostic> = Vec::new();
    // The text that a line without a name continues.
    let mut footer = "";
    for text in told.lines().filter(|line| !line.starts_with(ERROR)) {
        if let Some(title) = text.strip_prefix("error: ") {
            found.push(Diagnostic { title: title.to_owned(), ..Diagnostic::default() });
            footer = "";
            continue;
        }
        let Some(last) = found.last_mut() else { continue };
        let trimmed = text.trim_start();
        if let Some((number, line)) = numbered(text) {
            last.line = Some((number, line.to_owned()));
        } else if let Some(note) = trimmed.strip_prefix("= ") {
            let (name, said) = note.split_once(": ").unwrap_or((note, ""));
            footer = if name == "help" { "help" } else { "expected" };
            *part(last, footer) = said.to_owned();
        } else if let Some(below) = trimmed.strip_prefix('|') {
            marked(last, below);
        } else if !footer.is_empty() && text.starts_with("   ") {
            let part = part(last, footer);
            *part = format!("{part} {trimmed}");
        } else if !text.is_empty() {
            last.rest.push(text.to_owned());
        }
    }
    let counts = |last: &Diagnostic| last.title.contains(" mistakes") && last.line.is_none();
    let summary = found.pop_if(|last| counts(last)).map(|last| last.title);
    (found, summary)
}

fn part<'a>(diagnostic: &'a mut Diagnostic, name: &str) -> &'a mut String {
    if name == "help" { &mut diagnostic.help } else { &mut diagnostic.expected }
}

/// `12 | text` as 12 and the text.
fn numbered(text: &str) -> Option<(usize, &str)> {
    let (number, line) = text.split_once(" |")?;
    Some((number.trim_start().parse().ok()?, line.strip_prefix(' ').unwrap_or(line)))
}

/// Reads the line below the excerpt: carets and the expectation.
fn marked(diagnostic: &mut Diagnostic, below: &str) {
    let below = below.strip_prefix(' ').unwrap_or(below);
    let indent = below.chars().take_while(|c| *c == ' ').count();
    let carets = below.chars().skip(indent).take_while(|c| *c == '^').count();
    if carets > 0 {
        diagnostic.mark = Some((indent, carets));
        let label: String = below.chars().skip(indent + carets).collect();
        let label = label.trim_start();
        diagnostic.expected = label.strip_prefix("expected ").unwrap_or(label).to_owned();
    }
}
