//! Templates of a bat in full size on paper, to hold against the work on the lathe.
//!
//! | file | question |
//! |---|---|
//! | [`sheet`] | what is on a page, in mm; the page as SVG |
//! | [`pdf`] | the pages as one PDF |
//! | [`pages`] | the bat on as many pages as needed, with a bar to check the scale of the print |

pub mod sheet;
pub mod pdf;
pub mod pages;
