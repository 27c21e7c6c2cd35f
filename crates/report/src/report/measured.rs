//! Measured modes compared with computed ones: tables of 80 columns, words, JSON.

use std::fmt::Write;

use faer::c64;

use crate::parts::{Columns, Quantity, Units, labels, numbers, wrapped};
use crate::report::text::edited;
use crate::schema::{Written, measured as file};
use sweetspot::Bat;
use sweetspot::base::number::{percent, signed};
use sweetspot_study::measured::pairing::{LEAST, octaves};
use sweetspot_study::measured::study::{Pair, Shapes, Study};
use sweetspot_study::measured::words::words;

/// Measured modes that a screen has.
const FEW: usize = 6;

/// Pairs of modes and words; `full` with every mode and the comparison of the shapes.
pub fn text(bat: &Bat, study: &Study, units: Units, full: bool) -> String {
    let mut out = format!("{}\n{}", bat.title(), edited(bat, units));
    out += &source(study, units);
    out += &modes(study, if full { usize::MAX } else { FEW });
    let shapes = study.shapes.as_ref().filter(|_| full && !study.bending.is_empty());
    if let Some(shapes) = shapes {
        out += &of_shapes(study, shapes);
        out += &mac(study, shapes);
        out += &common(study, shapes);
    }
    out += "In words\n";
    words(study).iter().for_each(|line| out += &wrapped(&format!("  {line}"), 4));
    out
}

/// The file, the numbers of modes and points, and the assumptions.
fn source(study: &Study, units: Units) -> String {
    let measured = &study.measured;
    let count = measured.modes.len();
    let mut text = format!("Measured: {}, {count} mode", measured.source);
    text += if count == 1 { "" } else { "s" };
    let mut out = match &study.shapes {
        None => wrapped(&format!("{text}, frequencies alone"), 10),
        Some(shapes) => {
            let x = &shapes.placed.x;
            let [first, last] = [x[0], x[x.len() - 1]].map(|x| Quantity::Length.said(units, x));
            let count = x.len();
            wrapped(&format!("{text} at {count} points, {first} to {last} from the knob end"), 10)
        }
    };
    let placed = study.shapes.iter().flat_map(|shapes| &shapes.placed.assumed);
    for line in measured.assumed.iter().chain(placed) {
        out += &wrapped(&format!("  {line}"), 4);
    }
    out
}

/// A name as wide as its column.
fn cut(name: &str, width: usize) -> String {
    match name.chars().count() > width {
        true => name.chars().take(width - 1).chain(['…']).collect(),
        false => name.to_owned(),
    }
}

/// Frequencies and damping side by side, for the given number of measured modes at most.
fn modes(study: &Study, most: usize) -> String {
    let theory = study.solution.theory.name();
    let by = match &study.shapes {
        Some(_) => format!("paired by shape, a MAC of {LEAST} at least"),
        None => "paired by their numbers".to_owned(),
    };
    let mut out = format!("Modes ({theory}; {by})\n");
    let own = || [labels(12, "measured"), numbers(12, "frequency"), numbers(9, "damping")];
    let computed = [
        numbers(6, "mode"),
        numbers(13, "computed"),
        numbers(9, "damping"),
        numbers(10, "computed"),
        numbers(7, "MAC"),
    ];
    let (beside, alone) = (
        Columns::new(own().into_iter().chain(computed)),
        Columns::new(own().into_iter().chain([labels(0, "")])),
    );
    out += &beside.heads();
    out += &beside.row(["", "", "", "", "", "", "off by"]);
    for (k, mode) in study.measured.modes.iter().enumerate().take(most) {
        let damping = mode.damping_ratio.map_or(String::new(), |ratio| percent(ratio, 2));
        let own = [cut(&mode.name, 12), format!("{:.2} Hz", mode.frequency), damping];
        let own = own.into_iter();
        out += &match study.pairs.iter().find(|pair| pair.measured == k) {
            Some(pair) => beside.row(own.chain(partner(study, pair))),
            None => alone.row(own.chain([without_partner(study, k)])),
        };
    }
    let more = study.measured.modes.len().saturating_sub(most);
    if more > 0 {
        let _ = writeln!(out, "  and {more} more");
    }
    let errors = study.pairs.iter().map(|pair| pair.within).fold(0.0, f64::max);
    if !study.pairs.is_empty() {
        let stated =
            format!("  the computed frequencies are within {errors:.0e} of this bat's model");
        out += &wrapped(&stated, 4);
    }
    let lone: Vec<String> = study
        .lone_computed
        .iter()
        .map(|k| format!("{} ({:.1} Hz)", k + 1, study.solution.modes[*k].frequency()))
        .collect();
    if !lone.is_empty() {
        out += &wrapped(&format!("  computed and not measured: mode {}", lone.join(", ")), 4);
    }
    out
}

