//! Which verb did the user type?

use std::ffi::OsString;
use std::io::IsTerminal;

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::parser::ValueSource;
use clap::{Args, CommandFactory, FromArgMatches, Parser, Subcommand};
use sweetspot::base::error::{Complaint, nearest};
use sweetspot::base::file;
use sweetspot::files::built_in;
use sweetspot::{Error, Result};

use crate::done::{Done, printable};
#[cfg(feature = "audio")]
use crate::tap;
use crate::{
    advise, aim, analyze, bats, bbcor, calibrate, compare, completions, convert, diagnostic,
    first_word, frf, help, hit, hoop, identify, lab, lathe, licences, man, materials, modes, new,
    ring, scatter, scene, schema, stop, study, style, trade, validate, value,
};
use sweetspot_report::report::mistakes;

/// What a baseball bat does when it meets a ball
#[derive(Parser)]
#[command(name = "sweetspot", version, after_help = AFTER)]
struct Cli {
    #[command(subcommand)]
    verb: Verb,
}

const AFTER: &str = "\
Start here:
  sweetspot new
      writes a bat file from what you measured
  sweetspot r161
      a bat on one screen: a built-in one, or a file of yours
  sweetspot hit --help
      what a verb answers, with examples

Exit codes: 0 done; 1 a check failed; 2 the input or the command line is wrong;
3 the asked accuracy could not be reached (the best answer, if any, is still given);
ended by a signal: 128 and its number.";

#[derive(Subcommand)]
enum Verb {
    Analyze(analyze::Args),
    Modes(modes::Args),
    Hit(hit::Args),
    Bbcor(bbcor::Args),
    Hoop(hoop::Args),
    Compare(compare::Args),
    Calibrate(calibrate::Args),
    #[cfg(feature = "audio")]
    Tap(tap::Args),
    Ring(ring::Args),
    Frf(frf::Args),
    Identify(identify::Args),
    Lab(lab::Args),
    Lathe(lathe::Args),
    Aim(aim::Args),
    Trade(trade::Args),
    Study(study::Args),
    Scatter(scatter::Args),
    Advise(advise::Args),
    Convert(convert::Args),
    Validate(validate::Args),
    Bats(bats::Args),
    Materials(materials::Args),
    Schema(schema::Args),
    New(new::Args),
    Man(man::Args),
    Completions(completions::Args),
    #[command(alias = "licenses")]
    Licences(licences::Args),
}

/// Verbs of the trade that this version does not have yet.
const LATER_VERBS: &[&str] = &["fit", "tune", "sweep"];

/// Parses the command line and runs the verb. Wrong usage ends the program here.
pub fn run() -> Result<Done> {
    refuse_later(std::env::args_os().nth(1))?;
    let verb = match parse(first_word::read(std::env::args_os().collect(), &Cli::command())?) {
        Ok(cli) => cli.verb,
        Err(said) => return say(&said),
    };
    stop::cleanly();
    file::keep();
    match verb {
        Verb::Analyze(args) => analyze::run(&args),
        Verb::Modes(args) => modes::run(&args),
        Verb::Hit(args) => hit::run(&args),
        Verb::Bbcor(args) => bbcor::run(&args),
        Verb::Hoop(args) => hoop::run(&args),
        Verb::Compare(args) => compare::run(&args),
        Verb::Calibrate(args) => calibrate::run(&args),
        #[cfg(feature = "audio")]
        Verb::Tap(args) => tap::run(&args),
        Verb::Ring(args) => ring::run(&args),
        Verb::Frf(args) => frf::run(&args),
        Verb::Identify(args) => identify::run(&args),
        Verb::Lab(args) => lab::run(&args),
        Verb::Lathe(args) => lathe::run(&args),
        Verb::Aim(args) => aim::run(&args),
        Verb::Trade(args) => trade::run(&args),
        Verb::Study(args) => study::run(&args),
        Verb::Scatter(args) => scatter::run(&args),
        Verb::Advise(args) => advise::run(&args),
        Verb::Convert(args) => convert::run(&args),
        Verb::Validate(args) => validate::run(&args),
        Verb::Bats(args) => bats::run(&args),
        Verb::Materials(args) => materials::run(&args),
        Verb::Schema(args) => schema::run(&args),
        Verb::New(args) => new::run(&args),
        Verb::Man(args) => man::run(&args, Cli::command()),
        Verb::Completions(args) => completions::run(&args, Cli::command()),
        Verb::Licences(args) => licences::run(&args),
    }
}

