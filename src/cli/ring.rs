//! `sweetspot ring BAT`: motion after a hit or a blow, under a force or from an initial shape.

use crate::base::error::Result;

use crate::cli::delivered::apart;
use crate::cli::done::Done;
pub use crate::cli::ring_args::Args;
use crate::cli::{ring_hit, ring_motion};

/// Runs the verb.
pub fn run(args: &Args) -> Result<Done> {
    apart(&[
        ("--json", &args.output.json),
        ("--csv", &args.csv),
        ("--history", &args.history),
        ("--wav", &args.wav),
    ])?;
    let _progress = args.output.progress("modes and motion");
    let bat = args.bat.read(&args.output)?;
    match args.hit {
        Some(x) => ring_hit::run(args, bat, x),
        None => ring_motion::run(args, bat),
    }
}
