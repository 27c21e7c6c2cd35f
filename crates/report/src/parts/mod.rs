//! What is a report made of, and how is it written?
//!
//! A report is a list of [`part`]s: headings, sentences, facts, files of the user ([`input`]), and [`table`]s, whose
//! columns extract the cells of a row ([`cell`]) and show them in [`units`]. The content is defined once and written in
//! several formats: for a [`terminal`] with its [`columns`], as HTML and Markdown for the page ([`crate::page`], with
//! [`escape`] and its numbers [`mod@typeset`]), as CSV ([`crate::csv`]). A frequency may be shown as a [`note`].

pub mod escape;
pub mod typeset;
pub mod units;
pub mod note;
pub mod cell;
pub mod table;
pub mod input;
pub mod part;
pub mod columns;
pub mod terminal;

pub use cell::{Cell, Quantity, Scale, fixed, in_trade};
pub use columns::{Columns, Shown, WIDE, first, labels, numbers, table as lines};
pub use input::Input;
pub use part::{Fact, Fold, Part, Section};
pub use table::{Column, Table};
pub use terminal::{LINES, MANY, Piece, Screen, wrapped};
pub use typeset::{counted, sentence, typeset};
pub use units::Units;
