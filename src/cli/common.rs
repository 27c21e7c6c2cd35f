//! Options that several verbs share.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Duration;

use serde_json::Value;
use sweetspot::bat::Bat;
use sweetspot::choice;
use sweetspot::collision::ball::{Ball, restitution};
use sweetspot::collision::energy_loss::EnergyLoss;
use sweetspot::collision::figures::SwingLaw;
use sweetspot::collision::hit::{Impact, Model, Scene, Wall};
use sweetspot::collision::pulse::Pulse;
use sweetspot::error::{Complaint, Error, Result, nearest};
use sweetspot::report::file;
use sweetspot::report::sketch::{self, Glyphs, Row};
use sweetspot::report::text::Units;
use sweetspot::solve::{self, Request, Solution, Solver};
use sweetspot::theory::Theory;
use sweetspot::units::{self, Quantity};
use sweetspot::up_to::modes_up_to;
use sweetspot::weighed;

use crate::cli::progress::{self, Progress};
use crate::cli::{NOT_REACHED, printable, style};

/// The end of a verb's help: commands to try, and how values are written.
pub fn examples(commands: &str) -> String {
    format!(
        "Examples:\n{commands}\n\nA bare number is in the unit that stands between < >; others are \
         written with it,\nsuch as \"28 in\", \"31 oz\", \"90 mph\" or \"0.75 ms\". Places count from \
         the knob end."
    )
}

/// Which bat, and how many of its modes.
#[derive(clap::Args)]
#[command(next_help_heading = "The bat")]
pub struct BatArgs {
    /// Bat file (JSON)
    bat: PathBuf,

    /// Number of bending modes [default: 10; in a hit as many as it needs]
    #[arg(short = 'n', long = "modes", value_name = "N",
          value_parser = clap::value_parser!(u16).range(0..=1000))]
    count: Option<u16>,

    /// All bending modes up to this frequency, such as 2000 or "2 kHz", in place of a number
    #[arg(long, value_name = "HZ", conflicts_with = "count", allow_hyphen_values = true,
          value_parser = |s: &str| quantity(s, Quantity::Frequency))]
    up_to: Option<f64>,
}

impl BatArgs {
    /// The bat's file.
    pub fn path(&self) -> &Path {
        &self.bat
    }

    /// Number of bending modes where no frequency was given.
    pub fn count(&self) -> usize {
        self.count.unwrap_or(10).into()
    }

    /// Whether a number or a frequency was asked for.
    pub fn asked(&self) -> bool {
        self.count.is_some() || self.up_to.is_some()
    }

    /// Reads the bat and passes its warnings on.
    pub fn read(&self, output: &OutputArgs) -> Result<Bat> {
        read(&self.bat, output.quiet)
    }

    /// Reads the bat and finds its modes.
    pub fn solve(&self, solve: &SolveArgs, output: &OutputArgs) -> Result<Solved> {
        self.solve_for(self.read(output)?, solve, output)
    }

    /// Finds the modes of a bat that was read.
    pub fn solve_for(&self, bat: Bat, solve: &SolveArgs, output: &OutputArgs) -> Result<Solved> {
        let prepared = self.prepare(bat, self.count(), solve, output)?;
        let Prepared { bat, request, warning } = prepared;
        let solution = match solve.budget {
            Some(budget) => solve::solve_within(&bat, &request, budget)?,
            None => solve::solve(&bat, &request)?,
        };
        solve.say_raised(&solution, output);
        Ok(Solved { bat, solution, warning })
    }

    /// The bat and what is asked of it: so many modes, or all up to the frequency that was given.
    pub fn prepare(
        &self,
        bat: Bat,
        mut modes: usize,
        solve: &SolveArgs,
        output: &OutputArgs,
    ) -> Result<Prepared> {
        let Some(limit) = self.up_to else { return solve.prepare(bat, modes, output) };
        // More modes may need a richer theory, and a richer theory has more modes up to there: the
        // number stays after as many rounds as there are theories.
        for _ in 0..=Theory::ALL.len() {
            let prepared = solve.prepare(bat.clone(), modes, output)?;
            let found = modes_up_to(&prepared.bat, &prepared.request, limit);
            let found = found.map_err(|error| named("--up-to", error))?;
            if found == modes {
                return Ok(prepared);
            }
            if found == 0 {
                let one = solve.prepare(bat.clone(), 1, output)?;
                let first = solve::solve(&one.bat, &one.request)?.modes[0].frequency();
                output.warn(&format!(
                    "note: no bending mode up to {limit} Hz: the first is at {first:.1} Hz"
                ));
                return solve.prepare(bat, 0, output);
            }
            modes = found;
        }
        solve.prepare(bat, modes, output)
    }
}

