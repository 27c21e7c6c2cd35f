//! `sweetspot modes BAT`: natural frequencies, shapes, nodes.

use std::path::{Path, PathBuf};

use crate::base::error::{Error, Result};
use crate::base::file;
use crate::bat::body::Bat;
use crate::beam::assembly::{Pencil, write_matrix_market};
use crate::modes::enclosure::guarantee::guarantee;
use crate::modes::enclosure::within::{Within, band};
use crate::modes::solve::Solution;
use crate::show::csv;
use crate::show::exchange::npz;
use crate::show::plot::sets;
use crate::show::report::json::{self, ShapePoints};
use crate::show::report::proven::{self, Proven};
use crate::show::report::{sketch, text, trust};

use crate::cli::common::{BatArgs, OutputArgs, Prepared, SolveArgs, Solved, examples};
use crate::cli::csv_option::CsvArgs;
use crate::cli::done::{Done, NOT_REACHED};
use crate::cli::pictures;
use crate::cli::value::LITTLE;

/// How the bat rings: frequencies, nodes, shapes
///
/// Which tones does the bat have, and where does it stand still in them? The table gives each
/// bending mode's frequency, how far it may be off, its modal mass and its nodes, from knob and
/// tip; the sketch shows the nodes on the bat. Below is what the answer was made with and what was
/// left out of the model, with what that costs on this bat. The shapes are in the JSON.
#[derive(clap::Args)]
#[command(after_long_help = examples(EXAMPLES))]
pub struct Args {
    #[command(flatten)]
    bat: BatArgs,

    #[command(flatten)]
    solve: SolveArgs,

    /// Prove two numbers between which each frequency of the exact beam lies, --tol wide at most
    ///
    /// The bat of the file, its decimals exactly as written, as a beam of the theory that stands below: each of
    /// its frequencies lies between both numbers, rounding included, and no mode is missing. The JSON has
    /// intervals with the nodes in them and the numbers that the proof rests on. Says nothing of wood.
    #[arg(long, help_heading = "Accuracy", conflicts_with_all = ["elements", "degree", "budget", "solver"])]
    guarantee: bool,

    /// And for every bat within this of it: radii and moduli, such as "0.1 mm, 2 %"
    #[arg(long, value_name = "m, %", help_heading = "Accuracy", requires = "guarantee",
        allow_hyphen_values = true, value_parser = within)]
    within: Option<Within>,

    /// Samples of each shape in the JSON: a number, or "nodes" for the mesh's
    #[arg(long, value_name = "N", help_heading = "Output", default_value = "101", value_parser = shape_points)]
    shape_points: ShapePoints,

    /// Write K and M of the mesh into this folder: stiffness.mtx and mass.mtx (Matrix Market), and
    /// bat.npz (NumPy, SciPy's CSC parts) with the modes at the nodes
    #[arg(long, value_name = "DIR", help_heading = "Output")]
    matrices: Option<PathBuf>,

    /// Draw the bat and its mode shapes into this folder, as SVG and PNG
    #[arg(long, value_name = "DIR", help_heading = "Output")]
    plots: Option<PathBuf>,

    /// Leave the timing out of the JSON, so that equal input gives equal bytes
    #[arg(long, help_heading = "Output")]
    reproducible: bool,

    #[command(flatten)]
    csv: CsvArgs,

    #[command(flatten)]
    output: OutputArgs,
}

const EXAMPLES: &str = "\
Examples:
  sweetspot modes r161 -n 5
      the first five modes, within 0.01 %

  sweetspot modes r161 -n 3 --tol 1e-10 --json modes.json
      to ten digits, with the shapes as JSON

  sweetspot modes r161 -n 5 --tol 1e-9 --guarantee --within \"0.1 mm, 2 %\"
      two numbers that the frequencies cannot leave, and of every bat so near

  sweetspot modes northwestern_aluminium --budget \"2 ms\"
      the best that two milliseconds give";

