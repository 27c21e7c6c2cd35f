//! How do people and programs write it in files?
//!
//! Every reader reports all mistakes of a file at once, each with line, column and field.
//!
//! | file | question |
//! |---|---|
//! | `document`, `broken_json`, `json_node` | the text and its places; JSON that does not parse; a value with its place |
//! | `sheet_number`, `sheet`, `csv_file` | a number in a table; its cells; columns of numbers |
//! | [`folder`] | which other files may a file name |
//! | `station_table`, `part_file`, `fixtures_file`, `edits_file`, [`bat_file`], [`built_in`] | a bat; which bats are built in |
//! | [`ball_file`], [`balls`], [`scene_file`] | a ball; which ball is meant; how a bat is hit |
//! | [`shape_file`], [`force_file`] | an initial shape; a force in time |
//! | `schema` | the form of these files, as a JSON schema (feature `schema`) |

#[doc(hidden)]
pub mod document;
pub(crate) mod broken_json;
#[doc(hidden)]
pub mod json_node;
mod sheet_number;
#[doc(hidden)]
pub mod sheet;
pub mod folder;
pub(crate) mod csv_file;
pub(crate) mod station_table;
#[doc(hidden)]
pub mod part_file;
pub(crate) mod fixtures_file;
pub(crate) mod edits_file;
pub mod bat_file;
pub mod built_in;
pub mod ball_file;
pub mod balls;
pub mod scene_file;
pub mod shape_file;
pub mod force_file;
#[cfg(feature = "schema")]
pub mod schema;