/// An error about a value, by the option that gave it.
fn named(option: &str, error: Error) -> Error {
    match error {
        Error::Value(complaint) if complaint.field == "frequency limit" => {
            Error::Value(Complaint { field: option.to_owned(), ..complaint })
        }
        other => other,
    }
}

/// How the modes are found.
#[derive(clap::Args)]
#[command(next_help_heading = "Accuracy")]
pub struct SolveArgs {
    /// Wanted relative accuracy, such as 1e-6 or 0.01%
    #[arg(long, value_name = "T", default_value = "1e-4", value_parser = tolerance)]
    pub tol: f64,

    /// Beam theory
    ///
    /// auto takes the simplest whose estimated shift of every frequency is within --tol. The others:
    /// euler-bernoulli (bending alone), rayleigh (and rotary inertia), timoshenko (and shear, which
    /// needs the material's shear modulus).
    #[arg(long, value_name = "THEORY", default_value = "auto", value_parser = theory)]
    theory: TheoryChoice,

    /// Total number of elements; the tolerance is then not enforced
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    elements: Option<u32>,

    /// Degree of the elements, 3 to 12
    ///
    /// Alone, there are as many elements as the tolerance needs; with --elements the default is 3.
    #[arg(long, value_name = "P", value_parser = clap::value_parser!(u8).range(3..=12))]
    degree: Option<u8>,

    /// The most accurate answer within this time, in place of --tol
    #[arg(long, value_name = "s", conflicts_with_all = ["tol", "elements"],
          value_parser = budget)]
    pub budget: Option<Duration>,

    /// Eigensolver: auto (statics), statics, dense, shift-invert or arpack
    #[arg(long, value_name = "NAME", default_value = "auto", value_parser = solver)]
    solver: Solver,
}

impl SolveArgs {
    pub fn request(&self, modes: usize) -> Request {
        let elements = self.elements.map(|n| n as usize);
        let degree = self.degree.map(usize::from);
        let theory = self.theory.0.unwrap_or_default();
        Request { modes, tolerance: self.tol, elements, degree, solver: self.solver, theory }
    }

    /// The same with the theory chosen for this bat, and the bat as stiff as it was tapped.
    pub fn prepare(&self, bat: Bat, modes: usize, output: &OutputArgs) -> Result<Prepared> {
        prepare(bat, self.theory, self.request(modes), output.quiet)
    }

    /// A time for the modes alone says nothing of a whole hit.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] if a budget was given.
    pub fn refuse_budget(&self, verb: &str) -> Result<()> {
        match self.budget {
            None => Ok(()),
            Some(budget) => {
                let expected = "it with modes or ring; here --tol sets the accuracy";
                Err(Error::value("--budget", format!("{budget:?} with {verb}"), expected))
            }
        }
    }

    /// Says where more elements were needed than asked for.
    pub fn say_raised(&self, solution: &Solution, output: &OutputArgs) {
        if let Some(asked) = self.elements.filter(|asked| (*asked as usize) < solution.mesh.len()) {
            output.warn(&format!(
                "note: --elements {asked} raised to {}: one per smooth piece of the profile at least",
                solution.mesh.len()
            ));
        }
    }

    /// As many modes as wanted, or as the asked elements can bend in, one at least on every piece
    /// of the profile.
    pub fn modes_within(&self, wanted: usize, pieces: usize) -> usize {
        let degree = self.degree.map_or(3, usize::from);
        let ways = |asked: u32| (degree - 1) * pieces.max(asked as usize);
        self.elements.map_or(wanted, |asked| wanted.min(ways(asked)))
    }

    /// Whether an accuracy was asked for: asked elements are the user's own choice of it.
    pub fn enforced(&self) -> bool {
        self.elements.is_none()
    }

    /// The exit code, after a word about an answer that is less accurate than asked or later.
    pub fn verdict(&self, solution: &Solution, output: &OutputArgs) -> u8 {
        if solution.met || !self.enforced() {
            return 0;
        }
        let asked = match self.budget {
            Some(budget) => format!("budget not kept: asked {budget:?}"),
            None => format!("accuracy not reached: asked {:e}", self.tol),
        };
        output.warn(&format!(
            "{asked}, the best answer is within {:.1e} ({} elements of degree {}); {}",
            solution.worst(),
            solution.mesh.len(),
            solution.degree,
            solution.shortfall(self.tol)
        ));
        NOT_REACHED
    }
}

