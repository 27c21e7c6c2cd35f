//! The table of a lathe map: a row for each band, a column for each answer.

use crate::parts::columns::TextColumn;
use crate::parts::{Columns, Units, numbers};
use sweetspot::base::number::{rounded, signed};
use sweetspot::base::units::{inches, miles_per_hour, ounce_square_inches, ounces};
use sweetspot_study::answers::Answer;
use sweetspot_study::lathe::found::TurnedBand;
use sweetspot_study::lathe::map::LatheMap;

/// In which units the table counts: a table has one system.
#[derive(Debug, Clone, Copy)]
pub struct TableUnits {
    us: bool,
}

/// A unit of depth of US tables: 1/32 in (m).
const THIRTY_SECOND: f64 = 0.0254 / 32.0;
/// A thousandth of an inch (m).
const THOU: f64 = 2.54e-5;

impl TableUnits {
    /// The requested units; where both are requested, those in which the bat was measured.
    pub fn of(units: Units, inches: bool) -> Self {
        Self { us: units.us_first() || units == Units::Both && inches }
    }

    /// Whether they are US units.
    pub fn us(self) -> bool {
        self.us
    }

    /// The unit of cut, in a word.
    pub fn per_name(self) -> &'static str {
        if self.us { "1/32 in" } else { "mm" }
    }

    /// The unit of cut (m).
    pub fn per(self) -> f64 {
        if self.us { THIRTY_SECOND } else { 1e-3 }
    }

    /// A place along the bat (m).
    pub fn place(self, x: f64) -> String {
        match self.us {
            true => format!("{} in", rounded(inches(x), 2)),
            false => format!("{} cm", rounded(100.0 * x, 1)),
        }
    }

    /// A depth (m).
    pub fn depth(self, depth: f64) -> String {
        if self.us { format!("{:.3} in", inches(depth)) } else { format!("{:.2} mm", 1e3 * depth) }
    }

    /// How far the sweet spot moves (m).
    fn moved(self, by: f64) -> String {
        let far = match self.us {
            true => format!("{:.3} in", inches(by.abs())),
            false => format!("{:.2} mm", 1e3 * by.abs()),
        };
        format!("sweet spot {far} {}", if by >= 0.0 { "outward" } else { "inward" })
    }

    /// The change of an answer as part of a sentence; None for an answer without one.
    pub fn sentence(self, answer: Answer, change: f64) -> Option<String> {
        let (what, unit, value, decimals) = match (answer, self.us) {
            (Answer::Mass, false) => ("mass", "g", 1e3 * change, 1),
            (Answer::Mass, true) => ("mass", "oz", ounces(change), 2),
            (Answer::Inertia, false) => ("swing weight", "kg cm²", 1e4 * change, 1),
            (Answer::Inertia, true) => ("swing weight", "oz in²", ounce_square_inches(change), 0),
            (Answer::Frequency(1), _) => ("f1", "Hz", change, 2),
            (Answer::ExitSpeed, false) => ("best ball", "m/s", change, 3),
            (Answer::ExitSpeed, true) => ("best ball", "mph", miles_per_hour(change), 3),
            (Answer::ExitSpeedPlace, _) => return Some(self.moved(change)),
            _ => return None,
        };
        Some(format!("{what} {} {unit}", signed(value, decimals)))
    }
}

/// A column: its head in two lines, width, decimals, meaning, and the value for the change of a band.
struct LatheColumn {
    head: [String; 2],
    means: &'static str,
    width: usize,
    decimals: usize,
    answer: Answer,
    exponent: f64,
    /// The number of units of the column per SI unit.
    scale: f64,
}

impl LatheColumn {
    fn column(&self) -> TextColumn {
        numbers(self.width, self.head[0].clone())
    }
}

/// The meaning of a column.
fn meaning(answer: Answer, exponent: f64) -> &'static str {
    match answer {
        Answer::Mass => "what the bat weighs",
        Answer::BalancePoint => "balance point, + towards the tip",
        Answer::Inertia => "swing weight about the point 6 in from the knob end",
        Answer::Frequency(1) => "first bending frequency",
        Answer::Frequency(_) => "second bending frequency",
        Answer::Node(_) => "node of the first mode next to the tip, + towards the tip",
        Answer::ExitSpeedPlace => "sweet spot, where the ball leaves fastest, + towards the tip",
        Answer::ExitSpeed if exponent == 0.0 => {
            "speed of the fastest ball, the bat swung as fast as before"
        }
        Answer::ExitSpeed if exponent == 0.5 => {
            "the same, swung with the energy of before: a lighter bat is swung faster"
        }
        Answer::ExitSpeed => "the same, swung by the law of --swing-exponent",
        _ => "acceleration that the hands feel of a hit, in % of what they feel now",
    }
}

