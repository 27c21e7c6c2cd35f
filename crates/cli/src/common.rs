//! Options that several verbs share.

use std::path::{Path, PathBuf};
use std::time::Duration;

use sweetspot::base::error::Complaint;
use sweetspot::base::units::shown_length;
use sweetspot::files::bat_file::Named;
use sweetspot::files::built_in;
use sweetspot::modes::request::MOST_MODES;
use sweetspot::modes::theory_choice::{self, Choice};
use sweetspot::modes::up_to::modes_up_to;
use sweetspot::modes::{prepared, solve};
use sweetspot::{Bat, Error, Request, Result, Solution, Solver, Theory};
use sweetspot_report::parts::wrapped;

use crate::done::NOT_REACHED;
use crate::edits::EditArgs;
use crate::help;
use crate::output::{FullArgs, JsonArgs, warn};
use crate::value::{TOP_FREQUENCY, TheoryChoice, budget, solver, theory, tolerance};

/// The end of a verb's help: its example commands, the notation of values, and the built-in bats.
pub fn examples(verb: &str) -> String {
    format!(
        "{}\n\n\
         A bare number is in the unit that stands between < >. One that is absurd in it,\n\
         such as --pitch 90 (m/s), is refused with what it may mean. Others carry their\n\
         unit, as people write it: \"28 in\", \"33 1/2 in\", \"31 oz\", \"90 mph\", \"0.75 ms\".\n\
         Places count from the knob end.\n\n{}",
        help::commands(verb),
        wrapped(&format!("Built-in bats: {}.", built_in::bat_names().join(", ")), 0).trim_end()
    )
}

/// The bat and its edits.
#[derive(clap::Args)]
pub struct BatFileArgs {
    /// Bat file (JSON), or the name of a built-in bat such as r161
    #[arg(help_heading = "The bat")]
    bat: PathBuf,

    #[command(flatten)]
    edits: EditArgs,
}

impl BatFileArgs {
    /// Reads the bat, edits it and passes its warnings on.
    pub fn read(&self, quiet: bool) -> Result<Bat> {
        read(&self.bat, &self.edits, quiet)
    }
}

/// The bat and the number of its modes.
#[derive(clap::Args)]
#[command(next_help_heading = "The bat")]
pub struct BatArgs {
    /// Bat file (JSON), or the name of a built-in bat such as r161
    bat: PathBuf,

    /// Number of bending modes [default: 10; for a hit as many as it needs]
    #[arg(short = 'n', long = "modes", value_name = "N",
          value_parser = clap::value_parser!(u16).range(0..=MOST_MODES as i64))]
    count: Option<u16>,

    /// All bending modes up to this frequency, such as 2000 or "2 kHz", in place of a number
    #[arg(long, value_name = "HZ", conflicts_with = "count", value_parser = TOP_FREQUENCY)]
    up_to: Option<f64>,

    #[command(flatten)]
    edits: EditArgs,
}

impl BatArgs {
    /// Number of bending modes if no frequency was given.
    pub fn count(&self) -> usize {
        self.count.unwrap_or(10).into()
    }

    /// Whether a number or a frequency was given.
    pub fn asked(&self) -> bool {
        self.count.is_some() || self.up_to.is_some()
    }

    /// Whether `--damping` has that value.
    pub fn damped_as(&self, whose: &str) -> bool {
        self.edits.damped_as(whose)
    }

    /// The bat's file.
    pub fn path(&self) -> &Path {
        &self.bat
    }

    /// Reads the bat and passes its warnings on.
    pub fn read(&self, output: &FullArgs) -> Result<Bat> {
        read(&self.bat, &self.edits, output.quiet)
    }

    /// Reads the bat, passes on the warnings that the verb's screen does not tell, and returns the text of its file too.
    pub fn read_with_text(&self, output: &JsonArgs, screen: bool) -> Result<(Bat, String)> {
        let screen = screen && output.json.as_deref() != Some(Path::new("-"));
        read_with_text(&self.bat, &self.edits, [output.quiet, screen])
    }

    /// Finds the modes of a bat that was read.
    pub fn solve_for(&self, bat: Bat, solve: &SolveArgs, output: &FullArgs) -> Result<Solved> {
        let prepared = self.prepare(bat, self.count(), solve, output)?;
        let Prepared { bat, request, warning } = prepared;
        let solution = match solve.budget {
            Some(budget) => solve::solve_within(&bat, &request, budget)?,
            None => solve::solve(&bat, &request)?,
        };
        solve.say_raised(&solution, output);
        Ok(Solved { bat, solution, warning })
    }

