//! The command line: verbs, options, exit codes.

mod advise;
mod analyze;
mod common;
mod extremes_table;
mod frf;
mod hit;
mod materials;
mod modes;
mod promise_table;
mod ring;
mod trade;
mod validate;

use clap::error::ErrorKind;
use clap::parser::ValueSource;
use clap::{Args, CommandFactory, FromArgMatches, Parser, Subcommand};
use sweetspot::error::{Error, Result};

/// What is left to do when a verb is done.
pub struct Done {
    /// What to print on standard output.
    pub text: String,
    /// The exit code.
    pub code: u8,
    /// What to say on standard error when everything else is written.
    pub warning: Option<String>,
}

impl Done {
    pub fn new(text: String, code: u8) -> Self {
        Self { text, code, warning: None }
    }

    pub fn with(self, warning: Option<String>) -> Self {
        Self { warning, ..self }
    }
}

/// A check or a validation failed.
pub const FAILED: u8 = 1;
/// The asked accuracy could not be reached; the best answer, if there is one, is given.
pub const NOT_REACHED: u8 = 3;

/// What a baseball bat does when it meets a ball.
#[derive(Parser)]
#[command(
    version,
    after_help = "Exit codes: 0 done; 1 a check failed; 2 the input or the command \
line is wrong;\n3 the asked accuracy could not be reached (the best answer, if any, is still given)."
)]
struct Cli {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Subcommand)]
enum Verb {
    Analyze(analyze::Args),
    Modes(modes::Args),
    Hit(hit::Args),
    Ring(ring::Args),
    Frf(frf::Args),
    Trade(trade::Args),
    Advise(advise::Args),
    Validate(validate::Args),
    Materials(materials::Args),
}

/// Verbs of the trade that this version does not know yet.
const LATER_VERBS: &[&str] =
    &["convert", "schema", "compare", "fit", "tune", "sweep", "lab", "new"];
/// Options that this version does not know yet.
const LATER_OPTIONS: &[&str] = &["--up-to"];

/// Parses the command line and runs the verb. Help, version and wrong usage end the program here.
pub fn run() -> Result<Done> {
    let args = std::env::args_os().skip(1);
    refuse_later(&args.map(|arg| arg.to_string_lossy().into_owned()).collect::<Vec<_>>())?;
    match parse().verb {
        Verb::Analyze(args) => analyze::run(&args),
        Verb::Modes(args) => modes::run(&args),
        Verb::Hit(args) => hit::run(&args),
        Verb::Ring(args) => ring::run(&args),
        Verb::Frf(args) => frf::run(&args),
        Verb::Trade(args) => trade::run(&args),
        Verb::Advise(args) => advise::run(&args),
        Verb::Validate(args) => validate::run(&args),
        Verb::Materials(args) => materials::run(&args),
    }
}

/// The command line. What sets the scene of a hit is for `ring --hit` alone in that verb.
fn parse() -> Cli {
    let scene = common::SceneArgs::augment_args(clap::Command::new("scene"));
    let matches = Cli::command().get_matches();
    if let Some(("ring", ring)) = matches.subcommand().filter(|(_, m)| !given(m, "hit")) {
        let stray = scene.get_arguments().find(|arg| given(ring, arg.get_id().as_str()));
        if let Some(name) = stray.and_then(clap::Arg::get_long) {
            let text = format!("--{name} sets the scene of a hit: add --hit X, or leave it out");
            Cli::command().error(ErrorKind::MissingRequiredArgument, text).exit();
        }
    }
    Cli::from_arg_matches(&matches).unwrap_or_else(|error| error.exit())
}

/// Whether an option stands on the command line.
fn given(matches: &clap::ArgMatches, name: &str) -> bool {
    matches!(matches.try_contains_id(name), Ok(true))
        && matches.value_source(name) == Some(ValueSource::CommandLine)
}

/// One line that does nothing to a terminal, whatever a file is called or holds.
pub fn printable(text: &str) -> String {
    let escaped = |c: char| if c.is_control() { c.escape_default().to_string() } else { c.into() };
    text.chars().map(escaped).collect()
}

fn refuse_later(args: &[String]) -> Result<()> {
    let verb = args.first().filter(|verb| LATER_VERBS.contains(&verb.as_str()));
    let option = args.iter().map(|arg| arg.split('=').next().unwrap_or(arg));
    let option = option.into_iter().find(|arg| LATER_OPTIONS.contains(arg));
    let advice = "see --help for what there is";
    match (verb, option) {
        (Some(verb), _) => Err(Error::NotYet { what: format!("\"{verb}\""), advice }),
        (None, Some(option)) => Err(Error::NotYet { what: option.to_owned(), advice }),
        (None, None) => Ok(()),
    }
}
