//! The advice: a table, a few lines, JSON.

use std::f64::consts::TAU;
use std::fmt::Write;

use crate::parts::terminal::wrapped;
use crate::parts::units::Units;
use crate::report::columns::{Columns, labels, numbers};
use crate::report::text::edited;
use crate::schema::advice as file;
use sweetspot::base::units::{inches, ounce_square_inches, ounces};
use sweetspot::bat::theory::Theory;
use sweetspot::files::schema::document::{BatName, Format, Generator};
use sweetspot::modes::damping::Damped;
use sweetspot_study::advise::advice::Advice;
use sweetspot_study::advise::effect::{Effect, Shift, Switch};
use sweetspot_study::advise::model::{Model, Solved};

/// Modes side by side in a table of 80 columns.
const ABREAST: usize = 5;
/// Columns of a row's name and of a number beside it.
const NAME: usize = 24;
const CELL: usize = 10;

/// The advice, 80 columns wide; `full` with nodes, the rigid body, damping and why effects are out of scope.
pub fn text(advice: &Advice, units: Units, full: bool) -> String {
    let whole = &advice.full;
    let mut out = wrapped(&format!("Advice on {}", whole.bat.name()), 4);
    out += &edited(&whole.bat, units);
    let worst = advice.effects.iter().flat_map(|effect| [&effect.with, &effect.without]);
    let worst = worst.map(|solved| solved.solution.worst()).fold(0.0, f64::max);
    let line = format!("  full model: {}; solved, each within {worst:.0e}", model(&whole.model));
    out += &wrapped(&line, 4);
    out += "Frequencies, and what each part does to them: with it against without it, in %\n";
    out += &tables(
        advice,
        "everything on, Hz",
        |k| frequency(whole, k),
        |effect, k| {
            let shift = &effect.shifts.as_ref()?[k];
            Some(percent(shift.frequency, shift.error))
        },
    );
    out += &others(advice);
    if full {
        out += &nodes(advice, units);
        out += &bodies(advice, units);
        out += &damping(advice);
    }
    for line in recommendation(advice) {
        out += &wrapped(&line, 2);
    }
    const OUTSIDE: &str = "Out of scope of every model here";
    if full {
        let why = advice.outside.iter().map(|sentence| wrapped(&format!("  {sentence}"), 4));
        return why.fold(out + OUTSIDE + "\n", |out, why| out + &why);
    }
    let names = advice.outside.iter().filter_map(|sentence| sentence.split(':').next());
    let names: Vec<&str> = names.collect();
    out + &wrapped(&format!("{OUTSIDE}: {}", names.join(", ")), 2)
}

/// Where each part moves the nodes.
fn nodes(advice: &Advice, units: Units) -> String {
    let mut out = String::new();
    for (scale, unit) in units.pick((100.0, "cm"), (inches(1.0), "in")) {
        let _ = writeln!(out, "Nodes: the one that each part moves most, towards the tip, {unit}");
        out += &tables(
            advice,
            "",
            |_| String::new(),
            |effect, k| {
                let shift = &effect.shifts.as_ref()?[k];
                let nodes = shift.nodes.as_ref()?;
                // Of those that a symmetric bat moves as far, the one next to the knob.
                let most = nodes.iter().fold(0.0, |most: f64, moved| {
                    if moved.abs() > (1.0 + 1e-6) * most.abs() { *moved } else { most }
                });
                let most = if nodes.is_empty() { return None } else { scale * most };
                // A rounding of nothing has no sign.
                Some(if most.abs() < 5e-3 { "0.00".to_owned() } else { format!("{most:+.2}") })
            },
        );
    }
    out
}

/// A few lines of it, for a page about everything.
pub fn short(advice: &Advice) -> String {
    let modes = advice.full.solution.modes.len();
    let mut shown = Vec::new();
    for effect in &advice.effects {
        // The sum of two others.
        if matches!(effect.switch, Switch::Theory | Switch::Attachments) {
            continue;
        }
        let Some(shifts) = &effect.shifts else {
            shown.push(format!("{} (other modes)", effect.switch.name()));
            continue;
        };
        let cell = |k: usize| percent(shifts[k].frequency, shifts[k].error);
        let range =
            if modes == 1 { cell(0) } else { format!("{} … {}", cell(0), cell(modes - 1)) };
        shown.push(format!("{} {range}", effect.switch.name()));
    }
    let whose = if modes == 1 { "f1".to_owned() } else { format!("f1 … f{modes}") };
    let mut out = wrapped(&format!("Advice: change of {whose}, %: {}", shown.join("; ")), 8);
    for line in recommendation(advice) {
        out += &wrapped(&format!("        {line}"), 8);
    }
    out
}

