//! What a report is put together from, whatever it is written as: parts, and sections of them.

use crate::parts::input::Input;
use crate::parts::table::Table;

/// A part of the report under a heading.
#[derive(Debug, Clone)]
pub struct Section<'a> {
    /// What links call it.
    pub id: &'static str,
    /// The heading as people read it.
    pub title: &'static str,
    /// Whether a page shows it before it is asked for.
    pub fold: Fold,
    /// What stands under it, from top to bottom.
    pub parts: Vec<Part<'a>>,
}

/// What a page shows of a section.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fold {
    /// All of it.
    Open,
    /// Its heading, which opens it; on paper all of it.
    Folded,
    /// Its heading, which opens it; on paper nothing.
    ScreenOnly,
}

/// What stands in a section.
#[derive(Debug, Clone)]
pub enum Part<'a> {
    /// A heading of second order.
    Heading(&'static str),
    /// A paragraph.
    Text(String),
    /// What there is not, and why.
    Missing(&'static str),
    /// One line for each item.
    List(Vec<String>),
    /// Numbers that stand out, and what a page calls that kind.
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
    /// What moves or sounds, where there is a script: HTML.
    Moving(String),
}

/// One number with its unit, and what it is.
#[derive(Debug, Clone, PartialEq)]
pub struct Fact {
    /// What it is called in the page's data.
    pub key: &'static str,
    /// What people call it.
    pub label: &'static str,
    /// The number with its unit.
    pub value: String,
    /// A word more; may be empty.
    pub note: String,
}
