//! `sweetspot new FILE`: a bat file by asking or from flags.

use std::io::{IsTerminal, Write, stderr, stdin};
use std::path::{Path, PathBuf};

use crate::base::error::{Complaint, Error, Result};
use crate::base::file;
use crate::base::units::inches;
use crate::bat::body::Bat;
use crate::proof::bundled::bundled_bat;
use crate::show::report::sketch::{self, Places, SketchRow};
use crate::show::report::text;
use crate::show::report::text::{Units, wrapped};

use crate::cli::ask::{self, Dialogue};
use crate::cli::bat_text::{self, Measured};
use crate::cli::common::{glyphs, printed};
use crate::cli::done::Done;

/// Write a bat file, by asking or from options
///
/// All it needs is a ruler, calipers and a scale: the length, the mass, the material, and the
/// diameter at the knob, along the handle and every few inches from there. At a terminal it asks
/// for what the options do not say, and asks again where an answer cannot be right. The file is
/// commented and meant to be edited. In the end it draws the bat and says how dense its material
/// must be to weigh that much, which tells a slip of the calipers.
#[derive(clap::Args)]
#[command(after_long_help = EXAMPLES)]
pub struct Args {
    /// Where to write it (- = standard output) [default: after the name]
    file: Option<PathBuf>,

    /// Read answers from standard input, one per line, even when it is not a terminal
    #[arg(long)]
    ask: bool,

    /// Replace a file that is there
    #[arg(long)]
    force: bool,

    /// What it is called
    #[arg(long, value_name = "TEXT", help_heading = "The bat")]
    name: Option<String>,

    /// Unit of the file's lengths: in or cm
    #[arg(long, value_name = "in|cm", help_heading = "The bat",
          value_parser = ["in", "cm"], hide_possible_values = true)]
    unit: Option<String>,

    /// Length, such as "33.5 in"; a bare number is in the file's unit
    #[arg(long, help_heading = "The bat")]
    length: Option<String>,

    /// Mass on the scale, such as "31.5 oz"
    #[arg(long, value_name = "MASS", help_heading = "The bat", value_parser = |s: &str| ask::mass(s).map_err(|complaint| complaint.to_string()))]
    mass: Option<String>,

    /// A name of: sweetspot materials
    #[arg(long, value_name = "NAME", help_heading = "The bat", value_parser = |s: &str| ask::material(s).map_err(|complaint| complaint.to_string()))]
    material: Option<String>,

    /// A place from the knob end and the diameter there, such as "3 in, 0.98 in"; give it as often
    /// as you measured, from knob to tip
    #[arg(long = "station", value_name = "X, D", help_heading = "The bat")]
    stations: Vec<String>,

    /// The diameters of a bat that is built in, stretched to the length: r161 or torpedo
    #[arg(long, value_name = "BAT", help_heading = "The bat", conflicts_with = "stations",
          value_parser = ["r161", "torpedo"], hide_possible_values = true)]
    like: Option<String>,
}

const EXAMPLES: &str = "\
Examples:
  sweetspot new
      asks for everything and writes a file called after the bat

  sweetspot new mine.json --like r161 --length \"34 in\" --mass \"31.5 oz\" \\
      --material white-ash-dynamic
      a longer R161

  sweetspot new fungo.json --length \"35 in\" --mass \"22 oz\" \\
      --material white-ash-dynamic --station \"0 in, 1.7 in\" \\
      --station \"1.5 in, 0.9 in\" --station \"14 in, 1.1 in\" \\
      --station \"35 in, 2.2 in\"
      from four diameters; sweetspot analyze fungo.json says what it does";

const SOURCE: &str = "measured with ruler, calipers and scale";

