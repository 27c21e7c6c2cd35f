//! `sweetspot ring BAT`: motion after a hit or a blow, under a force or from an initial shape.

use std::path::{Path, PathBuf};

use crate::base::error::{Error, Result};
use crate::base::file;
use crate::bat::body::Bat;
use crate::collision::aftermath::{Aftermath, Instant};
use crate::collision::hit::{Effort, Model};
use crate::collision::hitter::Hitter;
use crate::collision::strength::breaking_swing;
use crate::files::force_file;
use crate::files::schema::document::{Format, Generator};
use crate::files::schema::ring::{Motion, RingFile};
use crate::files::shape_file;
use crate::modes::solve::{Solution, solve};
use crate::motion::force::ForceHistory;
use crate::motion::ringing::Ringing;
use crate::motion::shape::InitialShape;
use crate::motion::sound::Sound;
use crate::show::exchange::wav;
use crate::show::report::aftermath::{self, AfterHit};
use crate::show::report::text::wrapped;
use crate::show::report::{hit_json, hit_text};
use crate::study::ignored;

use crate::cli::common::{BatArgs, OutputArgs, Prepared, SolveArgs, Solved, examples};
use crate::cli::done::Done;
use crate::cli::scene::SceneArgs;
use crate::cli::value::{IMPULSE, PLACE, RINGING_TIME, shown_length};
use crate::show::csv::{Cell, Csv};

/// How the bat moves after a hit, a blow, a push or a release
///
/// How does the handle move, and how near does the bat come to breaking? With --hit a ball is hit and
/// the table says how the watched places move, the spectrum there, where the strain is largest, and
/// what share the stress is of the strength that is published for the material. With
/// --at and --impulse or --force, or with --initial, the deflection at even places and given
/// instants is written as CSV.
#[derive(clap::Args)]
#[command(after_long_help = examples(EXAMPLES))]
pub struct Args {
    #[command(flatten)]
    bat: BatArgs,

    /// Hit a ball there, from the knob end
    #[arg(long, value_name = "m", help_heading = "The hit", conflicts_with_all = ["at", "initial", "bending_only"],
          allow_hyphen_values = true, value_parser = |s: &str| PLACE.read(s))]
    hit: Option<f64>,

    /// Places to watch after a hit, separated by commas [default: the hands]
    #[arg(long, value_name = "m,m,…", help_heading = "The hit", requires = "hit", value_delimiter = ',',
          allow_hyphen_values = true, value_parser = |s: &str| PLACE.read(s))]
    watch: Vec<f64>,

    /// How long to watch after a hit [default: three periods of mode 1]
    #[arg(long, value_name = "s", help_heading = "The hit", requires = "hit", allow_hyphen_values = true,
          value_parser = |s: &str| RINGING_TIME.read(s))]
    until: Option<f64>,

    /// Write force, motion and strain at the watched places to this CSV file
    #[arg(long, value_name = "FILE", help_heading = "Output", requires = "hit")]
    history: Option<PathBuf>,

    #[command(flatten)]
    scene: SceneArgs,

    /// Where it is struck or pushed, from the knob end
    #[arg(long, value_name = "m", help_heading = "A blow, a push or a release", requires = "load", allow_hyphen_values = true,
          value_parser = |s: &str| PLACE.read(s))]
    at: Option<f64>,

    /// The impulse of the blow
    #[arg(long, value_name = "N s", help_heading = "A blow, a push or a release", requires = "at", allow_hyphen_values = true, group = "load",
          value_parser = |s: &str| IMPULSE.read(s))]
    impulse: Option<f64>,

    /// Push it with the force in this CSV file
    ///
    /// Columns t_ms,force_n or with other units; straight lines between the rows, nothing before and
    /// after them.
    #[arg(
        long,
        value_name = "FILE",
        help_heading = "A blow, a push or a release",
        requires = "at",
        group = "load"
    )]
    force: Option<PathBuf>,

    /// Release it from the shape in this CSV file
    ///
    /// Columns x_m,w_m or with other units.
    #[arg(
        long,
        value_name = "FILE",
        help_heading = "A blow, a push or a release",
        conflicts_with = "at"
    )]
    initial: Option<PathBuf>,

    /// Instants, separated by commas [default: nine over a period of mode 1]
    #[arg(long, value_name = "s,s,…", help_heading = "Output", value_delimiter = ',', allow_hyphen_values = true,
          value_parser = |s: &str| RINGING_TIME.read(s))]
    times: Vec<f64>,

    /// Leave out the rigid motion
    #[arg(long, help_heading = "A blow, a push or a release")]
    bending_only: bool,

    /// Even points from end to end
    #[arg(long, value_name = "N", default_value = "101", help_heading = "Output",
          value_parser = clap::value_parser!(u32).range(2..=100_000))]
    shape_points: u32,

    /// Write CSV to this file (- = standard output, the default)
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    csv: Option<PathBuf>,

    /// Write what it sounds like to this file (.wav), where it was struck: after a hit or a blow
    ///
    /// A material without a loss factor gets one for the sound only, and that is said.
    #[arg(long, value_name = "FILE", help_heading = "Output", conflicts_with_all = ["initial", "force"])]
    wav: Option<PathBuf>,

    #[command(flatten)]
    solve: SolveArgs,

    #[command(flatten)]
    output: OutputArgs,
}

