//! The U-curve: tables, JSON, CSV.

use std::fmt::Write;

use crate::csv::Csv;
use crate::parts::terminal::wrapped;
use crate::parts::units::Units;
use crate::report::columns::{Columns, labels, numbers};
use crate::report::text::edited;
use crate::schema::u_curve as file;
use sweetspot::bat::body::Bat;
use sweetspot::files::schema::document::{BatName, Format, Generator};
use sweetspot::modes::solve::Solver;
use sweetspot_study::trade::reference::{Choice, Reference, solver_name};
use sweetspot_study::trade::u_curve::{Column, End, SolverFrequency, best, loss};

/// What was measured against what.
pub fn heading(what: &str, bat: &Bat, reference: &Reference) -> String {
    let discretisation = |choice: &Choice| {
        let elements = if choice.elements == 1 { "element" } else { "elements" };
        format!("{} {elements} of degree {}", choice.elements, choice.degree)
    };
    let title = format!("{what}: {}", bat.name());
    let truth = format!(
        "  {}, measured against {}, every frequency within {:.0e}; {} agree with them to {:.0e}",
        reference.theory.name(),
        discretisation(&reference.choice),
        reference.stated,
        discretisation(&reference.other),
        reference.agreement.max(f64::EPSILON)
    );
    wrapped(&title, 4) + &edited(bat, Units::Both) + &wrapped(&truth, 4)
}

/// Errors at which 8 digits, 4 digits and none are left.
pub const THRESHOLDS: [f64; 3] = [1e-8, 1e-4, 1.0];

/// Where the error of the first mode is lost; `full` with that of the first and the last against the number of elements.
pub fn text(bat: &Bat, reference: &Reference, columns: &[Column], full: bool) -> String {
    let mut out = heading("Error against the number of cubic elements", bat, reference);
    out += &wrapped(
        "  own λ: as the solver's eigenvalue says; again: recomputed from its shape as strain \
         energy over kinetic energy, as every answer of this program is",
        4,
    );
    let last = reference.omegas.len() - 1;
    for mode in [0, last].into_iter().take(1 + usize::from(last > 0)).filter(|_| full) {
        let _ = writeln!(out, "Relative error of frequency {}", mode + 1);
        out += &table(columns, mode);
    }
    out += &losses(columns);
    out += "  (> n: not up to n elements)\n";
    for column in columns {
        let name = solver_name(column.solver);
        let why = match &column.end {
            Some(End::Refused { elements, reason }) => {
                format!("  {name} ends at {elements} elements: {reason}")
            }
            Some(End::TooLarge { elements }) => {
                format!("  {name} ends before {elements} elements: more than it takes")
            }
            Some(End::NoTime { elements }) => {
                format!("  {name} ends before {elements} elements: too long for the --budget")
            }
            None => continue,
        };
        out += &wrapped(&why, 4);
    }
    out
}

/// Columns in the order of the table.
fn ways(columns: &[Column]) -> Vec<(&Column, SolverFrequency)> {
    columns.iter().flat_map(|column| column.ways().iter().map(move |way| (column, *way))).collect()
}

fn name(column: &Column, way: SolverFrequency) -> String {
    let name = solver_name(column.solver);
    match (column.solver, way) {
        (Solver::Statics, _) => name.to_owned(),
        (_, SolverFrequency::Own) => format!("{name}, own λ"),
        (_, SolverFrequency::Recomputed) => format!("{name}, again"),
    }
}

fn table(columns: &[Column], mode: usize) -> String {
    let ways = ways(columns);
    let second = ways.iter().map(|(column, way)| match (column.solver, way) {
        (Solver::Statics, _) => "",
        (_, SolverFrequency::Own) => "own λ",
        (_, SolverFrequency::Recomputed) => "again",
    });
    // Over both of its columns, if it has two.
    let over = |column: &Column| numbers(10 * column.ways().len(), solver_name(column.solver));
    let mut out =
        Columns::new([numbers(9, "")].into_iter().chain(columns.iter().map(over))).heads();
    let columns_below = second.map(|head| numbers(10, head));
    let table = Columns::new([numbers(9, "elements")].into_iter().chain(columns_below));
    out += &table.heads();
    let mut counts: Vec<usize> =
        columns.iter().flat_map(|column| column.points.iter().map(|p| p.elements)).collect();
    counts.sort_unstable();
    counts.dedup();
    for n in counts {
        let cell = |(column, way): &(&Column, SolverFrequency)| {
            let series = column.series(*way, mode);
            let here = series.iter().find(|(elements, _)| *elements == n);
            here.map_or("-".to_owned(), |(_, error)| format!("{error:.1e}"))
        };
        out += &table.row([n.to_string()].into_iter().chain(ways.iter().map(cell)));
    }
    out
}

