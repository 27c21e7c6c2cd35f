//! `sweetspot ring BAT`: motion after a hit or a blow, under a force or from an initial shape.
//!
//! | file | question |
//! |---|---|
//! | `args` | the options, and the common parts of both answers |
//! | `hit` | motion and strain of the bat after a hit |
//! | `motion` | motion after any other start |

mod args;
mod hit;
mod motion;

use crate::done::Done;
use sweetspot::Result;

pub use args::Args;

/// Runs the verb.
pub fn run(args: &Args) -> Result<Done> {
    args.output.apart(&[("--history", &args.history), ("--wav", &args.wav)])?;
    let _progress = args.output.progress("modes and motion");
    let bat = args.bat.read(&args.output)?;
    match args.hit {
        Some(x) => hit::run(args, bat, x),
        None => motion::run(args, bat),
    }
}
