//! What do the options of `sweetspot new` mean?

use std::path::{Path, PathBuf};

use sweetspot::base::units::inches;
use sweetspot::{Error, Result};
use sweetspot_proof::bundled::bundled_bat;

use crate::asking::ask;
use crate::common::about;
use crate::help::commands;

/// Write a bat file, by asking or from options
///
/// You need a ruler, calipers and a scale, for the length, the mass, and the diameter at the knob, along the handle and
/// every few inches from there; and you must know the material. At a terminal it asks for everything that the options
/// do not give, and repeats a question if the answer is impossible. ? explains a question, back returns to the one
/// before, quit leaves. Answers are kept in a draft beside the file until the file is written; the next time it asks
/// whether to continue with them. The file has comments and is meant to be edited. At the end it draws the bat,
/// computes how dense the material must be for the weighed mass, which reveals a slip of the calipers, and gives the
/// sweet spot.
#[derive(clap::Args)]
#[command(after_long_help = commands("new"))]
pub struct Args {
    /// File to write (- = standard output) [default: named after the bat]
    pub file: Option<PathBuf>,

    /// Read answers from standard input, one per line, even when it is not a terminal
    #[arg(long)]
    pub ask: bool,

    /// Replace a file that is there
    #[arg(long)]
    pub force: bool,

    /// Name of the bat
    #[arg(long, value_name = "TEXT", help_heading = "The bat")]
    pub name: Option<String>,

    /// Unit of the file's lengths: in or cm
    #[arg(long, value_name = "in|cm", help_heading = "The bat", value_parser = ["in", "cm"],
          hide_possible_values = true)]
    pub unit: Option<String>,

    /// Length, such as "33.5 in"; a bare number is in the file's unit
    #[arg(long, help_heading = "The bat")]
    pub length: Option<String>,

    /// Mass, weighed with everything on the bat, such as "31.5 oz"
    #[arg(long, value_name = "MASS", help_heading = "The bat", value_parser = |s: &str| ask::weighed(s).map_err(|complaint| complaint.to_string()))]
    pub mass: Option<String>,

    /// A name of: sweetspot materials
    #[arg(long, value_name = "NAME", help_heading = "The bat", value_parser = |s: &str| ask::material(s).map_err(|complaint| complaint.to_string()))]
    pub material: Option<String>,

    /// A place from the knob end and the diameter there, such as "3 in, 0.98 in"; bare numbers are in the file's unit.
    /// Repeat it for every place, from knob to tip
    #[arg(long = "station", value_name = "X, D", help_heading = "The bat")]
    pub stations: Vec<String>,

    /// Thickness of the wall of a hollow bat, such as "3 mm"; a bare number is in the file's unit
    #[arg(long, value_name = "THICKNESS", help_heading = "The bat", conflicts_with = "cup")]
    pub wall: Option<String>,

    /// Cup in the tip: its depth and its diameter, such as "1 in, 1.6 in"
    #[arg(long, value_name = "DEPTH, D", help_heading = "The bat")]
    pub cup: Option<String>,

    /// Take the diameters of a built-in bat, stretched to the length: r161 or torpedo
    #[arg(long, value_name = "BAT", help_heading = "The bat", conflicts_with = "stations",
          value_parser = ["r161", "torpedo"], hide_possible_values = true)]
    pub like: Option<String>,
}

const SOURCE: &str = "measured with ruler, calipers and scale";

pub fn source(args: &Args) -> String {
    let of =
        |like: &String| format!("the diameters of {like} as built in, stretched to the length");
    args.like.as_ref().map_or(SOURCE.to_owned(), of)
}

/// The stations given by options; the last must be the tip.
pub fn stations(given: &[String], length: Option<f64>, unit: &str) -> Result<Vec<[f64; 2]>> {
    let mut stations: Vec<[f64; 2]> = Vec::new();
    for text in given {
        let end = length.unwrap_or(f64::INFINITY);
        let measured = ask::station(text, None, &stations, end, unit);
        // An empty text is not a station.
        let missing = || Error::value("--station", "nothing", "a place and its diameter");
        let measured = measured.map_err(|complaint| about("--station", complaint))?;
        stations.push(measured.ok_or_else(missing)?);
    }
    let last = stations.last().map_or(0.0, |s| s[0]);
    match length.filter(|length| *length > last) {
        Some(length) => {
            let found = format!("the last one at {last} {unit}");
            Err(Error::value("--station", found, format!("one at the tip, {length} {unit}")))
        }
        None => Ok(stations),
    }
}

/// The stations of a built-in bat, as long as that; lengths in `unit`.
pub fn like(name: &str, length: Option<f64>, unit: &str) -> Result<Vec<[f64; 2]>> {
    let bat = bundled_bat(&format!("meshes/{name}.json"))?;
    let of_metres = if unit == "in" { inches(1.0) } else { 100.0 };
    let longer = length.map_or(1.0, |length| length / (bat.length() * of_metres));
    let stations = bat.profile().stations.x.iter().zip(&bat.profile().stations.outer);
    Ok(stations.map(|(x, r)| [x * of_metres * longer, 2.0 * r * of_metres]).collect())
}

/// Most letters of a file name that is made from the bat's name.
const LETTERS: usize = 60;

/// A file name made from the bat's name.
pub fn called(name: &str) -> PathBuf {
    let plain = |c: char| if c.is_alphanumeric() { c } else { ' ' };
    let words: String = name.to_lowercase().chars().map(plain).collect();
    let words: Vec<&str> = words.split_whitespace().collect();
    let stem: String = words.join("-").chars().take(LETTERS).collect();
    let stem = if words.is_empty() { "bat".to_owned() } else { stem };
    PathBuf::from(format!("{stem}.json"))
}

pub fn refuse_existing(path: &Path, force: bool) -> Result<()> {
    if !force && path.as_os_str() != "-" && path.exists() {
        let expected = "another name, or --force to replace it";
        return Err(Error::value("new", format!("{}, which is there", path.display()), expected));
    }
    Ok(())
}
