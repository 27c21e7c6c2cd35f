//! `sweetspot ring BAT`: motion after a hit or a blow, under a force or from an initial shape.
//!
//! | file | question |
//! |---|---|
//! | `args` | what is asked, and what both answers need |
//! | `hit` | how the bat moves and what it bears after a hit |
//! | `motion` | how it moves after all else |

mod args;
mod hit;
mod motion;

use crate::done::Done;
use crate::output::apart;
use sweetspot::Result;

pub use args::Args;

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
        Some(x) => hit::run(args, bat, x),
        None => motion::run(args, bat),
    }
}