/// What is printed, and where.
#[derive(clap::Args)]
#[command(next_help_heading = "Output")]
pub struct OutputArgs {
    /// Write JSON to this file (- = standard output, and no table then)
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,

    /// Units of the tables: si, us or both
    #[arg(long, value_name = "SYSTEM", default_value = "both", value_parser = unit_system)]
    pub units: Units,

    /// No warnings and no progress on standard error
    #[arg(long)]
    pub quiet: bool,
}

impl OutputArgs {
    /// Writes the JSON where it was asked for; what is left for standard output.
    pub fn deliver(&self, table: String, document: impl FnOnce() -> Value) -> Result<String> {
        let text = || format!("{:#}\n", document());
        match &self.json {
            Some(path) if path.as_os_str() == "-" => Ok(text()),
            Some(path) => file::write(path, text().as_bytes()).map(|()| style::table(table)),
            None => Ok(style::table(table)),
        }
    }

    /// The bat and its places drawn with what this terminal can show.
    pub fn sketch(&self, bat: &Bat, rows: &[Row]) -> String {
        sketch::draw(bat, rows, self.units, glyphs())
    }

    /// Says something on standard error.
    pub fn warn(&self, text: &str) {
        warn(text, self.quiet);
    }

    /// What takes so long, for a person at a terminal.
    pub fn progress(&self, what: &str) -> Progress {
        Progress::new(self.quiet, what)
    }
}

/// Block elements where the locale says that characters are UTF-8.
pub fn glyphs() -> Glyphs {
    let set = |name| std::env::var(name).ok().filter(|value| !value.is_empty());
    // The first of them that is set is the one that counts.
    let locale = ["LC_ALL", "LC_CTYPE", "LANG"].into_iter().find_map(set).unwrap_or_default();
    let locale = locale.to_ascii_lowercase();
    if locale.contains("utf-8") || locale.contains("utf8") { Glyphs::Blocks } else { Glyphs::Ascii }
}

/// What a file is called, as text.
pub fn printed(path: &Path) -> String {
    printable(&path.display().to_string())
}

/// Reads a bat and passes its warnings on.
pub fn read(path: &Path, quiet: bool) -> Result<Bat> {
    let bat = Bat::from_file(path)?;
    let file = path.display();
    bat.warnings().iter().for_each(|w| warn(&format!("warning: {file}: {w}"), quiet));
    Ok(bat)
}

/// A bat to be solved, and what is to be said of it in the end.
pub struct Prepared {
    pub bat: Bat,
    pub request: Request,
    pub warning: Option<String>,
}

/// The same solved.
pub struct Solved {
    pub bat: Bat,
    pub solution: Solution,
    pub warning: Option<String>,
}

/// A request with the theory chosen for this bat, if none was asked for, and the bat as stiff as it
/// was tapped.
pub fn prepare(
    bat: Bat,
    asked: TheoryChoice,
    mut request: Request,
    quiet: bool,
) -> Result<Prepared> {
    let mut warning = None;
    if asked.0.is_none() {
        let choice = choice::theory(&bat, &request)?;
        warning = choice.warning.filter(|_| !quiet);
        request.theory = choice.theory;
    }
    let bat = weighed::tuned(bat, request.theory, request.tolerance)?;
    Ok(Prepared { bat, request, warning })
}

fn warn(text: &str, quiet: bool) {
    if !quiet {
        // A closed standard error is no reason to stop.
        progress::beside(|| {
            let _ = writeln!(std::io::stderr(), "{}", printable(text));
        });
    }
}

/// The swing, the pitch and the ball.
#[derive(clap::Args)]
#[command(next_help_heading = "The hit")]
pub struct SceneArgs {
    /// Collision model: contact, pulse, energy-loss or rigid
    ///
    /// contact: ball and bending modes in contact, by a nonlinear lossy spring. pulse: a half sine of
    /// a given duration. energy-loss: the empirical loss of the WPI report. rigid: no bending.
    #[arg(long, value_name = "MODEL", default_value = "contact", value_parser = model)]
    model: String,

