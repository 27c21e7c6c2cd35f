//! `sweetspot advise BAT`: which physics this bat needs.

use crate::common::{BatFileArgs, examples};
use crate::done::Done;
use crate::output::{LINES, OutputArgs};
use crate::value::tolerance;
use sweetspot::Result;
use sweetspot_report::parts::terminal;
use sweetspot_report::report::advice;
use sweetspot_study::advise::advice::{Advice, MOST_MODES, advise_telling};

/// Which physics this bat needs, and which it can do without
///
/// How far do rotary inertia, shear, tape, hands or a cork shift the frequencies of this bat, and with --full its
/// nodes, its balance and its damping? The table gives each shift with its error. Below it are the smallest model whose
/// frequencies are still within --tol of the full model's, and the effects that no beam model has.
#[derive(clap::Args)]
#[command(after_long_help = examples("advise"), next_help_heading = "The bat")]
pub struct Args {
    #[command(flatten)]
    bat: BatFileArgs,

    /// Number of bending modes
    #[arg(short = 'n', long = "modes", value_name = "N", default_value = "5",
          value_parser = clap::value_parser!(u16).range(1..=MOST_MODES as i64))]
    count: u16,

    /// Allowed difference from the full model's frequencies, such as 1%
    #[arg(long, value_name = "T", default_value = "1e-4", value_parser = tolerance,
          help_heading = "Accuracy")]
    tol: f64,

    #[command(flatten)]
    output: OutputArgs,
}

pub fn run(args: &Args) -> Result<Done> {
    let bat = args.bat.read(args.output.quiet)?;
    let progress = args.output.progress("the full model");
    let tell = |share, what: &str| progress.say(share, what);
    let advice = advise_telling(&bat, args.count.into(), args.tol, &tell)?;
    drop(progress);
    let code = verdict(args, &advice);
    let table = args.output.screen(LINES, |full| {
        let (title, parts) = advice::report(&advice, args.output.units(&bat), full);
        terminal::text(&title, &parts)
    });
    Ok(Done::new(args.output.deliver(table, || advice::document(&advice))?, code))
}

/// The exit code, after a warning about frequencies that are less accurate than the tolerance.
fn verdict(args: &Args, advice: &Advice) -> u8 {
    let full = &advice.full_model;
    let solution = &full.solved.solution;
    args.output.reached((!full.tolerance_met).then(|| {
        let (worst, ending) = (solution.worst(), &solution.ending);
        format!(
            "accuracy not reached: asked {:e}, the full model is within {worst:.1e}; {ending}",
            args.tol
        )
    }))
}
