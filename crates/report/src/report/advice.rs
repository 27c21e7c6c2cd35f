//! The advice: its text.

use schemars::JsonSchema;
use serde::Serialize;

use crate::parts::{Part, Quantity, Scale, Table, Units, wrapped};
use crate::report::edits;
use crate::report::text::theory;
use crate::schema::{Written, document};
use sweetspot::base::number::signed;
use sweetspot::files::schema::document::BatName;
use sweetspot_study::advise::advice::Advice;
use sweetspot_study::advise::effect::{Effect, Switch};
use sweetspot_study::advise::model::Model;

/// How each part of the model of a bat changes its modes, and the smallest model that suffices. SI units, named at the
/// end of each member; shifts of frequencies are relative; a value that does not exist is null. Later versions with the
/// same number may have more members.
#[derive(Debug, Clone, Serialize, JsonSchema)]
#[schemars(title = "Advice file of sweetspot, sweetspot-advice/1")]
pub struct AdviceFile {
    /// The bat.
    pub bat: BatName,
    /// What the model needs.
    #[serde(flatten)]
    pub advice: Advice,
}

document!(AdviceFile, "advice");

/// The document of that advice.
pub fn document(advice: &Advice) -> Written<AdviceFile> {
    let bat = BatName::of(&advice.full_model.solved.bat);
    Written::of(AdviceFile { bat, advice: advice.clone() })
}

/// Modes side by side in a table of 80 columns.
const ABREAST: usize = 5;

/// The title, and everything in order; `full` with nodes, the rigid body, damping and why effects are out of scope.
pub fn report(advice: &Advice, units: Units, full: bool) -> (String, Vec<Part<'static>>) {
    let whole = &advice.full_model.solved;
    let edited = edits::noted(&whole.bat, units);
    let worst = advice.effects.iter().flat_map(|effect| [&effect.with, &effect.without]);
    let worst = worst.map(|solved| solved.solution.worst()).fold(0.0, f64::max);
    let solved = format!("full model: {}; solved, each within {worst:.0e}", model(&whole.model));
    let mut parts = vec![
        Part::List(edited.into_iter().chain([solved]).collect()),
        Part::Heading(
            "Frequencies, and what each part does to them: with it against without it, in %",
        ),
    ];
    let hertz = row("everything on, Hz", &whole.frequencies_hz, |f| shown(*f));
    let rows = by_effect(advice, |effect, k| Some(percent(effect.shift(k)?)));
    let modes = if full { advice.modes } else { advice.modes.min(ABREAST) };
    parts.extend(tables(modes, &[vec![hertz], rows].concat()));
    advice.effects.iter().for_each(|effect| parts.extend(others(effect, modes)));
    let more = || Part::Text(format!("Modes {} to {}: --full", modes + 1, advice.modes));
    parts.extend((modes < advice.modes).then(more));
    if full {
        parts.extend(nodes(advice, units));
        parts.extend(bodies(advice, units));
        parts.extend(damping(advice));
    }
    parts.extend(recommendation(advice).into_iter().map(Part::Text));
    const OUTSIDE: &str = "Out of scope of every model here";
    if full {
        parts.extend([Part::Heading(OUTSIDE), Part::List(advice.out_of_scope.clone())]);
    } else {
        let names = advice.out_of_scope.iter().filter_map(|sentence| sentence.split(':').next());
        let names: Vec<&str> = names.collect();
        parts.push(Part::Text(format!("{OUTSIDE}: {}", names.join(", "))));
    }
    (format!("Advice on {}", whole.bat.title()), parts)
}

/// A row of a table: its name, and a cell for each mode.
type ModeRow = (String, Vec<String>);

fn row(name: &str, values: &[f64], shown: impl Fn(&f64) -> String) -> ModeRow {
    (name.to_owned(), values.iter().map(shown).collect())
}

/// A row for each effect whose modes can be paired.
fn by_effect(advice: &Advice, cell: impl Fn(&Effect, usize) -> Option<String>) -> Vec<ModeRow> {
    let paired = advice.effects.iter().filter(|effect| effect.shift_by_mode.is_some());
    let cells = |effect: &Effect| {
        let cells = (0..advice.modes).map(|k| cell(effect, k).unwrap_or_else(|| "-".to_owned()));
        (effect.switch.name().to_owned(), cells.collect())
    };
    paired.map(cells).collect()
}