pub fn run(args: &Args) -> Result<Done> {
    args.csv.beside(&args.output.json)?;
    let progress = args.output.progress("modes");
    let (Solved { bat, solution, warning }, proven) = solved(args)?;
    drop(progress);
    if let Some(folder) = &args.matrices {
        write_matrices(folder, &bat, &solution)?;
    }
    if let Some(folder) = &args.plots {
        pictures::write(
            folder,
            &sets::of_modes(args.output.sheet(&bat), &bat, &solution, None),
            args.output.quiet,
        )?;
    }
    let table = format!(
        "{}\n{}\n{}\n{}{}",
        text::summary(&bat, args.output.units),
        args.output.sketch(&bat, &sketch::of_modes(&bat, &solution)),
        text::modes(&bat, &solution, solution.modes.len(), args.output.units)
            + &proven.as_ref().map_or(String::new(), proven::text),
        text::model(&bat, &solution),
        trust::of_wood(&bat)
    );
    let document = || {
        let mut document = json::modes(&bat, &solution, args.shape_points, !args.reproducible);
        proven.iter().for_each(|proven| proven::write(&mut document, proven));
        document
    };
    let code = match &proven {
        Some(proven) => verdict(args, proven),
        None => args.solve.verdict(&solution, &args.output),
    };
    let text = args.csv.deliver(args.output.deliver(table, document)?, || csv::modes(&solution))?;
    Ok(Done::new(text, code).with(warning))
}

/// The modes, and what is proven of them where that was asked.
fn solved(args: &Args) -> Result<(Solved, Option<Proven>)> {
    if !args.guarantee {
        return Ok((args.bat.solve(&args.solve, &args.output)?, None));
    }
    let bat = args.bat.read(&args.output)?;
    let prepared = args.bat.prepare(bat, args.bat.count(), &args.solve, &args.output)?;
    let Prepared { bat, request, warning } = prepared;
    let (solution, guarantee) = guarantee(&bat, &request)?;
    let band = match args.within {
        Some(within) => Some((within, band(&bat, &request, within)?)),
        None => None,
    };
    Ok((Solved { bat, solution, warning }, Some(Proven { guarantee, band })))
}

/// The exit code, after a word about what is not proven as asked.
fn verdict(args: &Args, Proven { guarantee, band }: &Proven) -> u8 {
    let tolerance = args.solve.tol;
    if !guarantee.met {
        let said = guarantee.shortfall(tolerance);
        args.output.warn(&format!("not proven as asked: {said}"));
    }
    if band.as_ref().is_some_and(|(_, band)| !band.met) {
        args.output
            .warn("not proven as asked: the band of the bats within --within has a wider end");
    }
    let met = guarantee.met && band.as_ref().is_none_or(|(_, band)| band.met);
    if met { 0 } else { NOT_REACHED }
}

/// `"0.1 mm, 2 %"`: a length for the radii, a share of the moduli, or both.
fn within(text: &str) -> std::result::Result<Within, String> {
    let expected = "a length for the radii and a share of the moduli, such as \"0.1 mm, 2 %\"";
    let mut within = Within { radius: 0.0, modulus: 0.0 };
    let (mut radii, mut moduli) = (0, 0);
    for part in text.split([',', ';']).map(str::trim) {
        match part.strip_suffix('%').map(|share| share.trim().parse::<f64>()) {
            Some(Ok(share)) => {
                within.modulus = 0.01 * share;
                moduli += 1;
            }
            Some(Err(_)) => return Err(expected.to_owned()),
            None => {
                within.radius = LITTLE.read(part).map_err(|said| format!("{said}; {expected}"))?;
                radii += 1;
            }
        }
    }
    let possible = within.radius >= 0.0 && (0.0..1.0).contains(&within.modulus);
    if radii > 1 || moduli > 1 || !possible {
        return Err(format!("expected {expected}, each once, the share below 100 %"));
    }
    Ok(within)
}

fn write_matrices(folder: &Path, bat: &Bat, solution: &Solution) -> Result<()> {
    if !bat.fixtures().none_moving() {
        let found = "a bat with attachments, joints or supports";
        let expected = "a bare bat: K and M are those of its body";
        return Err(Error::value("--matrices", found, expected));
    }
    let pencil = Pencil::of(bat, &solution.mesh, solution.degree, solution.theory);
    let failed = |source| Error::Write { path: folder.to_owned(), source };
    std::fs::create_dir_all(folder).map_err(failed)?;
    for (name, matrix) in [("stiffness.mtx", &pencil.stiffness), ("mass.mtx", &pencil.mass)] {
        let mut text = Vec::new();
        write_matrix_market(matrix, &mut text).map_err(failed)?;
        file::write(&folder.join(name), &text)?;
    }
    let archive = npz::matrices(&pencil, solution).map_err(failed)?;
    file::write(&folder.join("bat.npz"), &archive)
}

fn shape_points(text: &str) -> std::result::Result<ShapePoints, String> {
    match text.parse::<usize>() {
        _ if text == "nodes" => Ok(ShapePoints::Nodes),
        Ok(n) if n <= 100_000 => Ok(ShapePoints::Even(n)),
        _ => Err("expected \"nodes\" or a number up to 100000".into()),
    }
}
