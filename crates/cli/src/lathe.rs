//! `sweetspot lathe BAT`: which cut has which effect?

use sweetspot::base::mistakes::Mistakes;
use sweetspot::base::units::shown_length;
use sweetspot::{Bat, Error, Request, Result};
use sweetspot_report::plot::lathe as plot;
use sweetspot_report::report::lathe as report;
use sweetspot_study::answers::Answer;
use sweetspot_study::lathe::map::{LatheMap, LatheTerms, bands, best_place};
use sweetspot_study::lathe::workpiece::HitTerms;

use crate::common::{BatArgs, Prepared, SolveArgs, as_options, examples, on_the_bat};
use crate::done::Done;
use crate::output::{AnswerArgs, MANY, Screen, drawing};
use crate::scene::{self, SceneArgs};
use crate::value::{LITTLE, PLACE, SPACING};

/// The effect of a millimetre off the diameter, inch by inch
///
/// Shows where a millimetre (or 1/32 in) off the diameter has the largest effect, which is the least cut for a wish,
/// and the computed effects of a knob weight, a cup, a hole and a cork. With --full, with a stretch in --bands, or with
/// --outputs or --depth, also a table of every band: mass, balance point, swing weight, frequencies, node, the fastest
/// ball for equal swing speed (n=0) and for equal energy of rotation (n=1/2), which differ in sign, the sweet spot, and
/// the motion at the hands; and a second table of the same for a finite cut. Frequencies and the rigid body follow from
/// formulas, all else from differences of whole bats.
#[derive(clap::Args)]
#[command(after_long_help = examples("lathe"), mut_arg("plots", drawing("the bat coloured by the effect of a cut, a strip for each output,")))]
pub struct Args {
    #[command(flatten)]
    bat: BatArgs,

    /// Width of the bands, or one band such as "60 cm to 63 cm"; may be repeated for several bands
    #[arg(long, value_name = "m", default_value = "1 in",
          allow_hyphen_values = true, value_parser = band, help_heading = "The map")]
    bands: Vec<BandArg>,

    /// Position of the hit for vibration and hands [default: the sweet spot]
    #[arg(long, value_name = "m", value_parser = PLACE, help_heading = "The map")]
    at: Option<f64>,

    /// Depth, in diameter, of the finite cut beside every derivative [default: 0.5 mm]
    #[arg(long, value_name = "m", value_parser = LITTLE, help_heading = "The map")]
    depth: Option<f64>,

    /// Show only these outputs, such as f1_hz,mass_kg,exit_speed_max.value
    ///
    /// The names are those of the JSON documents: mass_kg, balance_point_m, inertia_pivot_kg_m2,
    /// center_of_percussion_m, f1_hz, node_mode_1_m, modal_mass_mode_1_kg, exit_speed_max.value, exit_speed_max.x_m,
    /// zone_m[0], zone_m[1], vibration_min.value, vibration_min.x_m, bbcor_max, hands_velocity_min.value,
    /// hands_acceleration_min.value, and for a hit at a place exit_speed_m_s@0.70, vibration_j@0.70,
    /// hands_velocity_m_s@0.70, hands_acceleration_m_s2@0.70.
    #[arg(long, value_name = "NAMES", value_delimiter = ',',
          value_parser = |s: &str| Answer::named(s.trim()).map_err(|error| error.to_string()), help_heading = "The map")]
    outputs: Option<Vec<Answer>>,

    #[command(flatten)]
    scene: SceneArgs,

    #[command(flatten)]
    solve: SolveArgs,

    #[command(flatten)]
    output: AnswerArgs,
}

/// Depth of a cut that is computed in full (m).
const DEPTH: f64 = 0.5e-3;

/// The value of `--bands`: a width, or a stretch (m).
#[derive(Debug, Clone, Copy)]
enum BandArg {
    Width(f64),
    Stretch([f64; 2]),
}

fn band(text: &str) -> std::result::Result<BandArg, String> {
    match text.split_once(" to ") {
        Some((from, to)) => {
            let [from, to] = [from, to].map(|end| PLACE.read(end.trim()));
            let [from, to] = [from?, to?];
            if to > from {
                Ok(BandArg::Stretch([from, to]))
            } else {
                Err(format!("found a stretch from {from} m to {to} m, expected a rising one"))
            }
        }
        None => SPACING.read(text).map(BandArg::Width),
    }
}

