//! `sweetspot hit BAT`: the collision along the barrel.

use std::path::PathBuf;

use sweetspot::bat::Bat;
use sweetspot::collision::hit::{Hitter, Impact, Model, Scene};
use sweetspot::collision::sweet_spot::SweetSpot;
use sweetspot::error::{Error, Result};
use sweetspot::plan::{self, Solution};
use sweetspot::report::{json, text};
use sweetspot::units::Quantity;

use crate::cli::common::{OutputArgs, SceneArgs, SolveArgs, quantity, shown_length};
use crate::cli::{Done, NOT_REACHED};

/// The collision along the barrel: exit speeds, energies, the sweet spot
///
/// Example: sweetspot hit meshes/r161.json --swing-speed "50 rad/s" --pitch "90 mph" --points 21
#[derive(clap::Args)]
pub struct Args {
    /// Bat file (JSON)
    bat: PathBuf,

    /// Number of bending modes that count (energy-loss: 10)
    #[arg(short = 'n', long = "modes", value_name = "N", default_value = "10",
          value_parser = clap::value_parser!(u16).range(0..=1000))]
    count: u16,

    #[command(flatten)]
    scene: SceneArgs,

    #[command(flatten)]
    place: PlaceArgs,

    #[command(flatten)]
    solve: SolveArgs,

    #[command(flatten)]
    output: OutputArgs,
}

/// Where the ball meets the bat; all positions from the knob end.
#[derive(clap::Args)]
pub struct PlaceArgs {
    /// First impact point (default: half the length)
    #[arg(long, value_name = "X", allow_hyphen_values = true,
          value_parser = |s: &str| quantity(s, Quantity::Length), conflicts_with = "at")]
    from: Option<f64>,

    /// Last impact point (default: the tip)
    #[arg(long, value_name = "X", allow_hyphen_values = true,
          value_parser = |s: &str| quantity(s, Quantity::Length), conflicts_with = "at")]
    to: Option<f64>,

    /// Number of impact points, both ends included
    #[arg(long, value_name = "N", default_value = "101", conflicts_with = "at",
          value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    points: u32,

    /// One impact point
    #[arg(long, value_name = "X", allow_hyphen_values = true,
          value_parser = |s: &str| quantity(s, Quantity::Length))]
    at: Option<f64>,
}

impl PlaceArgs {
    /// The impact points on this bat (m).
    fn places(&self, bat: &Bat) -> Result<Vec<f64>> {
        let length = bat.length();
        let on_the_bat = |name: &str, x: f64| {
            // A tip given in inches may be a rounding beyond the last station.
            if (0.0..=length * (1.0 + 4.0 * f64::EPSILON)).contains(&x) {
                Ok(x.min(length))
            } else {
                let expected = format!("a place on the bat, 0 to {}", shown_length(length));
                Err(Error::value(name, shown_length(x), expected))
            }
        };
        if let Some(x) = self.at {
            return Ok(vec![on_the_bat("--at", x)?]);
        }
        let from = on_the_bat("--from", self.from.unwrap_or(0.5 * length))?;
        let to = on_the_bat("--to", self.to.unwrap_or(length))?;
        if to < from {
            let expected = format!("a place beyond --from, {}", shown_length(from));
            return Err(Error::value("--to", shown_length(to), expected));
        }
        let last = f64::from(self.points.max(2) - 1);
        Ok((0..self.points).map(|k| from + (to - from) * f64::from(k) / last).collect())
    }
}

/// The impacts along a bat, and its sweet spot.
pub struct Sweep {
    pub solution: Solution,
    pub impacts: Vec<Impact>,
    pub spot: SweetSpot,
    /// Whether every exit speed is within the tolerance by its own estimate.
    pub met: bool,
}

