//! `ring` without a hit: the deflection along the bat after a blow, under a force or from a shape.

use std::io::{IsTerminal, stdout};

use sweetspot::base::file;
use sweetspot::collision::Ball;
use sweetspot::files::{force_file, shape_file};
use sweetspot::motion::force::ForceHistory;
use sweetspot::motion::ringing::Ringing;
use sweetspot::motion::shape::InitialShape;
use sweetspot::motion::sound::{Sound, WallTones};
use sweetspot::{Bat, Error, Result, Solution};
use sweetspot_report::plot::ringing;
use sweetspot_report::report::motion;
use sweetspot_report::schema::Written;
use sweetspot_report::schema::ring::{Motion, RingFile};

use crate::common::{Solved, on_the_bat};
use crate::done::Done;
use crate::output::{LINES, Screen};
use crate::ring::args::{Args, csv, places, times, write_sound};

/// The motion, and its table.
pub fn run(args: &Args, bat: Bat) -> Result<Done> {
    let cause = cause(args, &bat)?;
    if let Some(t) = args.times.iter().find(|t| !(0.0..1e6).contains(*t)) {
        return Err(Error::value("--times", format!("{t:?} s"), "0 or later, before 1e6 s"));
    }
    let solved = args.bat.solve_for(bat, &args.solve, &args.output)?;
    let Solved { bat, solution, warning } = solved;
    let ringing = Ringing::new(&bat, &solution, args.solve.tol, args.bending_only)?;
    let start = match cause {
        Cause::Blow(x, impulse) => ringing.blow(x, impulse),
        Cause::Push(x, history) => ringing.pushed(x, history),
        Cause::Shape(shape) => ringing.release(&bat, &shape),
    };
    let x = places(args, &bat);
    if let Some((path, (x, impulse))) = args.wav.as_ref().zip(args.at.zip(args.impulse)) {
        let sound =
            |of: &Solution, wall: Option<WallTones>| Sound::of_blow(of, x, [impulse, 0.0], wall);
        for told in write_sound(path, (&bat, &solution), &Ball::baseball(), sound)? {
            args.output.warn(&format!("note: {told}"));
        }
    }
    let times = times(args, &solution);
    let shapes = ringing.shapes(&x);
    let deflections = |t: &f64| {
        let amplitudes = ringing.amplitudes(&start, *t);
        let sum = |i: usize| shapes.iter().zip(&amplitudes).map(|(w, a)| a * w[i]).sum();
        (0..x.len()).map(sum).collect()
    };
    let frames: Vec<Vec<f64>> = times.iter().map(deflections).collect();
    let moved = Motion {
        edits: bat.edits().to_vec(),
        modes: solution.modes.len(),
        theory: solution.theory.name(),
        rigid_motion: !args.bending_only && solution.rigid_modes > 0,
        at_m: args.at,
        impulse_n_s: args.impulse,
        x_m: x,
        times_s: times,
        deflection_m: frames,
    };
    args.output.draw(&bat, |sheet| Ok(ringing::moving(sheet, bat.name(), &moved)))?;
    let screen = motion::screen(&bat, &moved, args.output.units(&bat));
    let most = if args.output.full { usize::MAX } else { LINES };
    let table = csv(&moved.x_m, &moved.times_s, &moved.deflection_m);
    let code = args.solve.verdict(&solution, &args.output);
    let text = match &args.output.csv.csv {
        Some(path) if path.as_os_str() != "-" => {
            file::write(path, table.as_bytes())?;
            String::new()
        }
        // With JSON the table is not printed in addition.
        None if args.output.json.is_some() => String::new(),
        // Numbers by the hundred are for a file or another program.
        None if stdout().is_terminal() => Screen::from(screen).fitted(most, "", motion::MORE),
        _ => table,
    };
    let text = args.output.deliver(text, || Written::of(RingFile::Motion(moved)))?;
    Ok(Done::new(text, code).with(warning))
}

/// The cause of the motion.
enum Cause {
    Blow(f64, f64),
    Push(f64, ForceHistory),
    Shape(InitialShape),
}

fn cause(args: &Args, bat: &Bat) -> Result<Cause> {
    match (args.at, &args.initial) {
        (Some(x), _) => {
            let x = on_the_bat(bat, "--at", x)?;
            if let Some(path) = &args.force {
                return Ok(Cause::Push(x, force_file::read(path)?));
            }
            let impulse = args.impulse.unwrap_or(0.0);
            if impulse.abs() >= 1e6 {
                return Err(Error::value("--impulse", format!("{impulse:?} N s"), "less than 1e6"));
            }
            Ok(Cause::Blow(x, impulse))
        }
        (_, Some(path)) => Ok(Cause::Shape(shape_file::read(path, bat.length())?)),
        _ => {
            let expected = "--hit X, --at X with --impulse J or --force FILE, or --initial FILE";
            Err(Error::value("ring", "neither a blow nor an initial shape", expected))
        }
    }
}
