//! Where in the file is a value: the text of an input file and the places in it.

use std::cell::Cell;
use std::ops::Range;
use std::path::Path;

use crate::base::{Complaint, Error, Excerpt, FilePosition, Result, file};

/// The text of an input file, without a byte-order mark.
#[derive(Debug)]
pub struct Document {
    pub file: String,
    pub text: String,
    /// Offset, line and column of the last place requested: the next one is usually close behind.
    last: Cell<(usize, usize, usize)>,
}

impl Document {
    /// Reads a file as UTF-8, or as UTF-16 if it begins with that mark.
    pub fn read(path: &Path) -> Result<Self> {
        Self::of(path, false)
    }

    /// As [`Self::read`], for a table. Text that is not UTF-8 is read as Windows-1252, as western spreadsheets write
    /// it; numbers and separators are ASCII in both.
    pub fn table(path: &Path) -> Result<Self> {
        Self::of(path, true)
    }

    /// A file that another one names; an inner error reports an encoding that cannot be read.
    pub fn named(path: &Path, of_a_table: bool) -> Result<Result<Self>> {
        let bytes = file::read_plain(path)?;
        Ok(Self::decoded(path, bytes, of_a_table))
    }

    fn of(path: &Path, of_a_table: bool) -> Result<Self> {
        Self::decoded(path, file::read(path)?, of_a_table)
    }

    fn decoded(path: &Path, bytes: Vec<u8>, of_a_table: bool) -> Result<Self> {
        let name = path.display().to_string();
        let wide = match bytes[..] {
            [0xff, 0xfe, ..] => Some(utf_16(&bytes, u16::from_le_bytes)),
            [0xfe, 0xff, ..] => Some(utf_16(&bytes, u16::from_be_bytes)),
            _ => None,
        };
        if let Some((text, whole)) = wide {
            let document = Self::new(name, &text);
            if whole {
                return Ok(document);
            }
            let at = document.text.find(char::REPLACEMENT_CHARACTER).unwrap_or(0);
            let end = at + document.text[at..].chars().next().map_or(0, char::len_utf8);
            let complaint = Complaint::new("", "bytes that are not UTF-16 text", "text");
            return Err(
                document.error(at..end, complaint.hinted("save it as UTF-8 in your editor"))
            );
        }
        match String::from_utf8(bytes) {
            Ok(text) => Ok(Self::new(name, &text)),
            Err(error) if of_a_table && !error.as_bytes().contains(&0) => {
                Ok(Self::new(name, &windows_1252(error.as_bytes())))
            }
            Err(error) => {
                let at = error.utf8_error().valid_up_to();
                // The same text up to there, with a replacement character for the invalid byte.
                let text = String::from_utf8_lossy(error.as_bytes());
                let marked = at..at + char::REPLACEMENT_CHARACTER.len_utf8();
                let document = Self { file: name, text: text.into_owned(), last: START.into() };
                let complaint = Complaint::new("", "bytes that are not text", "UTF-8 text");
                Err(document.error(marked, complaint.hinted("save it as UTF-8 in your editor")))
            }
        }
    }

    pub fn new(file: String, text: &str) -> Self {
        let mut text = text.trim_start_matches('\u{feff}').to_owned();
        // Some spreadsheets end lines with a carriage return only.
        if !text.contains('\n') {
            text = text.replace('\r', "\n");
        }
        Self { file, text, last: START.into() }
    }

    /// An error about a stretch of the text, in bytes.
    pub fn error(&self, marked: Range<usize>, complaint: Complaint) -> Error {
        Error::Input { place: self.placed(marked), complaint }
    }

    /// Position of a stretch of the text, in bytes.
    pub fn placed(&self, marked: Range<usize>) -> Box<FilePosition> {
        let (line, column) = self.place(marked.start);
        Box::new(FilePosition {
            file: self.file.clone(),
            line,
            column,
            excerpt: excerpt(&self.text, marked),
        })
    }

    /// Line and column of a byte.
    fn place(&self, offset: usize) -> (usize, usize) {
        let (mut at, mut line, mut column) = self.last.get();
        if at > offset {
            (at, line, column) = START;
        }
        let between = &self.text[at..offset];
        line += between.bytes().filter(|b| *b == b'\n').count();
        column = match between.rfind('\n') {
            Some(end) => 1 + between[end + 1..].chars().count(),
            None => column + between.chars().count(),
        };
        self.last.set((offset, line, column));
        (line, column)
    }
}

