//! `sweetspot materials`: the built-in list with its sources.

use std::fmt::Write;

use sweetspot::error::Result;
use sweetspot::material::BUILT_IN;
use sweetspot::report::text::wrapped;

use crate::cli::Done;

/// The built-in materials with their sources
#[derive(clap::Args)]
pub struct Args {}

pub fn run(_: &Args) -> Result<Done> {
    let mut out = String::from("name                  density kg/m³   E GPa   G GPa\n");
    for material in BUILT_IN {
        let shear = material.shear_modulus.map_or("-".into(), |g| format!("{:.3}", 1e-9 * g));
        let _ = writeln!(
            out,
            "{:<20} {:>14.1} {:>7.2} {shear:>7}",
            material.name,
            material.density,
            1e-9 * material.youngs_modulus,
        );
        out += &wrapped(&format!("    {}", material.source), 4);
    }
    Ok(Done::new(out, 0))
}
