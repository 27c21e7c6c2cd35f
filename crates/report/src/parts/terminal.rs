//! A report on a terminal: sentences and tables of at most 80 columns, and a screen that states what it omits.

use std::cmp::Reverse;
use std::fmt::Write;
use std::slice;

use crate::parts::columns::{Columns, WIDE, labels, numbers};
use crate::parts::part::{Fact, Part};
use crate::parts::table::Table;

/// A title and what follows it.
pub fn text(title: &str, all: &[Part]) -> String {
    wrapped(title, 2) + &parts(all)
}

/// Parts one below the other.
pub fn parts(all: &[Part]) -> String {
    let mut out = String::new();
    let mut told = false;
    for part in all {
        // Sentences are separated from what is above them.
        let tells = matches!(part, Part::Text(_) | Part::Missing(_));
        out += if tells && !told { "\n" } else { "" };
        told = tells;
        match part {
            Part::Heading(title) => out += &format!("\n{title}\n"),
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

/// An empty line and the caption, the heads and their units, the rows: numbers end where their heads do. The words of
/// heads stand one below the other where they would be too wide in a line. Empty without rows.
fn table(table: &Table) -> String {
    if table.rows.is_empty() {
        return String::new();
    }
    let units: Vec<String> = table.units.iter().map(|unit| (*unit).to_owned()).collect();
    let lines = |heads: &[Vec<String>]| -> Vec<Vec<String>> {
        let above = heads.iter().chain([&units]);
        let above = above.filter(|line| line.iter().any(|cell| !cell.is_empty()));
        above.chain(&table.rows).cloned().collect()
    };
    let width = |lines: &[Vec<String>], k: usize| {
        let cells = lines.iter().filter_map(|line| line.get(k));
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let count = table.head.len();
    let mut all = lines(slice::from_ref(&table.head));
    if (0..count).map(|k| width(&all, k) + 2).sum::<usize>() > WIDE {
        all = lines(&stacked(&table.head));
    }
    let word =
        |cell: &String| cell.is_empty() || cell.trim_start().starts_with(char::is_alphabetic);
    let words = |k: usize| table.words || table.rows.iter().all(|row| word(&row[k]));
    let column = |k: usize| match words(k) {
        true => labels(width(&all, k), ""),
        false => numbers(width(&all, k) + 2, ""),
    };
    let columns = Columns::new((0..count).map(column));
    let caption = match &*table.caption {
        "" => String::new(),
        caption => "\n".to_owned() + &wrapped(caption, 2),
    };
    all.iter().fold(caption, |out, line| out + &columns.row(line))
}

/// The words of heads, the last ones in the last line.
fn stacked(heads: &[String]) -> Vec<Vec<String>> {
    let words: Vec<Vec<&str>> = heads.iter().map(|head| head.split(' ').collect()).collect();
    let most = words.iter().map(Vec::len).max().unwrap_or(0);
    let word = |words: &Vec<&str>, k: usize| {
        (k + words.len()).checked_sub(most).map_or(String::new(), |k| words[k].to_owned())
    };
    (0..most).map(|k| words.iter().map(|words| word(words, k)).collect()).collect()
}

/// Number of lines of a screen, and of the screens of the verbs with tables along the bat or by mode.
pub const LINES: usize = 24;
pub const MANY: usize = 40;

/// A piece of a screen: its priority for shortening, the highest number first and 0 never; the name of what is then
/// omitted; its text.
pub type Piece = (u8, &'static str, String);

/// The pieces of a screen, from top to bottom.
pub struct Screen(Vec<Piece>);

impl From<String> for Screen {
    fn from(text: String) -> Self {
        [(1, "", text)].into()
    }
}

impl<const N: usize> From<[Piece; N]> for Screen {
    fn from(pieces: [Piece; N]) -> Self {
        Self(pieces.into())
    }
}

impl Screen {
    /// All pieces, unshortened.
    pub fn text(&self) -> String {
        self.0.iter().map(|(.., text)| &**text).collect()
    }

    /// At most `most` lines, broken between words at 80 columns: `all` if it fits, else the pieces that fit, the names
    /// of the shortened ones, and `rest`, which says where the rest can be found.
    pub fn fitted(mut self, most: usize, all: &str, rest: &str) -> String {
        let whole = self.text() == all;
        let narrow = |line: &str| wrapped(line, 4);
        self.0.iter_mut().for_each(|(.., text)| *text = text.lines().map(narrow).collect());
        let mut over = (self.text().lines().count() + 1).saturating_sub(most);
        if over < 2 && whole {
            return self.text();
        }
        let mut last: Vec<&mut Piece> = self.0.iter_mut().filter(|piece| piece.0 > 0).collect();
        last.sort_by_key(|piece| Reverse(piece.0));
        let mut cut = vec![];
        for (_, name, text) in last.into_iter().filter(|piece| !piece.2.is_empty()) {
            let lines = text.lines().count();
            *text = fitting(text, lines.saturating_sub(over));
            let fewer = lines - text.lines().count();
            cut.extend((fewer > 0 && !name.is_empty()).then_some(*name));
            over = over.saturating_sub(fewer);
        }
        let names = cut.join(", ");
        let cut = if cut.is_empty() { names } else { format!("Cut short: {names}. ") };
        self.text() + &wrapped(&(cut + rest), 0)
    }
}

/// A text of at most `most` lines. Its last statements are omitted, each with all lines into which [`wrapped`] broke
/// it, and also headings without content.
fn fitting(text: &str, most: usize) -> String {
    let mut lines: Vec<&str> = text.lines().collect();
    let indent = |line: &str| line.len() - line.trim_start().len();
    let goes_on = |above: &str, line: &str| {
        let word = line.split_whitespace().next().unwrap_or_default();
        let sentence = !word.is_empty() && !above.trim_start().contains("  ");
        sentence && above.chars().count() + 1 + word.chars().count() >= WIDE
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
    while let Some((end, _)) = rest.char_indices().nth(WIDE - lead) {
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
        let margin = wrapped(&long, 0);
        assert_eq!((margin.lines().count(), fitting(&margin, 1)), (2, String::new()));
        let rows = format!("  1{:>76}\n  2{:>76}\n", 3, 4);
        assert_eq!(fitting(&rows, 1), format!("  1{:>76}\n", 3));
    }

    #[test]
    fn a_screen_cuts_first_what_matters_least_and_says_what() {
        let rows = |count: usize| "  row\n".repeat(count);
        let screen =
            || Screen::from([(0, "", rows(3)), (2, "late", rows(3)), (1, "soon", rows(3))]);
        let all = screen().text();
        assert_eq!(screen().fitted(9, &all, "More: --full"), all);
        assert_eq!(screen().fitted(10, "", "More: --full"), all.clone() + "More: --full\n");
        let one = screen().fitted(8, &all, "More: --full");
        assert_eq!(one, rows(7) + "Cut short: late. More: --full\n");
        let both = screen().fitted(6, &all, "More: --full");
        assert_eq!(both, rows(5) + "Cut short: late, soon. More: --full\n");
        let wide = Screen::from("word ".repeat(20)).fitted(24, "", "");
        assert!(wide.lines().all(|line| line.chars().count() <= WIDE), "{wide}");
    }
}
