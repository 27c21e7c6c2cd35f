//! The cells of a table as programs and spreadsheets write it, each with its place.
//!
//! Cells are separated by commas, semicolons, tabs or blanks (the first line may say which, as in `sep=;`). They may be
//! quoted. Numbers may have decimal points or commas, or fractions of an inch rule. Empty cells and rows at the end are
//! ignored. Lines that begin with `#` are comments, and so are those above the header. Names of columns may have any
//! capitals, and their units follow after `_` or in brackets: `Frequency (Hz)` is `frequency_hz`.

use std::ops::Range;

use crate::base::{Complaint, Error, Quantity, Result, marks, mistakes, typed, units};
use crate::files::document::Document;
use crate::files::sheet_number::{self, Decimal};

/// A header and the rows below it.
pub struct Sheet<'a> {
    document: &'a Document,
    pub header: SheetRow<'a>,
    /// Rows below the header, each as wide as the header.
    pub rows: Vec<SheetRow<'a>>,
    decimal: Decimal,
}

/// One row: its cells without the spaces and quotes around them.
pub struct SheetRow<'a> {
    start: usize,
    pub cells: Vec<&'a str>,
}

impl<'a> Sheet<'a> {
    /// Splits the text into cells. `names` checks whether a row may be a header, `known` whether a row of [`normal`]
    /// names is one.
    pub fn new(
        document: &'a Document,
        names: &str,
        known: impl Fn(&[String]) -> bool,
    ) -> Result<Self> {
        let text = &document.text[..];
        let (at, separator, found) = beginning(document, known)?;
        let mut rows = records(document, at, separator)?;
        if rows.is_empty() {
            let complaint = Complaint::new("", "no header", names);
            return Err(document.error(0..0, complaint));
        }
        let mut header = rows.remove(0);
        while header.cells.last().is_some_and(|cell| cell.is_empty()) {
            header.cells.pop();
        }
        let width = header.cells.len();
        mistakes::all(rows.iter_mut().map(|row| {
            while row.cells.len() > width && row.cells.last().is_some_and(|cell| cell.is_empty()) {
                row.cells.pop();
            }
            let many = row.cells.len();
            if many == width {
                return Ok(());
            }
            if !found {
                let first = format!("\"{}\" first", text[line(text, header.start)].trim());
                let complaint = Complaint::new("header", first, names);
                return Err(document.error(line(text, header.start), complaint));
            }
            let found = format!("{many} {} in this row", if many == 1 { "cell" } else { "cells" });
            let mut complaint = Complaint::new("", found, format!("{width}, as in the header"));
            if separator == Separator::Sign(b',') && many > width {
                let hint = "commas stand between the cells here: numbers have points, or semicolons \
                            stand between the cells";
                complaint = complaint.hinted(hint);
            }
            Err(document.error(line(text, row.start), complaint))
        }))?;
        let mut sheet = Self { document, header, rows, decimal: Decimal::Point };
        sheet.decimal = sheet.settled(separator)?;
        Ok(sheet)
    }

    /// The decimal sign of the table: that of its unambiguous numbers, or else the one that fits the separator.
    fn settled(&self, separator: Separator) -> Result<Decimal> {
        let mut first: Option<(Decimal, &str)> = None;
        for cell in self.rows.iter().flat_map(|row| &row.cells) {
            let Some(sign) = sheet_number::certain(cell) else { continue };
            match first {
                Some((settled, before)) if settled != sign => {
                    let found = format!("\"{cell}\" beside \"{before}\"");
                    let expected = "one decimal sign in the whole table";
                    let complaint = Complaint::new("", found, expected);
                    return Err(self.document.error(self.place(cell), complaint));
                }
                None => first = Some((sign, cell)),
                Some(_) => {}
            }
        }
        let european = separator == Separator::Sign(b';');
        let usual = if european { Decimal::Comma } else { Decimal::Point };
        Ok(first.map_or(usual, |(sign, _)| sign))
    }

    /// Position of a part of the text, in bytes.
    pub fn place(&self, part: &str) -> Range<usize> {
        let start = part.as_ptr() as usize - self.document.text.as_ptr() as usize;
        start..start + part.len()
    }

    /// Position of the header.
    pub fn header_line(&self) -> Range<usize> {
        line(&self.document.text, self.header.start)
    }

    /// The number in a cell.
    ///
    /// # Errors
    ///
    /// What was found and what was expected, without a field.
    pub fn value(&self, cell: &str) -> std::result::Result<f64, Complaint> {
        sheet_number::value(cell, self.decimal)
    }

    /// An error about a cell, from a complaint.
    pub fn error(&self, (row, cell): (&SheetRow, usize), complaint: Complaint) -> Error {
        self.document.error(self.place(row.cells[cell]), complaint)
    }
}

