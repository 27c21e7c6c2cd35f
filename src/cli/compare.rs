//! `sweetspot compare A B …`: several bats side by side.

use std::path::{Path, PathBuf};

use sweetspot::comparison::contender::Terms;
use sweetspot::comparison::table::{Comparison, Entry};
use sweetspot::error::{Error, Result};
use sweetspot::report::{comparison, file};
use sweetspot::units::Quantity;

use crate::cli::common::{OutputArgs, SceneArgs, SolveArgs, quantity, read};
use crate::cli::{Done, NOT_REACHED};

/// Bats side by side: what differs, which hits harder where, and whether that is sure
///
/// The first bat is the one the others are measured by. A difference within the errors of both is
/// said to be none.
///
/// Example: sweetspot compare meshes/r161.json meshes/torpedo.json
#[derive(clap::Args)]
pub struct Args {
    /// Bat files (JSON), two to eight
    #[arg(required = true, value_name = "BAT")]
    bats: Vec<PathBuf>,

    /// Number of bending modes that count in a hit [default: as many as it needs]
    #[arg(short = 'n', long = "modes", value_name = "N",
          value_parser = clap::value_parser!(u16).range(0..=1000))]
    count: Option<u16>,

    /// Distance of the places where exit speeds are compared
    #[arg(long, value_name = "LENGTH", default_value = "1 in", allow_hyphen_values = true,
          value_parser = |s: &str| quantity(s, Quantity::Length))]
    every: f64,

    /// Write CSV to this file (- = standard output, and no table then)
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,

    #[command(flatten)]
    scene: SceneArgs,

    #[command(flatten)]
    solve: SolveArgs,

    #[command(flatten)]
    output: OutputArgs,
}

/// More bats do not fit beside each other.
const MOST: usize = 8;

pub fn run(args: &Args) -> Result<Done> {
    args.solve.refuse_budget("compare")?;
    let standard = Some(Path::new("-"));
    if args.csv.as_deref() == standard && args.output.json.as_deref() == standard {
        let expected = "one of them on standard output";
        return Err(Error::value("--csv", "- beside --json -", expected));
    }
    if !(2..=MOST).contains(&args.bats.len()) {
        let found = format!("{} bat", args.bats.len());
        return Err(Error::value("compare", found, format!("2 to {MOST} bat files")));
    }
    let model = args.scene.model()?;
    let mut warnings = vec![];
    let mut entries = vec![];
    for path in &args.bats {
        let bat = read(path, args.output.quiet)?;
        let modes = args.count.map_or(10, usize::from);
        let prepared = args.solve.prepare(bat, modes, &args.output)?;
        let (scene, law) = args.scene.scene(&prepared.bat)?;
        warnings.extend(prepared.warning.map(|w| format!("{}: {w}", path.display())));
        entries.push(Entry { bat: prepared.bat, scene, law, request: prepared.request });
    }
    let terms = Terms { model, exactly: args.count.is_some(), every: args.every };
    let compared = Comparison::new(entries, terms).map_err(as_option)?;
    let text = match &args.csv {
        Some(path) if path.as_os_str() == "-" => comparison::csv(&compared),
        Some(path) => {
            file::write(path, comparison::csv(&compared).as_bytes())?;
            comparison::text(&compared, args.output.units)
        }
        None => comparison::text(&compared, args.output.units),
    };
    let files: Vec<String> = args.bats.iter().map(|path| path.display().to_string()).collect();
    let text = args.output.deliver(text, || comparison::json(&compared, &files))?;
    let warning = (!warnings.is_empty()).then(|| warnings.join("; "));
    Ok(Done::new(text, verdict(args, &compared)).with(warning))
}

/// The place step as it is called on the command line.
fn as_option(error: Error) -> Error {
    match error {
        Error::Value(complaint) if complaint.field == "every" => {
            Error::value("--every", complaint.found, complaint.expected)
        }
        other => other,
    }
}

/// The exit code, after a word about bats whose exit speeds are less accurate than asked.
fn verdict(args: &Args, compared: &Comparison) -> u8 {
    let short = compared.bats.iter().filter(|bat| !bat.sweep.met && args.solve.enforced());
    let names: Vec<&str> = short.map(|bat| bat.bat.name.as_str()).collect();
    if names.is_empty() {
        return 0;
    }
    args.output.warn(&format!(
        "accuracy of the exit speeds not reached for {}: see the errors",
        names.join(", ")
    ));
    NOT_REACHED
}
