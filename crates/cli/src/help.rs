//! Help that fits a terminal.

use std::fmt::Display;

use clap::{Arg, Command};

use crate::style::broken;

/// Columns of a verb's help, and of an option's help on separate lines.
const PROSE: usize = 80;
const BELOW: usize = 70;
/// Least columns beside the longest name.
const BESIDE: usize = 30;

/// The verbs with `--budget`: all others refuse it, and their help leaves it out.
const BUDGETED: [&str; 3] = ["modes", "ring", "trade"];

/// A space at which no line breaks.
const TOGETHER: &str = "\u{a0}";

/// The example commands of all verbs.
const EXAMPLES: &str = include_str!("examples.txt");

/// The example commands of a verb.
pub fn commands(verb: &str) -> String {
    let mut sections = EXAMPLES.split("\n# ").filter_map(|section| section.split_once('\n'));
    let own = sections.find(|(name, _)| *name == verb).map_or("", |(_, text)| text.trim_end());
    format!("Examples:\n{own}")
}

/// The command with every help text broken into lines, and defaults written in the text.
pub fn fitted(command: Command) -> Command {
    let about = command.get_long_about().or(command.get_about()).map(|text| lines(text, PROSE));
    let command = match about {
        Some(text) => command.long_about(text),
        None => command,
    };
    let longest = command.get_arguments().map(columns).max().unwrap_or(0);
    let beside = PROSE.saturating_sub(longest).max(BESIDE);
    let refuses = !BUDGETED.contains(&command.get_name());
    let command = command.mut_args(|arg| {
        let arg = if refuses && arg.get_id() == "budget" { arg.hide(true) } else { arg };
        let values = arg.get_default_values().iter().map(|value| value.to_string_lossy());
        let default = match values.collect::<Vec<_>>().join(" ") {
            values if values.is_empty() || !arg.get_action().takes_values() => String::new(),
            values => format!(" [default:{TOGETHER}{}]", values.replace(' ', TOGETHER)),
        };
        let short = arg.get_help().map(|text| format!("{text}{default}"));
        let long = arg.get_long_help().map(|text| format!("{text}{default}"));
        let long = long.or_else(|| short.clone());
        let Some((short, long)) = short.zip(long) else { return arg };
        let takes = arg.get_action().takes_values();
        let arg = arg.help(lines(&short, beside)).long_help(lines(&long, BELOW));
        if takes { arg.hide_default_value(true) } else { arg }
    });
    command.mut_subcommands(fitted)
}

/// The verbs in groups by purpose; all others are under the last heading.
const GROUPS: [(&str, &[&str]); 5] = [
    ("Describe a bat", &["new"]),
    ("Look at it", &["analyze", "lab", "modes", "hit"]),
    ("Change it", &["lathe", "aim", "compare"]),
    ("Many bats", &["study"]),
    ("More", &[]),
];

/// The command with its verbs listed in groups.
pub fn grouped(command: Command) -> Command {
    let first: Vec<&str> = GROUPS.iter().flat_map(|(_, verbs)| *verbs).copied().collect();
    let mut list = String::new();
    for (heading, verbs) in GROUPS {
        let verbs = command.get_subcommands().filter(|verb| match verbs {
            [] => !first.contains(&verb.get_name()),
            verbs => verbs.contains(&verb.get_name()),
        });
        let line = |verb: &Command| {
            let about = verb.get_about().map(ToString::to_string).unwrap_or_default();
            format!("  {:<12} {about}\n", verb.get_name())
        };
        list += &format!("{heading}:\n{}\n", verbs.map(line).collect::<String>());
    }
    command.help_template(format!(
        "{{about-with-newline}}\n{{usage-heading}} {{usage}}\n\n{list}Options:\n{{options}}{{after-help}}"
    ))
}

/// Columns before an option's help on the same line: two blanks, both names, the value's name, two blanks.
fn columns(arg: &Arg) -> usize {
    let wide = |text: &str| text.chars().count();
    let names = arg.get_long().map_or(0, |long| "-n, --".len() + wide(long));
    let values = arg.get_value_names().filter(|_| arg.get_action().takes_values());
    let values = values.into_iter().flatten().map(|name| wide(name) + " <>".len());
    2 + names + values.sum::<usize>() + 2
}

/// The text in lines of at most the given number of columns; its line ends are kept.
fn lines(text: impl Display, width: usize) -> String {
    broken(&text.to_string(), width).replace(TOGETHER, " ")
}