    /// The bat and its request: a number of modes, or all up to a frequency.
    pub fn prepare(
        &self,
        bat: Bat,
        mut modes: usize,
        solve: &SolveArgs,
        output: &FullArgs,
    ) -> Result<Prepared> {
        let Some(limit) = self.up_to else { return solve.prepare(bat, modes, output) };
        // More modes may need a richer theory, and a richer theory has more modes up to the frequency. The number no
        // longer changes after as many rounds as there are theories.
        for _ in 0..=Theory::ALL.len() {
            let prepared = solve.prepare(bat.clone(), modes, output)?;
            let found = modes_up_to(&prepared.bat, &prepared.request, limit);
            let found = found.map_err(|error| match error {
                Error::Value(limit) if limit.field == "frequency limit" => about("--up-to", limit),
                other => other,
            })?;
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

/// Options for the computation of the modes.
#[derive(Clone, clap::Args)]
#[command(next_help_heading = "Accuracy")]
pub struct SolveArgs {
    /// Wanted relative accuracy, such as 1e-6 or 0.01%
    #[arg(long, value_name = "T", default_value = "1e-4", value_parser = tolerance)]
    pub tol: f64,

    /// Beam theory
    ///
    /// auto takes the simplest theory whose estimated shift of every frequency is within --tol. The others:
    /// euler-bernoulli (bending alone), rayleigh (with rotary inertia), timoshenko (with shear too, which needs the
    /// material's shear modulus).
    #[arg(long, value_name = "THEORY", default_value = "auto", value_parser = theory(),
          hide_possible_values = true)]
    theory: TheoryChoice,

    /// Total number of elements; the tolerance is then not enforced
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    elements: Option<u32>,

    /// Degree of the elements, 3 to 12
    ///
    /// The number of elements then follows from the tolerance; with --elements the default is 3.
    #[arg(long, value_name = "P", value_parser = clap::value_parser!(u8).range(3..=12))]
    degree: Option<u8>,

    /// The most accurate answer within this time, in place of --tol
    #[arg(long, value_name = "s", conflicts_with_all = ["tol", "elements"], value_parser = budget)]
    pub budget: Option<Duration>,

    /// Eigensolver: auto (statics), statics, dense, shift-invert or arpack
    #[arg(long, value_name = "NAME", default_value = "auto", value_parser = solver(),
          hide_possible_values = true)]
    solver: Solver,
}

impl SolveArgs {
    pub fn request(&self, modes: usize) -> Request {
        let elements = self.elements.map(|n| n as usize);
        let degree = self.degree.map(usize::from);
        let theory = self.theory.0.unwrap_or_default();
        Request { modes, tolerance: self.tol, elements, degree, solver: self.solver, theory }
    }

    /// These arguments with the theory that the modes need, if none was given, and a message about the choice.
    pub fn of_hits(&self, bat: &Bat, modes: usize) -> Result<(Self, Option<String>)> {
        let Choice { theory, warning } = match self.theory.0 {
            Some(theory) => Choice { theory, warning: None },
            None => theory_choice::theory(bat, &self.request(modes))?,
        };
        Ok((Self { theory: TheoryChoice(Some(theory)), ..self.clone() }, warning))
    }

    /// Prepares a bat to be solved: chooses its theory and fits its moduli to the tap.
    pub fn prepare(&self, bat: Bat, modes: usize, output: &FullArgs) -> Result<Prepared> {
        prepare(bat, self.theory, self.request(modes), output.quiet)
    }

    /// Refuses `--budget`: a time for the modes alone does not limit a whole hit.
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

    /// Reports that more elements were needed than given.
    pub fn say_raised(&self, solution: &Solution, output: &FullArgs) {
        if let Some(asked) = self.elements.filter(|asked| (*asked as usize) < solution.mesh.len()) {
            output.warn(&format!(
                "note: --elements {asked} raised to {}: one per smooth piece of the profile at least",
                solution.mesh.len()
            ));
        }
    }

    /// The wanted number of modes, or fewer if the given elements have fewer; there is at least one element on every
    /// piece of the profile.
    pub fn modes_within(&self, wanted: usize, pieces: usize) -> usize {
        let degree = self.degree.map_or(3, usize::from);
        let ways = |asked: u32| (degree - 1) * pieces.max(asked as usize);
        self.elements.map_or(wanted, |asked| wanted.min(ways(asked)))
    }

