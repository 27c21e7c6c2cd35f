//! `sweetspot modes BAT`: natural frequencies, shapes, nodes.

use std::path::{Path, PathBuf};
use sweetspot_report::parts::{Part, terminal};

use sweetspot::base::file;
use sweetspot::beam::assembly::{Pencil, write_matrix_market};
use sweetspot::{Bat, Error, Result, Solution};
use sweetspot_report::csv;
use sweetspot_report::exchange::npz;
use sweetspot_report::plot::sets;
use sweetspot_report::report::json::{self, ShapePoints};
use sweetspot_report::report::{damped, proven, sketch, tables, text, trust};

use crate::common::{BatArgs, SolveArgs, Solved, examples};
use crate::done::Done;
use crate::guarantee::{self, GuaranteeArgs};
use crate::output::{AnswerArgs, MANY, Screen, drawing, make};

/// How the bat rings: frequencies, nodes, shapes
///
/// Which tones does the bat have, and where are their nodes? The table gives each bending mode's frequency, its error,
/// its modal mass, and the nodes of the first two modes, from knob and tip. With --full also: the nodes of the others,
/// a sketch of them on the bat, how the answer was computed, and the effects that the model leaves out, with their size
/// on this bat. The shapes are in the JSON.
#[derive(clap::Args)]
#[command(after_long_help = examples("modes"), mut_arg("plots", drawing("the bat and its mode shapes")))]
pub struct Args {
    #[command(flatten)]
    bat: BatArgs,

    #[command(flatten)]
    solve: SolveArgs,

    #[command(flatten)]
    guarantee: GuaranteeArgs,

    /// Samples of each shape in the JSON: a number, or "nodes" for the mesh's
    #[arg(long, value_name = "N", default_value = "101", value_parser = shape_points, help_heading = "Output")]
    shape_points: ShapePoints,

    /// Write K and M of the mesh into this folder: stiffness.mtx and mass.mtx (Matrix Market), and
    /// bat.npz (NumPy, SciPy's CSC parts) with the modes at the nodes
    #[arg(long, value_name = "DIR", help_heading = "Output")]
    matrices: Option<PathBuf>,

    /// Leave the timing out of the JSON, so that equal input gives equal bytes
    #[arg(long, help_heading = "Output")]
    reproducible: bool,

    #[command(flatten)]
    output: AnswerArgs,
}

/// Number of modes whose nodes are on a screen.
const FIRST_NODES: usize = 2;

pub fn run(args: &Args) -> Result<Done> {
    args.output.apart(&[])?;
    let progress = args.output.progress("modes");
    let bat = args.bat.read(&args.output)?;
    let (Solved { bat, solution, warning }, proven) =
        args.guarantee.solve_for(bat, &args.bat, &args.solve, &args.output)?;
    drop(progress);
    if let Some(folder) = &args.matrices {
        write_matrices(folder, &bat, &solution)?;
    }
    let units = args.output.units(&bat);
    let summary = text::summary(&bat, units);
    let proof = proven.as_ref().map_or(String::new(), proven::text);
    let trust = trust::of_wood(&bat);
    let table = args.output.screen(MANY, |full| {
        let shown = if full { solution.modes.len() } else { FIRST_NODES };
        let modes = Part::Table(tables::modes(&bat, &solution, units));
        let nodes = tables::nodes(&bat, &solution, shown, units);
        let nodes = [Part::Heading("Nodes"), Part::List(nodes)];
        let [modes, damping, nodes] =
            [&[modes][..], &damped::parts(&solution), &nodes].map(terminal::parts);
        if !full {
            return Screen::from([
                (0, "", summary.clone()),
                (2, "modes", modes),
                (3, "damping", damping),
                (4, "nodes", nodes),
                (1, "proof", proof.clone()),
                (0, "", trust.clone()),
            ]);
        }
        let sketch = args.output.sketch(&bat, &sketch::of_modes(&bat, &solution));
        let model = text::model(&bat, &solution);
        let modes = modes + &damping + &nodes + &proof;
        format!("{summary}\n{sketch}{modes}\n{model}{trust}").into()
    });
    let document = || {
        let mut document = json::modes(&bat, &solution, args.shape_points, !args.reproducible);
        proven.iter().for_each(|proven| proven::write(&mut document, proven));
        document
    };
    let code = match &proven {
        Some(proven) => guarantee::verdict(proven, &args.solve, &args.output),
        None => args.solve.verdict(&solution, &args.output),
    };
    let drawn = |sheet| Ok(sets::of_modes(sheet, &bat, &solution, None));
    let rows = || csv::modes(&solution);
    let text = args.output.answer((&bat, table), drawn, document, rows)?;
    Ok(Done::new(text, code).with(warning))
}

fn write_matrices(folder: &Path, bat: &Bat, solution: &Solution) -> Result<()> {
    if !bat.fixtures().none_moving() {
        let found = "a bat with attachments, joints or supports";
        let expected = "a bare bat: K and M are those of its body";
        return Err(Error::value("--matrices", found, expected));
    }
    let pencil = Pencil::of(bat, &solution.mesh, solution.degree, solution.theory);
    make(folder)?;
    let failed = |source| Error::Write { path: folder.to_owned(), source };
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
