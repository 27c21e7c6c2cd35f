//! The lines of a universal file, their fields, and their positions.

use super::number::{real, whole};
use sweetspot::base::error::{Complaint, Error, Excerpt, FilePosition, Result, shortened};

/// Columns of a line of numbers in single precision.
pub(super) const SINGLES: [usize; 6] = [13; 6];

/// An error about a whole line of a file that was read, by its number from 1.
pub fn at_line(
    file: &str,
    bytes: &[u8],
    number: usize,
    found: impl std::fmt::Display,
    expected: impl Into<String>,
) -> Error {
    let mut lines = Lines::new(file, bytes);
    while lines.number < number && lines.next().is_some() {}
    match lines.peek() {
        Some(line) => line.wrong(found, expected),
        None => Line { file, number: lines.number, bytes: b"" }.wrong(found, expected),
    }
}

/// The lines of a file, read from the first to the last.
pub(super) struct Lines<'a> {
    file: &'a str,
    bytes: &'a [u8],
    /// Position of the next line, and its number from 1.
    at: usize,
    number: usize,
}

/// One line, without its end.
#[derive(Clone, Copy)]
pub(super) struct Line<'a> {
    file: &'a str,
    pub number: usize,
    bytes: &'a [u8],
}

impl<'a> Lines<'a> {
    pub fn new(file: &'a str, bytes: &'a [u8]) -> Self {
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        Self { file, bytes, at: 0, number: 1 }
    }

    /// The next line, which is not consumed; none at the end of the file.
    pub fn peek(&self) -> Option<Line<'a>> {
        let rest = &self.bytes[self.at..];
        let end = rest.iter().position(|b| *b == b'\n').unwrap_or(rest.len());
        let bytes = rest[..end].strip_suffix(b"\r").unwrap_or(&rest[..end]);
        (!rest.is_empty()).then_some(Line { file: self.file, number: self.number, bytes })
    }

    /// Consumes and returns the next line.
    pub fn next(&mut self) -> Option<Line<'a>> {
        let line = self.peek()?;
        let rest = &self.bytes[self.at..];
        let end = rest.iter().position(|b| *b == b'\n').map_or(rest.len(), |end| end + 1);
        self.at += end;
        self.number += 1;
        Some(line)
    }

    /// Consumes the next line, which must exist and must not be a fence.
    pub fn record(&mut self, what: &str) -> Result<Line<'a>> {
        match self.peek() {
            Some(line) if line.is_fence() => Err(line.wrong("the end of the dataset", what)),
            Some(line) => {
                self.next();
                Ok(line)
            }
            None => Err(self.ended(what)),
        }
    }

    /// A line of text: any line but a fence in its exact columns; None at a fence and at the end.
    pub fn text(&mut self) -> Option<Line<'a>> {
        self.peek().filter(|line| line.bytes.trim_ascii_end() != b"    -1")?;
        self.next()
    }

    /// The text of a required line.
    pub fn name(&mut self, what: &str) -> Result<String> {
        match self.text() {
            Some(line) => Ok(line.name(0, 80)),
            None => self.record(what).map(|line| line.name(0, 80)),
        }
    }

    /// The five lines of text at the head of data.
    pub fn ids(&mut self) -> Result<[String; 5]> {
        let mut ids: [String; 5] = Default::default();
        for id in &mut ids {
            *id = self.name("five lines of text at the head of the dataset")?;
        }
        Ok(ids)
    }

    /// An error about the end of the file.
    pub fn ended(&self, what: &str) -> Error {
        let line = Line { file: self.file, number: self.number, bytes: b"" };
        line.wrong("the end of the file", what)
    }

    /// The bytes that are not yet consumed.
    pub fn rest(&self) -> &'a [u8] {
        &self.bytes[self.at..]
    }

    /// Skips the given number of bytes; they count as one line if no other line end follows.
    pub fn skip(&mut self, count: usize) {
        let taken = &self.rest()[..count];
        self.number += taken.iter().filter(|b| **b == b'\n').count();
        self.at += count;
    }

    /// Numbers of the next lines until there are `count`, in columns of these widths or separated by blanks. Columns
    /// left blank at the end of a line count too.
    pub fn reals(&mut self, count: usize, widths: &[usize], what: &str) -> Result<Vec<f64>> {
        let mut values = Vec::new();
        while values.len() < count {
            let line = self.record(what)?;
            let before = values.len();
            values.extend(line.numbers(widths, real, what)?);
            if values.len() == before {
                return Err(line.wrong("an empty line", what));
            }
            if values.len() > count {
                let found = format!("{} numbers in this line", values.len() - before);
                return Err(line.wrong(found, format!("{}", count - before)));
            }
            if line.is_in_columns(widths) {
                let row = (before + widths.len()).min(count);
                values.resize(row.max(values.len()), 0.0);
            }
        }
        Ok(values)
    }
}

impl<'a> Line<'a> {
    /// `-1` in columns 5 and 6; a file that has lost blanks has it further to the left.
    pub fn is_fence(self) -> bool {
        let end = self.bytes.trim_ascii_end();
        end.len() <= 6 && end.trim_ascii_start() == b"-1"
    }

    pub fn is_blank(self) -> bool {
        self.bytes.trim_ascii().is_empty()
    }

