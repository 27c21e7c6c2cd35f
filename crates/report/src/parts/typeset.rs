//! How a page sets texts of this program: powers of ten, minus signs, sentences.

const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];

/// The text with `1e-4` as 10⁻⁴ and −3 with a minus sign.
pub fn typeset(text: &str) -> String {
    let parts = text.split_inclusive([' ', '(', ')', ',', ';', '\n']);
    let part = |part: &str| {
        let end = part.trim_end_matches([' ', '(', ')', ',', ';', '\n', '.', ':']).len();
        let (word, rest) = part.split_at(end);
        let below =
            word.strip_prefix('-').filter(|size| size.starts_with(|c: char| c.is_ascii_digit()));
        let (sign, size) = below.map_or(("", word), |size| ("−", size));
        format!("{sign}{}{rest}", power(size).unwrap_or(size.to_owned()))
    };
    parts.map(part).collect()
}

/// A number with a power of ten, `1.2 × 10⁻⁶`; None for any other word.
fn power(word: &str) -> Option<String> {
    let (mantissa, power) = word.split_once('e')?;
    let digits = |text: &str| !text.is_empty() && text.chars().all(|c| c.is_ascii_digit());
    if !mantissa.split('.').all(digits) || !digits(power.trim_start_matches('-')) {
        return None;
    }
    let raised = |c: char| c.to_digit(10).map_or('⁻', |digit| RAISED[digit as usize]);
    let mantissa = mantissa.strip_suffix(".0").unwrap_or(mantissa);
    Some(match (mantissa, power) {
        (_, "0") => mantissa.to_owned(),
        ("1", _) => format!("10{}", power.chars().map(raised).collect::<String>()),
        _ => format!("{mantissa} × 10{}", power.chars().map(raised).collect::<String>()),
    })
}

/// A text as a sentence: a capital first, a full stop last.
pub fn sentence(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|c| c.to_uppercase().to_string()).unwrap_or_default();
    let end = if text.ends_with(['.', '!', '?']) { "" } else { "." };
    format!("{first}{}{end}", letters.as_str())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_as_a_person_writes_them() {
        for (text, set) in [
            ("2e-6", "2 × 10⁻⁶"),
            ("1e-4", "10⁻⁴"),
            ("0e0", "0"),
            ("-1.00e-3", "−1.00 × 10⁻³"),
            ("1.814e10", "1.814 × 10¹⁰"),
            ("a-3, -3.5 mm, --tol", "a-3, −3.5 mm, --tol"),
            ("within 1.5e-4, x (3.0e-3 m/s) e2 2e", "within 1.5 × 10⁻⁴, x (3 × 10⁻³ m/s) e2 2e"),
        ] {
            assert_eq!(typeset(text), set);
        }
        assert_eq!(sentence("hands: none"), "Hands: none.");
    }
}
