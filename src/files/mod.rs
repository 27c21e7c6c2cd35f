//! How do people and programs write it down?
//!
//! Every reader tells all mistakes of a file at once, each with line, column and field.
//!
//! | file | question |
//! |---|---|
//! | `document`, `broken_json`, `json_node` | the text and its places; JSON that does not parse; a value with its place |
//! | `sheet_number`, `sheet`, `csv_file` | a number in a table; its cells; columns of numbers |
//! | [`folder`] | which other files may a file name |
//! | `station_table`, `part_file`, `fixtures_file`, `edits_file`, [`bat_file`], [`built_in`] | a bat; which are built in |
//! | [`ball_file`], [`balls`], [`scene_file`] | a ball; which ball is meant; how a bat is hit |
//! | [`shape_file`], [`force_file`] | an initial shape; a force in time |
//! | `amounts`, [`readings_file`] | shares and readings with their uncertainty; what was measured of a bat |
//! | [`scatter_file`] | what differs between bats of one model |
//! | [`study_vary`], [`study_file`], [`study_rows`], `study_warnings` | what a study varies; what it asks; row k of it; what is strange |
//! | `wish_words`, `aim_text`, `rules_file`, `aim_file` | what is wished of a bat: in words; the rules of a game; a wish |
//! | [`schema`] | the types of every JSON format and their schemas |
//! | [`uff`] | universal files, read and written |
//! | [`measured`] | measured modes, as laboratories write them |

pub(crate) mod document;
pub(crate) mod broken_json;
pub(crate) mod json_node;
mod sheet_number;
pub(crate) mod sheet;
pub mod folder;
pub(crate) mod csv_file;
pub(crate) mod station_table;
pub(crate) mod amounts;
pub(crate) mod part_file;
pub(crate) mod fixtures_file;
pub(crate) mod edits_file;
pub mod bat_file;
pub mod built_in;
pub mod ball_file;
pub mod balls;
pub mod scene_file;
pub mod readings_file;
pub mod shape_file;
pub mod force_file;
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
#[cfg(feature = "show")]
pub mod schema;
#[cfg(feature = "show")]
#[doc(hidden)]
pub mod uff;
#[cfg(feature = "show")]
pub mod measured;
