//! `sweetspot analyze BAT`: everything about a bat on one screen.

use std::path::PathBuf;

use sweetspot::Bat;
use sweetspot::advise::advice::advise;
use sweetspot::collision::figures::Figures;
use sweetspot::collision::sweep::sweep;
use sweetspot::error::{Error, Result};
use sweetspot::plot::sets::Hits;
use sweetspot::plot::{picture, sets};
use sweetspot::report::json::{self, ShapePoints};
use sweetspot::report::{advice, file, hit_json, hit_text, text};
use sweetspot::solve::{Request, Solution};
use sweetspot::validation;

use crate::cli::Done;
use crate::cli::common::{BatArgs, OutputArgs, SceneArgs, SolveArgs, Solved, curve_csv};
use crate::cli::hit::verdict as hit_verdict;

/// Everything about a bat: modes, proof on the dowel, collision, sweet spot
///
/// Example: sweetspot analyze meshes/r161.json --out r161
#[derive(clap::Args)]
pub struct Args {
    #[command(flatten)]
    bat: BatArgs,

    #[command(flatten)]
    solve: SolveArgs,

    #[command(flatten)]
    scene: SceneArgs,

    /// Write modes.json, hit.json and curve.csv into this folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,

    /// Draw everything into this folder, as SVG and PNG
    #[arg(long, value_name = "DIR")]
    plots: Option<PathBuf>,

    /// Leave the timing out of the JSON, so that equal input gives equal bytes
    #[arg(long)]
    reproducible: bool,

    #[command(flatten)]
    output: OutputArgs,
}

/// Impact points along the outer half of the bat.
const POINTS: usize = 101;

pub fn run(args: &Args) -> Result<Done> {
    let model = args.scene.model()?;
    args.output.progress("solving …");
    args.solve.refuse_budget("analyze")?;
    let Solved { bat, solution, warning } = args.bat.solve(&args.solve, &args.output)?;
    let (scene, law) = args.scene.scene(&bat)?;
    let modes = args.solve.modes_within(10, bat.profile.pieces.len());
    let request = Request { theory: solution.theory, ..args.solve.request(modes) };
    let half = 0.5 * bat.length();
    let places: Vec<f64> =
        (0..POINTS).map(|k| half + half * k as f64 / (POINTS - 1) as f64).collect();
    let hits = sweep(&bat, model, &scene, &request, false, &places)?;
    let figures = Figures::new(&bat, (model, hits.effort), (&scene, law), &hits.solution)?;
    if let Some(folder) = &args.plots {
        let mut pictures = sets::of_modes(&bat, &solution, Some(scene.pivot));
        let hits = Hits { bat: &bat, model, scene: &scene, sweep: &hits, spot: &figures.spot };
        pictures.extend(hits.pictures(None)?);
        picture::write(folder, &pictures)?;
    }
    let units = args.output.units;
    let few: Vec<_> = hits.impacts.iter().step_by(10).cloned().collect();
    let table = format!(
        "{}\n{}\n{}{}{}\n{}{}\n{}\n{}\n{}{}{}\n{}",
        text::summary(&bat, units),
        text::modes(&bat, &solution, 3, units),
        text::model(&bat, &solution),
        proof(args, &solution)?,
        advice(args, &bat),
        hit_text::scene(&bat, &scene, hit_json::model_name(model), units),
        hit_text::meaning(model),
        hit_text::impacts(&bat, &few, units),
        hit_text::curve(&hits.impacts, units),
        hit_text::sweet_spot(&bat, &figures.spot, units),
        hit_text::why(&figures, units),
        hit_text::beyond(&hits, &scene, units),
        hit_text::figures(&figures, units)
    );
    let modes = json::modes(&bat, &solution, ShapePoints::Even(101), !args.reproducible);
    let mut hit = hit_json::hit(&bat, model, &scene, &hits.impacts, &figures.spot);
    hit["figures"] = hit_json::figures(&figures);
    if let Some(folder) = &args.out {
        let failed = |source| Error::Write { path: folder.clone(), source };
        std::fs::create_dir_all(folder).map_err(failed)?;
        file::write(&folder.join("modes.json"), format!("{modes:#}\n").as_bytes())?;
        file::write(&folder.join("hit.json"), format!("{hit:#}\n").as_bytes())?;
        file::write(&folder.join("curve.csv"), curve_csv(&hits.impacts).as_bytes())?;
    }
    let both = serde_json::json!({ "modes": modes, "hit": hit });
    let code = args.solve.verdict(&solution, &args.output);
    let code = code.max(hit_verdict(&args.solve, &hits, &args.output));
    Ok(Done::new(args.output.deliver(table, || both)?, code).with(warning))
}

/// What the model needs, in short; nothing for a bat of so many pieces that it would take long, nor
/// where there is none to give.
fn advice(args: &Args, bat: &Bat) -> String {
    const MODES: usize = 5;
    const MOST_PIECES: usize = 1000;
    if bat.profile.pieces.len() > MOST_PIECES {
        return "Advice: see sweetspot advise\n".to_owned();
    }
    match advise(bat, MODES, args.solve.tol) {
        Ok(found) => advice::short(&found),
        Err(_) => "Advice: see sweetspot advise\n".to_owned(),
    }
}

/// The same solver on the uniform dowel, whose frequencies are known in closed form.
fn proof(args: &Args, solution: &Solution) -> Result<String> {
    let count = args.solve.modes_within(args.bat.count().max(10), 1);
    let [truth, stated] = validation::dowel_proof(&args.solve.request(count))?;
    let here = match solution.modes.is_empty() {
        true => String::new(),
        false => format!("; on this bat it says {:.1e}", solution.worst()),
    };
    Ok(format!(
        "Proof: on the uniform dowel the same solver misses the exact modes 1 to {count} by\n       \
         {truth:.1e} at most and says {stated:.1e}{here}\n"
    ))
}
