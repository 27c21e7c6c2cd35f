//! How are results put into words, drawn and exchanged?
//!
//! | file | question |
//! |---|---|
//! | [`analysis`] | the whole analysis of one bat and its hits |
//! | [`schema`] | the format of every document |
//! | [`parts`] | the parts of a report |
//! | [`report`], [`csv`] | tables for people and for spreadsheets, JSON for programs |
//! | [`exchange`] | files for other programs |
//! | [`many`] | the rows of a study and the folder of them |
//! | [`plot`] | pictures |
//! | [`page`] | the whole analysis on one page |
//! | [`template`] | a bat in full size, for printing |
//! | [`hit_figure`], [`proof_page`] | the published hits as a picture; the page of proofs |
//! | [`formats`] | every format that is read or written, with its schema |

#![forbid(unsafe_code)]
#![allow(clippy::needless_range_loop)]

pub mod schema;
pub mod parts;
pub mod csv;
pub mod analysis;
pub mod report;
pub mod exchange;
pub mod many;
pub mod plot;
pub mod page;
pub mod template;
pub mod hit_figure;
pub mod proof_page;
pub mod formats;
