//! The report: everything about a bat on one page, for those who make or swing it.
//!
//! Its content for one bat ([`content`]) or several ([`compared`]) is a list of [parts](crate::parts), the same for a
//! page ([`html`]) and for Markdown ([`markdown`]). The page is one file that fetches nothing and shows both systems of
//! units. Its script draws the moving parts from the numbers in [`data`]; all other parts work without the script.

pub mod summary;
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
