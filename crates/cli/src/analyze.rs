//! `sweetspot analyze BAT`: everything about a bat on one screen.

use std::path::PathBuf;
use sweetspot_report::page::accuracy;

use sweetspot::base::file;
use sweetspot::collision::columns;
use sweetspot::{Bat, Request, Result};
use sweetspot_report::analysis::{Analysis, Task};
use sweetspot_report::page::content::Report;
use sweetspot_report::parts::{Input, Part, terminal, wrapped};
use sweetspot_report::plot::sets;
use sweetspot_report::report::hoop::{self, HoopFile};
use sweetspot_report::report::json::{self, ShapePoints};
use sweetspot_report::report::proven::{self, Proven};
use sweetspot_report::report::sketch::{self, SketchRow};
use sweetspot_report::report::whole::AnalysisFile;
use sweetspot_report::report::{
    self, advice, aftermath, damped, hit_json, hit_text, tables, text, trust,
};
use sweetspot_report::schema::hit::HitFile;
use sweetspot_report::schema::modes::ModesFile;
use sweetspot_report::schema::{self, Written};
use sweetspot_report::{csv, page};
use sweetspot_study::lathe::map::LatheMap;
use sweetspot_study::lathe::workpiece::HitTerms;
use sweetspot_study::spread::Readings;

use crate::common::{BatArgs, SolveArgs, Solved, as_options, command_line, examples};
use crate::done::Done;
use crate::guarantee::{self, GuaranteeArgs};
use crate::hit::verdict as hit_verdict;
use crate::lab;
use crate::output::{LINES, OutputArgs, Screen, apart, draw, make, printed};
use crate::scene::{self, SceneArgs};
use crate::value::{READING, SCALE, Use};

/// A bat on one screen
///
/// Where is its sweet spot, how fast does the ball leave there, how wide is the zone, what is its swing weight, how
/// does it ring? Each answer has its uncertainty for the bat in hand and the main cause: the wood, which differs from
/// piece to piece, or the measurements. The last lines say which measurement would reduce it, and how much error the
/// computation adds.
///
/// With --full also: a sketch with the nodes of the modes and the zone of the best exit speeds; ten modes, their
/// errors, and the effects that the model leaves out; the solver's proof on a dowel with exact frequencies; the parts
/// of the model that this bat needs; exit speeds along the barrel, the sweet spot by every definition, why it is there,
/// and the figures by which bats are compared.
#[derive(clap::Args)]
#[command(after_long_help = examples("analyze"))]
pub struct Args {
    #[command(flatten)]
    bat: BatArgs,

    #[command(flatten)]
    solve: SolveArgs,

    #[command(flatten)]
    guarantee: GuaranteeArgs,

    #[command(flatten)]
    scene: SceneArgs,

    /// Error of the calipers, one standard deviation [default: 0.1 mm; if all diameters lie on a step of 1/16, 1/32 or
    /// 1/64 in or of 1 mm, that of the step: 0.46 mm for 1/16 in]
    #[arg(long, value_name = "m", help_heading = "How it was measured",
          value_parser = |s: &str| reading(&READING, s))]
    calipers: Option<f64>,

    /// Error of the rule, one standard deviation
    #[arg(long, value_name = "m", default_value = "1 mm", help_heading = "How it was measured",
          value_parser = |s: &str| reading(&READING, s))]
    rule: f64,

    /// Error of the scale, one standard deviation; for a bat that was weighed
    #[arg(long, value_name = "kg", default_value = "1 g", help_heading = "How it was measured",
          value_parser = |s: &str| reading(&SCALE, s))]
    scale: f64,

    /// Write modes.json, hit.json and curve.csv into this folder, of a hollow bat also hoop.json
    #[arg(long, value_name = "DIR", help_heading = "Output")]
    out: Option<PathBuf>,

    /// Draw everything into this folder, as SVG and PNG
    #[arg(long, value_name = "DIR", help_heading = "Output")]
    plots: Option<PathBuf>,

    /// Write a report for people into this file: a self-contained page (.html), or Markdown (.md) with its pictures in
    /// a folder beside it
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    report: Option<PathBuf>,

    /// Write the live page of this bat beside the report; a button of the report opens it
    #[arg(long, requires = "report", help_heading = "Output")]
    lab: bool,

    /// Leave the timing out of the JSON, so that equal input gives equal bytes
    #[arg(long, help_heading = "Output")]
    reproducible: bool,

    #[command(flatten)]
    output: OutputArgs,
}

