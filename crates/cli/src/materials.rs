//! `sweetspot materials`: the built-in list with its sources.

use std::path::PathBuf;

use sweetspot::Result;
use sweetspot::base::units::PSI;
use sweetspot::bat::material::{BUILT_IN, BuiltIn};
use sweetspot_report::parts::{Shown, Units, first, lines, numbers, wrapped};
use sweetspot_report::schema;
use sweetspot_report::schema::materials::MaterialsFile;

use crate::done::Done;
use crate::help::commands;
use crate::output::put;
use crate::style;
use crate::value::unit_system;

/// The built-in materials with their sources
///
/// The names that a bat file may use as its material, and the source of their numbers. Handbook values come from slow
/// bending tests of small clear pieces. The materials called dynamic are 20 to 50 % stiffer, as models of real bats
/// need to ring as measured. Other numbers go into the bat file as an object with density, youngs_modulus and, if
/// known, shear_modulus.
#[derive(clap::Args)]
#[command(after_long_help = commands("materials"))]
pub struct Args {
    /// Units of the table: si, us or both
    #[arg(long, value_name = "SYSTEM", default_value = "both", value_parser = unit_system(),
          hide_possible_values = true, help_heading = "Output")]
    units: Units,

    /// Write JSON to this file (- = standard output, and no table then)
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    json: Option<PathBuf>,
}

const POUND_PER_CUBIC_INCH: f64 = 0.453_592_37 / (0.0254 * 0.0254 * 0.0254);
/// A million pound-force per square inch (Pa).
const MPSI: f64 = 1e6 * PSI;

pub fn run(args: &Args) -> Result<Done> {
    let table = style::table(&table(args.units));
    let text = put(&args.json, table, || Ok(schema::text(&MaterialsFile::built_in())))?;
    Ok(Done::new(text, 0))
}

/// The columns of a system of units: density, Young's modulus and shear modulus.
fn columns(us: bool) -> [Shown<'static, BuiltIn>; 3] {
    fn shear(material: &BuiltIn, unit: f64) -> String {
        material.shear_modulus.map_or("-".to_owned(), |g| format!("{:.3}", g / unit))
    }
    match us {
        false => [
            (numbers(10, "ρ kg/m³"), &|m| format!("{:.1}", m.density)),
            (numbers(10, "E GPa"), &|m| format!("{:.2}", 1e-9 * m.youngs_modulus)),
            (numbers(10, "G GPa"), &|m| shear(m, 1e9)),
        ],
        true => [
            (numbers(10, "ρ lb/in³"), &|m| format!("{:.4}", m.density / POUND_PER_CUBIC_INCH)),
            (numbers(10, "E Mpsi"), &|m| format!("{:.3}", m.youngs_modulus / MPSI)),
            (numbers(10, "G Mpsi"), &|m| shear(m, MPSI)),
        ],
    }
}

/// A line for each material, and below it the source of the numbers and the strength.
fn table(units: Units) -> String {
    let name: Shown<BuiltIn> = (first(20, "Material"), &|m| m.name.to_owned());
    let systems = [(Units::Us, false), (Units::Si, true)].into_iter();
    let systems = systems.filter(|(other, _)| units != *other).flat_map(|(_, us)| columns(us));
    let columns: Vec<Shown<BuiltIn>> = [name].into_iter().chain(systems).collect();
    let lines = lines(BUILT_IN.iter(), &columns);
    let mut lines = lines.lines();
    let mut out = format!("{}\n", lines.next().unwrap_or_default());
    for (material, line) in BUILT_IN.iter().zip(lines) {
        out += &format!("{line}\n");
        out += &wrapped(&format!("  {}", material.source), 2);
        out += &strength(material, units);
        out += &match material.loss_factor {
            Some(loss) => format!("  loss factor {loss}, where damping is assumed and in sounds\n"),
            None => "  no loss factor known: undamped\n".to_owned(),
        };
    }
    out
}

/// The strength, if it is known.
fn strength(material: &BuiltIn, units: Units) -> String {
    let stress = material.strength.map(|stress| format!("breaks at {}", units.stress(stress, 0)));
    let strain = material.strain_to_failure.map(|e| format!("at a strain of {:.2} %", 100.0 * e));
    let known: Vec<String> = stress.into_iter().chain(strain).collect();
    match known.is_empty() {
        true => "  no strength found\n".to_owned(),
        false => wrapped(&format!("  {}: {}", known.join(", "), material.strength_source), 4),
    }
}