/// The meanings of the columns, and of a mil.
pub fn legend(map: &LatheMap, units: TableUnits) -> String {
    let columns = shown(map, units);
    let part = |column: &LatheColumn| format!("{}: {}", column.head[0], column.means);
    let mut parts = vec!["from: where the band begins, from the knob end".to_owned()];
    parts.extend(columns.iter().map(part));
    if columns.iter().any(|column| column.head[1] == "mil") {
        parts.push("1 mil: 0.001 in".to_owned());
    }
    format!("Columns: {}.", parts.join("; "))
}

/// The columns for the answers of the map.
fn shown(map: &LatheMap, units: TableUnits) -> Vec<LatheColumn> {
    let answers = &map.terms.answers;
    let mut all = vec![];
    let us = units.us;
    let pick = |si: (&'static str, f64, usize), us_unit: (&'static str, f64, usize)| {
        if us { us_unit } else { si }
    };
    let mut add = |answer: Answer, head: &str, width: usize, unit: (&str, f64, usize), exponent| {
        if answers.contains(&answer) {
            let means = meaning(answer, exponent);
            let head = [head.to_owned(), unit.0.to_owned()];
            let (scale, decimals) = (unit.1, unit.2);
            all.push(LatheColumn { head, means, width, decimals, answer, exponent, scale });
        }
    };
    let length = pick(("mm", 1e3, 2), ("mil", 1.0 / THOU, 1));
    let speed = pick(("m/s", 1.0, 3), ("mph", miles_per_hour(1.0), 3));
    add(Answer::Mass, "mass", 7, pick(("g", 1e3, 2), ("oz", ounces(1.0), 3)), 0.0);
    let own = map.terms.exponents().get(2).copied();
    // A law of the batter's own leaves no room for this column.
    if own.is_none() {
        add(Answer::BalancePoint, "bal.", 7, length, 0.0);
    }
    let inertia = pick(("kg cm²", 1e4, 2), ("oz in²", ounce_square_inches(1.0), 1));
    add(Answer::Inertia, "swing", 8, inertia, 0.0);
    add(Answer::Frequency(1), "f1", 7, ("Hz", 1.0, 2), 0.0);
    add(Answer::Frequency(2), "f2", 7, ("Hz", 1.0, 2), 0.0);
    add(Answer::Node(1), "node 1", 7, length, 0.0);
    add(Answer::ExitSpeed, "n=0", 8, speed, 0.0);
    if let Some(own) = own {
        add(Answer::ExitSpeed, &format!("n={own}"), 8, speed, own);
    }
    add(Answer::ExitSpeed, "n=1/2", 8, speed, 0.5);
    add(Answer::ExitSpeedPlace, "spot", 7, length, 0.0);
    let hands = answers.iter().copied().find(|a| matches!(a, Answer::HandsAccelerationAt(_)));
    if let Some(answer) = hands {
        add(answer, "hands", 7, ("%", 100.0, 2), 0.0);
    }
    all
}

/// The table of `value` of a band for an answer and an exponent of the swing law, per millimetre of diameter removed.
pub fn table(
    map: &LatheMap,
    units: TableUnits,
    value: fn(&TurnedBand, Answer, f64) -> Option<f64>,
) -> String {
    let shown = shown(map, units);
    if shown.is_empty() {
        return "None of these outputs has a column here: --json and --csv have them.\n".to_owned();
    }
    let place = numbers(6, "from");
    let columns = Columns::new([place].into_iter().chain(shown.iter().map(LatheColumn::column)));
    let mut out = columns.heads();
    let unit = if units.us { "in" } else { "cm" };
    let second = shown.iter().map(|shown| shown.head[1].clone());
    out += &columns.row([unit.to_owned()].into_iter().chain(second));
    for band in &map.found.bands {
        let x = if units.us { inches(band.from_m) } else { 100.0 * band.from_m };
        let cell = |shown: &LatheColumn| {
            let per_metre = value(band, shown.answer, shown.exponent)? / 1e-3;
            let mut value = per_metre * units.per() * shown.scale;
            if shown.head[1] == "%" {
                // Relative to the value for the unchanged bat.
                let mut outputs = map.found.outputs.iter();
                value /= outputs.find(|output| output.name == shown.answer)?.value?;
            }
            value.is_finite().then(|| signed(value, shown.decimals))
        };
        let cells = shown.iter().map(|shown| cell(shown).unwrap_or_else(|| "-".to_owned()));
        out += &columns.row([format!("{x:.1}")].into_iter().chain(cells));
    }
    out
}
