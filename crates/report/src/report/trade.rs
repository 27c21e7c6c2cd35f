//! Speed against accuracy: text and columns.

use schemars::JsonSchema;
use serde::Serialize;

use crate::csv;
use crate::parts::cell::Quantity::{Error, Ratio, Time, Words};
use crate::parts::{Cell, Column, Part, Table, Units};
use crate::report::u_curve::heading;
use crate::schema::{Written, document};
use sweetspot::Bat;
use sweetspot::files::schema::document::BatName;
use sweetspot_study::trade::front::{Run, fastest, front};
use sweetspot_study::trade::measure::Trade;
use sweetspot_study::trade::reference::solver_name;
use sweetspot_study::trade::words;

/// Runs of the front with a larger error are shown only if there are no others.
const COARSEST: f64 = 1e-2;
/// Number of runs of the front on a screen.
const FEW: usize = 11;

/// A run in the table.
struct TradeRow {
    run: Run,
    /// Errors below this cannot be distinguished from zero.
    floor: f64,
    /// The fastest run within the tolerance for which the planner chose this one.
    fastest: Option<Run>,
}

/// The columns of the runs.
const COLUMNS: [Column<TradeRow>; 10] = [
    Column::new("degree", "degree", Ratio(0), |line| line.run.choice.degree.into()),
    Column::new("elements", "elements", Ratio(0), |line| line.run.choice.elements.into()),
    Column::new("solver", "solver", Words, |line| solver_name(line.run.choice.solver).into()),
    Column::new("unknowns", "degrees_of_freedom", Ratio(0), |line| {
        line.run.choice.degrees_of_freedom.into()
    }),
    Column::new("time", "seconds", Time, |line| line.run.seconds.into()),
    Column::new("error", "", Words, TradeRow::error),
    Column::in_files("error", |line| line.run.error.into()),
    Column::in_files("stated_error", |line| line.run.stated_error.into()),
    Column::in_files("on_front", |line| line.run.on_front.into()),
    Column::new("planned for", "planned_for", Error, |line| line.run.planned_for.into()),
];

/// The columns of the planner's choices.
const PLANNER: [Column<TradeRow>; 7] = [
    Column::new("asked", "", Error, |line| line.run.planned_for.into()),
    Column::new("time", "", Time, |line| line.run.seconds.into()),
    Column::new("error", "", Words, TradeRow::error),
    Column::new("stated", "", Words, |line| format!("{:.1e}", line.run.stated_error).into()),
    Column::new("degree", "", Ratio(0), |line| line.run.choice.degree.into()),
    Column::new("elements", "", Ratio(0), |line| line.run.choice.elements.into()),
    Column::new("fastest, n x degree", "", Words, |line| {
        let told = |Run { seconds, choice, .. }: &Run| {
            format!("{}, {} x {}", words::time(*seconds), choice.elements, choice.degree)
        };
        line.fastest.as_ref().map(told).into()
    }),
];

impl TradeRow {
    fn of(run: &Run, trade: &Trade) -> Self {
        let within = run.planned_for.and_then(|tolerance| fastest(&trade.runs, tolerance));
        Self { run: run.clone(), floor: trade.reference.floor, fastest: within.cloned() }
    }

    /// An error, or the limit below which it cannot be distinguished from zero.
    fn error(&self) -> Cell {
        let (error, floor) = (self.run.error, self.floor);
        if error > floor { format!("{error:.1e}") } else { format!("< {floor:.0e}") }.into()
    }
}

/// The title, the reference and the front; `full` adds all runs, the choices of the planner and all remarks.
pub fn report(bat: &Bat, trade: &Trade, full: bool) -> (String, Vec<Part<'static>>) {
    let (title, mut notes) = heading("Speed against accuracy", bat, &trade.reference);
    let ways = match trade.runs.len() {
        1 => "the only way".to_owned(),
        runs => format!("of {runs} ways"),
    };
    let modes = trade.modes;
    notes.push(format!(
        "front: {ways} measured, no other is both faster and more accurate in frequencies 1-{modes}"
    ));
    let good = front(&trade.runs).any(|run| run.error <= COARSEST);
    let shown = front(&trade.runs).filter(|run| !good || run.error <= COARSEST);
    let shown: Vec<&Run> = shown.collect();
    let step = if full { 1 } else { shown.len().div_ceil(FEW).max(1) };
    let shown: Vec<TradeRow> =
        shown.into_iter().step_by(step).map(|run| TradeRow::of(run, trade)).collect();
    let mut parts =
        vec![Part::List(notes), Part::Table(Table::of("", &COLUMNS, &shown, Units::Si))];
    if full {
        let planner: Vec<TradeRow> =
            trade.planner.iter().map(|run| TradeRow::of(run, trade)).collect();
        let caption = "The planner's choices, beside the fastest run within the same tolerance";
        parts.push(Part::Table(Table::of(caption, &PLANNER, &planner, Units::Si)));
    }
    let words = if full { trade.words.clone() } else { words::planner(&trade.runs) };
    parts.extend([Part::Heading("In words"), Part::List(words)]);
    (title, parts)
}

/// Accuracy of the frequencies of a bat against computing time, measured for many meshes and solvers. Errors are
/// relative, times in s; a value that does not exist is null. Later versions with the same number may have more
/// members.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "Trade file of sweetspot, sweetspot-trade/1")]
pub struct TradeFile {
    /// The bat.
    pub bat: BatName,
    /// The measurements.
    #[serde(flatten)]
    pub trade: Trade,
}

document!(TradeFile, "trade");

/// The document of the measurements of that bat.
pub fn document(bat: &Bat, trade: Trade) -> Written<TradeFile> {
    Written::of(TradeFile { bat: BatName::of(bat), trade })
}

/// Every run as a line of CSV, fastest first.
pub fn csv(trade: &Trade) -> String {
    let lines: Vec<TradeRow> = trade.runs.iter().map(|run| TradeRow::of(run, trade)).collect();
    csv::rows(&COLUMNS, &lines)
}