/// Modes that hits are computed by at first.
const MODES: usize = 10;

pub fn run(args: &Args) -> Result<Done> {
    let (setup, model) = args.scene.setup()?;
    // A report that cannot be written is refused before anything is computed.
    let made = [&args.out, &args.plots];
    args.report.as_deref().map(|path| page::file::expected(path, &made)).transpose()?;
    if args.lab {
        lab::page()?;
    }
    apart(&[("--json", &args.output.json), ("--report", &args.report)])?;
    args.solve.refuse_budget("analyze")?;
    let (bat, text) = args.bat.read_with_text(&args.output)?;
    for off in bat.balance_off().into_iter().chain(bat.swing_weight_off()) {
        args.output.warn(&format!("note: {off}"));
    }
    let progress = args.output.progress("modes");
    let modes = args.solve.modes_within(MODES, bat.profile().pieces.len());
    // Fewer modes are shown than a hit needs.
    let (solve, of_theory) = match args.bat.count() < MODES {
        true => args.solve.of_hits(&bat, modes)?,
        false => (args.solve.clone(), None),
    };
    let (Solved { bat, solution, warning }, proven) =
        args.guarantee.solve_for(bat, &args.bat, &solve, &args.output)?;
    let (scene, law) = setup.scene(&bat, Some(args.solve.tol)).map_err(as_options)?;
    scene::warn(&setup, [&bat], &args.output);
    let inputs = args.report.as_ref().map(|_| inputs(args, &text)).transpose()?;
    let beside = args.report.as_ref().filter(|_| args.lab);
    let lab = beside.map(|report| lab::beside(report, &bat, &text)).transpose()?;
    let hits = Request { theory: solution.theory, ..args.solve.request(modes) };
    let proof = args.solve.request(args.solve.modes_within(solution.modes.len().max(MODES), 1));
    let task = Task { model, scene, law, hits, proof, readings: readings(args, &bat) };
    let tell = |share: f64, what: &str| progress.say(share, what);
    let analysis = Analysis::telling(bat, solution, task, &tell)?;
    let lathe = match args.output.full || args.plots.is_some() || args.report.is_some() {
        true => lathe(args, &analysis)?,
        false => None,
    };
    drop(progress);
    let answer = AnalysisOutput { args, analysis, proven, lathe };
    answer.write(inputs, lab)?;
    let code = answer.verdict();
    let text = args.output.deliver(answer.screen(), || answer.document())?;
    let warning = warning.or(of_theory.filter(|_| !args.output.quiet));
    Ok(Done::new(text, code).with(warning))
}

/// The errors of the bat's readings: the given ones, else the usual ones.
fn readings(args: &Args, bat: &Bat) -> Readings {
    let usual = Readings::of(bat);
    let diameter = args.calipers.unwrap_or(usual.diameter);
    Readings { diameter, length: args.rule, mass: args.scale, ..usual }
}

/// The end of a short answer.
const MORE: &str = "Everything else: --full; on a page to look at: --report FILE.html";

/// Lines of a proof on a screen: its heads, and the modes of the answers.
const FEW: usize = 5;

