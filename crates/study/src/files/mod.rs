//! How do people write down what they ask?
//!
//! | file | question |
//! |---|---|
//! | `amounts`, [`readings_file`] | shares and readings with their uncertainty; what was measured of a bat |
//! | [`scatter_file`] | what differs between bats of one model |
//! | [`study_vary`], [`study_file`], [`study_rows`], `study_warnings` | what a study varies; what it asks; row k of it; what is strange |
//! | `wish_words`, `aim_text`, `rules_file`, `aim_file` | what is wished of a bat: in words; the rules of a game; a wish |
//! | [`measured`] | measured modes, as laboratories write them |

pub mod amounts;
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