    /// The text of columns (from 0), without surrounding blanks. Bytes that are not UTF-8 are read as Latin-1, which
    /// older programs write.
    pub fn text(self, start: usize, width: usize) -> String {
        let bytes = self.columns(start, width).trim_ascii();
        match std::str::from_utf8(bytes) {
            Ok(text) => text.to_owned(),
            Err(_) => bytes.iter().map(|b| char::from(*b)).collect(),
        }
    }

    /// As [`Self::text`], but empty for `NONE`, the mark of an empty field.
    pub fn name(self, start: usize, width: usize) -> String {
        let text = self.text(start, width);
        if text.eq_ignore_ascii_case("none") { String::new() } else { text }
    }

    fn columns(self, start: usize, width: usize) -> &'a [u8] {
        let end = start.saturating_add(width).min(self.bytes.len());
        self.bytes.get(start..end).unwrap_or_default()
    }

    /// The whole number in columns; blank is 0.
    pub fn integer(self, start: usize, width: usize, what: &str) -> Result<i64> {
        self.field(start, width, whole, what).map(Option::unwrap_or_default)
    }

    fn field<T>(
        self,
        start: usize,
        width: usize,
        parse: fn(&str) -> Option<T>,
        what: &str,
    ) -> Result<Option<T>> {
        let bytes = self.columns(start, width);
        if bytes.trim_ascii().is_empty() {
            return Ok(None);
        }
        let value = std::str::from_utf8(bytes).ok().and_then(parse);
        value.map(Some).ok_or_else(|| {
            let blanks = bytes.len() - bytes.trim_ascii_start().len();
            self.error(start + blanks, format!("\"{}\"", self.text(start, width)), what)
        })
    }

    /// The whole numbers of a line of such columns, or with blanks between.
    pub fn integers(self, widths: &[usize], what: &str) -> Result<Vec<i64>> {
        self.numbers(widths, whole, what)
    }

    /// The content of the columns up to the last number, if the words end where columns do; a blank is 0, as Fortran
    /// reads it. Otherwise the words between blanks, if each is a number that fits a column. Otherwise the columns,
    /// where numbers may touch.
    pub fn numbers<T: Default>(
        self,
        widths: &[usize],
        parse: fn(&str) -> Option<T>,
        what: &str,
    ) -> Result<Vec<T>> {
        let widest = widths.iter().copied().max().unwrap_or_default();
        if let Some(words) = self.words().filter(|_| !self.is_in_columns(widths)) {
            let fit = |word: &&str| word.len() <= widest;
            let values: Option<Vec<T>> =
                words.iter().map(|word| parse(word).filter(|_| fit(word))).collect();
            if let Some(values) = values {
                return Ok(values);
            }
        }
        let end = self.bytes.trim_ascii_end().len();
        let (mut start, mut values) = (0, Vec::new());
        for width in widths {
            if start < end {
                values.push(self.field(start, *width, parse, what)?.unwrap_or_default());
            }
            start += width;
        }
        match self.bytes[..end].get(start..).unwrap_or_default().trim_ascii() {
            [] => Ok(values),
            _ => Err(self.error(start, format!("\"{}\"", self.text(start, end)), "nothing more")),
        }
    }

    /// Whether there are words, and each ends at the end of a column of these widths.
    fn is_in_columns(self, widths: &[usize]) -> bool {
        let mut ends = widths.iter().scan(0, |end, width| {
            *end += width;
            Some(*end)
        });
        let blank = |k: usize| self.bytes.get(k).is_none_or(u8::is_ascii_whitespace);
        let mut words = (1..=self.bytes.len()).filter(|k| !blank(k - 1) && blank(*k)).peekable();
        words.peek().is_some() && words.all(|word| ends.any(|end| end == word))
    }

    /// The words between blanks, if the line is text.
    pub fn words(self) -> Option<Vec<&'a str>> {
        Some(std::str::from_utf8(self.bytes).ok()?.split_ascii_whitespace().collect())
    }

    /// An error about the whole line.
    pub fn wrong(self, found: impl std::fmt::Display, expected: impl Into<String>) -> Error {
        let first = self.bytes.len() - self.bytes.trim_ascii_start().len();
        self.error(if self.is_blank() { 0 } else { first }, found, expected)
    }

    /// The content of the line, for display.
    pub fn shown(self) -> String {
        format!("\"{}\"", shortened(&self.text(0, self.bytes.len()), 40))
    }

    /// An error at a column (from 0).
    fn error(
        self,
        column: usize,
        found: impl std::fmt::Display,
        expected: impl Into<String>,
    ) -> Error {
        let (file, line) = (self.file.to_owned(), self.number);
        let place = FilePosition { file, line, column: column + 1, excerpt: self.excerpt(column) };
        Error::Input { place: Box::new(place), complaint: Complaint::new("", found, expected) }
    }

    /// The line itself, or the surroundings of the column if it is long, with the word there marked.
    fn excerpt(self, column: usize) -> Excerpt {
        const AROUND: usize = 60;
        let (before, rest) = self.bytes.split_at(column.min(self.bytes.len()));
        let word = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        let (marked, after) = rest.split_at(word.min(AROUND));
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        Excerpt {
            before: text(&before[before.len().saturating_sub(AROUND)..]),
            marked: text(marked),
            after: text(&after[..after.len().min(AROUND)]),
        }
    }
}