/// Cell by cell, for tables with rows of different kinds, such as measured modes.
impl Sheet<'_> {
    /// An error about a cell.
    pub fn wrong(
        &self,
        at: (&SheetRow, usize),
        field: &str,
        found: &str,
        expected: impl Into<String>,
    ) -> Error {
        self.error(at, Complaint::new(field, found, expected))
    }

    /// An error about a cell that quotes its text.
    pub fn strange(
        &self,
        (row, cell): (&SheetRow, usize),
        field: &str,
        expected: impl Into<String>,
    ) -> Error {
        let found = format!("\"{}\"", row.cells[cell]);
        self.wrong((row, cell), field, &found, expected)
    }

    /// The number in a cell, if it is in that range.
    pub fn number(&self, at: (&SheetRow, usize), field: &str, range: [f64; 2]) -> Result<f64> {
        self.number_of(at.0.cells[at.1], field, range)
    }

    /// The number in a part of a cell, if it is in that range.
    pub fn number_of(&self, cell: &str, field: &str, [low, high]: [f64; 2]) -> Result<f64> {
        let wrong = |complaint: Complaint| {
            self.document
                .error(self.place(cell), Complaint { field: field.to_owned(), ..complaint })
        };
        match self.value(cell).map_err(wrong)? {
            value if value >= low && value <= high => Ok(value),
            _ => Err(wrong(Complaint::new("", cell, format!("{low:?} to {high:?}")))),
        }
    }

    /// The factor to SI of a column name such as `x_in`, which begins with `stem`.
    pub fn factor(&self, at: (&SheetRow, usize), stem: &str, quantity: Quantity) -> Result<f64> {
        let name = normal(at.0.cells[at.1]);
        let Some(unit) = name.strip_prefix(stem).and_then(|rest| rest.strip_prefix('_')) else {
            let example = if quantity == Quantity::Length { "x_in or x_m" } else { "frequency_hz" };
            return Err(self.strange(at, "", format!("its unit too, as in {example}")));
        };
        factor(unit, quantity)
            .map_err(|complaint| self.wrong(at, &name, &complaint.found, complaint.expected))
    }
}

/// The factor to SI of a unit in lower case, as in names of columns.
///
/// # Errors
///
/// Those of [`units::factor`].
pub(crate) fn factor(unit: &str, quantity: Quantity) -> std::result::Result<f64, Complaint> {
    let marked = typed::plain(unit);
    let unit = match marked.trim_end_matches('.') {
        "hz" => "Hz",
        "khz" => "kHz",
        "n" => "N",
        "kn" => "kN",
        "sec" | "seconds" => "s",
        unit => unit,
    };
    units::factor(unit, quantity)
}

/// A column's name in lower case with its unit after `_`: `Inner Diameter [mm]` is `inner_diameter_mm`.
pub fn normal(name: &str) -> String {
    let small = name.trim().to_lowercase();
    let bracket = small.ends_with([')', ']', '}']).then(|| small.rfind(['(', '[', '{'])).flatten();
    let (stem, unit) = match (bracket, small.split_once([',', '/'])) {
        (Some(at), _) => (&small[..at], Some(&small[at + 1..small.len() - 1])),
        (None, Some((stem, unit))) => (stem, Some(unit)),
        (None, None) => (&small[..], None),
    };
    let stem = stem.trim().replace([' ', '-'], "_").replace('.', "");
    let stem = match stem.as_str() {
        "position" | "distance" | "place" | "location" | "station" => "x",
        "od" | "outer_diameter" | "outside_diameter" => "diameter",
        "id" | "inside_diameter" | "bore" => "inner_diameter",
        "outer_radius" => "radius",
        "wall" => "wall_thickness",
        "freq" | "damped_frequency" | "natural_frequency" => "frequency",
        "mode_no" | "mode_nr" | "mode_number" | "no" | "nr" => "mode",
        "time" => "t",
        stem => stem,
    };
    match unit.map(str::trim) {
        Some("%") if stem.starts_with("damping") => "damping_percent".to_owned(),
        Some("-" | "1") | None => stem.to_owned(),
        Some(unit) => format!("{stem}_{unit}"),
    }
}