    /// Whether the accuracy must be reached: with given elements it need not be.
    pub fn enforced(&self) -> bool {
        self.elements.is_none()
    }

    /// The exit code, after a warning about a result that is less accurate than asked, or late.
    pub fn verdict(&self, solution: &Solution, output: &FullArgs) -> u8 {
        if solution.met() || !self.enforced() {
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
            solution.ending
        ));
        NOT_REACHED
    }
}

/// Reads a bat, edits it and passes its warnings on.
pub fn read(path: &Path, edits: &EditArgs, quiet: bool) -> Result<Bat> {
    read_with_text(path, edits, [quiet, false]).map(|(bat, _)| bat)
}

/// Reads a bat, edits it and reports its warnings; also returns the text of its file. A name without an ending is that
/// of a built-in bat, unless there is such a file. A `screen` tells a doubtful density itself.
pub fn read_with_text(
    path: &Path,
    edits: &EditArgs,
    [quiet, screen]: [bool; 2],
) -> Result<(Bat, String)> {
    let Named { bat, text, outside } = match built_in::named(path)? {
        Some((name, text)) => {
            let bat = Bat::from_text(name, text, Path::new(""))?;
            Named { bat, text: text.to_owned(), outside: vec![] }
        }
        None => Bat::named_by_a_person(path)?,
    };
    note_outside(path, &outside, quiet);
    let file = path.display();
    let bat = edits.edit(bat)?;
    if edits.damped_as("assumed") {
        let told = "damping assumed: a metal without a loss factor has the one published of aluminium (sweetspot materials)";
        warn(&format!("note: {file}: {told}"), quiet);
    }
    let told = bat.density_off().filter(|_| screen);
    let warnings = bat.warnings().into_iter().filter(|warning| Some(warning) != told.as_ref());
    warnings.for_each(|warning| warn(&format!("warning: {file}: {warning}"), quiet));
    Ok((bat, text))
}

/// Says which files a file has named that are outside of its folder.
pub fn note_outside(file: &Path, outside: &[PathBuf], quiet: bool) {
    for other in outside {
        let (file, other) = (file.display(), other.display());
        warn(&format!("note: {file} names {other}, which is outside of its folder"), quiet);
    }
}

/// A complaint with its name for the user.
pub fn about(field: impl Into<String>, complaint: Complaint) -> Error {
    Error::Value(Complaint { field: field.into(), ..complaint })
}

/// An error about members of a scene, which are options here.
pub fn as_options(error: Error) -> Error {
    let option = |name: &str| format!("--{}", name.replace('_', "-"));
    error.placed(|complaint| Error::Value(complaint.naming(option)))
}

/// A bat to be solved, how, and the warning to print at the end.
pub struct Prepared {
    pub bat: Bat,
    pub request: Request,
    pub warning: Option<String>,
}

/// A solved bat, and the warning to print at the end.
pub struct Solved {
    pub bat: Bat,
    pub solution: Solution,
    pub warning: Option<String>,
}

/// A request with the theory chosen for this bat, if none was given, and the bat with its moduli fitted to the tap.
pub fn prepare(bat: Bat, asked: TheoryChoice, request: Request, quiet: bool) -> Result<Prepared> {
    let theory = asked.0.unwrap_or_default();
    let prepared = prepared::prepare(&bat, &Request { theory, ..request })?;
    let (request, warning) = (prepared.request, prepared.warning.filter(|_| !quiet));
    Ok(Prepared { bat: prepared.bat.into_owned(), request, warning })
}

/// The command as typed, quoted so that a shell reads it again.
pub fn command_line() -> String {
    let plain = |c: char| c.is_alphanumeric() || "-_./=:,%+".contains(c);
    let quoted = |arg: String| match !arg.is_empty() && arg.chars().all(plain) {
        true => arg,
        false => format!("'{}'", arg.replace('\'', "'\\''")),
    };
    let typed = std::env::args_os().skip(1).map(|arg| quoted(arg.to_string_lossy().into_owned()));
    std::iter::once("sweetspot".to_owned()).chain(typed).collect::<Vec<_>>().join(" ")
}

/// A place on that bat (m); a tip given in inches may be a rounding beyond it.
pub fn on_the_bat(bat: &Bat, name: &str, x: f64) -> Result<f64> {
    if (0.0..=bat.length() * (1.0 + 4.0 * f64::EPSILON)).contains(&x) {
        return Ok(x.min(bat.length()));
    }
    let expected = format!("a place on the bat, 0 to {}", shown_length(bat.length()));
    Err(Error::value(name, shown_length(x), expected))
}
