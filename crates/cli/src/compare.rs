//! `sweetspot compare A B …`: several bats side by side.

use std::path::{Path, PathBuf};

use sweetspot::base::file;
use sweetspot::collision::sweet_spot::FINE;
use sweetspot::modes::request::MOST_MODES;
use sweetspot::{Bat, Error, Result};
use sweetspot_report::report::{self, comparison, comparison_data, comparison_screen};
use sweetspot_report::{page, plot};
use sweetspot_study::comparison::contender::Terms;
use sweetspot_study::comparison::hidden::hidden;
use sweetspot_study::comparison::table::{Comparison, Entry};
use sweetspot_study::files::measured;
use sweetspot_study::measured::place::{End, ToldPoints};
use sweetspot_study::measured::study::Study;

use crate::beside::BesideArgs;
use crate::common::{Prepared, SolveArgs, as_options, command_line, examples, read};
use crate::done::Done;
use crate::edits::{EditArgs, WhatIf, edited, what_if};
use crate::output::{AnswerArgs, LINES, drawing, printed};
use crate::scene::{self, SceneArgs};
use crate::value::{PLACE, SPACING};

/// Bats side by side, or one beside its measured modes
///
/// Swings two to six bats equally and shows the differences that matter: the best exit speed and its place, the swing
/// weight, mass, first frequency, BBCOR and, if there is room, where along the barrel which bat is faster. All bats are
/// compared with the first; a difference within the errors does not count. With --full also: the zone, every frequency
/// and node, vibration, and the exit speeds at equal places from the tip and from the knob, each difference with its
/// error.
///
/// With --measured FILE, one bat's computed modes are compared with measured ones: the pairs, their differences, the
/// damping, and whether the measured shapes are sound; with --full also the MAC of any two, rigid motion in the shapes,
/// their mass orthogonality, and the error due to the small number of points.
#[derive(clap::Args)]
#[command(after_long_help = examples("compare"), mut_arg("plots", drawing("profiles, modes, exit speeds and their differences, energies, forces, hands; of measured modes MAC and shapes")))]
pub struct Args {
    /// Bat files (JSON) or names of built-in bats, two to six; one with --edit or --measured
    #[arg(required = true, value_name = "BAT")]
    bats: Vec<PathBuf>,

    /// A changed copy of the first bat beside it; may be repeated
    ///
    /// Edits separated by semicolons, after an optional name and a colon: "thin: cut 24 in to 30 in, 1 mm; knob 2 oz".
    /// An edit is written like the option of its name in the other verbs: cut, knob, cup, bore, cork, sleeve, shorten,
    /// scale-diameter, wood. Edits apply after the bat was weighed, and after those of its file.
    #[arg(long = "edit", value_name = "EDITS", value_parser = what_if, conflicts_with = "measured")]
    edits: Vec<WhatIf>,

    /// Measured modes (CSV or UFF) to compare with the bat's own
    #[arg(long, value_name = "FILE", conflicts_with_all = ["SceneArgs", "every", "csv"])]
    measured: Option<PathBuf>,

    /// The first measured point, the one with the lowest coordinate, is the nearest to the knob
    #[arg(long, requires = "measured", conflicts_with = "tip_first")]
    knob_first: bool,

    /// The first measured point is the nearest to the tip
    #[arg(long, requires = "measured")]
    tip_first: bool,

    /// Position of the first measured point, from the knob end [default: by its coordinate]
    #[arg(long, value_name = "m", requires = "measured", value_parser = PLACE)]
    origin: Option<f64>,

    #[command(flatten)]
    beside: BesideArgs,

    /// Number of bending modes in a hit [default: as many as it needs]
    #[arg(short = 'n', long = "modes", value_name = "N",
          value_parser = clap::value_parser!(u16).range(0..=MOST_MODES as i64))]
    count: Option<u16>,

    /// Distance between the places where exit speeds are compared
    #[arg(long, value_name = "m", default_value = "1 in", value_parser = SPACING)]
    every: f64,

    /// Write everything on one page for people into this file (.html), the differences first
    #[arg(long, value_name = "FILE", conflicts_with = "measured", help_heading = "Output")]
    report: Option<PathBuf>,

    /// Damping by the materials: material, or assumed: a metal without a loss factor has the published one
    #[arg(long, value_name = "WHOSE", hide_short_help = true, hide_possible_values = true,
          value_parser = ["material", "assumed"])]
    damping: Option<String>,

    #[command(flatten)]
    scene: SceneArgs,

    #[command(flatten)]
    solve: SolveArgs,

    #[command(flatten)]
    output: AnswerArgs,
}

/// Most bats that fit side by side.
const MOST: usize = 6;

pub fn run(args: &Args) -> Result<Done> {
    args.output.apart(&[("--report", &args.report)])?;
    args.solve.refuse_budget("compare")?;
    match &args.measured {
        Some(file) => measured_beside(args, file),
        None => bats_beside(args),
    }
}