/// The effect of a cut, in wide bands, for the same hits.
fn lathe(args: &Args, analysis: &Analysis) -> Result<Option<LatheMap>> {
    let Task { model, scene, hits, .. } = &analysis.task;
    let hit = HitTerms { scene: scene.clone(), model: *model, exactly: args.bat.asked() };
    LatheMap::in_short(&analysis.bat, hits, &hit)
}

/// The error of a reading.
fn reading(of: &Use, text: &str) -> std::result::Result<f64, String> {
    let value = of.read(text)?;
    match value >= 0.0 && of.has(value) {
        true => Ok(value),
        false => Err(format!("found {text}, expected {}", of.range())),
    }
}

/// The files as the report shows them.
fn inputs(args: &Args, bat: &str) -> Result<Vec<Input>> {
    let mut all = Input::of_bat(args.bat.path(), bat)?;
    all.extend(args.scene.ball_file().map(Input::read).transpose()?);
    Ok(all)
}

/// The results for a bat.
struct AnalysisOutput<'a> {
    args: &'a Args,
    analysis: Analysis,
    /// The proof for its modes, if it was asked for.
    proven: Option<Proven>,
    /// The effect of a cut, if it is shown.
    lathe: Option<LatheMap>,
}

impl AnalysisOutput<'_> {
    /// The exit code, after a warning about results that are less accurate than asked.
    fn verdict(&self) -> u8 {
        let Args { solve, output, .. } = self.args;
        let code = match &self.proven {
            Some(proven) => guarantee::verdict(proven, solve, output),
            None => solve.verdict(&self.analysis.solution, output),
        };
        code.max(hit_verdict(solve, &self.analysis.hits, output))
    }

    /// The printed text: a screen or everything, the proof, and the files written for people.
    fn screen(&self) -> String {
        let Self { args, analysis, .. } = self;
        let units = args.output.units(&analysis.bat);
        let proof = self.proven.as_ref().map_or(String::new(), proven::text);
        let written = [&args.report, &args.plots, &args.out].into_iter().flatten();
        let written: String = written.map(|path| format!("  {}\n", printed(path))).collect();
        let written = if written.is_empty() { written } else { format!("Wrote:\n{written}") };
        if args.output.full {
            let cuts = self.lathe.as_ref().map(|map| report::lathe::in_short(map, units));
            let more = [cuts.unwrap_or_default(), proof, written].into_iter();
            let more = more.filter(|told| !told.is_empty()).map(|told| format!("\n{told}"));
            return everything(analysis, &args.output) + &more.collect::<String>();
        }
        let [answers, trust] = trust::screen(analysis, units);
        let few: String = proof.lines().take(FEW).map(|line| format!("{line}\n")).collect();
        let more = analysis.barrel.as_ref().and_then(report::hoop::in_a_line);
        let room = LINES.saturating_sub(written.lines().count());
        let screen = Screen::from([(0, "", answers), (1, "", trust), (0, "", few)]);
        screen.fitted(room, "", more.as_deref().unwrap_or(MORE)) + &written
    }

    /// All results in one document.
    fn document(&self) -> Written<AnalysisFile> {
        Written::of(AnalysisFile {
            modes: self.modes(),
            hit: self.hit(),
            strength: self.analysis.strength.clone(),
            open: trust::open(&self.analysis),
            hoop: self.hoop(),
        })
    }

    fn modes(&self) -> ModesFile {
        let Analysis { bat, solution, .. } = &self.analysis;
        let timing = !self.args.reproducible;
        let mut document = json::modes(bat, solution, ShapePoints::Even(101), timing);
        self.proven.iter().for_each(|proven| proven::write(&mut document, proven));
        document
    }

    fn hit(&self) -> HitFile {
        let Analysis { bat, task, hits, figures, .. } = &self.analysis;
        HitFile {
            figures: Some(hit_json::figures(figures)),
            ..hit_json::hit(bat, task.model, &task.scene, &hits.impacts, &figures.spot)
        }
    }

    fn hoop(&self) -> Option<Written<HoopFile>> {
        const SAMPLES: usize = 41;
        let barrel = self.analysis.barrel.as_ref()?;
        Some(hoop::document(&self.analysis.bat, barrel, &[], SAMPLES))
    }

    /// Writes the requested files: the folder of documents, the pictures, the report with those files.
    fn write(&self, inputs: Option<Vec<Input>>, live: Option<String>) -> Result<()> {
        let Self { args, analysis, lathe, .. } = self;
        let lathe = lathe.as_ref();
        if let Some(folder) = &args.out {
            make(folder)?;
            let write = |name: &str, text: String| file::write(&folder.join(name), text.as_bytes());
            write("modes.json", schema::text(&self.modes()))?;
            write("hit.json", schema::text(&self.hit()))?;
            if let Some(hoop) = self.hoop() {
                write("hoop.json", schema::text(&hoop))?;
            }
            write("curve.csv", csv::impacts(&columns::CURVE, &analysis.hits.impacts))?;
        }
        let drawn = |sheet| sets::of_analysis(sheet, analysis, lathe);
        draw(&args.plots, args.output.quiet, || drawn(args.output.sheet(&analysis.bat)))?;
        if let Some((path, inputs)) = args.report.as_ref().zip(inputs) {
            let us = args.output.sheet(&analysis.bat).us;
            let report = Report::new(analysis, command_line(), inputs, lathe)?;
            page::file::write(path, &Report { us, lab: live, ..report })?;
        }
        Ok(())
    }
}

