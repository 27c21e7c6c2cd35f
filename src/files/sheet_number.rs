//! Which number is in a cell of a table, and which decimal sign does it use?

use crate::base::{Complaint, typed};

/// The decimal sign.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Decimal {
    Point,
    Comma,
}

impl Decimal {
    fn sign(self) -> char {
        if self == Self::Point { '.' } else { ',' }
    }

    fn other(self) -> Self {
        if self == Self::Point { Self::Comma } else { Self::Point }
    }
}

/// The decimal sign of an unambiguous number; `None` for whole numbers, for `1,234` and `1.234`, and for text.
pub(crate) fn certain(cell: &str) -> Option<Decimal> {
    let can = |sign: Decimal| decimal(cell, sign).is_some();
    if !cell.contains(['.', ',']) {
        return None;
    }
    match [Decimal::Point, Decimal::Comma].map(can) {
        [true, false] => Some(Decimal::Point),
        [false, true] => Some(Decimal::Comma),
        _ => None,
    }
}

/// The value of a cell in a table with that decimal sign.
///
/// # Errors
///
/// What was found and what was expected, without a field.
pub(crate) fn value(cell: &str, sign: Decimal) -> Result<f64, Complaint> {
    let (read, other) = (decimal(cell, sign), decimal(cell, sign.other()));
    let found = format!("\"{cell}\"");
    match (read, other) {
        // A single sign of the other kind before three digits separates thousands, or is a slip.
        (Some(whole), Some(small)) if cell.contains(sign.other().sign()) && whole != small => {
            let wrong = Complaint::new("", found, "a number that can be read in one way");
            Err(wrong.hinted(format!("it may be {small} or {whole}: write it as it is meant")))
        }
        (Some(value), _) if value.is_finite() => Ok(value + 0.0),
        _ => fraction(cell).ok_or_else(|| {
            let wrong = Complaint::new("", found, "a finite number (the unit stands in the header)");
            let date = "that looks like a date, which spreadsheets make of 3/8: type 0.375, or give the \
                        cells the format of text";
            if like_a_date(cell) { wrong.hinted(date) } else { wrong }
        }),
    }
}

/// A number with that decimal sign; the other one, a space or an apostrophe may separate thousands.
fn decimal(cell: &str, sign: Decimal) -> Option<f64> {
    let text = cell.replace(['−', '–'], "-");
    let end = text.find(['e', 'E']).unwrap_or(text.len());
    let (mantissa, exponent) = text.split_at(end);
    let digits = mantissa.strip_prefix(['-', '+']).unwrap_or(mantissa);
    let (whole, part) = digits.split_once(sign.sign()).unwrap_or((digits, ""));
    let all_digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    let apart = [sign.other().sign(), ' ', '\u{a0}', '\u{202f}', '\u{2009}', '\'', '’'];
    let whole = match whole.find(apart).and_then(|at| whole[at..].chars().next()) {
        None => whole.to_owned(),
        Some(apart) => {
            let mut groups = whole.split(apart);
            let first = groups.next().unwrap_or_default();
            let begins = (1..=3).contains(&first.len()) && !first.starts_with('0');
            let ok = begins && groups.all(|group| group.len() == 3);
            ok.then(|| whole.replace(apart, ""))?
        }
    };
    if !all_digits(&whole) || !all_digits(part) || (whole.is_empty() && part.is_empty()) {
        return None;
    }
    let minus = if mantissa.starts_with('-') { "-" } else { "" };
    format!("{minus}{whole}.{part}{exponent}").parse().ok()
}

/// A fraction of an inch rule, `3 1/2` or `5/8`: halves to 128ths.
fn fraction(cell: &str) -> Option<f64> {
    let text = typed::plain(cell);
    let (above, below) = text.split_once('/')?;
    let above = above.rsplit([' ', '-']).next()?;
    let parts: [u32; 2] = [above.parse().ok()?, below.parse().ok()?];
    let rule = parts[1].is_power_of_two() && (2..=128).contains(&parts[1]) && parts[0] < parts[1];
    let typed = !text.contains(['.', ',']) && !above.starts_with('0') && !below.starts_with('0');
    if rule && typed { typed::mixed(&text) } else { None }
}

/// Whether a cell is a date, into which spreadsheets turn fractions.
fn like_a_date(cell: &str) -> bool {
    const MONTHS: [&str; 15] = [
        "jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec", "mai",
        "okt", "dez",
    ];
    let small = cell.to_lowercase();
    let digits = small.starts_with(|c: char| c.is_ascii_digit());
    let parts: Vec<&str> =
        small.split(['/', '.', '-', ' ']).filter(|part| !part.is_empty()).collect();
    let numbers = parts.iter().all(|part| part.bytes().all(|byte| byte.is_ascii_digit()));
    let month = parts.iter().any(|part| MONTHS.iter().any(|month| part.starts_with(month)));
    (numbers && digits && (parts.len() == 3 || small.contains('/'))) || (month && parts.len() > 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_as_programs_and_spreadsheets_write_them() {
        use Decimal::{Comma, Point};
        for (cell, sign, number) in [
            ("174.51", Point, 174.51),
            ("-.5", Point, -0.5),
            ("5.", Point, 5.0),
            ("1,187.04", Point, 1187.04),
            ("1'187.04", Point, 1187.04),
            ("1.5E+02", Point, 150.0),
            ("3 1/2", Point, 3.5),
            ("28-3/4", Comma, 28.75),
            ("2½", Point, 2.5),
            ("5/8", Comma, 0.625),
            ("174,51", Comma, 174.51),
            ("1.187,04", Comma, 1187.04),
            ("1 187,04", Comma, 1187.04),
            ("1\u{a0}187,04", Comma, 1187.04),
            ("1,187", Comma, 1.187),
            ("\u{2212}0,55", Comma, -0.55),
            ("1,5e-3", Comma, 1.5e-3),
            ("12", Comma, 12.0),
        ] {
            assert_eq!(value(cell, sign).map_err(|e| e.to_string()), Ok(number), "{cell}");
        }
    }

    #[test]
    fn what_may_be_read_in_two_ways_is_refused_with_both() {
        for (cell, sign) in [("1,234", Decimal::Point), ("1.234", Decimal::Comma)] {
            let said = format!("{:?}", value(cell, sign).unwrap_err());
            assert!(said.contains("1.234 or 1234"), "{said}");
            assert_eq!(certain(cell), None);
        }
        assert_eq!(certain("0,234"), Some(Decimal::Comma));
        assert_eq!(certain("1,187.04"), Some(Decimal::Point));
    }

    #[test]
    fn dates_and_words_are_no_numbers() {
        for cell in ["12/05/2024", "01.02.2024", "2024-02-01", "3-Feb", "Mar 08", "08/03", "12/5"] {
            let said = format!("{:?}", value(cell, Decimal::Point).unwrap_err());
            assert!(said.contains("looks like a date"), "{cell}: {said}");
        }
        for cell in ["", "nan", "inf", "1e999", "thick", "1 in", "1..2", "--1", "1e", "-"] {
            let said = format!("{:?}", value(cell, Decimal::Point).unwrap_err());
            assert!(!said.contains("date") && said.contains("a finite number"), "{cell}: {said}");
        }
    }
}
