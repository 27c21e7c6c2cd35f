//! Several bats side by side: tables of 80 columns, and words.

use crate::parts::{Columns, Units, first, numbers, wrapped};
use crate::report::edits;
use crate::report::trust::doubts;
use sweetspot::base::number::significant;
use sweetspot::base::units::{inches, miles_per_hour, ounce_square_inches, ounces};
use sweetspot::collision::Scene;
use sweetspot_study::comparison::contender::Contender;
use sweetspot_study::comparison::rows::{
    Compared, ComparedFigure, Difference, From, Unit, energies_compare,
};
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

/// Factor, decimals and name of a unit in the tables.
struct Scale {
    factor: f64,
    decimals: usize,
    name: &'static str,
}

fn scale(unit: Unit, units: Units) -> Scale {
    let (us, (energy, per)) = (units.us_first(), units.of_energy());
    let of = |factor, decimals, name| Scale { factor, decimals, name };
    match (unit, us) {
        (Unit::Metres, false) => of(100.0, 2, "cm"),
        (Unit::Metres, true) => of(inches(1.0), 2, "in"),
        (Unit::Kilograms, false) => of(1000.0, 1, "g"),
        (Unit::Kilograms, true) => of(ounces(1.0), 2, "oz"),
        (Unit::KilogramSquareMetres, false) => of(1.0, 5, "kg m²"),
        (Unit::KilogramSquareMetres, true) => of(ounce_square_inches(1.0), 0, "oz in²"),
        (Unit::MetresPerSecond, false) => of(1.0, 2, "m/s"),
        (Unit::MetresPerSecond, true) => of(miles_per_hour(1.0), 2, "mph"),
        (Unit::Hertz, _) => of(1.0, 1, "Hz"),
        (Unit::RadiansPerSecond, _) => of(1.0, 2, "rad/s"),
        (Unit::Joules, _) => of(per, 2, energy),
        (Unit::One, _) => of(1.0, 4, ""),
    }
}

/// A difference with at most this number of decimals is shown in full, a smaller one as a power of ten.
const MOST_DECIMALS: usize = 4;

impl Scale {
    fn value(&self, value: f64) -> String {
        format!("{:.*}", self.decimals, value * self.factor + 0.0)
    }

    /// A difference with its sign, with more decimals where these would hide it.
    fn difference(&self, difference: Difference) -> String {
        if !difference.beyond_errors {
            return "none".to_owned();
        }
        let by = difference.by * self.factor;
        let decimals = (self.decimals..=self.decimals.max(MOST_DECIMALS))
            .map(|decimals| format!("{by:+.decimals$}"));
        let shows = |text: &String| text.bytes().any(|b| (b'1'..=b'9').contains(&b));
        decimals.into_iter().find(shows).unwrap_or_else(|| format!("{by:+.0e}"))
    }

    /// The error of a difference, in words.
    fn within(&self, difference: Difference, value: f64) -> String {
        let within = difference.within * self.factor;
        match within {
            _ if difference.within <= 1e-11 * value.abs() => "exact".to_owned(),
            w if w >= 0.1 => format!("{w:.1}"),
            w if w >= 0.001 => format!("{w:.3}"),
            w => format!("{w:.0e}"),
        }
    }
}

