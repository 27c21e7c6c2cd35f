//! The outputs of a lathe map, and its table: a row for each band, a column for each output.

use crate::parts::{Part, Quantity, Scale, Table, Units, terminal};
use sweetspot::Bat;
use sweetspot::base::number::{rounded, signed};
use sweetspot::base::units::inches;
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
/// The depth of the changes of a band (m).
const MM: f64 = 1e-3;

impl TableUnits {
    /// The requested units; where both are requested, those of the file of the bat.
    pub fn of(units: Units, bat: &Bat) -> Self {
        Self { us: units.of(bat).us_first() }
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
        if self.us { THIRTY_SECOND } else { MM }
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
        let Scale { per, decimals, name } = Quantity::Small.scale(self.us).finer();
        format!("{:.decimals$} {name}", per * depth)
    }

    /// The change of an answer as part of a sentence; None for an answer without one.
    pub fn sentence(self, answer: Answer, change: f64) -> Option<String> {
        let what = match answer {
            Answer::Mass => "mass",
            Answer::Inertia => "swing weight",
            Answer::Frequency(1) => "f1",
            Answer::ExitSpeed => "best ball",
            Answer::ExitSpeedPlace => {
                let way = if change >= 0.0 { "outward" } else { "inward" };
                return Some(format!("sweet spot {} {way}", self.depth(change.abs())));
            }
            _ => return None,
        };
        Some(format!("{what} {}", self.scale(answer).change(change)))
    }

    /// The unit of the changes of an answer.
    fn scale(self, answer: Answer) -> Scale {
        let usual = Quantity::of(answer).scale(self.us);
        match (answer, self.us) {
            (Answer::Inertia, false) => Scale { per: 1e4, decimals: 2, name: "kg cm²" },
            (Answer::Mass | Answer::Inertia | Answer::Frequency(_), _) => usual.finer(),
            (Answer::ExitSpeed, _) => Scale { decimals: 3, ..usual },
            (Answer::HandsAccelerationAt(_), _) => Scale { per: 100.0, decimals: 2, name: "%" },
            (_, false) => Scale { per: 1e3, decimals: 2, name: "mm" },
            (_, true) => Scale { per: 1.0 / THOU, decimals: 1, name: "mil" },
        }
    }
}

/// An output of a cut, as tables and pictures show it.
pub struct LatheOutput {
    answer: Answer,
    exponent: f64,
    /// The head of its column.
    head: String,
    /// Its name.
    pub name: String,
    /// The unit of its changes, per unit of cut.
    pub scale: Scale,
    /// Its changes per metre of cut in that unit.
    per_metre: f64,
}

/// A change of a band, per millimetre of diameter removed, for an answer and an exponent of the swing law.
type Change = fn(&TurnedBand, Answer, f64) -> Option<f64>;

impl LatheOutput {
    /// Its changes in every band.
    pub fn changes(&self, map: &LatheMap, change: Change) -> Vec<Option<f64>> {
        let of = |band| Some(self.per_metre * change(band, self.answer, self.exponent)? / MM);
        map.found.bands.iter().map(|band| of(band).filter(|change| change.is_finite())).collect()
    }

    /// A change with its sign.
    pub fn signed(&self, change: f64) -> String {
        signed(change, self.scale.decimals)
    }
}

/// The outputs that the map has.
pub fn outputs(map: &LatheMap, units: TableUnits) -> Vec<LatheOutput> {
    let law = map.terms.exponents().get(2).copied();
    let [head, name] = law.map_or_else(Default::default, |law| {
        [format!("n={law}"), format!("fastest ball, swing law n = {law}")]
    });
    let hands = |answer: &&Answer| matches!(answer, Answer::HandsAccelerationAt(_));
    let hands = map.terms.answers.iter().find(hands).copied();
    // A law of the batter's own leaves no room for the balance point.
    let balance = law.is_none().then_some(Answer::BalancePoint);
    let all = [
        (Some(Answer::Mass), 0.0, "mass", "mass"),
        (balance, 0.0, "bal.", "balance point, outward"),
        (Some(Answer::Inertia), 0.0, "swing", "swing weight about 6 in from the knob end"),
        (Some(Answer::Frequency(1)), 0.0, "f1", "frequency of mode 1"),
        (Some(Answer::Frequency(2)), 0.0, "f2", "frequency of mode 2"),
        (Some(Answer::Node(1)), 0.0, "node 1", "last node of mode 1, outward"),
        (Some(Answer::ExitSpeed), 0.0, "n=0", "fastest ball, same swing"),
        (law.map(|_| Answer::ExitSpeed), law.unwrap_or(0.0), &head, &name),
        (Some(Answer::ExitSpeed), 0.5, "n=1/2", "fastest ball, same energy of the swing"),
        (Some(Answer::ExitSpeedPlace), 0.0, "spot", "sweet spot, outward"),
        (hands, 0.0, "hands", "acceleration that the hands feel"),
    ];
    let output = |(answer, exponent, head, name): (Option<Answer>, f64, &str, &str)| {
        let answer = answer.filter(|answer| map.terms.answers.contains(answer))?;
        let scale = units.scale(answer);
        // Relative to the value for the unchanged bat, or in the unit.
        let of = map.found.outputs.iter().find(|output| output.name == answer);
        let whole = if scale.name == "%" { of?.value? } else { 1.0 };
        let per_metre = units.per() * scale.per / whole;
        let [head, name] = [head, name].map(str::to_owned);
        Some(LatheOutput { answer, exponent, head, name, scale, per_metre })
    };
    all.into_iter().filter_map(output).collect()
}

/// The meanings of the columns, and of a mil.
pub fn legend(map: &LatheMap, units: TableUnits) -> String {
    let outputs = outputs(map, units);
    let part = |output: &LatheOutput| format!("{}: {}", output.head, output.name);
    let told = outputs.iter().filter(|output| output.head != output.name);
    let mut parts = vec!["from: where the band begins, from the knob end".to_owned()];
    parts.extend(told.map(part));
    if outputs.iter().any(|output| output.scale.name == "mil") {
        parts.push("1 mil: 0.001 in".to_owned());
    }
    format!("Columns: {}.", parts.join("; "))
}

/// The table of the changes of the bands, per unit of cut.
pub fn table(map: &LatheMap, units: TableUnits, change: Change) -> String {
    let outputs = outputs(map, units);
    if outputs.is_empty() {
        return "None of these outputs has a column here: --json and --csv have them.
"
        .to_owned();
    }
    let place = Quantity::Length.scale(units.us);
    let starts = map.found.bands.iter().map(|band| vec![format!("{:.1}", place.per * band.from_m)]);
    let mut table = Table { rows: starts.collect(), ..Table::new("", &["from"]) };
    table.units.push(place.name);
    for output in &outputs {
        table.head.push(output.head.clone());
        table.units.push(output.scale.name);
        let cells = output.changes(map, change).into_iter();
        let cells = cells.map(|cell| cell.map_or("-".to_owned(), |cell| output.signed(cell)));
        table.rows.iter_mut().zip(cells).for_each(|(row, cell)| row.push(cell));
    }
    terminal::parts(&[Part::Table(table)])
}