    /// Angular speed of the swing
    #[arg(long, value_name = "rad/s", default_value = "50 rad/s", allow_hyphen_values = true,
          value_parser = |s: &str| quantity(s, Quantity::AngularSpeed))]
    swing_speed: f64,

    /// Rotation centre of the swing beyond the knob end (negative: inside)
    #[arg(long, value_name = "m", default_value = "2.5 in", allow_hyphen_values = true,
          value_parser = |s: &str| quantity(s, Quantity::Length))]
    pivot: f64,

    /// Speed of the ball towards the bat
    #[arg(long, value_name = "m/s", default_value = "90 mph", allow_hyphen_values = true,
          value_parser = |s: &str| quantity(s, Quantity::Speed))]
    pitch: f64,

    /// Ball: baseball, softball or a ball file
    #[arg(long, value_name = "BALL", default_value = "baseball")]
    ball: String,

    /// Coefficient of restitution, in place of the ball's own
    #[arg(long, value_name = "E", allow_hyphen_values = true, value_parser = cor)]
    cor: Option<f64>,

    /// Where the hands feel the hit, from the knob end
    #[arg(long, value_name = "m", default_value = "6 in", allow_hyphen_values = true,
          value_parser = |s: &str| quantity(s, Quantity::Length))]
    hands: f64,

    /// Stiffness of a hollow barrel's wall under the ball
    ///
    /// For the contact model; without it the wall does not give way.
    #[arg(long, value_name = "N/m", allow_hyphen_values = true,
          value_parser = |s: &str| quantity(s, Quantity::Stiffness))]
    wall_stiffness: Option<f64>,

    /// Mass of that wall's own vibration [default: none, a spring in series]
    #[arg(long, value_name = "kg", requires = "wall_stiffness",
          allow_hyphen_values = true, value_parser = |s: &str| quantity(s, Quantity::Mass))]
    wall_mass: Option<f64>,

    /// The swing speed is that of a bat with this swing weight
    ///
    /// The moment of inertia about a point 6 in from the knob, such as "10000 oz in2".
    #[arg(long, value_name = "kg m2", allow_hyphen_values = true,
          value_parser = |s: &str| quantity(s, Quantity::Inertia))]
    reference_inertia: Option<f64>,

    /// How swings slow down with the swing weight [default: 0]
    ///
    /// A bat of another inertia I is swung at (I_ref/I)^N times the speed: 0 is the same angular
    /// speed, 0.5 the same energy of rotation.
    #[arg(long, value_name = "N", requires = "reference_inertia",
          allow_hyphen_values = true, value_parser = |s: &str| not_negative(s, "exponent"))]
    swing_exponent: Option<f64>,

    /// Size of the empirical loss (energy-loss)
    #[arg(long, value_name = "G", allow_hyphen_values = true,
          value_parser = |s: &str| not_negative(s, "gamma"))]
    gamma: Option<f64>,

    /// Power with which that loss falls with the mode number (energy-loss)
    #[arg(long, value_name = "P", allow_hyphen_values = true,
          value_parser = |s: &str| not_negative(s, "decay"))]
    decay: Option<f64>,

    /// Duration of the force (pulse) [default: 0.75 ms]
    #[arg(long, value_name = "s", allow_hyphen_values = true,
          value_parser = |s: &str| quantity(s, Quantity::Time))]
    pulse_duration: Option<f64>,

    /// Share of the vibration's energy the ball need not lose (pulse) [default: 0.6]
    #[arg(long, value_name = "KAPPA", allow_hyphen_values = true,
          value_parser = |s: &str| not_negative(s, "loss share"))]
    loss_share: Option<f64>,
}

impl SceneArgs {
    /// The ball's file, if it has one.
    pub fn ball_file(&self) -> Option<&Path> {
        let built_in = matches!(self.ball.as_str(), "baseball" | "softball");
        (!built_in).then(|| Path::new(&self.ball))
    }

    /// The scene on that bat, and where its swing is from.
    pub fn scene(&self, bat: &Bat) -> Result<(Scene, Option<SwingLaw>)> {
        let mut ball = match self.ball.as_str() {
            "baseball" => Ball::baseball(),
            "softball" => Ball::softball(),
            path => Ball::from_file(path).map_err(|error| unknown_ball(path, error))?,
        };
        let cor = self.cor.unwrap_or(ball.cor);
        if !(self.pitch.abs() < 1e6 && self.swing_speed.abs() < 1e6 && self.pivot.abs() < 1e6) {
            let expected = "values below 1e6 m/s, 1e6 rad/s and 1e6 m";
            return Err(Error::value(
                "--pitch, --swing-speed or --pivot",
                "a larger one",
                expected,
            ));
        }
        if self.pitch < 0.0 {
            let expected = "0 or more: it is the speed towards the bat";
            return Err(Error::value("--pitch", format!("{} m/s", self.pitch), expected));
        }
        if self.cor.is_some() {
            ball.cor_by_speed.clear();
        }
        if !(0.0..=bat.length()).contains(&self.hands) {
            let expected = format!("a place on the bat, 0 to {}", shown_length(bat.length()));
            return Err(Error::value("--hands", shown_length(self.hands), expected));
        }
        let law = self.swing_law()?;
        let (pivot, ball_speed) = (self.pivot, self.pitch);
        let swing = law.map_or(self.swing_speed, |law| law.swing(bat));
        let (hands, wall) = (self.hands, self.wall()?);
        Ok((Scene { pivot, swing, ball, ball_speed, cor, hands, wall }, law))
    }

