//! The elements of a report, independent of its format: parts, and sections of them.

use crate::parts::input::Input;
use crate::parts::table::Table;

/// A part of the report under a heading.
#[derive(Debug, Clone)]
pub struct Section<'a> {
    /// Its name in links.
    pub id: &'static str,
    /// The heading as people read it.
    pub title: &'static str,
    /// Whether a page shows it unfolded.
    pub fold: Fold,
    /// Its content, from top to bottom.
    pub parts: Vec<Part<'a>>,
}

/// How a page shows a section.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fold {
    /// Unfolded.
    Open,
    /// Folded under its heading; unfolded on paper.
    Folded,
    /// Folded under its heading; omitted on paper.
    ScreenOnly,
}

/// The content of a section.
#[derive(Debug, Clone)]
pub enum Part<'a> {
    /// A heading of second order.
    Heading(&'static str),
    /// A paragraph.
    Text(String),
    /// What is missing, and the reason.
    Missing(&'static str),
    /// One line for each item.
    List(Vec<String>),
    /// Prominent numbers, and the class of such numbers on a page.
    Facts(&'static str, Vec<Fact>),
    /// Numbers or words in rows.
    Table(Table),
    /// A drawing with its caption, by its name.
    Picture(&'static str),
    /// A picture of something along the barrel, which a script can read off place by place.
    Hovered(&'static str),
    /// How the report was made.
    Command(&'a str),
    /// A file of the user's.
    File(&'a Input),
    /// Something long under a line that opens it.
    Folded(&'static str, Vec<Part<'a>>),
    /// HTML of a part that moves or sounds, where there is a script.
    Moving(String),
}

/// One number with its unit and label.
#[derive(Debug, Clone, PartialEq)]
pub struct Fact {
    /// Its name in the data of the page.
    pub key: &'static str,
    /// Its label for people.
    pub label: &'static str,
    /// The number with its unit.
    pub value: String,
    /// A word more; may be empty.
    pub note: String,
}