/// The command line, or the text to print in its place. In `ring`, options for the scene of a hit need `--hit`.
fn parse(words: Vec<OsString>) -> std::result::Result<Cli, clap::Error> {
    let scene = scene::SceneArgs::augment_args(clap::Command::new("scene"));
    let command = help::grouped(help::fitted(value::with_minus(Cli::command())));
    let matches = command.try_get_matches_from(words);
    let matches = matches.map_err(|said| bat_for_a_verb(near_tips(said)))?;
    if let Some(("ring", ring)) = matches.subcommand().filter(|(_, m)| !given(m, "hit")) {
        let stray = scene.get_arguments().find(|arg| given(ring, arg.get_id().as_str()));
        if let Some(name) = stray.and_then(clap::Arg::get_long) {
            let text = format!("--{name} sets the scene of a hit: add --hit X, or leave it out");
            return Err(Cli::command().error(ErrorKind::MissingRequiredArgument, text));
        }
    }
    Cli::from_arg_matches(&matches)
}

/// The error with a tip only if it is near what was typed, as elsewhere in the program. clap's own tips only share
/// letters with it, as `completions` with `maple`.
fn near_tips(mut said: clap::Error) -> clap::Error {
    use ContextKind::{
        InvalidArg, InvalidSubcommand, InvalidValue, SuggestedArg, SuggestedSubcommand,
        SuggestedValue,
    };
    let text = |value: Option<&ContextValue>| match value {
        Some(ContextValue::String(word)) => vec![word.clone()],
        Some(ContextValue::Strings(words)) => words.clone(),
        _ => vec![],
    };
    let kinds = [
        (InvalidSubcommand, SuggestedSubcommand),
        (InvalidArg, SuggestedArg),
        (InvalidValue, SuggestedValue),
    ];
    for (typed, tip) in kinds {
        let Some(word) = text(said.get(typed)).into_iter().next() else { continue };
        let mut known = text(said.remove(tip).as_ref());
        if typed == InvalidSubcommand {
            let command = Cli::command();
            known = command.get_subcommands().map(|verb| verb.get_name().to_owned()).collect();
        }
        let names: Vec<&str> = known.iter().map(String::as_str).collect();
        match nearest(&word, &names) {
            Some(near) => said.insert(tip, ContextValue::String(near.to_owned())),
            None => continue,
        };
    }
    said
}

/// The error for a word that is near the name of a built-in bat but near no verb; other errors unchanged.
fn bat_for_a_verb(said: clap::Error) -> clap::Error {
    let Some(ContextValue::String(word)) = said.get(ContextKind::InvalidSubcommand) else {
        return said;
    };
    let near = nearest(word, &built_in::bat_names());
    match near.filter(|_| said.get(ContextKind::SuggestedSubcommand).is_none()) {
        Some(near) => {
            let text = format!(
                "found {}, expected a verb or a bat; did you mean `sweetspot analyze {near}`?",
                printable(word)
            );
            Cli::command().error(ErrorKind::InvalidSubcommand, text)
        }
        None if printable(word) != *word => {
            let text = format!("unrecognized subcommand '{}'", printable(word));
            Cli::command().error(ErrorKind::InvalidSubcommand, text)
        }
        None => said,
    }
}

/// Prints help and version as results; wrong usage is reported with exit code 2.
fn say(said: &clap::Error) -> Result<Done> {
    if said.use_stderr() {
        // A closed standard error changes nothing.
        let _ = said.print();
        diagnostic::as_json(|| mistakes::of_option(&complaint(said)));
        return Ok(Done::new(String::new(), said.exit_code() as u8));
    }
    let coloured = style::coloured(std::io::stdout().is_terminal());
    let text = said.render();
    Ok(Done::new(if coloured { text.ansi().to_string() } else { text.to_string() }, 0))
}

/// Wrong usage in parts: the option, what was found, what was expected, a tip.
fn complaint(said: &clap::Error) -> Complaint {
    let text = said.render().to_string();
    let mut parts =
        text.split("\n\n").map(|part| part.split_whitespace().collect::<Vec<_>>().join(" "));
    let first = parts.next().unwrap_or_default();
    let first = first.trim_start_matches("error: ");
    let (found, expected) = first.split_once(": expected ").unwrap_or((first, ""));
    let tip = parts.find_map(|part| part.strip_prefix("tip: ").map(str::to_owned));
    let option = match said.get(ContextKind::InvalidArg) {
        Some(ContextValue::String(option)) => option.split(' ').next().unwrap_or_default(),
        _ => "",
    };
    Complaint::new(option, found, expected).hinted(tip.unwrap_or_default())
}

/// Whether an option is on the command line.
fn given(matches: &clap::ArgMatches, name: &str) -> bool {
    matches!(matches.try_contains_id(name), Ok(true))
        && matches.value_source(name) == Some(ValueSource::CommandLine)
}

fn refuse_later(verb: Option<OsString>) -> Result<()> {
    match verb.filter(|verb| LATER_VERBS.iter().any(|later| verb == later)) {
        Some(verb) => {
            let what = format!("\"{}\"", verb.display());
            Err(Error::NotYet { what, advice: "see --help for what there is" })
        }
        None => Ok(()),
    }
}
