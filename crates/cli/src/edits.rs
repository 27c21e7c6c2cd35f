//! Edits on the command line: changes of a bat after it was weighed.
//!
//! `--cut "24 in to 30 in, 1 mm"` and `--edit "cut 24 in to 30 in, 1 mm"` have the same grammar: a stretch of the bat,
//! then the other values of the change, in the order of a bat file or each with a word that identifies it.

use clap::{Arg, ArgAction, ArgMatches, Command, FromArgMatches};

use sweetspot::base::error::{Complaint, nearest};
use sweetspot::base::typed;
use sweetspot::base::units::{self, Quantity};
use sweetspot::bat::edit::{Bore, Change, Cork, Cup, Cut, Edit, ScaleDiameter, Shorten, Sleeve};
use sweetspot::bat::material::BUILT_IN;
use sweetspot::bat::part::{Field, MemberKind, Part, Slot};
use sweetspot::{Bat, Error, Material, Result};

use crate::value::{DIAMETER, LITTLE, PART_MASS, PLACE, Use};

/// For each change: its option, the name of its value, its help, and an example.
const OPTIONS: [[&str; 4]; 9] = [
    [
        "cut",
        "WHERE, DEPTH",
        "Turn wood off a stretch; the depth is of the diameter, smooth at both ends",
        "24 in to 30 in, 1 mm",
    ],
    ["knob", "kg", "Put a weight on the knob end", "2 oz"],
    ["cup", "DEEP, WIDE", "Cup the tip", "1 in deep, 1.5 in"],
    ["bore", "WHERE, WIDE", "Drill a stretch out", "26 in to 33 in, 1 in"],
    [
        "cork",
        "WHERE, WIDE, OF",
        "Drill a stretch out and fill it, with a built-in material or one of this density and \
         Young's modulus (and shear modulus)",
        "26 in to 33 in, 1 in, 200 kg/m^3, 20 MPa",
    ],
    [
        "sleeve",
        "WHERE, THICK, OF",
        "Put a layer around a stretch",
        "24 in to 30 in, 1 mm, aluminium-7075",
    ],
    ["shorten", "END, LENGTH", "Saw a length off the knob or the tip", "tip 0.5 in"],
    [
        "scale-diameter",
        "WHERE, BY",
        "Multiply the diameters of a stretch, smooth at both ends",
        "4 in to 12 in, 1.05",
    ],
    ["wood", "NAME", "Make the bat of another wood", "white-ash-dynamic"],
];

/// The option that chooses the damping.
pub const DAMPING: &str = "damping";

/// The edits after the bat was weighed, in the order typed, and the choice of damping.
#[derive(Debug, Clone, Default)]
pub struct EditArgs {
    changes: Vec<Change>,
    /// The value of `--damping`.
    damping: Option<String>,
}

impl EditArgs {
    /// No edits, and that value of `--damping`.
    pub fn damped(whose: &Option<String>) -> Self {
        Self { changes: vec![], damping: whose.clone() }
    }

    /// The bat after these edits, with the chosen damping.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] that names the option that does not fit the bat.
    pub fn edit(&self, bat: Bat) -> Result<Bat> {
        let change = |change: &Change| Edit { name: None, change: change.clone() };
        let edits: Vec<Edit> = self.changes.iter().map(change).collect();
        let called = |k: usize| format!("--{}", option(edits[k].change.verb()));
        let bat = edited(&bat, &edits, called)?;
        if !self.damped_as("assumed") {
            return Ok(bat);
        }
        let assumed = bat.with_losses(0.0)?;
        match assumed.lossy() {
            true => Ok(assumed),
            false => Err(Error::value(
                "--damping",
                "assumed, of a bat without a material whose loss factor is published (sweetspot materials)",
                "a \"loss_factor\" of the material in the bat file",
            )),
        }
    }

    /// Whether that damping was chosen.
    pub fn damped_as(&self, whose: &str) -> bool {
        self.damping.as_deref() == Some(whose)
    }
}