/// Strikes the bat at all places, with modes good enough for the tolerance on the exit speed.
pub fn sweep(
    bat: &Bat,
    model: Model,
    scene: &Scene,
    modes: usize,
    solve: &SolveArgs,
    places: impl Fn(&Bat) -> Result<Vec<f64>>,
) -> Result<Sweep> {
    let places = places(bat)?;
    let mut request = solve.request(modes);
    loop {
        let solution = plan::solve(bat, &request)?;
        let hitter = Hitter::new(model, scene, bat, &solution);
        let impacts: Vec<Impact> = places.iter().map(|x| hitter.strike(*x)).collect();
        let errors = impacts.iter().filter_map(|i| i.outcome.as_ref()).map(|o| o.error);
        let worst = errors.fold(0.0, f64::max);
        let met = worst <= solve.tol;
        if met || !solve.enforced() || request.tolerance < 1e-13 {
            let spot = SweetSpot::find(bat, scene, &solution, &hitter);
            return Ok(Sweep { solution, impacts, spot, met });
        }
        // The exit speed is more sensitive than the frequencies: ask these for more.
        request.tolerance *= (0.3 * solve.tol / worst).clamp(1e-6, 0.1);
    }
}

impl Sweep {
    /// One sentence: why the ball leaves fastest where it does.
    pub fn why(&self, bat: &Bat, scene: &Scene) -> String {
        let rigid = Hitter::new(Model::Rigid, scene, bat, &self.solution);
        let best = SweetSpot::find(bat, scene, &self.solution, &rigid).exit_speed_max;
        let (Some(peak), Some(rigid)) = (self.spot.exit_speed_max, best) else {
            return String::new();
        };
        let vibration = |x: f64| {
            let hitter = &self.impacts;
            let near = hitter.iter().min_by(|a, b| (a.x - x).abs().total_cmp(&(b.x - x).abs()));
            near.and_then(|i| i.outcome.as_ref()).map_or(0.0, |o| o.energy.vibration())
        };
        if self.spot.vibration_min.is_none() {
            return format!(
                "Why there: beyond {:.1} cm the bat recoils more than its tip speed makes up for.\n",
                100.0 * peak.x
            );
        }
        format!(
            "Why there: a bat that does not bend would be best at {:.1} cm; bending takes {:.1} J\n\
             there and {:.1} J at the sweet spot, which moves it {:.1} cm {}.\n",
            100.0 * rigid.x,
            vibration(rigid.x),
            vibration(peak.x),
            100.0 * (peak.x - rigid.x).abs(),
            if peak.x > rigid.x { "towards the tip" } else { "towards the handle" }
        )
    }
}

pub fn run(args: &Args) -> Result<Done> {
    let bat = args.output.read_bat(&args.bat)?;
    let (scene, model) = (args.scene.scene()?, args.scene.model()?);
    let places = |bat: &Bat| args.place.places(bat);
    let sweep = sweep(&bat, model, &scene, args.count.into(), &args.solve, places)?;
    args.solve.raised(&sweep.solution).iter().for_each(|note| args.output.warn(note));
    let units = args.output.units;
    let table = format!(
        "{}{}\n{}\n{}{}",
        text::scene(&scene, json::model_name(model), units),
        empirical(model),
        text::impacts(&bat, &sweep.impacts, units),
        text::sweet_spot(&bat, &sweep.spot, units),
        sweep.why(&bat, &scene)
    );
    let document = json::hit(&bat, model, &scene, &sweep.impacts, &sweep.spot);
    let missed = args.solve.enforced() && !sweep.met;
    if missed {
        args.output.warn("accuracy not reached: see error.exit_speed of every impact");
    }
    Ok((args.output.deliver(table, &document)?, if missed { NOT_REACHED } else { 0 }))
}

/// The label that an empirical model carries wherever it is printed.
pub fn empirical(model: Model) -> &'static str {
    match model {
        Model::Rigid => "     the bat does not bend in this model\n",
        Model::EnergyLoss(_) => {
            "     empirical: the loss to vibration is the WPI report's fit, not derived; it does\n     \
             not conserve energy (see energy_j.imbalance)\n"
        }
    }
}
