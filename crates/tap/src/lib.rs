//! Which taps and tones does a recording contain?
//!
//! | file | question |
//! |---|---|
//! | [`transform`], [`filter`], [`least_squares`] | mathematical tools |
//! | [`recording`] | what was recorded |
//! | [`hum`] | is there hum, and what does the recording sound like without it |
//! | [`onsets`] | when does a tap begin, and when does its ringing begin |
//! | [`spectrum`] | which tones may there be |
//! | [`fit`](mod@fit), [`pencil`] | which damped tones do all taps share; where do two in one band begin |
//! | [`envelope`](mod@envelope) | the level of one tone in time |
//! | [`tones`](mod@tones) | the tones, with their errors |
//! | [`analysis`] | the whole analysis, with warnings, or the reason for a refusal |
//! | `decode` | how is a file read (feature `audio`) |

#![forbid(unsafe_code)]

pub mod transform;
pub mod filter;
pub mod least_squares;
pub mod hum;
pub mod onsets;
pub mod spectrum;
pub mod fit;
pub mod pencil;
pub mod resonances;
pub mod orders;
pub mod envelope;
pub mod tones;
pub mod recording;
pub mod analysis;
#[cfg(feature = "audio")]
pub mod decode;
