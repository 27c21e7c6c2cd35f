//! `sweetspot analyze BAT`: everything about a bat on one screen.

use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use sweetspot::analysis::{Analysis, Proof, Task};
use sweetspot::error::{Error, Result};
use sweetspot::page;
use sweetspot::page::content::Report;
use sweetspot::page::file::Kind;
use sweetspot::page::inputs::Input;
use sweetspot::plot::{picture, sets};
use sweetspot::report::json::{self, ShapePoints};
use sweetspot::report::text::{self, Units};
use sweetspot::report::{advice, file, hit_json, hit_text};
use sweetspot::solve::Request;

use crate::cli::Done;
use crate::cli::common::{BatArgs, OutputArgs, SceneArgs, SolveArgs, Solved, curve_csv};
use crate::cli::hit::verdict as hit_verdict;

/// Everything about a bat: modes, proof on the dowel, collision, sweet spot
///
/// Example: sweetspot analyze meshes/r161.json --report r161.html
///
/// Example: sweetspot analyze meshes/r161.json --out r161 --plots r161
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

    /// Write a report for people into this file: a page of its own (.html), or Markdown (.md) with
    /// its pictures in a folder beside it
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,

    /// Leave the timing out of the JSON, so that equal input gives equal bytes
    #[arg(long)]
    reproducible: bool,

    #[command(flatten)]
    output: OutputArgs,
}

pub fn run(args: &Args) -> Result<Done> {
    let model = args.scene.model()?;
    // A report that cannot be written is told before it is computed.
    args.report.as_deref().map(Kind::of).transpose()?;
    args.output.progress("solving …");
    args.solve.refuse_budget("analyze")?;
    let Solved { bat, solution, warning } = args.bat.solve(&args.solve, &args.output)?;
    let (scene, law) = args.scene.scene(&bat)?;
    let modes = args.solve.modes_within(10, bat.profile.pieces.len());
    let hits = Request { theory: solution.theory, ..args.solve.request(modes) };
    let proof = args.solve.request(args.solve.modes_within(args.bat.count().max(10), 1));
    let task = Task { model, scene, law, hits, proof };
    let analysis = Analysis::new(bat, solution, task)?;
    if let Some(folder) = &args.out {
        write_out(args, &analysis, folder)?;
    }
    if let Some(folder) = &args.plots {
        picture::write(folder, &sets::of_analysis(&analysis)?)?;
    }
    if let Some(path) = &args.report {
        let mut inputs = Input::of_bat(args.bat.path())?;
        inputs.extend(args.scene.ball_file().map(Input::read).transpose()?);
        page::file::write(path, &Report::new(&analysis, command(), inputs)?)?;
    }
    let both = || json!({ "modes": modes_json(args, &analysis), "hit": hit_json(&analysis) });
    let code = args.solve.verdict(&analysis.solution, &args.output);
    let code = code.max(hit_verdict(&args.solve, &analysis.hits, &args.output));
    let text = args.output.deliver(table(&analysis, args.output.units), both)?;
    Ok(Done::new(text, code).with(warning))
}

/// The command as it was typed, so that a shell reads it again.
fn command() -> String {
    let plain = |c: char| c.is_alphanumeric() || "-_./=:,%+".contains(c);
    let quoted = |arg: String| match !arg.is_empty() && arg.chars().all(plain) {
        true => arg,
        false => format!("'{}'", arg.replace('\'', "'\\''")),
    };
    let typed = std::env::args_os().skip(1).map(|arg| quoted(arg.to_string_lossy().into_owned()));
    std::iter::once("sweetspot".to_owned()).chain(typed).collect::<Vec<_>>().join(" ")
}

/// Everything on one screen.
fn table(analysis: &Analysis, units: Units) -> String {
    let Analysis { bat, solution, task, hits, figures, .. } = analysis;
    let few: Vec<_> = hits.impacts.iter().step_by(10).cloned().collect();
    format!(
        "{}\n{}\n{}{}{}\n{}{}\n{}\n{}\n{}{}{}\n{}",
        text::summary(bat, units),
        text::modes(bat, solution, 3, units),
        text::model(bat, solution),
        proof(analysis),
        advice(analysis),
        hit_text::scene(bat, &task.scene, hit_json::model_name(task.model), units),
        hit_text::meaning(task.model),
        hit_text::impacts(bat, &few, units),
        hit_text::curve(&hits.impacts, units),
        hit_text::sweet_spot(bat, &figures.spot, units),
        hit_text::why(figures, units),
        hit_text::beyond(hits, &task.scene, units),
        hit_text::figures(figures, units)
    )
}

fn modes_json(args: &Args, analysis: &Analysis) -> Value {
    let shapes = ShapePoints::Even(101);
    json::modes(&analysis.bat, &analysis.solution, shapes, !args.reproducible)
}

fn hit_json(analysis: &Analysis) -> Value {
    let Analysis { bat, task, hits, figures, .. } = analysis;
    let mut hit = hit_json::hit(bat, task.model, &task.scene, &hits.impacts, &figures.spot);
    hit["figures"] = hit_json::figures(figures);
    hit
}

fn write_out(args: &Args, analysis: &Analysis, folder: &Path) -> Result<()> {
    let failed = |source| Error::Write { path: folder.to_owned(), source };
    std::fs::create_dir_all(folder).map_err(failed)?;
    let [modes, hit] = [modes_json(args, analysis), hit_json(analysis)];
    file::write(&folder.join("modes.json"), format!("{modes:#}\n").as_bytes())?;
    file::write(&folder.join("hit.json"), format!("{hit:#}\n").as_bytes())?;
    file::write(&folder.join("curve.csv"), curve_csv(&analysis.hits.impacts).as_bytes())
}

/// What the model needs, in short.
fn advice(analysis: &Analysis) -> String {
    match &analysis.advice {
        Some(found) => advice::short(found),
        None => "Advice: see sweetspot advise\n".to_owned(),
    }
}

/// The same solver on the uniform dowel, whose frequencies are known in closed form.
fn proof(analysis: &Analysis) -> String {
    let Proof { modes, truth, stated } = analysis.proof;
    let here = match analysis.solution.modes.is_empty() {
        true => String::new(),
        false => format!("; on this bat it says {:.1e}", analysis.solution.worst()),
    };
    format!(
        "Proof: on the uniform dowel the same solver misses the exact modes 1 to {modes} by\n       \
         {truth:.1e} at most and says {stated:.1e}{here}\n"
    )
}
