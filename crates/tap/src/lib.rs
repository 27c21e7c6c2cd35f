//! What does a recording of taps say?
//!
//! | file | question |
//! |---|---|
//! | [`transform`], [`filter`], [`least_squares`] | what is it computed with |
//! | [`recording`] | what was recorded |
//! | [`hum`] | is there hum, and what is left without it |
//! | [`onsets`] | when does a tap begin, when does it ring alone |
//! | [`spectrum`] | which tones may there be |
//! | [`fit`](mod@fit), [`pencil`] | which damped tones do all taps share; where do two in one band begin |
//! | [`envelope`](mod@envelope) | how loud is one tone in time |
//! | [`tones`](mod@tones) | the tones, and what is known of them |
//! | [`analysis`] | all of it, what is to be said, why it is refused |
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