    fn swing_law(&self) -> Result<Option<SwingLaw>> {
        let Some(reference) = self.reference_inertia else { return Ok(None) };
        let exponent = self.swing_exponent.unwrap_or(0.0);
        if !(reference > 1e-9 && reference < 1e9) {
            let found = format!("{reference:?} kg m2");
            return Err(Error::value("--reference-inertia", found, "a bat's inertia, above 0"));
        }
        if exponent > 2.0 {
            return Err(Error::value("--swing-exponent", exponent, "0 to 2"));
        }
        Ok(Some(SwingLaw { exponent, reference, of_reference: self.swing_speed }))
    }

    fn wall(&self) -> Result<Option<Wall>> {
        let Some(stiffness) = self.wall_stiffness else { return Ok(None) };
        if self.model != "contact" {
            let found = format!("it with --model {}", self.model);
            let expected = "--model contact: only there a wall gives way";
            return Err(Error::value("--wall-stiffness", found, expected));
        }
        let mass = self.wall_mass.unwrap_or(0.0);
        if !(1.0..=1e15).contains(&stiffness) {
            let found = format!("{stiffness:?} N/m");
            return Err(Error::value("--wall-stiffness", found, "1 to 1e15 N/m"));
        }
        if !(mass == 0.0 || (1e-9..1e6).contains(&mass)) {
            let found = format!("{mass:?} kg");
            return Err(Error::value("--wall-mass", found, "0, or 1e-9 to 1e6 kg"));
        }
        Ok(Some(Wall { stiffness, mass }))
    }

    pub fn model(&self) -> Result<Model> {
        let empirical = self.gamma.is_some() || self.decay.is_some();
        let pulsed = self.pulse_duration.is_some() || self.loss_share.is_some();
        for (given, options, model) in [
            (empirical, "--gamma, --decay", "energy-loss"),
            (pulsed, "--pulse-duration, --loss-share", "pulse"),
        ] {
            if given && self.model != model {
                let found = format!("them with --model {}", self.model);
                let expected = format!("--model {model}, or neither of them");
                return Err(Error::value(options, found, expected));
            }
        }
        Ok(match self.model.as_str() {
            "rigid" => Model::Rigid,
            "energy-loss" => {
                let default = EnergyLoss::default();
                Model::EnergyLoss(EnergyLoss {
                    gamma: self.gamma.unwrap_or(default.gamma),
                    decay: self.decay.unwrap_or(default.decay),
                })
            }
            "pulse" => Model::Pulse(self.pulse()?),
            _ => Model::Contact,
        })
    }

    fn pulse(&self) -> Result<Pulse> {
        let default = Pulse::default();
        let duration = self.pulse_duration.unwrap_or(default.duration);
        let loss_share = self.loss_share.unwrap_or(default.loss_share);
        if !(1e-9..=1.0).contains(&duration) {
            let expected = "a time from 1 ns to 1 s, such as \"0.75 ms\"";
            return Err(Error::value("--pulse-duration", format!("{duration} s"), expected));
        }
        if loss_share > 1.0 {
            return Err(Error::value("--loss-share", loss_share, "0 to 1"));
        }
        Ok(Pulse { duration, loss_share })
    }
}

/// What is wrong with a ball: a word that is near a known one is no file's name.
fn unknown_ball(name: &str, error: Error) -> Error {
    let known = ["baseball", "softball"];
    match error {
        Error::Read { source, .. } if nearest(name, &known).is_some() => {
            let found = format!("{name}, which cannot be read ({source})");
            let complaint = Complaint::new("--ball", found, "baseball, softball or a ball file");
            Error::Value(complaint.or_nearest(name, &known))
        }
        other => other,
    }
}

