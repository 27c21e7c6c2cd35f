//! What form does a file have, as a JSON schema?
//!
//! | file | question |
//! |---|---|
//! | [`document`], [`amount`] | the common beginning of documents; a number that may carry its unit |
//! | [`part`], [`resolved`], [`bat`], [`ball`] | a part of a bat; a bat as it was understood; a bat file; a ball file |

pub mod document;
pub mod amount;
pub mod part;
pub mod resolved;
pub mod bat;
pub mod ball;