/// Everything for the terminal.
pub fn text(comparison: &Comparison, units: Units) -> String {
    let mut out = bats(comparison, units, true) + &hit(comparison, units);
    let within = "Within: how far a difference may be off by the computation, from the errors stated of both \
                  bats; less with a smaller --tol. A difference within it is shown as none.";
    out += &wrapped(within, 5);
    if comparison.bats.len() > 2 {
        out += &overview(comparison, units);
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
        units.inline(units.length(pivot.abs())),
        ball.title(),
        units.inline(units.speed(*ball_speed)),
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
                units.inline(units.speed(barrel.speed)),
                units.inline(units.length(barrel.from_tip)),
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

/// The name of a row with its unit; a place from the tip comes after the same place from the knob end.
fn label(row: &ComparedFigure, scale: &Scale) -> String {
    match (row.from, scale.name) {
        (From::Tip, unit) => format!("    from the tip, {unit}"),
        (_, "") => row.name.clone(),
        (_, unit) => format!("{}, {unit}", row.name),
    }
}

/// The values of all bats.
fn overview(comparison: &Comparison, units: Units) -> String {
    let width = (48 / comparison.bats.len()).min(10);
    let bats = (0..comparison.bats.len()).map(|k| numbers(width, letter(k)));
    let columns =
        Columns::new([first(32, "All (places from the knob end)")].into_iter().chain(bats));
    let mut out = format!("\n{}", columns.heads());
    for row in shown(comparison) {
        let scale = scale(row.unit, units);
        let values = row.values.iter();
        let values = values.map(|v| v.map_or(String::new(), |figure| scale.value(figure.value)));
        let label = format!("  {}", label(row, &scale));
        out += &columns.row([label].into_iter().chain(values));
    }
    out
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
    /// The difference between two pieces of one wood, with ±; empty where it is not known.
    pub pieces: String,
    /// Whether any bat differs from the first by more than the errors.
    pub differs: bool,
}

/// The name of a row with its unit, complete without other rows.
fn alone(figure: &ComparedFigure, unit: &str) -> String {
    let name = match figure.key.trim_end_matches("_from_tip") {
        "best_place" => "sweet spot",
        "zone_from" => "sweet zone from",
        "zone_to" => "sweet zone to",
        "least_vibration_place" => "place of least vibration",
        _ => &figure.name,
    };
    let tip = if figure.from == From::Tip { ", from the tip" } else { "" };
    let unit = if unit.is_empty() { String::new() } else { format!(", {unit}") };
    format!("{name}{tip}{unit}")
}

/// Every row with information, in one system of units.
pub fn rows(comparison: &Comparison, units: Units) -> Vec<ComparisonRow> {
    let bats = comparison.bats.len();
    let row = |figure: &ComparedFigure| {
        let scale = scale(figure.unit, units);
        let differences = || (1..bats).map(|bat| figure.difference(bat));
        let told = |d: Option<Difference>| d.map_or(String::new(), |d| scale.difference(d));
        let value = |v: &Option<Compared>| v.map_or(String::new(), |v| scale.value(v.value));
        ComparisonRow {
            key: figure.key.clone(),
            label: alone(figure, scale.name),
            values: figure.values.iter().map(value).collect(),
            differences: differences().map(told).collect(),
            pieces: {
                let all = figure.values.iter().flatten().filter_map(|value| value.between_pieces);
                let most = all.fold(0.0, f64::max) * scale.factor;
                if most > 0.0 { format!("± {}", significant(most, 2)) } else { String::new() }
            },
            differs: differences().flatten().any(|difference| difference.beyond_errors),
        }
    };
    shown(comparison).map(row).collect()
}

/// One bat compared with the first: figures, then exit speeds by place.
fn pair(comparison: &Comparison, bat: usize, units: Units) -> String {
    let all: Vec<&ComparedFigure> = shown(comparison).collect();
    let mut out = figures(&all, bat, units);
    let near: Vec<_> = comparison.from_tip.iter().zip(&comparison.by_tip).step_by(4).collect();
    out += &by_place("Exit speed from the tip", &near, bat, units);
    if !comparison.same_length() {
        let near: Vec<_> = comparison.from_knob.iter().zip(&comparison.by_knob).collect();
        out += &by_place("Exit speed from the knob end", &near, bat, units);
    }
    out
}

/// Figures of one bat compared with those of the first.
pub fn figures(all: &[&ComparedFigure], bat: usize, units: Units) -> String {
    let name = letter(bat);
    let less = format!("{name} less A");
    let title = format!("{name} beside A");
    let other = if units.both() { less.clone() } else { String::new() };
    let heads = [title, "A".into(), name.to_string(), less, "within".into(), other];
    let mut out = format!("\n{}", columns(heads).heads());
    for figure in all {
        let scale = scale(figure.unit, units);
        out += &compared(figure, bat, &format!("  {}", label(figure, &scale)), units);
    }
    out
}

fn by_place(title: &str, rows: &[(&f64, &ComparedFigure)], bat: usize, units: Units) -> String {
    let hit =
        |(_, row): &&(&f64, &ComparedFigure)| row.values[0].is_some() || row.values[bat].is_some();
    let lines: Vec<String> = rows
        .iter()
        .filter(hit)
        .map(|(distance, row)| {
            let place = units.positions(&[**distance]).join(", ");
            compared(row, bat, &format!("  at {place}"), units)
        })
        .collect();
    if lines.is_empty() {
        return String::new();
    }
    let unit = scale(Unit::MetresPerSecond, units).name;
    format!("{title}, {unit}\n{}", lines.concat())
}

/// A line of two values and their difference.
fn compared(figure: &ComparedFigure, bat: usize, label: &str, units: Units) -> String {
    let scale_here = scale(figure.unit, units);
    let value = |k: usize| figure.values[k].map_or(String::new(), |f| scale_here.value(f.value));
    let difference = figure.difference(bat);
    let size = figure.values[0].map_or(0.0, |f| f.value);
    let in_other = difference.filter(|d| units.both() && d.beyond_errors);
    let in_other = in_other.map_or(String::new(), |d| {
        let other = scale(figure.unit, if units.us_first() { Units::Si } else { Units::Us });
        if figure.unit == Unit::Joules || other.name == scale_here.name {
            String::new()
        } else {
            format!("{} {}", other.difference(d), other.name)
        }
    });
    let cells = [
        label.to_owned(),
        value(0),
        value(bat),
        difference.map_or(String::new(), |d| scale_here.difference(d)),
        difference.map_or(String::new(), |d| scale_here.within(d, size)),
        in_other,
    ];
    columns(Default::default()).row(cells)
}

/// 80 columns.
fn columns(heads: [String; 6]) -> Columns {
    let [label, a, b, difference, within, other] = heads;
    Columns::new([
        first(32, label),
        numbers(9, a),
        numbers(9, b),
        numbers(10, difference),
        numbers(8, within),
        numbers(12, other),
    ])
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
    let place = |x: f64| units.place(x, 1);
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
    let digits = |v: f64| if v >= 0.1 { format!("{v:.2}") } else { format!("{v:.1e}") };
    units.beside(format!("{} m/s", digits(v)), format!("{} mph", digits(miles_per_hour(v))))
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