/// A table of those rows for every five modes; a row has at most as many cells as there are modes.
fn tables(modes: usize, rows: &[ModeRow]) -> Vec<Part<'static>> {
    let block = |from: usize| {
        let block = from..modes.min(from + ABREAST);
        let heads = block.clone().map(|k| format!("mode {}", k + 1));
        let head = [String::new()].into_iter().chain(heads).collect();
        let mut table = Table { head, ..Table::default() };
        for (name, cells) in rows {
            let cells = block.clone().map(|k| cells.get(k).map_or("-", String::as_str));
            table.row([name.as_str()].into_iter().chain(cells));
        }
        Part::Table(table)
    };
    (0..modes).step_by(ABREAST).map(block).collect()
}

/// The shift of the nodes by each part.
fn nodes(advice: &Advice, units: Units) -> Vec<Part<'static>> {
    let cm = "Nodes: the one that each part moves most, towards the tip, cm";
    let inch = "Nodes: the one that each part moves most, towards the tip, in";
    let table = |(us, title): (bool, &'static str)| {
        let Scale { per, decimals, .. } = Quantity::Length.scale(us);
        let rows = by_effect(advice, |effect, k| {
            let nodes = effect.node_shift_m_by_mode.as_ref()?[k].as_ref()?;
            nodes.first()?;
            // A symmetric bat moves several nodes equally far; of these the one next to the knob is taken.
            let most = nodes.iter().fold(0.0, |most: f64, moved| {
                if moved.abs() > (1.0 + 1e-6) * most.abs() { *moved } else { most }
            });
            Some(signed(per * most, decimals))
        });
        [vec![Part::Heading(title)], tables(advice.modes, &rows)].concat()
    };
    units.pick((false, cm), (true, inch)).into_iter().flat_map(table).collect()
}

/// A few lines of it, for a page about the whole analysis.
pub fn short(advice: &Advice) -> String {
    let modes = advice.modes;
    let mut shown = Vec::new();
    for effect in &advice.effects {
        // The sum of two others.
        if matches!(effect.switch, Switch::Theory | Switch::Attachments) {
            continue;
        }
        let range = match effect.shift(0).zip(effect.shift(modes - 1)) {
            None => "(other modes)".to_owned(),
            Some((first, _)) if modes == 1 => percent(first),
            Some((first, last)) => format!("{} … {}", percent(first), percent(last)),
        };
        shown.push(format!("{} {range}", effect.switch.name()));
    }
    let whose = if modes == 1 { "f1".to_owned() } else { format!("f1 … f{modes}") };
    let mut out = wrapped(&format!("Advice: change of {whose}, %: {}", shown.join("; ")), 8);
    for line in recommendation(advice) {
        out += &wrapped(&format!("        {line}"), 8);
    }
    out
}

/// A frequency (Hz) that fits a cell.
fn shown(frequency: f64) -> String {
    if (0.1..1e6).contains(&frequency) {
        format!("{frequency:.2}")
    } else {
        format!("{frequency:.2e}")
    }
}

/// A relative change with its possible error, in % and without the sign for it.
fn percent([value, error]: [f64; 2]) -> String {
    let [value, error] = [100.0 * value, 100.0 * error];
    match value.abs() {
        size if size <= error => format!("< {error:.0e}"),
        size if size >= 0.0995 => format!("{value:+.2}"),
        _ => format!("{value:+.1e}"),
    }
}

/// Both lists of modes where they cannot be paired; empty where they can.
fn others(effect: &Effect, modes: usize) -> Vec<Part<'static>> {
    if effect.shift_by_mode.is_some() {
        return vec![];
    }
    let (with, without) = (&effect.with, &effect.without);
    let why = match (with.rigid_modes, without.rigid_modes) {
        (a, b) if a == b => "the absorber's own mode is among them".to_owned(),
        (a, b) => format!("rigid motions: {a} with, {b} without"),
    };
    let name = effect.switch.name();
    let told = format!("Other modes with and without {name}, in Hz ({why}); not to be paired");
    let rows = [("with", with), ("without", without)]
        .map(|(name, solved)| row(name, &solved.frequencies_hz, |f| shown(*f)));
    [vec![Part::Text(told)], tables(modes, &rows)].concat()
}

/// Mass, balance point and swing weight, where something changes them.
fn bodies(advice: &Advice, units: Units) -> Vec<Part<'static>> {
    let changes = |effect: &Effect| {
        let Effect { mass_kg: mass, balance_point_m: balance, inertia_pivot_kg_m2: swing, .. } =
            *effect;
        let changes = [
            (mass, "mass", Quantity::Mass),
            (balance, "balance point", Quantity::Length),
            (swing, "swing weight", Quantity::Inertia),
        ];
        let changes = changes.into_iter().filter(|(value, ..)| *value != 0.0);
        let said = |(value, what, quantity): (f64, &str, Quantity)| {
            format!("{what} {}", quantity.in_both(units, |scale| scale.change(value)))
        };
        let changes: Vec<String> = changes.map(said).collect();
        (!changes.is_empty()).then(|| format!("{}: {}", effect.switch.name(), changes.join(", ")))
    };
    let effects = advice.effects.iter().filter(|effect| effect.switch != Switch::Theory);
    let told: Vec<String> = effects.filter_map(changes).collect();
    if told.is_empty() {
        return vec![];
    }
    let title = "As a rigid body (swing weight: inertia 6 in from the knob)";
    vec![Part::Heading(title), Part::List(told)]
}

