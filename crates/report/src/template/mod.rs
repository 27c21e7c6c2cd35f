//! A bat in its own size on paper, to be held against the work on the lathe.
//!
//! | file | question |
//! |---|---|
//! | [`sheet`] | what is drawn on a page, in mm; the page as SVG |
//! | [`pdf`] | the pages as one PDF |
//! | [`pages`] | the bat on as many pages as it takes, with a bar to measure the print by |

pub mod sheet;
pub mod pdf;
pub mod pages;
