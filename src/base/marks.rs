//! Which characters act on the program that shows them, and how are they written out?
//!
//! A name may come from a stranger's file. Control characters act on a terminal, direction marks change the order in
//! which a line is read, and a spreadsheet evaluates a text that begins like a formula.

/// Marks that reverse the direction of the text after them and could disguise a name or a number.
pub fn is_bidi(c: char) -> bool {
    matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// Whether a character acts on the program that shows it: controls, marks of direction, line ends.
fn acts(c: char) -> bool {
    c.is_control()
        || is_bidi(c)
        || matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}' | '\u{2029}')
}

/// The text as one line that is safe to show in a terminal.
pub fn written_out(text: &str) -> String {
    let written = |c: char| if acts(c) { c.escape_default().to_string() } else { c.into() };
    text.chars().map(written).collect()
}

/// Equivalent JSON, with an escape `\u` for each character in its texts that acts on a terminal.
pub fn json(text: &str) -> String {
    let written = |c: char| match acts(c) && !c.is_ascii_whitespace() {
        true => format!("\\u{:04x}", u32::from(c)),
        false => c.into(),
    };
    text.chars().map(written).collect()
}

/// Whether a spreadsheet may take a text for a formula; leading apostrophes are skipped.
fn is_formula(text: &str) -> bool {
    const BEGINS: [char; 9] = ['=', '+', '-', '@', '\t', '＝', '＋', '－', '＠'];
    let text = text.trim_start_matches('\'');
    // A carriage return comes here already written out.
    text.starts_with(BEGINS) || text.starts_with("\\r")
}

/// A text as a cell of a table for spreadsheets. A text that could be a formula, or that begins with apostrophes before
/// one, gets one apostrophe more. Controls except tabs are written out.
pub fn cell(text: &str) -> String {
    let text: Vec<String> = text.split('\t').map(written_out).collect();
    let text = text.join("\t");
    if is_formula(&text) { format!("'{text}") } else { text }
}

/// The text of a cell, without the apostrophe that [`cell`] has put before it.
pub fn of_cell(cell: &str) -> &str {
    let text = cell.strip_prefix('\'').filter(|text| is_formula(text));
    text.unwrap_or(cell)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cell_reads_back_and_is_no_formula() {
        for text in [
            "=1+1", "+1", "-1", "@SUM(A1)", "\t=1", "'=1", "''-x", "'", "''", "'plain", "it's", "",
            "plain", "1-2", " =1", "＝1", "\\r", "'\\r",
        ] {
            let written = cell(text);
            assert!(!written.starts_with(['=', '+', '-', '@', '\t', '＝']), "{written}");
            assert_eq!(of_cell(&written), text);
        }
        assert_eq!(cell("=1"), "'=1");
        assert_eq!(cell("'=1"), "''=1");
        assert_eq!(cell("it's"), "it's");
        assert_eq!(cell("\r=1"), "'\\r=1");
        assert_eq!(cell("\u{1b}[31m\n\u{202e}"), "\\u{1b}[31m\\n\\u{202e}");
    }

    #[test]
    fn json_stays_the_same_document() {
        let text = "{\n  \"a\": \"é\u{202e}\u{9b}\u{7f}\u{200f}黒\"\n}\n";
        let written = json(text);
        assert_eq!(written, "{\n  \"a\": \"é\\u202e\\u009b\\u007f\\u200f黒\"\n}\n");
        let read = |text: &str| serde_json::from_str::<serde_json::Value>(text).unwrap();
        assert_eq!(read(&written), read(text));
    }
}