/// A block of rows for every five modes.
fn tables(
    advice: &Advice,
    first: &str,
    head: impl Fn(usize) -> String,
    cell: impl Fn(&Effect, usize) -> Option<String>,
) -> String {
    let modes = advice.full.solution.modes.len();
    let mut out = String::new();
    for from in (0..modes).step_by(ABREAST) {
        let block = from..modes.min(from + ABREAST);
        out += &row("", block.clone().map(|k| format!("mode {}", k + 1)));
        if !first.is_empty() {
            out += &row(first, block.clone().map(&head));
        }
        for effect in advice.effects.iter().filter(|effect| effect.shifts.is_some()) {
            let cells = block.clone().map(|k| cell(effect, k).unwrap_or_else(|| "-".to_owned()));
            out += &row(effect.switch.name(), cells);
        }
    }
    out
}

fn row(name: &str, cells: impl Iterator<Item = String>) -> String {
    let columns =
        Columns::new([labels(NAME, "")].into_iter().chain((0..ABREAST).map(|_| numbers(CELL, ""))));
    columns.row([name.to_owned()].into_iter().chain(cells))
}

fn frequency(solved: &Solved, k: usize) -> String {
    solved.solution.modes.get(k).map_or("-".to_owned(), |mode| shown(mode.frequency()))
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
fn percent(value: f64, error: f64) -> String {
    let [value, error] = [100.0 * value, 100.0 * error];
    match value.abs() {
        size if size <= error => format!("< {error:.0e}"),
        size if size >= 0.0995 => format!("{value:+.2}"),
        _ => format!("{value:+.1e}"),
    }
}

/// What cannot be set mode beside mode: both lists.
fn others(advice: &Advice) -> String {
    let modes = advice.full.solution.modes.len();
    let mut out = String::new();
    for effect in advice.effects.iter().filter(|effect| effect.shifts.is_none()) {
        let (with, without) = (&effect.with, &effect.without);
        let rigid = |solved: &Solved| solved.solution.rigid_modes;
        let name = effect.switch.name();
        let why = match (rigid(with), rigid(without)) {
            (a, b) if a == b => "the absorber's own mode is among them".to_owned(),
            (a, b) => format!("rigid motions: {a} with, {b} without"),
        };
        let line = format!("Other modes with and without {name}, in Hz ({why}); not to be paired");
        out += &wrapped(&line, 2);
        for from in (0..modes).step_by(ABREAST) {
            let block = from..modes.min(from + ABREAST);
            out += &row("", block.clone().map(|k| format!("mode {}", k + 1)));
            out += &row("with", block.clone().map(|k| frequency(with, k)));
            out += &row("without", block.map(|k| frequency(without, k)));
        }
    }
    out
}

/// Mass, balance point and swing weight, where something changes them.
fn bodies(advice: &Advice, units: Units) -> String {
    let both = |si: String, us: String| units.beside(si, us);
    let mut out = String::new();
    for effect in advice.effects.iter().filter(|effect| effect.switch != Switch::Theory) {
        let [mass, balance, swing] = effect.body;
        let us = format!("{:+.0} oz in²", ounce_square_inches(swing));
        let changes = [
            (mass, "mass", both(format!("{mass:+.4} kg"), format!("{:+.2} oz", ounces(mass)))),
            (
                balance,
                "balance point",
                both(format!("{balance:+.4} m"), format!("{:+.2} in", inches(balance))),
            ),
            (swing, "swing weight", both(format!("{swing:+.5} kg m²"), us)),
        ];
        let changes = changes.iter().filter(|(value, ..)| *value != 0.0);
        let changes: Vec<String> =
            changes.map(|(_, what, value)| format!("{what} {value}")).collect();
        if !changes.is_empty() {
            let line = format!("  {}: {}", effect.switch.name(), changes.join(", "));
            out += &wrapped(&line, 4);
        }
    }
    match out.is_empty() {
        true => out,
        false => format!("As a rigid body (swing weight: inertia 6 in from the knob)\n{out}"),
    }
}

fn damping(advice: &Advice) -> String {
    let Advice { damping, full, .. } = advice;
    let [least, most] = damping.material;
    // f√(1 − ζ²), to the first order.
    let lower = format!("it lowers a frequency by ζ²/2, {:.1e} of it at most", 0.5 * most * most);
    let mut out = match (least, most) {
        (_, 0.0) => wrapped("Damping: no material has a loss factor", 2),
        _ if least == most => {
            let line =
                format!("Damping: ζ = η/2 = {most:.4} in every mode, by the material; {lower}");
            wrapped(&line, 2)
        }
        _ => wrapped(
            &format!(
                "Damping: ζ between {least:.4} and {most:.4}, as a mode's strain is shared among \
                 materials and springs; {lower}"
            ),
            2,
        ),
    };
    if !damping.dashpots.is_empty() {
        let dashpots = damping.dashpots.join("; ");
        out += &wrapped(&format!("  with dashpots ({dashpots}), damped and undamped:"), 4);
    }
    let damped = &full.solution.damping.modes;
    if damped.len() < full.solution.modes.len() {
        return out;
    }
    for from in (0..damped.len()).step_by(ABREAST) {
        let block = from..damped.len().min(from + ABREAST);
        out += &row("", block.clone().map(|k| format!("mode {}", k + 1)));
        let ratio = |k: usize| two_digits(damped[k].ratio);
        out += &row("damping ratio", block.clone().map(ratio));
        // A mode that only creeps back has no frequency to compare.
        let moved = |k: usize| match damped[k].swinging() / full.solution.modes[k].omega {
            0.0 => "creeps".to_owned(),
            share => two_digits(100.0 * (share - 1.0)),
        };
        out += &row("frequency by damping, %", block.map(moved));
    }
    out
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
    let theory = match model.theory {
        Theory::EulerBernoulli | Theory::Auto => "Euler-Bernoulli",
        Theory::Rayleigh => "Rayleigh (rotary inertia)",
        Theory::Timoshenko => "Timoshenko (rotary inertia, shear)",
    };
    let parts: Vec<&str> = model.parts.iter().map(|part| part.name()).collect();
    match parts.is_empty() {
        true => theory.to_owned(),
        false => format!("{theory}, with {}", parts.join(", ")),
    }
}

/// The model that will do, and how it was checked.
pub fn recommendation(advice: &Advice) -> Vec<String> {
    let smallest = &advice.smallest;
    let tolerance = percent_of(advice.tolerance);
    let own = &smallest.solved.model;
    let left_out = advice.left_out();
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
            percent_of(smallest.deviation + smallest.error)
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
    if advice.full.bat.weighed().first_bending.is_some() {
        lines.push(
            "The stiffness is that of the tapped frequency with everything on, also where something \
             is left out; modes and hit fit it anew to the model that they are asked for"
                .to_owned(),
        );
    }
    if !advice.met() {
        lines.push(format!(
            "The full model's own frequencies are only known within {}",
            percent_of(advice.full.solution.worst())
        ));
    }
    lines
}

/// As a tolerance is said.
fn percent_of(value: f64) -> String {
    match value {
        v if v >= 1e-3 => format!("{} %", format!("{:.2e}", 100.0 * v).parse().unwrap_or(f64::NAN)),
        v => format!("{v:.0e}"),
    }
}

/// The `sweetspot-advice/1` document.
pub fn document(advice: &Advice) -> file::AdviceFile {
    let (full, smallest) = (&advice.full, &advice.smallest);
    let damped = |of: fn(&Damped) -> f64| -> Vec<f64> {
        full.solution.damping.modes.iter().map(of).collect()
    };
    file::AdviceFile {
        format: Format::new(),
        generator: Generator::this(),
        bat: BatName::of(&full.bat),
        modes: full.solution.modes.len(),
        tolerance: advice.tolerance,
        full_model: file::FullModel { model: of_model(full), tolerance_met: advice.met() },
        effects: advice.effects.iter().map(of_effect).collect(),
        damping: file::Damping {
            material_ratio: advice.damping.material,
            dashpots: advice.damping.dashpots.clone(),
            ratio_by_mode: damped(|damped| damped.ratio),
            damped_frequency_hz_by_mode: damped(|damped| damped.swinging() / TAU),
        },
        smallest_model: file::SmallestModel {
            model: of_model(&smallest.solved),
            left_out: advice.left_out(),
            deviation: smallest.deviation,
            deviation_error: smallest.error,
        },
        out_of_scope: advice.outside.clone(),
    }
}

fn of_model(solved: &Solved) -> file::SolvedModel {
    file::SolvedModel {
        theory: solved.model.theory.name(),
        parts: solved.model.parts.iter().map(|part| part.name()).collect(),
        rigid_modes: solved.solution.rigid_modes,
        frequencies_hz: solved.frequencies(),
        error_by_mode: solved.solution.modes.iter().map(|mode| mode.error.total()).collect(),
    }
}

fn of_effect(effect: &Effect) -> file::Effect {
    let numbers = |of: fn(&Shift) -> f64| -> Option<Vec<f64>> {
        Some(effect.shifts.as_ref()?.iter().map(of).collect())
    };
    let [mass_kg, balance_point_m, inertia_pivot_kg_m2] = effect.body;
    file::Effect {
        switch: effect.switch.name(),
        known: effect.switch != Switch::TypicalShear,
        with: of_model(&effect.with),
        without: of_model(&effect.without),
        shift_by_mode: numbers(|shift| shift.frequency),
        shift_error_by_mode: numbers(|shift| shift.error),
        node_shift_m_by_mode: (effect.shifts.as_ref())
            .map(|shifts| shifts.iter().map(|shift| shift.nodes.clone()).collect()),
        node_shift_error_m_by_mode: numbers(|shift| shift.node_error),
        mass_kg,
        balance_point_m,
        inertia_pivot_kg_m2,
    }
}