/// Whether a text begins like a table of numbers with columns of those names. Its first line has them in at least half
/// of its cells, or a later line has them with numbers below, or the first line has other names with only numbers
/// below. A text without lines begins like any table.
pub(crate) fn begins_with_numbers(text: &str, keys: &[&str]) -> bool {
    /// Most lines, and most cells of a line, that are checked.
    const LOOKED_AT: usize = 1000;
    let is_empty = |line: &&str| line.trim().is_empty() || line.starts_with('#');
    let is_sign = |c: char| c.is_whitespace() || [',', ';', '|', '"'].contains(&c);
    let cells = |line: &str| -> Vec<String> {
        let cells = line.split(is_sign).filter(|cell| !cell.is_empty());
        cells.take(LOOKED_AT).map(normal).collect()
    };
    let is_known = |cell: &String| {
        let rest = keys.iter().filter_map(|key| cell.strip_prefix(key));
        rest.into_iter().any(|rest| rest.is_empty() || rest.starts_with('_'))
    };
    let half = |cells: &[String], is: &dyn Fn(&String) -> bool| {
        2 * cells.iter().filter(|cell| is(cell)).count() >= cells.len()
    };
    let is_number = |cell: &String| sheet_number::value(cell, Decimal::Point).is_ok();
    let lines: Vec<&str> = text.lines().filter(|line| !is_empty(line)).take(LOOKED_AT).collect();
    let [first, second] = [0, 1].map(|k| lines.get(k).map_or(vec![], |line| cells(line)));
    let separator = lines.first().is_some_and(|line| line.len() == 5 && line.starts_with("sep="));
    let other = second.len() > 1 && second.iter().all(is_number);
    separator
        || half(&first, &is_known)
        || other
        || lines.windows(2).any(|pair| {
            let [names, below] = [cells(pair[0]), cells(pair[1])];
            below.len() > 1 && half(&names, &is_known) && half(&below, &is_number)
        })
}

/// The separator of the cells of a table.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Separator {
    /// This sign, one between two cells.
    Sign(u8),
    /// At least this many blanks.
    Blanks(usize),
}

impl Separator {
    /// The cells of the row at `at` and the start of the next row; the error is the place of a quote without an end.
    fn record(self, text: &str, at: usize) -> std::result::Result<(Vec<&str>, usize), usize> {
        match self {
            Self::Sign(sign) => record(text, at, sign),
            Self::Blanks(least) => {
                let end = text[at..].find('\n').map_or(text.len(), |end| at + end + 1);
                Ok((in_blanks(&text[at..end], least), end))
            }
        }
    }
}

/// Start of the header, the separator, and whether the header is known. It is the first known line, since programs
/// write what was measured and when above it; otherwise it is the first line.
fn beginning(
    document: &Document,
    known: impl Fn(&[String]) -> bool,
) -> Result<(usize, Separator, bool)> {
    /// Most lines above a header.
    const ABOVE: usize = 1000;
    let text = &document.text[..];
    let blank = |line: &str| line.trim_matches([' ', '\t', '\r', '\n']).is_empty();
    let mut at = 0;
    let mut lines = vec![];
    for line in text.split_inclusive('\n') {
        if !blank(line) && !line.starts_with('#') {
            lines.push(at);
        }
        at += line.len();
        if lines.len() > ABOVE {
            break;
        }
    }
    let Some(&first) = lines.first() else { return Ok((at, Separator::Sign(b','), false)) };
    let told = self::line(text, first);
    let told = text[told].trim_matches([' ', '"']);
    // Spreadsheets may name the separator in the first line.
    if told.get(..4).is_some_and(|begins| begins.eq_ignore_ascii_case("sep=")) {
        let sign = told.as_bytes().get(4).copied();
        let Some(sign) = sign.filter(|sign| [b',', b';', b'\t', b'|'].contains(sign)) else {
            let expected = "a comma, a semicolon, a tab or | after sep=";
            let complaint = Complaint::new("", format!("\"{told}\""), expected);
            return Err(document.error(line(text, first), complaint));
        };
        return Ok((lines.get(1).copied().unwrap_or(at), Separator::Sign(sign), true));
    }
    let header = |at: usize, separator: Separator| {
        let cells = separator.record(text, at).map(|(cells, _)| cells).unwrap_or_default();
        let names: Vec<String> = cells.iter().map(|cell| normal(cell)).collect();
        // A row of numbers may begin like a header: "frequency_hz, 178.2, 583".
        let number = |cell: &&str| sheet_number::value(cell, Decimal::Point).is_ok();
        (known(&names) && !cells.iter().any(number)).then_some(cells.len())
    };
    for (k, &at) in lines.iter().enumerate() {
        let sign = Separator::Sign(between(text, at));
        let signs = header(at, sign);
        if signs.is_some_and(|count| count > 1) {
            return Ok((at, sign, true));
        }
        // If blanks separate the header, they also separate the rows below it.
        for least in [2, 1] {
            let blanks = Separator::Blanks(least);
            let below = lines.get(k + 1).and_then(|below| blanks.record(text, *below).ok());
            let many = header(at, blanks).filter(|count| *count > 1);
            if many.is_some() && many == below.map(|(cells, _)| cells.len()) {
                return Ok((at, blanks, true));
            }
        }
        if signs.is_some() {
            return Ok((at, sign, true));
        }
    }
    Ok((first, Separator::Sign(between(text, first)), false))
}

