//! `sweetspot new FILE`: a bat file by asking or from flags.

use std::io::{IsTerminal, Write, stderr, stdin};
use std::path::{Path, PathBuf};

use sweetspot::base::file;
use sweetspot::collision::Model;
use sweetspot::collision::setup::Setup;
use sweetspot::{Bat, Request, Result, solve};
use sweetspot_report::analysis::{Analysis, Task};
use sweetspot_report::parts::{Units, wrapped};
use sweetspot_report::report::sketch::{self, Places, SketchRow};
use sweetspot_report::report::trust;
use sweetspot_study::spread::Readings;

use crate::asking::ask::shown_density;
use crate::asking::dialogue::Dialogue;
use crate::asking::draft;
use crate::asking::interview::asked;
use crate::asking::new_options::{called, refuse_existing};
use crate::bat_text::{self, Measured};
use crate::common::{Prepared, prepare};
use crate::done::Done;
use crate::output::{LINES, Screen, glyphs, printed};
use crate::style;
use crate::value::TheoryChoice;

pub use crate::asking::new_options::Args;

pub fn run(args: &Args) -> Result<Done> {
    if let Some(path) = &args.file {
        refuse_existing(path, args.force)?;
    }
    let alone = !args.ask && !stdin().is_terminal();
    let of = args.name.as_deref().unwrap_or_default();
    let mut person = match alone {
        true => Dialogue::nobody(),
        false => Dialogue::kept(stdin().lock(), ("new", &draft(args)), of),
    };
    let Some(measured) = person.hold(|person| asked(args, person))? else {
        return Ok(Done::new(String::new(), 0));
    };
    let text = bat_text::text(&measured);
    let done = made(args, &measured, &text).inspect_err(|_| {
        if !alone {
            // Show the bat, too, unless standard error is closed.
            let _ = write!(stderr(), "The bat, which was not written:\n{text}");
        }
    })?;
    person.done();
    Ok(done)
}

/// Place of the answers until the bat file is written: beside it, or in this folder if it has no name yet.
fn draft(args: &Args) -> PathBuf {
    draft::stem(Some(args.file.as_deref().unwrap_or(Path::new("sweetspot-new"))), "new")
}

fn made(args: &Args, measured: &Measured, text: &str) -> Result<Done> {
    let path = args.file.clone().unwrap_or_else(|| called(&measured.name));
    let bat = Bat::from_text(&printed(&path), text, Path::new(""))?;
    if path.as_os_str() == "-" {
        return Ok(Done::new(text.to_owned(), 0));
    }
    refuse_existing(&path, args.force)?;
    file::write(&path, text.as_bytes())?;
    Ok(Done::new(style::table(&shown(&bat, measured, &path)), 0))
}

/// The bat as written, and the next steps.
fn shown(bat: &Bat, measured: &Measured, path: &Path) -> String {
    let places = measured.stations.iter().map(|s| s[0] * bat.length() / end(measured)).collect();
    let rows = [
        SketchRow { label: "measured".into(), places: Places::Points(places) },
        SketchRow {
            label: "balance".into(),
            places: Places::Points(vec![bat.inertia().balance_point]),
        },
    ];
    let units = Units::one(measured.unit == "in");
    let [name, page] = [path, &path.with_extension("html")].map(quoted);
    let above = format!(
        "{}{}\n{}\nWrote {name}. Next:\n  sweetspot analyze {name} --report {page}\n\n",
        wrapped(&bat.title(), 0),
        sketch::draw(bat, &rows, units, glyphs()),
        wrapped(&verdict(bat, measured), 0),
    );
    let screen = Screen::from([(0, "", above), (1, "", sweet_spot(bat, units))]);
    let all = screen.text();
    screen.fitted(LINES, &all, &format!("Everything else: sweetspot analyze {name} --full"))
}

/// The sweet spot and the exit speed there, as in `analyze`, or the reason why it is not known.
fn sweet_spot(bat: &Bat, units: Units) -> String {
    match analysed(bat) {
        Ok(analysis) => trust::in_short(&analysis, units),
        Err(error) => wrapped(&format!("Sweet spot: not known ({error})."), 0),
    }
}

/// All of the bat in the usual scene.
fn analysed(bat: &Bat) -> Result<Analysis> {
    /// The first number of modes for the hits, and the accuracy, as in `analyze`.
    const MODES: usize = 10;
    const TOLERANCE: f64 = 1e-4;
    let request = Request { modes: MODES, tolerance: TOLERANCE, ..Request::default() };
    let proof = request;
    let Prepared { bat, request, .. } = prepare(bat.clone(), TheoryChoice(None), request, true)?;
    let solution = solve(&bat, &request)?;
    let (scene, law) = Setup::default().scene(&bat, Some(TOLERANCE))?;
    let readings = Readings::of(&bat);
    let task = Task { model: Model::Contact, scene, law, hits: request, proof, readings };
    Analysis::new(bat, solution, task)
}

/// What the mass implies about the diameters, in one sentence or two.
fn verdict(bat: &Bat, measured: &Measured) -> String {
    let (density, factor) = (bat.material().density, bat.factors()[0]);
    let shown = |density| shown_density(density, bat.inches());
    let Some(mass) = &measured.mass else {
        return format!(
            "Not weighed: the mass is that of {} with {}.",
            measured.material,
            shown(density)
        );
    };
    format!(
        "To weigh {mass} the material must have {}; {} has {}. {}",
        shown(density),
        measured.material,
        shown(density / factor),
        match (bat.density_off(), bat.material().is_metal()) {
            (Some(_), _) => {
                "That is another material, a hollow bat, or a slip: look at mass and diameters."
            }
            (None, true) => "That is near enough.",
            (None, false) => "That is as wood differs.",
        }
    )
}

/// A path as a word of a shell.
fn quoted(path: &Path) -> String {
    let name = printed(path);
    if name.contains(char::is_whitespace) { format!("\"{name}\"") } else { name }
}

fn end(measured: &Measured) -> f64 {
    measured.stations.last().map_or(1.0, |s| s[0])
}