/// Where each loses what, for mode 1.
fn losses(columns: &[Column]) -> String {
    let mut out =
        String::from("Where frequency 1 is lost: the first n beyond the best with such an error\n");
    let table = Columns::new([
        labels(19, ""),
        numbers(8, "best n"),
        numbers(9, "error"),
        numbers(14, "1e-8"),
        numbers(14, "1e-4"),
        numbers(14, "1"),
    ]);
    out += &table.heads();
    out += &table.row(["", "", "", "8 digits left", "4 left", "none"]);
    for (column, way) in ways(columns) {
        let series = column.series(way, 0);
        let Some((least, error)) = best(&series) else { continue };
        let [eight, four, none] = THRESHOLDS.map(|threshold| lost(column, &series, threshold));
        let (name, least) = (name(column, way), least.to_string());
        out += &table.row([&name, &least, &format!("{error:.1e}"), &eight, &four, &none]);
    }
    out
}

fn lost(column: &Column, series: &[(usize, f64)], threshold: f64) -> String {
    match (loss(series, threshold), &column.end, series.last()) {
        (Some((n, _)), ..) => n.to_string(),
        (None, Some(End::Refused { elements, .. }), _) => format!("refuses {elements}"),
        (None, _, Some((n, _))) => format!("> {n}"),
        (None, ..) => String::new(),
    }
}

/// The `sweetspot-u-curve/1` document.
pub fn document(bat: &Bat, reference: &Reference, curve: &[Column]) -> file::UCurveFile {
    file::UCurveFile {
        format: Format::new(),
        generator: Generator::this(),
        bat: BatName::of(bat),
        modes: reference.omegas.len(),
        degree: 3,
        reference: of_reference(reference),
        columns: columns(curve),
    }
}

/// The frequencies everything is measured against, and how far they may be trusted.
pub fn of_reference(reference: &Reference) -> file::Reference {
    file::Reference {
        choice: of_choice(&reference.choice),
        theory: reference.theory.name(),
        frequencies_hz: reference.omegas.iter().map(|w| w / std::f64::consts::TAU).collect(),
        stated_error: reference.stated,
        floor: reference.floor(),
        confirmed_by: file::Confirmation {
            choice: of_choice(&reference.other),
            agreement: reference.agreement,
        },
    }
}

/// Degree, elements, solver, unknowns.
pub fn of_choice(choice: &Choice) -> file::Choice {
    file::Choice {
        degree: choice.degree,
        elements: choice.elements,
        solver: solver_name(choice.solver),
        degrees_of_freedom: choice.degrees_of_freedom,
    }
}

/// Points and losses of every column.
pub fn columns(columns: &[Column]) -> Vec<file::Column> {
    columns.iter().map(of_column).collect()
}

fn of_column(column: &Column) -> file::Column {
    let points = column.points.iter().map(|point| file::Point {
        elements: point.elements,
        seconds: point.seconds,
        own_error_by_mode: (!point.own.is_empty()).then(|| point.own.clone()),
        recomputed_error_by_mode: point.recomputed.clone(),
    });
    let end = column.end.as_ref().map(|end| match end {
        End::Refused { elements, reason } => (*elements, &**reason),
        End::TooLarge { elements } => (*elements, "too large"),
        End::NoTime { elements } => (*elements, "no time"),
    });
    file::Column {
        solver: solver_name(column.solver),
        points: points.collect(),
        end: end.map(|(elements, reason)| file::End { elements, reason: reason.to_owned() }),
        own_lost_at: of_losses(column, SolverFrequency::Own),
        recomputed_lost_at: of_losses(column, SolverFrequency::Recomputed),
    }
}

/// The numbers of elements at which mode 1 is lost.
fn of_losses(column: &Column, way: SolverFrequency) -> Option<file::Losses> {
    let series = column.series(way, 0);
    let (best_elements, least_error) = best(&series)?;
    let [eight_digits, four_digits, nothing] =
        THRESHOLDS.map(|threshold| loss(&series, threshold).map(|at| at.0));
    Some(file::Losses { best_elements, least_error, eight_digits, four_digits, nothing })
}

/// A line for every solver, way, number of elements and mode.
pub fn csv(columns: &[Column]) -> String {
    let mut table = Csv::new(["solver", "frequency", "elements", "mode", "error"]);
    for (column, way) in ways(columns) {
        let whose = if way == SolverFrequency::Own { "own" } else { "recomputed" };
        for point in &column.points {
            let errors = if way == SolverFrequency::Own { &point.own } else { &point.recomputed };
            for (k, error) in errors.iter().enumerate() {
                table.row([
                    solver_name(column.solver).into(),
                    whose.into(),
                    point.elements.into(),
                    (k + 1).into(),
                    (*error).into(),
                ]);
            }
        }
    }
    table.text()
}