/// The curve of exit speeds as CSV.
pub fn curve_csv(impacts: &[Impact]) -> String {
    let mut out =
        String::from("x_m,bat_speed_m_s,exit_speed_m_s,rigid_exit_speed_m_s,vibration_j\n");
    let cell = |value: Option<f64>| value.map_or(String::new(), |v| v.to_string());
    for impact in impacts {
        let outcome = impact.outcome.as_ref();
        let cells = [
            impact.x.to_string(),
            impact.bat_speed.to_string(),
            cell(outcome.map(|o| o.exit_speed)),
            cell(impact.rigid_exit_speed),
            cell(outcome.map(|o| o.energy.vibration())),
        ];
        out += &cells.join(",");
        out.push('\n');
    }
    out
}

/// A number as JSON writes it: the shortest that reads back to the same bits.
pub fn number(value: f64) -> String {
    serde_json::Value::from(value).to_string()
}

/// A length as it is said in messages, whichever unit it came in.
pub fn shown_length(length: f64) -> String {
    let inches: f64 = format!("{:.5e}", units::inches(length)).parse().unwrap_or(f64::NAN);
    format!("{length:?} m ({inches:?} in)")
}

/// A value with its unit from the command line.
pub fn quantity(text: &str, quantity: Quantity) -> std::result::Result<f64, String> {
    units::parse_or_si(text, quantity).map_err(|complaint| complaint.to_string())
}

/// A relative accuracy from the command line, as a number or in %.
pub fn tolerance(text: &str) -> std::result::Result<f64, String> {
    let (number, scale) = match text.trim().strip_suffix('%') {
        Some(number) => (number, 0.01),
        None => (text, 1.0),
    };
    match number.trim().parse::<f64>() {
        Ok(value) if value * scale > 0.0 && value * scale < 1.0 => Ok(value * scale),
        _ => Err("expected a number between 0 and 1, such as 1e-6 or 0.01%".into()),
    }
}

/// How long something may take, from the command line.
pub fn budget(text: &str) -> std::result::Result<Duration, String> {
    let seconds = quantity(text, Quantity::Time)?;
    let expected = "expected a time from 1 us to 1 day, such as \"5 ms\"";
    if (1e-6..=86_400.0).contains(&seconds) {
        Duration::try_from_secs_f64(seconds).map_err(|_| expected.into())
    } else {
        Err(expected.into())
    }
}

fn cor(text: &str) -> std::result::Result<f64, String> {
    text.parse::<f64>().ok().and_then(|e| restitution(e + 0.0).ok()).ok_or("expected 0 to 1".into())
}

fn not_negative(text: &str, what: &str) -> std::result::Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if (0.0..=100.0).contains(&value) => Ok(value + 0.0),
        _ => Err(format!("expected a {what} from 0 to 100")),
    }
}

/// One of `now`, with a word of its own for what comes `later`.
pub fn one_of(text: &str, now: &[&str], later: &[&str]) -> std::result::Result<String, String> {
    if now.contains(&text) {
        return Ok(text.to_owned());
    }
    let names = now.join(", ");
    if later.contains(&text) {
        return Err(format!("{text} is not supported yet; there is {names}"));
    }
    let hint = nearest(text, now).map_or(String::new(), |name| format!(" (did you mean {name}?)"));
    Err(format!("expected one of {names}{hint}"))
}

/// A theory, or none: that which the bat needs.
#[derive(Debug, Clone, Copy)]
pub struct TheoryChoice(pub Option<Theory>);

/// `--theory` on the command line.
pub fn theory(text: &str) -> std::result::Result<TheoryChoice, String> {
    let names = ["auto", "euler-bernoulli", "rayleigh", "timoshenko"];
    let name = one_of(text, &names, &[])?;
    Ok(TheoryChoice(Theory::ALL.into_iter().find(|theory| theory.name() == name)))
}

fn solver(text: &str) -> std::result::Result<Solver, String> {
    let names = ["auto", "statics", "dense", "shift-invert", "arpack"];
    Ok(match one_of(text, &names, &[])?.as_str() {
        "dense" => Solver::Dense,
        "shift-invert" => Solver::ShiftInvert,
        "arpack" => Solver::Arpack,
        _ => Solver::Statics,
    })
}

fn model(text: &str) -> std::result::Result<String, String> {
    one_of(text, &["contact", "pulse", "energy-loss", "rigid"], &[])
}

pub fn unit_system(text: &str) -> std::result::Result<Units, String> {
    Ok(match one_of(text, &["si", "us", "both"], &[])?.as_str() {
        "si" => Units::Si,
        "us" => Units::Us,
        _ => Units::Both,
    })
}
