//! A report on a terminal: sentences of at most 80 columns, tables as wide as they are.

use std::fmt::Write;

use crate::parts::part::{Fact, Part};
use crate::parts::table::Table;

/// A title and what follows it.
pub fn text(title: &str, parts: &[Part]) -> String {
    let mut out = wrapped(title, 2);
    let mut told = false;
    for part in parts {
        // Sentences stand apart from what is above them.
        let tells = matches!(part, Part::Text(_) | Part::Missing(_));
        out += if tells && !told { "\n" } else { "" };
        told = tells;
        match part {
            Part::Heading(title) => {
                let _ = write!(out, "\n{title}\n");
            }
            Part::Text(text) => out += &wrapped(text, 0),
            Part::Missing(why) => out += &wrapped(why, 0),
            Part::List(items) => {
                items.iter().for_each(|item| out += &wrapped(&format!("  {item}"), 4))
            }
            Part::Facts(_, facts) => facts.iter().for_each(|fact| out += &line(fact)),
            Part::Table(one) => out += &table(one),
            Part::Command(command) => out += &wrapped(command, 2),
            Part::Folded(title, parts) => out += &text(title, parts),
            // Pictures, players and the user's files need a page.
            Part::Picture(_) | Part::Hovered(_) | Part::File(_) | Part::Moving(_) => {}
        }
    }
    out
}

fn line(Fact { label, value, note, .. }: &Fact) -> String {
    wrapped(format!("  {label:<38} {value}  {note}").trim_end(), 41)
}

/// An empty line, the heads and their units, the rows: numbers end where their heads do.
fn table(table: &Table) -> String {
    let units = table.units.iter().map(|unit| (*unit).to_owned()).collect::<Vec<_>>();
    let above =
        [&table.head, &units].into_iter().filter(|line| line.iter().any(|cell| !cell.is_empty()));
    let lines: Vec<&Vec<String>> = above.chain(&table.rows).collect();
    let long = |cell: Option<&String>| cell.map_or(0, |cell| cell.chars().count());
    let width = |k: usize| lines.iter().map(|line| long(line.get(k))).max().unwrap_or(0);
    let is_number =
        |k: usize| !table.rows.iter().any(|row| row[k].starts_with(char::is_alphabetic));
    let columns: Vec<_> = (0..table.head.len()).map(|k| (width(k), is_number(k))).collect();
    let mut out = String::from("\n");
    for line in lines {
        let cells = line.iter().zip(&columns).map(|(cell, &(width, number))| match number {
            true => format!("  {cell:>width$}"),
            false => format!("  {cell:<width$}"),
        });
        out += cells.collect::<String>().trim_end();
        out.push('\n');
    }
    out
}

/// Lines of most screens but the last, which says where the rest is; `tests/first_screens.rs` holds every verb to its
/// number.
pub const LINES: usize = 23;

/// A text of at most `most` lines: its last statements are left out, each with all lines into which [`wrapped`] broke
/// it, and so are headings that nothing follows.
pub fn fitting(text: &str, most: usize) -> String {
    let mut lines: Vec<&str> = text.lines().collect();
    let indent = |line: &str| line.len() - line.trim_start().len();
    let goes_on = |above: &str, line: &str| {
        let word = line.split_whitespace().next().unwrap_or_default();
        indent(line) > 0 && above.chars().count() + 1 + word.chars().count() >= 80
    };
    while lines.len() > most {
        let Some(mut cut) = lines.pop() else { break };
        while let Some(above) = lines.pop_if(|above| goes_on(above, cut)) {
            cut = above;
        }
        while lines.pop_if(|above| above.is_empty() || indent(above) < indent(cut)).is_some() {}
    }
    lines.iter().map(|line| format!("{line}\n")).collect()
}

/// Breaks a line at its last spaces before column 80, the rest indented; ends the line.
pub fn wrapped(text: &str, indent: usize) -> String {
    let (mut out, mut rest, mut lead) = (String::new(), text, 0);
    while let Some((end, _)) = rest.char_indices().nth(80 - lead) {
        let Some(space) = rest[..end].rfind(' ').filter(|at| *at > 0) else { break };
        let _ = writeln!(out, "{:lead$}{}", "", rest[..space].trim_end());
        (rest, lead) = (rest[space..].trim_start(), indent);
    }
    let _ = writeln!(out, "{:lead$}{rest}", "");
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_that_is_too_long_loses_whole_statements_and_headings_of_nothing() {
        let long = "word ".repeat(25);
        let [first, second] = ["one", "two"].map(|name| wrapped(&format!("  {name}: {long}"), 4));
        assert_eq!((first.lines().count(), first.contains("\n    word")), (2, true));
        let text = format!("Table\n  a\n  b\n\nWords\n{first}{second}");
        assert_eq!(fitting(&text, 9), text);
        assert_eq!(fitting(&text, 8), format!("Table\n  a\n  b\n\nWords\n{first}"));
        assert_eq!(fitting(&text, 6), "Table\n  a\n  b\n");
        assert_eq!(fitting(&text, 2), "Table\n  a\n");
    }
}