/// The computed mode paired with a measured one.
fn partner(study: &Study, pair: &Pair) -> [String; 5] {
    let mode = &study.solution.modes[pair.computed];
    let damping = study.solution.damping.modes.get(pair.computed);
    let damping = damping.map_or(String::new(), |damped| percent(damped.ratio, 2));
    let off = pair.difference.map_or(String::new(), |d| format!("{} %", signed(100.0 * d, 2)));
    let mac = pair.mac.map_or(String::new(), |mac| format!("{mac:.3}"));
    [mode.order.to_string(), format!("{:.2} Hz", mode.frequency()), damping, off, mac]
}

/// Why a measured mode has no computed partner.
fn without_partner(study: &Study, k: usize) -> String {
    if let Some(mode) = study.rigid.iter().find(|mode| mode.measured == k) {
        return format!("rigid on its supports, {} off a straight line", percent(mode.bent, 1));
    }
    if let Some(order) = study.measured.modes[k].order {
        return format!("mode {order} was not computed");
    }
    match taken(study, k) {
        Some(pair) => {
            let name = cut(study.name(pair.measured), 12);
            format!("like mode {}, but {name} is more so", pair.computed + 1)
        }
        None => "like no computed mode within an octave".to_owned(),
    }
}

/// The pair of the computed mode to which an unpaired measured mode is similar.
fn taken(study: &Study, k: usize) -> Option<&Pair> {
    let row = study.bending.iter().position(|bending| *bending == k)?;
    let row = &study.shapes.as_ref()?.mac[row];
    let frequency = |pair: &Pair| study.solution.modes[pair.computed].frequency();
    let own = study.measured.modes[k].frequency;
    let like =
        |pair: &&Pair| row[pair.computed] >= LEAST && octaves(own, frequency(pair)).is_some();
    let mac = |pair: &&Pair| row[pair.computed];
    study.pairs.iter().filter(like).max_by(|a, b| mac(a).total_cmp(&mac(b)))
}

/// Scale, phase and rigid motion of every measured shape.
fn of_shapes(study: &Study, shapes: &Shapes) -> String {
    let mut out = String::from(
        "Shapes               scale   in phase  rigid motion  of the computed one,\n\
         \u{20}                                      in it         at these points\n",
    );
    for (row, k) in study.bending.iter().enumerate() {
        let pair = study.pairs.iter().find(|pair| pair.measured == *k);
        let scale = pair.and_then(|pair| pair.scale).map_or(String::new(), factor);
        let phase = percent(1.0 - shapes.out_of_phase[row], 1);
        let share = |list: Option<f64>| list.map_or(String::new(), |share| percent(share, 1));
        let own = share(shapes.rigid_share.as_ref().map(|list| list[row]));
        let sampled = share(shapes.sampled_rigid_share.as_ref().and_then(|list| list[row]));
        let name = cut(study.name(*k), 12);
        let line = format!("  {name:<12}{scale:>12}{phase:>11}{own:>14}{sampled:>18}");
        let _ = writeln!(out, "{}", line.trim_end());
    }
    if shapes.common.is_none() {
        let why = "  an absorber moves more than the bat beneath it, and was not measured: what rigid \
                   motion the shapes carry, and their mass orthogonality, cannot be told";
        out += &wrapped(why, 2);
    } else if shapes.rigid_share.is_none() {
        out += "  what holds the bat pushes it: its shapes may carry rigid motion\n";
    }
    out
}

/// A factor as a size with a sign: that of the nearer of in phase and against it.
fn factor(scale: c64) -> String {
    let size = if scale.re < 0.0 { -scale.norm() } else { scale.norm() };
    match size.abs() {
        0.01..1e4 => format!("{size:+.4}"),
        _ => format!("{size:+.3e}"),
    }
}

/// Columns that fit.
const COLUMNS: usize = 10;

