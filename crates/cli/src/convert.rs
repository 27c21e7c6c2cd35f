//! `sweetspot convert MODES.json --to FORMAT`: modes in the files of other programs.

use std::path::{Path, PathBuf};

use clap::ValueEnum;
use sweetspot::base::error::Complaint;
use sweetspot::base::file;
use sweetspot::files::built_in;
use sweetspot::files::document::Document;
use sweetspot::modes::solve;
use sweetspot::{Error, Request, Result};
use sweetspot_report::exchange::modes_file::{self, ModeTable};
use sweetspot_report::exchange::{csv, modes_uff, npz, vtu};
use sweetspot_report::report::json::{self, ShapePoints};
use sweetspot_report::schema;
use uff58::Stamp;

use crate::common::{self, Prepared};
use crate::done::{Done, printable};
use crate::edits::EditArgs;
use crate::help::commands;
use crate::progress::Progress;
use crate::value::TheoryChoice;

/// Modes in the files of other programs: universal file, VTK, NumPy, CSV
///
/// MODES.json is the file that sweetspot modes BAT --json MODES.json wrote. A bat may be given in its place; its first
/// ten modes are then computed. The bat lies along x, with the knob at 0, and deflects along y; rotations are about z.
/// Shapes have a largest deflection of 1, lengths are in m.
#[derive(clap::Args)]
#[command(after_long_help = commands("convert"))]
pub struct Args {
    /// Modes file (JSON) of sweetspot modes; or a bat, by its file or its name
    modes: PathBuf,

    /// uff: universal file, datasets 151, 164, 2411, 82 and 55, for modal test programs;
    /// vtu: VTK, for ParaView; csv: a table for spreadsheets; npz: arrays for NumPy
    #[arg(long, value_name = "FORMAT", hide_possible_values = true)]
    to: Format,

    /// File to write (- = standard output, except for npz). With vtu, a name that ends in .pvd makes a collection
    /// through which ParaView steps, with one file for each mode beside it [default: the name of MODES.json with the
    /// format's ending, in this folder]
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,

    /// uff: nodes in dataset 15 in place of 2411, for older programs (six digits)
    #[arg(long)]
    legacy: bool,

    /// uff: 1 January 1970 for the date of the file, so that equal input gives equal bytes
    #[arg(long)]
    reproducible: bool,

    /// vtu: the bat's outer surface with N points around, in place of its axis
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(3..=360))]
    surface: Option<u16>,
}

#[derive(Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Format {
    Uff,
    Vtu,
    Csv,
    Npz,
}

impl Format {
    /// Its name on the command line, which is the ending of its files.
    fn name(self) -> String {
        self.to_possible_value().map_or(String::new(), |value| value.get_name().to_owned())
    }
}

pub fn run(args: &Args) -> Result<Done> {
    check(args)?;
    let Modes { table, solved, warning } = modes(&args.modes)?;
    let out = match &args.out {
        Some(out) => out.clone(),
        None => {
            let stem = args.modes.file_stem().unwrap_or(args.modes.as_os_str());
            // A stem may contain a dot, so the ending is added and replaces nothing.
            let mut name = stem.to_owned();
            name.push(format!(".{}", args.to.name()));
            PathBuf::from(name)
        }
    };
    refuse_giants(args, &table)?;
    let progress = Progress::new(false, "the file");
    let files = if is_collection(args) {
        collection(args, &table, &out, &progress)?
    } else {
        vec![(out.clone(), contents(args, &table, &out)?)]
    };
    if out.as_os_str() == "-" {
        let [(_, text)] = <[_; 1]>::try_from(files).expect("no collection goes there");
        let text = String::from_utf8(text).expect("no archive goes there");
        return Ok(Done::new(text, 0));
    }
    for (path, contents) in &files {
        file::write(path, contents)?;
    }
    drop(progress);
    Ok(Done::new(solved.unwrap_or_default() + &said(&table, &files), 0).with(warning))
}

/// The modes to be converted.
struct Modes {
    table: ModeTable,
    /// The solution, if they are a bat's.
    solved: Option<String>,
    /// A warning about that bat.
    warning: Option<String>,
}

/// The modes of a file, or of a bat, which is then solved.
fn modes(path: &Path) -> Result<Modes> {
    if built_in::named(path)?.is_some() {
        return of_bat(path);
    }
    let document = Document::read(path)?;
    let text = &document.text;
    if text.lines().find(|line| !line.trim().is_empty()).is_some_and(|line| line.trim() == "-1") {
        let expected = "modes of sweetspot (JSON) or a bat: universal files are written here";
        let complaint = Complaint::new("", "a universal file", expected);
        let hint = "sweetspot compare BAT --measured FILE and sweetspot calibrate BAT FILE read its shapes";
        return Err(document.error(0..0, complaint.hinted(hint)));
    }
    let value = serde_json::from_str::<serde_json::Value>(text).unwrap_or_default();
    match value["format"].as_str() {
        Some(format) if format.starts_with("sweetspot-bat/") && value["modes"].is_null() => {
            of_bat(path)
        }
        _ => {
            let table = modes_file::from_text(&document.file, text)?;
            Ok(Modes { table, solved: None, warning: None })
        }
    }
}