/// Measured modes beside those of one bat.
fn measured_beside(args: &Args, file: &Path) -> Result<Done> {
    let [path] = args.bats.as_slice() else {
        let found = format!("{} bats beside measured modes", args.bats.len());
        return Err(Error::value("compare", found, "one bat file"));
    };
    let measured = measured::read(file, &args.beside.read()?)?;
    let bat = read(path, &EditArgs::damped(&args.damping), args.output.quiet)?;
    let modes = args.count.map_or(10, usize::from);
    let Prepared { bat, request, warning } = args.solve.prepare(bat, modes, &args.output)?;
    let first = match (args.knob_first, args.tip_first) {
        (true, _) => Some(End::Knob),
        (_, true) => Some(End::Tip),
        _ => None,
    };
    let told = ToldPoints { first, origin: args.origin };
    let study = Study::new(&bat, measured, &request, args.count.is_some(), told)?;
    args.solve.say_raised(&study.solution, &args.output);
    let drawn = |sheet| Ok(plot::measured::pictures(sheet, bat.name(), &study));
    args.output.draw(&bat, drawn)?;
    let units = args.output.units(&bat);
    let text = args.output.screen(LINES, |full| report::measured::text(&bat, &study, units, full));
    let name = path.display().to_string();
    let text = args.output.deliver(text, || report::measured::document(&bat, &name, &study))?;
    let code = args.solve.verdict(&study.solution, &args.output);
    Ok(Done::new(text, code).with(warning))
}

fn bats_beside(args: &Args) -> Result<Done> {
    let count = args.bats.len() + args.edits.len();
    if !(2..=MOST).contains(&count) {
        let found = match count {
            1 => "1 bat".to_owned(),
            count => format!("{count} bats"),
        };
        let expected = format!("2 to {MOST} that can be compared: files, or --edit of the first");
        return Err(Error::value("compare", found, expected));
    }
    if let Some(path) = &args.report {
        page::file::expected_page(path, &[&args.output.plots])?;
    }
    let (setup, model) = args.scene.setup()?;
    let mut warnings = vec![];
    let mut entries = vec![];
    let bats = bats(args)?;
    let files: Vec<String> = bats.iter().map(|(path, _)| path.display().to_string()).collect();
    for (path, bat) in bats {
        let modes = args.count.map_or(10, usize::from);
        let prepared = args.solve.prepare(bat, modes, &args.output)?;
        let tolerance = args.count.is_none().then_some(prepared.request.tolerance);
        let (scene, law) = setup.scene(&prepared.bat, tolerance).map_err(as_options)?;
        warnings.extend(prepared.warning.map(|w| format!("{}: {w}", path.display())));
        entries.push(Entry { bat: prepared.bat, scene, law, request: prepared.request });
    }
    scene::warn(&setup, entries.iter().map(|entry: &Entry| &entry.bat), &args.output);
    let terms = Terms {
        model,
        exactly: args.count.is_some(),
        every: args.every,
        look: FINE,
        barrel: setup.barrel_speed(),
    };
    let compared = Comparison::new(entries, terms)?;
    let units = args.output.units(&compared.bats[0].bat);
    let table = args.output.screen(LINES, |full| match full {
        true => comparison::text(&compared, units).into(),
        false => comparison_screen::screen(&compared, units),
    });
    let first = &compared.bats[0].bat;
    let text = args.output.answer(
        (first, table),
        |sheet| plot::compared::pictures(sheet, &compared),
        || comparison_data::document(&compared, &files),
        || comparison_data::csv(&compared),
    )?;
    if let Some(path) = &args.report {
        let us = args.output.sheet(first).us;
        let page = page::compared::page(&compared, &command_line(), us)?;
        file::write(path, page.as_bytes())?;
    }
    let warning = (!warnings.is_empty()).then(|| warnings.join("; "));
    Ok(Done::new(text, verdict(args, &compared)).with(warning))
}

/// The bats of the files, then the first of them with each set of edits; also a warning about a change that a weighed
/// mass hides.
fn bats(args: &Args) -> Result<Vec<(&Path, Bat)>> {
    let mut bats: Vec<(&Path, Bat)> = vec![];
    let damped = EditArgs::damped(&args.damping);
    for path in &args.bats {
        bats.push((path, read(path, &damped, args.output.quiet)?));
    }
    let (path, first) = bats[0].clone();
    for (file, other) in &bats[1..] {
        let called = [path, *file].map(printed);
        if let Some(said) = hidden((&called[0], &first), (&called[1], other)) {
            args.output.warn(&format!("warning: {said}"));
        }
    }
    for what_if in &args.edits {
        let WhatIf { name, edits } = what_if;
        let bat = edited(&first, edits, |k| format!("--edit {name}, {}", edits[k].change.verb()))?;
        let bat = bat.with(|parts| parts.name = format!("{}: {name}", first.name()))?;
        bats.push((path, damped.edit(bat)?));
    }
    Ok(bats)
}

/// The exit code, after a warning about bats whose exit speeds are less accurate than asked.
fn verdict(args: &Args, compared: &Comparison) -> u8 {
    let short = compared.bats.iter().filter(|bat| !bat.sweep.met() && args.solve.enforced());
    let names = short.map(|bat| bat.bat.name()).collect::<Vec<_>>().join(", ");
    let said = format!("accuracy of the exit speeds not reached for {names}: see the errors");
    args.output.reached((!names.is_empty()).then_some(said))
}