pub fn run(args: &Args) -> Result<Done> {
    args.output.apart(&[])?;
    args.solve.refuse_budget("lathe")?;
    let bat = args.bat.read(&args.output)?;
    let (setup, model) = args.scene.setup()?;
    let prepared = args.bat.prepare(bat, args.bat.count(), &args.solve, &args.output)?;
    let Prepared { bat, request, warning } = prepared;
    let tolerance = (!args.bat.asked()).then_some(request.tolerance);
    let (scene, law) = setup.scene(&bat, tolerance).map_err(as_options)?;
    scene::warn(&setup, [&bat], &args.output);
    let (bands, cut) = stretches(args, &bat)?;
    let at = args.at.map(|x| on_the_bat(&bat, "--at", x)).transpose()?;
    let hit = HitTerms { scene, model, exactly: args.bat.asked() };
    let progress = args.output.progress("lathe");
    progress.say(0.0, "the sweet spot");
    // Outputs, a depth or a stretch imply the tables.
    let asked = args.outputs.is_some()
        || args.depth.is_some()
        || args.bands.iter().any(|band| matches!(band, BandArg::Stretch(_)));
    let answers = match &args.outputs {
        Some(asked) => asked.clone(),
        None if asked || args.output.in_full() => answers(&bat, &request, &hit, at)?,
        None => LatheMap::ON_A_SCREEN.to_vec(),
    };
    let exponent = law.map_or(0.0, |law| law.exponent);
    let terms = LatheTerms { bands, cut, exponent, answers };
    progress.say(0.0, "bats with a cut");
    let map = LatheMap::new(&bat, &request, Some(&hit), terms)?;
    drop(progress);
    let units = args.output.units(map.piece.bat());
    let screen = report::screen(&map, &hit.scene, units).filter(|_| !asked);
    let table = args.output.screen(MANY, |full| match screen.clone().filter(|_| !full) {
        Some(screen) => Screen::from(screen),
        None => {
            let [title, slopes, cuts, below] = report::text(&map, &hit.scene, units);
            let [slope, cut] = if args.depth.is_some() { [3, 1] } else { [1, 3] };
            let tables = [(slope, "derivatives", slopes), (cut, "finite cuts", cuts)];
            let [slopes, cuts] = tables;
            let below = (2, "what is solved", below);
            [(0, "", title), slopes, cuts, below].into()
        }
    });
    let drawn = |sheet| Ok(plot::picture(sheet, &map));
    let document = || report::document(&map, &hit.scene, model);
    let text = args.output.answer((&bat, table), drawn, document, || report::csv(&map))?;
    let unmet = (!map.piece.met && args.solve.enforced())
        .then_some("accuracy not reached: error of every change says how far it is known");
    let code = args.output.reached(unmet.map(str::to_owned));
    Ok(Done::new(text, code).with(warning))
}

/// The bands and the depth of the finite cut; all mistakes are reported at once.
fn stretches(args: &Args, bat: &Bat) -> Result<(Vec<[f64; 2]>, f64)> {
    let mut mistakes = Mistakes::default();
    let length = bat.length();
    let (mut widths, mut all) = (vec![], vec![]);
    for band in &args.bands {
        match band {
            BandArg::Width(width) => widths.push(*width),
            BandArg::Stretch(ends) => all.push(*ends),
        }
    }
    if !(widths.is_empty() || widths.len() == 1 && all.is_empty()) {
        let found = format!("{} width(s) and {} stretch(es)", widths.len(), all.len());
        mistakes.add(Error::value("--bands", found, "one width, or stretches alone"));
    }
    for ends in &mut all {
        ends[1] = mistakes.some(on_the_bat(bat, "--bands", ends[1])).unwrap_or(ends[1]);
    }
    all.sort_by(|a, b| a[0].total_cmp(&b[0]));
    if let Some(two) = all.windows(2).find(|two| two[1][0] < two[0][1] - 1e-12) {
        let found = format!("a band that begins at {}", shown_length(two[1][0]));
        let expected = format!(
            "bands that do not overlap: the one before ends at {}",
            shown_length(two[0][1])
        );
        mistakes.add(Error::value("--bands", found, expected));
    }
    if let ([width], true) = (&widths[..], all.is_empty()) {
        let width = *width;
        const NARROWEST: f64 = 1e-3;
        if (NARROWEST..=length).contains(&width) {
            all = bands(length, width);
        } else {
            let expected =
                format!("a width from 1 mm to the bat's length, {}", shown_length(length));
            mistakes.add(Error::value("--bands", shown_length(width), expected));
        }
    }
    let depth = args.depth.unwrap_or(DEPTH);
    if !(depth > 0.0 && depth <= 0.02) {
        let found = format!("{} mm", 1e3 * depth);
        mistakes.add(Error::value("--depth", found, "a depth above 0 and up to 20 mm"));
    }
    mistakes.end((all, depth))
}

/// The default outputs.
fn answers(bat: &Bat, request: &Request, hit: &HitTerms, at: Option<f64>) -> Result<Vec<Answer>> {
    /// Number of frequencies.
    const FREQUENCIES: usize = 5;
    let mut answers =
        vec![Answer::Mass, Answer::BalancePoint, Answer::Inertia, Answer::CenterOfPercussion];
    answers.extend((1..=FREQUENCIES).map(Answer::Frequency));
    answers.extend([1, 2].map(Answer::Node));
    answers.extend([1, 2].map(Answer::ModalMass));
    answers.extend([Answer::ExitSpeed, Answer::ExitSpeedPlace]);
    answers.extend([Answer::Zone(false), Answer::Zone(true)]);
    answers.extend([Answer::Vibration, Answer::VibrationPlace, Answer::Bbcor]);
    answers.extend([Answer::HandsVelocity, Answer::HandsAcceleration]);
    let at = match at {
        Some(at) => Some(at),
        None => best_place(bat, request, hit)?.map(|x| (1e4 * x).round() / 1e4),
    };
    if let Some(x) = at {
        answers.extend([Answer::ExitSpeedAt(x), Answer::VibrationAt(x)]);
        answers.extend([Answer::HandsVelocityAt(x), Answer::HandsAccelerationAt(x)]);
    }
    Ok(answers)
}
