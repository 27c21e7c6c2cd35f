//! Which mode of the bat is a tone that was heard, and what is the wood by all of them?
//!
//! | file | question |
//! |---|---|
//! | [`heard`] | what is to be labelled: lines of the tones, twins as one |
//! | [`hoops`] | which tones of a hollow bat are of its wall |
//! | [`tapped`] | labels, how sure they are, and the wood |

pub mod heard;
pub mod hoops;
pub mod tapped;
