//! Words in a picture: their type and their width.

use crate::plot::theme::{Ink, MUTED, TEXT};

/// The end of a text that is at its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// The left end.
    Start,
    /// Neither: their middle.
    Middle,
    /// The right one.
    End,
}

/// Type of words.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Type {
    /// Colour of the words.
    pub ink: Ink,
    /// Height of the letters (px).
    pub size: f64,
    /// Whether the words are bold.
    pub bold: bool,
    /// The end of the words that is at their place.
    pub anchor: Anchor,
    /// Whether the words run upwards.
    pub upwards: bool,
}

/// Numbers at ticks, names of curves.
pub const LABEL: Type =
    Type { ink: TEXT, size: 12.5, bold: false, anchor: Anchor::Start, upwards: false };
/// Muted words.
pub const SMALL: Type = Type { ink: MUTED, ..LABEL };
/// The first line of a picture.
pub const TITLE: Type = Type { size: 20.0, bold: true, ..LABEL };

impl Type {
    /// This type with `anchor`, the end of the words that is at their place.
    pub const fn at(self, anchor: Anchor) -> Self {
        Self { anchor, ..self }
    }

    /// This type in that colour.
    pub const fn ink(self, ink: Ink) -> Self {
        Self { ink, ..self }
    }

    /// This type in that size (pixels).
    pub const fn sized(self, size: f64) -> Self {
        Self { size, ..self }
    }
}

/// Upper limit of the width of words (px), in the widest of the usual sans-serif fonts.
pub fn width(words: &str, look: Type) -> f64 {
    let em = |c: char| match c {
        'i' | 'j' | 'l' | '.' | ',' | ' ' | '\'' | '|' | ':' | ';' | 'I' | '·' => 0.34,
        'f' | 't' | 'r' | '(' | ')' | '-' | '/' => 0.42,
        'm' | 'w' | 'M' | 'W' | '%' | '@' | '–' | '…' => 1.0,
        'A'..='Z' | '=' | '+' | '−' | '×' | '±' | '<' | '>' => 0.8,
        c if c.is_ascii() || c < '\u{2000}' => 0.64,
        _ => 1.0,
    };
    let bold = if look.bold { 1.12 } else { 1.0 };
    words.chars().map(em).sum::<f64>() * look.size * bold
}

/// Words shortened to that width (px).
pub fn fitted(words: &str, look: Type, most: f64) -> String {
    if width(words, look) <= most {
        return words.to_owned();
    }
    let mut room = most - width("…", look);
    let mut buffer = [0; 4];
    let fits = words.chars().take_while(|c| {
        room -= width(c.encode_utf8(&mut buffer), look);
        room >= 0.0
    });
    fits.collect::<String>().trim_end().to_owned() + "…"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_that_are_too_wide_are_cut() {
        let cut = fitted("a very long name of a bat", LABEL, 80.0);
        assert!(cut.ends_with('…') && width(&cut, LABEL) <= 80.0, "{cut}");
        assert_eq!(fitted("short", LABEL, 80.0), "short");
        assert_eq!(fitted("wide", LABEL, 0.0), "…");
    }
}
