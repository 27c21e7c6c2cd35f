//! `sweetspot materials`: the built-in list with its sources.

use std::path::PathBuf;

use sweetspot::Result;
use sweetspot::base::units::PSI;
use sweetspot::bat::material::{BUILT_IN, BuiltIn};
use sweetspot_report::parts::terminal::wrapped;
use sweetspot_report::parts::units::Units;
use sweetspot_report::schema;
use sweetspot_report::schema::materials::MaterialsFile;

use crate::done::Done;
use crate::output::put;
use crate::style;
use crate::value::unit_system;
use sweetspot_report::report::columns::{Columns, first, numbers};

/// The built-in materials with their sources
///
/// What a bat file may name as its material, and where the numbers come from. Handbook values are
/// those of slow bending tests of small clear pieces; the ones called dynamic are what makes models
/// of real bats ring as measured, 20 to 50 % stiffer. Own numbers go into the bat file as an object
/// with density, youngs_modulus and, if known, shear_modulus.
#[derive(clap::Args)]
#[command(after_long_help = EXAMPLES)]
pub struct Args {
    /// Units of the table: si, us or both
    #[arg(long, value_name = "SYSTEM", default_value = "both", value_parser = unit_system(),
          hide_possible_values = true, help_heading = "Output")]
    units: Units,

    /// Write JSON to this file (- = standard output, and no table then)
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    json: Option<PathBuf>,
}

const EXAMPLES: &str = "\
Examples:
  sweetspot materials --units us
  sweetspot materials --json materials.json

In the table ρ is the density, E Young's modulus and G the shear modulus along
the grain.";

const POUND_PER_CUBIC_INCH: f64 = 0.453_592_37 / (0.0254 * 0.0254 * 0.0254);
/// A million pound-force per square inch (Pa).
const MPSI: f64 = 1e6 * PSI;

pub fn run(args: &Args) -> Result<Done> {
    let table = style::table(&table(args.units));
    let text = put(&args.json, table, || Ok(schema::text(&MaterialsFile::built_in())))?;
    Ok(Done::new(text, 0))
}

fn table(units: Units) -> String {
    let si = |m: Option<&BuiltIn>| match m {
        None => ["ρ kg/m³", "E GPa", "G GPa"].map(str::to_owned),
        Some(m) => [
            format!("{:.1}", m.density),
            format!("{:.2}", 1e-9 * m.youngs_modulus),
            m.shear_modulus.map_or("-".to_owned(), |g| format!("{:.3}", 1e-9 * g)),
        ],
    };
    let us = |m: Option<&BuiltIn>| match m {
        None => ["ρ lb/in³", "E Mpsi", "G Mpsi"].map(str::to_owned),
        Some(m) => [
            format!("{:.4}", m.density / POUND_PER_CUBIC_INCH),
            format!("{:.3}", m.youngs_modulus / MPSI),
            m.shear_modulus.map_or("-".to_owned(), |g| format!("{:.3}", g / MPSI)),
        ],
    };
    let columns = Columns::new([first(20, "")].into_iter().chain((0..6).map(|_| numbers(10, ""))));
    let line = |m: Option<&BuiltIn>| {
        let systems = [(Units::Us, si(m)), (Units::Si, us(m))].into_iter();
        let cells = systems.filter(|(other, _)| units != *other).flat_map(|(_, cells)| cells);
        let name = m.map_or("Material", |m| m.name).to_owned();
        columns.row([name].into_iter().chain(cells))
    };
    let mut out = line(None);
    for material in BUILT_IN.iter() {
        out += &line(Some(material));
        out += &wrapped(&format!("  {}", material.source), 2);
        out += &strength(material, units);
        out += "  no loss factor known: undamped\n";
    }
    out
}

/// Where it breaks, if that is known.
fn strength(material: &BuiltIn, units: Units) -> String {
    let stress = material.strength.map(|stress| format!("breaks at {}", units.stress(stress, 0)));
    let strain = material.strain_to_failure.map(|e| format!("at a strain of {:.2} %", 100.0 * e));
    let known: Vec<String> = stress.into_iter().chain(strain).collect();
    match known.is_empty() {
        true => "  no strength found\n".to_owned(),
        false => wrapped(&format!("  {}: {}", known.join(", "), material.strength_source), 4),
    }
}
