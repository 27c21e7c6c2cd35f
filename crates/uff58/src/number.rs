//! Numbers as Fortran writes and reads them.

/// A number with `decimals` digits after the point and its exponent after `letter`, as in FORMAT `1PEw.d` and `1PDw.d`:
/// `-1.23450E-03`. Numbers below 1e-99 become 0, because their exponents would need a third digit, which old readers do
/// not know.
pub fn scientific(value: f64, decimals: usize, letter: char) -> String {
    let value = if value.abs() < 1e-99 { 0.0 } else { value };
    let text = format!("{value:.decimals$e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let (sign, exponent) = match exponent.strip_prefix('-') {
        Some(exponent) => ('-', exponent),
        None => ('+', exponent),
    };
    format!("{mantissa}{letter}{sign}{exponent:0>2}")
}

/// A finite number as Fortran may have written it: `1.5`, `-.5E+02`, `1.5D-3`, `1.5d-3`, and
/// `1.5-100` for an exponent of three digits.
pub fn real(text: &str) -> Option<f64> {
    let text = text.trim();
    let plain =
        |c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.' | 'e' | 'E' | 'd' | 'D');
    if text.is_empty() || !text.chars().all(plain) {
        return None;
    }
    let text = text.replace(['d', 'D'], "e");
    let value: f64 = text.parse().ok().or_else(|| without_letter(&text))?;
    // A zero may have come with a sign.
    value.is_finite().then_some(value + 0.0)
}

/// An exponent of three digits leaves no room for its letter.
fn without_letter(text: &str) -> Option<f64> {
    let (mantissa, digits) = text.split_at_checked(text.len().checked_sub(4)?)?;
    let exponent =
        digits.starts_with(['+', '-']) && digits[1..].bytes().all(|b| b.is_ascii_digit());
    let bare = mantissa.ends_with(|c: char| c.is_ascii_digit() || c == '.');
    if !exponent || !bare || mantissa.contains(['e', 'E']) {
        return None;
    }
    format!("{mantissa}e{digits}").parse().ok()
}

/// A whole number; some programs write it as `3.` or `3.0`.
pub fn whole(text: &str) -> Option<i64> {
    let text = text.trim();
    text.parse().ok().or_else(|| {
        let value = real(text)?;
        // Up to 2^53 every whole number is a number of the machine.
        (value.fract() == 0.0 && value.abs() < 9.0e15).then_some(value as i64)
    })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn numbers_are_those_of_fortran() {
        assert_eq!(scientific(-0.0012345, 5, 'E'), "-1.23450E-03");
        assert_eq!(scientific(1.0, 17, 'D'), "1.00000000000000000D+00");
        assert_eq!(scientific(0.0, 5, 'E'), "0.00000E+00");
        assert_eq!(scientific(1e-120, 5, 'E'), "0.00000E+00");
        assert_eq!(scientific(-2.5e123, 5, 'E'), "-2.50000E+123");
        for (text, value) in [
            ("1.5", 1.5),
            (" -.5E+02 ", -50.0),
            ("1.5D-3", 1.5e-3),
            ("1.5d+3", 1.5e3),
            ("1.5-100", 1.5e-100),
            ("-1.+100", -1e100),
            ("3", 3.0),
        ] {
            assert_eq!(real(text), Some(value), "{text}");
        }
        for text in
            ["", "nan", "inf", "1e999", "1.5-10", "1.5E+001.5", "1 2", "--1", "0x1", "1.5_0"]
        {
            assert_eq!(real(text), None, "{text}");
        }
        assert_eq!(whole(" 12 "), Some(12));
        assert_eq!(whole("12.0"), Some(12));
        assert_eq!(whole("1.5"), None);
    }

    proptest! {
        #[test]
        fn a_number_is_read_back_to_its_digits(value in proptest::num::f64::NORMAL) {
            prop_assume!(value.abs() > 1e-98);
            for (decimals, letter) in [(5, 'E'), (12, 'E'), (16, 'D'), (17, 'D')] {
                let text = scientific(value, decimals, letter);
                let half = 0.500001 * 10f64.powi(-(decimals as i32));
                let back = real(&text);
                if let Some(back) = back {
                    prop_assert!((back / value - 1.0).abs() <= half.max(1e-16), "{text}");
                } else {
                    // Rounded up beyond the largest number.
                    prop_assert!(value.abs() > 1.79e308);
                }
                if decimals > 15 {
                    prop_assert_eq!(back, Some(value));
                }
                // It fits a field of 13, 20 or 25 columns.
                prop_assert!(text.len() <= decimals + 8);
                let six = crate::six_digits(value);
                prop_assert!(decimals != 5 || back.is_none_or(|back| back == six));
            }
        }

        #[test]
        fn no_text_is_a_number_that_is_none(text in "[-+0-9.eEdD ]{0,14}") {
            prop_assert!(real(&text).is_none_or(f64::is_finite));
            let _ = whole(&text);
        }
    }
}
