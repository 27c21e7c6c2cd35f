//! What does a recording of taps say?
//!
//! | file | question |
//! |---|---|
//! | `complex`, [`filter`] | what is it computed with |
//! | [`recording`] | what was recorded |
//! | `decode` | how is it read (feature `audio`) |

#![forbid(unsafe_code)]

pub mod complex;
pub mod filter;
pub mod least_squares;
pub mod hum;
pub mod onsets;
pub mod spectrum;
pub mod fit;
pub mod pencil;
pub mod tones;
pub mod recording;
pub mod analysis;
#[cfg(feature = "audio")]
pub mod decode;
