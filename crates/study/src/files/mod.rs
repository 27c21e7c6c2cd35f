//! How do people write their questions in files?
//!
//! | file | question |
//! |---|---|
//! | [`form`], [`written`] | a value; an object and a file, by one list of its members |
//! | [`amounts`], `asked` | shares and readings with their uncertainty; outputs and correlations |
//! | [`readings_file`] | readings of a bat |
//! | [`scatter_file`] | differences between bats of one model |
//! | [`study_vary`], [`study_file`], [`study_rows`], `study_warnings` | the inputs that a study varies; its outputs; row k of it; warnings |
//! | `wish_words`, `aim_text`, `rules_file`, `aim_file` | a wish for a bat: in words; the rules of a game; a wish |
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
