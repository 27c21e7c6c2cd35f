//! Text as XML has it.

/// The text between tags and in quoted attributes; control characters, which XML cannot hold, become
/// blanks.
pub fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out += "&amp;",
            '<' => out += "&lt;",
            '>' => out += "&gt;",
            '"' => out += "&quot;",
            c if c.is_control() || matches!(c, '\u{FFFE}' | '\u{FFFF}') => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_are_named_and_what_xml_cannot_hold_is_blank() {
        assert_eq!(escaped("a<b & \u{1}\"c\""), "a&lt;b &amp;  &quot;c&quot;");
    }
}
