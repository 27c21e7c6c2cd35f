//! How is text that is not JSON reported?

use serde::de::IgnoredAny;

use crate::base::{Complaint, Error, shortened};
use crate::files::document::Document;

/// The error for text that does not begin like a JSON object.
pub(crate) fn not_an_object(document: &Document) -> Error {
    let text = document.text.trim();
    let complaint = match serde_json::from_str::<IgnoredAny>(text) {
        Ok(_) => Complaint::new("", "a text alone", "an object { … }"),
        Err(error) if error.is_eof() && text.starts_with('[') => {
            let found = "the end of the file";
            Complaint::new("", found, "the rest of a list").hinted(unclosed("a list"))
        }
        Err(_) => {
            let hint = "YAML, TOML and tables are other formats: write { \"name\": value, … }";
            Complaint::new("", "text that is not JSON", "`{`, with which a JSON object begins")
                .hinted(hint)
        }
    };
    let start = document.text.len() - document.text.trim_start().len();
    let first = document.text[start..].chars().next().map_or(0, char::len_utf8);
    document.error(start..start + first, complaint)
}

/// The message of `serde_json` for text that is not JSON, as found and expected, with its place.
pub(crate) fn told(document: &Document, error: &serde_json::Error) -> Error {
    let text = &document.text;
    let line = text.split_inclusive('\n').take(error.line().saturating_sub(1));
    let offset = line.map(str::len).sum::<usize>() + error.column().saturating_sub(1);
    let said = error.to_string();
    let said = said.split(" at line ").next().unwrap_or_default();
    // For these, the character before is reported.
    let control = said.starts_with("control character");
    let offset = offset + usize::from(control);
    let mut offset = if error.is_eof() { text.trim_end().len() } else { offset.min(text.len()) };
    while !text.is_char_boundary(offset) {
        offset -= 1;
    }
    let here = word(&text[offset..]);
    let complaint = match said.strip_prefix("expected ") {
        _ if error.is_eof() => {
            let rest = said.strip_prefix("EOF while parsing ").unwrap_or("the text");
            let complaint =
                Complaint::new("", "the end of the file", format!("the rest of {rest}"));
            return document.error(offset..offset, complaint.hinted(unclosed(rest)));
        }
        Some("value") => {
            let expected = "a JSON value (and numbers as in 0.5 or -1e3)";
            Complaint::new("", shortened(here, 20), expected)
        }
        Some(expected) => Complaint::new("", shortened(here, 20), expected),
        None if control => {
            let hint = "a text stands on one line; write \\n for a line break and \\t for a tab";
            let found = match text[offset..].chars().next() {
                Some('\t') => "a tab in a text",
                Some('\n' | '\r') => "a line break in a text",
                _ => "a control character in a text",
            };
            let complaint = Complaint::new("", found, "letters, or a closing quote").hinted(hint);
            return document.error(offset..offset + 1, complaint);
        }
        None if said == "trailing characters" => {
            Complaint::new("", shortened(here, 20), "the end of the file")
        }
        None => Complaint::new("", format!("broken JSON, {said}"), "JSON"),
    };
    document
        .error(offset..offset + here.len(), complaint.hinted(mended(&text[..offset], said, here)))
}

/// The word at the beginning of a text, or the single character that ends words.
fn word(text: &str) -> &str {
    let ends = |c: char| c.is_whitespace() || ",:[]{}".contains(c);
    let one = text.chars().next().map_or(0, char::len_utf8);
    &text[..text.find(ends).unwrap_or(text.len()).max(one)]
}

/// What is missing at the end of a file.
fn unclosed(rest: &str) -> &'static str {
    match rest {
        "an object" => "a closing } is missing",
        "a list" => "a closing ] is missing",
        "a string" => "a closing quote is missing",
        _ => "",
    }
}

/// Advice for the commonest slips in JSON, from the text before, the message, and the text here.
fn mended(before: &str, said: &str, here: &str) -> &'static str {
    let after_comma = before.trim_end().ends_with(',');
    match here.chars().next() {
        Some('/' | '#') => "JSON has no comments: write them as \"comment\": \"…\"",
        Some('\'') => "texts stand in double quotes",
        Some('"') if said.starts_with("expected `,`") => "is a comma missing before it?",
        Some(']' | '}') if after_comma => "no comma follows the last one of a list or an object",
        Some(',') if after_comma => "one comma is enough",
        _ if said == "key must be a string" => "keys stand in double quotes",
        _ => "",
    }
}

#[cfg(test)]
mod tests {
    use serde_json::value::RawValue;

    use super::*;

    #[test]
    fn broken_json_is_placed_where_it_breaks() {
        let error = |text| serde_json::from_str::<&RawValue>(text).unwrap_err();
        for (text, says) in [
            ("{\n \"a\": 1,,\n}", &["f:2:9: ", "one comma is enough"][..]),
            ("{\n \"a\": 1\n \"b\": 2\n}", &["f:3:2: found \"b\"", "a comma missing before"]),
            ("{ \"a\": [1, 2,] }", &["f:1:14: found ]", "no comma follows"]),
            ("{ \"a\": 1, }", &["f:1:11: ", "no comma follows"]),
            ("{ a: 1 }", &["f:1:3: ", "keys stand in double quotes"]),
            ("{ \"a\": }", &["f:1:8: found }, expected a JSON value"]),
            ("{ // a bat\n}", &["f:1:3: ", "JSON has no comments", "\"comment\""]),
            ("{ \"a\": 'b' }", &["f:1:8: found 'b'", "double quotes"]),
            ("{ \"a\": [1, 2", &["f:1:13: found the end of the file", "a closing ]"]),
            ("{ \"a\": \u{a0}1 }", &["f:1:8: found \u{a0}"]),
        ] {
            let document = Document::new("f".into(), text);
            let said = told(&document, &error(text)).to_string();
            assert!(says.iter().all(|words| said.contains(words)), "{said}");
        }
    }
}
