//! `sweetspot hit BAT`: the collision along the barrel.

use sweetspot::base::units::{inches, shown_length};
use sweetspot::collision::figures::Figures;
use sweetspot::collision::sweep::{RoundsEnd, Trial, sweep_telling};
use sweetspot::collision::{Hitter, Sweep};
use sweetspot::modes::solve::Ending;
use sweetspot::{Bat, Error, Result};
use sweetspot_report::csv;
use sweetspot_report::parts::{Part, terminal, wrapped};
use sweetspot_report::plot::profile;
use sweetspot_report::plot::sets::Hits;
use sweetspot_report::plot::subject::Subject;
use sweetspot_report::report::{hit_json, hit_text, sketch, tables, trust};
use sweetspot_report::schema::hit::HitFile;
use sweetspot_study::verdict::Verdict;

use crate::common::{BatArgs, Prepared, SolveArgs, as_options, examples, on_the_bat};
use crate::done::Done;
use crate::output::{AnswerArgs, FullArgs, MANY, drawing};
use crate::scene::{self, SceneArgs};
use crate::value::PLACE;

/// Exit speeds of the ball along the barrel, and the sweet spot
///
/// Hits the barrel with a ball at many places. For each place the table gives the speed of the bat there, the exit
/// speed of the ball, the exit speed from a bat that does not bend, the collision efficiency e_A and the energy left in
/// vibration. Below it are the sweet spot by every definition and the reason for its place. With --full also: every
/// place, a sketch, BBCOR, the cost of an inch off, and how the sweet spot moves with swing and pitch. Places given by
/// --points or --at are all shown. --tol is here the error of an exit speed over the closing speed.
#[derive(clap::Args)]
#[command(after_long_help = examples("hit"), mut_arg("plots", drawing("the bat, exit speed and energy along it, force, compression and the motion of the hands")))]
pub struct Args {
    #[command(flatten)]
    bat: BatArgs,

    #[command(flatten)]
    scene: SceneArgs,

    #[command(flatten)]
    place: PlaceArgs,

    #[command(flatten)]
    solve: SolveArgs,

    #[command(flatten)]
    output: AnswerArgs,
}

/// The places where the ball meets the bat; all positions from the knob end.
#[derive(clap::Args)]
#[command(next_help_heading = "The hit")]
pub struct PlaceArgs {
    /// First impact point [default: half the length]
    #[arg(long, value_name = "m", value_parser = PLACE, conflicts_with = "at")]
    from: Option<f64>,

    /// Last impact point [default: the tip]
    #[arg(long, value_name = "m", value_parser = PLACE, conflicts_with = "at")]
    to: Option<f64>,

    /// Number of impact points, both ends included [default: 101]
    #[arg(long, value_name = "N", conflicts_with = "at",
          value_parser = clap::value_parser!(u32).range(1..=100_000))]
    points: Option<u32>,

    /// One impact point
    #[arg(long, value_name = "m", value_parser = PLACE)]
    at: Option<f64>,
}

impl PlaceArgs {
    /// The impact points on this bat (m).
    fn places(&self, bat: &Bat) -> Result<Vec<f64>> {
        if let Some(x) = self.at {
            return Ok(vec![on_the_bat(bat, "--at", x)?]);
        }
        let from = on_the_bat(bat, "--from", self.from.unwrap_or(0.5 * bat.length()))?;
        let to = on_the_bat(bat, "--to", self.to.unwrap_or(bat.length()))?;
        if to < from {
            let expected = format!("a place beyond --from, {}", shown_length(from));
            return Err(Error::value("--to", shown_length(to), expected));
        }
        let points = self.points.unwrap_or(101);
        let last = f64::from(points.max(2) - 1);
        let place = |k: u32| (from + (to - from) * f64::from(k) / last).min(to);
        Ok((0..points).map(place).collect())
    }

    /// Whether the user gave a number of places, or a place.
    fn asked(&self) -> bool {
        self.points.is_some() || self.at.is_some()
    }
}

