//! What is a person asked, and how are the answers read?
//!
//! | file | question |
//! |---|---|
//! | [`draft`] | where are the answers kept until all is done |
//! | [`dialogue`] | how is somebody asked, who may go back and come back another day |
//! | [`ask`] | what does an answer mean |
//! | [`new_options`], [`interview`] | what `new` is told by options; what it asks |
//! | [`readings_asked`] | what `calibrate` asks |

pub mod draft;
pub mod dialogue;
pub mod ask;
pub mod new_options;
pub mod interview;
pub mod readings_asked;
