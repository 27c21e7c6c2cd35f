//! How are many bats kept?
//!
//! | file | question |
//! |---|---|
//! | [`source`] | which files is a study made from |
//! | [`folder`] | where do the rows go, and which of them are there |
//! | [`table`] | which numbers are in them |
//! | [`summary`] | what do they come to, on one screen |

pub mod source;
pub mod folder;
pub mod table;
pub mod summary;