fn damping(advice: &Advice) -> Vec<Part<'static>> {
    let damping = &advice.damping;
    let [least, most] = damping.material_ratio;
    // f√(1 − ζ²), to first order.
    let lower = format!("it lowers a frequency by ζ²/2, {:.1e} of it at most", 0.5 * most * most);
    let mut told = match (least, most) {
        (_, 0.0) => "Damping: no material has a loss factor".to_owned(),
        _ if least == most => {
            format!("Damping: ζ = η/2 = {most:.4} in every mode, by the material; {lower}")
        }
        _ => format!(
            "Damping: ζ between {least:.4} and {most:.4}, as a mode's strain is shared among \
             materials and springs; {lower}"
        ),
    };
    if !damping.dashpots.is_empty() {
        let dashpots = damping.dashpots.join("; ");
        told += &format!("; with dashpots ({dashpots}), damped and undamped");
    }
    let mut parts = vec![Part::Text(told)];
    let solution = &advice.full_model.solved.solution;
    if damping.ratio_by_mode.len() < solution.modes.len() {
        return parts;
    }
    let pairs = solution.damping.modes.iter().zip(&solution.modes);
    // A mode that does not oscillate has no frequency to compare.
    let moved = pairs.map(|(damped, mode)| match damped.swinging() / mode.omega {
        0.0 => "creeps".to_owned(),
        share => two_digits(100.0 * (share - 1.0)),
    });
    let ratios = row("damping ratio", &damping.ratio_by_mode, |ratio| two_digits(*ratio));
    let moved = ("frequency by damping, %".to_owned(), moved.collect());
    parts.extend(tables(advice.modes, &[ratios, moved]));
    parts
}

/// Two digits, with a power of ten where the plain number would be a row of zeros.
fn two_digits(value: f64) -> String {
    let rounded: f64 = format!("{value:.1e}").parse().unwrap_or(value);
    match rounded.abs() {
        0.0 | 1e-2..1e4 => rounded.to_string(),
        _ => format!("{rounded:e}"),
    }
}

/// A model in words.
fn model(model: &Model) -> String {
    let theory = theory(model.theory);
    let parts: Vec<&str> = model.parts.iter().map(|part| part.name()).collect();
    match parts.is_empty() {
        true => theory.to_owned(),
        false => format!("{theory}, with {}", parts.join(", ")),
    }
}

/// The model that will do, and how it was checked.
pub fn recommendation(advice: &Advice) -> Vec<String> {
    let smallest = &advice.smallest_model;
    let tolerance = percent_of(advice.tolerance);
    let own = &smallest.solved.model;
    let left_out = &smallest.left_out;
    let mut lines = vec![match left_out.is_empty() {
        true => format!(
            "Smallest model within {tolerance}: the full one, {}; every smaller one, solved, is \
             further off or has other modes",
            model(own)
        ),
        false => format!(
            "Smallest model within {tolerance}: {} (--theory {}); without {}. Solved, it is within \
             {} of the full one in every frequency",
            model(own),
            own.theory.name(),
            left_out.join(", "),
            percent_of(smallest.deviation + smallest.deviation_error)
        ),
    }];
    if let Some(shift) = advice.unknown_shear() {
        let within = if shift > advice.tolerance { "more than" } else { "within" };
        lines.push(format!(
            "Shear is not known: a material has no \"shear_modulus\", so no model here has shear. \
             With the G/E of its kind it would change a frequency by up to {}, {within} the \
             tolerance",
            percent_of(shift)
        ));
    }
    if advice.full_model.solved.bat.weighed().first_bending.is_some() {
        lines.push(
            "The stiffness is that of the tapped frequency with everything on, also where something \
             is left out; modes and hit fit it anew to the model that they are asked for"
                .to_owned(),
        );
    }
    if !advice.full_model.tolerance_met {
        lines.push(format!(
            "The full model's own frequencies are only known within {}",
            percent_of(advice.full_model.solved.solution.worst())
        ));
    }
    lines
}

/// In the notation of a tolerance.
fn percent_of(value: f64) -> String {
    match value {
        v if v >= 1e-3 => format!("{} %", format!("{:.2e}", 100.0 * v).parse().unwrap_or(f64::NAN)),
        v => format!("{v:.0e}"),
    }
}
