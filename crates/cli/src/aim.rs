//! `sweetspot aim BAT AIM`: the least change of a bat that meets a wish.

use std::path::{Path, PathBuf};

use sweetspot::base::error::Complaint;
use sweetspot::base::{file, typed};
use sweetspot::collision::setup::Setup;
use sweetspot::collision::sweet_spot::FINE;
use sweetspot::{Bat, Error, Result};
use sweetspot_report::plot::{Picture, Sheet, change, compared};
use sweetspot_report::report::{aimed, aimed_text};
use sweetspot_report::template::pages::pages;
use sweetspot_report::template::pdf::pdf;
use sweetspot_report::template::sheet::PAPERS;
use sweetspot_study::aim::aimed::Outcome;
use sweetspot_study::aim::bench::Terms;
use sweetspot_study::aim::wish::{FreeChoice, SLOPES, Wish};
use sweetspot_study::comparison::contender::Terms as Looks;
use sweetspot_study::comparison::table::{Comparison, Entry};
use sweetspot_study::files::aim_file::AimFile;
use sweetspot_study::files::{aim_text, rules_file};
use sweetspot_study::lathe::workpiece::HitTerms;

use crate::common::{BatFileArgs, Prepared, SolveArgs, about, as_options, examples, note_outside};
use crate::done::{Done, NOT_REACHED};
use crate::output::{LINES, OutputArgs, apart, draw, make, put};
use crate::scene::{self, SceneArgs};
use crate::value::LITTLE;

/// The least change of a bat that meets a wish: where to cut, at what price
///
/// Finds the smallest smooth change of the diameter with which the bat meets the targets, under limits and rules, and
/// writes the new bat with rounded stations. All values in the answer are those of the written file. It also gives the
/// cost of a little more of each target. If the targets cannot be met together, it names those that conflict and how
/// close each can come (exit code 3; the nearest bat is written). Both bats are swung at one speed unless
/// --reference-inertia is given: most answers depend on that.
#[derive(clap::Args)]
#[command(after_long_help = examples("aim"))]
pub struct Args {
    #[command(flatten)]
    bat: BatFileArgs,

    /// Aim file (JSON): targets, rules, limits; options add to it
    aim: Option<PathBuf>,

    /// A target, such as "swing weight -3 %"; may be repeated
    ///
    /// First the output (sweet spot, swing weight, mass, balance point, f1, node 1, best ball, bbcor, drop, or the name
    /// of any output), then its change ("-3 %", "1 cm outward", "+2 Hz", "same"), its value ("180 Hz", "6.5 in from the
    /// tip"), or a limit ("at most 31 oz", "at least 99.5 %"). "within 0.5 Hz" after a change or a value sets its
    /// tolerance. "lose 1 oz", "1 oz lighter" and "keep pop" are understood too. "drop -3" and "drop 3" are the same:
    /// three ounces fewer than inches.
    #[arg(long = "target", value_name = "TARGET", allow_hyphen_values = true)]
    targets: Vec<String>,

    /// Only take wood off
    #[arg(long)]
    remove_only: bool,

    /// Wood may be added to a bat that was weighed, which otherwise is only cut
    #[arg(long, conflicts_with = "remove_only")]
    add: bool,

    /// A stretch that stays as it is, such as "0 to 30 mm"; may be repeated [default: the knob, 0 to 30 mm]
    #[arg(long, value_name = "STRETCH")]
    keep: Vec<String>,

    /// A limit of the diameter, such as "4 in to 18 in, at least 24 mm"; may be repeated
    #[arg(long, value_name = "LIMIT")]
    diameter: Vec<String>,

    /// The greatest slope of the changed surface, such as 0.25: radius over length
    #[arg(long, value_name = "SLOPE", value_parser = slope)]
    slope: Option<f64>,

    /// Rules of a game: mlb, ncaa, ncaa-wood, nfhs, nfhs-wood, usa-baseball, softball, or a rule file
    #[arg(long, value_name = "RULES")]
    rules: Option<String>,

    /// A further change that is allowed; may be repeated
    ///
    /// "length 32 in to 34 in" (everything on the bat moves with it), "density 600 kg/m^3 to 700 kg/m^3", "wood NAME,
    /// NAME" (the one that needs the least change), "knob weight 2 oz" (up to that weight).
    #[arg(long, value_name = "CHOICE")]
    free: Vec<String>,

