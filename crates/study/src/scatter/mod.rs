//! How much do bats of one model, and swings of one batter, differ?
//!
//! | file | question |
//! |---|---|
//! | [`turning`] | how does a lathe miss the profile |
//! | [`spreads`] | what differs, and how |
//! | [`rows`] | which bat and which hit is row k |
//! | [`scattered`] | percentiles with errors, and the causes of the variation |

pub mod turning;
pub mod spreads;
pub mod rows;
pub mod scattered;