pub fn run(args: &Args) -> Result<Done> {
    if let Some(path) = &args.file {
        refuse_existing(path, args.force)?;
    }
    let ask = args.ask || stdin().is_terminal();
    let measured =
        if ask { asked(args, &mut Dialogue::new(stdin().lock()))? } else { given(args)? };
    let text = bat_text::text(&measured);
    made(args, &measured, &text).inspect_err(|_| {
        // Print the answers, so that they are not lost with the file, unless standard error is closed.
        let _ =
            if ask { write!(stderr(), "The bat, which was not written:\n{text}") } else { Ok(()) };
    })
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

/// Letters of a file's name that is made of the bat's.
const LETTERS: usize = 60;

/// A file of the name, for a file that has none.
fn called(name: &str) -> PathBuf {
    let plain = |c: char| if c.is_alphanumeric() { c } else { ' ' };
    let words: String = name.to_lowercase().chars().map(plain).collect();
    let words: Vec<&str> = words.split_whitespace().collect();
    let stem: String = words.join("-").chars().take(LETTERS).collect();
    let stem = if words.is_empty() { "bat".to_owned() } else { stem };
    PathBuf::from(format!("{stem}.json"))
}

fn refuse_existing(path: &Path, force: bool) -> Result<()> {
    if !force && path.as_os_str() != "-" && path.exists() {
        let expected = "another name, or --force to replace it";
        return Err(Error::value("new", format!("{}, which is there", path.display()), expected));
    }
    Ok(())
}

/// From options alone; what is missing is said.
fn given(args: &Args) -> Result<Measured> {
    let missing =
        |what: &str| Error::value("new", "none", format!("{what}, or --ask to answer questions"));
    let unit = unit(args.unit.as_deref());
    let stations = match (&args.like, args.stations.is_empty()) {
        (None, true) => return Err(missing("--station or --like")),
        (Some(name), _) => like(name, length(args, unit)?, unit)?,
        (None, false) => stations(args, unit)?,
    };
    Ok(Measured {
        name: args.name.clone().unwrap_or_else(|| "My bat".to_owned()),
        source: source(args),
        material: args.material.clone().ok_or_else(|| missing("--material"))?,
        mass: args.mass.clone().ok_or_else(|| missing("--mass"))?,
        unit,
        stations,
    })
}

/// What the options say, and answers to the rest.
fn asked(args: &Args, person: &mut Dialogue<impl std::io::BufRead>) -> Result<Measured> {
    person.say("A bat file. An empty line takes what stands in [ ]; Ctrl-C writes nothing.");
    let new = |answer: &str| match &args.file {
        Some(_) => Ok(answer.to_owned()),
        None => match refuse_existing(&called(answer), args.force) {
            Ok(()) => Ok(answer.to_owned()),
            Err(_) => {
                let found = format!("{}, which is there", printed(&called(answer)));
                Err(Complaint::new("", found, "another name"))
            }
        },
    };
    let name = match &args.name {
        Some(name) => new(name).map_err(of_option("--name"))?,
        None => person.ask("Name", Some("My bat"), new)?,
    };
    let unit = match (&args.unit, &args.length) {
        (None, None) => {
            let read = |answer: &str| match answer {
                "in" | "cm" => Ok(answer.to_owned()),
                other => Err(Complaint::new("", format!("\"{other}\""), "in or cm")),
            };
            unit(Some(&person.ask(
                "Unit of your ruler and calipers, in or cm",
                Some("in"),
                read,
            )?))
        }
        (asked, _) => unit(asked.as_deref()),
    };
    let length = match length(args, unit)? {
        Some(length) => length,
        None => person.ask(&format!("Length, {unit}"), None, |text| ask::length(text, unit))?,
    };
    let mass = match &args.mass {
        Some(mass) => mass.clone(),
        None => person.ask("Mass on the scale, with its unit", None, ask::mass)?,
    };
    let material = match &args.material {
        Some(material) => material.clone(),
        None => {
            person.say(&ask::materials());
            person.ask("Material, name or number", None, ask::material)?
        }
    };
    let stations = match (&args.like, args.stations.is_empty()) {
        (Some(name), _) => like(name, Some(length), unit)?,
        (None, false) => stations(args, unit)?,
        (None, true) => person.stations(length, unit)?,
    };
    Ok(Measured { name, source: source(args), material, mass, unit, stations })
}

/// What is wrong with the value of an option.
fn of_option(name: &str) -> impl Fn(Complaint) -> Error {
    move |complaint| Error::Value(Complaint { field: name.to_owned(), ..complaint })
}

fn unit(name: Option<&str>) -> &'static str {
    if name == Some("cm") { "cm" } else { "in" }
}

fn source(args: &Args) -> String {
    let of =
        |like: &String| format!("the diameters of {like} as built in, stretched to the length");
    args.like.as_ref().map_or(SOURCE.to_owned(), of)
}

/// `--length` in the file's unit.
fn length(args: &Args, unit: &str) -> Result<Option<f64>> {
    let read = |text: &String| ask::length(text, unit).map_err(of_option("--length"));
    args.length.as_ref().map(read).transpose()
}

/// The stations of the options; the last must be the tip.
fn stations(args: &Args, unit: &str) -> Result<Vec<[f64; 2]>> {
    let length = length(args, unit)?;
    let mut stations: Vec<[f64; 2]> = Vec::new();
    for text in &args.stations {
        let end = length.unwrap_or(f64::INFINITY);
        let measured = ask::station(text, None, &stations, end, unit);
        // An empty text is not a station.
        let missing = || Error::value("--station", "nothing", "a place and its diameter");
        stations.push(measured.map_err(of_option("--station"))?.ok_or_else(missing)?);
    }
    let last = stations.last().map_or(0.0, |s| s[0]);
    if let Some(length) = length.filter(|length| *length > last) {
        let found = format!("the last one at {last} {unit}");
        return Err(Error::value("--station", found, format!("one at the tip, {length} {unit}")));
    }
    Ok(stations)
}

/// The stations of a built-in bat, as long as that; lengths in `unit`.
fn like(name: &str, length: Option<f64>, unit: &str) -> Result<Vec<[f64; 2]>> {
    let bat = bundled_bat(&format!("meshes/{name}.json"))?;
    let of_metres = if unit == "in" { inches(1.0) } else { 100.0 };
    let longer = length.map_or(1.0, |length| length / (bat.length() * of_metres));
    let stations = bat.profile().stations.x.iter().zip(&bat.profile().stations.outer);
    Ok(stations.map(|(x, r)| [x * of_metres * longer, 2.0 * r * of_metres]).collect())
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
    let density = bat.material().density;
    let told = density / bat.factors()[0];
    let verdict = format!(
        "To weigh {} the material must have {density:.0} kg/m³; {} has {told:.0}. {}",
        measured.mass,
        measured.material,
        match bat.factors()[0] {
            0.8..1.25 => "That is as wood differs.",
            _ => "That is another material, a hollow bat, or a slip: look at mass and diameters.",
        }
    );
    let [name, page] = [path, &path.with_extension("html")].map(quoted);
    format!(
        "{}\n{}\n{}\nWrote {name}. Next:\n  sweetspot analyze {name} --report {page}\n",
        text::summary(bat, units),
        sketch::draw(bat, &rows, units, glyphs()),
        wrapped(&verdict, 0),
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
