//! How is text written into XML?

use crate::base::marks::is_bidi;

/// The text as XML content or as a quoted attribute. Control characters, which XML cannot hold, become blanks; marks of
/// direction become the replacement character.
pub fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            c if c.is_control() || matches!(c, '\u{FFFE}' | '\u{FFFF}') => out.push(' '),
            c if is_bidi(c) => out.push(char::REPLACEMENT_CHARACTER),
            c => put(&mut out, c),
        }
    }
    out
}

/// Adds a character, escaped if it could end a text or a quoted value.
pub fn put(out: &mut String, c: char) {
    match c {
        '&' => *out += "&amp;",
        '<' => *out += "&lt;",
        '>' => *out += "&gt;",
        '"' => *out += "&quot;",
        c => out.push(c),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_are_named_and_what_xml_cannot_hold_is_blank() {
        assert_eq!(escaped("a<b & \u{1}\"c\""), "a&lt;b &amp;  &quot;c&quot;");
        assert_eq!(escaped("1\u{202e}2\u{2066}3\u{200d}"), "1\u{fffd}2\u{fffd}3\u{200d}");
    }
}
