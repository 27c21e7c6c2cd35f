//! Which numbers and units has a person typed?
//!
//! [`plain`] replaces typographic marks by letters, [`terms`] finds each number with its unit, and [`mixed`] gives the
//! value of the number. [`crate::base::units`] has the units.

/// A text prepared for parsing: quotes and primes become `in` and `ft`, printed fractions and signs become typed ones.
pub fn plain(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut letters = text.trim().chars().peekable();
    while let Some(letter) = letters.next() {
        match letter {
            '"' | '″' | '”' | '“' | '„' => out += " in ",
            // Two of them, typed one after the other, are inches.
            '\'' | '′' | '’' | '‘' => match letters.next_if(|next| *next == letter) {
                Some(_) => out += " in ",
                None => out += " ft ",
            },
            '¼' => out += " 1/4",
            '½' => out += " 1/2",
            '¾' => out += " 3/4",
            '⅛' => out += " 1/8",
            '⅜' => out += " 3/8",
            '⅝' => out += " 5/8",
            '⅞' => out += " 7/8",
            '⁄' => out.push('/'),
            '−' | '–' => out.push('-'),
            '\u{a0}' | '\u{2009}' | '\u{202f}' => out.push(' '),
            other => out.push(other),
        }
    }
    out.trim().to_owned()
}

/// The numbers of a text with their units, in order: `5 ft 2 in` has two.
pub fn terms(mut text: &str) -> Vec<(&str, &str)> {
    let mut all = vec![];
    loop {
        let (number, rest) = split(text);
        let begins = |(i, blank): (usize, &str)| {
            let next = rest[i + blank.len()..].bytes().next();
            (i > 0 && next.is_some_and(|byte| byte.is_ascii_digit())).then_some(i)
        };
        let Some(end) = rest.match_indices(' ').find_map(begins) else {
            all.push((number, rest));
            return all;
        };
        all.push((number, rest[..end].trim_end()));
        text = rest[end..].trim_start();
    }
}

/// The value of a number that [`split`] has found: `2.5`, `5/8`, `2 5/8` or `2-5/8`.
pub fn mixed(number: &str) -> Option<f64> {
    let Some((above, below)) = number.split_once('/') else { return decimal(number) };
    let joint = above.rfind([' ', '-']).filter(|i| *i > 0);
    let (whole, above) = joint.map_or(("0", above), |i| (&above[..i], &above[i + 1..]));
    let [whole, above, below] = [whole.trim_end(), above, below].map(decimal);
    let (whole, above, below) = (whole?, above?, below?);
    // No rule shows "2.5 5/8", and "-2 1/8" is ambiguous.
    (whole.fract() == 0.0 && whole >= 0.0).then_some(whole + above / below)
}

/// The value of a number with a decimal point or comma, or with commas between thousands.
fn decimal(number: &str) -> Option<f64> {
    match in_thousands(number) {
        true => number.replace(',', "").parse().ok(),
        false => number.replacen(',', ".", 1).parse().ok(),
    }
}

/// Whether the commas can separate thousands, as in `1,234` and `1,234,567.8`.
fn in_thousands(number: &str) -> bool {
    let whole = number.split(['.', 'e', 'E']).next().unwrap_or_default();
    let mut groups = whole.trim_start_matches(['+', '-']).split(',');
    let first = groups.next().unwrap_or_default();
    let begins = (1..=3).contains(&first.len()) && !first.starts_with('0');
    begins && groups.all(|group| group.len() == 3)
}

/// Both readings of a number with one comma: a decimal comma, or a separator of thousands.
pub fn readings(number: &str) -> Option<[String; 2]> {
    let two = in_thousands(number) && number.matches(',').count() == 1 && !number.contains('.');
    two.then(|| [".", ""].map(|comma| number.replace(',', comma)))
}

/// Splits a number from the unit after it.
pub fn split(text: &str) -> (&str, &str) {
    let bytes = text.as_bytes();
    let digit = |i: usize| bytes.get(i).is_some_and(u8::is_ascii_digit);
    let digits = |mut i: usize| {
        while digit(i)
            || bytes.get(i) == Some(&b'.')
            || (bytes.get(i) == Some(&b',') && digit(i + 1))
        {
            i += 1;
        }
        i
    };
    let blanks = |i: usize| i + text[i..].bytes().take_while(|byte| *byte == b' ').count();
    let sign = |i: usize| i + usize::from(matches!(bytes.get(i), Some(b'+' | b'-')));
    let mut end = digits(sign(0));
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let exponent = digits(sign(end + 1));
        if exponent > sign(end + 1) {
            end = exponent;
        }
    }
    // The fraction of an inch rule, after whole inches or alone.
    let above = match bytes.get(end) {
        Some(b'/') => end,
        Some(b'-') => digits(end + 1),
        _ => digits(blanks(end)),
    };
    if bytes.get(above) == Some(&b'/') && digits(above + 1) > above + 1 {
        end = digits(above + 1);
    }
    (&text[..end], text[end..].trim())
}

/// The value of a text that is one finite number, such as `33.5` or `33,5`; `None` for any other text, also for
/// `1,234`, which has two readings.
pub fn number(text: &str) -> Option<f64> {
    let text = text.trim();
    let value = if readings(text).is_some() { None } else { decimal(text) };
    value.filter(|value| value.is_finite()).map(|value| value + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_and_printed_fractions_become_letters() {
        for (text, typed) in [
            ("5\u{2019} 2½\u{201d}", "5 ft  2 1/2 in"),
            ("28''", "28 in"),
            ("\u{2212}3.5\u{a0}mm", "-3.5 mm"),
        ] {
            assert_eq!(plain(text), typed);
        }
    }

    #[test]
    fn numbers_are_parted_from_their_units() {
        assert_eq!(terms("1 lb 14 1/2 oz"), [("1", "lb"), ("14 1/2", "oz")]);
        assert_eq!(terms("4e5 N/m^2"), [("4e5", "N/m^2")]);
        assert_eq!(terms("in"), [("", "in")]);
        // Only a number begins the next part.
        assert_eq!(terms("5 ft lb"), [("5", "ft lb")]);
        assert_eq!(split("33-1/2in"), ("33-1/2", "in"));
        assert_eq!(split("-5"), ("-5", ""));
    }

    #[test]
    fn a_fraction_s_parts_are_whole_and_a_comma_is_decimal_or_between_thousands() {
        for (number, value) in [("5/8", 0.625), ("2-5/8", 2.625), ("2 5/8", 2.625), ("33,5", 33.5)]
        {
            assert_eq!(mixed(number), Some(value), "{number}");
        }
        assert_eq!(mixed("1,234,567.5"), Some(1_234_567.5));
        assert_eq!([mixed("2.5 5/8"), mixed("-2 1/8"), mixed("12,34,5")], [None; 3]);
        assert_eq!(readings("1,234"), Some(["1.234".to_owned(), "1234".to_owned()]));
        assert_eq!(number("1,234"), None);
    }
}
