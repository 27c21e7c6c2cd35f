//! `sweetspot advise BAT`: which physics this bat needs.

use std::path::PathBuf;

use sweetspot::advise::advice::{Advice, MOST_MODES, advise_telling};
use sweetspot::error::Result;
use sweetspot::report::advice;

use crate::cli::common::{OutputArgs, read, tolerance};
use crate::cli::{Done, NOT_REACHED};

/// What each part of the model does to this bat's modes, and the smallest model that will do
///
/// Example: sweetspot advise meshes/r161.json --tol 1%
#[derive(clap::Args)]
pub struct Args {
    /// Bat file (JSON)
    bat: PathBuf,

    /// Number of bending modes
    #[arg(short = 'n', long = "modes", value_name = "N", default_value = "5",
          value_parser = clap::value_parser!(u16).range(1..=MOST_MODES as i64))]
    count: u16,

    /// How near to the full model's frequencies is near enough, relative, such as 1e-4 or 1%
    #[arg(long, value_name = "T", default_value = "1e-4", value_parser = tolerance)]
    tol: f64,

    #[command(flatten)]
    output: OutputArgs,
}

pub fn run(args: &Args) -> Result<Done> {
    let bat = read(&args.bat, args.output.quiet)?;
    let progress = args.output.progress("the full model");
    let tell = |share, what: &str| progress.say(share, what);
    let advice = advise_telling(&bat, args.count.into(), args.tol, &tell)?;
    drop(progress);
    let code = verdict(args, &advice);
    let table = advice::text(&advice, args.output.units);
    Ok(Done::new(args.output.deliver(table, || advice::json(&advice))?, code))
}

/// The exit code, after a word about frequencies that are less accurate than the tolerance.
fn verdict(args: &Args, advice: &Advice) -> u8 {
    if advice.met() {
        return 0;
    }
    let solution = &advice.full.solution;
    args.output.warn(&format!(
        "accuracy not reached: asked {:e}, the full model is within {:.1e}; {}",
        args.tol,
        solution.worst(),
        solution.shortfall(args.tol)
    ));
    NOT_REACHED
}