/// The rows from a place on, without comments and empty rows.
fn records(document: &Document, mut at: usize, separator: Separator) -> Result<Vec<SheetRow<'_>>> {
    let text = &document.text[..];
    let mut rows = vec![];
    while at < text.len() {
        if text[at..].starts_with('#') {
            at = text[at..].find('\n').map_or(text.len(), |end| at + end + 1);
            continue;
        }
        let start = at;
        let cells;
        (cells, at) = separator.record(text, at).map_err(|quote| {
            let field = if rows.is_empty() { "header" } else { "" };
            let complaint = Complaint::new(field, "a quote without an end", "quotes in pairs");
            document.error(quote..quote + 1, complaint.hinted("a closing quote is missing"))
        })?;
        let cells: Vec<&str> = cells.into_iter().map(marks::of_cell).collect();
        // Spreadsheets leave lines with only separators.
        if cells.iter().any(|cell| !cell.is_empty()) {
            rows.push(SheetRow { start, cells });
        }
    }
    Ok(rows)
}

/// The cells of a line that are separated by at least the given number of blanks; brackets belong to the name before
/// them.
fn in_blanks(line: &str, least: usize) -> Vec<&str> {
    let blank = |c: char| c.is_whitespace();
    let line = line.trim_matches(blank);
    let mut cells = vec![];
    let (mut start, mut depth, mut at) = (0, 0, 0);
    while let Some(next) = line[at..].chars().next() {
        let width = line[at..].len() - line[at..].trim_start_matches(blank).len();
        match next {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            _ if blank(next) => {
                let after = &line[at + width..];
                let tab = line[at..at + width].contains('\t');
                let apart = tab || line[at..at + width].chars().count() >= least;
                if depth <= 0 && apart && !after.starts_with(['(', '[']) {
                    cells.push(&line[start..at]);
                    start = at + width;
                }
                at += width;
                continue;
            }
            _ => {}
        }
        at += next.len_utf8();
    }
    cells.push(&line[start..]);
    cells.into_iter().map(|cell| cell.trim_matches('"')).collect()
}

/// The separator of the names of a header: semicolons or tabs if there are any, otherwise commas. Those in quotes or
/// brackets are part of a name.
fn between(text: &str, at: usize) -> u8 {
    let (mut quoted, mut fresh, mut depth, mut best) = (false, true, 0, b',');
    for byte in text[at..].bytes() {
        match byte {
            // Inside a name, a quote stands for inches.
            b'"' if quoted || fresh => quoted = !quoted,
            b'(' | b'[' if !quoted => depth += 1,
            b')' | b']' if !quoted => depth -= 1,
            b'\n' if !quoted => break,
            b';' if !quoted && depth <= 0 => return b';',
            b'\t' if !quoted && depth <= 0 => best = b'\t',
            _ => {}
        }
        fresh = matches!(byte, b',' | b'\t') || (fresh && byte == b' ');
    }
    best
}

/// The cells of the row at `at` and the start of the next row; the error is the place of a quote without an end.
fn record(
    text: &str,
    mut at: usize,
    separator: u8,
) -> std::result::Result<(Vec<&str>, usize), usize> {
    let bytes = text.as_bytes();
    let ends = |i: usize| bytes.get(i).is_none_or(|byte| *byte == separator || *byte == b'\n');
    let blank = |i: usize| matches!(bytes.get(i), Some(b' ' | b'\t' | b'\r')) && !ends(i);
    let mut cells = vec![];
    loop {
        let start = (at..).find(|i| !blank(*i)).unwrap_or(at);
        let mut end = start;
        let cell = if bytes.get(start) == Some(&b'"') {
            end = start + 1;
            while bytes.get(end) != Some(&b'"') || bytes.get(end + 1) == Some(&b'"') {
                end += if bytes.get(end) == Some(&b'"') { 2 } else { 1 };
                if end >= bytes.len() {
                    return Err(start);
                }
            }
            let inside = &text[start + 1..end];
            end += 1;
            while blank(end) {
                end += 1;
            }
            inside
        } else {
            ""
        };
        let closed = ends(end);
        while !ends(end) {
            end += 1;
        }
        let cell = if end > start && closed { cell } else { &text[start..end] };
        cells.push(cell.trim_start().trim_end());
        at = end + 1;
        if bytes.get(end) != Some(&separator) {
            return Ok((cells, at.min(bytes.len())));
        }
    }
}

/// The line that begins at `offset`, without its line end.
fn line(text: &str, offset: usize) -> Range<usize> {
    let line = text[offset..].lines().next().unwrap_or_default();
    offset..offset + line.trim_end().len()
}
