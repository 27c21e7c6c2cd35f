//! How do programs and spreadsheets write a table?
//!
//! Cells stand between commas, semicolons or tabs (`sep=;` on the first line says which); numbers have a decimal
//! point, a decimal comma or a fraction (`3 1/2`); names have capitals and units in brackets (`Frequency (Hz)`); rows
//! end in commas that hold nothing. [`Sheet`] knows this of one text, whatever the columns are.

use std::ops::Range;

use crate::base::typed;

/// How a table is written.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sheet {
    /// Between two cells.
    between: u8,
    /// Where the table begins, after a line that says what stands between cells.
    from: usize,
    /// Whether a number has a decimal point, so that a comma is none.
    points: bool,
}

impl Sheet {
    /// How that text is written: what stands between the names of its first row.
    pub fn of(text: &str) -> Self {
        let first = row_start(text, 0);
        let line = text[first..].lines().next().unwrap_or_default();
        let told = line.trim().trim_matches('"').strip_prefix("sep=").and_then(|it| it.bytes().next());
        let (from, between) = match told {
            Some(between) => (first + line.len(), between),
            None => (0, between(line)),
        };
        let bytes = text.as_bytes();
        let digit = |i: usize| bytes.get(i).is_some_and(u8::is_ascii_digit);
        let points = (1..bytes.len()).any(|i| bytes[i] == b'.' && digit(i - 1) && digit(i + 1));
        Self { between, from, points }
    }

    /// Its rows.
    pub fn reader<'a>(&self, text: &'a str) -> csv::Reader<&'a [u8]> {
        csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .flexible(true)
            .has_headers(false)
            .delimiter(self.between)
            .from_reader(&text.as_bytes()[self.from..])
    }

    /// Where a row stands in the text.
    pub fn offset(&self, text: &str, record: &csv::StringRecord) -> usize {
        let byte = record.position().map_or(0, |position| position.byte() as usize);
        row_start(text, self.from + byte)
    }

    /// Where cell number `column` of the row at `offset` stands, the spaces around it left out.
    pub fn cell(&self, text: &str, offset: usize, column: usize) -> Range<usize> {
        let (mut quoted, mut passed, mut start, mut end) = (false, 0, offset, text.len());
        for (at, byte) in (offset..).zip(text[offset..].bytes()) {
            match byte {
                b'"' => quoted = !quoted,
                _ if quoted => {}
                _ if byte == self.between && passed < column => (passed, start) = (passed + 1, at + 1),
                _ if byte == self.between || byte == b'\n' => {
                    end = at;
                    break;
                }
                _ => {}
            }
        }
        let start = end - text[start..end].trim_start().len();
        start..start + text[start..end].trim_end().len()
    }

    /// The number in a cell; what was expected where it is none, or may be read in two ways.
    pub fn number(&self, cell: &str) -> Result<f64, String> {
        if let Ok(value) = cell.parse::<f64>() {
            return Some(value).filter(|value| value.is_finite()).ok_or_else(not_a_number);
        }
        let plain = typed::plain(cell);
        let both = || format!("a number that can be read in one way: {}", plain.replace(',', "."));
        let value = match (plain.find(','), plain.rfind('.')) {
            // 1.234,5: points between thousands.
            (Some(comma), Some(point)) if point < comma => {
                typed::mixed(&plain.replace('.', "").replace(',', "."))
            }
            (Some(_), Some(_)) => typed::mixed(&plain),
            (Some(_), None) if self.points => return Err(both()),
            // 1,234 between commas may be a thousand; where the cells are not parted by commas it is decimal.
            (Some(_), None) if self.between == b',' && typed::readings(&plain).is_some() => {
                return Err(both());
            }
            (Some(_), None) if plain.matches(',').count() == 1 => plain.replace(',', ".").parse().ok(),
            (Some(_), None) => None,
            (None, _) => typed::mixed(&plain),
        };
        value.filter(|value| value.is_finite()).ok_or_else(not_a_number)
    }
}

fn not_a_number() -> String {
    "a finite number (the unit stands in the header)".to_owned()
}

/// What stands between the names of a header: what is there most often, outside of quotes and brackets.
fn between(header: &str) -> u8 {
    let (mut inside, mut quoted) = (0_i32, false);
    let mut counts = [(b';', 0), (b'\t', 0), (b',', 0)];
    for byte in header.bytes() {
        match byte {
            b'"' => quoted = !quoted,
            b'(' | b'[' => inside += 1,
            b')' | b']' => inside -= 1,
            _ if quoted || inside > 0 => {}
            _ => counts.iter_mut().filter(|(by, _)| *by == byte).for_each(|(_, count)| *count += 1),
        }
    }
    // Of equals the first: a comma may be part of a name.
    let most = counts.into_iter().rev().max_by_key(|(_, count)| *count);
    most.filter(|(_, count)| *count > 0).map_or(b',', |(by, _)| by)
}

