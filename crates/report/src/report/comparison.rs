//! Several bats side by side: tables of 80 columns, and words.

use crate::parts::{Columns, Quantity, Scale, Shown, Units, WIDE, first, lines, numbers, wrapped};
use crate::report::edits;
use crate::report::trust::doubts;
use sweetspot::base::number::significant;
use sweetspot::collision::Scene;
use sweetspot_study::comparison::contender::Contender;
use sweetspot_study::comparison::rows::{ComparedFigure, Difference, From, Unit, energies_compare};
use sweetspot_study::comparison::stretches::{Harder, Stretch};
use sweetspot_study::comparison::table::Comparison;
use sweetspot_study::ignored::in_hit;
use sweetspot_study::verdict::Doubt;

/// The keys of the most important rows, in order; all others follow.
pub const FIRST: [&str; 10] = [
    "best_exit_speed",
    "best_place",
    "zone_from",
    "zone_to",
    "swing_weight",
    "mass",
    "length",
    "balance_point",
    "frequency_1",
    "largest_bbcor",
];

/// The beginning of sentences about where along the barrel a bat is faster.
pub const ALONG: &str = "By distance from the tip";

/// The label of a bat in the tables: A, B, …
pub fn letter(bat: usize) -> char {
    char::from(b'A' + bat as u8)
}

/// The unit of a row in the tables.
fn scale(unit: Unit, us: bool) -> Scale {
    let quantity = match unit {
        Unit::Metres => Quantity::Length,
        Unit::Kilograms => Quantity::Mass,
        Unit::KilogramSquareMetres => Quantity::Inertia,
        Unit::MetresPerSecond => return Scale { decimals: 2, ..Quantity::Speed.scale(us) },
        Unit::Hertz => Quantity::Frequency,
        Unit::RadiansPerSecond => Quantity::Turning,
        Unit::Joules => Quantity::Energy,
        Unit::One => Quantity::Ratio(4),
    };
    quantity.scale(us)
}

/// A difference with at most this number of decimals is shown in full, a smaller one as a power of ten.
const MOST_DECIMALS: usize = 4;

/// A difference with its sign, with more decimals where these would hide it; "none" within the errors.
fn by(Scale { per, decimals, .. }: Scale, difference: Difference) -> String {
    if !difference.beyond_errors {
        return "none".to_owned();
    }
    let by = difference.by * per;
    let mut told =
        (decimals..=decimals.max(MOST_DECIMALS)).map(|decimals| format!("{by:+.decimals$}"));
    let shows = |text: &String| text.bytes().any(|b| (b'1'..=b'9').contains(&b));
    told.find(shows).unwrap_or_else(|| format!("{by:+.0e}"))
}

/// The error of a difference from that value, in words.
fn within(scale: Scale, difference: Difference, value: f64) -> String {
    match difference.within * scale.per {
        _ if difference.within <= 1e-11 * value.abs() => "exact".to_owned(),
        w if w >= 0.1 => format!("{w:.1}"),
        w if w >= 0.001 => format!("{w:.3}"),
        w => format!("{w:.0e}"),
    }
}

/// Everything for the terminal.
pub fn text(comparison: &Comparison, units: Units) -> String {
    let mut out = bats(comparison, units, true) + &hit(comparison, units);
    let within = "Within: how far a difference may be off by the computation, from the errors stated of both \
                  bats; less with a smaller --tol. A difference within it is shown as none.";
    out += &wrapped(within, 5);
    if comparison.bats.len() > 2 {
        out += &format!("\n{}", table(comparison, &rows(comparison, units)));
    }
    for bat in 1..comparison.bats.len() {
        out += &pair(comparison, bat, units);
    }
    out += "\nIn words\n";
    words(comparison, units).iter().for_each(|line| out += &wrapped(&format!("  {line}"), 4));
    out
}

/// The bats, each in a line with its doubts; `full` adds the beam model and the neglected effects.
pub fn bats(comparison: &Comparison, units: Units, full: bool) -> String {
    let mut out = String::from("Bats compared; A is the one the others are measured by\n");
    for (k, Contender { bat, scene, sweep, verdict, .. }) in comparison.bats.iter().enumerate() {
        let solution = &sweep.solution;
        let about: Vec<&str> = verdict.doubts.iter().map(Doubt::about).collect();
        let more = match full {
            true => format!(" ({}, {} modes)", solution.theory.name(), solution.modes.len()),
            false if about.is_empty() => String::new(),
            false => format!(" (in doubt: {})", about.join(", ").replace('_', " ")),
        };
        out += &wrapped(&format!("  {}  {}{more}", letter(k), bat.title()), 5);
        let left_out = in_hit(bat, scene).into_iter().filter(|_| full);
        let notes = edits::noted(bat, units)
            .into_iter()
            .chain(left_out.map(|effect| format!("left out: {effect}")));
        notes.for_each(|note| out += &wrapped(&format!("     {note}"), 5));
    }
    out
}

