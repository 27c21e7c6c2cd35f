//! `sweetspot new FILE`: a bat file by asking or from flags.

use std::io::{IsTerminal, Write, stderr, stdin};
use std::path::{Path, PathBuf};

use crate::base::error::Result;
use crate::base::file;
use crate::bat::body::Bat;
use crate::show::report::sketch::{self, Places, SketchRow};
use crate::show::report::text;
use crate::show::report::text::wrapped;
use crate::show::report::units::Units;

use crate::cli::asking::ask::shown_density;
use crate::cli::asking::dialogue::Dialogue;
use crate::cli::asking::interview::asked;
use crate::cli::asking::new_options::{called, given, refuse_existing};
use crate::cli::bat_text::{self, Measured};
use crate::cli::common::{glyphs, printed};
use crate::cli::done::Done;

pub use crate::cli::asking::new_options::Args;

pub fn run(args: &Args) -> Result<Done> {
    if let Some(path) = &args.file {
        refuse_existing(path, args.force)?;
    }
    if !args.ask && !stdin().is_terminal() {
        let measured = given(args)?;
        return made(args, &measured, &bat_text::text(&measured));
    }
    let mut person = Dialogue::kept(stdin().lock(), "new", &draft(args));
    let measured = person.hold(|person| asked(args, person))?;
    let text = bat_text::text(&measured);
    let done = made(args, &measured, &text).inspect_err(|_| {
        // Show the bat, too, unless standard error is closed.
        let _ = write!(stderr(), "The bat, which was not written:\n{text}");
    })?;
    person.done();
    Ok(done)
}

/// Where answers are kept until the bat file is written.
fn draft(args: &Args) -> PathBuf {
    let name = args.file.as_deref().filter(|file| file.as_os_str() != "-");
    let mut name = name.unwrap_or(Path::new("sweetspot-new")).as_os_str().to_owned();
    name.push(".draft");
    name.into()
}

fn made(args: &Args, measured: &Measured, text: &str) -> Result<Done> {
    let path = args.file.clone().unwrap_or_else(|| called(&measured.name));
    let bat = Bat::from_text(&printed(&path), text, Path::new(""))?;
    if path.as_os_str() == "-" {
        return Ok(Done::new(text.to_owned(), 0));
    }
    refuse_existing(&path, args.force)?;
    file::write(&path, text.as_bytes())?;
    Ok(Done::new(shown(&bat, measured, &path), 0))
}

/// The bat as it was written, and what to do with it.
fn shown(bat: &Bat, measured: &Measured, path: &Path) -> String {
    let places = measured.stations.iter().map(|s| s[0] * bat.length() / end(measured)).collect();
    let rows = [
        SketchRow { label: "measured".into(), places: Places::Points(places) },
        SketchRow {
            label: "balance".into(),
            places: Places::Points(vec![bat.inertia().balance_point]),
        },
    ];
    let units = if measured.unit == "in" { Units::Us } else { Units::Si };
    let [name, page] = [path, &path.with_extension("html")].map(quoted);
    format!(
        "{}\n{}\n{}\nWrote {name}. Next:\n  sweetspot analyze {name} --report {page}\n",
        text::summary(bat, units),
        sketch::draw(bat, &rows, units, glyphs()),
        wrapped(&verdict(bat, measured), 0),
    )
}

/// What the mass says of the diameters, as one sentence or two.
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
        match factor {
            0.8..1.25 => "That is as wood differs.",
            _ => "That is another material, a hollow bat, or a slip: look at mass and diameters.",
        }
    )
}

/// A path as a shell takes it.
fn quoted(path: &Path) -> String {
    let name = printed(path);
    if name.contains(char::is_whitespace) { format!("\"{name}\"") } else { name }
}

fn end(measured: &Measured) -> f64 {
    measured.stations.last().map_or(1.0, |s| s[0])
}
