//! The U-curve: text and columns.

use schemars::JsonSchema;
use serde::Serialize;

use crate::csv::Csv;
use crate::parts::cell::Quantity::{Ratio, Words};
use crate::parts::{Column, Part, Table, Units};
use crate::report::edits;
use crate::schema::{Written, document};
use sweetspot::files::schema::document::BatName;
use sweetspot::{Bat, Solver};
use sweetspot_study::trade::reference::{Choice, Confirmation, Reference, solver_name};
use sweetspot_study::trade::u_curve::{Curve, End, Losses, Reason, SolverFrequency};

/// The measured quantity and the reference.
pub fn heading(what: &str, bat: &Bat, reference: &Reference) -> (String, Vec<String>) {
    let discretisation = |choice: &Choice| {
        let elements = if choice.elements == 1 { "element" } else { "elements" };
        format!("{} {elements} of degree {}", choice.elements, choice.degree)
    };
    let Confirmation { choice: other, agreement } = &reference.confirmed_by;
    let truth = format!(
        "{}, measured against {}, every frequency within {:.0e}; {} agree with them to {:.0e}",
        reference.theory.name(),
        discretisation(&reference.choice),
        reference.stated_error,
        discretisation(other),
        agreement.max(f64::EPSILON)
    );
    let edited = edits::noted(bat, Units::Both);
    (format!("{what}: {}", bat.title()), edited.into_iter().chain([truth]).collect())
}

/// The loss of accuracy of a frequency of a solver.
struct Lost {
    name: String,
    losses: Losses,
    /// Shown where an error is not reached.
    none: String,
}

/// The columns of these losses.
const LOSSES: [Column<Lost>; 6] = [
    Column::new("found by", "", Words, |lost| lost.name.as_str().into()),
    Column::new("best n", "", Ratio(0), |lost| lost.losses.best_elements.into()),
    Column::new("error", "", Words, |lost| format!("{:.1e}", lost.losses.least_error).into()),
    Column::new("8 digits left", "", Words, |lost| lost.at(lost.losses.eight_digits).into()),
    Column::new("4 left", "", Words, |lost| lost.at(lost.losses.four_digits).into()),
    Column::new("none left", "", Words, |lost| lost.at(lost.losses.nothing).into()),
];

impl Lost {
    fn of((curve, way): (&Curve, SolverFrequency)) -> Option<Self> {
        let name = match (solver_name(curve.solver), way) {
            (name, _) if curve.solver == Solver::Statics => name.to_owned(),
            (name, SolverFrequency::Own) => format!("{name}, own λ"),
            (name, SolverFrequency::Recomputed) => format!("{name}, again"),
        };
        let none = format!("> {}", curve.points.last()?.elements);
        Some(Self { name, losses: curve.lost_at(way)?.clone(), none })
    }

    /// A number of elements, or that it is not reached.
    fn at(&self, elements: Option<usize>) -> String {
        elements.map_or_else(|| self.none.clone(), |elements| elements.to_string())
    }
}

/// The title, and where the first mode loses accuracy; `full` adds the errors of the first and the last mode against
/// the number of elements.
pub fn report(
    bat: &Bat,
    (reference, curves): (&Reference, &[Curve]),
    full: bool,
) -> (String, Vec<Part<'static>>) {
    let (title, mut notes) = heading("Error against the number of cubic elements", bat, reference);
    notes.push(
        "own λ: as the solver's eigenvalue says; again: recomputed from its shape as strain energy over kinetic \
         energy, as every answer of this program is"
            .to_owned(),
    );
    notes.push(
        "where frequency 1 is lost: the first n beyond the best whose error leaves 8, 4 or no digits".to_owned(),
    );
    let lost: Vec<Lost> = ways(curves).into_iter().filter_map(Lost::of).collect();
    let above = "> n: not reached with n elements".to_owned();
    let mut parts = vec![
        Part::List(notes),
        Part::Table(Table::of("", &LOSSES, &lost, Units::Si)),
        Part::List([above].into_iter().chain(curves.iter().filter_map(ends)).collect()),
    ];
    let last = reference.omegas.len() - 1;
    let first = (0, "Relative error of the first frequency");
    let last = (last > 0).then_some((last, "Relative error of the last frequency"));
    for (mode, title) in [first].into_iter().chain(last).filter(|_| full) {
        parts.push(Part::Table(table(curves, mode, title)));
    }
    (title, parts)
}

