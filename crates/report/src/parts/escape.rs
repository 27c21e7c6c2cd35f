//! Escapes text so that a page shows it unchanged.

use sweetspot::base::marks::is_bidi;
use sweetspot::base::xml::put;

/// For HTML, between tags and within quoted attributes. Characters that are forbidden in a page become the replacement
/// character.
pub fn html(text: &str) -> String {
    let mut out = String::with_capacity(text.len() + text.len() / 8);
    for c in text.chars() {
        match c {
            '\'' => out += "&#39;",
            '\n' | '\t' => out.push(c),
            '\r' => {}
            c if c.is_control() || is_bidi(c) => out.push('\u{fffd}'),
            c => put(&mut out, c),
        }
    }
    out
}

/// For JSON within a script element, so that nothing in it can end the element or open a comment.
pub fn script(json: &str) -> String {
    json.replace('<', "\\u003c").replace('>', "\\u003e").replace('&', "\\u0026")
}

/// For a line of Markdown, tables included: every sign that could mean something is escaped.
pub fn markdown(text: &str) -> String {
    const MEANING: &str = "\\`*_[]<>|~$&";
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            c if c.is_control() => out.push(' '),
            c if is_bidi(c) => out.push('\u{fffd}'),
            c if MEANING.contains(c) => out.extend(['\\', c]),
            c => out.push(c),
        }
    }
    out
}

/// For the beginning of a line of Markdown, where the signs of headings and lists are escaped too.
pub fn markdown_line(text: &str) -> String {
    let digits = text.bytes().take_while(u8::is_ascii_digit).count();
    let (first, rest) = text.split_at(digits);
    let signs: &[char] = if digits > 0 { &['.', ')'] } else { &['#', '+', '-', '=', ':'] };
    let mark = if rest.starts_with(signs) { "\\" } else { "" };
    format!("{first}{mark}{}", markdown(rest))
}

/// A fence of backticks that the text does not hold.
pub fn fence(text: &str) -> String {
    let mut longest = 0;
    let mut run = 0;
    for c in text.chars() {
        run = if c == '`' { run + 1 } else { 0 };
        longest = longest.max(run);
    }
    "`".repeat(3.max(longest + 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_of_a_text_is_a_tag_an_entity_or_the_end_of_an_attribute() {
        let told = html("</script><b a=\"x\" c='y'>&amp;\u{0}\u{202e}\r\n");
        assert_eq!(
            told,
            "&lt;/script&gt;&lt;b a=&quot;x&quot; c=&#39;y&#39;&gt;&amp;amp;\u{fffd}\u{fffd}\n"
        );
    }

    #[test]
    fn escaped_json_is_the_same_json() {
        let value = serde_json::json!({ "a": "</script><!--&" });
        let told = script(&value.to_string());
        assert!(!told.contains(['<', '>', '&']));
        assert_eq!(serde_json::from_str::<serde_json::Value>(&told).unwrap(), value);
    }

    #[test]
    fn a_line_of_markdown_stays_one_and_a_fence_is_longer_than_any_within() {
        assert_eq!(markdown("a|b\n*c*"), "a\\|b \\*c\\*");
        assert_eq!(markdown_line("# a (b) + 1"), "\\# a (b) + 1");
        assert_eq!(markdown_line("12. a"), "12\\. a");
        assert_eq!(markdown_line("12 a"), "12 a");
        assert_eq!(markdown("<b>![x](y)"), "\\<b\\>!\\[x\\](y)");
        assert_eq!(fence("none"), "```");
        assert_eq!(fence("a ```` b"), "`````");
    }
}