    /// Distance between the written stations [default: 10 mm; 0.5 in for a bat in inches]
    #[arg(long, value_name = "m", value_parser = spacing)]
    stations: Option<f64>,

    /// Step to which diameters are rounded [default: 0.1 mm; 0.005 in for a bat in inches]
    #[arg(long, value_name = "m", value_parser = spacing)]
    round: Option<f64>,

    /// Write the new bat into this file
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    out: Option<PathBuf>,

    /// Write the cut list of every station into this CSV file (- = standard output, and no table then)
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    cuts: Option<PathBuf>,

    /// Most that one pass of the lathe takes off the diameter
    #[arg(long, value_name = "m", default_value = "1 mm", value_parser = spacing,
          help_heading = "Output")]
    pass: f64,

    /// Write a full-size template of the new bat into this folder: PDF and SVG, for A4 and letter
    #[arg(long, value_name = "DIR", help_heading = "Output")]
    template: Option<PathBuf>,

    /// Draw before and after into this folder, as SVG and PNG: profiles and their difference, modes, exit
    /// speeds, energies, the hands' motion
    #[arg(long, value_name = "DIR", help_heading = "Output")]
    plots: Option<PathBuf>,

    #[command(flatten)]
    scene: SceneArgs,

    #[command(flatten)]
    solve: SolveArgs,

    #[command(flatten)]
    output: OutputArgs,
}

/// A length above 0.
fn spacing(text: &str) -> std::result::Result<f64, String> {
    match LITTLE.read(text)? {
        value if value > 1e-7 && value <= 0.1 => Ok(value),
        _ => Err("expected a length above 0, 100 mm at most".to_owned()),
    }
}

/// A slope that a tool can follow.
fn slope(text: &str) -> std::result::Result<f64, String> {
    let value = typed::number(text).filter(|value| SLOPES.contains(value));
    value.ok_or_else(|| "expected a slope from 0.01 to 10".to_owned())
}

pub fn run(args: &Args) -> Result<Done> {
    apart(&[("--json", &args.output.json), ("--cuts", &args.cuts), ("--out", &args.out)])?;
    args.solve.refuse_budget("aim")?;
    let aim_file = args.aim.as_deref().map(AimFile::named_by_a_person).transpose()?;
    let aim_file = aim_file.map(|(aim_file, outside)| {
        args.aim.iter().for_each(|file| note_outside(file, &outside, args.output.quiet));
        aim_file
    });
    let wish = wish(args, aim_file.as_ref())?;
    let bat = args.bat.read(args.output.quiet)?;
    let Prepared { bat, request, warning } = args.solve.prepare(bat, 10, &args.output)?;
    let (setup, model) = args.scene.setup()?;
    let (scene, law) = setup.scene(&bat, Some(request.tolerance)).map_err(as_options)?;
    scene::warn(&setup, [&bat], &args.output);
    let hit = HitTerms { scene: scene.clone(), model, exactly: false };
    let terms = Terms { request, hit, law };
    let placed = |error: Error| placed(error, aim_file.as_ref(), args);
    let progress = args.output.progress("the least change");
    let outcome = Outcome::of(&bat, &wish, &terms).map_err(placed)?;
    // The answer describes the file as it is read back.
    let text = aimed::bat_text(&outcome);
    let written = Bat::from_text("the new bat", &text, Path::new(""))?;
    let outcome =
        outcome.read_back(written.with(|parts| parts.inches = bat.inches())?, &wish, &terms)?;
    drop(progress);
    draw(&args.plots, args.output.quiet, || {
        drawn(args.output.sheet(&outcome.start), &setup, &outcome, &terms)
    })?;
    if let Some(folder) = &args.template {
        template(folder, &outcome)?;
    }
    if let Some(path) = &args.out {
        file::write(path, text.as_bytes())?;
    }
    let us = args.output.units(&bat).us_first();
    let table = args.output.screen(LINES, |full| aimed_text::text(&outcome, (args.pass, us, full)));
    let table = put(&args.cuts, table, || Ok(aimed::cuts_csv(&outcome, args.pass)))?;
    let text = args.output.deliver(table, || aimed::document(&outcome, args.pass))?;
    Ok(Done::new(text, if outcome.met { 0 } else { NOT_REACHED }).with(warning))
}