/// The bat after these edits; an error names edit k as `called` does.
pub fn edited(bat: &Bat, edits: &[Edit], called: impl Fn(usize) -> String) -> Result<Bat> {
    let before = bat.edits().len();
    bat.edited(edits).map_err(|error| {
        error.placed(|mut complaint| {
            let of = complaint.field.strip_prefix("edits[").and_then(|rest| rest.split_once(']'));
            let Some((k, key)) = of.and_then(|(k, key)| Some((k.parse::<usize>().ok()?, key)))
            else {
                return Error::Value(complaint);
            };
            // After the change's own name.
            let key = key.trim_start_matches('.').split_once('.').map_or("", |(_, key)| key);
            let key = if key.is_empty() { String::new() } else { format!(", {key}") };
            let of = match edits.len() {
                1 => String::new(),
                count => format!("edit {} of {count}, ", k + 1 - before),
            };
            complaint.field = format!("{of}{}{key}", called(k - before));
            Error::Value(complaint)
        })
    })
}

/// The command line's name of a change.
fn option(verb: &str) -> String {
    verb.replace('_', "-")
}

impl clap::Args for EditArgs {
    fn augment_args(command: Command) -> Command {
        let damping = Arg::new(DAMPING)
            .long(DAMPING)
            .value_name("WHOSE")
            .help("Damping by the materials: material, or assumed: a metal without a loss factor has the published one")
            .help_heading("What if (edits of the bat, after it was weighed, in the order typed)")
            .hide_short_help(true)
            .hide_possible_values(true)
            .value_parser(["material", "assumed"]);
        OPTIONS.into_iter().fold(command.arg(damping), |command, [name, value, help, example]| {
            let arg = Arg::new(name)
                .long(name)
                .value_name(value)
                .help(help)
                .long_help(format!("{help}, such as \"{example}\""))
                .help_heading(
                    "What if (edits of the bat, after it was weighed, in the order typed)",
                )
                .action(ArgAction::Append)
                .allow_hyphen_values(true)
                .hide_short_help(true)
                .value_parser(move |text: &str| read(name, text));
            command.arg(arg)
        })
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for EditArgs {
    fn from_arg_matches(matches: &ArgMatches) -> std::result::Result<Self, clap::Error> {
        let mut typed: Vec<(usize, Change)> = vec![];
        for [name, ..] in OPTIONS {
            let places = matches.indices_of(name).into_iter().flatten();
            let changes = matches.get_many::<Change>(name).into_iter().flatten().cloned();
            typed.extend(places.zip(changes));
        }
        typed.sort_by_key(|(place, _)| *place);
        let changes = typed.into_iter().map(|(_, change)| change).collect();
        Ok(Self { changes, damping: matches.get_one::<String>(DAMPING).cloned() })
    }

    fn update_from_arg_matches(
        &mut self,
        matches: &ArgMatches,
    ) -> std::result::Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

/// Edits that make one other bat, with a name if they have one: `NAME: knob 2 oz; cut 24 in to 30 in, 1 mm`.
#[derive(Debug, Clone)]
pub struct WhatIf {
    /// The name of the changed bat, by default the edits as typed.
    pub name: String,
    /// The edits.
    pub edits: Vec<Edit>,
}

/// Reads `--edit`.
pub fn what_if(text: &str) -> std::result::Result<WhatIf, String> {
    let (name, list) = match text.split_once(':') {
        Some((name, list)) => (Some(name.trim().to_owned()), list),
        None => (None, text),
    };
    if name.as_ref().is_some_and(String::is_empty) {
        return Err("found no name before the colon, expected \"NAME: EDIT; EDIT\"".to_owned());
    }
    let edit = |one: &str| {
        let one = one.trim();
        let (verb, rest) = one.split_once(char::is_whitespace).unwrap_or((one, ""));
        let names = OPTIONS.map(|[name, ..]| name);
        if !names.contains(&&*option(verb)) {
            let (expected, hint) = (names.join(", "), hint(verb, &names));
            return Err(format!("found \"{verb}\", expected one of {expected}{hint}"));
        }
        Ok(Edit { name: name.clone(), change: read(&option(verb), rest)? })
    };
    let edits: std::result::Result<Vec<Edit>, String> =
        list.split(';').filter(|one| !one.trim().is_empty()).map(edit).collect();
    let edits = edits?;
    match edits.is_empty() {
        true => Err("found no edit, expected \"knob 2 oz; cut 24 in to 30 in, 1 mm\"".to_owned()),
        false => Ok(WhatIf { name: name.unwrap_or_else(|| list.trim().to_owned()), edits }),
    }
}

/// The hint for a word that is near one of these names.
fn hint(word: &str, names: &[&str]) -> String {
    nearest(word, names).map_or(String::new(), |near| format!("; did you mean {near}?"))
}

/// A change, by the name of its option, from its words.
fn read(name: &str, text: &str) -> std::result::Result<Change, String> {
    let blank = || Material::new(1.0, 1.0).expect("both are above 0");
    let change = match name {
        "cut" => filled(Cut::default(), text).map(Change::Cut),
        "cup" => filled(Cup::default(), text).map(Change::Cup),
        "bore" => filled(Bore::default(), text).map(Change::Bore),
        "cork" => {
            let (from, to, diameter, material) = (0.0, 0.0, 0.0, blank());
            filled(Cork { from, to, diameter, material }, text).map(Change::Cork)
        }
        "sleeve" => {
            let (from, to, thickness, material) = (0.0, 0.0, 0.0, blank());
            filled(Sleeve { from, to, thickness, material }, text).map(Change::Sleeve)
        }
        "shorten" => filled(Shorten::default(), text).map(Change::Shorten),
        "scale-diameter" => filled(ScaleDiameter::default(), text).map(Change::ScaleDiameter),
        "wood" => material(&items(text)).map(Change::Wood),
        _ => PART_MASS.read(text).map(Change::Knob),
    };
    let example = OPTIONS.into_iter().find(|[of, ..]| *of == name).map_or("", |[.., like]| like);
    change.map_err(|said| format!("{said}; written as \"{example}\""))
}

/// The items between commas; a comma between two digits is a decimal comma.
fn items(text: &str) -> Vec<&str> {
    let digit = |c: Option<char>| c.is_some_and(|c| c.is_ascii_digit());
    let apart =
        |at: &usize| !(digit(text[..*at].chars().last()) && digit(text[at + 1..].chars().next()));
    let commas = text.match_indices(',').map(|(at, _)| at).filter(apart);
    let (mut items, mut start) = (vec![], 0);
    for at in commas.chain([text.len()]) {
        items.push(text[start..at].trim());
        start = at + 1;
    }
    items
}

/// Words beside a value that identify its member.
fn words_of(key: &str) -> &'static [&'static str] {
    match key {
        "depth" => &["deep", "off", "depth"],
        "diameter" => &["wide", "across", "diameter"],
        "thickness" => &["thick", "thickness"],
        "blend" => &["blend"],
        "by" => &["by", "times"],
        "knob" => &["off the knob", "at the knob", "knob"],
        "tip" => &["off the tip", "at the tip", "tip"],
        _ => &[],
    }
}

/// The value beside such a word, if the item has one of them.
fn beside<'a>(item: &'a str, key: &str) -> Option<&'a str> {
    let apart = |rest: &&str| rest.is_empty() || rest.starts_with(' ') || rest.ends_with(' ');
    words_of(key).iter().find_map(|word| {
        let rest = item.strip_suffix(word).or_else(|| item.strip_prefix(word));
        rest.filter(apart).map(str::trim)
    })
}

