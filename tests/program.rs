//! Tests of files, messages and outputs, as one program.

mod common;
#[cfg(feature = "png")]
#[path = "common/pictures.rs"]
mod pictures;

mod advise;
mod aim;
mod bad_input;
mod bat_schema;
mod calibrate;
mod tap;
mod commands;
mod compare;
mod compared_plots;
mod coverage;
mod diagnostics;
mod documents;
mod edits;
mod exchange;
mod features;
mod figures;
mod film;
mod first_screens;
mod fuzz_corpus;
mod golden;
mod hoop_verb;
mod identify;
mod ignored;
mod lathe;
mod library;
mod maker_plots;
mod mutated_files;
mod outputs;
mod page;
mod plots;
mod results;
mod scatter;
mod solved_once;
mod schema;
mod study;
mod tables;
mod terminal;
mod uff;
mod user_files;
