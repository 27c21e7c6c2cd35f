//! `sweetspot modes BAT`: natural frequencies, shapes, nodes.

use std::path::PathBuf;

use sweetspot::beam::assembly::{Pencil, write_matrix_market};
use sweetspot::error::{Error, Result};
use sweetspot::plot::{picture, sets};
use sweetspot::report::json::{self, ShapePoints};
use sweetspot::report::{file, text};

use crate::cli::Done;
use crate::cli::common::{BatArgs, OutputArgs, SolveArgs, Solved};

/// Natural frequencies, shapes and nodes
///
/// Example: sweetspot modes meshes/r161.json -n 5 --tol 1e-8
#[derive(clap::Args)]
pub struct Args {
    #[command(flatten)]
    bat: BatArgs,

    #[command(flatten)]
    solve: SolveArgs,

    /// Samples of each shape in the JSON: a number of even points, or "nodes" for the mesh's
    #[arg(long, value_name = "N", default_value = "101", value_parser = shape_points)]
    shape_points: ShapePoints,

    /// Write stiffness.mtx and mass.mtx (Matrix Market) of the mesh into this folder
    #[arg(long, value_name = "DIR")]
    matrices: Option<PathBuf>,

    /// Draw the bat and its mode shapes into this folder, as SVG and PNG
    #[arg(long, value_name = "DIR")]
    plots: Option<PathBuf>,

    /// Leave the timing out of the JSON, so that equal input gives equal bytes
    #[arg(long)]
    reproducible: bool,

    #[command(flatten)]
    output: OutputArgs,
}

pub fn run(args: &Args) -> Result<Done> {
    let Solved { bat, solution, warning } = args.bat.solve(&args.solve, &args.output)?;
    if let Some(folder) = &args.matrices {
        if !bat.fixtures.none_moving() {
            let found = "a bat with attachments, joints or supports";
            return Err(Error::value(
                "--matrices",
                found,
                "a bare bat: K and M are those of its body",
            ));
        }
        let pencil = Pencil::of(&bat, &solution.mesh, solution.degree, solution.theory);
        let failed = |source| Error::Write { path: folder.clone(), source };
        std::fs::create_dir_all(folder).map_err(failed)?;
        for (name, matrix) in [("stiffness.mtx", &pencil.stiffness), ("mass.mtx", &pencil.mass)] {
            let mut text = Vec::new();
            write_matrix_market(matrix, &mut text).map_err(failed)?;
            file::write(&folder.join(name), &text)?;
        }
    }
    if let Some(folder) = &args.plots {
        picture::write(folder, &sets::of_modes(&bat, &solution, None))?;
    }
    let table = format!(
        "{}\n{}\n{}",
        text::summary(&bat, args.output.units),
        text::modes(&bat, &solution, args.bat.count(), args.output.units),
        text::model(&bat, &solution)
    );
    let document = || json::modes(&bat, &solution, args.shape_points, !args.reproducible);
    let code = args.solve.verdict(&solution, &args.output);
    Ok(Done::new(args.output.deliver(table, document)?, code).with(warning))
}

fn shape_points(text: &str) -> std::result::Result<ShapePoints, String> {
    match text.parse::<usize>() {
        _ if text == "nodes" => Ok(ShapePoints::Nodes),
        Ok(n) if n <= 100_000 => Ok(ShapePoints::Even(n)),
        _ => Err("expected \"nodes\" or a number up to 100000".into()),
    }
}