/// A part from its words: the stretch first, then its other members.
fn filled<P: Part>(start: P, text: &str) -> std::result::Result<P, String> {
    let (mut part, items) = (start, items(text));
    let mut items = items.as_slice();
    let stretch = P::FIELDS.iter().filter(|field| field.is_place());
    let mut fields: Vec<&Field<P>> = P::FIELDS.iter().filter(|field| !field.is_place()).collect();
    if stretch.clone().next().is_some() {
        for (field, place) in stretch.zip(ends(items.first().copied().unwrap_or_default())?) {
            set(field, place, &mut part);
        }
        items = &items[1..];
    }
    while let Some((item, rest)) = items.split_first() {
        let said = fields.iter().position(|field| beside(item, field.key).is_some());
        // The end of the bat must be named.
        let in_order = P::SOME.is_empty() && !fields.is_empty();
        let k = said.or(in_order.then_some(0));
        let Some(k) = k.filter(|_| !item.is_empty()) else {
            let left: Vec<&str> = fields.iter().map(|field| field.key).collect();
            let expected =
                if left.is_empty() { "nothing more".to_owned() } else { left.join(" or ") };
            return Err(format!("found \"{item}\", expected {expected}"));
        };
        let field = fields.remove(k);
        let value = if said.is_some() { beside(item, field.key).unwrap_or(item) } else { item };
        match field.kind {
            MemberKind::Material => {
                if let Slot::Material(slot) = (field.of)(&mut part) {
                    *slot = material(items)?;
                }
                return Ok(part);
            }
            MemberKind::Number(None, _) => {
                let number = typed::number(value);
                let number =
                    number.ok_or(format!("found \"{value}\", expected a factor, such as 1.05"))?;
                set(field, number, &mut part);
            }
            _ => set(field, plausible(field.key).read(value)?, &mut part),
        }
        items = rest;
    }
    let missing = fields.iter().find_map(|field| field.needed);
    let some = P::SOME.is_empty() || fields.len() < P::FIELDS.len();
    match missing {
        Some(expected) => Err(format!("found nothing more, expected {expected}")),
        None if !some => Err("found nothing, expected a length off the knob or the tip".to_owned()),
        None => Ok(part),
    }
}