/// The first modes of a bat.
fn of_bat(path: &Path) -> Result<Modes> {
    const MODES: usize = 10;
    const POINTS: usize = 101;
    let (bat, _) = common::read_with_text(path, &EditArgs::default(), [false, false])?;
    let request = Request { modes: MODES, tolerance: 1e-4, ..Request::default() };
    let Prepared { bat, request, warning } =
        common::prepare(bat, TheoryChoice(None), request, false)?;
    let solution = solve::solve(&bat, &request)?;
    let document = json::modes(&bat, &solution, ShapePoints::Even(POINTS), false);
    let table = modes_file::from_text(&path.display().to_string(), &schema::text(&document))?;
    let solved = format!("solved for its first {MODES} modes, within 0.01 %\n");
    Ok(Modes { table, solved: Some(solved), warning })
}

/// Options that fit the format.
fn check(args: &Args) -> Result<()> {
    let format = args.to.name();
    for (option, given, of) in [
        ("--legacy", args.legacy, Format::Uff),
        ("--reproducible", args.reproducible, Format::Uff),
        ("--surface", args.surface.is_some(), Format::Vtu),
    ] {
        if given && args.to != of {
            let found = format!("it with --to {format}");
            return Err(Error::value(option, found, format!("--to {}, or without it", of.name())));
        }
    }
    let out = args.out.as_deref().unwrap_or(Path::new(""));
    if args.to == Format::Npz && out.as_os_str() == "-" {
        return Err(Error::value("--out", "- with --to npz", "a file: an archive is not text"));
    }
    if args.to != Format::Vtu && is_collection(args) {
        let found = format!("a .pvd file with --to {format}");
        return Err(Error::value("--out", found, "--to vtu, whose collection that is"));
    }
    Ok(())
}

fn is_collection(args: &Args) -> bool {
    let ending = args.out.as_ref().and_then(|out| out.extension());
    ending.is_some_and(|ending| ending.eq_ignore_ascii_case("pvd"))
}

/// Anything but a surface is about as large as the modes file; a surface may fill the memory.
fn refuse_giants(args: &Args, table: &ModeTable) -> Result<()> {
    const MOST: usize = 1_000_000_000;
    let Some(around) = args.surface.map(usize::from) else { return Ok(()) };
    let (modes, places) = (table.modes.len(), table.x.len());
    let points = places * around;
    let bytes =
        if is_collection(args) { modes * vtu::size(points, 1) } else { vtu::size(points, modes) };
    if bytes <= MOST {
        return Ok(());
    }
    let size = bytes as f64 / 1e9;
    let found = format!("{around}, with {modes} modes at {places} places about {size:.1} GB");
    let most = MOST / 1_000_000_000;
    let expected =
        format!("{most} GB at most: fewer points around, fewer modes, or fewer --shape-points");
    Err(Error::value("--surface", found, expected))
}

fn contents(args: &Args, table: &ModeTable, out: &Path) -> Result<Vec<u8>> {
    Ok(match args.to {
        Format::Uff => {
            let stamp = if args.reproducible { Stamp::fixed() } else { Stamp::now() };
            uff58::write(&modes_uff::modes(table, args.legacy, &stamp))?.into_bytes()
        }
        Format::Vtu => {
            vtu::all_modes(table, &vtu::grid(table, args.surface.map(usize::from))).into_bytes()
        }
        Format::Csv => csv::modes(table).into_bytes(),
        Format::Npz => {
            let failed = |source| Error::Write { path: out.to_owned(), source };
            npz::modes(table).map_err(failed)?
        }
    })
}

/// Writes a file for each mode, and the collection last, so that it never names a missing file.
fn collection(
    args: &Args,
    table: &ModeTable,
    out: &Path,
    progress: &Progress,
) -> Result<Vec<(PathBuf, Vec<u8>)>> {
    let stem = out.file_stem().unwrap_or_default().to_string_lossy();
    if stem.contains(char::REPLACEMENT_CHARACTER) {
        return Err(Error::value("--out", out.display(), "a name in UTF-8, as the files hold it"));
    }
    let grid = vtu::grid(table, args.surface.map(usize::from));
    let name = |k: usize| format!("{stem}_mode_{:02}.vtu", table.modes[k].order);
    let each = 0..table.modes.len();
    let one = |k| {
        progress.say(k as f64 / table.modes.len() as f64, "a file for each mode");
        (out.with_file_name(name(k)), vtu::one_mode(table, &grid, k).into_bytes())
    };
    let mut files: Vec<_> = each.clone().map(one).collect();
    let list: Vec<_> = each.map(|k| (table.modes[k].frequency, name(k))).collect();
    files.push((out.to_owned(), vtu::collection(&list).into_bytes()));
    Ok(files)
}

fn said(table: &ModeTable, files: &[(PathBuf, Vec<u8>)]) -> String {
    let bytes: usize = files.iter().map(|(_, contents)| contents.len()).sum();
    let path = files.last().map_or(String::new(), |(path, _)| path.display().to_string());
    let (modes, places) = (table.modes.len(), table.x.len());
    let beside = match files.len() {
        1 => String::new(),
        n => format!(" and {} files beside it", n - 1),
    };
    let kilobytes = bytes.div_ceil(1000);
    format!("{}{beside}: {modes} modes at {places} places, {kilobytes} kB\n", printable(&path))
}
