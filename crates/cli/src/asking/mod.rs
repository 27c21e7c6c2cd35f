//! What is a person asked, and how are the answers read?
//!
//! | file | question |
//! |---|---|
//! | [`draft`] | where are the answers kept until the dialogue is finished |
//! | [`dialogue`] | how is a person asked, who may go back and continue another day |
//! | [`ask`] | what does an answer mean |
//! | [`new_options`], [`interview`] | the options of `new`; its questions |
//! | [`readings_asked`] | the questions of `calibrate` |

pub mod draft;
pub mod dialogue;
pub mod ask;
pub mod new_options;
pub mod interview;
pub mod readings_asked;
