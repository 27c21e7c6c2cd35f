//! `sweetspot bats`: the built-in bats.

use sweetspot::files::built_in::bat_names;
use sweetspot::{Bat, Result};
use sweetspot_report::parts::cell::Quantity::Words;
use sweetspot_report::parts::{Column, Part, Table, Units, terminal};

use crate::done::Done;
use crate::help::commands;
use crate::style;

/// The built-in bats
///
/// Their names may be used in place of a bat file. The folder meshes of the source has their files, with the origin of
/// every number.
#[derive(clap::Args)]
#[command(after_long_help = commands("bats"))]
pub struct Args {}

const COLUMNS: [Column<(&str, Bat)>; 2] = [
    Column::new("bat", "bat", Words, |(name, _)| (*name).into()),
    Column::new("what it is", "name", Words, |(_, bat)| bat.name().into()),
];

pub fn run(_: &Args) -> Result<Done> {
    let named = bat_names().into_iter().map(|name| Ok((name, Bat::builtin(name)?)));
    let bats: Vec<_> = named.collect::<Result<_>>()?;
    let table = Part::Table(Table::of("", &COLUMNS, &bats, Units::Si));
    Ok(Done::new(style::table(&terminal::text("Built-in bats", &[table])), 0))
}