pub fn run(args: &Args) -> Result<Done> {
    args.output.apart(&[])?;
    let bat = args.bat.read(&args.output)?;
    let (setup, model) = args.scene.setup()?;
    args.solve.refuse_budget("hit")?;
    let prepared = args.bat.prepare(bat, args.bat.count(), &args.solve, &args.output)?;
    let Prepared { bat, request, warning } = prepared;
    let tolerance = (!args.bat.asked()).then_some(request.tolerance);
    let (scene, law) = setup.scene(&bat, tolerance).map_err(as_options)?;
    scene::warn(&setup, [&bat], &args.output);
    let places = args.place.places(&bat)?;
    let progress = args.output.progress("modes");
    let tell = |share, what: &str| progress.say(share, what);
    let trial = Trial { model, scene: &scene };
    let accuracy = trial.accuracy(&request, args.bat.asked());
    let sweep = sweep_telling(&bat, trial, &accuracy, &places, &tell)?;
    args.solve.say_raised(&sweep.solution, &args.output);
    progress.say(1.0, "the sweet spot");
    let hitter = Hitter::new(model, &scene, &bat, &sweep.solution, sweep.effort)?;
    let figures = Figures::new(&bat, &hitter, law)?;
    let drawn = |sheet| {
        let subject = Subject { name: bat.name(), bat: &bat, drawn: Some(scene.pivot) };
        let hits = Hits { bat: &bat, model, scene: &scene, sweep: &sweep, spot: &figures.spot };
        let hits = hits.pictures(sheet, args.place.at)?;
        Ok([profile::picture(sheet, &[subject])].into_iter().chain(hits))
    };
    let table = table(args, &bat, trial, &sweep, &figures);
    let document = || HitFile {
        figures: Some(hit_json::figures(&figures)),
        ..hit_json::hit(&bat, model, &scene, &sweep.impacts, &figures.spot)
    };
    let code = verdict(&args.solve, &sweep, &args.output);
    let rows = || csv::hits(&sweep.impacts);
    let text = args.output.answer((&bat, table), drawn, document, rows)?;
    drop(progress);
    Ok(Done::new(text, code).with(warning))
}

/// The printed text: a screen, or everything.
fn table(args: &Args, bat: &Bat, trial: Trial, sweep: &Sweep, figures: &Figures) -> String {
    let Trial { model, scene } = trial;
    let units = args.output.units(bat);
    let known = Verdict::of((bat, scene), sweep, figures.best.as_ref(), figures.wall);
    let doubts = trust::doubts(&known, units);
    let doubts: String = doubts.iter().map(|doubt| wrapped(doubt, 0)).collect();
    let above = hit_text::scene(bat, scene, model, units);
    let most = if args.place.points.is_some() { usize::MAX } else { MANY };
    args.output.screen(most, |full| {
        let best = figures.spot.exit_speed_max.map(|peak| peak.x);
        let shown = match full || args.place.asked() {
            true => &sweep.impacts,
            false => &hit_text::some(&sweep.impacts, best),
        };
        let shown = terminal::parts(&tables::impacts(bat, shown, units));
        let [mut sketch, mut more] = [const { String::new() }; 2];
        if full {
            sketch = format!("\n{}", args.output.sketch(bat, &sketch::of_hit(bat, &figures.spot)));
            let tables = [tables::figures(figures, units), tables::moves(bat, figures, units)];
            more = terminal::parts(&tables.map(Part::Table));
        }
        let spot = terminal::parts(&tables::sweet_spot(bat, &figures.spot, units));
        let why = [hit_text::reason(figures, units), hit_text::beyond(sweep, scene, units)];
        let [why, beyond] = why.map(|text| text.map_or(String::new(), |text| wrapped(&text, 0)));
        [
            (0, "", format!("{above}{shown}{sketch}{spot}")),
            (2, "why there", why),
            (3, "modes left out", beyond),
            (1, "trust", doubts.clone() + trust::IN_ANALYZE),
            (0, "", more),
        ]
    })
}

/// The exit code, after a warning about exit speeds that are less accurate than asked.
pub fn verdict(solve: &SolveArgs, sweep: &Sweep, output: &FullArgs) -> u8 {
    if sweep.met() || !solve.enforced() {
        return 0;
    }
    let reason = match &sweep.solution.ending {
        Ending::Reached => String::new(),
        // Modes are computed far more accurately than hits need: round-off below the request does not matter.
        Ending::RoundOff(share) if *share <= solve.tol => format!(" ({})", Ending::Stalled),
        ending => format!(" ({ending})"),
    };
    let worst = sweep.worst().map_or(String::new(), |(impact, outcome)| {
        let limit = match sweep.end {
            _ if outcome.wall > 0.5 * outcome.error => {
                ": the wall's compliance is as accurate as this --tol makes it; 1e-5 is best"
            }
            RoundsEnd::Stopped => {
                ": stopped there, as a better one would take more than ten times as long as a usual hit; fewer \
                 places get better ones"
            }
            RoundsEnd::Met | RoundsEnd::Settled => "",
            RoundsEnd::Unsettled => {
                ": the hit there magnifies small changes, and neither more modes nor finer \
                 steps settle it"
            }
        };
        let place = format!("{:.1} cm ({:.1} in)", 100.0 * impact.x, inches(impact.x));
        format!("; the worst is known to {:.1e}, at {place} from the knob{limit}", outcome.error)
    });
    output.reached(Some(format!(
        "accuracy of the exit speeds not reached{reason}{worst}; error.exit_speed of every impact says \
         how far it is known"
    )))
}
