//! How do people write down what they ask?
//!
//! | file | question |
//! |---|---|
//! | [`form`], [`written`] | how a value is written; an object, and a file, by one list of its members |
//! | [`amounts`], `asked` | shares and readings with their uncertainty; what is asked, what goes with what |
//! | [`readings_file`] | what was measured of a bat |
//! | [`scatter_file`] | what differs between bats of one model |
//! | [`study_vary`], [`study_file`], [`study_rows`], `study_warnings` | what a study varies; what it asks; row k of it; what is strange |
//! | `wish_words`, `aim_text`, `rules_file`, `aim_file` | what is wished of a bat: in words; the rules of a game; a wish |
//! | [`measured`] | measured modes, as laboratories write them |

pub mod form;
pub mod written;
pub mod amounts;
mod asked;
pub mod readings_file;
pub mod study_vary;
pub mod study_file;
pub mod study_rows;
mod study_warnings;
#[cfg(feature = "aim")]
pub mod wish_words;
#[cfg(feature = "aim")]
pub mod aim_text;
#[cfg(feature = "aim")]
pub mod rules_file;
#[cfg(feature = "aim")]
pub mod aim_file;
pub mod scatter_file;
pub mod measured;