/// The conditions common to all hits.
pub fn hit(comparison: &Comparison, units: Units) -> String {
    let Scene { pivot, ball, ball_speed, .. } = &comparison.bats[0].scene;
    let side = if *pivot < 0.0 { "inside" } else { "beyond" };
    let scene = format!(
        "Hit: model {}, swung about a point {} {side} the knob end, {} at {}",
        comparison.terms.model.name(),
        Quantity::Length.said(units, pivot.abs()),
        ball.title(),
        Quantity::Speed.said(units, *ball_speed),
    );
    wrapped(&scene, 5) + &wrapped(&swing(comparison, units), 5)
}

/// The law that relates the swings of the bats.
pub fn swing(comparison: &Comparison, units: Units) -> String {
    let first = &comparison.bats[0];
    match (first.law, comparison.terms.barrel) {
        (None, Some(barrel)) => {
            let each = comparison.bats.iter().enumerate();
            let each =
                each.map(|(k, bat)| format!("{} at {:.1} rad/s", letter(k), bat.scene.swing));
            format!(
                "     All barrels move at {} where they are {} from the tip: {}",
                Quantity::Speed.said(units, barrel.speed),
                Quantity::Length.said(units, barrel.from_tip),
                each.collect::<Vec<_>>().join(", ")
            )
        }
        (None, None) => format!(
            "     All are swung at {:.1} rad/s, whatever they weigh; --reference-inertia and \
             --swing-exponent have one batter swing each",
            first.scene.swing
        ),
        (Some(law), _) => format!(
            "     One batter swings each: {:.1} rad/s times ({:.4} kg m² over its swing weight) to \
             the power {}",
            law.of_reference, law.reference, law.exponent
        ),
    }
}

/// Rows with information in this comparison: places from the tip appear only where lengths differ.
fn shown(comparison: &Comparison) -> impl Iterator<Item = &ComparedFigure> {
    let both = !comparison.same_length();
    comparison.figures.iter().filter(move |row| {
        row.values.iter().any(Option::is_some) && (both || row.from != From::Tip)
    })
}

/// A row of figures for people: label, the value of each bat, and the difference of each other bat from the first.
#[derive(Debug, Clone, PartialEq)]
pub struct ComparisonRow {
    /// Key of the figure, as in JSON and CSV.
    pub key: String,
    /// The quantity with its unit, complete without the row above it.
    pub label: String,
    /// The value of every bat; empty where it has none.
    pub values: Vec<String>,
    /// Difference of the second bat and those after it from the first; "none" within the errors.
    pub differences: Vec<String>,
    /// How far these may be off by the computation.
    within: Vec<String>,
    /// These differences in the other system of units, where both are shown.
    other: Vec<String>,
    /// The difference between two pieces of one wood, with ±; empty where it is not known.
    pub pieces: String,
    /// Whether any bat differs from the first by more than the errors.
    pub differs: bool,
}

/// The name of a row, complete without other rows.
fn alone(figure: &ComparedFigure) -> String {
    let name = match figure.key.trim_end_matches("_from_tip") {
        "best_place" => "sweet spot",
        "zone_from" => "sweet zone from",
        "zone_to" => "sweet zone to",
        "least_vibration_place" => "place of least vibration",
        _ => &figure.name,
    };
    let tip = if figure.from == From::Tip { ", from the tip" } else { "" };
    format!("{name}{tip}")
}