/// The text of UTF-16 bytes, and whether all of it could be read.
fn utf_16(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> (String, bool) {
    let units: Vec<u16> = bytes.chunks_exact(2).map(|pair| unit([pair[0], pair[1]])).collect();
    match String::from_utf16(&units) {
        Ok(text) if bytes.len().is_multiple_of(2) => (text, true),
        _ => (String::from_utf16_lossy(&units), false),
    }
}

/// The text of Windows-1252 bytes. Those from 0x80 to 0x9f are the characters of this list; all others have their own
/// number. Source: the Unicode consortium's mapping `CP1252.TXT`; the five that it leaves undefined become controls.
fn windows_1252(bytes: &[u8]) -> String {
    const HIGH: [char; 32] = [
        '€', '\u{81}', '‚', 'ƒ', '„', '…', '†', '‡', 'ˆ', '‰', 'Š', '‹', 'Œ', '\u{8d}', 'Ž',
        '\u{8f}', '\u{90}', '‘', '’', '“', '”', '•', '–', '—', '˜', '™', 'š', '›', 'œ', '\u{9d}',
        'ž', 'Ÿ',
    ];
    let of = |byte: &u8| match byte {
        0x80..=0x9f => HIGH[usize::from(byte - 0x80)],
        byte => char::from(*byte),
    };
    bytes.iter().map(of).collect()
}

/// The first byte is in line 1, column 1.
const START: (usize, usize, usize) = (0, 1, 1);

/// The line around a stretch of the text, as much of it as fits a terminal. For a stretch of several lines, only its
/// first character is marked.
fn excerpt(text: &str, marked: Range<usize>) -> Excerpt {
    /// Columns for the line, and for the marked part.
    const LINE: usize = 72;
    const MARKED: usize = 40;
    let whole = &text[marked.clone()];
    let first = whole.chars().next().map_or(0, char::len_utf8);
    let whole = if whole.contains('\n') { &whole[..first] } else { whole };
    let shown = head(whole, MARKED);
    let cut = shown.len() < whole.len();
    let (before, after) = (&text[..marked.start], &text[marked.start + shown.len()..]);
    // Each side gets the columns that the other leaves, but at least a third.
    let room = LINE - columns(shown);
    let [left, right] = [columns(tail(before, room)), columns(head(after, room))];
    let right = if cut { 0 } else { right.min((room / 3).max(room - left)) };
    let (before, after) = (ended(before, room - right), begun(after, right));
    Excerpt { before, marked: shown.to_owned(), after }
}

/// The rest of a line, at most the given number of columns, with `…` if it continues.
fn begun(text: &str, most: usize) -> String {
    let shown = head(text, most);
    let more = !matches!(text[shown.len()..].bytes().next(), None | Some(b'\n'));
    let dots = if more { "…" } else { "" };
    format!("{}{dots}", shown.trim_end_matches('\r'))
}

/// The part of a line before a place, at most the given number of columns, with `…` if it begins earlier.
fn ended(text: &str, most: usize) -> String {
    let shown = tail(text, most);
    let earlier = &text[..text.len() - shown.len()];
    let dots = if earlier.is_empty() || earlier.ends_with('\n') { "" } else { "…" };
    format!("{dots}{shown}")
}

/// The beginning of a text, up to the end of its line or the given number of columns.
fn head(text: &str, most: usize) -> &str {
    let mut left = most;
    let end = text.char_indices().find(|(_, c)| *c == '\n' || !fits(*c, &mut left));
    end.map_or(text, |(end, _)| &text[..end])
}

/// The end of a text, from the beginning of its last line or at most the given number of columns.
fn tail(text: &str, most: usize) -> &str {
    let mut left = most;
    let end = text.char_indices().rev().find(|(_, c)| *c == '\n' || !fits(*c, &mut left));
    end.map_or(text, |(start, c)| &text[start + c.len_utf8()..])
}

/// Whether there is room for a character, and the room after it.
fn fits(c: char, left: &mut usize) -> bool {
    let rest = left.checked_sub(width(c));
    *left = rest.unwrap_or(0);
    rest.is_some()
}

fn columns(text: &str) -> usize {
    text.chars().map(width).sum()
}

/// Columns of a character in a terminal: a tab takes four, and a character that may be wide counts as wide.
fn width(c: char) -> usize {
    match c {
        '\t' => 4,
        '\u{1100}'.. => 2,
        _ => 1,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parts(text: &str, marked: &str) -> [String; 3] {
        let at = text.find(marked).unwrap();
        let Excerpt { before, marked, after } = excerpt(text, at..at + marked.len());
        [before, marked, after]
    }

    #[test]
    fn an_excerpt_is_the_line_in_three_parts() {
        assert_eq!(parts("{\r\n\t\"é\": 7,\r\n}", "7"), ["\t\"é\": ", "7", ","]);
        assert_eq!(parts("{\n [1,\n 2]", "[1,\n 2]"), [" ", "[", "1,"]);
        assert_eq!(parts("a", "a"), ["", "a", ""]);
        let end = excerpt("{\n", 1..1);
        assert_eq!([end.before, end.marked, end.after], ["{", "", ""]);
    }

    #[test]
    fn a_long_line_is_shortened_around_what_is_marked() {
        let digits = "0123456789".repeat(100_000);
        let [before, marked, after] = parts(&format!("{digits}bad{digits}"), "bad");
        let size = |text: &str| text.chars().count();
        assert_eq!((size(&before), &*marked, size(&after)), (47, "bad", 24));
        assert!(before.starts_with("…456789") && before.ends_with("789"), "{before}");
        assert!(after.starts_with("0123") && after.ends_with("2…"), "{after}");
        let [before, marked, after] = parts(&format!("[{digits}]"), &digits);
        assert_eq!((&*before, size(&marked), &*after), ("[", 40, "…"));
        // At the beginning and the end of a line, the unused room goes to the other side.
        let [before, _, after] = parts(&format!("bad{digits}"), "bad");
        assert_eq!((size(&before), size(&after)), (0, 70));
        let [before, _, after] = parts(&format!("{digits}bad"), "bad");
        assert_eq!((size(&before), size(&after)), (70, 0));
        let wide = "黒".repeat(1000);
        let [before, _, after] = parts(&format!("{wide}bad{wide}"), "bad");
        assert!(2 * size(&before) + 2 * size(&after) <= 74, "{before} {after}");
    }

    #[test]
    fn places_are_the_same_in_any_order() {
        let document = Document::new("f".into(), "\u{feff}aé\n黒b\r\n\nc");
        for order in [[0, 1, 4, 7, 10, 11], [11, 4, 10, 0, 7, 1]] {
            for offset in order {
                let known = [(0, (1, 1)), (1, (1, 2)), (4, (2, 1)), (7, (2, 2)), (10, (3, 1))];
                let known = known.iter().find(|(at, _)| *at == offset).map_or((4, 1), |k| k.1);
                assert_eq!(document.place(offset), known, "{offset}");
            }
        }
    }
}
