//! How are many bats kept?
//!
//! | file | question |
//! |---|---|
//! | [`source`] | which files is a study made from |
//! | [`sums`] | is a file what it was when it was written |
//! | [`part`] | which rows are in a part, and what does one look like |
//! | [`folder`] | where do the rows go, and which of them are there |
//! | [`fresh`] | which files of a folder have studies written |
//! | [`table`] | which numbers are in them |
//! | [`summary`] | what do they come to, on one screen |

pub mod source;
pub mod sums;
pub mod part;
pub mod folder;
pub mod fresh;
pub mod table;
pub mod summary;