/// The nodes of the first three modes and the sweet spot.
fn rows(analysis: &Analysis) -> Vec<SketchRow> {
    let mut rows = sketch::of_modes(&analysis.bat, &analysis.solution);
    // The balance point is the last row.
    rows.drain(3.min(rows.len() - 1)..rows.len() - 1);
    rows.extend(sketch::of_sweet_spot(&analysis.figures.spot));
    rows
}

/// Everything, on several screens.
fn everything(analysis: &Analysis, output: &OutputArgs) -> String {
    let Analysis { bat, solution, task, hits, figures, barrel, .. } = analysis;
    let units = output.units(bat);
    let few: Vec<_> = hits.impacts.iter().step_by(10).cloned().collect();
    let barrel = barrel.iter().map(|one| format!("\n{}", report::hoop::in_short(one, units)));
    let mut modes = vec![Part::Table(tables::modes(bat, solution, units))];
    modes.extend(damped::parts(solution));
    modes.push(Part::Heading("Nodes"));
    modes.push(Part::List(tables::nodes(bat, solution, 3, units)));
    let why = [hit_text::reason(figures, units), hit_text::beyond(hits, &task.scene, units)];
    let spot = tables::sweet_spot(bat, &figures.spot, units).into_iter();
    let spot: Vec<Part> = spot.chain(why.into_iter().flatten().map(Part::Text)).collect();
    format!(
        "{}\n{}{}{}\n{}{}{}\n{}{}\n{}{}{}\n{}{}",
        text::summary(bat, units),
        output.sketch(bat, &rows(analysis)),
        terminal::parts(&modes),
        trust::text(analysis, units),
        text::model(bat, solution),
        wrapped(&format!("Proof: {}", accuracy::proof(analysis)), 7),
        advice(analysis),
        hit_text::scene(bat, &task.scene, task.model, units),
        terminal::parts(&tables::impacts(bat, &few, units)),
        hit_text::curve(&hits.impacts, units),
        terminal::parts(&spot),
        terminal::parts(&[Part::Table(tables::figures(figures, units))]),
        aftermath::strengths(&analysis.strength, units),
        barrel.collect::<String>(),
    )
}

/// A summary of the model that the bat needs.
fn advice(analysis: &Analysis) -> String {
    match &analysis.advice {
        Some(found) => advice::short(found),
        None => "Advice: sweetspot advise has it\n".to_owned(),
    }
}
