//! `sweetspot licences`: authors and licences of everything in the program.

use crate::done::Done;
use crate::help::commands;
use sweetspot::Result;

/// Print the licences of this program and of everything in it
///
/// First its own two, either of which you may choose, then every package and the font of the pictures with their texts.
#[derive(clap::Args)]
#[command(after_long_help = commands("licences"))]
pub struct Args {}

const OWN: [&str; 2] =
    [include_str!("../../../LICENSE-MIT"), include_str!("../../../LICENSE-APACHE")];
const OTHERS: &str = include_str!("../../../THIRD-PARTY.md");

pub fn run(_: &Args) -> Result<Done> {
    let [mit, apache] = OWN.map(str::trim);
    let own = format!("# sweetspot\n\nMIT or Apache-2.0.\n\n{mit}\n\n{apache}\n");
    Ok(Done::new(format!("{own}\n{OTHERS}"), 0))
}