/// The wish of the file, extended by the options.
fn wish(args: &Args, aim_file: Option<&AimFile>) -> Result<Wish> {
    let mut wish = aim_file.map_or_else(Wish::default, |file| file.wish.clone());
    let option = |option: &'static str| move |complaint| about(option, complaint);
    for text in &args.targets {
        wish.targets.push(aim_text::target(text).map_err(option("--target"))?);
    }
    if aim_file.is_none() && !args.keep.is_empty() {
        wish.keep.clear();
    }
    for text in &args.keep {
        wish.keep.push(aim_text::stretch(text).map_err(option("--keep"))?);
    }
    for text in &args.diameter {
        wish.diameter.push(aim_text::diameter(text).map_err(option("--diameter"))?);
    }
    let mut free: FreeChoice = wish.free.clone();
    for text in &args.free {
        aim_text::free(text, &mut free).map_err(option("--free"))?;
    }
    wish.free = free;
    if let Some(name) = &args.rules {
        let rules = rules_file::named(name);
        wish.rules = Some(rules.map_err(|error| error.placed(option("--rules")))?);
    }
    wish.remove_only = (wish.remove_only || args.remove_only) && !args.add;
    wish.add |= args.add;
    wish.stations = args.stations.or(wish.stations);
    wish.round = args.round.or(wish.round);
    wish.slope = args.slope.or(wish.slope);
    Ok(wish)
}

/// An error about the wish at its place in the aim file, or at its option.
fn placed(error: Error, aim_file: Option<&AimFile>, args: &Args) -> Error {
    let of_file = aim_file.map_or([0; 3], |file| {
        [file.wish.targets.len(), file.wish.diameter.len(), file.wish.keep.len()]
    });
    let place = |complaint: Complaint| {
        let number = |key: &str| {
            let rest = complaint.field.strip_prefix(key)?.strip_prefix('[')?;
            rest.split_once(']')?.0.parse::<usize>().ok()
        };
        let options = [
            ("targets", "--target", of_file[0], &args.targets),
            ("diameter", "--diameter", of_file[1], &args.diameter),
            ("keep", "--keep", of_file[2], &args.keep),
        ];
        for (key, option, from, said) in options {
            if let Some(text) = number(key).and_then(|k| said.get(k.checked_sub(from)?)) {
                return about(format!("{option} \"{text}\""), complaint);
            }
        }
        let field = complaint.field.clone();
        match aim_file.filter(|_| field.starts_with(|c: char| "tdkr".contains(c))) {
            Some(file) => file.placed(Error::Value(complaint)),
            None => Error::Value(complaint),
        }
    };
    error.placed(place)
}

/// Pictures of both bats side by side, and of the difference of their diameters.
fn drawn(sheet: Sheet, setup: &Setup, outcome: &Outcome, terms: &Terms) -> Result<Vec<Picture>> {
    let entry = |bat: &Bat| -> Result<Entry> {
        let (scene, _) = setup.scene(bat, Some(terms.request.tolerance)).map_err(as_options)?;
        Ok(Entry { bat: bat.clone(), scene, law: terms.law, request: terms.request })
    };
    let looks = Looks {
        model: terms.hit.model,
        exactly: false,
        every: 0.0254,
        look: FINE,
        barrel: setup.barrel_speed(),
    };
    let compared_bats = Comparison::new(vec![entry(&outcome.start)?, entry(&outcome.bat)?], looks)?;
    let mut all = vec![change::picture(sheet, &outcome.start, &outcome.bat)];
    all.extend(compared::pictures(sheet, &compared_bats)?);
    Ok(all)
}

/// The template's files.
fn template(folder: &Path, outcome: &Outcome) -> Result<()> {
    make(folder)?;
    for paper in PAPERS {
        let pages = pages(&outcome.bat, &outcome.start, paper);
        let name = |rest: String| folder.join(format!("template_{}{rest}", paper.name));
        file::write(&name(".pdf".to_owned()), &pdf(&pages))?;
        for (k, page) in pages.iter().enumerate() {
            file::write(&name(format!("_{}.svg", k + 1)), page.svg().as_bytes())?;
        }
    }
    Ok(())
}
