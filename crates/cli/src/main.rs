//! What did the user type? One file or folder per verb and no physics: options are parsed, the library is called, and
//! `Done` is returned.
//!
//! | file | question |
//! |---|---|
//! | `own_file`, `memory` | files that the program owns; the system's memory |
//! | `done`, `style`, `diagnostic` | the result of a verb; colours; mistakes as shown to people and to programs |
//! | `value`, `help`, `stop`, `progress`, `edits` | values with units; help that fits; signals; progress of a computation; edits |
//! | `output`, `common`, `guarantee`, `bat_text`, `scene`, `cannon` | options of several verbs: files, standard output and pictures; the bat, the tolerance; proofs; a bat file's text; the scene of a hit; the ball of a test |
//! | `asking`, `tables`, `frf_grid` | questions to the user; the promises as tables; the frequencies of `frf` |
//! | the rest | one verb each; `first_word` and `verbs` know which was typed, `program` runs it |

#![deny(unsafe_code)]

mod own_file;
mod done;
mod style;
mod diagnostic;
mod value;
mod help;
mod progress;
mod stop;
#[allow(unsafe_code)]
mod memory;
mod output;
mod edits;
mod common;
mod guarantee;
mod bat_text;
mod scene;
mod cannon;
#[cfg(feature = "audio")]
mod recording;
mod asking;
mod tables;
mod modes;
mod hit;
mod ring;
mod bbcor;
mod hoop;
mod lab;
mod analyze;
mod beside;
mod compare;
mod calibrate;
#[cfg(feature = "audio")]
mod tap;
mod frf_grid;
mod identify;
mod frf;
mod trade;
mod lathe;
mod study;
mod aim;
mod scatter;
mod advise;
mod convert;
mod validate;
mod materials;
mod bats;
mod schema;
mod new;
mod man;
mod completions;
mod licences;
mod first_word;
mod verbs;
mod program;

fn main() -> std::process::ExitCode {
    program::run()
}
