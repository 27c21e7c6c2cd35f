//! Speed against accuracy: tables, JSON, CSV.

use std::fmt::Write;

use crate::csv::Csv;
use crate::parts::terminal::wrapped;
use crate::report::columns::{Columns, labels, numbers};
use crate::report::u_curve::{columns, heading, of_choice, of_reference};
use crate::schema::trade as file;
use sweetspot::bat::body::Bat;
use sweetspot::files::schema::document::{BatName, Format, Generator};
use sweetspot_study::trade::front::{Run, fastest, front};
use sweetspot_study::trade::measure::Trade;
use sweetspot_study::trade::reference::solver_name;
use sweetspot_study::trade::words::{self, time};

/// Runs of the front with a larger error are shown only if there are no others.
const COARSEST: f64 = 1e-2;

/// Runs of the front that a screen has.
const FEW: usize = 12;

/// The reference and the front, 80 columns wide; `full` with all of it, the planner's choices and every word.
pub fn text(bat: &Bat, trade: &Trade, full: bool) -> String {
    let reference = &trade.reference;
    let modes = reference.omegas.len();
    let mut out = heading("Speed against accuracy", bat, reference);
    let ways = match trade.runs.len() {
        1 => "the only way".to_owned(),
        runs => format!("of {runs} ways"),
    };
    let _ = writeln!(out, "Front: {ways} measured, no other is both faster and more accurate");
    let columns = Columns::new([
        numbers(12, "time"),
        numbers(11, format!("error 1-{modes}")),
        numbers(8, "degree"),
        numbers(10, "elements"),
        numbers(10, "unknowns"),
        labels(12, "solver"),
        labels(11, "planned for"),
    ]);
    out += &columns.heads();
    let good = front(&trade.runs).any(|run| run.error() <= COARSEST);
    let shown = front(&trade.runs).filter(|run| !good || run.error() <= COARSEST);
    let shown: Vec<&Run> = shown.collect();
    let step = if full { 1 } else { shown.len().div_ceil(FEW).max(1) };
    for run in shown.into_iter().step_by(step) {
        let (choice, floor) = (&run.choice, reference.floor());
        out += &columns.row([
            time(run.seconds),
            error(run.error(), floor),
            choice.degree.to_string(),
            choice.elements.to_string(),
            choice.degrees_of_freedom.to_string(),
            solver_name(choice.solver).to_owned(),
            run.planned_for.map_or(String::new(), |tolerance| format!("{tolerance:.0e}")),
        ]);
    }
    if full {
        out += &planner(trade);
    }
    out += "In words\n";
    let words = if full { trade.words.clone() } else { words::planner(&trade.runs) };
    words.iter().for_each(|line| out += &wrapped(&format!("  {line}"), 4));
    out
}

/// An error, or below what it cannot be told from none.
fn error(error: f64, floor: f64) -> String {
    if error > floor { format!("{error:.1e}") } else { format!("< {floor:.0e}") }
}

fn planned(trade: &Trade) -> Vec<(f64, &Run)> {
    let plans = trade.runs.iter().filter_map(|run| Some((run.planned_for?, run)));
    let mut plans: Vec<_> = plans.collect();
    plans.sort_by(|a, b| b.0.total_cmp(&a.0));
    plans
}

fn planner(trade: &Trade) -> String {
    let floor = trade.reference.floor();
    let columns = Columns::new([
        numbers(7, "asked"),
        numbers(10, "time"),
        numbers(10, "error"),
        numbers(9, "stated"),
        numbers(8, "degree"),
        numbers(9, "elements"),
        labels(21, "  fastest, n x degree"),
    ]);
    let mut out =
        "The planner's choices, beside the fastest run within the same tolerance\n".to_owned();
    out += &columns.heads();
    for (tolerance, run) in planned(trade) {
        let best = fastest(&trade.runs, tolerance);
        out += &columns.row([
            format!("{tolerance:.0e}"),
            time(run.seconds),
            error(run.error(), floor),
            format!("{:.1e}", run.stated),
            run.choice.degree.to_string(),
            run.choice.elements.to_string(),
            best.map_or(String::new(), |best| {
                let (time, choice) = (time(best.seconds), &best.choice);
                format!("{time:>9}, {} x {}", choice.elements, choice.degree)
            }),
        ]);
    }
    out
}

/// The `sweetspot-trade/1` document.
pub fn document(bat: &Bat, trade: &Trade) -> file::TradeFile {
    file::TradeFile {
        format: Format::new(),
        generator: Generator::this(),
        bat: BatName::of(bat),
        modes: trade.reference.omegas.len(),
        reference: of_reference(&trade.reference),
        runs: trade.runs.iter().map(of_run).collect(),
        planner: planned(trade).into_iter().map(|(_, run)| of_run(run)).collect(),
        more_elements: columns(&trade.columns),
        words: trade.words.clone(),
    }
}

fn of_run(run: &Run) -> file::Run {
    file::Run {
        choice: of_choice(&run.choice),
        seconds: run.seconds,
        repeats: run.repeats,
        error: run.error(),
        error_by_mode: run.errors.clone(),
        stated_error: run.stated,
        planned_for: run.planned_for,
        on_front: run.on_front,
    }
}

/// Every run as a line of CSV, fastest first.
pub fn csv(trade: &Trade) -> String {
    let mut table = Csv::new([
        "degree",
        "elements",
        "solver",
        "degrees_of_freedom",
        "seconds",
        "error",
        "stated_error",
        "on_front",
        "planned_for",
    ]);
    for run in &trade.runs {
        let choice = &run.choice;
        table.row([
            choice.degree.into(),
            choice.elements.into(),
            solver_name(choice.solver).into(),
            choice.degrees_of_freedom.into(),
            run.seconds.into(),
            run.error().into(),
            run.stated.into(),
            run.on_front.into(),
            run.planned_for.into(),
        ]);
    }
    table.text()
}
