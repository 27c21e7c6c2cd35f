//! What does a file look like, as a JSON schema says it?
//!
//! | file | question |
//! |---|---|
//! | [`document`], [`amount`] | what every document begins with; a number that may carry its unit |
//! | [`part`], [`resolved`], [`bat`], [`ball`] | a part of a bat; as it was understood; a bat file; a ball file |

pub mod document;
pub mod amount;
pub mod part;
pub mod resolved;
pub mod bat;
pub mod ball;