fn mac(study: &Study, shapes: &Shapes) -> String {
    let columns = study.solution.modes.len().min(COLUMNS);
    let mut out = format!("{:14}", "MAC, computed:");
    (1..=columns).for_each(|k| {
        let _ = write!(out, "{k:>6}");
    });
    out.push('\n');
    for (k, row) in study.bending.iter().zip(&shapes.mac) {
        let cells: String = row.iter().take(columns).map(|mac| format!("{mac:>6.3}")).collect();
        let _ = writeln!(out, "  {:<12}{cells}", cut(study.name(*k), 12));
    }
    if study.solution.modes.len() > columns {
        let _ = writeln!(out, "  those above mode {columns} are in the JSON");
    }
    out
}

/// Mass orthogonality of every two shapes.
fn common(study: &Study, shapes: &Shapes) -> String {
    let count = study.bending.len().min(COLUMNS);
    let Some(own) = shapes.common.as_ref().filter(|_| count > 1) else { return String::new() };
    let mut out = wrapped(
        "Mass orthogonality: 0 between two modes, 1 for a mode with itself. Below the diagonal the \
         measured shapes; above it the computed ones they are paired with, from these points alone",
        2,
    );
    for (i, k) in study.bending.iter().enumerate().take(count) {
        let cell = |j: usize| match j {
            j if j < i => format!("{:>6.3}", own[i][j]),
            j if j > i => {
                shapes.sampled_common[i][j].map_or(" ".repeat(6), |v| format!("{v:>6.3}"))
            }
            _ => format!("{:>6}", "1"),
        };
        let line = format!(
            "  {:<12}{}",
            cut(study.name(*k), 12),
            (0..count).map(cell).collect::<String>()
        );
        let _ = writeln!(out, "{}", line.trim_end());
    }
    out
}

/// The `sweetspot-measured/1` document; `file` is the name of the bat's file.
pub fn document(bat: &Bat, file: &str, study: &Study) -> Written<file::MeasuredFile> {
    let solution = &study.solution;
    let computed = solution.modes.iter().enumerate().map(|(k, mode)| file::ComputedMode {
        order: mode.order,
        frequency_hz: mode.frequency(),
        damping_ratio: solution.damping.modes.get(k).map_or(0.0, |damped| damped.ratio),
        error: Some(mode.error.total()),
    });
    Written::of(file::MeasuredFile {
        bat: file::ComputedBat {
            name: bat.name().to_owned(),
            file: file.to_owned(),
            edits: bat.edits().to_vec(),
            theory: solution.theory.name(),
        },
        source: study.measured.source.clone(),
        assumed: study.measured.assumed.clone(),
        measured: (0..study.measured.modes.len()).map(|k| of_measured(study, k)).collect(),
        computed: computed.collect(),
        pairs: study.pairs.iter().map(|pair| of_pair(study, pair)).collect(),
        least_mac: LEAST,
        unpaired_measured: names(study, &study.lone_measured),
        unpaired_computed: study.lone_computed.iter().map(|k| k + 1).collect(),
        words: words(study),
        shapes: study.shapes.clone(),
    })
}

fn names(study: &Study, modes: &[usize]) -> Vec<String> {
    modes.iter().map(|k| study.name(*k).to_owned()).collect()
}

fn of_measured(study: &Study, k: usize) -> file::MeasuredMode {
    let mode = &study.measured.modes[k];
    let rigid = study.rigid.iter().find(|rigid| rigid.measured == k);
    let row = study.bending.iter().position(|bending| *bending == k);
    let shape = study.shapes.as_ref().zip(row);
    file::MeasuredMode {
        name: mode.name.clone(),
        frequency_hz: mode.frequency,
        damping_ratio: mode.damping_ratio,
        kind: if rigid.is_some() { "rigid" } else { "bending" },
        off_a_straight_line: rigid.map(|rigid| rigid.bent),
        phase_collinearity: shape.map(|(shapes, row)| shapes.collinearity[row]),
        out_of_phase: shape.map(|(shapes, row)| shapes.out_of_phase[row]),
        rigid_share: shape.and_then(|(shapes, row)| Some(shapes.rigid_share.as_ref()?[row])),
        rigid_share_of_computed: shape
            .and_then(|(shapes, row)| shapes.sampled_rigid_share.as_ref()?[row]),
    }
}

fn of_pair(study: &Study, pair: &Pair) -> file::Pair {
    file::Pair {
        measured: study.name(pair.measured).to_owned(),
        computed: pair.computed + 1,
        mac: pair.mac,
        frequency_difference: pair.difference,
        computed_within: pair.within,
        within_errors: pair.difference.map(|difference| difference.abs() <= pair.within),
        scale: pair.scale.map(|scale| file::Complex { real: scale.re, imaginary: scale.im }),
    }
}