/// A row of a figure, with that label before its unit.
fn row(figure: &ComparedFigure, label: &str, units: Units) -> ComparisonRow {
    let us = units.us_first();
    let [scale, other] = [us, !us].map(|us| scale(figure.unit, us));
    let unit = if scale.name.is_empty() { "" } else { &format!(", {}", scale.name) };
    let first = figure.values[0].map_or(0.0, |figure| figure.value);
    let each = || (1..figure.values.len()).map(|bat| figure.difference(bat));
    let told = |said: &dyn Fn(Difference) -> String| -> Vec<String> {
        each().map(|difference| difference.map_or(String::new(), said)).collect()
    };
    let in_other = |difference: Difference| {
        let shown = units.both() && difference.beyond_errors && other.name != scale.name;
        if shown { format!("{} {}", by(other, difference), other.name) } else { String::new() }
    };
    let pieces = figure.values.iter().flatten().filter_map(|value| value.between_pieces);
    let pieces = pieces.fold(0.0, f64::max) * scale.per;
    ComparisonRow {
        key: figure.key.clone(),
        label: format!("{label}{unit}"),
        values: (figure.values.iter())
            .map(|value| value.map_or(String::new(), |value| scale.value(value.value)))
            .collect(),
        differences: told(&|difference| by(scale, difference)),
        within: told(&|difference| within(scale, difference, first)),
        other: told(&in_other),
        pieces: if pieces > 0.0 { format!("± {}", significant(pieces, 2)) } else { String::new() },
        differs: each().flatten().any(|difference| difference.beyond_errors),
    }
}

/// Every row with information.
pub fn rows(comparison: &Comparison, units: Units) -> Vec<ComparisonRow> {
    shown(comparison).map(|figure| row(figure, &alone(figure), units)).collect()
}

/// The values of as many bats as there is room for, at least the first, and the differences of the others.
pub fn table(comparison: &Comparison, rows: &[ComparisonRow]) -> String {
    const WIDTH: usize = 9;
    let count = comparison.bats.len();
    let shown = if count == 3 { count } else { 1 };
    let label = (WIDE - WIDTH * (count + shown - 1)).min(32);
    let heads = (0..shown).map(|k| numbers(WIDTH, letter(k)));
    let heads = heads.chain((1..count).map(|k| numbers(WIDTH, format!("{} less A", letter(k)))));
    let heads = [first(label, "What differs, and by how much")].into_iter().chain(heads);
    let columns = Columns::new(heads);
    let rows = rows.iter().map(|ComparisonRow { label, values, differences, .. }| {
        columns.row([&format!("  {label}")].into_iter().chain(&values[..shown]).chain(differences))
    });
    columns.heads() + &rows.collect::<String>()
}

/// One bat compared with the first: figures, then exit speeds by place.
fn pair(comparison: &Comparison, bat: usize, units: Units) -> String {
    let label = |figure: &ComparedFigure| match figure.from {
        // It comes after the same place from the knob end.
        From::Tip => "  from the tip".to_owned(),
        _ => figure.name.clone(),
    };
    let all: Vec<_> = shown(comparison).map(|figure| row(figure, &label(figure), units)).collect();
    let mut out = beside(&format!("{} beside A", letter(bat)), &all, bat, units);
    let near: Vec<_> = comparison.from_tip.iter().zip(&comparison.by_tip).step_by(4).collect();
    out += &by_place("Exit speed from the tip", &near, bat, units);
    if !comparison.same_length() {
        let near: Vec<_> = comparison.from_knob.iter().zip(&comparison.by_knob).collect();
        out += &by_place("Exit speed from the knob end", &near, bat, units);
    }
    out
}

/// Rows of one bat compared with those of the first, 80 columns wide.
pub fn beside(title: &str, rows: &[ComparisonRow], bat: usize, units: Units) -> String {
    let less = format!("{} less A", letter(bat));
    let other = if units.both() { less.clone() } else { String::new() };
    let columns: &[Shown<ComparisonRow>] = &[
        (first(32, title), &|row| format!("  {}", row.label)),
        (numbers(9, "A"), &|row| row.values[0].clone()),
        (numbers(9, letter(bat)), &|row| row.values[bat].clone()),
        (numbers(10, less), &|row| row.differences[bat - 1].clone()),
        (numbers(8, "within"), &|row| row.within[bat - 1].clone()),
        (numbers(12, other), &|row| row.other[bat - 1].clone()),
    ];
    format!("\n{}", lines(rows, columns))
}

fn by_place(title: &str, all: &[(&f64, &ComparedFigure)], bat: usize, units: Units) -> String {
    let hit =
        |(_, row): &&(&f64, &ComparedFigure)| row.values[0].is_some() || row.values[bat].is_some();
    let row = |(distance, figure): &(&f64, &ComparedFigure)| {
        row(figure, &format!("at {}", Quantity::Length.said(units, **distance)), units)
    };
    let rows: Vec<ComparisonRow> = all.iter().filter(hit).map(row).collect();
    if rows.is_empty() { String::new() } else { beside(title, &rows, bat, units) }
}