/// The first byte at or after `offset` that belongs to no comment and no empty line.
pub(crate) fn row_start(text: &str, mut offset: usize) -> usize {
    loop {
        let rest = &text[offset..];
        offset += match rest.bytes().next() {
            Some(b'\r' | b'\n') => 1,
            Some(b'#') => rest.find('\n').unwrap_or(rest.len()),
            _ => return offset,
        };
    }
}

/// The cells of a row without what is empty at its end.
pub(crate) fn filled(record: &csv::StringRecord) -> usize {
    let last = record.iter().enumerate().filter(|(_, cell)| !cell.is_empty()).last();
    last.map_or(0, |(last, _)| last + 1)
}

/// Words for a quantity in other programs' tables, and ours.
const ALSO: [(&str, &str); 18] = [
    ("freq", "frequency"),
    ("frequencies", "frequency"),
    ("natural_frequency", "frequency"),
    ("damped_frequency", "frequency"),
    ("mode_number", "mode"),
    ("mode_no", "mode"),
    ("mode_no.", "mode"),
    ("no.", "mode"),
    ("zeta", "damping_ratio"),
    ("position", "x"),
    ("place", "x"),
    ("location", "x"),
    ("distance", "x"),
    ("station", "x"),
    ("outer_diameter", "diameter"),
    ("outside_diameter", "diameter"),
    ("wall", "wall_thickness"),
    ("time", "t"),
];

/// The name of a column as this program writes it, `frequency_hz` for `Frequency (Hz)` or `Frequency [Hz]`.
pub(crate) fn name(cell: &str) -> String {
    let lower = cell.trim().to_lowercase();
    let opened = lower.find(['(', '[']).filter(|_| lower.ends_with([')', ']']));
    let (stem, unit) = match opened {
        Some(at) => (&lower[..at], lower[at + 1..lower.len() - 1].trim()),
        None => (&lower[..], ""),
    };
    let stem = stem.split_whitespace().collect::<Vec<_>>().join("_");
    let stem = ALSO.iter().find(|(word, _)| *word == stem).map_or(&*stem, |(_, ours)| ours);
    match unit {
        "" | "-" | "1" => stem.to_owned(),
        "%" | "percent" => format!("{stem}_percent"),
        "inch" | "inches" | "\"" => format!("{stem}_in"),
        unit => format!("{stem}_{unit}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_other_programs_are_ours() {
        for (theirs, ours) in [
            ("Frequency (Hz)", "frequency_hz"),
            ("DAMPING [%]", "damping_percent"),
            ("Outer diameter (in)", "diameter_in"),
            ("Position [mm]", "x_mm"),
            ("Mode", "mode"),
            ("mode_1", "mode_1"),
            ("x_in", "x_in"),
        ] {
            assert_eq!(name(theirs), ours);
        }
    }

    #[test]
    fn a_number_is_read_in_the_one_way_that_it_can_be() {
        let european = Sheet::of("mode;frequency_hz\n1;174,51\n");
        for (text, value) in
            [("174,51", 174.51), ("1.187,04", 1187.04), ("3 1/2", 3.5), ("1e3", 1e3), ("0,838", 0.838)]
        {
            assert_eq!(european.number(text), Ok(value), "{text}");
        }
        let american = Sheet::of("mode,frequency_hz\n1,174\n");
        assert_eq!(american.number("174,51"), Ok(174.51));
        assert!(american.number("1,234").is_err() && american.number("n/a").is_err());
        // With points elsewhere a comma is no decimal one.
        let mixed = Sheet::of("mode;frequency_hz\n1;174.5\n2;581,3\n");
        assert!(mixed.number("581,3").is_err());
        assert!(american.number("nan").is_err() && american.number("inf").is_err());
    }

    #[test]
    fn what_stands_between_cells_is_told_or_seen() {
        for (text, by) in [
            ("a;b,c;d\n", b';'),
            ("a\tb\n", b'\t'),
            ("Frequency (Hz; damped),b\n", b','),
            ("sep=;\na,b;c\n", b';'),
            ("alone\n", b','),
        ] {
            assert_eq!(Sheet::of(text).between, by, "{text}");
        }
    }
}