/// Beginning and end of a stretch (m).
fn ends(text: &str) -> std::result::Result<[f64; 2], String> {
    let expected = || format!("found \"{text}\", expected a stretch, such as \"24 in to 30 in\"");
    let (from, to) = text.split_once(" to ").ok_or_else(expected)?;
    // Of 24 to 30 in both are in inches.
    let from = match (typed::split(from.trim()), typed::split(to.trim())) {
        ((number, ""), (_, unit)) if !number.is_empty() => &format!("{number} {unit}"),
        _ => from,
    };
    Ok([PLACE.read(from)?, PLACE.read(to)?])
}

fn set<P>(field: &Field<P>, value: f64, part: &mut P) {
    match (field.of)(part) {
        Slot::Number(number) => *number = value,
        Slot::Unknown(number) => *number = Some(value),
        Slot::Held(_)
        | Slot::Material(_)
        | Slot::Core(_)
        | Slot::ShearModuli(_)
        | Slot::PoissonRatios(_)
        | Slot::Layers(_) => {}
    }
}

/// Which values are plausible for a length of that name.
fn plausible(key: &str) -> &'static Use {
    match key {
        "diameter" => &DIAMETER,
        "depth" | "thickness" => &LITTLE,
        _ => &PLACE,
    }
}

/// A material by its built-in name, or by density, Young's modulus and, if known, shear modulus.
fn material(items: &[&str]) -> std::result::Result<Material, String> {
    let said = |complaint: Complaint| complaint.to_string();
    match items {
        [name] => Material::named(name).ok_or_else(|| {
            let names: Vec<&str> = BUILT_IN.iter().map(|known| known.name).collect();
            format!(
                "found \"{name}\", expected a built-in material ({}) or a density and a Young's modulus{}",
                names.join(", "),
                hint(name, &names)
            )
        }),
        [density, modulus] | [density, modulus, _] => {
            let density = units::parse_or_si(density, Quantity::Density).map_err(said)?;
            let modulus = units::parse_or_si(modulus, Quantity::Pressure).map_err(said)?;
            let shear = items.get(2).map(|shear| units::parse_or_si(shear, Quantity::Pressure));
            let shear_modulus = shear.transpose().map_err(said)?;
            let material = Material::new(density, modulus).map_err(|error| error.to_string())?;
            let material = Material { shear_modulus, ..material };
            material.check().map_err(|error| error.to_string())?;
            Ok(material)
        }
        _ => {
            Err("found no material, expected a built-in one or a density and a Young's modulus"
                .into())
        }
    }
}