/// Why a solver reached no larger mesh.
fn ends(curve: &Curve) -> Option<String> {
    let End { elements, reason } = curve.end.as_ref()?;
    let (when, why) = match reason {
        Reason::Refused(reason) => ("at", reason.as_str()),
        Reason::TooLarge => ("before", "more than it takes"),
        Reason::NoTime => ("before", "too long for the --budget"),
    };
    Some(format!("{} ends {when} {elements} elements: {why}", solver_name(curve.solver)))
}

/// Every solver's frequencies, in the order of the tables.
fn ways(curves: &[Curve]) -> Vec<(&Curve, SolverFrequency)> {
    curves.iter().flat_map(|curve| curve.ways().iter().map(move |way| (curve, *way))).collect()
}

/// The error of one mode (from 0) by rising number of elements.
fn table(curves: &[Curve], mode: usize, title: &str) -> Table {
    let ways = ways(curves);
    let mut table = Table::new(title, &["n"]);
    table.units.push("");
    for (curve, way) in &ways {
        table.head.push(solver_name(curve.solver).to_owned());
        table.units.push(match (curve.solver, way) {
            (Solver::Statics, _) => "",
            (_, SolverFrequency::Own) => "own λ",
            (_, SolverFrequency::Recomputed) => "again",
        });
    }
    let mut counts: Vec<usize> =
        curves.iter().flat_map(|curve| curve.points.iter().map(|p| p.elements)).collect();
    counts.sort_unstable();
    counts.dedup();
    for n in counts {
        let cell = |(curve, way): &(&Curve, SolverFrequency)| {
            let here = curve.points.iter().find(|point| point.elements == n);
            let error = here.and_then(|point| point.errors(*way).get(mode));
            error.map_or("-".to_owned(), |error| format!("{error:.1e}"))
        };
        table.row([n.to_string()].into_iter().chain(ways.iter().map(cell)));
    }
    table
}

/// The error of the frequencies of a bat against the number of cubic elements, for each solver: more elements first
/// reduce the error and then increase it. Errors are relative, times in s; a value that does not exist is null. Later
/// versions with the same number may have more members.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "U-curve file of sweetspot, sweetspot-u-curve/1")]
pub struct UCurveFile {
    /// The bat.
    pub bat: BatName,
    /// Number of modes.
    pub modes: usize,
    /// Degree of the elements' deflection.
    pub degree: usize,
    /// The reference of the errors.
    pub reference: Reference,
    /// A column for each solver.
    pub columns: Vec<Curve>,
}

document!(UCurveFile, "u-curve");

/// The document of those curves of that bat.
pub fn document(bat: &Bat, reference: Reference, columns: Vec<Curve>) -> Written<UCurveFile> {
    let (bat, modes) = (BatName::of(bat), reference.omegas.len());
    Written::of(UCurveFile { bat, modes, degree: 3, reference, columns })
}

/// A line for every solver, way, number of elements and mode.
pub fn csv(curves: &[Curve]) -> String {
    let mut table = Csv::new(["solver", "frequency", "elements", "mode", "error"]);
    for (curve, way) in ways(curves) {
        let whose = if way == SolverFrequency::Own { "own" } else { "recomputed" };
        for point in &curve.points {
            for (k, error) in point.errors(way).iter().enumerate() {
                table.row([
                    solver_name(curve.solver).into(),
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