const EXAMPLES: &str = "\
Examples:
  sweetspot ring r161 --hit \"65 cm\" --watch \"5 in,9 in\" \\
      --history hands.csv
      what two hands feel after a hit near the sweet spot, every instant as CSV

  sweetspot ring dowel --at \"0.6 m\" --impulse \"1 N s\" --modes 5 \\
      --times \"0,1 ms,2 ms\"
      the deflected dowel after a blow, at three instants

  sweetspot ring meshes/r161.json --hit \"60 cm\" --wav sting.wav
      the crack of a ball hit 10 cm closer to the handle than it should be";

pub fn run(args: &Args) -> Result<Done> {
    let _progress = args.output.progress("modes and motion");
    let bat = args.bat.read(&args.output)?;
    if let Some(x) = args.hit {
        return after_hit(args, bat, x);
    }
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
    let last = f64::from(args.shape_points - 1);
    let x: Vec<f64> = (0..args.shape_points).map(|k| bat.length() * f64::from(k) / last).collect();
    if let Some((path, (x, impulse))) = args.wav.as_ref().zip(args.at.zip(args.impulse))
        && let Some(told) = write_sound(path, &Sound::of_blow(&solution, x, [impulse, 0.0]))?
    {
        args.output.warn(&format!("note: {told}"));
    }
    let times = times(args, &solution);
    let shapes = ringing.shapes(&x);
    let frames: Vec<Vec<f64>> = times
        .iter()
        .map(|t| {
            let amplitudes = ringing.amplitudes(&start, *t);
            let sum = |i: usize| shapes.iter().zip(&amplitudes).map(|(w, a)| a * w[i]).sum();
            (0..x.len()).map(sum).collect()
        })
        .collect();
    let table = csv(&x, &times, &frames);
    let document = || {
        RingFile::Motion(Motion {
            format: Format::new(),
            generator: Generator::this(),
            edits: bat.edits().to_vec(),
            modes: solution.modes.len(),
            theory: solution.theory.name(),
            rigid_motion: !args.bending_only && solution.rigid_modes > 0,
            at_m: args.at,
            impulse_n_s: args.impulse,
            x_m: x,
            times_s: times,
            deflection_m: frames,
        })
    };
    let code = args.solve.verdict(&solution, &args.output);
    let text = match &args.csv {
        Some(path) if path.as_os_str() != "-" => {
            file::write(path, table.as_bytes())?;
            String::new()
        }
        // With JSON asked for, the table is not thrown in besides.
        None if args.output.json.is_some() => String::new(),
        _ => table,
    };
    Ok(Done::new(args.output.deliver(text, document)?, code).with(warning))
}

/// What sets the bat in motion.
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