/// A sentence or two about each bat compared with the first.
pub fn words(comparison: &Comparison, units: Units) -> Vec<String> {
    let mut all = vec![];
    for bat in 1..comparison.bats.len() {
        all.push(best(comparison, bat, units));
        all.push(of_pieces(comparison, bat));
        let parts = along(comparison, bat, units);
        if !parts.is_empty() {
            all.push(format!("{ALONG}: {parts}."));
        }
        all.extend(swung(comparison, bat));
    }
    if !energies_compare(&comparison.bats) {
        all.push(NO_ENERGIES.to_owned());
    }
    for contender in &comparison.bats {
        let of = |text| format!("{}: {text}", contender.bat.title());
        all.extend(doubts(&contender.verdict, units).into_iter().map(of));
    }
    all
}

/// Where along the barrel that bat or the first is faster; empty where neither is hit.
pub fn along(comparison: &Comparison, bat: usize, units: Units) -> String {
    let tenths = |scale| Scale { decimals: 1, ..scale };
    let place = |x: f64| Quantity::Length.in_both(units, |scale| tenths(scale).text(x));
    let stretch = |s: &Stretch| stretch(s, letter(bat), &place, units);
    let parts: Vec<String> = comparison.stretches(bat).iter().map(stretch).collect();
    parts.join("; ")
}

/// How that bat is swung, where the first is swung otherwise.
pub fn swung(comparison: &Comparison, bat: usize) -> Option<String> {
    let [this, first] = [bat, 0].map(|k| comparison.bats[k].scene.swing);
    let name = letter(bat);
    (this != first).then(|| format!("{name} is swung at {this:.2} rad/s, A at {first:.2}."))
}

const NO_ENERGIES: &str = "Vibration is not compared: the energies of a held bat are as its hands see \
                           them, those of a free one as the ground does.";

/// Whose best hit is faster.
fn best(comparison: &Comparison, bat: usize, units: Units) -> String {
    let name = letter(bat);
    let figure = comparison.figure("best_exit_speed", bat);
    let Some((figure, difference)) = figure.and_then(|of| Some((of, of.difference?))) else {
        return format!(
            "{name} and A cannot be compared at their best: one of them does not hit the ball."
        );
    };
    let speed = |v: f64| by_speed(v, units);
    if !difference.beyond_errors {
        return format!(
            "{name} and A hit equally hard at their best: the difference is no more than the \
             computation's error, {}.",
            speed(difference.within)
        );
    }
    let (harder, other) = if difference.by > 0.0 { (name, 'A') } else { ('A', name) };
    let by =
        format!("{harder} hits harder at its best than {other}, by {}", speed(difference.by.abs()));
    match figure.between_pieces {
        Some(pieces) if difference.by.abs() > pieces => {
            format!(
                "{by}: a clear difference; two pieces of one wood differ by ± {}.",
                speed(pieces)
            )
        }
        Some(pieces) => format!(
            "{by}. That is less than the ± {} by which two pieces of one wood differ: of two such bats from \
             a shelf either may hit harder.",
            speed(pieces)
        ),
        None => format!("{by}."),
    }
}

/// Whether the wood's scatter is in a comparison, in a sentence; ± is one standard deviation.
pub fn of_pieces(comparison: &Comparison, bat: usize) -> String {
    let name = letter(bat);
    if comparison.one_piece(bat) {
        return format!(
            "{name} and A are one and the same piece: what pieces of one wood differ by cancels."
        );
    }
    let figure = comparison.figure("frequency_1", bat);
    if figure.and_then(|figure| figure.between_pieces).is_none() {
        return format!(
            "How much two pieces of the material of {name} and A differ is not known here: the errors are \
             those of the computation alone."
        );
    }
    format!(
        "± is one standard deviation between two pieces, the wood of {name} and of A each by itself; the \
         errors beside it are those of the computation alone."
    )
}

fn by_speed(v: f64, units: Units) -> String {
    Quantity::Speed.in_both(units, |Scale { per, name, .. }| match per * v {
        v if v >= 0.1 => format!("{v:.2} {name}"),
        v => format!("{v:.1e} {name}"),
    })
}

fn stretch(s: &Stretch, name: char, place: &dyn Fn(f64) -> String, units: Units) -> String {
    let [from, to] = s.from_tip_m;
    let at = match from == to {
        true => format!("at {}", place(from)),
        false => format!("from {} to {}", place(from), place(to)),
    };
    let Some(harder) = s.harder else { return format!("no significant difference {at}") };
    format!(
        "{at} {} is faster, by up to {} at {}",
        if harder == Harder::This { name } else { 'A' },
        by_speed(s.largest_difference_m_s.abs(), units),
        place(s.largest_at_from_tip_m)
    )
}
