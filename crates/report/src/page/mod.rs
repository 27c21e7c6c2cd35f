//! The report: everything about a bat on one page, for those who make or swing it.
//!
//! What it says of one bat ([`content`]) or of several ([`compared`]) is a list of [parts](crate::parts),
//! the same whether it is written as a page ([`html`]) or as Markdown ([`markdown`]). The page is one file that
//! fetches nothing and is told in both systems of units; what moves on it is drawn by its own script
//! from the numbers in [`data`], and all the rest is there without.

pub mod shown;
pub mod summary;
pub mod tables;
pub mod accuracy;
pub mod inputs;
pub mod moment;
pub mod barrel;
pub mod data;
pub mod players;
pub mod figure;
pub mod html;
pub mod content;
pub mod compared;
pub mod markdown;
pub mod file;