/// A hit, and what comes of it.
fn after_hit(args: &Args, bat: Bat, x: f64) -> Result<Done> {
    /// Modes whose sum is a bat's strain to a few per cent.
    const ENOUGH: usize = 40;
    let x = on_the_bat(&bat, "--hit", x)?;
    let count = if args.bat.asked() { args.bat.count() } else { ENOUGH };
    let count = args.solve.modes_within(count, bat.profile().pieces.len());
    if let Some(place) = args.watch.iter().find(|x| !(0.0..=bat.length()).contains(*x)) {
        on_the_bat(&bat, "--watch", *place)?;
    }
    args.solve.refuse_budget("ring --hit")?;
    let model = args.scene.model()?;
    if model != Model::Contact {
        let expected = "contact, the model with a force in time";
        return Err(Error::value("--model", hit_json::model_name(model), expected));
    }
    let prepared = args.bat.prepare(bat, count, &args.solve, &args.output)?;
    let Prepared { bat, request, warning } = prepared;
    let (scene, _) = args.scene.scene(&bat)?;
    args.scene.warn(&args.output);
    let solution = solve(&bat, &request)?;
    args.solve.say_raised(&solution, &args.output);
    let effort = Effort { completed: !args.bat.asked(), ..Effort::default() };
    let hitter = Hitter::new(model, &scene, &bat, &solution, effort)?;
    let impact = hitter.strike(x);
    let Some(force) = hitter.force(x) else {
        let found = format!("no contact at {} ({})", shown_length(x), impact.flags.join(", "));
        return Err(Error::value("--hit", found, "a place where ball and bat meet"));
    };
    let after = Aftermath::new(&bat, &solution, x, force);
    let period = solution.modes.first().map_or(0.01, |mode| 1.0 / mode.frequency());
    let until = args.until.unwrap_or(3.0 * period);
    if !(until > 0.0 && until < 1e3) {
        return Err(Error::value("--until", format!("{until:?} s"), "above 0 and below 1000 s"));
    }
    let watched = if args.watch.is_empty() { vec![scene.hands] } else { args.watch.clone() };
    let mut report = AfterHit::new(&bat, &after, &watched, until);
    for (load, swing) in &mut report.loads {
        *swing = breaking_swing(&bat, &solution, (&scene, effort), (x, until), load.limit);
    }
    let units = args.output.units;
    let mut text = format!(
        "{}{}{}",
        hit_text::scene(&bat, &scene, hit_json::model_name(model), units),
        aftermath::impact(&impact, units),
        aftermath::text(&report, units)
    );
    if let Some(path) = &args.wav
        && let Some(told) = write_sound(path, &after.sound(&solution))?
    {
        text += &wrapped(&format!("Sound: {told}"), 2);
    }
    if let Some(path) = &args.history {
        file::write(path, aftermath::history(&after, &report).as_bytes())?;
    }
    if let Some(path) = args.csv.as_ref().filter(|path| path.as_os_str() != "-") {
        let frames = frames_after(args, &bat, &solution, &after);
        file::write(path, frames.as_bytes())?;
    }
    let code = args.solve.verdict(&solution, &args.output);
    let document = || {
        let ignored = ignored::in_hit(&bat, scene.wall.is_some());
        aftermath::document(&after, &report, hit_json::impact(&bat, &impact), ignored)
    };
    Ok(Done::new(args.output.deliver(text, document)?, code).with(warning))
}

/// Writes a sound; what was assumed for it is given back.
fn write_sound(path: &Path, sound: &Sound) -> Result<Option<String>> {
    file::write(path, &wav::file(&sound.samples(wav::RATE)))?;
    Ok(sound.assumed_loss_factor.map(|loss| {
        format!(
            "the bat has no damping of its own; a loss factor of {loss} is taken for the sound only \
             (give the material a \"loss_factor\")"
        )
    }))
}

/// The bat's deflections after a hit as CSV, the instants in their order.
fn frames_after(args: &Args, bat: &Bat, solution: &Solution, after: &Aftermath) -> String {
    let last = f64::from(args.shape_points - 1);
    let places = (0..args.shape_points).map(|k| bat.length() * f64::from(k) / last);
    let places: Vec<f64> = places.collect();
    let mut times = times(args, solution);
    times.sort_by(f64::total_cmp);
    let deflections = |now: &Instant| places.iter().map(|x| after.motion(*x, now)[0]).collect();
    let frames: Vec<Vec<f64>> = after.at(&times).iter().map(deflections).collect();
    csv(&places, &times, &frames)
}

/// A place on that bat (m); a tip given in inches may be a rounding beyond it.
pub fn on_the_bat(bat: &Bat, name: &str, x: f64) -> Result<f64> {
    if (0.0..=bat.length() * (1.0 + 4.0 * f64::EPSILON)).contains(&x) {
        return Ok(x.min(bat.length()));
    }
    let expected = format!("a place on the bat, 0 to {}", shown_length(bat.length()));
    Err(Error::value(name, shown_length(x), expected))
}

/// The instants asked for, or nine over a period of mode 1.
fn times(args: &Args, solution: &Solution) -> Vec<f64> {
    let period = solution.modes.first().map_or(0.01, |mode| 1.0 / mode.frequency());
    let nine = || (0..=8).map(|k| period * f64::from(k) / 8.0).collect();
    if args.times.is_empty() { nine() } else { args.times.clone() }
}

fn csv(x: &[f64], times: &[f64], frames: &[Vec<f64>]) -> String {
    let names = times.iter().map(|t| format!("w_m_at_{t}_s"));
    let mut table = Csv::new(["x_m".to_owned()].into_iter().chain(names));
    for (k, x) in x.iter().enumerate() {
        let moved = frames.iter().map(|frame| frame[k]);
        table.row([*x].into_iter().chain(moved).map(Cell::from));
    }
    table.text()
}
