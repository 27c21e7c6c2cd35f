//! How are the results of many bats stored?
//!
//! | file | question |
//! |---|---|
//! | [`source`] | which files make up a study |
//! | [`sums`] | is a file unchanged since it was written |
//! | [`part`] | which rows are in a part, and what is its format |
//! | [`folder`] | where are the rows stored, and which of them exist |
//! | [`fresh`] | which files in a folder were written by studies |
//! | [`table`] | which numbers are in the parts |
//! | [`summary`] | what are the results, on one screen |

pub mod source;
pub mod sums;
pub mod part;
pub mod folder;
pub mod fresh;
pub mod table;
pub mod summary;
