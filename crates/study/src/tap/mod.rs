//! Which mode of the bat is each recorded tone, and what wood follows from all of them?
//!
//! | file | question |
//! |---|---|
//! | [`heard`] | lines of the tones for labelling, with twins merged |
//! | [`hoops`] | which tones of a hollow bat belong to its wall |
//! | [`tapped`] | labels, their probability, and the wood |

pub mod heard;
pub mod hoops;
pub mod tapped;
