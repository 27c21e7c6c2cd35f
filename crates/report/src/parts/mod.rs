//! What is a report made of, and how is it written?
//!
//! A report is a list of [`part`]s: headings, sentences, facts, files of the user ([`input`]), and [`table`]s of columns
//! that say of a row what they hold ([`cell`]) and in which [`units`]. It is said once and written by a syntax:
//! [`terminal`] with its [`columns`], the page's HTML and Markdown ([`crate::page`], their signs by [`escape`]), CSV
//! ([`crate::csv`]). A frequency may be said as a [`note`].

pub mod escape;
pub mod units;
pub mod note;
pub mod cell;
pub mod table;
pub mod input;
pub mod part;
pub mod columns;
pub mod terminal;
