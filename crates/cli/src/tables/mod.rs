//! The promises as tables.
//!
//! | file | question |
//! |---|---|
//! | [`promise_table`], [`hit_promise_table`], [`hoop_promise_table`] | are frequencies, hits and hoop modes as accurate as stated |
//! | [`proven_promise_table`] | are stated errors true where frequencies are proven |
//! | [`extremes_table`] | what holds of bats that are no bats any more |

pub mod promise_table;
pub mod hit_promise_table;
pub mod hoop_promise_table;
pub mod proven_promise_table;
pub mod extremes_table;
